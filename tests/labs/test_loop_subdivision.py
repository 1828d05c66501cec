"""What Loop's exercises of lab 11 must do."""
import numpy as np
import pytest
import subdivision_meshes as meshes

from labkit.checks import assert_close, assert_equal, exercise


def loop_of(count, faces, u):
    """Loop's S, dense (V + E, V), edge by edge."""
    edges, _, is_boundary = meshes.topology(faces)
    rows = [*meshes.old_vertices(count, edges, is_boundary, u, 1 / 8)]
    for edge in edges:
        opposite = [v for face in faces if set(edge) <= set(face) for v in face if v not in edge]
        row = np.zeros(count)
        row[edge] = 1 / 2 if len(opposite) == 1 else 3 / 8
        row[opposite if len(opposite) == 2 else []] = 1 / 8
        rows.append(row)
    return np.array(rows)


# --- faces --------------------------------------------------------------------------------------

@exercise("11.2")
def test_two_triangles_become_eight(impl, rng):
    """New vertices are numbered from 0, or from the largest old vertex, not from vertex_count. A
    face's edges are not read as AB, BC, CA. Triangles come kind by kind, or the middle one is left
    out. A child is wound the other way, or begins elsewhere."""
    faces, corner_edge = np.array([[3, 1, 0], [1, 3, 2]]), np.array([3, 0, 1, 3, 4, 2])
    n, count = np.arange(11), int(rng.integers(6, 99))
    expected = np.where(n < 6, n, n - 6 + count)[[
        [3, 9, 7], [9, 1, 6], [7, 6, 0], [9, 6, 7], [1, 9, 8], [9, 3, 10], [8, 10, 2], [9, 10, 8]]]
    assert_equal(impl.loop_faces(faces, corner_edge, count), expected)


# --- point by point ------------------------------------------------------------------------------

TWO = (np.array([[0.0, 0.0], [16.0, 8.0], [8.0, 40.0], [0.0, 16.0]]),  # two triangles in a plane,
       np.array([[3, 1, 2], [1, 3, 0]]), np.array([3.0, 5.0, 7.0, 9.0]))  # with the edge 1 3


@exercise("11.3")
def test_boundary_vertices_of_two_triangles_on_paper(impl):
    """A vertex on the boundary stays, or the inside's rule with u is used there. Its whole ring
    pulls, not only the two neighbours along the boundary. Its weights are not 3/4 and 1/8. Vertices
    already moved pull. The edges' points come first."""
    assert_close(meshes.both(impl.loop_slow(*TWO))[0][:4], [[2, 3], [13, 11], [8, 33], [1, 17.0]])


@exercise("11.3")
def test_edge_points_of_two_triangles_on_paper(impl):
    """3/8 and 1/8 are exchanged. An inner edge gets its middle, or lacks an opposite corner. The
    inside's rule is used on a boundary edge, or the opposite corner pulls there. Points are made of
    moved vertices, not of the old ones. Edges come in another order."""
    got, _ = impl.loop_slow(*TWO)  # of the edges 0 1, 0 3, 1 2, 1 3, 2 3
    assert_close(got[4:], [[8, 4], [0, 8], [12, 24], [7, 14], [4, 28.0]])


@exercise("11.3")
def test_the_new_faces_of_two_triangles(impl):
    """The old faces come back. New vertices are numbered from 0, or by the faces, not by edges."""
    assert_equal(impl.loop_slow(*TWO)[1], [[3, 7, 8], [7, 1, 6], [8, 6, 2], [7, 6, 8],
                                           [1, 7, 4], [7, 3, 5], [4, 5, 0], [7, 5, 4]])


@exercise("11.3")
def test_a_tetrahedrons_vertices_on_paper(impl):
    """u is the weight of all neighbours together (of their mean). v keeps 1 - u instead of 1 - n u.
    The u is that of a neighbour, or it is computed from n, and the given u is not used."""
    got, _ = impl.loop_slow(np.array([[16.0], [32.0], [0.0], [8.0]]), meshes.TETRAHEDRON,
                            np.array([1 / 8, 1 / 16, 1 / 4, 3 / 8]))
    assert_close(got[:4].T, [[15, 27.5, 14, 17]])


@exercise("11.3")
def test_a_vertex_of_no_face_stays(impl):
    """An isolated vertex becomes nan, the mean of nothing. Or it vanishes, and all numbers behind
    it are wrong."""
    vertices = np.array([[8.0, 3.0], [0.0, 0.0], [8.0, 0.0], [0.0, 8.0]])
    got, _ = impl.loop_slow(vertices, np.array([[1, 2, 3]]), np.full(4, 0.3))
    assert_close(got[0], [8.0, 3.0])
    assert_close(got[1:4], [[1.0, 1.0], [6.0, 1.0], [1.0, 6.0]])


@exercise("11.3")
@meshes.each_mesh
def test_the_slow_step_is_that_of_the_matrix(impl, rng, count, faces):
    """Points come in another order. A vertex has the u of another one. A corner of another face is
    taken for the one opposite to an edge."""
    vertices, u = rng.normal(size=(count, 2)), rng.uniform(0.05, 0.2, count)
    got, _ = impl.loop_slow(vertices, faces, u)
    assert_close(got, loop_of(count, faces, u) @ vertices)


@exercise("11.3")
@pytest.mark.parametrize("name", ["cube", "saddle"])
def test_the_published_meshes_of_opensubdiv(impl, name):
    """Not the scheme that everybody means: Loop's own weights, and smooth boundaries."""
    vertices, faces, expected = meshes.published(name, "vertices", "faces", "step_1")
    n = meshes.valence_of(len(vertices), meshes.topology(faces)[0])
    u = (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2) / n
    assert_close(meshes.farthest(impl.loop_slow(vertices, faces, u)[0], expected), 0.0, atol=1e-6)


