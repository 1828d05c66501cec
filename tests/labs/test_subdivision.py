"""What the exercises of lab 11 must do."""
from pathlib import Path

import numpy as np
import pytest

from course.checks import Mismatch, assert_close, assert_equal, exercise
from course.given import mesh

PUBLISHED = Path(__file__).parents[1] / "golden" / "subdivision.npz"  # see the README there

# A hub of valence 5 inside, and one of 4 on the boundary; vertices 3 and 9 belong to no face.
FAN = np.array([[0, 1, 2], [0, 2, 4], [0, 4, 5], [0, 5, 6], [0, 6, 1], [7, 6, 5], [8, 6, 7]])
# A band with one twist: 10 triangles, one boundary, no way to wind all of them alike.
MOEBIUS = np.array([[k, (k + 1) % 10, (k + 2) % 10] for k in range(10)])
TETRAHEDRON = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]])

TRIANGLES = {  # name -> vertex count, faces
    "one triangle": (3, np.array([[2, 0, 1]])),
    "tetrahedron": (4, TETRAHEDRON),
    "fan, open": (10, FAN),
    "octahedron and fan": (16, np.concatenate([FAN[:, [1, 2, 0]], 10 + np.array(
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
         [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])])),
    "torus": (18, mesh.torus(36)[1]),
    "band with a twist": (10, MOEBIUS),
    "wound either way": (4, np.array([[0, 1, 2], [0, 3, 2], [0, 3, 1], [1, 2, 3]])),
}
CUBE = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
POLYGONS = {  # name -> vertex count, the faces
    "one pentagon": (6, [[4, 0, 3, 1, 5]]),
    "tetrahedron": (4, TETRAHEDRON.tolist()),
    "cube": (8, CUBE),
    "pyramid": (5, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [4, 3, 2, 1]]),
    "house": (10, [[0, 1, 2, 3], [3, 2, 6, 9, 7], [1, 0, 4, 8, 5], [2, 1, 5, 6], [0, 3, 7, 4],
                   [6, 5, 8], [6, 8, 9], [7, 9, 8, 4]]),
    "house, open": (12, [[0, 1, 2, 3], [3, 2, 4, 5, 6], [2, 1, 7], [7, 8, 4, 2], [6, 5, 10]]),
    "cube and pentagon": (15, [*CUBE, [14, 13, 12, 11, 9]]),
}
each_mesh = pytest.mark.parametrize("count, faces", TRIANGLES.values(), ids=TRIANGLES)
each_polygon_mesh = pytest.mark.parametrize("count, faces", POLYGONS.values(), ids=POLYGONS)


def flat(faces):
    """Lists of corners -> corners, counts."""
    return np.concatenate([np.array(face) for face in faces]), np.array([len(f) for f in faces])


def sides(face):
    """A face's edges, low < high, each from a corner to the next."""
    face = [int(v) for v in face]
    return [tuple(sorted(pair)) for pair in zip(face, face[1:] + face[:1], strict=True)]


def topology(faces):
    """edges (E, 2), corner_edge (C,), is_boundary (E,), by a dictionary."""
    every = [side for face in faces for side in sides(face)]
    number = {edge: k for k, edge in enumerate(sorted(set(every)))}
    return (np.array(list(number)), np.array([number[side] for side in every]),
            np.array([every.count(edge) == 1 for edge in number]))


def neighbours(v, edges):
    return [int(a + b - v) for a, b in edges if v in (a, b)]


def dense(entries, shape):
    """The matrix that entries (rows, columns, weights) add up to."""
    matrix = np.zeros(shape)
    if not isinstance(entries, tuple) or len(entries) != 3:
        raise Mismatch(("wrong", "entries are a tuple of three: rows, columns, weights"))
    rows, columns, weights = map(np.asarray, entries)
    if not rows.shape == columns.shape == weights.shape == (rows.size,):
        raise Mismatch(("wrong", "rows, columns and weights must be rows of numbers, equally long; "
                        f"got {rows.shape}, {columns.shape}, {weights.shape}"))
    np.add.at(matrix, (rows, columns), weights)
    return matrix


def old_vertices(count, edges, is_boundary, u, beside):
    """Eq. (4) or (6) as a matrix (V, V), row by row."""
    matrix = np.eye(count)
    for v in range(count):
        along = neighbours(v, edges[is_boundary])
        for other in along or neighbours(v, edges):
            matrix[v, other] += beside if along else u[v]
        matrix[v, v] = 2 - matrix[v].sum()
    return matrix


