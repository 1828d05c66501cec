// Two pictures of one size, the second laid over the first up to a line that the reader moves.
//
//   <figure class="before-after"><img data-label="Before"><img data-label="After"></figure>
//
// Without scripts they stand one above the other.
import { make } from "./make.js";

export function show(figure) {
  const [before, after] = figure.querySelectorAll("img");
  const pair = make("div", { className: "pair" });
  const slider = make("input", { type: "range", step: "any", value: 50 });
  slider.ariaLabel = `From ${before.dataset.label} to ${after.dataset.label}`;
  figure.prepend(pair);
  pair.append(named(before), named(after), slider);

  let start;
  const move = (share = slider.valueAsNumber) => {
    slider.value = share;
    pair.style.setProperty("--line", `${slider.value}%`);
    slider.ariaValueText = `${Math.round(slider.value)} % ${before.dataset.label}`;
  };
  const follow = ({ clientX }) => {
    const { left, width } = pair.getBoundingClientRect();
    move(100 * (clientX - left) / width);
  };
  slider.addEventListener("input", () => move());
  pair.addEventListener("pointerdown", ({ pointerId }) => {
    pair.setPointerCapture(pointerId);
    start = slider.valueAsNumber;
  });
  pair.addEventListener("pointermove", (event) => event.buttons & 1 && follow(event));
  pair.addEventListener("pointercancel", () => move(start)); // the finger scrolls the page
  pair.addEventListener("click", (event) => {
    follow(event);
    slider.focus({ preventScroll: true });
  });
  figure.classList.add("ready");
  move();
}

function named(picture) {
  const place = make("div", {});
  place.append(picture, make("span", { textContent: picture.dataset.label }));
  return place;
}
