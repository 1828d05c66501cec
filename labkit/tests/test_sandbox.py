"""Workers seen from outside: who they are, how their time and memory are watched."""
import contextlib
import os
import signal
import sys
import time
from pathlib import Path

import pytest
from afresh import wait_until

from labkit.grading.apart import examination, levels, sandbox, wire
from labkit.grading.apart.processes import Use, family

GREEDY = '''
import os
import time

def greedy():
    for _ in range(4):
        if os.fork() == 0:
            kept = b"1" * (1 << 28)
            time.sleep(1000)
'''
LOOKS = '''
import os
import sys

def packages():
    return " ".join(f"{path}/{name}" for folder in (*sys.path, "/usr/lib/python3")
                    for path in (f"{folder}/site-packages", f"{folder}/dist-packages")
                    if os.path.isdir(path) for name in os.listdir(path))
'''
ENDLESS = """
def endless():
    while True:
        pass
"""


@pytest.fixture(params=levels.LEVELS)
def level(request):
    strict, about = sandbox.available()
    if request.param == "strict" != strict:
        pytest.skip(about)
    return request.param


def test_memory_is_watched_between_two_calls(level):
    """Children take all memory while the check computes, or while each answer comes at once."""
    limits = sandbox.Limits(memory=1 << 29)
    with contextlib.closing(sandbox.Worker(level, limits)) as worker:
        worker.exchange(("open", (("greedy", GREEDY, ()),), ()), 10)
        assert worker.exchange(("call", "greedy", "greedy", (), {}), 10)[0] == "returned"
        worker.guard.join(60)
        assert "more than 512 MB of memory" in worker.guard.excess
        with pytest.raises(sandbox.Lost, match="more than 512 MB of memory"):
            worker.exchange(("call", "greedy", "greedy", (), {}), 10)


def test_time_counts_that_no_process_seems_to_use():
    """A worker hides in a child that is waited for as if for a disk: asleep, and not seen so."""
    meter = sandbox.Meter()
    meter.began -= 100
    meter.add(sandbox.Look(time.monotonic(), Use(seconds=1, asleep=False)))
    meter.add(sandbox.Look(time.monotonic() + 100, Use(seconds=1, asleep=False)))
    assert meter.total() >= 100 / sandbox.CLOCK


def test_no_returned_string_is_long():
    """Among many short strings, a long one makes an array that fills the memory."""
    returned = ["a" * 10**6, ("b" * 10**6, 1.0), *[""] * 4]
    assert examination.shortened(returned) == ["a" * 200, ("b" * 200, 1.0), *[""] * 4]


@pytest.mark.skipif(sys.platform != "linux", reason="others cannot tie a process to its parent")
def test_what_runs_for_an_exercise_ends_with_its_worker(level):
    """The grader is killed, and an endless loop that it was waiting for goes on for ever."""
    with contextlib.closing(sandbox.Worker(level)) as worker:
        worker.exchange(("open", (("endless", ENDLESS, ()),), ()), 10)
        worker.socket.sendall(wire.framed(wire.encode(("call", "endless", "endless", (), {}))))
        *_, first, served = family(worker.process.pid)
        os.kill(first, signal.SIGKILL)
        wait_until(lambda: not is_alive(served), "it goes on")


def is_alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(sys.platform != "linux", reason="it reads /proc")
def test_a_worker_is_the_first_to_go_and_never_root(level):
    """Where memory runs out, the grader ends, or a neighbour. Or root's Python is nobody else's, so
    submissions run as root.
    """
    with contextlib.closing(sandbox.Worker(level)) as worker:
        inside = Path("/proc", str(family(worker.process.pid)[-1]))
        assert (inside / "oom_score_adj").read_text() == "1000\n"
        assert inside.stat().st_uid != 0


def test_no_packages_are_in_sight_but_those_that_labs_need():
    """All that was ever installed beside the Python that the course's environment was made from."""
    strict, about = sandbox.available()
    if strict != "strict":
        pytest.skip(about)
    with contextlib.closing(sandbox.Worker("strict")) as worker:
        worker.exchange(("open", (("looks", LOOKS, ()),), ()), 10)
        assert worker.exchange(("call", "looks", "packages", (), {}), 10)[1] == ""


def test_a_python_behind_a_link_is_shown_where_it_is(tmp_path, monkeypatch):
    """What the link points to is not in the sandbox: no strict for a Python that uv installed."""
    for name in {"lib", sys.platlibdir}:
        (tmp_path / "3.11.7" / name).mkdir(parents=True)
    (tmp_path / "3.11").symlink_to("3.11.7")
    monkeypatch.setattr(sys, "base_prefix", str(tmp_path / "3.11"))
    shown = levels.library()
    assert {tmp_path / "3.11/lib", tmp_path / "3.11.7/lib"} <= {*shown}


def test_bubblewrap_is_taken_from_where_it_was_found(tmp_path, monkeypatch):
    """It is on the PATH, but not in /usr/bin: a worker's environment has no PATH."""
    bwrap = tmp_path / "bwrap"
    bwrap.touch(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert levels.strict(str(tmp_path), sandbox.Limits())[0][0] == str(bwrap)


@pytest.mark.parametrize(("used", "spent"), [
    ([Use(0, 1.0, False), Use(0, 1.5, False)], 0.5),   # it waited for a busy machine
    ([Use(0, 1.0, False), Use(0, 9.0, False)], 8.0),   # it works in many processes
    ([Use(0, 1.0, True), Use(0, 1.0, True)], 4.0),     # it sleeps
])
def test_a_worker_pays_for_what_it_uses_or_sleeps(used, spent):
    """Right work is lost on a busy machine, or a worker that sleeps is waited for."""
    meter = sandbox.Meter()
    meter.add(sandbox.Look(meter.began + 1.0, used[0]))
    meter.add(sandbox.Look(meter.began + 5.0, used[1]))
    assert meter.spent == pytest.approx(1.0 + spent)  # the first second: nobody looked
