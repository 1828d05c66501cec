/** Lecture 17: two threads, one pixel, and a reader who says which of them goes on. */
import { button, fill, html, Sheet } from "./paper.js";

const NAMES = ["A", "B"], DEPTHS = [0.25, 0.5];
const SCHEDULES = ["AABB", "ABAB", "ABBA", "BAAB", "BABA", "BBAA"];

/** A z-buffer of one pixel without atomics -> the steps, each with what is there after it. The
 *  first step of a thread reads the depth. Its second writes its own, if less than what it read. */
export function race(face, depth, schedule) {
  const read = face.map(() => null);
  let seen = -1, nearest = Infinity;
  return schedule.map((thread) => {
    if (read[thread] === null) {
      read[thread] = nearest;
      return { thread, kind: "reads", value: nearest, seen, nearest };
    }
    const writes = depth[thread] < read[thread];
    if (writes) [seen, nearest] = [face[thread], depth[thread]];
    return { thread, kind: writes ? "writes" : "leaves", value: depth[thread], seen, nearest };
  });
}

const shown = (depth) => (Number.isFinite(depth) ? depth.toFixed(2) : "∞");

export function show(place) {
  let schedule = [];
  const tried = new Set();
  const sheet = new Sheet([-0.62, 4, -0.06, 3.1],
    "Time goes to the right: the steps of threads A and B, and the pixel after each", draw);
  const answer = html("p", { class: "verdict", role: "status" });
  const found = html("p");
  const chips = SCHEDULES.map((name) => html("span", { class: "chip" }, name));
  const threads = NAMES.map((name, thread) =>
    button(`${name} goes on`, () => schedule.push(thread)));
  const again = button("Again", () => { schedule = []; });

  function draw() {
    const steps = race([0, 1], DEPTHS, schedule);
    const isDone = steps.length === 4;
    const style = (thread) => (thread === 0 ? "first" : "second");
    const box = (x, y, words, kind) => [sheet.rectangle([x, y], 0.94, 0.8, kind),
      ...words.map((word, row) => sheet.text([x + 0.47, y + 0.4], word, "middle",
                                             [0, words.length === 1 ? -5 : 4 - 18 * row]))];
    const stepBox = ({ thread, kind, value }, n) => box(n, 2.2 - thread,
      kind === "leaves" ? ["no write"] : [kind, shown(value)], `cell ${style(thread)}`);
    const pixelBox = ({ seen, nearest }, n) => box(n, 0, seen < 0 ? [shown(nearest)]
      : [NAMES[seen], shown(nearest)], `cell ${seen < 0 ? "" : style(seen)}`);
    const goesOn = (thread) => schedule.filter((other) => other === thread).length < 2;
    sheet.draw(
      NAMES.map((name, thread) => sheet.text([-0.58, 2.6 - thread], name,
                                             `label ${style(thread)}`, [0, -6])),
      sheet.text([-0.58, 0.4], "pixel", "", [0, -5]), sheet.line([[0, 1], [3.94, 1]], "axis"),
      [0, 1, 2, 3].map((n) => box(n, 0, [], "cell later")),
      [0, 1, 2, 3].slice(steps.length).map((n) => [0, 1].filter(goesOn).map((thread) =>
        box(n, 2.2 - thread, [], "cell later"))),
      steps.map((step, n) => [...stepBox(step, n), ...pixelBox(step, n)]));
    threads.forEach((one, thread) => {
      one.disabled = !goesOn(thread);
    });
    if (isDone) tell(steps[3].seen === 0);
    else answer.textContent = steps.length ? "" : "The pixel is empty: depth ∞.";
  }

  function tell(isRight) {
    const name = schedule.map((thread) => NAMES[thread]).join("");
    tried.add(name);
    const chip = chips[SCHEDULES.indexOf(name)];
    chip.classList.add(isRight ? "right" : "wrong");
    chip.textContent = `${name} ${isRight ? "✓" : "✗"}`;
    answer.textContent = isRight ? "Right: A is seen, which is nearer."
      : "Wrong: B is seen, although A is nearer.";
    found.textContent = `${tried.size} of 6 schedules tried` + (tried.size < 6 ? "." :
      ": two go wrong. An atomic minimum is one step, so no other thread can come between.");
  }

  fill(place, draw, "Let the threads go on, in any order.",
    "Each has two steps: it reads the depth, then it writes its own if that is nearer. " +
      '<b class="blue">A</b> brings 0.25, <b class="orange">B</b> 0.50.',
    sheet.box,
    html("div", { class: "told" }, html("div", { class: "row" }, ...threads, again), answer,
      html("p", { class: "chips" }, "The six schedules:", ...chips), found));
}
