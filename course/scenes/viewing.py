"""Cameras and poses, by lab 1 alone."""
import numpy as np

UP = np.array([0.0, 1.0, 0.0])
BUNNY_EYE = np.array([-1.3, 0.7, 2.2])


def clip_positions(labs, vertices, eye, target=(0.0, 0.0, 0.0), near=0.1):
    """Vertices (V, 3) in world space -> clip (V, 4), for a camera at eye that looks at target."""
    points = labs.transforms.to_homogeneous(vertices)
    return labs.transforms.transform(points, clip_from_world(labs, eye, target, near))


def clip_from_world(labs, eye, target=(0.0, 0.0, 0.0), near=0.1, fov_y=48, aspect=1.0):
    """The matrix (4, 4) of a camera at eye that looks at target. fov_y is in degrees."""
    view_from_world = labs.transforms.look_at(np.asarray(eye), np.asarray(target), UP)
    return labs.transforms.perspective(np.radians(fov_y), aspect, near, 10.0) @ view_from_world


def cameras_around(labs, count, longitude=0.0):
    """Cameras 3 away from the origin, spread evenly on a spiral from pole to pole that starts at
    longitude, in turns: clip_from_world (count, 4, 4).
    """
    golden = (1 + np.sqrt(5)) / 2
    step = np.arange(count) + 0.5
    north = np.arccos(1 - 2 * step / count) / np.pi
    return cameras_at(labs, directions(golden * step + longitude, north))


def random_cameras(labs, count, seed=0):
    """Cameras 3 away from the origin, from all sides alike: clip_from_world (count, 4, 4)."""
    eyes = np.random.default_rng(seed).normal(size=(count, 3))
    return cameras_at(labs, eyes / np.linalg.norm(eyes, axis=1, keepdims=True))


def cameras_at(labs, sides):
    """Cameras that see the origin from 3 away, on the sides (N, 3): clip_from_world (N, 4, 4)."""
    clip_from_view = labs.transforms.perspective(np.radians(40), 1.0, 0.5, 10.0)
    return np.array([clip_from_view @ labs.transforms.look_at(3 * side, np.zeros(3), UP)
                     for side in sides])


def directions(u, v):
    """u (east) and v (north), from 0 to 1 (...) -> points of the unit sphere (..., 3)."""
    longitude, latitude = 2 * np.pi * u, np.pi * (v - 0.5)
    return np.stack([np.cos(latitude) * np.sin(longitude), np.sin(latitude),
                     np.cos(latitude) * np.cos(longitude)], -1)


def random_pose(labs, rng, shift=0.0):
    """Any rotation, all equally likely, then a shift by up to so much along x, y, z: (4, 4)."""
    rotation = labs.transforms.look_at(np.zeros(3), rng.normal(size=3), rng.normal(size=3))
    return labs.transforms.translate(rng.uniform(-shift, shift, 3)) @ rotation
