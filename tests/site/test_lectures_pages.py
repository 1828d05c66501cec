"""The lectures on the site: what the notebooks say is there, and more links."""
import functools
import json

import nbformat
import pytest
from axe_playwright_python.sync_playwright import Axe
from bs4 import BeautifulSoup
from pages import formulas, inserts, lectures, names
from serving import PAGES, ROOT, SITE

NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lectures")
    lectures.write(folder, folder / "extra", lite=True)
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
    *placed, last = added.made
    for name in placed:
        added.put_in(f"**Drag** ([on the site](../site/README.md#{name})).")
    with pytest.raises(ValueError, match=f"no lecture has a place for {last}"):
        added.require_all()


def test_a_link_to_a_file_without_a_page_becomes_code():
    """A dead link on the site."""
    assert lectures.linked("[setup](../pyproject.toml)") == "`setup`"


def test_the_first_line_says_where_to_run_and_to_read_a_lecture(written):
    """Who wants to run a lecture has to find JupyterLite, the notebook and the code."""
    cell = nbformat.read(written / "lectures" / "02_rasterization.ipynb", 4).cells[0]
    line, = (line for line in cell.source.splitlines() if " · " in line)
    assert line == (
        '<a href="../lite/lab/index.html?path=notebooks/02_rasterization.ipynb">Run here</a> · '
        '<a href="02_rasterization.ipynb" download>Notebook</a> · '
        "Source: [rasterization](/reference/rasterization.md), [scanline](/reference/scanline.md)"
        " · [Lab 2](/labs/02_rasterization.md) · about 65 minutes to read")
    assert (written / "extra" / "lectures" / "02_rasterization.ipynb").read_bytes() == (
        ROOT / "notebooks" / "02_rasterization.ipynb").read_bytes()


def test_without_jupyterlite_no_link_leads_to_it():
    """A dead link where the site was made without --lite."""
    assert "Run here" not in lectures.ways(NOTEBOOKS[3], "code: x", lite=False)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_neighbours_and_imports_are_out_of_the_way(path, written):
    """Every lecture ends with "all lectures ·" and begins with a cell of imports."""
    cells = nbformat.read(written / "lectures" / path.name, 4).cells
    texts = [cell.source for cell in cells if cell.cell_type == "markdown"]
    assert not [text for text in texts if "[all lectures]" in text or "→]" in text]
    folded = [cell.metadata.tags for cell in cells if cell.source.startswith("import sys; sys.")]
    assert folded == [["hide-input"]]


@functools.cache
def article(page):
    """The text of a page of the site that was made."""
    html = (SITE / page).read_text("utf-8")
    return BeautifulSoup(html, "html.parser").find("article")


def links(lecture, words):
    """The addresses of the links with these words."""
    path, = SITE.glob(f"lectures/{lecture}_*.html")
    found = article(path.relative_to(SITE).as_posix()).find_all("a", href=True)
    return [link["href"] for link in found if link.get_text() == words]


@pytest.mark.parametrize(("lecture", "words", "address"), [
    ("02", "(3)", "#equation-3"),
    ("02", "section 10", "#10-behind-the-camera"),
    ("02", "6", "#6-the-shared-edge-whose-is-the-pixel"),  # "sections 2 to 6"
    ("02", "lecture 04", "04_msaa.html"),
    ("05", "(3)", "02_rasterization.html#equation-3"),     # "of lecture 02"
    ("09", "(4)", "09b_cube_pose_and_texture.html#equation-4"),
    ("09b", "section 6", "09_inverse_rendering.html#6-where-the-blend-stops-being-differentiable"),
    ("14b", "(1)", "14_shadow_mapping.html#equation-1"),
    ("02", "2.1", "../labs/02_rasterization.html#exercise-2-1"),
    ("08", "crossing", "../reference/antialiasing.html#reference.antialiasing.crossing"),
    ("02", "z-buffer", "../glossary.html#term-z-buffer")])
def test_what_a_lecture_names_is_a_link(lecture, words, address):
    """A reader scrolls for equation (3), or looks up a word by hand."""
    assert address in links(lecture, words)


@pytest.mark.parametrize(("lecture", "words"), [
    ("02", "(4)"),   # of a journal, 22(4); the equation (4) is linked elsewhere
    ("05", "section 3"),  # "2020, section 3" is in a paper
    ("16", "(2)"),   # of the introduction: "rasterization (2)" is a lab
    ("02", "tiles")])  # of a wall, not of a picture
def test_what_only_looks_so_is_no_link(lecture, words):
    """A link leads to another thing than the sentence means."""
    path, = SITE.glob(f"lectures/{lecture}_*.html")
    whole = article(path.relative_to(SITE).as_posix())
    around = {"02(4)": "Pineda", "05section 3": "Laine", "16(2)": "will have built",
              "02tiles": "height maps"}[lecture + words]
    place = next(place for place in whole.find_all(["p", "li"]) if around in place.get_text()
                 and words in place.get_text())
    assert not [link for link in place.find_all("a") if link.get_text() == words]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_lecture_links_where_it_may_and_numbers_its_figures(path):
    """A link in a heading, in code or in a formula; a word linked twice; a figure without a number.
    """
    whole = article(f"lectures/{path.stem}.html")
    assert not whole.select(":is(h1, h2, h3, pre, math, a) a:not(.headerlink)")
    words = [link["href"] for link in whole.select("a.term")]
    assert words and len(words) == len(set(words))
    assert all(len(link["title"]) > 20 for link in whole.select("a.term"))
    figures = whole.select("figure:is(.drawn, .animation)")
    assert [figure.parent["id"] for figure in figures] == [
        f"figure-{number}" for number in range(1, len(figures) + 1)]
    assert all(figure.parent.find("figcaption").get_text().startswith(f"Figure {number} in words")
               for number, figure in enumerate(figures, 1))


def test_the_words_of_a_button_are_its_name(page, address):
    """Who speaks to the computer says "How it is drawn", and nothing has this name."""
    page.goto(f"{address}/lectures/02_rasterization.html")
    rules = {"runOnly": ["label-content-name-mismatch"]}
    found = Axe().run(page, {"include": [["article"]], "exclude": [[".controls"]]}, rules)
    assert [node["html"] for rule in found.response["violations"] for node in rule["nodes"]] == []


def test_a_lecture_on_paper_in_the_dark_and_by_the_copy_button(page, address):
    """"Skip to content" is printed over the text; white pictures glare; outputs are copied, and
    letters of code are too small to read.
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
    page.emulate_media(media="print")
    assert page.locator(".skip-to-content").evaluate(style, "display") == "none"


def test_pages_of_files():
    """A README's link leads to a file that is not on the site."""
    assert names.page_of_file("labs/outlines.py") == "labs/08_antialiasing"
    assert names.page_of_file("reference/outlines.py") == "reference/outlines"
    assert names.page_of_file("notebooks/02_rasterization.ipynb") == "lectures/02_rasterization"
    assert names.page_of_file("LICENSE") is None


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
    texts = [(SITE / page).read_text("utf-8") for page in PAGES]
    letters = set("".join(math.get_text() for text in texts if "<math" in text
                          for math in BeautifulSoup(text, "html.parser").find_all("math")))
    assert len(letters) > 100
    assert [letter for letter in letters if ord(letter) not in known and letter != "\n"] == []


def test_a_formula_with_a_mistake_ends_the_build():
    """Red letters on a page that nobody looks at."""
    with pytest.raises(ValueError, match=r"cannot read the formula '\\\\frac\{'"):
        formulas.formula(r"\frac{", False)
