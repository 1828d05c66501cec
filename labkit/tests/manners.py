"""Other manners, which other_forms.py adds to a module: its exercises return their numbers in one
form after another, warn in every call, and refuse what checks have not promised to give. See
labkit/contract.py.
"""
import functools
import itertools
import warnings

import numpy as np

CALLS = []  # of exercises that have not returned


def by_columns(array):
    """Columns one after the other, not to be written; numbers as Python has them."""
    array = array.copy(order="F")
    array.flags.writeable = False
    return array if array.ndim else array.item()


def short(array):
    """int32, and float32 where it holds the numbers; an array of the shape () for a number."""
    kind = {"i": np.int32, "f": np.float32}.get(array.dtype.kind, array.dtype)
    shortened = array.astype(kind)
    return shortened if np.array_equal(shortened, array, equal_nan=kind == np.float32) else array


def objects(array):
    return array.astype(object)


FORMS = itertools.cycle([np.ndarray.tolist, by_columns, short, objects])


def formed(returned, form):
    if isinstance(returned, tuple):
        return tuple(formed(output, form) for output in returned)
    plain = returned is None or isinstance(returned, str)
    return returned if plain else form(np.asarray(returned))


def require_promised(given):
    if isinstance(given, tuple):
        for part in given:
            require_promised(part)
    elif isinstance(given, np.ndarray):
        assert given.dtype in (float, complex, bool) or given.dtype.kind in "iu", given.dtype
    else:
        assert given is None or isinstance(given, int | float | str | np.number), type(given)


def in_forms(function):
    """The function as a check calls it; where one exercise calls another, nothing changes."""
    function = getattr(function, "written", function)  # nothing stands in for it

    @functools.wraps(function)
    def call(*args, **named):
        if not CALLS:
            require_promised((*args, *named.values()))
        CALLS.append(function)
        try:
            returned = function(*args, **named)
        finally:
            CALLS.pop()
        if CALLS:
            return returned
        warnings.warn("this does not matter", stacklevel=1)
        np.ones(1) / 0
        return formed(returned, next(FORMS))

    return call
