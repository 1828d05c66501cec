"""The checks of a submission, with a worker in the place of the labs: a plugin of pytest.

What comes from the worker is believed in nothing. The checks and the reference are trusted. One
call, where f calls g, an earlier exercise in whose place there is a stand-in:

    check            Examination           worker                   Answers, a worker
      |  impl.f(x)        |                   |                     with the reference
      |------------------>|  call f, x        |                             |
      |                   |------------------>|  f runs, and calls g:       |
      |                   |  ask g, y         |  the stand-in asks          |
      |                   |<------------------|                             |
      |                   |  ask g, y: as it came, its bytes are counted    |
      |                   |------------------------------------------------>|
      |                   |  returned g(y)    |                             |
      |                   |<------------------------------------------------|
      |                   |------------------>|  f goes on                  |
      |  what f returned  |  returned         |
      |<------------------|<------------------|

g is sound if all of its checks have passed, and it asked for nothing: then it has no stand-in, and
the student's own g answers. In the place of `returned`, a stand-in may be told `own`: it has asked
too much, and the student's own g answers from then on. Where a check itself calls g, to make the
inputs of f, Examination asks the reference at once.
"""
import contextlib
import enum
import functools
import importlib
import re
import time
import types
from pathlib import Path

import numpy as np
import pytest

from ... import exercises
from ...checks import Mismatch, alarm, loader
from ...checks.report import is_fine_print
from ...checks.showing import cut, shown_frames
from ...contract import UNFINISHED, mapped
from . import sandbox, wire
from .answers import Answers, Budget, may_ask
from .labs import before_it, exercise_numbers, given_text, preloaded

MESSAGES = {  # what a worker may say, and the types of what follows
    "opened": (str,), "missing": (str,), "returned": (object, tuple, str),
    "raised": (str, str, tuple, str)}
QUESTION = re.compile(rb'.{4}\{"tuple": \["ask", "(\w{1,60})", "(\w{1,60})", ', re.DOTALL)
MOST_FRAMES = 40
MOST_TEXT = 4000      # characters of an error, or of what a check prints
MOST_STRING = 200     # of a string that a call returns, and no exercise does


class TookTooLong(Exception):
    """Our own work on what was returned."""


class State(enum.IntEnum):
    """What became of an exercise: the worst of its checks so far."""

    PASSED = 0
    WRONG = 1
    LOST = 2     # its worker died, fell silent, or sent what is no answer, in the fine print
    SPOILT = 3   # it did so in the question


