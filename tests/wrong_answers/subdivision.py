"""Wrong answers to subdivision, written without a look at the checks."""


def edges_of(corners, counts):
    """an edge's direction is kept, so an edge of two faces occurs twice

    told by: twice | direction | both ways | half-edge | duplicate | not sorted
    """
    pairs = np.stack([corners, corners[next_corner(counts)]], axis=1)
    edges, corner_edge = np.unique(pairs, axis=0, return_inverse=True)
    return edges, corner_edge.ravel()


def edges_of(corners, counts):
    """corner_edge is the index of an edge's first occurrence: return_index instead of return_inverse

    told by: return_index | return_inverse | first occurrence | length & corner_edge | one entry & edge | shape & corner_edge
    """
    low = np.minimum(corners, corners[next_corner(counts)])
    high = np.maximum(corners, corners[next_corner(counts)])
    return np.unique(np.stack([low, high], 1), axis=0, return_index=True)


def edges_of(corners, counts):
    """corner_edge is that of the edge from the previous corner, not to the next one

    told by: previous | edge behind | arriv | precede | instead of the next | corner before
    """
    nxt = next_corner(counts)
    pairs = np.sort(np.stack([corners, corners[nxt]], 1), axis=1)
    edges, ahead = np.unique(pairs, axis=0, return_inverse=True)
    corner_edge = np.empty(len(corners), int)
    corner_edge[nxt] = ahead.ravel()
    return edges, corner_edge


def edges_of(corners, counts):
    """fine print: the keys are computed in the corners' own int32 and overflow for large vertex numbers

    told by: overflow | int32 | 32 bit | int64 | large number | narrow
    """
    end = corners[next_corner(counts)]
    low, high = np.minimum(corners, end), np.maximum(corners, end)
    n = high.max() + corners.dtype.type(1)
    key, corner_edge = np.unique(low * n + high, return_inverse=True)
    return np.stack([key // n, key % n], axis=1), corner_edge


def edges_of(corners, counts):
    """each edge is written high, low instead of low, high

    told by: low < high | high & low | larger & first | greater & first | descending | within & pair
    """
    following = corners[next_corner(counts)]
    pairs = np.sort(np.stack([corners, following], 1), axis=1)
    edges, corner_edge = np.unique(pairs, axis=0, return_inverse=True)
    return edges[:, ::-1], corner_edge.ravel()


def pull_entries(rows, columns, u):
    """the -u stands on the diagonal of the column's vertex, not of the row's

    told by: diagonal & column | -u & column | -u & row | -u & place | wrong diagonal
    """
    return (np.concatenate([rows, columns]), np.concatenate([columns, columns]),
            np.concatenate([u, -u]))


def pull_entries(rows, columns, u):
    """the 1 of the diagonal is included: 1 - u instead of -u

    told by: 1 - u | already & 1 | diagonal & 1 | identity | extra 1
    """
    r, c, w = [], [], []
    for i in range(len(rows)):
        r += [rows[i], rows[i]]
        c += [columns[i], rows[i]]
        w += [u[i], 1 - u[i]]
    return np.array(r), np.array(c), np.array(w)


def vertex_rows(edges, is_boundary, u, w):
    """vertices on the boundary are pulled along inner edges as well

    told by: inner edge | interior edge | boundary edges alone | along the boundary | only & boundary edge | inside edge
    """
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    strength = np.where(np.tile(is_boundary, 2), w, u[start])
    return join((every, every, np.ones(len(u))), pull_entries(start, end, strength))


def vertex_rows(edges, is_boundary, u, w):
    """each edge pulls only its first vertex, not both ends

    told by: both ends | one end | other end | either end | one direction | second vertex
    """
    every = np.arange(len(u))
    start, end = edges[:, 0], edges[:, 1]
    at_boundary = np.zeros(len(u), bool)
    at_boundary[edges[is_boundary]] = True
    pulled = is_boundary | ~at_boundary[start]
    strength = np.where(is_boundary, w, u[start])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))


def vertex_rows(edges, is_boundary, u, w):
    """the boundary is ignored: every vertex is pulled along all its edges by u

    told by: boundary & ignored | boundary & like & inside | boundary rule | like & inner vert | w is not used | boundary & u instead
    """
    every = np.arange(len(u))
    start = np.concatenate([edges[:, 0], edges[:, 1]])
    end = np.concatenate([edges[:, 1], edges[:, 0]])
    return join((every, every, np.ones(len(u))), pull_entries(start, end, u[start]))


def vertex_rows(edges, is_boundary, u, w):
    """the strength is the u of the neighbour (column), not of the vertex that moves (row)

    told by: u of the neighbour | neighbour's u | neighbour's valence | u of the other | of the column | u[end]
    """
    n = len(u)
    border = set(edges[is_boundary].ravel().tolist())
    rows, cols, strength = [], [], []
    for (a, b), on_rim in zip(edges.tolist(), is_boundary):
        for v, other in ((a, b), (b, a)):
            if on_rim:
                rows.append(v), cols.append(other), strength.append(w)
            elif v not in border:
                rows.append(v), cols.append(other), strength.append(u[other])
    pulls = pull_entries(np.array(rows, int), np.array(cols, int), np.array(strength, float))
    return join((np.arange(n), np.arange(n), np.ones(n)), pulls)
