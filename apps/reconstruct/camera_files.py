"""Where pictures were taken: transforms.json, as NeRF's tools write it, and COLMAP's binary model.

A Shot is a picture and its camera, in one convention for both. captures.py says what a user writes.
Sources: colmap.github.io/format.html and the example data of Mildenhall et al. 2020, "NeRF".
"""
import io
import json
import struct
import textwrap
from collections import ChainMap
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from course.given import image
from labkit import places

LEAST = 4  # views
NERF = "transforms.json", "transforms_train.json"
COLMAP = "cameras.bin", "sparse/*/cameras.bin", "sparse/cameras.bin"
COLMAP_MODELS = {  # by COLMAP's numbers: where fx, fy, cx, cy, k1, k2, p1, p2 are
    "SIMPLE_PINHOLE": (0, 0, 1, 2), "PINHOLE": (0, 1, 2, 3), "SIMPLE_RADIAL": (0, 0, 1, 2, 3),
    "RADIAL": (0, 0, 1, 2, 3, 4), "OPENCV": (0, 1, 2, 3, 4, 5, 6, 7)}
UNDISTORT = ("such a lens is not read, so undistort the pictures, as `colmap image_undistorter` "
             "does, and take the cameras that come with them")
BEND = "k1", "k2", "p1", "p2"
NOT_READ = ("is_fisheye", "k3", "k4", "k5", "k6", "distortion_params", "ftheta_p0", "latlong",
            "equirectangular", "orthographic", "rolling_shutter", "transform_matrix_start",
            "from_mitsuba")  # what would change a camera of transforms.json
NO_BEND = (0.0,) * len(BEND)
Y_AND_Z_TURNED = np.diag([1.0, -1.0, -1.0, 1.0])  # OpenCV's axes <-> OpenGL's


class Shot(NamedTuple):
    """A picture, and the camera that took it.

    The camera sees (x, y, z) in column cx + fx x / -z and in row cy - fy y / -z, in pixels from the
    picture's upper left corner: x is right, y is up, and it looks along -z. bend is what lenses.py
    undoes.
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
    bend: tuple = NO_BEND


class Scene(NamedTuple):
    """What a file says: Shots, in the file's order. absent: those whose pictures are not there."""

    file: str
    shots: list
    absent: list


