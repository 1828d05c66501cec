"""Attacks and accidents: each submission gets the points of its honest part, and no more.

The submissions are hostile/*.py, and archives and folders made here. A run grades a share of them,
two at a time, so that one could harm the other.
"""
import ast
import hashlib
import os
import re
import stat
import sys
import zipfile
from pathlib import Path

import pytest
from small_course import LAB, first_lab, grade_command, grades, hand_in
from submitted import put, zipped

from labkit.grading.apart import sandbox

HOSTILE = Path(__file__).parent / "hostile"
# Of 7 points, 1 for double, 2 for quadruple, 4 for split. Most attack double, so 6 are deserved.
OTHER_POINTS = {
    0: {"exits_at_import", "exits_hard_at_import", "endless_import", "imports_the_reference",
        "deep_source"},
    2: {"asks_beside_the_point"},
    4: {"not_started", "asks_for_its_own_answer", "sets_attributes", "asks_much",
        "memory_between_questions"},
    5: {"left_files", "marks_its_folder"},
    7: {"honest", "matplotlib", "output_flood", "thread", "daemon", "kills_by_number",
        "exits_hard_at_exit", "ends_well",  # all answers are right; how it ends does not matter
        "kills_its_parent"},   # the first process of a sandbox can't be killed from inside
}
POINTS = {path.stem: 6 for path in HOSTILE.glob("*.py")} | {
    name: points for points, names in OTHER_POINTS.items() for name in names}
# What no `process` is protected from, and what needs fork.
STRICT_ONLY = {"many_files", "drips", "kills_by_number", "fork_bomb", "writes_results",
               "reads_the_reference", "kills_its_parent", "memory_of_many",
               "memory_between_questions", "daemon"}
# At the level `process`, where `strict` is graded, too: enough to see that the levels agree.
BOTH = {"honest", "one_mistake", "exits_hard", "endless_loop_in_c", "closes_descriptors",
        "forged_frames", "changes_its_input", "breaks_numpy"}
# What `strict` grades, so that no run takes long. In the first are the archives and folders alone.
SHARES = [[], *(sorted(POINTS)[share::7] for share in range(7))]
# The worker's own channel to the grader, which attacks find among all objects.
CHANNEL = """next(found for found in __import__("gc").get_objects()
                   if type(found).__name__ == "Channel")"""


def submission(name, names):
    """The text of hostile/NAME.py, with the right answers for all that it leaves out."""
    attack = (HOSTILE / f"{name}.py").read_text(encoding="utf-8")
    for word, meaning in names.items():
        attack = attack.replace(word, meaning)
    defined = re.findall(r"^def (\w+)", attack, re.MULTILINE)
    honest = [ast.get_source_segment(LAB, node) for node in ast.parse(LAB).body
              if isinstance(node, ast.FunctionDef) and node.name not in defined]
    return "\n\n\n".join([f"import os\nimport sys\n\nimport numpy as np\n\n{attack}", *honest, ""])


HARMLESS = {"zip_plain", "zip_slip", "zip_of_many", "other_files"}  # the rest gets no points


def hand_in_no_files(folder, outside):
    """Write submissions that are no single file -> {name: points}."""
    lab = {"labs/transforms.py": LAB}
    link = zipfile.ZipInfo("labs/transforms.py")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    put(folder, {
        "zip_plain.zip": lab,
        "zip_slip.zip": {"../../slipped.py": "x", f"{outside}/slipped.py": "x", **lab,
                         "labs/../../transforms.py": "x"},
        "zip_of_a_link.zip": zipped([(link, f"{outside}/secret.py")]),
        "zip_bomb.zip": {"labs/transforms.py": bytes(1 << 28)},
        "zip_of_many.zip": {f"{number}.txt": "" for number in range(6000)} | lab,
        "zip_cut_short.zip": zipped(lab.items())[:-30],
        **{f"other_files/{name}": "raise SystemExit" for name in (
            "conftest.py", "labs/numpy.py", "labs/sitecustomize.py", "reference/transforms.py")},
        "other_files/labs/transforms.py": LAB,
        "null_bytes/labs/transforms.py": LAB + "\0"})
    for name in ("link_to_a_file/labs", "link_to_a_folder", "pipe"):
        (folder / name).mkdir(parents=True)
    (folder / "link_to_a_file/labs/transforms.py").symlink_to(outside / "secret.py")
    (folder / "link_to_a_folder/labs").symlink_to(outside)
    os.mkfifo(folder / "pipe/transforms.py")
    return {path.stem: 7 if path.stem in HARMLESS else 0 for path in folder.iterdir()}


def contents(root):
    """{path: hash} of all files below a folder."""
    return {str(path): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in root.rglob("*") if path.is_file() and "__pycache__" not in path.parts}


def sleeping(seconds):
    """The processes that a daemon of ours would be (Linux)."""
    return [path.parent.name for path in Path("/proc").glob("[0-9]*/cmdline")
            if seconds.encode() in path.read_bytes()]


@pytest.mark.parametrize(("isolation", "share"), [
    *(("strict", share) for share in range(len(SHARES))), ("process", 0)])
def test_every_submission_gets_what_its_honest_part_deserves(isolation, share, house, run_module,
                                                             tmp_path, monkeypatch):
    """A mark that was stolen, a mark that was lost, a grader that hangs or dies."""
    strict, about = sandbox.available()
    if isolation == "strict" != strict:
        assert not (os.environ.get("CI") and sys.platform == "linux"), about
        pytest.skip(about)
    names = SHARES[share] if isolation == "strict" else \
        BOTH if strict == "strict" else set(POINTS) - STRICT_ONLY
    root = house(first_lab())
    outside, handed_in = tmp_path / "elsewhere", tmp_path / "in"
    put(outside, {"transforms.py": LAB, "secret.py": LAB})
    expected = hand_in_no_files(handed_in, outside) if (isolation, share) == (strict, 0) else {}
    long = f"{36000 + os.getpid()}.25"  # seconds that no other process sleeps
    filled_in = {"COURSE": root.as_posix(), "LONG": long, "CHANNEL": CHANNEL}
    hand_in(tmp_path, **{name: submission(name, filled_in) for name in names})
    expected |= {name: POINTS[name] for name in names}
    before = contents(root) | contents(tmp_path)
    monkeypatch.setenv("A_SECRET_OF_THE_GRADER", "hush")

    done = run_module(root, *grade_command(
        tmp_path, "--jobs", 2, "--seconds", 1, isolation=isolation))
    assert done.returncode == 0, done.stdout + done.stderr
    graded = tmp_path / "out"
    assert {name: int(row["total"]) for name, row in grades(graded).items()} == expected

    after = contents(root) | contents(tmp_path)
    assert {path for path in after if not path.startswith(str(graded))} == set(before)
    assert all(after[path] == before[path] for path in before)
    assert sleeping(long) == []
    reports = {path.parent.name: path.read_text(encoding="utf-8")
               for path in graded.glob("students/*/report.html")}
    assert set(reports) == set(expected)
    assert [name for name, text in reports.items() if "hush" in text] == []
    assert [name for name, text in reports.items() if len(text) > 1 << 18] == []
    assert [name for name, text in reports.items() if "<script>" in text or "\x1b" in text] == []
