"""Pair kernels: lab 8's antialiasing as loops over pairs of pixels, there and back.

    a thread a band    find_pairs         pairs that see different faces, (1) to (3)
    one thread         blend              (4) and (5), in the pairs' order
                       blend_backward     gradients of edges' ends, and of the pixels of each pair

The numbers are equations of antialiasing.py, and the decisions are those of outlines.py, to the
last bit. Most pairs lie between two faces of one surface. So a face's silhouette comes first, found
when the first of its pairs asks for it. Threads may find one twice, and write the same byte.
"""
import numpy as np

from course.given.compiled import kernel

from .antialiasing import WINDOW
from .rasterization import CAMERA_PLANE

KNOWN = np.uint8(8)  # a face's silhouette has been found: bits 0 to 2 are its edges


@kernel
def is_clockwise(points, a, b, c):
    """`edge_function` of a and the edge from b to c, its roundings too; mirrored where w < 0."""
    x, y, x0, y0, x1, y1 = (points[a, 0], points[a, 1], points[b, 0], points[b, 1],
                            points[c, 0], points[c, 1])
    from_y = y0 if x0 <= x1 else y1
    e = (y0 - y1) * (x - min(x0, x1)) + (x1 - x0) * (y - from_y)
    return e * (np.sign(points[a, 3]) * np.sign(points[b, 3]) * np.sign(points[c, 3])) < 0


@kernel
def silhouette_of(points, corners, across):
    """Eq. (1) for one face: bit k for edge k, and KNOWN."""
    (a, b, c), count = corners, len(points)
    own = is_clockwise(points, a, b, c)
    at_0 = not 0 <= across[0] < count or is_clockwise(points, across[0], b, c) == own
    at_1 = not 0 <= across[1] < count or is_clockwise(points, across[1], c, a) == own
    at_2 = not 0 <= across[2] < count or is_clockwise(points, across[2], a, b) == own
    return np.uint8(at_0 | at_1 << 1 | at_2 << 2 | KNOWN)


@kernel
def crossing(x0, y0, w0, x1, y1, w1):
    """Eq. (3) where the edge crosses y = 0 in front of the camera, else -inf."""
    front0, front1 = np.sign(w0), np.sign(w1)
    if ((front0 * y0 < 0) == (front1 * y1 < 0)
            or not front0 * abs(y1) + front1 * abs(y0) > 0):
        return -np.inf
    is_nearer = abs(y1) < abs(y0)
    x, y = x1 if is_nearer else x0, y1 if is_nearer else y0
    return x - y * (x1 - x0) / (y1 - y0)


@kernel
def in_pair_frame(points, vertex, px, py, dx, dy):
    """Eq. (2): a vertex in the frame of a pair, which begins at px, py and runs along dx, dy."""
    x, y = points[vertex, 0] - px, points[vertex, 1] - py
    return dx * x + dy * y, abs(dy) * x + abs(dx) * y


@kernel
def last_crossing(points, corners, px, py, dx, dy):
    """The edge that the pair's line crosses last -> edge, c, its ends, and x, y of both ends."""
    a, b, c = corners
    w0, w1, w2 = points[a, 3], points[b, 3], points[c, 3]
    x0, y0 = in_pair_frame(points, a, px, py, dx, dy)
    x1, y1 = in_pair_frame(points, b, px, py, dx, dy)
    x2, y2 = in_pair_frame(points, c, px, py, dx, dy)
    at_0 = crossing(x1, y1, w1, x2, y2, w2)
    at_1 = crossing(x2, y2, w2, x0, y0, w0)
    at_2 = crossing(x0, y0, w0, x1, y1, w1)
    found = 0, at_0, b, c, x1, y1, x2, y2
    if at_1 > at_0:
        found = 1, at_1, c, a, x2, y2, x0, y0
    if at_2 > found[1]:
        found = 2, at_2, a, b, x0, y0, x1, y1
    return found


@kernel
def pairs_along(axis, face_index, depth, points, faces, opposite, silhouettes, width, rows,
                numbers, places, found):
    """The pairs along x (axis 0) or y (axis 1), after the first found -> how many there are now."""
    step, columns = (1, max(width - 1, 0)) if axis == 0 else (width, width)
    for row in range(rows[0], min(rows[1], rows[2] - axis)):
        for first in range(np.uintp(row * width), np.uintp(row * width + columns)):
            second = first + np.uintp(step)
            if face_index[first] == face_index[second]:
                continue
            is_first = depth[first] < depth[second]
            owner, other = (first, second) if is_first else (second, first)
            face = face_index[owner]
            corners = faces[face, 0], faces[face, 1], faces[face, 2]
            if silhouettes[face] == 0:
                across = opposite[face, 0], opposite[face, 1], opposite[face, 2]
                silhouettes[face] = silhouette_of(points, corners, across)
            if silhouettes[face] == KNOWN:
                continue
            along = 1.0 if is_first else -1.0
            edge, c, i, j, x_i, y_i, x_j, y_j = last_crossing(
                points, corners, int(owner) % width + 0.5, int(owner) // width + 0.5,
                along * (1 - axis), along * axis)
            is_steep = abs(y_j - y_i) >= abs(x_j - x_i)
            is_dropped = c == 0.5 and is_first
            if (silhouettes[face] >> edge & 1 and is_steep and -WINDOW < c < 1 + WINDOW
                    and not is_dropped):
                numbers[0, found], numbers[1, found], numbers[2, found] = owner, other, i
                numbers[3, found], numbers[4, found], numbers[5, found] = j, face, edge
                places[0, found], places[1, found], places[2, found] = c, x_i, x_j
                places[3, found], places[4, found] = y_i, y_j
                found += 1
    return found


