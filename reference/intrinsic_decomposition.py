"""Intrinsic decomposition: the colours of a surface, told apart into albedo and light.

    W c = C                                                colours c at vertices, C in pixels  (10)
    c = albedo * E,   E(n, p) = sum_k Y_k(n) l_k + lit(p) max(n . d, 0) s           with a sun (11)
    neutral = sum of (l_k - mean l_k)^2, and of s alike    each mean is over the three colours (12)
    patches = mean of w sqrt(|u_i - u_j|^2 + e^2) / length, u = log(albedo + 0.1)  at an edge  (13)

It begins where multi_view_fit.py ends: the shape is found, and stays. W are the weights of lab 5.
The sun is an array (2, 3): the unit direction d towards it, and its strength s for each colour. lit
is the share of it that reaches p, by lab 14's shadow map of the shape itself.

Pictures give the product of albedo and light alone. (12) and (13) choose among all pairs with this
product. Light with little colour and paint in patches is what most scenes have. In shade, colours
tell less, as the square of the light. So does (13) by its weight w. What is left free is one
factor. We choose the mean albedo 1/2.

Sources: Munkberg et al. 2022 (12), Barron and Malik 2015 (13), Williams 1978 (lit).
"""
import functools
import itertools
from typing import NamedTuple

import numpy as np
import scipy.sparse.linalg

from . import (
    interpolation,
    lights,
    pipeline,
    reconstruction,
    regularization,
    shadow_mapping,
    soft_shadows,
)
from .arrays import scatter
from .inverse_rendering import adam_step, descend, uniform_laplacian


class Appearance(NamedTuple):
    """How a surface looks, and in which light: albedo (V, 3), light (9, 3), sun (2, 3)."""

    albedo: np.ndarray
    light: np.ndarray
    sun: np.ndarray


class Observed(NamedTuple):
    """What an Appearance is compared with: the colours (V, 3) that are seen, the share (V,) of the
    loss that each has, the normals (V, 3), and the edges (E, 2) with their mean length and the
    weights (E,) of eq. (13).
    """

    colours: np.ndarray
    share: np.ndarray
    normals: np.ndarray
    edges: np.ndarray
    length: float
    weight: np.ndarray


class Priors(NamedTuple):
    """How much (12) and (13) count beside the squared error of the colours."""

    neutral: float
    patches: float


PRIORS = Priors(neutral=0.01, patches=0.007)
RATES = Appearance(albedo=0.01, light=0.05, sun=0.05)
ADAM = functools.partial(adam_step, constants=(0.9, 0.99, 1e-8))
DARKEST = 0.005  # the least albedo
DARK = 0.1       # what eq. (13) adds to the albedo, so that nearly black is like black
SMOOTH = 0.02    # e of eq. (13)
ROUNDS = 8       # of means of neighbours, for its w
STIFF = 0.01     # of the colours, where no pixel tells them
MAP = 256        # texels along a side of the sun's map
BIAS = 0.01      # of lab 14's eq. (5)
AROUND = np.stack(np.meshgrid([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]), -1).reshape(-1, 2)
REFRESH = 20     # steps with one shadow map

# --- the colours that the pictures show: eq. (10) -----------------------------------------------


def inner(picture):
    """The pixels (H, W) of a picture (H, W, 4) that are covered, with all pixels around them."""
    covered = np.pad(picture[..., 3] > 0.99, 1)
    return np.lib.stride_tricks.sliding_window_view(covered, (3, 3)).all((2, 3))


def pixel_weights(surface, target):
    """W (N, V) of eq. (10) for the inner pixels of a Target, and their colours C (N, 3)."""
    height, width, _ = target.picture.shape
    clip = pipeline.to_clip(surface.vertices, target.view.clip_from_model)
    seen = pipeline.visible(clip, surface.faces, width, height)
    weights = interpolation.weight_rows(surface.faces, seen.face_index, seen.barycentric)
    chosen = (seen.face_index >= 0) & inner(target.picture)
    matrix = interpolation.sparse_matrix(len(surface.vertices), *weights)
    return matrix[np.flatnonzero(chosen)], target.picture[chosen][:, :3]


def seen_colours(surface, targets):
    """Eq. (10) in the least squares -> colours (V, 3), and how many pixels tell of each (V,).

    surface is a Surface, targets are Targets of multi_view_fit. Vertices that no pixel sees take
    the colours around them.
    """
    # |W c - C|^2 is least where W^T W c = W^T C. A weak Laplacian makes it solvable in each piece
    # that is seen, and next to nothing at each vertex makes the others black.
    rows, colours = zip(*(pixel_weights(surface, target) for target in targets), strict=True)
    count = sum(matrix.sum(0) for matrix in rows)
    edges = reconstruction.closed_mesh_edges(surface.faces)
    stiff = regularization.laplacian(edges, np.full(len(edges), STIFF), len(surface.vertices))
    nothing = 1e-9 * scipy.sparse.eye_array(len(surface.vertices))
    system = sum(matrix.T @ matrix for matrix in rows) + stiff + nothing
    told = sum(matrix.T @ colour for matrix, colour in zip(rows, colours, strict=True))
    return scipy.sparse.linalg.splu(system.tocsc()).solve(told), count


