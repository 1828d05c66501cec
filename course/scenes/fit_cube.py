"""A cube's shape and colours from tiny pictures (lab 9), as in nvdiffrast's sample."""
from typing import NamedTuple

import numpy as np

from .drawing import descended, on_black
from .viewing import random_pose

CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
SQUARES = np.array([[0, 2, 1, 3], [4, 5, 6, 7], [0, 1, 4, 5],
                    [2, 6, 3, 7], [0, 4, 2, 6], [1, 3, 5, 7]])
HALVES = np.array([[0, 1, 2], [2, 1, 3]])
FACES = SQUARES[:, HALVES].reshape(12, 3)


class Cube(NamedTuple):
    """What is unknown about a cube of FACES: positions (8, 3), colours (8, 3)."""

    positions: np.ndarray
    colours: np.ndarray


TRUTH = Cube(CORNERS - 0.5, CORNERS)


def fit(labs, size, seed, steps=1000):
    """A cube seen in one random pose at every step, in size x size pixels: at first its positions
    are wrong by up to 1/2, and its colours are noise.

    -> errors (steps + 1,), the mean distance of the vertices from the cube's, losses (steps,), and
    the Cube at the end.
    """
    lab9, rng = labs.inverse_rendering, np.random.default_rng(seed)
    shape, clip_from_world = mesh_of(labs), camera(labs)
    x = Cube(TRUTH.positions + rng.uniform(-0.5, 0.5, (8, 3)), rng.uniform(0, 1, (8, 3)))

    def gradient(x):
        pose = clip_from_world @ random_pose(labs, rng, 0.25)
        target, *_ = seen(labs, shape, TRUTH, pose, size)
        picture, *given = seen(labs, shape, x, pose, size)
        loss, grad_picture = lab9.squared_error(picture, target)
        grads = labs.pipeline.render_backward(grad_picture, *given)
        return loss, Cube(grads.positions, grads.material.colours)

    rates = [1e-2 * max(0.01, 10**(-0.0005 * step)) for step in range(steps)]
    path, losses = descended(labs, x, gradient, rates)
    return np.array([error(x.positions) for x in path]), losses, path[-1]


def error(positions):
    """How far vertices (8, 3) are from those of a cube of side 1: the mean of their distances."""
    return np.linalg.norm(np.abs(positions) - 0.5, axis=1).mean()


def mesh_of(labs):
    """The Mesh of every Cube: only its positions differ."""
    return labs.pipeline.make_mesh(TRUTH.positions, FACES)


def seen(labs, shape, cube, clip_from_model, size):
    """A Cube on black, (size, size, 3), and what `render_backward` takes. shape: `mesh_of`."""
    moved = shape._replace(positions=cube.positions)
    return on_black(labs, moved, cube.colours, clip_from_model, size)


def shown(labs, cube, clip_from_model, size):
    """What a Cube looks like on black, in colours from 0 to 1: (size, size, 3)."""
    return np.clip(seen(labs, mesh_of(labs), cube, clip_from_model, size)[0], 0, 1)


def camera(labs, distance=3.5):
    """clip_from_world (4, 4) of the sample: it sees 0.4 to each side of the axis at distance 1."""
    away = labs.transforms.translate(np.array([0.0, 0.0, -distance]))
    return labs.transforms.frustum(-0.4, 0.4, -0.4, 0.4, 1.0, 50.0) @ away
