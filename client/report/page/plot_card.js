// The card of a plot: heading, legend, drawing at the width that there is, and its files.
const redrawn = new Map(); // box -> draw

const resizes = new ResizeObserver((entries) => {
  for (const entry of entries) {
    const width = Math.round(entry.contentRect.width),
      draw = redrawn.get(entry.target);
    if (draw && width > 0 && draw.width !== width) draw(width);
  }
});

// Calls draw(width) with the width of the box in pixels, now and when it changes.
function drawInto(box, draw) {
  const run = (width) => {
    run.width = width;
    draw(width);
  };
  redrawn.set(box, run);
  resizes.observe(box);
}

// What a drawing needs to stand alone: colours and fonts of the style sheet, a title and the legend.
function standalone(drawing, title, legend) {
  const copy = drawing.cloneNode(true);
  const from = [drawing, ...drawing.querySelectorAll("*")],
    to = [copy, ...copy.querySelectorAll("*")];
  const properties = [
    "fill",
    "fill-opacity",
    "stroke",
    "stroke-width",
    "stroke-dasharray",
    "opacity",
    "font-size",
    "font-family",
    "text-anchor",
  ];
  from.forEach((element, i) => {
    const style = getComputedStyle(element);
    to[i].setAttribute("style", properties.map((p) => `${p}:${style.getPropertyValue(p)}`).join(";"));
  });
  for (const mark of copy.querySelectorAll(".cursor")) mark.remove();
  const [, , width, height] = drawing.getAttribute("viewBox").split(" ").map(Number);
  const top = 24 + 16 * Math.ceil(legend.length / 3);
  const ink = colorValue("var(--ink)"),
    paper = colorValue("var(--paper)");
  const head = svg(
    "g",
    { "font-family": "sans-serif", "font-size": "12", fill: ink },
    svg("text", { x: 4, y: -top + 14, "font-weight": "bold" }, title),
  );
  legend.forEach(({ label, color, dash }, i) => {
    const x = 4 + (i % 3) * (width / 3),
      y = -top + 30 + 16 * Math.floor(i / 3);
    head.append(
      svg("line", {
        x1: x,
        x2: x + 18,
        y1: y - 4,
        y2: y - 4,
        stroke: colorValue(color),
        "stroke-width": 2,
        "stroke-dasharray": dash || null,
      }),
      svg("text", { x: x + 23, y }, label),
    );
  });
  copy.prepend(svg("rect", { x: 0, y: -top, width, height: height + top, fill: paper }));
  copy.append(head);
  copy.setAttribute("viewBox", `0 ${-top} ${width} ${height + top}`);
  copy.setAttribute("width", width);
  copy.setAttribute("height", height + top);
  copy.setAttribute("xmlns", SVG);
  return new XMLSerializer().serializeToString(copy);
}

// options: title, note; rows(): the table of the CSV file; legend: [{label, color, dash}] of the SVG file;
// draw(width): {drawing, parts} with the SVG element and what stands above it. Returns the card.
function plotCard(options) {
  const head = el("h3", {}, options.title),
    note = el("span", { class: "soft" }, options.note || "");
  const body = el("div", { class: "plot" });
  let drawing = null;
  const files = el(
    "span",
    { class: "files" },
    button("CSV", () => download(`${fileName(options.title)}.csv`, "text/csv", toCsv(options.rows())), {
      "aria-label": `${options.title}: numbers as CSV`,
    }),
    button(
      "SVG",
      () =>
        download(
          `${fileName(options.title)}.svg`,
          "image/svg+xml",
          standalone(drawing, options.title, options.legend || []),
        ),
      { "aria-label": `${options.title}: drawing as SVG` },
    ),
  );
  const card = el("figure", { class: "card" }, el("div", { class: "head" }, head, note, files), body);
  card.redraw = () => {
    const width = Math.round(body.clientWidth);
    if (width > 0) paint(width);
  };
  const paint = (width) => {
    const made = options.draw(width);
    drawing = made.drawing;
    body.replaceChildren(...made.parts, drawing);
  };
  drawInto(body, paint);
  return card;
}

// Axes with ticks and labels in an SVG element of its own. Returns {root, plot, x, y, frame}: `plot` is clipped to the
// frame.
let clips = 0;
// As many digits as tell neighbouring ticks apart.
function tickText(axis, mark) {
  const step = axis.ticks.length > 1 ? Math.abs(axis.ticks[1] - axis.ticks[0]) : 1;
  return axis.log || mark === 0 ? fmt(mark) : fmt(mark, Math.max(4, Math.ceil(Math.log10(Math.abs(mark) / step)) + 2));
}

function axes({ width, height, label, x, y }) {
  const frame = { left: 48, right: width - 8, top: 8, bottom: height - (x.title ? 34 : 20) };
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label });
  const along = (axis, value) =>
    axis.log
      ? (Math.log10(value) - Math.log10(axis.low)) / (Math.log10(axis.high) - Math.log10(axis.low))
      : (value - axis.low) / (axis.high - axis.low);
  const px = (value) => frame.left + along(x, value) * (frame.right - frame.left);
  const py = (value) => frame.bottom - along(y, value) * (frame.bottom - frame.top);
  const back = svg("g");
  root.append(back);
  for (const mark of y.ticks) {
    root.append(
      svg("line", { class: mark === 0 ? "zero" : "axis", x1: frame.left, x2: frame.right, y1: py(mark), y2: py(mark) }),
      svg("text", { x: frame.left - 6, y: py(mark) + 4, "text-anchor": "end" }, tickText(y, mark)),
    );
  }
  let end = -Infinity;
  for (const mark of x.ticks) {
    const text = tickText(x, mark),
      half = 3.3 * text.length,
      at = px(mark);
    root.append(svg("line", { class: "axis", x1: at, x2: at, y1: frame.bottom, y2: frame.bottom + 4 }));
    if (at - half < end + 4) continue;
    root.append(svg("text", { x: at, y: frame.bottom + 16, "text-anchor": "middle" }, text));
    end = at + half;
  }
  if (x.title)
    root.append(svg("text", { x: (frame.left + frame.right) / 2, y: height - 4, "text-anchor": "middle" }, x.title));
  if (y.title)
    root.append(
      svg(
        "text",
        { transform: `translate(10 ${(frame.top + frame.bottom) / 2}) rotate(-90)`, "text-anchor": "middle" },
        y.title,
      ),
    );
  const clip = `frame${++clips}`;
  root.append(
    svg(
      "clipPath",
      { id: clip },
      svg("rect", {
        x: frame.left,
        y: frame.top - 1,
        width: frame.right - frame.left,
        height: frame.bottom - frame.top + 2,
      }),
    ),
  );
  const plot = svg("g", { "clip-path": `url(#${clip})` });
  root.append(plot);
  return { root, back, plot, x: px, y: py, frame };
}
