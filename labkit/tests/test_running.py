"""How a class is graded: many at a time, and stopped in the middle."""
import contextlib
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from afresh import wait_until
from small_course import CHECKS, LAB, first_lab, grade_command, grades, hand_in

from labkit import places

ENDLESS = LAB.replace("return x / 2, x > 0", "while True: x")


@pytest.fixture(scope="module")
def course(house):
    return house(first_lab())


@pytest.fixture
def handed_in(tmp_path):
    """The folder of two students: ada is right, bob is wrong."""
    hand_in(tmp_path, ada=LAB, bob=LAB.replace("2 * x", "3 * x"))
    return tmp_path / "in"


def processes(course):
    """The command lines of all processes that have to do with this copy of the course."""
    lines = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):  # it has ended
            lines.append(path.read_bytes().replace(b"\0", b" ").decode())
    return [line for line in lines if str(course) in line]


@pytest.mark.skipif(sys.platform == "win32", reason="there is no such timer")
def test_a_step_of_a_check_that_takes_minutes_is_ended(house, run_module, tmp_path):
    """A product of large matrices waits for no alarm: one line keeps a processor for 5 minutes."""
    alarm = (places.ROOT / "labkit" / "checks" / "alarm.py").read_text("utf-8")
    course = house(first_lab(checks=CHECKS.replace(
        "impl.double(x), expected", "(y := impl.double(x)) @ y.T, 4 * x @ x")) | {
            "labkit/checks/alarm.py": alarm.replace("OURS = 20.0", "OURS = 0.5")})
    hand_in(tmp_path, ada=LAB, bob="import numpy as np\n" + LAB.replace(
        "2 * x", "np.zeros((20_000, 100), bool)"))
    done = run_module(course, *grade_command(tmp_path), seconds=60)
    assert "\nbob: what it returned keeps a check busy that cannot be stopped" in done.stdout
    assert grades(tmp_path / "out")["ada"]["total"] == "7"


@pytest.mark.skipif(sys.platform != "linux", reason="processes are looked up in /proc")
@pytest.mark.parametrize(("stop", "late"), [
    ("ctrl-c", False), ("ctrl-c", True), ("interrupt", False), ("kill", True),
    pytest.param("interrupt", True, marks=pytest.mark.weekly),
    pytest.param("kill", False, marks=pytest.mark.weekly)])
def test_a_run_that_is_stopped_ends_all_that_it_started(
        stop, late, course, handed_in, run_module, tmp_path):
    """A traceback, a worker that runs for ever, or a wait for the slowest; ada is graded again."""
    endless = handed_in / "eve_transforms.py"
    endless.write_text(ENDLESS)
    (tmp_path / "temporary").mkdir()
    settings = {**os.environ, "PYTHONUNBUFFERED": "1", "TMPDIR": str(tmp_path / "temporary")}
    run = subprocess.Popen([sys.executable, "-m", *grade_command(tmp_path, "--seconds", "100")],
                           cwd=course, env=settings, stdout=subprocess.PIPE,
                           stderr=subprocess.PIPE, text=True, start_new_session=True)
    assert run.stdout.readline() == "submissions to read: 3\n"
    assert run.stdout.readline().startswith("isolation: process")
    if late:
        wait_until(lambda: len(list(tmp_path.glob("out/students/*/report.html"))) == 2,
                   "nobody is graded")
    {"ctrl-c": lambda: os.killpg(run.pid, signal.SIGINT),  # of a terminal: to the whole group
     "interrupt": lambda: run.send_signal(signal.SIGINT), "kill": run.kill}[stop]()
    _, told = run.communicate(timeout=60)
    if stop == "kill":
        assert run.returncode == -signal.SIGKILL
        wait_until(lambda: not processes(tmp_path / "temporary") + processes(course),
                   "what was started goes on")
        return
    assert processes(tmp_path / "temporary") + processes(course) == []
    assert list((tmp_path / "temporary").iterdir()) == []
    assert (run.returncode, told) == (130, "course: stopped; what is graded is kept: the same "
                                           "command with --resume goes on\n")
    if late:
        endless.write_text(LAB)
        done = run_module(course, *grade_command(tmp_path, "--seconds", 100, "--resume"))
        assert "submissions: 1 graded" in done.stdout and "2 were done before" in done.stdout
        assert [row["total"] for row in grades(tmp_path / "out").values()] == ["7", "6", "7"]
