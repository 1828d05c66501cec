"""Workers, as far as they can be seen from outside: who they are, how their time is counted."""
import contextlib
import os
import sys
from pathlib import Path

import pytest

from course.grading import sandbox
from course.grading.levels import LEVELS
from course.grading.processes import Use, family


@pytest.mark.skipif(sys.platform != "linux", reason="it reads /proc")
@pytest.mark.parametrize("level", LEVELS)
def test_a_worker_is_the_first_to_go_and_never_root(level):
    """Where memory runs out, the grader ends, or a neighbour. Or root's Python is nobody else's, so
    submissions run as root.
    """
    if level == "strict" != sandbox.available()[0]:
        pytest.skip(sandbox.available()[1])
    with contextlib.closing(sandbox.Worker(level)) as worker:
        inside = Path("/proc", str(family(worker.process.pid)[-1]))
        assert (inside / "oom_score_adj").read_text() == "1000\n"
        assert inside.stat().st_uid != 0


@pytest.mark.skipif(sys.platform != "linux", reason="strict needs Linux")
def test_strict_is_there_where_it_is_tested():
    """A release whose sandbox does not start is tested without it, and nobody notices."""
    level, about = sandbox.available()
    assert level == "strict" or not os.environ.get("CI"), about


@pytest.mark.parametrize(("used", "spent"), [
    ([Use(0, 1.0, False), Use(0, 1.5, False)], 0.5),   # it waited for a busy machine
    ([Use(0, 1.0, False), Use(0, 9.0, False)], 8.0),   # it works in many processes
    ([Use(0, 1.0, True), Use(0, 1.0, True)], 4.0),     # it sleeps
])
def test_a_worker_pays_for_what_it_uses_or_sleeps(monkeypatch, used, spent):
    """Right work is lost on a busy machine, or a worker that sleeps is waited for."""
    now = [100.0]
    monkeypatch.setattr(sandbox.time, "monotonic", lambda: now[0])
    meter = sandbox.Meter()
    meter.add(used[0])
    now[0] += 4.0
    meter.add(used[1])
    assert meter.spent == spent
