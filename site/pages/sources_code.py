"""A module's code as HTML: in colours, each line with its number, each name a link to its place."""
import ast
import itertools
import re
from typing import NamedTuple

import pygments
from pygments import lexers, token
from pygments.formatters import HtmlFormatter

FORMAT = HtmlFormatter(nowrap=True)
COLOURED = (token.Comment, token.Keyword, token.Number, token.String, token.Name.Builtin,
            token.Name.Class, token.Name.Function, token.Operator.Word)
MARK = re.compile("\ue000(.*?)\ue001(.*?)\ue002")  # an address and a name: no code has these


class Block(NamedTuple):
    """Lines of a module, from first to last. node: the function or class, if they are one's."""

    kind: str  # "section": comments that stand alone; "code": imports and constants; "definition"
    first: int
    last: int
    nodes: tuple


def blocks(module):
    """A module after its docstring, from top to bottom. Imports and constants are one block."""
    found, lines = [], module.text.splitlines()
    end = module.tree.body[0].end_lineno
    for node in module.tree.body[1:]:
        first = min([node.lineno, *(each.lineno for each in getattr(node, "decorator_list", ()))])
        for start, last in comments(lines, end, first):
            if lines[last]:  # nothing empty between the comment and what it is about
                first = start
            else:
                found.append(Block("section", start, last, ()))
        kind = "definition" if isinstance(node, ast.FunctionDef | ast.ClassDef) else "code"
        if kind == "code" and found and found[-1].kind == "code":
            found[-1] = found[-1]._replace(last=node.end_lineno, nodes=(*found[-1].nodes, node))
        else:
            found.append(Block(kind, first, node.end_lineno, (node,)))
        end = node.end_lineno
    return found


def comments(lines, end, first):
    """(first, last) of each run of comment lines between the lines end and first."""
    starts = [n for n in range(end + 1, first)
              if lines[n - 1].startswith("#") and not lines[n - 2].startswith("#")]
    for start in starts:
        last = start
        while lines[last].startswith("#"):
            last += 1
        yield start, last


def docstring_lines(node):
    """The lines of a function's docstring, as a range."""
    if not ast.get_docstring(node):
        return range(0)
    return range(node.body[0].lineno, node.body[0].end_lineno + 1)


def listing(lines, first, last, hidden=()):
    """lines: all lines of the file, as HTML. -> those from first to last, without the hidden."""
    shown = [n for n in range(first, last + 1) if n not in hidden]
    while not lines[shown[-1] - 1].strip():
        shown.pop()
    rows = [f'<a class="linenos" id="line-{n}" href="#line-{n}" tabindex="-1">{n}</a>'
            + lines[n - 1] for n in shown]
    return '<div class="highlight code"><pre tabindex="0">' + "\n".join(rows) + "\n</pre></div>"


def html_lines(course, module):
    """The lines of a module as HTML, its names with links."""
    lines = module.text.splitlines(keepends=True)
    starts = list(itertools.accumulate(map(len, lines), initial=0))
    links = {starts[line - 1] + column: course.address(full)
             for (line, column), full in course.uses[module.name].items()}
    return highlighted(lexers.PythonLexer(), module.text, links).split("\n")


def highlighted(lexer, text, links=None):
    """A text as HTML in the classes of Pygments' style. links: {offset of a name: address}."""
    def parts():
        for offset, kind, value in lexer.get_tokens_unprocessed(text):
            kind = next((one for one in COLOURED if kind in one), token.Text)  # that has no element
            address = links and links.get(offset)
            yield kind, f"\ue000{address}\ue001{value}\ue002" if address else value

    return MARK.sub(r'<a href="\1">\2</a>', pygments.format(parts(), FORMAT).rstrip("\n"))
