"""Hints: a fact about the numbers is told, certain only where they are enough, and never a guess.
"""
import numpy as np
import pytest

from labkit.checks import Mismatch, assert_close, assert_equal, assert_picture, hints
from labkit.checks.report import Check, suspected
from labkit.checks.runner import explained
from labkit.checks.showing import axes_in_words
from labkit.suspicions import ANYWHERE, Suspicion, suspicion

CORNER = np.array([[1.0, 2.0, 4.0], [-3.0, 5.0, 9.0]])
FOUR, SIX = np.tile(CORNER, (2, 1)), np.tile(CORNER, (3, 1))
UNIT = np.array([[0.6, 0.8], [-0.8, 0.6], [0.28, 0.96]])
RAGGED = np.ones((2, 2)), np.ones((1, 1))
FACE_INDEX = np.array([[-1, -1, -1, -1, -1, -1],
                       [-1, -1,  0,  0,  2, -1],
                       [-1, -1,  0, -1, -1, -1],
                       [-1, -1, -1, -1, -1, -1],
                       [-1, -1, -1, -1, -1, -1]])


@pytest.fixture(autouse=True)
def no_pictures(monkeypatch, tmp_path):
    monkeypatch.setattr("labkit.places.check_picture", lambda name: tmp_path / f"{name}.png")


def told(assertion, got, expected, *inputs):
    """What is suspected where got comes in place of expected, from a call with these inputs."""
    compared = mismatch(got, expected, assertion).compared
    found = suspicion(*compared[:3], inputs, compared.picture)
    return "" if found is None else str(found)


