"""What the exercises of lab 14 must do: the light's frame, its map, the comparison and its bias."""
import numpy as np
import pytest

from course.checks import assert_close, assert_equal, exercise
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
    """By the whole matrix, point by point: x, y in texels (N, 2), depth from -1 to 1 (N,)."""
    clip = np.array([light @ [*point, 1.0] for point in q])
    ndc = clip[:, :3] / clip[:, 3:]
    return (ndc[:, :2] + 1) * [width / 2, height / 2], ndc[:, 2]


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
                 np.array([[6.0, 4.0], [12.0, 4.0], [6.0, 8.0], [6.0, 0.0]]))
    q = np.array([[2.5, 0.0, -3.0], [-2.5, 1 / 0.7, -9.0]])
    assert_close(impl.map_position(q, PARALLEL, 12, 8),
                 np.array([[12.0, 4.0], [0.0, 8.0]]))


@exercise("14.3")
@each_light
def test_it_is_the_whole_matrix_and_the_viewport(impl, rng, light):
    """The distance divides in parallel light, too, or x and y have each other's factor."""
    q = before_the_light(rng, 9)
    assert_close(impl.map_position(q, light, WIDTH, HEIGHT), projected(q, light)[0])


@exercise("14.3")
def test_any_perspective_has_its_w(impl, rng):
    """w is taken to be the distance, or 1: C_32 and C_33 say what it is."""
    light, q = CONE.copy(), before_the_light(rng, 5)
    light[3, 2:] = -0.5, 2.0
    assert_close(impl.map_position(q, light, WIDTH, HEIGHT), projected(q, light)[0])


@exercise("14.4")
def test_a_point_that_comes_nearer_moves_outwards(impl):
    """The gradient by q_z is missing, or has the wrong sign."""
    q = np.array([[2.0, 0.0, -3.0], [0.0, -0.75, -3.0]])
    got = impl.map_position_backward(np.eye(2), q, CONE, 12, 8)
    assert_close(got, np.array([[3.0, 0.0, 2.0], [0.0, 8 / 3, -2 / 3]]))
    got = impl.map_position_backward(np.eye(2), q, PARALLEL, 10, 8)
    assert_close(got, np.array([[2.0, 0.0, 0.0], [0.0, 2.8, 0.0]]))