def loop_of(count, faces, u):
    """Loop's S, dense (V + E, V), edge by edge."""
    edges, _, is_boundary = topology(faces)
    rows = [*old_vertices(count, edges, is_boundary, u, 1 / 8)]
    for edge in edges:
        opposite = [v for face in faces if set(edge) <= set(face) for v in face if v not in edge]
        row = np.zeros(count)
        row[edge] = 1 / 2 if len(opposite) == 1 else 3 / 8
        row[opposite if len(opposite) == 2 else []] = 1 / 8
        rows.append(row)
    return np.array(rows)


def mean_of(corners, count):
    return np.bincount(corners, minlength=count) / len(corners)


def catmull_clark_of(count, faces):
    """Catmull and Clark's S, dense (V + E + F, V), point by point."""
    edges, _, is_boundary = topology(faces)
    points, one = np.array([mean_of(face, count) for face in faces]), np.eye(count)
    rows = [*old_vertices(count, edges, is_boundary, np.zeros(count), 1 / 8)]
    for v in range(count):
        ring = neighbours(v, edges)
        if ring and not neighbours(v, edges[is_boundary]):
            n, around = len(ring), points[[v in face for face in faces]]
            rows[v] = (around.mean(0) + 2 * mean_of([v] * n + ring, count) + (n - 3) * one[v]) / n
    for edge, alone in zip(edges, is_boundary, strict=True):
        beside = points[[tuple(edge) in sides(face) for face in faces]]
        rows.append(one[edge].mean(0) if alone else (one[edge].sum(0) + beside.sum(0)) / 4)
    return np.concatenate([rows, points])


def valence_of(count, edges):
    return np.array([len(neighbours(v, edges)) for v in range(count)])


# --- who is near whom --------------------------------------------------------------------------

@exercise("11.1")
def test_edges_of_two_triangles(impl):
    """The shared edge comes twice, or an edge runs from high to low."""
    edges, corner_edge = impl.edges_of(np.array([7, 5, 1, 5, 7, 9]), np.array([3, 3]))
    assert_equal(edges, np.array([[1, 5], [1, 7], [5, 7], [5, 9], [7, 9]]))
    assert_equal(corner_edge, np.array([2, 0, 1, 2, 4, 3]))


@exercise("11.1")
@each_polygon_mesh
def test_edges_are_those_of_a_dictionary(impl, count, faces):
    """The last corner of a face is joined to the next face, or all faces count as triangles."""
    edges, corner_edge, _ = topology(faces)
    assert_equal(impl.edges_of(*flat(faces)), (edges, corner_edge))


@exercise("11.1")
def test_edges_of_large_numbers(impl):
    """Pairs that are packed into one number, too small for them."""
    for integer in np.int64, np.int32, np.uint64:
        edges, _ = impl.edges_of(np.array([0, 70_000, 140_000], integer), np.array([3]))
        assert_equal(edges, np.array([[0, 70_000], [0, 140_000], [70_000, 140_000]]))
    corners = np.array([0, 5, 7, 0, 7, 1_000_007, 0, 10_000_007, 17])
    edges, corner_edge = impl.edges_of(corners, np.array([3, 3, 3]))
    assert_equal(edges, np.array([[0, 5], [0, 7], [0, 17], [0, 1_000_007], [0, 10_000_007], [5, 7],
                                  [7, 1_000_007], [17, 10_000_007]]))
    assert_equal(corner_edge, np.array([0, 5, 1, 1, 6, 3, 4, 7, 2]))


@exercise("11.1")
@pytest.mark.parametrize("integer", [np.uint8, np.int16, np.uint32, np.uint64])
def test_counts_of_any_integer_type(impl, integer):
    """A sum of unsigned numbers, which cannot be an index or become negative."""
    corners = np.array([0, 1, 2, 2, 1, 4, 3], integer)
    edges, corner_edge = impl.edges_of(corners, np.array([3, 4], integer))
    assert_equal(edges, np.array([[0, 1], [0, 2], [1, 2], [1, 4], [2, 3], [3, 4]]))
    assert_equal(corner_edge, np.array([0, 2, 1, 2, 3, 5, 4]))


