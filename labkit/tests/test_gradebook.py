"""From points to grades: import files, lateness, points by hand, and what changed since."""
import csv
import io
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path

import pytest
from graded import check, entry, exercise, record, result, submission

from labkit.grading.gradebook import earlier, lateness, overrides, rosters, tables, worth
from labkit.grading.gradebook.book import Gradebook
from labkit.grading.gradebook.sheets import written
from labkit.grading.pages import report
from labkit.grading.request import Request
from labkit.grading.results import Results, Run

ROSTERS = Path(__file__).with_name("rosters")
DUE = "2026-11-22T23:59+01:00"
EXERCISES = [exercise("2.1", "edge", 4), exercise("2.2", "cover", 6),
             exercise("2.9", "fast", 3, is_extra=True)]
CORE = EXERCISES[:2]


def found(*right):
    """What became of the first exercises: whether each is right; (True, False): its fine print not.
    """
    entries = []
    for asked, each in zip(EXERCISES, right, strict=False):
        done, *fine = each if isinstance(each, tuple) else (each,)
        checks = [check(asked.number, verdict="passed" if one else "failed", fine_print=is_fine)
                  for is_fine, one in ((False, done), *((True, one) for one in fine))]
        entries.append(entry(asked, "done" if done else "failing", *checks))
    return result(*entries)


RUN = Run(CORE, "process", "", "c")
RIGHT, WRONG, BROKEN = found(True, True), found(True, False), result(problem="broke off")


def graded(student, what=RIGHT, digest="d", **more):
    return record(submission(student)._replace(digest=digest), what, **more)


def read_back(content):
    return list(csv.reader(io.StringIO(content.decode("utf-8-sig"), newline="")))


def file(folder, name, *lines):
    (folder / name).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder / name


STUDENTS = {"ada": ["ada"], "Wei": ["wei_1", "wei_2"]}


def by_hand(folder, *lines):
    """A table of overrides."""
    return file(folder, "o.csv", "student,exercise,points,reason", *lines)


# --- rosters ----------------------------------------------------------------------------------

CLASSES = {  # platform: the assignment, {student: the number that the platform tells: row}
    "canvas": ("Lab 2", {"a": "50101", "l": "50104", "x": "999"}, {"a": 2, "l": 5}),
    "moodle": (None, {"a": "7001", "l": "7004", "x": "1"}, {"a": 0, "l": 3})}
CANVAS = {"csv": "canvas", "roster": ROSTERS / "canvas.csv", "assignment": "Lab 2 (880012)"}


def export(platform):
    return rosters.read(ROSTERS / f"{platform}.csv", platform, CLASSES[platform][0])


@pytest.mark.parametrize("platform", CLASSES)
def test_points_go_to_the_people_whose_id_was_submission(platform):
    """A namesake gets them, or somebody whose name is alike."""
    _, told, expected = CLASSES[platform]
    rows, unmatched = rosters.match(export(platform), [
        submission(student, platform, id=number) for student, number in told.items()])
    assert rows == expected and set(unmatched) == set(told) - set(expected)


@pytest.mark.parametrize("platform", CLASSES)
def test_an_import_file_is_the_export_with_one_column_filled(platform):
    """An umlaut, a comma, a line break or somebody's old points are lost."""
    before = (ROSTERS / f"{platform}.csv").read_bytes()
    expected, roster, rows = read_back(before), export(platform), CLASSES[platform][2].values()
    for row in rows:
        expected[row + 1][roster.column] = "8.5"
    content = rosters.filled(roster, dict.fromkeys(rows, "8.5"))
    assert read_back(content) == expected
    assert content.startswith(b"\xef\xbb\xbf") == before.startswith(b"\xef\xbb\xbf")


def test_what_the_platform_wrote_is_kept_in_its_own_way(tmp_path):
    """Semicolons become commas, CRLF becomes LF, a byte order mark comes that Canvas stumbles over.
    An Excel file in UTF-16 is not read, or one whose empty cells were cut off.
    """
    text = "LastName;FirstName;ID;Section;Lab 2 (12)\r\nKraus, J.;Jürgen;7\r\n"
    for encoding, mark in (("utf-8", b""), ("utf-8-sig", b"\xef\xbb\xbf"),
                           ("utf-16", b"\xef\xbb\xbf")):
        (tmp_path / "a.csv").write_bytes(text.encode(encoding))
        roster = rosters.read(tmp_path / "a.csv", "canvas")
        assert rosters.filled(roster, {0: "5"}) == mark + text.replace("7\r", "7;;5\r").encode()
        assert rosters.people(roster) == {0: "Jürgen Kraus, J."}
    (tmp_path / "a.csv").write_bytes(text.encode("latin-1"))
    with pytest.raises(ValueError, match=r"is not UTF-8 text .byte 53.: export it again"):
        rosters.read(tmp_path / "a.csv", "canvas")


