// An animated PNG with play, pause and a slider. It is fetched when it is first played.
//
//   <figure class="animation" data-file="x.png" [data-autoplay]><img src="still.png"></figure>
//
// Its frames are drawn on a canvas over the still. A browser that cannot decode frames shows the
// file itself, which plays on its own.

export function show(figure) {
  const still = figure.querySelector("img");
  const player = { still, playing: false, now: 0 };
  const play = button(figure, "Play");
  const slider = range(figure, "Frame");
  slider.hidden = !("ImageDecoder" in window);
  const set = (playing) => {
    player.playing = playing;
    label(play, playing ? "Pause" : "Play");
  };
  player.draw = () => {
    const frame = player.frames[player.now];
    player.canvas.getContext("2d").drawImage(frame.image, 0, 0);
    slider.value = player.now;
    slider.setAttribute("aria-valuetext", `${player.now + 1} of ${player.frames.length}`);
  };
  const loaded = () => load(figure, player, slider).then(() => true, () => {
    set(false);
    return false;
  });

  const go = async () => {
    set(!player.playing);
    if (slider.hidden) showFile(figure, player);
    else if (await loaded()) run(player);
  };
  play.addEventListener("click", go);
  slider.addEventListener("input", async () => {
    const share = slider.valueAsNumber / slider.max;
    set(false);
    if (!(await loaded())) return;
    player.now = Math.round(share * (player.frames.length - 1));
    player.draw();
  });

  const reducedMotion = matchMedia("(prefers-reduced-motion: reduce)").matches;
  if ("autoplay" in figure.dataset && !reducedMotion) go();
}

// All frames of the file, as pictures with their durations in milliseconds.
async function decoded(file) {
  const response = await fetch(file);
  if (!response.ok) throw new Error(`there is no ${file}`);
  const decoder = new ImageDecoder({ data: await response.arrayBuffer(), type: "image/png" });
  await Promise.all([decoder.tracks.ready, decoder.completed]);
  const frames = [];
  for (let k = 0; k < decoder.tracks.selectedTrack.frameCount; k += 1) {
    const { image } = await decoder.decode({ frameIndex: k });
    frames.push({ image: await createImageBitmap(image), duration: image.duration / 1000 });
    image.close();
  }
  return frames;
}

async function load(figure, player, slider) {
  player.loading ??= decoded(figure.dataset.file);
  try {
    player.frames = await player.loading;
  } catch (error) {
    player.loading = null; // the next try fetches it again
    throw error;
  }
  if (player.canvas) return;
  const { image } = player.frames[0];
  player.canvas = document.createElement("canvas");
  Object.assign(player.canvas, { width: image.width, height: image.height });
  player.canvas.setAttribute("aria-hidden", "true"); // the still behind it has the words
  player.still.after(player.canvas);
  slider.max = player.frames.length - 1;
}

function run(player) {
  clearTimeout(player.timer);
  if (!player.playing) return;
  player.draw();
  const wait = player.frames[player.now].duration;
  player.now = (player.now + 1) % player.frames.length;
  player.timer = setTimeout(() => run(player), wait);
}

function showFile(figure, player) {
  player.poster ??= player.still.src;
  player.still.src = player.playing ? figure.dataset.file : player.poster;
}

function controls(figure) {
  const found = figure.querySelector(".controls");
  if (found) return found;
  const made = document.createElement("div");
  made.className = "controls";
  figure.append(made);
  return made;
}

function button(figure, name) {
  const made = document.createElement("button");
  made.type = "button";
  label(made, name);
  controls(figure).append(made);
  return made;
}

function label(button, name) {
  button.textContent = { Play: "▶", Pause: "⏸" }[name] + "\uFE0E";
  button.setAttribute("aria-label", name);
}

function range(figure, name) {
  const made = document.createElement("input");
  Object.assign(made, { type: "range", min: 0, max: 100, value: 0 });
  made.setAttribute("aria-label", name);
  controls(figure).append(made);
  return made;
}
