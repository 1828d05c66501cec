"""The annotated source and the labs' pages: nothing of the code and of its words is lost.

They look at the site that `python3 -m course site` has made.
"""
import ast
import copy
import re

import pytest
from bs4 import BeautifulSoup
from docutils.core import publish_doctree
from pages import names, sources, sources_course, sources_text, texts_links
from serving import soup

from labkit import exercises

COURSE = sources_course.read()
MODULES = sorted(COURSE.modules)
LABS = sorted(COURSE.lectures)


def source_page(name):
    module = COURSE.modules[name]
    return soup(f"{module.folder}/{module.topic}.html")


def lab_page(lab):
    return soup(f"labs/{COURSE.lectures[lab].page}.html")


def letters(text):
    """Without white space, and without the marks of code."""
    return re.sub(r"[\s`]", "", text)


def prose(element, *added):
    """What is left of a page's part without what was added to its docstring."""
    element = copy.copy(element)
    for part in element.select(", ".join([".math", *added])):
        part.decompose()
    return letters(element.get_text())


def typed(module):
    """A module's docstring without the tables that are typeset."""
    known = COURSE.equations(module)
    return "".join(part for part in sources_text.paragraphs(ast.get_docstring(module.tree))
                   if not sources_text.is_typeset(part, known))


@pytest.mark.parametrize("name", MODULES)
def test_a_page_holds_its_module(name):
    """A star of `x*` was taken for emphasis; a function or its code is missing."""
    module, page = COURSE.modules[name], source_page(name)
    shown = {dt["id"].rpartition(".")[2]: dt.find_next_sibling("dd")
             for dt in page.select("dl.py > dt[id]")}
    assert [name for name in shown if name in module.nodes] == [*module.nodes]
    for function, node in module.nodes.items():
        said = prose(shown[function], 'p > a[href*="exercise-"]:only-child')
        code = sources.code(module, node)
        assert said == letters((ast.get_docstring(node) or "") + code), function
    opening = prose(page.select_one("article section"), "h1", "h1 + p", "dl.py")
    assert opening == letters(typed(module))


@pytest.mark.parametrize("lab", LABS)
def test_a_formula_is_one_of_its_lecture(lab):
    """It is another, or has a number that is not its lecture's."""
    lecture = {int(element["id"].removeprefix("equation-")): letters(element.math.get_text())
               for path in exercises.pages(exercises.LABS[lab - 1][0])
               for element in soup(f"lectures/{path.stem}.html").select(".math[id]")}
    shown = {letters(element.math.get_text()) for module in COURSE.modules.values()
             if module.lab == lab for element in source_page(module.name).select("div.math")}
    assert shown and shown <= {f"{formula}({number})" for number, formula in lecture.items()}


@pytest.mark.parametrize("lab", LABS)
def test_a_lab_has_all_its_questions_and_no_answer(lab):
    """An exercise is not on its page, or its answer is."""
    asked, sections = COURSE.lectures[lab].asked, 'section[id^="exercise-"]'
    shown = {element["id"]: element for element in lab_page(lab).select(sections)}
    assert list(shown) == [names.anchor(exercise.number) for exercise in asked.values()]
    listed = soup("labs/index.html").get_text()
    for name, exercise in asked.items():
        module, node = COURSE.module_and_node(name)
        element = shown[names.anchor(exercise.number)]
        assert f"{exercise.number} {exercise.name}" in element.h2.get_text()
        assert f"{exercise.number} {exercise.name}" in listed
        assert names.mark(exercise) in element.get_text()
        assert prose(element, ".marks", ".signature", ".read-on", "h2", ".practice", ".draws") \
            == letters(ast.get_docstring(node))
        assert f"({ast.unparse(node.args)})" in element.select_one(".signature").get_text()
        assert answer_lines(module, node) & {*map(str.strip, element.get_text().splitlines())} \
            == set()
        assert f'../reference/{module.topic}.html#{name}' in str(element)
    assert ("EDGES = (1, 2)" in lab_page(lab).get_text()) == (lab in (2, 5, 8))  # questions name it


def answer_lines(module, node):
    """The longer lines of a function below its docstring."""
    lines = module.text.splitlines()[node.body[0].end_lineno:node.end_lineno]
    return {line.strip() for line in lines if len(line.strip()) > 12}


@pytest.mark.parametrize("lab", LABS)
def test_a_question_leads_to_where_the_lecture_asks_it(lab):
    """The link leads to the section before, or to the top."""
    for exercise in COURSE.lectures[lab].asked.values():
        anchor = names.anchor(exercise.number)
        links = lab_page(lab).select_one(f"#{anchor}").select('.read-on a[href*="/lectures/"]')
        page, _, place = links[0]["href"].removeprefix("../").partition(".html#")
        section = soup(f"{page}.html").find(id=place)
        assert re.search(rf"\b{re.escape(exercise.number)}\b", section.get_text()), exercise.name


@pytest.mark.parametrize("text", [
    "a*b* and x* and *c*", "_a_ __init__ b_", "|n| <b> & &amp; <!-- -->", "(..., 2) -> e (...)",
    r"\alpha \* $x$ $$y$$", "1. one\n2. two\n- three", "# no heading\n===\n---", "`a` and ``b``",
    "``````{raw} html", ":::::{py:function}", "> no quotation", '"quotes" -- it\'s...'])
def test_no_letter_is_markup(text):
    """A docstring is plain text."""
    module = COURSE.modules["reference.antialiasing"]
    shown = publish_doctree(sources_text.block(COURSE, module, text), settings_overrides={
        "report_level": 1, "halt_level": 1}).astext()
    assert letters(shown) == letters(text)


def test_names_become_links_to_the_right_places():
    """`crossing_backward` is in two modules; `tube` is a parameter; lab 17 has kernels' names."""
    def target(name, text, own=()):
        shown = sources_text.link(COURSE, COURSE.modules[name], text, own)
        found = re.search("<(.*)>", shown)
        return found and found[1]
    assert target("reference.antialiasing", "crossing_backward") \
        == "reference.antialiasing.crossing_backward"
    assert target("reference.shape_rendering", "sphere_trace") \
        == "reference.implicit_surfaces.sphere_trace"
    assert target("reference.reconstruction", "course.given.mesh.vertex_normals") \
        == "course.given.mesh.vertex_normals"
    assert target("reference.regularization", "remeshing") == "reference.remeshing"
    assert target("reference.regularization", "edge_function") \
        == "reference.rasterization.edge_function"
    assert target("course.given.mesh", "radius", ("radius", "tube")) is None
    assert target("reference.antialiasing", "no_such_function") is None


def test_a_text_links_the_functions_that_it_names_and_no_others():
    """`np.clip` leads to a function `clip`; a paragraph is full of one link; kernels are meant."""
    def links(text):
        shown = texts_links.linked(text, "notebooks")
        return [link["href"] for link in BeautifulSoup(shown, "html.parser").find_all("a")]
    place = "reference/{0}.html#reference.{0}.{1}"
    assert links("`crossing` and `crossing`") == [place.format("antialiasing", "crossing")]
    assert names.function_page("crossing", 17) == place.format("pair_kernels", "crossing")
    assert links("`texture_cubes.render`") == [place.format("texture_cubes", "render")]
    assert links("`np.crossing`, `rasterize`, `unit_of_nothing`, ``crossing``, `mesh`") == []
    assert texts_links.linked("[a](../labs/outlines.py#b), [c](../LICENSE)", "notebooks") \
        == "[a](/labs/08_antialiasing.md#b), `c`"
