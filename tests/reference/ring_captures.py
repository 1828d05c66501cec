"""A ring at (1, 2, 3) from six sides, as folders of pictures in the three formats."""
import functools
import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.experiments.folder import captures
from course.experiments.scenes import demo
from course.given import image, mesh

LABS = demo.Labs("reference")
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
    seen = LABS.scanline.rasterize(clip, faces, width, height)[0] >= 0
    return np.dstack([np.full((height, width, 3), 0.5), seen])


def photograph(folder, pictures=None, names="{}.png"):
    """Write the pictures 0.png, 1.png, ... into a folder, and give it."""
    folder.mkdir(exist_ok=True)
    for k in range(len(SIDES)):
        image.write(folder / names.format(k), picture(k) if pictures is None else pictures[k])
    return folder


def views(matrices, picture="{}.png"):
    """What cameras.json says of pictures with these matrices."""
    return [{"picture": picture.format(k), "world_from_camera": np.asarray(matrix).tolist()}
            for k, matrix in enumerate(matrices)]


def frames(matrices, picture="./{}"):
    """What transforms.json says of them."""
    return [{"file_path": picture.format(k), "transform_matrix": np.asarray(matrix).tolist()}
            for k, matrix in enumerate(matrices)]


def ours(folder, **changes):
    """Write cameras.json, and give its folder."""
    return written(folder, "cameras.json", {"fov_y": FOV_Y, "views": views(POSES), **changes})


def nerf(folder, **changes):
    """Write transforms.json, and give its folder."""
    angle = 2 * np.arctan(WIDTH / 2 / F)
    scene = {"camera_angle_x": angle, "frames": frames(POSES), **changes}
    return written(folder, "transforms.json", scene)


def colmap(folder, camera=f"1 SIMPLE_PINHOLE {WIDTH} {HEIGHT} {F!r} {WIDTH / 2} {HEIGHT / 2}",
           pictures=None):
    """Write COLMAP's cameras.txt and images.txt, and give their folder."""
    folder.mkdir(exist_ok=True, parents=True)
    lines = ["# Image list with two lines of data per image:"]
    for k, (name, view) in enumerate(zip(pictures or NAMES, VIEWS, strict=False)):
        opencv = np.diag([1, -1, -1, 1]) @ view
        x, y, z, w = Rotation.from_matrix(opencv[:3, :3]).as_quat()
        numbers = " ".join(repr(float(number)) for number in (w, x, y, z, *opencv[:3, 3]))
        lines += [f"{k + 1} {numbers} 1 {name}", "1.5 2.5 -1 3.5 4.5 7" if k == 1 else ""]
    (folder / "cameras.txt").write_text(f"# Camera list\n{camera}\n")
    (folder / "images.txt").write_text("\n".join(lines))
    return folder


def written(folder, file, scene):
    """A JSON file in a folder, which is given back. What is None is left out."""
    scene = {key: value for key, value in scene.items() if value is not None}
    folder.mkdir(exist_ok=True)
    (folder / file).write_text(json.dumps(scene))
    return folder


def told(folder):
    """The one sentence on what is wrong with a folder."""
    with pytest.raises((ValueError, OSError)) as error:
        captures.read(LABS, folder)
    assert "\n" not in str(error.value)
    return str(error.value)
