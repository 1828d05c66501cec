/** Lecture 06b in flatland: a mirror ball in a room of four walls, seen from below. */
import { fill, html, number, say, Sheet, sway } from "./paper.js";
import { dot, plus } from "./vectors.js";

const RADIUS = 0.6, WALL = 1.25, TEXELS = 4, PIXELS = 60;
const START = 0.32, SWING = 0.08, LOW = -1.78, GRIP = -1.93, BEHIND = "−z";
const FACES = [                             // of the cube in the plane y = 0, as (x, z)
  { name: "+x", right: [0, -1], out: [1, 0], style: "second" },
  { name: "−x", right: [0, 1], out: [-1, 0], style: "first" },
  { name: "+z", right: [1, 0], out: [0, 1], style: "descent" },
  { name: BEHIND, right: [-1, 0], out: [0, -1], style: "edge" }];

/** The way on, d - 2 (d . n) n. */
export const reflected = (d, n) => plus(d, n, -2 * dot(d, n));

/** Eqs. (10) and (11) for a direction (x, z): the number of its face in FACES, and u. */
export function onFace(d) {
  const along = FACES.map(({ out }) => dot(out, d)), m = Math.max(...along);
  const face = along.indexOf(m);
  return [face, (1 + dot(FACES[face].right, d) / m) / 2];
}

/** The ball's normal (x, z) where the ray meets it that comes up at x. */
const normalAt = (x) => [x / RADIUS, Math.sqrt(Math.max(0, 1 - (x / RADIUS) ** 2))];

const wayAt = (x) => reflected([0, -1], normalAt(x));

/** How much of the ball's picture shows the wall behind: the way turns by twice the normal's angle,
 *  by 135 degrees where the wall begins. */
export const SHARE_BEHIND = 1 - Math.sin(67.5 * Math.PI / 180);

/** (x, z) on the sheet: what is behind the mirror is above. */
const onSheet = ([x, z]) => [x, -z];

export function show(place) {
  let x = START;
  const sheet = new Sheet([-1.5, 1.5, -2.05, 1.5],
    "A mirror ball between four walls, a ray that it reflects, and its picture", draw);
  const answer = html("p", { class: "verdict", role: "status" });
  const rule = html("p");
  sheet.handle({ name: "Pixel of the picture", mark: "↔", style: "point", step: 0.01,
                 limits: [0.01 - RADIUS, RADIUS - 0.01, GRIP, GRIP], at: () => [x, GRIP],
                 moved: ([to]) => { x = to; } });

  /** The texel of a face that holds u, on the wall. */
  function texel(face, n) {
    const { right, out, style } = FACES[face];
    const end = (u) => onSheet(plus(out, right, 2 * u - 1).map((t) => WALL * t));
    return sheet.line([end(n / TEXELS), end((n + 1) / TEXELS)], `${style} wall-map`, faint(n));
  }

  /** Beyond the arrow, but where the eye's ray is near: across this. */
  const besides = ([right, down]) => (Math.abs(right) > 0.3 ? [14 * right, -14 * down - 5]
    : [right < 0 ? 18 : -18, 2]);

  const faint = (n) => `stroke-opacity: ${n % 2 ? 0.4 : 1}; fill-opacity: ${n % 2 ? 0.4 : 1}`;

  function draw() {
    const n = normalAt(x), r = wayAt(x), [face, u] = onFace(r), { name, style } = FACES[face];
    const hit = onSheet(n.map((t) => RADIUS * t));
    const far = onSheet(r.map((t) => WALL * t / Math.max(...r.map(Math.abs))));
    const wide = 2 * RADIUS / PIXELS;
    sheet.draw(
      FACES.flatMap((_, k) => Array.from({ length: TEXELS }, (__, m) => texel(k, m))),
      FACES.map((one) => sheet.text(onSheet(plus(one.right, one.out, WALL)), one.name,
                                    `label middle ${one.style}`, [-22 * one.out[0],
                                                                  20 * one.out[1] - 5])),
      Array.from({ length: PIXELS }, (_, k) => {
        const left = k * wide - RADIUS, [seen, at] = onFace(wayAt(left + wide / 2));
        return sheet.rectangle([left, LOW], wide, 0.28,
                               `${FACES[seen].style} texel`, faint(Math.floor(TEXELS * at)));
      }),
      sheet.dot([0, 0], RADIUS * sheet.scale, "ball"),
      sheet.line([[x, GRIP], hit], "goal"),
      sheet.arrow(hit, plus(hit, onSheet(n), 0.3), "pull point"),
      sheet.line([[0, 0], far], "ray"),
      sheet.arrow(hit, plus(hit, onSheet(r), 0.62), `pull ${style}`),
      sheet.text(plus(hit, onSheet(n), 0.3), "n", "label middle", besides(n)),
      sheet.text(plus(hit, onSheet(r), 0.62), "r", `label middle ${style}`,
                 [r[0] < 0 ? -11 : 11, 2]),
      sheet.dot(far, 6, "sample point"));
    rule.innerHTML = `<i>r</i> = (${number(r[0], 2)}, ${number(r[1], 2)}): the largest <i>m</i> ` +
      `is that of ${name}, and <i>u</i> = <b>${number(u, 2)}</b>.`;
    say(answer, name !== BEHIND ? "This pixel does not see the wall behind the ball."
      : `The wall behind: ${number(100 * SHARE_BEHIND, 1)} % of the ball’s picture, and 25 % ` +
        "of all directions.");
  }

  fill(place, draw, "Which share of the ball’s picture shows the wall behind it, the red one?",
    "Guess, then drag the pixel. The look-up knows only the direction <i>r</i>, so it begins in " +
      "the middle.",
    sheet.box, html("div", { class: "told" }, rule, answer));
  sway(place, (t) => { x = START + SWING * t; }, draw);
}
