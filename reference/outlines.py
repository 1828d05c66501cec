"""Outlines: in which pairs of pixels of a picture does an edge run, and which edge is it?

    pictures        ->  pairs of pixels in which an edge may run        (2)   neighbours
    pairs, a face   ->  the edge that the pair's line crosses last      (3)   leave_faces
    screen points   ->  silhouette edges of all faces                   (1)   all_silhouettes
    outlines        ->  the pairs that are blended                            steep_pairs

The numbers are those of the equations in antialiasing.py. All of these decide, and decisions have
no gradient. Where the edges cross has one: (4), (5) and the way back to clip space are
`blend_pairs` and its backward pass there. `antialias` joins both as nvdiffrast does, which looks at
the owner's face alone. outline_walk.py walks on from there. face_index and depth (H, W) are those
of `rasterize`: -1 and np.inf where no face is seen. clip (V, 4) and faces (F, 3) are the mesh,
opposite (F, 3) is made once for it by `opposite_corners`.

Source: Laine et al. 2020 (nvdiffrast), section 3.6.
"""
import numpy as np

from course.given.arrays import EDGES

from .antialiasing import (
    Pairs,
    blend_pairs,
    blend_pairs_backward,
    last_crossing,
    pair_frame,
    silhouette_edges,
)
from .rasterization import screen_points

WINDOW = 1 / 16  # pixels: what an edge may be off where nvdiffrast's rasterizer rounds vertices


def vertices_across(faces, opposite):
    """The vertices of corners (..., 3) of `opposite_corners`, -1 for none."""
    vertices = faces.ravel().astype(np.intp)
    return np.where(opposite < 0, -1, vertices.take(opposite, mode="clip"))


def all_silhouettes(clip, faces, opposite, width, height):
    """x, y, w (V,) on screen, and `silhouette_edges` of all faces, bool (F, 3), without warnings:
    vertices that no seen face has may be anything.
    """
    with np.errstate(all="ignore"):
        screen = screen_points(clip, width, height)
        return screen, silhouette_edges(*screen, faces, vertices_across(faces, opposite))


def neighbours(face_index, depth):  # step 8.6
    """Which neighbouring pixels see different faces? -> owner, other (N,)

    face_index, depth (H, W). Neighbours lie beside or above each other. The owner sees the nearer
    face. Pixels are numbered row * W + column. Any order of pairs will do. See `demo borders`.

    >>> neighbours(np.array([[0, 0], [1, -1]]), np.array([[0.5, 0.5], [0.25, np.inf]]))
    (array([2, 2, 1]), array([3, 0, 3]))

    Fine print. Of two that are equally deep, the one to the right or above is the owner.
    """
    width = face_index.shape[1]
    face, deep = face_index.ravel(), depth.ravel()
    left = np.flatnonzero(face[:-1] != face[1:])
    left = left[left % width < width - 1]  # the end of a row has no neighbour in the next one
    lower = np.flatnonzero(face[:-width] != face[width:])
    first, second = np.append(left, lower), np.append(left + 1, lower + width)
    owner = np.where(deep[first] < deep[second], first, second)
    return owner, first + second - owner


