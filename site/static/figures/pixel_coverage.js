/** Lecture 03: the exact coverage of pixels by a triangle, and its gradient.
 *  Pictures are rows of pixels, the lowest first. Triangles are counter-clockwise, on screen. */
import { centres, clamp } from "./elements.js";
import { between, minus, plus } from "./vectors.js";

/** Where the edge from p to q crosses the lines through a pixel's sides: t, from 0 to 1, sorted. */
const cuts = (p, q, corner) => [0, 1, ...[0, 1].flatMap((k) => [0, 1].map((side) =>
  clamp((corner[k] + side - p[k]) / (q[k] - p[k] || 1), 0, 1)))].sort((a, b) => a - b);

/** Eqs. (7) and (8): the edges, clamped to the pixel, enclose what it sees. */
function clampedArea(triangle, corner) {
  let twice = 0, last = null;
  for (let k = 0; k <= 3; k++) {
    const [p, q] = [triangle[k % 3], triangle[(k + 1) % 3]];
    for (const t of k < 3 ? cuts(p, q, corner) : [0]) {
      const point = minus(between(p, q, t), corner).map((at) => clamp(at, 0, 1));
      if (last) twice += last[0] * point[1] - point[0] * last[1];
      last = point;
    }
  }
  return twice / 2;
}

export const pixelCoverage = (triangle, width, height) =>
  centres(width, height).map((centre) => clampedArea(triangle, minus(centre, [0.5, 0.5])));

/** Eq. (9): dL/dcoverage -> dL/dvertices, from the edges' pieces in each pixel. */
export function pixelCoverageBackward(gradCoverage, triangle, width) {
  const grad = [[0, 0], [0, 0], [0, 0]];
  gradCoverage.forEach((gradArea, n) => {
    const corner = [n % width, Math.floor(n / width)];
    for (let k = 0; k < 3 && gradArea !== 0; k++) {
      const [p, q] = [triangle[k], triangle[(k + 1) % 3]];
      const normal = [q[1] - p[1], p[0] - q[0]];
      cuts(p, q, corner).forEach((t1, m, t) => {
        const t0 = t[m - 1] ?? 0;
        const middle = minus(between(p, q, (t0 + t1) / 2), corner);
        if (!middle.every((at) => at >= 0 && at < 1)) return;
        const byQ = gradArea * (t1 * t1 - t0 * t0) / 2, byP = gradArea * (t1 - t0) - byQ;
        grad[k] = plus(grad[k], normal, byP);
        grad[(k + 1) % 3] = plus(grad[(k + 1) % 3], normal, byQ);
      });
    }
  });
  return grad;
}
