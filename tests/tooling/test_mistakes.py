"""The mistake library: every mistake is caught by its own exercise, and gives its hint."""
import ast
import json
import shutil

import numpy as np
import pytest

from course import exercises
from course.checks.hints import HINTS, fingerprint, known_mistakes
from course.given import places
from course.upkeep import mistakes, mutants

TOPICS = [topic for topic in exercises.topics() if mistakes.library(topic)]
MISREAD = 0.05  # of the hints another machine's rounding may spoil


@pytest.mark.parametrize("topic", TOPICS)
def test_every_mistake_is_caught_by_its_own_exercise_and_gives_a_hint(topic):
    """A mistake that people make passes; or hints.json is of another reference or other checks:
    python3 -m course mistakes makes it anew."""
    found = mistakes.tried(topic)
    assert [f"{mistake.exercise.number}: when {mistake.sentence}"
            for mistake, caught in found if not caught] == []
    silent = []
    for exercise in exercises.topic_exercises(topic):
        now = mistakes.patterns([pair for pair in found if pair[0].exercise == exercise])
        made = [tuple(pair) for pair in known_mistakes().get(exercise.number, ())]
        silent += [f"{exercise.number}: when {pair[0]}" for pair in now if pair not in made]
    assert len(silent) <= MISREAD * len(found), silent


@pytest.mark.parametrize("topic", TOPICS)
def test_every_exercise_has_one_to_six_mistakes_in_its_place(topic):
    """An exercise is left out or has the same sentence twice; a library grows without end."""
    library, asked = mistakes.library(topic), exercises.topic_exercises(topic)
    for exercise in asked:
        sentences = [mistake.sentence for mistake in library if mistake.exercise == exercise]
        assert 1 <= len(sentences) <= 6, exercise.number
        assert len(set(sentences)) == len(sentences), exercise.number
    assert [mistake.exercise for mistake in library] == sorted(
        [mistake.exercise for mistake in library], key=asked.index)


def excused(topic):
    """{(number, change): the place of the mutant that the topic's list excuses by that name}."""
    reasons, found = mutants.equivalents(topic), {}
    for exercise in exercises.topic_exercises(topic):
        function = mutants.function_of(topic, exercise)
        listed = mutants.listed(exercise, function, reasons)
        keys = [mutants.nameless(mutant.change, function)
                for mutant in (mutants.mutants(function) if listed else ())]
        found |= {(exercise.number, change): keys.index(key) for key, change in listed.items()
                  if key in keys}
    assert found.keys() == reasons.keys()
    return found


def a_variable(function):
    """One of a function's own names that is used, and [(line, column)] of all its places.

    Rather not width: its mutant height is made because of the name.
    """
    nodes = [node for node in ast.walk(function) if isinstance(node, (ast.Name, ast.arg))]
    kept = mutants.foreign_names(function) | {
        node.name for node in ast.walk(function) if isinstance(node, ast.FunctionDef)}
    name = min((node.id for node in nodes if isinstance(node, ast.Name)
                and isinstance(node.ctx, ast.Load) and node.id not in kept),
               key=mutants.TWIN.__contains__)
    return name, [(node.lineno - 1, node.col_offset) for node in nodes
                  if name in (getattr(node, "id", ""), getattr(node, "arg", ""))]


def with_other_names(text, names):
    """The text of a reference, in which a variable of each of its exercises is called otherwise."""
    functions = [node for node in exercises.top_level_functions(text) if node.name in names]
    changes = sorted((place, name) for name, found in map(a_variable, functions) for place in found)
    lines = [line.encode("utf-8") for line in exercises.text_lines(text)]
    for (line, start), name in reversed(changes):
        end = start + len(name)
        assert lines[line][start:end] == name.encode()
        lines[line] = lines[line][:end] + b"_longer_than_before" + lines[line][end:]
    return b"".join(lines).decode("utf-8")


