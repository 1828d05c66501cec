"""The pyramid of lab 6 once more: singular values by SVD, every level straight down."""
import math

import numpy as np


def halve(image):
    if image.shape[0] > 1:
        image = 0.5 * image[::2] + 0.5 * image[1::2]
    if image.shape[1] > 1:
        image = 0.5 * image[:, ::2] + 0.5 * image[:, 1::2]
    return image


def halve_backward(grad_half, image):
    height, width, _ = image.shape
    tall, wide = min(height, 2), min(width, 2)
    return np.kron(grad_half, np.full((tall, wide, 1), 1 / (tall * wide)))


def pyramid_backward(grad_levels):
    grad_image = np.array(grad_levels[0], float)
    for grad in grad_levels[1:]:  # every level straight down to the texture
        tall, wide = (a // b for a, b in zip(grad_image.shape, grad.shape[:2], strict=False))
        grad_image += np.repeat(np.repeat(grad, tall, 0), wide, 1) / (tall * wide)
    return grad_image


def in_texels(jacobian, width, height):
    return np.array(jacobian) * np.array([[width], [height]])


def mip_level(jacobian, width, height):
    lengths = np.linalg.svd(in_texels(jacobian, width, height), compute_uv=False)[:, 0]
    return [math.log2(length) if length > 0 else -math.inf for length in lengths]


def mip_level_backward(grad_level, jacobian, width, height):
    grad = np.zeros(np.shape(jacobian))
    for n, J in enumerate(in_texels(jacobian, width, height)):
        A, B = (J**2).sum(0)
        C = J[:, 0] @ J[:, 1]
        u, size, v = np.linalg.svd(J)
        if A == B and C == 0:  # a square, or nothing
            slope = J / (J**2).sum() if J.any() else 0 * J
        else:
            slope = np.outer(u[:, 0], v[0]) / size[0]
        grad[n] = grad_level[n] * slope * [[width], [height]] / math.log(2)
    return grad


def blend_levels(level, top):
    clamped = [min(max(at, 0.0), float(top)) for at in level]
    lower = np.array([int(at) for at in clamped], int)
    return lower, np.where(lower < top, lower + 1, top), np.array(clamped) - lower