@exercise("11.2")
def test_ordinary_vertices_inside_and_on_the_boundary(impl):
    """On the boundary, half the valence and one more is regular, not half of it."""
    valence = np.array([6, 4, 3, 6, 4, 3, 2, 0, 0, 1])
    at_boundary = np.array([0, 0, 0, 1, 1, 1, 1, 0, 1, 0], bool)
    assert_equal(impl.is_extraordinary(valence, at_boundary, 6),
                 np.array([0, 1, 1, 1, 0, 1, 1, 0, 0, 1], bool))
    assert_equal(impl.is_extraordinary(valence, at_boundary, 4),
                 np.array([1, 0, 1, 1, 1, 0, 1, 0, 0, 1], bool))


@exercise("11.3")
@pytest.mark.parametrize("name, expected", [
    ("one triangle", 1), ("tetrahedron", 2), ("torus", 0), ("octahedron and fan", 3),
    ("band with a twist", 0)])
def test_euler_characteristic_of_triangles(impl, name, expected):
    """Vertices of no face are counted, or edges twice."""
    faces = TRIANGLES[name][1]
    assert_equal(impl.euler_characteristic(faces.ravel(), np.full(len(faces), 3)), expected)


@exercise("11.3")
@pytest.mark.parametrize("name, expected", [
    ("cube", 2), ("house", 2), ("house, open", 1), ("cube and pentagon", 3)])
def test_euler_characteristic_of_polygons(impl, name, expected):
    """All faces are taken for triangles."""
    assert_equal(impl.euler_characteristic(*flat(POLYGONS[name][1])), expected)


# --- Loop, point by point ----------------------------------------------------------------------

@exercise("11.4")
def test_loops_own_weights(impl):
    """The square, the cosine's quarter or the division by n is forgotten; degrees for radians."""
    n = np.array([2, 3, 4, 6, 12])
    total = np.array([5 / 8 - 1 / 64, 9 / 16, 5 / 8 - 9 / 64, 3 / 8,
                      5 / 8 - (3 + np.sqrt(3)) ** 2 / 64])
    assert_close(impl.loop_weight(n), total / n)
    assert_close(impl.loop_weight(n[:, None]), (total / n)[:, None])


@exercise("11.5")
def test_a_triangle_alone_on_paper(impl):
    """Corners stay, or the inside's rules are used on the boundary."""
    got = impl.loop_slow(np.array([[0.0, 0.0], [8.0, 0.0], [0.0, 16.0]]), np.array([[1, 2, 0]]),
                         np.full(3, 9.0))
    assert_close(got, np.array([[1, 2], [6, 2], [1, 12], [4, 0], [0, 8], [4, 8.0]]))


@exercise("11.5")
def test_a_tetrahedrons_points_on_paper(impl):
    """3/8 and 1/8 are swapped, or u is the weight of all neighbours together."""
    got = impl.loop_slow(np.array([[16.0], [0.0], [0.0], [8.0]]), TETRAHEDRON,
                         np.array([1 / 8, 1 / 8, 1 / 4, 3 / 16]))
    assert_close(got.T, np.array([[11, 3, 6, 6.5, 7, 7, 9, 3, 5, 5]]))


@exercise("11.5")
def test_a_vertex_of_no_face_stays(impl):
    """A mean of nothing, nan; or it vanishes, and all numbers behind it are wrong."""
    vertices = np.array([[8.0, 3.0], [0.0, 0.0], [8.0, 0.0], [0.0, 8.0]])
    got = impl.loop_slow(vertices, np.array([[1, 2, 3]]), np.full(4, 0.3))
    assert_close(got[0], np.array([8.0, 3.0]))
    assert_close(got[1:4], np.array([[1.0, 1.0], [6.0, 1.0], [1.0, 6.0]]))


@exercise("11.5")
@each_mesh
def test_the_slow_step_is_that_of_the_matrix(impl, rng, count, faces):
    """The order of the points, a weight of another vertex, an isolated vertex that vanishes."""
    vertices, u = rng.normal(size=(count, 2)), rng.uniform(0.05, 0.2, count)
    assert_close(impl.loop_slow(vertices, faces, u), loop_of(count, faces, u) @ vertices)


