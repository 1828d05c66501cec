"""Gradient check: is a backward pass, derived by hand, the derivative of its forward pass?

The loss is L = sum(upstream * forward(...)), so backward(upstream, ...) must return its gradients.
The upstream gradient is random: with all ones, a backward that averages or misplaces its
grad_output would pass. How the numeric derivatives are measured, and what an error is, says
sweeps.py.
"""
import copy
import inspect
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from labkit.contract import called, unchanged
from labkit.suspicions import places, suspicion

from .sweeps import RTOL, direction_part, element_part, relative_error, sweep

LEFT_OUT_LIMIT = 0.10  # a check that leaves out a larger share says too little


class GradReport(NamedTuple):
    """What a passed check looked at: numbers checked, numbers left out, the largest error (3)."""

    checked: int
    left_out: int
    worst_error: float


class GradientMismatch(AssertionError):
    """A gradient is wrong, or could not be checked: which, where and how."""


class Case(NamedTuple):
    """What is checked. inputs: copies, titles: {position of those to differentiate: its title}."""

    forward: Callable
    backward: Callable
    decisions: Callable | None
    inputs: list
    titles: dict
    name: str


def gradcheck(forward, backward, inputs, *, seed=0, differentiable=None, decisions=None,
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
    name: what is checked. It opens every message.

    -> GradReport. Raises GradientMismatch where a gradient is wrong, zero everywhere, not
    finite, of the wrong shape or missing, where forward or backward changes its arguments, and
    where more than LEFT_OUT_LIMIT of an input's elements were left out. (Directions do not count
    here: one element on an edge spoils them all.) ValueError where nothing can be differentiated.
    """
    titles, inputs = prepare(forward, inputs, differentiable, name)
    case = Case(forward, backward, decisions, inputs, titles, name)
    rng = np.random.default_rng(seed)
    upstream = [rng.standard_normal(y.shape) for y in call(forward, inputs, f"{name}: forward")]
    elements, directions = measured(case, upstream, rng)
    parts = elements + directions
    looked_at = sum(len(part.probes) for part in parts)
    left_out = sum(part.left_out() for part in parts)
    summary = f"(seed {seed}, {left_out} of {looked_at} numbers left out)"
    wrong = [part for part in elements if part.off().any()]
    wrong = wrong or [part for part in directions if part.off().any()]  # no single element tells
    if wrong:
        lines = [f"{name}: wrong gradient {summary}", *complaints(case, wrong, upstream),
                 *parts_of_outputs(case, upstream, rng),
                 *without_a_slope(wrong[0], slope_of_loss(case, upstream))]
        gradients_of(case, upstream)  # so that the last call, which reports show, is that of all
        raise GradientMismatch("\n  ".join(lines))
    require_enough(elements, name, summary)
    worst = max(np.nanmax(part.error(), initial=0.0) for part in parts)
    return GradReport(looked_at - left_out, left_out, float(worst))


def measured(case, upstream, rng):
    """-> the Parts of each input's elements, and those along random directions, measured."""
    titles, inputs = case.titles, case.inputs
    gradients = gradients_of(case, upstream)
    elements = [element_part(titles[k], k, inputs[k], gradients[k], rng) for k in titles]
    directions = [direction_part(titles[k], {k: gradients[k]}, inputs, rng) for k in titles]
    if len(titles) > 1:
        directions += [direction_part("all inputs together", gradients, inputs, rng)]
    slope = slope_of_loss(case, upstream)
    for part in elements + directions:
        part.measure(slope)
    return elements, directions


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


