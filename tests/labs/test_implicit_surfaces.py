"""What the exercises of lab 15 must do."""
import numpy as np
import pytest

from labkit.checks import assert_close, assert_equal, exercise

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


# --- signed distances --------------------------------------------------------------------------

@exercise("15.1")
def test_gradients_outside_of_a_box_on_paper(impl):
    """Outside: it is not divided by its length, which is to be 1. Negative coordinates have no
    sign. grad_distance is left out. The axis of the largest coordinate alone has a gradient, or
    axes within the sides have one. It points away from the middle of the box.
    """
    points = np.array([[3.5, -5.0, 0.25], [-1.5, 0.5, 1.25], [-1.5, 3.0, -3.5], [0.2, 7.0, -9.5]])
    expected = [[1.2, -1.6, 0], [-3.0, 0, 0], [2.0, -4.0, 4.0], [0, 3.0, -4.0]]
    assert_close(impl.box_backward(np.array([2.0, 3.0, -6.0, 5.0]), points, HALF), expected)


@exercise("15.1")
def test_gradients_inside_a_box_on_paper(impl):
    """Inside: the side is chosen by the largest coordinate, where that of the largest |x| -
    half_size is nearest. The gradient is 0, or points inward, to the farthest side or away from
    the middle, or more than one axis has a share.
    """
    points = np.array([[0.1, -0.9, 1.0], [0.2, 0.5, 1.4], [-0.3, 0.4, -0.6], [0.15, 0.8, -0.7]])
    expected = [[0, -5.0, 0], [0, 0, -7.0], [-4.0, 0, 0], [0, 6.0, 0]]
    assert_close(impl.box_backward(np.array([5.0, -7.0, 4.0, 6.0]), points, HALF), expected)


@exercise("15.1", fine_print=True)
def test_on_the_surface_and_in_the_middle_of_a_box(impl):
    """0 / 0 on the surface; sign(0) = 0 in the middle; or equally near sides share."""
    points = np.array([[0.5, 0.3, 0.2], [0.0, -1.0, 0.0], [0.0, 0.0, 0.0], [-0.25, -0.25, 0.0]])
    expected = np.array([[1.0, 0, 0], [0, -1.0, 0], [1.0, 0, 0], [-1.0, 0, 0]])
    assert_close(impl.box_backward(np.ones(4), points, HALF), expected)
    cube, at = np.full(3, 1.0), np.array([[0.2, -0.7, 0.7], [0.0, 0.1, -0.1], [-1.0, -1.0, 1.0]])
    expected = np.array([[0, -1.0, 0], [0, 1.0, 0], [-1.0, 0, 0]])
    assert_close(impl.box_backward(np.ones(3), at, cube), expected)


@exercise("15.1")
def test_gradients_of_a_box_are_central_differences(impl, rng, gradcheck):
    """Near an edge outside, an axis on which the point lies between the sides has a part."""
    def forward(points, half):
        return np.array([[distance_to_box(point, half) for point in row] for row in points])

    def decisions(points, half):
        beyond = np.abs(points) - half
        return beyond > 0, (beyond.max(-1) > 0) * 3 + (beyond.max(-1) <= 0) * beyond.argmax(-1)

    points, half = rng.uniform(-1, 1, (4, 12, 3)) * [3.0, 1.2, 2.0], np.array([2.0, 0.7, 1.3])
    gradcheck(forward, impl.box_backward, (points, half), differentiable=[0], decisions=decisions,
              name="box")


@exercise("15.1")
def test_one_point_has_one_gradient(impl):
    """One point (3,) is an error: rows are counted."""
    got = impl.box_backward(np.array(2.0), np.array([0.1, -0.9, 1.0]), HALF)
    assert_close(got, [0.0, -2.0, 0.0])


@exercise("15.2")
def test_gradients_of_a_ring_on_paper(impl):
    """x and z lack a part of (from_axis - radius) / from_axis. It is not divided by the distance
    from the circle, or tube is taken from that first. The axis is not y. In the hole x and z point
    away from the axis. grad_distance is left out.
    """
    points = np.array([[3.0, 3.0, 4.0], [8.0, 0.75, -6.0], [-5.0, -3.0, 12.0], [9.0, 8.0, 12.0]])
    assert_close(impl.torus_backward(np.array([10.0, 5.0, 13.0, -20.0]), points, 9.0, 1.0),
                 [[-4.8, 6.0, -6.4], [3.2, 3.0, -2.4], [-4.0, -7.8, 9.6], [-7.2, -16.0, -9.6]])


