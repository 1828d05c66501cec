"""The exercises of a module, and the labs made from the reference."""
import importlib
import os
import re
import subprocess

import pytest
from submitted import put

from labkit import exercises, lab_text, places
from labkit.upkeep import skeleton

MODULE = '''\
"""Made up.   """
import numpy as np
import os  # of no use in the lab, and kept

LIMIT = 3   # a constant

def given(x):
    """Calls an exercise and is none."""
    return first(x) + LIMIT

def first(  x ):  # exercise 1.1 (2 points)
    """One line."""

    # A step of the derivation.
    def inner(z):
        """Not an exercise."""
        return z

    return inner(x)
    # The last step.

# A remark between two functions.

@np.vectorize
@undecided(lambda x: x)
def second(x,  # exercise 1.2 (1 point)
           y=(1,
              2)) -> float:
    """Several lines,

        one indented.
    """
    return given(x) if x else second(y)

class Thing:
    def method(self):
        """Not an exercise."""
        return first(2) + third(2)

def third(x):  # exercise 1.10 (12 points)
    \'\'\'Calls the others.\'\'\'
    return (first(x)
            + second(x))  # the end'''
FIRST = MODULE[MODULE.index("\n    # A step"):MODULE.index("\n# A remark")]
LAB = MODULE.replace(FIRST, '    raise NotImplementedError("exercise 1.1: first")\n')
SECOND, THIRD = "return given(x) if x else second(y)", MODULE[MODULE.index("return (first"):]
LAB = LAB.replace(SECOND, 'raise NotImplementedError("exercise 1.2: second")')
LAB = LAB.replace(THIRD, 'raise NotImplementedError("exercise 1.10: third")')


def test_an_exercise_has_number_name_points_line_and_calls():
    """The line is a decorator's, 1.10 becomes 1.1, or calls through given functions are missed."""
    assert [found[:5] for found in exercises.text_exercises(MODULE)] == [
        ("1.1", "first", 2, 11, ()), ("1.2", "second", 1, 26, ("first",)),
        ("1.10", "third", 12, 40, ("first", "second"))]


def test_what_a_called_exercise_calls_is_its_own_affair():
    """An exercise counts as waiting for all that stands before it."""
    text = "def a():\n    b()\ndef b():\n    c()\ndef c():\n    a()\n"
    assert exercises.calls(text, ["a", "b", "c"]) == {"a": ("b",), "b": ("c",), "c": ("a",)}
    assert exercises.calls(text, ["a", "c"]) == {"a": ("c",), "c": ("a",)}


UNMARKED = MODULE.replace("# exercise", "# not an exercise")
IN_A_STRING = 'x = """\ndef f():  # exercise 1.1 (2 points)\n"""\n'


@pytest.mark.parametrize(("text", "lab"), [
    (MODULE, LAB), (MODULE.replace("\n", "\r\n"), LAB.replace("\n", "\r\n")),
    *((text, text) for text in (LAB, UNMARKED, IN_A_STRING))],
    ids=["LF", "CRLF", "a lab", "without exercises", "a mark in a string"])
def test_only_the_answers_are_replaced(text, lab):
    """Comments, decorators, blank lines, line ends or a last line without an end get lost; the
    generator cannot read what it has written; functions without a mark lose their bodies; marks are
    looked for in the text, not among the comments.
    """
    assert lab_text.skeleton(text) == lab


QUESTION = '    """A question."""\n    return 1\n'
OF_F = "line 1: exercise 1.1, f, has"
NO_ANSWER = f"{OF_F} no answer on the lines below its docstring"


