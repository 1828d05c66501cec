"""The command line: what it passes on, what it tells, and with which exit status."""
import io
import re
import runpy
import sys
from types import SimpleNamespace

import pytest
from submitted import put as put_files

from course import commands
from labkit import cli
from labkit.grading.request import Request


@pytest.fixture
def stand_in(monkeypatch):
    """stand_in("board", check=function) puts it in that module's place."""
    def put(module, **functions):
        module = module if module.startswith(("apps.", "course.")) else f"labkit.{module}"
        monkeypatch.setitem(sys.modules, module, SimpleNamespace(**functions))
        monkeypatch.setattr(module, sys.modules[module], raising=False)
    return put


@pytest.mark.parametrize(("line", "function", "arguments", "named"), [
    ("demo", "course.scenes.demo.run", ([], None), {}),
    ("demo bunny shadow --impl labs", "course.scenes.demo.run", (["bunny", "shadow"], "labs"), {}),
    ("reconstruct in", "apps.reconstruct.command.run", ("in", 128, None), {}),
    ("reconstruct in --size 64 --impl labs", "apps.reconstruct.command.run",
     ("in", 64, "labs"), {}),
    ("check", "board.check", (None, "labs", 0, False, False), {}),
    ("check 2.3 --impl handed/in --seed 7 --extra --pictures", "board.check",
     ("2.3", "handed/in", 7, True, True), {}),
    ("open 2.14", "upkeep.extras.open_extras", ("2.14",), {}),
    ("close 2", "upkeep.extras.close", ("2",), {"core": False}),
    ("close 2.3 --core", "upkeep.extras.close", ("2.3",), {"core": True}),
    *((f"{name} {target}", f"upkeep.{name}.run", (target or None,), {}) for name, target in (
        ("mistakes", ""), ("mutants", ""), ("mutants", "2.3"))),
    ("skeleton", "upkeep.skeleton.run", (), {"force": False}),
    ("skeleton --force", "upkeep.skeleton.run", (), {"force": True}),
    ("notebooks 02 transforms", "upkeep.notebooks.run", (["02", "transforms"],),
     {"everything": False}),
    ("notebooks --all", "upkeep.notebooks.run", ([],), {"everything": True}),
    ("pack", "grading.handing.pack.run", ("labs.zip",), {}),
    ("handout new --labs 1-4 --solutions 1", "grading.handing.handout.run", ("new", "1-4", "1"),
     {"extra": False, "after": None}),
    ("handout new --labs 2 --after 1 --extra", "grading.handing.handout.run", ("new", "2", None),
     {"extra": True, "after": "1"}),
    ("solutions 1-2 a.zip", "grading.handing.handout.release", ("1-2", "a.zip"), {}),
    ("grade in --out out --labs 1 --jobs 2 --resume --seed 7 --isolation process "
     "--seconds 3 --extra", "grading.grade.run",
     (Request("in", "out", "1", 2, True, 7, "process", 3.0, True),), {}),
    ("grade --out out --csv moodle --roster a.csv --assignment A --due D --late L --grace G "
     "--overrides o.csv --people g.csv", "grading.grade.run",
     (Request(None, "out", csv="moodle", roster="a.csv", assignment="A", due="D", late="L",
              grace="G", overrides="o.csv", people="g.csv"),),
     {})])
def test_a_command_calls_its_function_and_passes_its_status_on(
        stand_in, line, function, arguments, named):
    """An option is forgotten, two are swapped, or the status is lost."""
    calls = []
    module, _, name = function.rpartition(".")
    stand_in(module, **{name: lambda *args, **kwargs: calls.append((args, kwargs)) or 5})
    assert cli.main(line.split()) == 5
    assert calls == [(arguments, named)]


def test_the_list_of_scenes_is_printed(stand_in, capsys):
    """--list renders everything, or shows nothing."""
    stand_in("course.scenes.demo", SCENES=("cow", "moon"), title="The {}.".format)
    assert cli.main(["demo", "--list"]) == 0
    assert [line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines()] == [
        ["cow", "The cow."], ["moon", "The moon."]]


def test_without_a_command_the_page_is_shown_with_all_commands_and_no_others(capsys):
    """The page, which is written by hand, announces what is not there, or leaves something out."""
    assert cli.main([]) == 0
    page = capsys.readouterr().out
    on_the_page = re.findall(r"^  (\w+)(?:  +\S| [\[A-Z])", page, re.MULTILINE)
    with pytest.raises(SystemExit) as ended:
        cli.main(["bake"])
    assert ended.value.code == 2
    told = capsys.readouterr().err
    choices = re.findall(r"\w+", re.search(r"choose from ([^)]*)\)", told)[1])
    assert sorted(on_the_page) == sorted(choices)
    assert told.startswith("course: ") and told.count("\n") == 1


