"""Catmull-Clark subdivision, for all polygons: one of k corners is cut in k quads.

Each face gets a point f. Each edge A B gets a point, too, and f_1 and f_2 are the points of its two
faces. A vertex v has n neighbours, its ring. F is the mean of the face points around v, R is the
mean of the middles of its edges. The diagonals are the vertices across each quad from v.

    face     f = mean(corners)                                                                 (7)
    edge     (A + B + f_1 + f_2) / 4        on the boundary   1/2 (A + B)                      (8)
    vertex   (F + 2 R + (n - 3) v) / n      on the boundary   (3) with w = 1/8                 (9)
    limit    (n^2 v + 4 sum(ring) + sum(diagonals)) / (n (n + 5))    (3) with w = 1/6         (10)

(3) is in subdivision.py. (10) holds for meshes of quads. After one step all meshes are.

Sources: a lecture on geometry, Catmull and Clark 1978, Halstead et al. 1993 for (10).
"""
import numpy as np
import scipy.sparse

from .subdivision import (
    as_matrix,
    as_polygons,
    edges_of,
    face_of_corner,
    faces_at_edges,
    join,
    next_corner,
    on_boundary,
    polygons,
    pull_entries,
    ring_of,
    topology,
    valences,
    vertex_rows,
)

# The new faces


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):  # step 11.6
    """Each polygon as quads, one for each of its corners: (C, 4), in the order of `corners`.

    With V = vertex_count, edge e has the new vertex V + e, face f has V + E + f. A corner's quad is
    itself, the vertices on its edge ahead, in the face, on its edge behind. corner_edge (C,).

    >>> catmull_clark_faces(np.array([0, 1, 2]), np.array([3]), np.array([0, 2, 1]), 3)
    array([[0, 3, 6, 4],
           [1, 5, 6, 3],
           [2, 4, 6, 5]])
    """
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[next_corner(counts)] = ahead
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([corners, ahead, middle, behind], axis=1)


# Point by point: slow and obvious


