/** Pictures that are computed pixel by pixel, row 0 at the bottom. */
import { Sheet, html } from "./paper.js";

/** [red, green, blue] from 0 to 1 -> one number, as the memory of a picture has it. */
export const coded = ([red, green, blue]) =>
  (255 << 24 | 255 * blue << 16 | 255 * green << 8 | 255 * red) >>> 0;

/** [red, green, blue] from 0 to 1 -> CSS. */
export const rgb = (colour) => `rgb(${colour.map((t) => 255 * t).join(" ")})`;

/** A square of a colour, and words. */
export const swatch = (css, words) =>
  `<span class="swatch"><i style="background: ${css}"></i>${words}</span>`;

const SRGB_JOIN = 0.0031306684425005758;

/** Light -> the number that a screen takes, both 0 to 1. */
export const toSrgb = (linear) =>
  (linear <= SRGB_JOIN ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);

/** The pixel of several pictures of one size: chosen in one, it is chosen in all.
 *  moved(centre, isChosen) is called when another is pointed at. -> set(centre) */
export function probePixels(sheets, start, moved) {
  let chosen = start;
  sheets.forEach((sheet) => sheet.probe({
    name: "Pixel", step: 1, from: [0.5, 0.5], at: () => chosen,
    limits: [sheet.x0 + 0.5, sheet.x1 - 0.5, sheet.y0 + 0.5, sheet.y1 - 0.5],
    moved: (to, isChosen) => {
      if (isChosen) chosen = to;
      moved(to, isChosen);
    } }));
  return (to) => { chosen = to; };
}

export class Picture extends Sheet {
  constructor(width, height, label, draw) {
    super([0, width, 0, height], label, draw);
    this.canvas = html("canvas", { width, height, "aria-hidden": "true" });
    this.box.prepend(this.canvas);
    this.box.classList.add("light");
  }

  /** codeAt(x, y, n) -> coded([red, green, blue]), at each pixel's centre; n is its number, rows
   *  from below. Nothing is allocated. */
  fill(codeAt) {
    const { width, height } = this.canvas;
    const context = this.canvas.getContext("2d");
    this.image ??= context.createImageData(width, height);
    const codes = new Uint32Array(this.image.data.buffer);
    for (let k = 0, row = height - 1; row >= 0; row--) {
      for (let column = 0; column < width; column++) {
        codes[k++] = codeAt(column + 0.5, row + 0.5, row * width + column);
      }
    }
    context.putImageData(this.image, 0, 0);
  }

  /** colourOf(n) -> [red, green, blue] from 0 to 1. */
  paint(colourOf) {
    this.fill((x, y, n) => coded(colourOf(n)));
  }
}
