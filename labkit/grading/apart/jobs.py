"""What an examination is given, and what it returns."""
from typing import NamedTuple

from ...verdicts import Entry
from .sandbox import Limits

SETS = MARK, BOARD = "mark", "scoreboard"  # of an open task: nobody fits the mark to the board


class Job(NamedTuple):
    """What is to be examined: the labs' texts, and a sentence for each that is not there."""

    texts: dict[str, str]     # {topic, or a module of the student's own: text}
    missing: dict[str, str]   # {topic: sentence}
    level: str
    seed: int = 0
    limits: Limits = Limits()
    extra: bool = False       # whether extras are examined, too
    asks: dict | None = None  # {exercise: {"topic.name": bytes that the reference asks it for}}.
    #                           None: find that out. Of an open task: what is expected of each set
    task: dict | None = None  # of an open task: the seed of each of its sets, MARK and BOARD


class Result(NamedTuple):
    """What became of a Job. Without entries, nothing could be examined."""

    entries: list[Entry]
    lost: dict[str, str]      # {exercise: why its worker can't be used any longer}
    missing: dict[str, str]   # {topic: sentence}: not there, or cannot be imported
    asked: dict               # as Job.asks, of this submission
    problem: str | None       # why there are no points, which is not the student's doing
    seconds: float


def failure(problem: str) -> Result:
    return Result([], {}, {}, {}, problem, 0.0)
