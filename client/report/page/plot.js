// Points and lines over any axis.

// options: title, unit, note, xTitle, xUnit; series: [{label, color, dash, points: [[x, y]], line, dots, colors}],
// colors: one a point; log: powers of ten upwards; separators: [x].
function plot(options) {
  const points = options.series.flatMap((s) => s.points);
  return plotCard({
    title: options.title,
    note: options.note,
    legend: options.series.map((s) => ({ label: s.label, color: s.color, dash: s.dash })),
    rows: () => [
      [
        "series",
        `${options.xTitle}${options.xUnit ? ` [${options.xUnit}]` : ""}`,
        `${options.title}${options.unit ? ` [${options.unit}]` : ""}`,
      ],
      ...options.series.flatMap((s) => s.points.map(([px, py], i) => [s.names ? s.names[i] : s.label, px, py])),
    ],
    draw: (width) => {
      const legend =
        options.series.length > 1
          ? el(
              "div",
              { class: "legend" },
              options.series.map((s) => el("span", {}, lineMark(s), s.label)),
            )
          : null;
      return { drawing: drawPoints(options, points, width), parts: [legend].filter(Boolean) };
    },
  });
}

function drawPoints(options, points, width) {
  const xs = points.map(([px]) => px),
    ys = points.map(([, py]) => py).filter((v) => known(v) && (!options.log || v > 0));
  let low = ys.length ? Math.min(...ys) : 0,
    high = ys.length ? Math.max(...ys) : 1;
  // Differences of less than a hundredth are not blown up to the height of the plot.
  const least = 0.01 * Math.max(Math.abs(low), Math.abs(high));
  if (!options.log && high - low < least) [low, high] = [(low + high - least) / 2, (low + high + least) / 2];
  const yTicks = options.log
    ? powers(low || 1e-12, high || 1)
    : high > low
      ? ticks(low, high, 4)
      : ticks(low - Math.abs(low || 1) / 10, low + Math.abs(low || 1) / 10, 2);
  const [left, right] = [Math.min(...xs), Math.max(...xs)],
    margin = right > left ? (right - left) * 0.04 : 1;
  const xTicks = ticks(left, right > left ? right : left + 1, Math.min(8, Math.floor(width / 60))).filter(
    (t) => t >= left - margin && t <= right + margin,
  );
  const range = (s) => s.points.filter(([, v]) => known(v));
  const label =
    `${options.title}${options.unit ? ` in ${options.unit}` : ""} against ${options.xTitle}. ` +
    options.series
      .map((s) =>
        range(s).length
          ? `${s.label}: from ${fmt(range(s)[0][1], 3)} at ${fmt(range(s)[0][0], 3)} to ` +
            `${fmt(range(s).at(-1)[1], 3)} at ${fmt(range(s).at(-1)[0], 3)}`
          : "",
      )
      .join("; ");
  const made = axes({
    width,
    height: options.height || 214,
    label,
    x: {
      low: left - margin,
      high: right + margin,
      ticks: xTicks,
      title: options.xTitle + (options.xUnit ? `, ${options.xUnit}` : ""),
    },
    y: { low: yTicks[0], high: yTicks[yTicks.length - 1], ticks: yTicks, title: options.unit, log: options.log },
  });
  for (const at of options.separators || [])
    made.back.append(
      svg("line", {
        class: "axis",
        x1: made.x(at),
        x2: made.x(at),
        y1: made.frame.top,
        y2: made.frame.bottom,
        "stroke-dasharray": "4 3",
      }),
    );
  for (const s of options.series) {
    const shown = s.points.map(([px, py], i) => [px, py, i]).filter(([, py]) => known(py) && (!options.log || py > 0));
    if (s.line !== false)
      made.plot.append(
        svg("path", {
          class: "curve",
          d: shown.length
            ? `M${shown.map(([px, py]) => `${made.x(px).toFixed(1)},${made.y(py).toFixed(1)}`).join("L")}`
            : "",
          style: `stroke:${s.color}`,
          "stroke-dasharray": s.dash || "none",
        }),
      );
    if (!s.dots) continue;
    for (const [px, py, i] of shown) {
      made.root.append(
        svg(
          "circle",
          {
            cx: made.x(px),
            cy: made.y(py),
            r: 4,
            style: `fill:${s.colors ? s.colors[i] : s.color};stroke:var(--panel);stroke-width:1`,
          },
          svg("title", {}, `${s.names ? s.names[i] : s.label}: ${fmt(py)} ${options.unit || ""}`),
        ),
      );
    }
  }
  return made.root;
}
