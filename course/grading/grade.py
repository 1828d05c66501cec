"""Many submissions: each is examined in a process of its own, here or on a cluster."""
import concurrent.futures
import functools
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from .. import exercises
from ..given import places
from . import gradebook, sandbox, submissions
from .examine import Job
from .results import Results, Run


def run(folder, out, labs=None, jobs=None, resume=False, seed=0, isolation=None, scheduler=None,
        seconds=10.0, extra=False, book=None):
    """Grade the submissions in a folder -> 0 if every one of them could be graded, else 1.

    extra: extras count as well. That is fair where they were handed out open.
    book: what is asked for besides points, a gradebook.Asked.
    """
    topics = topics_of(labs)
    level, about = level_to_use(isolation)
    limits = sandbox.Limits(call=seconds, exercise=12 * seconds)
    columns = [exercise for topic in topics for exercise in exercises.topic_exercises(topic)
               if extra or not exercise.is_extra]
    handed_in, not_understood = submissions.read(folder, topics)
    book = gradebook.Gradebook(book or gradebook.Asked(), handed_in, columns)
    print(f"isolation: {level} ({about})", *warnings(level), *book.said(),
          *(f"not understood: {name}: {sentence}" for name, sentence in not_understood), sep="\n")

    results = Results(Path(out), Run(
        columns, level, about, seed, course_digest()[:12], tuple(not_understood)), book)
    todo = [(one, Job(one.texts, one.missing, level, seed, limits, extra)) for one in handed_in]
    if resume:
        todo = [(one, job) for one, job in todo if not results.keep(one, fingerprint(job))]
    started = time.monotonic()
    for one, job, (result, pictures) in progress(
            examined(todo, jobs or os.cpu_count(), scheduler), len(todo)):
        results.add(one, fingerprint(job), result, pictures)
    files = results.close()
    failed = [name for name, record in results.records.items() if record["problem"]]
    print(f"{len(todo)} submissions graded in {time.monotonic() - started:.1f} s, "
          f"{len(handed_in) - len(todo)} were done before, {len(failed)} could not be graded")
    print(*(f"{name}: {results.records[name]['problem']}" for name in failed), *files, sep="\n")
    return int(bool(failed))


def progress(steps, count):
    """Yield the steps, with a bar in the terminal."""
    with Progress(console=Console(stderr=True), transient=True, auto_refresh=False,
                  disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task("submissions", total=count)
        for step in steps:
            yield step
            bar.advance(task)
            bar.refresh()


def topics_of(labs):
    """'1-4', '2' or '1,3' -> topics. None: all. ValueError: there is no such lab."""
    numbers = {exercises.lab_number(topic) for topic in exercises.topics()}
    asked = list(numbers) if labs is None else []
    for part in labs.split(",") if labs else ():
        first, _, last = part.partition("-")
        try:
            asked += range(int(first), int(last or first) + 1)
        except ValueError:
            asked.append(part)
    for number in asked:
        if number not in numbers:
            raise ValueError(f"there is no lab {number}; give labs as in 1-4 or 1,3 "
                             f"({min(numbers)} to {max(numbers)} are there)")
    return [topic for topic in exercises.topics() if exercises.lab_number(topic) in asked]


def level_to_use(isolation):
    """-> (level, a sentence on it). ValueError: strict is wanted and cannot be had."""
    if isolation == "process":
        return "process", "as told by --isolation process"
    level, about = sandbox.available()
    if level != "strict":
        raise ValueError(f"submissions are not run without a sandbox, and {about}; to grade work "
                         "that you trust, give --isolation process")
    return level, about


def warnings(level):
    return ["This level is no protection against malice: what was handed in can read your files "
            "and use the network."] * (level == "process")


def fingerprint(job):
    """A hash of all that decides a result: what was handed in, the options, the course."""
    options = json.dumps([job._asdict(), course_digest()], sort_keys=True)
    return hashlib.sha256(options.encode()).hexdigest()


@functools.cache
def course_digest():
    """A hash of the checks, the reference and the grader."""
    whole = hashlib.sha256()
    for pattern in ("course/**/*.py", "reference/*.py", "tests/conftest.py", "tests/labs/*.py",
                    "tests/golden/*"):
        for path in sorted(places.ROOT.glob(pattern)):
            whole.update(path.read_bytes())
    return whole.hexdigest()


# --- examinations -----------------------------------------------------------------------------


def examined(todo, jobs, scheduler):
    """Yield (submission, job, what `examine` returns), in the order in which they end."""
    if scheduler:
        yield from on_cluster(todo, scheduler)
        return
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        running = {pool.submit(examine, job._asdict()): (one, job) for one, job in todo}
        try:
            for future in concurrent.futures.as_completed(running):
                yield *running[future], future.result()
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def on_cluster(todo, scheduler):
    try:
        import distributed
    except ImportError:
        raise ValueError("--scheduler needs Dask: pip install distributed, here and on the "
                         "cluster's machines") from None
    with distributed.Client(scheduler) as client:
        require_alike(client.run(there), todo[0][1].level if todo else None)
        futures = {client.submit(examine, job._asdict(), pure=False): (one, job)
                   for one, job in todo}
        for future, result in distributed.as_completed(futures, with_results=True):
            yield *futures[future], result


def there():
    """What a machine of the cluster must have like this one: the course, and its sandbox."""
    return course_digest(), *sandbox.available()


def require_alike(machines, level):
    """ValueError unless every machine {address: there()} can give the same marks."""
    for address, (digest, strictest, about) in machines.items():
        if digest != course_digest():
            raise ValueError(f"{address} has another course: copy this one there, and start its "
                             "Dask worker in that folder")
        if level == "strict" != strictest:
            raise ValueError(f"{address} has no sandbox: {about}")


def examine(job):
    """A job, as a dict -> (its result, {name: picture}), from a process of its own."""
    job = Job(**job)
    limits = sandbox.Limits(*job.limits)
    with tempfile.TemporaryDirectory(prefix="examine-") as folder:
        folder = Path(folder)
        (folder / "job.json").write_text(json.dumps(job._asdict()), "utf-8")
        command = [sys.executable, "-m", "course.grading.examine", str(folder)]
        settings = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        try:
            done = subprocess.run(command, cwd=places.ROOT, env=settings, capture_output=True,
                                  timeout=limits.submission + 300)
            result = json.loads((folder / "result.json").read_bytes())
        except subprocess.TimeoutExpired:
            return failure("the checks themselves took too long"), {}
        except (OSError, ValueError):
            said = done.stderr.decode("utf-8", "replace").strip().splitlines()
            return failure(f"the checks broke off: {said[-1] if said else done.returncode}"), {}
        return result, {path.name: path.read_bytes() for path in folder.glob("checks/*.png")}


def failure(problem):
    return {"board": None, "lost": {}, "problem": problem, "seconds": 0.0}
