"""A camera flies into the bunny (labs 1 and 2)."""
import numpy as np
from rich.progress import track

from ...given import image, places
from .drawing import SIZE, smooth, unit_bunny
from .viewing import clip_positions


def flight(labs):
    """A camera flies into the bunny, up to its back wall. Nothing was clipped."""
    vertices, faces = unit_bunny()
    frames = []
    for x in track(np.linspace(-2.2, 0.2, 48), "flight", transient=True):
        eye = np.array([x, -0.1, 0.0])
        clip = clip_positions(labs, vertices, eye, target=eye + [1.0, 0.0, 0.0], near=0.01)
        frames.append(smooth(labs, vertices, faces, clip, SIZE // 2))
    path = places.out("demo", "flight.png")
    image.write_animation(path, frames, 1 / 12)
    yield f"{len(frames)} frames", path
