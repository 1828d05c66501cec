/** What stands in a figure beside its drawing: elements, numbers, sliders, buttons. */

const SVG = "http://www.w3.org/2000/svg";
const SWAY = 4800;                        // ms: what moves for longer needs a button to stop it

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

export const html = (name, attributes = {}, ...children) =>
  filled(document.createElement(name), attributes, children);

export const svg = (name, attributes = {}, ...children) =>
  filled(document.createElementNS(SVG, name), attributes, children);

/** -1.5 -> "−1.5": at most so many decimals, without zeros at the end. */
export function number(x, decimals = 3) {
  if (!Number.isFinite(x)) return "–";
  const rounded = Number(x.toFixed(decimals));
  return `${rounded < 0 ? "−" : ""}${Math.abs(rounded)}`;
}

/** 1, "shade" -> "1 shade"; 2, "shade" -> "2 shades". */
export const counted = (count, noun) =>
  `${count.toLocaleString("en")} ${noun}${count === 1 ? "" : "s"}`;

export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** The centre of pixel n of a picture, rows from below. */
export const centreOf = (n, width) => [n % width + 0.5, Math.floor(n / width) + 0.5];

/** A polygon that looks like the unit circle. */
export const CIRCLE = Array.from({ length: 60 }, (_, n) =>
  [Math.cos(n * Math.PI / 30), Math.sin(n * Math.PI / 30)]);

export const centres = (width, height) =>
  Array.from({ length: width * height }, (_, n) => centreOf(n, width));

/** Says a sentence once: what is written again, a screen reader says again. */
export function say(answer, sentence) {
  if (answer.textContent !== sentence) answer.textContent = sentence;
}

/** Fills a figure's place: what there is to do and to know, then its parts. What their sliders and
 *  buttons change is drawn. */
export function fill(place, draw, todo, hint, ...parts) {
  const task = html("p", { class: "task" });
  task.innerHTML = `${todo} <span>${hint}</span>`;
  const pane = html("div", { class: "pane" }, task, ...parts);
  for (const act of ["input", "click"]) pane.addEventListener(act, () => soon(draw));
  place.append(pane);
  draw();
}

/** A slider with its label and its value. changed(value) is called when it moves. -> set(value) */
export function slider({ label, min, max, step, value, unit = "", changed }) {
  const said = html("output");
  const input = html("input", { type: "range", min, max, step });
  const set = (to) => {
    input.value = to;
    said.textContent = `${number(input.valueAsNumber)}${unit}`;
  };
  input.addEventListener("input", () => {
    set(input.value);
    changed(input.valueAsNumber);
  });
  set(value);
  return { set, element: html("label", { class: "slider" }, html("span", {}, label), input, said) };
}

const asked = new Set();

/** draw() is called in the next animation frame: once, however often asked. */
export function soon(draw) {
  if (asked.has(draw)) return;
  asked.add(draw);
  requestAnimationFrame(() => {
    asked.delete(draw);
    draw();
  });
}

/** A button that plays: step() and draw() are called in each animation frame until step() returns
 *  false, the button is pressed again, or nobody sees it. Where nothing is left to play, begin() is
 *  called first. -> element, stop() */
export function player(label, step, draw, begin = () => {}) {
  let frame = 0;
  const element = button(label, () => {
    if (frame) return stop();
    if (step() === false) begin();
    return go();
  });
  const stop = () => {
    cancelAnimationFrame(frame);
    frame = 0;
    element.textContent = label;
  };
  const go = () => {
    element.textContent = "Pause";
    frame = requestAnimationFrame(() => {
      if (step() === false) stop();
      else go();
      draw();
    });
  };
  new IntersectionObserver(([{ isIntersecting }]) => isIntersecting || stop()).observe(element);
  return { element, stop };
}

/** Play is a player. Reset stops it, and calls begin(). -> both. */
export function playAndReset(step, begin, draw) {
  const play = player("Play", step, draw, begin);
  return [play.element, button("Reset", () => {
    play.stop();
    begin();
  })];
}

/** A figure that nobody has touched yet sways a little when it comes into sight: move(t) and draw()
 *  are called, t between -1 and 1, 0 at the end. Not where the reader asked for rest. */
export function sway(place, move, draw) {
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  let frame = 0, begun = 0;
  const step = (now) => {
    begun ||= now;
    const t = Math.min((now - begun) / SWAY, 1);
    move(Math.sin(4 * Math.PI * t));
    draw();
    frame = t < 1 ? requestAnimationFrame(step) : 0;
  };
  const seen = new IntersectionObserver(([{ isIntersecting }]) => {
    cancelAnimationFrame(frame);
    if (isIntersecting) frame = requestAnimationFrame(step);
  });
  const rest = () => {
    seen.disconnect();
    cancelAnimationFrame(frame);
  };
  place.querySelectorAll("[role=status]").forEach((answer) => { answer.ariaLive = "off"; });
  for (const act of ["pointerdown", "keydown", "focusin"]) place.addEventListener(act, rest);
  seen.observe(place);
}

export function button(label, pressed) {
  const element = html("button", { type: "button" }, label);
  element.addEventListener("click", pressed);
  return element;
}
