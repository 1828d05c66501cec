"""What the extras of lab 9 that build a tape must do."""
import types

import numpy as np
import pytest
from test_pipeline import ALONE, BACKGROUND, CLIP, COLOURS, HEIGHT, WIDTH, by_hand

from labkit.checks import assert_close, assert_picture, exercise

POINTS = np.array([[0.3, -0.2, 0.5], [0.9, 0.4, -0.7], [-0.6, 0.8, 0.1]])
MATRIX = CLIP.T @ np.linalg.pinv(np.column_stack([POINTS, np.ones(3)]).T)  # it brings them to CLIP


def step(impl, pair, *places):
    return impl.Step(pair, places)


def summed_by_hand(grad, shape):
    """Place by place: where did each number of the result come from?"""
    found = np.zeros(shape)
    for place in np.ndindex(grad.shape):
        at = place[grad.ndim - len(shape):]
        found[tuple(k * (size > 1) for k, size in zip(at, shape, strict=True))] += grad[place]
    return found


# --- summed_to ---------------------------------------------------------------------------------

@exercise("9.14")
@pytest.mark.parametrize(("copied", "shape"), [((3, 4), (4,)), ((2, 3, 4), (4,)), ((3, 4), ())])
def test_what_lacks_axes_gets_the_sum_over_them(impl, rng, copied, shape):
    """Axes are counted from the wrong end, or one is summed where there are two."""
    grad = rng.normal(size=copied)
    assert_close(impl.summed_to(grad, shape), summed_by_hand(grad, shape))


@exercise("9.14")
@pytest.mark.parametrize(("copied", "shape"), [((3, 4), (3, 1)), ((2, 3, 4), (1, 3, 1))])
def test_an_axis_of_size_1_stays_and_gets_the_sum(impl, rng, copied, shape):
    """The axis is lost; only the first such axis is summed."""
    grad = rng.normal(size=copied)
    assert_close(impl.summed_to(grad, shape), summed_by_hand(grad, shape))


@exercise("9.14")
@pytest.mark.parametrize(("copied", "shape"), [((2, 3, 4), (3, 1)), ((3, 1), (3, 1)), ((), ())])
def test_both_happen_at_once_or_neither(impl, rng, copied, shape):
    """An axis that is lacking shifts those of size 1; what was not copied is summed all the same.
    """
    grad = rng.normal(size=copied)
    assert_close(impl.summed_to(grad, shape), summed_by_hand(np.array(grad), shape))


# --- multiply_backward -------------------------------------------------------------------------

@exercise("9.15")
def test_each_factor_gets_the_other_one(impl):
    """The factors are swapped, or grad is left out."""
    assert_close(impl.multiply_backward(2.0, 3.0, 5.0), (10.0, 6.0))


@exercise("9.15")
@pytest.mark.parametrize("shapes", [((3, 4), (4,)), ((3, 1), (3, 4)), ((), (2, 3)), ((2,), (2,))])
def test_products_of_arrays_have_their_central_differences(impl, gradcheck, rng, shapes):
    """A gradient has the shape of the product, and not of its factor."""
    gradcheck(np.multiply, impl.multiply_backward, tuple(rng.normal(size=s) for s in shapes),
              name="multiply")


# --- replay ------------------------------------------------------------------------------------

@exercise("9.16")
def test_steps_are_done_in_their_order(impl):
    """Arguments are swapped, or taken from the step before alone."""
    steps = None, None, step(impl, "power", 0, 1), step(impl, "multiply", 2, 0)
    assert_close(impl.replay(steps, (2.0, 3.0, None, None)), (2.0, 3.0, 8.0, 16.0))


@exercise("9.16")
def test_other_numbers_go_the_same_way(impl):
    """A step uses what its arguments were when the tape was made."""
    steps = None, step(impl, "multiply", 0, 0), step(impl, "add", 1, 0)
    assert_close(impl.replay(steps, (5.0, 9.0, 12.0)), (5.0, 25.0, 30.0))


@exercise("9.16")
def test_a_lab_s_own_pair_is_played_like_any_other(impl, rng):
    """Only numbers are allowed for."""
    points, matrix = rng.normal(size=(3, 4)), rng.normal(size=(4, 4))
    steps = None, None, step(impl, "transform", 0, 1)
    assert_close(impl.replay(steps, (points, matrix, None))[2], points @ matrix.T)


# --- backward ----------------------------------------------------------------------------------

@exercise("9.17")
def test_a_value_that_is_used_twice_gets_both(impl):
    """y = x x: the second use replaces what came from the first."""
    assert_close(impl.backward((None, step(impl, "multiply", 0, 0)), (3.0, 9.0)), (6.0, 1.0))


