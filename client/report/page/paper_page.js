// Puts the page of `rollgait reproduce-paper` together; DATA.paper holds its figures, one entry a solve.
const MARKS = { agrees: "good", disagrees: "bad", open: "" };
const PAPER = SOLVES.map((solve) => ({ ...DATA.paper.slopes[solve.index], solve })).filter((s) => s.phases);

function paperHead() {
  const count = (verdict) => DATA.paper.statements.filter((s) => s.verdict === verdict).length;
  page.append(
    el("h1", {}, DATA.title),
    el(
      "p",
      { class: "soft" },
      "Carpentier, Del Prete, Mansard, Laumond: “An analytical model of rolling contact and its application to " +
        "the modeling of bipedal locomotion”, IMA Conference on Mathematics of Robotics, 2015. Three walks on " +
        "slopes of +10°, 0° and −10°, feet rolling without slipping. " +
        (SOLVES[0].costs.length ? `What is minimised: ${SOLVES[0].costs.map((c) => c.name).join(", ")}.` : ""),
    ),
    el(
      "p",
      {},
      `${DATA.paper.statements.length} statements of the paper: our figures agree with ${count("agrees")}, ` +
        `disagree with ${count("disagrees")}, and leave ${count("open")} open.`,
    ),
  );
  page.append(
    table(
      ["Slope", "How it ended", "Accuracy", "Speed", "Step length", "Stride", "Iterations", "Time"],
      SOLVES.map((s) => [
        labelOf(s),
        el("span", { class: `verdict ${s.good ? "good" : "bad"}` }, s.verdict),
        accuracyBadge(s),
        s.stride ? `${fmt(s.speed)} m/s` : "–",
        s.stride ? `${fmt(s.step_length)} m` : "–",
        s.stride ? `${fmt(s.stride.duration, 3)} s` : "–",
        String(s.iterations),
        s.wall,
      ]),
      [3, 4, 5, 6, 7],
    ),
  );
}

// Torques as the solver has them: every joint of the right leg, one panel a gait, or one a joint.
const torqueOf = (solve, joint) => solve.stride.curves[jointOf(solve, `${joint}_r`).torque];
const torquePool = () => MOVING.flatMap((s) => LEG.flatMap((joint) => Array.from(torqueOf(s, joint))));

function torquePanels() {
  return el(
    "div",
    { class: "grid three" },
    MOVING.map((s) =>
      chart({
        title: `Torques, ${s.label}`,
        unit: "N m",
        pool: torquePool(),
        bands: doubleSupports(s.stride),
        note: "grey: double support",
        series: LEG.map((joint, j) => ({
          label: joint,
          color: `var(--j${j})`,
          dash: DASHES[j],
          values: torqueOf(s, joint),
          mark: null,
        })),
      }),
    ),
  );
}

function torquesByJoint() {
  return el(
    "div",
    { class: "grid three" },
    LEG.map((joint) =>
      chart({
        title: `${capital(joint)} torque`,
        unit: "N m",
        pool: torquePool(),
        note: `+ ${jointOf(MOVING[0], `${joint}_r`).positive}`,
        series: MOVING.map((s) => ({
          label: s.label,
          color: solveColor(s.index),
          dash: solveDash(s.index),
          values: torqueOf(s, joint),
          mark: eventAt(s.stride, "right", "toe off"),
        })),
      }),
    ),
  );
}

function figureTwo() {
  section(
    "Torques",
    "Right leg, from right heel strike to right heel strike; grey: both feet on the ground. The paper draws the " +
      "same three joints between −100 and 100 N m.",
    torquePanels(),
    torquesByJoint(),
  );
  section(
    "Snapshots",
    "Nine instants of the cycle, drawn apart along the slope; percentage of the gait cycle and time from right " +
      "heel strike.",
    MOVING.map(snapshots),
  );
}

function phasesAndEvents() {
  section(
    "Phases and events",
    "When each surface of each foot is on the ground, in % of the gait cycle; events of the right foot above, " +
      "of the left foot below. Grey: both feet are on the ground.",
    MOVING.map(phaseBar),
    table(
      ["Slope", "Heel strike", "Opposite toe-off", "Opposite heel strike", "Toe-off"],
      PAPER.map((s) => [
        labelOf(s.solve),
        ...["heel_strike", "opposite_toe_off", "opposite_heel_strike", "toe_off"].map((event) => {
          const percent = s.events_percent[event];
          return percent === null ? "–" : `${fmt(percent, 3)} %, ${fmt((percent / 100) * s.stride_time_s, 3)} s`;
        }),
      ]),
      [1, 2, 3, 4],
    ),
    table(
      ["Slope", "Phase", "Feet", "From", "To", "Duration"],
      PAPER.flatMap((s) =>
        s.phases.map((p, i) => [
          i ? "" : labelOf(s.solve),
          supportName(p.feet),
          p.contacts.map((c) => words(c)).join(", "),
          `${fmt(p.start_percent, 3)} %`,
          `${fmt(p.end_percent, 3)} %`,
          `${fmt(p.duration_s, 3)} s`,
        ]),
      ),
      [3, 4, 5],
    ),
  );
}

function efforts() {
  const names = PAPER[0].joints.map((j) => j.joint);
  const cell = (s, name) => {
    const joint = name === null ? s.total : s.joints.find((j) => j.joint === name);
    return joint ? `${fmt(joint.squared_torque_n2m2s / s.stride_length_m, 4)}` : "–";
  };
  const head = ["", ...PAPER.map((s) => labelOf(s.solve))];
  const columns = PAPER.map((_, i) => i + 1);
  section(
    "Effort",
    "∫ τ² dt over a stride, divided by its length: N² m s. The torque is what moves each joint; symmetric gaits " +
      "have the same effort on both sides.",
    table(
      head,
      [
        [el("b", {}, "all joints"), ...PAPER.map((s) => cell(s, null))],
        ...names.map((name) => [words(name), ...PAPER.map((s) => cell(s, name))]),
      ],
      columns,
    ),
    table(
      head,
      [
        ["∫ |τ| dt per metre, N s", (s) => s.total.absolute_torque_nms],
        ["Positive work per metre, J", (s) => s.total.positive_work_j],
        ["Negative work per metre, J", (s) => s.total.negative_work_j],
      ]
        .map(([name, value]) => [name, ...PAPER.map((s) => fmt(value(s) / s.stride_length_m, 4))])
        .concat([["Largest torque of hip, knee, ankle, N m", ...PAPER.map((s) => fmt(s.total.peak_torque_nm, 4))]]),
      columns,
    ),
  );
}

function statements() {
  section(
    "Statement by statement",
    "What the paper says, what we find, and what the verdict rests on. The verdicts are computed from the " +
      "figures on this page.",
    table(
      ["Where", "The paper", "Ours", "Verdict", "Why"],
      DATA.paper.statements.map((s) => [
        s.where,
        s.paper,
        s.ours,
        el("span", { class: `verdict ${MARKS[s.verdict]}` }, s.verdict),
        el("span", { class: "soft" }, s.why),
      ]),
      [],
    ),
  );
}

paperHead();
statements();
if (MOVING.length) {
  sceneSection(
    "The walk",
    "Right leg in full colour, left leg pale; red arrows are the ground's forces at the contact points. Drag to " +
      "turn the view.",
  );
  figureTwo();
  phasesAndEvents();
  efforts();
}
accuracy();
requests();
showPercent(0);
