"""Who works together, and who has more time: people.csv.

    student,group,due
    4711,blue,                    4711 gets what blue handed in, as others of that group do
    ada,,2026-11-29T23:59         an extension

A student or a group that handed in is named as in grades.csv, or by the platform's id, e-mail or
name. A member of a group did not, and is named as in the roster.
"""
from typing import NamedTuple

from ..handing.platforms import Identity
from ..handing.submissions import tidy
from . import lateness, sheets

COLUMNS = ("student", "group", "due")


class Person(NamedTuple):
    """A line of people.csv."""

    name: str          # as it stands there
    group: str         # "": none
    due: float | None  # seconds since 1970. None: as for all
    where: str         # of the line, for a sentence


def read(path, zone=None) -> list[Person]:
    """The lines of people.csv. zone: of times that name none. ValueError names a wrong line."""
    found = []
    for where, (name, group, due) in sheets.by_columns(path, COLUMNS):
        if not name or not (group or due):
            raise ValueError(f"{where}: give a student, and a group or a due time")
        if any(one.name == name for one in found):
            raise ValueError(f"{where}: {name} has a line above, too: put group and due into one")
        when = lateness.moment(due, f"{where}:", zone).timestamp() if due else None
        found.append(Person(name, group, when, where))
    return found


def called(handed_in) -> dict[str, list]:
    """{what somebody is called: the students of grades.csv who are called so}."""
    found = {}
    for one in handed_in:
        for name in {one.identity.id, one.identity.email, one.identity.name} - {""}:
            found.setdefault(name, []).append(one.student)
    return found | {one.student: [one.student] for one in handed_in}


def names(handed_in) -> dict[str, str]:
    """{what a student is called: the student of grades.csv}, if nobody else is called so."""
    return {name: each[0] for name, each in called(handed_in).items() if len(each) == 1}


def with_members(handed_in, people) -> list:
    """The submissions, those of groups once for each member.

    ValueError: a member has handed in alone, too.
    """
    known, groups = names(handed_in), {one.student: [] for one in handed_in}
    together = {known.get(person.group) for person in people}
    taken = {name.casefold() for name, student in known.items() if student not in together}
    for person in people:
        if person.group in known:
            student = tidy(person.name)
            if taken & {person.name.casefold(), student.casefold()}:
                raise ValueError(f"{person.where}: {person.name} is there alone, too: take one of "
                                 "the two out")
            taken.add(student.casefold())
            groups[known[person.group]].append((student, person.name))
    return sorted((one for group in handed_in for one in members(group, groups[group.student])),
                  key=lambda one: one.student)


def members(group, found):
    """The Submission of a group, as that of each member (student, name). Without any, as it is."""
    return [group._replace(student=student, group=group.student, identity=Identity(
        "people", name=name, file=group.identity.file)) for student, name in found] or [group]


def due_times(handed_in, people) -> dict[str, float]:
    """{student of grades.csv: when it is due for this one}."""
    known = names(handed_in)
    return {known[person.name]: person.due for person in people
            if person.due is not None and person.name in known}


def said(handed_in, people):
    """Sentences on lines that fit nobody: they have not handed in, or are misspelt."""
    known, alone = called(handed_in), {one.student for one in handed_in if not one.group}
    return [f"{person.where}: " + (
        f"{len(students)} are called so, and the line counts for none: {', '.join(students)}"
        if len(students) > 1 else f"nothing was handed in by {person.group or person.name}")
        for person in people if len(students := known.get(person.name, ())) != 1
        or (person.group and students[0] in alone)]
