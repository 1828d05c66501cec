"""The course's own labs, graded: whatever is right gets all points, at every level."""
import functools

import pytest
from other_forms import in_other_forms
from submitted import other_solution

from course import exercises
from course.given import places
from course.grading import grade
from course.grading.apart import examination, examine, running, sandbox, wire
from course.grading.apart.examine import Job

LABS = range(1, len(exercises.LABS) + 1)


@functools.cache
def asks(lab):
    """What the lab's exercises ask of each other. ValueError: the reference fails a check."""
    level, _ = sandbox.available()
    return grade.rehearsed(exercises.topics_of(str(lab)), level, sandbox.Limits(), True, 1)


def wrong_in(texts, level, asks, seed=0):
    """What takes points from these labs: {exercise: its checks}, and worse."""
    result, _ = running.examine(Job(texts, {}, level, seed, extra=True, asks=asks)._asdict())
    assert (result["problem"], result["lost"], result["missing"]) == (None, {}, {})
    return {entry["number"]: entry["checks"] for entry in result["board"]["exercises"]
            if entry["told"] != "done"}


@pytest.mark.parametrize("lab", LABS)
def test_what_is_right_gets_all_points(lab, monkeypatch, tmp_path):
    """A check that a worker cannot serve; a list for one's own function, which passes at home; an
    answer with loops, where all before it are wrong: the reference stops answering too early.
    """
    for topic in exercises.topics_of(str(lab)):
        assert exercises.foreign_imports(exercises.read(exercises.reference(topic))) == []
    needed = asks(lab)  # of the reference, which gets all points
    texts = {topic: other_solution(topic) for topic in exercises.topics_of(str(lab))
             if topic in exercises.asking_topics()}
    assert wrong_in(texts, sandbox.available()[0], needed, seed=lab) == {}

    monkeypatch.setattr(examination.Examination, "is_sound", lambda self, number: False)
    monkeypatch.setattr(places, "OUT", tmp_path)
    job = Job(texts, {}, "process", asks=needed)
    assert [entry["number"] for entry in examine.examine(job)["board"]["exercises"]
            if entry["told"] != "done"] == []


OTHER_FIELDS = '''

class Buffers(NamedTuple):
    clip: np.ndarray
    face_number: np.ndarray
'''


@pytest.mark.parametrize(("text", "wrong"), [
    (exercises.read(exercises.reference("pipeline")), set()), (other_solution("pipeline"), set()),
    (exercises.read(exercises.reference("pipeline")) + OTHER_FIELDS, {"9.12", "9.13"}),
], ids=["by names", "by position", "of other fields"])
def test_what_is_given_by_names_arrives_by_names(text, wrong):
    """buffers.clip works at home, and in grading Buffers are a plain tuple. Or a lab whose own
    Buffers have other fields makes the grader stumble.
    """
    assert wrong_in({"pipeline": text}, sandbox.available()[0], None).keys() == wrong


def test_all_named_tuples_of_given_code_can_be_sent():
    """One of them comes without its names."""
    table = examination.named_tuples()
    assert {"pipeline.Buffers", "multi_view_fit.Target", "texture_cubes.Buffers"} <= table.keys()
    for known in table.values():
        value = known(*range(len(known._fields)))
        came = wire.decode(wire.encode(value), table)
        assert type(came) is known and came == value


@pytest.mark.parametrize("topic", ["rasterization", "mipmapping", "implicit_surfaces"])
def test_graders_take_numbers_in_every_form(topic):
    """What `check` accepts, `grade` refuses: a list does not survive the way, or a warning does."""
    lab = exercises.lab_number(topic)
    assert wrong_in({topic: in_other_forms(topic)}, sandbox.available()[0], asks(lab)) == {}
