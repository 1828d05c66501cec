"""Pictures as arrays: image[row, column, channel], float64 from 0 to 1, row 0 at the bottom.

Files hold the top row first. `_turned_over` alone turns pictures over.
"""
import io
from pathlib import Path

import numpy as np
from PIL import ExifTags, Image, ImageOps

from labkit import places

# Where the two pieces of the sRGB curve meet. The standard rounds it to 0.0031308, which leaves a
# step of 3e-8 and so a curve without an exact inverse.
SRGB_JOIN = 0.0031306684425005758


def read(path, upright=False):
    """A picture file with 8 bits a channel -> image (H, W, 3), or (H, W, 4) if it has alpha.

    Grey becomes three equal channels. The numbers stay as encoded: see `to_linear`. upright: turned
    as EXIF says, else as stored.
    FileNotFoundError or OSError for a file that cannot be opened, ValueError for one that is no
    whole picture, or whose grey has more than 8 bits. (Of colours with 16, the upper 8 are read.)
    """
    picture = _opened(path, upright)
    if picture.mode[0] in "IF":
        raise ValueError(f"cannot read {path} as a picture: it holds more than 8 bits a channel "
                         f"({picture.mode}), save it again with 8")
    alpha = picture.mode in ("LA", "PA", "RGBA") or "transparency" in picture.info
    return _turned_over(np.asarray(picture.convert("RGBA" if alpha else "RGB"))) / 255.0


def size(path):
    """(width, height) of a picture file, as stored. Errors as `read`."""
    return _opened(path, whole=False).size


def _opened(path, upright=False, whole=True):
    content = places.read_whole(path)
    try:
        picture = Image.open(io.BytesIO(content))
        if whole:
            picture.load()
        turned = picture.getexif().get(ExifTags.Base.Orientation, 1) != 1
        return ImageOps.exif_transpose(picture) if upright and turned else picture
    except Image.DecompressionBombError:
        raise ValueError(f"cannot read {path} as a picture: it has more than "
                         f"{2 * Image.MAX_IMAGE_PIXELS:,} pixels: make it smaller") from None
    except Exception:  # whatever a broken file makes the parser stumble over
        raise ValueError(f"cannot read {path} as a picture: it is broken, cut short or something "
                         "else, save it again as PNG") from None


def write(path, image):
    """image (H, W), (H, W, 1), (H, W, 3) or (H, W, 4) -> a PNG file with 8 bits a channel.

    Numbers below 0 are written as 0, above 1 as 1. The same image gives the same bytes. ValueError
    for another shape, NaN, infinity, integers above 1 or another ending than .png, OSError
    where the file cannot be written.
    """
    _check_ending(path)
    content = io.BytesIO()
    as_8_bits(image).save(content, "PNG")
    places.write_whole(path, content.getvalue())


def write_animation(path, frames, seconds_per_frame):
    """Images of one shape -> an animated PNG that runs for ever.

    Each frame as for `write`. A frame equal to the one before is stored as a longer stay. Errors
    as for `write`, and ValueError for no frames or a time outside 0.001 to 60 seconds.
    """
    _check_ending(path)
    frames = list(frames)
    pictures = [as_8_bits(frame) for frame in frames]
    if not pictures:
        raise ValueError("an animation needs at least one frame, got none")
    shapes = {np.shape(frame) for frame in frames}
    if len(shapes) > 1:
        raise ValueError(f"all frames must have one shape, got {sorted(shapes)}")
    if not 0.001 <= seconds_per_frame <= 60:
        raise ValueError(f"seconds_per_frame must be 0.001 to 60, got {seconds_per_frame}")
    content = io.BytesIO()
    pictures[0].save(content, "PNG", save_all=True, append_images=pictures[1:], loop=0,
                     duration=round(1000 * seconds_per_frame))
    places.write_whole(path, content.getvalue())


def _turned_over(rows):
    """Bottom row first <-> top row first."""
    return rows[::-1]


def as_8_bits(image):
    """An image -> Pillow's picture with 8 bits a channel. Errors as `write`."""
    image = np.asarray(image)
    _check(image)
    if image.ndim == 3 and image.shape[2] == 1:
        image = image[:, :, 0]
    eight_bits = np.rint(255 * np.clip(image.astype(np.float64), 0, 1)).astype(np.uint8)
    return Image.fromarray(np.ascontiguousarray(_turned_over(eight_bits)))


def _check(image):
    channels = image.shape[2] if image.ndim == 3 else 1
    if image.ndim not in (2, 3) or channels not in (1, 3, 4) or image.size == 0:
        raise ValueError("an image must be (H, W), (H, W, 1), (H, W, 3) or (H, W, 4), "
                         f"got {image.shape}")
    if image.dtype.kind not in "bfiu":
        raise ValueError(f"an image holds numbers from 0 to 1 or booleans, got {image.dtype}")
    if image.dtype.kind in "iu" and (image.max() > 1 or image.min() < 0):
        raise ValueError(f"an image holds numbers from 0 to 1, got {image.dtype} from "
                         f"{image.min()} to {image.max()}: divide by the largest, often 255")
    finite = np.isfinite(image)
    if not finite.all():
        row, column = np.argwhere(~finite)[0, :2]
        raise ValueError(f"the image holds {image[row, column]} at row {row}, column {column}: "
                         "replace NaN and infinity (the depth of the background) before writing")


def _check_ending(path):
    if Path(path).suffix.lower() != ".png":
        raise ValueError(f"pictures are written as .png, got {str(path)!r}")


def to_srgb(linear):
    """Light -> the number that a file or screen holds, both 0 to 1 (IEC 61966-2-1)."""
    linear = np.asarray(linear, dtype=np.float64)
    curve = 1.055 * np.maximum(linear, SRGB_JOIN) ** (1 / 2.4) - 0.055
    return np.where(linear <= SRGB_JOIN, 12.92 * linear, curve)


def to_linear(encoded):
    """The inverse of `to_srgb`."""
    encoded = np.asarray(encoded, dtype=np.float64)
    curve = ((np.maximum(encoded, 12.92 * SRGB_JOIN) + 0.055) / 1.055) ** 2.4
    return np.where(encoded <= 12.92 * SRGB_JOIN, encoded / 12.92, curve)


def intersection_over_union(a, b):
    """The share of two masks (H, W): 1 for equal ones, 0 for two that do not meet."""
    return (a & b).sum() / (a | b).sum()


def decibels(mean_square):
    """The PSNR in decibels of a mean squared error, for values from 0 to 1."""
    return -10 * np.log10(mean_square)
