"""The mistake library: every mistake is caught by its own exercise, and gives its hint."""
import ast
import functools
import json
import re

import numpy as np
import pytest
from made_up import check_text, exercise_text
from submitted import put

from labkit import exercises, places
from labkit.checks import hints
from labkit.checks.hints import fingerprint
from labkit.upkeep import changes, mistakes
from labkit.upkeep.trials import Trial, caught_by

TOPICS = exercises.asking_topics()
MISREAD = 0.05  # of the hints another machine's rounding may spoil


@pytest.mark.parametrize("topic", TOPICS)
def test_every_mistake_is_caught_by_the_check_that_the_hints_name_first(topic):
    """A likely mistake passes; or hints.json is of another reference or other checks:
    python3 -m course mistakes makes it anew."""
    library = mistakes.library(topic)
    marks = [first_mark(mistake) for mistake in library]
    caught = caught_by(topic, [Trial(mistake.exercise, mistake.text, check)
                               for mistake, (check, _) in zip(library, marks, strict=True)],
                       right_first=False)
    said = [f"{mistake.exercise.number}: when {mistake.sentence}" for mistake in library]
    assert [one for one, checks in zip(said, caught, strict=True) if not checks] == []
    silent = [one for one, mark, [check] in zip(said, marks, caught, strict=True)
              if mark != NO_MARK and (hints.name(check.nodeid), check.mark) != mark]
    assert len(silent) <= MISREAD * len(library), silent


NO_MARK = "", None  # of a mistake that no check was returned numbers by


def first_mark(mistake):
    """(the check that catches a mistake, the fingerprint there): the first that hints.json has."""
    known = hints.known_mistakes().get(mistake.exercise.number, ())
    marks = [pair for sentence, failed in known if mistake.sentence in sentence.split(", or when ")
             for pair in failed.items() if pair[1]]
    return min(marks, default=NO_MARK)


@pytest.mark.parametrize("topic", TOPICS)
def test_an_exercise_has_few_mistakes_and_none_twice(topic):
    """A library grows without end; or hints.json names the same mistake by two sentences, and tells
    neither.
    """
    library = mistakes.library(topic)
    for exercise in exercises.topic_exercises(topic):
        own = [mistake for mistake in library if mistake.exercise == exercise]
        assert len(own) <= max(8, 3 * exercise.points), exercise.number
        assert len({mistake.sentence for mistake in own}) == len(own), exercise.number
        assert len({ast.dump(ast.parse(mistake.text)) for mistake in own}) == len(own)


def test_no_sentence_is_of_a_mistake_that_is_no_more():
    """hints.json was not made anew."""
    made = json.loads(hints.HINTS.read_bytes())
    there = {mistake.sentence for topic in TOPICS for mistake in mistakes.library(topic)}
    assert {sentence for number, known in made.items() for joined, *_ in known if " " not in number
            for sentence in joined.split(", or when ")} - there == set()


@pytest.mark.parametrize(("one", "other"), [
    (1.0, 1), (np.array([0.1 + 0.2, 1e9]), [0.3, 1e9 + 1e-4]), (np.zeros(2), -np.zeros(2)),
    ((1, [2.0, 3.0]), [1, np.array([2, 3])]), (np.array([np.nan, np.inf]), [np.nan, np.inf]),
    (np.array([1.0, 1e-17]), np.array([1.0, 0.0])), (np.float32(1 / 4), 0.25), (1 + 0j, 1.0),
    (np.array([1e300, 1.0]), [1e300, 2.0]), (np.zeros((0, 3)), np.zeros((0, 3), int)),
], ids=repr)
def test_equal_numbers_have_one_fingerprint(one, other):
    """Rounding, -0 or a list in place of an array loses the hint."""
    assert fingerprint("test", one) == fingerprint("test", other)