@kernel
def find_pairs(face_index, depth, points, faces, opposite, silhouettes, width, rows,
               numbers, places):
    """The blended pairs of some rows with the next pixel to the right, and then those with the one
    above -> how many there are of the first, and in all.

    rows: the first one, the end, and how many the picture has. numbers (6, N): owner, other, the
    edge's ends, face, edge. places (5, N): c, and x and y of both ends in the pair's frame.
    """
    beside = pairs_along(0, face_index, depth, points, faces, opposite, silhouettes, width, rows,
                         numbers, places, 0)
    return beside, pairs_along(1, face_index, depth, points, faces, opposite, silhouettes, width,
                               rows, numbers, places, beside)


@kernel
def blend(picture, colour, pairs, channels):
    """Eqs. (4) and (5): changes the picture by the colours before the blend. Both are flat, C
    numbers a pixel. channels: a tuple of C numbers, so that C is known when this is compiled.
    """
    count = len(channels)
    for n in range(len(pairs.c)):
        owner, other = pairs.owner[n] * count, pairs.other[n] * count
        alpha = 0.5 - min(max(pairs.c[n], 0.0), 1.0)
        changed = owner if alpha > 0 else other
        for k in range(count):
            picture[changed + k] += alpha * (colour[other + k] - colour[owner + k])


@kernel
def end_backward(grad_along, grad_across, dx, dy, clip, vertex, width, height, grad):
    """Adds the gradient of an edge's end, in the pair's frame, to its x, y, w in grad[vertex]."""
    grad_x = (dx * grad_along + abs(dy) * grad_across) * (width / 2)
    grad_y = (dy * grad_along + abs(dx) * grad_across) * (height / 2)
    x, y, w = clip[vertex, 0], clip[vertex, 1], clip[vertex, 3]
    least = CAMERA_PLANE * max(abs(x), abs(y))
    if abs(w) < least:
        w = -least if w < 0 else least
    grad[vertex, 0] += grad_x / w
    grad[vertex, 1] += grad_y / w
    grad[vertex, 3] -= (grad_x * x / w + grad_y * y / w) / w


@kernel
def blend_backward(grad_picture, colour, pairs, channels, clip, width, height, grad, pixels,
                   grad_pixels):
    """Backward of `blend`: the edges' ends in grad (V, 4 + C), and what their pixels get beside
    grad_picture: pixels (2 N,), grad_pixels flat, C numbers for each -> whether all are there.
    """
    count, size, vertices = len(channels), width * height, len(clip)
    if (min(len(pairs.owner), len(pairs.other), pairs.ends.shape[1], pairs.x.shape[1],
            pairs.y.shape[1]) < len(pairs.c)
            or min(len(pairs.ends), len(pairs.x), len(pairs.y)) < 2):
        return False
    for n in range(len(pairs.c)):
        owner, other, i, j = pairs.owner[n], pairs.other[n], pairs.ends[0, n], pairs.ends[1, n]
        if (min(owner, other) < 0 or max(owner, other) >= size or min(i, j) < 0
                or max(i, j) >= vertices):
            return False
        alpha = 0.5 - min(max(pairs.c[n], 0.0), 1.0)
        changed = owner if alpha >= 0 else other
        pixels[2 * n], pixels[2 * n + 1] = owner, other
        grad_alpha = 0.0
        for k in range(count):
            grad_changed = grad_picture[changed * count + k]
            grad_alpha += grad_changed * (colour[other * count + k] - colour[owner * count + k])
            grad_pixels[2 * n * count + k] = -alpha * grad_changed
            grad_pixels[(2 * n + 1) * count + k] = alpha * grad_changed
        if 0 < pairs.c[n] < 1:
            x0, x1, y0, y1 = pairs.x[0, n], pairs.x[1, n], pairs.y[0, n], pairs.y[1, n]
            r = 1 / (y1 - y0)
            c = (x0 * y1 - x1 * y0) * r
            slope = -grad_alpha * r
            dx, dy = other % width - owner % width, other // width - owner // width
            end_backward(slope * y1, slope * (c - x1), dx, dy, clip, i, width, height, grad)
            end_backward(-slope * y0, slope * (x0 - c), dx, dy, clip, j, width, height, grad)
    return True
