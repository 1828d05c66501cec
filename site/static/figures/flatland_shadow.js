/** Lecture 14: in flatland the light's map is one row of texels, and one bias is never right. */
import { button, fill, html, number, Sheet, slider } from "./paper.js";
import { dot, minus, plus } from "./vectors.js";

const TEXELS = 18, SAMPLES = 720, GROUND = 12, FOOT = 5, BEHIND = 5.12, TOP = 1.8;
const WALL = [[FOOT, 0], [FOOT, TOP], [BEHIND, TOP], [BEHIND, 0]];
const SCENE = [[0, 0], ...WALL, [GROUND, 0]];  // one line, from left to right
const GRAZING = 1e-2;
const START = [1.6, 4], BIAS = 0.15;
const GOOD = { true: "lit", false: "dark" }, WRONG = { true: "leak", false: "acne" };

/** Eq. (1): a point in the light's frame. The rows of rotation are its x and its z axis. */
export const toLight = (p, position, rotation) =>
  rotation.map((axis) => dot(axis, minus(p, position)));

/** Eq. (2) of a point light, for which w is the distance. */
export const mapPosition = ([qX, qZ], c00, width) => (c00 * qX / -qZ + 1) * width / 2;

/** Eq. (3), its right side: the texel at floor x. */
const storedDistance = (distanceMap, x) =>
  (x >= 0 && x < distanceMap.length ? distanceMap[Math.floor(x)] : Infinity);

/** Eq. (3). */
export const isLit = (distanceMap, x, distance, bias) =>
  distance <= storedDistance(distanceMap, x) + bias;

/** Eq. (4): how fast a line with this normal, in the light's frame, recedes from texel to texel. */
export function distanceSlopes([nX, nZ], [qX, qZ], c00, width) {
  const along = nX * qX / -qZ - nZ;
  const bounded = Math.abs(along) >= GRAZING ? along : along < 0 ? -GRAZING : GRAZING;
  return qZ * nX / bounded * 2 / (c00 * width);
}

/** Eq. (5), without a limit: in flatland a point is at most half a texel from its middle. */
export const slopeScaledBias = (slope, constant, factor) =>
  constant + factor * Math.abs(slope) / 2;

/** A camera in the light's place, which sees all vertices, and its axis in their middle. */
export function pointLight(position, vertices) {
  const angles = vertices.map(([x, y]) => Math.atan2(x - position[0], position[1] - y));
  const [low, high] = [Math.min(...angles), Math.max(...angles)];
  const [sin, cos] = [Math.sin((low + high) / 2), Math.cos((low + high) / 2)];
  return { position, rotation: [[cos, sin], [-sin, cos]],
           c00: 1 / (1.02 * Math.tan((high - low) / 2)) };
}

/** The axial depth at which the ray (u, -1) first meets a line of points in the light's frame. */
export function nearest(u, line) {
  let least = Infinity;
  for (let k = 1; k < line.length; k++) {
    const [[x0, z0], [x1, z1]] = [line[k - 1], line[k]];
    const [from, to] = [x0 + u * z0, x1 + u * z1];
    if (from !== to && from * to <= 0) {
      least = Math.min(least, -(z0 + from / (from - to) * (z1 - z0)));
    }
  }
  return least;
}

/** The place on the map, as a ray: q = distance (u, -1). */
const uOf = (x, c00, width) => (2 * x / width - 1) / c00;

/** The light's picture of a line: in each texel what the ray through its middle meets. */
export function depthMap(line, { position, rotation, c00 }, size) {
  const q = line.map((p) => toLight(p, position, rotation));
  return Array.from({ length: size }, (_, k) => nearest(uOf(k + 0.5, c00, size), q));
}

/** What the map says of points p of the ground, and what is true: the ray past the wall itself. */
export function shadowOf(points, light, distanceMap, constant, factor) {
  const normal = light.rotation.map(([, up]) => up);
  const wall = WALL.map((p) => toLight(p, light.position, light.rotation));
  return points.map((p) => {
    const q = toLight(p, light.position, light.rotation);
    const x = mapPosition(q, light.c00, distanceMap.length);
    const slope = distanceSlopes(normal, q, light.c00, distanceMap.length);
    const bias = slopeScaledBias(slope, constant, factor);
    const lit = isLit(distanceMap, x, -q[1], bias);
    const truth = -q[1] <= nearest(q[0] / -q[1], wall);
    return { p, kind: (lit === truth ? GOOD : WRONG)[lit] };
  });
}

