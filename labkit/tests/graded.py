"""Records as grading leaves them, made without grading."""
from labkit.checks.report import Check
from labkit.exercises import Exercise
from labkit.grading.apart.jobs import Result
from labkit.grading.gradebook.lateness import Lateness
from labkit.grading.gradebook.overrides import Override
from labkit.grading.gradebook.records import How, Record
from labkit.grading.handing.platforms import Identity
from labkit.grading.handing.submissions import Submission
from labkit.verdicts import Entry


def exercise(number, name, points, is_extra=False):
    return Exercise(number, name, points, 1, (), is_extra)


def submission(student, platform="", late=None, notes=(), when=None, **about):
    """about: what the platform tells of the person."""
    return Submission(student, {}, {}, tuple(notes), Identity(platform, **about), when, late, "d")


def check(number, claim="Claim", verdict="passed", message="", fine_print=False, picture=None):
    return Check(number, f"test_{claim}", claim, verdict, message, picture, 0.0, fine_print)


def entry(asked, verdict, *checks, topic="rasterization"):
    """An exercise as it was found, with these checks, which are enough to know its fine print."""
    open_fine_print = verdict == "done" and any(one.verdict != "passed" for one in checks)
    return Entry(asked.number, asked.name, topic, asked.points, asked.is_extra, verdict,
                 open_fine_print, list(checks))


def result(*entries, lost=(), missing=(), problem=None):
    return Result(list(entries), dict(lost), dict(missing), {}, problem, 1.0)


def record(work, found, seed=4, checks="c", late=(), overrides=()):
    """late: (late by, percent). overrides {exercise: (points, reason)}."""
    return Record(work, How("strict", seed, checks, ""), found,
                  Lateness("t", *late) if late else Lateness(),
                  {what: Override(*given) for what, given in dict(overrides).items()})
