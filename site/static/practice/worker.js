/** Python, in a thread of its own, with the course's own checks. What it loads, it keeps. */
const fetched = self.fetch, early = new Map(); // address: what comes before Pyodide asks for it
let python, coming = 1;

onmessage = async ({ data: { id, from, asked } }) => {
  try {
    python ??= start(from);
    const { runtime, course } = await python;
    let found;
    do found = JSON.parse(course.answer(...asked));
    while (found.needs.length && await runtime.loadPackage(found.needs));
    postMessage({ id, found });
  } catch (error) {
    postMessage({ id, error: String(error) });
  }
};

/** from: where Python lies, and the course's files. NumPy and these come while Python starts. */
async function start({ python: home, course, later }) {
  const rest = keep(home).then(async () => {
    const { packages } = await (await fetch(`${home}pyodide-lock.json`)).json();
    const numpy = home + packages.numpy.file_name;
    early.set(numpy, fetch(numpy).then(async (found) => new Response(await found.arrayBuffer())));
    return (await fetch(course)).arrayBuffer();
  });
  const code = ["pyodide.mjs", "pyodide.asm.js"].map((file) => import(home + file));
  Promise.all(code).then(() => waits(-1), () => null);
  const runtime = await (await code[0]).loadPyodide({ indexURL: home });
  runtime.unpackArchive(await rest, "bztar", { extractDir: "/course" });
  await runtime.loadPackage("numpy");
  runtime.FS.mkdirTree("/course/tests/golden");
  for (const name of later) {  // it comes when a check reads it
    runtime.FS.createLazyFile("/course", name, new URL(name, course).href, true, false);
  }
  runtime.runPython("import sys; sys.path.insert(0, '/course')");
  return { runtime, course: runtime.pyimport("course_on_page") };
}

/** Tell how much has come. Keep Python for the next time, which needs no network for it. -> what
 * ends when one of its two large files is here: with both, it runs, and would start no other. */
function keep(home) {
  return new Promise((isHere) => {
    self.fetch = async (request, options) => {
      const address = String(request.url ?? request), known = early.get(address);
      if (early.delete(address)) return known;
      waits(1);
      const cache = address.startsWith(home) && await self.caches?.open(home).catch(() => null);
      const kept = cache && await cache.match(address);
      const found = kept || await fetched(request, options).catch(lose);
      if (!found.ok) lose(`Failed to fetch ${address}`);
      if (cache && !kept) cache.put(address, found.clone()).catch(() => null);
      return new Response(found.body.pipeThrough(new TransformStream({
        transform(part, on) {
          postMessage({ bytes: part.length });
          on.enqueue(part);
        },
        flush() {
          waits(-1);
          if (/\.(wasm|zip)$/.test(address)) isHere();
        },
      })), found);
    };
  });
}

/** Tell of how many files something is still to come. */
function waits(more) {
  postMessage({ coming: coming += more });
}

/** Pyodide would only log that a package does not come. */
function lose(error) {
  postMessage({ error: String(error) });
  throw error;
}
