"""The open tasks: their truths on paper, the scores of what is right, naive and hostile."""
import functools
import re

import numpy as np
import pytest

from labkit import exercises, places, tasks
from labkit.checks import loader
from labkit.grading.apart import open_task, sandbox
from labkit.grading.apart.jobs import BOARD, MARK, Job
from labkit.grading.grade import task_limits, task_seeds
from labkit.grading.pages import scoreboard
from tasks import break_it, honest_edge, one_picture
from tasks.naive import break_it as naive

LEVEL, _ = sandbox.available()
NEAR, FAR = np.array([[[9.0, 9], [14, 10], [10, 15]], [[2.0, 3], [22, 4], [8, 21]]])
RIGHT = f"{exercises.read(places.ROOT / 'tasks' / 'honest_edge.py')}\ngradient = truth\n"


def area_gradient(corners):
    """The area is half the sum of x_k (y_k+1 - y_k-1)."""
    before, after = np.roll(corners, 1, 0), np.roll(corners, -1, 0)
    return np.stack([after[:, 1] - before[:, 1], before[:, 0] - after[:, 0]], 1) / 2


def test_a_truth_is_what_it_is_on_paper():
    """A near triangle lies within a far one: it takes from the far one what it gains."""
    colours, weights = np.array([[0.9, 0.5, 0.1], [0.2, 0.3, 0.6]]), np.ones((24, 24, 3))
    found = honest_edge.truth(np.array([NEAR, FAR]), colours, weights)
    near, far = (colours[0] - colours[1]).sum(), colours[1].sum()
    np.testing.assert_allclose(found[0], near * area_gradient(NEAR), atol=1e-7)
    np.testing.assert_allclose(found[1], far * area_gradient(FAR), atol=1e-7)


def test_the_pixels_of_a_triangle_have_its_area():
    """A pixel is counted twice, or cut off at the wrong side."""
    parts = [*honest_edge.cut_by_pixels(NEAR)]
    assert len({part[:2] for part in parts}) == len(parts)
    np.testing.assert_allclose(sum(honest_edge.area(part) for *_, part in parts),
                               honest_edge.area(NEAR))


def test_a_photograph_is_solved_within_its_limits():
    """q and -q are two rotations; a length counts; what is no number is right."""
    true = np.array(one_picture.expected(0)[0])
    for change, solved in ((-1.0, True), (2.0, True), (np.nan, False)):
        off = one_picture.off(true, np.hstack([true[:4] * change, true[4:]]))
        assert (off[0] < one_picture.TURN) == solved
    assert one_picture.off(true, None) == (np.inf,) * 3
    assert one_picture.off(true, true * np.r_[np.ones(7), 1.2, 1, 1, 1])[2] == pytest.approx(20)


all_kinds = break_it.kinds
expected = functools.cache(lambda task: tasks.expected(task, task_seeds(0)))


def job(text, task="honest_edge"):
    return Job({task: text}, {}, LEVEL, 0, task_limits(task), None, expected(task), task_seeds(0))


@pytest.fixture(autouse=True)
def few(monkeypatch):
    """One scene of each kind, one photograph, and the faults that a hand-out has."""
    monkeypatch.setattr(break_it, "kinds", lambda: break_it.KINDS)
    monkeypatch.setattr(honest_edge, "SCENES", 1)
    monkeypatch.setattr(one_picture, "PHOTOGRAPHS", 1)


def test_a_right_answer_gets_all_points(monkeypatch):
    """The mark and the scoreboard have the same scenes; no answer can be right."""
    monkeypatch.setattr(honest_edge, "ALL_SECONDS", 100.0)
    monkeypatch.setattr(honest_edge, "SECONDS", 50.0)
    found = open_task.examine(job(f"# nickname: owl\n{RIGHT}"))
    assert [(entry.number, entry.name, entry.reached, entry.claims) for entry in found.entries] == [
        ("honest_edge", "gradient", 40, (16, 16)), (BOARD, "owl", 0, (16, 16))]
    mark, board = expected("honest_edge").values()
    assert mark[0] != board[0]


def test_a_score_is_the_same_again():
    """A second run draws other scenes, or what one trial leaves changes the next."""
    text = "def gradient(corners, *_):\n    gradient.seen = getattr(gradient, 'seen', 0) + 1\n"
    first, again = (scored(f"{text}    return corners * gradient.seen") for _ in range(2))
    assert first == again


