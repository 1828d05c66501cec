/** Lecture 07: a triangle is a rubber sheet. A vertex that moves drags it along under a pixel. */
import { EDGES } from "./edge_functions.js";
import { button, clamp, fill, html, number } from "./paper.js";
import { coded, Picture, probePixels, rgb, swatch, toSrgb } from "./picture.js";
import { between, cross, dot, minus, plus } from "./vectors.js";

const WIDTH = 16, HEIGHT = 12;
const START = [[2.5, 2.5], [13, 4], [5.5, 10.5]], CHOSEN = [6.5, 5.5];
const VALUES = [0.9, 0.1, 0.4];          // r: the light of the vertices
const LEVELS = [0.25, 0.5, 0.75];        // the sheet's lines: where a weight has these values
const ARROW = 75;                        // pixels, for a gradient of 1

/** Eq. (7) on the screen, where w = 1: the rows q_i x q_j, which are det(M) M^-1. */
export const edgeNormals = (triangle) =>
  EDGES.map(([i, j]) => cross([...triangle[i], 1], [...triangle[j], 1]));

/** Eq. (9): the edge functions at a pixel, from which the corners are measured. */
export const edgeFunctionsAt = ([pX, pY], triangle) =>
  cross(triangle.map(([x]) => x - pX), triangle.map(([, y]) => y - pY));

/** M^-1, or null for a triangle without area. */
function inverse(triangle) {
  const edges = edgeNormals(triangle);
  const determinant = edges[0][2] + edges[1][2] + edges[2][2];
  return determinant === 0 ? null : edges.map((row) => row.map((t) => t / determinant));
}

const weightsAt = (rows, [x, y]) => rows.map((row) => dot(row, [x, y, 1]));

/** df/da: the slope of the picture. */
const slopeOf = (values, rows) => [0, 1].map((axis) => dot(values, rows.map((row) => row[axis])));

/** Eq. (4): the derivatives of pixels' residuals -> by the values [p][k], and by the vertices
 *  [p][k][axis]: minus weight times slope. */
export function residualsJacobian(values, triangle, points) {
  const rows = inverse(triangle), slope = slopeOf(values, rows);
  const byValues = points.map((point) => weightsAt(rows, point));
  return [byValues, byValues.map((c) => c.map((weight) => slope.map((t) => -weight * t)))];
}

const inside = (p) => p.map((t, axis) => clamp(t, 0.8, [WIDTH, HEIGHT][axis] - 0.8));

/** Where the weight of a vertex is read: behind its arrow, or beside it where no room is behind. */
function besideArrow(vertex, [dx, dy]) {
  const away = 1.4 / (Math.hypot(dx, dy) || 1);
  const behind = inside(plus(vertex, [dx, dy], -away));
  if (Math.hypot(...minus(behind, vertex)) > 1) return behind;
  const isInward = dot([dy, -dx], minus([WIDTH / 2, HEIGHT / 2], vertex)) > 0;
  return inside(plus(vertex, [dy, -dx], isInward ? away : -away));
}

/** The weights of the vertices at a pixel, or null if it does not see the triangle. */
function seenWeights(triangle, pixel) {
  const rows = inverse(triangle), c = rows && weightsAt(rows, pixel);
  return c?.every((weight) => weight >= 0) ? c : null;
}

const list = (numbers, digits) => numbers.map((t, k) =>
  `<b class="pull v${k}">${number(t, digits)}</b>`).join(", ");
const signed = (t) => `${t < 0 ? "−" : "+"}${Math.abs(t).toFixed(3)}`;
const shown = (light) => swatch(rgb(Array(3).fill(toSrgb(light))), light.toFixed(3));

