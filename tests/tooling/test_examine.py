"""The course's own labs, graded: whatever is right gets all points, at every level."""
import functools

import pytest
from other_forms import in_other_forms
from submitted import other_solution

from course import exercises
from course.given import places
from course.grading import examination, examine, grade, running, sandbox
from course.grading.examine import Job
from course.grading.levels import LEVELS

LABS = range(1, len(exercises.LABS) + 1)


@functools.cache
def asks(lab):
    """What the lab's exercises ask of each other. ValueError: the reference fails a check."""
    level, _ = sandbox.available()
    return grade.rehearsed(grade.topics_of(str(lab)), level, sandbox.Limits(), True, 1)


def others(lab):
    """{topic: text} of the other solutions."""
    return {topic: other_solution(topic) for topic in grade.topics_of(str(lab))
            if topic in exercises.asking_topics()}


def wrong_in(texts, level, asks, seed=0):
    """What takes points from these labs: {exercise: its checks}, and worse."""
    result, _ = running.examine(Job(texts, {}, level, seed, extra=True, asks=asks)._asdict())
    assert (result["problem"], result["lost"], result["missing"]) == (None, {}, {})
    return {entry["number"]: entry["checks"] for entry in result["board"]["exercises"]
            if entry["told"] != "done"}


@pytest.mark.parametrize("lab", LABS)
def test_the_reference_gets_all_points(lab):
    """A check that a worker cannot serve; a lab that needs what is not there."""
    for topic in grade.topics_of(str(lab)):
        assert exercises.foreign_imports(exercises.read(exercises.reference(topic))) == []
    assert asks(lab) is not None


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("lab", LABS)
def test_other_right_answers_get_all_points(lab, level):
    """What passes at home loses points in grading: a list for its own function, a helper."""
    if level == "strict" != sandbox.available()[0]:
        pytest.skip(sandbox.available()[1])
    assert wrong_in(others(lab), level, asks(lab), seed=lab) == {}


@pytest.mark.parametrize("lab", LABS)
def test_an_answer_gets_its_points_if_all_before_it_are_wrong(lab, monkeypatch, tmp_path):
    """The reference stops answering before a right answer, with loops, has asked what it needs."""
    level, _ = sandbox.available()
    needed = asks(lab)
    monkeypatch.setattr(examination.Examination, "is_sound", lambda self, number: False)
    monkeypatch.setattr(places, "OUT", tmp_path)
    job = Job(others(lab), {}, level, asks=needed)
    assert [entry["number"] for entry in examine.examine(job)["board"]["exercises"]
            if entry["told"] != "done"] == []


@pytest.mark.parametrize("topic", ["rasterization", "mipmapping", "implicit_surfaces"])
def test_graders_take_numbers_in_every_form(topic):
    """What `check` accepts, `grade` refuses: a list does not survive the way, or a warning does."""
    lab = exercises.lab_number(topic)
    assert wrong_in({topic: in_other_forms(topic)}, sandbox.available()[0], asks(lab)) == {}
