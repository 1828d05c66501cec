/** Pictures that are computed pixel by pixel, row 0 at the bottom. */
import { Sheet, html } from "./paper.js";

/** [red, green, blue] from 0 to 1 -> one number, as the memory of a picture has it. */
export const coded = ([red, green, blue]) =>
  (255 << 24 | 255 * blue << 16 | 255 * green << 8 | 255 * red) >>> 0;

const SRGB_JOIN = 0.0031306684425005758;

/** Light -> the number that a screen takes, both 0 to 1. */
export const toSrgb = (linear) =>
  (linear <= SRGB_JOIN ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);

/** The pixel of several pictures of one size: chosen in one, it is chosen in all. -> set(point) */
export function probeAll(pictures, at, moved) {
  const { width, height } = pictures[0].canvas;
  const set = (to) => probes.forEach((probe) => probe.set(to));
  const probes = pictures.map((picture) => picture.probe({
    name: "Pixel", step: 1, from: [0.5, 0.5], at,
    limits: [0.5, width - 0.5, 0.5, height - 0.5],
    moved: (to, isChosen) => {
      if (isChosen) set(to);
      moved(to);
    } }));
  return set;
}

export class Picture extends Sheet {
  constructor(width, height, label, draw) {
    super([0, width, 0, height], label, draw);
    this.canvas = html("canvas", { width, height, "aria-hidden": "true" });
    this.box.prepend(this.canvas);
    this.box.classList.add("light");
  }

  /** codeAt(x, y) -> coded([red, green, blue]), at each pixel's centre. Nothing is allocated. */
  fill(codeAt) {
    const { width, height } = this.canvas;
    const context = this.canvas.getContext("2d");
    this.image ??= context.createImageData(width, height);
    const codes = new Uint32Array(this.image.data.buffer);
    for (let n = 0, y = height - 0.5; y > 0; y--) {
      for (let x = 0.5; x < width; x++) codes[n++] = codeAt(x, y);
    }
    context.putImageData(this.image, 0, 0);
  }

  /** colourAt(x, y) -> [red, green, blue] from 0 to 1, at each pixel's centre. */
  paint(colourAt) {
    this.fill((x, y) => coded(colourAt(x, y)));
  }

  /** The pixel that is asked about: a cross in the picture. */
  cross([x, y]) {
    const reach = 10 / this.scale;
    return ["halo", "cross"].flatMap((style) => [
      this.line([[x - reach, y], [x + reach, y]], style),
      this.line([[x, y - reach], [x, y + reach]], style)]);
  }
}
