/** Lecture 13: a bunny is the sum of its waves, and a few slow ones are most of its shape. */
import { canvasOf, paint, silhouette } from "./facets.js";
import { clamp, counted, fill, html, player, say, Sheet, soon } from "./paper.js";
import { between } from "./vectors.js";

const FILE = new URL("../../waves/bunny.bin", import.meta.url);
const WHOLE = 2 ** 15;                    // a wave of length 1 in units of the file
const CLAY = [217, 199, 174], WHITE = [245, 245, 245], RED = [202, 0, 32], BLUE = [5, 90, 170];
const START = 0.5, STEPS = 48, FRAMES = 400;
const LEFT = 0.5, RIGHT = 9.5, FLOOR = 0.5, TOP = 1.8;  // of the spectrum, on its sheet
const LEAST = -2.2, MOST = 1.4;           // its powers of ten
const SHAPES = [[1, "a point"], [2, "a line"], [3, "a flat sheet"], [15, "a lump with two horns"],
                [60, "a body and ears"], [Infinity, "a body with feet, a tail and a mouth"]];

/** The file -> count (V), faces [a, b, c], and in a row the shares (V, 3) and the waves (V, V). */
export function unpacked(buffer) {
  const [count, faceCount] = new Uint16Array(buffer, 0, 2);
  const afterFaces = 4 + 6 * faceCount, afterShares = afterFaces + 12 * count;
  const corners = new Uint16Array(buffer, 4, 3 * faceCount);
  return { count, faces: Array.from({ length: faceCount }, (_, n) =>
             [...corners.subarray(3 * n, 3 * n + 3)]),
           shares: new Float32Array(buffer, afterFaces, 3 * count),
           waves: Float32Array.from(new Int16Array(buffer, afterShares), (t) => t / WHOLE) };
}

/** The sum of the first k waves: x, y, z of each vertex, in a row. */
export function sumOfWaves({ count, waves, shares }, k) {
  const vertices = new Float64Array(3 * count);
  for (let wave = 0; wave < k; wave++) {
    for (let i = 0; i < count; i++) {
      const height = waves[wave * count + i];
      for (let axis = 0; axis < 3; axis++) {
        vertices[3 * i + axis] += height * shares[3 * wave + axis];
      }
    }
  }
  return vertices;
}

/** The length of each wave's share. */
export const strengths = ({ count, shares }) =>
  Array.from({ length: count }, (_, k) => Math.hypot(...shares.slice(3 * k, 3 * k + 3)));

/** How far are the vertices from their places after k waves? -> the root of the mean square, each
 *  vertex with its mass. The waves have length 1 and are at right angles: the rest adds up. */
export function distanceLeft(strength, mass, k) {
  let rest = 0;
  for (let wave = k; wave < strength.length; wave++) rest += strength[wave] ** 2;
  return Math.sqrt(rest / mass);
}

const placeOf = (along) => [LEFT + along * (RIGHT - LEFT), FLOOR];

