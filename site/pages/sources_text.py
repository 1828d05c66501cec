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

from course import exercises

from . import put
from .names import exercise_pages
from .sources_code import highlighted

PYCON = lexers.get_lexer_by_name("pycon")
FENCE = "``````"
EQUATION = r"(?<![\w)])\((\d{1,2})\)"
RANGE = re.compile(rf"{EQUATION} to {EQUATION}")
# "GAMES101 lecture 6" is of another course.
INLINE = re.compile(rf"`(?P<code>[^`]+)`|(?:\b[Ee]q\. )?{EQUATION}|\b(?P<file>\w+)\.py\b|"
                    r"(?<!GAMES101 )\b(?P<kind>[Ll]ab|[Ll]ecture) (?P<lab>\d+)\b")


def docstring(course, module, text, own=(), is_module=False):
    """-> MyST of a docstring. own: names that are the function's own, such as its parameters.

    A module's equations are typeset below its table of them, a function's below what names them.
    """
    seen, parts, is_folded = set(), [], False
    for rank, paragraph in enumerate(paragraphs(text)):
        if paragraph.startswith("Fine print."):
            parts.append('<details class="fine-print"><summary>Fine print.</summary>')
            paragraph, is_folded = paragraph.removeprefix("Fine print.").strip(), True
        parts.append(block(course, module, paragraph, own, is_first=rank == 0))
        if is_module == is_table(paragraph):
            new = [number for number in named_equations(paragraph)
                   if number in course.equations(module) and number not in seen]
            seen.update(new)
            for number in sorted(new):
                parts += equation(course, module, number)
    if is_folded:
        parts.append("</details>")
    return "".join(map(as_myst, parts))


def is_table(paragraph):
    """Is it aligned by hand: further in, or with gaps? An example is not."""
    return bool(re.search(r"^ |\S {3,}\S", paragraph, re.M)) and not paragraph.startswith(">>> ")


def paragraphs(text):
    return re.split(r"\n(?:[ ]*\n)+", text.strip("\n").rstrip())


def as_myst(part):
    """HTML as MyST. What is MyST already, a tuple's name and content, is a directive."""
    name, content = part if isinstance(part, tuple) else ("{raw} html", part)
    return f"\n{FENCE}{name}\n{content}\n{FENCE}\n"


def block(course, module, paragraph, own=(), is_first=False):
    """One paragraph of a docstring as HTML: a worked example, a table or formula, or prose."""
    if paragraph.startswith(">>> "):
        return listing(example(paragraph), "example")
    if is_table(paragraph):
        return listing(html.escape(textwrap.dedent(paragraph), quote=False), "table")
    kind = ' class="question"' if is_first else ""
    return f"<p{kind}>{inline(course, module, paragraph, own)}</p>"


def listing(text, kind):
    return (f'<div class="highlight {kind}"><pre tabindex="0">{text}\n</pre></div>')


@functools.cache
def example(text):
    """A doctest as HTML. What is typed may wrap."""
    lines = zip(highlighted(PYCON, text).split("\n"), text.split("\n"), strict=True)
    return "\n".join(f'<span class="typed">{line}</span>' if plain.startswith((">>>", "..."))
                     else line for line, plain in lines)


def table(kind, head, rows):
    """head: words. rows: lists of HTML, a cell each. kind: a class, for its style."""
    body = ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows]
    top = "".join(f"<th>{word}</th>" for word in head)
    return as_myst(f'<div class="table-wrapper" tabindex="0"><table class="docutils {kind}">'
                   f"<thead><tr>{top}</tr></thead>\n<tbody>\n" + "\n".join(body)
                   + "\n</tbody></table></div>")


def named_equations(text):
    """The numbers of the equations that a text names, "(1) to (3)" in full."""
    if text.startswith(">>> "):
        return []
    whole = RANGE.sub(lambda ends: " ".join(f"({n})" for n in range(int(ends[1]),
                                                                    int(ends[2]) + 1)), text)
    return list(dict.fromkeys(map(int, re.findall(EQUATION, whole))))


