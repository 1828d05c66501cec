"""What the exercises of lab 15 must do."""
import numpy as np
import pytest

from course.checks import assert_close, assert_equal, exercise
from course.given.gradcheck import gradcheck

HALF = np.array([0.5, 1.0, 1.5])


def distance_to_box(point, half):
    """One point (3,): to the nearest point of the box, or less the nearest of six sides."""
    if (np.abs(point) > half).any():
        return np.linalg.norm(point - np.clip(point, -half, half))
    return -min(min(half[k] - point[k], half[k] + point[k]) for k in range(3))


def distance_to_ring(points, radius, tube):
    """To the point of the circle that is nearest."""
    on_plane = points * [1, 0, 1]
    circle = radius * on_plane / np.linalg.norm(on_plane, axis=-1, keepdims=True)
    return np.linalg.norm(points - circle, axis=-1) - tube


def blended(a, b, k):
    """Eq. (3) as a mix of both distances."""
    h = np.clip(0.5 + 0.5 * (b - a) / k, 0, 1)
    return b + h * (a - b) - k * h * (1 - h)


# --- signed distances --------------------------------------------------------------------------

@exercise("15.1")
def test_a_box_on_paper(impl):
    """Whole sides are taken for half of them; or the distance to a corner is the largest of three.
    """
    points = np.array([[2.5, 0.0, 0.0], [3.5, -5.0, 0.0], [-1.5, 3.0, -3.5], [0.0, 0.0, 0.0]])
    assert_close(impl.box(points, HALF), np.array([2.0, 5.0, 3.0, -0.5]))


@exercise("15.1")
def test_inside_a_box_the_nearest_side_counts(impl):
    """Inside it is 0, or the distance to a corner, or to the farthest side."""
    points = np.array([[0.0, 0.75, 0.0], [0.0, 0.0, -1.4], [0.25, -0.9, 1.25], [0.5, 0.2, 0.3]])
    assert_close(impl.box(points, HALF), np.array([-0.25, -0.1, -0.1, 0.0]))


@exercise("15.1")
def test_all_around_a_box_it_is_the_distance(impl, rng):
    """A region is wrong: sides, edges and corners, in every octant; or points come in a grid."""
    points, half = rng.uniform(-3, 3, (6, 50, 3)), np.array([2.0, 0.7, 1.3])
    expected = np.array([[distance_to_box(point, half) for point in row] for row in points])
    assert_close(impl.box(points, half), expected)


@exercise("15.1")
def test_one_point_has_one_distance(impl):
    """One point (3,) is an error: rows are counted."""
    assert_close(impl.box(np.array([3.5, -5.0, 0.0]), HALF), 5.0)


@exercise("15.2")
def test_gradients_of_a_box_on_paper(impl):
    """The sign of negative coordinates; grad_distance is left out; or its length is not 1."""
    points = np.array([[3.5, -5.0, 0.0], [-1.5, 0.5, 1.5], [0.1, -0.9, 1.0], [0.0, 0.5, 1.4]])
    expected = np.array([[1.2, -1.6, 0.0], [-3.0, 0, 0], [0, -5.0, 0], [0, 0, -7.0]])
    grad = np.array([2.0, 3.0, 5.0, -7.0])
    assert_close(impl.box_backward(grad, points, HALF), expected)


@exercise("15.2")
def test_on_the_surface_and_in_the_middle_of_a_box(impl):
    """0 / 0 on the surface; sign(0) = 0 in the middle; or equally near sides share."""
    points = np.array([[0.5, 0.3, 0.2], [0.0, -1.0, 0.0], [0.0, 0.0, 0.0], [-0.25, -0.25, 0.0]])
    half = np.array([0.5, 1.0, 1.5])
    expected = np.array([[1.0, 0, 0], [0, -1.0, 0], [1.0, 0, 0], [-1.0, 0, 0]])
    assert_close(impl.box_backward(np.ones(4), points, half), expected)
    cube, at = np.full(3, 1.0), np.array([[0.2, -0.7, 0.7], [0.0, 0.1, -0.1], [-1.0, -1.0, 1.0]])
    expected = np.array([[0, -1.0, 0], [0, 1.0, 0], [-1.0, 0, 0]])
    assert_close(impl.box_backward(np.ones(3), at, cube), expected)


