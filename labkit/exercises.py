"""What exercises there are: the labs, their topics, and the marked functions of a topic's module.

An exercise is a whole function with a mark on its def line, and nowhere else:

    def is_covered(p, triangle):  # exercise 2.6 (2 points)          the core: for all to write
    def edge_function(p, a, b):  # step 2.1                  on the way there, without points
    def first_column(...):  # extra 2.14 (3 points)          complete in labs/, until it is opened
    def first_column(...):  # extra 2.14 (3 points), open    so marked in labs/ when it is

Its docstring is the question, its body is the answer. Functions without a mark are given.
"""
import ast
import functools
import hashlib
import io
import itertools
import json
import re
import tokenize
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

from . import places
from .table import COMPLETE, LABS

TOPICS = tuple(itertools.chain(*LABS))
WITHOUT_EFFECT = "matplotlib", "mpl_toolkits"  # where labs are graded, these do nothing
OPEN = ", open"  # the end of an opened extra's mark
MARK = re.compile(r"# (?:(step)|exercise|(extra)) ([1-9]\d*\.[1-9]\d*)"
                  rf"(?(1)| \(([1-9]\d*) points?\)(?(2)({OPEN})?))")
ANY_MARK = re.compile(rf"^def .*{MARK.pattern}$", re.MULTILINE)
MEANT_AS_MARK = re.compile(r"\W*(exercise\b|extra \d|step \d+\.\d)", re.IGNORECASE)


class Exercise(NamedTuple):
    """A marked function. calls: names of the exercises that its body needs, see `calls`."""

    number: str
    name: str
    points: int  # 0: a step, which is checked and gives none
    line: int
    calls: tuple
    is_extra: bool = False
    is_open: bool = True  # an extra is not, until it is opened: its answer is there


def topics() -> tuple[str, ...]:
    """The topics that there are, in the course's order."""
    return tuple(topic for topic in TOPICS if questions(topic).exists())


def lab_topics() -> tuple[str, ...]:
    """The topics that have a file in labs/: all but those that stand once, in course/complete."""
    return tuple(topic for topic in topics() if not complete(topic).exists())


def asking_topics() -> tuple[str, ...]:
    """The topics that have exercises, in the course's order: all but those of given code."""
    return tuple(topic for topic in topics() if ANY_MARK.search(read(questions(topic))))


def lab_number(topic: str) -> int:
    """The number of the lab that a topic belongs to; the first is 1."""
    return next(number for number, topics in enumerate(LABS, 1) if topic in topics)


def topics_of(labs: str | None) -> list[str]:
    """'1-4', '2' or '1,3' -> `lab_topics`. None: all. ValueError: there is no such lab."""
    there = {lab_number(topic) for topic in lab_topics()}
    asked = there if labs is None else {
        number for part in labs.split(",") for number in labs_in(part, there)}
    return [topic for topic in lab_topics() if lab_number(topic) in asked]


def labs_in(part, there):
    """'2' or '1-4' -> the numbers. ValueError unless all of them are there, and one at least."""
    form = re.fullmatch(r" *(\d{1,3})(?:-(\d{1,3}))? *", part)
    numbers = range(int(form[1]), int(form[2] or form[1]) + 1) if form else ()
    if not numbers or not there.issuperset(numbers):
        raise ValueError(f'there is no lab "{part}"; give labs as in 1-4 or 1,3 '
                         f"({min(there)} to {max(there)} are there)")
    return numbers


def asked_for(target: str | None) -> tuple[dict[str, list[Exercise]], list[str]]:
    """A lab (2, rasterization), labs (1-4), an exercise (2.3), None for all -> ({topic: its
    exercises}, the numbers of those that are asked for). ValueError: there is no such thing.
    """
    topics = {topic: str(lab_number(topic)) for topic in asking_topics()}
    several = topics_of(target) if re.search(r"\d[-,]", target or "") else []
    labs = {topic: topic_exercises(topic) for topic, lab in topics.items()
            if target is None or topic in (target, *several) or target.split(".")[0] == lab}
    asked = [exercise.number for lab in labs.values() for exercise in lab
             if several or target in (None, *labs, exercise.number) or target in topics.values()]
    if not asked:
        numbers = list(dict.fromkeys(topics.values()))
        raise ValueError(f'there is no lab or exercise "{target}"; give a lab '
                         f"({', '.join(numbers)}), a file of it ({', '.join(topics)}), or an "
                         "exercise, as in 2.1")
    return labs, asked


def lecture(topic: str) -> Path:
    """The path of the notebook that a topic belongs to."""
    number = lab_number(topic)
    return places.ROOT / "notebooks" / f"{number:02}_{LABS[number - 1][0]}.ipynb"


def pages(topic: str) -> list[Path]:
    """The notebooks of a topic's lab, as far as they are there: 06_texturing, 06b_cube_maps."""
    return sorted(lecture(topic).parent.glob(f"{lab_number(topic):02}*.ipynb"))


def cells(path: Path, kind: str = "markdown") -> list[str]:
    """The texts of a notebook's cells of a kind, "markdown" or "code"."""
    found = json.loads(read(path))["cells"]
    return ["".join(cell["source"]) for cell in found if cell["cell_type"] == kind]


def complete(topic: str) -> Path:
    """Where a topic's module stands that has nothing to write: one file for labs and reference."""
    return places.ROOT / COMPLETE / f"{topic}.py"


def reference(topic: str) -> Path:
    """A topic's module as it is in reference, where no answer is left out."""
    there = complete(topic)
    return there if there.exists() else places.ROOT / "reference" / f"{topic}.py"


