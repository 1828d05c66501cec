"""What the exercises of lab 6 must do, second part: the pyramid and the level."""
import numpy as np

from labkit.checks import assert_close, assert_equal, exercise


def grey(rows):
    """Numbers (h, w) as an image of one channel."""
    return np.array(rows, float)[..., None]


def mean_of_blocks(image):
    """Eq. (5), from the four texels of each block, or two."""
    rows, columns = np.minimum(image.shape[:2], 2)
    texels = [image[i::rows, j::columns] for i, j in np.ndindex(rows, columns)]
    return np.mean(texels, axis=0)


def levels_of(image):
    """All levels of a picture whose sides are powers of two."""
    levels = [image]
    while max(levels[-1].shape[:2]) > 1:
        levels.append(mean_of_blocks(levels[-1]))
    return levels


def greatest_stretch(jacobian, width, height):
    """The greatest singular value (N,) of J in texels, by LAPACK."""
    return np.linalg.svd(jacobian * np.array([[width], [height]]), compute_uv=False)[:, 0]


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


# --- the pyramid -------------------------------------------------------------------------------

@exercise("6.5")
def test_four_texels_become_their_mean(impl):
    """The sum, or half of it: it is divided by 4. Every second texel is kept, also along one axis,
    or the largest. They are no neighbours: a side is split into (2, h / 2), not (h / 2, 2). h and w
    are exchanged. Gamma (linear light).
    """
    image = grey([[1, 3, 0, 8, 20, 4], [5, 7, 2, 2, 6, 10], [9, 12, 30, 2, 40, 3],
                  [4, 3, 11, 13, 1, 4]])
    assert_close(impl.halve(image), grey([[4, 3, 10], [7, 14, 12]]))


@exercise("6.5")
def test_a_side_of_one_stays_one(impl):
    """A picture of one row or of one column has no level above it, or loses half of its light: a
    side of 1 is filled up with zeros, or the sum of two texels is divided by 4.
    """
    row = np.array([[[1.0, 0.5], [3.0, 1.5], [5.0, 20.0], [9.0, 40.0]]])
    half = np.array([[[2.0, 1.0], [7.0, 30.0]]])
    assert_close(impl.halve(row), half)
    assert_close(impl.halve(row.swapaxes(0, 1)), half.swapaxes(0, 1))


@exercise("6.5")
def test_halves_are_means_in_a_loop(impl, rng):
    """The channels are mixed, or a picture must be square."""
    for shape in (4, 6, 3), (6, 2, 1):
        image = rng.normal(size=shape)
        assert_close(impl.halve(image), mean_of_blocks(image))


def sides(levels):
    return [np.shape(level)[:2] for level in levels]


@exercise("6.6")
def test_it_goes_on_to_a_single_texel(impl):
    """The texture itself, or the last level of one texel, is left out. Or it is halved once."""
    image = grey([[1, 3, 0, 8], [5, 7, 2, 2], [9, 12, 30, 2], [4, 3, 11, 13]])
    assert_close(tuple(impl.pyramid(image)), (image, grey([[4, 3], [7, 14]]), grey([[7]])))


@exercise("6.6")
def test_it_ends_at_the_level_that_is_asked(impl):
    """max_level is taken for the number of levels, or is not looked at."""
    image = np.zeros((8, 8, 2))
    assert_equal(sides(impl.pyramid(image, 2)), [(8, 8), (4, 4), (2, 2)])
    assert_equal(sides(impl.pyramid(image, 0)), [(8, 8)])
    assert_equal(sides(impl.pyramid(image, 9)), [(8, 8), (4, 4), (2, 2), (1, 1)])


@exercise("6.6")
def test_it_ends_where_a_side_is_odd(impl):
    """Half a texel is cut off, or an odd side is not looked at after the first level."""
    assert_equal(sides(impl.pyramid(np.zeros((4, 12, 1)))), [(4, 12), (2, 6), (1, 3)])
    assert_equal(sides(impl.pyramid(np.zeros((5, 8, 1)))), [(5, 8)])


@exercise("6.6")
def test_a_texture_that_is_not_square_ends_in_a_texel_too(impl):
    """It ends where one side is 1: a side of 1 is odd, but stays."""
    assert_equal(sides(impl.pyramid(np.zeros((2, 8, 1)))), [(2, 8), (1, 4), (1, 2), (1, 1)])


@exercise("6.6")
def test_all_levels_are_means(impl, rng):
    """Levels are made of the texture's corner, or each of the texture itself, or are all alike."""
    image = rng.normal(size=(8, 16, 3))
    assert_close(tuple(impl.pyramid(image)), tuple(levels_of(image)))


