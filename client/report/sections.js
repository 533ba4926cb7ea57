// The sections of a page, each appended to it when called.
const SOLVES = DATA.solves.map((solve, index) => ({ ...solve, index }));
const MOVING = SOLVES.filter((solve) => solve.stride);
const ROLLING = SOLVES.filter((solve) => solve.path);
const page = document.getElementById("page");

function section(title, note, ...content) {
  page.append(el("h2", {}, title), note ? el("p", { class: "note" }, note) : "", ...content.flat());
}

function table(head, rows, numeric) {
  const cell = (name, value, i) => el(name, { class: numeric.includes(i) ? "n" : null }, value);
  return el("div", { class: "scroll" }, el("table", {}, el("thead", {}, el("tr", {}, head.map((h, i) => cell("th", h, i)))),
    el("tbody", {}, rows.map((row) => el("tr", {}, row.map((value, i) => cell("td", value, i)))))));
}

const swatch = (solve) => el("span", { class: "swatch", style: `border-color:${solveColor(solve.index)}` });
const labelOf = (solve) => el("span", { class: "label" }, swatch(solve), solve.label);
const supportName = (feet) => (feet > 1 ? "double support" : feet ? "single support" : "flight");
const doubleSupports = (stride) => stride.phases.filter((phase) => phase.feet > 1);
const rightFoot = (stride) => stride.feet.find((foot) => foot.right);
const rightToeOff = (stride) => {
  const event = stride.events.find((e) => e.foot === "right" && e.name === "toe off");
  return event ? event.percent : null;
};
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

// within, exceeded or not judged; only the first two are coloured.
const VERDICT_CLASS = { within: "good", exceeded: "bad" };
const accuracyBadge = (solve) => el("span", { class: `badge ${VERDICT_CLASS[solve.accurate] || ""}`, title: solve.accuracy_verdict }, solve.accurate);

function header() {
  page.append(el("h1", {}, DATA.title));
  const models = [...new Set(SOLVES.map((s) => s.model.name))].filter(Boolean).join(", ");
  page.append(el("p", { class: "soft" }, `${SOLVES.length} ${ROLLING.length ? "motion" : "gait"}${SOLVES.length === 1 ? "" : "s"} of the model “${models}”, ${ROLLING.length ? "" : "feet "}rolling without slipping, computed as optimal control problems.`));
  const head = ["Slope", "How it ended", "Accuracy", "Speed", "Step length", "Step time", "Stance (right)", "Double support", "Objective", "Iterations", "Time"];
  const rows = SOLVES.map((solve) => {
    const stride = solve.stride;
    const foot = stride ? rightFoot(stride) : null;
    return [labelOf(solve), el("span", { class: `verdict ${solve.good ? "good" : "bad"}` }, solve.verdict),
      solve.accuracy.length ? accuracyBadge(solve) : "–",
      stride ? `${fmt(solve.speed)} m/s` : "–", stride ? `${fmt(solve.step_length)} m` : "–", stride ? `${fmt(stride.duration / 2, 3)} s` : "–",
      foot ? `${fmt(100 * foot.stance, 3)} %` : "–", foot ? `${fmt(100 * stride.double_support, 3)} %` : "–",
      fmt(solve.objective, 5), String(solve.iterations), solve.wall];
  });
  page.append(table(head, rows, [3, 4, 5, 6, 7, 8, 9, 10]));
  for (const solve of SOLVES.filter((s) => s.unmet.length)) {
    page.append(el("h3", { style: "margin-top:18px" }, labelOf(solve), " constraints that could not be met"),
      table(["Constraint", "By", "Phase", "Time"], solve.unmet.map((u) => [u.name, `${fmt(u.violation)} ${u.unit}`, String(u.phase), `${fmt(u.time, 3)} s`]), [1, 2, 3]));
  }
}

