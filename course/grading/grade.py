"""Many submissions: each is examined in a process of its own, here or on a cluster.

    DIR/students/ada/   report.html, results.json (Gradescope's format), record.json (for --resume)
    DIR/grades.csv      points for each exercise
    DIR/index.html      the overview
"""
import concurrent.futures
import csv
import functools
import hashlib
import io
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
from . import archives, report, sandbox, submissions
from .examine import Job


def run(folder, out, labs=None, jobs=None, resume=False, seed=0, isolation=None, scheduler=None,
        seconds=10.0, extra=False):
    """Grade the submissions in a folder -> 0 if every one of them could be graded, else 1.

    extra: extras count as well. That is fair where they were handed out open.
    """
    topics = topics_of(labs)
    level, about = level_to_use(isolation)
    limits = sandbox.Limits(call=seconds, exercise=12 * seconds)
    columns = [exercise for topic in topics for exercise in exercises.topic_exercises(topic)
               if extra or not exercise.is_extra]
    handed_in, not_understood = submissions.read(folder, topics)
    out = Path(out)
    records = earlier(out, handed_in, columns)
    print(f"isolation: {level} ({about})", *warnings(level), sep="\n")
    for name, sentence in not_understood:
        print(f"not understood: {name}: {sentence}")

    stay, todo = len(records), []
    for one in handed_in:
        job = Job(one.texts, one.missing, level, own_seed(seed, one.texts), limits, extra)
        folder_of_one = out / "students" / one.student
        if resume and (done := done_before(folder_of_one, fingerprint(job))):
            records[one.student] = done | told(one)
        else:
            todo.append((one, job))
    started = time.monotonic()
    if todo:
        asks = rehearsed(topics, level, limits, extra, jobs, scheduler)
        todo = [(one, job._replace(asks=asks)) for one, job in todo]
    finish = finisher(out, about)
    with Progress(console=Console(stderr=True), transient=True, auto_refresh=False,
                  disable=not sys.stderr.isatty()) as progress:
        task = progress.add_task("submissions", total=len(todo))
        for one, job, (result, pictures) in examined(todo, jobs or os.cpu_count(), scheduler):
            records[one.student] = finish(one, job, result, pictures)
            write_tables(out, records, columns, level, about, not_understood)
            progress.advance(task)
            progress.refresh()
    write_tables(out, records, columns, level, about, not_understood)
    failed = [one.student for one in handed_in if records[one.student]["problem"]]
    print(f"{len(todo)} submissions graded in {time.monotonic() - started:.1f} s, "
          f"{len(handed_in) - len(todo)} were done before, {len(failed)} could not be graded"
          + f"; {stay} more of earlier runs stay in the tables" * bool(stay))
    for name in failed:
        print(f"{name}: {records[name]['problem']}")
    print(f"{out / 'grades.csv'}\n{out / 'index.html'}")
    return int(bool(failed))


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


def own_seed(seed, texts):
    """The seed of a submission, from the run's seed and its hash: nobody can know it before.

    A table of right answers is part of the submission, so it changes the seed that it is for.
    """
    told = f"{seed} {archives.digest(texts)}"
    return int.from_bytes(hashlib.sha256(told.encode()).digest()[:4], "big") >> 1


def rehearsed(topics, level, limits, extra, jobs, scheduler=None):
    """What each exercise of the reference asks of others: Job.asks, found by grading it.

    ValueError: the reference itself does not earn all points here, so nothing else is graded.
    """
    todo = [(topic, Job({topic: exercises.read(exercises.reference(topic))}, {}, level,
                        limits=limits, extra=extra)) for topic in topics]
    asks = {}
    for topic, _, (result, _) in examined(todo, jobs or os.cpu_count(), scheduler):
        if wrong := result["problem"] or report.first_wrong(result["board"]):
            raise ValueError(f"nothing was graded, for the reference itself does not pass here: "
                             f"{topic}: {wrong}")
        asks |= result["asked"]
    return asks


def fingerprint(job):
    """A hash of all that decides a result: what was handed in, the options, the course."""
    options = json.dumps([job._replace(asks=None)._asdict(), course_digest()], sort_keys=True)
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


def done_before(folder, wanted):
    """The record of an earlier run, if it is of the same submission, checks and options."""
    record = read_record(folder / "record.json")
    return record if record.get("fingerprint") == wanted and not record["problem"] else None


