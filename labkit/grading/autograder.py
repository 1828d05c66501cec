"""For Gradescope: the zip that grades there."""
import json
import secrets
import sys
from pathlib import Path

from .. import exercises, places
from . import grade
from .apart import running, sandbox
from .apart.jobs import Job
from .gradebook.records import How, Record
from .handing import archives, contents
from .handing.submissions import Submission
from .pages import report

FILES = Path(__file__).with_name("files")
NEEDED = (*running.DECIDE, "tests/labs/hints.json", "labkit/grading/files/*", "labs/*.py",
          "pyproject.toml", "requirements.txt")
PROGRAMS = "setup.sh", "run_autograder"


def gradescope(path, labs=None) -> int:
    """Write the zip that Gradescope's "configure autograder" takes -> 0."""
    topics = exercises.topics_of(labs)
    grade.require_whole(topics)
    level, _ = sandbox.available()
    settings = {"topics": topics, "asks": grade.rehearsed(topics, Job({}, {}, level)),
                "seed": secrets.randbits(128)}
    paths = sorted({path for pattern in NEEDED for path in places.ROOT.glob(pattern)})
    places.write_whole(path, archives.zipped([
        *((file.relative_to(places.ROOT).as_posix(), file.read_bytes()) for file in paths),
        *((name, (FILES / name).read_bytes()) for name in PROGRAMS),
        ("settings.json", json.dumps(settings).encode())], PROGRAMS))
    print(f"{path}: upload it in Gradescope as the assignment's autograder ({', '.join(topics)}), "
          "and show it to nobody: it holds the seed of all random inputs")
    return 0


def main(folder, path):
    """Inside Gradescope: grade the one submission in a folder, write results.json."""
    settings = json.loads((places.ROOT / "settings.json").read_bytes())
    level, about = sandbox.available()
    texts, missing, notes = archives.read(folder, settings["topics"])
    job = Job(texts, missing, level, grade.own_seed(settings["seed"], texts), asks=settings["asks"])
    result, _ = running.examine(job)
    if result.problem:
        raise SystemExit(f"could not be graded: {result.problem}")
    whole, *_ = archives.read(folder, exercises.topics())
    work = Submission("", texts, missing, tuple(notes), digest=contents.digest(whole))
    record = Record(work, How(level, job.seed, "", ""), result)
    places.write_whole(path, json.dumps(report.gradescope(record, about)).encode())


if __name__ == "__main__":
    main(*sys.argv[1:])
