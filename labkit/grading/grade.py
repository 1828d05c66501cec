"""A class's submissions: what is asked for, and in which order it is done."""
import contextlib
import functools
import hashlib
import os
import sys
import time
from pathlib import Path

from rich.console import Console
from rich.progress import track

from .. import exercises, places, tasks
from .apart import running, sandbox, typed_json
from .apart.jobs import SETS, Job, failure
from .gradebook import earlier, lateness, people
from .gradebook.book import Gradebook
from .handing import contents, submissions
from .request import Request, recalled, remember
from .results import Results, Run


def run(request: Request) -> int:
    """Grade the submissions in a folder -> 0 if every one of them could be graded, else 1."""
    request, said = recalled(request)
    if said:
        print(said, flush=True)
    topics, columns = asked_for(request)
    limits = task_limits(request.task) if request.task else limits_of(request.seconds)
    level, about = level_to_use(request.isolation)
    seed_of = functools.partial(own_seed, None if request.task else request.seed)
    task = request.task and task_seeds(request.seed)
    kept, lost = earlier.works(Path(request.out), topics, seed_of)
    handed_in, persons, not_understood = read(request, topics, kept, lost)
    before, gone = earlier.records(Path(request.out), handed_in, columns)
    works = [*handed_in, *(record.work for record in before)]
    book = Gradebook(request, works, columns, persons)
    results = Results(made(request.out), book, Run(
        columns, level, about, running.course_digest(), not_understood))
    results.forget(gone)
    todo = [(one, Job(one.texts, one.missing, level, seed_of(one.texts), limits,
                      bool(request.extra), None, task)) for each in handed_in
            for one in book.counting(each, kept.get(each.student), request.count)]
    return grade_all(request, topics, todo, before, results)


def asked_for(request):
    """-> (topics, the exercises that count). ValueError: something that decides marks is missing.
    """
    if request.task:
        return [request.task], [tasks.column(request.task)]
    topics = exercises.topics_of(request.labs)
    require_whole(topics)
    return topics, [exercise for topic in topics for exercise in exercises.topic_exercises(topic)
                    if exercise.points and (request.extra or not exercise.is_extra)]


def read(request, topics, kept, lost):
    """-> (submissions, one for each student; lines of people.csv; what was not understood).

    kept, lost: of earlier.works. They are all that there is where no folder was handed in.
    """
    persons = (people.read(request.people, lateness.policy(request.due).zone)
               if request.people else [])
    if request.submissions is None and (lost or not kept):
        raise ValueError(f"{request.out} does not keep what was handed in"
                         f"{' by ' * bool(lost)}{', '.join(lost)}, as the tables show it: name the "
                         "folder with the submissions")
    handed_in, not_understood = (submissions.read(request.submissions, topics)
                                 if request.submissions else (list(kept.values()), []))
    return people.with_members(handed_in, persons), persons, not_understood


def said_before(results):
    """What an instructor reads at the start."""
    run = results.run
    yield f"isolation: {run.level} ({run.about})"
    if run.level == "process":
        yield ("This level is no protection against malice: what was handed in can read your "
               "files and use the network.")
    yield from results.book.said()
    yield from (f"not understood: {name}: {sentence}" for name, sentence in run.not_understood)


def grade_all(request, topics, todo, before, results):
    """Examine what is to be done, keep the rest, write all results -> the exit status."""
    students, started = list(dict.fromkeys(one.student for one, _ in todo)), time.monotonic()
    print(*said_before(results), sep="\n")
    if request.resume:
        todo = [(one, job) for one, job in todo if not results.keep(one, fingerprint(job))]
    for record in before:
        results.take(record, record.work)
    if todo:
        asks = rehearsed(topics, todo[0][1], request.jobs)
        todo = [(one, job._replace(asks=asks)) for one, job in todo]
    remember(request)
    files = examine(request, todo, results)
    failed = {name: problem for name in students
              if (problem := results.records[name].result.problem)}
    graded = len({one.student for one, _ in todo})
    print(f"submissions: {graded} graded in {time.monotonic() - started:.1f} s, "
          f"{len(students) - graded} were done before, {len(failed)} could not be graded"
          + f"; {len(before)} more of earlier runs stay in the tables" * bool(before))
    print(*results.said_of_checks(), *(f"{name}: {problem}" for name, problem in failed.items()),
          *results.changed(), *files, sep="\n")
    return int(bool(failed))


def examine(request, todo, results):
    """Examine [(submission, its job)], write each result when it is there -> all tables' paths."""
    for one, job in todo:
        if one.problem:
            results.add(one, job.seed, "", failure(one.problem), {})
    works = together([(one, job) for one, job in todo if not one.problem])
    examined = running.examined(works, request.jobs or os.cpu_count())
    with contextlib.closing(examined) as steps:
        for group, job, (result, pictures) in progress(steps, len(works)):
            for one in group:
                results.add(one, job.seed, fingerprint(job), result, pictures)
    return results.close()


