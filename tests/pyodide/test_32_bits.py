"""What overflows where indices have 32 bits, and nothing says so. Elsewhere all of this passes."""
import numpy as np

from course.given import arrays
from reference import marching_tetrahedra, remeshing


def test_indices_have_32_bits_here():
    assert np.intp == np.int32


def test_more_elements_than_32_bits_can_count_come_in_chunks():
    count = np.full(5, 2**30)
    assert [count[part].tolist() for part in arrays.chunks(count)] == [[2**30]] * 5


def test_the_ends_of_edges_are_indices():
    """They are int64, as their edges' numbers are, and NumPy refuses them on the way back."""
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(2)
    distance = np.linalg.norm(points, axis=1) - 0.5
    vertices, _, ends = marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)
    marching_tetrahedra.marching_tetrahedra_backward(vertices, ends, points, distance)


def test_of_many_vertices_two_edges_are_not_taken_for_one():
    """The new edge has the number of another one, as 42,951 times 100,000 overflows."""
    vertices = np.zeros((100_000, 3))
    vertices[[2, 42_951, 50_000, 82_704]] = [[1, 1, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0]]
    faces = np.array([[0, 2, 50_000], [2, 0, 42_951], [1, 82_704, 50_000]])
    quads, _, held = remeshing.edge_quads(faces)
    assert quads.tolist() == [[0, 2, 50_000, 42_951]] and [1, 82_704] in held.tolist()
    assert remeshing.can_flip(vertices, faces, quads).all()
