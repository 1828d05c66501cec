"""When something was handed in, how late that was, and how much of the points it costs."""
import math
import re
from datetime import UTC, datetime, timedelta, tzinfo
from typing import NamedTuple

SECONDS = {"min": 60, "h": 3600, "hour": 3600, "d": 86400, "day": 86400}
MOODLE = ("%d %B %Y, %I:%M %p", "%B %d, %Y, %I:%M %p", "%d %B %Y, %H:%M", "%B %d, %Y, %H:%M")
NOT_TOLD = "late, by how much is not told"
NO_TIME = "when it was handed in is not told"


class Policy(NamedTuple):
    """When it is due, and what a late submission costs."""

    due: float | None = None    # seconds since 1970
    zone: tzinfo | None = None  # of times that name none, and of those shown; None: the machine's
    grace: int = 0              # so many seconds late cost nothing
    percent: float = 0.0        # of the points reached, for each step that has begun
    step: int = SECONDS["day"]


class Lateness(NamedTuple):
    """What is told of a submission's time, and the percentage that it takes off the points."""

    handed_in: str = ""
    late_by: str = ""
    percent: float = 0


def policy(due=None, late=None, grace=None) -> Policy:
    """('2026-11-22T23:59', '10%/day', '1h') -> Policy. ValueError: one of them cannot be read."""
    if due is None and (late or grace):
        raise ValueError("--late and --grace need --due, as in --due 2026-11-22T23:59")
    percent, step = share(late) if late else (0.0, SECONDS["day"])
    when = moment(due) if due else None
    return Policy(when and when.timestamp(), when and when.tzinfo,
                  duration(grace) if grace else 0, percent, step)


def moment(text, what="--due", zone=None):
    """ISO -> the moment, in a zone where it names none. None: this machine's."""
    try:
        found = datetime.fromisoformat(text)
    except ValueError:
        found = None
    if found is None or not re.search(r"\d[T ]\d", text):
        raise ValueError(f"{what} {text} is no date with a time: write it as in 2026-11-22T23:59, "
                         "or 2026-11-22T23:59+01:00")
    return found if found.tzinfo else found.replace(tzinfo=zone)


def share(text):
    """'10%/day' -> (10.0, 86400)."""
    found = re.fullmatch(r"(\d+(?:\.\d+)?)%/(day|hour)", text)
    if not found or not 0 < float(found[1]) <= 100:
        raise ValueError(f"--late {text} is no share of the points: write it as in 10%/day or "
                         "1%/hour, at most 100%")
    return float(found[1]), SECONDS[found[2]]


def duration(text):
    """'1h' -> 3600."""
    found = re.fullmatch(r"(\d+)(min|h|d)", text)
    if not found:
        raise ValueError(f"--grace {text} is no duration: write it as in 15min, 1h or 1d")
    return int(found[1]) * SECONDS[found[2]]


def judged(policy, handed_in, is_late) -> Lateness:
    """The Lateness of a submission.

    handed_in: seconds since 1970, None where that is not told. is_late: whether the platform says
    so, None where it says nothing.
    """
    if handed_in is None:
        unknown = NO_TIME if policy.due is not None and is_late is None else ""
        return Lateness(late_by=NOT_TOLD if is_late else unknown)
    late = math.floor(handed_in - policy.due) if policy.due is not None else 0
    steps = math.ceil(late / policy.step) if late > policy.grace else 0
    when = datetime.fromtimestamp(handed_in, UTC).astimezone(policy.zone)
    return Lateness(when.isoformat(timespec="seconds"),
                    str(timedelta(seconds=late)) if late > 0 else "",
                    min(100, steps * policy.percent))


def is_late(policy, handed_in, says) -> bool:
    """Whether a submission came after its time and the grace. As for `judged`."""
    if handed_in is None or policy.due is None:
        return bool(says)
    return math.floor(handed_in - policy.due) > policy.grace


def moodle_time(text, zone):
    """'Sunday, 22 November 2026, 11:59 PM', as Moodle's worksheet has it -> seconds since 1970.

    None where it cannot be read. Moodle names no zone: it is the one given.
    """
    text = re.sub(r"^[^\W\d]+day, ", "", " ".join(text.split()))
    for form in MOODLE:
        try:
            return datetime.strptime(text, form).replace(tzinfo=zone).timestamp()
        except ValueError:
            continue
    return None
