"""Whole variance shadows of lab 14, and their gradient, against ray casting and differences."""
import numpy as np
import pytest
import shadow_scenes
from shadow_lights import CONE, PARALLEL, point_at, projected
from shadow_scenes import LIGHTS, PLACE, camera, on_the_ground, scene, small_scene

from course.given import mesh, ray_casting
from course.given.gradcheck import gradcheck
from reference import inverse_rendering, lights, mipmapping, shadow_mapping, variance_shadows
from tests.labs.test_variance_shadows import each_square


def slab():
    """A slanted square without thickness."""
    vertices, faces = mesh.plane(2)
    return vertices @ np.array([[0.9, 0.1, 0.5], [0.0, 1.0, 0.0], [-0.5, 0.2, 0.9]]), faces


def test_a_map_of_integers_moves_like_one_of_floats():
    """Half a step does not fit into an array of integers, and 200^2 not into a byte."""
    rng = np.random.default_rng(0)
    distance_map, motion = rng.integers(1, 200, (4, 5)), rng.integers(-3, 4, (4, 5, 2, 3))
    move = np.array([1, 2, -1])
    expected = variance_shadows.moved_moments(distance_map.astype(float), motion.astype(float),
                                              move.astype(float))
    for kind in np.uint8, np.int64:
        got = variance_shadows.moved_moments(distance_map.astype(kind), motion, move)
        np.testing.assert_allclose(got, expected, rtol=1e-12)


@pytest.mark.parametrize("light", [CONE, PARALLEL])
def test_motion_is_the_slope_of_the_place(light):
    """A sign; a factor of x in y; the distance of another texel; C_33 is left out of w."""
    light = light + np.diag([0, 0, 0, 0.3])
    distance_map = np.random.default_rng(0).uniform(1, 5, (3, 5))
    got = variance_shadows.map_motion(distance_map, light)
    for i, j, axis in np.ndindex(3, 5, 3):
        ends = point_at(j + 0.5, i + 0.5, distance_map[i, j], light, 5, 3) + 1e-5 * np.outer(
            [1, -1], np.eye(3)[axis])
        ahead, behind = projected(ends, light, 5, 3)[0]
        np.testing.assert_allclose(got[i, j, :, axis], (ahead - behind) / 2e-5, 1e-6, atol=1e-8)


def test_the_gradient_is_exact_for_a_map_whose_borders_move_evenly():
    """A part of the way from the position to the shadow is missing, or has another sign."""
    vertices, faces = scene(slab, lift=0.35)
    light, size, radius = LIGHTS["point"](vertices), 48, 2
    settings = variance_shadows.Settings(size, radius, 1e-3)
    points, _ = on_the_ground(vertices, faces, 12, 10, camera())
    _, buffers = variance_shadows.variance_shadow(points, vertices, faces, light, settings)
    motion = variance_shadows.map_motion(buffers.distance_map, light.clip_from_light)

    def looked_up(position):
        moments = variance_shadows.moved_moments(buffers.distance_map, motion,
                                                 -light.rotation @ (position - light.position))
        q = shadow_mapping.to_light(points, position, light.rotation)
        uv = shadow_mapping.map_position(q, light.clip_from_light, size, size) / size
        return moments, np.ascontiguousarray(uv), -q[:, 2]

    def forward(position):
        return variance_shadows.lit_by_moments(*looked_up(position), radius, 1e-3)

    def backward(grad_lit, position):
        return variance_shadows.variance_shadow_backward(grad_lit, buffers, points, light, settings)

    def decisions(position):
        moments, uv, distance = looked_up(position)
        blurred = variance_shadows.box_blur(moments, radius)
        mean, mean_square = mipmapping.texture(blurred, uv, boundary="clamp").T
        return distance > mean, mean_square - mean**2 > 1e-3, np.floor(uv * size - 0.5)

    assert (forward(light.position) < 0.5).any()
    gradcheck(forward, backward, (light.position,), decisions=decisions, name="variance_shadow")