# --- the matrix ----------------------------------------------------------------------------------

def rows_of_two_triangles(impl):
    faces = np.array([[3, 1, 0], [1, 3, 2]])
    edges = np.array([[0, 1], [0, 3], [1, 2], [1, 3], [2, 3]])
    return meshes.dense(impl.loop_rows(faces, edges, np.array([3, 0, 1, 3, 4, 2]), np.ones(4)),
                        (9, 4))


@exercise("11.5")
def test_the_inner_edge_of_two_triangles_on_paper(impl):
    """3/8 and 1/8, or inside and boundary, are exchanged. One of the two opposite corners is
    overwritten or left out, or is an end of the edge (np.roll in the wrong direction). A mask of
    edges is used for corners. Rows and columns are exchanged."""
    assert_close(rows_of_two_triangles(impl)[7], np.array([1, 3, 1, 3]) / 8)


@exercise("11.5")
def test_the_boundary_edges_of_two_triangles_on_paper(impl):
    """Boundary edges have the inside's 3/8, not 1/2. Or the opposite corner pulls at a boundary
    edge, too, so that its row sums to 9/8."""
    expected = np.array([[4, 4, 0, 0], [4, 0, 0, 4], [0, 4, 4, 0], [1, 3, 1, 3], [0, 0, 4, 4]]) / 8
    assert_close(rows_of_two_triangles(impl)[4:], expected)


@exercise("11.5")
def test_the_old_vertices_of_two_triangles_on_paper(impl):
    """Rows of old vertices are left out, stand below those of the edges, or have the limit's 1/6.
    The edges' rows begin at 0 and are added to them."""
    expected = np.array([[6, 1, 0, 1], [1, 6, 1, 0], [0, 1, 6, 1], [1, 0, 1, 6]]) / 8
    assert_close(rows_of_two_triangles(impl)[:4], expected)


@exercise("11.5")
@meshes.each_mesh
def test_a_step_row_by_row(impl, rng, count, faces):
    """A boundary edge is pulled inwards. An opposite corner is taken from another face. The winding
    of the faces is relied on. A vertex has another's u."""
    faces = meshes.renumbered(rng, count, faces)
    edges, corner_edge, _ = meshes.topology(faces)
    u = rng.uniform(0.05, 0.2, count)
    got = meshes.dense(impl.loop_rows(faces, edges, corner_edge, u), (count + len(edges), count))
    assert_close(got, loop_of(count, faces, u))


# --- a cage --------------------------------------------------------------------------------------

def surface_of(count, faces, steps):
    """Steps of Loop with Warren's weights, then the limit: dense, (V', V)."""
    surface = np.eye(count)
    for _ in range(steps):
        edges, corner_edge, _ = meshes.topology(faces)
        u = warren(meshes.valence_of(count, edges))
        surface = loop_of(count, faces, u) @ surface
        new = (count + corner_edge).reshape(-1, 3)
        old_corners = np.stack([faces, new, np.roll(new, 1, 1)], -1).reshape(-1, 3)
        faces, count = np.concatenate([old_corners, new]), len(surface)
    edges, _, is_boundary = meshes.topology(faces)
    n = meshes.valence_of(count, edges)
    m = 1 / (n + 3 / (8 * warren(n)))
    return np.array([*meshes.old_vertices(count, edges, is_boundary, m, 1 / 6)]) @ surface


def warren(n):
    return np.where(n == 3, 3 / 16, 3 / (8 * np.maximum(n, 1)))  # a vertex of no face has n = 0


@exercise("11.9")
def test_the_limit_alone_on_paper(impl):
    """Without a step, the limit is left out, or its matrix is not transposed: it is symmetric for a
    tetrahedron, and not for a fan."""
    fan = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])  # valence 4 inside: m = 1/8
    got = impl.loop_surface_backward(np.array([[48.0], [0.0], [0.0], [0.0], [0.0]]), fan, 5, 0)
    assert_close(got.T, [[24, 6, 6, 6, 6.0]])
    got = impl.loop_surface_backward(np.array([[0.0], [48.0], [0.0], [0.0], [0.0]]), fan, 5, 0)
    assert_close(got.T, [[0, 32, 8, 0, 8.0]])  # on the boundary: w = 1/6


@exercise("11.9")
def test_one_vertex_of_a_tetrahedron_on_paper(impl):
    """The step is left out, or the limit. Both are there in the wrong order. Or a matrix is used in
    place of its transpose, or its inverse."""
    grad_surface = np.zeros((10, 2))
    grad_surface[0], grad_surface[9] = [80.0, 0.0], [0.0, 96.0]  # 9 is on the edge 2 3
    got = impl.loop_surface_backward(grad_surface, meshes.TETRAHEDRON, 4, 1)
    assert_close(got[:, 0], [32, 16, 16, 16.0])
    assert_close(got[:, 1].sum(), 96.0)
    assert_close(got[:2, 1], got[:1, 1].repeat(2))
    assert_close(got[2:, 1], got[2:3, 1].repeat(2))


@exercise("11.9")
@pytest.mark.parametrize("steps", [1, 2])
@meshes.each_mesh
def test_a_cage_gets_what_its_surface_gives(impl, rng, count, faces, steps):
    """The transposes come in the wrong order, the first step's first. Every step is that of the
    cage, or of its faces. The limit is that of the cage. Channels are mixed."""
    faces = meshes.renumbered(rng, count, faces)
    surface = surface_of(count, faces, steps)
    grad_surface = rng.normal(size=(len(surface), 2))
    got = impl.loop_surface_backward(grad_surface, faces, count, steps)
    assert_close(got, surface.T @ grad_surface)
