"""Interpolation: what a face's corners know, seen at every pixel, in perspective.

A point is divided by its w to get on the screen. What is linear on the face is not linear there,
but A / w and 1 / w are. t and q are fractions of a segment: t on the screen, q in space.

    q = t w_0 / (t w_0 + (1 - t) w_1)                          0 at corner 0, 1 at corner 1  (1)
    A = lerp(A_0/w_0, A_1/w_1, t) / lerp(1/w_0, 1/w_1, t)      which is lerp(A_0, A_1, q)    (2)
    b_k = c_k / s,   c_k = e_k / w_k,   s = c_0 + c_1 + c_2    on the face, in space         (3)
    db_k = (dc_k - b_k (dc_0 + dc_1 + dc_2)) / s               their derivatives             (4)
    A = b_0 A_0 + b_1 A_1 + b_2 A_2                            at a pixel that sees a face   (5)
    dA/dx = db_0/dx A_0 + db_1/dx A_1 + db_2/dx A_2            and dA/dy: its footprint      (6)
    grad_A_k += b_k grad_A,   grad_b_k = grad_A . A_k          back, for each pixel          (7)
    A_pixels = B A_vertices                                    (5) for all pixels at once    (8)

e_k is any multiple of lab 2's edge function opposite to corner k. attributes (V, C) are C numbers
at each vertex. faces (F, 3) may name other vertices than those of the positions, as uv with seams
do. face_index (H, W), -1 for no face, comes from lab 2.

Source: lecture "Differentiable graphics 1".
"""
import numpy as np
import scipy.sparse

from course.given.arrays import EDGES, in_chunks, masked_scatter, scatter, write_rows
from course.given.faster import has_faster

from .rasterization import screen_points


def lerp(a, b, t):
    """Linear interpolation: what lies at the fraction t of the way from a to b?

    a, b and t have shapes that broadcast. The ends are exact: a at t = 0 and b at t = 1.

    >>> lerp(2.0, 4.0, np.array([0.0, 0.25, 1.0, 2.0]))
    array([2. , 2.5, 4. , 6. ])
    """
    return (1 - t) * a + t * b


def fraction_in_space(t, w_0, w_1):  # step 5.1
    """Eq. (1): how far along a segment in space is the point at fraction t on the screen?

    t, w_0, w_1: numbers or arrays.

    >>> fraction_in_space(np.array([0.0, 0.5, 1.0]), 1.0, 3.0)
    array([0.  , 0.25, 1.  ])
    """
    return t * w_0 / lerp(w_1, w_0, t)


def attribute_on_segment(t, a_0, a_1, w_0, w_1):  # extra 5.2 (2 points)
    """Eq. (2): the attributes seen at fractions t (N,) of a segment on the screen -> (N, C).

    Its ends have the attributes a_0, a_1 (C,), and w_0, w_1, two numbers.

    >>> attribute_on_segment(np.array([0.0, 0.5]), np.array([8.0, 0.0]), np.array([0.0, 4.0]), 1, 3)
    array([[8., 0.],
           [6., 1.]])
    """
    t = t[:, None]
    return lerp(a_0 / w_0, a_1 / w_1, t) / lerp(1 / w_0, 1 / w_1, t)


def barycentric_from_screen(e, w):  # step 5.3
    """Eq. (3): a pixel's screen weights e -> its barycentric b, corrected for perspective.

    e, w and b are (..., 3), with the w of each corner.

    >>> barycentric_from_screen(np.array([0.5, 0.5, 0.0]), np.array([1.0, 3.0, 1.0]))
    array([0.75, 0.25, 0.  ])
    """
    c = e / w
    return c / c.sum(-1, keepdims=True)


def seen_corners(face_index, faces):
    """The pixels that see a face, a part of the picture at a time: it stays in the cache.

    Yields pixel (N,) = row * width + column, and corners (3, N), the vertices of their faces.
    """
    for pixel in in_chunks(np.flatnonzero(face_index >= 0)):
        yield pixel, faces.take(face_index.take(pixel), 0).T.copy()  # contiguous rows: faster


def samples_on_faces(face_index, clip, faces):
    """The pixels that see a face and where its corners are, a part of the picture at a time.

    Yields pixel (N,) = row * width + column, its centre px, py (N,), and the corners x, y, w (3, N)
    of its face on the screen: row k of corner k.
    """
    height, width = face_index.shape
    x, y, w = screen_points(clip, width, height)
    for pixel, corners in seen_corners(face_index, faces):
        row = pixel // width
        yield (pixel, pixel - row * width + 0.5, row + 0.5,
               x.take(corners), y.take(corners), w.take(corners))


def edge_functions_at(px, py, x, y):
    """The edge functions at samples: e (3, N). px, py (N,); x, y (3, N): the corners of the face
    that each one sees.

    Measured from the sample, not from a corner: one corner may be near infinity.
    """
    x, y = x - px, y - py
    return np.stack([x[i] * y[j] - x[j] * y[i] for i, j in EDGES])


