"""Rasterization: which face does each pixel see, how deep, and where on the face?

Screen space: x right, y up; pixel [row i, column j] is sampled at its centre (j + 0.5, i + 0.5).

    e(p) = det [x y 1; x0 y0 1; x1 y1 1] = n . (p - p0),   n = (y0 - y1, x1 - x0)            (1)
    covered  <=>  every e_k > 0, or e_k = 0 on an edge that the top-left rule owns           (2)
    b_k = e_k / 2A,   2A = e_0 + e_1 + e_2;   e_k is of the edge opposite to vertex k        (3)

With perspective, w_k of clip space decides what is seen; it may be negative, behind the camera:

    c_k = e_k / (2A w_k),   seen  <=>  every c_k >= 0                                        (4)
    1/w = sum c_k,   z/w = sum z_k c_k (linear in x and y),   b_k = c_k / sum c              (5)

c is M^-1 (x, y, 1), where column k of M is w_k (x_k, y_k, 1): row k of M^-1 is the edge function
opposite to vertex k, divided by 2A w_k (edge functions, face_inv and this inverse are one thing).
So a face, whether it crosses the camera plane or not, is an intersection of three half-planes, and
on each row of pixels an interval; nothing needs to be clipped before.

Watertight: two faces at an edge compute the same e with opposite sign, to the last bit, and e is
exactly 0 at the ends of the edge. So no sample is lost between them and none counted twice.

Sources: Pineda 1988 (1), lecture "Differentiable graphics 1" (3)-(5), Olano and Greer 1997 (4),
GAMES101 lectures 5 and 6 and homework 2.
"""
import numpy as np

EDGES = (1, 2), (2, 0), (0, 1)  # edge k runs from the first to the second, opposite to vertex k
CAMERA_PLANE = 1e-12  # the w of vertices with w = 0, which have no place on screen
FAR = 1e9             # pixels: an edge with both ends farther away is beyond floating point
TINY = 1e-300         # slope of a horizontal edge: it meets a row far out, not at 0/0
MARGIN = 1 / 16       # pixels added to a face's bounds: far more than rounding can move an edge
CHUNK = 1 << 14       # rows of faces, then fragments, in flight at once: they stay in the cache


def edge_function(p, a, b):  # exercise 2.1 (2 points)
    """Eq. (1): on which side of the line from a to b does p lie? Positive: on its left.

    p, a, b (..., 2), shapes that broadcast -> e (...). To the last bit, for any floats: 0 at p = a
    and at p = b; and swapping a and b flips the sign and changes nothing else. So measure from the
    same end in both cases.

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

    triangle (3, 2) in screen space -> four integers x0, y0, x1, y1, within the picture. The pixels
    are those of the floors of the box's least and greatest coordinate and all between; where the
    box lies outside the picture, x0 >= x1 or y0 >= y1.

    >>> bounding_box(np.array([[0.5, -9.0], [3.0, 1.2], [2.5, 1.0]]), 8, 8)
    (0, 0, 4, 2)
    """
    raise NotImplementedError("exercise 2.8: bounding_box")


def screen_points(clip, width, height):  # exercise 2.9 (1 point)
    """Where the vertices are on screen: clip (V, 4) -> x, y, w, each (V,).

    x, y in pixels after the divide by w, also where w < 0: such a vertex, behind the camera, comes
    out mirrored. A w of 0 is taken for CAMERA_PLANE.

    >>> screen_points(np.array([[0.0, 2.0, 0.0, 2.0], [0.0, 2.0, 0.0, -2.0]]), 8, 4)
    (array([4., 4.]), array([4., 0.]), array([ 2., -2.]))
    """
    raise NotImplementedError("exercise 2.9: screen_points")


def cull_back_faces(x, y, w, faces):  # exercise 2.10 (2 points)
    """The faces (F', 3) that turn their front to the camera, in their order.

    x, y, w (V,) of `screen_points`, faces (F, 3). Of a face in front of the camera, the front is
    seen if it is counter-clockwise on screen. Each vertex behind the camera (w < 0) turns it over.

    >>> x, y, w = np.array([0.0, 2.0, 0.0]), np.array([0.0, 0.0, 2.0]), np.ones(3)
    >>> cull_back_faces(x, y, w, np.array([[0, 1, 2], [0, 2, 1]]))
    array([[0, 1, 2]])
    """
    raise NotImplementedError("exercise 2.10: cull_back_faces")


