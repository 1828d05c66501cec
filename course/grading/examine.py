"""One submission: the course's own checks, with a worker in the place of the labs.

Started by `grade` as a process of its own, with a folder: job.json is read there, result.json and
pictures are written. The checks and the reference are trusted. What comes from the worker is not.
"""
import _thread
import contextlib
import functools
import importlib
import json
import os
import re
import sys
import threading
import time
from pathlib import Path
from typing import NamedTuple

import pytest

from .. import board, exercises
from ..checks import Mismatch, loader, runner
from ..checks.report import UNFINISHED
from ..checks.showing import cut, shown_frames
from ..given import places
from ..upkeep.skeleton import skeleton
from . import sandbox, wire

MESSAGES = {  # what a worker may say, and the types of what follows
    "opened": (str,), "missing": (str,), "returned": (object, tuple, str),
    "raised": (str, str, tuple, str)}
QUESTION = re.compile(rb'.{4}\{"tuple": \["ask", "(\w{1,60})", "(\w{1,60})", ', re.DOTALL)
PARENT_MEMORY = 1 << 33


class Job(NamedTuple):
    """What is to be examined: the labs' texts, and a sentence for each that is not there."""

    texts: dict     # {topic: text}
    missing: dict   # {topic: sentence}
    level: str
    seed: int = 0
    limits: tuple = sandbox.Limits()
    extra: bool = False  # whether extras are examined, too


