// One motion in the scene: ground, body, forces, points of contact and their tracks.
const LANE = 3.5; // m of ground that is drawn
const MARK = 0.25; // m between the marks on the ground

class WalkerMesh {
  constructor(three, solve, shapes, fine) {
    this.three = three;
    this.solve = solve;
    this.scene = solve.motion.scene;
    this.shapes = shapes;
    this.fine = fine;
    // `root` is fixed to gravity, `ground` to the slope, `world` moves against the walk.
    this.root = new three.Group();
    this.ground = new three.Group();
    this.world = new three.Group();
    this.root.add(this.ground);
    this.ground.add(this.world);
    this.ground.rotation.y = -solve.slope_rad;
    this.matrix = new three.Matrix4();
    this.materials = {};
    this.travels = !solve.path;
    this.addGround();
    this.addBody();
    this.addForces();
    this.addTracks();
    this.paint();
  }

  material(name, options = {}) {
    const Kind = options.line
      ? this.three.LineBasicMaterial
      : options.flat
        ? this.three.MeshBasicMaterial
        : this.three.MeshLambertMaterial;
    const { line, flat, ...rest } = options;
    this.materials[name] = this.materials[name] || new Kind(rest);
    return this.materials[name];
  }

  // Instances of one shape, drawn wherever they are. Each has a geometry of its own: r111 takes instances with the same
  // geometry and material for the same ones.
  instances(shape, material, count) {
    const mesh = new this.three.InstancedMesh(shape.clone(), material, count);
    mesh.frustumCulled = false;
    return mesh;
  }

  addGround() {
    const { three } = this,
      width = this.travels ? 0.8 : LANE;
    const lane = new three.Mesh(
      this.shapes.plane,
      this.material("lane", { flat: true, transparent: true, opacity: 0.85 }),
    );
    lane.scale.set(LANE, width, 1);
    lane.position.z = -0.004;
    const points = [],
      count = Math.round(LANE / MARK);
    for (let i = 1; i < count; ++i)
      points.push(
        new three.Vector3((i - count / 2) * MARK, -width / 2, 0),
        new three.Vector3((i - count / 2) * MARK, width / 2, 0),
      );
    for (let i = 0; !this.travels && i < count; ++i)
      points.push(
        new three.Vector3(-LANE / 2, (i - count / 2) * MARK, 0),
        new three.Vector3(LANE / 2, (i - count / 2) * MARK, 0),
      );
    this.marks = new three.LineSegments(
      new three.BufferGeometry().setFromPoints(points),
      this.material("marks", { line: true }),
    );
    this.ground.add(lane, this.marks);
  }

  // Everything of one form is one mesh, drawn at once; ellipsoids are most of it: the body, the centre of mass, the points of contact and
  // the centres of pressure. Surfaces that touch the ground are glass where there are few gaits, so that the tracks on
  // them are seen; those of a rolling body show its rotation.
  addBody() {
    const paints = ["middle", "right", "left"],
      glass = this.fine && this.travels,
      rolls = !this.travels;
    const shapes = this.scene.shapes.map((shape, i) => ({
      kind: "body",
      shape,
      i,
      paint: paints[shape.side] + (shape.kind === 0 ? "Foot" : ""),
    }));
    const apart = shapes.filter(({ shape }) => (glass || rolls) && shape.kind === 0);
    const solid = this.addForms(this.shapes.sphere, {}, [
      ...shapes.filter((bead) => !apart.includes(bead)),
      ...(this.travels ? [{ kind: "center", paint: "center" }] : []),
      ...this.scene.contacts.map((contact) => ({ kind: "point", contact, paint: "point" })),
      ...this.scene.feet.map((foot) => ({ kind: "pressure", foot, paint: "pressure" })),
    ]);
    const feet = rolls ? quartered(this.three, this.shapes.sphere) : this.shapes.sphere;
    this.beads = [
      ...solid,
      ...this.addForms(feet, glass ? { transparent: true, opacity: 0.62 } : {}, apart, rolls),
    ];
    this.off = new Set(); // kinds that are switched off
  }

