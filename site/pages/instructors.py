"""The instructor's guide and the errata: texts of the repository, with the site's links."""
from course.given.places import ROOT

from . import put
from .texts_links import with_page_links

TEXTS = {"instructors.md": "course/grading/README.md", "errata.md": "notebooks/errata.md"}


def write(folder):
    """Write folder/instructors.md and folder/errata.md."""
    for name, source in TEXTS.items():
        place = source.rpartition("/")[0]
        put(folder / name, with_page_links((ROOT / source).read_text("utf-8"), place))
