// Manoeuvres of a rolling body: its way over the ground and the couple on it.

// The ground seen from above: where the body touches it and where its centre is.
function groundPicture(solve) {
  const { contact, center, duration, couple } = solve.path;
  return plotCard({
    title: `Way over the ground, ${solve.label}`,
    note: `${fmt(duration, 3)} s, largest couple ${fmt(Math.max(...couple), 3)} N m`,
    rows: () => [
      ["percent", "contact x [m]", "contact y [m]", "centre x [m]", "centre y [m]"],
      ...contact.map((p, i) => [(100 * i) / (contact.length - 1), ...p, ...center[i]]),
    ],
    draw: (width) => ({ drawing: drawGround(solve, width), parts: [] }),
  });
}

function drawGround(solve, width) {
  const { contact, center } = solve.path,
    all = [...contact, ...center],
    color = solveColor(solve.index);
  const low = [0, 1].map((i) => Math.min(...all.map((p) => p[i]))),
    high = [0, 1].map((i) => Math.max(...all.map((p) => p[i])));
  const pad = 34,
    across = Math.max(high[0] - low[0], 1e-3),
    up = Math.max(high[1] - low[1], 1e-3);
  const scale = Math.min((width - 2 * pad) / across, 320 / up),
    height = Math.max(up * scale + 2 * pad, 90);
  const x = (p) => width / 2 + (p[0] - (low[0] + high[0]) / 2) * scale,
    y = (p) => height / 2 - (p[1] - (low[1] + high[1]) / 2) * scale;
  const line = (points, dash) =>
    svg("polyline", {
      class: "curve",
      points: points.map((p) => `${x(p).toFixed(1)},${y(p).toFixed(1)}`).join(" "),
      style: `stroke:${color};stroke-width:${dash ? 1 : 2}`,
      "stroke-dasharray": dash || null,
    });
  const mark = (p, filled) =>
    svg("circle", { cx: x(p), cy: y(p), r: 4, style: `fill:${filled ? color : "none"};stroke:${color}` });
  const dot = svg("circle", { class: "cursor-dot", r: 5, style: `fill:${color}` });
  const step = ticks(0, across, 4)[1] || 1;
  const root = svg(
    "svg",
    {
      viewBox: `0 0 ${width} ${height}`,
      role: "img",
      "aria-label":
        `${solve.label}: the body goes from (${fmt(contact[0][0], 3)}, ${fmt(contact[0][1], 3)}) to ` +
        `(${fmt(contact.at(-1)[0], 3)}, ${fmt(contact.at(-1)[1], 3)}) m`,
    },
    line(center, "5 3"),
    line(contact, ""),
    mark(contact[0], false),
    mark(contact.at(-1), true),
    dot,
    svg("line", { class: "zero", x1: 10, x2: 10 + step * scale, y1: height - 8, y2: height - 8 }),
    svg("text", { x: 10, y: height - 13 }, `${fmt(step)} m`),
  );
  followInstant(root, (percent) => {
    const i = Math.round((percent / 100) * (contact.length - 1));
    dot.setAttribute("cx", x(contact[i]));
    dot.setAttribute("cy", y(contact[i]));
  });
  return root;
}

function rolling() {
  section(
    "Way over the ground",
    "Seen from above, x to the right, y up: the point at which the body touches the ground from start (○) to " +
      "end (●), and its centre (dashed; on the same line for a ball).",
    el("div", { class: "grid two" }, ROLLING.map(groundPicture)),
  );
  section(
    "Couple on the body",
    "Its magnitude over the duration.",
    el(
      "div",
      { class: "grid two" },
      ROLLING.map((s) =>
        chart({
          title: `Couple, ${s.label}`,
          unit: "N m",
          axis: "% of the duration",
          series: [{ label: "couple", color: solveColor(s.index), values: s.path.couple, mark: null }],
        }),
      ),
    ),
  );
}
