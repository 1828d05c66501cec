/** Lecture 08: an edge crosses between two pixels. It blends their colours, and gets a gradient. */
import { button, clamp, html, number, Sheet, svg, table } from "./paper.js";

const START = [[0.2, 0.9], [0.35, -0.75]];
const OWNER = 0.2, OTHER = 0.9;  // their shades: 0 is blue, 1 is white
const WINDOW = 1 / 16;

/** Eq. (3): where the edge meets the line y = 0, measured from its nearer end. */
export function crossing(x0, y0, x1, y1) {
  const [x, y] = Math.abs(y1) < Math.abs(y0) ? [x1, y1] : [x0, y0];
  return x - y * (x1 - x0) / (y1 - y0);
}

/** -> dL/dx0, dL/dy0, dL/dx1, dL/dy1 */
export function crossingBackward(gradC, x0, y0, x1, y1) {
  const r = 1 / (y1 - y0);
  const c = (x0 * y1 - x1 * y0) * r;
  const slope = gradC * r;
  return [slope * y1, slope * (c - x1), -slope * y0, slope * (x0 - c)];
}

/** Is the pair blended by this silhouette edge: steep, and crossing between the centres? */
export const isBlended = (c, x0, y0, x1, y1) =>
  Math.abs(y1 - y0) >= Math.abs(x1 - x0) && c > -WINDOW && c < 1 + WINDOW;

/** Eq. (4). */
export const blendWeight = (c) => 0.5 - clamp(c, 0, 1);

export const blendWeightBackward = (gradAlpha, c) => (c > 0 && c < 1 ? -gradAlpha : 0);

/** Eq. (5) -> the owner's colour and the other's. */
export function blend(owner, other, alpha) {
  const change = alpha * (other - owner);
  return alpha > 0 ? [owner + change, other] : [owner, other + change];
}

/** -> dL/downer, dL/dother, dL/dalpha */
export function blendBackward([gradOwner, gradOther], owner, other, alpha) {
  const gradChanged = alpha >= 0 ? gradOwner : gradOther;
  return [gradOwner - alpha * gradChanged, gradOther + alpha * gradChanged,
          gradChanged * (other - owner)];
}

/** All that the figure shows, of an edge with the ends (x0, y0) and (x1, y1). */
export function pairOf(ends) {
  const [x0, y0, x1, y1] = ends.flat();
  const c = crossing(x0, y0, x1, y1);
  if (!isBlended(c, x0, y0, x1, y1)) {
    return { c, alpha: null, colours: [OWNER, OTHER], gradients: [0, 0, 0, 0] };
  }
  const alpha = blendWeight(c);
  const upstream = alpha >= 0 ? [1, 0] : [0, 1];  // at the changed pixel
  const gradAlpha = blendBackward(upstream, OWNER, OTHER, alpha)[2];
  const gradC = blendWeightBackward(gradAlpha, c);
  return { c, alpha, colours: blend(OWNER, OTHER, alpha),
           gradients: crossingBackward(gradC, x0, y0, x1, y1) };
}

const shade = (value) =>
  `fill: color-mix(in srgb-linear, #ffffff ${100 * value}%, #0072b2)`;

function why(ends, { c, alpha }) {
  if (alpha !== null && Math.abs(alpha) < 1e-9) {
    return "α = 0. Both pixels are right. The kink is here.";
  }
  if (alpha !== null) {
    return alpha > 0 ? "The owner changes: it is too blue."
      : "The other pixel changes: it is not blue enough.";
  }
  if (c > -WINDOW && c < 1 + WINDOW) {
    return "Not steep. A pair of pixels above each other blends this edge.";
  }
  return "Not between the centres. Another pair blends this edge.";
}