class Examination:
    """A pytest plugin: the functions that checks ask for run in a worker."""

    def __init__(self, job, labs):
        self.job = job
        self.own = {name: text for name, text in job.texts.items() if name not in exercises.TOPICS}
        self.topic = {exercise.number: topic for topic in labs for exercise in labs[topic]}
        self.earlier = {exercise.number: {before.name: before.number for before in found[:k]}
                        for found in labs.values() for k, exercise in enumerate(found)}
        self.state = {}         # {exercise: State}
        self.lost = {}          # {exercise: sentence} of those that are lost or spoilt
        self.budget = Budget(job.limits)
        self.answers = Answers(job.asks, self.topic, self.budget, self.start)
        self.printed = 0        # characters, by the check that runs now
        self.worker = None
        self.opened = None      # the exercise that the worker serves now
        self.running = None     # the exercise whose check runs now
        self.at_stake = None    # the State that it gets if its worker is lost in this check
        self.missing = dict(job.missing)
        self.loaded = set()     # labs that were seen to load
        self.pictures = 0       # so many were drawn
        self.problem = None     # why this submission could not be examined at all

    # --- hooks

    def pytest_configure(self, config):
        config.stash[loader.FIND] = self.find

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items):
        order = list(self.topic)
        items.sort(key=lambda item: order.index(number_of(item)))

    def pytest_runtest_setup(self, item):
        self.running = number_of(item)
        is_fine = is_fine_print(item.get_closest_marker("exercise"))
        self.at_stake = State.LOST if is_fine else State.SPOILT
        self.printed = 0

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_logreport(self, report):
        """Give each picture a name of its own, before the next check draws another one."""
        check = getattr(report, "check", {})
        if check:
            self.worsen(self.running, State(check["verdict"] != "passed"))
        if picture := check.get("picture"):
            self.pictures += 1
            kept = Path(picture).with_name(f"{self.pictures}.png")
            report.check["picture"] = str(Path(picture).rename(kept))

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self):
        """A check, and what it does with what was returned. That is our time, so it is limited.

        A product of large matrices is one step, of minutes. Only the end of this process stops it.
        """
        try:
            with alarm.or_ended(3 * alarm.OURS), \
                    alarm.at_most(alarm.OURS, TookTooLong(), of_processor=True):
                return (yield)
        except TookTooLong:
            self.lose(self.running, f"what it returned takes the grader more than {alarm.OURS:g} s "
                      "to compare with what was expected", self.at_stake)
            raise Mismatch(("wrong", self.lost[self.running])) from None

    def pytest_sessionfinish(self):
        self.finish()
        self.answers.close()
        if self.worker:
            self.worker.close()

    # --- calls

    def find(self, topic, name):
        known = getattr(importlib.import_module(f"reference.{topic}"), name)
        if isinstance(known, type | types.ModuleType):
            return known

        @functools.wraps(known)
        def call(*args, **kwargs):
            return self.call(topic, name, args, kwargs)

        return call

    def call(self, topic, name, args, kwargs):
        """Call a function of the lab, or the reference for an exercise before the one checked."""
        if why := self.missing.get(topic) or self.lost.get(self.running):
            raise Mismatch(("wrong", why))
        try:
            if name in self.earlier[self.running]:
                question = wire.encode(("ask", topic, name, args, kwargs))
                payload = self.answers.returned(self.running, topic, name, question)
                return wire.decode(payload, named_tuples())[1]
            self.open(topic)
            message = self.exchange(("call", topic, name, args, kwargs))
            inputs = list(wire.arrays_in((args, tuple(kwargs.values()))))
            return self.outcome(topic, name, message, inputs)
        except sandbox.Lost as lost:
            self.lose(self.running, f"in {name}: {lost}", self.at_stake)
            raise Mismatch(("wrong", self.lost[self.running])) from None

    def open(self, topic):
        """Have the worker load the lab for the exercise that is checked now."""
        if self.opened == self.running:
            return
        self.finish()
        reused = self.worker
        self.worker = reused or self.start(self.own)
        modules = (*map(self.earlier_lab, before_it(topic)),
                   (topic, self.job.texts[topic], self.stand_ins(self.earlier[self.running])))
        self.opened = self.running
        try:
            message = self.exchange(("open", modules, preloaded(topic)))
            self.outcome(topic, None, message, [])
            self.loaded.add(topic)
        except (sandbox.Lost, Mismatch, NotImplementedError) as error:
            if isinstance(error, sandbox.Lost):
                self.forget()
                if reused:  # for what another exercise has left
                    return self.open(topic)
            why = dict(error.rows)["wrong"] if isinstance(error, Mismatch) else error
            self.missing[topic] = f"labs/{topic}.py cannot be imported: {why}"
            raise Mismatch(("wrong", self.missing[topic])) from None

    def earlier_lab(self, topic):
        """(topic, text, exercises for which the reference answers) of a lab before this one.

        Their own, if it has been seen to load. Else ours without answers: what is given runs in
        the worker, for constants, classes and generators cannot be sent.
        """
        if topic in self.loaded:
            return topic, self.job.texts[topic], self.stand_ins(exercise_numbers(topic))
        return topic, given_text(topic), tuple(exercise_numbers(topic))

    def stand_ins(self, numbers):
        """Those exercises, of {name: number}, for which the reference answers.

        So a mistake costs its own points alone, and work that is all right runs as it does at home.
        """
        return tuple(name for name, number in numbers.items()
                     if self.job.asks is None or not self.is_sound(number))

    def is_sound(self, number):
        """Has an exercise passed all of its checks, without an answer of the reference?"""
        return self.state.get(number) is State.PASSED and number not in self.answers.asked

    def ran(self, check):
        """Did what was handed in answer this check?"""
        return check.exercise not in self.lost and self.topic[check.exercise] not in self.missing

    def exchange(self, message):
        """A message to the worker, and the one back. What it asks in between is answered."""
        payload = self.budget.timed(self.running, self.worker, wire.encode(message))
        while question := QUESTION.match(payload):
            answer = self.answer(*(name.decode() for name in question.groups()), payload)
            payload = self.budget.timed(self.running, self.worker, answer)
        kind, *content = answer = self.worker.decoded(payload, named_tuples())
        types = MESSAGES.get(kind)
        if types is None or len(content) != len(types) or not all(map(isinstance, content, types)):
            raise sandbox.Lost("what it sent is no message")
        return answer

    def answer(self, topic, name, question):
        """What the worker is told that asks for a function of the reference."""
        own = self.topic[self.running]
        if name not in may_ask(own, topic, self.earlier[self.running]):
            raise sandbox.Lost(f"it asked for {topic}.{name}, which is not an earlier exercise")
        return self.answers.answer(self.running, topic, name, question,
                                   topic == own or topic in self.loaded)

    def outcome(self, topic, name, message, inputs):
        """What a call returned, its inputs changed where it changed them. Or raise what it did."""
        kind, *answer = message
        self.show(answer[-1])
        if kind == "missing":
            raise Mismatch(("wrong", f"labs/{topic}.py has no function {name}; "
                                     "keep the names that the skeleton gives"))
        if kind == "raised":
            self.raise_here(topic, *answer[:3])
        if kind == "returned":
            for changed in answer[1][:len(inputs)]:
                change(inputs, changed)
        return shortened(answer[0])

    def show(self, printed):
        printed = printable(printed[:MOST_TEXT - self.printed])
        self.printed += len(printed)
        print(printed, end="")

    def raise_here(self, topic, error, text, frames):
        text = printable(text[:MOST_TEXT])
        lines = {f"labs/{name}.py": self.job.texts[name].splitlines()
                 for name in (topic, *self.own)}
        if error == "NotImplementedError" and UNFINISHED.fullmatch(text):
            raise NotImplementedError(text)
        shown = [(file, line, function, lines[file][line - 1].strip())
                 for file, line, function in map(frame, frames[:MOST_FRAMES])
                 if 0 < line <= len(lines.get(file, ()))]
        raise Mismatch(("wrong", "\n".join([
            cut(f"{printable(error[:60])}: {text}".removesuffix(": ")),
            *shown_frames(shown)])))

    # --- workers

    def start(self, own=()):
        """A worker that finds, beside what labs are given, these modules of the student's own."""
        more = {f"labs.{name}": text for name, text in dict(own).items()}
        try:
            return sandbox.Worker(self.job.level, self.job.limits, more)
        except (sandbox.Lost, OSError) as error:
            self.problem = f"no worker could be started: {error}"
            raise pytest.exit.Exception(self.problem) from None

    def finish(self):
        """Let the worker end the exercise that it serves, and be ready for the next one."""
        if self.opened is None:
            return
        number, self.opened = self.opened, None
        began = time.monotonic()
        try:
            self.worker.finish()
        except sandbox.Lost as lost:
            self.lose(number, f"at its end: {lost}", State.SPOILT)
        self.budget.spend(None, time.monotonic() - began)

    def worsen(self, number, state):
        self.state[number] = max(state, self.state.get(number, State.PASSED))

    def lose(self, number, why, state):
        self.lost[number] = why
        self.worsen(number, state)
        self.forget()

    def forget(self):
        if self.worker:
            self.worker.close()
        self.worker = self.opened = None


