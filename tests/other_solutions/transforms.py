"""Lab 1 once more: one component after the other, and some other formulas."""
import math

import numpy as np


def transform(points, matrix):
    return np.einsum("...j,ij->...i", points, matrix)


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


def normal_matrix(matrix):
    # The cofactors: of the same direction as the inverse's transpose, scaled to obey the equation.
    a, b, c = (matrix[k, :3] for k in range(3))
    return np.array([np.cross(b, c), np.cross(c, a), np.cross(a, b)]) / (a @ np.cross(b, c))


def pinhole(f):
    return [[f, 0, 0, 0], [0, f, 0, 0], [0, 0, f, 0], [0, 0, 1, 0]]


def frustum_sides(fov_y, aspect, near):
    height = near * math.sin(fov_y / 2) / math.cos(fov_y / 2)
    return [-aspect * height, aspect * height, -height, height]


def frustum(l, r, b, t, near, far):
    # Along z: A z + B is -near at z = -near, and far at z = -far.
    slope, offset = np.linalg.solve([[-near, 1], [-far, 1]], [-near, far])
    matrix = np.zeros((4, 4), order="F")
    matrix[0, 0], matrix[1, 1] = near / ((r - l) / 2), near / ((t - b) / 2)
    matrix[:, 2] = (r + l) / (r - l), (t + b) / (t - b), slope, -1
    matrix[2, 3] = offset
    return matrix


def orthographic(l, r, b, t, near, far):
    middle = np.array([(l + r) / 2, (b + t) / 2, -(near + far) / 2])
    half = np.array([(r - l) / 2, (t - b) / 2, -(far - near) / 2])
    move, size = np.eye(4), np.eye(4)
    move[:3, 3] = -middle
    size[[0, 1, 2], [0, 1, 2]] = 1 / half
    return size @ move


def perspective_divide(clip):
    x, y, z, w = np.moveaxis(clip, -1, 0)
    return np.stack([x / w, y / w, z / w], -1)


def perspective_divide_backward(grad_ndc, clip):
    # Jacobian by Jacobian.
    grad_clip = np.empty(np.shape(clip))
    for index in np.ndindex(np.shape(clip)[:-1]):
        x, y, z, w = clip[index]
        jacobian = [[1 / w, 0, 0, -x / w**2], [0, 1 / w, 0, -y / w**2], [0, 0, 1 / w, -z / w**2]]
        grad_clip[index] = grad_ndc[index] @ jacobian
    return grad_clip


def viewport(width, height):
    matrix = np.diag([0.5 * width, 0.5 * height, 1, 1])
    matrix[:2, 3] = 0.5 * width, 0.5 * height
    return matrix


def to_screen_backward(grad_screen, width, height):
    return np.multiply(grad_screen, [width / 2, height / 2, 1])
