"""Antialiasing: colours that follow an edge from pixel to pixel, and the gradient that moves it.

A pixel shows the face at its centre. Its colour jumps when an edge passes the centre, and has no
gradient before and after. So two neighbouring pixels that see different faces are blended, and the
blend depends on where an edge crosses between their centres. The pixel that sees the nearer face
owns the edge.

    silhouette  <=>  no face across the edge, or it folds back to the face's own side        (1)
    x = s (screen_x - X),   y = screen_y - Y    the pair's frame                             (2)
    c = x0 - y0 (x1 - x0) / (y1 - y0)           where the edge from 0 to 1 meets y = 0       (3)
    alpha = 1/2 - c                                                                          (4)
    alpha > 0:  owner += alpha (other - owner),  else  other += alpha (other - owner)        (5)

The frame has the owner's centre (X, Y) at x = 0, and the other's at x = 1: s = -1 if the other
pixel comes before the owner, else +1. For two pixels above each other, screen_x and screen_y, X
and Y change places. (5) reads the colours from before any blend, and all changes of a pixel add up.
`last_crossing` and a c that counts as 0 or 1 are refinements by nvdiffrast. outlines.py and
outline_walk.py find the pairs of a picture, which `blend_pairs` blends.

Sources: lecture "Differentiable graphics 1", Laine et al. 2020 (nvdiffrast), section 3.6.
"""
from typing import NamedTuple

import numpy as np

from course.given import mesh
from course.given.arrays import EDGES, scatter, scatter_first

from . import transforms
from .rasterization import screen_points


class Pairs(NamedTuple):
    """N pairs of neighbouring pixels, each with an edge of a face between them."""

    owner: np.ndarray  # (N,) number of the pixel, row * W + column
    other: np.ndarray  # (N,)
    c: np.ndarray      # (N,) where the edge crosses, eq. (3)
    ends: np.ndarray   # (2, N) the vertices at the edge's ends, as EDGES[edge] has them
    x: np.ndarray      # (2, N) where these are in the pair's frame
    y: np.ndarray      # (2, N)
    face: np.ndarray   # (N,) the edge's face: in outlines.py it is the owner's
    edge: np.ndarray   # (N,) which of this face's edges, from 0 to 2, or 3 + f: it meets face f


def opposite_corners(faces):  # exercise 8.1 (3 points)
    """Which corner lies across each edge of each face? 3 * face + corner, or -1 for none.

    faces (F, 3) -> opposite (F, 3). Edge k joins a face's vertices other than vertex k. Across is
    the third corner of the other face at this edge, wound either way. See `demo borders`.

    >>> opposite_corners(np.array([[0, 1, 2], [2, 1, 3]]))
    array([[ 5, -1, -1],
           [-1, -1,  0]])

    Fine print. Do not compare all pairs of faces: meshes are large. A face that names a vertex
    twice gets -1. Where three faces meet, list their third vertices, each once, as the corner of
    its first face. The first two answer each other, in all faces that have them. Others get -1.
    """
    raise NotImplementedError("exercise 8.1: opposite_corners")


def silhouette_edges(x, y, w, faces, across):  # exercise 8.2 (3 points)
    """Eq. (1): at which edges does the surface end, or fold on screen? -> bool (F, 3)

    x, y, w (V,) of `screen_points`, all w > 0, faces (F, 3), across (F, 3): the vertices across
    their edges, -1 for none. It folds if vertex k and the one across lie on one side of edge k.

    >>> x, y = np.array([0.0, 1.0, 0.0, 2.0]), np.array([0.0, 0.0, 1.0, 2.0])
    >>> faces, across = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[3, -1, -1], [-1, -1, 0]])
    >>> silhouette_edges(x, y, np.ones(4), faces, across)
    array([[False,  True,  True],
           [ True,  True, False]])

    Fine print. It folds if the face, and the face with vertex k replaced by the one across, wind
    alike. Each corner behind the camera (w < 0) is mirrored, and turns a winding over (lecture 08,
    section 4). A triangle without area counts as counter-clockwise, whatever its w.
    """
    raise NotImplementedError("exercise 8.2: silhouette_edges")


