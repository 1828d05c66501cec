"""Lab 8 once more: pair by pair and face by face, with dictionaries."""
import math

import numpy as np

from reference.antialiasing import EDGES, WINDOW


def opposite_vertices(faces):
    faces = np.asarray(faces).tolist()
    thirds = {}
    for face in faces:
        if len(set(face)) == 3:
            for k in range(3):
                found = thirds.setdefault(frozenset(face) - {face[k]}, [])
                if face[k] not in found:
                    found.append(face[k])
    opposite = np.full((len(faces), 3), -1)
    for f, face in enumerate(faces):
        for k in range(3):
            across = thirds.get(frozenset(face) - {face[k]}, [])[:2] if len(set(face)) == 3 else []
            if len(across) == 2 and face[k] in across:
                opposite[f, k] = across[1 - across.index(face[k])]
    return opposite


def silhouette_edges(x, y, w, faces, opposite):
    def winding(corners):
        a, b, c = (complex(x[v], y[v]) for v in corners)
        area = ((b - a).conjugate() * (c - a)).imag
        behind = sum(w[v] < 0 for v in corners)
        return 1 if area == 0 else math.copysign(1, area) * (-1)**int(behind)

    silhouette = np.ones((len(faces), 3), bool)
    for f, face in enumerate(faces):
        for k in range(3):
            if opposite[f][k] >= 0:
                turned = [opposite[f][k] if j == k else face[j] for j in range(3)]
                silhouette[f, k] = winding(face) == winding(turned)
    return silhouette


def neighbour_pairs(face_index, outlined):
    height, width = face_index.shape
    pairs = []
    for right, up in ((1, 0), (0, 1)):
        pairs += [(i * width + j, (i + up) * width + j + right)
                  for i in range(height - up) for j in range(width - right)
                  if face_index[i, j] != face_index[i + up, j + right]
                  and (outlined[i, j] or outlined[i + up, j + right])]
    return tuple(np.array(pairs, int).reshape(-1, 2).T)


def frames(owner, other, width):
    """Of each pair: the owner's centre (2,), and a matrix (2, 2) from the screen to the frame."""
    for own, to in zip(owner, other, strict=True):
        centre = np.array([own % width + 0.5, own // width + 0.5])
        sign = -1 if to < own else 1
        side_by_side = own // width == to // width
        yield centre, np.array([[sign, 0], [0, 1]] if side_by_side else [[0, sign], [1, 0]])


def pair_frame(screen_x, screen_y, owner, other, width):
    x, y = np.empty(np.shape(screen_x)), np.empty(np.shape(screen_y))
    for n, (centre, matrix) in enumerate(frames(owner, other, width)):
        x[:, n], y[:, n] = matrix @ (np.stack([screen_x[:, n], screen_y[:, n]]) - centre[:, None])
    return x, y


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    grad = np.empty((2, *np.shape(grad_x)))
    for n, (_, matrix) in enumerate(frames(owner, other, width)):
        grad[..., n] = matrix.T @ np.stack([grad_x[:, n], grad_y[:, n]])
    return grad[0], grad[1]


def crossing(x0, y0, x1, y1):
    # A mean of both ends, each with a weight of its own that is right to the last digits.
    return x0 * (y1 / (y1 - y0)) - x1 * (y0 / (y1 - y0))


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    def by_first(x0, y0, x1, y1):
        height = y1 - y0
        height = height + np.where(height > 0, epsilon, -epsilon)
        c = (x0 * y1 - x1 * y0) / height
        return grad_c * y1 / height, grad_c * (c - x1) / height

    return (*by_first(x0, y0, x1, y1), *by_first(x1, y1, x0, y0))


def last_crossing(x, y, w):
    edges, crossings = [], []
    for n in range(x.shape[1]):
        best = 0, -math.inf
        for k, (i, j) in enumerate(EDGES):
            above_i, above_j = y[i, n] * w[i, n], y[j, n] * w[j, n]
            in_front = w[i, n] * abs(above_j) + w[j, n] * abs(above_i) > 0
            if (above_i < 0) != (above_j < 0) and in_front:
                c = crossing(x[i, n], y[i, n], x[j, n], y[j, n])
                best = max(best, (k, c), key=lambda found: found[1])
        edges.append(best[0])
        crossings.append(best[1])
    return np.array(edges, int), np.array(crossings, float)


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    steep = ~(np.square(x1 - x0) > np.square(y1 - y0))
    return np.logical_and.reduce([is_silhouette, steep, np.abs(c - 0.5) < 0.5 + WINDOW])


def blend_weight(c):
    return np.where(c > 0, np.where(c < 1, 0.5 - c, -0.5), 0.5)


def blend(colour, owner, other, alpha):
    shape = np.shape(colour)
    before = np.array(colour, float).reshape(-1, shape[2])
    after = before.copy()
    for a, b, share in zip(owner, other, alpha, strict=True):
        if share > 0:
            after[a] += share * (before[b] - before[a])
        else:
            after[b] -= share * (before[a] - before[b])
    return after.reshape(shape)


def blend_backward(grad_output, colour, owner, other, alpha):
    # The blend is a matrix times the colours: its transpose, entry by entry.
    shape = np.shape(colour)
    pixels, grad = (np.array(part, float).reshape(-1, shape[2]) for part in (colour, grad_output))
    grad_colour, grad_alpha = grad.copy(), np.empty(len(alpha))
    for n, (a, b, share) in enumerate(zip(owner, other, alpha, strict=True)):
        to, source = (a, b) if share >= 0 else (b, a)
        grad_colour[source] += abs(share) * grad[to]
        grad_colour[to] -= abs(share) * grad[to]
        grad_alpha[n] = (1 if share >= 0 else -1) * grad[to] @ (pixels[source] - pixels[to])
    return grad_colour.reshape(shape), grad_alpha
