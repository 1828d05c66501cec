"""What tests of lab 10 draw: faces that share no vertex, and a camera."""
import numpy as np

from reference import transforms


def some_corners(rng, count=12):
    """Faces of either winding, some behind the camera, some cut by the picture's border."""
    corners = rng.uniform(-1.3, 1.3, (count, 3, 3))
    corners[..., 2] = rng.uniform(1, 3, (count, 3))
    corners[::5, 1, 2] *= -1
    return corners


def camera(position=(0.6, 1.2, 2.2)):
    view = transforms.look_at(np.array(position), np.zeros(3), np.array([0.0, 1.0, 0.0]))
    return transforms.perspective(0.8, 1.0, 0.1, 10.0) @ view
