"""The front page, from README.md, and the tree of all pages."""
import html
import re

from course import exercises
from course.given import image
from course.given.places import DATA, ROOT, read_whole

from . import put
from .names import lab_page
from .posters import frame_count, poster
from .texts_links import with_page_links

DOORS = {"Students": "labs/index", "Instructors": "instructors", "Readers": "reference/index"}
CARDS = """\
::::{{grid}} 1 1 3 3
:gutter: 3

{cards}
::::
"""
CARD = """\
:::{{grid-item-card}} {title}
:link: /{page}
:link-type: doc

{text}
:::
"""
TREE = """
```{{toctree}}
:hidden:
:caption: {caption}

{pages}
```
"""
FILM = """\
<figure class="animation" data-file="reconstruction.png" data-frames="{frames}" data-autoplay>
<img src="reconstruction_still.png" alt="{words}" width="{width}" height="{height}">
</figure>
"""
LINK = re.compile(r"\[([^]]*)\]\([^)]+\)")


def write(folder, extra, lite):
    """Write folder/index.md, and its film to extra. lite: the labs in the browser are there."""
    film = read_whole(DATA / "reconstruction.png")
    put(extra / "reconstruction.png", film)
    put(extra / "reconstruction_still.png", poster(film))
    put(folder / "index.md", page((ROOT / "README.md").read_text("utf-8")) +
        "".join(trees(lite)))


def page(readme):
    """README.md -> the front page: the doors stand before the code."""
    opening, *sections = re.split(r"^## ", readme, flags=re.MULTILINE)
    title, _, film, text, code = opening.split("\n\n", 4)
    words = film.removeprefix("![").partition("]")[0]
    sections = {name: body for name, _, body in (part.partition("\n") for part in sections)}
    doors = sections.pop("Three doors")
    width, height = image.size(DATA / "reconstruction.png")
    shown = FILM.format(words=html.escape(words), width=width, height=height,
                        frames=frame_count(read_whole(DATA / "reconstruction.png")))
    parts = [title, shown, text, cards(doors),
             "## A picture and its gradient", code,
             *(f"## {name}\n{body}" for name, body in sections.items())]
    return with_page_links("\n\n".join(parts), ".")


def cards(doors):
    """The three paragraphs about students, instructors and readers, as cards."""
    found = re.findall(r"\*\*(\w+)\*\* (.*?)(?=\n\n\*\*|\Z)", doors.strip(), re.DOTALL)
    return CARDS.format(cards="\n".join(
        CARD.format(title=title, page=DOORS[title],
                    text=LINK.sub(r"\1", text[0].upper() + text[1:])) for title, text in found))


def trees(lite):
    """What stands in the margin of every page."""
    lectures = [f"lectures/{path.stem}" for path in sorted((ROOT / "notebooks").glob("*.ipynb"))]
    labs = [lab_page(topics[0]) for topics in exercises.LABS]
    groups = {"Lectures": lectures, "Labs": ["labs/index", *labs],
              "Code": ["reference/index", "given/index", "benchmarks"],
              "More": ["own_pictures", "real_projects", "instructors", "errata", "glossary",
                       "bibliography"]}
    if lite:
        groups["Labs"].append("in_the_browser")
    for caption, pages in groups.items():
        yield TREE.format(caption=caption, pages="\n".join(pages))
