"""Steps: asked on the way to an exercise, checked, and without points."""
import graded
import pytest
from made_up import check_text, exercise_text
from small_course import first_lab, grade_command, grades, hand_in

from labkit import verdicts
from labkit.lab_text import skeleton
from labkit.table import WHEN_DONE

WHOLE = '"""Made up."""\n' + "".join((
    exercise_text("1.1", "double", "Twice x.", "return 2 * x", points=0),
    exercise_text("1.2", "quadruple", "Four times x.", "return double(double(x))", points=4),
    exercise_text("1.3", "half", "Half of x.", "return x / 2", points=0),
    exercise_text("1.4", "quarter", "Half of the half.", "return half(half(x))", points=2)))
CHECKS = "from labkit.checks import assert_close, exercise\n" + "".join(
    check_text(number, name, "Something else.", f"assert_close(impl.{name}(3.0), {right})")
    for number, name, right in (("1.1", "double", 6.0), ("1.2", "quadruple", 12.0),
                                ("1.3", "half", 1.5), ("1.4", "quarter", 0.75)))
ALONE = {"double(double(x))": "4 * x", "half(half(x))": "x / 4"}
DONE = "All that was asked for is done"


def lab(*written, calls=True):
    """The lab in which these functions are written. calls: or without the steps."""
    whole, text = WHOLE, skeleton(WHOLE)
    for theirs, own in () if calls else ALONE.items():
        whole = whole.replace(theirs, own)
    for name in written:
        answer = whole.partition(f"def {name}(")[2].partition("return ")[2].partition("\n")[0]
        number = text.partition(f"def {name}(")[2].partition('("')[2].partition('")')[0]
        text = text.replace(f'raise NotImplementedError("{number}")', f"return {answer}")
    return text


@pytest.fixture(scope="module")
def course(house):
    return house(first_lab(WHOLE, CHECKS) | {"labs/transforms.py": skeleton(WHOLE)})


@pytest.fixture
def check(course, run_here):
    """check(the lab's text, what is asked for) -> (the status, what is said, in one line)."""
    def checked(text, *asked):
        (course / "labs" / "transforms.py").write_text(text)
        done = run_here(course, "course", "check", *asked)
        return done.returncode, " ".join(done.stdout.split())

    return checked


@pytest.mark.parametrize(("text", "status", "coming"), [
    (lab(), 1, ["1.1 double, not started"]),
    (lab("double"), 1, ["1.2 quadruple, not started"]),
    (lab("quadruple", calls=False), 1, ["1.3 half, not started"]),
    (lab("quadruple", calls=False).replace("4 * x", "5 * x"), 1, ["1.2 quadruple, failing"]),
    (lab("quadruple"), 1, ["1.1 double, not started"]),
    (lab("quadruple", "quarter", calls=False), 0, [WHEN_DONE]),
    (lab("double", "quadruple", "quarter", calls=False).replace("2 * x", "x"), 0,
     [WHEN_DONE, "1.1 double, failing"]),
], ids=["new", "a step is done", "without it", "wrong without it", "blocked", "all", "wrong step"])
def test_whoever_wants_begins_at_the_joined_function(check, text, status, coming):
    """A student is sent back to steps, or never to them, or is not done without them."""
    found, said = check(text)
    _, *told = said.split("Next: ")
    assert found == status and len(told) == len(coming), said
    assert [one[:len(right)] for one, right in zip(told, coming, strict=True)] == coming
    assert (f"{DONE}, 6 of 6 points" in said) == (status == 0)


def test_fine_print_is_open_where_it_is_wrong():
    """That of a caller fails with that of the step that it calls, and is told to be open, too."""
    lab = [graded.exercise(number, "f", 2) for number in ("1.1", "1.2")]
    found = [graded.check(one.number, verdict, verdict, fine_print=verdict == "failed")
             for one in lab for verdict in ("passed", "failed")]
    board = verdicts.entries({"transforms": lab}, ["1.1", "1.2"], {"1.2": ["1.1"]}, found)
    assert [entry.told for entry in board] == ["done, fine print open", "done"]


def test_the_board_has_steps_and_no_points_of_them(check):
    """A step looks like an exercise of 0 points, or its word is missing."""
    _, said = check(lab("half", "quadruple"))
    assert "Lab 1 transforms 0 of 6" in said
    for row in ("1.1 double step not started", "1.2 quadruple 0 of 4 blocked by 1.1",
                "1.3 half step done", "1.4 quarter 0 of 2 not started"):
        assert row in said


def test_a_step_alone_is_asked_for_as_any_exercise(check):
    """It is done before it is written, or is worth 0 of 0 points."""
    assert check(lab(), "1.1")[0] == 1
    status, said = check(lab("double"), "1.1")
    assert status == 0 and f"{DONE}. Next: python3 -m course check 1, for the rest" in said


def test_a_step_has_no_part_in_marks(house, run_module, tmp_path):
    """A wrong step costs what its joined function is worth; it has a column; it is not told."""
    hand_in(tmp_path, ada=WHOLE.replace("2 * x", "3 * x"), bob=lab("quadruple", calls=False))
    done = run_module(house(first_lab(WHOLE, CHECKS)), *grade_command(tmp_path))
    assert done.returncode == 0, done.stdout + done.stderr
    rows = grades(tmp_path / "out")
    assert [rows[name]["total"] for name in ("ada", "bob")] == ["6", "4"]
    titles = [title for title in rows["ada"] if title[0].isdigit()]
    assert titles == ["1.2 quadruple", "1.4 quarter"]
    report = (tmp_path / "out" / "students" / "ada" / "report.html").read_text("utf-8")
    assert "6 of 6 points" in report and "0 of 1 claim holds. To check it again" in report
    assert "0 points" not in report and ">step<" in report
