"""What the exercises of lab 7 must do."""
import numpy as np
import pytest

from course.checks import assert_close, assert_equal, exercise
from course.given.gradcheck import gradcheck

# A triangle for paper: c = (1 - x/4 - y/2, x/4, y/2).
PAPER = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
A = np.array([1.0, 1.0, 1.0])
VALUES = np.array([8.0, 0.0, 4.0])  # f = 8 - 2 x - 2 y, less the target

# In perspective, vertex 1 with w = 1/2: c = (1 - x/4 - y/2, x/2, y/2).
NEAR = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])

# Clip positions x, y, w in columns; each makes one of the mistakes visible.
MATRICES = {
    "w differs": np.array([[-0.7, 2.1, 0.4], [-0.5, 0.3, 1.9], [1.0, 2.5, 1.6]]),
    "clockwise": np.array([[2.1, -0.7, 0.4], [0.3, -0.5, 1.9], [2.5, 1.0, 1.6]]),
    "a vertex behind the camera": np.array([[0.9, -1.6, 0.2], [0.4, 0.3, -1.1], [1.4, 2.0, -0.6]]),
    "all behind": np.array([[0.9, -1.6, 0.2], [0.4, 0.3, -1.1], [-1.4, -2.0, -0.6]]),
}
each_matrix = pytest.mark.parametrize("m", MATRICES.values(), ids=MATRICES)
PIXEL = np.array([0.25, -0.375, 1.0])


def cramer(m, a):
    """c = m^-1 a, each element a quotient of determinants."""
    replaced = [np.where(np.arange(3) == k, a[:, None], m) for k in range(3)]
    return np.array([np.linalg.det(matrix) for matrix in replaced]) / np.linalg.det(m)


def brightness(values, m, a, target):
    return values @ cramer(m, a) - target


def shares(m, a):
    c = cramer(m, a)
    return c / c.sum()


# --- the matrix formula ------------------------------------------------------------------------

@exercise("7.1")
def test_vertices_are_columns(impl):
    """The vertices stand in rows, or the ones are missing."""
    triangle = np.array([[5.0, 6.0], [7.0, 8.0], [9.0, 10.0]])
    expected = np.array([[5.0, 7.0, 9.0], [6.0, 8.0, 10.0], [1.0, 1.0, 1.0]])
    assert_equal(impl.vertex_matrix(triangle), expected)


@exercise("7.1")
def test_the_determinant_is_twice_the_area(impl):
    """Two columns are swapped: the determinant of a counter-clockwise triangle is positive."""
    triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]])
    assert_close(np.linalg.det(impl.vertex_matrix(triangle)), 8.0)


@exercise("7.2")
def test_residuals_on_paper(impl):
    """The target is added, or the weights go to the wrong vertices."""
    for x, y, target in (1.0, 1.0, 3.0), (0.0, 0.0, 0.0), (4.0, 0.0, -1.0), (3.0, 0.5, 0.25):
        got = impl.residual(VALUES, PAPER, np.array([x, y, 1.0]), target)
        assert_close(got, 8 - 2 * x - 2 * y - target)


@exercise("7.2")
@each_matrix
def test_residuals_are_cramers(impl, m, rng):
    """M is transposed, or its last row is taken for ones."""
    values, a = rng.normal(size=3), rng.normal(size=3)
    assert_close(impl.residual(values, m, a, 0.7), brightness(values, m, a, 0.7))


@exercise("7.3")
def test_a_stretched_axis_on_paper(impl):
    """The sign: an inverse shrinks as the matrix grows; or a factor M^-1 is missing."""
    got = impl.inverse_differential(np.diag([1.0, 2.0, 4.0]), np.diag([3.0, 1.0, 8.0]))
    assert_close(got, np.diag([-3.0, -0.25, -0.5]))


@exercise("7.3")
def test_one_element_off_the_diagonal(impl):
    """The two inverses are on the same side, or dm is transposed."""
    dm = np.zeros((3, 3))
    dm[0, 1] = 3.0
    assert_close(impl.inverse_differential(np.diag([1.0, 2.0, 4.0]), dm), -dm / 2)
    dm[2, 0] = 8.0
    expected = np.array([[0.0, -1.5, 0.0], [0.0, 0.0, 0.0], [-2.0, 0.0, 0.0]])
    assert_close(impl.inverse_differential(np.diag([1.0, 2.0, 4.0]), dm), expected)


