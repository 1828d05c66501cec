"""Inverse rendering: from pictures back to the scene, by the gradient of everything before.

    I = R(theta),   theta = argmin L(R(theta), T)     theta: positions, colours, pose, texture   (1)
    L = mean (I - T)^2                                squared error, T is the target             (2)
    m' = b1 m + (1 - b1) g,   s' = b2 s + (1 - b2) g^2,   x' = x - rate m^ / (sqrt(s^) + epsilon),
    m^ = m' / (1 - b1^n),     s^ = s' / (1 - b2^n)    step n of Adam, from n = 1                 (3)
    L = 1 - sum(c t) / sum(c + t - c t)               soft IoU loss of silhouettes c and t       (4)
    d_v = x_v - mean of x over v's neighbours         uniform Laplacian, 0 where flat and even   (5)
    v' = q v q* / |q|^2                               rotation by a quaternion q = (w, x, y, z)  (6)

R is `pipeline.render`, which joins the labs before this one. The gradient of a parameter x, grad_x,
has its shape. Adam's m and s are arrays like x, at first 0. Whoever calls `adam_step` keeps them.
In (6), the point v is the quaternion (0, v), and q* is (w, -x, -y, -z).

Sources: lecture "Differentiable graphics 1", Kingma and Ba 2015 (3), Kato et al. 2018 (4), Taubin
1995 (5), Shoemake 1985 (6), Laine et al. 2020.
"""
import numpy as np

from course.given.arrays import scatter


def squared_error(picture, target):  # step 9.1
    """Eq. (2): how far is a picture from its target, and how should each value change?

    picture, target: floats of one shape -> the loss, a number, and its gradient grad_picture.

    >>> squared_error(np.array([[[1.0, 2.0], [3.0, 8.0]]]), np.array([[[1.0, 0.0], [3.0, 4.0]]]))
    (np.float64(5.0), array([[[0., 1.],
            [0., 2.]]]))
    """
    difference = picture - target
    return (difference**2).mean(), 2 * difference / difference.size


def adam_step(x, grad_x, mean, square, step, rate,  # exercise 9.4 (3 points)
              constants=(0.9, 0.999, 1e-8)):
    """Eq. (3): step n of Adam, downhill -> x', mean m', square s'.

    x, grad_x (g), mean (m) and square (s) have one shape, step (n) and rate are numbers, and the
    constants b1, b2, epsilon.

    >>> x, grad_x, zero = np.array([5.0, 5.0]), np.array([4.0, -100.0]), np.zeros(2)
    >>> x, mean, square = adam_step(x, grad_x, zero, zero, 1, rate=0.25)
    >>> x.round(6), mean.round(6), square.round(6)
    (array([4.75, 5.25]), array([  0.4, -10. ]), array([ 0.016, 10.   ]))
    """
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    # Both began at 0, so they are too small by these factors.
    corrected_mean = mean / (1 - beta_1**step)
    corrected_square = square / (1 - beta_2**step)
    return x - rate * corrected_mean / (np.sqrt(corrected_square) + epsilon), mean, square


def descend(x, gradient, schedule, update=adam_step, project=lambda x: x):
    """Eq. (3), step after step: yields x after each step, and the loss before it.

    x: the parameters, an array or a NamedTuple of arrays. gradient(x) -> loss, grad_x, which has
    the form of x. It is called once a step, and may draw views or record what it sees. schedule:
    the learning rate of each step, such as `decay` makes. update: a function with the arguments and
    results of `adam_step`. A rate, and update, may also be a NamedTuple like x, with one for each
    array. project(x): the nearest x that is allowed, such as a quaternion of length 1.

    >>> def gradient(x):
    ...     return (x**2).sum(), 2 * x
    >>> for x, loss in descend(np.array([3.0]), gradient, schedule=[1.0, 0.5]):
    ...     print(x.round(3), loss.round(3))
    [2.] 9.0
    [1.515] 4.0
    """
    means = [np.zeros_like(array) for array in arrays_of(x, x)]
    squares = [np.zeros_like(array) for array in arrays_of(x, x)]
    for step, rate in enumerate(schedule, 1):
        loss, grad_x = gradient(x)
        arrays = list(arrays_of(x, x))
        grads, rates, updates = (arrays_of(value, x) for value in (grad_x, rate, update))
        for k, array in enumerate(arrays):
            arrays[k], means[k], squares[k] = updates[k](
                array, grads[k], means[k], squares[k], step, rates[k])
        x = project(type(x)(*arrays) if isinstance(x, tuple) else arrays[0])
        yield x, loss


