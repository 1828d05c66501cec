"""Transforms: from a vertex of the model to a point on the screen.

Spaces: model -> world -> view (camera) -> clip -> ndc -> screen. Points are rows, while matrices
act on columns. Right-handed. The camera looks down -z.

    (x, y, z)  ->  (x, y, z, 1)                             homogeneous coordinates           (1)
    clip = P V M (x, y, z, 1)                               model, view, projection           (2)
    R = cos I + (1 - cos) n n^T + sin [n]x                  n = axis/|axis|, [n]x v = n x v   (3)
    V = [right above back]^T T(-eye),  above = back x right       the camera's axes as rows   (4)
        back = (eye - target) / |eye - target|,  right = (up x back) / |up x back|
    tan(fov_y / 2) = t / near,  r / t = aspect = width / height,  l = -r,  b = -t             (5)
        [2 near/(r-l)      0        (r+l)/(r-l)     0  ]
    P = [    0        2 near/(t-b)  (t+b)/(t-b)     0  ]    alpha and beta bring z = -near    (6)
        [    0             0           alpha      beta ]    to ndc -1, and z = -far to 1
        [    0             0            -1          0  ]
    ndc = (x, y, z) / w                                     the divide                        (7)
    screen: x and y from -1..1 to 0..width and 0..height    the viewport, z stays             (8)

What is visible has -w <= x, y, z <= w in clip space. Angles are in radians.
Sources: OpenGL 1.0 manual, notes on GAMES101, "Differentiable graphics 1" (errata in lecture 1).
"""
import numpy as np


def to_homogeneous(points):
    """Eq. (1): append a 1 to each point: points (..., 3) -> (..., 4).

    >>> to_homogeneous(np.array([[1.0, 2.0, 3.0]]))
    array([[1., 2., 3., 1.]])
    """
    return np.concatenate([points, np.ones_like(points[..., :1])], -1)


def transform(points, matrix):  # exercise 1.1 (1 point)
    """Eq. (2), one matrix of it: where does it move the points?

    points (..., 4), matrix (4, 4) -> (..., 4).

    >>> transform(np.array([[1.0, 2.0, 3.0, 1.0]]), np.diag([2.0, 1.0, 1.0, 1.0]))
    array([[2., 2., 3., 1.]])
    """
    raise NotImplementedError("exercise 1.1: transform")


def transform_backward(grad_output, points, matrix):  # exercise 1.10 (2 points)
    """Backward of `transform`: grad_output (..., 4) -> grad_points (..., 4), grad_matrix (4, 4).

    All points share the one matrix, so each adds to grad_matrix.

    >>> point, matrix = np.array([5.0, 6.0, 8.0, 1.0]), np.diag([1.0, 2.0, 3.0, 4.0])
    >>> grad_point, grad_matrix = transform_backward(np.array([0.0, 10.0, 0.0, 0.0]), point, matrix)
    >>> grad_point, grad_matrix[1]
    (array([ 0., 20.,  0.,  0.]), array([50., 60., 80., 10.]))
    """
    raise NotImplementedError("exercise 1.10: transform_backward")


def translate(offset):
    """The matrix (4, 4) that moves points by offset (3,).

    >>> translate(np.array([5.0, 6.0, 7.0])) @ np.array([1.0, 1.0, 1.0, 1.0])
    array([6., 7., 8., 1.])
    """
    matrix = np.eye(4)
    matrix[:3, 3] = offset
    return matrix


def scale(factors):
    """The matrix (4, 4) that scales x, y, z by factors (3,).

    >>> scale(np.array([2.0, 3.0, 4.0])) @ np.array([1.0, 1.0, 1.0, 1.0])
    array([2., 3., 4., 1.])
    """
    return np.diag([*factors, 1.0])