@exercise("6.10")
def test_a_level_comes_down_in_sixteenths(impl):
    """What comes down is not divided by 4 at each level, or twice, or levels above level 1 hand
    nothing down. A level's own gradient is left out, as that of level 0 itself.
    """
    levels = (np.arange(1.0, 33.0).reshape(4, 8, 1), grey([[4, 16, 28, 12], [12, 28, 24, 40]]),
              grey([[32, 64]]))
    # Level 1 gets 8 and 16 from above: 12, 24, 44, 28 and 20, 36, 40, 56.
    above = grey([[3, 3, 6, 6, 11, 11, 7, 7]] * 2 + [[5, 5, 9, 9, 10, 10, 14, 14]] * 2)
    assert_close(impl.pyramid_backward(levels), levels[0] + above)


@exercise("6.10")
def test_a_single_level_is_its_own_gradient(impl):
    """A pyramid without a second level is an exception."""
    grad = np.arange(12.0).reshape(2, 3, 2)
    assert_close(impl.pyramid_backward((grad,)), grad)


@exercise("6.10")
def test_the_gradients_of_pyramids_are_central_differences(impl, rng, gradcheck):
    """A level is skipped or counted twice."""
    gradcheck(levels_of, lambda *grads: impl.pyramid_backward(tuple(grads[:-1])),
              (rng.normal(size=(8, 8, 2)),), name="pyramid")


# --- the level ---------------------------------------------------------------------------------

@exercise("6.7")
def test_a_pixel_of_two_to_sixteen_texels(impl):
    """J is not in texels. width and height are exchanged, or scale J's columns. 1/2 or R's root is
    left out, or log is not log2. S - R for S + R, the area, or a norm of J. A level below 0 is cut
    off.
    """
    jacobian = np.array([[[2 / 32, 0.0], [0.0, 1 / 8]], [[0.0, 8 / 32], [4 / 8, 0.0]],
                         [[1 / 32, 0.0], [0.0, 4 / 8]], [[0.5 / 32, 0.0], [0.0, 0.125 / 8]],
                         [[0.0, 2 / 32], [16 / 8, 0.0]]])
    assert_close(impl.mip_level(jacobian, 32, 8), [1.0, 3.0, 2.0, -1.0, 4.0])


@exercise("6.7")
def test_a_turned_pixel_has_the_same_level(impl):
    """C is left out: the longer of d/dx and d/dy (OpenGL's rule) is taken, and the level depends
    on how the texture is turned. Or A and B are of J's rows, not of its columns.
    """
    turns = np.stack([rotation(angle) for angle in (0.0, 0.3, 0.8, 1.5, 2.0)])
    stretched = turns @ np.diag([8.0, 1.0]) @ rotation(0.7)
    assert_close(impl.mip_level(4 * turns / 16, 16, 16), np.full(5, 2.0))
    assert_close(impl.mip_level(stretched / 16, 16, 16), np.full(5, 3.0))


@exercise("6.7")
def test_levels_are_those_of_the_greatest_singular_value(impl, rng):
    """The smallest singular value, the product of both (the area), or a norm of J."""
    jacobian = rng.normal(size=(40, 2, 2))
    for width, height in (64, 64), (16, 128):
        expected = np.log2(greatest_stretch(jacobian, width, height))
        assert_close(impl.mip_level(jacobian, width, height), expected)


@exercise("6.7", fine_print=True)
def test_no_change_at_all_is_level_minus_infinity(impl):
    """J = 0 gives NaN, or a guard, such as a small number that is added, makes it a number."""
    jacobian = np.array([np.zeros((2, 2)), np.eye(2) / 4])
    assert_close(impl.mip_level(jacobian, 8, 8), [-np.inf, 1.0])


@exercise("6.8")
def test_a_level_lies_between_two(impl):
    """The level is rounded to the nearest, not down (floor). The fraction is that of the lower
    level, or the level itself. lower and upper are no integers, or the outputs are exchanged.
    """
    got = impl.blend_levels(np.array([0.25, 1.5, 2.875, 3.125, 1.75]), 9)
    assert_equal(got, ([0, 1, 2, 3, 1], [1, 2, 3, 4, 2], [0.25, 0.5, 0.875, 0.125, 0.75]))


@exercise("6.8")
def test_levels_are_clamped_to_the_pyramid(impl):
    """One end is not clamped, or upper is top + 1, or the fraction is taken before. Infinite
    levels, or a pyramid of one level, top = 0: it has level 0 alone.
    """
    for top in 3, 0:
        level = np.array([-np.inf, -7.5, -0.25, 3.5, 9.0, np.inf])
        got = impl.blend_levels(level, top)
        assert_equal(got, ([0, 0, 0, top, top, top],
                           np.array([min(1, top)] * 3 + [top] * 3), np.zeros(6)))


