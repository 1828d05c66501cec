"""What the exercises of lab 6 must do, second part: the pyramid and the level."""
import numpy as np

from labkit.checks import assert_close, assert_equal, exercise


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


def greatest_stretch(jacobian, width, height):
    """The greatest singular value (N,) of J in texels, by LAPACK."""
    return np.linalg.svd(jacobian * np.array([[width], [height]]), compute_uv=False)[:, 0]


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


# --- the pyramid -------------------------------------------------------------------------------

@exercise("6.9")
def test_four_texels_become_their_mean(impl):
    """The sum, or half of it: it is divided by 4. Every second texel is kept, also along one axis,
    or the largest. They are no neighbours: a side is split into (2, h / 2), not (h / 2, 2). h and w
    are exchanged. Gamma (linear light).
    """
    image = grey([[1, 3, 0, 8, 20, 4], [5, 7, 2, 2, 6, 10], [9, 12, 30, 2, 40, 3],
                  [4, 3, 11, 13, 1, 4]])
    assert_close(impl.halve(image), grey([[4, 3, 10], [7, 14, 12]]))


@exercise("6.9", fine_print=True)
def test_a_side_of_one_stays_one(impl):
    """A picture of one row or of one column has no level above it, or loses half of its light: a
    side of 1 is filled up with zeros, or the sum of two texels is divided by 4.
    """
    row = np.array([[[1.0, 0.5], [3.0, 1.5], [5.0, 20.0], [9.0, 40.0]]])
    half = np.array([[[2.0, 1.0], [7.0, 30.0]]])
    assert_close(impl.halve(row), half)
    assert_close(impl.halve(row.swapaxes(0, 1)), half.swapaxes(0, 1))


@exercise("6.9")
def test_halves_are_means_in_a_loop(impl, rng):
    """The channels are mixed, or a picture must be square."""
    for shape in (4, 6, 3), (6, 2, 1):
        image = rng.normal(size=shape)
        assert_close(impl.halve(image), mean_of_blocks(image))


@exercise("6.10")
def test_a_mean_pulls_at_four_texels_alike(impl):
    """The factor 1/4 is forgotten, or is 1/2, or only one texel of four gets it. Or the whole
    picture is repeated (tile), instead of each texel.
    """
    got = impl.halve_backward(grey([[4, 8, 20], [12, 28, 16]]), np.full((4, 6, 1), 9.0))
    assert_close(got, grey([[1, 1, 2, 2, 5, 5], [1, 1, 2, 2, 5, 5], [3, 3, 7, 7, 4, 4],
                            [3, 3, 7, 7, 4, 4]]))


@exercise("6.10", fine_print=True)
def test_with_one_row_it_pulls_at_two(impl):
    """With a side of 1 it is still divided by 4, also where a mean is of two texels."""
    got = impl.halve_backward(grey([[4.0, 8.0]]), np.zeros((1, 4, 1)))
    assert_close(got, grey([[2.0, 2.0, 4.0, 4.0]]))
    got = impl.halve_backward(grey([[4.0], [8.0]]), np.zeros((4, 1, 1)))
    assert_close(got, grey([[2.0], [2.0], [4.0], [4.0]]))


@exercise("6.10")
def test_the_gradients_of_halves_are_central_differences(impl, rng, gradcheck):
    """Rows and columns are swapped, or the channels are mixed."""
    for shape in (4, 6, 3), (2, 4, 2):
        gradcheck(mean_of_blocks, impl.halve_backward, (rng.normal(size=shape),), name="halve")


@exercise("6.11")
def test_a_level_comes_down_in_sixteenths(impl):
    """What comes down is not divided by 4 at each level, or twice, or levels above level 1 hand
    nothing down. A level's own gradient is left out, as that of level 0 itself.
    """
    levels = (np.arange(1.0, 33.0).reshape(4, 8, 1), grey([[4, 16, 28, 12], [12, 28, 24, 40]]),
              grey([[32, 64]]))
    # Level 1 gets 8 and 16 from above: 12, 24, 44, 28 and 20, 36, 40, 56.
    above = grey([[3, 3, 6, 6, 11, 11, 7, 7]] * 2 + [[5, 5, 9, 9, 10, 10, 14, 14]] * 2)
    assert_close(impl.pyramid_backward(levels), levels[0] + above)


@exercise("6.11")
def test_a_single_level_is_its_own_gradient(impl):
    """A pyramid without a second level is an exception."""
    grad = np.arange(12.0).reshape(2, 3, 2)
    assert_close(impl.pyramid_backward((grad,)), grad)


