"""Examinations, each in a process of its own: here, or on the machines of a Dask cluster.

However this process ends, examinations here end, too: they wait for the end of a pipe.
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

from ...given import places
from . import sandbox, typed_json
from .jobs import Job, Result, failure

DECIDE = ("course/**/*.py", "reference/*.py", "tests/conftest.py", "tests/labs/*.py",
          "tests/golden/*")
PATIENCE = 30  # seconds for a cluster's scheduler and its first worker to answer


@functools.cache
def course_digest() -> str:
    """A hash of the checks, the reference and the grader."""
    whole = hashlib.sha256()
    for pattern in DECIDE:
        for path in sorted(places.ROOT.glob(pattern)):
            whole.update(path.read_bytes())
    return whole.hexdigest()


def examined(todo, jobs, scheduler) -> Iterator:
    """Yield (submission, job, what `examine` returns), in the order in which they end."""
    if scheduler:
        yield from on_cluster(todo, scheduler)
        return
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


def examine(job: Job, line=None) -> tuple[Result, dict]:
    """A job -> (its result, {name: picture}), from a process of its own."""
    if line is None:
        with lifeline() as line:
            return examine(job, line)
    with tempfile.TemporaryDirectory(prefix="examine-") as folder:
        folder = Path(folder)
        (folder / "job.json").write_text(typed_json.dumps(job), "utf-8")
        command = [sys.executable, "-m", "course.grading.apart.examine", str(folder)]
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


# --- a cluster --------------------------------------------------------------------------------


def on_cluster(todo, scheduler):
    """`examined`, by the workers of a Dask scheduler. ValueError: it cannot give the same marks."""
    try:
        import distributed
    except ImportError:
        raise ValueError("--scheduler needs Dask: pip install distributed, here and on the "
                         "cluster's machines") from None
    with connected(distributed, scheduler) as client:
        there = at_the_worker()
        require_alike(client.run(there, "what_is_here"), todo[0][1].level if todo else None)
        futures = {client.submit(there, "examine_alike", course_digest(),
                                 typed_json.dumps(job), pure=False): (one, job)
                   for one, job in todo}
        # A future that is kept keeps its result on that machine: lost with it, and made again.
        for future in distributed.as_completed([*futures]):
            yield *futures.pop(future), outcome(future)


def connected(distributed, scheduler):
    """A client of the scheduler, which has workers. ValueError: it has none, or is not there."""
    try:
        client = distributed.Client(scheduler, timeout=PATIENCE)
    except (OSError, ValueError) as error:
        raise ValueError(f"no Dask scheduler answers at {scheduler} ({error}): start one with dask "
                         "scheduler, and give its address, as in tcp://host:8786") from None
    try:
        client.wait_for_workers(1, PATIENCE)
    except TimeoutError:
        client.close()
        raise ValueError(f"the scheduler at {scheduler} has no workers: start some in copies of "
                         f"this course, in its folder: dask worker {scheduler}") from None
    return client


def at_the_worker():
    """-> the function that calls one of this module's, by its name, in a worker of the cluster.

    It is sent as it is, because a worker finds the course only in the folder that it started in.
    """
    def call(name, *given):
        import importlib
        import os
        import sys
        if os.getcwd() not in sys.path:
            sys.path.insert(0, os.getcwd())
        try:
            module = importlib.import_module("course.grading.apart.running")
        except ImportError:
            return None
        return getattr(module, name)(*given)

    return call


def what_is_here():
    """What a machine of the cluster must have like this one: the course, and its sandbox."""
    return course_digest(), *sandbox.available()


def require_alike(machines, level):
    """ValueError unless every machine {address: what_is_here()} can give the same marks."""
    for address, here in machines.items():
        if here is None or here[0] != course_digest():
            raise ValueError(f"{address} has {'another' if here else 'no'} course: copy this one "
                             "there, and start its Dask worker in that folder")
        _, strictest, about = here
        if level == "strict" != strictest:
            raise ValueError(f"{address} has no sandbox: {about}")


def examine_alike(digest, job):
    """`examine` a job, as JSON, on a machine that may have come when others were at work."""
    if course_digest() != digest:
        return failure("a machine of the cluster has another course"), {}
    return examine(typed_json.loads(Job, job))
