"""Rasterization: which face does each pixel see, where on the face, and how deep?

Screen space: x right, y up; pixel [row i, column j] is sampled at its centre (j + 0.5, i + 0.5).

    e(p) = det [x y 1; x0 y0 1; x1 y1 1] = n . (p - p0),   n = (y0 - y1, x1 - x0)            (1)
    covered  <=>  every e_k > 0, or e_k = 0 on an edge that the top-left rule owns           (2)
    b_k = e_k / (e_0 + e_1 + e_2),   e_k belongs to the edge opposite to vertex k            (3)

The same in clip space, without a division, so that w may have any sign. Vertex k in pixel units is
v_k = (X, Y, w) = ((x + w) width / 2, (y + w) height / 2, w), column k of a matrix M:

    e_0 = v_1 x v_2,   e_1 = v_2 x v_0,   e_2 = v_0 x v_1,   det M = v_0 . e_0               (4)
    c = M^-1 (x, y, 1);  row k of M^-1 is e_k / det M;  visible  <=>  every c_k >= 0         (5)
    1/w = sum c_k,   z/w = sum z_k c_k   (linear in x and y),   b_k = c_k / sum c            (6)

A face, clipped or not, is thus an intersection of half-planes a x + b y + c >= 0: on each row of
pixels, one interval. Swapping two vertices negates e exactly, in floating point too. Two faces that
share an edge see the same number with opposite sign, so no sample is lost and none counted twice.

Sources: Pineda 1988 (1), Olano and Greer 1997 (4)-(6), GAMES101 lectures 5 and 6 and homework 2.
"""
import numpy as np

EDGES = (1, 2), (2, 0), (0, 1)  # edge k runs from the first to the second, opposite to vertex k
TINY = 1e-300    # least slope of an edge: a horizontal one meets a row at +-infinity, not at 0/0
MARGIN = 1 / 16  # pixels added to a face's bounds: far more than rounding can move an edge
CHUNK = 1 << 14  # rows of faces, then fragments, in flight at once: they stay in the cache


def edge_function(p, a, b):  # exercise 2.1 (2 points)
    """Eq. (1): on which side of the line from a to b does p lie? Positive: on its left.

    p, a, b (..., 2), shapes that broadcast -> e (...). Swapping a and b must flip the sign and
    change nothing else, to the last bit, for any floats: two faces rely on it at their common edge.
    Add up A x + (B y + C), with A, B and C made of a and b alone.

    >>> edge_function(np.array([0.0, 1.0]), np.array([0.0, 0.0]), np.array([2.0, 0.0]))
    np.float64(2.0)
    """
    x,  y  = p[..., 0], p[..., 1]
    x0, y0 = a[..., 0], a[..., 1]
    x1, y1 = b[..., 0], b[..., 1]
    return (y0 - y1) * x + ((x1 - x0) * y + (x0 * y1 - y0 * x1))


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
    """The pixels that a triangle's box touches: columns x0 <= j < x1 and rows y0 <= i < y1.

    triangle (3, 2) in screen space -> four integers x0, y0, x1, y1, within the picture. The pixels
    are those of the floors of the box's least and greatest coordinate and all between; where the
    box lies outside the picture, x0 >= x1 or y0 >= y1.

    >>> bounding_box(np.array([[0.5, -9.0], [3.0, 1.2], [2.5, 1.0]]), 8, 8)
    (0, 0, 4, 2)
    """
    x0, y0 = np.clip(np.floor(triangle.min(0)), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0)) + 1, 0, [width, height])
    return int(x0), int(y0), int(x1), int(y1)


def to_pixels(clip, width, height):  # exercise 2.9 (1 point)
    """Homogeneous pixel coordinates: clip (V, 4) -> v (3, V), its rows X, Y and w.

    The point on screen is (X/w, Y/w), wherever w is positive.

    >>> to_pixels(np.array([[0.0, 2.0, 0.0, 2.0]]), 8, 4)
    array([[8.],
           [8.],
           [2.]])
    """
    x, y, _, w = clip.T
    return np.stack([(x + w) * (width / 2), (y + w) * (height / 2), w])


