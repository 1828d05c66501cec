/** Python in a worker: it comes when it is first wanted, and can be stopped. */
const PATIENCE = 45_000; // ms in which nothing comes of what is still to come
let worker, heard, have, coming, count = 0, tell = () => null;
const waiting = new Map(); // number of a question: how it ends

const fault = (message, tells) => Object.assign(new Error(message), { tells });

/** told(megabytes, of how many, is it there?), while it comes. */
export function onProgress(told) {
  tell = told;
}

/** Let Python come, if it has not been asked to. */
export function begin(about) {
  if (worker) return;
  try {
    worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
  } catch {
    return;
  }
  [heard, have, coming] = [Date.now(), 0, 1];
  worker.onmessage = ({ data }) => {
    heard = Date.now();
    if (data.bytes) return tell((have += data.bytes / 1e6), about.megabytes);
    if ("coming" in data) return coming = data.coming;
    const end = waiting.get(data.id);
    waiting.delete(data.id);
    if (data.found) end?.done(data.found);
    else lose(explained(data.error, about), end);
  };
  worker.onerror = (event) => {
    event.preventDefault();
    lose(explained(event.message ?? "it does not start", about));
  };
  const watch = setInterval((watched) => {
    if (worker !== watched) clearInterval(watch);
    else if (coming && Date.now() - heard > PATIENCE) lose(explained("nothing comes", about));
  }, 1000, worker);
  ask(about, "ready", {}).then(() => tell(have, about.megabytes, true), () => null);
}

/** -> what the course answers to a question, `kind` of course_on_page.py. Fault. */
export function ask(about, kind, files, ...rest) {
  begin(about);
  if (!worker) return Promise.reject(explained("no worker", about));
  return new Promise((done, failed) => {
    waiting.set(++count, { done, failed });
    const from = { python: new URL(about.python, location).href,
      course: new URL("../../practice/course.tar.bz2", import.meta.url).href, later: about.later };
    worker.postMessage({ id: count, from, asked: [kind, JSON.stringify(files), ...rest] });
  });
}

/** End what runs, a loop without an end, say. Python starts again. */
export function stop(about) {
  lose(fault("stopped"));
  begin(about);
}

function lose(why, ...more) {
  worker?.terminate();
  worker = undefined;
  for (const { failed } of [...waiting.values(), ...more.filter(Boolean)]) failed(why);
  waiting.clear();
}

function explained(error, about) {
  console.warn(error);
  if (/memory|RangeError/i.test(error)) {
    return fault("no memory", "This browser has no memory left for Python. Close other " +
      "tabs, then press Check again.");
  }
  if (typeof WebAssembly !== "object" || /no worker|does not start/.test(error)) {
    return fault("too old", "This browser is too old to run Python.");
  }
  if (/failed to fetch|networkerror|load failed|dynamically imported|nothing comes/i.test(error)) {
    const host = new URL(about.python, location).host;
    return fault("no Python", `Python did not come from ${host}: this computer is offline, ` +
      "or that address is blocked. Check tries again.");
  }
  return fault("Python broke off", error);
}
