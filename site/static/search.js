// The search: each record is [address, title, place, text], made by site/pages/search.py.
const SHOWN = 20, EXCERPT = 220;
const form = document.getElementById("search"), list = document.getElementById("found");
const count = document.getElementById("found-count");

async function unpack(packed) {
  const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const columns = await new Response(stream).json();
  return columns[0].map((_, k) => columns.map((column) => column[k]));
}

// A word begins where it is found: z-buffer is zbuffer and z_buffer, barycentric finds
// barycentrics, but 8 is neither in 8.7 nor in 80. A question mark is one letter, or none.
function pattern(word) {
  const letters = [...word.replace(/[-_]/g, "").replace(/(?<=...)s$/, "")];
  const escaped = letters.map((letter) => letter.replace(".", "\\.").replace("?", "\\p{L}?"));
  const end = /\d$/.test(word) ? "(?!\\d|\\.\\d)" : "";
  return `(?<![\\p{L}\\p{N}]|\\d\\.)${escaped.join("[-_]?")}${end}`;
}

const SMALL = /^(a|an|and|are|can|do|does|each|for|from|how|i|in|is|it|its|long|my|of|on|or|that|the|there|to|too|what|when|where|which|why|with|you|your)$/i;

// What is looked for: all but small words, if there are others. A word that is nowhere may have a
// letter too few, too many, or a wrong one.
function asked(query, records) {
  const words = query.match(/[\p{L}\p{N}_-]+(\.\d+)?/gu) ?? [];
  const large = words.filter((word) => !SMALL.test(word));
  const isThere = (one) => records.some((record) => new RegExp(one, "iu").test(record.join(" ")));
  return (large.length ? large : words).map((word) => (
    word.length < 4 || isThere(pattern(word)) ? pattern(word) : [...word].flatMap((_, k) =>
      [k, k + 1].map((end) => pattern(`${word.slice(0, k)}?${word.slice(end)}`))).join("|")));
}

// How well a word fits: in the title, in the place, or in the text, the oftener the better.
function fit(word, title, place, text) {
  if (title.search(word) >= 0) return 8;
  if (place.search(word) >= 0) return 3;
  const times = text.match(word)?.length ?? 0;
  return times && 1 + 2 * times / (times + 1 + text.length / 400);
}

// What has as many words as one record has, or one less; the title that says little else stands
// first.
function search(records, patterns) {
  const words = patterns.map((one) => new RegExp(one, "giu"));
  const every = new RegExp(patterns.join("|"), "giu");
  const found = records.map((record) => {
    const [address, title, place, text] = record;
    const fits = words.map((word) => fit(word, title, place, text));
    const fitting = fits.reduce((sum, one) => sum + one, 0) / words.length;
    const covered = (title.match(every) ?? []).join("").length / title.length;
    const code = /^(reference|given)\//.test(address) ? 0.7 : 1;
    const page = covered && !address.includes("#") ? 1 : 0;
    const has = fits.filter(Boolean).length;
    return { record, has, score: (has / words.length) ** 2 * code * (fitting + 10 * covered + page) };
  });
  const most = Math.max(2, ...found.map((one) => one.has));
  return found.filter((one) => one.has >= most - 1).sort((a, b) => b.score - a.score)
    .map((one) => one.record);
}

function element(name, className, ...children) {
  const made = document.createElement(name);
  if (className) made.className = className;
  made.append(...children);
  return made;
}

// The beginning of what a title names, or the text around the first word that is found.
function excerpt(title, text, every) {
  const first = title.search(every) < 0 ? Math.max(0, text.search(every) - EXCERPT / 3) : 0;
  const start = first ? text.indexOf(" ", first) + 1 : 0;
  const goesOn = start + EXCERPT < text.length;
  const cut = text.slice(start, goesOn ? text.lastIndexOf(" ", start + EXCERPT) : undefined);
  return element("p", "", ...marked(cut, every), goesOn ? " …" : "");
}

// A text in pieces: what is found is marked.
function marked(text, every) {
  const pieces = [];
  let end = 0;
  for (const match of text.matchAll(every)) {
    pieces.push(text.slice(end, match.index), element("mark", "", match[0]));
    end = match.index + match[0].length;
  }
  return [...pieces, text.slice(end)];
}

function show(records) {
  const query = form.q.value.trim(), patterns = asked(query, records);
  const found = patterns.length ? search(records, patterns) : [];
  const every = new RegExp(`(?:${patterns.join("|")})[\\p{L}\\p{N}_]*`, "giu"); // whole words
  list.replaceChildren(...found.slice(0, SHOWN).map(([address, title, place, text]) => {
    const link = element("a", "", ...marked(title, every));
    link.href = address;
    return element("li", "", link, element("span", "place", place), excerpt(title, text, every));
  }));
  const more = found.length > SHOWN ? `, the best ${SHOWN} are shown` : "";
  count.textContent = query && `${found.length || "No"} ` +
    `${found.length === 1 ? "place" : "places"} for “${query}”${more}`;
  const asking = query && `?${new URLSearchParams({ q: query })}`;
  history.replaceState(null, "", asking || location.pathname);
}

form.q.value = new URLSearchParams(location.search).get("q") ?? "";
unpack(PACKED_RECORDS).then((records) => {
  form.addEventListener("input", () => show(records));
  form.addEventListener("submit", (event) => { event.preventDefault(); show(records); });
  show(records);
});
