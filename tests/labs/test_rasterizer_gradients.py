"""What the exercises of lab 7's whole meshes must do."""
import numpy as np
import pytest
from corner_matrices import MATRICES, NEAR

from labkit.checks import assert_close, exercise

# Numbers for paper: q_0 = (3, 2, 1), q_1 = (4, 1, 2), q_2 = (2, 5, 3). det(M) = -19.
PAPER = np.array([[3.0, 4.0, 2.0], [2.0, 1.0, 5.0], [1.0, 2.0, 3.0]])

# Two faces for paper: c = (1 - x/4 - y/2, x/2, y/2) with det(M) = 4, and
# c = (x/2, 1 - x/2 - 2y, y) with det(M) = -2.
TWO = np.stack([NEAR, [[2.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 2.0]]], -1)
PLANES = np.array([[2.0, 1.0], [-1.0, -2.0], [4.0, 3.0]])  # 2x - y + 4 and x - 2y + 3
DEPTHS = np.array([[4.0, 5.0], [6.0, 3.0], [2.0, 4.0]])    # at their corners: z_k = plane . q_k

SIGNS = np.array([[1.0, -3.0, 0.5, -1.0], [2.0, 0.5, -0.25, 4.0], [4.0, -1.5, 1.75, -4.0]])


def corners_of(rng, count):
    """Faces (3, 3, count), some of w below 0, none of them thin."""
    base = np.stack(list(MATRICES.values()), -1)
    return base[..., np.arange(count) % base.shape[-1]] + rng.uniform(-0.2, 0.2, (3, 3, count))


# --- whole meshes ------------------------------------------------------------------------------

