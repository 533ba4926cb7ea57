// A camera that orbits a point: by drag, wheel, two fingers and keys. z is up.
const VIEWS = {
  free: [-52, 12],
  side: [-90, 3],
  front: [0, 3],
  behind: [180, 3],
  top: [-90, 89.9],
  below: [-90, -89.9],
};
const FIELD = 24; // degrees, small for little perspective

class OrbitCamera {
  constructor(three, element, changed) {
    this.camera = new three.PerspectiveCamera(FIELD, 1, 0.05, 100);
    this.camera.up.set(0, 0, 1);
    this.changed = changed;
    this.zoom = 1;
    this.shift = 0; // of the target, up, in m
    this.element = element;
    this.fingers = new Map();
    this.show("free");
    element.addEventListener("pointerdown", (e) => {
      element.setPointerCapture(e.pointerId);
      this.fingers.set(e.pointerId, e);
    });
    element.addEventListener("pointermove", (e) => this.drag(e));
    for (const end of ["pointerup", "pointercancel"])
      element.addEventListener(end, (e) => this.fingers.delete(e.pointerId));
    element.addEventListener(
      "wheel",
      (e) => {
        if (e.ctrlKey || document.activeElement === element) {
          e.preventDefault();
          this.scale(Math.exp(e.deltaY / 700));
        }
      },
      { passive: false },
    );
    element.addEventListener("keydown", (e) => this.key(e));
  }

  show(view) {
    [this.azimuth, this.elevation] = VIEWS[view];
    this.zoom = 1;
    this.shift = 0;
    this.changed();
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = Math.min(Math.max(this.elevation + elevation, -89.9), 89.9);
    this.changed();
  }

  scale(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.15), 4);
    this.changed();
  }

  drag(event) {
    const before = this.fingers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.clientX,
      dy = event.clientY - before.clientY;
    if (this.fingers.size === 2) {
      const other = [...this.fingers.values()].find((f) => f.pointerId !== event.pointerId);
      const apart = (f) => Math.hypot(f.clientX - other.clientX, f.clientY - other.clientY);
      this.scale(apart(before) / Math.max(apart(event), 1));
    } else if (event.shiftKey || event.buttons === 4) {
      this.shift += dy * 0.004 * this.zoom;
      this.changed();
    } else {
      this.turn(-dx * 0.4, dy * 0.4);
    }
    this.fingers.set(event.pointerId, event);
  }

  key(event) {
    const moves = { ArrowLeft: [-6, 0], ArrowRight: [6, 0], ArrowUp: [0, 6], ArrowDown: [0, -6] };
    if (moves[event.key]) this.turn(...moves[event.key]);
    else if (event.key === "+" || event.key === "=") this.scale(0.88);
    else if (event.key === "-") this.scale(1.14);
    else if (event.key === "PageUp" || event.key === "PageDown") {
      this.shift += event.key === "PageUp" ? 0.1 : -0.1;
      this.changed();
    } else return;
    event.preventDefault();
  }

  // Looks at a body of this height and width over the origin through a window of this aspect.
  fit(aspect, height, width) {
    const half = Math.tan((FIELD * Math.PI) / 360);
    const flat = Math.abs(Math.sin((this.elevation * Math.PI) / 180)) > 0.9;
    const need = Math.max((flat ? 1 : height * 1.16) / 2, width / 2 / aspect);
    const distance = (need / half) * this.zoom,
      a = (this.azimuth * Math.PI) / 180,
      e = (this.elevation * Math.PI) / 180;
    const target = (flat ? 0 : height * 0.5) + this.shift;
    this.camera.aspect = aspect;
    this.camera.position.set(
      distance * Math.cos(e) * Math.cos(a),
      distance * Math.cos(e) * Math.sin(a),
      target + distance * Math.sin(e),
    );
    this.camera.lookAt(0, 0, target);
    this.camera.updateProjectionMatrix();
  }
}
