"""What the exercises of lab 10 must do."""
import itertools

import numpy as np
import pytest

from course.checks import assert_close, assert_equal, assert_picture, exercise
from course.given.gradcheck import gradcheck

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


# --- faces -------------------------------------------------------------------------------------

@exercise("10.1")
def test_a_counterclockwise_face_is_drawn(impl):
    """Clockwise faces are drawn instead, or x and y are swapped."""
    z = np.ones((2, 3))
    assert_equal(impl.front_faces(np.stack([SLANTED, SLANTED[::-1]]), z), np.array([True, False]))
    assert_equal(impl.front_faces(np.stack([SLANTED[::-1], SLANTED]), z), np.array([False, True]))


@exercise("10.1")
@pytest.mark.parametrize("turn", [0, 1, 2])
def test_it_does_not_matter_with_which_corner_a_face_begins(impl, turn):
    """Only one corner's angle is looked at, or one z."""
    z = np.array([[1.0, 2.0, 3.0], [1.0, 2.0, -0.5], [1.0, 2.0, 0.0], [-1.0, -2.0, -3.0]])
    screen = np.repeat(np.roll(SLANTED, turn, 0)[None], 4, 0)
    assert_equal(impl.front_faces(screen, np.roll(z, turn, 1)),
                 np.array([True, False, False, False]))


@exercise("10.1")
def test_a_face_without_area_is_not_drawn(impl):
    """As in the original, where >= lets it pass and its inverse divides by 0."""
    line = np.array([[0.0, 0.0], [2.0, 4.0], [1.0, 2.0]])
    point = np.full((3, 2), 5.0)
    assert_equal(impl.front_faces(np.stack([line, point]), np.ones((2, 3))), np.zeros(2, bool))


@exercise("10.1")
def test_many_faces_are_told_by_their_turn(impl, rng):
    """Coordinates of different faces are mixed, or a small face is taken for one without area."""
    screen = random_triangles(rng, 9)
    screen[4:] *= 1e-3
    flipped = rng.random(9) < 0.5
    screen[flipped] = screen[flipped][:, ::-1]
    assert_equal(impl.front_faces(screen, np.ones((9, 3))), ~flipped)


@exercise("10.2")
def test_its_rows_are_edge_functions_over_twice_the_area(impl):
    """Rows of another corner, or a missing division by 2A."""
    expected = np.array([[-5, -4, 39], [4, -2, 0], [1, 6, -13]]) / 26
    assert_close(impl.face_inverse(SLANTED), expected)


@exercise("10.2")
def test_its_product_with_the_matrix_of_corners_is_one(impl, rng):
    """The transposed inverse, or leading axes that are mixed. The winding may be either."""
    screen = random_triangles(rng, 4, 5)
    screen[1] = screen[1, :, ::-1]
    matrix = np.swapaxes(np.concatenate([screen, np.ones((4, 5, 3, 1))], -1), -1, -2)
    identity = np.broadcast_to(np.eye(3), (4, 5, 3, 3))
    inverse = impl.face_inverse(screen)
    assert_equal(np.shape(inverse), (4, 5, 3, 3))
    assert_close(inverse @ matrix, identity, atol=1e-11)


# --- pixels ------------------------------------------------------------------------------------

@exercise("10.3")
def test_in_the_middle_all_weights_are_a_third(impl):
    """Depth as the mean of z: its reciprocal is."""
    x, y = SLANTED.mean(0)
    weight, depth = impl.weights_and_depth(inverse_of(SLANTED), np.array([1.0, 2.0, 2.0]), x, y)
    assert_close(weight, np.full(3, 1 / 3))
    assert_close(depth, 1.5)


@exercise("10.3")
def test_a_corner_has_its_own_depth(impl):
    """Weights or z of another corner."""
    z = np.array([2.0, 3.0, 5.0])
    weight, depth = impl.weights_and_depth(np.stack([inverse_of(SLANTED)] * 3), np.stack([z] * 3),
                                           *SLANTED.T)
    assert_close(weight, np.eye(3), atol=1e-9)
    assert_close(depth, z)


@exercise("10.3")
def test_depth_is_that_of_the_plane_in_space(impl, rng):
    """Depth that is interpolated on screen as it is. Points in space: (x z, y z, z)."""
    screen, z = random_triangles(rng, 2, 7), rng.uniform(1, 4, (2, 7, 3))
    b = rng.dirichlet(np.ones(3), (2, 7))
    ones = np.ones((2, 7, 3, 1))
    points = (np.concatenate([screen, ones], -1) * (z * b)[..., None]).sum(-2)
    x, y = points[..., 0] / points[..., 2], points[..., 1] / points[..., 2]
    weight, depth = impl.weights_and_depth(inverse_of(screen), z, x, y)
    assert_close(depth, points[..., 2], rtol=1e-8)
    assert_close(weight * depth[..., None] / z, b, atol=1e-8)


