"""Outlines: in which pairs of pixels of a picture does an edge run, and which edge is it?

The steps are those of antialiasing.py, with the numbers of its equations.

    screen points   ->  silhouette edges of the faces that are seen     (1)   seen_silhouettes
    pictures        ->  pairs of pixels in which an edge may run        (2)   jumping_pairs
    pairs           ->  the edge that the pair's line crosses last      (3)   jumping_pairs
    edges           ->  the pairs that are blended                            blended_pairs

All of them decide, and decisions have no gradient. Where the edges cross has one: (4), (5) and the
way back to clip space are `blend_pairs` and its backward pass in antialiasing.py. `antialias` joins
both. face_index and depth (H, W) are those of `rasterize`: -1 and np.inf where no face is seen.
clip (V, 4) and faces (F, 3) are the mesh, opposite (F, 3) is made once for it by
`opposite_vertices`.

Source: Laine et al. 2020 (nvdiffrast), section 3.6.
"""
from typing import NamedTuple

import numpy as np

from course.given.arrays import EDGES

from .antialiasing import (
    blend_pairs,
    blend_pairs_backward,
    is_blended,
    last_crossing,
    neighbour_pairs,
    owner_and_other,
    pair_frame,
    silhouette_edges,
)
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


def seen_silhouettes(face_index, screen, faces, opposite):
    """Eq. (1) for the faces that the picture shows: bool (F + 1, 3).

    screen: x, y, w (V,) of the vertices. False for a face that is not seen, and in the last row,
    which face_index -1 finds.
    """
    is_seen = np.zeros(len(faces) + 1, bool)
    is_seen[face_index.ravel()] = True
    seen = np.flatnonzero(is_seen[:-1])
    silhouette = np.zeros((len(faces) + 1, 3), bool, order="F")  # one edge after the other
    silhouette[seen] = silhouette_edges(*screen, faces.take(seen, 0), opposite.take(seen, 0))
    return silhouette


def jumping_pairs(face_index, depth, screen, faces, outlined):
    """Eqs. (2) and (3): the Pairs that see different faces, and whose owner's face is outlined.

    screen: x, y, w (V,) of the vertices. outlined: bool (F + 1,), the last for face_index -1.

    Where the pair's line runs exactly along an edge between two faces, its pixels see the face
    above, of which no corner lies below. So no edge is crossed, and an outline further on is
    missed. nvdiffrast's kernels decide so, and the golden numbers have such ties.
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
