/** Starts the figures of a page: <div class="answers" data-figure="NAME"> is filled by NAME.js. */
for (const place of document.querySelectorAll(".answers[data-figure]")) {
  import(`./${place.dataset.figure}.js`).then(({ show }) => show(place));
}
