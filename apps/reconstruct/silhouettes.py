"""Pictures on disk, as lab 16's search takes them: small, of one size, on one background, cut out.

What is the object in a picture is said by its alpha, else by a mask, else by the background's
colour. Colours become linear light before they are averaged. As many pictures as there are, only
one is in memory at its full size.
"""
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image

from course.given import image

from .camera_files import require

DIFFERENT = 20 / 255  # more than this from the background, in a channel, is object; less, JPEG's
ALIKE = 0.75          # the part of a picture's border that must be of the background's colour
HANDFUL = 4           # pixels of the border that may show something: dust
LINEAR = image.to_linear(np.arange(256) / 255)


class Source(NamedTuple):
    """A Shot of the size of its picture, whether EXIF's turn is followed, and its mask's path."""

    shot: tuple
    upright: bool
    mask: Path | None


def cut_out(folder, scene, longest):
    """A Scene -> its Shots, of the pictures that come out, the pictures (H, W, 4), the background's
    linear colour (3,), and sentences on what was not given.

    The longer side has at most so many pixels. All have one size: smaller ones have a frame.
    """
    sources, turned = oriented(folder, scene)
    background, guessed = behind(sources)
    white = np.ones(3) if background is None else background
    small = [(resized(source.shot, *within(*source.shot[2:4], longest)),
              cut(source, background, image.to_linear(white), longest)) for source in sources]
    require_whole(small)
    width, height = (-(-max(shot[side] for shot, _ in small) // 4) * 4 for side in (2, 3))
    framed = [frame(shot, picture, image.to_linear(white), width, height)
              for shot, picture in small]
    shots, pictures = (list(column) for column in zip(*framed, strict=True))
    return shots, pictures, image.to_linear(white), turned + guessed


# --- which way up, and which size ---------------------------------------------------------------


def oriented(folder, scene):
    """A Scene -> a Source for each Shot, and sentences on those that are not as the file says."""
    sources = [fitting(folder, shot, scene) for shot in scene.shots]
    odd = [one.shot.name for one in sources if one.upright]
    scaled = [one.shot for one, shot in zip(sources, scene.shots, strict=True)
              if one.shot[2:4] != shot[2:4]]
    notes = []
    if scene.absent:
        notes.append(f"{some([shot.name for shot in scene.absent])} is not there, and is left out "
                     f"of {scene.file}")
    if odd:
        notes.append(f"EXIF turns {some(odd)}: {scene.file} describes the picture as it is shown, "
                     "and so it is read")
    if scaled:
        notes.append(f"{some([shot.name for shot in scaled])} is not of the size that {scene.file} "
                    f"says, but {scaled[0].width} x {scaled[0].height}: its camera is scaled")
    return sources, notes


def fitting(folder, shot, scene):
    """The Source of a Shot: its picture as shown or as stored, whichever has the camera's shape."""
    sizes = []
    for upright in (False, True):
        width, height = image.size(shot.path, upright)
        if abs(height * shot.width - shot.height * width) <= max(width, shot.width):
            return Source(resized(shot, width, height), upright, mask_of(folder, shot))
        sizes.append(f"{width} x {height}")
    raise ValueError(f"{shot.name} has {sizes[0]} pixels, and {scene.file} says {shot.width:g} x "
                     f"{shot.height:g}, which is another shape: cameras are those of the pictures "
                     "as they are here, neither cropped nor turned")


def resized(shot, width, height):
    """A Shot of the same picture with another number of pixels."""
    across, down = width / shot.width, height / shot.height
    return shot._replace(width=width, height=height, fx=shot.fx * across, cx=shot.cx * across,
                         fy=shot.fy * down, cy=shot.cy * down)


def frame(shot, picture, background, width, height):
    """A Shot and its picture (H, W, 4), with background around it: of this width and height."""
    left, below = (width - shot.width) // 2, (height - shot.height) // 2
    above = height - shot.height - below
    framed = np.tile(np.append(background, 0.0), (height, width, 1))
    framed[below:height - above, left:left + shot.width] = picture
    return shot._replace(width=width, height=height, cx=shot.cx + left, cy=shot.cy + above), framed


def some(names):
    """a.png, or a.png (and 3 more)."""
    return names[0] + (f" (and {len(names) - 1} more)" if len(names) > 1 else "")


# --- what is object, and what is behind it ------------------------------------------------------


def mask_of(folder, shot):
    """The path of a Shot's mask, or None where there are no masks: masks/a.jpg.png, masks/a.png."""
    masks, name = folder / "masks", Path(shot.name).name
    if not masks.is_dir():
        return None
    long, short = masks / f"{name}.png", masks / f"{Path(name).stem}.png"
    return long if long.exists() else short


def opened(source):
    """A Source -> its colours (H, W, 3), encoded, and coverage (H, W), or None if nothing says it.

    An alpha that is 1 everywhere says nothing.
    """
    picture = image.read(source.shot.path, source.upright)
    colour, alpha = picture[..., :3], picture[..., 3:]
    if alpha.size and alpha.min() < 1:
        return colour, alpha[..., 0]
    if source.mask is None:
        return colour, None
    require(source.mask.exists(), f"{source.shot.name} has no mask {source.mask.name}: put it into "
            f"{source.mask.parent.name}/, as the others have one")
    mask = image.read(source.mask)
    require(mask.shape[:2] == colour.shape[:2], f"the mask {source.mask.name} has {size_of(mask)} "
            f"pixels, and {source.shot.name} has {size_of(colour)}: both must be the same, and "
            "turned the same way")
    return colour, mask[..., :3].mean(2) * (mask[..., 3] if mask.shape[2] == 4 else 1)


def size_of(picture):
    """(H, W, C) in words."""
    return f"{picture.shape[1]} x {picture.shape[0]}"


def behind(sources):
    """The background's colour (3,), encoded, or None if it is not needed, and what was assumed."""
    seen = {}
    for source in sources:
        colour, coverage = opened(source)
        if coverage is None:
            seen[source.shot.name] = border(colour)
    if not seen:
        return None, []
    means = np.array([np.median(pixels, axis=0) for pixels in seen.values()])
    background = np.median(means, axis=0)
    for (name, pixels), mean in zip(seen.items(), means, strict=True):
        require_even(name, pixels, mean, background)
    return background, [f"the background is taken to be {in_words(background)}, as it is along the "
                        f"borders of the {len(seen)} pictures without transparency"]


def require_even(name, pixels, mean, background):
    """ValueError unless a border (N, 3) of this mean colour is of the background's."""
    advice = ("nothing says what is object: save pictures with transparency, put masks into "
              "masks/, white for the object, as apps/reconstruct/README.md does, or take "
              "pictures before one even colour")
    even = (np.abs(pixels - mean) <= DIFFERENT).all(1).mean() >= ALIKE
    require(even, f"{name} has no transparency, and many colours along its border: {advice}")
    require((np.abs(mean - background) <= DIFFERENT).all(), f"{name} has no transparency, and "
            f"{in_words(mean)} along its border, not {in_words(background)} as the others have: "
            f"{advice}")


def in_words(colour):
    """An encoded colour (3,) as bytes."""
    return str(np.rint(255 * np.asarray(colour)).astype(int).tolist())


def border(picture):
    """The outermost pixels of a picture (H, W, ...): (N, ...)."""
    return np.concatenate([picture[0], picture[-1], picture[1:-1, 0], picture[1:-1, -1]])


# --- the small picture --------------------------------------------------------------------------


def cut(source, background, white, longest):
    """A Source as a picture (H, W, 4), reduced: linear colours before white (3,), and coverage.

    background (3,) is the encoded colour of what is no object, where nothing else says that.
    """
    name, (colour, coverage) = source.shot.name, opened(source)
    if coverage is None:
        coverage = unlike(colour, background)
    require(coverage.any(), f"{name} shows no object: everywhere it is background")
    require((coverage == 0).any(), f"{name} shows no background: without silhouettes nothing says "
            "where the object ends")
    light = [smaller(linear(colour[..., k]) * coverage, longest) for k in range(3)]
    covered = smaller(coverage, longest)[..., None]
    return np.concatenate([np.stack(light, 2) + (1 - covered) * white, covered], 2)


def unlike(colour, background):
    """Where a picture (H, W, 3) is not of the background's colour, 1, else 0: (H, W)."""
    # One channel after the other: large pictures are many times faster.
    return np.logical_or.reduce([np.abs(colour[..., k] - background[k]) > DIFFERENT
                                 for k in range(3)]).astype(float)


def linear(channel):
    """Encoded numbers of 8 bits (H, W) as light: `image.to_linear`, looked up."""
    return LINEAR[np.rint(255 * channel).astype(np.uint8)]


def smaller(channel, longest):
    """Means of a picture's pixels (H, W): of at most so many a side."""
    size = within(*channel.shape[::-1], longest)
    reduced = Image.fromarray(np.float32(channel)).resize(size, Image.Resampling.BOX)
    return np.asarray(reduced, float)


def within(width, height, longest):
    """A size of the same shape, of at most so many pixels a side."""
    part = min(1, longest / max(width, height))
    return [max(1, round(part * side)) for side in (width, height)]


def require_whole(small):
    """ValueError where the objects of Shots with pictures (H, W, 4) go on beyond the border."""
    shown = [border(picture[..., 3]) > 0.5 for _, picture in small]
    require(np.median([each.mean() for each in shown]) < ALIKE, "most borders are object: masks "
            "or transparency look inverted, white and opaque are for the object")
    names = [shot.name for (shot, _), each in zip(small, shown, strict=True)
             if each.sum() > HANDFUL]
    require(not names, f"the object is cut off by the border of {', '.join(names)}: leave such "
            "pictures out, or mend their masks, white for the object")