@exercise("10.3")
def test_outside_weights_are_clamped_then_divided_by_their_sum(impl):
    """Only clamped below, only one of the two steps, or the other order."""
    inverse = inverse_of(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
    z = np.array([1.0, 2.0, 4.0])
    weight, depth = impl.weights_and_depth(np.stack([inverse] * 2), np.stack([z] * 2),
                                           np.array([1.5, -0.5]), np.array([-0.75, 0.25]))
    assert_close(weight, np.array([[0.2, 0.8, 0.0], [0.8, 0.0, 0.2]]))
    assert_close(depth, np.array([1 / 0.6, 1 / 0.85]))


def weights_and_depth(inverse, z, x, y):
    c = np.einsum("...kl,...l->...k", inverse, np.stack([x, y, np.ones_like(x)], -1))
    weight = np.clip(c, 0, 1)
    weight = weight / weight.sum(-1, keepdims=True)
    return weight, 1 / (weight / z).sum(-1)


@exercise("10.4")
def test_depth_alone_has_a_gradient_by_z(impl):
    """w / z^2 without depth^2, or its sign."""
    inverse = inverse_of(np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]]))
    z, one = np.array([1.0, 1.0, 4.0]), np.array(1.0)
    _, grad_z = impl.weights_and_depth_backward(np.zeros(3), np.array(1.0), inverse, z, one, one)
    assert_close(grad_z, np.array([16, 16, 2]) / 25)


@exercise("10.4")
def test_the_sum_of_the_weights_cannot_change(impl):
    """The normalisation is left out of the gradient."""
    inverse, one = inverse_of(SLANTED), np.array(3.0)
    got = impl.weights_and_depth_backward(np.full(3, 7.0), np.array(0.0), inverse,
                                          np.array([1.0, 2.0, 3.0]), one, one)
    assert_close(got, (np.zeros((3, 3)), np.zeros(3)), atol=1e-12)


@exercise("10.4")
@pytest.mark.parametrize("reach", [0.9, 3.0])
def test_gradients_of_weights_and_depth_are_central_differences(impl, rng, reach):
    """A term is lost: clamp, sum, depth's way through the weights; (x, y, 1) in another order."""
    screen, z = random_triangles(rng, 2, 5), rng.uniform(1, 4, (2, 5, 3))
    b = rng.dirichlet(np.ones(3), (2, 5)) * reach + (1 - reach) / 3
    x, y = np.moveaxis((screen * b[..., None]).sum(-2), -1, 0)

    def clamped(inverse, z):
        c = np.einsum("...kl,...l->...k", inverse, np.stack([x, y, np.ones_like(x)], -1))
        return (c < 0) + 2 * (c > 1)

    gradcheck(lambda inverse, z: weights_and_depth(inverse, z, x, y),
              lambda grad_weight, grad_depth, inverse, z: impl.weights_and_depth_backward(
                  grad_weight, grad_depth, inverse, z, x, y),
              (inverse_of(screen), z), decisions=clamped, name="weights and depth")


@exercise("10.4")
def test_only_what_the_clamp_changes_has_no_gradient(impl):
    """c = 0 or c = 1 exactly counts as clamped, or c outside of [0, 1] does not."""
    inverse = inverse_of(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])).round()
    z, grad_weight = np.ones(3), np.array([1.0, 10.0, 100.0])
    corner = impl.weights_and_depth_backward(grad_weight, np.array(0.0), inverse, z, np.array(0.0),
                                             np.array(0.0))
    assert_close(corner[0][:, 2], np.array([0.0, 9.0, 99.0]))
    outside = impl.weights_and_depth_backward(grad_weight, np.array(0.0), inverse, z,
                                              np.array(-0.5), np.array(0.25))
    # c = 1.25, -0.5, 0.25 -> u = 1, 0, 0.25: w = 0.8, 0, 0.2, and grad . w = 20.8
    assert_close(outside[0][:, 2], np.array([0.0, 0.0, 79.2 / 1.25]))
    beside = impl.weights_and_depth_backward(grad_weight, np.array(0.0), inverse, z,
                                             np.array(0.5), np.array(-0.5))
    # c = 1, 0.5, -0.5: w = 2 / 3, 1 / 3, 0, and grad . w = 4
    assert_close(beside[0][:, 2], np.array([-3.0, 6.0, 0.0]) / 1.5)


def corners_of_screen(screen, z, width, height):
    """Corners in ndc of faces at screen (F, 3, 2), z (F, 3)."""
    z = np.broadcast_to(np.asarray(z, float), screen.shape[:-1])
    return np.concatenate([screen / [width / 2, height / 2] - 1, z[..., None]], -1)


