"""Does an answer become right when its inputs are exchanged, transposed or turned around?

Then it mixes them up, which often shows in no number that it returns.
"""
import contextlib
import copy
import inspect
import io
import itertools
import time

import numpy as np

from ..contract import as_array, called

RETRY_SECONDS = 1.0  # for all that is tried


def mixed_up(function, args, kwargs, is_right):
    """What a function does with the inputs of a call: without it, is_right(what it returns)."""
    ends = time.perf_counter() + RETRY_SECONDS
    try:
        bound = inspect.signature(function).bind(*args, **kwargs)
    except (TypeError, ValueError):
        return None
    inputs = dict(bound.arguments)
    for mistake, mended in mistakes(inputs):
        if time.perf_counter() > ends:
            return None
        bound.arguments.update(inputs | mended)
        with contextlib.suppress(Exception), contextlib.redirect_stdout(io.StringIO()):
            given = copy.deepcopy((bound.args, bound.kwargs))  # what it changes is not the check's
            if is_right(called(function, *given[0], **given[1])):
                return mistake
    return None


def mistakes(inputs):
    """Yield (a mistake with the inputs {name: value}, {name: the value that makes up for it})."""
    kinds = {name: (as_array(value).shape, as_array(value).dtype.kind)
             for name, value in inputs.items()}
    for one, other in itertools.combinations(inputs, 2):
        if kinds[one] == kinds[other] and kinds[one][1] in "bif":
            yield f"{one} and {other} are exchanged", {one: inputs[other], other: inputs[one]}
    for name, value in inputs.items():
        if isinstance(value, np.ndarray) and value.ndim:
            for mistake, array in with_an_array(name, value):
                yield mistake, {name: np.ascontiguousarray(array)}
        elif isinstance(value, float | np.floating):
            yield f"{name} counts twice", {name: value / 2}
            yield f"half of {name} is taken", {name: 2 * value}
            yield f"{name} is taken for degrees", {name: np.degrees(value)}
            yield f"the sign of {name} is flipped", {name: -value}


def with_an_array(name, array):
    """Yield (a mistake with an array, the array that makes up for it)."""
    yield from with_its_axes(name, array)
    if array.ndim >= 2:
        yield f"{name} is transposed", array.swapaxes(-1, -2)
    if array.dtype.kind == "b":
        yield f"true and false of {name} are swapped", ~array
    if array.dtype.kind == "f":
        if array.ndim >= 2 and array.shape[-1] == array.shape[-2]:
            with contextlib.suppress(np.linalg.LinAlgError):
                yield f"{name} is inverted", np.linalg.inv(array)
        lengths = np.linalg.norm(array, axis=-1, keepdims=True)
        if array.shape[-1] in (2, 3) and lengths.all():
            yield f"{name} is not scaled to length 1", array / lengths
        yield f"the sign of {name} is flipped", -array


def with_its_axes(name, array):
    """Yield (a mistake with an axis of an array, the array that makes up for it)."""
    for axis, length in enumerate(array.shape):
        for i, j in itertools.combinations(range(length), 2) if length <= 4 else ():
            order = [{i: j, j: i}.get(k, k) for k in range(length)]
            yield (f"{i} and {j} are exchanged along axis {axis} of {name}",
                   np.take(array, order, axis))
        if length == 3:
            yield f"axis {axis} of {name} is moved on by one", np.roll(array, 1, axis)
            yield f"axis {axis} of {name} is moved back by one", np.roll(array, -1, axis)
        if length > 3:
            yield f"axis {axis} of {name} is reversed", np.flip(array, axis)
