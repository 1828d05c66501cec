"""Processes of their own, forked from one that has imported what all of them need: NumPy, SciPy,
Matplotlib, pytest. That takes a second, which each would take for itself. Of the course, nothing
is imported there. Linux alone forks safely after such imports: elsewhere, Python is started.
"""
import multiprocessing
import os
import runpy
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
IMPORTED = ["matplotlib.pyplot", "PIL.Image", "pytest", "rich.progress", "rich.table",
            "scipy.sparse.linalg", "scipy.spatial.transform"]
START = multiprocessing.get_context("forkserver" if sys.platform == "linux" else "spawn")
if sys.platform == "linux":
    START.set_forkserver_preload(IMPORTED)
NOT_PASSED_ON = "PYTEST_", "PYTHON", "COLUMNS", "FORCE_COLOR", "TTY_"


def run_module(root, *command, seconds=600):
    """run_module(root, "pytest", "-x") -> the finished process of python -m pytest -x in root."""
    settings = {name: value for name, value in os.environ.items()
                if not name.startswith(NOT_PASSED_ON)}
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder, name) for name in ("stdout", "stderr")]
        process = START.Process(target=become, args=(root, [*map(str, command)], settings, files))
        process.start()
        process.join(seconds)
        if process.exitcode is None:
            process.kill()
            raise subprocess.TimeoutExpired(command, seconds)
        return subprocess.CompletedProcess(
            command, process.exitcode, *(path.read_text("utf-8") for path in files))


def wait_until(condition, why):
    """Wait for what another process does, a minute at most."""
    patience = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < patience, why
        time.sleep(0.02)


def make_house(root, files):
    """Put a course with these files alone into a folder: {"labs/transforms.py": text, ...}."""
    # With what was compiled, which is of use as long as a file is as old as it was.
    given = [path for house in ("course", "labkit") for pattern in ("*.py", "__pycache__/*.pyc")
             for path in ROOT.glob(f"{house}/**/{pattern}")
             if path.parent != ROOT / "course" / "complete"  # topics, which the test gives
             and not path.is_relative_to(ROOT / "labkit" / "tests")]
    for path in (*given, *ROOT.glob("labkit/grading/files/*"), *map(ROOT.joinpath, (
            "conftest.py", "labs.toml", "pyproject.toml", "requirements.txt"))):
        copy = root / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(path, copy)
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")
    return root


def become(root, command, settings, files):
    """Do in this process what python -m command does in root, with this environment."""
    os.environ.clear()
    os.environ.update(settings, PYTHONIOENCODING="utf-8")
    for number, path in enumerate(files, 1):
        os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND), number)
    sys.stdout, sys.stderr = (
        open(number, "w", encoding="utf-8", buffering=1, closefd=False) for number in (1, 2))
    for name in [*sys.modules]:  # upkeep/trials.py forks from the same process, and imports labkit
        if name.partition(".")[0] in ("labkit", "course"):
            del sys.modules[name]
    os.chdir(root)
    sys.path[:] = [str(root), *(path for path in sys.path if not is_ours(Path(path)))]
    sys.argv[1:] = command[1:]
    runpy.run_module(command[0], run_name="__main__", alter_sys=True)


def is_ours(path):
    """Is it on the path for the tests of this copy?"""
    return path in (Path(), ROOT) or any(path.is_relative_to(ROOT / house)
                                         for house in ("tests", "labkit", "apps"))
