/** Page 16b in flatland: a row of pixels is paint times light, in many ways. */
import { fill, html, number, say, Sheet, slider, sway } from "./paper.js";
import { rgb, toSrgb } from "./picture.js";

const COUNT = 120, WIDTH = 12, BORDER = 7.6, HEAD = [3.4, 4.8];
const SUN = 1.2, NEW = 4.2, SWING = 0.8;      // how far the shadow falls to the right
const PAINT = [[0.8, 0.58, 0.12], [0.12, 0.35, 0.62]];
const SKY = 0.4, LAMP = 0.6, TINT = [1, 0.85, 0.62], T = 0.1, DARK = 0.1, SMOOTH = 0.02;
const PLACES = Array.from({ length: COUNT }, (_, n) => (n + 0.5) * WIDTH / COUNT);
const EDGES = Array.from({ length: COUNT - 1 }, (_, n) => [n, n + 1]);

/** Eq. (12) for lamps (K, 3). */
export const neutral = (lamps) => lamps.reduce((sum, lamp) => {
  const mean = lamp.reduce((a, b) => a + b) / 3;
  return lamp.reduce((rest, part) => rest + (part - mean) ** 2, sum);
}, 0);

/** Eq. (13) with w = 1, for edges [i, j] of this mean length. */
export const patches = (albedo, edges, length, t) => edges.reduce((sum, [i, j]) => {
  const square = albedo[i].reduce((rest, a, k) =>
    rest + (Math.log(a + DARK) - Math.log(albedo[j][k] + DARK)) ** 2, SMOOTH ** 2);
  return sum + t * Math.log1p(Math.sqrt(square) / t);
}, 0) / edges.length / length;

const isLit = (x, sun) => Number(x < HEAD[0] + sun || x > HEAD[1] + sun);
const times = (a, b) => a.map((row, n) => row.map((t, k) => t * b[n][k]));
const white = (strength) => Array(3).fill(strength);

/** The light at all places: lit is its share of the lamp, tint its colour. */
const lightOf = (lit, tint = white(1)) =>
  PLACES.map((x, n) => tint.map((t) => t * (SKY + LAMP * lit(x, n))));

const TRUTH = PLACES.map((x) => PAINT[Number(x > BORDER)]);
const PICTURE = times(TRUTH, lightOf((x) => isLit(x, SUN)));

/** Paint and light of the one picture: so much of the shadow, and of the colour, is the other's. */
export function explained(shadow, colour) {
  const tint = TINT.map((t) => t ** colour);
  const light = lightOf((x) => isLit(x, SUN) + shadow * (1 - isLit(x, SUN)), tint);
  const albedo = PICTURE.map((row, n) => row.map((c, k) => c / light[n][k]));
  return { albedo, light, lamps: [tint.map((t) => SKY * t), tint.map((t) => LAMP * t)] };
}

export function show(place) {
  let shadow = 0, colour = 0, sun = NEW;
  const sheet = new Sheet([0, WIDTH, -0.3, 8.3],
    "Rows of pixels: a picture, its paint, its light, and the paint in another sun", draw);
  const answer = html("p", { class: "verdict", role: "status" });
  const cost = html("p");
  const share = (label, changed) => slider({ label, min: 0, max: 100, step: 5, value: 0, unit: " %",
                                             changed: (to) => changed(to / 100) });
  const sliders = [share("shadow is paint", (to) => { shadow = to; }),
                   share("yellow is light", (to) => { colour = to; })];
  sheet.handle({ name: "Shadow in the new sun", mark: "↔", style: "second", step: 0.1,
                 at: () => [HEAD[0] + 0.7 + sun, 0.2], limits: [0.7, WIDTH - 0.7, 0.2, 0.2],
                 moved: ([x]) => { sun = x - HEAD[0] - 0.7; } });

  const row = (y, words, values) => [
    values.map((value, n) => sheet.rectangle(
      [n * WIDTH / COUNT, y], WIDTH / COUNT + 0.02, 1, "",
      `fill: ${rgb(value.map((t) => toSrgb(Math.min(t, 1))))}`)),
    sheet.rectangle([0, y], WIDTH, 1, "pixel"), sheet.text([0, y + 1], words, "", [0, 5])];

  function draw() {
    const { albedo, light, lamps } = explained(shadow, colour), made = times(albedo, light);
    const moved = lightOf((x) => isLit(x, sun));
    const off = (a, b) => Math.sqrt(a.flat().reduce(
      (sum, t, n) => sum + (t - b.flat()[n]) ** 2, 0) / (3 * COUNT));
    const right = times(TRUTH, moved), relit = times(albedo, moved);
    sheet.draw(row(6.8, "the picture: paint times light", made), row(4.9, "paint", albedo),
               row(3, "light", light), row(1.1, "this paint in a new sun", relit),
               sheet.rectangle([HEAD[0] + sun, 1.1], HEAD[1] - HEAD[0], 1, "goal"));
    cost.innerHTML = `(12), colour in the light: <b>${number(neutral(lamps))}</b>. ` +
      `(13), changes of paint: <b>${number(patches(albedo, EDGES, WIDTH / COUNT, T), 2)}</b>.`;
    say(answer, `The picture changes by ${number(off(made, PICTURE))}. In the new sun the paint ` +
      `is ${number(off(relit, right), 2)} off the truth.`);
  }

  fill(place, draw, "Which of the sliders changes the picture?",
    "Guess, then move both. Drag the new sun’s shadow below: it tells what the picture cannot.",
    sheet.box, html("div", { class: "told" }, ...sliders.map(({ element }) => element), answer,
                    cost));
  sway(place, (t) => { sun = NEW + Math.round(10 * SWING * t) / 10; }, draw);
}
