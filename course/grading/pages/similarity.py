"""Answers that are alike beyond what their questions force, as pairs for a person to judge.

An answer is the syntax tree of an exercise's function, and of the student's own functions that it
calls. Comments, docstrings and annotations are not in it, and its variables have no names. Two
answers share the parts (expressions and statements) that both have, wherever they stand. The
nodes in shared parts are counted, but for parts that

    are small: fewer than SMALLEST nodes
    are known: in an answer that the course itself keeps, right or wrong
    are common: many of the class have them, see `few`

Two honest answers share some nodes still, because few ways lead to the result. So an exercise
counts only by what it shares beyond FORCED nodes: an answer of one line never does.

How near a lab is to the reference is told apart: that all have it is why it makes no pair.
"""
import ast
import collections
import functools
import itertools
import operator
from typing import NamedTuple

from ... import exercises
from ...given import places
from ..handing.texts import whole

SMALLEST = 8    # nodes of a part
LARGEST = 300   # nodes of a part: what is larger is found by its parts
MOST = 3000     # nodes of an answer that are looked at
FORCED = 40     # nodes that honest answers to one exercise may share
LEAST = 40      # nodes beyond these, in all exercises, that make a pair
NEAR = 0.7      # of a lab's nodes stand in parts that the reference's answers have
SHORT = 100     # nodes of a lab in parts; of fewer, honest answers may be as near
KEPT = "reference", "tests/other_solutions", "tests/mistakes"
UNCOUNTED = ast.expr_context, ast.operator, ast.unaryop, ast.cmpop, ast.boolop
NAME = {ast.Name: "id", ast.arg: "arg", ast.FunctionDef: "name"}
LEFT_OUT = {"ctx", "annotation", "returns", "type_comment", "decorator_list", "type_params", "kind"}


class Shared(NamedTuple):
    """What two answers to an exercise share."""

    number: str
    topic: str
    name: str
    nodes: int        # that are shared
    of: int           # nodes of the shorter answer
    parts: frozenset  # the shared parts, see `Answer`


class Pair(NamedTuple):
    """Two students whose answers are alike."""

    first: str
    second: str
    nodes: int        # beyond what is forced
    exercises: tuple  # Shared, the most alike first


class Answer(NamedTuple):
    """The functions of an answer, and its nodes from top to bottom."""

    functions: list
    nodes: list       # (node, how many nodes it has in it)
    parts: dict       # {part: a number, the bits of which are the nodes in it}


def compare(texts, columns) -> tuple[list[Pair], dict]:
    """{topic: its exercises} -> the pairs, the most alike first; and {(student, topic): share} of
    what is near to the reference. texts: as `texts.kept` has them; of a group, give one member.
    """
    shared, near = collections.defaultdict(list), {}
    for topic, asked in columns.items():
        written = {student: answers(whole(labs, topic), topic, asked)
                   for student, labs in texts.items() if topic in labs}
        near |= {(student, topic): share for student, answer in written.items()
                 if (share := share_of_reference(answer, topic)) > NEAR}
        known = known_parts(topic, tuple(asked), KEPT)
        for exercise in asked:
            own = {student: answer[exercise.name] for student, answer in written.items()
                   if exercise.name in answer}
            for pair, nodes, of, parts in alike(own, known[exercise.name], few(len(texts))):
                shared[pair].append(Shared(exercise.number, topic, exercise.name, nodes, of, parts))
    found = [Pair(*pair, sum(one.nodes - FORCED for one in each),
                  tuple(sorted(each, key=lambda one: -one.nodes))) for pair, each in shared.items()]
    return sorted((pair for pair in found if pair.nodes >= LEAST),
                  key=lambda pair: (-pair.nodes, pair.first, pair.second)), near


