"""Shape, albedo and light of objects that the code has never seen, from 24 pictures (lab 16).

Pictures of your own: apps/reconstruct.
"""
import itertools
import time

import numpy as np
from rich.progress import track

from labkit import places

from ..given import distances, image, mesh
from .drawing import WHITE, save_labelled, unit_bunny
from .photographs import Painted, daylight, found_object, lamps, photographs, portrait
from .viewing import cameras_around

TWO_RINGS = ("smooth union", 0.1, *(("moved", np.array([x, 0.0, 0.0]), ("torus", 0.34, 0.15))
                                    for x in (-0.4, 0.4)))
BUNNY_SIZE = 0.85


def reconstruct(labs):
    """Shape, albedo and light from 24 pictures (lab 16)."""
    rings = ring_stages(labs)
    for name, stages, seconds, genus, percent in (
            ("ring", rings, 180, 1, 1.0), ("two rings", rings, 180, 2, 1.0),
            ("bunny", fine_stages(labs), 360, 0, 1.2)):
        camera, frames = new_cameras(labs)[5], []
        start, steps = time.process_time(), sum(stage.steps for stage in stages)
        found = track(fit(labs, name, stages), name, total=steps, transient=True)
        for step, (x, _) in enumerate(found, 1):
            if step % 5 == 1 or step == steps:
                frames.append(portrait(labs, x, camera, 128))
        spent = time.process_time() - start
        path = places.out("demo", "reconstruct", f"{name.replace(' ', '_')}_on_its_way.png")
        image.write_animation(path, frames + 12 * frames[-1:], 0.12)
        yield f"{name}: {spent:.0f} s", path, (f"{seconds} s", spent <= seconds)
        yield from compared(labs, x, name, genus, percent)


def ring_stages(labs):
    """Lab 16's Stages of searches for what has holes."""
    stage = labs.multi_view_fit.Stage
    return stage(16, 2, 1, 80, 1.0), stage(24, 2, 1, 60, 0.5), stage(32, 1, 1, 60, 0.3)


