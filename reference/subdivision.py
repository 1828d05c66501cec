"""Subdivision: a coarse mesh becomes a fine one, and in the limit a smooth surface.

    new_i = sum_j S_ij old_j,   grad_old_j = sum_i S_ij grad_new_i                               (1)
    V - E + F = 2 - 2 g - b      g handles, b closed boundary curves; one piece, two sides       (2)

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

S, a row for each new point, depends on connectivity only, as (2) does. Polygons are two arrays:
corners (C,), the vertices of all faces in a row, and counts (F,), how many are each face's; which
meshes are accepted, `topology` says. Sources: a lecture on geometry; Loop 1987; Warren 1995;
Catmull, Clark 1978; Halstead et al. 1993 (10)."""
import numpy as np
import scipy.sparse
import scipy.sparse.csgraph


def next_corner(counts):
    """Where in `corners` the next corner of the same face stands: counts (F,) -> (C,).

    >>> next_corner(np.array([3, 4]))
    array([1, 2, 0, 4, 5, 6, 3])
    """
    last = np.cumsum(counts, dtype=np.int64) - 1
    following = np.arange(1, last[-1] + 2)
    following[last] = last + 1 - counts
    return following


def face_of_corner(counts):
    """The number of each corner's face: counts (F,) -> (C,).

    >>> face_of_corner(np.array([3, 4]))
    array([0, 0, 0, 1, 1, 1, 1])
    """
    return np.repeat(np.arange(len(counts)), np.asarray(counts, np.int64))


def edges_of(corners, counts):  # exercise 11.1 (3 points)
    """The edges (E, 2) of a mesh, and corner_edge (C,): which of them runs from each corner to the
    next corner of its face (`next_corner`).

    corners (C,) and counts (F,) of any integer types, F >= 1. An edge is a pair of vertices, low <
    high, and is there once, however many faces have it. Edges ascend: by low, and those of equal
    low by high.

    >>> edges_of(np.array([0, 1, 2, 2, 1, 3]), np.array([3, 3]))  # two triangles with the edge 1 2
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


def on_boundary(corner_edge):
    """Which edges belong to one face only: corner_edge (C,) of `edges_of` -> bool (E,).

    >>> on_boundary(np.array([0, 2, 1, 2, 3, 4]))
    array([ True,  True, False,  True,  True])
    """
    return np.bincount(corner_edge) == 1


def valences(edges, vertex_count):
    """How many edges end at each vertex: edges (E, 2) -> n (V,), 0 for a vertex of no edge.

    >>> valences(np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]), 5)
    array([2, 3, 3, 2, 0])
    """
    return np.bincount(edges.ravel(), minlength=vertex_count)


def is_extraordinary(valence, at_boundary, regular):  # exercise 11.2 (1 point)
    """Which vertices are not as in a regular grid: bool (V,).

    valence (V,), at_boundary (V,) bool; regular: 6 for a mesh of triangles, 4 for one of quads.
    Regular is: valence `regular` inside, `regular / 2 + 1` on the boundary, where half of the faces
    are. All others are extraordinary, but those of valence 0.

    >>> at_boundary = np.array([False, False, True, True, False])
    >>> is_extraordinary(np.array([6, 4, 4, 6, 0]), at_boundary, 6)
    array([False,  True, False,  True, False])
    """
    return (valence != np.where(at_boundary, regular // 2 + 1, regular)) & (valence > 0)


def euler_characteristic(corners, counts):  # exercise 11.3 (1 point)
    """Eq. (2): V - E + F, a whole number. corners (C,), counts (F,), F >= 1.

    V counts the vertices that are corners of a face, and no others.

    >>> euler_characteristic(np.array([0, 1, 9, 9, 1, 3]), np.array([3, 3]))  # 4 - 5 + 2
    1
    """
    return len(np.unique(corners)) - len(edges_of(corners, counts)[0]) + len(counts)


# Loop, point by point

def warren_weight(n):
    """Eq. (5), Warren's: valences n (...), whole numbers >= 1 -> u (...).

    >>> warren_weight(np.array([3, 4, 6]))
    array([0.1875 , 0.09375, 0.0625 ])
    """
    return np.where(n == 3, 3 / 16, 3 / (8 * n))


def loop_weight(n):  # exercise 11.4 (1 point)
    """Eq. (5), Loop's own: valences n (...), whole numbers >= 1 -> u (...).

    >>> loop_weight(np.array([3, 4, 6]))
    array([0.1875    , 0.12109375, 0.0625    ])
    """
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2) / n


def polygons(corners, counts):
    """The faces one by one: a list of F arrays, each the corners of a face."""
    return np.split(corners, np.cumsum(counts)[:-1])


def faces_at_edges(corners, counts):
    """{(low, high): list of the faces at this edge}, in the order of `edges_of`."""
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


def loop_slow(vertices, faces, u):  # exercise 11.5 (5 points)
    """Eqs. (4) and (3), vertex by vertex and edge by edge. Slow and obvious.

    vertices (V, C) of floats, faces (F, 3), u (V,): the weight of each vertex -> the new points
    (V + E, C): the V old vertices, moved, then one for each edge, in the order of `edges_of`. A
    vertex of no face stays; u of one on the boundary is not used. C is any number of coordinates:
    3 in space, 2 for uv. `faces_at_edges` and `ring_of` tell who is near.

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
        if beside:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[beside].sum(0))
        else:
            points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, its_faces in at_edge.items():
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1 else
                      3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


