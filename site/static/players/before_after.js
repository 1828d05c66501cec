// Two pictures of one size, the second laid over the first up to a line that the reader moves.
//
//   <figure class="before-after"><img data-label="Before"><img data-label="After"></figure>
//
// Without scripts they stand one above the other.

export function show(figure) {
  const [before, after] = figure.querySelectorAll("img");
  const pair = document.createElement("div");
  pair.className = "pair";
  figure.prepend(pair);
  pair.append(named(before), named(after));

  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: 0, max: 100, step: 0.5, value: 50 });
  slider.setAttribute("aria-label", `From ${before.dataset.label} to ${after.dataset.label}`);
  const move = () => {
    pair.style.setProperty("--line", `${slider.value}%`);
    const share = Math.round(slider.valueAsNumber);
    slider.setAttribute("aria-valuetext", `${share} % ${before.dataset.label}`);
  };
  slider.addEventListener("input", move);
  pair.append(slider);
  figure.classList.add("ready");
  move();
}

function named(picture) {
  const place = document.createElement("div");
  const name = document.createElement("span");
  name.textContent = picture.dataset.label;
  place.append(picture, name);
  return place;
}
