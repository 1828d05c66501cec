"""The reference's cube maps: whole look-ups, seams and corners, and what they say of bad input."""
import itertools

import numpy as np
import pytest
from look_up_goldens import configs, require_chunks_change_nothing, require_look_ups

from course.checks import assert_equal
from course.given.gradcheck import gradcheck
from reference import cube_maps, mipmapping, texturing

GOLDEN = np.load("tests/golden/cube_maps.npz")
CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
EDGES = [(a, b) for a, b in itertools.combinations(CORNERS, 2) if (a != b).sum() == 1]


@pytest.mark.parametrize(("scene", "config"), configs(GOLDEN))
def test_look_ups_and_gradients_are_those_of_nvdiffrast(scene, config):
    """Another face, texel, corner or gradient than nvdiffrast's kernels give."""
    require_look_ups(cube_maps.cube_texture, cube_maps.cube_texture_backward,
                     ("faces", "directions"), GOLDEN, scene, config)


def numbered(size):
    """A cube whose texels are numbers, face by face and row by row."""
    return np.arange(6.0 * size**2).reshape(6, size, size, 1)


def test_each_texel_is_seen_in_its_own_direction():
    """(u, v) and the direction to it do not fit together."""
    for size in 1, 3, 8:
        directions = cube_maps.texel_directions(size)
        for filter in texturing.FILTERS:
            got = cube_maps.cube_texture(numbered(size), directions, filter=filter)
            np.testing.assert_allclose(got, numbered(size), atol=1e-9)


def test_a_direction_too_short_to_divide_by_sees_nothing():
    """1 / m is infinite, and 0 times that is NaN, in the gradient of a fit's whole texture."""
    directions = np.array([[0.0, 0, 0], [1e-320, 2e-320, 0], [3e-200, 0, 0], [1e-140, 3e-141, 0]])
    jacobian = np.ones((4, 3, 2)) * np.abs(directions).max(-1)[:, None, None]
    look = numbered(4) + 1.0, directions, jacobian
    given = {"filter": "linear-mipmap-linear"}
    np.testing.assert_array_equal(cube_maps.cube_texture(*look, **given)[:, 0] > 0, [0, 0, 0, 1])
    _, *grads = cube_maps.cube_texture_backward(np.ones((4, 1)), *look, **given)
    for grad in grads[:2]:
        assert np.isfinite(grad).all() and not grad[:3].any() and grad[3].any()


@pytest.mark.parametrize("size", [1, 2, 3, 8])
@pytest.mark.parametrize("filter", ["linear", "linear-mipmap-linear"])
def test_colours_are_continuous_across_all_seams(size, filter):
    """A jump at an edge or at a corner of the cube, in level 0 or above."""
    rng = np.random.default_rng(1)
    faces = rng.random((6, size, size, 2))
    on = [a + (b - a) * t for a, b in EDGES for t in (0, 1e-3, 0.03, *rng.random(9), 0.98, 1)]
    around = 1e-9 * rng.normal(size=(6, 1, 3))
    for bias in 0.0, 0.4, 1.0:
        colour = cube_maps.cube_texture(faces, np.array(on) + around, None, bias, filter)
        np.testing.assert_allclose(colour, np.broadcast_to(colour[0], colour.shape), atol=1e-7)


def test_a_corner_is_the_mean_of_three_texels():
    """The fourth texel, which is not there, counts as black, or one of the three counts twice."""
    faces = numbered(4)
    for corner in CORNERS:
        near = np.argsort(-(cube_maps.texel_directions(4) @ corner).ravel())[:3]
        colour = cube_maps.cube_texture(faces, corner)
        np.testing.assert_allclose(colour, [faces.ravel()[near].mean()])


def test_a_linear_function_of_the_place_on_the_cube_comes_back():
    """Taps or weights are off by a part of a texel: the error is more than a tenth of one."""
    rng = np.random.default_rng(2)
    slope, size = rng.normal(size=(3, 2)), 32
    points = rng.normal(size=(2000, 3))
    points /= np.abs(points).max(1, keepdims=True)
    got = cube_maps.cube_texture(cube_maps.texel_directions(size) @ slope, points)
    inside = np.sort(np.abs(points), 1)[:, 1] < 1 - 1 / size
    np.testing.assert_allclose(got[inside], (points @ slope)[inside], atol=1e-12)
    assert np.abs(got - points @ slope).max() < 2 / size and inside.mean() > 0.8