# The same as one matrix, written as its entries (row, column, weight)

def pull_entries(rows, columns, u):  # exercise 11.6 (2 points)
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


def vertex_rows(edges, is_boundary, u, beside):  # exercise 11.7 (4 points)
    """Eq. (4) for all old vertices: the entries (rows, columns, weights) of V rows and V columns.

    edges (E, 2), is_boundary (E,) bool, u (V,). Inside, v is pulled by u[v] to each neighbour. A
    vertex at the end of a boundary edge is pulled by the number `beside` to each neighbour along
    such edges and to no other; its u is not used. A vertex of no edge stays. With other u, and with
    beside 1/8 or 1/6, these rows serve (4), (6), (9) and (10).

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


def loop_edge_rows(faces, edges, corner_edge):  # exercise 11.8 (3 points)
    """Eq. (3) for all edges: the entries (rows, columns, weights) of E rows and V columns.

    faces (F, 3); edges (E, 2) and corner_edge (3 F,), as `edges_of` gives them for faces.ravel().

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


def loop_faces(faces, corner_edge, vertex_count):  # exercise 11.9 (2 points)
    """Each triangle as four: faces (F, 3), corner_edge (3 F,) of `edges_of` -> (4 F, 3).

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


# Catmull-Clark, point by point

def catmull_clark_slow(vertices, corners, counts):  # exercise 11.10 (5 points)
    """Eqs. (9), (8) and (7), point by point. Slow and obvious.

    vertices (V, C) of floats, corners, counts -> the new points (V + E + F, C): the V old vertices,
    moved; one for each edge, in the order of `edges_of`; one for each face. A vertex of no face
    stays. `polygons`, `faces_at_edges` and `ring_of` tell who is near.

    >>> square = np.array([[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]])
    >>> catmull_clark_slow(square, np.array([0, 1, 2, 3]), np.array([4]))[[0, 1, 4, 8]]
    array([[1., 1.],
           [7., 1.],
           [4., 0.],
           [4., 4.]])
    >>> tetrahedron = np.array([0, 1, 2, 0, 2, 3, 0, 3, 1, 3, 2, 1]), np.full(4, 3)
    >>> catmull_clark_slow(np.array([[9.0], [0.0], [0.0], [0.0]]), *tetrahedron)[[0, 4, 7, 10]].T
    array([[4.  , 3.75, 0.75, 3.  ]])
    """
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, beside = ring_of(v, at_edge)
        if beside:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[beside].sum(0))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = (vertices[v] + vertices[ring]) / 2
            points.append((face_points[around].mean(0) + 2 * middles.mean(0)
                           + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge.items():
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


# The same as one matrix: S = T P, where P old is the old vertices and below them the face points

def face_rows(corners, counts):
    """Eq. (7) for all faces: the entries (rows, columns, weights) of F rows and V columns.

    >>> as_matrix(face_rows(np.array([0, 1, 2, 2, 1, 3, 0]), np.array([3, 4])), (2, 4)).toarray()
    array([[0.33333333, 0.33333333, 0.33333333, 0.        ],
           [0.25      , 0.25      , 0.25      , 0.25      ]])
    """
    face = face_of_corner(counts)
    return face, corners, (1 / counts)[face]


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):  # exercise 11.11 (2 points)
    """Eq. (8) for all edges: the entries (rows, columns, weights) of E rows and V + F columns.

    Column v is old vertex v; column V + f is the face point of f, which is known; V is
    vertex_count. edges (E, 2), corner_edge (C,) of `edges_of`, counts (F,).

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
    face_point = vertex_count + face_of_corner(counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):  # exercise 11.12 (4 points)
    """Eq. (9) for all old vertices: the entries (rows, columns, weights) of V rows, V + F columns.

    Columns as in `catmull_clark_edge_rows`. edges (E, 2), is_boundary (E,); n (V,): the valences.
    In (9), v is also in R: collect what pulls v, and how much. A vertex at the end of a boundary
    edge follows (4); one of valence 0 stays. `vertex_rows` may be called.

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
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):  # exercise 11.13 (2 points)
    """Each polygon as quads, one for each of its corners: (C, 4), in the order of `corners`.

    The new vertex on edge e has the number V + e, that of face f V + E + f; V is vertex_count. The
    quad of a corner: this vertex, the one on the edge to the next corner, that of the face, the one
    on the edge from the corner before. corner_edge (C,): of `edges_of`, up to E - 1.

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


