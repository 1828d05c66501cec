"""What the exercises of lab 7 must do."""
import itertools

import numpy as np
import pytest

from labkit.checks import assert_close, assert_equal, exercise

# A triangle for paper: c = (1 - x/4 - y/2, x/4, y/2).
PAPER = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
A = np.array([2.0, 0.25, 1.0])  # c = (3, 4, 1) / 8
VALUES = np.array([8.0, 0.0, 3.0])  # f = 8 - 2 x - 2.5 y, less the target
BY_M = np.array([[0.75, 1.0, 0.25], [0.9375, 1.25, 0.3125], [-3.0, -4.0, -1.0]])

# In perspective, vertex 1 with w = 1/2: c = (1 - x/4 - y/2, x/2, y/2).
NEAR = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])

# Corners x, y, w in columns. Each shows one of the mistakes.
MATRICES = {
    "w differs": np.array([[-0.7, 2.1, 0.4], [-0.5, 0.3, 1.9], [1.0, 2.5, 1.6]]),
    "clockwise": np.array([[2.1, -0.7, 0.4], [0.3, -0.5, 1.9], [2.5, 1.0, 1.6]]),
    "a vertex behind the camera": np.array([[0.9, -1.6, 0.2], [0.4, 0.3, -1.1], [1.4, 2.0, -0.6]]),
    "all behind": np.array([[0.9, -1.6, 0.2], [0.4, 0.3, -1.1], [-1.4, -2.0, -0.6]])}

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


@exercise("7.2")
def test_nine_changes_on_paper(impl):
    """One M^-1 is left out, or both stand on one side, or M stands there. A factor is transposed. A
    sign is wrong. The products are elementwise (* for @). It is a finite step, inv(m + dm) -
    inv(m), and no derivative."""
    m = np.array([[1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 4.0]])
    # M^-1 takes twice row 0 from row 1 of dM, twice column 1 from column 0, and divides by 4.
    dm = np.array([[1.0, 2.0, 3.0], [0.0, 5.0, -1.0], [8.0, -4.0, 12.0]])
    expected = [[3.0, -2.0, -0.75], [4.0, -1.0, 1.75], [-4.0, 1.0, -0.75]]
    assert_close(impl.inverse_differential(m, dm), expected)


@exercise("7.2")
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


@exercise("7.3")
def test_nine_slopes_on_paper(impl):
    """i and j are swapped, one M^-1 is left out, or dM stands for the change of the inverse. Or the
    sign: moving a vertex right brings colour from its left."""
    assert_close(slopes(impl, VALUES, PAPER, A), BY_M)  # df/da = (-2, -2.5, 8)


@exercise("7.3")
@each_matrix
def test_slopes_are_central_differences(impl, m, rng, gradcheck):
    """Right for the paper's triangle alone, whose last row is ones."""
    values = rng.normal(size=3)
    gradcheck(lambda m: brightness(values, m, PIXEL, 0.0),
              lambda grad, m: grad * slopes(impl, values, m, PIXEL), (m,), name="residual_slope")


@exercise("7.4")
def test_the_gradients_on_paper(impl):
    """grad_values is not c, M^-1 a. grad_a: M^-1 r in place of M^-T r. grad_m: transposed, the sign
    of the picture's slope, r or a in place of grad_a or c. Or its last row is 0: the 1s are no
    constants. grad_target: the sign. Or f is a factor."""
    got = impl.residual_backward(1.0, VALUES, PAPER, A, 1.5)
    assert_close(got, ([0.375, 0.5, 0.125], BY_M, [-2.0, -2.5, 8.0], -1.0))


@exercise("7.4")
def test_every_gradient_is_as_large_as_grad_f(impl):
    """grad_f is left out of grad_values, grad_m, grad_a or grad_target, or counted twice there.
    All four are multiplied by it once."""
    got = impl.residual_backward(5.0, VALUES, PAPER, A, 1.5)
    assert_close(got, ([1.875, 2.5, 0.625], 5 * BY_M, [-10.0, -12.5, 40.0], -5.0))


@exercise("7.4")
@each_matrix
def test_the_gradients_of_a_residual_are_central_differences(impl, m, rng, gradcheck):
    """Right for the paper's triangle alone."""
    gradcheck(brightness, impl.residual_backward, (rng.normal(size=3), m, PIXEL, 0.3),
              name="residual")


# --- Gauss and Newton --------------------------------------------------------------------------

LEANING = np.array([[1.2, 0.7], [6.3, 2.1], [2.9, 5.8]])
GREEN = np.array([[0.9, 0.2], [0.1, 0.8], [0.3, 0.4]])  # red and green at the vertices
AT = np.array([[3.0, 2.0], [4.5, 2.5], [2.0, 0.5], [3.5, 4.0], [-1.0, 6.0], [2.5, 3.0]])


def sheet(triangle, colours, points):
    """The colours (P, C) at points of what a triangle is cut from."""
    m = np.stack([*triangle.T, np.ones(3)])
    return np.stack([cramer(m, np.array([*point, 1.0])) for point in points]) @ colours


def columns(triangle, colours):
    """The derivatives of all residuals at AT: 6 columns of the vertices, then those of colours."""
    found = []
    for step in np.eye(6 + colours.size) * 1e-20j:  # complex steps: no digit is lost
        by_triangle, by_colours = step[:6].reshape(3, 2), step[6:].reshape(colours.shape)
        found.append(sheet(triangle + by_triangle, colours + by_colours, AT).imag.ravel() / 1e-20)
    return np.stack(found, -1)


