/** Lecture 01: the divide makes the frustum a square, and half of its depth lies near the eye. */
import { fill, html, number, Sheet } from "./paper.js";
import { dot } from "./vectors.js";

const FAR = 6, ASPECT = 1, HIGH = 0.4;         // posts reach from -HIGH to HIGH
const POSTS = Array.from({ length: 11 }, (_, k) => (k + 1) / 2);
const NEAR = 0.75, TOP = 2.4;                  // at the start: the near plane, the far plane's t
const GRIP = -3.2;                             // below the frustum

/** Eq. (5): l, r, b, t. */
export function frustumSides(fovY, aspect, near) {
  const t = near * Math.tan(fovY / 2);
  return [-aspect * t, aspect * t, -t, t];
}

/** Eq. (6). */
export function frustum(l, r, b, t, near, far) {
  const alpha = (far + near) / (near - far), beta = 2 * far * near / (near - far);
  return [[2 * near / (r - l), 0, (r + l) / (r - l), 0],
          [0, 2 * near / (t - b), (t + b) / (t - b), 0],
          [0, 0, alpha, beta],
          [0, 0, -1, 0]];
}

/** Eqs. (5) and (6). */
export const perspective = (fovY, aspect, near, far) =>
  frustum(...frustumSides(fovY, aspect, near), near, far);

/** Eq. (2), one matrix of it. */
export const transform = (point, matrix) => matrix.map((row) => dot(row, point));

/** Eq. (7). */
export const perspectiveDivide = ([x, y, z, w]) => [x / w, y / w, z / w];

/** The distance whose depth is 0, half of the range. */
export const halfway = (near, far) => 2 * near * far / (near + far);

/** Red at the eye, blue at the far plane, in both pictures. */
const colourAt = (distance) =>
  `stroke: color-mix(in oklab, var(--red), var(--blue) ${100 * distance / FAR}%)`;

export function show(place) {
  let near = NEAR, top = TOP;
  const scene = new Sheet([-0.5, FAR + 0.6, -3.7, 3.2],
                          "The camera and its frustum, from the side", draw);
  const ndc = new Sheet([-1.2, 1.2, -1.25, 1.15], "The same in ndc, a square", draw);
  const answer = html("p", { class: "wide verdict", role: "status" });
  scene.handle({ name: "Near plane", mark: "↔", style: "edge", step: 0.05, at: () => [near, GRIP],
                 limits: [0.2, 3.5, GRIP, GRIP], moved: ([to]) => { near = to; } });
  scene.handle({ name: "Field of view", mark: "↕", step: 0.05, at: () => [FAR, top],
                 limits: [FAR, FAR, 0.8, 2.8], moved: ([, to]) => { top = to; } });

  function draw() {
    const fovY = 2 * Math.atan(top / FAR), half = halfway(near, FAR);
    const matrix = perspective(fovY, ASPECT, near, FAR);
    const degrees = number(fovY * 180 / Math.PI, 0);
    const toScene = (d, y) => [d, y];
    const toNdc = (d, y) => {
      const [, yNdc, zNdc] = perspectiveDivide(transform([0, y, -d, 1], matrix));
      return [zNdc, yNdc];
    };
    scene.draw(
      POSTS.map((d) => scene.line([[d, -HIGH], [d, HIGH]], "post unseen")),
      seen(scene, toScene, half),
      scene.line([[near, 0], [near, GRIP]], "ray"),
      scene.text([near, GRIP], `near ${number(near)}`, "label edge", [18, -6]),
      scene.text([FAR, -top], `far ${FAR}`, "label first middle", [0, -20]),
      scene.dot([0, 0], 5, "sample point"), scene.text([0, 0], "eye", "middle", [0, 12]),
      scene.text([FAR, top], `field of view ${degrees}°`, "end", [-20, 8]));
    ndc.draw(
      seen(ndc, toNdc, half), ndc.text([0, 1], "in ndc", "middle", [0, 6]),
      ndc.text([-1, -1], "z = −1", "label edge middle", [10, -20]),
      ndc.text([0, -1], "0", "middle", [0, -20]),
      ndc.text([1, -1], "z = 1", "label first middle", [-10, -20]));
    answer.innerHTML = '<span class="green">Half of the depth</span>, −1 to 0, lies before ' +
      `distance ${number(half, 2)}, less than twice <span class="red">near</span>.`;
  }

  /** In both sheets the same, between the planes: at(distance, y) is where it is there. */
  function seen(sheet, at, half) {
    const t = (d) => top * d / FAR;
    const piece = (from, to, style) => sheet.polygon(
      [at(from, -t(from)), at(from, t(from)), at(to, t(to)), at(to, -t(to))], style);
    const across = (d, high, style, css) => sheet.line([at(d, -high), at(d, high)], style, css);
    const posts = POSTS.filter((d) => d >= near);
    return [
      piece(near, half, "volume half"), piece(half, FAR, "volume"),
      [-1, -0.5, 0, 0.5, 1].map((k) => sheet.line([at(near, k * t(near)), at(FAR, k * t(FAR))],
                                                 "axis")),
      posts.map((d) => across(d, t(d), "step", colourAt(d))),
      posts.map((d) => across(d, Math.min(HIGH, t(d)), "post", colourAt(d))),
      across(near, t(near), "plane red"), across(FAR, t(FAR), "plane blue")];
  }

  fill(place, draw, "Drag the near plane, or the field of view.",
    "The posts are of equal size and stand at equal steps.",
    html("div", { class: "two" }, scene.box, ndc.box), answer);
}