@pytest.mark.parametrize(("platform", "name", "assignment", "sentence"), [
    ("canvas", "canvas", None, r"2 columns that take points: .* .Lab 1 .880011.; Lab 2 .880012.."),
    ("canvas", "canvas", "Lab 3", "0 columns called 'Lab 3'"),
    ("canvas", "moodle", None, "is not Canvas's gradebook's export: it has no column 'ID'"),
    ("moodle", "canvas", None, "is not Moodle's offline grading worksheet")])
def test_an_unclear_column_or_another_file_is_refused(platform, name, assignment, sentence):
    """The points of lab 2 go to lab 1, or a traceback comes out."""
    with pytest.raises(ValueError, match=sentence):
        rosters.read(ROSTERS / f"{name}.csv", platform, assignment)


def test_who_is_excused_stays_excused():
    """Canvas's EX becomes points."""
    known = book([submission("l", "canvas", id="50104")], **CANVAS | {"assignment": "Lab 1"})
    assert "l keeps the 'EX' that the roster has" in known.said()
    table = read_back(rosters.filled(known.roster, {known.rows["l"]: "7", 3: "7"}))
    assert [row[6] for row in table[5:8]] == ["7.50", "EX", "N/A"] and table[4][6] == "7"


def test_two_submissions_of_one_person_are_both_listed():
    """One of them is chosen, nobody knows why."""
    roster = export("canvas")
    twins = [submission(name, "canvas", id="50101") for name in "ab"]
    rows, unmatched = rosters.match(roster, twins)
    assert rows == {} and set(unmatched) == {"a", "b"}
    assert rosters.match(roster, [submission("ada")])[1] == {
        "ada": "what was handed in tells nothing that the roster has, too"}


def test_gradescope_s_submissions_find_their_row_in_the_lms():
    """Work from Gradescope can be graded, and its points must be typed in by hand."""
    one = submission("a", "gradescope", id="s1002", email="juergen@uni.example")
    for platform in CLASSES:
        roster = export(platform)
        row, = rosters.match(roster, [one])[0].values()
        assert "Jürgen" in " ".join(roster.sheet.rows[row])


# --- lateness ---------------------------------------------------------------------------------


@pytest.mark.parametrize(("late", "grace", "seconds", "told", "percent"), [
    ("10%/day", None, 0, "", 0), ("10%/day", None, 1, "0:00:01", 10),
    ("10%/day", "1h", 3600, "1:00:00", 0), ("10%/day", "1h", 3601, "1:00:01", 10),
    ("10%/day", None, 86400, "1 day, 0:00:00", 10), ("10%/day", None, 86401, "1 day, 0:00:01", 20),
    ("2.5%/hour", "15min", 7300, "2:01:40", 7.5), ("30%/day", "1d", 9 * 86400,
                                                    "9 days, 0:00:00", 100),
    (None, None, 60, "0:01:00", 0), ("10%/day", None, -60, "", 0)])
def test_each_begun_step_takes_its_share(late, grace, seconds, told, percent):
    """The last second of a day costs another one, or the grace costs something, or below zero."""
    policy = lateness.policy(DUE, late, grace)
    when = datetime(2026, 11, 22, 22, 59, tzinfo=UTC).timestamp() + seconds
    judged = lateness.judged(policy, when, None)
    assert (judged.late_by, judged.percent) == (told, percent)
    assert datetime.fromisoformat(judged.handed_in).timestamp() == when
    assert judged.handed_in.endswith("+01:00")


@pytest.mark.parametrize(("options", "sentence"), [
    ({"late": "10%/day"}, "need --due"), ({"grace": "1h"}, "need --due"),
    ({"due": "2026-11-22"}, "is no date with a time"), ({"due": "Sunday"}, "no date with a time"),
    ({"due": DUE, "late": "10/day"}, "is no share"), ({"due": DUE, "late": "101%/day"}, "no share"),
    ({"due": DUE, "late": "0%/day"}, "is no share"), ({"due": DUE, "grace": "1"}, "is no duration"),
    ({"csv": "canvas"}, "belong together"), ({"roster": "a.csv"}, "belong together"),
    ({"assignment": "Lab 2"}, "belong together")])
