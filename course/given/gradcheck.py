"""Gradient check: is a backward pass, derived by hand, the derivative of its forward pass?

The loss is L = sum(upstream * forward(...)), so backward(upstream, ...) must return its gradients.
The upstream gradient is random: with all ones, a backward that averages or misplaces its
grad_output would pass. Along a direction d, with steps h,

    D(h) = (L(x + h d) - L(x - h d)) / 2h = L' + O(h^2)        central difference         (1)
    E(h) = (16 D(h) - D(4h)) / 15         = L' + O(h^4)        Richardson extrapolation   (2)

A large h suffers from the powers of h that are left out, a small one from rounding, which grows as
1/h. Between them lies a plateau. So the steps are swept, each a quarter of the last, and the
numeric derivative is E where two successive E agree best. The analytic gradient has no say in this
choice.

    error = |analytic - numeric| / max(|analytic|, |numeric|, floor)                      (3)
"""
import copy
import inspect
import io
from typing import NamedTuple

import numpy as np

from . import places
from .contract import called, unchanged

STEPS = 4.0 ** -np.arange(3, 12)  # 1.6e-2 to 2.4e-7 of `magnitude`; smaller ones are all rounding
SETTLED = 1e-9                    # two successive E as close as this end the sweep
FLOOR = 1e-3                      # of the largest number, see `relative_error`
ELEMENTS = 60                     # of each input are looked at one by one, all if it has no more
DIRECTIONS = 3                    # random ones: for each input alone, then for all together
LEFT_OUT_LIMIT = 0.10             # a check that leaves out a larger share says too little


class GradReport(NamedTuple):
    """What a passed check looked at: numbers checked, numbers left out, the largest error (3)."""

    checked: int
    left_out: int
    worst_error: float


class GradientMismatch(AssertionError):
    """A gradient is wrong, or could not be checked: which, where and how. picture: path or None."""

    def __init__(self, sentence, picture=None):
        super().__init__(sentence)
        self.picture = picture


class Part(NamedTuple):
    """Numbers that are judged together: an input's elements, or slopes along random directions."""

    title: str
    analytic: np.ndarray
    numeric: np.ndarray  # of the same shape; NaN where left out or not looked at
    probes: dict         # index of each number looked at -> (moves, scale), see `sweep`

    def left_out(self):
        return sum(bool(np.isnan(self.numeric[index])) for index in self.probes)

    def error(self):
        return relative_error(self.analytic, self.numeric)

    def worst(self):
        return np.unravel_index(np.nanargmax(self.error()), self.numeric.shape)


def gradcheck(forward, backward, inputs, *, seed=0, differentiable=None, decisions=None, rtol=1e-6,
              name="gradcheck"):
    """Compare the gradients that backward returns with central differences of forward, in float64.

    forward(*inputs) -> an array, or a tuple of arrays.
    backward(grad_output, *inputs) -> one gradient for each differentiable input, in order. Where
        forward returns a tuple, backward takes one grad_output for each of its arrays.
    inputs: a tuple of arrays and other things. They are copied, and floats become float64.
    differentiable: positions of the inputs to check. If None, every float and array of floats.
    decisions(*inputs) -> an array, or a tuple of arrays: what the forward pass decides (which
        face, which texel). The loss may jump or bend where a decision changes, so a step that
        changes one is not used. What has no three usable steps in a row is left out and counted.
    rtol: the largest error (3) that passes.
    name: what is checked. It opens every message, and outside of pytest it names the picture.

    -> GradReport. Raises GradientMismatch where a gradient is wrong, zero everywhere, not
    finite, of the wrong shape or missing, where forward or backward changes its arguments, and
    where more than LEFT_OUT_LIMIT of an input's elements were left out. (Directions do not count
    here: one element on an edge spoils them all.) ValueError where nothing can be differentiated.
    """
    titles, inputs = prepare(forward, inputs, differentiable, name)
    rng = np.random.default_rng(seed)
    upstream = [rng.standard_normal(y.shape) for y in call(forward, inputs, f"{name}: forward")]
    gradients = gradients_of(backward, upstream, inputs, titles, name)

    parts = [element_part(titles[k], k, inputs[k], gradients[k], rng) for k in titles]
    parts += [direction_part(titles[k], {k: gradients[k]}, inputs, rng) for k in titles]
    if len(titles) > 1:
        parts += [direction_part("all inputs together", gradients, inputs, rng)]
    slope = slope_of_loss(forward, decisions, inputs, upstream)
    for part in parts:
        for index, (moves, scale) in part.probes.items():
            part.numeric[index] = sweep(slope, moves, scale)[0]
    return verdict(parts[:len(titles)], parts[len(titles):], slope, rtol, name, seed)


