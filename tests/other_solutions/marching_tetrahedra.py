"""Lab 15 once more: a tetrahedron that is looked at, and loops over all of them."""

import numpy as np

CORNERS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])  # the last sees the others ccw


def tetrahedron_triangles(inside):
    inner, outer = np.flatnonzero(inside).tolist(), np.flatnonzero(~inside).tolist()
    ring = [(i, j) for n, i in enumerate(inner) for j in (outer if n % 2 == 0 else outer[::-1])]
    outward = (CORNERS[outer].mean(0) - CORNERS[inner].mean(0)) if ring else None
    triangles = []
    for n in range(1, len(ring) - 1):
        triangle = [ring[0], ring[n], ring[n + 1]]
        a, b, c = (CORNERS[list(pair)].mean(0) for pair in triangle)
        triangles.append(triangle if np.cross(b - a, c - a) @ outward > 0 else triangle[::-1])
    return np.array(triangles, int).reshape(-1, 3, 2)


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    t = s_a / (s_a - s_b)
    grad_t = np.einsum("ec,ec->e", grad_p, p_b - p_a)
    return ((1 - t)[:, None] * grad_p, t[:, None] * grad_p,
            grad_t * (1 - t) * t / s_a, grad_t * t**2 / s_a)
