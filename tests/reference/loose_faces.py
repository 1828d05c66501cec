"""What tests of lab 10 draw: faces that share no vertex, seen by a camera."""
from screen_scenes import camera

CAMERA = camera([0.6, 1.2, 2.2])


def some_corners(rng, count=12):
    """Faces of either winding, some behind the camera, some cut by the picture's border."""
    corners = rng.uniform(-1.3, 1.3, (count, 3, 3))
    corners[..., 2] = rng.uniform(1, 3, (count, 3))
    corners[::5, 1, 2] *= -1
    return corners
