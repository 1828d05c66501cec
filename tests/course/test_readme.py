"""The README: its lines run, its numbers are true, and it is short. And the links of all pages."""
import re

import pytest

from course.given import image
from labkit import exercises, places
from labkit.upkeep import hours

TEXT = (places.ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)


def test_its_lines_draw_a_picture_and_print_one_number_twice(tmp_path, monkeypatch, capsys):
    """The first lines that a visitor tries fail, or the gradient is not the difference."""
    assert len("".join(BLOCKS).splitlines()) <= 22
    monkeypatch.chdir(tmp_path)
    exec("".join(BLOCKS), {})
    gradient, difference = map(float, capsys.readouterr().out.split())
    assert gradient == pytest.approx(difference, rel=1e-6)
    bunny = image.read(tmp_path / "bunny.png")
    assert 0.2 < (bunny < 1).any(-1).mean() < 0.6


def test_it_is_read_in_a_minute_or_two():
    """A visitor leaves before the first picture; or meets a word that lecture 00 has to explain."""
    code_and_table = re.compile(r"```.*?```|^\|[^\n]*$", re.DOTALL | re.MULTILINE)
    assert len(code_and_table.sub("", TEXT).split()) <= 450
    assert not re.search(r"\b(core|claim|live)\b", TEXT)


@pytest.mark.parametrize("page", hours.PRINTED, ids=lambda page: page.name)
def test_hours_are_those_of_points_and_lectures(page):
    """An exercise has become an extra, or a lecture longer: python3 -m labkit.upkeep.hours."""
    text = page.read_text(encoding="utf-8")
    assert "exercises, about" in text
    now, right = text.splitlines(), hours.updated(text).splitlines()
    behind = [line for line, printed in zip(right, now, strict=True) if line != printed]
    assert not behind, "\n".join([f"{page.name} is behind; these lines are right:", *behind])


def test_every_lab_has_its_row():
    """A lab without hours, or a lecture or module that a reader never finds, or finds among ten."""
    rows = re.findall(r"^\| \d+ \|.*$", TEXT, re.MULTILINE)
    for row, topics in zip(rows, exercises.LABS, strict=True):
        assert re.findall(r"\]\((.*?)\)", row) == [
            f"notebooks/{exercises.lecture(topics[0]).name}", f"reference/{topics[0]}.py"]


@pytest.mark.parametrize(
    "house", ["", "apps", "benchmarks", "course", "labkit", "tasks", "teaching", "tests"])
def test_links_lead_somewhere(house):
    """A file was renamed."""
    for page in places.ROOT.glob(f"{house}/**/*.md" if house else "*.md"):
        for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            assert (page.parent / link).exists(), (page, link)


def test_what_is_behind_a_call_is_named_as_it_is():
    """An exercise got another number: a student, or a teacher, looks for it in vain."""
    pages = places.ROOT / "apps/bridge/README.md", *places.ROOT.glob("teaching/weeks/*.md")
    named = [name for page in pages for name in re.findall(r"(\d+\.\d+) `(\w+)`", page.read_text())]
    assert len(named) > 50 and set(named) <= {
        (exercise.number, exercise.name) for topic in exercises.topics()
        for exercise in exercises.topic_exercises(topic)}