@exercise("7.10")
def test_edges_on_paper(impl):
    """The cross products are in the other order, q_j x q_i. Rows and columns are swapped: corners
    are columns of M, edges are rows. Edge k is not the one across from vertex k. Edge 1 alone has
    the other sign: it is q_2 x q_0, not q_0 x q_2."""
    expected = np.array([[-7.0, -8.0, 18.0], [-1.0, 7.0, -11.0], [3.0, -2.0, -5.0]])
    assert_close(impl.edge_normals(PAPER), expected)
    expected = np.array([[-1.0, -2.0, 4.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    assert_close(impl.edge_normals(NEAR), expected)


@exercise("7.10")
def test_with_w_1_they_are_lab_2s_edge_functions(impl, rng):
    """Edge k is not the one opposite to vertex k, or runs the other way."""
    x, y = triangle = rng.uniform(0, 9, (2, 3))
    corners = np.stack([*triangle, np.ones(3)])
    e = impl.edge_normals(corners) @ np.array([4.0, 5.0, 1.0])
    for k, (i, j) in enumerate([(1, 2), (2, 0), (0, 1)]):
        assert_close(e[k], (y[i] - y[j]) * (4.0 - x[i]) + (x[j] - x[i]) * (5.0 - y[i]), atol=1e-9)


@exercise("7.10")
def test_they_are_the_inverse_times_the_determinant(impl, rng):
    """Right for one face alone, or for F = 3. Or it is divided by the determinant or the length of
    a row."""
    corners = corners_of(rng, 5)
    expected = [np.linalg.det(m) * np.linalg.inv(m) for m in np.moveaxis(corners, -1, 0)]
    assert_close(impl.edge_normals(corners), np.stack(expected, -1), atol=1e-9)


@exercise("7.10")
def test_a_face_seen_from_its_side_has_edges(impl):
    """An inverse is taken, and there is none."""
    flat = np.array([[0.0, 2.0, 4.0], [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
    assert_close(impl.edge_normals(flat), [[0.0, 2.0, 0.0], [0.0, -4.0, 0.0], [0.0, 2.0, 0.0]])


@exercise("7.11")
def test_six_gradients_of_two_pixels_on_paper(impl):
    """A corner has the gradient of one of its two edges alone, as by = for +=. A sign: that of one
    of the two terms of e_k, or of all. x and y are exchanged, or grad_x and grad_y. Edge k is not
    across from corner k, or edge 1 is not that from 2 to 0.
    """
    x = np.array([[3.0, -1.0], [4.0, 6.0], [2.0, 0.5]])
    y = np.array([[2.0, 7.0], [1.0, -3.0], [5.0, 8.0]])
    grad_e = np.array([[1.0, 2.0], [3.0, -1.0], [-2.0, 4.0]])
    # The first pixel: x_0 is in e_1 by -y_2 and in e_2 by y_1, which is 3 (-5) + -2 (1).
    expected = ([[-17.0, -4.0], [9.0, -12.0], [5.0, -1.0]],
                [[14.0, -24.5], [-8.0, -5.0], [-5.0, 11.0]])
    assert_close(impl.edge_functions_at_backward(grad_e, x, y), expected)


@exercise("7.11")
def test_each_edge_alone_on_paper(impl):
    """An edge is that of other corners, or of one of its two only; a flipped sign. Or a pixel gets
    what is another's.
    """
    x = np.array([[1.0, 3.0, -1.0], [2.0, 4.0, 6.0], [5.0, 2.0, 0.5]])
    y = np.array([[3.0, 2.0, 7.0], [7.0, 1.0, -3.0], [4.0, 5.0, 8.0]])
    # e_0 = x_1 y_2 - y_1 x_2, then twice e_1 = x_2 y_0 - y_2 x_0, then -3 e_2, x_0 y_1 - y_0 x_1
    expected = ([[0.0, -10.0, 9.0], [4.0, 0.0, 21.0], [-7.0, 4.0, 0.0]],
                [[0.0, 4.0, 18.0], [-5.0, 0.0, 3.0], [2.0, -6.0, 0.0]])
    assert_close(impl.edge_functions_at_backward(np.diag([1.0, 2.0, -3.0]), x, y), expected)


@exercise("7.11")
@pytest.mark.parametrize("count", [1, 5])
def test_the_gradients_of_edges_at_pixels_are_central_differences(impl, rng, count, gradcheck):
    """A corner gets the gradient of one of its two edges alone, or another pixel's. Or it is right
    for as many pixels as there are corners.
    """
    def forward(x, y):
        return np.stack([x[i] * y[j] - y[i] * x[j] for i, j in [(1, 2), (2, 0), (0, 1)]])

    gradcheck(forward, impl.edge_functions_at_backward, tuple(rng.normal(size=(2, 3, count))),
              name=f"{count} pixels")


def test_epsilon_makes_the_sum_larger(impl):
    """Added to a negative sum, it makes that smaller; or it is left out, or 0 has no sign."""
    e = np.array([[1.0, -3.0, 1.0], [2.0, 0.0, -1.0], [4.0, 0.0, 0.0]])
    assert_close(impl.padded_sum(e, 1.0), [8.0, -4.0, 1.0])


@exercise("7.15")
def test_the_gradient_of_a_derivative_on_paper(impl):
    """The change of b or the change of s is left out of grad_c, or c is a constant there, or dc is
    not summed. In grad_dc the share of the sum is left out. The division by s, or a sign, is
    missing. One way counts twice."""
    dc = np.array([[1.0, 3.0], [2.0, -1.0], [5.0, 4.0]])
    c, s = np.array([[1.0, 1.0], [2.0, -4.0], [1.0, 1.0]]), np.array([4.0, -2.0])
    grad_db = np.array([[0.0, 2.0], [16.0, 4.0], [32.0, -6.0]])
    # db_k = dc_k / s - c_k ds / s^2, at first with s = 4, ds = 8. By dc_k alone: 1/4. By ds:
    # -c_k / 16, which is 16 (-2/16) + 32 (-1/16) = -4. By c_k alone: -1/2. By s: -dc_k / 16 +
    # c_k / 4, which is 6 - 2. In the second column s = -2, ds = 6.
    expected = ([[-4.0, 4.0], [0.0, 3.0], [4.0, 8.0]], [[4.0, 32.5], [-4.0, 29.5], [-12.0, 44.5]])
    assert_close(impl.normalize_derivative_backward(grad_db, dc, c / s, s), expected)


@exercise("7.15")
@pytest.mark.parametrize("epsilon", [0.0, 0.3])
def test_the_gradients_of_derivatives_are_central_differences(impl, rng, epsilon, gradcheck):
    """One of the three ways is left out by which c enters."""
    def padded(c):
        s = c.sum(0)
        return s + epsilon * np.where(s < 0, -1, 1)

    def backward(grad_db, dc, c):
        return impl.normalize_derivative_backward(grad_db, dc, c / padded(c), padded(c))

    gradcheck(lambda dc, c: dc / padded(c) - c * dc.sum(0) / padded(c)**2, backward,
              (rng.normal(size=(3, 4)), SIGNS), name="normalize_derivative")


@exercise("7.17")
def test_two_planes_on_paper(impl):
    """M is transposed, or not inverted. z is divided by w. The planes are not divided by the
    determinant, or its sign is lost."""
    assert_close(impl.depth_planes(DEPTHS, TWO), PLANES)


@exercise("7.17")
def test_a_plane_has_the_depth_of_its_corners(impl, rng):
    """z is divided by w first, or a face gets another one's plane: planes . q_k = z_k."""
    corners, z = corners_of(rng, 5), rng.normal(size=(3, 5))
    planes = impl.depth_planes(z, corners)
    assert_close(np.einsum("if,ikf->kf", planes, corners), z)


@exercise("7.18")
def test_a_depth_pulls_at_its_corners_on_paper(impl):
    """grad_z: M^-1 is transposed, or not divided by the determinant. grad_corners: the minus sign,
    rows and columns, z or grad_planes in place of the planes."""
    grad_planes = np.array([[1.0, 3.0], [0.25, -2.0], [1.0, 2.0]])
    weights = np.array([[0.625, 1.5], [0.5, 4.5], [0.125, -2.0]])  # M weights = grad_planes
    got = impl.depth_planes_backward(grad_planes, DEPTHS, TWO)
    assert_close(got, (weights, -PLANES[:, None] * weights))


@exercise("7.18")
def test_the_gradients_of_planes_are_central_differences(impl, rng, gradcheck):
    """A matrix is transposed, or one face's gradient goes to another."""
    def forward(z, corners):
        return np.stack([np.linalg.solve(corners[..., f].T, z[:, f]) for f in range(5)], -1)

    gradcheck(forward, impl.depth_planes_backward, (rng.normal(size=(3, 5)), corners_of(rng, 5)),
              name="depth_planes")
