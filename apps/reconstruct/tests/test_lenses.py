"""Pictures without the distortion of their lens."""
import numpy as np

from apps.reconstruct import camera_files, lenses

BEND = 0.05, -0.2, 0.02, -0.03
SHOT = camera_files.Shot("a.png", None, 40, 30, 36.0, 34.0, 22.0, 13.0, np.eye(4), BEND)


def test_a_lens_on_paper():
    """p1 and p2 are taken for one another, or k2 is that of r^2.

    r^2 = 0.8 for (0.8, 0.4), and s = 1 + 0.8 k1 + 0.64 k2.
    """
    s = 1 + 0.04 - 0.128
    np.testing.assert_allclose(lenses.bent(np.array([0.8, 0.4]), BEND), [
        0.8 * s + 2 * 0.02 * 0.32 - 0.03 * (0.8 + 1.28),
        0.4 * s - 2 * 0.03 * 0.32 + 0.02 * (0.8 + 0.32)])


def test_a_pixel_without_distortion_shows_what_its_ray_meets():
    """Rows are turned over, pixels are half a pixel off, or the principal point is the old frame's.

    The picture shows a wall at z = -1, whose colours are x and y. It is twice as fine as asked for.
    """
    across, down = np.mgrid[:80, :60] / 2 + 0.25
    ray = lenses.unbent(SHOT, np.array([(across - 22) / 36, (down - 13) / 34]))
    shot, seen = lenses.straight(SHOT, np.stack([*ray, *ray]).T[::-1])
    assert seen.shape == (shot.height, shot.width, 4) and shot.bend == camera_files.NO_BEND
    height, width = seen.shape[:2]
    x, y = (np.arange(width) + 0.5 - shot.cx) / 36, (np.arange(height)[::-1] + 0.5 - shot.cy) / 34
    inner = slice(4, -4), slice(4, -4)
    np.testing.assert_allclose(seen[..., 0][inner], np.tile(x, (height, 1))[inner], atol=2e-3)
    np.testing.assert_allclose(seen[..., 1][inner], np.tile(y, (width, 1)).T[inner], atol=2e-3)
    assert x[0] < ray[0].min() < x[1] and y[0] > ray[1].max() > y[1]  # all of the wall is there
