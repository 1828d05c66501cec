"""Diagnosis: why a pixel or a vertex has no position gradient, and where colours leave their range.

Lab 8 blends a pair of pixels only if it passes every test below, in this order. The number of the
first test that a pair fails, from 3 to 7, is its reason. Its gradient is not zero only at 8.

    3   the owner's face has a silhouette edge
    4   the edge that the pair's line crosses last is a silhouette
    5   this edge is steep
    6   it crosses between the centres, or less than WINDOW outside
    7   alpha is neither saturated nor, in a pair that nvdiffrast drops, 0

0 to 2 are for pixels and vertices that have no pair, and for vertices behind the camera. All
parameters are those of `antialias`.
"""
import numpy as np

from course.given.arrays import EDGES

from .antialiasing import blend_pairs
from .outlines import (
    WINDOW,
    blended_pairs,
    is_dropped,
    jumping_pairs,
    seen_silhouettes,
    vertices_on_screen,
)

ROUNDING = 1e-9  # of a colour: more than this beyond the range is not rounding
REASONS = ("not seen: hidden or outside", "no pair", "behind the camera", "no silhouette edge",
           "last edge is another one", "edge not steep", "crossing outside the pair",
           "alpha saturated, or 0", "has a gradient")  # of `why_zero`, the farther the higher
(NOT_SEEN, NO_PAIR, BEHIND_THE_CAMERA, NO_SILHOUETTE, ANOTHER_EDGE, NOT_STEEP, OUTSIDE, SATURATED,
 HAS_GRADIENT) = range(len(REASONS))


def pair_reasons(face_index, depth, clip, faces, opposite):
    """How far does each pair of pixels that see different faces get?

    -> owner, other, reason (N,), and for the corners of the owner's face: vertices (3, N), and
    their reason (3, N). The ends of the edge that the pair's line crosses last have the pair's
    reason. The third corner ends the two other edges: it gets as far as ANOTHER_EDGE if one of
    these is a silhouette, else as far as NO_SILHOUETTE, and never farther than the pair.
    """
    height, width = face_index.shape
    screen = vertices_on_screen(clip, width, height)
    silhouette = seen_silhouettes(face_index, screen, faces, opposite)
    everywhere = np.ones(len(faces), bool)
    owner, other, c, _, x, y, face, edge = jumping_pairs(face_index, depth, screen, faces,
                                                         everywhere)
    failed = {NO_SILHOUETTE: ~silhouette[face].any(1),
              ANOTHER_EDGE: ~silhouette[face, edge],
              NOT_STEEP: np.abs(y[1] - y[0]) < np.abs(x[1] - x[0]),
              OUTSIDE: (c <= -WINDOW) | (c >= 1 + WINDOW),
              SATURATED: (c <= 0) | (c >= 1) | is_dropped(c, owner, other)}
    reason = np.select(list(failed.values()), list(failed), HAS_GRADIENT)
    ends_silhouette = silhouette[:, [1, 2, 0]] | silhouette[:, [2, 0, 1]]
    at_most = np.where(ends_silhouette[face], ANOTHER_EDGE, NO_SILHOUETTE).T
    corner_reason = np.minimum(reason, at_most)
    corner_reason[np.array(EDGES).T[:, edge], np.arange(len(edge))] = reason
    return owner, other, reason, faces[face].T, corner_reason


def why_zero(face_index, depth, clip, faces, opposite):
    """Why has a pixel, or a vertex, no position gradient? -> pixel (H, W), vertex (V,), integers.

    They number REASONS: how far the best pair of a pixel got, or the best pair of the faces that a
    vertex belongs to and that own the pair's edge. "not seen": the pixel sees no face, or no face
    of the vertex is seen. "no pair": all neighbours see the same face, or the faces across are
    nearer. A vertex behind the camera without a gradient is called so. Neither colours nor the loss
    are looked at: equal colours, or a loss that does not depend on them, give 0 at the last reason.
    """
    owner, other, reason, corners, corner_reason = pair_reasons(face_index, depth, clip, faces,
                                                                opposite)
    is_seen = face_index >= 0
    pixel = np.where(is_seen, NO_PAIR, NOT_SEEN).ravel()
    np.maximum.at(pixel, owner, reason)
    np.maximum.at(pixel, other, reason)
    vertex = np.full(len(clip), NOT_SEEN)
    vertex[faces[face_index[is_seen]]] = NO_PAIR
    np.maximum.at(vertex, corners, corner_reason)
    vertex[(clip[:, 3] < 0) & (vertex < HAS_GRADIENT)] = BEHIND_THE_CAMERA
    return pixel.reshape(face_index.shape), vertex


def overblended(colour, face_index, depth, clip, faces, opposite):
    """Where do several edges blend into one pixel, beyond the range of its colours? bool (H, W).

    Each of up to four pairs moves a pixel up to half of the way to its other colour, and together
    they can go too far. True where a channel of `antialias` lies outside of all colours that were
    blended there.
    """
    pairs = blended_pairs(face_index, depth, clip, faces, opposite)
    changed = np.where(pairs.c < 0.5, pairs.owner, pairs.other)
    source = np.where(pairs.c < 0.5, pairs.other, pairs.owner)
    pixels = np.reshape(colour, (-1, colour.shape[-1]))
    low, high = pixels.astype(float), pixels.astype(float)
    np.minimum.at(low, changed, pixels[source])
    np.maximum.at(high, changed, pixels[source])
    output = blend_pairs(colour, pairs).reshape(pixels.shape)
    beyond = (output < low - ROUNDING) | (output > high + ROUNDING)
    return beyond.any(1).reshape(face_index.shape)
