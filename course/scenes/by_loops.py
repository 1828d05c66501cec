"""A tetrahedron finds its picture through the slow functions of labs 2, 5 and 7, pixel by pixel.

    rasterize_loop -> screen_weights, barycentric_from_screen -> interpolate_loop -> blend_pairs
    vertices <- barycentric_backward, pixel by pixel <- interpolate_backward_loop <- its backward

It is what `pipeline.draw` does, in functions that were written before they were fast. Only the
outlines (lab 8) are blended all at once.
"""
from typing import NamedTuple

import numpy as np

from . import drawing, viewing

SIZE = 96  # pixels on a side
STEPS = 30
FACES = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]])
POSITIONS = np.array([[0.0, 0.9, 0.0], [-0.8, -0.5, 0.5], [0.8, -0.5, 0.5], [0.0, -0.5, -0.9]])
COLOURS = np.array([[0.9, 0.2, 0.2], [0.2, 0.8, 0.3], [0.2, 0.3, 0.9], [0.9, 0.8, 0.2]])
EYE = np.array([2.0, 0.7, 1.7])
GREY = np.full(3, 0.1)


class Seen(NamedTuple):
    """What the way back needs: lab 8's pairs, and the colours before they are blended."""

    clip: np.ndarray
    face_index: np.ndarray
    barycentric: np.ndarray
    colour: np.ndarray
    pairs: tuple


def by_loops(labs):
    """A tetrahedron finds its picture, pixel by pixel (labs 1, 2, 5, 7, 8, 9)."""
    lab9 = labs.inverse_rendering
    camera, start = viewing.clip_from_world(labs, EYE), moved(np.random.default_rng(0))
    target, _ = drawn(labs, *parts(labs, camera, np.hstack([POSITIONS, COLOURS])))
    yield f"the target, {SIZE} x {SIZE}", None

    path, losses = drawing.descended(
        labs, start, lambda x: loss_and_gradient(labs, camera, x, target),
        lab9.decay(0.05, 0.1, STEPS), lab9.adam_step)
    yield (f"{STEPS} steps: the loss falls from {losses[0]:.4f} to {losses[-1]:.5f}", None,
           ("a twentieth", losses[-1] < losses[0] / 20))
    stages = [drawn(labs, *parts(labs, camera, x))[0] for x in (path[0], path[8], path[-1])]
    sheet = drawing.enlarged(np.hstack([*stages, target]), 3)
    yield "steps 0, 8, the last, the target", drawing.save("by_loops", "steps", sheet)


def moved(rng):
    """Where the fit begins: the corners are elsewhere, and all of one grey."""
    return np.hstack([POSITIONS + rng.normal(0, 0.15, POSITIONS.shape), np.full((4, 3), 0.5)])


def loss_and_gradient(labs, camera, x, target):
    """How far the picture of x (4, 6) is from its target, a number, and grad_x (4, 6)."""
    clip, colours = parts(labs, camera, x)
    picture, seen = drawn(labs, clip, colours)
    grad_picture = labs.inverse_rendering.squared_error_backward(1.0, picture, target)
    grad_colours, grad_clip = drawn_backward(labs, grad_picture, seen, colours)
    grad_positions, _ = labs.pipeline.to_clip_backward(grad_clip, x[:, :3], camera)
    return (labs.inverse_rendering.squared_error(picture, target),
            np.hstack([grad_positions, grad_colours]))


def parts(labs, camera, x):
    """x (4, 6), positions beside colours -> clip (4, 4), colours (4, 3)."""
    return labs.pipeline.to_clip(x[:, :3], camera), x[:, 3:]


def drawn(labs, clip, colours):
    """The picture (SIZE, SIZE, 3), and what was Seen."""
    face_index, depth = labs.rasterization.rasterize_loop(clip, FACES, SIZE, SIZE)
    barycentric = barycentrics(labs, face_index, clip)
    colour = labs.interpolation.interpolate_loop(colours, FACES, face_index, barycentric)
    colour[face_index < 0] = GREY
    opposite = labs.antialiasing.opposite_vertices(FACES)
    pairs = labs.outlines.blended_pairs(face_index, depth, clip, FACES, opposite)
    seen = Seen(clip, face_index, barycentric, colour, pairs)
    return labs.antialiasing.blend_pairs(colour, pairs), seen


def barycentrics(labs, face_index, clip):
    """Where on its face each pixel lies, (SIZE, SIZE, 3): by its screen weights, and each w."""
    x, y, w = labs.rasterization.screen_points(clip, SIZE, SIZE)
    barycentric = np.zeros((SIZE, SIZE, 3))
    for i, j, corners in seen_pixels(face_index):
        triangle = np.stack([x[corners], y[corners]], -1)
        weights = labs.rasterization.screen_weights(np.array([j + 0.5, i + 0.5]), triangle)
        barycentric[i, j] = labs.interpolation.barycentric_from_screen(weights, w[corners])
    return barycentric


def seen_pixels(face_index):
    """Yield the row and column of each pixel that sees a face, and the corners of this face."""
    for i, j in zip(*np.nonzero(face_index >= 0), strict=True):
        yield i, j, FACES[face_index[i, j]]


def drawn_backward(labs, grad_picture, seen, colours):
    """Backward of `drawn`: grad_picture (SIZE, SIZE, 3) -> grad_colours (4, 3), grad_clip (4, 4).
    """
    clip, face_index, barycentric, colour, pairs = seen
    grad_colour, grad_clip = labs.antialiasing.blend_pairs_backward(grad_picture, colour, pairs,
                                                                    clip)
    grad_colours, grad_barycentric = labs.interpolation.interpolate_backward_loop(
        grad_colour, colours, FACES, face_index, barycentric)
    for i, j, corners in seen_pixels(face_index):
        m = clip[corners][:, [0, 1, 3]].T
        centre = np.array([(2 * j + 1) / SIZE - 1, (2 * i + 1) / SIZE - 1, 1.0])
        grad_m, _ = labs.vertex_gradients.barycentric_backward(grad_barycentric[i, j], m, centre)
        grad_clip[corners[:, None], [0, 1, 3]] += grad_m.T
    return grad_colours, grad_clip
