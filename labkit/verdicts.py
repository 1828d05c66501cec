"""What became of exercises: the verdict on each of them, its points, and what it waits for.

`run` judges what was asked for, `Found` is what it returns. The board shows it, and the grader
makes marks of the same entries.
"""
import contextlib
from collections.abc import Iterable
from typing import NamedTuple

from . import exercises, imports, places
from .checks.loader import folder
from .checks.report import Check
from .checks.runner import run_checks
from .checks.showing import plural
from .table import COMMAND

ALL_THERE = ("numpy, scipy, Python's own library and what was imported already are, and your own "
             "modules in labs/, one file each of at most 32 kB of UTF-8: from .norms import norm")
NOTHING = "not started", "not readable"  # verdicts that give no points, whatever claims hold


class Entry(NamedTuple):
    """An exercise with its checks. It is done when its question is, whatever its fine print."""

    number: str
    name: str
    topic: str
    points: int  # 0: a step
    extra: bool
    verdict: str  # done, failing, not run, not started, blocked by 2.1, not readable
    fine_print_open: bool  # it is done, and a check of its fine print does not pass
    checks: list[Check]

    @property
    def told(self) -> str:
        """The verdict as a board has it: done, fine print open."""
        return f"{self.verdict}, fine print open" if self.fine_print_open else self.verdict

    @property
    def blocked_by(self) -> str:
        """The exercise that it waits for. "": none."""
        return self.verdict.partition("blocked by ")[2]

    @property
    def claims(self) -> tuple[int, int]:
        """(how many claims of the question hold, how many there are)."""
        return claims(self.checks)

    @property
    def reached(self) -> float:
        """Its points by the share of its question's claims that hold, down to half points.

        All of them only where it is done: one whose process is lost after all claims have held
        has the points of all but one. None if no claim holds whose numbers are drawn: all others
        can be typed in from the checks.
        """
        hold, of = self.claims
        if self.verdict == "done":
            return self.points
        if self.verdict in NOTHING or not of or self.only_known_numbers:
            return 0
        return 2 * self.points * min(hold, of - 1) // of / 2

    @property
    def only_known_numbers(self) -> bool:
        """Are there claims with drawn numbers, and none of them holds?"""
        drawn = [claims([other for other in self.checks if other.function == check.function])
                 for check in self.checks if check.drawn and not check.fine_print]
        return bool(drawn) and not any(hold for hold, _ in drawn)

    def told_points(self, reached: float) -> str:
        """A sentence on so many points: 2 of 3 points: 4 of 5 claims hold."""
        hold, of = self.claims
        told = f"{reached:g} of {plural(self.points, 'point')}: " if self.points else ""
        known = ", but none on random numbers" * (hold > 0 and self.only_known_numbers)
        return f"{told}{hold} of {plural(of, 'claim')} hold{'s' * (of == 1)}{known}"


class Found(NamedTuple):
    """What became of what was asked for."""

    asked: list[Entry]
    needed: list[Entry]      # with the exercises that these call
    closed: set[str]         # extras that were left out: they are complete as they came
    broken: dict[str, str]   # {topic: what is wrong with its file} where Python cannot read it
    problems: list[str]      # sentences on checks that cannot be trusted
    warnings: list[str]      # sentences on what is not there where labs are graded
    losses: list[str]        # those on what costs a whole file's points there

    @property
    def all_is_done(self) -> bool:
        """Whether all exercises are done. Steps count where nothing else was asked for."""
        asked = [entry for entry in self.asked if entry.points] or self.asked
        return all(entry.verdict == "done" for entry in asked)


def run(target: str | None, implementation: str, seed: int, extra: bool = False) -> Found:
    """Run the checks of a lab, an exercise or all, and of what these call.

    ValueError: there is no such target or folder, or it is an extra that is not open.
    """
    labs, asked = exercises.asked_for(target)
    code = folder(implementation)
    closed = set() if extra else closed_extras(labs, code)
    if not set(asked) - closed:
        raise ValueError(not_open(target, labs, asked))
    called = called_exercises(labs, code, closed)
    needed = exercises.closure(set(asked) - closed, lambda number: called.get(number, ()))
    broken = not_python(labs, code)
    checks, problems = run_checks({topic: labs[topic] for topic in labs if topic not in broken},
                                  needed, implementation, seed)
    board = entries(labs, needed, called, checks, broken)
    return Found([entry for entry in board if entry.number in asked], board, closed, broken,
                 problems, *not_there(labs, code))


