/** Lecture 10: the sweep of neural_renderer and the soft silhouette of SoftRas, for one triangle.
 *  Pictures and triangles are those of pixel_coverage.js. */
import { EDGES, edgeFunction } from "./edge_functions.js";
import { centreOf, centres, clamp } from "./elements.js";
import { dot, minus, plus } from "./vectors.js";

const LEAST_PROBABILITY = 1e-6;

// neural_renderer's sweep

/** Eqs. (7) and (8): one line of pixels, crossed at x by an edge that has its outside on a side.
 *  -> the gradient of the edge's ends, in ndc. */
function sweepLine(gradColour, colour, x, side, share, eps) {
  const inner = side > 0 ? Math.floor(x - 0.5) : Math.ceil(x - 0.5), outer = inner + side;
  if (Math.min(inner, outer) < 0 || Math.max(inner, outer) >= colour.length) return [0, 0];
  const grad = [0, 0];
  for (let j = 0; j < colour.length; j++) {
    const isOut = (j - inner) * side > 0;
    if (!(isOut ? colour[inner] : colour[j])) continue; // does it see the face?
    const fall = Math.max(0, (colour[j] - colour[isOut ? inner : outer]) * gradColour[j]);
    const way = 2 / colour.length * (j + 0.5 - x);
    for (const end of [0, 1]) {
      const scaled = way + (isOut ? side : -side) * eps * share[end];
      if (share[end] > 0) grad[end] -= fall * share[end] / scaled;
    }
  }
  return grad;
}

/** Eq. (7) along all rows, for x, and along all columns, for y -> dL/dvertices, in ndc. */
export function sweepBackward(gradColour, colour, triangle, width, height, eps) {
  const grad = [[0, 0], [0, 0], [0, 0]], size = [width, height], step = [1, width];
  if (!colour.some((value) => value)) return grad;
  for (const [x, y] of [[0, 1], [1, 0]]) {
    const lineOf = (values, row) => Array.from({ length: size[x] },
      (_, j) => values[j * step[x] + row * step[y]]);
    for (const [i, j] of EDGES) {
      const [a, b] = [triangle[i], triangle[j]];
      const first = Math.max(Math.ceil(Math.min(a[y], b[y]) - 0.5), 0);
      const end = Math.min(Math.floor(Math.max(a[y], b[y]) + 0.5), size[y]);
      for (let row = first; row < end && a[y] !== b[y]; row++) {
        const share = (row + 0.5 - a[y]) / (b[y] - a[y]);
        const pulls = sweepLine(lineOf(gradColour, row), lineOf(colour, row),
                                a[x] + share * (b[x] - a[x]),
                                (x ? -1 : 1) * Math.sign(b[y] - a[y]), [1 - share, share], eps);
        grad[i][x] += pulls[0];
        grad[j][x] += pulls[1];
      }
    }
  }
  return grad;
}

// SoftRas

/** The nearest point of a triangle's border: on which edge, at which t, and how far away. */
function nearestOnBorder(point, triangle) {
  const found = EDGES.map(([i, j], edge) => {
    const [a, b] = [triangle[i], triangle[j]];
    const along = minus(b, a), from = minus(point, a);
    const t = clamp(dot(from, along) / dot(along, along), 0, 1), away = plus(from, along, -t);
    return { edge, t, away, square: dot(away, away), e: edgeFunction(point, a, b) };
  });
  const nearest = found.reduce((a, b) => (b.square < a.square ? b : a));
  return { ...nearest, sign: found.every(({ e }) => e > 0) ? 1 : -1 };
}

/** Eq. (9) of a pixel, and what its derivative needs. */
function softPixel(triangle, centre, sigma) {
  const near = nearestOnBorder(centre, triangle);
  const probability = 1 / (1 + Math.exp(-near.sign * near.square / sigma));
  return { ...near, probability: probability > LEAST_PROBABILITY ? probability : 0 };
}

export const softSilhouette = (triangle, width, height, sigma) =>
  centres(width, height).map((centre) => softPixel(triangle, centre, sigma).probability);

export function softSilhouetteBackward(gradSilhouette, triangle, width, sigma) {
  const grad = [[0, 0], [0, 0], [0, 0]];
  gradSilhouette.forEach((gradS, n) => {
    const { edge, t, away, sign, probability } = softPixel(triangle, centreOf(n, width), sigma);
    const scale = -2 * gradS * probability * (1 - probability) * sign / sigma;
    EDGES[edge].forEach((k, end) => {
      grad[k] = plus(grad[k], away, scale * (end ? t : 1 - t));
    });
  });
  return grad;
}
