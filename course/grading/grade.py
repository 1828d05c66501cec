"""Many submissions: each is examined in a process of its own, here or on a cluster.

    DIR/students/ada/   report.html, results.json (Gradescope's format), record.json (for --resume)
    DIR/grades.csv      points for each exercise
    DIR/index.html      the overview
"""
import contextlib
import csv
import hashlib
import io
import json
import os
import re
import sys
import time
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from .. import exercises
from ..given import places
from . import report, running, sandbox, submissions
from .examine import Job


def run(folder, out, labs=None, jobs=None, resume=False, seed=0, isolation=None, scheduler=None,
        seconds=10.0, extra=False):
    """Grade the submissions in a folder -> 0 if every one of them could be graded, else 1.

    extra: extras count as well. That is fair where they were handed out open.
    """
    topics = topics_of(labs)
    require_whole(topics)
    limits = limits_of(seconds)
    level, about = level_to_use(isolation)
    columns = [exercise for topic in topics for exercise in exercises.topic_exercises(topic)
               if extra or not exercise.is_extra]
    handed_in = submissions.read(folder, topics)
    out = made(out)
    print(f"isolation: {level} ({about})", *warnings(level), sep="\n")

    records, todo = {}, []
    for one in handed_in:
        job = Job(one.texts, one.missing, level, seed, limits, extra)
        folder_of_one = out / "students" / one.student
        if resume and (done := done_before(folder_of_one, fingerprint(job))):
            records[one.student] = done
        else:
            todo.append((one, job))
    started = time.monotonic()
    finish = finisher(out, topics, level, about, seed)
    with Progress(console=Console(stderr=True), transient=True, auto_refresh=False,
                  disable=not sys.stderr.isatty()) as progress, contextlib.closing(
            running.examined(todo, jobs or os.cpu_count(), scheduler)) as results:
        task = progress.add_task("submissions", total=len(todo))
        for one, job, (result, pictures) in results:
            records[one.student] = finish(one, fingerprint(job), result, pictures)
            write_tables(out, records, columns, level, about)
            progress.advance(task)
            progress.refresh()
    write_tables(out, records, columns, level, about)
    failed = [name for name, record in records.items() if record["problem"]]
    print(f"{len(todo)} submissions graded in {time.monotonic() - started:.1f} s, "
          f"{len(records) - len(todo)} were done before, {len(failed)} could not be graded")
    for name in failed:
        print(f"{name}: {records[name]['problem']}")
    print(f"{out / 'grades.csv'}\n{out / 'index.html'}")
    return int(bool(failed))


def topics_of(labs):
    """'1-4', '2' or '1,3' -> topics. None: all. ValueError: there is no such lab."""
    there = {exercises.lab_number(topic) for topic in exercises.topics()}
    asked = there if labs is None else {
        number for part in labs.split(",") for number in labs_in(part, there)}
    return [topic for topic in exercises.topics() if exercises.lab_number(topic) in asked]


def labs_in(part, there):
    """'2' or '1-4' -> the numbers. ValueError unless all of them are there, and one at least."""
    form = re.fullmatch(r" *(\d{1,3})(?:-(\d{1,3}))? *", part)
    numbers = range(int(form[1]), int(form[2] or form[1]) + 1) if form else ()
    if not numbers or not there.issuperset(numbers):
        raise ValueError(f'there is no lab "{part}"; give labs as in 1-4 or 1,3 '
                         f"({min(there)} to {max(there)} are there)")
    return numbers


def require_whole(topics):
    """ValueError unless this copy of the course has what decides marks.

    Without the reference or the checks, nobody gets a point.
    """
    needed = [exercises.reference(topic) for topic in exercises.topics()]
    needed += [places.ROOT / "tests" / "labs" / f"test_{topic}.py" for topic in topics
               if exercises.topic_exercises(topic)]
    for path in needed:
        if not path.exists():
            raise ValueError(f"{places.shown_path(path)} is not in this copy of the course, and "
                             "without it there are no marks: grade in a whole copy")


def limits_of(seconds):
    """The most seconds of a call -> Limits. An exercise has 12 times that, and a submission more.

    ValueError: no call can be made in that time, or a submission's time does not suffice.
    """
    most = sandbox.Limits().submission / 12
    if not 1 <= seconds <= most:
        raise ValueError(f"--seconds is the most that a call may take: give 1 to {most:g}, "
                         f"not {seconds:g}")
    return sandbox.Limits(call=seconds, exercise=12 * seconds)


def made(out):
    """The folder for results, made where it is not there. OSError, in one sentence."""
    students = Path(out) / "students"
    try:
        students.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OSError(f"cannot write to {out} ({error.strerror}): name in --out a folder that you "
                      "may write to") from None
    return students.parent


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
    options = json.dumps([job._asdict(), running.course_digest()], sort_keys=True)
    return hashlib.sha256(options.encode()).hexdigest()


def done_before(folder, wanted):
    """The record of an earlier run, if it is of the same submission, checks and options."""
    try:
        record = json.loads((folder / "record.json").read_bytes())
    except (OSError, ValueError):
        return None
    return record if record["fingerprint"] == wanted and not record["problem"] else None


# --- what is written --------------------------------------------------------------------------


def finisher(out, topics, level, about, seed):
    """-> the function that writes what belongs to one student, and returns the record of it."""
    def finish(one, mark, result, pictures):
        folder = out / "students" / one.student
        folder.mkdir(parents=True, exist_ok=True)
        record = {"student": one.student, "fingerprint": mark, "level": level,
                  "digest": submissions.digest(one.texts), "notes": one.notes, **result}
        if not result["problem"]:
            page = report.page(record, pictures, about, seed)
            places.write_whole(folder / "report.html", page.encode("utf-8"))
            gradescope = json.dumps(report.gradescope(record, about), indent=2)
            places.write_whole(folder / "results.json", gradescope.encode("utf-8"))
        places.write_whole(folder / "record.json", json.dumps(record).encode("utf-8"))
        return record

    return finish


def write_tables(out, records, columns, level, about):
    """grades.csv and index.html. columns: the exercises that count."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    names = (f"{exercise.number} {exercise.name}" for exercise in columns)
    table.writerow(["student", *names, "total", "of", "fine print open",
                    "isolation", "seconds", "hash", "problem"])
    for name in sorted(records):
        record = records[name]
        got = report.points(record)
        table.writerow([name, *(got.get(exercise.number, "") for exercise in columns),
                        sum(got.values()) if got else "", sum(e.points for e in columns),
                        " ".join(report.open_fine_print(record)),
                        record["level"], f"{record['seconds']:.1f}", record["digest"],
                        record["problem"] or ""])
    out.mkdir(parents=True, exist_ok=True)
    places.write_whole(out / "grades.csv", text.getvalue().encode("utf-8"))
    page = report.overview([records[name] for name in sorted(records)], columns, level, about)
    places.write_whole(out / "index.html", page.encode("utf-8"))