def maps_by_search(corners, width, height, near, far):
    """Each pixel asks each face, with NumPy's inverse."""
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen = (corners[..., :2] + 1) * [width / 2, height / 2]
    areas = [np.linalg.det(np.column_stack([face, np.ones(3)])) for face in screen]
    for i, j in np.ndindex(height, width):
        for f in range(len(corners)):
            if areas[f] <= 0 or corners[f, :, 2].min() < 0:
                continue
            c = inverse_of(screen[f]) @ [j + 0.5, i + 0.5, 1]
            d = 1 / (c / corners[f, :, 2]).sum() if (c >= 0).all() else np.inf
            if near < d < far and d < depth[i, j]:
                face_index[i, j], weight[i, j], depth[i, j] = f, c, d
    return face_index, weight, depth


@exercise("10.5")
def test_a_square_of_two_faces(impl):
    """Rows upside down, centres at whole numbers, or columns for rows."""
    square = np.array([[1.0, 1.0], [4.0, 1.0], [4.0, 3.0], [1.0, 3.0]])
    corners = corners_of_screen(square[[[0, 1, 2], [0, 2, 3]]], [[2.0, 2.0, 2.0]], 6, 4)
    face_index, weight, depth = impl.rasterize_loop(corners, 6, 4)
    expected = np.full((4, 6), -1)  # the diagonal rises by 2 / 3
    expected[1, 1:4], expected[2, 1:4] = [1, 0, 0], [1, 1, 0]
    assert_picture(face_index, expected)
    assert_picture(depth, np.where(expected >= 0, 2.0, np.inf), atol=1e-9)
    assert_picture(weight.sum(-1), (expected >= 0) * 1.0, atol=1e-9)


@exercise("10.5")
def test_the_border_belongs_to_the_face_and_the_first_of_equals_is_seen(impl):
    """The top-left rule: here a centre on an edge is in both faces, and the z-buffer decides."""
    square = np.array([[0.5, 0.5], [3.5, 0.5], [3.5, 3.5], [0.5, 3.5]])
    two = corners_of_screen(square[[[0, 1, 2], [0, 2, 3]]], [[2.0, 2.0, 2.0]], 8, 4)
    lower = np.pad(np.array([[0, 0, 0, 0], [1, 0, 0, 0], [1, 1, 0, 0], [1, 1, 1, 0]]),
                   ((0, 0), (0, 4)), constant_values=-1)
    assert_picture(impl.rasterize_loop(two, 8, 4)[0], lower)
    upper = np.pad(np.array([[0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1], [0, 0, 0, 0]]),
                   ((0, 0), (0, 4)), constant_values=-1)
    assert_picture(impl.rasterize_loop(two[::-1], 8, 4)[0], upper)


@exercise("10.5")
def test_the_nearer_face_is_seen_and_back_faces_are_not(impl):
    """The farthest or the last face is seen, or a back face hides what is behind it."""
    large = np.array([[-9.0, -9.0], [30.0, -9.0], [-9.0, 30.0]])
    corners = corners_of_screen(np.stack([large, large, large[::-1], large]),
                                np.array([[4.0], [3.0], [1.0], [5.0]]) * np.ones(3), 5, 3)
    face_index, _, depth = impl.rasterize_loop(corners, 5, 3)
    assert_picture(face_index, np.full((3, 5), 1))
    assert_picture(depth, np.full((3, 5), 3.0), atol=1e-9)


@exercise("10.5")
@pytest.mark.parametrize("near, far, expected", [
    (0.1, 100.0, 0), (1.9, 100.0, 0), (2.0, 100.0, 1), (2.1, 100.0, 1), (2.1, 4.0, -1),
    (2.1, 4.1, 1), (4.0, 9.0, -1)])
def test_only_depths_between_near_and_far_are_seen(impl, near, far, expected):
    """Near or far itself is seen, near and far are swapped or not used."""
    large = np.array([[-8.0, -8.0], [24.0, -8.0], [-8.0, 24.0]])
    z = np.array([[2.0], [4.0]]) * np.ones(3)
    corners = corners_of_screen(np.stack([large, large]), z, 4, 2)
    face_index, _, depth = impl.rasterize_loop(corners, 4, 2, near, far)
    assert_picture(face_index, np.full((2, 4), expected))
    assert_picture(depth, np.full((2, 4), {0: 2.0, 1: 4.0, -1: np.inf}[expected]))


@exercise("10.5")
def test_near_is_a_tenth_and_far_a_hundred_unless_given(impl):
    """Other defaults."""
    large = np.array([[-8.0, -8.0], [24.0, -8.0], [-8.0, 24.0]])
    for z, expected in (0.09999995, -1), (0.10000005, 0), (99.99999995, 0), (100.00000005, -1):
        face_index, _, _ = impl.rasterize_loop(corners_of_screen(large[None], z, 4, 2), 4, 2)
        assert_picture(face_index, np.full((2, 4), expected))