def scored(text, task="honest_edge"):
    """What is said of each claim, of the mark's trials alone."""
    calls = open_task.Calls(job(text, task), task)
    try:
        entry = tasks.judged(task, task, 40, calls.trial, calls.run, task_seeds(0)[MARK],
                             expected(task)[MARK])
    finally:
        calls.pytest_sessionfinish()
    return [(check.verdict, check.message) for check in entry.checks]


@pytest.mark.parametrize(("text", "why"), [
    ("def gradient(*given): return given[0] * float('nan')", ""),
    ("def gradient(*given): return 'right'", "no array of numbers"),
    ("def gradient(*given): return str(given[0].ravel())", "no array of numbers"),
    ("def gradient(*given): return type(str(given[0].ravel()), (), {})()", "no array of numbers"),
    ("def gradient(*given): raise type(str(given[0].ravel()), (Exception,), {})", "Error"),
    ("import types\ndef f(): 1 / 0\ndef gradient(*given): types.FunctionType(f.__code__.replace("
     "co_name=str(given[0].ravel())), {})()", "ZeroDivisionError"),
    *((f"def gradient(*given):\n    seen = str(given[0].flat[0])\n    head = {head!r} % seen\n"
       "    import gc\n    channel = next(o for o in gc.get_objects() if type(o).__name__ == "
       "'Channel')\n    channel.write(len(head).to_bytes(4, 'big') + head.encode())", said)
      for head, said in (('{"%s": 0}', "cannot be read"), ('{"complex": ["x%s", 0]}',
                         "cannot be read"), ('{"tuple": ["ask", "a", "b", "%s', "no message"))),
    ("def gradient(*given): raise SystemExit(str(given))", "SystemExit"),
    ("def gradient(*given):\n    print('passed', given)\n    __import__('os')._exit(0)", "ended"),
    ("def gradient(*given):\n    while True: pass", "no answer within 2 s"),
    ("def gradient(*given):\n    import sys\n    return sys._getframe(1).f_locals['truth']",
     "KeyError"),
    ("from tasks import honest_edge\ngradient = honest_edge.truth", "cannot be imported"),
    ("", "has no function gradient")], ids=range(15))
def test_who_cheats_gets_nothing_and_learns_nothing(text, why):
    """A death is no wrong answer; an error's text carries what is held back into a report."""
    held_back = str(honest_edge.trials(task_seeds(0)[MARK])[0][1][0].flat[0])[:7]
    for verdict, said in scored(text):
        assert verdict == "failed" and why in said and held_back not in said


def test_what_cannot_be_loaded_is_loaded_once(monkeypatch):
    """To load is free, so an import that hangs takes 10 s for each of 160 scenes."""
    started, start = [], open_task.Calls.start
    monkeypatch.setattr(open_task.Calls, "start",
                        lambda *given: started.append(1) or start(*given))
    scored("__import__('os')._exit(0)")
    assert len(started) == 1


def test_at_home_a_file_without_the_function_is_told_in_a_sentence(tmp_path, monkeypatch):
    """A traceback."""
    monkeypatch.setattr(places, "OUT", str(tmp_path))
    (tmp_path / "honest_edge.py").write_text("def other(): pass")
    with pytest.raises(ValueError, match="no function gradient"):
        tasks.check("honest_edge", str(tmp_path), 0)


def test_at_home_a_call_that_never_ends_is_stopped(tmp_path, monkeypatch, capsys):
    """It hangs, or what is right is stopped on a busy machine."""
    monkeypatch.setattr(places, "OUT", str(tmp_path))
    monkeypatch.setattr(break_it, "SECONDS", 0.02)
    (tmp_path / "break_it.py").write_text("def cases():\n    while True:\n        pass")
    assert tasks.check("break_it", str(tmp_path), 0) == 1
    assert "stopped after 0.02 s of a processor" in capsys.readouterr().out


@pytest.mark.parametrize("wait", ["while True: pass", "time.sleep(9)"])
def test_at_home_all_calls_together_are_stopped(monkeypatch, wait):
    """Of two that never end, one catches the error that stops it, and the other one goes on. What
    sleeps takes no processor's time.
    """
    monkeypatch.setattr(break_it, "SECONDS", 0.05)
    monkeypatch.setattr(break_it, "ALL_SECONDS", 0.12)
    text = f"import time\ndef cases(found):\n  try:\n    {wait}\n  except Exception: pass"
    call, said = tasks.in_time(functools.partial(tasks.run_here, "break_it", text), break_it), []
    for _ in range(4):
        with tasks.noted(said):
            call([])
    assert ["are used up" in one for one in said] == [False, False, False, True]


