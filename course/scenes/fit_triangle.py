"""A triangle finds its template by the antialiased edges alone (lab 9).

Units are pixels of a picture of SIDE x SIDE. The triangle's colour is 1, the background's is 0.
"""
from types import SimpleNamespace

import numpy as np

from .drawing import descended, enlarged, save

SIDE = 64
TEMPLATE = np.array([[50.0, 50.0], [10.0, 38.0], [38.0, 8.0]])
START = np.array([[42.0, 58.0], [21.0, 22.0], [56.0, 26.0]])


def fit_triangle(labs):
    """A triangle moves to its template: with antialiasing alone (lab 9)."""
    goal = template(labs)
    for name, antialiased in ("without", False), ("with", True):
        x, _, gradients = fit(labs, goal, antialiased)
        yield f"{name} antialiasing, {len(gradients)} steps:", None
        largest = np.abs(gradients).max()
        off = np.linalg.norm(x[-1] - TEMPLATE, axis=1).max()
        reached = [] if antialiased else [("exactly 0", largest == 0)]
        yield f"  largest gradient {largest:.2g}", None, *reached
        reached = [("0.1", off <= 0.1)] if antialiased else []
        yield (f"  {off:.3f} px off",
               save("fit_triangle", name, enlarged(over(labs, goal, x), 8)), *reached)


def fit(labs, goal, antialiased, steps=300):
    """Three vertices move until the triangle looks like its template, goal (SIDE, SIDE, 1).

    -> vertices (steps + 1, 3, 2) in pixels, START first, the losses, gradients (steps, 3, 2).
    """
    lab9, gradients = labs.inverse_rendering, []
    mesh, material, view = scene(labs)
    renderer = labs.pipeline if antialiased else without_edges(labs)

    def gradient(x):
        moved = mesh._replace(positions=in_space(x))
        picture, buffers = renderer.render(moved, material, view)
        loss, grad_picture = lab9.squared_error(picture, goal)
        grads = renderer.render_backward(grad_picture, buffers, moved, material, view)
        gradients.append(grads.positions[:, :2])
        return loss, gradients[-1]

    path, losses = descended(labs, START, gradient, schedule(steps))
    return np.array(path), losses, np.array(gradients)


def without_edges(labs):
    """The pipeline without antialiasing: its `render` and `render_backward`."""
    pipeline = labs.pipeline

    def render(mesh, material, view):
        _, buffers = pipeline.render(mesh, material, view)
        return buffers.colour, buffers

    def render_backward(grad_picture, buffers, mesh, material, view):
        grad_material, grad_clip = pipeline.interior_backward(grad_picture, buffers, mesh.faces,
                                                            material)
        grad_positions, grad_matrix = pipeline.to_clip_backward(grad_clip, mesh.positions,
                                                                view.clip_from_model)
        return pipeline.Gradients(grad_positions, grad_material, grad_matrix)

    return SimpleNamespace(render=render, render_backward=render_backward)


def template(labs):
    """TEMPLATE as a picture (SIDE, SIDE, 1): its exact area in each pixel (lab 3)."""
    return labs.sampling.pixel_coverage(TEMPLATE, SIDE, SIDE)[..., None]


def scene(labs):
    """A white triangle on black, its positions in pixels: Mesh, Colours, View."""
    mesh = labs.pipeline.make_mesh(in_space(START), np.array([[0, 1, 2]]))
    clip_from_pixels = np.diag([2 / SIDE, 2 / SIDE, 1.0, 1.0])
    clip_from_pixels[:2, 3] = -1
    view = labs.pipeline.View(clip_from_pixels, SIDE, SIDE, np.zeros(1))
    return mesh, labs.pipeline.Colours(np.ones((3, 1))), view


def in_space(points):
    """points (3, 2) in pixels -> (3, 3), all equally deep."""
    return np.pad(points, ((0, 0), (0, 1)))


def schedule(steps):
    """The learning rate of each step, in pixels."""
    return [0.6 * 0.01**(step / steps) for step in range(1, steps + 1)]


def over(labs, goal, x):
    """The template in blue. In orange the triangle: where it began, was and ended."""
    steps = [labs.sampling.pixel_coverage(x[step], SIDE, SIDE) for step in (0, 40, -1)]
    return np.concatenate([np.stack([1 - goal[..., 0], 1 - (goal[..., 0] + step) / 2, 1 - step],
                                    -1) for step in steps], 1)
