"""What tests of files and reports begin with: a Scene as the object that was found, and its files.
"""
import numpy as np
import pytest
import trimesh

from course.experiments.folder import checkpoints, command
from course.experiments.scenes import demo, drawing, reconstruct, viewing
from reference import intrinsic_decomposition, multi_view_fit, reconstruction

LABS = demo.Labs("reference")
EVEN = np.eye(9)[:, :1] * np.ones(3) / reconstruction.C0  # a light that shows an albedo as it is
NO_SUN = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]])


def painted_ball(n=5):
    """A Scene of n^3 cells, every point of the grid of another colour."""
    x = multi_view_fit.start(n)
    return x._replace(albedo=np.random.default_rng(0).uniform(0.2, 0.8, x.albedo.shape))


def photographed(painted, light, count, size):
    """A Capture of a Painted mesh, by cameras around it."""
    cameras = viewing.cameras_around(LABS, count)
    pictures = reconstruct.photographs(LABS, painted, light, cameras, size)
    return multi_view_fit.Capture(pictures, cameras, drawing.WHITE)


def read_glb(path):
    """The mesh in a GLB file, as trimesh reads it."""
    (found,) = trimesh.load(path, process=False).geometry.values()
    return found


def read_obj(path):
    """{"v", "vt" or "vn": its rows (N, C)} of an OBJ file, and its faces' indices (F, 3, k)."""
    lines = [line.split() for line in path.read_text().splitlines()]
    rows = {kind: np.array([line[1:] for line in lines if line[:1] == [kind]], float)
            for kind in ("v", "vt", "vn")}
    faces = [[word.split("/") for word in line[1:]] for line in lines if line[:1] == ["f"]]
    return rows, np.array(faces, int) - 1


def require_follows(loss_and_gradients, x, which, direction, h):
    """The gradient by a part of x, along a direction, is the central difference of the loss."""
    def at(h):
        return loss_and_gradients(x._replace(**{which: getattr(x, which) + h * direction}))

    numeric = (at(h)[0] - at(-h)[0]) / (2 * h)
    assert (getattr(at(0)[1], which) * direction).sum() == pytest.approx(numeric, rel=1e-5)


def found_of(x, losses=(1.0,), seconds=0.0):
    """Found: the surface of a Scene with its own albedo, in its own light."""
    surface = multi_view_fit.surface(x)
    look = intrinsic_decomposition.Appearance(surface.albedo, x.light, NO_SUN, 0.0, 1.0)
    colours = reconstruction.shade(surface.albedo, surface.normals, x.light)
    return command.Found(checkpoints.Kept(x, losses, seconds), surface, look, np.tile(colours, 2),
                         np.ones(len(colours)), 0.1, [])
