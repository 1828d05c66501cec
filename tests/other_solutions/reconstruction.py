"""Lab 16 once more: vertex by vertex, edge by edge."""
import math

import numpy as np


def vertex_normals_backward(grad_normals, vertices, faces):
    m, grad_m, grad_vertices = np.zeros((3, *np.shape(vertices)))
    for face in faces:
        a, b, c = vertices[face]
        m[face] += np.cross(b - a, c - a)
    for v, length in enumerate(np.sqrt((m**2).sum(1))):
        if length > 0:
            n = m[v] / length
            grad_m[v] = (np.eye(3) - np.outer(n, n)) @ grad_normals[v] / length
    for face in faces:
        for k in range(3):  # a x b + b x c + c x a = ... + a x (b - c)
            side = vertices[face[k - 2]] - vertices[face[k - 1]]
            grad_vertices[face[k]] += np.cross(side, grad_m[face].sum(0))
    return grad_vertices


def sign(s):
    return -1.0 if s < 0 else 1.0


def sign_changes(distance, edges):
    total, grad_distance = 0.0, np.zeros(len(distance))
    for a, b in edges:
        if sign(distance[a]) != sign(distance[b]):
            for end, other in ((a, b), (b, a)):
                u = -float(distance[end]) * sign(distance[other])
                total += max(u, 0.0) + math.log1p(math.exp(-abs(u)))
                grad_distance[end] -= sign(distance[other]) / (1 + math.exp(-u))
    return total, grad_distance