@pytest.mark.parametrize(("one", "other"), [
    (1.0, 1.001), (np.ones(3), np.ones((1, 3))), (True, 1), ("a", "b"), (np.nan, 0.0),
    ((1.0, 2.0), (2.0, 1.0)), (np.array([1.0, 2.0]), np.array([2.0, 1.0])), (np.inf, -np.inf),
], ids=repr)
def test_other_numbers_have_another(one, other):
    """A hint for something else."""
    assert fingerprint("test", one) != fingerprint("test", other)
    assert fingerprint("test", one) != fingerprint("test 2", one)


DOUBLE = exercise_text("1.1", "double", "2 x.", "return 2 * x").lstrip()
HEAD = "import numpy as np\n\nfrom labkit.checks import assert_close, exercise\n"
NOTHING = "nothing", "Something.", "assert_close(impl.double(0.0), 0.0)"
DOUBLE_CHECKS = HEAD + "".join((
    check_text("1.1", "two", "Three.",
               "assert_close(impl.double(np.full(WIDTH, 2.0)), np.full(WIDTH, 4.0))"),
    check_text("1.1", "one", "Three.", "assert_close(impl.double(1.0), 2.0)"),
    check_text("1.1", *NOTHING, fine_print=True)))
TRIPLED = "1.1  2 * x -> 3 * x\n      it is tripled\n"


@pytest.fixture(scope="module")
def with_hints(house, run_module):
    """with_hints(width) -> the root of a course with one known mistake and its hints."""
    @functools.cache
    def build(width):
        root = house({"reference/transforms.py": DOUBLE, "tests/mistakes/transforms.txt": TRIPLED,
                      "tests/labs/test_transforms.py": DOUBLE_CHECKS.replace("WIDTH", str(width))})
        assert run_module(root, "course", "mistakes").returncode == 0
        return root

    return build


@pytest.mark.parametrize(("answer", "width", "told"), [
    ("x + x + x", 4, "hint this is what comes out when it is tripled"),
    ("3 * x + (np.abs(x) == 0)", 4, "hint this is what comes out when it is tripled"),
    ("3 * x", 2, "hint this may be what comes out when it is tripled"),
    ("np.where(x == 2, 3 * x, 2 * x)", 4, "hint in this claim this may be what comes out when it"),
    ("np.where(x == 2, 3 * x, 7 * x)", 4, "hint in this claim this may be what comes out when it"),
    ("np.where(x == 2, 3 * x, 7 * x)", 3, ""),
], ids=["another way", "fine print open", "few numbers", "one check alone", "other numbers",
        "one check, few numbers"])
def test_a_mistake_is_named_where_all_checks_of_the_question_say_so(
        with_hints, run_here, monkeypatch, tmp_path, answer, width, told):
    """One check returns what a known mistake returns there, and a student is told of that mistake
    without the claim, as if it explained all."""
    root = with_hints(width)
    made = json.loads((root / "tests/labs/hints.json").read_bytes())
    monkeypatch.setattr(hints, "known_mistakes", lambda: made)
    put(tmp_path, {"transforms.py": f"import numpy as np\n\n{DOUBLE}".replace("2 * x", answer)})
    said = " ".join(run_here(root, "course", "check", "1.1", "--impl", tmp_path).stdout.split())
    assert told in said and said.count("comes out when") == bool(told), said


def test_a_mistake_that_lives_is_shown(house, run_module):
    """It is counted, and nobody sees which it is."""
    root = house({"reference/transforms.py": DOUBLE,
                  "tests/labs/test_transforms.py": HEAD + check_text("1.1", *NOTHING),
                  "tests/mistakes/transforms.txt":
                      f"{TRIPLED}\n1.1  2 * x -> 2 + x\n      it is added\n"})
    done = run_module(root, "course", "mistakes")
    assert done.returncode == 1
    assert "1.1 is not caught: when it is tripled\n    def double(x):" in done.stdout
    assert "it is added" not in done.stdout


