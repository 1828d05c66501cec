/** Lecture 16: which numbers of the grid does one pixel of a picture pull, and by what? */
import { EYE, isOutside, onStrip, PIXELS, pull, render, STRIP, WIDTH } from "./carving.js";
import { fill, html, playAndReset, say, Sheet } from "./paper.js";
import { marchingTriangles, POINTS } from "./sign_grid.js";
import { between, dot, minus, plus } from "./vectors.js";

const RATE = 0.005, MOMENTUM = 0.9, STEPS = 300;
const TRUTH = [[-0.72, 0.45, 0.4], [0.72, 0.45, 0.4]];         // two discs: x, y, radius
const FOUND = [[-0.77, 0.36, 0.37], [0.7, 0.56, 0.42]];        // at the start, with a skin
const SKIN = [0.7, 0.1, 0.44];                                 // half its width and height, y
const ALBEDO = [0.85, 0.42, 0.12], SUN = [-0.6, -0.8], SKY = 0.3;
const HEIGHT = 0.11, FIRST = 9;                                // of a drawn pixel; who is asked

const discs = ([x, y], all) =>
  Math.min(...all.map(([cX, cY, radius]) => Math.hypot(x - cX, y - cY) - radius));
const skin = ([x, y], [width, height, cY]) =>
  Math.max(Math.abs(x) - width, Math.abs(y - cY) - height);

/** A pixel's linear colour: paint in the light of sun and sky, in front of white. */
function colourOf(k, { coverage, hits }, { vertices, segments }) {
  const hit = hits[k] ?? hits[k - 1] ?? hits[k + 1];
  if (!hit) return [1, 1, 1];
  const [p, q] = segments[hit.segment].map((n) => vertices[n].p);
  const [x, y] = minus(q, p), facing = dot([y, -x], SUN) / Math.hypot(x, y);
  const light = SKY + (1 - SKY) * Math.max(0, facing);
  return ALBEDO.map((albedo) => 1 + coverage[k] * (albedo * light - 1));
}

/** By what does a pixel pull, and why? */
function verdict(k, target, { coverage, hits, outlines }) {
  const isMoved = outlines.some(({ pixel }) => pixel === k);
  if (hits[k] && isOutside(target)[k]) {
    return `Carving${isMoved ? " and coverage" : ""}: the target is empty here, so the surface ` +
      "is pushed back.";
  }
  if (isMoved) {
    const more = target[k] - coverage[k];
    return Math.abs(more) < 0.01 ? "Coverage: an outline, and it is at its place."
      : `Coverage: at this outline too ${more > 0 ? "little" : "much"} is covered, so the ` +
        `crossing moves ${more > 0 ? "out" : "in"}.`;
  }
  if (hits[k]) {
    return target[k] === 1
      ? "Only colour: the face may slide along the ray, and nothing says where it is."
      : "Nothing yet: near the target's outline only a found outline pulls.";
  }
  return target[k] > 0 ? "Nothing: no face is here that could be moved."
    : "Nothing: both pictures are empty here.";
}

const fromEye = (p, times) => between(EYE, p, times);

/** A drawing in which a pointer means the ray through it. */
class Flatland extends Sheet {
  pointOf(event) {
    const p = super.pointOf(event);
    return [fromEye(p, (STRIP - EYE[1]) / Math.max(p[1] - EYE[1], 0.3))[0], STRIP];
  }
}

