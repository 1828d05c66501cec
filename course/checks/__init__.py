"""What checks are made of: the exercise's mark, the code under test, assertions, the report.

A pytest plugin; tests/conftest.py loads it. A check is a test with a mark:

    @exercise("2.1")
    def test_an_edge_is_positive_on_its_left(impl):
        \"\"\"a and b are swapped.\"\"\"
        assert_close(impl.edge_function(p, a, b), 2.0)

Its name is the claim, its docstring the mistake that it catches. Its verdict is passed, failed,
not started (the exercise raises its own NotImplementedError still) or blocked by 2.1 (another one
does). A check that is skipped or expected to fail counts as failed. The report of a failed check
is short and shows the last call to the code under test; --tb=long gives pytest's own instead.
"""
import copy
import functools
import hashlib
import importlib
import inspect
import io
import json
import re
import sys
import textwrap
import traceback
import types
import zlib
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from ..given import places

exercise = pytest.mark.exercise

PACKAGE = "implementation"  # the code under test is imported as a package of this name
UNFINISHED = re.compile(r"exercise (\d+\.\d+): \w+")  # what an exercise of a skeleton raises
LAST_CALL = pytest.StashKey()  # of a check, to the code under test: function, args, kwargs
LAST_RETURN = pytest.StashKey()  # what that call returned; None if it did not
HINTS = Path(__file__).with_name("hints.json")
FIND = pytest.StashKey()       # of the run: finds functions that run in another process

# By NumPy's dtype.kind: what may come where this kind is expected.
CLOSE_KINDS = {"b": "b", "i": "iuf", "u": "iuf", "f": "iuf", "c": "iufc"}
EQUAL_KINDS = {"b": "b", "i": "iu", "u": "iu", "f": "iuf", "c": "iufc", "U": "U"}
KIND_NAMES = {"b": "booleans", "i": "integers", "u": "integers", "f": "floats",
              "c": "complex numbers", "U": "strings"}

COLUMNS, LABEL = 80, 10  # of a report; of these, its labels take up
MOST_NUMBERS = 24    # shown of an array; a larger one is shortened
MOST_LINES = 12      # shown of an error's text, of frames, of printed output
MAP_SHAPE = 20, 40   # rows and columns of the largest raster that is printed
FRACTIONS = 1, 2, 3, 4, 180 / np.pi, np.pi / 180  # a factor is told if it is whole times one
PANEL = 256          # pixels: a picture's panels are enlarged up to this
GAP = 12             # pixels between panels


class Check(NamedTuple):
    """What became of a check. The board is made of these."""

    exercise: str
    nodeid: str
    claim: str
    verdict: str  # passed, failed, not started, blocked by 2.1
    message: str
    picture: str | None
    seconds: float


class Mismatch(AssertionError):
    """What is wrong: rows (label, text) of the report; picture: its path, or None."""

    def __init__(self, *rows, picture=None):
        super().__init__(layout(rows))
        self.rows = rows
        self.picture = picture


# --- the code under test ----------------------------------------------------------------------


class Implementation:
    """The code under test: impl.edge_function(p, a, b) calls the function of that name.

    find(name) -> the function, or what stands for it where it runs in another process: all that
    is done with it is to call it, with arrays, numbers, strings and tuples of them.
    stash keeps the last call, for the report. A call fails that returns None or changes its inputs.
    """

    def __init__(self, find, stash):
        self._find = find
        self._stash = stash

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        function = self._find(name)

        @functools.wraps(function)
        def call(*args, **kwargs):
            inputs = copy.deepcopy((args, kwargs))
            self._stash[LAST_CALL] = function, *inputs
            self._stash[LAST_RETURN] = None
            returned = self._stash[LAST_RETURN] = function(*args, **kwargs)
            require_returned(name, returned)
            require_unchanged(function, inputs, (args, kwargs))
            return returned

        vars(self)[name] = call
        return call


def require_returned(name, returned):
    if returned is None:
        raise Mismatch(("wrong", f"{name} returned None: is a return missing?"))
    for number, output in enumerate(returned if isinstance(returned, tuple) else (), 1):
        if output is None:
            raise Mismatch(("wrong", f"{name} returned None as output {number} of {len(returned)}"))


def require_unchanged(function, before, after):
    """before, after: (args, kwargs) of a call to the function."""
    if unchanged(before, after):
        return
    pairs = zip(arguments(function, *before), arguments(function, *after), strict=True)
    changed = next(name for (name, old), (_, new) in pairs if not unchanged(old, new))
    raise Mismatch(("wrong", f"{function.__name__} changed its input {changed}: "
                             "let it work on a copy"))


