"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


def edges_of(corners, counts):
    """edges come in the order in which the faces name them; they must ascend, sorted by their low
    vertex, then by their high one"""
    following = corners[next_corner(counts)]
    number = {}
    pairs = zip(np.minimum(corners, following).tolist(), np.maximum(corners, following).tolist(),
                strict=True)
    corner_edge = [number.setdefault(pair, len(number)) for pair in pairs]
    return np.array(list(number)), np.array(corner_edge)
