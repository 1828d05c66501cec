"""The page of errata: what the lectures correct in the sources they follow, each in its own box.

A box is a quotation in a lecture whose first line begins with `> **Erratum`.
`python3 -m course notebooks` writes the page, notebooks/errata.md.
"""
import re

from .. import exercises
from ..places import ROOT, write_whole

FOLDER = ROOT / "notebooks"
BOX = re.compile(r"^> \*\*Erratum.*(?:\n>.*)*", re.MULTILINE)
HEAD = """\
# Errata of the sources

The lectures follow five sources, named S0 to S4 at the end of each lecture. Where a source is wrong
the lecture says so in a box. These are all the boxes, in the order of the lectures.
"""


def page() -> str:
    """The page's text, from the lectures as they stand."""
    parts = [HEAD]
    for path in sorted(FOLDER.glob("*.ipynb")):
        if boxes := [box for text in exercises.cells(path) for box in BOX.findall(text)]:
            title = exercises.cells(path)[0].partition("\n")[0].removeprefix("# ")
            parts += [f"## [{title}]({path.name})\n", "\n\n".join(boxes) + "\n"]
    return "\n".join(parts)


def write() -> None:
    write_whole(FOLDER / "errata.md", page().encode("utf-8"))
