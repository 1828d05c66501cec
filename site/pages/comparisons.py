"""Pairs of pictures by the course's scenes, with a line between them that the reader moves."""
import html
from unittest import mock

from course.given import image
from course.given.whose import Labs
from course.scenes import aliasing, msaa, shadow
from course.scenes.drawing import enlarged
from labkit import places

from . import picture, put

PAIRS = {  # name: scene, caption, its two pictures
    "sampled": (aliasing.aliasing,
                "A zone plate made smaller.",
                ("sampled", "sampled", "a zone plate of which every third pixel was kept: nine "
                 "centres of rings, equally strong"),
                ("filtered", "filtered, then sampled", "the same with a filter first: one strong "
                 "centre of rings, and faint false ones")),
    "samples": (msaa.msaa,
                "An ear of the bunny, 64 x 64 pixels, with one sample in each and with 16 (MSAA).",
                ("1x", "1 sample in a pixel", "the ear, enlarged: its outline has stairs"),
                ("16x", "16 samples", "the same ear with a smooth outline: its pixels are mixed "
                 "with the background")),
    "soft": (shadow.shadow,
             "The shadow of a small lamp and of a large one.",
             ("hard", "a point", "the bunny on the ground, its shadow with a sharp outline"),
             ("soft", "a disc", "the same shadow, sharp at the feet and soft at the ears")),
}
CLOSE_UPS = {"samples": (slice(358, 422), slice(186, 250))}  # rows and columns, shown 8 times


def write(extra):
    """Write extra/pairs -> {name: the figure's HTML}."""
    labs = Labs("reference")
    with mock.patch.object(places, "OUT", str(extra.parent)):  # the reader's own out/demo stays
        return {name: figure(extra, name, drawn(scene(labs), [one[0] for one in pair]), caption,
                             pair)
                for name, (scene, caption, *pair) in PAIRS.items()}


def drawn(scene, names):
    """Run a scene until it has made the pictures of these names -> their paths."""
    paths = {}
    for _, path, *_ in scene:
        if path and path.stem in names:
            paths[path.stem] = path
        if len(paths) == len(names):
            break
    return [paths[name] for name in names]


def figure(extra, name, paths, caption, pair):
    parts = []
    for path, (_, label, words) in zip(paths, pair, strict=True):
        file = f"{name}_{path.stem}"
        if name in CLOSE_UPS:
            image.write(path, enlarged(image.read(path)[CLOSE_UPS[name]], 8))
        put(extra / "pairs" / f"{file}.png", places.read_whole(path))
        parts.append(picture(f"../pairs/{file}.png", words, *image.size(path),
                             f' data-label="{html.escape(label)}"'))
    return (f'<figure class="before-after">{"".join(parts)}'
            f"<figcaption>{caption}</figcaption></figure>")
