// The walker: stick figure, feet, ground, forces; as animation and as snapshots.
const SCALE = 185; // pixels a metre in the animation
const FORCE_M = 0.006; // metres of arrow for one per cent of body weight
const LONGEST_FORCE = 200; // % of body weight; longer arrows are cut

function mix(a, b, share) {
  return a.map((value, i) => value * (1 - share) + b[i] * share);
}

// The frame at a percentage of the cycle, between two samples.
function frameAt(stride, percent) {
  const walker = stride.walker;
  const place = Math.min(Math.max(percent / 100, 0), 1) * (walker.points.length - 1);
  const index = Math.min(Math.floor(place), walker.points.length - 2);
  const share = place - index;
  const feet = walker.feet[index].map((foot, c) => {
    const next = walker.feet[index + 1][c].slice();
    // The axis of an ellipse has no direction: take the turn that is shorter.
    if (next[4] - foot[4] > Math.PI / 2) next[4] -= Math.PI;
    if (next[4] - foot[4] < -Math.PI / 2) next[4] += Math.PI;
    // A force that begins or ends does so at once.
    const held = mix(foot, next, share);
    if (foot[8] === 0 || next[8] === 0) { held[7] = foot[7]; held[8] = foot[8]; }
    return held;
  });
  return { points: mix(walker.points[index], walker.points[index + 1], share), feet, center: walker.center.length ? mix(walker.center[index], walker.center[index + 1], share) : null };
}

// The marks of a walker in a group of its own; `update(frame)` moves them. The group's axes are metres, x forward, z up.
function figure(stride, color, withForces) {
  const group = svg("g");
  const walker = stride.walker;
  const paint = (side) => (side === 0 ? "var(--ink)" : color);
  const order = [2, 0, 1]; // the far side first
  const limbs = [], feet = [], arrows = [];
  for (const side of order) {
    walker.foot_sides.forEach((footSide, c) => {
      if (footSide !== side) return;
      const ellipse = svg("ellipse", { style: `fill:${paint(side)};stroke:${paint(side)};stroke-width:0.012;fill-opacity:${side === 2 ? 0.12 : 0.3};opacity:${side === 2 ? 0.6 : 1}` });
      feet.push([ellipse, c]);
      group.append(ellipse);
    });
    for (const [from, to, segmentSide] of walker.segments) {
      if (segmentSide !== side) continue;
      const line = svg("line", { "stroke-linecap": "round", style: `stroke:${paint(side)};stroke-width:${side === 0 ? 0.05 : 0.04};opacity:${side === 2 ? 0.4 : 1}` });
      limbs.push([line, from, to]);
      group.append(line);
    }
  }
  const center = svg("circle", { r: 0.022, style: "fill:var(--paper);stroke:var(--ink);stroke-width:0.012" });
  if (walker.center.length) group.append(center);
  if (withForces) {
    walker.foot_sides.forEach((side, c) => {
      const arrow = svg("path", { class: "force", style: "stroke:var(--bad);fill:none;stroke-width:0.014;stroke-linejoin:round" });
      const dot = svg("circle", { class: "force", r: 0.014, style: "fill:var(--bad)" });
      arrows.push([arrow, dot, c]);
      group.append(arrow, dot);
    });
  }
  const update = (frame) => {
    const p = frame.points;
    for (const [line, from, to] of limbs) {
      line.setAttribute("x1", p[2 * from]); line.setAttribute("y1", p[2 * from + 1]);
      line.setAttribute("x2", p[2 * to]); line.setAttribute("y2", p[2 * to + 1]);
    }
    for (const [ellipse, c] of feet) {
      const [x, z, a, b, angle] = frame.feet[c];
      ellipse.setAttribute("rx", a); ellipse.setAttribute("ry", b);
      ellipse.setAttribute("transform", `translate(${x} ${z}) rotate(${(angle * 180) / Math.PI})`);
    }
    if (frame.center) { center.setAttribute("cx", frame.center[0]); center.setAttribute("cy", frame.center[1]); }
    for (const [arrow, dot, c] of arrows) {
      const [, , , , , x, z, fx, fz] = frame.feet[c];
      const shown = fz !== 0 || fx !== 0;
      arrow.style.visibility = dot.style.visibility = shown ? "visible" : "hidden";
      if (!shown) continue;
      const cut = Math.min(1, LONGEST_FORCE / Math.max(Math.hypot(fx, fz), 1e-9)) * FORCE_M;
      const dx = fx * cut, dz = fz * cut, length = Math.hypot(dx, dz) || 1;
      const head = Math.min(0.05, 0.4 * length), ux = dx / length, uz = dz / length;
      arrow.setAttribute("d", `M${x},${z} l${dx},${dz} m${-head * ux - head * 0.5 * uz},${-head * uz + head * 0.5 * ux} l${head * ux + head * 0.5 * uz},${head * uz - head * 0.5 * ux} l${-head * ux + head * 0.5 * uz},${-head * uz - head * 0.5 * ux}`);
      dot.setAttribute("cx", x); dot.setAttribute("cy", z);
    }
  };
  return { group, update };
}

// What stands on the ground at a percentage, in words.
function phaseAt(stride, percent) {
  if (!stride.phases.length) return "";
  const phase = stride.phases.find((p) => percent < p.end) || stride.phases[stride.phases.length - 1];
  const names = phase.contacts.map((name) => name.replace("_", " "));
  return [supportName(phase.feet), ...names].join(", ");
}