export function show(place) {
  const truth = marchingTriangles(POINTS.map((p) => discs(p, TRUTH)));
  const photograph = render(truth.vertices, truth.segments);
  const target = photograph.coverage, all = [...target.keys()];
  const centre = (k) => EYE[0] + (k + 0.5 - PIXELS / 2) * WIDTH;
  let pixel, chosen, distance, velocity, step; // pixel: below the mouse, too
  const sheet = new Flatland([-1.31, 1.31, -1.38, 1.02],
    "A camera's rays to a surface in which a skin joins two blobs", draw);
  const said = html("p"), answer = html("p", { class: "verdict" });
  const ended = html("p", { role: "status" });
  begin();
  sheet.probe({
    name: "Pixel", step: WIDTH, from: [centre(0), STRIP], at: () => [centre(chosen), STRIP],
    said: () => `${said.textContent} ${answer.textContent}`,
    limits: [centre(0), centre(PIXELS - 1), STRIP, STRIP],
    moved: (to, isChosen) => {
      pixel = Math.round(onStrip(to) - 0.5);
      if (isChosen) chosen = pixel;
    } });
  const buttons = playAndReset(() => {
    if (step === STEPS) return false;
    step += 1;
    const gradient = pull(all, target, distance);
    velocity = plus(gradient, velocity, MOMENTUM);
    distance = plus(distance, velocity, -RATE);
    return true;
  }, begin, draw);

  function begin() {
    distance = POINTS.map((p) => Math.min(discs(p, FOUND), skin(p, SKIN)));
    [velocity, step] = [distance.map(() => 0), 0];
    pixel = chosen = FIRST;
  }

  function row(y, picture, surface) {
    return all.map((k) => sheet.rectangle(
      [centre(k) - WIDTH / 2, y], WIDTH, HEIGHT, "pixel",
      `fill: color(srgb-linear ${colourOf(k, picture, surface).join(" ")})`));
  }

  /** The truth, the grid, what is found, and the camera with its pictures. */
  function scene(surface, picture) {
    const { vertices, segments } = surface;
    return [
      [-1, 1].map((side) => sheet.line([EYE, [side * PIXELS * WIDTH / 2, STRIP]], "wire")),
      sheet.dot(EYE, 6, "sample point"), sheet.text(EYE, "camera", "", [12, -4]),
      row(STRIP, photograph, truth), sheet.text([-1.3, STRIP + 0.02], "target"),
      row(STRIP - HEIGHT, picture, surface), sheet.text([-1.3, STRIP - 0.09], "found"),
      TRUTH.map(([x, y, radius]) => sheet.dot([x, y], radius * sheet.scale, "goal")),
      sheet.text([TRUTH[0][0], 0.88], "truth", "middle"),
      POINTS.map((p, n) => (p[1] < 0 || Math.abs(p[0]) > sheet.x1 ? []
        : sheet.dot(p, distance[n] < 0 ? 3 : 1.6, `sample ${distance[n] < 0 ? "first" : ""}`))),
      segments.map((ends) => sheet.line(ends.map((n) => vertices[n].p), "curve first"))];
  }

  /** Discs on the grid's points that the pixel pulls: "+" where the distance is to grow. */
  function pulled() {
    const gradient = pull([pixel], target, distance), reach = 3 / sheet.scale;
    const most = Math.max(...gradient.map(Math.abs), 1e-6);
    return POINTS.map(([x, y], n) => {
      const share = Math.abs(gradient[n]) / most, grows = gradient[n] < 0;
      if (share < 1e-3) return [];
      return [sheet.dot([x, y], 4 + 4 * Math.sqrt(share), grows ? "descent" : "extra"),
              sheet.line([[x - reach, y], [x + reach, y]], "sign"),
              grows ? sheet.line([[x, y - reach], [x, y + reach]], "sign") : []];
    }).flat();
  }

  /** A point of the surface, and an arrow along which it goes. */
  function moved(point, way, length, style) {
    const tip = plus(point, way, length / Math.hypot(...way));
    return [...sheet.arrow(point, tip, style), sheet.dot(point, 5, "crossing")];
  }

  /** What the pixel asks of the surface: crossings move, its face goes back, or it may slide. */
  function asked({ vertices, segments }, { coverage, hits, outlines }) {
    const hit = hits[pixel], crossings = outlines.filter((outline) => outline.pixel === pixel);
    const more = target[pixel] - coverage[pixel];
    const moves = crossings.flatMap(({ vertex }) => {
      const { p, a } = vertices[vertex];
      return moved(p, minus(p, POINTS[a]), 0.3 * more, more > 0 ? "extra" : "descent");
    });
    if (!hit) return moves;
    const [p, q] = segments[hit.segment].map((n) => vertices[n].p);
    const along = minus(q, p), reach = 0.1 / Math.hypot(...along);
    if (isOutside(target)[pixel]) {
      return [...moves, ...moved(hit.at, [-along[1], along[0]], 0.25, "descent")];
    }
    return crossings.length || target[pixel] < 1 ? moves
      : [0.84, 0.92, 1, 1.08, 1.16].map((times) => {
        const middle = fromEye(hit.at, times);
        return sheet.line([plus(middle, along, -reach), plus(middle, along, reach)], "slid");
      });
  }

  function draw() {
    const surface = marchingTriangles(distance);
    const picture = render(surface.vertices, surface.segments);
    const far = Math.min(2.08, sheet.x1 / Math.abs(centre(pixel))); // in the sheet
    tell(picture);
    sheet.draw(
      scene(surface, picture),
      sheet.line([EYE, picture.hits[pixel]?.at ?? fromEye([centre(pixel), STRIP], far)], "ray"),
      asked(surface, picture), pulled(),
      sheet.rectangle([centre(pixel) - WIDTH / 2, STRIP - HEIGHT], WIDTH, 2 * HEIGHT, "chosen"));
  }

  function tell(picture) {
    const percent = (share) => `<b>${Math.round(100 * share)}\u00a0%</b>`;
    said.innerHTML = `Pixel ${pixel + 1} is covered ${percent(target[pixel])} in the target, ` +
      `${percent(picture.coverage[pixel])} in what is found.`;
    answer.textContent = verdict(pixel, target, picture);
    say(ended, step < STEPS ? ""
      : "The coverage is right everywhere. The depth is not: one camera cannot tell.");
  }

  fill(place, draw, "What does a pixel pull on? Drag along the row, then press Play.",
    'At a <b class="green">green +</b> it raises the grid\'s distance: ' +
      'the <b class="blue">found surface</b> retreats. ' +
      'At an <b class="orange">orange −</b> it lowers it: the surface advances.',
    sheet.box,
    html("div", { class: "told" }, said, answer,
      html("div", { class: "row" }, ...buttons), ended));
}
