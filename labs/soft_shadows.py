"""Soft shadows: light that has a size, and borders without steps.

A shadow map answers yes or no. These are means of its answers over places around (x, y). Maps,
lights, receivers and eqs. (1) to (5) are those of `shadow_mapping`.

    PCF:  the mean of (3) around (x, y), each at the distance of the plane there             (6)
    PCSS: (6) over the lamp's disc as the receiver sees it at the blocker:
          its radius there is R (distance - blocker) / distance, in texels on the map        (7)

PCF is percentage-closer filtering, PCSS percentage-closer soft shadows. Each distance is an axial
depth, as there.

Sources: Reeves et al. 1987 (6), Fernando 2005 (7).
"""
import numpy as np

from .shadow_mapping import is_lit, receivers, side_of, stored_distance


def on_plane(place, distance, slope, step):  # extra 14.10 (2 points)
    """A place some texels away on the map, and how distant the receiver's plane is there.

    place, slope (N, 2), distance (N,), step (N, 2) or (2,) -> place + step, and the distance (N,)
    at the *centre* of the texel that holds it. From `place`, it grows by slope to a texel.

    >>> on_plane(np.array([[2.25, 3.5]]), np.array([7.0]), np.array([[0.5, 0.1]]), np.array([1, 2]))
    (array([[3.25, 5.5 ]]), array([7.825]))
    """
    # In a cone the plane lies a little farther: this may let light through, and is never acne.
    there = place + step
    to_centre = np.floor(there) + 0.5 - place
    return there, distance + (slope * to_centre).sum(1)


def steps_around(offsets, radius):
    """Yields radius * offset for each of offsets (K, 2): (1, 2), or for radius (N,) (N, 2)."""
    for offset in offsets:
        yield (radius * offset[:, None]).T


def percentage_closer(distance_map, place, distance, slope,  # exercise 14.11 (3 points)
                      bias, offsets, radius):
    """Eq. (6): light reaches what share of the places around (x, y)? -> (N,).

    `steps_around` gives the steps, `on_plane` each place and its distance, `is_lit` is eq. (3).
    place, slope (N, 2), distance (N,), bias, radius (N,) or numbers, offsets (K, 2).

    >>> distance_map, one = np.array([[4.0, 4.0, 9.0, 9.0]]), np.ones(1)
    >>> offsets = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]])
    >>> percentage_closer(distance_map, np.array([[1.5, 0.5]]), 8 * one, np.zeros((1, 2)), 0.1,
    ...                   offsets, 1.0).round(3)
    array([0.333])
    """
    raise NotImplementedError("exercise 14.11: percentage_closer")


def blocker_distance(distance_map, place, distance, slope,  # extra 14.12 (3 points)
                     bias, offsets, radius):
    """The mean of the stored distances of blockers: of the places that are not lit -> (N,).

    The places, and when they are lit, are those of `percentage_closer`. Where there is no blocker:
    np.inf.

    >>> distance_map, two = np.array([[4.0, 5.0, 9.0, 9.0]]), np.ones(2)
    >>> offsets = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]])
    >>> blocker_distance(distance_map, np.array([[1.5, 0.5], [3.5, 0.5]]), 8 * two,
    ...                  np.zeros((2, 2)), 0.1, offsets, 1.0)
    array([4.5, inf])
    """
    total, count = np.zeros((2, *distance.shape))
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        stored = stored_distance(distance_map, there)
        blocks = plane > stored + bias
        total += np.where(blocks, stored, 0.0)
        count += blocks
    return np.where(count > 0, total / np.maximum(count, 1), np.inf)


def penumbra_radius(distance, blocker, light_radius, clip_from_light,  # exercise 14.13 (2 points)
                    width):
    """Eq. (7)'s radius: how wide is the soft border, in texels? -> (N,).

    R is light_radius. distance, blocker (N,). It is 0 unless the blocker is nearer. np.inf: none.
    `python3 -m course demo --impl labs shadow` then draws your own shadows, hard and soft.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 2, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> penumbra_radius(np.array([4.0, 4.0]), np.array([2.0, np.inf]), 0.5, C, 8)
    array([1., 0.])
    """
    raise NotImplementedError("exercise 14.13: penumbra_radius")


def soft_shadow(points, normals, light, distance_map, light_radius, bias, offsets):
    """PCSS, eq. (7): the lit share of points (N, 3) under a disc of light_radius -> (N,).

    The disc is a point light's, and faces the scene. offsets (K, 2) are places in the unit disc.
    distance_map (S, S): the light's, by `depth_map`. One search for blockers, where the nearest of
    all could be. Then (6) over the radius that their mean has.
    """
    require_disc(light, light_radius, offsets)
    size = side_of(distance_map)
    on_map = receivers(points, normals, light, size)
    to_texels = light_radius, light.clip_from_light, size
    nearest = np.full(len(points), distance_map.min())
    search = penumbra_radius(on_map.distance, nearest, *to_texels)
    blocker = blocker_distance(distance_map, *on_map, bias, offsets, search)
    radius = penumbra_radius(on_map.distance, blocker, *to_texels)
    return percentage_closer(distance_map, *on_map, bias, offsets, radius)


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
