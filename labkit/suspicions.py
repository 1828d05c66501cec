"""Common mistakes that show in the numbers alone, as a flipped sign does.

Each is tried on what was expected. It is named if it makes of this what came, number for number:

    suspicion(got, expected, agrees)  ->  "the sign is flipped" if agrees(got, -expected)

So it is a fact about the numbers. Where fewer than ENOUGH of them are wrong, it may be chance.
"""
import itertools
from math import comb
from typing import NamedTuple

import numpy as np

from .contract import as_array

TRUTHS = 4  # truth values say as much as one number
ENOUGH = 4  # so many wrong numbers that a mistake explains are no chance
DIGITS = 3e-7  # about the relative error of float32, and of a finite difference
HALF_DIGITS = 2e-3  # about that of float16, after a few sums
COARSE = 64  # any kind of float has such fractions: that all are multiples of 1/64 is no rounding
FLOORED = " // 2 stands for "  # as few sizes have such a factor, two numbers tell it
ANYWHERE = " in all that is wrong"  # here and there, which may be chance
COMMON_FACTORS = ((2, ", twice as much: a factor of 2 too many"),
                  (0.5, ", half of it: a factor of 2 is missing, or a mean of two is no sum"),
                  (1 / 3, ": a mean of three, not their sum, is a third of what was expected"),
                  (180 / np.pi, ": degrees for radians"), (np.pi / 180, ": radians for degrees"))


class Suspicion(NamedTuple):
    """A sentence, and whether the numbers are ENOUGH to be certain of it."""

    sentence: str
    certain: bool

    def __str__(self):
        return self.sentence if self.certain else f"it may be that {self.sentence}"


@np.errstate(all="ignore")
def suspicion(got, expected, agrees, inputs=(), picture=False):
    """The Suspicion that explains all that is wrong in got, or None.

    got, expected: arrays that do not agree. agrees(got, other) -> booleans. inputs: [(name, value)]
    of the call, to name a factor by. picture: row 0 of both is at the bottom.
    """
    speaking = evidence(got, expected, agrees)
    for sentence, mistaken in mistakes(got, expected, picture):
        if mistaken.shape == got.shape and np.all(agrees(got, mistaken)):
            several = speaking >= 2 or got.shape != expected.shape
            return Suspicion(sentence, speaking >= ENOUGH) if several else None
    if got.shape != expected.shape or got.dtype.kind not in "biufc":
        return None
    wrong = np.broadcast_to(~agrees(got, expected), got.shape)
    found = [*whole_numbers(got, expected),
            *["it is zero everywhere"] * (has_sign(expected) and not got.any()),
            *scaled(got, expected, agrees, inputs),
            *(sentence for sentence, mistaken in distorted(got, expected)
              if speaking >= 2 and np.all(agrees(got, mistaken))), *imprecise(got, expected),
            *in_a_part(got, expected, wrong, agrees, inputs)] if is_numeric(got, expected) else []
    found += by_index(wrong, inputs, np.isfinite(got).all())
    found.sort(key=lambda sentence: ANYWHERE in sentence)
    enough = 2 if found and (found[0].startswith("float") or FLOORED in found[0]) else ENOUGH
    sure = found and not (found[0].endswith("?") or ANYWHERE in found[0]) and speaking >= enough
    return Suspicion(found[0], sure) if found else None


def evidence(got, expected, agrees):
    """How many numbers speak for a mistake that explains them: the wrong ones, truth values less.

    None does where only one value was expected.
    """
    wrong = np.ones(expected.shape, bool)
    if got.shape == expected.shape:
        wrong = ~np.broadcast_to(agrees(got, expected), expected.shape)
    if len(set(expected.ravel().tolist())) < 2:
        return 0
    return int(wrong.sum()) // (TRUTHS if expected.dtype.kind == "b" else 1)


def is_numeric(*arrays):
    return all(array.dtype.kind in "iufc" for array in arrays)


def has_sign(array):
    """Integers may be indices, which have no sign, and no size: -1 means none."""
    return array.dtype.kind in "fc"


