"""What a submission is worth: the checks' points, what was changed by hand, and lateness."""
from .lateness import NO_TIME, NOT_TOLD
from .records import Record
from .sheets import number_text

SAME = "the same work and checks: was it a time-out?"
LEFT = "after lateness"


def points(record: Record) -> dict[str, float]:
    """{exercise: points}, by hand where an override says so. Empty if nothing could be graded."""
    checked = {} if record.result.problem else by_checks(record)
    return checked | {what: override.points for what, override in record.overrides.items()
                      if what not in ("total", "late")}


def counting(record: Record) -> list:
    """The entries that give points: all but steps."""
    return [entry for entry in record.result.entries if entry.points]


def by_checks(record):
    """{exercise: points}, as the checks give them."""
    return {entry.number: 0 if record.all_or_nothing and entry.verdict != "done" else entry.reached
            for entry in counting(record)}


def is_graded(record: Record) -> bool:
    return bool(points(record)) or "total" in record.overrides


def total(record: Record) -> float:
    """The points before lateness."""
    given = record.overrides.get("total")
    return given.points if given else sum(points(record).values())


def taken_off(record: Record) -> float:
    """The points that lateness costs."""
    given = record.overrides.get("late")
    share = round(total(record) * record.lateness.percent / 100, 2)
    return min(total(record), given.points if given else share)


def after_lateness(record: Record) -> float:
    """The points that count in the end."""
    return round(total(record) - taken_off(record), 2)


def rank(record: Record) -> tuple:
    """The greatest counts, of several hand-ins: what could not be graded hides no mark."""
    return (bool(record.result.problem), after_lateness(record), -(record.work.handed_in or 0),
            record.how.seed)


def changes(before: Record, now: Record):
    """Yield (student, exercise or sum, points before, points now, why) of what is different."""
    causes = {"handed in again": before.work.digest != now.work.digest,
              "other checks": before.how.checks != now.how.checks,
              "other isolation": before.how.level != now.how.level,
              "all or nothing": before.all_or_nothing != now.all_or_nothing,
              "by hand": before.overrides != now.overrides,
              "lateness": before.lateness != now.lateness,
              "one of the two could not be graded": before.result.problem != now.result.problem}
    why = ", ".join(cause for cause, is_one in causes.items() if is_one) or SAME
    old, new = figures(before), figures(now)
    for what in new | old:
        was, is_now = number_text(old.get(what)), number_text(new.get(what))
        if was != is_now:
            yield now.work.student, what, was, is_now, why


def figures(record):
    """All points of a record. Empty if nothing could be graded."""
    if not is_graded(record):
        return {}
    return points(record) | {"total": total(record), LEFT: after_lateness(record)}


def open_fine_print(record: Record) -> list[str]:
    """The exercises that are done, but for their fine print."""
    return [entry.number for entry in counting(record)
            if entry.fine_print_open and not record.result.problem]


def override_sentences(record: Record) -> list[str]:
    """A sentence for each override, as tables and pages show it."""
    before = {number: f" instead of {got:g}" for number, got in by_checks(record).items()}
    before["total"] = f" instead of {number_text(sum(points(record).values()))}"
    before["late"] = " taken off"
    return [f"{what}: {number_text(override.points)}{before.get(what, '')} by hand "
            f"({override.reason})" for what, override in record.overrides.items()]


def sentences(record: Record) -> list[str]:
    """For the student: what was changed by hand, and what lateness costs."""
    late = record.lateness.late_by
    found = override_sentences(record)
    if late and late != NO_TIME:
        found.append(f"handed in {late if late == NOT_TOLD else f'late by {late}'}: "
                     f"{number_text(taken_off(record))} is taken off the points, "
                     f"{number_text(after_lateness(record))} remains")
    return found
