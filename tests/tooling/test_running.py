"""How a class is graded: many at a time, stopped in the middle, on other machines."""
import contextlib
import importlib.util
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from small_course import CHECKS, LAB, first_lab, grade_command, grades, hand_in

from course.given import places
from course.grading.apart import running

ENDLESS = LAB.replace("return x / 2, x > 0", "while True: x")


@pytest.fixture(scope="module")
def course(house):
    return house(first_lab())


@pytest.fixture
def handed_in(tmp_path):
    """The folder of two students: ada is right, bob is wrong."""
    hand_in(tmp_path, ada=LAB, bob=LAB.replace("2 * x", "3 * x"))
    return tmp_path / "in"


def marks(out):
    columns = "1.1 double", "1.2 quadruple", "1.3 split", "hash", "total"
    return [[row[column] for column in columns] for row in grades(out).values()]


def processes(course):
    """The command lines of all processes that have to do with this copy of the course."""
    lines = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):  # it has ended
            lines.append(path.read_bytes().replace(b"\0", b" ").decode())
    return [line for line in lines if str(course) in line]


def wait_until(condition, why):
    patience = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < patience, why
        time.sleep(0.02)


@pytest.mark.skipif(sys.platform == "win32", reason="there is no such timer")
def test_a_step_of_a_check_that_takes_minutes_is_ended(house, run_module, tmp_path):
    """A product of large matrices waits for no alarm: one line keeps a processor for 5 minutes."""
    alarm = (places.ROOT / "course" / "checks" / "alarm.py").read_text("utf-8")
    course = house(first_lab(checks=CHECKS.replace(
        "impl.double(x), expected", "(y := impl.double(x)) @ y.T, 4 * x @ x")) | {
            "course/checks/alarm.py": alarm.replace("OURS = 20.0", "OURS = 0.5")})
    hand_in(tmp_path, ada=LAB, bob="import numpy as np\n" + LAB.replace(
        "2 * x", "np.zeros((50_000, 320), bool)"))
    done = run_module(course, *grade_command(tmp_path), seconds=60)
    assert "\nbob: what it returned keeps a check busy that cannot be stopped" in done.stdout
    assert grades(tmp_path / "out")["ada"]["total"] == "7"


@pytest.mark.skipif(sys.platform != "linux", reason="processes are looked up in /proc")
@pytest.mark.parametrize("late", [False, True])
@pytest.mark.parametrize("stop", ["ctrl-c", "interrupt", "kill"])
def test_a_run_that_is_stopped_ends_all_that_it_started(
        late, stop, course, handed_in, run_module, tmp_path):
    """A traceback, a worker that runs for ever, or a wait for the slowest; ada is graded again."""
    endless = handed_in / "eve_transforms.py"
    endless.write_text(ENDLESS)
    (tmp_path / "temporary").mkdir()
    settings = {**os.environ, "PYTHONUNBUFFERED": "1", "TMPDIR": str(tmp_path / "temporary")}
    run = subprocess.Popen([sys.executable, "-m", *grade_command(tmp_path, "--seconds", "100")],
                           cwd=course, env=settings, stdout=subprocess.PIPE,
                           stderr=subprocess.PIPE, text=True, start_new_session=True)
    assert run.stdout.readline() == "reading 3 submissions\n"
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
        assert "1 submissions graded" in done.stdout and "2 were done before" in done.stdout
        assert [row[-1] for row in marks(tmp_path / "out")] == ["7", "6", "7"]


# --- a cluster --------------------------------------------------------------------------------


@pytest.fixture
def start(tmp_path):
    """start(folder, "scheduler", ...) -> the running process of dask scheduler in that folder."""
    begun = []

    def begin(folder, *options):
        settings = {name: text for name, text in os.environ.items() if name != "PYTHONPATH"}
        with open(tmp_path / "dask.txt", "a") as said:
            begun.append(subprocess.Popen(
                [Path(sys.executable).with_name("dask"), *options, "--no-dashboard"], cwd=folder,
                env=settings, stdout=said, stderr=said))

    yield begin
    for process in reversed(begun):
        process.terminate()
        process.wait(60)


@pytest.fixture
def scheduler(start, tmp_path):
    """The address of a scheduler that has no workers yet."""
    start(tmp_path, "scheduler", "--host", "127.0.0.1", "--port", "0")
    found = []
    wait_until(lambda: found.extend(re.findall(
        r"Scheduler at: *(\S+)", (tmp_path / "dask.txt").read_text())) or found,
        "the scheduler does not start")
    return found[0]


needs_dask = pytest.mark.skipif(not importlib.util.find_spec("distributed"),
                                reason="Dask is not installed")


@needs_dask
def test_a_cluster_gives_the_same_marks(course, handed_in, run_module, start, scheduler, tmp_path):
    """Workers that were started in the course's folder do not find it, or mark otherwise."""
    done = run_module(course, *grade_command(tmp_path))
    assert done.returncode == 0, done.stderr
    here = marks(tmp_path / "out")
    start(course, "worker", scheduler, "--nworkers", "2", "--nthreads", "1")
    done = run_module(course, *grade_command(tmp_path, "--scheduler", scheduler))
    assert done.returncode == 0, done.stderr
    assert marks(tmp_path / "out") == here and [row[-1] for row in here] == ["7", "6"]


@needs_dask
@pytest.mark.parametrize("their", ["no", "another"])
def test_workers_without_this_course_are_refused(
        their, course, house, handed_in, run_module, start, scheduler, tmp_path):
    """A traceback of Dask's, or half of a class is graded by last year's checks."""
    other = house(first_lab(checks=CHECKS + "#"))
    start(other if their == "another" else tmp_path, "worker", scheduler, "--nthreads", "1")
    done = run_module(course, *grade_command(tmp_path, "--scheduler", scheduler))
    assert done.returncode == 2 and f"has {their} course: copy this one" in done.stderr
    assert done.stderr.count("\n") == 1 and not (tmp_path / "out" / "grades.csv").exists()


@needs_dask
@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "here", "http://here:8786"])
def test_a_scheduler_that_is_not_there_is_told_in_one_sentence(
        address, course, handed_in, tmp_path, monkeypatch):
    """A traceback of Dask's."""
    monkeypatch.setattr(running, "PATIENCE", 1)
    with pytest.raises(ValueError, match=f"no Dask scheduler answers at {address} .*: start one"):
        next(running.examined([], 1, address))


@needs_dask
def test_a_scheduler_without_workers_is_told_in_one_sentence(scheduler, monkeypatch):
    """The run waits for ever."""
    monkeypatch.setattr(running, "PATIENCE", 1)
    with pytest.raises(ValueError, match="has no workers: start some"):
        next(running.examined([], 1, scheduler))


@pytest.mark.parametrize(("about", "sentence"), [
    (("0", "strict", ""), "another course"), (None, "no course"),
    ((running.course_digest(), "process", "install"), "no sandbox: install")])
def test_a_cluster_with_another_course_is_refused(about, sentence):
    """Half of a class is graded by last year's checks."""
    alike = {"tcp://a": (running.course_digest(), "strict", "")}
    running.require_alike(alike, "strict")
    with pytest.raises(ValueError, match=f"tcp://b has {sentence}"):
        running.require_alike(alike | {"tcp://b": about}, "strict")


def test_a_machine_that_comes_late_with_another_course_gives_no_marks():
    """Those that were there at first are alike, and the next one has last year's checks."""
    result, _ = running.examine_alike("another digest", "{}")
    assert result.problem == "a machine of the cluster has another course"
