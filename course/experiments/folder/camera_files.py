"""Where pictures were taken: our cameras.json, NeRF's transforms.json and COLMAP's model.

A Shot is a picture and its camera, in one convention for all formats. captures.py says what a
user writes. Sources: the formats' own pages, colmap.github.io/format.html and the example data of
Mildenhall et al. 2020, "NeRF".
"""
import json
import textwrap
from collections import ChainMap
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from ...given import image, places
from . import colmap_binary

LEAST = 4  # views
COLMAP_PLACES = [f"{place}cameras.{ending}" for ending in ("txt", "bin")
                 for place in ("", "sparse/*/", "sparse/")]
COLMAP_MODELS = {  # where fx, fy, cx, cy, k1, k2, p1, p2 are, in the order of COLMAP's numbers
    "SIMPLE_PINHOLE": (0, 0, 1, 2), "PINHOLE": (0, 1, 2, 3), "SIMPLE_RADIAL": (0, 0, 1, 2, 3),
    "RADIAL": (0, 0, 1, 2, 3, 4), "OPENCV": (0, 1, 2, 3, 4, 5, 6, 7)}
UNDISTORT = ("such a lens is not read, so undistort the pictures, as `colmap image_undistorter` "
             "does, and take the cameras that come with them")
BEND = "k1", "k2", "p1", "p2", "k3", "k4"
NO_PINHOLE = ("is_fisheye", "k5", "k6", "distortion_params", "ftheta_p0", "latlong",
              "equirectangular", "orthographic")  # of transforms.json
NO_POSE = "rolling_shutter", "transform_matrix_start", "transform_matrix_end", "from_mitsuba"
NO_BEND = (0.0,) * len(BEND)
LARGEST = 1e12   # of all numbers: squares of them can be added
Y_AND_Z_TURNED = np.diag([1.0, -1.0, -1.0, 1.0])  # OpenCV's axes <-> OpenGL's


class Shot(NamedTuple):
    """A picture, and the camera that took it.

    The camera sees (x, y, z) in column cx + fx x / -z and in row cy - fy y / -z, in pixels from the
    picture's upper left corner: x is right, y is up, and it looks along -z. bend is what lenses.py
    undoes. mask: its file, if that is given. held_out: only the report sees the picture.
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
    mask: Path | None = None
    held_out: bool = False


class Scene(NamedTuple):
    """What a file says: Shots, in the file's order, and maybe more. background (3,) is from 0 to 1.

    upright: widths and heights are those of pictures turned as EXIF says. absent: Shots whose
    pictures are not there.
    """

    file: str
    shots: list
    upright: bool = True
    absent: tuple = ()
    background: np.ndarray | None = None
    centre: np.ndarray | None = None
    radius: float | None = None


def read(folder):
    """The Scene of a folder, in whichever of the three formats it is described.

    FileNotFoundError, OSError or ValueError, one sentence for each thing that can be wrong.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise FileNotFoundError(f"there is no folder {folder}: check its name, and the folder you "
                                f"are in ({Path.cwd()})")
    found = [(path, scene_of) for patterns, scene_of in FORMATS
             for path in largest(folder, patterns)]
    if not found:
        raise FileNotFoundError(f"there is no file cameras.json, transforms.json, or COLMAP's "
                                f"cameras.txt or cameras.bin, in {folder}: course/experiments/"
                                "folder/README.md shows how to make one of photographs")
    require(len(found) == 1, f"{' and '.join(path.name for path, _ in found)} in {folder} both say "
            "where the cameras are: move all but one of them away")
    (path, scene_of), = found
    scene = scene_of(folder, path)
    shots, absent = (tuple(shot for shot in scene.shots if shot.path.exists() == there)
                     for there in (True, False))
    count = sum(not shot.held_out for shot in shots)
    require(count >= LEAST, f"at least {LEAST} views are needed, 20 are better, and {scene.file} "
            f"has {count}" + "".join(f": there is no {shot.path}" for shot in absent[:1]))
    return scene._replace(shots=list(shots), absent=absent)