def catmull_clark_slow(vertices, corners, counts):  # exercise 11.7 (3 points)
    """A whole step, point by point: eqs. (7) to (9), then `catmull_clark_faces`.

    vertices (V, C), corners, counts -> vertices (V + E + F, C), quads. The old vertices come first,
    then the edges in the order of `faces_at_edges`, then the faces in that of `polygons`. `ring_of`
    tells who is near. See `demo house`.

    >>> square = np.array([[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]])
    >>> vertices, quads = catmull_clark_slow(square, np.array([0, 1, 2, 3]), np.array([4]))
    >>> vertices[[0, 1, 4, 8]].tolist(), quads[0]
    ([[1.0, 1.0], [7.0, 1.0], [4.0, 0.0], [4.0, 4.0]], array([0, 4, 8, 5]))

    Fine print. A vertex of no face stays: eq. (9) would divide by 0.
    """
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:  # v is on the boundary
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            F = face_points[[v in face for face in faces]].mean(0)
            R = ((vertices[v] + vertices[ring]) / 2).mean(0)
            points.append((F + 2 * R + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    _, corner_edge = edges_of(corners, counts)
    quads = catmull_clark_faces(corners, counts, corner_edge, len(vertices))
    return np.concatenate([points, face_points]), quads


# The same as one matrix. P adds the face points to the old vertices. From these V + F points, T
# makes the moved vertices and the edge points. So S is T P, with the face points' rows below it.


def face_rows(corners, counts):
    """Eq. (7) for all faces: the entries (rows, columns, weights) of F rows and V columns.

    >>> as_matrix(face_rows(np.array([0, 1, 2, 2, 1, 3, 0]), np.array([3, 4])), (2, 4)).toarray()
    array([[0.33333333, 0.33333333, 0.33333333, 0.        ],
           [0.25      , 0.25      , 0.25      , 0.25      ]])
    """
    face = face_of_corner(counts)
    return face, corners, (1 / counts)[face]


def catmull_clark_rows(edges, corners, counts, corner_edge, n):  # extra 11.8 (5 points)
    """Eqs. (9) and (8) as one matrix T: the entries of V + E rows and V + F columns.

    Column v is the old vertex v. Column V + f is the face point of f. edges (E, 2), corners (C,),
    counts (F,), corner_edge (C,), n (V,): the valences. Write (9) as pulls at v. A vertex at the
    end of a boundary edge is on the boundary, one of valence 0 stays: `vertex_rows` takes care of
    both.

    >>> corners, counts = np.array([0, 1, 2, 0, 2, 3, 0, 3, 1, 3, 2, 1]), np.full(4, 3)
    >>> edges, corner_edge = edges_of(corners, counts)  # a tetrahedron's
    >>> entries = catmull_clark_rows(edges, corners, counts, corner_edge, np.full(4, 3))
    >>> (36 * as_matrix(entries, (10, 8)).toarray()).round(9)[[0, 1, 4]]
    array([[12.,  4.,  4.,  4.,  4.,  4.,  4.,  0.],
           [ 4., 12.,  4.,  4.,  4.,  0.,  4.,  4.],
           [ 9.,  9.,  0.,  0.,  9.,  0.,  9.,  0.]])
    """
    # n (new - v) = (F - v) + 2 (R - v), and R - v is half the mean of ring - v: so each neighbour
    # and each face point pulls by 1/n^2.
    is_boundary = on_boundary(corner_edge)
    face_point = len(n) + face_of_corner(counts)
    u = 1 / np.maximum(n, 1) ** 2
    moves = ~np.isin(corners, edges[is_boundary])
    at_vertices = join(vertex_rows(edges, is_boundary, u, 1 / 8),
                       pull_entries(corners[moves], face_point[moves], u[corners[moves]]))
    row = len(n) + np.arange(len(edges))
    end_weight = np.where(is_boundary, 1 / 2, 1 / 4)
    inside = ~is_boundary[corner_edge]
    return join(at_vertices, (row, edges[:, 0], end_weight), (row, edges[:, 1], end_weight),
                (row[corner_edge[inside]], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_step(corners, counts, vertex_count):
    """Catmull and Clark's S, sparse (V + E + F, V), and the new faces (C, 4).

    corners (C,), counts (F,). ValueError: see `topology`.
    """
    corners, counts = as_polygons(corners, counts)
    edges, corner_edge, _ = topology(corners, counts, vertex_count)
    face_points = as_matrix(face_rows(corners, counts), (len(counts), vertex_count))
    P = scipy.sparse.vstack([scipy.sparse.eye_array(vertex_count), face_points], "csr")
    entries = catmull_clark_rows(edges, corners, counts, corner_edge,
                                 valences(edges, vertex_count))
    T = as_matrix(entries, (vertex_count + len(edges), P.shape[0]))
    S = scipy.sparse.vstack([T @ P, face_points], "csr")
    return S, catmull_clark_faces(corners, counts, corner_edge, vertex_count)


def catmull_clark_matrix(corners, counts, vertex_count):
    """S of `catmull_clark_step`, sparse (V + E + F, V), for whatever sits at the vertices.

    corners (C,), counts (F,), vertex_count V.
    """
    return catmull_clark_step(corners, counts, vertex_count)[0]


def catmull_clark(vertices, corners, counts):
    """One step of Catmull-Clark -> vertices (V + E + F, C), corners, counts, all 4.

    vertices (V, C), corners (C,), counts (F,). The new faces as (N, 4): corners.reshape(-1, 4).
    ValueError: see `topology`.
    """
    S, quads = catmull_clark_step(corners, counts, len(vertices))
    return S @ np.asarray(vertices), quads.ravel(), np.full(len(quads), 4)


# The limit


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """Eq. (10) for all vertices of a mesh of quads (F, 4): entries of V rows and V columns.

    edges (E, 2), is_boundary (E,), n (V,): the valences. On the boundary and at valence 0,
    `vertex_rows` is right as it is.

    >>> quads = np.array([[0, 1, 3, 2], [2, 3, 1, 0]])  # a square, front and back
    >>> edges, is_boundary = np.array([[0, 1], [0, 2], [1, 3], [2, 3]]), np.zeros(4, bool)
    >>> entries = catmull_clark_limit_rows(edges, is_boundary, quads, np.full(4, 2))
    >>> (14 * as_matrix(entries, (4, 4)).toarray()).round(9)[0]
    array([4., 4., 4., 2.])
    """
    # n neighbours, n diagonals and n (n + 5) = n^2 + 4 n + n: each diagonal pulls by u, each
    # neighbour by 4 u, and v keeps n^2 u.
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 2, axis=1)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 6),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))


def catmull_clark_limit_matrix(corners, counts, vertex_count):
    """Eq. (10): sparse (V, V), to the limit surface.

    corners (C,), counts (F,), vertex_count V. ValueError unless all faces are quads.
    """
    corners, counts = as_polygons(corners, counts)
    edges, _, is_boundary = topology(corners, counts, vertex_count)
    if (counts != 4).any():
        raise ValueError(f"face {(counts != 4).argmax()} is no quad: the limit is known for quads "
                         "only; subdivide once first")
    n = valences(edges, vertex_count)
    entries = catmull_clark_limit_rows(edges, is_boundary, corners.reshape(-1, 4), n)
    return as_matrix(entries, (vertex_count, vertex_count))
