"""The mistake library: every mistake is caught by its own exercise, and gives its hint."""
import json

import numpy as np
import pytest

from course import exercises
from course.checks.hints import HINTS, fingerprint, known_sentences
from course.upkeep import mistakes, mutants

TOPICS = [topic for topic in exercises.topics() if mistakes.library(topic)]
MISREAD = 0.05  # of the hints another machine's rounding may spoil


@pytest.mark.parametrize("topic", TOPICS)
def test_every_mistake_is_caught_by_its_own_exercise_and_gives_a_hint(topic):
    """A mistake that people make passes; or hints.json is of another reference or other checks:
    python3 -m course mistakes makes it anew."""
    library = mistakes.library(topic)
    verdicts = mutants.caught_by(topic, [(mistake.exercise, mistake.text) for mistake in library])
    alive = [f"{mistake.exercise.number}: when {mistake.sentence}"
             for mistake, caught in zip(library, verdicts, strict=True) if not caught]
    assert alive == []
    known = known_sentences()
    silent = [f"{mistake.exercise.number}: when {mistake.sentence}"
              for mistake, [(_, mark)] in zip(library, verdicts, strict=True) if mark not in known]
    assert len(silent) <= MISREAD * len(library), silent


@pytest.mark.parametrize("topic", TOPICS)
def test_every_exercise_has_three_mistakes_with_sentences(topic):
    """An exercise is left out, or has the same mistake twice."""
    library = mistakes.library(topic)
    for exercise in exercises.topic_exercises(topic):
        sentences = [mistake.sentence for mistake in library if mistake.exercise == exercise]
        assert len(sentences) >= 3, exercise.number
        assert len(set(sentences)) == len(sentences), exercise.number


def test_no_sentence_is_of_a_mistake_that_is_no_more():
    """hints.json was not made anew."""
    made = json.loads(HINTS.read_bytes())
    there = {mistake.sentence for topic in TOPICS for mistake in mistakes.library(topic)}
    assert set(made) - there == set()


def test_a_student_reads_the_sentence(run_module, pytestconfig, tmp_path):
    """The hint needs the library, or is that of another check."""
    reference = exercises.read(exercises.reference("transforms"))
    own = ("    moved = [p @ matrix for p in points.reshape(-1, 4)]\n"
           "    return np.array(moved).reshape(points.shape)")  # the mistake, in other words
    (tmp_path / "transforms.py").write_text(
        reference.replace("    return points @ matrix.T", own, 1), encoding="utf-8")
    done = run_module(pytestconfig.rootpath, "course", "check", "1.2", "--impl", tmp_path)
    assert ("hint this is what comes out when the transposed matrix is applied: points are "
            "rows here, but the matrix acts on columns") in " ".join(done.stdout.split())
    done = run_module(pytestconfig.rootpath, "course", "check", "1.2", "--impl", tmp_path,
                      "--seed", "3")
    assert done.returncode == 1


@pytest.mark.parametrize(("one", "other"), [
    (1.0, 1), (np.array([0.1 + 0.2, 1e9]), [0.3, 1e9 + 1e-4]), (np.zeros(2), -np.zeros(2)),
    ((1, [2.0, 3.0]), [1, np.array([2, 3])]), (np.array([np.nan, np.inf]), [np.nan, np.inf]),
    (np.array([1.0, 1e-17]), np.array([1.0, 0.0])), (np.float32(1 / 4), 0.25), (1 + 0j, 1.0),
    (np.array([1e300, 1.0]), [1e300, 2.0]), (np.zeros((0, 3)), np.zeros((0, 3), int)),
], ids=repr)
def test_equal_numbers_have_one_fingerprint(one, other):
    """Rounding, -0 or a list in place of an array loses the hint."""
    assert fingerprint("test", one) == fingerprint("test", other)


@pytest.mark.parametrize(("one", "other"), [
    (1.0, 1.001), (np.ones(3), np.ones((1, 3))), (True, 1), ("a", "b"), (np.nan, 0.0),
    ((1.0, 2.0), (2.0, 1.0)), (np.array([1.0, 2.0]), np.array([2.0, 1.0])), (np.inf, -np.inf),
], ids=repr)
def test_other_numbers_have_another(one, other):
    """A hint for something else."""
    assert fingerprint("test", one) != fingerprint("test", other)
    assert fingerprint("test", one) != fingerprint("test 2", one)


def test_a_row_that_does_not_fit_to_the_reference_is_told(house, run_module):
    """The reference was changed, and the mistake is the right answer."""
    reference = 'def double(x):  # exercise 1.1 (1 point)\n    """2 x."""\n    return 2 * x\n'
    check = ('from course.checks import assert_close, exercise\n\n\n@exercise("1.1")\n'
             'def test_two(impl):\n    assert_close(impl.double(0.0), 0.0)\n')

    def tried(rows):
        root = house({"reference/transforms.py": reference, "tests/labs/test_transforms.py": check,
                      "tests/mistakes/transforms.py": f"MISTAKES = {rows!r}\n",
                      "course/given/data/README.md": ""})
        return run_module(root, "course", "mistakes")

    assert tried({"1.1": [("3 * x", "2 * x", "tripled")]}).stderr == (
        'course: tests/mistakes/transforms.py: exercise 1.1 does not say "3 * x" any more; '
        "write what the reference says now\n")
    assert "names exercise 1.2, and there is none" in tried({"1.2": []}).stderr
    alive = tried({"1.1": [("2 * x", "3 * x", "it is tripled"), ("* x", "+ x", "it is added")]})
    assert alive.returncode == 1
    assert "1.1 is not caught: when it is tripled\n    def double(x):" in alive.stdout
    assert "it is added" not in alive.stdout
