// How the solver came to the answer, the model and the request.

// Iteration by iteration where the log is known, else mesh by mesh.
function convergence() {
  const logged = SOLVES.filter((s) => s.log.length),
    meshed = SOLVES.filter((s) => s.meshes.length);
  const charts = [];
  const curve = (title, column, log, unit = "") =>
    plot({
      title,
      unit,
      log,
      xTitle: "iteration",
      note: "",
      series: logged
        .map((s) => ({
          label: s.label,
          color: solveColor(s.index),
          dash: solveDash(s.index),
          points: s.log.map((row, i) => [i, row[column]]),
        }))
        .slice(0, MANY ? 2 * FEW : FEW),
      separators:
        logged.length === 1
          ? logged[0].log.flatMap((row, i) => (i && row[1] !== logged[0].log[i - 1][1] ? [i - 0.5] : []))
          : [],
    });
  if (logged.length)
    charts.push(
      curve("Objective", 2, false),
      curve("Constraint violation", 3, true),
      curve("Dual infeasibility", 4, true),
    );
  if (meshed.length) {
    const byMesh = (title, key, log, unit) =>
      plot({
        title,
        unit,
        log,
        xTitle: "mesh",
        series: meshed.map((s) => ({
          label: s.label,
          color: solveColor(s.index),
          points: s.meshes.map((m, i) => [i + 1, m[key]]),
          dots: true,
        })),
      });
    if (meshed.some((s) => s.meshes.length > 1) && !MANY)
      charts.push(
        byMesh("Objective by mesh", "objective", false, ""),
        byMesh("Gap by mesh", "gap_mm", true, "mm"),
        byMesh("Slip by mesh", "slip_mm_s", true, "mm/s"),
      );
  }
  const costs = SOLVES.filter((s) => s.costs.length);
  const costTable = costs.length
    ? table(
        ["Slope", "Term", "Weight", "Value", "Without smoothing", "Adds to the objective"],
        costs.flatMap((s) =>
          s.costs.map((c, i) => [
            i ? "" : labelOf(s),
            c.name,
            fmt(c.weight),
            `${fmt(c.value, 6)} ${c.unit}`,
            c.unsmoothed === c.value ? "" : `${fmt(c.unsmoothed, 6)} ${c.unit}`,
            fmt(c.contribution, 6),
          ]),
        ),
        [2, 3, 4, 5],
        "Terms of the cost",
      )
    : null;
  const meshTable = meshed.length
    ? table(
        [
          "Slope",
          "Intervals",
          "Unknowns",
          "Constraints",
          "Jacobian",
          "Hessian",
          "Iterations",
          "Time",
          "Evaluation",
          "Objective",
          "KKT error",
          "Gap",
          "Slip",
        ],
        meshed.flatMap((s) =>
          s.meshes.map((m, i) => [
            i ? "" : labelOf(s),
            m.intervals,
            String(m.unknowns),
            String(m.constraints),
            String(m.jacobian),
            String(m.hessian),
            String(m.iterations),
            m.wall,
            m.evaluation,
            fmt(m.objective, 6),
            fmt(m.kkt, 3),
            `${fmt(m.gap_mm, 3)} mm`,
            `${fmt(m.slip_mm_s, 3)} mm/s`,
          ]),
        ),
        [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12],
        "Meshes",
      )
    : null;
  const told = meshed.filter((s) => s.meshes.some((m) => m.program));
  const programTable = told.length
    ? table(
        ["Slope", "Program", "Iterations", "End"],
        told.flatMap((s) => s.meshes.map((m, i) => [i ? "" : labelOf(s), m.program, String(m.iterations), m.end])),
        [2],
        "Programs of the search",
      )
    : null;
  const fold = (title, content) =>
    content ? el("details", MANY ? {} : { open: "" }, el("summary", {}, title), content) : null;
  section(
    "Cost and convergence",
    logged.length
      ? "The solver's log, iteration by iteration; dashed lines part the meshes."
      : "What was minimised, and one row a mesh, coarsest first; the mesh is refined until the requested " +
          "accuracy is reached.",
    charts.length ? el("div", { class: "grid three" }, charts) : null,
    fold(
      "Cost, term by term: the unweighted integral, and what it adds to the objective after weighting and " +
        "normalisation",
      costTable,
    ),
    fold("Programs of the search, in the order in which they were solved: what each was, and how it ended", programTable),
    fold("Meshes of these programs: intervals of each phase; Jacobian and Hessian are counts of nonzeros", meshTable),
  );
}

