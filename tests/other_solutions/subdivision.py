"""Lab 11 once more: dictionaries and loops over vertices, edges and faces."""
from collections import defaultdict

import numpy as np


def face_lists(corners, counts):
    corners, end = np.asarray(corners).tolist(), 0
    for count in np.asarray(counts).tolist():
        yield corners[end:end + count]
        end += count


def sides(face):
    """The edges of a face, each from low to high, in the order of its corners."""
    return [tuple(sorted(pair)) for pair in zip(face, face[1:] + face[:1], strict=True)]


def incidence(faces):
    """{edge: its faces' numbers}, edges ascending."""
    at_edge = defaultdict(list)
    for f, face in enumerate(faces):
        for side in sides(face):
            at_edge[side].append(f)
    return dict(sorted(at_edge.items()))


def rings(at_edge):
    """{vertex: its neighbours}, and {vertex: those along boundary edges}."""
    ring, border = defaultdict(list), defaultdict(list)
    for (a, b), at in at_edge.items():
        for v, other in ((a, b), (b, a)):
            ring[v].append(other)
            if len(at) == 1:
                border[v].append(other)
    return ring, border
