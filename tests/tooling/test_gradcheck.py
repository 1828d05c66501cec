"""The gradient checker: right gradients pass, wrong ones fail, and the failure says how."""
import re
import subprocess
import sys

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from PIL import Image

from course.given import gradcheck as module
from course.given import places, sweeps
from course.given.gradcheck import GradientMismatch, GradReport, gradcheck

DRAW = module.draw


@pytest.fixture(autouse=True)
def root(tmp_path, monkeypatch):
    """Failures that are provoked here do not write to out/, and most draw no picture at all."""
    monkeypatch.setattr(places, "ROOT", tmp_path)
    monkeypatch.setattr(module, "draw", lambda part, name, *_: tmp_path / f"{name}.png")
    return tmp_path


@pytest.fixture
def drawing(root, monkeypatch):
    """This test's failures are drawn."""
    monkeypatch.setattr(module, "draw", DRAW)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


# --- passes of which the gradient is known ------------------------------------------------------


def product(a, b):
    return a @ b


def product_backward(grad_output, a, b):
    return grad_output @ b.T, a.T @ grad_output


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
    grad_texels = np.zeros_like(texels)
    np.add.at(grad_texels, i, (1 - (u - i)) * grad_output)
    np.add.at(grad_texels, i + 1, (u - i) * grad_output)
    return grad_texels, (texels[i + 1] - texels[i]) * grad_output


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def unit_backward(grad_output, v):
    u = unit(v)
    along = np.sum(grad_output * u, axis=-1, keepdims=True)
    return (grad_output - u * along) / np.linalg.norm(v, axis=-1, keepdims=True)


def matrices(rng, rows=3, inner=4, columns=3):
    return rng.normal(size=(rows, inner)), rng.normal(size=(inner, columns))


def failure(*args, **kwargs):
    """The message with which gradcheck fails."""
    with pytest.raises(GradientMismatch) as caught:
        gradcheck(*args, **kwargs)
    return str(caught.value)


# --- right gradients ----------------------------------------------------------------------------


def test_the_gradients_of_a_matrix_product_pass(rng):
    """The checker fails what is right, or counts wrongly what it looked at."""
    report = gradcheck(product, product_backward, matrices(rng))
    assert report[:2] == (12 + 12 + 3 * 3, 0)  # two inputs' elements; 3 directions each, 3 of both
    assert 0 < report.worst_error < 1e-9


def test_the_gradients_of_a_quotient_pass(rng):
    """The steps are too large for a quotient with a small denominator."""
    a, b = rng.normal(size=(2, 5, 3))
    b = np.sign(b) * (0.01 + np.abs(b))
    assert gradcheck(lambda a, b: a / b, lambda g, a, b: (g / b, -g * a / b**2), (a, b)).checked


def test_the_gradient_of_a_gather_passes_and_its_indices_are_left_alone(rng):
    """Integer inputs are differentiated, or a single gradient must be wrapped in a tuple."""
    inputs = rng.normal(size=(4, 3)), np.array([0, 2, 2, 3, 0])
    assert gradcheck(gather, gather_backward, inputs).checked == 12 + 3


def test_several_outputs_bring_one_upstream_gradient_each(rng):
    """Only the first output enters the loss, or all share one upstream gradient."""
    def backward(grad_sine, grad_square, x):
        assert grad_sine.shape == grad_square.shape and not np.allclose(grad_sine, grad_square)
        return grad_sine * np.cos(x) + 2 * x * grad_square

    x = rng.normal(size=5)
    assert gradcheck(lambda x: (np.sin(x), x**2), backward, (x,)).checked
    assert "off" in failure(lambda x: (np.sin(x), x**2), lambda g, h, x: g * np.cos(x), (x,))


def test_floats_and_chosen_inputs_are_differentiated():
    """A bare float is not seen as an input, or differentiable= is ignored."""
    def power(x, exponent):
        return x**exponent

    report = gradcheck(power, lambda g, x, n: g * n * x ** (n - 1), (2.0, 3.0), differentiable=[0])
    assert report.checked == 1 + 3


