"""The benchmarks' page: the README of benchmarks/, a table of its results, and all of these."""
import json

from benchmarks.measure import text as number
from labkit.places import ROOT

from . import put
from .texts_links import linked, with_pictures

SCRIPTS = ROOT / "benchmarks"
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
        + table(found["peers"]) + f"\n## All results\n\n{links}.\n")


def table(peers):
    """A picture with its gradient by several renderers: a line each, a column for each count."""
    rows = [row for row in peers["milliseconds"]
            if row["work"] == "both ways" and row["pixels"] == 512**2]
    lines = [["faces", *(f"{row['faces']:,}" for row in rows)], ["---", *["---:"] * len(rows)],
             *([name, *(number(row[name]) for row in rows)] for name in RENDERERS)]
    return ("\n## A picture and its gradient, by several renderers\n\n"
            f"Milliseconds for 512 x 512 pixels, {peers['processor']}, NumPy "
            f"{peers['numpy']}, {peers['date']}.\n\n"
            + "".join(f"| {' | '.join(line)} |\n" for line in lines))
