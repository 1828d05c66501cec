"""What the exercises of lab 14 must do."""
import math

import numpy as np
import pytest

from course.checks import assert_close, assert_equal, assert_picture, exercise
from course.given.gradcheck import gradcheck

# Light from a point and from a direction; their maps are not square.
CONE = np.array([[1.5, 0, 0, 0], [0, 2.0, 0, 0], [0, 0, -1.5, -2.5], [0, 0, -1, 0]])
PARALLEL = np.array([[0.4, 0, 0, 0], [0, 0.7, 0, 0], [0, 0, -0.5, -2.0], [0, 0, 0, 1]])
each_light = pytest.mark.parametrize("light", [CONE, PARALLEL], ids=["cone", "parallel"])
WIDTH, HEIGHT = 12, 7


def rotation_of(rng):
    """A rotation (3, 3), its determinant 1."""
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return q * np.linalg.det(q)


def before_the_light(rng, count):
    """Points of the light's frame (count, 3), distances from 1 to 4."""
    return np.column_stack([rng.normal(size=(count, 2)), rng.uniform(-4, -1, count)])


def projected(q, light, width=WIDTH, height=HEIGHT):
    """By the whole matrix, point by point: x, y in texels, depth from -1 to 1."""
    clip = np.array([light @ [*point, 1.0] for point in q])
    ndc = clip[:, :3] / clip[:, 3:]
    return (ndc[:, 0] + 1) * width / 2, (ndc[:, 1] + 1) * height / 2, ndc[:, 2]


def point_at(x, y, distance, light, width, height):
    """The point of the light's frame that lies at (x, y) of the map, at this distance."""
    w = light[3, 3] - light[3, 2] * distance
    return np.array([(2 * x / width - 1) * w / light[0, 0], (2 * y / height - 1) * w / light[1, 1],
                     -distance])


# --- the light's frame and its map --------------------------------------------------------------

@exercise("14.1")
def test_a_light_looks_down_on_paper(impl):
    """The position is added, or the matrix is transposed."""
    rotation = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    got = impl.to_light(np.array([[1.0, 2.0, 3.0], [7.0, 8.0, 9.0]]), np.array([7.0, 8.0, 9.0]),
                        rotation)
    assert_close(got, np.array([[-6.0, -6.0, -6.0], [0.0, 0.0, 0.0]]))
    got = impl.to_light(np.array([[1.0, 2.0, 4.0]]), np.array([0.0, 8.0, 3.0]), rotation)
    assert_close(got, np.array([[1.0, 1.0, -6.0]]))


@exercise("14.1")
def test_the_rows_are_the_axes(impl, rng):
    """Columns are taken for the light's axes."""
    rotation, position = rotation_of(rng), rng.normal(size=3)
    got = impl.to_light(position + rotation, position, rotation)
    assert_close(got, np.eye(3))


@exercise("14.2")
def test_a_light_that_moves_pulls_all_points_on_paper(impl):
    """The position's gradient has the points' sign, or is that of one point alone."""
    rotation = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    grad_q = np.array([[1.0, 2.0, 3.0], [10.0, 0.0, 0.0]])
    got = impl.to_light_backward(grad_q, np.ones((2, 3)), np.array([5.0, 6.0, 7.0]), rotation)
    assert_close(got, (np.array([[2.0, 3.0, 1.0], [0.0, 0.0, 10.0]]),
                       np.array([-2.0, -3.0, -11.0])))


@exercise("14.2")
def test_the_gradients_of_the_frame_are_central_differences(impl, rng):
    """The rotation is not transposed."""
    rotation = rotation_of(rng)
    gradcheck(lambda points, position: (points - position) @ rotation.T,
              lambda grad, points, position: impl.to_light_backward(grad, points, position,
                                                                    rotation),
              (rng.normal(size=(5, 3)), rng.normal(size=3)), name="to_light")


@exercise("14.3")
def test_places_on_the_map_on_paper(impl):
    """Width and height are swapped, or the middle is not where the light looks."""
    q = np.array([[0.0, 0.0, -3.0], [2.0, 0.0, -3.0], [0.0, 1.5, -3.0], [0.0, -0.75, -1.5]])
    assert_close(impl.map_position(q, CONE, 12, 8),
                 (np.array([6.0, 12.0, 6.0, 6.0]), np.array([4.0, 4.0, 8.0, 0.0])))
    q = np.array([[2.5, 0.0, -3.0], [-2.5, 1 / 0.7, -9.0]])
    assert_close(impl.map_position(q, PARALLEL, 12, 8),
                 (np.array([12.0, 0.0]), np.array([4.0, 8.0])))


