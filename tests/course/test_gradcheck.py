"""The gradient checker: right gradients pass, wrong ones fail, and the failure says how."""
import re

import numpy as np
import pytest

from course.given import gradcheck as module
from course.given import sweeps
from course.given.gradcheck import GradientMismatch, GradReport, gradcheck

# --- passes of which the gradient is known ------------------------------------------------------


def product(a, b):
    return a @ b


def product_backward(grad_output, a, b):
    return grad_output @ b.T, a.T @ grad_output


def quotient_backward(g, a, b):
    return g / b, -g * a / b**2


def gather(values, index):
    return values[index]


def gather_backward(grad_output, values, index):
    grad_values = np.zeros_like(values)
    np.add.at(grad_values, index, grad_output)
    return grad_values


def texel(u):
    return np.floor(u).astype(int)


def linear(texels, u):
    """Texels (N,) at positions u (M,), linear in between: it bends where texel(u) changes."""
    i = texel(u)
    return (1 - (u - i)) * texels[i] + (u - i) * texels[i + 1]


def linear_backward(grad_output, texels, u):
    i = texel(u)
    grad_texels = (gather_backward((1 - (u - i)) * grad_output, texels, i)
                   + gather_backward((u - i) * grad_output, texels, i + 1))
    return grad_texels, (texels[i + 1] - texels[i]) * grad_output


def sign(x):
    return x > 0


def absolute_backward(g, x):
    return g * np.where(x > 0, 1.0, -1.0)


def sine_backward(g, x):
    return g * np.cos(x)


def failure(*args, **kwargs):
    """The message with which gradcheck fails."""
    with pytest.raises(GradientMismatch) as caught:
        gradcheck(*args, **kwargs)
    return str(caught.value)


WEIGHTS = np.array([1.0, 1e-7, 1e-13])


def blurred(x):
    """A sum whose rounding hides the smallest weight."""
    return np.array([WEIGHTS @ x + 1e3])


# --- right gradients ----------------------------------------------------------------------------


NUMBERS = np.random.default_rng(7)
X, NEAR_KINKS = NUMBERS.normal(size=5), np.array([1e-3, -1e-4, 1e-5, 1.0])
A, B = NUMBERS.normal(size=(3, 4)), NUMBERS.normal(size=(4, 3))
SMALL = np.sign(A) * (0.01 + np.abs(A))
ON_A_KINK = np.append(np.linspace(0.1, 1, 11), 0.0)
REUSED = np.empty(5)
RIGHT = {  # what passes: forward, backward, inputs, options, numbers checked, a bound of the error
    "product": (product, product_backward, (A, B), {}, 12 + 12 + 3 * 3, 1e-9),
    "quotient": (np.divide, quotient_backward, (B.T, SMALL), {}, 33, 1e-6),
    "gather": (gather, gather_backward, (A, np.array([0, 2, 2, 1, 0])), {}, 12 + 3, 1e-6),
    "a float, chosen of two": (lambda x, exponent: x**exponent, lambda g, x, n: g * n * x**(n - 1),
                               (2.0, 3.0), {"differentiable": [0]}, 1 + 3, 1e-6),
    "single precision": (product, product_backward, (A.astype(np.float32), B), {}, 33, 1e-9),
    "an array used again": (lambda x: np.sin(x, out=REUSED), sine_backward, (X,), {}, 8, 1e-6),
    "zero beside small numbers": (lambda x: np.sin(1e6 * x),
                                  lambda g, x: 1e6 * g * np.cos(1e6 * x),
                                  (np.array([0.0, 1e-6, -2e-6]),), {}, 6, 1e-9),
    "outputs that dwarf their change": (lambda x: np.append(np.full(999, 1e9), x),
                                        lambda g, x: g[999:], (X,), {}, 8, 1e-12),
    "below what float64 resolves": (blurred, lambda g, x: g * WEIGHTS, (np.ones(3),), {}, 6, 1e-6),
    "the end of the domain": (np.sqrt, lambda g, x: g / (2 * np.sqrt(x)),
                              (np.array([1e-3, 1.0, 1.0]),), {}, 6, 1e-6),
    "kinks within the first steps": (np.abs, absolute_backward, (NEAR_KINKS,), {}, 7, 1e-6),
    "the same with decisions": (np.abs, absolute_backward, (NEAR_KINKS,), {"decisions": sign},
                                7, 1e-6),
    "a large input": (np.sin, sine_backward, (np.tile(A, (16, 16)),), {},
                      sweeps.ELEMENTS + sweeps.DIRECTIONS, 1e-6)}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("case", RIGHT)
