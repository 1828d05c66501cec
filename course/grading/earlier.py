"""What earlier runs left in the same folder: nobody falls out of the tables."""
import json

from .submissions import Submission

NEEDED = {"student", "identity", "handed_in", "late", "level", "seed", "checks", "digest",
          "problem", "board", "notes"}


def records(out, handed_in, columns):
    """The records of those who are not graded now.

    ValueError: they would not fit into the same table, or a folder is another student's.
    """
    now = {one.student.casefold(): one for one in handed_in}
    found = []
    for path in sorted(out.glob("students/*/record.json")):
        record, one = read(path), now.get(path.parent.name.casefold())
        if one is None and not fits(record, columns):
            raise ValueError(f"{out} holds grades of {path.parent.name} for other labs, or of "
                             "another version of the course: name another folder with --out")
        if one is None:
            found.append(record)
        elif are_two(record.get("identity", one.identity), one.identity):
            raise ValueError(f"{path.parent} holds grades of another student, whose name is almost "
                             "the same: name another folder with --out")
    return found


def read(path):
    """What an earlier run wrote, {} where it cannot be read."""
    try:
        return dict(json.loads(path.read_bytes()))
    except (OSError, TypeError, ValueError):
        return {}


def fits(record, columns):
    """Whether a record has what the tables show."""
    numbers = {exercise.number for exercise in columns}
    return record.keys() >= NEEDED and (not record["board"] or numbers == {
        entry["number"] for entry in record["board"]["exercises"]})


def are_two(before, now):
    """Whether names that were handed in by hand are of two people."""
    return before["platform"] == now["platform"] == "" and before["name"] != now["name"]


def submission(record):
    """Who it was, and when. The labs are not there any more."""
    return Submission(record["student"], {}, {}, tuple(record["notes"]), record["identity"],
                      record["handed_in"], record["late"])