export function show(place) {
  let ends = START;
  const limits = [-0.45, 1.45, 0.15, 1.05];
  const sheet = new Sheet([-0.7, 1.7, -1.82, 1.15],
    "An edge between two pixels, and the colours before and after the blend", draw);
  const curves = new Sheet([-0.16, 2.16, -0.2, 1.14],
    "Both pixels' shades, from the crossing at 0 to the crossing at 1", draw);
  sheet.box.classList.add("light");
  const numbers = table("The gradient at both ends",
    ["end", "<i>x</i>", "<i>y</i>", "<i>∂L/∂x</i>", "<i>∂L/∂y</i>"], ["0", "1"]);
  const blended = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  const handles = START.map((at, k) => sheet.handle({
    name: `End ${k} of the edge`, mark: String(k), style: "edge", step: 0.05, at,
    limits: k ? [limits[0], limits[1], -limits[3], -limits[2]] : limits,
    moved: (to) => {
      ends = ends.map((end, n) => (n === k ? to : end));
      draw();
    } }));
  const reset = button("Reset", () => START.forEach((end, k) => handles[k].go(end)));

  function draw() {
    const pair = pairOf(ends);
    const { c, alpha, colours, gradients } = pair;
    const pixels = (title, values, left) => [sheet.text([left, -1.3], title, ""),
      values.map((value, k) => {
        const square = sheet.rectangle([left + 0.45 * k, -1.75], 0.45, 0.4, "square");
        square.style.cssText = shade(value);
        return [square, sheet.text([left + 0.45 * k + 0.08, -1.55], number(value), "", [0, -5])];
      })];
    const slope = (ends[1][0] - ends[0][0]) / (ends[1][1] - ends[0][1]);
    const at = (y) => clamp(c + slope * y, -0.5, 1.5);
    const rows = Array.from({ length: 41 }, (_, n) => n / 40 - 0.5);
    const face = svg("polygon", { class: "face", points: [
      [-0.5, -0.5], ...rows.map((y) => [at(y), y]), [-0.5, 0.5]].map((p) => sheet.place(p)) });
    const whole = sheet.rectangle([-0.5, -0.5], 2, 1, "square");
    whole.style.cssText = shade(OTHER);
    face.style.cssText = shade(OWNER);
    sheet.draw(
      whole, face, sheet.line([[0.5, -0.5], [0.5, 0.5]], "border"),
      sheet.line([[0, 0], [1, 0]], "ruler"),
      sheet.dot([0, 0], 4, "sample none"), sheet.dot([1, 0], 4, "sample none"),
      sheet.text([0, 0], "owner", "", [-22, -20]), sheet.text([1, 0], "other", "", [-18, -20]),
      alpha === null ? [] : sheet.line([[clamp(c, 0, 1), 0], [0.5, 0]], "strip"),
      sheet.line(ends, "edge"), sheet.dot([c, 0], 5, "crossing"),
      sheet.text([c, 0], "c", "label edge", [8, 9]),
      [0, 1].map((k) => sheet.arrow(ends[k],
        [ends[k][0] - gradients[2 * k], ends[k][1] - gradients[2 * k + 1]], "descent")),
      pixels("sampled", [OWNER, OTHER], -0.5).flat(2), pixels("blended", colours, 0.6).flat(2));
    const along = (k) => Array.from({ length: 21 }, (_, n) =>
      [n / 10, blend(OWNER, OTHER, blendWeight(n / 20))[k]]);
    curves.draw(
      curves.line([[0, 1], [0, 0], [2, 0]], "axis"),
      curves.line([[1, 0], [1, 1]], "ray"),
      curves.text([1, 1], "α = 0", "", [-18, 6]),
      curves.text([0, 0], "c = 0", "", [-4, -18]), curves.text([2, 0], "1", "", [-4, -18]),
      curves.text([0, OWNER], "owner", "label first", [8, -16]),
      curves.text([2, OTHER], "other", "label second", [-48, 10]),
      curves.line(along(0), "curve first"), curves.line(along(1), "curve second"),
      c < 0 || c > 1 ? [] : [curves.dot([2 * c, colours[0]], 7, "sample first"),
                             curves.dot([2 * c, colours[1]], 7, "sample second")]);
    numbers.write(ends.map((end, k) => [number(end[0]), number(end[1]),
      number(gradients[2 * k]), number(gradients[2 * k + 1])]));
    blended.innerHTML = `<i>c</i> = ${number(c)}, &ensp; <i>α</i> = ` +
      `${alpha === null ? "none" : `½ − <i>c</i> = ${number(alpha)}`}`;
    answer.textContent = why(ends, pair);
  }

  place.append(html("div", { class: "pane" },
    html("p", { class: "task" }, "Drag the edge. ",
      html("span", {}, "The loss wants the changed pixel bluer (∂L/∂pixel = +1). " +
        "The green arrows show where each end would go.")), sheet.box,
    html("div", { class: "told" }, blended, answer, curves.box, numbers.element, reset)));
  draw();
}
