"""Rasterization: which face does each pixel see, how deep, and where on the face?

Screen space: x right, y up; pixel [row i, column j] is sampled at its centre (j + 0.5, i + 0.5).

    e(p) = det [x y 1; a_x a_y 1; b_x b_y 1] = n . (p - a),   n = (a_y - b_y, b_x - a_x)     (1)
    covered  <=>  every e_k > 0, or e_k = 0 on an edge that the top-left rule owns           (2)
    b_k = e_k / 2A,   2A = e_0 + e_1 + e_2;   e_k is of the edge opposite to vertex k        (3)

That is the textbook's triangle, exercises 2.1 to 2.8. From 2.9 on: meshes in perspective, both
sides seen, corners as rows of (3, F) arrays. w_k of clip space decides, negative behind the camera:

    c_k = e_k / (2A w_k),   seen  <=>  every c_k >= 0                                        (4)
    1/w = sum c_k,   depth = sum z_k c_k (z of clip space),   b_k = c_k / sum c              (5)

c is M^-1 (x, y, 1), where column k of M is w_k (x_k, y_k, 1): edge functions, the inverse of lab 7
and the face_inv of lab 10 are the same numbers. So a face is an intersection of three half-planes,
also where it crosses the camera plane; nothing is clipped, and a row of pixels is one interval.

Watertight: the two faces at an edge compute the same e with opposite sign, to the last bit; e is
exactly 0 at its ends, for vertices on a pixel's centre. Only faces thinner than rounding (1e-15 of
their length) can lose or double a sample; hardware rounds all vertices to 1/256 pixel before.

Sources: Pineda 1988 (1), lecture "Differentiable graphics 1" (3)-(5), Olano and Greer 1997 (4),
GAMES101 lectures 5 and 6 and its homework 2, a rasterizer for single triangles.
"""
import itertools

import numpy as np

EDGES = (1, 2), (2, 0), (0, 1)  # edge k runs from the first to the second, opposite to vertex k
CAMERA_PLANE = 1e-10  # the least |w| of a vertex, in units of its |x| or |y|
TINY = 1e-300         # stands for a slope of 0 in a division
MARGIN = 1 / 16       # pixels added to a face's bounds: more than rounding moves its edges
CHUNK = 1 << 14       # rows of faces, then fragments, in flight at once: they stay in the cache


def edge_function(p, a, b):  # exercise 2.1 (2 points)
    """Eq. (1): on which side of the line from a to b does p lie? Positive: on its left.

    p, a, b (..., 2), shapes that broadcast -> e (...). To the last bit, unless it overflows: e is 0
    at p = a and at p = b, and swapping a and b flips its sign and nothing else. So both calls must
    measure p from the same end: which one, the coordinates of the two tell, for each element alone,
    and not which of them is called a.

    >>> edge_function(np.array([0.0, 1.0]), np.array([0.0, 0.0]), np.array([2.0, 0.0]))
    np.float64(2.0)
    """
    x,  y  = p[..., 0], p[..., 1]
    x0, y0 = a[..., 0], a[..., 1]
    x1, y1 = b[..., 0], b[..., 1]
    # From the left end. (If both have the same x, the factor of y is 0.)
    from_x, from_y = np.minimum(x0, x1), np.where(x0 <= x1, y0, y1)
    return (y0 - y1) * (x - from_x) + (x1 - x0) * (y - from_y)


def edge_function_backward(grad_e, p, a, b):  # exercise 2.2 (2 points)
    """Backward of eq. (1): grad_e (...) -> grad_p, grad_a, grad_b, each (..., 2).

    p, a, b (..., 2), all of one shape.

    >>> p, a, b = np.array([1.0, 4.0]), np.array([0.0, 0.0]), np.array([2.0, 1.0])
    >>> edge_function_backward(np.array(1.0), p, a, b)
    (array([-1.,  2.]), array([-3., -1.]), array([ 4., -1.]))
    """
    # e = |a b| + |b p| + |p a| with |u v| = u_x v_y - u_y v_x, so d|u v|/du = (v_y, -v_x) and
    # d|u v|/dv = (-u_y, u_x): a point's gradient is the side opposite to it, turned by 90 degrees.
    def turned(side):
        return grad_e[..., None] * np.stack([side[..., 1], -side[..., 0]], -1)

    return turned(a - b), turned(b - p), turned(p - a)


