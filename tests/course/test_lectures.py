"""What every lecture has, so that a reader finds his way: links, parts, equations, exercises."""
import ast
import base64
import io
import re

import numpy as np
import pytest
from PIL import Image

from labkit import exercises, places
from labkit.places import ROOT
from labkit.upkeep import errata, hours, notebooks, pictures

PAGES = sorted((ROOT / "notebooks").glob("*.ipynb"))
GUIDE, HOW_TO, *LECTURES = PAGES                   # 00, the map, and 00b have forms of their own
FIRST_LINE = 'import sys; sys.path.append("..")  # finds the course from the folder notebooks/'
WORDING = {                                        # what was translated, and what to write
    "asked at": "sampled at", "in the mean": "on average", "dear": "expensive",
    "whole numbers": "integers", "optimiser": "optimizer", "photograph": "target",
}

each_lecture = pytest.mark.parametrize("path", LECTURES, ids=lambda path: path.stem)
each_page = pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
each_lab = pytest.mark.parametrize("lab", range(1, len(exercises.LABS) + 1))


def text_of(path):
    return "\n\n".join(exercises.cells(path))


@each_lecture
def test_a_lecture_leads_to_its_neighbours_its_modules_and_its_lab(path):
    """A page without a way on; a link to the lecture before the last."""
    row, lab = [GUIDE, *LECTURES], int(path.stem[:2])
    k = row.index(path)
    around = [*row[k - 1:k], *row[k + 1:k + 2]]
    lines = text_of(path).splitlines()
    assert re.match(rf"# {path.stem.partition('_')[0]} [A-Z]", lines[0])
    for line in (lines[2], lines[-1]):
        assert re.findall(r"\]\((\d\d\w+\.ipynb)\)", line.replace("](00_start_here.ipynb)", "]")
                          if k > 1 else line)[-len(around):] == [one.name for one in around]
    links = "".join(text_of(page).splitlines()[2] for page in hours.pages(lab))
    for topic in exercises.LABS[lab - 1]:
        assert f"](../{places.shown_path(exercises.reference(topic))})" in links
    assert re.search(rf"\]\(../labs/({'|'.join(exercises.LABS[lab - 1])})\.py\)", lines[2])


@each_page
def test_links_lead_somewhere(path):
    """A file that has been renamed."""
    found = re.findall(r"\]\((?!https?://)([^)#]+)(?:#[^)]*)?\)", text_of(path))
    assert [link for link in found if not (path.parent / link).exists()] == []
    assert found


@each_lecture
def test_a_lecture_has_all_its_parts(path):
    """No word on what comes of it, no algorithm at a glance, no guess, no sources."""
    text = text_of(path)
    if path in map(exercises.lecture, exercises.TOPICS):  # no page after a lecture
        assert text.count("**What you will have built.**") == 1
        assert "**Guess first.** " in text
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
                     exercises.cells(path)[0])
    assert notebooks.openings(notebooks.parsed(path)) == [opening.read_bytes()]


@each_page
def test_no_picture_has_ink_on_its_left_or_right_edge(path):
    """A title or a label that is longer than its picture is wide, and ends in the middle."""
    for cell in notebooks.parsed(path).cells:
        for output in pictures.pictures_of(cell) if "outputs" in cell else ():
            picture = Image.open(io.BytesIO(base64.b64decode(output.data["image/png"])))
            edges = np.asarray(picture.convert("L"))[:, [0, -1]]
            assert edges.min() > 200, f"{cell.id}: {cell.source[:60]}"


@each_lecture
def test_a_lecture_takes_40_minutes_at_most(path):
    """Two lectures in one, by the minutes that the web site prints."""
    assert hours.minutes(path) <= 40


@each_lab
def test_equations_are_numbered_in_the_order_in_which_they_come(lab):
    """Equation (4) before equation (1); a number that is left out, or stands on two pages; two in
    one display, which cannot be rendered.
    """
    texts = list(map(text_of, hours.pages(lab)))
    tags = [[int(tag) for tag in re.findall(r"\\tag\{(\d+)", text)] for text in texts]
    assert tags == list(map(sorted, tags)) and tags[0]
    numbers = [number for page in tags for number in dict.fromkeys(page)]  # page after page
    assert numbers == list(range(1, len(numbers) + 1))
    assert not re.search(r"\\tag((?!\$\$).)*\\tag", "".join(texts), re.DOTALL)


@each_lab
def test_each_core_exercise_stands_where_the_text_reaches_it(lab):
    """An exercise that the lecture forgets, asks twice, or does not check."""
    core = {exercise.number for exercise in hours.core(lab)}
    text = "\n".join(map(text_of, hours.pages(lab)))
    lines = re.findall(r"^\*\*(?:Exercise|Step)s? .*", text, re.MULTILINE)
    named = re.findall(rf"\b{lab}\.\d+\b", "\n".join(line.partition("*Extra")[0] for line in lines))
    assert sorted(named) == sorted(core)
    shown = re.findall(r'^board\.show\("([\d.]+)"\)$', "\n".join(
        cell for path in hours.pages(lab) for cell in exercises.cells(path, "code")
        if cell.startswith("# live")), re.MULTILINE)
    assert sorted(shown) == sorted(core)


@each_page
def test_a_lecture_begins_and_its_figures_are_folded_away(path):
    """A lecture that fails when it is opened in Jupyter, or stops at the first exercise that is
    missing; a page full of plotting code.
    """
    first, *others = exercises.cells(path, "code")
    assert first.startswith(FIRST_LINE + "\n") and first.endswith("lecture.begin()")
    draws = re.compile(r"^(axes.*= plot\.panels|figure, axes = plt|.*sketch\.sheet|plot\.film)",
                       re.MULTILINE)
    assert [cell[:60] for cell in others
            if draws.search(cell) and not cell.startswith(hours.FOLDED)] == []


@each_page
def test_cells_leave_modules_as_they_are(path):
    """A constant or a function that a cell replaces, for all cells after it."""
    nodes = [node for code in exercises.cells(path, "code") if not code.startswith("# live")
             for node in ast.walk(ast.parse(code))]
    modules = {alias.asname or alias.name for node in nodes if isinstance(node, ast.ImportFrom)
               for alias in node.names}
    changed = [ast.unparse(node) for node in nodes if isinstance(node, ast.Attribute)
               and isinstance(node.ctx, ast.Store) and getattr(node.value, "id", "") in modules]
    assert changed == []


@each_page
@pytest.mark.parametrize("wrong", WORDING)
def test_a_lecture_is_written_in_the_words_of_the_field(path, wrong):
    """English that was translated word by word."""
    assert not re.search(rf"\b{wrong}\b", text_of(path)), f"write {WORDING[wrong]}"


def test_the_page_of_errata_is_what_the_lectures_say():
    """An erratum that was mended in its lecture, and not on the page."""
    assert (ROOT / "notebooks" / "errata.md").read_text(encoding="utf-8") == errata.page()
