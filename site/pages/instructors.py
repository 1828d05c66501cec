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
        place = (ROOT / source).parent
        text = with_pictures((ROOT / source).read_text("utf-8"), place, extra)
        put(folder / name, with_page_links(text, source.rpartition("/")[0]))


def with_pictures(text, place, extra):
    """A text of the folder `place`, whose pictures are copied to extra."""
    def shown(found):
        words, file = found.groups()
        put(extra / file, (place / file).read_bytes())
        one = picture(file, " ".join(words.split()), *image.size(extra / file))
        return f'<figure class="drawn">{one}</figure>'

    return PICTURE.sub(shown, text)