def signed_area(triangle):  # exercise 2.3 (1 point)
    """Area of triangle (..., 3, 2) -> (...): positive if counter-clockwise, negative if clockwise.

    >>> signed_area(np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]]))
    np.float64(1.0)
    """
    return edge_function(triangle[..., 2, :], triangle[..., 0, :], triangle[..., 1, :]) / 2


def is_inside(p, triangle):  # exercise 2.4 (2 points)
    """Three cross products: is p in the triangle, border included, whichever way it is wound?

    p (..., 2), triangle (3, 2) of an area other than 0 -> bool (...).

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    >>> is_inside(np.array([[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]]), triangle)
    array([ True,  True, False])
    """
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e >= 0).all(0) | (e <= 0).all(0)


def is_top_left(n_x, n_y):  # exercise 2.5 (1 point)
    """Top-left rule: does an edge own the samples that lie exactly on it?

    n_x, n_y (...): the edge's inward normal n of eq. (1), the face counter-clockwise -> bool (...).
    A left edge does (n points right), and so does a horizontal edge below its face (n points up):
    row 0 is stored first, so in memory order this is the top edge that other texts speak of.
    n = 0, an edge without length, owns nothing.

    >>> is_top_left(np.array([1.0, -1.0, 0.0, 0.0]), np.array([-5.0, 5.0, 1.0, -1.0]))
    array([ True, False,  True, False])
    """
    return (n_x > 0) | ((n_x == 0) & (n_y > 0))


def is_covered(p, triangle):  # exercise 2.6 (3 points)
    """Eq. (2): does the counter-clockwise triangle cover the sample p?

    p (..., 2), triangle (3, 2) -> bool (...). A clockwise triangle covers nothing.

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    >>> is_covered(np.array([[0.0, 1.0], [1.0, 0.0], [2.0, 2.0]]), triangle)
    array([ True,  True, False])
    """
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= (e > 0) | ((e == 0) & is_top_left(a[1] - b[1], b[0] - a[0]))
    return covered


def barycentric_coordinates(p, triangle):  # exercise 2.7 (2 points)
    """Eq. (3): the weights b (..., 3) with b @ triangle = p and sum b = 1.

    p (..., 2), triangle (3, 2), of either winding, of an area other than 0.

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    >>> barycentric_coordinates(np.array([1.0, 0.0]), triangle)
    array([0.75, 0.25, 0.  ])
    """
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return e / e.sum(-1, keepdims=True)


def bounding_box(triangle, width, height):  # exercise 2.8 (2 points)
    """The pixels whose centres lie in a triangle's box: columns x0 <= j < x1, rows y0 <= i < y1.

    triangle (3, 2), any finite numbers -> four integers: x0 and x1 from 0 to width, y0 and y1 from
    0 to height. The box is MARGIN wider than the triangle on each side, and a centre on its border
    is in it. No pixel: x0 >= x1 or y0 >= y1.

    >>> bounding_box(np.array([[0.5, -9.0], [3.0, 1.2], [2.5, 1.0]]), 8, 8)
    (0, 0, 3, 1)
    """
    # j + 0.5 >= min - MARGIN  and  j + 0.5 <= max + MARGIN
    x0, y0 = np.clip(np.ceil(triangle.min(0) - (0.5 + MARGIN)), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0) + (0.5 + MARGIN)), 0, [width, height])
    return int(x0), int(y0), int(x1), int(y1)


