"""The rasterizer's backward pass: lab 7's vertex gradients for whole meshes, no matrix inverted.

q_k = (x_k, y_k, w_k) are a face's corners in clip space, M = [q_0 q_1 q_2], and a = (x, y, 1) is a
pixel in ndc. The weights b on the face are the same for c = M^-1 a and for e = det(M) c:

    e_k = (q_i x q_j) . a,   (i, j) = (1, 2), (2, 0), (0, 1) for k = 0, 1, 2                     (1)
    b = e / d,   s = sum e,   d = s + sign(s) epsilon,   db/dx = (e_x - b sum e_x) / d           (2)
    grad_(q_i x q_j) = sum of grad_e_k a over the pixels that see the face: nine numbers         (3)
    depth = z^T M^-1 a,   z in clip space                                                        (4)

The q_i x q_j are the rows of det(M) M^-1, so the e_k are lab 2's edge functions. Matrices are
(3, 3), or (3, 3, F) for many faces. epsilon is 0 here. nvdiffrast uses 1e-6, in its backward pass
only.

Source: nvdiffrast's conventions; Laine et al. 2020.
"""
import numpy as np

from .interpolation import normalize_backward
from .rasterization import EDGES, normalize_derivative, scatter, seen_pixels


def cross(p, q):
    """The cross products of p and q (3, ...) -> (3, ...). np.cross takes twice as long for this."""
    return np.stack([p[1] * q[2] - p[2] * q[1],
                     p[2] * q[0] - p[0] * q[2],
                     p[0] * q[1] - p[1] * q[0]])


def edge_functions(corners):  # extra 7.10 (2 points)
    """Eq. (1): the edge functions of faces, as edges (3, 3, ...): edges[k] is q_i x q_j.

    corners (3, 3, ...): the matrices M, so corners[:, k] is q_k. The result is det(M) M^-1, and
    exists even where det(M) = 0.

    >>> edge_functions(np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]]))
    array([[-1., -2.,  4.],
           [ 2.,  0.,  0.],
           [ 0.,  2.,  0.]])
    """
    return np.stack([cross(corners[:, i], corners[:, j]) for i, j in EDGES])


def edge_functions_backward(grad_edges, corners):  # exercise 7.11 (3 points)
    """Backward of `edge_functions`: grad_edges (3, 3, ...) -> grad_corners (3, 3, ...).

    edges[k] is q_i x q_j, and corners[:, k] is q_k. As g . (p x q) = p . (q x g), p gets q x g and
    q gets g x p. Each corner is in two edges. `cross` is given.

    >>> corners = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> grad_edges = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    >>> edge_functions_backward(grad_edges, corners)  # edges[0, 0] = y_1 w_2 - w_1 y_2
    array([[ 0. ,  0. ,  0. ],
           [ 0. ,  1. , -0.5],
           [ 0. , -2. ,  0. ]])
    """
    raise NotImplementedError("exercise 7.11: edge_functions_backward")


def padded_sum(e, epsilon):
    """d of eq. (2): e (3, N) -> (N,). epsilon >= 0 makes |s| larger, whatever the sign of s.

    A face without area has s = 0. Its d is infinity, so that its gradient is 0.
    """
    s = e.sum(0)
    s = s + np.copysign(epsilon, s)
    return np.where(s == 0, np.inf, s)


def normalize_derivative_backward(grad_db, dc, b, s):  # extra 7.15 (4 points)
    """Backward of db/dx in eq. (2), lab 2's `normalize_derivative`: dc stands for e_x, c for e.

    grad_db, dc, b (3, N), s (N,) -> grad_dc (3, N), grad_c (3, N). Both b = c / s and s = sum c
    depend on c.

    >>> dc, b = np.array([[1.0], [2.0], [5.0]]), np.array([[0.25], [0.5], [0.25]])
    >>> grad_db = np.array([[0.0], [4.0], [0.0]])
    >>> np.stack(normalize_derivative_backward(grad_db, dc, b, np.array([4.0])))[..., 0]
    array([[-0.5,  0.5, -0.5],
           [ 1.5, -0.5,  1.5]])
    """
    # db is linear in dc, which gives grad_dc. Where c moves, b changes by b' and s by s', and db
    # by -(sum dc) b' / s - db s' / s. The first term goes through b = c / s: -(sum dc / s) grad_dc.
    # The second one goes through s = sum c.
    grad_dc = normalize_backward(grad_db, b, s)
    through_s = (grad_db * normalize_derivative(dc, b, s)).sum(0)
    return grad_dc, -(dc.sum(0) * grad_dc + through_s) / s


