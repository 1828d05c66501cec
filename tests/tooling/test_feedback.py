"""What a student is told: no hint is wrong, and the cause is named, on wrong answers as they come.

tests/wrong_answers/ was written by people who had not seen the checks or the known mistakes.
"""
import textwrap
from collections import Counter

import pytest

from course import exercises
from course.checks.report import Check
from course.checks.runner import explained
from course.upkeep import feedback
from course.upkeep.trials import Trial, caught_by

TOPICS = [topic for topic in exercises.topics() if feedback.corpus(topic)]
SILENT = 1  # of a file's wrong answers: the cause of so many may not be named
RIGHT_BEFORE = "def {name}(*inputs, right={name}):\n    "

# Wrong answers that were once told to be something else: topic, exercise, answer, what was told.
MISLED = [
    ("transforms", "perspective_divide", "return inputs[0][..., :3] / -inputs[0][..., 3:]",
     "division is by z"),
    ("transforms", "perspective_divide", "return np.float32(right(*inputs))", "is by z"),
    ("rasterization", "bounding_box", """\
        triangle, width, height = inputs
        x0, y0 = np.clip(np.ceil(triangle.min(0) - 0.5), 0, [width, height])
        x1, y1 = np.clip(np.floor(triangle.max(0) + 0.5), 0, [width, height])
        return int(x0), int(y0), int(x1), int(y1)""", "at their corners"),
    ("rasterization", "rasterize_loop", """\
        clip, faces, width, height = inputs
        index, depth = right(clip, faces[::-1], width, height)  # the last of equally deep ones
        return np.where(index < 0, -1, len(faces) - 1 - index), depth""", "no z-buffer"),
    ("vertex_gradients", "inverse_differential", "return -inputs[1] @ np.linalg.inv(inputs[0])",
     "is there once"),
    ("antialiasing", "blend", "return np.float64(np.float32(right(*inputs)))",
     "wrong one of the two"),
    ("simplification", "satisfies_link_condition", "return not right(*inputs)",
     "every edge may be collapsed"),
    ("implicit_surfaces", "ray_weights", "return right(inputs[0], np.ones_like(inputs[1]))",
     "spacing of the first")]


@pytest.mark.parametrize("topic", TOPICS)
def test_no_hint_is_wrong_and_no_wrong_answer_passes(topic):
    """A student believes a hint, and looks in the wrong place."""
    found = feedback.measured(topic)
    assert [(verdict, answer.exercise.number, answer.cause) for answer, verdict, _ in found
            if verdict in ("wrong", "passes")] == []
    counts = Counter(verdict for _, verdict, _ in found)
    assert counts["silent"] <= SILENT, counts


def test_the_corpus_has_the_size_that_measures():
    """Few answers, and a share says little; one more for each mistake, and a corpus grows that
    measures the same."""
    answers = [answer.exercise for topic in TOPICS for answer in feedback.corpus(topic)]
    assert len(answers) == len(set(answers)) == 95
    assert not any(exercise.is_extra for exercise in answers)


@pytest.mark.parametrize(("topic", "name", "answer", "told"), MISLED,
                         ids=[f"{name}, {told}" for _, name, _, told in MISLED])
def test_what_was_told_wrongly_once_is_not_told_again(topic, name, answer, told):
    """Two mistakes look alike in the few numbers of a check."""
    exercise = next(one for one in exercises.topic_exercises(topic) if one.name == name)
    text = RIGHT_BEFORE.format(name=name) + textwrap.dedent(answer).replace("\n", "\n    ")
    [checks] = caught_by(topic, [Trial(exercise, text)], all_checks=True, with_hints=True,
                         right_first=False)
    hints = [feedback.rows_of(check).get("hint", "") for check in explained(checks)]
    assert hints and not any(told in hint for hint in hints), hints


@pytest.mark.parametrize(("rows", "verdict"), [
    ({"hint": "the sign is flipped"}, "named"),
    ({"hint": "everything is 2 times what was expected"}, "wrong"),
    ({"hint": "it may be that everything is 2 times what was expected"}, "silent"),
    ({"hint": "this may be what comes out when it is tripled", "perhaps": "A sign."}, "named"),
    ({"hint": "this is what comes out when it is tripled", "perhaps": "A sign."}, "wrong"),
    ({"perhaps": "It is tripled."}, "silent"), ({"perhaps": "Minus."}, "silent"),
    ({"perhaps": "Minus where plus should stand."}, "named")])
def test_a_report_is_judged_by_its_sentences(monkeypatch, rows, verdict):
    """A wrong hint is overlooked because another row is right, or words of two rows are mixed."""
    answer = feedback.WrongAnswer(None, "", "the sign is wrong", "sign | minus & plus")
    check = Check("1.1", "test", "", "failed", "\n".join(
        f"{label:10}{text}" for label, text in rows.items()), None, 0.0, False)
    monkeypatch.setattr(feedback, "explained", lambda checks: checks)
    assert feedback.verdict(answer, [check]) == verdict
    assert feedback.verdict(answer, []) == "passes"


def test_a_wrong_answer_without_its_words_is_told(house, monkeypatch):
    """It counts as silent for ever."""
    root = house({"reference/transforms.py": 'def double(x):  # exercise 1.1 (1 point)\n'
                                             '    """2 x."""\n    return 2 * x\n',
                  "tests/wrong_answers/transforms.py": 'def double(x):\n    """it is tripled"""\n'
                                                       "    return 3 * x\n"})
    monkeypatch.setattr("course.given.places.ROOT", root)
    with pytest.raises(ValueError, match="line 1: double must say in its docstring"):
        feedback.corpus("transforms")
