"""course.given.mesh: shapes, normals and edges."""
import re

import numpy as np
import pytest

from course.given import inputs, mesh
from labkit.checks import assert_equal

SHAPES = {  # name: faces per n^2, smallest n, V - E + F, boundary edges for n
    "cube":      (12, 1, 2, lambda n: 0),
    "icosphere": (20, 1, 2, lambda n: 0),
    "torus":     (4, 3, 0, lambda n: 0),
    "plane":     (2, 1, 1, lambda n: 4 * n),
    "grid":      (2, 1, 1, lambda n: 4 * n)}
TRIANGLE = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])


def signed_volume(vertices, faces):
    a, b, c = vertices[faces.T]
    return np.linalg.det(np.stack([a, b, c], axis=1)).sum() / 6


# The given meshes


@pytest.mark.parametrize(("given", "counts", "boundary"), [
    (mesh.bunny, (1839, 3674, 5511), 0), (mesh.teapot, (792, 992, 1752), 528)])
def test_the_bunny_is_closed_and_the_teapot_open(given, counts, boundary):
    """A vertex lost, merged or split on the way into the repository or out of the file."""
    vertices, faces = given()
    assert (len(vertices), len(faces), len(mesh.edges(faces)[0])) == counts
    assert len(mesh.boundary_edges(faces)) == boundary


@pytest.mark.parametrize("given", [mesh.bunny, mesh.teapot])
def test_a_given_mesh_is_wound_outwards_with_y_up(given):
    """Faces clockwise, or axes exchanged."""
    vertices, faces = given()
    assert signed_volume(*given()) > 0
    normals = mesh.face_normals(vertices, faces)
    highest, lowest = (vertices[faces, 1].sum(axis=1).argsort()[k] for k in (-1, 0))
    assert normals[highest, 1] > 0.2 and normals[lowest, 1] < -0.2


# What a mesh is


@pytest.mark.parametrize(("vertices", "faces", "sentence"), [
    (np.zeros((3, 2)), TRIANGLE[1], "(V, 3) of floating point numbers, got (3, 2) of float64"),
    (np.zeros(9), TRIANGLE[1], "got (9,) of float64"),
    (np.zeros((3, 3), int), TRIANGLE[1], "got (3, 3) of int64"),
    (TRIANGLE[0], TRIANGLE[1][:0], "a mesh needs at least one face, got none"),
    (TRIANGLE[0][:0], TRIANGLE[1], "face 0 names vertex 0, but there are 0 vertices"),
    (TRIANGLE[0] + [[0], [np.inf], [0]], TRIANGLE[1], "vertex 1 is [inf, inf, inf]"),
    (TRIANGLE[0], np.array([[0, 1, -1]]), "face 0 names vertex -1")])
def test_check_says_what_is_wrong(vertices, faces, sentence):
    """Negative indices count from the end in NumPy, NaN spreads: both without a word."""
    with pytest.raises(ValueError, match=re.escape(sentence)):
        inputs.require_mesh(vertices, faces)


# Shapes


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("n", [3, 4, 7])
def test_a_shape_has_the_fewest_faces_that_are_enough(name, n):
    """One step too many or too few at the exact count and next to it."""
    per_square = SHAPES[name][0]
    for face_count, expected in ((per_square * n * n, n), (per_square * n * n + 1, n + 1)):
        vertices, faces = getattr(mesh, name)(face_count)
        assert len(faces) == per_square * expected ** 2
        inputs.require_mesh(vertices, faces)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("face_count", [1, 200])
def test_a_shape_is_whole_and_shares_its_vertices(name, face_count):
    """Seams left open, points doubled or unused, poles pinched; one face, or one side of the cube,
    turned inside out; one face gives a torus of two steps, which is flat.
    """
    per_square, smallest, euler, boundary = SHAPES[name]
    vertices, faces = getattr(mesh, name)(face_count)
    n = round((len(faces) / per_square) ** 0.5)
    assert n == smallest or face_count > 1
    edges, _ = mesh.edges(faces)
    assert len(vertices) - len(edges) + len(faces) == euler
    assert len(mesh.boundary_edges(faces)) == boundary(n)
    assert len(np.unique(vertices.round(9), axis=0)) == len(vertices) == len(np.unique(faces))
    assert np.linalg.norm(mesh.face_normals(vertices, faces), axis=1) == pytest.approx(1)
    directed = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    assert len(np.unique(directed, axis=0)) == len(directed)