def test_single_precision_inputs_are_checked_in_double(rng):
    """The differences are taken in float32, where every gradient looks wrong."""
    a, b = matrices(rng)
    assert gradcheck(product, product_backward, (a.astype(np.float32), b)).worst_error < 1e-9


def test_the_callers_inputs_stay_untouched(rng):
    """The steps, or a backward pass that works in place, change the caller's own arrays."""
    def backward(g, values, index):
        index[...] = values[...] = 0

    values, index = rng.normal(size=4), np.array([3, 1, 2])
    kept = values.copy()
    gradcheck(gather, gather_backward, (values, index))
    assert "changed its argument" in failure(gather, backward, (values, index))
    assert np.array_equal(values, kept) and np.array_equal(index, [3, 1, 2])


def test_a_forward_that_reuses_its_output_array_passes(rng):
    """The outputs ahead and behind are one array, so that all differences are zero."""
    out = np.empty(5)
    assert gradcheck(lambda x: np.sin(x, out=out), lambda g, x: g * np.cos(x),
                     (rng.normal(size=5),)).checked


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


def test_an_element_that_is_zero_moves_as_far_as_its_neighbours():
    """It has no size of its own, and a step of size 1 is too large beside elements of 1e-6."""
    x = np.array([0.0, 1e-6, -2e-6])
    assert gradcheck(lambda x: np.sin(1e6 * x), lambda g, x: 1e6 * g * np.cos(1e6 * x),
                     (x,)).worst_error < 1e-9


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


def test_the_numeric_derivative_is_true_where_the_output_dwarfs_its_change(rng):
    """The outputs are summed before they are subtracted, and their rounding drowns the change."""
    x = rng.normal(size=4)
    assert gradcheck(lambda x: np.append(np.full(999, 1e9), x), lambda g, x: g[999:],
                     (x,)).worst_error < 1e-12


def test_the_step_is_chosen_without_the_analytic_gradient(rng):
    """The step that comes nearest to the analytic gradient is taken, so an error of 1e-5 passes."""
    x = rng.normal(size=6)
    assert "1.00001 times" in failure(np.sin, lambda g, x: 1.00001 * g * np.cos(x), (x,))


def test_an_element_near_zero_is_judged_by_what_float64_can_resolve():
    """Rounding fails a right gradient, or the floor is so high that it hides a wrong one."""
    x, weights = np.ones(3), np.array([1.0, 1e-7, 1e-13])
    def blurred(x):
        return np.array([weights @ x + 1e3])

    assert gradcheck(blurred, lambda g, x: g * weights, (x,)).checked
    assert "[1]" in failure(blurred, lambda g, x: g * weights * [1, 1.1, 1], (x,))


def random_case(seed):
    """(forward, backward, inputs, decisions) of a right gradient, of any size and magnitude."""
    rng = np.random.default_rng(seed)
    size = 10 ** rng.uniform(-3, 3)
    m, n, k = rng.integers(1, 5, 3)
    a = size * rng.normal(size=(m, n))
    b = size * rng.choice([-1, 1], (m, n)) * rng.uniform(0.05, 2, (m, n))
    return [
        (product, product_backward, (a, rng.normal(size=(n, k))), None),
        (lambda a, b: a / b, lambda g, a, b: (g / b, -g * a / b**2), (a, b), None),
        (gather, gather_backward, (a, rng.integers(0, m, 7)), None),
        (lambda x, s: np.exp(x / s),
         lambda g, x, s: (g * np.exp(x / s) / s, -np.sum(g * np.exp(x / s) * x) / s**2),
         (a, float(size)), None),
        (linear, linear_backward, (size * rng.normal(size=6), rng.uniform(0, 4.99, 5)),
         lambda texels, u: texel(u)),
        (unit, unit_backward, (size * rng.normal(size=(m, 3)),), None),
    ][seed % 6]


def false_alarms(seeds):
    alarms = []
    for seed in seeds:
        forward, backward, inputs, decisions = random_case(seed)
        try:
            gradcheck(forward, backward, inputs, seed=seed, decisions=decisions)
        except GradientMismatch as alarm:
            alarms.append(alarm)
    return alarms


