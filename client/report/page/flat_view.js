// The body without WebGL: outlines of its shapes from the side or from behind, and snapshots.
const FORCE_M = 0.006; // metres of arrow for one per cent of body weight
const LONGEST_FORCE = 200; // % of body weight; longer arrows are cut

// Right side in the gait's colour, left side paler, the middle grey.
const sidePaint = (side, color) =>
  side === SIDES.right
    ? `fill:color-mix(in srgb, ${color} 82%, var(--panel));stroke:${color}`
    : side === SIDES.left
      ? `fill:color-mix(in srgb, ${color} 26%, var(--panel));stroke:color-mix(in srgb, ${color} 55%, var(--panel))`
      : "fill:var(--limb);stroke:var(--soft)";

function arrowPath(u, v, du, dv) {
  const length = Math.hypot(du, dv) || 1,
    head = Math.min(0.05, 0.4 * length),
    a = (head * du) / length,
    b = (head * dv) / length;
  const barbs = `m${-a - b / 2},${-b + a / 2}l${a + b / 2},${b - a / 2}l${-a + b / 2},${-b - a / 2}`;
  return `M${u},${v}l${du},${dv}${barbs}`;
}

// A figure in a group whose axes are metres; `update(percent)` moves it.
function figure(solve, view, withForces) {
  const scene = solve.motion.scene,
    plane = PLANES[view],
    color = solveColor(solve.index);
  // What is nearer to the eye comes last: seen from the right, and from behind.
  const depth = view === "side" ? (s) => ({ 2: 0, 0: 1, 1: 2 })[s.side] : (s) => (s.side === SIDES.middle ? 0 : 1);
  const order = scene.shapes.map((shape, i) => ({ shape, i })).sort((a, b) => depth(a.shape) - depth(b.shape));
  const group = svg("g"),
    marks = order.map(({ shape, i }) => {
      const mark = svg(shape.form ? "polygon" : "ellipse", {
        "data-part": shape.part,
        style: `${sidePaint(shape.side, color)};stroke-width:0.006`,
      });
      group.append(mark);
      return { mark, shape, i };
    });
  const arrows = withForces
    ? scene.contacts.map((contact) => {
        const mark = svg("path", { class: "force" });
        group.append(mark);
        return { mark, contact };
      })
    : [];
  const update = (percent) => {
    const poses = shapePoses(scene, percent);
    for (const { mark, shape, i } of marks) {
      if (shape.form) {
        const points = outlinePoints(poses[i].center, poses[i].quaternion, shape, plane);
        mark.setAttribute("points", points.map((p) => p.map((c) => c.toFixed(4)).join(",")).join(" "));
        continue;
      }
      const o = outline(poses[i].center, poses[i].quaternion, shape.axes, plane);
      mark.setAttribute("rx", o.a.toFixed(4));
      mark.setAttribute("ry", o.b.toFixed(4));
      mark.setAttribute(
        "transform",
        `translate(${o.u.toFixed(4)} ${o.v.toFixed(4)}) rotate(${((o.angle * 180) / Math.PI).toFixed(2)})`,
      );
    }
    for (const { mark, contact } of arrows) {
      const at = trackAt(scene, contact.rows, 8, percent);
      mark.style.visibility = at ? "visible" : "hidden";
      if (!at) continue;
      const world = [at[0], at[1], 0],
        force = at.slice(5),
        f = plane.map((k) => force[k] || 0);
      const size = FORCE_M * Math.min(1, LONGEST_FORCE / Math.max(Math.hypot(...f), 1e-9));
      mark.setAttribute("d", arrowPath(world[plane[0]], world[plane[1]], f[0] * size, f[1] * size));
    }
  };
  return { group, update };
}

// How far the body has come along x at a percentage, if it went evenly.
const progress = (solve, percent) => ((solve.motion.displacement || 0) * percent) / 100;

