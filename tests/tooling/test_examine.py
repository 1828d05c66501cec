"""The course's own labs, graded."""
import pytest

from course import exercises
from course.grading import grade, sandbox, submissions
from course.grading.examine import Job


@pytest.fixture(scope="module")
def level():
    """The strictest that this machine has."""
    return sandbox.available()[0]


@pytest.mark.parametrize("topic", exercises.topics())
def test_the_reference_gets_all_points(topic, level):
    """A check that a worker cannot serve; a lab that needs what is not there."""
    assert submissions.foreign_imports(exercises.read(exercises.reference(topic))) == []
    texts = {topic: exercises.read(exercises.reference(topic))}
    result, _ = grade.examine(Job(texts, {}, level)._asdict())
    assert (result["problem"], result["lost"]) == (None, {})
    failing = {entry["number"]: entry["checks"] for entry in result["board"]["exercises"]
               if entry["verdict"] != "done"}
    assert failing == {}
