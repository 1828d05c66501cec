"""The soft shadows of lab 14 once more: all places first, then their means."""
import numpy as np

from reference.shadow_mapping import stored_distance
from reference.soft_shadows import on_plane, percentage_closer


def places(distance_map, place, distance, slope, bias, offsets, radius):
    """Of each receiver and offset: is the place lit (N, K), and what is stored there (N, K)?"""
    lit, stored = [], []
    for offset in offsets:
        step = np.broadcast_to(radius, len(place))[:, None] * offset
        there, plane = on_plane(place, distance, slope, step)
        stored.append(stored_distance(distance_map, there))
        lit.append(plane - stored[-1] <= bias)
    return np.array(lit).T, np.array(stored).T


def percentage_closer_soft(distance_map, place, distance, slope, bias, offsets, lamp):
    def radius(blockers):
        return [lamp * (d - b) / (d * b) if b < d else 0.0
                for d, b in zip(distance, blockers, strict=True)]

    given = distance_map, place, distance, slope, bias, offsets
    around = places(*given, radius(np.full(len(place), distance_map.min())))
    blockers = [np.inf if lit.all() else stored[~lit].mean()
                for lit, stored in zip(*around, strict=True)]
    return percentage_closer(*given, radius(blockers))