def largest(folder, patterns):
    """[The file for the first pattern that any fits], or []. COLMAP writes a model for each part
    of the pictures that it could join: it is the one with most in it.
    """
    fitting = next(filter(None, (list(folder.glob(pattern)) for pattern in patterns)), [])
    return sorted(fitting, key=lambda path: sum(each.stat().st_size
                                                for each in path.parent.glob("*s.*")))[-1:]


# --- our own ------------------------------------------------------------------------------------


def ours(folder, path):
    """The Scene of cameras.json."""
    scene = described(path, "views", '{"fov_y": ..., "views": [...]}')
    half = np.tan(np.radians(number(scene, "fov_y", path.name, 1, 170)) / 2)
    shots = []
    for view in whole(scene["views"], "view", "picture", "world_from_camera", path.name):
        seen = folder / view["picture"]
        width, height = image.size(seen, upright=True)
        f = height / 2 / half
        title = f"world_from_camera of {view['picture']} in {path.name}"
        shots.append(Shot(named(folder, seen), seen, width, height, f, f, width / 2, height / 2,
                          pose(view["world_from_camera"], title)))
    return Scene(path.name, shots, **besides(scene, path.name))


def described(path, key, expected):
    """A JSON file's object, with a list under this key."""
    try:
        scene = json.loads(places.read_whole(path))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is no JSON: {error}") from None
    require(isinstance(scene, dict) and isinstance(scene.get(key), list),
            f"{path.name} must be {expected}; course/experiments/folder/captures.py shows it all")
    return scene


def whole(views, kind, picture, matrix, file):
    """Yield the views of a JSON file. Each names its picture and has a matrix, under these keys."""
    for k, view in enumerate(views):
        require(isinstance(view, dict) and isinstance(view.get(picture), str),
                f'{kind} {k} in {file} needs a "{picture}", the name of a file')
        require(matrix in view, f'{kind} {k} ({view[picture]}) in {file} needs a "{matrix}", four '
                "rows of four numbers")
        yield view


def besides(scene, file):
    """What cameras.json and transforms.json may say of background, centre and radius."""
    background, centre, radius = (scene.get(key) for key in ("background", "centre", "radius"))
    if background is not None:
        background = numbers(background, (3,), f"background in {file}") / 255
        require(((background >= 0) & (background <= 1)).all(),
                f"background in {file} must be three numbers from 0 to 255")
    if centre is not None:
        centre = numbers(centre, (3,), f"centre in {file}")
    if radius is not None:
        radius = number(scene, "radius", file, 1e-9, 1e9)
    return {"background": background, "centre": centre, "radius": radius}


# --- NeRF's -------------------------------------------------------------------------------------


def nerf(folder, path):
    """The Scene of transforms.json, as NeRF's example data, instant-ngp and Nerfstudio write it.
    They ignore EXIF.
    """
    scene = described(path, "frames", '{"camera_angle_x": ..., "frames": [...]}')
    shots = []
    for frame in whole(scene["frames"], "frame", "file_path", "transform_matrix", path.name):
        seen, given = with_ending(folder / frame["file_path"]), ChainMap(frame, scene)
        require_pinhole(given, path.name)
        *lens, bend = nerf_lens(given, seen, path.name)
        matrix = pose(frame["transform_matrix"],
                      f"transform_matrix of {frame['file_path']} in {path.name}")
        mask = given.get("mask_path") and folder / str(given["mask_path"])
        shots.append(Shot(named(folder, seen), seen, *lens, matrix, bend, mask))
    tests = path.with_name("transforms_test.json")
    if path.name == "transforms_train.json" and tests.exists():
        shots += [shot._replace(held_out=True) for shot in nerf(folder, tests).shots]
    return Scene(path.name, shots, upright=False, **besides(scene, path.name))


