"""Interpolation: what a face's corners know, seen at every pixel, in perspective.

A point is divided by its w to get on the screen. What is linear on the face is not linear there,
but A / w and 1 / w are. Along a segment, t is the fraction of the way on screen, q that in space.

    q = t w_0 / (t w_0 + (1 - t) w_1)                          0 at corner 0, 1 at corner 1  (1)
    A = lerp(A_0/w_0, A_1/w_1, t) / lerp(1/w_0, 1/w_1, t)      which is lerp(A_0, A_1, q)    (2)
    b_k = n_k / s,   n_k = e_k / w_k,   s = n_0 + n_1 + n_2    corrected barycentrics        (3)
    db_k = (dn_k - b_k (dn_0 + dn_1 + dn_2)) / s               their derivatives             (4)
    A = b_0 A_0 + b_1 A_1 + b_2 A_2                            a pixel that sees a face      (5)
    dA/dx = db_0/dx A_0 + db_1/dx A_1 + db_2/dx A_2            and dA/dy: its footprint      (6)
    A_pixels = B A_vertices                                    (5) for all pixels at once    (7)
    grad_A_vertices = B^T grad_A_pixels,   grad_b_k = grad_A . A_k                           (8)

e_k is any multiple of lab 2's edge function opposite to corner k. w_k and s are not 0. B has one
row for each pixel and one column for each vertex. attributes (V, C) are C numbers at each vertex.
faces (F, 3) may name other vertices than those of the positions, as uv with seams do. face_index
(H, W), -1 for no face, and barycentric (H, W, 3) are as lab 2 makes them.

Source: lecture "Differentiable graphics 1".
"""
import numpy as np
import scipy.sparse

from .rasterization import normalize_derivative, seen_pixels


def lerp(a, b, t):  # exercise 5.1 (1 point)
    """Linear interpolation: what lies at the fraction t of the way from a to b?

    a, b, t: finite, of shapes that broadcast. t may lie outside of 0 ... 1.

    >>> lerp(2.0, 4.0, np.array([0.0, 0.25, 1.0, 2.0]))
    array([2. , 2.5, 4. , 6. ])

    Fine print. It is a at t = 0 and b at t = 1, both to the last bit.
    """
    raise NotImplementedError("exercise 5.1: lerp")


def fraction_in_space(t, w_0, w_1):  # exercise 5.2 (2 points)
    """Eq. (1): how far along a segment in space is the point seen at fraction t on the screen?

    t, w_0, w_1: shapes that broadcast. w_0 and w_1 are those of the two ends, of one sign.

    >>> fraction_in_space(np.array([0.0, 0.5, 1.0]), 1.0, 3.0)
    array([0.  , 0.25, 1.  ])
    """
    raise NotImplementedError("exercise 5.2: fraction_in_space")


def fraction_in_space_backward(grad_q, t, w_0, w_1):  # exercise 5.3 (3 points)
    """Backward of eq. (1): grad_q (...) -> grad_t, grad_w_0, grad_w_1, each (...).

    t, w_0, w_1 (...), all of one shape.

    >>> np.array(fraction_in_space_backward(1.0, 0.5, 1.0, 3.0))
    array([ 0.75  ,  0.1875, -0.0625])
    """
    raise NotImplementedError("exercise 5.3: fraction_in_space_backward")


def attribute_on_segment(t, a_0, a_1, w_0, w_1):  # exercise 5.4 (2 points)
    """Eq. (2): attributes along a segment, at fractions t (N,) of its picture -> (N, C).

    a_0, a_1 (C,): the attributes of its ends. w_0, w_1: their w, two numbers of one sign.

    >>> attribute_on_segment(np.array([0.0, 0.5]), np.array([8.0, 0.0]), np.array([0.0, 4.0]), 1, 3)
    array([[8., 0.],
           [6., 1.]])
    """
    raise NotImplementedError("exercise 5.4: attribute_on_segment")


def corrected_barycentrics(e, w):  # exercise 5.5 (2 points)
    """Eq. (3): the weights on the screen, e (..., 3), and the corners' w (..., 3) -> b (..., 3).

    b are the weights on the face in space, with sum 1. A multiple of e gives the same b.

    >>> corrected_barycentrics(np.array([0.5, 0.5, 0.0]), np.array([1.0, 3.0, 1.0]))
    array([0.75, 0.25, 0.  ])

    Fine print. e and w may have any sign, and e any sum, as long as s is not 0.
    """
    raise NotImplementedError("exercise 5.5: corrected_barycentrics")


