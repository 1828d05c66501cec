/** Lecture 12 in the plane: an outline loses points, one collapse of an edge after the other. */
import { CIRCLE, clamp, fill, html, number, player, Sheet, slider } from "./paper.js";
import { plus } from "./vectors.js";

/** The outline of the bunny in hundredths, counter-clockwise. */
const BUNNY = await (await fetch(new URL("bunny.json", import.meta.url))).json();
const WIDTH = 2;
const LEAST = 8, LEVEL = 1e-3, LONGEST = 0.14;  // points; the error on an ellipse; its half axis

/** Eqs. (1) and (2) for the line through a and b, times its length: the six numbers of Q. */
export function lineQuadric([ax, ay], [bx, by]) {
  const length = Math.hypot(bx - ax, by - ay);
  const [x, y] = [(by - ay) / length, (ax - bx) / length];
  const d = -(x * ax + y * ay);
  return [x * x, x * y, y * y, x * d, y * d, d * d].map((t) => length * t);
}

/** v Q v with v = (x, y, 1). */
export const quadricError = ([xx, xy, yy, xd, yd, dd], [x, y]) =>
  xx * x * x + 2 * xy * x * y + yy * y * y + 2 * (xd * x + yd * y) + dd;

/** Eq. (5), A x = -b, or null where the least eigenvalue of A is less than 1 % of the greatest. */
export function bestAnywhere([xx, xy, yy, xd, yd]) {
  const { axes: [greatest, least] } = ellipse([xx, xy, yy]);
  if (least <= 0.01 * greatest) return null;
  const det = xx * yy - xy * xy;
  return [(xy * yd - yy * xd) / det, (xy * xd - xx * yd) / det];
}

/** Eq. (6): the best place on the segment from a to b. */
export function bestOnSegment([xx, xy, yy, xd, yd], a, b) {
  const [ex, ey] = [b[0] - a[0], b[1] - a[1]];
  const along = xx * ex * ex + 2 * xy * ex * ey + yy * ey * ey;
  const slope = ex * (xx * a[0] + xy * a[1] + xd) + ey * (xy * a[0] + yy * a[1] + yd);
  const t = along > 1e-6 * (xx + yy) * (ex * ex + ey * ey) ? clamp(-slope / along, 0, 1) : 0.5;
  return [a[0] + t * ex, a[1] + t * ey];
}

/** The eigenvalues of A, the greatest first, and the direction of the least one. */
function ellipse([xx, xy, yy]) {
  const [mean, half] = [(xx + yy) / 2, Math.hypot((xx - yy) / 2, xy)];
  return { axes: [mean + half, mean - half],
           angle: Math.atan2(2 * xy, xx - yy) / 2 + Math.PI / 2 };
}

/** The cheapest edge to collapse: its first point, where the new point goes, and the cost. */
function cheapest(points, quadrics) {
  let best = { cost: Infinity };
  points.forEach((a, i) => {
    const j = (i + 1) % points.length;
    const q = plus(quadrics[i], quadrics[j]);
    const place = bestAnywhere(q) ?? bestOnSegment(q, a, points[j]);
    const cost = quadricError(q, place);
    if (cost < best.cost) best = { i, j, q, place, cost };
  });
  return best;
}

/** How far a collapse's place is from the lines of its quadric: the root of the mean square. */
export const distanceOf = ({ q, cost }) => Math.sqrt(Math.max(cost, 0) / (q[0] + q[2]));

/** All outlines from the whole one down to a few points: {points, quadrics, next}. */
export function simplify(points) {
  const lines = points.map((a, i) => lineQuadric(a, points[(i + 1) % points.length]));
  let quadrics = lines.map((q, i) => plus(q, lines.at(i - 1)));
  const states = [];
  for (;;) {
    const next = cheapest(points, quadrics);
    states.push({ points, quadrics, next });
    if (points.length === LEAST) return states;
    const kept = (list, middle) => list.with(next.i, middle).filter((_, n) => n !== next.j);
    [points, quadrics] = [kept(points, next.place), kept(quadrics, next.q)];
  }
}

export function show(place) {
  const whole = BUNNY.map((point) => point.map((t) => t / 100));
  const states = simplify(whole);
  let count = 40;
  const sheet = new Sheet([-1.6, 1.6, -1.1, 1.1],
    "The outline of a bunny with few points, an ellipse around each", draw);
  const said = html("p");
  const points = slider({ label: "points", min: LEAST, max: whole.length, step: 1, value: count,
                          changed: (to) => { count = to; } });
  const play = player("Play", () => {
    if (count === LEAST) return false;
    count -= 1;
    points.set(count);
    return true;
  }, draw, () => { count = whole.length; });

  /** Where the error of a point's quadric is LEVEL, cut where it is long and thin. */
  function ring(quadric, centre) {
    const { axes, angle } = ellipse(quadric);
    const [short, long] = axes.map((value) =>
      Math.min(LONGEST, Math.sqrt(LEVEL / Math.max(value, 0))));
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    return sheet.polygon(CIRCLE.map(([x, y]) => plus(centre, [
      long * x * cos - short * y * sin, long * x * sin + short * y * cos])), "ring");
  }

  function draw() {
    const { points: outline, quadrics, next } = states[whole.length - count];
    sheet.draw(
      sheet.polygon(whole, "goal"),
      quadrics.map((quadric, n) => ring(quadric, outline[n])),
      sheet.polygon(outline, "outline found"),
      sheet.line([outline[next.i], outline[next.j]], "edge thick"),
      outline.map((point) => sheet.dot(point, 2.5, "sample point")));
    said.innerHTML = `The <b class="red">red</b> edge is the cheapest. The point in its place is ` +
      `<b>${number(100 * distanceOf(next) / WIDTH, 2)} %</b> of the bunny's width away from the ` +
      "lines that it stands for.";
  }

  fill(place, draw, "Take points away.", 'Along its <b class="green">green</b> ellipse a point ' +
      "would cost the same everywhere: it may slide along a straight part, but cannot leave a " +
      "bend.",
    sheet.box,
    html("div", { class: "told" }, points.element, said,
      html("div", { class: "row" }, play.element)));
}
