"""Lab 8's pairs once more: pixel by pixel, and each condition in words."""
import numpy as np

from reference.antialiasing import Pairs, crossing
from reference.outlines import is_dropped, seen_silhouettes, vertices_on_screen

EDGES = (1, 2), (2, 0), (0, 1)


def jumping_pairs(face_index, depth, screen, faces, outlined):
    x, y, w = screen
    found = []
    for i, j in np.ndindex(face_index.shape):
        for up, right in ((0, 1), (0, -1), (1, 0), (-1, 0)):
            k, m, face = i + up, j + right, face_index[i, j]
            if not (0 <= k < face_index.shape[0] and 0 <= m < face_index.shape[1]):
                continue
            nearer = (depth[i, j], -i, -j) < (depth[k, m], -k, -m)
            if face == face_index[k, m] or not nearer or not outlined[face]:
                continue
            to = [(x[v] - j - 0.5, y[v] - i - 0.5) for v in faces[face]]
            along = [right * a + up * b for a, b in to]
            across = [abs(up) * a + abs(right) * b for a, b in to]
            last = max((leaves(along, across, np.sign(w[faces[face]]), *ends), -edge)
                       for edge, ends in enumerate(EDGES))
            a, b = EDGES[-last[1]]
            width = face_index.shape[1]
            found.append((i * width + j, k * width + m, last[0], faces[face, [a, b]],
                          (along[a], along[b]), (across[a], across[b]), face, -last[1]))
    columns = zip(*found, strict=True) if found else [[]] * 8
    return Pairs(*(np.array(column).T for column in columns))


def leaves(along, across, side, a, b):
    if (side[a] * across[a] < 0) == (side[b] * across[b] < 0):
        return -np.inf
    if side[a] * abs(across[b]) + side[b] * abs(across[a]) <= 0:
        return -np.inf
    return float(crossing(along[a], across[a], along[b], across[b]))


def blended_pairs(face_index, depth, clip, faces, opposite):
    screen = vertices_on_screen(clip, face_index.shape[1], face_index.shape[0])
    silhouette = seen_silhouettes(face_index, screen, faces, opposite)
    every = jumping_pairs(face_index, depth, screen, faces, np.ones(len(faces), bool))
    kept = [n for n, (owner, other, c, _, x, y, face, edge) in enumerate(
                zip(*(np.transpose(field) for field in every), strict=True))
            if silhouette[int(face), int(edge)] and abs(x[1] - x[0]) <= abs(y[1] - y[0])
            and -1 / 16 < c < 17 / 16 and not is_dropped(c, owner, other)]
    return Pairs(*(np.asarray(field)[..., kept] for field in every))
