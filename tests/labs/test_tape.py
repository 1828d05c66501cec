"""What the extras of lab 9 that build a tape must do."""
import numpy as np
import pytest

from labkit.checks import assert_close, exercise


def summed_by_hand(grad, shape):
    """Place by place: where did each number of the result come from?"""
    found = np.zeros(shape)
    for place in np.ndindex(grad.shape):
        at = place[grad.ndim - len(shape):]
        found[tuple(k * (size > 1) for k, size in zip(at, shape, strict=True))] += grad[place]
    return found


# --- summed_to ---------------------------------------------------------------------------------

@exercise("9.12")
@pytest.mark.parametrize(("copied", "shape"), [((3, 4), (4,)), ((2, 3, 4), (4,)), ((3, 4), ())])
def test_what_lacks_axes_gets_the_sum_over_them(impl, rng, copied, shape):
    """Axes are counted from the wrong end, or one is summed where there are two."""
    grad = rng.normal(size=copied)
    assert_close(impl.summed_to(grad, shape), summed_by_hand(grad, shape))


@exercise("9.12")
@pytest.mark.parametrize(("copied", "shape"), [((2, 3, 4), (1, 3, 1)), ((2, 3, 4), (3, 1))])
def test_an_axis_of_size_1_stays_and_gets_the_sum(impl, rng, copied, shape):
    """The axis is lost; only the first such axis is summed; an axis that is lacking shifts it."""
    grad = rng.normal(size=copied)
    assert_close(impl.summed_to(grad, shape), summed_by_hand(grad, shape))


# --- multiply_backward -------------------------------------------------------------------------

@exercise("9.13")
@pytest.mark.parametrize("shapes", [((3, 4), (4,)), ((3, 1), (3, 4)), ((), (2, 3)), ((2,), (2,))])
def test_products_of_arrays_have_their_central_differences(impl, gradcheck, rng, shapes):
    """A gradient has the shape of the product, and not of its factor."""
    gradcheck(np.multiply, impl.multiply_backward, tuple(rng.normal(size=s) for s in shapes),
              name="multiply")


# --- matmul_backward, take_backward ------------------------------------------------------------

@exercise("9.14")
def test_a_product_of_matrices_on_paper(impl):
    """A transpose is missing, or the factors are swapped."""
    a, b = np.array([[2.0, 3.0]]), np.array([[5.0, 1.0], [7.0, 4.0]])
    grads = impl.matmul_backward(np.array([[10.0, 100.0]]), a, b)
    assert_close(grads, (np.array([[150.0, 470.0]]), np.array([[20.0, 200.0], [30.0, 300.0]])))


@exercise("9.14")
@pytest.mark.parametrize("shapes", [((2, 3), (3, 4)), ((2, 3), (3,))])
def test_products_of_matrices_have_their_central_differences(impl, gradcheck, rng, shapes):
    """Right for matrices alone: a vector has no transpose."""
    gradcheck(np.matmul, impl.matmul_backward, tuple(rng.normal(size=s) for s in shapes),
              name="matmul")


@exercise("9.15")
def test_what_is_taken_twice_gets_both(impl, rng):
    """grad_a[index] += grad: of equal indices the last one counts."""
    grad, index = rng.normal(size=(9, 2)), rng.integers(0, 4, 9)
    expected = np.array([grad[index == k].sum(0) for k in range(5)])
    assert_close(impl.take_backward(grad, np.ones((5, 2)), index), expected)


# --- replay ------------------------------------------------------------------------------------

@exercise("9.16")
def test_steps_are_done_in_their_order(impl):
    """Arguments are swapped, or are what they were when the tape was made."""
    steps = None, None, impl.Step("power", (0, 1)), impl.Step("multiply", (2, 0))
    assert_close(impl.replay(steps, (2.0, 3.0, 1.0, 1.0)), (2.0, 3.0, 8.0, 16.0))


@exercise("9.16")
def test_labs_are_played_like_products(impl, rng):
    """Only numbers are allowed for."""
    points, matrix = rng.normal(size=(3, 4)), rng.normal(size=(4, 4))
    found = impl.replay((None, None, impl.Step("transform", (0, 1))), (points, matrix, None))
    assert_close(found[2], points @ matrix.T)


# --- backward ----------------------------------------------------------------------------------

@exercise("9.17")
def test_a_value_that_is_used_twice_gets_both(impl):
    """y = x x: the second use replaces what came from the first. Or where a number of a gradient
    is 0, the others go no further.
    """
    values = np.array([3.0, 5.0]), np.array([9.0, 25.0])
    grads = impl.backward((None, impl.Step("multiply", (0, 0))), values, np.array([0.0, 1.0]))
    assert_close(grads, (np.array([0.0, 10.0]), np.array([0.0, 1.0])))


@exercise("9.17")
def test_what_comes_along_several_ways_is_summed(impl):
    """u = x x, y = u u + u: u goes on before all of its own gradient has come. At 2, y' is 36."""
    square = "multiply", "multiply", "add"
    steps = None, *map(impl.Step, square, ((0, 0), (1, 1), (2, 1)))
    for _ in range(2):  # a second time it is the same, not twice as much
        assert_close(impl.backward(steps, (2.0, 4.0, 16.0, 20.0)), (36.0, 9.0, 1.0, 1.0))


@exercise("9.17")
def test_what_the_result_is_not_made_of_gets_nothing(impl):
    """A step off the way is taken for one on it: its pair is given 0.0 for a matrix."""
    steps = None, None, impl.Step("matmul", (0, 0)), impl.Step("power", (1, 1))
    grads = impl.backward(steps, (np.eye(2), 3.0, np.eye(2), 27.0), 5.0)
    assert_close(grads, (0.0, 135.0, 0.0, 5.0))


@exercise("9.17")
def test_a_chain_of_4000_steps_has_an_end(impl):
    """It calls itself: Python allows for about a thousand calls within each other."""
    steps = None, None, *(impl.Step("multiply", (place, 1)) for place in (0, *range(2, 4001)))
    grads = impl.backward(steps, (2.0, 1.0, *[2.0] * 4000))
    assert_close((grads[0], grads[1]), (1.0, 8000.0))


@exercise("9.17")
def test_arrays_have_the_gradients_of_their_sums(impl, gradcheck, rng):
    """grad is taken for ones; the second gradient of a pair goes to the first argument."""
    steps = None, None, None, impl.Step("matmul", (0, 1)), impl.Step("multiply", (3, 2))
    gradcheck(lambda a, b, c: (a @ b) * c,
              lambda grad, a, b, c: impl.backward(steps, (a, b, c, a @ b, None), grad)[:3],
              tuple(rng.normal(size=shape) for shape in ((2, 3), (3, 4), (4,))), name="backward")


@exercise("9.17")
def test_a_gradient_goes_to_the_argument_that_wrt_names(impl):
    """The gradients are taken for those of the first arguments: here face_index comes first."""
    steps = None, None, None, impl.Step("barycentrics", (0, 1, 2))
    clip = np.array([[-1.0, -1.0, 0.0, 1.0], [3.0, -1.0, 0.0, 1.0], [-1.0, 3.0, 0.0, 1.0]])
    values = np.zeros((1, 1), int), clip, np.array([[0, 1, 2]]), None
    grads = impl.backward(steps, values, np.ones((1, 1, 3)) * [1.0, 2.0, 3.0])
    assert_close((grads[0], grads[2], np.shape(grads[1])), (0.0, 0.0, (3, 4)))
