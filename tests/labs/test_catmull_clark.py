"""What Catmull and Clark's exercises of lab 11 must do."""
import numpy as np
import pytest
import subdivision_meshes as meshes

from labkit.checks import assert_close, assert_equal, exercise


def mean_of(corners, count):
    return np.bincount(corners, minlength=count) / len(corners)


def catmull_clark_of(count, faces):
    """Catmull and Clark's S, dense (V + E + F, V), point by point."""
    edges, _, is_boundary = meshes.topology(faces)
    points, one = np.array([mean_of(face, count) for face in faces]), np.eye(count)
    rows = [*meshes.old_vertices(count, edges, is_boundary, np.zeros(count), 1 / 8)]
    for v in range(count):
        ring = meshes.neighbours(v, edges)
        if ring and not meshes.neighbours(v, edges[is_boundary]):
            n, around = len(ring), points[[v in face for face in faces]]
            rows[v] = (around.mean(0) + 2 * mean_of([v] * n + ring, count) + (n - 3) * one[v]) / n
    for edge, alone in zip(edges, is_boundary, strict=True):
        beside = points[[tuple(edge) in meshes.sides(face) for face in faces]]
        rows.append(one[edge].mean(0) if alone else (one[edge].sum(0) + beside.sum(0)) / 4)
    return np.concatenate([rows, points])


# --- faces ---------------------------------------------------------------------------------------

@exercise("11.6")
def test_a_triangle_and_a_square_become_seven_quads(impl):
    """A face's vertex is numbered from V, or V + the number of corners: two faces share an edge.
    The edge behind is that of the previous entry, across faces (np.roll). A quad is wound the other
    way or begins elsewhere."""
    corners, counts = np.array([0, 1, 2, 2, 1, 4, 3]), np.array([3, 4])
    corner_edge = np.array([0, 2, 1, 2, 3, 5, 4])  # 01, 02, 12, 14, 23, 34
    assert_equal(impl.catmull_clark_faces(corners, counts, corner_edge, 6), [
        [0, 6, 12, 7], [1, 8, 12, 6], [2, 7, 12, 8],
        [2, 8, 13, 10], [1, 9, 13, 8], [4, 11, 13, 9], [3, 10, 13, 11]])


@exercise("11.6")
@meshes.each_polygon_mesh
def test_quads_fill_their_polygon(impl, rng, count, faces):
    """Points on the middles: the quads of a polygon have its area vector in sum."""
    faces = meshes.renumbered(rng, count, faces)
    edges, corner_edge, _ = meshes.topology(faces)
    x = np.arange(count)
    old = np.stack([x**2, np.sin(x), x], 1) + 0.0
    new = np.concatenate([old, old[edges].mean(1), [old[face].mean(0) for face in faces]])
    corners, counts = meshes.flat(faces)
    quads = impl.catmull_clark_faces(corners, counts, corner_edge, count)
    assert_equal(quads[:, 0], corners)
    vector = np.cross(new[quads], np.roll(new[quads], -1, 1)).sum(1)
    first = np.cumsum(counts) - counts
    expected = [np.cross(old[face], np.roll(old[face], -1, 0)).sum(0) for face in faces]
    assert_close(np.add.reduceat(vector, first), np.array(expected), atol=1e-9)


# --- point by point ------------------------------------------------------------------------------

HOUSE = (np.array([[0.0, 0.0], [16.0, 0.0], [16.0, 32.0], [0.0, 32.0], [32.0, 56.0]]),  # a square
         np.array([3, 2, 4, 0, 1, 2, 3]), np.array([3, 4]))  # and a triangle, with the edge 2 3
HOUSE_EDGES = np.array([[0, 1], [0, 3], [1, 2], [2, 3], [2, 4], [3, 4]])
PYRAMID = meshes.POLYGONS["pyramid"][1]


@exercise("11.7")
def test_face_points_of_a_triangle_and_a_square_on_paper(impl):
    """A face point is the sum of the corners over 4, also for a triangle, or is made of moved
    vertices. Face points come before the edge points, or are left out; they must come last."""
    assert_close(meshes.both(impl.catmull_clark_slow(*HOUSE))[0][11:], [[16, 40], [8, 16.0]])