export function show(place) {
  let triangle, before, last, pixel; // last: the vertex that moves, and has moved from `before`
  begin(START, CHOSEN);
  const picture = new Picture(WIDTH, HEIGHT,
    "A shaded triangle with lines on it, a framed pixel, and an arrow at each vertex", draw);
  const seen = html("p"), numbers = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  START.forEach((_, k) => picture.handle({
    name: `Vertex ${k}`, mark: String(k), style: `pull v${k}`, step: 0.1, at: () => triangle[k],
    limits: [0.5, WIDTH - 0.5, 0.5, HEIGHT - 0.5],
    moved: (to) => {
      if (k !== last) [before, last] = [triangle, k];
      triangle = triangle.with(k, to);
    } }));
  const choose = probePixels([picture], CHOSEN, (to, isChosen) => {
    if (isChosen) begin(triangle, to);
  });
  const reset = button("Reset", () => {
    choose(CHOSEN);
    begin(START, CHOSEN);
  });

  function begin(from, at) {
    [triangle, before, last, pixel] = [from, from, null, at];
  }

  function draw() {
    const rows = inverse(triangle);
    picture.fill((x, y) => {
      let light = 0;
      for (let k = 0; k < 3; k++) {
        const weight = rows ? rows[k][0] * x + rows[k][1] * y + rows[k][2] : -1;
        if (weight < 0) return 0; // transparent
        light += weight * VALUES[k];
      }
      light = toSrgb(light);
      return coded([light, light, light]);
    });
    const c = seenWeights(triangle, pixel), was = last !== null && seenWeights(before, pixel);
    const corner = pixel.map((t) => t - 0.5);
    picture.draw(
      drawSheet(), picture.polygon(triangle, "outline found"),
      ["frame halo", "frame"].map((style) => picture.rectangle(corner, 1, 1, style)),
      was ? drawMove(was[last]) : [], c ? drawArrows(c) : []);
    tell(c, was);
  }

  function drawSheet() {
    return EDGES.flatMap(([i, j], k) => LEVELS.map((level) => picture.line([i, j].map((end) =>
      between(triangle[end], triangle[k], level)), `drawn v${k}`)));
  }

  /** Where the triangle was, and the point of the sheet that was under the pixel. */
  function drawMove(weight) {
    const now = plus(pixel, minus(triangle[last], before[last]), weight);
    return [picture.polygon(before, "goal"),
      picture.line([before[last], triangle[last]], `moved v${last}`),
      picture.line([pixel, now], `moved v${last}`), picture.dot(now, 5, "sample point")];
  }

  function drawArrows(c) {
    const [, [byTriangle]] = residualsJacobian(VALUES, triangle, [pixel]);
    return triangle.map((vertex, k) => {
      const label = besideArrow(vertex, byTriangle[k]);
      return [...picture.arrow(vertex, plus(vertex, byTriangle[k], ARROW), `pull v${k}`),
              picture.text(label, c[k].toFixed(2), `label middle pull v${k}`, [0, -6])];
    });
  }

  function tell(c, was) {
    if (!c) {
      seen.innerHTML = "Pixel: background<br>Nothing pulls at it.";
      answer.textContent = "The pixel does not see the triangle: no arrows.";
      numbers.textContent = "";
      return;
    }
    const e = edgeFunctionsAt(pixel, triangle), light = dot(c, VALUES);
    const slope = slopeOf(VALUES, inverse(triangle)).map((t) => number(t)).join(", ");
    numbers.innerHTML = `Edge functions e (9): ${list(e, 1)}<br>` +
      `Weights, e / ${number(e[0] + e[1] + e[2], 1)} (8): ${list(c, 2)}<br>` +
      `Slope ∇f (7): (${slope})`;
    if (was) {
      tellMove(light, was);
    } else {
      seen.innerHTML = `Pixel: ${shown(light)}<br>Nothing has moved.`;
      answer.textContent = "Move a vertex along its arrow: the pixel becomes brighter.";
    }
  }

  function tellMove(light, weights) {
    const by = minus(triangle[last], before[last]);
    const [, [byTriangle]] = residualsJacobian(VALUES, before, [pixel]);
    const far = Math.hypot(...by), was = dot(weights, VALUES);
    seen.innerHTML = `Pixel: ${shown(was)}→ ${shown(light)}<br>by ${signed(light - was)}. ` +
      `The <b class="pull v${last}">arrow</b> said ${signed(dot(byTriangle[last], by))}.`;
    answer.textContent = `Vertex ${last} moved by ${far.toFixed(2)}, the sheet under the pixel ` +
      `by ${weights[last].toFixed(2)} · ${far.toFixed(2)} = ${(weights[last] * far).toFixed(2)}.`;
  }

  fill(place, draw, "Drag a vertex, or choose a pixel.",
    "The sheet goes along, the pixel in the frame stays. Each arrow is the pixel's derivative: " +
      "minus the picture's slope, times the weight of the vertex.",
    picture.box, html("div", { class: "told" }, seen, answer, numbers, reset));
}
