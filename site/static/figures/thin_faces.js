/** Page 08b in flatland: faces thinner than pixels, and who still finds the outline. */
import { fill, html, number, Sheet, slider, sway } from "./paper.js";

const WIDTH = 2.4, LARGE = { radius: 2.5, x: 0.4 };  // of the picture; the ball behind
const SHIFTS = 400, START = 0.55, SWING = 0.3, LEFT = -3.4, HIGH = 2.6;
const METHODS = [["lecture 08", ""], ["DRTK’s rule", "second"], ["walk", "first"]];

/** Where the face of a ball that is seen at x ends: [x0, x1], the ball of radius 1 with an end at
 *  its outline. */
export function faceAt(x, count, { radius, x: middle } = { radius: 1, x: 0 }) {
  const step = 2 * Math.PI / count, k = Math.floor(Math.acos((x - middle) / radius) / step);
  return [k + 1, k].map((n) => middle + radius * Math.cos(n * step));
}

/** Who finds the outline at x = 1, of the ball in pixels so wide, if its last centre lies `inside`
 *  pixels before it -> the share of the gradient by the ball's size that each of METHODS gets. */
export function sharesAt(inside, count, pixel, hasLarge) {
  const owner = 1 - inside * pixel, other = owner + pixel;
  const isOwn = faceAt(owner, count)[1] > 1 - 1e-12;
  const isSeen = !hasLarge || faceAt(other, count, LARGE)[0] < owner; // it goes on behind the ball
  return [Number(isOwn), isSeen ? owner : 0, 1];
}

/** The mean over all places of the pixels. */
const meanShares = (...scene) => Array.from({ length: SHIFTS }, (_, n) =>
  sharesAt((n + 0.5) / SHIFTS, ...scene)).reduce((sum, shares) =>
  sum.map((t, k) => t + shares[k] / SHIFTS), [0, 0, 0]);

export function show(place) {
  let count = 32, width = 64, inside = START;
  const sheet = new Sheet([LEFT, 1.6, -0.6, 3],
    "The right end of a ball from the side, its faces, and the centres of pixels", draw);
  sheet.box.classList.add("cut");
  const bars = new Sheet([0, 20, 0, 5], "How much of the gradient each method finds", draw);
  const behind = html("input", { type: "checkbox" });
  const sliders = [
    slider({ label: "faces", min: 8, max: 512, step: 8, value: count,
             changed: (to) => { count = to; } }),
    slider({ label: "pixels", min: 16, max: 256, step: 16, value: width,
             changed: (to) => { width = to; } })];
  sheet.handle({ name: "Centres of the pixels", mark: "↔", style: "point", step: 0.05,
                 at: () => [-inside, -0.3], limits: [-0.95, -0.05, -0.3, -0.3],
                 moved: ([x]) => { inside = -x; } });

  /** The ball near its outline, x in pixels from there, its height drawn so that it fits. */
  function draw() {
    const pixel = WIDTH / width, high = HIGH / Math.sqrt(1 - (1 + LEFT * pixel) ** 2);
    const step = 2 * Math.PI / count;
    const corners = Array.from({ length: count / 2 + 1 }, (_, n) => [Math.cos(n * step),
                                                                     Math.sin(n * step)])
      .map(([x, y]) => [(x - 1) / pixel, high * y]);
    const cut = corners.findIndex(([x]) => x < LEFT) + 1 || corners.length;
    const shown = corners.slice(0, cut), centres = [-3, -2, -1, 0, 1].map((k) => k - inside);
    const own = shown.findIndex(([x]) => x <= -inside);
    sheet.draw(
      centres.map((x) => [sheet.line([[x - 0.5, 0], [x - 0.5, 3]], "axis"),
                          sheet.line([[x, 0], [x, 3]], "ruler")]),
      behind.checked ? sheet.line([[LEFT, 0], [1.6, 0]], "wall-map first") : [],
      sheet.line(shown, "outline thick found"),
      shown.map((corner) => sheet.dot(corner, 3, "sample")),
      sheet.line(shown.slice(0, own), "edge thick"),
      sheet.line(shown.slice(Math.max(0, own - 1), own + 1), "second thick outline"),
      sheet.dot([0, 0], 6, "crossing"), sheet.text([0, 0], "outline", "label edge", [8, 8]),
      sheet.text([-inside, 3], "owner", "middle", [0, -14]),
      sheet.text([1 - inside, 3], "other", "middle", [0, -14]));
    const shares = meanShares(count, pixel, behind.checked);
    bars.draw(METHODS.map(([name, style], k) => [
      bars.rectangle([0, 3.6 - 1.7 * k], 8 * shares[k], 1.1, `bar ${style}`),
      bars.text([8 * shares[k], 3.6 - 1.7 * k], `${number(100 * shares[k], 1)} %  ${name}`, "",
                [6, 5])]));
  }

  fill(place, draw, "How much of the gradient is left where faces are smaller than pixels?",
    "Guess what ten times the faces do, then move the sliders. " +
      '<b class="orange">Orange</b> is the face that the owner sees, <b class="red">red</b> ' +
      "those that a walk still crosses.",
    sheet.box, html("div", { class: "told" }, ...sliders.map(({ element }) => element), bars.box,
      html("label", { class: "check" }, behind, html("span", {}, "before a large ball"))));
  sway(place, (t) => { inside = START + SWING * t; }, draw);
}
