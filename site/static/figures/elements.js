/** What stands in a figure beside its drawing: elements, numbers, sliders, buttons. */

const SVG = "http://www.w3.org/2000/svg";

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
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

export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** The centre of pixel n of a picture, rows from below. */
export const centreOf = (n, width) => [n % width + 0.5, Math.floor(n / width) + 0.5];

/** Says a sentence once: what is written again, a screen reader says again. */
export function say(answer, sentence) {
  if (answer.textContent !== sentence) answer.textContent = sentence;
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

/** -> a function that has draw() called in the next animation frame: once, however often asked. */
export function eachFrame(draw) {
  let asked = 0;
  return () => {
    asked ||= requestAnimationFrame(() => {
      asked = 0;
      draw();
    });
  };
}

/** A button that plays: step(), which draws, is called in each animation frame until it returns
 *  false, the button is pressed again, or nobody sees it. -> element, stop() */
export function player(label, step) {
  let frame = 0;
  const element = button(label, () => (frame ? stop() : go()));
  const stop = () => {
    cancelAnimationFrame(frame);
    frame = 0;
    element.textContent = label;
  };
  const go = () => {
    element.textContent = "Pause";
    frame = requestAnimationFrame(() => (step() === false ? stop() : go()));
  };
  new IntersectionObserver(([{ isIntersecting }]) => isIntersecting || stop()).observe(element);
  return { element, stop };
}

/** Play calls step(), as player says. Reset stops it, and calls begin() and draw(). -> both. */
export function playAndReset(step, begin, draw) {
  const play = player("Play", step);
  return [play.element, button("Reset", () => {
    play.stop();
    begin();
    draw();
  })];
}

export function button(label, pressed) {
  const element = html("button", { type: "button" }, label);
  element.addEventListener("click", pressed);
  return element;
}
