"""Formulas, set by MathJax when the site is built: a page holds drawings, and no script for them.

MathJax's own files come with the package sphinx-mathjax-offline, and run in V8. A formula that
MathJax cannot read ends the build. Screen readers get the same formula as MathML.
"""
import functools
import html
import json
import os
import re
from importlib.metadata import distribution

from docutils.nodes import SkipNode
from py_mini_racer import MiniRacer
from sphinx.errors import SphinxError

PARTS = ("core", "input/tex-full", "output/svg", "output/svg/fonts/tex", "adaptors/liteDOM",
         "a11y/assistive-mml")
START = """
var MathJax = {loader: {load: PARTS, paths: {mathjax: ""},
                        require: name => (0, eval)(FILES[name.slice(1)])},
               startup: {typeset: false}, svg: {fontCache: "local"}};
var global = this;
"""
SET = """
function set(tex, display) {
  const drawing = MathJax.tex2svg(tex, {display});
  return MathJax.startup.adaptor.outerHTML(drawing);
}
function style() {
  return MathJax.startup.adaptor.textContent(MathJax.svgStylesheet());
}
"""
GLYPH = re.compile(r'<path id="MJX-\d+-(\S+)" d="([^"]*)"></path>')
UNUSED = re.compile(r' (?:data-\S+|xmlns(?::\S+)?|focusable|jax|unselectable)="[^"]*"')
TAG = re.compile(r"\\tag\{(\w+)\}")


@functools.cache
def mathjax(process):
    """MathJax, started once in each process. process: its number, so that a fork has its own."""
    folder = distribution("sphinx-mathjax-offline").locate_file(
        "sphinx-mathjax-offline/static/mathjax")
    files = {f"{part}.js": (folder / f"{part}.js").read_text("utf-8") for part in PARTS}
    engine = MiniRacer()
    engine.eval(f"var PARTS = {json.dumps(PARTS)}, FILES = {json.dumps(files)};{START}")
    engine.eval((folder / "startup.js").read_text("utf-8"))
    engine.eval(SET)
    return engine


@functools.lru_cache(4096)
def formula(tex, display):
    """The drawing of a formula. ValueError: MathJax cannot read it."""
    drawing = mathjax(os.getpid()).call("set", tex, display)
    if "merror" in drawing:
        raise ValueError(f"MathJax cannot read the formula {tex!r}")
    return UNUSED.sub("", drawing).replace("xlink:href", "href")


def style():
    """The rules that the drawings need, as CSS."""
    return mathjax(os.getpid()).call("style")


def inline(translator, node):
    translator.body.append(_drawn(node, display=False))
    raise SkipNode


def block(translator, node):
    """A displayed formula. The one with the tag 3 is the target #equation-3."""
    tag = TAG.search(node.astext())
    name = f' id="equation-{tag[1]}"' if tag else ""
    drawing = _drawn(node, display=True)
    translator.body.append(f'<div class="math notranslate"{name}>{drawing}</div>\n')
    raise SkipNode


def _drawn(node, display):
    try:
        return formula(node.astext(), display)
    except ValueError as error:
        raise SphinxError(f"{node.source}: {error}") from None


def share_glyphs(app, page, template, context, doctree):
    """Each glyph is drawn once on a page, at its end, and used wherever a formula needs it."""
    body = context.get("body")
    if not body or "MJX-" not in body:
        return
    glyphs = dict(GLYPH.findall(body))
    body = re.sub(r"<defs>(?:<path[^>]*></path>)*</defs>", "", body)
    body = re.sub(r'"#MJX-\d+-', '"#', body)
    paths = "".join(f'<path id="{html.escape(name)}" d="{shape}"/>'
                    for name, shape in glyphs.items())
    context["body"] = f'{body}<svg class="glyphs" aria-hidden="true">{paths}</svg>'


def setup(app):
    app.add_html_math_renderer("drawn", (inline, None), (block, None))
    app.connect("html-page-context", share_glyphs)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
