"""The lectures on the site: what the notebooks say is there, and more links."""
import itertools
import json
import re

import pytest
import stills
from bs4 import BeautifulSoup
from checks import barriers
from pages import formulas, inserts, turntables
from serving import PAGES, ROOT, SITE, soup

from labkit import exercises

NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))


def article(path):
    """The text of a notebook's page on the site that was made."""
    return soup(f"lectures/{path.stem}.html").article


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_lecture_shows_every_picture_with_its_words_and_size(path):
    """A picture is lost, or stands there without its words."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    given = [output["metadata"]["image/png"] for cell in cells
             for output in cell.get("outputs", []) if "image/png" in output.get("data", {})]
    shown = article(path).select(".cell_output img")
    assert [(picture["alt"], int(picture["width"])) for picture in shown] == [
        (about["alt"], about["width"]) for about in given]


def test_a_name_without_a_figure_and_a_figure_without_a_place_end_the_build(tmp_path):
    """A figure is renamed, or its paragraph goes, and it is missing without a sound."""
    added = inserts.Inserts(tmp_path)
    with pytest.raises(ValueError, match="the figure edges, and site/static/figures has none"):
        added.put_in("**Drag** ([on the site](../site/README.md#edges)).")
    *placed, last = added.made
    for name in placed:
        added.put_in(still_of(name))
    with pytest.raises(ValueError, match=f"no lecture has a place for {last}"):
        added.require_all()
    there = f"[On the site](../site/README.md#{last})"
    shown = added.put_in(f"**{there}** drag it.\n\n{still_of(last)}")
    assert shown.startswith(f"**Here** drag it.\n\n{added.made[last]}")
    added.require_all()


def still_of(name):
    """A paragraph with a figure's still, as lectures have it."""
    return (f'<a href="../site/README.md#{name}"><img src="stills/{name}.webp" width="700" '
            'alt="a figure"></a>')


def test_where_a_figure_is_named_its_still_stands_and_each_has_one():
    """In Jupyter a paragraph says "drag", above nothing; or the still of a figure that is gone."""
    figures = {*inserts.answering(), *turntables.TURNED}
    texts = ["\n\n".join(exercises.cells(path)) for path in NOTEBOOKS]
    shown = [[found[0] for found in inserts.STILL.findall(text)] for text in texts]
    assert shown == [inserts.LINK.findall(text) for text in texts]
    assert sorted(itertools.chain(*shown)) == sorted(figures)
    files = {path.stem: path.stat().st_size for path in stills.FOLDER.iterdir()}
    assert files.keys() == figures and max(files.values()) <= 75_000


def test_the_first_line_says_where_to_run_and_to_read_a_lecture():
    """Who wants to run a lecture has to find the course and the code."""
    path = lecture("02")
    line = article(path).select_one(".ways")
    assert line.get_text() == "Run it · Source: rasterization · Lab 2 · about 35 minutes to read"
    assert line.a["href"] == "../index.html#get-the-course"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_neighbours_and_imports_are_out_of_the_way(path):
    """Every lecture ends with "all lectures ·" and begins with a cell of imports."""
    assert not [link for link in article(path).find_all("a")
                if link.get_text() == "all lectures" or link.get_text().endswith("→")]
    imports = [cell for cell in article(path).select(".cell")
               if "import sys; sys." in cell.get_text()]
    assert ["tag_hide-input" in cell["class"] for cell in imports] == [True]


def lecture(number):
    """The notebook with this number."""
    path, = ROOT.glob(f"notebooks/{number}_*.ipynb")
    return path


@pytest.mark.parametrize(("number", "words", "address"), [
    ("02", "(3)", "#equation-3"),
    ("02", "section 10", "#10-behind-the-camera"),
    ("10", "8", "#8-fits"),  # "sections 5 to 8"
    ("02", "lecture 04", "04_msaa.html"),
    ("05", "(3)", "02_rasterization.html#equation-3"),     # "of lecture 02"
    ("09", "(6)", "09b_cube_pose_and_texture.html#equation-6"),
    ("09b", "section 6", "09_inverse_rendering.html#6-where-the-blend-stops-being-differentiable"),
    ("14b", "(1)", "14_shadow_mapping.html#equation-1"),
    ("02", "2.1", "../labs/02_rasterization.html#exercise-2-1"),
    ("08", "crossing", "../reference/antialiasing.html#reference.antialiasing.crossing"),
    ("02", "z-buffer", "../glossary.html#term-z-buffer")])
def test_what_a_lecture_names_is_a_link(number, words, address):
    """A reader scrolls for equation (3), or looks up a word by hand."""
    assert address in [link["href"] for link in article(lecture(number)).find_all("a", href=True)
                       if link.get_text() == words]


