"""A triangle finds its template by the antialiased edges alone (lab 9).

Units are pixels of a picture of SIDE x SIDE. The triangle's colour is 1, the background's is 0.
Then it turns in space, on a way from t = 0 to 1: from grey to a colour for each corner.
"""
from types import SimpleNamespace

import numpy as np

from .drawing import descended, enlarged, save
from .viewing import clip_from_world

SIDE = 64
TEMPLATE = np.array([[50.0, 50.0], [10.0, 38.0], [38.0, 8.0]])
START = np.array([[42.0, 58.0], [21.0, 22.0], [56.0, 26.0]])
TURN, PAINT = np.array([-0.1, 0.3, -0.3, 0.1]), np.eye(3) - 0.5  # ways of quaternion, colours
SLOPE = -0.018693  # how the loss changes along the way, halfway


def fit_triangle(labs):
    """A triangle moves to its template with antialiasing alone, and turns in space (lab 9)."""
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
    yield turned(labs)


def turned(labs):
    """The step of `fit_triangle` in which it turns, halfway: by its gradient, by two pictures."""
    goal, *_ = seen_turned(labs, 1)
    (ahead, _), (behind, _), (_, slope) = (loss_turned(labs, 0.5 + step, goal)
                                           for step in (1e-6, -1e-6, 0))
    slopes = slope, (ahead - behind) / 2e-6
    pictures = np.hstack([seen_turned(labs, t)[0] for t in (0, 0.5, 1)]).clip(0, 1)
    return ("turned in space: the gradient {:.6f}, by two pictures {:.6f}".format(*slopes),
            save("fit_triangle", "turned", enlarged(pictures, 4)),
            (f"both {SLOPE}", np.allclose(slopes, SLOPE, rtol=0, atol=1e-6)))


def loss_turned(labs, t, goal):
    """How far the triangle at t is from its goal, and how this changes with t."""
    lab9, (picture, *given) = labs.inverse_rendering, seen_turned(labs, t)
    loss, grad_picture = lab9.squared_error(picture, goal)
    grads = labs.pipeline.render_backward(grad_picture, *given)
    grad_pose = clip_from_world(labs, [0, 0, 2.5], aspect=1.25).T @ grads.clip_from_model
    grad_turn = lab9.quaternion_matrix_backward(grad_pose, np.eye(4)[0] + t * TURN)
    return loss, grad_turn @ TURN + (grads.material.colours * PAINT).sum()


def seen_turned(labs, t):
    """The triangle at t, in perspective: a picture, and what `render_backward` takes."""
    draws, camera = labs.pipeline, clip_from_world(labs, [0, 0, 2.5], aspect=1.25)
    pose = labs.inverse_rendering.quaternion_matrix(np.eye(4)[0] + t * TURN)
    given = (draws.make_mesh(in_space(2 * TEMPLATE / SIDE - 1), np.array([[0, 1, 2]])),
             draws.Colours(0.5 + t * PAINT), draws.View(camera @ pose, 80, SIDE, np.zeros(3)))
    picture, buffers = draws.render(*given)
    return picture, buffers, *given


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
