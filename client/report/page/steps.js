// The steps of each foot of a gait whose left and right differ: where the feet come down along the stride.

// What is drawn as different: more than half a thousandth of the mean.
function hasUnequalSteps(stride) {
  if (!stride) return false;
  const [right, left] = bothFeet(stride);
  if (!right || !left || !right.step_duration || !left.step_duration) return false;
  return ["step_length", "step_duration", "stance"].some(
    (what) => Math.abs(right[what] - left[what]) > (5e-4 * Math.abs(right[what] + left[what])) / 2,
  );
}

const stepWords = (foot) => `${fmt(foot.step_length, 3)} m in ${fmt(foot.step_duration, 3)} s`;

function stepCard(solve) {
  const [right, left] = bothFeet(solve.stride);
  return plotCard({
    title: `Steps, ${solve.label}`,
    note:
      `stance of the right foot ${share(right.stance)}, of the left ${share(left.stance)}; ` +
      `on both feet after right heel strike ${share(right.loading)}, after left ${share(left.loading)}`,
    rows: () => [
      ["foot", "step length [m]", "step duration [s]", "stance [%]", "double support after heel strike [%]"],
      ...[right, left].map((foot) => [
        foot.name,
        foot.step_length,
        foot.step_duration,
        100 * foot.stance,
        100 * foot.loading,
      ]),
    ],
    draw: (width) => ({ drawing: drawSteps(solve, right, left, width), parts: [] }),
  });
}

// Footprints from right heel strike to right heel strike, seen from above: forward is right, the left foot above.
function drawSteps(solve, right, left, width) {
  const edge = 60,
    height = 120,
    lanes = { right: 84, left: 40 };
  const stride = left.step_length + right.step_length;
  const x = (metres) => edge + (metres / stride) * (width - 2 * edge);
  const root = svg("svg", {
    viewBox: `0 0 ${width} ${height}`,
    role: "img",
    "aria-label": `Steps at ${solve.label}: left foot ${stepWords(left)}, right foot ${stepWords(right)}.`,
  });
  const color = solveColor(solve.index);
  for (const [place, lane, opacity] of [
    [0, lanes.right, 0.9],
    [left.step_length, lanes.left, 0.4],
    [stride, lanes.right, 0.9],
  ]) {
    root.append(
      svg("ellipse", { cx: x(place), cy: lane, rx: 16, ry: 7, style: `fill:${color};fill-opacity:${opacity}` }),
    );
  }
  for (const [from, to, words] of [
    [0, left.step_length, `left step ${stepWords(left)}`],
    [left.step_length, stride, `right step ${stepWords(right)}`],
  ]) {
    root.append(
      svg("line", { class: "axis", x1: x(from), x2: x(to), y1: 62, y2: 62 }),
      svg("line", { class: "axis", x1: x(from), x2: x(from), y1: 56, y2: 68 }),
      svg("line", { class: "axis", x1: x(to), x2: x(to), y1: 56, y2: 68 }),
    );
    root.append(svg("text", { x: (x(from) + x(to)) / 2, y: to === stride ? 112 : 20, "text-anchor": "middle" }, words));
  }
  root.append(
    svg("text", { x: 4, y: lanes.left + 4 }, "left"),
    svg("text", { x: 4, y: lanes.right + 4 }, "right"),
  );
  return root;
}

function steps() {
  const unequal = MOVING.filter((solve) => hasUnequalSteps(solve.stride));
  if (MANY || !unequal.length) return;
  section(
    "Steps of each foot",
    "A step ends with the heel strike of its foot. Seen from above, forward is right; drawn to scale along the stride only.",
    unequal.map(stepCard),
  );
}
