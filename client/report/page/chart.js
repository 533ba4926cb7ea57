// Curves over the gait cycle.
const HEIGHT = 214;
const polyline = (values, x, y) => {
  const parts = [];
  let open = [];
  values.forEach((value, i) => {
    if (known(value)) open.push(`${x((100 * i) / (values.length - 1)).toFixed(1)},${y(value).toFixed(1)}`);
    else if (open.length) {
      parts.push(open);
      open = [];
    }
  });
  if (open.length) parts.push(open);
  return parts.map((part) => `M${part.join("L")}`).join("");
};

// What a curve does, in words.
function describe(series, unit) {
  const words = series.map((s) => {
    const values = Array.from(s.values).filter(known);
    if (!values.length) return `${s.label}: no values`;
    const low = Math.min(...values),
      high = Math.max(...values),
      at = (v) => (100 * Array.from(s.values).indexOf(v)) / (s.values.length - 1);
    return `${s.label}: ${fmt(low, 3)} at ${fmt(at(low), 3)} % to ${fmt(high, 3)} ${unit} at ${fmt(at(high), 3)} %`;
  });
  return words.slice(0, 2 * FEW).join("; ") + (words.length > 2 * FEW ? `; and ${words.length - 2 * FEW} more` : "");
}

// A card of curves. options: title, unit, note; series: [{label, color, dash, opacity, width, values, mark}], values at
// equal steps from 0 to 100 %, mark: a percentage on the axis with markName; bands: [{start, end}] shaded; ribbons:
// [{label, low, high, style}]; limits: [value]; pool: values that set the scale with those of other charts; axis: what
// 0 to 100 % is. If spikes would flatten the curves they are cut, the card says so, and a button shows them.
function chart(options) {
  const own = options.series.flatMap((s) => Array.from(s.values)).filter(known);
  const ribbons = (options.ribbons || []).flatMap((r) => [...r.low, ...r.high]);
  const range = ranges([...(options.pool || own), ...ribbons]);
  const named = options.series.length <= 2 * FEW && !options.shared;
  let whole = false;
  const card = plotCard({
    title: options.title,
    note: options.note,
    legend: options.series.map((s) => ({ label: s.label, color: s.color, dash: s.dash })),
    rows: () => [
      [
        "percent",
        ...options.series.map((s) => `${s.label} [${options.unit}]`),
        ...(options.ribbons || []).flatMap((r) => [`${r.label} low`, `${r.label} high`]),
      ],
      ...Array.from({ length: options.series[0].values.length }, (_, i) => {
        const percent = (100 * i) / (options.series[0].values.length - 1);
        return [
          percent,
          ...options.series.map((s) => s.values[i]),
          ...(options.ribbons || []).flatMap((r) => [valueAt(r.low, percent), valueAt(r.high, percent)]),
        ];
      }),
    ],
    draw: (width) => {
      const extent = whole || !range.spiky ? range.full : range.middle;
      const { root, legend, cut } = drawCurves(options, extent, width, own, named);
      const words = whole
        ? "whole range shown"
        : cut
          ? `peaks cut: ${fmt(Math.min(...own), 3)} to ${fmt(Math.max(...own), 3)} ${options.unit}`
          : "";
      const spikes =
        range.spiky && (whole || cut)
          ? el(
              "div",
              { class: "range" },
              words,
              button(whole ? "cut peaks" : "show all", () => {
                whole = !whole;
                card.redraw();
              }),
            )
          : null;
      return { drawing: root, parts: [legend, spikes].filter(Boolean) };
    },
  });
  return card;
}

