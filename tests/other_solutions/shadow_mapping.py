"""Lab 14 once more: point by point."""
import numpy as np

from reference.shadow_mapping import Light, distance_slopes, map_position, stored_distance


def hard_shadow(points, normals, light, distance_map, constant, factor=1.0, most=np.inf):
    (position, rotation, C), size, lit = Light(*light), len(distance_map), []
    for point, normal in zip(points, normals, strict=True):
        q = rotation @ (point - position)
        (slope_x, slope_y), = distance_slopes((rotation @ normal)[None], q[None], C, size, size)
        bias = min(constant + factor * (abs(slope_x) + abs(slope_y)) / 2, most)
        stored, = stored_distance(distance_map, map_position(q[None], C, size, size))
        lit.append(-q[2] - stored <= bias)
    return lit
