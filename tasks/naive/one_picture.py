"""One picture, the naive answer: Adam on all 11 numbers, from a bunny that stands upright.

Run it from a copy in labs/: it uses labs 1 to 9. `python3 -m course check one_picture` scores it.
"""
from typing import NamedTuple

import numpy as np

from course.given import mesh

from . import inverse_rendering, pipeline, tape, transforms

AMBIENT, BRASS = 0.15, np.array([0.85, 0.66, 0.48])
BACKGROUND = np.array([0.93, 0.95, 0.97])


class Scene(NamedTuple):
    """What a photograph depends on: 11 numbers. Arrays, or Vars of a tape."""

    turn: np.ndarray   # a quaternion (4,)
    move: np.ndarray   # (3,), after the turn; the camera is 2.5 in front of 0
    focal: np.ndarray  # times the tangent of the angle is 1 at the picture's side
    light: np.ndarray  # (3,), towards it, as long as it is bright


def picture(scene, vertices, faces, size):
    """What the scorer draws, too, at more samples -> (size, size, 3), a Var if the Scene has any.
    """
    rotated = tape.rotation(scene.turn).T
    facing = mesh.vertex_normals(vertices, faces) @ rotated @ scene.light
    colours = (tape.on_tape("positive", facing)[:, None] + AMBIENT) * BRASS
    shape = pipeline.make_mesh(vertices, faces)._replace(
        positions=vertices @ rotated + scene.move)
    zoom = np.diag([1.0, 1.0, 0.0, 0.0])
    depth = transforms.perspective(np.pi / 2, 1.0, 0.5, 9.0) * (1 - zoom)
    camera = (scene.focal * zoom + depth) @ transforms.translate(np.array([0.0, 0.0, -2.5]))
    return tape.render(shape, pipeline.Colours(colours),
                       pipeline.View(camera, size, size, BACKGROUND))


def find(photograph, vertices, faces, steps=300):
    """photograph (64, 64, 3) of the mesh -> turn, move, focal and light, as one array (11,)."""
    def gradient(scene):
        taped = tape.Tape([], [])
        parts = Scene(*(tape.Var(taped, part) for part in scene))
        seen = picture(parts, vertices, faces, len(photograph))
        loss = tape.on_tape("squared_error", seen, photograph)
        return loss.value, Scene(*tape.gradients(loss, parts))

    scene = Scene(np.array([1.0, 0, 0, 0]), np.zeros(3), np.array(1.7), np.array([0.0, 0.0, 0.8]))
    for found, _ in inverse_rendering.descend(
            scene, gradient, inverse_rendering.decay(0.03, 0.1, steps),
            project=lambda found: found._replace(turn=found.turn / np.linalg.norm(found.turn))):
        scene = found
    return np.hstack(scene)
