"""What the site adds to the lectures: figures that answer, pairs of pictures, meshes to turn.

A lecture's paragraph says what there is to touch, and links to this site with its name:

    **Drag vertex 2** ([on the site](../site/README.md#edge_functions)), until two triangles ...

On the site the link goes, and what it names stands below the paragraph.
"""
import re

from course.given.places import ROOT

from . import comparisons, meshes, waves

FIGURES = ROOT / "site" / "static" / "figures"
LINK = re.compile(r" \(\[[^]]*\]\(\.\./site/README\.md#(\w+)\)\)")


class Inserts:
    """All of them, by name, each with its place in one lecture."""

    def __init__(self, extra):
        """Write their files to extra."""
        self.placed = []
        waves.write(extra)
        self.made = {**meshes.write(extra), **comparisons.write(extra)}

    def put_in(self, text):
        """A lecture's Markdown with the HTML of what its paragraphs name.

        ValueError: there is none of this name.
        """
        return "\n\n".join(map(self._with_figure, text.split("\n\n")))

    def _with_figure(self, paragraph):
        named = LINK.findall(paragraph)
        return "\n\n".join([LINK.sub("", paragraph), *map(self._html, named)])

    def _html(self, name):
        self.placed.append(name)
        if name in self.made:
            return self.made[name]
        if not (FIGURES / f"{name}.js").exists():
            raise ValueError(f"a lecture names the figure {name}, and site/static/figures has "
                             f"none: it has {', '.join(answering())}")
        return f'<div class="answers" id="figure-{name}" data-figure="{name}"></div>'

    def require_all(self):
        """ValueError: one has no place."""
        for name in {*self.made, *answering()}.difference(self.placed):
            raise ValueError(f"no lecture has a place for {name}: let a paragraph of one link to "
                             f"../site/README.md#{name}")


def answering():
    """The names of the figures that answer."""
    return sorted(path.stem for path in FIGURES.glob("*.js")
                  if "export function show(" in path.read_text("utf-8"))
