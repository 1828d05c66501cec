"""Antialiasing: colours that follow an edge as it moves between two pixels, and their gradient.

A pixel shows the face at its centre, so its colour jumps when an edge passes the centre, and has
no gradient before and after. Here two neighbouring pixels that see different faces are blended by
where the edge runs between their centres. The nearer face owns the edge; its pixel is the owner.

    x = s (screen_x - X),  y = screen_y - Y     the pair's frame; swap screen_x, screen_y and
                                                X, Y for two pixels above each other         (1)
    silhouette  <=>  no face across the edge, or it folds back to the face's own side        (2)
    c = x0 - y0 (x1 - x0) / (y1 - y0)           where the edge from 0 to 1 meets y = 0       (3)
    alpha = 1/2 - c                                                                          (4)
    alpha > 0:  owner += alpha (other - owner),  else  other += -alpha (owner - other)       (5)

(X, Y) is the owner's centre, and s = -1 if the other pixel comes before it, else +1: the owner's
centre is at x = 0, the other's at x = 1. (5) reads the colours of before; pixels of several pairs
sum up all their changes.

This is the lecture. Four refinements are those of nvdiffrast: of a face's edges the last one that
crosses y = 0 is taken, silhouette or not; it must be steep; its c may miss [0, 1] by WINDOW; and
then alpha is saturated at 1/2 or -1/2, without a gradient.

Sources: lecture "Differentiable graphics 1"; Laine et al. 2020 (nvdiffrast), section 3.6.
"""
import numpy as np

from . import rasterization, transforms

EDGES = (1, 2), (2, 0), (0, 1)  # edge k runs from the first to the second, opposite to vertex k
WINDOW = 1 / 16  # pixels: what an edge may be off where nvdiffrast's rasterizer rounds vertices
ROUNDING = 1e-9  # of a colour: more than this beyond the range is not rounding
REASONS = ("not seen: hidden or outside", "no pair", "behind the camera", "no silhouette edge",
           "last edge is another one", "edge not steep", "crossing outside the pair",
           "alpha saturated, or 0", "has a gradient")  # of `why_zero`, the farther the higher


def opposite_vertices(faces):  # exercise 8.1 (3 points)
    """Which vertex lies across each edge of each face? -1 for none, at a boundary.

    faces (F, 3) integers >= 0 -> opposite (F, 3) integers. opposite[f, k]: edge k of face f joins
    its two vertices other than faces[f, k]; another face with the same two vertices, in either
    order, has this third one. Faces that name a vertex twice do not count, and have -1 throughout.

    In general, list the third vertices of an edge's faces, in the order of the faces, each once. Of
    two or more, the first two, p and q, are across from each other: a face whose third vertex is p
    has q there, one with q has p, any other -1. So copies of a face count once.

    >>> opposite_vertices(np.array([[0, 1, 2], [2, 1, 3]]))
    array([[ 3, -1, -1],
           [-1, -1,  0]])
    """
    faces = faces.astype(np.int64)  # room for the keys below
    ends = faces[:, [1, 2, 0]], faces[:, [2, 0, 1]]
    low, high = np.minimum(*ends), np.maximum(*ends)
    sound = (low != high).all(1)
    own = faces[sound].ravel()
    _, edge = np.unique((low * (faces.max(initial=0) + 1) + high)[sound], return_inverse=True)
    edge = edge.ravel()
    # Written from the last face to the first: what is written last, stays.
    first, second = np.full((2, len(own)), -1)
    first[edge[::-1]] = own[::-1]
    others = np.flatnonzero(own != first[edge])[::-1]
    second[edge[others]] = own[others]
    first, second = first[edge], second[edge]
    opposite = np.full(faces.shape, -1)
    opposite[sound] = np.select([own == first, own == second], [second, first], -1).reshape(-1, 3)
    return opposite


