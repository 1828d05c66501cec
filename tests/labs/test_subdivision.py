"""What the exercises of lab 11 that both schemes share must do."""
import numpy as np
import pytest
import subdivision_meshes as meshes

from labkit.checks import assert_close, assert_equal, exercise

# --- who is near whom ----------------------------------------------------------------------------

@exercise("11.1")
def test_edges_of_two_triangles(impl):
    """An edge of two faces comes twice, once in each direction. Edges are not low < high, or not
    ascending. corner_edge names the edge behind the corner, or has one entry per edge
    (return_index). A face's last side is missing, or leads to the next face."""
    edges = [[1, 5], [1, 7], [5, 7], [5, 9], [7, 9]]
    assert_equal(impl.edges_of(np.array([7, 5, 1, 5, 7, 9]), np.array([3, 3])),
                 (edges, [2, 0, 1, 2, 4, 3]))


@exercise("11.1")
@meshes.each_polygon_mesh
def test_edges_are_those_of_a_dictionary(impl, rng, count, faces):
    """The last corner of a face is joined to the next face, or not at all. All faces are taken for
    triangles."""
    faces = meshes.renumbered(rng, count, faces)
    edges, corner_edge, _ = meshes.topology(faces)
    assert_equal(impl.edges_of(*meshes.flat(faces)), (edges, corner_edge))


@exercise("11.1", fine_print=True)
def test_edges_of_large_numbers(impl):
    """A table of all pairs of vertices, or a number for each pair that others have, too."""
    corners = np.array([0, 5, 7, 0, 7, 1_000_007, 0, 10_000_007, 17])
    edges, corner_edge = impl.edges_of(corners, np.array([3, 3, 3]))
    assert_equal(edges, [[0, 5], [0, 7], [0, 17], [0, 1_000_007], [0, 10_000_007], [5, 7],
                         [7, 1_000_007], [17, 10_000_007]])
    assert_equal(corner_edge, [0, 5, 1, 1, 6, 3, 4, 7, 2])


@exercise("11.1", fine_print=True)
def test_edges_of_large_numbers_in_int32(impl):
    """The corners come as int32, and a product of two of them overflows: compute in int64."""
    corners = np.array([300_007, 7_000_003, 5_000_001, 7_000_003, 300_007, 40_009], np.int32)
    edges = [[40_009, 300_007], [40_009, 7_000_003], [300_007, 5_000_001],
             [300_007, 7_000_003], [5_000_001, 7_000_003]]
    assert_equal(impl.edges_of(corners, np.array([3, 3])), (edges, [3, 4, 2, 3, 0, 1]))


# --- entries of a matrix -------------------------------------------------------------------------

@exercise("11.4")
def test_a_path_inside(impl):
    """The 1 on the diagonal is missing. An edge pulls only one of its two ends. The strength is the
    u of the neighbour (the column), or w. u is shared by all neighbours."""
    edges, is_boundary = np.array([[0, 2], [1, 2], [1, 3]]), np.zeros(3, bool)
    entries = impl.vertex_rows(edges, is_boundary, np.array([0.5, 0.25, 0.125, 0.75]), 0.375)
    expected = np.array([[4, 0, 4, 0], [0, 4, 2, 2], [1, 1, 6, 0], [0, 6, 0, 2]]) / 8
    assert_close(meshes.dense(entries, (4, 4)), expected)


@exercise("11.4")
def test_a_path_with_a_boundary_edge(impl):
    """A vertex on the boundary is pulled along inner edges as well, by u or w. It is pulled by u
    instead of w: the boundary is ignored. A vertex inside is not pulled by one on the boundary."""
    edges, is_boundary = np.array([[0, 2], [1, 2], [1, 3]]), np.array([True, False, False])
    entries = impl.vertex_rows(edges, is_boundary, np.array([9.0, 0.25, 9.0, 0.5, 9.0]), 0.125)
    expected = np.eye(5)
    expected[0, [0, 2]] = expected[2, [2, 0]] = 0.875, 0.125
    expected[1, [1, 2, 3]] = 0.5, 0.25, 0.25
    expected[3, [1, 3]] = 0.5
    assert_close(meshes.dense(entries, (5, 5)), expected)


@exercise("11.4")
@pytest.mark.parametrize("w", [1 / 8, 1 / 6])
@meshes.each_mesh
def test_old_vertices_row_by_row(impl, rng, count, faces, w):
    """An inner edge between two boundary vertices counts as a boundary edge. w is not the one that
    is given, but always 1/8."""
    edges, _, is_boundary = meshes.topology(faces)
    u = rng.uniform(0.05, 0.2, count)
    got = meshes.dense(impl.vertex_rows(edges, is_boundary, u, w), (count, count))
    assert_close(got, meshes.old_vertices(count, edges, is_boundary, u, w))