def normalize_backward(grad_b, b, s, axis=0):  # exercise 5.6 (3 points)
    """Backward of b = n / s with s = sum n, the quotient rule: grad_b -> grad_n.

    grad_b and b have one shape, with the three weights along the axis. s has length 1 along that
    axis, or (for axis 0) lacks it.

    >>> normalize_backward(np.array([8.0, 0.0, 0.0]), np.array([0.25, 0.25, 0.5]), 4.0)
    array([ 1.5, -0.5, -0.5])
    """
    raise NotImplementedError("exercise 5.6: normalize_backward")


def corrected_barycentrics_backward(grad_b, e, w):
    """Backward of eq. (3): grad_b (..., 3) -> grad_e (..., 3), grad_w (..., 3).

    e, w (..., 3), of grad_b's shape.
    """
    # n = e / w: dn = de / w - n dw / w.
    n = e / w
    s = n.sum(-1, keepdims=True)
    grad_n = normalize_backward(grad_b, n / s, s, axis=-1)
    return grad_n / w, -grad_n * n / w


def corrected_barycentrics_derivatives(de, e, w):
    """Eq. (4): how does b of eq. (3) change where e does? de (..., 3, D) -> db (..., 3, D).

    de: D derivatives of e (..., 3), such as those with respect to x and to y. w (..., 3) stays.
    """
    n = (e / w)[..., None]
    s = n.sum(-2, keepdims=True)
    return normalize_derivative(de / w[..., None], n / s, s, axis=-2)


def interpolate_loop(attributes, faces, face_index, barycentric):  # exercise 5.8 (2 points)
    """Eq. (5), pixel by pixel: -> (H, W, C), 0 where no face is seen. Slow and obvious.

    attributes (V, C), faces (F, 3), face_index (H, W), barycentric (H, W, 3).

    >>> faces, seen = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[1, -1]])
    >>> b = np.array([[[0.5, 0.25, 0.25], [0.5, 0.5, 0.0]]])
    >>> interpolate_loop(np.array([[9.0], [4.0], [6.0], [8.0]]), faces, seen, b)
    array([[[6.],
            [0.]]])

    Fine print. At pixels without a face the weights may be anything, NaN too.
    """
    raise NotImplementedError("exercise 5.8: interpolate_loop")


def interpolate_backward_loop(grad_output, attributes, faces, face_index,  # exercise 5.9 (3 points)
                              barycentric):
    """Eq. (8), pixel by pixel: what does each vertex, and each weight, get? Slow and obvious.

    grad_output (H, W, C) -> grad_attributes (V, C), grad_barycentric (H, W, 3). The three weights
    of a pixel count as free, although their sum is 1.

    >>> attributes, faces = np.array([[9.0], [4.0], [6.0], [8.0]]), np.array([[2, 1, 3]])
    >>> b, grad_output = np.array([[[0.5, 0.25, 0.25]]]), np.array([[[8.0]]])
    >>> grads = interpolate_backward_loop(grad_output, attributes, faces, np.array([[0]]), b)
    >>> grads[0].T, grads[1]
    (array([[0., 2., 4., 2.]]), array([[[48., 32., 64.]]]))

    Fine print. A pixel without a face adds to nothing, whatever its grad_output and weights (NaN,
    too), and its grad_barycentric is 0.
    """
    raise NotImplementedError("exercise 5.9: interpolate_backward_loop")


def weight_rows(faces, face_index, barycentric):  # exercise 5.10 (3 points)
    """B of eq. (7) in compressed sparse rows: start (H W + 1,), vertex (3 N,), weight (3 N,).

    The rows of B are the pixels, row by row of the picture. N of them see a face. Row p has the
    entries n = start[p], start[p] + 1, ... below start[p + 1]: weight[n] is in column vertex[n]. A
    pixel that sees a face has three entries, in the order of its corners. One without has none.
    start and vertex are integers, start[0] = 0.

    >>> faces, seen = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[1, -1]])
    >>> weight_rows(faces, seen, np.array([[[0.5, 0.25, 0.25], [0.5, 0.5, 0.0]]]))
    (array([0, 3, 3]), array([2, 1, 3]), array([0.5 , 0.25, 0.25]))
    """
    raise NotImplementedError("exercise 5.10: weight_rows")


