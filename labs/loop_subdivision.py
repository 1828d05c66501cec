"""Loop subdivision, for triangles: each is cut in four, and all points move.

An old vertex moves by (3) of subdivision.py. Inside, u depends on its valence n. On the boundary, w
is 1/8. An edge A B gets a new point. C and D are the corners opposite to it in its two faces.

    u = 3/16 for n = 3, else 3/(8 n)  (Warren)    (5/8 - (3/8 + cos(2 pi/n)/4)^2)/n  (Loop)    (4)
    edge     3/8 (A + B) + 1/8 (C + D)      on the boundary   1/2 (A + B)                      (5)
    limit    (3) with m for u, m = 1/(n + 3/(8 u))            on the boundary   w = 1/6        (6)

Both formulas of (4) are known as Loop's. They agree only at valences 3 and 6.

Sources: a lecture on geometry, Loop 1987, Warren 1995.
"""
import numpy as np
import scipy.sparse

from .subdivision import (
    as_matrix,
    faces_at_edges,
    join,
    on_boundary,
    ring_of,
    topology,
    triangles,
    valences,
    vertex_rows,
)

# Point by point: slow and obvious


def warren_weight(n):
    """Eq. (4), Warren's: valences n (...), integers >= 1 -> u (...).

    >>> warren_weight(np.array([3, 4, 6]))
    array([0.1875 , 0.09375, 0.0625 ])
    """
    return np.where(n == 3, 3 / 16, 3 / (8 * n))


def loop_weight(n):  # extra 11.4 (1 point)
    """Eq. (4), Loop's own: valences n (...), integers >= 1 -> u (...).

    >>> loop_weight(np.array([3, 4, 6]))
    array([0.1875    , 0.12109375, 0.0625    ])
    """
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2) / n


def loop_slow(vertices, faces, u):  # exercise 11.5 (5 points)
    """Eqs. (3) and (5), point by point: the old vertices, then the edges of `faces_at_edges`.

    vertices (V, C), faces (F, 3), u (V,) -> (V + E, C). w = 1/8. `ring_of` tells who is near.
    Your own smooth mesh: `python3 -m course demo --impl labs rounded`

    >>> triangle = np.array([[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]])
    >>> loop_slow(triangle, np.array([[0, 1, 2]]), np.full(3, 3 / 16))
    array([[1., 1.],
           [6., 1.],
           [1., 6.],
           [4., 0.],
           [0., 4.],
           [4., 4.]])
    """
    raise NotImplementedError("exercise 11.5: loop_slow")


# The same as one matrix, S. Its transpose is the gradient.


def loop_edge_rows(faces, edges, corner_edge):  # exercise 11.8 (3 points)
    """Eq. (5) as a sparse matrix from V old points to E edge points: its entries, in any order.

    faces (F, 3), edges (E, 2), corner_edge (3 F,) of `edges_of` -> rows, columns, weights, for
    `as_matrix`, which adds up those of one place. `on_boundary` and `join` are given.

    >>> faces, corner_edge = np.array([[0, 1, 2], [2, 1, 3]]), np.array([0, 2, 1, 2, 3, 4])
    >>> edges = np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]])
    >>> as_matrix(loop_edge_rows(faces, edges, corner_edge), (5, 4)).toarray()[1:3]
    array([[0.5  , 0.   , 0.5  , 0.   ],
           [0.125, 0.375, 0.375, 0.125]])
    """
    raise NotImplementedError("exercise 11.8: loop_edge_rows")


def loop_faces(faces, corner_edge, vertex_count):  # extra 11.9 (2 points)
    """Each triangle A B C becomes (A, AB, CA), (AB, B, BC), (CA, BC, C), (AB, BC, CA).

    faces (F, 3), corner_edge (3 F,) of `edges_of` -> (4 F, 3), face by face. The new vertex on
    edge e has the number vertex_count + e.

    >>> loop_faces(np.array([[0, 1, 2]]), np.array([0, 2, 1]), 3)
    array([[0, 3, 4],
           [3, 1, 5],
           [4, 5, 2],
           [3, 5, 4]])
    """
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)


