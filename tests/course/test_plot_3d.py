"""Meshes in space are seen from the side that the angles say."""
import numpy as np
import pytest

from course.given import plot_3d


@pytest.mark.parametrize("azimuth, elevation, point, seen", [
    (0, 0, [1, 2, 3], [1, 2, 3]),
    (90, 0, [0, 0, 1], [-1, 0, 0]),                # from +x, +z points to the left
    (90, 0, [1, 0, 0], [0, 0, 1]),                 # and what was right is near
    (0, 90, [0, 1, 0], [0, 0, 1]),                 # from above, up is near
    (0, 90, [0, 0, 1], [0, -1, 0])])
def test_the_viewer_stands_where_the_angles_say(azimuth, elevation, point, seen):
    """A mirrored world, or a camera below the floor."""
    assert np.allclose(plot_3d.turn(azimuth, elevation) @ point, seen)
