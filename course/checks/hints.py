"""Hints: which common mistake explains a wrong answer.

Some are found in the numbers alone: a flipped sign, swapped axes. Others are known mistakes of
tests/mistakes/. There, what a mistake returned to a check is kept as a fingerprint.
"""
import functools
import hashlib
import json
from pathlib import Path

import numpy as np

from ..given.contract import as_array
from .showing import shape_name

HINTS = Path(__file__).with_name("hints.json")
FRACTIONS = 1, 2, 3, 4, 180 / np.pi, np.pi / 180  # a factor is told if it is whole times one


def hint(got, expected, agrees, picture):
    """A row that names a common mistake, if got without this mistake agrees with expected."""
    with np.errstate(all="ignore"):
        for mistake, mended in suspicions(got, expected, picture):
            if mended.shape == expected.shape and np.all(agrees(mended, expected)):
                return [("hint", mistake)]
    return []


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
    if numeric and got.shape == expected.shape and np.count_nonzero(expected) > 1:
        yield from off_everywhere(got, expected)


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


def known_mistake(nodeid, returned):
    """"this is what comes out when ...", if a mistake of tests/mistakes/ returns the same there."""
    if returned is None:
        return None
    sentence = known_sentences().get(fingerprint(nodeid, returned))
    return sentence and f"this is what comes out when {sentence}"


@functools.cache
def known_sentences():
    """{fingerprint: sentence}: course/checks/hints.json, made by python3 -m course mistakes."""
    try:
        made = json.loads(HINTS.read_bytes())
    except OSError:
        return {}
    return {mark: sentence for sentence, marks in made.items() for mark in marks}


def fingerprint(nodeid, returned):
    """Twelve letters for what a check was returned: the same for equal numbers but for rounding."""
    parts = [nodeid.rpartition("/")[2]]
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
