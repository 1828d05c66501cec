"""The pyramid of lab 6 once more: singular values by SVD, every level straight down."""
import math

import numpy as np


def halve(image):
    if image.shape[0] > 1:
        image = 0.5 * image[::2] + 0.5 * image[1::2]
    if image.shape[1] > 1:
        image = 0.5 * image[:, ::2] + 0.5 * image[:, 1::2]
    return image


def texels_a_pixel(jacobian, width, height):
    return np.array(jacobian) * np.array([[width], [height]])


def mip_level(jacobian, width, height):
    lengths = np.linalg.svd(texels_a_pixel(jacobian, width, height), compute_uv=False)[:, 0]
    return [math.log2(length) if length > 0 else -math.inf for length in lengths]


def blend_levels(level, top):
    clamped = [min(max(at, 0.0), float(top)) for at in level]
    lower = np.array([int(at) for at in clamped], int)
    return lower, np.where(lower < top, lower + 1, top), np.array(clamped) - lower
