"""Subdivision: a coarse mesh becomes a fine one, and in the limit a smooth surface.

    new_i = sum_j S_ij old_j,   grad_old_j = sum_i S_ij grad_new_i     S knows the faces alone   (1)
    V - E + F = 2 - 2 genus - holes, of a connected, orientable surface: S keeps it              (2)

Loop, for triangles: each is cut in four. An edge A B has C and D opposite to it; a vertex v has n
neighbours, its ring; if it is on the boundary, a and b are beside it there.

    edge     3/8 (A + B) + 1/8 (C + D)         on the boundary   1/2 (A + B)                     (3)
    vertex   (1 - n u) v + u sum(ring)         on the boundary   3/4 v + 1/8 (a + b)             (4)
    u = 3/16 for n = 3, else 3/(8 n)  (Warren);   (5/8 - (3/8 + cos(2 pi/n)/4)^2)/n  (Loop)      (5)
    limit    (1 - n m) v + m sum(ring),  m = 1/(n + 3/(8 u));    2/3 v + 1/6 (a + b)             (6)

Catmull-Clark, for all polygons: one of k corners is cut in k quads. F is the mean of the face
points around v, R that of the middles of its edges; diagonals: across each quad from v.

    face     f = mean(corners)                                                                   (7)
    edge     (A + B + f_1 + f_2) / 4           on the boundary   1/2 (A + B)                     (8)
    vertex   (F + 2 R + (n - 3) v) / n         on the boundary   as in (4)                       (9)
    limit    (n^2 v + 4 sum(ring) + sum(diagonals)) / (n (n + 5)),   for quads;   as in (6)     (10)

Polygons are two arrays: corners (C,), the vertices of all faces in a row, and counts (F,), how many
are each face's. `topology` says which meshes are accepted. Sources: a lecture on geometry, its
course's number 12; Loop 1987; Catmull, Clark 1978; Warren 1995; Halstead et al. 1993 (10).
"""
import numpy as np
import scipy.sparse


def next_corner(counts):
    """Where in `corners` the next corner of the same face stands: counts (F,) -> (C,).

    >>> next_corner(np.array([3, 4]))
    array([1, 2, 0, 4, 5, 6, 3])
    """
    following = np.arange(1, counts.sum() + 1)
    last = np.cumsum(counts) - 1
    following[last] = last + 1 - counts
    return following


def edges(corners, counts):  # exercise 11.1 (3 points)
    """The edges (E, 2) of a mesh, and corner_edge (C,): which of them runs from each corner to the
    next corner of its face (`next_corner`).

    corners (C,), of any integer type, counts (F,), F >= 1. An edge is a pair of vertices, low <
    high, and is there once, however many faces have it. Edges ascend: by low, and those of equal
    low by high.

    >>> edges(np.array([0, 1, 2, 2, 1, 3]), np.array([3, 3]))  # two triangles with the edge 1 2
    (array([[0, 1],
           [0, 2],
           [1, 2],
           [1, 3],
           [2, 3]]), array([0, 2, 1, 2, 3, 4]))
    """
    start = corners.astype(np.int64)  # a product of two narrow numbers would not fit
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def on_boundary(corner_edge):  # exercise 11.2 (1 point)
    """Which edges belong to one face only: corner_edge (C,) of `edges` -> bool (E,).

    >>> on_boundary(np.array([0, 2, 1, 2, 3, 4]))
    array([ True,  True, False,  True,  True])
    """
    return np.bincount(corner_edge) == 1


def valences(edges, vertex_count):  # exercise 11.3 (1 point)
    """How many edges end at each vertex: edges (E, 2) -> n (V,), 0 for a vertex of no edge.

    >>> valences(np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]), 5)
    array([2, 3, 3, 2, 0])
    """
    return np.bincount(edges.ravel(), minlength=vertex_count)


