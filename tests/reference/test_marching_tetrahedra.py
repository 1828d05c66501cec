"""The reference's whole meshes of lab 15: closed, outward, and as near as the cells are small."""
import time

import numpy as np
import pytest
import scipy.sparse

from reference import implicit_surfaces, marching_tetrahedra


def test_trilinear_weights_give_linear_functions_back():
    """The order of axes differs from the grid's points, or weights are swapped."""
    n, rng = 5, np.random.default_rng(5)
    points, _ = marching_tetrahedra.tetrahedral_grid(n)
    plane = points @ [1.0, 20.0, 300.0] + 4.0
    there = np.concatenate([rng.uniform(-1, 1, (200, 3)), points, [[1.0, 1.0, 1.0]]])
    weights = marching_tetrahedra.grid_weights(there, n)
    assert scipy.sparse.issparse(weights) and weights.shape == (len(there), (n + 1)**3)
    np.testing.assert_allclose(weights @ plane, there @ [1.0, 20.0, 300.0] + 4.0, atol=1e-10)
    np.testing.assert_allclose(weights.sum(1), 1)
    beyond = marching_tetrahedra.grid_weights(np.array([[1.01, 0, 0], [0, -2, 0]]), n)
    assert abs(beyond).sum() == 0


@pytest.mark.parametrize("nowhere", [np.inf, -np.inf, np.nan, 1e300])
def test_nothing_is_looked_up_nowhere(nowhere):
    """0 times infinity is NaN, and NaN as an index is an address outside of the grid."""
    points = np.zeros((3, 3))
    points[1, 2] = nowhere
    weights = marching_tetrahedra.grid_weights(points, 2)
    assert (weights.indices >= 0).all() and (weights.indices < 27).all()
    np.testing.assert_array_equal(weights @ np.ones(27), [1, 0, 1])


@pytest.mark.parametrize("n", [1, 2, 5])
def test_the_grid_fills_the_cube_with_tetrahedra_that_fit(n):
    """Some are turned over, overlap, or meet along crossing diagonals."""
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(n)
    assert points.shape == ((n + 1)**3, 3) and tetrahedra.shape == (6 * n**3, 4)
    a, b, c, d = points[tetrahedra.T]
    np.testing.assert_allclose(((b - a) * np.cross(c - a, d - a)).sum(-1) / 6, 8 / (6 * n**3))
    triangles = np.sort(tetrahedra[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3))
    triangles, count = np.unique(triangles, axis=0, return_counts=True)
    on_border = (np.abs(points[triangles].sum(1)) > 3 - 1e-9).any(-1)
    np.testing.assert_array_equal(count, np.where(on_border, 1, 2))


def test_64_cubed_cells_take_half_a_second_at_most():
    """All tetrahedra are worked on, and not only those that the surface crosses."""
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(64)
    distance = implicit_surfaces.signed_distance(points, ("torus", 0.6, 0.25))
    seconds = []
    for _ in range(3):
        start = time.process_time()
        vertices, _, ends = marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)
        marching_tetrahedra.marching_tetrahedra_backward(vertices, ends, points, distance)
        seconds.append(time.process_time() - start)
    assert min(seconds) <= 0.5


def test_a_crossing_on_paper():
    """The nearer end is the one of less distance, the signs or the two weights are swapped, a guard
    is added to s_b - s_a, or small distances are cut off.
    """
    p_a, p_b = np.array([[1.0, 2.0, 3.0]] * 3), np.array([[5.0, -2.0, 3.0]] * 3)
    s_a, s_b = np.array([-1.0, -3.0, -2.0]), np.array([3.0, 1.0, 0.0])
    for unit in 1e-9, 1e-3, 1.0, 1e6:
        got = marching_tetrahedra.zero_crossing(p_a, p_b, unit * s_a, unit * s_b)
        np.testing.assert_allclose(got, [[2.0, 1.0, 3.0], [4.0, -1.0, 3.0], [5.0, -2.0, 3.0]])
