"""Meshes in space: seen from the side that the angles say, near faces in front of far ones."""
import matplotlib.pyplot as plt
import numpy as np
import pytest

from course.given import plot_3d

pytestmark = pytest.mark.usefixtures("style")


@pytest.mark.parametrize("azimuth, elevation, point, seen", [
    (0, 0, [1, 2, 3], [1, 2, 3]),
    (90, 0, [0, 0, 1], [-1, 0, 0]),                # from +x, +z points to the left
    (90, 0, [1, 0, 0], [0, 0, 1]),                 # and what was right is near
    (0, 90, [0, 1, 0], [0, 0, 1]),                 # from above, up is near
    (0, 90, [0, 0, 1], [0, -1, 0])])
def test_the_viewer_stands_where_the_angles_say(azimuth, elevation, point, seen):
    """A mirrored world, or a camera below the floor."""
    assert np.allclose(plot_3d.turn(azimuth, elevation) @ point, seen)


def test_near_faces_are_drawn_over_far_ones():
    """The back of a mesh painted over its front."""
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1.0]])
    _, axes = plt.subplots()
    plot_3d.surface(axes, vertices, np.array([[3, 4, 5], [0, 1, 2]]), 0, 0,
                    colours=[[1, 0, 0], [0, 0, 1]])
    first, last = axes.collections[0].get_facecolors()
    assert first[2] > first[0] and last[0] > last[2]


def test_a_face_is_bright_when_it_looks_to_the_light():
    """Light from behind."""
    toward, away = np.array([-0.45, 0.65, 0.62]), np.array([0.9, 0.1, 0.5])
    shades = []
    for normal in (toward, away):
        across = np.cross(normal, [0, 0, 1.0])
        corners = np.array([np.zeros(3), across, np.cross(normal, across)])
        _, axes = plt.subplots()
        plot_3d.surface(axes, corners, np.array([[0, 1, 2]]), 0, 0)
        shades.append(axes.collections[0].get_facecolors()[0, 0])
    assert shades[0] > shades[1] + 0.1