@exercise("15.2")
def test_gradients_of_a_box_are_central_differences(impl, rng):
    """Near an edge outside, an axis on which the point lies between the sides has a part."""
    def forward(points, half):
        return np.array([[distance_to_box(point, half) for point in row] for row in points])

    def decisions(points, half):
        beyond = np.abs(points) - half
        return beyond > 0, (beyond.max(-1) > 0) * 3 + (beyond.max(-1) <= 0) * beyond.argmax(-1)

    points, half = rng.uniform(-1, 1, (4, 12, 3)) * [3.0, 1.2, 2.0], np.array([2.0, 0.7, 1.3])
    gradcheck(forward, impl.box_backward, (points, half), differentiable=[0], decisions=decisions,
              name="box")


@exercise("15.2")
def test_one_point_has_one_gradient(impl):
    """One point (3,) is an error: rows are counted."""
    got = impl.box_backward(np.array(2.0), np.array([0.1, -0.9, 1.0]), HALF)
    assert_close(got, np.array([0.0, -2.0, 0.0]))


@exercise("15.3")
def test_a_ring_on_paper(impl):
    """Its axis is not y; or radius and tube are swapped; or it is a sphere."""
    points = np.array([[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [3.0, 0.0, 4.0], [0.0, 12.0, 0.0],
                       [8.0, 4.0, 0.0]])
    assert_close(impl.torus(points, 5.0, 2.0), np.array([3.0, -2.0, -2.0, 11.0, 3.0]))


@exercise("15.3")
def test_all_around_a_ring_it_is_the_distance(impl, rng):
    """Below the plane, or inside of the hole, it is another distance; or points come in a grid."""
    points = rng.uniform(-2, 2, (4, 60, 3))
    assert_close(impl.torus(points, 1.1, 0.3), distance_to_ring(points, 1.1, 0.3))


@exercise("15.4")
def test_gradients_of_a_ring_on_paper(impl):
    """In the hole the surface lies farther out: the gradient there points to the axis."""
    points = np.array([[9.0, -3.0, 0.0], [0.0, 0.0, 2.0], [-5.0, 3.0, 0.0], [0.0, 4.0, -2.0]])
    expected = np.array([[8.0, -6.0, 0.0], [0, 0, -2.0], [0, 3.0, 0], [0, 4.0, 3.0]])
    grad = np.array([10.0, 2.0, 3.0, 5.0])
    assert_close(impl.torus_backward(grad, points, 5.0, 1.0), expected)


@exercise("15.4")
def test_on_the_axis_and_in_the_middle_of_the_tube_nothing_is_divided_by_0(impl):
    """NaN where there is no direction."""
    points = np.array([[0.0, 0.0, 0.0], [0.0, 12.0, 0.0], [0.0, 0.0, -5.0]])
    expected = np.array([[0, 0, 0], [0, 12 / 13, 0], [0, 0, 0]])
    assert_close(impl.torus_backward(np.ones(3), points, 5.0, 1.0), expected)


@exercise("15.4")
def test_gradients_of_a_ring_are_central_differences(impl, rng):
    """A factor of the chain is missing: right where x = 0 or z = 0."""
    def forward(points, radius, tube):
        return distance_to_ring(points, radius, tube)

    gradcheck(forward, impl.torus_backward, (rng.uniform(-2, 2, (4, 6, 3)), 1.1, 0.3),
              differentiable=[0], name="torus")


@exercise("15.5")
def test_a_smooth_union_on_paper(impl):
    """The 4 or the square is missing, or k is only half as wide; swelling is dented."""
    a, b = np.array([2.0, 2.0, 2.0, -1.0]), np.array([2.0, 4.0, 6.0, -3.0])
    assert_close(impl.smooth_union(a, b, 4.0), np.array([1.0, 1.75, 2.0, -3.25]))


@exercise("15.5")
def test_far_from_the_seam_it_is_the_union(impl, rng):
    """h is not clamped: one shape swells where the other is far away."""
    a = rng.normal(size=(5, 4))
    b = a + rng.choice([-1, 1], a.shape) * rng.uniform(0.5, 2, a.shape)
    assert_close(impl.smooth_union(a, b, 0.5), np.minimum(a, b))


@exercise("15.5")
def test_a_smooth_union_is_a_mix_of_both(impl, rng):
    """Right for a < b alone, or for one k."""
    a, b = rng.normal(size=(2, 5, 7))
    for k in 0.3, 1.0, 3.0:
        assert_close(impl.smooth_union(a, b, k), blended(a, b, k))


@exercise("15.6")
def test_shares_of_the_seam_on_paper(impl):
    """The smaller distance has the larger share; both have half where they are equal."""
    a, b = np.array([2.0, 2.0, 4.0, 2.0]), np.array([2.0, 4.0, 2.0, 7.0])
    grad_a, grad_b = impl.smooth_union_backward(np.array([8.0, 8.0, 8.0, -1.0]), a, b, 4.0)
    assert_close(grad_a, np.array([4.0, 6.0, 2.0, -1.0]))
    assert_close(grad_b, np.array([4.0, 2.0, 6.0, 0.0]))


@exercise("15.6")
def test_gradients_of_the_smooth_union_are_central_differences(impl, rng):
    """k's factor is missing or twice there; or shares are swapped where b is the smaller."""
    a, b = rng.normal(size=(2, 5, 4))
    for k in 0.7, 4.0:
        gradcheck(blended, impl.smooth_union_backward, (a, b, k), differentiable=[0, 1],
                  decisions=lambda a, b, k: np.abs(a - b) < k, name="smooth_union")


# --- sphere tracing ----------------------------------------------------------------------------

BALLS = np.array([[0.0, 0.0, 0.0], [1.5, 0.3, -0.8]]), np.array([1.0, 0.6])
TWO_BALLS = ("union", ("sphere", 1.0), ("moved", BALLS[0][1], ("sphere", 0.6)))


def traced(origin, direction, far, lipschitz, epsilon, most):
    """One ray to BALLS, step by step -> t, evaluations."""
    t = 0.0
    for evaluation in range(1, most + 1):
        s = (np.linalg.norm(origin + t * direction - BALLS[0], axis=-1) - BALLS[1]).min()
        if s < epsilon:
            return t, evaluation
        t += s / lipschitz
        if t > far:
            return np.inf, evaluation
    return np.inf, most


def rays(rng, count):
    """From around 4 away, toward the middle, more or less."""
    origins = rng.normal(size=(count, 3))
    origins *= 4 / np.linalg.norm(origins, axis=1, keepdims=True)
    directions = rng.uniform(-1.3, 1.3, (count, 3)) - origins
    return origins, directions / np.linalg.norm(directions, axis=1, keepdims=True)


@exercise("15.7")
def test_rays_to_a_sphere_on_paper(impl):
    """A hit from the front is found at once; a ray that leads away misses; one begins inside."""
    origins = np.array([[0.0, 0.0, 5.0], [0.0, 0.0, 5.0], [0.5, 0.0, 0.0], [0.0, 9.0, 12.0]])
    directions = np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -0.6, -0.8]])
    t, evaluations = impl.sphere_trace(origins, directions, ("sphere", 1.0), 20.0)
    assert_close(t, np.array([4.0, np.inf, 0.0, 14.0]))
    assert_equal(evaluations, np.array([2, 3, 1, 2]))


