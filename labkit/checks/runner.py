"""Runs the checks of some exercises in this process, and keeps what became of each."""
import contextlib
import functools
import io
import sys
from collections.abc import Iterable

import pytest

from .. import places
from .hints import hint, is_sure
from .loader import Stopped, folder
from .report import Check, claim, is_drawn, is_fine_print
from .showing import error_text, layout


def run_checks(labs: dict, numbers: Iterable[str], implementation: str, seed: int,
               plugins: Iterable = ()) -> tuple[list[Check], list[str]]:
    """Run the checks of these exercises in this process -> ([Check], [problem]).

    labs {topic: its exercises}. numbers: those whose checks run. plugins: more of pytest's.
    """
    topics = [topic for topic, lab in labs.items()
              if any(exercise.number in numbers for exercise in lab)]
    tests = [path for topic in topics
             if (path := places.ROOT / "tests" / "labs" / f"test_{topic}.py").exists()]
    if not tests:
        return [], []
    options = ["--rootdir", places.ROOT, "-c", places.ROOT / "pyproject.toml",
               "-p", "no:cacheprovider", "--continue-on-collection-errors", "--no-summary",
               "-p", "no:unraisableexception",  # it collects garbage twice, 0.1 s
               "--capture=sys",  # of prints; a browser cannot capture files
               f"--impl={implementation}", f"--seed={seed}"]
    said = io.StringIO()
    with progress_bar() as tell, undisturbed(said):
        collector = Collector(numbers, labs, folder(implementation), tell)
        status = pytest.main([*map(str, options), *map(str, tests)], plugins=[collector, *plugins])
    if status in (pytest.ExitCode.INTERNAL_ERROR, pytest.ExitCode.USAGE_ERROR):
        collector.problems.append(f"pytest broke off\n{said.getvalue()}".rstrip())
    found = list((collector.planned | collector.found).values())
    return [*explained(found)], collector.problems


@contextlib.contextmanager
def progress_bar():
    """What is told of the checks, see rich's Progress.update, is a bar on a terminal. Elsewhere
    there is none.
    """
    if not sys.stderr.isatty():
        yield lambda **_: None
        return
    from rich.console import Console  # the web site's pages have none
    from rich.progress import Progress
    with Progress(console=Console(stderr=True), transient=True, auto_refresh=False,
                  redirect_stdout=False, redirect_stderr=False) as progress:
        yield functools.partial(progress.update, progress.add_task("checks"), refresh=True)


@contextlib.contextmanager
def undisturbed(said):
    """pytest says what it says to a file, and nobody's own settings for it take part."""
    with pytest.MonkeyPatch.context() as environment, contextlib.redirect_stdout(said):
        environment.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")  # they only cost time
        environment.delenv("PYTEST_ADDOPTS", raising=False)
        yield


def explained(found):
    """The Checks. Before the message of one that fails stands what may be wrong.

    That is the hint that explains all that fail in an exercise, said once, at the first of them.
    Where there is none that is sure, it is the mistakes that a check was written for.
    """
    failing = {}
    for check in sorted(found, key=lambda check: check.fine_print):
        if check.verdict == "failed":
            failing.setdefault(check.exercise, []).append(check)
    hints = {exercise: hint(exercise, checks) for exercise, checks in failing.items()}
    for check in found:
        said = hints.get(check.exercise)
        rows = [("hint", said)] if said and check is failing[check.exercise][0] else []
        if check.catches and not (said and is_sure(said)):
            rows.append(("perhaps", check.catches))
        yield check._replace(message="\n".join(filter(None, [layout(rows), check.message])))


class Collector:
    """A pytest plugin: runs the checks of these exercises alone, and keeps what became of them."""

    def __init__(self, numbers, labs, code, tell):
        self.numbers = numbers
        self.known = {exercise.number for lab in labs.values() for exercise in lab}
        self.code = code
        self.tell = tell
        self.planned = {}   # nodeid -> the Check of one that did not run
        self.found = {}     # nodeid -> Check
        self.problems = []  # sentences
        self.stopped = set()  # exercises of which a call took too long
        self.running = None

    def pytest_collectreport(self, report):
        if not report.passed:
            reason = report.longreprtext.strip().splitlines()[-1].removeprefix("E").strip()
            self.problems.append(f"{report.nodeid} cannot be collected: {reason}")

    def pytest_collection_modifyitems(self, items):
        marks = [(item, item.get_closest_marker("exercise")) for item in items]
        self.problems += [f"{item.nodeid} names exercise {mark.args[0]}, and there is none"
                          for item, mark in marks if mark and mark.args[0] not in self.known]
        asked = [(item, mark) for item, mark in marks if mark and mark.args[0] in self.numbers]
        items[:] = [item for item, mark in sorted(asked, key=lambda one: is_fine_print(one[1]))]
        self.planned = {item.nodeid: Check(mark.args[0], item.nodeid, claim(item), "not run", "",
                                           None, 0.0, is_fine_print(mark), drawn=is_drawn(item))
                        for item, mark in asked}
        self.tell(total=len(items))

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item):
        """Pass over what is left of an exercise of which a call took too long."""
        self.running = item.nodeid
        exercise = self.planned[item.nodeid].exercise
        self.tell(description=f"checks {exercise}")
        return exercise in self.stopped or None

    def pytest_exception_interact(self, node, call):
        if isinstance(call.excinfo.value, Stopped) and node.nodeid in self.planned:
            self.stopped.add(self.planned[node.nodeid].exercise)

    def pytest_runtest_logreport(self, report):
        earlier = self.found.get(report.nodeid)  # a teardown can still spoil a check that passed
        if hasattr(report, "check") and (earlier is None or earlier.verdict == "passed"):
            self.found[report.nodeid] = Check(**report.check)

    def pytest_runtest_logfinish(self):
        self.tell(advance=1)

    def pytest_keyboard_interrupt(self, excinfo):
        """Say in which line the code under test was: there may be a loop without an end."""
        self.problems.append("It was stopped; not all checks have run.")
        where = layout([("wrong", error_text(excinfo.value, self.code))])
        if self.running in self.planned:
            self.planned[self.running] = self.planned[self.running]._replace(
                verdict="failed", message=where)
