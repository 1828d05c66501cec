/** Lecture 04: many samples say which face is seen, and few shades give their colours. */
import { isCovered } from "./edge_functions.js";
import { button, centreOf, centres, counted, fill, html, say, Sheet } from "./paper.js";
import { Picture, probePixels, rgb, toSrgb } from "./picture.js";
import { minus, plus } from "./vectors.js";

const WIDTH = 24, HEIGHT = 14;
const COUNTS = [1, 4, 16], STEPS = { 1: 1, 4: 3, 16: 4 };  // k of eq. (3) for S samples
const NEAR = [[5.5, 1.25], [11.5, 1], [21.5, 11.75]];   // its last vertex is to be dragged
const FAR = [[1.5, 4.5], [22.5, 2.5], [8.5, 13.25]];
const CHOSEN = [8.5, 3.5];               // a pixel that sees both faces and the background
const MOST = 2200;                       // shades, where a bar is as long as it may be
const FACES = [[0.02, 0.2, 0.52], [0.95, 0.42, 0.03]];  // blue and orange, in light
const BACKGROUND = [0.92, 0.92, 0.92];

/** Eq. (3): the lattice of S = count samples with k = step -> S positions in the unit pixel. */
const lattice = (count, step) => Array.from({ length: count }, (_, s) =>
  [(s + 0.5) / count, (step * (s + 1) % (count + 1) - 0.5) / count]);

export const standardPattern = (count) => lattice(count, STEPS[count]);

/** The nearest face of every sample, [s][row * width + column], or -1. triangles: near ones first.
 *  Here the samples go to the faces. Eq. (4) brings the faces to the samples, to the same end. */
export function rasterizeSamples(triangles, width, height, pattern) {
  return pattern.map(([x, y]) => Int8Array.from(centres(width, height), (centre) => {
    const p = plus(centre, [x - 0.5, y - 0.5]);
    return triangles.findIndex((triangle) => isCovered(p, triangle));
  }));
}

/** Eq. (7): each face that a pixel's samples see, once -> pixel, face, request of each sample. */
export function shadingRequests(faceIndex) {
  const pixel = [], face = [];
  const request = faceIndex.map((seen) => new Int32Array(seen.length).fill(-1));
  for (let n = 0; n < faceIndex[0].length; n++) {
    const first = pixel.length;
    faceIndex.forEach((seen, s) => {
      if (seen[n] < 0) return;
      let k = face.indexOf(seen[n], first);
      if (k < 0) k = pixel.push(n) && face.push(seen[n]) - 1;
      request[s][n] = k;
    });
  }
  return { pixel, face, request };
}

/** Eq. (1): the mean light of each pixel's samples. shade, background: [red, green, blue]. */
export function resolve(shade, request, background) {
  const colourOf = (s, n) => shade[request[s][n]] ?? background;
  return Array.from({ length: request[0].length }, (_, n) => {
    const first = colourOf(0, n), sum = [0, 0, 0];
    for (let s = 1; s < request.length; s++) {
      const colour = colourOf(s, n);
      if (colour !== first) for (let k = 0; k < 3; k++) sum[k] += colour[k] - first[k];
    }
    return first.map((value, k) => value + sum[k] / request.length);
  });
}

/** The light that a face sends from p. It changes evenly, and by little in a pixel. */
const shadeAt = ([x, y], face) =>
  FACES[face].map((value) => value * (0.3 + 0.7 * (x + HEIGHT - y) / (WIDTH + HEIGHT)));

const fillOf = (light, share = 100) =>
  `fill: color-mix(in srgb, ${rgb(light.map(toSrgb))} ${share}%, white)`;

