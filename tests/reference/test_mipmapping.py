"""The reference's whole look-ups: `texture`, its gradients, and what they promise of bad input."""
import tracemalloc

import numpy as np
import pytest
from look_up_goldens import configs, require_chunks_change_nothing, require_look_ups

from course.checks import assert_equal
from course.given.gradcheck import gradcheck
from reference import mipmapping, texturing

GOLDEN = np.load("tests/golden/texture.npz")


@pytest.mark.parametrize(("scene", "config"), configs(GOLDEN))
def test_look_ups_and_gradients_are_those_of_nvdiffrast(scene, config):
    """Another colour or gradient than nvdiffrast's kernels give. Tolerances are those measured
    between its kernels in 32 and 64 bits.
    """
    require_look_ups(mipmapping.texture, mipmapping.texture_backward, ("image", "uv"), GOLDEN,
                     scene, config, boundary=str(GOLDEN[f"{scene}/boundary"]))


def scene(rng, filter, pixels=(4, 5)):
    """image, uv, jacobian and bias, with levels from below 0 to above the pyramid's end."""
    image, uv = rng.random((8, 16, 3)), rng.uniform(-0.6, 1.6, (*pixels, 2))
    jacobian = rng.normal(size=(*pixels, 2, 2)) * rng.uniform(0.02, 0.8, (*pixels, 1, 1))
    return image, uv, jacobian, rng.normal(size=pixels) / 2


@pytest.mark.parametrize("boundary", texturing.BOUNDARIES)
@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_every_gradient_is_a_central_difference(filter, boundary):
    """A gradient of another look-up than this one, in any filter and at any boundary."""
    rng = np.random.default_rng(5)
    image, uv, jacobian, bias = scene(rng, filter)
    top = len(mipmapping.pyramid(image)) - 1
    differentiable = {"nearest": [0], "linear-mipmap-linear": [0, 1, 2, 3]}.get(filter, [0, 1])

    def decisions(image, uv, jacobian, bias):
        level = mipmapping.mip_level(jacobian.reshape(-1, 2, 2), 16, 8) + bias.reshape(-1)
        sides = np.array([16, 8]) / 2.0 ** np.arange(5)[:, None, None, None]
        return (np.floor(np.clip(level, -1, top + 0.5)), np.floor(uv * np.maximum(sides, 1)),
                np.floor(uv * np.maximum(sides, 1) - 0.5))

    def backward(grad, *inputs):
        gradients = mipmapping.texture_backward(grad, *inputs, filter, boundary)
        return tuple(gradients[k] for k in differentiable)

    gradcheck(lambda *inputs: mipmapping.texture(*inputs, filter, boundary), backward,
              (image, uv, jacobian, bias), differentiable=differentiable, decisions=decisions,
              name=f"texture_{filter}_{boundary}")


@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_gradients_that_do_not_matter_are_zero(filter):
    """None or another shape, where the argument has no say. Or a number's gradient is an array."""
    image, uv, jacobian, bias = scene(np.random.default_rng(6), filter)
    for given, number in ((jacobian, 0.25), (jacobian, bias), (None, bias), (None, 1.25)):
        gradients = mipmapping.texture_backward(np.ones((4, 5, 3)), image, uv, given, number,
                                                filter)
        shapes = [np.shape(gradient) for gradient in gradients]
        assert shapes == [image.shape, uv.shape, np.shape(given), np.shape(number)]
        assert (gradients[2] is None) == (given is None)
        if filter != "linear-mipmap-linear":
            assert not np.any(gradients[3]) and (given is None or not gradients[2].any())
        assert gradients[1].any() == (filter != "nearest")


def test_a_scalar_bias_collects_all_pixels():
    """The gradient of one number is that of one pixel."""
    image, uv, jacobian, bias = scene(np.random.default_rng(7), "")
    rest = jacobian, 0.3, "linear-mipmap-linear"
    each = jacobian, np.full(bias.shape, 0.3), "linear-mipmap-linear"
    upstream = np.random.default_rng(8).normal(size=(4, 5, 3))
    one = mipmapping.texture_backward(upstream, image, uv, *rest)[3]
    many = mipmapping.texture_backward(upstream, image, uv, *each)[3]
    np.testing.assert_allclose(one, many.sum(), rtol=1e-12)


@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_chunks_and_leading_shapes_change_nothing(filter, monkeypatch):
    """A point is lost where one chunk ends, or (H, W) pixels differ from a list of H W."""
    image, uv, jacobian, bias = scene(np.random.default_rng(9), filter)
    line = image, uv.reshape(-1, 2), jacobian.reshape(-1, 2, 2), bias.reshape(-1), filter
    require_chunks_change_nothing(mipmapping.texture, mipmapping.texture_backward,
                                  np.ones((4, 5, 3)), (image, uv, jacobian, bias, filter), line,
                                  monkeypatch)


@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_no_pixels_are_no_error(filter):
    """A mesh that is not in the picture ends in an error."""
    empty = np.zeros((0, 2)), np.zeros((0, 2, 2)), np.zeros(0), filter
    assert mipmapping.texture(np.ones((4, 2, 3)), *empty).shape == (0, 3)
    gradients = mipmapping.texture_backward(np.zeros((0, 3)), np.ones((4, 2, 3)), *empty)
    assert [g.shape for g in gradients] == [(4, 2, 3), (0, 2), (0, 2, 2), (0,)]
    assert not gradients[0].any()


