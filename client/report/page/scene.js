// The three-dimensional scene: one canvas, a window for each gait, or all gaits in one.
const FRAME_MS = 33; // slower frames are drawn coarser until the motion stops
const LEAST_RATIO = 0.5,
  MOST_PARTS = 5;

class Scene {
  // `software`: WebGL without a graphics card, for which smooth edges cost too much.
  constructor(three, stage, solves, software) {
    this.three = three;
    this.stage = stage;
    this.solves = solves;
    this.fine = solves.length <= FEW;
    this.travels = !solves[0].path;
    this.software = software;
    this.overlaid = false;
    this.hidden = new Set();
    this.canvas = el("canvas", {
      tabindex: "0",
      role: "img",
      "aria-roledescription": "three-dimensional scene",
      "aria-label": "The walkers. Arrow keys turn the view, + and − zoom, Page Up and Page Down move it.",
    });
    this.labels = el("div", { class: "labels", "aria-hidden": "true" });
    stage.append(this.canvas, this.labels);
    this.renderer = new three.WebGLRenderer({
      canvas: this.canvas,
      antialias: this.fine && !software,
      alpha: false,
      preserveDrawingBuffer: true,
    });
    if ("outputColorSpace" in this.renderer) {
      three.ColorManagement.enabled = false;
      this.renderer.outputColorSpace = "srgb-linear";
    }
    this.ratio = this.best = Math.min(window.devicePixelRatio || 1, 2);
    this.slow = 0;
    this.parts = 1;
    this.frames = 0;
    this.world = new three.Scene();
    const strength = Number(three.REVISION) >= 155 ? Math.PI : 1;
    const light = new three.DirectionalLight(0xffffff, 0.62 * strength);
    light.position.set(2, -3.5, 5);
    this.world.add(new three.HemisphereLight(0xffffff, 0x8d8d99, 0.62 * strength), light);
    const shapes = sharedShapes(three, this.fine);
    this.walkers = solves.map((solve) => new WalkerMesh(three, solve, shapes, this.fine));
    for (const walker of this.walkers) this.world.add(walker.root);
    // On a slope the ground rises and falls by so much within a step.
    this.height = Math.max(...solves.map((s) => s.motion.scene.height + Math.abs(Math.sin(s.slope_rad))));
    this.camera = new OrbitCamera(three, this.canvas, () => this.request());
    this.makeLabels();
    new ResizeObserver(() => this.resize()).observe(stage);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => this.request());
    followInstant(this.canvas, (percent) => {
      this.percent = percent;
      this.request();
    });
    this.paint();
    this.resize();
  }

  makeLabels() {
    this.cells = this.solves.map((solve) => {
      const label = el("span", {}, labelOf(solve));
      this.labels.append(label);
      return label;
    });
  }

  shown() {
    return this.walkers.filter((w) => !this.hidden.has(w.solve.index));
  }

  paint() {
    this.renderer.setClearColor(colorValue("var(--panel)"));
    for (const walker of this.walkers) walker.paint();
    this.request();
  }

  // Windows in rows; few gaits get tall ones.
  layout() {
    const width = this.stage.clientWidth,
      count = this.overlaid ? 1 : Math.max(this.shown().length, 1);
    const least = count > FEW ? 150 : 170;
    let columns = Math.max(1, Math.min(count, Math.floor(width / least), count > FEW ? 7 : 3));
    const rows = Math.ceil(count / columns);
    columns = Math.ceil(count / rows);
    const cell = {
      width: width / columns,
      height: count === 1 ? Math.min(Math.max(width * 0.55, 320), 480) : rows > 2 ? 172 : rows > 1 ? 270 : 380,
    };
    return { width, height: cell.height * rows, columns, cell };
  }

  resize() {
    const { width, height } = this.layout();
    if (!width) return;
    this.stage.style.height = `${height}px`;
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(width, height, false);
    this.placeLabels();
    this.request();
  }

  request() {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.render();
    });
  }

  // While the motion plays on a slow machine, first the resolution falls, then each frame draws a part of the windows
  // only, in turn. At rest everything is drawn as fine as the screen is.
  pace(milliseconds, playing) {
    this.slow = playing && milliseconds > FRAME_MS ? this.slow + 1 : Math.max(this.slow - 1, 0);
    let { ratio, parts } = playing ? this : { ratio: this.best, parts: 1 };
    if (playing && this.software) ratio = Math.min(ratio, 0.75);
    if (this.slow > 5) {
      this.slow = 0;
      if (ratio > LEAST_RATIO) ratio = Math.max(ratio * 0.7, LEAST_RATIO);
      else parts = Math.min(parts + 1, MOST_PARTS);
    }
    const resized = ratio !== this.ratio;
    Object.assign(this, { ratio, parts });
    if (resized) this.resize();
    else if (!playing) this.request();
  }

  render() {
    const { columns, cell, height } = this.layout(),
      shown = this.shown(),
      percent = this.percent ?? instant;
    for (const walker of this.walkers) walker.root.visible = false;
    this.renderer.setScissorTest(false);
    if (this.parts === 1) this.renderer.clear();
    this.renderer.setScissorTest(true);
    const windows = this.overlaid ? [shown] : shown.map((walker) => [walker]);
    windows.forEach((walkers, i) => {
      if (windows.length > 1 && i % this.parts !== this.frames % this.parts) return;
      const left = (i % columns) * cell.width,
        top = Math.floor(i / columns) * cell.height;
      for (const walker of walkers) {
        walker.update(percent);
        walker.root.visible = true;
      }
      this.renderer.setViewport(left, height - top - cell.height, cell.width, cell.height);
      this.renderer.setScissor(left, height - top - cell.height, cell.width, cell.height);
      this.camera.fit(cell.width / cell.height, this.height, this.travels ? 1.15 : 1.2);
      this.renderer.render(this.world, this.camera.camera);
      for (const walker of walkers) walker.root.visible = false;
    });
    this.canvas.dataset.frames = String(++this.frames);
  }

  // Where each gait's name stands, in shares of the stage; called when the windows change.
  placeLabels() {
    const { columns, cell, width, height } = this.layout(),
      shown = this.shown();
    this.cells.forEach((label) => {
      label.style.display = "none";
    });
    shown.forEach((walker, i) => {
      const [left, top] = this.overlaid
        ? [0, 17 * i]
        : [(i % columns) * cell.width, Math.floor(i / columns) * cell.height];
      Object.assign(this.cells[this.walkers.indexOf(walker)].style, {
        display: "",
        left: `${(100 * (left + 8)) / width}%`,
        top: `${(100 * (top + 6)) / height}%`,
      });
    });
  }

  toggle(part, on) {
    for (const walker of this.walkers) {
      const kinds = { pressure: ["pressure"], center: ["center"], tracks: ["point"] }[part] || [];
      for (const kind of kinds) walker.off[on ? "delete" : "add"](kind);
      if (part === "forces") walker.forces.visible = on;
      if (part === "tracks") walker.tracks.visible = on;
    }
    this.request();
  }
}