def fitted(place, off, points, size, rates):
    """The bunny's vertices, and a fit to its true shadow at points (N, 3) that begins off place."""
    vertices, faces = scene(lift=0.35)
    target = ray_casting.ray_cast(points, vertices, faces, lights.point_light(place, vertices))
    return vertices, variance_shadows.fit_position(
        target, points, vertices, faces, place + off,
        variance_shadows.Settings(size, size // 32, 1e-3), rates)


@pytest.mark.parametrize("off", [[0.6, 0.4, -0.6], [0.5, -0.5, 0.4]])
def test_a_light_is_found_by_its_shadow(off):
    """The fit ends farther than 2 % of the scene's size from the light."""
    from_above = camera((1.6, 2.8, 0.8))                 # the bunny does not hide its shadow
    points, _ = on_the_ground(*scene(lift=0.35), 64, 64, from_above)
    vertices, path = fitted(PLACE, off, points, 192, inverse_rendering.decay(0.08, 0.1, 100))
    distance = np.linalg.norm(path - PLACE, axis=1) / np.linalg.norm(np.ptp(vertices, axis=0))
    assert distance[0] > 0.15 and distance[-1] < 0.02


@pytest.mark.parametrize("off", [[0.5, -0.4, 0.3], [0.9, -0.9, -0.5]])
def test_the_fit_of_a_low_light_stays_where_a_cone_sees_the_scene(off):
    """A step too far, and the fit ends with point_light's refusal."""
    _, points, _ = shadow_mapping.visible_points(*scene(lift=0.35), camera(), 32, 28)
    vertices, path = fitted(np.array([-3.0, 2.2, 1.0]), off, points, 64,
                            inverse_rendering.decay(0.5, 0.1, 12))
    assert len(path) == 13
    for position in path:
        lights.point_light(position, vertices)


def test_a_light_goes_its_whole_way_or_a_half_of_it():
    """A move that is fine is shortened. One into the scene is refused, or not taken at all."""
    vertices, _ = scene()
    light, move = LIGHTS["point"](vertices), np.array([0.3, 0.2, -0.1])
    moved = variance_shadows.moved_light(light, move, vertices)
    np.testing.assert_allclose(moved.position, PLACE + move)
    light = variance_shadows.moved_light(light, -0.9 * PLACE, vertices)
    np.testing.assert_allclose(light.position, 0.55 * PLACE)
    light = variance_shadows.moved_light(light, np.full(3, np.nan), vertices)
    np.testing.assert_allclose(light.position, 0.55 * PLACE)


def test_what_does_not_fit_a_variance_shadow_is_one_sentence():
    """A map without texels, a blur by half a texel, no point: NaN, or an error from inside."""
    vertices, faces, points, _ = small_scene()
    light = LIGHTS["point"](vertices)

    def refused(match, size=8, radius=1, least_variance=1e-3, points=points, faces=faces,
                target=None):
        target = np.ones(len(points)) if target is None else target
        settings = variance_shadows.Settings(size, radius, least_variance)
        shadow_scenes.refused(match, variance_shadows.position_loss, target, points, vertices,
                              faces, light, settings)

    refused("one number for each point", target=np.ones((len(points), 1)))
    refused("at least one point", points=points[:0])
    refused("finite points", points=points * np.nan)
    refused("before the light", points=points + 2 * PLACE)
    refused("at least one face", faces=faces[:0])
    for radius in 2.5, 1.0, -1, np.inf:
        refused("whole number of texels", radius=radius)
    for least_variance in 0.0, -1.0, np.nan:
        refused("variance above 0", least_variance=least_variance)
    for size in 0, -1, 2.5:
        refused("whole number of rows and columns", size=size)


def test_a_fit_of_no_steps_stays():
    """An empty schedule: an error from inside."""
    vertices, faces, points, _ = small_scene()
    path = variance_shadows.fit_position(np.ones(len(points)), points, vertices, faces, PLACE,
                                         variance_shadows.Settings(8, 1, 1e-3), [])
    np.testing.assert_array_equal(path, [PLACE])


@pytest.mark.parametrize("radius", [0, 1, 2, 3, 9])
@pytest.mark.parametrize(("windows", "of"), [(variance_shadows.window_sums, np.sum),
                                             (variance_shadows.box_blur, np.mean)])
def test_sums_and_blurs_are_those_of_every_square(windows, of, radius):
    """Rows alone, or columns alone. A square is one pixel too wide, or larger than the picture. The
    border is wrapped, or its sum is divided by the pixels of a whole square. Channels are mixed.
    """
    picture = np.random.default_rng(radius).normal(size=(5, 8, 3))
    expected = each_square(picture, radius, lambda part: of(part, (0, 1)))
    np.testing.assert_allclose(windows(picture, radius), expected)
