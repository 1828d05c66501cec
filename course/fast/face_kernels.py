"""Face kernels: lab 2's rasterizer as loops over vertices, faces, rows and columns.

    a thread a vertex   where it is on screen, and beyond which planes            project_vertices
    a thread a band     for each face, for each row of it in the band             draw_faces
                        an interval of columns, the nearest depth stays

They take the decisions of scanline.py to the last bit: functions of one name do the same, and the
numbers in brackets are its equations. No two bands have a pixel in common. So the threads need no
lock, and any number of them draws the same picture.

Most faces of a large mesh are small. One of a few columns is tested pixel by pixel, by edge
functions that are only nearly right. Where all signs are certain that is enough. All other faces
take the exact way: on each row a quotient finds where an edge crosses, and the exact sum decides.
"""
from collections import namedtuple

import numpy as np

from course.given.compiled import kernel

from .rasterization import CAMERA_PLANE, MARGIN
from .scanline import FINITE, TINY

BEHIND = 1 << 7  # the bit of an outcode for w <= 0
NARROW = 4      # columns of a small face
CERTAIN = 1e-9  # square pixels: within NARROW columns, no rounding turns the sign of more than this


# A vertex on screen: x, y of its pixel, z / w, and w.
Corner = namedtuple("Corner", "x y z w")

# Samples: left <= column < right, bottom <= row < top.
Box = namedtuple("Box", "left right bottom top")

# Eq. (2), as `first_column` takes it: on the row at height y, slope (column - x) + rise (row - y)
# grows from left to right. It is >= 0 inside of an edge that opens the row's interval, and outside
# of the others.
Edge = namedtuple("Edge", "opens slope reciprocal rise x y")

# Eq. (4): a corner, and how the depth changes along x and along y.
Plane = namedtuple("Plane", "corner dz_dx dz_dy")

# What is drawn: corners (F, 3), points (V, 4) and outcode (V,) of `project_vertices`.
Faces = namedtuple("Faces", "corners points outcode")

# What is drawn on, one long row each: face_index, depth (H W,). centres (W,): of columns.
ZBuffer = namedtuple("ZBuffer", "centres face_index depth")


@kernel
def project_vertices(clip, width, height, first, end, points, outcode):
    """`screen_points` and `outcodes` of vertices, first <= v < end: points[v] = x, y, z / w, w."""
    for v in range(first, end):
        x, y, z, w = clip[v, 0], clip[v, 1], clip[v, 2], clip[v, 3]
        beyond = ((x < -w) << 1 | (x > w) << 2 | (y < -w) << 3 | (y > w) << 4
                  | (z < -w) << 5 | (z > w) << 6 | (w <= 0) << 7)
        least = CAMERA_PLANE * max(abs(x), abs(y))
        if abs(w) < least:
            w = -least if w < 0 else least
        points[v, 0], points[v, 1] = (x / w + 1) * (width / 2), (y / w + 1) * (height / 2)
        points[v, 2], points[v, 3] = z / w, w
        outcode[v] = beyond | np.isfinite(points[v, 0] + points[v, 1] + z + w)


@kernel
def corner(points, v):
    """One of the points."""
    return Corner(points[v, 0], points[v, 1], points[v, 2], points[v, 3])


@kernel
def sample_box(corners, rows, width, height):
    """The samples that a face may cover on some rows."""
    a, b, c = corners
    bottom, top = rows
    if min(a.w, b.w, c.w) <= 0:
        return Box(0, width, bottom, top)
    reach = 0.5 + MARGIN
    return Box(int(np.ceil(max(min(a.x, b.x, c.x), 0.0) - reach)),
               int(np.floor(min(max(a.x, b.x, c.x), float(width)) + reach)),
               max(bottom, int(np.ceil(max(min(a.y, b.y, c.y), 0.0) - reach))),
               min(top, int(np.floor(min(max(a.y, b.y, c.y), float(height)) + reach))))


@kernel
def farthest_first(a, b, c):
    """The corners, the one of greatest |w| swapped to the front."""
    if abs(b.w) > abs(a.w):
        a, b = b, a
    return (c, b, a) if abs(c.w) > abs(a.w) else (a, b, c)


@kernel
def twice_area(a, b, c):
    """2A of a face: positive if it is counter-clockwise."""
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)


@kernel
def half_plane(p, q, sign):
    """The Edge from p to q, of a face and a third corner whose signs are that of the normal."""
    n_x, n_y = sign * (p.y - q.y), sign * (q.x - p.x)
    w_p, w_q = abs(p.w), abs(q.w)
    at_p = (w_p > w_q) | ((w_p == w_q) & ((p.x < q.x) | ((p.x == q.x) & (p.y <= q.y))))
    x, y = p.x if at_p else q.x, p.y if at_p else q.y
    is_top_left = (n_x > 0) | ((n_x == 0) & (n_y > 0))  # as in rasterization.py
    slope = max(abs(n_x), TINY)
    return Edge(is_top_left, slope, 1 / slope, n_y if is_top_left else -n_y,
                0.0 if n_x == 0 else x, y)


@kernel
def first_column(edge, y):
    """The first column of the row at y at which the edge's sum is >= 0, as a float."""
    offset = edge.rise * (y - edge.y)
    column = np.floor(edge.x - offset * edge.reciprocal)
    return column + (edge.slope * (column + 0.5 - edge.x) + offset < 0)