class Examination:
    """A pytest plugin: the functions that checks ask for run in a worker.

    lost {exercise: sentence}: those whose worker died, fell silent, or sent what is no answer.
    """

    def __init__(self, job, labs):
        self.job = job
        self.limits = sandbox.Limits(*job.limits)
        self.topic = {exercise.number: topic for topic in labs for exercise in labs[topic]}
        self.earlier = {exercise.number: tuple(before.name for before in found[:k])
                        for found in labs.values() for k, exercise in enumerate(found)}
        self.worker = self.reference = None
        self.opened = None      # the exercise that the worker serves now
        self.running = None     # the exercise whose check runs now
        self.missing = dict(job.missing)
        self.lost = {}
        self.spent = dict.fromkeys((None, *self.topic), 0.0)  # seconds; None: of all exercises
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

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_logreport(self, report):
        """Give each picture a name of its own, before the next check draws another one."""
        if picture := getattr(report, "check", {}).get("picture"):
            self.pictures += 1
            kept = Path(picture).with_name(f"{self.pictures}.png")
            report.check["picture"] = str(Path(picture).rename(kept))

    def pytest_sessionfinish(self):
        self.finish()
        for worker in filter(None, (self.worker, self.reference)):
            worker.close()

    # --- calls

    def find(self, topic, name):
        @functools.wraps(getattr(importlib.import_module(f"reference.{topic}"), name))
        def call(*args, **kwargs):
            return self.call(topic, name, args, kwargs)

        return call

    def call(self, topic, name, args, kwargs):
        """Call a function of the lab, or the reference for an exercise before the one checked.

        So nothing but this exercise's own code decides its points.
        """
        number = self.running
        if topic in self.missing:
            raise Mismatch(("wrong", self.missing[topic]))
        if number in self.lost:
            raise Mismatch(("wrong", self.lost[number]))
        try:
            if name in self.earlier[number]:
                question = wire.encode(("ask", topic, name, args, kwargs))
                return wire.decode(self.answer(topic, name, question))[1]
            self.open(topic)
            message = self.exchange(("call", topic, name, args, kwargs))
            inputs = list(wire.arrays_in((args, tuple(kwargs.values()))))
            return self.outcome(topic, name, message, inputs)
        except sandbox.Lost as lost:
            self.lose(f"in {name}: {lost}")
            raise Mismatch(("wrong", self.lost[number])) from None

    def open(self, topic):
        """Have the worker load the lab for the exercise that is checked now."""
        if self.opened == self.running:
            return
        self.finish()
        self.worker = self.worker or self.start()
        modules = (*map(given_code, before_it(topic)),
                   (topic, self.job.texts[topic], self.earlier[self.running]))
        self.opened = self.running
        try:
            message = self.exchange(("open", modules, preloaded(topic)))
            self.outcome(topic, None, message, [])
        except (sandbox.Lost, Mismatch, NotImplementedError) as error:
            why = dict(error.rows)["wrong"] if isinstance(error, Mismatch) else error
            self.missing[topic] = f"labs/{topic}.py cannot be imported: {why}"
            if isinstance(error, sandbox.Lost):
                self.forget()
            raise Mismatch(("wrong", self.missing[topic])) from None

    def exchange(self, message):
        """A message to the worker, and the one back. What it asks in between is answered."""
        payload = self.timed(self.worker, wire.encode(message))
        while question := QUESTION.match(payload):
            answer = self.answer(*(name.decode() for name in question.groups()), payload)
            payload = self.timed(self.worker, answer)
        kind, *content = answer = self.worker.decoded(payload)
        types = MESSAGES.get(kind)
        if types is None or len(content) != len(types) or not all(map(isinstance, content, types)):
            raise sandbox.Lost("what it sent is no message")
        return answer

    def timed(self, worker, *payloads):
        """Payloads to a worker and one back, in the time that is left."""
        for what, most in ((self.running, self.limits.exercise), (None, self.limits.submission)):
            if self.spent[what] >= most:
                each = "all exercises" if what is None else "this exercise"
                raise sandbox.Lost(f"the {most:g} s for {each} are used up")
        started = time.monotonic()
        try:
            return worker.relay(min(self.limits.call, self.limits.exercise), *payloads)
        finally:
            for what in (self.running, None):
                self.spent[what] += time.monotonic() - started

    def outcome(self, topic, name, message, inputs):
        """What a call returned, its inputs changed where it changed them. Or raise what it did."""
        kind, *answer = message
        print(printable(answer[-1]), end="")
        if kind == "missing":
            raise Mismatch(("wrong", f"labs/{topic}.py has no function {name}; "
                                            "keep the names that the skeleton gives"))
        if kind == "raised":
            self.raise_here(topic, *answer[:3])
        if kind == "returned":
            for position, array in answer[1]:
                change(inputs, position, array)
        return answer[0]

    def raise_here(self, topic, error, text, frames):
        text, lines = printable(text), self.job.texts[topic].splitlines()
        if error == "NotImplementedError" and UNFINISHED.fullmatch(text):
            raise NotImplementedError(text)
        shown = [(file, line, function, lines[line - 1].strip())
                 for file, line, function in map(frame, frames)
                 if file == f"labs/{topic}.py" and 0 < line <= len(lines)]
        raise Mismatch(("wrong", "\n".join([
            cut(f"{printable(error)}: {text}".removesuffix(": ")),
            *shown_frames(shown)])))

    # --- the reference's answers

    def answer(self, topic, name, question):
        """What the reference returns to a worker's question, found out in a worker of its own.

        Question and answer are passed on as they came: only the two workers look inside.
        """
        own = self.topic[self.running]
        allowed = name in self.earlier[self.running] if topic == own else topic in before_it(own)
        if not allowed:
            raise sandbox.Lost(f"it asked for {topic}.{name}, which is not of an earlier exercise")
        if self.reference is None:
            self.reference = self.start()
            modules = tuple((each, exercises.read(exercises.reference(each)), ())
                            for each in exercises.topics())
            self.reference.exchange(("open", modules, ()), 60)
        try:
            return self.timed(self.reference, wire.encode(("relay", topic, name)), question)
        except sandbox.Lost as lost:
            self.reference.close()
            self.reference = None
            raise sandbox.Lost(f"in {topic}.{name}, which it asked for: {lost}") from None

    # --- workers

    def start(self):
        try:
            return sandbox.Worker(self.job.level, self.limits)
        except (sandbox.Lost, OSError) as error:
            self.problem = f"no worker could be started: {error}"
            raise pytest.exit.Exception(self.problem) from None

    def finish(self):
        """Let the worker end the exercise that it serves, and be ready for the next one."""
        if self.opened is None:
            return
        number, self.opened = self.opened, None
        try:
            self.worker.finish()
        except sandbox.Lost as lost:
            self.lost[number] = f"at its end: {lost}"
            self.forget()

    def lose(self, why):
        self.lost[self.running] = why
        self.forget()

    def forget(self):
        if self.worker:
            self.worker.close()
        self.worker = self.opened = None