def test_a_right_gradient_passes(case):
    """Steps are too large, reach across a kink or out of the domain; integers are differentiated,
    or what was not chosen; the differences are taken in float32, of one array that is written
    twice, or of the sum of all outputs, whose rounding drowns the change. Rounding fails what is
    right. All elements of a texture are differenced, one by one.
    """
    forward, backward, inputs, options, checked, bound = RIGHT[case]
    report = gradcheck(forward, backward, inputs, **options)
    assert report[:2] == (checked, 0)  # of each input its elements and 3 directions, 3 of both
    assert report.worst_error < bound


def test_several_outputs_bring_one_upstream_gradient_each():
    """All outputs share one upstream gradient."""
    def backward(grad_sine, grad_square, x):
        assert grad_sine.shape == grad_square.shape and not np.allclose(grad_sine, grad_square)
        return grad_sine * np.cos(x) + 2 * x * grad_square

    assert gradcheck(lambda x: (np.sin(x), x**2), backward, (X,)).checked


def test_the_callers_inputs_stay_untouched(rng):
    """The steps, or a backward pass that works in place, change the caller's own arrays."""
    def backward(g, values, index):
        index[...] = values[...] = 0

    values, index = rng.normal(size=4), np.array([3, 1, 2])
    kept = values.copy()
    gradcheck(gather, gather_backward, (values, index))
    assert "changed its argument" in failure(gather, backward, (values, index))
    assert np.array_equal(values, kept) and np.array_equal(index, [3, 1, 2])


# --- the numeric derivative ---------------------------------------------------------------------


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1.0, 1e3, 1e6])
@pytest.mark.parametrize("function, derivative", [
    (np.exp, np.exp),
    (np.sin, np.cos),
    (lambda x: x / (1 + x**2), lambda x: (1 - x**2) / (1 + x**2) ** 2),
    (lambda x: 1 / x, lambda x: -1 / x**2)], ids=["exp", "sin", "rational", "reciprocal"])
def test_the_numeric_derivative_is_true_to_1e_8(rng, function, derivative, scale):
    """The steps are not scaled to the input, or the sweep stops on the wrong step."""
    x = scale * rng.uniform(0.3, 1.4, 20)
    case = module.Case(lambda x: function(x / scale), None, None, [x], {}, "")
    slope = module.slope_of_loss(case, [np.ones(20)])
    part = sweeps.element_part("x", 0, x, np.ones(20), rng)
    numeric = np.array([sweeps.sweep(slope, *part.probes[index])[0] for index in part.probes])
    np.testing.assert_allclose(numeric, derivative(x / scale) / scale, rtol=1e-8)


def test_extrapolation_removes_the_square_of_the_step():
    """Wrong factors in eq. (2): the sweep settles later, on a number that is less true."""
    numeric, differences, _ = sweeps.sweep(lambda moves, h: 3 + 7 * h**2, {}, 1.0)
    assert abs(numeric - 3) < 1e-14 and np.isfinite(differences).sum() == 3


def test_the_numeric_derivative_is_taken_on_the_plateau():
    """It is taken at the smallest step, in the rounding, or at the largest, off by h^4."""
    steps = list(sweeps.STEPS)
    numeric, _, change = sweeps.sweep(
        lambda moves, h: 3 + 1e6 * h**4 + (-1) ** steps.index(h) * 1e-13 / h, {}, 1.0)
    assert abs(numeric - 3) < 1e-7
    assert 1 < np.argmin(change) < len(change) - 2


# --- wrong gradients ----------------------------------------------------------------------------


def assigned(g, values, index):
    """What a scatter is not: of repeated indices, the last one wins."""
    grad_values = np.zeros_like(values)
    grad_values[index] += g
    return grad_values


SQUARE = NUMBERS.normal(size=(2, 3, 3))
RETURNS = "backward must return 2 gradients, with respect to input 0 (a), input 1 (b); it returned"
WRONG_PRODUCTS = {  # backward, parts of what is told
    "sign": (lambda g, a, b: (-g @ b.T, a.T @ g), "(a): 9 of 9 ... off; the sign is flipped"),
    "factor": (lambda g, a, b: (g @ b.T, 2 * a.T @ g), "(b): 9 of 9 ... everything is 2 times"),
    "zero": (lambda g, a, b: (g @ b.T, 0 * b), "(b): 9 of 9 ... off; it is zero everywhere"),
    "column": (lambda g, a, b: (g @ b.T, a.T @ g * (np.arange(3) < 2)),
               "input 1 (b): 3 of 9 ... off; it may be that it is 0 everywhere in [..., 2]\n"),
    "unexplained": (lambda g, a, b: (g @ b.T, a.T @ g + [0, 7, 0]), "off in [..., 1]\n"),
    "shape": (lambda g, a, b: (g @ b.T, (a.T @ g)[:2]), "the gradient with respect to input 1 (b) "
              "must have that input's shape (3, 3); it has (2, 3)"),
    "too many": (lambda g, a, b: (g @ b.T, a.T @ g, g), f"{RETURNS} 3"),
    "too few": (lambda g, a, b: g @ b.T, f"{RETURNS} 1"),
    "NaN": (lambda g, a, b: (g @ b.T, np.nan * b), "backward returned NaN or infinity"),
    "None in a tuple": (lambda g, a, b: (g @ b.T, None), "backward returned NaN or infinity"),
    "None": (lambda g, a, b: None, "backward returned None; is its return statement missing?"),
    "text": (lambda g, a, b: ("a", "b"), "backward must return an array of numbers"),
    "changes an input": (lambda g, a, b: (a.__imul__(2), b), "backward changed its argument 1"),
    "changes grad_output": (lambda g, a, b: (g.__imul__(2) @ b.T, b),
                            "backward changed its argument 0")}
