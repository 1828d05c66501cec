"""What the exercises of lab 14 must do: the light's frame, its map, the comparison and its bias."""
import numpy as np
from shadow_lights import CONE, PARALLEL, each_light, point_at, projected

from labkit.checks import assert_close, assert_equal, exercise

WIDTH, HEIGHT = 12, 7


def rotation_of(rng):
    """A rotation (3, 3), its determinant 1."""
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return q * np.linalg.det(q)


def before_the_light(rng, count):
    """Points of the light's frame (count, 3), distances from 1 to 4."""
    return np.column_stack([rng.normal(size=(count, 2)), rng.uniform(-4, -1, count)])


# --- the light's frame and its map --------------------------------------------------------------

# Looks down -y, turned about it.
DOWN = np.array([[0.6, 0.0, 0.8], [0.8, 0.0, -0.6], [0.0, 1.0, 0.0]])


@exercise("14.1")
def test_a_light_looks_down_on_paper(impl):
    """The position is added, not subtracted, or left out. Points are turned first and moved after
    that. rotation is not transposed, or multiplies from the left, though the points are rows. The
    sign of z is flipped: the light looks down -z.
    """
    away = np.array([[5.0, -4.0, 10.0], [-5.0, -3.0, 15.0], [10.0, -7.0, 5.0]])
    position = np.array([2.0, 30.0, -1.0])
    assert_close(impl.to_light(away + position, position, DOWN),
                 [[11.0, -2.0, -4.0], [9.0, -13.0, -3.0], [10.0, 5.0, -7.0]])


@exercise("14.1")
def test_any_number_of_points_may_come(impl):
    """Points are rows (N, 3): rotation @ points works only for three of them, and is wrong there.
    """
    position = np.array([2.0, 30.0, -1.0])
    assert_close(impl.to_light(np.array([[7.0, 26.0, 9.0]]), position, DOWN), [[11.0, -2.0, -4.0]])
    away = np.array([[5.0, -4.0, 10.0], [-5.0, -3.0, 15.0]])
    assert_close(impl.to_light(away + position, position, DOWN),
                 [[11.0, -2.0, -4.0], [9.0, -13.0, -3.0]])


@exercise("14.1")
def test_the_rows_are_the_axes(impl, rng):
    """Columns are taken for the light's axes."""
    rotation, position, along = rotation_of(rng), rng.normal(size=3), rng.normal(size=(4, 3))
    points = [position + sum(p[k] * rotation[k] for k in range(3)) for p in along]
    assert_close(impl.to_light(np.array(points), position, rotation), along)


@exercise("14.2")
def test_a_light_that_moves_pulls_all_points_on_paper(impl):
    """The gradient is turned by rotation.T, as the points are, or not at all. grad_position has the
    wrong sign: its minus is missing. It is a mean, or that of one point, and not the sum over all
    points.
    """
    grad_q = np.array([[5.0, 10.0, 1.0], [-10.0, 5.0, 2.0], [15.0, 0.0, 3.0]])
    points = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 7.0], [0.0, 8.0, 6.0]])
    assert_close(impl.to_light_backward(grad_q, points, np.array([5.0, 6.0, 7.0]), DOWN),
                 ([[11.0, 1.0, -2.0], [-2.0, 2.0, -11.0], [9.0, 3.0, 12.0]], [-18.0, -6.0, 1.0]))


@exercise("14.2")
def test_the_gradients_of_the_frame_are_central_differences(impl, rng, gradcheck):
    """The rotation is not transposed, or multiplies from the left, though gradients are rows."""
    rotation = rotation_of(rng)
    gradcheck(lambda points, position, rotation: (points - position) @ rotation.T,
              impl.to_light_backward, (rng.normal(size=(5, 3)), rng.normal(size=3), rotation),
              differentiable=[0, 1], name="to_light")


