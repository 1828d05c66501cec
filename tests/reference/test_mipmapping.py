"""The reference's whole look-ups: `texture`, its gradients, and what they promise of bad input."""
import tracemalloc

import numpy as np
import pytest
from look_up_goldens import picture_scene

from course.given.gradcheck import gradcheck
from labkit.checks import assert_equal
from reference import mipmapping, texturing


@pytest.mark.parametrize("boundary", texturing.BOUNDARIES)
@pytest.mark.parametrize("filter_mode", texturing.FILTERS)
def test_every_gradient_is_a_central_difference(filter_mode, boundary):
    """A gradient of another look-up than this one, in any filter and at any boundary."""
    rng = np.random.default_rng(5)
    image, uv, jacobian, bias = picture_scene(rng)
    top = len(mipmapping.pyramid(image)) - 1
    differentiable = {"nearest": [0], "linear-mipmap-linear": [0, 1, 2, 3]}.get(filter_mode, [0, 1])

    def decisions(image, uv, jacobian, bias):
        level = mipmapping.mip_level(jacobian.reshape(-1, 2, 2), 16, 8) + bias.reshape(-1)
        sides = np.array([16, 8]) / 2.0 ** np.arange(5)[:, None, None, None]
        return (np.floor(np.clip(level, -1, top + 0.5)), np.floor(uv * np.maximum(sides, 1)),
                np.floor(uv * np.maximum(sides, 1) - 0.5))

    def backward(grad, *inputs):
        gradients = mipmapping.texture_backward(grad, *inputs, filter_mode, boundary)
        return tuple(gradients[k] for k in differentiable)

    gradcheck(lambda *inputs: mipmapping.texture(*inputs, filter_mode, boundary), backward,
              (image, uv, jacobian, bias), differentiable=differentiable, decisions=decisions,
              name=f"texture_{filter_mode}_{boundary}")


def test_the_level_of_a_square_footprint_and_of_none():
    """0 / 0 where R or J is 0. Or a small number is added to R, in place of the case R = 0."""
    jacobian = np.array([[[0.5, 0.0], [0.0, 1.0]], [[0.0, -0.25], [0.5, 0.0]], np.zeros((2, 2)),
                         [[1e-9, 0.0], [0.0, 1e-9]]])
    got = mipmapping.mip_level_backward(np.log(2.0) * np.ones(4), jacobian, 8, 4)
    np.testing.assert_allclose(got, [[[1, 0], [0, 0.5]], [[0, -2], [1, 0]], np.zeros((2, 2)),
                                     [[1e9, 0], [0, 0]]], atol=1e-3)


@pytest.mark.parametrize(("kind", "largest"), [("uint8", 255), ("int16", 32767),
                                               ("float16", 60000), ("float32", 1)])
@pytest.mark.parametrize("filter_mode", texturing.FILTERS)
def test_numbers_of_any_kind_are_read_as_float64(filter_mode, kind, largest):
    """A pyramid of bytes overflows, one of short floats is rounded."""
    rng = np.random.default_rng(13)
    image, upstream = largest * rng.uniform(0.6, 1, (8, 16, 3)), rng.integers(0, 9, (4, 5, 3))
    footprint = [rng.integers(0, 3, (4, 5, *shape)) for shape in ((2,), (2, 2), ())]
    inputs = [array.astype(kind) for array in (upstream, image, *footprint)]
    wide = [array.astype(float) for array in inputs]
    np.testing.assert_array_equal(mipmapping.texture(*inputs[1:], filter_mode),
                                  mipmapping.texture(*wide[1:], filter_mode))
    assert_equal(mipmapping.texture_backward(*inputs, filter_mode),
                 mipmapping.texture_backward(*wide, filter_mode))


@pytest.mark.parametrize("far", [9e14, 1e16, 4e18, 1e300])
@pytest.mark.parametrize("filter_mode", texturing.FILTERS)
def test_far_outside_is_as_near_outside(filter_mode, far):
    """Numbers of texels that do not fit into integers come out as any texel."""
    image, side = np.random.default_rng(14).random((16, 16384, 1)), np.array([[1.0], [-1.0]])
    for boundary in texturing.BOUNDARIES:
        given = None, 0.75, filter_mode, boundary
        got, expected = (mipmapping.texture(image, side * [u, 0.25], *given) for u in (far, 8.0))
        np.testing.assert_array_equal(got, expected)
        got, expected = (mipmapping.texture_backward(np.ones((2, 1)), image, side * [u, 0.26],
                                                     *given)[1] for u in (far, 8.0))
        np.testing.assert_array_equal(got, expected)


def test_numbers_may_come_as_lists():
    """An error from deep inside."""
    colour = mipmapping.texture([[[1], [3]]], [[0.5, 0.5]], [[[0.5, 0], [0, 1]]], [0])
    np.testing.assert_array_equal(colour, [[2.0]])


@pytest.mark.parametrize(("change", "sentence"), [
    ({"filter_mode": "trilinear"}, "a filter out of nearest, linear"),
    ({"boundary": "mirror"}, "a boundary out of wrap, clamp, zero"),
    ({"image": np.zeros((4, 4))}, r"an image \(h, w, C\)"),
    ({"image": np.zeros((0, 4, 3))}, "at least one texel"),
    ({"uv": np.zeros((5, 3))}, r"uv \(..., 2\)"),
    ({"uv": np.full((5, 2), np.nan)}, "finite numbers"),
    ({"uv": np.full((5, 2), -np.inf), "boundary": "clamp"}, "finite numbers"),
    ({"bias": np.zeros(4)}, r"a finite bias \(5,\)"), ({"bias": np.inf}, "a finite bias"),
    ({"bias": np.nan}, "NaN"), ({"jacobian": np.zeros((5, 4))}, r"a jacobian \(5, 2, 2\)"),
    ({"jacobian": np.full((5, 2, 2), 1e160)}, "numbers below"),
    ({"max_level": -1}, "a max_level of 0 or more")])
def test_bad_input_is_told_in_a_sentence(change, sentence):
    """An error from deep inside, or none at all."""
    arguments = {"image": np.zeros((4, 4, 3)), "uv": np.zeros((5, 2))} | change
    with pytest.raises(ValueError, match=f"texture expects .*{sentence}"):
        mipmapping.texture(**arguments)
    with pytest.raises(ValueError, match="texture"):
        mipmapping.texture_backward(np.zeros((5, 3)), **arguments)


def test_memory_does_not_grow_with_the_filter():
    """Forward, all weights of all pixels are held at once: 8 for each of 262,144 pixels."""
    uv = np.random.default_rng(12).random((512, 512, 2))
    tracemalloc.start()
    mipmapping.texture(np.ones((64, 64, 3)), uv, None, 1.5, "linear-mipmap-linear")
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 30e6
