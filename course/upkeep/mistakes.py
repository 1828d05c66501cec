"""The mistakes that people really make, exercise by exercise, and the hints that they give.

tests/mistakes/<topic>.py has for each exercise rows (what the reference says, what somebody wrote
instead, a sentence). They serve twice. Each must be caught by its exercise's own checks. And where
a student's function returns in a check what a known mistake returns there, the report tells the
sentence: "this is what comes out when ...".

At home there is no library, only course/checks/hints.json: for each sentence the fingerprints of
what its mistake returned to the checks that caught it, with the default seed.
"""
import json
import runpy
import textwrap
from typing import NamedTuple

from .. import board, exercises
from ..checks.hints import HINTS
from ..given import places
from . import mutants


class Mistake(NamedTuple):
    """An exercise, the function with the mistake, and "when ..."."""

    topic: str
    exercise: exercises.Exercise
    text: str
    sentence: str


def library(topic):
    """The Mistakes of a topic. ValueError: a row does not fit to the reference."""
    path = places.ROOT / "tests" / "mistakes" / f"{topic}.py"
    if not path.exists():
        return []
    text = exercises.read(exercises.reference(topic))
    functions = {function.name: function for function in exercises.top_level_functions(text)}
    known = {exercise.number: exercise for exercise in exercises.topic_exercises(topic)}
    found = []
    for number, rows in runpy.run_path(str(path))["MISTAKES"].items():
        if number not in known:
            raise ValueError(f"tests/mistakes/{topic}.py names exercise {number}, "
                             "and there is none: correct the number")
        head, answer = parts(text, functions[known[number].name])
        for right, wrong, sentence in rows:
            if right not in answer:
                raise ValueError(f"tests/mistakes/{topic}.py: exercise {number} does not say "
                                 f'"{right}" any more; write what the reference says now')
            found.append(Mistake(topic, known[number], head + answer.replace(right, wrong),
                                 sentence))
    return found


def parts(text, function):
    """A function's def line and its answer, without the question."""
    lines = text.replace("\r\n", "\n").splitlines(keepends=True)
    question = function.body[0]
    return ("".join(lines[function.lineno - 1:question.lineno - 1]),
            "".join(lines[question.end_lineno:function.end_lineno]))


def tried(topic):
    """[(Mistake, [(nodeid, fingerprint or None or False)] of the checks that caught it)]."""
    mistakes = library(topic)
    trials = [(mistake.exercise, mistake.text) for mistake in mistakes]
    return list(zip(mistakes, mutants.caught_by(topic, trials, only_first=False), strict=True))


def run():
    """Try all mistakes, write course/checks/hints.json. -> 0 if all are caught, else 1.

    Of several mistakes that return the same in a check, the first one's sentence is told.
    """
    sentences, told, alive = {}, set(), []
    for topic in exercises.topics():
        found = tried(topic)
        for mistake, caught in found:
            marks = sentences.setdefault(mistake.sentence, [])
            marks += [mark for _, mark in caught if mark and mark not in told]
            told.update(marks)
            alive += [mistake] * (not caught)
        if found:
            numbers = {mistake.exercise.number for mistake, _ in found}
            print(f"{topic:20} {board.plural(len(found), 'mistake'):>13} "
                  f"in {board.plural(len(numbers), 'exercise')}")
    for mistake in alive:
        print(f"{mistake.exercise.number} is not caught: when {mistake.sentence}\n"
              f"{textwrap.indent(mistake.text, '    ')}")
    marked = {sentence: sorted(marks) for sentence, marks in sentences.items() if marks}
    text = json.dumps(marked, indent=0, sort_keys=True) + "\n"
    places.write_whole(HINTS, text.encode("utf-8"))
    print(f"{board.plural(len(marked), 'sentence')} in course/checks/hints.json")
    return int(bool(alive))