// One panel of the animation; follows the walker.
function animationPanel(solve, index, height) {
  const stride = solve.stride;
  const width = 372, tall = Math.round(SCALE * (height + 0.42));
  const degrees = (solve.slope_rad * 180) / Math.PI;
  const root = svg("svg", { viewBox: `0 0 ${width} ${tall}`, role: "img", "aria-label": `Walker at ${solve.label}` });
  const clip = `clip${index}`;
  root.append(svg("clipPath", { id: clip }, svg("rect", { width, height: tall })));
  const world = svg("g"), frame = svg("g", { "clip-path": `url(#${clip})` }, world);
  world.append(svg("line", { x1: -20, x2: 20, y1: 0, y2: 0, style: "stroke:var(--soft);stroke-width:0.012" }));
  for (let i = -12; i <= 40; ++i) {
    world.append(svg("line", { x1: i * 0.25, x2: i * 0.25 - 0.05, y1: 0, y2: -0.06, style: "stroke:var(--soft);stroke-width:0.008" }));
  }
  const walker = figure(stride, solveColor(index), true);
  world.append(walker.group);
  root.append(frame);
  const caption = el("span", { class: "soft" });
  const start = stride.walker.center.length ? stride.walker.center[0][0] : 0;
  const update = (percent) => {
    const x = start + (stride.displacement * percent) / 100;
    world.setAttribute("transform", `translate(${width / 2} ${tall - 46}) scale(${SCALE} ${-SCALE}) rotate(${degrees}) translate(${-x} 0)`);
    walker.update(frameAt(stride, percent));
    caption.textContent = `${((stride.duration * percent) / 100).toFixed(2)} s · ${phaseAt(stride, percent)}`;
  };
  cursors.push(update);
  return el("div", { class: "card" }, el("h3", {}, solve.label, caption), root);
}

// Poses at equal steps of the cycle, set apart along the slope.
function snapshots(solve, index) {
  const stride = solve.stride, count = 9, gap = 0.82, scale = 118;
  const angle = solve.slope_rad, degrees = (angle * 180) / Math.PI;
  const along = gap * (count - 1), rise = along * Math.sin(angle);
  const width = 1120;
  const offset = (width - along * Math.cos(angle) * scale) / 2;
  const tall = (stride.walker.height * Math.cos(angle) + 0.12) * scale + Math.abs(rise) * scale + 52;
  const base = tall - 40 - Math.max(0, -rise) * scale;
  const root = svg("svg", { viewBox: `0 0 ${width} ${tall.toFixed(0)}`, role: "img", "aria-label": `Snapshots at ${solve.label}` });
  const world = svg("g", { transform: `translate(${offset} ${base}) scale(${scale} ${-scale}) rotate(${degrees})` });
  world.append(svg("line", { x1: -0.5, x2: along + 0.5, y1: 0, y2: 0, style: "stroke:var(--soft);stroke-width:0.012" }));
  root.append(world);
  for (let i = 0; i < count; ++i) {
    const percent = (100 * i) / (count - 1);
    const walker = figure(stride, solveColor(index), true);
    const frame = frameAt(stride, percent);
    walker.update(frame);
    const from = frame.center ? frame.center[0] : frame.points[0];
    walker.group.setAttribute("transform", `translate(${gap * i - from} 0)`);
    world.append(walker.group);
    const x = offset + gap * i * Math.cos(angle) * scale, y = base - gap * i * Math.sin(angle) * scale;
    root.append(svg("text", { x, y: y + 24, "text-anchor": "middle" }, `${fmt(percent, 3)} %`));
    root.append(svg("text", { x, y: y + 37, "text-anchor": "middle" }, `${((stride.duration * percent) / 100).toFixed(2)} s`));
  }
  return el("div", { class: "card", style: "margin:14px 0" }, el("h3", {}, `${solve.label}`), root);
}

// Play, pause, slider, speed; drives every cursor of the page.
function controls(duration) {
  const slider = el("input", { type: "range", min: 0, max: 100, step: 0.1, value: 0, "aria-label": "% of gait cycle" });
  const button = el("button", { type: "button" }, "▶ Play");
  const speed = el("select", { "aria-label": "speed" }, [["0.1", "0.1 ×"], ["0.25", "0.25 ×"], ["0.5", "0.5 ×"], ["1", "1 ×"]].map(([value, label]) => el("option", { value }, label)));
  speed.value = "0.25";
  const forces = el("input", { type: "checkbox", id: "forces", checked: "" });
  const readout = el("span", { class: "soft", style: "min-width:5em" });
  let percent = 0, playing = false, last = 0;
  const set = (value) => {
    percent = value;
    slider.value = value;
    readout.textContent = `${value.toFixed(1)} %`;
  };
  cursors.push(set);
  const step = (now) => {
    if (!playing) return;
    if (last) showPercent((percent + ((now - last) / 1000 / duration) * Number(speed.value) * 100) % 100);
    last = now;
    requestAnimationFrame(step);
  };
  const play = (value) => {
    playing = value;
    last = 0;
    button.textContent = playing ? "❚❚ Pause" : "▶ Play";
    if (playing) requestAnimationFrame(step);
  };
  button.addEventListener("click", () => play(!playing));
  slider.addEventListener("input", () => { play(false); showPercent(Number(slider.value)); });
  forces.addEventListener("change", () => {
    for (const mark of document.querySelectorAll(".force")) mark.style.display = forces.checked ? "" : "none";
  });
  return el("div", { class: "controls" }, button, slider, readout, el("label", {}, "speed ", speed), el("label", { for: "forces" }, forces, " forces"));
}