def edge_planes(v0, v1, v2):  # exercise 2.10 (3 points)
    """Eq. (4): coefficients (a, b, c) of the three edge functions, and det M.

    v0, v1, v2 (3, ...): vertices (X, Y, w) of one face or of many -> planes (3, 3, ...), where
    planes[k] = (a, b, c) belongs to the edge opposite to vertex k, and det (...).
    Exact in the sense of exercise 2.1: the same two vertices in swapped order give -a, -b, -c.

    >>> planes, det = edge_planes(*np.array([[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, 2.0, 1.0]]))
    >>> planes, det
    (array([[-2., -2.,  4.],
           [ 2.,  0.,  0.],
           [ 0.,  2.,  0.]]), np.float64(4.0))
    """
    def cross(u, v):
        return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]

    planes = np.array([cross(v1, v2), cross(v2, v0), cross(v0, v1)])
    return planes, v0[0] * planes[0, 0] + v0[1] * planes[0, 1] + v0[2] * planes[0, 2]


def cull_back_faces(clip, faces):  # exercise 2.11 (1 point)
    """The faces (F', 3) seen from the front (counter-clockwise on screen), in their order.

    clip (V, 4), faces (F, 3). det M is positive for them, whatever the signs of w; its size, and so
    the size of the picture, does not matter: (x, y, w) serves for (X, Y, w).
    """
    v0, v1, v2 = (clip[k][:, [0, 1, 3]].T for k in faces.T)
    return faces[edge_planes(v0, v1, v2)[1] > 0]


def depth_plane(planes, det, z0, z1, z2):  # exercise 2.12 (2 points)
    """Eq. (6): coefficients (a, b, c) of depth = z/w = a x + b y + c on screen.

    planes (3, 3, ...) and det (...) as `edge_planes` gives them, z0, z1, z2 (...): clip z of the
    vertices -> (3, ...).
    """
    return (z0 * planes[0] + z1 * planes[1] + z2 * planes[2]) / det


def half_planes(v, z, faces):
    """All that bounds faces on screen, and their depth: eqs. (4) to (6).

    v (3, V) of `to_pixels`, z (V,) of clip space, faces (F, 3) -> planes (P, 3, F), depth (3, F):
    coefficients (a, b, c) of a x + b y + c. The planes are the edges, positive inside, and near and
    far where a face reaches beyond them (P = 5; else P = 3). A face of no area, or one whose
    determinant overflows, gets planes that nothing satisfies.
    """
    X, Y, w = v
    corners = [(X[k], Y[k], w[k]) for k in faces.T]
    z = [z[k] for k in faces.T]
    edges, det = edge_planes(*corners)
    depth = depth_plane(edges, det, *z)
    edges *= np.where(np.isfinite(det), np.sign(det), 0)
    beyond = np.any([np.abs(z[k]) > corners[k][2] for k in range(3)], axis=0)
    if not beyond.any():
        return edges, depth
    one, limited = np.array([[0.0], [0.0], [1.0]]), np.where(beyond, depth, 0)
    return np.concatenate([edges, [one + limited, one - limited]]), depth


