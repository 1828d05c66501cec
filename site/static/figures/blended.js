/** One triangle before an empty background, drawn with lab 8's blend, and the way back from the
 *  picture to its vertices. A picture is an array of shades, 1 on the triangle, row 0 below. */
import { blendWeight, blendWeightBackward, crossing, crossingBackward, isBlended }
  from "./antialias.js";
import { EDGES, isCovered } from "./edge_functions.js";
import { centreOf, centres } from "./elements.js";
import { minus, plus } from "./vectors.js";

/** Lecture 08, eq. (2): a point in the frame of a pair of pixels along dx, dy. */
const pairFrame = ([x, y], [dx, dy, turned]) =>
  [turned * (dx * x + dy * y), dy * x + dx * y];

const pairFrameBackward = (gradX, gradY, [dx, dy, turned]) =>
  [turned * dx * gradX + dy * gradY, turned * dy * gradX + dx * gradY];

/** By which edge does the line y = 0 leave the triangle, on the way from owner to other? */
function lastCrossing(corners) {
  let edge = 0, c = -Infinity;
  EDGES.forEach(([i, j], k) => {
    if ((corners[i][1] < 0) === (corners[j][1] < 0)) return;
    const at = crossing(...corners[i], ...corners[j]);
    if (at > c) [edge, c] = [k, at];
  });
  return { edge, c };
}

/** The pairs of neighbours of which one is covered, and an edge blends them. */
function blendedPairs(inside, triangle, width, height) {
  const pairs = [];
  const look = (n, dx, dy) => {
    const next = n + dx + dy * width;
    if (inside[n] === inside[next]) return;
    const [owner, other, turned] = inside[n] ? [n, next, 1] : [next, n, -1];
    const centre = centreOf(owner, width);
    const frame = [dx, dy, turned];
    const corners = triangle.map((vertex) => pairFrame(minus(vertex, centre), frame));
    const { edge, c } = lastCrossing(corners);
    const ends = EDGES[edge].flatMap((k) => corners[k]);
    const isDropped = c === 0.5 && owner < other; // nothing moves there
    if (isBlended(c, ...ends) && !isDropped) pairs.push({ owner, other, c, ends, edge, frame });
  };
  for (let n = 0; n < width * height; n++) {
    if (n % width < width - 1) look(n, 1, 0);
    if (n < width * (height - 1)) look(n, 0, 1);
  }
  return pairs;
}

/** Which pixels' centres does a triangle (3 vertices, counter-clockwise) cover? */
export const covered = (triangle, width, height) =>
  centres(width, height).map((centre) => isCovered(centre, triangle));

/** -> the picture of a triangle, and the pairs that it blends. */
export function render(triangle, width, height) {
  const inside = covered(triangle, width, height);
  const pairs = blendedPairs(inside, triangle, width, height);
  const picture = Float64Array.from(inside, Number);
  for (const { owner, other, c } of pairs) {
    const alpha = blendWeight(c);
    picture[alpha > 0 ? owner : other] -= alpha;
  }
  return { picture, pairs };
}

/** gradPicture -> the gradient with respect to the three vertices. */
export function renderBackward(gradPicture, pairs) {
  const gradients = [[0, 0], [0, 0], [0, 0]];
  for (const { owner, other, c, ends, edge, frame } of pairs) {
    const gradAlpha = -gradPicture[blendWeight(c) >= 0 ? owner : other];
    const gradEnds = crossingBackward(blendWeightBackward(gradAlpha, c), ...ends);
    EDGES[edge].forEach((vertex, end) => {
      gradients[vertex] = plus(gradients[vertex], pairFrameBackward(
        gradEnds[2 * end], gradEnds[2 * end + 1], frame));
    });
  }
  return gradients;
}

/** Lecture 09, eq. (2). */
export const squaredError = (picture, target) =>
  picture.reduce((sum, shade, n) => sum + (shade - target[n]) ** 2, 0) / picture.length;

export const squaredErrorBackward = (picture, target) =>
  picture.map((shade, n) => 2 * (shade - target[n]) / picture.length);

/** -> the loss of a triangle, its picture, and the gradient with respect to its vertices. */
export function lossOf(triangle, target, width, height) {
  const { picture, pairs } = render(triangle, width, height);
  return { loss: squaredError(picture, target), picture,
           gradients: renderBackward(squaredErrorBackward(picture, target), pairs) };
}

/** Lecture 09, eq. (3): step n of Adam -> x', m', s'. All are arrays of numbers. */
export function adamStep(x, gradX, mean, square, n, rate) {
  const [b1, b2, epsilon] = [0.9, 0.999, 1e-8];
  const m = mean.map((old, k) => b1 * old + (1 - b1) * gradX[k]);
  const s = square.map((old, k) => b2 * old + (1 - b2) * gradX[k] ** 2);
  const next = x.map((old, k) =>
    old - rate * m[k] / (1 - b1 ** n) / (Math.sqrt(s[k] / (1 - b2 ** n)) + epsilon));
  return [next, m, s];
}
