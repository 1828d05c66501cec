"""The README: its lines run, its numbers are true, its links lead somewhere, and it is short."""
import re
import subprocess
import sys

import pytest

from course import exercises
from course.given import places
from course.upkeep import hours

TEXT = (places.ROOT / "README.md").read_text(encoding="utf-8")
LINES = re.search(r"```python\n(.*?)```", TEXT, re.DOTALL)[1]


def test_its_lines_run_and_print_one_number_twice():
    """The first lines that a visitor tries fail, or the gradient is not the difference."""
    code = [line for line in LINES.splitlines() if line and "import" not in line]
    assert len(code) <= 12
    done = subprocess.run([sys.executable, "-c", LINES], cwd=places.ROOT, text=True,
                          capture_output=True, timeout=100)
    gradient, difference = map(float, done.stdout.split())
    assert done.stderr == "" and gradient == pytest.approx(difference, rel=1e-6)


def test_it_is_read_in_a_minute():
    """A visitor leaves before the first picture."""
    code_and_table = re.compile(r"```.*?```|^\|[^\n]*$", re.DOTALL | re.MULTILINE)
    assert len(code_and_table.sub("", TEXT).split()) <= 450


@pytest.mark.parametrize("page", hours.PRINTED, ids=lambda page: page.name)
def test_hours_are_those_of_points_and_lectures(page):
    """An exercise has become an extra, or a lecture longer: python3 -m course.upkeep.hours."""
    text = page.read_text(encoding="utf-8")
    assert "exercises, about" in text
    now, right = text.splitlines(), hours.updated(text).splitlines()
    behind = [line for line, printed in zip(right, now, strict=True) if line != printed]
    assert not behind, "\n".join([f"{page.name} is behind; these lines are right:", *behind])


def test_every_lab_has_its_row():
    """A lab without hours, or a module that a reader never finds."""
    rows = re.findall(r"^\| \d+ \|.*$", TEXT, re.MULTILINE)
    for row, topics in zip(rows, exercises.LABS, strict=True):
        assert exercises.lecture(topics[0]).name in row
        paths = [places.shown_path(exercises.reference(topic)) for topic in topics]
        assert [path for path in paths if path not in row] == []


def test_its_links_lead_somewhere():
    """A file was renamed."""
    for link in re.findall(r"\]\(([^)#:]+)\)", TEXT):
        assert (places.ROOT / link).exists(), link


def test_what_is_behind_a_call_is_named_as_it_is():
    """An exercise got another number: a student looks for it in vain."""
    named = re.findall(r"(\d+\.\d+) `(\w+)`", (places.ROOT / "course/bridge/README.md").read_text())
    assert len(named) > 20 and set(named) <= {
        (exercise.number, exercise.name) for topic in exercises.topics()
        for exercise in exercises.topic_exercises(topic)}


def test_the_extra_that_it_names_is_one():
    """`course open` refuses the very example that the README gives."""
    number = re.search(r"course open (\d+\.\d+)", TEXT)[1]
    assert number in [exercise.number for topic in exercises.LABS[1]
                      for exercise in exercises.topic_exercises(topic) if exercise.is_extra]