def loop_step(faces, vertex_count, weight=warren_weight):
    """Loop's S, sparse (V + E, V), and the new faces (4 F, 3).

    faces (F, 3), weight: warren_weight or loop_weight. ValueError: see `topology`.
    """
    corners, counts = triangles(faces)
    edges, corner_edge, is_boundary = topology(corners, counts, vertex_count)
    faces = corners.reshape(-1, 3)
    u = weight(np.maximum(valences(edges, vertex_count), 1))
    at_vertices = vertex_rows(edges, is_boundary, u, 1 / 8)
    on_edges = loop_edge_rows(faces, edges, corner_edge)
    S = scipy.sparse.vstack([as_matrix(at_vertices, (vertex_count, vertex_count)),
                             as_matrix(on_edges, (len(edges), vertex_count))], "csr")
    return S, loop_faces(faces, corner_edge, vertex_count)


def loop_matrix(faces, vertex_count, weight=warren_weight):
    """S of `loop_step`: S @ x subdivides whatever sits at the vertices, uv or colour."""
    return loop_step(faces, vertex_count, weight)[0]


def loop(vertices, faces, weight=warren_weight):
    """One step of Loop: vertices (V, C), faces (F, 3) -> vertices (V + E, C), faces (4 F, 3).

    ValueError: see `topology`.
    """
    S, new_faces = loop_step(faces, len(vertices), weight)
    return S @ np.asarray(vertices), new_faces


def loop_backward(grad_new, vertices, faces, weight=warren_weight):
    """Backward of `loop`: grad_new (V + E, C) -> grad_vertices (V, C)."""
    # Eq. (2): S_ij is the derivative of new_i with respect to old_j. So the gradient with respect
    # to old_j is the sum of S_ij grad_new_i over i, which is S^T grad_new.
    return loop_matrix(faces, len(vertices), weight).T @ np.asarray(grad_new)


# The limit


def limit_weight(n, u):  # extra 11.14 (1 point)
    """Eq. (6): valences n (...) and their weights u (...) of eq. (4) -> m (...).

    >>> limit_weight(np.array([6]), np.array([1 / 16])).round(9)
    array([0.08333333])
    """
    return 1 / (n + 3 / (8 * u))


def loop_limit_matrix(faces, vertex_count, weight=warren_weight):
    """Eq. (6): sparse (V, V). It moves each vertex to its place after infinitely many steps.

    faces (F, 3), weight: that of the steps. ValueError: see `topology`.
    """
    edges, _, is_boundary = topology(*triangles(faces), vertex_count)
    n = np.maximum(valences(edges, vertex_count), 1)
    m = limit_weight(n, weight(n))
    return as_matrix(vertex_rows(edges, is_boundary, m, 1 / 6), (vertex_count, vertex_count))


def loop_surface(cage, faces, steps):
    """A cage's surface: after this many steps, with each vertex moved to its limit.

    cage (V, C), faces (F, 3) -> vertices (V', C), faces (4^steps F, 3). ValueError: see `topology`.
    """
    for _ in range(steps):
        cage, faces = loop(cage, faces)
    return loop_limit_matrix(faces, len(cage)) @ cage, faces


def loop_surface_backward(grad_surface, faces, vertex_count, steps):  # exercise 11.16 (3 points)
    """Backward of `loop_surface`: the gradient with respect to the cage, (V, C).

    grad_surface (V', C), faces (F, 3) and vertex_count V of the cage. `loop_step` is given. Section
    8 of the lecture pulls a cage with this gradient.

    >>> tetrahedron = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]])
    >>> grad_surface = np.zeros((10, 1))
    >>> grad_surface[0] = 160.0  # of vertex 0, after one step
    >>> loop_surface_backward(grad_surface, tetrahedron, 4, 1)[:, 0].round(9)
    array([64., 32., 32., 32.])
    """
    raise NotImplementedError("exercise 11.16: loop_surface_backward")
