"""Answers that are alike: copies are found, however they are dressed; honest answers are not."""
import ast
import csv
import re

import pytest
from submitted import CORE

from course import exercises
from course.given import places
from course.grading.pages import side_by_side, similarity

LAB = {"rasterization": CORE["rasterization"]}


def pairs(texts, columns=LAB):
    return similarity.compare(texts, columns)[0]


def labs(folder, topics=CORE):
    """{topic: text} of the course's own answers in a folder."""
    paths = {topic: places.ROOT / folder / f"{topic}.py" for topic in topics}
    return {topic: exercises.read(path) for topic, path in paths.items() if path.exists()}


@pytest.fixture
def only_reference(monkeypatch):
    """The other answers that the course keeps stand for students' work."""
    monkeypatch.setattr(similarity, "KEPT", ("reference",))


ANSWER = exercises.read(places.ROOT / "tests" / "other_solutions" / "rasterization.py")


# --- honest work ------------------------------------------------------------------------------


@pytest.mark.parametrize("folder", ["reference", "tests/mistakes"])
def test_two_sets_of_answers_to_all_labs_are_no_pair(folder, monkeypatch):
    """What the questions force is taken for copied, even where no other answer is known."""
    monkeypatch.setattr(similarity, "KEPT", ())
    texts = {"ada": labs(folder), "bob": labs("tests/other_solutions")}
    assert pairs(texts, CORE) == []


def test_short_answers_are_never_enough(only_reference):
    """A class is reported whose answers of one line are the only ones."""
    short = {name: body for name, body in functions(ANSWER).items()
             if sum(1 for _ in ast.walk(body)) < 60}
    text = "\n\n".join(map(ast.unparse, short.values()))
    assert len(short) >= 2 and pairs(
        {name: {"rasterization": text} for name in ("ada", "bob")}) == []


def test_what_the_course_itself_says_is_no_sign(only_reference):
    """The reference was released, or the lecture prints it: all who use it are reported."""
    same = labs("reference", LAB)
    assert pairs({"ada": same, "bob": same}) == []


def test_what_many_of_the_class_have_is_no_sign(only_reference):
    """An answer shown in the hour makes a pair of every two who were there."""
    everybody = {f"s{number}": {"rasterization": ANSWER} for number in range(similarity.few(0) + 1)}
    assert pairs(everybody) == []
    everybody.popitem()
    assert len(pairs(everybody)) == 45


# --- copies -----------------------------------------------------------------------------------


def functions(text):
    return {node.name: node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)}


def commented(text):
    return re.sub(r"\n( +)(?=\w)", r"\n\n\1# mine, and nobody else's\n\1", text)


def renamed(text):
    """Every variable has another name."""
    tree = ast.parse(text)
    there = functions(text)
    names = set().union(*map(similarity.bound, there.values())) - there.keys()
    for node in ast.walk(tree):
        field = similarity.NAME.get(type(node))
        if field and getattr(node, field) in names:
            setattr(node, field, f"my_{getattr(node, field)[::-1]}")
    return ast.unparse(tree)


def reordered(text):
    """Lines that do not need each other change places."""
    a = "    x, y, w = screen_points(clip, width, height)\n"
    b = "    p = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), -1)\n"
    assert a + b in text
    return text.replace(a + b, b + a)


def extracted(text):
    """Most of an answer is in a function of its own, at the end of the file."""
    head = "    covered = np.zeros(np.shape(p)[:-1], bool)\n"
    before, after = text.split(head)
    body, rest = after.split("\n\n\n", 1)
    return (f"{before}{head}    return owned_samples(covered, p, triangle)\n\n\n{rest}\n\n"
            f"def owned_samples(covered, p, triangle):\n{body}\n")


def one_only(text):
    """One exercise is copied, the others are the reference's."""
    others = functions(exercises.read(exercises.reference("rasterization")))
    kept = {**others, "rasterize_loop": functions(text)["rasterize_loop"]}
    return "\n\n".join(map(ast.unparse, kept.values()))


@pytest.mark.parametrize("dress", [str, commented, renamed, reordered, extracted, one_only,
                                   lambda text: commented(renamed(extracted(reordered(text))))])
def test_a_copy_is_found_whatever_it_wears(dress, only_reference):
    """One comment more, and nobody notices."""
    texts = {"ada": {"rasterization": ANSWER}, "bob": {"rasterization": dress(ANSWER)},
             "eve": labs("reference", LAB)}
    pair, *others = pairs(texts)
    assert (pair.first, pair.second) == ("ada", "bob") and "2.13" in {
        one.number for one in pair.exercises}
    assert all(other.nodes < pair.nodes / 2 for other in others)


def test_a_copy_of_the_reference_is_near_it_and_honest_work_is_not(only_reference):
    """Who hands in the reference under other names is in no pair; or who writes his own is near."""
    copied = {topic: renamed(text) for topic, text in labs("reference").items()}
    near = similarity.compare({"eve": copied}, CORE)[1]
    assert {*map(exercises.lab_number, CORE)} == {
        exercises.lab_number(topic) for _, topic in near} and {*near.values()} == {1.0}
    honest = {folder: labs(folder) for folder in ("tests/other_solutions", "tests/mistakes")}
    assert similarity.compare(honest, CORE)[1] == {}


@pytest.mark.parametrize("text", ["def (", "\0", "x = " + "-" * 100_000 + "1", "",
                                  "def is_covered():\n    return " + "+".join("1" * 50_000),
                                  "def is_covered():\n    return a" + "<a" * 50_000,
                                  "def is_covered():\n    is_covered()\nis_covered = 1"])
def test_no_text_breaks_the_comparison(text, only_reference):
    """One student's file costs the class its tables, or takes hours."""
    texts = {"ada": {"rasterization": text}, "bob": {"rasterization": text},
             "eve": {"rasterization": ANSWER}, "ann": {"rasterization": ANSWER}}
    assert [pair[:2] for pair in pairs(texts)] == [("ann", "eve")]


# --- what is written --------------------------------------------------------------------------


def test_the_page_marks_what_is_shared_and_escapes_the_rest(tmp_path, only_reference):
    """A student's text is HTML in the instructor's browser; marks are beside what they mean."""
    head = "def is_covered(p, triangle):\n    "
    mine = ANSWER.replace(head, f"{head}é = '</pre><script>'  # é <b>\n    ")
    texts = {"ada": {"rasterization": ANSWER}, "bob": {"rasterization": mine}}
    pair, = pairs(texts)
    side_by_side.write(tmp_path, [pair], texts)
    page = (tmp_path / "similar.html").read_text("utf-8")
    assert "<script" not in page and "<b>" not in page and "default-src 'none'" in page
    assert "    é = &#x27;&lt;/pre&gt;&lt;script&gt;&#x27;  # é &lt;b&gt;\n" in page
    assert page.count("<mark>for first, second in EDGES:</mark>") == 2
    assert "plagiar" not in page.lower() and "It takes no points" in page
    with open(tmp_path / "similar.csv", encoding="utf-8-sig") as file:
        row, = csv.DictReader(file)
    assert (row["student"], row["other student"]) == ("ada", "bob")
    assert int(row["nodes beyond what is forced"]) == pair.nodes
    assert re.search(r"2\.13 rasterize_loop: \d+ of 158", row["exercises"])
