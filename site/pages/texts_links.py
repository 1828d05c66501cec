"""The course's own texts as pages: their links, and their pictures, become the site's.

A text in the repository links to files beside it: `[renderers.py](renderers.py)`. What has a page
becomes a link to this page. Of a link to any other file the label is left, as code.
"""
import posixpath
import re

from course.given import image
from labkit.places import ROOT

from . import picture, put
from .names import TEXTS, function_page, page_of_file

PICTURE = re.compile(r"!\[([^]]*)\]\((\w+\.png)\)")
LINK = re.compile(r"\[([^\[\]]+)\]\(([^()\s]+)\)")
CODE = re.compile(r"(?<![`[])`((?:\w+\.)?\w+)`(?![`\w])")
GLOSSARY = "```{glossary}\n"


def write(folder, extra):
    """Write the pages of site/texts and of the repository's texts, and their pictures to extra."""
    for source, name in TEXTS.items():
        place, text = posixpath.dirname(source), (ROOT / source).read_text("utf-8")
        put(folder / f"{name}.md", with_page_links(with_pictures(text, place, extra), place))
    for path in sorted((ROOT / "site" / "texts").glob("*.md")):
        text = linked(path.read_text("utf-8"), "site/texts")
        put(folder / path.name, text.replace(GLOSSARY, letters(text) + GLOSSARY))


def with_pictures(text, place, extra):
    """A text of the folder `place`, whose pictures are copied to extra."""
    def shown(found):
        words, file = found.groups()
        put(extra / file, (ROOT / place / file).read_bytes())
        one = picture(file, " ".join(words.split()), *image.size(extra / file))
        return f'<figure class="drawn">{one}</figure>'

    return PICTURE.sub(shown, text)


def letters(text):
    """A row of letters, each a link to the glossary's first word that begins with it."""
    words = re.findall(r"^\w.*", text.partition(GLOSSARY)[2], re.MULTILINE)
    first = {word[0].upper(): word for word in reversed(words)}
    row = " ".join(f"{{term}}`{letter} <{first[letter]}>`" for letter in sorted(first))
    return f"{{.letters}}\n{row}\n\n"


def linked(text, place):
    """Markdown of a file in the folder `place`, with links to pages and to functions of reference/.
    """
    return "\n\n".join(map(_with_functions, with_page_links(text, place).split("\n\n")))


def with_page_links(text, place):
    """Markdown of a file in the folder `place` of the repository, with links to pages."""
    def page_link(link):
        label, target = link.groups()
        if "://" in target or target.startswith(("#", "/")):
            return link[0]
        path, mark, section = target.partition("#")
        page = page_of_file(posixpath.normpath(f"{place}/{path}"))
        if not page:
            return f"`{label.strip('`')}`"
        ending = ".ipynb" if page.startswith("lectures/") else ".md"
        return f"[{label}](/{page}{ending}{mark}{section})"

    return LINK.sub(page_link, text)


def _with_functions(paragraph):
    """The functions of reference/ that a paragraph names are links, each once."""
    seen = set()

    def link(name):
        address = function_page(name[1], lab=0)
        if not address or address in seen:
            return name[0]
        seen.add(address)
        return f'<a class="function" href="{address}"><code>{name[1]}</code></a>'

    return CODE.sub(link, paragraph)
