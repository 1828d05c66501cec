"""Answers of few bytes that would be much work for the trusted side: bounded before it is done."""
import time
import types

import numpy as np
import pytest

from labkit import exercises, places
from labkit.checks import Mismatch, loader, runner
from labkit.grading.apart import examination, wire

resource = pytest.importorskip("resource")  # Windows has none
ONES = np.ones(1 << 20, bool)
DEEP = ONES
for _ in range(40):
    DEEP = [DEEP]
TUPLES = ()
for _ in range(300):
    TUPLES = (TUPLES,)
FORMS = {
    "31 axes of length 1": ONES.reshape(-1, *[1] * 31), "7 axes of length 1": ONES.reshape(
        -1, *[1] * 7), "numbers with 7 of them": np.ones((1 << 18, *[1] * 7), np.float32),
    "many axes, many times": tuple(np.ones((1 << 12, *[1] * 7), bool) for _ in range(400)),
    "16 million bytes": np.ones((1 << 24) - 999, np.int8), "float16": np.ones(1 << 21, np.float16),
    "nan": np.full(1 << 20, np.nan), "the least float": np.full(1 << 20, 5e-324),
    "rows of nothing": np.zeros((1 << 16, 0)), "many of them": (np.zeros((1 << 16, 0)),) * 60,
    "2,500 arrays": (np.ones(1),) * 2500, "tuples in tuples": TUPLES, "lists in lists": DEEP,
    "a list of arrays": [np.ones(1 << 10)] * 1000, "lists of arrays": [[ONES[:9]] * 40] * 60,
    "long integers": [10 ** 4000] * 30, "a long string among many": ["a" * 999, *[""] * 30_000],
    "a dictionary": {"a" * k: [[k] * 90] for k in range(200)}, "lists": [[1, 2]] * 15_000}
CHANGES = tuple((0, np.array(2.0)) for _ in range(2500))


@pytest.mark.parametrize(("form", "number"), [
    *((form, "1.1") for form in FORMS), ("changed inputs", "4.8")])
def test_no_answer_is_much_work(form, number, monkeypatch, tmp_path):
    """An array of 2^20 x 1^31 takes 15 s and 2.6 GB for each check on paper, outside of all limits.
    """
    monkeypatch.setattr(places, "OUT", tmp_path)
    sent = wire.encode((FORMS.get(form, 1.0), CHANGES if form == "changed inputs" else (), ""))

    def find(topic, name):
        def call(*args, **kwargs):
            try:
                value, changed, _ = wire.decode(sent, {}, wire.MOST_ANSWER)
            except wire.Garbled as error:
                raise Mismatch(("wrong", str(error))) from None
            inputs = list(wire.arrays_in((args, tuple(kwargs.values()))))
            return examination.Examination.outcome(
                types.SimpleNamespace(show=print), topic, name, ("returned", value, changed, ""),
                inputs)

        return call

    def answering(config):
        config.stash[loader.FIND] = find

    labs, _ = exercises.asked_for(number)
    before, begun = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
    found, _ = runner.run_checks(labs, [number], "labs", 0,
                                 [types.SimpleNamespace(pytest_configure=answering)])
    taken = time.process_time() - begun
    more = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    print(f"{form}, {number}: {taken:.2f} s, {more >> 10} MB, {len(found)} checks")
    assert found and not any(check.verdict == "passed" for check in found)
    assert taken < 1.5 * len(found) and more < 400_000