def leave_faces(owner, other, face, screen, faces, width):  # step 8.7
    """By which edge does each pair's line leave a face, on the way from owner to other? -> Pairs

    owner, other, face (N,). screen: x, y, w (V,) of the vertices, all w > 0. faces (F, 3). In the
    pair's frame (2), the line is y = 0. Of the edges that cross it (3), take the one with the
    greatest c. `Pairs` says what belongs to each. EDGES is a tuple: np.array(EDGES) can be indexed
    by edge (N,).

    >>> screen = np.array([[-9.0, 1.0, 2.0], [0.0, -1.5, 2.5], [1.0, 1.0, 1.0]])
    >>> pairs = leave_faces(*np.array([[0], [1], [0]]), screen, np.array([[0, 1, 2]]), 3)
    >>> pairs.edge, pairs.c, pairs.ends.T, pairs.x.T
    (array([0]), array([1.]), array([[1, 2]]), array([[0.5, 1.5]]))

    Fine print. Corners behind the camera, faces that no edge leaves, and equal c are as in
    `last_crossing`.
    """
    # Where the pair's line runs exactly along an edge between two faces, its pixels see the face
    # above, of which no corner lies below. So no edge is crossed, and an outline further on is
    # missed. nvdiffrast's kernels decide so, and the golden numbers have such ties.
    corners = faces[face].T
    screen_x, screen_y, w = (values[corners] for values in screen)
    x, y = pair_frame(screen_x, screen_y, owner, other, width)
    edge, c = last_crossing(x, y, w)
    ends = np.array(EDGES).T[:, edge], np.arange(len(edge))
    return Pairs(owner, other, c, corners[ends], x[ends], y[ends], face, edge)


def select(pairs, kept):
    """Those of the Pairs that are kept: bool (N,), or their numbers."""
    return Pairs(*(values[..., kept] for values in pairs))


def is_dropped(c, owner, other):
    """nvdiffrast's choice among the pairs (N,) with alpha = 0: those that their first pixel owns
    are left out. Nothing moves in them, and at the kink either side's gradient would do.
    """
    return (c == 0.5) & (owner < other)


def steep_pairs(pairs):  # step 8.8
    """Which of the pairs at outlines are blended? -> Pairs

    Their edge is steep: in the pair's frame at least as long in y as in x. Its c lies between 0 and
    1, or less than WINDOW outside. The given `select` picks the pairs. See `demo borders`.

    >>> x, y = np.array([[0.0, 0.0], [0.5, 2.0]]), np.array([[-1.0, -1.0], [1.0, 1.0]])
    >>> c = np.array([0.25, 1.0])
    >>> steep_pairs(Pairs(np.array([0, 2]), np.array([1, 1]), c, x, x, y, c, c)).c
    array([0.25, 1.  ])

    Fine print. Leave out what the given `is_dropped` names.
    """
    c, x, y = pairs.c, pairs.x, pairs.y
    kept = np.abs(y[1] - y[0]) >= np.abs(x[1] - x[0])
    kept &= (c > -WINDOW) & (c < 1 + WINDOW)
    return select(pairs, kept & ~is_dropped(c, pairs.owner, pairs.other))


def blended_pairs(face_index, depth, clip, faces, opposite):
    """The pairs that nvdiffrast blends: by their last edge the line leaves the owner's face, and
    that edge is a silhouette. face_index, depth (H, W), clip (V, 4), faces, opposite (F, 3).
    """
    height, width = face_index.shape
    screen, silhouette = all_silhouettes(clip, faces, opposite, width, height)
    owner, other = neighbours(face_index, depth)
    face = face_index.ravel()[owner]
    kept = silhouette.any(1)[face]
    pairs = Pairs(*leave_faces(owner[kept], other[kept], face[kept], screen, faces, width))
    return steep_pairs(select(pairs, silhouette[pairs.face, pairs.edge]))


def antialias(colour, face_index, depth, clip, faces, opposite):
    """Eqs. (1) to (5) for a picture: colour (H, W, C) -> output (H, W, C).

    Faces that meet share their vertices here. Doubled vertices, as for uv seams, make
    the seam an outline: give attributes their own faces, as lab 5 does.
    """
    return blend_pairs(colour, blended_pairs(face_index, depth, clip, faces, opposite))


def antialias_backward(grad_output, colour, face_index, depth, clip, faces, opposite, epsilon=0.0):
    """Backward of `antialias`: grad_output (H, W, C) -> grad_colour (H, W, C), grad_clip (V, 4).

    The face of each pixel, the edge of each pair and whether it is blended are taken as given.
    epsilon: of `crossing_backward`, in pixels.
    """
    pairs = blended_pairs(face_index, depth, clip, faces, opposite)
    return blend_pairs_backward(grad_output, colour, pairs, clip, epsilon)
