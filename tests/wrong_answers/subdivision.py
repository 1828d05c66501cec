"""Wrong answers to subdivision, written without a look at the checks."""


def edges_of(corners, counts):
    """a face's last corner is joined to the first corner of the next face, not to its own first

    told by: last corner | next face | closing | close & face | wrap | across faces | same face
    """
    start = corners.astype(np.int64)
    end = np.roll(start, -1)
    pairs = np.sort(np.stack([start, end], 1), axis=1)
    edges, inverse = np.unique(pairs, axis=0, return_inverse=True)
    return edges, inverse.ravel()


def pull_entries(rows, columns, u):
    """-u goes to the diagonal of the column's vertex, not of the row's

    told by: diagonal & column | (column, column) | -u & column | own row | diagonal & row | row's own | x_row
    """
    r = np.hstack([rows, columns])
    c = np.hstack([columns, columns])
    return r, c, np.hstack([u, -u])


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
