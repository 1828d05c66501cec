"""What a check asserts: numbers within a tolerance, values that are equal, a picture."""
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .. import places
from ..contract import as_array
from .pictures import draw, text_map
from .showing import index_name, kind_name, layout, shape_name, shown

# By NumPy's dtype.kind: what may come where this kind is expected.
CLOSE_KINDS = {"b": "b", "i": "iuf", "u": "iuf", "f": "iuf", "c": "iufc"}
LEAST = 8  # rows and columns of an array that is drawn as a picture, though it may be none
NAN = "nan is no number: it comes from 0 / 0, inf * 0, inf - inf, or the mean of nothing"
EQUAL_KINDS = {"b": "b", "i": "iu", "u": "iu", "f": "iuf", "c": "iufc", "U": "U"}


class Compared(NamedTuple):
    """Two arrays that do not agree: agrees(got, expected) -> booleans. Are they pictures?"""

    got: np.ndarray
    expected: np.ndarray
    agrees: Callable
    picture: bool


class Mismatch(AssertionError):
    """What is wrong: rows (label, text) of the report.

    compared: what hints are found in, picture: the path of one. Both may be None.
    """

    def __init__(self, *rows, compared=None, picture=None):
        super().__init__(layout(rows))
        self.rows = rows
        self.compared = compared
        self.picture = picture


def assert_close(got, expected, given=None, rtol=1e-9, atol=1e-12):
    """|got - expected| <= atol + rtol |expected| in every number. Infinities and NaNs must match.

    got: what a call returned: an array of expected's shape, or a tuple where expected is one.
    given: what the report shows as the input. By default, the last call to the code under test.
    """
    __tracebackhide__ = True

    def agrees(got, expected):
        return np.isclose(got, expected, rtol, atol, equal_nan=True)

    compare(got, expected, given_row(given), CLOSE_KINDS, agrees,
            allowed=f"{atol:g} + {rtol:g} |expected|")


def assert_equal(got, expected, given=None):
    """got is expected: integers, booleans, strings, floats to the bit, or a tuple of them.

    Integers must come as integers, booleans as booleans. got and given: see assert_close.
    """
    __tracebackhide__ = True

    def agrees(got, expected):
        return (got == expected) | ((got != got) & (expected != expected))  # NaN is NaN

    compare(got, expected, given_row(given), EQUAL_KINDS, agrees, allowed="0")


def assert_picture(got, expected, given=None, atol=0.0):
    """|got - expected| <= atol in a raster (H, W) or (H, W, C) whose row 0 is at the bottom.

    If not, draws expected | got | difference to out/checks/, the worst pixel in a box. A small
    raster of booleans, or of indices where -1 means none, is printed as well. given: see above.
    """
    __tracebackhide__ = True

    def agrees(got, expected):
        return np.isclose(got, expected, 0, atol, equal_nan=True)

    kinds = EQUAL_KINDS if np.asarray(expected).dtype.kind in "biu" else CLOSE_KINDS
    compare(got, expected, given_row(given), kinds, agrees, allowed=f"{atol:g}", picture=True)


def assert_refused(function, *args):
    """function(*args) raises a ValueError. Where it is graded, that comes as a Mismatch's text."""
    __tracebackhide__ = True
    try:
        got = function(*args)
    except ValueError:
        return
    except Mismatch as error:
        if error.rows[0][1].startswith("ValueError"):
            return
        raise
    raise Mismatch(("expected", "a ValueError"), ("got", shown(got)))


def parts(returned, *names):
    """What was returned, one output for each name. Mismatch: they are not as many."""
    __tracebackhide__ = True
    if not are_several(returned, len(names)):
        raise Mismatch(("wrong", f"{len(names)} outputs are expected: {', '.join(names)}"))
    return returned


def are_several(returned, count):
    is_row = isinstance(returned, tuple | list) or (isinstance(returned, np.ndarray)
                                                    and returned.ndim)
    return is_row and len(returned) == count


def given_row(given):
    is_case = isinstance(given, str)  # beside the call, which is shown, too
    return [] if given is None else [("case", given) if is_case else ("given", shown(given))]