def gradients_of(case, upstream):
    """-> {position: analytic gradient}, once their number and shapes are right."""
    titles, name = case.titles, case.name
    gradients = call(case.backward, [*upstream, *case.inputs], f"{name}: backward")
    if len(gradients) == 1 < len(titles) and gradients[0].shape[:1] == (len(titles),):
        gradients = list(gradients[0])  # they came as a list, which has become one array
    require(len(gradients) == len(titles), f"{name}: backward must return {len(titles)} gradients, "
            f"with respect to {', '.join(titles.values())}; it returned {len(gradients)}")
    other_order = sorted(case.inputs[k].shape for k in titles) == sorted(
        gradient.shape for gradient in gradients)
    for k, gradient in zip(titles, gradients, strict=True):
        shape = case.inputs[k].shape
        require(gradient.shape == shape, f"{name}: the gradient with respect to {titles[k]} must "
                f"have that input's shape {shape}; it has {gradient.shape}"
                f"{': the gradients are in the wrong order' * other_order}")
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


def slope_of_loss(case, upstream):
    """-> the function slope(moves, h), which is D(h), or NaN where a decision changes.

    moves {position: direction}: those inputs move, each along its direction.
    """
    forward, _, decisions, inputs, *_ = case

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


# --- the verdict, and what a failure tells ----------------------------------------------------


def require_enough(elements, name, summary):
    """GradientMismatch if too many elements were left out, or there is no gradient at all."""
    for part in elements:
        lost = part.left_out()
        require(lost <= LEFT_OUT_LIMIT * len(part.probes), f"{name}: too little could be checked "
                f"{summary}: {lost} of {len(part.probes)} elements of {part.title} have no usable "
                "step, because a decision changes or forward is not finite; choose inputs farther "
                "from edges and ties")
        require(part.analytic.any(), f"{name}: nothing to check {summary}: the gradient with "
                f"respect to {part.title} is zero everywhere, and so are the central differences; "
                "choose inputs on which the output depends, or name the others in differentiable=")


def complaints(case, wrong, upstream):
    """Of each part that is wrong, how many numbers are off, what explains them, and the worst."""
    inputs = [*((f"upstream gradient {k}", u) for k, u in enumerate(upstream)),
              *((title, case.inputs[k]) for k, title in case.titles.items())]
    for part in wrong:
        error, worst = part.error(), part.worst()
        place = f"at {list(map(int, worst))}: " if worst else ""
        yield (f"with respect to {part.title}: {part.off().sum()} of {len(part.probes)} looked "
               f"at are off{explanation(part, inputs)}\n    {place}"
               f"analytic {part.analytic[worst] + 0.0:.10g}, numeric {part.numeric[worst]:.10g}, "
               f"relative error {error[worst]:.2g} (at most {RTOL:g})")


def explanation(part, inputs):
    """The mistake that alone explains every number, after a semicolon; else the one place where all
    are that are off, " in [..., 1]" or where an input is negative; else ''.
    """
    unseen = np.isnan(part.numeric)

    def agrees(analytic, numeric):
        return unseen | (relative_error(analytic, numeric) <= RTOL)

    found = suspicion(part.analytic, part.numeric, agrees, inputs)
    place, _ = next(places(part.off(), part.numeric == 0, inputs), ("", None))
    return f"; {found}" if found else place


def parts_of_outputs(case, upstream, rng):
    """Lines: is the gradient right that comes from each of several outputs alone?"""
    for output in range(len(upstream)) if len(upstream) > 1 else ():
        alone = [u if k == output else 0 * u for k, u in enumerate(upstream)]
        part = direction_part("", gradients_of(case, alone), case.inputs, rng)
        part.measure(slope_of_loss(case, alone))
        how = "right" if not part.off().any() else "wrong" if part.analytic.any() else "missing"
        yield f"what comes from output {output} is {how}"


def without_a_slope(part, slope):
    """A line, or none: no two steps agree on the worst number's derivative."""
    worst = part.worst()
    _, _, change = sweep(slope, *part.probes[worst], settled=-1.0)
    if np.nanmin(change) > RTOL * max(abs(part.analytic[worst]), abs(part.numeric[worst])):
        yield "  no two steps agree there: forward jumps, bends or is noisy; see decisions="
