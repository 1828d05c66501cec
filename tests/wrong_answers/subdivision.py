"""Wrong answers to subdivision, written without a look at the checks."""


def edges_of(corners, counts):
    """the pairs keep the direction of their face, so an edge of two faces stands in the list twice

    told by: direction | low < high | low & high | edge & twice | both ways | half-edge | smaller & first
    """
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    pairs = np.stack([start, end], 1)
    edges, inverse = np.unique(pairs, axis=0, return_inverse=True)
    return edges, inverse.ravel()


def edges_of(corners, counts):
    """a face's last corner is joined to the first corner of the next face, not to its own first

    told by: last corner | next face | closing | close & face | wrap | across faces | same face
    """
    start = corners.astype(np.int64)
    end = np.roll(start, -1)
    pairs = np.sort(np.stack([start, end], 1), axis=1)
    edges, inverse = np.unique(pairs, axis=0, return_inverse=True)
    return edges, inverse.ravel()


def edges_of(corners, counts):
    """corner_edge names the edge from the previous corner, not the one to the next

    told by: previous | arriv | behind | corner before | shifted & corner | one corner | to the next
    """
    every = []
    first = 0
    for n in counts:
        face = [int(v) for v in corners[first:first + n]]
        for k in range(n):
            u, v = face[k - 1], face[k]
            every.append((min(u, v), max(u, v)))
        first += n
    edges = sorted(set(every))
    number = {edge: e for e, edge in enumerate(edges)}
    return np.array(edges), np.array([number[edge] for edge in every])


def pull_entries(rows, columns, u):
    """-u goes to the diagonal of the column's vertex, not of the row's

    told by: diagonal & column | (column, column) | -u & column | own row | diagonal & row | row's own | x_row
    """
    r = np.hstack([rows, columns])
    c = np.hstack([columns, columns])
    return r, c, np.hstack([u, -u])


def vertex_rows(edges, is_boundary, u, w):
    """a boundary vertex is pulled along its inner edges too, not along the boundary alone

    told by: inner edge | inside & edge | interior & edge | inner neighbour | neighbours inside | boundary & alone | boundary & only
    """
    n = len(u)
    r, c, weights = list(range(n)), list(range(n)), [1.0] * n
    for (p, q), rim in zip(edges, is_boundary):
        for here, there in ((p, q), (q, p)):
            strength = w if rim else u[here]
            r += [here, here]
            c += [there, here]
            weights += [strength, -strength]
    return np.array(r), np.array(c), np.array(weights, float)


def edges_of(corners, counts):
    """corner_edge names the edge to the previous corner of the face, not to the next

    told by: previous | next corner | behind | before it | shifted & corner | to the next | wrong neighbour | arriving
    """
    c = corners.astype(np.int64)
    ahead = c[next_corner(counts)]
    pairs = np.sort(np.stack([c, ahead], axis=1), axis=1)
    edges, number = np.unique(pairs, axis=0, return_inverse=True)
    number = number.ravel()
    shifted = np.empty_like(number)
    shifted[next_corner(counts)] = number
    return edges, shifted


def edges_of(corners, counts):
    """the ends of an edge are not sorted, so an edge that two faces share is found twice, once in each direction

    told by: low < high | sorted | twice | direction | each edge once | both faces | shared & edge | half-edge | low & high
    """
    c = corners.astype(np.int64)
    pairs = np.stack([c, c[next_corner(counts)]], axis=1)
    edges, number = np.unique(pairs, axis=0, return_inverse=True)
    return edges, number.ravel()


def vertex_rows(edges, is_boundary, u, w):
    """a vertex is pulled with the u of its neighbour, not with its own

    told by: u & neighbour | its own u | other end | u of the | own u | u[end] | start & end | ends & exchanged | ends & swapped
    """
    count = len(u)
    border = np.zeros(count, bool)
    border[edges[is_boundary]] = True
    rows, columns, weights = list(range(count)), list(range(count)), [1.0] * count
    for (a, b), lonely in zip(edges, is_boundary):
        for v, other in ((a, b), (b, a)):
            if border[v] and not lonely:
                continue
            pull = w if lonely else u[other]
            rows += [v, v]
            columns += [other, v]
            weights += [pull, -pull]
    return np.array(rows), np.array(columns), np.array(weights)
