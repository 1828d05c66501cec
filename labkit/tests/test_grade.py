"""Grading a class: tables and reports, what is kept, what a student is told, Gradescope."""
import sys

import pytest
from graded import entry, exercise, result
from made_up import check_text
from small_course import (
    CHECKS,
    LAB,
    SECOND,
    SECOND_LAB,
    first_lab,
    grade_command,
    grades,
    hand_in,
)
from submitted import put

from labkit import exercises, places
from labkit.grading import grade
from labkit.grading.apart import sandbox
from labkit.grading.handing import archives
from labkit.grading.request import Request
from labkit.lab_text import skeleton

FINE_PRINT = '''\
@exercise("1.1", fine_print=True)
def test_nothing(impl):
    """It never ends."""
    assert impl.double(np.zeros(0)).size == 0


@exercise("1.1")'''


@pytest.fixture(scope="module")
def graded(house, run_module, tmp_path_factory):
    """(the folder with the results, what was printed)."""
    folder = tmp_path_factory.mktemp("class")
    course = house(first_lab() | SECOND_LAB | {"course/given/data/captures/00.png": ""})
    put(folder / "in", {
        "ada/labs/transforms.py": LAB, "ada/labs/rasterization.py": SECOND,
        "bob/transforms.py": LAB.replace("2 * x", "3 * x"), "bob/rasterization.py": SECOND,
        "eve/transforms.py": LAB.replace("return x / 2, x > 0", "while True: x"),
        "eve/rasterization.py": SECOND.replace("2 * x", "x"),
        "ann/transforms.py": skeleton(LAB), "A&B.txt": "?", "zed/-1.rar": "?"})
    return folder / "out", run_grade(run_module, course, folder)


def run_grade(run_module, course, folder, status=0):
    done = run_module(course, *grade_command(folder, "--seconds", 1))
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture
def ada_graded(house, run_module, tmp_path):
    """What is printed where a course has only the first lab, and ada hands it in."""
    def grade_ada(lab=LAB, checks=CHECKS, work=LAB, status=0):
        hand_in(tmp_path, ada=work)
        return run_grade(run_module, house(first_lab(lab, checks)), tmp_path, status)
    return grade_ada


def test_the_table_has_points_of_each_exercise(graded):
    """A mistake costs the points of exercises that build on it, or a note is a formula."""
    table = grades(graded[0])
    names = ["1.1 double", "1.2 quadruple", "1.3 split", "2.1 eight", "total", "of"]
    assert {name: [int(row[column]) for column in names] for name, row in table.items()} == {
        "ada": [1, 2, 4, 3, 10, 10], "bob": [0, 2, 4, 3, 9, 10], "eve": [1, 2, 0, 0, 3, 10],
        "ann": [0, 0, 0, 0, 0, 10], "zed": [0, 0, 0, 0, 0, 10]}
    assert {row["isolation"] for row in table.values()} == {"process"}
    assert len({row["hash"] for row in table.values()}) == 5
    assert table["zed"]["notes"] == ("'-1.rar cannot be read (File is not a zip file): pack it "
                                     "again as a zip")


def test_the_level_is_stated_wherever_marks_are(graded):
    """Marks from an open worker look like those from a sandbox."""
    out, printed = graded
    assert "no protection against malice" in printed
    for page in (out / "index.html", out / "students" / "ada" / "report.html"):
        assert "solation process (as told by --isolation process)" in page.read_text("utf-8")


def test_a_student_reads_which_claim_failed_and_how_to_run_it(graded):
    """A report without the reason, or of a check that passed."""
    text = (graded[0] / "students" / "eve" / "report.html").read_text("utf-8")
    assert "3 of 10 points" in text and "0 of 4 points: 0 of 1 claim holds" in text
    assert "Half and sign" in text and "no answer within 1 s" in text
    assert "python3 -m course check 1.3" in text and "Twice" not in text


def test_the_overview_shows_crashes_and_the_hardest(graded):
    """A crash is only in one student's report."""
    text = (graded[0] / "index.html").read_text("utf-8")
    crashes = text.partition("Crashes, time-outs")[2].partition("Everybody<")[0]
    assert "eve" in crashes and "in split: no answer within 1 s" in crashes
    hardest = text.partition("hardest")[2]
    assert hardest.index("2.1") < hardest.index("1.2")


def test_a_check_that_the_reference_fails_is_nobodys_mistake(ada_graded):
    """A check that breaks at some seeds takes the points of those who happen to get them."""
    breaks = "    assert rng.bit_generator.seed_seq.entropy[0] == 0\n    assert_close(impl.quad"
    printed = ada_graded(checks=CHECKS.replace("    assert_close(impl.quad", breaks), status=1)
    assert "the reference fails it, too, at seed" in printed


