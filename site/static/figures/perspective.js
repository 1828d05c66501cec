/** Lecture 05: weights on the screen are not weights on the face. */
import { edgeFunction, isCovered, screenWeights } from "./edge_functions.js";
import { clamp, fill, html, number, slider } from "./paper.js";
import { coded, Picture, probePixels } from "./picture.js";
import { minus } from "./vectors.js";

const WIDTH = 320, HEIGHT = 176, SQUARES = 8, DISTANCE = 2;
const UV = [[0, 0], [1, 0], [1, 1], [0, 1]];
const FACES = [[0, 1, 2], [0, 2, 3]];
const MARKED = [5, 2];                       // the column and the row of the orange square
const TILT = 55, CHOSEN = [128.5, 78.5];
const [LIGHT, DARK, ORANGE, AROUND] = [[0.96, 0.96, 0.94], [0.16, 0.3, 0.42], [0.9, 0.62, 0],
                                       [0.8, 0.88, 0.95]].map(coded);

/** Eq. (3): weights e on the screen -> weights b on the face, with the w of each corner. */
export function barycentricFromScreen(e, w) {
  const n = e.map((value, k) => value / w[k]);
  const sum = n[0] + n[1] + n[2];
  return n.map((value) => value / sum);
}

/** Eq. (5): b_0 A_0 + b_1 A_1 + b_2 A_2. */
export const interpolate = (b, attributes) => attributes[0].map((_, c) =>
  b[0] * attributes[0][c] + b[1] * attributes[1][c] + b[2] * attributes[2][c]);

/** Where (u, v) of the square is on the screen, and its w. The tilt, in degrees, moves its upper
 *  side away. */
export function project([u, v], tilt) {
  const angle = tilt * Math.PI / 180;
  const [x, up] = [2 * u - 1, 2 * v - 1];
  const w = DISTANCE + up * Math.sin(angle);
  const scale = 0.42 * HEIGHT * DISTANCE / w;
  return { point: [WIDTH / 2 + scale * x, HEIGHT / 2 + scale * up * Math.cos(angle)], w };
}

/** The nearest place where a weight can be read on the picture. */
const inside = ([x, y], scale) => [clamp(x, 22 / scale, WIDTH - 22 / scale),
                                   clamp(y, 0, HEIGHT - 18 / scale)];

/** What the pixel at p sees: the weights of the screen l and of the face b, and their (u, v). */
export function seenAt(p, tilt) {
  const corners = UV.map((uv) => project(uv, tilt));
  for (const face of FACES) {
    const triangle = face.map((k) => corners[k].point);
    if (!isCovered(p, triangle)) continue;
    const l = screenWeights(p, triangle);
    const b = barycentricFromScreen(l, face.map((k) => corners[k].w));
    const uv = face.map((k) => UV[k]);
    return { face, affine: { weights: l, uv: interpolate(l, uv) },
             right: { weights: b, uv: interpolate(b, uv) } };
  }
  return null;
}

/** Eq. (5) for a whole face: its numerators u and v and its denominator, which are linear on the
 *  screen, each as [by x, by y, at (0, 0)]. With w = 1 at all corners these are the screen's. */
function mixtures(face, corners, isAffine) {
  const points = face.map((k) => corners[k].point);
  const at = (p) => {
    const n = face.map((k, j) => edgeFunction(p, points[(j + 1) % 3], points[(j + 2) % 3]) /
                                 (isAffine ? 1 : corners[k].w));
    return [...interpolate(n, face.map((k) => UV[k])), n[0] + n[1] + n[2]];
  };
  const [origin, x, y] = [[0, 0], [1, 0], [0, 1]].map(at);
  return origin.map((value, k) => [x[k] - value, y[k] - value, value]);
}

/** A function (x, y) -> colour of the square, which allocates nothing. */
function board(tilt, isAffine) {
  const corners = UV.map((uv) => project(uv, tilt));
  const faces = FACES.map((face) => mixtures(face, corners, isAffine));
  const mix = ([byX, byY, start], x, y) => byX * x + byY * y + start;
  return (x, y) => {
    for (let k = 0; k < 2; k++) {
      const sum = mix(faces[k][2], x, y);
      const u = mix(faces[k][0], x, y) / sum, v = mix(faces[k][1], x, y) / sum;
      if (!(u >= 0 && u < 1 && v >= 0 && v < 1) || (v > u) !== (k === 1)) continue;
      const column = Math.floor(SQUARES * u), row = Math.floor(SQUARES * v);
      if (column === MARKED[0] && row === MARKED[1]) return ORANGE;
      return (column + row) % 2 ? LIGHT : DARK;
    }
    return AROUND;
  };
}

export function show(place) {
  let tilt = TILT, p = CHOSEN;
  const sides = [["affine", "Weights of the screen"], ["right", "Weights of the face"]].map(
    ([name, title]) => ({ name, title, picture: new Picture(WIDTH, HEIGHT, title, mark) }));
  const answer = html("p", { class: "verdict", role: "status" });
  probePixels(sides.map(({ picture }) => picture), CHOSEN, (to) => { p = to; });
  const control = slider({ label: "tilt", min: 0, max: 80, step: 1, value: TILT, unit: "°",
                           changed: (to) => { tilt = to; } });

  function draw() {
    for (const { name, picture } of sides) picture.fill(board(tilt, name === "affine"));
    mark();
  }

  function mark() {
    const seen = seenAt(p, tilt);
    const [column, row] = MARKED;
    const onScreen = ([u, v]) => project([u / SQUARES, v / SQUARES], tilt).point;
    const square = UV.map(([i, j]) => onScreen([column + i, row + j]));
    const diagonal = [[0, 0], [SQUARES, SQUARES]].map(onScreen);
    for (const { name, picture } of sides) {
      const uv = seen?.[name].uv;
      picture.draw(picture.line(diagonal, "diagonal"),
        ["halo", "true"].map((style) => picture.polygon(square, style)),
        uv ? picture.arrow(p, project(uv, tilt).point, "reads") : [], picture.cross(p),
        (seen?.face ?? []).map((corner, k) => picture.text(
          inside(project(UV[corner], tilt).point, picture.scale),
          number(seen[name].weights[k], 2), "label middle", [0, 4])));
    }
    const off = seen && SQUARES * Math.hypot(...minus(seen.affine.uv, seen.right.uv));
    answer.innerHTML = !seen ? "This pixel does not see the board."
      : `With the weights of the screen, the pixel reads a place that is ` +
        `<b class="red">${number(off, 2)} squares</b> away.`;
  }

  fill(place, draw, "Tilt the board, and point at a pixel.",
    "Its three weights stand at the corners.",
    html("div", { class: "two" }, ...sides.map(({ title, picture }) =>
      html("div", {}, html("p", {}, title), picture.box))),
    html("div", { class: "wide told" }, control.element, answer));
}