@exercise("11.5")
@pytest.mark.parametrize("name", ["cube", "saddle"])
def test_the_published_meshes_of_opensubdiv(impl, name):
    """Not the scheme that everybody means: Loop's own weights, and smooth boundaries."""
    with np.load(PUBLISHED) as published:
        vertices, faces, expected = (published[f"{name}/{key}"]
                                     for key in ("vertices", "faces", "step_1"))
    n = valence_of(len(vertices), topology(faces)[0])
    u = (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2) / n
    assert_close(farthest(impl.loop_slow(vertices, faces, u), expected), 0.0, atol=1e-6)


def farthest(points, expected):
    """How far the farthest point of either set is from the other set; in any order."""
    assert_equal(np.shape(points), expected.shape)
    distance = np.linalg.norm(np.asarray(points)[:, None] - expected, axis=-1)
    return max(distance.min(0).max(), distance.min(1).max())


# --- matrices ----------------------------------------------------------------------------------

@exercise("11.6")
def test_pulls_add_up(impl):
    """The pulled vertex keeps its whole weight: rows that do not sum to 1."""
    rows, columns = np.array([2, 2, 0]), np.array([0, 3, 1])
    entries = impl.pull_entries(rows, columns, np.array([0.25, 0.5, 2.0]))
    expected = np.array([[-2.0, 2.0, 0, 0], [0, 0, 0, 0], [0.25, 0, -0.75, 0.5]])
    assert_close(dense(entries, (3, 4)), expected)


@exercise("11.6")
def test_what_is_alike_pulls_at_nothing(impl, rng):
    """A sign or a weight is wrong: equal points pull each other away."""
    rows, columns = rng.integers(0, 6, 25), rng.integers(0, 6, 25)
    matrix = dense(impl.pull_entries(rows, columns, rng.normal(size=25)), (6, 6))
    assert_close(matrix.sum(1), np.zeros(6))
    expected = np.zeros((6, 6))
    np.add.at(expected, (rows, columns), 3.0)
    off = ~np.eye(6, dtype=bool)
    assert_close(dense(impl.pull_entries(rows, columns, np.full(25, 3.0)), (6, 6))[off],
                 expected[off])


@exercise("11.7")
def test_a_path_with_a_boundary_edge(impl):
    """A vertex on the boundary is pulled inwards, or one inside with a neighbour's u."""
    edges, is_boundary = np.array([[0, 2], [1, 2], [1, 3]]), np.array([True, False, False])
    entries = impl.vertex_rows(edges, is_boundary, np.array([9.0, 0.25, 9.0, 0.5, 9.0]), 0.125)
    expected = np.eye(5)
    expected[0, [0, 2]] = expected[2, [2, 0]] = 0.875, 0.125
    expected[1, [1, 2, 3]] = 0.5, 0.25, 0.25
    expected[3, [1, 3]] = 0.5
    assert_close(dense(entries, (5, 5)), expected)


@exercise("11.7")
@pytest.mark.parametrize("beside", [1 / 8, 1 / 6])
@each_mesh
def test_old_vertices_row_by_row(impl, rng, count, faces, beside):
    """An edge between two boundary vertices counts as boundary; an isolated vertex goes to 0."""
    edges, _, is_boundary = topology(faces)
    u = rng.uniform(0.05, 0.2, count)
    got = dense(impl.vertex_rows(edges, is_boundary, u, beside), (count, count))
    assert_close(got, old_vertices(count, edges, is_boundary, u, beside))


@exercise("11.8")
def test_two_triangles_on_paper(impl):
    """The opposite vertices are those of the next edge."""
    faces = np.array([[3, 1, 0], [1, 3, 2]])
    edges = np.array([[0, 1], [0, 3], [1, 2], [1, 3], [2, 3]])
    corner_edge = np.array([3, 0, 1, 3, 4, 2])
    expected = np.array([[4, 4, 0, 0], [4, 0, 0, 4], [0, 4, 4, 0], [1, 3, 1, 3], [0, 0, 4, 4]]) / 8
    assert_close(dense(impl.loop_edge_rows(faces, edges, corner_edge), (5, 4)), expected)


@exercise("11.8")
@each_mesh
def test_new_points_on_edges_row_by_row(impl, count, faces):
    """A boundary edge is pulled inwards; or the winding is relied on."""
    edges, corner_edge, _ = topology(faces)
    got = dense(impl.loop_edge_rows(faces, edges, corner_edge), (len(edges), count))
    assert_close(got, loop_of(count, faces, np.zeros(count))[count:])


