"""The lectures: the notebooks as they are saved, with links to the site's other pages.

Pictures become files with numbers. What moves waits for the reader, in a player.
"""
import base64
import html
import io
import re

import nbformat
from PIL import Image

from labkit.places import ROOT, read_whole
from labkit.upkeep import hours

from . import inserts, picture, put, sidebar, webp
from .texts_links import with_page_links

NEIGHBOURS = re.compile(r"^\[.*[←→].*$", re.MULTILINE)
NEIGHBOUR = re.compile(r"\[[^]]*[←→][^]]*\]\([^)]*\)(?: · )?")  # the theme has its own
OPENING = re.compile(r'<img src="([^"]+)" width="(\d+)" alt="([^"]+)">')
BOARD = re.compile(r"# live\s+(?:(?:from labkit import board|board\.show\([^)]*\))\s*)+")
IMPORTS = "import sys; sys.path.append"


def write(folder, extra):
    """Write the lectures to folder/lectures, and their pictures to extra/lectures.

    ValueError: a figure has no place, or a place no figure.
    """
    added = inserts.Inserts(extra)
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        notebook.cells = [cell for cell in notebook.cells if not BOARD.fullmatch(cell.source)]
        first, pictures = notebook.cells[0], Pictures(path.stem, extra / "lectures" / "pictures")
        first.source = NEIGHBOURS.sub(ways(path, NEIGHBOURS.search(first.source)[0]),
                                      first.source)
        for cell in notebook.cells:
            if cell.cell_type == "markdown":
                text = linked(added.put_in(cell.source))
                cell.source = OPENING.sub(pictures.opening, text)
            elif cell.source.startswith(IMPORTS):
                cell.metadata.tags = ["hide-input"]
                cell.metadata.mystnb = {"code_prompt_show": "What this page imports"}
            for output in cell.get("outputs", []):
                pictures.extract(output)
        notebook.cells.append(nbformat.v4.new_markdown_cell(sidebar.below(path.stem), id="tree"))
        put(folder / "lectures" / path.name, nbformat.writes(notebook) + "\n")
    added.require_all()


def ways(path, line):
    """The line below a lecture's title: where to run and read it, what it leads to, its minutes."""
    rest = NEIGHBOUR.sub("", line).replace("code: ", "Source: ")
    rest = re.sub(r"lab: \[[^]]*\]", f"[Lab {int(path.stem[:2])}]", rest)
    minutes = 5 * round(hours.minutes(path) / 5)
    return "{.ways}\n" + " · ".join(['<a href="../index.html#get-the-course">Run it</a>', rest] +
                                    [f"about {minutes} minutes to read"])


def linked(text):
    """A lecture's text without links to its neighbours, and with its links led to the site's pages.
    """
    return with_page_links(NEIGHBOURS.sub("", text), "notebooks")


class Pictures:
    """Takes the pictures out of a lecture, and writes them into the site's files."""

    def __init__(self, lecture, folder):
        self.lecture, self.folder, self.count = lecture, folder, 0

    def extract(self, output):
        """Put the HTML that shows a picture in its place."""
        data = output.get("data", {})
        if "image/png" not in data:
            return
        about = output.metadata["image/png"]
        shown = self.shown(base64.b64decode(data["image/png"]), about["alt"], about["width"])
        output.data = nbformat.from_dict({"text/html": shown})
        output.metadata = nbformat.from_dict({})

    def opening(self, tag):
        """The HTML that shows the picture of an <img>, a file beside the notebooks."""
        file, width, words = tag.groups()
        return self.shown(read_whole(ROOT / "notebooks" / file), html.unescape(words), int(width))

    def shown(self, content, words, width):
        """Write a picture -> the HTML that shows it. What moves is shown by a player."""
        name = f"{self.lecture.partition('_')[0]}_{self.count:02}"
        self.count += 1
        opened = Image.open(io.BytesIO(content))
        frames = webp(self.folder, name, opened)
        height = round(opened.height * width / opened.width)
        still, kind = name, 'class="drawn"'
        if frames > 1:
            still, kind = f"{name}_still", (
                f'class="animation" data-file="pictures/{name}.webp" data-frames="{frames}"')
        shown = picture(f"pictures/{still}.webp", words, width, height)
        said = html.escape(words[0].upper() + words[1:].rstrip("."))
        return (f'<figure class="numbered" id="figure-{self.count}"><figure {kind}>{shown}</figure>'
                f'<figcaption><details class="fold"><summary>Figure {self.count} in words</summary>'
                f"{said}.</details></figcaption></figure>")
