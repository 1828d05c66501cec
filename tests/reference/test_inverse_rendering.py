"""What lab 9 gives besides its exercises: descent, and the energy of a Laplacian."""
from typing import NamedTuple

import numpy as np
import pytest

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import inverse_rendering


class Pair(NamedTuple):
    """Two parameters by name."""

    a: np.ndarray
    b: np.ndarray


GOAL = Pair(np.array([1.0, -2.0]), np.array([[30.0]]))


def pair_gradient(x):
    """The squared distance from GOAL, and its gradients."""
    away = Pair(x.a - GOAL.a, x.b - GOAL.b)
    return (away.a**2).sum() + (away.b**2).sum(), Pair(2 * away.a, 2 * away.b)


# --- descent -----------------------------------------------------------------------------------

def test_descent_is_adam_step_by_step():
    """The moments are lost between two steps, the step is not counted, or counted from 0."""
    def gradient(x):
        return (x**4).sum(), 4 * x**3

    x, mean, square = np.array([1.0, -3.0]), np.zeros(2), np.zeros(2)
    rates = 0.3, 0.2, 0.1
    found = list(inverse_rendering.descend(x, gradient, rates))
    assert len(found) == 3
    for step, (rate, (got, loss)) in enumerate(zip(rates, found, strict=True), 1):
        assert loss == (x**4).sum()  # before the step
        x, mean, square = inverse_rendering.adam_step(x, 4 * x**3, mean, square, step, rate)
        np.testing.assert_array_equal(got, x)


def test_parameters_by_name_go_as_each_would_alone():
    """Moments or rates of one parameter are used for another one."""
    start = Pair(np.zeros(2), np.ones((1, 1)))
    together = inverse_rendering.descend(start, pair_gradient, [Pair(0.1, 3.0)] * 5)
    alone = [inverse_rendering.descend(x, lambda x, goal=goal: (0.0, 2 * (x - goal)), [rate] * 5)
             for x, goal, rate in zip(start, GOAL, (0.1, 3.0), strict=True)]
    for (x, _), (a, _), (b, _) in zip(together, *alone, strict=True):
        assert isinstance(x, Pair)
        np.testing.assert_array_equal(x.a, a)
        np.testing.assert_array_equal(x.b, b)


def test_each_parameter_may_have_its_own_update():
    """One update moves every parameter."""
    def still(x, grad_x, mean, square, step, rate):
        return x, mean, square

    start = Pair(np.zeros(2), np.ones((1, 1)))
    update = Pair(still, inverse_rendering.adam_step)
    *_, (x, _) = inverse_rendering.descend(start, pair_gradient, [1.0] * 3, update)
    assert (x.a == start.a).all() and x.b > start.b


def test_a_projection_is_part_of_every_step():
    """Only the last x is projected, or the next step starts beside it."""
    seen = []

    def gradient(x):
        seen.append(x)
        return x.sum(), np.ones(1)

    found = list(inverse_rendering.descend(np.array([0.15]), gradient, [0.1] * 3,
                                           project=lambda x: np.maximum(x, 0)))
    np.testing.assert_allclose(np.concatenate([x for x, _ in found]), [0.05, 0, 0], atol=1e-7)
    np.testing.assert_array_equal(seen[1:], [x for x, _ in found[:-1]])


def test_a_schedule_falls_by_equal_factors():
    """The first rate is already smaller, or the last one is reached too early."""
    schedule = inverse_rendering.decay(0.5, 0.01, 4)
    assert schedule[0] == 0.5 and len(schedule) == 4
    assert np.divide(schedule[1:], schedule[:-1]) == pytest.approx([0.01**0.25] * 3)


# --- the regularizer ---------------------------------------------------------------------------

def test_the_energy_of_a_laplacian_has_a_gradient():
    """The 2 is missing, or grad_energy."""
    positions, faces = mesh.icosphere(80)
    edges, _ = mesh.edges(faces)
    gradcheck(inverse_rendering.uniform_laplacian_energy,
              inverse_rendering.uniform_laplacian_energy_backward,
              (positions, edges), differentiable=[0], name="uniform_laplacian_energy")