def arrays_of(value, x):
    """What a value holds for each array of x: its fields or, if it has none, itself each time."""
    count = len(x) if isinstance(x, tuple) else 1
    return value if isinstance(value, tuple) else (value,) * count


def decay(rate, factor, steps):
    """A schedule for `descend`: from rate by equal factors down to rate * factor, not included."""
    return [rate * factor**(step / steps) for step in range(steps)]


def silhouette_loss(coverage, target):  # exercise 9.5 (4 points)
    """Eq. (4), soft IoU (Jaccard): 1 - intersection over union of two silhouettes.

    coverage, target: floats of one shape, from 0 to 1 -> the loss, a number, and its gradient
    grad_coverage. See `demo fit_bunny`.

    >>> silhouette_loss(np.array([1.0, 1.0, 0.5, 0.0]), np.array([0.0, 1.0, 1.0, 0.0]))
    (np.float64(0.5), array([ 0.16666667, -0.33333333, -0.33333333,  0.16666667]))

    Fine print. Two empty silhouettes are the same: the loss is 0, and so is its gradient.
    """
    both = (coverage * target).sum()
    either = (coverage + target - coverage * target).sum()
    if either == 0:
        return 0.0, np.zeros(coverage.shape)
    # L = 1 - A / U: dL = -dA / U + A dU / U^2, with dA = t dc and dU = (1 - t) dc in each pixel.
    grad_coverage = (both / either * (1 - target) - target) / either
    return 1 - both / either, grad_coverage


def uniform_laplacian(positions, edges):  # extra 9.6 (2 points)
    """Eq. (5): how far is each vertex from the mean of its neighbours?

    positions (V, C), edges (E, 2), each pair of neighbours once, in either order -> d (V, C). A
    vertex without edges has d = 0.

    >>> positions = np.array([[0.0, 3.0], [4.0, 5.0], [8.0, 1.0], [9.0, 9.0]])
    >>> uniform_laplacian(positions, np.array([[0, 1], [1, 2]]))
    array([[-4., -2.],
           [ 0.,  3.],
           [ 4., -4.],
           [ 0.,  0.]])
    """
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    total = scatter(positions[neighbour], vertex, len(positions))
    return np.where(valence > 0, positions - total / np.maximum(valence, 1), 0)


def uniform_laplacian_backward(grad_laplacian, positions, edges):  # extra 9.7 (3 points)
    """Backward of eq. (5): grad_laplacian (V, C) -> grad_positions (V, C).

    Eq. (5) is linear, so that only the shape of positions matters.

    >>> positions = np.array([[0.0], [4.0], [8.0], [9.0]])
    >>> grad_laplacian = np.array([[0.0], [1.0], [10.0], [100.0]])
    >>> uniform_laplacian_backward(grad_laplacian, positions, np.array([[0, 1], [1, 2]]))
    array([[-0.5],
           [-9. ],
           [ 9.5],
           [ 0. ]])
    """
    # d = x - W x with W_vn = 1 / valence_v for each neighbour n of v: grad_x = grad_d - W^T grad_d.
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    share = grad_laplacian / np.maximum(valence, 1)
    total = scatter(share[vertex], neighbour, len(positions))
    return np.where(valence > 0, grad_laplacian, 0) - total


def uniform_laplacian_energy(positions, edges):
    """The sum of |d_v|^2 over all vertices, the energy of a thin plate: less is smoother."""
    return (uniform_laplacian(positions, edges)**2).sum()


def uniform_laplacian_energy_backward(grad_energy, positions, edges):
    """Backward of `uniform_laplacian_energy`: grad_energy, a number -> grad_positions (V, C)."""
    grad_laplacian = 2 * grad_energy * uniform_laplacian(positions, edges)
    return uniform_laplacian_backward(grad_laplacian, positions, edges)


