"""What the exercises of lab 14 must do: places on a map, how planes recede, and the shadow."""
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


@exercise("14.1")
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


@exercise("14.1")
@each_light
def test_it_is_the_whole_matrix_and_the_viewport(impl, rng, light):
    """The distance divides in parallel light, too, or x and y have each other's factor. w is taken
    to be the distance, -q_z, or 1: C_32 and C_33 say what it is.
    """
    q = before_the_light(rng, 9)
    assert_close(impl.map_position(q, light, WIDTH, HEIGHT), projected(q, light, WIDTH, HEIGHT)[0])


@exercise("14.2")
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


@exercise("14.2")
@each_light
def test_the_gradients_of_places_are_central_differences(impl, rng, light, gradcheck):
    """A factor of one axis in the other's gradient; C_33 is left out of w."""
    gradcheck(lambda q, *light_and_size: projected(q, *light_and_size)[0],
              impl.map_position_backward, (before_the_light(rng, 6), light, WIDTH, HEIGHT),
              differentiable=[0], name="map_position")


@exercise("14.3")
def test_near_and_far_on_paper(impl):
    """The distance is negative: q_z is returned. The depth is taken for linear, not divided by w,
    or for one from 0 to 1. The matrix is applied to the depth. C_33, or a sign, is lost.
    """
    # CONE: -1.5 q_z - 2.5 = depth (-q_z), so at distance 1 the depth is -1, and at 5 it is 1.
    assert_close(impl.distance_of_depth(np.array([[-1.0, 0.25, 0.5, 1.0]]), CONE),
                 [[1.0, 2.0, 2.5, 5.0]])
    assert_close(impl.distance_of_depth(np.array([[-1.0], [1.0], [0.0], [0.5]]), PARALLEL),
                 [[2.0], [6.0], [4.0], [5.0]])


@exercise("14.3")
@each_light
def test_the_distance_is_what_the_matrix_made_the_depth_of(impl, rng, light):
    """One of the two lights is forgotten; a term is lost."""
    q = before_the_light(rng, 12)
    depth = projected(q, light, WIDTH, HEIGHT)[1].reshape(3, 4)
    assert_close(impl.distance_of_depth(depth, light), -q[:, 2].reshape(3, 4))


@exercise("14.3", fine_print=True)
@each_light
def test_where_the_light_sees_nothing_the_distance_is_infinite(impl, light):
    """NaN, -inf, 0, or a number from the far plane, where the depth is np.inf: the light sees
    nothing.
    """
    got = impl.distance_of_depth(np.array([[np.inf, 0.0], [np.inf, np.inf]]), light)
    assert_equal(np.isinf(got), [[True, False], [True, True]])
    assert_equal(bool((got > 0).all()), True)


# --- how a plane recedes, and the shadow -------------------------------------------------------

@exercise("14.4")
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


