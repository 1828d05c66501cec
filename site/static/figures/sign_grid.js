/** Lecture 15: a grid of signed distances, the outline between its signs, and its way back. */
import { counted, fill, html, playAndReset, say, Sheet } from "./paper.js";
import { dot, minus, plus } from "./vectors.js";

const COLUMNS = 25, ROWS = 17, SPACING = 1 / 8;
const RADIUS = 0.75, TUBE = 0.32, BALL = 0.86;
const RATE = 5, STEPS = 300;

export const POINTS = Array.from({ length: COLUMNS * ROWS }, (_, n) => [
  (n % COLUMNS - (COLUMNS - 1) / 2) * SPACING,
  (Math.floor(n / COLUMNS) - (ROWS - 1) / 2) * SPACING]);

/** Two triangles, counter-clockwise, in each square of the grid. */
const TRIANGLES = POINTS.flatMap((_, n) => {
  if (n % COLUMNS === COLUMNS - 1 || n >= COLUMNS * (ROWS - 1)) return [];
  const [right, above] = [n + 1, n + COLUMNS];
  return [[n, right, above + 1], [n, above + 1, above]];
});

/** Eq. (1): the slice of a ring around the y axis through its axis: two discs. */
export const torus = ([x, y], radius, tube) => Math.hypot(Math.abs(x) - radius, y) - tube;

/** Eq. (8): where on the edge from a to b is the distance 0? */
export const zeroCrossing = (pA, pB, sA, sB) => pA.map((a, k) => (a * sB - pB[k] * sA) / (sB - sA));

/** Eq. (9) -> dL/dsA, dL/dsB. */
export function zeroCrossingBackward(gradP, pA, pB, sA, sB) {
  const gradT = dot(gradP, minus(pB, pA));
  return [-gradT * sB / (sB - sA) ** 2, gradT * sA / (sB - sA) ** 2];
}

/** The outline: -> vertices {p, a, b}, each on the edge from a point a inside to a point b outside,
 *  and segments [from, to], numbers of vertices, the inside on their left. */
export function marchingTriangles(distance) {
  const vertices = [], numbers = new Map();
  const vertexOn = (i, j) => {
    const [a, b] = distance[i] < 0 ? [i, j] : [j, i];
    const key = a * POINTS.length + b;
    if (!numbers.has(key)) {
      numbers.set(key, vertices.length);
      vertices.push({ a, b, p: zeroCrossing(POINTS[a], POINTS[b], distance[a], distance[b]) });
    }
    return numbers.get(key);
  };
  const segments = TRIANGLES.flatMap((corners) => {
    const inside = corners.map((n) => distance[n] < 0);
    const count = inside.filter(Boolean).length;
    if (count === 0 || count === 3) return [];
    const k = inside.indexOf(count === 1); // the corner that is alone on its side
    const [alone, next, last] = [0, 1, 2].map((turn) => corners[(k + turn) % 3]);
    const ends = [vertexOn(alone, next), vertexOn(alone, last)];
    return [count === 1 ? ends : ends.reverse()];
  });
  return { vertices, segments };
}

/** Eq. (9) for all vertices: dL/dp of each -> dL/ds of the grid's points. */
export function crossingsBackward(gradP, vertices, distance) {
  const gradient = distance.map(() => 0);
  vertices.forEach(({ a, b }, n) => {
    const [gradA, gradB] = zeroCrossingBackward(gradP[n], POINTS[a], POINTS[b],
                                                distance[a], distance[b]);
    gradient[a] += gradA;
    gradient[b] += gradB;
  });
  return gradient;
}

/** The gradient of the area inside, with respect to the outline's vertices. */
export function areaBackward(vertices, segments) {
  const gradients = vertices.map(() => [0, 0]);
  for (const [i, j] of segments) {
    const [[px, py], [qx, qy]] = [vertices[i].p, vertices[j].p];
    gradients[i] = plus(gradients[i], [qy / 2, -qx / 2]);
    gradients[j] = plus(gradients[j], [-py / 2, px / 2]);
  }
  return gradients;
}

