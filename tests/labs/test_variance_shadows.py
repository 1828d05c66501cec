"""What the exercises of lab 14 must do: moments, their blur, and a map that moves."""
import numpy as np
from scipy.ndimage import map_coordinates

from labkit.checks import assert_close, assert_picture, exercise

# --- moments ------------------------------------------------------------------------------------

def each_square(picture, radius, of):
    """of(the square of that radius around it) for each pixel of a picture (H, W, C)."""
    rows, columns = ([slice(max(k - radius, 0), k + radius + 1) for k in range(side)]
                     for side in picture.shape[:2])
    return np.array([[of(picture[row, column]) for column in columns] for row in rows])


def at_centres(mean, mean_square):
    """A map of one row with these moments, and the places (N, 2) of its texels' centres."""
    uv = (np.arange(len(mean)) + 0.5) / len(mean)
    return np.stack([mean, mean_square], -1)[None], np.stack([uv, np.full(len(mean), 0.5)], -1)


@exercise("14.9")
def test_lit_shares_on_paper(impl):
    """The variance is not E_1 - E_0^2: the squared mean is not subtracted, or not squared, or a
    root is taken, the standard deviation. The near side is dark, too, or instead. distance - E_0 is
    not squared. It is the dark share. least_variance is added, or the most.
    """
    given = at_centres([3.0, 4.0, 2.0, 3.0, 3.0], [13.0, 25.0, 5.0, 13.0, 13.0])
    got = impl.lit_by_moments(*given, np.array([7.0, 8.0, 5.0, 4.0, 2.0]), 0, 0.125)
    # The variances are 4, 9, 1, 4, 4, the distances beyond the mean 4, 4, 3, 1 and none.
    assert_close(got, [4 / 20, 9 / 25, 1 / 10, 4 / 5, 1.0])


@exercise("14.9")
def test_the_variance_has_a_floor(impl):
    """The floor least_variance is left out, or added in place of a maximum. Rounding can make the
    variance negative: its absolute value is not the floor.
    """
    given = at_centres([3.0, 3.0, 3.0, 3.0], [9.0, 8.0, 9.25, 9.5])
    got = impl.lit_by_moments(*given, np.array([5.0, 4.0, 6.0, 5.0]), 0, 0.5)
    assert_close(got, [1 / 9, 1 / 3, 1 / 19, 1 / 9])


@exercise("14.9")
def test_two_flat_surfaces_have_their_share(impl, rng):
    """The map is not blurred, or the distance is, and squared then. A wall before a wall: the lit
    share of the one behind is its share of the blur.
    """
    behind = rng.random((1, 30)) < 0.5
    distance_map = np.where(behind, 4.0, 1.5)
    moments, uv = at_centres(distance_map[0], distance_map[0]**2)
    share = each_square(behind[..., None], 3, np.mean)[0]
    assert_close(impl.lit_by_moments(moments, uv, np.full(30, 4.0), 3, 1e-9), share, atol=1e-8)


OUTSIDE = np.array([[-0.01, 0.5], [1.0, 0.5], [0.5, -0.2], [0.5, 1.0], [0.0, 0.0], [0.99, 0.99]])


@exercise("14.9")
def test_outside_the_map_all_is_lit(impl):
    """It goes on there as at the border, or at the other side; the border itself is off by one."""
    got = impl.lit_by_moments(np.full((2, 3, 2), [2.0, 5.0]), OUTSIDE, np.full(6, 5.0), 1, 0.1)
    assert_close(got, [1.0, 1.0, 1.0, 1.0, 0.1, 0.1])


def means(moments, uv, radius=1):
    """The blurred moments, read at uv (N, 2) as if the border of the map went on: each (N,)."""
    blurred = each_square(moments, radius, lambda part: part.mean((0, 1)))
    at = (uv * [moments.shape[1], moments.shape[0]] - 0.5).T[::-1]
    return [map_coordinates(one, at, order=1, mode="nearest") for one in blurred.transpose(2, 0, 1)]


def share(moments, uv, distance):
    """Eqs. (8) and (9) within the map."""
    mean, square = means(moments, uv)
    variance = np.where(square - mean**2 > 0.3, square - mean**2, 0.3)
    return np.where(distance > mean, variance / (variance + (distance - mean)**2), 1.0)


def a_map(rng):
    """Moments of a map, of which a part is flat, places on it, distances there."""
    distance_map = rng.uniform(1, 4, (5, 7))
    distance_map[:, 4:] = 2.0
    return (np.stack([distance_map, distance_map**2], -1), rng.uniform(0, 1, (40, 2)),
            rng.uniform(1.5, 5, 40))