@exercise("9.17")
def test_what_comes_along_several_ways_is_summed(impl):
    """u = x x, y = u u + u: u goes on before all of its own gradient has come. At 2, y' is 36."""
    steps = (None, step(impl, "multiply", 0, 0), step(impl, "multiply", 1, 1),
             step(impl, "add", 2, 1))
    for _ in range(2):  # a second time it is the same, not twice as much
        assert_close(impl.backward(steps, (2.0, 4.0, 16.0, 20.0)), (36.0, 9.0, 1.0, 1.0))


@exercise("9.17")
def test_what_the_result_is_not_made_of_gets_nothing(impl):
    """A step off the way is taken for one on it: its pair is given 0.0 for a matrix."""
    matrix = np.array([[1.0, 2.0], [3.0, 5.0]])
    steps = None, None, step(impl, "matmul", 0, 0), step(impl, "power", 1, 1)
    grads = impl.backward(steps, (matrix, 3.0, matrix @ matrix, 27.0), 5.0)
    assert_close(grads, (0.0, 135.0, 0.0, 5.0))


@exercise("9.17")
def test_a_chain_of_4000_steps_has_an_end(impl):
    """It calls itself: Python allows for about a thousand calls within each other."""
    steps = None, None, *(step(impl, "multiply", place, 1) for place in (0, *range(2, 4001)))
    values = 2.0, 1.0, *[2.0] * 4000
    grads = impl.backward(steps, values)
    assert_close((grads[0], grads[1]), (1.0, 8000.0))


@exercise("9.17")
def test_arrays_have_the_gradients_of_their_sums(impl, gradcheck, rng):
    """grad is taken for ones; the second gradient of a pair goes to the first argument."""
    steps = None, None, None, step(impl, "matmul", 0, 1), step(impl, "multiply", 3, 2)

    def backward(grad, *given):
        values = *given, given[0] @ given[1], (given[0] @ given[1]) * given[2]
        return impl.backward(steps, values, grad)[:3]

    gradcheck(lambda a, b, c: (a @ b) * c, backward,
              tuple(rng.normal(size=shape) for shape in ((2, 3), (3, 4), (4,))), name="backward")


@exercise("9.17")
def test_where_some_of_a_gradient_is_0_the_rest_goes_on(impl):
    """A value counts as unused as soon as one number of its gradient is 0."""
    steps = None, step(impl, "multiply", 0, 0)
    values = np.array([3.0, 5.0]), np.array([9.0, 25.0])
    assert_close(impl.backward(steps, values, np.array([0.0, 1.0]))[0], np.array([0.0, 10.0]))


@exercise("9.17")
def test_a_gradient_goes_to_the_argument_that_wrt_names(impl, rng):
    """The gradients are taken for those of the first arguments: here the mask comes first."""
    face_index, faces = np.zeros((1, 1), int), ALONE[0]
    clip = CLIP.copy()
    grad = rng.normal(size=(1, 1, 3))
    steps = None, None, None, step(impl, "barycentrics", 0, 1, 2)
    values = face_index, clip, faces, np.full((1, 1, 3), np.nan)
    grads = impl.backward(steps, values, grad)
    assert_close((grads[0], grads[2], np.shape(grads[1])), (0.0, 0.0, (3, 4)))


# --- rotation ----------------------------------------------------------------------------------

@exercise("9.18")
@pytest.mark.parametrize(("q", "point"), [
    ((1.0, 1.0, 0.0, 0.0), (2.0, -5.0, 3.0)), ((1.0, 0.0, 1.0, 0.0), (5.0, 3.0, -2.0)),
    ((3.0, 0.0, 0.0, 3.0), (-3.0, 2.0, 5.0)), ((0.0, 0.0, 7.0, 0.0), (-2.0, 3.0, -5.0))])
def test_quarters_and_halves_of_a_turn(impl, q, point):
    """The angle is half as large; it turns the other way; |q| matters."""
    assert_close(impl.rotation(np.array(q)) @ np.array([2.0, 3.0, 5.0]), np.array(point))


@exercise("9.18")
def test_it_leaves_its_axis_and_all_lengths(impl, rng):
    """A term is missing: no rotation comes out, but for some angles."""
    q = rng.normal(size=4)
    R = impl.rotation(q)
    assert_close((R @ q[1:], R @ R.T), (q[1:], np.eye(3)))
    assert_close(np.trace(R), 4 * q[0]**2 / (q @ q) - 1)  # 1 + 2 cos of the angle


@exercise("9.18")
def test_the_tape_has_its_gradient(impl, gradcheck, rng):
    """It is no arithmetic of Vars alone: np.array([...]), q @ q, or a number taken out of q."""
    gradcheck(impl.rotation, impl.rotation_backward, (rng.normal(size=4),), name="rotation")


