"""What is different from an earlier grades.csv, and why."""
import re

from . import sheets

CAUSES = {"hash": "handed in again", "checks": "other checks", "seed": "other random inputs",
          "isolation": "other isolation", "problem": "one of the two could not be graded"}
SAME = "the same work and checks: was it a time-out?"
HEADER = ("student", "exercise", "before", "after", "why")


def read(path) -> dict[str, dict]:
    """{student: {column: cell}} of an earlier grades.csv. ValueError: it is another file."""
    sheet = sheets.read(path)
    if not {"student", "total"} <= set(sheet.header):
        raise ValueError(f"{path} is no grades.csv: it has no columns student and total")
    return by_student(sheet.header, sheet.rows)


def by_student(header, rows) -> dict[str, dict]:
    """{student: {column: cell}} of grades.csv. All cells are texts, as in a file."""
    lines = (dict(zip(header, map(str, row), strict=False)) for row in rows)
    return {line["student"]: line for line in lines}


def changes(before, after):
    """Yield rows of HEADER: first the exercises of a student that changed, then the sums."""
    for student in sorted(before.keys() | after.keys()):
        old, new = before.get(student), after.get(student)
        if old is None or new is None:
            row = old or new
            yield (student, "total", old and row["total"], new and row["total"],
                   "new" if new else "handed in nothing this time")
            continue
        for column in new:
            what = subject(column)
            if what and column in old and old[column] != new[column]:
                yield student, what, old[column], new[column], why(what, old, new)


def subject(column):
    """'2.3 cover' -> '2.3'; a sum's column is itself; no other column holds points."""
    number = re.match(r"\d+\.\d+(?= )", column)
    return number[0] if number else column if column in ("total", "after lateness") else None


def why(what, old, new):
    """All that can have changed these points."""
    if what == "after lateness":
        return why_after_lateness(old, new)
    if changed := changed_by_hand(what, old, new):
        return changed
    differ = {column for column in CAUSES if column in old and old[column] != new[column]}
    if "hash" in differ:
        differ.discard("seed")  # each submission has its own
    causes = [cause for column, cause in CAUSES.items() if column in differ]
    alone = "what its exercises give" if what == "total" else SAME
    return ", ".join(causes) or alone


def why_after_lateness(old, new):
    before, now = (row.get("late by") or "not late" for row in (old, new))
    causes = (changed_by_hand("late", old, new),
              f"lateness: {now}, before: {before}" if before != now else None,
              "the total" if old["total"] != new["total"] else None)
    return ", ".join(filter(None, causes)) or "what lateness costs"


def changed_by_hand(what, old, new):
    now = by_hand(new, what)
    return None if by_hand(old, what) == now else now or "no longer by hand"


def by_hand(row, what):
    """What the column "by hand" says of an exercise, or None: 2.3: 2 by hand (why); 2.4: ..."""
    return dict(sentence.partition(": ")[::2]
                for sentence in row.get("by hand", "").split("; ")).get(what)
