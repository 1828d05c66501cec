"""An open task: the calls of each of its sets run in a worker of their own, in the task's limits.

All of a set's calls are the same for all submissions. The labs before the task are given whole, as
text: a search that asked for each of its pictures through the socket would send gigabytes.
"""
import builtins
import contextlib
import inspect
import re

import numpy as np

from ... import exercises, tasks
from ...checks import Mismatch
from ...table import TASKS
from .answers import Budget
from .examination import Examination, State, frame, printable
from .jobs import BOARD, MARK, Result
from .labs import faster
from .sandbox import Limits, Lost


def examine(job) -> Result:
    """The entries of both sets. The scoreboard's gives no points."""
    (task,) = {*TASKS} & {*job.texts, *job.missing}
    entries, lost, asked = [], {}, {}
    for which, name, points in ((MARK, task, tasks.column(task).points), (BOARD, BOARD, 0)):
        calls = Calls(job, task)
        try:
            entry = tasks.judged(task, name, points, calls.trial, calls.run, job.task[which],
                                 job.asks[which])
            asked[name] = calls.counted()
        finally:
            calls.pytest_sessionfinish()
        seconds = calls.budget.spent.get(task, 0.0) / len(entry.checks)
        entries.append(entry._replace(
            name=entry.name if which == MARK else nickname(job.texts.get(task, "")),
            checks=[one._replace(seconds=seconds) for one in entry.checks]))
        lost |= zip([name], calls.why[:1], strict=False)
    return Result(entries, lost, calls.missing, asked, calls.problem, 0.0)


def nickname(text):
    """What a line of its own says, as "# nickname: owl". "": none does."""
    found = re.search(r"^# nickname: *(\S.{0,23})$", text, re.MULTILINE)
    return printable(found[1]) if found else ""


class Calls(Examination):
    """Calls of an open task's one function."""

    def __init__(self, job, task):
        super().__init__(job, {task: [tasks.column(task)]})
        self.running, self.at_stake = task, State.SPOILT
        self.why = []  # sentences on the workers that were lost
        self.ours = None  # Calls of our own modules

    def trial(self, *given):
        """What the function returns. A worker that is lost takes a call's time, and its answer."""
        budget, task = self.budget, self.running
        if budget.spent.get(task, 0.0) >= self.job.limits.exercise:
            raise Mismatch(("wrong", f"the {self.job.limits.exercise:g} s for all are used up"))
        if why := self.missing.get(task):  # it is not loaded again: that is free
            raise Mismatch(("wrong", why))
        try:
            self.budget = Budget(Limits())  # to load it is free
            self.open(task)
            self.budget = budget
            return self.call(task, tasks.column(task).name, given, {})
        except Mismatch:
            if task in self.lost:
                self.why.append(self.lost.pop(task))
                budget.spend(task, self.job.limits.call)
            raise
        finally:
            self.budget = budget

    def run(self, text, returned):
        """What our own text's function makes of it: in a worker that has nothing else of theirs."""
        self.ours = self.ours or Calls(self.job._replace(missing={}), self.running)
        self.ours.finish()
        self.ours.own, self.ours.job = {}, self.ours.job._replace(texts={self.running: text})
        return self.ours.trial(returned)

    def pytest_sessionfinish(self):
        super().pytest_sessionfinish()
        if self.ours:
            self.ours.pytest_sessionfinish()

    def answer(self, topic, name, question):
        """To a stand-in, of which there are none here."""
        raise Lost("what it sent is no message")

    def counted(self):
        """{"topic.name": how often that function was called since a worker was lost}."""
        if not (which := tasks.scorer(self.running).COUNTED) or self.worker is None:
            return {}
        with contextlib.suppress(Mismatch, TypeError, ValueError, OverflowError):
            count = self.call(which[0], "count_of_calls", (), {})
            return {".".join(which): int(np.int32(count))}  # 4,000 digits are a message

    def earlier_lab(self, topic):
        """Whole, as the reference has it, with a count of what is counted in it."""
        text, which = exercises.read(exercises.reference(topic)), tasks.scorer(self.running).COUNTED
        if which and which[0] == topic:
            text += (f"\n\n{inspect.getsource(tasks.counted)}\nCALLS = counted(globals(), "
                     f"{which[1]!r})\n\ndef count_of_calls():\n    return len(CALLS)\n")
        return topic, text, ()

    def start(self, own=()):
        return super().start({**dict(own), **faster()})

    def raise_here(self, topic, error, text, frames):
        """The last line, and Python's own errors. A text or a name could carry away what is
        held back.
        """
        own = self.job.texts[self.running]
        frames = [(file, line, name if name in own else "a function")
                  for file, line, name in map(frame, frames[-1:])]
        super().raise_here(topic, error if hasattr(builtins, error) else "Error", "", frames)