def test_a_hang_costs_the_claims_that_come_after_it_and_fine_print_none(ada_graded, tmp_path):
    """Checks that did not run are no claims: who hangs after the first one gets all points. Or the
    first one is lost, which holds at home; or the question's points, with the fine print's process.
    """
    more = "".join(check_text("1.3", f"split_{n}", "", f"x = np.zeros({n})",
                              "assert_close(impl.split(x), (x, x > 0))") for n in (0, 1))
    hand_in(tmp_path, bob=LAB.replace("return 2", "while not x.size: pass\n    return 2"))
    ada_graded(checks=CHECKS.replace('@exercise("1.1")', FINE_PRINT) + more,
               work=LAB.replace("return x / 2", "while not x.size: pass\n    return x / 2"))
    row, bob = grades(tmp_path / "out").values()
    assert (row["1.3 split"], row["total"]) == ("1", "4")
    assert (bob["total"], bob["fine print open"]) == ("7", "1.1")
    report = (tmp_path / "out" / "students" / "ada" / "report.html").read_text("utf-8")
    assert "1 of 4 points: 1 of 3 claims hold" in report


def test_nothing_is_graded_where_the_reference_fails(ada_graded, tmp_path):
    """Half a copy of the course gives everybody 0 points."""
    assert "nothing was graded" in ada_graded(lab=LAB.replace("2 * x", "3 * x"), status=2)
    assert not list((tmp_path / "out").glob("*.*"))


def in_points(text):
    """A Result with a point for each letter."""
    if text == "boom":
        raise RuntimeError("boom")
    return result(entry(exercise("1.1", "f", len(text)), "done", topic="transforms"))


def test_resume_keeps_what_is_the_same_and_grades_what_is_not(grade_here, tmp_path):
    """Everything again, or an old mark for new work; or marks change without a word."""
    files = {"ada_transforms.py": "x = 1", "bob_transforms.py": "x"}
    grade_here(in_points, files)
    before = {path: path.stat().st_mtime_ns for path in tmp_path.glob("out/students/*/record.json")}
    _, printed = grade_here(in_points, files | {"bob_transforms.py": "x = 2"}, resume=True)
    assert "submissions: 1 graded" in printed
    assert "bob: points 5, before 1: handed in again" in printed
    changed = {path.parent.name for path, old in before.items() if path.stat().st_mtime_ns != old}
    assert changed == {"bob"} and grades(tmp_path / "out")["bob"]["total"] == "5"


def test_what_was_not_understood_is_told(graded):
    """A file without a row and without a word."""
    assert "not understood: A&B.txt: no student can be told from this name" in graded[1]
    assert "A&amp;B.txt" in (graded[0] / "index.html").read_text("utf-8")


def test_who_was_graded_earlier_stays_in_the_tables(grade_here, tmp_path):
    """Grading those who came late takes all others out of the table."""
    def right(text):
        core = [one for one in exercises.topic_exercises("transforms")
                if one.points and not one.is_extra]
        return result(*(entry(one, "done", topic="transforms") for one in core))

    grade_here(right, {"ada_transforms.py": "x", "bob/notes.txt": "x"})
    before = grades(tmp_path / "out")
    _, printed = grade_here(right, {"zoe_transforms.py": "x"})
    assert "submissions: 1 graded" in printed and "2 more of earlier runs stay" in printed
    after = grades(tmp_path / "out")
    assert after.pop("zoe")["total"] == after["ada"]["total"] and after == before
    assert "students/bob/report.html" in (tmp_path / "out" / "index.html").read_text("utf-8")

    with pytest.raises(ValueError, match="bob holds grades of another student, whose name is alm"):
        grade_here(right, {"Bob_transforms.py": "x"})
    (tmp_path / "out" / "asked.json").unlink()
    with pytest.raises(ValueError, match="holds grades of ada for other labs or points, or of ano"):
        grade_here(right, {"zoe_transforms.py": "x"}, extra=True)
    assert set(grades(tmp_path / "out")) == {*before, "zoe"}