/** Section 8: the integral of the ring's distance over the inside, back to the grid's numbers. */
function distanceGradient(distance) {
  const { vertices, segments } = marchingTriangles(distance);
  const gradP = areaBackward(vertices, segments).map((area, n) =>
    area.map((g) => g * torus(vertices[n].p, RADIUS, TUBE)));
  return crossingsBackward(gradP, vertices, distance);
}

/** The groups that links [i, j] make of the numbers below count -> one number of each. */
function groups(count, links) {
  const root = Array.from({ length: count }, (_, n) => n);
  const find = (n) => (root[n] === n ? n : (root[n] = find(root[n])));
  for (const [i, j] of links) root[find(i)] = find(j);
  return [...root.keys()].filter((n) => root[n] === n);
}

/** How many pieces do the points inside make, along the grid's edges? */
export function pieces(distance) {
  const links = TRIANGLES.flatMap(([a, b, c]) => [[a, b], [b, c], [c, a]])
    .filter((ends) => ends.every((n) => distance[n] < 0));
  return groups(distance.length, links).filter((n) => distance[n] < 0).length;
}

/** How many curves do the segments make? A piece with a hole has two. */
export const outlines = ({ vertices, segments }) => groups(vertices.length, segments).length;

export function show(place) {
  const across = COLUMNS * SPACING / 2, up = ROWS * SPACING / 2;
  let distance, step, chosen, seen; // seen: below the mouse, too
  const sheet = new Sheet([-across, across, -up, up],
    "A grid of signs, and the outline that runs between them", draw);
  const said = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  begin();
  sheet.probe({
    name: "Grid point, Enter flips its sign", step: SPACING, from: POINTS[0], at: () => chosen,
    limits: [POINTS[0][0], -POINTS[0][0], POINTS[0][1], -POINTS[0][1]],
    moved: (to, isChosen, isPressed) => {
      seen = to;
      if (isChosen) chosen = to;
      if (isPressed) flip(to);
    } });
  const buttons = playAndReset(() => {
    if (step === STEPS) return false;
    step += 1;
    const gradient = distanceGradient(distance);
    distance = plus(distance, gradient, -RATE);
    return true;
  }, begin, draw);

  function begin() {
    [distance, step] = [POINTS.map((p) => Math.hypot(...p) - BALL), 0];
    chosen = seen = POINTS[POINTS.length >> 1];
  }

  function flip(point) {
    const [column, row] = minus(point, POINTS[0]).map((t) => Math.round(t / SPACING));
    distance[row * COLUMNS + column] *= -1;
  }

  function draw() {
    const { vertices, segments } = marchingTriangles(distance);
    sheet.draw(
      sheet.rectangle(seen.map((t) => t - SPACING / 2), SPACING, SPACING, "chosen"),
      [-RADIUS, RADIUS].map((x) => sheet.dot([x, 0], TUBE * sheet.scale, "goal")),
      POINTS.map((p, n) => sheet.dot(p, distance[n] < 0 ? 3.4 : 1.8,
                                     distance[n] < 0 ? "sample first" : "sample")),
      segments.map(([i, j]) => sheet.line([vertices[i].p, vertices[j].p], "edge")));
    said.innerHTML = `Step ${step}: <b class="red">${counted(pieces(distance), "piece")}</b>`;
    const curves = outlines({ vertices, segments });
    say(answer, curves === 1 ? "One outline."
      : `${curves} outlines: signs have changed, and nothing else.`);
  }

  fill(place, draw, "Press Play, or tap a point to flip its sign.",
    '<b class="blue">Blue</b> points have a negative distance: they are inside. ' +
      'The <b class="red">red</b> outline runs where the sign changes.',
    sheet.box,
    html("div", { class: "told" }, said, answer,
      html("div", { class: "row" }, ...buttons)));
}
