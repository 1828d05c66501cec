"""Lab 13 once more: triangle by triangle, edge by edge, and dense matrices."""
import math

import numpy as np

from reference.regularization import NO_AREA, uniform_adam_step


def lengths(triangle):
    """Of the sides opposite to the three corners."""
    return [math.dist(triangle[k - 2], triangle[k - 1]) for k in range(3)]


def angle(corner, p, q):
    """Between the sides to p and to q: by the cross product of the two shortest sides."""
    u, v = p - corner, q - corner
    if not u.any() or not v.any():
        return 0.0
    short, middle, _ = sorted([u, v, q - p], key=lambda side: math.hypot(*side))
    return math.atan2(math.hypot(*np.cross(short, middle)), u @ v)


def corner_angles(triangles):
    angles = np.empty(np.shape(triangles)[:-1])
    for at in np.ndindex(angles.shape[:-1]):
        t = triangles[at]
        angles[at] = [angle(t[k], t[k - 2], t[k - 1]) for k in range(3)]
    return angles


def radius_ratio(triangles):
    # r = 2 A / (a + b + c), R = a b c / 4 A, with the area A.
    ratios = np.zeros(np.shape(triangles)[:-2])
    for at in np.ndindex(ratios.shape):
        t = triangles[at]
        area = math.hypot(*np.cross(t[1] - t[0], t[2] - t[0])) / 2
        a, b, c = lengths(t)
        if area > 0:
            ratios[at] = 16 * area / (a + b + c) * area / (a * b * c)
    return ratios[()]


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


def cotangents_backward(grad_cotangents, triangles):
    grad = np.zeros(np.shape(triangles))
    for at in np.ndindex(np.shape(triangles)[:-2]):
        t, twice = triangles[at], twice_area(triangles[at])
        if not twice:
            continue
        normal = np.cross(t[1] - t[0], t[2] - t[0]) / twice
        slope_of_twice = [np.cross(normal, t[k - 1] - t[k - 2]) for k in range(3)]
        for k, g in enumerate(grad_cotangents[at]):
            u, v = t[k - 2] - t[k], t[k - 1] - t[k]
            slope = np.zeros((3, 3))  # of u . v
            slope[k - 2], slope[k - 1], slope[k] = v, u, -u - v
            grad[at] += g * (slope / twice - u @ v / twice**2 * np.array(slope_of_twice))
    return grad


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


def inverse_of(mass):
    return np.array([1 / m if m else 0.0 for m in mass])


def laplacian_energy(x, edges, weights, mass):
    moved = dense(edges, weights, len(x)) @ x
    return np.trace(moved.T @ np.diag(inverse_of(mass)) @ moved)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    L, inverse = dense(edges, weights, len(x)), inverse_of(mass)
    moved = L @ x
    grad_moved = 2 * grad_energy * inverse[:, None] * moved
    grad_weights = [(grad_moved[a] - grad_moved[b]) @ (x[a] - x[b]) for a, b in edges]
    grad_mass = -grad_energy * (moved**2).sum(1) * inverse**2
    return L.T @ grad_moved, np.array(grad_weights), grad_mass


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


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    step = inverse_of(mass)[:, None] * dense(edges, weights, len(x))
    one = np.eye(len(x))
    return np.linalg.matrix_power((one + grow * step) @ (one - shrink * step), rounds) @ x


def enclosed_volume_backward(grad_volume, triangles):
    a, b, c = np.swapaxes(triangles, 0, 1)
    return grad_volume / 6 * np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], 1)


def large_step(x, grad_x, mean, square, step, rate, spread):
    edges, weights, amount = spread
    matrix = np.eye(len(x)) + amount * dense(edges, weights, len(x))
    u, mean, square = uniform_adam_step(matrix @ x, np.linalg.inv(matrix) @ grad_x, mean, square,
                                        step, rate)
    return np.linalg.inv(matrix) @ u, mean, square
