"""The course's own labs, graded: whatever is right gets all points, whoever answers for the rest.

They are examined in this process. That `grade` starts one for each is tested on a small course.
"""
import functools
import importlib

import pytest
from other_forms import in_other_forms
from submitted import other_solution

from labkit import contract, exercises, places
from labkit.grading.apart import answers, examination, sandbox, wire
from labkit.grading.apart.examine import examine
from labkit.grading.apart.jobs import Job

LABS = range(1, len(exercises.LABS) + 1)
LEVEL, _ = sandbox.available()
TABLE = examination.named_tuples()
LIMITS = sandbox.Limits(call=100, exercise=1200)  # of 40,000 short calls on a busy machine


@pytest.fixture(autouse=True)
def folder_for_pictures(monkeypatch, tmp_path):
    monkeypatch.setattr(places, "OUT", tmp_path)


@pytest.fixture(scope="module", autouse=True)
def one_reference():
    """One worker answers for the reference in all examinations here: it loads for half a second."""
    opened, workers, closes = answers.Answers.opened, {}, []

    def shared(self):
        level = self.start.__self__.job.level
        if level not in workers:
            worker = workers[level] = opened(self)
            closes.append(worker.close)
            worker.close = lambda: None
        return workers[level]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(answers.Answers, "opened", shared)
        yield
    for close in closes:
        close()


def all_right(job):
    """What a job asks of the reference. It gets all points, or this is red."""
    result = examine(job._replace(limits=LIMITS))
    assert (result.problem, result.lost, result.missing) == (None, {}, {})
    assert {entry.number: entry.checks for entry in result.entries if entry.told != "done"} == {}
    return result.asked


@functools.cache
def asks(lab):
    """What the lab's exercises ask of each other, in the reference."""
    texts = {topic: exercises.read(exercises.reference(topic))
             for topic in exercises.topics_of(str(lab))}
    return all_right(Job(texts, {}, LEVEL, extra=True))


@pytest.mark.parametrize(("lab", "answering"), [
    *((lab, "as needed") for lab in LABS),
    *(pytest.param(lab, "always", marks=[pytest.mark.weekly] if lab == 2 else []) for lab in LABS)])
def test_what_is_right_gets_all_points(lab, answering, monkeypatch):
    """A check that a worker cannot serve; a list for one's own function, which passes at home; an
    answer with loops, where all before it are wrong: the reference stops answering too early.
    """
    topics = exercises.topics_of(str(lab))
    texts = {topic: other_solution(topic) for topic in topics if topic in exercises.asking_topics()}
    needed = asks(lab)
    if answering == "as needed":
        all_right(Job(texts, {}, LEVEL, lab, extra=True, asks=needed))
    else:
        monkeypatch.setattr(examination.Examination, "is_sound", lambda self, number: False)
        monkeypatch.setattr(answers.Answers, "returned", returned_here)
        all_right(Job(texts, {}, "process", asks=needed))


def returned_here(self, number, topic, name, question):
    """What the reference's worker says, without the way there and back. Lab 2 asks 40,000 times."""
    *_, given, named = wire.decode(question, TABLE)
    try:
        function = getattr(importlib.import_module(f"reference.{topic}"), name)
        return wire.encode(("returned", contract.called(function, *given, **named), (), ""))
    except ValueError as error:
        return wire.encode(("raised", "ValueError", str(error), (), ""))


OTHER_FIELDS = '''

class Buffers(NamedTuple):
    clip: np.ndarray
    face_number: np.ndarray
'''


@pytest.mark.parametrize(("text", "wrong"), [
    (exercises.read(exercises.reference("pipeline")), set()), (other_solution("pipeline"), set()),
    (exercises.read(exercises.reference("pipeline")) + OTHER_FIELDS, {"9.2", "9.3"}),
], ids=["by names", "by position", "of other fields"])
def test_what_is_given_by_names_arrives_by_names(text, wrong):
    """buffers.clip works at home, and in grading Buffers are a plain tuple. Or a lab whose own
    Buffers have other fields makes the grader stumble.
    """
    result = examine(Job({"pipeline": text}, {}, LEVEL, extra=True, limits=LIMITS))
    assert {entry.number for entry in result.entries if entry.told != "done"} == wrong


def test_all_named_tuples_of_given_code_can_be_sent():
    """One of them comes without its names."""
    table = examination.named_tuples()
    assert table.keys() >= {"pipeline.Buffers", "multi_view_fit.Target",
                            "texture_cubes.CubeBuffers"}
    for known in table.values():
        value = known(*range(len(known._fields)))
        came = wire.decode(wire.encode(value), table)
        assert type(came) is known and came == value


@pytest.mark.parametrize("topic", ["rasterization", "mipmapping", "implicit_surfaces"])
def test_graders_take_numbers_in_every_form(topic):
    """What `check` accepts, `grade` refuses: a list does not survive the way, or a warning does."""
    needed = asks(exercises.lab_number(topic))
    all_right(Job({topic: in_other_forms(topic)}, {}, LEVEL, extra=True, asks=needed))


@pytest.mark.parametrize(("busy", "sentence"), [
    ("labkit.checks.hints.fingerprint", "what was returned cannot be reported"),
    ("labkit.checks.assertions.distances", "takes the grader more than")])
def test_what_is_returned_may_not_keep_the_grader_busy(busy, sentence, monkeypatch):
    """Values that are slow to compare or to report hold everybody up, outside of all limits. Or
    the error ends the examination, and other exercises lose their points.
    """
    def spin(*_):
        while True:
            pass

    monkeypatch.setattr(busy, spin)
    monkeypatch.setattr("labkit.checks.alarm.OURS", 0.5)
    text = exercises.read(exercises.reference("transforms"))
    wrong = text.replace("screen = clip[..., :3] / clip[..., 3:]", "screen = 1 * clip[..., :3]")
    result = examine(Job({"transforms": wrong}, {}, "process"))
    entry, = (one for one in result.entries if one.verdict != "done")
    assert result.problem is None and entry.number == "1.9"
    message = next(check.message for check in entry.checks if check.verdict == "failed")
    assert sentence in " ".join(message.split())