def test_no_right_gradient_of_a_hundred_is_called_wrong():
    """False alarms. (`python -m tests.project.test_gradcheck 1000` tries more.)"""
    assert false_alarms(range(100)) == []


# --- wrong gradients ----------------------------------------------------------------------------


@pytest.mark.parametrize("wrong, told", [
    (lambda g, a, b: (-g @ b.T, a.T @ g), r"input 0 \(a\): 9 of 9 .* off; the sign is flipped"),
    (lambda g, a, b: (g @ b.T, 2 * a.T @ g), r"input 1 \(b\): 9 of 9 .* everything is 2 times"),
    (lambda g, a, b: (g @ b.T, g.T @ a), r"input 1 \(b\): 6 of 9 .* rows and columns are swapped"),
    (lambda g, a, b: ((g @ b.T)[::-1], a.T @ g), r"input 0 .* order along axis 0 is reversed"),
    (lambda g, a, b: (g @ b.T, 0 * b), r"input 1 \(b\): 9 of 9 .* it is zero everywhere"),
    (lambda g, a, b: (g @ b.T / 3, a.T @ g), r"input 0 .* everything is 0.333333 times"),
    (lambda g, a, b: (g @ b.T, a.T @ g * (np.arange(3) < 2)),
     r"input 1 \(b\): 3 of 9 .* off; it may be that it is zero in \[..., 2\]$"),
], ids=["sign", "factor", "transpose", "reversed", "zero", "mean for sum", "forgotten column"])
def test_a_wrong_gradient_of_the_product_fails_and_its_mistake_is_named(rng, wrong, told):
    """The mistake passes, or the message blames another input or another mistake."""
    message = failure(product, wrong, matrices(rng, 3, 3, 3))
    assert re.search(told, message, re.MULTILINE), message
    assert message.count("with respect to input") == 1


def test_the_sum_for_the_mean_fails(rng):
    """A factor common to all elements passes, because only the gradient's direction is compared."""
    message = failure(lambda x: x.mean(axis=0), lambda g, x: np.broadcast_to(g, x.shape),
                      (rng.normal(size=(5, 3)),))
    assert "everything is 5 times what was expected" in message


def test_a_forgotten_term_fails_and_no_pattern_is_made_up(rng):
    """d(x^2 y)/dx without its factor 2 in one summand; a hint is guessed where none is sure."""
    def backward(g, x, y):
        return g * (x * y + np.cos(x)), g * x**2

    message = failure(lambda x, y: x**2 * y + np.sin(x), backward, tuple(rng.normal(size=(2, 6))))
    assert re.search(r"to input 0 \(x\): 6 of 6 looked at are off$", message, re.MULTILINE)


@pytest.mark.parametrize("forward, x", [(np.square, 3.0), (np.floor, np.array([0.4, 0.7]))])
def test_no_factor_is_told_of_one_number_or_of_zeros(recwarn, forward, x):
    """Any two numbers have a ratio; that of zeros warns and is no number."""
    message = failure(forward, lambda g, x: g * x, (x,))
    assert "times" not in message and "sign" not in message and not recwarn.list


def test_last_write_wins_for_add_at_fails(rng):
    """A scatter that forgets repeated indices."""
    def backward(g, values, index):
        grad_values = np.zeros_like(values)
        grad_values[index] += g
        return grad_values

    assert "[2" in failure(gather, backward, (rng.normal(size=4), np.array([0, 2, 2, 3])))


def test_a_backward_that_averages_its_grad_output_fails(rng):
    """All ones upstream cannot tell grad_output from its mean; the random upstream gradient can."""
    def backward(grad_output, x):
        return grad_output.mean() * np.cos(x)

    def all_ones(x):  # its gradient is that of sin with all ones upstream
        return np.sin(x).sum()

    x = rng.normal(size=(2, 3))
    assert gradcheck(all_ones, lambda g, x: backward(g * np.ones_like(x), x), (x,)).checked
    assert "6 of 6" in failure(np.sin, backward, (x,))


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


