// Puts the page of `rollgait tradeoff` together: its points, and their front of CPU time against true error.
const TABLE = DATA.tradeoff;
const POINTS = TABLE.points;
const KNOWN = POINTS.filter((p) => p[TABLE.error] !== undefined && p[TABLE.same] === "same");
const SERIES = [...new Set(POINTS.map((p) => p[TABLE.series]))];
const COLUMNS = TABLE.columns.filter((c) => c.title);
const isWord = (c) => POINTS.some((p) => typeof p[c.name] === "string");
// Of a point: its settings are what stands before how it ended.
const SETTINGS = COLUMNS.slice(
  0,
  COLUMNS.findIndex((c) => c.name === "ended"),
);
const nameOf = (p) =>
  SETTINGS.map((c) => (isWord(c) ? p[c.name] : `${c.title} ${fmt(p[c.name])}`)).join(", ");

function pointSeries(column) {
  return SERIES.map((value, i) => {
    const own = KNOWN.filter((p) => p[TABLE.series] === value);
    return {
      label: value,
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
  if (column === TABLE.error)
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
    TABLE.reference
      ? `Errors against the reference: ${TABLE.reference}. It is finer than the finest point. A point that found another ` +
          `${TABLE.same} than the reference is not drawn.`
      : "No reference was reached, so no error is known.",
  ),
);
if (KNOWN.length)
  page.append(
    el(
      "div",
      { class: "grid three" },
      ...TABLE.columns.filter((c) => c.picture).map((c) => errorPlot(c.picture, c.unit, c.name)),
    ),
  );
function cell(p, column) {
  const value = p[column.name];
  if (value === undefined) return "–";
  if (typeof value === "string") return value;
  const mark = column.name === TABLE.error && p.well_known === false ? "?" : "";
  return mark + fmt(column.scale * value, column.digits);
}
page.append(
  table(
    ["front", ...COLUMNS.map((c) => c.title)],
    POINTS.map((p) => [p.on_front ? "yes" : "", ...COLUMNS.map((c) => cell(p, c))]),
    COLUMNS.map((c, i) => (isWord(c) ? -1 : i + 1)).filter((i) => i > 0),
  ),
  el("p", { class: "soft" }, "? The last two references differ by more than half of this error: it is not known well."),
);
