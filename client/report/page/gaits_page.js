// Puts the report together.
header();
if (SHOWN.length) {
  const together =
    SHOWN.length > 1 ? "; all gaits run by percentage of the cycle, from right heel strike to right heel strike" : "";
  const walk =
    "Right leg in full colour, left leg pale. Red arrows are the ground's forces at the contact points (100 % of body " +
    "weight is 0.6 m long), discs the centres of pressure; yellow lines on the feet and dark ones on the ground are " +
    `the paths of the contact points. Marks on the ground are ${MARK} m apart. Drag to turn the view${together}.`;
  const roll =
    "The body, the ground's force on it, and the path of the contact point over the ground and over the body. " +
    "Drag to turn the view.";
  sceneSection(MOVING.length ? "The walk" : "The motion", MOVING.length ? walk : roll);
}
if (MOVING.length) {
  trends();
  if (!MANY) section("Snapshots", "The walk apart along the slope, seen from the right.", MOVING.map(snapshots));
  phases();
  steps();
  joints();
  multiples();
  forces();
  feet();
  normative();
  anyJoint();
}
if (ROLLING.length) rolling();
accuracy();
convergence();
model();
requests();
// "#35" opens the page at 35 % of the cycle.
showPercent(Math.min(Math.max(Number(location.hash.slice(1)) || 0, 0), 100));
