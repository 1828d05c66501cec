"""The texels of a look-up beside exact arithmetic, the mean of a footprint, and what is given."""
from fractions import Fraction
from math import floor

import numpy as np
import pytest

from labkit.checks import assert_equal
from reference import texturing


def exact_texels(x, size, filter_mode, boundary):
    """Eqs. (1) and (2) with boundaries in fractions: the weights of all texels along one axis."""
    position = Fraction(x) * size - (Fraction(1, 2) if filter_mode == "linear" else 0)
    a = position - floor(position) if filter_mode == "linear" else 0
    weights = [Fraction(0)] * size
    for texel, weight in (floor(position), 1 - a), (floor(position) + 1, a):
        if boundary == "wrap":
            weights[texel % size] += weight
        elif boundary == "clamp":
            weights[min(max(texel, 0), size - 1)] += weight
        elif 0 <= texel < size:
            weights[texel] += weight
    return weights


AWKWARD = [0.0, -0.0, 1.0, -1.0, 2.0, -3.0, 0.5, -0.5, 1.5, 0.125, 0.9999999, 5e-324, -5e-324,
           -1e-20, -1e-17, 1 - 2**-53, 2**53 + 2.0, -2.0**60, 9e14 + 0.125, -9e14, 1e17, 1.7e308,
           -1.7e308, *np.random.default_rng(0).uniform(-5, 5, 20)]


@pytest.mark.parametrize("size", [1, 2, 3, 5, 8])
@pytest.mark.parametrize("boundary", texturing.BOUNDARIES)
@pytest.mark.parametrize("filter_mode", ["nearest", "linear"])
def test_the_texels_on_an_axis_are_those_of_exact_arithmetic(filter_mode, boundary, size):
    """A whole number, a tiny one or a huge one is off by a texel, or by all of them."""
    near = texturing.near_texture(np.array(AWKWARD), boundary)
    texels = texturing.nearest_at if filter_mode == "nearest" else texturing.texels_at
    index, weight, inside = texels(np.stack([near, 0 * near + 0.5], 1), size, 1, boundary)
    assert ((index >= 0) & (index < size)).all()
    assert not weight[~inside].any()
    for n, x in enumerate(AWKWARD):
        expected = [float(part) for part in exact_texels(x, size, filter_mode, boundary)]
        np.testing.assert_allclose(np.bincount(index[:, n], weight[:, n], size), expected,
                                   atol=1e-14, err_msg=x)


def test_the_mean_of_a_footprint_of_whole_texels_is_exact():
    """The footprint is off by half a pixel, or mirrored: 2 x 3 texels."""
    image = np.arange(48.0).reshape(6, 8, 1)
    jacobian = np.array([[[2 / 8, 0.0], [0.0, 3 / 6]]])
    got = texturing.footprint_mean(image, np.array([[4 / 8, 1.5 / 6]]), jacobian, 6)
    np.testing.assert_allclose(got, image[0:3, 3:5].mean((0, 1))[None], rtol=1e-12)


def test_every_point_may_have_its_own_size(impl):
    """A size for all: the levels of a pyramid have different ones. Or a texture of many turns."""
    x, size = np.array([[0.7, 0.7, 0.7], [-1.3, 9.3, 1000.6]]), np.array([[1, 2, 8], [3, 5, 16]])
    assert_equal(impl.nearest_texel(x, size), [[0, 1, 5], [-4, 46, 16009]])
