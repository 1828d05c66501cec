"""The progress board: verdicts, points, what comes next, exit status."""
import io
import json
import signal
import subprocess
import sys
import time

import graded
import pytest
from made_up import SPOILT, check_text, exercise_text
from rich.console import Console

from labkit import board, exercises, places

REFERENCE = '"""Made up."""\n' + "".join((
    exercise_text("1.1", "double", "Twice x.", "return 2 * x", points=2),
    exercise_text("1.2", "half", "Half of x.", "return x / 2", points=3),
    "\n\ndef between(x):\n    return half(x)\n",
    exercise_text("1.3", "quarter", "Half of the half.", "return half(between(x))"),
    exercise_text("1.4", "mask", "Not started.", "return n", points=4, inputs="n"),
    exercise_text("1.5", "area", "Calls mask.", "return mask(n)", points=2, inputs="n"),
    exercise_text("1.6", "unchecked", "Without a check.", "return x", points=5),
    exercise_text("1.7", "skipped", "Its only check is skipped.",
                  "return rasterization.twice(x)")))

LAB = "# Mine.\n" + REFERENCE.replace("return x / 2", "return x / 3").replace(
    "return n\n", 'raise NotImplementedError("exercise 1.4: mask")\n')

CHECKS = "import pytest\n\nfrom labkit.checks import assert_close, exercise\n" + "".join((
    check_text("1.1", "twice", "Once.", "assert_close(impl.double(2.0), 4.0)"),
    check_text("1.2", "half_of_nothing", "Something.", 'print("nothing")',
          "assert_close(impl.half(0.0), 0.0)"),
    check_text("1.2", "half_of_three", "A third.", 'print("three")',
          "assert_close(impl.half(3.0), 1.5)"),
    check_text("1.3", "quarter_of_one", "A third of the third.",
          "assert_close(impl.quarter(1.0), 0.25)"),
    check_text("1.4", "mask_is_masked", "It is not.", "assert_close(impl.mask(2), 2)"),
    check_text("1.5", "area_is_counted", "It is not.", "assert_close(impl.area(2), 2)"),
    check_text("1.7", "skipped", "Left out.", marks=["@pytest.mark.skip"]),
    "\n\ndef test_of_given_code(impl):\n    assert impl.between(2.0) == 1.0\n"))

SECOND = exercise_text("2.1", "twice", "Twice x.", "return 2 * x", points=3).lstrip()

SECOND_CHECKS = "from labkit.checks import assert_close, exercise\n" + check_text(
    "2.1", "twice_is_more", "Less.", "x = rng.random()", "assert_close(impl.twice(x), x + x)",
    inputs="impl, rng")

FILES = {
    "reference/transforms.py": REFERENCE, "labs/transforms.py": LAB,
    "reference/rasterization.py": SECOND, "labs/rasterization.py": SECOND,
    "tests/labs/test_transforms.py": CHECKS, "tests/labs/test_rasterization.py": SECOND_CHECKS,
    "notebooks/01_transforms.ipynb": ""}


@pytest.fixture(scope="module")
def course(house):
    return house(FILES)


@pytest.fixture(scope="module")
def check(course, run_here):
    return lambda *asked: run_here(course, "course", "check", *asked)


def lines(text):
    return [line.rstrip() for line in text.splitlines()]


def test_the_board_shows_every_lab_and_below_what_to_do_next_and_why_it_fails(check):
    """Points for a part of the checks, a blocked exercise that seems wrong, a lab left out. The
    first exercise that fails is passed over, or its first check shown, which passes.
    """
    done = check()
    assert done.stderr == ""
    assert lines(done.stdout) == [
        "Lab 1  transforms     3.5 of 18  ###.................",
        "  1.1  double         2 of 2     done",
        "  1.2  half           1.5 of 3   failing",
        "  1.3  quarter        0 of 1     blocked by 1.2",
        "  1.4  mask           0 of 4     not started",
        "  1.5  area           0 of 2     blocked by 1.4",
        "  1.6  unchecked      0 of 5     failing",
        "  1.7  skipped        0 of 1     failing",
        "Lab 2  rasterization  3 of 3     ####################",
        "  2.1  twice          3 of 3     done",
        "",
        "Next: 1.2 half, failing",
        "points    1.5 of 3 points: 1 of 2 claims hold",
        "claim     Half of three",
        "perhaps   A third.",
        "given     half(x=3.0)",
        "expected  1.5",
        "got       1.0",
        "differs   by 0.5; allowed 1e-12 + 1e-09 |expected|",
        "check     tests/labs/test_transforms.py:23",
        "          assert_close(impl.half(3.0), 1.5)",
        "printed   three",
        "again     python3 -m course check 1.2",
        "read      labs/transforms.py:10, the docstring is the question",
        "          notebooks/01_transforms.ipynb",
        "stuck     the solution is in reference/transforms.py"]
    assert done.returncode == 1


