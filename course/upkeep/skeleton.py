"""The labs, made of the reference: a raise in place of every core exercise's answer.

Everything else stays, byte for byte, also extras, which `extras` opens. labs/.generated.json keeps
a hash of every lab as it was made. A lab with another hash was worked on, and is not made anew
without --force.
"""
import hashlib
import json
import re
from pathlib import Path
from typing import NamedTuple

from .. import exercises
from ..given import places


class Lab(NamedTuple):
    """A lab's path, the text that the reference makes, and the state of the text that is there."""

    path: Path
    text: str
    state: str  # in step, stale (or not there), worked on


class Answer(NamedTuple):
    """An exercise's answer: lines[start:end] of a module's text."""

    exercise: exercises.Exercise
    start: int
    end: int
    text: str
    todo: str  # the line that stands in its place in a lab


def skeleton(text, extra=False):
    """The lab's text, from the reference's. With extra, its extras are opened.

    ValueError: a mark is wrong.
    """
    lines = exercises.text_lines(text)
    for answer in reversed(answers(text)):  # upwards: lines above stay put
        if extra or not answer.exercise.is_extra:
            put(lines, answer, answer.todo, is_open=True)
    return "".join(lines)


def answers(text):
    """The Answer to each exercise of a module's text. ValueError: a mark is wrong."""
    lines = exercises.text_lines(text)
    functions = {function.lineno: function for function in exercises.top_level_functions(text)}

    def answer(exercise):
        function = functions[exercise.line]
        question, end = function.body[0], answer_end(lines, function)
        indent = lines[question.lineno - 1][:question.col_offset]
        newline = lines[end - 1].removeprefix(lines[end - 1].rstrip("\r\n"))
        todo = f'raise NotImplementedError("exercise {exercise.number}: {exercise.name}")'
        return Answer(exercise, question.end_lineno, end,
                      "".join(lines[question.end_lineno:end]), f"{indent}{todo}{newline}")

    return [answer(exercise) for exercise in exercises.text_exercises(text)]


def put(lines, answer, text, is_open):
    """Put another text in an answer's place; of an extra, let the mark say whether it is open."""
    lines[answer.start:answer.end] = [text]
    mark = answer.exercise.line - 1
    lines[mark] = re.sub(rf"(# extra [^)]*\))(?:{exercises.OPEN})?",
                         rf"\1{exercises.OPEN if is_open else ''}", lines[mark])


def answer_end(lines, function):
    """The last line of an answer; an indented comment below the last statement belongs to it."""
    end = function.end_lineno
    for number, line in enumerate(lines[end:], end + 1):
        if re.match(r"[ \t]+#", line):
            end = number
        elif line.strip():
            break
    return end


def run(check=False, force=False):
    """Make labs/ from reference/. With check, only say how the labs stand. -> exit status.

    A lab that was worked on stays as it is. With force it is made anew, its text kept beside it.
    """
    standing = labs()
    if check:
        for path, _, state in standing:
            advice = ": run python3 -m course skeleton" if state == "stale" else ""
            print(f"labs/{path.name}: {state}{advice}")
        return int(any(state != "in step" for _, _, state in standing))

    made, refused = manifest(), False
    for path, text, state in standing:
        if state == "worked on" and not force:
            refused = True
            print(f"labs/{path.name} was worked on and stays as it is; to start it anew, run "
                  "python3 -m course skeleton --force, which keeps your text beside it")
            continue
        if state == "worked on":
            print(f"labs/{path.name} is made anew; your text is in labs/{keep(path).name}")
        if state != "in step":
            places.write_whole(path, text.encode("utf-8"))
        made[path.name] = digest(text)
    places.write_whole(manifest_path(), f"{json.dumps(made, indent=2, sort_keys=True)}\n".encode())
    return int(refused)


def labs():
    """Every topic's Lab. ValueError: a reference has a wrong mark."""
    made = manifest()

    def lab(topic):
        exercises.topic_exercises(topic)  # its errors name the file
        path = places.ROOT / "labs" / f"{topic}.py"
        text = skeleton(exercises.read(exercises.reference(topic)))
        there = digest(exercises.read(path)) if path.exists() else None
        if there == digest(text):
            return Lab(path, text, "in step")
        return Lab(path, text, "stale" if there in (None, made.get(path.name)) else "worked on")

    return [lab(topic) for topic in exercises.topics()]


def keep(path):
    """Copy a file to .bak, or .bak2, ... where that is taken; the copy's path."""
    copies = (path.with_name(f"{path.name}.bak{number}") for number in ("", *range(2, 1000)))
    copy = next(copy for copy in copies if not copy.exists())
    places.write_whole(copy, path.read_bytes())
    return copy


def digest(text):
    """The hash of a text, whatever its line ends."""
    return hashlib.sha256(text.replace("\r\n", "\n").encode("utf-8")).hexdigest()


def manifest_path():
    return places.ROOT / "labs" / ".generated.json"


def manifest():
    """{file: its digest when it was made}; empty where it cannot be read: no lab is overwritten."""
    try:
        return json.loads(manifest_path().read_bytes())
    except (OSError, ValueError):
        return {}
