"""Lab 8's pairs once more: pixel by pixel, and each condition in words."""
import numpy as np

from reference.antialiasing import Pairs, last_crossing, pair_frame
from reference.outlines import is_dropped, seen_silhouettes, vertices_on_screen


def jumping_pairs(face_index, depth, screen, faces, outlined):
    height, width = face_index.shape
    found = []
    for i, j in np.ndindex(height, width):
        face = face_index[i, j]
        for k, m in ((i, j + 1), (i, j - 1), (i + 1, j), (i - 1, j)):
            if (0 <= k < height and 0 <= m < width and face != face_index[k, m]
                    and (depth[i, j], -i, -j) < (depth[k, m], -k, -m) and outlined[face]):
                found.append((i * width + j, k * width + m, face))
    owner, other, face = np.array(found, int).reshape(-1, 3).T
    corners = faces[face].T
    x, y, w = (np.array([values[vertex] for vertex in corners]) for values in screen)
    x, y = pair_frame(x, y, owner, other, width)
    edge, c = last_crossing(x, y, w)
    i, j = (edge + 1) % 3, (edge + 2) % 3
    ends = [np.stack([np.choose(i, rows), np.choose(j, rows)]) for rows in (corners, x, y)]
    return Pairs(owner, other, c, *ends, face, edge)


def blended_pairs(face_index, depth, clip, faces, opposite):
    screen = vertices_on_screen(clip, face_index.shape[1], face_index.shape[0])
    silhouette = seen_silhouettes(face_index, screen, faces, opposite)
    every = jumping_pairs(face_index, depth, screen, faces, np.ones(len(faces), bool))
    kept = [n for n, (face, edge) in enumerate(zip(every.face, every.edge, strict=True))
            if silhouette[face, edge] and abs(np.subtract(*every.x[:, n])) <= abs(
                np.subtract(*every.y[:, n])) and -1 / 16 < every.c[n] < 17 / 16
            and not is_dropped(every.c[n], every.owner[n], every.other[n])]
    return Pairs(*(field[..., kept] for field in every))
