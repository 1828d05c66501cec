/** Lecture 03: a wave that is too fast for its samples looks like a slow one. */
import { button, html, number, Sheet, slider } from "./paper.js";

const RATE = 12;                 // samples, at the middles of as many pixels
const FINE = 15;                 // each pixel is a box over so many fine samples
const FASTEST = 30, START = 11;

/** Eq. (1): the slowest frequency that has the same samples. */
export const aliasFrequency = (frequency, rate) =>
  frequency - rate * Math.floor(frequency / rate + 0.5);

/** Eq. (5): what is left of a frequency k / n after a box that is `width` samples wide. */
export function boxFactor(k, width, n) {
  const angle = Math.PI * k / n;
  return Math.sin(angle) === 0 ? 1 : Math.sin(width * angle) / (width * Math.sin(angle));
}

/** Eq. (5): the spectrum of a box filter on n samples. */
export const boxSpectrum = (width, n) =>
  Array.from({ length: n }, (_, k) => boxFactor(k, width, n));

const wave = (frequency, t) => Math.cos(2 * Math.PI * frequency * (t - 0.5 / RATE));
const range = (count) => Array.from({ length: count + 1 }, (_, n) => n / count);
const grey = (value) => `fill: rgb(${Array(3).fill(255 * (0.5 + 0.45 * value)).join(" ")})`;

export function show(place) {
  let frequency = START;
  const times = Array.from({ length: RATE }, (_, n) => (n + 0.5) / RATE);
  const waves = new Sheet([-0.01, 1.01, -0.17, 0.145],
    "The wave, its samples, and the alias through the same samples", draw);
  const fold = new Sheet([-0.06, 1.02, -0.055, 0.25],
    "The frequency that is seen, and what the box filter leaves, against the frequency", draw);
  const answer = html("p", { class: "verdict", role: "status" });
  const filtered = html("p");
  const control = slider({ label: "periods", min: 0, max: FASTEST, step: 0.5, value: START,
    changed: (value) => {
      frequency = value;
      draw();
    } });
  const reset = button("Reset", () => {
    control.set(START);
    frequency = START;
    draw();
  });

  function strip(title, values, y) {
    return [waves.text([0, y], title, "", [0, 5]), values.map((value, n) => {
      const pixel = waves.rectangle([n / RATE, y - 0.04], 1 / RATE, 0.04, "square");
      pixel.style.cssText = grey(value);
      return pixel;
    })];
  }

  function draw() {
    const alias = aliasFrequency(frequency, RATE);
    const left = boxFactor(frequency, FINE, FINE * RATE);
    const samples = times.map((t) => wave(frequency, t));
    const curve = (f) => range(720).map((t) => [t, 0.08 + 0.055 * wave(f, t)]);
    waves.draw(
      waves.line(curve(frequency), "curve wave"), waves.line(curve(alias), "curve alias"),
      samples.map((value, n) => waves.dot([times[n], 0.08 + 0.055 * value], 5, "sample point")),
      strip("sampled", samples, -0.025).flat(2),
      strip("box filter, then sampled", samples.map((value) => left * value), -0.115).flat(2));
    const across = (f) => f / FASTEST;
    const seen = range(FASTEST * 2).map((x) =>
      [x, 0.4 * Math.abs(aliasFrequency(FASTEST * x, RATE)) / RATE]);
    const share = range(240).map((x) =>
      [x, 0.2 * Math.abs(boxFactor(FASTEST * x, FINE, FINE * RATE))]);
    const ticks = [0, 0.5, 1, 1.5, 2, 2.5].map((k) => k * RATE);
    fold.draw(
      fold.line([[0, 0.22], [0, 0], [1, 0]], "axis"),
      fold.line([[across(RATE / 2), 0], [across(RATE / 2), 0.22]], "ray"),
      ticks.map((f) => fold.text([across(f), 0], number(f), "", [f > 9 ? -9 : -4, -20])),
      fold.line(share, "curve second"), fold.line(seen, "curve alias"),
      fold.text([across(RATE / 2), 0.22], "r/2", "", [6, -12]),
      fold.text([across(13), 0.17], "periods seen", "label alias"),
      fold.text([across(2), 0.05], "left by the box", "label second", [0, 0]),
      fold.dot([across(frequency), 0.4 * Math.abs(alias) / RATE], 7, "sample point"),
      fold.dot([across(frequency), 0.2 * Math.abs(left)], 7, "sample second"));
    answer.textContent = Math.abs(frequency) < RATE / 2
      ? `Seen correctly: ${number(frequency)} periods.`
      : `${number(frequency)} periods, but the ${RATE} samples show ${number(Math.abs(alias))}.`;
    const turns = Math.floor(frequency / RATE + 0.5);
    filtered.innerHTML = `alias = <i>f</i> − <i>r m</i> = ${number(frequency)} − ${RATE} · ` +
      `${turns} = <b>${number(alias)}</b>.<br>The box of one pixel leaves ` +
      `<b>${number(100 * Math.abs(left), 1)}%</b> of the wave.`;
  }

  place.append(html("div", { class: "figure" },
    html("p", { class: "task" }, "Make the wave faster. ",
      html("span", {}, `There are always r = ${RATE} samples.`)),
    html("div", { class: "wide" }, control.element, waves.box),
    fold.box, html("div", { class: "told" }, answer, filtered, reset)));
  draw();
}
