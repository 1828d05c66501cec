"""What the exercise of multi_view_fit.py must do: the step of the search, there and back."""
import numpy as np

from course.checks import assert_close, exercise
from course.given.gradcheck import gradcheck

Y0, Y1 = np.sqrt(np.array([1, 3]) / np.pi) / 2
IN_FRONT = np.array([[2.0, 0, 0, 0], [0, 2, 0, 0], [0, 0, -1, 0], [0, 0, -1, 3]])
FROM_THE_SIDE = IN_FRONT @ np.array([[0.6, 0, -0.8, 0], [0, 1, 0, 0.1], [0.8, 0, 0.6, 0],
                                     [0, 0, 0, 1]])


def view_of(camera, target, outside=False):
    """What `see` takes: the target, the camera's view, one sample a pixel, and what is outside."""
    height, width, _ = target.shape
    view = camera, width, height, np.array([0.3, 0.1, 0.2, 0.0])
    return target, view, 1, np.full((height, width), outside)


def solid():
    """A tetrahedron, its albedo, and a light: vertices, faces, albedo (4, 3), light (9, 3)."""
    rng = np.random.default_rng(4)
    vertices = np.array([[0.9, 0.1, -0.2], [-0.7, 0.6, -0.3], [-0.3, -0.8, -0.1], [0.1, 0.2, 0.8]])
    faces = np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 2, 1]])
    light = rng.uniform(-0.3, 0.3, (9, 3))
    light[0] = 3.0, 2.5, 2.0
    return vertices, faces, rng.uniform(0.2, 0.8, (4, 3)), light


def two_views():
    targets = np.random.default_rng(5).uniform(0, 1, (2, 7, 8, 4))
    views = tuple(view_of(camera, target, outside=True) for camera, target in
                  zip((IN_FRONT, FROM_THE_SIDE), targets, strict=True))
    return views, targets


@exercise("16.15")
def test_a_face_that_fills_the_picture_on_paper(impl):
    """Coverage or its weight is left out; a sum for a mean; or what goes back is of the target."""
    vertices = np.array([[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [-1.0, 3.0, 0.0]])
    light = np.zeros((9, 3))
    light[0], light[2, 0] = np.array([3, 1, 2]) / Y0, 1 / Y1
    target = np.tile([1.0, 0.5, 0.0, 0.5], (2, 3, 1))
    loss, grad_vertices, grad_albedo, grad_light, grad_level = impl.there_and_back(
        vertices, np.array([[0, 1, 2]]), np.full((3, 3), 0.5), light,
        (view_of(np.eye(4), target, outside=True),), target[None], 4.0)
    assert_close(loss, 2 / 3 + 1)  # the picture is (2, 0.5, 1, 1)
    assert_close(np.sum(grad_albedo, 0), np.array([8 / 3, 0, 4 / 3]))
    assert_close(np.array(grad_light)[:3] / [[Y0], [Y1], [Y1]],
                 np.array([[1, 0, 1], [0, 0, 0], [1, 0, 1]]) / 3)
    assert_close(grad_vertices, np.zeros((3, 3)))
    assert_close(np.sum(grad_level), -1.0)  # every pixel asks the surface to go


@exercise("16.15")
def test_two_views_are_the_mean_of_each_alone(impl):
    """The last view decides, views add up, or one is compared with the other's target."""
    (vertices, faces, albedo, light), (views, targets) = solid(), two_views()

    def found(chosen):
        return impl.there_and_back(vertices, faces, albedo, light, views[chosen], targets[chosen],
                                   0.7)

    both = zip(found(slice(0, 1)), found(slice(1, 2)), strict=True)
    for got, (first, second) in zip(found(slice(0, 2)), both, strict=True):
        assert_close(got, (np.asarray(first) + np.asarray(second)) / 2)


@exercise("16.15")
def test_the_whole_step_is_central_differences(impl):
    """A way back is missing: through outlines, normals, shading, or paint."""
    (vertices, faces, albedo, light), (views, targets) = solid(), two_views()
    rng = np.random.default_rng(6)
    directions = [rng.normal(size=part.shape) for part in (vertices, albedo, light)]

    def moved(steps):
        places = [part + step * direction for part, step, direction in
                  zip((vertices, albedo, light), steps, directions, strict=True)]
        return impl.there_and_back(places[0], faces, *places[1:], views, targets, 0.7)

    def backward(grad_loss, steps):
        gradients = map(np.asarray, moved(steps)[1:4])
        return grad_loss * np.array([(gradient * direction).sum() for gradient, direction in
                                     zip(gradients, directions, strict=True)])

    gradcheck(lambda steps: np.array(moved(steps)[0]), backward, (np.zeros(3),), name="the step")