@pytest.mark.parametrize("boundary", ["wrap", "clamp"])
@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_a_texture_of_one_colour_stays_so(filter, boundary):
    """Weights that do not add up to 1 at a border, between two levels or at the last one."""
    _, uv, jacobian, bias = scene(np.random.default_rng(10), filter)
    colour = mipmapping.texture(np.full((8, 16, 2), 0.7), uv, jacobian, bias, filter, boundary)
    np.testing.assert_allclose(colour, 0.7, rtol=1e-12)


def test_pyramids_end_where_a_side_is_odd():
    """A level of half a texel, or a pyramid that never ends."""
    def sides(*shape, max_level=None):
        return [level.shape[:2] for level in mipmapping.pyramid(np.zeros((*shape, 1)), max_level)]

    assert sides(8, 2) == [(8, 2), (4, 1), (2, 1), (1, 1)]
    assert sides(8, 2, max_level=2) == [(8, 2), (4, 1), (2, 1)]
    assert sides(8, 2, max_level=0) == [(8, 2)]
    assert sides(12, 4) == [(12, 4), (6, 2), (3, 1)]
    assert sides(12, 4, max_level=9) == [(12, 4), (6, 2), (3, 1)]
    assert sides(5, 8) == [(5, 8)]
    assert sides(1, 1) == [(1, 1)]


def test_trilinear_is_nearer_to_the_truth_than_one_texel():
    """Filters that do not filter: a texture of fine noise, pixels of 4 x 4 texels."""
    rng = np.random.default_rng(11)
    image, uv = rng.random((64, 64, 1)), rng.random((200, 2))
    jacobian = np.broadcast_to(np.eye(2) * 4 / 64, (200, 2, 2))
    truth = texturing.footprint_mean(image, uv, jacobian, 16)
    error = {filter: np.abs(mipmapping.texture(image, uv, jacobian, 0.0, filter) - truth).mean()
             for filter in texturing.FILTERS}
    assert error["linear-mipmap-linear"] < 0.3 * error["linear"] < 0.3 * error["nearest"]


@pytest.mark.parametrize(("kind", "largest"), [("uint8", 255), ("int16", 32767),
                                               ("float16", 60000), ("float32", 1)])
@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_numbers_of_any_kind_are_read_as_float64(filter, kind, largest):
    """A pyramid of bytes overflows, one of short floats is rounded."""
    rng = np.random.default_rng(13)
    image, upstream = largest * rng.uniform(0.6, 1, (8, 16, 3)), rng.integers(0, 9, (4, 5, 3))
    footprint = [rng.integers(0, 3, (4, 5, *shape)) for shape in ((2,), (2, 2), ())]
    inputs = [array.astype(kind) for array in (upstream, image, *footprint)]
    wide = [array.astype(float) for array in inputs]
    np.testing.assert_array_equal(mipmapping.texture(*inputs[1:], filter),
                                  mipmapping.texture(*wide[1:], filter))
    assert_equal(mipmapping.texture_backward(*inputs, filter),
                 mipmapping.texture_backward(*wide, filter))


def test_the_mean_of_bytes_is_not_a_byte():
    """255 + 255 is 254, or a mean is rounded."""
    image = np.array([[255, 0], [255, 255]], np.uint8)[..., None]
    colour = mipmapping.texture(image, np.zeros((1, 2)), None, 1.0, "linear-mipmap-linear")
    np.testing.assert_array_equal(colour, [[191.25]])
    np.testing.assert_array_equal(mipmapping.pyramid(image)[-1], [[[191.25]]])


@pytest.mark.parametrize("far", [9e14, 1e16, 4e18, 1e300])
@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_far_outside_is_as_near_outside(filter, far):
    """Numbers of texels that do not fit into integers come out as any texel."""
    image, side = np.random.default_rng(14).random((16, 16384, 1)), np.array([[1.0], [-1.0]])
    for boundary in texturing.BOUNDARIES:
        got, expected = (mipmapping.texture(image, side * [u, 0.25], None, 0.75, filter, boundary)
                         for u in (far, 8.0))
        np.testing.assert_array_equal(got, expected)
        got, expected = (mipmapping.texture_backward(np.ones((2, 1)), image, side * [u, 0.26], None,
                                                     0.75, filter, boundary)[1] for u in (far, 8.0))
        np.testing.assert_array_equal(got, expected)


def test_numbers_may_come_as_lists():
    """An error from deep inside."""
    colour = mipmapping.texture([[[1], [3]]], [[0.5, 0.5]], [[[0.5, 0], [0, 1]]], [0])
    np.testing.assert_array_equal(colour, [[2.0]])


@pytest.mark.parametrize(("change", "sentence"), [
    ({"filter": "trilinear"}, "a filter out of nearest, linear"),
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


def test_an_upstream_gradient_of_another_shape_is_told():
    """The rows and columns of the pixels are swapped, and a gradient comes back all the same."""
    with pytest.raises(ValueError, match=r"grad_colour .*\(4, 5, 3\), got \(5, 4, 3\)"):
        mipmapping.texture_backward(np.zeros((5, 4, 3)), np.zeros((2, 2, 3)), np.zeros((4, 5, 2)))


def test_memory_does_not_grow_with_the_filter():
    """Forward, all weights of all pixels are held at once: 8 for each of 262,144 pixels."""
    uv = np.random.default_rng(12).random((512, 512, 2))
    tracemalloc.start()
    mipmapping.texture(np.ones((64, 64, 3)), uv, None, 1.5, "linear-mipmap-linear")
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 30e6
