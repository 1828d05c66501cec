"""A teapot and a ball of texture cubes, as neural_renderer draws them, and the ball's way (lab 10).

Two numbers move the ball, x and y. Its outline pulls by the sweep, its texels exactly.
"""
import numpy as np

from ..given import image, mesh
from .drawing import LIGHT, WHITE, enlarged, save
from .viewing import clip_from_world

EYE = np.array([0.4, 0.8, 2.6])
GOAL, START = np.array([0.25, -0.15, 0.0]), np.array([-0.35, 0.3, 0.0])


def cubes(labs):
    """Faces with texture cubes and light, and a ball that finds its place by the sweep (lab 10)."""
    vertices, faces = mesh.teapot()
    teapot = striped(labs, mesh.normalize(vertices), faces)
    yield "a teapot of texture cubes", save("cubes", "teapot", picture(labs, teapot, 256))
    ball = striped(labs, *small_ball())
    path = fit(labs, ball, 32)
    seen = [picture(labs, moved(ball, place), 32) for place in (START, path[-1], GOAL)]
    off = np.abs(path[-1] - GOAL).max()
    yield (f"a ball goes to its place: {off:.3f} off, in the beginning 0.6",
           save("cubes", "ball", enlarged(np.hstack(seen), 8)), ("0.02", off < 0.02))


def fit(labs, ball, size, steps=60):
    """The ball goes from START to GOAL, by what a picture of it there says: all places."""
    lab10, view = labs.texture_cubes, camera(labs, size)
    target, _ = lab10.render(moved(ball, GOAL), view)

    def gradient(place):
        scene = moved(ball, place)
        seen, buffers = lab10.render(scene, view)
        loss, grad_picture = labs.inverse_rendering.squared_error(seen, target)
        grads = lab10.render_backward(grad_picture, buffers, scene, view,
                                      labs.sweep_gradient.sweep_backward)
        return loss, grads.vertices.sum(0) * [1, 1, 0]

    rates = labs.inverse_rendering.decay(0.05, 0.1, steps)
    return [START, *(x for x, _ in labs.inverse_rendering.descend(START, gradient, rates))]


def striped(labs, vertices, faces):
    """A LitMesh whose texels show where they are in space, as stripes, red and green."""
    lab10 = labs.texture_cubes
    at = lab10.texel_barycentrics(4).reshape(-1, 3) @ vertices[faces]
    light = 0.5 + 0.4 * np.sin(9 * at[..., 1:2] + [0.0, 1.0, 2.0])
    both = lab10.both_sides(faces, light.reshape(len(faces), 4, 4, 4, 3))
    return lab10.LitMesh(vertices, *both, lab10.Lights(0.3 * WHITE, 0.7 * WHITE, LIGHT))


def small_ball():
    """A ball of 80 faces, of radius 0.5: vertices, faces."""
    vertices, faces = mesh.icosphere(80)
    return 0.5 * vertices, faces


def moved(scene, place):
    """A LitMesh, moved by place (3,)."""
    return scene._replace(vertices=scene.vertices + place)


def picture(labs, scene, size):
    """A picture (size, size, 3) of a LitMesh, to look at."""
    return image.to_srgb(labs.texture_cubes.render(scene, camera(labs, size))[0])


def camera(labs, size):
    """A View of size x size pixels, on white."""
    return labs.pipeline.View(clip_from_world(labs, EYE, fov_y=44), size, size, WHITE)
