"""grades.csv: one line for each student, with columns for core, fine print, extras, lateness."""
from . import marks, sheets
from .sheets import shown


def grades(records, exercises):
    """The rows of grades.csv, its titles first."""
    titles = list(line({"student": "", "board": None, "problem": "", "level": "", "seconds": 0,
                        "digest": "", "seed": "", "checks": "", "notes": ()}, exercises))
    return [titles, *([sheets.plain(cell) for cell in line(record, exercises).values()]
                      for record in records)]


def line(record, exercises):
    """{title: cell} of one student."""
    got = marks.points(record)
    graded = marks.is_graded(record)
    done, of = marks.fine_print(record)
    lateness = record.get("lateness", {})
    return {
        "student": record["student"], "name": (record.get("identity") or {}).get("name", ""),
        **{f"{one.number} {one.name}": shown(got.get(one.number)) for one in exercises},
        **sums("core", [one for one in exercises if not one.is_extra], got),
        **sums("extras", [one for one in exercises if one.is_extra], got),
        "fine print done": done if graded else "", "fine print of": of if graded else "",
        "total": shown(marks.total(record) if graded else None),
        "of": sum(one.points for one in exercises),
        "handed in": lateness.get("handed in", ""), "late by": lateness.get("late by", ""),
        "after lateness": shown(marks.after_lateness(record) if graded else None),
        "by hand": "; ".join(marks.told_by_hand(record)),
        "fine print open": " ".join(marks.open_fine_print(record)),
        "isolation": record["level"], "seconds": f"{record['seconds']:.1f}",
        "seed": record["seed"], "checks": record["checks"], "hash": record["digest"],
        "problem": record["problem"] or "", "notes": "; ".join(record["notes"])}


def sums(title, exercises, got):
    """Two columns, if there are such exercises: what was reached of them, and the most."""
    if not exercises:
        return {}
    reached = sum(got.get(one.number, 0) for one in exercises) if got else None
    return {title: shown(reached), f"{title} of": sum(one.points for one in exercises)}
