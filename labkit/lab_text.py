"""The text of a lab: the reference's, with answers taken out, put back, or left where they are."""
import re
from typing import NamedTuple

from .contract import TODO
from .exercises import OPEN, Exercise, text_exercises, text_lines, top_level_functions


class Answer(NamedTuple):
    """An exercise's answer: lines[start:end] of a module's text."""

    exercise: Exercise
    start: int
    end: int
    text: str
    todo: str  # the line that stands in its place in a lab


def skeleton(text: str, extra: bool = False) -> str:
    """The lab's text, from the reference's. With extra, its extras are opened.

    ValueError: a mark is wrong.
    """
    lines = text_lines(text)
    for answer in reversed(answers(text)):  # upwards: lines above stay put
        if extra or not answer.exercise.is_extra:
            put(lines, answer, answer.todo, is_open=True)
    return "".join(lines)


def answers(text: str) -> list[Answer]:
    """The Answer to each exercise of a module's text. ValueError: a mark is wrong."""
    lines = text_lines(text)
    functions = {function.lineno: function for function in top_level_functions(text)}

    def answer(exercise):
        function = functions[exercise.line]
        question, end = function.body[0], answer_end(lines, function)
        indent = lines[question.lineno - 1][:question.col_offset]
        newline = lines[end - 1].removeprefix(lines[end - 1].rstrip("\r\n"))
        todo = f'raise NotImplementedError("{TODO.format(exercise.number, exercise.name)}")'
        return Answer(exercise, question.end_lineno, end,
                      "".join(lines[question.end_lineno:end]), f"{indent}{todo}{newline}")

    return [answer(exercise) for exercise in text_exercises(text)]


def put(lines: list[str], answer: Answer, text: str, is_open: bool) -> None:
    """Put another text in an answer's place; of an extra, let the mark say whether it is open."""
    lines[answer.start:answer.end] = [text]
    mark = answer.exercise.line - 1
    lines[mark] = re.sub(rf"(# extra [^)]*\))(?:{OPEN})?",
                         rf"\1{OPEN if is_open else ''}", lines[mark])


def answer_end(lines, function):
    """The last line of an answer; an indented comment below the last statement belongs to it."""
    end = function.end_lineno
    for number, line in enumerate(lines[end:], end + 1):
        if re.match(r"[ \t]+#", line):
            end = number
        elif line.strip():
            break
    return end