def test_the_truth_is_too_slow_to_hand_in(monkeypatch):
    """Who copies the scorer has all points."""
    monkeypatch.setattr(honest_edge, "ALL_SECONDS", honest_edge.ALL_SECONDS / 20)
    assert "failed" in dict(scored(RIGHT))


def test_a_search_has_the_labs_whole():
    """Earlier labs answer through the socket: a search dies of its thousand pictures."""
    text = exercises.read(places.ROOT / "tasks" / "naive" / "one_picture.py")
    found = open_task.examine(job(text.replace("steps=300", "steps=3"), "one_picture"))
    assert found.asked[BOARD] == {"rasterization.rasterize": 3}, "a render is a call"
    said = found.entries[0].checks[0].message
    assert re.fullmatch(r"turn \d+\.\d and light \d+\.\d degrees off, focal length \d.*", said)


def test_faults_are_quiet_and_drawn(monkeypatch):
    """The tape's text is another, so that faults are none; both sets have the same numbers."""
    monkeypatch.setattr(break_it, "kinds", all_kinds)
    seed, other = task_seeds(0).values()
    with loader.package(places.ROOT / "reference"):
        found = tasks.judged("break_it", "", 40, naive.cases, functools.partial(
            tasks.run_here, "break_it"), seed, break_it.expected(seed))
    assert found.claims == (4, 20)
    assert len({*break_it.trials(seed)} | {*break_it.trials(other)}) > 25


def test_cases_find_the_same_at_home_and_in_the_sandbox():
    """What is sent arrives as something else, or a tape keeps what the one before has left."""
    text = exercises.read(places.ROOT / "tasks" / "naive" / "break_it.py")
    mark, board = open_task.examine(job(text, "break_it")).entries
    assert (mark.claims, mark.reached, board.claims) == ((4, 6), 26.5, (4, 6))


@pytest.mark.parametrize(("returned", "why"), [
    ("[('rotation', (np.r_[1.0, 0, 0, 0],), np.eye(4))]", "1 does not hold on the right tape"),
    ("[('take_backward', (np.ones(1), np.ones(2), np.array([True, False])), np.r_[1.0, 0])]",
     "1 does not hold on a right tape, written otherwise"),
    ("[('rotation', (np.ones(4),), __import__('sys').modules)] * 2", "1 does not hold"),
    ("[('exec', ('',), None)]", "no cases could be tried"),
    ("[('matmul_backward', (np.ones((4000, 4000)),) * 3, 0.0)] * 9", "no cases could be tried")])
def test_who_accuses_a_right_tape_finds_no_fault(monkeypatch, returned, why):
    """Cases that fail on everything find all faults; work without end stops the grader."""
    monkeypatch.setattr(break_it, "SECONDS", 1.0)
    monkeypatch.setattr(break_it, "ALL_SECONDS", 1.0)
    text = f"import numpy as np\n\ndef cases():\n    return {returned}\n"
    assert all(verdict == "failed" and why in said for verdict, said in scored(text, "break_it"))


@pytest.mark.parametrize("found", [None, [], [("exec", (), 0)], [("backward", ())], [0.0] * 101])
def test_what_is_no_case_is_told_in_a_sentence(found):
    """A traceback at home, of a tape that is none of the student's."""
    with pytest.raises(ValueError, match=r"return a list of 1 to 100|a case is"):
        break_it.cases(found)


def test_a_scoreboard_names_nobody():
    """A nickname is HTML; a student's name, or what the mark is made of, stands on it."""
    entry = tasks.judged("honest_edge", BOARD, 0, lambda *_: None, None, 0, [[0.0]] * 4)
    Told = type("Told", (), {"result": type("Found", (), {"asked": {}, "entries": [
        entry._replace(name=open_task.nickname("x\n# nickname: <b>owl\n")),
        entry._replace(number="honest_edge", name="secret")]})})
    page = scoreboard.page([Told])
    assert "&lt;b&gt;owl" in page and "secret" not in page


