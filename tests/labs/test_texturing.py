"""What the exercises of lab 6 must do."""
import warnings

import numpy as np

from course.checks import assert_close, assert_equal, exercise
from course.given.gradcheck import gradcheck


def grey(rows):
    """Numbers (h, w) as an image of one channel."""
    return np.array(rows, float)[..., None]


def mean_of_blocks(image):
    """Eq. (5), texel by texel."""
    h, w, channels = image.shape
    rows, columns = min(h, 2), min(w, 2)
    half = np.zeros((h // rows, w // columns, channels))
    for i in range(h):
        for j in range(w):
            half[i // rows, j // columns] += image[i, j] / (rows * columns)
    return half


def levels_of(image):
    """All levels of a picture whose sides are powers of two."""
    levels = [image]
    while max(levels[-1].shape[:2]) > 1:
        levels.append(mean_of_blocks(levels[-1]))
    return levels


def weights_2d(uv, width, height):
    """Eqs. (2) and (3): the weights (N, 4) of the 2 x 2 texels around each point."""
    x, y = uv[:, 0] * width - 0.5, uv[:, 1] * height - 0.5
    a, b = x - np.floor(x), y - np.floor(y)
    return np.stack([(1 - b) * (1 - a), (1 - b) * a, b * (1 - a), b * a], -1)


def greatest_stretch(jacobian, width, height):
    """The greatest singular value (N,) of J in texels, by LAPACK."""
    return np.linalg.svd(jacobian * np.array([[width], [height]]), compute_uv=False)[:, 0]


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


# --- one axis ----------------------------------------------------------------------------------

@exercise("6.1")
def test_four_texels_lie_between_0_and_1(impl):
    """The index is rounded, or truncated toward 0: below 0 it is one too high."""
    x = np.array([0.0, 0.1, 0.3, 0.6, 0.99, -0.01, -0.3, 1.1])
    assert_equal(impl.nearest_texel(x, 4), np.array([0, 0, 1, 2, 3, -1, -2, 4]))


@exercise("6.1")
def test_a_border_belongs_to_the_upper_texel(impl):
    """Half a texel off, or the border goes to the lower texel; or 1.0 is pulled inside."""
    assert_equal(impl.nearest_texel(np.array([-0.25, 0.0, 0.25, 0.5, 0.75, 1.0]), 4),
                 np.arange(-1, 5))


@exercise("6.1")
def test_every_point_may_have_its_own_size(impl):
    """A size for all: the levels of a pyramid have different ones. Or a texture of many turns."""
    x, size = np.array([[0.7, 0.7, 0.7], [-1.3, 9.3, 1000.6]]), np.array([[1, 2, 8], [3, 5, 16]])
    assert_equal(impl.nearest_texel(x, size), np.array([[0, 1, 5], [-4, 46, 16009]]))


@exercise("6.2")
def test_a_texels_centre_is_that_texel_alone(impl):
    """Half a texel off: texel j is read in full at j / w, which is its border."""
    index, weight = impl.linear_texels((np.array([0, 1, 5, 7]) + 0.5) / 8, 8)
    assert_equal(index, np.array([[0, 1, 5, 7], [1, 2, 6, 8]]))
    assert_close(weight, np.array([[1.0, 1, 1, 1], [0, 0, 0, 0]]))


@exercise("6.2")
def test_between_two_centres_both_count(impl):
    """The two weights are swapped; or below 0 numbers are truncated and not floored."""
    index, weight = impl.linear_texels(np.array([0.5, 0.4375, 0.05, -0.2, 1.0]), 4)
    assert_equal(index, np.array([[1, 1, -1, -2, 3], [2, 2, 0, -1, 4]]))
    assert_close(weight, np.array([[0.5, 0.75, 0.3, 0.3, 0.5], [0.5, 0.25, 0.7, 0.7, 0.5]]))


@exercise("6.2")
def test_a_straight_line_is_reproduced(impl, rng):
    """Weights that do not add up to 1, or not at the place that was asked; for any size."""
    x, size = rng.uniform(-3, 3, (5, 7)), rng.integers(1, 40, (5, 7))
    for sizes in size, 6:
        index, weight = map(np.asarray, impl.linear_texels(x, sizes))
        assert_equal(index[1] - index[0], np.ones(x.shape, int))
        assert_close(weight.sum(0), np.ones(x.shape))
        assert_close(((index + 0.5) / sizes * weight).sum(0), x)
        assert_equal(bool((weight >= 0).all()), True)


@exercise("6.3")
def test_the_last_texel_goes_on(impl):
    """The texture repeats or is mirrored; or the last number is size."""
    index, inside = impl.clamp(np.array([-9, -1, 0, 2, 4, 5, 6, 90]), 5)
    assert_equal(index, np.array([0, 0, 0, 2, 4, 4, 4, 4]))
    assert_equal(inside, np.ones(8, bool))


@exercise("6.3")
def test_clamped_numbers_have_any_shape_and_size(impl):
    """One size for all points, or the shape is lost."""
    index, inside = impl.clamp(np.array([[3, -2, 7], [0, 1, 2]]), np.array([1, 2, 4]))
    assert_equal(index, np.array([[0, 0, 3], [0, 1, 2]]))
    assert_equal(inside, np.ones((2, 3), bool))


@exercise("6.4")
def test_beyond_the_texture_is_nothing(impl):
    """The border texel counts as outside, or size as inside; or a number outside comes back."""
    index, inside = impl.zero(np.array([-9, -1, 0, 2, 4, 5, 6, 90]), 5)
    assert_equal(index, np.array([0, 0, 0, 2, 4, 0, 0, 0]))
    assert_equal(inside, np.array([False, False, True, True, True, False, False, False]))


@exercise("6.4")
def test_numbers_outside_have_any_shape_and_size(impl):
    """One size for all points, or the shape is lost."""
    index, inside = impl.zero(np.array([[0, -2, 3], [1, 1, 4]]), np.array([1, 2, 4]))
    assert_equal(index, np.array([[0, 0, 3], [0, 1, 0]]))
    assert_equal(inside, np.array([[True, False, True], [False, True, False]]))


# --- the look-up -------------------------------------------------------------------------------

TEXELS = np.array([[0.0, 1.0], [10.0, 2.0], [30.0, 3.0], [70.0, 4.0]])


@exercise("6.5")
def test_a_colour_is_the_weighted_sum_of_its_texels(impl):
    """The weights are left out, or divided by their sum; or the channels are mixed."""
    index = np.array([[0, 1, 3], [2, 2, 0], [3, 1, 2]])
    weight = np.array([[0.5, 0.25, 0.25], [1.0, 2.0, -1.0], [0.0, 0.0, 0.5]])
    assert_close(impl.look_up(TEXELS, index, weight),
                 np.array([[20.0, 2.0], [90.0, 8.0], [15.0, 1.5]]))


@exercise("6.5")
def test_one_texel_each_is_nearest_sampling(impl):
    """K = 1 is an exception, or rows come in the order of the texels."""
    index = np.array([[3], [0], [2], [2], [1]])
    assert_close(impl.look_up(TEXELS, index, np.ones((5, 1))), TEXELS[index[:, 0]])


@exercise("6.5")
def test_look_ups_are_sums_in_a_loop(impl, rng):
    """Wrong for other numbers of texels, channels or points; or where a row names one twice."""
    for count, n, k, channels in (7, 9, 4, 3), (1, 5, 4, 1), (30, 2, 8, 5):
        texels = rng.normal(size=(count, channels))
        index, weight = rng.integers(0, count, (n, k)), rng.normal(size=(n, k))
        expected = [sum(weight[i, j] * texels[index[i, j]] for j in range(k)) for i in range(n)]
        assert_close(impl.look_up(texels, index, weight), np.array(expected))


@exercise("6.6")
def test_what_was_gathered_is_scattered(impl):
    """The weights are left out, or of two points at one texel the last one wins."""
    index = np.array([[0, 1], [1, 3]])
    weight = np.array([[0.75, 0.25], [0.5, 0.5]])
    grad_texels, grad_weight = impl.look_up_backward(np.array([[1.0, 0.0], [2.0, 4.0]]), TEXELS,
                                                     index, weight)
    assert_close(grad_texels, np.array([[0.75, 0.0], [1.25, 2.0], [0.0, 0.0], [1.0, 2.0]]))
    assert_close(grad_weight, np.array([[0.0, 10.0], [28.0, 156.0]]))


@exercise("6.6")
def test_a_texel_that_a_row_names_twice_gets_both(impl):
    """Equal texels in one row: an assignment keeps one of them."""
    grad_texels, grad_weight = impl.look_up_backward(
        np.array([[1.0, 10.0]]), TEXELS, np.array([[2, 2, 1, 2]]),
        np.array([[0.125, 0.5, 0.25, 0.125]]))
    assert_close(grad_texels, np.array([[0.0, 0.0], [0.25, 2.5], [0.75, 7.5], [0.0, 0.0]]))
    assert_close(grad_weight, np.array([[60.0, 60.0, 30.0, 60.0]]))


@exercise("6.6")
def test_the_gradients_of_look_ups_are_central_differences(impl, rng):
    """The sum over the channels or over the points is left out, or goes over the wrong axis."""
    for count, n, k, channels in (6, 7, 4, 3), (3, 5, 1, 2), (2, 3, 8, 1):
        index = rng.integers(0, count, (n, k))
        gradcheck(lambda texels, weight, at=index: np.einsum("nk,nkc->nc", weight, texels[at]),
                  lambda grad, texels, weight, at=index:
                  impl.look_up_backward(grad, texels, at, weight),
                  (rng.normal(size=(count, channels)), rng.normal(size=(n, k))), name="look_up")


@exercise("6.7")
def test_each_texel_pulls_towards_itself(impl):
    """The order of the four texels, u and v, or width and height are swapped; or a sign."""
    uv = np.array([[0.125, 0.1875]])  # x = 0.5, a = 0.5; y = 0.25, b = 0.25
    expected = {0: [-6.0, -2.0], 1: [6.0, -2.0], 2: [-2.0, 2.0], 3: [2.0, 2.0]}
    for k, grad_uv in expected.items():
        grad_weight = np.zeros((1, 4))
        grad_weight[0, k] = 1
        assert_close(impl.bilinear_backward(grad_weight, uv, 8, 4), np.array([grad_uv]))


@exercise("6.7")
def test_on_a_centre_the_upper_side_counts(impl):
    """The gradient is 0 on a texel's centre, where the weights have a corner."""
    grad_weight = np.array([[1.0, 2.0, 30.0, 400.0]])
    assert_close(impl.bilinear_backward(grad_weight, np.array([[0.375, 0.25]]), 4, 2),
                 np.array([[4.0, 58.0]]))


@exercise("6.7")
def test_the_gradients_by_uv_are_central_differences(impl, rng):
    """The factor of the size is forgotten, or one axis' weights are left out of the other's."""
    uv = rng.uniform(-1, 2, (9, 2))
    for width, height in (6, 5), (np.array([1, 2, 4, 8, 3, 7, 2, 2, 5]), np.array([9, 3, 1] * 3)):
        gradcheck(lambda uv, w=width, h=height: weights_2d(uv, w, h),
                  lambda grad, uv, w=width, h=height: impl.bilinear_backward(grad, uv, w, h),
                  (uv,), name="bilinear", decisions=lambda uv, w=width, h=height:
                  (np.floor(uv[:, 0] * w - 0.5), np.floor(uv[:, 1] * h - 0.5)))


# --- the footprint and the pyramid -------------------------------------------------------------

@exercise("6.8")
def test_one_point_is_the_pixels_centre(impl):
    """The points lie on the pixel's corners, or are measured from one."""
    uv = np.array([[0.25, 0.75], [2.0, -1.0]])
    jacobian = np.array([[[0.1, 0.2], [0.3, 0.4]], [[1.0, 2.0], [3.0, 4.0]]])
    assert_close(impl.footprint_points(uv, jacobian, 1), uv[None])


@exercise("6.8")
def test_a_footprint_on_paper(impl):
    """The order of the points, or the Jacobian is transposed."""
    jacobian = np.array([[[4.0, 8.0], [0.0, 12.0]]])
    expected = np.array([[-3.0, -3.0], [-1.0, -3.0], [1.0, 3.0], [3.0, 3.0]])
    assert_close(impl.footprint_points(np.zeros((1, 2)), jacobian, 2)[:, 0], expected)


@exercise("6.8")
def test_the_points_fill_the_footprint_evenly(impl, rng):
    """Another spacing than 1/n of a pixel, or points of another pixel's footprint."""
    uv, jacobian, n = rng.normal(size=(3, 2)), rng.normal(size=(3, 2, 2)), 5
    expected = [[uv[p] + jacobian[p] @ [(j + 0.5) / n - 0.5, (i + 0.5) / n - 0.5] for p in range(3)]
                for i in range(n) for j in range(n)]
    assert_close(impl.footprint_points(uv, jacobian, n), np.array(expected))


@exercise("6.9")
def test_four_texels_become_their_mean(impl):
    """The sum instead of the mean, or every second texel is kept."""
    image = grey([[1.0, 3.0, 0.0, 8.0], [5.0, 7.0, 2.0, 2.0]])
    assert_close(impl.halve(image), grey([[4.0, 3.0]]))


@exercise("6.9")
def test_a_side_of_one_stays_one(impl):
    """A picture of one row or of one column has no level above it, or loses half of its light."""
    assert_close(impl.halve(grey([[1.0, 3.0, 5.0, 9.0]])), grey([[2.0, 7.0]]))
    assert_close(impl.halve(grey([[1.0], [3.0], [5.0], [9.0]])), grey([[2.0], [7.0]]))


@exercise("6.9")
def test_halves_are_means_in_a_loop(impl, rng):
    """The channels are mixed, or a picture must be square."""
    for shape in (4, 6, 3), (6, 2, 1), (1, 8, 2), (10, 1, 4):
        image = rng.normal(size=shape)
        assert_close(impl.halve(image), mean_of_blocks(image))


@exercise("6.10")
def test_a_mean_pulls_at_four_texels_alike(impl):
    """The factor 1/4 is forgotten, or three texels of four get nothing."""
    got = impl.halve_backward(grey([[4.0, 8.0]]), np.full((2, 4, 1), 9.0))
    assert_close(got, grey([[1.0, 1.0, 2.0, 2.0], [1.0, 1.0, 2.0, 2.0]]))


@exercise("6.10")
def test_with_one_row_it_pulls_at_two(impl):
    """The factor is 1/4 also where a mean is of two texels."""
    got = impl.halve_backward(grey([[4.0, 8.0]]), np.zeros((1, 4, 1)))
    assert_close(got, grey([[2.0, 2.0, 4.0, 4.0]]))
    got = impl.halve_backward(grey([[4.0], [8.0]]), np.zeros((4, 1, 1)))
    assert_close(got, grey([[2.0], [2.0], [4.0], [4.0]]))


@exercise("6.10")
def test_the_gradients_of_halves_are_central_differences(impl, rng):
    """Rows and columns are swapped, or the channels are mixed."""
    for shape in (4, 6, 3), (1, 4, 2), (6, 1, 1):
        gradcheck(mean_of_blocks, impl.halve_backward, (rng.normal(size=shape),), name="halve")


@exercise("6.11")
def test_a_level_comes_down_in_sixteenths(impl):
    """What comes from above is not handed on, or a level's own gradient is forgotten."""
    levels = tuple(np.zeros(shape) for shape in ((4, 4, 1), (2, 2, 1), (1, 1, 1)))
    levels[2][0, 0], levels[1][0, 1], levels[0][3, 0] = 16.0, 8.0, 5.0
    expected = grey([[1, 1, 3, 3], [1, 1, 3, 3], [1, 1, 1, 1], [6, 1, 1, 1]])
    assert_close(impl.pyramid_backward(levels), expected)


@exercise("6.11")
def test_a_single_level_is_its_own_gradient(impl):
    """A pyramid without a second level is an exception."""
    grad = np.arange(12.0).reshape(2, 3, 2)
    assert_close(impl.pyramid_backward((grad,)), grad)


@exercise("6.11")
def test_the_gradients_of_pyramids_are_central_differences(impl, rng):
    """A level is skipped or counted twice; or the picture must be square."""
    for shape in (4, 8, 2), (8, 2, 1):
        gradcheck(levels_of, lambda *grads: impl.pyramid_backward(tuple(grads[:-1])),
                  (rng.normal(size=shape),), name="pyramid")


# --- the level ---------------------------------------------------------------------------------

@exercise("6.12")
def test_a_pixel_of_one_two_and_four_texels(impl):
    """J is not in texels: every level is negative. Or width and height are swapped."""
    jacobian = np.array([[[1 / 32, 0.0], [0.0, 1 / 8]], [[2 / 32, 0.0], [0.0, 1 / 8]],
                         [[0.0, 2 / 32], [4 / 8, 0.0]], [[0.25 / 32, 0.0], [0.0, 0.125 / 8]]])
    assert_close(impl.mip_level(jacobian, 32, 8), np.array([0.0, 1.0, 2.0, -2.0]))


@exercise("6.12")
def test_a_turned_pixel_has_the_same_level(impl):
    """C is left out: the level depends on how the texture is turned; or R has no root."""
    turns = np.stack([rotation(angle) for angle in (0.0, 0.3, 0.8, 1.5, 2.0)])
    stretched = turns @ np.diag([8.0, 1.0]) @ rotation(0.7)
    assert_close(impl.mip_level(stretched / 16, 16, 16), np.full(5, 3.0))
    assert_close(impl.mip_level(4 * turns / 16, 16, 16), np.full(5, 2.0))


@exercise("6.12")
def test_levels_are_those_of_the_greatest_singular_value(impl, rng):
    """The smallest singular value, their product, or a norm of J."""
    jacobian = rng.normal(size=(40, 2, 2))
    for width, height in (64, 64), (16, 128):
        expected = np.log2(greatest_stretch(jacobian, width, height))
        assert_close(impl.mip_level(jacobian, width, height), expected)


@exercise("6.12")
def test_no_change_at_all_is_level_minus_infinity(impl):
    """A warning, NaN, or a guard that makes it some number: it must clamp to level 0."""
    jacobian = np.array([np.zeros((2, 2)), np.eye(2) / 4])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert_close(impl.mip_level(jacobian, 8, 8), np.array([-np.inf, 1.0]))


@exercise("6.13")
def test_the_longer_axis_alone_moves_the_level(impl):
    """A factor 2 or ln 2, or the texture's size once more; or the shorter axis pulls, too."""
    jacobian = np.array([[[0.5, 0.0], [0.0, 0.25]], [[0.125, 0.0], [0.0, 0.5]]])
    got = impl.mip_level_backward(np.log(2.0) * np.array([1.0, -3.0]), jacobian, 16, 8)
    assert_close(got, np.array([[[2.0, 0.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, -6.0]]]))


@exercise("6.13")
def test_a_square_footprint_pulls_at_both_axes(impl):
    """0 / 0 where R is 0: its derivatives count as 0, and those of S are left."""
    jacobian = np.array([[[0.5, 0.0], [0.0, 1.0]], [[0.0, -0.25], [0.5, 0.0]]])
    got = impl.mip_level_backward(np.log(2.0) * np.ones(2), jacobian, 8, 4)
    assert_close(got, np.array([[[1.0, 0.0], [0.0, 0.5]], [[0.0, -2.0], [1.0, 0.0]]]))


@exercise("6.13")
def test_a_tiny_footprint_is_not_yet_a_square(impl):
    """A small number is added to R in place of the case R = 0."""
    jacobian = 1e-9 * np.array([[[0.5, 0.0], [0.0, 0.25]]])
    got = impl.mip_level_backward(np.log(2.0) * np.ones(1), jacobian, 16, 16)
    assert_close(got, np.array([[[2e9, 0.0], [0.0, 0.0]]]), atol=1e-3)


@exercise("6.13")
def test_no_change_at_all_has_no_gradient(impl):
    """NaN, infinity or a warning where J is 0."""
    jacobian = np.array([np.zeros((2, 2)), [[0.5, 0.0], [0.0, 0.25]]])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        got = impl.mip_level_backward(np.log(2.0) * np.array([7.0, 1.0]), jacobian, 16, 16)
    assert_close(got, np.array([[[0.0, 0.0], [0.0, 0.0]], [[2.0, 0.0], [0.0, 0.0]]]))


@exercise("6.13")
def test_the_gradients_of_levels_are_central_differences(impl, rng):
    """One of the four derivatives is another's, or C pulls at one of its factors only."""
    flat = np.array([[[1.0, 0.5], [0.0, 0.0]], [[0.25, 0.0], [0.75, 0.0]]])  # a singular value of 0
    for width, height in (64, 16), (3, 8):
        jacobian = np.concatenate([rng.normal(size=(6, 2, 2)) / width, flat / width])
        gradcheck(lambda j, w=width, h=height: np.log2(greatest_stretch(j, w, h)),
                  lambda grad, j, w=width, h=height: impl.mip_level_backward(grad, j, w, h),
                  (jacobian,), name="mip_level")


@exercise("6.14")
def test_a_level_lies_between_two(impl):
    """The level is rounded, or the fraction is that of the lower level."""
    lower, upper, fraction = impl.blend_levels(np.array([0.25, 1.5, 2.875]), 5)
    assert_equal(lower, np.array([0, 1, 2]))
    assert_equal(upper, np.array([1, 2, 3]))
    assert_close(fraction, np.array([0.25, 0.5, 0.875]))


@exercise("6.14")
def test_a_whole_level_is_the_lower_one_in_full(impl):
    """Above the last level there is none; or a whole level is the upper one, in full."""
    lower, upper, fraction = impl.blend_levels(np.array([0.0, 1.0, 2.0, 3.0]), 3)
    assert_equal(lower, np.array([0, 1, 2, 3]))
    assert_equal(upper, np.array([1, 2, 3, 3]))
    assert_close(fraction, np.zeros(4))


@exercise("6.14")
def test_levels_are_clamped_to_the_pyramid(impl):
    """A level beyond the ends leaves the pyramid, or extrapolates from its last two levels."""
    for top in 3, 0:
        level = np.array([-np.inf, -7.5, -0.25, 3.5, 9.0, np.inf])
        lower, upper, fraction = impl.blend_levels(level, top)
        assert_equal(lower, np.array([0, 0, 0, top, top, top]))
        assert_equal(upper, np.array([min(1, top)] * 3 + [top] * 3))
        assert_close(fraction, np.zeros(6))


@exercise("6.15")
def test_a_clamped_level_has_no_gradient(impl):
    """The clamp is forgotten: levels outside of the pyramid pull."""
    level = np.array([-np.inf, -0.5, 0.25, 1.0, 2.75, 3.5, np.inf])
    got = impl.blend_levels_backward(np.arange(1.0, 8.0), level, 3)
    assert_close(got, np.array([0.0, 0.0, 3.0, 4.0, 5.0, 0.0, 0.0]))


@exercise("6.15")
def test_both_ends_count_as_clamped(impl):
    """>= for >, or a level that is whole has no gradient; or the top is always 3."""
    level = np.array([0.0, 1.0, 2.0, 4.0, 5.0])
    assert_close(impl.blend_levels_backward(np.ones(5), level, 5), np.array([0.0, 1, 1, 1, 0]))
    assert_close(impl.blend_levels_backward(np.ones(5), level, 0), np.zeros(5))
