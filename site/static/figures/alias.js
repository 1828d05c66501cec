/** Lecture 03: a wave that is too fast for its samples looks like a slow one. */
import { counted, fill, html, number, Sheet, slider } from "./paper.js";
import { rgb } from "./picture.js";

const RATE = 12;                 // samples, at the middles of as many pixels
const FINE = 15;                 // each pixel is a box over so many fine samples
const FASTEST = 30, START = 11;

/** Eq. (1): the slowest frequency that has the same samples. */
export const aliasFrequency = (frequency, rate) =>
  frequency - rate * Math.floor(frequency / rate + 0.5);

/** Eq. (5), for one k: what is left of a frequency k / n after a box, `width` samples wide. */
export function boxFactor(k, width, n) {
  const angle = Math.PI * k / n;
  return Math.sin(angle) === 0 ? 1 : Math.sin(width * angle) / (width * Math.sin(angle));
}

const wave = (frequency, t) => Math.cos(2 * Math.PI * frequency * (t - 0.5 / RATE));
const range = (count) => Array.from({ length: count + 1 }, (_, n) => n / count);
const grey = (value) => `fill: ${rgb(Array(3).fill(0.5 + 0.45 * value))}`;

export function show(place) {
  let frequency = START;
  const times = Array.from({ length: RATE }, (_, n) => (n + 0.5) / RATE);
  const waves = new Sheet([0, 1, -0.075, 0.075],
    "The wave, its samples, and the alias through the same samples", draw);
  const strips = ["sampled", "the mean over each pixel"].map((title) =>
    ({ title, sheet: new Sheet([0, 1, 0, 0.05], `Twelve pixels: ${title}`, draw) }));
  const answer = html("p", { class: "verdict", role: "status" });
  const filtered = html("p");
  const control = slider({ label: "periods", min: 0, max: FASTEST, step: 0.5, value: START,
                           changed: (to) => { frequency = to; } });

  function draw() {
    const alias = aliasFrequency(frequency, RATE);
    const left = boxFactor(frequency, FINE, FINE * RATE);
    const samples = times.map((t) => wave(frequency, t));
    const curve = (f) => range(480).map((t) => [t, 0.055 * wave(f, t)]);
    waves.draw(
      waves.line(curve(frequency), "curve wave"), waves.line(curve(alias), "curve alias"),
      samples.map((value, n) => waves.dot([times[n], 0.055 * value], 5, "sample point")));
    [1, left].forEach((share, k) => strips[k].sheet.draw(samples.map((value, n) =>
      strips[k].sheet.rectangle([n / RATE, 0], 1 / RATE, 0.05, "square", grey(share * value)))));
    tell(alias, left);
  }

  function tell(alias, left) {
    answer.innerHTML = frequency < RATE / 2
      ? `${counted(frequency, "period")}, seen correctly.`
      : frequency === RATE / 2
        ? "Two samples per period: what is seen depends on where they lie."
        : `${number(frequency)} periods, but the samples show ` +
          `<b class="red">${number(Math.abs(alias))}</b>.`;
    filtered.innerHTML = `alias = <i>f</i> − <i>r m</i> = ${number(frequency)} − ${RATE} · ` +
      `${Math.floor(frequency / RATE + 0.5)} = <b class="red">${number(alias)}</b>.<br>` +
      `A box of one pixel leaves <b class="orange">${number(100 * Math.abs(left), 1)}%</b> ` +
      "of the wave.";
  }

  fill(place, draw, "Make the wave faster.", `There are always ${RATE} samples. ` +
      '<b class="red">Red</b> is the slowest wave through them.',
    html("div", { class: "wide told" }, control.element, waves.box,
      ...strips.flatMap(({ title, sheet }) => [html("p", {}, title), sheet.box])),
    html("div", { class: "wide told" }, answer, filtered));
}
