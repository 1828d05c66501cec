/** Lecture 10: one triangle, a target, and what four gradients say of the triangle's outline. */
import { covered, render, renderBackward } from "./blended.js";
import { signedArea } from "./edge_functions.js";
import { softSilhouette, softSilhouetteBackward, sweepBackward } from "./outline_gradients.js";
import { button, clamp, fill, html, number, say, slider } from "./paper.js";
import { Picture, toSrgb } from "./picture.js";
import { pixelCoverage, pixelCoverageBackward } from "./pixel_coverage.js";
import { dot, minus, plus } from "./vectors.js";

const WIDTH = 24, HEIGHT = 14, SIZE = [WIDTH, HEIGHT];
const GOAL = [[15, 2.5], [22, 4.75], [17, 11.25]];
const START = GOAL.map(([x, y]) => [x - 8, y]);
const LOG_EPS = -2, SIGMA = 5;           // at the start
const TINT = [0.05, 0.25, 0.7];          // how much red, green and blue the target takes away
const WHY = {
  truth: "The derivative of the exact coverage. Only pixels on the outline count.",
  sweep: "Every wrong pixel of a row or column pulls at the edges that cross it, near ones most, " +
    "though ε limits them. It reaches far along rows and columns, and is many times too strong.",
  soft: "The derivative of a blurred picture. It reaches as far as the blur, which grows with σ.",
  blend: "Lab 8: pairs of pixels at the outline are blended. It is near the truth, and reaches " +
    "no farther.",
};

/** Each method's picture of a triangle, and its gradient by the vertices, in pixels. */
const METHODS = {
  truth: (triangle) => ({
    picture: pixelCoverage(triangle, ...SIZE),
    backward: (grad) => pixelCoverageBackward(grad, triangle, WIDTH) }),
  sweep: (triangle, eps) => {
    const picture = Float64Array.from(covered(triangle, ...SIZE), Number);
    return { picture, backward: (grad) =>
      sweepBackward(grad, picture, triangle, ...SIZE, eps)
        .map(([x, y]) => [x * 2 / WIDTH, y * 2 / HEIGHT]) };
  },
  soft: (triangle, sigma) => ({
    picture: softSilhouette(triangle, ...SIZE, sigma),
    backward: (grad) => softSilhouetteBackward(grad, triangle, WIDTH, sigma) }),
  blend: (triangle) => {
    const { picture, pairs } = render(triangle, ...SIZE);
    return { picture, backward: (grad) => renderBackward(grad, pairs) };
  },
};

/** A method's picture, and its gradient of the squared difference from a target's coverage. */
function gradientBy(name, triangle, target, setting) {
  const { picture, backward } = METHODS[name](triangle, setting);
  return { picture, gradient: backward(picture.map((value, n) => 2 * (value - target[n]))) };
}

const totalOf = (vectors) => vectors.reduce((sum, vector) => plus(sum, vector));

/** The middle of a triangle. */
const middleOf = (points) => totalOf(points).map((t) => t / 3);

/** How strongly a descent step pulls the triangle as a whole to the target. */
function pullTo(target, triangle, gradient) {
  const way = minus(middleOf(target), middleOf(triangle));
  return -dot(totalOf(gradient), way) / Math.max(Math.hypot(...way), 1e-9);
}

/** The arrow of a descent step. Its length is a logarithm: 1 is seen, and 1000 fits. */
function arrowOf([x, y]) {
  const length = Math.hypot(x, y);
  return [x, y].map((t) => (length > 0 ? -t * Math.asinh(length) / length : 0));
}

export function show(place) {
  const target = pixelCoverage(GOAL, ...SIZE), names = Object.keys(METHODS);
  let points, name, settings;
  const picture = new Picture(WIDTH, HEIGHT,
    "A triangle, its target, and arrows: where a descent step moves vertices and triangle", draw);
  const why = html("p", { class: "why", role: "status" });
  const pulls = names.map(() => html("b"));
  const buttons = names.map((method, k) => {
    const element = button(method, () => { name = method; });
    element.classList.add(method);
    element.append(pulls[k]);
    return element;
  });
  const sliders = {
    sweep: slider({ label: "log₁₀ ε", min: -4, max: -1, step: 0.25, value: LOG_EPS,
                    changed: (to) => { settings.sweep = 10 ** to; } }),
    soft: slider({ label: "σ", min: 0.05, max: 5, step: 0.05, value: SIGMA,
                   changed: (to) => { settings.soft = to; } }) };
  begin();
  const grid = { style: "ink", step: 0.25, limits: [0, WIDTH, 0, HEIGHT] };
  picture.handle({ ...grid, name: "The triangle", at: () => middleOf(points), moved: moveAll });
  picture.handle({ ...grid, name: "Vertex 2", mark: "2", at: () => points[2], moved: moveOne });

  function begin() {
    [points, name, settings] = [START, "sweep", { sweep: 10 ** LOG_EPS, soft: SIGMA }];
    sliders.sweep.set(LOG_EPS);
    sliders.soft.set(SIGMA);
  }

  function moveAll(to) {
    const shift = middleOf(points).map((from, axis) => {
      const along = points.map((point) => point[axis]);
      return clamp(Math.round(4 * (to[axis] - from)) / 4,
                   -Math.min(...along), SIZE[axis] - Math.max(...along));
    });
    points = points.map((point) => plus(point, shift));
  }

  function moveOne(to) {
    const moved = points.with(2, to);
    if (signedArea(moved) > 2) points = moved;
  }

  function draw() {
    const found = Object.fromEntries(names.map((method) =>
      [method, gradientBy(method, points, target, settings[method])]));
    names.forEach((method, k) => {
      buttons[k].setAttribute("aria-pressed", method === name);
      pulls[k].textContent = number(pullTo(GOAL, points, found[method].gradient), 0);
    });
    for (const key of Object.keys(sliders)) sliders[key].element.hidden = key !== name;
    say(why, WHY[name]);
    picture.paint((n) => TINT.map((tint) =>
      toSrgb((1 - 0.8 * found[name].picture[n]) * (1 - tint * target[n]))));
    const middle = middleOf(points);
    const arrows = (method) => [
      ...points.map((point, k) => picture.arrow(
        point, plus(point, arrowOf(found[method].gradient[k])), `pull ${method}`)),
      picture.arrow(middle, plus(middle, arrowOf(totalOf(found[method].gradient))),
                    `pull all ${method}`)];
    picture.draw(picture.polygon(GOAL, "outline second"),
                 picture.text([20.3, 8.7], "target", "label second"),
                 picture.polygon(points, "outline ink"),
                 arrows("truth"), name === "truth" ? [] : arrows(name));
  }

  fill(place, draw, "Which gradient knows where the target is?",
    "Choose one. Drag the triangle by its middle, or its vertex 2. Black arrows show the true " +
      "gradient.",
    picture.box,
    html("div", { class: "told" },
      html("p", {}, "Pull on the whole triangle (thick arrow), towards the target (0: none):"),
      html("div", { class: "four", role: "group", "aria-label": "Gradient" }, ...buttons),
      why, html("div", { class: "setting" }, ...Object.values(sliders).map((s) => s.element),
                button("Reset", begin))));
}
