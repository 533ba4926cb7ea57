// Puts the page of a running solve together, and takes what `rollgait view` tells it: the solver's log, the newest
// iterate, and the end, with which the page is loaded again as a report.
const solve = SOLVES[0];
const PLOTS_MS = 400; // between drawings of the log
const status = el("b", {}, "Connecting …");
page.append(
  el(
    "header",
    {},
    el("h1", {}, DATA.title),
    el(
      "p",
      { class: "lead", role: "status" },
      `${solve.name}: ${solve.request.map(([key, value]) => `${key} ${value}`).join(", ")}. `,
      status,
    ),
  ),
);

const waiting = el(
  "p",
  { class: "notice" },
  "No picture yet: it comes with the solver's first iteration. There is none of a manoeuvre, and none of a solve that runs " +
    "on another machine than the server.",
);
page.append(waiting);
const plots = el("div", { class: "grid three" });
const log = section("Convergence", "The solver's log, iteration by iteration; dashed lines part the meshes.", plots);

function drawLog() {
  const rows = solve.log,
    parts = rows.flatMap((row, i) => (i && row[1] !== rows[i - 1][1] ? [i - 0.5] : []));
  const curve = (title, column, powers) =>
    plot({
      title,
      unit: "",
      log: powers,
      xTitle: "iteration",
      note: "",
      series: [{ label: solve.label, color: solveColor(0), points: rows.map((row, i) => [i, row[column]]) }],
      separators: parts,
    });
  plots.replaceChildren(
    curve("Objective", 2, false),
    curve("Constraint violation", 3, true),
    curve("Dual infeasibility", 4, true),
  );
}

let drawing = 0;
function requestLog() {
  if (drawing) return;
  drawing = setTimeout(() => {
    drawing = 0;
    drawLog();
  }, PLOTS_MS);
}

// The first iterate makes the scene, later ones move it.
function showIterate(iterate) {
  const first = !solve.motion,
    scene = first ? null : solve.motion.scene;
  solve.stride = iterate.stride;
  unpackMotion(solve);
  plots.dataset.iterate = `${iterate.mesh}/${iterate.index}`;
  if (first) {
    SHOWN.push(solve);
    MOVING.push(solve);
    sceneSection(
      "The newest iterate",
      "The motion of the solver's newest point, drawn without forces. Until the solver has converged it satisfies neither " +
        "the equations of motion nor the contacts: feet may float, sink or slip. Meanwhile it may be a motion of an " +
        "easier problem. Drag to turn the view.",
    );
    page.insertBefore(page.lastElementChild, log);
    waiting.remove();
    if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) document.querySelector(".play").click();
    return;
  }
  // The scene that is drawn stays the same object.
  solve.motion.scene = Object.assign(scene, solve.motion.scene);
  const drawn = window.rollgaitScene;
  if (!drawn) return;
  for (const walker of drawn.walkers) walker.takeMotion();
  drawn.request();
}

function showIterations(rows) {
  solve.log.push(...rows);
  const [index, mesh, objective, primal] = solve.log.at(-1);
  status.textContent =
    `Mesh ${mesh + 1}, iteration ${index}: objective ${fmt(objective, 5)}, ` +
    `constraint violation ${fmt(primal, 2)}.`;
  requestLog();
}

const events = new EventSource("events");
const take = (name, handler) => events.addEventListener(name, (event) => handler(JSON.parse(event.data)));
// A stream that is opened again begins with everything.
take("begin", () => solve.log.splice(0));
take("state", (text) => (status.textContent = text));
take("iterations", showIterations);
take("iterate", showIterate);
take("end", () => {
  events.close();
  location.reload();
});
events.addEventListener("error", () => {
  if (events.readyState === EventSource.CLOSED) status.textContent = "rollgait view does not answer, or four pages follow the solve already.";
  else status.textContent = "The connection to rollgait view is lost; trying again.";
});