def silhouette_edges(x, y, w, faces, opposite):  # exercise 8.2 (3 points)
    """Eq. (2): which edges of faces are silhouettes, where the surface ends or folds on screen?

    x, y (V,): vertices on screen, w (V,) not 0, negative for a vertex behind the camera, whose x
    and y are mirrored; faces, opposite (F, 3), of any number of faces -> bool (F, 3).

    Compare the face with the triangle in which `opposite` takes the place of vertex k. If both have
    the same winding, they lie on one side of edge k: a fold. Each corner behind the camera turns
    the winding over; without an area, a triangle counts as counter-clockwise in any case. -1
    across: a silhouette.

    >>> x, y = np.array([0.0, 1.0, 0.0, 2.0]), np.array([0.0, 0.0, 1.0, 2.0])
    >>> faces, opposite = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[3, -1, -1], [-1, -1, 0]])
    >>> silhouette_edges(x, y, np.ones(4), faces, opposite)
    array([[False,  True,  True],
           [ True,  True, False]])
    """
    def area(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])

    corners, across = (np.stack([x[index.T], y[index.T]], 1) for index in (faces, opposite))
    side = np.where(w < 0, -1, 1)
    own, silhouette = area(*corners) * side[faces].prod(1), np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        turned = side[opposite[:, k]] * side[faces[:, i]] * side[faces[:, j]]
        wing = area(across[k], corners[i], corners[j]) * turned
        silhouette[:, k] = ((wing < 0) == (own < 0)) | (opposite[:, k] < 0)
    return silhouette


def neighbour_pairs(face_index, outlined):  # exercise 8.3 (2 points)
    """The pairs of neighbouring pixels between which the picture may jump.

    face_index (H, W), -1 for no face; outlined (H, W) bool: pixels that may own a silhouette.
    -> first, second (N,): numbers of pixels, row * W + column. In a pair, second is the right or
    the upper neighbour of first, their face_index differ, and at least one of them is outlined.
    All pairs side by side come first, then those above each other; both by ascending first.

    >>> neighbour_pairs(np.array([[0, 0, 1], [0, 2, 1]]), np.array([[1, 1, 0], [0, 0, 0]]) > 0)
    (array([1, 1]), array([2, 4]))
    """
    width, face, outlined = face_index.shape[1], face_index.ravel(), outlined.ravel()
    pairs = []
    for step in 1, width:
        jumps = (face[:-step] != face[step:]) & (outlined[:-step] | outlined[step:])
        first = np.flatnonzero(jumps)
        if not pairs:  # side by side: the end of a row has no neighbour in the next one
            first = first[first % width < width - 1]
        pairs.append((first, first + step))
    return tuple(np.concatenate(pixels) for pixels in zip(*pairs, strict=True))


def owner_and_other(first, second, depth):  # exercise 8.4 (1 point)
    """Which pixel of each pair sees the nearer face, and so owns the edge?

    first, second (N,): numbers of pixels, row * W + column; depth (H, W), np.inf for no face
    -> owner, other (N,). Of equally deep ones the second is the owner.

    >>> depth = np.array([[0.5, np.inf], [0.25, 0.5]])
    >>> owner_and_other(np.array([0, 2, 0]), np.array([1, 3, 2]), depth)
    (array([0, 2, 2]), array([1, 3, 0]))
    """
    depth = depth.ravel()
    is_first = depth[first] < depth[second]
    return np.where(is_first, first, second), np.where(is_first, second, first)


def pair_step(owner, other, width):
    """From the owner's to the other's centre: dx, dy (N,), one of them 0, the other 1 or -1."""
    (row, column), (other_row, other_column) = np.divmod(owner, width), np.divmod(other, width)
    return other_column - column, other_row - row


def pair_frame(screen_x, screen_y, owner, other, width):  # exercise 8.5 (2 points)
    """Eq. (1): points as seen from their pair: the owner's centre at 0, the other's at x = 1.

    screen_x, screen_y (K, N): K points for each pair; owner, other (N,): numbers of pixels,
    row * width + column -> x, y (K, N). Only x is ever mirrored.

    >>> at = np.full((1, 2), 3.0)
    >>> pair_frame(at, at + 1, np.array([10, 10]), np.array([9, 2]), 8)  # (2.5, 1.5): left, below
    (array([[-0.5, -2.5]]), array([[2.5, 0.5]]))
    """
    dx, dy = pair_step(owner, other, width)
    row, column = np.divmod(owner, width)
    x, y = screen_x - (column + 0.5), screen_y - (row + 0.5)
    return dx * x + dy * y, np.abs(dy) * x + np.abs(dx) * y