def barycentrics(face_index, clip, faces):  # exercise 5.6 (3 points)
    """Eq. (3) for a picture: where on its face, in space, does each pixel lie?

    face_index (H, W), clip (V, 4), faces (F, 3) -> barycentric (H, W, 3), 0 where no face is seen.
    Loop over the given `samples_on_faces`. It yields pixel (N,), numbered row by row, their centres
    px, py (N,), and their faces' corners x, y, w (3, N). The given `edge_functions_at` makes e
    (3, N). Fill an array (H * W, 3) at [pixel]. Step 5.3 wants e.T and w.T. See `demo bunny`.

    >>> clip = np.array([[-1.0, -1.0, 0.0, 1.0], [3.0, -3.0, 0.0, 3.0], [-1.0, 1.0, 0.0, 1.0]])
    >>> barycentrics(np.array([[0, -1]]), clip, np.array([[0, 1, 2]]))
    array([[[0.3, 0.1, 0.6],
            [0. , 0. , 0. ]]])

    Fine print. A corner may lie behind the camera, w < 0, or nearly at infinity on the screen.
    """
    barycentric = np.zeros((face_index.size, 3))
    for pixel, px, py, x, y, w in samples_on_faces(face_index, clip, faces):
        c = edge_functions_at(px, py, x, y) / w
        write_rows(barycentric, pixel, c / c.sum(0))
    return barycentric.reshape(*face_index.shape, 3)


def normalize_derivative(dc, b, s, axis=0):  # step 5.4
    """Eq. (4), the quotient rule of b = c / s, s = sum c: how b changes where c changes by dc.

    dc, b -> db. The three weights lie along the axis, and s broadcasts with them.

    >>> b, s = np.array([0.25, 0.25, 0.5]), 4.0
    >>> normalize_derivative(np.array([4.0, 0.0, 0.0]), b, s)
    array([ 0.75, -0.25, -0.5 ])
    """
    ds = dc.sum(axis, keepdims=True)
    return (dc - b * ds) / s


def normalize_backward(grad_b, b, s, axis=0):  # step 5.5
    """Backward of b = c / s, the quotient rule: grad_b -> grad_c.

    s = sum c, or in lab 7 sum c + a constant. The weights lie along the axis. s broadcasts.

    >>> normalize_backward(np.array([8.0, 0.0, 0.0]), np.array([0.25, 0.25, 0.5]), 4.0)
    array([ 1.5, -0.5, -0.5])
    """
    # By eq. (4), dL = sum_k grad_b_k (dc_k - b_k sum_j dc_j) / s. Collect the factors of each
    # dc_k. Every c_k is part of s, so corner k feels what all three weights want.
    return (grad_b - (grad_b * b).sum(axis, keepdims=True)) / s


def interpolate_pixel(attributes, corners, b):  # step 5.7
    """Eq. (5) at one pixel, a gather: attributes (V, C) of the vertices -> A (C,).

    corners (3,): the vertices of the face that it sees, b (3,): its barycentric.

    >>> attributes = np.array([[9.0, 0.0], [4.0, 1.0], [6.0, 2.0], [8.0, 3.0]])
    >>> interpolate_pixel(attributes, np.array([2, 1, 3]), np.array([0.5, 0.25, 0.25]))
    array([6., 2.])
    """
    return b @ attributes[corners]


@has_faster("sparse_weights")
def interpolate(attributes, faces, face_index, barycentric):  # exercise 5.8 (2 points)
    """Eq. (5), for all pixels at once: the picture (H, W, C) of attributes (V, C).

    faces (F, 3), face_index (H, W), barycentric (H, W, 3). The given `masked_scatter(rows, mask)`
    puts the seen pixels' rows into a picture, which is 0 elsewhere. See `demo bunny`.

    >>> faces, seen = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[1, -1]])
    >>> b = np.array([[[0.5, 0.25, 0.25], [0.0, 0.0, 0.0]]])
    >>> interpolate(np.array([[9.0], [4.0], [6.0], [8.0]]), faces, seen, b)
    array([[[6.],
            [0.]]])
    """
    seen = face_index >= 0
    corners = faces[face_index[seen]]
    mixed = (barycentric[seen][..., None] * attributes[corners]).sum(1)
    return masked_scatter(mixed, seen)


