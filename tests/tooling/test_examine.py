"""The course's own labs, graded."""
import pytest
from other_forms import in_other_forms

from course import exercises
from course.grading import running, sandbox
from course.grading.examine import Job


@pytest.fixture(scope="module")
def level():
    """The strictest that this machine has."""
    return sandbox.available()[0]


@pytest.mark.parametrize("topic", exercises.topics())
def test_the_reference_gets_all_points(topic, level):
    """A check that a worker cannot serve; a lab that needs what is not there."""
    assert exercises.foreign_imports(exercises.read(exercises.reference(topic))) == []
    texts = {topic: exercises.read(exercises.reference(topic))}
    result, _ = running.examine(Job(texts, {}, level)._asdict())
    assert (result["problem"], result["lost"]) == (None, {})
    failing = {entry["number"]: entry["checks"] for entry in result["board"]["exercises"]
               if entry["verdict"] != "done"}
    assert failing == {}


@pytest.mark.parametrize("topic", ["rasterization", "mipmapping", "implicit_surfaces"])
def test_graders_take_numbers_in_every_form(topic, level):
    """What `check` accepts, `grade` refuses: a list does not survive the way, or a warning does."""
    result, _ = running.examine(Job({topic: in_other_forms(topic)}, {}, level)._asdict())
    failing = {entry["number"]: entry["checks"] for entry in result["board"]["exercises"]
               if entry["verdict"] != "done"}
    assert (result["problem"], failing) == (None, {})
