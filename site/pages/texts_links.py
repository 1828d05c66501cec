"""Links of the course's own texts, made links of the site.

A text in the repository links to files beside it: `[renderers.py](renderers.py)`. What has a page
becomes a link to this page. Of a link to any other file the label is left, as code.
"""
import posixpath
import re

from course.given.places import ROOT

from . import put
from .names import document, function_page

LINK = re.compile(r"\[([^\[\]]+)\]\(([^()\s]+)\)")
CODE = re.compile(r"(?<!`)`(?:(\w+)\.)?(\w+)`(?![`\w])")


def write(folder, lite):
    """Write the pages of site/texts: what they name of reference/ leads to its place there.

    lite: the labs in the browser are there, and their page.
    """
    for path in sorted((ROOT / "site" / "texts").glob("*.md")):
        if lite or path.stem != "in_the_browser":
            put(folder / path.name, with_function_links(path.read_text("utf-8")))


def with_function_links(text):
    """A text with links from the functions that it names to their places in reference/."""
    return CODE.sub(_function, text)


def with_page_links(text, place):
    """Markdown of a file in the folder `place` of the repository, with the site's links."""
    return LINK.sub(lambda link: _page_link(link, place), text)


def _page_link(link, place):
    label, target = link.groups()
    if "://" in target or target.startswith(("#", "/")):
        return link[0]
    path, mark, section = target.partition("#")
    page = document(posixpath.normpath(f"{place}/{path}"))
    if page is None:
        return label if "`" in label else f"`{label}`"
    return f"[{label}]({page}{mark}{section})"


def _function(name):
    module, function = name.groups()
    address = function_page(function, lab=None)
    if module and (ROOT / "reference" / f"{module}.py").exists():
        address = f"reference/{module}.html#reference.{module}.{function}"
    if address is None:
        return name[0]
    return f'<a class="function" href="{address}"><code>{name[0].strip("`")}</code></a>'
