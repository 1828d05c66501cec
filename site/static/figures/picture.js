/** Pictures that are computed pixel by pixel, row 0 at the bottom. */
import { Sheet, html } from "./paper.js";

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

  /** colourAt(x, y) -> [red, green, blue] from 0 to 1, at each pixel's centre. */
  paint(colourAt) {
    const { width, height } = this.canvas;
    const context = this.canvas.getContext("2d");
    const image = context.createImageData(width, height);
    for (let n = 0; n < width * height; n++) {
      const [column, row] = [n % width, Math.floor(n / width)];
      const colour = colourAt(column + 0.5, height - row - 0.5);
      for (let k = 0; k < 3; k++) image.data[4 * n + k] = 255 * colour[k];
      image.data[4 * n + 3] = 255;
    }
    context.putImageData(image, 0, 0);
  }

  /** The pixel that is asked about: a cross in the picture. */
  cross([x, y]) {
    const reach = 10 / this.scale;
    return ["halo", "cross"].flatMap((style) => [
      this.line([[x - reach, y], [x + reach, y]], style),
      this.line([[x, y - reach], [x, y + reach]], style)]);
  }
}
