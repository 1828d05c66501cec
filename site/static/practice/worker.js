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

/** from: where Python and the course's files lie, and which of these the page needs. */
async function start({ python: home, course: folder, files: needed }) {
  keep(home);
  const content = async (file) => (await fetch(new URL(file, folder))).arrayBuffer();
  const all = Promise.all(["course.tar.bz2", ...needed].map(content));
  const { loadPyodide } = await import(`${home}pyodide.mjs`);
  const runtime = await loadPyodide({ indexURL: home, packages: ["numpy"] });
  const [course, ...files] = await all;
  runtime.unpackArchive(course, "bztar", { extractDir: "/course" });
  files.forEach((file, k) => {
    runtime.FS.mkdirTree(`/course/${needed[k]}/..`);
    runtime.FS.writeFile(`/course/${needed[k]}`, new Uint8Array(file));
  });
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
