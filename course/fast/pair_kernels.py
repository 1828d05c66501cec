"""Pair kernels: lab 8's antialiasing as loops over pairs of pixels, there and back.

    a thread a band    find_pairs         the walks of pairs that see different faces, (1) to (3)
    one thread         blend              (4) and (5), in the pairs' order
                       blend_backward     gradients of edges' ends, and of the pixels of each pair

The numbers are equations of antialiasing.py, and the decisions are those of outline_walk.py, to the
last bit. The loops of a walk stand within that over the pairs: to call a kernel with a loop takes
as long as a step, since numba counts the owners of each array that it is given.
"""
from collections import namedtuple

import numpy as np

from course.given.compiled import kernel

from .outlines import WINDOW
from .rasterization import CAMERA_PLANE

# A flat picture (H W,): the face that each pixel sees, and its depth; and its sides.
Screen = namedtuple("Screen", "face_index depth width height")

# points (V, 4) on screen, faces, opposite (F, 3).
Surface = namedtuple("Surface", "points faces opposite")

# What is walked on, how many steps a walk may take, and how far: to c = most. outlined (F or 0,):
# 2 for a face that has an edge on an outline, 1 for others, 0 before that is asked.
Search = namedtuple("Search", "face_index width surface steps most outlined")

# A vertex: x, y and w on screen, or x and y in the frame of a pair.
Point = namedtuple("Point", "x y w")

# Where a pair of pixels begins, and in which direction it runs: 1 or -1 along one axis.
Frame = namedtuple("Frame", "x y dx dy")

# The edge by which a pair's line leaves a face, at c.
Crossing = namedtuple("Crossing", "face edge c")

# From a pair's owner to its other pixel, and the picture's sides.
Step = namedtuple("Step", "dx dy width height")

# Of a picture; and the epsilon of `crossing_backward`.
Sides = namedtuple("Sides", "width height epsilon")


@kernel
def point(points, v):
    """Where a vertex is on screen."""
    return Point(points[v, 0], points[v, 1], points[v, 3])


@kernel
def is_clockwise(a, b, c):
    """Is the triangle clockwise, seen from the camera? w < 0 mirrors a corner."""
    area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)
    if a.w > 0 and b.w > 0 and c.w > 0:
        return area < 0
    return area * (np.sign(a.w) * np.sign(b.w) * np.sign(c.w)) < 0


