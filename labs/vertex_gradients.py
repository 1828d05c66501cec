"""Vertex gradients: what does a pixel want of the three vertices of the face that it sees?

    M = [q_0 q_1 q_2],   q_k = (x_k, y_k, 1),   a = (x, y, 1)      corners, and a pixel          (1)
    f = r^T M^-1 a - r_gt                       colours r at the corners, r_gt is wanted         (2)
    d(M^-1) = -M^-1 dM M^-1,   dM/dm_ij = e_i e_j^T                                              (3)
    df/dM = -M^-T r a^T M^-T = -(df/da) c^T,   c = M^-1 a                                        (4)

    q_k = (x_k, y_k, w_k) of clip space,   s = sum c,   b = c / s          in perspective        (5)
    grad_c = (grad_b - (grad_b . b) 1) / s,  grad_a = M^-T grad_c,  grad_M = -grad_a c^T         (6)

A vertex drags the picture along, by its weight. So its gradient (4) is minus the picture's slope
df/da, times the weight. For whole meshes no matrix is inverted: b is the same for e = det(M) c.

    e_k = (q_i x q_j) . a,   (i, j) = (1, 2), (2, 0), (0, 1) for k = 0, 1, 2                     (7)
    b = e / (s + epsilon),   s = sum e,   db/dx = (e_x - b sum e_x) / (s + epsilon)              (8)
    grad_(q_i x q_j) = sum of grad_e_k a over the pixels that see the face: nine numbers         (9)
    depth = z^T M^-1 a,   z of clip space                          eq. (2) once more            (10)

q_i x q_j are the rows of M^-1, times det(M), so the e_k are lab 2's edge functions. In clip space
a is (x, y, 1) in ndc. Matrices are (3, 3), or (3, 3, F) for many faces.

Sources: a note on the derivative of a rendered pixel by its triangle's vertices, (1) to (4), which
in perspective leaves out the sum s and its share in (6); nvdiffrast, which has epsilon of (8) in
its backward pass only.
"""
import numpy as np

EDGES = (1, 2), (2, 0), (0, 1)  # edge k runs from the first to the second, opposite to vertex k
CHUNK = 1 << 15                 # pixels in flight at once: they stay in the cache


def vertex_matrix(triangle):  # exercise 7.1 (1 point)
    """Eq. (1): triangle (3, 2), a vertex in each row -> M (3, 3), a vertex in each column.

    >>> vertex_matrix(np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]]))
    array([[0., 4., 0.],
           [0., 0., 2.],
           [1., 1., 1.]])
    """
    raise NotImplementedError("exercise 7.1: vertex_matrix")


def residual(values, m, a, target):  # exercise 7.2 (1 point)
    """Eq. (2): by how much the pixel a is too bright: f, a number.

    values (3,): one channel of the vertices' colours; m (3, 3), of a determinant other than 0;
    a (3,); target: a number.

    >>> m = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
    >>> residual(np.array([8.0, 0.0, 4.0]), m, np.array([1.0, 1.0, 1.0]), 3.0)
    np.float64(1.0)
    """
    raise NotImplementedError("exercise 7.2: residual")


def inverse_differential(m, dm):  # exercise 7.3 (2 points)
    """Eq. (3): how fast the inverse of m (3, 3) changes when m moves with velocity dm (3, 3).

    -> (3, 3), the limit of ((m + t dm)^-1 - m^-1) / t as t goes to 0. It follows from M^-1 M = I.

    >>> dm = np.array([[0.0, 3.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    >>> inverse_differential(np.diag([1.0, 2.0, 4.0]), dm)[0, 1]
    np.float64(-1.5)
    """
    raise NotImplementedError("exercise 7.3: inverse_differential")


def residual_slope(values, m, a, i, j):  # exercise 7.4 (2 points)
    """df/dm_ij, a number: the derivative of eq. (2) by one element of m, row i and column j.

    values (3,), m (3, 3), a (3,). The obvious way: (3) with dM = e_i e_j^T, a matrix of one 1.

    >>> m = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
    >>> residual_slope(np.array([8.0, 0.0, 4.0]), m, np.array([1.0, 1.0, 1.0]), 0, 2)
    np.float64(1.0)
    """
    raise NotImplementedError("exercise 7.4: residual_slope")


