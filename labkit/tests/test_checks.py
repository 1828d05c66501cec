"""What a failed check tells a student, and what counts as passed."""
import inspect
import math
import re
import sys
import warnings
from typing import NamedTuple

import numpy as np
import pytest
from made_up import SPOILT, check_text, exercise_text
from PIL import Image

from labkit import contract, places
from labkit.checks import Mismatch, assert_close, assert_equal, assert_picture, loader, report
from labkit.checks.assertions import assert_refused
from labkit.checks.loader import Implementation
from labkit.checks.pictures import GAP
from labkit.checks.showing import error_text, layout, shown, shown_call, typed


class Paint(NamedTuple):
    colours: np.ndarray
    name: str


# --- assertions -------------------------------------------------------------------------------


def text_of(assertion, *args, **options):
    with pytest.raises(Mismatch) as error:
        assertion(*args, **options)
    return str(error.value)


@pytest.fixture
def pictures(tmp_path, monkeypatch):
    """The folder in which pictures of mismatches land."""
    monkeypatch.setattr(places, "ROOT", tmp_path)
    return tmp_path / "out" / "checks"


@pytest.mark.parametrize(("got", "expected"), [
    (1, 1.0), (1.0, 1), (np.float64(1), 1.0), (1 + 1e-10, 1.0), (1e-13, 0.0),
    ([1, 2], np.array([1.0, 2.0])), (np.array([1, 2], np.float32), np.array([1.0, 2.0])),
    (math.inf, math.inf), (np.array([math.nan, 1]), np.array([math.nan, 1])),
    ((1.0, [2, 3]), (1, np.array([2.0, 3.0]))), ([1.0, 2.0], (1.0, 2.0)),
    (np.zeros((0, 3)), np.zeros((0, 3))), (1 + 2j, 1 + 2j), (1, 1 + 0j), (True, True),
    ((1, (2, 3)), (1, (2, 3))), ([], np.zeros((0, 3))),
], ids=repr)
def test_close_accepts(got, expected):
    """A right answer is refused because it came as a list, an integer or a float32."""
    assert_close(got, expected)


@pytest.mark.parametrize(("got", "expected", "row"), [
    (1 + 1e-8, 1.0, "by 1e-08; allowed 1e-12 + 1e-09 |expected|"),
    (math.nan, 1.0, "nan is no number: it comes from 0 / 0"),
    (-math.inf, math.inf, "by inf; allowed"), (1.0, math.nan, "by inf; allowed"),
    (np.ones(3), np.ones((1, 3)), "in shape: (3,) came, (1, 3) was expected"),
    (np.ones(1), 1.0, "in shape: (1,) came, () was expected"),
    (np.zeros((0, 2)), np.zeros((0, 3)), "in shape: (0, 2) came, (0, 3) was expected"),
    ([], np.ones((1, 3)), "in shape: (0,) came, (1, 3) was expected"),
    (np.ones(3) + 1j, np.ones((1, 3)), "in shape: (3,) came, (1, 3) was expected"),
    (1 + 0j, 1.0, "in kind: complex numbers came, floats were expected; the numbers are right"),
    (True, 1.0, "in kind: booleans came, floats were expected"),
    ("1.0", 1.0, "in kind: strings came, floats were expected"),
    (None, 1.0, "in kind: a NoneType that is no array of numbers came, floats were expected"),
    ([[1, 2], [3]], np.ones((2, 2)),
     "in kind: a list that is no array of numbers came, floats were expected"),
    ({1: 2}, 1.0, "in kind: a dict that is no array of numbers came, floats were expected"),
    *((got, (1.0, 2.0), "a tuple of 2 was expected") for got in (1.0, (1.0,))),
    (np.array([0.0, 1, 5, 2]), np.arange(4.0),
     "in 2 of 4, first at [2]: 5.0 came, 2.0 was expected; by 3 at most, at [2]; allowed"),
], ids=repr)
def test_close_refuses_and_says_in_what_it_differs(got, expected, row):
    """A wrong kind, shape or number passes, or the sentence is about something else."""
    assert f"differs {row}" in " ".join(text_of(assert_close, got, expected).split())


def test_the_output_of_several_that_differs_is_named():
    """Of three gradients, the student does not know which one is wrong."""
    text = text_of(assert_close, (1.0, np.ones(2), 3.0), (1.0, np.zeros(2), 4.0))
    assert "output    2 of 3\nexpected  [0., 0.]\ngot       [1., 1.]" in text
    assert report.named(np.linalg.qr, "2 of 2", np.linalg.qr(np.eye(2))) == ": R"


