"""No false alarms: other right answers than the reference's pass.

One for each core exercise is in other_solutions/, written from the docstring: other formulas, loops
for vectors, some lists for arrays. Of an answer that is one expression, only a different method is
there, for the same one in other words shows nothing. test_examine grades them: they get all points.
To see what one of them is told:

    python3 -m course check 2.3 --impl tests/other_solutions
"""
import ast
import shutil

import pytest
from other_forms import in_other_forms
from submitted import CORE, FOLDER

from labkit import exercises, places
from labkit.grading.handing import handout


def answers(path):
    """{name: what the function does, as text without comments and docstring}."""
    functions = exercises.top_level_functions(exercises.read(path))
    return {function.name: [ast.unparse(line) for line in function.body
                            if ast.get_docstring(function) is None or line != function.body[0]]
            for function in functions}


@pytest.mark.parametrize("topic", [topic for topic, core in CORE.items() if core])
def test_every_exercise_has_an_answer_that_is_not_the_references(topic):
    """An exercise of several lines is left out, or the reference's own body is copied."""
    right, other = answers(exercises.reference(topic)), answers(FOLDER / f"{topic}.py")
    for exercise in CORE[topic]:
        if exercise.name in other or len(right[exercise.name]) > 1:
            assert other[exercise.name] != right[exercise.name], exercise.name


def users(topic):
    """The modules of reference/ that use a topic, in any number of steps, and itself."""
    return exercises.closure([exercises.reference(topic)],
                             lambda used: [path for path in USES if used in USES[path]])


def are_apart(one, other):
    """Neither topic uses the other: what one returns does not reach the other's code."""
    return (exercises.reference(one) not in users(other)
            and exercises.reference(other) not in users(one))


def groups():
    """All topics, in few groups of topics that are apart."""
    made = []
    for topic in exercises.asking_topics():
        fitting = [group for group in made if all(are_apart(topic, other) for other in group)]
        if fitting:
            fitting[0].append(topic)
        else:
            made.append([topic])
    return made


USES = {path: handout.uses(path) for path in map(exercises.reference, exercises.topics())}


@pytest.mark.parametrize("topics", groups(), ids=lambda topics: topics[0])
def test_neither_form_nor_warnings_nor_the_seed_matter(run_module, tmp_path, topics):
    """A check refuses a list, or takes int64 and C order for granted; it fails on a warning; or it
    passes with the numbers of one seed only, and a class may be graded with any."""
    shutil.copytree(places.ROOT / "reference", tmp_path, dirs_exist_ok=True)
    for topic in topics:
        (tmp_path / f"{topic}.py").write_text(in_other_forms(topic), encoding="utf-8")
    checks = [f"tests/labs/test_{topic}.py" for topic in topics]
    done = run_module(places.ROOT, "pytest", "-m", "exercise", "--impl", tmp_path,
                      "--seed", 1, *checks)
    assert done.returncode == 0, done.stdout + done.stderr
