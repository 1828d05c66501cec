"""The verdict on a check, and the report of one that failed.

A verdict is passed, failed, not started (the exercise raises its own NotImplementedError still) or
blocked by 2.1 (another one does). A check that is skipped or expected to fail counts as failed.
"""
import contextlib
import inspect
import io
import re
import traceback
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .. import places
from ..contract import UNFINISHED
from ..table import COMMAND
from . import hints, showing
from .assertions import NAN, Mismatch
from .loader import CALLS, LAST_CALL, LAST_RETURN, WARNED, folder
from .showing import MOST_LINES, arguments, error_text, large_arrays, layout, shown, shown_call

NO_NAME = r"-?\d|each\b|all\b|a number"  # of what stands between the names of outputs
OTHER_FORM = "in shape", "in kind", "a tuple"  # so begins how an answer differs
INVALID = "an invalid value (0 / 0, inf * 0 or inf - inf)"


class Check(NamedTuple):
    """What became of a check. The board is made of these."""

    exercise: str
    nodeid: str
    claim: str
    verdict: str  # passed, failed, not run, not started, blocked by 2.1
    message: str
    picture: str | None
    seconds: float
    fine_print: bool
    mark: str | None = None  # of a failed one: the fingerprint of what was returned to it
    numbers: int = 0         # so many were returned
    suspected: tuple | None = None  # of a failed one: what hints.suspected says
    catches: str = ""        # of a failed one: the mistakes that it was written for
    drawn: bool = False      # its numbers are drawn, from the seed: nobody knows them before

    @property
    def function(self) -> str:
        """Its function in the tests. It is one claim, whatever its cases."""
        return self.nodeid.partition("[")[0]


def judge(item, error, report, mark):
    """Set report.check, report.outcome where the check did not run, and report.longrepr.

    mark: the check's. It names the exercise.
    """
    number = mark.args[0]
    with contextlib.suppress(Exception):  # else it is the last one that is shown
        item.stash[LAST_CALL], item.stash[LAST_RETURN] = compared_call(item, error.compared)
    verdict, rows = verdict_and_rows(item, error, report, number)
    lines = report.capstdout.splitlines()[-MOST_LINES:]
    printed = [("printed", "\n".join(lines))] if lines and rows else []
    returned = item.stash.get(LAST_RETURN, None) if verdict == "failed" else None
    compared = getattr(error, "compared", None)
    as_known = item.config.option.seed == 0 or not is_drawn(item)
    known = (hints.fingerprint_and_count(item.nodeid, returned, compared) if as_known
             else (hints.OTHER, 0))
    found = suspected(error, item, compared, returned)
    catches = caught(item, error, rows) if verdict == "failed" else ""
    report.check = Check(number, item.nodeid, claim(item), verdict, layout([*rows, *printed]),
                         getattr(error, "picture", None), report.duration, is_fine_print(mark),
                         *known, found and tuple(found), catches, is_drawn(item))._asdict()
    if report.failed and item.config.option.tbstyle == "auto":
        perhaps = [("perhaps", catches)] if catches else []
        report.longrepr = layout([("claim", claim(item)), *perhaps, *rows,
                                  ("again", "\n".join(commands(item, number)))])


def compared_call(item, compared):
    """The call that returned what was compared, and its result: a check may go on to other calls.

    Of a check that makes a row of each call, it is that of the first row that is wrong.
    """
    calls = item.stash[CALLS]
    for call, returned in reversed(calls):
        if hints.place_in(returned, compared.got) is not None:
            return call, returned
    got, expected, agrees, _ = compared
    if len(calls) != len(got):
        return calls[-1]
    wrong = ~agrees(got, expected)
    row = np.unravel_index(wrong.argmax(), wrong.shape)[0]
    return calls[row if hints.is_made_of(got[row], calls[row][1]) else -1]


def is_drawn(item):
    """Are a check's numbers drawn, from the seed?"""
    return "rng" in item.fixturenames


def suspected(error, item, compared, returned):
    """What `hints.suspected` says. An error, or what is no array, speaks against all suspicions."""
    if compared is None and (isinstance(error, Mismatch) or not isinstance(error, AssertionError)):
        return hints.NOTHING
    with contextlib.suppress(Exception):  # a report without a hint is better than none
        return hints.suspected(compared, item.stash.get(LAST_CALL, None), returned)


