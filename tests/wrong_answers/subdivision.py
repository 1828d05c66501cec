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
