/** Python, in a thread of its own, with the course's own checks. What it loads, it keeps. */
const fetched = self.fetch;
let python;

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

/** from: where Python lies, and the course's files. */
async function start({ python: home, course }) {
  keep(home);
  const packed = fetch(course).then((found) => found.arrayBuffer());
  const { loadPyodide } = await import(`${home}pyodide.mjs`);
  const runtime = await loadPyodide({ indexURL: home, packages: ["numpy"] });
  runtime.unpackArchive(await packed, "bztar", { extractDir: "/course" });
  runtime.runPython("import sys; sys.path.insert(0, '/course')");
  return { runtime, course: runtime.pyimport("course_on_page") };
}

/** Tell how much has come. Keep Python for the next time, which needs no network for it. */
function keep(home) {
  self.fetch = async (request, options) => {
    const address = String(request.url ?? request);
    const cache = address.startsWith(home) && await self.caches?.open(home).catch(() => null);
    const kept = cache && await cache.match(address);
    const found = kept || await fetched(request, options);
    if (cache && !kept && found.ok) cache.put(address, found.clone()).catch(() => null);
    return new Response(found.body?.pipeThrough(new TransformStream({
      transform(part, on) {
        postMessage({ bytes: part.length });
        on.enqueue(part);
      },
    })), found);
  };
}
