"""The benchmarks' page, and the texts beside it: guide, errata, glossary and bibliography."""
import ast
import html
import json
import re

import pytest
from pages import benchmarks, names, texts_links
from serving import ROOT

from course import exercises

RESULTS = {path.stem: json.loads(path.read_text("utf-8"))
           for path in sorted((ROOT / "benchmarks" / "results").glob("*.json"))}
BIBLIOGRAPHY = (ROOT / "site" / "texts" / "bibliography.md").read_text("utf-8")
GLOSSARY = (ROOT / "site" / "texts" / "glossary.md").read_text("utf-8")
LECTURES = sorted((ROOT / "notebooks").glob("*.ipynb"))
PAGES = ("benchmarks", "own_pictures", "real_projects", "instructors", "errata", "glossary",
         "bibliography")
CITED = re.compile(r"([A-Z]\w+)(?:(?:, [A-Z]\w+)*(?:,? and [A-Z]\w+)?| et al\.) ((?:19|20)\d\d)\b")


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The folder of all these pages, made of what the repository holds."""
    folder = tmp_path_factory.mktemp("pages")
    benchmarks.write(folder, folder / "extra")
    texts_links.write(folder, folder / "extra", lite=False)
    return folder


def tables(text):
    """The tables below a text's headings, in their order: {(line, column): cell} of each."""
    found = []
    for part in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        (_, *columns), _, *lines = [line.strip("| ").split(" | ") for line in part.splitlines()]
        found.append({(line[0], column): cell for line in lines
                      for column, cell in zip(columns, line[1:], strict=True)})
    return found


# The benchmarks


def test_each_cell_of_a_table_is_the_number_of_its_result():
    """A number is typed, or stands in its neighbour's line or column."""
    both = [row for row in RESULTS["peers"]["milliseconds"] if row["work"] == "both ways"]
    wanted = (("faces", 9, RESULTS["pipeline"]["medians in ms"]["faces"]),
              ("faces", 4, [row for row in both if row["pixels"] == 512**2]),
              ("pixels", 4, [row for row in both if row["faces"] == 10_580]))
    for shown, (key, count, rows) in zip(tables(benchmarks.numbers(RESULTS)), wanted, strict=True):
        by_column = {f"{row[key]:,}": row for row in rows}
        assert len(shown) == count * len(rows) > 10
        assert {place: float(cell) for place, cell in shown.items()} == {
            (name, column): pytest.approx(by_column[column][name], rel=6e-3)
            for name, column in shown}


# Links


def anchors(text):
    """The anchors of a text's headings, as GitHub and MyST make them, and its targets."""
    headings = re.findall(r"^#{1,3} (.*)$", text, re.MULTILINE)
    slugs = {re.sub(r"[^\w\- ]", "", title.strip().lower().replace(" ", "-")) for title in headings}
    return slugs | set(re.findall(r"^\(([\w-]+)\)=$", text, re.MULTILINE))


