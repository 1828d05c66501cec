"""Pictures of a mismatch: a small raster in letters, a large one as a PNG in out/checks/."""
import io

import numpy as np

from .. import places

MAP_SHAPE = 20, 40  # rows and columns of the largest raster that is printed
PANEL = 256         # pixels: a picture's panels are enlarged up to this
GAP = 12            # pixels between panels


def text_map(got, expected):
    """A row with a raster of booleans or indices in letters, top row first. None if it is large."""
    if got.ndim != 2 or got.dtype.kind not in "biu" or np.any(np.array(got.shape) > MAP_SHAPE):
        return []
    there, wanted = (raster if raster.dtype == bool else raster >= 0 for raster in (got, expected))
    letters = np.select([wanted & ~there, there & ~wanted, got != expected, there],
                        ["?", "!", "x", "#"], ".")
    meanings = {"#": "right", "?": "missing", "!": "extra", "x": "other", ".": "background"}
    legend = ", ".join(f"{letter} {meaning}" for letter, meaning in meanings.items()
                       if letter in letters)
    return [("map", "\n".join([*map("".join, letters[::-1]), f"({legend}; top row first)"]))]


def draw(got, expected, distance):
    """Write expected | got | difference as a PNG to out/checks/ -> its path."""
    path = places.check_picture("mismatch")
    distance = distance.reshape(*distance.shape[:2], -1).max(-1)
    panels = {"expected": colours(expected, expected, got), "got": colours(got, expected, got),
              "difference": difference_colours(distance)}
    worst = np.unravel_index(distance.argmax(), distance.shape)
    content = io.BytesIO()
    sheet(panels, worst).save(content, "PNG")
    places.write_whole(path, content.getvalue())
    return path


def sheet(panels, worst):
    """An image of three panels {title: (H, W, 3)} side by side. Each has a box around worst."""
    from PIL import Image, ImageDraw  # only where there is something to draw

    height, width = panels["expected"].shape[:2]
    scale = max(1, PANEL // max(height, width))
    row, column = worst
    x, y = scale * column, scale * (height - 1 - row)

    step, top = scale * width + GAP, GAP + 4
    image = Image.new("RGB", (3 * step + GAP, scale * height + top + GAP), "white")
    pen = ImageDraw.Draw(image)
    for left, (title, panel) in zip(range(GAP, 3 * step, step), panels.items(), strict=True):
        pixels = np.flipud(panel).repeat(scale, 0).repeat(scale, 1)
        image.paste(Image.fromarray(np.uint8(255 * pixels)), (left, top))
        pen.text((left, 1), title, "black")
        pen.rectangle((left + x - 2, top + y - 2, left + x + scale + 1, top + y + scale + 1),
                      outline="orange", width=2)
    return image


def colours(raster, *both):
    """(H, W) or (H, W, C) -> (H, W, 3) in 0..1, on one scale for both rasters of a picture.

    Indices become hues, -1 dark. Three channels are shown. Infinite is blue, NaN is pink.
    """
    if raster.dtype.kind in "iu" and raster.ndim == 2:
        hues = 0.6 + 0.4 * np.cos(2 * np.pi * (0.618 * raster[..., None] + np.arange(3) / 3))
        return np.where(raster[..., None] < 0, 0.15, hues)
    raster, *both = (np.atleast_3d(np.abs(r) if r.dtype.kind == "c" else r).astype(float)
                     for r in (raster, *both))
    channels = raster.shape[2]
    finite = np.concatenate([[0, 1] if channels > 1 else [], *(r[np.isfinite(r)] for r in both)])
    low, high = (finite.min(), finite.max()) if finite.size else (0, 1)
    shown_channels = {1: [0, 0, 0], 2: [0, 1, 1]}.get(channels, [0, 1, 2])
    pixels = np.clip((raster[..., shown_channels] - low) / (high - low or 1), 0, 1)
    pixels[np.isinf(raster).any(2)] = 0.2, 0.3, 0.7
    pixels[np.isnan(raster).any(2)] = 1, 0.3, 0.7
    return pixels


def difference_colours(distance):
    """Black where right, else red: the brighter, the farther off."""
    farthest = distance[np.isfinite(distance)].max(initial=0) or 1
    level = np.where(distance > 0, 0.3 + 0.7 * np.minimum(distance / farthest, 1), 0)
    return level[..., None] * [1, 0.2, 0]