def read(folder):
    """The Scene of a folder, in whichever of the two formats it is described.

    FileNotFoundError, OSError or ValueError, one sentence for each thing that can be wrong.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise FileNotFoundError(f"there is no folder {folder}: check its name, and the folder you "
                                f"are in ({Path.cwd()})")
    found = largest(folder, NERF) + largest(folder, COLMAP)
    if not found:
        raise FileNotFoundError(f"there is no transforms.json or COLMAP's cameras.bin in {folder}: "
                                "apps/reconstruct/README.md shows how to make one of photographs")
    require(len(found) == 1, f"{' and '.join(path.name for path in found)} in {folder} both say "
            "where the cameras are: move all but one of them away")
    file, all_shots = (nerf if found[0].suffix == ".json" else colmap)(folder, found[0])
    shots, absent = ([shot for shot in all_shots if shot.path.exists() == there]
                     for there in (True, False))
    require(len(shots) >= LEAST, f"at least {LEAST} views are needed, 20 are better, and {file} "
            f"has {len(shots)}" + "".join(f": there is no {shot.path}" for shot in absent[:1]))
    return Scene(file, shots, absent)


def largest(folder, patterns):
    """[The file for the first pattern that any fits], or []. COLMAP writes a model for each part
    of the pictures that it could join: it is the one with most in it.
    """
    fitting = next(filter(None, (list(folder.glob(pattern)) for pattern in patterns)), [])
    return sorted(fitting, key=lambda path: sum(each.stat().st_size
                                                for each in path.parent.glob("*s.*")))[-1:]


# --- NeRF's -------------------------------------------------------------------------------------


def nerf(folder, path):
    """The name of transforms.json and its Shots, as NeRF's example data, instant-ngp and Nerfstudio
    write it.
    """
    try:
        scene = json.loads(places.read_whole(path))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is no JSON: {error}") from None
    require(isinstance(scene, dict) and isinstance(scene.get("frames"), list),
            f'{path.name} must be {{"camera_angle_x": ..., "frames": [...]}}; '
            "apps/reconstruct/captures.py shows it all")
    return path.name, [nerf_shot(folder, scene, k, frame, path.name)
                       for k, frame in enumerate(scene["frames"])]


def nerf_shot(folder, scene, k, frame, file):
    """The Shot of frame k of transforms.json. What it does not say, the scene says for all."""
    require(isinstance(frame, dict) and isinstance(frame.get("file_path"), str),
            f'frame {k} in {file} needs a "file_path", the name of a picture')
    given, seen = ChainMap(frame, scene), with_ending(folder / frame["file_path"])
    require(given.get("camera_model") in (None, *COLMAP_MODELS),
            f"camera_model in {file} is {given.get('camera_model')}: {UNDISTORT}")
    for key in NOT_READ:
        value = given.get(key)
        require(not (any(value) if isinstance(value, list) else value),
                f"{key} in {file} is {short(value)}: {UNDISTORT}")
    *lens, bend = nerf_lens(given, seen, file)
    title = f"transform_matrix of {frame['file_path']} in {file}"
    name = seen.relative_to(folder) if seen.is_relative_to(folder) else seen
    return Shot(name.as_posix(), seen, *lens, pose(frame.get("transform_matrix"), title), bend)


def with_ending(path):
    """The path of a picture whose name may lack its ending: .png."""
    longer = path.parent / f"{path.name}.png"
    return longer if longer.exists() and not path.exists() else path


def nerf_lens(given, seen, file):
    """width, height, fx, fy, cx, cy, bend of the picture seen: what is given for it or for all."""
    shown = image.size(seen) if seen.exists() else (1, 1)  # `read` leaves it out
    width, height = (number(given, key, file, 1, 1e6, float(side))
                     for key, side in zip("wh", shown, strict=True))
    fx, fy = (focal_length(axis, side, given.maps, file)
              for axis, side in (("x", width), ("y", height)))
    require(fx or fy, f"{file} needs a camera_angle_x in radians, or a fl_x in pixels")
    return (width, height, fx or fy, fy or fx,
            number(given, "cx", file, -1e6, 1e6, width / 2),
            number(given, "cy", file, -1e6, 1e6, height / 2),
            tuple(number(given, key, file, -1e9, 1e9, 0.0) for key in BEND))


def focal_length(axis, side, said, file):
    """Along x or y, where a side has so many pixels. None if neither the frame nor all say it."""
    for given in said:
        if f"fl_{axis}" in given:
            return number(given, f"fl_{axis}", file, 1e-3, 1e9)
        if f"camera_angle_{axis}" in given:
            return side / 2 / np.tan(number(given, f"camera_angle_{axis}", file, 0.01, 3.1) / 2)
    return None


# --- COLMAP's -----------------------------------------------------------------------------------


def colmap(folder, path):
    """The name of images.bin and its Shots, with the lenses of cameras.bin beside it."""
    images = path.with_stem("images")
    try:
        lenses = dict(colmap_lenses(io.BytesIO(places.read_whole(path))))
        placed = [*colmap_images(io.BytesIO(places.read_whole(images)))]
    except (struct.error, IndexError, UnicodeDecodeError, OverflowError):
        raise ValueError(f"{path.name} or {images.name} is cut short, or is not as COLMAP writes it"
                         ) from None
    shots = []
    for name, camera, numbers in placed:
        require(camera in lenses, f"{name} in {images.name} has camera {camera}, which is not in "
                f"{path.name}")
        *lens, bend = lenses[camera]
        seen = next((one for one in (folder / "images" / name, folder / name) if one.exists()),
                    folder / "images" / name)
        shots.append(Shot(name, seen, *lens, colmap_pose(numbers), bend))
    return images.name, shots


def colmap_lenses(file):
    """Yield each camera's number, and its width, height, fx, fy, cx, cy, bend."""
    for _ in range(*taken(file, "Q")):
        camera, model, width, height = taken(file, "IiQQ")
        require(0 <= model < len(COLMAP_MODELS),
                f"camera {camera} in cameras.bin has COLMAP's model {model}: {UNDISTORT}")
        order = [*COLMAP_MODELS.values()][model]
        given = taken(file, f"{1 + max(order)}d")
        fx, fy, cx, cy, *bend = (given[k] for k in order)
        yield camera, (width, height, fx, fy, cx, cy, (*bend, *NO_BEND)[:len(BEND)])


def colmap_images(file):
    """Yield each picture's name, its camera's number, and QW QX QY QZ TX TY TZ."""
    for _ in range(*taken(file, "Q")):
        _, *numbers, camera = taken(file, "I7dI")
        end = file.getvalue().find(0, file.tell())
        yield file.read(end - file.tell()).decode(), camera, numbers
        points, = taken(file, "xQ")
        file.seek(24 * points, io.SEEK_CUR)


def taken(file, layout):
    """The next numbers of a file in the layout of `struct`."""
    return struct.unpack(f"<{layout}", file.read(struct.calcsize(f"<{layout}")))


def colmap_pose(numbers):
    """QW QX QY QZ TX TY TZ, from the world to OpenCV's camera -> world_from_camera (4, 4)."""
    camera_from_world = np.eye(4)
    camera_from_world[:3, :3] = Rotation.from_quat(np.roll(numbers[:4], -1)).as_matrix()
    camera_from_world[:3, 3] = numbers[4:]
    return np.linalg.inv(Y_AND_Z_TURNED @ camera_from_world)


# --- what both must be --------------------------------------------------------------------------


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