def mistakes(got, expected, picture):
    """Yield (a common mistake, what was expected with the mistake in it)."""
    if expected.dtype.kind == "b":
        yield "true and false are swapped", ~expected
    if is_numeric(got, expected) and has_sign(expected):
        yield "the sign is flipped", -expected
    if "c" in (got.dtype.kind, expected.dtype.kind):
        yield "the complex conjugate came", expected.conj()
    if picture and expected.ndim >= 2:
        yield from misplaced(expected)
    yield from in_another_order(expected, not picture)
    if got.shape != expected.shape:
        yield from in_another_shape(got, expected)
    elif got.dtype.kind == expected.dtype.kind == "f" and np.allclose(
            np.sort(got, None), np.sort(expected, None), 1e-9, 0):
        yield "the numbers are right, and stand in another order", got


def misplaced(picture):
    yield "it is upside down; row 0 is at the bottom", picture[::-1]
    yield "left and right are swapped", picture[:, ::-1]
    for axis, step, place in ((0, -1, "low"), (0, 1, "high"),
                              (1, -1, "far left"), (1, 1, "far right")):
        yield f"it is one pixel too {place}", np.roll(picture, step, axis)


def in_another_order(expected, along_axes):
    """Yield what was expected, with axes exchanged, or an axis in another order."""
    if expected.ndim == 2:
        shapes = "({1}, {0}) instead of ({0}, {1})".format(*expected.shape)
        yield f"it is the transpose, {shapes}: rows and columns are swapped", expected.T
    elif expected.ndim > 2:
        for axes in itertools.combinations(range(expected.ndim), 2):
            yield f"axes {axes[0]} and {axes[1]} are swapped", expected.swapaxes(*axes)
    if along_axes and expected.ndim > 1 and expected.shape[-1] == 2:
        yield "[..., 0] and [..., 1] are swapped", expected[..., ::-1]
    for axis in range(expected.ndim if along_axes else 0):
        yield f"the order along axis {axis} is reversed", np.flip(expected, axis)
        whole = range(expected.shape[axis])
        for order in itertools.permutations(whole) if len(whole) <= 4 else ():
            yield f"the order along axis {axis} is {list(order)}", np.take(expected, order, axis)


def in_another_shape(got, expected):
    """Yield (how it got another shape, got itself), where the numbers are those expected."""
    if got.size == expected.size and is_numeric(got, expected) and np.allclose(
            got.ravel(), expected.ravel(), 1e-9, equal_nan=True):
        yield "the numbers are right, the shape is not", got
    part = expected[tuple(map(slice, got.shape))] if got.ndim == expected.ndim else expected
    if part.shape == got.shape and got.size and is_numeric(got, expected) and np.allclose(
            got, part, 1e-9, equal_nan=True):
        yield f"the rest of it is missing: {got.shape} of {expected.shape}", got
    for axis in (None, *range(expected.ndim)) if is_numeric(got, expected) and got.any() else ():
        if np.shape(total := expected.sum(axis)) == got.shape and np.allclose(got, total, 1e-9):
            yield f"it is summed over {'all axes' if axis is None else f'axis {axis}, too'}", got
    for axis in range(got.ndim if got.ndim == expected.ndim + 1 and is_numeric(got) else 0):
        for k in range(min(got.shape[axis], 4)):
            part = np.take(got, k, axis)
            if part.shape == expected.shape and np.allclose(part, expected, 1e-9):
                yield f"it is number {k} along axis {axis} that was expected, alone", got
        for name in "sum", "mean":
            reduced = getattr(got, name)(axis)
            if reduced.shape == expected.shape and np.allclose(reduced, expected, 1e-9):
                yield f"the {name} over axis {axis} is missing", got


def distorted(got, expected):
    """Yield (what became of the numbers, what was expected with it)."""
    if "c" in (got.dtype.kind, expected.dtype.kind):
        return
    if np.any(expected < 0) and np.any(expected > 0):
        yield "negative numbers came as positive ones", np.abs(expected)
        yield "negative numbers came as 0", np.maximum(expected, 0)
    for mended, whole in (("down", np.floor(expected)), ("toward 0", np.trunc(expected)),
                          ("to the nearest", np.rint(expected))):
        yield f"the numbers are rounded {mended}, as by //, int or an array of integers", whole
    if has_sign(expected):  # a count of steps that stop too early is 0 or 1, too
        yield "the numbers are cut off at 0 and 1", np.clip(expected, 0, 1)
    if set(np.unique(expected)) - {-1, 0, 1}:
        yield "the square of what was expected came", expected ** 2
        yield "the square root of what was expected came", np.sqrt(expected)
        yield "1 over what was expected came", 1 / expected
    if expected.ndim and expected.shape[-1] in (2, 3, 4):
        for name, size in (("they have length 1", np.linalg.norm), ("they sum to 1", np.sum)):
            sizes = size(got, axis=-1)
            if np.allclose(size(expected, axis=-1), 1) and sizes.all() and np.ptp(sizes) > 0:
                yield (f"the numbers along the last axis are not scaled until {name}",
                       expected * size(got, axis=-1, keepdims=True))