WRONG = {  # forward, backward, inputs, parts of what is told, options
    "sum for mean": (lambda x: x.mean(axis=0), lambda g, x: np.broadcast_to(g, x.shape), (A,),
                     "everything is 3 times what was expected"),
    "a forgotten factor": (  # no pattern is made up
        lambda x, y: x**2 * y + np.sin(x),
        lambda g, x, y: (g * (x * y + np.cos(x)), g * x**2), (X, X[::-1]),
        "to input 0 (x): 5 of 5 looked at are off\n"),
    "the last write wins": (gather, assigned, (X, np.array([0, 2, 2, 3])), "at [2]"),
    "grad_output is averaged": (np.sin, lambda g, x: g.mean() * np.cos(x), (A,), "12 of 12"),
    "an output left out": (lambda x: (np.sin(x), x**2), lambda g, h, x: g * np.cos(x), (X,), "off"),
    "an error of 1e-5": (np.sin, lambda g, x: 1.00001 * sine_backward(g, x), (X,), "1.00001 times"),
    "a small element": (blurred, lambda g, x: g * WEIGHTS * [1, 1.1, 1], (np.ones(3),), "at [1]"),
    "of a large input": (np.sin, lambda g, x: g * x, (NUMBERS.normal(size=(9, 9)),),
                         "60 of 60 looked at"),
    "zeros, though right": (lambda x, y: np.floor(x) + y, lambda g, x, y: (0 * g, g),
                            tuple(NUMBERS.uniform(0.1, 0.9, (2, 4))),
                            "nothing to check ... input 0 (x) is zero everywhere"),
    "an empty input": (np.sin, sine_backward, (np.zeros((0, 3)),), "nothing to check"),
    "forward changes its input": (lambda x: x.__imul__(2), lambda g, x: g, (np.ones(3),),
                                  "forward changed its argument 0: let it work on a copy"),
    "forward is not finite": (lambda x: x / 0, lambda g, x: g, (np.ones(3),),
                              "forward returned NaN or infinity"),
    "inputs without names": (lambda *inputs: product(*inputs), lambda g, a, b: (g @ b.T, -a.T @ g),
                             (A, B), "with respect to input 1: "),
    "a jump": (lambda x: x + (x > 0.5), lambda g, x: g, (np.array([0.5, 0.3]),),
               "at [0] ... no two steps agree"),
    "a kink": (np.abs, absolute_backward, (ON_A_KINK,), "at [11]"),
    "beside one left out": (
        np.abs, lambda g, x: absolute_backward(g, x) * (1 + (x == 1)), (ON_A_KINK,),
        "at [10] ... 4 of 15 numbers left out", {"decisions": sign}),
    "two of 13 left out": (np.abs, absolute_backward, (np.append(ON_A_KINK, 0.0),),
                           "2 of 13 elements of input 0 ... edges and ties",
                           {"decisions": sign}),
    "a small input left out": (  # the share is not that of all elements
        linear, linear_backward, (NUMBERS.normal(size=60), np.arange(4.0)),
        "4 of 4 elements of input 1 (u)", {"decisions": lambda texels, u: texel(u)}),
} | {name: (product, wrong, tuple(SQUARE), told) for name, (wrong, told) in WRONG_PRODUCTS.items()}


@pytest.mark.filterwarnings("ignore:divide by zero")
@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_fails_and_is_told(case):
    """The mistake passes, or the message blames another input or another mistake. All ones
    upstream cannot tell grad_output from its mean; broadcasting hides a wrong shape; NaN compares
    as not larger; a check of zeros, or with next to nothing left in, passes.
    """
    forward, wrong, inputs, told, *options = WRONG[case]
    message = failure(forward, wrong, inputs, name="it", **dict(*options))
    assert message.startswith("it: ")
    assert [part for part in told.split(" ... ") if part not in message] == [], message
    assert message.count("with respect to input") <= 1


