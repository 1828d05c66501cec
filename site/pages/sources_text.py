"""A docstring becomes a part of a page. Its letters are kept, whatever they mean to Sphinx.

Docstrings are plain text. A paragraph that names an equation of its lecture is followed by the
equation, typeset.
"""
import ast
import html
import re
import textwrap

FENCE = "``````"
EQUATION = r"(?<![\w)])\((\d{1,2})\)"
RANGE = re.compile(rf"{EQUATION} to {EQUATION}")


def docstring(course, module, node):
    """-> reStructuredText of the docstring of a module, a function or a class.

    Where a module's table of equations is nothing else, they stand there typeset.
    """
    known, parts, seen = course.equations(module), [], set()
    own = {part.arg for part in ast.walk(node) if isinstance(part, ast.arg)}
    for paragraph in paragraphs(ast.get_docstring(node)):
        if not is_typeset(paragraph, known):
            parts.append(block(course, module, paragraph, own))
        if is_table(paragraph) == isinstance(node, ast.Module):
            for number in sorted(named_equations(paragraph) & known.keys() - seen):
                seen.add(number)
                parts.append(f".. math::\n\n    {known[number][1]} \\qquad ({number})")
    return "\n\n".join(parts)


def is_table(paragraph):
    """Is it aligned by hand: further in, or with gaps? An example is not."""
    return bool(re.search(r"^ |\S {3,}\S", paragraph, re.M)) and not paragraph.startswith(">>> ")


def is_typeset(paragraph, equations):
    """Is it a table whose every line is one of these equations, with its number at the end?"""
    numbers = [re.search(r"\((\d+)\)$", line) for line in paragraph.splitlines()]
    return is_table(paragraph) and all(found and int(found[1]) in equations for found in numbers)


def paragraphs(text):
    return re.split(r"\n\s*\n", text.strip()) if text else []


def block(course, module, paragraph, own=()):
    """A paragraph: a worked example, a table or formula, or prose, whose names become links."""
    if paragraph.startswith(">>> "):
        return paragraph
    if is_table(paragraph):
        return f".. code-block:: text\n\n{textwrap.indent(textwrap.dedent(paragraph), '    ')}"
    parts = re.split("`([^`]+)`", " ".join(paragraph.split()))
    parts[::2] = map(escape, parts[::2])
    parts[1::2] = (link(course, module, name, own) for name in parts[1::2])
    return "".join(parts)


def link(course, module, name, own):
    """A name in a docstring is a link, but for the names of a function's own."""
    full = name not in own and (module.names.get(name) or course.find(name, module.lab))
    return rf"\ :py:obj:`{name} <{full}>`\ " if full else rf"\ ``{name}``\ "


def named_equations(text):
    """The numbers of the equations that a text names, "(1) to (3)" in full."""
    if text.startswith(">>> "):
        return set()
    ranges = (range(int(first), int(last)) for first, last in RANGE.findall(text))
    return {int(number) for number in re.findall(EQUATION, text)}.union(*ranges)


def first_sentence(text):
    """Without its full stop. "Eq. (3)" is no end of a sentence."""
    paragraph = " ".join(paragraphs(text)[0].split())
    return re.match(r"(?:[Ee]qs?\.|[^.?!]|[.?!](?!\s|$))*\??", paragraph)[0]


def escape(text):
    """Plain text in which nothing is markup."""
    return re.sub(r"([!-/:-@\[-`{-~])", r"\\\1", text)


def as_myst(content, directive="{raw} html"):
    """HTML, or the content of another directive, as MyST."""
    return f"\n{FENCE}{directive}\n{content}\n{FENCE}\n"


def in_code(text):
    """Plain text as HTML, what stands in backticks as code."""
    return re.sub("`([^`]+)`", r"<code>\1</code>", html.escape(text, quote=False))


def table(kind, head, rows):
    """head: words. rows: lists of HTML, a cell each. kind: a class, for its style."""
    body = ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows]
    top = "".join(f"<th>{word}</th>" for word in head)
    return as_myst(f'<div class="table-wrapper" tabindex="0"><table class="docutils {kind}">'
                   f"<thead><tr>{top}</tr></thead>\n<tbody>\n" + "\n".join(body)
                   + "\n</tbody></table></div>")
