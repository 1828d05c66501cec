"""The rasterizer's backward pass: lab 7's vertex gradients for whole meshes, no matrix inverted.

A pixel at (X, Y) in ndc sees a face with corners (x, y, w) in clip space. Measured from the pixel,
the corners are q_k = (x - X w, y - Y w, w), the columns of M, and the pixel is a = (0, 0, 1). The
weights on the face are the same for c = M^-1 a and for e = det(M) c:

    e_k = (q_i x q_j) . a,   (i, j) = (1, 2), (2, 0), (0, 1) for k = 0, 1, 2                     (7)
    b = e / d,   db/dX = (e_X - b sum e_X) / d,   s = sum e,   d = s + sign(s) epsilon           (8)
    e_k = x_i y_j - y_i x_j,    x and y of the q_k: it is (7), as a = (0, 0, 1)                  (9)
    depth = z^T M^-1 a,         z in clip space                                                 (10)

The q_i x q_j are the rows of det(M) M^-1, so the e_k are lab 2's edge functions, and e_X and e_Y
are x and y of the q_i x q_j. A vertex's w is in all parts of q_k.

All N pixels are done at once: x, y, w (3, N), a row for each corner, and M (3, 3, N). Each pixel
has gradients for its three corners, and each vertex sums what comes from all pixels that see it.
epsilon is 0 here. nvdiffrast uses 1e-6, in its backward pass only.

Source: nvdiffrast's conventions; Laine et al. 2020.
"""
import numpy as np

from course.given.arrays import EDGES

from .interpolation import normalize_backward, seen_corners


def cross(p, q):
    """The cross products of p and q (3, ...) -> (3, ...). np.cross takes longer."""
    return np.stack([p[1] * q[2] - p[2] * q[1],
                     p[2] * q[0] - p[0] * q[2],
                     p[0] * q[1] - p[1] * q[0]])


def faces_from_pixels(face_index, clip, faces):
    """The corners q_k for each pixel that sees a face, in chunks.

    face_index (H, W), clip (V, 4), faces (F, 3). Yields pixel (N,) = row * W + column; vertex
    (3, N), the corners' numbers; centre X, Y, (N,) each; corners x, y, w, (3, N) each.
    """
    height, width = face_index.shape
    X_of, Y_of = ((2 * np.arange(size) + 1) / size - 1 for size in (width, height))
    clip_x, clip_y, _, clip_w = np.array(clip.T, float, order="C")  # contiguous rows: faster
    for pixel, vertex in seen_corners(face_index, faces):
        row = pixel // width
        X, Y = X_of.take(pixel - row * width), Y_of.take(row)
        w = clip_w.take(vertex)
        yield pixel, vertex, (X, Y), (clip_x.take(vertex) - X * w, clip_y.take(vertex) - Y * w, w)


def edge_normals(corners):
    """Eq. (7): the edge functions of faces, as edges (3, 3, ...): edges[k] is q_i x q_j.

    corners (3, 3, ...): the matrices M, so corners[:, k] is q_k. The result is det(M) M^-1, and
    exists even where det(M) = 0.

    >>> edge_normals(np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]]))
    array([[-1., -2.,  4.],
           [ 2.,  0.,  0.],
           [ 0.,  2.,  0.]])
    """
    return np.stack([cross(corners[:, i], corners[:, j]) for i, j in EDGES])


def edge_normals_backward(grad_edges, corners):
    """Backward of `edge_normals`: grad_edges (3, 3, ...) -> grad_corners (3, 3, ...).

    >>> corners = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> grad_edges = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    >>> edge_normals_backward(grad_edges, corners)  # edges[0, 0] = y_1 w_2 - w_1 y_2
    array([[ 0. ,  0. ,  0. ],
           [ 0. ,  1. , -0.5],
           [ 0. , -2. ,  0. ]])
    """
    # g . (p x q) = p . (q x g) = q . (g x p)
    grad_corners = np.zeros(np.shape(corners))
    for g, (i, j) in zip(grad_edges, EDGES, strict=True):
        grad_corners[:, i] += cross(corners[:, j], g)
        grad_corners[:, j] += cross(g, corners[:, i])
    return grad_corners