@exercise("6.11")
def test_the_gradients_of_pyramids_are_central_differences(impl, rng, gradcheck):
    """A level is skipped or counted twice."""
    gradcheck(levels_of, lambda *grads: impl.pyramid_backward(tuple(grads[:-1])),
              (rng.normal(size=(8, 8, 2)),), name="pyramid")


# --- the level ---------------------------------------------------------------------------------

@exercise("6.12")
def test_a_pixel_of_two_to_sixteen_texels(impl):
    """J is not in texels. width and height are exchanged, or scale J's columns. 1/2 or R's root is
    left out, or log is not log2. S - R for S + R, the area, or a norm of J. A level below 0 is cut
    off.
    """
    jacobian = np.array([[[2 / 32, 0.0], [0.0, 1 / 8]], [[0.0, 8 / 32], [4 / 8, 0.0]],
                         [[1 / 32, 0.0], [0.0, 4 / 8]], [[0.5 / 32, 0.0], [0.0, 0.125 / 8]],
                         [[0.0, 2 / 32], [16 / 8, 0.0]]])
    assert_close(impl.mip_level(jacobian, 32, 8), [1.0, 3.0, 2.0, -1.0, 4.0])


@exercise("6.12")
def test_a_turned_pixel_has_the_same_level(impl):
    """C is left out: the longer of d/dx and d/dy (OpenGL's rule) is taken, and the level depends
    on how the texture is turned. Or A and B are of J's rows, not of its columns.
    """
    turns = np.stack([rotation(angle) for angle in (0.0, 0.3, 0.8, 1.5, 2.0)])
    stretched = turns @ np.diag([8.0, 1.0]) @ rotation(0.7)
    assert_close(impl.mip_level(4 * turns / 16, 16, 16), np.full(5, 2.0))
    assert_close(impl.mip_level(stretched / 16, 16, 16), np.full(5, 3.0))


@exercise("6.12")
def test_levels_are_those_of_the_greatest_singular_value(impl, rng):
    """The smallest singular value, the product of both (the area), or a norm of J."""
    jacobian = rng.normal(size=(40, 2, 2))
    for width, height in (64, 64), (16, 128):
        expected = np.log2(greatest_stretch(jacobian, width, height))
        assert_close(impl.mip_level(jacobian, width, height), expected)


@exercise("6.12", fine_print=True)
def test_no_change_at_all_is_level_minus_infinity(impl):
    """J = 0 gives NaN, or a guard, such as a small number that is added, makes it a number."""
    jacobian = np.array([np.zeros((2, 2)), np.eye(2) / 4])
    assert_close(impl.mip_level(jacobian, 8, 8), [-np.inf, 1.0])


@exercise("6.13")
def test_the_longer_axis_alone_moves_the_level(impl):
    """The chain rule's last factor, width and height, is left out or exchanged. ln 2 (log2 is not
    ln), 1/2, 2, 1 / (S + R) or grad_level is left out, or C's part. The shorter axis pulls, too, as
    R's part is missing.
    """
    jacobian = np.array([[[0.5, 0.0], [0.0, 0.25]], [[0.125, 0.0], [0.0, 0.5]],
                         [[0.1875, 0.25], [0.0, 0.0]], [[0.0, 0.0], [0.375, -0.5]]])
    got = impl.mip_level_backward(np.log(2.0) * np.array([1.0, -3.0, 1.0, 2.0]), jacobian, 16, 8)
    # In texels the last two are (3, 4), with the length 5: it grows along (3, 4) / 5.
    assert_close(got, [[[2.0, 0.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, -6.0]],
                       [[1.92, 2.56], [0.0, 0.0]], [[0.0, 0.0], [1.92, -2.56]]])


@exercise("6.13", fine_print=True)
def test_a_square_footprint_pulls_at_both_axes(impl):
    """0 / 0 where R is 0, in a square: its derivatives count as 0, and those of S are left. Or it
    is a finite difference, which is never exact.
    """
    jacobian = np.array([[[0.5, 0.0], [0.0, 1.0]], [[0.0, -0.25], [0.5, 0.0]]])
    got = impl.mip_level_backward(np.log(2.0) * np.ones(2), jacobian, 8, 4)
    assert_close(got, [[[1.0, 0.0], [0.0, 0.5]], [[0.0, -2.0], [1.0, 0.0]]])


@exercise("6.13", fine_print=True)
def test_a_tiny_footprint_is_not_yet_a_square(impl):
    """A small number is added to R in place of the case R = 0."""
    jacobian = 1e-9 * np.array([[[0.5, 0.0], [0.0, 0.25]]])
    got = impl.mip_level_backward(np.log(2.0) * np.ones(1), jacobian, 16, 16)
    assert_close(got, [[[2e9, 0.0], [0.0, 0.0]]], atol=1e-3)


