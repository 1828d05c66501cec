/** Lecture 06: the footprint of a pixel tells which level of the pyramid it reads. */
import { button, clamp, html, number, Sheet, slider, table } from "./paper.js";
import { Picture, probeAll } from "./picture.js";

const WIDTH = 168, HEIGHT = 112, SIZE = 64, SQUARE = 8;  // the texture is SIZE x SIZE texels
const TURN = 0.35, PERIOD = 2;           // how the texture lies on the floor; the eye is 1 high
const START = { tilt: 20, forward: 0 }, CHOSEN = [104.5, 66.5];
const SKY = [0.8, 0.88, 0.95], DARK = [0.16, 0.3, 0.42], LIGHT = [0.96, 0.96, 0.94];
const LEVELS = [[68, 1, 84], [70, 50, 127], [54, 92, 141], [39, 127, 142], [31, 161, 135],
                [122, 209, 81], [253, 231, 37]].map((colour) => colour.map((t) => t / 255));

const mix = (a, b, t) => a.map((value, k) => (1 - t) * value + t * b[k]);

/** The numbers that a screen takes for mixtures of light, from DARK to LIGHT. */
const toLight = (code) => code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
const toCode = (light) => light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055;
const SHADES = Array.from({ length: 257 }, (_, k) =>
  mix(DARK.map(toLight), LIGHT.map(toLight), k / 256).map(toCode));
const shade = (value) => SHADES[Math.round(256 * value)];

/** Eq. (5): each texel of the next level is the mean of 2 x 2, image[row][column]. */
export const halve = (image) => Array.from({ length: image.length / 2 }, (_, i) =>
  Array.from({ length: image[0].length / 2 }, (_, j) =>
    (image[2 * i][2 * j] + image[2 * i + 1][2 * j] + image[2 * i][2 * j + 1] +
     image[2 * i + 1][2 * j + 1]) / 4));

export function pyramid(image) {
  const levels = [image];
  while (levels.at(-1).length > 1) levels.push(halve(levels.at(-1)));
  return levels;
}

/** The rows (s_x, s_y) and (t_x, t_y) of J in texels, and A, B, C of eq. (6). */
export function footprint([[uX, uY], [vX, vY]], width, height) {
  const [sX, sY, tX, tY] = [width * uX, width * uY, height * vX, height * vY];
  return { sX, sY, tX, tY, A: sX ** 2 + tX ** 2, B: sY ** 2 + tY ** 2, C: sX * sY + tX * tY };
}

/** Eq. (6): the level whose texels are as large as the footprint is long. */
export function mipLevel(jacobian, width, height) {
  const { A, B, C } = footprint(jacobian, width, height);
  return Math.log2((A + B) / 2 + Math.sqrt((A - B) ** 2 / 4 + C ** 2)) / 2;
}

/** Eq. (7): the two levels that are mixed, and the fraction of the upper one. */
export function blendLevels(level, top) {
  const clamped = clamp(level, 0, top);
  const lower = Math.floor(clamped);
  return [lower, Math.min(lower + 1, top), clamped - lower];
}

export const nearestTexel = (x, size) => Math.floor(x * size);

const wrap = (index, size) => ((index % size) + size) % size;

/** Eq. (2) of texturing: four texels of one level, image[row][column], around (u, v). */
export function bilinear(image, [u, v]) {
  const size = image.length;
  const [x, y] = [u * size - 0.5, v * size - 0.5];
  const [j, i] = [Math.floor(x), Math.floor(y)];
  const texel = (row, column) => image[wrap(row, size)][wrap(column, size)];
  const row = (r) => (1 - (x - j)) * texel(r, j) + (x - j) * texel(r, j + 1);
  return (1 - (y - i)) * row(i) + (y - i) * row(i + 1);
}

/** (u, v) and J = d(u, v)/d(x, y) of the floor, seen by a camera that is 1 above it. */
export function floorAt([x, y], { tilt, forward }) {
  const angle = tilt * Math.PI / 180;
  const f = WIDTH / 2;                   // 90 degrees wide
  const [X, Y] = [(x - WIDTH / 2) / f, (y - HEIGHT / 2) / f];
  const down = Math.sin(angle) - Y * Math.cos(angle);
  if (down <= 0) return null;            // the sky
  const place = [X / down, (Math.cos(angle) + Y * Math.sin(angle)) / down + forward];
  const byPixel = [[1 / (f * down), X * Math.cos(angle) / (f * down ** 2)],
                   [0, 1 / (f * down ** 2)]];
  const [c, s] = [Math.cos(TURN) / PERIOD, Math.sin(TURN) / PERIOD];
  const turned = (p, q) => [c * p - s * q, s * p + c * q];
  const columns = [0, 1].map((k) => turned(byPixel[0][k], byPixel[1][k]));
  return { uv: turned(...place), jacobian: [0, 1].map((r) => columns.map((col) => col[r])) };
}

const CHECKERS = pyramid(Array.from({ length: SIZE }, (_, i) => Array.from({ length: SIZE },
  (_, j) => (Math.floor(i / SQUARE) + Math.floor(j / SQUARE)) % 2)));
const TOP = CHECKERS.length - 1;

const nearest = ({ uv }) => {
  const [j, i] = uv.map((t) => wrap(nearestTexel(t, SIZE), SIZE));
  return shade(CHECKERS[0][i][j]);
};

