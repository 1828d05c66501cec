"""Albedo and light told apart (lab 16), on pictures of a path tracer: what each part is worth.

The captures are in course/given/data/captures/. Each has 24 views in images/, and in unseen.png 8
more, the upper row, with the true albedo below.
"""
import time
from typing import NamedTuple

import numpy as np

from ..given import image, mesh
from . import hull, photographs, reconstruct
from .drawing import WHITE, save
from .viewing import cameras_around

NAMES = "duck", "bunny", "rings"
SIZE = 128        # of a view
SHOWN = 1, 3, 6  # of the 8 unseen views


class Unseen(NamedTuple):
    """Views that no search sees: linear albedo and colours (8, H, W, 3), coverage (8, H, W)."""

    albedo: np.ndarray
    colours: np.ndarray
    coverage: np.ndarray


def capture(labs, name):
    """The 24 views of an object, as lab 16's search takes them."""
    pictures = []
    for path in sorted((mesh.DATA / "captures" / name / "images").iterdir()):
        picture = image.read(path)
        colour, alpha = image.to_linear(picture[..., :3]), picture[..., 3:]
        pictures.append(np.concatenate([alpha * colour + 1 - alpha, alpha], 2))
    return labs.multi_view_fit.Capture(pictures, cameras_around(labs, len(pictures)), WHITE)


def unseen(name):
    """The Unseen of a capture."""
    rows = image.read(mesh.DATA / "captures" / name / "unseen.png")
    size = len(rows) // 2
    views = rows.reshape(2, size, 8, size, 4).swapaxes(1, 2)
    albedo, colours = image.to_linear(views[..., :3])
    return Unseen(albedo, colours, views[1, ..., 3])


def paint_and_light(labs):
    """Albedo and light told apart, on pictures of a path tracer (lab 16)."""
    lab = labs.intrinsic_decomposition
    ways = {"all of it": {}, "coloured light": {"priors": lab.PRIORS._replace(neutral=0.0)},
            "no patches": {"priors": lab.PRIORS._replace(patches=0.0)},
            "no sun": {"with_sun": False}}
    for name in NAMES:
        start = time.process_time()
        views = capture(labs, name)
        x, surface = found(labs, views, reconstruct.fine_stages(labs))
        yield f"{name}: {time.process_time() - start:.0f} s", None
        numbers, sheet = as_found(labs, x, surface, name)
        sheets, targets = [sheet], labs.multi_view_fit.targets_of(views, 1, 1)
        yield f"  the search alone: {words(numbers)}", None
        for way, settings in ways.items():
            look = lab.decompose(surface, targets, **settings)
            numbers, sheet = judged(labs, surface, look, name)
            sheets.append(sheet)
            yield f"  {way}: {words(numbers)}", None
        sheets.append(true_sheet(name))
        yield ("  from below: as found, " + ", ".join(ways) + ", truth",
               save("paint_and_light", name, image.to_srgb(np.clip(np.vstack(sheets), 0, 1))))


def found(labs, views, stages):
    """Lab 16's search in a Capture, from its hull: the Scene, and its Surface."""
    begin = hull.start(labs, views, stages[0].cells)
    for x, _ in labs.multi_view_fit.fit(views, stages, begin=begin):  # noqa: B007
        pass
    return x, labs.multi_view_fit.surface(x)


def as_found(labs, x, surface, name):
    """As `judged`, of the search alone, before its colours are told apart."""
    colours = labs.reconstruction.shade(surface.albedo, surface.normals, x.light)
    return compared(seen(labs, surface, colours, surface.albedo), unseen(name))


def judged(labs, surface, look, name):
    """How near a Surface in an Appearance is to the truth: dB of albedo and views, and a sheet."""
    colours = labs.intrinsic_decomposition.shaded_colours(surface, look)
    return compared(seen(labs, surface, colours, look.albedo), unseen(name))


def seen(labs, surface, colours, albedo):
    """The unseen views, rendered: (8, SIZE, SIZE, 6), colours and albedo on black."""
    both = labs.pipeline.Colours(np.hstack([colours, albedo]))
    return np.stack(list(photographs.seen(labs, surface, both, reconstruct.new_cameras(labs),
                                          (SIZE, SIZE), np.zeros(6), 2)))


def compared(pictures, truth):
    """Pictures (8, H, W, 6) against the Unseen, on the object: dB, and a sheet of some of them.

    The albedo is compared in linear colours, after one factor for all. Views as a screen shows.
    """
    inside = truth.coverage > 0.99
    colours, albedo = pictures[..., :3], pictures[..., 3:]
    factor = (albedo * truth.albedo)[inside].sum() / (albedo**2)[inside].sum()
    on_screen = [image.to_srgb(np.clip(part[inside], 0, 1)) for part in (colours, truth.colours)]
    numbers = {"albedo": image.decibels(((factor * albedo - truth.albedo)[inside]**2).mean()),
               "views": image.decibels((np.subtract(*on_screen)**2).mean())}
    return numbers, sheet_of(factor * albedo, colours)


def sheet_of(albedo, colours):
    """Some albedo, and beside it the same views."""
    return np.hstack([*albedo[list(SHOWN)], *colours[list(SHOWN)]])


def true_sheet(name):
    truth = unseen(name)
    alpha = truth.coverage[..., None]
    return sheet_of(alpha * truth.albedo, alpha * truth.colours)


def words(numbers):
    return ", ".join(f"{name} {value:.1f} dB" for name, value in numbers.items())
