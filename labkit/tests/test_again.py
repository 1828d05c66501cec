"""Graded again from what the output folder keeps, and which of several hand-ins counts."""
import csv
import shutil

import pytest
from graded import entry, exercise, result
from small_course import CHECKS, LAB, first_lab, grade_command, grades, hand_in
from submitted import put

from labkit.grading import grade
from labkit.grading.apart import running
from labkit.grading.request import Request

LAST = CHECKS.splitlines()[-1]
DUE = "2026-11-22T23:59+00:00"
METADATA = """\
submission_{}:
  :submitters:
  - :sid: '7'
  :created_at: 2026-11-{} 12:00:00 Z
"""


def test_all_that_is_in_the_tables_is_graded_again(house, run_module, tmp_path):
    """After a mended check, who is only in the late folder keeps the old mark, without a word."""
    out = tmp_path / "out"
    again = "course", "grade", "--out", out
    hand_in(tmp_path, ada=LAB, bob=LAB.replace("x / 2, x > 0", "x, x > 0"))
    put(tmp_path, {"in/eve/readme.txt": "?"})
    run_module(house(first_lab(checks=CHECKS.replace(LAST, "    impl.split(x)"))),
               *grade_command(tmp_path))
    assert grades(out)["bob"]["total"] == "7"
    mended = house(first_lab())
    shutil.rmtree(tmp_path / "in")
    hand_in(tmp_path, zoe=LAB)
    told = run_module(mended, *grade_command(tmp_path)).stdout
    assert "graded by other checks than today's: ada, bob, eve; python3 -m course grade --out" in (
        " ".join(told.split()))
    done = run_module(mended, *again, "--isolation", "process", "--resume")
    assert "3 submissions graded" in done.stdout and "1 were done before" in done.stdout
    assert "other checks than today's" not in done.stdout
    rows = grades(out)
    assert {name: row["total"] for name, row in rows.items()} == {
        "ada": "7", "bob": "3", "eve": "0", "zoe": "7"}
    assert len({row["checks"] for row in rows.values()}) == 1
    with open(out / "changes.csv", encoding="utf-8-sig") as file:
        assert [row[:2] + row[4:] for row in csv.reader(file)][1:] == [
            ["bob", what, "other checks"] for what in ("1.3", "total", "after lateness")]
    put(out, {"code/ada/transforms.py": "x = 1\n"})
    refused = run_module(mended, *again, "--isolation", "process")
    assert refused.returncode == 2 and "does not keep what was handed in by ada" in refused.stderr


@pytest.fixture
def graded(monkeypatch, tmp_path):
    """graded(days, texts, count=...) -> the row of Ada, who handed in a text on each of these days.
    A text is worth as many points as it has letters.
    """
    def examine(job, line):
        points = len(job.texts.get("transforms", ""))
        return result(entry(exercise("1.1", "f", points or 1), "done" if points else "failing",
                            topic="transforms")), {}

    def grade_ada(texts, **options):
        shutil.rmtree(tmp_path / "in", ignore_errors=True)
        put(tmp_path / "in", {"submission_metadata.yml": "".join(map(
            METADATA.format, texts, texts)), **{
                f"submission_{day}/transforms.py": text for day, text in texts.items()}})
        request = Request(tmp_path / "in", tmp_path / "out", "1", isolation="process", due=DUE,
                          late="10%/day", resume=True, **options)
        assert grade.run(request) == 0
        row, = grades(tmp_path / "out").values()
        return row["total"], row["after lateness"], row["handed in"][8:10]

    monkeypatch.setattr(running, "examine", examine)
    monkeypatch.setattr(grade, "rehearsed", lambda *_: {})
    return grade_ada


FOUR, SIX, TEN = "4" * 4, "6" * 6, "9" * 10


@pytest.mark.parametrize(("count", "texts", "expected"), [
    (None, {20: SIX, 24: FOUR}, ("4", "3.2", "24")),
    ("newest", {20: SIX, 24: FOUR}, ("4", "3.2", "24")),
    ("last-on-time", {19: TEN, 20: SIX, 24: FOUR}, ("6", "6", "20")),
    ("last-on-time", {24: SIX, 25: FOUR}, ("4", "2.8", "25")),
    ("best", {19: FOUR, 20: SIX, 24: FOUR}, ("6", "6", "20")),
    ("best", {20: SIX, 24: TEN}, ("10", "8", "24")),
    (None, {20: SIX, 24: SIX}, ("6", "6", "20")),
    (None, {20: SIX, 21: FOUR, 24: SIX}, ("6", "6", "20")),
    ("last-on-time", {20: SIX, 21: FOUR, 24: TEN}, ("4", "4", "21"))])
def test_which_of_several_hand_ins_counts(count, texts, expected, graded, tmp_path):
    """The same file sent again after the deadline costs a share, or worse late work takes the place
    of better work in time; also where each comes in a folder, and a run, of its own.
    """
    assert graded(texts, count=count) == expected
    assert graded(texts, count=count) == expected, "graded again"
    with open(tmp_path / "out" / "changes.csv", encoding="utf-8-sig") as file:
        assert len([*csv.reader(file)]) == 1, "what was better for a while is no change"
    shutil.rmtree(tmp_path / "out")
    if len(texts) == 2:
        assert [graded({day: text}, count=count) for day, text in texts.items()][-1] == expected