@exercise("14.4")
@each_light
def test_slopes_are_those_of_the_plane_on_the_map(impl, rng, light):
    """The cone's ray is taken for the light's axis, or w is left out."""
    q, normal = before_the_light(rng, 30), rng.normal(size=(30, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    # The plane's distance at (x, y): along the ray there, n . point = n . q.
    def distance(x, y):
        start = point_at(x, y, 0 * x, light, WIDTH, HEIGHT).T
        along = point_at(x, y, 1 + 0 * x, light, WIDTH, HEIGHT).T - start
        facing = (normal * along).sum(1)
        return np.where(np.abs(facing) > 0.1, (normal * (q - start)).sum(1) / facing, np.nan)

    (x, y), h = projected(q, light, WIDTH, HEIGHT)[0].T, 1e-5
    expected = np.stack([distance(x + h, y) - distance(x - h, y),
                         distance(x, y + h) - distance(x, y - h)], 1) / (2 * h)
    seen = np.isfinite(expected).all(1)
    for n in normal[seen], -normal[seen]:
        assert_close(impl.distance_slopes(n, q[seen], light, WIDTH, HEIGHT), expected[seen],
                     rtol=1e-6, atol=1e-8)


@exercise("14.4", fine_print=True)
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


S = 6
STORED = np.random.default_rng(0).uniform(2, 4, (S, S))


def looked_up(impl, rng, light, behind, normal=(0.0, 0.0, 1.0)):
    """Points all over the map STORED, so far behind (N,) what it holds there: the first arguments
    of hard_shadow. normal: in the light's frame, (3,) or (N, 3).
    """
    x, y = rng.uniform(0, S, (2, len(behind)))
    distance = STORED[y.astype(int), x.astype(int)] + behind
    return *seen_by(impl, rng, light, point_at(x, y, distance, light, S, S).T, normal), STORED


def seen_by(impl, rng, light, q, normal):
    """Points and normals of the light's frame in the world, and a Light."""
    position, rotation = rng.normal(size=3), rotation_of(rng)
    return (q @ rotation + position, np.broadcast_to(normal, q.shape) @ rotation,
            impl.Light(position, rotation, light))


@exercise("14.5")
def test_what_lies_behind_is_dark_and_what_lies_before_is_lit(impl, rng):
    """The comparison is turned round, as with a map of the farthest surface. Dark points are True.
    What lies nearer than the stored surface is dark: the absolute difference is taken. The distance
    is q_z, or along the ray. x and y are swapped.
    """
    behind = rng.uniform(0.3, 1, 60) * rng.choice([-1, 1], 60)
    assert_equal(impl.hard_shadow(*looked_up(impl, rng, PARALLEL, behind), 0.1, 0.0), behind < 0)


@exercise("14.5")
def test_under_a_point_light_too(impl, rng):
    """The place on the map is that of parallel light. The distance is measured along the ray."""
    behind = rng.uniform(0.3, 1, 60) * rng.choice([-1, 1], 60)
    assert_equal(impl.hard_shadow(*looked_up(impl, rng, CONE, behind), 0.1, 0.0), behind < 0)


@exercise("14.5")
def test_the_constant_lights_what_is_just_behind(impl, rng):
    """The bias is left out, subtracted, or a factor: it is added to what is stored."""
    behind = rng.uniform(-0.4, 0.8, 60)
    assert_equal(impl.hard_shadow(*looked_up(impl, rng, CONE, behind), 0.2, 0.0), behind <= 0.2)


def slanted(rng, count):
    """Unit normals (count, 3) in parallel light, and how far their planes recede from the centre of
    a texel to its corner.
    """
    normal = rng.normal(size=(count, 3)) + [0, 0, 3]
    x, y = np.abs(normal[:, :2] / normal[:, 2:]).T
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return normal, x / (0.4 * S) + y / (0.7 * S)        # a texel is 2 / (C_00 S) wide


@exercise("14.5")
def test_a_slanted_plane_does_not_shadow_itself(impl, rng):
    """Half of it is dark: the bias knows no slope. Slopes of opposite signs cancel, or the larger
    one alone counts. The normals are not turned into the light's frame.
    """
    column, row = np.meshgrid(*[np.arange(S) + 0.5] * 2)
    centre = point_at(column, row, 0 * row, PARALLEL, S, S)
    for x, y, z in slanted(rng, 9)[0]:
        distance_map = 3 + (x * centre[0] + y * centre[1]) / z
        q = rng.uniform([-2.5, -1.4, 0], [2.5, 1.4, 0], (40, 3))
        q[:, 2] = -3 - q[:, :2] @ [x / z, y / z]
        given = seen_by(impl, rng, PARALLEL, q, [x, y, z])
        assert_equal(impl.hard_shadow(*given, distance_map, 1e-9), np.ones(40, bool))


@exercise("14.5")
def test_the_bias_is_no_more_than_a_plane_needs(impl, rng):
    """A texel in place of a half. The factor or constant is left out, or multiplies the other."""
    normal, recedes = slanted(rng, 200)
    bias, above = 0.1 + 0.7 * recedes, rng.choice([-0.02, 0.02], 200)
    given = looked_up(impl, rng, PARALLEL, bias + above, normal)
    assert_equal(impl.hard_shadow(*given, 0.1, 0.7), above < 0)


@exercise("14.5")
def test_the_bias_has_a_limit(impl, rng):
    """The limit is left out, is a least bias, or does not hold for the constant."""
    normal, recedes = slanted(rng, 200)
    bias, above = np.minimum(0.1 + 2 * recedes, 0.3), rng.choice([-0.02, 0.02], 200)
    given = looked_up(impl, rng, PARALLEL, bias + above, normal)
    assert_equal(impl.hard_shadow(*given, 0.1, 2.0, 0.3), above < 0)


@exercise("14.5")
def test_a_point_at_exactly_stored_plus_bias_is_lit(impl):
    """< instead of <=: a point at an equal distance is lit."""
    points = np.array([[0.5, 0.5, -2.0], [0.5, -0.5, -2.25], [-0.5, 0.5, -2.5]])
    light = impl.Light(np.zeros(3), np.eye(3), np.diag([1.0, 1.0, -1.0, 1.0]))
    got = impl.hard_shadow(points, np.eye(3)[[2, 2, 2]], light, np.full((2, 2), 1.75), 0.5)
    assert_equal(got, [True, True, False])


@exercise("14.5")
def test_outside_the_map_all_is_lit(impl, rng):
    """What the light's picture does not hold is dark, or is looked up elsewhere: on the other side,
    or at the border.
    """
    x, y = rng.uniform(-3, S + 3, (2, 80))
    given = seen_by(impl, rng, CONE, point_at(x, y, 5 + 0 * x, CONE, S, S).T, [0.0, 0.0, 1.0])
    outside = (np.minimum(x, y) < 0) | (np.maximum(x, y) >= S)
    assert_equal(impl.hard_shadow(*given, STORED, 0.1, 0.0), outside)
