"""A class's submissions: what is asked for, and in which order it is done."""
import contextlib
import hashlib
import json
import os
import sys
import time
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from .. import exercises
from ..given import places
from . import archives, earlier, gradebook, lateness, report, running, sandbox, submissions
from .examine import Job
from .results import Results, Run


def run(folder, out, labs=None, jobs=None, resume=False, seed=0, isolation=None, scheduler=None,
        seconds=10.0, extra=False, book=None):
    """Grade the submissions in a folder -> 0 if every one of them could be graded, else 1.

    extra: extras count as well. That is fair where they were handed out open.
    book: what is asked for besides points, a gradebook.Asked.
    """
    topics = exercises.topics_of(labs)
    require_whole(topics)
    limits = limits_of(seconds)
    level, about = level_to_use(isolation)
    columns = [exercise for topic in topics for exercise in exercises.topic_exercises(topic)
               if extra or not exercise.is_extra]
    book = book or gradebook.Asked()
    handed_in, not_understood = submissions.read(folder, topics, lateness.zone(book.due))
    before = earlier.records(Path(out), handed_in, columns)
    everybody = [*handed_in, *map(earlier.submission, before)]
    book = gradebook.Gradebook(book, everybody, columns)
    results = Results(made(out), book, Run(columns, level, about, seed, running.course_digest(),
                                           tuple(not_understood)))
    print(f"isolation: {level} ({about})", *warnings(level), *book.said(),
          *(f"not understood: {name}: {sentence}" for name, sentence in not_understood), sep="\n")

    todo = [(one, Job(one.texts, one.missing, level, own_seed(seed, one.texts), limits, extra))
            for one in handed_in]
    if resume:
        todo = [(one, job) for one, job in todo if not results.keep(one.student, fingerprint(job))]
    for record in before:
        results.take(record)
    started = time.monotonic()
    asks = rehearsed(topics, level, limits, extra, jobs, scheduler) if todo else {}
    todo = [(one, job._replace(asks=asks)) for one, job in todo]
    with contextlib.closing(running.examined(todo, jobs or os.cpu_count(), scheduler)) as steps:
        for one, job, (result, pictures) in progress(steps, len(todo)):
            results.add(one, job.seed, fingerprint(job), result, pictures)
    files = results.close()
    failed = [one.student for one in handed_in if results.records[one.student]["problem"]]
    print(f"{len(todo)} submissions graded in {time.monotonic() - started:.1f} s, "
          f"{len(handed_in) - len(todo)} were done before, {len(failed)} could not be graded"
          + f"; {len(before)} more of earlier runs stay in the tables" * bool(before))
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
    texts = [(topic, exercises.read(exercises.reference(topic))) for topic in topics]
    jobs = jobs or os.cpu_count()
    todo = [(None, Job(dict(texts[k::jobs]), {}, level, limits=limits, extra=extra))
            for k in range(min(jobs, len(texts)))]
    asks = {}
    with contextlib.closing(running.examined(todo, jobs, scheduler)) as steps:
        for _, _, (result, _) in steps:
            if wrong := result["problem"] or report.first_wrong(result["board"]):
                raise ValueError("nothing was graded, for the reference itself does not pass "
                                 f"here: {wrong}")
            asks |= result["asked"]
    return asks


def fingerprint(job):
    """A hash of all that decides a result: what was handed in, the options, the course."""
    options = json.dumps([job._replace(asks=None)._asdict(), running.course_digest()],
                         sort_keys=True)
    return hashlib.sha256(options.encode()).hexdigest()
