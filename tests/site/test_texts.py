"""The texts beside lectures and labs: guide, errata, glossary and bibliography."""
import ast
import html
import json
import re

import pytest
from pages import names, texts_links
from serving import ROOT

from labkit import exercises

BIBLIOGRAPHY = (ROOT / "site" / "texts" / "bibliography.md").read_text("utf-8")
GLOSSARY = (ROOT / "site" / "texts" / "glossary.md").read_text("utf-8")
LECTURES = sorted((ROOT / "notebooks").glob("*.ipynb"))
CITED = re.compile(r"([A-Z]\w+)(?:(?:, [A-Z]\w+)*(?:,? and [A-Z]\w+)?| et al\.) ((?:19|20)\d\d)\b")


def test_a_mapped_text_differs_from_its_source_in_links_alone(tmp_path):
    """A sentence is lost, or a link inside code was taken for a link."""
    def bare(text):
        text = re.sub(r'<figure[^>]*><img src="\S+" alt="([^"]+)"[^>]*></figure>', r"!\1",
                      html.unescape(text))
        return re.sub(r"\[([^\[\]]+)\]\([^()\s]+\)", r"\1", text).replace("`", "").split()

    texts_links.write(tmp_path, tmp_path / "extra")
    for source, page in names.TEXTS.items():
        text = (ROOT / source).read_text("utf-8")
        assert bare((tmp_path / f"{page}.md").read_text("utf-8")) == bare(text), source


# The bibliography


def notebook_text(path):
    """The Markdown of a lecture."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    return "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")


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