def sum_per_face(u, x, y, face, count):
    """Eq. (3): the sums of u a^T, a = (x, y, 1), over the pixels of each face -> (K, 3, count).

    u (K, N), x (N,), y (N,). Pixel n sees face[n], with 0 <= face < count. A face that no pixel
    sees has the sum 0.

    >>> x, y = np.array([1.0, 2.0, 4.0]), np.array([0.0, 1.0, 3.0])
    >>> sum_per_face(np.array([[1.0, 10.0, 100.0]]), x, y, np.array([2, 0, 2]), 3)
    array([[[ 20.,   0., 401.],
            [ 10.,   0., 300.],
            [ 10.,   0., 101.]]])
    """
    return np.array([[np.bincount(face, u_k * x, count), np.bincount(face, u_k * y, count),
                      np.bincount(face, u_k, count)] for u_k in u])


def inverses(corners):
    """M^-1 of faces: corners (3, 3, F) -> (3, 3, F), 0 for a face without area."""
    e = edge_functions(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    return e / np.where(det == 0, np.inf, det)


def depth_planes(z, corners):  # extra 7.17 (2 points)
    """Eq. (4) as depth = planes . a: planes (3, F), one for each face.

    z (3, F) in clip space. corners (3, 3, F), with determinants other than 0. `inverses` is given.

    >>> corners = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> depth_planes(np.array([[0.0], [2.0], [1.0]]), corners[..., None]).T
    array([[1. , 0.5, 0. ]])
    """
    return (z[:, None] * inverses(corners)).sum(0)


def depth_planes_backward(grad_planes, z, corners):  # extra 7.18 (3 points)
    """Backward of `depth_planes`: grad_planes (3, F) -> grad_z (3, F), grad_corners (3, 3, F).

    It is `vertex_gradients.residual_backward` for all faces at once. grad_planes is the sum of
    grad_depth a over the pixels of each face.

    >>> corners = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> z, a = np.array([[0.0], [2.0], [1.0]]), np.array([[1.0], [0.0], [1.0]])
    >>> grad_z, grad_corners = depth_planes_backward(a, z, corners[..., None])
    >>> grad_z.T
    array([[0.75, 0.5 , 0.  ]])
    >>> grad_corners[..., 0] + 0.0
    array([[-0.75 , -0.5  ,  0.   ],
           [-0.375, -0.25 ,  0.   ],
           [ 0.   ,  0.   ,  0.   ]])
    """
    grad_z = (inverses(corners) * grad_planes).sum(1)
    return grad_z, -depth_planes(z, corners)[:, None] * grad_z


def ndc_of_pixels(pixel, width, height):
    """The centres of pixels row * width + column: (...) -> x, y (2, ...) in ndc."""
    row = pixel // width
    column = pixel - row * width
    return np.stack([(2 * column + 1) / width - 1, (2 * row + 1) / height - 1])


def seen_faces(face_index, clip, faces):
    """The S faces that are seen: their numbers (S,), corners (3, 3, S) and origins (2, S).

    face_index (H, W), clip (V, 4), faces (F, 3). A face's origin, in ndc, is one of the pixels that
    see it. Its corners are measured from there, so that a small face far out keeps its digits.
    """
    height, width = face_index.shape
    some_pixel = np.full(len(faces), -1)
    seen = np.flatnonzero(face_index >= 0)
    some_pixel[face_index.ravel()[seen]] = seen
    shown = np.flatnonzero(some_pixel >= 0)
    origin = ndc_of_pixels(some_pixel[shown], width, height)
    x, y, w = (clip[:, axis][faces[shown].T] for axis in (0, 1, 3))
    return shown, np.stack([x - origin[0] * w, y - origin[1] * w, w]), origin


def pixels_on_faces(face_index, shown, origin):
    """The pixels that see a face, in chunks: yields pixel, face, x, y, each (N,).

    pixel is row * width + column. face is from 0 to S - 1. x and y are measured from the face's
    origin.
    """
    number = np.zeros(shown.max(initial=0) + 1, int)
    number[shown] = np.arange(len(shown))
    for pixel in seen_pixels(face_index):
        face = number[face_index.reshape(-1)[pixel]]
        x, y = ndc_of_pixels(pixel, *face_index.shape[::-1])
        yield pixel, face, x - origin[0][face], y - origin[1][face]


def at_pixels(planes, face, x, y):
    """planes (K, 3, S) . (x, y, 1), the planes being those of each pixel's face (N,) -> (K, N)."""
    return np.stack([p[face] * x + q[face] * y + r[face] for p, q, r in planes])


def sum_per_vertex(grad_corners, grad_z, origin, corner_index, count):
    """Backward of the corners of `seen_faces`: (3, 3, S), and grad_z (3, S) -> grad_clip (V, 4).

    corner_index (3, S) is the vertex at each corner, and count is V.
    """
    grad_x, grad_y, grad_w = grad_corners
    grad_w = grad_w - origin[0] * grad_x - origin[1] * grad_y
    return scatter(np.stack([grad_x, grad_y, grad_z, grad_w], -1), corner_index, count)


def barycentrics_backward(grad_barycentric, face_index, clip, faces, epsilon=0.0):
    """Backward of lab 2's `barycentrics`: grad_barycentric (H, W, 3) -> grad_clip (V, 4).

    face_index (H, W), clip (V, 4), faces (F, 3). The gradient with respect to z is 0. Pixels that
    see no face are ignored. epsilon of eq. (2): 0 gives the derivative, 1e-6 nvdiffrast's numbers.
    """
    shown, corners, origin = seen_faces(face_index, clip, faces)
    planes = edge_functions(corners)
    grad_planes = np.zeros(planes.shape)
    for pixel, face, x, y in pixels_on_faces(face_index, shown, origin):
        e = at_pixels(planes, face, x, y)
        grad_b = grad_barycentric.reshape(-1, 3).take(pixel, 0).T.copy()  # contiguous rows: faster
        s = padded_sum(e, epsilon)
        grad_e = normalize_backward(grad_b, e / s, s)
        grad_planes += sum_per_face(grad_e, x, y, face, len(shown))
    grad_corners = edge_functions_backward(grad_planes, corners)
    grad_z = np.zeros_like(grad_corners[2])
    return sum_per_vertex(grad_corners, grad_z, origin, faces[shown].T, len(clip))


def barycentrics_derivatives_backward(grad_derivatives, face_index, clip, faces, epsilon=0.0):
    """Backward of lab 2's `barycentrics_derivatives`: grad_derivatives (H, W, 3, 2) -> grad_clip
    (V, 4). Axis 2: which weight, axis 3: x or y in pixels. The rest as in `barycentrics_backward`.
    """
    height, width = face_index.shape
    shown, corners, origin = seen_faces(face_index, clip, faces)
    planes = edge_functions(corners)
    grad_planes = np.zeros(planes.shape)
    for pixel, face, x, y in pixels_on_faces(face_index, shown, origin):
        e = at_pixels(planes, face, x, y)
        s = padded_sum(e, epsilon)
        grad_e = np.zeros(e.shape)
        grad_b_xy = grad_derivatives.reshape(-1, 3, 2).take(pixel, 0).T.copy()
        for axis, step in enumerate((2 / width, 2 / height)):  # a pixel in ndc
            e_x = step * planes[:, axis].take(face, 1)
            by_e_x, by_e = normalize_derivative_backward(grad_b_xy[axis], e_x, e / s, s)
            grad_e += by_e
            grad_planes[:, axis] += [step * np.bincount(face, by, len(shown)) for by in by_e_x]
        grad_planes += sum_per_face(grad_e, x, y, face, len(shown))
    grad_corners = edge_functions_backward(grad_planes, corners)
    grad_z = np.zeros_like(grad_corners[2])
    return sum_per_vertex(grad_corners, grad_z, origin, faces[shown].T, len(clip))


def depth_backward(grad_depth, face_index, clip, faces):
    """Backward of the depth that lab 2's `rasterize` gives: grad_depth (H, W) -> grad_clip (V, 4),
    including the gradient with respect to z. The rest as in `barycentrics_backward`.
    """
    shown, corners, origin = seen_faces(face_index, clip, faces)
    grad_planes = np.zeros((3, len(shown)))
    for pixel, face, x, y in pixels_on_faces(face_index, shown, origin):
        grad_planes += sum_per_face(grad_depth.take(pixel)[None], x, y, face, len(shown))[0]
    grad_z, grad_corners = depth_planes_backward(grad_planes, clip[faces[shown], 2].T, corners)
    return sum_per_vertex(grad_corners, grad_z, origin, faces[shown].T, len(clip))


def rasterize_backward(grad_barycentric, grad_derivatives, grad_depth, face_index, clip, faces,
                       epsilon=0.0):
    """The rasterizer's whole backward pass -> grad_clip (V, 4).

    grad_barycentric (H, W, 3). grad_derivatives (H, W, 3, 2) or None. grad_depth (H, W) or None.
    """
    grad_clip = barycentrics_backward(grad_barycentric, face_index, clip, faces, epsilon)
    if grad_derivatives is not None:
        grad_clip += barycentrics_derivatives_backward(grad_derivatives, face_index, clip, faces,
                                                       epsilon)
    if grad_depth is not None:
        grad_clip += depth_backward(grad_depth, face_index, clip, faces)
    return grad_clip