def number_of(item):
    return item.get_closest_marker("exercise").args[0]


@functools.cache
def named_tuples():
    """{"pipeline.Colours": the reference's class}: all that is made of what a worker sends."""
    return wire.named_tuples([importlib.import_module(f"reference.{topic}")
                              for topic in exercises.topics()])


def frame(sent):
    """What a worker tells of a frame -> (file, line, function), always of these types."""
    file, line, function = sent if isinstance(sent, tuple) and len(sent) == 3 else ("", 0, "")
    return str(file)[:60], line if isinstance(line, int) else 0, printable(str(function)[:60])


def shortened(value):
    """With short strings alone: an array of strings has room for the longest one everywhere."""
    if isinstance(value, str):
        return value[:MOST_STRING]
    if isinstance(value, tuple):
        return mapped(shortened, value)
    if isinstance(value, dict):
        return {shortened(key): shortened(part) for key, part in value.items()}
    return list(map(shortened, value)) if isinstance(value, list) else value


def change(inputs, changed):
    """Do to an input what the worker says was done to its copy: its position, and the array."""
    with contextlib.suppress(IndexError, TypeError, ValueError, OverflowError):
        position, array = changed
        if inputs[position].shape == np.shape(array):  # one number for all is much work
            inputs[position][...] = array


def printable(text):
    """Without control characters: they move a terminal's cursor, and more."""
    return "".join(c if c.isprintable() or c == "\n" else "?" for c in text)
