"""What every lecture has, so that a reader finds his way: links, parts, equations, exercises."""
import json
import re

import pytest

from course import exercises
from course.given.places import ROOT
from course.upkeep import errata, hours, notebooks

PATHS = sorted((ROOT / "notebooks").glob("*.ipynb"))
LECTURES = PATHS[1:]                               # 00 is the map, and has a form of its own
MOST_WORDS = 3000                                  # before the summary
WORDING = {                                        # what was translated, and what to write
    "asked at": "sampled at", "in the mean": "on average", "dear": "expensive",
    "whole numbers": "integers", "optimiser": "optimizer", "photograph": "target",
}

each_lecture = pytest.mark.parametrize("path", LECTURES, ids=lambda path: path.stem)
each_page = pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)


def cells_of(path, kind):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == kind]


def text_of(path):
    return "\n\n".join(cells_of(path, "markdown"))


def before_the_summary(path):
    return text_of(path).partition("\n## Summary\n")[0]


@each_lecture
def test_a_lecture_leads_to_its_neighbours_its_modules_and_its_lab(path):
    """A page without a way on; a link to the lecture before the last."""
    k = PATHS.index(path)
    around = [*PATHS[k - 1:k], *PATHS[k + 1:k + 2]]
    lines = text_of(path).splitlines()
    assert re.match(rf"# {path.stem[:2]} [A-Z]", lines[0])
    for line in (lines[2], lines[-1]):
        assert re.findall(r"\]\((\d\d_\w+\.ipynb)\)", line.replace("](00_start_here.ipynb)", "]")
                          if k > 1 else line)[-len(around):] == [one.name for one in around]
    for topic in exercises.LABS[k - 1]:
        assert f"](../reference/{topic}.py)" in lines[2]
    assert f"](../labs/{exercises.LABS[k - 1][0]}.py)" in lines[2]


@each_page
def test_links_lead_somewhere(path):
    """A file that has been renamed."""
    found = re.findall(r"\]\((?!https?://)([^)#]+)(?:#[^)]*)?\)", text_of(path))
    assert [link for link in found if not (path.parent / link).exists()] == []
    assert found


@each_lecture
def test_a_lecture_has_all_its_parts(path):
    """No word on what comes of it, no algorithm at a glance, no sources."""
    text = text_of(path)
    assert text.count("**What you will have built.**") == 1
    assert "```text\n" in text
    titles = re.findall(r"^## (.*)", text, re.MULTILINE)
    assert titles[-3:] == ["Summary", "On paper", "Sources and further reading"]
    numbered = [int(number) for number in re.findall(r"^## (\d+)\. ", text, re.MULTILINE)]
    assert numbered == list(range(1, len(titles) - 2))


@each_lecture
def test_a_lecture_opens_with_its_best_picture(path):
    """A page that begins with code; a picture at its top that older code has drawn."""
    opening = path.parent / "openings" / f"{path.stem}.png"
    assert re.search(rf'<img src="openings/{opening.name}" width="\d+" alt="[^"]{{40,}}">',
                     cells_of(path, "markdown")[0])
    assert notebooks.openings(path.read_text(encoding="utf-8")) == [opening.read_bytes()]


@each_lecture
def test_a_lecture_is_one_lecture_long(path):
    """Two lectures in one. Equations and pseudocode do not count."""
    prose = re.sub(r"\$\$.*?\$\$|```.*?```", "", before_the_summary(path), flags=re.DOTALL)
    assert len(prose.split()) <= MOST_WORDS


@each_lecture
def test_equations_are_numbered_in_the_order_in_which_they_come(path):
    """Equation (4) before equation (1); two numbers in one display, which cannot be rendered."""
    tags = [tag.rstrip("abc") for tag in re.findall(r"\\tag\{(.*?)\}", text_of(path))]
    assert list(map(int, tags)) == sorted(map(int, tags))
    assert set(map(int, tags)) == set(range(1, len(set(tags)) + 1)) and tags
    for display in re.findall(r"\$\$(.*?)\$\$", text_of(path), re.DOTALL):
        assert display.count(r"\tag") <= 1


@each_lecture
def test_each_core_exercise_stands_where_the_text_reaches_it(path):
    """An exercise that the lecture forgets, asks twice, or does not check."""
    lab = int(path.stem[:2])
    core = {exercise.number for exercise in hours.core(lab)}
    lines = re.findall(r"^\*\*Exercises? .*", before_the_summary(path), re.MULTILINE)
    named = re.findall(rf"\b{lab}\.\d+\b", "\n".join(line.partition("*Extra")[0] for line in lines))
    assert sorted(named) == sorted(core)
    shown = re.findall(r'^board\.show\("([\d.]+)"\)$', "\n".join(
        cell for cell in cells_of(path, "code") if cell.startswith("# live")), re.MULTILINE)
    assert sorted(shown) == sorted(core)


@each_page
def test_a_lecture_begins_and_its_figures_are_folded_away(path):
    """A lecture that stops at the first exercise that is missing; a page full of plotting code."""
    first, *others = cells_of(path, "code")
    assert first.endswith("lecture.begin()")
    draws = re.compile(r"^(axes.*= plot\.panels|figure, axes = plt|.*sketch\.sheet|plot\.film)",
                       re.MULTILINE)
    assert [cell[:60] for cell in others
            if draws.search(cell) and not cell.startswith("# figure:")] == []


@each_page
@pytest.mark.parametrize("wrong", WORDING)
def test_a_lecture_is_written_in_the_words_of_the_field(path, wrong):
    """English that was translated word by word."""
    assert not re.search(rf"\b{wrong}\b", text_of(path)), f"write {WORDING[wrong]}"


def test_the_page_of_errata_is_what_the_lectures_say():
    """An erratum that was mended in its lecture, and not on the page."""
    assert (ROOT / "notebooks" / "errata.md").read_text(encoding="utf-8") == errata.page()
