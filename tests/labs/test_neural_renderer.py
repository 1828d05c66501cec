"""What the exercises of lab 10's maps must do: faces, weights and depth."""
import numpy as np
import pytest

from labkit.checks import assert_close, assert_equal, assert_picture, exercise, parts

SLANTED = np.array([[1.0, 2.0], [7.0, 1.0], [3.0, 6.0]])  # counter-clockwise, twice its area is 26


def inverse_of(screen):
    """M^-1 by NumPy: screen (..., 3, 2)."""
    ones = np.ones((*screen.shape[:-1], 1))
    return np.linalg.inv(np.swapaxes(np.concatenate([screen, ones], -1), -1, -2))


def random_triangles(rng, *shape):
    """Counter-clockwise, no side shorter than 2, none thin: (*shape, 3, 2)."""
    angle = rng.uniform(0, 2, (*shape, 1)) + rng.uniform(0, 1, (*shape, 3)) + [0.0, 2.0, 4.0]
    circle = np.stack([np.cos(angle), np.sin(angle)], -1)
    return circle * rng.uniform(2, 5, (*shape, 1, 1)) + rng.uniform(-3, 9, (*shape, 1, 2))


@exercise("10.1")
def test_its_rows_are_edge_functions_over_twice_the_area(impl):
    """The division by 2A is missing, or is by A. Row k is of the edge that starts at corner k, not
    of the one opposite to it. The inverse is transposed: the corners are in rows. The sign of x and
    y, or of the constant, is wrong.
    """
    assert_close(impl.face_inverse(SLANTED), np.array([[-5, -4, 39], [4, -2, 0], [1, 6, -13]]) / 26)


@exercise("10.1")
def test_it_is_the_inverse_for_either_winding(impl, rng):
    """The area is its absolute value, so that a clockwise face gets minus its inverse. Or leading
    axes are mixed.
    """
    screen = random_triangles(rng, 4, 5)
    screen[1] = screen[1, :, ::-1]
    assert_close(impl.face_inverse(screen), inverse_of(screen), atol=1e-11)


UNIT = inverse_of(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))  # c = (1 - x - y, x, y)
LARGE = np.array([[-8.0, -8.0], [24.0, -8.0], [-8.0, 24.0]])  # it covers all pixels


# --- pixels ------------------------------------------------------------------------------------

RIGHT = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]])  # c = (1 - x / 4 - y / 2, x / 4, y / 2)


@exercise("10.2")
def test_weights_and_depths_on_paper(impl):
    """Output 1, weight, is multiplied by depth / z, as in space. Output 2, depth, is the mean of z
    by the weights, or is 1 / z: the reciprocal is left out. x and y are exchanged, half a pixel is
    added, M^-1 is transposed, or the point lacks its 1.
    """
    x, y, z = np.array([1.0, 2.0, 1.0, 0.5]), np.array([1.0, 0.5, 0.5, 1.5]), [1.0, 2.0, 4.0]
    got = impl.screen_weights_and_depth(np.stack([inverse_of(RIGHT)] * 4), np.array([z] * 4), x, y)
    weight = np.array([[2, 2, 4], [2, 4, 2], [4, 2, 2], [1, 1, 6]]) / 8
    assert_close(got, (weight, [2, 16 / 9, 16 / 11, 8 / 3]))


@exercise("10.2")
def test_in_the_middle_all_weights_are_a_third(impl):
    """It is right for many points, and not for a single one, whose x and y have no axes."""
    x, y = SLANTED.mean(0)
    got = impl.screen_weights_and_depth(inverse_of(SLANTED), np.array([1.0, 2.0, 2.0]), x, y)
    assert_close(got, (np.full(3, 1 / 3), 1.5))


@exercise("10.2")
def test_a_corner_has_its_own_depth(impl):
    """Weights or z of another corner."""
    z = np.array([2.0, 3.0, 5.0])
    weight, depth = impl.screen_weights_and_depth(np.stack([inverse_of(SLANTED)] * 3),
                                                  np.stack([z] * 3), *SLANTED.T)
    assert_close(weight, np.eye(3), atol=1e-9)
    assert_close(depth, z)


