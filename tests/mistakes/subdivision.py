"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


def edges_of(corners, counts):
    """an edge runs as the face does, not from low to high: one of two faces is there twice"""
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = start * vertex_count + end
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def edges_of(corners, counts):
    """edges run from high to low, and ascend by high"""
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = np.maximum(start, end) * vertex_count + np.minimum(start, end)
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def edges_of(corners, counts):
    """a face's last corner is joined to the next face's first; it is to its own first"""
    start = corners.astype(np.int64)
    end = np.roll(start, -1)
    vertex_count = start.max() + 1
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def pull_entries(rows, columns, u):
    """the pulled vertex gets heavier: what it gives away has the other sign"""
    return (np.concatenate([rows, rows]), np.concatenate([columns, rows]),
            np.concatenate([u, u]))


def pull_entries(rows, columns, u):
    """the pulled vertex keeps its whole weight: a pull's entries add up to 0"""
    return (np.concatenate([rows, rows]), np.concatenate([columns, rows]),
            np.concatenate([u, 0 * u]))


def pull_entries(rows, columns, u):
    """rows and columns are swapped"""
    return (np.concatenate([columns, rows]), np.concatenate([rows, rows]),
            np.concatenate([u, -u]))


def vertex_rows(edges, is_boundary, u, w):
    """a vertex on the boundary is pulled inwards, too, by its u"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    along = np.concatenate([is_boundary, is_boundary])
    pulled = np.ones(len(start), bool)
    strength = np.where(along, w, u[start])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))


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
    """only the lower end of an edge is pulled, and twice"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges]).T
    along = np.concatenate([is_boundary, is_boundary])
    at_boundary = np.isin(every, edges[is_boundary])
    pulled = along | ~at_boundary[start]
    strength = np.where(along, w, u[start])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))
