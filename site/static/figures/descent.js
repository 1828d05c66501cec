/** Lecture 00: a triangle descends to the one that made a picture. */
import { adamStep, lossOf, render } from "./blended.js";
import { signedArea } from "./edge_functions.js";
import { centreOf, clamp, fill, html, playAndReset, say, Sheet } from "./paper.js";
import { plus } from "./vectors.js";

const WIDTH = 24, HEIGHT = 16, STEPS = 240;
const TARGET = [[5.3, 3.1], [20.4, 5.8], [9.6, 14.2]];
const START = [[2.2, 9.6], [12.4, 1.3], [18.7, 12.4]];
const ARROW = 40;                        // pixels, for a gradient of 1; with its root
const FOUND = 1e-5;                      // the loss below which nobody sees a difference
const LOWEST = -5, HIGHEST = 0;          // of the curve: powers of ten

/** The learning rate of step n, in pixels: it falls by a factor of 100. */
const rate = (n) => 0.3 * 0.01 ** (n / STEPS);

const isFlat = (gradients) => gradients.flat().every((slope) => slope === 0);

function verdict(triangle, { gradients, loss }) {
  if (signedArea(triangle) <= 0) return "It is turned over or flat. No pixel shows it.";
  if (loss < FOUND) return "Found: the picture is the target.";
  return isFlat(gradients) ? "No pixel is blended: no gradient."
    : "The pixels along its edges pull at all three vertices.";
}

export function show(place) {
  const target = render(TARGET, WIDTH, HEIGHT).picture;
  let triangle, means, squares, step, losses;
  begin(START);
  const sheet = new Sheet([0, WIDTH, 0, HEIGHT],
    "A triangle on a grid of 24 by 16 pixels, and the outline of the one that is looked for", draw);
  const curve = new Sheet([0, STEPS, LOWEST * 14 - 16, HIGHEST * 14],
    "The loss after each step, falling", draw);
  const said = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  START.forEach((_, k) => sheet.handle({
    name: `Vertex ${k}`, mark: String(k), step: 0.05, limits: [0, WIDTH, 0, HEIGHT],
    at: () => triangle[k], moved: (to) => begin(triangle.with(k, to)) }));
  const buttons = playAndReset(() => {
    const found = lossOf(triangle, target, WIDTH, HEIGHT);
    if (step === STEPS || found.loss < 1e-6 || isFlat(found.gradients)) return false;
    descend(found.gradients);
    return true;
  }, () => begin(START), draw);

  function begin(from) {
    [triangle, means, squares, step, losses] = [from, Array(6).fill(0), Array(6).fill(0), 0, []];
  }

  function descend(gradients) {
    step += 1;
    let x;
    [x, means, squares] = adamStep(triangle.flat(), gradients.flat(), means, squares, step,
                                   rate(step));
    triangle = [0, 1, 2].map((k) => [clamp(x[2 * k], 0, WIDTH), clamp(x[2 * k + 1], 0, HEIGHT)]);
  }

  function draw() {
    const found = lossOf(triangle, target, WIDTH, HEIGHT);
    losses[step] = found.loss;
    sheet.draw(
      Array.from(found.picture, (shade, n) => pixel(n, shade, target[n])),
      sheet.polygon(TARGET, "goal"), sheet.polygon(triangle, "outline found"),
      found.loss < FOUND ? [] : triangle.map((vertex, k) => pull(vertex, found.gradients[k])));
    curve.draw(curve.line([[0, 0], [0, LOWEST * 14], [STEPS, LOWEST * 14]], "axis"),
      curve.text([STEPS, 0], "loss", "label descent end", [0, -13]),
      curve.text([STEPS, LOWEST * 14], "step", "end", [0, -20]),
      curve.line(losses.map((loss, n) =>
        [n, 14 * clamp(Math.log10(loss), LOWEST, HIGHEST)]), "curve descent"));
    said.innerHTML = `Step ${step}: loss <b class="green">${found.loss.toFixed(5)}</b>`;
    say(answer, verdict(triangle, found));
  }

  function pull(vertex, gradient) {
    const times = -ARROW / Math.sqrt(Math.hypot(...gradient) || 1);
    return sheet.arrow(vertex, plus(vertex, gradient, times), "descent");
  }

  /** What a pixel and its target agree on, and what one of them has more. */
  function pixel(n, shade, wanted) {
    const corner = centreOf(n, WIDTH).map((t) => t - 0.5);
    return [["agrees", Math.min(shade, wanted)], ["extra", shade - wanted],
            ["missing", wanted - shade]].filter(([, share]) => share > 0.004)
      .map(([style, share]) => sheet.rectangle(corner, 1, 1, style, `fill-opacity: ${share}`));
  }

  fill(place, draw, "Drag a vertex, or press Play.",
    '<b class="blue">Blue</b> pixels are still missing, <b class="orange">orange</b> ones ' +
      'should not be there. The <b class="green">green</b> arrows are the gradient, turned ' +
      'downhill: four times as large, twice as long.',
    sheet.box,
    html("div", { class: "told" }, said, answer, curve.box,
      html("div", { class: "row" }, ...buttons)));
}
