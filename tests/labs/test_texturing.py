"""What the exercises of lab 6 must do."""
import itertools

import numpy as np

from labkit.checks import assert_close, assert_equal, exercise

# --- one axis ----------------------------------------------------------------------------------

@exercise("6.1")
def test_between_two_centres_both_count(impl):
    """Half a texel off: a centre is taken to lie at j / w, or 1/2 is added, or subtracted before x
    is multiplied. The weights are exchanged. The second texel is j - 1. x is multiplied by size -
    1, or rounded to the nearest. j is no integer.
    """
    got = impl.linear_texels(np.array([0.4375, 0.55, 0.725, 0.15]), 4)  # at 1.25, 1.7, 2.4, 0.1
    assert_close(got, ([[1, 1, 2, 0], [2, 2, 3, 1]],
                       [[0.75, 0.3, 0.6, 0.9], [0.25, 0.7, 0.4, 0.1]]))
    assert_equal(got[0], [[1, 1, 2, 0], [2, 2, 3, 1]])


@exercise("6.1")
def test_texels_outside_have_their_own_numbers(impl):
    """Below 0 numbers are truncated towards 0 and not floored. Or they are clipped, clamped or
    wrapped to the texture: that comes later.
    """
    got = impl.linear_texels(np.array([0.05, -0.2, 0.975, 1.25, 1.0]), 4)
    # at -0.3, -1.3, 3.4, 4.5, 3.5
    assert_close(got, ([[-1, -2, 3, 4, 3], [0, -1, 4, 5, 4]],
                       [[0.3, 0.3, 0.6, 0.5, 0.5], [0.7, 0.7, 0.4, 0.5, 0.5]]))


@exercise("6.1")
def test_a_straight_line_is_reproduced(impl, rng):
    """Weights that do not add up to 1, or not at the place that was asked; for any size."""
    x, size = rng.uniform(-3, 3, (5, 7)), rng.integers(1, 40, (5, 7))
    for sizes in size, 6:
        index, weight = map(np.asarray, impl.linear_texels(x, sizes))
        assert_equal(index[1] - index[0], np.ones(x.shape, int))
        assert_close(weight.sum(0), np.ones(x.shape))
        assert_close(((index + 0.5) / sizes * weight).sum(0), x)
        assert_equal(bool((weight >= 0).all()), True)


# --- two axes ----------------------------------------------------------------------------------

PLACES = np.array([[0.25, 0.375], [0.40625, 0.65], [0.7, 0.5]])  # of 8 x 4: 1.5, 1; 2.75, 2.1; ...


def four_texels(uv, width, height, boundary):
    """index, weight, inside (4,) of one place, texel by texel."""
    x, y = uv[0] * width - 0.5, uv[1] * height - 0.5
    found = []
    for i, j in itertools.product(*(np.floor(p) + [0, 1] for p in (y, x))):
        weight = (1 - abs(y - i)) * (1 - abs(x - j))
        inside = 0 <= i < height and 0 <= j < width
        if boundary == "wrap":
            i, j = i % height, j % width
        found.append((min(max(i, 0), height - 1) * width + min(max(j, 0), width - 1),
                      weight * (inside or boundary != "zero"), inside or boundary != "zero"))
    return np.array(found).T


@exercise("6.2")
def test_the_four_texels_around_a_place(impl):
    """u is taken for the row, or texels are counted column by column: the number is width i + j.
    Or the four come as left and right columns, or the upper row first.
    """
    index, _, inside = impl.texels_at(PLACES, 8, 4, "clamp")
    assert_equal(index, np.transpose([[9, 10, 17, 18], [18, 19, 26, 27], [13, 14, 21, 22]]))
    assert_equal(inside, np.ones((4, 3), bool))


@exercise("6.2")
def test_each_weight_is_that_of_its_row_times_that_of_its_column(impl):
    """The weights of u and v are added, or their order is not that of the texels."""
    weight = np.asarray(impl.texels_at(PLACES, 8, 4, "clamp")[1])
    assert_close(weight[:, :2].T, [[0.5, 0.5, 0, 0], [0.225, 0.675, 0.025, 0.075]])
    assert_close(weight.sum(0), np.ones(3))