function walkers() {
  const height = Math.max(...MOVING.map((s) => s.stride.walker.height));
  const duration = MOVING.reduce((sum, s) => sum + s.stride.duration, 0) / MOVING.length;
  section("The walk", "Right leg in colour, left leg pale; ○ is the centre of mass, red arrows are the ground's forces at the contact points (100 % of body weight is 0.6 m long; arrows are cut at 200 %). Marks on the ground are 0.25 m apart. All gaits run by percentage of the cycle, from right heel strike to right heel strike.",
    controls(duration), el("div", { class: "grid" }, MOVING.map((s) => animationPanel(s, s.index, height))));
  section("Snapshots", "Nine instants of the cycle, drawn apart along the slope; percentage of the gait cycle and time from right heel strike.",
    MOVING.map((s) => snapshots(s, s.index)));
}

// When each foot and each of its surfaces is on the ground, and the events of each foot: those of the right foot above the bars, those of
// the left one below, each on the first line where it has room.
function phaseBar(solve) {
  const stride = solve.stride, width = 1120, left = 110, right = 12, row = 20, line = 13;
  const x = (percent) => left + (percent / 100) * (width - left - right);
  const contacts = [...stride.contacts].sort((a, b) => Number(b.right) - Number(a.right));
  const place = (foot) => {
    const ends = [];
    return stride.events.filter((event) => event.foot === foot).map((event) => {
      const words = `${event.name} ${fmt(event.percent, 3)} %`, half = 3.2 * words.length;
      const middle = Math.min(Math.max(x(event.percent), left + half), width - right - half);
      let level = ends.findIndex((end) => end + 6 < middle - half);
      if (level < 0) level = ends.length;
      ends[level] = middle + half;
      return { ...event, words, middle, level };
    });
  };
  const above = place("right"), below = place("left");
  const levels = (list) => Math.max(0, ...list.map((event) => event.level + 1));
  const top = 22 + line * levels(above), bottom = top + contacts.length * (row + 6);
  const tall = bottom + line * levels(below) + 12;
  const root = svg("svg", { viewBox: `0 0 ${width} ${tall}`, role: "img", "aria-label": `Phases at ${solve.label}` });
  for (const phase of stride.phases) {
    const middle = (x(phase.start) + x(phase.end)) / 2, wide = x(phase.end) - x(phase.start);
    if (phase.feet > 1) root.append(svg("rect", { class: "band", x: x(phase.start), y: top - 4, width: wide, height: bottom - top + 4 }));
    const share = `${fmt(phase.end - phase.start, 3)} %`;
    root.append(svg("text", { x: middle, y: 12, "text-anchor": "middle" }, wide > 120 ? `${supportName(phase.feet)} ${share}` : wide > 40 ? share : ""));
  }
  contacts.forEach((contact, i) => {
    const y = top + i * (row + 6);
    root.append(svg("text", { x: left - 8, y: y + 14, "text-anchor": "end" }, contact.name.replace("_", " ")));
    for (const phase of stride.phases.filter((p) => p.contacts.includes(contact.name))) {
      root.append(svg("rect", { x: x(phase.start), y, width: x(phase.end) - x(phase.start), height: row, style: `fill:${solveColor(solve.index)};fill-opacity:${contact.right ? 0.9 : 0.4}` }));
    }
  });
  for (const [list, sign, edge] of [[above, -1, top - 6], [below, 1, bottom + 10]]) {
    for (const event of list) {
      const y = edge + sign * line * event.level;
      root.append(svg("line", { class: "zero", x1: x(event.percent), x2: x(event.percent), y1: sign < 0 ? y + 3 : top - 4, y2: sign < 0 ? bottom : y - 10 }));
      root.append(svg("text", { x: event.middle, y, "text-anchor": "middle" }, event.words));
    }
  }
  const cursor = svg("line", { class: "cursor", y1: top - 4, y2: bottom, x1: -9, x2: -9 });
  root.append(cursor);
  cursors.push((percent) => { cursor.setAttribute("x1", x(percent)); cursor.setAttribute("x2", x(percent)); });
  const both = stride.double_support === null ? "" : `, double support ${fmt(100 * stride.double_support, 3)} %, stance of the right foot ${fmt(100 * rightFoot(stride).stance, 3)} %`;
  return el("div", { class: "card", style: "margin:14px 0" }, el("h3", {}, labelOf(solve), el("span", { class: "soft" }, `stride ${fmt(stride.duration, 3)} s, ${fmt(stride.displacement, 3)} m${both}`)), root);
}