# --- light with a sun: eq. (11) -----------------------------------------------------------------


def lit_share(surface, sun):
    """lit of eq. (11): which share of the sun reaches each vertex? -> (V,), from 0 to 1.

    It is lab 14's PCF over 3 x 3 texels.
    """
    vertices, faces, normals = surface.vertices, surface.faces, surface.normals
    light = lights.directional_light(-sun[0], vertices)
    distance_map = shadow_mapping.depth_map(vertices, faces, light, MAP)
    on_map = shadow_mapping.receivers(vertices, normals, light, MAP)
    bias = shadow_mapping.slope_scaled_bias(on_map.slope, BIAS, 1.0, 5 * BIAS)
    return soft_shadows.percentage_closer(distance_map, *on_map, bias, AROUND, 1.0)


def shade_with_sun(x, normals, lit):
    """Eq. (11): the colours (V, 3) of an Appearance. normals (V, 3), lit (V,)."""
    share = lit * np.maximum(normals @ x.sun[0], 0)
    return reconstruction.shade(x.albedo, normals, x.light) + x.albedo * np.outer(share, x.sun[1])


def shade_with_sun_backward(grad_colour, x, normals, lit):
    """Backward of `shade_with_sun`, the shape and its shadow held: grad_colour (V, 3) -> an
    Appearance of gradients.
    """
    # c = a (Y l + f s), f = lit max(n . d, 0), so dc = E da + a (Y dl + f ds + s df), and
    # df = lit n . dd where the surface faces the sun.
    cosine = normals @ x.sun[0]
    share = lit * np.maximum(cosine, 0)
    grad_albedo, _, grad_light = reconstruction.shade_backward(grad_colour, x.albedo, normals,
                                                               x.light)
    grad_irradiance = grad_colour * x.albedo
    grad_cosine = np.where(cosine > 0, lit, 0) * (grad_irradiance @ x.sun[1])
    grad_sun = np.stack([grad_cosine @ normals, share @ grad_irradiance])
    return Appearance(grad_albedo + grad_colour * np.outer(share, x.sun[1]), grad_light, grad_sun)


def add_sun(x):
    """An Appearance without a sun -> one where half of the light's first order comes from a sun."""
    # Of a sun in the direction d, eq. (2) makes l_1, l_2, l_3 = A_1 C1 (d_y, d_z, d_x) s.
    y, z, x_axis = x.light[1:4].mean(1)
    towards = np.array([x_axis, y, z])
    length = np.linalg.norm(towards)
    towards = towards / length if length > 0 else np.array([0.0, 1.0, 0.0])
    strength = np.full(3, length / (2 * reconstruction.A[1] * reconstruction.C1))
    light = x.light - reconstruction.distant_light(towards[None], strength[None])
    return x._replace(light=light, sun=np.stack([towards, strength]))


# --- what most scenes are like: eq. (12) and (13) -----------------------------------------------


def neutral(light, sun):
    """Eq. (12): how much colour the light has: light (9, 3), sun (2, 3) -> a number."""
    lamps = np.vstack([light, sun[1]])
    return ((lamps - lamps.mean(1, keepdims=True))**2).sum()


def neutral_backward(grad_neutral, light, sun):
    """Backward of eq. (12): grad_neutral, a number -> grad_light (9, 3), grad_sun (2, 3)."""
    # Differences from a mean sum to 0. So what the mean itself hands back is 0, too.
    lamps = np.vstack([light, sun[1]])
    grad = 2 * grad_neutral * (lamps - lamps.mean(1, keepdims=True))
    return grad[:9], np.stack([np.zeros(3), grad[9]])


def edge_weights(colours, edges):
    """w (E,) of eq. (13) at edges (E, 2): 1, or the square of twice the brightness around.

    colours (V, 3), whose mean is 1/2. The squared error of dark colours says as little of paint.
    """
    around = colours.mean(1, keepdims=True)
    for _ in range(ROUNDS):
        around = around - uniform_laplacian(around, edges) / 2
    return np.minimum(1, (2 * around)**2)[edges, 0].mean(1)


def patches(albedo, edges, length, weight):
    """Eq. (13): how much paint changes along edges (E, 2) -> a number.

    albedo (V, 3), weight (E,). length is the mean of the edges'. So the number hardly depends on
    the mesh, and by the logarithm hardly on how bright all of the albedo is.
    """
    u, v = np.log(albedo + DARK)[edges.T]
    return (weight * np.sqrt(((u - v)**2).sum(1) + SMOOTH**2)).mean() / length


def patches_backward(grad_patches, albedo, edges, length, weight):
    """Backward of eq. (13): grad_patches, a number -> grad_albedo (V, 3)."""
    # The root r has the slope (u_i - u_j) / r: it pulls alike at a small step and at a large one.
    # And du = da / (a + 0.1).
    u, v = np.log(albedo + DARK)[edges.T]
    root = np.sqrt(((u - v)**2).sum(1, keepdims=True) + SMOOTH**2)
    grad = grad_patches / (len(edges) * length) * weight[:, None] * (u - v) / root
    return scatter(np.stack([grad, -grad], 1), edges, len(albedo)) / (albedo + DARK)


