"""Guides and errata: texts of the repository, with the site's links, and their pictures."""
import re

from course.given import image
from course.given.places import ROOT

from . import picture, put
from .texts_links import with_page_links

TEXTS = {"instructors.md": "course/grading/README.md", "errata.md": "notebooks/errata.md",
         "own_pictures.md": "course/experiments/folder/README.md",
         "real_projects.md": "course/bridge/README.md"}
PICTURE = re.compile(r"!\[([^]]*)\]\((\w+\.png)\)")


def write(folder, extra):
    """Write them into a folder, and their pictures to extra."""
    for name, source in TEXTS.items():
        place = source.rpartition("/")[0]

        def shown(found, place=place):
            words, file = found.groups()
            put(extra / file, (ROOT / place / file).read_bytes())
            return picture(file, words, *image.size(extra / file))

        text = PICTURE.sub(shown, (ROOT / source).read_text("utf-8"))
        put(folder / name, with_page_links(text, place))
