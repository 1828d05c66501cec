"""Lab 14 once more: point by point, texel by texel."""

import numpy as np

from reference.shadow_mapping import stored_distance

GRAZING = 0.01


def to_light(points, position, rotation):
    return np.einsum("ij,nj->ni", rotation, points) - rotation @ position


def to_light_backward(grad_q, points, position, rotation):
    grad_points = np.einsum("ij,ni->nj", rotation, grad_q)
    return grad_points, -np.ones(len(grad_q)) @ grad_points


def map_position(q, clip_from_light, width, height):
    C = clip_from_light
    clip = np.column_stack([C[0, 0] * q[:, 0], C[1, 1] * q[:, 1], C[3, 2] * q[:, 2] + C[3, 3]])
    return (clip[:, :2] / clip[:, 2:] + 1) * [width / 2, height / 2]


def map_position_backward(grad_place, q, clip_from_light, width, height):
    C, grad_q = clip_from_light, np.empty(np.shape(q))
    for n, (q_x, q_y, q_z) in enumerate(q):
        w = C[3, 2] * q_z + C[3, 3]
        by_x, by_y = C[0, 0] * width / (2 * w), C[1, 1] * height / (2 * w)
        by_w = -grad_place[n][0] * by_x * q_x / w - grad_place[n][1] * by_y * q_y / w
        grad_q[n] = grad_place[n][0] * by_x, grad_place[n][1] * by_y, by_w * C[3, 2]
    return grad_q


def distance_of_depth(depth, clip_from_light):
    # A point and its depth are in proportion: of (z, w) up to a factor, undo C's lower right part.
    distance = np.full(np.shape(depth), np.inf)
    inverse = np.linalg.inv(np.asarray(clip_from_light)[2:, 2:])
    for at in np.argwhere(np.isfinite(depth)):
        q_z, one = inverse @ [depth[tuple(at)], 1]
        distance[tuple(at)] = -q_z / one
    return distance


def is_lit(distance_map, place, distance, bias):
    return ~(np.asarray(distance) > stored_distance(distance_map, place) + bias)


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


def slope_scaled_bias(slope, constant, factor, most):
    return np.array([min(most, constant + factor / 2 * (abs(a) + abs(b))) for a, b in slope])
