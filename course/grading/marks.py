"""What a submission is worth: the checks' points, what was changed by hand, and lateness."""
from .lateness import NO_TIME, NOT_TOLD
from .sheets import shown


def points(record):
    """{exercise: points}, by hand where an override says so. Empty if nothing could be graded."""
    checked = {} if record["problem"] else by_checks(record)
    return checked | {number: override["points"] for number, override in by_hand(record).items()
                      if number not in ("total", "late")}


def by_checks(record):
    """{exercise: points}, as the checks give them."""
    board = record["board"]
    return {entry["number"]: entry["points"] * (entry["verdict"] == "done")
            for entry in board["exercises"]} if board else {}


def by_hand(record):
    """{exercise, or "total", or "late": {"points", "reason"}}."""
    return record.get("overrides", {})


def is_graded(record):
    return bool(points(record)) or "total" in by_hand(record)


def total(record):
    """The points before lateness."""
    given = by_hand(record).get("total")
    return given["points"] if given else sum(points(record).values())


def taken_off(record):
    """The points that lateness costs."""
    given = by_hand(record).get("late")
    percent = record.get("lateness", {}).get("percent", 0)
    return min(total(record), given["points"] if given else round(total(record) * percent / 100, 2))


def after_lateness(record):
    """The points that count in the end."""
    return round(total(record) - taken_off(record), 2)


def open_fine_print(record):
    """The exercises that are done, but for their fine print."""
    board = record["board"]
    return [entry["number"] for entry in board["exercises"]
            if entry["told"] != entry["verdict"]] if board and not record["problem"] else []


def fine_print(record):
    """-> (exercises whose fine print is right as well, exercises that have any)."""
    if not record["board"] or record["problem"]:
        return 0, 0
    having = [entry for entry in record["board"]["exercises"]
              if any(check["fine_print"] for check in entry["checks"])]
    return sum(entry["verdict"] == entry["told"] == "done" for entry in having), len(having)


def told_by_hand(record):
    """A sentence for each override, as tables and pages show it."""
    checked = by_checks(record)
    before = {number: f" instead of {got}" for number, got in checked.items()}
    before["total"] = f" instead of {shown(sum(points(record).values()))}"
    before["late"] = " taken off"
    return [f"{what}: {shown(override['points'])}{before.get(what, '')} by hand "
            f"({override['reason']})" for what, override in by_hand(record).items()]


def told(record):
    """Sentences for the student: what was changed by hand, and what lateness costs."""
    late = record.get("lateness", {}).get("late by")
    sentences = told_by_hand(record)
    if late and late != NO_TIME:
        sentences.append(f"handed in {late if late == NOT_TOLD else f'late by {late}'}: "
                         f"{shown(taken_off(record))} points are taken off, "
                         f"{shown(after_lateness(record))} remain")
    return sentences
