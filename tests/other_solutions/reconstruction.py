"""Lab 16 once more: tables of coefficients, vertex by vertex, edge by edge, one dense solve."""
import math

import numpy as np

ROOTS = [math.sqrt(a / math.pi) for a in (1/4, 3/4, 15/4, 5/16, 15/16)]
# Y_k = s_k + v_k . n + n . M_k n: the numbers, the vectors and the symmetric matrices.
SINGLE, LINEAR, SQUARE = np.zeros(9), np.zeros((9, 3)), np.zeros((9, 3, 3))
SINGLE[0], SINGLE[6] = ROOTS[0], -ROOTS[3]
LINEAR[1, 1] = LINEAR[2, 2] = LINEAR[3, 0] = ROOTS[1]
for k_, a_, b_ in (4, 0, 1), (5, 1, 2), (7, 0, 2):
    SQUARE[k_, a_, b_] = SQUARE[k_, b_, a_] = ROOTS[2] / 2
SQUARE[6, 2, 2] = 3 * ROOTS[3]
SQUARE[8] = np.diag([ROOTS[4], -ROOTS[4], 0])


def sh_basis(normals):
    n = np.asarray(normals)
    return SINGLE + n @ LINEAR.T + np.einsum("...i,kij,...j->...k", n, SQUARE, n)


def sh_basis_backward(grad_basis, normals):
    both = np.einsum("...k,kij,...j->...i", grad_basis, SQUARE, normals)
    return grad_basis @ LINEAR + 2 * both


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


def picture_loss_backward(grad_loss, picture, target, weight):
    each = np.array([2/3, 2/3, 2/3, 2 * weight]) / np.prod(picture.shape[:-1])
    return np.einsum("...c,c->...c", picture - target, grad_loss * each)


def sign(s):
    return -1.0 if s < 0 else 1.0


def sign_changes(distance, edges):
    total = 0.0
    for a, b in edges:
        if sign(distance[a]) != sign(distance[b]):
            for s, other in ((distance[a], distance[b]), (distance[b], distance[a])):
                u = -float(s) * sign(other)
                total += max(u, 0.0) + math.log1p(math.exp(-abs(u)))
    return total