@kernel
def cut(start, end, edge, y):
    """The part of a row's interval that lies inside of an edge."""
    column = first_column(edge, y)
    return max(start, column if edge.opens else start), min(end, end if edge.opens else column)


@kernel
def depth_plane(a, b, c):
    """Eq. (4) from the first corner."""
    x1, y1, z1 = b.x - a.x, b.y - a.y, b.z - a.z
    x2, y2, z2 = c.x - a.x, c.y - a.y, c.z - a.z
    area = x1 * y2 - x2 * y1
    return Plane(a, (z1 * y2 - z2 * y1) / area, (x1 * z2 - x2 * z1) / area)


@kernel
def row_depth(plane, y):
    """The depth on the row at y where x is the corner's."""
    return plane.dz_dy * (y - plane.corner.y) + plane.corner.z


@kernel
def least_and_most(a, b, c, x, y):
    """Of the three edge functions at a sample."""
    e0 = (b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)
    e1 = (c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)
    e2 = (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x)
    return min(e0, e1, e2), max(e0, e1, e2)


@kernel
def draw_small(face, corners, box, buffer):
    """`draw_face` for a small face in front of the camera -> whether all its signs are certain."""
    a, b, c = corners
    plane = Plane(a, 0.0, 0.0)
    is_known = False
    for row in range(box.bottom, box.top):
        first = np.uintp(row * len(buffer.centres))
        for j in range(np.uintp(box.left), np.uintp(box.right)):
            x, y = buffer.centres[j], row + 0.5
            least, most = least_and_most(a, b, c, x, y)
            if (least < -CERTAIN) & (most > CERTAIN):
                continue
            if (least <= CERTAIN) & (most >= -CERTAIN):
                return False
            if not is_known:
                plane = depth_plane(*farthest_first(a, b, c))
                is_known = True
            deep = plane.dz_dx * (x - plane.corner.x) + row_depth(plane, y)
            if (abs(deep) <= 1) & (deep < buffer.depth[first + j]):
                buffer.depth[first + j] = deep
                buffer.face_index[first + j] = face
    return True


@kernel
def draw_face(face, corners, box, buffer):
    """One face, in its box."""
    a, b, c = farthest_first(*corners)
    winding = np.sign(twice_area(a, b, c))
    if winding == 0:
        return
    edge_0 = half_plane(b, c, winding * np.sign(a.w))
    edge_1 = half_plane(c, a, winding * np.sign(b.w))
    edge_2 = half_plane(a, b, winding * np.sign(c.w))
    plane = depth_plane(a, b, c)
    for row in range(box.bottom, box.top):
        start, end = float(box.left), float(box.right)
        for edge in (edge_0, edge_1, edge_2):
            start, end = cut(start, end, edge, row + 0.5)
        if start < end:
            draw_span(face, row, (np.uintp(start), np.uintp(end)), plane, buffer)


@kernel
def draw_span(face, row, columns, plane, buffer):
    """A face on the columns start <= j < end of a row. No step has a branch."""
    centres, face_index, depth = buffer
    offset = row_depth(plane, row + 0.5)
    first = np.uintp(row * len(centres))
    for j in range(*columns):
        deep = plane.dz_dx * (centres[j] - plane.corner.x) + offset
        before, shown = depth[first + j], face_index[first + j]
        closer = (abs(deep) <= 1) & (deep < before)
        depth[first + j] = deep if closer else before
        face_index[first + j] = face if closer else shown


@kernel
def clear(rows, buffer):
    """Nothing is seen on some rows."""
    first, end = rows[0] * len(buffer.centres), rows[1] * len(buffer.centres)
    buffer.face_index[first:end] = -1
    buffer.depth[first:end] = np.inf


@kernel
def draw_faces(faces, part, rows, height, buffer):
    """The faces first <= face < end of a part, on some rows bottom <= row < top of the picture.

    -> whether all of them name vertices that are there. The others are left out.
    """
    is_sound = True
    clear(rows, buffer)
    for face in range(*part):
        i, j, k = faces.corners[face, 0], faces.corners[face, 1], faces.corners[face, 2]
        if min(i, j, k) < 0 or max(i, j, k) >= len(faces.points):
            is_sound = False
            continue
        if faces.outcode[i] & faces.outcode[j] & faces.outcode[k] != FINITE:
            continue
        corners = corner(faces.points, i), corner(faces.points, j), corner(faces.points, k)
        box = sample_box(corners, rows, len(buffer.centres), height)
        if box.left >= box.right or box.bottom >= box.top:
            continue
        is_small = box.right - box.left <= NARROW and (
            faces.outcode[i] | faces.outcode[j] | faces.outcode[k]) < BEHIND
        if not (is_small and draw_small(face, corners, box, buffer)):
            draw_face(face, corners, box, buffer)
    return is_sound


@kernel
def keep_nearest(nearest, other):
    """Two z-buffers become one, the first. Where they are equally deep, it keeps its face."""
    for pixel in range(len(nearest.depth)):
        before, face = nearest.depth[pixel], nearest.face_index[pixel]
        is_nearer = other.depth[pixel] < before
        nearest.depth[pixel] = other.depth[pixel] if is_nearer else before
        nearest.face_index[pixel] = other.face_index[pixel] if is_nearer else face