@exercise("11.9")
def test_two_triangles_become_eight(impl):
    """A child is wound the other way, begins elsewhere, or has the edge of another side."""
    faces, corner_edge = np.array([[3, 1, 0], [1, 3, 2]]), np.array([3, 0, 1, 3, 4, 2])
    assert_equal(impl.loop_faces(faces, corner_edge, 6), np.array([
        [3, 9, 7], [9, 1, 6], [7, 6, 0], [9, 6, 7], [1, 9, 8], [9, 3, 10], [8, 10, 2], [9, 10, 8]]))


@exercise("11.9")
@each_mesh
def test_children_fill_their_parent(impl, count, faces):
    """Points on the middles of edges: four children have a quarter of the area vector each."""
    edges, corner_edge, _ = topology(faces)
    old = np.stack([np.arange(count) ** 2, np.sin(np.arange(count)), np.arange(count)], 1) + 0.0
    new = np.concatenate([old, old[edges].mean(1)])
    children = np.asarray(impl.loop_faces(faces, corner_edge, count))
    assert_equal(children.shape, (4 * len(faces), 3))
    a, b, c = (old[faces[:, k]] for k in range(3))
    expected = np.repeat(np.cross(b - a, c - a) / 4, 4, axis=0)
    a, b, c = (new[children[:, k]] for k in range(3))
    assert_close(np.cross(b - a, c - a), expected, atol=1e-9)


# --- Catmull-Clark -----------------------------------------------------------------------------

@exercise("11.10")
def test_a_square_alone_on_paper(impl):
    """Corners stay, or the boundary is pulled inwards; or the face point is left out."""
    got = impl.catmull_clark_slow(np.array([[0.0, 0], [8, 0], [8, 16], [0, 16]]),
                                  np.array([0, 1, 2, 3]), np.array([4]))
    assert_close(got, np.array([[1, 2], [7, 2], [7, 14], [1, 14], [4, 0], [0, 8], [8, 8], [4, 16],
                                [4, 8.0]]))


@exercise("11.10")
def test_a_cube_on_paper(impl):
    """R is the mean of the ring, or of the new edge points, and not of the edges' middles."""
    vertices = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    got = impl.catmull_clark_slow(vertices, *flat(CUBE))
    assert_close(got[:8], 5 / 9 * vertices)
    assert_close(got[[8, 19]], np.array([[-3, -3, 0], [3, 3, 0]]) / 4)
    assert_close(got[20:], np.array([[-1.0, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1],
                                     [0, 0, 1]]))


@exercise("11.10")
def test_two_triangles_back_to_back_on_paper(impl):
    """Right for valence 3 alone: at valence 2, n - 3 is -1."""
    got = impl.catmull_clark_slow(np.array([[12.0], [0.0], [6.0]]), np.array([0, 1, 2, 2, 1, 0]),
                                  np.array([3, 3]))
    assert_close(got.T, np.array([[4.5, 7.5, 6.0, 6.0, 7.5, 4.5, 6.0, 6.0]]))


@exercise("11.10")
@each_polygon_mesh
def test_point_by_point_is_the_matrix(impl, rng, count, faces):
    """Faces of another vertex, the order of the points, an isolated vertex that becomes nan."""
    vertices = rng.normal(size=(count, 2))
    got = impl.catmull_clark_slow(vertices, *flat(faces))
    assert_close(got, catmull_clark_of(count, faces) @ vertices)


@exercise("11.10")
@pytest.mark.parametrize("name", ["pyramid", "square"])
def test_the_published_polygons_of_opensubdiv(impl, name):
    """Not the scheme that everybody means: triangles and a quad, and a boundary with corners."""
    with np.load(PUBLISHED) as published:
        *given, expected = (published[f"{name}/{key}"]
                            for key in ("vertices", "corners", "counts", "step_1"))
    assert_close(farthest(impl.catmull_clark_slow(*given), expected), 0.0, atol=1e-6)


@exercise("11.11")
def test_edges_between_two_triangles_on_paper(impl):
    """The face points' columns begin at 0, or the boundary has the inside's weights."""
    edges = np.array([[0, 1], [0, 3], [1, 2], [1, 3], [2, 3]])
    entries = impl.catmull_clark_edge_rows(edges, np.array([3, 0, 1, 3, 4, 2]), np.array([3, 3]), 5)
    expected = np.zeros((5, 7))
    for k in 0, 1, 2, 4:
        expected[k, edges[k]] = 1 / 2
    expected[3, [1, 3, 5, 6]] = 1 / 4
    assert_close(dense(entries, (5, 7)), expected)