@kernel
def is_silhouette(points, faces, opposite, at):
    """Eq. (1) at a Crossing."""
    across = opposite[at.face, at.edge]
    if not 0 <= across < faces.size:
        return True
    own = is_clockwise(point(points, faces[at.face, 0]), point(points, faces[at.face, 1]),
                       point(points, faces[at.face, 2]))
    return own == is_clockwise(point(points, faces[across // 3, across % 3]),
                               point(points, faces[at.face, (at.edge + 1) % 3]),
                               point(points, faces[at.face, (at.edge + 2) % 3]))


@kernel
def may_own(search, face):
    """May a face own a blended pair? Where nothing walks, it has an edge on an outline."""
    (points, faces, opposite), known = search.surface, search.outlined
    if len(known) and known[face] == 0:
        for edge in range(3):
            fold = is_silhouette(points, faces, opposite, Crossing(face, edge, 0.0))
            known[face] = max(known[face], 1 + fold)
    return not len(known) or known[face] == 2


@kernel
def is_below(p):
    """Is a corner below y = 0? w < 0 mirrors it."""
    return p.y < 0 if p.w > 0 else p.y > 0


@kernel
def is_in_front(p, q):
    """Does an edge that crosses y = 0 do so in front of the camera?"""
    return (p.w > 0 and q.w > 0) or np.sign(p.w) * abs(q.y) + np.sign(q.w) * abs(p.y) > 0


@kernel
def crossing(p, q):
    """Eq. (3)."""
    is_nearer = abs(q.y) < abs(p.y)
    x, y = q.x if is_nearer else p.x, q.y if is_nearer else p.y
    return x - y * (q.x - p.x) / (q.y - p.y)


@kernel
def crossed(p, q):
    """Eq. (3) where the edge crosses y = 0 in front of the camera, else -inf."""
    return crossing(p, q) if is_below(p) != is_below(q) and is_in_front(p, q) else -np.inf


@kernel
def in_frame(a, frame):
    """Eq. (2): a corner in the frame of a pair."""
    x, y = a.x - frame.x, a.y - frame.y
    return Point(frame.dx * x + frame.dy * y, abs(frame.dy) * x + abs(frame.dx) * y, a.w)


@kernel
def corner_in_frame(points, faces, face, corner, frame):
    """Eq. (2) for a corner of a face."""
    return in_frame(point(points, faces[face, corner]), frame)


@kernel
def leave(points, faces, face, frame):
    """The Crossing by which the pair's line leaves a face: the last of its three."""
    a = corner_in_frame(points, faces, face, 0, frame)
    b = corner_in_frame(points, faces, face, 1, frame)
    c = corner_in_frame(points, faces, face, 2, frame)
    edge, last, at_1, at_2 = 0, crossed(b, c), crossed(c, a), crossed(a, b)
    if at_1 > last:
        edge, last = 1, at_1
    if at_2 > last:
        edge, last = 2, at_2
    return Crossing(face, edge, last)


@kernel
def enter(points, faces, corner, frame):
    """The Crossing by which the line leaves a face that it enters across from a corner."""
    face, k = corner // 3, corner % 3
    i, j = (k + 1) % 3, (k + 2) % 3
    a = corner_in_frame(points, faces, face, k, frame)
    b = corner_in_frame(points, faces, face, i, frame)
    if is_below(a) == is_below(b):
        c = corner_in_frame(points, faces, face, j, frame)
        return Crossing(face, i, crossing(c, a) if is_in_front(c, a) else np.inf)
    return Crossing(face, j, crossing(a, b) if is_in_front(a, b) else np.inf)


@kernel
def frame_of(owner, other, width):
    """The Frame of a pair, from its owner on."""
    row, column = owner // width, owner % width
    if abs(other - owner) == 1 and width > 1:
        return Frame(column + 0.5, row + 0.5, float(other - owner), 0.0)
    return Frame(column + 0.5, row + 0.5, 0.0, 1.0 if other > owner else -1.0)


@kernel
def neighbours(axis, search, screen, rows, pairs, n):
    """The pairs along x (axis 0) or y (axis 1) that see different faces and may be blended, after
    the first n -> how many there are now.
    """
    face_index, depth, width, height = screen
    owner, other = pairs.owner, pairs.other
    step, columns = (1, max(width - 1, 0)) if axis == 0 else (width, width)
    for row in range(rows[0], min(rows[1], height - axis)):
        for column in range(columns):
            first = np.uintp(row * width + column)
            second = first + np.uintp(step)
            if face_index[first] != face_index[second]:
                is_first = depth[first] < depth[second]
                owner[n] = first if is_first else second
                other[n] = second if is_first else first
                n += may_own(search, np.intp(face_index[owner[n]]))
    return n


@kernel
def keep_outlines(search, pairs, begin, end, through, met):
    """Of the pairs begin <= n < end, those that are blended are written from begin on. owner, other
    and face of second walks that pass the other's centre are written to through, from met on
    -> the ends of both.
    """
    points, faces, opposite = search.surface
    face_index, width, kept = search.face_index, search.width, begin
    for n in range(begin, end):
        owner, other, is_back = pairs.owner[n], pairs.other[n], False
        frame = frame_of(owner, other, width)
        at = leave(points, faces, np.intp(face_index[owner]), frame)
        for _ in range(search.steps):
            if -np.inf < at.c <= search.most and is_silhouette(points, faces, opposite, at):
                kept += put(pairs, kept, owner, other, at, search, frame)
                break
            if -np.inf < at.c < 1 and opposite[at.face, at.edge] // 3 != face_index[other]:
                at = enter(points, faces, opposite[at.face, at.edge], frame)
            elif at.c < 1 or is_back or face_index[other] < 0:
                met += is_back and put_through(through, met, owner, other, at)
                break
            else:
                owner, other, is_back = other, owner, True
                frame = frame_of(owner, other, width)
                at = leave(points, faces, np.intp(face_index[owner]), frame)
    return kept, met


@kernel
def last_fold(search, goal, first, frame):
    """`outline_walk.last_folds` for one pair, of which the Crossing at the first fold is known."""
    points, faces, opposite = search.surface
    last = at = first
    for _ in range(search.steps - 1):
        across = opposite[at.face, at.edge]
        if not 0 <= across < faces.size or across // 3 == goal:
            break
        at = enter(points, faces, across, frame)
        if not abs(at.c) < 1 or (at.face == first.face and at.edge == first.edge):
            break
        if at.c > last.c and is_silhouette(points, faces, opposite, at):
            last = at
    return last


@kernel
def put(pairs, n, owner, other, at, search, frame):
    """Write pair n, whose first fold is at a Crossing -> whether it is blended."""
    at = last_fold(search, search.face_index[other], at, frame)
    pairs.owner[n], pairs.other[n] = owner, other
    pairs.face[n], pairs.edge[n] = at.face, at.edge
    pairs.c[n] = at.c
    for k in range(2):
        vertex = search.surface.faces[at.face, (at.edge + 1 + k) % 3]
        end = in_frame(point(search.surface.points, vertex), frame)
        pairs.ends[k, n], pairs.x[k, n], pairs.y[k, n] = vertex, end.x, end.y
    is_steep = abs(pairs.y[1, n] - pairs.y[0, n]) >= abs(pairs.x[1, n] - pairs.x[0, n])
    return -WINDOW < at.c < 1 + WINDOW and is_steep and not (at.c == 0.5 and owner < other)


@kernel
def put_through(through, n, owner, other, at):
    """Write the n-th second walk that passes the other's centre, at a Crossing -> does it?"""
    through[0, n], through[1, n], through[2, n] = owner, other, at.face
    return at.c >= 1


@kernel
def find_pairs(screen, surface, rows, pairs, through, walks):
    """The blended pairs of the rows bottom <= row < top with the next pixel to the right, and then
    those with the one above -> how many there are of the first, and in all; and of `through`.
    Unless it walks, only edges of the owner's face count, as nvdiffrast has it.
    """
    steps, most = (2 * len(surface.faces), 1.0) if walks else (1, np.inf)
    outlined = np.zeros(0 if walks else len(surface.faces), np.uint8)
    search = Search(screen.face_index, screen.width, surface, steps, most, outlined)
    end = neighbours(0, search, screen, rows, pairs, 0)
    beside, met = keep_outlines(search, pairs, 0, end, through, 0)
    end = neighbours(1, search, screen, rows, pairs, beside)
    return (beside, met), keep_outlines(search, pairs, beside, end, through, met)


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
def end_backward(grad, step, clip, vertex, grad_clip):
    """Adds the gradient of an edge's end, in the pair's frame, to its x, y, w."""
    grad_along, grad_across = grad
    grad_x = (step.dx * grad_along + abs(step.dy) * grad_across) * (step.width / 2)
    grad_y = (step.dy * grad_along + abs(step.dx) * grad_across) * (step.height / 2)
    x, y, w = clip[vertex, 0], clip[vertex, 1], clip[vertex, 3]
    least = CAMERA_PLANE * max(abs(x), abs(y))
    if abs(w) < least:
        w = -least if w < 0 else least
    grad_clip[vertex, 0] += grad_x / w
    grad_clip[vertex, 1] += grad_y / w
    grad_clip[vertex, 3] -= (grad_x * x / w + grad_y * y / w) / w


@kernel
def is_there(pairs, n, pixels, vertices):
    """Does pair n name pixels and vertices that are there?"""
    owner, other, i, j = pairs.owner[n], pairs.other[n], pairs.ends[0, n], pairs.ends[1, n]
    return (min(owner, other) >= 0 and max(owner, other) < pixels and min(i, j) >= 0
            and max(i, j) < vertices)


@kernel
def are_whole(pairs):
    """Has each field as many numbers as c has?"""
    return (min(len(pairs.owner), len(pairs.other), pairs.ends.shape[1], pairs.x.shape[1],
                pairs.y.shape[1]) >= len(pairs.c)
            and min(len(pairs.ends), len(pairs.x), len(pairs.y)) >= 2)


@kernel
def blend_backward(grad_picture, colour, pairs, channels, clip, sides, grad_clip, grad_colour):
    """Backward of `blend`: adds those of edges to grad_clip (V, 4), and those of pixels to
    grad_colour, a copy of grad_picture before -> whether all are there.
    """
    if not are_whole(pairs):
        return False
    for n in range(len(pairs.c)):
        if not is_there(pairs, n, sides.width * sides.height, len(clip)):
            return False
        owner, other = pairs.owner[n], pairs.other[n]
        grad_alpha = alpha_backward(grad_picture, colour, pairs, n, channels, grad_colour)
        if 0 < pairs.c[n] < 1:
            step = Step(other % sides.width - owner % sides.width,
                        other // sides.width - owner // sides.width, sides.width, sides.height)
            ends_backward(grad_alpha, pairs, n, step, clip, sides.epsilon, grad_clip)
    return True


@kernel
def alpha_backward(grad_picture, colour, pairs, n, channels, grad_colour):
    """The gradient of a pair's alpha. Adds those of its pixels' colours."""
    count = len(channels)
    owner, other = pairs.owner[n] * count, pairs.other[n] * count
    alpha = 0.5 - min(max(pairs.c[n], 0.0), 1.0)
    changed = owner if alpha >= 0 else other
    grad_alpha = 0.0
    for k in range(count):
        grad_changed = grad_picture[changed + k]
        grad_alpha += grad_changed * (colour[other + k] - colour[owner + k])
        grad_colour[owner + k] -= alpha * grad_changed
        grad_colour[other + k] += alpha * grad_changed
    return grad_alpha


@kernel
def ends_backward(grad_alpha, pairs, n, step, clip, epsilon, grad_clip):
    """The way back from alpha = 1/2 - c to both ends of a pair's edge."""
    x0, x1, y0, y1 = pairs.x[0, n], pairs.x[1, n], pairs.y[0, n], pairs.y[1, n]
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = -grad_alpha * r
    end_backward((slope * y1, slope * (c - x1)), step, clip, pairs.ends[0, n], grad_clip)
    end_backward((-slope * y0, slope * (x0 - c)), step, clip, pairs.ends[1, n], grad_clip)