@exercise("7.3")
@each_matrix
def test_the_product_with_m_stays_one(impl, m, rng):
    """d(M^-1) M + M^-1 dM = 0 fails where M and dM do not commute."""
    dm = rng.normal(size=(3, 3))
    got = impl.inverse_differential(m, dm)
    assert_close(got @ m, np.linalg.solve(m, -dm), atol=1e-10)


@exercise("7.4")
def test_nine_slopes_on_paper(impl):
    """i and j are swapped, or the sign: moving a vertex right brings colour from its left."""
    a = np.array([2.0, 0.5, 1.0])  # c = (1, 2, 1) / 4, and df/da = (-2, -2, 8)
    got = [[impl.residual_slope(VALUES, PAPER, a, i, j) for j in range(3)] for i in range(3)]
    assert_close(np.array(got), np.array([[0.5, 1.0, 0.5], [0.5, 1.0, 0.5], [-2.0, -4.0, -2.0]]))


@exercise("7.4")
@each_matrix
def test_slopes_are_central_differences(impl, m, rng):
    """Right for the paper's triangle alone, whose last row is ones."""
    values = rng.normal(size=3)

    def backward(grad, m):
        return grad * np.array([[impl.residual_slope(values, m, PIXEL, i, j) for j in range(3)]
                                for i in range(3)])

    gradcheck(lambda m: brightness(values, m, PIXEL, 0.0), backward, (m,), name="residual_slope")


@exercise("7.5")
def test_the_gradients_on_paper(impl):
    """The matrix is transposed, or the sign is that of the picture's slope."""
    got = impl.residual_backward(1.0, VALUES, PAPER, A, 3.0)
    expected = (np.array([0.25, 0.25, 0.5]),
                np.array([[0.5, 0.5, 1.0], [0.5, 0.5, 1.0], [-2.0, -2.0, -4.0]]),
                np.array([-2.0, -2.0, 8.0]), -1.0)
    assert_close(got, expected)


@exercise("7.5")
def test_every_gradient_is_as_large_as_grad_f(impl):
    """grad_f is left out of one of the four, or counted twice."""
    got = impl.residual_backward(-3.0, VALUES, PAPER, A, 3.0)
    once = np.array([[0.5, 0.5, 1.0], [0.5, 0.5, 1.0], [-2.0, -2.0, -4.0]])
    expected = np.array([-0.75, -0.75, -1.5]), -3 * once, np.array([6.0, 6.0, -24.0]), 3.0
    assert_close(got, expected)


@exercise("7.5")
@each_matrix
def test_the_gradients_of_a_residual_are_central_differences(impl, m, rng):
    """Right for the paper's triangle alone."""
    gradcheck(brightness, impl.residual_backward, (rng.normal(size=3), m, PIXEL, 0.3),
              name="residual")


# --- Gauss and Newton --------------------------------------------------------------------------

@exercise("7.6")
def test_two_points_on_paper(impl):
    """x and y or vertices and points are swapped, or slope and sign."""
    triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]])
    by_values, by_triangle = impl.residuals_jacobian(np.array([8.0, 0.0, 6.0]), triangle,
                                                     np.array([[1.0, 1.0], [2.0, 0.5]]))
    weights = np.array([[0.25, 0.25, 0.5], [0.25, 0.5, 0.25]])
    assert_close(by_values, weights)
    # f = 8 - 2 x - y: a vertex that moves by its weight w brings +2 w along x and + w along y.
    assert_close(by_triangle, weights[:, :, None] * np.array([2.0, 1.0]))


@exercise("7.6")
@pytest.mark.parametrize("winding", [1, -1])
def test_the_jacobian_is_central_differences(impl, rng, winding):
    """Right for a right angle at the origin alone, or for counter-clockwise triangles."""
    triangle = np.array([[1.2, 0.7], [6.3, 2.1], [2.9, 5.8]])[::winding].copy()
    points = rng.uniform(0, 7, (5, 2))

    def forward(values, triangle):
        m = np.stack([*triangle.T, np.ones(3)])
        return np.array([brightness(values, m, np.array([*p, 1.0]), 0.0) for p in points])

    def backward(grad, values, triangle):
        by_values, by_triangle = impl.residuals_jacobian(values, triangle, points)
        return np.einsum("p,pk->k", grad, by_values), np.einsum("p,pki->ki", grad, by_triangle)

    gradcheck(forward, backward, (rng.normal(size=3), triangle), name="residuals")


