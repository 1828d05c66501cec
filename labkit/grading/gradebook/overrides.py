"""Points that an instructor gives by hand, each with a reason: overrides.csv.

    student,exercise,points,reason
    ada,2.3,2,the figure was right
    ada,late,0,was ill           what lateness takes off
    bob,total,15,oral examination
"""
from typing import NamedTuple

from . import sheets

COLUMNS = ("student", "exercise", "points", "reason")


class Override(NamedTuple):
    """Points in the place of those that the checks, or lateness, would give."""

    points: float
    reason: str


def read(path, students, exercises) -> dict[str, dict[str, Override]]:
    """{student: {exercise: Override}}. ValueError names the first line that is wrong.

    students {what somebody is called: those of grades.csv}. exercises: those that are graded.
    """
    most = {exercise.number: exercise.points for exercise in exercises}
    most["total"] = most["late"] = sum(most.values())
    found = {}
    for where, (student, exercise, points, reason) in sheets.by_columns(path, COLUMNS):
        given = found.setdefault(*students.get(student, [None])[:1], {})
        if wrong := problem(student, exercise, reason, students, most, given):
            raise ValueError(f"{where}: {wrong}")
        given[exercise] = Override(number(points, most[exercise], where), reason)
    return found


def problem(student, exercise, reason, students, most, given):
    """A sentence on what is wrong with a row, or None."""
    if len(who := students.get(student, ())) != 1:
        there = f" ({', '.join(who)})" * bool(who)
        return (f"{len(who) or 'nobody'} called {student!r} handed in anything{there}: write the "
                "name as in the column student of grades.csv, or the platform's id")
    if exercise not in most:
        return (f"{exercise!r} is not graded: give an exercise such as {next(iter(most))}, "
                "or total, or late")
    if not reason:
        return f"there is no reason for {student}'s {exercise}: write one, the student reads it"
    return f"{student}'s {exercise} was given in a line above, too" if exercise in given else None


def number(text, most, where):
    """Points from 0 to the most that there are."""
    points = sheets.number(text)
    if points is None or points > most:
        raise ValueError(f"{where}: {text!r} is no number of points from 0 to {most}")
    return int(points) if points == int(points) else points
