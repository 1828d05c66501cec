"""How values, calls and errors are shown to a student, and the rows that a report is made of."""
import contextlib
import inspect
import re
import textwrap
import traceback
from pathlib import Path

import numpy as np
import pytest

from .. import places
from ..contract import as_array
from ..suspicions import broadcasts

PACKAGE = "implementation"  # the code under test is imported by this name; a student's is labs
COLUMNS, LABEL = 80, 10  # of a report; of these, its labels take up
MOST_NUMBERS = 36  # shown of an array; a larger one is shortened
MOST_LINES = 12    # shown of an error's text, of frames, of printed output
MOST_QUOTED = 200  # characters shown of a line of code: one can be as long as a file
AN_AXIS = "keepdims=True keeps an axis of length 1, and None in an index adds one"
LAST_AXIS = (".T turns all of them round, and np.stack(parts, -1) joins parts along a new last "
             "axis")
IN_WORDS = {  # a part of an error's text: what it means, and what helps
    "must have same number of dimensions": f"what is joined needs equally many axes: {AN_AXIS}",
    "concatenation axis must match": "what is joined has one shape but along the joined axis, 0 if "
                                     "you name no other, as axis=-1. Or has a sum or a mean the "
                                     "wrong axis, or none?",
    "truth value of an array": "if, and, or, not take one truth value, and here are many. For "
                               "arrays write &, |, ~, each comparison in brackets, or np.where.",
    "SystemExit": "exit() and quit() end the whole program: return ends a function",
    "bitwise_": "& and | come before < and ==: put each comparison in brackets"}
KIND_NAMES = {"b": "booleans", "i": "integers", "u": "integers", "f": "floats",
              "c": "complex numbers", "U": "strings"}  # by NumPy's dtype.kind


# --- values and calls -------------------------------------------------------------------------


def shown(value, digits=8):
    """A value as one reads it. A large array is shortened."""
    if isinstance(value, np.ndarray | list) and as_array(value).dtype != object:
        return shown_array(np.asarray(value), "", digits)
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return typed(value)
    if isinstance(value, tuple):
        return f"({', '.join(map(shown, value))}{',' * (len(value) == 1)})"
    return cut(repr(value.item() if isinstance(value, np.generic) else value))


def is_large(array):
    return array.size > MOST_NUMBERS


