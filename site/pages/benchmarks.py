"""The benchmarks' page: the README of benchmarks/, two tables of its results, and all of these."""
import json

from benchmarks.measure import text as number
from labkit.places import ROOT

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
    found = {file.stem: json.loads(file.read_text("utf-8")) for file in files}
    links = ", ".join(f'<a href="benchmarks/{name}.json">{name}</a>' for name in found)
    readme = with_pictures((SCRIPTS / "README.md").read_text("utf-8"), "benchmarks", extra)
    put(folder / "benchmarks.md", linked(readme, "benchmarks")
        + tables(found["pipeline"], found["peers"]) + f"\n## All results\n\n{links}.\n")


def tables(pipeline, peers):
    """The pipeline's stages, backward with a "d", and a picture with its gradient by others."""
    both = [row for row in peers["milliseconds"]
            if row["work"] == "both ways" and row["pixels"] == 512**2]
    return (table("A picture and its gradient (d), stage by stage", pipeline,
                  pipeline["medians in ms"]["faces"], STAGES)
            + table("A picture and its gradient, by several renderers", peers, both, RENDERERS))


def table(title, result, rows, names):
    """A section with a line for each name, and a column for each number of faces."""
    lines = [["faces", *(f"{row['faces']:,}" for row in rows)], ["---", *["---:"] * len(rows)],
             *([name, *(number(row[name]) for row in rows)] for name in names)]
    return (f"\n## {title}\n\nMilliseconds for 512 x 512 pixels, {result['processor']}, NumPy "
            f"{result['numpy']}, {result['date']}.\n\n"
            + "".join(f"| {' | '.join(line)} |\n" for line in lines))
