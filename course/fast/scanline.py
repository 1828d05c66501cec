"""Scanlines: lab 2 for whole meshes at once, exact on every shared edge, also behind the camera.

Corners are rows of (3, F) arrays, their w of any sign. A face covers a sample p = (x, y) if every
e_k / w_k, which is c_k of (3) in interpolation.py, has the sign of 2A or is 0:

    covered  <=>  every n_k . (p - from_k) >= 0,   ties by the top-left rule                 (2)
                  n_k = sign(2A w_k) times the normal of edge k, from_k: one of its ends
    depth = z_0 + dz/dx (x - x_0) + dz/dy (y - y_0),   z_k = z / w of the corner             (4)

So a face is an intersection of three half-planes, also where it crosses the camera plane. Nothing
is clipped, and on a row of pixels it covers one interval: start <= column < end.

Watertight: the two faces at an edge compute the same e with opposite sign, to the last bit, and e
is exactly 0 at its ends. Only faces thinner than rounding (1e-15 of their length) can lose or
double a sample. Hardware avoids this by rounding vertices to 1/256 pixel first.

Sources: Olano and Greer 1997, lecture "Differentiable graphics 1" (4).
"""
from typing import NamedTuple

import numpy as np

from course.given import inputs
from course.given.arrays import EDGES, chunks, expand, in_chunks

from .rasterization import MARGIN, screen_points

TINY = 1e-300  # stands for a slope of 0 in a division
FINITE = np.uint8(1)  # the last bit of an outcode


def twice_area(x, y):
    """2A of triangles, x, y (3, F): positive if counter-clockwise -> (F,)."""
    return (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])


def half_planes(x, y, w):
    """Each c_k / 2A >= 0, c_k of eq. (5), as a half-plane n_x (x - from_x) + n_y (y - from_y) >= 0.

    x, y, w (3, F), row k of corner k -> n_x, n_y, from_x, from_y (3, F), row k of the edge
    opposite to it: its normal, times the signs of w_k and of `twice_area`, and one of its ends.

    >>> corners = np.array([[0.0, 4.0, 1.0], [0.0, 0.0, 2.0], [1.0, -2.0, 1.0]])
    >>> n_x, n_y, from_x, from_y = half_planes(*corners[..., None])
    >>> n_x.T, n_y.T
    (array([[-2., -2.,  0.]]), array([[-3.,  1.,  4.]]))
    >>> from_x.T, from_y.T
    (array([[4., 0., 4.]]), array([[0., 0., 0.]]))

    Fine print. Both faces at an edge measure from the same end. Choose it by greater |w| (the other
    end may be near infinity), then by smaller x, then by smaller y.
    """
    n_x, n_y, from_x, from_y = np.empty((4, *x.shape))
    winding = np.sign(twice_area(x, y))
    for k, (i, j) in enumerate(EDGES):
        w_i, w_j = np.abs(w[i]), np.abs(w[j])
        before = (x[i] < x[j]) | ((x[i] == x[j]) & (y[i] <= y[j]))
        at_i = (w_i > w_j) | ((w_i == w_j) & before)
        from_x[k], from_y[k] = np.where(at_i, x[i], x[j]), np.where(at_i, y[i], y[j])
        sign = winding * np.sign(w[k])
        n_x[k], n_y[k] = sign * (y[i] - y[j]), sign * (x[j] - x[i])
    return n_x, n_y, from_x, from_y


def depth_slopes(x, y, z):
    """Eq. (4) as two slopes: how the depth changes along x and along y.

    x, y, z (3, F): the faces' corners, z after the divide -> dz_dx, dz_dy (F,).

    >>> depth_slopes(*np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [0.5, 0.9, 0.5]])[..., None])
    (array([0.1]), array([0.]))

    Fine print. Measure from corner 0: the callers put the most accurate one there. Both slopes
    are exactly 0 where all z are equal. A face without area gets inf or nan.
    """
    x1, y1, z1 = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    x2, y2, z2 = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    # dz_dx x1 + dz_dy y1 = z1 and dz_dx x2 + dz_dy y2 = z2, by Cramer's rule.
    determinant = twice_area(x, y)
    return (z1 * y2 - z2 * y1) / determinant, (x1 * z2 - x2 * z1) / determinant


def outcodes(clip, x, y):
    """For each vertex a bit for each plane of the view frustum that it is beyond, and FINITE.

    clip (V, 4); x, y (V,) of `screen_points` -> uint8 (V,).
    """
    clip_x, clip_y, z, w = np.array(clip.T, float, order="C")  # contiguous rows: faster
    beyond = clip_x < -w, clip_x > w, clip_y < -w, clip_y > w, z < -w, z > w, w <= 0
    outcode = FINITE * np.isfinite(x + y + z + w)
    for bit, is_beyond in enumerate(beyond, 1):
        outcode |= np.left_shift(is_beyond, bit, dtype=np.uint8)
    return outcode


def can_be_seen(outcode, corners):
    """Which faces have corners that are finite and not all beyond one plane of the view frustum.

    outcode (V,) of `outcodes`; corners (3, F) -> bool (F,).
    """
    return np.bitwise_and.reduce(outcode.take(corners)) == FINITE


