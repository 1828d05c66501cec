// What is wider than the page scrolls in its place: by keyboard, too.
addEventListener("DOMContentLoaded", () => {
  for (const place of document.querySelectorAll("pre, div.math, figure, .table-wrapper")) {
    if (place.scrollWidth > place.clientWidth) place.tabIndex = 0;
  }
});

// The list of all pages opens where the reader is.
addEventListener("DOMContentLoaded", () => {
  const tree = document.querySelector(".sidebar-scroll");
  const here = tree?.querySelector(".current-page");
  if (!here) return;
  const above = here.getBoundingClientRect().top - tree.getBoundingClientRect().top;
  tree.scrollTo({ top: above - tree.clientHeight / 3, behavior: "instant" });
});

// Browsers start no modules from files on disk: figures keep no room for theirs.
if (location.protocol === "file:") document.documentElement.classList.add("from-disk");
