"""What is kept of one student's work: what came, how it was examined, what it is worth and why."""
from typing import NamedTuple

from ..apart.jobs import Result
from ..handing.submissions import Submission
from .lateness import Lateness
from .overrides import Override


class How(NamedTuple):
    """How a submission was examined. From the same fingerprint comes the same result."""

    level: str
    seed: int
    checks: str        # a hash of the course's own part
    fingerprint: str   # a hash of all that decides the result


class Record(NamedTuple):
    """One student's line in all tables. On disk it is students/ada/record.json, without texts."""

    work: Submission
    how: How
    result: Result
    lateness: Lateness = Lateness()
    overrides: dict[str, Override] = {}  # noqa: RUF012, {exercise, or "total", or "late": ...}
    all_or_nothing: bool = False  # an exercise gives all of its points where it is done, else none

    def failed(self, problem: str) -> "Record":
        """The same record, of what could not be graded."""
        return self._replace(result=self.result._replace(problem=problem))
