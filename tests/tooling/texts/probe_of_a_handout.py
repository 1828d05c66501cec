"""Run in a hand-out: all of its labs, lectures, scenes and commands."""
import contextlib
import functools
import importlib
import itertools
from pathlib import Path

import matplotlib as mpl

from course import cli, exercises
from course.experiments.scenes import demo

mpl.use("agg")


def first_steps(scene):
    return functools.wraps(scene)(lambda labs: itertools.islice(scene(labs), 2))


for path in Path("labs").glob("[!_]*.py"):
    importlib.import_module(f"labs.{path.stem}")
for path in sorted(Path("notebooks").glob("*.ipynb")):
    cells = exercises.cells(path, "code")
    whole = path.stem.startswith("00") and Path("tests/labs/test_rasterization.py").exists()
    names = {}
    try:
        for cell in cells if whole else cells[:4]:
            exec(cell, names)
    except NotImplementedError as error:
        print(path.stem, "stops at", error)
demo.SCENES = {name: first_steps(scene) for name, scene in demo.SCENES.items() if name != "flight"}
print("DEMO", cli.main(["demo"]))
lab = Path("lab").read_text()
for command in "demo reconstruct", "demo bunny --impl reference", f"check {lab}", "pack", "":
    print("STATUS", cli.main(command.split()))
for command in "mistakes", "handout new", "skeleton --force", "grade --out":
    with contextlib.suppress(SystemExit):
        cli.main(command.split())
        print("STATUS of", command)
