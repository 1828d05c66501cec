"""How sure the albedo is: how much it changes over explanations that fit the pictures as well."""
import functools

import numpy as np

FACTORS = 1 / 2, 2 / 3, 3 / 2, 2  # of the lamp's strength: more paint in its light, or less
AS_WELL = 1.06  # times the least loss
STEPS = 60      # in which the paint of each explanation is found
DARKEST = 0.02  # the least light by which colours are divided


def doubt(labs, surface, targets, look):
    """The greatest change of albedo over lamps so much stronger or weaker that fit as well: the
    root of the mean square, as a share of the albedo's own, after one factor for all.

    The tint of the light is not among them: pictures say nothing of it.
    """
    lab = labs.intrinsic_decomposition
    observed, exposure = lab.observe(surface, targets)
    lit = labs.received_light.lit_share(surface, look.sun[0], look.near)
    observed = observed._replace(received=observed.received._replace(lit=lit))
    x = lab.allowed(look._replace(light=look.light / exposure, own=1.0, sun=np.stack(
        [look.sun[0], look.sun[1] / exposure])), observed.share)
    best, *others = [explained(lab, x, observed, factor) for factor in (1, *FACTORS)]
    least = min(loss for _, loss in (best, *others))
    return max((change(albedo, best[0], observed.share) for albedo, loss in others
                if loss <= AS_WELL * least), default=0.0)


def explained(lab, x, observed, factor):
    """The albedo that explains the colours in a lamp factor times as strong, and its loss."""
    other = x._replace(sun=np.stack([x.sun[0], factor * x.sun[1]]))
    before, after = (np.maximum(lab.shade_with_sun(
        each._replace(albedo=np.ones(x.albedo.shape)), observed.received), DARKEST)
        for each in (x, other))
    other = lab.allowed(other._replace(albedo=x.albedo * before / after), observed.share)
    gradient = functools.partial(lab.loss_and_gradients, observed=observed, priors=lab.PRIORS)
    held = lab.Appearance(*np.zeros(len(x)))._replace(albedo=lab.RATES.albedo)
    found = lab.search(other, gradient, lab.falling(held, STEPS), observed)
    return found.albedo, gradient(found)[0]


def change(albedo, best, share):
    """How far albedo (V, 3) is from the best, of which it is a multiple at best. share (V,)."""
    factor = (share @ (albedo * best)).sum() / (share @ albedo**2).sum()
    return np.sqrt((share @ (factor * albedo - best)**2).sum() / (share @ best**2).sum())


def in_words(number):
    """A sentence for the user."""
    return (f"other light, with albedo that differs by up to {100 * number:.0f} %, fits the "
            "pictures as well, and its tint is a guess: the greyest light that does")
