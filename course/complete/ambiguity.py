"""Ambiguity: how sure an albedo is, and whether the light could be what the fit takes it for.

Pictures give the product of albedo and light alone. Other light, with other paint, fits them as
well, and how far that paint differs says how sure the albedo is. A light that turns with the
camera, as before a turntable, fits no fixed one: points are brighter on one side of all pictures.
"""
import functools

import numpy as np

from . import received_light
from .intrinsic_decomposition import (
    PRIORS,
    RATES,
    Appearance,
    allowed,
    falling,
    loss_and_gradients,
    observe,
    pixel_weights,
    search,
    shade_with_sun,
)

FACTORS = 1 / 2, 2 / 3, 3 / 2, 2  # of all light that is not from all sides alike
AS_WELL = 1.06      # times the least loss; chosen on captures whose albedo is known
REPAINT = 60        # steps in which the paint of each explanation is found
LEAST_LIGHT = 0.02  # by which colours are divided

# --- other light that fits as well ---------------------------------------------------------------


def doubt(surface, targets, look):
    """The greatest change of albedo over light that is more even, or less, and fits as well: the
    root of the mean square, as a share of the albedo's own, after one factor for all.

    The tint of the light is not among them: pictures say nothing of it.
    """
    observed, exposure = observe(surface, targets)
    lit = received_light.lit_share(surface, look.sun[0], look.near)
    observed = observed._replace(received=observed.received._replace(lit=lit))
    x = allowed(look._replace(light=look.light / exposure, own=1.0, sun=np.stack(
        [look.sun[0], look.sun[1] / exposure])), observed.share)
    best, *others = [explained(x, observed, factor) for factor in (1, *FACTORS)]
    least = min(loss for _, loss in (best, *others))
    return max((change(albedo, best[0], observed.share) for albedo, loss in others
                if loss <= AS_WELL * least), default=0.0)


def explained(x, observed, factor):
    """The albedo that explains the colours in light whose lamp and l_1 to l_8 are multiplied by a
    factor, and its loss.
    """
    other = x._replace(light=np.vstack([x.light[:1], factor * x.light[1:]]),
                       sun=np.stack([x.sun[0], factor * x.sun[1]]))
    before, after = (np.maximum(shade_with_sun(
        each._replace(albedo=np.ones(x.albedo.shape)), observed.received), LEAST_LIGHT)
        for each in (x, other))
    other = allowed(other._replace(albedo=x.albedo * before / after), observed.share)
    gradient = functools.partial(loss_and_gradients, observed=observed, priors=PRIORS)
    held = Appearance(*np.zeros(len(x)))._replace(albedo=RATES.albedo)
    found = search(other, gradient, falling(held, REPAINT), observed)
    return found.albedo, gradient(found)[0]


def change(albedo, best, share):
    """How far albedo (V, 3) is from the best, of which it is a multiple at best. share (V,)."""
    factor = (share @ (albedo * best)).sum() / max((share @ albedo**2).sum(), 1e-300)
    return np.sqrt((share @ (factor * albedo - best)**2).sum() / (share @ best**2).sum())


# --- a light that turns -------------------------------------------------------------------------


def turning(surface, targets, colours):
    """How much brighter than in other Targets points are where they face one side of the picture.

    colours (V, 3) are those of eq. (10). A picture has these times 1 + b . n, in the least squares,
    where n are normals in the camera's axes. -> the length of b.
    """
    square = np.zeros((3, 3))
    product = np.zeros(3)
    for target in targets:
        weights, seen = pixel_weights(surface, target)
        usual = (weights @ colours).mean(1)
        axes = target.view.clip_from_model[[0, 1, 3], :3]
        axes = axes / np.linalg.norm(axes, axis=1, keepdims=True)
        shift = usual[:, None] * (weights @ surface.normals @ axes.T)
        square += shift.T @ shift
        product += shift.T @ (seen.mean(1) - usual)
    return np.linalg.norm(np.linalg.lstsq(square, product, rcond=None)[0])
