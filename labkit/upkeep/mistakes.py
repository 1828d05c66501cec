"""The mistakes that are likely, exercise by exercise, and the hints that they give.

Each exercise has one to eight. They are written as changes of the right answer, in
tests/mistakes/<topic>.txt:

    2.4  (e >= 0).all(0) | (e <= 0).all(0) -> (e > 0).all(0) | (e < 0).all(0)
          the border does not count as inside: > 0 for >= 0

changes.py has the rules. The words below a change go on after "this is what comes out when".

Mistakes serve twice. Each must be caught by its exercise's own checks. And where a student's
function does in all checks what a known mistake does there, or what two of them do together, the
report tells the sentence.

At home there is no library, only tests/labs/hints.json: for each exercise the sentences, with
what their mistakes returned to the checks that caught them, as fingerprints, with the default seed.
`run` makes it. The tests try of a mistake one check alone, that which hints.json names first.
"""
import itertools
import json
import textwrap
from typing import NamedTuple

from .. import exercises, places
from ..checks.hints import HINTS, digest, known_mistakes, pattern
from ..checks.showing import plural
from . import changes
from .trials import Trial, caught_by


class Mistake(NamedTuple):
    """An exercise, the function with the mistake, and "when ..."."""

    topic: str
    exercise: exercises.Exercise
    text: str
    sentence: str


def listed(folder, topic):
    """Yield (exercise, its Entries in tests/FOLDER/<topic>.txt, the texts of their functions).

    ValueError: an entry is of no exercise of the topic, or its changes have no place there.
    """
    entries = changes.entries(places.ROOT / "tests" / folder / f"{topic}.txt")
    asked = exercises.topic_exercises(topic)
    for entry in entries:
        if entry.number not in [exercise.number for exercise in asked]:
            raise ValueError(f"{entry.place}: {entry.number} is no exercise of {topic}; "
                             "give it the number of one")
    for exercise in asked:
        own = [entry for entry in entries if entry.number == exercise.number]
        yield exercise, own, changes.wrong_functions(topic, exercise, own)


def changed_functions(folder, topic):
    """Yield (place, exercise, text, words) of each Entry that is `listed`."""
    for exercise, entries, texts in listed(folder, topic):
        for entry, text in zip(entries, texts, strict=True):
            yield entry.place, exercise, text, entry.said


def library(topic):
    """The Mistakes of a topic. ValueError: one is of no exercise, or has no sentence."""
    found = []
    for place, exercise, text, sentence in changed_functions("mistakes", topic):
        if not sentence:
            raise ValueError(f"{place}: {exercise.name} has no sentence; write below what goes on "
                             'after "this is what comes out when"')
        found.append(Mistake(topic, exercise, text, sentence))
    return found


def twice(topic):
    """Yield the Mistake of each two changes, made one after the other; its sentence is both."""
    for exercise, entries, texts in listed("mistakes", topic):
        for pair in itertools.combinations(zip(entries, texts, strict=True), 2):
            both = [text for (_, text), (other, _) in (pair, pair[::-1])
                    for text in changes.again(text, other)]
            if both:
                yield Mistake(topic, exercise, both[0], tuple(entry.said for entry, _ in pair))


def tried(topic, mistakes):
    """[(Mistake, [Check that caught it])]."""
    trials = [Trial(mistake.exercise, mistake.text) for mistake in mistakes]
    return list(zip(mistakes, caught_by(topic, trials, all_checks=True), strict=True))


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


def doubles(found, singles):
    """[[digest, and the numbers of two sentences in singles]] of what `tried` gives of `twice`.

    One that does as a single mistake is left out.
    """
    number = {sentence: k for k, (said, _) in enumerate(singles)
              for sentence in said.split(", or when ")}
    known = {digest(failed) for _, failed in singles}
    return [[mark, *(number[sentence] for sentence in mistake.sentence)]
            for mistake, caught in found if {*mistake.sentence} <= number.keys()
            and (mark := digest(pattern(caught).failed)) not in known]


def run(target=None):
    """Try all mistakes, or those of a topic or a lab, and write tests/labs/hints.json.

    -> 0 if all are caught, else 1.
    """
    made, alive = dict(known_mistakes()) if target else {}, []
    for topic in exercises.asked_for(target)[0]:
        found, both = tried(topic, library(topic)), tried(topic, list(twice(topic)))
        asked = list(dict.fromkeys(mistake.exercise for mistake, _ in found))
        for exercise in asked:
            own, twins = ([pair for pair in pairs if pair[0].exercise == exercise]
                          for pairs in (found, both))
            made[exercise.number] = patterns(own)
            made[f"{exercise.number} twice"] = doubles(twins, made[exercise.number])
        alive += [mistake for mistake, caught in found if not caught]
        print(f"{topic:20} {plural(len(found), 'mistake'):>13} "
              f"in {plural(len(asked), 'exercise')}")
    for mistake in alive:
        print(f"{mistake.exercise.number} is not caught: when {mistake.sentence}\n"
              f"{textwrap.indent(mistake.text, '    ')}")
    places.write_whole(HINTS, as_json(made).encode("utf-8"))
    print(f"{plural(sum(len(made[n]) for n in made if ' ' not in n), 'sentence')} in {HINTS.name}")
    return int(bool(alive))


def as_json(made):
    """JSON with one line for each sentence, so that a diff shows the mistake that changed."""
    blocks = [f"{json.dumps(number)}: [\n"
              + ",\n".join(json.dumps(known, sort_keys=True) for known in made[number]) + "\n]"
              for number in sorted(made)]
    return "{\n" + ",\n".join(blocks) + "\n}\n"