@exercise("15.2", fine_print=True)
def test_on_the_axis_and_in_the_middle_of_the_tube_nothing_is_divided_by_0(impl):
    """NaN where there is no direction."""
    points = np.array([[0.0, 0.0, 0.0], [0.0, 12.0, 0.0], [0.0, 0.0, -5.0]])
    expected = [[0, 0, 0], [0, 12 / 13, 0], [0, 0, 0]]
    assert_close(impl.torus_backward(np.ones(3), points, 5.0, 1.0), expected)


@exercise("15.2")
def test_gradients_of_a_ring_are_central_differences(impl, rng, gradcheck):
    """A factor of the chain is missing: right where x = 0 or z = 0."""
    gradcheck(distance_to_ring, impl.torus_backward, (rng.uniform(-2, 2, (4, 6, 3)), 1.1, 0.3),
              differentiable=[0], name="torus")


# --- sphere tracing ----------------------------------------------------------------------------

BALLS = np.array([[0.0, 0.0, 0.0], [1.5, 0.3, -0.8]]), np.array([1.0, 0.6])
TWO_BALLS = ("union", ("sphere", 1.0), ("moved", BALLS[0][1], ("sphere", 0.6)))


ALONG_Z = np.array([[0.0, 0.0, 5.0]]), np.array([[0.0, 0.0, -1.0]]), ("sphere", 1.0)


