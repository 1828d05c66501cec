"""Pictures of an object, with the cameras that took them: what lab 16's search is given.

`python3 -m course reconstruct FOLDER` reads a folder with pictures and transforms.json. README.md,
beside this file, makes such a folder of a phone's photographs.

transforms.json (or transforms_train.json) is as NeRF, instant-ngp and Nerfstudio write it. A matrix
is world_from_camera: columns are the camera's right, up, back (it looks along its own -z, as
OpenGL's and Blender's) and its place. A lens is camera_angle_x in radians or fl_x in pixels, and
the same with y where pixels are not square. cx, cy, w, h in pixels may be added. All of them stand
for all pictures or in a frame:

    {"camera_angle_x": 0.7, "frames": [{"file_path": "images/00.png", "transform_matrix":
     [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]]}]}

Pictures are PNG or JPEG of 8 bits, of any sizes, at least 4, and show the whole object. What is
described and is not there is left out. Pictures are read as stored: EXIF's turn is not followed.

What is the object is said by alpha, else by masks/NAME.png or masks/NAME.jpg.png, white for the
object. A ball around the object is found from the silhouettes.
"""
from pathlib import Path
from typing import NamedTuple

import numpy as np

from . import camera_files, hulls, silhouettes
from .camera_files import require


class Photos(NamedTuple):
    """What was read. The grid is [-1, 1]^3, and the ball around the object just fits in.

    names of the files, pictures (H, W, 4), linear colours on white and coverage, all of one size,
    cameras (N, 4, 4), which are clip_from_grid, world_from_grid (4, 4), and sentences on what was
    assumed or found, not given.
    """

    names: list
    pictures: list
    cameras: np.ndarray
    world_from_grid: np.ndarray
    assumed: list


def read(labs, folder: str | Path, longest: int = 128) -> Photos:
    """A folder -> Photos, made smaller: to at most so many pixels on the longer side.

    FileNotFoundError, OSError or ValueError, one sentence for each thing that can be wrong.
    """
    folder = Path(folder)
    scene = camera_files.read(folder)
    shots, pictures, notes = silhouettes.cut_out(folder, scene, longest)
    (centre, radius), found = hulls.ball(scene, shots, pictures)
    world_from_grid = labs.transforms.translate(centre) @ np.diag([radius, radius, radius, 1.0])
    cameras = [camera(labs, shot, centre, radius) for shot in shots]
    return Photos([shot.name for shot in shots], pictures, np.array(cameras) @ world_from_grid,
                  world_from_grid, [*notes, *found])


def camera(labs, shot, centre, radius):
    """clip_from_world (4, 4) of a Shot, which must have the ball before it."""
    depth = hulls.seen_at(shot, centre[None])[2][0]
    require(np.linalg.norm(centre - hulls.eye(shot)) > radius, f"the camera of {shot.name} stands "
            "within the ball around the object: is its place right?")
    near = max(depth - 2 * radius, 0.01 * radius)
    sides = np.array([-shot.cx / shot.fx, (shot.width - shot.cx) / shot.fx,
                      (shot.cy - shot.height) / shot.fy, shot.cy / shot.fy])
    clip_from_camera = labs.transforms.frustum(*near * sides, near, depth + 2 * radius)
    return clip_from_camera @ np.linalg.inv(shot.world_from_camera)