def together(todo):
    """[(submissions of the same work, its job)]: a group's is examined once."""
    groups = {}
    for one, job in todo:
        groups.setdefault(fingerprint(job), ([], job))[0].append(one)
    return list(groups.values())


def progress(steps, count):
    """The steps, with a bar in the terminal."""
    return track(steps, "submissions", count, console=Console(stderr=True), transient=True,
                 auto_refresh=False, disable=not sys.stderr.isatty())


def require_whole(topics):
    """ValueError unless this copy of the course has what decides marks, and where it is found.

    Without the reference or the checks, nobody gets a point.
    """
    checks = places.ROOT / "tests" / "labs"
    needed = [exercises.reference(topic) for topic in exercises.topics()]
    needed += [checks / f"test_{topic}.py" for topic in topics if exercises.topic_exercises(topic)]
    for path in needed:
        if not path.exists():
            raise ValueError(f"{places.shown_path(path)} is not in this copy of the course, and "
                             "without it there are no marks: grade in a whole copy")
    for path in checks.glob("test_*.py"):
        if path.stem.removeprefix("test_") not in exercises.topics():
            raise ValueError(f"{places.shown_path(path)} is of no lab, so its checks would not "
                             "count: move them into their lab's file, such as test_transforms.py")


def limits_of(seconds) -> sandbox.Limits:
    """The most seconds of a call -> Limits. An exercise has 12 times that, and a submission more.

    ValueError: no call can be made in that time, or a submission's time does not suffice.
    """
    most = sandbox.Limits().submission / 12
    seconds = sandbox.Limits().call if seconds is None else seconds
    if not 1 <= seconds <= most:
        raise ValueError(f"--seconds is the most that a call may take: give 1 to {most:g}, "
                         f"not {seconds:g}")
    return sandbox.Limits(call=seconds, exercise=12 * seconds)


def task_limits(task) -> sandbox.Limits:
    one = tasks.scorer(task)
    return sandbox.Limits(call=one.SECONDS, exercise=one.ALL_SECONDS)


def made(out) -> Path:
    """The folder for results, made where it is not there. OSError, in one sentence."""
    students = Path(out) / "students"
    try:
        students.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OSError(f"cannot write to {out} ({error.strerror}): name in --out a folder that you "
                      "may write to") from None
    return students.parent


def level_to_use(isolation) -> tuple[str, str]:
    """-> (level, a sentence on it). ValueError: strict is wanted and cannot be had, or this is
    Windows, which has no fork.
    """
    if os.name == "nt":
        raise ValueError("grade needs Linux or macOS: on Windows, run it in WSL")
    if isolation == "process":
        return "process", "as told by --isolation process"
    level, about = sandbox.available()
    if level != "strict":
        raise ValueError(f"submissions are not run without a sandbox, and {about}; to grade work "
                         "that you trust, give --isolation process")
    return level, about


def own_seed(seed, texts) -> int:
    """The seed of a submission, from the run's seed and its hash.

    Nobody can know it before who does not know the run's, nor try all that there are: a submission
    that is given its first inputs can try 2^35 in its time. A table of right answers that somebody
    makes from a seed in a report is part of the next submission, and so changes its seed.
    """
    text = f"{seed} {contents.digest(texts)}"
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:6], "big")  # exact in a sheet


def task_seeds(seed) -> dict:
    """{set: its seed} of an open task, from the run's seed alone: all are asked the same."""
    return {name: int.from_bytes(hashlib.sha256(f"{seed} {name}".encode()).digest()[:16], "big")
            for name in SETS}


def rehearsed(topics, like, jobs=None) -> dict:
    """What each exercise of the reference asks of others: Job.asks, found by grading it. Of an
    open task, which no reference answers, what is expected.

    like: a Job with the same level, limits and extras.
    ValueError: the reference itself does not earn all points here, so nothing else is graded.
    """
    if like.task:
        return tasks.expected(*topics, like.task)
    texts = [(topic, exercises.read(exercises.reference(topic))) for topic in topics]
    jobs = jobs or os.cpu_count()
    todo = [(None, like._replace(texts=dict(texts[k::jobs]), missing={}, seed=0, asks=None))
            for k in range(min(jobs, len(texts)))]
    asks = {}
    with contextlib.closing(running.examined(todo, jobs)) as steps:
        for _, _, (result, _) in steps:
            if wrong := result.problem or first_wrong(result.entries):
                raise ValueError("nothing was graded, for the reference itself does not pass "
                                 f"here: {wrong}")
            asks |= result.asked
    return asks


def first_wrong(entries):
    """A sentence on the first check that does not pass, or None."""
    return next((f"{check.exercise}: {check.claim}: {check.message}"
                 for entry in entries for check in entry.checks if check.verdict != "passed"), None)


def fingerprint(job) -> str:
    """A hash of all that decides a result: what was handed in, the options, the course."""
    options = typed_json.dumps([job._replace(asks=None), running.course_digest()])
    return hashlib.sha256(options.encode()).hexdigest()
