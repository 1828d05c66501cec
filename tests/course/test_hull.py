"""Where a search for a shape begins."""
import numpy as np

from course.given import distances, mesh
from course.given.whose import Labs
from course.scenes import drawing, hull, viewing


def test_the_search_begins_with_the_hull():
    """The hull is mirrored, shifted by half a pixel, or its hole is closed."""
    labs = Labs("reference")
    cameras = viewing.cameras_around(labs, 20)
    vertices, faces = mesh.torus(4000, 0.6, 0.2)
    moved = vertices + [0.1, -0.05, 0.15]
    pictures = [drawing.seen_mask(labs, moved, faces, camera, 64)[..., None].repeat(4, 2)
                for camera in cameras]
    capture = labs.multi_view_fit.Capture(pictures, cameras, np.ones(3))
    x = hull.start(labs, capture, 24)
    found = labs.multi_view_fit.surface(x)
    assert labs.reconstruction.genus(found.faces) == (1, 1)
    middle = (found.vertices.min(0) + found.vertices.max(0)) / 2
    np.testing.assert_allclose(middle, [0.1, -0.05, 0.15], atol=0.02)
    away, _ = distances.surface_distances(found.vertices, found.faces, moved, faces)
    assert away < hull.SHRUNK + 0.03
