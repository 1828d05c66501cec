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

Watertight needs two things. Two faces at an edge must compute the same e with opposite sign, to the
last bit; and e must be exactly 0 at the ends of the edge, for vertices on a pixel's centre.

Sources: Pineda 1988 (1), lecture "Differentiable graphics 1" (3)-(5), Olano and Greer 1997 (4),
GAMES101 lectures 5 and 6 and its homework 2, a rasterizer for single triangles.
"""
import numpy as np

EDGES = (1, 2), (2, 0), (0, 1)  # edge k runs from the first to the second, opposite to vertex k
CAMERA_PLANE = 1e-12  # the w of vertices with w = 0, which have no place on screen
FAR = 1e9             # pixels: an edge measured from farther away is beyond floating point
TINY = 1e-300         # stands for a slope of 0 in a division
MARGIN = 1 / 16       # pixels added to a face's bounds: far more than rounding can move an edge
CHUNK = 1 << 14       # rows of faces, then fragments, in flight at once: they stay in the cache


def edge_function(p, a, b):  # exercise 2.1 (2 points)
    """Eq. (1): on which side of the line from a to b does p lie? Positive: on its left.

    p, a, b (..., 2), shapes that broadcast -> e (...). To the last bit, unless it overflows: 0 at
    p = a and at p = b; and swapping a and b flips the sign and changes nothing else. So p is to be
    measured from the same end, whichever of the two it is called: element by element, the points
    themselves must tell.

    >>> edge_function(np.array([0.0, 1.0]), np.array([0.0, 0.0]), np.array([2.0, 0.0]))
    np.float64(2.0)
    """
    raise NotImplementedError("exercise 2.1: edge_function")


def edge_function_backward(grad_e, p, a, b):  # exercise 2.2 (2 points)
    """Backward of eq. (1): grad_e (...) -> grad_p, grad_a, grad_b, each (..., 2).

    p, a, b (..., 2), all of one shape.

    >>> p, a, b = np.array([1.0, 4.0]), np.array([0.0, 0.0]), np.array([2.0, 1.0])
    >>> edge_function_backward(np.array(1.0), p, a, b)
    (array([-1.,  2.]), array([-3., -1.]), array([ 4., -1.]))
    """
    raise NotImplementedError("exercise 2.2: edge_function_backward")


def signed_area(triangle):  # exercise 2.3 (1 point)
    """Area of triangle (..., 3, 2) -> (...): positive if counter-clockwise, negative if clockwise.

    >>> signed_area(np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]]))
    np.float64(1.0)
    """
    raise NotImplementedError("exercise 2.3: signed_area")


def is_inside(p, triangle):  # exercise 2.4 (2 points)
    """Three cross products: is p in the triangle, border included, whichever way it is wound?

    p (..., 2), triangle (3, 2) of an area other than 0 -> bool (...).

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    >>> is_inside(np.array([[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]]), triangle)
    array([ True,  True, False])
    """
    raise NotImplementedError("exercise 2.4: is_inside")


def is_top_left(n_x, n_y):  # exercise 2.5 (1 point)
    """Top-left rule: does an edge own the samples that lie exactly on it?

    n_x, n_y (...): the edge's inward normal n of eq. (1), the face counter-clockwise -> bool (...).
    A left edge does (n points right), and so does a horizontal edge below its face (n points up):
    row 0 is stored first, so in memory order this is the top edge that other texts speak of.
    n = 0, an edge without length, owns nothing.

    >>> is_top_left(np.array([1.0, -1.0, 0.0, 0.0]), np.array([-5.0, 5.0, 1.0, -1.0]))
    array([ True, False,  True, False])
    """
    raise NotImplementedError("exercise 2.5: is_top_left")


def is_covered(p, triangle):  # exercise 2.6 (3 points)
    """Eq. (2): does the counter-clockwise triangle cover the sample p?

    p (..., 2), triangle (3, 2) -> bool (...). A clockwise triangle covers nothing.

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    >>> is_covered(np.array([[0.0, 1.0], [1.0, 0.0], [2.0, 2.0]]), triangle)
    array([ True,  True, False])
    """
    raise NotImplementedError("exercise 2.6: is_covered")


def barycentric_coordinates(p, triangle):  # exercise 2.7 (2 points)
    """Eq. (3): the weights b (..., 3) with b @ triangle = p and sum b = 1.

    p (..., 2), triangle (3, 2), of either winding, of an area other than 0.

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    >>> barycentric_coordinates(np.array([1.0, 0.0]), triangle)
    array([0.75, 0.25, 0.  ])
    """
    raise NotImplementedError("exercise 2.7: barycentric_coordinates")


def bounding_box(triangle, width, height):  # exercise 2.8 (2 points)
    """The pixels that a triangle's box touches: columns x0 <= j < x1 and rows y0 <= i < y1.

    triangle (3, 2), any finite numbers -> four integers: x0 and x1 from 0 to width, y0 and y1 from
    0 to height. Columns run from the floor of the least x to the floor of the greatest x, which
    counts, as far as they lie in the picture; rows likewise. None: x0 >= x1 or y0 >= y1.

    >>> bounding_box(np.array([[0.5, -9.0], [3.0, 1.2], [2.5, 1.0]]), 8, 8)
    (0, 0, 4, 2)
    """
    raise NotImplementedError("exercise 2.8: bounding_box")


def screen_points(clip, width, height):  # exercise 2.9 (1 point)
    """Where the vertices are on screen: clip (V, 4) -> x, y, w, each (V,).

    x = (clip_x / w + 1) width / 2, and y likewise, in pixels; also where w < 0: a vertex behind
    the camera comes out mirrored. A w of 0 is replaced by CAMERA_PLANE, also in the w returned.

    >>> screen_points(np.array([[0.0, 2.0, 0.0, 2.0], [0.0, 2.0, 0.0, -2.0]]), 8, 4)
    (array([4., 4.]), array([4., 0.]), array([ 2., -2.]))
    """
    raise NotImplementedError("exercise 2.9: screen_points")


def cull_back_faces(x, y, w, faces):  # exercise 2.10 (2 points)
    """The faces (F', 3) that turn their front to the camera, in their order.

    x, y, w (V,) of `screen_points`, faces (F, 3). Of a face in front of the camera, the front is
    seen if it is counter-clockwise on screen; each vertex behind the camera (w < 0) turns that
    over. A face without area goes, too.

    >>> x, y, w = np.array([0.0, 2.0, 0.0]), np.array([0.0, 0.0, 2.0]), np.ones(3)
    >>> cull_back_faces(x, y, w, np.array([[0, 1, 2], [0, 2, 1]]))
    array([[0, 1, 2]])
    """
    raise NotImplementedError("exercise 2.10: cull_back_faces")


def half_planes(x, y, w):  # exercise 2.11 (4 points)
    """Eq. (4) without its positive factors: n_x, n_y, from_x, from_y, each (3, F), such that

        c_k >= 0   <=>   e = n_x[k] (x - from_x[k]) + n_y[k] (y - from_y[k]) >= 0.

    x, y, w (3, F), finite: the faces' corners, row k of vertex k. (n_x[k], n_y[k]) is n of eq. (1)
    of the edge opposite to vertex k, times the signs of A (`signed_area`) and of w_k.
    (from_x[k], from_y[k]) is one end of that edge, the same in both faces at it: the end of greater
    |w| (the other may be near infinity), of equal ones that of smaller x.
    n = 0 where A = 0, where A overflows, and where |from_x| or |from_y| is FAR or more.

    >>> corners = np.array([[0.0, 4.0, 1.0], [0.0, 0.0, 2.0], [1.0, -2.0, 1.0]])
    >>> n_x, n_y, from_x, from_y = half_planes(*corners[..., None])
    >>> n_x.T, n_y.T
    (array([[-2., -2.,  0.]]), array([[-3.,  1.,  4.]]))
    >>> from_x.T, from_y.T
    (array([[4., 0., 4.]]), array([[0., 0., 0.]]))
    """
    raise NotImplementedError("exercise 2.11: half_planes")


def depth_slopes(x, y, z):  # exercise 2.12 (3 points)
    """Eq. (5): dz_dx, dz_dy, each (F,), with depth = z[0] + dz_dx (x - x[0]) + dz_dy (y - y[0]).

    x, y, z (3, F): the faces' corners, z after the divide. Of equal z, both are exactly 0. A face
    without area gets inf or nan; nothing is raised.

    >>> depth_slopes(*np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [0.5, 0.9, 0.5]])[..., None])
    (array([0.1]), array([0.]))
    """
    raise NotImplementedError("exercise 2.12: depth_slopes")


def rasterize_loop(clip, faces, width, height):  # exercise 2.13 (4 points)
    """Homework 2: face by face and pixel by pixel, with a z-buffer. Slow and obvious.

    clip (V, 4), faces (F, 3) -> face_index (height, width) of integers, -1 where no face is seen;
    depth (height, width), np.inf there. Front and back of a face are seen alike. At a pixel's
    centre (x, y), a face that covers it has for each of its `half_planes`
    e = n_x (x - from_x) + n_y (y - from_y) > 0, or e = 0 and `is_top_left(n_x, n_y)`; and a depth,
    dz_dx (x - x[0]) + (dz_dy (y - y[0]) + z[0]), from -1 (near) to 1 (far), where z is z / w of the
    corners and the slopes are those of `depth_slopes`. Of the covering faces, the one of least
    depth is seen; of equally deep ones, the first. A face with a corner that is not finite covers
    nothing. If every w > 0, a look at the pixels in its `bounding_box` is enough.
    """
    raise NotImplementedError("exercise 2.13: rasterize_loop")


def first_column(slope, from_x, offset, width):  # exercise 2.14 (3 points)
    """The least column j with slope (j + 0.5 - from_x) + offset >= 0, as floating point decides it.

    slope (R,) >= 0, from_x, offset (R,) -> j (R,) floats: whole numbers from 0 to width, width if
    there is none. Where slope = 0, the answer is 0 or width. The quotient -offset / slope finds the
    place, but is rounded differently from the sum, which has the last word; for |from_x| < FAR the
    two are never more than one column apart.

    >>> zero = np.zeros(4)
    >>> first_column(np.array([2.0, 2.0, 0.0, 0.0]), zero, np.array([-3.0, -3.1, -1.0, 0.0]), 8)
    array([1., 2., 8., 0.])
    """
    raise NotImplementedError("exercise 2.14: first_column")


def row_interval(planes, face, y, width):  # exercise 2.15 (3 points)
    """Scanline: the columns start <= j < end that a face covers on a row of pixels.

    planes: n_x, n_y, from_x, from_y of `half_planes`, each (3, F); face (R,), y (R,): a row of
    pixels, its centres at y, of face number face -> start, end (R,) floats from 0 to width,
    start >= end if nothing is covered. An edge that `is_top_left` opens the interval at the first
    column with e >= 0; any other ends it at the first column with -e >= 0, as n = 0 does at 0. So
    the top-left rule makes intervals half open.

    >>> corners = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 4.0], [1.0, 1.0, 1.0]])
    >>> row_interval(half_planes(*corners[..., None]), np.array([0, 0]), np.array([0.5, 2.5]), 8)
    (array([0., 0.]), array([3., 1.]))
    """
    raise NotImplementedError("exercise 2.15: row_interval")


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


def sample_range(position, in_front, corners, size):
    """First and last + 1 of the rows (or columns) whose centres lie within each face's bounds.

    position (V,): y / w (or x / w) in pixels, valid where in_front (V,); a face with a vertex that
    is not gets the whole range. corners (3, F) -> first, end (F,), end <= first for none.
    """
    position = np.clip(position, 0, size)
    low = np.where(in_front, np.ceil(position - (0.5 + MARGIN)), 0).astype(int)
    high = np.where(in_front, np.floor(position + (0.5 + MARGIN)), size).astype(int)
    first, second, third = (low[k] for k in corners)
    start = np.maximum(np.minimum(np.minimum(first, second), third), 0)
    first, second, third = (high[k] for k in corners)
    return start, np.minimum(np.maximum(np.maximum(first, second), third), size)


def visible_rows(clip, x, y, faces, width, height):
    """The rows of pixels that each face may cover: first (F,), count (F,), 0 if it can't be seen.

    clip (V, 4), x, y (V,) on screen. A face can't be seen if all its vertices lie beyond one plane
    of the view frustum, if one is not finite, or if it passes between the pixel centres.
    """
    clip_x, clip_y, z, w = clip.T
    beyond = [clip_x < -w, clip_x > w, clip_y < -w, clip_y > w, z < -w, z > w, w <= 0]
    beyond = np.packbits(beyond, axis=0)[0]
    broken = ~np.isfinite(x + y + z + w)
    k0, k1, k2 = corners = np.ascontiguousarray(faces.T)
    hidden = (beyond[k0] & beyond[k1] & beyond[k2] > 0) | broken[k0] | broken[k1] | broken[k2]
    column, end_column = sample_range(x, w > 0, corners, width)
    row, end_row = sample_range(y, w > 0, corners, height)
    hidden |= end_column <= column
    return row, np.where(hidden, 0, np.maximum(end_row - row, 0))


def fragments(clip, faces, width, height):
    """Every sample that every face covers: yields pixel (N,) = row * width + column, depth (N,) and
    face (N,) in chunks. The last face comes first: whoever writes last then keeps the first.
    """
    x, y, w = screen_points(clip, width, height)
    z = clip[:, 2] / w
    first, count = visible_rows(clip, x, y, faces, width, height)
    order = np.flatnonzero(count)[::-1]
    for drawn in (order[part] for part in chunks(count[order])):
        corners = faces[drawn].T
        cx, cy, cz = x[corners], y[corners], z[corners]
        planes = half_planes(cx, cy, w[corners])
        dz_dx, dz_dy = depth_slopes(cx, cy, cz)
        face, row = expand(first[drawn], count[drawn])
        start, end = row_interval(planes, face, row + 0.5, width)
        covered = np.flatnonzero(end > start)
        face, row, start, end = face[covered], row[covered], start[covered], end[covered]
        slope, from_x = dz_dx[face], cx[0][face]
        offset = dz_dy[face] * (row + 0.5 - cy[0][face]) + cz[0][face]
        face, row, length = drawn[face], row * width, (end - start).astype(int)
        for run in chunks(length):
            owner, column = expand(start[run], length[run])
            pixel = row[run][owner] + column.astype(int)
            distance = column + 0.5 - from_x[run][owner]
            depth = slope[run][owner] * distance + offset[run][owner]
            kept = np.flatnonzero(np.abs(depth) <= 1)  # between near and far
            yield pixel[kept], depth[kept], face[run][owner[kept]]


def rasterize(clip, faces, width, height):
    """What each pixel sees: the picture of `rasterize_loop`, bit for bit, for whole meshes.

    clip (V, 4), faces (F, 3) integers below V -> face_index (height, width), -1 where no face is
    seen; depth (height, width), z/w from -1 to 1, np.inf there. Any w, also of vertices behind the
    camera; faces with vertices that are not finite are left out.
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
    picture: lab 5 is about the difference.
    """
    raise NotImplementedError("exercise 2.16: barycentric_on_face")


def barycentric_derivatives(px, py, x, y, w):  # exercise 2.17 (3 points)
    """The partial derivatives of b of `barycentric_on_face` by px and by py, each (3, N)."""
    raise NotImplementedError("exercise 2.17: barycentric_derivatives")


def seen_corners(face_index, clip, faces):
    """The pixels that see a face: yields in chunks pixel (N,) = row * width + column, px, py (N,)
    of its centre, and the corners x, y, w (3, N) of its face.
    """
    height, width = face_index.shape
    x, y, w = screen_points(clip, width, height)
    seen = np.flatnonzero(face_index >= 0)
    for pixel in (seen[start:start + CHUNK] for start in range(0, len(seen), CHUNK)):
        corners = faces[face_index.reshape(-1)[pixel]].T
        row, column = np.divmod(pixel, width)
        yield pixel, column + 0.5, row + 0.5, x[corners], y[corners], w[corners]


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
