"""Pyramid kernels: a texture's pyramid and the level of each pixel, for texel_kernels.py.

Level 0 of the pyramid is the image itself. The other levels follow each other in one array. All
arrays are flat: texel t of a level is C numbers at start + C t. channels is any tuple of C numbers,
so that compiled code knows C.
"""
from collections import namedtuple

import numpy as np

from course.given.compiled import each_band, kernel

from . import mipmapping

STEP = 1 << 14  # pixels, or texels, that a thread takes at a time


# The levels of a texture, or their gradients.
Pyramid = namedtuple("Pyramid", "image smaller start width height")

# One of them, or its gradient: where it begins in an array of texels, and its sides.
Level = namedtuple("Level", "texels start width height")


@kernel
def halve_rows(level, half, first, end, channels):
    """Eq. (5): rows first <= i < end of the Level half, from the one below it."""
    size = len(channels)
    columns, rows = min(level.width, 2), min(level.height, 2)
    beside, above = np.uintp((columns - 1) * size), np.uintp((rows - 1) * level.width * size)
    texels, halves = level.texels, half.texels
    for i in range(first, end):
        low, to = level.start + i * rows * level.width * size, half.start + i * half.width * size
        for j in range(half.width):
            for k in range(size):
                a = np.uintp(low + j * columns * size + k)
                b = a + beside
                halves[np.uintp(to + j * size + k)] = (
                    (texels[a] + texels[a + above]) + (texels[b] + texels[b + above])) / 4


@kernel
def halve_rows_backward(level, half, first, end, channels):
    """Adds the gradient of the Level half to rows first <= i < end of that of the one below it."""
    size = len(channels)
    columns, rows = min(level.width, 2), min(level.height, 2)
    texels, halves, share = level.texels, half.texels, 1 / (rows * columns)
    for i in range(first, end):
        low, to = level.start + i * level.width * size, half.start + (i // rows) * half.width * size
        for j in range(half.width):
            for k in range(size):
                grad = share * halves[np.uintp(to + j * size + k)]
                for beside in range(columns):
                    texels[np.uintp(low + (j * columns + beside) * size + k)] += grad


@kernel
def squares_at(jacobian, n, width, height):
    """Rows s_x, s_y and t_x, t_y of pixel n's J in texels, and A, B, C of eq. (6)."""
    at = np.uintp(4) * n
    s_x, s_y = jacobian[at] * width, jacobian[at + np.uintp(1)] * width
    t_x, t_y = jacobian[at + np.uintp(2)] * height, jacobian[at + np.uintp(3)] * height
    return (s_x, s_y, t_x, t_y, s_x * s_x + t_x * t_x, s_y * s_y + t_y * t_y,
            s_x * s_y + t_x * t_y)


@kernel
def squared_sizes(jacobian, width, height, first, end, squared):
    """The square of eq. (6)'s greatest singular value, of pixels first <= n < end."""
    for n in range(np.uintp(first), np.uintp(end)):
        _, _, _, _, A, B, C = squares_at(jacobian, n, width, height)
        squared[n] = (A + B) / 2 + np.sqrt((A - B) * (A - B) / 4 + C * C)


@kernel
def squared_sizes_backward(grad_level, jacobian, width, height, first, end, grad_jacobian):
    """`mip_level_backward` of pixels first <= n < end."""
    for n in range(np.uintp(first), np.uintp(end)):
        s_x, s_y, t_x, t_y, A, B, C = squares_at(jacobian, n, width, height)
        S = (A + B) / 2
        R = np.sqrt((A - B) * (A - B) / 4 + C * C)
        grad_sum = grad_level[n] / (2 * np.log(2.0) * (S + R if S > 0 else np.inf))
        by_root = grad_sum / (R if R > 0 else np.inf)
        grad_A = grad_sum + by_root * (A - B) / 2  # twice the gradients of A and B
        grad_B = grad_sum - by_root * (A - B) / 2
        grad_C = by_root * C
        at = np.uintp(4) * n
        grad_jacobian[at] = width * (grad_A * s_x + grad_C * s_y)
        grad_jacobian[at + np.uintp(1)] = width * (grad_B * s_y + grad_C * s_x)
        grad_jacobian[at + np.uintp(2)] = height * (grad_A * t_x + grad_C * t_y)
        grad_jacobian[at + np.uintp(3)] = height * (grad_B * t_y + grad_C * t_x)


def in_steps(function, count, step):
    """function(first, end) for bands of count, step in each -> the list of what it returns."""
    bands = [(first, min(first + step, count)) for first in range(0, count, step)]
    return list(each_band(function, bands))


def level_of(pyramid, level):
    """One Level of a Pyramid."""
    return Level(pyramid.smaller if level else pyramid.image, pyramid.start[level],
                 pyramid.width[level], pyramid.height[level])


def between_levels(halve, pyramid, level, rows, channels):
    """halve: `halve_rows` or its backward pass, for as many rows."""
    below, half = level_of(pyramid, level - 1), level_of(pyramid, level)
    in_steps(lambda first, end: halve(below, half, first, end, channels),
             rows, max(STEP // int(below.width), 1))


def room_for_pyramid(image, sampler, room):
    """A Pyramid of image (h, w, C), for a sampler, with `room` for its smaller levels."""
    levels = mipmapping.pyramid(image[..., :0], sampler.max_level if "mipmap" in sampler.filter_mode
                                else 0)  # only their shapes
    height, width, _ = np.transpose([level.shape for level in levels])
    count = height * width * image.shape[2]
    start = np.append([0, 0], np.cumsum(count[1:]))[:len(levels)]
    return Pyramid(image.ravel(), room(count[1:].sum(), image.dtype), start, width, height)


def make_pyramid(image, sampler, channels):
    """`mipmapping.pyramid`, of image (h, w, C), for a sampler."""
    pyramid = room_for_pyramid(image, sampler, np.empty)
    for level in range(1, len(pyramid.start)):
        between_levels(halve_rows, pyramid, level, pyramid.height[level], channels)
    return pyramid


def add_to_image(grads, channels):
    """`mipmapping.pyramid_backward`: the gradients of all levels are added to the image's."""
    for level in range(len(grads.start) - 1, 0, -1):
        between_levels(halve_rows_backward, grads, level, grads.height[level - 1], channels)


def levels_of(footprint, pyramid, first, end, level):
    """`footprint_level` of pixels first <= n < end. footprint: its parts are flat. The logarithm is
    NumPy's, because numba's may round otherwise.
    """
    _, jacobian, bias = footprint
    part = slice(first, end)
    if jacobian is not None:
        squared_sizes(jacobian, pyramid.width[0], pyramid.height[0], first, end, level)
        with np.errstate(divide="ignore"):
            level[part] = np.log2(level[part]) / 2
    level[part] += bias[part]