@exercise("14.3")
def test_places_on_the_map_on_paper(impl):
    """It is not divided by w, but by nothing or -q_z: w is 1 in parallel light. y is counted
    downwards. The + 1 is missing. ndc is 2 wide. Width and height, or C_00 and C_11, are swapped,
    alike or left out. It is width - 1. Half a texel is taken away.
    """
    q = np.array([[1.0, 1.5, -3.0], [-0.5, -0.75, -1.5], [3.0, -1.25, -4.0], [0.0, 0.0, -2.0]])
    assert_close(impl.map_position(q, CONE, 12, 8),
                 [[9.0, 8.0], [3.0, 0.0], [12.75, 1.5], [6.0, 4.0]])
    q = np.array([[2.5, 0.5 / 0.7, -3.0], [-1.25, 1 / 0.7, -9.0]])
    assert_close(impl.map_position(q, PARALLEL, 12, 8), [[12.0, 6.0], [3.0, 8.0]])


@exercise("14.3")
@each_light
def test_it_is_the_whole_matrix_and_the_viewport(impl, rng, light):
    """The distance divides in parallel light, too, or x and y have each other's factor."""
    q = before_the_light(rng, 9)
    assert_close(impl.map_position(q, light, WIDTH, HEIGHT), projected(q, light, WIDTH, HEIGHT)[0])


@exercise("14.3")
def test_any_perspective_has_its_w(impl, rng):
    """w is taken to be the distance, -q_z, or 1: C_32 and C_33 say what it is."""
    light, q = CONE.copy(), before_the_light(rng, 5)
    light[3, 2:] = -0.5, 2.0
    assert_close(impl.map_position(q, light, WIDTH, HEIGHT), projected(q, light, WIDTH, HEIGHT)[0])


@exercise("14.4")
def test_a_point_that_comes_nearer_moves_outwards(impl):
    """The gradient through w, by q_z, is missing or has the wrong sign: w is no constant. Its share
    of x or of y, C_32 or a 1 / w is lost. grad_place is left out.
    """
    # 2 C is the same light as C, with twice the w: 6 and 12 here.
    q, grad_place = np.array([[2.0, -1.5, -3.0], [1.0, 3.0, -6.0]]), np.array([[1.0, 3], [4, -3]])
    got = impl.map_position_backward(grad_place, q, 2 * CONE, 12, 8)
    assert_close(got, [[3.0, 8.0, -2.0], [6.0, -4.0, -1.0]])
    got = impl.map_position_backward(grad_place, q, PARALLEL, 10, 8)
    assert_close(got, [[2.0, 8.4, 0.0], [8.0, -8.4, 0.0]])


@exercise("14.4")
@each_light
def test_the_gradients_of_places_are_central_differences(impl, rng, light, gradcheck):
    """A factor of one axis in the other's gradient; C_33 is left out of w."""
    light = light + np.array([[0], [0], [0], [0.3]]) * [0, 0, 0, 1]
    gradcheck(lambda q, *light_and_size: projected(q, *light_and_size)[0],
              impl.map_position_backward, (before_the_light(rng, 6), light, WIDTH, HEIGHT),
              differentiable=[0], name="map_position")


@exercise("14.5")
def test_near_and_far_on_paper(impl):
    """The distance is negative: q_z is returned. The depth is taken for linear, not divided by w,
    or for one from 0 to 1. The matrix is applied to the depth. C_33, or a sign, is lost.
    """
    # CONE: -1.5 q_z - 2.5 = depth (-q_z), so at distance 1 the depth is -1, and at 5 it is 1.
    assert_close(impl.distance_of_depth(np.array([[-1.0, 0.25, 0.5, 1.0]]), CONE),
                 [[1.0, 2.0, 2.5, 5.0]])
    assert_close(impl.distance_of_depth(np.array([[-1.0], [1.0], [0.0], [0.5]]), PARALLEL),
                 [[2.0], [6.0], [4.0], [5.0]])


@exercise("14.5")
@each_light
def test_the_distance_is_what_the_matrix_made_the_depth_of(impl, rng, light):
    """One of the two lights is forgotten; a term is lost."""
    light, q = light.copy(), before_the_light(rng, 12)
    light[3, 3] += 0.25
    depth = projected(q, light, WIDTH, HEIGHT)[1].reshape(3, 4)
    assert_close(impl.distance_of_depth(depth, light), -q[:, 2].reshape(3, 4))


@exercise("14.5", fine_print=True)
@each_light
def test_where_the_light_sees_nothing_the_distance_is_infinite(impl, light):
    """NaN, -inf, 0, or a number from the far plane, where the depth is np.inf: the light sees
    nothing.
    """
    got = impl.distance_of_depth(np.array([[np.inf, 0.0], [np.inf, np.inf]]), light)
    assert_equal(np.isinf(got), [[True, False], [True, True]])
    assert_equal(bool((got > 0).all()), True)


