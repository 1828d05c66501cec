"""Intrinsic decomposition: the colours of a surface, separated into albedo and light.

    W c = C                                                colours c at vertices, C in pixels  (10)
    c = albedo * E,   E = sky sum_k Y_k(n) l_k + lit max(n . r, 0) / |r|^3 s + own bounce       (11)
    neutral = sum of (l_k - mean l_k)^2 and (s - mean s)^2    means are over the three colours (12)
    patches = mean of w t log(1 + |u_i - u_j| / t) / length,   u = log(albedo + 0.1) at an edge (13)

It begins where multi_view_fit.py ends: the shape is found, and stays. W are the weights of lab 5.
received_light.py says how a lamp, as near as a bulb or as far as the sun, and the surface itself
light the surface: lit, r, sky and bounce.

Pictures give the product of albedo and light alone. (12) and (13) choose among all pairs with this
product: most scenes have light with little colour, and paint in patches. In the dark, colours say
less of the albedo, so w is the square of the light around, at most 1. In bright light the model is
wrong by more, so errors count less. One factor is left free: we choose the mean albedo 1/2.

Sources: Munkberg et al. 2022 (12), Barron and Malik 2015 (13).
"""
import functools
from typing import NamedTuple

import numpy as np
import scipy.sparse.linalg

from course.given.arrays import scatter

from . import interpolation, pipeline, received_light, reconstruction, regularization
from .inverse_rendering import adam_step, descend, uniform_laplacian


class Appearance(NamedTuple):
    """How a surface looks, and in which light: albedo (V, 3), light (9, 3), and a lamp: sun (2, 3),
    the unit direction d towards it and its strength s for each colour, and near, its k.

    own multiplies bounce: it is 1, divided by what the mean albedo is of 1/2.
    """

    albedo: np.ndarray
    light: np.ndarray
    sun: np.ndarray
    near: float
    own: float


class Received(NamedTuple):
    """What eq. (11) knows of a Surface: lit, sky (V,), bounce (V, 3)."""

    surface: object
    lit: np.ndarray
    sky: np.ndarray
    bounce: np.ndarray


class Observed(NamedTuple):
    """What an Appearance is compared with: the colours (V, 3) that are seen, the share (V,) of the
    loss that each has, the Received, and the edges (E, 2) with their mean length and the weights
    (E,) of eq. (13).
    """

    colours: np.ndarray
    share: np.ndarray
    received: Received
    edges: np.ndarray
    length: float
    weight: np.ndarray


class Priors(NamedTuple):
    """How much (12) and (13) count beside the squared error of the colours, and t of (13)."""

    neutral: float
    patches: float
    border: float


PRIORS = Priors(neutral=0.01, patches=0.014, border=0.1)
RATES = Appearance(albedo=0.01, light=0.05, sun=0.05, near=0.01, own=0.0)
NO_SUN = RATES._replace(sun=0.0, near=0.0)
ADAM = functools.partial(adam_step, constants=(0.9, 0.99, 1e-8))
DARKEST = 0.005  # the least albedo
DARK = 0.1       # what eq. (13) adds to the albedo, so that nearly black is like black
SMOOTH = 0.02    # the step of log(albedo) that is too small to count
NO_BORDER = 10.0  # t of eq. (13) that makes it total variation: the mean of w |u_i - u_j|
ROUNDS = 8       # of means of neighbours, for the brightness around
BOUNCES = 3      # of light from surface to surface
STIFF = 0.01     # the weights of the Laplacian that fills in colours which no pixel sees
NEAREST = 0.5    # the greatest k: a lamp is 2 from the middle of the grid
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
    matrix = interpolation.interpolation_matrix(len(surface.vertices), surface.faces,
                                                seen.face_index, seen.barycentric)
    chosen = (seen.face_index >= 0) & inner(target.picture)
    return matrix[np.flatnonzero(chosen)], target.picture[chosen][:, :3]


