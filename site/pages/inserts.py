"""What the site adds to the lectures: figures that answer, and meshes that turn.

A lecture's paragraph says what there is to touch, and links to this site with its name. A still of
it, which `site --stills` has made, stands near, in a paragraph of its own:

    **[On the site](../site/README.md#edge_functions)** drag vertex 2, until two triangles ...
    **Drag vertex 2** ([on the site](../site/README.md#edge_functions)), until two triangles ...

    <a href="../site/README.md#edge_functions"><img src="stills/edge_functions.webp" width="736"
    alt="..."></a>  (in one line)

On the site the first reads "**Here** drag vertex 2", the second loses its link, and what they name
takes the still's place. On paper, and where no script runs, a figure that answers is the still.
"""
import html
import re

from course.given import image
from labkit.places import ROOT

from . import picture, put, turntables

FIGURES = ROOT / "site" / "static" / "figures"
LINK = re.compile(r"(?: \()?\[[^]]*\]\(\.\./site/README\.md#(\w+)\)\)?")
STILL = re.compile(r'<a href="\.\./site/README\.md#(\w+)"><img src="(stills/\1\.webp)" '
                   r'width="\d+" alt="([^"]+)"></a>')


class Inserts:
    """made: {name: HTML} of all of them. Each has its place in one lecture."""

    def __init__(self, extra):
        """Write their files to extra."""
        self.extra, self.placed = extra, set()
        self.made = {**turntables.write(extra), **answering()}

    def put_in(self, text):
        """A lecture's Markdown with the HTML of what its paragraphs name.

        ValueError: there is none of this name.
        """
        if missing := [name for name in LINK.findall(text) if name not in self.made]:
            raise ValueError(f"a lecture names the figure {missing[0]}, and site/static/figures "
                             f"has none: it has {', '.join(answering())}")
        here = LINK.sub(lambda link: "Here" if link[0].startswith("[") else "", text)
        return STILL.sub(self._figure, here)

    def _figure(self, still):
        """What takes a still's place. Of a film the site has a still already."""
        name, file, words = still.groups()
        self.placed.add(name)
        path = ROOT / "notebooks" / file
        if name in turntables.TURNED or not path.exists():
            return self.made[name]
        put(self.extra / "lectures" / file, path.read_bytes())
        return self.made[name] + picture(file, html.unescape(words), *image.size(path),
                                         ' class="still"')

    def require_all(self):
        """ValueError: one has no place."""
        for name in self.made.keys() - self.placed:
            raise ValueError(f"no lecture has a place for {name}: let a paragraph of one be the "
                             f'still, <a href="../site/README.md#{name}"><img src="stills/{name}'
                             '.webp" width="..." alt="..."></a>')


def answering():
    """{name: HTML} of the figures that answer."""
    return {path.stem: f'<div class="answers" id="figure-{path.stem}" data-figure="{path.stem}">'
                       "</div>" for path in sorted(FIGURES.glob("*.js"))
            if "export function show(" in path.read_text("utf-8")}
