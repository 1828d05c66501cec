"""The lectures on the site: what the notebooks say is there, and more links."""
import json
import re
import sys

import pytest
from bs4 import BeautifulSoup
from serving import ROOT

sys.path.insert(0, str(ROOT / "site"))

from pages import formulas, inserts, lectures, names

NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lectures")
    lectures.write(folder, folder / "extra")
    return folder


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_lecture_shows_every_picture_with_its_words_and_size(path, written):
    """A picture is lost, or stands there without its words."""
    def outputs(notebook):
        return [output for cell in json.loads(notebook.read_text("utf-8"))["cells"]
                for output in cell.get("outputs", [])]

    given = [output["metadata"]["image/png"] for output in outputs(path)
             if "image/png" in output.get("data", {})]
    html = "".join("".join(output["data"]["text/html"])
                   for output in outputs(written / "lectures" / path.name)
                   if "text/html" in output.get("data", {}))
    shown = BeautifulSoup(html, "html.parser").find_all("img")
    assert [picture["alt"] for picture in shown] == [about["alt"] for about in given]
    assert [int(picture["width"]) for picture in shown] == [about["width"] for about in given]
    for picture in shown:
        assert (written / "extra" / "lectures" / picture["src"]).exists()


@pytest.mark.parametrize(("figure", "lecture"), [
    ('data-figure=\\"antialias\\"', "08_antialiasing"),
    ('class=\\"orbit\\"', "12_simplification"),
    ('class=\\"before-after\\"', "04_msaa")])
def test_what_the_site_adds_has_its_place(figure, lecture, written):
    """A figure that answers is there twice, or in another lecture."""
    found = [path.stem for path in NOTEBOOKS for _ in range(
        (written / "lectures" / path.name).read_text("utf-8").count(figure))]
    assert found.count(lecture) == 1


def test_a_name_without_a_figure_and_a_figure_without_a_place_end_the_build(tmp_path):
    """A figure is renamed, or its paragraph goes, and it is missing without a sound."""
    added = inserts.Inserts(tmp_path)
    with pytest.raises(ValueError, match="the figure edges, and site/static/figures has none"):
        added.put_in("**Drag** ([on the site](../site/README.md#edges)).")
    for name in [*added.made, *inserts.answering()[1:]]:
        added.put_in(f"**Drag** ([on the site](../site/README.md#{name})).")
    with pytest.raises(ValueError, match=f"no lecture has a place for {inserts.answering()[0]}"):
        added.require_all()


def test_an_exercise_and_a_function_are_linked():
    """A reader of a lecture has to search for the exercise that it announces."""
    text = lectures.linked("**Exercise 8.7** `crossing`. Then `crossing` again, and `np`.", 8)
    assert ('<a href="../labs/08_antialiasing.html#exercise-8-7">8.7</a>** <a class="function" '
            'href="../reference/antialiasing.html#reference.antialiasing.crossing">') in text
    assert text.endswith("</a>. Then `crossing` again, and `np`.")


def test_a_version_or_a_section_is_no_exercise():
    """Python 3.11 becomes a link to lab 3."""
    text = "It needs Python 3.11. See section 4.2."
    assert lectures.linked(text, 4) == text


def test_a_link_to_a_file_without_a_page_is_refused():
    """A dead link on the site."""
    with pytest.raises(ValueError, match="no page of the site"):
        lectures.linked("[setup](../pyproject.toml)", 1)


def test_pages_of_files():
    """A README's link leads to a file that is not on the site."""
    assert names.page_of_file("labs/outlines.py") == "labs/08_antialiasing"
    assert names.page_of_file("reference/outlines.py") == "reference/outlines"
    assert names.page_of_file("notebooks/02_rasterization.ipynb") == "lectures/02_rasterization"
    assert names.page_of_file("LICENSE") is None


def test_a_formula_is_a_drawing_with_its_words_for_screen_readers():
    """Formulas need a script of two megabytes, or cannot be heard."""
    drawn = formulas.formula(r"\frac{x_0}{2}\tag{3}", True)
    assert "<svg" in drawn and "<math" in drawn and "<script" not in drawn
    assert re.search(r"<mn>2</mn>", drawn)


def test_a_formula_with_a_mistake_ends_the_build():
    """Red letters on a page that nobody looks at."""
    with pytest.raises(ValueError, match=r"cannot read the formula '\\\\frac\{'"):
        formulas.formula(r"\frac{", False)