# --- the search ---------------------------------------------------------------------------------


def allowed(x, share):
    """The nearest Appearance that is allowed, with the mean albedo 1/2. share (V,) sums to 1."""
    albedo = np.maximum(x.albedo, DARKEST)
    factor = 0.5 / (share @ albedo).mean()
    towards = x.sun[0] / np.linalg.norm(x.sun[0])
    return Appearance(factor * albedo, x.light / factor,
                      np.stack([towards, np.maximum(x.sun[1], 0) / factor]))


def loss_and_gradients(x, observed, lit, priors):
    """The loss of an Appearance, and an Appearance of gradients. lit (V,) is held."""
    colours, share, normals, *along = observed
    error = shade_with_sun(x, normals, lit) - colours
    loss = (share @ error**2).sum() + priors.neutral * neutral(x.light, x.sun)
    loss += priors.patches * patches(x.albedo, *along)

    grad = shade_with_sun_backward(2 * share[:, None] * error, x, normals, lit)
    by_paint = patches_backward(priors.patches, x.albedo, *along)
    by_light, by_sun = neutral_backward(priors.neutral, x.light, x.sun)
    return loss, Appearance(grad.albedo + by_paint, grad.light + by_light, grad.sun + by_sun)


def observe(surface, targets):
    """-> Observed, in the exposure where a light of 1 is usual, and this exposure, a number.

    ValueError where no pixel of any picture lies within the object.
    """
    colours, count = seen_colours(surface, targets)
    if not count.any():
        raise ValueError("no pixel lies inside the object with all pixels around it, so nothing "
                         "tells its colours: give larger pictures")
    share = count / count.sum()
    exposure = max(2 * (share @ colours).mean(), 1e-9)
    edges = reconstruction.closed_mesh_edges(surface.faces)
    a, b = surface.vertices[edges.T]
    length = np.linalg.norm(a - b, axis=1).mean()
    colours = colours / exposure
    return Observed(colours, share, surface.normals, edges, length,
                    edge_weights(colours, edges)), exposure


def first_guess(observed):
    """The Appearance where the search begins: one colour, in even light, and no sun."""
    light = np.zeros((9, 3))
    light[0] = 1 / reconstruction.C0
    albedo = np.tile(observed.share @ observed.colours, (len(observed.colours), 1))
    return Appearance(albedo, light, np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]))


def gradient_in_shadow(surface, observed, priors):
    """-> gradient(x), as lab 9's `descend` takes it. Every REFRESH steps it casts a new shadow."""
    lit = np.empty(len(surface.vertices))
    step = itertools.count()

    def gradient(x):
        if next(step) % REFRESH == 0:
            lit[:] = lit_share(surface, x.sun)
        return loss_and_gradients(x, observed, lit, priors)
    return gradient


def falling(rates, steps):
    """A schedule for `descend`: an Appearance of learning rates for each step, down to 1/20."""
    return [Appearance(*(20**-(step / steps) * np.array(rates))) for step in range(steps)]


def search(x, gradient, schedule, observed):
    """The Appearance to which lab 9's `descend` comes from x."""
    project = functools.partial(allowed, share=observed.share)
    for found, _ in descend(x, gradient, schedule, ADAM, project):
        x = found
    return x


def decompose(surface, targets, priors=PRIORS, steps=800, with_sun=True):
    """The Appearance of a Surface in Targets, in the least loss that `steps` steps find.

    A quarter of the steps knows no sun. Then it rises where the light comes from, and moves.
    """
    observed, exposure = observe(surface, targets)
    no_sun = RATES._replace(sun=0.0)
    first = steps // 4
    rest = steps - first
    even = functools.partial(loss_and_gradients, observed=observed,
                             lit=np.ones(len(surface.vertices)), priors=priors)
    x = search(first_guess(observed), even, first * [no_sun], observed)
    if with_sun:
        shadowed = gradient_in_shadow(surface, observed, priors)
        x = search(add_sun(x), shadowed, falling(RATES, rest), observed)
    else:
        x = search(x, even, falling(no_sun, rest), observed)
    return rescaled(x, exposure)


def rescaled(x, exposure):
    """An Appearance as bright as the pictures are, its albedo at most 1, but for a few vertices
    that are cut off there.
    """
    factor = min(1.0, 1 / np.quantile(x.albedo, 0.999))
    brighter = exposure / factor
    return Appearance(np.minimum(factor * x.albedo, 1), brighter * x.light,
                      np.stack([x.sun[0], brighter * x.sun[1]]))


def shaded_colours(surface, x):
    """The colours (V, 3) of a Surface in its Appearance x: eq. (11), with its shadow."""
    return shade_with_sun(x, surface.normals, lit_share(surface, x.sun))
