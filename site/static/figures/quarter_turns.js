/** Page 09b in the plane: a square of four colours, and downhill to its pose. */
import { button, fill, html, playAndReset, say, Sheet, sway } from "./paper.js";
import { rgb, toSrgb } from "./picture.js";
import { dot, minus } from "./vectors.js";

const GOAL = 24, START = -81, SWING = 9;                    // degrees
const COLOURS = [[0.7, 0.06, 0.05], [0.72, 0.36, 0.01], [0.01, 0.2, 0.5], [0.02, 0.3, 0.18]];
const WHITE = [1, 1, 1], HIGH = 110;                        // of the curve

/** Degrees from 0, or another least angle, to a whole turn more. */
const within = (degrees, least = 0) => ((degrees - least) % 360 + 360) % 360 + least;

/** What lies in a direction from the middle of the square that is turned by this angle: how far its
 *  side is, half of one long, and its colour. */
export function sideAt(direction, angle) {
  const from = within(direction - angle);
  return { reach: 1 / Math.cos((from % 90 - 45) * Math.PI / 180), colour: Math.floor(from / 90) };
}

/** The squared difference of the squares turned by two angles, of the mean over the smallest disc
 *  around them: over each half degree what both cover, then what one covers before white. */
export function lossOf(angle, goal) {
  let sum = 0;
  for (let direction = 0.25; direction < 360; direction += 0.5) {
    const [less, more] = [sideAt(direction, angle), sideAt(direction, goal)]
      .sort((a, b) => a.reach - b.reach);
    const apart = minus(COLOURS[less.colour], COLOURS[more.colour]);
    const beyond = minus(COLOURS[more.colour], WHITE);
    sum += less.reach ** 2 * dot(apart, apart) + (more.reach ** 2 - less.reach ** 2) *
      dot(beyond, beyond);
  }
  return sum / 720 / 2;
}

const LOSSES = Array.from({ length: 360 }, (_, n) => lossOf(n, GOAL));
const lossAt = (degrees) => LOSSES[within(degrees)];

/** A degree downhill, or 0. */
const stepFrom = (at) => [0, 1, -1].reduce(
  (best, step) => (lossAt(at + step) < lossAt(at + best) ? step : best));

/** Where downhill ends. */
export function downhill(at) {
  const step = stepFrom(at);
  return step ? downhill(at + step) : within(at);
}

const ARRIVE = LOSSES.filter((_, n) => downhill(n) === GOAL).length;

export function show(place) {
  let at = START;
  const scene = new Sheet([-1.6, 1.6, -1.6, 1.6],
    "The square, each quarter in one colour, and the outline of the target", draw);
  const target = new Sheet([-1.6, 1.6, -1.6, 1.6], "The target", draw);
  const curve = new Sheet([-190, 190, -40, HIGH + 30], "The loss of every pose", draw);
  const answer = html("p", { class: "verdict", role: "status" });
  curve.handle({ name: "The square’s angle", step: 1, at: () => [at, -11],
                 limits: [-180, 179, -11, -11], moved: ([x]) => { at = x; } });
  const buttons = playAndReset(() => {
    const step = stepFrom(at);
    at = within(at + step, -180);
    return step !== 0;
  }, () => { at = START; }, draw);
  const turn = button("Turn by 90°", () => { at = within(at + 90, -180); });

  /** A square's corners: the first lies where its first colour begins. */
  const corners = (angle) => [0, 1, 2, 3].map((k) => {
    const turned = (angle + 90 * k) * Math.PI / 180;
    return [Math.SQRT2 * Math.cos(turned), Math.SQRT2 * Math.sin(turned)];
  });

  const quarters = (sheet, angle) => corners(angle).map((corner, k, all) =>
    sheet.polygon([[0, 0], corner, all[(k + 1) % 4]], "",
                  `fill: ${rgb(COLOURS[k].map(toSrgb))}`));

  function draw() {
    scene.draw(quarters(scene, at), scene.polygon(corners(GOAL), "goal"));
    target.draw(quarters(target, GOAL), target.text([0, -1.6], "target", "middle"));
    const on = (n) => [n, HIGH * lossAt(n) / Math.max(...LOSSES)];
    curve.draw(
      curve.line([[-180, HIGH], [-180, 0], [180, 0]], "axis"),
      curve.line(Array.from({ length: 361 }, (_, n) => on(n - 180)), "curve alias"),
      curve.text([-180, HIGH], "loss", "label edge", [8, 8]), curve.dot(on(at), 7, "sample point"));
    const isRight = within(at) === GOAL;
    say(answer, stepFrom(at) ? "Downhill it goes on."
      : (isRight ? "Found." : "Stuck: the outline is right, and the colours are wrong.") +
        ` Of 360 starts, one for each degree, ${ARRIVE} arrive.`);
  }

  fill(place, draw, "From which share of all starts does downhill arrive?",
    "Guess, then press Play. Where it is stuck, turn the square by 90 degrees, and play again.",
    html("div", { class: "told pair" }, scene.box, target.box),
    html("div", { class: "told" }, curve.box, answer,
      html("div", { class: "row" }, ...buttons, turn)));
  sway(place, (t) => { at = START + Math.round(SWING * t); }, draw);
}