@pytest.mark.parametrize(("name", "volume"), [
    ("cube", 8), ("icosphere", 4 / 3 * np.pi), ("torus", 2 * np.pi ** 2 * 0.4 ** 2)])
def test_a_closed_shape_has_its_positive_volume(name, volume):
    """Everything inside out, or the wrong size."""
    assert signed_volume(*getattr(mesh, name)(20_000)) == pytest.approx(volume, rel=2e-3)


def test_shapes_lie_where_their_surface_is():
    """A sphere that is not round, a torus around another axis, a plane that faces down."""
    vertices, _ = mesh.cube(108)
    np.testing.assert_array_equal(np.abs(vertices).max(axis=1), 1)
    vertices, _ = mesh.icosphere(500)
    np.testing.assert_allclose(np.linalg.norm(vertices, axis=1), 1, rtol=1e-15)
    x, y, z = mesh.torus(500, radius=2.0, tube=0.5)[0].T
    np.testing.assert_allclose((np.hypot(x, z) - 2) ** 2 + y ** 2, 0.25, rtol=1e-12)
    vertices, faces = mesh.plane(18)
    assert vertices.min(axis=0).tolist() == [-1, 0, -1]
    assert vertices.max(axis=0).tolist() == [1, 0, 1]
    np.testing.assert_array_equal(mesh.face_normals(vertices, faces), [[0, 1, 0]] * 18)
    vertices, faces = mesh.grid(18)
    assert {tuple(v) for v in vertices} == {(x, y, 0) for x in range(4) for y in range(4)}
    np.testing.assert_array_equal(mesh.face_normals(vertices, faces), [[0, 0, 1]] * 18)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("face_count", [0, -5, np.nan, np.inf])
def test_fewer_than_one_face_is_refused(name, face_count):
    """An empty mesh that fails far from its cause."""
    with pytest.raises(ValueError, match=r"^face_count must be at least 1, got (0|-5|nan|inf)$"):
        getattr(mesh, name)(face_count)


@pytest.mark.parametrize(("radius", "tube"), [(1, 1), (1, 0), (-1, 0.5), (np.nan, 0.5)])
def test_a_torus_that_meets_itself_is_refused(radius, tube):
    """A surface through its own axis."""
    with pytest.raises(ValueError, match=r"^a torus needs 0 < tube < radius, got tube"):
        mesh.torus(100, radius, tube)


def test_normalize_fits_any_mesh_into_the_unit_sphere():
    """Axes scaled apart, the mean for the box's centre, the box's side for the distance."""
    vertices = np.array([[2.0, 0, 0], [4, 0, 0], [2, 6, 0], [2, 0, 3], [2, 0, 0]])
    moved = mesh.normalize(vertices)
    half = 3.5  # of the box's diagonal, 2 x 6 x 3
    np.testing.assert_allclose(moved[1] - moved[0], [2 / half, 0, 0])
    assert np.linalg.norm(moved, axis=1).max() == pytest.approx(1)
    np.testing.assert_allclose(moved.min(axis=0) + moved.max(axis=0), 0, atol=1e-15)
    np.testing.assert_allclose(moved[0], np.array([-1, -3, -1.5]) / half)
    with pytest.raises(ValueError, match=r"^all vertices are in one place: "):
        mesh.normalize(np.ones((4, 3)))
    with pytest.raises(ValueError, match=r"^there are no vertices to scale: "):
        mesh.normalize(np.ones((0, 3)))


# Normals


def test_vertex_normals_weigh_faces_by_area():
    """All faces with the same weight: a sliver would turn the normal as much as a wall."""
    vertices = np.array([[0.0, 0, 0], [4, 0, 0], [0, 1, 0], [0, 0, 3], [9, 9, 9]])
    faces = np.array([[0, 1, 2], [0, 2, 3]])  # areas 2 and 1.5, normals +z and +x
    normals = mesh.vertex_normals(vertices, faces)
    np.testing.assert_allclose(normals[[0, 2]], [[0.6, 0, 0.8]] * 2)
    np.testing.assert_array_equal(normals[[1, 3, 4]], [[0, 0, 1], [1, 0, 0], [0, 0, 0]])


