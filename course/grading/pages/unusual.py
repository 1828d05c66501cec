"""What is unusual in a submission, from its syntax trees, for a person to judge: no verdict.

Honest work seldom has any of it, and each sign may have a good reason. What the reference does as
well is no sign. A lab that is no Python has none.
"""
import ast
import collections
import contextlib
import functools
import re
from typing import NamedTuple

from ... import exercises
from ..handing.texts import parts
from . import numeric

MOST_NODES = 20_000    # of a lab that is looked at: five times the longest reference
MOST_LITERALS = 1000   # letters and digits of literals beyond the reference's
DEEPEST = 100          # nodes in nodes: `similarity` may not come to what is below
OWN_LINES = 10         # beyond the reference's, in files that are named because they are equal
BROKEN = SyntaxError, ValueError, RecursionError, MemoryError
HARMLESS = {
    "__future__", "abc", "bisect", "cmath", "collections", "contextlib", "copy", "dataclasses",
    "decimal", "doctest", "enum", "fractions", "functools", "heapq", "itertools", "labs", "logging",
    "math", "matplotlib", "numbers", "numpy", "operator", "random", "re", "scipy", "statistics",
    "string", "textwrap", "time", "typing", "warnings"}
HIDDEN = {"builtins", "codecs", "ctypes", "ctypeslib", "gc", "importlib", "inspect", "linecache",
          "marshal", "os", "pickle", "subprocess", "sys", "zlib"}  # also as np.lib.npyio.os
BUILT_IN = {"compile", "delattr", "eval", "exec", "getattr", "globals", "locals", "open", "setattr",
            "vars"}
INNER = re.compile(r"(?!__(all|class|doc|init|main|name|new|version)__)__\w+__"
                   r"|(ag|co|cr|f|gi|tb)_(back|builtins|code|consts|frame|globals|locals|next)")


class Sign(NamedTuple):
    """Something unusual in one lab of one student's."""

    weight: int
    topic: str
    line: int
    reason: str


class Usual(NamedTuple):
    """What a topic's reference has itself."""

    words: dict
    decorators: set
    literals: int


def by_student(texts, columns, near) -> list[tuple[str, list[Sign]]]:
    """{topic: its exercises} -> [(student, signs)], the heaviest first.

    texts: as `texts.kept` has them; of a group, give one member. near: of `similarity.compare`.
    """
    found = equal_files(texts)
    for student, labs in texts.items():
        for topic in labs.keys() & columns.keys():
            found[student] += signs(parts(labs, topic), topic, columns[topic])
    for (student, topic), share in near.items():
        found[student].append(Sign(10, topic, 1, f"{share:.0%} of the answers are the reference's, "
                                                 "whatever variables are called"))
    ordered = {student: sorted(each, key=lambda one: (-one.weight, one.topic, one.line))
               for student, each in sorted(found.items()) if each}
    return sorted(ordered.items(), key=lambda pair: -sum(sign.weight for sign in pair[1]))


def equal_files(texts):
    """{student: signs} of labs that several have, letter by letter, with enough of their own."""
    holders, found = collections.defaultdict(list), collections.defaultdict(list)
    for student, labs in sorted(texts.items()):
        for topic, text in labs.items():
            holders[topic, exercises.digest(text)].append(student)
    for (topic, _), students in holders.items():
        if len(students) > 1 and own_lines(texts[students[0]][topic], topic) >= OWN_LINES:
            for student in students:
                others = ", ".join(other for other in students if other != student)
                found[student].append(Sign(10, topic, 1, f"the same file as that of {others}"))
    return found


def own_lines(text, topic):
    """How many lines of code stand in a lab, and neither in the reference nor in the hand-out."""
    given = exercises.read(exercises.reference(topic)) if topic in exercises.TOPICS else ""
    own, given = map(code_lines, (text, given))
    return sum(not line.startswith("raise NotImplementedError") for line in own - given)


def code_lines(text):
    """The lines of a lab, without comments and the author's way to break them."""
    with contextlib.suppress(*BROKEN):
        text = ast.unparse(ast.parse(text))
    return {line.strip() for line in text.splitlines()}


# --- in one lab -------------------------------------------------------------------------------


def signs(each, topic, asked):
    """Yield the signs in one lab alone. each: of `texts.parts`."""
    for reason, things in found(parsed("\n".join(each.values())), topic, asked).items():
        placed = [(thing, *place(each, line)) for line, thing in things]
        shown = (f"{thing} ({'' if name == topic else f'{name}.py, '}line {line})"
                 for thing, name, line in placed)
        if placed:
            yield Sign(min(10, 3 * len(placed)), *placed[0][1:], reason.format(", ".join(shown)))


def place(each, line):
    """(module, line in it) of a line in the texts below each other."""
    for name, text in each.items():
        count = text.count("\n") + 1
        if line <= count:
            return name, line
        line -= count


def parsed(text):
    """The tree of a lab, an empty one where it is no Python."""
    try:
        return ast.parse(text)
    except BROKEN:
        return ast.Module([], [])


