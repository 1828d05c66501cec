"""The reference's whole pictures: coverage and its gradient, and what lab 3 says of filters."""
import numpy as np
import pytest

from course.given.gradcheck import gradcheck
from reference import sampling


@pytest.mark.parametrize("seed", range(4))
def test_whole_pictures_and_the_loop_agree(seed):
    """A pixel that the border touches counts as full or as empty."""
    rng = np.random.default_rng(seed)
    for _ in range(15):
        triangle = rng.uniform(-4, 14, (3, 2))
        if seed % 2:  # corners on those of pixels, edges along their sides
            triangle = np.round(triangle)
        loop = sampling.pixel_coverage_loop(triangle, 10, 8)
        np.testing.assert_allclose(sampling.pixel_coverage(triangle, 10, 8), loop, 0, 1e-12)


@pytest.mark.parametrize("size", [1e-3, 1.0, 30.0, 500.0])
def test_coverages_sum_to_the_area(size):
    """A pixel is left out, or counted full although its corner is cut off."""
    rng = np.random.default_rng(7)
    for corners in rng.uniform(0, 1, (8, 3, 2)):
        triangle = 3 + size * corners
        side_1, side_2 = triangle[1] - triangle[0], triangle[2] - triangle[0]
        area = abs(side_1[0] * side_2[1] - side_1[1] * side_2[0]) / 2
        total = sampling.pixel_coverage(triangle, 512, 512).sum()
        np.testing.assert_allclose(total, area, rtol=1e-12, atol=1e-15)


def test_a_thin_and_a_huge_triangle_in_a_large_picture():
    """Only pixels whose centre lies inside are looked at; or a wide picture runs out of memory."""
    thin = np.array([[0.3, 0.4], [499.7, 399.5], [499.7, 399.502]])
    coverage = sampling.pixel_coverage(thin, 512, 512)
    np.testing.assert_allclose(coverage.sum(), 499.4 * 0.002 / 2, rtol=1e-9)
    assert 0 < coverage.max() < 0.01
    huge = np.array([[-1e6, -1e6], [1e6, -1e6], [0.0, 2e6]])
    np.testing.assert_array_equal(sampling.pixel_coverage(huge, 512, 512), np.ones((512, 512)))


@pytest.mark.parametrize("winding", [1, -1])
def test_coverage_has_a_gradient(winding):
    """Clockwise, the sign is lost; or a pixel's gradient goes to another pixel."""
    triangle = np.array([[1.2, -1.7], [6.3, 2.1], [2.9, 5.8]])[::winding].copy()
    gradcheck(lambda triangle: sampling.pixel_coverage(triangle, 8, 5),
              sampling.pixel_coverage_backward, (triangle,), name="pixel_coverage")


def test_pictures_without_a_border_have_no_gradient():
    """An error where no pixel is touched, or a gradient from pixels that are full."""
    for triangle in np.array([[-99.0, -99.0], [99.0, -99.0], [0.0, 99.0]]), np.full((3, 2), -1.0):
        gradient = sampling.pixel_coverage_backward(np.ones((4, 5)), triangle)
        np.testing.assert_array_equal(gradient, np.zeros((3, 2)))


def test_only_a_filter_before_sampling_removes_an_alias():
    """sample_then_blur filters first, or filter_then_sample does not."""
    step, n = 3, 81
    picture = np.tile(np.cos(2 * np.pi * 30 * np.arange(n) / n), (n, 1))  # 1/3 fold at every third
    alias = np.cos(2 * np.pi * 3 * np.arange(n // step) / (n // step))    # 30 - 27 = 3 periods
    np.testing.assert_allclose(picture[::step, ::step][0], alias, atol=1e-12)
    before = sampling.filter_then_sample(picture, step)
    after = sampling.sample_then_blur(picture, step)
    weakened = [np.abs(filtered).max() for filtered in (before, after)]
    f, g = 30 / n, 3 / (n // step)
    expected = [abs(np.sin(3 * np.pi * f) / (3 * np.sin(np.pi * f))),
                abs(np.sin(3 * np.pi * g) / (3 * np.sin(np.pi * g)))]
    np.testing.assert_allclose(weakened, expected, atol=1e-12)
    assert weakened[0] < 0.2 < 0.8 < weakened[1]


@pytest.mark.parametrize("width", [0, 2, -3])
def test_a_box_without_a_middle_is_refused(width):
    """The mean of 2 x 2 pixels moves the picture by half a pixel, and nobody is told."""
    sentence = f"odd width, 1 or more, .* got {width}"
    with pytest.raises(ValueError, match=sentence):
        sampling.filter_then_sample(np.eye(6), width)
    with pytest.raises(ValueError, match=sentence):
        sampling.sample_then_blur(np.eye(6), 2, width)