def pair_frame_backward(grad_x, grad_y, owner, other, width):  # exercise 8.6 (1 point)
    """Backward of eq. (1): grad_x, grad_y (K, N) -> grad_screen_x, grad_screen_y (K, N).

    >>> pair_frame_backward(np.array([[5.0]]), np.array([[7.0]]), np.array([10]), np.array([2]), 8)
    (array([[7.]]), array([[-5.]]))
    """
    dx, dy = pair_step(owner, other, width)
    return dx * grad_x + np.abs(dy) * grad_y, dy * grad_x + np.abs(dx) * grad_y


def crossing(x0, y0, x1, y1):  # exercise 8.7 (1 point)
    """Eq. (3): where the line through (x0, y0) and (x1, y1) meets y = 0: c (...).

    x0, y0, x1, y1 (...), y0 and y1 different. To be measured from the end that is nearer to y = 0:
    the other may be near infinity.

    >>> crossing(np.array([1.0]), np.array([-1.0]), np.array([4.0]), np.array([2.0]))
    array([2.])
    """
    nearer = np.abs(y1) < np.abs(y0)
    x, y = np.where(nearer, x1, x0), np.where(nearer, y1, y0)
    return x - y * (x1 - x0) / (y1 - y0)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):  # exercise 8.8 (3 points)
    """Backward of eq. (3): grad_c (...) -> grad_x0, grad_y0, grad_x1, grad_y1, each (...).

    y0 and y1 are different. An edge that is nearly along y = 0 has a huge gradient; epsilon >= 0
    tames it. With
    r = 1 / (y1 - y0), c = (x0 y1 - x1 y0) r, dc/dx0 = r y1 and dc/dy0 = r (c - x1). In r, and so
    in the c of this formula, y1 - y0 is made longer by epsilon and keeps its sign. (nvdiffrast
    takes 1e-3 pixels.) To exchange the two ends must exchange their gradients, and no more.

    >>> grad_c, x0, y0, x1, y1 = np.array([[1.0], [1.0], [-1.0], [4.0], [3.0]])
    >>> np.stack(crossing_backward(grad_c, x0, y0, x1, y1)).T
    array([[ 0.75  , -0.5625,  0.25  , -0.1875]])
    >>> np.stack(crossing_backward(grad_c, x0, y0, x1, y1, epsilon=4.0)).T
    array([[ 0.375   , -0.390625,  0.125   ,  0.015625]])
    """
    # c is the mean of x0 and x1 with the weights y1 and -y0, over their sum y1 - y0.
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return slope * y1, slope * (c - x1), -slope * y0, slope * (x0 - c)


def last_crossing(x, y, w):  # exercise 8.9 (3 points)
    """The edge by which the line y = 0 leaves a face on the way from the owner to the other.

    x, y (3, N): the face's corners, in the pair's frame; w (3, N), negative behind the camera
    -> edge (N,) from 0 to 2, c (N,), its eq. (3). Edge k, opposite to vertex k, crosses if one of
    its ends has y w < 0, the other y w >= 0, and the point where it does is in front of the camera:
    w_i |y_j w_j| + w_j |y_i w_i| > 0, i and j the ends. Of these edges, the one of greatest c; of
    equal c, the first; if there is none, edge 0 with c = -np.inf. Nothing is divided by 0.

    >>> x, y = np.array([[-1.0], [3.0], [1.0]]), np.array([[-1.0], [-1.0], [1.0]])
    >>> last_crossing(x, y, np.ones((3, 1)))
    (array([0]), array([2.]))
    """
    c, above = np.full(x.shape, -np.inf), y * w
    for k, (i, j) in enumerate(EDGES):
        crosses = (above[i] < 0) != (above[j] < 0)
        crosses &= w[i] * np.abs(above[j]) + w[j] * np.abs(above[i]) > 0
        c[k, crosses] = crossing(*(corner[crosses] for corner in (x[i], y[i], x[j], y[j])))
    edge = c.argmax(0)
    return edge, c[edge, np.arange(len(edge))]


