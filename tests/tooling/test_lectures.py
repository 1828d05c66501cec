"""What every lecture has, so that a reader finds his way: links, parts, equations, exercises."""
import json
import re

import pytest

from course import exercises
from course.given.places import ROOT
from course.upkeep import errata, hours, notebooks

PAGES = sorted((ROOT / "notebooks").glob("*.ipynb"))
GUIDE, HOW_TO, *LECTURES = PAGES                   # 00, the map, and 00b have forms of their own
MOST_WORDS = 3000                                  # before the summary
MOST_MINUTES = 45
WORDING = {                                        # what was translated, and what to write
    "asked at": "sampled at", "in the mean": "on average", "dear": "expensive",
    "whole numbers": "integers", "optimiser": "optimizer", "photograph": "target",
}

each_lecture = pytest.mark.parametrize("path", LECTURES, ids=lambda path: path.stem)
each_page = pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
each_lab = pytest.mark.parametrize("lab", range(1, len(exercises.LABS) + 1))


def cells_of(path, kind):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == kind]


def text_of(path):
    return "\n\n".join(cells_of(path, "markdown"))


def before_the_summary(path):
    return text_of(path).partition("\n## Summary\n")[0]


def goes_on(path):
    """Is it a page after a lecture, such as 06b?"""
    return path.stem[2] != "_"


def pages_of(lab):
    return exercises.pages(exercises.LABS[lab - 1][0])


@each_lecture
def test_a_lecture_leads_to_its_neighbours_its_modules_and_its_lab(path):
    """A page without a way on; a link to the lecture before the last."""
    row = [GUIDE, *LECTURES]
    k = row.index(path)
    around = [*row[k - 1:k], *row[k + 1:k + 2]]
    lines = text_of(path).splitlines()
    assert re.match(rf"# {path.stem.partition('_')[0]} [A-Z]", lines[0])
    for line in (lines[2], lines[-1]):
        assert re.findall(r"\]\((\d\d\w+\.ipynb)\)", line.replace("](00_start_here.ipynb)", "]")
                          if k > 1 else line)[-len(around):] == [one.name for one in around]
    own = exercises.LABS[int(path.stem[:2]) - 1]
    assert re.search(rf"\]\(../labs/({'|'.join(own) if goes_on(path) else own[0]})\.py\)", lines[2])


@each_lab
def test_a_lecture_and_the_page_after_it_lead_to_all_modules_of_the_lab(lab):
    """A module that a reader never finds."""
    links = "".join(text_of(path).splitlines()[2] for path in pages_of(lab))
    for topic in exercises.LABS[lab - 1]:
        assert links.count(f"](../reference/{topic}.py)") >= 1


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
    titles = re.findall(r"^## (.*)", text, re.MULTILINE)
    numbered = [int(number) for number in re.findall(r"^## (\d+)\. ", text, re.MULTILINE)]
    assert numbered == list(range(1, len(numbered) + 1))
    ends = ["Summary", "On paper", "Sources and further reading"]
    if goes_on(path):
        assert [end for end in ends if end in titles or end != "On paper"] == titles[len(numbered):]
    else:
        assert titles[len(numbered):] == ends
        assert text.count("**What you will have built.**") == 1
        assert "```text\n" in text


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
def test_a_lecture_takes_45_minutes_at_most(path):
    """Two lectures in one: words at 180 a minute, a figure in 20 seconds, a displayed equation in
    30, and a line of code that is not folded away in 4. Answers are folded away.
    """
    text = re.sub(r"<details>.*?</details>", "", text_of(path), flags=re.DOTALL)
    words = len(re.sub(r"\$\$.*?\$\$|```.*?```", "", text, flags=re.DOTALL).split())
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    figures = sum("image/png" in output.get("data", {})
                  for cell in cells for output in cell.get("outputs", ()))
    lines = sum(bool(line.strip()) for code in cells_of(path, "code")
                if not code.startswith(("# live", "# figure:")) for line in code.splitlines())
    minutes = words / 180 + figures / 3 + text.count("$$") // 2 / 2 + lines / 15
    print(f"{path.stem}: {minutes:.0f} minutes")
    assert minutes <= MOST_MINUTES


@each_lab
def test_equations_are_numbered_in_the_order_in_which_they_come(lab):
    """Equation (4) before equation (1); a number that is left out, or stands on two pages; two in
    one display, which cannot be rendered.
    """
    numbers = []
    for path in pages_of(lab):
        tags = [int(tag.rstrip("abc")) for tag in re.findall(r"\\tag\{(.*?)\}", text_of(path))]
        assert tags == sorted(tags)
        numbers += set(tags)
        for display in re.findall(r"\$\$(.*?)\$\$", text_of(path), re.DOTALL):
            assert display.count(r"\tag") <= 1
    assert sorted(numbers) == list(range(1, len(numbers) + 1)) and numbers


@each_lab
def test_each_core_exercise_stands_where_the_text_reaches_it(lab):
    """An exercise that the lecture forgets, asks twice, or does not check."""
    core = {exercise.number for exercise in hours.core(lab)}
    lines = [line for path in pages_of(lab) for line in re.findall(
        r"^\*\*Exercises? .*", before_the_summary(path), re.MULTILINE)]
    named = re.findall(rf"\b{lab}\.\d+\b", "\n".join(line.partition("*Extra")[0] for line in lines))
    assert sorted(named) == sorted(core)
    shown = re.findall(r'^board\.show\("([\d.]+)"\)$', "\n".join(
        cell for path in pages_of(lab) for cell in cells_of(path, "code")
        if cell.startswith("# live")), re.MULTILINE)
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
