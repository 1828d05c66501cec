"""A triangle finds its place from the colours inside of it, by Gauss and Newton (lab 7).

Units are pixels of a picture of WIDTH x HEIGHT.
"""
import numpy as np

from labkit import places

from ..given import image

WIDTH, HEIGHT = 24, 18
FACE = np.array([[0, 1, 2]])
GOAL = np.array([[2.3, 3.1], [21.0, 5.2], [9.4, 16.3]])
START = GOAL + np.array([[3.0, -2.0], [-4.0, 3.0], [2.0, -3.5]])
COLOURS = np.array([[0.9, 0.2, 0.1], [0.1, 0.8, 0.2], [0.1, 0.3, 0.9]])
NEARLY_GREY = 0.5 + np.array([[0.1, 0, -0.1], [0, -0.1, 0.1], [-0.1, 0.1, 0]])


def fit_vertices(labs):
    """A triangle moves to its target by the colours inside of it, in six steps (lab 7)."""
    path = fit(labs, START, COLOURS, 6)
    off = np.linalg.norm(path[-1][0] - GOAL, axis=1).max()
    steps = [drawn(labs, *found)[0] for found in (*path[:3], path[-1], (GOAL, COLOURS))]
    path = places.out("demo", "fit_vertices", "steps.png")
    image.write(path, np.hstack(steps).repeat(8, 0).repeat(8, 1))
    yield f"{off:.1e} px off", path, ("1e-9", off <= 1e-9)


def fit(labs, triangle, colours, steps, colours_too=False):
    """[(triangle (3, 2), colours (3, 3))], steps + 1 of them: those given, and after each step.

    The residuals are at all pixels that the target covers: the colours go on beyond the triangle.
    """
    target, seen = drawn(labs, GOAL, COLOURS)
    points = np.argwhere(seen)[:, ::-1] + 0.5
    path = [(triangle, colours)]
    for _ in range(steps):
        changes = labs.vertex_gradients.fit_step(*path[-1], points, target[seen], colours_too)
        path.append(tuple(old + change for old, change in zip(path[-1], changes, strict=True)))
    return path


def drawn(labs, triangle, colours):
    """The picture (H, W, 3) of a triangle on grey, and where it is seen (H, W)."""
    clip = np.column_stack([triangle / [WIDTH / 2, HEIGHT / 2] - 1, np.zeros(3), np.ones(3)])
    face_index, _ = labs.rasterization.rasterize(clip, FACE, WIDTH, HEIGHT)
    barycentric = labs.interpolation.barycentrics(face_index, clip, FACE)
    picture = labs.interpolation.interpolate(colours, FACE, face_index, barycentric)
    picture[face_index < 0] = 0.4
    return picture, face_index >= 0
