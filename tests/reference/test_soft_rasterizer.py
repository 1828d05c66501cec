"""The reference's soft silhouettes and their gradients."""
import numpy as np
import pytest

from course.given.gradcheck import gradcheck
from reference import soft_rasterizer


def soft_by_search(screen, width, height, sigma, steps=2000):
    """The distance to many points of each border, and a winding number for inside."""
    outside = np.ones((height, width))
    along = np.linspace(0, 1, steps)[:, None]
    for face in screen:
        border = np.concatenate([a + along * (b - a) for a, b in
                                 zip(face, np.roll(face, -1, 0), strict=True)])
        for i, j in np.ndindex(height, width):
            p = np.array([j + 0.5, i + 0.5])
            distance = ((border - p)**2).sum(1).min()
            turn = np.arctan2(*(face - p).T)
            turn = (np.diff(turn, append=turn[0]) + np.pi) % (2 * np.pi) - np.pi
            s = distance / sigma * (1 if abs(turn.sum()) > 1 else -1)
            outside[i, j] *= 1 - 1 / (1 + np.exp(-s))
    return 1 - outside


def test_soft_silhouettes_are_those_of_a_search(rng):
    """A distance to an edge's line beyond its ends, or the sign of a clockwise face."""
    screen = rng.uniform(0, 9, (3, 3, 2))
    got = soft_rasterizer.soft_silhouette(screen, 9, 7, 1.5)
    np.testing.assert_allclose(got, soft_by_search(screen, 9, 7, 1.5), atol=1e-4)


@pytest.mark.parametrize("sigma", [0.1, 3.0])
def test_gradients_of_soft_silhouettes_are_central_differences(sigma):
    """The nearest point of an edge is given to one end alone, or the product of the others."""
    screen = np.random.default_rng(1).uniform(0, 15, (5, 3, 2))  # few decisions are near a change
    gradcheck(lambda screen: soft_rasterizer.soft_silhouette(screen, 15, 11, sigma),
              lambda grad, screen: (soft_rasterizer.soft_silhouette_backward(grad, screen, sigma),),
              (screen,), decisions=lambda screen: soft_rasterizer.soft_fragments(
                  screen, 15, 11, sigma)[:3], name="soft")