@exercise("10.2")
def test_depth_is_that_of_the_plane_in_space(impl, rng):
    """Depth is interpolated on screen as it is; what is linear there is 1 / z. Or points are mixed.

    Points in space are (x z, y z, z).
    """
    screen, z = random_triangles(rng, 2, 7), rng.uniform(1, 4, (2, 7, 3))
    b = rng.dirichlet(np.ones(3), (2, 7))
    ones = np.ones((2, 7, 3, 1))
    points = (np.concatenate([screen, ones], -1) * (z * b)[..., None]).sum(-2)
    x, y = points[..., 0] / points[..., 2], points[..., 1] / points[..., 2]
    weight, depth = impl.screen_weights_and_depth(inverse_of(screen), z, x, y)
    assert_close(depth, points[..., 2], rtol=1e-8)
    assert_close(weight * depth[..., None] / z, b, atol=1e-8)


@exercise("10.2")
def test_outside_weights_are_clamped_then_divided_by_their_sum(impl):
    """Nothing is clamped, or only from below. The clamped weights are not divided by their sum, or
    are first divided and then clamped. depth has the weights before the clamp.
    """
    got = impl.screen_weights_and_depth(np.stack([UNIT] * 3), np.array([[1.0, 2.0, 4.0]] * 3),
                                        np.array([1.5, -0.5, 2.0]), np.array([-0.75, 0.25, 3.0]))
    weight = [[0.2, 0.8, 0.0], [0.8, 0.0, 0.2], [0.0, 0.5, 0.5]]
    assert_close(got, (weight, [1 / 0.6, 1 / 0.85, 8 / 3]))


def unclamped(inverse, x, y):
    return np.einsum("...kl,...l->...k", inverse, np.stack([x, y, np.ones_like(x)], -1))


def screen_weights_and_depth(inverse, z, x, y):
    weight = np.clip(unclamped(inverse, x, y), 0, 1)
    weight = weight / weight.sum(-1, keepdims=True)
    return weight, 1 / (weight / z).sum(-1)


AT = np.array(2.0), np.array(0.5)  # in RIGHT: w = (1, 2, 1) / 4, and with Z the depth is 2
Z = np.array([1.0, 4.0, 2.0])


@exercise("10.5")
def test_depth_alone_has_a_gradient_by_z(impl):
    """In output 2, grad_z = depth^2 w / z^2: depth^2 is left out, z is not squared, or the sign is
    wrong.
    """
    returned = impl.screen_weights_and_depth_backward(np.zeros(3), np.array(8.0),
                                                      inverse_of(RIGHT), Z, *AT)
    _, grad_z = parts(returned, "grad_inverse", "grad_z")
    assert_close(grad_z, [8.0, 1.0, 2.0])


@exercise("10.5")
def test_depth_depends_on_the_inverse_through_the_weights(impl):
    """The way from depth through the weights is left out of grad_inverse. The sum that they are
    divided by is taken for a constant. (x, y, 1) is in another order.
    """
    returned = impl.screen_weights_and_depth_backward(np.zeros(3), np.array(8.0),
                                                      inverse_of(RIGHT), Z, *AT)
    grad_inverse, _ = parts(returned, "grad_inverse", "grad_z")
    # By w it is -8 depth^2 / z = (-32, -8, -16), less its mean by the weights, -16.
    assert_close(grad_inverse, [[-32.0, -8.0, -16.0], [16.0, 4.0, 8.0], [0.0, 0.0, 0.0]])


@exercise("10.5")
def test_the_sum_of_the_weights_cannot_change(impl):
    """The division by the sum is left out of the gradient: the sum is taken for a constant."""
    inverse, one = inverse_of(SLANTED), np.array(3.0)
    got = impl.screen_weights_and_depth_backward(np.full(3, 7.0), np.array(0.0), inverse,
                                                 np.array([1.0, 2.0, 3.0]), one, one)
    assert_close(got, (np.zeros((3, 3)), np.zeros(3)), atol=1e-12)


@exercise("10.5")
def test_what_is_clamped_has_no_gradient(impl):
    """The clamp is forgotten: a c_k below 0 or above 1 gets a gradient, too. Or nothing is divided
    by the sum of the clamped. Or grad_weight is not used.
    """
    got = impl.screen_weights_and_depth_backward(np.array([1.0, 10.0, 100.0]), np.array(0.0),
                                                 UNIT, np.ones(3), np.array(-0.5),
                                                 np.array(0.25))
    # c = 1.25, -0.5, 0.25 -> u = 1, 0, 0.25: w = 0.8, 0, 0.2, and grad . w = 20.8
    expected = np.zeros((3, 3))
    expected[2] = np.array([-0.5, 0.25, 1.0]) * 79.2 / 1.25
    assert_close(got, (expected, np.zeros(3)), atol=1e-9)


