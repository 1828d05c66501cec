"""The annotated source and the labs' pages: nothing of the code and of its words is lost.

They look at the site that `python3 -m course site` has made.
"""
import ast
import collections
import copy
import functools
import re

import pytest
from bs4 import BeautifulSoup
from pages import labs, names, sources_course, sources_text, texts_links
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


def prose(element):
    """The text of a docstring's place on a page, without what was added to it."""
    element = copy.copy(element)
    for added in element.select(".marks, .equation, .belongs, .signature, .read-on, h2, "
                                ".as-typed > summary, .practice, .draws"):
        added.decompose()
    return element.get_text()


def docstrings(module):
    """{name: docstring} of a module's functions and classes, and of itself: ""."""
    found = {name: ast.get_docstring(node) or "" for name, node in module.nodes.items()}
    return {"": ast.get_docstring(module.tree), **found}


def places(module, page):
    """{name: element} where their docstrings stand."""
    dts = {dt["id"].removeprefix(f"{module.name}."): dt.find_next_sibling("dd")
           for dt in page.select("dl.py > dt[id]")}
    return {"": page.select_one(".opening"),
            **{name: dd.select_one(".said") for name, dd in dts.items()}}


def wrong_functions(module, page):
    """Functions and classes that are not there exactly once, or in another order."""
    shown = [dt["id"].rpartition(".")[2] for dt in page.select("dl.function > dt, dl.class > dt")]
    return [] if shown == list(module.nodes) else [shown]


def wrong_letters(module, page):
    """Docstrings that a page does not hold as they are."""
    shown = places(module, page)
    return [name for name, text in docstrings(module).items()
            if name not in shown or letters(prose(shown[name])) != letters(text)]


def wrong_lines(module, page):
    """Numbers of lines that are missing, hold something else, or are there twice.

    Docstrings are beside the code, and what a check reads is nowhere.
    """
    inside = {n for node in (module.tree, *module.nodes.values()) if ast.get_docstring(node)
              for n in range(node.body[0].lineno, node.body[0].end_lineno + 1)}
    lines = module.text.splitlines()
    shown = collections.defaultdict(list)
    for row in (row for pre in page.select(".code > pre") for row in pre.get_text().splitlines()):
        number, code = re.match(r"(\d+)(.*)", row).groups()
        shown[int(number)].append(code)
    for element in page.select('[id^="line-"]:not(.linenos)'):
        shown[int(element["id"].removeprefix("line-"))].append(section_text(element))
    anchors = {int(element["id"].removeprefix("line-")) for element in page.select('[id^="line-"]')}
    expected = {n for n, line in enumerate(lines, 1) if line.strip() and n not in inside}
    strange = {n for n, texts in shown.items() if len(texts) != 1 or n in inside
               or (texts[0] != lines[n - 1] and plain(lines[n - 1]) not in texts[0])}
    return sorted(expected - set(shown) | strange | anchors ^ set(shown))


def section_text(element):
    """A heading and what stands below it."""
    return plain(element.find_previous("h2").get_text() + " " + element.parent.get_text())


def plain(text):
    return re.sub(r"[#.]|--+", "", letters(text))


def wrong_equations(module, page):
    """Docstrings whose equations are not there, drawn as in the lecture and with their number."""
    shown, wrong = places(module, page), []
    for name, text in docstrings(module).items():
        tables = name == ""
        named = {number for part in sources_text.paragraphs(text)
                 if sources_text.is_table(part) == tables
                 for number in sources_text.named_equations(part) if module.lab}
        found = {}
        for equation in shown[name].select(".equation") if name in shown else ():
            number = equation.select_one(".number")
            found[int(number.get_text().strip("()"))] = (equation, number["href"])
        if set(found) != named or not all(
                (href, formula(equation)) == lecture_formulas(module.lab)[number]
                for number, (equation, href) in found.items()):
            wrong.append(name)
    return wrong


def formula(element):
    """The letters of a formula, without its number."""
    return letters(element.select_one("math").get_text())


@functools.cache
def lecture_formulas(lab):
    """{number: address and formula} of a lecture, and of the page after it."""
    return {int(element["id"].removeprefix("equation-")):
            (f"../lectures/{path.stem}.html#{element['id']}", formula(element))
            for path in exercises.pages(exercises.LABS[lab - 1][0])
            for element in soup(f"lectures/{path.stem}.html").select(".math[id]")}