def number_of(item):
    return item.get_closest_marker("exercise").args[0]


def before_it(topic):
    """The topics before this one: those that it may import."""
    return exercises.topics()[:exercises.topics().index(topic)]


@functools.cache
def given_code(topic):
    """(topic, its text without answers, exercises): what a worker has of an earlier topic.

    An exercise is answered by the reference. What is given runs in the worker: constants, classes
    and generators cannot be sent.
    """
    text = exercises.read(exercises.reference(topic))
    names = tuple(exercise.name for exercise in exercises.text_exercises(text))
    return topic, skeleton(text, extra=True), names


@functools.cache
def preloaded(topic):
    """The modules of SciPy and the course that a topic, or one before it, imports."""
    texts = [exercises.read(exercises.reference(each)) for each in (*before_it(topic), topic)]
    lines = re.findall(r"^(?:from|import) ((?:scipy|course)[.\w]*)(?: import (\w+))?",
                       "\n".join(texts), re.M)
    return tuple(dict.fromkeys(f"{module}.{name}" if module in ("scipy", "course.given") else module
                               for module, name in lines))


def frame(told):
    """What a worker tells of a frame -> (file, line, function), always of these types."""
    file, line, function = told if isinstance(told, tuple) and len(told) == 3 else ("", 0, "")
    return str(file), line if isinstance(line, int) else 0, printable(str(function))


def change(inputs, position, array):
    """Do to an input what the worker says was done to its copy."""
    with contextlib.suppress(IndexError, TypeError, ValueError):
        inputs[position][...] = array


def printable(text):
    """Without control characters: they move a terminal's cursor, and more."""
    return "".join(c if c.isprintable() or c == "\n" else "?" for c in text)


def examine(job):
    """-> {"board", "lost", "missing", "problem", "seconds"}."""
    started = time.monotonic()
    labs = {topic: exercises.topic_exercises(topic) for topic in (*job.texts, *job.missing)}
    labs = {topic: labs[topic] for topic in exercises.topics() if topic in labs}
    numbers = [exercise.number for lab in labs.values() for exercise in lab
               if job.extra or not exercise.is_extra]
    examination = Examination(job, labs)
    found, problems = runner.run_checks(labs, numbers, "labs", job.seed, [examination])
    entries = [entry._replace(verdict="failing") if entry.exercise.number in examination.lost
               else entry for entry in board.entries(labs, numbers, {}, found)]
    return {"board": json.loads(board.as_json(entries)), "lost": examination.lost,
            "missing": examination.missing,
            "problem": examination.problem or "\n".join(problems) or None,
            "seconds": time.monotonic() - started}


def end_with_the_grader():
    """Interrupt this process when its standard input ends: the grader ended, or wants no more."""
    def wait():
        os.read(0, 1)
        _thread.interrupt_main()

    threading.Thread(target=wait, daemon=True).start()


def main(folder):
    end_with_the_grader()
    folder = Path(folder)
    places.OUT = folder
    sandbox.adopt_orphans()
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (PARENT_MEMORY, PARENT_MEMORY))
    job = Job(**json.loads((folder / "job.json").read_text("utf-8")))
    result = json.dumps(examine(job)).replace(f"{folder}/", "out/")  # as a student would see it
    places.write_whole(folder / "result.json", result.encode())


if __name__ == "__main__":
    main(sys.argv[1])
