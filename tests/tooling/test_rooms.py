"""The rooms of the course: imports go one way, from a room to those below it, never in a circle.

A room is a folder of course/, also one in another folder, or a module that stands in none. The
docstring of its __init__.py is its sign: each thing in it on a line, below what it imports.
"""
import ast
import graphlib
import importlib.util
import re
import shutil
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ROOMS = {  # each room, and the rooms below it that it imports; a.b is the folder b of a,
           # and whoever may import a may import every room in it
    "given": (),
    "reference": ("given",),
    "experiments.folder": ("given",),  # reference or labs come in by name, when they run
    "experiments.scenes": ("given", "experiments.folder"),
    "exercises": ("given",),
    "checks": ("given",),       # the code under test comes in by name, when they run
    "verdicts": ("given", "exercises", "checks"),
    "board": ("given", "exercises", "checks", "verdicts"),
    "upkeep": ("given", "exercises", "checks"),
    "grading.apart": ("given", "exercises", "checks", "verdicts"),
    "grading.handing": ("given", "exercises", "board"),
    "grading.gradebook": ("given", "grading.apart", "grading.handing"),
    "grading.pages": ("given", "exercises", "checks", "grading.handing", "grading.gradebook"),
    "grading": ("given", "exercises"),
    "commands": ("given", "experiments", "board", "upkeep", "grading"),
    "cli": ("given", "commands"),
    "__main__": ("cli",),
}
OUTSIDE = {"numpy", "scipy", *sys.stdlib_module_names}  # what reference may import besides


def modules_of(root):
    """{full name: path} of the modules of reference and of the course."""
    paths = [path for folder in ("reference", "course") for path in root.glob(f"{folder}/**/*.py")
             if (path.parent / "__init__.py").exists()]  # elsewhere are files to hand out
    return {".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__"): path
            for path in paths}


def imports(name, modules):
    """The full names of what a module imports, in functions as well."""
    path = modules[name]
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        if isinstance(node, ast.ImportFrom):
            written = "." * node.level + (node.module or "")
            source = importlib.util.resolve_name(written, package)
            for alias in node.names:
                whole = f"{source}.{alias.name}"
                yield whole if whole in modules else source


def room(name, modules):
    """course.checks.report -> checks, course.board -> board, reference.msaa -> reference."""
    is_folder = modules[name].name == "__init__.py"
    folder = name if is_folder else name.rpartition(".")[0]
    return (name if folder == "course" else folder).removeprefix("course.")


def may_import(importer, imported):
    """Is a room, or a room that it is in, among those that the importer may import?"""
    return any(f"{imported}.".startswith(f"{allowed}.")
               for allowed in (importer, *ROOMS.get(importer, ())))


def wrong(root):
    """A sentence for each import that breaks a rule, and for each circle."""
    modules = modules_of(root)
    needs = {name: set(imports(name, modules)) for name in modules}
    for name, imported in needs.items():
        here = room(name, modules)
        for other in imported:
            if other in modules:
                allowed = may_import(here, room(other, modules))
            else:
                allowed = here != "reference" or other.split(".")[0] in OUTSIDE
            if not allowed:
                yield f"{name} imports {other}"
    try:
        graphlib.TopologicalSorter(needs).prepare()
    except graphlib.CycleError as error:
        yield f"a circle: {', '.join(error.args[1])}"


def wrong_signs(root):
    """A sentence for each thing that a room's sign leaves out, invents, or names too early."""
    modules = modules_of(root)
    needs = {name: set(imports(name, modules)) for name in modules}
    folders = {name for name, path in modules.items() if path.name == "__init__.py"}
    for folder in folders - {"reference"}:
        text = ast.parse(modules[folder].read_text(encoding="utf-8"))
        sign = ast.get_docstring(text, clean=False) or ""
        named = re.findall(r"^    (\w+)  ", sign, re.MULTILINE)
        there = {name_in(folder, name) for name in modules} - {None}
        for name in {*named} ^ there:
            yield f"the sign of {folder} {'lacks' if name in there else 'invents'} {name}"
        for number, name in enumerate(named):
            used = {name_in(folder, other) for module in modules if name_in(folder, module) == name
                    for other in needs[module]}
            for other in used & {*named[number + 1:]}:
                yield f"the sign of {folder} has {name} above {other}, which it imports"