@exercise("10.5")
def test_the_maps_are_those_of_a_search(impl, rng):
    """Weights that stay behind from a hidden face, faces cut by the picture's border."""
    screen, z = random_triangles(rng, 9), rng.uniform(1, 3, (9, 3))
    screen[::3] = screen[::3, ::-1]
    z[4, 1] = -1.0
    corners = corners_of_screen(screen, z, 9, 7)
    face_index, weight, depth = maps_by_search(corners, 9, 7, 0.1, 100.0)
    got = impl.rasterize_loop(corners, 9, 7)
    assert_picture(got[0], face_index)
    assert_picture(got[1], weight, atol=1e-9)
    assert_picture(got[2], depth, atol=1e-9)


@exercise("10.5")
def test_without_a_face_the_maps_are_empty(impl):
    """No face is an error, or no depth is 0."""
    face_index, weight, depth = impl.rasterize_loop(np.zeros((0, 3, 3)), 3, 2)
    assert_equal(face_index, np.full((2, 3), -1))
    assert_equal(weight, np.zeros((2, 3, 3)))
    assert_equal(depth, np.full((2, 3), np.inf))


# --- texture cubes -----------------------------------------------------------------------------

def some_pixels(rng, count):
    """weight, depth, z of count pixels."""
    weight, z = rng.dirichlet(np.ones(3), count), rng.uniform(1, 4, (count, 3))
    return weight, 1 / (weight / z).sum(1), z


def place(weight, depth, z, size):
    return (size - 1) * weight * depth[:, None] / z


@exercise("10.6")
def test_a_third_of_the_way_along_each_axis(impl):
    """Another texel first, or the weight of the upper one for the lower one."""
    index, tap = impl.cube_taps(np.array([[0.5, 0.25, 0.25]]), np.array([1.0]), np.ones((1, 3)), 2)
    assert_equal(index, np.array([[0, 4, 2, 6, 1, 5, 3, 7]]))
    assert_close(tap, np.array([[9, 9, 3, 3, 3, 3, 1, 1]]) / 32)


@exercise("10.6")
def test_a_corner_reads_its_own_texel(impl):
    """A texel beyond the cube's end, where the original stays 1e-4 away from it."""
    index, tap = impl.cube_taps(np.eye(3), np.array([2.0, 3.0, 5.0]),
                                np.array([[2.0, 3.0, 5.0]] * 3), 4)
    assert_equal(bool((index >= 0).all() and (index < 64).all()), True)
    assert_close((tap * (index == np.array([[48], [12], [3]]))).sum(1), np.ones(3))


@exercise("10.6")
@pytest.mark.parametrize("size", [2, 3, 6])
def test_eight_taps_give_back_the_place(impl, rng, size):
    """z / z_k is left out: a texture in perspective that bends; or T for T - 1."""
    weight, depth, z = some_pixels(rng, 40)
    index, tap = impl.cube_taps(weight, depth, z, size)
    texel = np.stack(np.unravel_index(index, (size,) * 3), -1)
    assert_close((tap[..., None] * texel).sum(1), place(weight, depth, z, size), atol=1e-9)
    assert_close(tap.sum(1), np.ones(40))
    assert_equal(bool((tap > -1e-12).all()), True)
    corners = np.ptp(texel, axis=1)
    assert_equal(corners, np.ones((40, 3), int))


@exercise("10.6")
def test_rounding_does_not_lead_out_of_the_cube(impl):
    """A depth that is rounded up gives t = T - 1 + 1e-16."""
    weight = np.array([[1.0, 0.0, 0.0], [0.0, 0.5, 0.5]])
    index, tap = impl.cube_taps(weight, np.array([1 + 1e-15, 1.0]), np.ones((2, 3)), 3)
    assert_equal(bool((index >= 0).all() and (index < 27).all()), True)
    assert_close((tap * (index == 18)).sum(1), np.array([1.0, 0.0]))
    assert_equal(bool(((tap >= 0) & (tap <= 1)).all()), True)


def taps(weight, depth, z, size):
    """(N, 8) weights as products, tap by tap."""
    t = place(weight, depth, z, size)
    part = t - np.minimum(np.floor(t), size - 2)
    return np.stack([np.prod([part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)], 0)
                     for n in range(8)], 1)


@exercise("10.7")
def test_a_sum_of_all_taps_cannot_change(impl, rng):
    """The sign of the lower texels."""
    weight, depth, z = some_pixels(rng, 6)
    got = impl.cube_taps_backward(np.ones((6, 8)), weight, depth, z, 4)
    assert_close(got, (np.zeros((6, 3)), np.zeros(6), np.zeros((6, 3))), atol=1e-12)


@exercise("10.7")
@pytest.mark.parametrize("size", [2, 5])
def test_gradients_of_the_taps_are_central_differences(impl, rng, size):
    """The factor T - 1, depth / z, the sign by z, or two axes swapped."""
    pixels = some_pixels(rng, 8)
    gradcheck(lambda *pixels: taps(*pixels, size),
              lambda grad, *pixels: impl.cube_taps_backward(grad, *pixels, size), pixels,
              decisions=lambda *pixels: np.floor(place(*pixels, size)), name="taps")