def handed_out(topic: str) -> Path:
    """Where a hand-out keeps a lab as it was at first: a student may delete a mark."""
    return places.ROOT / "labkit" / "handed_out" / f"{topic}.py"


def questions(topic: str) -> Path:
    """Where a topic's exercises are listed: its reference, or in a hand-out what stands for it."""
    for path in reference(topic), handed_out(topic):
        if path.exists():
            return path
    return places.ROOT / "labs" / f"{topic}.py"  # it came along


def read(path: Path) -> str:
    """A module's text, its line ends as they are."""
    return places.read_whole(path).decode("utf-8")


def topic_exercises(topic: str) -> list[Exercise]:
    """The exercises of a topic of the course. ValueError: a mark is wrong, or of another lab."""
    path = questions(topic)
    place = f"{path.parent.name}/{path.name}"
    try:
        found = text_exercises(read(path))
    except ValueError as error:
        raise ValueError(f"{place}, {error}") from None
    for exercise in found:
        lab, _, rank = exercise.number.partition(".")
        if lab != str(lab_number(topic)):
            raise ValueError(f"{place}, line {exercise.line}: {exercise.name} is marked as "
                             f"exercise {exercise.number}, but {topic} is lab "
                             f"{lab_number(topic)}; number it {lab_number(topic)}.{rank}")
    return list(found)


def closed_extras(lab: list[Exercise], text: str) -> set[str]:
    """The numbers of a lab's extras that a module's text marks as complete, as they came."""
    marks = {exercise.number: re.search(rf"# extra {re.escape(exercise.number)} \(.*?\)({OPEN})?",
                                        text) for exercise in lab if exercise.is_extra}
    return {number for number, mark in marks.items() if mark and not mark[1]}


@functools.cache
def text_exercises(text: str) -> tuple[Exercise, ...]:
    """The exercises of a module's text, from top to bottom. ValueError: a mark is wrong."""
    lines = text_lines(text)
    functions = {function.lineno: function for function in top_level_functions(text)}
    found = {}
    for line, number, points, *kind in marks(text):
        if line not in functions:
            raise ValueError(f"line {line}: the mark of exercise {number} is on no def; move it to "
                             "the line with the def of a function that stands in no other")
        if number in found:
            raise ValueError(f"line {line}: exercise {number} is there already, on line "
                             f"{found[number].line}; give every exercise its own number")
        require_question_and_answer(lines, functions[line], number)
        found[number] = Exercise(number, functions[line].name, points, line, (), *kind)
    needs = calls(text, [exercise.name for exercise in found.values()])
    return tuple(exercise._replace(calls=needs[exercise.name]) for exercise in found.values())


@functools.cache
def top_level_functions(text: str) -> tuple[ast.FunctionDef, ...]:
    """The nodes of a module's functions. ValueError: the text is not Python."""
    try:
        module = ast.parse(text)
    except SyntaxError as error:
        raise ValueError(f"line {error.lineno}: this is not Python ({error.msg}); "
                         "mend it first") from None
    return tuple(node for node in module.body if isinstance(node, ast.FunctionDef))


def marks(text):
    """Yield line, number, points, is_extra, is_open of every mark.

    ValueError: a comment that is almost a mark.
    """
    for token in tokenize.generate_tokens(io.StringIO(text, newline="").readline):
        if token.type == tokenize.COMMENT and MEANT_AS_MARK.match(token.string):
            mark, line = MARK.fullmatch(token.string), token.start[0]
            if not mark:
                raise ValueError(f'line {line}: the comment "{token.string}" is not a mark; write '
                                 'it like "# exercise 2.1 (2 points)", "# extra 2.1 (1 point)" or '
                                 '"# step 2.1", or in other words')
            _, extra, number, points, opened = mark.groups("")
            yield line, number, int(points or 0), bool(extra), bool(opened) or not extra


def require_question_and_answer(lines, function, number):
    """ValueError unless the docstring stands on lines of its own, and the answer below."""
    title = f"line {function.lineno}: exercise {number}, {function.name},"
    if not ast.get_docstring(function):
        raise ValueError(f"{title} has no docstring; write the question there")
    question, *answer = function.body
    if lines[question.lineno - 1][:question.col_offset].strip():
        raise ValueError(f"{title} has its docstring beside the def; move it to the next line")
    if not answer or answer[0].lineno == question.end_lineno:
        raise ValueError(f"{title} has no answer on the lines below its docstring; write it there")


def calls(text: str, names: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """The exercises, out of names, that each one calls, itself or through other functions.

    -> {name: names}. The way ends at an exercise: what that one calls is its own affair.
    """
    called = {function.name: {node.func.id for node in ast.walk(function)
                              if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)}
              for function in top_level_functions(text)}

    def reached(name):
        seen = closure([name], lambda one: called.get(one, ()) if one == name or one not in names
                       else ())
        return tuple(other for other in names if other in seen and other != name)

    return {name: reached(name) for name in names}


def closure(starts: Iterable, after: Callable) -> set:
    """These, and all that comes after them in any number of steps. after(one) -> those next to it.
    """
    seen = set(starts)
    ends = list(seen)
    while ends:
        new = set(after(ends.pop())) - seen
        seen |= new
        ends += new
    return seen


def text_lines(text: str) -> list[str]:
    """The lines as Python counts them, each with its line end."""
    return list(io.StringIO(text, newline=""))


def digest(text: str) -> str:
    """The hash of a text, whatever its line ends."""
    return hashlib.sha256(text.replace("\r\n", "\n").encode("utf-8")).hexdigest()
