"""Lab 17 once more: by NumPy, and by sorting."""
import numpy as np

from reference.kernels import invert_face


def nearest_faces(pixel, depth, face, count):
    coarse = np.floor((depth + 1) * 2**29)
    order = np.lexsort([face, coarse])[::-1]  # the nearest is written last
    found = np.full(count, -1)
    found[pixel[order]] = face[order]
    return found


def bins(bin_of, count):
    start = np.append(0, np.cumsum(np.bincount(bin_of, minlength=count)))
    return start, np.argsort(bin_of, kind="stable")


def tile_lists(boxes, size, across, down):
    rows, columns = np.divmod(np.arange(across * down), across)
    low = size * np.stack([columns, rows], -1)[:, None]
    meets = ((boxes[:, :2] < low + size) & (boxes[:, 2:] > low)).all(-1)
    return np.append(0, np.cumsum(meets.sum(1))), np.nonzero(meets)[1]


def gathered(start, item, values):
    total = np.zeros((len(start) - 1, values.shape[1]))
    np.add.at(total, np.repeat(np.arange(len(total)), np.diff(start)), values[item])
    return total


def three_passes(triangles, z, colours, lists, size, width, height):
    inverse = np.empty((len(triangles), 3, 3))
    for face in range(len(triangles)):
        invert_face(face, triangles, inverse)
    y, x = np.mgrid[:height, :width] + 0.5
    tile = (y // size * -(-width // size) + x // size).astype(int)
    picture, nearest = np.zeros((height, width, colours.shape[2])), np.full((height, width), np.inf)
    for face in range(len(triangles)):
        asked = np.array([face in faces for faces in np.split(lists[1], lists[0][1:-1])])
        m, far = inverse[face], z[face]
        c = m[:, :1, None] * x + m[:, 1:2, None] * y + m[:, 2:, None]
        parts = c / far[:, None, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            depth = 1 / parts.sum(0)
            closer = asked[tile] & (c >= 0).all(0) & (depth < nearest)
        nearest[closer] = depth[closer]
        picture[closer] = depth[closer, None] * (parts[:, closer].T @ colours[face])
    return picture