// A panel that follows the walker: the flat view of one gait.
function flatPanel(solve, view) {
  const scene = solve.motion.scene,
    caption = el("span", { class: "soft" });
  const tall = scene.height + 0.35,
    wide = view === "side" ? Math.max(1.7, scene.height) : 1.1;
  const root = svg("svg", {
    class: "flat",
    viewBox: `${-wide / 2} ${-tall + 0.2} ${wide} ${tall}`,
    role: "img",
    "aria-label": `${solve.label}, seen from ${view === "side" ? "the right" : "behind"}`,
  });
  const world = svg("g");
  root.append(world);
  world.append(svg("line", { x1: -20, x2: 20, y1: 0, y2: 0, class: "ground" }));
  for (let i = -12; view === "side" && i <= 40; ++i)
    world.append(svg("line", { x1: i * 0.25, x2: i * 0.25 - 0.04, y1: 0, y2: -0.05, class: "ground" }));
  const body = figure(solve, view, true);
  world.append(body.group);
  const tilt = view === "side" ? (solve.slope_rad * 180) / Math.PI : 0;
  // Seen from behind, left is left: y runs to the left.
  const mirror = view === "side" ? 1 : -1;
  followInstant(root, (percent) => {
    const x = view === "side" ? progress(solve, percent) : 0;
    world.setAttribute("transform", `scale(1 -1) rotate(${tilt}) scale(${mirror} 1) translate(${-x} 0)`);
    body.update(percent);
    caption.textContent = `${((solve.duration * percent) / 100).toFixed(2)} s ${supportAt(solve.motion, percent)}`;
  });
  return el("div", { class: "card" }, el("div", { class: "head" }, el("h3", {}, labelOf(solve)), caption), root);
}

// Poses at equal steps of the cycle, set apart along the slope; as many as the width has room for.
function snapshots(solve) {
  return plotCard({
    title: `Snapshots, ${solve.label}`,
    note: "% of the cycle and time from right heel strike",
    rows: () => [
      ["percent", "part", "x [m]", "y [m]", "z [m]"],
      ...snapshotTimes(9).flatMap((percent) =>
        shapePoses(solve.motion.scene, percent).map((pose, i) => [
          percent,
          solve.motion.scene.shapes[i].part,
          ...pose.center,
        ]),
      ),
    ],
    draw: (width) => ({ drawing: drawSnapshots(solve, width), parts: [] }),
  });
}

const snapshotTimes = (count) => Array.from({ length: count }, (_, i) => (100 * i) / (count - 1));

function drawSnapshots(solve, width) {
  const scene = solve.motion.scene,
    count = width > 800 ? 9 : width > 500 ? 6 : 5,
    angle = solve.slope_rad;
  const gap = width / (count + 0.3),
    scale = Math.min(gap / (0.47 * scene.height * Math.cos(angle)), 150),
    step = gap / Math.cos(angle) / scale;
  const rise = gap * (count - 1) * Math.tan(angle);
  const tall = scene.height * scale + Math.abs(rise) + 54,
    base = tall - 40 - Math.max(0, -rise);
  const root = svg("svg", {
    viewBox: `0 0 ${width} ${tall.toFixed(0)}`,
    role: "img",
    "aria-label": `Snapshots of the walk at ${solve.label}`,
  });
  const world = svg("g", {
    transform: `translate(${0.65 * gap} ${base}) scale(${scale} ${-scale}) rotate(${(angle * 180) / Math.PI})`,
  });
  world.append(svg("line", { x1: -0.6, x2: step * (count - 1) + 0.6, y1: 0, y2: 0, class: "ground" }));
  root.append(world);
  snapshotTimes(count).forEach((percent, i) => {
    const body = figure(solve, "side", true);
    body.update(percent);
    const from = trackAt(scene, scene.center, 3, percent);
    body.group.setAttribute("transform", `translate(${step * i - (from ? from[0] : 0)} 0)`);
    world.append(body.group);
    const x = 0.65 * gap + gap * i,
      y = base - gap * i * Math.tan(angle);
    root.append(
      svg("text", { x, y: y + 22, "text-anchor": "middle" }, `${fmt(percent, 3)} %`),
      svg("text", { x, y: y + 35, "text-anchor": "middle" }, `${((solve.duration * percent) / 100).toFixed(2)} s`),
    );
  });
  return root;
}
