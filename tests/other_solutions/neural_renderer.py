"""Lab 10's maps once more: point by point, with cyclic sums for cross products."""
import numpy as np

from reference import neural_renderer as lab


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
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


def rasterize(corners, width, height, near=0.1, far=100.0):
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen, z = lab.on_screen(corners, width, height), corners[..., 2]
    kept = np.flatnonzero(lab.front_faces(screen, z))
    inverse = lab.face_inverse(screen[kept])
    for i, j in np.ndindex(height, width):
        x, y = np.full((2, len(kept)), [[j + 0.5], [i + 0.5]])
        w, d = lab.screen_weights_and_depth(inverse, z[kept], x, y)
        d = np.where(lab.covers(screen[kept], x, y) & (d > near) & (d < far), d, np.inf)
        if len(kept) and np.isfinite(d).any():
            n = d.argmin()
            face_index[i, j], weight[i, j], depth[i, j] = kept[n], w[n], d[n]
    return face_index, weight, depth