@exercise("14.3")
@each_light
def test_it_is_the_whole_matrix_and_the_viewport(impl, rng, light):
    """The distance divides in parallel light, too, or x and y have each other's factor."""
    q = before_the_light(rng, 9)
    assert_close(impl.map_position(q, light, WIDTH, HEIGHT), projected(q, light)[:2])


@exercise("14.3")
def test_any_perspective_has_its_w(impl, rng):
    """w is taken to be the distance, or 1: C_32 and C_33 say what it is."""
    light, q = CONE.copy(), before_the_light(rng, 5)
    light[3, 2:] = -0.5, 2.0
    assert_close(impl.map_position(q, light, WIDTH, HEIGHT), projected(q, light)[:2])


@exercise("14.4")
def test_a_point_that_comes_nearer_moves_outwards(impl):
    """The gradient by q_z is missing, or has the wrong sign."""
    q = np.array([[2.0, 0.0, -3.0], [0.0, -0.75, -3.0]])
    got = impl.map_position_backward(np.array([1.0, 0.0]), np.array([0.0, 1.0]), q, CONE, 12, 8)
    assert_close(got, np.array([[3.0, 0.0, 2.0], [0.0, 8 / 3, -2 / 3]]))
    got = impl.map_position_backward(np.array([1.0, 0.0]), np.array([0.0, 1.0]), q, PARALLEL, 10, 8)
    assert_close(got, np.array([[2.0, 0.0, 0.0], [0.0, 2.8, 0.0]]))


@exercise("14.4")
@each_light
def test_the_gradients_of_places_are_central_differences(impl, rng, light):
    """A factor of one axis in the other's gradient; C_33 is left out of w."""
    light = light + np.array([[0], [0], [0], [0.3]]) * [0, 0, 0, 1]
    gradcheck(lambda q: projected(q, light)[:2],
              lambda grad_x, grad_y, q: impl.map_position_backward(grad_x, grad_y, q, light, WIDTH,
                                                                   HEIGHT),
              (before_the_light(rng, 6),), name="map_position")


@exercise("14.5")
def test_near_and_far_on_paper(impl):
    """The near plane comes out far, or the distance is negative."""
    # CONE: -1.5 q_z - 2.5 = depth (-q_z), so at distance 1 the depth is -1, and at 5 it is 1.
    assert_close(impl.distance_of_depth(np.array([[-1.0, 1.0, 0.25]]), CONE),
                 np.array([[1.0, 5.0, 2.0]]))
    assert_close(impl.distance_of_depth(np.array([[-1.0], [1.0], [0.0]]), PARALLEL),
                 np.array([[2.0], [6.0], [4.0]]))


@exercise("14.5")
@each_light
def test_the_distance_is_what_the_matrix_made_the_depth_of(impl, rng, light):
    """One of the two lights is forgotten; a term is lost."""
    light, q = light.copy(), before_the_light(rng, 12)
    light[3, 3] += 0.25
    depth = projected(q, light)[2].reshape(3, 4)
    assert_close(impl.distance_of_depth(depth, light), -q[:, 2].reshape(3, 4))


@exercise("14.5")
@each_light
def test_where_the_light_sees_nothing_the_distance_is_infinite(impl, light):
    """NaN, -inf, a warning, or a number from the far plane."""
    with np.errstate(all="raise"):
        got = impl.distance_of_depth(np.array([[np.inf, 0.0], [np.inf, np.inf]]), light)
    assert_equal(np.isinf(got), np.array([[True, False], [True, True]]))
    assert_equal(bool((np.asarray(got) > 0).all()), True)


MAP = np.array([[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, np.inf], [9.0, 10.0, 11.0, 12.0]])


@exercise("14.6")
def test_a_texel_is_found_by_its_square(impl):
    """Rows and columns are swapped, or the place is rounded to the nearest whole number."""
    x, y = np.array([0.0, 0.99, 1.0, 3.99, 2.6]), np.array([0.0, 0.99, 2.0, 0.0, 1.7])
    assert_equal(impl.stored_distance(MAP, x, y), np.array([1.0, 1.0, 10.0, 4.0, 7.0]))