def unchanged(old, new):
    if isinstance(old, tuple | list):
        return all(map(unchanged, old, new))
    if isinstance(old, dict):
        return all(map(unchanged, old.values(), new.values()))
    return not isinstance(old, np.ndarray) or old.tobytes() == new.tobytes()


def arguments(function, args, kwargs):
    """[(parameter, argument)] of a call; where it does not fit, without the parameters' names."""
    try:
        return list(inspect.signature(function).bind(*args, **kwargs).arguments.items())
    except (TypeError, ValueError):
        return [("", argument) for argument in args] + list(kwargs.items())


def folder(implementation):
    """labs, reference or a path -> the folder of the code under test. ValueError: there is none."""
    named = implementation in ("labs", "reference")
    path = places.ROOT / implementation if named else Path(implementation).resolve()
    if not path.is_dir():
        raise ValueError(f"there is no folder {implementation} to check; give labs, reference, or "
                         "the path of a folder with files like those in labs/")
    return path


def load_topic(path):
    """Import FOLDER/<topic>.py. Mismatch: it cannot be imported.

    No bytecode is written. Python takes it for up to date when a source was edited within the same
    second and kept its length, as with a + made a -.
    """
    if not path.exists():
        raise Mismatch(("wrong", f"there is no {places.shown_path(path)}; "
                                 "python3 -m course skeleton makes the labs"))
    writes, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        return importlib.import_module(f"{PACKAGE}.{path.stem}")
    except (Exception, SystemExit) as error:
        raise Mismatch(("wrong", f"{places.shown_path(path)} cannot be imported: "
                                 f"{told(error, path.parent)}")) from None
    finally:
        sys.dont_write_bytecode = writes


@pytest.fixture(scope="session")
def find_function(pytestconfig):
    """(topic, name) -> the function in the code under test. Mismatch: there is none."""
    if FIND in pytestconfig.stash:
        return pytestconfig.stash[FIND]
    package = types.ModuleType(PACKAGE)
    package.__path__ = [str(folder(pytestconfig.option.impl))]  # so `from . import x` works there
    for name in [name for name in sys.modules if name.split(".")[0] == PACKAGE]:
        del sys.modules[name]  # what an earlier run in this process has left
    sys.modules[PACKAGE] = package

    @functools.cache
    def module_or_mismatch(topic):
        try:
            return load_topic(Path(package.__path__[0], f"{topic}.py"))
        except Mismatch as mismatch:
            return mismatch

    def find(topic, name):
        module = module_or_mismatch(topic)
        if isinstance(module, Mismatch):
            raise Mismatch(*module.rows)
        if not callable(getattr(module, name, None)):
            path = places.shown_path(module.__file__)
            raise Mismatch(("wrong", f"{path} has no function {name}; "
                                     "keep the names that the skeleton gives"))
        return getattr(module, name)

    return find


@pytest.fixture
def impl(request, find_function):
    """The functions of the topic that the test's file is named after, see Implementation."""
    topic = request.path.stem.removeprefix("test_")
    return Implementation(functools.partial(find_function, topic), request.node.stash)


@pytest.fixture
def rng(request):
    """This check's own random numbers, made from --seed, its file's name and its own."""
    name = zlib.crc32(f"{request.path.name}::{request.node.name}".encode())
    return np.random.default_rng([request.config.option.seed, name])


# --- assertions -------------------------------------------------------------------------------