  // A mesh for the ellipsoids among the beads, and for each other form.
  addForms(sphere, options, beads, painted = false) {
    const forms = new Map();
    for (const bead of beads) {
      const form = bead.shape?.form,
        key = JSON.stringify(form ?? null);
      forms.set(key, { form, beads: [...(forms.get(key)?.beads ?? []), bead] });
    }
    return [...forms.values()].map(({ form, beads: alike }) =>
      this.addBeads(form ? formed(sphere, form) : sphere, options, alike, painted),
    );
  }

  // Instances of a shape in colours of their own, or in those of the shape.
  addBeads(shape, options, beads, painted = false) {
    const { three } = this;
    const material = new three.MeshLambertMaterial({ vertexColors: three.VertexColors ?? true, ...options });
    const mesh = this.instances(shape, material, beads.length);
    if (!painted)
      mesh.geometry.setAttribute("color", new three.InstancedBufferAttribute(new Float32Array(3 * beads.length), 3));
    this.world.add(mesh);
    return { mesh, beads, painted };
  }

  addForces() {
    const count = this.scene.contacts.length,
      force = this.material("force");
    this.shafts = this.instances(this.shapes.shaft, force, count);
    this.heads = this.instances(this.shapes.head, force, count);
    this.forces = new this.three.Group();
    this.forces.add(this.shafts, this.heads);
    this.world.add(this.forces);
  }

  // The ways of the points of contact on the ground, and, where there is room to see them, on the surfaces themselves.
  addTracks() {
    this.tracks = new this.three.Group();
    const { contacts } = this.scene,
      kind = this.fine ? { flat: true } : { line: true };
    this.tracks.add(
      tracks(
        this.three,
        contacts.flatMap((contact) => piecesOf(this.scene, contact.rows, 2, 2)),
        this.material("track", kind),
        this.fine,
      ),
    );
    this.onFeet = !this.fine
      ? []
      : contacts.map((contact) => {
          const own = tracks(
            this.three,
            piecesOf(this.scene, contact.rows + 2, 3, 2),
            this.material("trackOwn", kind),
            this.fine,
          );
          own.matrixAutoUpdate = false;
          this.tracks.add(own);
          return { own, shape: contact.shape };
        });
    this.world.add(this.tracks);
  }

  // The scene has another motion of the same body now.
  takeMotion() {
    const shown = this.tracks.visible;
    this.tracks.traverse((part) => part.geometry && part.geometry.dispose());
    this.world.remove(this.tracks);
    this.addTracks();
    this.tracks.visible = shown;
  }

  // Colours of the page's style.
  paint() {
    const color = colorValue(solveColor(this.solve.index)),
      paper = colorValue("var(--panel)"),
      limb = colorValue("var(--limb)");
    const colors = {
      right: color,
      rightFoot: color,
      left: mixColors(color, paper, 0.62),
      leftFoot: mixColors(color, paper, 0.5),
      middle: mixColors(limb, color, 0.22),
      middleFoot: color,
      force: colorValue("var(--force)"),
      point: colorValue("var(--point)"),
      pressure: colorValue("var(--ink)"),
      center: colorValue("var(--ink)"),
      track: colorValue("var(--track)"),
      trackOwn: colorValue("var(--point)"),
      lane: colorValue("var(--lane)"),
      marks: colorValue("var(--mark)"),
    };
    for (const [name, material] of Object.entries(this.materials)) material.color.set(colors[name]);
    for (const { mesh, beads, painted } of this.beads) {
      if (painted) continue;
      const attribute = mesh.geometry.attributes.color;
      beads.forEach((bead, k) => new this.three.Color(colors[bead.paint]).toArray(attribute.array, 3 * k));
      attribute.needsUpdate = true;
    }
  }

  // Instance k of a mesh: an ellipsoid, an arrow … with these axes; none where the place is null.
  place(mesh, k, position, quaternion, scale) {
    const { three } = this;
    if (position)
      this.matrix.compose(
        new three.Vector3(...position),
        new three.Quaternion(quaternion[1], quaternion[2], quaternion[3], quaternion[0]),
        new three.Vector3(...scale),
      );
    else this.matrix.makeScale(0, 0, 0);
    mesh.setMatrixAt(k, this.matrix);
    mesh.instanceMatrix.needsUpdate = true;
  }