export function show(place) {
  let bunny = null, along = START;        // along: where on the spectrum's axis, from 0 to 1
  const waveCount = () => Math.round(bunny.count ** along);
  const box = [-1.03, 1.06, -0.88, 0.86];
  const sum = new Sheet(box, "A bunny as the sum of its first waves", draw);
  const one = new Sheet(box, "One wave on the bunny: red below zero, blue above", draw);
  const spectrum = new Sheet([0, 10, 0, TOP], "How much of each wave is in the bunny", draw);
  const [sumCanvas, oneCanvas] = [sum, one].map(canvasOf);
  const answer = html("p", { class: "verdict", role: "status" });
  const said = html("p");
  spectrum.handle({
    name: "Number of waves", style: "second", at: () => placeOf(along),
    said: () => (bunny ? counted(waveCount(), "wave") : "no waves yet"),
    from: [LEFT, FLOOR], step: (RIGHT - LEFT) / STEPS, limits: [LEFT, RIGHT, FLOOR, FLOOR],
    moved: ([x]) => {
      play.stop();
      along = (x - LEFT) / (RIGHT - LEFT);
    } });
  const play = player("Play", () => {
    if (along === 1) return false;
    along = Math.min(1, along + 1 / FRAMES);
    return true;
  }, draw, () => { along = 0; });

  function draw() {
    if (!bunny) return;
    const k = waveCount();
    const context = sumCanvas();
    context.fillStyle = "rgb(128 128 128 / 25%)";
    context.fill(bunny.outline);
    const vertices = sumOfWaves(bunny, k);
    paint(context, vertices, bunny.faces, () => CLAY);
    paint(oneCanvas(), bunny.vertices, bunny.faces, coloursOf(k));
    const dots = k > 2 ? 0 : bunny.count; // all vertices are on a line: the faces have no area
    sum.draw(
      Array.from({ length: dots }, (_, i) =>
        sum.dot(vertices.subarray(3 * i, 3 * i + 2), 3, "sample second")),
      sum.text([0.55, 0.7], k === 1 ? "wave 1" : `waves 1 to ${k}`, "label second middle"));
    one.draw(one.text([0.55, 0.7], `wave ${k}`, "label middle"));
    drawSpectrum(k);
    tell(k);
  }

  /** -> the colour of a face, of the mean of its corners: red below zero, blue above. */
  function coloursOf(k) {
    const wave = bunny.waves.subarray((k - 1) * bunny.count, k * bunny.count);
    const heightOf = ([a, b, c]) => wave[a] + wave[b] + wave[c];
    const largest = Math.max(...bunny.faces.map((face) => Math.abs(heightOf(face))));
    return (face) => {
      const t = clamp(1.4 * heightOf(face) / largest, -1, 1);
      return between(WHITE, t < 0 ? RED : BLUE, Math.abs(t));
    };
  }

  function drawSpectrum(k) {
    const x = (wave) => placeOf(Math.log(wave) / Math.log(bunny.count))[0];
    const comb = (from, to) => bunny.strength.slice(from, to).flatMap((strength, n) => {
      const at = x(from + n + 1), power = clamp(Math.log10(strength), LEAST, MOST);
      const height = FLOOR + (power - LEAST) / (MOST - LEAST) * (TOP - FLOOR - 0.1);
      return [[at, FLOOR], [at, height], [at, FLOOR]];
    });
    spectrum.draw(
      spectrum.line([[LEFT, FLOOR], [RIGHT, FLOOR]], "axis"),
      spectrum.line(comb(k, bunny.count), "axis"), spectrum.line(comb(0, k), "outline second"),
      spectrum.text([RIGHT, TOP], "share of each wave (log)", "end", [0, -16]),
      [1, 10, 100].map((wave) => spectrum.text([x(wave), 0], String(wave), "middle", [0, 2])));
  }

  function tell(k) {
    const shape = k === bunny.count ? "the bunny itself" : SHAPES.find(([most]) => k <= most)[1];
    const left = 100 * distanceLeft(bunny.strength, 3 * bunny.faces.length, k) / bunny.height;
    said.innerHTML = `<b class="orange">${k} of ${bunny.count} waves</b>: the vertices are ` +
      `${left.toFixed(1)} % of the bunny's height away from their places.`;
    say(answer, `The sum is ${shape}.`);
  }

  async function load() {
    const answered = await fetch(FILE).catch(() => null);
    if (!answered?.ok) {
      answer.textContent = "The bunny could not be loaded.";
      return;
    }
    bunny = unpacked(await answered.arrayBuffer());
    const vertices = sumOfWaves(bunny, bunny.count), y = vertices.filter((_, n) => n % 3 === 1);
    Object.assign(bunny, { vertices, strength: strengths(bunny),
      height: Math.max(...y) - Math.min(...y), outline: silhouette(vertices, bunny.faces) });
    soon(draw);
  }

  fill(place, draw, "Drag the point along the spectrum, or press Play.",
    'The waves up to it, in <b class="orange">orange</b>, are added up. ' +
      "The last of them is painted on the bunny.",
    sum.box, one.box, spectrum.box, html("div", { class: "told" }, answer, play.element, said));
  const near = new IntersectionObserver(([{ isIntersecting }]) => {
    if (!isIntersecting) return;
    near.disconnect();
    load();
  }, { rootMargin: "100%" });
  near.observe(place);
}
