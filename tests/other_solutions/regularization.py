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


def cotangent_laplacian(vertices, faces):
    # Edge by edge in a dictionary, by the law of cosines.
    weights, areas = {}, np.zeros(len(vertices))
    for face in np.asarray(faces).tolist():
        triangle = np.asarray(vertices)[face]
        area, squares = twice_area(triangle), np.square(lengths(triangle))
        for k in range(3):
            edge = tuple(sorted((face[k - 1], face[k - 2])))
            cotangent = (squares.sum() - 2 * squares[k]) / (2 * area) if area else 0.0
            weights[edge] = weights.get(edge, 0.0) + cotangent / 2
            areas[face[k]] += area / 6
    edges = sorted(weights)
    return np.array(edges), np.array([weights[edge] for edge in edges]), areas


def dense(edges, weights, vertex_count):
    # Of the incidence matrix D, which takes differences along edges: D^T W D.
    D = np.zeros((len(edges), vertex_count))
    for row, (a, b) in zip(D, edges, strict=True):
        row[a], row[b] = 1, -1
    return D.T @ (np.reshape(weights, (-1, 1)) * D)


def smooth_implicit(x, edges, weights, mass, step):
    matrix = step * dense(edges, weights, len(x)) + np.diag(mass)
    free = np.flatnonzero(matrix.any(1))
    moved = np.array(x, float)
    moved[free] = np.linalg.solve(matrix[np.ix_(free, free)], (np.diag(mass) @ x)[free])
    return moved


def large_step(x, grad_x, mean, square, step, rate, system):
    edges, weights, amount = system
    matrix = np.eye(len(x)) + amount * dense(edges, weights, len(x))
    u, mean, square = uniform_adam_step(matrix @ x, np.linalg.inv(matrix) @ grad_x, mean, square,
                                        step, rate)
    return np.linalg.inv(matrix) @ u, mean, square