@pytest.mark.parametrize("name", MODULES)
def test_a_page_holds_its_module(name):
    """A star of `x*` was taken for emphasis; a line number is off by one; a formula is another, or
    has a number that is not its lecture's."""
    shown = COURSE.modules[name], source_page(name)
    assert wrong_functions(*shown) == []
    assert wrong_letters(*shown) == []
    assert wrong_lines(*shown) == []
    assert wrong_equations(*shown) == []


def test_many_equations_are_typeset():
    """The check above finds nothing where no equation is named."""
    assert sum(len(source_page(name).select(".equation")) for name in MODULES) > 400


def test_a_table_of_equations_is_folded_where_all_of_it_is_typeset():
    """The equations stand there twice; or a line that is only in the table is hidden."""
    folded = {name for name in MODULES if source_page(name).select(".opening .as-typed .table")}
    assert {"reference.antialiasing", "reference.sampling"} <= folded
    assert not folded & {"course.given.arrays", "reference.received_light", "course.given.sweeps"}


@pytest.mark.parametrize("lab", LABS)
def test_a_lab_has_all_its_questions_and_no_answer(lab):
    """An exercise is not on its page, or its answer is."""
    asked, sections = COURSE.lectures[lab].asked, 'section[id^="exercise-"]'
    shown = {element["id"]: element for element in lab_page(lab).select(sections)}
    assert list(shown) == [names.anchor(exercise.number) for exercise in asked.values()]
    listed = soup("labs/index.html").get_text()
    for name, exercise in asked.items():
        module, node = labs.module_and_node(COURSE, name)
        element = shown[names.anchor(exercise.number)]
        assert f"{exercise.number} {exercise.name}" in element.h2.get_text()
        assert f"{exercise.number} {exercise.name}" in listed
        assert names.mark(exercise) in element.get_text()
        assert letters(prose(element)) == letters(ast.get_docstring(node))
        assert f"({ast.unparse(node.args)})" in element.select_one(".signature").get_text()
        assert answer_lines(module, node) & {*map(str.strip, element.get_text().splitlines())} \
            == set()
        assert f'../reference/{module.topic}.html#{name}' in str(element)


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
    shown = BeautifulSoup(sources_text.block(COURSE, module, text), "html.parser").get_text()
    assert letters(shown) == letters(text)


def test_names_become_links_to_the_right_places():
    """`crossing_backward` is in two modules; `tube` is a parameter; lab 17 has kernels' names."""
    def address(name, text, own=()):
        shown = sources_text.inline(COURSE, COURSE.modules[name], f"`{text}`", own)
        link = BeautifulSoup(shown, "html.parser").a
        return link and link["href"]
    assert address("reference.antialiasing", "crossing_backward") \
        == "../reference/antialiasing.html#reference.antialiasing.crossing_backward"
    assert address("reference.shape_rendering", "sphere_trace") \
        == "../reference/implicit_surfaces.html#reference.implicit_surfaces.sphere_trace"
    assert address("reference.reconstruction", "course.given.mesh.vertex_normals") \
        == "../given/mesh.html#course.given.mesh.vertex_normals"
    assert address("reference.regularization", "remeshing") == "../reference/remeshing.html"
    assert address("reference.regularization", "edge_function") \
        == "../reference/rasterization.html#reference.rasterization.edge_function"
    assert address("course.given.mesh", "radius", ("radius", "tube")) is None
    assert address("reference.antialiasing", "no_such_function") is None


def test_a_text_links_the_functions_that_it_names_and_no_others():
    """`np.clip` leads to a function `clip`; a paragraph is full of one link; kernels are meant."""
    def links(text, lab=0):
        shown = texts_links.linked(text, "notebooks", lab, "../")
        return [link["href"] for link in BeautifulSoup(shown, "html.parser").find_all("a")]
    place = "../reference/{0}.html#reference.{0}.{1}"
    assert links("`crossing` and `crossing`") == [place.format("antialiasing", "crossing")]
    assert links("`crossing`", lab=17) == [place.format("pair_kernels", "crossing")]
    assert links("`texture_cubes.render`") == [place.format("texture_cubes", "render")]
    assert links("`np.crossing`, `rasterize`, `unit_of_nothing`, ``crossing``, `mesh`") == []
    assert texts_links.linked("[a](../labs/outlines.py#b), [c](../LICENSE)", "notebooks") \
        == "[a](/labs/08_antialiasing.md#b), `c`"