@exercise("15.7")
def test_half_a_step_comes_nearer_by_half(impl):
    """The step is not divided by L; or epsilon, far and most are compared the other way."""
    ray = np.array([[0.0, 0.0, 5.0]]), np.array([[0.0, 0.0, -1.0]]), ("sphere", 1.0)
    # s = 4, 2, 1, 1/2, 1/4, ...; t = 0, 2, 3, 3.5, 3.75, ...
    for far, epsilon, most, t, evaluations in (
            (9.0, 0.3, 99, 3.75, 5), (9.0, 0.5, 99, 3.75, 5), (9.0, 0.6, 99, 3.5, 4),
            (9.0, 0.3, 5, 3.75, 5), (9.0, 0.3, 4, np.inf, 4),
            (3.75, 0.3, 99, 3.75, 5), (3.7, 0.3, 99, np.inf, 4), (3.7, 0.5, 99, np.inf, 4)):
        got = impl.sphere_trace(*ray, far, lipschitz=2.0, epsilon=epsilon, most=most)
        assert_close(got[0], np.array([t]))
        assert_equal(got[1], np.array([evaluations]))


@exercise("15.7")
def test_too_long_a_step_goes_through(impl):
    """L below 1 is taken for 1: nothing then shows what a wrong L does."""
    ray = np.array([[0.0, 0.0, 5.0]]), np.array([[0.0, 0.0, -1.0]]), ("sphere", 1.0)
    t, evaluations = impl.sphere_trace(*ray, 20.0, lipschitz=0.5)
    assert_close(t, np.array([np.inf]))  # s = 4, t = 8; s = 2, t = 12; s = 6, t = 24
    assert_equal(evaluations, np.array([3]))
    t, _ = impl.sphere_trace(*ray, 20.0, lipschitz=0.8)
    assert_close(t, np.array([5.0]))     # inside: it has hit, and this t is its t