@exercise("11.7")
def test_boundary_vertices_of_a_house_on_paper(impl):
    """A vertex on the boundary stays, or the inside's rule with F and R is used there. Its whole
    ring pulls, not only the two neighbours along the boundary. Its weights are not 3/4 and 1/8.
    Vertices already moved pull."""
    got, _ = impl.catmull_clark_slow(*HOUSE)
    assert_close(got[:5], [[2, 4], [14, 4], [18, 31], [4, 31], [26, 50.0]])


@exercise("11.7")
def test_edge_points_of_a_house_on_paper(impl):
    """A boundary edge is drawn to its one face: (A + B + f) / 3, or / 4. An inner edge gets its
    middle, lacks its ends or a face point, or has Loop's weights. Points are made of moved
    vertices, or come in another order."""
    got, _ = impl.catmull_clark_slow(*HOUSE)  # of the edges 0 1, 0 3, 1 2, 2 3, 2 4, 3 4
    assert_close(got[5:11], [[8, 0], [0, 16], [16, 16], [10, 30], [24, 44], [16, 44.0]])


@exercise("11.7")
def test_the_new_faces_of_a_house(impl):
    """The old faces come back. A vertex on an edge, or in a face, has the number of another one."""
    assert_equal(impl.catmull_clark_slow(*HOUSE)[1],
                 [[3, 8, 11, 10], [2, 9, 11, 8], [4, 10, 11, 9],
                  [0, 5, 12, 6], [1, 7, 12, 5], [2, 8, 12, 7], [3, 6, 12, 8]])


@exercise("11.7")
def test_vertices_of_a_pyramid_on_paper(impl):
    """R counts once, or is the mean of the ring, or of the new edge points, not of the edges'
    middles. F is a sum, or of all faces. n is always 4, not the valence. n - 3, the division by n,
    or its brackets are wrong."""
    vertices = np.array([[36.0], [72.0], [108.0], [216.0], [180.0]])
    got, _ = impl.catmull_clark_slow(vertices, *meshes.flat(PYRAMID))
    assert_close(got[:5].T, np.array([[243, 284, 328, 460, 416]]) / 3)


@exercise("11.7")
def test_two_triangles_back_to_back_on_paper(impl):
    """At valence 2, n - 3 is -1: v has another weight there. Two faces with the same corners count
    as one."""
    got, _ = impl.catmull_clark_slow(np.array([[12.0], [0.0], [6.0]]),
                                     np.array([0, 1, 2, 2, 1, 0]), np.array([3, 3]))
    assert_close(got.T, [[4.5, 7.5, 6.0, 6.0, 7.5, 4.5, 6.0, 6.0]])


@exercise("11.7")
@meshes.each_polygon_mesh
def test_point_by_point_is_the_matrix(impl, rng, count, faces):
    """F is taken over faces that do not meet at the vertex. Points come in another order."""
    del count
    corners, counts = meshes.flat(faces)
    used, corners = np.unique(corners, return_inverse=True)
    faces = [face.tolist() for face in np.split(corners, np.cumsum(counts)[:-1])]
    vertices = rng.normal(size=(len(used), 2))
    got, _ = impl.catmull_clark_slow(vertices, corners, counts)
    assert_close(got, catmull_clark_of(len(used), faces) @ vertices)


@exercise("11.7", fine_print=True)
@meshes.each_polygon_mesh
def test_an_isolated_vertex_stays(impl, rng, count, faces):
    """An isolated vertex is divided by its valence 0 and becomes nan. Or it vanishes, and all
    numbers behind it are wrong."""
    vertices = rng.normal(size=(count, 2))
    got, _ = impl.catmull_clark_slow(vertices, *meshes.flat(faces))
    assert_close(got, catmull_clark_of(count, faces) @ vertices)


@exercise("11.7")
@pytest.mark.parametrize("name", ["pyramid", "square"])
def test_the_published_polygons_of_opensubdiv(impl, name):
    """Not the scheme that everybody means: triangles and a quad, and a boundary with corners."""
    *given, expected = meshes.published(name, "vertices", "corners", "counts", "step_1")
    assert_close(meshes.farthest(impl.catmull_clark_slow(*given)[0], expected), 0.0, atol=1e-6)