def is_blended(c, is_silhouette, x0, y0, x1, y1):  # exercise 8.10 (2 points)
    """Is this edge one that blends the pair?

    c (N,) of eq. (3), is_silhouette (N,) bool, and the edge's ends in the pair's frame, each (N,)
    -> bool (N,). It must be a silhouette; steep, in y at least as long as in x (the others are
    left to the pairs of the other direction); and cross between the centres, c from 0 to 1, or
    less than WINDOW outside.

    >>> one = np.ones(4)
    >>> is_blended(np.array([0.5, -0.05, -0.07, 0.5]), one > 0, 0 * one, -one, np.arange(4.0), one)
    array([ True,  True, False, False])
    """
    is_steep = np.abs(y1 - y0) >= np.abs(x1 - x0)
    return is_silhouette & is_steep & (c > -WINDOW) & (c < 1 + WINDOW)


def blend_weight(c):  # exercise 8.11 (1 point)
    """Eq. (4): alpha (N,) of crossings c (N,); a c outside of [0, 1] counts as 0 or 1.

    >>> blend_weight(np.array([-0.01, 0.25, 1.0]))
    array([ 0.5 ,  0.25, -0.5 ])
    """
    return 0.5 - np.clip(c, 0, 1)


def blend_weight_backward(grad_alpha, c):  # exercise 8.12 (1 point)
    """Backward of eq. (4): grad_alpha, c (N,) -> grad_c (N,), 0 where c <= 0 or c >= 1.

    >>> blend_weight_backward(np.array([2.0, 2.0, 2.0]), np.array([-0.01, 0.25, 1.0]))
    array([ 0., -2.,  0.])
    """
    return np.where((0 < c) & (c < 1), -grad_alpha, 0.0)


def blend(colour, owner, other, alpha):  # exercise 8.13 (3 points)
    """Eq. (5) for all pairs: colour (H, W, C), owner, other, alpha (N,) -> output (H, W, C).

    owner, other: numbers of pixels, row * W + column. A pixel may be in several pairs. All of
    them read `colour`, so that their order does not matter, and their changes add up. The output
    is of floats, whatever colour is.

    >>> blend(np.array([[[0.0], [1.0], [5.0]]]), np.array([0, 2]), np.array([1, 1]),
    ...       np.array([0.25, -0.5]))
    array([[[0.25],
            [3.  ],
            [5.  ]]])
    """
    pixels = colour.reshape(-1, colour.shape[-1]).astype(float)
    output = pixels.copy()
    changed = np.where(alpha > 0, owner, other)
    np.add.at(output, changed, alpha[:, None] * (pixels[other] - pixels[owner]))
    return output.reshape(colour.shape)