@pytest.mark.parametrize("line", [
    "check --sed 1 2 3", "demo --impl mine", "skeleton --chek", "check --seed -1", "check --seed x",
    "grade in --out out --seed -1", "grade in --out out --seed 1.5", "grade in --out out --jobs -1",
    "grade in --out out --jobs 0", "grade in --out out --seconds soon",
    f"grade in --out out --seed {5000 * '9'}"])
def test_a_mistake_in_the_options_is_one_line(line, capsys):
    """argparse prints its usage, and the sentence is lost below it."""
    with pytest.raises(SystemExit) as ended:
        cli.main(line.split())
    told = capsys.readouterr().err
    assert ended.value.code == 2
    assert told.startswith("course: ") and told.count("\n") == 1


@pytest.fixture
def demo_runs(stand_in, monkeypatch, tmp_path):
    """demo_runs("labs", text): demo runs this text from a file in the folder labs."""
    def put(folder, text):
        path, = put_files(tmp_path, {f"{folder}/part.py": text})
        monkeypatch.setattr(cli, "ROOT", tmp_path.resolve())
        stand_in("course.scenes.demo", run=lambda *_, **__: runpy.run_path(str(path)))
    return put


@pytest.mark.parametrize(("folder", "text", "sentence"), [
    ("course", "raise ValueError('there is no scene cow')", "there is no scene cow"),
    ("course", "raise OSError(\n    'the disk is full')", "the disk is full"),
    ("elsewhere", "open('no such folder/picture.png')", "picture.png"),
    ("labs", "raise NotImplementedError('exercise 1.2: transform')",
     "exercise 1.2: transform is not written yet")])
def test_what_the_user_can_mend_is_one_line_and_status_2(demo_runs, capsys, folder, text, sentence):
    """A wrong name or a full disk shows a traceback."""
    demo_runs(folder, text)
    assert cli.main(["demo"]) == 2
    told = capsys.readouterr().err
    assert told.startswith("course: ") and told.count("\n") == 1 and sentence in told


@pytest.mark.parametrize(("folder", "text"), [
    ("course", "int('x')"), ("labs", "int('x')"), ("course", "raise TypeError('a defect')"),
    ("elsewhere", "raise ValueError('operands could not be broadcast')")])
def test_a_defect_shows_its_traceback(demo_runs, folder, text):
    """Every ValueError is told in one line, and nobody finds the line that is wrong."""
    demo_runs(folder, text)
    with pytest.raises((ValueError, TypeError)):
        cli.main(["demo"])


@pytest.mark.parametrize(("line", "module", "told"), [
    ("demo", "course.scenes.demo", ""),
    ("grade in --out out", "grading.grade", "course: stopped; what is graded is kept: the same "
     "command with --resume goes on\n")], ids=["quiet", "how to go on"])
def test_ctrl_c_exits_with_130(stand_in, capsys, line, module, told):
    """A traceback for a key that was pressed on purpose; or the whole class is graded again."""
    def stop(*_, **__):
        raise KeyboardInterrupt

    stand_in(module, run=stop)
    assert cli.main(line.split()) == 130
    assert capsys.readouterr() == ("", told)


def test_a_console_without_a_character_shows_the_rest(stand_in, monkeypatch):
    """A Windows console of old crashes on the first tick."""
    stand_in("course.scenes.demo", SCENES=("cow",), title=lambda _: "50 \u2713 faces")
    console = io.TextIOWrapper(io.BytesIO(), encoding="cp1252")
    monkeypatch.setattr(sys, "stdout", console)
    assert cli.main(["demo", "--list"]) == 0
    console.flush()
    assert b"50 ? faces" in console.buffer.getvalue()


@pytest.mark.parametrize(("lint", "tests", "status"), [(0, 0, 0), (1, 0, 1), (0, 5, 5), (1, 2, 2)])
def test_the_test_command_fails_with_either_lint_or_tests(
        monkeypatch, stand_in, capsys, lint, tests, status):
    """One of the two statuses is forgotten; or after bad lint no test is run; or a lecture that is
    older than its code counts as a failure, or is not told.
    """
    ran = {}
    stand_in("upkeep.notebooks", older=lambda: ["one", "another"])
    monkeypatch.setattr(commands, "run_module", lambda module, *arguments: ran.update(
        {module: arguments}) or {"ruff": lint, "pytest": tests}[module])
    assert cli.main(["test"]) == status
    assert "2 lectures are older than their code, which is no mistake" in capsys.readouterr().out
    assert list(ran) == ["ruff", "pytest"] and ran["pytest"][-2:] == ("-m", "not weekly")
    assert cli.main(["test", "--all"]) == status
    assert "not weekly" not in ran["pytest"]


def test_nobody_s_own_settings_for_pytest_take_part(monkeypatch):
    """A PYTEST_ADDOPTS in the user's shell leaves tests out."""
    monkeypatch.setenv("PYTEST_ADDOPTS", "--no-such-option")
    monkeypatch.setattr(commands.signal, "signal", lambda *_: None)  # this process keeps its own
    assert commands.run_module("pytest", "--markers") == 0
