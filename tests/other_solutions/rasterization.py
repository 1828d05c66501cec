"""Lab 2 once more: brute force, complex numbers, and linear systems for areas."""
import numpy as np

from reference.rasterization import EDGES, is_top_left, screen_points, signed_area


def edge_function(p, a, b):
    # From the higher end; of equally high ones, from the right one.
    p, a, b = np.broadcast_arrays(p, a, b)
    e = np.empty(p.shape[:-1])
    for index in np.ndindex(e.shape):
        x, y = max(a[index].tolist(), b[index].tolist(), key=lambda end: (end[1], end[0]))
        n_x, n_y = a[index][1] - b[index][1], b[index][0] - a[index][0]
        e[index] = n_x * (p[index][0] - x) + n_y * (p[index][1] - y)
    return e[()]


def edge_function_backward(grad_e, p, a, b):
    # The determinant stays the same when p, a, b are rotated: one rule for all three.
    def slope(after, before):
        return np.stack([grad_e * (after[..., 1] - before[..., 1]),
                         grad_e * (before[..., 0] - after[..., 0])], -1)

    return [slope(a, b), slope(b, p), slope(p, a)]


def is_covered(p, triangle):
    covered = np.zeros(np.shape(p)[:-1], bool)
    for index in np.ndindex(covered.shape):
        owned = []
        for first, second in EDGES:
            a, b = triangle[first], triangle[second]
            e = edge_function(p[index], a, b)
            owned.append(e > 0 or (e == 0 and is_top_left(a[1] - b[1], b[0] - a[0])))
        covered[index] = all(owned)
    return covered


def screen_weights(p, triangle):
    system = np.vstack([np.transpose(triangle), np.ones(3)])
    right = np.concatenate([p, np.ones((*np.shape(p)[:-1], 1))], -1)
    return np.linalg.solve(system, right[..., None])[..., 0]


def rasterize_loop(clip, faces, width, height):
    # Face by face, but all pixels at once.
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    p = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), -1)
    for f, corners in enumerate(np.asarray(faces)):
        triangle = np.stack([x, y], -1)[corners]
        if signed_area(triangle) == 0:
            continue
        covered = is_covered(p, triangle) | is_covered(p, triangle[::-1])
        z = np.asarray(clip)[corners, 2] / w[corners]
        deep = z[0] + screen_weights(p, triangle) @ (z - z[0])
        nearer = covered & (np.abs(deep) <= 1) & (deep < depth)
        face_index[nearer], depth[nearer] = f, deep[nearer]
    return face_index, depth


def system(px, py, x, y, w):
    """sum b_k w_k (x_k - px) = 0, the same in y, and sum b_k = 1: the inverses (N, 3, 3)."""
    return np.linalg.inv(np.moveaxis([w * (x - px), w * (y - py), np.ones_like(w)], -1, 0))