@exercise("10.7")
def test_at_a_corner_the_last_cell_counts(impl):
    """At t = T - 1 the derivative of the cell beyond, which is not there."""
    grad_tap = np.zeros((1, 8))
    grad_tap[0, [0, 1]] = -3.0, 5.0
    got = impl.cube_taps_backward(grad_tap, np.array([[1.0, 0.0, 0.0]]), np.array([2.0]),
                                  np.array([[2.0, 1.0, 4.0]]), 3)
    grad_weight, grad_z = np.array([[16.0, -20.0, -5.0]]), np.array([[-8.0, 0.0, 0.0]])
    assert_close(got, (grad_weight, np.array([8.0]), grad_z))


@exercise("10.8")
def test_a_pixel_mixes_texels_of_its_own_face(impl):
    """Texels of another face, or the mean instead of the weighted sum."""
    textures = np.arange(48.0).reshape(3, 2, 2, 2, 2)
    index, tap = np.array([[7, 0, 0, 0, 0, 0, 0, 3]]), np.array([[0.5, 0, 0, 0, 0, 0, 0, 0.25]])
    assert_close(impl.sample_cubes(textures, np.array([2]), index, tap), np.array([[32.5, 33.25]]))


@exercise("10.8")
def test_samples_are_those_of_a_loop(impl, rng):
    """The cube's axes in another order, or channels mixed."""
    textures, face = rng.random((5, 3, 3, 3, 2)), rng.integers(0, 5, 7)
    index, tap = rng.integers(0, 27, (7, 8)), rng.random((7, 8))
    expected = np.zeros((7, 2))
    for n, m in itertools.product(range(7), range(8)):
        i, j, k = np.unravel_index(index[n, m], (3, 3, 3))
        expected[n] += tap[n, m] * textures[face[n], i, j, k]
    assert_close(impl.sample_cubes(textures, face, index, tap), expected)


def samples(textures, face, index, tap):
    texels = textures.reshape(len(textures), -1, textures.shape[-1])
    return np.einsum("nm,nmc->nc", tap, texels[face[:, None], index])


@exercise("10.9")
def test_pixels_that_read_one_texel_add_up(impl):
    """The last write wins; a texel that is read twice by a pixel counts once."""
    textures, face = np.zeros((2, 2, 2, 2, 1)), np.array([1, 1, 0])
    index, tap = np.zeros((3, 8), int), np.full((3, 8), 0.125)
    index[2] = 5
    grad_textures, grad_tap = impl.sample_cubes_backward(np.array([[2.0], [3.0], [7.0]]), textures,
                                                         face, index, tap)
    expected = np.zeros((2, 2, 2, 2, 1))
    expected[1, 0, 0, 0], expected[0, 1, 0, 1] = 5.0, 7.0
    assert_close(grad_textures, expected)
    assert_close(grad_tap, np.zeros((3, 8)))


@exercise("10.9")
def test_gradients_of_samples_are_central_differences(impl, rng):
    """Gradients to another face or channel, or grad_tap of one channel alone."""
    textures, face = rng.normal(size=(4, 3, 3, 3, 2)), rng.integers(0, 4, 9)
    index, tap = rng.integers(0, 27, (9, 8)), rng.random((9, 8))
    gradcheck(lambda textures, tap: samples(textures, face, index, tap),
              lambda grad, textures, tap: impl.sample_cubes_backward(grad, textures, face, index,
                                                                     tap),
              (textures, tap), name="cubes")


# --- light -------------------------------------------------------------------------------------

LYING = np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [2.0, 0.0, 0.0]]])  # looks up, n = (0, 1, 0)
RED, BLUE = np.array([1.0, 0.0, 0.25]), np.array([0.0, 2.0, 1.0])


@exercise("10.10")
def test_light_from_above_shines_on_what_looks_up(impl):
    """The original's order of the cross product, for its left-handed space: the other side."""
    both = np.concatenate([LYING, LYING[:, ::-1]])
    got = impl.face_light(both, RED, BLUE, np.array([0.0, 1.0, 0.0]))
    assert_close(got, np.array([[1.0, 2.0, 1.25], [1.0, 0.0, 0.25]]))


@exercise("10.10")
def test_light_falls_off_with_the_cosine(impl):
    """A normal of another length, or a direction that is made a unit vector."""
    got = impl.face_light(5 * LYING, RED, BLUE, np.array([0.0, 0.5, -7.0]))
    assert_close(got, np.array([[1.0, 1.0, 0.75]]))