# --- what comes in, what comes back -----------------------------------------------------------


def prepare(forward, inputs, differentiable, name):
    """-> titles {position: 'input 1 (uv)'} of what is to be differentiated, the inputs' copies."""
    if not isinstance(inputs, tuple | list):
        raise ValueError(f"{name}: inputs must be a tuple, such as (x,), not {type(inputs)}")
    if differentiable is None:
        differentiable = [k for k, x in enumerate(inputs)
                          if isinstance(x, float | np.floating | np.ndarray)
                          and np.result_type(x).kind == "f"]
    titles = {k: title_of(forward, k) for k in differentiable}
    inputs = [np.array(x, float)[()] if k in titles else copy.deepcopy(x)
              for k, x in enumerate(inputs)]
    if not titles or not all(np.isfinite(inputs[k]).all() for k in titles):
        raise ValueError(f"{name}: gradcheck expects floats or arrays of floats, all finite; "
                         f"it was given {', '.join(titles.values()) or 'none'}")
    return titles, inputs


def title_of(forward, position):
    """'input 1 (uv)', or 'input 1' where forward does not name its parameters."""
    try:
        return f"input {position} ({list(inspect.signature(forward).parameters)[position]})"
    except (ValueError, TypeError, IndexError):
        return f"input {position}"


def gradients_of(backward, upstream, inputs, titles, name):
    """-> {position: analytic gradient}, once their number and shapes are right."""
    gradients = call(backward, [*upstream, *inputs], f"{name}: backward")
    if len(gradients) == 1 < len(titles) and gradients[0].shape[:1] == (len(titles),):
        gradients = list(gradients[0])  # they came as a list, which has become one array
    require(len(gradients) == len(titles), f"{name}: backward must return {len(titles)} gradients, "
            f"with respect to {', '.join(titles.values())}; it returned {len(gradients)}")
    for k, gradient in zip(titles, gradients, strict=True):
        require(gradient.shape == inputs[k].shape, f"{name}: the gradient with respect to "
                f"{titles[k]} must have that input's shape {inputs[k].shape}; it has "
                f"{gradient.shape}")
    return dict(zip(titles, gradients, strict=True))


def require(condition, sentence):
    if not condition:
        raise GradientMismatch(sentence)


def arrays(result):
    """One array, or a tuple of them -> a list of float64 copies."""
    return [np.array(y, float) for y in (result if isinstance(result, tuple) else [result])]


def call(function, arguments, who):
    """The arrays that function(*arguments) returns, or a sentence on why they are of no use."""
    before = copy.deepcopy(arguments)
    result = called(function, *arguments)
    for k, (x, kept) in enumerate(zip(arguments, before, strict=True)):
        require(unchanged(kept, x), f"{who} changed its argument {k}: let it work on a copy")
    require(result is not None, f"{who} returned None; is its return statement missing?")
    try:
        result = arrays(result)
    except (TypeError, ValueError):
        raise GradientMismatch(f"{who} must return an array of numbers, or a tuple of such arrays; "
                               f"it returned {result!r:.60}") from None
    require(all(np.isfinite(y).all() for y in result), f"{who} returned NaN or infinity")
    return result


# --- the numbers to measure, and their measurement ---------------------------------------------


def magnitude(x):
    """x (...) -> (...): an element's own size or the median size, the larger, as a power of two.

    The steps are powers of two as well, so x + h and x - h are exact.
    """
    sizes = np.abs(x)
    typical = np.median(sizes[sizes > 0]) if sizes.any() else 1.0
    return np.ldexp(1.0, np.frexp(np.maximum(sizes, typical))[1])


