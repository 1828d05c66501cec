"""Clip positions that tests of whole pictures draw: points of the screen, and a soup of faces; and
a camera.
"""
import numpy as np

from reference import antialiasing, rasterization, transforms


def camera(eye, at=(0.0, 0.0, 0.0), fov_y=0.8, aspect=1.0, near=0.1, far=10.0):
    """clip_from_world of a camera that stands upright."""
    view = transforms.look_at(np.array(eye), np.array(at), np.array([0.0, 1.0, 0.0]))
    return transforms.perspective(fov_y, aspect, near, far) @ view


def on_screen(x, y, width, height, z=0.0):
    """Clip positions of screen points, w = 1."""
    x, y, z = np.broadcast_arrays(np.asarray(x, float), y, z)
    return np.stack([2 * x / width - 1, 2 * y / height - 1, z, np.ones(x.shape)], -1)


def drawn(clip, faces, width, height):
    """What lab 8 asks of a picture: face_index, depth, clip, faces, opposite. And it in white."""
    face_index, depth = rasterization.rasterize(clip, faces, width, height)
    white = (face_index >= 0)[..., None].astype(float)
    return (face_index, depth, clip, faces, antialiasing.opposite_corners(faces)), white


def soup(rng, behind=False):
    """Faces that pass through each other, some with shared vertices, some behind the camera."""
    clip = rng.uniform([-2, -2, -1.0, 1.0], [2, 2, 1.0, 2.0], (24, 4))
    if behind:
        clip[:4, 3] *= -0.5
    return clip, rng.integers(0, 24, (30, 3))
