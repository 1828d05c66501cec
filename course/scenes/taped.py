"""How the bunny stands, how far the camera zooms and where its light is: by lab 9's tape."""
from typing import NamedTuple

import numpy as np

from ..given import mesh
from .drawing import BACKGROUND, BRASS, descended, save, unit_bunny

DISTANCE, NEAR, FAR = 2.5, 0.5, 9.0
AMBIENT = 0.15


class Scene(NamedTuple):
    """What is looked for, 11 numbers: a quaternion, a translation, a focal length, a light (3,)."""

    turn: np.ndarray
    move: np.ndarray
    focal: np.ndarray
    light: np.ndarray


def picture(labs, scene, size):
    """A Scene of arrays or of Vars -> its picture. No step of it has a gradient of its own."""
    vertices, faces = unit_bunny()
    turned = labs.tape.rotation(scene.turn).T
    facing = labs.tape.on_tape("positive", (mesh.vertex_normals(vertices, faces) @ turned)
                               @ scene.light)
    colours = (facing[:, None] + AMBIENT) * BRASS
    shape = labs.pipeline.make_mesh(vertices, faces)._replace(
        positions=vertices @ turned + scene.move)
    fixed = labs.transforms.perspective(np.pi / 2, 1.0, NEAR, FAR)
    zoom = np.diag([1.0, 1.0, 0.0, 0.0])
    clip_from_world = (scene.focal * zoom + fixed * (1 - zoom)) @ labs.transforms.translate(
        np.array([0.0, 0.0, -DISTANCE]))
    view = labs.pipeline.View(clip_from_world, size, size, BACKGROUND)
    return labs.tape.render(shape, labs.pipeline.Colours(colours), view)


def gradient(labs, target):
    """The function Scene -> loss, Scene of gradients, for a picture that is wanted."""
    def of(scene):
        tape = labs.tape.Tape([], [])
        taped = Scene(*(labs.tape.Var(tape, part) for part in scene))
        loss = labs.tape.on_tape("squared_error", picture(labs, taped, len(target)), target)
        return loss.value, Scene(*labs.tape.gradients(loss, taped))

    return of
