// The solves of the page: what they are called, their colours, and the rows of numbers that belong to them.
const DATA = JSON.parse(document.getElementById("data").textContent);
const SIDES = { middle: 0, right: 1, left: 2 };
const FEW = 6; // so many gaits can be told apart by colour and are drawn one by one
const SOLVES = DATA.solves.map((solve, index) => ({ ...solve, index }));
const MOVING = SOLVES.filter((solve) => solve.stride);
const ROLLING = SOLVES.filter((solve) => solve.path);
const SHOWN = [...MOVING, ...ROLLING]; // those with a motion
const MANY = SHOWN.length > FEW;
const LIVE = Boolean(DATA.live); // the solve runs: its motion comes later, without forces
const DASHES = ["", "7 4", "2 3", "9 3 2 3"];

// Rows of PackedRows; unknown numbers are NaN.
function unpack({ columns, scales, data }) {
  const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
  const integers = new DataView(bytes.buffer);
  return scales.map((scale, r) =>
    Float64Array.from({ length: columns }, (_, c) => {
      const integer = integers.getInt16(2 * (r * columns + c), true);
      return integer === -32768 ? NaN : integer * scale;
    }),
  );
}

function unpackMotion(solve) {
  const motion = solve.stride || solve.path;
  solve.motion = motion;
  solve.duration = motion.duration;
  motion.scene.poses = unpack(motion.scene.poses);
  motion.scene.tracks = unpack(motion.scene.tracks);
  if (motion.curves) motion.curves = unpack(motion.curves);
}
for (const solve of SHOWN) unpackMotion(solve);

// Light and dark colours of many gaits run with the slope, or with the speed where the slopes are equal.
const RAMPS = [
  ["#34449a", "#1f74ab", "#11857a", "#4b8a22", "#947400", "#c2560f", "#ab1f3c"],
  ["#93a5f7", "#5cb6ec", "#3fcbb2", "#94d05b", "#e5c04b", "#f89c5d", "#f58291"],
];

function mixColors(a, b, part) {
  const channels = [1, 3, 5].map((i) =>
    Math.round(parseInt(a.slice(i, i + 2), 16) * (1 - part) + parseInt(b.slice(i, i + 2), 16) * part),
  );
  return "#" + channels.map((c) => c.toString(16).padStart(2, "0")).join("");
}

function onRamp(ramp, place) {
  const index = Math.min(Math.floor(place * (ramp.length - 1)), ramp.length - 2);
  return mixColors(ramp[index], ramp[index + 1], place * (ramp.length - 1) - index);
}

const rank = (key) =>
  new Map(
    [...SHOWN].sort((a, b) => key(a) - key(b)).map((solve, i) => [solve.index, i / Math.max(SHOWN.length - 1, 1)]),
  );
const SLOPES_DIFFER = new Set(SHOWN.map((s) => s.slope_rad)).size > 1;
if (MANY) {
  const place = rank(SLOPES_DIFFER ? (s) => s.slope_rad : (s) => s.speed);
  const rules = (ramp) => SHOWN.map((s) => `--g${s.index}:${onRamp(ramp, place.get(s.index))};`).join("");
  document.head.append(
    el(
      "style",
      {},
      `:root{${rules(RAMPS[0])}}@media (prefers-color-scheme: dark){:root{${rules(RAMPS[1])}}}@media ` +
        `print{:root{${rules(RAMPS[0])}}}`,
    ),
  );
}
const solveColor = (index) => (MANY ? `var(--g${index})` : `var(--c${index % FEW})`);
const solveDash = (index) => (MANY ? "" : DASHES[index % DASHES.length]);

// A colour of the page's style as #rrggbb.
function colorValue(color) {
  const name = /^var\((.+)\)$/.exec(color);
  return name ? getComputedStyle(document.documentElement).getPropertyValue(name[1]).trim() : color;
}

const swatch = (solve) => el("span", { class: "swatch", style: `border-color:${solveColor(solve.index)}` });
const labelOf = (solve) => el("span", { class: "label" }, swatch(solve), solve.label);

// The legend that charts of many gaits share.
function gaitLegend() {
  return el("div", { class: "legend shared", "aria-label": "Colours of the gaits" }, SHOWN.map(labelOf));
}

// Events and support, as the server measured them.
const supportName = (feet) => (feet > 1 ? "double support" : feet ? "single support" : "flight");
const doubleSupports = (stride) => stride.phases.filter((phase) => phase.feet > 1);
const footOf = (stride, right) => stride.feet.find((foot) => foot.right === right) || null;
const rightFoot = (stride) => footOf(stride, true);
const bothFeet = (stride) => [footOf(stride, true), footOf(stride, false)];
const eventAt = (stride, foot, name) => {
  const event = stride.events.find((e) => e.foot === foot && e.name === name);
  return event ? event.percent : null;
};
const words = (name) => name.replace(/_/g, " ");

// What stands on the ground at a percentage.
function supportAt(stride, percent) {
  if (!stride.phases || !stride.phases.length) return "";
  const phase = stride.phases.find((p) => percent < p.end) || stride.phases[stride.phases.length - 1];
  return [supportName(phase.feet), ...phase.contacts.map(words)].join(", ");
}

// within, exceeded or not judged; only the first two are coloured.
const VERDICT_CLASS = { within: "good", exceeded: "bad" };
const accuracyBadge = (solve) =>
  el("span", { class: `badge ${VERDICT_CLASS[solve.accurate] || ""}`, title: solve.accuracy_verdict }, solve.accurate);
