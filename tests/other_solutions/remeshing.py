"""Lab 13's flips once more: angle by angle, and one flip after another."""
import math

import numpy as np

from reference.remeshing import LEAST_GAIN, can_flip


def angle(corner, p, q):
    """Between the sides to p and to q: Kahan's formula, from the two sides of equal length."""
    u, v = p - corner, q - corner
    if not u.any() or not v.any():
        return 0.0
    u, v = u / math.hypot(*u), v / math.hypot(*v)
    return 2 * math.atan2(math.hypot(*(u - v)), math.hypot(*(u + v)))


def flip_best(vertices, faces, quads, quad_faces, gain=None):
    if gain is None:
        gain = [angle(c, a, b) + angle(d, a, b) - math.pi for a, b, c, d in vertices[quads]]
    may = can_flip(vertices, faces, quads)
    able = [q for q in range(len(quads)) if gain[q] > LEAST_GAIN and may[q]]
    best = {}
    for q in able:
        for vertex in quads[q]:
            best[vertex] = max(best.get(vertex, (0, -1)), (gain[q], q))
    faces = np.array(faces)
    for q in able:
        if all(best[vertex][1] == q for vertex in quads[q]):
            a, b, c, d = quads[q]
            faces[quad_faces[q]] = [[a, d, c], [b, c, d]]
    return faces
