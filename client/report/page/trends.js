// Figures of many gaits against slope, speed or each other.

const peak = (values) => values.reduce((best, v) => (known(v) ? Math.max(best, Math.abs(v)) : best), 0);
const curvesOf = (solve, joint, row) =>
  ["_r", "_l"]
    .map((suffix) => jointOf(solve, joint + suffix))
    .filter((j) => j && j[row] !== null)
    .map((j) => solve.stride.curves[j[row]]);

// name, unit, value of a solve; in the order of the menus.
const FIGURES = [
  ["slope", "°", (s) => (s.slope_rad * 180) / Math.PI],
  ["speed", "m/s", (s) => s.speed],
  ["objective", "", (s) => s.objective],
  ["step length", "m", (s) => s.step_length],
  ["cadence", "steps/min", (s) => 120 / s.duration],
  ["stance", "%", (s) => (rightFoot(s.stride) ? 100 * rightFoot(s.stride).stance : null)],
  ["double support", "%", (s) => (s.stride.double_support === null ? null : 100 * s.stride.double_support)],
  [
    "largest vertical force",
    "% of body weight",
    (s) => (s.stride.feet.length ? Math.max(...s.stride.feet.map((f) => peak(f.vertical))) : null),
  ],
  [
    "largest friction used",
    "",
    (s) => (s.stride.feet.length ? Math.max(...s.stride.feet.map((f) => peak(component(f, "ratio")))) : null),
  ],
  ...LEG.flatMap((joint) => [
    [`largest ${joint} moment`, "N m/kg", (s) => Math.max(...curvesOf(s, joint, "torque").map(peak), 0) / s.model.mass],
    [
      `range of the ${joint}`,
      "degrees",
      (s) => Math.max(...curvesOf(s, joint, "angle").map((v) => Math.max(...v) - Math.min(...v)), 0),
    ],
  ]),
  ["stride time", "s", (s) => s.duration],
  ["iterations", "", (s) => s.iterations],
  ["wall time", "s", (s) => s.wall_s],
];

// The terms of the costs join the list: what each adds to the objective.
function allFigures() {
  const terms = [...new Set(MOVING.flatMap((s) => s.costs.map((c) => c.name)))];
  return [
    ...FIGURES,
    ...terms.map((name) => [
      `cost: ${name}`,
      "",
      (s) => {
        const c = s.costs.find((t) => t.name === name);
        return c ? c.contribution : null;
      },
    ]),
  ];
}

const figureNamed = (figures, name) => figures.find(([n]) => n === name);

function trendPlot(figures, xName, yName, height) {
  const [, xUnit, xOf] = figureNamed(figures, xName),
    [, unit, yOf] = figureNamed(figures, yName);
  const solves = [...MOVING].sort((a, b) => xOf(a) - xOf(b));
  return plot({
    title: capital(yName),
    unit,
    xTitle: xName,
    xUnit,
    height,
    series: [
      {
        label: yName,
        color: "var(--soft)",
        points: solves.map((s) => [xOf(s), yOf(s)]),
        names: solves.map((s) => s.label),
        line: true,
        dots: true,
        colors: solves.map((s) => solveColor(s.index)),
      },
    ],
  });
}

function trends() {
  if (MOVING.length < 2) return;
  const figures = allFigures(),
    differs = (name) => new Set(MOVING.map((s) => fmt(figureNamed(figures, name)[2](s), 6))).size > 1;
  const against = differs("slope") ? "slope" : differs("speed") ? "speed" : "step length";
  const grid = el("div", { class: "grid three" }),
    free = el("div", { class: "grid one" });
  const small = [
    "step length",
    "cadence",
    "double support",
    "largest vertical force",
    "largest knee moment",
    "largest ankle moment",
  ].filter((n) => known(figureNamed(figures, n)[2](MOVING[0])));
  const menu = (label, value, change) => {
    const select = el(
      "select",
      { "aria-label": label, on: { change: () => change(select.value) } },
      figures.map(([name]) => el("option", { value: name }, name)),
    );
    select.value = value;
    return el("label", {}, `${label} `, select);
  };
  let xName = against,
    yName = "objective";
  const draw = () => free.replaceChildren(trendPlot(figures, xName, yName, 260));
  const drawGrid = () => grid.replaceChildren(...small.map((name) => trendPlot(figures, xName, name)));
  draw();
  drawGrid();
  section(
    `Figures against ${against}`,
    "One point a gait. Choose any figure of the gaits for either axis.",
    el(
      "div",
      { class: "controls" },
      menu("horizontal", xName, (v) => {
        xName = v;
        draw();
        drawGrid();
      }),
      menu("vertical", yName, (v) => {
        yName = v;
        draw();
      }),
    ),
    free,
    grid,
  );
}

