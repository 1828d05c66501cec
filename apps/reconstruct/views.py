"""How good a mesh is: pictures that its search did not see, beside its renderings."""
from typing import NamedTuple

import numpy as np

from course.given import image
from course.scenes import drawing, photographs

SAMPLES = 2     # squared: how many in a pixel of a rendering
DIFFERENCE = 4  # how often a difference is enlarged
SHOWN = 8       # views on the sheet, at most
WIDTH = 192     # pixels of a view on the sheet, at least


class View(NamedTuple):
    """A picture of the folder and its rendering (H, W, 4): sRGB and coverage."""

    name: str
    picture: np.ndarray
    rendering: np.ndarray


def judged(labs, surface, colours, photos, chosen):
    """The Views of a Surface in linear colours (V, 3), of the pictures with these numbers."""
    renderings = photographs.seen(
        labs, surface, labs.multi_view_fit.covering(colours), photos.cameras[chosen],
        photos.pictures[0].shape[:2], np.array([1.0, 1, 1, 0]), SAMPLES)
    return [View(photos.names[k], on_screen(photos.pictures[k]), on_screen(rendering))
            for k, rendering in zip(chosen, renderings, strict=True)]


def on_screen(picture):
    """Linear colours and coverage (H, W, 4) -> colours as a screen takes them, and coverage."""
    return np.dstack([image.to_srgb(np.clip(picture[..., :3], 0, 1)), picture[..., 3]])


def psnr(views):
    """The PSNR of views in dB, over the pixels in which pictures show the object."""
    squared = [(picture - rendering)[picture[..., 3] > 0, :3]**2 for _, picture, rendering in views]
    return image.decibels(max(np.concatenate(squared).mean(), 1e-10))


def iou(view):
    """The intersection over union of the silhouettes."""
    return image.intersection_over_union(*(each[..., 3] >= 0.5 for each in view[1:]))


def write_sheet(views, path):
    """The worst views, worst first: picture, rendering, and their difference, white where there is
    none. -> a line for each, from above.
    """
    worst = sorted(views, key=lambda view: psnr([view]))[:SHOWN]
    times = -(-WIDTH // worst[0].picture.shape[1])
    pictures, renderings = (drawing.enlarged(np.vstack([view[k][..., :3] for view in worst[::-1]]),
                                             times) for k in (1, 2))
    drawing.save_labelled(path, {
        "picture": pictures, "rendering": renderings,
        f"difference x {DIFFERENCE}": 1 - np.clip(
            DIFFERENCE * np.abs(pictures - renderings), 0, 1)})
    return [f"  {view.name}: {psnr([view]):.1f} dB on the object, silhouette's IoU {iou(view):.3f}"
            for view in worst]