def rasterize_loop(clip, faces, width, height):  # exercise 2.13 (4 points)
    """Homework 2: face by face and pixel by pixel, with a z-buffer. Slow and obvious.

    clip (V, 4), faces (F, 3) -> face_index (height, width) of integers, -1 where no face is seen;
    depth (height, width), np.inf there. A face covers a pixel if each of its `half_planes` is
    positive at the pixel's centre, e = a x + (b y + c) > 0, or e = 0 and `is_top_left(a, b)`. The
    face of the least depth a x + (b y + c) is seen; of equally deep ones, the first.
    The `bounding_box` saves work, but exists only where every w > 0. Skip faces with planes that
    are not finite.
    """
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    v = to_pixels(clip, width, height)
    planes, depth_planes = half_planes(v, clip[:, 2], faces)
    for f in np.flatnonzero(np.isfinite(planes).all((0, 1))):
        X, Y, w = v[:, faces[f]]
        x0, y0, x1, y1 = 0, 0, width, height
        if (w > 0).all():
            x0, y0, x1, y1 = bounding_box(np.stack([X / w, Y / w], -1), width, height)
        a, b, c = planes[..., f].T
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = j + 0.5, i + 0.5
                e = a * x + (b * y + c)
                if ((e > 0) | (e == 0) & is_top_left(a, b)).all():
                    z = depth_planes[0, f] * x + (depth_planes[1, f] * y + depth_planes[2, f])
                    if z < depth[i, j]:
                        face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def first_column(a, offset, width):  # exercise 2.14 (3 points)
    """The least column j with a (j + 0.5) + offset >= 0, as floating point decides it.

    a (R,) >= 0, offset (R,) -> j (R,) floats: whole numbers from 0 to width, width if there is
    none. Where a = 0 the answer is 0 or width. The quotient -offset / a finds the place but is
    rounded differently from the sum: the sum has the last word.

    >>> first_column(np.array([2.0, 2.0, 0.0]), np.array([-3.0, -3.1, -1.0]), 8)
    array([1., 2., 8.])
    """
    a = np.maximum(a, TINY)
    column = np.floor(-offset / a + (0.5 - 1e-6))  # right, or one too small
    column[a * (column + 0.5) + offset < 0] += 1
    return np.clip(column, 0, width)


def row_interval(planes, face, y, width):  # exercise 2.15 (3 points)
    """Scanline: the columns start <= j < end that a face covers on a row of pixels.

    planes (P, 3, F): half-planes (a, b, c) of F faces; face (R,), y (R,): a row of pixels, its
    centres at y, of face number face -> start, end (R,) floats from 0 to width, start >= end if
    nothing is covered. A half-plane that `is_top_left` opens the interval at the first column with
    e >= 0, any other ends it at the first column with -e >= 0, e = a x + (b y + c): the top-left
    rule makes intervals half open.
    """
    start, end = np.zeros(len(y)), np.full(len(y), float(width))
    for a, b, c in planes:
        opens = is_top_left(a, b).astype(float)
        sign = 2 * opens - 1
        column = first_column((sign * a)[face], (sign * b)[face] * y + (sign * c)[face], width)
        opens = opens[face]
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


def visible_rows(v, z, corners, width, height):
    """The rows of pixels that each face may cover: first (F,), count (F,), 0 if it can't be seen.

    v (3, V) of `to_pixels`, z (V,), corners (3, F). A face can't be seen if all its vertices lie
    beyond one plane of the view frustum, if one is not finite, or if it passes between the centres.
    """
    X, Y, w = v
    beyond = [X < 0, X > width * w, Y < 0, Y > height * w, z < -w, z > w, w <= 0]
    beyond = np.packbits(beyond, axis=0)[0]
    broken = ~np.isfinite(X + Y + w + z)
    k0, k1, k2 = corners
    hidden = (beyond[k0] & beyond[k1] & beyond[k2] > 0) | broken[k0] | broken[k1] | broken[k2]
    column, end_column = sample_range(X / w, w > 0, corners, width)
    row, end_row = sample_range(Y / w, w > 0, corners, height)
    hidden |= end_column <= column
    return row, np.where(hidden, 0, np.maximum(end_row - row, 0))


def fragments(clip, faces, width, height):
    """Every sample that every face covers: yields pixel (N,) = row * width + column, depth (N,) and
    face (N,) in chunks. The last face comes first.
    """
    v, z = to_pixels(clip, width, height), np.ascontiguousarray(clip[:, 2])
    first, count = visible_rows(v, z, np.ascontiguousarray(faces.T), width, height)
    order = np.flatnonzero(count)[::-1]
    for drawn in (order[part] for part in chunks(count[order])):
        planes, depth_planes = half_planes(v, z, faces[drawn])
        face, row = expand(first[drawn], count[drawn])
        start, end = row_interval(planes, face, row + 0.5, width)
        covered = np.flatnonzero(end > start)
        face, row, start, end = face[covered], row[covered], start[covered], end[covered]
        a, b, c = depth_planes
        a, offset = a[face], b[face] * (row + 0.5) + c[face]
        face, row, length = drawn[face], row * width, (end - start).astype(int)
        for run in chunks(length):
            owner, column = expand(start[run], length[run])
            pixel = row[run][owner] + column.astype(int)
            depth = a[run][owner] * (column + 0.5) + offset[run][owner]
            yield pixel, depth, face[run][owner]


