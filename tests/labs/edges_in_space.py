"""Where the edges of faces cross a pair's line, found in space: an oracle of lab 8's checks."""
import numpy as np

EDGES = (1, 2), (2, 0), (0, 1)  # edge k, opposite to vertex k


def last_crossing(corners):
    """The edge by which y = 0 leaves a face, and where: corners (3, 3), w (x, y, 1) of each."""
    places = [crossing(corners[i], corners[j]) for i, j in EDGES]
    return int(np.argmax(places)), max(places)


def crossing(p, q):
    """x / w where the edge between two corners crosses y = 0 before the camera. -inf: nowhere."""
    if (p[1] < 0) == (q[1] < 0):
        return -np.inf
    t = p[1] / (p[1] - q[1])
    x, _, w = (1 - t) * p + t * q
    return x / w if w > 0 else -np.inf
