/** Lecture 09: the loss over all places of one vertex, sampled and blended. */
import { adamStep, covered, lossOf, render, squaredError } from "./blended.js";
import { isCovered } from "./edge_functions.js";
import { centreOf, centres, clamp, fill, html, playAndReset, say, soon } from "./paper.js";
import { Picture } from "./picture.js";
import { between, plus } from "./vectors.js";

const WIDTH = 12, HEIGHT = 8, FINE = 14;  // pixels, and how many of the map's places in each
const GOAL = [[1.6, 1.2], [9.7, 1.9], [4.7, 6.3]], START = [9.4, 6.2], LOWEST = 1.7;
const COLUMNS = WIDTH * FINE, ROWS = HEIGHT * FINE;         // of the map
const WHITE = [0.94, 0.94, 0.94], BLUE = [0.16, 0.51, 0.73];
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

/** The colour of place n: white where the loss is 0, blue where it is highest. Slopes are lit from
 *  the upper left. */
function colourOf(losses, n) {
  const loss = losses[n], above = losses[n + COLUMNS] ?? loss;
  const left = n % COLUMNS ? losses[n - 1] : loss;
  const light = clamp(1 - 12 * (above - loss + left - loss), 0.5, 1.2);
  return between(WHITE, BLUE, Math.min(1, Math.sqrt(loss / 0.15)))
    .map((t) => Math.min(1, light * t));
}

/** The border of the places around place n that have its value, as [from, to] in places. */
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

export function show(place) {
  const losses = new Float64Array(COLUMNS * ROWS); // of all places, below `row` not yet
  let vertex, path, means, squares, row = ROWS;
  begin(START);
  const sheet = new Picture(WIDTH, HEIGHT,
    "A map of the loss for each place of vertex 2 of a triangle", draw, FINE);
  const said = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  sheet.handle({
    name: "Vertex 2", mark: "2", step: 0.05, limits: [0, WIDTH, LOWEST, HEIGHT],
    at: () => vertex, moved: begin });
  const blend = html("input", { type: "checkbox", checked: "" });
  blend.addEventListener("change", () => {
    row = ROWS;
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
    return true;
  }, () => {
    if (!blend.checked) blend.click();
    begin(START);
  }, draw);

  function begin(from) {
    [vertex, path, means, squares] = [from, [from], [0, 0], [0, 0]];
  }

  /** Finds the losses of more rows, the upper ones first, as long as a frame has time. */
  function measure() {
    const end = performance.now() + BUDGET;
    while (row > 0 && performance.now() < end) {
      row -= 1;
      for (let n = row * COLUMNS; n < (row + 1) * COLUMNS; n++) {
        losses[n] = lossAt(centreOf(n, COLUMNS).map((t) => t / FINE), blend.checked).loss;
      }
    }
    sheet.paint((n) => colourOf(losses, n));
    soon(draw);
  }

  function draw() {
    if (row > 0) measure();
    const { loss, gradient } = lossAt(vertex, blend.checked);
    const length = Math.hypot(...gradient);
    buttons[0].disabled = !blend.checked; // it would do nothing
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
    say(answer, blend.checked ? (loss < FOUND ? "Found." : "")
      : "Flat as far as the orange cliffs: no arrow, and Play does nothing.");
  }

  /** The border of the plateau that holds the vertex, once the map is there. */
  function plateau() {
    if (row > 0) return [];
    const [x, y] = vertex.map((t, k) => Math.min(Math.floor(t * FINE), [COLUMNS, ROWS][k] - 1));
    return plateauBorder(losses, COLUMNS, y * COLUMNS + x).map((side) =>
      side.map((corner) => corner.map((t) => t / FINE)));
  }

  fill(place, draw, "Drag vertex 2, then take the blend away.",
    "The map is the loss for each place of vertex 2: white is low. " +
      'The <b class="green">green</b> arrow points downhill.',
    sheet.box,
    html("div", { class: "told" }, said, answer,
      html("label", { class: "check" }, blend, html("span", {}, "blend the edges (lab 8)")),
      html("div", { class: "row" }, ...buttons)));
}
