"""soft_rasterizer: SoftRas's silhouettes, a picture that has a gradient by itself.

A face is seen in a pixel with a probability D_f that falls off with the distance d from the pixel's
centre to the face's border. The pixel sees the union of all faces. No edge is sharp, so the
gradient is exact.

    D_f = 1 / (1 + exp(-+ d^2 / sigma)),   S = 1 - prod_f (1 - D_f)        - inside, + outside (9)

With s = +- d^2 / sigma, + inside, log(1 - D_f) = -log(1 + exp(s)). Their sum is log(1 - S).

Source: Liu et al. 2019 (SoftRas).
"""
from typing import NamedTuple

import numpy as np

from course.given.arrays import EDGES, expand, scatter

from . import neural_renderer

LEAST_PROBABILITY = 1e-6  # a face with less than this does not count in a pixel, eq. (9)


class Fragments(NamedTuple):
    """Pixels and faces (N,) that are near each other, and the nearest point of the face's border.

    It is at t (N,) along an edge (N,). away (N, 2) points from it to the pixel's centre. sign (N,)
    is 1 if the centre is inside of the face, else -1.
    """

    pixel: np.ndarray
    face: np.ndarray
    edge: np.ndarray
    t: np.ndarray
    away: np.ndarray
    sign: np.ndarray


def soft_fragments(triangles, width, height, sigma):
    """The Fragments of eq. (9) for triangles (F, 3, 2), pixel = row * width + column."""
    reach = np.sqrt(sigma * np.log(1 / LEAST_PROBABILITY - 1))
    bounds = np.stack([triangles.min(1) - reach, triangles.max(1) + reach], 1)
    x0, y0, x1, y1 = neural_renderer.pixel_box(bounds, width, height)
    owner, row = expand(y0, y1 - y0)
    span, column = expand(x0[owner], (x1 - x0)[owner])
    face, row = owner[span], row[span]
    centre = np.stack([column, row], -1) + 0.5
    edge, t, away, sign = nearest_on_border(centre, triangles[face])
    near = (sign > 0) | ((away**2).sum(1) < reach**2)
    found = Fragments(row * width + column, face, edge, t, away, sign)
    return Fragments(*(values[near] for values in found))


def nearest_on_border(point, triangles):
    """The point of a triangle's border that is nearest: point (N, 2), triangles (N, 3, 2), of
    either winding -> edge, t (N,), away (N, 2), sign (N,), as of Fragments.
    """
    start, end = triangles[:, [1, 2, 0]], triangles[:, [2, 0, 1]]  # of edges 0, 1 and 2
    along = end - start
    from_start = point[:, None] - start
    length = (along**2).sum(2)
    t = np.clip((from_start * along).sum(2) / np.where(length > 0, length, 1), 0, 1)
    away = from_start - t[..., None] * along
    edge = (away**2).sum(2).argmin(1)
    e = along[..., 0] * from_start[..., 1] - along[..., 1] * from_start[..., 0]
    inside = (e > 0).all(1) | (e < 0).all(1)
    n = np.arange(len(point))
    return edge, t[n, edge], away[n, edge], np.where(inside, 1, -1)


def signed_square(fragments, sigma):
    """s = +- d^2 / sigma of Fragments (N,): positive inside."""
    return fragments.sign * (fragments.away**2).sum(1) / sigma


def soft_silhouette(triangles, width, height, sigma):
    """Eq. (9): S (height, width), from 0 to 1. triangles (F, 3, 2), sigma in pixels^2.

    Faces of either winding count. Where n faces lie over each other or side by side, a pixel on the
    border has 1 - 1/2^n. (SoftRas measures in ndc. Its sigma of 1e-5 there is 0.01 pixels^2 at
    64 x 64. Outside, it leaves out a face with D below 1e-4.)
    """
    found = soft_fragments(triangles, width, height, sigma)
    seen_by = np.logaddexp(0, signed_square(found, sigma))  # -log(1 - D)
    total = scatter(seen_by, found.pixel, width * height)
    return -np.expm1(-total).reshape(height, width)


def soft_silhouette_backward(grad_silhouette, triangles, sigma):
    """Backward of eq. (9): grad_silhouette (H, W) -> grad_triangles (F, 3, 2), exact."""
    height, width = grad_silhouette.shape
    found = soft_fragments(triangles, width, height, sigma)
    s = signed_square(found, sigma)
    total = scatter(np.logaddexp(0, s), found.pixel, width * height)
    # S = 1 - exp(-total), and total = sum log(1 + exp(s)): dS = exp(-total) D ds.
    probability = np.exp(-np.logaddexp(0, -s))
    grad_s = (grad_silhouette.ravel() * np.exp(-total))[found.pixel] * probability
    # ds = -2 sign / sigma away . ((1 - t) da + t db) for the edge's ends: t is at its best, or
    # fixed.
    grad_near = -2 * (grad_s * found.sign / sigma)[:, None] * found.away
    share = np.stack([1 - found.t, found.t], 1)
    corner = 3 * found.face[:, None] + np.array(EDGES)[found.edge]
    grad_corner = scatter(share[..., None] * grad_near[:, None], corner, 3 * len(triangles))
    return grad_corner.reshape(triangles.shape)
