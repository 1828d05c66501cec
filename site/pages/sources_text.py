"""A docstring becomes a part of a page. Its letters are kept, whatever they mean to Markdown.

Docstrings are plain text, so their paragraphs become raw HTML. A paragraph that names an equation
of its lecture is followed by the equation, typeset: a `math` directive.
"""
import ast
import functools
import html
import re
import textwrap

from pygments import lexers

from .sources_code import highlighted, listing
from .sources_course import bound

FENCE = "``````"
EQUATION = r"(?<![\w)])\((\d{1,2})\)"
RANGE = re.compile(rf"{EQUATION} to {EQUATION}")
# "GAMES101 lecture 6" is of another course.
INLINE = re.compile(rf"`(?P<code>[^`]+)`|(?:\b[Ee]q\. )?{EQUATION}|\b(?P<file>\w+)\.py\b|"
                    r"(?<!GAMES101 )\b(?P<kind>[Ll]ab|[Ll]ecture) (?P<lab>\d+)\b")


def docstring(course, module, node):
    """-> MyST of the docstring of a module, a function or a class.

    A module's equations are typeset below its table of them, which is folded where this says all.
    A function's are typeset below what names them.
    """
    is_module, known = isinstance(node, ast.Module), course.equations(module)
    own = set() if is_module else set(bound(node))
    parts, seen, end = [], set(), ""
    for rank, paragraph in enumerate(paragraphs(ast.get_docstring(node))):
        if paragraph.startswith("Fine print."):
            parts.append(as_myst('<details class="fine-print"><summary>Fine print.</summary>'))
            paragraph, end = paragraph.removeprefix("Fine print.").strip(), as_myst("</details>")
        shown = block(course, module, paragraph, own, is_first=rank == 0)
        if is_module and is_typeset(paragraph, known):
            shown = f'<details class="as-typed"><summary>As typed</summary>{shown}</details>'
        parts.append(as_myst(shown))
        if is_module == is_table(paragraph):
            for number in sorted(named_equations(paragraph) & known.keys() - seen):
                seen.add(number)
                parts.append(equation(number, *known[number]))
    return "".join([*parts, end])


def is_table(paragraph):
    """Is it aligned by hand: further in, or with gaps? An example is not."""
    return bool(re.search(r"^ |\S {3,}\S", paragraph, re.M)) and not paragraph.startswith(">>> ")


def is_typeset(paragraph, equations):
    """Is it a table whose every line is one of these equations, with its number at the end?"""
    numbers = [re.search(r"\((\d+)\)$", line) for line in paragraph.splitlines()]
    return is_table(paragraph) and all(found and int(found[1]) in equations for found in numbers)


def paragraphs(text):
    return re.split(r"\n\s*\n", text.strip()) if text else []


def as_myst(content, directive="{raw} html"):
    """HTML, or the content of another directive, as MyST."""
    return f"\n{FENCE}{directive}\n{content}\n{FENCE}\n"


def block(course, module, paragraph, own=(), is_first=False):
    """One paragraph of a docstring as HTML: a worked example, a table or formula, or prose."""
    if paragraph.startswith(">>> "):
        return listing(example(paragraph), "example")
    if is_table(paragraph):
        return listing(html.escape(textwrap.dedent(paragraph), quote=False), "table")
    kind = ' class="question"' if is_first else ""
    return f"<p{kind}>{inline(course, module, paragraph, own)}</p>"


@functools.cache
def example(text):
    """A doctest as HTML. What is typed may wrap."""
    lines = highlighted(lexers.PythonConsoleLexer(), text).split("\n")
    return "\n".join(f'<span class="typed">{line}</span>' if plain.startswith((">>>", "..."))
                     else line for line, plain in zip(lines, text.split("\n"), strict=True))


def named_equations(text):
    """The numbers of the equations that a text names, "(1) to (3)" in full."""
    if text.startswith(">>> "):
        return set()
    ranges = (range(int(first), int(last)) for first, last in RANGE.findall(text))
    return {int(number) for number in re.findall(EQUATION, text)}.union(*ranges)


def equation(number, page, latex):
    """An equation of a lecture's page, typeset, and its number as a link to it."""
    link = (f'<a class="number" href="{equation_address(page, number)}" '
            f'title="Equation {number} in its lecture">({number})</a>')
    return (as_myst('<div class="equation">') + as_myst(latex, "{math}") + as_myst(f"{link}</div>"))


def equation_address(page, number):
    return f"../lectures/{page}.html#equation-{number}"


def inline(course, module, text, own=()):
    """Prose as HTML: what it names of the course are links, but for the names of its own."""
    def linked(match):
        found = address(course, module, match, own)
        code = match["code"]
        shown = f"<code>{code}</code>" if code else match[0]
        return f'<a href="{found}">{shown}</a>' if found else shown

    return INLINE.sub(linked, html.escape(text, quote=False)).replace(
        "-&gt;", '<span class="arrow">-&gt;</span>')


def address(course, module, match, own):
    """Where what a match of INLINE names has its place, or None."""
    if name := match["code"]:
        full = name not in own and (module.names.get(name) or course.find(name, module.lab))
        return full and course.address(full)
    if match["file"]:
        return next((course.address(full) for full, other in course.modules.items()
                     if other.topic == match["file"]), None)
    if match["lab"]:
        lecture = course.lectures.get(int(match["lab"]))
        return lecture and f"../{match['kind'].lower()}s/{lecture.page}.html"
    known = course.equations(module).get(int(match[2]))
    return known and equation_address(known[0], match[2])


def first_sentence(text):
    """Without its full stop. "Eq. (3)" is no end of a sentence."""
    paragraph = " ".join(paragraphs(text)[0].split())
    return re.match(r"(?:[Ee]qs?\.|[^.?!]|[.?!](?!\s|$))*\??", paragraph)[0]


def escape(text):
    """Plain text as Markdown in which nothing is markup."""
    return re.sub(r"([!-/:-@\[-`{-~])", r"\\\1", text)


def table(kind, head, rows):
    """head: words. rows: lists of HTML, a cell each. kind: a class, for its style."""
    body = ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows]
    top = "".join(f"<th>{word}</th>" for word in head)
    return as_myst(f'<div class="table-wrapper" tabindex="0"><table class="docutils {kind}">'
                   f"<thead><tr>{top}</tr></thead>\n<tbody>\n" + "\n".join(body)
                   + "\n</tbody></table></div>")