@pytest.mark.parametrize(("text", "sentence"), [
    ("x = 1  MARK\n", "line 1: the mark of exercise 1.1 is on no def"),
    (f"MARK\ndef f():\n{QUESTION}", "line 1: the mark of exercise 1.1 is on no def"),
    ("class C:\n    def f():  MARK\n        return 1\n", "line 2: the mark of exercise 1.1 is on"),
    (f"@decorated  MARK\ndef f():\n{QUESTION}", "line 1: the mark of exercise 1.1 is on no def"),
    ("def f():  MARK\n    return 1\n", f"{OF_F} no docstring"),
    ("def f():  MARK\n    ''\n    return 1\n", f"{OF_F} no docstring"),
    ('def f(): "A question."  MARK\n', f"{OF_F} its docstring beside the def"),
    ("def f():  MARK\n    \'\'\'A question.\'\'\'\n", NO_ANSWER),
    ("def f():  MARK\n    \'\'\'A question.\'\'\'; return 1\n", NO_ANSWER),
    (f"def f():  MARK\n{QUESTION}def g():  MARK\n{QUESTION}",
     "line 4: exercise 1.1 is there already, on line 1"),
    *[(f"def f():  {mark}\n{QUESTION}", f'line 1: the comment "{mark}" is not a mark')
      for mark in ("# exercise 1.1 2 points", "# exercise 1.1", "#exercise 1.1 (2 points)",
                   "# Exercise 1.1 (2 points)", "# exercise 11 (2 points)",
                   "# exercise 1.1 (-2 points)", "# exercise 1.1 (2 points) of lab 1",
                   "# exercise 1.1 (0 points)", "# step 1.1 (2 points)", "# Step 1.1")],
    ("def f(:\n", "line 1: this is not Python")])
def test_a_wrong_mark_is_told_in_one_sentence(text, sentence):
    """A mark is overlooked, and its answer stays in the lab."""
    for read in exercises.text_exercises, lab_text.skeleton:
        with pytest.raises(ValueError) as error:
            read(text.replace("MARK", "# exercise 1.1 (2 points)"))
        assert str(error.value).startswith(sentence)
        assert "\n" not in str(error.value)


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course with one topic, its lab not yet made."""
    monkeypatch.setattr(places, "ROOT", tmp_path)
    (tmp_path / "labs").mkdir()
    put(tmp_path, {"reference/transforms.py": MODULE})
    return tmp_path


@pytest.fixture
def work(course):
    """The lab that is not yet made."""
    return course / "labs" / "transforms.py"


def test_topics_are_those_of_the_reference_in_the_courses_order(course):
    """Topics come in the order of the alphabet, or one is listed that is not there."""
    put(course / "reference", {"sampling.py": "", "rasterization.py": ""})
    assert exercises.topics() == ("transforms", "rasterization", "sampling")
    assert exercises.lab_number("rasterization") == 2


@pytest.mark.parametrize(("name", "more", "sentence"), [
    ("rasterization", "", "line 11: first is marked as exercise 1.1, but rasterization is lab 2; "),
    ("transforms", "\n# exercise 2\n", "line 44: the comment")])
def test_a_wrong_mark_is_told_with_its_file(course, name, more, sentence):
    """A lab copied from another keeps the other's numbers. Or the sentence says the line, but of
    which of sixteen files?
    """
    put(course, {f"reference/{name}.py": MODULE + more})
    with pytest.raises(ValueError, match=f"^reference/{name}.py, {re.escape(sentence)}"):
        skeleton.run()
    assert not list((course / "labs").iterdir())


def behind():
    return [path.stem for path, _ in skeleton.behind()]


def test_labs_are_made_and_then_in_step(course, work):
    """A run leaves something that the next run finds fault with."""
    assert behind() == ["transforms"]
    assert skeleton.run() == 0
    assert work.read_bytes() == LAB.encode()
    first = {path: path.read_bytes() for path in course.rglob("*.*")}
    assert skeleton.run() == 0
    assert {path: path.read_bytes() for path in course.rglob("*.*")} == first
    assert behind() == []


def test_a_lab_that_nobody_touched_follows_the_reference(course, work):
    """A lab as it was made is taken for one that was worked on, or for one in step."""
    skeleton.run()
    work.write_bytes(work.read_bytes().replace(b"\n", b"\r\n"))  # as git does on Windows
    changed = MODULE.replace("LIMIT = 3", "LIMIT = 4")
    (course / "reference" / "transforms.py").write_text(changed)
    assert behind() == ["transforms"]
    assert skeleton.run() == 0
    assert work.read_bytes() == LAB.replace("LIMIT = 3", "LIMIT = 4").encode()


def test_a_lab_that_was_worked_on_is_refused_and_the_others_are_made(course, work, capsys):
    """A student's work is overwritten, or stands in the way of all other labs."""
    (course / "reference" / "rasterization.py").write_text('"""Nothing yet."""\n')
    work.write_text("mine\n")
    assert skeleton.run() == 1
    assert capsys.readouterr().out == (
        "labs/transforms.py was worked on and stays as it is; to start it anew, run "
        "python3 -m course skeleton --force, which keeps your text beside it\n")
    assert work.read_text() == "mine\n"
    assert (course / "labs" / "rasterization.py").read_text() == '"""Nothing yet."""\n'
    assert skeleton.run() == 1, "the refusal was forgotten"


