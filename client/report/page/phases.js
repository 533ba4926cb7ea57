// When each foot and each of its surfaces is on the ground, and the events of each foot.

// The bars of one gait: events of the right foot above, of the left foot below, each on the first line where it has
// room.
function phaseBar(solve) {
  const stride = solve.stride;
  const both =
    stride.double_support === null
      ? ""
      : `, double support ${share(stride.double_support)}, stance of the right foot ${share(rightFoot(stride).stance)}`;
  return plotCard({
    title: `Phases, ${solve.label}`,
    note: `stride ${fmt(stride.duration, 3)} s, ${fmt(stride.displacement, 3)} m${both}`,
    rows: () => [
      ["kind", "what", "start [%]", "end [%]"],
      ...stride.phases.map((p) => [
        "phase",
        [supportName(p.feet), ...p.contacts.map(words)].join(" + "),
        p.start,
        p.end,
      ]),
      ...stride.events.map((e) => ["event", `${e.foot} ${e.name}`, e.percent, null]),
    ],
    draw: (width) => ({ drawing: drawPhases(solve, width), parts: [] }),
  });
}

// Lines of labels under or over the bars: [{words, middle, level}] without overlap.
function placeLabels(events, x, low, high) {
  const ends = [];
  return events.map((event) => {
    const words = `${event.name} ${fmt(event.percent, 3)} %`,
      half = 3.1 * words.length;
    const middle = Math.min(Math.max(x(event.percent), low + half), high - half);
    let level = ends.findIndex((end) => end + 6 < middle - half);
    if (level < 0) level = ends.length;
    ends[level] = middle + half;
    return { ...event, words, middle, level };
  });
}

function drawPhases(solve, width) {
  const stride = solve.stride,
    left = 96,
    right = 12,
    row = 18,
    line = 14;
  const x = (percent) => left + (percent / 100) * (width - left - right);
  const contacts = [...stride.scene.contacts].sort(
    (a, b) => (a.side === SIDES.right ? 0 : 1) - (b.side === SIDES.right ? 0 : 1),
  );
  const above = placeLabels(
      stride.events.filter((e) => e.foot === "right"),
      x,
      0,
      width,
    ),
    below = placeLabels(
      stride.events.filter((e) => e.foot === "left"),
      x,
      0,
      width,
    );
  const levels = (list) => Math.max(0, ...list.map((event) => event.level + 1));
  const top = 22 + line * levels(above),
    bottom = top + contacts.length * (row + 5);
  const tall = bottom + line * levels(below) + 14;
  const words = stride.phases
    .map((p) => `${supportName(p.feet)} from ${fmt(p.start, 3)} to ${fmt(p.end, 3)} %`)
    .join(", ");
  const root = svg("svg", {
    viewBox: `0 0 ${width} ${tall}`,
    role: "img",
    "aria-label":
      `Phases at ${solve.label}: ${words}. Events: ` +
      `${stride.events.map((e) => `${e.foot} ${e.name} at ${fmt(e.percent, 3)} %`).join(", ")}.`,
  });
  for (const phase of mergeByFeet(stride.phases)) {
    const middle = (x(phase.start) + x(phase.end)) / 2,
      wide = x(phase.end) - x(phase.start);
    if (phase.feet > 1)
      root.append(svg("rect", { class: "band", x: x(phase.start), y: top - 4, width: wide, height: bottom - top + 4 }));
    const long = `${supportName(phase.feet)} ${fmt(phase.end - phase.start, 3)} %`,
      short = `${fmt(phase.end - phase.start, 3)} %`;
    const text = wide > 6.2 * long.length ? long : wide > 6.2 * short.length ? short : "";
    if (text) root.append(svg("text", { class: "phase-name", x: middle, y: 12, "text-anchor": "middle" }, text));
  }
  contacts.forEach((contact, i) => {
    const y = top + i * (row + 5);
    root.append(svg("text", { x: left - 8, y: y + 13, "text-anchor": "end" }, contact.name));
    for (const phase of mergeByContact(stride.phases, contact.name)) {
      root.append(
        svg("rect", {
          x: x(phase.start),
          y,
          width: Math.max(x(phase.end) - x(phase.start), 0),
          height: row,
          style: `fill:${solveColor(solve.index)};fill-opacity:${contact.side === SIDES.right ? 0.9 : 0.4}`,
        }),
      );
    }
  });
  for (const [list, sign, edge] of [
    [above, -1, top - 7],
    [below, 1, bottom + 11],
  ]) {
    for (const event of list) {
      const y = edge + sign * line * event.level;
      root.append(
        svg("line", {
          class: "zero",
          x1: x(event.percent),
          x2: x(event.percent),
          y1: sign < 0 ? y + 3 : top - 4,
          y2: sign < 0 ? bottom : y - 10,
        }),
      );
      root.append(svg("text", { class: "event", x: event.middle, y, "text-anchor": "middle" }, event.words));
    }
  }
  const cursor = svg("line", { class: "cursor", y1: top - 4, y2: bottom, x1: 0, x2: 0 });
  root.append(cursor);
  followInstant(root, (percent) => cursor.setAttribute("transform", `translate(${x(percent).toFixed(1)} 0)`));
  return root;
}

