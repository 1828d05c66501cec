"""Trials: wrong functions take the place of the right one, and the checks judge them.

A process of its own collects the checks of a topic once and runs them on one wrong function after
another. One that does not end is ended with its process, and the next process goes on behind it.
"""
import contextlib
import functools
import io
import itertools
import multiprocessing
import os
import sys
import time
from typing import NamedTuple

import pytest
from _pytest.runner import runtestprotocol

from .. import exercises, places
from ..checks import hints
from ..checks.loader import LAST_CALL, LAST_RETURN, PACKAGE
from ..checks.report import Check, is_fine_print
from ..contract import called

SLOWER, AT_LEAST = 20, 8.0  # a trial may take so many times what the right answer takes; seconds
MOST = 60.0  # seconds for a trial where the right answers are not tried


class Trial(NamedTuple):
    """A wrong function. likely: the name of the check that is to come first, as it will catch it.
    """

    exercise: exercises.Exercise
    text: str
    likely: str = ""


class Asked(NamedTuple):
    """What is wanted of Trials: every check that catches them, not only the first; the right
    answers are tried before in all checks, not only in the first.
    """

    all_checks: bool = False
    right_first: bool = True


class Trials:
    """A pytest plugin: collects checks once, then runs them on one Trial after another.

    tell(seconds) once for the right answers, then for each trial the Checks that caught it: the
    first one, or all. The checks of the fine print come last.
    """

    def __init__(self, topic, trials, asked, tell):
        self.topic, self.trials, self.asked, self.tell = topic, trials, asked, tell
        self.of = {trial.exercise.number: [] for trial in trials}  # its checks

    def pytest_collection_modifyitems(self, items):
        for item in items:
            mark = item.get_closest_marker("exercise")
            if mark and mark.args[0] in self.of:
                self.of[mark.args[0]].append(item)
        for checks in self.of.values():
            checks.sort(key=lambda item: is_fine_print(item.get_closest_marker("exercise")))

    def pytest_runtestloop(self, session):
        start = time.perf_counter()
        for number, items in self.of.items():
            if not items or list(failures(items[:None if self.asked.right_first else 1])):
                raise ValueError(f"exercise {number} has no check, or the reference fails")
        self.tell(time.perf_counter() - start)
        module = sys.modules[f"{PACKAGE}.{self.topic}"]
        for trial in self.trials:
            right = getattr(module, trial.exercise.name)
            exec(compile(trial.text, "trial", "exec"), vars(module))
            failed = failures(sorted(self.of[trial.exercise.number], key=lambda item: (
                hints.name(item.nodeid) != trial.likely)), right)
            self.tell(list(itertools.islice(failed, None if self.asked.all_checks else 1)))
            setattr(module, trial.exercise.name, right)
        return True


def failures(items, right=None):
    """Run checks; yield the Check of each that fails. Its mark is of what right returns otherwise.
    """
    for item in items:
        item.stash[LAST_RETURN] = None
        for report in runtestprotocol(item, log=False, nextitem=item.parent):  # keeps the file's
            if report.failed:
                yield wrong_parts(Check(**report.check), item, right)
                break


def wrong_parts(check, item, right):
    """The Check, in whose mark are only those parts that the right function returns otherwise."""
    if " " not in (check.mark or "") or not right:
        return check
    _, args, kwargs = item.stash[LAST_CALL]
    known = hints.fingerprint_and_count(item.nodeid, called(right, *args, **kwargs))[0].split()
    return check._replace(mark=" ".join(part for part in check.mark.split() if part not in known))


def work(topic, trials, asked, pipe):
    """What a worker does: pytest with Trials. Nothing is printed, no picture is drawn."""
    with contextlib.suppress(ImportError):  # not on Windows
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))  # a mutant may ask for all

    def nowhere(*parts):
        raise OSError("trials are not drawn")

    places.out = nowhere
    os.environ["PYTEST_DISABLE_PLUGIN_AUTOLOAD"] = "1"
    os.environ.pop("PYTEST_ADDOPTS", None)
    options = ["--rootdir", places.ROOT, "-c", places.ROOT / "pyproject.toml", "--impl=reference",
               "-p", "no:cacheprovider", places.ROOT / "tests" / "labs" / f"test_{topic}.py"]
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        pytest.main([*map(str, options)], plugins=[Trials(topic, trials, asked, pipe.send)])
    pipe.send(said.getvalue())


# --- in the main process ----------------------------------------------------------------------


def caught_by(topic, trials, **asked):
    """Who caught each of the Trials: a list of Checks, [] for one that lives. asked: see Asked.

    ValueError: the reference itself does not pass.
    """
    verdicts, asked = [], Asked(**asked)
    while len(verdicts) < len(trials):
        with worker(topic, trials[len(verdicts):], asked) as pipe:
            why = receive(verdicts, len(trials), pipe, topic, asked.right_first)
        if why:
            verdicts.append([lost(trials[len(verdicts)], why)])
    return verdicts


@contextlib.contextmanager
def worker(topic, trials, asked):
    """The pipe of a process that judges trials. It is ended with the block."""
    here, there = multiprocessing.Pipe()
    process = processes().Process(target=work, args=(topic, trials, asked, there), daemon=True)
    process.start()
    there.close()
    try:
        yield here
    finally:
        process.kill()
        process.join()


@functools.cache
def processes():
    """How processes start: as copies of one that has all imports behind it. Windows has none."""
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([__name__])
    return context


def receive(verdicts, count, pipe, topic, right_first):
    """Add what a worker finds to verdicts until these are count. -> why they are not, or ""."""
    try:
        took = received(pipe, topic)
        limit = max(AT_LEAST, SLOWER * took) if right_first else MOST
        while len(verdicts) < count:
            if not pipe.poll(limit):
                return f"no end in {limit:.0f} s"
            verdicts.append(received(pipe, topic))
    except EOFError:
        return "it broke off"
    return ""


def received(pipe, topic):
    """What a worker sends. ValueError: it broke off, and sent what pytest said."""
    sent = pipe.recv()
    if isinstance(sent, str):
        raise ValueError(f"the checks of {topic} do not run, or do not pass on the reference: "
                         f"mend them first\n{sent.strip()[-500:]}")
    return sent


def lost(trial, why):
    """The Check in the place of all those of a trial whose process was lost."""
    return Check(trial.exercise.number, why, why, "failed", why, None, 0.0, False)
