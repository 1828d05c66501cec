"""Pictures of an object, with the cameras that took them, and the mesh that is found from them.

`python3 -m course demo reconstruct FOLDER` reads a folder of pictures and a file cameras.json:

    {"fov_y": 40.0,                        degrees from the lower to the upper border of a picture
     "centre": [0, 0, 0], "radius": 1.0,   a ball around the object, in the world
     "background": [255, 255, 255],        only for opaque pictures: what is behind the object
     "views": [{"picture": "00.png",
                "world_from_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]]}]}

A camera looks along its own -z, y is up: as OpenGL's, Blender's and NeRF's. Pictures are PNG or
JPEG, all of one size, without distortion, as they are stored: a rotation in EXIF is not looked at.
Alpha is the silhouette. Without it, what differs from the background is. PNG is better: JPEG blurs
the outline.
"""
import json
from pathlib import Path

import numpy as np
from PIL import Image

from ..given import image, places

LONGEST = 128       # pixels of a picture's longer side, to which it is made smaller
DIFFERENT = 20 / 255  # more than this from the background, in a channel, is object; less, JPEG's


def read(labs, folder):
    """A folder -> pictures, cameras (N, 4, 4), background (3,), world_from_grid (4, 4).

    pictures is a list of (H, W, 4), linear colours and coverage. A camera is clip_from_grid. The
    background is linear, too. The grid is [-1, 1]^3, and the ball around the object just fits in.

    FileNotFoundError, OSError or ValueError, one sentence for each thing that can be wrong.
    """
    folder = Path(folder)
    scene = described(folder / "cameras.json")
    fov_y, radius = number(scene, "fov_y", 1, 170), number(scene, "radius", 1e-9, 1e9, 1.0)
    centre = numbers(scene.get("centre", [0, 0, 0]), (3,), "centre")
    behind = scene.get("background")
    behind = behind if behind is None else numbers(behind, (3,), "background") / 255
    require(behind is None or ((behind >= 0) & (behind <= 1)).all(),
            "background in cameras.json must be three numbers from 0 to 255")
    found = [silhouette(folder / view["picture"], behind) for view in scene["views"]]
    sizes = sorted({picture.shape[1::-1] for picture in found})
    require(len(sizes) == 1, f"all pictures must have one size, but here are {sizes}")
    (width, height), = sizes
    world_from_grid = labs.transforms.translate(centre) @ np.diag([radius, radius, radius, 1.0])
    cameras = [camera(labs, view, np.radians(fov_y), width / height, centre, radius)
               for view in scene["views"]]
    return ([smaller(picture) for picture in found], np.array(cameras) @ world_from_grid,
            np.ones(3) if behind is None else image.to_linear(behind), world_from_grid)


def described(path):
    """cameras.json, with the views that it must have."""
    try:
        scene = json.loads(places.read_whole(path))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is no JSON: {error}") from None
    require(isinstance(scene, dict) and isinstance(scene.get("views"), list),
            'cameras.json must be {"fov_y": ..., "views": [...]}; '
            "course/experiments/captures.py shows it all")
    require(len(scene["views"]) >= 2, f"at least 2 views are needed, 20 are better, and "
            f"cameras.json has {len(scene['views'])}")
    for k, view in enumerate(scene["views"]):
        require(isinstance(view, dict) and isinstance(view.get("picture"), str),
                f'view {k} in cameras.json needs a "picture", the name of a file')
        require("world_from_camera" in view, f'view {k} ({view["picture"]}) in cameras.json needs '
                'a "world_from_camera", four rows of four numbers')
    return scene


def require(fits, sentence):
    if not fits:
        raise ValueError(sentence)


def numbers(given, shape, name):
    """A list, or lists of lists, as an array of this shape."""
    try:
        array = np.array(given)
        array = array.astype(float) if array.dtype.kind in "iuf" else np.array(np.nan)
    except (TypeError, ValueError, OverflowError):
        array = np.array(np.nan)
    expected = f"{' x '.join(map(str, shape))} finite numbers" if shape else "a finite number"
    require(array.shape == shape and np.isfinite(array).all(), f"{name} in cameras.json must be "
            f"{expected}, and is {'missing' if given is None else str(given)[:60]}")
    return array


def number(scene, name, low, high, default=None):
    value = numbers(scene.get(name, default), (), name)
    require(low <= value <= high,
            f"{name} in cameras.json must be from {low:g} to {high:g}, and is {value:g}")
    return float(value)


def silhouette(path, behind):
    """A picture (H, W, 4): linear colours on the background, else white, and coverage."""
    picture = image.read(path)
    colour, alpha = image.to_linear(picture[..., :3]), picture[..., 3:]
    if alpha.size:
        colour = colour * alpha + (1 - alpha) * (1 if behind is None else image.to_linear(behind))
    else:
        require(behind is not None, f"{path.name} has no transparency: give the colour behind the "
                'object in cameras.json, such as "background": [255, 255, 255]')
        alpha = (np.abs(picture - behind) > DIFFERENT).any(2, keepdims=True)
    require(alpha.any(), f"{path.name} shows no object: everywhere it is background")
    given = "" if behind is None else f" of the colour {np.rint(255 * behind).astype(int).tolist()}"
    require((alpha == 0).any(), f"{path.name} shows no background{given}: without silhouettes "
            "nothing says where the object ends")
    return np.concatenate([colour, alpha], 2)


def smaller(picture):
    """Means of a picture's pixels: (H, W, C) of at most LONGEST a side, an even number."""
    height, width, _ = picture.shape
    part = min(1, LONGEST / max(height, width))
    size = [max(2, 2 * round(part * side / 2)) for side in (width, height)]
    channels = [Image.fromarray(np.float32(channel)).resize(size, Image.Resampling.BOX)
                for channel in np.moveaxis(picture, 2, 0)]
    return np.stack([np.asarray(channel, float) for channel in channels], 2)


def camera(labs, view, fov_y, aspect, centre, radius):
    """clip_from_world (4, 4) of a view, which must see the ball of centre and radius."""
    name = f"world_from_camera of {view['picture']}"
    pose = numbers(view["world_from_camera"], (4, 4), name)
    turn = pose[:3, :3]
    require(np.allclose(pose[3], [0, 0, 0, 1]), f"{name} must have 0, 0, 0, 1 as its last row: is "
            "it transposed?")
    require(np.allclose(turn.T @ turn, np.eye(3), atol=1e-3), f"{name} must be a rotation and a "
            "shift: its three columns have length 1 and are at right angles")
    require(np.linalg.det(turn) > 0, f"{name} is mirrored: x is right, y is up, and the camera "
            "looks along -z")
    seen = np.linalg.inv(pose) @ np.append(centre, 1)
    require(np.linalg.norm(seen[:3]) > radius, f"the camera of {view['picture']} stands within "
            "the ball around the object: centre and radius say where that is")
    high = np.tan(fov_y / 2) * -seen[2]
    require(seen[2] < 0 and abs(seen[0]) < aspect * high and abs(seen[1]) < high,
            f"the camera of {view['picture']} does not see the object's centre: it looks along its "
            "own -z (OpenCV's and COLMAP's along +z), and the matrix leads from it to the world")
    near = max(-seen[2] - 2 * radius, 0.01 * radius)
    clip_from_camera = labs.transforms.perspective(fov_y, aspect, near, -seen[2] + 2 * radius)
    return clip_from_camera @ np.linalg.inv(pose)