def residual_backward(grad_f, values, m, a, target):  # exercise 7.5 (3 points)
    """Backward of eq. (2): grad_f, a number -> grad_values (3,), grad_m (3, 3), grad_a (3,),
    grad_target, a number.

    No loop over elements. Rows 0 and 1 of grad_m are the vertices' gradients by x and y; what row 2
    holds is of use in perspective. m and a count as free numbers, also where they are 1.

    >>> m = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
    >>> a = np.array([1.0, 1.0, 1.0])
    >>> grads = residual_backward(1.0, np.array([8.0, 0.0, 4.0]), m, a, 3.0)
    >>> grads[1]
    array([[ 0.5,  0.5,  1. ],
           [ 0.5,  0.5,  1. ],
           [-2. , -2. , -4. ]])
    >>> grads[0], grads[2], grads[3]
    (array([0.25, 0.25, 0.5 ]), array([-2., -2.,  8.]), -1.0)
    """
    raise NotImplementedError("exercise 7.5: residual_backward")


def residuals_jacobian(values, triangle, points):  # exercise 7.6 (3 points)
    """The derivatives of eq. (2) at many points: by_values (P, 3), by_triangle (P, 3, 2).

    values (3,), triangle (3, 2), of an area other than 0, points (P, 2): x, y. by_triangle[p, k] is
    the gradient of point p's residual by the position of vertex k.

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]])
    >>> residuals_jacobian(np.array([8.0, 0.0, 4.0]), triangle, np.array([[1.0, 1.0]]))
    (array([[0.25, 0.25, 0.5 ]]), array([[[0.5, 0.5],
            [0.5, 0.5],
            [1. , 1. ]]]))
    """
    raise NotImplementedError("exercise 7.6: residuals_jacobian")


def gauss_newton_step(residuals, jacobian):  # exercise 7.7 (2 points)
    """The step (U,) that would make the sum of squares least, if residuals were linear.

    residuals (R,), jacobian (R, U): their derivatives by U unknowns. |residuals + jacobian step|
    is least; of several such steps, it is the shortest. R may be smaller than U.

    >>> gauss_newton_step(np.array([2.0, 6.0]), np.array([[1.0, 1.0, 0.0], [0.0, 0.0, 2.0]]))
    array([-1., -1., -3.])
    """
    raise NotImplementedError("exercise 7.7: gauss_newton_step")


def weights(m, a):  # exercise 7.8 (1 point)
    """Eq. (5): where on its face, in space, a pixel lies: b (3,), of sum 1.

    m (3, 3): columns (x, y, w) of clip space, w of any sign; a (3,): the pixel in ndc.

    >>> m = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])  # w = 1/2 at vertex 1
    >>> weights(m, np.array([1.0, 0.0, 1.0]))
    array([0.6, 0.4, 0. ])
    """
    raise NotImplementedError("exercise 7.8: weights")


def weights_backward(grad_b, m, a):  # exercise 7.9 (4 points)
    """Eq. (6): grad_b (3,) -> grad_m (3, 3), grad_a (3,).

    All nine numbers of m and all three of a count as free.

    >>> m = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> grad_m, grad_a = weights_backward(np.array([0.0, 1.0, 0.0]), m, np.array([1.0, 0.0, 1.0]))
    >>> grad_m.round(9) + 0.0
    array([[-0.24, -0.16,  0.  ],
           [ 0.  ,  0.  ,  0.  ],
           [ 0.24,  0.16,  0.  ]])
    """
    raise NotImplementedError("exercise 7.9: weights_backward")


def cross(p, q):
    """The cross products of p and q (3, ...) -> (3, ...). np.cross takes twice as long for this."""
    return np.stack([p[1] * q[2] - p[2] * q[1],
                     p[2] * q[0] - p[0] * q[2],
                     p[0] * q[1] - p[1] * q[0]])


