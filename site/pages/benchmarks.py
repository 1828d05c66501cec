"""The benchmarks' page: the README of benchmarks/, and the numbers that most readers ask for.

Each number in its tables is read from benchmarks/results, whose files the page links.
"""
import json

from benchmarks.measure import text as number
from course.given.places import ROOT

from . import put
from .texts_links import linked, with_pictures

SCRIPTS = ROOT / "benchmarks"
STAGES = ("rasterize", "barycentrics", "interpolate", "antialias", "d antialias", "d interpolate",
          "d barycentrics", "render", "d render")
RENDERERS = "NumPy", "compiled", "DRTK", "DEODR"


def write(folder, extra):
    """Write folder/benchmarks.md, its picture and the results to extra/benchmarks."""
    files = sorted((SCRIPTS / "results").glob("*.json"))
    for file in files:
        put(extra / "benchmarks" / file.name, file.read_bytes())
    readme = with_pictures((SCRIPTS / "README.md").read_text("utf-8"), "benchmarks", extra)
    about, *more = readme.partition("\n## ")
    found = {file.stem: json.loads(file.read_text("utf-8")) for file in files}
    put(folder / "benchmarks.md", linked(about + numbers(found) + "".join(more), "benchmarks"))


def numbers(found):
    """{name: result} -> the sections with the tables, and the links to all results."""
    pipeline, peers = found["pipeline"], found["peers"]
    both = [row for row in peers["milliseconds"] if row["work"] == "both ways"]
    small = [row for row in both if row["pixels"] == 512**2]
    return f"""
## A picture and its gradient

`pipeline.render` and `pipeline.render_backward`, "d render", beside their stages one by one, in
512 x 512 pixels. {measured("pipeline", pipeline)}

{table("faces", pipeline["medians in ms"]["faces"], STAGES)}

## Beside other renderers

A picture and its gradient together, in 512 x 512 pixels. {measured("peers", peers)}

{table("faces", small, RENDERERS)}

NumPy's time grows as the faces to the power of {number(peers["NumPy, exponent in faces"])}, and as
the pixels to the power of {number(peers["NumPy, exponent in pixels"])}. All of them with
{number(both[-1]["faces"])} faces:

{table("pixels", [row for row in both if row["faces"] == both[-1]["faces"]], RENDERERS)}

## All results

{", ".join(f'<a href="benchmarks/{name}.json">{name}</a>' for name in found)}.
"""


def measured(name, content):
    """When, on what, and in which file."""
    return (f"Milliseconds, {content['processor']}, NumPy {content['numpy']}, {content['date']}: "
            f'<a href="benchmarks/{name}.json">{name}.json</a>.')


def table(key, results, names):
    """A Markdown table with a line for each name, and a column for each result, headed by its key.
    """
    lines = [[key, *(number(row[key]) for row in results)],
             ["---", *["---:"] * len(results)],
             *([name, *(number(row[name]) for row in results)] for name in names)]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