def found(tree, topic, asked):
    """{reason: [(line, what)]}"""
    nodes = [*ast.walk(tree)]
    if len(nodes) > MOST_NODES:
        return {"too long to be looked at: {}": [(1, f"{len(nodes):,} nodes")]}
    strange = [(line, word) for word, line in words(nodes).items()
               if word not in usual(topic).words]
    return {
        "uses {}": strange,
        "not one plain function each: {}": [*not_plain(tree, nodes, asked, topic, bool(strange))],
        "perhaps a numeric derivative: {}": [
            (line, title(one)) for line, one in numeric.backward_passes(tree, topic, asked)],
        "{}": [*too_large(tree, nodes, topic)]}


@functools.cache
def usual(topic):
    nodes = [*ast.walk(ast.parse(exercises.read(exercises.reference(topic))))]
    return Usual(words(nodes), decorators(nodes), literals(nodes).total())


def title(exercise):
    return f"{exercise.number} {exercise.name}"


def too_large(tree, nodes, topic):
    """Yield (line, sentence) on what is long or deep."""
    sizes, level = literals(nodes), [tree]
    if sizes.total() > usual(topic).literals + MOST_LITERALS:
        yield max(sizes, key=sizes.get), f"{sizes.total():,} letters and digits of literals"
    for _ in range(DEEPEST):
        level = [child for node in level for child in ast.iter_child_nodes(node)]
    if lines := [node.lineno for node in level if hasattr(node, "lineno")]:
        yield min(lines), f"more than {DEEPEST} nodes in each other"


def literals(nodes):
    """{line: letters and digits of its literals}, without docstrings."""
    alone = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    sizes = collections.Counter()
    for node in nodes:
        if isinstance(node, ast.Constant) and id(node) not in alone:
            value = node.value
            sizes[node.lineno] += (len(value) if isinstance(value, str | bytes) else
                                   1 + value.bit_length() // 4 if isinstance(value, int) else 8)
    return sizes


# --- exercises that are no plain functions ----------------------------------------------------


def not_plain(tree, nodes, asked, topic, is_strange):
    """Yield (line, title) of the exercises that are not one function each at the left edge."""
    places = collections.defaultdict(list)
    for node in binding(tree, nodes):
        for name in names_bound(node):
            places[name].append(node)
    for exercise in asked:
        here = places[exercise.name]
        odd = [node for node in here if not is_plain(node, tree, topic)] or here[1:]
        if odd:
            yield odd[0].lineno, title(exercise)
        elif not here and (is_strange or "*" in places):
            yield 1, f"{title(exercise)}, missing"


def is_plain(node, tree, topic):
    """Whether it is a function at the left edge, without decorators that the reference lacks."""
    return isinstance(node, ast.FunctionDef) and node in tree.body and (
        decorators([node]) <= usual(topic).decorators)


def decorators(nodes):
    """The names of what decorates functions. None: of what has no name."""
    return {getattr(getattr(one, "func", one), "id", None)
            for node in nodes for one in getattr(node, "decorator_list", ())}


def binding(tree, nodes):
    """Yield the nodes that may bind a module's names."""
    yield from (node for node in nodes if isinstance(node, ast.Global))
    yield from (node.target for node in nodes if isinstance(node, ast.NamedExpr))
    ends = [*tree.body]
    while ends:
        node = ends.pop()
        yield node
        if not isinstance(node, (*numeric.WHOLE, ast.Lambda, ast.NamedExpr)):
            ends += ast.iter_child_nodes(node)


def names_bound(node):
    """The names that a node itself binds."""
    if isinstance(node, ast.alias):
        return [(node.asname or node.name).partition(".")[0]]
    if isinstance(node, ast.Name):
        return [] if isinstance(node.ctx, ast.Load) else [node.id]
    names = [getattr(node, "name", None), getattr(node, "rest", None), *getattr(node, "names", ())]
    return [name for name in names if isinstance(name, str)]


# --- words that labs do without ---------------------------------------------------------------


def words(nodes):
    """{what is seldom used: the first line of it}"""
    modules = {name for node in nodes if isinstance(node, ast.alias) for name in names_bound(node)}
    lines = {}
    for node in nodes:
        for word in words_of(node, modules):
            lines[word] = min(node.lineno, lines.get(word, node.lineno))
    return lines


def words_of(node, modules):
    """Yield what a node is or names that is seldom used. modules: names that are imported."""
    if isinstance(node, ast.Name) and (node.id in BUILT_IN or INNER.fullmatch(node.id)):
        yield node.id
    if isinstance(node, ast.Attribute) and (node.attr in HIDDEN or INNER.fullmatch(node.attr)):
        yield f".{node.attr}"
    if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and (
            getattr(node.value, "id", None) in modules):
        yield f"{node.value.id}.{node.attr} ="
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and (
            INNER.fullmatch(node.value)):
        yield repr(node.value)
    if isinstance(node, ast.FunctionDef) and node.name == "__getattr__":
        yield "def __getattr__"
    if isinstance(node, ast.Import | ast.ImportFrom):
        yield from (f"import {name}" for name in imported(node) if not is_harmless(name))


def imported(node):
    """The names of what an import takes, each with its module's."""
    module = f"{'.' * node.level}{node.module or ''}." if isinstance(node, ast.ImportFrom) else ""
    return [f"{module}{alias.name}" for alias in node.names]


def is_harmless(name):
    first, *others = name.split(".")
    return not HIDDEN.intersection(others) and (
        first in HARMLESS or not first or name.startswith("course.given."))