def fine_stages(labs, size=128):
    """Lab 16's Stages of the searches that are to be seen from near, in pictures of this size.

    Larger pictures have a fourth. Its cells are as wide as 2.7 pixels, but for memory's sake 96 at
    most.
    """
    stage, cells = labs.multi_view_fit.Stage, min(3 * size // 8, 96)
    fine = samples(size, 384)
    coarse = (stage(24, 1, 1, 100, 1.0), stage(32, 1, 1, 80, 0.5), stage(48, 1, fine, 120, 0.3))
    return coarse if cells <= 48 else (*coarse, stage(cells, 1, fine, 100, 0.3))


def samples(size, width):
    """Along a pixel's side, so that pictures are about so wide as they are rendered: 2 to 4."""
    return min(max(2, round(width / size)), 4)


def compared(labs, x, name, genus, percent):
    """What was found, beside the truth and lab 16's goals."""
    found = judged(labs, x, name)
    pieces, holes = found["pieces, genus"]
    off = 100 * found["distance"]
    yield f"  pieces {pieces}, genus {holes}", None, (f"1, {genus}", (pieces, holes) == (1, genus))
    yield f"  {off:.2f} % of the diagonal off", None, (f"{percent} %", off <= percent)
    for title, least in ("new views", 27), ("relit", 24):
        yield f"  {title}: {found[title]:.1f} dB", None, (f"{least} dB", found[title] >= least)
    scale = " ".join(f"{factor:.2f}" for factor in found["scale"])
    yield f"  light {found['light']:.0%} off, up to factors {scale}", None
    columns = [np.vstack([picture[..., :3] for picture in pictures[::2]])
               for pictures in found["pictures"]]
    yield "  new views, beside the truth", save_labelled(
        places.out("demo", "reconstruct", f"{name.replace(' ', '_')}.png"),
        {label: image.to_srgb(np.clip(column, 0, 1)) for label, column in zip(
            ("found", "truth", "found, relit", "truth, relit"), columns, strict=True)})


def fit(labs, name, stages, size=128, count=24, **settings):
    """What lab 16's `fit` yields, for pictures of one of the `unseen` objects by daylight."""
    cameras = cameras_around(labs, count)
    pictures = photographs(labs, unseen(labs, name), daylight(labs), cameras, size)
    capture = labs.multi_view_fit.Capture(pictures, cameras, WHITE)
    return labs.multi_view_fit.fit(capture, stages, **settings)


def new_cameras(labs):
    """8 cameras that the search did not have."""
    return cameras_around(labs, 8, longitude=1.1)


# --- what is photographed, and in what light ----------------------------------------------------


def unseen(labs, name):
    """An object to reconstruct, "ring", "two rings" or "bunny": a Painted."""
    if name == "ring":
        vertices, faces = mesh.torus(60_000, 0.6, 0.25)
    elif name == "two rings":
        lab15 = labs.marching_tetrahedra
        points, tetrahedra = lab15.tetrahedral_grid(72)
        distance = labs.implicit_surfaces.signed_distance(points, TWO_RINGS)
        vertices, faces, _ = lab15.marching_tetrahedra(points, distance, tetrahedra)
    else:
        vertices, faces = mesh.split_longest(*unit_bunny(), 60_000)
        vertices = BUNNY_SIZE * vertices
    return Painted(vertices, faces, paint(vertices))


def paint(points):
    """Soft bands and spots in three colours: points (P, 3) -> albedo (P, 3)."""
    x, y, z = points.T
    band = 0.5 + 0.5 * np.tanh(3 * np.sin(9 * y + 2 * np.sin(4 * x) + 1))[:, None]
    spot = 0.5 + 0.5 * np.tanh(4 * np.sin(7 * x + 1) * np.sin(7 * z) - 1)[:, None]
    cream, teal, coral = np.array([[0.85, 0.72, 0.45], [0.06, 0.35, 0.5], [0.8, 0.2, 0.12]])
    return (1 - spot) * (band * cream + (1 - band) * teal) + spot * coral


def evening(labs):
    """A red sun from the other side, and a blue lamp (9, 3)."""
    towards = np.array([[-0.8, 0.3, -0.5], [0.9, 0.1, 0.4]])
    return lamps(labs, towards, [[1.0, 0.6, 0.35], [0.25, 0.4, 0.75]], 0.15)


# --- how good it is -----------------------------------------------------------------------------


def judged(labs, x, name, size=128):
    """How good x is, and pictures (2 size, 2 size, 4) of both new kinds, as found and as they are.

    The numbers: pieces, genus, distance in parts of the diagonal, dB of 8 new views of half this
    size, dB of these in the evening's light, relative error of the light.
    """
    truth, found = unseen(labs, name), found_object(labs, x)
    at_truth = distances.closest_points(found.vertices, truth.vertices, truth.faces)
    scale = labs.reconstruction.best_scale(found.albedo, paint(at_truth))
    scaled = found._replace(albedo=scale * found.albedo)
    light, other_light = daylight(labs), evening(labs)
    pictures = [photographs(labs, each, lamp, new_cameras(labs), 2 * size, 2) for each, lamp in (
        (found, x.light), (truth, light), (scaled, other_light), (truth, other_light))]
    views = [[labs.msaa.box_resolve(picture, 2) for picture in kind] for kind in pictures]
    return {"pieces, genus": labs.reconstruction.genus(found.faces),
            "distance": relative_distance(found, truth),
            "new views": decibels(*views[:2]), "relit": decibels(*views[2:]),
            "light": np.linalg.norm(x.light / scale - light) / np.linalg.norm(light),
            "scale": scale, "pictures": pictures}


def relative_distance(found, truth):
    """How far two Painted are from each other, a mean of both ways, in parts of the diagonal."""
    both = itertools.permutations([(found.vertices, found.faces), (truth.vertices, truth.faces)])
    mean = [distances.surface_distances(*a, *b)[0] for a, b in both]
    return np.mean(mean) / np.linalg.norm(np.ptp(truth.vertices, axis=0))


def decibels(pictures, truth):
    """Colours of pictures (H, W, 4), as seen on a screen, against the truth: mean PSNR in dB."""
    errors = [((image.to_srgb(np.clip(a, 0, 1)) - image.to_srgb(np.clip(b, 0, 1)))[..., :3]**2)
              .mean() for a, b in zip(pictures, truth, strict=True)]
    return image.decibels(np.mean(errors))