@exercise("14.6")
def test_outside_the_map_nothing_is_stored(impl):
    """A negative index reads the other side of the map; or the border belongs to the map."""
    x = np.array([-0.01, 4.0, 1.0, 1.0, -0.5, 99.0, 3.5, 4.0 - 1e-9])
    y = np.array([0.5, 1.0, -1e-9, 3.0, -0.5, 1.0, 1.5, 3.0 - 1e-9])
    expected = np.array([np.inf] * 7 + [12.0])
    assert_equal(impl.stored_distance(MAP, x, y), expected)


@exercise("14.7")
def test_what_lies_behind_is_dark(impl):
    """The comparison is turned round, as with a map of the farthest surface."""
    x, y = np.array([1.5, 1.5, 1.5]), np.array([0.5, 0.5, 0.5])
    assert_equal(impl.is_lit(MAP, x, y, np.array([1.0, 2.0, 3.0]), 0.0),
                 np.array([True, True, False]))


@exercise("14.7")
def test_the_bias_lights_what_is_just_behind(impl):
    """The bias is subtracted, or one for all; or < for <=."""
    x, y = np.full(4, 0.5), np.full(4, 1.5)
    got = impl.is_lit(MAP, x, y, np.array([5.25, 5.25, 4.9, 5.5]), np.array([0.25, 0.0, 0.5, 0.75]))
    assert_equal(got, np.array([True, False, True, True]))
    assert_equal(impl.is_lit(MAP, x, y, np.full(4, 5.5), 0.5), np.ones(4, bool))
    assert_equal(impl.is_lit(MAP, x, y, np.full(4, 4.5), -0.75), np.zeros(4, bool))


@exercise("14.7")
def test_outside_the_map_all_is_lit(impl):
    """What the light's picture does not hold is dark, or is looked up elsewhere."""
    x, y = np.array([-1.0, 9.0, 1.0, 3.5]), np.array([2.0, 1.0, -1.0, 1.5])
    assert_equal(impl.is_lit(MAP, x, y, np.full(4, 100.0), 0.0), np.ones(4, bool))


# --- bias ---------------------------------------------------------------------------------------

@exercise("14.8")
def test_slopes_on_paper(impl):
    """Texels are taken for units of the world, or x and y for each other."""
    light, q = np.diag([0.25, 0.5, -1.0, 1.0]), np.array([[3.0, -1.0, -4.0]] * 2)
    normal = np.array([[0.6, 0.0, 0.8], [0.0, -0.8, 0.6]])
    assert_close(impl.distance_slopes(normal, q, light, 4, 8),
                 (np.array([1.5, 0.0]), np.array([0.0, -2 / 3])), atol=1e-12)
    # The cone's ray is (1, -1/2, -1), n . ray = 0.6 - 0.8, and a texel there is 2 x 4 / (1/4 x 4).
    light[3, 2:] = -1, 0
    q = np.array([[4.0, -2.0, -4.0]])
    assert_close(impl.distance_slopes(normal[:1], q, light, 4, 8),
                 (np.array([24.0]), np.array([0.0])), atol=1e-12)