DONE = ("All that was asked for is done, {0} of {0} points. "
        "Next: python3 -m course check{1}, for the rest")


@pytest.mark.parametrize(("asked", "number", "next_line"), [
    ("1.1", "1.1", DONE.format(2, " 1") + " of the lab."),
    ("rasterization", "2.1", DONE.format(3, "") + "."),
    ("1.3", "1.3", "Next: 1.2 half, failing"),
    ("1.4", "1.4", "Next: 1.4 mask, not started"),
    ("1.6", "1.6", "Next: 1.6 unchecked, failing"),
    ("2 --impl reference", "2.1", DONE.format(3, "") + "."),
    ("1.2 --impl reference", "1.2", DONE.format(3, " 1") + " of the lab.")])
def test_the_status_is_0_only_if_all_that_was_asked_for_passes(check, asked, number, next_line):
    """More is judged than was asked for, or a lab passes because nothing was run."""
    done = check(*asked.split())
    table, _, below = done.stdout.partition("\n\n")
    assert [line.split()[0] for line in lines(table) if not line.startswith("Lab")] == [number]
    assert lines(below)[0] == next_line
    assert done.returncode == (not next_line.startswith("All"))


def test_an_exercise_without_a_check_says_so(check):
    """It is done, as nothing fails."""
    assert "wrong     it has no check in tests/labs/test_transforms.py" in check("1.6").stdout


def test_an_exercise_of_another_file_is_named(check):
    """Lab 1's mistake shows in lab 4, and one looks for it there."""
    assert "uses      your own 2.1 twice: a mistake there" in check("1.7").stdout


@pytest.mark.parametrize("target", ["1.8", "3", "sampling", "tests", ""])
def test_an_unknown_target_is_told_with_what_there_is(course, monkeypatch, target):
    """Nothing is checked, and that counts as passed."""
    monkeypatch.setattr(places, "ROOT", course)
    with pytest.raises(ValueError) as error:
        board.check(target)
    assert str(error.value) == (
        f'there is no lab or exercise "{target}"; give a lab (1, 2), a file of it '
        "(transforms, rasterization), or an exercise, as in 2.1")


def test_other_settings_reach_the_checks_and_the_command_that_repeats_them(check):
    """The numbers that failed cannot be drawn again."""
    done = check("1.2", "--seed", "7", "--impl", "labs/../labs")
    assert "again     python3 -m course check 1.2 --impl labs/../labs --seed 7\n" in done.stdout


def test_checks_that_cannot_be_trusted_spoil_the_board(house, run_here):
    """A file that cannot be read, a check of no exercise or a broken fixture pass in silence."""
    root = house(FILES | {
        "tests/labs/test_rasterization.py": "import nothing\n",
        "tests/labs/test_transforms.py": CHECKS.replace('"1.7"', '"1.9"').replace(
            "half_of_nothing(impl)", "half_of_nothing(impl, spoilt)") + SPOILT})
    done = run_here(root, "course", "check", "--impl", "reference")
    assert ("tests/labs/test_rasterization.py cannot be collected: "
            "ModuleNotFoundError: No module named 'nothing'") in done.stdout
    assert ("tests/labs/test_transforms.py::test_skipped names exercise 1.9, "
            "and there is none") in done.stdout
    assert "  2.1  twice          0 of 3      failing" in done.stdout
    assert "  1.2  half           1.5 of 3    failing" in done.stdout
    assert "wrong     OSError: spoilt" in done.stdout
    done = run_here(root, "course", "check", "1.1")
    assert "All that was asked for is done" in done.stdout
    assert done.returncode == 1


def test_a_test_run_that_breaks_off_spoils_the_board(house, run_here):
    """No check has failed, as none has run."""
    settings = '[tool.pytest.ini_options]\npythonpath = ["."]\naddopts = "--nonsense"\n'
    done = run_here(house(FILES | {"pyproject.toml": settings}), "course", "check", "2")
    assert done.returncode == 1
    assert "pytest broke off" in done.stdout
    assert "--nonsense" in done.stderr


def test_nobody_s_own_settings_for_pytest_change_the_verdict(check, monkeypatch):
    """A PYTEST_ADDOPTS in the user's shell runs no check, and no board is as another."""
    monkeypatch.setenv("PYTEST_ADDOPTS", "--collect-only")
    assert "All that was asked for is done" in check("2").stdout


