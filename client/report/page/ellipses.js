// Poses of the scene's ellipsoids and superellipsoids, and their outlines.

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

// Gradient of a superellipsoid's support function (rollgait.v1.Superellipsoid with smoothing, `form` as the scene has it)
// before its axes are scaled.
function slopeOf(form, t) {
  const round = form.smoothing ** 2,
    whole = round * (t[0] ** 2 + t[1] ** 2 + t[2] ** 2);
  const n = t.map((c) => Math.sqrt(c * c + whole));
  const m = (n[0] ** form.around + n[1] ** form.around) ** (1 / form.around),
    h = (m ** form.along + n[2] ** form.along) ** (1 / form.along),
    side = (m / h) ** (form.along - 1);
  const slopes = [
    (side * (n[0] / m) ** (form.around - 1)) / n[0],
    (side * (n[1] / m) ** (form.around - 1)) / n[1],
    (n[2] / h) ** (form.along - 1) / n[2],
  ];
  const common = round * (slopes[0] + slopes[1] + slopes[2]);
  return slopes.map((s, k) => (s + common) * t[k]);
}

// The point of a shape furthest along a direction, in its own axes.
function furthestPoint(axes, form, direction) {
  const stretched = direction.map((d, k) => d * axes[k]);
  if (!form) {
    const size = Math.hypot(...stretched);
    return axes.map((a, k) => (a * stretched[k]) / size);
  }
  const scales = [0, 1, 2].map((k) => 1 / slopeOf(form, [+(k === 0), +(k === 1), +(k === 2)])[k]);
  const slope = slopeOf(
    form,
    stretched.map((c, k) => c * scales[k]),
  );
  return axes.map((a, k) => a * scales[k] * slope[k]);
}

// The outline of any shape seen along an axis: points around it.
const OUTLINE_POINTS = 72;
function outlinePoints(center, quaternion, shape, [u, v]) {
  const r = rotationOf(quaternion);
  return Array.from({ length: OUTLINE_POINTS }, (_, i) => {
    const angle = (2 * Math.PI * i) / OUTLINE_POINTS,
      direction = [0, 1, 2].map((k) => Math.cos(angle) * r[u][k] + Math.sin(angle) * r[v][k]);
    const offset = turn(r, furthestPoint(shape.axes, shape.super, direction));
    return [center[u] + offset[u], center[v] + offset[v]];
  });
}

// Rows of `tracks` from the first on, at a percentage; null where the first one is unknown.
function trackAt(scene, first, count, percent) {
  const values = Array.from({ length: count }, (_, k) => valueAt(scene.tracks[first + k], percent));
  return values[0] === null ? null : values;
}