def rays_on_paper():
    """Toward a ball of radius 1, away from it, from within it, from far away and from beside it."""
    origins = np.array([[0.0, 0.0, 5.0], [0.0, 0.0, 5.0], [0.5, 0.0, 0.0], [0.0, 9.0, 12.0],
                        [7.0, 0.0, 0.0], [3.0, 0.0, 0.0]])
    directions = np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -0.6, -0.8],
                           [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    return origins, directions


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


@exercise("15.3")
def test_t_and_evaluations_are_two_outputs(impl):
    """One output alone is returned, or the two outputs are exchanged: t comes first, then the
    number of evaluations, integers.
    """
    found = impl.sphere_trace(*rays_on_paper(), ("sphere", 1.0), 20.0)
    kinds = tuple({"f": "floats", "i": "integers"}.get(np.asarray(output).dtype.kind, "others")
                  for output in (found if isinstance(found, tuple) else [found]))
    assert_equal(kinds, ("floats", "integers"))


@exercise("15.3")
def test_places_of_hits_on_paper(impl):
    """t is one step too far, for it moves before s is compared. A miss is not np.inf. A ray that
    begins inside is no hit, since |s| is compared. One ray ends them all. t does not begin at 0, or
    is no length.
    """
    t = impl.sphere_trace(*rays_on_paper(), ("sphere", 1.0), 20.0)[0]
    assert_close(t, [4.0, np.inf, 0.0, 14.0, 6.0, np.inf])


# s = 4, 2, 1, 1/2, 1/4, ...; t = 0, 2, 3, 3.5, 3.75, ...
HALF_STEPS = [  # far, epsilon, most, t, evaluations
    (9.0, 0.3, 99, 3.75, 5), (9.0, 0.5, 99, 3.75, 5), (9.0, 0.6, 99, 3.5, 4),
    (9.0, 0.3, 5, 3.75, 5), (9.0, 0.3, 4, np.inf, 4), (3.75, 0.3, 99, 3.75, 5),
    (3.7, 0.3, 99, np.inf, 4), (3.7, 0.5, 99, np.inf, 4)]


def check_half_steps(impl, rows):
    """Compare t, of these rows of HALF_STEPS."""
    for far, epsilon, most, t, _ in rows:
        got = impl.sphere_trace(*ALONG_Z, far, lipschitz=2.0, epsilon=epsilon, most=most)
        assert_close(got[0], [t])


@exercise("15.3")
def test_half_a_step_comes_nearer_by_half(impl):
    """The step is not divided by L, or is multiplied by it. It takes the place of t and is not
    added. s / L is compared with epsilon, or the last step, or epsilon is not used. s = epsilon is
    taken for a hit.
    """
    check_half_steps(impl, HALF_STEPS[:3])


@exercise("15.3")
def test_a_ray_misses_after_most_evaluations(impl):
    """A ray that is used up after `most` evaluations is taken for a hit where it stands. Or one
    evaluation more, or one fewer, than `most` is made, or `most` is not looked at.
    """
    check_half_steps(impl, HALF_STEPS[3:5])


@exercise("15.3")
def test_a_ray_misses_past_far(impl):
    """t > far is not looked at, or too late: a hit beyond far counts. s or one step is compared
    with far and not t, the way from the start. Or t = far is taken for a miss.
    """
    check_half_steps(impl, HALF_STEPS[5:])


@exercise("15.3")
def test_evaluations_on_paper(impl):
    """The evaluation that finds the hit is not counted. Rays that are done are counted on, as long
    as any ray is on its way. A miss goes on, and is evaluated beyond far. It begins at 1.
    """
    assert_equal(impl.sphere_trace(*rays_on_paper(), ("sphere", 1.0), 20.0)[1], [2, 3, 1, 2, 2, 4])


@exercise("15.3")
def test_half_a_step_takes_more_evaluations(impl):
    """The evaluation of a hit, or the one before a miss, is not counted, or one more is: t > far
    ends a ray before s is evaluated there, and so do `most` evaluations.
    """
    for far, epsilon, most, _, evaluations in HALF_STEPS:
        got = impl.sphere_trace(*ALONG_Z, far, lipschitz=2.0, epsilon=epsilon, most=most)
        assert_equal(got[1], [evaluations])


@exercise("15.3")
def test_too_long_a_step_goes_through(impl):
    """L below 1 is taken for 1: nothing then shows what a wrong L does."""
    t, evaluations = impl.sphere_trace(*ALONG_Z, 20.0, lipschitz=0.5)
    assert_close(t, [np.inf])  # s = 4, t = 8; s = 2, t = 12; s = 6, t = 24
    assert_equal(evaluations, [3])
    t, _ = impl.sphere_trace(*ALONG_Z, 20.0, lipschitz=0.8)
    assert_close(t, [5.0])     # inside: it has hit, and this t is its t


@exercise("15.3")
def test_rays_to_two_balls_stop_where_quadratic_equations_say(impl, rng):
    """The farther ball is hit through the nearer one; or t is off by a step."""
    origins, directions = rays(rng, 60)
    b = ((origins[:, None] - BALLS[0]) * directions[:, None]).sum(-1)
    c = ((origins[:, None] - BALLS[0])**2).sum(-1) - BALLS[1]**2
    root = np.sqrt(np.maximum(b**2 - c, 0))
    clear = (np.abs(b**2 - c) > 0.02).all(1)
    t, _ = impl.sphere_trace(origins[clear], directions[clear], TWO_BALLS, 9.0, epsilon=1e-9)
    assert_close(t, np.where(b**2 > c, -b - root, np.inf).min(1)[clear], atol=1e-7)


@exercise("15.3")
def test_each_ray_goes_its_own_way(impl, rng):
    """Rays that are done go on, or wait for others; evaluations are those of the slowest ray."""
    origins, directions = rays(rng, 40)
    for lipschitz, epsilon, most in (1.0, 1e-5, 200), (1.7, 1e-3, 9):
        given = 5.0, lipschitz, epsilon, most
        expected = [traced(o, d, *given) for o, d in zip(origins, directions, strict=True)]
        t, evaluations = impl.sphere_trace(origins, directions, TWO_BALLS, *given)
        assert_close(t, [ray[0] for ray in expected])
        assert_equal(evaluations, [ray[1] for ray in expected])


@exercise("15.3")
def test_the_defaults_are_those_of_the_question(impl, rng):
    """Another L, epsilon or number of steps than the signature has."""
    origins, directions = rays(rng, 40)
    expected = [traced(*ray, 9.0, 1.0, 1e-5, 200)[0]
                for ray in zip(origins, directions, strict=True)]
    assert_close(impl.sphere_trace(origins, directions, TWO_BALLS, 9.0)[0], expected)
    _, evaluations = impl.sphere_trace(origins[:1], directions[:1], TWO_BALLS, 9.0, 1000.0)
    assert_equal(evaluations, [200])


@exercise("15.3")
def test_as_many_evaluations_as_are_allowed(impl):
    """A limit of one's own, or far is cut."""
    _, evaluations = impl.sphere_trace(*ALONG_Z, 9.0, lipschitz=1e4, most=700)
    assert_equal(evaluations, [700])


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


@exercise("15.4")
def test_weights_on_paper(impl):
    """T holds the sample's own density, those behind it, or other rays. The opacity is its first
    order, sigma delta. T, 1 - exp, a minus or spacing is left out. The weights are scaled to sum to
    1. T_end is that before the last sample.
    """
    # T: what is left of the light before the first sample, behind it, the second and the third.
    passed = np.array([[1.0, 0.5, 0.4, 0.1], [1.0, 0.9, 0.6, 0.2], [1.0, 0.7, 0.3, 0.25],
                       [1.0, 0.8, 0.15, 0.05]])
    spacing = np.array([[0.5, 2.0, 4.0], [3.0, 0.25, 1.5], [0.2, 1.25, 0.8], [5.0, 0.4, 2.5]])
    weights = [[0.5, 0.1, 0.3], [0.1, 0.3, 0.4], [0.3, 0.4, 0.05], [0.2, 0.65, 0.1]]
    density = -np.log(passed[:, 1:] / passed[:, :-1]) / spacing
    assert_close(impl.ray_weights(density, spacing), (weights, [0.1, 0.2, 0.25, 0.05]))


@exercise("15.4")
def test_light_is_neither_lost_nor_made(impl, rng):
    """The sum of a ray's weights and of its remaining light is 1; nothing is negative."""
    weights, remaining = impl.ray_weights(rng.gamma(0.5, 4.0, (5, 9)), rng.uniform(0.1, 2, (5, 9)))
    assert_close(np.sum(weights, -1) + remaining, np.ones(5))
    assert_equal(np.min(weights) >= 0, True)


@exercise("15.4")
def test_weights_are_those_of_light_that_goes_from_sample_to_sample(impl, rng):
    """Rays are mixed, or spacing counts where it is constant alone."""
    density, spacing = rng.gamma(0.5, 2.0, (5, 7)), rng.uniform(0.1, 1, (5, 7))
    weights, remaining = impl.ray_weights(density, spacing)
    each = np.broadcast_to(np.eye(7), (5, 7, 7))
    assert_close(weights, composited(density, each, spacing, np.zeros(7)))
    assert_close(remaining, composited(density, np.zeros((5, 7, 1)), spacing, np.ones(1))[:, 0])


@exercise("15.4")
def test_behind_a_wall_is_nothing(impl):
    """inf, NaN or a rest of 1e-10 behind an opaque sample."""
    density = np.array([[1.0, 1e12, 3.0], [0.0, 0.0, 0.0]])
    weights, remaining = impl.ray_weights(density, np.ones((2, 3)))
    near = np.exp(-1.0)
    assert_close(weights, [[1 - near, near, 0.0], [0, 0, 0]])
    assert_close(remaining, [0.0, 1.0])


@exercise("15.4", fine_print=True)
def test_thick_and_short_pieces(impl):
    """T is a sum less its last term, and a wall has taken the digits; or density is cut off."""
    weights, remaining = impl.ray_weights(np.array([[0.3, 1e17, 3.0], [5e4, 0.0, 1e5]]),
                                          np.array([[1.0, 1.0, 1.0], [1e-5, 1e-5, 1e-5]]))
    a, b, c = np.exp([-0.3, -0.5, -1.0])
    assert_close(weights, [[1 - a, a, 0], [1 - b, 0, b * (1 - c)]])
    assert_close(remaining, [0.0, b * c])


PASSED = np.array([[1.0, 0.5, 0.4, 0.1], [1.0, 0.9, 0.6, 0.2]])  # T before and behind 3 samples
GRAD_OUTPUT = np.array([[10.0, 1.0, -2.0], [2.0, -3.0, 1.0]])


def two_rays():
    """density, colour (2, 3, 3), spacing and background, as `volume_render_backward` takes them."""
    spacing = np.array([[0.5, 2.0, 4.0], [3.0, 0.25, 1.5]])
    density = -np.log(PASSED[:, 1:] / PASSED[:, :-1]) / spacing
    colour = np.array([[[1.0, 2, 1], [3, 5, 4], [2, 7, 5]], [[5, 1, 2], [6, 2, 4], [3, 4, 7]]])
    return density, colour, spacing, np.array([4.0, 6.0, 3.0])


@exercise("15.5")
def test_through_empty_space_comes_the_background(impl, rng):
    """The background is left out, or what fog has no density counts."""
    given = np.zeros((4, 6)), rng.random((4, 6, 3)), rng.uniform(0.1, 1, (4, 6)), rng.random(3)
    assert_close(impl.volume_render(*given), np.tile(given[3], (4, 1)))


@exercise("15.5")
def test_one_piece_stands_before_the_background(impl, rng):
    """All of the background is added, and not what is left of its light. spacing does not count.
    The opacity is sigma delta, its first order, or the share that passes is taken for it.
    """
    density, spacing = rng.gamma(1.0, 1.0, (5, 1)), rng.uniform(0.1, 2, (5, 1))
    colour, background = rng.random((5, 1, 3)), rng.random(3)
    passed = np.exp(-density * spacing)
    assert_close(impl.volume_render(density, colour, spacing, background),
                 (1 - passed) * colour[:, 0] + passed * background)


@exercise("15.5")
def test_colours_of_two_rays_on_paper(impl):
    """T is left out, so that nothing hides what is behind. It holds the sample's own density, or
    those behind it, as if the last sample were the nearest. The weights are scaled to sum to 1.
    """
    assert_close(impl.volume_render(*two_rays()), [[1.8, 4.2, 2.7], [4.3, 3.5, 4.8]])


@exercise("15.5")
@pytest.mark.parametrize("channels", [1, 2, 4])
def test_colours_are_those_of_light_that_goes_from_sample_to_sample(impl, rng, channels):
    """Rays or channels are mixed, or spacing counts where it is constant alone."""
    density, spacing = rng.gamma(0.5, 2.0, (5, 7)), rng.uniform(0.1, 1, (5, 7))
    given = density, rng.random((5, 7, channels)), spacing, rng.random(channels)
    assert_close(impl.volume_render(*given), composited(*given))


@exercise("15.6")
def test_gradients_of_densities_on_paper(impl):
    """grad_density: of what becomes hidden the background or the samples behind are left out, are
    added, or lack their T. Or it holds the sample itself, or those in front. T before the sample,
    or its weight, stands for T behind it. spacing or grad_output is missing.
    """
    # The loss feels the colours as 10, 27, 17 and 40; 9, 10, 1 and -7. Behind each sample is
    # 11.8, 9.1, 4; 2, -1, -1.4.
    expected = [[0.5 * (0.5 * 10 - 11.8), 2 * (0.4 * 27 - 9.1), 4 * (0.1 * 17 - 4)],
                [3 * (0.9 * 9 - 2), (0.6 * 10 + 1) / 4, 1.5 * (0.2 * 1 + 1.4)]]
    assert_close(impl.volume_render_backward(GRAD_OUTPUT, *two_rays())[0], expected)


@exercise("15.6")
def test_gradients_of_colours_on_paper(impl):
    """grad_colour: the weights are missing, or T or the opacity alone stands for them, or it is
    multiplied by the colour or by spacing; or grad_output is missing.
    """
    weights = np.array([[0.5, 0.1, 0.3], [0.1, 0.3, 0.4]])
    got = impl.volume_render_backward(GRAD_OUTPUT, *two_rays())[1]
    assert_close(got, weights[..., None] * GRAD_OUTPUT[:, None])


@exercise("15.6")
def test_a_longer_piece_of_ray_feels_its_density_more(impl):
    """The factor delta is missing in the gradient with respect to the density."""
    given = np.log([[2.0]]) / 5, np.array([[[7.0]]]), np.array([[5.0]]), np.array([3.0])
    grad_density, _ = impl.volume_render_backward(np.array([[1.0]]), *given)
    assert_close(grad_density, [[5 * 0.5 * (7.0 - 3.0)]])


@exercise("15.6")
@pytest.mark.parametrize("channels", [1, 2, 4])
def test_gradients_of_volumes_are_central_differences(impl, rng, channels, gradcheck):
    """Channels or rays are mixed; a sample feels those before it."""
    density, spacing = rng.gamma(1.0, 1.0, (3, 6)), rng.uniform(0.2, 1.2, (3, 6))
    colour, background = rng.random((3, 6, channels)), rng.random(channels)
    gradcheck(composited, impl.volume_render_backward, (density, colour, spacing, background),
              differentiable=[0, 1], name="volume_render")


@exercise("15.6", fine_print=True)
def test_walls_and_empty_space_have_gradients(impl):
    """A weight, an opacity or T is divided by, and is 0."""
    density = np.array([[0.0, 1e9, 2.0], [0.0, 0.0, 0.0]])
    colour, background = np.array([[[1.0], [3.0], [9.0]]] * 2), np.array([5.0])
    given = density, colour, np.ones((2, 3)), background
    grad_density, grad_colour = impl.volume_render_backward(np.ones((2, 1)), *given)
    # In front of the wall: 1 in place of 3. In empty space: each in place of the background.
    assert_close(grad_density, [[-2.0, 0.0, 0.0], [-4.0, -2.0, 4.0]])
    assert_close(grad_colour[..., 0], [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]])


@exercise("15.6")
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