// Curves of one kind, all solves overlaid, one chart a joint.
function overlaid(kind, unit, ownScale) {
  const joints = MOVING[0].stride[kind];
  const pool = ownScale ? null : MOVING.flatMap((s) => s.stride[kind].flatMap((c) => c.values));
  const four = joints.length === 4;
  return el("div", { class: four ? "grid four" : "grid" }, joints.map((joint, j) => chart({
    title: capital(joint.title), unit, pool, width: four ? 278 : null,
    note: joint.positive ? `+ ${joint.positive}` : "",
    bands: MOVING.length === 1 ? doubleSupports(MOVING[0].stride) : [],
    series: MOVING.map((s) => ({ label: s.label, color: solveColor(s.index), dash: DASHES[s.index % 4], values: s.stride[kind][j].values, mark: rightToeOff(s.stride) })),
  })));
}

// Curves of one kind, all joints together, one chart a solve: the panels of the paper's Figure 2.
function together(kind, unit) {
  const pool = MOVING.flatMap((s) => s.stride[kind].flatMap((c) => c.values));
  return el("div", { class: "grid" }, MOVING.map((s) => chart({
    title: s.label, unit, pool, bands: doubleSupports(s.stride),
    note: "grey: double support",
    series: s.stride[kind].map((curve, j) => ({ label: curve.title, color: jointColor(j), dash: DASHES[j % 4], values: curve.values, mark: null })),
  })));
}

function curves() {
  const mass = MOVING[0].model.mass;
  section("Joint torques of the right leg", "As in Figure 2 of the paper: torque against the gait cycle from right heel strike; triangles mark the right toe-off. Beside each joint's name: where a positive value moves the part that hangs on it.",
    overlaid("torques", "N m", false), el("p", { class: "note", style: "margin-top:16px" }, `The same, one panel a gait. Body mass ${fmt(mass)} kg: 1 N m/kg is ${fmt(mass)} N m.`), together("torques", "N m"));
  section("Joint angles", "Angles of the right leg and of the trunk. Zero is the upright posture with straight legs and level feet, relative to the slope's normal.",
    overlaid("angles", "degrees", true));
  section("Joint power of the right leg", "Torque times angular velocity: positive power adds energy, negative power takes it away.", overlaid("powers", "W", false));
  // Forces are sums over the surfaces of a foot. A ratio means nothing where there is no force.
  const known = MOVING.filter((s) => s.stride.feet.length);
  if (!known.length) return;
  const right = (s) => rightFoot(s.stride);
  const ratio = (s) => right(s).normal.map((normal, i) => (normal > 0.5 ? Math.abs(right(s).tangential[i]) / normal : 0));
  const overlay = (title, unit, note, values) => chart({
    title, unit, note,
    series: known.map((s) => ({ label: s.label, color: solveColor(s.index), dash: DASHES[s.index % 4], values: values(s), mark: rightToeOff(s.stride) })),
  });
  const overlays = [
    overlay("Normal, right foot", "% of body weight", "", (s) => right(s).normal),
    overlay("Tangential, right foot", "% of body weight", "+ forward", (s) => right(s).tangential),
    overlay("Friction ratio, right foot", "tangential / normal", "", ratio),
    overlay("Centre of pressure, right foot", "mm", "forward from its first place", (s) => right(s).pressure)];
  const pool = known.flatMap((s) => s.stride.feet.flatMap((foot) => [...foot.normal, ...foot.tangential]));
  const each = known.map((s) => chart({
    title: s.label, unit: "% of body weight", pool, note: "grey: double support", bands: doubleSupports(s.stride),
    series: s.stride.feet.flatMap((foot) => [
      { label: `${foot.name}, normal`, color: solveColor(s.index), opacity: foot.right ? 1 : 0.5, values: foot.normal, mark: null },
      { label: "tangential", color: solveColor(s.index), opacity: foot.right ? 1 : 0.5, dash: DASHES[2], values: foot.tangential, mark: null }]),
  }));
  section("Ground reaction forces", "Force of the ground on each foot, the sum over its surfaces, normal to the ground and along it. 100 % is the body's weight. The centre of pressure is shown where the foot carries at least 1 % of it.",
    el("div", { class: "grid" }, overlays), el("div", { class: "grid" }, each));
}

