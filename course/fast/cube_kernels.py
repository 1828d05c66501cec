"""Cube kernels: lab 6's cube maps as loops over pixels: which texels each of them sees.

    a thread a band   taps    what `cube_maps.cube_look_ups` finds, of the linear filters

The numbers are equations of cube_maps.py and mipmapping.py. Who sees nothing has weights 0.
"""
from collections import namedtuple

import numpy as np

from course.given.compiled import kernel

from .compiled_pipeline import on_all_cores
from .cube_maps import FRAMES, SHORTEST

# Of N pixels: directions (N, 3), their changes (N or 0, 3, 2), and a bias (N,).
Look = namedtuple("Look", "directions changes bias")

# Of L levels: where each begins, and its faces' sides. blends: whether two of them are mixed.
Levels = namedtuple("Levels", "start size blends")

# A place on a face, u and v in -1 ... 1, and m of eq. (10).
Place = namedtuple("Place", "face u v m")


@kernel
def in_frame(face, x, y, z):
    """right . d, down . d, out . d of a face."""
    return (FRAMES[face, 0, 0] * x + FRAMES[face, 0, 1] * y + FRAMES[face, 0, 2] * z,
            FRAMES[face, 1, 0] * x + FRAMES[face, 1, 1] * y + FRAMES[face, 1, 2] * z,
            FRAMES[face, 2, 0] * x + FRAMES[face, 2, 1] * y + FRAMES[face, 2, 2] * z)


@kernel
def place_of(x, y, z):
    """Eqs. (10) and (11)."""
    face, most = 0, x
    for k, m in enumerate((-x, y, -y, z, -z)):
        if m > most:
            face, most = k + 1, m
    right, down, m = in_frame(face, x, y, z)
    return Place(face, right / m, down / m, m)


@kernel
def texel_at(face, column, row, size):
    """The number of a texel, or of the one that stands for it, eq. (12). -1: there is none."""
    if 0 <= column < size and 0 <= row < size:
        return (face * size + row) * size + column
    if not (0 <= column < size or 0 <= row < size):
        return -1
    u, v = (2 * column + 1) / size - 1, (2 * row + 1) / size - 1
    at = place_of(u * FRAMES[face, 0, 0] + v * FRAMES[face, 1, 0] + FRAMES[face, 2, 0],
                  u * FRAMES[face, 0, 1] + v * FRAMES[face, 1, 1] + FRAMES[face, 2, 1],
                  u * FRAMES[face, 0, 2] + v * FRAMES[face, 1, 2] + FRAMES[face, 2, 2])
    column, row = int((1 + at.u) / 2 * size), int((1 + at.v) / 2 * size)
    return (at.face * size + row) * size + column


@kernel
def level_at(look, n, at, size):
    """Eqs. (13) and (6), and the bias."""
    if not len(look.changes):
        return look.bias[n]
    change, scale = look.changes[n], size / (2 * at.m)
    s_x, t_x, m_x = in_frame(at.face, change[0, 0], change[1, 0], change[2, 0])
    s_y, t_y, m_y = in_frame(at.face, change[0, 1], change[1, 1], change[2, 1])
    s_x, t_x = (s_x - at.u * m_x) * scale, (t_x - at.v * m_x) * scale
    s_y, t_y = (s_y - at.u * m_y) * scale, (t_y - at.v * m_y) * scale
    A, B, C = s_x * s_x + t_x * t_x, s_y * s_y + t_y * t_y, s_x * s_y + t_x * t_y
    return np.log2((A + B) / 2 + np.sqrt((A - B) * (A - B) / 4 + C * C)) / 2 + look.bias[n]


@kernel
def write_taps(at, level, share, n, index, weight):
    """The four texels around a place, of which one may be missing at a corner of the cube, from
    place n of index and weight on. level: where it begins, and its faces' side.
    """
    start, size = level
    x, y = (1 + at.u) / 2 * size - 0.5, (1 + at.v) / 2 * size - 0.5
    column, row = int(np.floor(x)), int(np.floor(y))
    missing, a, b = 0.0, x - column, y - row
    for k in range(4):
        part = share * (a if k % 2 else 1 - a) * (b if k // 2 else 1 - b)
        texel = texel_at(at.face, column + k % 2, row + k // 2, size)
        if texel < 0:
            missing = part
        index[n + k], weight[n + k] = start + max(texel, 0), part if texel >= 0 else -1.0
    for k in range(n, n + 4):
        weight[k] = weight[k] + missing / 3 if weight[k] >= 0 else 0.0


@kernel
def taps(look, levels, part, index, weight):
    """index, weight (N K,) of pixels in a part, K = 4 or 8. They are 0 to begin with."""
    top, width = len(levels.size) - 1, 8 if levels.blends else 4
    for n in range(*part):
        x, y, z = (np.float64(look.directions[n, 0]), np.float64(look.directions[n, 1]),
                   np.float64(look.directions[n, 2]))
        if not SHORTEST < max(abs(x), abs(y), abs(z)) < np.inf or np.isnan(x + y + z):
            continue
        at = place_of(x, y, z)
        level = level_at(look, n, at, levels.size[0]) if top else 0.0
        level = min(level, float(top)) if level > 0 else 0.0  # also where it is no number
        low = int(level)
        share = level - low if levels.blends else 0.0
        for k in range(width // 4):
            level = min(low + k, top)
            write_taps(at, (levels.start[level], levels.size[level]), share if k else 1 - share,
                       width * n + 4 * k, index, weight)


def look_ups(mipmap, footprint, filter_mode):
    """index, weight (N, 4 or 8) of `cube_maps.cube_look_ups`, float32, of all pixels."""
    directions, changes, bias = footprint
    changes = np.empty((0, 3, 2)) if changes is None else changes.reshape(-1, 3, 2)
    look = Look(directions, changes, np.broadcast_to(bias, len(directions)))
    levels = Levels(mipmap.start, mipmap.width, filter_mode == "linear-mipmap-linear")
    shape = len(directions), 8 if levels.blends else 4
    index, weight = np.zeros(shape, np.int32), np.zeros(shape, np.float32)
    on_all_cores(lambda *part: taps(look, levels, part, index.reshape(-1), weight.reshape(-1)),
                 *2 * shape[:1])
    return index, weight
