"""Numeric derivatives: central differences in a sweep of steps, and how near they are.

Along a direction d, with steps h,

    D(h) = (L(x + h d) - L(x - h d)) / 2h = L' + O(h^2)        central difference         (1)
    E(h) = (16 D(h) - D(4h)) / 15         = L' + O(h^4)        Richardson extrapolation   (2)

A large h suffers from the powers of h that are left out, a small one from rounding, which grows as
1/h. Between them lies a plateau. So the steps are swept, each a quarter of the last, and the
numeric derivative is E where two successive E agree best. The analytic gradient has no say in this
choice.

    error = |analytic - numeric| / max(|analytic|, |numeric|, floor)                      (3)
"""
from typing import NamedTuple

import numpy as np

RTOL = 1e-6                       # the largest error (3) that passes
STEPS = 4.0 ** -np.arange(3, 12)  # 1.6e-2 to 2.4e-7 of `magnitude`; smaller ones are all rounding
SETTLED = 1e-9                    # two successive E as close as this end the sweep
FLOOR = 1e-3                      # of the largest number, see `relative_error`
ELEMENTS = 60                     # of each input are looked at one by one, all if it has no more
DIRECTIONS = 3                    # random ones: for each input alone, then for all together


class Part(NamedTuple):
    """Numbers that are judged together: an input's elements, or slopes along random directions."""

    title: str
    analytic: np.ndarray
    numeric: np.ndarray  # of the same shape; NaN where left out or not looked at
    probes: dict         # index of each number looked at -> (moves, scale), see `sweep`

    def measure(self, slope):
        for index, (moves, scale) in self.probes.items():
            self.numeric[index] = sweep(slope, moves, scale)[0]

    def left_out(self):
        return sum(bool(np.isnan(self.numeric[index])) for index in self.probes)

    def error(self):
        return relative_error(self.analytic, self.numeric)

    def off(self):
        """Which numbers are wrong: bool, of the same shape."""
        return self.error() > RTOL

    def worst(self):
        return np.unravel_index(np.nanargmax(self.error()), self.numeric.shape)


def element_part(title, position, x, gradient, rng):
    """An input's elements, one by one.

    A random choice of a large input is looked at. Half of it has a gradient other than zero,
    because a picture touches few texels of its texture.
    """
    order = rng.permutation(x.size)
    touched = order[gradient.flat[order] != 0][:ELEMENTS // 2]
    chosen = list(dict.fromkeys([*touched, *order[:ELEMENTS]]))[:ELEMENTS]
    scale = magnitude(x)
    probes = {}
    for index in (np.unravel_index(k, x.shape) for k in sorted(chosen)):
        direction = np.zeros(x.shape)
        direction[index] = 1.0
        probes[index] = {position: direction}, scale[index]
    return Part(title, gradient, np.full(x.shape, np.nan), probes)


def direction_part(title, gradients, inputs, rng):
    """Slopes along random directions, in which all elements of some inputs move at once."""
    slopes = np.zeros(DIRECTIONS)
    probes = {}
    for n in range(DIRECTIONS):
        moves = {k: rng.standard_normal(gradient.shape) * magnitude(inputs[k])
                 for k, gradient in gradients.items()}
        slopes[n] = sum(np.vdot(gradients[k], moves[k]) for k in moves)
        probes[(n,)] = moves, 1.0
    return Part(f"{title}, random direction", slopes, np.full(DIRECTIONS, np.nan), probes)


def magnitude(x):
    """x (...) -> (...): an element's own size or the median size, the larger, as a power of two.

    The steps are powers of two as well, so x + h and x - h are exact.
    """
    sizes = np.abs(x)
    typical = np.median(sizes[sizes > 0]) if sizes.any() else 1.0
    return np.ldexp(1.0, np.frexp(np.maximum(sizes, typical))[1])


@np.errstate(all="ignore")  # a large step may leave forward's domain; the sweep goes on
def sweep(slope, moves, scale, settled=SETTLED):
    """-> the numeric derivative, D (S,) at the S steps scale * STEPS, how much E changes (S - 2,).

    D is NaN where a step is not usable or was not needed. The derivative is NaN, left out, where no
    two successive E are finite.
    """
    D = np.full(len(STEPS), np.nan)
    for k, step in enumerate(STEPS):
        D[k] = slope(moves, scale * step)
        E = (16 * D[1:] - D[:-1]) / 15
        change = np.abs(np.diff(E))
        if k >= 2 and change[k - 2] <= settled * abs(E[k - 1]):
            break
    numeric = E[np.nanargmin(change) + 1] if np.isfinite(change).any() else np.nan
    return numeric, D, change


def relative_error(analytic, numeric):
    """Eq. (3), with the floor at FLOOR times the largest number of both arrays.

    Rounding disturbs all numeric derivatives with respect to one input about equally, by some
    1e-12 of the largest. In a tiny element it may be all there is to see. So no element is judged
    more finely than rtol * FLOOR of the largest, which is 1e-9 at the default rtol.
    """
    size = np.fmax(np.abs(analytic), np.abs(numeric))
    floor = max(FLOOR * np.max(size, initial=0.0), np.finfo(float).tiny)
    return np.abs(analytic - numeric) / np.maximum(size, floor)
