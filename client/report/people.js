// The gait over what people do on level ground: bands of mean ± standard deviation, and figures.
const QUANTITIES = {
  QUANTITY_ANGLE: { title: "angle", unit: "degrees", note: (joint) => (joint === "ankle" ? "+ dorsiflexion" : "+ flexion") },
  QUANTITY_MOMENT: { title: "moment", unit: "N m/kg", note: (joint) => (joint === "ankle" ? "+ plantarflexion" : "+ extension") },
  QUANTITY_VERTICAL_FORCE: { title: "vertical force", unit: "% of body weight", note: () => "" },
  QUANTITY_FORWARD_FORCE: { title: "forward force", unit: "% of body weight", note: () => "+ forward" },
};
const AREAS = ["fill:var(--soft);fill-opacity:0.28", "fill:var(--c4);fill-opacity:0.3"];
const closed = (values) => [...values, values[0]]; // 100 % repeats 0 %

function peopleChart(solves, quantity, joint) {
  const curveOf = (solve, set) => solve.people.datasets[set].curves.find((c) => c.quantity === quantity && c.joint === joint);
  const sets = solves[0].people.datasets.map((_, set) => set).filter((set) => curveOf(solves[0], set));
  const known = solves.filter((s) => curveOf(s, sets[0]));
  const kind = QUANTITIES[quantity];
  return chart({
    title: capital(joint === "foot" ? kind.title : `${joint} ${kind.title}`), unit: kind.unit, note: kind.note(joint),
    ribbons: sets.map((set) => {
      const curve = curveOf(solves[0], set);
      const moved = (sign) => closed(curve.mean.map((mean, i) => mean + sign * curve.deviation[i]));
      return { label: solves[0].people.datasets[set].name, low: moved(-1), high: moved(1), style: AREAS[set % 2], swatch: AREAS[set % 2].replace(/fill/g, "background").replace("background-opacity", "opacity") };
    }),
    series: known.map((s) => ({ label: s.label, color: solveColor(s.index), dash: DASHES[s.index % 4], values: closed(curveOf(s, sets[0]).ours), mark: s.people.toeOffPercent })),
  });
}

const humps = (force) => [force.firstPercentBw, force.troughPercentBw, force.secondPercentBw].map((v) => fmt(v, 3)).join(" / ") + (force.twoHumps ? "" : " (not two humps)");
const share = (fraction) => `${fmt(100 * (fraction ?? 0), 3)} %`;

function peopleCycle(solves) {
  const resting = (people) => (people.restingJoints || []).filter((r) => r.stanceFraction >= 0.5).map((r) => `${r.joint} (${r.atMax ? "upper" : "lower"} end, ${share(r.stanceFraction)})`).join(", ") || "none";
  const ours = solves.map(({ people, ...solve }) => [labelOf(solve), share(people.stanceFraction), share(people.doubleSupportFraction), `${fmt(people.stepLengthM)} m`, `${fmt(people.cadencePerMin, 3)} /min`, humps(people.verticalForce), resting(people)]);
  const theirs = solves[0].people.datasets.map((set) => [`${set.name}, ${fmt(set.speedMS)} m/s`, share(set.stanceFraction), "–", `${fmt((set.speedMS * set.strideTimeS) / 2, 3)} m`, `${fmt(120 / set.strideTimeS, 3)} /min`, humps(set.verticalForce), "–"]);
  return table(["", "Stance", "Double support", "Step length", "Cadence", "Vertical GRF: first peak / valley / second peak, %", "At an end of its range for half of stance"], [...ours, ...theirs], [1, 2, 3, 4, 5]);
}

function peopleFigures(solves) {
  const range = (low, high) => `${fmt(low ?? 0, 3)} … ${fmt(high ?? 0, 3)}`;
  const rows = solves.flatMap((solve) => solve.people.datasets.flatMap((set) => set.curves.map((c) => [
    labelOf(solve), set.name, `${c.joint} ${QUANTITIES[c.quantity].title}`, fmt(c.correlation ?? 0, 2), `${fmt(c.rms ?? 0, 3)} ${QUANTITIES[c.quantity].unit}`, fmt(Number(c.rmsDeviations ?? 0), 3), range(c.min, c.max), range(c.normativeMin, c.normativeMax)])));
  return el("details", {}, el("summary", {}, "Distance, correlation and range of every curve"),
    table(["Slope", "Data", "Curve", "Correlation", "RMS distance", "in SD", "Range, ours", "Range, people"], rows, [3, 4, 5, 6, 7]));
}

function people() {
  const solves = SOLVES.filter((s) => s.people && s.people.datasets);
  if (!solves.length) return;
  const curvesOf = (quantity) => [...new Set(solves[0].people.datasets.flatMap((set) => set.curves).filter((c) => c.quantity === quantity).map((c) => c.joint))].map((joint) => peopleChart(solves, quantity, joint));
  section("Comparison with normative gait", "Right leg, from heel strike to heel strike, over what people do on level ground: bands are mean ± one standard deviation. Moments are net (muscles and passive tissue together: the efforts of the gait, inverse dynamics of the people), per kg of body mass; triangles mark our toe-off. On a slope people walk otherwise; the bands stay those of level ground.",
    el("div", { class: "grid" }, curvesOf("QUANTITY_ANGLE")), el("div", { class: "grid" }, curvesOf("QUANTITY_MOMENT")),
    el("div", { class: "grid" }, curvesOf("QUANTITY_VERTICAL_FORCE"), curvesOf("QUANTITY_FORWARD_FORCE")),
    peopleCycle(solves), peopleFigures(solves),
    el("details", {}, el("summary", {}, "Where the data come from"), el("ul", {}, solves[0].people.datasets.map((set) => el("li", { class: "soft" }, `${set.name}: ${set.source}. Standard deviation ${set.deviation}.`)))));
}