def rotate(axis, angle):  # extra 1.2 (2 points)
    """Eq. (3), Rodrigues: the matrix (4, 4) that turns points by an angle about an axis (3,).

    R is its upper left 3 x 3. n n^T is the outer product of n with itself.

    >>> rotate(np.array([0.0, 0.0, 2.0]), np.pi / 2).round(3) @ np.array([1.0, 0.0, 0.0, 1.0])
    array([0., 1., 0., 1.])
    """
    n = axis / np.linalg.norm(axis)
    x, y, z = n
    cross = np.array([[ 0, -z,  y],
                      [ z,  0, -x],
                      [-y,  x,  0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * np.outer(n, n)
                      + np.sin(angle) * cross)
    return matrix


def look_at(eye, target, up):  # exercise 1.3 (3 points)
    """Eq. (4): view_from_world (4, 4) of a camera at eye (3,) that looks at target (3,).

    up (3,) points roughly upwards.

    >>> look_at(np.array([0.0, 0.0, 5.0]), np.zeros(3), np.array([0.0, 1.0, 0.0]))[2]
    array([ 0.,  0.,  1., -5.])

    Fine print. Where up is along the view, or the eye at its target, nothing says what is right.
    Raise a ValueError there, for 0 / 0 is NaN. Rounding may leave 1e-16 |up| |back| in place of 0.
    """
    raise NotImplementedError("exercise 1.3: look_at")


def normal_matrix(matrix):  # extra 1.4 (2 points)
    """The matrix N (3, 3) that moves the normals of a surface whose points matrix (4, 4) moves.

    (N n) . (A v) = n . v for all n and v, where A is the upper left 3 x 3 of the matrix. So a
    normal stays at right angles to its surface.

    >>> normal_matrix(np.diag([2.0, 1.0, 1.0, 1.0])) @ np.array([1.0, 1.0, 0.0])
    array([0.5, 1. , 0. ])
    """
    # n^T N^T A v = n^T v for all n and v, so N^T A = I.
    return np.linalg.inv(matrix[:3, :3]).T


def pinhole(f):  # step 1.5
    """The matrix (4, 4) of a pinhole camera of focal length f: after the divide (f x/z, f y/z, f).

    This is the textbook's camera. It looks down +z and keeps no depth. `perspective` mends both.

    >>> pinhole(2.0) @ np.array([1.0, 3.0, 4.0, 1.0])
    array([2., 6., 8., 4.])
    """
    raise NotImplementedError("exercise 1.5: pinhole")


def frustum_sides(fov_y, aspect, near):  # step 1.6
    """Eq. (5): l, r, b, t of the near plane, four numbers. fov_y is the angle from bottom to top.

    >>> np.round(frustum_sides(np.pi / 2, 2.0, 0.5), 3)
    array([-1. ,  1. , -0.5,  0.5])
    """
    raise NotImplementedError("exercise 1.6: frustum_sides")


def perspective(fov_y, aspect, near, far):  # exercise 1.7 (3 points)
    """Eqs. (5) and (6): clip_from_view (4, 4) of a camera that looks straight ahead.

    fov_y: the angle from bottom to top. near, far: distances. The two conditions of (6) say what
    alpha and beta are. See `demo cut`.

    >>> perspective(np.pi / 2, 2.0, 1.0, 3.0).round(9)
    array([[ 0.5,  0. ,  0. ,  0. ],
           [ 0. ,  1. ,  0. ,  0. ],
           [ 0. ,  0. , -2. , -3. ],
           [ 0. ,  0. , -1. ,  0. ]])
    """
    raise NotImplementedError("exercise 1.7: perspective")


def frustum(l, r, b, t, near, far):
    """Eq. (6): clip_from_view (4, 4) of a camera that sees l to r and b to t of its near plane."""
    matrix = perspective(np.pi / 2, 1.0, near, far)  # of which depth and w stay
    matrix[0] = 2 * near / (r - l), 0, (r + l) / (r - l), 0
    matrix[1] = 0, 2 * near / (t - b), (t + b) / (t - b), 0
    return matrix


def orthographic(l, r, b, t, near, far):  # extra 1.8 (2 points)
    """clip_from_view (4, 4) without perspective: the box l..r, b..t, z = -near..-far fills ndc.

    An object that is shallow beside its distance looks nearly as it does through `frustum`, if l,
    r, b, t are what the camera sees in the plane through the object.

    >>> orthographic(0.0, 4.0, -1.0, 1.0, 1.0, 3.0) @ np.array([4.0, 1.0, -1.0, 1.0])
    array([ 1.,  1., -1.,  1.])
    """
    return np.array([[2 / (r - l), 0,           0,                -(r + l) / (r - l)],
                     [0,           2 / (t - b), 0,                -(t + b) / (t - b)],
                     [0,           0,           2 / (near - far), (far + near) / (near - far)],
                     [0,           0,           0,                1]])


def to_screen(clip, width, height):  # exercise 1.9 (2 points)
    """Eqs. (7) and (8): where on screen, and how deep, are points in clip space?

    clip (..., 4), w not 0 -> screen (..., 3): x and y in pixels, y up, and the depth, z of ndc. See
    `demo ties`.

    >>> to_screen(np.array([2.0, -2.0, 2.0, 4.0]), 640, 480)
    array([480. , 120. ,   0.5])
    """
    raise NotImplementedError("exercise 1.9: to_screen")


def to_screen_backward(grad_screen, clip, width, height):  # exercise 1.11 (3 points)
    """Backward of `to_screen`: grad_screen (..., 3), clip (..., 4) -> grad_clip (..., 4).

    See `demo fit_triangle`.

    >>> to_screen_backward(np.array([1.0, 0.0, 0.0]), np.array([6.0, 4.0, -2.0, 2.0]), 640, 480)
    array([ 160.,    0.,    0., -480.])
    """
    raise NotImplementedError("exercise 1.11: to_screen_backward")


def project(positions, clip_from_model, width, height):
    """Eqs. (1), (2), (7), (8): positions (V, 3) in model space -> screen (V, 3).

    Nothing is clipped: what lies behind the camera comes out mirrored.
    """
    return to_screen(transform(to_homogeneous(positions), clip_from_model), width, height)


def project_backward(grad_screen, positions, clip_from_model, width, height):
    """Backward of `project`: -> grad_positions (V, 3), grad_clip_from_model (4, 4)."""
    points = to_homogeneous(positions)
    grad_clip = to_screen_backward(grad_screen, transform(points, clip_from_model), width, height)
    grad_points, grad_matrix = transform_backward(grad_clip, points, clip_from_model)
    return grad_points[:, :3], grad_matrix
