"""Core, extra, fine print: what is open, what counts, and what is told of the rest."""
import shutil

import pytest
from made_up import check_text, exercise_text
from small_course import grade_command, grades, hand_in

REFERENCE = '"""Made up."""\n' + "".join((
    exercise_text("1.1", "double", "Twice x.\n\n    Fine print. Of nothing it is nothing.\n    ",
                  "return 2 * x", points=2),
    exercise_text("1.2", "half", "Half of x.", "# a comment of the answer", "return x / 2",
                  points=3, kind="extra")))
LAB = REFERENCE.replace("    return 2 * x", '    raise NotImplementedError("exercise 1.1: double")')
ROUGH = REFERENCE.replace("return 2 * x", "return 2 * x + (x == 0)")  # but for the fine print
OPENED = LAB.replace("(3 points)", "(3 points), open").replace(
    "    # a comment of the answer\n    return x / 2",
    '    raise NotImplementedError("exercise 1.2: half")')
CHECKS = "from labkit.checks import assert_close, exercise\n" + "".join((
    check_text("1.1", "nothing_stays_nothing", "Something.", "assert_close(impl.double(0.0), 0.0)",
               fine_print=True),
    check_text("1.1", "twice", "Once.", "assert_close(impl.double(1.0), 2.0)"),
    check_text("1.2", "half", "A third.", "assert_close(impl.half(3.0), 1.5)")))
FILES = {"reference/transforms.py": REFERENCE, "labs/transforms.py": LAB,
         "tests/labs/test_transforms.py": CHECKS}


@pytest.fixture
def root(house):
    """A course of one lab."""
    return house(FILES)


@pytest.fixture
def lab(root):
    return root / "labs" / "transforms.py"


@pytest.fixture
def run(root, run_here, run_module):
    """run(...) -> what a command says there."""
    def run(*command, status=0):
        run = run_module if command[0] == "grade" else run_here  # which starts others
        done = run(root, "course", *command)
        assert done.returncode == status, done.stdout + done.stderr
        return " ".join((done.stdout + done.stderr).split())

    return run


def test_a_lab_is_made_with_its_extras_complete(lab, run):
    """An extra is a TODO from the start; or counts as the student's work, and the lab stays old."""
    lab.write_text(LAB.replace("Made up", "Made"))
    run("skeleton")
    assert lab.read_text() == LAB


def test_an_extra_that_is_not_open_is_not_asked_for(run):
    """The board lists it, its points count, or nobody says that it is there."""
    board = run("check", status=1)
    assert "Lab 1 transforms 0 of 2" in board and "1.2" not in board
    assert "1 extra more, complete as they came; python3 -m course open 1 empties" in board
    assert run("check", "1.2", status=2) == (
        "course: 1.2 is an extra, and complete in labs/transforms.py; "
        "python3 -m course open 1.2 empties it for you to write")
    assert "1.2 half extra done" in run("check", "1.2", "--extra")


def test_an_extra_is_opened_and_closed_again(root, lab, run):
    """Its answer is lost, its mark stays, or what a student wrote is overwritten."""
    shutil.rmtree(root / "reference")  # as in a hand-out
    assert run("open", "1") == "1.2 half is open: write it in labs/transforms.py"
    assert lab.read_text() == OPENED
    assert run("open", "1.2") == "1.2 half is open already"
    board = run("check", status=1)
    assert "0 of 2" in board and "1.2 half extra not started" in board and "extra more" not in board
    assert run("close", "1.2") == "1.2 half is complete again"
    assert lab.read_text() == LAB
    run("open", "1-1")
    mine = OPENED.replace('raise NotImplementedError("exercise 1.2: half")', "return 0.5 * x")
    lab.write_text(mine)
    assert run("close", "1") == "1.2 half was worked on, and stays as it is"
    assert lab.read_text() == mine
    assert "1.2 half extra done" in run("check", status=1)


def test_a_released_solution_is_put_in_when_asked_for(root, lab, run):
    """Who is stuck cannot go on; or an answer is given away to who only closes extras; or labs are
    named as everywhere else, 1-4, and refused; or what never was complete is so "again".
    """
    assert run("close", "1", status=2) == (
        "course: 1 has no extra that is open; with --core, released solutions are put into the "
        "exercises of the core")
    assert run("open", "1.1", status=2) == (
        "course: 1.1 has no extra; what belongs to the core is open from the start")
    assert run("close", "1-1", "--core") == "1.1 double is complete"
    assert lab.read_text() == REFERENCE
    assert run("close", "1", "--core") == "1.1 double is complete already"
    assert run("close", "1.2", "--core", status=2) == "course: 1.2 has no extra that is open"
    shutil.rmtree(root / "reference")
    lab.write_text(LAB)
    assert run("close", "1", "--core") == (
        "1.1 double stays open: its solution is not released in this copy")


def test_the_question_gives_the_points_and_the_fine_print_is_told(lab, run):
    """The fine print takes points, or nobody hears of it."""
    lab.write_text(ROUGH)
    board = run("check")
    assert "2 of 2" in board and "1.1 double 2 of 2 done, fine print open" in board
    assert "All that was asked for is done, 2 of 2 points" in board
    assert "Left: the fine print of 1.1 double claim Nothing stays nothing (fine print)" in board
    lab.write_text(REFERENCE.replace("return 2 * x", "return 0.0"))
    assert "1.1 double 0 of 2 failing" in run("check", status=1)


def test_grades_are_of_the_core_and_of_extras_when_asked_for(root, run):
    """An extra that came complete gives points to everybody."""
    hand_in(root, ada=ROUGH)
    _, *command = grade_command(root)
    run(*command)
    row, = grades(root / "out").values()
    assert (row["total"], row["of"], row["fine print open"]) == ("2", "2", "1.1")
    assert "extras" not in row
    page = (root / "out/students/ada/report.html").read_text()
    assert "2 of 2 points" in page and "done, fine print open" in page
    run(*command, "--extra")
    row, = grades(root / "out").values()
    assert (row["core"], row["extras"], row["total"], row["of"]) == ("2", "3", "5", "5")
