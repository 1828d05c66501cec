"""Photographs of painted objects, and so of what a search has found, in any light."""
from typing import NamedTuple

import numpy as np

from ..given import image, mesh

ON_WHITE = np.array([1.0, 1.0, 1.0, 0.0])  # a white background, which covers nothing


class Painted(NamedTuple):
    """An object that can be photographed: vertices (V, 3), faces (F, 3), albedo (V, 3)."""

    vertices: np.ndarray
    faces: np.ndarray
    albedo: np.ndarray


def seen(labs, surface, paint, cameras, shape, background, samples):
    """Yield a surface with Colours (V, C) as cameras see it, before a background (C,), as pictures
    of a shape (H, W): each pixel is a mean of samples^2.
    """
    solid, (height, width) = labs.pipeline.make_mesh(surface.vertices, surface.faces), shape
    for camera in cameras:
        view = labs.pipeline.View(camera, samples * width, samples * height, background)
        picture, _ = labs.pipeline.render(solid, paint, view)
        yield labs.msaa.box_resolve(picture, samples)


def photographs(labs, painted, light, cameras, size, samples=4):
    """Pictures (size, size, 4) of a Painted on white: colour and coverage, samples^2 to a
    pixel.
    """
    normals = mesh.vertex_normals(painted.vertices, painted.faces)
    paint = labs.multi_view_fit.covering(labs.reconstruction.shade(painted.albedo, normals, light))
    return list(seen(labs, painted, paint, cameras, (size, size), ON_WHITE, samples))


def portrait(labs, x, camera, size, samples=2):
    """What is found, in the light that is found, and as white clay: (size, 2 size, 3), as shown."""
    painted = found_object(labs, x)
    clay = painted._replace(albedo=np.full(painted.albedo.shape, 0.8))
    both = [photographs(labs, each, lamp, [camera], size, samples)[0][..., :3]
            for each, lamp in ((painted, x.light), (clay, daylight(labs)))]
    return image.to_srgb(np.clip(np.hstack(both), 0, 1))


def found_object(labs, x):
    """The surface of x as a Painted."""
    found = labs.multi_view_fit.surface(x)
    return Painted(found.vertices, found.faces, found.albedo)


def lamps(labs, towards, strength, even):
    """The light (9, 3) of lamps in these directions (N, 3), and of an even sky."""
    lab16 = labs.reconstruction
    light = lab16.distant_light(mesh.unit(towards), np.array(strength))
    light[0] += even / lab16.C0
    return light


def daylight(labs):
    """Sun, sky, and some light from the ground (9, 3)."""
    towards = np.array([[0.5, 0.7, 0.5], [-0.8, 0.3, 0.3], [0.0, -1.0, 0.0], [0.0, 0.4, -0.9]])
    return lamps(labs, towards, [[0.97, 0.88, 0.75], [0.2, 0.3, 0.45], [0.2, 0.12, 0.1],
                                 [0.25, 0.3, 0.4]], 0.12)