def assert_close(got, expected, given=None, rtol=1e-9, atol=1e-12):
    """|got - expected| <= atol + rtol |expected| in every number; infinities and NaNs must match.

    got: what a call returned: an array of expected's shape, or a tuple where expected is one.
    given: what the report shows as the input; by default, the last call to the code under test.
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


def given_row(given):
    return [] if given is None else [("given", given if isinstance(given, str) else shown(given))]


def compare(got, expected, rows, kinds, agrees, allowed, picture=False):
    """Raise a Mismatch unless got is of expected's kind and shape, and agrees in every number."""
    __tracebackhide__ = True
    if isinstance(expected, tuple):
        compare_outputs(got, expected, rows, kinds, agrees, allowed)
        return
    rows = [*rows, ("expected", shown(expected)), ("got", shown(got))]
    came, got, expected = kind_name(got), as_array(got), np.asarray(expected)
    if got.dtype.kind not in kinds[expected.dtype.kind]:
        raise Mismatch(*rows, ("differs", f"in kind: {came} came, "
                                          f"{kind_name(expected)} were expected"))
    if got.shape != expected.shape:
        raise Mismatch(*rows, ("differs", f"in shape: {shape_name(got)} came, "
                                          f"{shape_name(expected)} was expected"),
                       *hint(got, expected, agrees, picture))
    wrong = ~np.asarray(agrees(got, expected))
    if not wrong.any():
        return
    rows += [*whereabouts(got, expected, wrong, allowed), *hint(got, expected, agrees, picture)]
    if not picture:
        raise Mismatch(*rows)
    rows += text_map(got, expected)
    try:
        path = draw(got, expected, wrong)
    except OSError as error:  # nowhere to draw, as where students' work is graded
        raise Mismatch(*rows, ("picture", f"none: {error}")) from None
    raise Mismatch(*rows, ("picture", places.shown_path(path)), picture=str(path))


def compare_outputs(got, expected, rows, *how):
    """compare, for a tuple: one output after the other."""
    __tracebackhide__ = True
    if not isinstance(got, tuple | list) or len(got) != len(expected):
        raise Mismatch(*rows, ("expected", shown(expected)), ("got", shown(got)),
                       ("differs", f"a tuple of {len(expected)} was expected"))
    for number, pair in enumerate(zip(got, expected, strict=True), 1):
        compare(*pair, [*rows, ("output", f"{number} of {len(expected)}")], *how)


def as_array(value):
    """The value as an array; what makes none comes as an array of objects, as None does."""
    try:
        return np.asarray(value)
    except ValueError:  # rows of different lengths
        return np.array(None)


def whereabouts(got, expected, wrong, allowed):
    """A row: in 4 of 12, first at [3, 1]: 0.5 came, ...; by 2 at most, at [0, 2]; ...; or none."""
    parts = []
    if wrong.ndim:
        first = tuple(np.argwhere(wrong)[0])
        parts += [f"in {wrong.sum()} of {wrong.size}, first at {index_name(first)}: "
                  f"{shown(got[first])} came, {shown(expected[first])} was expected"]
    if "f" in (got.dtype.kind, expected.dtype.kind) or expected.dtype.kind == "c":
        distance = distances(got, expected, wrong)
        worst = np.unravel_index(distance.argmax(), distance.shape)
        at = f" at most, at {index_name(worst)}" if wrong.sum() > 1 else ""
        parts += [f"by {distance[worst]:.3g}{at}; allowed {allowed}"]
    return [("differs", "; ".join(parts))] if parts else []


def distances(got, expected, wrong):
    """|got - expected| where wrong, infinite where one of them is NaN; 1 for indices; else 0."""
    if got.dtype.kind in "biu" and expected.dtype.kind in "biu":
        return wrong.astype(float)
    numbers = complex if "c" in (got.dtype.kind, expected.dtype.kind) else float
    with np.errstate(invalid="ignore"):
        distance = np.abs(got.astype(numbers) - expected.astype(numbers))
    return np.where(wrong, np.nan_to_num(distance, nan=np.inf, posinf=np.inf), 0)


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
    if got.dtype.kind == "f" and got.itemsize < 8 and got.shape == expected.shape:
        yield (f"{got.dtype} is not precise enough; compute in float64",
               np.where(np.isclose(got, expected, 1e-3, 1e-3), expected, got))
    if got.dtype.kind == "b" and got.ndim:
        yield "true and false are swapped", ~got
    if got.ndim >= 2:
        yield "rows and columns are swapped", got.swapaxes(0, 1)
        yield "the last two axes are swapped", got.swapaxes(-1, -2)
    if picture and got.ndim >= 2:
        yield "it is upside down; row 0 is at the bottom", got[::-1]
        yield "left and right are swapped", got[:, ::-1]
        for axis, step, place in ((0, 1, "low"), (0, -1, "high"),
                                  (1, 1, "far left"), (1, -1, "far right")):
            yield f"it is one pixel too {place}", np.roll(got, step, axis)
    else:
        for axis in range(got.ndim):
            yield f"the order along axis {axis} is reversed", np.flip(got, axis)
    if numeric and got.shape == expected.shape and np.count_nonzero(expected) > 1:
        largest = np.unravel_index(np.abs(expected).argmax(), expected.shape)
        factor, more = got[largest] / expected[largest], got[largest] - expected[largest]
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


