"""For other graders: a zip for Gradescope, files for GitHub Actions and Classroom 50."""
import io
import json
import sys
import zipfile
from pathlib import Path

from .. import exercises
from ..given import places
from . import grade
from .apart import running, sandbox
from .apart.jobs import Job
from .gradebook.records import How, Record
from .handing import archives
from .handing.submissions import Submission
from .pages import report

FILES = Path(__file__).with_name("files")
NEEDED = ("course/**/*.py", "course/given/data/*", "course/checks/hints.json",
          "course/grading/files/*", "reference/*.py", "labs/*.py",
          "tests/conftest.py", "tests/labs/*.py", "tests/golden/*", "pyproject.toml",
          "requirements.txt")


def gradescope(path, labs=None) -> int:
    """Write the zip that Gradescope's "configure autograder" takes -> 0."""
    topics = exercises.topics_of(labs)
    grade.require_whole(topics)
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted({file for pattern in NEEDED for file in places.ROOT.glob(pattern)}):
            add(archive, file.relative_to(places.ROOT).as_posix(), file.read_bytes())
        for name in ("setup.sh", "run_autograder"):
            add(archive, name, (FILES / name).read_bytes(), executable=True)
        level, _ = sandbox.available()
        asks = grade.rehearsed(topics, Job({}, {}, level))
        add(archive, "settings.json", json.dumps({"topics": topics, "asks": asks}).encode())
    places.write_whole(path, content.getvalue())
    print(f"{path}: upload it in Gradescope as the assignment's autograder ({', '.join(topics)})")
    return 0


def add(archive, name, content, executable=False):
    entry = zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0))
    entry.external_attr = (0o100755 if executable else 0o100644) << 16
    entry.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(entry, content)


def github(folder) -> int:
    """Write a workflow, and autograder.py for it and for Classroom 50, to a repository -> 0."""
    folder = Path(folder)
    for name, place in (("labs.yml", ".github/workflows/labs.yml"),
                        ("autograder.py", "autograder.py")):
        (folder / place).parent.mkdir(parents=True, exist_ok=True)
        places.write_whole(folder / place, (FILES / name).read_bytes())
        print(folder / place)
    return 0


def main(folder, path):
    """Inside Gradescope: grade the one submission in a folder, write results.json."""
    settings = json.loads((places.ROOT / "settings.json").read_bytes())
    level, about = sandbox.available()
    texts, missing, notes = archives.read(folder, settings["topics"])
    job = Job(texts, missing, level, grade.own_seed(0, texts), asks=settings["asks"])
    result, _ = running.examine(job)
    if result.problem:
        raise SystemExit(f"could not be graded: {result.problem}")
    whole, *_ = archives.read(folder, exercises.topics())
    work = Submission("", texts, missing, tuple(notes), digest=archives.digest(whole))
    record = Record(work, How(level, job.seed, "", ""), result)
    places.write_whole(path, json.dumps(report.gradescope(record, about)).encode())


if __name__ == "__main__":
    main(*sys.argv[1:])
