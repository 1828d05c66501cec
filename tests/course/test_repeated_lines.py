"""No answer in the file: no other function repeats the lines of a core exercise's answer."""
import ast

import pytest
from submitted import CORE

from labkit import exercises


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