@exercise("14.8")
@each_light
def test_slopes_are_those_of_the_plane_on_the_map(impl, rng, light):
    """The cone's ray is taken for the light's axis, w is left out, or C_33 of it."""
    light = light + np.array([[0], [0], [0], [0.3]]) * [0, 0, 0, 1]
    q, normal = before_the_light(rng, 30), rng.normal(size=(30, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    # The plane's distance at (x, y): along the ray there, n . point = n . q.
    def distance(k, x, y):
        start = point_at(x, y, 0.0, light, WIDTH, HEIGHT)
        step = point_at(x, y, 1.0, light, WIDTH, HEIGHT) - start
        return normal[k] @ (q[k] - start) / (normal[k] @ step)

    x, y, _ = projected(q, light)
    ray = np.array([point_at(*place, 1.0, light, WIDTH, HEIGHT)
                    - point_at(*place, 0.0, light, WIDTH, HEIGHT)
                    for place in zip(x, y, strict=True)])
    seen = np.flatnonzero(np.abs((normal * ray).sum(1)) > 0.1)
    h = 1e-5
    expected = tuple(
        np.array([(distance(k, x[k] + dx, y[k] + dy) - distance(k, x[k] - dx, y[k] - dy)) / (2 * h)
                  for k in seen]) for dx, dy in ((h, 0), (0, h)))
    assert_close(impl.distance_slopes(normal[seen], q[seen], light, WIDTH, HEIGHT), expected,
                 rtol=1e-6, atol=1e-8)
    assert_close(impl.distance_slopes(-normal[seen], q[seen], light, WIDTH, HEIGHT), expected,
                 rtol=1e-6, atol=1e-8)


@exercise("14.8")
def test_a_plane_seen_edge_on_keeps_a_finite_slope(impl):
    """An infinite slope, or the wrong side of it; the limit is GRAZING = 0.01, no sooner."""
    light, facing = np.diag([1.0, 0.5, -1.0, 1.0]), np.array([0.0, 0.004, -0.004, 0.011, -0.0099])
    # n . ray = -n_z = facing
    normal = np.stack([np.full(5, 0.8), np.full(5, -0.6), -facing], 1)
    limited = np.array([0.01, 0.01, -0.01, 0.011, -0.01])
    with np.errstate(all="raise"):
        got = impl.distance_slopes(normal, np.full((5, 3), -2.0), light, 2, 2)
    assert_close(got, (-0.8 / limited, 1.2 / limited))


@exercise("14.9")
def test_the_bias_on_paper(impl):
    """The signs cancel, the half is missing, or the limit leaves the constant out."""
    slope_x, slope_y = np.array([0.0, 0.5, -0.5, -3.0, 8.0]), np.array([0.0, -0.25, 0.25, -1.0, 0])
    assert_close(impl.slope_scaled_bias(slope_x, slope_y, 0.125, 2.0, 4.0),
                 np.array([0.125, 0.875, 0.875, 4.0, 4.0]))
    assert_close(impl.slope_scaled_bias(slope_x, slope_y, 0.125, 0.0, 4.0), np.full(5, 0.125))


@exercise("14.9")
def test_a_plane_does_not_shadow_itself(impl, rng):
    """With factor 1 the bias is too small, or half as large again as it has to be."""
    slope_x, slope_y = rng.normal(size=(2, 50))
    got = np.asarray(impl.slope_scaled_bias(slope_x, slope_y, 0.0, 1.0, np.inf))
    corner = np.array([[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]])
    worst = np.max([dx * slope_x + dy * slope_y for dx, dy in corner], axis=0)
    assert_close(got, worst)


# --- soft borders -------------------------------------------------------------------------------

@exercise("14.10")
def test_the_plane_is_measured_at_the_texels_centre(impl):
    """At the place itself; or from the centre of the receiver's own texel."""
    one = np.ones(1)
    got = impl.on_plane(2.75 * one, 1.25 * one, 10.0 * one, 2.0 * one, -4.0 * one, 0.5 * one, -one)
    assert_close(got, (np.array([3.25]), np.array([0.25]), np.array([10 + 2 * 0.75 + 4 * 0.75])))
    got = impl.on_plane(2.75 * one, 1.25 * one, 10.0 * one, 2.0 * one, -4.0 * one, 0 * one, 0 * one)
    assert_close(got[2], np.array([10 - 2 * 0.25 - 4 * 0.25]))


@exercise("14.10")
def test_texels_left_of_the_map_have_centres_too(impl, rng):
    """Cutting off decimals is not floor: -0.3 lies in the texel whose centre is -0.5."""
    x, y, distance, slope_x, slope_y, dx, dy = rng.uniform(-3, 3, (7, 20))
    plane = [distance[k] + slope_x[k] * (math.floor(x[k] + dx[k]) + 0.5 - x[k])
             + slope_y[k] * (math.floor(y[k] + dy[k]) + 0.5 - y[k]) for k in range(20)]
    assert_close(impl.on_plane(x, y, distance, slope_x, slope_y, dx, dy),
                 (x + dx, y + dy, np.array(plane)))


def places(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    """Of each receiver, one by one: what its places store, inf outside; which of them are lit."""
    height, width = distance_map.shape
    for k in range(len(x)):
        stored, lit = [], []
        for dx, dy in offsets:
            j = math.floor(x[k] + radius[k] * dx)
            i = math.floor(y[k] + radius[k] * dy)
            inside = 0 <= i < height and 0 <= j < width
            stored.append(distance_map[i, j] if inside else math.inf)
            plane = distance[k] + slope_x[k] * (j + 0.5 - x[k]) + slope_y[k] * (i + 0.5 - y[k])
            lit.append(plane <= stored[-1] + bias[k])
        yield np.array(stored), np.array(lit)


def around(rng, count=40):
    """A map, receivers over it and beside it, with slopes, biases, places and radii."""
    distance_map = rng.uniform(2, 6, (6, 9))
    distance_map[rng.random((6, 9)) < 0.2] = np.inf
    x, y = rng.uniform(-1, 10, count), rng.uniform(-1, 7, count)
    slopes = 0.3 * rng.normal(size=(2, count))
    return (distance_map, x, y, rng.uniform(3, 5, count), *slopes, rng.uniform(0, 0.5, count),
            rng.uniform(-1, 1, (11, 2)), rng.uniform(0, 3, count))


FLAT = np.zeros(2)
CROSS = np.array([[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 0.0]])


@exercise("14.11")
def test_shares_on_paper(impl):
    """The distances are averaged; the dark share is returned; x and y are swapped."""
    distance_map = np.array([[3.0, 3.0, 9.0, 9.0], [3.0, 3.0, 9.0, 1.0]])
    got = impl.percentage_closer(distance_map, np.array([1.5, 2.5]), np.array([1.5, 1.5]),
                                 np.array([5.0, 5.0]), FLAT, FLAT, 0.0, CROSS, 1.0)
    assert_close(got, np.array([0.25, 0.5]))


@exercise("14.11")
def test_each_receiver_has_its_radius_and_bias(impl, rng):
    """One radius for all, a place off by a half, a slope that is left out, or dark outside."""
    given = around(rng)
    expected = np.array([lit.mean() for _, lit in places(*given)])
    assert_close(impl.percentage_closer(*given), expected)


@exercise("14.11")
def test_a_slanted_plane_does_not_darken_itself(impl, rng):
    """Every neighbour is compared with the distance at the middle: acne comes back."""
    slope_x, slope_y = 0.7, -0.4
    column, row = np.meshgrid(np.arange(9) + 0.5, np.arange(6) + 0.5)
    distance_map = 5 + slope_x * column + slope_y * row
    x, y = rng.uniform(2, 7, 20), rng.uniform(2, 4, 20)
    got = impl.percentage_closer(distance_map, x, y, 5 + slope_x * x + slope_y * y,
                                 np.full(20, slope_x), np.full(20, slope_y), 1e-9, CROSS, 1.5)
    assert_close(got, np.ones(20))


@exercise("14.12")
def test_blockers_on_paper(impl):
    """Lit places count, too; or the sum is divided by all places."""
    distance_map = np.array([[3.0, 4.0, 9.0, 9.0], [2.0, 3.0, 9.0, 1.0]])
    got = impl.blocker_distance(distance_map, np.array([1.5, 2.5]), np.array([1.5, 1.5]),
                                np.array([5.0, 5.0]), FLAT, FLAT, 0.0, CROSS, 1.0)
    assert_close(got, np.array([3.0, 2.0]))


@exercise("14.12")
def test_blockers_are_the_places_that_are_not_lit(impl, rng):
    """The bias or the plane is left out; what lies outside the map blocks."""
    given = around(rng)
    expected = np.array([stored[~lit].mean() if not lit.all() else np.inf
                         for stored, lit in places(*given)])
    assert_equal(bool(np.isinf(expected).any() and np.isfinite(expected).any()), True)
    with np.errstate(all="raise"):
        assert_close(impl.blocker_distance(*given), expected)


@exercise("14.13")
def test_a_border_grows_with_the_distance_behind_the_blocker(impl):
    """Distances are swapped, or the border is measured in the world and not on the map."""
    distance, blocker = np.array([4.0, 4.0, 8.0, 2.0]), np.array([4.0, 2.0, 2.0, 1.0])
    assert_close(impl.penumbra_radius(distance, blocker, 0.5, CONE, 16),
                 np.array([0.0, 1.5, 2.25, 3.0]))


@exercise("14.13")
def test_no_blocker_has_no_border(impl):
    """A negative radius, NaN, or a warning."""
    with np.errstate(all="raise"):
        got = impl.penumbra_radius(np.array([3.0, 3.0]), np.array([np.inf, 3.5]), 0.5, CONE, 16)
    assert_close(got, np.zeros(2))


@exercise("14.13")
def test_the_border_ends_where_the_rays_to_the_rim_pass(impl, rng):
    """The diameter in place of the radius, or the blocker's distance from the receiver."""
    distance, x = rng.uniform(3, 6, 10), rng.normal(size=10)
    blocker = distance * rng.uniform(0.2, 0.9, 10)
    at_blocker = x + (0.3 - x) * (distance - blocker) / distance   # of the ray to the rim, at 0.3
    expected = (at_blocker / blocker - x / distance) * 1.5 * 20 / 2
    assert_close(impl.penumbra_radius(distance, blocker, 0.3, CONE, 20), expected)


# --- moments ------------------------------------------------------------------------------------

def square(picture, i, j, radius):
    """The part of a picture up to radius rows and columns away from [i, j]."""
    return picture[max(i - radius, 0):i + radius + 1, max(j - radius, 0):j + radius + 1]


def each_square(picture, radius, of):
    """of(the square around it) for each pixel of a picture (H, W, C)."""
    height, width = picture.shape[:2]
    return np.array([[of(square(picture, i, j, radius)) for j in range(width)]
                     for i in range(height)])


@exercise("14.14")
def test_sums_on_paper(impl):
    """Rows alone, or columns alone; the border is wrapped or left out."""
    picture = np.array([[1.0, 2.0, 3.0], [10.0, 20.0, 30.0]])[..., None]
    assert_close(impl.window_sums(picture, 1)[..., 0], np.array([[33.0, 66.0, 55.0]] * 2))
    assert_close(impl.window_sums(picture, 0), picture)


@exercise("14.14")
@pytest.mark.parametrize("radius", [1, 2, 3, 9])
def test_sums_are_those_of_every_square(impl, rng, radius):
    """A square is one pixel too wide; channels are mixed; a square larger than the picture."""
    picture = rng.normal(size=(5, 8, 2))
    expected = each_square(picture, radius, lambda part: part.sum((0, 1)))
    assert_close(impl.window_sums(picture, radius), expected)


@exercise("14.15")
@pytest.mark.parametrize("radius", [0, 1, 2, 9])
def test_a_blur_is_the_mean_of_every_square(impl, rng, radius):
    """At the border, the sum is divided by the number of pixels of a whole square."""
    picture = rng.normal(size=(5, 8, 3))
    expected = each_square(picture, radius, lambda part: part.mean((0, 1)))
    assert_close(impl.box_blur(picture, radius), expected)


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
    """The floor hands a gradient on, also where the variance just reaches it."""
    got = impl.chebyshev_backward(np.ones(3), np.full(3, 5.0), np.full(3, 3.0),
                                  np.array([9.0, 10.0, 10.5]), 1.0)
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
    motion = np.asarray(impl.map_motion(distance_map, CONE))
    assert_equal(motion.shape, (2, 4, 2, 3))
    assert_close(motion[0, 1], np.array([[2.0, 0.0, -1 / 3], [0.0, 4 / 3, -1 / 3]]))
    assert_close(motion[1, 2], np.array([[0.5, 0.0, 1 / 12], [0.0, 1 / 3, 1 / 12]]))
    got = np.asarray(impl.map_motion(distance_map, PARALLEL))
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
        expected[i, j, :, axis] = [np.diff(place[::-1])[0] / (2 * h)
                                   for place in projected(ends, light, 5, 3)[:2]]
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
    got = np.asarray(impl.moved_moments(STEP, ACROSS, np.array([0.1, 0.0, 0.0])))
    assert_close(got[0, :, 0], np.array([1.0, 0.8, 2.8, 3.0]))     # by 0.2 texels, the jump is 2
    assert_close(got[0, :, 1], np.array([1.0, 0.2, 8.2, 9.0]))
    got = impl.moved_moments(STEP.T.copy(), ACROSS.swapaxes(0, 1), np.array([9, -0.1, 0]))
    assert_close(np.asarray(got)[:, 0, 0], np.array([1.0, 1.2, 3.2, 3.0]))


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
