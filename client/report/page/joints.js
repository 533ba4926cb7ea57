// Angles, moments and powers of the joints of both legs, over what people do on level ground.
const AREAS = ["fill:var(--soft);fill-opacity:0.26", "fill:var(--people);fill-opacity:0.3"];
const LEG = ["hip", "knee", "ankle"];
const SIGNS = {
  // where a positive value goes, in the axes of the normative data
  angle: { hip: "flexion", knee: "flexion", ankle: "dorsiflexion" },
  moment: { hip: "extension", knee: "extension", ankle: "plantarflexion" },
};
const areaSwatch = (style) => style.replace(/fill/g, "background").replace("background-opacity", "opacity");
const closed = (values) => [...values, values[0]]; // 100 % repeats 0 %

// Bands of mean ± standard deviation of the data that have the curve.
function bandsOf(quantity, joint) {
  return DATA.datasets.flatMap((set, i) => {
    const curve = (set.curves || []).find((c) => c.quantity === quantity && c.joint === joint);
    if (!curve) return [];
    const moved = (sign) => closed(curve.mean.map((mean, k) => mean + sign * curve.deviation[k]));
    return [
      { label: words(set.name), low: moved(-1), high: moved(1), style: AREAS[i % 2], swatch: areaSwatch(AREAS[i % 2]) },
    ];
  });
}

const jointOf = (solve, name) => solve.stride.joints.find((j) => j.name === name);
const legSides = { right: ["_r"], left: ["_l"], both: ["_r", "_l"] };
const sideWord = (suffix) => (suffix === "_r" ? "right" : "left");

// What can be shown of a joint: the row of the curves, its scale and unit, and the normative data.
const QUANTITIES = {
  angle: {
    title: "angle",
    row: "angle",
    unit: () => "degrees",
    scale: () => 1,
    data: "QUANTITY_ANGLE",
    signs: SIGNS.angle,
  },
  moment: {
    title: "moment",
    row: "torque",
    unit: () => "N m/kg",
    scale: (s) => -1 / s.model.mass,
    data: "QUANTITY_MOMENT",
    signs: SIGNS.moment,
  },
  power: { title: "power", row: "power", unit: () => "W/kg", scale: (s) => 1 / s.model.mass, data: null, signs: {} },
};

// Curves of one quantity of one joint; one or two legs of every gait.
function legSeries(quantity, joint, legs) {
  const { row, scale } = QUANTITIES[quantity];
  return MOVING.flatMap((solve) =>
    legSides[legs].flatMap((suffix) => {
      const found = jointOf(solve, joint + suffix);
      if (!found || found[row] === null) return [];
      const factor = scale(solve),
        pale = suffix === "_l" && legs === "both";
      return [
        {
          label: legs === "both" ? `${solve.label} ${sideWord(suffix)}` : solve.label,
          color: solveColor(solve.index),
          opacity: pale ? 0.65 : 1,
          dash: MOVING.length === 1 ? (pale ? DASHES[1] : "") : pale ? DASHES[2] : MANY ? "" : solveDash(solve.index),
          values: solve.stride.curves[found[row]].map((v) => v * factor),
          mark: eventAt(solve.stride, sideWord(suffix), "toe off"),
        },
      ];
    }),
  );
}

function legChart(quantity, joint, legs) {
  const kind = QUANTITIES[quantity],
    series = legSeries(quantity, joint, legs);
  if (!series.length) return null;
  const sign = kind.signs[joint];
  return chart({
    title: `${capital(joint)} ${kind.title}`,
    unit: kind.unit(),
    note: sign ? `+ ${sign}` : "",
    series,
    shared: MANY,
    bands: MOVING.length === 1 ? doubleSupports(MOVING[0].stride) : [],
    // The data begin with the heel strike of the leg; the left leg's comes within this cycle.
    ribbons: kind.data && legs !== "left" ? bandsOf(kind.data, joint) : [],
  });
}

function joints() {
  const human = MOVING.some((s) => LEG.some((joint) => jointOf(s, `${joint}_r`)));
  if (!human) return;
  const first = MOVING.length === 1 ? "both" : "right";
  const grids = el("div", {});
  const draw = (legs) => {
    const row = (quantity) =>
      el(
        "div",
        { class: "grid three" },
        LEG.map((joint) => legChart(quantity, joint, legs)),
      );
    grids.replaceChildren(row("angle"), row("moment"), row("power"));
  };
  draw(first);
  const bands = DATA.datasets.length
    ? " Bands are what people do on level ground with the right leg, mean ± one standard deviation; moments are net (muscles and passive " +
      "tissue together). On a slope people walk otherwise; the bands stay those of level ground."
    : "";
  const grey = MOVING.length === 1 ? " Grey: double support." : "";
  section(
    "Joints of the legs",
    `From heel strike to heel strike of the right foot; triangles mark the toe-off.${bands}${grey}`,
    el(
      "div",
      { class: "controls" },
      choice(
        "Legs",
        [
          ["right", "Right leg"],
          ["left", "Left leg"],
          ["both", "Both legs"],
        ],
        first,
        draw,
      ),
    ),
    MANY ? gaitLegend() : null,
    grids,
  );
}

// Any joint of the body: its angle, torque and power as the solver has them.
function anyJoint() {
  const titles = [...new Map(MOVING[0].stride.joints.map((j) => [j.title, j])).values()];
  const grid = el("div", { class: "grid three" });
  const draw = (title) => {
    const own = (solve) => solve.stride.joints.filter((j) => j.title === title);
    const draws = [
      ["angle", "angle", (j) => j.unit],
      ["torque", "torque", () => "N m"],
      ["power", "power", () => "W"],
    ];
    grid.replaceChildren(
      ...draws.flatMap(([row, word, unit]) => {
        const series = MOVING.flatMap((solve) =>
          own(solve)
            .filter((j) => j[row] !== null)
            .map((j) => ({
              label: [solve.label, ["", "right", "left"][j.side]].filter(Boolean).join(" "),
              color: solveColor(solve.index),
              opacity: j.side === SIDES.left ? 0.65 : 1,
              dash: j.side === SIDES.left ? DASHES[2] : solveDash(solve.index),
              values: solve.stride.curves[j[row]],
              mark: null,
            })),
        );
        if (!series.length) return [];
        const joint = own(MOVING[0])[0];
        return [
          chart({
            title: `${capital(title)} ${word}`,
            unit: unit(joint),
            note: joint && joint.positive ? `+ ${joint.positive}` : "",
            series,
            shared: MANY,
            limits: row === "angle" ? [joint.min, joint.max] : [],
            bands: MOVING.length === 1 ? doubleSupports(MOVING[0].stride) : [],
          }),
        ];
      }),
    );
  };
  const select = el(
    "select",
    { "aria-label": "Joint", on: { change: () => draw(select.value) } },
    titles.map((j) => el("option", { value: j.title }, capital(j.title))),
  );
  const preferred = titles.find((j) => j.title === "trunk flexion") || titles[0];
  select.value = preferred.title;
  draw(preferred.title);
  section(
    "Any joint",
    "As the solver has it: zero is the upright posture with straight legs and hanging arms. Right in full, left " +
      "dotted; a thin line is a limit of the joint.",
    el("div", { class: "controls" }, el("label", {}, "joint ", select)),
    grid,
  );
}
