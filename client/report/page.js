// Puts the report together.
header();
if (MOVING.length) {
  walkers();
  section("Phases", "When each surface of each foot is on the ground, in % of the gait cycle; events of the right foot above, of the left foot below. Grey: both feet are on the ground.", MOVING.map(phaseBar));
  curves();
  people();
}
if (ROLLING.length) {
  section("The way over the ground", "Seen from above, x to the right, y up: the point at which the body touches the ground from start (○) to end (●), and its centre (dashed; on the same line for a ball).", el("div", { class: "grid" }, ROLLING.map(groundPicture)));
  section("Couple on the body", "Its magnitude against the share of the duration.", el("div", { class: "grid" }, ROLLING.map((s) => chart({ title: s.label, unit: "N m", axis: "% of the duration", series: [{ label: "couple", color: solveColor(s.index), values: s.path.couple, mark: null }] }))));
}
accuracy();
numerics();
model();
requests();
// "#35" opens the page at 35 % of the cycle.
showPercent(Math.min(Math.max(Number(location.hash.slice(1)) || 0, 0), 100));