def entry(number, verdict, *of_checks):
    checks = (graded.check(number, f"claim {k}", text, f"for it is {text}")
              for k, text in enumerate(of_checks))
    return graded.entry(graded.exercise(number, "f", 2), verdict, *checks, topic="transforms")


@pytest.mark.parametrize(("entries", "text"), [
    ([entry("1.1", "failing", "passed", "blocked by 2.1", "failed", *["failed"] * 5)],
     "Next: 1.1 f, failing\npoints    0 of 2 points: 1 of 8 claims hold\n"
     "claim     claim 2\nfor it is failed\n"
     "fails too claim 3; claim 4; claim 5; 3 more\n"
     "picture   out/x.png\n          claim 7\nagain     python3 -m course check 1.1\n"),
    ([entry("1.1", "done", "passed"), entry("1.2", "blocked by 1.3", "failed"),
      entry("1.3", "not started", "not started")],
     "Next: 1.3 f, not started\nclaim     claim 0\nagain     python3 -m course check 1.3\n"),
    ([entry("1.1", "done", "passed"), entry("1.2", "blocked by 2.1", "blocked by 2.1")],
     "Next: 1.2 f, blocked by 2.1\nclaim     claim 0\nfor it is blocked by 2.1\n"
     "again     python3 -m course check 2.1\n"),
], ids=["failing", "blocked by a later one", "blocked by another lab"])
def test_next_is_what_can_be_worked_on_with_the_check_that_says_why(entries, text):
    """A student is sent to an exercise that is done, or that waits for another."""
    entries[0].checks[-1] = entries[0].checks[-1]._replace(picture=str(places.ROOT / "out/x.png"))
    said = board.next_to_do(entries, "labs", 0)
    assert said.startswith(text)
    assert ("close 2.1 --core puts it in" in said) == ("blocked by 2.1" in said)


def test_a_lab_of_steps_alone_has_no_points():
    """0 of 0, and a bar of dots: nothing is to be had, and it looks like nothing done."""
    step = entry("1.1", "failing", "failed")._replace(points=0)
    assert board.title_row(1, "transforms", [step]) == ("Lab 1", "transforms")


def test_pictures_of_what_failed_are_listed_and_opened(tmp_path, monkeypatch, capsys):
    """A picture that is there is not found, or a browser is opened where all is done."""
    opened = []
    monkeypatch.setattr(places, "ROOT", tmp_path)
    monkeypatch.setattr(board.webbrowser, "open", opened.append)
    board.open_pictures([entry("1.1", "done", "passed"), entry("1.2", "not started")], 0)
    assert not opened and capsys.readouterr().out == ""
    picture = places.out("checks", "x.png")
    picture.write_bytes(b"a picture")
    failing = entry("1.3", "failing", "failed", "passed")
    failing.checks[0] = failing.checks[0]._replace(picture=str(picture))
    board.open_pictures([failing], 0)
    page = tmp_path / "out" / "checks" / "failed.html"
    assert opened == [page.as_uri()]
    assert lines(capsys.readouterr().out)[2:] == ["out/checks/x.png", "out/checks/failed.html"]
    assert "for it is failed" in page.read_text() and "image/png;base64,YSBwaWN" in page.read_text()


def test_a_file_that_is_not_python_is_one_line(house, run_here):
    """Every check of the lab fails, each with the same traceback, and other labs are not run."""
    root = house(FILES | {"labs/transforms.py": LAB.replace("return 2 * x", "return 2 * (x")})
    done = run_here(root, "course", "check")
    assert lines(done.stdout)[:2] == ["Lab 1  transforms     0 of 18  ....................",
                                      "  1.1  double         0 of 2   not readable"]
    assert lines(done.stdout)[-3:] == [
        "  2.1  twice          3 of 3   done", "",
        "labs/transforms.py, line 7: this is not Python ('(' was never closed); mend it first"]
    assert done.returncode == 1 and done.stderr == ""


LECTURE = {"cells": [
    {"cell_type": "markdown", "source": ["# Twice\n", "`thrice` comes later.\n"]},
    {"cell_type": "markdown", "source": ["## 1. Once\n", "Here is 2.1, and `once`.\n"]},
    {"cell_type": "code", "source": ["# 2.1\n", "half(2.1)\n"]},
    {"cell_type": "markdown",
     "source": "*Exercises 2.15 and 2.2 to 2.4.*\n## 2. Twice\n*Exercise 2.1*"},
    {"cell_type": "markdown", "source": ["## Exercises\n", "| 1 | 2.1 `twice`, 2.5 `fifth` |"]}]}


