"""Formulas as MathML, which browsers set and screen readers read: a page needs no script for them.

MathJax reads the TeX when the site is built. Its files come with the package
sphinx-mathjax-offline, and run in V8. A formula that it cannot read ends the build.
"""
import atexit
import functools
import json
import os
import re
from importlib.metadata import distribution

from docutils.nodes import SkipNode
from py_mini_racer import MiniRacer
from sphinx.errors import SphinxError

PARTS = "core", "input/tex-base", "input/tex/extensions/ams", "adaptors/liteDOM"
START = """
var MathJax = {loader: {load: PARTS, paths: {mathjax: ""},
                        require: name => (0, eval)(FILES[name.slice(1)])},
               startup: {typeset: false}, tex: {packages: ["base", "ams"]}};
var global = this;
"""
UNUSED = re.compile(r' (?:data-\S+|xmlns)="[^"]*"|(?<=>)\s+(?=<)')
PLUS_EQUALS = "<mrow><mo>+</mo></mrow><mo>=</mo>", "<mo>+=</mo>"  # without a gap between the two
TAG = re.compile(r"\\tag\{(\w+)\}")


@functools.cache
def mathjax(process):
    """MathJax, started once in each process. process: its number, so that a fork has its own."""
    folder = distribution("sphinx-mathjax-offline").locate_file(
        "sphinx-mathjax-offline/static/mathjax")
    files = {f"{part}.js": (folder / f"{part}.js").read_text("utf-8") for part in PARTS}
    engine = MiniRacer()
    atexit.register(engine.close)  # later, when threads are gone already, it may wait for ever
    engine.eval(f"var PARTS = {json.dumps(PARTS)}, FILES = {json.dumps(files)};{START}")
    engine.eval((folder / "startup.js").read_text("utf-8"))
    engine.eval("function set(tex, display) { return MathJax.tex2mml(tex, {display}); }")
    return engine


@functools.lru_cache(4096)
def formula(tex, display):
    """A formula as MathML. ValueError: MathJax cannot read it."""
    found = mathjax(os.getpid()).call("set", tex, display)
    if "merror" in found:
        raise ValueError(f"MathJax cannot read the formula {tex!r}")
    return UNUSED.sub("", found).replace(*PLUS_EQUALS)


def inline(translator, node):
    translator.body.append(_set(node, node.astext(), display=False))
    raise SkipNode


def block(translator, node):
    """A displayed formula. The one with the tag 3 is the target #equation-3."""
    tex, tag = node.astext(), TAG.search(node.astext())
    name = f' id="equation-{tag[1]}"' if tag else ""
    number = f'<span class="eqno">({tag[1]})</span>' if tag else ""
    shown = _set(node, TAG.sub("", tex), display=True)
    translator.body.append(f'<div class="math notranslate"{name}>{shown}{number}</div>\n')
    raise SkipNode


def _set(node, tex, display):
    try:
        return formula(tex, display)
    except ValueError as error:
        raise SphinxError(f"{node.source}: {error}") from None


def setup(app):
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
