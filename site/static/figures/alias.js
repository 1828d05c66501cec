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
  const fold = new Sheet([-0.03, 1.03, -0.07, 0.42],
    "The periods seen, and what the box filter leaves, against the wave's periods", draw);
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
    drawFold(Math.abs(alias) / (RATE / 2), Math.abs(left));
    tell(alias, left);
  }

  /** Both curves go from 0 to 1, which is drawn 0.36 high. */
  function drawFold(seen, left) {
    const at = (f, y) => [f / FASTEST, 0.36 * y];
    const all = range(300).map((x) => FASTEST * x);
    fold.draw(
      fold.line([at(0, 1.1), at(0, 0), at(FASTEST, 0)], "axis"),
      fold.line([at(RATE / 2, 0), at(RATE / 2, 1.1)], "ray"),
      [0, 0.5, 1, 1.5, 2, 2.5].map((k) =>
        fold.text(at(k * RATE, 0), number(k * RATE), "middle", [0, -18])),
      fold.line(all.map((f) => at(f, Math.abs(boxFactor(f, FINE, FINE * RATE)))), "curve second"),
      fold.line(all.map((f) => at(f, Math.abs(aliasFrequency(f, RATE)) / (RATE / 2))),
                "curve alias"),
      fold.text(at(RATE / 2, 1), "r/2", "", [6, 2]),
      fold.text(at(24, 0.85), "seen", "label alias middle"),
      fold.text(at(18, 0.38), "box", "label second middle"),
      fold.dot(at(frequency, seen), 7, "sample point"),
      fold.dot(at(frequency, left), 7, "sample second"));
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
    fold.box, html("div", { class: "told" }, answer, filtered));
}