def compare(got, expected, rows, kinds, agrees, allowed, picture=False):
    """Raise a Mismatch unless got is of expected's kind and shape, and agrees in every number."""
    __tracebackhide__ = True
    if isinstance(expected, tuple):
        compare_outputs(got, expected, rows, kinds, agrees, allowed)
        return
    if is_nothing(got, expected):
        return
    rows = [*rows, ("expected", shown(expected)), ("got", shown(got))]
    compared = Compared(as_array(got), np.asarray(expected), agrees, picture)
    require_kind(got, compared, rows, kinds)
    require_shape(compared, rows)
    got, expected, *_ = compared
    wrong = ~np.asarray(agrees(got, expected))
    if not wrong.any():
        return
    if rows[-2][1] == rows[-1][1]:  # they differ in a digit that is not shown
        rows[-2:] = [("expected", shown(expected, digits=17)), ("got", shown(got, digits=17))]
    rows += whereabouts(got, expected, wrong, allowed)
    is_seen = picture or (min(expected.shape[:2], default=0) >= LEAST and expected.ndim > 1
                          and expected[..., None].shape[2] <= 4 and expected.dtype.kind in "bif")
    raise drawn(compared, wrong, rows) if is_seen else Mismatch(*rows, compared=compared)


def compare_outputs(got, expected, rows, *how):
    """compare, for a tuple: one output after the other."""
    __tracebackhide__ = True
    if not are_several(got, len(expected)):
        raise Mismatch(*rows, ("expected", shown(expected)), ("got", shown(got)),
                       ("differs", f"a tuple of {len(expected)} was expected"))
    for number, pair in enumerate(zip(got, expected, strict=True), 1):
        compare(*pair, [*rows, ("output", f"{number} of {len(expected)}")], *how)


def is_nothing(got, expected):
    """Is it [] where an array without numbers is expected? What was never filled has no columns."""
    return np.size(expected) == 0 and as_array(got).shape == (0,)


def require_kind(got, compared, rows, kinds):
    """Mismatch unless got is of a kind that may come where expected's kind is expected. Of numbers
    in another shape, the shape is told.
    """
    __tracebackhide__ = True
    array, expected, agrees, _ = compared
    are_numbers = array.dtype.kind in "biufc"
    if array.dtype.kind not in kinds[expected.dtype.kind] and not (
            are_numbers and array.shape != expected.shape):
        right = "; the numbers are right" * (are_numbers and bool(np.all(agrees(array, expected))))
        raise Mismatch(*rows, ("differs", f"in kind: {kind_name(got)} came, "
                                          f"{kind_name(expected)} were expected{right}"),
                       compared=compared if are_numbers and not right else None)


def require_shape(compared, rows):
    """Mismatch unless got has the shape of what is expected."""
    __tracebackhide__ = True
    got, expected, *_ = compared
    if got.shape != expected.shape:
        of_rows = got.ndim == expected.ndim and got.shape[1:] == expected.shape[1:]
        raise Mismatch(*rows, ("differs", f"in {'length' if of_rows else 'shape'}: "
                                          f"{shape_name(got)} came, "
                                          f"{shape_name(expected)} was expected"),
                       compared=compared)


def drawn(compared, wrong, rows):
    """The Mismatch of a picture, with a map of it in letters and the path of its PNG."""
    got, expected, *_ = compared
    rows = [*rows, *text_map(got, expected)]
    try:
        path = draw(got, expected, distances(got, expected, wrong))
    except OSError as error:  # nowhere to draw, as where students' work is graded
        return Mismatch(*rows, ("picture", f"none: {error}"), compared=compared)
    return Mismatch(*rows, ("picture", places.shown_path(path)), compared=compared,
                    picture=str(path))


def whereabouts(got, expected, wrong, allowed):
    """A row, or none: in 4 of 12, first at [3, 1]: 0.5 came, ..., by 2 at most, at [0, 2]."""
    parts = []
    if wrong.ndim:
        first = tuple(np.argwhere(wrong)[0])
        parts += [f"in {wrong.sum()} of {wrong.size}, first at {index_name(first)}: "
                  f"{shown(got[first])} came, {shown(expected[first])} was expected"]
    if "f" in (got.dtype.kind, expected.dtype.kind) or expected.dtype.kind == "c":
        distance = distances(got, expected, wrong)
        worst = np.unravel_index(distance.argmax(), distance.shape)
        at = f" at most, at {index_name(worst)}" if wrong.sum() > 1 else ""
        by = f"by {distance[worst]:.3g}{at}; allowed {allowed}"
        parts += [NAN if np.isnan(got[wrong]).any() else by]
    return [("differs", "; ".join(parts))] if parts else []


def distances(got, expected, wrong):
    """|got - expected| where wrong, infinite where one is NaN, 1 for indices. 0 where right."""
    if got.dtype.kind in "biu" and expected.dtype.kind in "biu":
        return wrong.astype(float)
    numbers = complex if "c" in (got.dtype.kind, expected.dtype.kind) else float
    with np.errstate(invalid="ignore"):
        distance = np.abs(got.astype(numbers) - expected.astype(numbers))
    return np.where(wrong, np.nan_to_num(distance, nan=np.inf, posinf=np.inf), 0)
