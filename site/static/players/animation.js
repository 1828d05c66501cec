// The films of a page: animated WebPs with play, pause and a slider. Each is fetched when it is
// first played, and rests while it is out of sight. Without scripts, stills stand there.
//
//   <figure class="animation" data-file="x.webp" data-frames="25" [data-autoplay]>
//     <img src="still.webp"></figure>
//
// A canvas takes the place of the still, which is the film's end: the file's first frame, so that
// the film stands there where nothing moves. A browser that cannot decode frames shows the file
// itself, which plays on its own.

const make = (name, properties) => Object.assign(document.createElement(name), properties);

document.querySelectorAll("figure.animation").forEach((figure) => {
  const { file, frames } = figure.dataset, end = frames - 1;
  const still = figure.querySelector("img"), poster = still.src;
  const decodes = "ImageDecoder" in window;
  const play = make("button", { type: "button" });
  const slider = make("input", { type: "range", max: end, value: end, ariaLabel: "Frame" });
  const told = make("span", { role: "status" });
  const controls = make("div", { className: "controls" });
  const canvas = make("canvas", { role: "img", ariaLabel: still.alt });
  let playing, film, timer, isSeen = false;

  const set = (isPlaying, words = "") => {
    playing = isPlaying;
    play.ariaLabel = playing ? "Pause" : "Play";
    told.textContent = words;
    slider.hidden = !decodes || words !== "";
    if (!decodes) still.src = playing ? file : poster;
  };
  const fail = () => {
    film = null; // the next press fetches it again
    slider.value = end;
    set(false, "The film did not load. Press play to try again.");
  };
  // Draw the slider's frame. While the film plays in sight, the next one follows.
  const draw = async () => {
    if (!decodes) return;
    film ??= decoded(file, Number(frames));
    const images = await film.catch(fail);
    clearTimeout(timer);
    if (!images) return;
    const image = images[slider.value];
    if (!canvas.isConnected) takePlace(canvas, still, image);
    canvas.getContext("2d").drawImage(image, 0, 0);
    slider.ariaValueText = `${slider.valueAsNumber + 1} of ${frames}`;
    if (playing && isSeen) timer = setTimeout(next, image.duration / 1000);
  };
  const next = () => {
    slider.value = (slider.valueAsNumber + 1) % frames;
    draw();
  };

  play.addEventListener("click", () => {
    set(!playing);
    if (playing) next();
    else clearTimeout(timer);
  });
  slider.addEventListener("input", () => {
    set(false);
    draw();
  });
  still.addEventListener("error", () => playing && fail());
  slider.ariaValueText = `${frames} of ${frames}`;
  controls.append(play, slider, told);
  figure.append(controls);
  set("autoplay" in figure.dataset && !matchMedia("(prefers-reduced-motion: reduce)").matches);
  new IntersectionObserver((entries) => {
    isSeen = entries.at(-1).isIntersecting;
    if (playing) draw();
  }).observe(figure);
});

// The film's frames from its beginning to its end. Each knows its duration in microseconds.
async function decoded(file, frames) {
  const response = await fetch(file);
  const decoder = new ImageDecoder({ data: await response.arrayBuffer(), type: "image/webp" });
  const all = Array.from({ length: frames }, (_, frameIndex) => decoder.decode({ frameIndex }));
  const [end, ...others] = (await Promise.all(all)).map(({ image }) => image);
  return [...others, end];
}

function takePlace(canvas, still, { displayWidth, displayHeight }) {
  Object.assign(canvas, { width: displayWidth, height: displayHeight });
  canvas.style.width = `${still.getAttribute("width")}px`;
  still.replaceWith(canvas);
}
