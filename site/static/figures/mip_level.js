/** Lecture 06: the footprint of a pixel tells which level of the pyramid it reads. */
import { centres, CIRCLE, clamp, fill, html, number, player } from "./paper.js";
import { coded, Picture, probePixels, swatch, toSrgb } from "./picture.js";
import { between } from "./vectors.js";

const WIDTH = 336, HEIGHT = 192, TILT = 25 * Math.PI / 180;  // the camera: 90 degrees wide
const SIZE = 128, SQUARE = 16;           // the texture is SIZE x SIZE texels
const TURN = 0.35, PERIOD = 2;           // how it lies on the floor; the eye is 1 high
const ZOOM = 120, CHOSEN = [100.5, 152.5];
const SKY = coded([0.8, 0.88, 0.95]), DARK = [0.16, 0.3, 0.42], LIGHT = [0.96, 0.96, 0.94];

/** Mixtures of light, from DARK to LIGHT, as codes. */
const toLight = (code) => code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
const SHADES = Uint32Array.from({ length: 257 }, (_, n) =>
  coded(between(DARK.map(toLight), LIGHT.map(toLight), n / 256).map(toSrgb)));
const shade = (value) => SHADES[Math.round(256 * value)];

/** Eq. (5): each texel of the next level is the mean of 2 x 2, image[row][column]. */
const halve = (image) => Array.from({ length: image.length / 2 }, (_, i) =>
  Float64Array.from({ length: image[0].length / 2 }, (_, j) =>
    (image[2 * i][2 * j] + image[2 * i + 1][2 * j] + image[2 * i][2 * j + 1] +
     image[2 * i + 1][2 * j + 1]) / 4));

export function pyramid(image) {
  const levels = [image];
  while (levels.at(-1).length > 1) levels.push(halve(levels.at(-1)));
  return levels;
}

/** J in texels: its rows (s_x, s_y) and (t_x, t_y). */
const inTexels = ([s, t], width, height) =>
  [s.map((x) => width * x), t.map((x) => height * x)];

/** Eq. (6): the level whose texels are as large as the footprint is long. */
export function mipLevel(jacobian, width, height) {
  const [[sX, sY], [tX, tY]] = inTexels(jacobian, width, height);
  const [A, B, C] = [sX ** 2 + tX ** 2, sY ** 2 + tY ** 2, sX * sY + tX * tY];
  return Math.log2((A + B) / 2 + Math.sqrt((A - B) ** 2 / 4 + C ** 2)) / 2;
}

/** Eq. (7): the two levels that are mixed, and the fraction of the upper one. */
export function blendLevels(level, top) {
  const clamped = clamp(level, 0, top);
  const lower = Math.floor(clamped);
  return [lower, Math.min(lower + 1, top), clamped - lower];
}

/** Eq. (1), with wrap: the texel of image[row][column], whose sides are powers of two. */
export const nearest = (image, u, v) => image[Math.floor(v * image.length) & (image.length - 1)][
  Math.floor(u * image[0].length) & (image[0].length - 1)];

/** Eq. (2) and (3), with wrap: four texels around (u, v). */
export function bilinear(image, u, v) {
  const last = image.length - 1;
  const x = u * image.length - 0.5, y = v * image.length - 0.5;
  const j = Math.floor(x), i = Math.floor(y);
  const a = x - j, b = y - i;
  const lower = image[i & last], upper = image[(i + 1) & last];
  return (1 - b) * ((1 - a) * lower[j & last] + a * lower[(j + 1) & last]) +
         b * ((1 - a) * upper[j & last] + a * upper[(j + 1) & last]);
}

/** Eq. (7): eight texels, of two levels. */
export function trilinear(levels, u, v, level) {
  const [lower, upper, f] = blendLevels(level, levels.length - 1);
  const below = bilinear(levels[lower], u, v);
  return f ? (1 - f) * below + f * bilinear(levels[upper], u, v) : below;
}

/** Eq. (4), by n x n points: what is right. */
export function footprintMean(image, [u, v], [[uX, uY], [vX, vY]], n) {
  let sum = 0;
  for (let k = 0; k < n * n; k++) {
    const dx = (k % n + 0.5) / n - 0.5, dy = (Math.floor(k / n) + 0.5) / n - 0.5;
    sum += nearest(image, u + uX * dx + uY * dy, v + vX * dx + vY * dy);
  }
  return sum / n ** 2;
}

const [COS, SIN] = [Math.cos(TURN) / PERIOD, Math.sin(TURN) / PERIOD];
const turned = (p, q) => [COS * p - SIN * q, SIN * p + COS * q];

