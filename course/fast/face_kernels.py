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
import numpy as np

from course.given.compiled import kernel

from .rasterization import CAMERA_PLANE, MARGIN
from .scanline import FINITE, TINY

BEHIND = 1 << 7  # the bit of an outcode for w <= 0
NARROW = 4      # columns of a small face
CERTAIN = 1e-9  # square pixels: within NARROW columns, no rounding turns the sign of more than this


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
def sample_box(points, a, b, c, width, height):
    """The samples that a face may cover: left <= column < right, bottom <= row < top."""
    if min(points[a, 3], points[b, 3], points[c, 3]) <= 0:
        return 0, width, 0, height
    x0, x1, x2 = points[a, 0], points[b, 0], points[c, 0]
    y0, y1, y2 = points[a, 1], points[b, 1], points[c, 1]
    reach = 0.5 + MARGIN
    return (int(np.ceil(max(min(x0, x1, x2), 0.0) - reach)),
            int(np.floor(min(max(x0, x1, x2), float(width)) + reach)),
            int(np.ceil(max(min(y0, y1, y2), 0.0) - reach)),
            int(np.floor(min(max(y0, y1, y2), float(height)) + reach)))


@kernel
def farthest_first(points, a, b, c):
    """The corners, the one of greatest |w| swapped to the front."""
    swap = abs(points[b, 3]) > abs(points[a, 3])
    a, b = b if swap else a, a if swap else b
    swap = abs(points[c, 3]) > abs(points[a, 3])
    return c if swap else a, b, a if swap else c


@kernel
def twice_area(points, a, b, c):
    """2A of a face: positive if it is counter-clockwise."""
    x, y = points[a, 0], points[a, 1]
    return ((points[b, 0] - x) * (points[c, 1] - y) - (points[c, 0] - x) * (points[b, 1] - y))


@kernel
def half_plane(points, i, j, sign):
    """Eq. (2), as `row_interval` takes it: opens, slope, rise, from_x, from_y of the edge i to j.

    On the row at y, slope (x - from_x) + rise (y - from_y) grows from left to right. It is >= 0
    inside of an edge that opens the interval, and outside of the others.
    """
    w_i, w_j = abs(points[i, 3]), abs(points[j, 3])
    x_i, y_i, x_j, y_j = points[i, 0], points[i, 1], points[j, 0], points[j, 1]
    n_x, n_y = sign * (y_i - y_j), sign * (x_j - x_i)
    at_i = (w_i > w_j) | ((w_i == w_j) & ((x_i < x_j) | ((x_i == x_j) & (y_i <= y_j))))
    from_x, from_y = x_i if at_i else x_j, y_i if at_i else y_j
    opens = (n_x > 0) | ((n_x == 0) & (n_y > 0))
    from_x = 0.0 if n_x == 0 else from_x
    return opens, max(abs(n_x), TINY), n_y if opens else -n_y, from_x, from_y


@kernel
def first_column(edge, reciprocal, y):
    """The first column of the row at y at which the edge's sum is >= 0, as a float."""
    _, slope, rise, from_x, from_y = edge
    offset = rise * (y - from_y)
    column = np.floor(from_x - offset * reciprocal)
    return column + (slope * (column + 0.5 - from_x) + offset < 0)


@kernel
def cut(start, end, edge, reciprocal, y):
    """The part of a row's interval that lies inside of an edge."""
    column = first_column(edge, reciprocal, y)
    return (max(start, column if edge[0] else start), min(end, end if edge[0] else column))


@kernel
def depth_plane(points, a, b, c):
    """Eq. (4): x, y, z of the first corner, and how the depth changes along x and along y."""
    x, y, z = points[a, 0], points[a, 1], points[a, 2]
    x1, y1, z1 = points[b, 0] - x, points[b, 1] - y, points[b, 2] - z
    x2, y2, z2 = points[c, 0] - x, points[c, 1] - y, points[c, 2] - z
    area = x1 * y2 - x2 * y1
    return x, y, z, (z1 * y2 - z2 * y1) / area, (x1 * z2 - x2 * z1) / area


