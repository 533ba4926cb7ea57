// Poses of the scene's ellipsoids and other surfaces, and their outlines.

function multiply(a, b) {
  // quaternions w, x, y, z
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

function rotationOf([w, x, y, z]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
}

const turn = (r, v) => r.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);

// Place and quaternion of a link at a percentage of the cycle, between two samples.
function linkPose(scene, link, percent) {
  const rows = scene.poses,
    last = rows[0].length - 1;
  const place = Math.min(Math.max(percent / 100, 0), 1) * last;
  const i = Math.min(Math.floor(place), last - 1),
    part = place - i;
  const at = (k) => rows[7 * link + k][i] * (1 - part) + rows[7 * link + k][i + 1] * part;
  const q = [at(3), at(4), at(5), at(6)],
    size = Math.hypot(...q);
  return { position: [at(0), at(1), at(2)], quaternion: q.map((c) => c / size) };
}

// Centre and quaternion (own axes -> world) of each shape.
function shapePoses(scene, percent) {
  const links = Array.from({ length: scene.links }, (_, link) => linkPose(scene, link, percent));
  return scene.shapes.map((shape) => {
    const { position, quaternion } = links[shape.link];
    const offset = turn(rotationOf(quaternion), shape.center);
    return { center: position.map((p, k) => p + offset[k]), quaternion: multiply(quaternion, shape.rotation) };
  });
}

// The outline of an ellipsoid seen along an axis: centre, semi-axes and angle of the first one. `plane` names the two
// coordinates that are kept.
const PLANES = { side: [0, 2], front: [1, 2], top: [0, 1] };
function outline(center, quaternion, axes, [u, v]) {
  const r = rotationOf(quaternion);
  const entry = (a, b) => axes.reduce((sum, s, k) => sum + s * s * r[a][k] * r[b][k], 0);
  const uu = entry(u, u),
    uv = entry(u, v),
    vv = entry(v, v);
  const middle = (uu + vv) / 2,
    apart = Math.hypot((uu - vv) / 2, uv);
  return {
    u: center[u],
    v: center[v],
    a: Math.sqrt(middle + apart),
    b: Math.sqrt(Math.max(middle - apart, 0)),
    angle: Math.atan2(2 * uv, uu - vv) / 2,
  };
}

// Value and gradient of a norm of norms (SupportNorm in client/report/surface_shape.h).
function normOf(form, t) {
  if (form.squares) {
    const value = Math.sqrt(form.squares.reduce((sum, s, k) => sum + s * t[k] * t[k], 0));
    return { value, slope: form.squares.map((s, k) => (s * t[k]) / value) };
  }
  const parts = form.parts.map((part) => normOf(part, t));
  const value = parts.reduce((sum, part) => sum + part.value ** form.exponent, 0) ** (1 / form.exponent);
  const shares = parts.map((part) => (part.value / value) ** (form.exponent - 1));
  return { value, slope: t.map((_, k) => parts.reduce((sum, part, p) => sum + shares[p] * part.slope[k], 0)) };
}

// The point of a shape furthest along a direction, in its own axes.
function furthestPoint(axes, form, direction) {
  const stretched = direction.map((d, k) => d * axes[k]);
  if (form) {
    const { slope } = normOf(form, stretched);
    return axes.map((a, k) => a * slope[k]);
  }
  const size = Math.hypot(...stretched);
  return axes.map((a, k) => (a * stretched[k]) / size);
}

// The outline of any shape seen along an axis: points around it.
const OUTLINE_POINTS = 72;
function outlinePoints(center, quaternion, shape, [u, v]) {
  const r = rotationOf(quaternion);
  return Array.from({ length: OUTLINE_POINTS }, (_, i) => {
    const angle = (2 * Math.PI * i) / OUTLINE_POINTS,
      direction = [0, 1, 2].map((k) => Math.cos(angle) * r[u][k] + Math.sin(angle) * r[v][k]);
    const offset = turn(r, furthestPoint(shape.axes, shape.form, direction));
    return [center[u] + offset[u], center[v] + offset[v]];
  });
}

// Rows of `tracks` from the first on, at a percentage; null where the first one is unknown.
function trackAt(scene, first, count, percent) {
  const values = Array.from({ length: count }, (_, k) => valueAt(scene.tracks[first + k], percent));
  return values[0] === null ? null : values;
}
