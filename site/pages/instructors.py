"""Guides and errata: texts of the repository, with the site's links."""
from course.given.places import ROOT

from . import put
from .texts_links import with_page_links

TEXTS = {"instructors.md": "course/grading/README.md", "errata.md": "notebooks/errata.md",
         "own_pictures.md": "course/experiments/folder/README.md"}


def write(folder):
    """Write them into a folder."""
    for name, source in TEXTS.items():
        place = source.rpartition("/")[0]
        put(folder / name, with_page_links((ROOT / source).read_text("utf-8"), place))
