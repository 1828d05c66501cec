"""What can be measured of how the code reads: modules, functions and docstrings stay short."""
import ast
import collections
import textwrap
from pathlib import Path

import pytest

from labkit.upkeep import weight

ROOT = Path(__file__).parents[2]
FOLDERS = "reference", "course", "labkit", "apps", "tasks", "teaching"
IN_REFERENCE = "reference", "course/complete", "course/fast"  # one package's modules
LINES = 350       # of a module
TITLE_LINES = 20  # of the docstring of a module that is taught
CODE_LINES = 20   # of a function, see code_lines
ASKED_LINES = 40  # of an exercise's answer
PARAMETERS = 7    # of a function; a backward pass may have one more, the gradient that it is given
OF_OTHERS = "apps/bridge/"  # its functions have other people's parameters
EXCEPTIONS = {  # not yet short; the list may only become shorter
    "course/given/plot_3d.surface has more than 7 parameters",  # lectures choose among all of them
    "course/given/sketch.arrow has more than 7 parameters"}


def code_lines(function, text):
    """The lines of a function's body without blank lines, comments and docstring."""
    lines = text.splitlines()[function.body[0].lineno - 1:function.end_lineno]
    return weight.code_lines(textwrap.dedent("\n".join(lines)))


def parameters(function):
    """How many parameters a function has."""
    named = function.args
    starred = [one for one in (named.vararg, named.kwarg) if one]
    return len([*named.posonlyargs, *named.args, *named.kwonlyargs, *starred])


def too_long(topic, text, title_lines=TITLE_LINES):
    """Yield a sentence for each rule that a module breaks."""
    module = ast.parse(text)
    if len(text.splitlines()) > LINES:
        yield f"{topic} has more than {LINES} lines"
    if len((ast.get_docstring(module) or "").splitlines()) > title_lines:
        yield f"{topic} has a docstring of more than {title_lines} lines"
    for function in ast.walk(module):
        if isinstance(function, ast.FunctionDef):
            asked = "# exercise " in text.splitlines()[function.lineno - 1]
            lines = ASKED_LINES if asked else CODE_LINES
            most = PARAMETERS + function.name.endswith("_backward")
            if code_lines(function, text) > lines:
                yield f"{topic}.{function.name} has more than {lines} lines of code"
            if parameters(function) > most and not topic.startswith(OF_OTHERS):
                yield f"{topic}.{function.name} has more than {most} parameters"


def modules():
    """(name, text, the most lines of its docstring) of each module that keeps the rules.

    Signs, the help and the forms of files are longer: only what is taught has a short docstring.
    """
    for path in sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")
                       if "tests" not in path.relative_to(ROOT).parts):
        name = path.relative_to(ROOT).with_suffix("").as_posix()
        yield (name, path.read_text(encoding="utf-8"),
               TITLE_LINES if name.startswith(IN_REFERENCE) and path.stem != "__init__" else LINES)


def test_the_code_keeps_the_rules_but_for_the_exceptions():
    """A function that nobody can hold in mind; an exception that is none any more."""
    found = {sentence for module in modules() for sentence in too_long(*module)}
    assert "\n".join(sorted(found - EXCEPTIONS)) == "", "make it shorter"
    assert "\n".join(sorted(EXCEPTIONS - found)) == "", "take it out of EXCEPTIONS"


LONG = '"""Title."""\n' + """
def f(a, b, c, *, d, e, f, {g}):
    \"\"\"A docstring

    of some lines.
    \"\"\"
    # A comment, and then a blank line.

"""


@pytest.mark.parametrize(("text", "sentences"), [
    (LONG.format(g="g") + "    a += 1\n" * 20, []),
    (LONG.format(g="g") + "    a += 1\n" * 21, ["x.f has more than 20 lines of code"]),
    (LONG.format(g="g, h") + "    a += 1\n", ["x.f has more than 7 parameters"]),
    (LONG.format(g="**g"), []),
    (LONG.format(g="g, **h"), ["x.f has more than 7 parameters"]),
    (LONG.format(g="g, h").replace("def f", "def f_backward"), []),
    (LONG.format(g="g, h, i").replace("def f", "def f_backward"),
     ["x.f_backward has more than 8 parameters"]),
    ("def f(a):  # exercise 1.1 (2 points)\n" + "    a += 1\n" * 40, []),
    ("def f(a):  # exercise 1.1 (2 points)\n" + "    a += 1\n" * 41,
     ["x.f has more than 40 lines of code"]),
    ("\n" * 350, []), ("\n" * 351, ["x has more than 350 lines"]),
    ('"""Title.\n' + "a\n" * 19 + '"""\n', []),
    ('"""Title.\n' + "a\n" * 20 + '"""\n', ["x has a docstring of more than 20 lines"]),
], ids=range(13))
def test_what_is_too_long_is_found(text, sentences):
    """Comments count as code, or nothing counts."""
    assert list(too_long("x", text)) == sentences


TWICE = {  # names that two modules of reference/ define; the list may only become shorter
    "RATES", "loss_and_gradients", "rasterize", "rasterize_backward",
    "render", "render_backward", "shade", "shade_backward"}
AS_ON_ROWS = {"farthest_first", "first_column", "rasterize", "twice_area",  # kernels of scanline's
              "trials"}  # what has_faster tries


def defined(text):
    """The functions, classes and constants of a module."""
    for node in ast.parse(text).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        if isinstance(node, ast.Assign):
            yield from (part.id for target in node.targets for part in ast.walk(target)
                        if isinstance(part, ast.Name))


@pytest.mark.parametrize("folders, twice", [
    (("reference", "course/complete"), TWICE), (("course/fast",), AS_ON_ROWS)])
def test_a_name_means_one_thing_in_the_reference(folders, twice):
    """Whoever reads `crossing` must ask which one; an exception that is none any more. A kernel and
    the function of NumPy that it stands for have one name, and so have steps of tiny.py.
    """
    found = collections.Counter(name for folder in folders for path in (ROOT / folder).glob("*.py")
                                if path.stem != "tiny"
                                for name in set(defined(path.read_text(encoding="utf-8"))))
    assert {name for name, count in found.items() if count > 1} == twice


def test_names_that_are_defined_are_found():
    """A second name of one line is missed; or a name inside a function counts."""
    text = "A, (B, C) = D = f(E)\nclass G: H = 1\n\ndef i(j): k = 1\n"
    assert set(defined(text)) == {*"ABCDGi"}


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="what is tracked is known to git alone")
def test_the_house_is_no_heavier_than_it_may_be():
    """A guard for each line, a helper for each guard, and soon nobody keeps it alive: make room."""
    assert weight.around(weight.houses()) <= weight.MOST


@pytest.mark.parametrize(("text", "lines"), [
    ('"""Title."""\n\n# A comment\na = 1  # one\n\n\ndef f():\n    """What."""\n    return (1 +\n\n'
     '            2)\n', 4),
    ('a = """two\nlines"""\n', 2), ("a = (\n", 1), ("\n\n", 0)])
def test_lines_of_code_hold_code(text, lines):
    """Docstrings are paid for, or what holds a string is not."""
    assert weight.code_lines(text) == lines
