"""The light that a surface receives: from a lamp, with its shadow, and from the surface itself.

    r = d - k p,   E = lit(p) max(n . r, 0) / |r|^3 s         at p, of a lamp at d / k          (11)
    F_j = area_j max(n . w, 0) max(-n_j . w, 0) / (|w|^2 (pi |w|^2 + area_j)),   w = p_j - p
    sky = 1 - sum_j F_j,   bounce = sum_j F_j c_j             what pieces j leave, and send

A lamp has the unit direction d, and the strength s in the grid's middle. It stands 1 / k away, and
with k = 0 it is the sun. It is a disc, seen from the middle under the angle SIZE. lit is the share
of it that reaches p, by lab 14's shadow maps from points of the disc.

Matt paint of the colour c sends as much to all sides. Which colours c a surface has is what
pictures show. So this light needs no unknown. F_j is the share of all that p sees which piece j
takes. Other pieces between the two are not looked for.

Sources: Williams 1978 (lit), Goral et al. 1984 (F_j).
"""
import numpy as np

from course.given import mesh, ray_casting

from . import lights, shadow_mapping, soft_shadows

MAP = 256        # texels along a side of a lamp's map
BIAS = 0.01      # of lab 14's eq. (5)
AROUND = np.stack(np.meshgrid([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]), -1).reshape(-1, 2)
FAR = 1e-3       # the least k of a lamp whose map is a cone
SIZE = 0.1       # the radius of a lamp's disc, where its distance is 1
DISC = ray_casting.disc_offsets(8)
PIECES = 1000    # of a surface, which send light
TOGETHER = 1000  # vertices at a time, so that little memory is needed

# --- from a lamp: eq. (11) ------------------------------------------------------------------------


def facing(towards, near, surface):
    """n . r / |r|^3 of eq. (11): how bright is a lamp of strength 1 at each vertex? -> (V,).

    towards (3,) is d, near is k. It is less than 0 where the Surface faces away.
    """
    r = towards - near * surface.vertices
    return (surface.normals * r).sum(1) / np.linalg.norm(r, axis=1)**3


def facing_backward(grad_facing, towards, near, surface):
    """Backward of `facing`, the shape held: grad_facing (V,) -> grad_towards (3,), grad_near."""
    # d(n . r / |r|^3) = (n - 3 n . r / |r|^2 r) / |r|^3 . dr, and dr = dd - p dk.
    r = towards - near * surface.vertices
    square = (r**2).sum(1, keepdims=True)
    along = (surface.normals * r).sum(1, keepdims=True) / square
    grad_r = grad_facing[:, None] * (surface.normals - 3 * along * r) / square**1.5
    return grad_r.sum(0), -(grad_r * surface.vertices).sum()


def lit_share(surface, towards, near):
    """lit of eq. (11): which share of a lamp reaches each vertex? -> (V,), from 0 to 1."""
    across = SIZE * DISC @ lights.axes_of(towards)[:2]
    return np.mean([lit_from(surface, towards + step, near) for step in across], 0)


def lit_from(surface, towards, near):
    """Does light from one point of a lamp reach the vertices? -> (V,), lab 14's PCF over 3 x 3."""
    vertices, faces, normals = surface.vertices, surface.faces, surface.normals
    light = (lights.point_light(towards / near, vertices) if near > FAR
             else lights.directional_light(-towards, vertices))
    distance_map = shadow_mapping.depth_map(vertices, faces, light, MAP)
    on_map = soft_shadows.receivers(vertices, normals, light, MAP)
    bias = np.minimum(BIAS + np.abs(on_map.slope).sum(1) / 2, 5 * BIAS)
    return soft_shadows.percentage_closer(distance_map, *on_map, bias, AROUND, 1.0)


# --- from the surface itself: F_j -----------------------------------------------------------------


def surroundings(surface, colours):
    """What the Surface hides of the rest, and sends instead: sky (V,), bounce (V, 3).

    colours (V, 3) are its own.
    """
    chosen, area = pieces(surface)
    corners = surface.faces[chosen]
    centres = surface.vertices[corners].mean(1)
    sent = colours[corners].mean(1)
    normals = mesh.face_normals(surface.vertices, surface.faces)[chosen]
    hidden = np.empty(len(colours))
    bounce = np.empty(colours.shape)
    for first in range(0, len(colours), TOGETHER):
        part = slice(first, first + TOGETHER)
        factors = form_factors(surface.vertices[part], surface.normals[part], centres, normals,
                               area)
        hidden[part], bounce[part] = factors.sum(1), factors @ sent
    # Pieces one behind the other may hide more than all there is.
    most = np.maximum(hidden, 1)
    return 1 - hidden / most, bounce / most[:, None]


def pieces(surface):
    """PIECES faces that stand for parts of equal area: their indices, and this area."""
    sums = np.linalg.norm(mesh.area_vectors(surface.vertices, surface.faces), axis=1).cumsum() / 2
    return np.searchsorted(sums, sums[-1] * (np.arange(PIECES) + 0.5) / PIECES), sums[-1] / PIECES


def form_factors(points, normals, centres, piece_normals, area):
    """F_j: points, normals (N, 3), and pieces of equal area: centres, normals (J, 3) -> (N, J)."""
    # n . w = n . p_j - n . p, and so on: products of matrices, without w itself.
    leaving = normals @ centres.T - (normals * points).sum(1, keepdims=True)
    arriving = points @ piece_normals.T - (piece_normals * centres).sum(1)
    square = ((points**2).sum(1, keepdims=True) + (centres**2).sum(1) - 2 * points @ centres.T)
    square = np.maximum(square, 1e-9)
    return (area * np.maximum(leaving, 0) * np.maximum(arriving, 0)
            / (square * (np.pi * square + area)))