  update(percent) {
    const x = this.travels ? progress(this.solve, percent) : this.middle();
    this.world.position.x = -x;
    this.marks.position.x = -(((x % MARK) + MARK) % MARK);
    const poses = shapePoses(this.scene, percent);
    for (const { mesh, beads } of this.beads)
      beads.forEach((bead, k) => this.placeBead(mesh, k, bead, poses, percent));
    this.scene.contacts.forEach((contact, k) => this.placeForce(contact, k, percent));
    for (const { own, shape } of this.onFeet) {
      const { center: c, quaternion: q } = poses[shape];
      own.matrix.compose(
        new this.three.Vector3(...c),
        new this.three.Quaternion(q[1], q[2], q[3], q[0]),
        new this.three.Vector3(1, 1, 1),
      );
      own.matrixWorldNeedsUpdate = true;
    }
  }

  placeBead(mesh, k, bead, poses, percent) {
    const upright = [1, 0, 0, 0];
    if (this.off.has(bead.kind)) {
      this.place(mesh, k, null);
    } else if (bead.kind === "body") {
      this.place(mesh, k, poses[bead.i].center, poses[bead.i].quaternion, bead.shape.axes);
    } else if (bead.kind === "center") {
      this.place(mesh, k, trackAt(this.scene, this.scene.center, 3, percent), upright, [0.026, 0.026, 0.026]);
    } else {
      const pressure = bead.kind === "pressure",
        at = trackAt(this.scene, (bead.foot || bead.contact).rows, 2, percent);
      this.place(
        mesh,
        k,
        at && [at[0], at[1], 0.004],
        upright,
        pressure ? [0.024, 0.024, 0.004] : [0.013, 0.013, 0.013],
      );
    }
  }

  placeForce(contact, k, percent) {
    const at = trackAt(this.scene, contact.rows, 8, percent),
      force = at && at.slice(5),
      size = at ? Math.hypot(...force) : 0;
    const foot = at && [at[0], at[1], 0.003];
    if (size < 0.5) {
      this.place(this.shafts, k, null);
      this.place(this.heads, k, null);
      return;
    }
    const metre = this.travels ? FORCE_M : 0.33 * FORCE_M * this.scene.height,
      length = Math.max(metre * Math.min(size, LONGEST_FORCE), 0.075),
      unit = force.map((f) => f / size);
    const q = new this.three.Quaternion().setFromUnitVectors(
        new this.three.Vector3(0, 0, 1),
        new this.three.Vector3(...unit),
      ),
      turned = [q.w, q.x, q.y, q.z];
    this.place(this.shafts, k, foot, turned, [1, 1, length - 0.06]);
    this.place(
      this.heads,
      k,
      foot.map((c, i) => c + unit[i] * length),
      turned,
      [1, 1, 1],
    );
  }

  // Of a motion that does not repeat: the middle of its way.
  middle() {
    const xs = Array.from(this.scene.tracks[this.scene.center]).filter(known);
    return (Math.min(...xs) + Math.max(...xs)) / 2;
  }
}

// The body of a form with semi-axes 1, from the unit sphere, whose normals it keeps.
function formed(sphere, form) {
  const shape = sphere.clone(),
    place = shape.attributes.position;
  for (let i = 0; i < place.count; ++i) {
    const normal = [place.getX(i), place.getY(i), place.getZ(i)];
    place.setXYZ(i, ...furthestPoint([1, 1, 1], form, normal));
  }
  return shape;
}

// A sphere whose eighths are light and dark in turn, so that its rotation is seen.
function quartered(three, sphere) {
  const shape = sphere.toNonIndexed ? sphere.toNonIndexed() : sphere,
    place = shape.attributes.position,
    colors = [];
  for (let i = 0; i < place.count; i += 3) {
    const mean = (axis) => place[`get${axis}`](i) + place[`get${axis}`](i + 1) + place[`get${axis}`](i + 2);
    const light = (mean("X") > 0 !== mean("Y") > 0) !== mean("Z") > 0;
    for (let k = 0; k < 3; ++k) colors.push(...(light ? [0.92, 0.92, 0.95] : [0.12, 0.42, 0.72]));
  }
  shape.setAttribute("color", new three.Float32BufferAttribute(colors, 3));
  return shape;
}