def pair_step(owner, other, width):
    """From the owner's to the other's centre: dx, dy (N,), one of them 0, the other one 1 or -1."""
    row, column = np.divmod(owner, width)
    other_row, other_column = np.divmod(other, width)
    return other_column - column, other_row - row


def pair_frame(screen_x, screen_y, owner, other, width):  # step 8.3
    """Eq. (2): points in their pair's frame, the owner's centre at x = 0, the other's at x = 1.

    screen_x, screen_y (K, N) are K points for each of N pairs. owner, other (N,) are pixels,
    numbered row * width + column -> x, y (K, N). `pair_step` is given.

    >>> x, y = np.full((2, 1, 2), [[[3.0]], [[4.0]]])
    >>> pair_frame(x, y, np.array([10, 10]), np.array([9, 2]), 8)  # (2.5, 1.5): left, below
    (array([[-0.5, -2.5]]), array([[2.5, 0.5]]))
    """
    raise NotImplementedError("exercise 8.3: pair_frame")


def crossing(x0, y0, x1, y1):  # step 8.4
    """Eq. (3): where the line through (x0, y0) and (x1, y1) meets y = 0: c (...).

    x0, y0, x1, y1 (...), y0 and y1 different.

    >>> crossing(np.array([1.0]), np.array([-1.0]), np.array([4.0]), np.array([2.0]))
    array([2.])

    Fine print. An edge that reaches behind the camera may have an end near infinity, and a
    difference of huge numbers has few digits. Measure from the end that is nearer to y = 0.
    """
    raise NotImplementedError("exercise 8.4: crossing")


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):  # step 8.10
    """Backward of eq. (3): grad_c (...) -> grad_x0, grad_y0, grad_x1, grad_y1, each (...).

    >>> grad_c, x0, y0, x1, y1 = np.array([[1.0], [1.0], [-1.0], [4.0], [3.0]])
    >>> np.stack(crossing_backward(grad_c, x0, y0, x1, y1)).T
    array([[ 0.75  , -0.5625,  0.25  , -0.1875]])

    Fine print. epsilon keeps r finite where y1 is near y0. Let r = 1 / (h + epsilon), h = y1 - y0,
    with epsilon of h's sign. Use r in c = (x0 y1 - x1 y0) r, dc/dx0 = r y1, dc/dy0 = r (c - x1).
    For the other end swap the ends: r becomes -r.
    """
    raise NotImplementedError("exercise 8.10: crossing_backward")


def place_ends(pairs, clip, shape):
    """The Pairs with c, x and y anew, for the places clip (V, 4). Their edges stay the same."""
    height, width = shape
    x, y, _ = screen_points(clip, width, height)
    x, y = pair_frame(x[pairs.ends], y[pairs.ends], pairs.owner, pairs.other, width)
    return Pairs(*pairs)._replace(c=crossing(x[0], y[0], x[1], y[1]), x=x, y=y)


def last_crossing(x, y, w):  # step 8.5
    """By which edge does the line y = 0 leave a face, on the way from owner to other?

    x, y, w (3, N), a face's corners in the pair's frame -> edge (N,), c (N,) of eq. (3). Edge k
    crosses if one end has y < 0 and the other y >= 0. The greatest c counts.

    >>> x, y = np.array([[-1.0], [3.0], [1.0]]), np.array([[-1.0], [-1.0], [1.0]])
    >>> last_crossing(x, y, np.ones((3, 1)))
    (array([0]), array([2.]))

    Fine print. The first of equal crossings counts. Without any, it is edge 0 with c = -np.inf.
    Nothing is divided by 0. A corner behind the camera (w < 0) is mirrored: compare s y with 0,
    s the sign of w. A crossing is in front of the camera if s_i |y_j| + s_j |y_i| > 0.
    """
    raise NotImplementedError("exercise 8.5: last_crossing")


