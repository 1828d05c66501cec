"""Interpolation: what a face's corners know, seen at every pixel, in perspective.

A point is divided by its w to get on the screen. What is linear on the face is not linear there,
but A / w and 1 / w are. t and q are fractions of a segment: t on the screen, q in space.

    q = t w_0 / (t w_0 + (1 - t) w_1)                          0 at corner 0, 1 at corner 1  (1)
    A = lerp(A_0/w_0, A_1/w_1, t) / lerp(1/w_0, 1/w_1, t)      which is lerp(A_0, A_1, q)    (2)
    b_k = c_k / s,   c_k = e_k / w_k,   s = c_0 + c_1 + c_2    on the face, in space         (3)
    db_k = (dc_k - b_k (dc_0 + dc_1 + dc_2)) / s               their derivatives             (4)
    A = b_0 A_0 + b_1 A_1 + b_2 A_2                            at a pixel that sees a face   (5)
    dA/dx = db_0/dx A_0 + db_1/dx A_1 + db_2/dx A_2            and dA/dy: its footprint      (6)
    A_pixels = B A_vertices                                    (5) for all pixels at once    (7)
    grad_A_vertices = B^T grad_A_pixels,   grad_b_k = grad_A . A_k                           (8)

e_k is any multiple of lab 2's edge function opposite to corner k. B has one row for each pixel and
one column for each vertex. attributes (V, C) are C numbers at each vertex. faces (F, 3) may name
other vertices than those of the positions, as uv with seams do. face_index (H, W), -1 for no face,
and barycentric (H, W, 3) come from lab 2.

Source: lecture "Differentiable graphics 1".
"""
import numpy as np
import scipy.sparse

from course.given.arrays import write_rows

from .rasterization import normalize_derivative, seen_corners


def lerp(a, b, t):
    """Linear interpolation: what lies at the fraction t of the way from a to b?

    a, b and t have shapes that broadcast. The ends are exact: a at t = 0 and b at t = 1.

    >>> lerp(2.0, 4.0, np.array([0.0, 0.25, 1.0, 2.0]))
    array([2. , 2.5, 4. , 6. ])
    """
    return (1 - t) * a + t * b


def fraction_in_space(t, w_0, w_1):  # exercise 5.2 (1 point)
    """Eq. (1): how far along a segment in space is the point at fraction t on the screen?

    t, w_0, w_1: numbers or arrays.

    >>> fraction_in_space(np.array([0.0, 0.5, 1.0]), 1.0, 3.0)
    array([0.  , 0.25, 1.  ])
    """
    return t * w_0 / lerp(w_1, w_0, t)


def fraction_in_space_backward(grad_q, t, w_0, w_1):  # extra 5.3 (3 points)
    """Backward of eq. (1): grad_q -> grad_t, grad_w_0, grad_w_1, all (...) like t, w_0 and w_1.

    >>> np.array(fraction_in_space_backward(1.0, 0.5, 1.0, 3.0))
    array([ 0.75  ,  0.1875, -0.0625])
    """
    # q = u / v with u = t w_0, v = t w_0 + (1 - t) w_1, so dq = (v du - u dv) / v^2.
    v = lerp(w_1, w_0, t)
    grad = grad_q / v**2
    return grad * w_0 * w_1, grad * t * (1 - t) * w_1, -grad * t * (1 - t) * w_0


def attribute_on_segment(t, a_0, a_1, w_0, w_1):  # extra 5.4 (2 points)
    """Eq. (2): the attributes seen at fractions t (N,) of a segment on the screen -> (N, C).

    Its ends have the attributes a_0, a_1 (C,), and w_0, w_1, two numbers.

    >>> attribute_on_segment(np.array([0.0, 0.5]), np.array([8.0, 0.0]), np.array([0.0, 4.0]), 1, 3)
    array([[8., 0.],
           [6., 1.]])
    """
    t = t[:, None]
    return lerp(a_0 / w_0, a_1 / w_1, t) / lerp(1 / w_0, 1 / w_1, t)


def barycentric_from_screen(e, w):  # exercise 5.5 (1 point)
    """Eq. (3): a pixel's screen weights e -> its barycentric b, corrected for perspective.

    e, w and b are (..., 3), with the w of each corner.

    >>> barycentric_from_screen(np.array([0.5, 0.5, 0.0]), np.array([1.0, 3.0, 1.0]))
    array([0.75, 0.25, 0.  ])
    """
    c = e / w
    return c / c.sum(-1, keepdims=True)


