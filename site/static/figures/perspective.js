/** Lecture 05: weights on the screen are not weights on the face. */
import { isCovered, screenWeights } from "./edge_functions.js";
import { button, html, number, slider, table } from "./paper.js";
import { Picture, probeAll } from "./picture.js";

const WIDTH = 160, HEIGHT = 88, SQUARES = 8;
const UV = [[0, 0], [1, 0], [1, 1], [0, 1]];
const FACES = [[0, 1, 2], [0, 2, 3]];
const MARKED = [5, 2];                       // the column and the row of the orange square
const START = { tilt: 55, distance: 2 }, CHOSEN = [64.5, 39.5];
const LIGHT = [0.96, 0.96, 0.94], DARK = [0.16, 0.3, 0.42], ORANGE = [0.9, 0.62, 0];
const AROUND = [0.8, 0.88, 0.95];

/** Eq. (3): weights e on the screen -> weights b on the face, with the w of each corner. */
export function barycentricFromScreen(e, w) {
  const n = e.map((value, k) => value / w[k]);
  const sum = n[0] + n[1] + n[2];
  return n.map((value) => value / sum);
}

/** Eq. (5): b_0 A_0 + b_1 A_1 + b_2 A_2. */
export const interpolate = (b, attributes) => attributes[0].map((_, c) =>
  b[0] * attributes[0][c] + b[1] * attributes[1][c] + b[2] * attributes[2][c]);

/** Where (u, v) of the tilted square is on the screen, and its w. The distance does not change
 *  the square's size. The tilt, in degrees, moves its upper side away. */
export function project([u, v], { tilt, distance }) {
  const angle = tilt * Math.PI / 180;
  const [x, up] = [2 * u - 1, 2 * v - 1];
  const w = distance + up * Math.sin(angle);
  const scale = 0.42 * HEIGHT * distance / w;
  return { point: [WIDTH / 2 + scale * x, HEIGHT / 2 + scale * up * Math.cos(angle)], w };
}

/** What the pixel at p sees: the weights of the screen l and of the face b, and their (u, v). */
export function seenAt(p, camera, corners = UV.map((uv) => project(uv, camera))) {
  for (const face of FACES) {
    const triangle = face.map((k) => corners[k].point);
    if (!isCovered(p, triangle)) continue;
    const w = face.map((k) => corners[k].w);
    const l = screenWeights(p, triangle);
    const b = barycentricFromScreen(l, w);
    const uv = face.map((k) => UV[k]);
    return { face, w, l, b, affine: interpolate(l, uv), right: interpolate(b, uv) };
  }
  return null;
}

function checkerboard(uv) {
  const [column, row] = uv.map((t) => Math.floor(SQUARES * t));
  if (column === MARKED[0] && row === MARKED[1]) return ORANGE;
  return (column + row) % 2 ? LIGHT : DARK;
}

export function show(place) {
  let camera = START, p = CHOSEN;
  const sides = [["affine", "Weights of the screen"], ["right", "Weights of the face"]].map(
    ([name, title]) => ({ name, title, picture: new Picture(WIDTH, HEIGHT, title, mark) }));
  const numbers = table("The pixel's weights",
    ["corner", "<i>w<sub>k</sub></i>", "screen <i>l<sub>k</sub></i>",
     "face <i>b<sub>k</sub></i>"], ["·", "·", "·"]);
  const places = table("The pixel's place on the texture", ["weights", "<i>u</i>", "<i>v</i>"],
    ["screen", "face"]);
  const answer = html("p", { class: "verdict", role: "status" });
  const choose = probeAll(sides.map(({ picture }) => picture), CHOSEN, (to) => {
    p = to;
    mark();
  });
  const sliders = [
    slider({ label: "tilt", min: 0, max: 80, step: 1, value: START.tilt, unit: "°",
             changed: (tilt) => draw({ ...camera, tilt }) }),
    slider({ label: "distance", min: 1.4, max: 6, step: 0.1, value: START.distance,
             changed: (distance) => draw({ ...camera, distance }) })];
  const reset = button("Reset", () => {
    sliders.forEach((each, k) => each.set(k ? START.distance : START.tilt));
    choose(CHOSEN);
    p = CHOSEN;
    draw(START);
  });

  function draw(to) {
    camera = to;
    const corners = UV.map((uv) => project(uv, camera));
    for (const { name, picture } of sides) {
      picture.paint((x, y) => {
        const seen = seenAt([x, y], camera, corners);
        return seen ? checkerboard(seen[name]) : AROUND;
      });
    }
    mark();
  }

  function mark() {
    const seen = seenAt(p, camera);
    const [column, row] = MARKED;
    const square = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]].map(([i, j]) =>
      project([(column + i) / SQUARES, (row + j) / SQUARES], camera).point);
    for (const { name, picture } of sides) {
      const diagonal = [0, 2].map((k) => project(UV[k], camera).point);
      const read = seen && name === "affine" ? project(seen.affine, camera).point : p;
      picture.draw(picture.line(diagonal, "diagonal"), picture.line(square, "halo"),
        picture.line(square, "true"), picture.arrow(p, read, "reads"), picture.cross(p));
    }
    tell(seen);
  }

  function tell(seen) {
    numbers.element.querySelectorAll("tbody th").forEach((cell, k) => {
      cell.textContent = seen ? seen.face[k] : "–";
    });
    const none = ["–", "–", "–"];
    numbers.write([0, 1, 2].map((k) =>
      (seen ? [seen.w, seen.l, seen.b].map((list) => number(list[k])) : none)));
    places.write(["affine", "right"].map((name) =>
      (seen ? seen[name].map((t) => number(t)) : ["–", "–"])));
    const off = seen && SQUARES * Math.hypot(seen.affine[0] - seen.right[0],
                                             seen.affine[1] - seen.right[1]);
    answer.textContent = seen ? `The screen's weights are off by ${number(off, 2)} squares.`
      : "This pixel does not see the square.";
  }

  place.append(html("div", { class: "pane" },
    html("p", { class: "task" }, "Tilt the board. Point at a pixel. ",
      html("span", {}, "Red: where the orange square truly is. " +
        "The arrow leads to the place whose colour the left pixel shows.")),
    html("div", { class: "two" }, ...sides.map(({ title, picture }) =>
      html("div", {}, html("p", {}, title), picture.box))),
    html("div", { class: "two" }, html("div", { class: "told" },
      ...sliders.map((each) => each.element), answer, reset),
      html("div", { class: "told" }, numbers.element, places.element))));
  draw(START);
}
