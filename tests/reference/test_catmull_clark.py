"""What Catmull and Clark's scheme composes: S of whole meshes, several steps, and limits."""
import numpy as np
import pytest
from subdivision_meshes import farthest
from triangle_meshes import each_polygon_mesh

from reference import catmull_clark, subdivision

# --- both versions, and others' ------------------------------------------------------------------

@each_polygon_mesh
def test_catmull_clarks_matrix_agrees_with_the_slow_version(vertices, corners, counts):
    """Two versions of one scheme that differ at a hole. And a second step, of quads only."""
    for _ in range(2):
        slow, quads = catmull_clark.catmull_clark_slow(vertices, corners, counts)
        vertices, corners, counts = catmull_clark.catmull_clark(vertices, corners, counts)
        np.testing.assert_allclose(vertices, slow, rtol=0, atol=1e-12)
        np.testing.assert_array_equal(corners, quads.ravel())


# --- boundaries and limits -----------------------------------------------------------------------

def test_a_boundary_is_a_cubic_spline():
    """Another curve: a square's boundary tends to the uniform cubic B-spline of its corners."""
    corners = np.array([[0.0, 0], [8, 0], [8, 8], [0, 8]])
    new = corners, np.arange(4), np.array([4])
    for _ in range(4):
        new = catmull_clark.catmull_clark(*new)
    limit = catmull_clark.catmull_clark_limit_matrix(*new[1:], len(new[0])) @ new[0]
    t = np.arange(16)[:, None] / 16
    basis = np.hstack([(1 - t)**3, 3 * t**3 - 6 * t**2 + 4, 1 + 3 * t + 3 * t**2 - 3 * t**3, t**3])
    spline = np.concatenate([basis @ np.roll(corners, -k, axis=0) / 6 for k in range(4)])
    edges, _, is_boundary = subdivision.topology(*new[1:], len(new[0]))
    assert farthest(limit[np.unique(edges[is_boundary])], spline) < 1e-12


@each_polygon_mesh
def test_a_step_does_not_change_catmull_clarks_limit(vertices, corners, counts):
    """(10) is not the limit of (8) and (9), or a mesh moves when the origin does."""
    vertices, corners, counts = catmull_clark.catmull_clark(vertices, corners, counts)
    limit = catmull_clark.catmull_clark_limit_matrix(corners, counts, len(vertices))
    np.testing.assert_allclose(limit.sum(1), 1, rtol=0, atol=1e-14)
    new = catmull_clark.catmull_clark(vertices, corners, counts)
    after = catmull_clark.catmull_clark_limit_matrix(*new[1:], len(new[0])) @ new[0]
    np.testing.assert_allclose(after[:len(vertices)], limit @ vertices, rtol=0, atol=1e-14)


# --- broken input --------------------------------------------------------------------------------

def test_counts_that_do_not_fit_are_refused():
    """A face of two corners, corners that belong to no face, floats, a limit of triangles."""
    vertices, corners = np.zeros((4, 3)), np.array([0, 1, 2, 3])
    for counts in [2, 2], [3], [4, 4]:
        with pytest.raises(ValueError, match="counts must be at least 3 for each face and add up"):
            catmull_clark.catmull_clark(vertices, corners, np.array(counts))
    with pytest.raises(ValueError, match=r"counts must be integers in a row, .* float64"):
        catmull_clark.catmull_clark(vertices, corners, np.array([4.0]))
    with pytest.raises(ValueError, match="counts must be at least 3"):
        catmull_clark.catmull_clark_limit_matrix(corners, np.array([3]), 4)
    with pytest.raises(ValueError, match="face 1 is no quad: the limit is known for quads only"):
        catmull_clark.catmull_clark_limit_matrix(np.array([0, 1, 2, 3, 2, 1, 4]),
                                                 np.array([4, 3]), 5)
