"""Folded code: a line of words that opens it, which is also what a screen reader says."""
import html

from myst_nb.sphinx_ import HideCodeCellNode


def begin(translator, node):
    words = html.escape(node["prompt_show"])
    translator.body.append(f'<details class="fold"><summary>{words}</summary>\n')


def end(translator, node):
    translator.body.append("</details>\n")


def setup(app):
    app.add_node(HideCodeCellNode, override=True, html=(begin, end))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
