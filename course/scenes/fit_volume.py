"""A ball in a ring, found as density and colour in a grid, from pictures on white (lab 15)."""
from typing import NamedTuple

import numpy as np

from .drawing import WHITE

SATURN = ("union", ("torus", 0.68, 0.22), ("sphere", 0.32))


class Rays(NamedTuple):
    """Rays, and what they see: origins, directions, colours (R, 3)."""

    origins: np.ndarray
    directions: np.ndarray
    colours: np.ndarray


class Volume(NamedTuple):
    """What is unknown about a volume, at the G points of a grid: density (G,), colour (G, 3)."""

    density: np.ndarray
    colour: np.ndarray


def fit(labs, rays, n, steps, seed=0, batch=1000):
    """Adam on a grid of n^3 cells: in each step, batch random ones of the Rays.

    Yields the Volume after each step, and the loss before it, as lab 9's `descend` does.
    """
    lab9, lab15, rng = labs.inverse_rendering, labs.implicit_surfaces, np.random.default_rng(seed)

    def gradient(x):
        chosen = rng.integers(len(rays.colours), size=batch)
        origins, directions, target = (part[chosen] for part in rays)
        weights, *given = looked_up(labs, origins, directions, x)
        output = lab15.volume_render(*given)
        loss, grad_output = lab9.squared_error(output, target)
        grad_density, grad_colour = lab15.volume_render_backward(grad_output, *given)
        return loss, Volume(weights.T @ grad_density.ravel(),
                            weights.T @ grad_colour.reshape(-1, 3))

    start = Volume(np.full((n + 1)**3, 0.1), np.full(((n + 1)**3, 3), 0.5))
    return lab9.descend(start, gradient, schedule(steps), project=bounded)


def schedule(steps):
    """The learning rates of each step, of density and of colour."""
    falling = [0.1**(step / steps) for step in range(1, steps + 1)]
    return [Volume(1.0 * part, 0.03 * part) for part in falling]


def bounded(x):
    """The nearest Volume with a density of 0 or more, and colours from 0 to 1."""
    return Volume(np.maximum(x.density, 0), np.clip(x.colour, 0, 1))


def looked_up(labs, origins, directions, volume, count=40):
    """A Volume along rays, at count points 1.2 to 3.8 in front of their origins -> weights, the
    matrix of the look-ups, and what lab 15's `volume_render` takes, on white.
    """
    n = round(len(volume.density)**(1 / 3)) - 1
    points, spacing = labs.implicit_surfaces.ray_samples(origins, directions, 1.2, 3.8, count)
    weights = labs.marching_tetrahedra.grid_weights(points.reshape(-1, 3), n)
    return (weights, (weights @ volume.density).reshape(spacing.shape),
            (weights @ volume.colour).reshape(*spacing.shape, 3), spacing, WHITE)


def seen(labs, rays, volume):
    """What Rays see of a Volume on white: (R, 3)."""
    _, *given = looked_up(labs, rays.origins, rays.directions, volume)
    return labs.implicit_surfaces.volume_render(*given)


def saturn_rays(labs, cameras, size, samples=3):
    """Pictures (size, size) of a ball in a ring on white, each pixel a mean of samples^2 rays.

    -> the Rays of all pixels of all cameras, one after the other.
    """
    lab15, rays = labs.implicit_surfaces, []
    for camera in cameras:
        colours = saturn_colours(labs, *lab15.camera_rays(camera, samples * size, samples * size))
        colours = colours.reshape(size, samples, size, samples, 3).mean((1, 3)).reshape(-1, 3)
        rays.append((*lab15.camera_rays(camera, size, size), colours))
    return Rays(*(np.concatenate(part) for part in zip(*rays, strict=True)))


def saturn_colours(labs, origins, directions):
    """What rays see of a ball in a ring: (R, 3)."""
    t, _ = labs.implicit_surfaces.sphere_trace(origins, directions, SATURN, 9.0)
    seen, colours = np.isfinite(t), np.ones(origins.shape)
    at = origins[seen] + t[seen, None] * directions[seen]
    ball, left = np.linalg.norm(at, axis=1) < 0.4, at[:, 0] < 0
    paint = np.select([ball[:, None], left[:, None]], [[0.9, 0.3, 0.2], [0.95, 0.8, 0.3]],
                      [0.25, 0.5, 0.85])
    colours[seen] = paint * (0.7 + 0.3 * labs.implicit_surfaces.normals(at, SATURN)[:, 1:2])
    return colours


def surface(density, points, level=5.0):
    """The surface where a density equals level, as numbers for marching.

    They are positive outside, and at the border of the grid.
    """
    return np.where((np.abs(points) == 1).any(1), level, level - density)