def shown_array(array, before, digits=8):
    """All of a small array. First and last numbers of a large one, after its type and shape."""
    small = 0 < array.size <= MOST_NUMBERS
    before = before if small else f"{before}{array.dtype} {shape_name(array)}: "
    text = np.array2string(array if small else array.ravel(), separator=", ", prefix=before,
                           max_line_width=COLUMNS - LABEL - 3, threshold=MOST_NUMBERS, edgeitems=3,
                           precision=digits if small else digits // 2)
    return before + re.sub(r"\n\s*\n", "\n", text)  # no empty lines between parts of 3 dimensions


def typed(value, before=""):
    """A value as one types it, to be pasted, but for large arrays."""
    if isinstance(value, tuple) and hasattr(value, "_fields"):  # as the call that makes it
        return before + shown_call(type(value), value, {})
    if isinstance(value, tuple):
        return f"{before}({', '.join(map(typed, value))}{',' * (len(value) == 1)})"
    if not isinstance(value, np.ndarray):
        return before + shown(value)
    if value.dtype == object or is_large(value):
        return shown_array(value, before)
    if not value.size:
        return f"{before}np.zeros({shape_name(value)}, '{value.dtype}')"
    return shown_array(value, f"{before}np.array(") + ")"


def shown_call(function, args, kwargs):
    """edge_function(p=np.array([0.5, 0.5]), a=...), on several lines where one is not enough."""
    named = [typed(value, f"{name}=" if name else "")
             for name, value in arguments(function, args, kwargs)]
    line = f"{function.__name__}({', '.join(named)})"
    if len(line) <= COLUMNS - LABEL and "\n" not in line:
        return line
    lines = [text.replace("\n", "\n  ") + "," for text in named]
    return "\n  ".join([f"{function.__name__}(", *lines]) + "\n)"


def large_arrays(name, value):
    """Yield (name, array) if a value is an array too large to be shown, or holds such arrays."""
    if isinstance(value, tuple):
        names = getattr(value, "_fields", range(len(value)))
        for place, part in zip(names, value, strict=True):
            yield from large_arrays(f"{name}_{place}", part)
    elif isinstance(value, np.ndarray) and is_large(value):
        yield name, value


def arguments(function, args, kwargs):
    """[(parameter, argument)] of a call. Where it does not fit, the names are empty."""
    try:
        return list(inspect.signature(function).bind(*args, **kwargs).arguments.items())
    except (TypeError, ValueError):
        return [("", argument) for argument in args] + list(kwargs.items())


def kind_name(value):
    name = f"a {type(value).__name__} that is no array of numbers"
    return KIND_NAMES.get(as_array(value).dtype.kind, name)


def shape_name(array):
    return f"({', '.join(map(str, array.shape))}{',' * (array.ndim == 1)})"


def index_name(index):
    return f"[{', '.join(map(str, index))}]"


# --- errors -----------------------------------------------------------------------------------


def error_text(error, code) -> str:
    """An error, and the lines in the folder with the code under test that led to it."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__)
              if Path(frame.filename).resolve().is_relative_to(code)]
    lines = shown_frames([(places.shown_path(frame.filename), frame.lineno, frame.name, frame.line)
                          for frame in frames])
    lines += [*shapes_there(error.__traceback__, frames[-1]), *fitting(error)] if frames else []
    if isinstance(error, SyntaxError) and error.filename:  # a zero byte has no place
        lines += [f"{places.shown_path(error.filename)}:{error.lineno}\n    {quoted(error.text)}"]
        return "\n".join([f"{type(error).__name__}: {error.msg}", *lines])
    plain = not lines and isinstance(error, AssertionError | pytest.fail.Exception)
    text = str(error) if plain else f"{type(error).__name__}: {error}".removesuffix(": ")
    text = text.replace(f"'{PACKAGE}", "'labs")
    return "\n".join([cut(text), *lines])


def shapes_there(trace, last):
    """A line, or none: the shapes of the arrays that are named where an error came from."""
    frames = [frame for frame, line in traceback.walk_tb(trace)
              if (frame.f_code.co_filename, line) == (last.filename, last.lineno)]
    known = frames[-1].f_locals
    known = {name: value for name, value in known.items() if isinstance(value, np.ndarray)}
    names = re.findall(r"(?<![.\w])([A-Za-z_]\w*)(?:\[(\w+)\])?", quoted(last.line))
    shapes = {name: known[name] for name, _ in names if name in known}
    with contextlib.suppress(IndexError):  # then that is the error
        shapes |= {f"{name}[{index}]": known[name][known[index]] for name, index in names
                   if name in known and index in known}
    shapes = [f"{name} {shape_name(array)}" for name, array in shapes.items()]
    return [f"    there: {', '.join(shapes)}"] if shapes else []


def fitting(error):
    """Yield a line in plain words, where the shapes in an error tell why arrays do not fit."""
    text = f"{type(error).__name__}: {error}"
    shapes = sorted((tuple(map(int, re.findall(r"\d+", shape)))
                     for shape in re.findall(r"\([\d,]+\)", text)), key=len)
    if "gufunc signature" in text or "not aligned" in text:
        sizes = " and ".join(re.findall(r"(?:size|from|aligned:|!=) (\d+)", text))
        yield ("    A @ B sums over the last axis of A and the last but one of B, a vector's only "
               f"one. They differ: {sizes} numbers. Is one to be transposed (.T, or swapaxes(-1, "
               "-2) for a stack), or the order wrong? For rows' dot products, (a * b).sum(-1).")
    elif "indexing result" in text and len(shapes[0]) < len(shapes[1]):
        yield ("    x[index] takes rows of x, along its first axis alone: is x to be reshaped "
               "before, so that index numbers its rows?")
    elif "broadcast" in text and len(shapes) == 2:
        yield f"    {unfit(*shapes)}"
    yield from (f"    {words}" for part, words in IN_WORDS.items() if part in text)


def unfit(short, long):
    """Why two shapes do not broadcast, and what helps."""
    fits = [each for ones in ((1,), (1,) * (len(long) - len(short))) for k in range(len(short) + 1)
            if broadcasts(each := (*short[:k], *ones, *short[k:]), long)]
    if fits:
        dot = f". Or is {long} to be transposed, or summed over its last axis, as in a dot product?"
        return f"{short} fits as {fits[0]}: {AN_AXIS}{dot * (long[:-1] == short)}"
    if short == long[::-1]:
        return f"{short} and {long} are equal when one is transposed, .T: rows became columns"
    pairs = zip(reversed(short), reversed(long), strict=False)
    one, other = next((pair for pair in pairs if len({*pair, 1}) == 3), (short, long))
    return (f"lengths are compared from the last axis on, and must be equal or 1. Here {one} and "
            f"{other} meet: are both of the same things, and their axes in the same order?")


def axes_in_words(got, right, inputs=()):
    """What became of an axis, where the shapes of what came and was expected tell it, or None.

    Integers, as a list of pairs, are no sum over an axis of an input.
    """
    came, expected = got.shape, right.shape
    if () in (came, expected):
        return f"one number {'is expected' if came else 'came'}: which axes are to be summed?"
    if sorted(came) == sorted(expected):
        return f"the axes stand in another order: {came} for {expected}. {LAST_AXIS}"
    if axis := the_axis(expected, came):
        return f"axis {axis[0]} is lost: a sum, a mean or an index took it away; {AN_AXIS}"
    if len(expected) == 1 and came == 2 * expected:
        return (f"{expected} with {(*expected, 1)} gives {came}: each number met all others, as "
                "one of two arrays has an axis too many")
    if axis := the_axis(came, expected):
        return f"axis {axis[0]} is too many: is it to be summed, or is one number of it meant?"
    for name, array in inputs if right.dtype.kind in "fc" else ():
        shape = np.shape(as_array(array))
        wrong, lost = the_axis(shape, came), the_axis(shape, expected)
        if wrong and lost:
            return (f"without axis {wrong[0]}, {name} {shape} becomes {came}, and without axis "
                    f"{lost[0]} {expected}: a sum over the wrong axis, or x[0] for x[..., 0]?")


def the_axis(long, short):
    """(axis,) without which the one shape is the other, () if there is none."""
    return tuple(k for k in range(len(long)) if long[:k] + long[k + 1:] == short)[-1:]


def cut(text):
    lines = text.splitlines()
    return "\n".join(lines[:MOST_LINES] + ["..."] * (len(lines) > MOST_LINES))


def quoted(line):
    """A line of code, as far as it is shown. None: it is not there any more."""
    line = (line or "").strip()
    return line[:MOST_QUOTED] + "..." * (len(line) > MOST_QUOTED)


def shown_frames(frames):
    """(file, line, function, its text) of each call -> lines, the first and last of many."""
    lines = [f"{file}:{line} in {function}\n    {quoted(text)}"
             for file, line, function, text in frames]
    if len(lines) > MOST_LINES:
        lines[4:-4] = [f"... {len(lines) - 8} more calls ..."]
    return lines


# --- rows -------------------------------------------------------------------------------------


def layout(rows) -> str:
    """Rows (label, text) in two columns, long lines broken. Commands stay whole, to be copied."""
    lines = ((label if number == 0 else "", line) for label, text in rows
             for number, line in enumerate(text.splitlines() if label == "again" else broken(text)))
    return "\n".join(f"{label:{LABEL}}{line}".rstrip() for label, line in lines)


def broken(text):
    """The lines of a text, none too long: what is over goes on below, indented alike."""
    for line in text.splitlines() or [""]:
        indent = line[:len(line) - len(line.lstrip())]
        yield from textwrap.wrap(line, COLUMNS - LABEL, subsequent_indent=indent,
                                 break_long_words=False, break_on_hyphens=False) or [""]


def plural(count: int, word: str) -> str:
    return f"{count} {word}{'s' * (count != 1)}"