@exercise("15.7")
def test_rays_to_two_balls_stop_where_quadratic_equations_say(impl, rng):
    """The farther ball is hit through the nearer one; or t is off by a step."""
    origins, directions = rays(rng, 60)
    b = ((origins[:, None] - BALLS[0]) * directions[:, None]).sum(-1)
    c = ((origins[:, None] - BALLS[0])**2).sum(-1) - BALLS[1]**2
    root = np.sqrt(np.maximum(b**2 - c, 0))
    expected = np.where(b**2 > c, -b - root, np.inf).min(1)
    clear = (np.abs(b**2 - c) > 0.02).all(1)
    t, _ = impl.sphere_trace(origins[clear], directions[clear], TWO_BALLS, 9.0, epsilon=1e-9)
    assert_close(t, expected[clear], atol=1e-7)


@exercise("15.7")
def test_each_ray_goes_its_own_way(impl, rng):
    """Rays that are done go on, or wait for others; evaluations are those of the slowest ray."""
    origins, directions = rays(rng, 40)
    for lipschitz, epsilon, most in (1.0, 1e-5, 200), (1.7, 1e-3, 9):
        given = 5.0, lipschitz, epsilon, most
        expected = [traced(o, d, *given) for o, d in zip(origins, directions, strict=True)]
        t, evaluations = impl.sphere_trace(origins, directions, TWO_BALLS, *given)
        assert_close(t, np.array([ray[0] for ray in expected]))
        assert_equal(evaluations, np.array([ray[1] for ray in expected]))


@exercise("15.7")
def test_the_defaults_are_those_of_the_question(impl, rng):
    """Another L, epsilon or number of steps than the signature has; or no ray is an error."""
    origins, directions = rays(rng, 40)
    expected = np.array([traced(*ray, 9.0, 1.0, 1e-5, 200)[0]
                         for ray in zip(origins, directions, strict=True)])
    assert_close(impl.sphere_trace(origins, directions, TWO_BALLS, 9.0)[0], expected)
    _, evaluations = impl.sphere_trace(origins[:1], directions[:1], TWO_BALLS, 9.0, 1000.0)
    assert_equal(evaluations, np.array([200]))
    t, evaluations = impl.sphere_trace(np.zeros((0, 3)), np.zeros((0, 3)), TWO_BALLS, 9.0)
    assert_equal((t.shape, evaluations.shape), ((0,), (0,)))


@exercise("15.7")
def test_as_many_evaluations_as_are_allowed(impl):
    """A limit of one's own, or far is cut."""
    ray = np.array([[0.0, 0.0, 5.0]]), np.array([[0.0, 0.0, -1.0]]), ("sphere", 1.0)
    _, evaluations = impl.sphere_trace(*ray, 9.0, lipschitz=1e4, most=700)
    assert_equal(evaluations, np.array([700]))


# --- volume rendering --------------------------------------------------------------------------

def composited(density, colour, spacing, background):
    """Eq. (5) and (6) as light that goes from sample to sample."""
    output = np.zeros((len(density), colour.shape[2]))
    for r in range(len(density)):
        light = 1.0
        for i in range(density.shape[1]):
            opacity = 1 - np.exp(-density[r, i] * spacing[r, i])
            output[r] += light * opacity * colour[r, i]
            light *= 1 - opacity
        output[r] += light * background
    return output


@exercise("15.8")
def test_weights_on_paper(impl):
    """T holds the sample's own density, or those behind it; or weights are opacities."""
    density, spacing = np.log([[2.0, 4.0, 1.0, 2.0]]), np.array([[1.0, 0.5, 3.0, 2.0]])
    weights, remaining = impl.ray_weights(density, spacing)  # half, half, nothing, three quarters
    assert_close(weights, np.array([[0.5, 0.25, 0.0, 0.1875]]))
    assert_close(remaining, np.array([0.0625]))


@exercise("15.8")
def test_light_is_neither_lost_nor_made(impl, rng):
    """The sum of a ray's weights and of its remaining light is 1; nothing is negative."""
    weights, remaining = impl.ray_weights(rng.gamma(0.5, 4.0, (5, 9)), rng.uniform(0.1, 2, (5, 9)))
    assert_close(np.sum(weights, -1) + remaining, np.ones(5))
    assert_equal(np.min(weights) >= 0, True)


@exercise("15.8")
def test_weights_are_those_of_light_that_goes_from_sample_to_sample(impl, rng):
    """spacing is taken for constant, or rays are mixed."""
    density, spacing = rng.gamma(0.5, 2.0, (5, 7)), rng.uniform(0.1, 1, (5, 7))
    weights, remaining = impl.ray_weights(density, spacing)
    each = np.broadcast_to(np.eye(7), (5, 7, 7))
    assert_close(weights, composited(density, each, spacing, np.zeros(7)))
    assert_close(remaining, composited(density, np.zeros((5, 7, 1)), spacing, np.ones(1))[:, 0])


