"""Vertex gradients: what does a pixel want of the three vertices of the face that it sees?

    M = [q_0 q_1 q_2],   q_k = (x_k, y_k, 1),   a = (x, y, 1)      corners, and a pixel          (1)
    f = r^T M^-1 a - r_gt                       colours r at the corners, r_gt is wanted         (2)
    d(M^-1) = -M^-1 dM M^-1,   dM/dm_ij = e_i e_j^T                                              (3)
    df/dM = -M^-T r a^T M^-T = -(df/da) c^T,   c = M^-1 a                                        (4)

    q_k = (x_k, y_k, w_k) of clip space,   s = sum c,   b = c / s          in perspective        (5)
    grad_c = (grad_b - (grad_b . b) 1) / s,  grad_a = M^-T grad_c,  grad_M = -grad_a c^T         (6)

A vertex drags the picture along, by its weight. So its gradient (4) is minus the picture's slope
df/da, times the weight. For whole meshes, rasterizer_gradients.py does the same without inverting
a matrix.

Source: a note on the derivative of a rendered pixel by its triangle's vertices, (1) to (4). In
perspective it leaves out the sum s and its share in (6).
"""
import numpy as np

from .interpolation import normalize_backward


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

    No loop over elements. Rows 0 and 1 of grad_m are the gradients with respect to the vertices' x
    and y. Row 2 is of use in perspective. m and a count as free numbers, also where they are 1.

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

    residuals (R,), jacobian (R, U): their derivatives with respect to U unknowns. The step makes
    |residuals + jacobian step| least. It is the shortest such step. R may be smaller than U.

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
