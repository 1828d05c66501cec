"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


def edges_of(corners, counts):
    """an edge runs as the face does, not from low to high: an edge of two faces is there twice,
    once in each direction"""
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = start * vertex_count + end
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def edges_of(corners, counts):
    """each pair is written high, low; it must be low < high"""
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1)[:, ::-1], corner_edge


def edges_of(corners, counts):
    """a face's last corner is joined to the next face's first corner; it must be joined to the
    first corner of its own face"""
    start = corners.astype(np.int64)
    end = np.roll(start, -1)
    vertex_count = start.max() + 1
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def edges_of(corners, counts):
    """corner_edge holds where each edge occurs first (return_index); it must have one entry for
    each corner, the number of its edge (return_inverse)"""
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    key, corner_edge = np.unique(key, return_index=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def edges_of(corners, counts):
    """corner_edge names the edge behind each corner, from the previous corner; it must be the edge
    ahead, to the next corner"""
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    key, corner_edge = np.unique(key, return_inverse=True)
    behind = np.empty_like(corner_edge)
    behind[next_corner(counts)] = corner_edge
    return np.stack(np.divmod(key, vertex_count), axis=1), behind


def edges_of(corners, counts):
    """edges come in the order in which the faces name them; they must ascend, sorted by their low
    vertex, then by their high one"""
    following = corners[next_corner(counts)]
    number = {}
    pairs = zip(np.minimum(corners, following).tolist(), np.maximum(corners, following).tolist(),
                strict=True)
    corner_edge = [number.setdefault(pair, len(number)) for pair in pairs]
    return np.array(list(number)), np.array(corner_edge)


def pull_entries(rows, columns, u):
    """the entry on the diagonal is u; it must be -u, so that a pull's entries add up to 0"""
    return (np.concatenate([rows, rows]), np.concatenate([columns, rows]),
            np.concatenate([u, u]))


def pull_entries(rows, columns, u):
    """the pulled vertex keeps its whole weight: -u is missing on the diagonal"""
    return rows, columns, u


def pull_entries(rows, columns, u):
    """the -u stands on the diagonal of the column's vertex; it must be on that of the row's"""
    return (np.concatenate([rows, columns]), np.concatenate([columns, columns]),
            np.concatenate([u, -u]))


def pull_entries(rows, columns, u):
    """the diagonal gets 1 - u; the 1 is no part of a pull, only -u is"""
    return (np.concatenate([rows, rows]), np.concatenate([columns, rows]),
            np.concatenate([u, 1 - u]))


def vertex_rows(edges, is_boundary, u, w):
    """a vertex on the boundary is pulled along its inner edges as well, by u; only its boundary
    edges pull it"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    along = np.concatenate([is_boundary, is_boundary])
    return join((every, every, np.ones(len(u))),
                pull_entries(start, end, np.where(along, w, u[start])))


def vertex_rows(edges, is_boundary, u, w):
    """a vertex is pulled with its neighbour's u instead of its own"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    along = np.concatenate([is_boundary, is_boundary])
    at_boundary = np.isin(every, edges[is_boundary])
    pulled = along | ~at_boundary[start]
    strength = np.where(along, w, u[end])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))


def vertex_rows(edges, is_boundary, u, w):
    """each edge pulls only its first vertex; it must pull both ends"""
    every = np.arange(len(u))
    start, end = edges.T
    at_boundary = np.isin(every, edges[is_boundary])
    pulled = is_boundary | ~at_boundary[start]
    strength = np.where(is_boundary, w, u[start])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))


def vertex_rows(edges, is_boundary, u, w):
    """the boundary is ignored: every vertex is pulled along all its edges by u, and w is not
    used"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    return join((every, every, np.ones(len(u))), pull_entries(start, end, u[start]))
