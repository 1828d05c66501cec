// Starts the players of a page, each when it comes into view. Without scripts, stills stand there.
const PLAYERS = {
  "figure.animation": "./animation.js",
  "figure.before-after": "./before_after.js",
};

for (const [selector, module] of Object.entries(PLAYERS)) {
  const seen = new IntersectionObserver(async (entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      seen.unobserve(target);
      (await import(module)).show(target);
    }
  }, { rootMargin: "200px" });
  document.querySelectorAll(selector).forEach((figure) => seen.observe(figure));
}