MAP = np.array([[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, np.inf], [9.0, 10.0, 11.0, 12.0]])


EIGHT = np.array([[0.5, 0.5], [2.25, 0.75], [3.5, 0.0], [1.75, 1.5], [2.5, 1.25], [0.0, 2.75],
                  [1.5, 2.5], [3.25, 2.0]])
STORED = np.array([1.0, 3.0, 4.0, 6.0, 7.0, 9.0, 10.0, 12.0])  # of MAP there


@exercise("14.7")
def test_what_lies_behind_is_dark_and_what_lies_before_is_lit(impl):
    """The comparison is turned round, as with a map of the farthest surface. Dark points are True.
    What lies in front of the stored surface, nearer than it, is dark: the absolute difference is
    taken. x and y are swapped. The bias is a factor.
    """
    got = impl.is_lit(MAP, np.concatenate([EIGHT, EIGHT]),
                      np.concatenate([STORED + 0.75, STORED - 0.75]), np.full(16, 0.25))
    assert_equal(got, np.arange(16) >= 8)


BIAS = np.array([0.5, 1.0, 0.75, 2.0, 1.5, 0.5, 3.0, 0.25])


@exercise("14.7")
def test_the_bias_lights_what_is_just_behind(impl):
    """The bias is subtracted, left out, or that of one point for all. It is a factor."""
    got = impl.is_lit(MAP, np.concatenate([EIGHT, EIGHT, EIGHT]),
                      np.concatenate([STORED + BIAS - 0.125, STORED + BIAS + 0.125,
                                      STORED - BIAS + 0.125]), np.tile(BIAS, 3))
    assert_equal(got, np.repeat([True, False, True], 8))
    assert_equal(impl.is_lit(MAP, EIGHT, STORED + 0.25, 0.5), np.ones(8, bool))
    assert_equal(impl.is_lit(MAP, EIGHT, STORED - 0.5, -0.75), np.zeros(8, bool))


@exercise("14.7")
def test_a_point_at_exactly_stored_plus_bias_is_lit(impl):
    """< instead of <=: a point at an equal distance is lit."""
    got = impl.is_lit(MAP, np.concatenate([EIGHT, EIGHT, EIGHT]),
                      np.concatenate([STORED + BIAS, STORED, STORED + BIAS + 0.125]),
                      np.concatenate([BIAS, 0 * BIAS, BIAS]))
    assert_equal(got, np.repeat([True, True, False], 8))


@exercise("14.7")
def test_outside_the_map_all_is_lit(impl):
    """What the light's picture does not hold is dark, or is looked up elsewhere: on the other side,
    or at the border. Where the map holds np.inf, all is lit, too.
    """
    place = np.array([[-1.0, 2.0], [9.0, 1.0], [1.0, -1.0], [2.0, 3.0], [-0.25, 0.5], [4.0, 2.5],
                      [3.5, 1.5], [3.0, 1.0]])
    got = impl.is_lit(MAP, np.concatenate([place, EIGHT]), np.full(16, 100.0), np.full(16, 0.5))
    assert_equal(got, np.arange(16) < 8)