@pytest.mark.parametrize(("number", "words", "around"), [
    ("02", "(4)", "Pineda"),           # of a journal, 22(4); the equation (4) is linked elsewhere
    ("05", "section 3", "Laine"),      # "2020, section 3" is in a paper
    ("16", "(2)", "will have built"),  # "rasterization (2)" is a lab
    ("02", "tiles", "height maps")])   # of a wall, not of a picture
def test_what_only_looks_so_is_no_link(number, words, around):
    """A link leads to another thing than the sentence means."""
    place = next(place for place in article(lecture(number)).find_all(["p", "li"])
                 if around in place.get_text() and words in place.get_text())
    assert not [link for link in place.find_all("a") if link.get_text() == words]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_lecture_links_where_it_may_and_numbers_its_figures(path):
    """A link in a heading, in code or in a formula; a word linked twice; a figure without a number.
    """
    whole = article(path)
    assert not whole.select(":is(h1, h2, h3, pre, math, a) a:not(.headerlink)")
    words = [link["href"] for link in whole.select("a.term")]
    assert words and len(words) == len(set(words))
    assert all(len(link["title"]) > 20 for link in whole.select("a.term"))
    figures = whole.select("figure:is(.drawn, .animation):not(:has(> figcaption))")
    assert [figure.parent["id"] for figure in figures] == [
        f"figure-{number}" for number in range(1, len(figures) + 1)]
    assert all(figure.parent.find("figcaption").get_text().startswith(f"Figure {number} in words")
               for number, figure in enumerate(figures, 1))


@pytest.mark.parametrize("name", ["04_msaa", "12_simplification"])
def test_without_scripts_there_are_all_pictures_and_nothing_else(name, new_page, address):
    """An empty box where a figure would answer, or a button that does nothing."""
    page = new_page(java_script_enabled=False)
    page.goto(f"{address}/lectures/{name}.html")
    assert page.locator("article :is(button, input, canvas), .answers:visible").count() == 0
    stills = page.locator("figure.animation img")
    assert stills.and_(page.locator(":visible")).count() == stills.count() > 0


def test_the_words_of_a_button_are_its_name(page, address):
    """Who speaks to the computer says "How it is drawn", and nothing has this name."""
    page.goto(f"{address}/lectures/02_rasterization.html")
    place = {"include": [["article"]], "exclude": [[".controls"]]}
    assert barriers(page, place, runOnly=["label-content-name-mismatch"]) == []


def test_a_lecture_on_paper_in_the_dark_and_by_the_copy_button(page, address):
    """"Skip to content" is printed over the text, and a figure's paragraph above nothing; white
    pictures glare; outputs are copied, and letters of code are too small to read.
    """
    page.goto(f"{address}/lectures/02_rasterization.html")
    page.locator(".cell_input .copybtn").first.wait_for(state="attached")
    assert page.locator(".cell_output .copybtn").count() == 0
    style = "(e, name) => getComputedStyle(e)[name]"
    code = page.locator(".cell_input pre").nth(1)
    assert code.evaluate(style, "fontSize") == "13px"
    picture = page.locator("figure.drawn img").first
    assert picture.evaluate(style, "filter") == "brightness(1)"
    page.emulate_media(color_scheme="dark")
    assert picture.evaluate(style, "filter") == "brightness(0.82)"
    both = [page.locator(".answers"), page.locator("img.still")]
    assert [one.is_visible() for one in both] == [True, False]
    page.emulate_media(media="print")
    assert [one.is_visible() for one in both] == [False, True]
    assert page.locator(".skip-to-content").evaluate(style, "display") == "none"


def test_a_formula_is_for_eyes_and_ears_without_a_script():
    """Formulas need a script of two megabytes, or cannot be heard."""
    found = formulas.formula(r"\frac{x_0}{2}", True)
    assert found == ('<math display="block"><mfrac><msub><mi>x</mi><mn>0</mn></msub><mn>2</mn>'
                     "</mfrac></math>")


def test_the_font_has_every_letter_of_the_formulas():
    """A new formula has a letter from another font."""
    ranges = (ROOT / "site/static/vendor/stix/letters.txt").read_text().replace("U+", "").split()
    ends = [[int(end, 16) for end in part.split("-")] for part in ranges]
    known = {code for first, *last in ends for code in range(first, (last or [first])[0] + 1)}
    formulas_there = "".join(math for page in PAGES for math in re.findall(
        "<math.*?</math>", (SITE / page).read_text("utf-8"), re.DOTALL))
    letters = set(BeautifulSoup(formulas_there, "html.parser").get_text())
    assert len(letters) > 100
    assert [letter for letter in letters if ord(letter) not in known and letter != "\n"] == []


def test_a_formula_with_a_mistake_ends_the_build():
    """Red letters on a page that nobody looks at."""
    with pytest.raises(ValueError, match=r"cannot read the formula '\\\\frac\{'"):
        formulas.formula(r"\frac{", False)