@pytest.mark.parametrize(("number", "section"), [
    ("2.1", "2. Twice"), ("2.2", "1. Once"), ("2.3", "1. Once"), ("2.15", "1. Once"),
    ("2.5", None)])
def test_the_section_of_an_exercise_is_found(tmp_path, number, section):
    """A student is sent to the section before, to that of 2.15, or to a number that is none."""
    (tmp_path / "lecture.ipynb").write_text(json.dumps(LECTURE))
    found = board.sections(tmp_path / "lecture.ipynb")
    assert found.get(number, (None, None))[1] == section
    assert list(found) == ["2.15", "2.2", "2.3", "2.4", "2.1"]


def test_each_exercise_of_the_course_has_its_section():
    """A lecture leads to no exercise, or "7.10 to 7.16" to its two ends only."""
    for topic in exercises.asking_topics():
        for exercise in exercises.topic_exercises(topic):
            assert all(board.sections(*exercises.pages(topic))[exercise.number])
    assert list(board.numbers_in("*Extras 7.10 to 7.12 and 8.2.*\n(extra 1.4) 2.2\n**Step 2.3**")
                ) == ["7.10", "7.11", "7.12", "8.2", "1.4", "2.3"]


def test_the_next_exercise_is_the_one_that_the_lecture_reaches_next(monkeypatch):
    """After 1.2 comes 1.3 by its number, and the lecture teaches 1.6 first."""
    monkeypatch.setattr(board, "sections", lambda *_: dict.fromkeys(["1.2", "1.6", "1.3"]))
    entries = [entry(number, "not started") for number in ("2.1", "1.9", "1.3", "1.6")]
    assert [one.number for one in board.in_lecture_order(entries)] == ["1.6", "1.3", "1.9", "2.1"]


def test_an_import_that_may_fail_is_told_and_costs_nothing(house, run_here):
    """On the board all is done, and graders have no PIL; or the lab counts as lost for it."""
    tries = "try:\n    import PIL.Image\nexcept ImportError:\n    pass\n"
    root = house(FILES | {"labs/rasterization.py": tries + SECOND})
    done = run_here(root, "course", "check", "2")
    assert done.returncode == 0 and "labs/rasterization.py, line 2: PIL.Image is not there when " \
                                    "your labs are graded; numpy" in done.stdout


def test_a_notebook_s_board_comes_from_a_process_of_its_own(course, monkeypatch, capsys):
    """It is of other labs or exercises, in codes of colours, or what went wrong is not in it."""
    monkeypatch.setattr(places, "ROOT", course)
    monkeypatch.setenv("FORCE_COLOR", "1")
    board.show("1.2", "reference")
    assert lines(capsys.readouterr().out)[:4] == [
        "Lab 1  transforms  3 of 3  ####################",
        "  1.2  half        3 of 3  done", "", DONE.format(3, " 1") + " of the lab."]
    board.show("3")
    assert capsys.readouterr().out.startswith('course: there is no lab or exercise "3"; give')


def test_every_row_of_the_course_fits_into_80_columns():
    """A long name is cut off."""
    entries = [graded.entry(exercise, "blocked by 16.16", topic=topic)
               for topic in exercises.topics() for exercise in exercises.topic_exercises(topic)]
    console = Console(width=80, file=io.StringIO(), force_terminal=False)
    console.print(board.table(entries))
    rows = console.file.getvalue().splitlines()
    assert [row.split()[1] for row in rows if row.split()[0][0].isdigit()] == [
        entry.name for entry in entries]
    assert sum("blocked by 16.16" in row for row in rows) == len(entries)


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C goes to the whole console there")
def test_a_loop_without_an_end_is_shown_when_it_is_stopped(house, run_here):
    """Ctrl-C loses the board, and nobody knows where the loop is."""
    root = house(FILES | {"labs/transforms.py": LAB.replace(
        "return x / 3", 'while not open("started", "w").close():\n        pass')})
    alone = run_here(root, "course", "check", "1.1")
    assert alone.returncode == 0, "more was run than was asked for"
    with subprocess.Popen([sys.executable, "-m", "course", "check", "1"], cwd=root,
                          stdout=subprocess.PIPE, encoding="utf-8") as process:
        while not (root / "started").exists() and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        output = process.communicate(timeout=60)[0]
    assert "  1.1  double      2 of 2   done" in output
    assert "\nIt was stopped; not all checks have run.\n" in output
    assert ("Next: 1.2 half, failing, 1 check not run\n"
            "points    0 of 3 points: 0 of 2 claims hold\n"
            "claim     Half of nothing\n") in output
    assert "wrong     KeyboardInterrupt\n          labs/transforms.py:" in output
    assert process.returncode == 1
