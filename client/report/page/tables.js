// The head of the page, the verdict on accuracy, and the comparison with people in figures.

function accurateGaits(within, judged) {
  if (within < judged) return `${within} of ${judged} ${within === 1 ? "is" : "are"}`;
  return judged > 1 ? `All ${judged} are` : "It is";
}

function header() {
  const gaits = !ROLLING.length,
    many = SOLVES.length === 1 ? "" : "s";
  const models = [...new Set(SOLVES.map((s) => s.model.name))].filter(Boolean).join(", ");
  const judged = SOLVES.filter((s) => s.accuracy.length),
    within = judged.filter((s) => s.accurate === "within");
  page.append(
    el(
      "header",
      {},
      el("h1", {}, DATA.title),
      el(
        "p",
        { class: "lead" },
        `${SOLVES.length} ${gaits ? "gait" : "motion"}${many} of the model “${models}”, ` +
          `${gaits ? "feet " : ""}rolling without slipping, computed as optimal control problem${many}. `,
        judged.length
          ? el(
              "b",
              { class: within.length === judged.length ? "good" : "bad" },
              `${accurateGaits(within.length, judged.length)} accurate within the bounds of the request.`,
            )
          : null,
      ),
    ),
  );
  const head = [
    "Slope",
    "Outcome",
    "Accuracy",
    "Speed",
    "Step length",
    "Step time",
    "Stance, right",
    "Double support",
    "Objective",
    "Iterations",
    "Wall time",
  ];
  const rows = SOLVES.map((solve) => {
    const stride = solve.stride,
      foot = stride ? rightFoot(stride) : null;
    return [
      labelOf(solve),
      el("span", { class: `verdict ${solve.good ? "good" : "bad"}` }, solve.verdict),
      solve.accuracy.length ? accuracyBadge(solve) : "–",
      stride ? `${fmt(solve.speed)} m/s` : "–",
      stride ? stepLengths(solve) : "–",
      stride ? `${fmt(stride.duration / 2, 3)} s` : "–",
      foot ? share(foot.stance) : "–",
      foot ? share(stride.double_support) : "–",
      fmt(solve.objective, 5),
      String(solve.iterations),
      solve.wall,
    ];
  });
  const summary = table(head, rows, [3, 4, 5, 6, 7, 8, 9, 10], "Summary of the solves");
  page.append(
    MANY
      ? el("details", { class: "folded" }, el("summary", {}, `Summary of ${SOLVES.length} gaits`), summary)
      : summary,
  );
  for (const solve of SOLVES.filter((s) => s.unmet.length)) {
    page.append(
      el("h3", { class: "unmet" }, labelOf(solve), " constraints that could not be met"),
      table(
        ["Constraint", "By", "Phase", "Time"],
        solve.unmet.map((u) => [u.name, `${fmt(u.violation)} ${u.unit}`, String(u.phase), `${fmt(u.time, 3)} s`]),
        [1, 2, 3],
      ),
    );
  }
}

// Of both feet where they differ.
function stepLengths(solve) {
  if (!hasUnequalSteps(solve.stride)) return `${fmt(solve.step_length)} m`;
  const [right, left] = bothFeet(solve.stride);
  return `right ${fmt(right.step_length)} m, left ${fmt(left.step_length)} m`;
}

// A figure of the verifier with its bound.
function accuracyCell(at) {
  if (!at) return "–";
  return el(
    "span",
    { class: at.bound === null ? null : `verdict ${at.exceeded ? "bad" : "good"}` },
    `${fmt(at.value, 3)} ${at.unit}`,
    el(
      "div",
      { class: "soft" },
      [at.bound === null ? "" : `${at.exceeded ? "exceeds" : "≤"} ${fmt(at.bound)} ${at.unit}`.trim(), at.where]
        .filter(Boolean)
        .join("; "),
    ),
  );
}

function accuracy() {
  const judged = SOLVES.filter((s) => s.accuracy.length);
  if (!judged.length) return;
  const names = [...new Set(judged.flatMap((s) => s.accuracy.map((line) => line.name)))];
  const lineOf = (solve, name) => solve.accuracy.find((line) => line.name === name);
  const verdicts = el(
    "ul",
    { class: "verdicts" },
    judged
      .filter((s) => !MANY || s.accurate !== "within")
      .map((solve) => el("li", {}, labelOf(solve), ` ${solve.accuracy_verdict}`)),
  );
  const note =
    "Measured by an independent verifier. A figure with a bound (≤) is one that the request asks for; it holds " +
    "at every instant.";
  if (MANY) {
    const worst = names.map((name) => {
      const lines = judged.map((solve) => ({ solve, line: lineOf(solve, name) })).filter(({ line }) => line);
      const { solve, line } = lines.reduce((a, b) => (Math.abs(b.line.value) > Math.abs(a.line.value) ? b : a));
      return [
        el("span", { class: "criterion" }, el("b", {}, capital(name)), el("div", { class: "soft" }, line.explanation)),
        labelOf(solve),
        accuracyCell(line),
        `${lines.filter((l) => l.line.exceeded).length} of ${lines.length}`,
      ];
    });
    section(
      "Accuracy",
      `${note} Of each figure the worst of the ${judged.length} gaits is shown.`,
      el(
        "p",
        {},
        `${judged.filter((s) => s.accurate === "within").length} of ${judged.length} gaits are within the ` +
          `requested bounds.`,
      ),
      verdicts,
      table(["", "Worst gait", "Figure", "Exceeded by"], worst, [2, 3], "Accuracy, worst of all gaits"),
    );
    return;
  }
  const rows = names
    .map((name) => [judged.map((s) => lineOf(s, name)).find(Boolean), name])
    .map(([line, name]) => [
      el(
        "span",
        { class: "criterion" },
        el("b", {}, capital(line.name)),
        el("div", { class: "soft" }, line.explanation),
      ),
      ...judged.map((solve) => accuracyCell(lineOf(solve, name))),
    ]);
  section(
    "Accuracy",
    note,
    verdicts,
    table(
      ["", ...judged.map(labelOf)],
      rows,
      judged.map((_, i) => i + 1),
      "Accuracy",
    ),
  );
}

