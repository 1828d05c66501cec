"""Lab 9 once more: matrices for quaternions, element by element, and neighbour by neighbour."""
import math

import numpy as np


def squared_error_backward(grad_loss, picture, target):
    return np.subtract(picture, target) * (grad_loss / (np.size(picture) / 2))


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    beta_1, beta_2, epsilon = constants
    # With the two corrections moved into the rate and epsilon, as the paper's section 2 has it.
    mean = mean + (1 - beta_1) * (grad_x - mean)
    square = square + (1 - beta_2) * (grad_x * grad_x - square)
    root = math.sqrt(1 - beta_2**step)
    rate = rate * root / (1 - beta_1**step)
    return x - rate * mean / (np.sqrt(square) + epsilon * root), mean, square


def left_factor(p):
    """The matrix (..., 4, 4) that multiplies a quaternion by p from the left."""
    w, x, y, z = np.moveaxis(np.asarray(p), -1, 0)
    rows = [[w, -x, -y, -z], [x, w, -z, y], [y, z, w, -x], [z, -y, x, w]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def quaternion_product(p, q):
    return (left_factor(p) @ np.asarray(q)[..., None])[..., 0]


def quaternion_matrix(q):
    w, x, y, z = np.asarray(q, float) / np.abs(q).max()
    square = w * w + x * x + y * y + z * z
    return np.array([
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y), 0],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x), 0],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z, 0],
        [0, 0, 0, square]]) / square


def quaternion_matrix_backward(grad_matrix, q):
    largest = np.abs(q).max()
    unit = np.asarray(q, float) / largest
    w, x, y, z = unit
    square, matrix = unit @ unit, quaternion_matrix(unit)
    numerators = [  # of the matrix's nine quotients, their derivatives by w, x, y, z
        [[w, -z, y], [z, w, -x], [-y, x, w]],
        [[x, y, z], [y, -x, -w], [z, w, -x]],
        [[-y, x, w], [x, y, z], [-w, z, -y]],
        [[-z, -w, x], [w, -z, y], [x, y, z]]]
    grad = [np.sum(grad_matrix[:3, :3] * (2 * np.array(slope) - 2 * part * matrix[:3, :3]))
            for slope, part in zip(numerators, unit, strict=True)]
    return np.array(grad) / square / largest


def rotation_angle(p, q):
    # Half of the angle has the tangent |p - q| / |p + q|, of a half of it: Kahan's formula.
    p, q = np.broadcast_arrays(p, q)
    apart, together = (np.sqrt(np.square(v).sum(-1)) for v in (p - q, p + q))
    return 4 * np.arctan2(np.minimum(apart, together), np.maximum(apart, together))


def sums(coverage, target):
    shared = np.vdot(coverage, target)
    return shared, np.sum(coverage) + np.sum(target) - shared


def silhouette_loss(coverage, target):
    shared, either = sums(coverage, target)
    return (either - shared) / either if either > 0 else 0


def silhouette_loss_backward(grad_loss, coverage, target):
    shared, either = sums(coverage, target)
    if not either:
        return 0 * coverage
    return grad_loss * ((1 - target) * shared / either - target) / either


def uniform_laplacian(positions, edges):
    neighbours = [[] for _ in positions]
    for a, b in edges:
        neighbours[a].append(b)
        neighbours[b].append(a)
    return np.array([x - np.mean(positions[near], 0) if near else 0 * x
                     for x, near in zip(positions, neighbours, strict=True)])


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    # The matrix of eq. (5), column by column.
    units = np.eye(len(positions))
    matrix = np.array([uniform_laplacian(unit[:, None], edges)[:, 0] for unit in units])
    return matrix @ grad_laplacian
