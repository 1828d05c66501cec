"""The benchmarks' page: answers first, then the README of benchmarks/, then each result.

A result is benchmarks/results/NAME.json, or out/benchmarks/NAME.json if its date is not earlier.
Each number on the page but those of the README is read from there.
"""
import ast
import functools
import json
import re

from benchmarks.measure import text as number
from course.given.places import ROOT, shown_path

from . import picture, put
from .benchmark_plots import PLOTS, chosen, growth, ratio, row_at
from .texts_links import with_function_links, with_page_links

SCRIPTS, NEW = ROOT / "benchmarks", ROOT / "out" / "benchmarks"
KEPT = SCRIPTS / "results"
FACTS = "machine", "system", "processor", "python", "numpy", "scipy", "date"
PICTURE = re.compile(r"!\[[^]]*\]\(peers\.png\)", re.DOTALL)
SCRIPT = re.compile(r"\[(\w+)\.py\]\(\1\.py\)")
FILE = re.compile(r"\[([^]]*)\]\(results(?:/(\w+)\.json)?\)")
HUNDRED = 100_000


def write(folder, extra):
    """Write folder/benchmarks.md, its plots and the results to extra/benchmarks."""
    found = results()
    for name, content in found.items():
        put(extra / "benchmarks" / f"{name}.json", json.dumps(content, indent=1) + "\n")
    pictures = {}
    for name, plot in PLOTS.items():
        drawing, width, height = plot.draw(found[name.partition("-")[0]])
        put(extra / "benchmarks" / f"{name}.svg", drawing)
        words = plot.words(found[name.partition("-")[0]])
        shown = picture(f"benchmarks/{name}.svg", words, width, height)
        pictures[name] = f"<figure>{shown}</figure>"
    put(folder / "benchmarks.md", page(found, pictures))


def results():
    """{name: content} of all results, the newer of each."""
    return {path.stem: json.loads(newest(path.stem).read_text("utf-8"))
            for path in sorted(KEPT.glob("*.json"))}


def newest(name):
    """The file with the later numbers of a benchmark: the repository's, or this machine's own."""
    kept, new = KEPT / f"{name}.json", NEW / f"{name}.json"
    return new if new.exists() and date_of(new) >= date_of(kept) else kept


def date_of(path):
    return json.loads(path.read_text("utf-8")).get("date", "")


def page(found, pictures):
    """The page's text."""
    readme = (SCRIPTS / "README.md").read_text("utf-8")
    title, about = readme.split("\n", 1)
    shown = "\n\n".join(pictures[name] for name in PLOTS if name.startswith("peers"))
    about = PICTURE.sub(lambda _: shown, about)
    about = SCRIPT.sub(lambda script: f"[{script[1]}.py](#{script[1]})" if script[1] in found
                       else f"`{script[1]}.py`", about)
    about = FILE.sub(lambda file: f'<a href="benchmarks/{file[2]}.json">{file[1]}</a>'
                     if file[2] else f"`{file[1]}`", about)
    parts = [title, "## Questions", with_function_links(questions(found)), "## About these numbers",
             with_page_links(about, "benchmarks").replace("\n## ", "\n### "), "## Results"]
    for name, content in found.items():
        parts += section(name, content, pictures)
    return "\n\n".join(part.strip() for part in parts) + "\n"


