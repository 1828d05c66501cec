"""Shadows by ray casting: exact, without a map. The truth that lab 14 is measured by.

A light is a tuple, such as lab 14's Light: position (3,), rotation (3, 3), clip_from_light (4, 4).
Nothing here needs a lab's exercise. Each distance is an axial depth: along the light's axis.
"""
import numpy as np

from . import inputs
from .arrays import chunks, expand

SELF_HIT = 1e-7  # of a distance: a ray that starts on a surface is not stopped by it
GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))


def ray_cast(points, vertices, faces, light, cells=128):
    """Which points (N, 3) does the light reach, past all faces? -> bool (N,). Exact, without a map.

    Rays to one light are points of its picture: a ray p = (q_x, q_y, w) meets a face where
    c = M^-1 p has no negative number, with (q_x, q_y, w) of the corners as columns of M. The face's
    distance there is sum c_k distance_k / sum c_k. Each ray is tested with the faces of its cell of
    the picture alone. Cells, unlike texels, make no difference to the result.
    """
    inputs.require_mesh(vertices, faces)
    vertices, faces, points = np.asarray(vertices), np.asarray(faces), np.asarray(points)
    inputs.require(np.isfinite(points).all(), "finite points, as of pixels that see a face",
                   "some that are not")
    inputs.require(cells >= 1, "at least one cell a side", cells)
    corners, corner_distance, x, y = seen_from(light, vertices, cells)
    face, start = faces_in_cells(x[faces.T], y[faces.T], cells)
    planes, face_distance = edge_planes(*corners[faces.T])[face], corner_distance[faces][face]
    rays, distance, x, y = seen_from(light, points, cells)
    column, row = np.clip(np.floor([x, y]), 0, cells - 1).astype(int)
    cell = row * cells + column
    first, count = start[cell], np.diff(start)[cell]
    lit = np.ones(len(rays), bool)
    for part in chunks(count):  # pairs of a ray and a face
        ray, entry = expand(first[part], count[part])
        met, at_face = meetings(rays[part][ray], planes[entry], face_distance[entry])
        ray = part.start + ray[met]
        lit[ray[at_face < distance[ray] * (1 - SELF_HIT)]] = False
    return lit


def meetings(rays, planes, face_distance):
    """Which of N pairs of a ray and a face meet, and how far away: indices (M,), distance (M,)."""
    c = np.einsum("nki,ni->nk", planes, rays)
    met = np.flatnonzero((c >= 0).all(1) & (c.sum(1) > 0))
    c = c[met]
    return met, (c * face_distance[met]).sum(1) / c.sum(1)


def seen_from(light, points, cells):
    """Points (N, 3) from the light: (q_x, q_y, w) (N, 3), distance (N,), x, y in cells, each (N,).
    """
    position, rotation, clip_from_light = light
    q = (points - position) @ rotation.T
    w = clip_from_light[3, 2] * q[:, 2] + clip_from_light[3, 3]
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * (cells / 2)
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * (cells / 2)
    return np.stack([q[:, 0], q[:, 1], w], 1), -q[:, 2], x, y


def edge_planes(a, b, c):
    """Corners as columns of M, each (F, 3): the rows of M^-1 times |det M| -> (F, 3, 3).

    Row k is the plane through the eye and the edge opposite to corner k, positive on the face's
    side: the edge functions of lab 2. All 0 where det M = 0, a face seen edge-on.
    """
    rows = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], 1)
    return rows * np.sign((rows[:, 0] * a).sum(1))[:, None, None]


def faces_in_cells(x, y, cells):
    """Which faces lie, by their bounds, in each of cells x cells cells of the map? x, y (3, F) ->
    face (M,), sorted by cell, and start (cells^2 + 1,): cell c has face[start[c]:start[c + 1]].
    """
    low_x, low_y, high_x, high_y = (
        np.clip(np.floor(bound), 0, cells - 1).astype(int)
        for bound in (x.min(0), y.min(0), x.max(0), y.max(0)))
    face, row = expand(low_y, high_y - low_y + 1)
    strip, column = expand(low_x[face], (high_x - low_x + 1)[face])
    cell = row[strip] * cells + column
    order = np.argsort(cell, kind="stable")
    return face[strip][order], np.searchsorted(cell[order], np.arange(cells**2 + 1))


def error_shares(lit, truth):
    """How wrong a shadow is: the shares of all pixels that are wrongly dark and wrongly lit.

    lit, truth: bool (N,), N > 0 -> two numbers from 0 to 1.

    >>> error_shares(np.array([True, True, False, True]), np.array([True, False, True, False]))
    (np.float64(0.25), np.float64(0.5))
    """
    return np.mean(~lit & truth), np.mean(lit & ~truth)


def disc_offsets(count):
    """Places spread evenly over the unit disc -> (count, 2), by x and y.

    The seeds of a sunflower: number k = 0, 1, ... lies sqrt((k + 1/2) / count) from the middle, in
    the direction k GOLDEN_ANGLE, counter-clockwise from x.

    >>> disc_offsets(2).round(3)
    array([[ 0.5  ,  0.   ],
           [-0.639,  0.585]])
    """
    if count < 1:
        raise ValueError(f"disc_offsets expects at least one place, got {count}; ask for 1 or more")
    k = np.arange(count)
    radius, angle = np.sqrt((k + 0.5) / count), k * GOLDEN_ANGLE
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], -1)


def area_light_truth(points, vertices, faces, light, light_radius, offsets):
    """The mean of `ray_cast` over point lights on a disc that faces the scene -> (N,).

    Their places are light_radius offsets (K, 2) in the light's x and y.
    """
    position, rotation, clip_from_light = light
    if clip_from_light[3, 2] == 0:
        raise ValueError("area_light_truth expects a point light, got light from a direction; "
                         "make the light with point_light")
    total = np.zeros(len(points))
    for offset in light_radius * offsets:
        total += ray_cast(points, vertices, faces,
                          (position + offset @ rotation[:2], rotation, clip_from_light))
    return total / len(offsets)