@pytest.mark.parametrize(("got", "expected", "hint"), [
    (-CORNER, CORNER, "the sign is flipped"),
    (-CORNER[0], CORNER[0], "it may be that the sign is flipped"),  # of three, as by chance
    (CORNER.T, CORNER, "it is the transpose, (3, 2) instead of (2, 3)"),
    (CORNER.sum(), CORNER, "it is summed over all axes"),
    (CORNER.sum(1), CORNER, "it is summed over axis 1, too"),
    (CORNER[::-1], CORNER, "the order along axis 0 is reversed"),
    (FOUR[::-1] * [[1], [2], [1], [1]], FOUR * [[1], [1], [2], [1]],
     "the order along axis 0 is reversed"),
    (np.int64(CORNER / 4), CORNER / 4, "these are integers, and fractions were"),
    (np.complex64((CORNER + 1j) / 3), (CORNER + 1j) / 3, "float32 is not precise"),
    (CORNER + 1j, CORNER - 1j, "the complex conjugate came"),
    (CORNER[:, ::-1], CORNER, "the order along axis 1 is reversed"),
    (CORNER[:, [1, 0, 2]], CORNER, "the order along axis 1 is [1, 0, 2]"),
    (CORNER[:, [1, 2, 0]], CORNER, "the order along axis 1 is [1, 2, 0]"),
    (CORNER.reshape(1, 6), CORNER, "the numbers are right, the shape is not"),
    (np.stack([CORNER, 2 * CORNER]), 3 * CORNER, "the sum over axis 0 is missing"),
    (CORNER * 2, CORNER, "everything is 2 times what was expected, twice as much"),
    (CORNER / 2, CORNER, "everything is 0.5 times what was expected, half of it"),
    (np.degrees(CORNER), CORNER,
     "everything is 57.2958 times what was expected: degrees for radians"),
    (CORNER * 1.234567, CORNER,
     "it may be that everything is 1.23457 times what was expected: is a factor missing"),
    (CORNER + 0.5, CORNER, "everything is 0.5 more than expected"),
    (CORNER - 1, CORNER, "everything is 1 less than expected"),
    (CORNER[:, [2, 0, 1]][::-1], CORNER, "the numbers are right, and stand in another order"),
    (np.stack([CORNER, CORNER + 1], -1), CORNER,
     "it is number 0 along axis 2 that was expected, alone"),
    (CORNER / 4 // 1, CORNER / 4, "the numbers are rounded down"),
    (np.trunc(CORNER / 4), CORNER / 4, "the numbers are rounded toward 0"),
    (np.clip(CORNER, 0, 1), CORNER, "the numbers are cut off at 0 and 1"),
    (CORNER ** 2, CORNER, "the square of what was expected came"),
    (3 * UNIT * [[1], [2], [4]], UNIT,
     "the numbers along the last axis are not scaled until they have length 1"),
    (np.float32(CORNER / 3), CORNER / 3, "float32 is not precise enough"),
    (np.float16(CORNER[:, :2] / 3), CORNER[:, :2] / 3, "float16 is not precise enough"),
    (np.floor(CORNER + 0.5), CORNER + 0.125, "everything is 0.125 less"),  # no float16
    (CORNER * [1, 1, 1.001], CORNER, "it may be that it is 1.001 times"),  # as float32 holds, too
    (CORNER + 1e-8 * CORNER ** 2, CORNER, "it is right to seven digits or so"),
    (CORNER * [1, -1, 1], CORNER, "it may be that the sign is flipped in [..., 1]"),
    (SIX * [-1, 1, -1], SIX, "the sign is flipped in [..., 0] and [..., 2]"),
    (SIX * [1, 1, 0], SIX, "it is 0 everywhere in [..., 2]"),
    (SIX < 3, SIX >= 3, "true and false are swapped"),
    (CORNER * [[1, 2, 1], [1, 1, 2]], CORNER,
     "it may be that it is 2 times what was expected in all that is wrong"),
    (FACE_INDEX[::-1], FACE_INDEX, "it is upside down; row 0 is at the bottom"),
    (FACE_INDEX[:, ::-1], FACE_INDEX, "left and right are swapped"),
    (FACE_INDEX + 1, FACE_INDEX, "everything is 1 more than expected"),
    (np.roll(FACE_INDEX, 1, 0), FACE_INDEX, "it is one pixel too high"),
    (np.roll(FACE_INDEX, -1, 0), FACE_INDEX, "it is one pixel too low"),
    (np.roll(FACE_INDEX, 1, 1), FACE_INDEX, "it is one pixel too far right"),
    (np.roll(FACE_INDEX, -1, 1), FACE_INDEX, "it is one pixel too far left"),
], ids=lambda value: value if isinstance(value, str) else "")
def test_a_common_mistake_is_named(got, expected, hint):
    """The hint names another mistake, or the opposite direction."""
    assertion = {"i": assert_picture, "b": assert_equal}.get(expected.dtype.kind, assert_close)
    assert told(assertion, got, expected).startswith(hint)


def test_a_factor_is_named_by_the_input_that_it_is_made_of():
    """Half the width is missing, or w, or the number of points; the student sees a number only."""
    w = np.array([2.0, 3.0, 5.0, 7.0])
    rows = np.arange(1.0, 9).reshape(4, 2)
    assert told(assert_close, 8 * rows, rows, ("width", 16)) == (
        "everything is 8 times what was expected; width / 2 is 8")
    assert told(assert_close, rows / 5, rows, ("points", np.ones((5, 2)))) == (
        "everything is 0.2 times what was expected; len(points) is 5")
    assert told(assert_close, rows * [1, 640 / 641], rows, ("width", 641)).endswith(
        "[..., 1]: width // 2 stands for width / 2")
    assert told(assert_close, CORNER[:, :2], CORNER) == (
        "the rest of it is missing: (2, 2) of (2, 3)")
    assert told(assert_close, rows[:, ::-1], rows) == "[..., 0] and [..., 1] are swapped"
    assert told(assert_close, rows / w[:, None], rows, ("clip", np.c_[rows, rows[:, :1], w])) == (
        "it is what was expected, divided by clip[..., 3]")


def test_what_indices_tell_is_told():
    """-1 was used as an index, or += wrote once where an index stands twice."""
    faces = np.array([[0, 1, 2], [2, 3, 4]])
    right = np.arange(1.0, 11).reshape(5, 2)
    once = right * np.array([[1], [1], [0.3], [1], [1]]) * [[1, 2]] ** np.array([[0, 0, 1, 0, 0]]).T
    assert "names more often" in told(assert_close, once, right, ("faces", faces))
    index = np.array([[0, -1, 1], [-1, 2, -1]])
    shaded = np.where(index < 0, 0.0, 0.5 + index)
    assert "only where face_index is -1" in told(
        assert_picture, np.array([0.5, 1.5, 2.5])[index], shaded, ("face_index", index))
    assert "only where across is 0: that" in told(
        assert_equal, np.arange(9) > 7, np.arange(9) > 3, ("across", np.arange(9) // 4 - 1))
    assert "only where across is -1" in told(
        assert_equal, np.zeros(9, bool), np.arange(9) < 8, ("across", np.arange(9) // 8 - 1))
    nowhere = np.where(once != right, np.inf, right)
    assert told(assert_close, nowhere, right, ("faces", faces)) == ""  # divided by a mass of 0
    w = np.array([1.0, -2, 3, -4, 5, 6, 7, -8, 9, 1, 2, -3, 4, 5])
    many = np.arange(1.0, 29).reshape(14, 2)
    mirrored = np.where(w < 0, -1, 1)[:, None] * many
    assert told(assert_close, mirrored, many, ("w", w)) == "the sign is flipped where w < 0"
    assert "w <" not in told(assert_close, mirrored[:5], many[:5], ("w", w[:5]))  # as by chance
    assert told(assert_close, many - w[:, None], many, ("w", w)) == (
        "it is what was expected, minus w")
    last = right + np.array([[0], [0], [0], [0], [1]]) * [0.7, 0.3]
    assert "only the last row" in told(assert_close, last, right, ("face_index", index))


@pytest.mark.parametrize(("got", "expected"), [
    (CORNER + CORNER ** 2, CORNER),
    (np.array([3.0, 5.0]), np.array([5.0, 7.0])),        # two numbers that are 2 less
    (CORNER < 3, CORNER >= 3),                           # six truth values
    (np.array([1, -1, -1, 1, -1]), np.array([-1, 1, 1, -1, 1])),  # an index has no sign
    (np.maximum(CORNER, [[2.0], [-3.0]]) * [1, 0, 1], CORNER),
    (np.array([[1, 0.0], [2, 0], [3, 5]]), np.array([[1, 7.0], [2, 8], [3, 5]])),
    (CORNER * [1, 1, 1.5] + [0, 0.1, 0], CORNER),
], ids=["a sum of two powers", "two numbers", "truth", "an index", "a column", "a part of a column",
        "two columns"])
def test_no_mistake_is_named_where_none_explains_the_numbers(got, expected):
    """A hint that is only a guess."""
    assert told(assert_equal, got, expected) == ""


@pytest.mark.parametrize(("came", "expected", "told"), [
    ((3,), (5, 3), "axis 0 is lost"), ((5,), (5, 1), "axis 1 is lost"),
    ((5, 5), (5,), "(5,) with (5, 1) gives (5, 5)"), ((5, 3, 2), (5, 2), "axis 1 is too many"),
    ((4, 3), (3, 4), "another order"), ((7,), (5, 3), None), ((4, 3), (), "one number is"),
    ((), (4, 4), "one number came"),
    ((4,), (3,), "without axis 0, x (3, 4) becomes (4,), and without axis 1 (3,)")])
def test_what_became_of_an_axis_is_told_by_the_shapes(came, expected, told):
    """A sum over the wrong axis, or one more axis by broadcasting, and two tuples are all."""
    said, of_integers = (axes_in_words(np.ones(came), np.ones(expected, kind), [
        ("n", 2), ("x", np.ones((3, 4)))]) for kind in (float, int))
    assert said == told or told in said
    assert "becomes" not in str(of_integers)


@pytest.mark.parametrize("shape", [(), (0,), (1,), (3,), (2, 3), (3, 3), (4, 1, 3)], ids=str)
@pytest.mark.parametrize("kind", [bool, int, float, complex, "U1"])
def test_any_numbers_can_be_looked_at(shape, kind):
    """The report breaks off: complex numbers cannot be rounded, empty arrays have no largest. Or a
    part is compared by what knows the whole alone, as a gradient check's mask of what is seen.
    """
    rng = np.random.default_rng(0)
    for other in (kind, float, int):
        got, expected = (rng.integers(0, 9, shape).astype(k) for k in (other, kind))
        index = np.array([0, -1, 2, 2])
        suspicion(got, expected, lambda a, b: np.zeros(shape, bool) | np.asarray(a == b),
                  [("faces", index), ("x", got), ("name", "a"), ("none", None), ("ragged", RAGGED),
                   ("empty", np.zeros((0, 3))), ("no faces", np.zeros((0, 3), int))])


# --- all checks of an exercise ----------------------------------------------------------------


def edge(p, a, b):
    raise NotImplementedError  # it is named alone


def failed(nodeid, suspected, fine_print=False):
    return Check("1.1", nodeid, "", "failed", "", None, 0.0, fine_print, None, 9, suspected)


SIGN = "the sign is flipped"
TIMES = "everything is 0.666667 times what was expected"
SURE, UNSURE, NONE, OTHER = (SIGN, True), (SIGN, False), ("", False), ("rows are swapped", True)


@pytest.mark.parametrize(("suspected", "hint"), [
    ([SURE, None], SIGN), ([None, SURE], f'in "Claim 1": {SIGN}'), ([UNSURE, SURE], SIGN),
    ([SURE, NONE], f"in this claim: {SIGN}"), ([SURE, OTHER], f"in this claim: {SIGN}"),
    ([NONE, OTHER], 'in "Claim 1": rows are swapped'), ([(TIMES, True), NONE], None),
    ([None, None], None), ([UNSURE, None], None), ([UNSURE, NONE], None),
    ([UNSURE, UNSURE], SIGN), (2 * [(ANYWHERE, False)], f"it may be that {ANYWHERE}"),
    ([(f"in output 2 {SIGN}", False), (f"{SIGN} in [..., 1]", True)], f"in output 2 {SIGN}"),
    ([("all is 4 times x; a or len(b) is 4", True), ("all is 9 times x; a is 9", True)],
     "all is 4 times x; a is 4"),
    ([("all is 4 times x; len(b) is 4", True), ("all is 9 times x; a is 9", True)],
     "all is 4 times x"),
    ([("it is 4 times x in [..., 1, :]", True), ("it is 9 times x in [..., 0]; a is 9", True)],
     "it is 4 times x in [..., 1, :]")])
def test_a_suspicion_is_certain_where_no_other_check_speaks_against_it(suspected, hint):
    """One check's numbers happen to have the other sign, and it is told of all. Or what is certain
    of one claim is kept back, or stands below another claim.
    """
    checks = [failed(f"tests/labs/test_x.py::test_{k}", one)._replace(claim=f"Claim {k} [case]")
              for k, one in enumerate(suspected)]
    assert hints.hint("1.1", checks) == hint


@pytest.mark.parametrize("error", [IndexError("out of bounds"), Mismatch(("wrong", "None came"))])
def test_an_error_and_what_is_no_array_speak_against_all_suspicions(error):
    """All checks but one raise, and the numbers of that one are told as the cause."""
    assert suspected(error, None, None, None) == hints.NOTHING


@pytest.mark.parametrize(("sentence", "sure", "hint", "has_list"), [
    ("it is flipped", True, "it is flipped", False),
    ("is it?", False, "it may be that is it?", True), (TIMES, True, TIMES, True),
    (f"{TIMES}; len(x) is 9", True, f"{TIMES}; len(x) is 9", False),
    ("it is 4 times what was expected in [..., 1]", True,
     "it is 4 times what was expected in [..., 1]", True)])
def test_a_hint_stands_first_and_once_and_a_list_only_where_it_is_not_sure(
        sentence, sure, hint, has_list):
    """The cause stands below thirty lines of numbers, and beside a list of other causes. Or a
    factor that nothing explains hides the list in which the cause is named.
    """
    more = "perhaps   A sign.\n" * has_list
    rows = [f"hint      {hint}\n{more}wrong", f"{more}wrong"]
    checks = [failed(name, (sentence, sure))._replace(message="wrong", catches="A sign.")
              for name in ("test_0", "test_1")]
    assert [check.message for check in explained(checks)] == rows


def test_what_a_check_made_of_the_result_is_not_certain():
    """The sign of a determinant is flipped, and a matrix with two rows exchanged is right."""
    returned = np.arange(1.0, 9)
    compared = [hints.suspected(mismatch(got, -got).compared, (edge, (), {}), returned)
                for got in (returned, 2 * returned)]
    assert compared == [Suspicion(*SURE), Suspicion(*UNSURE)]


UP, SQUARES, ZEROS = np.arange(1.0, 9), np.arange(8.0) ** 2, np.zeros(8)


@pytest.mark.parametrize(("returned", "got", "expected", "suspected"), [
    ((UP, SQUARES), UP, SQUARES, ("the outputs are in the wrong order", True)),
    ((UP, np.arange(8)), UP, np.arange(8), ("the outputs are in the wrong order", True)),
    ((UP, ZEROS), ZEROS, UP + 1, hints.NOTHING),
    ((UP, -2 - UP), np.stack([UP, -2 - UP]), np.stack([UP, 2 + UP]),
     ("the sign is flipped in [..., 1, :]", True)),
], ids=["another order", "another kind", "zero everywhere", "several in one array"])
def test_what_several_outputs_tell_together_is_told(returned, got, expected, suspected):
    """Each of two outputs looks like a mistake of its own. That nothing came is seen; "in output
    2", and then nothing, is no hint either. A check stacks two gradients, and the sign of one,
    which is plain, is not named.
    """
    compared = mismatch(got, expected, assert_equal).compared
    assert hints.suspected(compared, (edge, (), {}), returned) == suspected


def mismatch(got, expected, assertion=assert_close):
    with pytest.raises(Mismatch) as error:
        assertion(got, expected)
    return error.value


@pytest.mark.parametrize(("marks", "named"), [
    ({"paper": "a", "random": "b"}, "is half"), ({"paper": "a", "random": hints.OTHER}, None),
    ({"paper": "c", "random": hints.OTHER}, "may be twice"), ({"paper": "c"}, None),
    ({"paper": "x", "random": hints.OTHER}, None)])
def test_a_known_mistake_is_told_with_other_random_inputs(monkeypatch, marks, named):
    """Graded work has a seed of its own, and its report names no mistake. Or one of two that agree
    in all that can be compared, or one that fails other checks.
    """
    monkeypatch.setattr(hints, "known_mistakes", lambda: {"1.1": [
        ("half", {"paper": "a", "random": "b"}), ("third", {"paper": "a", "random": "d"}),
        ("twice", {"paper": "c", "random": "e"})],
        "1.1 twice": [[hints.digest({"paper": "g 1:2"}), 0, 2]]})
    told = hints.known_mistake("1.1", hints.Pattern(marks, 4))
    assert told == (named and f"this {' what comes out when '.join(named.rsplit(' ', 1))}")
    both = hints.known_mistake("1.1", hints.Pattern({"paper": "g"}, 4))
    assert both.endswith("when two things are wrong at once. One: half. The other: twice")


A, B = "a 2:1", "b 1.0:2 1.1:3"


@pytest.mark.parametrize(("marks", "told"), [
    ({"x": "d 1:9 2:1", "y": "e 2:4"}, "in output 2 this may be what comes out when half"),
    ({"x": "d 1:9 2:7", "y": "e 2:4"}, None), ({"x": "d 2:1"}, None),
    ({"u": "d 1.0:2 1.1:3"}, "in [..., 0] and [..., 1] this may be what comes out when third"),
    ({"u": "d 1.0:2 1.1:3 1.2:5"}, None), ({"u": "d 1.0:2", "v": hints.OTHER}, None)])
def test_a_known_mistake_is_told_of_the_part_in_which_it_is_seen(monkeypatch, marks, told):
    """A second mistake in another output hides the first one. Or a mistake is told that fails a
    check that passes, or that shows in one column where another one is wrong.
    """
    monkeypatch.setattr(hints, "known_mistakes", lambda: {"1.1": [
        ("half", {"x": A, "y": "f 2:4"}), ("third", {"u": B})]})
    assert hints.in_part("1.1", hints.Pattern(marks, 9)) == told
    assert hints.in_words(("1", "2", "3", "4")) == "in 4 places"


@pytest.mark.parametrize(("marks", "told"), [
    ("aax", "in 2 of 3 checks this may be what comes out when twice"),
    ("aab", "in 2 of 3 checks this may be what comes out when twice"),
    ("axx", "in this claim this may be what comes out when twice"),
    ("xxb", 'in "2" this may be what comes out when third'), ("axb", None), ("xxx", None)])
def test_a_known_mistake_is_told_of_the_checks_in_which_its_numbers_came(monkeypatch, marks, told):
    """A second mistake in other checks hides the first one. Or of two mistakes, each in one check,
    one is told.
    """
    monkeypatch.setattr(hints, "known_mistakes", lambda: {"1.1": [
        ("twice", {"t0": "a 1:2", "t1": "a", "t3": "a"}), ("third", {"t1": "z", "t2": "b"})]})
    assert hints.in_checks("1.1", [
        Check("1.1", f"test.py::t{k}", f"{k} [one]", "failed", "", None, 0.0, False, mark, 4)
        for k, mark in enumerate(marks)]) == told


def test_parts_are_outputs_and_wrong_columns():
    """A column that is right is taken for one that a mistake spoils, or three numbers for enough.
    """
    rows = np.arange(12.0).reshape(4, 3)
    compared = mismatch(rows * [1, 1, 2], rows).compared
    marks = hints.fingerprint_and_count("x", (rows[0], compared.got, rows), compared)[0].split()
    assert [mark.partition(":")[0] for mark in marks[1:]] == ["2", "3", "2.2"]
