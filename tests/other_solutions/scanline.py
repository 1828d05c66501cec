"""Lab 2's fast rasterizer once more: one face at a time, and bisection."""
import bisect

import numpy as np

from reference.rasterization import EDGES, is_top_left


def half_planes(x, y, w):
    planes = np.zeros((4, 3, np.shape(x)[1]))
    for f in range(np.shape(x)[1]):
        area = ((x[1, f] - x[0, f]) * (y[2, f] - y[0, f])
                - (x[2, f] - x[0, f]) * (y[1, f] - y[0, f]))
        for k, (a, b) in enumerate(EDGES):
            turned = np.sign(area) * np.sign(w[k, f])
            end = min(a, b, key=lambda j: (-abs(w[j, f]), x[j, f], y[j, f]))
            planes[:, k, f] = (turned * (y[a, f] - y[b, f]), turned * (x[b, f] - x[a, f]),
                               x[end, f], y[end, f])
    return tuple(planes)


def depth_slopes(x, y, z):
    # The normal of the plane through three points in space.
    corners = np.stack([x, y, z], -1)
    with np.errstate(all="ignore"):
        n_x, n_y, n_z = np.cross(corners[1] - corners[0], corners[2] - corners[0]).T
        return -n_x / n_z, -n_y / n_z


def first_column(slope, from_x, offset):
    # The place where the sum is 0, at most a column off: of three columns the first one inside.
    columns = []
    for m, x, c in zip(slope, from_x, offset, strict=True):
        near = [np.ceil(x - c / m - 0.5) + step for step in (-1, 0, 1)]
        columns.append(next((j for j in near if m * (j + 0.5 - x) + c >= 0), near[-1]))
    return np.array(columns, float)


def row_interval(planes, face, y, left, right):
    intervals = np.empty((2, len(face)))
    for r, f in enumerate(face):
        columns = range(int(left[f]), int(right[f]))
        opening, closing = [left[f]], [right[f]]
        for n_x, n_y, from_x, from_y in zip(*(part[:, f] for part in planes), strict=True):
            opens = is_top_left(n_x, n_y)
            sign = 1 if opens else -1
            offset = n_y * (y[r] - from_y)
            (opening if opens else closing).append(left[f] + bisect.bisect_left(
                columns, True, key=lambda j: sign * (n_x * (j + 0.5 - from_x) + offset) >= 0))
        intervals[:, r] = max(opening), min(closing)
    return tuple(intervals)
