"""Run in a hand-out: all of its labs, lectures, scenes and commands."""
import ast
import contextlib
import functools
import importlib
import itertools
import re
from pathlib import Path

import matplotlib as mpl

from course import commands
from course.scenes import demo
from labkit import exercises

mpl.use("agg")


def first_steps(scene):
    return functools.wraps(scene)(lambda labs: itertools.islice(scene(labs), 2))


def imports(cells):
    """What cells import. Their films take a minute, and nothing more of a copy."""
    text = re.sub("^ *%.*", "", "\n".join(cells), flags=re.MULTILINE)  # without Jupyter's commands
    return [ast.unparse(node) for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.Import | ast.ImportFrom)]


for path in Path("labs").glob("[!_]*.py"):
    importlib.import_module(f"labs.{path.stem}")
for path in sorted(Path("notebooks").glob("*.ipynb")):
    first, *others = exercises.cells(path, "code")
    whole = path.stem.startswith("00") and Path("tests/labs/test_rasterization.py").exists()
    names = {}
    try:
        for cell in [first, *(others if whole else imports(others))]:
            exec(cell, names)
    except NotImplementedError as error:
        print(path.stem, "stops at", error)
with contextlib.suppress(ImportError):  # a scene times what is written, which takes 2 s
    from labs import rasterization
    vars(rasterization.rasterize).pop("written", None)
scene = demo.scene
demo.scene = lambda name: first_steps(scene(name))
print("DEMO", commands.main(["demo"]))
lab = Path("lab").read_text()
for command in "demo reconstruct", "demo bunny --impl reference", f"check {lab}", "pack", "":
    print("STATUS", commands.main(command.split()))
for command in "mistakes", "handout new", "skeleton --force", "grade --out":
    with contextlib.suppress(SystemExit):
        commands.main(command.split())
        print("STATUS of", command)