def interpolation_matrix(vertex_count, faces, face_index, barycentric):
    """B of eq. (7), a sparse matrix (H W, V), made of `weight_rows`.

    IndexError if a seen face names a vertex that is not there: SciPy would read on in memory.
    """
    start, vertex, weight = weight_rows(faces, face_index, barycentric)
    if len(vertex) and not 0 <= vertex.min() <= vertex.max() < vertex_count:
        raise IndexError(f"faces name rows {vertex.min()} to {vertex.max()} of the attributes, "
                         f"which have {vertex_count}: give the faces that belong to them")
    return scipy.sparse.csr_array((weight, vertex, start), (face_index.size, vertex_count))


def interpolate(attributes, faces, face_index, barycentric):  # exercise 5.11 (2 points)
    """Eq. (7): what `interpolate_loop` gives, without a loop over pixels -> (H, W, C).

    attributes (V, C), faces (F, 3), face_index (H, W), barycentric (H, W, 3). The given
    `interpolation_matrix` makes B. B @ x multiplies an array by it.

    Fine print. H and W may be 0.
    """
    raise NotImplementedError("exercise 5.11: interpolate")


def seen_corners(face_index, faces):
    """The pixels that see a face, in chunks that stay in the cache.

    Yields pixel (N,) = row * width + column, and corners (3, N), the vertices of each one's face.
    """
    for pixel in seen_pixels(face_index):
        yield pixel, faces.take(face_index.reshape(-1)[pixel], 0).T


def interpolate_backward(grad_output, attributes, faces, face_index,  # exercise 5.12 (4 points)
                         barycentric):
    """Eq. (8): what `interpolate_backward_loop` gives, without a loop over pixels.

    grad_output (H, W, C) -> grad_attributes (V, C), grad_barycentric (H, W, 3). The given
    `seen_corners` walks over the pixels that count.
    """
    raise NotImplementedError("exercise 5.12: interpolate_backward")


def interpolate_derivatives(attributes, faces, face_index, derivatives):  # exercise 5.13 (2 points)
    """Eq. (6): dA/dx and dA/dy per pixel -> (H, W, C, 2), 0 where no face is seen.

    derivatives (H, W, 3, 2): db/dx and db/dy, as lab 2's barycentrics_derivatives gives them. The
    others are as for `interpolate`.

    >>> attributes, faces = np.array([[9.0], [4.0], [6.0], [8.0]]), np.array([[2, 1, 3]])
    >>> db = np.array([[[[-0.5, 0.25], [0.5, 0.0], [0.0, -0.25]]]])
    >>> interpolate_derivatives(attributes, faces, np.array([[0]]), db)
    array([[[[-1. , -0.5]]]])

    Fine print. At pixels without a face the derivatives may be anything, NaN too.
    """
    raise NotImplementedError("exercise 5.13: interpolate_derivatives")


def interpolate_derivatives_backward(grad_output, attributes,  # exercise 5.14 (3 points)
                                     faces, face_index, derivatives):
    """Backward of eq. (6): what do the attributes and the weights' derivatives get?

    grad_output (H, W, C, 2) -> grad_attributes (V, C), grad_derivatives (H, W, 3, 2). The six
    derivatives of a pixel count as free.

    >>> attributes, faces = np.array([[9.0], [4.0], [6.0], [8.0]]), np.array([[2, 1, 3]])
    >>> db = np.array([[[[-0.5, 0.25], [0.5, 0.0], [0.0, -0.25]]]])
    >>> grads = interpolate_derivatives_backward(np.array([[[[2.0, 4.0]]]]), attributes, faces,
    ...                                          np.array([[0]]), db)
    >>> grads[0].T, grads[1]
    (array([[ 0.,  1.,  0., -1.]]), array([[[[12., 24.],
             [ 8., 16.],
             [16., 32.]]]]))

    Fine print. A pixel without a face adds to nothing, whatever its grad_output and derivatives
    (NaN, too), and its grad_derivatives are 0.
    """
    raise NotImplementedError("exercise 5.14: interpolate_derivatives_backward")
