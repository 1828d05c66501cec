/** Lecture 16 in the plane: a camera's row of pixels, and what they pull at the grid's numbers. */
import { crossingsBackward, marchingTriangles } from "./sign_grid.js";
import { between, plus } from "./vectors.js";

export const EYE = [0, -1.3], STRIP = -0.2;   // the camera, and the height of its row of pixels
export const PIXELS = 20, WIDTH = 0.086;      // WIDTH of a pixel, in the row
const WEIGHTS = { coverage: 1, carving: 4 };

/** A point -> where in the row of pixels the camera sees it, in pixels. */
export const onStrip = ([x, y]) =>
  PIXELS / 2 + (x - EYE[0]) * (STRIP - EYE[1]) / (y - EYE[1]) / WIDTH;

/** Backward of onStrip -> dL/dpoint. */
function onStripBackward(grad, [x, y]) {
  const perUnit = grad * (STRIP - EYE[1]) / (y - EYE[1]) / WIDTH;
  return [perUnit, -perUnit * (x - EYE[0]) / (y - EYE[1])];
}

/** The segment that each pixel's centre sees first, and how far along it: {segment, u}, or null. */
function firstHits(vertices, segments) {
  const hits = Array(PIXELS).fill(null);
  const place = vertices.map(({ p }) => onStrip(p));
  segments.forEach(([from, to], segment) => {
    const [p, q] = [vertices[from].p, vertices[to].p];
    for (let k = Math.max(0, Math.ceil(place[from] - 0.5)); k + 0.5 < place[to]; k++) {
      if (k >= PIXELS) return;
      const slope = (k + 0.5 - PIXELS / 2) * WIDTH / (STRIP - EYE[1]);
      const [e, f] = [p, q].map(([x, y]) => x - EYE[0] - slope * (y - EYE[1]));
      const u = e / (e - f), at = between(p, q, u);
      if (!hits[k] || at[1] < hits[k].at[1]) hits[k] = { segment, u, at };
    }
  });
  return hits;
}

/** Lecture 08 in a row of pixels: -> coverage, hits, and outlines {pixel, vertex, side}:
 *  the pixel's coverage grows if the vertex moves to this side (1: right, -1: left). */
export function render(vertices, segments) {
  const hits = firstHits(vertices, segments), outlines = [];
  const coverage = hits.map((hit) => (hit ? 1 : 0));
  const place = vertices.map(({ p }) => onStrip(p));
  const [after, before] = [0, 1].map((end) =>
    new Map(segments.map((segment) => [segment[end], segment[1 - end]])));
  hits.forEach((hit, owner) => [1, -1].forEach((side) => {
    const other = owner + side;
    if (!hit || other < 0 || other >= PIXELS || hits[other]) return;
    const next = side === 1 ? after : before;
    let vertex = segments[hit.segment][side === 1 ? 1 : 0];
    while (side * (place[next.get(vertex)] - place[vertex]) > 0) vertex = next.get(vertex);
    const alpha = 0.5 - side * (place[vertex] - owner - 0.5);
    const pixel = alpha > 0 ? owner : other;
    coverage[pixel] -= alpha;
    outlines.push({ pixel, vertex, side });
  }));
  return { coverage, hits, outlines };
}

/** Backward of the coverage -> dL/dp of each vertex. */
export function coverageBackward(gradCoverage, outlines, vertices) {
  const gradients = vertices.map(() => [0, 0]);
  for (const { pixel, vertex, side } of outlines) {
    gradients[vertex] = plus(gradients[vertex], onStripBackward(
      gradCoverage[pixel] * side, vertices[vertex].p));
  }
  return gradients;
}

/** Which pixels, and both beside them, show nothing? */
export const isOutside = (coverage) => coverage.map((_, k) =>
  [k - 1, k, k + 1].every((n) => !(coverage[n] > 0)));

/** Backward of eq. (6), carving, at the pixels named -> dL/ds of each vertex. */
export function carvingBackward(gradCarving, pixels, hits, segments, count) {
  const gradLevel = Array(count).fill(0);
  for (const { segment, u } of pixels.flatMap((k) => hits[k] ?? [])) {
    gradLevel[segments[segment][0]] -= gradCarving * (1 - u) / PIXELS;
    gradLevel[segments[segment][1]] -= gradCarving * u / PIXELS;
  }
  return gradLevel;
}

/** Backward of s at the vertices, eq. (6), with t held -> dL/ds of the grid's points. */
export function levelBackward(gradLevel, ends, distance) {
  const gradient = distance.map(() => 0);
  ends.forEach(([a, b], n) => {
    const t = distance[a] / (distance[a] - distance[b]);
    gradient[a] += (1 - t) * gradLevel[n];
    gradient[b] += t * gradLevel[n];
  });
  return gradient;
}

/** What these pixels pull: dL/ds of the grid's points, by coverage (5) and carving (6). */
export function pull(pixels, target, distance) {
  const { vertices, segments } = marchingTriangles(distance);
  const { coverage, hits, outlines } = render(vertices, segments);
  const outside = isOutside(target);
  const gradCoverage = coverage.map((o, k) =>
    (pixels.includes(k) ? 2 * WEIGHTS.coverage * (o - target[k]) / PIXELS : 0));
  const gradP = coverageBackward(gradCoverage, outlines, vertices);
  const gradLevel = carvingBackward(WEIGHTS.carving, pixels.filter((k) => outside[k]), hits,
                                    segments, vertices.length);
  return plus(crossingsBackward(gradP, vertices, distance),
              levelBackward(gradLevel, vertices.map(({ a, b }) => [a, b]), distance));
}