@exercise("10.5")
@pytest.mark.parametrize("reach", [0.9, 3.0])
def test_gradients_of_weights_and_depth_are_central_differences(impl, rng, reach, gradcheck):
    """A term is left out: the sum's, that of depth through the weights, or outside of the face the
    clamp's.
    """
    screen, z = random_triangles(rng, 2, 5), rng.uniform(1, 4, (2, 5, 3))
    b = rng.dirichlet(np.ones(3), (2, 5)) * reach + (1 - reach) / 3
    x, y = np.moveaxis((screen * b[..., None]).sum(-2), -1, 0)

    def clamped(inverse, z, x, y):
        c = unclamped(inverse, x, y)
        return (c < 0) + 2 * (c > 1)

    gradcheck(screen_weights_and_depth, impl.screen_weights_and_depth_backward,
              (inverse_of(screen), z, x, y), differentiable=[0, 1], decisions=clamped,
              name="weights and depth")


@exercise("10.5", fine_print=True)
def test_only_what_the_clamp_changes_has_no_gradient(impl):
    """A c_k of exactly 0 or 1 counts as clamped, by < for <= or > for >=. It keeps its gradient."""
    inverse = inverse_of(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])).round()
    z, grad_weight = np.ones(3), np.array([1.0, 10.0, 100.0])
    corner = impl.screen_weights_and_depth_backward(grad_weight, np.array(0.0), inverse, z,
                                                    np.array(0.0), np.array(0.0))
    assert_close(corner[0][:, 2], [0.0, 9.0, 99.0])
    beside = impl.screen_weights_and_depth_backward(grad_weight, np.array(0.0), inverse, z,
                                                    np.array(0.5), np.array(-0.5))
    # c = 1, 0.5, -0.5: w = 2 / 3, 1 / 3, 0, and grad . w = 4
    assert_close(beside[0][:, 2], np.array([-3.0, 6.0, 0.0]) / 1.5)


def corners_of_screen(screen, z, width, height):
    """Corners in ndc of faces at screen (F, 3, 2), z (F, 3)."""
    z = np.broadcast_to(np.asarray(z, float), screen.shape[:-1])
    return np.concatenate([screen / [width / 2, height / 2] - 1, z[..., None]], -1)


def maps(returned):
    """face_index, weight, depth of what was returned."""
    return parts(returned, "face_index", "weight", "depth")


def maps_by_search(corners, width, height, near, far):
    """Each pixel asks each face, with NumPy's inverse."""
    inverse = inverse_of((corners[..., :2] + 1) * [width / 2, height / 2])
    y, x = np.indices((height, width)) + 0.5
    c = np.einsum("fkl,lij->fijk", inverse, [x, y, 1 + 0 * x])
    z = corners[:, None, None, :, 2]
    d = 1 / (c / z).sum(-1)
    front = (np.linalg.det(inverse) > 0)[:, None, None]
    d[~(front & ((c >= 0) & (z >= 0)).all(-1) & (near < d) & (d < far))] = np.inf
    face_index, depth = d.argmin(0), d.min(0)
    seen = depth < np.inf
    weight = np.take_along_axis(c, face_index[None, ..., None], 0)[0]
    return np.where(seen, face_index, -1), np.where(seen[..., None], weight, 0), depth


@exercise("10.3")
def test_a_square_of_two_faces(impl):
    """Rows are upside down, counted from the top. Pixels are sampled at their corners, not at their
    centres j + 1/2. Rows and columns are swapped. covers is not asked. depth is not written, or is
    not infinite where no face is seen.
    """
    square = np.array([[1.0, 1.0], [4.0, 1.0], [4.0, 3.0], [1.0, 3.0]])
    corners = corners_of_screen(square[[[0, 1, 2], [0, 2, 3]]], [[2.0, 2.0, 2.0]], 6, 4)
    face_index, weight, depth = maps(impl.rasterize(corners, 6, 4))
    expected = np.full((4, 6), -1)  # the diagonal rises by 2 / 3
    expected[1, 1:4], expected[2, 1:4] = [1, 0, 0], [1, 1, 0]
    assert_picture(face_index, expected)
    assert_picture(depth, np.where(expected >= 0, 2.0, np.inf), atol=1e-9)
    assert_picture(weight.sum(-1), (expected >= 0) * 1.0, atol=1e-9)


