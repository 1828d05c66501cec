"""Does an answer become right when its inputs are exchanged, transposed or turned around?

Then it mixes them up, which often shows in no number that it returns.
"""
import contextlib
import inspect
import io
import itertools
import time

import numpy as np

from ..given.contract import as_array, called

SECONDS = 1.0  # for all that is tried


def mixed_up(function, args, kwargs, is_right):
    """How the inputs of a call must be changed so that is_right(what it returns), or None."""
    ends = time.perf_counter() + SECONDS
    try:
        bound = inspect.signature(function).bind(*args, **kwargs)
    except (TypeError, ValueError):
        return None
    inputs = dict(bound.arguments)
    for change, changed in changes(inputs):
        if time.perf_counter() > ends:
            return None
        bound.arguments.update(inputs | changed)
        with contextlib.suppress(Exception), contextlib.redirect_stdout(io.StringIO()):
            if is_right(called(function, *bound.args, **bound.kwargs)):
                return change
    return None


def changes(inputs):
    """Yield (what is done to the inputs {name: value}, {name: its other value})."""
    kinds = {name: (as_array(value).shape, as_array(value).dtype.kind)
             for name, value in inputs.items()}
    for one, other in itertools.combinations(inputs, 2):
        if kinds[one] == kinds[other] and kinds[one][1] in "bif":
            yield f"{one} and {other} exchanged", {one: inputs[other], other: inputs[one]}
    for name, value in inputs.items():
        if isinstance(value, np.ndarray) and value.ndim:
            for change, array in changed_array(name, value):
                yield change, {name: np.ascontiguousarray(array)}
        elif isinstance(value, float | np.floating):
            for change, number in (("half of", value / 2), ("twice", 2 * value), ("minus", -value),
                                   ("the degrees of", np.degrees(value))):
                yield f"{change} {name}", {name: number}


def changed_array(name, array):
    """Yield (what is done to an array, the other array)."""
    if array.ndim >= 2:
        yield f"{name} transposed", array.swapaxes(-1, -2)
    if array.ndim >= 2 and array.shape[-1] == array.shape[-2] and array.dtype.kind == "f":
        with contextlib.suppress(np.linalg.LinAlgError):
            yield f"{name} inverted", np.linalg.inv(array)
    for axis, length in enumerate(array.shape):
        if length in (2, 3, 4):
            for i, j in itertools.combinations(range(length), 2):
                order = [{i: j, j: i}.get(k, k) for k in range(length)]
                yield (f"{i} and {j} exchanged along axis {axis} of {name}",
                       np.take(array, order, axis))
        if length == 3:
            yield f"axis {axis} of {name} moved on by one", np.roll(array, 1, axis)
            yield f"axis {axis} of {name} moved back by one", np.roll(array, -1, axis)
        if length > 3:
            yield f"axis {axis} of {name} reversed", np.flip(array, axis)
    if array.dtype.kind == "f":
        yield f"minus {name}", -array
        lengths = np.linalg.norm(array, axis=-1, keepdims=True)
        if array.shape[-1] in (2, 3) and lengths.all():
            yield f"{name} scaled to length 1", array / lengths
    if array.dtype.kind == "b":
        yield f"{name} turned into its opposite", ~array
