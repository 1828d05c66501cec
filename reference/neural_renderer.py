"""neural_renderer: faces on their own, and three maps of what each pixel sees.

A face is its three corners: x, y in ndc, y up, and z, the distance in front of the camera (w of
clip space). On screen, p = (1 + ndc) size / 2 and centres are at j + 1/2, as everywhere here. The
original counts from the first centre: its p is ours - 1/2, from -1/2 to size - 1/2.

    M = [p_0 p_1 p_2; 1 1 1]                       columns: a face's corners on screen         (1)
    c = M^-1 (x, y, 1),  u = clamp(c, 0, 1),  w = u / sum u         weights on screen          (2)
    z = 1 / sum_k w_k / z_k                        depth, right in perspective                 (3)

M^-1 is face_inv. Its rows are the edge functions of lab 2 over 2A, and it is the M^-1 of lab 7.
Texels and light, eqs. (4) to (6), are in texture_cubes.py. Two approximate gradients for outlines,
beside lab 8's, are in sweep_gradient.py and soft_rasterizer.py.

Sources: Kato, Ushiku, Harada 2018, and a reading of their rasterizer, neural_renderer. Where its
kernel does something else, the functions say so.
"""
from typing import NamedTuple

import numpy as np

from course.given.arrays import EDGES, scatter

from . import interpolation, transforms
from .rasterization import edge_function, signed_area


class Maps(NamedTuple):
    """What each pixel sees: face_index (H, W), screen_weights (H, W, 3), depth (H, W).

    -1, 0 and np.inf where no face is seen.
    """

    face_index: np.ndarray
    screen_weights: np.ndarray
    depth: np.ndarray


# --- pass 1: faces ------------------------------------------------------------------------------


def corners_of(clip, faces):
    """The corners (F, 3, 3) of faces (F, 3) with vertices clip (V, 4): x, y in ndc, and z = w."""
    ndc = clip[:, :2] / divisible(clip)[:, 3:]
    return np.column_stack([ndc, clip[:, 3]])[faces]


def corners_backward(grad_corners, clip, faces):
    """Backward of `corners_of`: grad_corners (F, 3, 3) -> grad_clip (V, 4)."""
    # A corner is gathered from its vertex, so gradients are scattered. x and y take lab 1's way
    # back through the divide: ndc is a screen of 2 x 2 pixels, but for a shift. z is w, so dw = dz.
    grad_vertex = scatter(grad_corners, faces, len(clip))
    grad_ndc = grad_vertex * [1, 1, 0]
    grad_clip = transforms.to_screen_backward(grad_ndc, divisible(clip), 2, 2)
    grad_clip[:, 3] += grad_vertex[:, 2]
    return grad_clip


def divisible(clip):
    """clip (V, 4) with w = 1 for vertices in the camera plane, where w = 0. Their faces are not
    drawn, so they may be anywhere on screen, and their gradient is 0.
    """
    return np.column_stack([clip[:, :3], np.where(clip[:, 3] == 0, 1, clip[:, 3])])


def on_screen(corners, width, height):
    """corners (F, 3, 3) -> triangles (F, 3, 2) in pixels: the one place where conventions meet."""
    return (corners[..., :2] + 1) * [width / 2, height / 2]


def front_faces(triangles, z):
    """Which faces are drawn? Those counter-clockwise on screen, y up, with all three z > 0.

    triangles (F, 3, 2), z (F, 3) -> bool (F,). A face without area is not drawn. (The original
    draws it, and does not look at z.)

    >>> a, b, c = [0.0, 0.0], [4.0, 0.0], [0.0, 3.0]
    >>> front_faces(np.array([[a, b, c], [a, c, b], [a, b, b], [a, b, c]]),
    ...             np.array([[1.0, 1, 1], [1, 1, 1], [1, 1, 1], [1, 1, -1]]))
    array([ True, False, False, False])
    """
    return (signed_area(triangles) > 0) & (z > 0).all(1)


