/** Exercises, done on a lab's page: an editor for each. Python checks them, in a worker. */
import { edit } from "./editor.js";
import { ask, begin, onProgress, stop } from "./python.js";
import { files, keep, keepVerdict, lab, onOther, verdict } from "./work.js";

const about = JSON.parse(document.querySelector("#practice").textContent);
const shown = new Map(); // the exercises with an editor, by number

function practise(place) {
  const { number, topic, name } = place.dataset, file = `labs/${topic}.py`;
  const part = () => lab(topic, about.labs[topic]).part(name);
  if (part().isClosed) return offer(place, topic, name);
  place.innerHTML = `<div class="bar"><code>${file}</code> <button class="check">Check ${number}
    </button> <button class="stop" hidden>Stop</button> <output></output>
    <progress hidden></progress></div><div class="text"></div><pre class="report" tabindex="0" hidden></pre>`;
  const find = (what) => place.querySelector(what);
  const link = `.overview [href="#exercise-${number.replace(".", "-")}"]`;
  const row = document.querySelector(link).closest("tr");
  const editor = edit(find(".text"), `Your ${name}`, part().text, (text) => {
    if (text === part().text) return;
    part().write(text);
    recall();
    keep(topic, (words) => { warning = words; say(""); });
    begin(about);
    for (const other of shown.values()) if (other.topic === topic) other.number();
  }, check);
  let waits = false, isDrawn = false, warning = "";

  function say(words, kind = "") {
    find("output").textContent = `${words} ${warning}`.trim();  // it is not overwritten
    place.dataset.verdict = kind;
  }

  /** What was told before, and whether it was told of this text. */
  function recall(when = " when last checked") {
    const [told, text] = verdict(number);
    if (!told) return;
    const isSame = text === part().text;
    say(isSame ? told + when : `${told} before it was changed`, isSame ? told : "");
    row.dataset.verdict = place.dataset.verdict;
  }

  /** A text, with links to the exercises that it names. */
  function report(text) {
    const parts = text.split(/(?<=blocked by |write |exercise |question of )(\d+\.\d+)\b/);
    find(".report").hidden = !text;
    find(".report").replaceChildren(...parts.map((part, k) => k % 2 === 0 ? part
      : Object.assign(document.createElement("a"), { textContent: part, href:
        `${about.pages[parseInt(part) - 1]}.html#exercise-${part.replace(".", "-")}` })));
  }

  function progress(have, of, isThere) {
    if (isDrawn || (!waits && !place.contains(document.activeElement))) return;
    const much = have < of ? ` ${have.toFixed(1)} of ${of.toFixed(1)} MB` : "";
    if (isThere) {
      say(waits ? "checking" : "Python is ready");
      if (!waits) recall();
    } else say(much || have > of + 1 ? `Python comes:${much || ` ${have.toFixed(1)} MB`}`
      : "Python starts");
    Object.assign(find("progress"), { max: of, value: have, hidden: isThere || !much });
  }

  async function check() {
    if (waits) return;
    const asked = { [number]: part().text };
    waits = true;
    find(".stop").hidden = false;
    say("checking");
    try {
      const found = await ask(about, "check", files(), number);
      for (const [each, told] of Object.entries(found.verdicts)) {
        shown.get(each)?.hear(told, asked[each]);
      }
      report(found.report);
      if (find(".draws")) await draw();
    } catch (fault) {
      say(fault.message);
      report(fault.tells ? `${fault.tells}\nYour text is kept. On your own computer, ` +
        `python3 -m course check ${number} checks it.` : "");
    } finally {
      waits = false;
      find(".stop").hidden = find("progress").hidden = true;
    }
  }

  async function draw() {
    const { picture } = find(".draws").dataset, canvas = find(".yours canvas");
    isDrawn = true;
    find(".yours figcaption").textContent = "is drawn";
    const { waits, width, colours } = await ask(about, "picture", files(), picture)
      .finally(() => { isDrawn = false; });
    find(".yours figcaption").textContent = waits ?? "yours";
    find(".draws").classList.toggle("drawn", !waits);
    if (waits) return;
    const bytes = Uint8ClampedArray.from(atob(colours), (letter) => letter.charCodeAt(0));
    const image = new ImageData(bytes, width);
    Object.assign(canvas, { width, height: image.height });
    canvas.getContext("2d").putImageData(image, 0, 0);
  }

  const me = {
    topic, progress, number: () => editor.begin(part().line),
    renew() {
      if (editor.read() !== part().text) editor.write(part().text);
      me.number();
      recall();
    },
    hear(told, text = part().text) {
      keepVerdict(number, told, text);
      recall("");
    },
  };
  shown.set(number, me);
  me.number();
  recall();
  const pair = place.nextElementSibling;
  if (pair?.matches(".draws")) find(".text").after(pair);
  find(".check").onclick = check;
  find(".stop").onclick = () => stop(about);
  for (const touch of ["pointerdown", "focusin"]) {
    place.addEventListener(touch, () => begin(about), { once: true });
  }
}

/** An extra is complete until it is opened. */
function offer(place, topic, name) {
  place.innerHTML = "<button>Open this extra, to write it yourself</button>";
  place.firstChild.onclick = () => {
    lab(topic, about.labs[topic]).part(name).write(about.labs[topic].extras[name]);
    keep(topic);
    practise(place);
  };
}

onProgress((...told) => shown.forEach((each) => each.progress(...told)));
onOther((topic) => shown.forEach((each) => each.topic === topic && each.renew()));
document.querySelectorAll(".practice").forEach(practise);
if (location.search === "?begin") begin(about);

const work = document.querySelector(".my-work");
work.hidden = false;
work.querySelector(".zip").onclick = () => told(async () => {
  const { zip } = await ask(about, "pack", files(), JSON.stringify(Object.keys(files())));
  const link = document.createElement("a");
  link.href = `data:application/zip;base64,${zip}`;
  link.download = "labs.zip";
  link.click();
  return "labs.zip is what to hand in.";
});
work.querySelector("input").onchange = ({ target }) => told(async () => {
  const file = target.files[0], bytes = new Uint8Array(await file.arrayBuffer());
  const content = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
  const { texts, notes } = await ask(about, "unpack", {}, file.name, content);
  target.value = "";
  const mine = files(), names = Object.keys(texts);
  const over = names.filter((topic) => mine[topic] && mine[topic] !== texts[topic]);
  if (over.length && !confirm(`Replace what you have written in ${over.join(", ")}?`)) return "";
  for (const topic of names) {
    lab(topic, about.labs[topic]).put(texts[topic]);
    keep(topic);
    shown.forEach((each) => each.topic === topic && each.renew());
  }
  return [`${names.length} files of labs/ are yours again.`, ...notes].join(" ");
});

async function told(task) {
  const output = work.querySelector("output");
  output.textContent = "Python is asked";
  output.textContent = await task().catch((fault) => `${fault.message} ${fault.tells ?? ""}`);
}
