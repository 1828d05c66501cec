"""Soft shadows: light that has a size, and borders without steps.

A shadow map answers yes or no. These are means of its answers over places around (x, y). Maps,
lights and eqs. (1) to (5) are those of `shadow_mapping`.

    PCF:  the mean of (3) around (x, y), each at the distance of the plane there             (6)
    PCSS: (6) over the lamp's disc as the receiver sees it at the blocker:
          its radius there is R (distance - blocker) / distance, in texels on the map        (7)

PCF is percentage-closer filtering, PCSS percentage-closer soft shadows. Each distance is an axial
depth, as there.

Sources: Reeves et al. 1987 (6), Fernando 2005 (7).
"""
from typing import NamedTuple

import numpy as np

from .shadow_mapping import (
    before_light,
    distance_slopes,
    map_position,
    require_side,
    side_of,
    stored_distance,
)


class Receivers(NamedTuple):
    """N points on a light's map, and how fast their planes recede there.

    place (N, 2): x and y in texels. distance (N,). slope (N, 2): `distance_slopes`.
    """

    place: np.ndarray
    distance: np.ndarray
    slope: np.ndarray


def receivers(points, normals, light, size):
    """Points (N, 3), with the unit normals (N, 3) of their faces, on a map of size x size texels.

    -> Receivers. ValueError for points that are not finite, or not before the light.
    """
    require_side("receivers", size, 1)
    if not np.shape(points) == np.shape(normals) == (len(points), 3):
        raise ValueError("receivers expects points and normals (N, 3), one normal for each point, "
                         f"got {np.shape(points)} and {np.shape(normals)}; `visible_points` "
                         "gives both")
    q = before_light(points, light)
    on_map = light.clip_from_light, size, size
    slope = distance_slopes(normals @ light.rotation.T, q, *on_map)
    return Receivers(map_position(q, *on_map), -q[:, 2], slope)


def on_plane(place, distance, slope, step):  # step 14.6
    """The place a step away on the map, and how distant the receiver's plane is there.

    place, slope (N, 2), distance (N,), step (N, 2) or (2,) -> place + step, and the distance (N,)
    at the *centre* of its texel: it grows by slope . (from place to that centre).

    >>> on_plane(np.array([[2.25, 3.5]]), np.array([7.0]), np.array([[0.5, 0.1]]), np.array([1, 2]))
    (array([[3.25, 5.5 ]]), array([7.825]))
    """
    raise NotImplementedError("exercise 14.6: on_plane")


def steps_around(offsets, radius):
    """Yields radius * offset for each of offsets (K, 2): (1, 2), or for radius (N,) (N, 2)."""
    for offset in offsets:
        yield (radius * offset[:, None]).T


def percentage_closer(distance_map, place, distance, slope,  # step 14.7
                      bias, offsets, radius):
    """Eq. (6): light reaches what share of the places around (x, y)? -> (N,)

    place, distance, slope are Receivers', bias and radius (N,) or numbers, offsets (K, 2).
    `steps_around` gives the steps, `on_plane` each place and the plane's distance there.

    >>> distance_map, one = np.array([[4.0, 4.0, 9.0, 9.0]]), np.ones(1)
    >>> offsets = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]])
    >>> percentage_closer(distance_map, np.array([[1.5, 0.5]]), 8 * one, np.zeros((1, 2)), 0.1,
    ...                   offsets, 1.0).round(3)
    array([0.333])
    """
    raise NotImplementedError("exercise 14.7: percentage_closer")


def percentage_closer_soft(distance_map, place, distance, slope,  # exercise 14.8 (5 points)
                           bias, offsets, lamp):
    """PCSS, (7): what share of a disc's light comes to the receivers? -> (N,)

    At depth b, the disc's radius is lamp / b texels. Blockers are places dark by (6), within the
    radius (7) for the least distance stored. b is the mean of what is stored there. Then filter by
    (6), within the radius (7) for b, or 0 without blockers. A radius below 0 is 0.

    >>> distance_map = np.array([[1.0, 2.0, 9.0, 9.0, 9.0]])
    >>> offsets, one = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]]), np.ones(1)
    >>> percentage_closer_soft(distance_map, np.array([[2.3, 0.5]]), 4 * one, np.zeros((1, 2)),
    ...                        0.1, offsets, 1.6).round(3)  # blockers within 1.2, b = 2, then 0.4
    array([0.667])
    """
    raise NotImplementedError("exercise 14.8: percentage_closer_soft")


def soft_shadow(points, normals, light, distance_map, light_radius, bias, offsets):
    """PCSS, eq. (7): the lit share of points (N, 3) under a disc of light_radius -> (N,).

    The disc is a point light's, and faces the scene. offsets (K, 2) are places in the unit disc.
    distance_map (S, S): the light's, by `depth_map`.
    """
    require_disc(light, light_radius, offsets)
    size = side_of(distance_map)
    lamp = light_radius * light.clip_from_light[0, 0] * size / 2
    return percentage_closer_soft(distance_map, *receivers(points, normals, light, size), bias,
                                  offsets, lamp)


def require_disc(light, light_radius, offsets):
    """ValueError, in one sentence, unless `soft_shadow` can take a disc like this."""
    if light.clip_from_light[3, 2] == 0:
        raise ValueError("soft_shadow expects a point light, got light from a direction; "
                         "make the light with point_light")
    if not light_radius >= 0:
        raise ValueError(f"soft_shadow expects a disc of radius 0 or more, got {light_radius}; "
                         "0 is a point")
    if np.shape(offsets) != (len(offsets), 2) or len(offsets) == 0:
        raise ValueError("soft_shadow expects offsets (K, 2), at least one place in the unit disc, "
                         f"got {np.shape(offsets)}; make them with ray_casting.disc_offsets")