def with_ending(path):
    """The path of a picture whose name may lack its ending: .png."""
    longer = path.parent / f"{path.name}.png"
    return longer if longer.exists() and not path.exists() else path


def require_pinhole(given, file):
    """ValueError for what would change a camera, and is not read."""
    camera_model = given.get("camera_model")
    require(camera_model in (None, *COLMAP_MODELS),
            f"camera_model in {file} is {camera_model}: {UNDISTORT}")
    for keys, advice in ((NO_PINHOLE, UNDISTORT), (NO_POSE, "cameras stand still, and look along "
                         "their own -z, so give each frame one transform_matrix")):
        for key in keys:
            value = given.get(key)
            require(not (any(value) if isinstance(value, list) else value),
                    f"{key} in {file} is {short(value)}: {advice}")


def nerf_lens(given, seen, file):
    """width, height, fx, fy, cx, cy, bend of the picture seen: what is given for it or for all."""
    shown = image.size(seen) if seen.exists() else (1, 1)  # `read` leaves it out
    width, height = (number(given, key, file, 1, 1e6, float(side))
                     for key, side in zip("wh", shown, strict=True))
    fx, fy = (focal_length(axis, side, given.maps, file)
              for axis, side in (("x", width), ("y", height)))
    require(fx or fy, f"{file} needs a camera_angle_x in radians, a x_fov in degrees, or a fl_x in "
            "pixels")
    return (width, height, fx or fy, fy or fx,
            number(given, "cx", file, -1e6, 1e6, width / 2),
            number(given, "cy", file, -1e6, 1e6, height / 2),
            tuple(number(given, key, file, -1e9, 1e9, 0.0) for key in BEND))


def focal_length(axis, side, said, file):
    """Along x or y, where a side has so many pixels. None if neither the frame nor all say it."""
    for given in said:
        if f"fl_{axis}" in given:
            return number(given, f"fl_{axis}", file, 1e-3, 1e9)
        for key, low, high, radians in ((f"{axis}_fov", 1, 170, np.pi / 180),
                                        (f"camera_angle_{axis}", 0.01, 3.1, 1)):
            if key in given:
                return side / 2 / np.tan(number(given, key, file, low, high) * radians / 2)
    return None


# --- COLMAP's -----------------------------------------------------------------------------------


def colmap(folder, path):
    """The Scene of COLMAP's cameras, and of its images beside them. COLMAP ignores EXIF."""
    lenses = dict(colmap_lens(line, path.name) for line in lines_of(path) if line.split())
    images = path.with_stem("images")
    lines = lines_of(images)
    while lines and not lines[-1].split():
        lines.pop()
    shots = []
    for line, points in zip(lines[::2], [*lines[1::2], ""], strict=False):
        words = line.split(maxsplit=9)
        require(len(words) == 10 and len(points.split()) % 3 == 0, f"{images.name} must have two "
                "lines for each picture: IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, and its "
                f"points, which may be an empty line, and here is {short(line)!r}")
        name = words[9].strip()
        require(words[8] in lenses, f"{name} in {images.name} has camera {words[8]}, which is not "
                f"in {path.name}")
        seen = next((one for one in (folder / "images" / name, folder / name) if one.exists()),
                    folder / "images" / name)
        *lens, bend = lenses[words[8]]
        shots.append(Shot(name, seen, *lens, colmap_pose(words[1:8], f"{name} in {images.name}"),
                          bend))
    return Scene(images.name, shots, upright=False)


def lines_of(path):
    """The lines of a text file that are no comments, or those for which a binary one stands."""
    content = places.read_whole(path)
    if path.suffix == ".bin":
        return colmap_binary.lines(path.name, content)
    lines = content.decode(errors="replace").splitlines()
    return [line for line in lines if not line.lstrip().startswith("#")]