def screen_points(clip, width, height):  # exercise 2.9 (1 point)
    """Where the vertices are on screen: clip (V, 4) -> x, y, w, each (V,) of float64.

    x and y in pixels, after divide and viewport (lab 1), also where w < 0: a vertex behind the
    camera comes out mirrored. In the camera plane it has no place: a |w| less than CAMERA_PLANE
    times the greater of |x| and |y| is raised to that, also in the w returned. The sign stays; of
    w = 0 it is positive. The eye itself, x = y = w = 0, comes out as nan.

    >>> screen_points(np.array([[0.0, 2.0, 0.0, 2.0], [0.0, 2.0, 0.0, -2.0]]), 8, 4)
    (array([4., 4.]), array([4., 0.]), array([ 2., -2.]))
    """
    x, y, _, w = clip.T.astype(float)
    least = CAMERA_PLANE * np.maximum(np.abs(x), np.abs(y))
    w = np.where(np.abs(w) < least, np.where(w < 0, -least, least), w)
    return (x / w + 1) * (width / 2), (y / w + 1) * (height / 2), w


def cull_back_faces(x, y, w, faces):  # exercise 2.10 (2 points)
    """The faces (F', 3) that turn their front to the camera, in their order.

    x, y, w (V,) of `screen_points`, faces (F, 3). Of a face in front of the camera, the front is
    seen if it is counter-clockwise on screen; each vertex behind the camera (w < 0) turns that
    over. A face without area goes, too.

    >>> x, y, w = np.array([0.0, 2.0, 0.0]), np.array([0.0, 0.0, 2.0]), np.ones(3)
    >>> cull_back_faces(x, y, w, np.array([[0, 1, 2], [0, 2, 1]]))
    array([[0, 1, 2]])
    """
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[area * np.sign(w[faces]).prod(-1) > 0]


def half_planes(x, y, w):  # exercise 2.11 (4 points)
    """Eq. (4) without its positive factors: n_x, n_y, from_x, from_y, each (3, F), such that

        c_k >= 0   <=>   e = n_x[k] (x - from_x[k]) + n_y[k] (y - from_y[k]) >= 0.

    x, y, w (3, F), finite: the faces' corners, row k of vertex k. (n_x[k], n_y[k]) is n of eq. (1)
    of the edge opposite to vertex k, times the sign of w_k and the sign of A, which is taken of
    (x[1] - x[0]) (y[2] - y[0]) - (x[2] - x[0]) (y[1] - y[0]). So n = 0 where that is 0.
    (from_x[k], from_y[k]) is one end of that edge, the same in both faces at it: the end of greater
    |w| (the other may be near infinity), of equal ones that of smaller x, of equal x that of
    smaller y.

    >>> corners = np.array([[0.0, 4.0, 1.0], [0.0, 0.0, 2.0], [1.0, -2.0, 1.0]])
    >>> n_x, n_y, from_x, from_y = half_planes(*corners[..., None])
    >>> n_x.T, n_y.T
    (array([[-2., -2.,  0.]]), array([[-3.,  1.,  4.]]))
    >>> from_x.T, from_y.T
    (array([[4., 0., 4.]]), array([[0., 0., 0.]]))
    """
    n_x, n_y, from_x, from_y = np.empty((4, *x.shape))
    winding = np.sign((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]))
    for k, (i, j) in enumerate(EDGES):
        w_i, w_j = np.abs(w[i]), np.abs(w[j])
        before = (x[i] < x[j]) | ((x[i] == x[j]) & (y[i] <= y[j]))
        at_i = (w_i > w_j) | ((w_i == w_j) & before)
        from_x[k], from_y[k] = np.where(at_i, x[i], x[j]), np.where(at_i, y[i], y[j])
        sign = winding * np.sign(w[k])
        n_x[k], n_y[k] = sign * (y[i] - y[j]), sign * (x[j] - x[i])
    return n_x, n_y, from_x, from_y