def test_force_keeps_every_text_that_it_replaces(course, work, capsys):
    """The second --force overwrites what the first one kept."""
    for text, kept in ("mine\n", "transforms.py.bak"), ("mine again\r\n", "transforms.py.bak2"):
        work.write_bytes(text.encode())
        assert skeleton.run(force=True) == 0
        assert work.read_bytes() == LAB.encode()
        assert (course / "labs" / kept).read_bytes() == text.encode()
        assert f"labs/{kept}" in capsys.readouterr().out
    assert skeleton.run(force=True) == 0, "there is nothing left to force"
    assert not (course / "labs" / "transforms.py.bak3").exists()


@pytest.mark.parametrize("text", [
    "mine\n", LAB + "\n<<<<<<< ours\n", LAB.replace("return first", "def first(:"),
    LAB.replace('raise NotImplementedError("exercise 1.2: second")', SECOND),
    LAB.replace("# exercise 1.2 (1 point)", "# extra 1.2 (1 point), open").replace(
        'raise NotImplementedError("exercise 1.2: second")', SECOND)],
    ids=["no exercise", "a conflict", "a typing error", "an answer", "an extra's"])
def test_nobody_s_work_is_overwritten(work, text):
    """One answer, that of an extra, or a file that cannot be read counts for nothing."""
    work.write_text(text)
    assert skeleton.run() == 1
    assert work.read_text() == text


def test_every_lab_has_something_to_write():
    """A student opens a file of labs/ in vain."""
    assert exercises.lab_topics() == exercises.asking_topics()
    assert {path.stem for path in (places.ROOT / "labs").glob("*.py")} == {
        "__init__", *exercises.asking_topics()}


@pytest.mark.parametrize(("name", "function", "home"), [
    ("diagnosis", "blend_pairs", "antialiasing"),
    ("texel_kernels", "blend_levels_backward", "mipmapping")])
def test_what_stands_once_asks_the_package_that_imports_it(name, function, home):
    """A student's picture is outlined by the reference; or the reference by a student's lab."""
    ours, theirs = (importlib.import_module(f"{each}.{name}") for each in ("reference", "labs"))
    assert ours.__file__ == theirs.__file__
    assert vars(ours)[function].__module__ == f"reference.{home}"
    assert vars(theirs)[function].__module__ == f"labs.{home}"


@pytest.mark.skipif(not (places.ROOT / ".git").exists(), reason="git alone knows what is tracked")
def test_no_file_is_twice_in_the_tree_but_labs_of_extras_alone():
    """Two files are one, and one of them is mended. Extras are complete until they are opened.
    Data may agree: three objects stood before the same cameras.
    """
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=places.ROOT, capture_output=True,
                            check=True, text=True).stdout.split("\0")
    there = {}
    for path in listed:
        file = places.ROOT / path
        if not path.startswith("course/given/data/") and file.is_file() and file.stat().st_size:
            there.setdefault(file.read_bytes(), set()).add(path)
    assert {frozenset(paths) for paths in there.values() if len(paths) > 1} == {
        frozenset({f"labs/{topic}.py", f"reference/{topic}.py"})
        for topic in exercises.asking_topics()
        if not any(one.is_open for one in exercises.topic_exercises(topic))}


def test_the_courses_labs_are_in_step_with_its_reference():
    """The reference was changed, and python3 -m course skeleton not run."""
    assert [path.name for path, _ in skeleton.behind()
            if "CI" in os.environ or not skeleton.was_worked_on(exercises.read(path))] == []
