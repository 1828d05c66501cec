"""Whole pictures of lab 5: interpolation after lab 2's rasterizer, and what is given there."""
import numpy as np
import pytest

from course.given.gradcheck import gradcheck
from labkit.checks import assert_close, assert_equal
from reference import interpolation
from tests.labs.test_interpolation import by_uv, chosen_picture, each_golden, golden


@pytest.mark.parametrize("row", [-1, 4, 10**8])
def test_a_face_that_names_no_vertex_is_told(row):
    """SciPy trusts the column numbers: garbage from beside the array, or the end of the process."""
    attributes, faces = np.arange(8.0).reshape(4, 2), np.array([[0, 1, 2], [2, 1, row]])
    face_index, barycentric = np.array([[-1, 1, 0]]), np.full((1, 3, 3), 1 / 3)
    derivatives = np.zeros((1, 3, 3, 2))
    upstream = np.ones((1, 3, 2))
    for call in (lambda seen: interpolation.interpolate(attributes, faces, seen, barycentric),
                 lambda seen: interpolation.interpolate_backward(upstream, attributes, faces, seen,
                                                                 barycentric),
                 lambda seen: interpolation.interpolate_derivatives(attributes, faces, seen,
                                                                    derivatives)):
        with pytest.raises(IndexError, match="which have 4: give the faces"):
            call(face_index)
        call(np.minimum(face_index, 0))  # a face that nobody sees does no harm


def test_the_ends_are_met_to_the_bit(impl):
    """a + t (b - a) misses b: b - a has been rounded."""
    a, b = np.array([1e16, 0.1, -7.3]), np.array([1.0, -0.7, 1e-9])
    assert_equal(impl.lerp(a, b, 0.0), a)
    assert_equal(impl.lerp(a, b, 1.0), b)


@each_golden
def test_derivatives_are_those_of_nvdiffrast(scene):
    """dA/dx and dA/dy are exchanged or mixed with the channels, or only one of them goes back."""
    of = golden(scene)
    chosen = of["chosen"]
    given = of["attributes"][:, chosen], of["faces"], of["face_index"], of["all_derivatives"]
    got = interpolation.interpolate_derivatives(*given)
    assert_close(got, of["output_derivatives"], of["given"], rtol=0, atol=2e-6)
    grad_attributes, grad_derivatives = interpolation.interpolate_derivatives_backward(
        of["grad_output_derivatives"], *given)
    added = of["grad_attributes_both"] - of["grad_attributes"]
    assert_close(grad_attributes, added[:, chosen], of["given"], rtol=0, atol=3e-5)
    assert_close(by_uv(grad_derivatives), of["grad_derivatives"], of["given"], rtol=0, atol=3e-6)


def test_gradients_of_footprints_are_central_differences(rng):
    """A mean for a sum, or a sign; the background pulls."""
    (*given, _), _ = chosen_picture(rng, 3)
    gradcheck(interpolation.interpolate_derivatives,
              interpolation.interpolate_derivatives_backward,
              (*given, rng.normal(size=(7, 5, 3, 2))), name="interpolate_derivatives")