def test_tolerances_are_those_that_were_given():
    """rtol and atol are swapped, or not used."""
    assert_close(101.0, 100.0, rtol=0.02, atol=0)
    assert_close(0.01, 0.0, rtol=0, atol=0.02)
    text_of(assert_close, 101.0, 100.0, rtol=0, atol=0.02)
    text_of(assert_close, 0.01, 0.0, rtol=0.02, atol=0)


@pytest.mark.parametrize(("got", "expected"), [
    (1, 1), (np.int32(1), 1), (True, True), ("nearest", "nearest"), ((1, "a"), (1, "a")),
    (np.array([1, -1]), [1, -1]), (0.1, 0.1), (np.array([math.nan, 1.0]), [math.nan, 1.0]),
    ([], np.zeros((0, 3), int)),
], ids=repr)
def test_equal_accepts(got, expected):
    """A right answer is refused."""
    assert_equal(got, expected)


@pytest.mark.parametrize(("got", "expected"), [
    (2, 1), (1.0, 1), (True, 1), (1, True), (False, True), ("linear", "nearest"), (0.1 + 0.2, 0.3),
    ((1, 2), (1, 3)), (np.array([1, 2]), [1, 3]), (np.array([1, 2]), [1]), (None, 1),
], ids=repr)
def test_equal_refuses(got, expected):
    """Equal means close, or kinds are mixed: a mask of 0 and 1, face indices that are floats."""
    assert text_of(assert_equal, got, expected)


@pytest.mark.parametrize("graded", [False, True])
def test_refused_is_what_raises_a_value_error(graded):
    """Any crash counts as a refusal, or none does where it is graded: its text alone comes there.
    """
    def raising(kind):
        raise Mismatch(("wrong", f"{kind.__name__}: so")) if graded else kind("so")

    assert_refused(raising, ValueError)
    with pytest.raises(Mismatch if graded else TypeError, match="so"):
        assert_refused(raising, TypeError)
    assert "a ValueError" in text_of(assert_refused, abs, -3)


def test_a_small_raster_is_printed_with_its_top_row_first(pictures):
    """The map is upside down, or missing and extra are swapped."""
    got = np.array([[-1, 0, 1, -1], [-1, -1, 3, 3]])
    expected = np.array([[-1, 0, 2, -1], [0, -1, -1, 3]])
    assert ("map       ?.!#\n"
            "          .#x.\n"
            "          (# right, ? missing, ! extra, x other, . background; "
            "top row first)") in text_of(assert_picture, got, expected)
    mask = np.array([[False, True]])
    assert "map       ?!\n" in text_of(assert_picture, mask, ~mask)


