"""The mistake library: every mistake is caught by its own exercise, and gives its hint."""
import ast
import functools
import json
import re
import shutil

import numpy as np
import pytest
from made_up import check_text, exercise_text
from submitted import put

from course import exercises
from course.checks import hints
from course.checks.hints import fingerprint
from course.given import places
from course.upkeep import changes, mistakes, mutants
from course.upkeep.mutations import TWIN, foreign_names, nameless
from course.upkeep.mutations import mutants as made_of
from course.upkeep.trials import Trial, caught_by

TOPICS = exercises.asking_topics()
MISREAD = 0.05  # of the hints another machine's rounding may spoil
RENAMED = "_longer_than_before"


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
def test_an_exercise_has_at_most_eight_mistakes(topic):
    """An exercise has the same sentence twice, or a library grows without end."""
    library = mistakes.library(topic)
    for exercise in exercises.topic_exercises(topic):
        sentences = [mistake.sentence for mistake in library if mistake.exercise == exercise]
        assert len(sentences) <= 8, exercise.number
        assert len(set(sentences)) == len(sentences), exercise.number


def test_no_mistake_stands_twice():
    """hints.json names the same one by two sentences, and tells neither."""
    for topic in TOPICS:
        texts = [ast.unparse(ast.parse(mistake.text)) for mistake in mistakes.library(topic)]
        assert len(set(texts)) == len(texts), topic


def excused(topic):
    """{(number, change): the place of the mutant that the topic's list excuses by that name}."""
    reasons, found = mutants.equivalents(topic), {}
    for exercise in exercises.topic_exercises(topic):
        function = changes.function_of(topic, exercise)
        listed = mutants.listed(exercise, function, reasons)
        keys = [nameless(mutant.change, function)
                for mutant in (made_of(function) if listed else ())]
        found |= {(exercise.number, change): keys.index(key) for key, change in listed.items()
                  if key in keys}
    assert found.keys() == reasons.keys()
    return found


def a_variable(function):
    """One of a function's own names that is used, and [(line, column)] of all its places.

    Rather not width: its mutant height is made because of the name.
    """
    nodes = [node for node in ast.walk(function) if isinstance(node, (ast.Name, ast.arg))]
    kept = foreign_names(function) | {
        node.name for node in ast.walk(function) if isinstance(node, ast.FunctionDef)}
    name = min((node.id for node in nodes if isinstance(node, ast.Name)
                and isinstance(node.ctx, ast.Load) and node.id not in kept),
               key=TWIN.__contains__)
    return name, [(node.lineno - 1, node.col_offset) for node in nodes
                  if name in (getattr(node, "id", ""), getattr(node, "arg", ""))]


def with_other_names(text, names):
    """The text of a reference, in which a variable of each of its exercises is called otherwise."""
    functions = [node for node in exercises.top_level_functions(text) if node.name in names]
    found = sorted((place, name) for name, places in map(a_variable, functions) for place in places)
    lines = [line.encode("utf-8") for line in exercises.text_lines(text)]
    for (line, start), name in reversed(found):
        end = start + len(name)
        assert lines[line][start:end] == name.encode()
        lines[line] = lines[line][:end] + RENAMED.encode() + lines[line][end:]
    return b"".join(lines).decode("utf-8")


def with_old_names(topic):
    """The library of a topic in which variables are called otherwise, as it is without that."""
    return [(mistake.exercise.number, mistake.sentence, mistake.text.replace(RENAMED, ""))
            for mistake in mistakes.library(topic)]


def test_a_variable_of_the_reference_may_get_another_name(tmp_path, monkeypatch):
    """One in each exercise does, and a mistake is lost, or an excuse goes to another mutant."""
    before = {topic: (with_old_names(topic), excused(topic)) for topic in TOPICS}
    for folder in "mistakes", "equivalents":
        shutil.copytree(places.ROOT / "tests" / folder, tmp_path / "tests" / folder)
    (tmp_path / "reference").mkdir()
    for topic in TOPICS:
        old = exercises.read(exercises.reference(topic))
        names = {exercise.name for exercise in exercises.topic_exercises(topic)}
        new = with_other_names(old, names)
        changed = {one.name for one, other in zip(*map(exercises.top_level_functions, (old, new)),
                                                  strict=True) if ast.dump(one) != ast.dump(other)}
        assert changed == names
        (tmp_path / "reference" / f"{topic}.py").write_text(new, encoding="utf-8")
    monkeypatch.setattr(places, "ROOT", tmp_path)
    assert {topic: (with_old_names(topic), excused(topic)) for topic in TOPICS} == before


