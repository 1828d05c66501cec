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


def corners_of(rng, count):
    """Faces (3, 3, count), some of w below 0, none of them thin."""
    base = np.stack(list(MATRICES.values()), -1)
    return base[..., np.arange(count) % base.shape[-1]] + rng.uniform(-0.2, 0.2, (3, 3, count))


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
    b = np.asarray(impl.weights(m, PIXEL))
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


# --- whole meshes ------------------------------------------------------------------------------

@exercise("7.10")
def test_edges_on_paper(impl):
    """The corners of a cross product are swapped, or rows and columns."""
    expected = np.array([[-1.0, -2.0, 4.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    assert_close(impl.edge_functions(NEAR), expected)


@exercise("7.10")
def test_with_w_1_they_are_lab_2s_edge_functions(impl, rng):
    """Edge k is not the one opposite to vertex k, or runs the other way."""
    x, y = triangle = rng.uniform(0, 9, (2, 3))
    corners = np.stack([*triangle, np.ones(3)])
    e = np.asarray(impl.edge_functions(corners)) @ np.array([4.0, 5.0, 1.0])
    for k, (i, j) in enumerate([(1, 2), (2, 0), (0, 1)]):
        expected = (y[i] - y[j]) * (4.0 - x[i]) + (x[j] - x[i]) * (5.0 - y[i])
        assert_close(e[k], expected, atol=1e-9)


@exercise("7.10")
def test_they_are_the_inverse_times_the_determinant(impl, rng):
    """Right for one face alone, or for F = 3; or each row is divided by something."""
    corners = corners_of(rng, 5)
    got = np.asarray(impl.edge_functions(corners))
    assert_equal(got.shape, (3, 3, 5))
    for face in range(5):
        m = corners[..., face]
        assert_close(got[..., face], np.linalg.det(m) * np.linalg.inv(m), atol=1e-9)


@exercise("7.10")
def test_a_face_seen_from_its_side_has_edges(impl):
    """An inverse is taken, and there is none."""
    flat = np.array([[0.0, 2.0, 4.0], [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
    expected = np.array([[0.0, 2.0, 0.0], [0.0, -4.0, 0.0], [0.0, 2.0, 0.0]])
    assert_close(impl.edge_functions(flat), expected)


@exercise("7.11")
def test_an_element_of_the_edges_on_paper(impl):
    """edges[0, 0] = y_1 w_2 - w_1 y_2, and edges[1, 2] = x_2 y_0 - y_2 x_0; a flipped sign."""
    grad = np.zeros((3, 3))
    grad[0, 0] = 1.0
    expected = np.array([[0.0, 0.0, 0.0], [0.0, 1.0, -0.5], [0.0, -2.0, 0.0]])
    assert_close(impl.edge_functions_backward(grad, NEAR), expected)
    grad[0, 0], grad[1, 2] = 0.0, 3.0
    expected = np.array([[-6.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    assert_close(impl.edge_functions_backward(grad, NEAR), expected)


@exercise("7.11")
def test_the_gradients_of_edges_are_central_differences(impl, rng):
    """A corner gets the gradient of one of its two edges alone, or another face's."""
    def forward(corners):
        return np.stack([np.cross(corners[:, i], corners[:, j], axis=0)
                         for i, j in [(1, 2), (2, 0), (0, 1)]])

    gradcheck(forward, impl.edge_functions_backward, (corners_of(rng, 5),), name="5 faces")
    gradcheck(forward, impl.edge_functions_backward, (MATRICES["w differs"],), name="a face")


E_SIGNS = np.array([[1.0, -3.0, 0.5, -1.0], [2.0, 0.5, -0.25, 4.0], [4.0, -1.5, 1.75, -4.0]])


def quotient(e, epsilon):
    """b, where epsilon has the sign of the sum."""
    return np.stack([column / (column.sum() + (epsilon if column.sum() >= 0 else -epsilon))
                     for column in e.T], -1)


@exercise("7.12")
def test_normalized_on_paper(impl):
    """The sum over samples is taken for that over corners."""
    e = np.array([[1.0, -3.0], [2.0, 0.0], [5.0, -1.0]])
    assert_close(impl.normalize(e, 0.0), np.array([[0.125, 0.75], [0.25, 0.0], [0.625, 0.25]]))


@exercise("7.12")
def test_epsilon_makes_the_sum_larger(impl):
    """Added to a negative sum, it makes that smaller; or it is left out, or 0 has no sign."""
    e = np.array([[1.0, -3.0, 1.0], [2.0, 0.0, -1.0], [4.0, 0.0, 0.0]])
    expected = np.array([[0.125, 0.75, 1.0], [0.25, 0.0, -1.0], [0.5, 0.0, 0.0]])
    assert_close(impl.normalize(e, 1.0), expected)


@exercise("7.13")
def test_the_gradient_of_a_quotient_on_paper(impl):
    """The sum's own share is left out, or has the wrong sign."""
    grad_b, e = np.array([[14.0], [0.0], [7.0]]), np.array([[1.0], [2.0], [4.0]])
    # b = e / 7: by e_0 alone 2, by e_2 alone 1; by the sum -(14 * 1 + 7 * 4) / 49 = -6 / 7.
    assert_close(impl.normalize_backward(grad_b, e, 0.0), np.array([[8.0], [-6.0], [1.0]]) / 7)


@exercise("7.13")
@pytest.mark.parametrize("epsilon", [0.0, 0.3])
def test_the_gradients_of_quotients_are_central_differences(impl, epsilon):
    """epsilon is left out, or has the same sign everywhere; or sums run over samples."""
    gradcheck(quotient, impl.normalize_backward, (E_SIGNS, epsilon), differentiable=(0,),
              name="normalize")


@exercise("7.14")
def test_the_derivative_of_a_quotient_on_paper(impl):
    """The denominator's own change is left out, or has the wrong sign."""
    e = np.array([[1.0, 1.0], [2.0, 0.0], [1.0, 1.0]])
    e_x = np.array([[1.0, 2.0], [0.0, 0.0], [3.0, 2.0]])
    assert_close(impl.normalize_derivative(e, e_x, 0.0),
                 np.array([[0.0, 0.0], [-0.5, 0.0], [0.5, 0.0]]))


@exercise("7.14")
@pytest.mark.parametrize("epsilon", [0.0, 0.3])
def test_the_derivative_is_that_of_a_quotient(impl, rng, epsilon):
    """epsilon is left out of one of the two quotients, or has the same sign everywhere."""
    e_x = rng.normal(size=(3, 4))
    s = E_SIGNS.sum(0) + epsilon * np.array([1, -1, 1, -1])
    expected = (e_x * s - E_SIGNS * e_x.sum(0)) / s**2
    assert_close(impl.normalize_derivative(E_SIGNS, e_x, epsilon), expected)


@exercise("7.15")
def test_the_gradient_of_a_derivative_on_paper(impl):
    """The sum's own share is left out, in e or in e_x."""
    e, e_x = np.array([[1.0], [2.0], [1.0]]), np.array([[1.0], [0.0], [3.0]])
    got = impl.normalize_derivative_backward(np.array([[0.0], [4.0], [0.0]]), e, e_x, 0.0)
    # b_1x = e_1x / s - e_1 s_x / s^2, and s = s_x = 4. By e_1 alone: -s_x / s^2 = -1/4. By s:
    # -e_1x / s^2 + 2 e_1 s_x / s^3 = 1/4. By e_1x: 1/4. By s_x: -e_1 / s^2 = -1/8.
    expected = np.array([[1.0], [0.0], [1.0]]), np.array([[-0.5], [0.5], [-0.5]])
    assert_close(got, expected)


@exercise("7.15")
@pytest.mark.parametrize("epsilon", [0.0, 0.3])
def test_the_gradients_of_derivatives_are_central_differences(impl, rng, epsilon):
    """epsilon is left out, or one of the three ways by which e enters."""
    def forward(e, e_x, epsilon):
        s = e.sum(0)
        s = s + epsilon * np.where(s < 0, -1, 1)
        return e_x / s - e * e_x.sum(0) / s**2

    inputs = E_SIGNS, rng.normal(size=(3, 4)), epsilon
    gradcheck(forward, impl.normalize_derivative_backward, inputs, differentiable=(0, 1),
              name="normalize_derivative")


@exercise("7.16")
def test_sums_on_paper(impl):
    """A face that no pixel sees is left out; x, y and 1 are in another order; or += with an index,
    which adds a face's pixels once only.
    """
    u = np.array([[1.0, 10.0, 100.0], [1.0, 1.0, 1.0]])
    x, y, face = np.array([1.0, 2.0, 4.0]), np.array([0.0, 1.0, 3.0]), np.array([2, 0, 2])
    got = impl.sum_per_face(u, x, y, face, 4)
    expected = np.array([[[20.0, 0, 401, 0], [10, 0, 300, 0], [10, 0, 101, 0]],
                         [[2, 0, 5, 0], [1, 0, 3, 0], [1, 0, 2, 0]]])
    assert_close(got, expected)


@exercise("7.16")
def test_every_pixel_counts_once(impl, rng):
    """Of two pixels with the same face one is lost, as with sums[face] += ..."""
    u, x, y, face = rng.normal(size=(3, 50)), *rng.normal(size=(2, 50)), rng.integers(0, 6, 50)
    expected = np.zeros((3, 3, 7))
    for n in range(50):
        for k in range(3):
            for i, factor in enumerate((x[n], y[n], 1.0)):
                expected[k, i, face[n]] += u[k, n] * factor
    assert_close(impl.sum_per_face(u, x, y, face, 7), expected)


@exercise("7.16")
def test_no_pixels_sum_to_zero(impl):
    """An error where nothing is seen."""
    got = impl.sum_per_face(np.zeros((2, 0)), np.zeros(0), np.zeros(0), np.zeros(0, int), 3)
    assert_close(got, np.zeros((2, 3, 3)))


@exercise("7.17")
def test_a_plane_on_paper(impl):
    """M is transposed, or the planes are not divided by the determinant."""
    got = impl.depth_planes(np.array([[0.0], [2.0], [1.0]]), NEAR[..., None])
    assert_close(got, np.array([[1.0], [0.5], [0.0]]))


@exercise("7.17")
def test_a_plane_has_the_depth_of_its_corners(impl, rng):
    """z is divided by w first, or a face gets another one's plane: planes . q_k = z_k."""
    corners, z = corners_of(rng, 5), rng.normal(size=(3, 5))
    planes = np.asarray(impl.depth_planes(z, corners))
    assert_close(np.einsum("if,ikf->kf", planes, corners), z)


@exercise("7.18")
def test_a_depth_pulls_at_its_corners_on_paper(impl):
    """The sign, or grad_z and the weights are swapped."""
    z, a = np.array([[0.0], [2.0], [1.0]]), np.array([[1.0], [0.0], [1.0]])
    got = impl.depth_planes_backward(a, z, NEAR[..., None])
    weights, slope = np.array([[0.75], [0.5], [0.0]]), np.array([1.0, 0.5, 0.0])
    assert_close(got, (weights, -slope[:, None, None] * weights))


@exercise("7.18")
def test_the_gradients_of_planes_are_central_differences(impl, rng):
    """A matrix is transposed, or one face's gradient goes to another."""
    def forward(z, corners):
        return np.stack([np.linalg.solve(corners[..., f].T, z[:, f]) for f in range(5)], -1)

    gradcheck(forward, impl.depth_planes_backward, (rng.normal(size=(3, 5)), corners_of(rng, 5)),
              name="depth_planes")
