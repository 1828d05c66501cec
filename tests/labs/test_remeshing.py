"""What the exercises of lab 13 must do: flips and tangential relaxation."""

import numpy as np
from regularization_graphs import angle, dense, graph

from course.given import mesh
from labkit.checks import assert_close, assert_equal, exercise


@exercise("13.10")
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


@exercise("13.10")
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


@exercise("13.10")
def test_gains_are_sums_of_two_angles(impl, rng):
    """In space; the four corners come in another order; or an angle of another corner is taken."""
    corners = rng.normal(size=(9, 4, 3))
    expected = [angle(c, a, b) + angle(d, a, b) - np.pi for a, b, c, d in corners]
    assert_close(impl.delaunay_gain(corners), np.array(expected), atol=1e-7)


@exercise("13.10", fine_print=True)
def test_gains_of_tiny_angles_and_of_none(impl):
    """arccos: 1e-9 comes out as 0, and NaN where two corners coincide."""
    a, b = [0.0, 0.0, 2.0], [0.0, 1e-9, 2.0]
    c, d = [-1.0, 0.0, 2.0], [1e-9, 0.0, 2.0]
    got = impl.delaunay_gain(np.array([[a, b, c, d], [a, b, a, d], [a, b, c, b]]))
    assert_close(got, [1e-9 + np.pi / 4 - np.pi, np.pi / 4 - np.pi, 1e-9 - np.pi], rtol=1e-12)


def quads_of(faces):
    """The edges of two faces that wind alike: rows a, b, c, d (N, 4), and the two faces (N, 2)."""
    across = {}
    for f, face in enumerate(faces.tolist()):
        for k in range(3):
            across[face[k - 2], face[k - 1]] = f, face[k]
    pairs = [(a, b, *across[a, b], *across[b, a]) for a, b in sorted(across)
             if a < b and (b, a) in across]
    found = np.array(pairs).reshape(-1, 6)
    return found[:, [0, 1, 3, 5]], found[:, [2, 4]]


def turned(faces):
    """Each face from its least vertex on, all sorted: the same faces in another order are equal."""
    return np.array(sorted(np.roll(face, -np.argmin(face)).tolist() for face in faces))


def quads_apart(rng, radius):
    """Quads a b c d in space, far from each other -> vertices (4 Q, 3), faces (2 Q, 3).

    a, b and c lie on a circle, d within it if radius (Q,) is less than 1.
    """
    count = len(radius)
    angles = (np.arange(4) + rng.uniform(0.1, 0.9, (count, 4))) * np.pi / 2  # of a, d, b, c
    around = np.stack([np.cos(angles), np.sin(angles), 0 * angles], -1)
    around[:, 1] *= radius[:, None]
    vertices = around[:, [0, 2, 3, 1]] @ np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    number = 4 * np.arange(count)[:, None, None]
    return (vertices + 5 * number).reshape(-1, 3), (AB + number).reshape(-1, 3)


def flipped_pairs(faces, chosen):
    """The faces of `quads_apart`, where the quads (Q,) that are chosen have the edge c d."""
    number = 4 * np.arange(len(chosen))[:, None, None]
    return np.where(chosen[:, None, None], CD + number, AB + number).reshape(-1, 3)


AB = np.array([[0, 1, 2], [1, 0, 3]])
CD = np.array([[0, 3, 2], [1, 2, 3]])


@exercise("13.11")
def test_edges_that_are_not_delaunay_flip(impl, rng):
    """Nothing flips, all edges do, or the wrong ones: (8) is turned round. A face is written in the
    other one's place, or winds the other way. Only the best of all edges flips.
    """
    radius = rng.choice([0.8, 1.25], 40)
    vertices, faces = quads_apart(rng, radius)
    got = impl.flip_best(vertices, faces, *quads_of(faces))
    assert_equal(turned(got), turned(flipped_pairs(faces, radius < 1)))


@exercise("13.11")
def test_a_gain_that_is_given_decides(impl, rng):
    """The gain that comes is not looked at. A gain of 0, or one up to LEAST_GAIN, is enough."""
    vertices, faces = quads_apart(rng, np.full(40, 0.8))
    gain = rng.permutation(np.repeat([-1.0, 0.0, 1e-9, 1.1e-9, 0.5], 8))
    got = impl.flip_best(vertices, faces, *quads_of(faces), gain)
    assert_equal(turned(got), turned(flipped_pairs(faces, gain > 1e-9)))


def sheet(rng):
    """An uneven lattice in which every inner edge can flip: vertices, faces, gains of its quads."""
    vertices, faces = mesh.grid(50)
    vertices += 0.1 * rng.uniform(-1, 1, vertices.shape) * [1, 1, 0]
    quads, quad_faces = quads_of(faces)
    return vertices, faces, quads, quad_faces, rng.permutation(len(quads)) - len(quads) / 4


def best_of(quads, gain):
    """Which quads gain more than all others that share a vertex with them, one by one?"""
    shared = (quads[:, None, :, None] == quads[:, None]).any((2, 3))
    return [gain[q] > 0 and gain[q] == gain[shared[q]].max() for q in range(len(quads))]


