"""What grading costs, and whether the marks are right: python3 benchmarks/grading.py [COUNT]

First each lab, and all sixteen at once, handed in complete: seconds on the clock for the checks in
one process, as a student runs them, and for `grade`, at each level that this machine has, of the
reference and of the other solutions in tests/. The bars at `strict`: 10 s a lab, 30 s for all. Then
COUNT submissions (200) of lab 2, two at a time: each is the reference with one of the known
mistakes, and must lose the points of that exercise and no others.
"""
import csv
import itertools
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "tooling"))
from submitted import other_solution

from benchmarks import measure
from course import exercises
from course.given import places
from course.grading import grade
from course.grading.apart import running, sandbox
from course.grading.apart.jobs import Job
from course.grading.apart.levels import LEVELS
from course.grading.request import Request
from course.upkeep import mistakes

TOPIC = "rasterization"
RUNS = 3  # of which the median is told


def main(count=200):
    facts = measure.machine()
    strictest, about = sandbox.available()
    levels = LEVELS[LEVELS.index(strictest):]
    print(f"strictest level here: {strictest} ({about})")
    rows = [one_submission(labs, levels) for labs in [*map(str, range(1, 17)), "1-16"]]
    measure.show(rows)
    seconds, wrong = a_class(count, strictest)
    print(f"\n{count} submissions of lab 2, {strictest}, 2 at a time: {seconds:.0f} s, "
          f"{seconds / count:.2f} s each; {wrong} with a wrong mark")
    measure.save("grading", facts, {"seconds": rows, "class": {
        "submissions": count, "level": strictest, "seconds": seconds, "wrong marks": wrong}})


def one_submission(labs, levels):
    """A row of the table: medians in seconds, of calls in turn."""
    topics = exercises.topics_of(labs)
    reference = {topic: exercises.read(exercises.reference(topic)) for topic in topics}
    other = reference | {topic: other_solution(topic) for topic in topics
                         if topic in exercises.asking_topics()}
    asks = grade.rehearsed(topics, Job({}, {}, levels[0]), 1)
    calls = {"plain check": lambda: plain(reference)}
    for (name, texts), level in itertools.product(
            {"reference": reference, "others": other}.items(), levels):
        job = Job(texts, {}, level, asks=asks)
        calls[f"{name}, {level}"] = lambda job=job: complete(running.examine(job))
    took = {name: [] for name in calls}
    for name, call in itertools.chain(*[calls.items()] * RUNS):
        start = time.perf_counter()
        call()
        took[name].append(time.perf_counter() - start)
    return {"labs": labs} | {name: statistics.median(times) for name, times in took.items()}


def plain(texts):
    """The checks of these labs in one process of pytest."""
    files = [f"tests/labs/test_{topic}.py" for topic in texts if exercises.topic_exercises(topic)]
    subprocess.run([sys.executable, "-m", "pytest", "-q", "--impl", "reference", *files],
                   cwd=places.ROOT, check=True, capture_output=True)


def complete(examined):
    """RuntimeError unless all exercises are done."""
    result, _ = examined
    if result.problem or {entry.verdict for entry in result.entries} != {"done"}:
        raise RuntimeError(f"not all points: {result.problem}")


def a_class(count, level):
    """Grade count submissions -> (seconds, how many of them have a wrong mark)."""
    text = exercises.read(exercises.reference(TOPIC))
    most = sum(exercise.points for exercise in exercises.topic_exercises(TOPIC))
    planted = dict(zip((f"student{n:03}" for n in range(count)),
                       itertools.cycle(mistakes.library(TOPIC)), strict=False))
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name, mistake in planted.items():
            (folder / "in" / name).mkdir(parents=True)
            (folder / "in" / name / f"{TOPIC}.py").write_text(
                f"{text}\n\n{mistake.text}", encoding="utf-8")
        start = time.perf_counter()
        grade.run(Request(folder / "in", folder / "out", "2", jobs=2, isolation=level))
        seconds = time.perf_counter() - start
        with open(folder / "out" / "grades.csv", encoding="utf-8-sig") as file:
            got = {row["student"]: row for row in csv.DictReader(file)}
    return seconds, sum(got[name]["total"] != str(most - mistake.exercise.points)
                        for name, mistake in planted.items())


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