def colmap_lens(line, file):
    """CAMERA_ID MODEL WIDTH HEIGHT PARAMS -> its id, and width, height, fx, fy, cx, cy, bend."""
    words = line.split()
    camera, model = [*words, ""][:2]
    title = f"camera {camera} in {file}"
    require(model in COLMAP_MODELS, f"{title} is a {model or 'nothing'}: {UNDISTORT}")
    order = list(COLMAP_MODELS[model])
    given = numbers(words[2:], (3 + max(order),), title, "U")
    require((given[:max(order[:2]) + 3] >= 1).all(),
            f"{title} must have a width, a height and a focal length of at least 1")
    fx, fy, cx, cy, *bend = given[2:][order]
    return camera, (*given[:2], fx, fy, cx, cy, (*bend, *NO_BEND)[:len(BEND)])


def colmap_pose(words, title):
    """QW QX QY QZ TX TY TZ, from the world to OpenCV's camera -> world_from_camera (4, 4)."""
    given = numbers(words, (7,), f"QW QX QY QZ TX TY TZ of {title}", "U")
    length = np.linalg.norm(given[:4])
    require(abs(length - 1) < 1e-2, f"QW QX QY QZ of {title} must have length 1, and has "
            f"{length:.3g}")
    camera_from_world = np.eye(4)
    camera_from_world[:3, :3] = Rotation.from_quat(given[[1, 2, 3, 0]]).as_matrix()
    camera_from_world[:3, 3] = given[4:]
    return np.linalg.inv(Y_AND_Z_TURNED @ camera_from_world)


FORMATS = ((("cameras.json",), ours), (("transforms.json", "transforms_train.json"), nerf),
           (COLMAP_PLACES, colmap))

# --- what all of them must be -------------------------------------------------------------------


def require(fits, sentence):
    """ValueError with this sentence, unless it fits."""
    if not fits:
        raise ValueError(sentence)


def named(folder, path):
    """A picture's name: its path from the folder, where it lies in there."""
    return (path.relative_to(folder) if path.is_relative_to(folder) else path).as_posix()


def numbers(given, shape, title, kinds="iuf"):
    """A list, or lists of lists, as an array of this shape. kinds: NumPy's, of what is given."""
    try:
        array = np.array(given)
        array = array.astype(float) if array.dtype.kind in kinds else np.array(np.nan)
    except (TypeError, ValueError, OverflowError):
        array = np.array(np.nan)
    expected = f"{' x '.join(map(str, shape))} finite numbers" if shape else "a finite number"
    shown = "missing" if given is None else short(given)
    require(array.shape == shape and np.isfinite(array).all(),
            f"{title} must be {expected}, and is {shown}")
    require((np.abs(array) <= LARGEST).all(),
            f"{title} must be from {-LARGEST:g} to {LARGEST:g}, and is {shown}")
    return array


def short(given):
    """In at most 60 letters, with whole numbers."""
    return textwrap.shorten(str(given).replace("'", ""), 60, placeholder=" ...")


def number(scene, key, file, low, high, default=None):
    """The number that a file gives under this key, from low to high."""
    value = numbers(scene.get(key, default), (), f"{key} in {file}")
    require(low <= value <= high,
            f"{key} in {file} must be from {low:g} to {high:g}, and is {value:g}")
    return float(value)


def pose(given, title):
    """world_from_camera (4, 4): a rotation and a shift."""
    matrix = numbers(given, (4, 4), title)
    turn = matrix[:3, :3]
    require(np.allclose(matrix[3], [0, 0, 0, 1]), f"{title} must have 0, 0, 0, 1 as its last row: "
            "is it transposed?")
    require(np.allclose(turn.T @ turn, np.eye(3), atol=1e-3), f"{title} must be a rotation and a "
            "shift: its three columns have length 1 and are at right angles")
    require(np.linalg.det(turn) > 0, f"{title} is mirrored: x is right, y is up, and the camera "
            "looks along -z")
    return matrix
