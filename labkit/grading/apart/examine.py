"""One submission: the course's own checks, with a worker in the place of the labs.

Started by `grade` as a process of its own, with a folder: job.json is read there, result.json and
pictures are written.
"""
import _thread
import contextlib
import os
import sys
import threading
import time
from pathlib import Path

from ... import exercises, places, verdicts
from ...checks import runner
from . import open_task, processes, typed_json
from .examination import Examination, State
from .jobs import Job, Result

PARENT_MEMORY = 1 << 32  # bytes that this process may take


def examine(job: Job) -> Result:
    started = time.monotonic()
    if job.task:
        return open_task.examine(job)._replace(seconds=time.monotonic() - started)
    labs = {topic: exercises.topic_exercises(topic) for topic in exercises.topics()
            if topic in (*job.texts, *job.missing)}
    numbers = [exercise.number for lab in labs.values() for exercise in lab
               if job.extra or not exercise.is_extra]
    examination = Examination(job, labs)
    found, problems = runner.run_checks(labs, numbers, "labs", job.seed, [examination])
    entries = [entry._replace(verdict="failing")
               if examination.state.get(entry.number) is State.SPOILT else entry
               for entry in verdicts.entries(labs, numbers, {}, found)]
    problems += defects(labs, [check for check in found if examination.ran(check)], job.seed)
    problem = examination.problem or "\n".join(problems) or None
    return Result(entries, examination.lost, examination.missing, examination.answers.asked,
                  problem, time.monotonic() - started)


def defects(labs, found, seed):
    """Sentences on those checks that failed, and that the reference fails at this seed, too."""
    failed = {check.nodeid: check.exercise for check in found if check.verdict == "failed"}
    again, _ = runner.run_checks(labs, set(failed.values()), "reference", seed)
    return [f"the check is wrong, and not what was handed in: the reference fails it, too, at seed "
            f"{seed}: {check.exercise}: {check.claim}: {check.message}"
            for check in again if check.verdict != "passed" and check.nodeid in failed]


def end_with_the_grader():
    """Interrupt this process when its standard input ends: the grader ended, or wants no more."""
    def wait():
        os.read(0, 1)
        _thread.interrupt_main()

    threading.Thread(target=wait, daemon=True).start()


def main(folder):
    end_with_the_grader()
    folder = Path(folder)
    places.OUT = folder
    processes.adopt_orphans()
    processes.offer_to_the_kernel(500)
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (PARENT_MEMORY, PARENT_MEMORY))
    job = typed_json.loads(Job, (folder / "job.json").read_bytes())
    result = typed_json.dumps(examine(job)).replace(f"{folder}/", "out/")  # as students see it
    places.write_whole(folder / "result.json", result.encode())


if __name__ == "__main__":
    main(sys.argv[1])
