// What the tests ask a page; runs in it after its own scripts.
const all = (selector) => [...document.querySelectorAll(selector)];
const titles = (selector) => all(selector).map((e) => e.textContent);

// Two frames later everything that was asked for is drawn.
const drawn = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))));

function press(label) {
  all("button").find((b) => b.textContent === label).click();
  return drawn();
}

function set(selector, value, event) {
  const input = document.querySelector(selector);
  input.value = value;
  input.dispatchEvent(new Event(event));
}

// Texts of a drawing that overlap by more than two pixels.
function overlaps(drawing) {
  const texts = [...drawing.querySelectorAll("text")].filter((t) => t.textContent && !t.getAttribute("transform"));
  const boxes = texts.map((t) => [t.textContent, t.getBoundingClientRect()]);
  const shared = (p, q, low, high) => Math.min(p[high], q[high]) - Math.max(p[low], q[low]);
  const crossing = (p, q) => shared(p, q, "left", "right") > 2 && shared(p, q, "top", "bottom") > 2;
  return boxes.flatMap(([a, p], i) =>
    boxes
      .slice(i + 1)
      .filter(([, q]) => crossing(p, q))
      .map(([b]) => `${a} over ${b}`),
  );
}

const smallestText = () =>
  Math.min(
    ...all("svg text")
      .filter((t) => t.textContent)
      .map((t) => t.getBoundingClientRect().height),
  );

const beyond = (width) =>
  all("main > *, section > *")
    .filter((e) => e.getBoundingClientRect().right > width + 1)
    .map((e) => e.className || e.tagName);

// Values of row `offset` of each contact's tracks at sample i, on one side or on both.
const contactValues = (i, offset, side) =>
  SOLVES[0].motion.scene.contacts
    .filter((c) => side === undefined || c.side === side)
    .map((c) => SOLVES[0].motion.scene.tracks[c.rows + offset][i])
    .filter(Number.isFinite);

// How far the centre of pressure of a foot is outside of its contact points, m; of every sample.
function pressureOffsets() {
  const scene = SOLVES[0].motion.scene;
  return scene.feet.flatMap((foot) =>
    Array.from(scene.tracks[foot.rows], (x, i) => {
      const xs = contactValues(i, 0, foot.side);
      return Number.isFinite(x) && xs.length ? Math.max(Math.min(...xs) - x, x - Math.max(...xs)) : 0;
    }),
  );
}

// Vertical force of both feet, and of all contacts in the scene, in % of body weight; of every sample.
const forceSums = () =>
  SOLVES[0].stride.feet[0].normal.map((v, i) => [
    v + SOLVES[0].stride.feet[1].normal[i],
    contactValues(i, 7).reduce((sum, f) => sum + f, 0),
  ]);

// Heights of the lowest point of each outline of a superellipsoid while its contact bears the body, in metres.
function heightsOfBearingOutlines() {
  const scene = SOLVES[0].motion.scene,
    heights = [];
  for (let percent = 0; percent <= 100; percent += 2) {
    const poses = shapePoses(scene, percent);
    for (const contact of scene.contacts) {
      const shape = scene.shapes[contact.shape],
        { center, quaternion } = poses[contact.shape];
      if (!shape.form || !trackAt(scene, contact.rows, 8, percent)) continue;
      heights.push(Math.min(...outlinePoints(center, quaternion, shape, PLANES.side).map((p) => p[1])));
    }
  }
  return heights;
}

// The largest value of an outline's equation at points of an ellipsoid that is turned: 1 if it just bounds them.
function outlineError() {
  const axes = [0.13, 0.05, 0.06],
    center = [0.2, -0.1, 0.4],
    q = [0.8, 0.36, 0.288, 0.3840625],
    size = Math.hypot(...q),
    unit = q.map((c) => c / size);
  return Object.values(PLANES).map((plane) => {
    const o = outline(center, unit, axes, plane);
    let largest = 0;
    for (let i = 0; i <= 200; ++i) {
      for (let j = 0; j < 400; ++j) {
        const a = (Math.PI * i) / 200,
          b = (Math.PI * j) / 200;
        const local = [axes[0] * Math.sin(a) * Math.cos(b), axes[1] * Math.sin(a) * Math.sin(b), axes[2] * Math.cos(a)];
        const p = turn(rotationOf(unit), local).map((v, k) => v + center[k]);
        const u = p[plane[0]] - o.u,
          v = p[plane[1]] - o.v;
        const along = (Math.cos(o.angle) * u + Math.sin(o.angle) * v) / o.a,
          across = (-Math.sin(o.angle) * u + Math.cos(o.angle) * v) / o.b;
        largest = Math.max(largest, along * along + across * across);
      }
    }
    return largest;
  });
}

// Every file that the buttons of the plots offer: [name, type, text].
function savedFiles() {
  const saved = [];
  window.download = (name, type, text) => saved.push([name, type, text]);
  for (const b of all(".files button")) b.click();
  return saved;
}
