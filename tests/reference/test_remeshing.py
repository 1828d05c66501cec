"""The reference on whole meshes: flips, relaxation, how far it moves a surface, broken input."""
import numpy as np
import pytest
import scipy.spatial

from course.given import distances, mesh
from course.scenes import relaxation
from reference import regularization, remeshing


def random_flips(vertices, faces, rng, count=200):
    """Some edges of a closed mesh flipped by chance, where that keeps it a manifold."""
    for _ in range(count):
        quads, quad_faces, _ = remeshing.edge_quads(faces)
        one = rng.integers(len(quads))
        edges, _ = mesh.edges(faces)
        if (edges == np.sort(quads[one, 2:])).all(1).any():
            continue
        faces = faces.copy()
        faces[quad_faces[one]] = remeshing.flip(quads[[one]])[0]
    return faces


def test_a_flip_takes_an_edge_from_two_vertices_and_gives_it_to_two_others():
    """After less before, squares instead of sums, or 6 for all."""
    valence = np.array([[7, 7, 5, 5], [6, 6, 6, 6], [7, 6, 6, 5], [5, 5, 7, 7], [9, 6, 5, 6]])
    target = np.array([[6, 6, 6, 6], [6, 6, 4, 6], [6, 6, 6, 6], [6, 6, 6, 6], [6, 6, 6, 6]])
    np.testing.assert_array_equal(remeshing.valence_gain(valence, target), [4, -4, 0, -4, 0])


def test_flips_in_the_plane_end_at_the_delaunay_triangulation():
    """Flips end too soon, or a flip breaks the mesh."""
    rng = np.random.default_rng(5)
    points = rng.uniform(0, 1, (200, 2))
    faces = scipy.spatial.Delaunay(points).simplices.astype(int)
    vertices = np.column_stack([points, 0 * points[:, 0]])
    goal = mesh.edges(faces)[0]
    for _ in range(300):  # flip edges by chance, as long as the two faces form a convex quad
        quads, quad_faces, _ = remeshing.edge_quads(faces)
        one = quads[[rng.integers(len(quads))]]
        if remeshing.can_flip(vertices, faces, one)[0]:
            where = (quads == one).all(1)
            faces = faces.copy()
            faces[quad_faces[where][0]] = remeshing.flip(one)[0]
    assert not np.array_equal(mesh.edges(faces)[0], goal)
    flipped = remeshing.flip_to_delaunay(vertices, faces)
    np.testing.assert_array_equal(mesh.edges(flipped)[0], goal)


def test_flips_bring_valences_to_6_and_keep_the_mesh_closed():
    """An edge of more than two faces, a face that looks inwards, or no better valences."""
    vertices, faces = mesh.icosphere(1280)
    shuffled = random_flips(vertices, faces, np.random.default_rng(2))
    flipped = remeshing.flip_to_valence_6(vertices, shuffled)
    off = [np.abs(np.bincount(mesh.edges(f)[0].ravel()) - 6).sum() for f in (shuffled, flipped)]
    assert off[1] < 0.5 * off[0]
    assert len(mesh.boundary_edges(flipped)) == 0 and (mesh.edge_faces(flipped) >= 0).all()
    assert len(mesh.edges(flipped)[0]) == len(mesh.edges(faces)[0])


def test_a_face_without_area_is_flipped_away():
    """Its normal is 0, and never like the others: it stays for ever."""
    vertices = np.array([[0.0, 0, 0], [4, 0, 0], [2, 0, 0], [1, -3, 0], [0, 5, 0], [4, 5, 0]])
    faces = np.array([[0, 1, 2], [1, 0, 3], [0, 2, 4], [2, 1, 5], [2, 5, 4]])
    flipped = remeshing.flip_to_delaunay(vertices, faces)
    assert {frozenset(face) for face in flipped[:2].tolist()} == {frozenset({0, 2, 3}),
                                                                  frozenset({1, 2, 3})}
    assert (mesh.face_normals(vertices, flipped) == [0, 0, 1]).all()


def farthest(vertices, faces, moved, flipped, count=4):
    """The largest distance between two surfaces, of points in each face and of all vertices."""
    b = np.random.default_rng(0).dirichlet([1, 1, 1], (count, len(faces), 1)).swapaxes(2, 3)
    found = []
    for (x, f), other in (((vertices, faces), (moved, flipped)),
                          ((moved, flipped), (vertices, faces))):
        points = np.concatenate([(b * x[f]).sum(2).reshape(-1, 3), x[np.unique(f)]])
        found.append(distances.distance_to_surface(points, *other).max())
    return max(found)


def test_a_bad_real_mesh_becomes_round_and_stays_where_it_is():
    """The teapot's triangles have a mean least angle of 23 degrees. At least 40 are asked for, and
    that neither surface is 0.5 % of the diagonal away from the other one, at any of its samples.
    """
    vertices, faces = relaxation.split_in_four(*mesh.merge(*mesh.teapot()))
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    moved, flipped = remeshing.relax(vertices, faces, 0.004 * diagonal)
    before, after = (regularization.corner_angles(x[f]).min(1) for x, f in
                     ((vertices, faces), (moved, flipped)))
    assert np.degrees(before.mean()) < 23 and np.degrees(after.mean()) >= 40
    assert len(mesh.boundary_edges(flipped)) == len(mesh.boundary_edges(faces))
    assert farthest(vertices, faces, moved, flipped, 1) < 0.005 * diagonal


@pytest.mark.parametrize("name, fraction, steps", [("bunny", 0.001, 0), ("bunny", 0.0, 1),
                                                   ("teapot", 0.002, 1)])
