"""Links of the course's own texts, made links of the site.

A text in the repository links to files beside it: `[renderers.py](renderers.py)`. What has a page
becomes a link to this page. The name of any other file is left, as code.
"""
import os
import re

from course.given.places import ROOT

from . import put
from .names import function_page, page_of_file

LINK = re.compile(r"\[([^\[\]]+)\]\(([^()\s]+)\)")
CODE = re.compile(r"(?<!`)`(?:(\w+)\.)?(\w+)`(?![`\w])")


def write(folder, lite):
    """Write the pages of site/texts: what they name of reference/ leads to its place there.

    lite: the labs in the browser are there, and their page.
    """
    for path in sorted((ROOT / "site" / "texts").glob("*.md")):
        if lite or path.stem != "in_the_browser":
            put(folder / path.name, named(path.read_text("utf-8")))


def named(text):
    """A text with links from the functions that it names to their places in reference/."""
    return CODE.sub(_function, text)


def mapped(text, place):
    """Markdown of a file in the folder `place` of the repository, with the site's links."""
    return LINK.sub(lambda link: _led(link, place), text)


def _led(link, place):
    label, target = link.groups()
    if "://" in target or target.startswith(("#", "/")):
        return link[0]
    page = page_of_file(os.path.normpath(f"{place}/{target}").replace(os.sep, "/"))
    if page is None:
        return label if "`" in label else f"`{label}`"
    return f"[{label}](/{page}{'.ipynb' if page.startswith('lectures/') else '.md'})"


def _function(name):
    module, function = name.groups()
    address = function_page(function, lab=None)
    if module and (ROOT / "reference" / f"{module}.py").exists():
        address = f"reference/{module}.html#reference.{module}.{function}"
    if address is None:
        return name[0]
    return f'<a class="function" href="{address}"><code>{name[0].strip("`")}</code></a>'