def notebook_text(path):
    """The Markdown of a lecture."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    return "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")


def dead_link(target, text, folder):
    """Why a link of a page leads nowhere, or None."""
    page, _, anchor = target.partition("#")
    if target.startswith("https://"):
        return None
    if not page:
        return None if anchor in anchors(text) else "no such heading on its page"
    if page.startswith("/lectures/"):
        lecture = ROOT / "notebooks" / page.rpartition("/")[2]
        if not lecture.exists():
            return "no such lecture"
        found = not anchor or anchor in anchors(notebook_text(lecture))
        return None if found else "no such section"
    known = {f"/{names.page_of_file(path.relative_to(ROOT).as_posix())}.md"
             for path in [*ROOT.glob("reference/*.py"), *ROOT.glob("course/given/*.py")]}
    known |= {f"/{name}.md" for name in (*PAGES, "index", "labs/index")}
    if page in known:
        return None if not anchor else "an anchor that nobody checks"
    if match := re.fullmatch(r"reference/(\w+)\.html", page):
        functions = exercises.top_level_functions(
            (ROOT / "reference" / f"{match[1]}.py").read_text("utf-8"))
        right = {f"reference.{match[1]}.{function.name}" for function in functions}
        return None if anchor in right else "no such function"
    return None if (folder / "extra" / page).exists() else "no such page or file"


@pytest.mark.parametrize("page", PAGES)
def test_every_link_leads_somewhere(page, written):
    """A lecture, a section or a function was renamed."""
    text = (written / f"{page}.md").read_text("utf-8")
    prose = re.sub(r"```(?!\{).*?```|(?<!`)`[^`\n]+`", "", text, flags=re.DOTALL)
    targets = re.findall(r"\]\(([^()\s]+)\)", prose) + re.findall(r'(?:href|src)="([^"]+)"', text)
    assert targets
    assert [(target, why) for target in targets if (why := dead_link(target, text, written))] == []


@pytest.mark.parametrize(("source", "page"), names.TEXTS.items())
def test_a_mapped_text_differs_from_its_source_in_links_alone(page, source, written):
    """A sentence is lost, or a link inside code was taken for a link."""
    def bare(text):
        text = re.sub(r'<figure[^>]*><img src="\S+" alt="([^"]+)"[^>]*></figure>', r"!\1",
                      html.unescape(text))
        return re.sub(r"\[([^\[\]]+)\]\([^()\s]+\)", r"\1", text).replace("`", "")

    text = (ROOT / source).read_text("utf-8")
    assert bare((written / f"{page}.md").read_text("utf-8")) == bare(text)


# The bibliography


ENTRIES = [" ".join(entry.split()) for entry in re.findall(
    r"^- (.*?)(?=^- |^$|\Z)", BIBLIOGRAPHY, re.MULTILINE | re.DOTALL)]
PAPERS = [entry for entry in ENTRIES if not entry.startswith("**")]


def surname(entry):
    """S. Laine, J. Hellsten, ... -> Laine"""
    return entry.split(", ")[0].split()[-1]


def year(entry):
    return re.findall(r"\b(?:19|20)\d\d\b", entry.partition("Used in")[0].partition("[")[0])[0]


def test_papers_are_sorted_and_stand_there_once():
    """The same paper under two of its authors."""
    order = [(surname(entry).lower().replace("æ", "ae").replace("ö", "o"), int(year(entry)))
             for entry in PAPERS]
    titles = [re.search(r"\*([^*]+)\*", entry)[1] for entry in PAPERS]
    assert order == sorted(order)
    assert len(set(titles)) == len(titles) > 60


@pytest.mark.parametrize("topic", exercises.topics())
def test_every_paper_that_a_module_names_is_there_and_leads_back(topic):
    """A source of the code that a reader cannot look up."""
    path = exercises.reference(topic)
    words = " ".join(ast.get_docstring(ast.parse(exercises.read(path))).split())
    for name, when in CITED.findall(words):
        found = [entry for entry in PAPERS if (surname(entry), year(entry)) == (name, when)
                 or re.search(rf"\b{name}\b.*\b{when}\b", entry.partition("Used in")[0])]
        assert found, f"{name} {when} is not in the bibliography"
        assert any(f"(/reference/{topic}.md)" in entry for entry in found), (name, when)


@pytest.mark.parametrize("path", LECTURES, ids=lambda path: path.stem)
def test_every_title_that_a_lecture_ends_with_is_there_and_leads_back(path):
    """A paper was added to a lecture, and not here."""
    sources = notebook_text(path).partition("## Sources and further reading")[2]
    for line in re.findall(r"^- (?!Lecture notes|Source|Next|To read|\*\*S\d)(.*)$", sources,
                           re.MULTILINE):
        title = re.search(r"\*([^*]+)\*", line)
        if not title:
            continue
        beginning = title[1].lower()[:28].rstrip(".:, ")
        found = [entry for entry in ENTRIES if beginning in entry.lower()]
        assert found, f"{title[1]} is not in the bibliography"
        assert any(f"(/lectures/{path.name})" in entry for entry in found), title[1]


def test_what_the_bibliography_says_of_lectures_is_true():
    """An entry leads to a lecture that never names it."""
    texts = {path.name: notebook_text(path) for path in LECTURES}
    for entry in PAPERS:
        for lecture in re.findall(r"/lectures/(\w+\.ipynb)", entry):
            assert surname(entry) in texts[lecture], (surname(entry), lecture)


# The glossary


TERMS = re.findall(r"^(\w[^\n]*)\n((?:  [^\n]+\n)+)", GLOSSARY.partition("```{glossary}\n")[2],
                   re.MULTILINE)


def test_each_word_is_explained_once_in_a_sentence_or_a_few_and_leads_to_a_lecture():
    """A word without an explanation, twice, or without a way on."""
    words = [word.lower() for word, _ in TERMS]
    assert len(set(words)) == len(words) > 90 and words == sorted(words)
    for word, text in TERMS:
        said = " ".join(text.split()).partition("[Lecture")[0]
        assert 1 <= len(re.findall(r"[.?](?= |$)", said.strip())) <= 4, word
        assert len(said.split()) <= 60, word
        assert "(/lectures/" in text, word


def test_every_function_that_a_word_ends_with_has_a_place_in_the_code():
    """A name that is not there any more, or that two modules have: it would stay without a link."""
    for word, text in TERMS:
        ending = " ".join(text.split()).partition("[Lecture")[2]
        for name in re.findall(r"`([^`]+)`", ending):
            assert texts_links.linked(f"`{name}`", "site/texts").startswith("<a "), (word, name)


def test_the_words_of_page_00b_are_in_the_glossary():
    """The course's first list of words says more than its glossary."""
    text = notebook_text(ROOT / "notebooks" / "00b_how_to_work.ipynb")
    table = text.partition("## Words")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| ([^|]+) \| [^|]+ \|$", table, re.MULTILINE)
    asked = {word.strip() for row in rows[1:] for word in row.split(",")} - {"---"}
    terms = " ".join(word.lower() for word, _ in TERMS)
    known = {"vertex", "face", "edge", "model", "world"}  # as everywhere
    assert {word for word in asked - known if word.lower() not in terms} == set()
