"""A search that was stopped: what it had found, so that `--resume` goes on from there."""
import hashlib
import io
import json
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...given import places


class Kept(NamedTuple):
    """What a search has after some steps: x, a Scene or None, the losses so far, and processor
    seconds since the command began.
    """

    x: object = None
    losses: tuple = ()
    seconds: float = 0.0


def identity_of(photos, stages):
    """What a search depends on, in words that two different searches do not share: a dict."""
    height, width, _ = photos.pictures[0].shape
    content = hashlib.sha256()
    for array in (*photos.pictures, photos.cameras, photos.background, photos.world_from_grid):
        content.update(np.ascontiguousarray(array).tobytes())
    return {"size": max(height, width), "steps": sum(stage.steps for stage in stages),
            "stages": [list(stage) for stage in stages], "pictures": content.hexdigest()}


def write(path, kept, identity):
    """Kept -> a file, all or nothing."""
    content = io.BytesIO()
    np.savez_compressed(content, identity=json.dumps(identity), losses=kept.losses,
                        seconds=kept.seconds, **kept.x._asdict())
    places.write_whole(path, content.getvalue())


def read(path, identity, scene):
    """The Kept of a file, if its search had this identity. scene is the class Scene.

    ValueError: there is no such file, it is broken, or its search was another one.
    """
    if not Path(path).exists():
        raise ValueError(f"nothing to go on from: there is no {places.shown_path(path)}; without "
                         "--resume the search begins anew")
    try:
        with np.load(io.BytesIO(places.read_whole(path)), allow_pickle=False) as held:
            before = json.loads(str(held["identity"]))
            kept = Kept(scene(*(held[name] for name in scene._fields)),
                        tuple(held["losses"].tolist()), float(held["seconds"]))
    except Exception:  # whatever a broken file makes NumPy stumble over
        raise ValueError(f"{places.shown_path(path)} is broken: start again without --resume"
                         ) from None
    require_same(before, json.loads(json.dumps(identity)))
    return kept


def require_same(before, now):
    """ValueError unless two identities are of one search: it says what to give instead."""
    if (before["size"], before["steps"]) != (now["size"], now["steps"]):
        raise ValueError(f"the search that was stopped had --steps {before['steps']} --size "
                         f"{before['size']}: give these with --resume, or start anew without it")
    if before != now:
        raise ValueError("the search that was stopped had other pictures or cameras: start anew "
                         "without --resume")
