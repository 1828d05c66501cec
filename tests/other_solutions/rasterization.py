"""Lab 2 once more: brute force, complex numbers, and linear systems for areas."""
import numpy as np

from reference.rasterization import EDGES, MARGIN, screen_points, signed_area


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


def is_inside(p, triangle):
    # As complex numbers: the imaginary part of conj(b - a) (p - a) is the cross product.
    corners = [complex(*corner) for corner in triangle]
    points = p[..., 0] + 1j * p[..., 1]
    crosses = np.array([((end - start).conjugate() * (points - start)).imag
                        for start, end in zip(corners, corners[1:] + corners[:1], strict=True)])
    return (crosses.min(0) >= 0) | (crosses.max(0) <= 0)


def is_top_left(n_x, n_y):
    return np.where(np.equal(n_x, 0), np.greater(n_y, 0), np.greater(n_x, 0))


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


def bounding_box(triangle, width, height):
    def inside(low, high, size):
        found = [k for k in range(size) if low - MARGIN <= k + 0.5 <= high + MARGIN]
        return (found[0], found[-1] + 1) if found else (size, 0)

    (x0, x1), (y0, y1) = (inside(min(column), max(column), size)
                          for column, size in zip(np.transpose(triangle), (width, height),
                                                  strict=True))
    return x0, y0, x1, y1


def cull_back_faces(x, y, w, faces):
    kept = []
    for face in faces:
        behind = sum(w[k] < 0 for k in face)
        area = signed_area(np.array([[x[k], y[k]] for k in face]))
        if (area > 0 and behind % 2 == 0) or (area < 0 and behind % 2 == 1):
            kept.append(face)
    return np.array(kept, int).reshape(-1, 3)


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


def barycentric_on_face(px, py, x, y, w):
    return system(px, py, x, y, w)[:, :, 2].T


def normalize_derivative(dc, b, s, axis=0):
    # A matrix for each sample: db = (1 - b 1^T) dc / s.
    dc, b = np.moveaxis(dc, axis, -1), np.moveaxis(b, axis, -1)
    change = np.einsum("...ij,...j->...i", np.eye(3) - b[..., None], dc)
    return np.moveaxis(change, -1, axis) / s


def system(px, py, x, y, w):
    """sum b_k w_k (x_k - px) = 0, the same in y, and sum b_k = 1: the inverses (N, 3, 3)."""
    return np.linalg.inv(np.moveaxis([w * (x - px), w * (y - py), np.ones_like(w)], -1, 0))