// The ground seen from above: where the body touches it and where its centre is.
function groundPicture(solve) {
  const { contact, center, duration, couple } = solve.path, all = [...contact, ...center];
  const low = [0, 1].map((i) => Math.min(...all.map((p) => p[i]))), high = [0, 1].map((i) => Math.max(...all.map((p) => p[i])));
  const reach = Math.max(high[0] - low[0], high[1] - low[1], 1e-3), size = 340, pad = 30, scale = size / reach;
  const x = (p) => pad + (p[0] - (low[0] + high[0] - reach) / 2) * scale, y = (p) => pad + size - (p[1] - (low[1] + high[1] - reach) / 2) * scale;
  const line = (points, dash) => svg("polyline", { points: points.map((p) => `${x(p).toFixed(1)},${y(p).toFixed(1)}`).join(" "), fill: "none", stroke: solveColor(solve.index), "stroke-width": dash ? 1 : 2, "stroke-dasharray": dash });
  const mark = (p, filled) => svg("circle", { cx: x(p), cy: y(p), r: 4, fill: filled ? solveColor(solve.index) : "none", stroke: solveColor(solve.index) });
  const root = svg("svg", { viewBox: `0 0 ${size + 2 * pad} ${size + 2 * pad}` }, line(center, "5 3"), line(contact, ""), mark(contact[0], false), mark(contact[contact.length - 1], true));
  return el("div", { class: "card" }, el("h3", {}, labelOf(solve), el("span", { class: "soft" }, `${fmt(duration, 3)} s, frame ${fmt(reach, 3)} m wide, largest couple ${fmt(Math.max(...couple), 3)} N m`)), root);
}

function accuracy() {
  const known = SOLVES.filter((s) => s.accuracy.length);
  if (!known.length) return;
  const names = [...new Set(known.flatMap((s) => s.accuracy.map((line) => line.name)))];
  const lineOf = (solve, name) => solve.accuracy.find((line) => line.name === name);
  const rows = names.map((name) => [known.map((s) => lineOf(s, name)).find(Boolean), name]).map(([line, name]) => [
    el("span", {}, el("b", {}, capital(line.name)), el("div", { class: "soft" }, line.explanation)),
    ...known.map((solve) => {
      const at = lineOf(solve, name);
      if (!at) return "–";
      return el("span", { class: at.bound === null ? null : `verdict ${at.exceeded ? "bad" : "good"}` }, `${fmt(at.value, 3)} ${at.unit}`,
        el("div", { class: "soft" }, [at.bound === null ? "" : `${at.exceeded ? "exceeds" : "≤"} ${fmt(at.bound)} ${at.unit}`.trim(), at.where].filter(Boolean).join("; ")));
    })]);
  section("Accuracy", "Measured by an independent verifier. A figure with a bound (≤) is one that the request asks for; it holds at every instant.",
    el("ul", {}, known.map((solve) => el("li", {}, labelOf(solve), ` ${solve.accuracy_verdict}`))),
    table(["", ...known.map(labelOf)], rows, known.map((_, i) => i + 1)));
}