// Neighbours with the same number of feet on the ground as one.
function mergeByFeet(phases) {
  const merged = [];
  for (const phase of phases) {
    const last = merged[merged.length - 1];
    if (last && last.feet === phase.feet) last.end = phase.end;
    else merged.push({ start: phase.start, end: phase.end, feet: phase.feet });
  }
  return merged;
}

// Stretches in which a surface is on the ground.
function mergeByContact(phases, name) {
  const merged = [];
  for (const phase of phases.filter((p) => p.contacts.map(words).includes(name))) {
    const last = merged[merged.length - 1];
    if (last && last.end === phase.start) last.end = phase.end;
    else merged.push({ start: phase.start, end: phase.end });
  }
  return merged;
}

// Of many gaits: two thin bars a gait, right foot over left foot.
function phaseRows(solves) {
  return plotCard({
    title: "Stance of both feet",
    note: "upper bar: right foot, lower bar: left foot",
    rows: () => [
      ["gait", "kind", "start [%]", "end [%]"],
      ...solves.flatMap((s) => mergeByFeet(s.stride.phases).map((p) => [s.label, supportName(p.feet), p.start, p.end])),
    ],
    draw: (width) => ({ drawing: drawRows(solves, width), parts: [] }),
  });
}

function drawRows(solves, width) {
  const left = 76,
    row = 19,
    top = 4,
    bottom = top + row * solves.length;
  const x = (percent) => left + (percent / 100) * (width - left - 10);
  const root = svg("svg", {
    viewBox: `0 0 ${width} ${bottom + 34}`,
    role: "img",
    "aria-label": `Stance of both feet of ${solves.length} gaits over the cycle`,
  });
  solves.forEach((solve, i) => {
    const y = top + i * row,
      color = solveColor(solve.index);
    root.append(svg("text", { x: left - 8, y: y + 13, "text-anchor": "end" }, solve.label));
    solve.stride.scene.contacts.forEach((contact) => {
      const right = contact.side === SIDES.right;
      for (const phase of mergeByContact(solve.stride.phases, contact.name)) {
        root.append(
          svg("rect", {
            x: x(phase.start),
            y: y + (right ? 1 : 9),
            width: x(phase.end) - x(phase.start),
            height: 7,
            style: `fill:${right ? color : `color-mix(in srgb, ${color} 55%, var(--panel))`}`,
          }),
        );
      }
    });
  });
  for (const percent of [0, 20, 40, 60, 80, 100])
    root.append(
      svg("line", { class: "axis", x1: x(percent), x2: x(percent), y1: top, y2: bottom + 4 }),
      svg("text", { x: x(percent), y: bottom + 16, "text-anchor": "middle" }, String(percent)),
    );
  root.append(svg("text", { x: (left + width) / 2, y: bottom + 31, "text-anchor": "middle" }, "% of gait cycle"));
  const cursor = svg("line", { class: "cursor", y1: top, y2: bottom, x1: 0, x2: 0 });
  root.append(cursor);
  followInstant(root, (percent) => cursor.setAttribute("transform", `translate(${x(percent).toFixed(1)} 0)`));
  return root;
}

function phases() {
  const note = "From right heel strike to right heel strike. Grey: both feet are on the ground.";
  if (MANY) section("Phases", note, phaseRows(MOVING));
  else
    section("Phases", `${note} Events of the right foot above the bars, of the left foot below.`, MOVING.map(phaseBar));
}