def seen_colours(surface, targets):
    """Eq. (10) in the least squares -> colours (V, 3), and the sum of each one's weights in W (V,).

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
    rhs = sum(matrix.T @ colour for matrix, colour in zip(rows, colours, strict=True))
    return scipy.sparse.linalg.splu(system.tocsc()).solve(rhs), count


# --- paint in its light: eq. (11) ---------------------------------------------------------------


def shade_with_sun(x, received):
    """Eq. (11): the colours (V, 3) of an Appearance in what is Received."""
    surface, lit, sky, bounce = received
    share = lit * np.maximum(received_light.facing(x.sun[0], x.near, surface), 0)
    return (sky[:, None] * reconstruction.shade(x.albedo, surface.normals, x.light)
            + x.albedo * (np.outer(share, x.sun[1]) + x.own * bounce))


def shade_with_sun_backward(grad_colour, x, received):
    """Backward of `shade_with_sun`, all that is Received held: grad_colour (V, 3) -> an Appearance
    of gradients.
    """
    # c = a (sky Y l + f s + b), f = lit max(facing, 0): dc = E da + a (sky Y dl + f ds + s df).
    surface, lit, sky, bounce = received
    faced = received_light.facing(x.sun[0], x.near, surface)
    share = lit * np.maximum(faced, 0)
    grad_albedo, _, grad_light = reconstruction.shade_backward(
        sky[:, None] * grad_colour, x.albedo, surface.normals, x.light)
    grad_irradiance = grad_colour * x.albedo
    grad_facing = np.where(faced > 0, lit, 0) * (grad_irradiance @ x.sun[1])
    grad_towards, grad_near = received_light.facing_backward(grad_facing, x.sun[0], x.near, surface)
    return Appearance(
        grad_albedo + grad_colour * (np.outer(share, x.sun[1]) + x.own * bounce), grad_light,
        np.stack([grad_towards, share @ grad_irradiance]), grad_near, 0.0)


def add_sun(x):
    """An Appearance without a sun -> one where half of the light's first order comes from a sun."""
    # Of a sun in the direction d, eq. (2) makes l_1, l_2, l_3 = A_1 C1 (d_y, d_z, d_x) s.
    towards = x.light[[3, 1, 2]].mean(1)
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


def brightness_weights(colours, edges):
    """How much colours (V, 3), whose mean is 1/2, count in the brightness around them: the weights
    (V,) of their squared errors, and w (V,) of eq. (13).
    """
    around = colours.mean(1, keepdims=True)
    for _ in range(ROUNDS):
        around = around - uniform_laplacian(around, edges) / 2
    square = np.maximum(2 * around[:, 0], 0)**2
    return 2 / (1 + square), np.minimum(1, square)


def patches(albedo, edges, length, weight, border):
    """Eq. (13): how much paint changes along edges (E, 2) -> a number.

    albedo (V, 3), weight (E,). length is the mean of the edges'. So the number hardly depends on
    the mesh, and by the logarithm hardly on how bright all of the albedo is. border is t.
    SMOOTH rounds off the corner that |u_i - u_j| has at 0.
    """
    u, v = np.log(albedo + DARK)[edges.T]
    step = np.sqrt(((u - v)**2).sum(1) + SMOOTH**2)
    return (weight * border * np.log1p(step / border)).mean() / length


def patches_backward(grad_patches, albedo, edges, length, weight, border):
    """Backward of eq. (13): grad_patches, a number -> grad_albedo (V, 3)."""
    # A step s has the slope (u_i - u_j) / s, and t log(1 + s / t) the slope 1 / (1 + s / t): steps
    # that are small beside t have the slope 1, and a border nearly none. And du = da / (a + 0.1).
    u, v = np.log(albedo + DARK)[edges.T]
    step = np.sqrt(((u - v)**2).sum(1) + SMOOTH**2)
    slope = grad_patches / (len(edges) * length) * weight / (1 + step / border) / step
    grad = slope[:, None] * (u - v)
    return scatter(np.stack([grad, -grad], 1), edges, len(albedo)) / (albedo + DARK)


# --- the search ---------------------------------------------------------------------------------


def allowed(x, share):
    """The nearest Appearance that is allowed, with the mean albedo 1/2. share (V,) sums to 1."""
    albedo = np.maximum(x.albedo, DARKEST)
    factor = 0.5 / (share @ albedo).mean()
    towards = x.sun[0] / np.linalg.norm(x.sun[0])
    return Appearance(factor * albedo, x.light / factor,
                      np.stack([towards, np.maximum(x.sun[1], 0) / factor]),
                      np.clip(x.near, 0, NEAREST), x.own)


def loss_and_gradients(x, observed, priors):
    """The loss of an Appearance, and an Appearance of gradients."""
    colours, share, received, *along = observed
    error = shade_with_sun(x, received) - colours
    loss = (share @ error**2).sum() + priors.neutral * neutral(x.light, x.sun)
    loss += priors.patches * patches(x.albedo, *along, priors.border)

    grad = shade_with_sun_backward(2 * share[:, None] * error, x, received)
    by_paint = patches_backward(priors.patches, x.albedo, *along, priors.border)
    by_light, by_sun = neutral_backward(priors.neutral, x.light, x.sun)
    return loss, grad._replace(albedo=grad.albedo + by_paint, light=grad.light + by_light,
                               sun=grad.sun + by_sun)


