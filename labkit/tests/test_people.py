"""Groups, and due times of single students."""
import csv
import shutil
from pathlib import Path

import pytest
from graded import entry, exercise, record, result, submission
from submitted import put

from labkit.grading.apart import typed_json
from labkit.grading.gradebook import earlier, people
from labkit.grading.gradebook.book import Gradebook
from labkit.grading.gradebook.lateness import moment
from labkit.grading.gradebook.worth import after_lateness
from labkit.grading.request import Request

CANVAS = Path(__file__).parent / "rosters" / "canvas.csv"
LAB = exercise("2.1", "edge", 10)
DUE = "2026-11-22T23:59+01:00"
HANDED_IN = moment(DUE).timestamp() + 60  # a minute late
GROUP = submission("blue_50102", "canvas", when=HANDED_IN, id="50102", name="blue")
ALONE = submission("nalvarez_50101", "canvas", when=HANDED_IN, id="50101")


@pytest.fixture
def read(tmp_path):
    """read("ada,blue,", ...) -> the lines of such a people.csv."""
    def lines(*lines):
        path = tmp_path / "people.csv"
        path.write_text("\n".join(("student,group,due", *lines)), encoding="utf-8")
        return people.read(path, moment(DUE).tzinfo)

    return lines


def graded(persons, **asked):
    """-> the book, and {student: record} of GROUP and ALONE, who are all right."""
    class_ = people.with_members([GROUP, ALONE], persons)
    book = Gradebook(Request("in", "out", due=DUE, late="10%/day", **asked), class_, [LAB], persons)
    right = result(entry(LAB, "done"))
    return book, {one.student: book.entered(record(one, right)) for one in class_}


@pytest.mark.parametrize("name", ["50102", "jkraus", '"Kraus, Jürgen"'])
def test_a_group_s_points_go_to_each_member(read, tmp_path, name):
    """A group's points are typed by hand, or the member whose id Canvas gives it is refused. Or a
    mark that somebody typed in is written over without a word.
    """
    book, records = graded(read(f"{name},blue_50102,", "50103,blue,"), csv="canvas", roster=CANVAS,
                           assignment="Lab 2")
    book.write(tmp_path, records)
    rows = csv.reader(tmp_path.joinpath("for-canvas.csv").open(encoding="utf-8-sig"))
    points = {row[1]: row[7] for row in rows if row[1].isdecimal()}
    assert points == {"50101": "9", "50102": "9", "50103": "9", "50104": "", "50105": "",
                      "50199": ""}
    replaced = tmp_path.joinpath("replaced.csv").read_text(encoding="utf-8-sig").splitlines()
    assert replaced == ["name,in the roster,now", '"Kraus, Jürgen",3.00,9']


def test_a_group_and_its_members_are_not_in_one_table(read, tmp_path):
    """--people after a first run ends in an error; or who left the group keeps its points."""
    members = people.with_members([GROUP], read("x,blue,", "y,blue,"))
    for before, now in ([GROUP], members), (members, [GROUP]), (members, members[:1]):
        for one in before:
            kept = typed_json.dumps(record(one, result(entry(LAB, "done"))))
            put(tmp_path, {f"students/{one.student}/record.json": kept})
        gone = [one.student for one in before if one not in now]
        assert earlier.records(tmp_path, now, [LAB]) == ([], gone)
        shutil.rmtree(tmp_path / "students")


@pytest.mark.parametrize("name", ["nalvarez_50101", "50101"])
def test_an_extension_is_a_date(read, name):
    """It is a line `late,0` by hand for each lab, or everybody's. Or a time without a zone is this
    machine's, where --due names one.
    """
    _, records = graded(read(f"{name},,2026-11-23T00:00", "x,50102,"))
    assert {student: after_lateness(one) for student, one in records.items()} == {
        "nalvarez_50101": 10, "x": 9}
    _, records = graded(read(f"{name},,2026-11-21T23:59", "x,50102,2026-11-25T12:00"))
    assert {student: after_lateness(one) for student, one in records.items()} == {
        "nalvarez_50101": 8, "x": 10}


@pytest.mark.parametrize(("lines", "sentence"), [
    (["ada,,"], "line 2: give a student, and a group or a due time"),
    (["ada,50102,", "ada,,2026-11-23T00:00"], "line 3: ada has a line above, too"),
    (["ada,,tomorrow"], "line 2: tomorrow is no date with a time"),
    (["50101,50102,"], "line 2: 50101 is there alone, too: take one of the two out"),
    (["A b,50102,", "a_B,50102,"], "line 3: a_B is there alone, too")])
def test_a_wrong_line_is_refused(read, lines, sentence):
    """Two people are one, or somebody's extension is left out."""
    with pytest.raises(ValueError, match=sentence):
        graded(read(*lines))


def test_a_name_that_fits_nobody_is_told(read):
    """A misspelt name is one without an extension."""
    book, _ = graded(read("nalvares,,2026-11-23T00:00", "x,9000,", "50103,50102,", "50101,blu,"))
    said = [line for line in book.said() if "people.csv" in line]
    assert [line.partition(": ")[2] for line in said] == [
        "nothing was handed in by nalvares", "nothing was handed in by 9000",
        "nothing was handed in by blu"]
    wei = [submission(f"wei_{number}", "canvas", id=str(number), name="Wei") for number in (1, 2)]
    assert people.said(wei, read("Wei,,2026-11-23T00:00"))[0].endswith(
        "line 2: 2 are called so, and the line counts for none: wei_1, wei_2")