def blend_pairs(colour, pairs):  # exercise 8.9 (2 points)
    """Blend all pairs, by eqs. (4) and (5): colour (H, W, C) -> output (H, W, C).

    Of the `Pairs` you need owner, other, c (N,). Pixels are numbered row * W + column, and one may
    be in several pairs. See `demo borders`.

    >>> pairs = Pairs(np.array([0, 2]), np.array([1, 1]), np.array([0.25, 1.0]), *5 * [None])
    >>> blend_pairs(np.array([[[0.0], [1.0], [5.0]]]), pairs)
    array([[[0.25],
            [3.  ],
            [5.  ]]])

    Fine print. The output is of floats, as a blend of integers is no integer. A c outside of [0, 1]
    counts as 0 or 1: no pixel gives away more than half of its colour.
    """
    raise NotImplementedError("exercise 8.9: blend_pairs")


def ends_backward(grad_x, grad_y, ends, clip, width, height):
    """From edges' ends on screen to clip space: grad_x, grad_y, ends (2, N) -> grad_clip (V, 4)."""
    return screen_backward(np.stack([grad_x, grad_y, np.zeros(ends.shape)], -1), ends, clip, width,
                           height)


def screen_backward(grad_screen, vertices, clip, width, height):
    """From vertices' x, y and depth on screen to clip space: grad_screen (K, N, 3), vertices (K, N)
    -> grad_clip (V, 4). A vertex sums all that is said of it.

    Only such vertices go back to clip space, by lab 1's viewport and divide, with the w of
    `screen_points`.
    """
    vertex, place = np.unique(vertices, return_inverse=True)
    grad_screen = scatter(grad_screen, place.reshape(vertices.shape), len(vertex))
    *_, w = screen_points(clip[vertex], width, height)  # the one that the forward divides by
    at = np.column_stack([clip[vertex, :3], w])
    grad_clip = np.zeros(clip.shape)
    grad_clip[vertex] = transforms.to_screen_backward(grad_screen, at, width, height)
    return grad_clip


def blend_pairs_backward(grad_output, colour, pairs, clip,  # exercise 8.11 (4 points)
                         epsilon=0.0):
    """Backward of `blend_pairs`: grad_output (H, W, C) -> grad_colour (H, W, C), grad_clip (V, 4).

    pairs: of `steep_pairs`. clip (V, 4). Go back through (5) and (4) to c, which has a gradient
    where 0 < c < 1, through (3) to its edge's ends, pairs.x and pairs.y (2, N), and through (2) to
    the screen. The given `ends_backward` takes grad_x and grad_y (2, N) there to the vertices.

    >>> ends = np.array([[0], [1]]), np.array([[0.0], [0.5]]), np.array([[-1.0], [1.0]])
    >>> pairs = Pairs(np.array([0]), np.array([1]), np.array([0.25]), *ends, None, None)
    >>> clip = np.array([[-0.5, -1.0, 0.0, 1.0], [0.0, 3.0, 0.0, 1.0]])
    >>> colour, grad_output = np.array([[[0.0], [1.0]]]), np.array([[[10.0], [100.0]]])
    >>> grad_colour, grad_clip = blend_pairs_backward(grad_output, colour, pairs, clip)
    >>> grad_colour.ravel(), grad_clip[:, :2]
    (array([  7.5, 102.5]), array([[-5.   ,  0.625],
           [-5.   ,  0.625]]))

    Fine print. Eq. (5) has a kink at alpha = 0: the owner changes on one side of it, the other
    pixel on the other side. Take the owner's side there, as nvdiffrast does. A c outside of [0, 1]
    counts as 0 or 1. epsilon is that of `crossing_backward`.
    """
    raise NotImplementedError("exercise 8.11: blend_pairs_backward")