# Limits

def limit_weight(n, u):  # exercise 11.14 (1 point)
    """Eq. (6): m (...), from the valences n (...) and the weights u (...) > 0 of (4).

    >>> limit_weight(np.array([6]), np.array([1 / 16])).round(9)
    array([0.08333333])
    """
    return 1 / (n + 3 / (8 * u))


def catmull_clark_limit_rows(edges, is_boundary, quads, n):  # exercise 11.15 (3 points)
    """Eq. (10) for all vertices of a mesh of quads (F, 4): entries of V rows and V columns.

    edges (E, 2), is_boundary (E,), n (V,): the valences. A vertex at the end of a boundary edge has
    the limit of (6); one of valence 0 stays. `vertex_rows` may be called.

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
    Vertices may be unused or in one place, faces without area, boundaries and handles many, and
    faces may be wound either way: no rule asks for it. The same face twice, and nothing beside it,
    is sound, too: a closed pillow.
    """
    corners, counts = as_polygons(corners, counts)
    check_polygons(corners, counts, vertex_count)
    edges, corner_edge = edges_of(corners, counts)
    face_count = np.bincount(corner_edge)
    if face_count.max() > 2:
        low, high = edges[face_count.argmax()]
        raise ValueError(f"the edge between vertices {low} and {high} has {face_count.max()} "
                         "faces: at most two may meet at an edge")
    _, first = np.unique(fans(corners, counts, edges, corner_edge), return_index=True)
    at_vertex = np.bincount(corners[first])
    if at_vertex.max() > 1:
        raise ValueError(f"at vertex {at_vertex.argmax()} meet {at_vertex.max()} fans of faces "
                         "that share no edge: `split_fans` gives each of them a vertex of its own")
    return edges, corner_edge, face_count == 1


def as_polygons(corners, counts):
    """Both as int64. ValueError for what is no row of integers."""
    corners, counts = np.asarray(corners), np.asarray(counts)
    for name, numbers in (("corners", corners), ("counts", counts)):
        if numbers.ndim != 1 or len(numbers) == 0 or numbers.dtype.kind not in "iu":
            raise ValueError(f"{name} must be integers in a row, at least one; "
                             f"got {numbers.shape} of {numbers.dtype}")
    return corners.astype(np.int64), counts.astype(np.int64)


def triangles(faces):
    """faces (F, 3) -> corners, counts. ValueError for what is no such array of integers."""
    faces = np.asarray(faces)
    if faces.ndim != 2 or faces.shape[1] != 3 or len(faces) == 0 or faces.dtype.kind not in "iu":
        raise ValueError("faces must be an array (F, 3) of integers, F >= 1; "
                         f"got {faces.shape} of {faces.dtype}")
    return as_polygons(faces.ravel(), np.full(len(faces), 3))


def check_polygons(corners, counts, vertex_count):
    """Nothing for polygons between vertices that are there, else a ValueError."""
    if counts.min() < 3 or counts.sum() != len(corners):
        raise ValueError("counts must be at least 3 for each face and add up to the number of "
                         f"corners, {len(corners)}; the least is {counts.min()}, "
                         f"the sum is {counts.sum()}")
    face = face_of_corner(counts)
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


def fans(corners, counts, edges, corner_edge):
    """The fan of each corner, a number from 0: (C,). A fan is the faces at a vertex that hang
    together by edges there."""
    # An edge has two ends, low and high. In a corner, the end of one edge meets the begin of the
    # next, and an end is shared by the faces at its edge.
    is_high = corners == edges[corner_edge, 1]
    begin, end = 2 * corner_edge + is_high, 2 * corner_edge + ~is_high
    links = np.ones(len(corners)), (end, begin[next_corner(counts)])
    graph = scipy.sparse.coo_array(links, shape=(2 * len(edges), 2 * len(edges)))
    return scipy.sparse.csgraph.connected_components(graph, directed=False)[1][begin]


def split_fans(corners, counts):
    """Each fan gets a vertex of its own, and vertices of no face go: -> corners (C,), origin (V',).

    origin: the old vertex that each new one is a copy of, so that its place is vertices[origin].

    >>> split_fans(np.array([0, 1, 2, 2, 3, 4]), np.array([3, 3]))[1]  # two triangles, tip to tip
    array([0, 1, 2, 2, 3, 4])
    """
    corners, counts = as_polygons(corners, counts)
    check_polygons(corners, counts, corners.max() + 1)
    fan = fans(corners, counts, *edges_of(corners, counts)).astype(np.int64)
    _, first = np.unique(fan, return_index=True)
    return fan, corners[first]


