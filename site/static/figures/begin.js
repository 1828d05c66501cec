/** Starts the figures of a page: <div class="answers" data-figure="NAME"> is filled by NAME.js. */
for (const place of document.querySelectorAll(".answers[data-figure]")) {
  import(`./${place.dataset.figure}.js`).then(({ show }) => show(place));
  sayWhatIsDone(place);
}

/** Screen readers say a figure's answer when somebody acts, not when the mouse only passes. */
function sayWhatIsDone(place) {
  const say = (live) => place.querySelectorAll("[role=status]").forEach((answer) => {
    answer.setAttribute("aria-live", live);
  });
  place.addEventListener("pointermove", (event) => event.buttons || say("off"), true);
  for (const act of ["pointerdown", "keydown", "input"]) {
    place.addEventListener(act, () => say("polite"), true);
  }
}
