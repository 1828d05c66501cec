"""What the exercises of lab 14 must do: moments, their blur, and a map that moves."""
import numpy as np
import pytest

from course.checks import assert_close, assert_equal, assert_picture, exercise
from course.given.gradcheck import gradcheck

# Light from a point and from a direction; their maps are not square.
CONE = np.array([[1.5, 0, 0, 0], [0, 2.0, 0, 0], [0, 0, -1.5, -2.5], [0, 0, -1, 0]])
PARALLEL = np.array([[0.4, 0, 0, 0], [0, 0.7, 0, 0], [0, 0, -0.5, -2.0], [0, 0, 0, 1]])
each_light = pytest.mark.parametrize("light", [CONE, PARALLEL], ids=["cone", "parallel"])


def projected(q, light, width, height):
    """By the whole matrix, point by point: x, y in texels (N, 2), depth from -1 to 1 (N,)."""
    clip = np.array([light @ [*point, 1.0] for point in q])
    ndc = clip[:, :3] / clip[:, 3:]
    return (ndc[:, :2] + 1) * [width / 2, height / 2], ndc[:, 2]


def point_at(x, y, distance, light, width, height):
    """The point of the light's frame that lies at (x, y) of the map, at this distance."""
    w = light[3, 3] - light[3, 2] * distance
    return np.array([(2 * x / width - 1) * w / light[0, 0], (2 * y / height - 1) * w / light[1, 1],
                     -distance])


# --- moments ------------------------------------------------------------------------------------

def square(picture, i, j, radius):
    """The part of a picture up to radius rows and columns away from [i, j]."""
    return picture[max(i - radius, 0):i + radius + 1, max(j - radius, 0):j + radius + 1]


def each_square(picture, radius, of):
    """of(the square around it) for each pixel of a picture (H, W, C)."""
    height, width = picture.shape[:2]
    return np.array([[of(square(picture, i, j, radius)) for j in range(width)]
                     for i in range(height)])


@exercise("14.16")
def test_a_pixel_gives_to_all_squares_that_hold_it(impl):
    """The gradient is blurred: at the border, it was another number of pixels that shared."""
    grad = np.array([[0.0, 6.0, 0.0, 8.0]])[..., None]
    assert_close(impl.box_blur_backward(grad, 1)[..., 0], np.array([[2.0, 2.0, 6.0, 4.0]]))


@exercise("14.16")
def test_the_gradients_of_the_blur_are_central_differences(impl, rng):
    """grad_output is given to the wrong neighbours, or channels are mixed."""
    gradcheck(lambda picture: each_square(picture, 2, lambda part: part.mean((0, 1))),
              lambda grad, picture: impl.box_blur_backward(grad, 2),
              (rng.normal(size=(4, 7, 3)),), name="box_blur")


@exercise("14.17")
def test_lit_shares_on_paper(impl):
    """The variance is not the mean square less the squared mean; the near side is dark, too."""
    got = impl.chebyshev(np.array([1.0, 3.0, 4.0, 7.0]), np.full(4, 3.0), np.full(4, 13.0), 1e-3)
    assert_close(got, np.array([1.0, 1.0, 4 / 5, 1 / 5]))


@exercise("14.17")
def test_the_variance_has_a_floor(impl):
    """Rounding makes the variance negative; the floor is added in place of a maximum."""
    got = impl.chebyshev(np.array([5.0, 5.0, 5.0]), np.array([3.0, 3.0, 3.0]),
                         np.array([9.0, 8.0, 9.5]), 0.5)
    assert_close(got, np.full(3, 1 / 9))


@exercise("14.17")
def test_two_flat_surfaces_have_their_share(impl, rng):
    """A wall before a wall: the lit share of the one behind is its share of the filter."""
    share, near, behind = rng.uniform(0.1, 0.9, 20), rng.uniform(1, 2, 20), rng.uniform(3, 4, 20)
    mean = (1 - share) * near + share * behind
    mean_square = (1 - share) * near**2 + share * behind**2
    assert_close(impl.chebyshev(behind, mean, mean_square, 1e-6), share)