/** (u, v) and J = d(u, v)/d(x, y) of the floor, seen by a camera that is 1 above it. */
export function floorAt([x, y], forward = 0) {
  const f = WIDTH / 2;
  const [X, Y] = [(x - WIDTH / 2) / f, (y - HEIGHT / 2) / f];
  const down = Math.sin(TILT) - Y * Math.cos(TILT);
  if (down <= 0) return null;            // the sky
  const ahead = (Math.cos(TILT) + Y * Math.sin(TILT)) / down;
  const columns = [turned(1 / (f * down), 0),
                   turned(X * Math.cos(TILT) / (f * down ** 2), 1 / (f * down ** 2))];
  return { uv: turned(X / down, ahead + forward),
           jacobian: [0, 1].map((r) => columns.map((column) => column[r])) };
}

const CHECKERS = pyramid(Array.from({ length: SIZE }, (_, i) => Float64Array.from(
  { length: SIZE }, (_, j) => (Math.floor(i / SQUARE) + Math.floor(j / SQUARE)) % 2)));
const TOP = CHECKERS.length - 1;
const levelOf = ({ jacobian }) => mipLevel(jacobian, SIZE, SIZE);

export function show(place) {
  let forward = 0, p = CHOSEN;
  const floor = new Picture(WIDTH, HEIGHT, "A floor: left half, one texel for each pixel; " +
                            "right half, the pyramid", mark);
  const texels = new Picture(ZOOM, ZOOM, "The pixel's footprint on the texture", mark);
  floor.box.classList.add("smooth");
  const colours = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  probePixels([floor], CHOSEN, (to) => { p = to; });
  const walk = player("Walk", () => {
    forward += 0.012;
    paint();
  }, mark);

  // The walk changes neither J nor the level of a pixel.
  const seen = centres(WIDTH, HEIGHT).map((centre) => floorAt(centre));
  const [us, vs, levels] = [({ uv }) => uv[0], ({ uv }) => uv[1], levelOf].map((of) =>
    Float64Array.from(seen, (point) => (point ? of(point) : NaN)));

  function paint() {
    const [du, dv] = turned(0, forward);
    floor.fill((x, y, n) => {
      const u = us[n] + du, v = vs[n] + dv;
      if (Number.isNaN(u)) return SKY;
      return shade(x < WIDTH / 2 ? nearest(CHECKERS[0], u, v)
        : trilinear(CHECKERS, u, v, levels[n]));
    });
  }

  function mark() {
    const at = floorAt(p, forward);
    floor.draw(floor.line([[WIDTH / 2, 0], [WIDTH / 2, HEIGHT]], "true"),
      floor.text([0, HEIGHT], "one texel", "", [8, -20]),
      floor.text([WIDTH / 2, HEIGHT], "pyramid", "", [8, -20]), floor.cross(p));
    for (const { style } of [texels.box, colours]) style.visibility = at ? "" : "hidden";
    if (at) zoomIn(at, levelOf(at));
    answer.innerHTML = at ? sentence(levelOf(at)) : "The sky has no footprint.";
  }

  /** The footprint, and a square that is 2^level texels wide, both around (u, v). */
  function zoomIn({ uv, jacobian }, level) {
    const J = inTexels(jacobian, SIZE, SIZE);
    const texel = ZOOM / (1.7 * 2 ** Math.max(level, 0));
    const [u, v] = uv;
    texels.fill((x, y) => shade(nearest(CHECKERS[0], u + (x - ZOOM / 2) / texel / SIZE,
                                        v + (y - ZOOM / 2) / texel / SIZE)));
    const byPixel = (d) => J.map((row) => ZOOM / 2 + (row[0] * d[0] + row[1] * d[1]) * texel);
    const square = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    const circle = CIRCLE.map(([x, y]) => [x / 2, y / 2]);
    const wide = square.map((d) => d.map((t) => ZOOM / 2 + t * texel * 2 ** level));
    texels.draw(["halo", "outline first thick"].map((style) => texels.polygon(wide, style)),
      texels.polygon(square.map(byPixel), "print"), texels.polygon(circle.map(byPixel), "true"),
      texels.text(wide[3], `level ${number(level, 2)}`, "label first", [6, -20]));
    colours.innerHTML = [[nearest(CHECKERS[0], u, v), "one texel"],
      [trilinear(CHECKERS, u, v, level), "pyramid"],
      [footprintMean(CHECKERS[0], uv, jacobian, 24), "true mean"]].map(([value, words]) => {
      const code = shade(value);
      return swatch(`rgb(${code & 255} ${code >> 8 & 255} ${code >> 16 & 255})`, words);
    }).join("");
  }

  function sentence(level) {
    const [lower, upper, f] = blendLevels(level, TOP);
    return `The <b class="red">footprint</b> is ${number(2 ** level, 2)} texels long, a ` +
      `<b class="blue">texel of level ${number(level, 2)}</b> as wide. The pixel ` +
      (f ? `mixes ${number(1 - f, 2)} of level ${lower} and ${number(f, 2)} of level ${upper}.`
        : `takes level ${lower} alone.`);
  }

  paint();
  fill(place, mark, "Point at a pixel, near and far.", "Then walk.",
    floor.box, texels.box, html("div", { class: "told" }, answer, colours, walk.element));
}