def is_extraordinary(valence, at_boundary, regular):  # exercise 11.4 (1 point)
    """Which vertices are not as in a regular grid: bool (V,).

    valence (V,), at_boundary (V,) bool; regular: 6 for a mesh of triangles, 4 for one of quads.
    Inside, a vertex has that valence; on a straight boundary it sees half of the faces, which is 4
    edges for triangles and 3 for quads. All others are extraordinary, but those of valence 0.

    >>> at_boundary = np.array([False, False, True, True, False])
    >>> is_extraordinary(np.array([6, 4, 4, 6, 0]), at_boundary, 6)
    array([False,  True, False,  True, False])
    """
    return (valence != np.where(at_boundary, regular // 2 + 1, regular)) & (valence > 0)


def euler_characteristic(corners, counts):  # exercise 11.5 (1 point)
    """Eq. (2): V - E + F, a whole number. corners (C,), counts (F,), F >= 1.

    V counts the vertices that are corners of a face, and no others.

    >>> euler_characteristic(np.array([0, 1, 9, 9, 1, 3]), np.array([3, 3]))  # 4 - 5 + 2
    1
    """
    return len(np.unique(corners)) - len(edges(corners, counts)[0]) + len(counts)


# Loop, point by point

def loop_edge_point(ends, opposite):  # exercise 11.6 (1 point)
    """Eq. (3): the new point on an edge -> (C,).

    ends (2, C): A and B; opposite (2, C): C and D, or (1, C) on the boundary, where it is not used.
    Points have any number C of coordinates, here and below: 3 in space, 2 for uv.

    >>> loop_edge_point(np.array([[0.0, 8.0], [8.0, 0.0]]), np.array([[0.0, 0.0], [16.0, 8.0]]))
    array([5., 4.])
    """
    if len(opposite) == 1:
        return (ends[0] + ends[1]) / 2
    return 3 / 8 * (ends[0] + ends[1]) + 1 / 8 * (opposite[0] + opposite[1])


def warren_weight(n):  # exercise 11.7 (1 point)
    """Eq. (5), Warren's: valences n (...), whole numbers >= 1 -> u (...).

    >>> warren_weight(np.array([3, 4, 6]))
    array([0.1875 , 0.09375, 0.0625 ])
    """
    return np.where(n == 3, 3 / 16, 3 / (8 * n))


def loop_weight(n):  # exercise 11.8 (1 point)
    """Eq. (5), Loop's own: valences n (...), whole numbers >= 1 -> u (...).

    >>> loop_weight(np.array([3, 4, 6]))
    array([0.1875    , 0.12109375, 0.0625    ])
    """
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2) / n


def ring_point(v, ring, u):  # exercise 11.9 (1 point)
    """Eq. (4) inside: where a vertex goes, v (C,), ring (n, C), u a number -> (C,).

    n may be 0; then it stays.

    >>> ring_point(np.array([8.0]), np.array([[0.0], [16.0], [16.0]]), 3 / 16)
    array([9.5])
    """
    return (1 - len(ring) * u) * v + u * ring.sum(0)


def curve_point(v, beside):  # exercise 11.10 (1 point)
    """Eq. (4) on the boundary: where a vertex goes, v (C,), beside (2, C): a and b -> (C,).

    >>> curve_point(np.array([8.0]), np.array([[0.0], [24.0]]))
    array([9.])
    """
    return 3 / 4 * v + 1 / 8 * (beside[0] + beside[1])


def polygons(corners, counts):
    """The faces one by one: a list of F arrays, each the corners of a face."""
    return np.split(corners, np.cumsum(counts)[:-1])


def faces_at_edges(corners, counts):
    """{(low, high): list of the faces at this edge}, in the order of `edges`."""
    found = {}
    for f, polygon in enumerate(polygons(corners, counts)):
        for a, b in zip(polygon, np.roll(polygon, -1), strict=True):
            found.setdefault((min(a, b), max(a, b)), []).append(f)
    return dict(sorted(found.items()))


def ring_of(v, at_edge):
    """The neighbours of vertex v, and those of them that are beside it on the boundary: two lists.

    at_edge: from `faces_at_edges`.
    """
    ring = {a + b - v: faces for (a, b), faces in at_edge.items() if v in (a, b)}
    return list(ring), [other for other, faces in ring.items() if len(faces) == 1]


def loop_slow(vertices, faces, u):  # exercise 11.11 (4 points)
    """One step of Loop, vertex by vertex and edge by edge. Slow and obvious.

    vertices (V, C), faces (F, 3), u (V,): the weight of each vertex -> the new points (V + E, C):
    the V old vertices, moved, then one for each edge, in the order of `edges`. A vertex of no face
    stays; u of one on the boundary is not used. `faces_at_edges` and `ring_of` tell who is near.

    >>> triangle = np.array([[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]])
    >>> loop_slow(triangle, np.array([[0, 1, 2]]), np.full(3, 3 / 16))
    array([[1., 1.],
           [6., 1.],
           [1., 6.],
           [4., 0.],
           [0., 4.],
           [4., 4.]])
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, beside = ring_of(v, at_edge)
        points.append(curve_point(vertices[v], vertices[beside]) if beside else
                      ring_point(vertices[v], vertices[ring], u[v]))
    for edge, its_faces in at_edge.items():
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(loop_edge_point(vertices[list(edge)], vertices[opposite]))
    return np.stack(points)


# The same as one matrix, written as its entries (row, column, weight)

def product(weights, old, rows, columns, count):  # exercise 11.12 (2 points)
    """Eq. (1): new (count, C), the product of S, as entries, and old (M, C), C >= 1.

    weights (N,), rows (N,), columns (N,), in any order. Entries of the same row and column add up;
    a row without entries gives 0.

    >>> old = np.array([[1.0], [10.0]])
    >>> product(np.array([2.0, 3.0, 4.0]), old, np.array([2, 0, 2]), np.array([1, 0, 1]), 3)
    array([[ 3.],
           [ 0.],
           [60.]])
    """
    pulled = weights[:, None] * old[columns]
    return np.stack([np.bincount(rows, channel, count) for channel in pulled.T], axis=1)


def product_backward(grad_new, weights, old, rows, columns, count):  # exercise 11.13 (3 points)
    """Backward of `product`: grad_new (count, C) -> grad_weights (N,), grad_old (M, C).

    >>> weights, old = np.array([2.0, 3.0, 4.0]), np.array([[1.0], [10.0]])
    >>> rows, columns = np.array([2, 0, 2]), np.array([1, 0, 1])
    >>> grad_new = np.array([[1.0], [7.0], [5.0]])
    >>> product_backward(grad_new, weights, old, rows, columns, 3)
    (array([50.,  1., 50.]), array([[ 3.],
           [30.]]))
    """
    # d new_i = sum of dS_ij old_j + S_ij d old_j: by old, rows and columns change places.
    grad_weights = (grad_new[rows] * old[columns]).sum(1)
    return grad_weights, product(weights, grad_new, columns, rows, len(old))


def pull_entries(rows, columns, u):  # exercise 11.14 (2 points)
    """The entries of sums of pulls: each adds u (x_column - x_row) to the new point of its row.

    rows, columns, u (N,) -> rows, columns, weights of entries, as many as you like, in any order.
    All old vertices move by such pulls: a row of S is then 1 on the diagonal and pulls, and its sum
    is 1 whatever u is. Here and below, entries are compared by the matrix that they add up to.

    >>> pull_entries(np.array([5]), np.array([2]), np.array([0.25]))
    (array([5, 5]), array([2, 5]), array([ 0.25, -0.25]))
    """
    return (np.concatenate([rows, rows]), np.concatenate([columns, rows]),
            np.concatenate([u, -u]))


def join(*entries):
    """Several tuples rows, columns, weights as one."""
    return tuple(np.concatenate(part) for part in zip(*entries, strict=True))


def vertex_rows(edges, is_boundary, u, beside):  # exercise 11.15 (4 points)
    """Eq. (4) for all old vertices: the entries (rows, columns, weights) of V rows and V columns.

    edges (E, 2), is_boundary (E,) bool, u (V,). Inside, v is pulled by u[v] to each neighbour. A
    vertex at the end of a boundary edge is pulled by the number `beside` to each neighbour along
    such edges and to no other; its u is not used. So beside is 1/8 in (4) and 1/6 in (6). A vertex
    of no edge stays.

    >>> edges, is_boundary = np.array([[0, 1], [1, 2]]), np.array([True, False])
    >>> entries = vertex_rows(edges, is_boundary, np.array([9.0, 9.0, 0.5, 9.0]), 0.125)
    >>> as_matrix(entries, (4, 4)).toarray()
    array([[0.875, 0.125, 0.   , 0.   ],
           [0.125, 0.875, 0.   , 0.   ],
           [0.   , 0.5  , 0.5  , 0.   ],
           [0.   , 0.   , 0.   , 1.   ]])
    """
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    along = np.concatenate([is_boundary, is_boundary])
    at_boundary = np.isin(every, edges[is_boundary])
    pulled = along | ~at_boundary[start]
    strength = np.where(along, beside, u[start])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))


def loop_edge_rows(faces, edges, corner_edge):  # exercise 11.16 (3 points)
    """Eq. (3) for all edges: the entries (rows, columns, weights) of E rows and V columns.

    faces (F, 3); edges (E, 2) and corner_edge (3 F,), as `edges` gives them for faces.ravel().

    >>> faces, corner_edge = np.array([[0, 1, 2], [2, 1, 3]]), np.array([0, 2, 1, 2, 3, 4])
    >>> edges = np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]])
    >>> as_matrix(loop_edge_rows(faces, edges, corner_edge), (5, 4)).toarray()[1:3]
    array([[0.5  , 0.   , 0.5  , 0.   ],
           [0.125, 0.375, 0.375, 0.125]])
    """
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = ~is_boundary[corner_edge]
    opposite = np.roll(faces, 1, axis=1).ravel()  # to the edge from a corner to the next
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_faces(faces, corner_edge, vertex_count):  # exercise 11.17 (2 points)
    """Each triangle as four: faces (F, 3), corner_edge (3 F,) of `edges` -> (4 F, 3).

    The new vertex on edge e has the number vertex_count + e. Of face f with the corners A, B, C and
    the new vertices AB, BC, CA on its edges, rows 4 f to 4 f + 3 are (A, AB, CA), (AB, B, BC),
    (CA, BC, C), (AB, BC, CA): corner k of child k is the old one, the last is in the middle.

    >>> loop_faces(np.array([[0, 1, 2]]), np.array([0, 2, 1]), 3)
    array([[0, 3, 4],
           [3, 1, 5],
           [4, 5, 2],
           [3, 5, 4]])
    """
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)


def limit_weight(n, u):  # exercise 11.18 (1 point)
    """Eq. (6): m (...), from the valences n (...) and the weights u (...) > 0 of (4).

    >>> limit_weight(np.array([6]), np.array([1 / 16])).round(9)
    array([0.08333333])
    """
    return 1 / (n + 3 / (8 * u))


# Catmull-Clark, point by point

def catmull_clark_edge_point(ends, face_points):  # exercise 11.19 (1 point)
    """Eq. (8): the new point on an edge -> (C,).

    ends (2, C): A and B; face_points (2, C), or (1, C) on the boundary, where it is not used.

    >>> catmull_clark_edge_point(np.array([[0.0], [8.0]]), np.array([[16.0], [4.0]]))
    array([7.])
    """
    if len(face_points) == 1:
        return (ends[0] + ends[1]) / 2
    return (ends[0] + ends[1] + face_points[0] + face_points[1]) / 4


def catmull_clark_vertex_point(v, ring, face_points):  # exercise 11.20 (2 points)
    """Eq. (9) inside: where a vertex goes -> (C,).

    v (C,), ring (n, C): its neighbours, face_points (n, C), n >= 1.

    >>> v, ring, face_points = np.array([9.0]), np.array([[0.0]] * 3), np.array([[3.0]] * 3)
    >>> catmull_clark_vertex_point(v, ring, face_points)
    array([4.])
    """
    middles = (v + ring) / 2
    return (face_points.mean(0) + 2 * middles.mean(0) + (len(ring) - 3) * v) / len(ring)


def catmull_clark_slow(vertices, corners, counts):  # exercise 11.21 (4 points)
    """One step of Catmull-Clark, point by point. Slow and obvious.

    vertices (V, C), corners, counts -> the new points (V + E + F, C): the V old vertices, moved;
    one for each edge, in the order of `edges`; one for each face. A vertex of no face stays.
    `polygons`, `faces_at_edges` and `ring_of` tell who is near.

    >>> square = np.array([[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]])
    >>> catmull_clark_slow(square, np.array([0, 1, 2, 3]), np.array([4]))[[0, 1, 4, 8]]
    array([[1., 1.],
           [7., 1.],
           [4., 0.],
           [4., 4.]])
    """
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, beside = ring_of(v, at_edge)
        if beside:
            points.append(curve_point(vertices[v], vertices[beside]))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            points.append(catmull_clark_vertex_point(vertices[v], vertices[ring],
                                                     face_points[around]))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge.items():
        points.append(catmull_clark_edge_point(vertices[list(edge)], face_points[its_faces]))
    return np.concatenate([points, face_points])


# The same as one matrix: S = T P, where P old is the old vertices and below them the face points

def face_rows(corners, counts):  # exercise 11.22 (1 point)
    """Eq. (7) for all faces: the entries (rows, columns, weights) of F rows and V columns.

    >>> as_matrix(face_rows(np.array([0, 1, 2, 2, 1, 3, 0]), np.array([3, 4])), (2, 4)).toarray()
    array([[0.33333333, 0.33333333, 0.33333333, 0.        ],
           [0.25      , 0.25      , 0.25      , 0.25      ]])
    """
    return np.repeat(np.arange(len(counts)), counts), corners, np.repeat(1 / counts, counts)


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):  # exercise 11.23 (3 points)
    """Eq. (8) for all edges: the entries (rows, columns, weights) of E rows and V + F columns.

    Column v is old vertex v; column V + f is the face point of f; V is vertex_count. edges (E, 2),
    corner_edge (C,) of `edges`, counts (F,).

    >>> edges = np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]])
    >>> corner_edge, counts = np.array([0, 2, 1, 2, 3, 4]), np.array([3, 3])
    >>> entries = catmull_clark_edge_rows(edges, corner_edge, counts, 4)
    >>> as_matrix(entries, (5, 6)).toarray()[1:3]
    array([[0.5 , 0.  , 0.5 , 0.  , 0.  , 0.  ],
           [0.  , 0.25, 0.25, 0.  , 0.25, 0.25]])
    """
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 1 / 4)
    inside = ~is_boundary[corner_edge]
    face_point = vertex_count + np.repeat(np.arange(len(counts)), counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):  # exercise 11.24 (4 points)
    """Eq. (9) for all old vertices: the entries (rows, columns, weights) of V rows, V + F columns.

    Columns as in `catmull_clark_edge_rows`. edges (E, 2), is_boundary (E,); n (V,): the valences.
    In (9), v is also in R: collect what pulls v, and how much. A vertex at the end of a boundary
    edge follows (4); one of valence 0 stays.

    >>> edges = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])  # a tetrahedron
    >>> corners, counts = np.array([0, 1, 2, 0, 2, 3, 0, 3, 1, 3, 2, 1]), np.full(4, 3)
    >>> n, is_boundary = np.full(4, 3), np.zeros(6, bool)
    >>> entries = catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n)
    >>> (9 * as_matrix(entries, (4, 8)).toarray()).round(9)[:2]
    array([[3., 1., 1., 1., 1., 1., 1., 0.],
           [1., 3., 1., 1., 1., 0., 1., 1.]])
    """
    # n (new - v) = (F - v) + 2 (R - v), and R - v is half the mean of ring - v: so each neighbour
    # and each face point pulls by 1/n^2.
    u = 1 / np.maximum(n, 1) ** 2
    inside = ~np.isin(corners, edges[is_boundary])
    face_point = len(n) + np.repeat(np.arange(len(counts)), counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):  # exercise 11.25 (2 points)
    """Each polygon as quads, one for each of its corners: (C, 4), in the order of `corners`.

    The new vertex on edge e has the number V + e, that of face f V + E + f; V is vertex_count. The
    quad of a corner: this vertex, the one on the edge to the next corner, that of the face, the one
    on the edge from the corner before. corner_edge (C,) of `edges`, whose greatest number is E - 1.

    >>> catmull_clark_faces(np.array([0, 1, 2]), np.array([3]), np.array([0, 2, 1]), 3)
    array([[0, 3, 6, 4],
           [1, 5, 6, 3],
           [2, 4, 6, 5]])
    """
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[next_corner(counts)] = ahead
    middle = vertex_count + corner_edge.max() + 1 + np.repeat(np.arange(len(counts)), counts)
    return np.stack([corners, ahead, middle, behind], axis=1)


def catmull_clark_limit_rows(edges, is_boundary, quads, n):  # exercise 11.26 (3 points)
    """Eq. (10) for all vertices of a mesh of quads (F, 4): entries of V rows and V columns.

    edges (E, 2), is_boundary (E,), n (V,): the valences. A vertex at the end of a boundary edge has
    the limit of (6); one of valence 0 stays.

    >>> quads = np.array([[0, 1, 3, 2], [2, 3, 1, 0]])  # a square, front and back
    >>> edges, is_boundary = np.array([[0, 1], [0, 2], [1, 3], [2, 3]]), np.zeros(4, bool)
    >>> entries = catmull_clark_limit_rows(edges, is_boundary, quads, np.full(4, 2))
    >>> (14 * as_matrix(entries, (4, 4)).toarray()).round(9)[0]
    array([4., 4., 4., 2.])
    """
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 2, axis=1)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 6),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))


# Whole meshes

def as_matrix(entries, shape):
    """Entries (rows, columns, weights) -> a sparse matrix; entries of one place are added up."""
    rows, columns, weights = entries
    return scipy.sparse.csr_array((weights, (rows, columns)), shape=shape)


def topology(corners, counts, vertex_count):
    """The edges (E, 2), corner_edge (C,) and is_boundary (E,) of a sound mesh.

    ValueError for any other: at an edge at most two faces meet, and at a vertex one fan of faces.
    Vertices may be unused or in one place, faces without area, holes and handles many, and faces
    may be wound either way: no rule asks for it.
    """
    check_polygons(corners, counts, vertex_count)
    pairs, corner_edge = edges(corners, counts)
    face_count = np.bincount(corner_edge)
    if face_count.max() > 2:
        low, high = pairs[face_count.argmax()]
        raise ValueError(f"the edge between vertices {low} and {high} has {face_count.max()} "
                         "faces: at most two may meet at an edge")
    fans = fans_of_vertices(corners, counts, pairs, corner_edge)
    if fans.max() > 1:
        raise ValueError(f"at vertex {fans.argmax()} meet {fans.max()} fans of faces that share no "
                         "edge there: give each fan a vertex of its own")
    return pairs, corner_edge, face_count == 1


def check_polygons(corners, counts, vertex_count):
    """Nothing for at least one polygon between vertices that are there, else a ValueError."""
    for name, numbers in (("corners", corners), ("counts", counts)):
        whole = numbers.dtype.kind in "iu" and np.can_cast(numbers.dtype, np.int64)
        if numbers.ndim != 1 or len(numbers) == 0 or not whole:
            raise ValueError(f"{name} must be integers in a row, at least one, of a type that fits "
                             f"int64; got {numbers.shape} of {numbers.dtype}")
    if counts.min() < 3 or counts.sum() != len(corners):
        raise ValueError("counts must be at least 3 for each face and add up to the number of "
                         f"corners, {len(corners)}; the least is {counts.min()}, "
                         f"the sum is {counts.sum()}")
    face = np.repeat(np.arange(len(counts)), counts)
    outside = (corners < 0) | (corners >= vertex_count)
    if outside.any():
        raise ValueError(f"face {face[outside][0]} names vertex {corners[outside][0]}, but there "
                         f"are {vertex_count} vertices, counted from 0")
    order = np.lexsort((corners, face))
    twice = (np.diff(corners[order]) == 0) & (np.diff(face[order]) == 0)
    if twice.any():
        corner = order[twice.argmax()]
        raise ValueError(f"face {face[corner]} names vertex {corners[corner]} twice: "
                         "leave such faces out")


def fans_of_vertices(corners, counts, edges, corner_edge):
    """How many fans, of faces that hang together by edges, there are at each vertex: (V,)."""
    # Two corners at a vertex hang together if their faces have an edge there: link both to its end.
    corner, following = np.arange(len(corners)), next_corner(counts)
    is_high = corners == edges[corner_edge, 1]
    ends = 2 * corner_edge + np.array([is_high, ~is_high]) + len(corners)
    links = np.concatenate([corner, following]), ends.ravel()
    size = len(corners) + 2 * len(edges)
    graph = scipy.sparse.coo_array((np.ones(len(links[0])), links), shape=(size, size))
    fan = scipy.sparse.csgraph.connected_components(graph, directed=False)[1][:len(corners)]
    return np.bincount(corners[np.unique(fan, return_index=True)[1]])


def loop_matrix(faces, vertex_count, weight=warren_weight):
    """Loop's S, sparse (V + E, V): S @ x subdivides whatever sits at the vertices, uv or colour.

    faces (F, 3); weight: warren_weight or loop_weight. ValueError: see `topology`.
    """
    pairs, corner_edge, is_boundary = topology(*triangles(faces), vertex_count)
    u = weight(np.maximum(valences(pairs, vertex_count), 1))
    return scipy.sparse.vstack([
        as_matrix(vertex_rows(pairs, is_boundary, u, 1 / 8), (vertex_count, vertex_count)),
        as_matrix(loop_edge_rows(faces, pairs, corner_edge), (len(pairs), vertex_count))], "csr")


def triangles(faces):
    """faces (F, 3) -> corners, counts. ValueError for another shape."""
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise ValueError(f"faces must be an array (F, 3) of integers, got {faces.shape}")
    return faces.ravel(), np.full(len(faces), 3)


def loop(vertices, faces, weight=warren_weight):
    """One step of Loop: vertices (V, C), faces (F, 3) -> vertices (V + E, C), faces (4 F, 3)."""
    new = loop_matrix(faces, len(vertices), weight) @ vertices
    _, corner_edge = edges(*triangles(faces))
    return new, loop_faces(faces, corner_edge, len(vertices))


def loop_backward(grad_new, vertices, faces, weight=warren_weight):
    """Backward of `loop`: grad_new (V + E, C) -> grad_vertices (V, C)."""
    return loop_matrix(faces, len(vertices), weight).T @ grad_new


def loop_limit_matrix(faces, vertex_count, weight=warren_weight):
    """Eq. (6): sparse (V, V), which moves the vertices to where infinitely many steps take them."""
    pairs, _, is_boundary = topology(*triangles(faces), vertex_count)
    n = np.maximum(valences(pairs, vertex_count), 1)
    m = limit_weight(n, weight(n))
    return as_matrix(vertex_rows(pairs, is_boundary, m, 1 / 6), (vertex_count, vertex_count))


def catmull_clark_matrix(corners, counts, vertex_count):
    """Catmull and Clark's S, sparse (V + E + F, V). ValueError: see `topology`."""
    pairs, corner_edge, is_boundary = topology(corners, counts, vertex_count)
    face_points = as_matrix(face_rows(corners, counts), (len(counts), vertex_count))
    known = scipy.sparse.vstack([scipy.sparse.eye_array(vertex_count), face_points], "csr")
    width = vertex_count + len(counts)
    n = valences(pairs, vertex_count)
    at_vertices = catmull_clark_vertex_rows(pairs, is_boundary, corners, counts, n)
    on_edges = catmull_clark_edge_rows(pairs, corner_edge, counts, vertex_count)
    moved = scipy.sparse.vstack([as_matrix(at_vertices, (vertex_count, width)),
                                 as_matrix(on_edges, (len(pairs), width))], "csr")
    return scipy.sparse.vstack([moved @ known, face_points], "csr")


