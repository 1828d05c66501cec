"""Lab 13 once more: triangle by triangle, edge by edge, and dense matrices."""
import math

import numpy as np

from reference.regularization import NO_AREA, uniform_adam_step


def lengths(triangle):
    """Of the sides opposite to the three corners."""
    return [math.dist(triangle[k - 2], triangle[k - 1]) for k in range(3)]


def twice_area(triangle):
    """Twice the area; 0 if that is next to nothing."""
    twice = math.hypot(*np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0]))
    return twice if twice > NO_AREA * max(lengths(triangle))**2 else 0.0


def cotangents(triangles):
    found = np.zeros(np.shape(triangles)[:-1])
    for at in np.ndindex(found.shape[:-1]):
        twice = twice_area(triangles[at])
        if twice:
            a, b, c = np.square(lengths(triangles[at]))  # the law of cosines
            found[at] = np.array([b + c - a, c + a - b, a + b - c]) / (2 * twice)
    return found


def laplacian_entries(edges, weights, vertex_count):
    matrix = dense(edges, weights, vertex_count)
    rows, columns = np.nonzero(matrix)
    return rows, columns, matrix[rows, columns]


def dense(edges, weights, vertex_count):
    # Of the incidence matrix D, which takes differences along edges: D^T W D.
    D = np.zeros((len(edges), vertex_count))
    for row, (a, b) in zip(D, edges, strict=True):
        row[a], row[b] = 1, -1
    return D.T @ (np.reshape(weights, (-1, 1)) * D)


def smooth_explicit(x, edges, weights, mass, step):
    moved = np.array(x, float)
    for (a, b), weight in zip(edges, weights, strict=True):
        for end, other in ((a, b), (b, a)):
            if mass[end]:
                moved[end] -= step * weight / mass[end] * (x[end] - x[other])
    return moved


def smooth_implicit(x, edges, weights, mass, step):
    matrix = step * dense(edges, weights, len(x)) + np.diag(mass)
    free = np.flatnonzero(matrix.any(1))
    moved = np.array(x, float)
    moved[free] = np.linalg.solve(matrix[np.ix_(free, free)], (np.diag(mass) @ x)[free])
    return moved


def large_step(x, grad_x, mean, square, step, rate, spread):
    edges, weights, amount = spread
    matrix = np.eye(len(x)) + amount * dense(edges, weights, len(x))
    u, mean, square = uniform_adam_step(matrix @ x, np.linalg.inv(matrix) @ grad_x, mean, square,
                                        step, rate)
    return np.linalg.inv(matrix) @ u, mean, square
