"""Open tasks: what no reference answers. A scorer draws what is asked for, and says what holds.

A task is a module tasks/NAME.py with

    FUNCTION, POINTS      the function that labs/NAME.py must have; what all claims are worth
    SECONDS, ALL_SECONDS  that one call may take, and all of them
    COUNTED               (topic, name) of the labs' function whose calls are counted, or None
    trials(seed)          [(name, arguments)] of all calls
    expected(seed)        what an answer is compared with: lists and numbers, one for each trial
    claims(trials, expected, answers)    [(claim, whether it holds, why)]
    TRIES_IT              whether what the function returns is tried: it is called once, with
                          nothing, and a trial's one argument is the text of a module of ours,
                          whose function of that name gets what was returned

An answer is an array of numbers, or None where a call returned none. The score is the share of the
claims that hold.
"""
import contextlib
import functools
import importlib
import json
import time

import numpy as np

from . import contract, places
from .checks import loader
from .checks.alarm import at_most
from .checks.assertions import Mismatch
from .checks.report import Check
from .checks.showing import PACKAGE, layout
from .exercises import Exercise
from .verdicts import Entry


def scorer(task):
    return importlib.import_module(f"tasks.{task}")


def column(task) -> Exercise:
    """The task as what counts, in the place of an exercise."""
    return Exercise(task, scorer(task).FUNCTION, scorer(task).POINTS, 0, ())


def expected(task, seeds) -> dict:
    """{name: seed} -> {name: what the scorer expects}."""
    return {name: scorer(task).expected(seed) for name, seed in seeds.items()}


def judged(task, name, points, call, run, seed, expected) -> Entry:
    """Ask for all trials of a seed -> an Entry of this name. call(*arguments) -> what is returned.

    run(a module's text, what was returned): see TRIES_IT. expected: what the scorer expects.
    """
    found, answers, wrong = scorer(task).trials(seed), [], []
    if scorer(task).TRIES_IT:
        call = tried(call, run)
    for _, given in found:
        answers.append(None)
        with noted(wrong):
            answers[-1] = in_numbers(call(*given))
    why = layout([("wrong", wrong[0])] if wrong else [])
    checks = [Check(name, f"{name}::{claim}", claim, "passed" if holds else "failed",
                    "\n".join(filter(None, [said, why])), None, 0.0, False)
              for claim, holds, said in scorer(task).claims(found, expected, answers)]
    verdict = "done" if all(check.verdict == "passed" for check in checks) else "failing"
    return Entry(name, scorer(task).FUNCTION, task, points, False, verdict, False, checks)


def tried(call, run):
    """run(text, returned) as a function of the text alone: call() once, and try what it returns."""
    once = functools.cache(call)
    return lambda text: run(text, once())


def run_here(task, text, returned):
    """What a module's function makes of what was returned, beside the code under test."""
    names = {"__name__": f"{PACKAGE}.{task}", "__package__": PACKAGE}
    exec(text, names)
    return names[scorer(task).FUNCTION](returned)


class Ended(BaseException):
    """A call takes too long. What it calls may catch all errors, and would go on after one."""


def in_time(call, one):
    """The call, stopped after so many seconds of a processor as its scorer, one, says of a call or
    leaves of all, and after five times as many on the clock.
    """
    began = time.process_time(), time.monotonic() / 5

    def stopped(*given):
        spent = time.process_time() - began[0], time.monotonic() / 5 - began[1]
        if (seconds := min(one.SECONDS, one.ALL_SECONDS - max(spent))) <= 0:
            raise TimeoutError(f"the {one.ALL_SECONDS:g} s for all are used up")
        try:
            with at_most(seconds, Ended, True), at_most(5 * seconds, Ended):
                return call(*given)
        except Ended:
            raise TimeoutError(f"stopped after {seconds:.2g} s of a processor, or "
                               f"{5 * seconds:.2g} s on the clock") from None

    return stopped


def in_numbers(returned):
    """As an array. Mismatch: it is none. It does not say what it is, which could be a message."""
    try:
        return np.asarray(returned, dtype=np.float64)
    except (TypeError, ValueError):
        raise Mismatch(("wrong", "it returned no array of numbers")) from None


def counted(names, name):
    """Count the calls of a module's function from now on: the list that is returned grows."""
    calls, function = [], names[name]
    names[name] = lambda *args, **kwargs: (calls.append(1), function(*args, **kwargs))[1]
    return calls


@contextlib.contextmanager
def noted(wrong):
    """What a call raises is noted, and is no answer."""
    try:
        yield
    except Mismatch as mismatch:
        wrong.append(dict(mismatch.rows)["wrong"])
    except Exception as error:
        wrong.append(f"{type(error).__name__}: {error}")


def loaded(code, task, topic, name):
    """The task's function, and the calls of what is counted. ValueError: it is not there."""
    find, wrong = loader.finder(code), []
    with noted(wrong):
        find(task, scorer(task).FUNCTION)
        calls = counted(vars(loader.load_topic(code / f"{topic}.py")), name)
        return find(task, scorer(task).FUNCTION), calls
    raise ValueError(wrong[0])


def check(task, implementation, seed) -> int:
    """Score labs/TASK.py at home, and show it -> 0 if all claims hold, else 1."""
    code, one = loader.folder(implementation), scorer(task)
    if not (code / f"{task}.py").exists():
        raise ValueError(f"there is no {places.shown_path(code / task)}.py: copy "
                         f"tasks/naive/{task}.py there, and make it better")
    kept = places.out("tasks", f"{task}-{seed}.json")  # for some tasks it takes a while
    if not kept.exists():
        places.write_whole(kept, json.dumps(one.expected(seed)).encode())
    with loader.package(code):
        topic, name = one.COUNTED or (task, one.FUNCTION)
        (function, calls), began = loaded(code, task, topic, name), time.process_time()
        call, run = (in_time(functools.partial(*given), one) for given in (
            (contract.called, function.__wrapped__), (run_here, task)))
        entry = judged(task, task, one.POINTS, call, run, seed, json.loads(kept.read_bytes()))
        seconds = time.process_time() - began
    print(*(f"{each.verdict:7} {each.claim}: {each.message}" for each in entry.checks), sep="\n")
    print(f"{task}: {entry.told_points(entry.reached)}. It took {seconds:.1f} of "
          f"{one.ALL_SECONDS:g} s, and {len(calls)} calls of {topic}.{name}: see tasks/{task}.md.")
    return int(entry.verdict != "done")
