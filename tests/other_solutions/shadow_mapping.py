"""Lab 14 once more: point by point, texel by texel."""

import numpy as np

from reference.shadow_mapping import Light, stored_distance

GRAZING = 0.01


def map_position(q, clip_from_light, width, height):
    C = clip_from_light
    clip = np.column_stack([C[0, 0] * q[:, 0], C[1, 1] * q[:, 1], C[3, 2] * q[:, 2] + C[3, 3]])
    return (clip[:, :2] / clip[:, 2:] + 1) * [width / 2, height / 2]


def distance_slopes(normal, q, clip_from_light, width, height):
    C, slopes = clip_from_light, np.empty((len(q), 2))
    for n in range(len(q)):
        w = C[3, 2] * q[n, 2] + C[3, 3]
        ray = np.array([-C[3, 2] * q[n, 0] / w, -C[3, 2] * q[n, 1] / w, -1])
        facing = ray @ normal[n]
        if abs(facing) < GRAZING:
            facing = -GRAZING if facing < 0 else GRAZING
        for axis, size in enumerate((width, height)):
            slopes[n, axis] = -2 * w / (C[axis, axis] * size) * normal[n, axis] / facing
    return slopes


def hard_shadow(points, normals, light, distance_map, constant, factor=1.0, most=np.inf):
    (position, rotation, C), size, lit = Light(*light), len(distance_map), []
    for point, normal in zip(points, normals, strict=True):
        q = rotation @ (point - position)
        (slope_x, slope_y), = distance_slopes((rotation @ normal)[None], q[None], C, size, size)
        bias = min(constant + factor * (abs(slope_x) + abs(slope_y)) / 2, most)
        stored, = stored_distance(distance_map, map_position(q[None], C, size, size))
        lit.append(-q[2] - stored <= bias)
    return lit