def depth_slopes(x, y, z):  # exercise 2.12 (3 points)
    """Eq. (5): dz_dx, dz_dy, each (F,), with depth = z[0] + dz_dx (x - x[0]) + dz_dy (y - y[0]).

    x, y, z (3, F): the faces' corners, z after the divide; of the three, corner 0 is the one to
    measure from. Of equal z, both slopes are exactly 0. A face without area gets inf or nan;
    nothing is raised.

    >>> depth_slopes(*np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [0.5, 0.9, 0.5]])[..., None])
    (array([0.1]), array([0.]))
    """
    x1, y1, z1 = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    x2, y2, z2 = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    # dz_dx x1 + dz_dy y1 = z1 and dz_dx x2 + dz_dy y2 = z2, by Cramer's rule.
    area = x1 * y2 - x2 * y1
    return (z1 * y2 - z2 * y1) / area, (x1 * z2 - x2 * z1) / area


def can_be_seen(clip, x, y, faces):
    """Which faces have corners that are finite and not all beyond one plane of the view frustum.

    clip (V, 4); x, y (V,) of `screen_points`; faces (F, 3) -> bool (F,).
    """
    clip_x, clip_y, z, w = clip.T
    beyond = clip_x < -w, clip_x > w, clip_y < -w, clip_y > w, z < -w, z > w, w <= 0
    # Of each vertex one bit for each plane, and the last bit: 1 if it is finite.
    outcode = np.packbits([*beyond, np.isfinite(x + y + z + w)], axis=0)[0]
    k0, k1, k2 = faces.T
    return outcode[k0] & outcode[k1] & outcode[k2] == 1


def farthest_first(corners, w):
    """The corners (3, F) of faces, the one of greatest |w| swapped to the front; w (V,).

    It lies best on screen; where w is nearly 0, x, y and z / w are nearly infinite.
    """
    first, second, third = corners
    swap = np.abs(w[second]) > np.abs(w[first])
    first, second = np.where(swap, second, first), np.where(swap, first, second)
    swap = np.abs(w[third]) > np.abs(w[first])
    return np.stack([np.where(swap, third, first), second, np.where(swap, first, third)])


def rasterize_loop(clip, faces, width, height):  # exercise 2.13 (4 points)
    """Homework 2: face by face and pixel by pixel, with a z-buffer. Slow and obvious.

    clip (V, 4), faces (F, 3) -> face_index (height, width) of integers, -1 where no face is seen;
    depth (height, width), np.inf there. Only faces that `can_be_seen` count, front and back alike;
    their corners x[0], x[1], x[2] are taken in the order of `farthest_first`. If all three w of a
    face are positive, it covers only pixels in its `bounding_box`.
    At a pixel's centre (x, y), a face that covers it has for each of its `half_planes`
    e = n_x (x - from_x) + n_y (y - from_y) > 0, or e = 0 and `is_top_left(n_x, n_y)`; and a depth,
    dz_dx (x - x[0]) + (dz_dy (y - y[0]) + z[0]), from -1 (near) to 1 (far), where z is z / w of the
    corners and the slopes are those of `depth_slopes`. Of the covering faces, the one of least
    depth is seen; of equally deep ones, the first.

    >>> clip = np.array([[-1.0, -1.0, 0.5, 1.0], [1.0, -1.0, 0.5, 1.0], [-1.0, 1.0, 0.5, 1.0]])
    >>> rasterize_loop(clip, np.array([[0, 1, 2]]), 3, 2)
    (array([[ 0,  0, -1],
           [ 0, -1, -1]]), array([[0.5, 0.5, inf],
           [0.5, inf, inf]]))
    """
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    seen = np.flatnonzero(can_be_seen(clip, x, y, faces))
    corners = farthest_first(faces.T, w)
    x, y, z, w = np.stack([x, y, clip[:, 2] / w, w])[:, corners]  # (3, F) each
    planes, (dz_dx, dz_dy) = np.stack(half_planes(x, y, w)), depth_slopes(x, y, z)
    for f in seen:
        box = bounding_box(np.stack([x[:, f], y[:, f]], -1), width, height)
        x0, y0, x1, y1 = box if (w[:, f] > 0).all() else (0, 0, width, height)
        n_x, n_y, from_x, from_y = planes[:, :, f]
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            e = n_x * (j + 0.5 - from_x) + n_y * (i + 0.5 - from_y)
            if not ((e > 0) | (e == 0) & is_top_left(n_x, n_y)).all():
                continue
            d = dz_dx[f] * (j + 0.5 - x[0, f]) + (dz_dy[f] * (i + 0.5 - y[0, f]) + z[0, f])
            if -1 <= d <= 1 and d < depth[i, j]:
                face_index[i, j], depth[i, j] = f, d
    return face_index, depth


