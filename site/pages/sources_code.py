"""A module's code as HTML: in colours, each line with its number, each name a link to its place."""
import ast
import builtins
import html
import io
import keyword
import tokenize
from typing import NamedTuple

COLOURS = {tokenize.COMMENT: "c1", tokenize.NUMBER: "mf", tokenize.OP: "o"}
STRINGS = [kind for kind, name in tokenize.tok_name.items() if "STRING" in name]
PLAIN = tuple("()[]{},:.;")
EMPTY = (tokenize.NEWLINE, tokenize.NL, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER)


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
    rows = [f'<span class="line" id="line-{n}"><a href="#line-{n}" data-line="{n}" tabindex="-1" '
            f'aria-label="line {n}"></a>{lines[n - 1]}</span>' for n in shown]
    return '<div class="highlight code"><pre tabindex="0">' + "\n".join(rows) + "\n</pre></div>"


def html_lines(course, module):
    """The lines of a module as HTML, in the colours of Pygments' style, with links."""
    links, parts, before = course.uses[module.name], [], "\n"
    lines, (row, column) = module.text.splitlines(keepends=True), (1, 0)
    for token in tokenize.generate_tokens(io.StringIO(module.text).readline):
        if token.type in EMPTY or token.start < (row, column):
            continue
        gap = "".join(lines[row - 1:token.start[0]])
        parts.append(gap[column:len(gap) - len(lines[token.start[0] - 1]) + token.start[1]])
        text, full = coloured(token, before), links.get(token.start)
        parts.append(f'<a href="{course.address(full)}">{text}</a>' if full else text)
        (row, column), before = token.end, token.string
    return "".join(parts).split("\n")


def coloured(token, before):
    """A token as HTML. A string of several lines is one span for each. before: the last token."""
    text, kind = html.escape(token.string, quote=False), colour(token, before)
    return "\n".join(f'<span class="{kind}">{line}</span>' for line in text.split("\n")) \
        if kind else text


def colour(token, before):
    """The name that Pygments' style sheets have for a kind of token. "" for plain ones."""
    if token.type == tokenize.NAME:
        if before in ("def", "class"):
            return {"def": "nf", "class": "nc"}[before]
        if token.string in ("and", "or", "not", "in", "is"):
            return "ow"
        if keyword.iskeyword(token.string):
            return "kc" if token.string[0].isupper() else "k"
        return "nb" if hasattr(builtins, token.string) and before != "." else ""
    if token.string in PLAIN:
        return ""
    return COLOURS.get(token.type, "s2" if token.type in STRINGS else "")