def face_inverse(triangles):  # step 10.1
    """The inverse of M in eq. (1): triangles (..., 3, 2), one corner in each row -> (..., 3, 3).

    >>> small = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]])
    >>> face_inverse(np.array([small, 10 * small]))[0]  # of two faces
    array([[-0.25, -0.5 ,  1.  ],
           [ 0.25,  0.  ,  0.  ],
           [ 0.  ,  0.5 ,  0.  ]])
    """
    # Row k is the edge function of the edge from i to j, opposite to corner k: n . p + constant.
    x, y = triangles[..., 0], triangles[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    double_area = rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2]
    return (np.stack(rows, -2) + 0.0) / double_area[..., None, None]  # + 0.0 makes -0.0 to 0.0


def face_inverse_backward(grad_inverse, inverse):
    """Backward of `face_inverse`: grad_inverse, inverse (..., 3, 3) -> grad_screen (..., 3, 2)."""
    # d M^-1 = -M^-1 dM M^-1, so grad_M = -M^-T grad_inverse M^-T, as in lab 7. Its first two rows
    # are x and y of the corners.
    transposed = np.swapaxes(inverse, -1, -2)
    grad_matrix = -transposed @ grad_inverse @ transposed
    return np.swapaxes(grad_matrix[..., :2, :], -1, -2)


# --- pass 2: pixels -----------------------------------------------------------------------------


def screen_weights_and_depth(inverse, z, x, y):  # step 10.2
    """Eqs. (2) and (3) at points of the screen: weight w (..., 3) and depth z (...).

    inverse (..., 3, 3) is M^-1, z (..., 3) are the z_k, x, y (...). Faces hide each other by it.

    >>> inverse = np.array([[-0.25, -0.5, 1.0], [0.25, 0.0, 0.0], [0.0, 0.5, 0.0]])
    >>> x, y = np.array([1.0, 0.0]), np.array([1.0, 0.0])  # two points
    >>> screen_weights_and_depth(inverse, np.array([1.0, 1.0, 4.0]), x, y)
    (array([[0.25, 0.25, 0.5 ],
           [1.  , 0.  , 0.  ]]), array([1.6, 1. ]))
    """
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.clip(c, 0, 1)
    weight = clamped / (clamped[..., :1] + clamped[..., 1:2] + clamped[..., 2:])
    part = weight / z
    return weight, 1 / (part[..., 0] + part[..., 1] + part[..., 2])


def screen_weights_and_depth_backward(grad_weight, grad_depth,  # exercise 10.5 (3 points)
                                      inverse, z, x, y):
    """Backward of eqs. (2) and (3): grad_weight (..., 3), grad_depth (...) -> grad_inverse
    (..., 3, 3), grad_z (..., 3).

    depth depends on z directly, and on inverse through weight.

    >>> inverse = np.array([[-0.25, -0.5, 1.0], [0.25, 0.0, 0.0], [0.0, 0.5, 0.0]])
    >>> z, x, y = np.array([1.0, 1.0, 4.0]), np.array(1.0), np.array(1.0)
    >>> screen_weights_and_depth_backward(np.zeros(3), np.array(25.0), inverse, z, x, y)
    (array([[-24., -24., -24.],
           [-24., -24., -24.],
           [ 24.,  24.,  24.]]), array([16., 16.,  2.]))

    Fine print. Where the clamp changes c_k, c_k has no gradient. A c_k of exactly 0 or 1 is not
    changed.
    """
    weight, depth = screen_weights_and_depth(inverse, z, x, y)
    # depth = 1 / q with q = sum w_k / z_k: d depth = -depth^2 dq.
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    # c = M^-1 p, w = u / s, s = sum u, and u = c except where it is clamped.
    p = np.stack([x, y, np.ones_like(x)], -1)[..., None, :]
    c = (inverse * p).sum(-1)
    s = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_u = interpolation.normalize_backward(grad_weight, weight, s, axis=-1)
    grad_c = np.where((c < 0) | (c > 1), 0, grad_u)
    return grad_c[..., None] * p, grad_z  # dc = dM^-1 p


