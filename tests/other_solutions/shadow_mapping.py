"""Lab 14 once more: point by point, texel by texel, and windows as matrices."""
import math

import numpy as np

GRAZING = 0.01


def to_light(points, position, rotation):
    return np.einsum("ij,nj->ni", rotation, points) - rotation @ position


def to_light_backward(grad_q, points, position, rotation):
    grad_points = np.einsum("ij,ni->nj", rotation, grad_q)
    return grad_points, -np.ones(len(grad_q)) @ grad_points


def map_position(q, clip_from_light, width, height):
    C = clip_from_light
    clip = np.column_stack([C[0, 0] * q[:, 0], C[1, 1] * q[:, 1], C[3, 2] * q[:, 2] + C[3, 3]])
    return [(clip[:, k] / clip[:, 2] + 1) * size / 2 for k, size in enumerate((width, height))]


def map_position_backward(grad_x, grad_y, q, clip_from_light, width, height):
    C, grad_q = clip_from_light, np.empty(np.shape(q))
    for n, (q_x, q_y, q_z) in enumerate(q):
        w = C[3, 2] * q_z + C[3, 3]
        by_x, by_y = C[0, 0] * width / (2 * w), C[1, 1] * height / (2 * w)
        by_w = -grad_x[n] * by_x * q_x / w - grad_y[n] * by_y * q_y / w
        grad_q[n] = grad_x[n] * by_x, grad_y[n] * by_y, by_w * C[3, 2]
    return grad_q


def distance_of_depth(depth, clip_from_light):
    # A point and its depth are in proportion: of (z, w) up to a factor, undo C's lower right part.
    distance = np.full(np.shape(depth), np.inf)
    inverse = np.linalg.inv(np.asarray(clip_from_light)[2:, 2:])
    for at in np.argwhere(np.isfinite(depth)):
        q_z, one = inverse @ [depth[tuple(at)], 1]
        distance[tuple(at)] = -q_z / one
    return distance


def stored_distance(distance_map, x, y):
    height, width = distance_map.shape
    return np.array([distance_map[int(v), int(u)] if 0 <= u < width and 0 <= v < height
                     else math.inf for u, v in zip(x, y, strict=True)], float)


def is_lit(distance_map, x, y, distance, bias):
    return ~(np.asarray(distance) > stored_distance(distance_map, x, y) + bias)


def distance_slopes(normal, q, clip_from_light, width, height):
    C, slopes = clip_from_light, np.empty((2, len(q)))
    for n in range(len(q)):
        w = C[3, 2] * q[n, 2] + C[3, 3]
        ray = np.array([-C[3, 2] * q[n, 0] / w, -C[3, 2] * q[n, 1] / w, -1])
        facing = ray @ normal[n]
        if abs(facing) < GRAZING:
            facing = -GRAZING if facing < 0 else GRAZING
        for axis, size in enumerate((width, height)):
            slopes[axis, n] = -2 * w / (C[axis, axis] * size) * normal[n, axis] / facing
    return slopes[0], slopes[1]


def slope_scaled_bias(slope_x, slope_y, constant, factor, most):
    return np.array([min(most, constant + factor / 2 * (abs(a) + abs(b)))
                     for a, b in zip(slope_x, slope_y, strict=True)])


def on_plane(x, y, distance, slope_x, slope_y, dx, dy):
    x_there, y_there = np.add(x, dx), np.add(y, dy)
    ahead = [np.trunc(place) + 0.5 + np.where(place < np.trunc(place), -1, 0)
             for place in (x_there, y_there)]
    return x_there, y_there, distance + (ahead[0] - x) * slope_x + (ahead[1] - y) * slope_y