@exercise("10.3", fine_print=True)
def test_the_border_belongs_to_the_face_and_the_first_of_equals_is_seen(impl):
    """Of two equally deep faces the last is seen, by <= for < in the depth test. Or a centre on an
    edge is in one face alone, as by the top-left rule.
    """
    square = np.array([[0.5, 0.5], [3.5, 0.5], [3.5, 3.5], [0.5, 3.5]])
    two = corners_of_screen(square[[[0, 1, 2], [0, 2, 3]]], [[2.0, 2.0, 2.0]], 8, 4)
    lower = np.pad(np.array([[0, 0, 0, 0], [1, 0, 0, 0], [1, 1, 0, 0], [1, 1, 1, 0]]),
                   ((0, 0), (0, 4)), constant_values=-1)
    assert_picture(maps(impl.rasterize(two, 8, 4))[0], lower)
    upper = np.pad(np.array([[0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1], [0, 0, 0, 0]]),
                   ((0, 0), (0, 4)), constant_values=-1)
    assert_picture(maps(impl.rasterize(two[::-1], 8, 4))[0], upper)


@exercise("10.3")
def test_the_nearer_face_is_seen_and_back_faces_are_not(impl):
    """The farthest face is seen: depths are compared the other way. The last face is seen: there is
    no depth test. A back face, clockwise, is drawn and hides what is behind it.
    """
    large = np.array([[-9.0, -9.0], [30.0, -9.0], [-9.0, 30.0]])
    corners = corners_of_screen(np.stack([large, large, large[::-1], large]),
                                np.array([[4.0], [3.0], [1.0], [5.0]]) * np.ones(3), 5, 3)
    face_index, _, depth = maps(impl.rasterize(corners, 5, 3))
    assert_picture(face_index, np.full((3, 5), 1))
    assert_picture(depth, np.full((3, 5), 3.0), atol=1e-9)


@exercise("10.3")
@pytest.mark.parametrize("near, far, expected", [
    (0.1, 100.0, 0), (1.9, 100.0, 0), (2.1, 100.0, 1), (2.1, 3.9, -1), (2.1, 4.1, 1),
    (4.1, 9.0, -1)])
def test_only_depths_between_near_and_far_are_seen(impl, near, far, expected):
    """near and far are swapped or not used. Or a face that is too near hides what is behind it."""
    z = np.array([[2.0], [4.0]]) * np.ones(3)
    corners = corners_of_screen(np.stack([LARGE, LARGE]), z, 4, 2)
    face_index, _, depth = maps(impl.rasterize(corners, 4, 2, near, far))
    assert_picture(face_index, np.full((2, 4), expected))
    assert_picture(depth, np.full((2, 4), {0: 2.0, 1: 4.0, -1: np.inf}[expected]), atol=1e-9)


@exercise("10.3")
def test_near_and_far_cut_a_face_where_its_pixels_are(impl):
    """near and far are asked of a face: of its nearest or farthest corner, or of their mean."""
    corners = corners_of_screen(LARGE[None], np.array([[1.0, 9.0, 3.0]]), 9, 7)
    expected = maps_by_search(corners, 9, 7, 2.0, 3.0)
    assert 9 < (expected[0] >= 0).sum() < 54
    found = maps(impl.rasterize(corners, 9, 7, 2.0, 3.0))
    assert_picture(found[0], expected[0])
    assert_picture(found[2], expected[2], atol=1e-9)


@exercise("10.3")
def test_the_maps_are_those_of_a_search(impl, rng):
    """Output 2, weight, stays that of a hidden face. depth is a mean of z. Faces behind the camera,
    with a z below 0, are drawn. face_index counts the drawn faces alone.
    """
    screen, z = random_triangles(rng, 9), rng.uniform(1, 3, (9, 3))
    screen[::3] = screen[::3, ::-1]
    z[4, 1] = -1.0
    corners = corners_of_screen(screen, z, 9, 7)
    face_index, weight, depth = maps_by_search(corners, 9, 7, 0.1, 100.0)
    got = maps(impl.rasterize(corners, 9, 7))
    assert_picture(got[0], face_index)
    assert_picture(got[1], weight, atol=1e-9)
    assert_picture(got[2], depth, atol=1e-9)


@exercise("10.3")
def test_without_a_face_the_maps_are_empty(impl):
    """No face at all is an error. Or where no face is seen, depth is 0, not inf, or face_index is
    0, not -1.
    """
    face_index, weight, depth = maps(impl.rasterize(np.zeros((0, 3, 3)), 3, 2))
    assert_equal(face_index, np.full((2, 3), -1))
    assert_equal(weight, np.zeros((2, 3, 3)))
    assert_equal(depth, np.full((2, 3), np.inf))