@exercise("14.9")
def test_the_blurred_map_is_read_between_texels(impl, rng):
    """It is read at the nearest texel, or wrapped at the border; u and v are swapped."""
    given = a_map(rng)
    assert_close(impl.lit_by_moments(*given, 1, 0.3), share(*given))


@exercise("14.10")
def test_gradients_on_paper(impl):
    """The near side, where the share is 1, has a gradient. Quotient rule: the variance is in
    numerator and denominator, which is squared. A sign, a 2 or grad_lit is lost. The mean's part by
    variance or distance is forgotten. A finite difference is inexact.
    """
    # v = 4, b = 4: by the distance -2 v b / 400, by the variance b^2 / 400 = 1/25. And so on.
    given = at_centres([3.0, 4.0, 2.0, 3.0], [13.0, 25.0, 5.0, 13.0])
    moments, _, distance = impl.lit_by_moments_backward(
        np.array([25.0, 62.5, -50.0, 25.0]), *given, np.array([7.0, 8.0, 5.0, 2.0]), 0, 0.125)
    assert_close(distance, [-2.0, -7.2, 3.0, 0.0])
    assert_close(moments, [[[-4.0, 1.0], [-5.6, 1.6], [15.0, -4.5], [0.0, 0.0]]])


@exercise("14.10")
def test_a_floored_variance_has_no_gradient(impl):
    """The floor least_variance hands a gradient on to the moments; there the variance is a
    constant. Or all gradients are 0 there: that by the distance, and the mean's part of it, stay.
    """
    given = at_centres(np.full(4, 3.0), [9.0, 9.5, 10.5, 9.75])
    moments, _, distance = impl.lit_by_moments_backward(
        np.array([25.0, 50.0, 30.25, 4.0]), *given, np.array([5.0, 5.0, 5.0, 4.0]), 0, 1.0)
    # The variances are 1, 1, 3/2, 1. By the distance: -2 v b / (v + b^2)^2, say -4/25 at first.
    assert_close(distance, [-4.0, -8.0, -6.0, -2.0])
    assert_close(moments, [[[4.0, 0.0], [8.0, 0.0], [-18.0, 4.0], [2.0, 0.0]]])


@exercise("14.10")
def test_outside_the_map_there_is_no_gradient(impl):
    """Receivers outside of it hand a gradient on; the border itself is off by one."""
    moments, _, distance = impl.lit_by_moments_backward(
        np.full(6, 50.0), np.full((2, 3, 2), [2.0, 5.0]), OUTSIDE, np.full(6, 5.0), 1, 0.1)
    assert_close(distance, [0.0, 0.0, 0.0, 0.0, -3.0, -3.0])
    assert_close(moments.sum((0, 1)), [-30.0, 9.0])


def decided(moments, uv, distance):
    """Where `share` has a bend: at texels, the floor, the near side."""
    mean, square = means(moments, uv)
    return np.floor(uv * [7, 5] - 0.5), square - mean**2 > 0.3, distance > mean


@exercise("14.10")
def test_the_gradient_by_the_distance_is_a_central_difference(impl, rng, gradcheck):
    """A variance under the floor is taken as it is; the quotient rule is cut short."""
    gradcheck(share, lambda grad, *given: impl.lit_by_moments_backward(grad, *given, 1, 0.3)[2],
              a_map(rng), differentiable=[2], decisions=decided, name="lit_by_moments")


@exercise("14.10")
def test_the_gradient_by_the_place_is_a_central_difference(impl, rng, gradcheck):
    """It is that with respect to texels, or of the map before its blur, or is left out."""
    gradcheck(share, lambda grad, *given: impl.lit_by_moments_backward(grad, *given, 1, 0.3)[1],
              a_map(rng), differentiable=[1], decisions=decided, name="lit_by_moments")


@exercise("14.10")
def test_the_gradient_by_the_moments_is_a_central_difference(impl, rng, gradcheck):
    """The blur's way back is left out, or is a blur; the look-up's is left out."""
    gradcheck(share, lambda grad, *given: impl.lit_by_moments_backward(grad, *given, 1, 0.3)[0],
              a_map(rng), differentiable=[0], decisions=decided, name="lit_by_moments")


# --- a map that moves ---------------------------------------------------------------------------

