// Starts the films of a page, each when it comes into view. Without scripts, stills stand there.
const seen = new IntersectionObserver(async (entries) => {
  for (const { isIntersecting, target } of entries) {
    if (!isIntersecting) continue;
    seen.unobserve(target);
    (await import("./animation.js")).show(target);
  }
}, { rootMargin: "200px" });
document.querySelectorAll("figure.animation").forEach((figure) => seen.observe(figure));
