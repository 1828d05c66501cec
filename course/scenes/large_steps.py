"""A ball becomes the bunny by gradients that are spread over the surface (lab 13)."""
import time

import numpy as np

from ..given import mesh
from .drawing import save
from .fit_bunny import ball, carve, new_views, seen_anew, stages


def large_steps(labs):
    """A ball becomes the bunny by spread gradients, without a regularizer (lab 13)."""
    for name, amount in ("with", 3.0), ("without", 0.0):
        start = time.process_time()
        path, _ = fit(labs, amount, (0.2, 0.1))
        yield f"{name} spreading, {time.process_time() - start:.0f} s:", None
        for step in 30, 100:
            yield f"  after {step:3} steps, IoU {new_views(labs, path[step]).mean():.4f}", None
        yield from seen_anew(labs, path)
        yield "  steps 0, 30, 100, 300", save("large_steps", name, stages(labs, path))


def fit(labs, amount, rates, steps=300, size=128, seed=0):
    """Lab 9's fit of the bunny without a penalty, but with large steps. The rate goes from rates[0]
    to rates[1]. -> what `carve` returns.
    """
    edges, _ = mesh.edges(ball()[1])

    def update(*state):
        return labs.regularization.large_step(*state, (edges, np.ones(len(edges)), amount))

    schedule = labs.inverse_rendering.decay(rates[0], rates[1] / rates[0], steps)
    return carve(labs, np.zeros_like, update, schedule, size, seed)