def test_no_sentence_is_of_a_mistake_that_is_no_more():
    """hints.json was not made anew."""
    made = json.loads(hints.HINTS.read_bytes())
    there = {mistake.sentence for topic in TOPICS for mistake in mistakes.library(topic)}
    assert {sentence for known in made.values() for joined, _ in known
            for sentence in joined.split(", or when ")} - there == set()


def test_a_student_reads_the_sentence(run_module, pytestconfig, tmp_path):
    """The hint needs the library, or is that of another check."""
    reference = exercises.read(exercises.reference("transforms"))
    own = ("    moved = [p @ matrix for p in points.reshape(-1, 4)]\n"
           "    return np.array(moved).reshape(points.shape)")  # the mistake, in other words
    (tmp_path / "transforms.py").write_text(
        reference.replace("    return points @ matrix.T", own, 1), encoding="utf-8")
    done = run_module(pytestconfig.rootpath, "course", "check", "1.2", "--impl", tmp_path)
    assert ("hint this is what comes out when the transposed matrix is applied: points are "
            "rows here, but the matrix acts on columns") in " ".join(done.stdout.split())
    done = run_module(pytestconfig.rootpath, "course", "check", "1.2", "--impl", tmp_path,
                      "--seed", "3")
    assert done.returncode == 1


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
HEAD = "import numpy as np\n\nfrom course.checks import assert_close, exercise\n"
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
    ("np.where(x == 2, 3 * x, 2 * x)", 4, ""),
    ("np.where(x == 2, 3 * x, 7 * x)", 4, ""),
], ids=["another way", "fine print open", "few numbers", "one check alone", "other numbers"])
def test_a_mistake_is_named_where_all_checks_of_the_question_say_so(
        with_hints, run_module, tmp_path, answer, width, told):
    """One check returns what a known mistake returns there, and a student is told of that mistake,
    which he did not make."""
    (tmp_path / "transforms.py").write_text(
        f"import numpy as np\n\n{DOUBLE}".replace("2 * x", answer), encoding="utf-8")
    said = " ".join(run_module(with_hints(width), "course", "check", "1.1",
                               "--impl", tmp_path).stdout.split())
    assert told in said and ("comes out when" in said) == bool(told), said


def test_a_mistake_that_lives_is_shown(house, run_module):
    """It is counted, and nobody sees which it is."""
    root = house({"reference/transforms.py": DOUBLE,
                  "tests/labs/test_transforms.py": HEAD + check_text("1.1", *NOTHING),
                  "tests/mistakes/transforms.txt": TRIPLED, "tests/mistakes/transforms.py":
                  'def double(y):\n    """it is added"""\n    return 2 + y\n'})
    done = run_module(root, "course", "mistakes")
    assert done.returncode == 1
    assert "1.1 is not caught: when it is tripled\n    def double(x):" in done.stdout
    assert "it is added" not in done.stdout


@pytest.mark.parametrize(("name", "text", "told"), [
    ("transforms.py", 'def dubble(x):\n    """tripled"""\n    return 3 * x\n',
     "transforms.py, line 1: dubble is no exercise of transforms; give it the name of one"),
    ("transforms.py", "\ndef double(x):\n    return 3 * x\n",
     "transforms.py, line 2: double has no sentence; write below what goes on"),
    ("transforms.txt", "1.1  2 * x -> 3 * x\n",
     "transforms.txt, line 1: double has no sentence; write below what goes on"),
    ("transforms.txt", "Mistakes.\n\n1.7  2 * x -> 3 * x\n      tripled\n",
     "transforms.txt, line 3: 1.7 is no exercise of transforms; give it the number of one"),
    ("transforms.txt", "1.1  3 * x -> x\n      once\n",
     'transforms.txt, line 1: "3 * x" stands nowhere in double; write what is there'),
    ("transforms.txt", "1.1  x -> y\n      once\n",
     "transforms.txt, line 1: double has no variable y; write its name"),
    ("transforms.txt", "1.1  2 x -> 3 x\n      once\n",
     'transforms.txt, line 1: "2 x -> 3 x" is no change; write "old -> new"'),
    ("transforms.txt", "1.1  2 * x -> x\nor   x -> 2\n      once\n",
     'transforms.txt, line 1: "or x -> 2" below it is no line of a list; begin it with "and"')])
def test_a_mistake_that_has_no_place_or_says_nothing_is_told(
        monkeypatch, tmp_path, name, text, told):
    """A typing error, and a mistake is tried in no place."""
    put(tmp_path, {"reference/transforms.py": DOUBLE, f"tests/mistakes/{name}": text})
    monkeypatch.setattr(places, "ROOT", tmp_path)
    with pytest.raises(ValueError, match=re.escape(f"tests/mistakes/{told}")):
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