def test_one_student_s_trouble_is_no_other_s(grade_here, tmp_path, monkeypatch):
    """An error in one submission, or a folder that cannot be written, leaves others ungraded."""
    def opened(path, budget):
        if path.name.startswith("fay"):
            raise PermissionError(13, "Permission denied")
        return archives.Paid(path, budget)

    monkeypatch.setattr(archives, "opened", opened)
    put(tmp_path / "out", {"students/eve": "a file where a folder should be"})
    texts = {"ada": "xx", "bob": "boom", "eve": "xx", "fay": "xx", "zoe": "xx"}
    status, printed = grade_here(in_points, {f"{student}_transforms.py": text
                                             for student, text in texts.items()})
    table = grades(tmp_path / "out")
    assert [row["total"] for row in table.values()] == ["2", "", "", "", "2"]
    assert table["bob"]["problem"] == "the examination broke off: RuntimeError: boom"
    assert "its results cannot be written" in table["eve"]["problem"]
    assert table["fay"]["problem"] == ("fay_transforms.py cannot be read here (Permission denied): "
                                       "allow yourself to read it, and grade again")
    assert status == 1 and "3 could not be graded" in printed


def test_untrusted_work_is_not_run_without_a_sandbox(monkeypatch):
    """A machine without bubblewrap grades all the same, and nobody notices."""
    monkeypatch.setattr(sandbox, "available", lambda: ("process", "strict needs bubblewrap"))
    with pytest.raises(ValueError, match="needs bubblewrap; to grade work that you trust"):
        grade.level_to_use(None)
    assert grade.level_to_use("process")[0] == "process"
    monkeypatch.setattr(grade.os, "name", "nt")
    with pytest.raises(ValueError, match="on Windows, run it in WSL"):
        grade.level_to_use("process")


@pytest.mark.parametrize("seconds", [0, -1, 0.5, 151, float("nan"), float("inf")])
def test_a_time_in_which_no_mark_is_right_is_refused(seconds, tmp_path):
    """Every call takes too long, and a whole class gets no points."""
    with pytest.raises(ValueError, match="give 1 to 150, not"):
        grade.run(Request(tmp_path, tmp_path / "out", seconds=seconds))
    assert not list((tmp_path / "out").glob("*.*"))
    assert grade.limits_of(150) == sandbox.Limits(call=150, exercise=1800)


@pytest.mark.parametrize(("path", "sentence"), [
    ("reference/transforms.py", "is not in this copy of the course"),
    ("tests/labs/test_transforms.py", "is not in this copy of the course"),
    ("tests/labs/test_my_own.py", "is of no lab, so its checks would not count")])
def test_a_copy_without_what_decides_marks_grades_nobody(
        path, sentence, house, monkeypatch, tmp_path):
    """Every answer is compared with nothing, and a whole class gets no points. Or checks in a new
    file are never run, and everybody passes them.
    """
    course = house(first_lab())
    if (course / path).exists():
        (course / path).unlink()
    else:
        put(course, {path: CHECKS})
    hand_in(tmp_path, ada=LAB)
    monkeypatch.setattr(places, "ROOT", course)
    with pytest.raises(ValueError, match=f"^{path} {sentence}"):
        grade.run(Request(tmp_path / "in", tmp_path / "out"))
    assert not list((tmp_path / "out").glob("*.*"))


def test_results_that_cannot_be_written_are_not_worked_for(tmp_path):
    """The first examination is over when the sentence comes."""
    hand_in(tmp_path, ada=LAB)
    (tmp_path / "out").write_text("mine")
    with pytest.raises(OSError, match=r"cannot write to .*out \(.*\): name in --out a folder"):
        grade.run(Request(tmp_path / "in", tmp_path / "out", "1", isolation="process"))


@pytest.mark.skipif(sys.platform != "linux", reason="strict needs Linux")
def test_strict_is_claimed_only_where_it_was_seen(monkeypatch):
    """A bwrap that leaves the network open counts as strict."""
    monkeypatch.setattr(sandbox.shutil, "which", lambda name: name)
    monkeypatch.setattr(sandbox, "open_ways", lambda level: (("the network",), 0))
    assert sandbox.available() == ("process", "bubblewrap leaves open: the network")


@pytest.mark.parametrize(("labs", "topics"), [
    (None, ["transforms", "rasterization", "sampling"]),
    ("1", ["transforms"]), ("2-3", ["rasterization", "sampling"]),
    ("3,1", ["transforms", "sampling"])])
def test_labs_are_chosen_by_number(labs, topics, monkeypatch):
    """A lab's deeper modules are left out, or an order of one's own; or no lab is graded."""
    monkeypatch.setattr(exercises, "topics", lambda: exercises.TOPICS[:3])
    assert exercises.topics_of(labs) == topics
    for wrong in ("4", "0-1", "x", "3-1", "", "1,", "1-", "-1", "1-999999999999", "1--2"):
        with pytest.raises(ValueError, match="there is no lab"):
            exercises.topics_of(wrong)
