"""What the exercises of lab 13 must do: flips and tangential relaxation."""

import numpy as np
from regularization_graphs import angle, dense, graph

from labkit.checks import assert_close, assert_equal, exercise


@exercise("13.14")
def test_gains_on_paper(impl):
    """pi is not taken away, or the sign is wrong. The angles are at a and b, the ends of the edge,
    not opposite to it. They are those of the new faces, after the flip, or of a wrong face, as acd.
    One is missing, or halved. Cotangents are taken, or degrees.
    """
    half = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [3.0, -np.sqrt(3.0), 0.0]]
    wide = [[2.0, 1.0, 0.0], [-1.0, 1.0, 1.0], [0.0, 1.0, 0.0], [2.0, 1.0, 1.0]]
    bent = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]
    square = [[-3.0, 0.0, 1.0], [3.0, 0.0, 1.0], [0.0, 3.0, 1.0], [0.0, -3.0, 1.0]]
    kite = [[0.0, 0.0, -3.0], [0.0, 0.0, 3.0], [0.0, np.sqrt(27.0), 0.0], [0.0, -np.sqrt(3.0), 0.0]]
    expected = np.array([np.pi / 4 + np.pi / 3, 3 * np.pi / 4 + np.pi / 2, np.pi / 2 + np.pi,
                         np.pi / 2 + np.pi / 2, np.pi / 3 + 2 * np.pi / 3]) - np.pi
    assert_close(impl.delaunay_gain(np.array([half, wide, bent, square, kite])), expected)


@exercise("13.14")
def test_an_edge_is_delaunay_if_no_circle_holds_the_fourth_point(impl, rng):
    """In the plane the sign is that of the determinant that asks if d lies in the circle abc."""
    angles = (np.arange(4) + rng.uniform(0.1, 0.9, (60, 4))) * np.pi / 2
    around = np.stack([np.cos(angles), np.sin(angles), 0 * angles], -1)
    around *= rng.uniform(0.95, 1.05, (60, 4, 1))
    corners = np.empty((60, 4, 3))
    corners[:, [0, 2, 1, 3]] = around                               # a, c, b, d go round
    lifted = np.concatenate([corners[..., :2], (corners[..., :2]**2).sum(-1, keepdims=True),
                             np.ones((60, 4, 1))], -1)
    inside = np.linalg.det(lifted)
    a, b, c, _ = corners.swapaxes(0, 1)
    winding = np.cross(b - a, c - a)[:, 2]
    clear = np.abs(inside) > 1e-6
    gain = impl.delaunay_gain(corners)
    assert_equal(gain[clear] > 0, (inside * winding > 0)[clear])


@exercise("13.14")
def test_gains_are_sums_of_two_angles(impl, rng):
    """In space; the four corners come in another order; or an angle of another corner is taken."""
    corners = rng.normal(size=(9, 4, 3))
    expected = [angle(c, a, b) + angle(d, a, b) - np.pi for a, b, c, d in corners]
    assert_close(impl.delaunay_gain(corners), np.array(expected), atol=1e-7)


@exercise("13.14", fine_print=True)
def test_gains_of_tiny_angles_and_of_none(impl):
    """arccos: 1e-9 comes out as 0, and NaN where two corners coincide."""
    a, b = [0.0, 0.0, 2.0], [0.0, 1e-9, 2.0]
    c, d = [-1.0, 0.0, 2.0], [1e-9, 0.0, 2.0]
    got = impl.delaunay_gain(np.array([[a, b, c, d], [a, b, a, d], [a, b, c, b]]))
    assert_close(got, [1e-9 + np.pi / 4 - np.pi, np.pi / 4 - np.pi, 1e-9 - np.pi], rtol=1e-12)


@exercise("13.15")
def test_a_slide_on_paper(impl):
    """The part along n is not taken away, alone is kept, or is that of the mean, not of the move.
    It is the sum of the offsets, not the mean: not divided by the valence. The rate, or x, is left
    out. An edge pulls one end only. Without edges it is 0 / 0.
    """
    vertices = np.array([[1.0, 1.0, 1.0], [5.0, 1.0, 3.0], [1.0, 9.0, 3.0], [9.0, 8.0, 7.0]])
    normals = np.array([[0.6, 0.0, 0.8], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
    # The first one's move is (1, 2, 1), its part along n 1.4 n.
    expected = [[1.16, 3.0, 0.88], [3.0, 1.0, 3.0], [1.0, 9.0, 2.0], [9.0, 8.0, 7.0]]
    assert_close(impl.relax_step(vertices, normals, np.array([[0, 1], [0, 2]]), 0.5), expected)


@exercise("13.15")
def test_slides_are_at_right_angles_to_each_normal(impl, rng):
    """One normal for all; or the mean is weighted."""
    edges, _ = graph(rng)
    vertices, normals = rng.normal(size=(7, 3)), rng.normal(size=(7, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    expected = vertices.copy()
    for i in range(6):
        neighbours = [j for edge in edges.tolist() if i in edge for j in edge if j != i]
        move = vertices[neighbours].mean(0) - vertices[i]
        expected[i] += 0.3 * (move - (move @ normals[i]) * normals[i])
    assert_close(impl.relax_step(vertices, normals, edges, 0.3), expected)


@exercise("13.15", fine_print=True)
def test_without_a_normal_the_whole_move_counts(impl, rng):
    """NaN, where the normal is 0."""
    edges, _ = graph(rng)
    vertices = rng.normal(size=(7, 3))
    L = dense(edges, np.ones(len(edges)), 7)
    valence = np.maximum(np.diag(L), 1)[:, None]
    got = impl.relax_step(vertices, np.zeros((7, 3)), edges, 1.0)
    assert_close(got, vertices - L @ vertices / valence)
