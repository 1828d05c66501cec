/** Page 14b in flatland: which way should a light move, so that its shadow is the given one? */
import { adamStep } from "./blended.js";
import { clamp, fill, html, number, playAndReset, say, Sheet, sway } from "./paper.js";
import { dot, minus, plus } from "./vectors.js";

const GROUND = 12, TRUTH = [3.7, 3.4], START = [7.9, 3.9], SWING = 0.3;
const BLOCKER = [[4.6, 1.5], [6.6, 1.5]], FLOOR = [0, 0];
const LIMITS = [0.5, GROUND - 0.5, 2.5, 4.3], STEPS = 240, FOUND = 0.02;

/** Where the ray from a light past a point meets the ground y = 0. */
export const borderOf = ([x, y], [bx, by]) => x + (bx - x) * y / (y - by);

/** -> how this place moves with the light's x and y. */
export const borderMotion = ([x, y], [bx, by]) =>
  [-by / (y - by), -by * (bx - x) / (y - by) ** 2];

const shadowOf = (light) => BLOCKER.map((end) => borderOf(light, end));

/** How much of the ground is wrong, and the gradient with respect to the light. Only borders move:
 *  what a border sweeps becomes right where the given shadow is on its way, else wrong. */
export function lossOf(light, given) {
  const [left, right] = shadowOf(light);
  const overlap = Math.max(0, Math.min(right, given[1]) - Math.max(left, given[0]));
  const isGiven = (x) => given[0] < x && x < given[1];
  const growing = [isGiven(left) ? 1 : -1, isGiven(right) ? -1 : 1];
  const gradient = BLOCKER.map((end, k) => borderMotion(light, end).map((t) => growing[k] * t))
    .reduce((a, b) => plus(a, b));
  return { loss: right - left + given[1] - given[0] - 2 * overlap, gradient };
}

const GIVEN = shadowOf(TRUTH);

export function show(place) {
  let light, means, squares, step;
  begin(START);
  const sheet = new Sheet([0, GROUND, -0.9, 4.9],
    "A light, what stands before it, its shadow on the ground, and the shadow that is given", draw);
  const said = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  sheet.handle({ name: "Light", style: "second", step: 0.05, limits: LIMITS, at: () => light,
                 moved: begin });
  const buttons = playAndReset(() => {
    const { loss, gradient } = lossOf(light, GIVEN);
    if (step === STEPS || loss < FOUND) return false;
    step += 1;
    [light, means, squares] = adamStep(light, gradient, means, squares, step,
                                       0.2 * 0.02 ** (step / STEPS));
    light = light.map((t, k) => clamp(t, LIMITS[2 * k], LIMITS[2 * k + 1]));
    return true;
  }, () => begin(START), draw);

  function begin(from) {
    [light, means, squares, step] = [from, [0, 0], [0, 0], 0];
  }

  function draw() {
    const { loss, gradient } = lossOf(light, GIVEN), shadow = shadowOf(light);
    const down = plus(FLOOR, gradient, -1), way = minus(TRUTH, light);
    const cosine = dot(down, way) / Math.hypot(...down) / Math.hypot(...way);
    const degrees = number(Math.acos(clamp(cosine, -1, 1)) * 180 / Math.PI, 0);
    const cut = shadow.map((x) => clamp(x, 0, GROUND));
    const isGiven = (x) => GIVEN[0] < x && x < GIVEN[1];
    const aims = shadow.map((x, k) => x + (isGiven(x) === (k === 1) ? 0.5 : -0.5));
    sheet.draw(
      sheet.polygon([light, ...shadow.map((x) => [x, 0])], "beam"),
      sheet.polygon([...BLOCKER, [shadow[1], 0], [shadow[0], 0]], "dusk"),
      sheet.line([[0, 0], [GROUND, 0]], "ground"),
      sheet.line([[cut[0], 0], [cut[1], 0]], "ground dark"),
      sheet.line([[GIVEN[0], -0.22], [GIVEN[1], -0.22]], "edge thick"),
      sheet.text([(GIVEN[0] + GIVEN[1]) / 2, -0.22], "the given shadow", "label edge middle",
                 [0, -22]),
      sheet.line(BLOCKER, "plane"),
      loss < FOUND ? [] : [
        shadow.map((x, k) => sheet.arrow([x, 0.25], [aims[k], 0.25], "pull point")),
        sheet.arrow(light, plus(light, down, 0.9 / Math.hypot(...down)), "descent")]);
    said.innerHTML = `Step ${step}: <b>${number(100 * loss / GROUND, 1)} %</b> of the ground is ` +
      "wrong.";
    say(answer, loss < FOUND ? "Found, by two borders alone."
      : `The step downhill, green, misses the true light by ${degrees} degrees.`);
  }

  fill(place, draw, "Which way should the light move?",
    "Guess, then press Play, or drag the light. When it moves a little, only the ground at the " +
      "two borders changes, and the arrows there show where these should go.",
    html("div", { class: "wide" }, sheet.box),
    html("div", { class: "told" }, said, answer), html("div", { class: "row" }, ...buttons));
  sway(place, (t) => { begin(plus(START, [SWING * t, 0])); }, draw);
}