@pytest.mark.parametrize(("text", "told"), [
    ("1.1  2 * x -> 3 * x\n", "line 1: double has no sentence; write below what goes on"),
    ("Mistakes.\n\n1.7  2 * x -> 3 * x\n      tripled\n",
     "line 3: 1.7 is no exercise of transforms; give it the number of one"),
    ("1.1  3 * x -> x\n      once\n", 'line 1: "3 * x" stands nowhere in double; write'),
    ("1.1  x -> y\n      once\n", "line 1: double has no variable y; write its name"),
    ("1.1  2 x -> 3 x\n      once\n", 'line 1: "2 x -> 3 x" is no change; write "old -> new"'),
    ("1.1  2 * x -> x\nor   x -> 2\n      once\n",
     'line 1: "or x -> 2" below it is no line of a list; begin it with "and"')])
def test_a_mistake_without_a_place_or_words_is_told(monkeypatch, tmp_path, text, told):
    """A typing error, and a mistake is tried in no place."""
    put(tmp_path, {"reference/transforms.py": DOUBLE, "tests/mistakes/transforms.txt": text})
    monkeypatch.setattr(places, "ROOT", tmp_path)
    with pytest.raises(ValueError, match=re.escape(f"tests/mistakes/transforms.txt, {told}")):
        mistakes.library("transforms")


FUNCTION = ast.parse('''\
def f(x, y):
    """The question, with x - y in it."""
    z = x - y
    for k in range(2):
        z += (x - y) * k
    return z
''').body[0]


@pytest.mark.parametrize(("wanted", "text"), [
    ("x - y -> y - x (#1)", "z = y - x; for k in range(2): z += (x - y) * k; return z"),
    ("x - y -> y - x (#2)", "z = x - y; for k in range(2): z += (y - x) * k; return z"),
    ("(x - y)  *  k -> k", "z = x - y; for k in range(2): z += k; return z"),
    ("z = x - y -> z = x; z -= k", "z = x; z -= k; for k in range(2): z += (x - y) * k; return z"),
    ("z += (x - y) * k -> pass", "z = x - y; for k in range(2): pass; return z"),
    ("return z -> return x, z", "z = x - y; for k in range(2): z += (x - y) * k; return (x, z)"),
    ("x - y -> x (#1) and range(2) -> [0]", "z = x; for k in [0]: z += (x - y) * k; return z"),
    ("f(x, y) -> y, x", "return (y, x)"),
    ("f(x, y) -> z = y - x; return z", "z = y - x; return z")])
def test_a_change_is_made_where_it_says(wanted, text):
    """In the docstring, in another place, or in all; or one of two changes is lost."""
    made = changes.changed(FUNCTION, [changes.change(one) for one in wanted.split(" and ")])
    assert made.replace("\n    ", "; ").replace(":;     ", ": ") == f"def f(x, y):; {text}"


def test_a_second_mistake_is_made_in_what_the_first_one_left():
    """Two at once change the right answer, so that the second finds its place where none is."""
    entry = changes.Entry("", "1.1", ("x + 1 -> x",), "")
    assert changes.again("def f(x):\n    return 2 * (x + 1)", entry) == [
        "def f(x):\n    return 2 * x"]
    assert changes.again("def f(x):\n    return 2 * x", entry) == []


@pytest.mark.parametrize(("wanted", "told"), [
    ("x - y -> x", '"x - y" stands in 2 places in f; end the line with (#1) for the first'),
    ("f(y, x) -> x", '"f(y, x)" stands nowhere in f; write what is there'),
    ("x - y -> x (#3)", '"x - y" stands in less than 3 places in f; write what is there'),
    ("(x - y) * k -> k and x - y -> y (#2)", "lies in what another change takes away"),
])
def test_a_change_has_one_place(wanted, told):
    """The wrong one of two places is changed, and another mistake is made than the one told."""
    with pytest.raises(ValueError, match=re.escape(told)):
        changes.changed(FUNCTION, [changes.change(one) for one in wanted.split(" and ")])