def list_for_array(last, returned):
    """A list passes where its numbers are compared; a check that does more with it breaks down."""
    outputs = returned if isinstance(returned, tuple) else (returned,)
    if any(isinstance(output, list) for output in outputs):
        return f"{last[0].__name__} returned a list; np.array makes it an array"
    return None


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


# --- how things are shown ---------------------------------------------------------------------


def shown(value, name=""):
    """A value as one would type it, after name=; a large array is shortened."""
    name = f"{name}=" if name else ""
    if isinstance(value, np.ndarray | list) and as_array(value).dtype != object:
        return shown_array(np.asarray(value), name)
    if isinstance(value, tuple):
        return f"{name}({', '.join(map(shown, value))}{',' * (len(value) == 1)})"
    return name + cut(repr(value.item() if isinstance(value, np.generic) else value))


def shown_array(array, name):
    """All of a small array; the first and last numbers of a large one, after its type and shape."""
    small = 0 < array.size <= MOST_NUMBERS
    before = name if small else f"{name}{array.dtype} {shape_name(array)}: "
    text = np.array2string(array if small else array.ravel(), separator=", ", prefix=before,
                           max_line_width=COLUMNS - LABEL - 3, threshold=MOST_NUMBERS, edgeitems=3,
                           precision=8 if small else 4)
    return before + re.sub(r"\n\s*\n", "\n", text)  # no empty lines between parts of 3 dimensions


def shown_call(function, args, kwargs):
    """edge_function(p=[0.5, 0.5], a=...), on several lines where one is not enough."""
    named = [shown(value, name) for name, value in arguments(function, args, kwargs)]
    line = f"{function.__name__}({', '.join(named)})"
    if len(line) <= COLUMNS - LABEL and "\n" not in line:
        return line
    lines = [text.replace("\n", "\n  ") + "," for text in named]
    return "\n  ".join([f"{function.__name__}(", *lines]) + "\n)"


def kind_name(value):
    name = f"a {type(value).__name__} that is no array of numbers"
    return KIND_NAMES.get(as_array(value).dtype.kind, name)


def shape_name(array):
    return f"({', '.join(map(str, array.shape))}{',' * (array.ndim == 1)})"


def index_name(index):
    return f"[{', '.join(map(str, index))}]"


def cut(text):
    lines = text.splitlines()
    return "\n".join(lines[:MOST_LINES] + ["..."] * (len(lines) > MOST_LINES))


def layout(rows):
    """Rows (label, text) in two columns, long lines broken; not in commands, which are copied."""
    lines = ((label if number == 0 else "", line) for label, text in rows
             for number, line in enumerate(text.splitlines() if label == "again" else broken(text)))
    return "\n".join(f"{label:{LABEL}}{line}".rstrip() for label, line in lines)


def broken(text):
    """The lines of a text, none too long: what is over goes on below, indented alike."""
    for line in text.splitlines() or [""]:
        indent = line[:len(line) - len(line.lstrip())]
        yield from textwrap.wrap(line, COLUMNS - LABEL, subsequent_indent=indent,
                                 break_long_words=False, break_on_hyphens=False) or [""]


# --- pictures of a mismatch -------------------------------------------------------------------


def text_map(got, expected):
    """A row with a small raster of booleans or indices in letters, its top row first; or none."""
    if got.ndim != 2 or got.dtype.kind not in "biu" or np.any(np.array(got.shape) > MAP_SHAPE):
        return []
    there, wanted = (raster if raster.dtype == bool else raster >= 0 for raster in (got, expected))
    letters = np.select([wanted & ~there, there & ~wanted, got != expected, there],
                        ["?", "!", "x", "#"], ".")
    meanings = {"#": "right", "?": "missing", "!": "extra", "x": "other",
                ".": "background"}
    legend = ", ".join(f"{letter} {meaning}" for letter, meaning in meanings.items()
                       if letter in letters)
    return [("map", "\n".join([*map("".join, letters[::-1]), f"({legend}; top row first)"]))]