const places = Array.from({ length: SAMPLES }, (_, n) => [(n + 0.5) * GROUND / SAMPLES, 0])
  .filter(([x]) => x < FOOT || x > BEHIND);

/** The point of the world that lies at place x of the map in this distance. */
function worldAt({ position, rotation: [right, back], c00 }, x, distance) {
  const u = uOf(x, c00, TEXELS);
  return plus(position, minus(right.map((t) => u * t), back), distance);
}

/** Eq. (4) of the ground y = 0, without an end, at place x of the map. */
function groundSlope({ position, rotation, c00 }, x) {
  const [normal, u] = [rotation.map(([, up]) => up), uOf(x, c00, TEXELS)];
  const distance = position[1] / (normal[1] - u * normal[0]);
  return distanceSlopes(normal, [u * distance, -distance], c00, TEXELS);
}

/** Neighbours of one kind together, each run from the last sample before it. */
function runs(samples) {
  const found = [];
  samples.forEach((sample, n) => {
    const before = samples[n - 1];
    const isNext = before && sample.p[0] - before.p[0] < 1.5 * GROUND / SAMPLES;
    if (isNext && before.kind === sample.kind) found.at(-1).push(sample);
    else found.push(isNext ? [before, sample] : [sample]);
  });
  return found;
}

export function show(place) {
  let position = START, constant = BIAS, factor = 0;
  const world = new Sheet([0, GROUND, -0.25, 4.25], "A light, a wall and its shadow", draw);
  const answer = html("p", { class: "verdict", role: "status" });
  world.box.classList.add("cut");
  world.handle({ name: "Light", style: "second", step: 0.05, at: () => position,
                 limits: [0.3, GROUND - 0.3, 2.6, 4], moved: (to) => { position = to; } });
  const control = slider({ label: "bias", min: 0, max: 1.5, step: 0.01, value: BIAS,
                           changed: (to) => { constant = to; } });
  control.element.firstChild.classList.add("green");
  const sloped = button("+ slope × ½ texel", () => {
    factor = 1 - factor;
    sloped.setAttribute("aria-pressed", factor === 1);
  });
  sloped.setAttribute("aria-pressed", false);

  function draw() {
    const light = pointLight(position, SCENE);
    const distanceMap = depthMap(SCENE, light, TEXELS);
    const samples = shadowOf(places, light, distanceMap, constant, factor);
    const at = (x, d) => worldAt(light, x, d);
    const bias = (x) => slopeScaledBias(groundSlope(light, x), constant, factor);
    world.draw(
      distanceMap.map((d, k) => [
        world.polygon([at(k, 0), at(k, d), at(k + 1, d), at(k + 1, 0)],
                      `beam ${k % 2 ? "odd" : ""}`),
        world.polygon([at(k, d), at(k, d + bias(k)), at(k + 1, d + bias(k + 1)), at(k + 1, d)],
                      "beam bias")]),
      world.polygon(WALL, "wall"),
      runs(samples).map((run) =>
        world.line(run.map(({ p }) => p), `ground ${run.at(-1).kind}`)),
      world.text([BEHIND, TOP], "wall", "", [6, -4]));
    tell(samples);
  }

  function tell(samples) {
    const share = (kind) => number(
      100 * samples.filter((sample) => sample.kind === kind).length / samples.length, 1);
    answer.innerHTML =
      `<span class="blue">${share("acne")}% of the ground is wrongly dark: acne.</span> ` +
      `<span class="red">${share("leak")}% is wrongly lit: light leaks.</span>`;
  }

  fill(place, draw, "Drag the light. Change the bias.",
    'What a texel’s beam reaches is lit. <b class="green">The bias</b> makes it longer.',
    html("div", { class: "wide" }, world.box),
    html("div", { class: "told" }, control.element, sloped),
    html("div", { class: "told" }, answer));
}