def catmull_clark(vertices, corners, counts):
    """One step of Catmull-Clark -> vertices (V + E + F, C), corners, counts, all 4.

    vertices (V, C), corners, counts. The new faces as (N, 4): corners.reshape(-1, 4).
    """
    new = catmull_clark_matrix(corners, counts, len(vertices)) @ vertices
    _, corner_edge = edges(corners, counts)
    quads = catmull_clark_faces(corners, counts, corner_edge, len(vertices))
    return new, quads.ravel(), np.full(len(quads), 4)


def catmull_clark_backward(grad_new, vertices, corners, counts):
    """Backward of `catmull_clark`: grad_new (V + E + F, C) -> grad_vertices (V, C)."""
    return catmull_clark_matrix(corners, counts, len(vertices)).T @ grad_new


def catmull_clark_limit_matrix(corners, counts, vertex_count):
    """Eq. (10): sparse (V, V), to the limit surface. ValueError unless all faces are quads."""
    if (counts != 4).any():
        raise ValueError(f"face {(counts != 4).argmax()} is no quad: the limit is known for quads "
                         "only; subdivide once first")
    pairs, _, is_boundary = topology(corners, counts, vertex_count)
    n = valences(pairs, vertex_count)
    entries = catmull_clark_limit_rows(pairs, is_boundary, corners.reshape(-1, 4), n)
    return as_matrix(entries, (vertex_count, vertex_count))
