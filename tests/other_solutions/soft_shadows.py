"""The soft shadows of lab 14 once more: all places first, then their means."""

import numpy as np

from reference.shadow_mapping import is_lit, stored_distance


def on_plane(place, distance, slope, step):
    there = np.add(place, step)
    centre = np.trunc(there) + 0.5 + np.where(there < np.trunc(there), -1, 0)
    return there, distance + np.einsum("nk,nk->n", centre - place, slope)


def places(distance_map, place, distance, slope, bias, offsets, radius):
    """Of each receiver and offset: is the place lit (N, K), and what is stored there (N, K)?"""
    lit, stored = [], []
    for offset in offsets:
        step = np.broadcast_to(radius, len(place))[:, None] * offset
        there, plane = on_plane(place, distance, slope, step)
        lit.append(is_lit(distance_map, there, plane, bias))
        stored.append(stored_distance(distance_map, there))
    return np.array(lit).T, np.array(stored).T


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    lit, _ = places(distance_map, place, distance, slope, bias, offsets, radius)
    return [sum(row.tolist()) / len(row) for row in lit]


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    wide = light_radius * clip_from_light[0, 0] * width / 2
    return np.array([wide * (d - b) / (d * b) if b < d else 0.0
                     for d, b in zip(distance, blocker, strict=True)])