# --- gradients that cannot be compared ----------------------------------------------------------


def test_a_gradient_of_zeros_fails_even_where_it_is_right(rng):
    """A check passes that no mistake could fail."""
    message = failure(lambda x, y: np.floor(x) + y, lambda g, x, y: (0 * g, g),
                      tuple(rng.uniform(0.1, 0.9, (2, 4))))
    assert "nothing to check" in message and "input 0 (x) is zero everywhere" in message


def test_an_empty_input_fails():
    """Nothing was looked at, and the check passes."""
    assert "nothing to check" in failure(np.sin, lambda g, x: g * np.cos(x), (np.zeros((0, 3)),))


@pytest.mark.parametrize("wrong, sentence", [
    (lambda g, a, b: (g @ b.T, (a.T @ g)[:2]),
     "the gradient with respect to input 1 (b) must have that input's shape (4, 3); it has (2, 3)"),
    (lambda g, a, b: (g @ b.T, a.T @ g, g),
     "backward must return 2 gradients, with respect to input 0 (a), input 1 (b); it returned 3"),
    (lambda g, a, b: g @ b.T,
     "backward must return 2 gradients, with respect to input 0 (a), input 1 (b); it returned 1"),
    (lambda g, a, b: (g @ b.T, np.nan * b), "backward returned NaN or infinity"),
    (lambda g, a, b: (g @ b.T, None), "backward returned NaN or infinity"),
    (lambda g, a, b: None, "backward returned None; is its return statement missing?"),
    (lambda g, a, b: ("a", "b"), "backward must return an array of numbers"),
    (lambda g, a, b: (a.__imul__(2), b), "backward changed its argument 1"),
    (lambda g, a, b: (g.__imul__(2) @ b.T, b), "backward changed its argument 0"),
], ids=["shape", "too many", "too few", "NaN", "None in a tuple", "None", "text",
        "changes an input", "changes grad_output"])
def test_what_is_no_gradient_fails_with_its_own_sentence(rng, wrong, sentence):
    """Broadcasting hides a wrong shape; NaN compares as not larger; a changed input goes unseen."""
    message = failure(product, wrong, matrices(rng), name="product")
    assert message.startswith("product: ") and sentence in message


@pytest.mark.parametrize("wrong, sentence", [
    (lambda x: x.__imul__(2), "forward changed its argument 0: let it work on a copy"),
    (lambda x: x / 0, "forward returned NaN or infinity")], ids=["changes its input", "not finite"])
@pytest.mark.filterwarnings("ignore:divide by zero")
def test_a_forward_that_cannot_be_checked_fails_with_its_own_sentence(wrong, sentence):
    """The forward pass is trusted."""
    assert sentence in failure(wrong, lambda g, x: g, (np.ones(3),))


@pytest.mark.parametrize("inputs, sentence", [
    (np.ones(3), "inputs must be a tuple, such as (x,)"),
    ((3, "wrap"), "was given none"),
    ((np.array([1.0, np.inf]),), "all finite; it was given input 0 (x)")])
def test_inputs_that_cannot_be_differentiated_are_refused(inputs, sentence):
    """They end in a traceback from within, or pass because nothing is compared."""
    with pytest.raises(ValueError, match=re.escape(sentence)):
        gradcheck(lambda x, mode="": x, lambda g, x, mode="": g, inputs)


def test_an_exercise_that_is_not_started_says_so_itself(rng):
    """Its NotImplementedError is hidden behind a mismatch."""
    def backward(g, a, b):
        raise NotImplementedError("exercise 1.3: transform_backward")

    with pytest.raises(NotImplementedError, match=r"exercise 1\.3"):
        gradcheck(product, backward, matrices(rng))


# --- decisions ----------------------------------------------------------------------------------


def sign(x):
    return x > 0


def absolute_backward(g, x):
    return g * np.where(x > 0, 1.0, -1.0)


