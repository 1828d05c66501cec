"""One object, three representations: a shape drawn as signed distance, as volume and as mesh.

Each picture is of the same shape (the tuples of implicit_surfaces.py), from the same camera, in the
same light. So what differs between two of them is what the representation does.

Source: lecture "Differentiable graphics 1".
"""
from typing import NamedTuple

import numpy as np

from course.given.mesh import unit

from . import pipeline
from .implicit_surfaces import (
    camera_rays,
    density_of,
    normals,
    ray_samples,
    signed_distance,
    sphere_trace,
    volume_render,
)
from .marching_tetrahedra import marching_tetrahedra, tetrahedral_grid

SAMPLES = 1 << 17  # of a volume, in flight at once


class Lighting(NamedTuple):
    """How a surface is lit: the direction towards the light (3,), and the surface's colour (3,)."""

    direction: np.ndarray
    colour: np.ndarray


def lit(normal, lighting):
    """The colours (..., 3) of a surface with the normals (..., 3).

    Full where a normal agrees with the light, a quarter at right angles, black only straight away.
    """
    return (0.5 + 0.5 * normal @ unit(lighting.direction))[..., None]**2 * lighting.colour


def render_distance(shape, view, lighting, far=20.0, lipschitz=1.0):
    """A shape by sphere tracing: picture (height, width, 3), evaluations (height, width).

    view is a pipeline.View. far is along the ray, from the camera's near plane on.
    """
    origins, directions = camera_rays(view.clip_from_model, view.width, view.height)
    t, evaluations = sphere_trace(origins, directions, shape, far, lipschitz, most=1000)
    picture = np.tile(view.background, (len(t), 1))
    seen = np.isfinite(t)
    points = origins[seen] + t[seen, None] * directions[seen]
    picture[seen] = lit(normals(points, shape), lighting)
    return picture.reshape(view.height, view.width, 3), evaluations.reshape(view.height, view.width)


def render_volume(shape, view, lighting, near, far, beta=0.01, count=128):
    """A shape as a volume with the density of eq. (7): picture (height, width, 3).

    Each ray has count samples, from near to far along it, from the camera's near plane on. Pieces
    longer than beta fray the edges. A sample that stops a millionth of the light or less is seen by
    nobody, and stays black.
    """
    origins, directions = camera_rays(view.clip_from_model, view.width, view.height)
    picture = np.empty((len(origins), 3))
    parts = -(-len(origins) * count // SAMPLES)  # rounded up
    for rays in np.array_split(np.arange(len(origins)), max(parts, 1)):
        points, spacing = ray_samples(origins[rays], directions[rays], near, far, count)
        density = density_of(signed_distance(points, shape), beta)
        seen = density * spacing > 1e-6
        colours = np.zeros(points.shape)
        colours[seen] = lit(normals(points[seen], shape), lighting)
        picture[rays] = volume_render(density, colours, spacing, view.background)
    return picture.reshape(view.height, view.width, 3)


def render_mesh(shape, view, lighting, n=64):
    """A shape as a mesh, marched on n^3 cells and rendered: picture (height, width, 3).

    What reaches beyond [-1, 1]^3 is cut open.
    """
    points, tetrahedra = tetrahedral_grid(n)
    vertices, faces, _ = marching_tetrahedra(points, signed_distance(points, shape), tetrahedra)
    colours = pipeline.Colours(lit(normals(vertices, shape), lighting))
    return pipeline.render(pipeline.make_mesh(vertices, faces), colours, view)[0]
