"""What a run of all tests does first, and commands that run in this process."""
import contextlib
import io
import shutil
import signal
import subprocess
import sys

import pytest
from submitted import put

from course import commands
from labkit import places
from labkit.grading import grade
from labkit.grading.apart import running
from labkit.grading.request import Request

WORKERS = ["test_examine.py", "test_grade.py", "test_hostile.py", "test_own_modules.py",
           "test_running.py", "test_sandbox.py"]
# On Windows nothing can be graded. In sorting/ lies another course.
collect_ignore = ["sorting", *(WORKERS if sys.platform == "win32" else ())]
# What a script starts with & ignores Ctrl-C, and all that it starts: tests of Ctrl-C wait for ever.
signal.signal(signal.SIGINT, signal.default_int_handler)
LONGEST = {"test_examine.py", "test_mistakes.py", "test_handout.py", "test_hostile.py"}


def pytest_collection_modifyitems(items):
    """The longest files first, so that in the end no core waits for one test."""
    items.sort(key=lambda item: item.path.name not in LONGEST)


@pytest.fixture(scope="session")
def run_here():
    """What run_module does, for the modules course and pytest, with the code that is loaded here.

    It takes a tenth of the time. What a process of its own is to show needs run_module.
    """
    def run(root, module, *command):
        start = {"course": commands.main, "pytest": pytest.main}[module]
        out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in range(2))
        with (in_the_place_of(root), contextlib.redirect_stdout(out),
              contextlib.redirect_stderr(err)):
            try:
                quick = ("-p", "no:unraisableexception") if module == "pytest" else ()  # 1 s
                status = start([*quick, *map(str, command)])
            except SystemExit as ended:
                status = ended.code
        return subprocess.CompletedProcess(
            command, status, *(stream.buffer.getvalue().decode() for stream in (out, err)))

    return run


@pytest.fixture
def grade_here(monkeypatch, tmp_path, capsys):
    """grade_here(examined, files, ...) -> what grade returns and prints, in one line, where these
    files of lab 1 are handed in: in this process, and examined(text) is a submission's Result.
    """
    def graded(examined, files, **options):
        monkeypatch.setattr(running, "examine", lambda job, line: (
            examined(job.texts.get("transforms", "")), {}))
        monkeypatch.setattr(grade, "rehearsed", lambda *_: {})
        shutil.rmtree(tmp_path / "in", ignore_errors=True)
        put(tmp_path / "in", files)
        status = grade.run(Request(tmp_path / "in" if files else None, tmp_path / "out", "1",
                                   isolation="process", **options))
        return status, " ".join(capsys.readouterr().out.split())

    return graded


@pytest.fixture(scope="session")
def in_place():
    """`in_the_place_of`, for who calls a function instead of a command."""
    return in_the_place_of


@contextlib.contextmanager
def in_the_place_of(root):
    """Another folder is the course's root, and no test that was imported here is known there."""
    known = {name: sys.modules.pop(name) for name in tests_imported()}
    with pytest.MonkeyPatch.context() as patch, contextlib.chdir(root):
        patch.setattr(places, "ROOT", root)
        patch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
        patch.setenv("COLUMNS", "80")
        patch.setenv("FORCE_COLOR", "")
        try:
            yield
        finally:
            for name in tests_imported():
                del sys.modules[name]
            sys.modules.update(known)


def tests_imported():
    return [name for name in sys.modules if name.split(".")[0] in ("tests", "conftest")]