def test_a_kink_within_the_first_steps_does_no_harm():
    """The largest step is taken although it reaches across the kink."""
    x = np.array([1e-3, -1e-4, 1e-5, 1.0])
    assert gradcheck(np.abs, absolute_backward, (x,)).left_out == 0
    assert gradcheck(np.abs, absolute_backward, (x,), decisions=sign).left_out == 0


def test_an_element_on_a_kink_fails_without_decisions_and_is_left_out_with_them():
    """The kink fails a right gradient, or is left out without being counted."""
    x = np.append(np.linspace(0.1, 1, 11), 0.0)
    assert "at [11]" in failure(np.abs, absolute_backward, (x,))
    report = gradcheck(np.abs, absolute_backward, (x,), decisions=sign)
    assert report[:2] == (11, 1 + sweeps.DIRECTIONS)  # each direction moves the element, too


def test_a_wrong_element_fails_beside_one_that_is_left_out():
    """What is left out takes its neighbours with it."""
    x = np.append(np.linspace(0.1, 1, 11), 0.0)
    message = failure(np.abs, lambda g, x: absolute_backward(g, x) * (1 + (x == 1)), (x,),
                      decisions=sign)
    assert "at [10]" in message and "4 of 15 numbers left out" in message


def test_more_than_a_tenth_left_out_fails():
    """A check passes that looked at next to nothing."""
    x = np.append(np.linspace(0.1, 1, 11), [0.0, 0.0])
    message = failure(np.abs, absolute_backward, (x,), decisions=sign)
    assert "2 of 13 elements of input 0" in message and "edges and ties" in message


def test_a_small_input_that_is_left_out_fails_beside_a_large_one(rng):
    """The share is taken of all elements, so that four vertices hide among sixty colours."""
    u, texels = np.arange(4.0), rng.normal(size=60)
    message = failure(linear, linear_backward, (texels, u), decisions=lambda texels, u: texel(u))
    assert "4 of 4 elements of input 1 (u)" in message


def test_several_arrays_of_decisions_are_all_held(rng):
    """Only the first array of decisions is compared."""
    x = np.append(np.linspace(0.1, 1, 11), 0.0)
    assert gradcheck(np.abs, absolute_backward, (x,),
                     decisions=lambda x: (np.zeros(3), x > 0)).left_out == 4


def test_steps_out_of_the_domain_are_not_used(recwarn):
    """NaN beyond the domain spoils the sweep, or warns."""
    x = np.array([1e-3, 1.0, 1.0])
    assert gradcheck(np.sqrt, lambda g, x: g / (2 * np.sqrt(x)), (x,)).left_out == 0
    assert not recwarn.list


def test_a_jump_is_recognised():
    """The student looks for a mistake in the backward pass, while forward jumps at this input."""
    message = failure(lambda x: x + (x > 0.5), lambda g, x: g, (np.array([0.5, 0.3]),))
    assert "at [0]" in message and "no two steps agree" in message


# --- the message and the picture ----------------------------------------------------------------


def test_the_message_says_what_where_and_how_much():
    """A number is missing from the message, or is another element's."""
    x = np.arange(1.0, 7).reshape(2, 3)
    right = np.random.default_rng(5).standard_normal((2, 3)) * 2 * x
    wrong = right * [[1, 1, 1], [1, 1.5, 1]]
    message = failure(lambda image: image**2, lambda g, image: wrong, (x,), seed=5, name="square")
    assert message.splitlines() == [
        "square: wrong gradient (seed 5, 0 of 9 numbers left out)",
        "  with respect to input 0 (image): 1 of 6 looked at are off",
        f"    at [1, 1]: analytic {wrong[1, 1]:.10g}, numeric {right[1, 1]:.10g}, "
        "relative error 0.33 (at most 1e-06)",
        "  picture: square.png"]


def test_inputs_without_names_are_told_by_position(rng):
    """A forward pass that takes *inputs cannot be checked, or is given a wrong name."""
    message = failure(lambda *inputs: product(*inputs), lambda g, a, b: (g @ b.T, -a.T @ g),
                      matrices(rng))
    assert "with respect to input 1: " in message