def check_border(impl, boundary, index, weight):
    """Left of the texture's lower corner, and right of its upper one, of 8 x 4 texels."""
    got = impl.texels_at(np.array([[0.03125, 0.0], [1.0, 0.9375]]), 8, 4, boundary)
    got_index, got_weight, inside = map(np.asarray, got)
    assert_close(got_weight.T, weight)
    assert_equal(inside.T, np.array(index) >= 0)
    assert_equal(np.where(inside, got_index, -1).T, index)


WHOLE = [[0.125, 0.375, 0.125, 0.375], [0.375, 0.375, 0.125, 0.125]]


@exercise("6.2")
def test_beyond_its_border_a_texture_repeats(impl):
    """Rows wrap by the width, or the number of the texel is wrapped, and not that on each axis."""
    check_border(impl, "wrap", [[31, 24, 7, 0], [31, 24, 7, 0]], WHOLE)


@exercise("6.2")
def test_its_last_texels_go_on(impl):
    """clamp is taken for wrap, or clamps to the size, which is one too many."""
    check_border(impl, "clamp", [[0, 0, 0, 0], [31, 31, 31, 31]], WHOLE)


@exercise("6.2")
def test_nothing_lies_beyond(impl):
    """A texel outside keeps its weight, or only the one that is outside along both axes has none,
    or those that are left share it.
    """
    check_border(impl, "zero", [[-1, -1, -1, 0], [31, -1, -1, -1]],
                 [[0, 0, 0, 0.375], [0.375, 0, 0, 0]])


def check_anywhere(impl, rng, boundary):
    """Random places, each of a texture of its own size."""
    uv, sizes = rng.uniform(-1, 2, (9, 2)), rng.integers(1, 9, (2, 9))
    index, weight, inside = map(np.asarray, impl.texels_at(uv, *sizes, boundary))
    expected = np.array([four_texels(*one, boundary) for one in zip(uv, *sizes, strict=True)])
    assert_close(weight.T, expected[:, 1])
    assert_equal(inside.T, expected[:, 2] > 0)
    assert_equal(np.where(inside, index, 0).T, np.where(inside.T, expected[:, 0], 0).astype(int))


@exercise("6.2")
def test_every_place_may_have_its_own_size(impl, rng):
    """One size for all. In a pyramid each pixel may look at another level."""
    check_anywhere(impl, rng, "wrap")


@exercise("6.2")
def test_anywhere_beyond_the_border_there_is_nothing(impl, rng):
    """Right on paper alone, or for one size: a texel outside keeps its weight."""
    check_anywhere(impl, rng, "zero")


# --- the look-up -------------------------------------------------------------------------------

TEXELS = np.array([[4.0, 1.0], [10.0, 2.0], [30.0, 5.0], [70.0, 9.0], [50.0, 7.0]])


@exercise("6.3")
def test_a_colour_is_the_weighted_sum_of_its_texels(impl):
    """The weights are left out, so it is a plain sum or mean. The sum is divided by K, or by the
    sum of the weights. A texel is left out, or only one counts, as it overwrites the one before.
    """
    index = np.array([[0, 1, 3], [2, 4, 0], [3, 1, 2], [1, 0, 4]])
    weight = np.array([[0.5, 0.2, 0.3], [1.0, 2.0, -0.5], [0.1, 0.7, 0.5], [0.3, 0.25, 0.6]])
    assert_close(impl.look_up(TEXELS, index, weight),
                 [[25.0, 3.6], [128.0, 18.5], [29.0, 4.8], [34.0, 5.05]])


@exercise("6.3")
def test_look_ups_are_sums_in_a_loop(impl, rng):
    """Wrong for other numbers of texels, channels or points; or where a row names one twice."""
    for count, n, k, channels in (7, 9, 4, 3), (1, 5, 4, 1), (30, 2, 8, 5):
        texels = rng.normal(size=(count, channels))
        index, weight = rng.integers(0, count, (n, k)), rng.normal(size=(n, k))
        expected = [sum(weight[i, j] * texels[index[i, j]] for j in range(k)) for i in range(n)]
        assert_close(impl.look_up(texels, index, weight), np.array(expected))


