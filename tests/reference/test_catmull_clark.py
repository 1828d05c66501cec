"""What Catmull and Clark's scheme composes: S of whole meshes, several steps, and limits."""
import numpy as np
import pytest
import triangle_meshes
from subdivision_meshes import CUBE_VERTICES, farthest, published
from triangle_meshes import POLYGONS, each_polygon_mesh, valence_and_boundary

from reference import catmull_clark, subdivision

# --- both versions, and others' ------------------------------------------------------------------

@each_polygon_mesh
def test_catmull_clarks_matrix_agrees_with_the_slow_version(vertices, corners, counts):
    """Two versions of one scheme that differ at a hole. And a second step, of quads only."""
    for _ in range(2):
        slow = catmull_clark.catmull_clark_slow(vertices, corners, counts)
        vertices, corners, counts = catmull_clark.catmull_clark(vertices, corners, counts)
        np.testing.assert_allclose(vertices, slow, rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", ["pyramid", "square"])
def test_two_steps_of_catmull_clark_are_the_published_ones(name):
    """Another boundary rule than OpenSubdiv's smooth corners, or other rules for triangles."""
    polygons = published(name, "vertices", "corners", "counts")
    for expected in published(name, "step_1", "step_2"):
        polygons = catmull_clark.catmull_clark(*polygons)
        assert farthest(polygons[0], expected) < 1e-6


def test_a_cube_after_a_step_of_catmull_clark():
    """Points of a cube that many texts print: 5/9 at the corners, 3/4 on the edges, 1 on faces."""
    new, _, _ = catmull_clark.catmull_clark(*POLYGONS["cube"])
    np.testing.assert_allclose(new[:8], 5 / 9 * CUBE_VERTICES, rtol=1e-14)
    np.testing.assert_allclose(np.sort(np.abs(new[8:20]), 1), np.tile([0, 3 / 4, 3 / 4], (12, 1)))
    np.testing.assert_allclose(np.sort(np.abs(new[20:]), 1), np.tile([0, 0, 1.0], (6, 1)))


# --- what a step keeps ---------------------------------------------------------------------------

@each_polygon_mesh
def test_catmull_clark_keeps_the_topology(vertices, corners, counts):
    """A seam opens or closes: Euler's number, boundary edges doubled, as many quads as corners."""
    _, _, before = subdivision.topology(corners, counts, len(vertices))
    new, *quads = catmull_clark.catmull_clark(vertices, corners, counts)
    _, _, after = subdivision.topology(*quads, len(new))
    assert len(quads[1]) == counts.sum() and after.sum() == 2 * before.sum()
    assert (subdivision.euler_characteristic(*quads)
            == subdivision.euler_characteristic(corners, counts))


@each_polygon_mesh
def test_catmull_clark_makes_one_extraordinary_vertex_of_each_polygon_that_is_no_quad(
        vertices, corners, counts):
    """Old valences change, or the number grows after the first step, too."""
    old, old_boundary = valence_and_boundary(corners, counts, len(vertices))
    expected = subdivision.is_extraordinary(old, old_boundary, 4).sum() + (counts != 4).sum()
    for _ in range(3):
        count, n_before = len(vertices), old
        vertices, corners, counts = catmull_clark.catmull_clark(vertices, corners, counts)
        old, at_boundary = valence_and_boundary(corners, counts, len(vertices))
        np.testing.assert_array_equal(old[:count], n_before)
        assert subdivision.is_extraordinary(old, at_boundary, 4).sum() == expected


def test_a_cube_stays_symmetric():
    """A direction is preferred: its 48 symmetries."""
    step = catmull_clark.catmull_clark
    triangle_meshes.require_symmetric(step(*step(*POLYGONS["cube"]))[0])


# --- boundaries and limits -----------------------------------------------------------------------

@each_polygon_mesh
def test_catmull_clarks_boundary_is_the_same_curve(vertices, corners, counts):
    """A face point pulls at the curve, or corners are held."""
    S = catmull_clark.catmull_clark_matrix(corners, counts, len(vertices))
    triangle_meshes.require_spline(S, corners, counts, len(vertices))


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
    """(10) is not the limit of (8) and (9)."""
    vertices, corners, counts = catmull_clark.catmull_clark(vertices, corners, counts)
    before = catmull_clark.catmull_clark_limit_matrix(corners, counts, len(vertices)) @ vertices
    new = catmull_clark.catmull_clark(vertices, corners, counts)
    after = catmull_clark.catmull_clark_limit_matrix(*new[1:], len(new[0])) @ new[0]
    np.testing.assert_allclose(after[:len(vertices)], before, rtol=0, atol=1e-14)


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