@exercise("10.10")
def test_lights_of_many_faces(impl, rng):
    """Normals of neighbouring faces are mixed. Its angle by vectors."""
    corners, towards = rng.normal(size=(6, 3, 3)), rng.normal(size=3)
    expected = []
    for a, b, c in corners:
        e, f = b - a, c - a
        n = np.array([e[i] * f[j] - e[j] * f[i] for i, j in ((1, 2), (2, 0), (0, 1))])
        expected.append(RED + max((n @ towards) / np.sqrt(n @ n), 0) * BLUE)
    assert_close(impl.face_light(corners, RED, BLUE, towards), np.array(expected))


@exercise("10.10")
def test_a_face_without_area_has_ambient_light_alone(impl):
    """0 / 0."""
    got = impl.face_light(np.ones((2, 3, 3)), RED, BLUE, np.array([1.0, 1.0, 1.0]))
    assert_close(got, np.stack([RED, RED]))


def light(corners, ambient, directional, towards):
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    normal = normal / np.sqrt((normal**2).sum(1, keepdims=True))
    return ambient + np.maximum((normal * towards).sum(1), 0)[:, None] * directional


@exercise("10.11")
def test_the_gradient_of_the_colours_is_a_sum_over_faces(impl):
    """The mean, or the directional light without its cosine."""
    corners = np.concatenate([LYING, 2 * LYING, LYING[:, ::-1]])
    grad_light = np.array([[1.0, 2.0], [10.0, 20.0], [100.0, 200.0]])
    _, *got = impl.face_light_backward(grad_light, corners, np.ones(2), np.array([3.0, 4.0]),
                                       np.array([0.0, 0.5, 0.0]))
    assert_close(tuple(got), (np.array([111.0, 222.0]), np.array([5.5, 11.0]),
                              np.array([0.0, 121.0, 0.0])))


@exercise("10.11")
def test_gradients_of_light_are_central_differences(impl, rng):
    """The part along the normal, the length of N, or the order of a cross product."""
    inputs = (rng.normal(size=(9, 3, 3)), *rng.random((2, 2)), rng.normal(size=3))

    def lit(corners, ambient, directional, towards):
        return light(corners, 0 * ambient, 1 + 0 * directional, towards) > 0

    gradcheck(light, impl.face_light_backward, inputs, decisions=lit, name="light")


@exercise("10.11")
def test_what_looks_away_is_constant(impl):
    """Light from below has a gradient on what looks up, or grazing light, n . l = 0, has one."""
    for towards in ([1.0, -1.0, 0.0], [1.0, 0.0, 0.0]):
        got = impl.face_light_backward(np.ones((1, 3)), LYING, RED, BLUE, np.array(towards))
        assert_close(got, (np.zeros((1, 3, 3)), np.ones(3), np.zeros(3), np.zeros(3)))


@exercise("10.11")
def test_a_face_without_area_has_no_gradient(impl):
    """NaN for one face, which the sum over vertices spreads."""
    corners = np.concatenate([np.ones((1, 3, 3)), LYING])
    got = impl.face_light_backward(np.ones((2, 3)), corners, RED, BLUE, np.array([0.0, 2.0, 0.0]))
    towards = np.array([0.0, BLUE.sum(), 0.0])
    assert_close(got, (np.zeros((2, 3, 3)), np.full(3, 2.0), np.full(3, 2.0), towards))


# --- the sweep ---------------------------------------------------------------------------------

@exercise("10.12")
def test_an_edge_crosses_the_rows_between_its_ends(impl):
    """Rows counted at their lower border, or shares exchanged."""
    row, crossing, share = impl.edge_lines(np.array([2.0, 0.5]), np.array([10.0, 4.5]), 9)
    assert_equal(row, np.arange(5))
    assert_close(crossing, np.array([2.0, 4.0, 6.0, 8.0, 10.0]))
    assert_close(share, np.array([[4, 0], [3, 1], [2, 2], [1, 3], [0, 4]]) / 4)


@exercise("10.12")
@pytest.mark.parametrize("height", [3, 8])
def test_lines_are_those_of_a_search(impl, rng, height):
    """An edge that goes down, or rows outside of the picture."""
    for a, b in rng.uniform(-3, 9, (12, 2, 2)):
        rows = [i for i in range(height) if (i + 0.5 - a[1]) * (i + 0.5 - b[1]) < 0]
        row, crossing, share = impl.edge_lines(a, b, height)
        assert_equal(row, np.array(rows, int))
        t = (np.array(rows) + 0.5 - a[1]) / (b[1] - a[1])
        assert_close(crossing, (1 - t) * a[0] + t * b[0])
        assert_close(share, np.stack([1 - t, t], -1))


@exercise("10.12")
def test_a_row_counts_if_its_centre_is_between_the_ends(impl):
    """A centre just beyond an end is crossed, or one just before it is not."""
    for beyond, rows in ((1e-8, [1]), (-1e-8, [0, 1, 2])):
        low, high = np.array([4.0, 0.5 + beyond]), np.array([7.0, 2.5 - beyond])
        assert_equal(impl.edge_lines(low, high, 4)[0], np.array(rows))
        assert_equal(impl.edge_lines(high, low, 4)[0], np.array(rows))


