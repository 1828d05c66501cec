/** Lecture 03: the exact coverage of pixels by a triangle, and its gradient.
 *  Pictures are rows of pixels, the lowest first. Triangles are counter-clockwise, on screen. */
import { clamp } from "./elements.js";

export const picture = (width, height, valueAt) => Float64Array.from({ length: width * height },
  (_, n) => valueAt(n % width, Math.floor(n / width)));

export const noGradient = () => [[0, 0], [0, 0], [0, 0]];

/** Where the edge from p to q crosses the lines through a pixel's sides: t, from 0 to 1, sorted. */
function cuts(p, q, corner) {
  const t = [0, 1];
  for (const k of [0, 1]) {
    for (const side of [corner[k], corner[k] + 1]) {
      t.push(clamp((side - p[k]) / (p[k] === q[k] ? 1 : q[k] - p[k]), 0, 1));
    }
  }
  return t.sort((a, b) => a - b);
}

/** Eqs. (7) and (8): the edges, clamped to the pixel, enclose what it sees. */
export function clampedArea(triangle, x, y) {
  let twice = 0, last = null;
  for (let k = 0; k <= 3; k++) {
    const [p, q] = [triangle[k % 3], triangle[(k + 1) % 3]];
    for (const t of k < 3 ? cuts(p, q, [x, y]) : [0]) {
      const point = [clamp(p[0] + t * (q[0] - p[0]) - x, 0, 1),
                     clamp(p[1] + t * (q[1] - p[1]) - y, 0, 1)];
      if (last) twice += last[0] * point[1] - point[0] * last[1];
      last = point;
    }
  }
  return twice / 2;
}

export const pixelCoverage = (triangle, width, height) =>
  picture(width, height, (j, i) => clampedArea(triangle, j, i));

/** Eq. (9): dL/dcoverage -> dL/dvertices, from the edges' pieces in each pixel. */
export function pixelCoverageBackward(gradCoverage, triangle, width) {
  const grad = noGradient();
  gradCoverage.forEach((gradArea, n) => {
    const corner = [n % width, Math.floor(n / width)];
    for (let k = 0; k < 3 && gradArea !== 0; k++) {
      const [p, q] = [triangle[k], triangle[(k + 1) % 3]];
      const normal = [q[1] - p[1], p[0] - q[0]];
      cuts(p, q, corner).forEach((t1, m, t) => {
        const t0 = t[m - 1] ?? 0;
        const isInside = [0, 1].every((axis) => {
          const middle = p[axis] + (t0 + t1) / 2 * (q[axis] - p[axis]) - corner[axis];
          return middle >= 0 && middle < 1;
        });
        if (!isInside) return;
        const byQ = gradArea * (t1 * t1 - t0 * t0) / 2, byP = gradArea * (t1 - t0) - byQ;
        for (const axis of [0, 1]) {
          grad[k][axis] += byP * normal[axis];
          grad[(k + 1) % 3][axis] += byQ * normal[axis];
        }
      });
    }
  });
  return grad;
}
