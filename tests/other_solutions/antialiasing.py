"""Lab 8 once more: pair by pair and face by face, with dictionaries."""
import math

import numpy as np

from reference.antialiasing import Pairs, crossing_backward, ends_backward


def opposite_corners(faces):
    faces = np.asarray(faces).tolist()
    thirds = {}  # at each edge the third vertices, and the first corner of each
    for f, face in enumerate(faces):
        if len(set(face)) == 3:
            for k in range(3):
                thirds.setdefault(frozenset(face) - {face[k]}, {}).setdefault(face[k], 3 * f + k)
    opposite = np.full((len(faces), 3), -1)
    for f, face in enumerate(faces):
        for k in range(3):
            found = thirds.get(frozenset(face) - {face[k]}, {}) if len(set(face)) == 3 else {}
            others = [vertex for vertex in list(found)[:2] if vertex != face[k]]
            if len(others) == 1 and len(found) > 1:
                opposite[f, k] = found[others[0]]
    return opposite


def silhouette_edges(x, y, w, faces, across):
    def winding(corners):
        a, b, c = (complex(x[v], y[v]) for v in corners)
        area = ((b - a).conjugate() * (c - a)).imag
        behind = sum(w[v] < 0 for v in corners)
        return 1 if area == 0 else math.copysign(1, area) * (-1)**int(behind)

    silhouette = np.ones((len(faces), 3), bool)
    for f, face in enumerate(faces):
        for k in range(3):
            if across[f][k] >= 0:
                turned = [across[f][k] if j == k else face[j] for j in range(3)]
                silhouette[f, k] = winding(face) == winding(turned)
    return silhouette


def blend_pairs(colour, pairs):
    before = np.array(colour, float).reshape(-1, np.shape(colour)[2])
    after = before.copy()
    for a, b, c in zip(*Pairs(*pairs)[:3], strict=True):
        after[a if c < 0.5 else b] += (0.5 - min(max(c, 0), 1)) * (before[b] - before[a])
    return after.reshape(np.shape(colour))


def blend_pairs_backward(grad_output, colour, pairs, clip, epsilon=0.0):
    # The blend is a matrix times the colours: its transpose, entry by entry. Then edge by edge.
    height, width, channels = np.shape(colour)
    pixels, grad = (np.array(part, float).reshape(-1, channels) for part in (colour, grad_output))
    grad_colour, grad_clip = grad.copy(), np.zeros(np.shape(clip))
    for n, (a, b, c) in enumerate(zip(pairs.owner, pairs.other, pairs.c, strict=True)):
        share = 0.5 - min(max(c, 0), 1)
        to, source = (a, b) if share >= 0 else (b, a)
        grad_colour[source] += abs(share) * grad[to]
        grad_colour[to] -= abs(share) * grad[to]
        pull = (-1 if share >= 0 else 1) * grad[to] @ (pixels[source] - pixels[to])
        if 0 < c < 1:
            x, y = pairs.x[:, n], pairs.y[:, n]
            by_ends = np.reshape(crossing_backward(pull, x[0], y[0], x[1], y[1], epsilon), (2, 2))
            across, sign = abs(a - b) == width and a % width == b % width, np.sign(b - a)
            on_screen = (by_ends * [sign, 1])[:, ::-1 if across else 1]
            grad_clip += ends_backward(*on_screen.T[..., None], pairs.ends[:, n:n + 1], clip,
                                       width, height)
    return grad_colour.reshape(np.shape(colour)), grad_clip