def whole_numbers(got, expected):
    """Yield that integers came where fractions were expected."""
    if got.dtype.kind in "iu" and expected.dtype.kind == "f" and np.any(expected % 1):
        yield "these are integers, and fractions were expected: look for //, int or integer arrays"


def scaled(got, expected, agrees, inputs):
    """Yield that all is off by one factor, one summand, or a factor that an input holds."""
    counted = np.count_nonzero(np.isfinite(expected) & (expected != 0))
    finite = np.isfinite(got) & np.isfinite(expected)
    if counted >= 2 and finite.any() and has_sign(expected):
        there = expected[finite]
        factor = np.real_if_close(np.vdot(there, got[finite]) / np.vdot(there, there))
        if factor and np.all(agrees(got, factor * expected)):
            yield (f"everything is {factor:.6g} times what was expected{named(factor, inputs)}")
    more = got.flat[0] - expected.flat[0]
    if got.size >= ENOUGH and np.isfinite(more) and np.all(agrees(got, expected + more)):
        yield f"everything is {abs(more):.6g} {'more' if more > 0 else 'less'} than expected"
    for name, array in inputs:
        yield from times_an_input(got, expected, agrees, name, as_array(array))


def named(factor, inputs):
    """"; width / 2 is 4": the sizes among the inputs that a factor, or 1 over it, is made of."""
    for common, words in COMMON_FACTORS:
        if np.isclose(factor, common, 1e-6):
            return words
    sizes = {name: value for name, value in inputs if not np.iterable(value)}
    sizes |= {f"len({name})": len(value) for name, value in inputs
              if np.iterable(value) and (len(value) > 4 or as_array(value).ndim > 1)}
    for name, value in sizes.items():
        if isinstance(value, int) and value % 2 and np.isclose(factor, 1 - 1 / value, 1e-9):
            return f": {name}{FLOORED}{name} / 2"
    size = max(abs(factor), 1 / abs(factor))
    found = [f"{name}{part}" for name, value in sizes.items()
             if isinstance(value, int | float | np.number) and not isinstance(value, bool)
             for part, made in (("", value), (" / 2", value / 2))
             if made > 2 and np.isclose(size, made, 1e-6)]
    if found:
        return f"; {' or '.join(found[:3])} is {size:.6g}"
    simple = any(np.isclose(n * size, np.round(n * size), 1e-6) for n in (1, 2, 3))
    return "" if simple and size < 100 else ": is a factor missing, or one too many?"


def times_an_input(got, expected, agrees, name, array):
    """Yield that each number is off by its own factor or summand, which stands in an input."""
    for title, column in columns(name, array):
        for part in column, column[..., None]:
            if np.ptp(part) == 0 or not broadcasts(part.shape, expected.shape):
                continue
            for verb, mistaken in (("multiplied by", expected * part),
                                   ("divided by", expected / part),
                                   ("plus", expected + part), ("minus", expected - part)):
                if np.all(agrees(got, mistaken)):
                    yield f"it is what was expected, {verb} {title}"


def columns(name, array):
    """[(name, array)] of an input of finite floats, and its columns, if it has no more than 4."""
    if array.dtype.kind != "f" or not array.ndim or not array.size or (
            not np.isfinite(array).all()):
        return []
    width = array.shape[-1] if array.shape[-1] in (2, 3, 4) else 0
    return [(name, array), *((f"{name}[..., {k}]", array[..., k]) for k in range(width))]


def broadcasts(shape, other):
    try:
        return np.broadcast_shapes(shape, other) == other
    except ValueError:
        return False