def padded_sum(e, epsilon):
    """d of eq. (8): e (3, N) -> (N,). epsilon >= 0 makes |s| larger, whatever the sign of s.

    A face without area has s = 0. Its d is infinity, so that its gradient is 0.
    """
    s = e.sum(0)
    s = s + np.copysign(epsilon, s)
    return np.where(s == 0, np.inf, s)


def edge_functions_at_backward(grad_e, x, y):  # step 7.7
    """Backward of eq. (9): grad_e (3, N) -> grad_x, grad_y (3, N).

    x, y (3, N), row k of corner k, measured from the pixel. Each corner is in two of the e_k. The
    given `cross` may help.

    >>> x, y = np.array([[1.0], [2.0], [5.0]]), np.array([[3.0], [7.0], [4.0]])
    >>> grad_x, grad_y = edge_functions_at_backward(np.array([[1.0], [0.0], [0.0]]), x, y)
    >>> grad_x.T, grad_y.T + 0.0  # e_0 = x_1 y_2 - y_1 x_2
    (array([[ 0.,  4., -7.]]), array([[ 0., -5.,  2.]]))
    """
    raise NotImplementedError("exercise 7.7: edge_functions_at_backward")


def barycentrics_backward(grad_barycentric, face_index, clip, faces,  # exercise 7.8 (5 points)
                          epsilon=0.0):
    """Backward of lab 5's `barycentrics`: grad_barycentric (H, W, 3) -> grad_clip (V, 4).

    face_index (H, W), clip (V, 4), faces (F, 3). The given `faces_from_pixels` yields x, y, w of
    the q_k, and `padded_sum` is d of eq. (8). Go back from b to e, as in step 5.5, then to x and y.
    From there, `add_to_vertices` adds to an array (4, V). See `demo fit_triangle`.

    >>> clip = np.array([[-1.0, -1.0, 0.0, 2.0], [4.0, -2.0, 0.0, 4.0], [1.0, 2.0, 0.0, 2.0]])
    >>> grad_b = np.array([[[5.0, 0.0, 0.0], [98.0, 0.0, 0.0]]])  # two pixels, X = -1/2 and 1/2
    >>> seen, faces = np.array([[-1, 0]]), np.array([[0, 1, 2]])  # b = (2, 2, 3) / 7 in the second
    >>> barycentrics_backward(grad_b, seen, clip, faces).round(9) + 0.0
    array([[ 8.,  4.,  0., -4.],
           [ 8.,  4.,  0., -4.],
           [12.,  6.,  0., -6.]])
    """
    raise NotImplementedError("exercise 7.8: barycentrics_backward")


def add_to_vertices(grad_clip, vertex, centre, grad_x, grad_y, grad_w=0.0):
    """Backward of `faces_from_pixels`: adds its corners' gradients (3, N) to grad_clip (4, V).

    vertex (3, N), centre (X, Y): as it yields them. grad_w: of the corners' own w. `scatter` makes
    a whole array for each chunk. This adds in place.
    """
    X, Y = centre
    grad_w = grad_w - X * grad_x - Y * grad_y  # as q = (x - X w, y - Y w, w)
    for axis, grad in (0, grad_x), (1, grad_y), (3, grad_w):
        np.add.at(grad_clip[axis], vertex.ravel(), grad.ravel())


def normalize_derivative_backward(grad_db, dc, b, s):
    """Backward of db/dX in eq. (8), lab 5's `normalize_derivative`: dc stands for e_X, c for e.

    grad_db, dc, b (3, N), s (N,) -> grad_dc (3, N), grad_c (3, N). Both b = c / s and s = sum c
    depend on c.
    """
    # db is linear in dc, which gives grad_dc. Where c moves, b changes by b' and s by s', and db
    # by -(sum dc) b' / s - db s' / s. The first term goes through b = c / s: -(sum dc / s) grad_dc.
    # The second one goes through s = sum c.
    grad_dc = (grad_db - (grad_db * b).sum(0)) / s
    through_s = (grad_db * ((dc - b * dc.sum(0)) / s)).sum(0)
    return grad_dc, -(dc.sum(0) * grad_dc + through_s) / s


