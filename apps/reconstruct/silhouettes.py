"""Pictures on disk, as lab 16's search takes them: small, of one size, on white, cut out.

What is the object in a picture is said by its alpha, else by a mask. Colours become linear light
before they are averaged. As many pictures as there are, only one is in memory at its full size.
"""
import numpy as np
from PIL import Image

from course.given import image

from .camera_files import require

INVERTED = 0.75  # a larger part of most borders is object only where masks are inverted
HANDFUL = 4      # pixels of the border that may show something: dust
LINEAR = image.to_linear(np.arange(256) / 255)


def cut_out(folder, scene, longest):
    """A Scene -> its Shots, of the pictures that come out, the pictures (H, W, 4), and sentences on
    what is not as its file says.

    The longer side has at most so many pixels. All have one size: smaller ones have a frame.
    """
    shots = [fitting(shot, scene) for shot in scene.shots]
    cuts = [cut(folder, shot, longest) for shot in shots]
    small = [(resized(shot, *picture.shape[1::-1]), picture)
             for shot, picture in zip(shots, cuts, strict=True)]
    require_whole(small)
    width, height = (-(-max(shot[side] for shot, _ in small) // 4) * 4 for side in (2, 3))
    framed = [frame(shot, picture, width, height) for shot, picture in small]
    return *(list(column) for column in zip(*framed, strict=True)), notes(scene, shots)


# --- which size ---------------------------------------------------------------------------------


def notes(scene, shots):
    """Sentences on pictures that are not there, and on Shots of another size than the Scene's."""
    scaled = [shot for shot, said in zip(shots, scene.shots, strict=True) if shot[2:4] != said[2:4]]
    if scene.absent:
        yield f"{some(scene.absent)} is not there, and is left out of {scene.file}"
    if scaled:
        yield (f"{some(scaled)} is not of the size that {scene.file} says, but {scaled[0].width} x "
               f"{scaled[0].height}: its camera is scaled")


def fitting(shot, scene):
    """The Shot with its picture's size, which has the camera's shape."""
    width, height = image.size(shot.path)
    require(abs(height * shot.width - shot.height * width) <= max(width, shot.width),
            f"{shot.name} has {width} x {height} pixels, and {scene.file} says {shot.width:g} x "
            f"{shot.height:g}, which is another shape: cameras are those of the pictures as they "
            "are stored: not cropped, and not turned as EXIF says")
    return resized(shot, width, height)


def resized(shot, width, height):
    """A Shot of the same picture with another number of pixels."""
    across, down = width / shot.width, height / shot.height
    return shot._replace(width=width, height=height, fx=shot.fx * across, cx=shot.cx * across,
                         fy=shot.fy * down, cy=shot.cy * down)


def frame(shot, picture, width, height):
    """A Shot and its picture (H, W, 4), with white around it: of this width and height."""
    left, below = (width - shot.width) // 2, (height - shot.height) // 2
    above = height - shot.height - below
    framed = np.tile([1.0, 1, 1, 0], (height, width, 1))
    framed[below:height - above, left:left + shot.width] = picture
    return shot._replace(width=width, height=height, cx=shot.cx + left, cy=shot.cy + above), framed


def some(shots):
    """a.png, or a.png (and 3 more)."""
    return shots[0].name + (f" (and {len(shots) - 1} more)" if len(shots) > 1 else "")


# --- what is object -----------------------------------------------------------------------------


def opened(folder, shot):
    """A Shot's colours (H, W, 3), encoded, and coverage (H, W). An alpha of 1 everywhere says
    nothing: then its mask does, masks/a.jpg.png or masks/a.png.
    """
    picture = image.read(shot.path)
    colour, alpha = picture[..., :3], picture[..., 3:]
    if alpha.size and alpha.min() < 1:
        return colour, alpha[..., 0]
    long, short = (folder / "masks" / f"{name}.png" for name in (shot.path.name, shot.path.stem))
    path = long if long.exists() else short
    require(path.exists(), f"{shot.name} has no transparency, and no mask masks/{path.name}, white "
            "for the object: apps/reconstruct/README.md makes masks")
    mask = image.read(path)
    require(mask.shape[:2] == colour.shape[:2], f"the mask {path.name} has {size_of(mask)} "
            f"pixels, and {shot.name} has {size_of(colour)}: both must be the same, and turned "
            "the same way")
    return colour, mask[..., :3].mean(2) * (mask[..., 3] if mask.shape[2] == 4 else 1)


def size_of(picture):
    """(H, W, C) in words."""
    return f"{picture.shape[1]} x {picture.shape[0]}"


# --- the small picture --------------------------------------------------------------------------


def cut(folder, shot, longest):
    """A Shot's picture (H, W, 4), reduced: linear colours before white, and coverage."""
    colour, coverage = opened(folder, shot)
    require(coverage.any(), f"{shot.name} shows no object: everywhere it is background")
    require((coverage == 0).any(), f"{shot.name} shows no background: without silhouettes nothing "
            "says where the object ends")
    light = [smaller(linear(colour[..., k]) * coverage, longest) for k in range(3)]
    covered = smaller(coverage, longest)[..., None]
    return np.concatenate([np.stack(light, 2) + 1 - covered, covered], 2)


def linear(channel):
    """Encoded numbers of 8 bits (H, W) as light: `image.to_linear`, looked up."""
    return LINEAR[np.rint(255 * channel).astype(np.uint8)]


def smaller(channel, longest):
    """Means of a picture's pixels (H, W): of at most so many a side."""
    reduced = Image.fromarray(np.float32(channel))
    reduced.thumbnail((longest, longest), Image.Resampling.BOX, reducing_gap=None)
    return np.asarray(reduced, float)


def require_whole(small):
    """ValueError where the objects of Shots with pictures (H, W, 4) go on beyond the border."""
    shown = [np.concatenate([each[0], each[-1], each[1:-1, 0], each[1:-1, -1]]) > 0.5
             for each in (picture[..., 3] for _, picture in small)]
    require(np.median([each.mean() for each in shown]) < INVERTED, "most borders are object: masks "
            "or transparency look inverted, white and opaque are for the object")
    names = [shot.name for (shot, _), each in zip(small, shown, strict=True)
             if each.sum() > HANDFUL]
    require(not names, f"the object is cut off by the border of {', '.join(names)}: leave such "
            "pictures out, or mend their masks, white for the object")