def imprecise(got, expected):
    """Yield that all is nearly right."""
    if not (got.dtype.kind == expected.dtype.kind in "fc" and np.isfinite(expected).all()):
        return
    error = np.abs(got - expected) / np.abs(expected).max(initial=0)
    single = np.complex64 if got.dtype.kind == "c" else np.float32
    half = [("float16", np.float16, HALF_DIGITS)] * (got.dtype.kind == "f")
    for name, kind, most in *half, ("float32", single, DIGITS):
        if np.all(error < most) and np.all(got == kind(got)) and np.any(
                COARSE * got != np.rint(COARSE * got)):
            yield f"{name} is not precise enough; compute in float64"
    if np.all(error < DIGITS) and np.median(error) > 1e-11:
        yield ("it is right to seven digits or so: something is computed in float32, or as a "
               "finite difference")


def in_a_part(got, expected, wrong, agrees, inputs):
    """Yield what is wrong in some of the numbers alone, and where."""
    part, right = got[wrong], expected[wrong]
    if wrong.all() or not wrong.any() or not np.isfinite([part, right]).all() or (
            not has_sign(expected)):
        return

    def holds(mistaken):
        full = got.astype(np.result_type(got, mistaken))
        full[wrong] = mistaken
        return np.all(agrees(got, full))

    place, whole = next(places(wrong, expected == 0, inputs), (ANYWHERE, None))
    several = whole is not None or len(set(np.abs(right))) > 1  # else any number is a multiple
    if whole is not None and np.ptp(got[whole]) == 0 and (
            np.ptp(expected[whole]) or not got[whole].any()):
        yield f"it is {got[whole][0]:.6g} everywhere{place}"
    elif several and holds(-right):
        yield f"the sign is flipped{place}"
    elif several and part.any() and len(right) >= 2 and np.all(right):
        factor = part[0] / right[0]
        if holds(factor * right):
            yield f"it is {factor:.6g} times what was expected{place}{named(factor, inputs)}"


def places(wrong, zero, inputs):
    """Yield (" in [..., 1]", all of it): the places along a short axis where all is that is wrong.
    Several are wrong all over, but for what is expected to be zero.

    Then (" where w < 0", all of it): the sign of an input, if it is wrong just there.
    """
    for axis in reversed(range(wrong.ndim)):
        others = tuple(k for k in range(wrong.ndim) if k != axis)
        along = np.flatnonzero(wrong.any(others))
        whole = np.broadcast_to(wrong.any(others, keepdims=True), wrong.shape)
        if len(along) < wrong.shape[axis] <= 4 and (len(along) == 1 or (wrong | zero)[whole].all()):
            after = ", :" * (wrong.ndim - 1 - axis)
            yield " in " + " and ".join(f"[..., {k}{after}]" for k in along), whole
    for name, value in inputs:
        for title, column in columns(name, as_array(value)):
            rows = wrong.reshape(*wrong.shape[:column.ndim], -1).any(-1)
            for sign, there in ("<", column < 0), (">", column > 0):
                if np.array_equal(rows, there) and comb(rows.size, rows.sum()) > 1000:  # no chance
                    yield f" where {title} {sign} 0", there


def by_index(wrong, inputs, finite):
    """Yield what an input of indices tells about the rows or pixels that are wrong.

    finite: no NaN came, and nothing infinite, which a row that is not added up does not become.
    """
    for name, index in inputs:
        index = as_array(index)
        if index.dtype.kind not in "iu" or not index.ndim or not index.size:
            continue
        none = index == -1
        if none.any() and not none.all() and wrong.shape[:index.ndim] == index.shape:
            at = wrong.reshape(*index.shape, -1).any(-1)
            for value, why in ((-1, "-1, which means none; as an index, -1 takes the last"),
                               (0, "0: that is the first, and only -1 means none")):
                if at.any() and not (at & (index != value)).any():
                    yield f"it is wrong only where {name} is {why}"
        if wrong.ndim and 0 <= index.max() < len(wrong):
            rows = wrong.reshape(len(wrong), -1).any(-1)
            times = np.bincount(index[index >= 0], minlength=len(wrong))
            if finite and np.any(times == 1) and np.array_equal(rows, times > 1):
                yield (f"it is right in rows that {name} names once, and wrong in those that it "
                       "names more often: is every one added, as np.add.at does, and not only "
                       "the last?")
            if none.any() and rows[-1] and not rows[:-1].any():
                yield f"only the last row is wrong: {name} has -1, and NumPy takes it for the last"
