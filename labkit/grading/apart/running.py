"""Examinations, each in a process of its own.

However this process ends, examinations end, too: they wait for the end of a pipe.
"""
import concurrent.futures
import contextlib
import functools
import hashlib
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from ... import places
from ...table import COMPLETE, USED, WITH_LABS
from . import typed_json
from .jobs import Job, Result, failure

DECIDE = ("labs.toml", "labkit/*.py", "labkit/checks/*.py", "labkit/grading/**/*.py",
          "labkit/upkeep/*.py", "reference/*.py", "conftest.py", "tests/labs/*.py",
          f"{COMPLETE}/*.py", *USED, *WITH_LABS.values())


@functools.cache
def course_digest() -> str:
    """A hash of the checks, the reference and the grader."""
    whole = hashlib.sha256()
    for pattern in DECIDE:
        for path in sorted(places.ROOT.glob(pattern)):
            whole.update(path.read_bytes())
    return whole.hexdigest()


def examined(todo, jobs) -> Iterator:
    """Yield (submission, job, what `examine` returns), in the order in which they end."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool, lifeline() as line:
        running = {pool.submit(examine, job, line): (one, job) for one, job in todo}
        try:
            for future in concurrent.futures.as_completed(running):
                yield *running[future], outcome(future)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


@contextlib.contextmanager
def lifeline():
    """The end of a pipe to read from. Nothing comes but its end: with this block or process."""
    reading, writing = os.pipe()
    with open(reading, "rb") as line:
        try:
            yield line
        finally:
            os.close(writing)


def examine(job: Job, line) -> tuple[Result, dict]:
    """A job -> (its result, {name: picture}), from a process of its own."""
    with tempfile.TemporaryDirectory(prefix="examine-") as folder:
        folder = Path(folder)
        (folder / "job.json").write_text(typed_json.dumps(job), "utf-8")
        command = [sys.executable, "-m", "labkit.grading.apart.examine", str(folder)]
        settings = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        try:  # in a session of its own: Ctrl-C reaches this process alone, which ends the line
            done = subprocess.run(command, cwd=places.ROOT, env=settings, capture_output=True,
                                  stdin=line, start_new_session=True,
                                  timeout=job.limits.submission + 300)
        except subprocess.TimeoutExpired:
            return failure("the checks themselves took too long"), {}
        try:
            result = typed_json.loads(Result, (folder / "result.json").read_bytes())
        except (OSError, ValueError):
            return failure(why_there_is_none(done)), {}
        return result, {path.name: path.read_bytes() for path in folder.glob("checks/*.png")}


def why_there_is_none(done):
    """A sentence on an examination that ended without a result."""
    if done.returncode == -getattr(signal, "SIGVTALRM", 0):  # see alarm.or_ended
        return "what it returned keeps a check busy that cannot be stopped"
    said = done.stderr.decode("utf-8", "replace").strip().splitlines()
    return f"the checks broke off: {said[-1] if said else done.returncode}"


def outcome(future):
    """What `examine` returned. Whatever went wrong is this submission's alone."""
    try:
        return future.result()
    except Exception as error:
        return failure(f"the examination broke off: {type(error).__name__}: {error}"), {}