def first_column(slope, from_x, offset, width):  # exercise 2.14 (3 points)
    """The least column j with slope (j + 0.5 - from_x) + offset >= 0, as floating point decides it.

    slope (R,) > 0, from_x, offset (R,), finite -> j (R,) floats: whole numbers from 0 to width,
    width if there is none. A quotient finds the place, but is rounded differently from this sum,
    which has the last word; for |from_x| < 1e14 the two are never more than one column apart.

    >>> zero = np.zeros(3)
    >>> first_column(np.array([2.0, 2.0, 2.0]), zero, np.array([-3.0, -3.1, -99.0]), 8)
    array([1., 2., 8.])
    """
    # The crossing lies in this column: its centre is inside, or the next one's is.
    column = np.floor(from_x - offset / slope)
    column += slope * (column + 0.5 - from_x) + offset < 0
    return np.clip(column, 0, width)


def row_interval(planes, face, y, width):  # exercise 2.15 (3 points)
    """Scanline: the columns start <= j < end that a face covers on a row of pixels.

    planes: n_x, n_y, from_x, from_y of `half_planes`, each (3, F); face (R,), y (R,): a row of
    pixels, its centres at y, of face number face -> start, end (R,) floats from 0 to width,
    start >= end if nothing is covered. An edge that `is_top_left` opens the interval at the first
    column with e >= 0; any other ends it at the first column with -e >= 0, as n = 0 does at 0. So
    the top-left rule makes intervals half open. Of a horizontal edge, e is one number on the whole
    row: `first_column` is 0 or width.

    >>> corners = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 4.0], [1.0, 1.0, 1.0]])
    >>> row_interval(half_planes(*corners[..., None]), np.array([0, 0]), np.array([0.5, 2.5]), 8)
    (array([0., 0.]), array([3., 1.]))
    """
    start, end = np.zeros(len(y)), np.full(len(y), float(width))
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y).astype(float)
        sign = 2 * opens - 1  # from here on, e grows from left to right
        # Of a horizontal edge, e is offset, and so is its sign with a slope of TINY from x = 0.
        slope, from_x = np.where(n_x == 0, TINY, sign * n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset, width)
        opens = opens[face]  # 1: column is the start; 0: it is the end
        start = np.maximum(start, opens * column)
        end = np.minimum(end, opens * width + column)
    return start, end


def expand(start, count):
    """Ranges, one after the other: start [7, 0, 4], count [2, 0, 3] -> owner [0, 0, 2, 2, 2] and
    number [7, 8, 4, 5, 6].
    """
    owner = np.repeat(np.arange(len(count)), count)
    return owner, np.arange(len(owner)) + (start - (np.cumsum(count) - count))[owner]


def chunks(count):
    """Slices of count, each with a sum of at most CHUNK (or of one element that is larger)."""
    total, start = np.cumsum(count), 0
    while start < len(count):
        done = total[start - 1] if start else 0
        end = max(start + 1, np.searchsorted(total, done + CHUNK, "right"))
        yield slice(start, end)
        start = end