def questions(found):
    """What people ask first, and the answers."""
    pipeline, lab8 = found["pipeline"]["medians in ms"], found["antialiasing"]["medians in ms"]
    seen, peers, row = row_at(pipeline["faces"], HUNDRED), found["peers"], row_at(lab8, HUNDRED)
    wide = max(lab8, key=lambda row: (row["faces"], row["pixels"]))
    both = chosen(peers["milliseconds"], work="both ways")
    most, beside = both[-1], row_at(both, HUNDRED)
    others = ", ".join(f"{name} {number(beside[name])} ms" for name in beside
                       if f"NumPy x {name}" in beside)
    memory = ", ".join(f"{name} {number(most)} MB"
                       for name, most in peers["peak memory, MB"].items())
    return f"""\
All times are for {number(seen["faces"])} faces in {screen(seen)} pixels, where nothing else is
said.

**What does a picture cost?** `pipeline.render` takes {number(seen["render"])} ms. \
[Stage by stage](#pipeline)

**And the way back?** `pipeline.render_backward` takes {number(seen["d render"])} ms, \
{ratio(seen["d render"], seen["render"])} times the picture.

(antialias-backward-at-100-000-faces)=
**What does `antialias_backward` cost at 100,000 faces?** It takes {number(row["backward"])} ms, \
and `antialias` {number(row["forward"])} ms. At the outline these faces are thinner than a pixel, \
so only {row["blended"]} pairs of pixels are blended. In {screen(wide)} pixels \
{wide["blended"]} pairs are blended. There it takes {number(wide["backward"])} ms, and `antialias` \
{number(wide["forward"])} ms. [All sizes](#antialiasing)

**How does it grow?** {grown(pipeline["faces"], "faces")} {grown(pipeline["pixels"], "pixels")} \
Both together, up to {number(max(row["faces"] for row in both))} faces, grow as the faces to the \
power of {number(peers["NumPy, exponent in faces"])}, and up to {screen(most)} pixels as the \
pixels to the power of {number(peers["NumPy, exponent in pixels"])}. [Up to a million faces](#peers)

**Beside which renderers?** Both ways, with silhouettes: this course {number(beside["NumPy"])} ms, \
compiled by numba {number(beside["compiled"])} ms, {others}. [All of them](#peers)

**How much memory?** {memory}. {docstrings("peers")["peak_memory"]}"""


def grown(rows, key):
    """A sentence: how much longer the last row takes than the first."""
    return (f"{growth(rows, key)} times as many {key} take `render` {growth(rows, 'render')} times "
            f"as long, and `render_backward` {growth(rows, 'd render')} times.")


def screen(row):
    side = round(row["pixels"] ** 0.5)
    return f"{side:,} x {side:,}"


def section(name, content, pictures):
    """A result: what its script says, where it was measured, its plot and its tables."""
    said = docstrings(name)
    title, _, about = said["the script"].partition(": python3 ")
    yield f"### {name}"
    yield title + "." + about.removeprefix(f"benchmarks/{name}.py")
    yield measured(name, content)
    if name != "peers":
        yield pictures[name]
    for title, rows in tables(content):
        yield f"{said.get(title, title[0].upper() + title[1:])}:"
        yield table(rows)


@functools.cache
def docstrings(name):
    """{function: docstring} of a benchmark: some of its tables are called like their function."""
    script = ast.parse((SCRIPTS / f"{name}.py").read_text("utf-8"))
    return {"the script": ast.get_docstring(script)} | {
        node.name: ast.get_docstring(node) for node in script.body
        if isinstance(node, ast.FunctionDef)}


def measured(name, content):
    """A sentence: when and on what, and whether it is newer than what the repository holds."""
    facts = (f"Measured on {content['date']}: {content['processor']}, Python {content['python']}, "
             f"NumPy {content['numpy']}, SciPy {content['scipy']}.")
    if newest(name).parent != KEPT:
        facts += f" These are this machine's own numbers, {shown_path(NEW)}/{name}.json."
    return f'*{facts}* <a href="benchmarks/{name}.json">{name}.json</a>'


def tables(content, title=""):
    """A result's tables: (title, rows). Numbers that stand alone make a row."""
    alone = {key: value for key, value in content.items()
             if not isinstance(value, (list, dict)) and key not in FACTS}
    if alone:
        yield title or "other numbers", [alone]
    for key, value in content.items():
        if isinstance(value, list):
            yield f"{title}, {key}".removeprefix(", "), value
        elif isinstance(value, dict):
            yield from tables(value, f"{title}, {key}".removeprefix(", "))


def table(rows):
    """Rows {column: value} as a Markdown table."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    lines = [[column or "what" for column in columns],
             ["---:" if is_number(rows, column) else "---" for column in columns],
             *([number(row.get(column, "")) for column in columns] for row in rows)]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def is_number(rows, column):
    return any(isinstance(row.get(column), (int, float)) for row in rows)
