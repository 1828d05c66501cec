"""What holds of whole look-ups in a picture and in a cube: `texture`, `cube_texture`, gradients."""
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest
from look_up_goldens import configs, cube_scene, picture_scene, require_look_ups

from course.given import arrays
from reference import cube_maps, mipmapping, texturing


class Kind(NamedTuple):
    """A look-up: its functions, a scene for it, nvdiffrast's numbers, their names of arguments."""

    look_up: Callable
    backward: Callable
    scene: Callable
    golden: np.lib.npyio.NpzFile
    names: tuple


PICTURE = Kind(mipmapping.texture, mipmapping.texture_backward, picture_scene,
               np.load("tests/golden/texture.npz"), ("image", "uv"))
CUBE = Kind(cube_maps.cube_texture, cube_maps.cube_texture_backward, cube_scene,
            np.load("tests/golden/cube_maps.npz"), ("faces", "directions"))
each_kind = pytest.mark.parametrize("kind", [PICTURE, CUBE], ids=["picture", "cube"])
each_filter = pytest.mark.parametrize("filter_mode", texturing.FILTERS)


@pytest.mark.parametrize(("kind", "scene", "config"), [
    (kind, *config) for kind in (PICTURE, CUBE) for config in configs(kind.golden)])
def test_look_ups_and_gradients_are_those_of_nvdiffrast(kind, scene, config):
    """Another face, texel, corner, colour or gradient than nvdiffrast's kernels give. Tolerances
    are those measured between its kernels in 32 and 64 bits.
    """
    boundary = {"boundary": str(kind.golden[f"{scene}/boundary"])} if kind is PICTURE else {}
    require_look_ups(kind.look_up, kind.backward, kind.names, kind.golden, scene, config,
                     **boundary)


@each_kind
@each_filter
def test_gradients_have_the_shapes_of_their_arguments(kind, filter_mode):
    """No jacobian has a gradient, or that of a number is an array, or of one pixel. What has no
    say has a gradient.
    """
    texture, places, jacobian, bias = kind.scene(np.random.default_rng(6))
    for given, number in (jacobian, 0.25), (jacobian, bias), (None, bias), (None, 0.5):
        def backward(number, given=given):
            return kind.backward(np.ones((4, 5, 3)), texture, places, given, number, filter_mode)

        gradients = backward(number)
        assert [np.shape(gradient) for gradient in gradients] == [
            texture.shape, places.shape, np.shape(given), np.shape(number)]
        assert (gradients[2] is None) == (given is None)
        if filter_mode != "linear-mipmap-linear":
            assert not np.any(gradients[3]) and (given is None or not gradients[2].any())
        assert gradients[1].any() == (filter_mode != "nearest")
        np.testing.assert_allclose(np.sum(gradients[3]), backward(number + 0 * bias)[3].sum(),
                                   rtol=1e-12)


@each_kind
@each_filter
def test_chunks_and_leading_shapes_change_nothing(kind, filter_mode, monkeypatch):
    """A point is lost where one chunk ends, or (H, W) pixels differ from a list of H W."""
    texture, places, jacobian, bias = kind.scene(np.random.default_rng(9))
    places[2, 3] = 0  # where a cube shows nothing
    upstream = np.random.default_rng(12).normal(size=(4, 5, 3))

    def both(upstream, *pixels):
        given = texture, *pixels, filter_mode
        return kind.look_up(*given), *kind.backward(upstream, *given)

    whole = both(upstream, places, jacobian, bias)
    monkeypatch.setattr(arrays, "ROWS", 3)
    parts = both(*(each.reshape(-1, *each.shape[2:])
                   for each in (upstream, places, jacobian, bias)))
    for one, other in zip(whole, parts, strict=True):
        np.testing.assert_allclose(one, other.reshape(one.shape), rtol=1e-12, atol=1e-15)


@each_kind
@each_filter
def test_no_pixels_are_no_error(kind, filter_mode):
    """A mesh that is not in the picture ends in an error."""
    texture, *pixels = kind.scene(np.random.default_rng(0))
    empty = texture, *(each[0, :0] for each in pixels), filter_mode
    assert kind.look_up(*empty).shape == (0, 3)
    gradients = kind.backward(np.zeros((0, 3)), *empty)
    assert [gradient.shape for gradient in gradients] == [each.shape for each in empty[:4]]
    assert not gradients[0].any()


@each_kind
def test_an_upstream_gradient_of_another_shape_is_told(kind):
    """The rows and columns of the pixels are swapped, and a gradient comes back all the same."""
    texture, places, *_ = kind.scene(np.random.default_rng(0))
    for shape in (5, 4, 3), (4, 5):
        with pytest.raises(ValueError, match=r"grad_colour .*\(4, 5, 3\)"):
            kind.backward(np.zeros(shape), texture, places)