@exercise("11.11")
@each_polygon_mesh
def test_points_on_edges_row_by_row(impl, count, faces):
    """A face of the wrong number where faces differ in size."""
    edges, corner_edge, _ = topology(faces)
    entries = impl.catmull_clark_edge_rows(edges, corner_edge, flat(faces)[1], count)
    expected = np.zeros((len(edges), count + len(faces)))
    for row, edge in zip(expected, edges, strict=True):
        near = [count + f for f, face in enumerate(faces) if tuple(edge) in sides(face)]
        row[[*edge, *near] if len(near) == 2 else edge] = 1 / 4 if len(near) == 2 else 1 / 2
    assert_close(dense(entries, expected.shape), expected)


@exercise("11.12")
def test_a_tetrahedron_on_paper(impl):
    """The face point of the face that a vertex does not belong to; or v's own weight."""
    edges = topology(TETRAHEDRON)[0]
    entries = impl.catmull_clark_vertex_rows(edges, np.zeros(6, bool), TETRAHEDRON.ravel(),
                                             np.full(4, 3), np.full(4, 3))
    expected = np.array([[3, 1, 1, 1, 1, 1, 1, 0], [1, 3, 1, 1, 1, 0, 1, 1],
                         [1, 1, 3, 1, 1, 1, 0, 1], [1, 1, 1, 3, 0, 1, 1, 1]]) / 9
    assert_close(dense(entries, (4, 8)), expected)


@exercise("11.12")
@each_polygon_mesh
def test_moved_vertices_row_by_row(impl, count, faces):
    """Boundary vertices are pulled inwards by face points, or isolated ones divide by 0."""
    edges, _, is_boundary = topology(faces)
    entries = impl.catmull_clark_vertex_rows(edges, is_boundary, *flat(faces),
                                             valence_of(count, edges))
    alone = np.zeros((count, len(faces)))
    expected = np.hstack([old_vertices(count, edges, is_boundary, np.zeros(count), 1 / 8), alone])
    for v in set(edges.ravel()) - set(edges[is_boundary].ravel()):
        ring, around = neighbours(v, edges), [count + f for f in range(len(faces)) if v in faces[f]]
        n = len(ring)
        expected[v, v] = (n - 2) / n  # n - 3, and 1 more in 2 R
        expected[v, ring + around] = 1 / n**2
    assert_close(dense(entries, expected.shape), expected)


@exercise("11.13")
def test_a_triangle_and_a_square_become_seven_quads(impl):
    """A quad is wound the other way, begins elsewhere, or has the edge of another corner."""
    corners, counts = np.array([0, 1, 2, 2, 1, 4, 3]), np.array([3, 4])
    corner_edge = np.array([0, 2, 1, 2, 3, 5, 4])  # 01, 02, 12, 14, 23, 34
    assert_equal(impl.catmull_clark_faces(corners, counts, corner_edge, 6), np.array([
        [0, 6, 12, 7], [1, 8, 12, 6], [2, 7, 12, 8],
        [2, 8, 13, 10], [1, 9, 13, 8], [4, 11, 13, 9], [3, 10, 13, 11]]))


@exercise("11.13")
@each_polygon_mesh
def test_quads_fill_their_polygon(impl, count, faces):
    """Points on the middles: the quads of a polygon have its area vector in sum."""
    edges, corner_edge, _ = topology(faces)
    x = np.arange(count)
    old = np.stack([x**2, np.sin(x), x], 1) + 0.0
    new = np.concatenate([old, old[edges].mean(1), [old[face].mean(0) for face in faces]])
    corners, counts = flat(faces)
    quads = np.asarray(impl.catmull_clark_faces(corners, counts, corner_edge, count))
    assert_equal(quads[:, 0], corners)
    vector = np.cross(new[quads], np.roll(new[quads], -1, 1)).sum(1)
    first = np.cumsum(counts) - counts
    expected = [np.cross(old[face], np.roll(old[face], -1, 0)).sum(0) for face in faces]
    assert_close(np.add.reduceat(vector, first), np.array(expected), atol=1e-9)


# --- limits ------------------------------------------------------------------------------------