def lit_share(distance, mean, mean_square, least=0.3):
    """Eq. (9), number by number."""
    variance = [max(b - a * a, least) for a, b in zip(mean, mean_square, strict=True)]
    return np.array([v / (v + (d - a)**2) if d > a else 1.0
                     for d, a, v in zip(distance, mean, variance, strict=True)])


@exercise("14.18")
def test_gradients_of_the_share_on_paper(impl):
    """The mean's part in the variance is forgotten; the near side has a gradient."""
    # v = 4, b = 4: by the distance -2 v b / 400, by the variance b^2 / 400 = 1/25.
    got = impl.chebyshev_backward(np.array([25.0, 25.0]), np.array([7.0, 2.0]), np.full(2, 3.0),
                                  np.full(2, 13.0), 1e-3)
    assert_close(got, (np.array([-2.0, 0.0]), np.array([-4.0, 0.0]), np.array([1.0, 0.0])))


@exercise("14.18")
def test_a_floored_variance_has_no_gradient(impl):
    """The floor hands a gradient on."""
    got = impl.chebyshev_backward(np.ones(3), np.full(3, 5.0), np.full(3, 3.0),
                                  np.array([9.0, 9.5, 10.5]), 1.0)
    assert_close(got[0], np.array([-4 / 25, -4 / 25, -6 / 5.5**2]))
    assert_close(got[2], np.array([0.0, 0.0, (2 / 5.5)**2]))
    assert_close(got[1][:2], np.array([4 / 25, 4 / 25]))


@exercise("14.18")
def test_the_gradients_of_the_share_are_central_differences(impl, rng):
    """grad_lit is ignored; a sign is lost; a variance under the floor is taken as it is."""
    mean, variance = rng.uniform(2, 4, 12), rng.uniform(0.4, 1.5, 12)
    distance, variance[:6] = mean + rng.uniform(-1, 2, 12), rng.uniform(0.0, 0.2, 6)
    distance[:4] = mean[:4] + rng.uniform(0.5, 2, 4)
    mean_square = mean**2 + variance
    gradcheck(lambda d, a, b: lit_share(d, a, b),
              lambda grad, d, a, b: impl.chebyshev_backward(grad, d, a, b, 0.3),
              (distance, mean, mean_square),
              decisions=lambda d, a, b: (d > a, b - a**2 > 0.3), name="chebyshev")


# --- a map that moves ---------------------------------------------------------------------------

@exercise("14.19")
def test_the_middle_stays_and_the_border_runs_outwards_on_paper(impl):
    """Measured from the map's corner, or from the texel's; rows and columns are swapped."""
    distance_map = np.array([[3.0, 1.5, 3.0, 3.0], [3.0, 3.0, 6.0, 3.0]])
    motion = impl.map_motion(distance_map, CONE)
    assert_equal(motion.shape, (2, 4, 2, 3))
    assert_close(motion[0, 1], np.array([[2.0, 0.0, -1 / 3], [0.0, 4 / 3, -1 / 3]]))
    assert_close(motion[1, 2], np.array([[0.5, 0.0, 1 / 12], [0.0, 1 / 3, 1 / 12]]))
    got = impl.map_motion(distance_map, PARALLEL)
    assert_close(got, np.broadcast_to([[0.8, 0, 0], [0, 0.7, 0]], (2, 4, 2, 3)))


@exercise("14.19")
@each_light
def test_motion_is_the_slope_of_the_place(impl, rng, light):
    """A factor of x in y; the distance of another texel; C_33 is left out of w."""
    light = light + np.array([[0], [0], [0], [0.3]]) * [0, 0, 0, 1]
    distance_map, h = rng.uniform(1, 5, (3, 5)), 1e-5
    expected = np.zeros((3, 5, 2, 3))
    for i, j, axis in np.ndindex(3, 5, 3):
        q = point_at(j + 0.5, i + 0.5, distance_map[i, j], light, 5, 3)
        ends = np.array([q + h * np.eye(3)[axis], q - h * np.eye(3)[axis]])
        ahead, behind = projected(ends, light, 5, 3)[0]
        expected[i, j, :, axis] = (ahead - behind) / (2 * h)
    assert_close(impl.map_motion(distance_map, light), expected, rtol=1e-6, atol=1e-8)


