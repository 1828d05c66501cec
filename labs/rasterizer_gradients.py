"""The rasterizer's backward pass: lab 7's vertex gradients for whole meshes, no matrix inverted.

q_k = (x_k, y_k, w_k) are a face's corners in clip space, M = [q_0 q_1 q_2], and a = (x, y, 1) is a
pixel in ndc. The weights b on the face are the same for c = M^-1 a and for e = det(M) c:

    e_k = (q_i x q_j) . a,   (i, j) = (1, 2), (2, 0), (0, 1) for k = 0, 1, 2                     (1)
    b = e / d,   s = sum e,   d = s + sign(s) epsilon,   db/dx = (e_x - b sum e_x) / d           (2)
    grad_(q_i x q_j) = sum of grad_e_k a over the pixels that see the face: nine numbers         (3)
    depth = z^T M^-1 a,   z of clip space                                                        (4)

q_i x q_j are the rows of M^-1, times det(M), so the e_k are lab 2's edge functions. Matrices are
(3, 3), or (3, 3, F) for many faces. epsilon is 0 here; nvdiffrast uses 1e-6, in its backward pass
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


def edge_functions(corners):  # exercise 7.10 (2 points)
    """Eq. (1): the edge functions of faces: edges (3, 3, ...), row k of each face's is q_i x q_j.

    corners (3, 3, ...): the matrices M, so corners[:, k] is q_k. The result is det(M) M^-1, but
    exists also where det(M) = 0.

    >>> edge_functions(np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]]))
    array([[-1., -2.,  4.],
           [ 2.,  0.,  0.],
           [ 0.,  2.,  0.]])
    """
    raise NotImplementedError("exercise 7.10: edge_functions")


def edge_functions_backward(grad_edges, corners):  # exercise 7.11 (3 points)
    """Backward of `edge_functions`: grad_edges (3, 3, ...) -> grad_corners (3, 3, ...).

    >>> corners = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> grad_edges = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    >>> edge_functions_backward(grad_edges, corners)  # edges[0, 0] = y_1 w_2 - w_1 y_2
    array([[ 0. ,  0. ,  0. ],
           [ 0. ,  1. , -0.5],
           [ 0. , -2. ,  0. ]])
    """
    raise NotImplementedError("exercise 7.11: edge_functions_backward")


def padded_sum(e, epsilon):
    """d of eq. (2): e (3, N) -> (N,). epsilon >= 0 makes |s| larger, of either sign.

    A face without area has d = 0. It gets infinity, so that its gradient is 0.
    """
    s = e.sum(0)
    s = s + np.copysign(epsilon, s)
    return np.where(s == 0, np.inf, s)


def normalize_derivative_backward(grad_db, dc, b, s):  # exercise 7.15 (4 points)
    """Backward of lab 2's `normalize_derivative`, where b = c / s and s = sum c depend on c, too.

    grad_db, dc, b (3, N), s (N,) -> grad_dc (3, N), grad_c (3, N).

    >>> dc, b = np.array([[1.0], [0.0], [3.0]]), np.array([[0.25], [0.5], [0.25]])
    >>> grad_db = np.array([[0.0], [4.0], [0.0]])
    >>> np.stack(normalize_derivative_backward(grad_db, dc, b, np.array([4.0])))[..., 0]
    array([[-0.5,  0.5, -0.5],
           [ 1. , -0. ,  1. ]])
    """
    raise NotImplementedError("exercise 7.15: normalize_derivative_backward")


def sum_per_face(u, x, y, face, count):  # exercise 7.16 (2 points)
    """Eq. (3): the sums of u a^T, a = (x, y, 1), over the pixels of each face -> (K, 3, count).

    u (K, N), x (N,), y (N,); face (N,): the face that pixel n sees, 0 <= face < count. A face that
    no pixel sees gets 0.

    >>> x, y = np.array([1.0, 2.0, 4.0]), np.array([0.0, 1.0, 3.0])
    >>> sum_per_face(np.array([[1.0, 10.0, 100.0]]), x, y, np.array([2, 0, 2]), 3)
    array([[[ 20.,   0., 401.],
            [ 10.,   0., 300.],
            [ 10.,   0., 101.]]])
    """
    raise NotImplementedError("exercise 7.16: sum_per_face")


def inverses(corners):
    """M^-1 of faces: corners (3, 3, F) -> (3, 3, F), 0 for a face without area."""
    e = edge_functions(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    return e / np.where(det == 0, np.inf, det)


def depth_planes(z, corners):  # exercise 7.17 (2 points)
    """Eq. (4) as depth = planes . a: planes (3, F), one for each face.

    z (3, F) of clip space, at the corners (3, 3, F), whose determinants are not 0.

    >>> corners = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> depth_planes(np.array([[0.0], [2.0], [1.0]]), corners[..., None]).T
    array([[1. , 0.5, 0. ]])
    """
    raise NotImplementedError("exercise 7.17: depth_planes")


def depth_planes_backward(grad_planes, z, corners):  # exercise 7.18 (3 points)
    """Backward of `depth_planes`: grad_planes (3, F) -> grad_z (3, F), grad_corners (3, 3, F).

    `vertex_gradients.residual_backward` for all faces at once: grad_planes is the sum of
    grad_depth a over the pixels.

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
    raise NotImplementedError("exercise 7.18: depth_planes_backward")


