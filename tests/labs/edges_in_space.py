"""Where the edges of faces cross a pair's line, found in space: an oracle of lab 8's checks."""
import numpy as np

from labkit.checks import Mismatch

EDGES = (1, 2), (2, 0), (0, 1)  # edge k, opposite to vertex k
FIELDS = "owner", "other", "c", "ends", "x", "y", "face", "edge"

CORNERS = np.array([[3.25, 0.5], [3.0, 2.75], [1.0, 1.25]])  # around (2.5, 1.5)

# The pairs of a pixel of 3 rows of 4 with those to below, left, right and above.
AROUND = np.array([6, 6, 6, 6]), np.array([2, 5, 7, 10])

# The edges by which their lines leave the face of CORNERS, where, and x and y of the edges' ends.
LEFT = ([1, 0, 2, 0], [0.75, 7 / 6, 23 / 36, 0.875],
        [[0.25, -0.5, 0.75, 1.25], [1.0, 1.5, 0.5, -0.25]],
        [[-1.5, 1.25, -1.0, 0.5], [0.75, -0.25, 1.25, -1.5]])


def as_pairs(impl, returned):
    """The Pairs that a function returned. Mismatch: they are none."""
    is_one = isinstance(returned, tuple)
    sizes = [np.shape(field)[-1:] for field in returned] if is_one else []
    if len(sizes) != len(FIELDS) or len(set(sizes)) != 1:
        raise Mismatch(("wrong", f"it must return Pairs: {', '.join(FIELDS)}, with a number or a "
                                 "column for each pair"))
    return impl.Pairs(*map(np.asarray, returned))


def opposite_corners(faces):
    """What lies across each edge k of a face: the first corner of the other one of the edge's first
    two third vertices, -1 for none. Faces that name a vertex twice do not count.
    """
    thirds = {}  # {edge: {third vertex: its first corner}}
    for (f, k), vertex in np.ndenumerate(faces):
        if len(set(faces[f])) == 3:
            at_edge = thirds.setdefault(frozenset(faces[f]) - {vertex}, {})
            at_edge.setdefault(vertex, 3 * f + k)
    found = np.full(faces.shape, -1)
    for (f, k), vertex in np.ndenumerate(faces):
        first_two = [*thirds.get(frozenset(faces[f]) - {vertex}, {}).items()][:2]
        if vertex in dict(first_two):
            found[f, k] = next((corner for v, corner in first_two if v != vertex), -1)
    return found


def last_crossing(corners):
    """The edge by which y = 0 leaves a face, and where: corners (3, 3), w (x, y, 1) of each."""
    places = [crossing(corners[i], corners[j]) for i, j in EDGES]
    return int(np.argmax(places)), max(places)


def begun(owner, other, face, screen, faces, width):
    """The fields of `leave_faces`, pair by pair, in space."""
    found = []
    for a, b, f in zip(owner, other, face, strict=True):
        corners = in_space(a, b, screen, width)[faces[f]]
        edge, c = last_crossing(corners)
        ends = list(EDGES[edge])
        x, y = (corners[ends, :2] / corners[ends, 2:]).T
        found.append((a, b, c, faces[f, ends], x, y, f, edge))
    return [np.array(field).T for field in zip(*found, strict=True)]


def crossing(p, q):
    """x / w where the edge between two corners crosses y = 0 before the camera. -inf: nowhere."""
    if (p[1] < 0) == (q[1] < 0):
        return -np.inf
    t = p[1] / (p[1] - q[1])
    x, _, w = (1 - t) * p + t * q
    return x / w if w > 0 else -np.inf


def pairs_around(rng, count, width=7):
    """owner, other (N,): pixels of a picture 9 rows high, and one of their four neighbours."""
    row, column = rng.integers(1, 8, count), rng.integers(1, width - 1, count)
    step = np.array([1, -1, width, -width])[rng.integers(0, 4, count)]
    return row * width + column, row * width + column + step


def soup(rng, w):
    """screen, faces: 7 faces of random corners."""
    x, y = rng.uniform(-2, [[9], [11]], (2, 15))
    return (x, y, w), rng.permuted(np.tile(np.arange(15), (7, 1)), axis=1)[:, :3]


def in_space(owner, other, screen, width):
    """The vertices (V, 3) in the frame of one pair, (along, across, 1) times w."""
    x, y, w = screen
    right, up = other % width - owner % width, other // width - owner // width
    points = np.stack([x, y], -1) - [owner % width + 0.5, owner // width + 0.5]
    return w[:, None] * np.column_stack([points @ [right, up], points @ [abs(up), abs(right)],
                                         np.ones(len(points))])