def observe(surface, targets):
    """-> Observed, in the exposure where a light of 1 is usual, and this exposure, a number.

    All is lit. ValueError where no pixel of any picture lies within the object.
    """
    colours, count = seen_colours(surface, targets)
    if not count.any():
        raise ValueError("no pixel lies inside the object with all pixels around it, so nothing "
                         "tells its colours: give larger pictures")
    exposure = max(2 * (count @ colours).mean() / count.sum(), 1e-9)
    colours = colours / exposure
    edges = reconstruction.closed_mesh_edges(surface.faces)
    a, b = surface.vertices[edges.T]
    error_weight, prior_weight = brightness_weights(colours, edges)
    share = count * error_weight / (count @ error_weight)
    received = Received(surface, np.ones(len(colours)),
                        *received_light.surroundings(surface, colours))
    return Observed(colours, share, received, edges, np.linalg.norm(a - b, axis=1).mean(),
                    prior_weight[edges].mean(1)), exposure


def first_guess(observed):
    """The Appearance where the search begins: one colour, in even light, and no sun."""
    light = np.zeros((9, 3))
    light[0] = 1 / reconstruction.C0
    albedo = np.tile(observed.share @ observed.colours, (len(observed.colours), 1))
    return Appearance(albedo, light, np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]), 0.0, 1.0)


def falling(rates, steps):
    """A schedule for `descend`: an Appearance of learning rates for each step, down to 1/20."""
    return [Appearance(*(20**-(step / steps) * np.array(rates))) for step in range(steps)]


def search(x, gradient, schedule, observed):
    """The Appearance to which lab 9's `descend` comes from x."""
    project = functools.partial(allowed, share=observed.share)
    for found, _ in descend(x, gradient, schedule, ADAM, project):
        x = found
    return x


def search_in_shadow(x, observed, priors, schedule):
    """As `search`, in the shadow that the sun of x casts, anew every REFRESH steps."""
    mean = square = Appearance(0.0, 0.0, 0.0, 0.0, 0.0)
    for step, rate in enumerate(schedule):
        if step % REFRESH == 0:
            shadowed = in_shadow(observed, x)
        _, grad = loss_and_gradients(x, shadowed, priors)
        fields = zip(x, grad, mean, square, rate, strict=True)
        moved = [ADAM(a, g, m, s, step + 1, r) for a, g, m, s, r in fields]
        x, mean, square = (Appearance(*arrays) for arrays in zip(*moved, strict=True))
        x = allowed(x, observed.share)
    return x


def in_shadow(observed, x):
    """What is Observed, lit by the sun of an Appearance where this sun is seen."""
    lit = received_light.lit_share(observed.received.surface, x.sun[0], x.near)
    return observed._replace(received=observed.received._replace(lit=lit))


def decompose(surface, targets, priors=PRIORS, steps=800, with_sun=True):
    """The Appearance of a Surface in Targets, in the least loss that `steps` steps find.

    A quarter of the steps knows no sun. Then it begins where most light comes from, and moves.
    Albedo comes last: before, (13) is total variation, three times as strong, and w is 1.
    """
    observed, exposure = observe(surface, targets)
    first, last = steps // 4, steps // 3
    rates = RATES if with_sun else NO_SUN
    variation = priors._replace(patches=3 * priors.patches, border=NO_BORDER)
    unweighted = observed._replace(weight=np.ones(len(observed.edges)))
    gradient = functools.partial(loss_and_gradients, observed=unweighted, priors=variation)
    x = search(first_guess(observed), gradient, first * [NO_SUN], observed)
    x = add_sun(x) if with_sun else x
    schedule = falling(rates, steps - first)[:-last]
    x = search_in_shadow(x, unweighted, variation, schedule)
    slow = Appearance(*np.array(rates) / 10)._replace(albedo=rates.albedo)
    x = search_in_shadow(x, observed, priors, falling(slow, last))
    return rescaled(x, exposure)


def rescaled(x, exposure):
    """An Appearance as bright as the pictures are, its albedo at most 1, but for a few vertices
    that are cut off there.
    """
    factor = min(1.0, 1 / np.quantile(x.albedo, 0.999))
    brighter = exposure / factor
    return Appearance(np.minimum(factor * x.albedo, 1), brighter * x.light,
                      np.stack([x.sun[0], brighter * x.sun[1]]), x.near, x.own / factor)


def shaded_colours(surface, x):
    """The colours (V, 3) of a Surface in its Appearance x: eq. (11), with its shadow.

    What it sends to itself is as bright as its colours, which BOUNCES rounds find.
    """
    lit = received_light.lit_share(surface, x.sun[0], x.near)
    colours = np.zeros(x.albedo.shape)
    for _ in range(BOUNCES):
        colours = shade_with_sun(x, Received(surface, lit, *received_light.surroundings(
            surface, colours)))
    return colours
