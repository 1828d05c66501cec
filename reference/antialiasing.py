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
`last_crossing`, `is_blended` and the clip of `blend_weight` are refinements by nvdiffrast. With
these steps outlines.py finds the pairs of a picture, which `blend_pairs` blends.

Sources: lecture "Differentiable graphics 1", Laine et al. 2020 (nvdiffrast), section 3.6.
"""
import numpy as np

from course.given import mesh
from course.given.arrays import EDGES, scatter, scatter_first

from . import transforms
from .rasterization import edge_function, screen_points

WINDOW = 1 / 16  # pixels: what an edge may be off where nvdiffrast's rasterizer rounds vertices


def opposite_vertices(faces):  # exercise 8.1 (3 points)
    """Which vertex lies across each edge of each face? -1 for none.

    faces (F, 3) -> opposite (F, 3). Edge k joins a face's vertices other than vertex k. The answer
    is the third vertex of the other face at this edge, wound either way.

    >>> opposite_vertices(np.array([[0, 1, 2], [2, 1, 3]]))
    array([[ 3, -1, -1],
           [-1, -1,  0]])

    Fine print. Do not compare all pairs of faces: meshes are large. A face that names a vertex
    twice gets -1. Where three faces meet, list their third vertices, each once, in the order of the
    faces. The first two answer each other. Other faces get -1.
    """
    sound = (faces != faces[:, [1, 2, 0]]).all(1)
    third = faces[sound]
    edges, edge = mesh.edges(third)
    p = scatter_first(third, edge, len(edges))[edge]  # across each edge, the first vertex
    rest = third != p
    q = scatter_first(third[rest], edge[rest], len(edges))[edge]  # and the first other one
    opposite = np.full(faces.shape, -1)
    opposite[sound] = np.where(third == p, q, np.where(third == q, p, -1))
    return opposite


def silhouette_edges(x, y, w, faces, opposite):  # exercise 8.2 (3 points)
    """Eq. (1): at which edges does the surface end, or fold on screen?

    x, y, w (V,) of `screen_points`, all w > 0, faces, opposite (F, 3) -> bool (F, 3). It folds if
    vertex k and the one across lie on one side of edge k.

    >>> x, y = np.array([0.0, 1.0, 0.0, 2.0]), np.array([0.0, 0.0, 1.0, 2.0])
    >>> faces, opposite = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[3, -1, -1], [-1, -1, 0]])
    >>> silhouette_edges(x, y, np.ones(4), faces, opposite)
    array([[False,  True,  True],
           [ True,  True, False]])

    Fine print. It folds if the face, and the face with vertex k replaced by the one across, wind
    alike. Each corner behind the camera (w < 0) is mirrored, and turns a winding over (lecture 08,
    section 4). A triangle without area counts as counter-clockwise, whatever its w.
    """
    side = np.sign(w)

    def place(vertex):
        return np.stack([x.take(vertex), y.take(vertex)]).T, side.take(vertex)

    def is_clockwise(*triangle):
        points, sides = zip(*triangle, strict=True)
        return edge_function(*points) * (sides[0] * sides[1] * sides[2]) < 0

    corners = [place(vertex) for vertex in faces.T.copy()]
    own = is_clockwise(*corners)
    silhouette = opposite < 0
    for k, (i, j) in enumerate(EDGES):
        silhouette[:, k] |= is_clockwise(place(opposite[:, k]), corners[i], corners[j]) == own
    return silhouette


def neighbour_pairs(face_index, outlined):  # extra 8.3 (2 points)
    """Which neighbouring pixels see different faces, so that the picture may jump between them?

    face_index (H, W), -1 for no face, outlined (H, W) bool -> first, second (N,), pixels numbered
    row * W + column. At least one of the two is outlined. Pairs of left and right come before pairs
    of lower and upper, both sorted by first.

    >>> neighbour_pairs(np.array([[0, 0, 1], [0, 2, 1]]), np.array([[1, 1, 0], [0, 0, 0]]) > 0)
    (array([1, 1]), array([2, 4]))
    """
    width = face_index.shape[1]
    face, outlined = face_index.ravel(), outlined.ravel()

    def before_jump(step):
        differs = face[:-step] != face[step:]
        return np.flatnonzero(differs & (outlined[:-step] | outlined[step:]))

    left = before_jump(1)
    left = left[left % width < width - 1]  # the end of a row has no neighbour in the next one
    lower = before_jump(width)
    return np.concatenate([left, lower]), np.concatenate([left + 1, lower + width])


def owner_and_other(first, second, depth):
    """Which pixel of each pair sees the nearer face, and so owns the edge?

    first, second (N,), pixels numbered row * W + column, depth (H, W), np.inf for no face
    -> owner, other (N,). If both are equally deep, the second is the owner.

    >>> depth = np.array([[0.5, np.inf], [0.25, 0.5]])
    >>> owner_and_other(np.array([0, 2, 0]), np.array([1, 3, 2]), depth)
    (array([0, 2, 2]), array([1, 3, 0]))
    """
    depth = depth.ravel()
    is_first = depth[first] < depth[second]
    return np.where(is_first, first, second), np.where(is_first, second, first)


def pair_step(owner, other, width):
    """From the owner's to the other's centre: dx, dy (N,), one of them 0, the other one 1 or -1."""
    row, column = np.divmod(owner, width)
    other_row, other_column = np.divmod(other, width)
    return other_column - column, other_row - row


def pair_frame(screen_x, screen_y, owner, other, width):  # extra 8.5 (2 points)
    """Eq. (2): points in their pair's frame, the owner's centre at x = 0, the other's at x = 1.

    screen_x, screen_y (K, N) are K points for each of N pairs. owner, other (N,) are pixels,
    numbered row * width + column -> x, y (K, N). `pair_step` is given.

    >>> x, y = np.full((2, 1, 2), [[[3.0]], [[4.0]]])
    >>> pair_frame(x, y, np.array([10, 10]), np.array([9, 2]), 8)  # (2.5, 1.5): left, below
    (array([[-0.5, -2.5]]), array([[2.5, 0.5]]))
    """
    dx, dy = pair_step(owner, other, width)
    row, column = np.divmod(owner, width)
    x, y = screen_x - (column + 0.5), screen_y - (row + 0.5)
    return dx * x + dy * y, np.abs(dy) * x + np.abs(dx) * y


def pair_frame_backward(grad_x, grad_y, owner, other, width):  # extra 8.6 (1 point)
    """Backward of eq. (2): grad_x, grad_y (K, N) -> grad_screen_x, grad_screen_y (K, N).

    >>> pair_frame_backward(np.array([[5.0]]), np.array([[7.0]]), np.array([10]), np.array([2]), 8)
    (array([[7.]]), array([[-5.]]))
    """
    # Eq. (2) is a matrix with the rows (dx, dy) and (|dy|, |dx|). The way back is its transpose.
    dx, dy = pair_step(owner, other, width)
    return dx * grad_x + np.abs(dy) * grad_y, dy * grad_x + np.abs(dx) * grad_y


def crossing(x0, y0, x1, y1):  # exercise 8.7 (1 point)
    """Eq. (3): where the line through (x0, y0) and (x1, y1) meets y = 0: c (...).

    x0, y0, x1, y1 (...), y0 and y1 different.

    >>> crossing(np.array([1.0]), np.array([-1.0]), np.array([4.0]), np.array([2.0]))
    array([2.])

    Fine print. An edge that reaches behind the camera may have an end near infinity, and a
    difference of huge numbers has few digits. Measure from the end that is nearer to y = 0.
    """
    nearer = np.abs(y1) < np.abs(y0)
    x, y = np.where(nearer, x1, x0), np.where(nearer, y1, y0)
    return x - y * (x1 - x0) / (y1 - y0)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):  # exercise 8.8 (2 points)
    """Backward of eq. (3): grad_c (...) -> grad_x0, grad_y0, grad_x1, grad_y1, each (...).

    >>> grad_c, x0, y0, x1, y1 = np.array([[1.0], [1.0], [-1.0], [4.0], [3.0]])
    >>> np.stack(crossing_backward(grad_c, x0, y0, x1, y1)).T
    array([[ 0.75  , -0.5625,  0.25  , -0.1875]])

    Fine print. epsilon keeps r finite where y1 is near y0. Let r = 1 / (h + epsilon), h = y1 - y0,
    with epsilon of h's sign. Use r in c = (x0 y1 - x1 y0) r, dc/dx0 = r y1, dc/dy0 = r (c - x1).
    For the other end swap the ends: r becomes -r.
    """
    # c is the mean of x0 and x1 with the weights y1 and -y0, whose sum is 1 / r. So
    # dc = r (y1 dx0 - y0 dx1) + r ((x0 - c) dy1 - (x1 - c) dy0).
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return slope * y1, slope * (c - x1), -slope * y0, slope * (x0 - c)


def last_crossing(x, y, w):  # extra 8.9 (3 points)
    """By which edge does the line y = 0 leave a face, on the way from owner to other?

    x, y, w (3, N), a face's corners in the pair's frame -> edge (N,), c (N,) of eq. (3). Edge k
    crosses if one end has y < 0 and the other y >= 0. The greatest c counts.

    >>> x, y = np.array([[-1.0], [3.0], [1.0]]), np.array([[-1.0], [-1.0], [1.0]])
    >>> last_crossing(x, y, np.ones((3, 1)))
    (array([0]), array([2.]))

    Fine print. The first of equal crossings counts. Without any, the answer is edge 0 with
    c = -np.inf. Nothing is divided by 0. A corner behind the camera (w < 0) comes out mirrored, so
    compare s y with 0, where s is the sign of w. The crossing lies in front of the camera if
    s_i |y_j| + s_j |y_i| > 0, for ends i and j.
    """
    front = np.sign(w)  # and not w: a product of three of its size may over- or underflow
    above = front * y
    c = np.full(x.shape, -np.inf)
    for k, (i, j) in enumerate(EDGES):
        crosses = (above[i] < 0) != (above[j] < 0)
        crosses &= front[i] * np.abs(y[j]) + front[j] * np.abs(y[i]) > 0
        c[k, crosses] = crossing(*(corner[crosses] for corner in (x[i], y[i], x[j], y[j])))
    edge = c.argmax(0)
    return edge, c[edge, np.arange(len(edge))]


def is_blended(c, is_silhouette, x0, y0, x1, y1):  # extra 8.10 (2 points)
    """Is the pair blended by this edge, a steep silhouette that crosses between the centres?

    c (N,) of eq. (3), is_silhouette (N,) bool, the edge's ends in the pair's frame, (N,) each
    -> bool (N,). Steep edges are at least as long in y as in x. c lies between 0 and 1, or less
    than WINDOW outside.

    >>> one = np.ones(4)
    >>> is_blended(np.array([0.5, -0.05, -0.07, 0.5]), one > 0, 0 * one, -one, np.arange(4.0), one)
    array([ True,  True, False, False])
    """
    is_steep = np.abs(y1 - y0) >= np.abs(x1 - x0)
    return is_silhouette & is_steep & (c > -WINDOW) & (c < 1 + WINDOW)


def blend_weight(c):  # exercise 8.11 (1 point)
    """Eq. (4): how far does the blend go, alpha (N,), for edges that cross at c (N,)?

    >>> blend_weight(np.array([0.0, 0.25, 1.0]))
    array([ 0.5 ,  0.25, -0.5 ])

    Fine print. A c outside of [0, 1] counts as 0 or 1: no pixel gives away more than half of its
    colour.
    """
    return 0.5 - np.clip(c, 0, 1)


def blend_weight_backward(grad_alpha, c):
    """Backward of eq. (4): grad_alpha, c (N,) -> grad_c (N,), 0 where c <= 0 or c >= 1.

    >>> blend_weight_backward(np.array([2.0, 2.0, 2.0]), np.array([-0.01, 0.25, 1.0]))
    array([ 0., -2.,  0.])
    """
    # dalpha/dc = -1. A saturated alpha no longer depends on c.
    return np.where((0 < c) & (c < 1), -grad_alpha, 0.0)


def blend(colour, owner, other, alpha):  # exercise 8.13 (2 points)
    """Eq. (5) for all pairs: colour (H, W, C), owner, other, alpha (N,) -> output (H, W, C).

    Pixels are numbered row * W + column, and a pixel may be in several pairs.

    >>> blend(np.array([[[0.0], [1.0], [5.0]]]), np.array([0, 2]), np.array([1, 1]),
    ...       np.array([0.25, -0.5]))
    array([[[0.25],
            [3.  ],
            [5.  ]]])

    Fine print. The output is of floats, as a blend of integers is no integer.
    """
    pixels = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    output = pixels.copy()
    changed = np.where(alpha > 0, owner, other)
    # Few of many pixels change: `scatter`, which makes a whole picture, takes longer.
    np.add.at(output, changed, alpha[:, None] * (pixels[other] - pixels[owner]))
    return output.reshape(colour.shape)


def blend_backward(grad_output, colour, owner, other, alpha):  # exercise 8.14 (3 points)
    """Backward of eq. (5): grad_output (H, W, C) -> grad_colour (H, W, C), grad_alpha (N,).

    >>> colour, grad_output = np.array([[[0.0], [1.0]]]), np.array([[[10.0], [100.0]]])
    >>> blend_backward(grad_output, colour, np.array([0]), np.array([1]), np.array([0.25]))
    (array([[[  7.5],
            [102.5]]]), array([10.]))

    Fine print. Eq. (5) has a kink at alpha = 0: the owner changes on one side of it, the other
    pixel on the other side. Take the owner's side there, as nvdiffrast does.
    """
    # For either sign of alpha, changed += alpha (other - owner). So grad_alpha is grad_changed
    # times (other - owner). alpha grad_changed goes to the other, and is taken from the owner.
    channels = colour.shape[-1]
    pixels = np.asarray(colour, float).reshape(-1, channels)
    grad_pixels = np.asarray(grad_output, float).reshape(-1, channels)
    grad_changed = grad_pixels[np.where(alpha >= 0, owner, other)]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    np.add.at(grad_colour, owner, -alpha[:, None] * grad_changed)
    np.add.at(grad_colour, other, alpha[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_pairs(colour, pairs):
    """Eqs. (4) and (5) for the Pairs of outlines.py: colour (H, W, C) -> output (H, W, C)."""
    return blend(colour, pairs.owner, pairs.other, blend_weight(pairs.c))


def screen_points_backward(grad_x, grad_y, clip, width, height):
    """Backward of `screen_points` for x and y: grad_x, grad_y (V,) -> grad_clip (V, 4)."""
    *_, w = screen_points(clip, width, height)  # the one that the forward divides by
    grad_screen = np.stack([grad_x, grad_y, 0 * grad_x], -1)
    return transforms.to_screen_backward(grad_screen, np.column_stack([clip[:, :3], w]), width,
                                         height)


def blend_pairs_backward(grad_output, colour, pairs, clip, epsilon=0.0):
    """Backward of `blend_pairs`: grad_output (H, W, C) -> grad_colour (H, W, C), grad_clip (V, 4).

    pairs of `blended_pairs`, clip (V, 4). epsilon: of `crossing_backward`, in pixels.

    Fine print. Near the camera plane digits are lost: where w is a millionth of x or y, six digits
    of the gradient with respect to w are right.
    """
    # (5), (4), (3) and (2), as far as the edges' ends. Then each vertex sums the gradients of all
    # edges that end there, and only such vertices go back to clip space.
    height, width, _ = colour.shape
    owner, other, c, ends, x, y, *_ = pairs
    grad_colour, grad_alpha = blend_backward(grad_output, colour, owner, other, blend_weight(c))
    grad_c = blend_weight_backward(grad_alpha, c)
    grad_x0, grad_y0, grad_x1, grad_y1 = crossing_backward(grad_c, x[0], y[0], x[1], y[1], epsilon)
    grad_x, grad_y = np.stack([grad_x0, grad_x1]), np.stack([grad_y0, grad_y1])
    grad_ends = np.stack(pair_frame_backward(grad_x, grad_y, owner, other, width), -1)
    vertex, end = np.unique(ends, return_inverse=True)
    grad_x, grad_y = scatter(grad_ends, end.reshape(ends.shape), len(vertex)).T
    grad_clip = np.zeros(clip.shape)
    grad_clip[vertex] = screen_points_backward(grad_x, grad_y, clip[vertex], width, height)
    return grad_colour, grad_clip
