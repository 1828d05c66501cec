"""What a folder of pictures shows: the search, its files, and its report.

    python3 -m course demo reconstruct FOLDER --steps 300 --size 128
"""
import re
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...given import image, places
from . import (
    captures,
    checkpoints,
    explanations,
    fit_report,
    hulls,
    photographs,
    searches,
    turning_light,
)

KEPT_OUT = 8  # every eighth picture is for the report alone, where the files hold none out
STATE_SIZE = 256


class Wishes(NamedTuple):
    """The options of the command: steps in all, pixels of a picture's longest side, go on?"""

    steps: int | None = None
    size: int = 128
    resume: bool = False


class Found(NamedTuple):
    """What a search and its last step have: the Kept, its Surface with the albedo told apart from
    the light, the Appearance that says so, the colours (V, 3) in that light, and how much other
    albedo that fits as well differs.
    """

    kept: checkpoints.Kept
    surface: object
    look: object
    colours: np.ndarray
    doubt: float


def run(labs, folder: str, wishes: Wishes) -> int:
    """Reconstruct what a folder's pictures show, and say where mesh and report are. -> 0"""
    photos = captures.read(labs, folder, wishes.size)
    for sentence in photos.assumed:
        print(sentence, flush=True)
    path = out(folder)
    stages = scaled(searches.fine_stages(labs), wishes.steps)
    kept = search(labs, photos, path, stages, wishes.resume)
    print("telling paint from light ...", flush=True)
    found, sentences = told_apart(labs, kept, seen(labs, photos))
    print("\n".join(sentences))
    photos = photos._replace(assumed=[*photos.assumed, *sentences])
    print("cutting the surface into charts, and writing the report ...", flush=True)
    from . import exports  # its packages are not there in a browser, where lectures import scenes
    exports.save_textured(labs, found.surface, path, photos.world_from_grid)
    judged = fit_report.judged(labs, found, photos, [stage.steps for stage in stages],
                               kept_out(photos))
    fit_report.write(labs, judged, photos, path)
    path.with_name("checkpoint.npz").unlink(missing_ok=True)
    print(f"{fit_report.summary(judged)}\n{places.shown_path(path)}, .obj, and report.html")
    return 0


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


def kept_out(photos):
    """The numbers of the pictures that the search does not see."""
    return photos.held_out or list(range(KEPT_OUT - 1, len(photos.pictures), KEPT_OUT))


def search(labs, photos, path, stages, resume):
    """The search from its beginning, or from where it was stopped -> Kept at its end."""
    checkpoint, identity = path.with_name("checkpoint.npz"), checkpoints.identity_of(photos, stages)
    kept = before = (checkpoints.read(checkpoint, identity, labs.multi_view_fit.Scene) if resume
                     else checkpoints.Kept())
    camera = fit_report.turning(labs, photos, 8)[1]
    try:
        for kept in steps(labs, photos, path, stages, before):
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


def steps(labs, photos, path, stages, kept):
    """Yield Kept after each step that is left, under a bar."""
    done, start = len(kept.losses), time.monotonic() - kept.seconds
    capture = seen(labs, photos)
    x = kept.x if done else hulls.start(labs, capture, stages[0].cells)
    fit = labs.multi_view_fit.fit(capture, stages, after=(x, done))
    losses = list(kept.losses)
    for x, loss in searches.watched(labs, fit, searches.steps_of(stages), path,
                                    photos.world_from_grid, done):
        losses.append(float(loss))
        yield checkpoints.Kept(x, tuple(losses), time.monotonic() - start)


def seen(labs, photos):
    """The Capture of the pictures that the search sees."""
    chosen = [k for k in range(len(photos.pictures)) if k not in kept_out(photos)]
    return captures.capture_of(labs, photos, chosen)


def told_apart(labs, kept, capture):
    """Found, and sentences on its light: the last step, when the shape stays."""
    surface, lab = labs.multi_view_fit.surface(kept.x), labs.intrinsic_decomposition
    targets = labs.multi_view_fit.targets_of(capture, 1, 1)
    look = lab.decompose(surface, targets)
    colours = lab.shaded_colours(surface, look)
    doubt = explanations.doubt(labs, surface, targets, look)
    return (Found(kept, surface._replace(albedo=look.albedo), look, colours, doubt),
            [explanations.in_words(doubt), *turning_light.remarks(labs, surface, targets)])
