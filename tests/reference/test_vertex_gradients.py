"""What is given in lab 7: the residual, and the weights in perspective."""
import numpy as np
import pytest

from course.checks import assert_close

# A triangle for paper: c = (1 - x/4 - y/2, x/4, y/2).
PAPER = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]])
A = np.array([1.0, 1.0, 1.0])
VALUES = np.array([8.0, 0.0, 4.0])  # f = 8 - 2 x - 2 y, less the target

# In perspective, vertex 1 with w = 1/2: c = (1 - x/4 - y/2, x/2, y/2).
NEAR = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])

MATRICES = {
    "w differs": np.array([[-0.7, 2.1, 0.4], [-0.5, 0.3, 1.9], [1.0, 2.5, 1.6]]),
    "clockwise": np.array([[2.1, -0.7, 0.4], [0.3, -0.5, 1.9], [2.5, 1.0, 1.6]]),
    "a vertex behind the camera": np.array([[0.9, -1.6, 0.2], [0.4, 0.3, -1.1], [1.4, 2.0, -0.6]]),
}
each_matrix = pytest.mark.parametrize("m", MATRICES.values(), ids=MATRICES)
PIXEL = np.array([0.25, -0.375, 1.0])


def test_residuals_on_paper(impl):
    """The target is added, or the weights go to the wrong vertices."""
    for x, y, target in (1.0, 1.0, 3.0), (0.0, 0.0, 0.0), (4.0, 0.0, -1.0), (3.0, 0.5, 0.25):
        got = impl.residual(VALUES, PAPER, np.array([x, y, 1.0]), target)
        assert_close(got, 8 - 2 * x - 2 * y - target)


@each_matrix
def test_residuals_are_cramers(impl, m, rng):
    """M is transposed, or its last row is taken for ones."""
    values, a = rng.normal(size=3), rng.normal(size=3)
    replaced = [np.where(np.arange(3) == k, a[:, None], m) for k in range(3)]
    c = np.linalg.det(replaced) / np.linalg.det(m)
    assert_close(impl.residual(values, m, a, 0.7), values @ c - 0.7)


def test_weights_on_paper(impl):
    """c is not divided by its sum: it has the sum 1 / w there."""
    assert_close(impl.barycentric(NEAR, np.array([1.0, 0.0, 1.0])), np.array([0.6, 0.4, 0.0]))
    assert_close(impl.barycentric(NEAR, np.array([2.0, 0.5, 1.0])),
                 np.array([0.25, 1.0, 0.25]) / 1.5)
    assert_close(impl.barycentric(PAPER, A), np.array([0.25, 0.25, 0.5]))


@each_matrix
def test_the_weighted_corners_lie_behind_the_pixel(impl, m):
    """M b does not point along a, or b has another sum."""
    b = np.asarray(impl.barycentric(m, PIXEL))
    assert_close(b.sum(), 1.0)
    assert_close(np.cross(m @ b, PIXEL), np.zeros(3), atol=1e-12)
