// Where each foot touches the ground, drawn on the foot: its surfaces seen from above, forward is right, left is up.

// Outlines of one foot's surfaces and the way of the contact points over them, in the axes of its link.
function footMap(scene, side) {
  const contacts = scene.contacts.filter((c) => c.side === side);
  const links = new Set(contacts.map((contact) => scene.shapes[contact.shape].link));
  const parts = contacts.map((contact) => {
    const shape = scene.shapes[contact.shape],
      r = rotationOf(shape.rotation);
    const rows = [2, 3, 4].map((k) => scene.tracks[contact.rows + k]);
    const points = Array.from(rows[0], (_, i) =>
      known(rows[0][i])
        ? turn(
            r,
            rows.map((row) => row[i]),
          ).map((v, k) => v + shape.center[k])
        : [NaN, NaN, NaN],
    );
    return { name: contact.name, points };
  });
  const outlines = scene.shapes
    .filter((shape) => links.has(shape.link))
    .map((shape) => ({
      ...outline(shape.center, shape.rotation, shape.axes, PLANES.top),
      points: shape.form ? outlinePoints(shape.center, shape.rotation, shape, PLANES.top) : null,
      part: shape.part,
    }));
  return { parts, outlines };
}

function footPicture(solves, side) {
  const maps = solves.map((solve) => ({ solve, ...footMap(solve.motion.scene, side) }));
  const name = side === SIDES.right ? "right foot" : "left foot";
  return plotCard({
    title: `Contact on the ${name}`,
    note: "seen from above, forward is right",
    legend: solves.map((s) => ({ label: s.label, color: solveColor(s.index), dash: solveDash(s.index) })),
    rows: () => [
      ["gait", "surface", "percent", "forward of the ankle [m]", "left [m]", "up [m]"],
      ...maps.flatMap(({ solve, parts }) =>
        parts.flatMap((part) =>
          part.points
            .map((p, i) => [solve.label, part.name, (100 * i) / (part.points.length - 1), ...p])
            .filter((row) => known(row[3])),
        ),
      ),
    ],
    draw: (width) => ({ drawing: drawFoot(maps, name, width), parts: [] }),
  });
}

// How far forward of the ankle the contact points of a part are, in words.
function reach({ name, points }) {
  const xs = points.map((p) => p[0]).filter(known);
  return xs.length
    ? `${name} from ${fmt(1e3 * Math.min(...xs), 3)} to ${fmt(1e3 * Math.max(...xs), 3)} mm forward of the ankle`
    : `${name} nowhere`;
}

function drawFoot(maps, name, width) {
  const { outlines } = maps[0];
  const extent = (o, axis) =>
    o.points
      ? Math.max(...o.points.map((p) => Math.abs(p[axis] - (axis ? o.v : o.u))))
      : Math.hypot(
          o.a * (axis ? Math.sin(o.angle) : Math.cos(o.angle)),
          o.b * (axis ? Math.cos(o.angle) : Math.sin(o.angle)),
        );
  const low = [0, 1].map((k) => Math.min(...outlines.map((o) => (k ? o.v : o.u) - extent(o, k)))),
    high = [0, 1].map((k) => Math.max(...outlines.map((o) => (k ? o.v : o.u) + extent(o, k))));
  const scale = Math.min((width - 20) / (high[0] - low[0]), 190 / (high[1] - low[1])),
    height = (high[1] - low[1]) * scale + 40;
  const px = (u) => width / 2 + (u - (low[0] + high[0]) / 2) * scale,
    py = (v) => height / 2 - 8 - (v - (low[1] + high[1]) / 2) * scale;
  const root = svg("svg", {
    viewBox: `0 0 ${width} ${height}`,
    role: "img",
    "aria-label":
      `${capital(name)}: points of contact on its surfaces. ${maps[0].solve.label}: ` +
      `${maps[0].parts.map(reach).join("; ")}.`,
  });
  for (const o of outlines) {
    const title = svg("title", {}, o.part);
    if (o.points) {
      const points = o.points.map(([u, v]) => `${px(u).toFixed(1)},${py(v).toFixed(1)}`).join(" ");
      root.append(svg("polygon", { class: "sole", points }, title));
      continue;
    }
    root.append(
      svg(
        "ellipse",
        {
          class: "sole",
          rx: o.a * scale,
          ry: o.b * scale,
          transform: `translate(${px(o.u)} ${py(o.v)}) rotate(${(-o.angle * 180) / Math.PI})`,
        },
        title,
      ),
    );
  }
  root.append(
    svg("line", { class: "zero", x1: 8, x2: 8 + 0.05 * scale, y1: height - 6, y2: height - 6 }),
    svg("text", { x: 8, y: height - 11 }, "50 mm"),
  );
  const dots = maps.flatMap(({ solve, parts }) =>
    parts.map((part) => {
      const d = polylinePieces(part.points.map((p) => (known(p[0]) ? [px(p[0]), py(p[1])] : null)));
      root.append(
        svg("path", {
          class: "curve",
          d,
          style: `stroke:${solveColor(solve.index)}`,
          "stroke-dasharray": solveDash(solve.index) || "none",
        }),
      );
      return { dot: svg("circle", { class: "cursor-dot", r: 4.5, style: `fill:${solveColor(solve.index)}` }), part };
    }),
  );
  root.append(...dots.map(({ dot }) => dot));
  followInstant(root, (percent) => {
    for (const { dot, part } of dots) {
      const p = part.points[Math.floor((percent / 100) * (part.points.length - 1))];
      dot.style.visibility = known(p[0]) ? "visible" : "hidden";
      if (known(p[0])) {
        dot.setAttribute("cx", px(p[0]));
        dot.setAttribute("cy", py(p[1]));
      }
    }
  });
  return root;
}

// A path through points; null begins a new piece.
function polylinePieces(points) {
  let pen = "M";
  return points
    .map((p) => {
      if (!p) {
        pen = "M";
        return "";
      }
      const text = `${pen}${p[0].toFixed(1)},${p[1].toFixed(1)}`;
      pen = "L";
      return text;
    })
    .join("");
}

function feet() {
  const sides = [SIDES.left, SIDES.right].filter((side) =>
    MOVING[0].motion.scene.contacts.some((c) => c.side === side),
  );
  const alike = MOVING.filter(
    (s) =>
      JSON.stringify(s.motion.scene.contacts.map((c) => c.name)) ===
      JSON.stringify(MOVING[0].motion.scene.contacts.map((c) => c.name)),
  );
  if (!sides.length) return;
  section(
    "Contact on the feet",
    "The way of each contact point over the surfaces of the foot during stance; a dot is where the foot touches " +
      "now. The outlines are those of the first gait.",
    MANY ? gaitLegend() : null,
    el(
      "div",
      { class: "grid two" },
      sides.map((side) => footPicture(alike, side)),
    ),
  );
}
