"""Clip positions that tests of whole pictures draw: points of the screen, and a soup of faces."""
import numpy as np


def on_screen(x, y, width, height, z=0.0):
    """Clip positions of screen points, w = 1."""
    x, y, z = np.broadcast_arrays(np.asarray(x, float), y, z)
    return np.stack([2 * x / width - 1, 2 * y / height - 1, z, np.ones(x.shape)], -1)


def soup(rng, behind=False):
    """Faces that pass through each other, some with shared vertices, some behind the camera."""
    clip = rng.uniform([-2, -2, -1.0, 1.0], [2, 2, 1.0, 2.0], (24, 4))
    if behind:
        clip[:4, 3] *= -0.5
    return clip, rng.integers(0, 24, (30, 3))