@pytest.mark.parametrize("shape", [(), (5,), (4, 3), (4, 5, 3), (30, 40)], ids=str)
def test_a_failure_of_any_shape_is_drawn(drawing, root, rng, shape):
    """The picture cannot show this shape, is not written, or is left half written."""
    with pytest.raises(GradientMismatch) as caught:
        gradcheck(np.sin, lambda g, x: g * (np.cos(x) + x), (rng.uniform(1, 2, shape),),
                  name="sine")
    [picture] = (root / "out" / "checks").iterdir()
    assert caught.value.picture == str(picture)
    assert str(caught.value).endswith(f"picture: out/checks/{picture.name}")
    with Image.open(caught.value.picture) as picture:
        assert picture.size == (1600, 380) and len(np.unique(np.asarray(picture))) > 50


def test_the_first_row_is_drawn_at_the_bottom(drawing, root, rng):
    """The picture of a gradient stands on its head beside all other pictures of the course."""
    failure(np.sin, lambda g, x: g * np.cos(x) * np.array([[2], [1], [1]]),
            (rng.normal(size=(3, 4)),), name="sine")
    with Image.open(next((root / "out" / "checks").iterdir())) as picture:
        pixels = np.asarray(picture)[:, 940:1200, :3].astype(int)  # the panel of what is off
    rows = np.flatnonzero((pixels @ [1, -1, -1] > 50).any(axis=1))
    assert rows.size and rows.min() > 200


def test_a_folder_that_cannot_be_written_does_not_hide_the_mismatch(drawing, root, rng):
    """The failure to write the picture is all that the student sees."""
    (root / "out").write_text("a file where the folder should be")
    with pytest.raises(GradientMismatch, match="the sign is flipped") as caught:
        gradcheck(np.sin, lambda g, x: -g * np.cos(x), (rng.normal(size=3),))
    assert "no picture: " in str(caught.value) and caught.value.picture is None


def test_drawing_leaves_matplotlib_as_it_was(drawing, rng):
    """A failed check in a notebook changes how its figures are shown, or adds one to them."""
    before = dict(mpl.rcParams), plt.get_fignums()
    failure(np.sin, lambda g, x: -g * np.cos(x), (rng.normal(size=3),))
    assert (dict(mpl.rcParams), plt.get_fignums()) == before


# --- speed, repeatability -----------------------------------------------------------------------


def test_a_check_that_passes_imports_no_matplotlib():
    """Every check of every lab waits for matplotlib."""
    code = ("import sys, numpy as np; from course.given.gradcheck import gradcheck; "
            "gradcheck(np.sin, lambda g, x: g * np.cos(x), (np.ones(3),)); "
            "sys.exit('matplotlib' in sys.modules)")
    folder = module.__file__.rpartition("course")[0]
    assert subprocess.run([sys.executable, "-c", code], cwd=folder, check=False).returncode == 0


def test_a_small_check_takes_few_calls_of_forward(rng):
    """Every number is swept to the end although it has settled: rendered pictures take minutes."""
    calls = []

    def counted(a, b):
        calls.append(1)
        return a @ b

    report = gradcheck(counted, product_backward, matrices(rng))
    assert len(calls) <= 8 * report.checked


def test_a_large_input_is_looked_at_in_part(rng):
    """All elements of a texture are differenced, one by one."""
    report = gradcheck(np.sin, lambda g, x: g * np.cos(x), (rng.normal(size=(32, 32, 3)),))
    assert report.checked == sweeps.ELEMENTS + sweeps.DIRECTIONS
    assert "60 of 60 looked at" in failure(np.sin, lambda g, x: g * x, (rng.normal(size=(9, 9)),))


def test_the_same_seed_gives_the_same_report_and_another_seed_another(rng):
    """Randomness that the seed does not govern: a failure cannot be repeated."""
    inputs = matrices(rng)
    first, again, other = (gradcheck(product, product_backward, inputs, seed=s) for s in (1, 1, 2))
    assert isinstance(first, GradReport) and first == again != other


if __name__ == "__main__":
    print(len(false_alarms(range(int(sys.argv[1])))), "false alarms")