def without_report(item, error, report, mark):
    """Set what `judge` sets, where that was not possible. The check has failed."""
    report.outcome, report.longrepr = "failed", layout([("wrong", "what was returned cannot be "
                                                         f"reported: {type(error).__name__}")])
    report.check = Check(mark.args[0], item.nodeid, claim(item), "failed", report.longrepr, None,
                         report.duration, is_fine_print(mark))._asdict()


def verdict_and_rows(item, error, report, number):
    """The verdict on a check, and the rows that say why. One that did not run has failed."""
    if report.skipped or hasattr(report, "wasxfail") or (report.failed and error is None):
        vars(report).pop("wasxfail", None)  # else pytest goes on to count it as expected
        report.outcome = "failed"
        return "failed", [("wrong", "a check has to run and pass; this one is skipped or expected "
                                    "to fail")]
    if report.passed:
        return "passed", []
    verdict = verdict_of(error, number)
    rows = explained(error, item) if verdict == "failed" else [("verdict", f"{verdict} ({error})")]
    return verdict, rows


def is_fine_print(mark) -> bool:
    """Whether a check is of its exercise's fine print, and not of the question."""
    return mark.kwargs.get("fine_print", False)


def verdict_of(error, number):
    unfinished = isinstance(error, NotImplementedError) and UNFINISHED.fullmatch(str(error))
    if not unfinished:
        return "failed"
    return "not started" if unfinished[1] == number else f"blocked by {unfinished[1]}"


def explained(error, item):
    """Rows: what a check gave, what came of it, and where.

    Assertion errors of other kinds, as the gradient check's, tell by themselves what was given.
    """
    rows = list(error.rows) if isinstance(error, Mismatch) else [("wrong", said(error, item))]
    other_kind = isinstance(error, AssertionError) and type(error) not in (AssertionError, Mismatch)
    last = item.stash.get(LAST_CALL, None)
    if last and "given" not in dict(rows) and (
            not other_kind or last[0].__name__.endswith("_backward")):
        rows[:0] = [("given", shown_call(*last)), *saved(last)]
    returned = item.stash.get(LAST_RETURN, None)
    if returned is not None and "got" not in dict(rows) and not other_kind:
        rows.append(("got", shown(returned)))
    labels = [label for label, _ in rows]
    if "output" not in labels and "expected" in labels:
        place = labels.index("expected")
        rows[place:place] = output_row(error.compared, returned)
    if last and isinstance(returned, tuple):
        rows = [(label, text + named(last[0], text, returned) if label == "output" else text)
                for label, text in rows]
    if dict(rows).get("differs", "").startswith(("in shape", "in length")):
        words = showing.axes_in_words(*error.compared[:2], arguments(*last) if last else ())
        rows += [("shape", words)] if words else []
    return [*rows, *warned(error, item), ("check", check_line(error, item))]


def warned(error, item):
    """Yield a row, or none: what NumPy warned of first, and its line in the code under test."""
    kind, frames = item.stash.get(WARNED, ("", ()))
    code = folder(item.config.option.impl)
    for frame in frames if isinstance(error, AssertionError) else ():
        if Path(frame.filename).resolve().is_relative_to(code):
            where = f"{places.shown_path(frame.filename)}:{frame.lineno}"
            kind = kind.replace("invalid value", INVALID)
            yield "warning", (f"NumPy met {kind}, first at {where}\n    "
                              f"{showing.quoted(frame.line)}\nno mistake if the result is not used")
            return


def caught(item, error, rows):
    """The mistakes that a check was written for, where it came so far; else "", as after a crash,
    where shape or kind are wrong, or NaN came and they do not speak of it.
    """
    differs = dict(rows).get("differs", "")
    if not isinstance(error, AssertionError) or differs.startswith(OTHER_FORM) or (
            isinstance(error, Mismatch) and "expected" not in dict(rows)):
        return ""
    text = " ".join((inspect.getdoc(item.function) or "").partition("\n\n")[0].split())
    return "" if NAN in differs and "nan" not in text.lower() else text