def covers(triangles, x, y):
    """Is (x, y) in a face, border included? triangles (..., 3, 2), counter-clockwise, x, y (...).

    Both faces at an edge cover a point on it. There is no top-left rule: the z-buffer decides.
    """
    p = np.stack([x, y], -1)
    e = np.stack([edge_function(p, triangles[..., i, :], triangles[..., j, :]) for i, j in EDGES])
    return (e >= 0).all(0)


def pixel_box(triangles, width, height):
    """The pixels whose centres lie in the box around a face, border included.

    triangles (..., 3, 2) -> x0, y0, x1, y1 (...): columns x0 <= j < x1, rows y0 <= i < y1, or none.
    """
    low = np.clip(np.ceil(triangles.min(-2) - 0.5), 0, [width, height]).astype(int)
    high = np.clip(np.floor(triangles.max(-2) + 0.5), low, [width, height]).astype(int)
    return low[..., 0], low[..., 1], high[..., 0], high[..., 1]


def rasterize(corners, width, height, near=0.1, far=100.0):  # exercise 10.3 (6 points)
    """Pass 2 for all faces: which is the nearest that covers each pixel's centre? -> Maps

    corners (F, 3, 3) as `corners_of` has them. Only `front_faces` are seen, where near < depth <
    far. `on_screen`, `pixel_box` and `covers` are given. See `demo cubes`.

    >>> corners = np.array([[[-1.0, -1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, 1.0, 2.0]]])
    >>> maps = rasterize(corners, 4, 2)
    >>> maps.face_index, maps.depth
    (array([[ 0,  0,  0, -1],
           [ 0, -1, -1, -1]]), array([[ 2.,  2.,  2., inf],
           [ 2., inf, inf, inf]]))
    >>> maps.screen_weights[0, 1]
    array([0.375, 0.375, 0.25 ])

    Fine print. The first of two equally deep faces is seen, as in lab 2.
    """
    face_index = np.full((height, width), -1)
    weight = np.zeros((height, width, 3))
    depth = np.full((height, width), np.inf)
    triangles, z = on_screen(corners, width, height), corners[..., 2]
    drawn = np.flatnonzero(front_faces(triangles, z))
    inverse, boxes = face_inverse(triangles[drawn]), pixel_box(triangles[drawn], width, height)
    for f, inverse_f, x0, y0, x1, y1 in zip(drawn, inverse, *boxes, strict=True):
        box = np.s_[y0:y1, x0:x1]
        x, y = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
        w, d = screen_weights_and_depth(inverse_f, z[f], x, y)
        nearest = covers(triangles[f], x, y) & (near < d) & (d < far) & (d < depth[box])
        face_index[box][nearest] = f
        weight[box][nearest], depth[box][nearest] = w[nearest], d[nearest]
    return Maps(face_index, weight, depth)


def rasterize_backward(grad_weight, grad_depth, face_index, corners):
    """Backward of `rasterize`: grad_weight (H, W, 3), grad_depth (H, W) -> grad_corners (F, 3, 3).

    It is exact as long as each pixel sees the same face. Pixels that see no face are ignored. (The
    original has such a gradient for the depth alone.)
    """
    height, width = face_index.shape
    triangles = on_screen(corners, width, height)
    z = corners[..., 2]
    row, column = np.nonzero(face_index >= 0)
    face = face_index[row, column]
    seen, pixel_face = np.unique(face, return_inverse=True)
    inverse = face_inverse(triangles[seen])
    grads = screen_weights_and_depth_backward(grad_weight[row, column], grad_depth[row, column],
                                              inverse[pixel_face], z[face], column + 0.5, row + 0.5)
    # Each pixel gathers M^-1 and z of its face, so their gradients are scattered.
    grad_inverse, grad_z = (scatter(grad, pixel_face, len(seen)) for grad in grads)
    grad_screen = face_inverse_backward(grad_inverse, inverse)
    grad_corners = np.zeros(corners.shape)
    grad_corners[seen, :, :2] = grad_screen * [width / 2, height / 2]
    grad_corners[seen, :, 2] = grad_z
    return grad_corners