@exercise("10.12")
def test_an_edge_along_a_row_crosses_none(impl):
    """0 / 0, or a whole row."""
    for y in 2.0, 2.5:
        row, crossing, share = impl.edge_lines(np.array([1.0, y]), np.array([6.0, y]), 5)
        assert_equal(row, np.zeros(0, int))
        assert_equal((np.shape(crossing), np.shape(share)), ((0,), (0, 2)))


def line(width, first, last, colour=1.0):
    """A row: colour 1 from pixel first to last, which see the face; (W, 1), bool (W,)."""
    sees = (np.arange(width) >= first) & (np.arange(width) <= last)
    return sees[:, None] * colour, sees


def asking(width, pixel, gradient):
    grad_colour = np.zeros((width, 1))
    grad_colour[pixel, 0] = gradient
    return grad_colour


HALF = np.array([0.5, 0.5])


@exercise("10.13")
def test_a_pixel_outside_pulls_the_edge_out(impl):
    """The original's own example, outside: row 38 of 64 x 64, pixel 35, the edge at 45.846."""
    # Its edge runs from (57.6, 57.6) to (32, 16): at y = 38.5 it is 22.5 / 41.6 of the way up.
    colour, sees = line(64, 46, 47)
    up = 22.5 / 41.6
    crossing, share = 32 + up * 25.6, np.array([up, 1 - up])
    got = impl.sweep_line(asking(64, 35, -1.0), colour, sees, crossing, -1, share)
    assert_close(got, np.array([1.67258, 1.41987]), rtol=1e-5)


@exercise("10.13")
def test_a_pixel_inside_pulls_the_edge_in(impl):
    """The original's own example, inside: row 23 of 64 x 64, pixel 50, edges at 29.894, 57.6."""
    # From (57.6, 57.6) to (16, 6.4), and from (57.6, 6.4) to (57.6, 57.6); 17.1 / 51.2 of the way.
    colour, sees = line(64, 30, 57)
    grad_colour, up = asking(64, 50, 1.0), 17.1 / 51.2
    left = impl.sweep_line(grad_colour, colour, sees, 16 + up * 41.6, -1, np.array([up, 1 - up]))
    assert_close(left, np.array([-0.51863, -1.03417]), rtol=1e-5)
    right = impl.sweep_line(grad_colour, colour, sees, 57.6, 1, np.array([1 - up, up]))
    assert_close(right, np.array([3.00086, 1.50506]), rtol=1e-5)
    assert_close(right, 1 / (7.1 / 32 / np.array([1 - up, up]) + 1e-4))


@exercise("10.13")
def test_only_a_change_that_lowers_the_loss_counts(impl):
    """The sign of the loss's gradient makes no difference."""
    colour, sees = line(9, 2, 5)
    for pixel, gradient in (7, 1.0), (4, -1.0), (0, 1.0):
        got = impl.sweep_line(asking(9, pixel, gradient), colour, sees, 6.2, 1, HALF)
        assert_close(got, np.zeros(2))


@exercise("10.13")
def test_distances_are_measured_from_the_crossing(impl):
    """From the inner or outer pixel, a pixel's border, or in pixels instead of ndc."""
    colour, sees = line(8, 0, 3)
    grad_colour = asking(8, [2, 6], [1.0, -1.0])
    # d = (2.5 - 4.1) / 2 and (6.5 - 4.1) / 2, with 2 / 8 ndc to a pixel and share 1/2
    got = impl.sweep_line(grad_colour, colour, sees, 4.1, 1, HALF, 0.0)
    assert_close(got, np.full(2, 1 / 0.8 - 1 / 1.2))


@exercise("10.13")
def test_epsilon_makes_the_way_longer(impl):
    """eps is taken away on one side, or is in pixels, or scaled by the share."""
    colour, sees = line(8, 0, 3)
    out = impl.sweep_line(asking(8, 6, -1.0), colour, sees, 4.1, 1, HALF, 0.3)
    assert_close(out, np.full(2, -1 / 1.5))
    within = impl.sweep_line(asking(8, 2, 1.0), colour, sees, 4.1, 1, HALF, 0.3)
    assert_close(within, np.full(2, 1 / 1.1))
    left = impl.sweep_line(asking(8, 1, -1.0), colour[::-1], sees[::-1], 3.9, -1, HALF, 0.3)
    assert_close(left, np.full(2, 1 / 1.5))


@exercise("10.13")
@pytest.mark.parametrize("side", [1, -1])
def test_a_pixel_on_the_edge_is_inside_and_pulls_it_in(impl, side):
    """The original's sign: its eps is negative at distance 0, whichever side is outside."""
    colour, sees = line(9, 4, 4)
    got = impl.sweep_line(asking(9, 4, 1.0), colour, sees, 4.5, side, np.array([1.0, 0.0]), 0.01)
    assert_close(got, np.array([side * 100.0, 0.0]))


