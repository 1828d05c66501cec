"""Lab 2 once more: brute force, sample by sample."""
import numpy as np

from reference.rasterization import EDGES, edge_function, is_top_left, screen_points, signed_area


def cover(p, triangle, z):
    # Sample by sample; either all e are right for the winding, or none is.
    covered, depth = np.zeros(np.shape(p)[:-1], bool), np.zeros(np.shape(p)[:-1])
    turned = np.sign(signed_area(triangle))
    corners = np.column_stack([triangle, np.ones(3)])
    plane = np.linalg.solve(corners, z - z[0]) if turned else np.zeros(3)
    for index in np.ndindex(covered.shape):
        owned = [turned != 0]
        for first, second in EDGES:
            a, b = triangle[first], triangle[second]
            e, n_x, n_y = (turned * number for number in (
                edge_function(p[index], a, b), a[1] - b[1], b[0] - a[0]))
            owned.append(e > 0 or (e == 0 and is_top_left(n_x, n_y)))
        depth[index] = z[0] + np.append(p[index], 1) @ plane
        covered[index] = all(owned) and -1 <= depth[index] <= 1
    return covered, depth


def bounding_box(triangle, width, height):
    # By asking each column and each row.
    def first_and_end(values, size):
        low, high = min(values) - 1 / 256, max(values) + 1 / 256
        inside = [k for k in range(size) if low <= k + 0.5 <= high]
        return (inside[0], inside[-1] + 1) if inside else (0, 0)

    (x0, x1), (y0, y1) = map(first_and_end, np.transpose(triangle), (width, height))
    return x0, y0, x1, y1


def rasterize(clip, faces, width, height):
    # All faces at all pixels, and then the nearest one.
    x, y, w = screen_points(clip, width, height)
    p = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), -1)
    found = [cover(p, np.stack([x, y], -1)[corners], (np.asarray(clip)[:, 2] / w)[corners])
             for corners in np.asarray(faces)]
    deep = np.array([np.where(covered, depth, np.inf) for covered, depth in found])
    nearest = deep.min(0)
    return np.where(np.isfinite(nearest), deep.argmin(0), -1), nearest
