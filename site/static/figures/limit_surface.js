/** Lecture 11: pull a vertex of the cage, and Loop's limit surface follows. */
import { canvasOf, paint } from "./facets.js";
import { button, fill, html, Sheet } from "./paper.js";
import { between, cross, dot, minus } from "./vectors.js";

const STEPS = 3, SHEET = [-1.1, 2.1, -0.92, 1.08];
const RIM = 0.12;                         // the handle stays whole
const BRASS = [214, 178, 132], BLUE = [0, 114, 230];
const GOLDEN = (1 + Math.sqrt(5)) / 2;
const TURN = [[0.86, 0.12, -0.5], [0.1, 0.92, 0.39], [0.5, -0.38, 0.78]];  // rows: right, up, near

/** Twelve vertices and twenty faces, counter-clockwise from outside. */
export function icosahedron() {
  const vertices = [];
  for (const a of [-1, 1]) {
    for (const b of [-GOLDEN, GOLDEN]) vertices.push([0, a, b], [a, b, 0], [b, 0, a]);
  }
  const isNear = (i, j) => Math.hypot(...minus(vertices[i], vertices[j])) < 2.1;
  const faces = [];
  for (let i = 0; i < 12; i++) {
    for (let j = i + 1; j < 12; j++) {
      for (let k = j + 1; k < 12; k++) {
        if (!(isNear(i, j) && isNear(j, k) && isNear(k, i))) continue;
        const volume = dot(vertices[i], cross(vertices[j], vertices[k]));
        faces.push(volume > 0 ? [i, j, k] : [i, k, j]);
      }
    }
  }
  const length = Math.hypot(1, GOLDEN);
  return { vertices: vertices.map((v) => v.map((t) => t / length)), faces };
}

/** Warren's weight of one neighbour, for a vertex with n of them. */
const warrenWeight = (n) => (n === 3 ? 3 / 16 : 3 / (8 * n));

/** Eq. (6): the weight of one neighbour in a vertex's limit. */
const limitWeight = (n, u) => 1 / (n + 3 / (8 * u));

const mix = (...parts) => parts[0][1].map((_, k) =>
  parts.reduce((sum, [weight, vector]) => sum + weight * vector[k], 0));

/** The neighbours of each vertex of a closed mesh. */
function rings(faces, count) {
  const found = Array.from({ length: count }, () => []);
  for (const face of faces) face.forEach((v, k) => found[v].push(face[(k + 1) % 3]));
  return found;
}

/** v moves towards its ring: weight u for each neighbour. */
const pulled = (vertices, ring, v, u) =>
  mix([1 - ring.length * u, vertices[v]], ...ring.map((near) => [u, vertices[near]]));

/** Eqs. (3) and (5) for a closed mesh: one step of Loop. A vertex has any number of numbers. */
function loop(vertices, faces) {
  const across = new Map(), numbers = new Map();
  const key = (i, j) => i * vertices.length + j;
  for (const face of faces) {
    face.forEach((v, k) => across.set(key(v, face[(k + 1) % 3]), face[(k + 2) % 3]));
  }
  const moved = rings(faces, vertices.length).map((ring, v) =>
    pulled(vertices, ring, v, warrenWeight(ring.length)));
  const onEdge = (i, j) => {
    const name = key(Math.min(i, j), Math.max(i, j));
    if (!numbers.has(name)) {
      const [left, right] = [across.get(key(i, j)), across.get(key(j, i))];
      numbers.set(name, moved.length);
      moved.push(mix([3 / 8, vertices[i]], [3 / 8, vertices[j]],
                     [1 / 8, vertices[left]], [1 / 8, vertices[right]]));
    }
    return numbers.get(name);
  };
  const finer = faces.flatMap(([a, b, c]) => {
    const [ab, bc, ca] = [onEdge(a, b), onEdge(b, c), onEdge(c, a)];
    return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
  });
  return { vertices: moved, faces: finer };
}

/** The surface of a closed cage: after some steps, each vertex moved to its limit, eq. (6). */
export function loopSurface(cage, faces, steps) {
  let mesh = { vertices: cage, faces };
  for (let n = 0; n < steps; n++) mesh = loop(mesh.vertices, mesh.faces);
  const limits = rings(mesh.faces, mesh.vertices.length).map((ring, v) => pulled(
    mesh.vertices, ring, v, limitWeight(ring.length, warrenWeight(ring.length))));
  return { vertices: limits, faces: mesh.faces };
}

const seen = (p) => TURN.map((row) => dot(row, p));

export function show(place) {
  const { vertices, faces } = icosahedron();
  const start = vertices.map(seen);
  const held = start.indexOf(start.reduce(
    (best, v) => (v[0] + v[1] > best[0] + best[1] ? v : best)));
  const identity = start.map((_, i) => start.map((__, j) => Number(i === j)));
  const { vertices: matrix, faces: small } = loopSurface(identity, faces, STEPS);
  const weights = matrix.map((row) => row[held]);
  const edges = faces.flatMap((face) => face.map((v, k) => [v, face[(k + 1) % 3]]))
    .filter(([i, j]) => i < j);
  let cage = start;
  const sheet = new Sheet(SHEET,
    "A cage of twenty triangles, and the smooth surface in it", draw);
  const begun = canvasOf(sheet);
  sheet.handle({
    name: "Vertex of the cage", step: 0.1, at: () => cage[held].slice(0, 2),
    limits: SHEET.map((t, k) => t + (k % 2 ? -RIM : RIM)),
    moved: ([x, y]) => { cage = cage.with(held, [x, y, cage[held][2]]); } });
  const reset = button("Reset", () => { cage = start; });
  const touched = weights.filter((w) => w > 1e-9).length;
  const strongest = Math.max(...weights);

  /** The bluer a face, the more of the held vertex is in it. */
  function colourOf(face) {
    const share = face.reduce((sum, v) => sum + weights[v], 0) / (3 * strongest);
    return between(BRASS, BLUE, share ** 0.7);
  }

  function draw() {
    paint(begun(), matrix.flatMap((row) =>
      mix(...row.flatMap((w, n) => (w ? [[w, cage[n]]] : [])))), small, colourOf);
    sheet.draw(edges.map(([i, j]) => sheet.line([cage[i], cage[j]].map(([x, y]) => [x, y]),
                                                `wire ${i === held || j === held ? "held" : ""}`)));
  }

  fill(place, draw, "Pull the vertex of the cage.",
    `It is in ${touched} of the surface's ${matrix.length} points, a column of <i>M</i>: ` +
      'the <b class="blue">bluer</b> a point, the more. The surface goes along with at most ' +
      `<b>${(100 * strongest).toFixed(0)} %</b> of the pull.`,
    html("div", { class: "wide" }, sheet.box), html("div", { class: "wide" }, reset));
}