def element_part(title, position, x, gradient, rng):
    """An input's elements, one by one.

    A random choice of a large input is looked at. Half of it has a gradient other than zero,
    because a picture touches few texels of its texture.
    """
    order = rng.permutation(x.size)
    touched = order[gradient.flat[order] != 0][:ELEMENTS // 2]
    chosen = list(dict.fromkeys([*touched, *order[:ELEMENTS]]))[:ELEMENTS]
    scale, probes = magnitude(x), {}
    for index in (np.unravel_index(k, x.shape) for k in sorted(chosen)):
        direction = np.zeros(x.shape)
        direction[index] = 1.0
        probes[index] = {position: direction}, scale[index]
    return Part(title, gradient, np.full(x.shape, np.nan), probes)


def direction_part(title, gradients, inputs, rng):
    """Slopes along random directions, in which all elements of some inputs move at once."""
    slopes, probes = np.zeros(DIRECTIONS), {}
    for n in range(DIRECTIONS):
        moves = {k: rng.standard_normal(gradient.shape) * magnitude(inputs[k])
                 for k, gradient in gradients.items()}
        slopes[n] = sum(np.vdot(gradients[k], moves[k]) for k in moves)
        probes[(n,)] = moves, 1.0
    return Part(f"{title}, random direction", slopes, np.full(DIRECTIONS, np.nan), probes)


def slope_of_loss(forward, decisions, inputs, upstream):
    """-> the function slope(moves, h), which is D(h), or NaN where a decision changes.

    moves {position: direction}: those inputs move, each along its direction.
    """
    def decide(there):
        return arrays(called(decisions, *there)) if decisions else []

    def slope(moves, h):
        ahead, behind = ([x + step * moves[k] if k in moves else x for k, x in enumerate(inputs)]
                         for step in (h, -h))
        if not all(map(np.array_equal, decide(ahead) + decide(behind), here + here)):
            return np.nan
        # Outputs are subtracted first and summed then: what did not move adds no rounding.
        rise = zip(upstream, *(arrays(called(forward, *x)) for x in (ahead, behind)), strict=True)
        return sum(np.vdot(u, above - below) for u, above, below in rise) / (2 * h)

    here = decide(inputs)
    return slope


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


# --- the verdict, and what a failure tells ----------------------------------------------------


def verdict(elements, directions, slope, rtol, name, seed):
    """GradReport, or GradientMismatch, from the parts that were measured."""
    parts = elements + directions
    looked_at, left_out = sum(len(p.probes) for p in parts), sum(p.left_out() for p in parts)
    summary = f"(seed {seed}, {left_out} of {looked_at} numbers left out)"

    wrong = [[p for p in group if (p.error() > rtol).any()] for group in (elements, directions)]
    wrong = wrong[0] or wrong[1]  # a direction is told of only where no single element tells
    if wrong:
        lines = [f"{name}: wrong gradient {summary}", *(complaint(part, rtol) for part in wrong)]
        raise GradientMismatch(*evidence(lines, wrong[0], slope, rtol, name))

    for part in elements:
        lost = part.left_out()
        require(lost <= LEFT_OUT_LIMIT * len(part.probes), f"{name}: too little could be checked "
                f"{summary}: {lost} of {len(part.probes)} elements of {part.title} have no usable "
                "step, because a decision changes or forward is not finite; choose inputs farther "
                "from edges and ties")
        require(part.analytic.any(), f"{name}: nothing to check {summary}: the gradient with "
                f"respect to {part.title} is zero everywhere, and so are the central differences; "
                "choose inputs on which the output depends, or name the others in differentiable=")
    worst = max(np.nanmax(part.error(), initial=0.0) for part in parts)
    return GradReport(looked_at - left_out, left_out, float(worst))


def complaint(part, rtol):
    """How many numbers are off, the mistake that explains them all, and the worst of them."""
    error, worst = part.error(), part.worst()
    place = f"at {list(map(int, worst))}: " if worst else ""
    return (f"with respect to {part.title}: {(error > rtol).sum()} of {len(part.probes)} looked at "
            f"are off{pattern(part.analytic, part.numeric, rtol)}\n    {place}"
            f"analytic {part.analytic[worst] + 0.0:.10g}, numeric {part.numeric[worst]:.10g}, "
            f"relative error {error[worst]:.2g} (at most {rtol:g})")


def pattern(analytic, numeric, rtol):
    """A mistake that alone explains every number, after a semicolon, else ''."""
    seen = ~np.isnan(numeric)
    mistakes = [("it is zero everywhere", 0 * numeric),
                ("the sign is flipped", -numeric)]
    if np.count_nonzero(numeric[seen]) > 1:
        factor = np.vdot(numeric[seen], analytic[seen]) / np.vdot(numeric[seen], numeric[seen])
        mistakes += [(f"everything is {factor:.6g} times the numeric one", factor * numeric)]
    if numeric.ndim > 1:
        mistakes += [("its last two axes are swapped", np.swapaxes(numeric, -1, -2))]
    mistakes += [(f"the order along axis {axis} is reversed", np.flip(numeric, axis))
                 for axis in range(numeric.ndim)]
    for sentence, mistaken in mistakes:
        if (mistaken.shape == analytic.shape
                and (relative_error(analytic, mistaken)[seen] <= rtol).all()):
            return f"; {sentence}"
    return ""


def evidence(lines, part, slope, rtol, name):
    """Sweep the worst number to the end, draw the part -> the whole message, the picture's path."""
    worst = part.worst()
    moves, scale = part.probes[worst]
    _, D, change = sweep(slope, moves, scale, settled=-1.0)
    if np.nanmin(change) > rtol * max(abs(part.analytic[worst]), abs(part.numeric[worst])):
        lines += ["  no two steps agree there: forward jumps, bends or is noisy; see decisions="]
    try:
        picture = draw(part, rtol, name, scale * STEPS, D, change)
        lines += [f"picture: {places.shown_path(picture)}"]
    except OSError as error:  # must not hide the mismatch
        picture, lines = None, [*lines, f"no picture: {error}"]
    return "\n  ".join(lines), picture and str(picture)


def draw(part, rtol, name, steps, D, change):
    """Write analytic | numeric | difference | what is off | the worst sweep -> the path."""
    from matplotlib.figure import Figure  # here, so that a check that passes does not wait for it

    error, worst = part.error(), part.worst()
    figure = Figure(figsize=(16, 3.8))
    figure.suptitle(f"{name}: the gradient with respect to {part.title} is off in "
                    f"{(error > rtol).sum()} of {len(part.probes)} numbers (red below zero, "
                    "blue above, grey not known)")
    figure.subplots_adjust(left=0.03, right=0.99, bottom=0.14, top=0.82, wspace=0.2)
    *axes, curve = figure.subplots(1, 5, width_ratios=[1, 1, 1, 1, 1.3])

    difference, state = part.analytic - part.numeric, np.full(error.shape, np.nan)
    for index in part.probes:
        state[index] = -1 if error[index] > rtol else 1 if np.isnan(error[index]) else 0
    limit, gap = (np.nanmax(np.abs(x)) for x in ([part.analytic, part.numeric], difference))
    show(axes[0], f"analytic (to ±{limit:.3g})", part.analytic, limit)
    show(axes[1], f"numeric (to ±{limit:.3g})", part.numeric, limit)
    show(axes[2], f"difference (to ±{gap:.3g})", difference, gap)
    show(axes[3], "red: off, blue: left out", state, 1)

    least = 1e-16 * np.abs([part.analytic[worst], part.numeric[worst]]).max()
    distance = np.abs(D - part.numeric[worst])
    curve.loglog(steps, np.maximum(distance, least), "o-", label="|D - numeric|")
    curve.loglog(steps[2:], np.maximum(change, least), "s-", label="change of E")
    curve.axhline(np.abs(difference[worst]), color="black", ls="--", label="|analytic - numeric|")
    curve.set(title="step sweep of the worst number", xlabel="h")
    curve.minorticks_off()
    curve.legend()

    png, path = io.BytesIO(), places.check_picture(name)
    figure.savefig(png)
    places.write_whole(path, png.getvalue())
    return path


def show(axis, title, x, limit):
    """x in rows and columns, y up, in colours from -limit to limit."""
    rows = x.reshape(len(x), -1) if x.ndim > 1 else x.reshape(1, -1)
    axis.imshow(rows, "RdBu", vmin=-limit, vmax=limit, origin="lower", aspect="auto",
                interpolation="nearest")
    axis.set(title=title, facecolor="0.8")
    axis.locator_params(integer=True, min_n_ticks=1)