@exercise("7.5")
@pytest.mark.parametrize("winding", [1, -1])
def test_a_triangle_beside_its_place_gets_there_in_one_step(impl, winding):
    """The step goes uphill: a sign, of the residuals or of eq. (4). M^-1 r in place of M^-T r, or M
    is not inverted. x and y are swapped, or the 1 of a = (x, y, 1) is left out. The weights are
    left out: all vertices get the whole slope. Channels or vertices are mixed up, as by reshape. Or
    known colours change.
    """
    triangle, shift = LEANING[::winding], np.array([0.5, -0.25])
    got = impl.fit_step(triangle, GREEN, AT, sheet(triangle + shift, GREEN, AT))
    assert_close(got, ([shift] * 3, np.zeros((3, 2))), atol=1e-9)


@exercise("7.5")
def test_no_other_step_leaves_smaller_squares(impl, rng):
    """Only as many residuals as unknowns are looked at, or one channel. It is a step along the
    gradient, -J^T r, without the inverse of J^T J, or it is damped, or too long or too short.
    """
    colours, target = rng.uniform(size=(3, 3)), rng.uniform(size=(6, 3))
    by_triangle, _ = impl.fit_step(LEANING, colours, AT, target)
    jacobian = columns(LEANING, colours)[:, :6]
    left = (sheet(LEANING, colours, AT) - target).ravel() + jacobian @ np.ravel(by_triangle)
    assert_close(jacobian.T @ left, np.zeros(6), atol=1e-9)


@exercise("7.5")
def test_six_steps_find_a_triangle(impl):
    """Right near the target alone. With a mistake in the derivatives it comes nearer by a factor
    in each step, and does not double its digits.
    """
    colours = np.column_stack([GREEN, [0.1, 0.2, 0.9]])
    target, triangle = sheet(LEANING, colours, AT), LEANING + [[0.5, -0.4], [-0.6, 0.5], [0.3, 0.7]]
    for _ in range(6):
        triangle = triangle + impl.fit_step(triangle, colours, AT, target)[0]
    assert_close(triangle, LEANING, atol=1e-9)


@exercise("7.5")
def test_colours_are_found_in_one_step(impl):
    """The colours' columns are those of another channel or vertex, or the values stand in them. Or
    a sign. In a picture of one colour the vertices' columns are 0, and J^T J has no inverse.
    """
    flat = np.array([[0.5, 0.25]] * 3)
    got = impl.fit_step(LEANING, flat, AT, sheet(LEANING, GREEN, AT), True)
    assert_close(got, (np.zeros((3, 2)), GREEN - flat), atol=1e-9)


@exercise("7.5")
@pytest.mark.parametrize("channels", [1, 3])
def test_of_the_best_steps_it_is_the_shortest(impl, rng, channels):
    """Vertices and colours are solved for one after the other, not at once. Or an error where
    J^T J has no inverse, or some other of many steps: np.linalg.lstsq and pinv find the shortest.
    """
    colours, target = rng.uniform(size=(3, channels)), rng.uniform(size=(6, channels))
    by_triangle, by_colours = impl.fit_step(LEANING, colours, AT, target, True)
    wanted = np.linalg.pinv(columns(LEANING, colours)) @ np.ravel(
        target - sheet(LEANING, colours, AT))
    assert_close(np.concatenate([np.ravel(by_triangle), np.ravel(by_colours)]), wanted, atol=1e-8)


# --- in perspective ----------------------------------------------------------------------------

@exercise("7.6")
def test_the_gradients_of_weights_on_paper(impl):
    """grad_c: the share of the sum s, grad_b . b, is left out, has the wrong sign or takes c for b,
    or the division by s is missing. The inverse is not transposed. grad_m: the sign, a
    transpose, a or b in place of c, a last row of 0. grad_a is returned first."""
    grad_b, a = np.array([4.0, 1.0, 2.0]), np.array([-2.0, 0.5, 1.0])
    # c = (1.25, -1, 0.25), s = 1/2, b = (2.5, -2, 0.5), grad_b . b = 9, grad_c = (-10, -16, -14)
    expected = ([[6.875, -5.5, 1.375], [2.5, -2.0, 0.5], [12.5, -10.0, 2.5]], [-5.5, -2.0, -10.0])
    assert_close(impl.barycentric_backward(grad_b, NEAR, a), expected)


@exercise("7.6")
def test_the_sum_of_c_may_be_negative(impl):
    """s is counted once too often or too rarely, or its sign is lost, as by abs."""
    grad_b, a = np.array([4.0, 1.0, 2.0]), np.array([-12.0, 1.0, 1.0])
    # c = (3.5, -6, 0.5), s = -2, grad_b . b = -4.5, grad_c = (-4.25, -2.75, -3.25)
    expected = ([[1.09375, -1.875, 0.15625], [-1.75, 3.0, -0.25], [14.875, -25.5, 2.125]],
                [-0.3125, 0.5, -4.25])
    assert_close(impl.barycentric_backward(grad_b, NEAR, a), expected)


@exercise("7.6")
@each_matrix
def test_the_gradients_of_weights_are_central_differences(impl, m, rng, gradcheck):
    """M or its gradient is transposed, or grad_b is taken for all ones or for one of them."""
    m = m * rng.uniform(0.8, 1.25, 3)
    gradcheck(shares, impl.barycentric_backward, (m, PIXEL), name="barycentric")


@exercise("7.6")
@each_matrix
def test_a_sum_that_is_always_1_has_no_gradient(impl, m):
    """The sum's own share is left out: all weights together seem to change."""
    got = impl.barycentric_backward(np.full(3, 2.0), m, PIXEL)
    assert_close(got, (np.zeros((3, 3)), np.zeros(3)))
