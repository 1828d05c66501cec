"""Lab 1: what is given, and the whole chain: `project` and its gradient."""
import numpy as np

from course.checks import assert_close
from course.given.gradcheck import gradcheck
from reference import transforms


def test_a_point_in_front_of_the_camera_lands_where_the_pinhole_says():
    """A transform is left out, comes in the wrong order, or y points down."""
    view = transforms.look_at(np.array([0.0, 0.0, 5.0]), np.zeros(3), np.array([0.0, 1.0, 0.0]))
    matrix = transforms.perspective(np.pi / 2, 2.0, 1.0, 9.0) @ view
    # 3 to the right and 1 up at a distance of 4, where 8 are seen across and 4 up to each side
    screen = transforms.project(np.array([[3.0, 1.0, 1.0]]), matrix, 80, 40)
    depth = (10 - 18 / 4) / 8  # (f + n - 2 f n / distance) / (f - n)
    np.testing.assert_allclose(screen, [[40 + 40 * 3 / 8, 20 + 20 * 1 / 4, depth]], rtol=1e-12)


def test_its_gradients_are_central_differences():
    """A step of the backward pass is missing, or takes the forward's value of another step."""
    rng = np.random.default_rng(0)
    matrix = transforms.perspective(1.0, 1.5, 1.0, 9.0) @ transforms.translate(np.array([0, 0, -4]))

    def backward(grad_screen, positions, matrix):
        return transforms.project_backward(grad_screen, positions, matrix, 60, 40)

    gradcheck(lambda positions, matrix: transforms.project(positions, matrix, 60, 40), backward,
              (rng.normal(size=(5, 3)), matrix), name="project")


def test_points_may_have_any_leading_axes(impl, rng):
    """The 1 stands in front, a 0 is appended, or the code works for an array (N, 3) alone."""
    for shape in (3,), (0, 3), (2, 5, 3):
        points = rng.normal(size=shape)
        expected = np.ones((*shape[:-1], 4))
        expected[..., :3] = points
        assert_close(impl.to_homogeneous(points), expected)


def test_a_translation_moves_points_and_not_directions(impl):
    """The offset stands in the last row (row vectors) instead of the last column."""
    matrix = impl.translate(np.array([5.0, 6.0, 7.0]))
    assert_close(matrix @ np.ones(4), [6.0, 7.0, 8.0, 1.0])
    assert_close(matrix @ np.array([1.0, 1.0, 1.0, 0.0]), [1.0, 1.0, 1.0, 0.0])


def test_a_scaling_stretches_each_axis(impl):
    """w is scaled, too, or one factor serves all axes."""
    assert_close(impl.scale(np.array([2.0, 3.0, -4.0])), [[2.0, 0.0, 0.0, 0.0],
                                                          [0.0, 3.0, 0.0, 0.0],
                                                          [0.0, 0.0, -4.0, 0.0],
                                                          [0.0, 0.0, 0.0, 1.0]])


def test_screen_points_of_ndc_points(impl, rng):
    """y is flipped, z was scaled, or width and height are swapped."""
    ndc = rng.uniform(-2, 2, (2, 5, 3))
    expected = np.stack([(ndc[..., 0] + 1) * 320.5, (ndc[..., 1] + 1) * 239.5, ndc[..., 2]], -1)
    assert_close(impl.to_screen(ndc, 641, 479), expected)