function contactText(contact) {
  const size = `${words(contact.name)} with semi-axes ${contact.semi_axes.map((a) => fmt(a * 1e3, 3)).join(" × ")} mm`;
  return contact.numbers ? `${size} and ${contact.numbers}` : size;
}

function model() {
  const rounded = (key, value) => (typeof value === "number" ? Number(value.toPrecision(6)) : value);
  const seen = new Map();
  for (const solve of SOLVES.filter((s) => s.model.joints.length))
    seen.set(JSON.stringify(solve.model, rounded), solve.model);
  for (const m of seen.values()) {
    const joints = table(
      ["Joint", "Link", "Mass", "Inertia Iyy", "Range", "Effort limit"],
      m.joints.map((j) => [
        words(j.name),
        words(j.link),
        `${fmt(j.mass)} kg`,
        j.iyy === null ? "–" : `${fmt(j.iyy)} kg m²`,
        j.min === null ? "free" : `${fmt(j.min)} … ${fmt(j.max)}${j.angle ? "°" : " m"}`,
        j.effort === null ? "–" : `±${fmt(j.effort)} ${j.angle ? "N m" : "N"}`,
      ]),
      [2, 3, 4, 5],
      "Joints of the model",
    );
    section(
      `Model “${m.name}”`,
      m.description,
      el(
        "p",
        {},
        `Mass ${fmt(m.mass)} kg, ` +
          (m.stature ? `stature ${fmt(m.stature)} m, leg length ${fmt(m.leg_length)} m` : "") +
          (m.stature ? (m.one_sided ? " of the longer leg, " : ", ") : "") +
          `gravity ` +
          `${fmt(m.gravity)} m/s². Surfaces that touch the ground: ` +
          `${m.contacts.map(contactText).join("; ")}.`,
      ),
      el("details", {}, el("summary", {}, `${m.joints.length} joints`), joints),
      m.sources.length
        ? el(
            "details",
            {},
            el("summary", {}, "Where the numbers come from"),
            el(
              "ul",
              {},
              m.sources.map((s) => el("li", { class: "soft" }, s)),
            ),
          )
        : null,
    );
  }
}

function requests() {
  const rows = SOLVES.map((s) => [
    el("span", {}, swatch(s), s.name || s.label),
    s.created,
    s.request.map((r) => `${r[0]} ${r[1]}`).join(", "),
    `${s.scheme}; ${s.build}${s.from_cache ? " (answered from an earlier, equal request)" : ""}`,
  ]);
  const list = table(["Solve", "Created", "Request", "Solver"], rows, [], "Requests");
  const specs = SOLVES.map((s) =>
    el("details", {}, el("summary", {}, `${s.label}: the request`), el("pre", { tabindex: "0" }, s.spec)),
  );
  section(
    "Requests",
    "What was asked for, as rollgait.v1.SolveSpec; save one as a file and repeat it with rollgait solve --spec FILE.",
    MANY ? el("details", {}, el("summary", {}, `${SOLVES.length} requests`), list, specs) : [list, specs],
  );
  page.append(
    el(
      "footer",
      {},
      el(
        "p",
        {},
        `Written by ${DATA.program}. Conventions: x along the ground in the direction of walking, y to the ` +
          `left, z normal to the ground; a slope turns gravity, uphill is positive. Between the nodes of the ` +
          `mesh the curves are the collocation polynomials. Feet, legs and forearms are drawn as the model's ` +
          `own surfaces; pelvis, trunk, head and upper arms are drawn for the eye and are no part of the ` +
          `computation.`,
      ),
      el(
        "details",
        {},
        el("summary", {}, "Licence of three.js, which draws the scene"),
        el("pre", { tabindex: "0" }, document.getElementById("three-licence").textContent.trim()),
      ),
    ),
  );
}