@exercise("14.7")
def test_what_is_lit_is_that_of_a_search(impl, rng):
    """Right for a few points alone, or for one map."""
    stored, place = rng.uniform(1, 5, (4, 6)), rng.uniform(-1, [7, 5], (80, 2))
    distance, bias = rng.uniform(1, 5, 80), rng.uniform(0, 0.5, 80)
    held = {(i, j): stored[i, j] for i in range(4) for j in range(6)}
    expected = [bool(distance[n] <= held.get((int(y // 1), int(x // 1)), np.inf) + bias[n])
                for n, (x, y) in enumerate(place)]
    assert_equal(impl.is_lit(stored, place, distance, bias), np.array(expected))


# --- bias ---------------------------------------------------------------------------------------

@exercise("14.8")
def test_slopes_on_paper(impl):
    """The sign, n . ray or its sign is lost. A texel is 2 / width of clip space, not 1 / width, or
    a unit of the world. x and y are swapped. A cone's rays are not parallel, (0, 0, -1), nor q, nor
    of length 1. w is left out.
    """
    light, normal = np.diag([0.25, 0.5, -1.0, 1.0]), np.array([[2.0, -1.0, 2.0], [1, 2, -2]]) / 3
    q = np.array([[4.0, -2.0, -4.0], [-2.0, 1.0, -2.0]])
    assert_close(impl.distance_slopes(normal, q, light, 4, 8),  # a texel is 2 x 1/2
                 [[2.0, -0.25], [-1.0, -0.5]])
    # The cone's rays are (1, -1/2, -1) and (-1, 1/2, -1), so n . ray is 1/6 and 2/3.
    light[3, 2:] = -1, 0
    assert_close(impl.distance_slopes(normal, q, light, 4, 8), [[-32.0, 4.0], [-2.0, -1.0]])


@exercise("14.8")
@each_light
def test_slopes_are_those_of_the_plane_on_the_map(impl, rng, light):
    """The cone's ray is taken for the light's axis, or w is left out."""
    q, normal = before_the_light(rng, 30), rng.normal(size=(30, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    # The plane's distance at (x, y): along the ray there, n . point = n . q.
    def distance(k, x, y):
        start = point_at(x, y, 0.0, light, WIDTH, HEIGHT)
        step = point_at(x, y, 1.0, light, WIDTH, HEIGHT) - start
        return normal[k] @ (q[k] - start) / (normal[k] @ step)

    place, _ = projected(q, light, WIDTH, HEIGHT)
    ray = np.array([point_at(x, y, 1.0, light, WIDTH, HEIGHT)
                    - point_at(x, y, 0.0, light, WIDTH, HEIGHT) for x, y in place])
    seen = np.flatnonzero(np.abs((normal * ray).sum(1)) > 0.1)
    h = 1e-5
    expected = [[(distance(k, *(place[k] + step)) - distance(k, *(place[k] - step)))
                 / (2 * h) for step in h * np.eye(2)] for k in seen]
    assert_close(impl.distance_slopes(normal[seen], q[seen], light, WIDTH, HEIGHT), expected,
                 rtol=1e-6, atol=1e-8)
    assert_close(impl.distance_slopes(-normal[seen], q[seen], light, WIDTH, HEIGHT), expected,
                 rtol=1e-6, atol=1e-8)


@exercise("14.8", fine_print=True)
def test_a_plane_seen_edge_on_keeps_a_finite_slope(impl):
    """An infinite slope. The sign of n . ray is lost: where it is negative, -GRAZING stands in its
    place. The limit is GRAZING = 0.01, no sooner.
    """
    light, facing = np.diag([1.0, 0.5, -1.0, 1.0]), np.array([0.0, 0.004, -0.004, 0.011, -0.0099])
    # n . ray = -n_z = facing
    normal = np.stack([np.full(5, 0.8), np.full(5, -0.6), -facing], 1)
    limited = np.array([0.01, 0.01, -0.01, 0.011, -0.01])
    got = impl.distance_slopes(normal, np.full((5, 3), -2.0), light, 2, 2)
    assert_close(got, np.stack([-0.8 / limited, 1.2 / limited], -1))


@exercise("14.9")
def test_the_bias_on_paper(impl):
    """The signs cancel: absolute values are added. It is a length, the root of squares, or the
    larger slope. The half, factor or constant is missing. The limit is missing, leaves the constant
    out, or is a maximum.
    """
    slope = np.array([[0.0, 0.0], [0.5, -0.25], [-1.0, 0.75], [-3.0, -1.0], [8.0, 0.0]])
    assert_close(impl.slope_scaled_bias(slope, 0.125, 2.0, 4.0), [0.125, 0.875, 1.875, 4.0, 4.0])
    assert_close(impl.slope_scaled_bias(slope, 0.125, 0.0, 4.0), np.full(5, 0.125))


@exercise("14.9")
def test_a_plane_does_not_shadow_itself(impl, rng):
    """With factor 1 the bias is too small, or half as large again as it has to be."""
    slope = rng.normal(size=(50, 2))
    corner = np.array([[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]])
    assert_close(impl.slope_scaled_bias(slope, 0.0, 1.0, np.inf), (slope @ corner.T).max(1))
