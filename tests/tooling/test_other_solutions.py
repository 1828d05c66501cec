"""No false alarms: other right answers than the reference's pass.

One for each exercise is in other_solutions/, written from the docstring: other formulas, loops for
vectors, some lists for arrays. To see what one of them is told:

    python3 -m course check 2.3 --impl tests/other_solutions
"""
import ast
import shutil

import pytest
from other_forms import in_other_forms

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


@pytest.mark.parametrize("topic", exercises.asking_topics())
def test_neither_form_nor_warnings_nor_the_seed_matter(run_module, tmp_path, topic):
    """A check refuses a list, or takes int64 and C order for granted; it fails on a warning; or it
    passes with the numbers of one seed only, and a class may be graded with any."""
    shutil.copytree(places.ROOT / "reference", tmp_path, dirs_exist_ok=True)
    (tmp_path / f"{topic}.py").write_text(in_other_forms(topic), encoding="utf-8")
    done = run_module(places.ROOT, "course", "check", topic, "--impl", tmp_path, "--seed", 1,
                      "--extra", seconds=300)
    assert_whole(done)
