"""Guides and errata: texts of the repository, with the site's links, and their pictures."""
import posixpath
import re

from course.given import image
from course.given.places import ROOT

from . import picture, put
from .names import TEXTS
from .texts_links import with_page_links

PICTURE = re.compile(r"!\[([^]]*)\]\((\w+\.png)\)")


def write(folder, extra):
    """Write them into a folder, and their pictures to extra."""
    for source, name in TEXTS.items():
        place, text = posixpath.dirname(source), (ROOT / source).read_text("utf-8")
        text = with_pictures(text, ROOT / place, extra)
        put(folder / f"{name}.md", with_page_links(text, place))


def with_pictures(text, place, extra):
    """A text of the folder `place`, whose pictures are copied to extra."""
    def shown(found):
        words, file = found.groups()
        put(extra / file, (place / file).read_bytes())
        one = picture(file, " ".join(words.split()), *image.size(extra / file))
        return f'<figure class="drawn">{one}</figure>'

    return PICTURE.sub(shown, text)
