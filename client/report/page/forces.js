// The ground's force on each foot, the sum over its surfaces, as the server measured it.
const COMPONENTS = [
  ["vertical", "Vertical force", "% of body weight", "up against gravity", "QUANTITY_VERTICAL_FORCE"],
  ["forward", "Forward force", "% of body weight", "+ forward, horizontal", "QUANTITY_FORWARD_FORCE"],
  ["sideways", "Sideways force", "% of body weight", "+ left", null],
  ["ratio", "Friction used", "tangential / normal", "", null],
  ["pressure", "Centre of pressure", "mm", "forward from its first place", null],
];

// Of a foot, by component; the ratio means nothing where there is no force.
function component(foot, name) {
  if (name !== "ratio") return foot[name];
  return foot.normal.map((normal, i) => (normal > 0.5 ? Math.hypot(foot.along[i], foot.sideways[i]) / normal : null));
}

function footSeries(solves, name, legs) {
  return solves.flatMap((solve) =>
    legSides[legs].map((suffix) => {
      const right = suffix === "_r",
        pale = !right && legs === "both";
      return {
        label: legs === "both" ? `${solve.label} ${sideWord(suffix)} foot` : solve.label,
        color: solveColor(solve.index),
        opacity: pale ? 0.65 : 1,
        dash: MOVING.length === 1 ? (pale ? DASHES[1] : "") : pale ? DASHES[2] : solveDash(solve.index),
        values: component(footOf(solve.stride, right), name),
        mark: eventAt(solve.stride, sideWord(suffix), "toe off"),
      };
    }),
  );
}

function forces() {
  const solves = MOVING.filter((s) => s.stride.feet.length === 2);
  if (!solves.length) return;
  const sideways = solves.some((s) => s.stride.feet.some((foot) => foot.sideways.some((v) => Math.abs(v) > 1e-6)));
  const first = MOVING.length === 1 ? "both" : "right",
    grid = el("div", { class: "grid three" });
  const draw = (legs) =>
    grid.replaceChildren(
      ...COMPONENTS.filter(([name]) => name !== "sideways" || sideways).map(([name, title, unit, note, data]) =>
        chart({
          title: `${title}, ${legs === "both" ? "both feet" : `${legs} foot`}`,
          unit,
          note,
          series: footSeries(solves, name, legs),
          shared: MANY,
          bands: solves.length === 1 ? doubleSupports(solves[0].stride) : [],
          ribbons: data ? bandsOf(data, "foot") : [],
        }),
      ),
    );
  draw(first);
  section(
    "Ground reaction forces",
    "Force of the ground on a foot, the sum over all its surfaces; 100 % is the body's weight. The centre of " +
      "pressure is shown where the foot carries at least 1 % of it. Bands are what people do on level ground.",
    el(
      "div",
      { class: "controls" },
      choice(
        "Feet",
        [
          ["right", "Right foot"],
          ["left", "Left foot"],
          ["both", "Both feet"],
        ],
        first,
        draw,
      ),
    ),
    MANY ? gaitLegend() : null,
    grid,
  );
}
