"""Where pictures were taken: transforms.json, as NeRF's tools write it.

A Shot is a picture and its camera. captures.py says what a user writes.
Source: the example data of Mildenhall et al. 2020, "NeRF".
"""
import json
import textwrap
from collections import ChainMap
from pathlib import Path
from typing import NamedTuple

import numpy as np

from course.given import image
from labkit import places

LEAST = 4  # views
FILES = "transforms.json", "transforms_train.json"
PINHOLES = None, "SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV"
STRAIGHTEN = ("such a lens is not read: apps/reconstruct/README.md shows how COLMAP makes pictures "
              "without distortion, and their cameras")
NOT_READ = (  # what would change a camera
    "is_fisheye", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "distortion_params",
    "ftheta_p0", "latlong", "equirectangular", "orthographic", "rolling_shutter",
    "transform_matrix_start", "from_mitsuba")


class Shot(NamedTuple):
    """A picture, and the camera that took it.

    The camera sees (x, y, z) in column cx + fx x / -z and in row cy - fy y / -z, in pixels from the
    picture's upper left corner: x is right, y is up, and it looks along -z.
    """

    name: str
    path: Path
    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    world_from_camera: np.ndarray


class Scene(NamedTuple):
    """What a file says: Shots, in the file's order. absent: those whose pictures are not there."""

    file: str
    shots: list
    absent: list


def read(folder):
    """The Scene of a folder with transforms.json, as NeRF's example data, instant-ngp and
    Nerfstudio write it.

    FileNotFoundError, OSError or ValueError, one sentence for each thing that can be wrong.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise FileNotFoundError(f"there is no folder {folder}: check its name, and the folder you "
                                f"are in ({Path.cwd()})")
    path = next((folder / name for name in FILES if (folder / name).exists()), None)
    if path is None:
        raise FileNotFoundError(f"there is no transforms.json in {folder}: "
                                "apps/reconstruct/README.md shows how to make one of photographs")
    all_shots = shots_of(folder, path)
    shots, absent = ([shot for shot in all_shots if shot.path.exists() == there]
                     for there in (True, False))
    require(len(shots) >= LEAST, f"at least {LEAST} views are needed, 20 are better, and "
            f"{path.name} has {len(shots)}"
            + "".join(f": there is no {shot.path}" for shot in absent[:1]))
    return Scene(path.name, shots, absent)


def shots_of(folder, path):
    """The Shots of transforms.json."""
    try:
        scene = json.loads(places.read_whole(path))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is no JSON: {error}") from None
    require(isinstance(scene, dict) and isinstance(scene.get("frames"), list),
            f'{path.name} must be {{"camera_angle_x": ..., "frames": [...]}}; '
            "apps/reconstruct/captures.py shows it all")
    return [shot_of(folder, scene, k, frame, path.name)
            for k, frame in enumerate(scene["frames"])]


def shot_of(folder, scene, k, frame, file):
    """The Shot of frame k of transforms.json. What it does not say, the scene says for all."""
    require(isinstance(frame, dict) and isinstance(frame.get("file_path"), str),
            f'frame {k} in {file} needs a "file_path", the name of a picture')
    given, seen = ChainMap(frame, scene), with_ending(folder / frame["file_path"])
    require(given.get("camera_model") in PINHOLES,
            f"camera_model in {file} is {given.get('camera_model')}: {STRAIGHTEN}")
    for key in NOT_READ:
        value = given.get(key)
        require(not (any(value) if isinstance(value, list) else value),
                f"{key} in {file} is {short(value)}: {STRAIGHTEN}")
    title = f"transform_matrix of {frame['file_path']} in {file}"
    name = seen.relative_to(folder) if seen.is_relative_to(folder) else seen
    return Shot(name.as_posix(), seen, *lens_of(given, seen, file),
                pose(frame.get("transform_matrix"), title))


def with_ending(path):
    """The path of a picture whose name may lack its ending: .png."""
    longer = path.parent / f"{path.name}.png"
    return longer if longer.exists() and not path.exists() else path


def lens_of(given, seen, file):
    """width, height, fx, fy, cx, cy of the picture seen: what is given for it or for all."""
    shown = image.size(seen) if seen.exists() else (1, 1)  # `read` leaves it out
    width, height = (number(given, key, file, 1, 1e6, float(side))
                     for key, side in zip("wh", shown, strict=True))
    fx, fy = (focal_length(axis, side, given.maps, file)
              for axis, side in (("x", width), ("y", height)))
    require(fx or fy, f"{file} needs a camera_angle_x in radians, or a fl_x in pixels")
    return (width, height, fx or fy, fy or fx,
            number(given, "cx", file, -1e6, 1e6, width / 2),
            number(given, "cy", file, -1e6, 1e6, height / 2))


def focal_length(axis, side, said, file):
    """Along x or y, where a side has so many pixels. None if neither the frame nor all say it."""
    for given in said:
        if f"fl_{axis}" in given:
            return number(given, f"fl_{axis}", file, 1e-3, 1e9)
        if f"camera_angle_{axis}" in given:
            return side / 2 / np.tan(number(given, f"camera_angle_{axis}", file, 0.01, 3.1) / 2)
    return None


# --- what it must be ----------------------------------------------------------------------------


def require(fits, sentence):
    """ValueError with this sentence, unless it fits."""
    if not fits:
        raise ValueError(sentence)


def numbers_of(given, shape, title):
    """A list, or lists of lists, as an array of this shape."""
    try:
        array = np.array(given)
        array = array.astype(float) if array.dtype.kind in "iuf" else np.array(np.nan)
    except (TypeError, ValueError, OverflowError):
        array = np.array(np.nan)
    expected = f"{' x '.join(map(str, shape))} finite numbers" if shape else "a finite number"
    require(array.shape == shape and np.isfinite(array).all(),
            f"{title} must be {expected}, and is {'missing' if given is None else short(given)}")
    return array


def short(given):
    """In at most 60 letters, with whole numbers."""
    return textwrap.shorten(str(given), 60, placeholder=" ...")


def number(scene, key, file, low, high, default=None):
    """The number that a file gives under this key, from low to high."""
    value = numbers_of(scene.get(key, default), (), f"{key} in {file}")
    require(low <= value <= high,
            f"{key} in {file} must be from {low:g} to {high:g}, and is {value:g}")
    return float(value)


def pose(given, title):
    """world_from_camera (4, 4): a rotation and a shift."""
    matrix = numbers_of(given, (4, 4), title)
    turn = matrix[:3, :3]
    require(np.allclose(matrix[3], [0, 0, 0, 1]), f"{title} must have 0, 0, 0, 1 as its last row: "
            "is it transposed?")
    require(np.allclose(turn.T @ turn, np.eye(3), atol=1e-3), f"{title} must be a rotation and a "
            "shift: its three columns have length 1 and are at right angles")
    require(np.linalg.det(turn) > 0, f"{title} is mirrored: x is right, y is up, and the camera "
            "looks along -z")
    return matrix