# --- render ------------------------------------------------------------------------------------

def scene(impl, points, material, matrix):
    lab9 = impl.pipeline
    return (lab9.Mesh(points, *ALONE), material, lab9.View(matrix, WIDTH, HEIGHT, BACKGROUND))


def seen_by_hand(impl, points, colours, matrix):
    """Lab 9's search for what a triangle shows: picture, Buffers, what was decided."""
    given = types.SimpleNamespace(Buffers=impl.pipeline.Buffers, outlines=impl.antialiasing)
    return by_hand(given, np.column_stack([points, np.ones(3)]) @ matrix.T, colours)


@exercise("9.19")
def test_the_picture_is_that_of_a_search(impl, rng):
    """A step is left out, or given what another one returns."""
    picture, _ = impl.render_and_back(
        *scene(impl, POINTS, impl.pipeline.Colours(COLOURS), MATRIX), np.zeros((HEIGHT, WIDTH, 2)))
    assert_picture(picture, seen_by_hand(impl, POINTS, COLOURS, MATRIX)[0], atol=1e-9)


@exercise("9.19")
def test_positions_colours_and_matrix_have_their_central_differences(impl, gradcheck):
    """A value is given to a pair where the Var should be: that way back is lost."""
    def backward(grad, points, colours, matrix):
        _, grads = impl.render_and_back(
            *scene(impl, points, impl.pipeline.Colours(colours), matrix), grad)
        return grads[0], grads[1][0], grads[2]

    gradcheck(lambda *given: seen_by_hand(impl, *given)[0], backward, (POINTS, COLOURS, MATRIX),
              decisions=lambda *given: seen_by_hand(impl, *given)[2], name="render")


SLOPE = np.array([[0.5, -0.25], [1.5, 0.75]])  # how a ramp's two colours grow with u and v
UV = np.array([[0.2, 0.3], [0.7, 0.25], [0.4, 0.8]])


def ramp(impl, uv, filter_mode):
    """A texture of 8 x 8 whose colour is uv @ SLOPE, as far as no filter reaches its border."""
    v, u = (np.indices((8, 8)) + 0.5) / 8
    return impl.pipeline.Texture(uv, ALONE[0], np.stack([u, v], -1) @ SLOPE, filter_mode)


@exercise("9.19")
def test_a_ramp_on_a_texture_is_one_of_colours(impl, rng):
    """A texture is not allowed for, or is looked up where no face is seen."""
    grad = rng.normal(size=(HEIGHT, WIDTH, 2))
    picture, grads = impl.render_and_back(
        *scene(impl, POINTS, ramp(impl, UV, "linear"), MATRIX), grad)
    assert_picture(picture, seen_by_hand(impl, POINTS, UV @ SLOPE, MATRIX)[0], atol=1e-9)
    _, as_colours = impl.render_and_back(
        *scene(impl, POINTS, impl.pipeline.Colours(UV @ SLOPE), MATRIX), grad)
    assert_close((grads[0], grads[1][0], grads[2]),
                 (as_colours[0], as_colours[1][0] @ SLOPE.T, as_colours[2]))


@exercise("9.19")
def test_half_a_level_is_half_of_each(impl):
    """One pixel sees a texel of 1 among four, whose mean is 1/4: the levels are not those asked."""
    ndc = np.array([[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [-1.0, 3.0, 0.0]])
    lab9, image = impl.pipeline, np.array([[[1.0], [0.0]], [[0.0], [0.0]]])
    uv = 0.25 + 0.5**0.5 * ndc[:, :2] / 2  # a pixel is as wide as 2 ** (1 / 2) texels: level 1/2
    picture, _ = impl.render_and_back(
        lab9.Mesh(ndc, *ALONE), lab9.Texture(uv, ALONE[0], image, "linear-mipmap-linear"),
        lab9.View(np.eye(4), 1, 1, np.zeros(1)), np.zeros((1, 1, 1)))
    assert_close(picture, np.full((1, 1, 1), 0.625))


@exercise("9.19")
def test_a_footprint_that_changes_changes_the_picture(impl, gradcheck, rng):
    """The derivatives of the barycentrics are not on the tape: mip levels have no gradient."""
    texture = ramp(impl, UV, "linear-mipmap-linear")._replace(image=rng.normal(size=(8, 8, 2)))

    def forward(points):
        return impl.render_and_back(*scene(impl, points, texture, MATRIX),
                                    np.zeros((HEIGHT, WIDTH, 2)))[0]

    def backward(grad, points):
        return impl.render_and_back(*scene(impl, points, texture, MATRIX), grad)[1][0]

    gradcheck(forward, backward, (POINTS,), name="render", decisions=lambda points: seen_by_hand(
        impl, points, COLOURS, MATRIX)[2])