@exercise("15.8")
def test_behind_a_wall_is_nothing(impl):
    """inf, NaN or a rest of 1e-10 behind an opaque sample."""
    density = np.array([[1.0, 1e12, 3.0], [0.0, 0.0, 0.0]])
    weights, remaining = impl.ray_weights(density, np.ones((2, 3)))
    near = np.exp(-1.0)
    assert_close(weights, np.array([[1 - near, near, 0.0], [0, 0, 0]]))
    assert_close(remaining, np.array([0.0, 1.0]))


@exercise("15.8")
def test_thick_and_short_pieces(impl):
    """T is a sum less its last term, and a wall has taken the digits; or density is cut off."""
    weights, remaining = impl.ray_weights(np.array([[0.3, 1e17, 3.0], [5e4, 0.0, 1e5]]),
                                          np.array([[1.0, 1.0, 1.0], [1e-5, 1e-5, 1e-5]]))
    a, b, c = np.exp([-0.3, -0.5, -1.0])
    assert_close(weights, np.array([[1 - a, a, 0], [1 - b, 0, b * (1 - c)]]))
    assert_close(remaining, np.array([0.0, b * c]))


@exercise("15.9")
def test_gradients_of_one_ray_on_paper(impl):
    """What is behind does not count, or the background; or colours get the opacity."""
    density, colour = np.log([[2.0, 2.0]]), np.array([[[2.0], [0.0]]])
    given = density, colour, np.ones((1, 2)), np.array([4.0])
    grad_density, grad_colour = impl.volume_render_backward(np.array([[8.0]]), *given)
    # Of the first: half of the light passes; behind it are 1/4 of 0 and 1/4 of 4.
    assert_close(grad_density, 8 * np.array([[0.5 * 2 - 1.0, 0.25 * 0 - 1.0]]))
    assert_close(grad_colour, 8 * np.array([[[0.5], [0.25]]]))


@exercise("15.9")
def test_a_longer_piece_of_ray_feels_its_density_more(impl):
    """The factor delta is missing in the gradient by the density."""
    given = np.log([[2.0]]) / 5, np.array([[[7.0]]]), np.array([[5.0]]), np.array([3.0])
    grad_density, _ = impl.volume_render_backward(np.array([[1.0]]), *given)
    assert_close(grad_density, np.array([[5 * 0.5 * (7.0 - 3.0)]]))


@exercise("15.9")
@pytest.mark.parametrize("channels", [1, 2, 4])
def test_gradients_of_volumes_are_central_differences(impl, rng, channels):
    """Channels or rays are mixed; a sample feels those before it."""
    density, spacing = rng.gamma(1.0, 1.0, (3, 6)), rng.uniform(0.2, 1.2, (3, 6))
    colour, background = rng.random((3, 6, channels)), rng.random(channels)
    gradcheck(composited, impl.volume_render_backward, (density, colour, spacing, background),
              differentiable=[0, 1], name="volume_render")


@exercise("15.9")
def test_walls_and_empty_space_have_gradients(impl):
    """A weight, an opacity or T is divided by, and is 0."""
    density = np.array([[0.0, 1e9, 2.0], [0.0, 0.0, 0.0]])
    colour, background = np.array([[[1.0], [3.0], [9.0]]] * 2), np.array([5.0])
    given = density, colour, np.ones((2, 3)), background
    grad_density, grad_colour = impl.volume_render_backward(np.ones((2, 1)), *given)
    # In front of the wall: 1 in place of 3. In empty space: each in place of the background.
    assert_close(grad_density, np.array([[-2.0, 0.0, 0.0], [-4.0, -2.0, 4.0]]))
    assert_close(grad_colour[..., 0], np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]))


@exercise("15.9")
def test_units_of_length_are_free(impl, rng):
    """Density is cut off: 1,000 times as dense, and a 1,000th as long, is the same picture."""
    density, spacing = 1000 * rng.gamma(1.0, 1.0, (3, 6)), rng.uniform(0.2, 1.2, (3, 6)) / 1000
    colour, background = rng.random((3, 6, 2)), rng.random(2)
    given = density / 1000, colour, spacing * 1000, background
    grad = rng.normal(size=(3, 2))
    slow = np.zeros_like(density)
    for at in np.ndindex(*density.shape):
        step = np.zeros_like(density)
        step[at] = 1e-5
        slow[at] = (grad * (composited(given[0] + step, *given[1:])
                            - composited(given[0] - step, *given[1:]))).sum() / 2e-5
    got, _ = impl.volume_render_backward(grad, density, colour, spacing, background)
    assert_close(got, slow / 1000, rtol=1e-5, atol=1e-10)
