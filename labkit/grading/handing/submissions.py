"""What was handed in, of each student: the texts of labs/<topic>.py, and what else is told.

    platforms.py    whose it is, by the names that platforms give
    archives.py     which file is a lab, in folders and archives

Everything in the folder has a row, or is in the list of what was not understood.
"""
import hashlib
import unicodedata
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from ... import exercises
from ...table import TASKS
from . import archives, contents, platforms

LONGEST_NAME = 100  # bytes of a student's name as a folder
MOST_TIMES = 20     # at which a student's work is looked at, the newest
AGAIN = "what was handed in later changes nothing that is graded: the earlier time counts"
NOBODY = ("no student can be told from this name: put it into a folder with the student's name, "
          "or call it ada.zip or ada_{topic}.py, and grade again")


class Submission(NamedTuple):
    """What one student has handed in."""

    student: str              # unique in any case, safe as a folder's name
    texts: dict[str, str]     # {topic, or a module of the student's own: text}
    missing: dict[str, str]   # {topic: sentence}, of those that were expected and cannot be taken
    notes: tuple[str, ...]    # sentences for the report
    identity: platforms.Identity = platforms.Identity()
    handed_in: float | None = None  # seconds since 1970 UTC, as the platform tells it
    late: bool | None = None  # as the platform says; None: it says nothing
    digest: str = ""          # the hash of all labs, as `pack` prints it; "": not known
    group: str = ""           # whose members hand in the same
    problem: str = ""         # why it cannot be graded, which is not the student's doing
    others: tuple = ()        # Submissions: what this student had handed in at other times


def read(folder, topics) -> tuple[list[Submission], list]:
    """The submissions in a folder, one for each student; [(name, sentence)] of the rest.

    OSError or ValueError: there is no submission.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise ValueError(f"there is no folder {folder}: name the one with the submissions")
    found, not_understood = listed(folder, topics)
    if not found:
        raise ValueError(f"nothing was handed in to {folder}: it should hold a folder, a zip or "
                         f"a file such as ada_{topics[0]}.py for each student"
                         + "".join(f"\n{name}: {sentence}" for name, sentence in not_understood))
    names, senders = distinct(found), Counter(path for each in found.values() for _, path in each)
    groups = {path: path.name for path, count in senders.items() if count > 1}
    print(f"submissions to read: {len(found)}", flush=True)
    return [submission(names[student], found[student], topics, groups)
            for student in sorted(found)], not_understood


def listed(folder, topics):
    """{student: [(Sender, path)]} of a folder; [(name, sentence)] of what cannot be anybody's."""
    submitters = platforms.gradescope(folder)
    found, not_understood, seen = {}, [], set()
    for path in sorted(folder.iterdir()):
        if path.name in platforms.NOT_HANDED_IN or path.name.startswith("._"):
            continue
        senders = platforms.senders(path, submitters)
        for sender in senders:
            found.setdefault(sender.student, []).append((sender, path))
        seen.add(path.stem)
        if not senders:
            not_understood.append((archives.quoted(path.name), NOBODY.format(topic=topics[0])))
    for name in submitters.keys() - seen:
        who = ", ".join(sender.student for sender in submitters[name])
        not_understood.append((name, f"{platforms.METADATA} names it as {who}'s, and it is not "
                                     "there: unpack the export again"))
    return found, sorted(not_understood)


def distinct(students):
    """{student: a name for a folder, a table and a page}, no two the same in any case."""
    names, taken = {}, set()
    for student in sorted(students):
        name = tidy(student)
        if name.casefold() in taken:
            name = cut_name(name, student)
        taken.add(name.casefold())
        names[student] = name
    return names


def tidy(student) -> str:
    """Letters, digits, marks on letters, and . _ - between them; cut where it is too long."""
    kept = (c if c.isalnum() or c in "._-" or unicodedata.category(c)[0] == "M" else " "
            for c in student)
    name = "_".join("".join(kept).split()).strip("._-") or "nameless"
    return name if len(name.encode()) <= LONGEST_NAME else cut_name(name, student)


def cut_name(name, student):
    """A name that is cut, and nobody else's."""
    tail = hashlib.sha256(student.encode()).hexdigest()[:6]
    return f"{name.encode()[:LONGEST_NAME - 7].decode('utf-8', 'ignore')}_{tail}"


def submission(name, found, topics, groups):
    """The newest file of each lab that a student has handed in. What was there before as well
    counts from then on. groups {path: its group}.
    """
    try:
        every, problem = list(opened(found)), ""
    except PermissionError as error:
        every = [(*one, [], {}) for one in found]
        names = archives.few([path.name for _, path in found])
        problem = (f"{names} cannot be read here ({archives.reason(error)}): allow yourself to "
                   "read it, and grade again")
    newest, *before = (at_a_time(name, every[k:], topics, groups)
                       for k in range(min(len(every), MOST_TIMES)))
    first = {}
    for one in (*before[::-1], newest):
        first.setdefault(tuple(sorted(one.texts.items())), one)
    counts = first.pop(tuple(sorted(newest.texts.items())))
    again = [AGAIN] * ((counts.late, counts.handed_in) != (newest.late, newest.handed_in))
    return counts._replace(
        missing=newest.missing, digest=newest.digest, problem=problem,
        others=tuple(first.values()),
        notes=(*newest.notes, *again * bool(newest.texts)))


def opened(found):
    """Yield (sender, path, notes, labs) of what a student has handed in, the newest first."""
    budget = archives.Budget()
    for sender, path in sorted(found, key=lambda one: one[0].order, reverse=True):
        notes, inside = [], f"{path.name}/" if len(found) > 1 and path.is_dir() else ""
        yield sender, path, notes, {
            topic: lab._replace(when=(sender.order, lab.when),
                                source=archives.quoted(inside + lab.source))
            for topic, lab in archives.labs_in(path, path.name, notes, budget).items()}


def at_a_time(name, every, topics, groups):
    """What a student had handed in when the first of these came, the newest."""
    notes = [note for _, _, said, _ in every for note in said]
    labs = [there for *_, there in every]
    whole, _ = contents.texts_of(archives.newest(labs, []), (*exercises.topics(), *TASKS), [])
    others = {*exercises.TOPICS, *TASKS} - {*topics}
    taken = archives.newest([{topic: lab for topic, lab in there.items() if topic not in others}
                             for there in labs], notes)
    texts, missing = contents.texts_of(taken, topics, notes)
    sender, path, *_ = every[0]
    return Submission(name, texts, missing, tuple(notes), sender.identity, sender.handed_in,
                      sender.late, contents.digest(whole), groups.get(path, ""))