def ndc_of_pixels(pixel, width, height):
    """The centres of pixels row * width + column: (...) -> x, y (2, ...) in ndc."""
    row = pixel // width
    column = pixel - row * width
    return np.stack([(2 * column + 1) / width - 1, (2 * row + 1) / height - 1])


def seen_faces(face_index, clip, faces):
    """The S faces that are seen: shown (S,), their numbers; corners (3, 3, S); origin (2, S).

    face_index (H, W), clip (V, 4), faces (F, 3). The corners are measured from the origin, in ndc,
    which is one of the pixels that see the face: a small face far out keeps its digits.
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
    """The pixels that see a face, in chunks: pixel (N,) = row * width + column; face (N,), from 0
    to S - 1; x, y (N,), measured from the face's origin.
    """
    number = np.zeros(shown.max(initial=0) + 1, int)
    number[shown] = np.arange(len(shown))
    for pixel in seen_pixels(face_index):
        face = number[face_index.reshape(-1)[pixel]]
        x, y = ndc_of_pixels(pixel, *face_index.shape[::-1])
        yield pixel, face, x - origin[0][face], y - origin[1][face]


def at_pixels(planes, face, x, y):
    """planes (K, 3, S) . (x, y, 1), of each pixel's own face (N,) -> (K, N)."""
    return np.stack([p[face] * x + q[face] * y + r[face] for p, q, r in planes])


def sum_per_vertex(grad_corners, grad_z, origin, corner_index, count):
    """Backward of the corners of `seen_faces`: (3, 3, S), and grad_z (3, S) -> grad_clip (V, 4).

    corner_index (3, S): the vertex at each corner; count = V.
    """
    grad_x, grad_y, grad_w = grad_corners
    grad_w = grad_w - origin[0] * grad_x - origin[1] * grad_y
    return scatter(np.stack([grad_x, grad_y, grad_z, grad_w], -1), corner_index, count)


def barycentrics_backward(grad_barycentric, face_index, clip, faces, epsilon=0.0):
    """Backward of lab 2's `barycentrics`: grad_barycentric (H, W, 3) -> grad_clip (V, 4).

    face_index (H, W), clip (V, 4), faces (F, 3). z has no part in it. What grad_barycentric holds
    where no face is seen is ignored. epsilon of eq. (2): 0 is the derivative, 1e-6 nvdiffrast's.
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
    """The rasterizer's backward pass, all that it gives of a face -> grad_clip (V, 4).

    grad_barycentric (H, W, 3); grad_derivatives (H, W, 3, 2) or None; grad_depth (H, W) or None.
    """
    grad_clip = barycentrics_backward(grad_barycentric, face_index, clip, faces, epsilon)
    if grad_derivatives is not None:
        grad_clip += barycentrics_derivatives_backward(grad_derivatives, face_index, clip, faces,
                                                       epsilon)
    if grad_depth is not None:
        grad_clip += depth_backward(grad_depth, face_index, clip, faces)
    return grad_clip