@pytest.mark.parametrize("forward, x", [(np.square, 3.0), (np.floor, np.array([0.4, 0.7]))])
def test_no_factor_is_told_of_one_number_or_of_zeros(recwarn, forward, x):
    """Any two numbers have a ratio; that of zeros warns and is no number."""
    message = failure(forward, lambda g, x: g * x, (x,))
    assert "times" not in message and "sign" not in message and not recwarn.list


def test_one_wrong_element_of_a_large_input_is_caught_by_the_directions():
    """An element that is not among those chosen one by one is not checked at all."""
    x = np.ones((100, 100))

    def backward(g, x):
        return 2 * g * x * (np.arange(x.size).reshape(x.shape) != 4321)

    message = failure(np.square, backward, (x,))
    assert "input 0 (x), random direction: 3 of 3" in message or "at [43, 21]" in message


def test_half_of_the_chosen_elements_have_a_gradient():
    """A random choice of texels misses the few that a picture touches: only zeros are compared."""
    texels, index = np.ones((50, 50)), np.array([7, 8])
    order = []

    def touched(texels, index):
        order.append(texels)
        return texels[index, index]

    report = gradcheck(touched, lambda g, t, i: gather_backward(g, t, (i, i)), (texels, index))
    assert report.checked == sweeps.ELEMENTS + sweeps.DIRECTIONS
    assert any(there[7, 7] != 1 and (there != 1).sum() == 1 for there in order)


@pytest.mark.parametrize("inputs, sentence", [
    (np.ones(3), "inputs must be a tuple, such as (x,)"),
    ((3, "wrap"), "was given none"),
    ((np.array([1.0, np.inf]),), "all finite; it was given input 0 (x)")])
def test_inputs_that_cannot_be_differentiated_are_refused(inputs, sentence):
    """They end in a traceback from within, or pass because nothing is compared."""
    with pytest.raises(ValueError, match=re.escape(sentence)):
        gradcheck(lambda x, mode="": x, lambda g, x, mode="": g, inputs)


def test_an_exercise_that_is_not_started_says_so_itself():
    """Its NotImplementedError is hidden behind a mismatch."""
    def backward(g, a, b):
        raise NotImplementedError("exercise 1.10: transform_backward")

    with pytest.raises(NotImplementedError, match=r"exercise 1\.10"):
        gradcheck(product, backward, (A, B))


# --- decisions ----------------------------------------------------------------------------------


@pytest.mark.parametrize("decisions", [sign, lambda x: (np.zeros(3), sign(x))])
def test_an_element_on_a_kink_is_left_out_where_a_decision_changes(decisions):
    """The kink fails a right gradient, or is left out without being counted; or of several arrays
    of decisions only the first is compared.
    """
    report = gradcheck(np.abs, absolute_backward, (ON_A_KINK,), decisions=decisions)
    assert report[:2] == (11, 1 + sweeps.DIRECTIONS)  # each direction moves the element, too


# --- the message --------------------------------------------------------------------------------


def test_the_message_says_what_where_and_how_much():
    """A number is missing from the message, or is another element's."""
    x = np.arange(1.0, 7).reshape(2, 3)
    right = np.random.default_rng(5).standard_normal((2, 3)) * 2 * x
    wrong = right * [[1, 1, 1], [1, 1.5, 1]]
    message = failure(lambda image: image**2, lambda g, image: wrong, (x,), seed=5, name="square")
    assert message.splitlines() == [
        "square: wrong gradient (seed 5, 0 of 9 numbers left out)",
        "  with respect to input 0 (image): 1 of 6 looked at are off in [..., 1]",
        f"    at [1, 1]: analytic {wrong[1, 1]:.10g}, numeric {right[1, 1]:.10g}, "
        "relative error 0.33 (at most 1e-06)"]


# --- speed, repeatability -----------------------------------------------------------------------


def test_a_small_check_takes_few_calls_of_forward():
    """Every number is swept to the end although it has settled: rendered pictures take minutes."""
    calls = []

    def counted(a, b):
        calls.append(1)
        return a @ b

    report = gradcheck(counted, product_backward, (A, B))
    assert len(calls) <= 8 * report.checked


def test_the_same_seed_gives_the_same_report_and_another_seed_another():
    """Randomness that the seed does not govern: a failure cannot be repeated."""
    first, again, other = (gradcheck(product, product_backward, (A, B), seed=s) for s in (1, 1, 2))
    assert isinstance(first, GradReport) and first == again != other
