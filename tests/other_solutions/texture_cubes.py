"""Lab 10's cubes and light once more: texel by texel, face by face."""
import itertools
import math

import numpy as np


def places(weight, depth, z, size):
    """low (N, 3) and how far above it (N, 3)."""
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.trunc(t), size - 2)
    return low.astype(int), t - low


def cube_taps(weight, depth, z, size):
    low, above = places(weight, depth, z, size)
    index, tap = np.empty((len(depth), 8), int), np.empty((len(depth), 8))
    for n in range(8):
        up = np.array([n & 1, n >> 1 & 1, n >> 2])
        index[:, n] = (low + up) @ [size * size, size, 1]
        tap[:, n] = np.where(up, above, 1 - above).prod(1)
    return index, tap


def cube_taps_backward(grad_tap, weight, depth, z, size):
    _, above = places(weight, depth, z, size)
    grad_t = np.zeros(np.shape(weight))
    for m, (c, b, a) in enumerate(itertools.product((0, 1), repeat=3)):
        parts = np.where([a, b, c], above, 1 - above)
        for k, up in enumerate((a, b, c)):
            others = parts[:, k - 1] * parts[:, k - 2]
            grad_t[:, k] += (2 * up - 1) * grad_tap[:, m] * others
    grad = (size - 1) * grad_t / z  # by weight times depth
    return grad * depth[:, None], (grad * weight).sum(1), -grad * weight * depth[:, None] / z


def normal_of(face):
    a, b, c = face
    across = np.cross(a - c, b - c)
    length = math.hypot(*across)
    return (across / length, length) if length > 0 else (across, 1.0)


def face_light(corners, ambient, directional, towards):
    return np.array([ambient + np.multiply(directional, max(0.0, normal_of(face)[0] @ towards))
                     for face in corners]).reshape(len(corners), len(ambient))


def face_light_backward(grad_light, corners, ambient, directional, towards):
    grad_corners, grad_towards = np.zeros(np.shape(corners)), np.zeros(3)
    grad_ambient, grad_directional = np.zeros(len(ambient)), np.zeros(len(ambient))
    for f, face in enumerate(corners):
        grad_ambient += grad_light[f]
        normal, length = normal_of(face)
        cosine = normal @ towards
        if cosine <= 0:
            continue
        grad_directional += grad_light[f] * cosine
        grad_cosine = grad_light[f] @ directional
        grad_towards += grad_cosine * normal
        # n = N / |N|, and N = a x b + b x c + c x a.
        grad_across = grad_cosine * (towards - cosine * normal) / length
        for k in range(3):
            grad_corners[f, k] = np.cross(face[(k + 1) % 3] - face[(k + 2) % 3], grad_across)
    return grad_corners, grad_ambient, grad_directional, grad_towards
