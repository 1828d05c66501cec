/** Lecture 02: three edge functions decide which pixels a triangle covers. */
import { button, centres, clamp, counted, fill, html, number, Sheet } from "./paper.js";
import { probePixels } from "./picture.js";
import { dot, minus } from "./vectors.js";

const WIDTH = 12, HEIGHT = 8;
const START = [[1.5, 2.5], [8.5, 1.5], [5.5, 7.5], [11, 5]];
const CHOSEN = [7.5, 3.5];               // a centre on the edge that both triangles share
const SUB = "₀₁₂";

export const EDGES = [[1, 2], [2, 0], [0, 1]];  // edge k is opposite to vertex k

/** Eq. (1): positive on the left of the line from a to b, and -edgeFunction(p, b, a) exactly. */
export function edgeFunction([x, y], [x0, y0], [x1, y1]) {
  const [fromX, fromY] = x0 <= x1 ? [x0, y0] : [x1, y1];
  return (y0 - y1) * (x - fromX) + (x1 - x0) * (y - fromY);
}

export const isTopLeft = (nX, nY) => nX > 0 || (nX === 0 && nY > 0);

export const signedArea = ([a, b, c]) => edgeFunction(c, a, b) / 2;

/** e and whether the edge is top-left, for the three edges of a triangle. */
function edgesAt(p, triangle) {
  return EDGES.map(([i, j]) => {
    const [a, b] = [triangle[i], triangle[j]];
    return { e: edgeFunction(p, a, b), owns: isTopLeft(a[1] - b[1], b[0] - a[0]) };
  });
}

/** Eq. (2), for a counter-clockwise triangle. */
export const isCovered = (p, triangle) =>
  edgesAt(p, triangle).every(({ e, owns }) => e > 0 || (e === 0 && owns));

/** Eq. (3). */
export function screenWeights(p, triangle) {
  const e = edgesAt(p, triangle).map((edge) => edge.e);
  const sum = e[0] + e[1] + e[2];
  return e.map((value) => value / sum);
}

/** Is a sample covered, and why? */
function verdict(p, triangle) {
  const area = signedArea(triangle);
  if (area === 0) return "is not covered. The triangle has no area.";
  if (area < 0) return `is ${isCovered(p, triangle.toReversed()) ? "" : "not "}covered.`;
  const edges = edgesAt(p, triangle);
  const names = (list, join) => list.map((k) => `e${SUB[k]}`).join(join);
  const which = (test) => [0, 1, 2].filter((k) => test(edges[k]));
  const [below, on] = [which(({ e }) => e < 0), which(({ e }) => e === 0)];
  const lost = which(({ e, owns }) => e === 0 && !owns);
  if (below.length) return `is not covered: ${names(below, ", ")} < 0.`;
  if (lost.length) return `is not covered: ${names(lost, " = ")} = 0, not on a top-left edge.`;
  if (on.length) return `is covered: ${names(on, " = ")} = 0 on a top-left edge.`;
  return "is covered: all three are positive.";
}

/** Is p on the edge from a to b, between its ends? */
function isOnEdge(p, a, b) {
  const edge = minus(b, a), along = dot(minus(p, a), edge);
  return edgeFunction(p, a, b) === 0 && along > 0 && along < dot(edge, edge);
}

export function show(place) {
  let points = START, p = CHOSEN;
  const sheet = new Sheet([0, WIDTH, 0, HEIGHT],
    "Two triangles with a shared edge on a grid of 12 by 8 pixels", draw);
  const answer = html("p", { class: "verdict", role: "status" });
  const shared = html("p");

  START.forEach((_, k) => sheet.handle({
    name: k < 3 ? `Vertex ${k}` : "The neighbour's vertex", mark: String(k),
    style: k < 3 ? "" : "second", step: 0.5, limits: [0, WIDTH, 0, HEIGHT],
    at: () => points[k], moved: (to) => { points = points.with(k, to); } }));
  const choose = probePixels([sheet], CHOSEN, (to) => { p = to; });
  const reset = button("Reset", () => {
    choose(CHOSEN);
    [points, p] = [START, CHOSEN];
  });

  function draw() {
    const triangle = points.slice(0, 3);
    const [edges, l] = [edgesAt(p, triangle), screenWeights(p, triangle)];
    const second = [points[2], points[1], points[3]];
    const seen = centres(WIDTH, HEIGHT).map((centre) => ({
      centre, first: isCovered(centre, triangle), second: isCovered(centre, second),
      onEdge: isOnEdge(centre, points[1], points[2]) }));
    const kind = ({ first, second }) =>
      (first && second ? "both" : first ? "first" : second ? "second" : "none");
    sheet.draw(
      seen.map((pixel) => sheet.rectangle(pixel.centre.map((t) => t - 0.5), 1, 1,
                                          `pixel ${kind(pixel)}`)),
      sheet.polygon(second, "outline second"),
      EDGES.map(([i, j], k) => sheet.line([triangle[i], triangle[j]],
        `outline first ${edges[k].owns ? "thick" : ""}`)),
      seen.map((pixel) => sheet.dot(pixel.centre, pixel.onEdge ? 6.5 : 2.5,
                                    `sample ${kind(pixel)}`)),
      triangle.map((vertex) => sheet.line([p, vertex], "ray")),
      sheet.rectangle(p.map((t) => t - 0.5), 1, 1, "chosen"),
      EDGES.map(([i, j], k) => named(triangle[i], triangle[j],
                                     `e${SUB[k]} = ${number(edges[k].e, 1)}`)),
      l.map((weight, k) => sheet.text(triangle[k], number(weight), "weight", [15, -16])));
    answer.textContent = `Pixel [${Math.floor(p[1])}, ${Math.floor(p[0])}] ` +
      verdict(p, triangle);
    tell(seen);
  }

  /** An edge's label stands on its right, outside of the triangle. */
  function named(a, b, words) {
    const [dx, dy] = minus(b, a);
    const length = Math.hypot(dx, dy) || 1, half = 48 / sheet.scale;
    const middle = [(a[0] + b[0]) / 2 + half * dy / length, (a[1] + b[1]) / 2];
    return sheet.text([clamp(middle[0], half, WIDTH - half), middle[1]], words,
                      "label first middle", [0, -16 * dx / length - 5]);
  }

  function tell(seen) {
    const onEdge = seen.filter((pixel) => pixel.onEdge);
    const count = (list, test) => list.filter(test).length;
    shared.innerHTML = `${counted(onEdge.length, "sample")} on the shared edge: ` +
      `<b class="blue">${count(onEdge, ({ first }) => first)} blue</b>, ` +
      `<b class="orange">${count(onEdge, ({ second }) => second)} orange</b>. ` +
      `In both: ${count(seen, ({ first, second }) => first && second)}. ` +
      `Missed: ${count(onEdge, ({ first, second }) => !first && !second)}.`;
  }

  fill(place, draw, "Drag the vertices, and point at a pixel.",
    "Thick edges are top-left. At the vertices: the pixel's weights.",
    sheet.box, html("div", { class: "told" }, answer, shared, reset));
}
