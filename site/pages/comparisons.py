"""Pairs of pictures by the course's scenes, with a line between them that the reader moves."""
import html

from PIL import Image

from course.experiments.scenes import aliasing, msaa, shadow
from course.experiments.scenes.demo import Labs
from course.given.places import read_whole

from . import put

PAIRS = {  # name: lecture, words of the figure above, scene, caption, its two pictures
    "sampled": ("03_sampling", "three small zone plates", aliasing.aliasing,
                "A zone plate made smaller.",
                ("sampled", "sampled", "a zone plate of which every third pixel was kept: nine "
                 "centres of rings, equally strong"),
                ("filtered", "filtered, then sampled", "the same with a filter first: one strong "
                 "centre of rings, and faint false ones")),
    "samples": ("04_msaa", "an ear of the bunny, enlarged, with 1 sample", msaa.msaa,
                "One sample in a pixel, and MSAA.",
                ("1x", "1 sample in a pixel", "the bunny with stairs along its outline"),
                ("16x", "16 samples", "the bunny with a smooth outline")),
    "soft": ("14_shadow_mapping", "four pictures: a hard shadow, PCF with", shadow.shadow,
             "The shadow of a small lamp and of a large one.",
             ("hard", "a point", "the bunny on the ground, its shadow with a sharp outline"),
             ("soft", "a disc", "the same shadow, sharp at the feet and soft at the ears")),
}
PICTURE = ('<img src="../pairs/{file}.png" alt="{words}" data-label="{label}" width="{width}" '
           'height="{height}" loading="lazy" decoding="async">')


def write(extra):
    """Write extra/pairs -> {name: the figure's HTML}."""
    labs = Labs("reference")
    return {name: figure(extra, name, drawn(scene(labs), [one[0] for one in pair]), caption, pair)
            for name, (_, _, scene, caption, *pair) in PAIRS.items()}


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
        put(extra / "pairs" / f"{file}.png", read_whole(path))
        width, height = Image.open(path).size
        parts.append(PICTURE.format(file=file, label=label, words=html.escape(words), width=width,
                                    height=height))
    return (f'<figure class="before-after">{"".join(parts)}'
            f"<figcaption>{caption}</figcaption></figure>")