def barycentrics_derivatives_backward(grad_derivatives, face_index, clip, faces, epsilon=0.0):
    """Backward of lab 5's `barycentrics_derivatives`: grad_derivatives (H, W, 3, 2) -> grad_clip
    (V, 4). Axis 2: which weight, axis 3: x or y in pixels. The rest as in `barycentrics_backward`.
    """
    height, width = face_index.shape
    grad_clip = np.zeros((4, len(clip)))
    for pixel, vertex, centre, corners in faces_from_pixels(face_index, clip, faces):
        corners = np.stack(corners)
        edges = edge_normals(corners)  # of each edge e_X, e_Y and, as a = (0, 0, 1), e
        d = padded_sum(edges[:, 2], epsilon)
        b = edges[:, 2] / d
        grad_edges = np.zeros(edges.shape)
        grad_b_xy = grad_derivatives.reshape(-1, 3, 2).take(pixel, 0).T.copy()
        for axis, step in enumerate((2 / width, 2 / height)):  # a pixel in ndc
            grad_edges[:, axis], by_e = normalize_derivative_backward(
                step * grad_b_xy[axis], edges[:, axis], b, d)
            grad_edges[:, 2] += by_e
        add_to_vertices(grad_clip, vertex, centre, *edge_normals_backward(grad_edges, corners))
    return grad_clip.T


def inverses(corners):
    """M^-1 of faces: corners (3, 3, F) -> (3, 3, F), 0 for a face without area.

    A determinant is a product of three numbers: corners may have sizes from 1e-100 to 1e100.
    """
    e = edge_normals(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    return e / np.where(det == 0, np.inf, det)


def depth_backward(grad_depth, face_index, clip, faces):
    """Backward of the depth that lab 2's `rasterize` gives: grad_depth (H, W) -> grad_clip (V, 4).

    face_index (H, W), clip (V, 4), faces (F, 3). By eq. (10) depth is a residual (2) with z for r,
    so its backward pass is eq. (4), here with a = (0, 0, 1), and z has a gradient, too.

    >>> clip = np.array([[-1.0, -1.0, 1.0, 1.0], [3.0, -1.0, 2.0, 1.0], [-1.0, 3.0, 3.0, 1.0]])
    >>> depth_backward(np.array([[8.0]]), np.array([[0]]), clip, np.array([[0, 1, 2]]))
    array([[-1. , -2. ,  4. , -7. ],
           [-0.5, -1. ,  2. , -3.5],
           [-0.5, -1. ,  2. , -3.5]])
    """
    grad_clip = np.zeros((4, len(clip)))
    for pixel, vertex, centre, corners in faces_from_pixels(face_index, clip, faces):
        inverse = inverses(np.stack(corners))
        z = clip[:, 2].take(vertex)
        grad_z = grad_depth.take(pixel) * inverse[:, 2]  # c = M^-1 a
        slope = (z[:, None] * inverse).sum(0)
        add_to_vertices(grad_clip, vertex, centre, *(-slope[:, None] * grad_z))
        np.add.at(grad_clip[2], vertex.ravel(), grad_z.ravel())
    return grad_clip.T


def rasterize_backward(grad_barycentric, grad_derivatives, grad_depth, face_index, clip, faces,
                       epsilon=0.0):
    """The rasterizer's whole backward pass -> grad_clip (V, 4).

    grad_barycentric (H, W, 3). grad_derivatives (H, W, 3, 2) or None. grad_depth (H, W) or None.
    """
    if grad_barycentric.any():
        grad_clip = barycentrics_backward(grad_barycentric, face_index, clip, faces, epsilon)
    else:  # as of a silhouette, where all faces have one colour
        grad_clip = np.zeros(clip.shape)
    if grad_derivatives is not None:
        grad_clip += barycentrics_derivatives_backward(grad_derivatives, face_index, clip, faces,
                                                       epsilon)
    if grad_depth is not None:
        grad_clip += depth_backward(grad_depth, face_index, clip, faces)
    return grad_clip
