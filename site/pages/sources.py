"""The annotated source: each module of reference/ and course/given/, its docstrings as prose.

The pages are autodoc's, so each function is in the index, in the search and in references. viewcode
shows the whole file. An extension of Sphinx, too: below a docstring stands its function's code.
"""
import ast
import textwrap

from . import put, sources_course
from .names import exercise_pages, lab_title, mark
from .sources_text import docstring, escape, first_sentence, in_code, table

ABOUT = {
    "reference": ("The annotated source", "The complete code of the labs: every function with its "
                  "question, its equations, its worked example and its answer."),
    "given": ("Given code", "What the labs and the lectures use: meshes, pictures, plots, inputs, "
              "and the check of gradients."),
}
PAGE = """# {title}

{links}

```{{eval-rst}}
.. automodule:: {name}
   :members:
   :undoc-members:
   :private-members:
   :member-order: bysource
```
"""


def write(folder):
    """Write folder/reference and folder/given: a page for each module, and an index of each."""
    course = sources_course.read()
    for name in ABOUT:
        modules = [module for module in course.modules.values() if module.folder == name]
        put(folder / name / "index.md", index(course, name, modules))
        for module in modules:
            put(folder / name / f"{module.topic}.md", PAGE.format(
                title=escape(module.topic), links=links(course, module), name=module.name))


def index(course, name, modules):
    """The table of modules: name, first sentence, lab."""
    title, about = ABOUT[name]
    rows = [[f'<a href="{module.topic}.html"><code>{module.topic}</code></a>',
             in_code(first_sentence(ast.get_docstring(module.tree))),
             *([f'<a href="../labs/{course.lectures[module.lab].page}.html">{module.lab}</a>']
               if module.lab else [])] for module in modules]
    head = ["module", "what it is", "lab"][:len(rows[0])]
    alone = "\n".join(module.topic for module in modules if not module.lab)  # of no lecture
    tree = f"```{{toctree}}\n:hidden:\n\n{alone}\n```"
    return f"# {title}\n\n{about}\n{table('modules', head, rows)}\n{tree}\n"


def links(course, module):
    """Where the module belongs, and its file."""
    path = module.name.replace(".", "/")
    parts = [f'<a href="../_modules/{path}.html"><code>{path}.py</code></a>']
    if module.lab:
        page = course.lectures[module.lab].page
        parts += [f"[Lecture {module.lab}](/lectures/{page}.ipynb)",
                  f"[{lab_title(module.lab)}](/labs/{page}.md)"]
    return " · ".join(parts)


def annotate(app, what, name, thing, options, lines):
    """What autodoc shows of a module, a function or a class: its docstring, its mark, its code."""
    course = sources_course.read()
    if name in course.modules:
        lines[:] = docstring(course, course.modules[name], course.modules[name].tree).splitlines()
        return
    try:
        module, node = course.module_and_node(name)
    except KeyError:  # imported, and not shown
        return
    exercise = course.exercises.get(name)
    asked = (f"`{mark(exercise)} <../{exercise_pages()[exercise.number]}>`__\n\n" if exercise
             else "")
    lines[:] = (f"{asked}{docstring(course, module, node)}\n\n.. code-block:: python\n\n"
                f"{textwrap.indent(code(module, node), '    ')}").splitlines()


def code(module, node):
    """The lines of a function or a class, without its docstring."""
    first = min(each.lineno for each in (node, *node.decorator_list))
    lines = module.text.splitlines()[first - 1:node.end_lineno]
    if ast.get_docstring(node):
        del lines[node.body[0].lineno - first:node.body[0].end_lineno - first + 1]
    return "\n".join(lines)


def setup(app):
    app.connect("autodoc-process-docstring", annotate)
    app.connect("autodoc-skip-member",  # fields and methods stand in their class's code
                lambda app, what, *_: what == "class" or None)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
