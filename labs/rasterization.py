"""Rasterization: which face does each pixel see, and how deep?

Screen space: x right, y up. Pixel [row i, column j] is sampled at its centre (j + 0.5, i + 0.5).

    e(p) = det [x y 1; a_x a_y 1; b_x b_y 1] = n . (p - a),   n = (a_y - b_y, b_x - a_x)     (1)
    covered  <=>  every e_k > 0, or e_k = 0 where edge k is a top-left edge                  (2)
    l_k = e_k / 2A,   2A = e_0 + e_1 + e_2     screen weights, e_k opposite to vertex k      (3)
    depth = z_0 + l_1 (z_1 - z_0) + l_2 (z_2 - z_0),   z_k = z / w; the least is seen        (4)
    c_k = e_k / w_k,   all of one sign where covered, behind the camera, too                 (5)

Up to a common factor, c is M^-1 (x, y, 1), where column k of M is w_k (x_k, y_k, 1): the edge
functions, lab 7's inverse and lab 10's face_inv are the same numbers. Lab 5 makes of them where on
its face a pixel lies.

Sources: Pineda 1988 (1), lecture "Differentiable graphics 1" (3) to (5), notes on GAMES101 (4).
"""
import numpy as np

from course.given.arrays import EDGES
from course.given.faster import has_faster

from . import transforms

CAMERA_PLANE = 1e-10  # the least |w| of a vertex, in units of its |x| or |y|
MARGIN = 1 / 256      # pixels added to a face's bounds: more than rounding moves its edges


def edge_function(p, a, b):  # step 2.1
    """Eq. (1): on which side of the line from a to b is p? Positive on its left.

    p, a, b (..., 2) broadcast -> e (...).

    >>> edge_function(np.array([0.0, 1.0]), np.array([0.0, 0.0]), np.array([2.0, 0.0]))
    np.float64(2.0)

    Fine print. Let edge_function(p, b, a) be -edge_function(p, a, b) to the last bit, and e exactly
    0 at both ends. Then neighbours, which walk their edge in opposite directions, leave no hole. So
    measure p from the same end in both, say from the one with the smaller x.
    """
    raise NotImplementedError("exercise 2.1: edge_function")


def signed_area(triangle):
    """The area of a triangle: positive if it is counter-clockwise, negative if clockwise.

    triangle (..., 3, 2) -> (...).

    >>> signed_area(np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]]))
    np.float64(1.0)
    """
    x, y = triangle[..., 0], triangle[..., 1]
    x1, y1 = x[..., 1] - x[..., 0], y[..., 1] - y[..., 0]
    x2, y2 = x[..., 2] - x[..., 0], y[..., 2] - y[..., 0]
    return (x1 * y2 - x2 * y1) / 2


def is_top_left(n_x, n_y):  # step 2.2
    """Is an edge a top-left edge, one that owns the samples exactly on it?

    n_x, n_y (...), its normal n of eq. (1), into the face -> bool (...). True for left edges (n
    points right) and lower horizontal ones (n points up: row 0, the top in memory, is our lowest).

    >>> is_top_left(np.array([1.0, -1.0, 0.0, 0.0]), np.array([-5.0, 5.0, 1.0, -1.0]))
    array([ True, False,  True, False])
    """
    raise NotImplementedError("exercise 2.2: is_top_left")


def screen_weights(p, triangle):  # step 2.3
    """Eq. (3): barycentric coordinates on the screen, l (..., 3): l @ triangle = p and sum l = 1.

    p (..., 2), triangle (3, 2), of either winding, of an area other than 0.

    >>> triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    >>> screen_weights(np.array([1.0, 0.0]), triangle)
    array([0.75, 0.25, 0.  ])
    """
    raise NotImplementedError("exercise 2.3: screen_weights")


def cover(p, triangle, z):  # exercise 2.4 (6 points)
    """Eqs. (2) to (4): does a face cover the samples, and how deep is it there?

    p (..., 2): samples. triangle (3, 2): a face's corners on screen, z (3,): their depths ->
    covered (...), depth (...). A clockwise face is seen, too: exchange two of its corners, and
    their z. Edge k has the ends i, j = EDGES[k]. A sample on an edge is covered if that is top-left
    (2). Depths beyond -1 or 1 are not covered.

    >>> triangle, z = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]), np.array([0.0, 0.8, 0.4])
    >>> cover(np.array([[0.0, 1.0], [1.0, 0.0], [2.0, 2.0]]), triangle, z)
    (array([ True,  True, False]), array([0.1, 0.2, 0.6]))

    Fine print. Exactly one of two neighbours covers a sample on their edge: an edge's function is
    its negative, to the last bit, when its ends are swapped, and exactly 0 at both. Depths of -1
    and 1 are covered, too: eq. (4) is exact where all z are equal, and sum l_k z_k is not. A face
    without area covers nothing.
    """
    raise NotImplementedError("exercise 2.4: cover")


def bounding_box(triangle, width, height):  # exercise 2.5 (2 points)
    """The pixels whose centres lie in a triangle's box: columns x0 <= j < x1, rows y0 <= i < y1.

    triangle (3, 2) -> the integers x0, y0, x1, y1, cut to the picture. The box is MARGIN wider than
    the triangle on each side, for rounding. Column j has its centre at j + 0.5.

    >>> bounding_box(np.array([[0.5, -9.0], [3.0, 1.2], [2.5, 1.0]]), 8, 8)
    (0, 0, 3, 1)

    Fine print. A centre on the box's border is in it. x0 and x1 lie between 0 and width, y0 and y1
    between 0 and height, however far out the triangle is. If there is no pixel, x0 >= x1 or
    y0 >= y1.
    """
    raise NotImplementedError("exercise 2.5: bounding_box")


