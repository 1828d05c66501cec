"""Cube kernels: lab 6's cube maps as loops over pixels, there and back to the texels.

    a thread a band    look_up   the texels that a pixel's direction sees, mixed
    one thread         look_up   the way back to the texels, in the order of the pixels

The numbers are equations of cube_maps.py and mipmapping.py. Pyramids are those of
pyramid_kernels.py. Directions that are no number see nothing, as those of length 0.
"""
from collections import namedtuple

import numpy as np

from course.given.compiled import kernel

from . import pyramid_kernels
from .compiled_pipeline import on_all_cores
from .cube_maps import FRAMES, SHORTEST
from .texel_kernels import constant
from .texturing import Sampler

# Of N pixels: directions (N, 3), their changes (N or 1, 6), a bias (N or 1, 1); and which filter.
Directions = namedtuple("Directions", "directions changes bias has_changes blends is_nearest")

# What a pixel sees: a place on a face, the lower level, and the share of the upper.
OnCube = namedtuple("OnCube", "face u v level share")


@kernel
def turned(face, x, y, z):
    """right . d, down . d, out . d of a face."""
    return (FRAMES[face, 0, 0] * x + FRAMES[face, 0, 1] * y + FRAMES[face, 0, 2] * z,
            FRAMES[face, 1, 0] * x + FRAMES[face, 1, 1] * y + FRAMES[face, 1, 2] * z,
            FRAMES[face, 2, 0] * x + FRAMES[face, 2, 1] * y + FRAMES[face, 2, 2] * z)


@kernel
def on_face(x, y, z):
    """Eqs. (10) and (11): face, u, v and m."""
    if abs(x) >= abs(y) and abs(x) >= abs(z):
        face = 0 if x > 0 else 1
    elif abs(y) >= abs(z):
        face = 2 if y > 0 else 3
    else:
        face = 4 if z > 0 else 5
    right, down, m = turned(face, x, y, z)
    return face, (1 + right / m) / 2, (1 + down / m) / 2, m


@kernel
def level_at(at, changes, size):
    """Eqs. (13) and (6) at a face, u, v and m. changes: d_x and d_y in turn."""
    (face, u, v, m), (x_x, x_y, y_x, y_y, z_x, z_y) = at, changes
    s_x, t_x, m_x = turned(face, x_x, y_x, z_x)
    s_y, t_y, m_y = turned(face, x_y, y_y, z_y)
    s_x, t_x = s_x - (2 * u - 1) * m_x, t_x - (2 * v - 1) * m_x
    s_y, t_y = s_y - (2 * u - 1) * m_y, t_y - (2 * v - 1) * m_y
    A, B, C = s_x * s_x + t_x * t_x, s_y * s_y + t_y * t_y, s_x * s_y + t_x * t_y
    squared = (A + B) / 2 + np.sqrt((A - B) * (A - B) / 4 + C * C)
    return np.log2(squared * (size / (2 * m)) * (size / (2 * m))) / 2


@kernel
def numbers_of(look, n):
    """Direction, changes and bias of pixel n. Kernels take them as numbers: of arrays, numba would
    count the owners, for longer than all the rest takes.
    """
    d, c = look.directions[n], look.changes[n if look.has_changes else 0]
    b = look.bias[n if len(look.bias) > 1 else 0]
    return ((np.float64(d[0]), np.float64(d[1]), np.float64(d[2])),
            (np.float64(c[0]), np.float64(c[1]), np.float64(c[2]),
             np.float64(c[3]), np.float64(c[4]), np.float64(c[5])), np.float64(b[0]))


@kernel
def sight(direction, changes, bias, has_changes, blends, top, size):
    """What pixel n sees. Face -1: nothing."""
    x, y, z = direction
    if not SHORTEST < max(abs(x), abs(y), abs(z)) < np.inf or np.isnan(x + y + z):
        return OnCube(-1, 0.0, 0.0, 0, 0.0)
    at = on_face(x, y, z)
    level = bias + (level_at(at, changes, size) if has_changes else 0.0) if top else 0.0
    level = min(level, float(top)) if level > 0 else 0.0  # also where it is no number
    share = level - int(level) if blends else 0.0
    return OnCube(at[0], at[1], at[2], int(level), share)


@kernel
def across_edge(face, column, row, size):
    """Eq. (12): the texel that stands for one beyond its face's edge. -1: there is none."""
    is_beside, is_above = not 0 <= column < size, not 0 <= row < size
    if is_beside and is_above:
        return -1
    if is_beside or is_above:
        p, q = 2 * ((column + 0.5) / size) - 1, 2 * ((row + 0.5) / size) - 1
        face, u, v, _ = on_face(
            p * FRAMES[face, 0, 0] + q * FRAMES[face, 1, 0] + FRAMES[face, 2, 0],
            p * FRAMES[face, 0, 1] + q * FRAMES[face, 1, 1] + FRAMES[face, 2, 1],
            p * FRAMES[face, 0, 2] + q * FRAMES[face, 1, 2] + FRAMES[face, 2, 2])
        column, row = int(u * size), int(v * size)
    return (face * size + row) * size + column


