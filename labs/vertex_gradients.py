"""Vertex gradients: how should the three vertices of a face move, so that a pixel becomes right?

    M = [q_0 q_1 q_2],   q_k = (x_k, y_k, 1),   a = (x, y, 1)      corners, and a pixel          (1)
    f = r^T M^-1 a - r_gt                       r: the corners' colours, r_gt: the target        (2)
    d(M^-1) = -M^-1 dM M^-1,   dM/dm_ij = e_i e_j^T                                              (3)
    df/dM = -M^-T r a^T M^-T = -(df/da) c^T,   c = M^-1 a                                        (4)

    q_k = (x_k, y_k, w_k) in clip space,   s = sum c,   b = c / s          in perspective        (5)
    grad_c = (grad_b - (grad_b . b) 1) / s,  grad_a = M^-T grad_c,  grad_M = -grad_a c^T         (6)

A vertex drags the picture along, by its weight. So its gradient (4) is minus the picture's slope
df/da, times the weight. A fit of one triangle is made of it, `fit_step`. For whole meshes,
rasterizer_gradients.py does the same without inverting a matrix.

Source: a note on the derivative of a rendered pixel with respect to its triangle's vertices, (1) to
(4). In perspective the note leaves out the sum s and its share in (6).
"""
import numpy as np


def vertex_matrix(triangle):  # step 7.1
    """Eq. (1): the matrix M of a triangle, one vertex in each column.

    triangle (3, 2), one vertex in each row -> M (3, 3).

    >>> vertex_matrix(np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]]))
    array([[0., 4., 0.],
           [0., 0., 2.],
           [1., 1., 1.]])
    """
    raise NotImplementedError("exercise 7.1: vertex_matrix")


def residual(values, m, a, target):
    """Eq. (2): by how much is the pixel a too bright? -> f, a number.

    values (3,): r of (2), one channel of the vertices' colours. m (3, 3) has an inverse. a (3,),
    and target is a number.

    >>> m = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
    >>> residual(np.array([8.0, 0.0, 4.0]), m, np.array([1.0, 1.0, 1.0]), 3.0)
    np.float64(1.0)
    """
    return values @ np.linalg.solve(m, a) - target


def inverse_differential(m, dm):  # step 7.2
    """Eq. (3): how does the inverse of m change where m changes by dm?

    m, dm (3, 3) -> (3, 3). It follows from M^-1 M = I.

    >>> dm = np.array([[0.0, 3.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    >>> inverse_differential(np.diag([1.0, 2.0, 4.0]), dm)[0, 1]
    np.float64(-1.5)
    """
    raise NotImplementedError("exercise 7.2: inverse_differential")


def residual_slope(values, m, a, i, j):  # step 7.3
    """df/dm_ij: the derivative of eq. (2) with respect to the element of m in row i, column j.

    values (3,), m (3, 3), a (3,) -> a number. Use eq. (3) with dM = e_i e_j^T, a single 1.

    >>> m = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
    >>> residual_slope(np.array([8.0, 0.0, 4.0]), m, np.array([1.0, 1.0, 1.0]), 0, 2)
    np.float64(1.0)
    """
    raise NotImplementedError("exercise 7.3: residual_slope")


def residual_backward(grad_f, values, m, a, target):  # step 7.4
    """Backward of eq. (2), with eq. (4): grad_f, a number -> grad_values (3,), grad_m (3, 3),
    grad_a (3,) and grad_target, a number.

    values (3,), m (3, 3), a (3,). All of their numbers are variables, even the 1s of eq. (1).

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
    raise NotImplementedError("exercise 7.4: residual_backward")


def fit_step(triangle, colours, points, target, colours_too=False):  # exercise 7.5 (5 points)
    """A step of Gauss-Newton: how must a triangle change to look like the target?

    triangle (3, 2), colours (3, C), points (P, 2), target (P, C) -> the change of triangle, and of
    colours. These stay, unless colours_too. Residuals (2), one for each point and channel, count as
    linear: make the sum of their squares the least. The shortest such change counts, as by
    `np.linalg.lstsq`. See `demo fit_vertices`.

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]])
    >>> points = np.array([[1.0, 1.0], [2.0, 0.5], [0.5, 0.5]])  # their colour is (x, y)
    >>> by_triangle, by_colours = fit_step(triangle, triangle, points, points - [0.5, 0.25])
    >>> by_triangle.round(9)
    array([[0.5 , 0.25],
           [0.5 , 0.25],
           [0.5 , 0.25]])
    """
    raise NotImplementedError("exercise 7.5: fit_step")


def barycentric(m, a):
    """Eq. (5): where on its face, in space, does a pixel lie? -> b (3,), with sum b = 1.

    m (3, 3): columns (x, y, w) in clip space, w of any sign. a (3,): the pixel in ndc.

    >>> m = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])  # w = 1/2 at vertex 1
    >>> barycentric(m, np.array([1.0, 0.0, 1.0]))
    array([0.6, 0.4, 0. ])
    """
    c = np.linalg.solve(m, a)
    return c / c.sum()


def barycentric_backward(grad_b, m, a):  # step 7.6
    """Eq. (6), backward of `barycentric`: grad_b (3,) -> grad_m (3, 3), grad_a (3,).

    m (3, 3), a (3,). All of their numbers are variables.

    >>> m = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])
    >>> grad_b, a = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 1.0])
    >>> grad_m, grad_a = barycentric_backward(grad_b, m, a)
    >>> grad_m.round(9) + 0.0
    array([[-0.24, -0.16,  0.  ],
           [ 0.  ,  0.  ,  0.  ],
           [ 0.24,  0.16,  0.  ]])
    """
    raise NotImplementedError("exercise 7.6: barycentric_backward")
