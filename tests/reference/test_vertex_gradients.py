"""What is given in lab 7: the residual, and the weights in perspective."""
import numpy as np

from course.checks import assert_close
from tests.labs.test_vertex_gradients import PIXEL, brightness, each_matrix


@each_matrix
def test_residuals_are_cramers(impl, m, rng):
    """The target is added, M is transposed, or its last row is taken for ones."""
    values, a = rng.normal(size=3), rng.normal(size=3)
    assert_close(impl.residual(values, m, a, 0.7), brightness(values, m, a, 0.7))


@each_matrix
def test_the_weighted_corners_lie_behind_the_pixel(impl, m):
    """M b does not point along a, or b has another sum: c has the sum 1 / w there."""
    b = np.asarray(impl.barycentric(m, PIXEL))
    assert_close(b.sum(), 1.0)
    assert_close(np.cross(m @ b, PIXEL), np.zeros(3), atol=1e-12)
