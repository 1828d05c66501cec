"""The reference's cube maps: whole look-ups, seams and corners, and what they say of bad input."""
import itertools

import numpy as np
import pytest
from look_up_goldens import cube_scene

from course.given.gradcheck import gradcheck
from reference import cube_maps, mipmapping, texturing

CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
EDGES = [(a, b) for a, b in itertools.combinations(CORNERS, 2) if (a != b).sum() == 1]


def numbered(size):
    """A cube whose texels are numbers, face by face and row by row."""
    return np.arange(6.0 * size**2).reshape(6, size, size, 1)


def test_each_texel_is_seen_in_its_own_direction():
    """(u, v) and the direction to it do not fit together."""
    for size in 1, 3, 8:
        directions = cube_maps.texel_directions(size)
        for filter_mode in texturing.FILTERS:
            got = cube_maps.cube_texture(numbered(size), directions, filter_mode=filter_mode)
            np.testing.assert_allclose(got, numbered(size), atol=1e-9)


def test_a_direction_too_short_to_divide_by_sees_nothing():
    """1 / m is infinite, and 0 times that is NaN, in the gradient of a fit's whole texture. Or
    pixels without a face pull at a texel.
    """
    directions = np.array([[0.0, 0, 0], [1e-320, 2e-320, 0], [3e-200, 0, 0], [1e-140, 3e-141, 0]])
    jacobian = np.ones((4, 3, 2)) * np.abs(directions).max(-1)[:, None, None]
    look = numbered(4) + 1.0, directions, jacobian
    given = {"filter_mode": "linear-mipmap-linear"}
    np.testing.assert_array_equal(cube_maps.cube_texture(*look, **given)[:, 0] > 0, [0, 0, 0, 1])
    upstream = np.array([[1e9], [1e9], [1e9], [1.0]])
    grad_faces, *grads = cube_maps.cube_texture_backward(upstream, *look, **given)
    assert grad_faces.sum() == pytest.approx(1)
    for grad in grads[:2]:
        assert np.isfinite(grad).all() and not grad[:3].any() and grad[3].any()


@pytest.mark.parametrize("size", [1, 2, 3, 8])
@pytest.mark.parametrize("filter_mode", ["linear", "linear-mipmap-linear"])
def test_colours_are_continuous_across_all_seams(size, filter_mode):
    """A jump at an edge or at a corner of the cube, in level 0 or above."""
    rng = np.random.default_rng(1)
    faces = rng.random((6, size, size, 2))
    on = [a + (b - a) * t for a, b in EDGES for t in (0, 1e-3, 0.03, *rng.random(9), 0.98, 1)]
    around = 1e-9 * rng.normal(size=(6, 1, 3))
    for bias in 0.0, 0.4, 1.0:
        colour = cube_maps.cube_texture(faces, np.array(on) + around, None, bias, filter_mode)
        np.testing.assert_allclose(colour, np.broadcast_to(colour[0], colour.shape), atol=1e-7)


@pytest.mark.parametrize("size", [1, 8])
@pytest.mark.parametrize("filter_mode", texturing.FILTERS)
def test_every_gradient_is_a_central_difference(filter_mode, size):
    """A gradient of another look-up than this one, also at edges and corners, in any filter."""
    rng = np.random.default_rng(5)
    faces, directions, jacobian, bias = cube_scene(rng, size)
    directions[0] = 1.3 * CORNERS[:5] + rng.uniform(-0.1, 0.1, (5, 3))
    directions[1] = np.array([a + 0.4 * (b - a) for a, b in EDGES[:5]]) * [1.0, 1.04, 0.97]
    differentiable = {"nearest": [0], "linear-mipmap-linear": [0, 1, 2, 3]}.get(filter_mode, [0, 1])
    if size == 1 and filter_mode == "linear-mipmap-linear":
        differentiable = [0, 1]                        # there is no level but one

    def decisions(faces, directions, jacobian, bias):
        rows = directions.reshape(-1, 3)
        face, uv = cube_maps.on_face(rows)
        on_face = cube_maps.face_footprint(rows, jacobian.reshape(-1, 3, 2))
        level = mipmapping.mip_level(on_face, size, size) + bias.reshape(-1)
        sides = size / 2.0 ** np.arange(size.bit_length())[:, None, None]
        return face, np.floor(np.clip(level, -1, 3.5)), np.floor(uv * sides - 0.5)

    def backward(grad, *inputs):
        gradients = cube_maps.cube_texture_backward(grad, *inputs, filter_mode)
        return tuple(gradients[k] for k in differentiable)

    gradcheck(lambda *inputs: cube_maps.cube_texture(*inputs, filter_mode), backward,
              (faces, directions, jacobian, bias), differentiable=differentiable,
              decisions=decisions, name=f"cube_texture_{filter_mode}_{size}")


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
