"""The houses of the course: imports go one way, from a house to those below it, never in a circle.

A house is a folder with all that is in it. The docstring of each folder's __init__.py is its sign:
each thing in it on a line, below what it imports.

The modules of course/complete and course/fast are modules of reference, and are called so here.
Those of course/complete stand among the others, and those of course/fast above them.
"""
import ast
import functools
import graphlib
import importlib.util
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from labkit import exercises

ROOT = Path(__file__).parents[2]
HOUSES = {  # each house, and those below it that it imports
    "labkit": (),
    "course.given": ("labkit",),
    "reference": ("course.given",),
    "course.fast": ("course.given", "reference"),
    "course.scenes": ("labkit", "course.given"),  # reference or labs come in by name, as they run
    "teaching": ("course.given",),                # likewise
    "apps.bridge": ("labkit", "course.given"),    # likewise
    "apps.reconstruct": ("labkit", "course.given", "course.scenes"),
    "tasks": ("labkit", "course.given", "course.scenes"),
    "course": ("labkit", "course.scenes", "apps.bridge", "apps.reconstruct")}  # its commands
OF_BOTH = "complete", "fast"  # folders of course/ whose modules are of reference and of labs
OUTSIDE = {"numpy", "scipy", *sys.stdlib_module_names}  # what reference may import besides


class Module(NamedTuple):
    """A module's text. The __init__.py of a folder stands for the folder. of_both: the folder of
    course/ that it stands in, as a module of reference and of labs, or "".
    """

    text: str
    is_folder: bool
    of_both: str = ""


def modules_there():
    """{full name: Module} of all houses, without their tests."""
    paths = [path for folder in {one.partition(".")[0] for one in HOUSES}
             for path in ROOT.glob(f"{folder}/**/*.py")
             if (path.parent / "__init__.py").exists() and "tests" not in path.parts]
    found = {}
    for path in paths:
        parts, is_folder = path.relative_to(ROOT).with_suffix("").parts, path.stem == "__init__"
        of_both = parts[1] if parts[1] in OF_BOTH and not is_folder else ""
        name = f"reference.{path.stem}" if of_both else ".".join(parts).removesuffix(".__init__")
        found[name] = Module(path.read_text(encoding="utf-8"), is_folder, of_both)
    return found


parsed = functools.cache(ast.parse)  # a text is looked at in many tests


