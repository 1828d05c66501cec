"""labkit with a course of other exercises, alone in a folder: it knows nothing of ours."""
import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from small_course import grades

from labkit.grading.apart import sandbox

LABKIT = Path(__file__).parents[1]
FILES = {
    "labs.toml": """
        name = "labkit"
        title = "Sorting and words."
        when_done = "the next chapter"
        labs = [["sorting"], ["words"]]
        given = ["shelf.letters"]
        used = ["shelf/*.py"]
        readme = "handout.md"
        handed_out = []
        complete = "shelf/complete"
        with_labs = {}
        """,
    "pyproject.toml": """
        [tool.pytest.ini_options]
        pythonpath = ["."]
        addopts = "--import-mode=importlib"
        """,
    "conftest.py": 'pytest_plugins = ["labkit.checks.plugin"]',
    "handout.md": "# Sorting\n\nBegin with {first}, lab {lab}, {number}.\n\n{labs}\n\n{released}\n",
    "shelf/__init__.py": "",
    "shelf/letters.py": 'VOWELS = "aeiou"',
    "reference/sorting.py": '''
        """Sorting."""


        def merged(a, b):  # exercise 1.1 (2 points)
            """Two sorted arrays -> one."""
            both = [*a, *b]
            return sorted(both)


        def merge_sort(x):  # exercise 1.2 (1 point)
            """An array -> it, sorted."""
            if len(x) < 2:
                return x
            return merged(merge_sort(x[::2]), merge_sort(x[1::2]))
        ''',
    "reference/words.py": '''
        """Words."""
        from shelf.letters import VOWELS

        from .sorting import merge_sort


        def vowels(text):  # exercise 2.1 (3 points)
            """A text -> its vowels, sorted."""
            places = merge_sort([VOWELS.index(letter) for letter in text if letter in VOWELS])
            return "".join(VOWELS[int(k)] for k in places)
        ''',
    "tests/labs/test_sorting.py": '''
        import numpy as np

        from labkit.checks import assert_equal, exercise


        @exercise("1.1")
        def test_both_are_there(impl):
            """One of them is lost."""
            got = impl.merged(np.array([1, 4]), np.array([2, 3, 5]))
            assert_equal(got, np.array([1, 2, 3, 4, 5]))


        @exercise("1.2")
        def test_all_numbers_are_sorted(impl, rng):
            """Numbers that are equal come once."""
            x = rng.integers(0, 9, 12)
            assert_equal(impl.merge_sort(x), np.array(sorted(x)))
        ''',
    "tests/labs/test_words.py": '''
        from labkit.checks import exercise


        @exercise("2.1")
        def test_vowels_are_sorted(impl):
            """They stay as they stand in the text."""
            assert impl.vowels("raise unison") == "aeiiou"
        '''}
ANSWERS = {  # merge_sort loses what is there twice
    "merged": "return sorted([*a, *b])",
    "merge_sort": "return sorted(set(x))",
    "vowels": 'return "".join("aeiou"[int(k)] for k in merge_sort(['
              '"aeiou".index(letter) for letter in text if letter in "aeiou"]))'}


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """The root of the other course, with labs/ made, and nothing else of ours than labkit."""
    root = tmp_path_factory.mktemp("sorting")
    shutil.copytree(LABKIT, root / "labkit",
                    ignore=shutil.ignore_patterns("tests", "hints.json", "__pycache__"))
    for name, text in FILES.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(textwrap.dedent(text).lstrip(), "utf-8")
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
