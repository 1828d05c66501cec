"""How the bunny stands, how far the camera zooms and where its light is: by lab 9's tape."""
from typing import NamedTuple

import numpy as np

from ..given import mesh
from .drawing import BACKGROUND, BRASS, save, unit_bunny

AMBIENT = 0.15
STAGES = (48, 60, 0.03), (96, 80, 0.01), (128, 60, 0.003)  # size, steps, first rate


class Scene(NamedTuple):
    """11 numbers: a quaternion turn (4,), move (3,), focal, and light (3,), as long as bright."""

    turn: np.ndarray
    move: np.ndarray
    focal: np.ndarray
    light: np.ndarray


def taped(labs):
    """Pose, focal length and light from one picture, with no backward pass of their own (lab 9)."""
    runs = [example(labs, seed) for seed in range(8)]
    ends = [list(fit(labs, *run))[-1][0] for run in runs]
    off = np.array([degrees_off(labs, end, run[0]) for end, run in zip(ends, runs, strict=True)])
    seen = [picture(labs, scene, 256) for scene in (runs[5][1], ends[5], runs[5][0])]
    yield (f"30 degrees off at first, then {', '.join(f'{one:.1f}' for one in off)}",
           save("taped", "start, found, goal", np.hstack(seen)),
           ("6 of 8 under 2 degrees", (off < 2).sum() >= 6))


def picture(labs, scene, size):
    """A Scene of arrays, or of Vars, as a picture (size, size, 3)."""
    vertices, faces = unit_bunny()
    rotated = labs.tape.rotation(scene.turn).T
    facing = mesh.vertex_normals(vertices, faces) @ rotated @ scene.light
    colours = (labs.tape.on_tape("positive", facing)[:, None] + AMBIENT) * BRASS
    shape = labs.pipeline.make_mesh(vertices, faces)._replace(
        positions=vertices @ rotated + scene.move)
    zoom = np.diag([1.0, 1.0, 0.0, 0.0])
    fixed = labs.transforms.perspective(np.pi / 2, 1.0, 0.5, 9.0) * (1 - zoom)
    clip_from_world = (scene.focal * zoom + fixed) @ labs.transforms.translate(
        np.array([0.0, 0.0, -2.5]))
    return labs.tape.render(shape, labs.pipeline.Colours(colours),
                            labs.pipeline.View(clip_from_world, size, size, BACKGROUND))


def loss_of(labs, scene, target):
    """A Scene of arrays -> its squared error, a Var, and the Scene of Vars on its tape."""
    tape = labs.tape.Tape([], [])
    scene = Scene(*(labs.tape.Var(tape, part) for part in scene))
    return labs.tape.on_tape("squared_error", picture(labs, scene, len(target)), target), scene


def example(labs, seed, degrees=30):
    """A bunny seen from anywhere, tilted by 20 degrees, and a start so many degrees off."""
    rng = np.random.default_rng(seed)
    product = labs.inverse_rendering.quaternion_product
    tilt, off = turned(20, rng.normal(size=3)), turned(degrees, rng.normal(size=3))
    turn = product(tilt, turned(rng.uniform(0, 360), np.array([0.0, 1.0, 0.0])))
    light = 0.8 * mesh.unit(rng.normal(size=3) * [1, 1, 0] + [0, 0, 0.5])
    goal = Scene(turn, rng.uniform(-0.2, 0.2, 3), np.array(rng.uniform(1.4, 2.0)), light)
    return goal, Scene(product(off, turn), np.zeros(3), np.array(1.7), np.array([0.0, 0.0, 0.8]))


def turned(degrees, axis):
    """The quaternion (4,) of a rotation."""
    half = np.radians(degrees) / 2
    return np.append(np.cos(half), np.sin(half) * mesh.unit(axis))


def fit(labs, goal, scene, stages=STAGES):
    """Adam, in larger and larger pictures: yields the Scene after each step, and the loss.

    Of 24 examples 20 end less than 2 degrees off. Two of the others are in another minimum after 30
    steps, and stay there: its loss is 0.01, and that of a right end 0.00004.
    """
    lab9 = labs.inverse_rendering
    for size, steps, rate in stages:
        target = picture(labs, goal, size)

        def gradient(scene, target=target):
            loss, taped = loss_of(labs, scene, target)
            return loss.value, Scene(*labs.tape.gradients(loss, taped))

        rates = [Scene(0.7 * rate, rate, 2 * rate, 2 * rate)
                 for rate in lab9.decay(rate, 0.2, steps)]
        for step in lab9.descend(scene, gradient, rates, project=lambda found: (
                found._replace(turn=found.turn / np.linalg.norm(found.turn)))):
            yield step
            scene = step[0]


def degrees_off(labs, scene, goal):
    return np.degrees(labs.inverse_rendering.rotation_angle(scene.turn, goal.turn))
