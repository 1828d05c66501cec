"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


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
    """the pulled vertex keeps its whole weight: -u is missing on the diagonal"""
    return rows, columns, u


def vertex_rows(edges, is_boundary, u, w):
    """a vertex on the boundary is pulled along its inner edges as well, by u; only its boundary
    edges pull it"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    along = np.concatenate([is_boundary, is_boundary])
    return join((every, every, np.ones(len(u))),
                pull_entries(start, end, np.where(along, w, u[start])))


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