def test_no_surface_moves_by_more_than_twice_the_tolerance(name, fraction, steps):
    """Flips of bent quads, which moved the bunny by 3.4 tolerances and both without any. Or slides
    that are measured from the last surface, not from the first.
    """
    vertices, faces = mesh.merge(*getattr(mesh, name)())
    tolerance = fraction * np.linalg.norm(np.ptp(vertices, axis=0))
    moved, flipped = remeshing.relax(vertices, faces, tolerance, steps)
    assert np.array_equal(flipped, faces) == (fraction == 0)
    rounding = 1e-12 * np.abs(vertices).max()
    assert farthest(vertices, faces, moved, flipped) <= 2 * tolerance + rounding


def test_what_may_leave_a_surface_is_found():
    """Corners are looked at, and not what lies between them. Or the wrong side of the bound."""
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [3, 0, 2], [3, 1, 2]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]])   # a floor and a slope up
    across = np.array([[0.0, 0.5, 0.0], [3.0, 0.25, 2.0], [3.0, 0.75, 2.0]])
    within = np.array([[0.1, 0.2, 0.1], [0.9, 0.2, 0.1], [0.5, 0.9, -0.1]])
    leaves = remeshing.leaves(np.stack([across, within]), vertices, faces, 0.11)
    np.testing.assert_array_equal(leaves, [True, False])
    # Above (x, y), it is 2 x / 3 from the floor and (1 - x / 3) / sqrt 2 from the slope.
    height = 2 / 3 / (1 / 3 + 2 / 3 * np.sqrt(2))
    for bound, far in (0.95 * height, True), (1.2 * height, False):
        assert remeshing.leaves(across[None], vertices, faces, bound)[0] == far


# Broken input: a right answer, or one sentence

BOX, BOX_FACES = mesh.cube(48)
BOX = BOX + np.random.default_rng(4).normal(0, 0.02, BOX.shape)
A, B, C = BOX_FACES[0]
BROKEN = {
    "without a face": (BOX, BOX_FACES[1:]),
    "with an isolated vertex": (np.vstack([BOX, [5.0, 5.0, 5.0]]), BOX_FACES),
    "with a third face at an edge": (np.vstack([BOX, [3.0, 3.0, 3.0]]),
                                     np.vstack([BOX_FACES, [A, B, len(BOX)]])),
    "with a face twice": (BOX, np.vstack([BOX_FACES, BOX_FACES[0]])),
    "with a vertex twice": (np.vstack([BOX, BOX[A]]), np.vstack([[len(BOX), B, C], BOX_FACES[1:]])),
    "with a face turned round": (BOX, np.vstack([[C, B, A], BOX_FACES[1:]])),
    "with a face without area": (np.insert(np.delete(BOX, A, 0), A, BOX[[B, C]].mean(0), 0),
                                 BOX_FACES)}


@pytest.mark.parametrize("vertices, faces", BROKEN.values(), ids=BROKEN)
def test_a_broken_mesh_is_smoothed_and_relaxed(vertices, faces):
    """NaN, an error, or vertices beside the broken place that slide into it."""
    edges, weights, areas = regularization.cotangent_laplacian(vertices, faces)
    for smooth in regularization.smooth_explicit, regularization.smooth_implicit:
        assert np.isfinite(smooth(vertices, edges, weights, areas, 1e-3)).all()
    moved, flipped = remeshing.relax(vertices, faces, 1.0)
    assert np.isfinite(moved).all() and flipped.shape == faces.shape
    *_, held = remeshing.edge_quads(faces)
    np.testing.assert_array_equal(moved[held], vertices[held])
    assert set(map(tuple, held)) <= set(map(tuple, remeshing.edge_quads(flipped)[2]))
    unused = np.setdiff1d(np.arange(len(vertices)), faces)
    np.testing.assert_array_equal(moved[unused], vertices[unused])


def test_a_mesh_that_is_all_border_stays():
    """An error where no vertex is free."""
    vertices, faces = np.eye(3), np.array([[0, 1, 2]])
    moved, flipped = remeshing.relax(vertices, faces, 1.0)
    np.testing.assert_array_equal(moved, vertices)
    np.testing.assert_array_equal(flipped, faces)


@pytest.mark.parametrize("vertices, faces, sentence", [
    (np.eye(3), np.array([[0, 1, 1]]), "face 0 names a vertex twice"),
    (np.eye(3), np.array([[0, 1, 3]]), "face 0 names vertex 3, but there are 3 vertices"),
    (np.full((3, 3), np.nan), np.array([[0, 1, 2]]), "vertices must be finite"),
    (np.eye(3), np.zeros((0, 3), int), "at least one face")])
def test_what_is_no_mesh_is_refused_in_a_sentence(vertices, faces, sentence):
    """An index error from deep inside."""
    with pytest.raises(ValueError, match=sentence):
        remeshing.relax(vertices, faces, 1.0)


@pytest.mark.parametrize("asked", [(np.nan,), (-1.0,), (None,), (1.0, -3), (1.0, 2.5)])
def test_a_tolerance_or_steps_that_make_no_sense_are_refused(asked):
    """Nothing happens, or everything slides."""
    with pytest.raises(ValueError, match="tolerance >= 0 and a whole number steps >= 0, got"):
        remeshing.relax(BOX, BOX_FACES, *asked)


def test_lists_and_other_kinds_of_integers_are_meshes_too():
    """An error from deep inside."""
    expected = remeshing.relax(BOX, BOX_FACES, 1.0)
    for other in BOX_FACES.tolist(), BOX_FACES.astype(np.uint64), BOX_FACES.astype(np.int8):
        got = remeshing.relax(BOX.tolist(), other, 1.0)
        assert all(np.array_equal(*each) for each in zip(got, expected, strict=True))