def sample_range(position, in_front, faces, size):
    """`bounding_box` in one direction, of all faces: first (F,), end (F,) columns (or rows).

    position (V,): x (or y) on screen, valid where in_front (V,); a face with a vertex that is not
    gets the whole range, 0 to size.
    """
    position = np.clip(position, 0, size)
    low = np.where(in_front, np.ceil(position - (0.5 + MARGIN)), 0).astype(np.int32)
    high = np.where(in_front, np.floor(position + (0.5 + MARGIN)), size).astype(np.int32)
    k0, k1, k2 = faces.T
    first = np.minimum(np.minimum(low[k0], low[k1]), low[k2])
    return first, np.maximum(np.maximum(high[k0], high[k1]), high[k2])


def spans(clip, faces, width, height):
    """The runs of pixels that faces cover on rows, the last face first; yields chunks of

    face, row, start, end (N,): columns start <= j < end of a row, and slope, from_x, offset (N,):
    the face's depth there is slope (x - from_x) + offset.
    """
    x, y, w = screen_points(clip, width, height)
    z = clip[:, 2] / w
    left, right = sample_range(x, w > 0, faces, width)
    bottom, top = sample_range(y, w > 0, faces, height)
    can_be_drawn = can_be_seen(clip, x, y, faces) & (left < right) & (bottom < top)
    drawn = np.flatnonzero(can_be_drawn)[::-1]
    for part in (drawn[part] for part in chunks((top - bottom)[drawn])):
        corners = farthest_first(faces[part].T, w)
        cx, cy, cz = x[corners], y[corners], z[corners]
        planes, (dz_dx, dz_dy) = half_planes(cx, cy, w[corners]), depth_slopes(cx, cy, cz)
        face, row = expand(bottom[part], (top - bottom)[part])
        start, end = row_interval(planes, face, row + 0.5, width)
        start, end = np.maximum(start, left[part][face]), np.minimum(end, right[part][face])
        covered = np.flatnonzero(start < end)
        face, row, start, end = face[covered], row[covered], start[covered], end[covered]
        offset = dz_dy[face] * (row + 0.5 - cy[0][face]) + cz[0][face]
        yield (part[face], row, start.astype(int), end.astype(int),
               dz_dx[face], cx[0][face], offset)


def fragments(clip, faces, width, height):
    """Every sample that every face covers: yields pixel (N,) = row * width + column, depth (N,) and
    face (N,) in chunks. The last face comes first: whoever writes last then keeps the first.
    """
    for face, row, start, end, slope, from_x, offset in spans(clip, faces, width, height):
        row_start, length = row * width, end - start
        for part in chunks(length):
            span, column = expand(start[part], length[part])
            depth = slope[part][span] * (column + 0.5 - from_x[part][span]) + offset[part][span]
            pixel, covering = row_start[part][span] + column, face[part][span]
            seen = np.abs(depth) <= 1  # between near and far
            if not seen.all():
                pixel, depth, covering = pixel[seen], depth[seen], covering[seen]
            yield pixel, depth, covering


def rasterize(clip, faces, width, height):
    """What each pixel sees: the picture of `rasterize_loop`, bit for bit, for whole meshes.

    clip (V, 4), faces (F, 3) integers from 0 to V - 1 -> face_index (height, width), -1 where no
    face is seen; depth (height, width), z/w from -1 to 1, np.inf there. Both sides of a face are
    seen. Any w, also of vertices behind the camera; faces with vertices that are not finite are
    left out.
    """
    face_index, depth = np.full(height * width, -1), np.full(height * width, np.inf)
    with np.errstate(all="ignore"):  # of faces without an area: they cover nothing
        for pixel, z, face in fragments(clip, faces, width, height):
            np.minimum.at(depth, pixel, z)
            seen = np.flatnonzero(z == depth[pixel])
            face_index[pixel[seen]] = face[seen]  # the last write stays: the first of equally deep
    return face_index.reshape(height, width), depth.reshape(height, width)


