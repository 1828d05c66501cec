"""Lab 10's maps once more: point by point, with cyclic sums for cross products."""
import numpy as np

from reference.neural_renderer import covers, front_faces, on_screen, pixel_box


def face_inverse(screen):
    columns = np.concatenate([screen, np.ones_like(screen[..., :1])], -1)
    return np.linalg.solve(np.swapaxes(columns, -1, -2), np.eye(3))


def screen_weights_and_depth(inverse, z, x, y):
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    u = np.minimum(np.maximum(c, 0), 1)
    # 1 / sum(w / z) with w = u / sum(u).
    return u / u.sum(-1)[..., None], u.sum(-1) / (u / z).sum(-1)


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


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    face_index, weight = np.full((height, width), -1), np.zeros((height, width, 3))
    depth = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        x0, y0, x1, y1 = (int(end) for end in pixel_box(screen[f], width, height))
        if x0 >= x1 or y0 >= y1:
            continue
        x, y = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
        w, d = screen_weights_and_depth(face_inverse(screen[f]), z[f], x, y)
        box = np.s_[y0:y1, x0:x1]
        seen = covers(screen[f], x, y) & (near < d) & (d < far) & (d < depth[box])
        face_index[box][seen], weight[box][seen], depth[box][seen] = f, w[seen], d[seen]
    return face_index, weight, depth