@exercise("6.8")
def test_the_blend_is_the_level_itself(impl, rng):
    """Right for a few levels alone, or for a pyramid of a few levels."""
    top, level = int(rng.integers(4, 20)), rng.integers(-30, 180, 60) / 8
    got = impl.blend_levels(level, top)
    lower = np.array([sum(whole <= one for whole in range(1, top + 1)) for one in level])
    assert_equal(got, (lower, np.minimum(lower + 1, top), level.clip(0, top) - lower))


# --- the taps ----------------------------------------------------------------------------------

def of_8_by_4(impl, channels=1):
    """A Mipmap of 8 x 4, 4 x 2, 2 x 1 and 1 texels: they begin at 0, 32, 40 and 42."""
    return impl.Mipmap(np.zeros((43, channels)), np.array([8, 4, 2, 1]), np.array([4, 2, 1, 1]),
                       np.array([0, 32, 40, 42]))


def how(impl, filter_mode, boundary="clamp"):
    return impl.Sampler(filter_mode, boundary, None)


TRILINEAR = "linear-mipmap-linear"
PLACE = np.array([[0.40625, 0.65]])  # at 2.75, 2.1 in level 0; 1.125, 0.8 in 1; 0.3125, 0.15 in 2


def tent(uv, size, boundary):
    """The weights (N, 4) of the 2 x 2 texels, as `texels_at` counts them, size (w, h) a number
    each, or (N,), and whether they are there.
    """
    position = uv * np.transpose(size) - 0.5
    first = np.floor(position)
    corner = first[:, None] + np.array([[0, 0], [1, 0], [0, 1], [1, 1]])
    weight = (1 - np.abs(position[:, None] - corner)).prod(2)
    inside = ((corner >= 0) & (corner < np.transpose(size).reshape(-1, 1, 2))).all(2)
    return weight * (inside if boundary == "zero" else 1)


def trilinear_weights(uv, level, width, height, boundary):
    """The weights (N, 8) of a trilinear look, of a pyramid whose last level is len(width) - 1."""
    top = len(width) - 1
    level = np.clip(level, 0, top)
    lower = np.floor(level).astype(int)
    upper = np.minimum(lower + 1, top)
    f = (level - lower)[:, None]
    return np.hstack([(1 - f) * tent(uv, (width[lower], height[lower]), boundary),
                      f * tent(uv, (width[upper], height[upper]), boundary)])


@exercise("6.9")
def test_without_a_pyramid_the_texture_alone_counts(impl):
    """The level counts though the filter does not ask for it. Or the rows are the K texels, and
    not the N pixels.
    """
    look = np.tile(PLACE, (2, 1)), np.array([1.0, 2.5]), of_8_by_4(impl)
    index, weight, _ = impl.taps(*look, how(impl, "linear"))
    assert_equal(index, [[18, 19, 26, 27]] * 2)
    assert_close(weight, [[0.225, 0.675, 0.025, 0.075]] * 2)
    index, weight, _ = impl.taps(*look, how(impl, "nearest"))
    assert_equal(index, [[19], [19]])
    assert_close(weight, [[1.0], [1.0]])


@exercise("6.9")
def test_each_level_begins_after_the_one_before(impl):
    """The level's start is left out, or its width is that of level 0."""
    index, weight, _ = impl.taps(np.tile(PLACE, (2, 1)), np.array([1.75, 2.0]), of_8_by_4(impl),
                                 how(impl, "linear-mipmap-nearest"))
    assert_equal(index, [[33, 34, 37, 38], [40, 41, 40, 41]])
    assert_close(weight, [[0.175, 0.025, 0.7, 0.1], [0.584375, 0.265625, 0.103125, 0.046875]])


@exercise("6.9")
def test_two_levels_share_a_pixel(impl):
    """Both levels count in full, or the shares are exchanged. Or the upper level comes first."""
    index, weight, _ = impl.taps(PLACE, np.array([0.25]), of_8_by_4(impl), how(impl, TRILINEAR))
    assert_equal(index, [[18, 19, 26, 27, 33, 34, 37, 38]])
    assert_close(weight, [[0.16875, 0.50625, 0.01875, 0.05625, 0.04375, 0.00625, 0.175, 0.025]])


@exercise("6.9")
def test_no_level_is_beyond_the_pyramid(impl):
    """A level below 0 or above the last one has a share below 0 or above 1, or is not there."""
    index, weight, _ = map(np.asarray, impl.taps(np.tile(PLACE, (3, 1)),
                                                 np.array([-np.inf, -0.5, 7.25]), of_8_by_4(impl),
                                                 how(impl, TRILINEAR)))
    assert_equal((weight * (index < 32)).sum(1), [1.0, 1.0, 0.0])
    assert_close((weight * (index == 42)).sum(1), [0.0, 0.0, 1.0])


