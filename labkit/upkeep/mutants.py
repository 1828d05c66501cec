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

from .. import exercises, places
from ..checks.showing import plural
from .changes import entries, function_of
from .mutations import mutants
from .trials import Trial, caught_by

GOAL_EXERCISE, GOAL_COURSE = 0.95, 0.98  # shares of the mutants that are caught


class Score(NamedTuple):
    """What became of mutants, counted: those of the question, and how many of them were caught,
    then those that only the fine print catches, and those that are excused.
    """

    mutants: int = 0
    caught: int = 0
    fine_print: int = 0
    known: int = 0


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


def score(topic, exercise):
    """Let the checks of an exercise judge its mutants -> its Score, and lines on what lives, and on
    what is said to be equivalent in vain.
    """
    number, tried = exercise.number, mutants(function_of(topic, exercise))
    excused = {change for one, change in equivalents(topic) if one == number}
    verdicts = caught_by(topic, [Trial(exercise, mutant.text) for mutant in tried])
    alive = {mutant.change: mutant for mutant, verdict in zip(tried, verdicts, strict=True)
             if not verdict}
    survivors = alive.keys() - excused
    fine = sum(bool(verdict) and verdict[0].fine_print for verdict in verdicts)
    known = len(alive) - len(survivors)
    counted = len(tried) - known - fine
    return Score(counted, counted - len(survivors), fine, known), [
        *(f"{number}  {change}\n      lives, reference/{topic}.py:{mutant.line}"
          for change, mutant in alive.items() if change in survivors),
        *(f"{number}  {change}\n      is listed as equivalent, but is caught, or is no mutant"
          for change in sorted(excused - alive.keys()))]


def run(target=None):
    """Try the mutants of a lab (2 or rasterization), of an exercise (2.3), or of all.

    Prints a table, then every mutant that lives with its line. -> 0 if 95 % of each exercise's
    mutants and 98 % of the core's are caught, else 1.
    """
    labs, asked = exercises.asked_for(target)
    wanted = [(topic, exercise) for topic, exercises in labs.items() for exercise in exercises
              if exercise.number in asked]
    scores, remarks = {"core": [], "extra": []}, []
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # each thread waits for a process of its own
        judged = pool.map(lambda one: score(*one), wanted)
        for (_, exercise), (found, said) in zip(wanted, judged, strict=True):
            scores["extra" if exercise.is_extra else "core"].append(found)
            remarks += said
            print(row(exercise.number, exercise.name, found), flush=True)
    for name, found in scores.items():
        if found:
            print(row(name, plural(len(found), "exercise"), together(found)))
    print(*remarks, sep="\n")
    too_low = any(share(found) < GOAL_EXERCISE for found in scores["core"] + scores["extra"])
    return int(too_low or share(together(scores["core"])) < GOAL_COURSE)


def together(scores):
    return Score(*map(sum, zip(*scores, strict=True)))


def share(found):
    return found.caught / found.mutants if found.mutants else 1.0


def row(number, name, found):
    fine = f", {found.fine_print} more by the fine print" if found.fine_print else ""
    known = f", and {found.known} equivalent" if found.known else ""
    return (f"{number:>5}  {name:30} {found.caught:4} of {found.mutants:4} caught  "
            f"{100 * share(found):5.1f} %{fine}{known}")