def barycentric_on_face(px, py, x, y, w):  # exercise 2.16 (3 points)
    """Eq. (5): where on its face a sample lies: b (3, N), each column with sum 1.

    px, py (N,): samples; x, y, w (3, N), where `edge_function` takes (..., 2): the corners of the
    face that each one sees, w of any sign. Weights of the vertices on the face in space, not in its
    picture: lab 5 is about the difference. To be measured from the sample, not from a corner: one
    corner may be near infinity.

    >>> x, y, w = np.array([[0.0, 8.0, 0.0], [0.0, 0.0, 8.0], [1.0, 3.0, 1.0]])[..., None]
    >>> barycentric_on_face(np.array([4.0]), np.array([2.0]), x, y, w)
    array([[0.375],
           [0.25 ],
           [0.375]])
    """
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) / w[k] for k, (i, j) in enumerate(EDGES)])
    return c / c.sum(0)


def barycentric_derivatives(px, py, x, y, w):  # exercise 2.17 (3 points)
    """The partial derivatives of b of `barycentric_on_face` by px and by py, each (3, N).

    >>> x, y, w = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])[..., None]
    >>> db_dx, db_dy = barycentric_derivatives(np.array([1.0]), np.array([0.5]), x, y, w)
    >>> db_dx.T, db_dy.T
    (array([[-0.25,  0.25,  0.  ]]), array([[-0.5,  0. ,  0.5]]))
    """
    x, y = x - px, y - py
    c, dc_dx, dc_dy = np.empty((3, *x.shape))
    for k, (i, j) in enumerate(EDGES):
        c[k] = (x[i] * y[j] - x[j] * y[i]) / w[k]
        dc_dx[k], dc_dy[k] = (y[i] - y[j]) / w[k], (x[j] - x[i]) / w[k]
    # b = c / s with s = sum c, so db = (dc - b ds) / s.
    s = c.sum(0)
    return (dc_dx - c / s * dc_dx.sum(0)) / s, (dc_dy - c / s * dc_dy.sum(0)) / s


def in_chunks(items):
    """The items, at most CHUNK of them at a time: so many rows stay in the cache."""
    for start in range(0, len(items), CHUNK):
        yield items[start:start + CHUNK]


def seen_pixels(face_index):
    """The pixels that see a face: yields row * width + column (N,), in chunks."""
    yield from in_chunks(np.flatnonzero(face_index >= 0))


def seen_corners(face_index, clip, faces):
    """The pixels that see a face: yields in chunks pixel (N,) = row * width + column, px, py (N,)
    of its centre, and the corners x, y, w (3, N) of its face.
    """
    height, width = face_index.shape
    x, y, w = screen_points(clip, width, height)
    for pixel in seen_pixels(face_index):
        corners = faces.take(face_index.reshape(-1)[pixel], 0).T.copy()  # rows side by side
        row = pixel // width
        yield pixel, pixel - row * width + 0.5, row + 0.5, x[corners], y[corners], w[corners]


def barycentrics(face_index, clip, faces):
    """Where on its face every pixel lies: barycentric (height, width, 3), 0 where no face is seen.

    face_index (height, width) of `rasterize`; clip (V, 4), faces (F, 3).
    """
    barycentric = np.zeros((face_index.size, 3))
    for pixel, *sample in seen_corners(face_index, clip, faces):
        barycentric[pixel] = barycentric_on_face(*sample).T
    return barycentric.reshape(*face_index.shape, 3)


def barycentrics_derivatives(face_index, clip, faces):
    """db/dx and db/dy of `barycentrics`, per pixel: (height, width, 3, 2), 0 where none is seen."""
    derivatives = np.zeros((face_index.size, 3, 2))
    for pixel, *sample in seen_corners(face_index, clip, faces):
        derivatives[pixel] = np.stack(barycentric_derivatives(*sample)).T
    return derivatives.reshape(*face_index.shape, 3, 2)