def few(count):
    """A part that more students than this have is common, in a class of so many."""
    return max(10, count // 10)


def alike(written, known, most):
    """{student: (size, parts)} -> (pair, nodes, of, parts) of each pair that shares enough."""
    holders = collections.defaultdict(list)
    for student, (_, parts) in written.items():
        for part in parts:
            holders[part].append(student)
    shared = collections.defaultdict(list)
    for part, students in holders.items():
        if part not in known and 1 < len(students) <= most:
            for pair in itertools.combinations(sorted(students), 2):
                shared[pair].append(part)
    for pair, parts in shared.items():
        nodes = min(covered(written[student][1], parts).bit_count() for student in pair)
        if nodes > FORCED:
            yield pair, nodes, min(written[student][0] for student in pair), frozenset(parts)


def covered(bits, parts):
    """The nodes in these parts, as bits. bits: an answer's parts."""
    return functools.reduce(operator.or_, (bits[part] for part in parts if part in bits), 0)


def share_of_reference(answer, topic):
    """How much of {exercise: (size, parts)} is in parts of the reference's: 0 to 1.

    Extras are left out: they may have come complete.
    """
    core = tuple(one for one in exercises.topic_exercises(topic) if not one.is_extra)
    same, of = 0, 0
    for name, known in known_parts(topic, core, ("reference",)).items():
        parts = answer[name][1] if name in answer else {}
        same += covered(parts, known).bit_count()
        of += covered(parts, parts).bit_count()
    return same / of if of >= SHORT else 0


@functools.cache
def known_parts(topic, asked, folders):
    """{exercise: the parts that answers have which the course itself keeps}."""
    known = {exercise.name: set() for exercise in asked}
    for folder in folders:
        path = places.ROOT / folder / f"{topic}.py"
        if not path.exists():
            continue
        for functions in versions(exercises.read(path)):
            for name, (_, parts) in compared(functions, topic, asked).items():
                known[name].update(parts)
    return known


def versions(text):
    """Yield {name: function}: where several functions have one name, one after the other."""
    functions = collections.defaultdict(list)
    for function in exercises.top_level_functions(text):
        functions[function.name].append(function)
    for number in range(max(map(len, functions.values()), default=0)):
        yield {name: each[min(number, len(each) - 1)] for name, each in functions.items()}


def answers(text, topic, asked):
    """{exercise: (size, parts)} of a student's lab. Nothing where it is no Python."""
    try:
        return compared(functions_of(text), topic, asked)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return {}


def read_answer(text, shared) -> Answer:
    """The Answer in a lab's text, of which some is shared."""
    return answer(functions_of(text), shared.topic, shared.name)


def functions_of(text):
    """{name: function} of a text, also under the names that an import in it gives them."""
    body = ast.parse(text).body
    functions = {node.name: node for node in body if isinstance(node, ast.FunctionDef)}
    return functions | {alias.asname: functions[alias.name] for node in body
                        if isinstance(node, ast.ImportFrom) for alias in node.names
                        if alias.asname and alias.name in functions}


def compared(functions, topic, asked):
    """{exercise: (size, parts)} of the exercises that a module answers."""
    found = {exercise.name: answer(functions, topic, exercise.name) for exercise in asked
             if exercise.name in functions}
    return {name: (len(one.nodes), one.parts) for name, one in found.items()}


# --- an answer's parts ------------------------------------------------------------------------


def answer(functions, topic, name):
    """The Answer to an exercise, out of a module's {name: function}."""
    helpers = functions.keys() - given_names(topic)
    used = reached(functions, name, helpers)
    own = helpers.union(*map(bound, used))
    nodes = []
    for statement in itertools.chain(*(without_texts(function.body) for function in used)):
        put(statement, nodes)
    parts = collections.defaultdict(int)
    for place, (node, size) in enumerate(nodes):
        if isinstance(node, ast.expr | ast.stmt) and SMALLEST <= size <= LARGEST:
            parts[hash(shape(node, own, {}))] |= (1 << size) - 1 << place
    return Answer(used, nodes, dict(parts))


@functools.cache
def given_names(topic):
    """The names of a module's functions as it is handed out."""
    text = exercises.read(exercises.reference(topic))
    return {function.name for function in exercises.top_level_functions(text)}


def reached(functions, name, helpers):
    """The function of this name, and the helpers that it calls, itself or through others."""
    names, ends = [name], [name]
    while ends:
        for node in ast.walk(functions[ends.pop()]):
            called = getattr(node, "id", getattr(node, "attr", None))  # norm, or norms.norm
            if called in helpers and called not in names:
                names.append(called)
                ends.append(called)
    return [functions[each] for each in names]


def bound(function):
    """The names that a function gives to its own variables."""
    return {getattr(node, NAME[type(node)]) for node in ast.walk(function) if type(node) in NAME
            and isinstance(getattr(node, "ctx", None), ast.Store | None)}


def without_texts(nodes):
    """Nodes without docstrings, and other statements that are only a constant."""
    return [node for node in nodes
            if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant))]


def fields(node):
    """Yield (name, value) of what a node is made of: nodes, constants, names, lists of them."""
    for name, value in ast.iter_fields(node):
        if name not in LEFT_OUT and value is not None:
            yield name, without_texts(value) if isinstance(value, list) else value


def put(node, nodes):
    """Append a node, and then those in it, each with its size. After MOST nodes, none."""
    place = len(nodes)
    if place >= MOST or isinstance(node, UNCOUNTED):
        return
    nodes.append(None)
    for _, value in fields(node):
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                put(child, nodes)
    nodes[place] = node, len(nodes) - place


def shape(value, own, numbers):
    """A node as text. Variables have the numbers of their order in it in the place of names."""
    if isinstance(value, list):
        return f"[{' '.join(shape(one, own, numbers) for one in value)}]"
    if not isinstance(value, ast.AST):
        return f"{type(value).__name__} {hash(value)}"  # a number of 5,000 digits has no repr
    inner = [f"v{numbers.setdefault(each, len(numbers))}"
             if name == NAME.get(type(value)) and each in own else shape(each, own, numbers)
             for name, each in fields(value)]
    return f"({type(value).__name__} {' '.join(inner)})"