def normalize_backward(grad_b, b, s, axis=0):  # exercise 5.6 (2 points)
    """Backward of b = c / s, s = sum c, the quotient rule: grad_b -> grad_c.

    The three weights lie along the axis, and s broadcasts with them.

    >>> normalize_backward(np.array([8.0, 0.0, 0.0]), np.array([0.25, 0.25, 0.5]), 4.0)
    array([ 1.5, -0.5, -0.5])

    Fine print. In lab 7, s = sum c + a small constant. The rule is the same there, and b sums to
    less than 1.
    """
    # By eq. (4), dL = sum_k grad_b_k (dc_k - b_k sum_j dc_j) / s. Collect the factors of each
    # dc_k. Every c_k is part of s, so corner k feels what all three weights want.
    return (grad_b - (grad_b * b).sum(axis, keepdims=True)) / s


def barycentric_from_screen_backward(grad_b, e, w):
    """Backward of eq. (3): grad_b -> grad_e, grad_w, all (..., 3) like e and w."""
    # c = e / w: dc = de / w - c dw / w.
    c = e / w
    b = barycentric_from_screen(e, w)
    grad_c = normalize_backward(grad_b, b, c.sum(-1, keepdims=True), axis=-1)
    return grad_c / w, -grad_c * c / w


def barycentric_from_screen_derivatives(de, e, w):
    """Eq. (4): how b of eq. (3) changes where e changes: de (..., 3, D) -> db (..., 3, D).

    de holds D derivatives of e (..., 3), such as those with respect to x and to y. w (..., 3) is
    constant.
    """
    b = barycentric_from_screen(e, w)[..., None]
    s = (e / w).sum(-1)[..., None, None]
    return normalize_derivative(de / w[..., None], b, s, axis=-2)


def interpolate_loop(attributes, faces, face_index, barycentric):  # exercise 5.8 (2 points)
    """Eq. (5), pixel by pixel: the picture (H, W, C) of attributes (V, C), 0 where no face is seen.

    faces (F, 3), face_index (H, W), barycentric (H, W, 3).

    >>> faces, seen = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[1, -1]])
    >>> b = np.array([[[0.5, 0.25, 0.25], [0.5, 0.5, 0.0]]])
    >>> interpolate_loop(np.array([[9.0], [4.0], [6.0], [8.0]]), faces, seen, b)
    array([[[6.],
            [0.]]])
    """
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index >= 0):
        for vertex, b in zip(faces[face_index[i, j]], barycentric[i, j], strict=True):
            output[i, j] += b * attributes[vertex]
    return output


def interpolate_backward_loop(grad_output, attributes,  # exercise 5.9 (3 points)
                              faces, face_index, barycentric):
    """Eq. (8), pixel by pixel: the backward pass of `interpolate_loop`.

    grad_output (H, W, C) -> grad_attributes (V, C), summed over the pixels, and
    grad_barycentric (H, W, 3), 0 where no face is seen.

    >>> attributes, faces = np.array([[9.0], [4.0], [6.0], [8.0]]), np.array([[2, 1, 3]])
    >>> b, grad_output = np.array([[[0.5, 0.25, 0.25]]]), np.array([[[8.0]]])
    >>> grads = interpolate_backward_loop(grad_output, attributes, faces, np.array([[0]]), b)
    >>> grads[0].T, grads[1]
    (array([[0., 2., 4., 2.]]), array([[[48., 32., 64.]]]))
    """
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] += barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = grad_output[i, j] @ attributes[vertex]
    return grad_attributes, grad_barycentric


def weight_rows(faces, face_index, barycentric):  # extra 5.10 (3 points)
    """B of eq. (7) in compressed sparse rows: start (H W + 1,), vertex and weight (3 N,).

    Row p of B is pixel p, counted row by row. N pixels see a face and have three entries, in the
    corners' order. Row p has entries start[p] to start[p + 1] - 1. Entry n is weight[n], in
    column vertex[n].

    >>> faces, seen = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[1, -1]])
    >>> weight_rows(faces, seen, np.array([[[0.5, 0.25, 0.25], [0.5, 0.5, 0.0]]]))
    (array([0, 3, 3]), array([2, 1, 3]), array([0.5 , 0.25, 0.25]))
    """
    face = face_index.reshape(-1)
    start = np.append(0, np.cumsum(3 * (face >= 0)))
    seen = np.flatnonzero(face >= 0)
    vertex = faces.take(face[seen], 0)  # copies short rows four times as fast as faces[...]
    weight = barycentric.reshape(-1, 3).take(seen, 0)
    return start, vertex.reshape(-1), weight.reshape(-1)