def test_options_that_cannot_be_used_are_refused_before_anything_is_graded(options, sentence):
    """--due 2026-11-22 means midnight before that day, and all are late. A forgotten option is
    noticed after an hour of grading.
    """
    with pytest.raises(ValueError, match=sentence):
        book([], **options)


@pytest.mark.parametrize("text", [
    "Monday, 23 November 2026, 2:00 AM", "Monday, November 23, 2026, 2:00\u202fAM",
    "23 November 2026, 02:00"])
def test_moodle_s_times_are_read_in_the_deadline_s_zone(text):
    """Two hours late are one hour early, somewhere east."""
    zone = timezone(timedelta(hours=1))
    assert lateness.moodle_time(text, zone) == datetime(2026, 11, 23, 1, tzinfo=UTC).timestamp()
    assert lateness.moodle_time("Montag, 23. November 2026, 02:00", zone) is None


# --- the gradebook ----------------------------------------------------------------------------


def book(class_, **asked):
    return Gradebook(Request("in", "out", **asked), class_, CORE)


def test_moodle_tells_in_its_worksheet_when_something_was_submission(tmp_path):
    """Everybody from Moodle is in time, or the file's own time counts."""
    class_ = [submission(name, "moodle", id=f"700{row}") for row, name in enumerate("akl", 1)]
    known = book(class_, csv="moodle", roster=ROSTERS / "moodle.csv", due=DUE, late="10%/day")
    records = {one.student: known.entered(record(one, RIGHT)) for one in class_}
    assert [worth.after_lateness(each) for each in records.values()] == [10, 9, 8]
    known.write(tmp_path, records)
    table = read_back((tmp_path / "for-moodle.csv").read_bytes())
    assert [row[5] for row in table] == ["Grade", "10", "9", "8", ""]


def test_a_group_s_time_on_moodle_is_that_of_who_handed_in_for_it():
    """Only who handed in for the group pays for its being late."""
    class_ = [submission(name, "people", name=name)._replace(group="blue")
              for name in ("7002", "7004")]
    known = book(class_, csv="moodle", roster=ROSTERS / "moodle.csv", due=DUE, late="10%/day")
    assert [worth.after_lateness(known.entered(record(one, RIGHT))) for one in class_] == [9, 9]


def test_a_time_that_was_not_told_is_no_earlier_one():
    """Who was graded first without Moodle's worksheet is never late."""
    one = submission("k", "moodle", id="7002")._replace(texts={"transforms": "x"})
    known = book([one], csv="moodle", roster=ROSTERS / "moodle.csv", due=DUE, late="10%/day")
    (counts,) = known.counting(one, one, "newest")
    assert worth.after_lateness(known.entered(record(counts, RIGHT))) == 9


def test_canvas_says_late_and_not_by_how_much(tmp_path):
    """A guess takes points off. Or a late submission looks like all others."""
    class_ = [submission("a", "canvas", id="50101", late=True),
              submission("b", "canvas", id="50102", late=False), submission("c")]
    known = book(class_, due=DUE, late="10%/day")
    cells = {one.student: tables.line(known.entered(record(one, RIGHT)), CORE) for one in class_}
    assert [cells[name]["late by"] for name in "abc"] == [lateness.NOT_TOLD, "", lateness.NO_TIME]
    assert {cells[name]["after lateness"] for name in "abc"} == {"10"}
    assert "a is late, by how much is not told. Nothing is taken off" in "\n".join(known.said())
    path = by_hand(tmp_path, "a,late,1.5,came by mail")
    settled = book(class_, due=DUE, late="10%/day", overrides=path)
    assert settled.said() == []
    assert tables.line(settled.entered(graded("a")), CORE)["after lateness"] == "8.5"


def test_all_without_a_partner_are_told():
    """A submission without a row, or a person without a submission, is noticed in the exam."""
    class_ = [submission("a", "canvas", id="50101"), submission("x", "canvas", id="9")]
    known = book(class_, **CANVAS)
    said = "\n".join(known.said())
    assert ": 1 of 2; their points go" in said
    assert "not matched: x: nobody in the roster with the id 9" in said
    assert "in the roster without a submission (5): Kraus, Jürgen; Li, Wei; Li, Wei" in said


