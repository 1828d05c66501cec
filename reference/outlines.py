"""Outlines: lab 8's blend for whole pictures, and its gradient from the picture to clip space.

The steps are lab 8's, with the numbers of its equations. `blend_pairs_backward` takes them upwards.

    screen points   ->  silhouette edges of the faces that are seen     (1)   seen_silhouettes
    pictures        ->  pairs of pixels in which an edge may run        (2)   jumping_pairs
    pairs           ->  the edge that the pair's line crosses last      (3)   jumping_pairs
    edges           ->  the pairs that are blended, and alpha           (4)   blended_pairs
    pairs, colours  ->  picture                                         (5)   blend_pairs

face_index and depth (H, W) are those of `rasterize`: -1 and np.inf where no face is seen. clip
(V, 4) and faces (F, 3) are the mesh, opposite (F, 3) is made once for it by `opposite_vertices`.

Source: Laine et al. 2020 (nvdiffrast), section 3.6.
"""
from typing import NamedTuple

import numpy as np

from . import transforms
from .antialiasing import (
    blend,
    blend_backward,
    blend_weight,
    blend_weight_backward,
    crossing_backward,
    is_blended,
    last_crossing,
    neighbour_pairs,
    owner_and_other,
    pair_frame,
    pair_frame_backward,
    silhouette_edges,
)
from .arrays import EDGES, scatter
from .rasterization import screen_points


class Pairs(NamedTuple):
    """N pairs of neighbouring pixels, each with the edge of the owner's face between them."""

    owner: np.ndarray  # (N,) number of the pixel, row * W + column
    other: np.ndarray  # (N,)
    c: np.ndarray      # (N,) where the edge crosses, eq. (3)
    ends: np.ndarray   # (2, N) the vertices at the edge's ends
    x: np.ndarray      # (2, N) where these are in the pair's frame
    y: np.ndarray      # (2, N)
    face: np.ndarray   # (N,) the owner's face
    edge: np.ndarray   # (N,) which of this face's edges, from 0 to 2


def vertices_on_screen(clip, width, height):
    """x, y, w (V,) of `screen_points`, without warnings: vertices that no seen face has may be
    anything.
    """
    with np.errstate(all="ignore"):
        return screen_points(clip, width, height)


def vertices_on_screen_backward(grad_x, grad_y, clip, width, height):
    """Backward of `vertices_on_screen` for x and y: grad_x, grad_y (V,) -> grad_clip (V, 4)."""
    # Lab 1's viewport and divide, read upwards. The w is the one that the forward divides by.
    *_, w = vertices_on_screen(clip, width, height)
    grad_screen = np.stack([grad_x, grad_y, 0 * grad_x], -1)
    grad_ndc = transforms.to_screen_backward(grad_screen, width, height)
    return transforms.perspective_divide_backward(grad_ndc, np.column_stack([clip[:, :3], w]))


def seen_silhouettes(face_index, screen, faces, opposite):
    """Eq. (1) for the faces that the picture shows: bool (F + 1, 3).

    screen: x, y, w (V,) of the vertices. False for a face that is not seen, and in the last row,
    which face_index -1 finds.
    """
    is_seen = np.zeros(len(faces) + 1, bool)
    is_seen[face_index.ravel()] = True
    seen = np.flatnonzero(is_seen[:-1])
    silhouette = np.zeros((len(faces) + 1, 3), bool, order="F")  # one edge after the other
    silhouette[seen] = silhouette_edges(*screen, faces.take(seen, 0),
                                         opposite.take(seen, 0))
    return silhouette


def jumping_pairs(face_index, depth, screen, faces, outlined):
    """Eqs. (2) and (3): the Pairs that see different faces, and whose owner's face is outlined.

    screen: x, y, w (V,) of the vertices. outlined: bool (F + 1,), the last for face_index -1.
    """
    owner, other = owner_and_other(*neighbour_pairs(face_index, outlined[face_index]), depth)
    face = face_index.ravel()[owner]
    kept = outlined[face]
    owner, other, face = owner[kept], other[kept], face[kept]
    corners = faces[face].T
    screen_x, screen_y, w = (values[corners] for values in screen)
    x, y = pair_frame(screen_x, screen_y, owner, other, face_index.shape[1])
    edge, c = last_crossing(x, y, w)
    ends = np.array(EDGES).T[:, edge], np.arange(len(edge))
    return Pairs(owner, other, c, corners[ends], x[ends], y[ends], face, edge)


def is_dropped(c, owner, other):
    """nvdiffrast's choice among the pairs (N,) with alpha = 0: those that their first pixel owns
    are left out. Nothing moves in them, and at the kink either side's gradient would do.
    """
    return (c == 0.5) & (owner < other)


def blended_pairs(face_index, depth, clip, faces, opposite):
    """The Pairs that are blended."""
    height, width = face_index.shape
    screen = vertices_on_screen(clip, width, height)
    silhouette = seen_silhouettes(face_index, screen, faces, opposite)
    pairs = jumping_pairs(face_index, depth, screen, faces, silhouette.any(1))
    c, x, y = pairs.c, pairs.x, pairs.y
    kept = is_blended(c, silhouette[pairs.face, pairs.edge], x[0], y[0], x[1], y[1])
    kept &= ~is_dropped(c, pairs.owner, pairs.other)
    return Pairs(*(values[..., kept] for values in pairs))


def antialias(colour, face_index, depth, clip, faces, opposite):
    """Eqs. (1) to (5) for a picture: colour (H, W, C) -> output (H, W, C).

    Fine print. Faces that meet share their vertices here. Doubled vertices, as for uv seams, make
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


def blend_pairs(colour, pairs):
    """Eqs. (4) and (5) for the Pairs that are blended: colour (H, W, C) -> output (H, W, C)."""
    return blend(colour, pairs.owner, pairs.other, blend_weight(pairs.c))


def blend_pairs_backward(grad_output, colour, pairs, clip, epsilon=0.0):
    """Backward of `blend_pairs`: grad_output (H, W, C) -> grad_colour (H, W, C), grad_clip (V, 4).

    pairs of `blended_pairs`, clip (V, 4). epsilon: of `crossing_backward`, in pixels.

    Fine print. Near the camera plane digits are lost: where w is a millionth of x or y, six digits
    of the gradient with respect to w are right.
    """
    # The steps of `antialias` upwards, as far as the edges' ends. Then each vertex sums the
    # gradients of all edges that end there, and only such vertices go back to clip space.
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
    grad_clip[vertex] = vertices_on_screen_backward(grad_x, grad_y, clip[vertex], width, height)
    return grad_colour, grad_clip
