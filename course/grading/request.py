"""What is asked of `grade`."""
from typing import NamedTuple

from .gradebook.book import Asked


class Request(NamedTuple):
    """The options of `grade`, as they were given."""

    submissions: str
    out: str
    labs: str | None = None
    jobs: int | None = None      # at a time; None: one for each core
    resume: bool = False
    seed: int = 0
    isolation: str | None = None
    scheduler: str | None = None
    seconds: float = 10.0        # the most that a call may take
    extra: bool = False          # extras count as well: fair where they were handed out open
    book: Asked = Asked()        # what is asked for besides points