# --- the matrix ----------------------------------------------------------------------------------

@exercise("11.8")
def test_the_inner_edge_of_a_house_on_paper(impl):
    """The face points' columns begin at 0, not at V. A face point is left out, or counts for one of
    the two faces only. The weights are Loop's, 3/8 and 1/8, or the face points have 1/2. Rows and
    columns are exchanged."""
    assert_close(rows_of_a_house(impl)[9], np.array([0, 0, 1, 1, 0, 0, 1, 1]) / 4)


def rows_of_a_house(impl):
    entries = impl.catmull_clark_rows(HOUSE_EDGES, *HOUSE[1:], np.array([3, 4, 5, 0, 2, 3, 1]),
                                      np.array([2, 2, 3, 3, 2, 0]))
    return meshes.dense(entries, (12, 8))


@exercise("11.8")
def test_boundary_edges_of_a_house_on_paper(impl):
    """On the boundary, the ends have the inside's 1/4, not 1/2. Or the face point pulls there, too,
    so that the row sums to 5/4."""
    expected = np.zeros((6, 8))
    np.put_along_axis(expected, HOUSE_EDGES, 1 / 2, axis=1)
    assert_close(np.delete(rows_of_a_house(impl)[6:], 3, 0), np.delete(expected, 3, 0))


@exercise("11.8")
def test_a_pyramid_on_paper(impl):
    """The pull is 1 / n, not 1 / n^2. A neighbour pulls by 2 / n^2, as if R were the ring's mean.
    Face points are left out, are those of other faces, or stand in the columns from 0 on. v keeps
    another weight."""
    edges, corner_edge, _ = meshes.topology(PYRAMID)
    entries = impl.catmull_clark_rows(edges, *meshes.flat(PYRAMID), corner_edge,
                                      np.array([4, 3, 3, 3, 3]))
    expected = np.array([[72, 9, 9, 9, 9, 9, 9, 9, 9, 0],
                         [16, 48, 16, 0, 16, 16, 0, 0, 16, 16],
                         [16, 16, 48, 16, 0, 16, 16, 0, 0, 16],
                         [16, 0, 16, 48, 16, 0, 16, 16, 0, 16],
                         [16, 16, 0, 16, 48, 0, 0, 16, 16, 16]]) / 144
    assert_close(meshes.dense(entries, (13, 10))[:5], expected)


@exercise("11.8")
def test_boundary_vertices_and_one_of_no_face_on_paper(impl):
    """Face points pull at boundary vertices as well. The boundary has another w than 1/8. A vertex
    of no face is divided by its valence 0, or does not stay."""
    expected = np.array([[6, 1, 0, 1, 0, 0, 0, 0], [1, 6, 1, 0, 0, 0, 0, 0],
                         [0, 1, 6, 0, 1, 0, 0, 0], [1, 0, 0, 6, 1, 0, 0, 0],
                         [0, 0, 1, 1, 6, 0, 0, 0], [0, 0, 0, 0, 0, 8, 0, 0]]) / 8
    assert_close(rows_of_a_house(impl)[:6], expected)


@exercise("11.8")
@meshes.each_polygon_mesh
def test_a_step_row_by_row(impl, rng, count, faces):
    """A corner gets the face point of another face where faces differ in size. The strength is that
    of another vertex. A vertex is pulled by faces that do not meet there."""
    faces = meshes.renumbered(rng, count, faces)
    edges, corner_edge, _ = meshes.topology(faces)
    entries = impl.catmull_clark_rows(edges, *meshes.flat(faces), corner_edge,
                                      meshes.valence_of(count, edges))
    T = meshes.dense(entries, (count + len(edges), count + len(faces)))
    points = np.array([mean_of(face, count) for face in faces])
    assert_close(T[:, :count] + T[:, count:] @ points, catmull_clark_of(count, faces)[:len(T)])
    assert_close(T.sum(1), np.ones(len(T)))
