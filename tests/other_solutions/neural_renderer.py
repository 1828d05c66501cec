"""Lab 10 once more: point by point, with cyclic sums for cross products."""
import itertools
import math

import numpy as np

from reference.neural_renderer import covers, on_screen, pixel_box


def front_faces(screen, z):
    x, y = screen[..., 0], screen[..., 1]
    twice = sum(x[:, k - 1] * y[:, k] - x[:, k] * y[:, k - 1] for k in range(3))
    return [bool(area > 0 and min(depths) > 0) for area, depths in zip(twice, z, strict=True)]


def face_inverse(screen):
    columns = np.concatenate([screen, np.ones_like(screen[..., :1])], -1)
    return np.linalg.solve(np.swapaxes(columns, -1, -2), np.eye(3))


def weights_and_depth(inverse, z, x, y):
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    u = np.minimum(np.maximum(c, 0), 1)
    # 1 / sum(w / z) with w = u / sum(u).
    return u / u.sum(-1)[..., None], u.sum(-1) / (u / z).sum(-1)


def weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    grad_inverse, grad_z = np.zeros(np.shape(inverse)), np.zeros(np.shape(z))
    for at in np.ndindex(np.shape(x)):
        point = np.array([x[at], y[at], 1])
        c = inverse[at] @ point
        u, free = np.clip(c, 0, 1), (c >= 0) & (c <= 1)
        total, over = sum(u), sum(u / z[at])
        by_weight = (np.eye(3) - u[:, None] / total) / total         # dw_i / du_j
        by_depth = 1 / over - total / over**2 / z[at]                 # d depth / du_j
        grad_u = grad_weight[at] @ by_weight + grad_depth[at] * by_depth
        grad_inverse[at] = np.outer(grad_u * free, point)
        grad_z[at] = grad_depth[at] * total / over**2 * u / z[at]**2
    return grad_inverse, grad_z


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    face_index, weight = np.full((height, width), -1), np.zeros((height, width, 3))
    depth = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        x0, y0, x1, y1 = (int(end) for end in pixel_box(screen[f], width, height))
        if x0 >= x1 or y0 >= y1:
            continue
        x, y = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
        w, d = weights_and_depth(face_inverse(screen[f]), z[f], x, y)
        box = np.s_[y0:y1, x0:x1]
        seen = covers(screen[f], x, y) & (near < d) & (d < far) & (d < depth[box])
        face_index[box][seen], weight[box][seen], depth[box][seen] = f, w[seen], d[seen]
    return face_index, weight, depth


def places(weight, depth, z, size):
    """low (N, 3) and how far above it (N, 3)."""
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.trunc(t), size - 2)
    return low.astype(int), t - low


def cube_taps(weight, depth, z, size):
    low, above = places(weight, depth, z, size)
    index, tap = np.empty((len(depth), 8), int), np.empty((len(depth), 8))
    for n in range(8):
        up = np.array([n & 1, n >> 1 & 1, n >> 2])
        index[:, n] = (low + up) @ [size * size, size, 1]
        tap[:, n] = np.where(up, above, 1 - above).prod(1)
    return index, tap


def cube_taps_backward(grad_tap, weight, depth, z, size):
    _, above = places(weight, depth, z, size)
    grad_t = np.zeros(np.shape(weight))
    for m, (c, b, a) in enumerate(itertools.product((0, 1), repeat=3)):
        parts = np.where([a, b, c], above, 1 - above)
        for k, up in enumerate((a, b, c)):
            others = parts[:, k - 1] * parts[:, k - 2]
            grad_t[:, k] += (2 * up - 1) * grad_tap[:, m] * others
    grad = (size - 1) * grad_t / z  # by weight times depth
    return grad * depth[:, None], (grad * weight).sum(1), -grad * weight * depth[:, None] / z


def sample_cubes(textures, face, index, tap):
    size = textures.shape[1]
    i, j, k = np.unravel_index(index, (size, size, size))
    return np.einsum("nt,ntc->nc", tap, textures[np.reshape(face, (-1, 1)), i, j, k])


def sample_cubes_backward(grad_colour, textures, face, index, tap):
    cubes = textures.reshape(len(textures), -1, textures.shape[-1])
    grad_textures, grad_tap = np.zeros(cubes.shape), np.zeros(np.shape(tap))
    for n, f in enumerate(face):
        for m, texel in enumerate(index[n]):
            grad_textures[f, texel] += tap[n, m] * grad_colour[n]
            grad_tap[n, m] = cubes[f, texel] @ grad_colour[n]
    return grad_textures.reshape(textures.shape), grad_tap


def normal_of(face):
    a, b, c = face
    across = np.cross(a - c, b - c)
    length = math.hypot(*across)
    return (across / length, length) if length > 0 else (across, 1.0)


def face_light(corners, ambient, directional, towards):
    return np.array([ambient + np.multiply(directional, max(0.0, normal_of(face)[0] @ towards))
                     for face in corners]).reshape(len(corners), len(ambient))


def face_light_backward(grad_light, corners, ambient, directional, towards):
    grad_corners, grad_towards = np.zeros(np.shape(corners)), np.zeros(3)
    grad_ambient, grad_directional = np.zeros(len(ambient)), np.zeros(len(ambient))
    for f, face in enumerate(corners):
        grad_ambient += grad_light[f]
        normal, length = normal_of(face)
        cosine = normal @ towards
        if cosine <= 0:
            continue
        grad_directional += grad_light[f] * cosine
        grad_cosine = grad_light[f] @ directional
        grad_towards += grad_cosine * normal
        # n = N / |N|, and N = a x b + b x c + c x a.
        grad_across = grad_cosine * (towards - cosine * normal) / length
        for k in range(3):
            grad_corners[f, k] = np.cross(face[(k + 1) % 3] - face[(k + 2) % 3], grad_across)
    return grad_corners, grad_ambient, grad_directional, grad_towards


def edge_lines(a, b, height):
    rows, crossings, shares = [], [], []
    for row in range(height):
        below, above = sorted((a[1], b[1]))
        if below <= row + 0.5 <= above and below < above:
            share = np.array([b[1] - (row + 0.5), (row + 0.5) - a[1]]) / (b[1] - a[1])
            rows.append(row)
            crossings.append(share[0] * a[0] + share[1] * b[0])
            shares.append(share)
    return np.array(rows, int), np.array(crossings, float), np.reshape(shares, (-1, 2))


def sweep_line(grad_colour, colour, sees, crossing, side, share, eps=1e-4):
    width, grad = len(colour), np.zeros(2)
    reached = [j for j in range(width) if side * (j + 0.5 - crossing) <= 0]
    beyond = [j for j in range(width) if j not in reached]
    if not reached or not beyond:
        return grad
    inner, outer = (max(reached), min(beyond)) if side > 0 else (min(reached), max(beyond))
    ways = [(side, beyond if sees[inner] else [], colour[inner]),
            (-side, [j for j in reached if sees[j]], colour[outer])]
    for sign, pixels, other in ways:
        for j in pixels:
            gain = max(0.0, float((colour[j] - other) @ grad_colour[j]))
            for end in range(2):
                if share[end]:
                    distance = 2 / width * (j + 0.5 - crossing) / share[end]
                    grad[end] -= gain / (distance + sign * eps) if gain else 0.0
    return grad