function numerics() {
  const solved = SOLVES.filter((s) => s.costs.length);
  if (solved.length) {
    section("Cost", "What was minimised, term by term: the unweighted integral and what it adds to the objective after weighting and normalisation.",
      table(["Slope", "Term", "Weight", "Value", "Without smoothing", "Adds to the objective"], solved.flatMap((s) => s.costs.map((c, i) => [i ? "" : labelOf(s), c.name, fmt(c.weight), `${fmt(c.value, 6)} ${c.unit}`, c.unsmoothed === c.value ? "" : `${fmt(c.unsmoothed, 6)} ${c.unit}`, fmt(c.contribution, 6)])), [2, 3, 4, 5]));
  }
  const meshed = SOLVES.filter((s) => s.meshes.length);
  if (meshed.length) {
    section("Meshes", "One row a mesh, coarsest first; the mesh is refined until the requested accuracy is reached. Intervals are those of each phase; Jacobian and Hessian are counts of nonzeros.",
      table(["Slope", "Intervals", "Unknowns", "Constraints", "Jacobian", "Hessian", "Iterations", "Time", "Evaluation", "Objective", "KKT error", "Gap", "Slip"],
        meshed.flatMap((s) => s.meshes.map((m, i) => [i ? "" : labelOf(s), m.intervals, String(m.unknowns), String(m.constraints), String(m.jacobian), String(m.hessian), String(m.iterations), m.wall, m.evaluation, fmt(m.objective, 6), fmt(m.kkt, 3), `${fmt(m.gap_mm, 3)} mm`, `${fmt(m.slip_mm_s, 3)} mm/s`])),
        [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]));
  }
}

function model() {
  const seen = new Map();
  for (const solve of SOLVES.filter((s) => s.model.joints.length)) seen.set(JSON.stringify(solve.model), solve.model);
  for (const m of seen.values()) {
    section(`Model “${m.name}”`, m.description,
      el("p", {}, `Mass ${fmt(m.mass)} kg, stature ${fmt(m.stature)} m, leg length ${fmt(m.leg_length)} m, gravity ${fmt(m.gravity)} m/s². Feet: ${m.contacts.map((c) => `${c.name.replace("_", " ")} with semi-axes ${c.semi_axes.map((a) => fmt(a * 1e3, 3)).join(" × ")} mm`).join("; ")}.`),
      table(["Joint", "Link", "Mass", "Inertia Iyy", "Range", "Effort limit"], m.joints.map((j) => [j.name, j.link, `${fmt(j.mass)} kg`, j.iyy === null ? "–" : `${fmt(j.iyy)} kg m²`,
        j.min === null ? "free" : `${fmt(j.min)} … ${fmt(j.max)}${j.angle ? "°" : " m"}`, j.effort === null ? "–" : `±${fmt(j.effort)} ${j.angle ? "N m" : "N"}`]), [2, 3, 4, 5]),
      m.sources.length ? el("details", {}, el("summary", {}, "Where the numbers come from"), el("ul", {}, m.sources.map((s) => el("li", { class: "soft" }, s)))) : "");
  }
}

function requests() {
  section("Requests", "What was asked for, as rollgait.v1.SolveSpec; save one as a file and repeat it with rollgait solve --spec FILE.",
    table(["Solve", "Created", "Request", "Solver"], SOLVES.map((s) => [el("span", {}, swatch(s), s.name || s.label), s.created, s.request.map((r) => `${r[0]} ${r[1]}`).join(", "), `${s.scheme}; ${s.build}${s.from_cache ? " (answered from an earlier, equal request)" : ""}`]), []),
    SOLVES.map((s) => el("details", {}, el("summary", {}, `${s.label}: the request`), el("pre", {}, s.spec))));
  page.append(el("footer", {}, `Written by ${DATA.program}. Conventions: x along the ground in the direction of walking, z normal to it; a slope turns gravity, uphill is positive. Between the nodes of the mesh the curves are the collocation polynomials.`));
}