def moved(distance_map, motion, move):
    """Eq. (10), pair by pair."""
    height, width = distance_map.shape
    before = np.stack([distance_map, distance_map**2], -1)
    after = np.stack([distance_map - move[2], (distance_map - move[2])**2], -1)
    for axis, i, j in np.ndindex(2, height, width):
        other = i + axis, j + 1 - axis
        if other[0] < height and other[1] < width:
            front = other if distance_map[other] < distance_map[i, j] else (i, j)
            change = (motion[front][axis] @ move) / 2 * (before[other] - before[i, j])
            after[[i, i + axis], [j, j + 1 - axis]] -= change
    return after


STEP = np.array([[1.0, 1.0, 3.0, 3.0]])
ACROSS = np.eye(2, 3) * np.array([5.0, 2.0, 2 / 3, 7.0])[:, None, None][None]  # texels to a unit


@exercise("14.11")
def test_a_step_moves_with_the_nearer_side(impl):
    """With the farther side, or both. To the left: the sign. Pixels change by the whole jump, not
    by half of it. Only the texel on one side of a border changes, or the other one with the
    other sign. One axis is left out.
    """
    # By 0.2 texels, the jump is 2.
    got = impl.moved_moments(STEP, ACROSS, np.array([0.1, 0.0, 0.0]))
    assert_close(got, [[[1.0, 1.0], [0.8, 0.2], [2.8, 8.2], [3.0, 9.0]]])
    got = impl.moved_moments(STEP.T.copy(), ACROSS.swapaxes(0, 1), np.array([9, 0.3, 0]))
    assert_close(got, [[[1.0, 1.0]], [[0.4, -1.4]], [[2.4, 6.6]], [[3.0, 9.0]]])


@exercise("14.11")
def test_without_steps_only_the_distance_changes(impl):
    """move_z is forgotten or has the wrong sign; the squares are not those of the new distances."""
    flat = np.full((3, 4), 2.0)
    got = impl.moved_moments(flat, np.ones((3, 4, 2, 3)), np.array([1.0, 2.0, 0.5]))
    assert_close(got, np.broadcast_to([1.5, 2.25], (3, 4, 2)))


@exercise("14.11")
def test_every_pair_moves_its_border(impl, rng):
    """Steps E_b - E_a are taken from what other pairs have changed already, or after the move; a
    pair, or an axis, is left out.
    """
    distance_map = rng.integers(1, 4, (5, 7)).astype(float)
    motion, move = rng.normal(size=(5, 7, 2, 3)), 0.3 * rng.normal(size=3)
    got = impl.moved_moments(distance_map, motion, move)
    assert_picture(got[..., 0], moved(distance_map, motion, move)[..., 0], atol=1e-12)
    assert_close(got, moved(distance_map, motion, move))


@exercise("14.12")
def test_the_gradient_of_a_step_on_paper(impl):
    """By x and y: the sign, the half, or one of a border's two texels, is lost, or the farther one
    moves it. By z: the gradient through the distances is missing, or that of the square (second
    moment): 2 (d - move_z), not 2 d.
    """
    # A step in x between the first two, in y between the last two; the nearer moves 2 texels.
    distance_map = np.array([[1.0, 3.0], [1.0, 1.0]])
    motion = np.zeros((2, 2, 2, 3))
    motion[..., 0, 0], motion[..., 1, 1] = 2 / distance_map, 2 / distance_map
    grad = np.array([[[5.0, 0.0], [1.0, 0.5]], [[3.0, 0.0], [2.0, 1.0]]])
    got = impl.moved_moments_backward(grad, distance_map, motion, np.array([0.0, 0.0, 0.5]))
    # By x: -2/2 x ((5 + 1) 2 + 0.5 x 8). By y: the step is -2, and -8 of the squares, from 3 to 1:
    # -2/2 x ((1 + 2) (-2) + (0.5 + 1) (-8)). By z: -(5 + 1 + 3 + 2) - 2 (0.5 x 2.5 + 1 x 0.5).
    assert_close(got, [-16.0, 18.0, -14.5])


@exercise("14.12")
def test_the_gradients_of_the_move_are_central_differences(impl, rng, gradcheck):
    """The second moment's part is forgotten, or is 2 d: it is 2 (d - move_z), of the moved
    distance. The texel in front is not that of the forward pass.
    """
    distance_map = rng.integers(1, 4, (4, 6)).astype(float)
    motion, move = rng.normal(size=(4, 6, 2, 3)), 0.3 * rng.normal(size=3)
    gradcheck(moved, impl.moved_moments_backward, (distance_map, motion, move), differentiable=[2],
              name="moved_moments")
