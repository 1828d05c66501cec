"""The variance shadows of lab 14 once more: texel by texel, and windows as matrices."""
import numpy as np


def window(size, radius):
    """The matrix (size, size) that sums up neighbours along one axis."""
    return np.array([[float(abs(i - j) <= radius) for j in range(size)] for i in range(size)])


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
        q_x = (2 * j + 1 - width) / width * w / C[0, 0]
        q_y = (2 * i + 1 - height) / height * w / C[1, 1]
        motion[i, j, 0] = np.array([1, 0, -q_x * C[3, 2] / w]) * C[0, 0] * width / 2 / w
        motion[i, j, 1] = np.array([0, 1, -q_y * C[3, 2] / w]) * C[1, 1] * height / 2 / w
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