def test_a_variable_of_the_reference_may_get_another_name(tmp_path, monkeypatch):
    """One in each exercise does, and a mistake is lost, or an excuse goes to another mutant."""
    before = {topic: (mistakes.library(topic), excused(topic)) for topic in TOPICS}
    shutil.copytree(places.ROOT / "tests" / "mistakes", tmp_path / "tests" / "mistakes")
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
    assert {topic: (mistakes.library(topic), excused(topic)) for topic in TOPICS} == before


def test_no_sentence_is_of_a_mistake_that_is_no_more():
    """hints.json was not made anew."""
    made = json.loads(HINTS.read_bytes())
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


def test_a_mistake_that_is_no_exercise_or_says_nothing_is_told(house, run_module):
    """A typing error, and a mistake is tried in no place; or one that passes goes unseen."""
    reference = 'def double(x):  # exercise 1.1 (1 point)\n    """2 x."""\n    return 2 * x\n'
    check = ('from course.checks import assert_close, exercise\n\n\n@exercise("1.1")\n'
             'def test_two(impl):\n    assert_close(impl.double(0.0), 0.0)\n')

    def tried(text):
        root = house({"reference/transforms.py": reference, "tests/labs/test_transforms.py": check,
                      "tests/mistakes/transforms.py": text, "course/given/data/README.md": ""})
        return run_module(root, "course", "mistakes")

    assert tried('def dubble(x):\n    """tripled"""\n    return 3 * x\n').stderr == (
        "course: tests/mistakes/transforms.py, line 1: dubble is no exercise of transforms; "
        "give it the name of one\n")
    assert tried("\ndef double(x):\n    return 3 * x\n").stderr == (
        "course: tests/mistakes/transforms.py, line 2: double has no docstring; write there what "
        'goes on after "this is what comes out when"\n')
    alive = tried('def double(x):\n    """it is\n    tripled"""\n    return 3 * x\n\n\n'
                  'def double(y):\n    """it is added"""\n    return 2 + y\n')
    assert alive.returncode == 1
    assert "1.1 is not caught: when it is tripled\n    def double(x):" in alive.stdout
    assert "it is added" not in alive.stdout


DOUBLE = 'def double(x):  # exercise 1.1 (1 point)\n    """2 x."""\n    return 2 * x\n'
DOUBLE_CHECKS = '''\
import numpy as np

from course.checks import assert_close, exercise


@exercise("1.1")
def test_two(impl):
    """Three."""
    assert_close(impl.double(np.full(WIDTH, 2.0)), np.full(WIDTH, 4.0))


@exercise("1.1")
def test_one(impl):
    """Three."""
    assert_close(impl.double(1.0), 2.0)


@exercise("1.1", fine_print=True)
def test_nothing(impl):
    """Something."""
    assert_close(impl.double(0.0), 0.0)
'''


@pytest.mark.parametrize(("answer", "width", "told"), [
    ("x + x + x", 4, "hint this is what comes out when it is tripled"),
    ("3 * x + (np.abs(x) == 0)", 4, "hint this is what comes out when it is tripled"),
    ("3 * x", 2, "hint this may be what comes out when it is tripled"),
    ("np.where(x == 2, 3 * x, 2 * x)", 4, ""),
    ("np.where(x == 2, 3 * x, 7 * x)", 4, ""),
], ids=["another way", "fine print open", "few numbers", "one check alone", "other numbers"])
def test_a_mistake_is_named_where_all_checks_of_the_question_say_so(
        house, run_module, answer, width, told):
    """One check returns what a known mistake returns there, and a student is told of that mistake,
    which he did not make."""
    mistake = 'def double(x):\n    """it is tripled"""\n    return 3 * x\n'
    root = house({"reference/transforms.py": DOUBLE, "tests/mistakes/transforms.py": mistake,
                  "labs/transforms.py": f"import numpy as np\n\n{DOUBLE}".replace("2 * x", answer),
                  "tests/labs/test_transforms.py": DOUBLE_CHECKS.replace("WIDTH", str(width))})
    assert run_module(root, "course", "mistakes").returncode == 0
    said = " ".join(run_module(root, "course", "check", "1.1").stdout.split())
    assert told in said and ("comes out when" in said) == bool(told), said
