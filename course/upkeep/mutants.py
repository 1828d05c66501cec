"""Mutants: small mistakes made by machine, which an exercise's own checks must catch.

A mutant is an exercise of the reference with one change in its body, see mutations.py. Each one
takes the place of the right function, and the exercise's checks run until one fails. Then the
mutant is caught, also if it raised an error or did not end. A mutant that lives shows what no check
looks at. A mutant that only checks of the fine print catch is one of the fine print, and is counted
there.

A change that changes nothing (or nothing that the question settles) is no mistake. Such mutants
stand with their reason in tests/equivalents/<topic>.txt, and do not count:

    3.12  a < b -> a <= b (#2)
          At a = b both branches give the same point.
"""
import os
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

from .. import exercises
from ..checks.showing import plural
from ..given import places
from .changes import entries, function_of
from .mutations import mutants, nameless
from .trials import Trial, caught_by

GOAL_EXERCISE, GOAL_COURSE = 0.95, 0.98  # shares of the mutants that are caught


class Score(NamedTuple):
    """What became of an exercise's mutants, counted: those of its question, and how many of them
    were caught, then those that only its fine print catches. survivors: [Mutant].
    """

    topic: str
    exercise: exercises.Exercise
    mutants: int
    caught: int
    fine_print: int
    survivors: list
    known: int
    stale: list


def equivalents(topic):
    """{(number, change): reason} from tests/equivalents/<topic>.txt.

    Changes stand one below the other, then their reason, indented. ValueError: no reason.
    """
    reasons, waiting = {}, []
    for entry in entries(places.ROOT / "tests" / "equivalents" / f"{topic}.txt"):
        waiting.append((entry.number, *entry.changes))
        if entry.said:
            reasons |= dict.fromkeys(waiting, entry.said)
            waiting = []
    if waiting:
        raise ValueError(f"{entry.place}: {' '.join(waiting[0])} has no reason below it; "
                         "say why this mutant is no mistake")
    return reasons


def listed(exercise, function, reasons):
    """{change without the function's own names: as the list writes it} of an exercise."""
    return {nameless(change, function): change for number, change in reasons
            if number == exercise.number}


def score(topic, exercise, reasons):
    """Let the checks of an exercise judge its mutants -> Score."""
    function = function_of(topic, exercise)
    tried, excused = mutants(function), listed(exercise, function, reasons)
    verdicts = caught_by(topic, [Trial(exercise, mutant.text) for mutant in tried])
    alive = [mutant for mutant, verdict in zip(tried, verdicts, strict=True) if not verdict]
    named = {nameless(mutant.change, function): mutant for mutant in alive}
    survivors = [mutant for key, mutant in named.items() if key not in excused]
    stale = [change for key, change in excused.items() if key not in named]
    known = len(alive) - len(survivors)
    fine = sum(bool(verdict) and verdict[0].fine_print for verdict in verdicts)
    counted = len(tried) - known - fine
    return Score(topic, exercise, counted, counted - len(survivors), fine, survivors, known, stale)


def run(target=None):
    """Try the mutants of a lab (2 or rasterization), of an exercise (2.3), or of all.

    Prints a table, then every mutant that lives with its line. -> 0 if 95 % of each exercise's
    mutants and 98 % of the core's are caught, else 1.
    """
    labs, asked = exercises.asked_for(target)
    wanted = [(topic, exercise, equivalents(topic))
              for topic, exercises in labs.items() for exercise in exercises
              if exercise.number in asked]
    scores = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # each thread waits for a process of its own
        for found in pool.map(lambda one: score(*one), wanted):
            scores.append(found)
            print(row(found.exercise.number, found.exercise.name, found), flush=True)
    core, extra = ([s for s in scores if s.exercise.is_extra == kind] for kind in (False, True))
    print(*(row(name, plural(len(found), "exercise"), all_together(found))
            for name, found in (("core", core), ("extra", extra)) if found),
          *(text for found in scores for text in remarks(found)), sep="\n")
    too_low = any(share(s) < GOAL_EXERCISE for s in scores)
    return int(too_low or share(all_together(core)) < GOAL_COURSE)


def all_together(scores):
    return Score("", None, sum(s.mutants for s in scores), sum(s.caught for s in scores),
                 sum(s.fine_print for s in scores), [], sum(s.known for s in scores), [])


def share(found):
    return found.caught / found.mutants if found.mutants else 1.0


def row(number, name, found):
    fine = f", {found.fine_print} more by the fine print" if found.fine_print else ""
    known = f", and {found.known} equivalent" if found.known else ""
    return (f"{number:>5}  {name:30} {found.caught:4} of {found.mutants:4} caught  "
            f"{100 * share(found):5.1f} %{fine}{known}")


def remarks(found):
    """What lives of an exercise, and what is said to be equivalent in vain."""
    number, file = found.exercise.number, f"reference/{found.topic}.py"
    return [*(f"{number}  {mutant.change}\n      lives, {file}:{mutant.line}"
              for mutant in found.survivors),
            *(f"{number}  {change}\n      is listed as equivalent, but is caught, or is no mutant"
              for change in found.stale)]