def test_who_could_not_be_graded_keeps_the_cell(tmp_path):
    """A crash of ours is a zero in the gradebook."""
    known = book([submission("k", "canvas", id="50102")], **CANVAS)
    known.write(tmp_path, {"k": graded("k", BROKEN)})
    assert read_back((tmp_path / "for-canvas.csv").read_bytes())[4][7] == "3.00"


@pytest.mark.parametrize("platform", CLASSES)
def test_another_maximum_there_is_told(platform):
    """10 of 13 points are imported as 10 of 10."""
    known = Gradebook(Request("in", "out", csv=platform, roster=ROSTERS / f"{platform}.csv",
                              assignment=CLASSES[platform][0]), [], EXERCISES)
    assert "is out of 10 there, and out of 13 here" in known.said()[-1]


# --- by hand ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("line", "sentence"), [
    ("adda,2.1,3,x", "nobody called 'adda'"),
    ("Wei,2.1,3,x", r"2 called 'Wei' handed in anything \(wei_1, wei_2\): write the name as in"),
    ("ada,2.7,3,x", "'2.7' is not graded"),
    ("ada,2.1,3,", "no reason for ada's 2.1"), ("ada,2.1,5,x", "'5' is no number of points from 0"),
    ("ada,2.1,-1,x", "from 0 to 4"), ("ada,2.1,nan,x", "from 0 to 4"), ("ada,2.1,,x", "from 0 to"),
    ("ada,total,11,x", "from 0 to 10"), ("ada", "'' is not graded"),
    ("ada,2.2,1,x", "was given in a line above")])
def test_a_wrong_override_is_refused_by_its_line(tmp_path, line, sentence):
    """It is left out silently, or changes somebody else's points."""
    path = by_hand(tmp_path, "", 'ada,2.2,6,"a reason', 'in two lines"', line)
    with pytest.raises(ValueError, match=f"o.csv, line 5: .*{sentence}"):
        overrides.read(path, STUDENTS, CORE)
    path = file(tmp_path, "o.csv", "student,exercise,points")
    with pytest.raises(ValueError, match="no column reason"):
        overrides.read(path, STUDENTS, CORE)


def test_points_by_hand_show_with_their_reason(tmp_path):
    """Nobody knows in May why Ada has 9.5 points."""
    path = file(tmp_path, "o.csv", "student;exercise;points;reason",
                "ada;2.2;5,5;the <b>figure</b> was right", "ada;late;0;was ill")
    given = overrides.read(path, STUDENTS, CORE)["ada"]
    ada = graded("ada", WRONG, overrides=given, late=("2:00:00", 50))
    cells = tables.line(ada, CORE)
    assert (cells["2.2 cover"], cells["total"], cells["after lateness"]) == ("5.5", "9.5", "9.5")
    assert cells["by hand"] == ("2.2: 5.5 instead of 0 by hand (the <b>figure</b> was right); "
                                "late: 0 taken off by hand (was ill)")
    page = report.page(ada, {}, "")
    assert "9.5 of 10 points" in page and "2.2: 5.5 instead of 0 by hand" in page
    assert "&lt;b&gt;figure" in page and "handed in late by 2:00:00: 0 is taken off" in page


def test_a_total_by_hand_comes_before_lateness():
    """Lateness is taken off twice, or not at all."""
    bob = graded("bob", overrides={"total": (8, "oral")}, late=("1:00:00", 10))
    assert (worth.total(bob), worth.taken_off(bob), worth.after_lateness(bob)) == (8, 0.8, 7.2)
    ill = graded("eve", BROKEN, overrides=bob.overrides)
    assert worth.is_graded(ill) and worth.after_lateness(ill) == 8


def test_a_page_follows_its_override_without_grading_again(tmp_path):
    """--resume keeps a page that says 4 points, beside a table that says 10."""
    one = submission("ada")
    drawn = check("2.2", verdict="failed", picture="out/checks/1.png")
    what = result(WRONG.entries[0], entry(CORE[1], "failing", drawn))
    Results(tmp_path, book([one]), RUN).add(one, 0, "same", what, {"1.png": b"png"})
    page = tmp_path / "students" / "ada" / "report.html"
    assert "4 of 10 points" in page.read_text("utf-8")
    path = by_hand(tmp_path, "ada,2.2,6,right after all")
    again = Results(tmp_path, book([one], overrides=path), RUN)
    assert not again.keep(one, "another") and again.keep(one, "same")
    text = page.read_text("utf-8")
    assert "10 of 10 points" in text and "right after all" in text and "base64,cG5n" in text


