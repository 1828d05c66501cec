"""Mistakes of lab 13; each docstring goes on after "this is what comes out when"."""


def laplacian_entries(edges, weights, vertex_count):
    """+= adds only one edge where an index is repeated, as in diagonal[i] += weights; np.add.at
    adds each time"""
    i, j = edges.T
    diagonal, every = np.zeros(vertex_count), np.arange(vertex_count)
    diagonal[i] += weights
    diagonal[j] += weights
    return (np.concatenate([i, j, every]), np.concatenate([j, i, every]),
            np.concatenate([-weights, -weights, diagonal]))


def smooth_explicit(x, edges, weights, mass, step):
    """vertices move one after another, and see neighbours that have moved already; all must move at
    the same time, from the old places"""
    new, L = x.astype(float), laplacian(edges, weights, len(x)).toarray()
    for i in range(len(new)):
        if mass[i] > 0:
            new[i] -= step * (L[i] @ new) / mass[i]
    return new
