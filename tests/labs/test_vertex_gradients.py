"""What the exercises of lab 7 must do."""
import itertools

import numpy as np
import pytest
from corner_matrices import MATRICES, NEAR

from labkit.checks import assert_close, assert_equal, exercise

# A triangle for paper: c = (1 - x/4 - y/2, x/4, y/2).
PAPER = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
A = np.array([2.0, 0.25, 1.0])  # c = (3, 4, 1) / 8
VALUES = np.array([8.0, 0.0, 3.0])  # f = 8 - 2 x - 2.5 y, less the target
BY_M = np.array([[0.75, 1.0, 0.25], [0.9375, 1.25, 0.3125], [-3.0, -4.0, -1.0]])

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
    """The vertices stand in the rows of M. The row of ones is missing, has zeros or is not the last
    one. x and y are swapped, or mixed: reshape(2, 3) is no transpose. Or the columns are edges."""
    triangle = np.array([[5.0, 6.0], [7.0, 8.0], [9.0, 10.0]])
    assert_equal(impl.vertex_matrix(triangle), [[5.0, 7.0, 9.0], [6.0, 8.0, 10.0], [1.0, 1.0, 1.0]])


@exercise("7.1")
def test_the_determinant_is_twice_the_area(impl, rng):
    """Two columns or two rows are swapped: the determinant of a counter-clockwise triangle is
    positive."""
    corner, (a, b) = rng.normal(size=2), rng.uniform(1, 2, 2)
    triangle = corner + np.array([[0.0, 0.0], [a, 0.0], [0.0, b]])
    assert_close(np.linalg.det(impl.vertex_matrix(triangle)), a * b)


@exercise("7.3")
def test_nine_changes_on_paper(impl):
    """One M^-1 is left out, or both stand on one side, or M stands there. A factor is transposed. A
    sign is wrong. The products are elementwise (* for @). It is a finite step, inv(m + dm) -
    inv(m), and no derivative."""
    m = np.array([[1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 4.0]])
    # M^-1 takes twice row 0 from row 1 of dM, twice column 1 from column 0, and divides by 4.
    dm = np.array([[1.0, 2.0, 3.0], [0.0, 5.0, -1.0], [8.0, -4.0, 12.0]])
    expected = [[3.0, -2.0, -0.75], [4.0, -1.0, 1.75], [-4.0, 1.0, -0.75]]
    assert_close(impl.inverse_differential(m, dm), expected)


@exercise("7.3")
@each_matrix
def test_the_product_with_m_stays_one(impl, m, rng):
    """d(M^-1) M + M^-1 dM = 0 fails where M and dM do not commute."""
    dm = rng.normal(size=(3, 3))
    assert_close(impl.inverse_differential(m, dm) @ m, np.linalg.solve(m, -dm), atol=1e-10)


def slopes(impl, values, m, a):
    """The nine slopes. The last call is for row 0 and column 2, which tells i from j."""
    found = np.zeros((3, 3))
    for i, j in itertools.product((1, 2, 0), range(3)):
        found[i, j] = impl.residual_slope(values, m, a, i, j)
    return found


@exercise("7.4")
def test_nine_slopes_on_paper(impl):
    """i and j are swapped, one M^-1 is left out, or dM stands for the change of the inverse. Or the
    sign: moving a vertex right brings colour from its left."""
    assert_close(slopes(impl, VALUES, PAPER, A), BY_M)  # df/da = (-2, -2.5, 8)


@exercise("7.4")
@each_matrix
def test_slopes_are_central_differences(impl, m, rng, gradcheck):
    """Right for the paper's triangle alone, whose last row is ones."""
    values = rng.normal(size=3)
    gradcheck(lambda m: brightness(values, m, PIXEL, 0.0),
              lambda grad, m: grad * slopes(impl, values, m, PIXEL), (m,), name="residual_slope")


@exercise("7.5")
def test_the_gradients_on_paper(impl):
    """grad_values is not c, M^-1 a. grad_a: M^-1 r for M^-T r. grad_m: transposed, the sign of the
    picture's slope, r or a in place of grad_a or c. Or its last row is 0: the 1s are no constants.
    grad_target: the sign. Or f is a factor."""
    got = impl.residual_backward(1.0, VALUES, PAPER, A, 1.5)
    assert_close(got, ([0.375, 0.5, 0.125], BY_M, [-2.0, -2.5, 8.0], -1.0))


@exercise("7.5")
def test_every_gradient_is_as_large_as_grad_f(impl):
    """grad_f is left out of grad_values, grad_m, grad_a or grad_target, or counted twice there.
    All four are multiplied by it once."""
    got = impl.residual_backward(5.0, VALUES, PAPER, A, 1.5)
    assert_close(got, ([1.875, 2.5, 0.625], 5 * BY_M, [-10.0, -12.5, 40.0], -5.0))


@exercise("7.5")
@each_matrix
def test_the_gradients_of_a_residual_are_central_differences(impl, m, rng, gradcheck):
    """Right for the paper's triangle alone."""
    gradcheck(brightness, impl.residual_backward, (rng.normal(size=3), m, PIXEL, 0.3),
              name="residual")


# --- Gauss and Newton --------------------------------------------------------------------------

