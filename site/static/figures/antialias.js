/** Lecture 08: an edge crosses between two pixels. It blends their colours, and gets a gradient. */
import { clamp, fill, html, number, Sheet } from "./paper.js";

const START = [[0.2, 0.6], [0.35, -0.5]];
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
function pairOf(ends) {
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

/** The two pixels' shades when the edge crosses at c. */
const shown = (c) => (c >= -WINDOW && c <= 1 + WINDOW ? blend(OWNER, OTHER, blendWeight(c))
  : [OWNER, OTHER]);
const CORNERS = [-0.25, -WINDOW - 1e-9, -WINDOW, 0, 0.5, 1, 1 + WINDOW, 1 + WINDOW + 1e-9, 1.25];

const fillOf = (shade) => `fill: color-mix(in srgb-linear, #ffffff ${100 * shade}%, #0072b2)`;

function why({ c, alpha }) {
  const at = `<i>c</i> = ${number(c)}`;
  if (alpha === null) {
    return `${at}: no blend, no gradient. The edge is not steep: a pair of pixels above each ` +
      "other blends it.";
  }
  if (c <= 0 || c >= 1) {
    return `${at} is clamped to ${clamp(c, 0, 1)}, so <i>α</i> stays ${number(alpha)} when ` +
      "the edge moves: no gradient.";
  }
  return `${at}, <i>α</i> = ½ − <i>c</i> = ${number(alpha)}: ` + (Math.abs(alpha) < 1e-9
    ? "both pixels are right. The kink is here."
    : `the ${alpha > 0 ? '<b class="blue">owner' : '<b class="orange">other pixel'}</b> ` +
      `changes by <i>α</i> (${OTHER} − ${OWNER}) = ${number(alpha * (OTHER - OWNER))}.`);
}

export function show(place) {
  let ends = START;
  const sheet = new Sheet([-0.7, 1.7, -2.2, 0.75],
    "An edge between two pixels; below, their colours after the blend, and as curves", draw);
  sheet.box.classList.add("light");
  const answer = html("p", { class: "verdict", role: "status" });
  START.forEach((_, k) => sheet.handle({
    name: `End ${k} of the edge`, mark: String(k), style: "edge", step: 0.025, at: () => ends[k],
    limits: [-0.05, 1.05, ...(k ? [-0.6, -0.15] : [0.15, 0.6])],
    moved: (to) => { ends = ends.with(k, to); } }));

  function draw() {
    const pair = pairOf(ends);
    sheet.draw(pixels(pair.c), edge(pair), ends.map((end, k) => pull(end, k, pair.gradients)),
               curves(pair));
    answer.innerHTML = why(pair);
  }

  /** Both pixels, the left part blue up to the edge. */
  function pixels(c) {
    const slope = (ends[1][0] - ends[0][0]) / (ends[1][1] - ends[0][1]);
    const rows = Array.from({ length: 41 }, (_, n) => n / 40 - 0.5);
    const face = [[-0.5, -0.5], ...rows.map((y) => [clamp(c + slope * y, -0.5, 1.5), y]),
                  [-0.5, 0.5]];
    return [sheet.rectangle([-0.5, -0.5], 2, 1, "square", fillOf(OTHER)),
      sheet.polygon(face, "", fillOf(OWNER)), sheet.line([[0.5, -0.5], [0.5, 0.5]], "border"),
      sheet.line([[0, 0], [1, 0]], "ruler"), [0, 1].map((x) => sheet.dot([x, 0], 4, "sample")),
      ["owner", OWNER].map((word, row) => sheet.text([-0.5, 0], word, "", [5, 3 - 18 * row])),
      ["other", OTHER].map((word, row) => sheet.text([1.5, 0], word, "end", [-5, 3 - 18 * row]))];
  }

  function edge({ c, alpha }) {
    const strip = alpha === null ? [] : sheet.line([[clamp(c, 0, 1), 0], [0.5, 0]], "strip");
    return [strip, sheet.line(ends, "edge"), sheet.line([[c, 0], [c, -2.1]], "ray"),
            sheet.dot([c, 0], 5, "crossing"), sheet.text([c, 0], "c", "label edge", [8, 9])];
  }

  /** An end's arrow: where descent takes it, in numbers, too. */
  function pull([x, y], k, gradients) {
    const [dx, dy] = [-gradients[2 * k], -gradients[2 * k + 1]];
    const isRight = x + Math.max(dx, 0) < 0.9; // there is room on the right
    return [sheet.arrow([x, y], [x + dx, y + dy], "descent"),
            sheet.text([x + (isRight ? Math.max(dx, 0) : Math.min(dx, 0)), y + dy],
                       `${number(dx)}, ${number(dy)}`,
                       `label descent ${isRight ? "" : "end"}`, [isRight ? 16 : -16, -5])];
  }

  function curves(pair) {
    const { c, alpha, colours } = pair;
    const at = (x, value) => [x, 0.85 * value - 2.05];
    const colour = ["first", "second"], faded = alpha === null ? "faded" : "";
    return [
      sheet.text([-0.5, -0.75], "blended", "", [5, 6]),
      [-WINDOW, 1].map((x) => [sheet.rectangle(at(x, 0), WINDOW, 0.85, "clamp"),
                               sheet.text(at(x, 1), "clamped", "middle", [5, 2])]),
      sheet.line([at(-0.25, 0), at(1.25, 0)], "axis"),
      [0, 0.5, 1].map((x) => sheet.text(at(x, 0), number(x), "middle", [0, -18])),
      colour.map((style, k) => sheet.line(CORNERS.map((x) => at(x, shown(x)[k])),
                                          `curve ${style} ${faded}`)),
      ["owner", "other"].map((name, k) => sheet.text(at(-0.25, shown(-0.25)[k]), name,
                                                     `label ${colour[k]} end`, [-6, -5])),
      sheet.text(at(1.25, 0), "c", "label edge", [8, -5]),
      colours.map((value, k) => [
        sheet.rectangle([k - 0.5, -1.05], 1, 0.3, "square", fillOf(value)),
        sheet.text([k, -0.9], number(value), "middle", [0, -5]),
        faded ? [] : sheet.dot(at(c, value), 6, `sample ${colour[k]}`)])];
  }

  fill(place, draw, "Drag the ends of the edge.", "The loss wants the changed pixel bluer. " +
      'The arrows are <b class="green">−∂L/∂(x, y)</b>.',
    sheet.box, html("div", { class: "told" }, answer));
}