def imports(name, modules):
    """The full names of what a module imports, in functions as well."""
    package = name if modules[name].is_folder else name.rpartition(".")[0]
    for node in ast.walk(parsed(modules[name].text)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        if isinstance(node, ast.ImportFrom):
            written = "." * node.level + (node.module or "")
            source = importlib.util.resolve_name(written, package)
            for alias in node.names:
                whole = f"{source}.{alias.name}"
                yield whole if whole in modules else source


def house(name, modules):
    """course.given.mesh -> course.given, labkit.checks.report -> labkit, course.commands -> course.
    """
    if modules[name].of_both == "fast":
        return "course.fast"
    return max((one for one in HOUSES if f"{name}.".startswith(f"{one}.")), key=len, default=None)


def wrong(modules):
    """A sentence for each import that breaks a rule, and for each circle."""
    needs = {name: set(imports(name, modules)) for name in modules}
    for name, imported in needs.items():
        here = house(name, modules)
        for other in imported:
            if other in modules:
                allowed = house(other, modules) in (here, *HOUSES.get(here, ()))
            else:
                allowed = (here not in ("reference", "course.fast")
                           or other.split(".")[0] in OUTSIDE)
            if not allowed:
                yield f"{name} imports {other}"
    try:
        graphlib.TopologicalSorter(needs).prepare()
    except graphlib.CycleError as error:
        yield f"a circle: {', '.join(error.args[1])}"


def wrong_signs(modules):
    """A sentence for each thing that a room's sign leaves out, invents, or names too early."""
    needs = {name: set(imports(name, modules)) for name in modules}
    folders = {name for name, module in modules.items() if module.is_folder}
    for folder in folders - {"reference"}:
        sign = ast.get_docstring(parsed(modules[folder].text), clean=False) or ""
        named = re.findall(r"^    (\w+)  ", sign, re.MULTILINE)
        there = {name_in(folder, name, modules) for name in modules} - {None}
        for name in {*named} ^ there:
            yield f"the sign of {folder} {'lacks' if name in there else 'invents'} {name}"
        for number, name in enumerate(named):
            used = {name_in(folder, other, modules) for module in modules
                    if name_in(folder, module, modules) == name for other in needs[module]}
            for other in used & {*named[number + 1:]}:
                yield f"the sign of {folder} has {name} above {other}, which it imports"


def name_in(folder, module, modules):
    """What stands in a folder for a module: checks, in course, for labkit.checks.report."""
    if module in modules and modules[module].of_both:
        module = f"course.{modules[module].of_both}.{module.partition('.')[2]}"
    below = module.removeprefix(f"{folder}.")
    return None if below == module else below.partition(".")[0]


def test_a_house_stands_on_those_before_it():
    """Two houses may import each other."""
    houses = [*HOUSES]
    for number, name in enumerate(houses):
        assert {*HOUSES[name]} <= {*houses[:number]}


def test_imports_go_one_way():
    """A house needs one above it: neither is understood, moved or handed out without the other."""
    modules = modules_there()
    assert list(wrong(modules)) == []
    there = {house(name, modules) for name, module in modules.items() if not module.is_folder}
    assert there == set(HOUSES), "a house is not listed"


@pytest.mark.parametrize(("module", "line", "imported"), [
    ("course.given.inputs", "from reference import msaa", "reference.msaa"),
    ("course.given.inputs", "from .. import commands", "course.commands"),
    ("reference.msaa", "from course.scenes import demo", "course.scenes.demo"),
    ("reference.msaa", "import matplotlib.pyplot", "matplotlib.pyplot"),
    ("reference.msaa", "from . import multi_view_fit", ""),
    ("reference.msaa", "from . import face_kernels", "reference.face_kernels"),
    ("course.scenes.demo", "def late():\n    from reference import msaa", "reference.msaa"),
    ("course.scenes.demo", "from apps.reconstruct import hulls", "apps.reconstruct.hulls"),
    ("apps.reconstruct.hulls", "from ..bridge import tensors", "apps.bridge.tensors"),
    ("labkit.checks.loader", "import reference.msaa", "reference.msaa"),
    ("labkit.checks.showing", "from .report import claim", ""),
    ("labkit.board", "from course.given import mesh", "course.given.mesh"),
    ("labkit.grading.apart.wire", "def late():\n    import reference.msaa as module",
     "reference.msaa"),
    ("labkit.grading.handing.pack", "from course import commands", "course.commands")])
def test_an_import_that_breaks_a_rule_is_found(module, line, imported):
    """The test above passes, whatever is imported."""
    modules = modules_there()
    modules[module] = Module(f"{modules[module].text}\n{line}\n", False)
    sentence = f"{module} imports {imported}" if imported else "a circle: "
    assert any(found.startswith(sentence) for found in wrong(modules))


LOADED = """
import ast, importlib, sys
from labkit import exercises, places
from course.scenes import demo
for path in places.ROOT.glob("notebooks/*.ipynb"):
    for cell in exercises.cells(path, "code"):
        lines = [line for line in cell.splitlines() if line[:1] != "%"]
        for node in ast.walk(ast.parse("\\n".join(lines))):
            if isinstance(node, ast.Import | ast.ImportFrom):
                exec(ast.unparse(node))
for name in demo.SCENES:
    demo.scene(name)
for name in exercises.topics():
    importlib.import_module(f"labs.{name}")
told = "print([name for name in sys.modules if name.partition('.')[0] == 'apps'])"
exec(told)
importlib.import_module("apps.bridge")
exec(told)
"""


def test_no_lecture_lab_or_scene_loads_an_app():
    """By its name, or through a module that it imports: a lecture waits for all of a tool, and
    must be run again when the tool changes. Or the test passes, whatever is loaded.
    """
    done = subprocess.run([sys.executable, "-c", LOADED], cwd=ROOT, capture_output=True, text=True)
    assert done.stdout == "[]\n['apps', 'apps.bridge']\n", done.stderr


@pytest.mark.parametrize("more", [(), ["transforms.look_at is shown"]])
def test_labkit_knows_no_topic(more):
    """A sentence, a path or a number of this course: another one cannot be graded with it."""
    said = [node.value for name, module in modules_there().items() if name.startswith("labkit")
            for parent in ast.walk(parsed(module.text)) if not isinstance(parent, ast.Expr)
            for node in ast.iter_child_nodes(parent)  # and docstrings may have examples
            if isinstance(node, ast.Constant) and isinstance(node.value, str)]
    words = {word for text in [*said, *more] for word in re.findall(r"\w+", text)}
    assert words & {*exercises.TOPICS} == {*(["transforms"] if more else [])}


def test_every_folder_has_its_sign():
    """Who comes in has to open every module to know what is where, and in which order to read."""
    assert sorted(wrong_signs(modules_there())) == []


@pytest.mark.parametrize(("old", "new", "sentence"), [
    ("    pictures ", "    paintings ", "the sign of labkit.checks lacks pictures"),
    ("    pictures ", "    paintings ", "the sign of labkit.checks invents paintings"),
    ("    showing  ", "    report  above\n    showing  ",
     "the sign of labkit.checks has report above showing, which it imports")])
def test_a_wrong_sign_is_found(old, new, sentence):
    """The test above passes, whatever the signs say."""
    modules = modules_there()
    modules["labkit.checks"] = Module(modules["labkit.checks"].text.replace(old, new), True)
    assert sentence in wrong_signs(modules)