def rasterize(clip, faces, width, height):
    """What each pixel sees: the picture of `rasterize_loop`, bit for bit, for whole meshes.

    clip (V, 4), faces (F, 3) integers below V -> face_index (height, width), -1 where no face is
    seen; depth (height, width), z/w from -1 to 1, np.inf there. Any w, also of vertices behind the
    camera; faces with vertices that are not finite are left out.
    """
    face_index, depth = np.full(height * width, -1), np.full(height * width, np.inf)
    with np.errstate(all="ignore"):  # of faces without an area, of vertices with w = 0: never seen
        for pixel, z, face in fragments(clip, faces, width, height):
            np.minimum.at(depth, pixel, z)
            seen = np.flatnonzero(z == depth[pixel])
            face_index[pixel[seen]] = face[seen]  # the last write stays: the first of equally deep
    return face_index.reshape(height, width), depth.reshape(height, width)


def barycentric_on_face(planes, x, y):  # exercise 2.16 (3 points)
    """Eq. (6): where on its face a sample lies: b (3, N), each column with sum 1.

    planes (3, 3, N) of `edge_planes`, planes[k] = (a, b, c), one face for each of the samples
    x, y (N,). det M cancels, and its sign with it. Weights of the vertices on the face in space,
    not in its picture: lab 5 is about the difference.
    """
    e = planes[:, 0] * x + (planes[:, 1] * y + planes[:, 2])
    return e / e.sum(0)


def barycentric_derivatives(planes, x, y):  # exercise 2.17 (3 points)
    """How far b moves from a pixel to the next: db/dx, db/dy, each (3, N); arguments as above."""
    s = (planes[:, 0] * x + (planes[:, 1] * y + planes[:, 2])).sum(0)
    b = barycentric_on_face(planes, x, y)
    # b = e / s, so db = (de - b ds) / s with de/dx = a and de/dy = b of the plane a x + b y + c.
    db_dx = (planes[:, 0] - b * planes[:, 0].sum(0)) / s
    db_dy = (planes[:, 1] - b * planes[:, 1].sum(0)) / s
    return db_dx, db_dy


def seen_planes(face_index, clip, faces):
    """The pixels that see a face: yields in chunks pixel (N,) = row * width + column, x, y (N,) of
    its centre, and planes (3, 3, N) of its face.
    """
    height, width = face_index.shape
    X, Y, w = to_pixels(clip, width, height)
    seen = np.flatnonzero(face_index >= 0)
    for pixel in (seen[start:start + CHUNK] for start in range(0, len(seen), CHUNK)):
        corners = faces[face_index.reshape(-1)[pixel]].T
        planes, _ = edge_planes(*((X[k], Y[k], w[k]) for k in corners))
        row, column = np.divmod(pixel, width)
        yield pixel, column + 0.5, row + 0.5, planes


def barycentrics(face_index, clip, faces):
    """Where on its face every pixel lies: barycentric (height, width, 3), 0 where no face is seen.

    face_index (height, width) of `rasterize`; clip (V, 4), faces (F, 3).
    """
    barycentric = np.zeros((face_index.size, 3))
    for pixel, x, y, planes in seen_planes(face_index, clip, faces):
        barycentric[pixel] = barycentric_on_face(planes, x, y).T
    return barycentric.reshape(*face_index.shape, 3)


def barycentrics_derivatives(face_index, clip, faces):
    """db/dx and db/dy of `barycentrics`, per pixel: (height, width, 3, 2), 0 where none is seen."""
    derivatives = np.zeros((face_index.size, 3, 2))
    for pixel, x, y, planes in seen_planes(face_index, clip, faces):
        derivatives[pixel] = np.stack(barycentric_derivatives(planes, x, y)).T
    return derivatives.reshape(*face_index.shape, 3, 2)
