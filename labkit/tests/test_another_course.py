"""labkit with a course of other exercises, sorting/, alone in a folder: it knows nothing of ours.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from small_course import grades

from labkit.grading.apart import sandbox

LABKIT = Path(__file__).parents[1]
COURSE = LABKIT / "tests" / "sorting"
ANSWERS = {  # merge_sort loses what is there twice
    "merged": "return sorted([*a, *b])",
    "merge_sort": "return sorted(set(x))",
    "vowels": 'return "".join("aeiou"[int(k)] for k in merge_sort(['
              '"aeiou".index(letter) for letter in text if letter in "aeiou"]))'}


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """The root of the other course, with labs/ made, and nothing else of ours than labkit."""
    root = shutil.copytree(COURSE, tmp_path_factory.mktemp("sorting"), dirs_exist_ok=True)
    shutil.copytree(LABKIT, root / "labkit",
                    ignore=shutil.ignore_patterns("tests", "hints.json", "__pycache__"))
    labkit(root, "skeleton")
    return root


def labkit(root, *command, status=0):
    """What a command prints, started in a course's folder."""
    settings = {name: value for name, value in os.environ.items()
                if not name.startswith(("PYTEST_", "PYTHON"))}
    done = subprocess.run([sys.executable, "-m", "labkit", *map(str, command)], cwd=root,
                          env=settings, capture_output=True, encoding="utf-8", timeout=120)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout


def write(root, answers):
    """Put answers {function: line} into the labs of a hand-out."""
    for path in (root / "labs").glob("*.py"):
        text = path.read_text("utf-8")
        for name, line in answers.items():
            text = re.sub(rf'raise NotImplementedError\(".*: {name}"\)', lambda _, line=line: line,
                          text)
        path.write_text(text, "utf-8")


@pytest.mark.skipif(sys.platform == "win32", reason="nothing can be graded there")
def test_it_is_handed_out_checked_packed_and_graded(course, tmp_path):
    """labkit needs a module, a path or a name of this course."""
    home, handed_in = tmp_path / "home", tmp_path / "handed in"
    handed_in.mkdir()
    labkit(course, "handout", home)
    assert not (home / "reference").exists()
    write(home, ANSWERS)
    board = labkit(home, "check", status=1)
    assert "merge_sort  0 of 1  failing" in board and "python3 -m labkit check 1.2" in board
    labkit(home, "pack", handed_in / "ada.zip")
    level, _ = sandbox.available()
    labkit(course, "grade", handed_in, "--out", tmp_path / "out", "--isolation", level)
    [row] = grades(tmp_path / "out").values()
    assert [row[name] for name in ("student", "1.1 merged", "1.2 merge_sort", "2.1 vowels")] == [
        "ada", "2", "0", "3"]
