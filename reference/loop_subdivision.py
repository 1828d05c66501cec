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

from .subdivision import (
    as_matrix,
    edges_of,
    faces_at_edges,
    join,
    on_boundary,
    ring_of,
    topology,
    triangles,
    valences,
    vertex_rows,
)

# The weights, and the faces


def warren_weight(n):
    """Eq. (4), Warren's: valences n (...), integers >= 1 -> u (...).

    >>> warren_weight(np.array([3, 4, 6]))
    array([0.1875 , 0.09375, 0.0625 ])
    """
    return np.where(n == 3, 3 / 16, 3 / (8 * n))


def loop_weight(n):
    """Eq. (4), Loop's own: valences n (...), integers >= 1 -> u (...).

    >>> loop_weight(np.array([3, 4, 6]))
    array([0.1875    , 0.12109375, 0.0625    ])
    """
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2) / n


def loop_faces(faces, corner_edge, vertex_count):  # step 11.2
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


# Point by point: slow and obvious


def loop_slow(vertices, faces, u):  # exercise 11.3 (5 points)
    """A whole step of Loop, point by point: (3) with w = 1/8, (5), then `loop_faces`.

    vertices (V, C), faces (F, 3), u (V,) -> vertices (V + E, C), faces (4 F, 3). The old vertices
    come first, then the edges in the order of `faces_at_edges`. `ring_of` tells who is near. See
    `demo rounded`.

    >>> triangle = np.array([[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]])
    >>> vertices, faces = loop_slow(triangle, np.array([[0, 1, 2]]), np.full(3, 3 / 16))
    >>> vertices.tolist(), faces[0]
    ([[1.0, 1.0], [6.0, 1.0], [1.0, 6.0], [4.0, 0.0], [0.0, 4.0], [4.0, 4.0]], array([0, 3, 4]))
    """
    corners, counts = faces.ravel(), np.full(len(faces), 3)
    at_edge = faces_at_edges(corners, counts)
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:  # v is on the boundary
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        else:
            points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        if len(its_faces) == 1:
            points.append(ends / 2)
        else:
            points.append(3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    _, corner_edge = edges_of(corners, counts)
    return np.stack(points), loop_faces(faces, corner_edge, len(vertices))


# The same as one matrix, S. Its transpose is the gradient.


def loop_rows(faces, edges, corner_edge, u):  # exercise 11.5 (5 points)
    """A step of Loop as a matrix S: (3) with w = 1/8, and (5) -> rows, columns, weights.

    faces (F, 3), edges (E, 2), corner_edge (3 F,) of `edges_of`, u (V,). S has V + E rows and V
    columns. Entries of one place add up. `vertex_rows` is a step on the way, `on_boundary` and
    `join` are given. See `demo cage`.

    >>> faces, corner_edge = np.array([[0, 1, 2], [2, 1, 3]]), np.array([0, 2, 1, 2, 3, 4])
    >>> edges = np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]])
    >>> as_matrix(loop_rows(faces, edges, corner_edge, np.ones(4)), (9, 4)).toarray()[[0, 6]]
    array([[0.75 , 0.125, 0.125, 0.   ],
           [0.125, 0.375, 0.375, 0.125]])
    """
    is_boundary = on_boundary(corner_edge)
    row = len(u) + np.arange(len(edges))
    end_weight = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = ~is_boundary[corner_edge]
    opposite = np.roll(faces, 1, axis=1).ravel()  # to the edge that a corner begins
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                (row, edges[:, 0], end_weight), (row, edges[:, 1], end_weight),
                (row[corner_edge[inside]], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_step(faces, vertex_count, weight=warren_weight):
    """Loop's S, sparse (V + E, V), and the new faces (4 F, 3).

    faces (F, 3), weight: warren_weight or loop_weight. ValueError: see `topology`.
    """
    corners, counts = triangles(faces)
    edges, corner_edge, _ = topology(corners, counts, vertex_count)
    faces = corners.reshape(-1, 3)
    entries = loop_rows(faces, edges, corner_edge,
                        weight(np.maximum(valences(edges, vertex_count), 1)))
    S = as_matrix(entries, (vertex_count + len(edges), vertex_count))
    return S, loop_faces(faces, corner_edge, vertex_count)


def loop_matrix(faces, vertex_count, weight=warren_weight):
    """S of `loop_step`, sparse (V + E, V). S @ x subdivides what sits at the vertices, as uv.

    faces (F, 3), vertex_count V, weight as in `loop_step`.
    """
    return loop_step(faces, vertex_count, weight)[0]


def loop(vertices, faces, weight=warren_weight):
    """One step of Loop: vertices (V, C), faces (F, 3) -> vertices (V + E, C), faces (4 F, 3).

    weight: warren_weight or loop_weight. ValueError: see `topology`.
    """
    S, new_faces = loop_step(faces, len(vertices), weight)
    return S @ np.asarray(vertices), new_faces


def loop_backward(grad_new, vertices, faces, weight=warren_weight):
    """Backward of `loop`, with its arguments: grad_new (V + E, C) -> grad_vertices (V, C)."""
    # Eq. (2): S_ij is the derivative of new_i with respect to old_j. So the gradient with respect
    # to old_j is the sum of S_ij grad_new_i over i, which is S^T grad_new.
    return loop_matrix(faces, len(vertices), weight).T @ np.asarray(grad_new)


# The limit


def limit_weight(n, u):
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


def loop_surface_backward(grad_surface, faces, vertex_count, steps):  # exercise 11.9 (2 points)
    """Backward of `loop_surface`: the gradient with respect to the cage, (V, C).

    grad_surface (V', C), faces (F, 3) and vertex_count V of the cage. `loop_step` is given. See
    `demo cage`.

    >>> tetrahedron = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]])
    >>> grad_surface = np.zeros((10, 1))
    >>> grad_surface[0] = 160.0  # of vertex 0, after one step
    >>> loop_surface_backward(grad_surface, tetrahedron, 4, 1)[:, 0].round(9)
    array([64., 32., 32., 32.])
    """
    maps = []
    for _ in range(steps):
        S, faces = loop_step(faces, vertex_count)
        maps.append(S)
        vertex_count = S.shape[0]
    # The surface is L S_2 S_1 times the cage, with L for the limit. So the gradient is
    # S_1^T S_2^T L^T times the surface's own.
    grad = loop_limit_matrix(faces, vertex_count).T @ np.asarray(grad_surface)
    for S in reversed(maps):
        grad = S.T @ grad
    return grad