def farthest_first(corners, w):
    """The corners (3, F) of faces, the one of greatest |w| swapped to the front; w (V,).

    Its place on screen is the most accurate. Where w is nearly 0, x, y and z / w are nearly
    infinite.
    """
    first, second, third = corners
    w0, w1, w2 = np.abs(w.take(corners))
    swap = w1 > w0
    first, second = np.where(swap, second, first), np.where(swap, first, second)
    swap = w2 > np.maximum(w0, w1)
    return np.stack([np.where(swap, third, first), second, np.where(swap, first, third)])


class Triangles(NamedTuple):
    """What decides where faces are seen: their `half_planes`, and eq. (4) from corner 0."""

    planes: tuple      # n_x, n_y, from_x, from_y, (3, F) each
    x: np.ndarray      # (F,), like the rest
    y: np.ndarray
    z: np.ndarray
    dz_dx: np.ndarray
    dz_dy: np.ndarray


def triangle_setup(x, y, z, w, corners):
    """The Triangles of faces, corners (3, F); x, y, w (V,) of `screen_points`, z (V,) after the
    divide.
    """
    corners = farthest_first(corners, w)
    x, y, z, w = (values.take(corners) for values in (x, y, z, w))
    return Triangles(half_planes(x, y, w), x[0], y[0], z[0], *depth_slopes(x, y, z))


def first_column(slope, from_x, offset):
    """The first column j with slope (j + 0.5 - from_x) + offset >= 0, also outside the picture.

    slope (R,) > 0, from_x, offset (R,) -> j (R,), as floats.

    >>> first_column(np.array([2.0, 2.0, 2.0]), np.zeros(3), np.array([-3.0, -3.1, 99.0]))
    array([  1.,   2., -50.])

    Fine print. A quotient finds the place, but is rounded differently from this sum, which has the
    last word. For |from_x| < 1e14 the two are never more than one column apart. Of a slope that is
    nearly 0 the answer may be infinite.
    """
    # The crossing lies in this column: its centre is inside, or the next one's is.
    column = np.floor(from_x - offset / slope)
    column += slope * (column + 0.5 - from_x) + offset < 0
    return column


def row_interval(planes, face, y, left, right):
    """The columns start <= j < end that a face covers on the row of pixels at height y.

    planes of `half_planes`, each (3, F). left, right (F,): the face's box, left <= j < right. face,
    y (R,): the rows -> start, end (R,), floats. Edges that are top-left open the interval at the
    first column with e >= 0. The others end it at the first with -e >= 0.

    >>> corners = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 4.0], [1.0, 1.0, 1.0]])
    >>> row_interval(half_planes(*corners[..., None]), np.array([0, 0]), np.array([0.5, 2.5]),
    ...              np.array([0.0]), np.array([8.0]))
    (array([0., 0.]), array([3., 1.]))

    Fine print. The e of a horizontal edge is one number on the whole row. Where n_x = 0, give
    `first_column` the slope TINY and from_x = 0: the answer lies far outside, or is 0 where e = 0.
    An edge without length, n = 0, ends the interval at 0.
    """
    start = left.astype(float).take(face)
    end = right.astype(float).take(face)
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = (n_x > 0) | ((n_x == 0) & (n_y > 0))  # top-left edges
        rise = np.where(opens, n_y, -n_y)  # with slope >= 0, e or -e grows from left to right
        slope = np.abs(n_x)
        # A horizontal edge's e is offset, and has its sign with a slope of TINY from x = 0 as well.
        from_x = np.where(slope == 0, 0, from_x)
        slope = np.maximum(slope, TINY)
        offset = rise.take(face) * (y - from_y.take(face))
        column = first_column(slope.take(face), from_x.take(face), offset)
        opens = opens.take(face)
        start = np.where(opens, np.maximum(start, column), start)
        end = np.where(opens, end, np.minimum(end, column))
    return start, end


def sample_range(position, in_front, size):
    """`bounding_box` in one direction, of single vertices: first and end column (or row), (V,).

    position (V,): x (or y) on screen, valid where in_front (V,). The others get the whole range, 0
    to size.
    """
    position = np.clip(position, 0, size)
    first = np.where(in_front, np.ceil(position - (0.5 + MARGIN)), 0)
    return first, np.where(in_front, np.floor(position + (0.5 + MARGIN)), size)


class Boxes(NamedTuple):
    """Faces, and the samples that they may cover: left <= column < right, bottom <= row < top."""

    face: np.ndarray     # (F,) their numbers
    corners: np.ndarray  # (3, F)
    left: np.ndarray     # (F,) like the rest
    bottom: np.ndarray
    right: np.ndarray
    top: np.ndarray


