// What is wider than the page scrolls in its place: by keyboard, too.
for (const place of document.querySelectorAll("pre, div.math, figure, .table-wrapper")) {
  if (place.scrollWidth > place.clientWidth) place.tabIndex = 0;
}

// The list of all pages opens where the reader is.
const here = document.querySelector(".sidebar-scroll .current-page");
if (here) {
  const tree = here.closest(".sidebar-scroll");
  const above = here.getBoundingClientRect().top - tree.getBoundingClientRect().top;
  tree.scrollTo({ top: above - tree.clientHeight / 3, behavior: "instant" });
}

// Browsers start no modules from files on disk: figures keep no room for theirs.
if (location.protocol === "file:") document.documentElement.classList.add("from-disk");