function trilinear({ uv, jacobian }, showsLevels) {
  const [lower, upper, f] = blendLevels(mipLevel(jacobian, SIZE, SIZE), TOP);
  const value = (1 - f) * bilinear(CHECKERS[lower], uv) + f * bilinear(CHECKERS[upper], uv);
  const colour = shade(value);
  return showsLevels ? mix(colour, mix(LEVELS[lower], LEVELS[upper], f), 0.65) : colour;
}

export function show(place) {
  let camera = START, p = CHOSEN;
  const levels = html("input", { type: "checkbox" });
  const pictures = ["Nearest: one texel", "Trilinear: eight texels"].map((title) =>
    ({ title, picture: new Picture(WIDTH, HEIGHT, title, mark) }));
  const texels = new Sheet([-1, 1, -0.7, 0.7], "The footprint on the texels", mark);
  texels.box.classList.add("light", "cut");
  const numbers = table("J in texels", ["texels", "by <i>x</i>", "by <i>y</i>"],
                        ["<i>s</i>", "<i>t</i>"]);
  const sums = html("p");
  const squares = html("p");
  const answer = html("p", { class: "verdict", role: "status" });
  const choose = probeAll(pictures.map(({ picture }) => picture), CHOSEN, (to) => {
    p = to;
    mark();
  });
  const sliders = [
    slider({ label: "tilt", min: 0, max: 60, step: 1, value: START.tilt, unit: "°",
             changed: (tilt) => draw({ ...camera, tilt }) }),
    slider({ label: "forward", min: 0, max: 1, step: 0.01, value: START.forward,
             changed: (forward) => draw({ ...camera, forward }) })];
  const reset = button("Reset", () => {
    sliders.forEach((each, k) => each.set(k ? START.forward : START.tilt));
    choose(CHOSEN);
    p = CHOSEN;
    levels.checked = false;
    draw(START);
  });
  levels.addEventListener("change", () => draw(camera));

  function draw(to) {
    camera = to;
    const colours = [nearest, (seen) => trilinear(seen, levels.checked)];
    pictures.forEach(({ picture }, k) => picture.paint((x, y) => {
      const seen = floorAt([x, y], camera);
      return seen ? colours[k](seen) : SKY;
    }));
    mark();
  }

  function mark() {
    pictures.forEach(({ picture }) => picture.draw(picture.cross(p)));
    const seen = floorAt(p, camera);
    const J = seen && footprint(seen.jacobian, SIZE, SIZE);
    const level = seen && mipLevel(seen.jacobian, SIZE, SIZE);
    numbers.write(J ? [[J.sX, J.sY], [J.tX, J.tY]].map((row) => row.map((t) => number(t)))
      : [["–", "–"], ["–", "–"]]);
    texels.draw(J ? drawn(seen.uv, J, level) : []);
    tell(J, level);
  }

  /** The footprint and its ellipse, in units of 2^level texels, on the lower level's texels. */
  function drawn(uv, { sX, sY, tX, tY }, level) {
    const unit = 2 ** level;
    const texel = 2 ** blendLevels(level, TOP)[0] / unit;
    const start = uv.map((t) => -wrap(t * SIZE / unit, texel));
    const steps = Array.from({ length: Math.ceil(4 / texel) + 2 }, (_, n) => n * texel);
    const lines = steps.flatMap((step) => [step, -step]).flatMap((step) => [
      texels.line([[start[0] + step, -0.7], [start[0] + step, 0.7]], "texel"),
      texels.line([[-1, start[1] + step], [1, start[1] + step]], "texel")]);
    const onTexture = ([dx, dy]) => [(sX * dx + sY * dy) / unit, (tX * dx + tY * dy) / unit];
    const around = Array.from({ length: 61 }, (_, n) => n * Math.PI / 30);
    const corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]];
    return [lines, texels.line(corners.map(onTexture), "print"),
            texels.line(around.map((a) => onTexture([Math.cos(a) / 2, Math.sin(a) / 2])), "true")];
  }

  function tell(J, level) {
    const names = J ? [J.A, J.B, J.C, level].map((t) => number(t)) : Array(4).fill("–");
    sums.innerHTML = `<i>A</i> = ${names[0]}, <i>B</i> = ${names[1]}, <i>C</i> = ${names[2]}<br>` +
      `<b>level = ${names[3]}</b>`;
    const [lower, upper, f] = blendLevels(level, TOP);
    squares.textContent = J ? `The squares are texels of level ${lower}.` : "–";
    answer.textContent = !J ? "The sky has no footprint."
      : f ? `${number(1 - f, 2)} of level ${lower} and ${number(f, 2)} of level ${upper}.`
        : `Level ${lower} alone.`;
  }

  place.append(html("div", { class: "pane" },
    html("p", { class: "task" }, "Tilt the camera. Point at a pixel. ",
      html("span", {}, "On the texture, the pixel's circle is an ellipse, ",
        "2", html("sup", {}, "level"), " texels long.")),
    html("div", { class: "two" }, ...pictures.map(({ title, picture }) =>
      html("div", {}, html("p", {}, title), picture.box))),
    html("div", { class: "two" },
      html("div", { class: "told" }, ...sliders.map((each) => each.element),
        html("label", { class: "check" }, levels, "show the levels"), numbers.element, reset),
      html("div", { class: "told" }, squares, texels.box, sums, answer))));
  draw(START);
}
