"""Lab 1: the whole chain, `project`, and its gradient."""
import numpy as np

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
