"""What is given in antialiasing."""
import numpy as np

from course.checks import assert_close, assert_equal


def test_the_nearer_face_owns_the_edge(impl):
    """The farther one does, or always the first. Or the depth of the wrong pixels is read."""
    depth = np.array([[0.1, 0.7, 0.3], [-0.5, np.inf, 0.2]])
    first, second = np.array([0, 1, 0, 4, 2]), np.array([1, 2, 3, 5, 5])
    assert_equal(impl.owner_and_other(first, second, depth), ([0, 2, 3, 5, 5], [1, 1, 0, 4, 2]))


def test_the_smallest_difference_in_depth_decides(impl):
    """A threshold: faces that are nearly as deep count as equally deep."""
    depth = np.array([[0.5, 0.5 - 1e-12], [0.5 + 1e-12, 0.5]])
    assert_equal(impl.owner_and_other(np.array([0, 0]), np.array([1, 2]), depth), ([1, 0], [0, 2]))


def test_of_equally_deep_faces_the_second_is_the_owner(impl):
    """<= for <."""
    owner, other = impl.owner_and_other(np.array([0, 1]), np.array([1, 2]), np.full((1, 3), 0.5))
    assert_equal((owner, other), ([1, 2], [0, 1]))


def test_a_saturated_weight_has_no_gradient(impl):
    """The gradient goes on where the weight does not, or its sign is lost."""
    c = np.array([-0.06, 0.0, 1e-9, 0.125, 0.5, 0.75, 1 - 1e-9, 1.0, 1.05])
    grad_alpha = np.arange(1.0, 10.0)
    expected = [0.0, 0.0, -3.0, -4.0, -5.0, -6.0, -7.0, 0.0, 0.0]
    assert_close(impl.blend_weight_backward(grad_alpha, c), expected)