def draw(got, expected, wrong):
    """Write expected | got | difference as a PNG to out/checks/; its path."""
    from PIL import Image, ImageDraw  # only where there is something to draw

    distance = distances(got, expected, wrong).reshape(*wrong.shape[:2], -1).max(-1)
    height, width = distance.shape
    scale = max(1, PANEL // max(height, width))
    row, column = np.unravel_index(distance.argmax(), distance.shape)
    x, y = scale * column, scale * (height - 1 - row)

    step, top = scale * width + GAP, GAP + 4
    sheet = Image.new("RGB", (3 * step + GAP, scale * height + top + GAP), "white")
    pen = ImageDraw.Draw(sheet)
    panels = {"expected": colours(expected, expected, got), "got": colours(got, expected, got),
              "difference": difference_colours(distance)}
    for left, (title, panel) in zip(range(GAP, 3 * step, step), panels.items(), strict=True):
        pixels = np.flipud(panel).repeat(scale, 0).repeat(scale, 1)
        sheet.paste(Image.fromarray(np.uint8(255 * pixels)), (left, top))
        pen.text((left, 1), title, "black")
        pen.rectangle((left + x - 2, top + y - 2, left + x + scale + 1, top + y + scale + 1),
                      outline="orange", width=2)
    content = io.BytesIO()
    sheet.save(content, "PNG")
    path = places.check_picture("mismatch")
    places.write_whole(path, content.getvalue())
    return path


def colours(raster, *both):
    """(H, W) or (H, W, C) -> (H, W, 3) in 0..1, on one scale for both rasters of a picture.

    Indices become hues, -1 dark. Of channels, three are shown. Infinite is blue, NaN is pink.
    """
    if raster.dtype.kind in "iu" and raster.ndim == 2:
        hues = 0.6 + 0.4 * np.cos(2 * np.pi * (0.618 * raster[..., None] + np.arange(3) / 3))
        return np.where(raster[..., None] < 0, 0.15, hues)
    raster, *both = (np.atleast_3d(np.abs(r) if r.dtype.kind == "c" else r).astype(float)
                     for r in (raster, *both))
    channels = raster.shape[2]
    finite = np.concatenate([[0, 1] if channels > 1 else [], *(r[np.isfinite(r)] for r in both)])
    low, high = (finite.min(), finite.max()) if finite.size else (0, 1)
    shown_channels = {1: [0, 0, 0], 2: [0, 1, 1]}.get(channels, [0, 1, 2])
    pixels = np.clip((raster[..., shown_channels] - low) / (high - low or 1), 0, 1)
    pixels[np.isinf(raster).any(2)] = 0.2, 0.3, 0.7
    pixels[np.isnan(raster).any(2)] = 1, 0.3, 0.7
    return pixels


def difference_colours(distance):
    """Black where right, else red: the brighter, the farther off."""
    farthest = distance[np.isfinite(distance)].max(initial=0) or 1
    level = np.where(distance > 0, 0.3 + 0.7 * np.minimum(distance / farthest, 1), 0)
    return level[..., None] * [1, 0.2, 0]


# --- verdict and report -----------------------------------------------------------------------


def pytest_addoption(parser):
    group = parser.getgroup("course")
    group.addoption("--impl", default="reference", metavar="labs|reference|FOLDER",
                    help="whose code to check; a folder holds files like those in labs/")
    group.addoption("--seed", default=0, type=int, metavar="N",
                    help="other random numbers in the checks")


def pytest_configure(config):
    config.addinivalue_line("markers", "exercise(number): this test is a check of that exercise")
    config.addinivalue_line("markers", "notebook: executes a notebook; left out by test --quick")
    try:
        folder(config.option.impl)
    except ValueError as error:
        raise pytest.UsageError(error) from None


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_makereport(item, call):
    """The report of a check holds its Check, as a dict; of a failed one, a text for students."""
    mark = item.get_closest_marker("exercise")
    if mark and item.config.option.tbstyle == "auto":
        item.repr_failure = str  # pytest's own text takes 0.2 s, and would be replaced
    report = yield
    if mark and (report.when == "call" or not report.passed):
        judge(item, call.excinfo and call.excinfo.value, report, mark.args[0])
    return report


def judge(item, error, report, number):
    """Set report.check; report.outcome, where the check did not run; and report.longrepr."""
    if report.skipped or hasattr(report, "wasxfail") or (report.failed and error is None):
        vars(report).pop("wasxfail", None)  # else pytest goes on to count it as expected
        verdict = report.outcome = "failed"
        rows = [("wrong", "a check has to run and pass; this one is skipped or expected to fail")]
    elif report.passed:
        verdict, rows = "passed", []
    else:
        verdict = verdict_of(error, number)
        rows = [("verdict", f"{verdict} ({error})")]
        if verdict == "failed":
            rows = explained(error, item)
    lines = report.capstdout.splitlines()[-MOST_LINES:]
    printed = [("printed", "\n".join(lines))] if lines and rows else []
    report.check = Check(number, item.nodeid, claim(item), verdict, layout([*rows, *printed]),
                         getattr(error, "picture", None), report.duration)._asdict()
    if report.failed and item.config.option.tbstyle == "auto":
        report.longrepr = layout([("claim", claim(item)), *rows,
                                  ("again", "\n".join(commands(item, number)))])


def verdict_of(error, number):
    unfinished = isinstance(error, NotImplementedError) and UNFINISHED.fullmatch(str(error))
    if not unfinished:
        return "failed"
    return "not started" if unfinished[1] == number else f"blocked by {unfinished[1]}"


def explained(error, item):
    """Rows: the mistake that the check catches, what it gave and what came of it, where, the seed.

    Assertion errors of other kinds, as the gradient check's, tell by themselves what was given.
    """
    rows = list(error.rows) if isinstance(error, Mismatch) else [
        ("wrong", told(error, folder(item.config.option.impl)))]
    other_kind = isinstance(error, AssertionError) and type(error) not in (AssertionError, Mismatch)
    last = item.stash.get(LAST_CALL, None)
    if last and "given" not in dict(rows) and (
            not other_kind or last[0].__name__.endswith("_backward")):
        rows.insert(0, ("given", shown_call(*last)))
    returned = item.stash.get(LAST_RETURN, None)
    if returned is not None and "got" not in dict(rows) and not other_kind:
        rows.append(("got", shown(returned)))
    compared = other_kind or "expected" in dict(rows)
    if item.function.__doc__ and compared:
        paragraph = inspect.getdoc(item.function).partition("\n\n")[0]
        rows.insert(0, ("catches", " ".join(paragraph.split())))
    known = known_mistake(item.nodeid, returned) or list_for_array(last, returned)
    if known:
        rows = [row for row in rows if row[0] != "hint"] + [("hint", known)]
    return [*rows, ("check", check_line(error, item)), ("seed", str(item.config.option.seed))]


def told(error, code):
    """An error, and the lines in the folder with the code under test that led to it."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__)
              if Path(frame.filename).resolve().is_relative_to(code)]
    lines = shown_frames([(places.shown_path(frame.filename), frame.lineno, frame.name, frame.line)
                          for frame in frames])
    if isinstance(error, SyntaxError):
        where = f"{places.shown_path(error.filename)}:{error.lineno}"
        lines += [f"{where}\n    {(error.text or '').strip()}"]
        return "\n".join([f"{type(error).__name__}: {error.msg}", *lines])
    plain = not lines and isinstance(error, AssertionError | pytest.fail.Exception)
    text = str(error) if plain else f"{type(error).__name__}: {error}".removesuffix(": ")
    return "\n".join([cut(text), *lines])


def shown_frames(frames):
    """(file, line, function, its text) of each call -> lines; of many, the first and last ones."""
    lines = [f"{file}:{line} in {function}\n    {text}" for file, line, function, text in frames]
    if len(lines) > MOST_LINES:
        lines[4:-4] = [f"... {len(lines) - 8} more calls ..."]
    return lines


def check_line(error, item):
    """tests/labs/test_rasterization.py:31, and the code there."""
    lines = [frame for frame in traceback.extract_tb(error.__traceback__)
             if Path(frame.filename) == item.path]
    if not lines:
        return f"{places.shown_path(item.path)}:{item.location[1] + 1}"
    return f"{places.shown_path(item.path)}:{lines[-1].lineno}\n{lines[-1].line}"


def claim(item):
    """test_a_shared_edge_is_covered_once -> 'A shared edge is covered once', and its parameters."""
    words = item.originalname.removeprefix("test_").replace("_", " ")
    case = f" [{item.callspec.id}]" if hasattr(item, "callspec") else ""
    return words[:1].upper() + words[1:] + case


def commands(item, number):
    """What runs this exercise's checks again, and what runs this check alone."""
    impl, seed = item.config.option.impl, item.config.option.seed
    seeded = f" --seed {seed}" if seed else ""
    return (rerun(number, impl, seed), f'pytest --impl={impl}{seeded} "{item.nodeid}"')


def rerun(number, implementation="labs", seed=0):
    """The command that runs an exercise's checks."""
    other = "" if implementation == "labs" else f" --impl {implementation}"
    return f"python3 -m course check {number}{other}{f' --seed {seed}' if seed else ''}"