def test_a_degenerate_face_has_no_normal():
    """NaN from 0 / 0, or the direction of a rounding error."""
    line = np.array([[0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.3, 0.6, 0.9]])
    assert np.cross(line[1] - line[0], line[2] - line[0]).any()  # rounded, it is not 0
    faces = np.array([[0, 1, 2], [0, 0, 1], [1, 1, 1]])
    np.testing.assert_array_equal(mesh.face_normals(line, faces), np.zeros((3, 3)))
    np.testing.assert_array_equal(mesh.vertex_normals(line, faces), np.zeros((3, 3)))


def test_a_tiny_or_thin_face_has_a_normal():
    """A guard with an absolute size: the mesh in metres would lose what it has in millimetres."""
    for size in (1e-60, 1e60):
        vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0.5, 1e-12, 0]]) * size
        np.testing.assert_array_equal(mesh.face_normals(vertices, TRIANGLE[1]), [[0, 0, 1]])


# Edges


def test_many_vertices_do_not_get_mixed_up_where_indices_have_32_bits(monkeypatch):
    """As in a browser: the product of two indices overflows, and nothing says so."""
    monkeypatch.setattr(np, "intp", np.int32)
    edges, _ = mesh.edges(np.array([[0, 69_999, 69_998]]))
    assert edges.dtype == np.int32
    assert edges.tolist() == [[0, 69_998], [0, 69_999], [69_998, 69_999]]


def test_edge_faces_are_the_faces_that_hold_the_edge():
    """A neighbour missed, doubled, or taken from another edge."""
    for _, faces in (mesh.teapot(), mesh.cube(48), TRIANGLE):
        edges, _ = mesh.edges(faces)
        slow = {tuple(edge): [] for edge in edges.tolist()}
        for face, (a, b, c) in enumerate(faces.tolist()):
            for edge in ((a, b), (b, c), (c, a)):
                slow[min(edge), max(edge)].append(face)
        expected = [faces_here + [-1] * (2 - len(faces_here)) for faces_here in slow.values()]
        assert mesh.edge_faces(faces).tolist() == expected


@pytest.mark.parametrize("kind", [np.uint8, np.int16, np.uint64])
def test_faces_of_any_integers_give_the_same(kind):
    """uint64 and int64 together are float64; 0 - 1 is 255."""
    vertices, faces = mesh.icosphere(80)
    other = faces.astype(kind)
    inputs.require_mesh(vertices, other)
    assert_equal((*mesh.edges(other), mesh.edge_faces(other)),
                 (*mesh.edges(faces), mesh.edge_faces(faces)))
    np.testing.assert_array_equal(mesh.split_longest(vertices, other, 100)[1],
                                  mesh.split_longest(vertices, faces, 100)[1])


def test_an_edge_of_three_faces_is_named():
    """A third face dropped without a word."""
    fan = np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    with pytest.raises(ValueError, match=r"^the edge between vertices 0 and 1 has 3 faces: at"):
        mesh.edge_faces(fan)
    assert len(mesh.edges(fan)[0]) == 7 and len(mesh.boundary_edges(fan)) == 6


def test_a_face_that_names_a_vertex_twice_has_no_edges():
    """An edge from a vertex to itself."""
    with pytest.raises(ValueError, match=r"^face 1 names a vertex twice \(\[3, 2, 3\]\): leave"):
        mesh.edges(np.array([[0, 1, 2], [3, 2, 3]]))


def test_adjacency_joins_neighbours_both_ways():
    """One direction only, an edge counted once for each of its faces, a vertex left out."""
    matrix = mesh.adjacency(np.array([[0, 1, 2], [3, 2, 1]]), 5).toarray()
    expected = [[0, 1, 1, 0, 0], [1, 0, 1, 1, 0], [1, 1, 0, 1, 0], [0, 1, 1, 0, 0], [0] * 5]
    np.testing.assert_array_equal(matrix, expected)


def test_no_faces_have_no_edges():
    """The largest index of an empty array."""
    none = np.zeros((0, 3), dtype=np.int64)
    edges, face_edges = mesh.edges(none)
    assert edges.shape == (0, 2) and face_edges.shape == (0, 3)
    assert mesh.edge_faces(none).shape == mesh.boundary_edges(none).shape == (0, 2)
    assert mesh.adjacency(none, 4).nnz == 0
