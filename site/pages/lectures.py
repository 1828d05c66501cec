"""The lectures: the notebooks as they are saved, with links to the site's other pages.

Pictures become files. What moves waits for the reader, in a player.
"""
import base64
import html
import io
import re

import nbformat
from PIL import Image

from course.given.places import ROOT, read_whole

from . import inserts, picture, put
from .names import CODE, document, exercise_pages, function_page
from .posters import frame_count, poster

NEIGHBOUR = re.compile(r"\[[^]]*[←→][^]]*\]\([^)]*\)(?: · )?")  # the theme has its own
LINK = re.compile(r"\]\((?!https?:|#)([^)#\s]+)(#[^)\s]+)?\)")
OPENING = re.compile(r'<img src="([^"]+)" width="(\d+)" alt="([^"]+)">')
ANNOUNCED = re.compile(r"\*(?:Exercises?|Extras?) \d.*")
NUMBER = re.compile(r"\b\d+\.\d+\b")
BOARD = re.compile(r"# live\s+(?:(?:from course import board|board\.show\([^)]*\))\s*)+")


def write(folder, extra):
    """Write the lectures to folder/lectures, their pictures to extra/lectures/pictures.

    ValueError: a figure has no place, or a place no figure.
    """
    added = inserts.Inserts(extra)
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        notebook, lab = nbformat.read(path, as_version=4), int(path.stem[:2])
        pictures = Pictures(path.stem, extra / "lectures" / "pictures")
        cells, notebook.cells = notebook.cells, []
        for cell in cells:
            if BOARD.fullmatch(cell.source):
                continue
            if cell.cell_type == "markdown":
                text = linked(added.put_in(cell.source), lab)
                cell.source = OPENING.sub(pictures.opening, text)
            for output in cell.get("outputs", []):
                pictures.extract(output)
            notebook.cells.append(cell)
        put(folder / "lectures" / path.name, nbformat.writes(notebook) + "\n")
    added.require_all()


def linked(text, lab):
    """The text of a lab's lecture with its links led to the site's pages, and more links."""
    text = NEIGHBOUR.sub("", text)
    text = LINK.sub(_page_link, text)
    text = ANNOUNCED.sub(lambda found: NUMBER.sub(_exercise, found[0]), text)
    seen = set()
    return CODE.sub(lambda found: _function(found, lab, seen), text)


def _page_link(link):
    path = (ROOT / "notebooks" / link[1]).resolve().relative_to(ROOT).as_posix()
    page = document(path)
    if page is None:
        raise ValueError(f"a lecture leads to {link[1]}, which is no page of the site")
    return f"]({page}{link[2] or ''})"


def _exercise(number):
    address = exercise_pages().get(number[0])
    return f'<a href="../{address}">{number[0]}</a>' if address else number[0]


def _function(name, lab, seen):
    """The first of a cell's `crossing` leads to its place in the source."""
    address = function_page(name[1], lab)
    if address is None or name[1] in seen:
        return name[0]
    seen.add(name[1])
    return f'<a class="function" href="../{address}"><code>{name[1]}</code></a>'


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
        put(self.folder / f"{name}.png", content)
        opened = Image.open(io.BytesIO(content))
        height = round(opened.height * width / opened.width)
        still, kind = name, 'class="drawn"'
        if getattr(opened, "is_animated", False):
            still, kind = f"{name}_still", (
                f'class="animation" data-file="pictures/{name}.png" '
                f'data-frames="{frame_count(content)}"')
            put(self.folder / f"{still}.png", poster(content))
        return (f"<figure {kind}>{picture(f'pictures/{still}.png', words, width, height)}"
                "</figure>")