def quaternion_product(p, q):  # extra 9.9 (2 points)
    """The product p q of quaternions. It rotates first by q, then by p.

    p, q (..., 4), shapes that broadcast -> (..., 4). (w, x, y, z) stands for w + xi + yj + zk. The
    squares of i, j, k are -1. ij = k, jk = i, ki = j change signs in reverse order.

    >>> quaternion_product(np.array([0.0, 1.0, 0.0, 0.0]), np.array([2.0, 0.0, 3.0, 0.0]))
    array([0., 2., 0., 3.])
    """
    pw, px, py, pz = np.moveaxis(p, -1, 0)
    qw, qx, qy, qz = np.moveaxis(q, -1, 0)
    return np.stack([pw * qw - px * qx - py * qy - pz * qz,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_matrix(q):  # extra 9.8 (2 points)
    """Eq. (6) as a matrix (4, 4), like lab 1's rotations: it rotates points as q (4,) does.

    q may have any length but 0. `quaternion_product` or `cross_matrix` will help. See
    `demo fit_triangle`.

    >>> quaternion_matrix(np.array([2.0, 0.0, 0.0, 2.0])).round(9) @ np.array([1.0, 5.0, 7.0, 1.0])
    array([-5.,  1.,  7.,  1.])
    """
    # (w, u) (0, v) (w, -u) = (0, v') with v' = |q|^2 v + 2 w u x v + 2 u x (u x v).
    matrix = np.eye(4)
    K = cross_matrix(q[1:])
    matrix[:3, :3] += 2 / (q @ q) * (q[0] * K + K @ K)
    return matrix


def quaternion_matrix_backward(grad_matrix, q):  # extra 9.10 (4 points)
    """Backward of `quaternion_matrix`: grad_matrix (4, 4) -> grad_q (4,).

    All four numbers of q are free. Its length makes no difference to the matrix, so grad_q is at
    right angles to q.

    >>> grad_matrix = np.zeros((4, 4))
    >>> grad_matrix[1, 0] = 3.0  # element [1, 0] is 2 (x y + w z) / |q|^2
    >>> quaternion_matrix_backward(grad_matrix, np.array([2.0, 0.0, 0.0, 1.0])) + 0.0
    array([-0.72,  0.  ,  0.  ,  1.44])
    """
    # R = I + s B, B = w K + K K, s = 2 / |q|^2. With G for grad_R, the loss changes by
    # G . B ds + s G . (dw K + w dK + dK K + K dK), and ds = -s^2 q . dq.
    G = grad_matrix[:3, :3]
    K = cross_matrix(q[1:])
    s = 2 / (q @ q)
    w = q[0]
    grad_K = s * (w * G + G @ K.T + K.T @ G)
    grad_xyz = [grad_K[2, 1] - grad_K[1, 2], grad_K[0, 2] - grad_K[2, 0],
                grad_K[1, 0] - grad_K[0, 1]]
    return np.append(s * (G * K).sum(), grad_xyz) - s**2 * (G * (w * K + K @ K)).sum() * q


def cross_matrix(u):
    """The matrix K (3, 3) with K v = u x v, for u (3,)."""
    x, y, z = u
    return np.array([[ 0, -z,  y],
                     [ z,  0, -x],
                     [-y,  x,  0]])


def rotation_angle(p, q):  # extra 9.11 (2 points)
    """By what angle, from 0 to pi, do two rotations differ? p, q (..., 4) of length 1 -> (...).

    It is the angle of the rotation from one to the other. q and -q stand for the same rotation.

    >>> quarter = np.array([1.0, 0.0, 0.0, 1.0]) / np.sqrt(2)
    >>> rotation_angle(quarter, np.array([1.0, 0.0, 0.0, 0.0])).round(6)
    np.float64(1.570796)

    Fine print. A fit ends with small angles, so all angles keep their digits: 1e-9 is right to
    1e-15, and pi - 1e-6 to 1e-14.
    """
    # Let h be the angle between p and q. |p - q| = 2 sin(h/2), |p + q| = 2 cos(h/2), and the
    # rotation is by 2 h, or with -q for q, by less. arccos(p . q) would lose a small h's digits.
    diagonals = np.sort([np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1)], 0)
    return 4 * np.arctan2(diagonals[0], diagonals[1])
