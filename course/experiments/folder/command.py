"""What a folder of pictures shows: the search, its files, and its report.

    python3 -m course demo reconstruct FOLDER --steps 300 --size 128
"""
import re
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...given import image, places
from . import captures, checkpoints, fit_report, hulls, photographs, searches

KEPT_OUT = 8  # every eighth picture is for the report alone, where the files hold none out
STATE_SIZE = 256
PAINT, CHARTS, REPORT = 60, 20, 15  # how many steps of the search would take as long
UNSURE = ("other light, with albedo that differs by up to {:.0f} %, fits the pictures as well, and "
          "its tint is a guess: the greyest light that does")
TURNS = 0.1  # a light that stays gives 0.04 at most, where things shine; a lamp that turns 0.4
TURNING = ("points are brighter on one side of the pictures, so the light turns with the camera, "
           "as before a turntable; the search takes it for fixed: expect wrong albedo, and take "
           "pictures with a camera that goes around instead, or in even light")


class Wishes(NamedTuple):
    """The options of the command: steps in all, pixels of a picture's longest side, go on?"""

    steps: int | None = None
    size: int = 128
    resume: bool = False


class Found(NamedTuple):
    """What a search and its last steps have: the Kept, the Surface with its vertices moved and its
    albedo told apart from the light, the Appearance that says so, the colours (V, 6) that eq. (10)
    and the Appearance give the vertices, how many pixels tell of each (V,), how much other
    albedo that fits as well differs, and sentences on the light.
    """

    kept: checkpoints.Kept
    surface: object
    look: object
    colours: np.ndarray
    count: np.ndarray
    doubt: float
    remarks: list


def run(labs, folder: str, wishes: Wishes) -> int:
    """Reconstruct what a folder's pictures show, and say where mesh and report are. -> 0"""
    photos = captures.read(labs, folder, wishes.size)
    for sentence in photos.assumed:
        print(sentence, flush=True)
    path = out(folder)
    stages = scaled(searches.fine_stages(labs, longest(photos)), wishes.steps)
    steps = searches.steps_of(stages) + moves(stages) + PAINT + CHARTS + REPORT
    with searches.bar(path.stem, steps) as bar:
        kept = search(labs, photos, path, stages, wishes.resume, bar)
        judged = finish(labs, photos, path, stages, kept, bar)
    path.with_name("checkpoint.npz").unlink(missing_ok=True)
    print("\n".join(judged.found.remarks))
    print(f"{fit_report.summary(judged)}\n{places.shown_path(path)}, .obj, and report.html")
    return 0


def finish(labs, photos, path, stages, kept, bar):
    """What comes after the search: paint and light, the files, and the report -> Judged."""
    from . import exports  # its packages are not there in a browser, where lectures import scenes
    began = time.process_time() - kept.seconds
    bar.update(0, summary="moving the vertices")
    surface = moved(labs, photos, kept, moves(stages), bar)
    bar.update(0, summary="telling paint from light")
    found = told_apart(labs, kept, surface, seen(labs, photos))
    bar.update(0, advance=PAINT, summary="cutting the surface into charts")
    exports.save_textured(labs, found.surface, found.count, path, photos.world_from_grid)
    bar.update(0, advance=CHARTS, summary="writing the report")
    judged = fit_report.judged(labs, found, photos, [stage.steps for stage in stages],
                               kept_out(photos))
    photos = photos._replace(assumed=[*photos.assumed, *found.remarks])
    fit_report.write(labs, judged, photos, path, began)
    return judged


def out(folder):
    """Where the mesh of a folder goes: a path that ends in .glb. Its folder is made."""
    name = re.sub(r"[^\w.-]+", "_", Path(folder).resolve().name) or "pictures"
    return places.out("demo", "reconstruct", name, f"{name}.glb")


def scaled(stages, steps):
    """Stages that take so many steps in all, each its share, and at least one."""
    if steps is None:
        return stages
    ends = np.cumsum([stage.steps for stage in stages])
    shares = np.diff(np.rint(steps * ends / ends[-1]).astype(int), prepend=0)
    return tuple(stage._replace(steps=max(1, int(share)))
                 for stage, share in zip(stages, shares, strict=True))


def longest(photos):
    """Pixels of the pictures' longer side."""
    return max(photos.pictures[0].shape[:2])


def kept_out(photos):
    """The numbers of the pictures that the search does not see."""
    return photos.held_out or list(range(KEPT_OUT - 1, len(photos.pictures), KEPT_OUT))


def search(labs, photos, path, stages, resume, bar):
    """The search from its beginning, or from where it was stopped -> Kept at its end."""
    checkpoint, identity = path.with_name("checkpoint.npz"), checkpoints.identity_of(photos, stages)
    kept = before = (checkpoints.read(checkpoint, identity, labs.multi_view_fit.Scene) if resume
                     else checkpoints.Kept())
    camera = fit_report.turning(labs, photos, 8)[1]
    try:
        for kept in steps(labs, photos, path, stages, before, bar):
            if len(kept.losses) % searches.EVERY == 0:
                checkpoints.write(checkpoint, kept, identity)
                image.write(path.with_name("state.png"),
                            photographs.portrait(labs, kept.x, camera, STATE_SIZE, 2))
    except KeyboardInterrupt:
        raise KeyboardInterrupt("stopped; the same command with --resume goes on") from None
    finally:
        if kept.x is not None:
            checkpoints.write(checkpoint, kept, identity)
    return kept


def steps(labs, photos, path, stages, kept, bar):
    """Yield Kept after each step that is left."""
    done = len(kept.losses)
    capture = seen(labs, photos)
    x = kept.x if done else hulls.start(labs, capture, stages[0].cells)
    fit = labs.multi_view_fit.fit(capture, stages, after=(x, done))
    losses = list(kept.losses)
    bar.update(0, completed=done)
    for x, loss in searches.watched(labs, fit, bar, path, photos.world_from_grid):
        losses.append(float(loss))
        yield checkpoints.Kept(x, tuple(losses), kept.seconds + time.process_time())


def seen(labs, photos):
    """The Capture of the pictures that the search sees."""
    chosen = [k for k in range(len(photos.pictures)) if k not in kept_out(photos)]
    return captures.capture_of(labs, photos, chosen)


def moves(stages):
    """How many steps move the vertices: a third of the search's."""
    return -(-searches.steps_of(stages) // 3)


def moved(labs, photos, kept, steps, bar):
    """The Surface that the search has found, its vertices moved."""
    searched, samples = labs.multi_view_fit.surface(kept.x), searches.samples(longest(photos), 512)
    for surface, _ in labs.vertex_fit.fit_vertices(  # noqa: B007
            searched, seen(labs, photos), steps, samples):
        bar.advance(0)
    return surface


def told_apart(labs, kept, surface, capture):
    """Found: the last step, when the shape stays."""
    lab = labs.intrinsic_decomposition
    targets = labs.multi_view_fit.targets_of(capture, 1, 1)
    look = lab.decompose(surface, targets)
    colours, count = lab.seen_colours(surface, targets)
    doubt = labs.ambiguity.doubt(surface, targets, look)
    turns = labs.ambiguity.turning(surface, targets, colours) > TURNS
    remarks = [UNSURE.format(100 * doubt), *([TURNING] if turns else [])]
    return Found(kept, surface._replace(albedo=look.albedo), look,
                 np.hstack([colours, lab.shaded_colours(surface, look)]), count, doubt, remarks)