@exercise("7.6")
def test_four_points_on_paper(impl):
    """by_triangle: the minus sign of eq. (4), M^-1 r for M^-T r, x and y swapped, or the weights
    are left out. by_values: M is transposed, the 1 of a = (x, y, 1) left out or not last, or the
    values are multiplied in. Or axes are mixed up, as by reshape: [p, k] is of vertex k."""
    triangle = np.array([[1.0, 2.0], [5.0, 2.0], [1.0, 4.0]])
    points = np.array([[2.0, 3.0], [2.0, 2.5], [3.0, 2.25], [1.5, 3.0]])
    # c_1 = (x - 1) / 4, c_2 = (y - 2) / 2, and c_0 is the rest.
    weights = np.array([[0.25, 0.25, 0.5], [0.5, 0.25, 0.25],
                        [0.375, 0.5, 0.125], [0.375, 0.125, 0.5]])
    # df/dx = (4 - 8) / 4 and df/dy = (3 - 8) / 2. A vertex that moves by 1 brings minus w of it.
    by_triangle = weights[:, :, None] * np.array([1.0, 2.5])
    got = impl.residuals_jacobian(np.array([8.0, 4.0, 3.0]), triangle, points)
    assert_close(got, (weights, by_triangle))


@exercise("7.6")
@pytest.mark.parametrize("winding", [1, -1])
def test_the_jacobian_is_central_differences(impl, rng, winding, gradcheck):
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
    """A step along the gradient, -J^T r, without the inverse of J^T J. The sign: the step goes
    uphill. J^T is left out, or stands for J. Something is added to the diagonal of J^T J: the step
    is damped. A mean over the residuals stands for the sum, or a factor 2 or 1/2 is in it."""
    jacobian = np.array([[2.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0],
                         [0.0, 3.0, 1.0, 0.0], [0.0, 0.0, 1.0, 4.0]])
    step = [-2.0, -3.0, 1.0, 0.5]  # J step = (-4, -5, -8, 3)
    assert_close(impl.gauss_newton_step(np.array([4.0, 5.0, 8.0, -3.0]), jacobian), step)


@exercise("7.7")
def test_with_too_many_residuals_the_squares_are_least(impl):
    """Only as many residuals as unknowns are looked at, or J must be square, as np.linalg.inv and
    np.linalg.solve ask for."""
    jacobian = np.array([[1.0, 0.0], [0.0, 2.0], [1.0, 1.0], [0.0, 1.0]])
    got = impl.gauss_newton_step(np.array([1.0, 2.0, 3.0, 4.0]), jacobian)
    # J^T J = [[2, 1], [1, 6]] and J^T f = (4, 11).
    assert_close(got, [-13 / 11, -18 / 11])
    got = impl.gauss_newton_step(np.array([1.0, 2.0, 6.0]), np.ones((3, 1)))
    assert_close(got, [-3.0])


@exercise("7.7")
def test_no_other_step_leaves_smaller_squares(impl, rng):
    """Right for a few residuals or unknowns alone: what is left of f must be perpendicular to all
    columns of J."""
    f, jacobian = rng.normal(size=9), rng.normal(size=(9, 4))
    left = f + jacobian @ impl.gauss_newton_step(f, jacobian)
    assert_close(jacobian.T @ left, np.zeros(4), atol=1e-9)


@exercise("7.7", fine_print=True)
def test_of_several_steps_it_is_the_shortest(impl):
    """An error where J^T J is singular and has no inverse, or some other step than the shortest:
    np.linalg.lstsq and pinv find it."""
    got = impl.gauss_newton_step(np.array([2.0, 6.0]), np.array([[1.0, 1.0, 0.0], [0.0, 0.0, 2.0]]))
    assert_close(got, [-1.0, -1.0, -3.0])
    got = impl.gauss_newton_step(np.array([1.0, 2.0, 3.0]), np.outer([1.0, 2.0, 3.0], [3.0, 4.0]))
    assert_close(got, [-0.12, -0.16])


# --- in perspective ----------------------------------------------------------------------------

@exercise("7.9")
def test_the_gradients_of_weights_on_paper(impl):
    """grad_c: the share of the sum s, grad_b . b, is left out, has the wrong sign or takes c for b,
    or the division by s is missing. The inverse is not transposed. grad_m: the sign, a
    transpose, a or b in place of c, a last row of 0. grad_a is returned first."""
    grad_b, a = np.array([4.0, 1.0, 2.0]), np.array([-2.0, 0.5, 1.0])
    # c = (1.25, -1, 0.25), s = 1/2, b = (2.5, -2, 0.5), grad_b . b = 9, grad_c = (-10, -16, -14)
    expected = ([[6.875, -5.5, 1.375], [2.5, -2.0, 0.5], [12.5, -10.0, 2.5]], [-5.5, -2.0, -10.0])
    assert_close(impl.barycentric_backward(grad_b, NEAR, a), expected)


@exercise("7.9")
def test_the_sum_of_c_may_be_negative(impl):
    """s is counted once too often or too rarely, or its sign is lost, as by abs."""
    grad_b, a = np.array([4.0, 1.0, 2.0]), np.array([-12.0, 1.0, 1.0])
    # c = (3.5, -6, 0.5), s = -2, grad_b . b = -4.5, grad_c = (-4.25, -2.75, -3.25)
    expected = ([[1.09375, -1.875, 0.15625], [-1.75, 3.0, -0.25], [14.875, -25.5, 2.125]],
                [-0.3125, 0.5, -4.25])
    assert_close(impl.barycentric_backward(grad_b, NEAR, a), expected)


@exercise("7.9")
@each_matrix
def test_the_gradients_of_weights_are_central_differences(impl, m, rng, gradcheck):
    """M or its gradient is transposed, or grad_b is taken for all ones or for one of them."""
    m = m * rng.uniform(0.8, 1.25, 3)
    gradcheck(shares, impl.barycentric_backward, (m, PIXEL), name="barycentric")


@exercise("7.9")
@each_matrix
def test_a_sum_that_is_always_1_has_no_gradient(impl, m):
    """The sum's own share is left out: all weights together seem to change."""
    got = impl.barycentric_backward(np.full(3, 2.0), m, PIXEL)
    assert_close(got, (np.zeros((3, 3)), np.zeros(3)))