export function show(place) {
  let near = NEAR, count = 4, p = CHOSEN;
  const picture = new Picture(WIDTH, HEIGHT,
    "Two triangles that overlap, in 24 by 14 pixels", draw);
  const pixel = new Sheet([-0.1, 1.1, -0.1, 1.1],
    "The chosen pixel with its samples, each in the colour of the face that it sees", draw);
  const price = new Sheet([0, 20, 0, 3.6],
    "How many shades MSAA and supersampling compute", draw);
  pixel.box.classList.add("light", "cut");
  const about = html("p", { class: "about" });
  const tested = html("p", { role: "status" });
  const buttons = COUNTS.map((samples) => button(samples, () => { count = samples; }));
  picture.handle({
    name: "The near triangle's vertex 2", mark: "2", at: () => near[2], step: 0.25,
    limits: [0.5, WIDTH - 0.5, 2.5, HEIGHT - 0.5],
    moved: (to) => { near = near.with(2, to); } });
  probePixels([picture], CHOSEN, (to) => { p = to; });

  function draw() {
    const pattern = standardPattern(count);
    const faceIndex = rasterizeSamples([near, FAR], WIDTH, HEIGHT, pattern);
    const requests = shadingRequests(faceIndex);
    const shades = requests.face.map((face, k) =>
      shadeAt(centreOf(requests.pixel[k], WIDTH), face));
    const resolved = resolve(shades, requests.request, BACKGROUND);
    const n = Math.floor(p[1]) * WIDTH + Math.floor(p[0]);
    picture.paint((k) => resolved[k].map(toSrgb));
    picture.draw(picture.rectangle(p.map((t) => t - 0.5), 1, 1, "chosen"));
    buttons.forEach((one, k) => one.setAttribute("aria-pressed", COUNTS[k] === count));
    say(tested, `${counted(count * WIDTH * HEIGHT, "sample")} tested for coverage`);
    drawPixel(pattern, faceIndex.map((seen) => seen[n]), resolved[n]);
    drawPrice(shades.length,
              faceIndex.reduce((sum, seen) => sum + seen.filter((face) => face >= 0).length, 0));
  }

  /** The pixel p, enlarged. Its frame has the colour that it becomes. */
  function drawPixel(pattern, seen, colour) {
    const corner = p.map((t) => t - 0.5);
    const [outer, inner] = [0.1, 0].map((rim) => [0, 1, 3, 2, 0].map((n) =>
      [n & 1 ? 1 + rim : -rim, n & 2 ? 1 + rim : -rim]));
    pixel.draw(
      pixel.polygon(inner, "", fillOf(BACKGROUND)),
      [FAR, near].map((triangle, k) => pixel.polygon(
        triangle.map((vertex) => minus(vertex, corner)), "", fillOf(shadeAt(p, 1 - k), 45))),
      pixel.polygon([...outer, ...inner], "rim", fillOf(colour)), pixel.line(outer, "chosen"),
      pattern.map((at, s) => pixel.dot(at, 4 + pixel.scale / 80, "sample",
        fillOf(seen[s] < 0 ? BACKGROUND : shadeAt(p, seen[s])))),
      pixel.cross([0.5, 0.5], 0.07 * pixel.scale));
    const counts = [0, 1, -1].map((face) => seen.filter((f) => f === face).length);
    const parts = ['<b class="blue">blue</b>', '<b class="orange">orange</b>', "no face"]
      .map((what, k) => [counts[k], what]).filter(([n]) => n)
      .map(([n, what]) => `${n} see${n === 1 ? "s" : ""} ${what}`);
    const shades = counts.slice(0, 2).filter((n) => n).length;
    about.innerHTML = `${parts.join(", ")}: <b>${counted(shades, "shade")}</b>` +
      `${shades ? ', at the <b class="red">centre</b>' : ""}. ` +
      "The frame has the mean colour of all samples.";
  }

  function drawPrice(shades, samples) {
    const bar = (row, value, who, style) => [
      price.rectangle([0, row], 9 * value / MOST, 1.1, style),
      price.text([9 * value / MOST, row], `${value.toLocaleString("en")} ${who}`, "", [6, 5])];
    price.draw(bar(2, shades, "shades by MSAA", "bar descent"),
               bar(0.3, samples, "by supersampling", "bar"));
  }

  fill(place, draw, "Choose 1, 4 or 16 samples. Point at pixels. Drag vertex 2.",
    "The outlines become smooth, and the number of shades hardly grows.",
    html("div", { class: "told" }, picture.box,
      html("div", { class: "row", role: "group", "aria-label": "Samples in each pixel" },
        ...buttons, "samples in each pixel"), tested, price.box),
    html("div", { class: "told enlarged" }, pixel.box, about));
}
