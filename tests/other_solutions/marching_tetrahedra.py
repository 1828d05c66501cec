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


def marching_tetrahedra(points, distance, tetrahedra):
    crossed = sorted({(int(a), int(b)) for t in tetrahedra for a in t for b in t
                      if distance[a] < 0 <= distance[b]})
    row = {pair: number for number, pair in enumerate(crossed)}
    faces = [[row[int(t[a]), int(t[b])] for a, b in triangle] for t in tetrahedra
             for triangle in tetrahedron_triangles(distance[t] < 0)]
    ends = np.array(crossed, int).reshape(-1, 2)
    s_a, s_b = distance[ends.T]
    t = (s_a / (s_a - s_b))[:, None]
    a, b = points[ends.T]
    return a + t * (b - a), np.array(faces, int).reshape(-1, 3), ends


def marching_tetrahedra_backward(grad_vertices, ends, points, distance):
    grad_points, grad_distance = np.zeros(np.shape(points)), np.zeros(len(points))
    for grad, (a, b) in zip(grad_vertices, ends, strict=True):
        t = distance[a] / (distance[a] - distance[b])
        grad_points[a] += (1 - t) * grad
        grad_points[b] += t * grad
        moved = grad @ (points[b] - points[a]) / (distance[a] - distance[b])
        grad_distance[a] += (1 - t) * moved
        grad_distance[b] += t * moved
    return grad_points, grad_distance
