"""Colours that are found in pixels that mix them, by labs 1, 2 and 4."""
import numpy as np

from ..given.arrays import scatter
from .viewing import BUNNY_EYE, clip_positions


def sampled_ball(labs, vertices, faces, size):
    """A mesh with 16 samples in each of size x size pixels: pixel, face and request of lab 4."""
    clip = clip_positions(labs, vertices, BUNNY_EYE)
    pattern = labs.msaa.standard_pattern(16)
    face_index, _ = labs.msaa.rasterize_samples(clip, faces, size, size, pattern)
    return labs.msaa.shading_requests(face_index)


def painted(labs, seen, colours):
    """A `sampled_ball` of F faces in colours (F + 1, 3), the last of them behind it: a picture."""
    _, face, request = seen
    return labs.msaa.resolve(colours[face], request, colours[-1])


def colours_found(labs, seen, goal, count, steps):
    """Yields colours (count + 1, 3) before each step of descent to a picture, and at the end."""
    _, face, request = seen
    samples = np.bincount(np.append(face, count)[request].ravel(), minlength=count + 1)
    area = np.maximum(samples, 1)[:, None] / len(request)  # in pixels
    colours = np.full((count + 1, 3), 0.5)
    for _ in range(steps):
        yield colours
        error = painted(labs, seen, colours) - goal
        grad_shade, behind = labs.msaa.resolve_backward(error, colours[face], request, colours[-1])
        gradient = np.append(scatter(grad_shade, face, count), [behind], 0)
        colours = colours - gradient / area
    yield colours
