"""For search engines and chats: what a page is about."""
import ast
import html
import re
import textwrap

from docutils import nodes

from labkit.places import ROOT

from .names import PAGES

LEAST, MOST = 50, 220  # characters
TAG = re.compile(r"<[^>]+>")


def setup(app):
    app.connect("html-page-context", describe, priority=400)  # before sphinxext.opengraph
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def describe(app, page, template, context, doctree):
    """Give a page of text its description: its first words, or its module's."""
    if doctree is None:
        return
    words = html.escape(textwrap.shorten(first_words(page, doctree), MOST, placeholder=" …"))
    context["meta"] = {**(context["meta"] or {}), "og:description": words}
    context["metatags"] += f'<meta name="description" content="{words}">\n'


def first_words(page, doctree):
    """A module's first words, or else the first paragraph that is long and no row of links."""
    shown, _, stem = page.partition("/")
    for folder in (folder for folder, pages in PAGES.items() if pages == shown):
        module = ROOT / folder / f"{stem}.py"
        if module.exists():
            return ast.get_docstring(ast.parse(module.read_text("utf-8"))).partition("\n\n")[0]
    texts = (TAG.sub("", part.astext()) for part in doctree.findall(nodes.paragraph))
    return next((text for text in texts if len(text) >= LEAST and "·" not in text), "")