def test_a_picture_shows_expected_got_and_difference_upright(pictures, monkeypatch):
    """The panels are swapped, upside down, or the box is around another pixel."""
    monkeypatch.setenv("PYTEST_CURRENT_TEST", "tests/labs/test_x.py::test_it[a/b] (call)")
    expected = np.zeros((4, 8))
    expected[0, 0] = 1
    got = expected.copy()
    got[3, 7], got[3, 0] = 1, 0.5
    text = text_of(assert_picture, got, expected)
    assert "picture   out/checks/x_it_a_b.png" in text
    with Image.open(pictures / "x_it_a_b.png") as picture:
        pixels = np.asarray(picture)
    side, step, top = 32, 8 * 32 + GAP, GAP + 4

    def shade(panel, row, column):
        return pixels[top + row * side + side // 2,
                      GAP + panel * step + column * side + side // 2].tolist()

    black, white, red = [0, 0, 0], [255, 255, 255], [255, 51, 0]
    assert [shade(0, 3, 0), shade(0, 0, 7)] == [white, black]
    assert [shade(1, 3, 0), shade(1, 0, 7)] == [white, white]
    assert [shade(2, 3, 0), shade(2, 0, 7)] == [black, red]
    assert shade(2, 0, 0)[0] < 255
    boxed = np.argwhere((pixels == (255, 165, 0)).all(-1)) - (top, GAP)
    assert boxed.min(0).tolist() == [-2, 7 * side - 2]
    assert boxed.max(0).tolist() == [side + 1, 2 * step + 8 * side + 1]


@pytest.mark.parametrize("shape", [(3, 4), (3, 4, 1), (3, 4, 2), (3, 4, 3), (3, 4, 5), (1, 600)])
@pytest.mark.parametrize("kind", [bool, int, float])
def test_any_raster_can_be_drawn(pictures, shape, kind):
    """A raster of one channel, of booleans, of NaN and infinity crashes the report."""
    expected = np.zeros(shape, kind)
    got = expected.copy()
    got[0, 1], got[0, 2] = (math.nan, math.inf) if kind is float else (1, 1)
    assert "picture " in text_of(assert_picture, got, expected)


def test_a_raster_of_another_shape_or_kind_is_not_drawn(pictures):
    """The report itself crashes."""
    assert "in length: (2, 3)" in text_of(assert_picture, np.zeros((2, 3)), np.zeros((3, 3)))
    assert "in kind" in text_of(assert_picture, np.zeros((3, 3)), np.zeros((3, 3), int))
    assert not pictures.exists()


def test_without_a_place_for_the_picture_the_text_remains(pictures):
    """Where out/ cannot be written, the student is told about folders and not about pixels."""
    pictures.parent.write_text("a file, not a folder")
    text = text_of(assert_picture, np.zeros((5, 6), int), np.full((5, 6), -1))
    assert "first at [0, 0]: 0 came, -1 was expected" in text
    assert "picture   none: " in text


def test_a_picture_is_compared_within_atol_and_infinity_with_infinity():
    """Background depth is infinite, and infinity minus infinity is not zero."""
    expected = np.array([[math.inf, 0.5], [math.nan, 0.25]])
    assert_picture(expected + 1e-4, expected, atol=1e-3)


@pytest.mark.parametrize(("value", "text"), [
    (np.eye(2), "[[1., 0.],\n [0., 1.]]"), (np.float64(0.1), "0.1"), ((1, "a"), "(1, 'a')"),
    ((1,), "(1,)"), ([1, 2], "[1, 2]"), (np.zeros((0, 3)), "float64 (0, 3): []"),
    (np.arange(100).reshape(4, 25), "int64 (4, 25): [ 0,  1,  2, ..., 97, 98, 99]"),
    ((Paint([0.5], "red"), 1), "(Paint(colours=[0.5], name='red'), 1)"),
], ids=repr)
def test_values_are_shown_as_one_would_type_them(value, text):
    """np.float64(0.1), or a thousand numbers."""
    assert shown(value).replace("int32", "int64") == text


def test_a_report_has_80_columns_and_a_command_stays_whole():
    """The terminal breaks lines in the middle of a number, or a command cannot be copied."""
    def look(weights, longer_name, picture):
        return weights

    rng = np.random.default_rng(0)
    arrays = -rng.random((5, 4)), rng.random((9, 3, 2)) * 1e6, rng.random(20) + 1j
    prose = "one more word " * 20
    text = layout([("catches", prose), ("given", shown_call(look, arrays, {})),
                          ("wrong", f"It\n    x = {prose}"), ("again", prose.strip())])
    *lines, command = text.splitlines()
    assert max(map(len, lines)) <= 80 and command == f"again     {prose.strip()}"
    assert "\n              x = one more" in text and "\n              more word" in text


# --- the code under test ----------------------------------------------------------------------


def implementation(function):
    return Implementation(lambda name: function, {})


@pytest.mark.parametrize(("returned", "sentence"), [
    (None, "f returned None: is a return missing?"), ((1, None), "returned None as output 2 of 2")])
def test_a_missing_return_is_told(returned, sentence):
    """None runs on into the check and gives a TypeError there."""
    with pytest.raises(Mismatch, match=sentence.replace("?", r"\?")):
        implementation(lambda: returned).f()


def test_a_changed_input_is_told_by_its_name():
    """The student's function changes the check's arrays, and a later assertion is to blame."""
    def spoil(a, b, arrays):
        b[0], arrays[1][...] = math.nan, 2
        return 1

    zeros, has_nan, twos = np.zeros(2), np.array([math.nan, 1]), np.full(1, 2.0)
    with pytest.raises(Mismatch, match="spoil changed its input arrays: let it work on a copy"):
        implementation(spoil).f(zeros, has_nan, (np.zeros(1), np.zeros(1)))
    with pytest.raises(Mismatch, match="spoil changed its input b"):
        implementation(spoil).f(zeros, arrays=(np.zeros(1), twos), b=np.zeros(2))
    assert implementation(lambda a, b: 1).f(zeros, has_nan) == 1, "NaN is not NaN"


@pytest.mark.parametrize(("returned", "expected"), [
    ([[1, 2], [3, 4]], np.array([[1, 2], [3, 4]])), (range(3), np.arange(3)), (2, np.int64(2)),
    (np.array(0.5), np.float64(0.5)), (np.float32([0.5, 2]), np.array([0.5, 2])),
    (np.uint8([3]), np.array([3])), ([True, False], np.array([True, False])),
    (1j, np.complex128(1j)), (np.broadcast_to(1.5, (2, 3)).T, np.full((3, 2), 1.5)),
    (["a", "b"], np.array(["a", "b"])),
    ([[1.0, 2.0], [3.0]], (np.array([1.0, 2.0]), np.array([3.0]))),
    ((1, ([2.0], "a")), (np.int64(1), (np.array([2.0]), "a"))),
    ((1, Paint([2.0], "a")), (np.int64(1), Paint(np.array([2.0]), "a"))),
], ids=repr)
def test_numbers_come_in_their_standard_form(returned, expected):
    """A check that adds, slices or asks for a shape refuses right numbers for their form."""
    def require_same(got, expected):
        assert type(got) is type(expected)
        if isinstance(expected, tuple):
            for pair in zip(got, expected, strict=True):
                require_same(*pair)
        elif not isinstance(expected, str):
            assert got.dtype == expected.dtype and np.array_equal(got, expected)
            assert got.flags.c_contiguous

    require_same(implementation(lambda: returned).f(), expected)


@pytest.mark.parametrize("returned", [{1: 2}, "text", object], ids=repr)
def test_what_is_no_array_of_numbers_stays_as_it_is(returned):
    """The student is shown something that was never returned."""
    assert implementation(lambda: returned).f() is returned


@pytest.mark.filterwarnings("error")
def test_no_warning_counts():
    """A division by zero fails where a check, pyproject.toml or the command line is strict."""
    def f(x):
        warnings.warn("old", DeprecationWarning, stacklevel=1)
        return 1 / x

    with np.errstate(all="raise"):
        assert implementation(f).f(np.zeros(1)) == np.inf


def test_classes_of_given_code_come_as_they_are():
    """A check makes a NamedTuple, and the report takes that for the last call. Or it calls another
    lab's function, and nothing looks at what that changes.
    """
    assert implementation(Paint).Paint is Paint
    assert vars(implementation(sys.modules[__name__]).test_checks)["Paint"] is Paint
    assert not hasattr(implementation(sys.modules[__name__]).test_checks, "implementation")


@pytest.mark.parametrize("got", [([0.5], "red"), Paint([0.5], "red"), [[0.5], "red"]], ids=repr)
@pytest.mark.parametrize("expected", [([0.5], "red"), Paint([0.5], "red")], ids=repr)
def test_a_named_tuple_is_compared_by_place(got, expected):
    """A plain tuple with the right numbers is refused, or a name hides a wrong number."""
    assert_equal(contract.standard(got), expected)
    with pytest.raises(Mismatch):
        assert_equal(contract.standard(got), Paint([0.25], "red"))


def test_a_call_keeps_the_functions_signature():
    """The gradient check cannot name the inputs."""
    assert str(inspect.signature(implementation(lambda p, a, b: 1).f)) == "(p, a, b)"


# --- verdict and report -----------------------------------------------------------------------

LAB = '"""Made up."""\nfrom . import sampling\n' + "".join((
    *(exercise_text(number, name, "What is it?", *answer, inputs=inputs)
      for number, name, inputs, *answer in (
          ("1.1", "double", "x", "return 2 * x"),
          ("1.2", "half", "x", "return quotient(x, 0)"),
          ("1.3", "shifted", "x, by", 'print("shifting by", by)', "return x - by"),
          ("1.4", "mask", "n", 'raise NotImplementedError("exercise 1.4: mask")'),
          ("1.5", "area", "n", "return mask(n).sum()"),
          ("1.6", "deep", "x", "return deep(x + 1)"),
          ("1.7", "other", "x", 'raise NotImplementedError("not yet")'),
          ("1.8", "strict", "x", 'assert x > 0, "too small"', "return x"))),
    "\n\ndef quotient(x, y):\n    return x / y\n\n\n"
    "def both(x):\n    '-> once, twice.'\n    return x, x / 0\n"))

STATES = SPOILT + """

@exercise("1.3")
def test_shifted_of_other_things(impl):
    assert_close(impl.shifted(1.0, 0.0), 2.0, given={"told": "so"})


def test_of_no_exercise():
    assert 1 == 2


class Told(AssertionError):
    pass
"""
DRAWS = 'print("drew", request.node.name, rng.random())'
PLAIN = {  # name: exercise, lines
    "double_is_twice": ("1.1", "assert_close(impl.double(3.0), 6.0)"),
    "shifted_by_nothing": ("1.3", 'assert impl.shifted(1.0, 0.0) == 2.0, "it moved"'),
    "shifted_refuses": ("1.3", "with pytest.raises(ValueError):", "    impl.shifted(1.0, 2.0)"),
    "shifted__s_inputs_can_be_loaded": (
        "1.3", "assert_close(impl.shifted(np.arange(99.0).reshape(33, 3), by=1.0), 0.0)"),
    "shifted_gives_two": ("1.3", "one, two = impl.shifted(1.0, 0.0)"),
    "shifted_can_be_multiplied": (
        "1.3", "assert_close(np.eye(3) @ impl.shifted(np.zeros((2, 2)), by=1.0), 0.0)"),
    "no_number": ("1.3", "assert_close(impl.shifted(np.inf, np.inf), 1.0)"),
    "mask_is_square": ("1.4", "assert impl.mask(3).shape == (3, 3)"),
    "area_counts": ("1.5", "assert impl.area(3) == 6"),
    "deep_ends": ("1.6", "impl.deep(0)"),
    "other": ("1.7", "impl.other(0)"),
    "strict_is_not_strict": ("1.8", "impl.strict(0)"),
    "strict_tells_all": ("1.8", "impl.strict(1)", 'raise Told("it was given 1")'),
    "the_second_of_two": ("1.8", "_, two = impl.both(np.float64(1))", "assert_close(two, 3.0)"),
    "an_earlier_call": ("1.3", "got = impl.shifted(1.0, by=2.0)", "impl.shifted(1.0, by=9.0)",
                        "assert_close(got, 3.0)"),
    "skips_itself": ("1.1", 'pytest.skip("not today")')}
CHECKS = """\
import numpy as np
import pytest

from labkit.checks import assert_close, exercise
""" + "".join((
    check_text("1.2", "half_of_one", "Division by zero.\n\n    More about it.\n    ",
               "assert_close(impl.half(1.0), 0.5)"),
    check_text("1.3", "shifted_adds", "The sign.", "assert_close(",
               "    impl.shifted(np.zeros((2, 2)), by=by), np.full((2, 2), by))", inputs="impl, by",
               marks=['@pytest.mark.parametrize("by", [1.0, 2.0], ids=["one", "two"])']),
    STATES,
    *(check_text(number, name, "It does not.", *body) for name, (number, *body) in PLAIN.items()),
    *(check_text("1.1", name, "Left out.", f"assert impl.double(3.0) == {result}", marks=[mark])
      for name, result, mark in (
          ("skipped", 6.0, "@pytest.mark.skip"),
          ("expected_to_fail", 7.0, "@pytest.mark.xfail"),
          ("expected_to_fail_and_passing", 6.0, "@pytest.mark.xfail(strict=False)"))),
    check_text("1.1", "passes_and_breaks_after", "Its fixture.", inputs="impl, spoilt"),
    *(check_text("1.1", name, "They are always the same.", DRAWS, inputs="impl, rng, request")
      for name in ("numbers_are_this_checks_own", "numbers_are_not_those_of_another"))))


@pytest.fixture(scope="module")
def course(house):
    return house({"labs/transforms.py": LAB, "labs/sampling.py": "", "reference/__init__.py": "",
                  "tests/labs/test_transforms.py": CHECKS})


@pytest.fixture(scope="module")
def output(course, run_here):
    """What pytest prints about the made-up lab, in parts: {test: its text}."""
    done = run_here(course, "pytest", "--impl=labs", "tests/labs/test_transforms.py")
    assert done.returncode == 1, done.stdout + done.stderr
    parts = re.split(r"\n_* ?(?:ERROR at \w+ of )?(test_[^ ]*) _*\n", done.stdout)
    return dict(zip(parts[1::2], parts[2::2], strict=True)) | {"all": done.stdout}


@pytest.mark.parametrize(("test", "beginning"), [
    ("shifted_adds[one]", """\
claim     Shifted adds [one]
perhaps   The sign.
given     shifted(
            x=np.array([[0., 0.],
                        [0., 0.]]),
            by=1.0,
          )
expected  [[1., 1.],
           [1., 1.]]
got       [[-1., -1.],
           [-1., -1.]]
differs   in 4 of 4, first at [0, 0]: -1.0 came, 1.0 was expected; by 2 at most,
          at [0, 0]; allowed 1e-12 + 1e-09 |expected|
check     tests/labs/test_transforms.py:20
          assert_close(
again     python3 -m course check 1.3
          pytest --impl=labs "tests/labs/test_transforms.py::test_shifted_adds[one]"
"""),
    ("half_of_one", """\
claim     Half of one
given     half(x=1.0)
wrong     ZeroDivisionError: float division by zero
          labs/transforms.py:12 in half
              return quotient(x, 0)
          labs/transforms.py:48 in quotient
              return x / y
check     tests/labs/test_transforms.py:13
          assert_close(impl.half(1.0), 0.5)
"""),
    ("shifted_of_other_things", """\
claim     Shifted of other things
given     {'told': 'so'}
expected  2.0
got       1.0
differs   by 1; allowed"""),
    ("mask_is_square", """\
claim     Mask is square
verdict   not started (exercise 1.4: mask)
again     python3 -m course check 1.4
"""),
], ids=["numbers", "an error", "given=", "not started"])
def test_a_failed_check_shows_claim_mistake_call_numbers_seed_and_command(output, test, beginning):
    """A student has to read the check to learn what was asked, or a traceback of ours: frames of
    pytest or of the course. An exercise that is not started counts as a wrong answer.
    """
    assert output[f"test_{test}"].startswith(beginning)


NOT_COUNTED = "a check has to run and pass; this one is skipped or expected to fail"


@pytest.mark.parametrize(("test", "told"), [
    ("shifted_adds[one]", "shifting by 1.0"),  # the student's print
    ("the_second_of_two", "output    2 of 2: twice\n"),
    ("the_second_of_two", "warning   NumPy met divide by zero, first at labs/transforms.py:53\n"),
    ("no_number", "claim     No number\ngiven     shifted("),
    ("an_earlier_call", "given     shifted(x=1.0, by=2.0)\nexpected"),
    ("shifted_gives_two", "wrong     shifted returned one array or number; a tuple of several"),
    ("shifted_can_be_multiplied",
     "wrong     what shifted returned does not fit: are its axes"),
    ("strict_is_not_strict",
     "wrong     AssertionError: too small\n          labs/transforms.py:43 in strict\n"),
    ("strict_tells_all", "perhaps   It does not.\nwrong     it was given 1\n"),
    ("shifted_by_nothing", "given     shifted(x=1.0, by=0.0)\nwrong     it moved\n"),
    ("shifted_by_nothing", "check     tests/labs/test_transforms.py:52"),
    ("shifted_refuses", "wrong     DID NOT RAISE"),
    ("area_counts", "verdict   blocked by 1.4 (exercise 1.4: mask)\n"),
    ("other", "wrong     NotImplementedError: not yet\n"),
    ("skipped", NOT_COUNTED), ("skips_itself", NOT_COUNTED), ("expected_to_fail", NOT_COUNTED),
    ("expected_to_fail_and_passing", NOT_COUNTED),
    ("passes_and_breaks_after", "wrong     OSError: spoilt"),
    ("of_no_exercise", ">       assert 1 == 2")])
def test_a_report_says_what_went_wrong(output, test, told):
    """An error of the check's own code, "too many values to unpack", is all that a student sees; an
    assertion of the student's own is taken for one of the check's; another exercise's missing
    answer counts as this one's; an exercise is passed by leaving its checks out; a division by zero
    is not told; or mistakes are listed that make no NaN.
    """
    assert told in output[f"test_{test}"]


def test_tests_without_a_mark_are_left_to_pytest(output):
    """Tests of the course itself lose their tracebacks."""
    assert "again  " not in output["test_of_no_exercise"]


def test_inputs_that_are_shortened_can_be_loaded(output, course):
    """The call that fails cannot be tried, because its numbers are not all there."""
    text = output["test_shifted__s_inputs_can_be_loaded"]
    path = re.search(r'inputs    np.load\("(.*)"\)\s+has x\n', text)[1]
    assert np.array_equal(np.load(course / path)["x"], np.arange(99.0).reshape(33, 3))
    assert text.startswith("claim     Shifted's inputs can be loaded\n")


def test_endless_recursion_is_cut(output):
    """A thousand lines that say the same."""
    text = output["test_deep_ends"]
    assert "wrong     RecursionError: maximum recursion depth exceeded" in text
    assert re.search(r"\.\.\. \d+ more calls \.\.\.", text)
    assert text.count("labs/transforms.py:33 in deep") == 8


@pytest.mark.parametrize("value", [
    np.array([0.5, 2.0]), np.zeros((0, 3), int), (np.array([[1, -1]]), None, 2.0), "clamp",
    np.array([[True], [False]]), (Paint(np.ones(1), "red"),)], ids=str)
def test_an_input_can_be_pasted(value):
    """[0.5 2.0] is no Python, and [0.5, 2.0] no array."""
    pasted = eval(typed(value), {"np": np, "Paint": Paint})
    assert repr(pasted) == repr(value)


@pytest.mark.parametrize("line", [
    "x = '" + "1 + " * 50_000, "; ".join(["import numpy as np", *(
        f"array_{k} = np.ones({k})" for k in range(5000)), "1 / 0"])], ids=["syntax", "error"])
def test_of_a_line_as_long_as_a_file_the_beginning_is_quoted(tmp_path, line):
    """One line of 200 kB, in each of its failing checks, makes a report of megabytes."""
    path = tmp_path / "transforms.py"
    path.write_text(line, "utf-8")
    with pytest.raises((SyntaxError, ZeroDivisionError)) as error:
        exec(compile(line, path, "exec"), {})
    said = error_text(error.value, tmp_path)
    assert line[:200] in said and len(said) < 1500


@pytest.mark.parametrize(("line", "fits"), [
    ("np.ones((5, 3)) + np.ones(5)", "Or is (5, 3) to be transposed, or summed over its last axis"),
    ("np.ones((4, 3)) * np.ones((4, 3, 2))", "(4, 3) fits as (4, 3, 1): keepdims=True"),
    ("np.ones((4, 2)) + np.ones((7, 4, 3, 2))", "(4, 2) fits as (4, 1, 2): "),
    ("np.ones(5) * np.ones((5, 4, 3))", "(5,) fits as (5, 1, 1): "),
    ("np.ones((4, 2)) + np.ones(3)", "must be equal or 1. Here 3 and 2 meet"),
    ("np.ones((4, 2)) + np.ones((2, 4))", "(4, 2) and (2, 4) are equal when one is transposed"),
    ("np.ones((4, 2)) @ np.ones(4)", "They differ: 4 and 2 numbers"),
    ("np.dot(np.ones((4, 2)), np.ones((4, 2)))", "They differ: 2 and 4 numbers"),
    ("np.concatenate([np.ones((2, 3)), np.ones(2)], -1)", "equally many axes: keepdims=True"),
    ("np.concatenate([np.ones((2, 3)), np.ones((1, 1))], -1)", "a mean the wrong axis, or none?"),
    ("rows = np.ones((6, 2)); i = np.arange(3); rows[i] * np.ones(3)", "rows[i] (3, 2)"),
    ("np.ones((5, 4, 3))[[0, 1]] = np.ones((2, 3))", "is x to be reshaped before, so that index"),
    ("1 if np.ones(2) > 0 else 0", "For arrays write &, |, ~, each comparison in brackets"),
    ("np.ones(2) > 0 | np.ones(2) > 0", "& and | come before < and =="),
    ("compile('\\0', 'a', 'exec')", None)])
def test_an_axis_that_makes_two_arrays_fit_is_told(line, fits, tmp_path):
    """A missing keepdims is the commonest mistake of all, and the report has only its shapes; it
    tells of an axis that does not help; or an error without a place ends the report.
    """
    (tmp_path / "transforms.py").write_text(line)
    with pytest.raises((ValueError, TypeError, SyntaxError)) as error:
        exec(compile(line, tmp_path / "transforms.py", "exec"), {"np": np})
    said = error_text(error.value, tmp_path)
    assert "transforms.py:1 in" in said and (fits or "\n") in said
    assert ("    " in said.partition("\n    ")[2]) == bool(fits)


def test_random_numbers_depend_on_check_and_seed_and_on_nothing_else(course, run_here):
    """All checks draw the same numbers, or other ones in every run or order."""
    def drawn(*options):
        done = run_here(course, "pytest", "--impl=labs", "-s", *options)
        return sorted(re.findall(r"drew (\w+) ([\d.]+)", done.stdout))

    first, second = drawn("-k", "numbers_are")
    assert first[1] != second[1]
    assert drawn("-k", "not_those") == [first]
    assert drawn("-k", "not_those", "--seed", "1") != [first]


def test_random_integers_can_be_indices_where_these_have_32_bits(rng, monkeypatch):
    """As in a browser: NumPy refuses int64 there. Or the numbers are not those of 64 bits."""
    plain = np.random.default_rng()
    plain.bit_generator.state = rng.bit_generator.state
    expected = plain.integers(-5, 99, 40), plain.integers(9)
    monkeypatch.setattr(np, "intp", np.int32)
    drawn = rng.integers(-5, 99, 40), rng.integers(9)
    assert [numbers.dtype for numbers in drawn] == [np.int32, np.int32]
    assert_equal(drawn, expected)


def test_authors_of_checks_can_have_the_traceback(course, run_here):
    """The report cannot be switched off, and a defect of the check cannot be found."""
    done = run_here(course, "pytest", "--impl=labs", "-k", "half", "--tb", "long")
    assert "def test_half_of_one(impl):" in done.stdout
    assert "claim " not in done.stdout


UNUSABLE = {
    "transforms": ("x = 1\ndef double(x:\n",
                   "wrong     labs/transforms.py cannot be imported: SyntaxError: ",
                   "          labs/transforms.py:2\n              def double(x:\n"),
    "rasterization": ("import sys\nsys.exit(1)\n",
                      "wrong     labs/rasterization.py cannot be imported: SystemExit: 1\n"
                      "          labs/rasterization.py:2 in <module>\n"),
    "sampling": ("from . import nothing\n",
                 "wrong     labs/sampling.py cannot be imported: ImportError: cannot import name",
                 "          labs/sampling.py:1 in <module>\n"),
    "msaa": (None,
             "wrong     there is no labs/msaa.py; take it from the hand-out, or run python3 -m"),
    "interpolation": ("def twice(x):\n    return 2 * x\n",
                      "wrong     labs/interpolation.py has no function double; keep the names"),
    "texturing": ("double = 2\n", "wrong     labs/texturing.py has no function double"),
    "antialiasing": ("def double(x, y):\n    return 2 * x\n",
                     "given     double(3.0)\nwrong     TypeError: double() missing 1 required")}


def test_a_lab_that_cannot_be_used_fails_its_checks_with_one_sentence(house, run_here):
    """pytest breaks off, other labs fail with it, or the course's own lines are shown."""
    check = CHECKS[:CHECKS.index("@exercise")] + check_text(
        "1.1", "twice", "Once.", "assert_close(impl.double(3.0), 6.0)")
    root = house({f"tests/labs/test_{topic}.py": check for topic in UNUSABLE}
                 | {f"labs/{topic}.py": lab for topic, (lab, *_) in UNUSABLE.items() if lab}
                 | {"labs/subdivision.py": "def double(x):\n    return 2 * x\n",
                    "tests/labs/test_subdivision.py": check})
    done = run_here(root, "pytest", "--impl=labs")
    assert "7 failed, 1 passed" in done.stdout
    for _, *sentences in UNUSABLE.values():
        for sentence in sentences:
            assert sentence in done.stdout
    assert "labkit/checks/" not in done.stdout


def test_any_folder_with_a_topics_file_can_be_checked(course, run_here, tmp_path):
    """A folder beside the course is not found, or its files cannot import each other."""
    (tmp_path / "transforms.py").write_text("from . import sampling\n\ndouble = sampling.double\n")
    (tmp_path / "sampling.py").write_text("def double(x):\n    return x + x\n")
    done = run_here(course, "pytest", f"--impl={tmp_path}", "-k", "twice")
    assert done.returncode == 0, done.stdout
    assert not list(tmp_path.glob("__pycache__")), "a quick edit would meet stale bytecode"


def test_a_folder_that_is_not_there_is_told(course, run_here):
    """Every check fails with an import error."""
    done = run_here(course, "pytest", "--impl=nowhere")
    assert done.returncode == 4
    assert "there is no folder nowhere to check; give labs, reference" in done.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="no timer there")