def equation(course, module, number):
    """An equation of the module's lecture, typeset, and its number as a link to it."""
    link = course.equation_address(module, number)
    return ['<div class="equation">', ("{math}", course.equations(module)[number]),
            f'<a class="number" href="{link}" title="Equation {number} in its lecture">'
            f"({number})</a></div>"]


def inline(course, module, text, own=()):
    """Prose as HTML: what it names of the course are links."""
    parts, end = [], 0
    for match in INLINE.finditer(text):
        parts += [html.escape(text[end:match.start()], quote=False),
                  link(course, module, match, own)]
        end = match.end()
    whole = "".join(parts) + html.escape(text[end:], quote=False)
    return whole.replace("-&gt;", '<span class="arrow">-&gt;</span>')


def link(course, module, match, own):
    """A match of INLINE as HTML."""
    whole, address = match[0], None
    if match["code"]:
        whole = f"<code>{html.escape(match['code'], quote=False)}</code>"
        address = name_address(course, module, match["code"], own)
    elif match["file"]:
        address = name_address(course, module, match["file"])
    elif match["lab"]:
        address = lab_address(course, match["kind"].lower(), int(match["lab"]))
    elif int(match[2]) in course.equations(module):
        address = course.equation_address(module, int(match[2]))
    return f'<a href="{address}">{whole}</a>' if address else whole


def lab_address(course, kind, lab):
    lecture = course.lectures.get(lab)
    return lecture and f"../{kind}s/{lecture.page}.html"


def name_address(course, module, name, own=()):
    """Where a name that a docstring of this module mentions has its place. None if it has none."""
    if name in own:
        return None
    full = module.names.get(name) or full_name(course, module, name)
    return full and course.address(full)


def full_name(course, module, name):
    """The module, or the function or constant, of this name. Of several, the one of this lab."""
    head, _, tail = name.rpartition(".")
    found = [full for full in course.modules if full == name or full.endswith(f".{name}")]
    for full, other in course.modules.items():
        if tail in other.names and other.names[tail] == f"{full}.{tail}":
            if not head or full == head or full.endswith(f".{head}"):
                found.append(f"{full}.{tail}")
    near = [full for full in found if course.modules.get(full.rpartition(".")[0], module).lab
            == module.lab]
    chosen = near if len(found) > 1 else found
    return chosen[0] if len(chosen) == 1 else None


def first_sentence(text):
    """Without its full stop. "Eq. (3)" is no end of a sentence."""
    paragraph = " ".join(paragraphs(text)[0].split())
    return re.match(r"(?:[Ee]qs?\.|[^.?!]|[.?!](?!\s|$))*\??", paragraph)[0]


def escape(text):
    """Plain text as Markdown in which nothing is markup."""
    return re.sub(r"([!-/:-@\[-`{-~])", r"\\\1", text)


def own_names(node):
    """The names of a function's parameters, or of a class's fields."""
    return {part.arg for part in ast.walk(node) if isinstance(part, ast.arg)}


def badge(exercise):
    """An exercise's mark, as a link to its question on its lab's page."""
    return (f'<a class="badge {kind(exercise)}" href="../{exercise_pages()[exercise.number]}">'
            f"{mark(exercise)}</a>")


def kind(exercise):
    return "extra" if exercise.is_extra else "spine" if exercise.is_spine else "core"


def mark(exercise):
    name = "extra" if exercise.is_extra else "exercise"
    return f"{name} {exercise.number} ({points(exercise.points)}){', spine' * exercise.is_spine}"


def points(count):
    return f"{count} point{'s' * (count != 1)}"


def write_pages(folder, pages):
    """Write {file name: text}."""
    for name, text in pages.items():
        put(folder / name, text)


def lab_title(lab):
    name = exercises.LABS[lab - 1][0].replace("_", " ")
    return f"Lab {lab}: {name}"
