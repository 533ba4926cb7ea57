// Puts the report together.
header();
if (MOVING.length) {
  walkers();
  section("Phases", "When each foot is on the ground, in % of the gait cycle.", MOVING.map(phaseBar));
  curves();
  people();
}
accuracy();
numerics();
model();
requests();
// "#35" opens the page at 35 % of the cycle.
showPercent(Math.min(Math.max(Number(location.hash.slice(1)) || 0, 0), 100));
