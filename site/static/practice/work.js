/** What the reader has written: the text of each lab's file. The browser keeps it. */
const KEY = /^course: labs\/(\w+)\.py$/;
const labs = new Map(); // topic: a Lab, as it was last read or written
const verdicts = new Map(); // number of an exercise: what was told of it, and of which text

/** {topic: text} of all files that were written in. */
export function files() {
  const kept = {};
  try {
    for (const key of Object.keys(localStorage)) {
      const topic = key.match(KEY)?.[1];
      if (topic) kept[topic] = localStorage.getItem(key);
    }
  } catch { /* it is refused: what is here is all */ }
  labs.forEach((one, topic) => one.isWritten && (kept[topic] = one.text));
  return kept;
}

/** A topic's Lab. about: its text as it came, and what stands in it. */
export function lab(topic, about) {
  if (!labs.has(topic)) labs.set(topic, new Lab(about, files()[topic]));
  return labs.get(topic);
}

/** Keep a topic's text in the browser. say(words): where it refuses. */
export function keep(topic, say = alert) {
  const one = labs.get(topic);
  one.isWritten = true;
  try {
    localStorage.setItem(`course: labs/${topic}.py`, one.text);
  } catch {
    say("Your browser keeps nothing here. Take your zip before you leave this page.");
  }
}

/** Keep what was told of an exercise, with the text that was checked. */
export function keepVerdict(number, told, text) {
  verdicts.set(number, [told, text]);
  try {
    localStorage.setItem(`course: verdict ${number}`, JSON.stringify([told, text]));
  } catch { /* `keep` has said so */ }
}

/** -> what was told of an exercise, and of which text; nothing where it was never checked. */
export function verdict(number) {
  try {
    return verdicts.get(number) ?? JSON.parse(localStorage[`course: verdict ${number}`]);
  } catch {
    return [];
  }
}

/** changed(topic): another tab has written. */
export function onOther(changed) {
  addEventListener("storage", ({ key, newValue }) => {
    const topic = key?.match(KEY)?.[1];
    if (!newValue || !labs.has(topic)) return;
    labs.get(topic).put(newValue);
    changed(topic);
  });
}

/** A lab's file in parts, which joined are its text: what is above the first function, and then
 * one for each name that it came with. What the reader adds belongs to the part before it. */
class Lab {
  constructor(about, text) {
    this.about = about ?? { text: "", names: [], extras: {} };
    this.isWritten = text !== undefined;
    this.put(text ?? this.about.text);
  }

  get text() {
    return this.parts.join("");
  }

  put(text) {
    const start = `(?:def |class )?(?:${this.about.names.join("|")})\\b`, above = "^@.*\\n";
    this.parts = text.split(new RegExp(`^(?<!${above})(?=(?:@.*\\n)*${start})`, "m"));
  }

  /** The part of a function: what is in it without empty lines around, and its first line. */
  part(name) {
    const isIts = (text) => new RegExp(`^def ${name}\\(`, "m").test(text);
    let place = this.parts.findIndex(isIts);
    if (place < 0) place = this.parts.push(`\n\n${new Lab(this.about).part(name).text}\n`) - 1;
    const [, before, text, after] = this.parts[place].match(/^(\s*)([^]*?)(\s*)$/);
    return {
      text,
      line: (this.parts.slice(0, place).join("") + before).split("\n").length,
      isClosed: name in this.about.extras && !/# extra .*, open$/m.test(text),
      write: (other) => { this.parts[place] = before + other + after; },
    };
  }
}
