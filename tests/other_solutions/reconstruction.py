"""Lab 16 once more: vertex by vertex, edge by edge."""
import math

import numpy as np

from reference.reconstruction import sh_basis, sh_basis_backward


def shade_backward(grad_colour, albedo, normals, light):
    grad_albedo, grad_normals = np.zeros(np.shape(albedo)), np.zeros(np.shape(normals))
    grad_light = np.zeros(np.shape(light))
    for v, n in enumerate(normals):
        for c in range(grad_light.shape[1]):
            reached = grad_colour[v, c] * albedo[v, c]
            grad_albedo[v, c] = grad_colour[v, c] * (sh_basis(n) @ light[:, c])
            grad_light[:, c] += reached * sh_basis(n)
            grad_normals[v] += reached * sh_basis_backward(light[:, c], n)
    return grad_albedo, grad_normals, grad_light


def crossing_matrix(v):
    """The matrix whose product with u is v x u."""
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def vertex_normals_backward(grad_normals, vertices, faces):
    m = np.zeros(np.shape(vertices))
    for face in faces:
        a, b, c = vertices[face]
        for v in face:
            m[v] += np.cross(a, b) + np.cross(b, c) + np.cross(c, a)
    grad_m = np.zeros(m.shape)
    for v, length in enumerate(np.sqrt((m**2).sum(1))):
        if length > 0:
            n = m[v] / length
            grad_m[v] = (np.eye(3) - np.outer(n, n)) @ grad_normals[v] / length
    grad_vertices = np.zeros(m.shape)
    for face in faces:
        grad_sum = grad_m[face].sum(0)
        for k in range(3):  # a x b + b x c + c x a = ... + a x (b - c): by a, the transpose
            _, after, before = np.roll(face, -k)
            turned = crossing_matrix(vertices[before] - vertices[after])
            grad_vertices[face[k]] += turned.T @ grad_sum
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
