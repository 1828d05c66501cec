"""What tests of files and reports begin with: a Scene as the object that was found, and its files.
"""
import numpy as np
import trimesh

from course.experiments.folder import checkpoints, command
from reference import intrinsic_decomposition, multi_view_fit, reconstruction

NO_SUN = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]])


def painted_ball(n=5):
    """A Scene of n^3 cells, every point of the grid of another colour."""
    x = multi_view_fit.start(n)
    return x._replace(albedo=np.random.default_rng(0).uniform(0.2, 0.8, x.albedo.shape))


def read_glb(path):
    """The mesh in a GLB file, as trimesh reads it."""
    (found,) = trimesh.load(path, process=False).geometry.values()
    return found


def found_of(x, losses=(1.0,), seconds=0.0):
    """Found: the surface of a Scene with its own albedo, in its own light."""
    surface = multi_view_fit.surface(x)
    look = intrinsic_decomposition.Appearance(surface.albedo, x.light, NO_SUN, 0.0, 1.0)
    colours = reconstruction.shade(surface.albedo, surface.normals, x.light)
    return command.Found(checkpoints.Kept(x, losses, seconds), surface, look, np.tile(colours, 2),
                         np.ones(len(colours)), 0.1, [])