@exercise("7.7")
def test_linear_residuals_vanish_in_one_step(impl):
    """The sign: the step goes uphill."""
    jacobian = np.array([[2.0, 0.0], [1.0, 1.0]])
    assert_close(impl.gauss_newton_step(np.array([4.0, 5.0]), jacobian), np.array([-2.0, -3.0]))


@exercise("7.7")
def test_with_too_many_residuals_the_squares_are_least(impl):
    """Only as many residuals as unknowns are looked at."""
    got = impl.gauss_newton_step(np.array([1.0, 2.0, 6.0]), np.ones((3, 1)))
    assert_close(got, np.array([-3.0]))
    jacobian = np.array([[1.0, 0.0], [0.0, 2.0], [1.0, 1.0], [0.0, 1.0]])
    got = impl.gauss_newton_step(np.array([1.0, 2.0, 3.0, 4.0]), jacobian)
    # J^T J = [[2, 1], [1, 6]] and J^T f = (4, 11).
    assert_close(got, np.array([-13 / 11, -18 / 11]))


@exercise("7.7")
def test_of_several_steps_it_is_the_shortest(impl):
    """An error where J^T J has no inverse, or some other step."""
    got = impl.gauss_newton_step(np.array([2.0, 6.0]), np.array([[1.0, 1.0, 0.0], [0.0, 0.0, 2.0]]))
    assert_close(got, np.array([-1.0, -1.0, -3.0]))
    got = impl.gauss_newton_step(np.array([1.0, 2.0, 3.0]), np.outer([1.0, 2.0, 3.0], [3.0, 4.0]))
    assert_close(got, np.array([-0.12, -0.16]))


# --- in perspective ----------------------------------------------------------------------------

@exercise("7.8")
def test_weights_on_paper(impl):
    """c is not divided by its sum: it has the sum 1 / w there."""
    assert_close(impl.weights(NEAR, np.array([1.0, 0.0, 1.0])), np.array([0.6, 0.4, 0.0]))
    assert_close(impl.weights(NEAR, np.array([2.0, 0.5, 1.0])), np.array([0.25, 1.0, 0.25]) / 1.5)
    assert_close(impl.weights(PAPER, A), np.array([0.25, 0.25, 0.5]))


@exercise("7.8")
@each_matrix
def test_the_weighted_corners_lie_behind_the_pixel(impl, m):
    """M b does not point along a, or b has another sum."""
    b = impl.weights(m, PIXEL)
    assert_close(b.sum(), 1.0)
    assert_close(np.cross(m @ b, PIXEL), np.zeros(3), atol=1e-12)


@exercise("7.9")
def test_the_gradient_of_a_weight_on_paper(impl):
    """The sum's own share is left out, as in the note that the header names (-0.4 for -0.24);
    or the sign, a transpose, or b in place of c."""
    got = impl.weights_backward(np.array([0.0, 1.0, 0.0]), NEAR, np.array([1.0, 0.0, 1.0]))
    expected = (np.array([[-0.24, -0.16, 0.0], [0.0, 0.0, 0.0], [0.24, 0.16, 0.0]]),
                np.array([0.32, 0.0, -0.32]))
    assert_close(got, expected)


@exercise("7.9")
@each_matrix
def test_the_gradients_of_weights_are_central_differences(impl, m):
    """M or its gradient is transposed, or grad_b is taken for all ones or for one of them."""
    gradcheck(shares, impl.weights_backward, (m, PIXEL), name="weights")


@exercise("7.9")
@each_matrix
def test_a_sum_that_is_always_1_has_no_gradient(impl, m):
    """The sum's own share is left out: all weights together seem to change."""
    got = impl.weights_backward(np.full(3, 2.0), m, PIXEL)
    assert_close(got, (np.zeros((3, 3)), np.zeros(3)))
