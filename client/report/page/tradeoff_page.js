// Puts the page of `rollgait tradeoff` together: its points, and their front of CPU time against true error.
const POINTS = DATA.tradeoff.points;
const KNOWN = POINTS.filter((p) => p.angle_error_deg !== undefined && p.minimum === "same");
const SCHEMES = [...new Set(POINTS.map((p) => p.scheme))];
const nameOf = (p) => `${p.scheme}, ${p.intervals} intervals, tolerance ${fmt(p.tolerance)}`;
const endOf = (p) => words((p.termination || p.state).replace(/^(TERMINATION|SOLVE_STATE)_/, "").toLowerCase());

function pointSeries(column) {
  return SCHEMES.map((scheme, i) => {
    const own = KNOWN.filter((p) => p.scheme === scheme);
    return {
      label: scheme,
      color: solveColor(i),
      line: false,
      dots: true,
      points: own.map((p) => [p.cpu_time_s, p[column]]),
      names: own.map(nameOf),
    };
  }).filter((s) => s.points.length);
}

function errorPlot(title, unit, column) {
  const series = pointSeries(column);
  const front = KNOWN.filter((p) => p.on_front).sort((a, b) => a.cpu_time_s - b.cpu_time_s);
  if (column === "angle_error_deg")
    series.push({
      label: "front",
      color: "var(--soft)",
      dash: DASHES[1],
      points: front.map((p) => [p.cpu_time_s, p[column]]),
      names: front.map(nameOf),
    });
  return plot({ title, unit, log: true, xTitle: "CPU time", xUnit: "s", note: "", series });
}

page.append(
  el("h1", {}, DATA.title),
  el(
    "p",
    { class: "soft" },
    DATA.tradeoff.reference
      ? `Errors against ${DATA.tradeoff.reference}, solved from the finest point on four times as many intervals. A ` +
          "point in another minimum than the reference is not drawn."
      : "No reference was reached, so no error is known.",
  ),
);
if (KNOWN.length)
  page.append(
    el(
      "div",
      { class: "grid three" },
      errorPlot("Largest error of a joint angle", "°", "angle_error_deg"),
      errorPlot("Largest error of a joint torque", "N m", "torque_error_n_m"),
      errorPlot("Error of the objective", "", "objective_error"),
    ),
  );
const number = (value, digits = 3) => (value === undefined ? "–" : fmt(value, digits));
page.append(
  table(
    [
      "Front",
      "Scheme",
      "Intervals",
      "Tolerance",
      "Ended",
      "Minimum",
      "CPU s",
      "Iterations",
      "Objective",
      "Objective error",
      "Angle °",
      "Torque N m",
      "Estimated angle °",
      "Estimated torque N m",
    ],
    POINTS.map((p) => [
      p.on_front ? "yes" : "",
      p.scheme,
      String(p.intervals),
      fmt(p.tolerance),
      endOf(p),
      p.minimum || "–",
      number(p.cpu_time_s),
      number(p.iterations, 6),
      number(p.objective, 7),
      number(p.objective_error),
      (p.well_known === false ? "?" : "") + number(p.angle_error_deg),
      number(p.torque_error_n_m),
      number(p.estimated_angle_error_deg),
      number(p.estimated_torque_error_n_m),
    ]),
    [2, 3, 6, 7, 8, 9, 10, 11, 12, 13],
  ),
  el(
    "p",
    { class: "soft" },
    "? The two meshes of the reference differ by more than half of this error: it is not known well.",
  ),
);
