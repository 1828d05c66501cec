"""The pictures of a lecture: what is told of them, and how they are packed."""
import base64
import io
import re

import numpy as np
from PIL import Image, ImageSequence

FEW_OFF = 12                                       # of 255; see `packed`
SMOOTH, STEP, BANDS = 2, 6, 0.001                  # of 255, and a share: `has_bands`
NARROWEST, MOST = 320, (960, 1600)                 # a picture's width and height, as displayed
MARGIN = 12                                        # dots above and below a picture


def told(source):
    """What is said of a cell's pictures, in their order: its comments `# figure: ...`."""
    comments = re.findall(r"^# (?:figure|opening): *(.*(?:\n#(?! figure:).*)*)", source,
                          re.MULTILINE)
    return [re.sub(r"\s*\n#\s*", " ", comment).strip() for comment in comments]


def pictures_of(cell):
    """The cell's outputs that show a picture, without pale ones, which have been packed before."""
    return [output for output in cell.outputs
            if "image/png" in output.get("data", {}) and "pale" not in output.metadata]


def finish(cell):
    """Pack the cell's pictures, and put beside them what is told of them."""
    for output, text in zip(pictures_of(cell), told(cell.source), strict=False):
        content, (width, height) = packed(base64.b64decode(output.data["image/png"]))
        shown = output.metadata["image/png"]["width"]
        output.data["image/png"] = base64.b64encode(content).decode()
        output.metadata["image/png"] = {"alt": text, "width": shown,
                                        "height": round(height * shown / width)}


def objection(cell):
    """What a cell's pictures lack, as a clause, or None."""
    shown, said = pictures_of(cell), told(cell.source)
    if shown and len(shown) != len(said):  # a cell that waits for an exercise draws none
        return (f"shows {len(shown)} pictures and tells of {len(said)}: write a comment "
                '"# figure: ..." for each, for those who do not see it')
    for size in (output.metadata["image/png"] for output in shown):
        if not NARROWEST <= size["width"] <= MOST[0] or size["height"] > MOST[1]:
            return (f"shows a picture of {size['width']} x {size['height']}: draw one that is "
                    f"displayed {NARROWEST} to {MOST[0]} pixels wide, and at most {MOST[1]} high")


def packed(content):
    """A PNG's bytes -> fewer bytes for the same picture to the eye, its size (width, height).

    With a palette of 256 colours where all but one dot in a thousand stay within FEW_OFF, and where
    smooth shades stay smooth (or move). White rows above and below are cut.
    """
    pictures, stay = frames(content)
    pictures = cut(pictures)
    few, off = with_palette(pictures)
    if off <= FEW_OFF and (len(few) > 1 or not has_bands(pictures[0], few[0])):
        pictures = few
    kept = io.BytesIO()
    moving = {"save_all": True, "append_images": pictures[1:], "loop": 0, "duration": stay}
    pictures[0].save(kept, "PNG", optimize=True, **(moving if len(pictures) > 1 else {}))
    return kept.getvalue(), pictures[0].size


def has_bands(picture, few):
    """Are there steps in the copy where the picture itself has none?"""
    both = np.stack([np.asarray(one.convert("RGB"), int) for one in (picture, few)])
    for axis in (1, 2):
        change, step = np.abs(np.diff(both, axis=axis)).max(axis=-1)
        if ((change <= SMOOTH) & (step >= STEP)).mean() > BANDS:
            return True
    return False


def cut(pictures):
    """Pictures without the rows above and below that are white in all of them, but for MARGIN."""
    ink = np.flatnonzero(np.min(pictures, axis=(0, 2, 3)) < 255)
    if not ink.size:
        return pictures
    width, height = pictures[0].size
    top, bottom = max(ink[0] - MARGIN, 0), min(ink[-1] + 1 + MARGIN, height)
    return [picture.crop((0, top, width, bottom)) for picture in pictures]


def with_palette(pictures):
    """Pictures (RGB) with one palette of 256 colours, and how far all but 1 in 1,000 dots are off.

    Median cut leaves white paper white, and k-means brings the other colours near their dots. For a
    film it would take hours: Pillow's goes on until at most `kmeans` of all dots change.
    """
    sheet, kmeans = Image.fromarray(np.concatenate(pictures)), 3 if len(pictures) == 1 else 0
    few = sheet.quantize(256, Image.Quantize.MEDIANCUT, kmeans, dither=Image.Dither.NONE)
    off = np.abs(np.subtract(few.convert("RGB"), sheet, dtype=int)).max(axis=-1)
    width, height = pictures[0].size
    return [few.crop((0, top, width, top + height)) for top in range(0, few.height, height)], (
        np.percentile(off, 99.9))


def frames(content):
    """A PNG's bytes -> its frames, in RGB, and how many milliseconds each is shown."""
    with Image.open(io.BytesIO(content)) as opened:
        both = [(frame.convert("RGB"), frame.info.get("duration", 0))
                for frame in ImageSequence.Iterator(opened)]
    return tuple(map(list, zip(*both, strict=True)))