def with_flips(faces, quads, quad_faces, chosen):
    """Faces in which the quads that are chosen have their edge c d."""
    faces = faces.copy()
    for q in np.flatnonzero(chosen):
        faces[quad_faces[q]] = quads[q][CD]
    return faces


@exercise("13.11")
def test_of_flips_that_share_a_vertex_the_best_one_is_done(impl, rng):
    """All of them flip, and undo each other or leave holes. The best counts at the two ends of the
    edge alone, and not at c and d; or one of its four vertices is enough. The least gain wins.
    """
    vertices, faces, quads, quad_faces, gain = sheet(rng)
    got = impl.flip_best(vertices, faces, quads, quad_faces, gain)
    expected = with_flips(faces, quads, quad_faces, best_of(quads, gain))
    assert_equal(turned(got), turned(expected))


@exercise("13.11")
def test_what_cannot_flip_stays(impl, rng):
    """`can_flip` is not asked: a bent quad flips, or an edge comes twice."""
    vertices, faces = quads_apart(rng, np.full(30, 0.8))
    bent, bridged = np.arange(30) % 3 == 1, np.arange(30) % 3 == 2
    vertices[np.flatnonzero(bent) * 4 + 3] += 2 * np.cross(*(vertices.reshape(-1, 4, 3)[bent, k]
                                                           - vertices.reshape(-1, 4, 3)[bent, 0]
                                                           for k in (1, 2)))
    number = 4 * np.flatnonzero(bridged)[:, None]
    more = np.concatenate([faces, np.hstack([number + 3, number + 2, 120 + number // 4])])
    given = np.concatenate([vertices, 1000 + rng.normal(size=(30, 3))])
    got = impl.flip_best(given, more, *quads_of(faces), np.ones(30))
    expected = np.concatenate([flipped_pairs(faces, ~bent & ~bridged), more[60:]])
    assert_equal(turned(got), turned(expected))


@exercise("13.11")
def test_what_cannot_flip_holds_nobody_back(impl, rng):
    """`can_flip` is asked last: an edge whose best neighbour cannot flip waits for ever."""
    vertices, faces, quads, quad_faces, gain = sheet(rng)
    fixed = rng.permutation(len(quads)) < len(quads) / 3
    beyond = len(vertices) + np.arange(fixed.sum())[:, None]
    more = np.concatenate([faces, np.hstack([quads[fixed][:, 2:], beyond])])  # c d is there already
    given = np.concatenate([vertices, 9 + rng.normal(size=(fixed.sum(), 3))])
    got = impl.flip_best(given, more, quads, quad_faces, gain)
    able = np.where(fixed, -1.0, gain)
    expected = with_flips(more, quads, quad_faces, best_of(quads, able))
    assert_equal(turned(got), turned(expected))


@exercise("13.11")
def test_again_and_again_it_ends_where_no_circle_holds_a_fourth_point(impl, rng):
    """In the plane. A flip is worse than none, or some edges are never tried."""
    vertices, faces = mesh.grid(50)
    inner = ((vertices > 0) & (vertices < 5))[:, :2].all(1, keepdims=True)
    vertices += inner * rng.uniform(-0.3, 0.3, vertices.shape) * [1, 1, 0]
    vertices[:, 0] += 1.3 * vertices[:, 1]
    for _ in range(30):
        faces = np.asarray(impl.flip_best(vertices, faces, *quads_of(faces)))
    a, b, c, d = vertices[quads_of(faces)[0]].swapaxes(0, 1)
    rows = [np.append(p - d, ((p - d)**2).sum(1, keepdims=True), 1)[:, [0, 1, 3]]
            for p in (a, b, c)]
    inside = np.linalg.det(np.stack(rows, 1))
    assert_equal(inside < 1e-6, np.ones(len(inside), bool))


@exercise("13.11", fine_print=True)
def test_of_equal_flips_the_last_one_is_done(impl, rng):
    """Both flip, neither does, or the first one does. No quads: an error from inside."""
    vertices, faces, quads, quad_faces, _ = sheet(rng)
    got = impl.flip_best(vertices, faces, quads, quad_faces, np.ones(len(quads)))
    expected = with_flips(faces, quads, quad_faces, best_of(quads, 1.0 + np.arange(len(quads))))
    assert_equal(turned(got), turned(expected))
    got = impl.flip_best(vertices, faces, quads[:0], quad_faces[:0])
    assert_equal(turned(got), turned(faces))


@exercise("13.12")
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


@exercise("13.12")
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


@exercise("13.12", fine_print=True)
def test_without_a_normal_the_whole_move_counts(impl, rng):
    """NaN, where the normal is 0."""
    edges, _ = graph(rng)
    vertices = rng.normal(size=(7, 3))
    L = dense(edges, np.ones(len(edges)), 7)
    valence = np.maximum(np.diag(L), 1)[:, None]
    got = impl.relax_step(vertices, np.zeros((7, 3)), edges, 1.0)
    assert_close(got, vertices - L @ vertices / valence)