@kernel
def four_taps(at, size):
    """Eqs. (2) and (3): the texels around a place, and their weights. One may be missing at a
    corner of the cube: then the others have a third of its weight each.
    """
    x, y = at.u * size - 0.5, at.v * size - 0.5
    column, row = int(np.floor(x)), int(np.floor(y))
    a, b = x - column, y - row
    A, B, C, D = (1 - b) * (1 - a), (1 - b) * a, b * (1 - a), b * a
    if 0 <= column < size - 1 and 0 <= row < size - 1:
        i = (at.face * size + row) * size + column
        return (i, i + 1, i + size, i + size + 1), (A, B, C, D)
    i, j = across_edge(at.face, column, row, size), across_edge(at.face, column + 1, row, size)
    k = across_edge(at.face, column, row + 1, size)
    m = across_edge(at.face, column + 1, row + 1, size)
    if min(i, j, k, m) < 0:
        third = (A * (i < 0) + B * (j < 0) + C * (k < 0) + D * (m < 0)) / 3
        A, B = (A + third) * (i >= 0), (B + third) * (j >= 0)
        C, D = (C + third) * (k >= 0), (D + third) * (m >= 0)
    return (max(i, 0), max(j, 0), max(k, 0), max(m, 0)), (A, B, C, D)


@kernel
def taps(look, at, level, pyramid, size):
    """Where the texels of a level begin that make a colour, of size numbers each; their weights."""
    width, first = pyramid.width[level], pyramid.start[level]
    if look.is_nearest:  # eq. (1)
        i, j = min(int(at.v * width), width - 1), min(int(at.u * width), width - 1)
        at_it = np.uintp(first + ((at.face * width + i) * width + j) * size)
        return (at_it, at_it, at_it, at_it), (1.0, 0.0, 0.0, 0.0)
    (i, j, k, m), (A, B, C, D) = four_taps(at, width)
    share = at.share if level > at.level else 1 - at.share
    return ((np.uintp(first + i * size), np.uintp(first + j * size), np.uintp(first + k * size),
             np.uintp(first + m * size)), (share * A, share * B, share * C, share * D))


@kernel
def look_up(look, pyramid, part, colour, grad_colour, channels):
    """Adds what pixels in a part see to the colour (N, C), or adds grad_colour (N, C) to a pyramid
    of gradients, which is the backward pass. One of the two is None, and not compiled.
    """
    count, top, size = np.uintp(len(channels)), len(pyramid.start) - 1, pyramid.width[0]
    for n in range(*part):
        at = sight(*numbers_of(look, n), look.has_changes, look.blends, top, size)
        for level in range(at.level, at.level + (at.face >= 0) + (at.share > 0)):
            texels = pyramid.smaller if level else pyramid.image
            (i, j, k, m), (A, B, C, D) = taps(look, at, level, pyramid, len(channels))
            for c in range(count):
                if colour is not None:
                    colour[n, c] += (A * texels[i + c] + B * texels[j + c]
                                     + C * texels[k + c] + D * texels[m + c])
                if grad_colour is not None:
                    grad = grad_colour[n, c]
                    texels[i + c] += A * grad
                    texels[j + c] += B * grad
                    texels[k + c] += C * grad
                    texels[m + c] += D * grad


def looked_at(parts, filter_mode):
    """Directions of these parts, for a filter."""
    flat = (np.zeros((1, size), np.float32) if part is None else part.reshape(-1, size)
            for part, size in zip(parts, (3, 6, 1), strict=True))
    return Directions(*flat, parts[1] is not None, filter_mode == "linear-mipmap-linear",
                      filter_mode == "nearest")


def cube_colours(image, directions, changes, bias, filter_mode, _, top):
    """`cube_maps.cube_filtered` of levels 0 to top: image (6 n, n, C) -> colours (N, C).

    directions (N, 3), their changes (N, 3, 2) or None, bias (N,) or None. All is float32.
    """
    look, channels = looked_at((directions, changes, bias), filter_mode), constant(image.shape[2])
    pyramid = pyramid_kernels.make_pyramid(image, Sampler("mipmap", "", top), channels)
    colour = np.zeros((len(directions), len(channels)), np.float32)
    on_all_cores(lambda *part: look_up(look, pyramid, part, colour, None, channels),
                 len(colour), len(colour))
    return colour


def cube_colours_backward(grad_colour, image, directions, changes, bias, filter_mode, _, top):
    """Backward of `cube_colours`: grad_colour (N, C) -> grad_image. Others are None."""
    look, channels = looked_at((directions, changes, bias), filter_mode), constant(image.shape[2])
    grads = pyramid_kernels.room_for_pyramid(np.zeros(image.shape), Sampler("mipmap", "", top),
                                             np.zeros)
    look_up(look, grads, (0, len(directions)), None, grad_colour, channels)
    pyramid_kernels.add_to_image(grads, channels)
    return grads.image.reshape(image.shape), None, None, None