@exercise("10.13")
def test_a_hidden_edge_does_not_move_out(impl):
    """The inner pixel's face is not asked for."""
    colour, sees = line(9, 2, 4)
    got = impl.sweep_line(asking(9, 8, -1.0), colour, sees, 6.2, 1, HALF, 0.0)  # inner is 5
    assert_close(got, np.zeros(2))
    got = impl.sweep_line(asking(9, 3, 1.0), colour, sees, 6.2, 1, HALF, 0.0)   # but it moves in
    assert_close(got, np.full(2, 9 / 4 / 2.7))


@exercise("10.13")
def test_on_the_way_in_only_the_face_itself_counts(impl):
    """Pixels of other faces behind the edge pull, too; on the way out all pixels do."""
    colour, sees = line(9, 4, 5)
    other = sees | (np.arange(9) == 1)
    colour[1] = colour[8] = 1.0
    got = impl.sweep_line(asking(9, 1, 1.0), colour, sees, 6.0, 1, HALF, 0.0)
    assert_close(got, np.zeros(2))
    got = impl.sweep_line(asking(9, 1, 1.0), colour, other, 6.0, 1, HALF, 0.0)
    assert_close(got, np.full(2, 1 / (4.5 * 4 / 9)))
    colour = 0.5 * colour + asking(9, 8, 2.0)
    got = impl.sweep_line(asking(9, 8, 1.0), colour, sees, 6.0, 1, HALF, 0.0)
    assert_close(got, np.full(2, -2 / (2.5 * 4 / 9)))


@exercise("10.13")
@pytest.mark.parametrize("crossing, side", [(9.7, 1), (0.3, -1), (-2.0, 1), (0.2, 1), (9.5, 1),
                                            (9.9, -1), (12.0, -1), (0.5, -1)])
def test_an_edge_at_the_border_of_the_picture_has_no_gradient(impl, rng, crossing, side):
    """Inner or outer outside of the picture: an index that goes round, or the last pixel twice."""
    colour, grad_colour = rng.random((10, 3)), rng.normal(size=(10, 3))
    got = impl.sweep_line(grad_colour, colour, np.ones(10, bool), crossing, side, HALF)
    assert_close(got, np.zeros(2))


@exercise("10.13")
@pytest.mark.parametrize("crossing, side", [(9.4, 1), (0.6, -1), (0.5, 1), (9.5, -1), (8.5, 1)])
def test_the_last_edge_before_the_border_has_one(impl, crossing, side):
    """A border that is one pixel too wide."""
    colour, sees = line(10, 3, 9) if side < 0 else line(10, 0, 6)
    sees[:] = True
    grad_colour = np.where(colour > 0, 1.0, -1.0)
    got = impl.sweep_line(grad_colour, colour, sees, crossing, side, HALF)
    assert_equal(bool((got != 0).all()), True)


@exercise("10.13")
def test_channels_are_added_before_the_loss_is_asked(impl):
    """max(0, ...) of each channel, or their mean."""
    colour = np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 1.0]])
    sees, grad_colour = np.arange(4) < 2, np.zeros((4, 2))
    grad_colour[3] = -3.0, 1.0
    got = impl.sweep_line(grad_colour, colour, sees, 2.0, 1, HALF, 0.0)
    assert_close(got, np.full(2, -4 / 1.5))
    grad_colour[3] = 3.0, 1.0
    assert_close(impl.sweep_line(grad_colour, colour, sees, 2.0, 1, HALF, 0.0), np.zeros(2))


@exercise("10.13")
@pytest.mark.parametrize("side", [1, -1])
def test_a_line_is_a_sum_over_its_pixels(impl, rng, side):
    """One of the two sums is lost, or a pixel is counted in both. Pixel by pixel."""
    for _ in range(5):
        colour, grad_colour = rng.random((11, 3)), rng.normal(size=(11, 3))
        sees, crossing, share = rng.random(11) < 0.7, rng.uniform(2, 9), rng.dirichlet([1, 1])
        inner = max(j for j in range(11) if j + 0.5 <= crossing) if side > 0 else min(
            j for j in range(11) if j + 0.5 >= crossing)
        expected = np.zeros(2)
        for j in range(11):
            out = (j + 0.5 - crossing) * side > 0
            change = (colour[inner if out else inner + side] - colour[j]) @ grad_colour[j]
            if change < 0 and (sees[inner] if out else sees[j]):
                way = (j + 0.5 - crossing) * 2 / 11 / share
                expected += change / (way + 1e-3 * np.sign(way))
        got = impl.sweep_line(grad_colour, colour, sees, crossing, side, share, 1e-3)
        assert_close(got, expected)
