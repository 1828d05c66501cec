"""Lab 15 once more: loops over all tetrahedra, and over all vertices."""
import numpy as np

from reference.marching_tetrahedra import tetrahedron_triangles


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