@exercise("6.13", fine_print=True)
def test_no_change_at_all_has_no_gradient(impl):
    """NaN or infinity where J is 0."""
    jacobian = np.array([np.zeros((2, 2)), [[0.5, 0.0], [0.0, 0.25]]])
    got = impl.mip_level_backward(np.log(2.0) * np.array([7.0, 1.0]), jacobian, 16, 16)
    assert_close(got, [[[0.0, 0.0], [0.0, 0.0]], [[2.0, 0.0], [0.0, 0.0]]])


@exercise("6.13")
def test_the_gradients_of_levels_are_central_differences(impl, rng, gradcheck):
    """J is not in texels. One of the four derivatives is another's, or C pulls at one of its
    factors only.
    """
    flat = np.array([[[1.0, 0.5], [0.0, 0.0]], [[0.25, 0.0], [0.75, 0.0]]])  # a singular value of 0
    for width, height in (64, 16), (3, 8):
        jacobian = np.concatenate([rng.normal(size=(6, 2, 2)) / width, flat / width])
        gradcheck(lambda jacobian, *size: np.log2(greatest_stretch(jacobian, *size)),
                  impl.mip_level_backward, (jacobian, width, height), name="mip_level")


@exercise("6.14")
def test_a_level_lies_between_two(impl):
    """The level is rounded to the nearest, not down (floor). The fraction is that of the lower
    level, or the level itself. lower and upper are no integers, or the outputs are exchanged.
    """
    got = impl.blend_levels(np.array([0.25, 1.5, 2.875, 3.125, 1.75]), 9)
    assert_equal(got, ([0, 1, 2, 3, 1], [1, 2, 3, 4, 2], [0.25, 0.5, 0.875, 0.125, 0.75]))


@exercise("6.14")
def test_a_whole_level_is_the_lower_one_in_full(impl):
    """On a whole level upper is that level itself (by ceil), or it is the upper one in full."""
    got = impl.blend_levels(np.array([0.0, 1.0, 2.0, 3.0, 4.0]), 9)
    assert_equal(got, ([0, 1, 2, 3, 4], [1, 2, 3, 4, 5], np.zeros(5)))


@exercise("6.14")
def test_no_level_is_above_the_last_one(impl):
    """At the top upper is top + 1, a level beyond the pyramid that does not exist. Or lower is
    top - 1 and f = 1, or top is taken for the number of levels.
    """
    got = impl.blend_levels(np.array([3.0, 1.25, 2.75, 2.0]), 3)
    assert_equal(got, ([3, 1, 2, 2], [3, 2, 3, 3], [0.0, 0.25, 0.75, 0.0]))


@exercise("6.14")
def test_a_negative_level_is_level_0(impl):
    """The lower end is not clamped, or nothing is: a negative level stays negative, below 0. Or
    its fraction is taken before it is clamped.
    """
    got = impl.blend_levels(np.array([-7.5, -0.25, -1.0, 0.5, -3.75]), 3)
    assert_equal(got, (np.zeros(5, int), np.ones(5, int), [0.0, 0.0, 0.0, 0.5, 0.0]))


@exercise("6.14")
def test_a_level_beyond_the_top_is_the_top(impl):
    """The upper end is not clamped: a level above top stays there, or upper alone is clamped, or
    the fraction is taken before.
    """
    got = impl.blend_levels(np.array([3.5, 9.0, 2.5, 4.0, 3.25]), 3)
    assert_equal(got, ([3, 3, 2, 3, 3], np.full(5, 3), [0.0, 0.0, 0.5, 0.0, 0.0]))


@exercise("6.14")
def test_levels_are_clamped_to_the_pyramid(impl):
    """Infinite levels, or a pyramid of one level, top = 0: it has level 0 alone."""
    for top in 3, 0:
        level = np.array([-np.inf, -7.5, -0.25, 3.5, 9.0, np.inf])
        got = impl.blend_levels(level, top)
        assert_equal(got, ([0, 0, 0, top, top, top],
                           np.array([min(1, top)] * 3 + [top] * 3), np.zeros(6)))


@exercise("6.14")
def test_the_blend_is_the_level_itself(impl, rng):
    """Right for a few levels alone, or for a pyramid of a few levels."""
    top, level = int(rng.integers(4, 20)), rng.integers(-30, 180, 60) / 8
    got = impl.blend_levels(level, top)
    lower = np.array([sum(whole <= one for whole in range(1, top + 1)) for one in level])
    assert_equal(got, (lower, np.minimum(lower + 1, top), level.clip(0, top) - lower))