def output_row(compared, returned):
    """A row, or none: which of several outputs was compared."""
    is_part = compared is not None and isinstance(returned, tuple)
    place = hints.place_in(returned, compared.got) if is_part else None
    return [] if place is None else [("output", f"{place + 1} of {len(returned)}")]


def named(function, place, returned):
    """": grad_uv" for place "1 of 2", if what was returned or else the function's question names so
    many outputs, else "".
    """
    question = (inspect.getdoc(function) or "").partition("Fine print.")[0].partition(">>>")[0]
    text = re.sub(r"\([^()]*\)", "", question).partition("->")[2]
    told = re.split(r"[.:;](?=\s|$)|\n\n", text)[0]
    number, count = map(int, place.split(" of "))
    names = getattr(returned, "_fields", None) or [
        name for part in re.split(r",|\band\b", told)
        if (name := " ".join(part.split())) and not re.match(NO_NAME, name)]
    return f": {names[number - 1]}" if len(names) == count else ""


def said(error, item):
    """An error in words: where it came from, in the code under test or in the check."""
    text = error_text(error, folder(item.config.option.impl))
    last = traceback.extract_tb(error.__traceback__)[-1]
    returned = item.stash.get(LAST_RETURN, None)
    of_form = TypeError, ValueError, IndexError, AttributeError
    if returned is None or Path(last.filename).parent != item.path.parent \
            or not isinstance(error, of_form):
        return text
    name = item.stash[LAST_CALL][0].__name__
    if "unpack" in str(error):
        came = f"{len(returned)} outputs" if isinstance(returned, tuple) else "one array or number"
        expected = re.search(r"expected (\d+)", str(error))
        parts = f"of {expected[1]}" if expected else "of several outputs"
        return f"{name} returned {came}; a tuple {parts} is expected"
    order = ": are its axes those of the question, and in that order?" * hasattr(returned, "shape")
    return f"what {name} returned does not fit{order}\n{text}"


def saved(call):
    """A row, or none: where the inputs of a call are that are too large to be shown."""
    large = dict(pair for name, value in arguments(*call) for pair in large_arrays(name, value))
    if not large:
        return []
    content = io.BytesIO()
    try:
        path = places.check_picture(call[0].__name__).with_suffix(".npz")
        np.savez_compressed(content, **{name or "input": array for name, array in large.items()})
        places.write_whole(path, content.getvalue())
    except OSError:  # nowhere to write, as where students' work is graded
        return []
    return [("inputs", f'np.load("{places.shown_path(path)}") has {", ".join(large)}')]


def check_line(error, item):
    """tests/labs/test_rasterization.py:31, and the code there."""
    lines = [frame for frame in traceback.extract_tb(error.__traceback__)
             if Path(frame.filename) == item.path]
    if not lines:
        return f"{places.shown_path(item.path)}:{item.location[1] + 1}"
    return f"{places.shown_path(item.path)}:{lines[-1].lineno}\n{lines[-1].line}"


def claim(item) -> str:
    """test_a_face__s_area_is_positive -> "A face's area is positive", and its parameters."""
    words = item.originalname.removeprefix("test_").replace("__", "' ").replace(
        "' s_", "'s ").replace("_s_", "'s ").replace("_", " ")
    case = f" [{item.callspec.id}]" if hasattr(item, "callspec") else ""
    fine = " (fine print)" * is_fine_print(item.get_closest_marker("exercise"))
    return words[:1].upper() + words[1:] + case + fine


def commands(item, number):
    """What runs this exercise's checks again, and what runs this check alone."""
    impl, seed = item.config.option.impl, item.config.option.seed
    seeded = f" --seed {seed}" if seed else ""
    return (rerun(number, impl, seed), f'pytest --impl={impl}{seeded} "{item.nodeid}"')


def rerun(number: str, implementation: str = "labs", seed: int = 0) -> str:
    """The command that runs an exercise's checks."""
    other = "" if implementation == "labs" else f" --impl {implementation}"
    return f"{COMMAND} check {number}{other}{f' --seed {seed}' if seed else ''}"