def scene(rng, pixels=(5, 6), size=8):
    """faces, directions, jacobian and bias, with levels from below 0 to above the pyramid's end."""
    directions = rng.normal(size=(*pixels, 3))
    stretch = np.abs(directions).max(-1)[..., None, None] * rng.uniform(0.05, 1.5, (*pixels, 1, 1))
    return (rng.random((6, size, size, 3)), directions, stretch * rng.normal(size=(*pixels, 3, 2)),
            rng.normal(size=pixels) / 2)


@pytest.mark.parametrize("size", [1, 8])
@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_every_gradient_is_a_central_difference(filter, size):
    """A gradient of another look-up than this one, also at edges and corners, in any filter."""
    rng = np.random.default_rng(5)
    faces, directions, jacobian, bias = scene(rng, size=size)
    directions[0] = 1.3 * CORNERS[:6] + rng.uniform(-0.1, 0.1, (6, 3))
    directions[1] = np.array([a + 0.4 * (b - a) for a, b in EDGES[:6]]) * [1.0, 1.04, 0.97]
    differentiable = {"nearest": [0], "linear-mipmap-linear": [0, 1, 2, 3]}.get(filter, [0, 1])
    if size == 1 and filter == "linear-mipmap-linear":
        differentiable = [0, 1]                        # there is no level but one

    def decisions(faces, directions, jacobian, bias):
        rows = directions.reshape(-1, 3)
        face, uv = cube_maps.on_face(rows)
        on_face = cube_maps.face_footprint(rows, jacobian.reshape(-1, 3, 2))
        level = mipmapping.mip_level(on_face, size, size) + bias.reshape(-1)
        sides = size / 2.0 ** np.arange(size.bit_length())[:, None, None]
        return face, np.floor(np.clip(level, -1, 3.5)), np.floor(uv * sides - 0.5)

    def backward(grad, *inputs):
        gradients = cube_maps.cube_texture_backward(grad, *inputs, filter)
        return tuple(gradients[k] for k in differentiable)

    gradcheck(lambda *inputs: cube_maps.cube_texture(*inputs, filter), backward,
              (faces, directions, jacobian, bias), differentiable=differentiable,
              decisions=decisions, name=f"cube_texture_{filter}_{size}")


def test_the_length_of_a_direction_does_not_matter():
    """A footprint or a level that grows with the length, or a gradient along the direction."""
    faces, directions, jacobian, bias = scene(np.random.default_rng(7))
    look = jacobian, bias, "linear-mipmap-linear"
    colour = cube_maps.cube_texture(faces, directions, *look)
    for length in 1e-3, 7.0:
        longer = length * directions, length * jacobian, bias, "linear-mipmap-linear"
        np.testing.assert_allclose(cube_maps.cube_texture(faces, *longer), colour, rtol=1e-9)
    _, along, _, _ = cube_maps.cube_texture_backward(np.ones(colour.shape), faces, directions)
    assert along.any()
    np.testing.assert_allclose((along * directions).sum(-1), 0, atol=1e-12)


@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_a_cube_of_one_colour_stays_so(filter):
    """Weights that do not add up to 1 at an edge, at a corner or between two levels."""
    _, directions, jacobian, bias = scene(np.random.default_rng(8))
    directions[0] = CORNERS[:6]
    faces = np.full((6, 8, 8, 2), 0.7)
    got = cube_maps.cube_texture(faces, directions, jacobian, bias, filter)
    np.testing.assert_allclose(got, 0.7, rtol=1e-12)


@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_a_direction_of_zero_sees_nothing(filter):
    """Pixels without a face are NaN, or pull at a texel."""
    faces, directions, jacobian, bias = scene(np.random.default_rng(9))
    directions[1:3] = 0
    arguments = faces, directions, jacobian, bias, filter
    colour = cube_maps.cube_texture(*arguments)
    assert not colour[1:3].any() and colour[0].all()
    upstream = np.ones(colour.shape)
    whole = cube_maps.cube_texture_backward(upstream, *arguments)
    assert not any(grad[1:3].any() for grad in whole[1:])
    upstream[1:3] = 1e9
    assert_equal(cube_maps.cube_texture_backward(upstream, *arguments), whole)


def test_the_pyramid_is_that_of_each_face():
    """A mean over two faces, or a face of one texel that is averaged with the next face."""
    for size, sides in (8, [8, 4, 2, 1]), (6, [6, 3]), (1, [1]):
        faces = np.random.default_rng(10).random((6, size, size, 1))
        levels = cube_maps.cube_pyramid(faces.reshape(-1, size, 1), "linear-mipmap-linear", None)
        mipmap = cube_maps.pack_cube(levels)
        assert mipmap.width.tolist() == mipmap.height.tolist() == sides
        last = mipmap.texels[mipmap.start[-1]:].reshape(6, -1).mean(1)
        np.testing.assert_allclose(last, faces.mean((1, 2, 3)))