function drawCurves(options, [low, high], width, own, named) {
  if (!(high > low)) [low, high] = [low - 1, high + 1];
  const marks = ticks(low, high, 5);
  const { root, back, plot, x, y, frame } = axes({
    width,
    height: options.height || HEIGHT,
    label:
      `${options.title} in ${options.unit} over ${options.axis || "the gait cycle"}. ` +
      `${describe(options.series, options.unit)}.`,
    x: { low: 0, high: 100, ticks: [0, 20, 40, 60, 80, 100], title: options.axis || "% of gait cycle" },
    y: { low: marks[0], high: marks[marks.length - 1], ticks: marks, title: options.unit },
  });
  const cut = own.length && (Math.min(...own) < marks[0] || Math.max(...own) > marks[marks.length - 1]);
  for (const band of options.bands || [])
    back.append(
      svg("rect", {
        class: "band",
        x: x(band.start),
        y: frame.top,
        width: x(band.end) - x(band.start),
        height: frame.bottom - frame.top,
      }),
    );
  const edge = (values) =>
    Array.from(values, (v, i) => `${x((100 * i) / (values.length - 1)).toFixed(1)},${y(v).toFixed(1)}`);
  for (const ribbon of options.ribbons || [])
    plot.append(
      svg("polygon", { points: [...edge(ribbon.low), ...edge(ribbon.high).reverse()].join(" "), style: ribbon.style }),
    );
  for (const limit of (options.limits || []).filter((l) => known(l) && l > marks[0] && l < marks[marks.length - 1])) {
    plot.append(
      svg(
        "line",
        { class: "limit", x1: frame.left, x2: frame.right, y1: y(limit), y2: y(limit) },
        svg("title", {}, `limit of the joint: ${fmt(limit)} ${options.unit}`),
      ),
    );
  }
  for (const s of options.series) {
    plot.append(
      svg("path", {
        class: "curve",
        d: polyline(s.values, x, y),
        style: `stroke:${s.color};stroke-width:${s.width || (named ? 2 : 1.4)};opacity:${s.opacity || 1}`,
        "stroke-dasharray": s.dash || "none",
      }),
    );
    if (known(s.mark) && named)
      root.append(
        svg(
          "path",
          { d: `M${x(s.mark) - 4},${frame.bottom} h8 l-4,-7 z`, style: `fill:${s.color};opacity:${s.opacity || 1}` },
          svg("title", {}, `${s.label}: toe-off at ${fmt(s.mark, 3)} %`),
        ),
      );
  }
  const cursor = svg("line", { class: "cursor", y1: frame.top, y2: frame.bottom, x1: 0, x2: 0 });
  root.append(cursor);
  const readouts = named ? options.series.map(() => el("b")) : [];
  const near = el("span", { class: "soft" });
  const legend = el(
    "div",
    { class: "legend" },
    named ? options.series.map((s, i) => el("span", {}, lineMark(s), `${s.label} `, readouts[i])) : near,
    (options.ribbons || []).map((r) => el("span", {}, el("span", { class: "swatch area", style: r.swatch }), r.label)),
  );
  const follow = (percent) => {
    cursor.setAttribute("transform", `translate(${x(percent).toFixed(1)} 0)`);
    readouts.forEach((readout, i) => {
      readout.textContent = fmt(valueAt(options.series[i].values, percent), 3);
    });
  };
  followInstant(root, follow);
  root.addEventListener("pointermove", (event) => {
    const box = root.getBoundingClientRect();
    const percent =
      (((event.clientX - box.left) * (width / box.width) - frame.left) / (frame.right - frame.left)) * 100;
    if (percent < 0 || percent > 100) return;
    showPercent(percent);
    if (named) return;
    const level = (event.clientY - box.top) * (width / box.width);
    const distance = (s) => Math.abs(y(valueAt(s.values, percent) ?? Infinity) - level);
    const nearest = options.series.reduce((best, s) => (distance(s) < distance(best) ? s : best));
    near.textContent =
      `${nearest.label}: ${fmt(valueAt(nearest.values, percent), 3)} ${options.unit} at ` + `${percent.toFixed(1)} %`;
  });
  return { root, legend, cut };
}

// The piece of line that stands for a series in a legend.
function lineMark(s) {
  const line = !s.dash ? "solid" : s.dash === DASHES[2] ? "dotted" : "dashed";
  const style = `border-color:${s.color};border-top-style:${line};opacity:${s.opacity || 1}`;
  return el("span", { class: "swatch", style });
}