def boxes(clip, x, y, w, faces, width, height):
    """The Boxes of the faces that may cover a sample, the last face first, in chunks."""
    left, right = sample_range(x, w > 0, width)
    bottom, top = sample_range(y, w > 0, height)
    # A face has the least left and bottom of its corners, and the least -right and -top.
    reach = np.stack([left, bottom, -right, -top], -1).astype(np.int32)
    outcode = outcodes(clip, x, y)
    for face in in_chunks(np.arange(len(faces))[::-1]):
        corners = faces.take(face, 0).T.copy()
        left, bottom, minus_right, minus_top = reach.take(corners, 0).min(0).T
        drawn = np.flatnonzero((left < -minus_right) & (bottom < -minus_top)
                               & can_be_seen(outcode, corners))
        yield Boxes(face.take(drawn), corners.take(drawn, 1), left.take(drawn), bottom.take(drawn),
                    -minus_right.take(drawn), -minus_top.take(drawn))


class Spans(NamedTuple):
    """Runs of pixels that faces cover on rows, (N,) each: the columns start <= j < end of a row.

    The face's depth there is slope (x - from_x) + offset.
    """

    face: np.ndarray
    row: np.ndarray
    start: np.ndarray
    end: np.ndarray
    slope: np.ndarray
    from_x: np.ndarray
    offset: np.ndarray


def spans(clip, faces, width, height):
    """All Spans of all faces, the last face first, in chunks."""
    x, y, w = screen_points(clip, width, height)
    z = clip[:, 2] / w
    for box in boxes(clip, x, y, w, faces, width, height):
        for part in chunks(box.top - box.bottom):
            some = Boxes(*(values[..., part] for values in box))
            yield spans_in_boxes(some, triangle_setup(x, y, z, w, some.corners))


def spans_in_boxes(box, setup):
    """The Spans of the faces of Boxes, from their Triangles."""
    face, row = expand(box.bottom, box.top - box.bottom)
    start, end = row_interval(setup.planes, face, row + 0.5, box.left, box.right)
    covered = np.flatnonzero(start < end)
    face, row, start, end = (values.take(covered) for values in (face, row, start, end))
    offset = setup.dz_dy.take(face) * (row + 0.5 - setup.y.take(face)) + setup.z.take(face)
    return Spans(box.face.take(face), row, start.astype(int), end.astype(int),
                 setup.dz_dx.take(face), setup.x.take(face), offset)


def fragments(clip, faces, width, height):
    """Every sample that every face covers: yields pixel (N,) = row * width + column, depth (N,) and
    face (N,) in chunks. The last face comes first: whoever writes last then keeps the first.
    """
    for found in spans(clip, faces, width, height):
        for part in chunks(found.end - found.start):
            piece = Spans(*(values[part] for values in found))
            span, column = expand(piece.start, piece.end - piece.start)
            depth = (piece.slope.take(span) * (column + 0.5 - piece.from_x.take(span))
                     + piece.offset.take(span))
            pixel = (piece.row * width).take(span) + column
            face = piece.face.take(span)
            seen = np.abs(depth) <= 1  # between near and far
            if not seen.all():
                pixel, depth, face = pixel[seen], depth[seen], face[seen]
            yield pixel, depth, face


def rasterize(clip, faces, width, height, beyond=None):
    """What each pixel sees: lab 2's `rasterize` for whole meshes, also behind the camera.

    clip (V, 4), faces (F, 3) integers from 0 to V - 1 -> face_index (height, width), -1 where no
    face is seen; depth (height, width), z/w from -1 to 1, np.inf there. Both sides of a face are
    seen. Any w, also of vertices behind the camera. Faces with vertices that are not finite are
    left out. beyond (height, width): only what is deeper, such as the depth of the layer before.
    ValueError for faces that name vertices that are not there.
    """
    inputs.require_faces(faces, len(clip))
    face_index = np.full(height * width, -1)
    depth = np.full(height * width, np.inf)
    with np.errstate(all="ignore"):  # faces without an area cover nothing
        for pixel, z, face in fragments(clip, faces, width, height):
            if beyond is not None:
                deeper = z > beyond.take(pixel)
                pixel, z, face = pixel[deeper], z[deeper], face[deeper]
            np.minimum.at(depth, pixel, z)
            seen = z == depth.take(pixel)
            face_index[pixel[seen]] = face[seen]  # the last write stays: the first of equally deep
    return face_index.reshape(height, width), depth.reshape(height, width)


def trials():
    """{name: lists of arguments}: what is drawn to try whether lab 2's `rasterize` is the same."""
    # Squares with corners on pixel centres, the second upon the first, the third clockwise.
    x, y = np.array([[1.5, 5.5, 5.5, 1.5, 3.5, 9.5, 9.5, 3.5, 7.5, 7.5, 11.5, 11.5],
                     [1.5, 1.5, 4.5, 4.5, 2.5, 2.5, 6.5, 6.5, 0.5, 5.5, 5.5, 0.5]])
    squares = np.stack([x / 6 - 1, y / 4 - 1, np.repeat([0.5, 0.5, -0.5], 4), np.ones(12)], -1)
    corners = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7], [8, 9, 10], [8, 10, 11]])
    # Faces through each other, through the near and far planes, and out of the picture.
    soup = np.random.default_rng(2).uniform([-2, -2, -2, 0.5], [2, 2, 2, 2], (90, 4))
    return {"rasterize": [(squares, corners, 12, 8),
                          (soup, np.arange(90).reshape(30, 3), 24, 15)]}
