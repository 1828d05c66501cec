"""The contract of all exercises: what goes in, what may come out. `called` makes checks keep it.

    Given     arrays of floats (float64), integers, booleans or complex numbers, single numbers,
              strings, and tuples of all these, with None for a part that is not there. The
              NamedTuples of given code are such tuples, and their names may be used. An exercise
              leaves what it is given as it is.
    Returned  the right numbers, in any form: a list in place of an array, an array of the shape ()
              in place of a number, [] in place of any array without numbers, any memory order, any
              type that holds the numbers exactly.
              Several outputs are a tuple. In place of a NamedTuple a plain tuple will do.
    Raised    a ValueError, where the fine print says so.
    Warnings  do not count.
    To do     An exercise that is not written yet raises NotImplementedError, see TODO.

The checks call the code under test through `called`, and so does the gradient check.
"""
import re
import warnings

import numpy as np

TODO = "exercise {}: {}"  # the text of its NotImplementedError: number, name
UNFINISHED = re.compile(TODO.format(r"(\d+\.\d+)", r"(\w+)"))
STANDARD = {"i": np.intp, "f": np.float64, "c": np.complex128}  # by NumPy's dtype.kind


def called(function, *args, **kwargs):
    """What function(*args, **kwargs) returns, in standard form. Its warnings are not shown."""
    with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
        return standard(function(*args, **kwargs))


def standard(value):
    """An array in C order, of float64, np.intp, complex128 or booleans, or one NumPy number.

    A tuple becomes a tuple of these, and so does a list whose rows differ in length. A NamedTuple
    stays one. What is neither a number nor an array of numbers stays as it is.
    """
    if isinstance(value, tuple):
        return mapped(standard, value)
    if not isinstance(value, np.ndarray | np.generic | bool | int | float | complex | list | range):
        return value
    array = as_array(value)
    if array.dtype == object:
        return tuple(map(standard, value)) if isinstance(value, list) else value
    small = array.dtype.kind == "u" and array.itemsize < 8
    kind = np.intp if small else STANDARD.get(array.dtype.kind, array.dtype)
    return np.asarray(array, kind, order="C")[()]


def mapped(function, value):
    """A tuple of what a function makes of the parts of a tuple. A NamedTuple stays one."""
    parts = map(function, value)
    return type(value)._make(parts) if hasattr(value, "_fields") else tuple(parts)


def as_array(value):
    """The value as an array. What makes none comes as an array of objects, as None does. An array
    of objects that are numbers is one of numbers.
    """
    try:
        array = np.asarray(value)
        return np.asarray(array.tolist()) if array.dtype == object else array
    except ValueError:  # rows of different lengths
        return np.array(None)


def unchanged(old, new):
    """Is what a function was given the same as before the call, to the bit?"""
    if isinstance(old, tuple | list):
        return len(old) == len(new) and all(map(unchanged, old, new))
    if isinstance(old, dict):
        return all(map(unchanged, old.values(), new.values()))
    return not isinstance(old, np.ndarray) or old.tobytes() == new.tobytes()
