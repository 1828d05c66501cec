"""Hints: which common mistake explains a wrong answer.

Some are found in the numbers alone: a flipped sign, swapped axes. Others are known mistakes of
tests/mistakes/. What a mistake returned to each check that it fails is kept as a fingerprint. It is
named only where a student's answer fails the same checks with the same numbers, and no others.
"""
import functools
import hashlib
import json
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..given.contract import as_array
from .showing import shape_name

HINTS = Path(__file__).with_name("hints.json")
ENOUGH = 4  # so many equal numbers are no chance
FRACTIONS = 1, 2, 3, 4, 180 / np.pi, np.pi / 180  # a factor is told if it is whole times one


def hint(got, expected, agrees, picture):
    """A row that names a common mistake, if got without this mistake agrees with expected."""
    with np.errstate(all="ignore"):
        for mistake, mended in suspicions(got, expected, picture):
            if mended.shape == expected.shape and np.all(agrees(mended, expected)):
                certain = evidence(got, expected, agrees) >= ENOUGH
                return [("hint", mistake if certain else f"it may be that {mistake}")]
    return []


def evidence(got, expected, agrees):
    """How many numbers are wrong and speak for a mistake."""
    if got.shape != expected.shape:
        return expected.size
    return np.count_nonzero(~np.broadcast_to(agrees(got, expected), expected.shape))


def suspicions(got, expected, picture):
    """Yield (a common mistake, got without it)."""
    numeric = got.dtype.kind in "iufc"
    if numeric:
        yield "the sign is flipped", -got
    if got.dtype.kind == "f" and got.shape == expected.shape and np.all(got == np.float32(got)):
        yield ("float32 is not precise enough; compute in float64",
               np.where(np.isclose(got, expected, 2e-6, 0), expected, got))
    if got.dtype.kind == "b" and got.ndim:
        yield "true and false are swapped", ~got
    if got.ndim >= 2:
        yield "rows and columns are swapped", got.swapaxes(0, 1)
        yield "the last two axes are swapped", got.swapaxes(-1, -2)
    if picture and got.ndim >= 2:
        yield from misplaced(got)
    else:
        for axis in range(got.ndim):
            yield f"the order along axis {axis} is reversed", np.flip(got, axis)
            if got.shape[axis] == 3:
                yield from exchanged(got, axis)
    if numeric and got.shape == expected.shape and np.count_nonzero(expected) >= ENOUGH:
        yield from off_everywhere(got, expected)


def exchanged(got, axis):
    """Yield (corners, coordinates or colours in a wrong order, got in the right one)."""
    for places in (0, 1), (1, 2):
        order = np.arange(3)
        order[list(places)] = places[::-1]
        yield (f"{places[0]} and {places[1]} are exchanged along axis {axis}",
               np.take(got, order, axis))
    for step in 1, -1:
        yield f"the order along axis {axis} is moved on by one", np.roll(got, step, axis)


def misplaced(picture):
    """Yield (a common mistake, the picture without it)."""
    yield "it is upside down; row 0 is at the bottom", picture[::-1]
    yield "left and right are swapped", picture[:, ::-1]
    for axis, step, place in ((0, 1, "low"), (0, -1, "high"),
                              (1, 1, "far left"), (1, -1, "far right")):
        yield f"it is one pixel too {place}", np.roll(picture, step, axis)


def off_everywhere(got, expected):
    """Yield (how far everything is off, got without it), judged by the largest number."""
    largest = np.unravel_index(np.abs(expected).argmax(), expected.shape)
    factor = got[largest] / expected[largest]
    more = got[largest] - expected[largest]
    if any(np.isclose(factor * n, np.round(factor * n), 1e-9, 0) for n in FRACTIONS):
        yield f"everything is {factor:.4g} times what was expected", got / factor
    than = "more" if more > 0 else "less"
    yield f"everything is {abs(more):.4g} {than} than expected", got - more


class Pattern(NamedTuple):
    """How a wrong answer does in the checks of an exercise.

    failed {check: the fingerprint of what it was returned, or None} of the question, and of the
    fine print where the question is answered; numbers: so many were returned there.
    """

    failed: dict
    numbers: int


def pattern(checks):
    """The Pattern of checks that fail: (nodeid, fingerprint or None, numbers, fine_print) each."""
    of_question = [check for check in checks if not check[3]]
    counted = of_question or checks
    return Pattern({short(nodeid): mark for nodeid, mark, *_ in counted},
                   sum(numbers for _, _, numbers, _ in counted))


def known_mistake(exercise, found):
    """"this is what comes out when ...": the known mistake that has the Pattern found, or None.

    All that it fails is failed, with the same numbers, and nothing else. Fewer than ENOUGH numbers
    can be the same by chance.
    """
    for sentence, failed in known_mistakes().get(exercise, ()):
        if found.numbers and failed == found.failed:
            certain = found.numbers >= ENOUGH
            return f"this {'is' if certain else 'may be'} what comes out when {sentence}"
    return None


@functools.cache
def known_mistakes():
    """{exercise: [(sentence, its Pattern's failed)]}: course/checks/hints.json, see upkeep."""
    try:
        return json.loads(HINTS.read_bytes())
    except OSError:
        return {}


def short(nodeid):
    """tests/labs/test_x.py::test_y -> test_x.py::test_y."""
    return nodeid.rpartition("/")[2]


def mark(nodeid, returned):
    """(fingerprint, how many numbers) of what a check was returned; (None, 0) if nothing was."""
    return (None, 0) if returned is None else (fingerprint(nodeid, returned), count(returned))


def count(returned):
    """How many numbers, truth values or letters were returned."""
    outputs = returned if isinstance(returned, tuple) else (returned,)
    return sum(count(output) if isinstance(output, tuple) else np.size(output)
               for output in outputs)


def fingerprint(nodeid, returned):
    """Twelve letters for what a check was returned: the same for equal numbers but for rounding."""
    parts = [short(nodeid)]
    several = isinstance(returned, tuple) or as_array(returned).dtype == object
    for output in returned if several and np.iterable(returned) else (returned,):
        array = as_array(output)
        if array.dtype.kind in "fc":
            size = np.abs(array[np.isfinite(array)]).max(initial=1e-3)
            array = np.round(array, int(6 - np.ceil(np.log10(size)))) + 0.0  # no -0
        kind = "n" if array.dtype.kind in "iufc" else array.dtype.kind
        numbers = array.astype(complex) if kind == "n" else array
        parts += [kind, shape_name(array), str(numbers.tolist())]
    return hashlib.sha256("|".join(parts).encode("utf-8")).hexdigest()[:12]