// Figures of the gait cycle beside those of people.
const peaks = (force) =>
  force
    ? [force.firstPercentBw, force.valleyPercentBw, force.secondPercentBw].map((v) => fmt(v, 3)).join(" / ") +
      (force.twoPeaks ? "" : " (no two peaks)")
    : "–";

function normative() {
  const solves = SOLVES.filter((s) => s.people && s.people.datasets);
  if (!solves.length) return;
  const resting = (own) =>
    (own.restingJoints || [])
      .filter((r) => r.stanceFraction >= 0.5)
      .map((r) => `${words(r.joint)} (${r.atMax ? "upper" : "lower"} limit, ${share(r.stanceFraction)})`)
      .join(", ") || "none";
  // Of each leg where left and right of the body differ, else of the right one.
  const legs = solves.flatMap((solve) => [
    { solve, own: solve.people, leg: "right" },
    ...(solve.people_left ? [{ solve, own: solve.people_left, leg: "left" }] : []),
  ]);
  const ours = legs.map(({ solve, own, leg }) => [
    el("span", {}, labelOf(solve), ` ${leg} leg`),
    share(own.stanceFraction ?? 0),
    share(own.doubleSupportFraction ?? 0),
    `${fmt(own.stepLengthM)} m`,
    `${fmt(own.cadencePerMin, 3)} /min`,
    peaks(own.verticalForce),
    resting(own),
  ]);
  const theirs = DATA.datasets.map((set) => [
    `${words(set.name)}, ${fmt(set.speedMS)} m/s`,
    share(set.stanceFraction),
    "–",
    `${fmt((set.speedMS * set.strideTimeS) / 2, 3)} m`,
    `${fmt(120 / set.strideTimeS, 3)} /min`,
    peaks(set.verticalForce),
    "–",
  ]);
  const names = {
    QUANTITY_ANGLE: "angle, degrees",
    QUANTITY_MOMENT: "moment, N m/kg",
    QUANTITY_VERTICAL_FORCE: "vertical force, % of body weight",
    QUANTITY_FORWARD_FORCE: "forward force, % of body weight",
  };
  const range = (low, high) => `${fmt(low ?? 0, 3)} … ${fmt(high ?? 0, 3)}`;
  const rows = legs.flatMap(({ solve, own, leg }) =>
    own.datasets.flatMap((set) =>
      (set.curves || []).map((c) => [
        el("span", {}, labelOf(solve), ` ${leg} leg`),
        words(set.name),
        `${c.joint} ${names[c.quantity]}`,
        fmt(c.correlation ?? 0, 2),
        fmt(c.rms ?? 0, 3),
        fmt(Number(c.rmsDeviations ?? 0), 3),
        range(c.min, c.max),
        range(c.normativeMin, c.normativeMax),
      ]),
    ),
  );
  const figures = table(
    [
      "",
      "Stance of the leg",
      "Double support",
      "Step length, mean of both feet",
      "Cadence",
      "Vertical force: first peak / valley / second peak, %",
      "At a joint limit for ≥ 50 % of stance",
    ],
    [...theirs, ...ours],
    [1, 2, 3, 4, 5],
    "Gait cycle beside normative data",
  );
  section(
    "Comparison with normative data",
    solves.some((s) => s.people_left)
      ? "Each leg from its own heel strike on against people on level ground."
      : "The right leg against people on level ground; the left leg is its mirror image half a cycle later.",
    figures,
    el(
      "details",
      {},
      el("summary", {}, "Distance, correlation and range of every curve"),
      table(
        ["Slope", "Data", "Curve", "Correlation", "RMS distance", "in SD", "Range, ours", "Range, people"],
        rows,
        [3, 4, 5, 6, 7],
        "Distance from normative curves",
      ),
    ),
    el(
      "details",
      {},
      el("summary", {}, "Where the data come from"),
      el(
        "ul",
        {},
        DATA.datasets.map((set) =>
          el("li", { class: "soft" }, `${words(set.name)}: ${set.source}. Standard deviation ${set.deviation}.`),
        ),
      ),
    ),
  );
}