def loop_step(faces, vertex_count, weight=warren_weight):
    """Loop's S, sparse (V + E, V), and the new faces (4 F, 3).

    faces (F, 3); weight: warren_weight or loop_weight. ValueError: see `topology`.
    """
    corners, counts = triangles(faces)
    edges, corner_edge, is_boundary = topology(corners, counts, vertex_count)
    u = weight(np.maximum(valences(edges, vertex_count), 1))
    faces = corners.reshape(-1, 3)
    S = scipy.sparse.vstack([
        as_matrix(vertex_rows(edges, is_boundary, u, 1 / 8), (vertex_count, vertex_count)),
        as_matrix(loop_edge_rows(faces, edges, corner_edge), (len(edges), vertex_count))], "csr")
    return S, loop_faces(faces, corner_edge, vertex_count)


def loop_matrix(faces, vertex_count, weight=warren_weight):
    """S of `loop_step`: S @ x subdivides whatever sits at the vertices, uv or colour."""
    return loop_step(faces, vertex_count, weight)[0]


def loop(vertices, faces, weight=warren_weight):
    """One step of Loop: vertices (V, C), faces (F, 3) -> vertices (V + E, C), faces (4 F, 3)."""
    S, new_faces = loop_step(faces, len(vertices), weight)
    return S @ np.asarray(vertices), new_faces


def loop_backward(grad_new, vertices, faces, weight=warren_weight):
    """Backward of `loop`: grad_new (V + E, C) -> grad_vertices (V, C)."""
    return loop_matrix(faces, len(vertices), weight).T @ np.asarray(grad_new)


def loop_limit_matrix(faces, vertex_count, weight=warren_weight):
    """Eq. (6): sparse (V, V), which moves the vertices to where infinitely many steps take them."""
    edges, _, is_boundary = topology(*triangles(faces), vertex_count)
    n = np.maximum(valences(edges, vertex_count), 1)
    m = limit_weight(n, weight(n))
    return as_matrix(vertex_rows(edges, is_boundary, m, 1 / 6), (vertex_count, vertex_count))


def catmull_clark_step(corners, counts, vertex_count):
    """Catmull and Clark's S, sparse (V + E + F, V), and the new faces (C, 4).

    corners (C,), counts (F,). ValueError: see `topology`.
    """
    corners, counts = as_polygons(corners, counts)
    edges, corner_edge, is_boundary = topology(corners, counts, vertex_count)
    face_points = as_matrix(face_rows(corners, counts), (len(counts), vertex_count))
    known = scipy.sparse.vstack([scipy.sparse.eye_array(vertex_count), face_points], "csr")
    width = vertex_count + len(counts)
    n = valences(edges, vertex_count)
    at_vertices = catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n)
    on_edges = catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count)
    moved = scipy.sparse.vstack([as_matrix(at_vertices, (vertex_count, width)),
                                 as_matrix(on_edges, (len(edges), width))], "csr")
    S = scipy.sparse.vstack([moved @ known, face_points], "csr")
    return S, catmull_clark_faces(corners, counts, corner_edge, vertex_count)


def catmull_clark_matrix(corners, counts, vertex_count):
    """S of `catmull_clark_step`, for whatever sits at the vertices."""
    return catmull_clark_step(corners, counts, vertex_count)[0]


def catmull_clark(vertices, corners, counts):
    """One step of Catmull-Clark -> vertices (V + E + F, C), corners, counts, all 4.

    vertices (V, C), corners, counts. The new faces as (N, 4): corners.reshape(-1, 4).
    """
    S, quads = catmull_clark_step(corners, counts, len(vertices))
    return S @ np.asarray(vertices), quads.ravel(), np.full(len(quads), 4)


def catmull_clark_backward(grad_new, vertices, corners, counts):
    """Backward of `catmull_clark`: grad_new (V + E + F, C) -> grad_vertices (V, C)."""
    return catmull_clark_matrix(corners, counts, len(vertices)).T @ np.asarray(grad_new)


def catmull_clark_limit_matrix(corners, counts, vertex_count):
    """Eq. (10): sparse (V, V), to the limit surface. ValueError unless all faces are quads."""
    corners, counts = as_polygons(corners, counts)
    edges, _, is_boundary = topology(corners, counts, vertex_count)
    if (counts != 4).any():
        raise ValueError(f"face {(counts != 4).argmax()} is no quad: the limit is known for quads "
                         "only; subdivide once first")
    n = valences(edges, vertex_count)
    entries = catmull_clark_limit_rows(edges, is_boundary, corners.reshape(-1, 4), n)
    return as_matrix(entries, (vertex_count, vertex_count))
