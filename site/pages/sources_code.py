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
    """Lines of a module, from first to last, and the statements on them."""

    first: int
    last: int
    kind: str  # "section": comments that stand alone; "code": imports and constants; "definition"
    nodes: tuple = ()


def blocks(module):
    """A module after its docstring, from top to bottom. Imports and constants are one block."""
    lines, found = module.text.splitlines(), []
    statements = (block_of(node, lines) for node in module.tree.body[1:])
    for block in sorted([*sections(module.text), *statements]):
        if block.kind == "code" and found and found[-1].kind == "code":
            found[-1] = found[-1]._replace(last=block.last, nodes=found[-1].nodes + block.nodes)
        else:
            found.append(block)
    return found


def sections(text):
    for comment in re.finditer(r"^(?:#.*\n)+(?=\n)", text, re.MULTILINE):
        first, last = (text.count("\n", 0, place) for place in comment.span())
        yield Block(first + 1, last, "section")


def block_of(node, lines):
    """A statement, with its decorators and the comment right above it."""
    first = min(each.lineno for each in (node, *getattr(node, "decorator_list", ())))
    while lines[first - 2].startswith("#"):
        first -= 1
    is_code = not isinstance(node, ast.FunctionDef | ast.ClassDef)
    return Block(first, node.end_lineno, "code" if is_code else "definition", (node,))


def numbered(lines, first, last, hidden=()):
    """lines: all lines of the file, as HTML. -> those from first to last, without the hidden."""
    shown = [n for n in range(first, last + 1) if n not in hidden]
    rows = [f'<a class="linenos" id="line-{n}" href="#line-{n}" tabindex="-1">{n}</a>'
            + lines[n - 1] for n in shown]
    return listing("\n".join(rows), "code")


def listing(text, kind):
    """HTML that keeps its lines."""
    return f'<div class="highlight {kind}"><pre tabindex="0">{text}\n</pre></div>'


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