def half_planes(x, y, w):  # exercise 2.11 (4 points)
    """Eq. (4) up to positive factors: c_k >= 0  <=>  a_k (x - x0_k) + b_k (y - y0_k) >= 0.

    x, y, w (3, F): the faces' corners, row k of vertex k -> a, b, x0, y0, each (3, F).
    (a_k, b_k) is plus or minus n of eq. (1) of the edge opposite to vertex k, by the sign of A w_k;
    0 if A = 0 or not finite. (x0_k, y0_k) is the end of the edge that its two faces agree on: the
    one of greater |w|, of equal ones the one of smaller x (if x is equal, too, either will do).
    An edge whose x0 or y0 is beyond FAR gets a = b = 0, too: of its faces, nothing is seen.

    >>> corners = np.array([[0.0, 4.0, 1.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
    >>> a, b, x0, y0 = half_planes(*corners[..., None])
    >>> a.T, b.T
    (array([[-2.,  2.,  0.]]), array([[-3., -1.,  4.]]))
    >>> x0.T, y0.T
    (array([[1., 0., 0.]]), array([[2., 0., 0.]]))
    """
    raise NotImplementedError("exercise 2.11: half_planes")


def depth_plane(x, y, z):  # exercise 2.12 (3 points)
    """Eq. (5): a, b, each (F,), such that depth = z/w = z_0 + a (x - x_0) + b (y - y_0) on a face.

    x, y, z (3, F): the faces' corners, z after the divide. Of equal z, a = b = 0 exactly.

    >>> depth_plane(*np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [0.5, 0.9, 0.5]])[..., None])
    (array([0.1]), array([0.]))
    """
    raise NotImplementedError("exercise 2.12: depth_plane")


def rasterize_loop(clip, faces, width, height):  # exercise 2.13 (4 points)
    """Homework 2: face by face and pixel by pixel, with a z-buffer. Slow and obvious.

    clip (V, 4), faces (F, 3) -> face_index (height, width) of integers, -1 where no face is seen;
    depth (height, width), np.inf there. At the pixel's centre, a face that covers it has for each
    of its `half_planes` e = a (x - x0) + b (y - y0) > 0, or e = 0 and `is_top_left(a, b)`; and its
    depth a (x - x_0) + (b (y - y_0) + z_0), with a and b of `depth_plane`, lies from -1 (near) to
    1 (far). The covering face of least depth is seen; of equally deep ones, the first. If every
    w > 0, only pixels in the `bounding_box` can be covered. A face with a corner that is not finite
    covers nothing.
    """
    raise NotImplementedError("exercise 2.13: rasterize_loop")


def first_column(a, x0, offset, width):  # exercise 2.14 (3 points)
    """The least column j with a (j + 0.5 - x0) + offset >= 0, as floating point decides it.

    a (R,) >= 0, x0, offset (R,) -> j (R,) floats: whole numbers from 0 to width, width if there is
    none. Where a = 0 the answer is 0 or width. The quotient -offset / a finds the place, but it is
    rounded differently from the sum: the sum has the last word.

    >>> zero = np.zeros(3)
    >>> first_column(np.array([2.0, 2.0, 0.0]), zero, np.array([-3.0, -3.1, -1.0]), 8)
    array([1., 2., 8.])
    """
    raise NotImplementedError("exercise 2.14: first_column")


def row_interval(planes, face, y, width):  # exercise 2.15 (3 points)
    """Scanline: the columns start <= j < end that a face covers on a row of pixels.

    planes: a, b, x0, y0 of `half_planes`, each (3, F); face (R,), y (R,): a row of pixels, its
    centres at y, of face number face -> start, end (R,) floats from 0 to width, start >= end if
    nothing is covered. An edge that `is_top_left` opens the interval at the first column with
    e >= 0, any other ends it at the first column with -e >= 0, e = a (x - x0) + b (y - y0): the
    top-left rule makes intervals half open.
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
    face (N,) in chunks. The last face comes first.
    """
    x, y, w = screen_points(clip, width, height)
    z = clip[:, 2] / w
    first, count = visible_rows(clip, x, y, faces, width, height)
    order = np.flatnonzero(count)[::-1]
    for drawn in (order[part] for part in chunks(count[order])):
        corners = faces[drawn].T
        cx, cy, cz = x[corners], y[corners], z[corners]
        planes = half_planes(cx, cy, w[corners])
        a, b = depth_plane(cx, cy, cz)
        face, row = expand(first[drawn], count[drawn])
        start, end = row_interval(planes, face, row + 0.5, width)
        covered = np.flatnonzero(end > start)
        face, row, start, end = face[covered], row[covered], start[covered], end[covered]
        a, x0 = a[face], cx[0][face]
        offset = b[face] * (row + 0.5 - cy[0][face]) + cz[0][face]
        face, row, length = drawn[face], row * width, (end - start).astype(int)
        for run in chunks(length):
            owner, column = expand(start[run], length[run])
            pixel = row[run][owner] + column.astype(int)
            depth = a[run][owner] * (column + 0.5 - x0[run][owner]) + offset[run][owner]
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

    px, py (N,): samples; x, y, w (3, N): the corners of the face that each one sees. Weights of the
    vertices on the face in space, not in its picture: lab 5 is about the difference.
    """
    raise NotImplementedError("exercise 2.16: barycentric_on_face")


def barycentric_derivatives(px, py, x, y, w):  # exercise 2.17 (3 points)
    """What a step of one pixel does to b of `barycentric_on_face`: db/dx and db/dy, each (3, N)."""
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
