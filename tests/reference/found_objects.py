"""What tests of what lab 16 finds begin with."""
import numpy as np
import pytest

from course.given import mesh
from course.given.whose import Labs
from course.scenes import drawing, reconstruct, viewing
from reference import multi_view_fit, reconstruction

LABS = Labs("reference")
EVEN = np.eye(9)[:, :1] * np.ones(3) / reconstruction.C0  # a light that shows an albedo as it is
NO_SUN = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]])


def surface_of(vertices, faces, albedo=None):
    """A Surface, as multi_view_fit makes them."""
    normals = mesh.vertex_normals(vertices, faces)
    return multi_view_fit.Surface(vertices, faces, None, normals, albedo)


def ball(radius):
    """A ball of soft colours: vertices (V, 3), faces (F, 3), colours (V, 3)."""
    vertices, faces = mesh.icosphere(1280)
    return radius * vertices, faces, 0.5 + 0.3 * np.sin(4 * vertices[:, [1, 2, 0]])


def photographed(painted, light, count, size):
    """A Capture of a Painted mesh, by cameras around it."""
    cameras = viewing.cameras_around(LABS, count)
    pictures = reconstruct.photographs(LABS, painted, light, cameras, size)
    return multi_view_fit.Capture(pictures, cameras, drawing.WHITE)


def require_follows(loss_and_gradients, x, which, direction, h):
    """The gradient by a part of x, along a direction, is the central difference of the loss."""
    def at(h):
        return loss_and_gradients(x._replace(**{which: getattr(x, which) + h * direction}))

    numeric = (at(h)[0] - at(-h)[0]) / (2 * h)
    assert (getattr(at(0)[1], which) * direction).sum() == pytest.approx(numeric, rel=1e-5)