@exercise("6.11")
def test_each_texel_pulls_towards_itself(impl):
    """The factor of the size is left out, or divides. Width and height, u and v, or the four texels
    are exchanged: u goes along the row. The sign is flipped. The other axis' weights are left out
    or exchanged, or only one row or column counts.
    """
    grad_weight = np.array([[0.0, 1.0, 0.0, 0.0], [2.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 3.0],
                            [0.0, 0.0, -1.0, 0.0], [1.0, 2.0, 4.0, 8.0]])
    # 0.25 and 0.4 texels from a centre, the last one 0.75 and 0.1
    uv = np.array([[0.09375, 0.225]] * 4 + [[0.15625, 0.15]])
    expected = [[4.8, -1.0], [-9.6, -6.0], [9.6, 3.0], [3.2, -3.0], [10.4, 21.0]]
    assert_close(impl.bilinear_backward(grad_weight, uv, 8, 4), expected)


@exercise("6.11")
def test_the_gradients_by_uv_are_central_differences(impl, rng, gradcheck):
    """The weights are used as if a texel's border were its centre. One axis' weights are left out
    of the other's. Or arrays width and height (N,), one for each level, do not broadcast.
    """
    sizes = np.array([1, 2, 4, 8, 3, 7, 2, 2, 5]), np.array([9, 3, 1] * 3)

    def weights(*places):
        return np.array([four_texels(*one, "clamp")[1] for one in zip(*places, strict=True)])

    gradcheck(weights, impl.bilinear_backward, (rng.uniform(-1, 2, (9, 2)), *sizes),
              differentiable=[0], name="bilinear",
              decisions=lambda uv, width, height: (np.floor(uv[:, 0] * width - 0.5),
                                                   np.floor(uv[:, 1] * height - 0.5)))


# --- the footprint -------------------------------------------------------------------------

@exercise("6.4")
def test_one_point_is_the_pixel__s_centre(impl):
    """The points lie on the pixel's edge or corners, or d is measured from a corner. uv is left
    out. Or the pixels are the first axis: it is (n^2, N, 2).
    """
    uv = np.array([[0.25, 0.75], [2.0, -1.0]])
    jacobian = np.array([[[0.1, 0.2], [0.3, 0.4]], [[1.0, 2.0], [3.0, 4.0]]])
    assert_close(impl.footprint_points(uv, jacobian, 1), uv[None])


@exercise("6.4")
def test_a_footprint_on_paper(impl):
    """The Jacobian is left out or transposed. The points come column by column instead of row by
    row, or the top row first. d goes from edge to edge of the pixel or beyond, not to the centres
    of its squares, which are 1/n apart.
    """
    jacobian = np.array([[[4.0, 8.0], [2.0, 12.0]], [[0.0, 0.4], [-0.8, 0.2]]])
    expected = [[[-3.0, -3.5], [9.9, 20.15]], [[-1.0, -2.5], [9.9, 19.75]],
                [[1.0, 2.5], [10.1, 20.25]], [[3.0, 3.5], [10.1, 19.85]]]
    uv = np.array([[0.0, 0.0], [10.0, 20.0]])
    assert_close(impl.footprint_points(uv, jacobian, 2), expected)


@exercise("6.4")
def test_the_points_fill_the_footprint_evenly(impl, rng):
    """Another spacing than 1/n of a pixel, or points of another pixel's footprint."""
    uv, jacobian, n = rng.normal(size=(3, 2)), rng.normal(size=(3, 2, 2)), 5
    expected = [[uv[p] + jacobian[p] @ [(j + 0.5) / n - 0.5, (i + 0.5) / n - 0.5] for p in range(3)]
                for i in range(n) for j in range(n)]
    assert_close(impl.footprint_points(uv, jacobian, n), np.array(expected))