@exercise("14.4")
@each_light
def test_the_gradients_of_places_are_central_differences(impl, rng, light):
    """A factor of one axis in the other's gradient; C_33 is left out of w."""
    light = light + np.array([[0], [0], [0], [0.3]]) * [0, 0, 0, 1]
    gradcheck(lambda q: projected(q, light)[0],
              lambda grad, q: impl.map_position_backward(grad, q, light, WIDTH, HEIGHT),
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
    depth = projected(q, light)[1].reshape(3, 4)
    assert_close(impl.distance_of_depth(depth, light), -q[:, 2].reshape(3, 4))


@exercise("14.5", fine_print=True)
@each_light
def test_where_the_light_sees_nothing_the_distance_is_infinite(impl, light):
    """NaN, -inf, or a number from the far plane."""
    got = impl.distance_of_depth(np.array([[np.inf, 0.0], [np.inf, np.inf]]), light)
    assert_equal(np.isinf(got), np.array([[True, False], [True, True]]))
    assert_equal(bool((got > 0).all()), True)


MAP = np.array([[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, np.inf], [9.0, 10.0, 11.0, 12.0]])


@exercise("14.7")
def test_what_lies_behind_is_dark(impl):
    """The comparison is turned round, as with a map of the farthest surface."""
    place = np.tile([1.5, 0.5], (3, 1))
    assert_equal(impl.is_lit(MAP, place, np.array([1.0, 2.0, 3.0]), 0.0),
                 np.array([True, True, False]))


@exercise("14.7")
def test_the_bias_lights_what_is_just_behind(impl):
    """The bias is subtracted, or one for all; or < for <=."""
    place, distance = np.tile([0.5, 1.5], (4, 1)), np.array([5.25, 5.25, 4.9, 5.5])
    got = impl.is_lit(MAP, place, distance, np.array([0.25, 0.0, 0.5, 0.75]))
    assert_equal(got, np.array([True, False, True, True]))
    assert_equal(impl.is_lit(MAP, place, np.full(4, 5.5), 0.5), np.ones(4, bool))
    assert_equal(impl.is_lit(MAP, place, np.full(4, 4.5), -0.75), np.zeros(4, bool))


@exercise("14.7")
def test_outside_the_map_all_is_lit(impl):
    """What the light's picture does not hold is dark, or is looked up elsewhere."""
    place = np.array([[-1.0, 2.0], [9.0, 1.0], [1.0, -1.0], [3.5, 1.5]])
    assert_equal(impl.is_lit(MAP, place, np.full(4, 100.0), 0.0), np.ones(4, bool))


# --- bias ---------------------------------------------------------------------------------------

@exercise("14.8")
def test_slopes_on_paper(impl):
    """Texels are taken for units of the world, or x and y for each other."""
    light, q = np.diag([0.25, 0.5, -1.0, 1.0]), np.array([[3.0, -1.0, -4.0]] * 2)
    normal = np.array([[0.6, 0.0, 0.8], [0.0, -0.8, 0.6]])
    assert_close(impl.distance_slopes(normal, q, light, 4, 8),
                 np.array([[1.5, 0.0], [0.0, -2 / 3]]), atol=1e-12)
    # The cone's ray is (1, -1/2, -1), n . ray = 0.6 - 0.8, and a texel there is 2 x 4 / (1/4 x 4).
    light[3, 2:] = -1, 0
    q = np.array([[4.0, -2.0, -4.0]])
    assert_close(impl.distance_slopes(normal[:1], q, light, 4, 8),
                 np.array([[24.0, 0.0]]), atol=1e-12)


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

    place, _ = projected(q, light)
    ray = np.array([point_at(x, y, 1.0, light, WIDTH, HEIGHT)
                    - point_at(x, y, 0.0, light, WIDTH, HEIGHT) for x, y in place])
    seen = np.flatnonzero(np.abs((normal * ray).sum(1)) > 0.1)
    h = 1e-5
    expected = np.array([[(distance(k, *(place[k] + step)) - distance(k, *(place[k] - step)))
                          / (2 * h) for step in h * np.eye(2)] for k in seen])
    assert_close(impl.distance_slopes(normal[seen], q[seen], light, WIDTH, HEIGHT), expected,
                 rtol=1e-6, atol=1e-8)
    assert_close(impl.distance_slopes(-normal[seen], q[seen], light, WIDTH, HEIGHT), expected,
                 rtol=1e-6, atol=1e-8)


@exercise("14.8", fine_print=True)
def test_a_plane_seen_edge_on_keeps_a_finite_slope(impl):
    """An infinite slope, or the wrong side of it; the limit is GRAZING = 0.01, no sooner."""
    light, facing = np.diag([1.0, 0.5, -1.0, 1.0]), np.array([0.0, 0.004, -0.004, 0.011, -0.0099])
    # n . ray = -n_z = facing
    normal = np.stack([np.full(5, 0.8), np.full(5, -0.6), -facing], 1)
    limited = np.array([0.01, 0.01, -0.01, 0.011, -0.01])
    got = impl.distance_slopes(normal, np.full((5, 3), -2.0), light, 2, 2)
    assert_close(got, np.stack([-0.8 / limited, 1.2 / limited], -1))


@exercise("14.9")
def test_the_bias_on_paper(impl):
    """The signs cancel, the half is missing, or the limit leaves the constant out."""
    slope = np.array([[0.0, 0.0], [0.5, -0.25], [-0.5, 0.25], [-3.0, -1.0], [8.0, 0.0]])
    assert_close(impl.slope_scaled_bias(slope, 0.125, 2.0, 4.0),
                 np.array([0.125, 0.875, 0.875, 4.0, 4.0]))
    assert_close(impl.slope_scaled_bias(slope, 0.125, 0.0, 4.0), np.full(5, 0.125))


@exercise("14.9")
def test_a_plane_does_not_shadow_itself(impl, rng):
    """With factor 1 the bias is too small, or half as large again as it has to be."""
    slope = rng.normal(size=(50, 2))
    got = impl.slope_scaled_bias(slope, 0.0, 1.0, np.inf)
    corner = np.array([[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]])
    worst = (slope @ corner.T).max(1)
    assert_close(got, worst)