def places(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    """Of each receiver and offset: is the place lit (N, K), and what is stored there (N, K)?"""
    lit, stored = [], []
    for offset in offsets:
        dx, dy = radius * offset[0] + 0 * x, radius * offset[1] + 0 * y
        place = on_plane(x, y, distance, slope_x, slope_y, dx, dy)
        lit.append(is_lit(distance_map, *place, bias))
        stored.append(stored_distance(distance_map, *place[:2]))
    return np.array(lit).T, np.array(stored).T


def percentage_closer(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    lit, _ = places(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius)
    return [sum(row.tolist()) / len(row) for row in lit]


def blocker_distance(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    lit, stored = places(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius)
    return np.array([at[~free].mean() if not free.all() else math.inf
                     for free, at in zip(lit, stored, strict=True)])


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    wide = light_radius * clip_from_light[0, 0] * width / 2
    return np.array([wide * (d - b) / (d * b) if b < d else 0.0
                     for d, b in zip(distance, blocker, strict=True)])


def window(size, radius):
    """The matrix (size, size) that sums up neighbours along one axis."""
    return np.array([[float(abs(i - j) <= radius) for j in range(size)] for i in range(size)])


def window_sums(picture, radius):
    height, width, _ = picture.shape
    return np.einsum("ik,klc,lj->ijc", window(height, radius), picture, window(width, radius),
                     optimize=True)


def box_blur(picture, radius):
    blurred = np.empty(np.shape(picture))
    for i, j in np.ndindex(blurred.shape[:2]):
        blurred[i, j] = picture[max(i - radius, 0):i + radius + 1,
                                max(j - radius, 0):j + radius + 1].mean((0, 1))
    return blurred


def box_blur_backward(grad_output, radius):
    rows, columns = (window(size, radius) for size in grad_output.shape[:2])
    rows, columns = (matrix / matrix.sum(1)[:, None] for matrix in (rows, columns))
    return np.einsum("ki,klc,lj->ijc", rows, grad_output, columns, optimize=True)


def chebyshev(distance, mean, mean_square, least_variance):
    found = []
    for d, m, s in zip(distance, mean, mean_square, strict=True):
        variance = max(s - m * m, least_variance)
        found.append(1.0 if d <= m else 1 / (1 + (d - m) ** 2 / variance))
    return found


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    grads = np.zeros((3, len(grad_lit)))
    for n, g in enumerate(grad_lit):
        beyond, variance = distance[n] - mean[n], mean_square[n] - mean[n]**2
        if beyond <= 0:
            continue
        free = variance > least_variance
        variance = max(variance, least_variance)
        lit = 1 / (1 + beyond**2 / variance)
        by_distance = -2 * lit**2 * beyond / variance
        by_variance = lit**2 * (beyond / variance)**2 if free else 0.0
        grads[:, n] = (g * by_distance, g * (-by_distance - 2 * mean[n] * by_variance),
                       g * by_variance)
    return tuple(grads)


def map_motion(distance_map, clip_from_light):
    C, (height, width) = clip_from_light, distance_map.shape
    motion = np.zeros((height, width, 2, 3))
    for i, j in np.ndindex(height, width):
        w = C[3, 3] - C[3, 2] * distance_map[i, j]
        q = np.array([[(2 * j + 1 - width) / width * w / C[0, 0],
                       (2 * i + 1 - height) / height * w / C[1, 1], -distance_map[i, j]]])
        for k, (by_x, by_y) in enumerate(np.eye(2)):
            motion[i, j, k] = map_position_backward([by_x], [by_y], q, C, width, height)[0]
    return motion


def borders(distance_map, motion):
    """Yield of each pair a, b of neighbours with a step: a, b, and how s grows with the move."""
    height, width = distance_map.shape
    for i, j in np.ndindex(height, width):
        for axis, b in enumerate(((i, j + 1), (i + 1, j))):
            if b[0] < height and b[1] < width and distance_map[i, j] != distance_map[b]:
                front = (i, j) if distance_map[i, j] < distance_map[b] else b
                yield (i, j), b, motion[front][axis]


def moved_moments(distance_map, motion, move):
    before = np.stack([distance_map, distance_map**2], -1)
    after = np.stack([distance_map - move[2], (distance_map - move[2])**2], -1)
    for a, b, slope in borders(distance_map, motion):
        change = slope @ move / 2 * (before[b] - before[a])
        after[a] -= change
        after[b] -= change
    return after


def moved_moments_backward(grad_moments, distance_map, motion, move):
    grad_move = np.zeros(3)
    grad_move[2] = -np.sum(grad_moments[..., 0]
                           + 2 * grad_moments[..., 1] * (distance_map - move[2]))
    for a, b, slope in borders(distance_map, motion):
        step = [distance_map[b] - distance_map[a], distance_map[b]**2 - distance_map[a]**2]
        grad_move -= (grad_moments[a] + grad_moments[b]) @ step / 2 * slope
    return grad_move