@exercise("11.14")
def test_limit_weights_on_paper(impl):
    """The old weight for the limit's: m is 1/12 at valence 6, where u is 1/16."""
    assert_close(impl.limit_weight(np.array([6, 3, 4]), np.array([1 / 16, 3 / 16, 3 / 32])),
                 np.array([1 / 12, 1 / 5, 1 / 8]))


@exercise("11.14")
def test_many_steps_lead_to_the_limit(impl):
    """m is not the fixed point: a vertex and its ring, 60 steps on."""
    for n, u in (3, 0.1875), (4, 0.121), (5, 0.06), (9, 0.04):
        # The mean of a ring's new points: 3/8 v + 3/8 + 1/8 + 1/8 of the ring's mean.
        step = np.array([[1 - n * u, n * u], [3 / 8, 5 / 8]])
        expected = np.linalg.matrix_power(step, 200)[0, 1] / n
        assert_close(impl.limit_weight(np.array([n]), np.array([u])), np.array([expected]))


@exercise("11.15")
def test_the_limit_of_a_cube_on_paper(impl):
    """The diagonals weigh as much as the ring, or the sum is not 1."""
    quads = np.array(CUBE)
    edges = topology(quads)[0]
    entries = impl.catmull_clark_limit_rows(edges, np.zeros(12, bool), quads, np.full(8, 3))
    got = dense(entries, (8, 8))
    assert_close(24 * got[0], np.array([9.0, 4, 4, 1, 4, 1, 1, 0]))
    assert_close(24 * got[6], np.array([1.0, 0, 4, 1, 4, 1, 9, 4]))


@exercise("11.15")
def test_limits_on_a_boundary(impl):
    """A diagonal pulls a boundary vertex inwards, or (4) is used for the limit."""
    quads = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
    edges, _, is_boundary = topology(quads)
    n = np.append(valence_of(9, edges), 0)
    got = dense(impl.catmull_clark_limit_rows(edges, is_boundary, quads, n), (10, 10))
    expected = np.eye(10)
    rim = [0, 1, 2, 5, 8, 7, 6, 3]
    for before, v, after in zip(rim[-1:] + rim, rim, rim[1:] + rim[:1], strict=False):
        expected[v, [before, v, after]] = 1 / 6, 4 / 6, 1 / 6
    expected[4, :9] = np.outer([1, 4, 1], [1, 4, 1]).ravel() / 36
    assert_close(got, expected)


@exercise("11.15")
def test_the_inner_corner_of_an_l_is_on_the_boundary(impl):
    """A boundary vertex is told by its valence; here one has 4 neighbours, and three quads."""
    quads = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6]])
    edges, _, is_boundary = topology(quads)
    n = valence_of(8, edges)
    got = dense(impl.catmull_clark_limit_rows(edges, is_boundary, quads, n), (8, 8))
    assert_close(6 * got[4], np.array([0.0, 0, 0, 0, 4, 1, 0, 1]))
    assert_close(6 * got[1], np.array([1.0, 4, 1, 0, 0, 0, 0, 0]))


@exercise("11.15")
def test_many_steps_of_quads_lead_to_the_limit(impl):
    """Not the fixed point of (8) and (9): valences 3, 4, 5 and 8."""
    for n in 3, 4, 5, 8:
        # n quads around vertex 0, the ring 1 to n, diagonals n + 1 to 2 n; one step of their means.
        k = np.arange(n)
        quads = np.stack([0 * k, 1 + k, 1 + n + k, 1 + (k + 1) % n], axis=1)
        edges = np.stack([0 * k, 1 + k], axis=1)
        got = dense(impl.catmull_clark_limit_rows(
            edges, np.zeros(n, bool), quads, np.append(n, np.full(2 * n, 2))), (2 * n + 1,) * 2)[0]
        # Means of vertex, ring and diagonals: F = (v + 2 r + d) / 4 is the new mean of diagonals.
        face = np.array([1, 2, 1]) / 4
        ring = (np.array([1, 1, 0]) + 2 * face) / 4
        own = (face + np.array([1, 1, 0]) + np.array([n - 3, 0, 0])) / n
        limit = np.linalg.matrix_power(np.array([own, ring, face]), 400)[0]
        assert_close(np.array([got[0], got[1:n + 1].sum(), got[n + 1:].sum()]), limit)
