"""Attacks and accidents: each submission gets the points of its honest part, and no more.

The submissions are hostile/*.py, and archives and folders made here. They are graded in one run,
two at a time, so that one could harm the other.
"""
import ast
import csv
import hashlib
import io
import os
import re
import socket
import stat
import sys
import time
import zipfile
from pathlib import Path

import pytest
from small_course import LAB, first_lab

from course.grading.apart import levels, sandbox

HOSTILE = Path(__file__).parent / "hostile"
# Of 7 points, 1 for double, 2 for quadruple, 4 for split. Most attack double, so 6 are deserved.
POINTS = dict.fromkeys((path.stem for path in HOSTILE.glob("*.py")), 6) | {
    "honest": 7,
    "not_started": 4,
    "exits_at_import": 0,
    "exits_hard_at_import": 0,
    "exits_hard_at_exit": 7,     # all that it returned is right; how it ends does not matter
    "endless_import": 0,
    "output_flood": 7,
    "imports_the_reference": 0,
    "thread": 7,
    "daemon": 7,
    "kills_its_parent": 7,       # the first process of a sandbox can't be killed from inside
    "asks_for_its_own_answer": 4,
    "sets_attributes": 4,
    "asks_much": 4,
    "memory_between_questions": 4,
    "asks_beside_the_point": 2,
    "left_files": 5,
    "kills_by_number": 7,
    "syntax_error": 0,
    "deep_source": 0,
    "missing_package": 0,
    "matplotlib": 0,
}
# What no `process` is protected from, and what needs fork.
STRICT_ONLY = {"keyring", "shared_memory", "sockets", "file_locks", "many_files", "drips",
               "kills_by_number", "fork_bomb", "writes_results", "reads_the_reference", "network",
               "kills_its_parent", "memory_of_many", "memory_between_questions", "daemon"}
# At the level `process`, where `strict` is graded, too: enough to see that the levels agree.
BOTH = {"honest", "one_mistake", "exits_hard", "endless_loop_in_c", "closes_descriptors",
        "forged_frames", "changes_its_input", "breaks_numpy"}


def submission(name, names):
    """The text of hostile/NAME.py, with the right answers for all that it leaves out."""
    attack = (HOSTILE / f"{name}.py").read_text(encoding="utf-8")
    for word, meaning in names.items():
        attack = attack.replace(word, meaning)
    defined = re.findall(r"^def (\w+)", attack, re.MULTILINE)
    honest = [ast.get_source_segment(LAB, node) for node in ast.parse(LAB).body
              if isinstance(node, ast.FunctionDef) and node.name not in defined]
    return "\n\n\n".join([f"import os\nimport sys\n\nimport numpy as np\n\n{attack}", *honest, ""])