def test_a_loop_without_an_end_is_stopped_and_its_line_is_told(house, run_here, monkeypatch):
    """A check hangs, and nobody hears of the others; or a check that follows is stopped, too."""
    lab = exercise_text("1.1", "wait", "Wait.", "while n:", "    pass", "return n", inputs="n")
    checks = "".join(
        check_text("1.1", name, "It is not.", f"assert_close(impl.wait({n}), 0)", "time.sleep(0.5)")
        for name, n in (("it_is_short", 0), ("it_ends", 1), ("it_ends_again", 1)))
    root = house({"labs/transforms.py": lab.lstrip(), "tests/labs/test_transforms.py":
                  f"import time\n\nfrom labkit.checks import assert_close, exercise\n{checks}"})
    monkeypatch.setattr(loader, "CALL_SECONDS", 0.3)
    done = run_here(root, "course", "check", "1.1")
    assert "1.1 wait, failing, 1 check not run" in done.stdout, done.stdout
    assert "Stopped: after 0.3 s; does a loop never end" in done.stdout
    assert "labs/transforms.py:4 in wait" in done.stdout or (
        "labs/transforms.py:3 in wait" in done.stdout)


def test_numbers_that_look_alike_are_shown_with_the_digits_in_which_they_differ():
    """Expected [1.], got [1.]."""
    said = text_of(assert_close, np.array([1.0, 1 + 2e-9]), np.array([1.0, 1.0]))
    assert "expected  [1., 1.]" in said and "1.000000002]" in said
