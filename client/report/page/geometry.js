// three.js, packed in the page, and shapes made with it. The names of r111 and of later releases are both understood.

// Unpacks and runs the library; throws an Error that says what the browser lacks.
async function loadThree() {
  if (!window.DecompressionStream) throw new Error("this browser cannot unpack gzip (DecompressionStream)");
  const bytes = Uint8Array.from(atob(document.getElementById("three").textContent.trim()), (c) => c.charCodeAt(0));
  const text = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  const script = el("script");
  if (NONCE) script.nonce = NONCE;
  script.textContent = text;
  document.head.append(script);
  if (!window.THREE) throw new Error("three.js did not start");
  correctNormals(window.THREE);
  return window.THREE;
}

// r111 turns the normals of instances by their matrix, scale included, where its inverse transpose is due; later
// releases do what this does.
function correctNormals(three) {
  const wrong = "transformedNormal = mat3( instanceMatrix ) * transformedNormal;";
  three.ShaderChunk.defaultnormal_vertex = three.ShaderChunk.defaultnormal_vertex.replace(
    wrong,
    "mat3 turned = mat3( instanceMatrix ); transformedNormal /= vec3( dot( turned[ 0 ], turned[ 0 ] ), dot( " +
      "turned[ 1 ], turned[ 1 ] ), dot( turned[ 2 ], turned[ 2 ] ) ); transformedNormal = turned * transformedNormal;",
  );
}

// Whether WebGL is computed by the processor; throws an Error where there is no WebGL.
function softwareWebGl() {
  const canvas = el("canvas"),
    context = canvas.getContext("webgl2") || canvas.getContext("webgl");
  if (!context) throw new Error("this browser has no WebGL");
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER);
  const lose = context.getExtension("WEBGL_lose_context");
  if (lose) lose.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

const buffered = (three, name) => three[`${name}BufferGeometry`] || three[`${name}Geometry`];

// Shapes that all walkers share; `fine` for few of them.
function sharedShapes(three, fine) {
  const sphere = new (buffered(three, "Sphere"))(1, fine ? 24 : 9, fine ? 16 : 6);
  const shaft = new (buffered(three, "Cylinder"))(0.009, 0.009, 1, fine ? 12 : 6, 1, true);
  shaft.rotateX(Math.PI / 2);
  shaft.translate(0, 0, 0.5);
  const head = new (buffered(three, "Cone"))(0.028, 0.07, fine ? 16 : 8);
  head.rotateX(Math.PI / 2);
  head.translate(0, 0, -0.035);
  const disc = new (buffered(three, "Cylinder"))(1, 1, 0.006, fine ? 24 : 10);
  disc.rotateX(Math.PI / 2);
  return { sphere, shaft, head, disc, plane: new (buffered(three, "Plane"))(1, 1) };
}

// Lines through points as tubes, or as lines of one pixel where there are many. Pieces between unknown points are
// apart.
function tracks(three, pieces, material, fine) {
  const group = new three.Group(),
    ends = [];
  for (const piece of pieces.filter((p) => p.length > 1)) {
    const points = piece.map((p) => new three.Vector3(...p));
    if (!fine) points.slice(1).forEach((point, i) => ends.push(points[i], point));
    else
      group.add(
        new three.Mesh(
          new (buffered(three, "Tube"))(new three.CatmullRomCurve3(points), Math.min(3 * points.length, 90), 0.0045, 6),
          material,
        ),
      );
  }
  if (ends.length) group.add(new three.LineSegments(new three.BufferGeometry().setFromPoints(ends), material));
  return group;
}

// Consecutive known points of rows of a scene's tracks, every `step`th; z is zero where there are two rows only.
function piecesOf(scene, first, count, step) {
  const pieces = [],
    rows = Array.from({ length: count }, (_, k) => scene.tracks[first + k]);
  let open = [];
  for (let i = 0; i < rows[0].length; ++i) {
    if (!known(rows[0][i])) {
      if (open.length) pieces.push(open);
      open = [];
    } else if (i % step === 0 || i === rows[0].length - 1) {
      open.push([rows[0][i], rows[1][i], count > 2 ? rows[2][i] : 0]);
    }
  }
  if (open.length) pieces.push(open);
  return pieces;
}
