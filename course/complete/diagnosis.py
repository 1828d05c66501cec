"""Diagnosis: why a pixel or a vertex has no position gradient, and where colours leave their range.

Lab 8 blends a pair of pixels only if it passes every test below, in this order. The number of the
first test that a pair fails, from 3 to 5, is its reason. A pair that fails none, 6, has a gradient.

    3   a walk between its centres finds an outline, or the surfaces meet there
    4   this line is steep
    5   alpha is neither saturated nor, in a pair that is dropped, 0

0 to 2 are for pixels and vertices that have no pair, and for vertices behind the camera. All
parameters are those of `all_pairs`.
"""
import numpy as np

from .antialiasing import blend_pairs
from .intersections import all_pairs, meetings, planes
from .outline_walk import both_pairs
from .outlines import is_dropped, neighbours

ROUNDING = 1e-9  # of a colour: more than this beyond the range is not rounding
REASONS = ("not seen: hidden or outside", "no pair", "behind the camera", "the surface goes on",
           "outline not steep", "alpha saturated, or 0", "has a gradient")  # the farther the higher
(NOT_SEEN, NO_PAIR, BEHIND_THE_CAMERA, GOES_ON, NOT_STEEP, SATURATED,
 HAS_GRADIENT) = range(len(REASONS))


def reasons(pairs):
    """How far does each pair of `outline_pairs` get? -> (N,)"""
    is_flat = np.abs(pairs.y[1] - pairs.y[0]) < np.abs(pairs.x[1] - pairs.x[0])
    is_still = (pairs.c <= 0) | (pairs.c >= 1) | is_dropped(pairs.c, pairs.owner, pairs.other)
    return np.select([is_flat, is_still], [NOT_STEEP, SATURATED], HAS_GRADIENT)


def why_zero(face_index, depth, clip, faces, opposite):
    """Why has a pixel, or a vertex, no position gradient? -> pixel (H, W), vertex (V,), integers.

    They number REASONS: how far the best pair of a pixel got, or the best pair whose edge moves
    with a vertex. "not seen": the pixel sees no face, or no face of the vertex is seen, and none is
    an outline. "no pair": all neighbours see the same face. "the surface goes on": they see another
    one, but no outline is between them, nor do surfaces meet there. A vertex behind the camera
    without a gradient is called so. Neither colours nor the loss are looked at: equal colours, or a
    loss that does not depend on them, give 0 at the last reason.
    """
    owner, other = neighbours(face_index, depth)
    outlines, _ = both_pairs(face_index, depth, clip, faces, opposite)
    is_seen = face_index >= 0
    pixel = np.where(is_seen, NO_PAIR, NOT_SEEN).ravel()
    pixel[owner], pixel[other] = GOES_ON, GOES_ON
    vertex = np.full(len(clip), NOT_SEEN)
    vertex[faces[face_index[is_seen]]] = NO_PAIR
    vertex[faces[face_index.ravel()[owner]]] = GOES_ON
    met = meetings(all_pairs(face_index, depth, clip, faces, opposite), clip)
    corners, *_ = planes(met, 0.0, 0.0, clip, faces, face_index.shape)
    for pairs, vertices in (outlines, outlines.ends), (met, corners.reshape(6, -1)):
        reached = reasons(pairs)
        np.maximum.at(pixel, pairs.owner, reached)
        np.maximum.at(pixel, pairs.other, reached)
        for end in vertices:
            np.maximum.at(vertex, end, reached)
    vertex[(clip[:, 3] < 0) & (vertex < HAS_GRADIENT)] = BEHIND_THE_CAMERA
    return pixel.reshape(face_index.shape), vertex


def overblended(colour, face_index, depth, clip, faces, opposite):
    """Where do several edges blend into one pixel, beyond the range of its colours? bool (H, W).

    Each of up to four pairs moves a pixel up to half of the way to its other colour, and together
    they can go too far. True where a channel lies outside of all colours that were blended there.
    """
    pairs = all_pairs(face_index, depth, clip, faces, opposite)
    changed = np.where(pairs.c < 0.5, pairs.owner, pairs.other)
    source = np.where(pairs.c < 0.5, pairs.other, pairs.owner)
    pixels = np.reshape(colour, (-1, colour.shape[-1]))
    low, high = pixels.astype(float), pixels.astype(float)
    np.minimum.at(low, changed, pixels[source])
    np.maximum.at(high, changed, pixels[source])
    output = blend_pairs(colour, pairs).reshape(pixels.shape)
    beyond = (output < low - ROUNDING) | (output > high + ROUNDING)
    return beyond.any(1).reshape(face_index.shape)
