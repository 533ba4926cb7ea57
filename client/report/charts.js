"use strict";
// Small helpers and the line chart. Numbers come from the data element; nothing is fetched.
const DATA = JSON.parse(document.getElementById("data").textContent);
const SVG = "http://www.w3.org/2000/svg";

// An element with attributes and children; strings become text.
function el(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "on") for (const [event, handler] of Object.entries(value)) element.addEventListener(event, handler);
    else if (value !== null && value !== undefined) element.setAttribute(key, value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

function svg(name, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children.flat());
  return element;
}

// A number for a person: `digits` significant digits, a true minus sign, powers of ten where they are shorter.
function fmt(value, digits = 4) {
  if (value === null || value === undefined || !isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(Math.max(digits - 2, 1)).split("e");
    const superscript = exponent.replace("+", "").replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
    return mantissa.replace("-", "−") + "·10" + superscript;
  }
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

const solveColor = (index) => `var(--c${index % 6})`;
const jointColor = (index) => `var(--j${index % 4})`;
const DASHES = ["", "7 4", "2 3", "9 3 2 3"];

// Round tick positions that cover [low, high].
function ticks(low, high, count) {
  const raw = (high - low) / Math.max(count, 1);
  const power = Math.pow(10, Math.floor(Math.log10(raw)));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const list = [];
  for (let i = Math.floor(low / step + 1e-9); i * step <= high + 0.999 * step; ++i) list.push(Number((i * step).toPrecision(12)));
  return list;
}

// Everything that shows the current instant: called with a percentage of the gait cycle.
const cursors = [];
let instant = 0;
function showPercent(percent, except) {
  instant = percent;
  for (const cursor of cursors) if (cursor !== except) cursor(percent);
}

function valueAt(values, percent) {
  const place = Math.min(Math.max(percent / 100, 0), 1) * (values.length - 1);
  const index = Math.min(Math.floor(place), values.length - 2);
  const share = place - index;
  if (values[index] === null || values[index + 1] === null) return null;
  return values[index] * (1 - share) + values[index + 1] * share;
}

const BOX = { width: 372, height: 232, left: 50, right: 8, top: 10, bottom: 36 };

// The whole range of the values, and one that a few spikes do not stretch: the middle 99 % with a margin.
function ranges(values) {
  const sorted = values.filter((v) => v !== null && isFinite(v)).sort((a, b) => a - b);
  const full = [Math.min(0, sorted[0]), Math.max(0, sorted[sorted.length - 1])];
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  const low = Math.min(0, at(0.005)), high = Math.max(0, at(0.995)), margin = 0.15 * (high - low);
  const middle = [Math.max(low - margin, full[0]), Math.min(high + margin, full[1])];
  return { full, middle, spiky: full[1] - full[0] > 1.5 * (middle[1] - middle[0]) };
}

// A chart of curves over the gait cycle as a card. If spikes would flatten the curves they are cut, the card says so, and
// a button shows them.
//   options: title, note, unit, axis (what the percentage is of), width (of the drawing), pool (values that set the range; default: those of the series),
//   bands ([{start, end}] in %), ribbons ([{label, low, high, style}], areas between two curves, behind the others),
//   series [{label, color, dash, opacity, values, mark}] where `mark` is a percentage (toe-off) or null
function chart(options) {
  const range = ranges(options.pool || [...options.series.flatMap((s) => s.values), ...(options.ribbons || []).flatMap((r) => [...r.low, ...r.high])]);
  const card = el("figure", { class: "card", style: "margin:0" });
  const draw = (whole) => {
    const extent = whole || !range.spiky ? range.full : range.middle;
    card.replaceChildren(...drawChart(options, extent));
    if (!range.spiky) return;
    const own = options.series.flatMap((s) => s.values).filter((v) => v !== null);
    const axis = ticks(extent[0], extent[1], 5);
    const cut = Math.min(...own) < axis[0] || Math.max(...own) > axis[axis.length - 1];
    const words = whole ? "whole range shown" : cut ? `peaks cut: ${fmt(Math.min(...own), 3)} to ${fmt(Math.max(...own), 3)} ${options.unit}` : "";
    card.append(el("div", { class: "range" }, words, " ", el("button", { type: "button", on: { click: () => draw(!whole) } }, whole ? "cut peaks" : "show all")));
  };
  draw(false);
  return card;
}

let charts = 0;
// Heading, legend and drawing of a chart between two values.
function drawChart(options, [low, high]) {
  const { height, left, right, top, bottom } = BOX;
  const width = options.width || BOX.width;
  if (!(high > low)) [low, high] = [low - 1, high + 1];
  const marks = ticks(low, high, 5);
  [low, high] = [marks[0], marks[marks.length - 1]];
  const x = (percent) => left + (percent / 100) * (width - left - right);
  const y = (value) => top + ((high - value) / (high - low)) * (height - top - bottom);

  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${options.title} in ${options.unit} over the gait cycle` });
  for (const band of options.bands || []) {
    root.append(svg("rect", { class: "band", x: x(band.start), y: top, width: x(band.end) - x(band.start), height: height - top - bottom }));
  }
  for (const mark of marks) {
    root.append(svg("line", { class: mark === 0 ? "zero" : "axis", x1: left, x2: width - right, y1: y(mark), y2: y(mark) }));
    root.append(svg("text", { x: left - 6, y: y(mark) + 4, "text-anchor": "end" }, fmt(mark)));
  }
  for (const percent of [0, 20, 40, 60, 80, 100]) {
    root.append(svg("line", { class: "axis", x1: x(percent), x2: x(percent), y1: height - bottom, y2: height - bottom + 4 }));
    root.append(svg("text", { x: x(percent), y: height - bottom + 16, "text-anchor": "middle" }, String(percent)));
  }
  root.append(svg("text", { x: (left + width - right) / 2, y: height - 5, "text-anchor": "middle" }, options.axis || "% of gait cycle"));
  root.append(svg("text", { transform: `translate(9 ${(top + height - bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, options.unit));
  const clip = `plot${++charts}`;
  root.append(svg("clipPath", { id: clip }, svg("rect", { x: left, y: top - 1, width: width - left - right, height: height - top - bottom + 2 })));
  const polygon = (values) => values.map((v, i) => `${x((100 * i) / (values.length - 1)).toFixed(1)},${y(v).toFixed(1)}`);
  for (const ribbon of options.ribbons || []) {
    root.append(svg("polygon", { "clip-path": `url(#${clip})`, points: [...polygon(ribbon.low), ...polygon(ribbon.high).reverse()].join(" "), style: ribbon.style }));
  }
  for (const s of options.series) {
    const points = s.values.map((v, i) => [x((100 * i) / (s.values.length - 1)), v]).filter(([, v]) => v !== null).map(([px, v]) => `${px.toFixed(1)},${y(v).toFixed(1)}`);
    root.append(svg("polyline", { class: "curve", "clip-path": `url(#${clip})`, points: points.join(" "), style: `stroke:${s.color};stroke-width:${s.width || 2};opacity:${s.opacity || 1}`, "stroke-dasharray": s.dash || "none" }));
    if (s.mark !== null && s.mark !== undefined) {
      root.append(svg("path", { d: `M${x(s.mark) - 4},${height - bottom} h8 l-4,-7 z`, style: `fill:${s.color}` }, svg("title", {}, `toe-off at ${fmt(s.mark, 3)} %`)));
    }
  }
  const cursor = svg("line", { class: "cursor", y1: top, y2: height - bottom, x1: -9, x2: -9 });
  root.append(cursor);

  const readouts = options.series.map(() => el("b"));
  const where = el("span", { class: "soft" });
  const legend = el("div", { class: "legend" }, options.series.map((s, i) =>
    el("span", {}, el("span", { class: "swatch", style: `border-color:${s.color};border-top-style:${s.dash ? (s.dash === DASHES[2] ? "dotted" : "dashed") : "solid"};opacity:${s.opacity || 1}` }), s.label + " ", readouts[i])),
    (options.ribbons || []).map((r) => el("span", {}, el("span", { class: "swatch area", style: r.swatch }), r.label)));
  const show = (percent) => {
    cursor.setAttribute("x1", x(percent));
    cursor.setAttribute("x2", x(percent));
    options.series.forEach((s, i) => { readouts[i].textContent = fmt(valueAt(s.values, percent), 3); });
    where.textContent = `${options.note ? "· " : ""}${percent.toFixed(1)} %`;
  };
  cursors.push(show);
  show(instant);
  root.addEventListener("pointermove", (event) => {
    const box = root.getBoundingClientRect();
    const percent = ((((event.clientX - box.left) / box.width) * width - left) / (width - left - right)) * 100;
    if (percent >= 0 && percent <= 100) {
      show(percent);
      showPercent(percent, show);
    }
  });
  return [el("h3", {}, options.title, el("span", { class: "soft" }, options.note || "", " ", where)), legend, root];
}