@kernel
def draw_small(face, points, corners, columns, rows, centres, face_index, depth):
    """`draw_face` for a small face in front of the camera -> whether all its signs are certain."""
    a, b, c = corners
    x0, y0, x1, y1, x2, y2 = (points[a, 0], points[a, 1], points[b, 0], points[b, 1],
                              points[c, 0], points[c, 1])
    is_known = False
    x, y, z, dz_dx, dz_dy = 0.0, 0.0, 0.0, 0.0, 0.0
    for row in range(*rows):
        py = row + 0.5
        first = np.uintp(row * len(centres))
        for j in range(np.uintp(columns[0]), np.uintp(columns[1])):
            px = centres[j]
            e0 = (x1 - px) * (y2 - py) - (y1 - py) * (x2 - px)
            e1 = (x2 - px) * (y0 - py) - (y2 - py) * (x0 - px)
            e2 = (x0 - px) * (y1 - py) - (y0 - py) * (x1 - px)
            least, most = min(e0, e1, e2), max(e0, e1, e2)
            if (least < -CERTAIN) & (most > CERTAIN):
                continue
            if (least <= CERTAIN) & (most >= -CERTAIN):
                return False
            if not is_known:
                is_known = True
                x, y, z, dz_dx, dz_dy = depth_plane(points, *farthest_first(points, a, b, c))
            deep = dz_dx * (px - x) + (dz_dy * (py - y) + z)
            if (abs(deep) <= 1) & (deep < depth[first + j]):
                depth[first + j] = deep
                face_index[first + j] = face
    return True


@kernel
def draw_face(face, points, corners, columns, rows, centres, face_index, depth):
    """One face, in the columns and rows of its box. The picture is one long row."""
    a, b, c = farthest_first(points, *corners)
    winding = np.sign(twice_area(points, a, b, c))
    if winding == 0:
        return
    edge_0 = half_plane(points, b, c, winding * np.sign(points[a, 3]))
    edge_1 = half_plane(points, c, a, winding * np.sign(points[b, 3]))
    edge_2 = half_plane(points, a, b, winding * np.sign(points[c, 3]))
    reciprocal_0, reciprocal_1, reciprocal_2 = 1 / edge_0[1], 1 / edge_1[1], 1 / edge_2[1]
    x, y, z, dz_dx, dz_dy = depth_plane(points, a, b, c)
    for row in range(*rows):
        py = row + 0.5
        start, end = float(columns[0]), float(columns[1])
        start, end = cut(start, end, edge_0, reciprocal_0, py)
        start, end = cut(start, end, edge_1, reciprocal_1, py)
        start, end = cut(start, end, edge_2, reciprocal_2, py)
        offset = dz_dy * (py - y) + z
        first = np.uintp(row * len(centres))
        if start < end:
            for j in range(np.uintp(start), np.uintp(end)):
                deep = dz_dx * (centres[j] - x) + offset
                before, shown = depth[first + j], face_index[first + j]
                closer = (abs(deep) <= 1) & (deep < before)
                depth[first + j] = deep if closer else before
                face_index[first + j] = face if closer else shown


@kernel
def draw_faces(faces, points, outcode, width, height, first, end, bottom, top, face_index, depth):
    """The faces first <= face < end, on the rows bottom <= row < top of the flat picture.

    -> whether all of them name vertices that are there. The others are left out.
    """
    centres = np.arange(width) + 0.5
    face_index[bottom * width:top * width] = -1
    depth[bottom * width:top * width] = np.inf
    is_sound = True
    for face in range(first, end):
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        if min(a, b, c) < 0 or max(a, b, c) >= len(points):
            is_sound = False
            continue
        if outcode[a] & outcode[b] & outcode[c] != FINITE:
            continue
        left, right, low, high = sample_box(points, a, b, c, width, height)
        low, high = max(low, bottom), min(high, top)
        if left >= right or low >= high:
            continue
        corners, columns, rows = (a, b, c), (left, right), (low, high)
        is_small = right - left <= NARROW and outcode[a] | outcode[b] | outcode[c] < BEHIND
        if not (is_small and draw_small(face, points, corners, columns, rows, centres, face_index,
                                        depth)):
            draw_face(face, points, corners, columns, rows, centres, face_index, depth)
    return is_sound


@kernel
def keep_nearest(face_index, depth, other_index, other_depth):
    """Two z-buffers become one, the first. Where they are equally deep, it keeps its face."""
    for pixel in range(len(depth)):
        before, face = depth[pixel], face_index[pixel]
        is_nearer = other_depth[pixel] < before
        depth[pixel] = other_depth[pixel] if is_nearer else before
        face_index[pixel] = other_index[pixel] if is_nearer else face
