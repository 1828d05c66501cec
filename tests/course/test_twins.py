"""No answer in the file: what returns a core exercise's answer refuses, and is listed; no other
function repeats its lines.
"""
import ast
import contextlib
import copy
import doctest
import importlib
import inspect
import io
import types

import numpy as np
import pytest
from submitted import CORE

from labkit import contract, exercises
from labkit.checks import loader
from labkit.table import GIVEN
from labkit.verdicts import run

EACH = [(topic, exercise) for topic, asked in CORE.items() for exercise in asked]
CHANCE = {  # the same number for the example's input, by another rule
    "9.8": {"scanline.twice_area"},
    "12.12": {"neural_renderer.covers"}}


def functions():
    """{"topic.name": function} of all that a lab may call: of the labs, and given."""
    modules = {topic: f"reference.{topic}" for topic in exercises.topics()}
    modules |= {name.rpartition(".")[2]: name for name in GIVEN}
    return {f"{topic}.{name}": found for topic, module in modules.items()
            for name, found in vars(importlib.import_module(module)).items()
            if isinstance(found, types.FunctionType) and found.__module__ == module}


def example_calls(topic, name):
    """[(args, what is returned)] of the calls in the example of a question."""
    module, calls = importlib.import_module(f"reference.{topic}"), []
    function = getattr(module, name)

    def recorded(*args, **named):
        args = inspect.signature(function).bind(*args, **named).args
        calls.append((copy.deepcopy(args), contract.called(function, *args)))
        return calls[-1][1]

    for test in doctest.DocTestFinder(recurse=False).find(
            function, name, module=module, globs={**vars(module), name: recorded}):
        with contextlib.redirect_stdout(io.StringIO()):
            doctest.DocTestRunner().run(test)
    return calls


def takes(function, args):
    try:
        inspect.signature(function).bind(*args)
    except TypeError:
        return False
    return True


def answers(function, args, expected):
    """Does a function return this, alone or before more outputs?"""
    def parts(value):
        return list(value) if isinstance(value, tuple) else [value]

    with contextlib.suppress(Exception), contextlib.redirect_stdout(io.StringIO()):
        got = parts(contract.called(loader.limited(function), *copy.deepcopy(args)))
        pairs = list(zip(parts(expected), got, strict=False))
        return len(pairs) == len(parts(expected)) and all(
            np.shape(one) == np.shape(other) and np.allclose(one, other, equal_nan=True)
            for one, other in pairs)
    return False


def twins_found(topic, exercise, there):
    """The functions that answer the example of an exercise's question."""
    calls = example_calls(topic, exercise.name)
    assert calls, f"{exercise.number} has no example that calls it"
    return {name for name, function in there.items() if name != f"{topic}.{exercise.name}"
            and all(takes(function, args) and answers(function, args, expected)
                    for args, expected in calls)}


def test_who_returns_a_core_answer_is_listed(monkeypatch):
    """A fast twin in the same file answers the exercise in one line, for all of its points."""
    monkeypatch.setattr(loader, "CALL_SECONDS", 1.0)
    there = functions()
    unlisted = {exercise.number: found for topic, exercise in EACH
                if (found := twins_found(topic, exercise, there) - set(exercise.twins)
                    - CHANCE.get(exercise.number, set()))}
    assert unlisted == {}


def test_listed_twins_are_there():
    """A twin is renamed, and its old name refuses in vain. Or a list stands above no exercise."""
    there = functions()
    texts = [exercises.read(exercises.reference(topic)) for topic in exercises.topics()]
    assert sum(text.count("# Refuse meanwhile") for text in texts) == sum(
        bool(exercise.twins) for _, exercise in EACH)
    assert {twin for _, exercise in EACH for twin in exercise.twins} <= set(there)


@pytest.mark.parametrize("number, call", [
    ("2.13", "from . import scanline\n    return scanline.rasterize(clip, faces, width, height)"),
    ("2.13", "from .pipeline import visible\n"
             "    seen = visible(clip, faces, width, height)\n"
             "    return seen.face_index, seen.depth"),
    ("4.8", "return shading_requests(face_index)"),
    ("17.2", "from course.given.arrays import scatter_first\n"
             "    return scatter_first(face, pixel, count)"),
    ("4.8", "return fast(face_index)")])
def test_a_twin_refuses_to_answer(tmp_path, number, call):
    """The list of twins is not asked, or what calls a twin, or imports it late, goes on."""
    [(topic, exercise)] = [pair for pair in EACH if pair[1].number == number]
    for path in (exercises.places.ROOT / "reference").glob("*.py"):
        text = exercises.read(path)
        if path.stem == topic:
            [function] = [one for one in exercises.top_level_functions(text)
                          if one.name == exercise.name]
            lines = text.splitlines(keepends=True)
            lines[function.body[1].lineno - 1:function.end_lineno] = [f"    {call}\n"]
            text = "".join(lines)
            text += "\nfast = [*map(lambda f: f, [shading_requests])][0]\n" * ("fast(" in call)
        (tmp_path / path.name).write_text(text, encoding="utf-8")
    [entry] = run(number, str(tmp_path), 0, False).asked
    assert entry.verdict == "failing"
    assert {f"refuses while {number} is" in " ".join(check.message.split())
            for check in entry.checks} == {True}


# --- lines ---------------------------------------------------------------------------------------


def size(node):
    return sum(not isinstance(part, ast.expr_context) for part in ast.walk(node))


def body(function):
    return ast.Module(function.body[1:] if ast.get_docstring(function) else function.body, [])


def values(function):
    """What stands on the right of an answer's statements, where it is more than a few names."""
    statements = (node for node in ast.walk(body(function))
                  if isinstance(node, ast.Assign | ast.AugAssign | ast.Return))
    return [node.value for node in statements if node.value is not None]


def shared_part(function, other):
    """The part of a function's right sides that another one has as well, word for word."""
    known = {ast.dump(node) for node in ast.walk(body(other)) if isinstance(node, ast.expr)}
    there = [size(value) for value in values(function) if size(value) >= 6
             and ast.dump(value) in known]
    return sum(there) / sum(map(size, values(function)))


def repeated(topic, most=1 / 3):
    """Yield a sentence for each function that has more of a core answer's lines than this."""
    functions = {one.name: one for one in
                 exercises.top_level_functions(exercises.read(exercises.reference(topic)))}
    asked = {exercise.name for exercise in CORE[topic]}
    for name in asked:
        for other in functions.keys() - asked:
            if shared_part(functions[name], functions[other]) > most:
                yield f"{other} has the lines of {name}"


@pytest.mark.parametrize("topic", exercises.asking_topics())
def test_no_other_function_has_an_answer__s_lines(topic):
    """An extra begins with the core answer's lines: it is to call that function, or a given one."""
    assert list(repeated(topic)) == []


def test_lines_that_are_repeated_are_found():
    """The test above passes, whatever stands there."""
    one, other = exercises.top_level_functions(
        "def f(a, b):\n    c = a[0] * b + a[1]\n    return np.sqrt(c)\n"
        "def g(a, b, grad):\n    c = a[1] * b + a[0]\n    return grad / c + (a[0] * b + a[1])\n")
    assert shared_part(one, other) > 1 / 2
    assert shared_part(other, one) == 0
