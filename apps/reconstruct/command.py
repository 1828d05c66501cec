"""What a folder of pictures shows: the search, the mesh, and how good it is.

    python3 -m course reconstruct FOLDER --size 128
"""
import re
from pathlib import Path

import numpy as np
from rich.progress import track

from course.given.whose import Labs, exercises_named
from course.scenes import hull, reconstruct
from labkit import places

from . import captures, exports, views

KEPT_OUT = 8  # every eighth picture is not for the search: it tells how good the mesh is


def run(folder: str, size: int = 128, implementation: str | None = None) -> int:
    """Find the mesh of what a folder's pictures show, and say how good it is and where. -> 0"""
    labs = Labs(implementation)
    with exercises_named():
        photos = captures.read(labs, folder, size)
        print(*photos.assumed, sep="\n", flush=True)
        new = list(range(KEPT_OUT - 1, len(photos.pictures), KEPT_OUT))
        kept = [k for k in range(len(photos.pictures)) if k not in new]
        capture = labs.multi_view_fit.Capture([photos.pictures[k] for k in kept],
                                              photos.cameras[kept], np.ones(3))
        surface = moved(labs, *searched(labs, capture), capture)
        print("telling paint from light, and cutting the surface into charts", flush=True)
        surface, colours = told_apart(labs, surface, capture)
        path = out(folder)
        exports.save(labs, surface, path, photos.world_from_grid)
        print(*summary(labs, surface, colours, photos, new, path), sep="\n")
    return 0


def summary(labs, surface, colours, photos, new, path):
    """The numbers, in lines. The pictures to them are written beside the mesh."""
    pieces, genus = labs.reconstruction.genus(surface.faces)
    kind = "new views" if new else "views of the search, for there are no eight pictures"
    seen = views.judged(labs, surface, colours, photos,
                        new or list(range(len(photos.pictures))))
    sheet = path.with_name(f"{path.stem}_views.png")
    worst = views.write_sheet(seen, sheet)
    return [f"{len(surface.faces):,} faces, pieces {pieces}, genus {genus}; "
            f"{views.psnr(seen):.1f} dB on the object in {len(seen)} {kind}; the worst:", *worst,
            f"{places.shown_path(path)}, and {sheet.name} with these views"]


def out(folder):
    """Where the mesh of a folder goes: a path that ends in .glb. Its folder is made."""
    name = re.sub(r"[^\w.-]+", "_", Path(folder).resolve().name) or "pictures"
    return places.out("reconstruct", name, f"{name}.glb")


def searched(labs, capture):
    """Lab 16's search in a Capture, from its visual hull -> a Scene, and how many steps it took."""
    stages = reconstruct.fine_stages(labs, longest(capture))
    steps = sum(stage.steps for stage in stages)
    begin = hull.start(labs, capture, stages[0].cells)
    search = labs.multi_view_fit.fit(capture, stages, begin=begin)
    for step, (x, loss) in enumerate(track(search, "the shape", steps, transient=True), 1):
        finite = np.isfinite(loss) and all(np.isfinite(part).all() for part in x)
        captures.require(finite and (x.distance < 0).any(), f"the search came to nothing at step "
                         f"{step}: are the cameras right?")
    return x, steps


def longest(capture):
    """Pixels of the pictures' longer side."""
    return max(capture.pictures[0].shape[:2])


def moved(labs, x, steps, capture):
    """The Surface that a search has found, its vertices moved in a third as many steps."""
    fit = labs.vertex_fit.fit_vertices(labs.multi_view_fit.surface(x), capture, -(-steps // 3),
                                       reconstruct.samples(longest(capture), 512))
    for surface, _ in track(fit, "its vertices", -(-steps // 3), transient=True):  # noqa: B007
        pass
    return surface


def told_apart(labs, surface, capture):
    """The last step, in which the shape stays -> the Surface with its albedo told apart from the
    light, and the colours (V, 3) of both together.
    """
    lab = labs.intrinsic_decomposition
    look = lab.decompose(surface, labs.multi_view_fit.targets_of(capture, 1, 1))
    return surface._replace(albedo=look.albedo), lab.shaded_colours(surface, look)