def earlier(out, handed_in, columns):
    """{student: record} of earlier runs into the same folder: those who are not graded now.

    ValueError: they would not fit into the same table, or a folder is another student's.
    """
    now = {one.student.casefold(): one for one in handed_in}
    records = {}
    for path in sorted(out.glob("students/*/record.json")):
        record, one = read_record(path), now.get(path.parent.name.casefold())
        if one is None and not fits(record, columns):
            raise ValueError(f"{out} holds grades of {path.parent.name} for other labs, or of "
                             "another version of the course: name another folder with --out")
        if one is None:
            records[record["student"]] = record
        elif are_two(record.get("identity", one.identity), one.identity):
            raise ValueError(f"{path.parent} holds grades of another student, whose name is almost "
                             "the same: name another folder with --out")
    return records


def read_record(path):
    """What an earlier run wrote, {} where it cannot be read."""
    try:
        return dict(json.loads(path.read_bytes()))
    except (OSError, TypeError, ValueError):
        return {}


def fits(record, columns):
    """Whether a record has what the tables show."""
    if not record.keys() >= {"student", "identity", "level", "digest", "problem", "board", "notes"}:
        return False
    numbers = {exercise.number for exercise in columns}
    return not record["board"] or numbers == {entry["number"]
                                              for entry in record["board"]["exercises"]}


def are_two(before, now):
    """Whether names that were handed in by hand are of two people."""
    return before["platform"] == now["platform"] == "" and before["name"] != now["name"]


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
                yield *running[future], outcome(future)
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
        for future in distributed.as_completed(futures):
            yield *futures[future], outcome(future)


def outcome(future):
    """What `examine` returned. Whatever went wrong is this submission's alone."""
    try:
        return future.result()
    except Exception as error:
        return failure(f"the examination broke off: {type(error).__name__}: {error}"), {}


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
        except subprocess.TimeoutExpired:
            return failure("the checks themselves took too long"), {}
        try:
            result = json.loads((folder / "result.json").read_bytes())
        except (OSError, ValueError):
            said = done.stderr.decode("utf-8", "replace").strip().splitlines()
            return failure(f"the checks broke off: {said[-1] if said else done.returncode}"), {}
        return result, {path.name: path.read_bytes() for path in folder.glob("checks/*.png")}


def failure(problem):
    return {"board": None, "lost": {}, "missing": {}, "asked": {}, "problem": problem,
            "seconds": 0.0}


# --- what is written --------------------------------------------------------------------------


def finisher(out, about):
    """-> the function that writes what belongs to one student, and returns the record of it."""
    def finish(one, job, result, pictures):
        record = {**told(one), "fingerprint": fingerprint(job), "level": job.level,
                  "digest": archives.digest(one.texts), "seed": job.seed, **result}
        try:
            write(record, pictures)
        except Exception as error:  # one student's trouble is no other's
            record["problem"] = f"its results cannot be written: {error}"
        return record

    def write(record, pictures):
        folder = out / "students" / record["student"]
        folder.mkdir(parents=True, exist_ok=True)
        if not record["problem"]:
            page = report.page(record, pictures, about)
            places.write_whole(folder / "report.html", page.encode("utf-8"))
            gradescope = json.dumps(report.gradescope(record, about), indent=2)
            places.write_whole(folder / "results.json", gradescope.encode("utf-8"))
        places.write_whole(folder / "record.json", json.dumps(record).encode("utf-8"))

    return finish


def told(one):
    """What a record has of a submission: all but the labs."""
    return {name: getattr(one, name) for name in ("student", "identity", "handed_in", "late",
                                                  "notes")}


def no_formula(text):
    """A cell that begins with a student's file name, as a spreadsheet shows it."""
    return f"'{text}" if text.startswith(("=", "+", "-", "@")) else text


def write_tables(out, records, columns, level, about, not_understood):
    """grades.csv and index.html. columns: the exercises that count."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    names = (f"{exercise.number} {exercise.name}" for exercise in columns)
    table.writerow(["student", *names, "total", "of", "fine print open",
                    "isolation", "seconds", "hash", "seed", "problem", "notes"])
    for name in sorted(records):
        record = records[name]
        got = report.points(record)
        table.writerow([name, *(got.get(exercise.number, "") for exercise in columns),
                        sum(got.values()) if got else "", sum(e.points for e in columns),
                        " ".join(report.open_fine_print(record)),
                        record["level"], f"{record['seconds']:.1f}", record["digest"],
                        record["seed"], record["problem"] or "",
                        no_formula("; ".join(record["notes"]))])
    out.mkdir(parents=True, exist_ok=True)
    places.write_whole(out / "grades.csv", text.getvalue().encode("utf-8"))
    page = report.overview([records[name] for name in sorted(records)], columns, level, about,
                           not_understood)
    places.write_whole(out / "index.html", page.encode("utf-8"))
