"""Pairs of pictures by the course's scenes, as films of two frames."""
from unittest import mock

from course.given import image
from course.given.whose import Labs
from course.scenes import aliasing, msaa, shadow
from course.scenes.drawing import enlarged
from labkit import places

from . import turntables

SECONDS = 1.2
PAIRS = {  # name: scene, its two pictures, what the second shows, the caption
    "sampled": (aliasing.aliasing, ("sampled", "filtered"),
                "a zone plate made smaller: one strong centre of rings, and faint false ones",
                "Of a zone plate every third pixel is kept: at once, and after a filter."),
    "samples": (msaa.msaa, ("1x", "16x"), "an ear of the bunny with a smooth outline",
                "An ear of the bunny, 64 x 64 pixels: one sample in each, and sixteen (MSAA)."),
    "soft": (shadow.shadow, ("hard", "soft"),
             "the bunny's shadow on the ground, sharp at the feet and soft at the ears",
             "The shadow of a point, and of a disc."),
}
CLOSE_UPS = {"samples": ((slice(358, 422), slice(186, 250)), 8)}  # rows, columns; how large


def write(extra):
    """Write their films to extra/turns -> {name: the figure's HTML}."""
    labs = Labs("reference")
    with mock.patch.object(places, "OUT", str(extra.parent)):  # the reader's own out/demo stays
        return {name: turntables.figure(extra / "turns", name, frames(name, scene(labs), pair),
                                        SECONDS, words, caption)
                for name, (scene, pair, words, caption) in PAIRS.items()}


def frames(name, scene, pair):
    """Run a scene until it has made the pictures of these names -> both."""
    found = {}
    while len(found) < len(pair):
        _, path, *_ = next(scene)
        if path and path.stem in pair:
            found[path.stem] = image.read(path)
    part, times = CLOSE_UPS.get(name, (slice(None), 1))
    return [enlarged(found[one][part], times) for one in pair]
