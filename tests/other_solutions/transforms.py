"""Lab 1 once more: one component after the other, and some other formulas."""
import math

import numpy as np


def transform_backward(grad_output, points, matrix):
    grad_matrix = np.zeros((4, 4))
    for index in np.ndindex(np.shape(points)[:-1]):
        grad_matrix += np.outer(grad_output[index], points[index])
    return np.einsum("...i,ij->...j", grad_output, matrix), grad_matrix


def rotate(axis, angle):
    # The quaternion of the rotation, and its matrix.
    length = math.sqrt(sum(float(part) ** 2 for part in axis))
    w = math.cos(angle / 2)
    x, y, z = (math.sin(angle / 2) * part / length for part in axis)
    return np.array([
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y), 0],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x), 0],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z, 0],
        [0, 0, 0, 1]])


def look_at(eye, target, up):
    if math.dist(target, eye) == 0:
        raise ValueError("the eye is at its target")
    forward = (target - eye) / math.dist(target, eye)
    upward = up - (up @ forward) * forward
    if math.hypot(*upward) <= 1e-10 * math.hypot(*up):
        raise ValueError("up is along the view")
    upward = upward / math.hypot(*upward)
    rows = [np.cross(forward, upward), upward, -forward]
    return np.array([[*row, -(row @ eye)] for row in rows] + [[0, 0, 0, 1]])


def frustum(l, r, b, t, near, far):
    # Along z: A z + B is -near at z = -near, and far at z = -far.
    slope, offset = np.linalg.solve([[-near, 1], [-far, 1]], [-near, far])
    matrix = np.zeros((4, 4), order="F")
    matrix[0, 0], matrix[1, 1] = near / ((r - l) / 2), near / ((t - b) / 2)
    matrix[:, 2] = (r + l) / (r - l), (t + b) / (t - b), slope, -1
    matrix[2, 3] = offset
    return matrix


def perspective_divide_backward(grad_ndc, clip):
    # Jacobian by Jacobian.
    grad_clip = np.empty(np.shape(clip))
    for index in np.ndindex(np.shape(clip)[:-1]):
        x, y, z, w = clip[index]
        jacobian = [[1 / w, 0, 0, -x / w**2], [0, 1 / w, 0, -y / w**2], [0, 0, 1 / w, -z / w**2]]
        grad_clip[index] = grad_ndc[index] @ jacobian
    return grad_clip
