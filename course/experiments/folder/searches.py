"""Lab 16's search under a progress bar, with the mesh so far on disk."""
import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from ...given import places
from . import captures

EVERY = 20  # steps from one mesh on disk to the next
COLUMNS = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn(),
           TextColumn("{task.fields[summary]}"))


def fine_stages(labs, size=128):
    """Lab 16's Stages of the searches that are to be seen from near, in pictures of this size.

    Larger pictures have a fourth. Its cells are as wide as 2.7 pixels, but for memory's sake 96 at
    most.
    """
    stage, cells = labs.multi_view_fit.Stage, min(3 * size // 8, 96)
    coarse = (stage(24, 1, 1, 100, 1.0), stage(32, 1, 1, 80, 0.5),
              stage(48, 1, samples(size, 384), 120, 0.3))
    return coarse if cells <= 48 else (*coarse, stage(cells, 1, samples(size, 384), 100, 0.3))


def samples(size, width):
    """Along a pixel's side, so that pictures are about so wide as they are rendered: 2 to 4."""
    return min(max(2, round(width / size)), 4)


def bar(name, steps):
    """A progress bar for `with`, seen in a terminal: a rich Progress with one task, number 0."""
    console = Console(stderr=True)
    progress = Progress(*COLUMNS, console=console, transient=True, disable=not console.is_terminal)
    progress.add_task(name, total=steps, summary="")
    return progress


def watched(labs, fit, progress, path, world_from_grid=np.eye(4)):  # noqa: B008
    """What fit yields, step by step, and a `bar` goes on, with loss, faces and genus. The last good
    mesh is written to path every EVERY steps and at the end, even after Ctrl-C.
    """
    from . import exports  # its packages are not there in a browser, where lectures import scenes
    good = None
    try:
        for step, (x, loss) in enumerate(fit, round(progress.tasks[0].completed) + 1):
            require_surface(loss, x, step)
            good = x
            if step % EVERY == 0:
                exports.save(labs, x, path, world_from_grid)
                progress.update(0, summary=summary(labs, loss, x))
            progress.advance(0)
            yield x, loss
    except KeyboardInterrupt:
        progress.print("stopped before the first mesh" if good is None else
                       f"stopped; the last good mesh is in {places.shown_path(path)}")
        raise
    finally:
        if good is not None:
            exports.save(labs, good, path, world_from_grid)


def require_surface(loss, x, step):
    """ValueError unless all of x is finite, and something of it is inside."""
    finite = np.isfinite(loss) and all(np.isfinite(part).all() for part in x)
    captures.require(finite and (x.distance < 0).any(), f"the search came to nothing at step {step}"
                     ": are the cameras right, and is the object in the ball?")


def summary(labs, loss, x):
    """Loss, faces and genus, in words."""
    faces = labs.multi_view_fit.surface(x).faces
    _, genus = labs.reconstruction.genus(faces)
    return f"loss {loss:.4f}  {len(faces):,} faces  genus {genus}"


def steps_of(stages):
    """How many steps lab 16's `fit` takes."""
    return sum(stage.steps for stage in stages)