def barycentrics_derivatives(face_index, clip, faces):  # exercise 5.9 (3 points)
    """Eq. (4) for a picture: how `barycentrics` changes by a pixel to the right, and one up.

    face_index (H, W), clip (V, 4), faces (F, 3) -> db/dx, db/dy (H, W, 3, 2), 0 where no face is
    seen. e_k is of the edge from i to j, (i, j) = EDGES[k], and de_k/dx = y_i - y_j, de_k/dy =
    x_j - x_i. See `demo bunny`.

    >>> clip = np.array([[-1.0, -1.0, 0.0, 1.0], [3.0, -3.0, 0.0, 3.0], [-1.0, 1.0, 0.0, 1.0]])
    >>> barycentrics_derivatives(np.array([[0]]), clip, np.array([[0, 1, 2]]))
    array([[[[-1.5 , -1.5 ],
             [ 0.75,  0.  ],
             [ 0.75,  1.5 ]]]])

    Fine print. A corner may lie behind the camera, w < 0.
    """
    derivatives = np.zeros((face_index.size, 3, 2))
    for pixel, px, py, x, y, w in samples_on_faces(face_index, clip, faces):
        c = edge_functions_at(px, py, x, y) / w
        s = c.sum(0)
        de_dx = np.stack([y[i] - y[j] for i, j in EDGES])
        de_dy = np.stack([x[j] - x[i] for i, j in EDGES])
        for axis, de in enumerate((de_dx, de_dy)):
            write_rows(derivatives[..., axis], pixel, normalize_derivative(de / w, c / s, s))
    return derivatives.reshape(*face_index.shape, 3, 2)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """Eq. (6): dA/dx and dA/dy at each pixel (H, W, C, 2), 0 where no face is seen.

    derivatives (H, W, 3, 2): db/dx and db/dy. For A = (u, v) this is lab 6's matrix J.
    """
    # (6) is (5) with other weights.
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (0, 1))
    return np.stack([by_x, by_y], -1)


def interpolate_pixel_backward(grad, attributes, corners, b):  # step 5.10
    """Eq. (7) at one pixel, a scatter: grad (C,) -> grad_attributes (V, C), grad_b (3,).

    The backward pass of `interpolate_pixel`. A vertex that is two of the corners gets both shares.

    >>> attributes = np.array([[9.0], [4.0], [6.0], [8.0]])
    >>> corners, b = np.array([2, 1, 3]), np.array([0.5, 0.25, 0.25])
    >>> grads = interpolate_pixel_backward(np.array([8.0]), attributes, corners, b)
    >>> grads[0].T, grads[1]
    (array([[0., 2., 4., 2.]]), array([48., 32., 64.]))
    """
    grad_attributes = np.zeros(attributes.shape)
    for vertex, share in zip(corners, b, strict=True):
        grad_attributes[vertex] += share * grad
    return grad_attributes, attributes[corners] @ grad


@has_faster("sparse_weights")
def interpolate_backward(grad_output, attributes, faces, face_index,  # exercise 5.11 (3 points)
                         barycentric):
    """Eq. (7), for all pixels at once: the backward pass of `interpolate`.

    grad_output (H, W, C) -> grad_attributes (V, C), grad_barycentric (H, W, 3), 0 where no face is
    seen. The given `scatter(values, index, count)` sums what comes to a vertex from all its pixels.
    See `demo fit_triangle`.

    >>> attributes, faces = np.array([[9.0], [4.0], [6.0], [8.0]]), np.array([[2, 1, 3]])
    >>> b, grad_output = np.array([[[0.5, 0.25, 0.25]]]), np.array([[[8.0]]])
    >>> grads = interpolate_backward(grad_output, attributes, faces, np.array([[0]]), b)
    >>> grads[0].T, grads[1]
    (array([[0., 2., 4., 2.]]), array([[[48., 32., 64.]]]))
    """
    seen = face_index >= 0
    corners = faces[face_index[seen]]
    grad = grad_output[seen][:, None]  # the same for each corner
    shares = barycentric[seen][..., None] * grad
    grad_barycentric = (grad * attributes[corners]).sum(-1)
    return scatter(shares, corners, len(attributes)), masked_scatter(grad_barycentric, seen)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """Backward of eq. (6): grad_output (H, W, C, 2) -> grad_attributes, grad_derivatives.

    They have the shapes of attributes (V, C) and derivatives (H, W, 3, 2).
    """
    # (6) is (5) twice, so the attributes get the sum of both.
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return by_x[0] + by_y[0], np.stack([by_x[1], by_y[1]], -1)


def interpolation_matrix(vertex_count, faces, face_index, barycentric):
    """B of eq. (8), a sparse matrix (H W, V): a row for each pixel, counted row by row, with the
    weights of its three corners. B.T is the scatter of eq. (7).

    IndexError if a seen face names a vertex that does not exist. SciPy would read on in memory.
    """
    face = face_index.reshape(-1)
    seen = np.flatnonzero(face >= 0)
    vertex = faces.take(face[seen], 0).reshape(-1)  # copies short rows faster than faces[...]
    if len(vertex) and not 0 <= vertex.min() <= vertex.max() < vertex_count:
        raise IndexError(f"faces name rows {vertex.min()} to {vertex.max()} of the attributes, "
                         f"which have {vertex_count}: give the faces that belong to them")
    weight = barycentric.reshape(-1, 3).take(seen, 0).reshape(-1)
    start = np.append(0, np.cumsum(3 * (face >= 0)))  # row p has the entries from start[p] on
    return scipy.sparse.csr_array((weight, vertex, start), (len(face), vertex_count))
