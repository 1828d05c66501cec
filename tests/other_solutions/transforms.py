"""Lab 1 once more: one component after the other, and some other formulas."""
import math

import numpy as np


def transform_backward(grad_output, points, matrix):
    grad_matrix = np.zeros((4, 4))
    for index in np.ndindex(np.shape(points)[:-1]):
        grad_matrix += np.outer(grad_output[index], points[index])
    return np.einsum("...i,ij->...j", grad_output, matrix), grad_matrix


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


def perspective(fov_y, aspect, near, far):
    # Along z: A z + B is -near at z = -near, and far at z = -far.
    slope, offset = np.linalg.solve([[-near, 1], [-far, 1]], [-near, far])
    focal = 1 / math.tan(fov_y / 2)
    matrix = np.zeros((4, 4), order="F")
    matrix[0, 0], matrix[1, 1] = focal / aspect, focal
    matrix[2:, 2] = slope, -1
    matrix[2, 3] = offset
    return matrix


def to_screen(clip, width, height):
    # The viewport as a matrix, before the divide.
    viewport = np.array([[width / 2, 0, 0, width / 2], [0, height / 2, 0, height / 2],
                         [0, 0, 1, 0], [0, 0, 0, 1]])
    x, y, z, w = np.moveaxis(clip @ viewport.T, -1, 0)
    return np.stack([x / w, y / w, z / w], -1)


def to_screen_backward(grad_screen, clip, width, height):
    # Jacobian by Jacobian.
    grad_clip = np.empty(np.shape(clip))
    for index in np.ndindex(np.shape(clip)[:-1]):
        x, y, z, w = clip[index]
        jacobian = [[1 / w, 0, 0, -x / w**2], [0, 1 / w, 0, -y / w**2], [0, 0, 1 / w, -z / w**2]]
        grad_clip[index] = grad_screen[index] * [width / 2, height / 2, 1] @ jacobian
    return grad_clip