// Small multiples: one panel a gait of the same curve, all others pale behind it.
function multiples() {
  if (!MANY || !MOVING.some((s) => jointOf(s, "knee_r"))) return;
  const options = LEG.flatMap((joint) =>
    ["angle", "moment"].map((q) => [`${joint}:${q}`, `${joint} ${QUANTITIES[q].title}`]),
  );
  const box = el("div", {});
  const draw = (value) => {
    const [joint, quantity] = value.split(":");
    box.replaceChildren(
      multiplesCard(
        legSeries(quantity, joint, "right"),
        `${capital(joint)} ${QUANTITIES[quantity].title} of each gait`,
        QUANTITIES[quantity].unit(),
      ),
    );
  };
  const select = el(
    "select",
    { "aria-label": "Curve", on: { change: () => draw(select.value) } },
    options.map(([value, label]) => el("option", { value }, label)),
  );
  draw(options[2][0]);
  select.value = options[2][0];
  section(
    "One panel a gait",
    "The same curve of the right leg, all with the same scale; the other gaits are pale.",
    el("div", { class: "controls" }, el("label", {}, "curve ", select)),
    box,
  );
}

function multiplesCard(series, title, unit) {
  return plotCard({
    title,
    note: unit,
    legend: series,
    rows: () => [
      ["percent", ...series.map((s) => `${s.label} [${unit}]`)],
      ...Array.from({ length: series[0].values.length }, (_, i) => [
        (100 * i) / (series[0].values.length - 1),
        ...series.map((s) => s.values[i]),
      ]),
    ],
    draw: (width) => ({ drawing: drawMultiples(series, title, unit, width), parts: [] }),
  });
}

function drawMultiples(series, title, unit, width) {
  const columns = Math.max(2, Math.min(7, Math.floor(width / 150))),
    cell = { w: width / columns, h: 104 },
    rows = Math.ceil(series.length / columns);
  const values = series.flatMap((s) => Array.from(s.values)).filter(known),
    low = Math.min(...values),
    high = Math.max(...values);
  const root = svg("svg", {
    viewBox: `0 0 ${width} ${rows * cell.h}`,
    role: "img",
    "aria-label": `${title}. ${describe(series, unit)}.`,
  });
  const x = (percent) => 26 + (percent / 100) * (cell.w - 36),
    y = (v) => 84 - ((v - low) / (high - low || 1)) * 64;
  const paths = series.map((s) => polyline(s.values, x, y));
  root.append(
    svg(
      "defs",
      {},
      svg(
        "g",
        { id: "all-gaits" },
        paths.map((d) => svg("path", { d, class: "pale" })),
      ),
    ),
  );
  const cursors = series.map((s, i) => {
    const group = svg("g", { transform: `translate(${(i % columns) * cell.w} ${Math.floor(i / columns) * cell.h})` });
    const cursor = svg("line", { class: "cursor", y1: 18, y2: 86, x1: 0, x2: 0 });
    group.append(
      svg("use", { href: "#all-gaits" }),
      low < 0 && high > 0 ? svg("line", { class: "zero", x1: x(0), x2: x(100), y1: y(0), y2: y(0) }) : "",
      svg("path", { class: "curve", d: paths[i], style: `stroke:${s.color}` }),
      svg("text", { x: 26, y: 13 }, s.label),
      cursor,
    );
    if (i % columns === 0)
      group.append(
        svg("text", { x: 22, y: y(high) + 4, "text-anchor": "end" }, fmt(high, 2)),
        svg("text", { x: 22, y: y(low) + 4, "text-anchor": "end" }, fmt(low, 2)),
      );
    root.append(group);
    return cursor;
  });
  followInstant(root, (percent) => {
    for (const cursor of cursors) cursor.setAttribute("transform", `translate(${x(percent).toFixed(1)} 0)`);
  });
  return root;
}
