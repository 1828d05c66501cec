"""Mistakes of lab 13; each docstring goes on after "this is what comes out when"."""


def smooth_explicit(x, edges, weights, mass, step):
    """vertices move one after another, and see neighbours that have moved already; all must move at
    the same time, from the old places"""
    new, L = x.astype(float), laplacian(edges, weights, len(x)).toarray()
    for i in range(len(new)):
        if mass[i] > 0:
            new[i] -= step * (L[i] @ new) / mass[i]
    return new