def interpolation_matrix(vertex_count, faces, face_index, barycentric):
    """B of eq. (7), a sparse matrix (H W, V), made of `weight_rows`."""
    return sparse_matrix(vertex_count, *weight_rows(faces, face_index, barycentric))


def sparse_matrix(vertex_count, start, vertex, weight):
    """The matrix of which `weight_rows` made start, vertex and weight: (H W, V).

    IndexError if a seen face names a vertex that does not exist. SciPy would read on in memory.
    """
    if len(vertex) and not 0 <= vertex.min() <= vertex.max() < vertex_count:
        raise IndexError(f"faces name rows {vertex.min()} to {vertex.max()} of the attributes, "
                         f"which have {vertex_count}: give the faces that belong to them")
    return scipy.sparse.csr_array((weight, vertex, start), (len(start) - 1, vertex_count))


def interpolate(attributes, faces, face_index, barycentric):  # extra 5.11 (2 points)
    """Eq. (7): the picture of `interpolate_loop`, without a loop over pixels -> (H, W, C).

    The given `interpolation_matrix` makes B, and B @ x multiplies an array by it.
    """
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    return (weights @ attributes).reshape(*face_index.shape, attributes.shape[1])


def interpolate_backward(grad_output, attributes, faces, face_index,  # extra 5.12 (2 points)
                         barycentric):
    """Eq. (8): the gradients of `interpolate_backward_loop`, without a loop over pixels.

    The given `barycentric_gradient` makes grad_barycentric.
    """
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    grad_attributes = weights.T @ grad_output.reshape(-1, attributes.shape[1])
    return grad_attributes, barycentric_gradient(grad_output, attributes, faces, face_index)


def barycentric_gradient(grad_output, attributes, faces, face_index):
    """Eq. (8) for the weights: grad_output (H, W, C) -> grad_barycentric (H, W, 3).

    attributes (V, C), faces (F, 3), face_index (H, W). It is 0 where no face is seen.
    """
    grad_pixels = grad_output.reshape(-1, attributes.shape[1])
    grad_barycentric = np.zeros((face_index.size, 3))
    channels = attributes.T.copy()  # contiguous rows: faster
    for pixel, corners in seen_corners(face_index, faces):
        grad_seen = grad_pixels.take(pixel, 0).T.copy()
        by_weight = np.einsum("cn,ckn->kn", grad_seen, channels.take(corners, 1))
        write_rows(grad_barycentric, pixel, by_weight)
    return grad_barycentric.reshape(*face_index.shape, 3)


def interpolate_derivatives(attributes, faces, face_index, derivatives):  # exercise 5.13 (2 points)
    """Eq. (6): dA/dx and dA/dy at each pixel (H, W, C, 2), 0 where no face is seen.

    derivatives (H, W, 3, 2): db/dx and db/dy. `interpolate` is given. For A = (u, v) this is lab
    6's matrix J.

    >>> attributes, faces = np.array([[9.0], [4.0], [6.0], [8.0]]), np.array([[2, 1, 3]])
    >>> db = np.array([[[[-0.5, 0.25], [0.5, 0.0], [0.0, -0.25]]]])
    >>> interpolate_derivatives(attributes, faces, np.array([[0]]), db)
    array([[[[-1. , -0.5]]]])
    """
    # (6) is (5) with other weights.
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (0, 1))
    return np.stack([by_x, by_y], -1)


def interpolate_derivatives_backward(grad_output, attributes,  # extra 5.14 (3 points)
                                     faces, face_index, derivatives):
    """Backward of eq. (6): grad_output (H, W, C, 2) -> grad_attributes, grad_derivatives.

    They have the shapes of attributes (V, C) and derivatives (H, W, 3, 2).

    >>> attributes, faces = np.array([[9.0], [4.0], [6.0], [8.0]]), np.array([[2, 1, 3]])
    >>> db = np.array([[[[-0.5, 0.25], [0.5, 0.0], [0.0, -0.25]]]])
    >>> grads = interpolate_derivatives_backward(np.array([[[[2.0, 4.0]]]]), attributes, faces,
    ...                                          np.array([[0]]), db)
    >>> grads[0].T, grads[1]
    (array([[ 0.,  1.,  0., -1.]]), array([[[[12., 24.],
             [ 8., 16.],
             [16., 32.]]]]))
    """
    # (6) is (5) twice, so the attributes get the sum of both.
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return by_x[0] + by_y[0], np.stack([by_x[1], by_y[1]], -1)