def name_in(folder, module):
    """What stands in a folder for a module: checks, in course, for course.checks.report."""
    below = module.removeprefix(f"{folder}.")
    return None if below == module else below.partition(".")[0]


def test_a_room_stands_on_those_before_it():
    """Two rooms may import each other."""
    before = set()
    for name, below in ROOMS.items():
        assert set(below) <= before
        before |= {name, name.partition(".")[0]}


def test_imports_go_one_way():
    """A room needs one above it: neither is understood, moved or handed out without the other."""
    assert list(wrong(ROOT)) == []
    modules = modules_of(ROOT)
    there = {room(name, modules) for name, path in modules.items() if path.name != "__init__.py"}
    assert there == set(ROOMS), "a room is not listed"


@pytest.mark.parametrize(("file", "line", "sentence"), [
    ("course/given/inputs.py", "from reference import msaa",
     "course.given.inputs imports reference.msaa"),
    ("course/given/inputs.py", "from .. import exercises",
     "course.given.inputs imports course.exercises"),
    ("reference/msaa.py", "from course.experiments.scenes import demo",
     "reference.msaa imports course.experiments.scenes.demo"),
    ("reference/msaa.py", "import matplotlib.pyplot",
     "reference.msaa imports matplotlib.pyplot"),
    ("reference/msaa.py", "from . import multi_view_fit", "a circle: "),
    ("course/experiments/scenes/demo.py", "def late():\n    from reference import msaa",
     "course.experiments.scenes.demo imports reference.msaa"),
    ("course/experiments/folder/hulls.py", "from ..scenes import drawing",
     "course.experiments.folder.hulls imports course.experiments.scenes.drawing"),
    ("course/checks/loader.py", "import reference.msaa",
     "course.checks.loader imports reference.msaa"),
    ("course/checks/showing.py", "from .report import claim", "a circle: "),
    ("course/board.py", "from .grading.pages.report import page",
     "course.board imports course.grading.pages.report"),
    ("course/grading/apart/wire.py", "def late():\n    import reference.msaa as module",
     "course.grading.apart.wire imports reference.msaa"),
    ("course/grading/apart/wire.py", "from ..grade import run",
     "course.grading.apart.wire imports course.grading.grade"),
    ("course/grading/gradebook/worth.py", "from ..pages import report",
     "course.grading.gradebook.worth imports course.grading.pages.report"),
    ("course/grading/handing/pack.py", "from ... import cli",
     "course.grading.handing.pack imports course.cli"),
])
def test_an_import_that_breaks_a_rule_is_found(tmp_path, file, line, sentence):
    """The test above passes, whatever is imported."""
    for folder in ("course", "reference"):
        shutil.copytree(ROOT / folder, tmp_path / folder,
                        ignore=shutil.ignore_patterns("__pycache__", "data"))
    with open(tmp_path / file, "a", encoding="utf-8") as planted:
        planted.write(f"\n{line}\n")
    assert any(found.startswith(sentence) for found in wrong(tmp_path))


def test_every_room_has_its_sign():
    """Who comes in has to open every module to know what is where, and in which order to read."""
    assert sorted(wrong_signs(ROOT)) == []


@pytest.mark.parametrize(("old", "new", "sentence"), [
    ("    retries ", "    retrials ", "the sign of course.checks lacks retries"),
    ("    retries ", "    retrials ", "the sign of course.checks invents retrials"),
    ("    showing  ", "    report  above\n    showing  ",
     "the sign of course.checks has report above showing, which it imports"),
])
def test_a_wrong_sign_is_found(tmp_path, old, new, sentence):
    """The test above passes, whatever the signs say."""
    shutil.copytree(ROOT / "course", tmp_path / "course",
                    ignore=shutil.ignore_patterns("__pycache__", "data"))
    sign = tmp_path / "course" / "checks" / "__init__.py"
    sign.write_text(sign.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    assert sentence in wrong_signs(tmp_path)