def blend_backward(grad_output, colour, owner, other, alpha):  # exercise 8.14 (4 points)
    """Backward of eq. (5): grad_output (H, W, C) -> grad_colour (H, W, C), grad_alpha (N,).

    At alpha = 0, eq. (5) has a kink: to one side the owner changes, to the other side the other.
    There, unlike for alpha < 0, count the change of the owner.

    >>> colour, grad_output = np.array([[[0.0], [1.0]]]), np.array([[[10.0], [100.0]]])
    >>> blend_backward(grad_output, colour, np.array([0]), np.array([1]), np.array([0.25]))
    (array([[[  7.5],
            [102.5]]]), array([10.]))
    """
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[np.where(alpha >= 0, owner, other)]
    # changed += alpha (other - owner), for either sign of alpha.
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    np.add.at(grad_colour, owner, -alpha[:, None] * grad_changed)
    np.add.at(grad_colour, other, alpha[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha


def seen_silhouettes(face_index, screen, faces, opposite):
    """Eq. (2) for the faces that the picture shows: bool (F + 1, 3), False for others and for -1.

    face_index (H, W); screen: x, y, w (V,) of the vertices.
    """
    seen, silhouette = np.zeros(len(faces) + 1, bool), np.zeros((len(faces) + 1, 3), bool)
    seen[face_index[face_index >= 0]] = True
    seen = np.flatnonzero(seen[:-1])
    silhouette[seen] = silhouette_edges(*screen, faces[seen], opposite[seen])
    return silhouette


def last_edges(owner, other, face_index, screen, faces):
    """The `last_crossing` of pairs (N,): edge (N,), c (N,), its two ends' vertices (2, N), and
    their x, y in the pair's frame, (2, N) each.
    """
    x, y, w = screen
    corners = faces[face_index.ravel()[owner]].T
    corner_x, corner_y = pair_frame(x[corners], y[corners], owner, other, face_index.shape[1])
    edge, c = last_crossing(corner_x, corner_y, w[corners])
    ends = np.array(EDGES).T[:, edge], np.arange(len(edge))
    return edge, c, corners[ends], corner_x[ends], corner_y[ends]


def blended_pairs(face_index, depth, clip, faces, opposite):
    """The pairs of pixels that are blended: owner, other, c (N,), the vertices at the ends of their
    edges (2, N), and those ends' x, y in the pair's frame, (2, N) each.
    """
    height, width = face_index.shape
    with np.errstate(all="ignore"):  # of vertices that no seen face has
        screen = rasterization.screen_points(clip, width, height)
    silhouette = seen_silhouettes(face_index, screen, faces, opposite)
    has_silhouette = silhouette.any(1)
    owner, other = owner_and_other(*neighbour_pairs(face_index, has_silhouette[face_index]), depth)
    face = face_index.ravel()[owner]
    owner, other, face = (pixels[has_silhouette[face]] for pixels in (owner, other, face))
    edge, c, ends, x, y = last_edges(owner, other, face_index, screen, faces)
    kept = is_blended(c, silhouette[face, edge], x[0], y[0], x[1], y[1])
    kept &= ~is_dropped(c, owner, other)
    return owner[kept], other[kept], c[kept], ends[:, kept], x[:, kept], y[:, kept]


def is_dropped(c, owner, other):
    """Pairs (N,) with alpha = 0, where nothing moves and either side's gradient would do: as in
    nvdiffrast, those of them that their first pixel owns have none.
    """
    return (c == 0.5) & (owner < other)


def antialias(colour, face_index, depth, clip, faces, opposite):
    """Eqs. (1) to (5) for a picture: colour (H, W, C) -> output (H, W, C).

    face_index (H, W), depth (H, W) of `rasterize`, np.inf where there is no face; clip (V, 4),
    faces (F, 3), opposite (F, 3) of `opposite_vertices`, once for a mesh. Faces that meet share
    their vertices here; doubled ones, as for uv seams, make the seam an outline. Give attributes
    their own faces, as lab 5 does.
    """
    owner, other, c, *_ = blended_pairs(face_index, depth, clip, faces, opposite)
    return blend(colour, owner, other, blend_weight(c))


def antialias_backward(grad_output, colour, face_index, depth, clip, faces, opposite, epsilon=0.0):
    """Backward of `antialias`: grad_output (H, W, C) -> grad_colour (H, W, C), grad_clip (V, 4).

    The face of each pixel, the edge of each pair and whether it is blended are taken as given.
    epsilon: of `crossing_backward`, in pixels. Near the camera plane digits are lost: where w is a
    millionth of x or y, six of the gradient by w are right.
    """
    height, width = face_index.shape
    owner, other, c, ends, x, y = blended_pairs(face_index, depth, clip, faces, opposite)
    grad_colour, grad_alpha = blend_backward(grad_output, colour, owner, other, blend_weight(c))
    grad_c = blend_weight_backward(grad_alpha, c)
    grad_x0, grad_y0, grad_x1, grad_y1 = crossing_backward(grad_c, x[0], y[0], x[1], y[1], epsilon)
    grad_x, grad_y = pair_frame_backward(np.stack([grad_x0, grad_x1]), np.stack([grad_y0, grad_y1]),
                                         owner, other, width)
    # From the ends of edges to vertices, and from the screen back to clip space.
    vertex, end = np.unique(ends, return_inverse=True)
    grad_screen = np.zeros((len(vertex), 3))
    for axis, grad in enumerate((grad_x, grad_y)):
        grad_screen[:, axis] = np.bincount(end.ravel(), grad.ravel(), len(vertex))
    grad_ndc = transforms.to_screen_backward(grad_screen, width, height)
    with np.errstate(all="ignore"):
        *_, w = rasterization.screen_points(clip[vertex], width, height)  # as the forward divides
    grad_clip = np.zeros(clip.shape)
    grad_clip[vertex] = transforms.perspective_divide_backward(
        grad_ndc, np.column_stack([clip[vertex, :3], w]))
    return grad_colour, grad_clip


def pair_reasons(face_index, depth, clip, faces, opposite):
    """How far each pair of pixels that see different faces gets: owner, other, reason (N,), and
    that, or less, for the corners of the owner's face: corners, corner_reason (3, N).

    The reason of an edge's ends is the pair's. A corner that is none of them ends another edge,
    and so has 4 at the most, if this is a silhouette, and else 3.
    """
    height, width = face_index.shape
    with np.errstate(all="ignore"):
        screen = rasterization.screen_points(clip, width, height)
    silhouette = seen_silhouettes(face_index, screen, faces, opposite)
    owner, other = owner_and_other(*neighbour_pairs(face_index, face_index == face_index), depth)
    face = face_index.ravel()[owner]
    edge, c, _, x, y = last_edges(owner, other, face_index, screen, faces)
    failed = [~silhouette[face].any(1), ~silhouette[face, edge],
              np.abs(y[1] - y[0]) < np.abs(x[1] - x[0]), (c <= -WINDOW) | (c >= 1 + WINDOW),
              (c <= 0) | (c >= 1) | is_dropped(c, owner, other)]
    reason = np.select(failed, np.arange(3, 8), 8)
    touched = silhouette[:, [1, 2, 0]] | silhouette[:, [2, 0, 1]]
    corner_reason = np.minimum(reason, np.where(touched[face], 4, 3).T)
    for ends in np.array(EDGES).T[:, edge]:
        corner_reason[ends, np.arange(len(edge))] = reason
    return owner, other, reason, faces[face].T, corner_reason


def why_zero(face_index, depth, clip, faces, opposite):
    """Why has a pixel, or a vertex, no position gradient? -> pixel (H, W), vertex (V,), integers.

    They number REASONS: how far the best of its pairs got, of a vertex the best that its faces own.
    "not seen": the pixel sees no face, or no face of the vertex is seen. "no pair": its neighbours
    see the same face, or the faces across are nearer. A vertex behind the camera without a gradient
    is called so. Colours and the loss are not looked at: equal colours, or a loss that does not
    ask, give 0 at the last reason, too.
    """
    owner, other, reason, corners, corner_reason = pair_reasons(face_index, depth, clip, faces,
                                                                opposite)
    pixel = (face_index.ravel() >= 0).astype(int)
    np.maximum.at(pixel, owner, reason)
    np.maximum.at(pixel, other, reason)
    vertex = np.zeros(len(clip), int)
    vertex[faces[face_index[face_index >= 0]]] = 1
    np.maximum.at(vertex, corners.ravel(), corner_reason.ravel())
    vertex[(clip[:, 3] < 0) & (vertex < 8)] = 2
    return pixel.reshape(face_index.shape), vertex


def overblended(colour, face_index, depth, clip, faces, opposite):
    """Where several edges blend into one pixel and leave the range of the colours: bool (H, W).

    Each of up to four pairs moves a pixel up to half of the way to its other colour; together they
    can go too far. True where a channel of `antialias` lies outside of all that were blended there.
    """
    owner, other, c, *_ = blended_pairs(face_index, depth, clip, faces, opposite)
    output = blend(colour, owner, other, blend_weight(c))
    owner_changes = blend_weight(c) > 0
    changed, source = np.where(owner_changes, owner, other), np.where(owner_changes, other, owner)
    pixels, low, high = (colour.reshape(-1, colour.shape[-1]).astype(float) for _ in range(3))
    np.minimum.at(low, changed, pixels[source])
    np.maximum.at(high, changed, pixels[source])
    output = output.reshape(low.shape)
    beyond = (output < low - ROUNDING) | (output > high + ROUNDING)
    return beyond.any(1).reshape(face_index.shape)
