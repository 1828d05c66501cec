"""No false alarms: other right answers than the reference's pass, one for each exercise.

They are in other_solutions/, written from the docstrings: other formulas, loops for vectors, lists
for arrays, other memory orders. To see what one of them is told:

    python3 -m course check 2.3 --impl tests/project/other_solutions
"""
import ast

import pytest

from course import places, skeleton

FOLDER = places.ROOT / "tests" / "project" / "other_solutions"


@pytest.mark.parametrize("topic", skeleton.topics())
def test_another_right_answer_passes(run_module, topic):
    """A check asks for more than the docstring says, or finer than rounding is."""
    done = run_module(places.ROOT, "course", "check", topic, "--impl", FOLDER, seconds=300)
    assert done.returncode == 0, done.stdout + done.stderr


def answers(path):
    """{name: what the function does, as text without comments and docstring}."""
    functions = skeleton.top_level_functions(skeleton.read(path))
    return {function.name: [ast.unparse(line) for line in function.body
                            if ast.get_docstring(function) is None or line != function.body[0]]
            for function in functions}


@pytest.mark.parametrize("topic", skeleton.topics())
def test_every_exercise_has_an_answer_that_is_not_the_references(topic):
    """An exercise is left out, or the reference's own body is copied."""
    right, other = answers(skeleton.reference(topic)), answers(FOLDER / f"{topic}.py")
    for exercise in skeleton.topic_exercises(topic):
        assert exercise.name in other
        assert other[exercise.name] != right[exercise.name], exercise.name