def edge_functions(corners):  # exercise 7.10 (2 points)
    """Eq. (7): the edge functions of faces: edges (3, 3, ...), row k of each face's is q_i x q_j.

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


def normalize(e, epsilon):  # exercise 7.12 (1 point)
    """Eq. (8): b = e / (s + epsilon), where s = sum e: e (3, N) -> b (3, N).

    epsilon >= 0 gets the sign of s, so that it makes |s| larger; for s = 0 it stays positive. It is
    0 in a picture, and for the backward pass.
    s + epsilon is not 0, here and below.

    >>> normalize(np.array([[1.0, -3.0], [2.0, -1.0], [4.0, 1.0]]), 1.0)
    array([[ 0.125,  0.75 ],
           [ 0.25 ,  0.25 ],
           [ 0.5  , -0.25 ]])
    """
    raise NotImplementedError("exercise 7.12: normalize")


def normalize_backward(grad_b, e, epsilon):  # exercise 7.13 (2 points)
    """Backward of `normalize`: grad_b (3, N) -> grad_e (3, N). epsilon is a constant.

    >>> normalize_backward(np.array([[8.0], [0.0], [0.0]]), np.array([[1.0], [1.0], [2.0]]), 0.0).T
    array([[ 1.5, -0.5, -0.5]])
    """
    raise NotImplementedError("exercise 7.13: normalize_backward")


def normalize_derivative(e, e_x, epsilon):  # exercise 7.14 (1 point)
    """Eq. (8): the derivative (3, N) of `normalize` by x: e (3, N), e_x (3, N) = de/dx.

    >>> e, e_x = np.array([[1.0], [2.0], [1.0]]), np.array([[1.0], [0.0], [3.0]])
    >>> normalize_derivative(e, e_x, 0.0).T
    array([[ 0. , -0.5,  0.5]])
    """
    raise NotImplementedError("exercise 7.14: normalize_derivative")


def normalize_derivative_backward(grad_b_x, e, e_x, epsilon):  # exercise 7.15 (4 points)
    """Backward of `normalize_derivative`: grad_b_x (3, N) -> grad_e (3, N), grad_e_x (3, N).

    >>> e, e_x = np.array([[1.0], [2.0], [1.0]]), np.array([[1.0], [0.0], [3.0]])
    >>> grad_b_x = np.array([[0.0], [4.0], [0.0]])
    >>> np.stack(normalize_derivative_backward(grad_b_x, e, e_x, 0.0))[..., 0]
    array([[ 1. , -0. ,  1. ],
           [-0.5,  0.5, -0.5]])
    """
    raise NotImplementedError("exercise 7.15: normalize_derivative_backward")


def sum_per_face(u, x, y, face, count):  # exercise 7.16 (2 points)
    """Eq. (9): the sums of u a^T, a = (x, y, 1), over the pixels of each face -> (K, 3, count).

    u (K, N), x (N,), y (N,); face (N,): the face that pixel n sees, 0 <= face < count. A face that
    no pixel sees gets 0.

    >>> x, y = np.array([1.0, 2.0, 4.0]), np.array([0.0, 1.0, 3.0])
    >>> sum_per_face(np.array([[1.0, 10.0, 100.0]]), x, y, np.array([2, 0, 2]), 3)
    array([[[ 20.,   0., 401.],
            [ 10.,   0., 300.],
            [ 10.,   0., 101.]]])
    """
    raise NotImplementedError("exercise 7.16: sum_per_face")


def depth_planes(z, corners):  # exercise 7.17 (2 points)
    """Eq. (10) as depth = planes . a: planes (3, F), one for each face.

    z (3, F) of clip space, at the corners (3, 3, F), whose determinants are not 0.

    >>> corners = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> depth_planes(np.array([[0.0], [2.0], [1.0]]), corners[..., None]).T
    array([[1. , 0.5, 0. ]])
    """
    raise NotImplementedError("exercise 7.17: depth_planes")


def depth_planes_backward(grad_planes, z, corners):  # exercise 7.18 (3 points)
    """Backward of `depth_planes`: grad_planes (3, F) -> grad_z (3, F), grad_corners (3, 3, F).

    Eq. (4) for all faces at once, where grad_planes is the sum of grad_depth a over the pixels.

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
    some_pixel = np.full(len(faces) + 1, -1)  # the last one is for pixels that see none
    seen = np.flatnonzero(face_index >= 0)
    some_pixel[face_index.ravel()[seen]] = seen
    shown = np.flatnonzero(some_pixel[:-1] >= 0)
    origin = ndc_of_pixels(some_pixel[shown], width, height)
    x, y, w = (clip[:, axis][faces[shown].T] for axis in (0, 1, 3))
    return shown, np.stack([x - origin[0] * w, y - origin[1] * w, w]), origin


