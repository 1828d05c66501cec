"""The mistakes that people really make, exercise by exercise, and the hints that they give.

tests/mistakes/<topic>.py has up to six wrong functions for each exercise. It is only read, never
imported: each function takes the place of the one of its name, and its docstring goes on after
"this is what comes out when". They serve twice. Each must be caught by its exercise's own checks.
And where a student's function does in all checks what a known mistake does there, the report tells
the sentence.

At home there is no library, only course/checks/hints.json: for each exercise the sentences, with
what their mistakes returned to the checks that caught them, as fingerprints, with the default seed.
"""
import ast
import json
import textwrap
from typing import NamedTuple

from .. import exercises
from ..checks.hints import HINTS, known_mistakes, pattern
from ..checks.showing import plural
from ..given import places
from . import mutants


class Mistake(NamedTuple):
    """An exercise, the function with the mistake, and "when ..."."""

    topic: str
    exercise: exercises.Exercise
    text: str
    sentence: str


def wrong_functions(folder, topic):
    """Yield (place, exercise, text, docstring in one line) of tests/FOLDER/<topic>.py.

    ValueError: a function is no exercise of the topic.
    """
    path = places.ROOT / "tests" / folder / f"{topic}.py"
    text = exercises.read(path) if path.exists() else ""
    lines = exercises.text_lines(text)
    known = {exercise.name: exercise for exercise in exercises.topic_exercises(topic)}
    for function in exercises.top_level_functions(text):
        place = f"tests/{folder}/{topic}.py, line {function.lineno}"
        if function.name not in known:
            raise ValueError(f"{place}: {function.name} is no exercise of {topic}; "
                             "give it the name of one")
        yield (place, known[function.name],
               "".join(lines[function.lineno - 1:function.end_lineno]),
               " ".join((ast.get_docstring(function) or "").split()))


def library(topic):
    """The Mistakes of a topic. ValueError: a function is no exercise, or has no sentence."""
    found = []
    for place, exercise, text, sentence in wrong_functions("mistakes", topic):
        if not sentence:
            raise ValueError(f"{place}: {exercise.name} has no docstring; write there what goes on "
                             'after "this is what comes out when"')
        found.append(Mistake(topic, exercise, text, sentence))
    return found


def tried(topic):
    """[(Mistake, [Check that caught it])]."""
    mistakes = library(topic)
    trials = [(mistake.exercise, mistake.text) for mistake in mistakes]
    return list(zip(mistakes, mutants.caught_by(topic, trials, only_first=False), strict=True))


def patterns(found):
    """[(sentence, its Pattern's failed)] of what `tried` gives of one exercise.

    Mistakes that do the same in all checks make one sentence: "..., or when ...".
    """
    kept = []
    for mistake, caught in found:
        failed = pattern(caught).failed
        if any(failed.values()):
            same = [sentence for sentence, other in kept if other == failed]
            kept = [pair for pair in kept if pair[1] != failed]
            kept.append((", or when ".join([*same, mistake.sentence]), failed))
    return kept


def run(target=None):
    """Try all mistakes, or those of a topic or a lab, and write course/checks/hints.json.

    -> 0 if all are caught, else 1.
    """
    made, alive = dict(known_mistakes()) if target else {}, []
    for topic in exercises.topics():
        found = tried(topic) if target in (None, topic, str(exercises.lab_number(topic))) else []
        for exercise in dict.fromkeys(mistake.exercise for mistake, _ in found):
            own = [pair for pair in found if pair[0].exercise == exercise]
            made[exercise.number] = patterns(own)
        alive += [mistake for mistake, caught in found if not caught]
        if found:
            numbers = {mistake.exercise.number for mistake, _ in found}
            print(f"{topic:20} {plural(len(found), 'mistake'):>13} "
                  f"in {plural(len(numbers), 'exercise')}")
    for mistake in alive:
        print(f"{mistake.exercise.number} is not caught: when {mistake.sentence}\n"
              f"{textwrap.indent(mistake.text, '    ')}")
    text = json.dumps(made, indent=0, sort_keys=True) + "\n"
    places.write_whole(HINTS, text.encode("utf-8"))
    print(f"{plural(sum(map(len, made.values())), 'sentence')} in course/checks/hints.json")
    return int(bool(alive))