def screen_points(clip, width, height):
    """Where the vertices are on screen, by lab 1's `to_screen`.

    clip (V, 4) -> x, y in pixels and w, each (V,) of float64. A vertex behind the camera (w < 0)
    comes out mirrored.

    >>> screen_points(np.array([[0.0, 2.0, 0.0, 2.0], [0.0, 2.0, 0.0, -2.0]]), 8, 4)
    (array([4., 4.]), array([4., 0.]), array([ 2., -2.]))

    Fine print. In the camera plane a vertex has no place on screen. A |w| less than CAMERA_PLANE
    times the greater of |x| and |y| is raised to that, also in the w returned. Its sign stays, and
    w = 0 counts as positive. The eye itself, x = y = w = 0, comes out as nan.
    """
    rows = np.array(clip.T, float, order="C")  # contiguous rows: faster
    x, y, _, w = rows
    least = CAMERA_PLANE * np.maximum(np.abs(x), np.abs(y))
    w[:] = np.where(np.abs(w) < least, np.where(w < 0, -least, least), w)
    x, y, _ = np.ascontiguousarray(transforms.to_screen(rows.T, width, height).T)
    return x, y, w


def cull_back_faces(x, y, w, faces):  # extra 2.7 (2 points)
    """The faces (F', 3) that turn their front to the camera, in their order.

    x, y, w (V,) of `screen_points`, faces (F, 3). A face in front of the camera shows its front if
    it is counter-clockwise on screen. Each vertex behind the camera (w < 0) turns that over.

    >>> x, y, w = np.array([0.0, 2.0, 0.0]), np.array([0.0, 0.0, 2.0]), np.ones(3)
    >>> cull_back_faces(x, y, w, np.array([[0, 1, 2], [0, 2, 1]]))
    array([[0, 1, 2]])

    Fine print. A face without area goes, too.
    """
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[area * np.sign(w[faces]).prod(-1) > 0]


@has_faster("scanline")
def rasterize(clip, faces, width, height):  # exercise 2.6 (5 points)
    """What each pixel sees: for each face, and all pixels of its box, keep the least depth.

    clip (V, 4), faces (F, 3) -> face_index, depth (height, width): -1 and np.inf where no face is
    seen. The given `screen_points` says where the vertices are, and z / w how deep. See
    `demo bunny ties cut`.

    >>> clip = np.array([[-1.0, -1.0, 0.5, 1.0], [1.0, -1.0, 0.5, 1.0], [-1.0, 1.0, 0.5, 1.0]])
    >>> rasterize(clip, np.array([[0, 1, 2]]), 3, 2)
    (array([[ 0,  0, -1],
           [ 0, -1, -1]]), array([[0.5, 0.5, inf],
           [0.5, inf, inf]]))

    Fine print. All w are positive. The first of two equally deep faces is seen.
    """
    raise NotImplementedError("exercise 2.6: rasterize")


def cover_in_clip_space(p, corners):  # extra 2.8 (4 points)
    """Eq. (5) without a division: which samples does a face cover, also one behind the camera?

    p (..., 2): samples in ndc. corners (3, 4): a face in clip space, any w -> covered (...), border
    included, depth (...). The sample looks along the points w (x, y, 1). Seen from there, corner k
    is at q_k = (x_k - x w_k, y_k - y w_k), and c_k = det [q_i q_j]. The point on the face has the
    weights c_k / sum c_k w_k, none negative if it is covered, and w = 1: its z is the depth.

    >>> corners = np.array([[-1.0, 0.0, 0.5, 1.0], [1.0, 0.0, 0.5, 1.0], [0.0, -1.0, 0.0, -1.0]])
    >>> cover_in_clip_space(np.array([[0.0, 0.5], [0.0, -0.5]]), corners)
    (array([False,  True]), array([0.25, 0.75]))
    """
    q = corners[:, :2] - p[..., None, :] * corners[:, 3:]
    x, y = q[..., 0], q[..., 1]
    c = np.stack([x[..., i] * y[..., j] - x[..., j] * y[..., i] for i, j in EDGES], -1)
    weights = c / (c @ corners[:, 3])[..., None]
    depth = weights @ corners[:, 2]
    return (weights >= 0).all(-1) & (np.abs(depth) <= 1), depth


def edge_function_backward(grad_e, p, a, b):  # extra 2.9 (2 points)
    """Backward of eq. (1): grad_e (...) -> grad_p, grad_a, grad_b, each (..., 2).

    p, a, b (..., 2), all of one shape.

    >>> p, a, b = np.array([1.0, 4.0]), np.array([0.0, 0.0]), np.array([2.0, 1.0])
    >>> edge_function_backward(np.array(1.0), p, a, b)
    (array([-1.,  2.]), array([-3., -1.]), array([ 4., -1.]))
    """
    # e = |a b| + |b p| + |p a| with |u v| = u_x v_y - u_y v_x, so d|u v|/du = (v_y, -v_x) and
    # d|u v|/dv = (-u_y, u_x): a point's gradient is the side opposite to it, turned by 90 degrees.
    def turned(side):
        return grad_e[..., None] * np.stack([side[..., 1], -side[..., 0]], -1)

    return turned(a - b), turned(b - p), turned(p - a)
