"""What the site adds to the lectures: figures that answer, films of pairs, meshes that turn.

A lecture's paragraph says what there is to touch, and links to this site with its name:

    **[On the site](../site/README.md#edge_functions)** drag vertex 2, until two triangles ...
    **Drag vertex 2** ([on the site](../site/README.md#edge_functions)), until two triangles ...

On the site the first reads "**Here** drag vertex 2", the second loses its link, and what they name
stands below the paragraph.
"""
import re

from labkit.places import ROOT

from . import turntables

FIGURES = ROOT / "site" / "static" / "figures"
LINK = re.compile(r"(?: \()?\[[^]]*\]\(\.\./site/README\.md#(\w+)\)\)?")


class Inserts:
    """made: {name: HTML} of all of them. Each has its place in one lecture."""

    def __init__(self, extra):
        """Write their files to extra."""
        self.placed = set()
        self.made = {**turntables.write(extra), **answering()}

    def put_in(self, text):
        """A lecture's Markdown with the HTML of what its paragraphs name.

        ValueError: there is none of this name.
        """
        return "\n\n".join(map(self._with_figure, text.split("\n\n")))

    def _with_figure(self, paragraph):
        named = LINK.findall(paragraph)
        self.placed.update(named)
        if missing := [name for name in named if name not in self.made]:
            raise ValueError(f"a lecture names the figure {missing[0]}, and site/static/figures "
                             f"has none: it has {', '.join(answering())}")
        here = LINK.sub(lambda link: "Here" if link[0].startswith("[") else "", paragraph)
        return "\n\n".join([here, *map(self.made.get, named)])

    def require_all(self):
        """ValueError: one has no place."""
        for name in self.made.keys() - self.placed:
            raise ValueError(f"no lecture has a place for {name}: let a paragraph of one link to "
                             f"../site/README.md#{name}")


def answering():
    """{name: HTML} of the figures that answer."""
    return {path.stem: f'<div class="answers" id="figure-{path.stem}" data-figure="{path.stem}">'
                       "</div>" for path in sorted(FIGURES.glob("*.js"))
            if "export function show(" in path.read_text("utf-8")}