@exercise("6.9")
def test_a_texel_beyond_the_border_is_not_inside(impl):
    """inside is all True, or that of one level alone. Its weight stays."""
    _, weight, inside = impl.taps(np.array([[0.0, 0.375]]), np.array([0.5]), of_8_by_4(impl),
                                  how(impl, TRILINEAR, "zero"))
    assert_equal(inside, [[False, True] * 4])
    assert_close(weight, [[0, 0.25, 0, 0, 0, 0.1875, 0, 0.0625]])


@exercise("6.9")
def test_taps_are_tents_in_every_level(impl, rng):
    """Right on paper alone: another level's size, at some pixels."""
    uv, level = rng.uniform(-1, 2, (12, 2)), rng.uniform(-1, 4, 12)
    mipmap = of_8_by_4(impl)
    for boundary in "wrap", "zero":
        _, weight, _ = impl.taps(uv, level, mipmap, how(impl, TRILINEAR, boundary))
        assert_close(weight, trilinear_weights(uv, level, mipmap.width, mipmap.height, boundary),
                     boundary)


def taps_backward(impl, grad_weight, filter_mode, level=0.25, inside=True):
    """The gradients at PLACE, for a weight's gradient of 8 texels, or 4, or 1."""
    grad_weight = np.array([grad_weight], float)
    return impl.taps_backward(grad_weight, np.full(grad_weight.shape, inside), PLACE,
                              np.array([level]), of_8_by_4(impl), how(impl, filter_mode))


@exercise("6.12")
def test_one_level_pulls_along_u_and_v(impl):
    """The level's own size is left out, or it is that of level 0."""
    assert_close(taps_backward(impl, [1, 0, 0, 4], "linear")[0], [[-4.0, 11.0]])
    got = taps_backward(impl, [0, 5, 0, -10], "linear-mipmap-nearest", 1.75)
    assert_close(got, ([[-28.0, -3.75]], [0.0]))


@exercise("6.12")
def test_each_level_pulls_by_its_share(impl):
    """The share is left out, or both levels have the same size, or only one of them counts."""
    got, _ = taps_backward(impl, [16, 0, 0, 0, 0, 0, 0, 0], TRILINEAR)
    assert_close(got, [[-86.4, -12.0]])
    got, _ = taps_backward(impl, [16, 0, 0, 0, 0, 16, 0, 0], TRILINEAR)
    assert_close(got, [[-83.2, -13.0]])


@exercise("6.12")
def test_a_level_pulls_towards_what_it_sees(impl):
    """The sign is that of the lower level's share, or the texels' weights are left out."""
    _, got = taps_backward(impl, [20, 0, 0, 0, 0, 0, 0, 0], TRILINEAR)
    assert_close(got, [-4.5])
    _, got = taps_backward(impl, [0, 40, 0, 0, 0, 0, 10, 0], TRILINEAR)
    assert_close(got, [-20.0])


@exercise("6.12")
def test_a_clamped_level_does_not_change(impl):
    """A level beyond an end of the pyramid has the gradient of that end."""
    for level, expected in (-0.5, 0.0), (3.25, 0.0), (0.25, -4.9):
        _, got = taps_backward(impl, [20, 0, 0, 7, 0, 5, 0, 0], TRILINEAR, level)
        assert_close(got, [expected])


@exercise("6.12")
def test_nearest_and_the_background_do_not_pull(impl):
    """A texel that is not there pulls as if its weight were not 0 for good. Or one texel, which has
    the weight 1 anywhere, pulls.
    """
    assert_close(taps_backward(impl, [8.0], "nearest"), (np.zeros((1, 2)), [0.0]))
    got = taps_backward(impl, [3, 1, 4, 1, 5, 9, 2, 6], TRILINEAR, inside=False)
    assert_close(got, (np.zeros((1, 2)), [0.0]))
    assert_close(taps_backward(impl, [1, 0, 0, 4], "linear"), ([[-4.0, 11.0]], [0.0]))


@exercise("6.12")
def test_the_gradients_of_taps_are_central_differences(impl, rng, gradcheck):
    """Wrong at another place, or in another level."""
    mipmap, uv, level = of_8_by_4(impl), rng.uniform(-1, 2, (12, 2)), rng.uniform(-0.9, 2.9, 12)
    gradcheck(lambda uv, level: trilinear_weights(uv, level, mipmap.width, mipmap.height, "wrap"),
              lambda grad, uv, level: impl.taps_backward(grad, np.ones((12, 8), bool), uv, level,
                                                         mipmap, how(impl, TRILINEAR, "wrap")),
              (uv, level), decisions=lambda uv, level: (
                  np.floor(np.clip(level, 0, 3)), np.floor(uv[..., None] * [8, 4, 2, 1] - 0.5)),
              name="taps")
