"""What is given in lab 7: the residual, and the weights in perspective."""
import numpy as np
import pytest

from course.checks import assert_close

MATRICES = {
    "w differs": np.array([[-0.7, 2.1, 0.4], [-0.5, 0.3, 1.9], [1.0, 2.5, 1.6]]),
    "clockwise": np.array([[2.1, -0.7, 0.4], [0.3, -0.5, 1.9], [2.5, 1.0, 1.6]]),
    "a vertex behind the camera": np.array([[0.9, -1.6, 0.2], [0.4, 0.3, -1.1], [1.4, 2.0, -0.6]]),
}
each_matrix = pytest.mark.parametrize("m", MATRICES.values(), ids=MATRICES)
PIXEL = np.array([0.25, -0.375, 1.0])


@each_matrix
def test_residuals_are_cramers(impl, m, rng):
    """The target is added, M is transposed, or its last row is taken for ones."""
    values, a = rng.normal(size=3), rng.normal(size=3)
    replaced = [np.where(np.arange(3) == k, a[:, None], m) for k in range(3)]
    c = np.linalg.det(replaced) / np.linalg.det(m)
    assert_close(impl.residual(values, m, a, 0.7), values @ c - 0.7)


@each_matrix
def test_the_weighted_corners_lie_behind_the_pixel(impl, m):
    """M b does not point along a, or b has another sum: c has the sum 1 / w there."""
    b = np.asarray(impl.barycentric(m, PIXEL))
    assert_close(b.sum(), 1.0)
    assert_close(np.cross(m @ b, PIXEL), np.zeros(3), atol=1e-12)
