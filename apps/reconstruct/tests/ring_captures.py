"""A ring at (1, 2, 3) from six sides, as a folder of pictures."""
import functools
import json

import numpy as np
import pytest

from apps.reconstruct import captures
from course.given import image, mesh
from course.given.whose import Labs

LABS = Labs("reference")
CENTRE = np.array([1.0, 2.0, 3.0])
FOV_Y = 30.0
WIDTH, HEIGHT = 48, 32
F = float(HEIGHT / 2 / np.tan(np.radians(FOV_Y) / 2))
SIDES = np.array([[0, 0, 4], [4, 1, 0], [-3, 2, -1.5], [0.5, -4, 0.5], [1, 1.5, -3.5], [0.2, 4, 1]])
VIEWS = [LABS.transforms.look_at(CENTRE + side, CENTRE, np.array([0.0, 1.0, 0.0]))
         for side in SIDES]  # OpenGL's camera_from_world
POSES = [np.linalg.inv(view) for view in VIEWS]
NAMES = [f"{k}.png" for k in range(len(SIDES))]


@functools.cache
def picture(k, width=WIDTH, height=HEIGHT, left=0.0, down=0.0):
    """View k of the ring, grey: (H, W, 4), 1 or 0 as its coverage. F grows with the height.

    The principal point is so many pixels left of and below the middle.
    """
    vertices, faces = mesh.torus(400, 0.5, 0.25)
    high = np.tan(np.radians(FOV_Y) / 2)
    pixel = 2 * high / height
    right = width / height * high
    sides = np.array([-right + left * pixel, right + left * pixel,
                      -high + down * pixel, high + down * pixel])
    clip_from_camera = LABS.transforms.frustum(*sides, 1.0, 10.0)
    clip = LABS.pipeline.to_clip(vertices + CENTRE, clip_from_camera @ VIEWS[k])
    seen = LABS.rasterization.rasterize(clip, faces, width, height)[0] >= 0
    return np.dstack([np.full((height, width, 3), 0.5), seen])


def photograph(folder, pictures=None, names="{}.png"):
    """Write the pictures 0.png, 1.png, ... into a folder, and give it."""
    folder.mkdir(exist_ok=True)
    for k in range(len(SIDES)):
        image.write(folder / names.format(k), picture(k) if pictures is None else pictures[k])
    return folder


def frames(matrices, picture="./{}"):
    """What transforms.json says of pictures with these matrices."""
    return [{"file_path": picture.format(k), "transform_matrix": np.asarray(matrix).tolist()}
            for k, matrix in enumerate(matrices)]


def nerf(folder, **changes):
    """Write transforms.json, and give its folder. What is None is left out."""
    folder.mkdir(exist_ok=True)
    scene = {"camera_angle_x": 2 * np.arctan(WIDTH / 2 / F), "frames": frames(POSES), **changes}
    (folder / "transforms.json").write_text(json.dumps(
        {key: value for key, value in scene.items() if value is not None}))
    return folder


def told(folder):
    """The one sentence on what is wrong with a folder."""
    with pytest.raises((ValueError, OSError)) as error:
        captures.read(LABS, folder)
    assert "\n" not in str(error.value)
    return str(error.value)
