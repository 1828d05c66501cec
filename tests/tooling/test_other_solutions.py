"""No false alarms: other right answers than the reference's pass.

One for each exercise is in other_solutions/, written from the docstring: other formulas, loops for
vectors, some lists for arrays. To see what one of them is told:

    python3 -m course check 2.3 --impl tests/other_solutions
"""
import ast

import pytest

from course import exercises
from course.given import places

FOLDER = places.ROOT / "tests" / "other_solutions"


def assert_whole(done):
    """Question and fine print of every exercise are answered."""
    assert done.returncode == 0 and "fine print open" not in done.stdout, done.stdout + done.stderr


@pytest.mark.parametrize("topic", exercises.asking_topics())
def test_another_right_answer_passes(run_module, topic):
    """A check asks for more than the docstring says, or finer than rounding is."""
    done = run_module(places.ROOT, "course", "check", topic, "--impl", FOLDER, seconds=300)
    assert_whole(done)


def answers(path):
    """{name: what the function does, as text without comments and docstring}."""
    functions = exercises.top_level_functions(exercises.read(path))
    return {function.name: [ast.unparse(line) for line in function.body
                            if ast.get_docstring(function) is None or line != function.body[0]]
            for function in functions}


@pytest.mark.parametrize("topic", exercises.asking_topics())
def test_every_exercise_has_an_answer_that_is_not_the_references(topic):
    """An exercise is left out, or the reference's own body is copied."""
    right, other = answers(exercises.reference(topic)), answers(FOLDER / f"{topic}.py")
    for exercise in exercises.topic_exercises(topic):
        assert other[exercise.name] != right[exercise.name], exercise.name


ANOTHER_FORM = '''
import functools

import numpy as np


def form(returned):
    """Columns one after the other and no writing, short integers; numbers as Python has them."""
    if isinstance(returned, tuple | str):
        return tuple(map(form, returned)) if isinstance(returned, tuple) else returned
    array = np.asarray(returned)
    array = array.astype(np.int32) if array.dtype.kind == "i" else array
    array = array.copy(order="F")
    array.flags.writeable = False
    return array if array.ndim else array.item()


def formed(function):
    return functools.wraps(function)(lambda *args, **named: form(function(*args, **named)))


for name in {names!r}:
    globals()[name] = formed(globals()[name])
'''


@pytest.mark.parametrize("topic", exercises.asking_topics())
def test_neither_its_form_nor_the_seed_matters(run_module, tmp_path, topic):
    """A check takes C order, int64, NumPy's numbers or an array that it can write for granted; or
    it passes with the numbers of one seed only, and a class may be graded with any."""
    names = [exercise.name for exercise in exercises.topic_exercises(topic)]
    for path in (places.ROOT / "reference").glob("*.py"):
        (tmp_path / path.name).write_text(path.read_text(encoding="utf-8"), encoding="utf-8")
    with (tmp_path / f"{topic}.py").open("a", encoding="utf-8") as file:
        file.write(ANOTHER_FORM.replace("{names!r}", repr(names)))
    done = run_module(places.ROOT, "course", "check", topic, "--impl", tmp_path, "--seed", 1,
                      "--extra", seconds=300)
    assert_whole(done)