def seen_pixels(face_index, shown, origin):
    """The pixels that see a face, in chunks: pixel (N,) = row * width + column; face (N,), from 0
    to S - 1; x, y (N,), measured from the face's origin.
    """
    number = np.zeros(shown.max(initial=0) + 1, int)
    number[shown] = np.arange(len(shown))
    seen = np.flatnonzero(face_index >= 0)
    for pixel in (seen[start:start + CHUNK] for start in range(0, len(seen), CHUNK)):
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
    return np.stack([np.bincount(corner_index.ravel(), grad.ravel(), count)
                     for grad in (grad_x, grad_y, grad_z, grad_w)], -1)


def barycentrics_backward(grad_barycentric, face_index, clip, faces, epsilon=0.0):
    """Backward of lab 2's `barycentrics`: grad_barycentric (H, W, 3) -> grad_clip (V, 4).

    face_index (H, W), clip (V, 4), faces (F, 3). z has no part in it. What grad_barycentric holds
    where no face is seen is ignored. epsilon of eq. (8): 0 is the derivative, 1e-6 nvdiffrast's.
    """
    shown, corners, origin = seen_faces(face_index, clip, faces)
    planes = edge_functions(corners)
    grad_planes = np.zeros(planes.shape)
    for pixel, face, x, y in seen_pixels(face_index, shown, origin):
        e = at_pixels(planes, face, x, y)
        grad_b = grad_barycentric.reshape(-1, 3).take(pixel, 0).T.copy()  # rows side by side
        grad_e = normalize_backward(grad_b, e, epsilon)
        grad_planes += sum_per_face(grad_e, x, y, face, len(shown))
    grad_corners = edge_functions_backward(grad_planes, corners)
    return sum_per_vertex(grad_corners, 0 * grad_corners[2], origin, faces[shown].T, len(clip))


def barycentrics_derivatives_backward(grad_derivatives, face_index, clip, faces, epsilon=0.0):
    """Backward of lab 2's `barycentrics_derivatives`: grad_derivatives (H, W, 3, 2), by b and by
    x and y in pixels -> grad_clip (V, 4). The rest as in `barycentrics_backward`.
    """
    height, width = face_index.shape
    shown, corners, origin = seen_faces(face_index, clip, faces)
    planes = edge_functions(corners)
    grad_planes = np.zeros(planes.shape)
    for pixel, face, x, y in seen_pixels(face_index, shown, origin):
        e = at_pixels(planes, face, x, y)
        grad_e = np.zeros(e.shape)
        grad_b_xy = grad_derivatives.reshape(-1, 3, 2).take(pixel, 0).T.copy()
        for axis, step in enumerate((2 / width, 2 / height)):  # a pixel in ndc
            e_x = step * planes[:, axis].take(face, 1)
            by_e, by_e_x = normalize_derivative_backward(grad_b_xy[axis], e, e_x, epsilon)
            grad_e += by_e
            grad_planes[:, axis] += [step * np.bincount(face, by, len(shown)) for by in by_e_x]
        grad_planes += sum_per_face(grad_e, x, y, face, len(shown))
    grad_corners = edge_functions_backward(grad_planes, corners)
    return sum_per_vertex(grad_corners, 0 * grad_corners[2], origin, faces[shown].T, len(clip))


def depth_backward(grad_depth, face_index, clip, faces):
    """Backward of the depth that lab 2's `rasterize` gives: grad_depth (H, W) -> grad_clip (V, 4),
    with a gradient by z. The rest as in `barycentrics_backward`.
    """
    shown, corners, origin = seen_faces(face_index, clip, faces)
    grad_planes = np.zeros((3, len(shown)))
    for pixel, face, x, y in seen_pixels(face_index, shown, origin):
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
