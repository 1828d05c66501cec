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
    """the edges are numbered in the order in which they are found, not sorted

    told by: sorted & edges | order & found | order & edges | first seen | ascending | lexicograph
    """
    following = corners[next_corner(counts)]
    numbers, edges = {}, []
    corner_edge = np.zeros(len(corners), int)
    for c in range(len(corners)):
        edge = (min(corners[c], following[c]), max(corners[c], following[c]))
        if edge not in numbers:
            numbers[edge] = len(edges)
            edges.append(edge)
        corner_edge[c] = numbers[edge]
    return np.array(edges), corner_edge


def edges_of(corners, counts):
    """the next corner is simply the next entry of corners: a face's last corner is not joined to its first

    told by: next_corner | closing edge | last corner & first | last corner & face | across faces | next face
    """
    after = np.roll(corners, -1)
    pairs = np.sort(np.stack([corners, after], 1), axis=1)
    edges, corner_edge = np.unique(pairs, axis=0, return_inverse=True)
    return edges, corner_edge.reshape(-1)


def pull_entries(rows, columns, u):
    """the part - u x_row is left out: there are only the entries u in the columns

    told by: x_row | -u & missing | no & diagonal | sum of & row | diagonal & missing | diagonal & left out
    """
    return np.array(rows), np.array(columns), np.array(u)
