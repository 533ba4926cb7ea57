// Play, slider and speed; they drive every plot and picture of the page. And the section that holds the scene.
function player(duration) {
  const slider = el("input", {
    type: "range",
    min: 0,
    max: 100,
    step: 0.1,
    value: 0,
    "aria-label": "Instant in per cent of the cycle",
  });
  const play = button("▶ Play", () => run(!playing), { class: "play" });
  const speed = el(
    "select",
    { "aria-label": "Speed" },
    [
      ["0.1", "0.1 ×"],
      ["0.25", "0.25 ×"],
      ["0.5", "0.5 ×"],
      ["1", "1 ×"],
      ["2", "2 ×"],
    ].map(([value, label]) => el("option", { value }, label)),
  );
  speed.value = "0.25";
  const readout = el("output", { class: "soft" }),
    status = el("span", { class: "unseen", role: "status" });
  const box = el("div", { class: "player" }, play, slider, readout, el("label", {}, "speed ", speed), status);
  const say = () => {
    const solve = SHOWN[0];
    status.textContent =
      `${instant.toFixed(0)} % of the cycle, ` +
      `${((solve.duration * instant) / 100).toFixed(2)} s; ${solve.label}: ${supportAt(solve.motion, instant)}`;
  };
  let playing = false,
    last = 0,
    paced = null,
    shown = 0;
  const show = (percent) => {
    slider.value = percent;
    slider.setAttribute("aria-valuetext", `${percent.toFixed(1)} %`);
    readout.textContent = `${percent.toFixed(1)} %`;
    shown = performance.now();
  };
  // While it plays, ten times a second is as fast as a person reads.
  followInstant(box, (percent) => {
    if (!playing || performance.now() - shown > 100) show(percent);
  });
  const step = (now) => {
    if (!playing) return;
    if (last) {
      showPercent((instant + ((now - last) / 1000 / duration) * Number(speed.value) * 100) % 100);
      if (paced) paced(now - last, true);
    }
    last = now;
    requestAnimationFrame(step);
  };
  const run = (value) => {
    playing = value;
    last = 0;
    play.textContent = playing ? "❚❚ Pause" : "▶ Play";
    if (playing) {
      requestAnimationFrame(step);
      return;
    }
    show(instant);
    say();
    if (paced) paced(0, false);
  };
  slider.addEventListener("input", () => {
    const percent = Number(slider.value);
    run(false);
    showPercent(percent);
    show(percent);
    say();
  });
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target.closest("button, input, select, summary, a")) return;
    event.preventDefault();
    run(!playing);
  });
  return {
    box,
    pace: (follow) => {
      paced = follow;
    },
  };
}

// Forces, tracks … and the views of the scene.
function sceneControls(scene) {
  const views = choice(
    "View",
    [
      ["free", "3D"],
      ["side", "Side"],
      ["front", "Front"],
      ["behind", "Behind"],
      ["top", "Top"],
      ["below", "Below"],
    ],
    "free",
    (view) => scene.camera.show(view),
  );
  const together =
    SHOWN.length > 1
      ? choice(
          "Arrangement",
          [
            ["apart", "Side by side"],
            ["overlaid", "Overlaid"],
          ],
          "apart",
          (value) => {
            scene.overlaid = value === "overlaid";
            scene.resize();
          },
        )
      : null;
  const part = (name, label) => switchBox(label, true, (on) => scene.toggle(name, on));
  const gaits =
    SHOWN.length > 1
      ? el(
          "details",
          { class: "pick" },
          el("summary", {}, "Gaits"),
          el(
            "div",
            {},
            SHOWN.map((solve) =>
              switchBox(solve.label, true, (on) => {
                scene.hidden[on ? "delete" : "add"](solve.index);
                scene.resize();
              }),
            ),
          ),
        )
      : null;
  return el(
    "div",
    { class: "controls" },
    views,
    together,
    ...(LIVE ? [] : [part("forces", "forces")]),
    part("tracks", "contact tracks"),
    ...(ROLLING.length || LIVE ? [] : [part("pressure", "centre of pressure")]),
    ...(ROLLING.length ? [] : [part("center", "centre of mass")]),
    gaits,
  );
}

// Without WebGL: the flat view, and the reason in words.
function flatView(stage, reason) {
  const grid = el("div", { class: "grid flats" });
  const draw = (view) => grid.replaceChildren(...SHOWN.map((solve) => flatPanel(solve, view)));
  const views = choice(
    "View",
    [
      ["side", "Side"],
      ["front", "Behind"],
    ],
    "side",
    draw,
  );
  draw("side");
  stage.replaceWith(
    el(
      "div",
      { class: "flatview" },
      el("p", { class: "notice", role: "status" }, `No three-dimensional picture: ${reason}. Here is the flat view.`),
      el("div", { class: "controls" }, views),
      grid,
    ),
  );
}

// The section with the scene; `note` says what is drawn.
function sceneSection(title, note) {
  const duration = SHOWN.reduce((sum, s) => sum + s.duration, 0) / SHOWN.length;
  const controls = player(duration),
    stage = el("div", { class: "stage" });
  section(title, null, controls.box, stage, el("p", { class: "note under" }, note));
  const start = async () => {
    const software = softwareWebGl();
    const scene = new Scene(await loadThree(), stage, SHOWN, software);
    controls.pace((milliseconds, playing) => scene.pace(milliseconds, playing));
    stage.before(sceneControls(scene));
    window.rollgaitScene = scene;
  };
  return start().catch((error) => flatView(stage, error.message));
}