def zipped(path, *entries):
    """Write a zip archive of (name or ZipInfo, content)."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries:
            archive.writestr(name, content)


def link_entry(name, target):
    entry = zipfile.ZipInfo(name)
    entry.external_attr = (stat.S_IFLNK | 0o777) << 16
    return entry, target


def make_archives(folder, honest, outside):
    """Write submissions that are no single file -> {name: points}."""
    zipped(folder / "zip_plain.zip", ("labs/transforms.py", honest))
    zipped(folder / "zip_slip.zip", ("../../slipped.py", "x"), (f"{outside}/slipped.py", "x"),
           ("labs/transforms.py", honest), ("labs/../../transforms.py", "x"))
    zipped(folder / "zip_of_a_link.zip", link_entry("labs/transforms.py", f"{outside}/secret.py"))
    zipped(folder / "zip_bomb.zip", ("labs/transforms.py", bytes(1 << 28)))
    zipped(folder / "zip_of_many.zip", *((f"{n}.txt", "") for n in range(6000)),
           ("labs/transforms.py", honest))
    (folder / "zip_that_is_none.zip").write_bytes(b"PK\3\4 and nothing more")
    content = io.BytesIO()
    zipped(content, ("labs/transforms.py", honest))
    (folder / "zip_cut_short.zip").write_bytes(content.getvalue()[:-30])
    bodies = {"other_files": {"labs/transforms.py": honest, "conftest.py": "raise SystemExit",
                              "labs/numpy.py": "raise SystemExit", "labs/sitecustomize.py": "x",
                              "reference/transforms.py": "raise SystemExit"},
              "not_utf8": {"labs/transforms.py": honest.encode() + b"# caf\xe9\n"},
              "null_bytes": {"labs/transforms.py": honest + "\0"},
              "too_long": {"labs/transforms.py": honest + "#" * (1 << 19)},
              "missing_file": {"labs/notes.txt": "I forgot."}}
    for name, files in bodies.items():
        for file, text in files.items():
            path = folder / name / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text if isinstance(text, bytes) else text.encode())
    points = {"zip_plain": 7, "zip_slip": 7, "zip_of_many": 7, "other_files": 7} | dict.fromkeys(
        ("zip_of_a_link", "zip_bomb", "zip_that_is_none", "zip_cut_short",
         "not_utf8", "null_bytes", "too_long", "missing_file"), 0)
    if os.name != "nt":
        for name, link, target in (("link_to_a_file", "labs/transforms.py", "secret.py"),
                                   ("link_to_a_folder", "labs", "")):
            (folder / name / link).parent.mkdir(parents=True)
            (folder / name / link).symlink_to(outside / target)
            points[name] = 0
        (folder / "pipe").mkdir()
        os.mkfifo(folder / "pipe" / "transforms.py")
        points["pipe"] = 0
    return points


def contents(root):
    """{path: hash} of all files below a folder."""
    return {str(path): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in root.rglob("*") if path.is_file() and "__pycache__" not in path.parts}


def sleeping(seconds):
    """The processes that a daemon of ours would be (Linux)."""
    return [path.parent.name for path in Path("/proc").glob("[0-9]*/cmdline")
            if seconds.encode() in path.read_bytes()]


@pytest.mark.parametrize("isolation", levels.LEVELS)
def test_every_submission_gets_what_its_honest_part_deserves(isolation, house, run_module,
                                                             tmp_path, monkeypatch):
    """A mark that was stolen, a mark that was lost, a grader that hangs or dies."""
    strict, about = sandbox.available()
    if isolation == "strict" != strict:
        assert not (os.environ.get("CI") and sys.platform == "linux"), about
        pytest.skip(about)
    names = set(POINTS) if isolation == "strict" else \
        BOTH if strict == "strict" else set(POINTS) - STRICT_ONLY
    root = house(first_lab())
    outside, handed_in = tmp_path / "outside", tmp_path / "handed_in"
    outside.mkdir()
    handed_in.mkdir()
    (outside / "transforms.py").write_text(LAB)
    (outside / "secret.py").write_text(LAB)
    server = socket.create_server(("127.0.0.1", 0))
    long = f"{36000 + os.getpid()}.25"  # seconds that no other process sleeps
    filled_in = {"COURSE": root.as_posix(), "PORT": str(server.getsockname()[1]), "LONG": long}
    for name in names:
        (handed_in / f"{name}.py").write_text(submission(name, filled_in), encoding="utf-8")
        (handed_in / f"{name}.py").rename(handed_in / f"{name}_transforms.py")
    expected = {name: POINTS[name] for name in names}
    if isolation == strict:
        expected |= make_archives(handed_in, LAB, outside)
    before = contents(root) | contents(tmp_path)
    monkeypatch.setenv("A_SECRET_OF_THE_GRADER", "hush")

    start = time.monotonic()
    graded = tmp_path / "graded"
    done = run_module(root, "course", "grade", handed_in, "--out", graded, "--jobs", 2,
                      "--seconds", 1, "--isolation", isolation, seconds=550)
    assert done.returncode == 0, done.stdout + done.stderr
    print(f"{len(expected)} submissions, {isolation}: {time.monotonic() - start:.0f} s")
    with open(graded / "grades.csv", encoding="utf-8") as file:
        assert {row["student"]: int(row["total"]) for row in csv.DictReader(file)} == expected

    after = contents(root) | contents(tmp_path)
    ours = str(graded)
    assert {path for path in after if not path.startswith(ours)} == set(before)
    assert all(after[path] == before[path] for path in before)
    assert sleeping(long) == []
    reports = {path.parent.name: path.read_text(encoding="utf-8")
               for path in graded.glob("students/*/report.html")}
    assert set(reports) == set(expected)
    assert [name for name, text in reports.items() if "hush" in text] == []
    assert [name for name, text in reports.items() if len(text) > 1 << 18] == []
    assert [name for name, text in reports.items() if "<script>" in text or "\x1b" in text] == []
