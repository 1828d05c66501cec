"""Graded again from what the output folder keeps, and which of several hand-ins counts."""
import csv
import shutil

import pytest
from graded import entry, exercise, result
from small_course import grades
from submitted import put

from labkit.grading import grade
from labkit.grading.apart import running

DUE = "2026-11-22T23:59+00:00"
METADATA = """\
submission_{}:
  :submitters:
  - :sid: '7'
  :created_at: 2026-11-{} 12:00:00 Z
"""


RIGHT = {"broken": ("right", "wrong"), "mended": ("right",)}  # what passes by these checks


@pytest.fixture
def run(grade_here, monkeypatch):
    """run("mended", ada="right") -> what is printed where that is graded by these checks. Without
    anybody, what the output folder keeps is graded again.
    """
    one = exercise("1.1", "f", 7)
    monkeypatch.setattr(grade, "asked_for", lambda request: (["transforms"], [one]))

    def graded_by(checks, **texts):
        monkeypatch.setattr(running, "course_digest", lambda: checks)
        return grade_here(lambda text: result(entry(
            one, "done" if text in RIGHT[checks] else "failing", topic="transforms")), {
                f"{student}_transforms.py": text for student, text in texts.items()},
            resume=not texts)[1]

    return graded_by


def test_all_that_is_in_the_tables_is_graded_again(run, tmp_path):
    """After a mended check, who is only in the late folder keeps the old mark, without a word."""
    out = tmp_path / "out"
    run("broken", ada="right", bob="wrong", eve="?")
    assert [row["total"] for row in grades(out).values()] == ["7", "7", "0"]
    assert "graded by other checks than today's: ada, bob, eve; python3 -m course grade --out" in (
        run("mended", zoe="right"))
    done = run("mended")
    assert "submissions: 3 graded" in done and "1 were done before" in done
    assert "other checks than today's" not in done
    rows = grades(out)
    assert {name: row["total"] for name, row in rows.items()} == {
        "ada": "7", "bob": "0", "eve": "0", "zoe": "7"}
    assert {row["checks"] for row in rows.values()} == {"mended"}
    with open(out / "changes.csv", encoding="utf-8-sig") as file:
        assert [*csv.reader(file)][1:] == [["bob", what, "7", "0", "other checks"]
                                           for what in ("1.1", "total", "after lateness")]
    put(out, {"code/ada/transforms.py": "x = 1\n"})
    with pytest.raises(ValueError, match="does not keep what was handed in by ada"):
        run("mended")


@pytest.fixture
def graded(grade_here, tmp_path):
    """graded(days, texts, count=...) -> the row of Ada, who handed in a text on each of these days.
    A text is worth as many points as it has letters.
    """
    def grade_ada(texts, **options):
        grade_here(lambda text: result(entry(
            exercise("1.1", "f", len(text) or 1), "done" if text else "failing",
            topic="transforms")), {
                "submission_metadata.yml": "".join(map(METADATA.format, texts, texts)),
                **{f"submission_{day}/transforms.py": text for day, text in texts.items()}},
            due=DUE, late="10%/day", resume=True, **options)
        row, = grades(tmp_path / "out").values()
        return row["total"], row["after lateness"], row["handed in"][8:10]

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