def moved(distance_map, motion, move):
    """Eq. (10), pair by pair."""
    height, width = distance_map.shape
    before = np.stack([distance_map, distance_map**2], -1)
    after = np.stack([distance_map - move[2], (distance_map - move[2])**2], -1)
    for i, j in np.ndindex(height, width):
        for axis, other in (0, (i, j + 1)), (1, (i + 1, j)):
            if other[0] < height and other[1] < width:
                front = other if distance_map[other] < distance_map[i, j] else (i, j)
                change = (motion[front][axis] @ move) / 2 * (before[other] - before[i, j])
                after[i, j] -= change
                after[other] -= change
    return after


STEP = np.array([[1.0, 1.0, 3.0, 3.0]])
ACROSS = np.tile([[2.0, 0, 0], [0, 2.0, 0]], (1, 4, 1, 1)) / STEP[..., None, None]


@exercise("14.20")
def test_a_step_moves_with_the_nearer_side(impl):
    """With the farther side; to the left; or the pixels change by the whole jump each."""
    got = impl.moved_moments(STEP, ACROSS, np.array([0.1, 0.0, 0.0]))
    assert_close(got[0, :, 0], np.array([1.0, 0.8, 2.8, 3.0]))     # by 0.2 texels, the jump is 2
    assert_close(got[0, :, 1], np.array([1.0, 0.2, 8.2, 9.0]))
    got = impl.moved_moments(STEP.T.copy(), ACROSS.swapaxes(0, 1), np.array([9, -0.1, 0]))
    assert_close(got[:, 0, 0], np.array([1.0, 1.2, 3.2, 3.0]))


@exercise("14.20")
def test_without_steps_only_the_distance_changes(impl):
    """move_z is forgotten or has the wrong sign; the squares are not those of the new distances."""
    flat = np.full((3, 4), 2.0)
    got = impl.moved_moments(flat, np.ones((3, 4, 2, 3)), np.array([1.0, 2.0, 0.5]))
    assert_close(got, np.broadcast_to([1.5, 2.25], (3, 4, 2)))


@exercise("14.20")
def test_every_pair_moves_its_border(impl, rng):
    """Steps are taken from what other pairs have changed; a pair is left out."""
    distance_map = rng.integers(1, 4, (5, 7)).astype(float)
    motion, move = rng.normal(size=(5, 7, 2, 3)), 0.3 * rng.normal(size=3)
    got = impl.moved_moments(distance_map, motion, move)
    assert_picture(got[..., 0], moved(distance_map, motion, move)[..., 0], atol=1e-12)
    assert_close(got, moved(distance_map, motion, move))


@exercise("14.21")
def test_the_gradient_of_a_step_on_paper(impl):
    """The sign is lost, or only one side of the step counts."""
    grad = np.array([[[5.0, 0.0], [1.0, 0.0], [3.0, 0.0], [0.0, 2.0]]])
    got = impl.moved_moments_backward(grad, STEP, ACROSS, np.zeros(3))
    # By x: half of -(1 + 3) 2 x the jump of 2. By z: -(5 + 1 + 3) - 2 x 3 x 2.
    assert_close(got, np.array([-8.0, 0.0, -21.0]))


@exercise("14.21")
def test_the_gradients_of_the_move_are_central_differences(impl, rng):
    """The second moment's part is forgotten; the owner is not that of the forward pass."""
    distance_map = rng.integers(1, 4, (4, 6)).astype(float)
    motion, move = rng.normal(size=(4, 6, 2, 3)), 0.3 * rng.normal(size=3)
    gradcheck(moved, lambda grad, *given: impl.moved_moments_backward(grad, *given),
              (distance_map, motion, move), differentiable=[2], name="moved_moments")
