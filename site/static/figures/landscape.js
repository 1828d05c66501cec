/** Lecture 09: the loss over all places of one vertex, sampled and blended. */
import { adamStep, covered, lossOf, render, squaredError } from "./blended.js";
import { isCovered } from "./edge_functions.js";
import { centres, clamp, fill, html, playAndReset, say, soon } from "./paper.js";
import { Picture } from "./picture.js";
import { plus } from "./vectors.js";

const WIDTH = 12, HEIGHT = 8, FINE = 14;  // pixels, and how many of the map's places in each
const GOAL = [[1.6, 1.2], [9.7, 1.9], [4.7, 6.3]], START = [9.4, 6.2], LOWEST = 1.7;
const STEPS = 200, BUDGET = 8;            // ms of a frame, for the map
const ARROW = 1.8, FOUND = 1e-6;         // pixels; the loss where the arrow ends

const triangleOf = (vertex) => [GOAL[0], GOAL[1], vertex];

/** -> the loss of the triangle with this vertex 2, and the gradient with respect to it. */
export function lossAt(vertex, isBlended) {
  const triangle = triangleOf(vertex);
  if (isBlended) {
    const { loss, gradients } = lossOf(triangle, TARGET, WIDTH, HEIGHT);
    return { loss, gradient: gradients[2] };
  }
  const picture = covered(triangle, WIDTH, HEIGHT).map(Number);
  return { loss: squaredError(picture, SAMPLED), gradient: [0, 0] };
}

const TARGET = render(GOAL, WIDTH, HEIGHT).picture;
const SAMPLED = covered(GOAL, WIDTH, HEIGHT).map(Number);

/** The colour of a loss: white at 0, blue at the highest. Slopes are lit from the upper left. */
function paint(pixels, n, loss, slope) {
  const share = Math.min(1, Math.sqrt(loss / 0.15));
  const light = clamp(1 - 12 * slope, 0.5, 1.2);
  [40, 130, 185].forEach((dark, k) => {
    pixels[4 * n + k] = light * (240 + share * (dark - 240));
  });
  pixels[4 * n + 3] = 255;
}

/** The border of the places around place n that have its value, as [from, to] in places, row 0 at
 *  the top. */
export function plateauBorder(values, width, n) {
  const [seen, border] = [new Set([n]), []];
  for (const at of seen) {
    const [x, y] = [at % width, Math.floor(at / width)];
    [[0, -1], [1, 0], [0, 1], [-1, 0]].forEach(([dx, dy]) => {
      const isInside = x + dx >= 0 && x + dx < width;
      const next = at + dx + dy * width;
      if (isInside && values[next] === values[n]) seen.add(next);
      else {
        const [left, top] = [x + (dx > 0), y + (dy > 0)];
        border.push([[left, top], [left + (dx === 0), top + (dy === 0)]]);
      }
    });
  }
  return border;
}

/** Paints the map of all places, from above, a few rows in each frame, and keeps it in values.
 *  painted() is called at its end. -> a function: stop. */
function paintMap(canvas, isBlended, values, painted) {
  const { width, height } = canvas;
  const context = canvas.getContext("2d");
  const lossesOf = (row) => Float64Array.from({ length: width }, (_, n) =>
    lossAt([(n + 0.5) / FINE, (height - row - 0.5) / FINE], isBlended).loss);
  let row = 0, frame = 0, above = lossesOf(-1);
  const go = () => {
    const end = performance.now() + BUDGET;
    for (; row < height && performance.now() < end; row++) {
      const [image, losses] = [context.createImageData(width, 1), lossesOf(row)];
      values.set(losses, row * width);
      losses.forEach((loss, n) =>
        paint(image.data, n, loss, above[n] - loss + losses[Math.max(n - 1, 0)] - loss));
      context.putImageData(image, 0, row);
      above = losses;
    }
    if (row < height) frame = requestAnimationFrame(go);
    else painted();
  };
  go();
  return () => cancelAnimationFrame(frame);
}

export function show(place) {
  const values = new Float64Array(WIDTH * FINE * HEIGHT * FINE);
  let vertex, path, means, squares, stopMap = () => {};
  const sheet = new Picture(WIDTH, HEIGHT,
    "A map of the loss for each place of vertex 2 of a triangle", draw, FINE);
  const said = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  const handle = sheet.handle({
    name: "Vertex 2", mark: "2", step: 0.05, limits: [0, WIDTH, LOWEST, HEIGHT], at: START,
    moved: begin });
  const blend = html("input", { type: "checkbox", checked: "" });
  blend.addEventListener("change", () => {
    stopMap();
    values.fill(NaN);
    stopMap = paintMap(sheet.canvas, blend.checked, values, () => soon(draw));
    sheet.box.classList.toggle("through", !blend.checked);
    begin(vertex);
  });
  const buttons = playAndReset(() => {
    const { loss, gradient } = lossAt(vertex, blend.checked);
    const n = path.length;
    if (n > STEPS || loss < 1e-7 || gradient.every((slope) => slope === 0)) return false;
    [vertex, means, squares] = adamStep(vertex, gradient, means, squares, n,
                                        0.3 * 0.01 ** (n / STEPS));
    vertex = [clamp(vertex[0], 0, WIDTH), clamp(vertex[1], LOWEST, HEIGHT)];
    path.push(vertex);
    handle.set(vertex);
    return true;
  }, () => begin(START), draw);

  function begin(from) {
    [vertex, path, means, squares] = [from, [from], [0, 0], [0, 0]];
    handle.set(vertex);
  }

  function draw() {
    const { loss, gradient } = lossAt(vertex, blend.checked);
    const length = Math.hypot(...gradient);
    const triangle = triangleOf(vertex), border = blend.checked ? [] : plateau();
    sheet.draw(
      ["halo", "curve second"].map((style) =>
        border.map((side) => sheet.line(side, style))),
      centres(WIDTH, HEIGHT).map((centre) => sheet.dot(
        centre, 2.2, isCovered(centre, triangle) ? "sample point" : "sample")),
      sheet.polygon(GOAL, "goal"), sheet.polygon(triangle, "outline found"),
      sheet.line(path, "curve descent"), length && loss >= FOUND
        ? sheet.arrow(vertex, plus(vertex, gradient, -ARROW / length), "descent") : []);
    said.innerHTML = `Loss <b>${loss.toFixed(5)}</b>, gradient ` +
      `<b class="green">${length.toFixed(5)}</b>, step ${path.length - 1}`;
    say(answer, !blend.checked ? "Flat up to the orange cliffs: no arrow, and Play does nothing."
      : loss < FOUND ? "Found." : "");
  }

  /** The border of the plateau that holds the vertex, once the map is there. */
  function plateau() {
    if (Number.isNaN(values.at(-1))) return [];
    const [column, row] = [vertex[0], HEIGHT - vertex[1]].map((t, k) =>
      Math.min(Math.floor(t * FINE), [WIDTH, HEIGHT][k] * FINE - 1));
    return plateauBorder(values, WIDTH * FINE, row * WIDTH * FINE + column).map((side) =>
      side.map(([x, y]) => [x / FINE, HEIGHT - y / FINE]));
  }

  begin(START);
  stopMap = paintMap(sheet.canvas, true, values, () => soon(draw));
  fill(place, draw, "Drag vertex 2, then take the blend away.",
    "The map is the loss for each place of vertex 2: white is low. " +
      'The <b class="green">green</b> arrow points downhill.',
    sheet.box,
    html("div", { class: "told" }, said, answer,
      html("label", { class: "check" }, blend, html("span", {}, "blend the edges (lab 8)")),
      html("div", { class: "row" }, ...buttons)));
}