def test_who_was_graded_earlier_is_in_the_import_file(tmp_path):
    """The points of all who were in time are missing beside those who came late, or are those that
    an exercise had then.
    """
    first, second = (submission("a", "canvas", id="50101"), submission("k", "canvas", id="50102"))
    Results(tmp_path, book([first], **CANVAS), RUN).add(first, 0, "", RIGHT, {})
    (before,), _ = earlier.records(tmp_path, [second], CORE)
    with pytest.raises(ValueError, match="for other labs or points"):
        earlier.records(tmp_path, [second], [one._replace(points=9) for one in CORE])
    later = Results(tmp_path, book([second, before.work], **CANVAS), RUN)
    later.take(before, before.work)
    later.add(second, 0, "", RIGHT, {})
    assert tmp_path / "for-canvas.csv" in later.close()
    table = read_back((tmp_path / "for-canvas.csv").read_bytes())
    assert [row[7] for row in table[3:6]] == ["10", "10", ""]


# --- tables -----------------------------------------------------------------------------------


def test_core_fine_print_and_extras_have_columns_of_their_own():
    """They are in one sum, or nowhere."""
    cells = tables.line(graded("ada", found((True, True), (True, False), True)), EXERCISES)
    assert cells == cells | {
        "core": "10", "core of": 10, "extras": "3", "extras of": 3, "total": "13", "of": 13,
        "fine print open": "2.2"}
    assert "extras" not in tables.line(graded("ada"), CORE)
    lost = tables.line(graded("eve", BROKEN), CORE)
    assert {lost[name] for name in ("core", "total", "after lateness", "fine print open")} == {""}


@pytest.mark.parametrize("begins", list("=+-@\t\r"))
def test_no_cell_of_ours_is_a_formula(begins):
    """=HYPERLINK(...) in a reason runs in the instructor's spreadsheet."""
    odd = graded("ada", result(problem=f"{begins}1"), overrides={"total": (8, "x")})
    content = written(tables.grades([odd], CORE))
    assert not any(cell.startswith(begins) for row in read_back(content) for cell in row)


def test_a_row_has_what_the_platform_knows_and_each_note_apart():
    """Points that nobody can bring back; two notes that look like three; José as JosÃ© in Excel."""
    work = submission("s1", notes=["a; b", "c"], id="7", name="José", email="j@x.edu")
    content = written(tables.grades([record(work, RIGHT)], CORE))
    head, cells = read_back(content)
    row = dict(zip(head, cells, strict=True))
    assert [row[title] for title in ("student", "name", "id", "email", "notes")] == [
        "s1", "José", "7", "j@x.edu", "a, b; c"]
    assert content.decode("utf-8-sig") != content.decode("utf-8")


# --- what changed -----------------------------------------------------------------------------


@pytest.mark.parametrize(("before", "now", "rows"), [
    ({"what": WRONG}, {"digest": "e"}, [
        ("2.2", "0", "6", "handed in again"), ("total", "4", "10", "handed in again"),
        ("after lateness", "4", "10", "handed in again")]),
    ({"what": WRONG}, {"checks": "b"}, [("2.2", "0", "6", "other checks")]),
    ({"what": WRONG}, {}, [("2.2", "0", "6", worth.SAME)]),
    ({"what": WRONG}, {"what": WRONG, "overrides": {"2.2": (5, "look")}}, [
        ("2.2", "0", "5", "by hand"), ("total", "4", "9", "by hand")]),
    ({}, {"late": ("2:00:00", 10)}, [("after lateness", "10", "9", "lateness")]),
    ({}, {"what": BROKEN}, [("2.1", "4", "", "one of the two could not be graded")]),
    ({}, {"checks": "b"}, [])])
def test_a_change_is_told_with_its_cause(before, now, rows):
    """A mark is another one than last week, and nobody can say why."""
    told = [row[1:] for row in worth.changes(graded("ada", **before), graded("ada", **now))]
    assert told[:len(rows)] == rows and bool(told) == bool(rows)
