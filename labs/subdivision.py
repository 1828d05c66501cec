"""Subdivision: a coarse mesh becomes a fine one, and in the limit a smooth surface.

    V - E + F = 2 - 2 g - b           for one piece with two sides                             (1)
    new_i = sum_j S_ij old_j          grad_old_j = sum_i S_ij grad_new_i                       (2)
    vertex   (1 - n u) v + u sum(ring)      on the boundary   (1 - 2 w) v + w (a + b)          (3)

In (1), g counts the handles and b the closed boundary curves. (2) is one step of subdivision. S has
a row for each new point, and depends on connectivity only. (3) is the row of an old vertex v. Its
ring is its n neighbours, and a and b are its neighbours along the boundary. Each scheme chooses its
own u and w: see loop_subdivision.py for triangles, catmull_clark.py for all polygons.

Polygons are two arrays: corners (C,), the vertices of all faces in a row, and counts (F,), how many
of them belong to each face. `topology` says which meshes are accepted.

Sources: a lecture on geometry, and the sources in the modules of the two schemes.
"""
import numpy as np
import scipy.sparse
import scipy.sparse.csgraph

# Who is near whom


def next_corner(counts):
    """The index in `corners` of the next corner of the same face: counts (F,) -> (C,).

    >>> next_corner(np.array([3, 4]))
    array([1, 2, 0, 4, 5, 6, 3])
    """
    last = np.cumsum(counts, dtype=np.intp) - 1
    following = np.arange(1, last[-1] + 2)
    following[last] = last + 1 - counts
    return following


def face_of_corner(counts):
    """The number of each corner's face: counts (F,) -> (C,).

    >>> face_of_corner(np.array([3, 4]))
    array([0, 0, 0, 1, 1, 1, 1])
    """
    return np.repeat(np.arange(len(counts)), np.asarray(counts, np.intp))


def edges_of(corners, counts):  # step 11.1
    """Each edge once, and for each corner the number of its edge to the next corner of its face.

    corners (C,), counts (F,) -> edges (E, 2), sorted pairs low < high, and corner_edge (C,).
    `next_corner` is given.

    >>> edges_of(np.array([0, 1, 2, 2, 1, 3]), np.array([3, 3]))  # two triangles with the edge 1 2
    (array([[0, 1],
           [0, 2],
           [1, 2],
           [1, 3],
           [2, 3]]), array([0, 2, 1, 2, 3, 4]))

    Fine print. Vertices may have large numbers, so a table of V by V places would not fit.
    """
    raise NotImplementedError("exercise 11.1: edges_of")


def on_boundary(corner_edge):
    """Which edges belong to only one face: corner_edge (C,) of `edges_of` -> bool (E,).

    >>> on_boundary(np.array([0, 2, 1, 2, 3, 4]))
    array([ True,  True, False,  True,  True])
    """
    return np.bincount(corner_edge) == 1


def valences(edges, vertex_count):
    """How many edges end at each vertex: edges (E, 2) -> n (V,), 0 where there is none.

    >>> valences(np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]), 5)
    array([2, 3, 3, 2, 0])
    """
    return np.bincount(edges.ravel(), minlength=vertex_count)