@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_chunks_and_leading_shapes_change_nothing(filter, monkeypatch):
    """A pixel is lost where one chunk ends, or (H, W) pixels differ from a list of H W."""
    faces, directions, jacobian, bias = scene(np.random.default_rng(11))
    directions[2, 3] = 0
    upstream = np.random.default_rng(12).normal(size=(5, 6, 3))
    line = faces, directions.reshape(-1, 3), jacobian.reshape(-1, 3, 2), bias.reshape(-1), filter
    require_chunks_change_nothing(cube_maps.cube_texture, cube_maps.cube_texture_backward, upstream,
                                  (faces, directions, jacobian, bias, filter), line, monkeypatch)


@pytest.mark.parametrize("filter", texturing.FILTERS)
def test_no_pixels_are_no_error(filter):
    """A mesh that is not in the picture ends in an error."""
    empty = np.zeros((0, 3)), np.zeros((0, 3, 2)), np.zeros(0), filter
    faces = np.ones((6, 4, 4, 2))
    assert cube_maps.cube_texture(faces, *empty).shape == (0, 2)
    gradients = cube_maps.cube_texture_backward(np.zeros((0, 2)), faces, *empty)
    assert [g.shape for g in gradients] == [(6, 4, 4, 2), (0, 3), (0, 3, 2), (0,)]


def test_gradients_have_the_shapes_of_their_arguments():
    """No jacobian has a gradient, or that of a number is an array."""
    faces, directions, jacobian, bias = scene(np.random.default_rng(13))
    for filter in texturing.FILTERS:
        for change, number in (None, 0.5), (jacobian, 0.5), (None, bias), (jacobian, bias):
            got = cube_maps.cube_texture_backward(np.ones((5, 6, 3)), faces, directions, change,
                                                  number, filter)
            assert (got[2] is None) == (change is None)
            assert [np.shape(grad) for grad in got] == [
                faces.shape, directions.shape, np.shape(change), np.shape(number)]


FACES, DIRECTIONS, JACOBIAN = np.ones((6, 4, 4, 2)), np.ones((3, 5, 3)), np.ones((3, 5, 3, 2))


@pytest.mark.parametrize(("arguments", "sentence"), [
    ((np.ones((5, 4, 4, 2)), DIRECTIONS), r"faces \(6, n, n, C\) .* got \(5, 4, 4, 2\)"),
    ((np.ones((6, 4, 2, 2)), DIRECTIONS), r"faces \(6, n, n, C\)"),
    ((np.ones((6, 4, 4)), DIRECTIONS), r"faces \(6, n, n, C\)"),
    ((np.ones((6, 0, 0, 3)), DIRECTIONS), r"at least one texel"),
    ((FACES, np.ones((3, 5, 2))), r"directions \(..., 3\) .* got \(3, 5, 2\)"),
    ((FACES, np.full((3, 5, 3), np.nan)), r"give \(0, 0, 0\) where no face is seen"),
    ((FACES, DIRECTIONS, np.ones((3, 5, 2, 2))), r"a jacobian \(3, 5, 3, 2\)"),
    ((FACES, DIRECTIONS * 1e-9, JACOBIAN * [[1e55], [0], [0]]), r"times as long as its direction"),
    ((FACES, DIRECTIONS, JACOBIAN, np.ones(5)), r"a finite bias \(3, 5\)"),
    ((FACES, DIRECTIONS, None, 0.0, "cubic"), r"a filter out of nearest.* got 'cubic'"),
    ((FACES, DIRECTIONS, None, 0.0, "linear", -1), r"a max_level of 0 or more")])
def test_bad_input_gets_one_sentence(arguments, sentence):
    """An error from deep inside, or a picture of NaN."""
    with pytest.raises(ValueError, match=sentence):
        cube_maps.cube_texture(*arguments)
    with pytest.raises(ValueError, match=sentence):
        cube_maps.cube_texture_backward(np.ones((3, 5, 2)), *arguments)


def test_a_gradient_of_another_shape_gets_one_sentence():
    """Broadcasting hides it."""
    with pytest.raises(ValueError, match=r"a grad_colour with the colours' shape \(3, 5, 2\)"):
        cube_maps.cube_texture_backward(np.ones((3, 5)), FACES, DIRECTIONS)
