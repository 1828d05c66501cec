"""The checks of the whole course, both ways: every one fails on the skeleton, as not started.

That every one passes on the reference is the rest of the test run.
"""
import pytest
from submitted import put

from labkit import exercises, verdicts
from labkit.lab_text import skeleton

EXERCISES = {exercise.number: (topic, exercise.name)
             for topic in exercises.topics() for exercise in exercises.topic_exercises(topic)}


@pytest.fixture(scope="module")
def board(tmp_path_factory, in_place, pytestconfig):
    """What became of the reference's skeleton, extras open: (problems, {number: entry})."""
    folder = tmp_path_factory.mktemp("skeleton")
    put(folder, {f"{topic}.py": skeleton(exercises.read(exercises.reference(topic)), extra=True)
                 for topic in exercises.topics()})
    with in_place(pytestconfig.rootpath):
        found = verdicts.run(None, str(folder), 0, extra=True)
    return found.problems, {entry.number: entry for entry in found.asked}


def test_every_exercise_of_the_reference_has_a_check(board):
    """An exercise whose points nobody can get, or everybody does."""
    assert list(board[1]) == list(EXERCISES)
    assert [number for number, entry in board[1].items() if not entry.checks] == []


def test_every_check_is_of_an_exercise_that_exists(board):
    """A check that no board ever runs, for its number is mistyped or its file cannot be read."""
    assert board[0] == []


def test_every_check_stands_in_its_topics_file(board):
    """A check whose impl is another topic's module."""
    for number, (topic, _) in EXERCISES.items():
        for check in board[1][number].checks:
            assert check.nodeid.startswith(f"tests/labs/test_{topic}.py::")


def test_on_the_skeleton_every_check_fails_as_not_started(board):
    """A check that an empty exercise passes, or that needs another exercise than its own."""
    expected = {number: f"verdict   not started (exercise {number}: {name})"
                for number, (_, name) in EXERCISES.items()}
    wrong = {check.nodeid: check.message for number, entry in board[1].items()
             for check in entry.checks if check.message != expected[number]}
    assert wrong == {}
    assert {entry.verdict for entry in board[1].values()} == {"not started"}
