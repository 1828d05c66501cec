"""The annotated source: each module of reference/ and course/given/, its docstrings as prose.

A function is a `py:function` of Sphinx, so it is in the index, in the search and in references.
Beside its docstring stands its code, with the numbers of its lines in the file.
"""
import ast

from . import put, sources_course
from .names import exercise_pages, kind, lab_title, mark
from .sources_code import blocks, html_lines, numbered
from .sources_text import as_myst, docstring, escape, first_sentence, inline, table

ABOUT = {
    "reference": ("The annotated source", "The complete code of the labs: every function with its "
                  "question, its equations, its worked example and its answer."),
    "given": ("Given code", "What the labs and the lectures use: meshes, pictures, plots, inputs, "
              "and the check of gradients."),
}
HIDE_CONTENTS = "---\nhide-toc: true\n---\n"


def write(folder):
    """Write folder/reference and folder/given: a page for each module, and an index of each."""
    course = sources_course.read()
    for name in ABOUT:
        modules = [module for module in course.modules.values() if module.folder == name]
        put(folder / name / "index.md", index(course, name, modules))
        for module in modules:
            put(folder / name / f"{module.topic}.md", page(course, module))


def index(course, name, modules):
    """The table of modules: name, first sentence, lab."""
    title, about = ABOUT[name]
    rows = [[f'<a href="{module.topic}.html"><code>{module.topic}</code></a>',
             inline(course, module, first_sentence(ast.get_docstring(module.tree))),
             *([f'<a href="../labs/{course.lectures[module.lab].page}.html">{module.lab}</a>']
               if module.lab else [])] for module in modules]
    head = ["module", "what it is", "lab"][:len(rows[0])]
    alone = "\n".join(module.topic for module in modules if not module.lab)  # of no lecture
    tree = f"```{{toctree}}\n:hidden:\n\n{alone}\n```"
    return f"# {title}\n\n{about}\n{table('modules', head, rows)}\n{tree}\n"


def page(course, module):
    lines = html_lines(course, module)
    parts = [HIDE_CONTENTS, f"# {escape(module.topic)}\n", directive("module", module.name),
             as_myst(f'<div class="top"><div class="opening">{links(course, module)}'),
             docstring(course, module, module.tree),
             as_myst(f"</div>{contents(module)}</div>")]
    for block in blocks(module):
        if block.kind == "section":
            parts.append(section(module, block))
        elif block.kind == "code":
            parts.append(constants(block, numbered(lines, block.first, block.last)))
        else:
            parts.append(definition(course, module, lines, block))
    return "\n".join(parts)


def directive(kind, name, content=""):
    """A directive of Sphinx's Python domain, whose content may hold others."""
    return f":::::{{py:{kind}}} {name}\n{content}\n:::::\n"


def links(course, module):
    """Where the module belongs, and its file."""
    parts = [f"<code>{module.name.replace('.', '/')}.py</code>"]
    if module.lab:
        lecture = course.lectures[module.lab]
        parts += [f'<a href="../lectures/{lecture.page}.html">Lecture {module.lab}</a>',
                  f'<a href="../labs/{lecture.page}.html">{lab_title(module.lab)}</a>']
    return f'<p class="belongs">{" · ".join(parts)}</p>'


def contents(module):
    """The functions and classes, in their order. The theme's own list takes the code's place."""
    items = " ".join(f'<li><a href="#{module.name}.{name}"><code>{name}</code></a></li>'
                     for name in module.nodes)
    return f'<ul class="names">{items}</ul>'


def section(module, block):
    """A comment that stands alone is a heading: its first sentence. The rest goes below it."""
    lines = module.text.splitlines()[block.first - 1:block.last]
    text = " ".join(line.strip("# -") for line in lines)
    title = first_sentence(text)
    rest = text.removeprefix(title).lstrip(".: ")
    anchors = "".join(f'<span id="line-{n}"></span>' for n in range(block.first, block.last + 1))
    below = f"<p>{rest}</p>" if rest else ""
    return f"## {escape(title)}\n{as_myst(anchors + below)}"


def constants(block, code):
    """Imports and constants. These have their places in the index, which a container keeps."""
    names = [name for node in block.nodes for name in sources_course.defined(node)]
    return "\n".join([*(directive("data", name, ":no-typesetting:") for name in names),
                      f"::::{{container}} constants\n{as_myst(code)}::::\n"])


def definition(course, module, lines, block):
    """A function or a class: what its docstring says, and its code beside it."""
    node, = block.nodes
    question = node.body[0] if ast.get_docstring(node) else None
    hidden = {*range(question.lineno, question.end_lineno + 1)} if question else set()
    code = numbered(lines, block.first, block.last, hidden)
    return directive(*signature(node), "".join([
        as_myst('<div class="beside"><div class="said">'),
        badge(course.exercises.get(f"{module.name}.{node.name}")),
        docstring(course, module, node),
        as_myst(f'</div><div class="answer">{code}</div></div>')]))


def badge(exercise):
    """An exercise's mark, as a link to its question on its lab's page."""
    return as_myst(f'<p class="marks"><a class="badge {kind(exercise)}" '
                   f'href="../{exercise_pages()[exercise.number]}">{mark(exercise)}</a></p>'
                   ) if exercise else ""


def signature(node):
    """-> "function" or "class", and how it is called."""
    if isinstance(node, ast.FunctionDef):
        return "function", f"{node.name}({ast.unparse(node.args)})"
    fields = [part for part in node.body if isinstance(part, ast.AnnAssign)]
    names = [part.target.id + (f"={ast.unparse(part.value)}" if part.value else "")
             for part in fields]
    return "class", f"{node.name}({', '.join(names)})" if names else node.name