def is_extraordinary(valence, at_boundary, regular):
    """Which vertices differ from those of a regular grid: bool (V,).

    valence (V,), at_boundary (V,) bool. regular is 6 for a mesh of triangles, 4 for one of quads.
    A regular vertex has valence `regular` inside. On the boundary, where half of its faces are
    missing, it has `regular / 2 + 1`. A vertex of valence 0 is not extraordinary.

    >>> at_boundary = np.array([False, False, True, True, False])
    >>> is_extraordinary(np.array([6, 4, 4, 6, 0]), at_boundary, 6)
    array([False,  True, False,  True, False])
    """
    expected = np.where(at_boundary, regular // 2 + 1, regular)
    return (valence != expected) & (valence > 0)


def euler_characteristic(corners, counts):
    """Eq. (1): V - E + F, an integer. corners (C,), counts (F,), F >= 1.

    V counts the vertices that are corners of a face, and no others.

    >>> euler_characteristic(np.array([0, 1, 9, 9, 1, 3]), np.array([3, 3]))  # 4 - 5 + 2
    1
    """
    return len(np.unique(corners)) - len(edges_of(corners, counts)[0]) + len(counts)


# The same for one face, edge or vertex at a time: the slow versions of both schemes use it


def polygons(corners, counts):
    """The faces one by one: corners (C,), counts (F,) -> F arrays, each the corners of a face."""
    return np.split(corners, np.cumsum(counts)[:-1])


def faces_at_edges(corners, counts):
    """Who meets at each edge? [((low, high), list of the faces at this edge), ...]

    corners (C,), counts (F,). The edges come in the order of `edges_of`, low < high.
    """
    found = {}
    for f, polygon in enumerate(polygons(corners, counts)):
        for a, b in zip(polygon, np.roll(polygon, -1), strict=True):
            found.setdefault((min(a, b), max(a, b)), []).append(f)
    return sorted(found.items())


def ring_of(v, at_edge):
    """Two lists: the neighbours of vertex v, and the two of them along the boundary.

    v: a vertex's number. at_edge: from `faces_at_edges`. For a vertex inside, the second list is
    empty.
    """
    near = [(a + b - v, faces) for (a, b), faces in at_edge if v in (a, b)]  # the edge's other end
    return [other for other, _ in near], [other for other, faces in near if len(faces) == 1]


# S, written as its entries (rows, columns, weights)


def as_matrix(entries, shape):
    """Entries (rows, columns, weights), (N,) each -> a sparse matrix of a shape (rows, columns).

    Entries of one place add up.
    """
    rows, columns, weights = entries
    return scipy.sparse.csr_array((weights, (rows, columns)), shape=shape)


def join(*entries):
    """Several tuples rows, columns, weights, of (N,) each, as one, in their order."""
    return tuple(np.concatenate(part) for part in zip(*entries, strict=True))


def pull_entries(rows, columns, u):
    """The entries of pulls: each adds u (x_column - x_row) to the new point of its row.

    rows, columns, u (N,) -> rows, columns, weights, in any order. Entries of one place add up.

    The row of an old vertex is 1 on the diagonal, and pulls. So its sum is 1 whatever u is.

    >>> pull_entries(np.array([5]), np.array([2]), np.array([0.25]))
    (array([5, 5]), array([2, 5]), array([ 0.25, -0.25]))
    """
    return (np.concatenate([rows, rows]), np.concatenate([columns, rows]),
            np.concatenate([u, -u]))


def vertex_rows(edges, is_boundary, u, w):  # step 11.4
    """Eq. (3) for all old vertices: the entries (rows, columns, weights) of V rows and V columns.

    edges (E, 2), is_boundary (E,) bool, u (V,), w a number. A vertex at the end of boundary edges
    is pulled by w along these alone. A vertex of no edge stays. `pull_entries` may be called.

    >>> edges, is_boundary = np.array([[0, 1], [1, 2]]), np.array([True, False])
    >>> entries = vertex_rows(edges, is_boundary, np.array([9.0, 9.0, 0.5, 9.0]), 0.125)
    >>> as_matrix(entries, (4, 4)).toarray()
    array([[0.875, 0.125, 0.   , 0.   ],
           [0.125, 0.875, 0.   , 0.   ],
           [0.   , 0.5  , 0.5  , 0.   ],
           [0.   , 0.   , 0.   , 1.   ]])
    """
    raise NotImplementedError("exercise 11.4: vertex_rows")


# Which meshes are accepted


def topology(corners, counts, vertex_count):
    """The edges (E, 2), corner_edge (C,) and is_boundary (E,) of a sound mesh.

    corners (C,), counts (F,), vertex_count: all vertices, also unused ones. ValueError for any
    other mesh. In a sound mesh at most two faces meet at an edge, and one fan of faces at a vertex.
    There may be unused vertices, several vertices in one place, faces without area, and any number
    of boundaries and handles. Faces may be wound either way, because no rule depends on it. One
    face twice, and nothing else, is sound as well: a closed pillow.
    """
    corners, counts = as_polygons(corners, counts)
    check_corners(corners, counts, vertex_count)
    edges, corner_edge = edges_of(corners, counts)
    face_count = np.bincount(corner_edge)
    if face_count.max() > 2:
        low, high = edges[face_count.argmax()]
        raise ValueError(f"the edge between vertices {low} and {high} has {face_count.max()} "
                         "faces: at most two may meet at an edge")
    _, one_corner = np.unique(fans(corners, counts, edges, corner_edge), return_index=True)
    fan_count = np.bincount(corners[one_corner])
    if fan_count.max() > 1:
        raise ValueError(f"at vertex {fan_count.argmax()} meet {fan_count.max()} fans of faces "
                         "that share no edge: `split_fans` gives each of them a vertex of its own")
    return edges, corner_edge, face_count == 1


def triangles(faces):
    """faces (F, 3) -> corners, counts. ValueError for anything else than such integers."""
    faces = np.asarray(faces)
    if faces.ndim != 2 or faces.shape[1] != 3 or len(faces) == 0 or faces.dtype.kind not in "iu":
        raise ValueError("faces must be an array (F, 3) of integers, F >= 1; "
                         f"got {faces.shape} of {faces.dtype}")
    return as_polygons(faces.ravel(), np.full(len(faces), 3))


def as_polygons(corners, counts):
    """corners (C,), counts (F,) -> both as np.intp.

    ValueError unless both are rows of integers, and the counts add up to C.
    """
    corners, counts = np.asarray(corners), np.asarray(counts)
    for name, numbers in (("corners", corners), ("counts", counts)):
        if numbers.ndim != 1 or len(numbers) == 0 or numbers.dtype.kind not in "iu":
            raise ValueError(f"{name} must be integers in a row, at least one; "
                             f"got {numbers.shape} of {numbers.dtype}")
    corners, counts = corners.astype(np.intp), counts.astype(np.intp)
    if counts.min() < 3 or counts.sum() != len(corners):
        raise ValueError("counts must be at least 3 for each face and add up to the number of "
                         f"corners, {len(corners)}; the least is {counts.min()}, "
                         f"the sum is {counts.sum()}")
    return corners, counts


def check_corners(corners, counts, vertex_count):
    """ValueError unless each face names existing vertices, and none of them twice.

    corners (C,), counts (F,), vertex_count: so many vertices exist.
    """
    face = face_of_corner(counts)
    outside = (corners < 0) | (corners >= vertex_count)
    if outside.any():
        raise ValueError(f"face {face[outside][0]} names vertex {corners[outside][0]}, but there "
                         f"are {vertex_count} vertices, counted from 0")
    order = np.lexsort((corners, face))  # a face's corners stay together, equal ones side by side
    twice = (np.diff(corners[order]) == 0) & (np.diff(face[order]) == 0)
    if twice.any():
        corner = order[twice.argmax()]
        raise ValueError(f"face {face[corner]} names vertex {corners[corner]} twice: "
                         "leave such faces out")


def fans(corners, counts, edges, corner_edge):
    """The number of each corner's fan, from 0: (C,). A fan is a set of faces at a vertex that are
    connected by edges there.

    corners (C,), counts (F,), and edges (E, 2), corner_edge (C,) of `edges_of`.
    """
    # An edge has two ends, low and high, which its faces share. At each corner an edge arrives and
    # the next one leaves: their ends there belong to one fan.
    is_high = corners == edges[corner_edge, 1]
    leaving = 2 * corner_edge + is_high        # the edge's end at its own corner
    arriving = 2 * corner_edge + ~is_high      # its end at the next corner
    links = np.ones(len(corners)), (arriving, leaving[next_corner(counts)])
    graph = scipy.sparse.coo_array(links, shape=(2 * len(edges), 2 * len(edges)))
    _, fan_of_end = scipy.sparse.csgraph.connected_components(graph, directed=False)
    return fan_of_end[leaving]


def split_fans(corners, counts):
    """Give each fan a vertex of its own, drop unused vertices: -> corners (C,), origin (V',).

    corners (C,), counts (F,). origin: the old vertex that each new one is a copy of. The new
    positions are vertices[origin]. ValueError: see `as_polygons` and `check_corners`.

    >>> split_fans(np.array([0, 1, 2, 2, 3, 4]), np.array([3, 3]))[1]  # two triangles, tip to tip
    array([0, 1, 2, 2, 3, 4])
    """
    corners, counts = as_polygons(corners, counts)
    check_corners(corners, counts, corners.max() + 1)
    fan = fans(corners, counts, *edges_of(corners, counts)).astype(np.intp)
    _, one_corner = np.unique(fan, return_index=True)
    return fan, corners[one_corner]