def closed_extras(labs, code):
    """The numbers of the extras that the code under test marks as closed: complete as they came."""
    closed = set()
    for topic, lab in labs.items():
        with contextlib.suppress(OSError, UnicodeDecodeError):  # its checks say so
            closed |= exercises.closed_extras(lab, exercises.read(code / f"{topic}.py"))
    return closed


def not_open(target, labs, asked):
    """The sentence on a target of which nothing is open."""
    kind, it = (("is an extra, and", "it") if target in asked else
                ("has extras alone, and they are", "them"))
    where = ", ".join(f"labs/{topic}.py" for topic, lab in labs.items()
                      if any(exercise.number in asked for exercise in lab))
    return (f"{target} {kind} complete in {where}; {COMMAND} open {target} empties {it} "
            "for you to write")


def not_python(labs, code):
    """{topic: what is wrong with its file, in a line} of the files that Python cannot read."""
    broken = {}
    for topic in labs:
        with contextlib.suppress(OSError):  # not there: its checks say so
            try:
                exercises.top_level_functions(exercises.read(code / f"{topic}.py"))
            except ValueError as error:
                broken[topic] = f"{places.shown_path(code / topic)}.py, {error}"
    return broken


def not_there(labs, code):
    """(warnings, losses): sentences on what is not there where labs are graded."""
    warnings, losses = [], []
    for topic, lab in labs.items():
        worth = sum(one.points for one in lab if not one.is_extra)
        warnings += imports.pasted(topic, imports.text_in(code, topic) or "")
        for path, need in imports.not_there(topic, code):
            costs = need.at_the_top and worth
            so = f", so {topic}.py would lose all its {plural(worth, 'point')}" if costs else ""
            (losses if costs or need.is_file else warnings).append(
                f"{places.shown_path(path)}, line {need.line}: {need.shown} is not there when "
                f"your labs are graded{so}; {ALL_THERE}")
    return warnings, losses


def called_exercises(labs, code, closed=()):
    """{number: numbers of the exercises that the code under test calls in it}, without closed."""
    called = {}
    for topic, lab in labs.items():
        numbers = {exercise.name: exercise.number for exercise in lab
                   if exercise.number not in closed}
        try:
            names = exercises.calls(exercises.read(code / f"{topic}.py"), numbers)
        except (OSError, ValueError):  # not there, or not Python: then it is not called either
            continue
        called |= {numbers[name]: [numbers[other] for other in names[name]] for name in names}
    return called


def entries(labs: dict, needed: Iterable[str], called: dict, found: list[Check],
            broken: Iterable[str] = ()) -> list[Entry]:
    """The Entry of each needed exercise, in the course's order."""
    checks = {number: [check for check in found if check.exercise == number] for number in needed}
    questions = {number: [check.verdict for check in checks[number] if not check.fine_print]
                 for number in needed}
    done = {number for number, verdicts in questions.items() if {*verdicts} == {"passed"}}
    unfine = {number for number in done if any(one.verdict != "passed" for one in checks[number])}

    def entry(topic, exercise):
        number = exercise.number
        undone = [other for other in called.get(number, ()) if other not in done]
        verdict = "not readable" if topic in broken else verdict_of(questions[number], undone)
        is_own = not unfine & {*called.get(number, ())}  # else it is that of what it calls
        return Entry(number, exercise.name, topic, exercise.points, exercise.is_extra, verdict,
                     number in unfine and is_own, checks[number])

    return [entry(topic, exercise) for topic, lab in labs.items() for exercise in lab
            if exercise.number in checks]


def verdict_of(verdicts: list[str], undone: list[str]) -> str:
    """The verdict on an exercise, from those on its question's checks.

    undone: the exercises that it calls and that are not done.
    """
    if {*verdicts} == {"passed"}:
        return "done"
    if "failed" in verdicts or not verdicts:
        return f"blocked by {undone[0]}" if undone else "failing"
    return next((verdict for verdict in verdicts if verdict.startswith(("blocked", "not run"))),
                "failing" if "passed" in verdicts else "not started")


def claims(checks: list[Check]) -> tuple[int, int]:
    """(how many claims of a question hold, how many there are). Each is one function of the tests.

    It holds if its check has run and passed, in all its cases.
    """
    hold = {}
    for check in checks:
        if not check.fine_print:
            held = hold.get(check.function, True)
            hold[check.function] = held and check.verdict == "passed"
    return sum(hold.values()), len(hold)


def points(board: list[Entry]) -> tuple[float, int]:
    """(points reached, points in all) of the core."""
    core = [entry for entry in board if not entry.extra]
    return sum(entry.reached for entry in core), sum(entry.points for entry in core)
