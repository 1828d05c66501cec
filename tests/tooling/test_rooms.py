"""The rooms of the course: imports go one way, from a room to those below it, never in a circle."""
import ast
import graphlib
import importlib.util
import shutil
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ROOMS = {  # each room, and the rooms below it that it imports
    "given": (),
    "reference": ("given",),
    "experiments": ("given",),  # reference or labs come in by name, when they run
    "exercises": ("given",),
    "checks": ("given",),       # the code under test comes in by name, when they run
    "board": ("given", "exercises", "checks"),
    "upkeep": ("given", "exercises", "checks", "board"),
    "grading": ("given", "exercises", "checks", "board", "upkeep"),
    "cli": ("given", "experiments", "board", "upkeep", "grading"),
    "__main__": ("cli",),
}
OUTSIDE = {"numpy", "scipy", *sys.stdlib_module_names}  # what reference may import besides


def modules_of(root):
    """{full name: path} of the modules of reference and of the course."""
    paths = [*root.glob("reference/*.py"), *root.glob("course/**/*.py")]
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


def room(name):
    """course.checks.report -> checks, reference.msaa -> reference; anything else -> its package."""
    return name.removeprefix("course.").split(".")[0]


def wrong(root):
    """A sentence for each import that breaks a rule, and for each circle."""
    modules = modules_of(root)
    needs = {name: set(imports(name, modules)) for name in modules}
    for name in modules:
        allowed = {room(name), *ROOMS.get(room(name), ())}
        for other in needs[name]:
            ours = other in modules
            if ours and room(other) not in allowed:
                yield f"{name} imports {other}"
            if not ours and room(name) == "reference" and room(other) not in OUTSIDE:
                yield f"{name} imports {other}"
    try:
        graphlib.TopologicalSorter(needs).prepare()
    except graphlib.CycleError as error:
        yield f"a circle: {', '.join(error.args[1])}"


def test_a_room_stands_on_those_before_it():
    """Two rooms may import each other."""
    for number, below in enumerate(ROOMS.values()):
        assert set(below) <= set(list(ROOMS)[:number])


def test_imports_go_one_way():
    """A room needs one above it: neither is understood, moved or handed out without the other."""
    assert list(wrong(ROOT)) == []
    there = {room(name) for name in modules_of(ROOT)} - {"course"}
    assert there == set(ROOMS), "a room is not listed"


@pytest.mark.parametrize(("file", "line", "sentence"), [
    ("course/given/inputs.py", "from reference import msaa",
     "course.given.inputs imports reference.msaa"),
    ("course/given/inputs.py", "from .. import exercises",
     "course.given.inputs imports course.exercises"),
    ("reference/msaa.py", "from course.experiments import demo",
     "reference.msaa imports course.experiments.demo"),
    ("reference/msaa.py", "import matplotlib.pyplot",
     "reference.msaa imports matplotlib.pyplot"),
    ("reference/msaa.py", "from . import multi_view_fit", "a circle: "),
    ("course/experiments/demo.py", "def late():\n    from reference import msaa",
     "course.experiments.demo imports reference.msaa"),
    ("course/checks/loader.py", "import reference.msaa",
     "course.checks.loader imports reference.msaa"),
    ("course/checks/showing.py", "from .report import claim", "a circle: "),
    ("course/board.py", "from .grading.report import page",
     "course.board imports course.grading.pages.report"),
    ("course/grading/apart/wire.py", "def late():\n    import reference.msaa as module",
     "course.grading.apart.wire imports reference.msaa"),
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
