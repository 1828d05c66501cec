"""Whole shadows of lab 14, against ray casting, point lights and differences."""
import doctest

import numpy as np
import pytest

from course.given import mesh, ray_casting
from course.given.gradcheck import gradcheck
from reference import mipmapping, shadow_mapping, transforms


def scene(load=mesh.bunny, lift=0.0):
    """A mesh over a square ground: vertices, faces; the last two faces are the ground."""
    vertices, faces = load()
    vertices = 0.7 * mesh.normalize(vertices)
    vertices = vertices + [0, lift - vertices[:, 1].min(), 0]
    ground, ground_faces = mesh.plane(2)
    return (np.concatenate([vertices, 1.6 * ground]),
            np.concatenate([faces, ground_faces + len(vertices)]))


def camera(eye=(0.2, 2.4, 2.6)):
    view = transforms.look_at(np.array(eye), np.array([0.2, 0.1, -0.1]), np.array([0.0, 1.0, 0.0]))
    return transforms.perspective(np.radians(50), 1.0, 0.1, 20.0) @ view


PLACE = np.array([-1.2, 3.2, 0.5])
LIGHTS = {"point": lambda vertices: shadow_mapping.point_light(PLACE, vertices),
          "direction": lambda vertices: shadow_mapping.directional_light(-PLACE, vertices)}
each_light = pytest.mark.parametrize("light", LIGHTS.values(), ids=LIGHTS)


def toward_light(points, light):
    """From points (N, 3) to a point light, or far along the direction that light comes from."""
    position, rotation, clip_from_light = light
    parallel = clip_from_light[3, 2] == 0
    return np.broadcast_to(10 * rotation[2], points.shape) if parallel else position - points


def blocked(origin, toward, a, b, c):
    """Moeller and Trumbore 1997: does a ray (3,) meet one of the faces a b c, each (F, 3)?"""
    ab, ac, start = b - a, c - a, origin - a
    p, r = np.cross(toward, ac), np.cross(start, ab)
    with np.errstate(all="ignore"):
        inverse = 1 / (ab * p).sum(1)
        u, v, t = (start * p).sum(1) * inverse, r @ toward * inverse, (ac * r).sum(1) * inverse
    return ((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-6) & (t <= 1)).any()


@each_light
@pytest.mark.parametrize("cells", [1, 7, 64])
def test_ray_casting_is_that_of_every_ray_with_every_face(light, cells):
    """A face is missing from a cell, or the distance along a ray is wrong."""
    vertices, faces = scene(lambda: mesh.torus(100), lift=0.2)
    light = light(vertices)
    _, points, _ = shadow_mapping.visible_points(vertices, faces, camera(), 24, 20)
    expected = [not blocked(point, toward, *vertices[faces.T])
                for point, toward in zip(points, toward_light(points, light), strict=True)]
    got = ray_casting.ray_cast(points, vertices, faces, light, cells)
    np.testing.assert_array_equal(got, expected)
    assert 0.04 < np.mean(~got) < 0.9


def test_errors_are_counted_by_kind():
    """The two are swapped, or counted as shares of the wrong, the lit or the dark pixels."""
    lit = np.array([True] * 5 + [False] * 5)
    truth = np.array([True] * 3 + [False] * 3 + [True] + [False] * 3)
    assert ray_casting.error_shares(lit, truth) == (0.1, 0.2)
    assert ray_casting.error_shares(lit, lit) == (0, 0)


def test_places_fill_the_disc_evenly():
    """More places to an area in the middle than at the rim; or they lean to one side."""
    offsets = ray_casting.disc_offsets(400)
    from_middle = np.sort(np.hypot(*offsets.T))
    np.testing.assert_allclose(from_middle, np.sqrt((np.arange(400) + 0.5) / 400))
    np.testing.assert_allclose(offsets.mean(0), 0, atol=0.005)
    apart = np.linalg.norm(offsets[:, None] - offsets, axis=-1) + 9 * np.eye(400)
    assert apart.min() > 1.4 / np.sqrt(400)              # a grid would have sqrt(pi / 400)


@each_light
def test_the_map_holds_the_nearest_surface(light):
    """The greatest depth, as the lecture has it: then the ground is never in shadow."""
    vertices, faces = mesh.plane(2)
    both = np.concatenate([vertices, 0.3 * vertices + [0, 1.0, 0]])
    light = light(both)
    distance_map = shadow_mapping.depth_map(both, np.concatenate([faces, faces + 4]), light, 64)
    alone = shadow_mapping.depth_map(both, faces, light, 64)
    nearer = distance_map < alone
    assert 0.02 < nearer.mean() < 0.3 and (distance_map[~nearer] == alone[~nearer]).all()
    x, y = shadow_mapping.map_position(
        shadow_mapping.to_light(both, *light[:2]), light[2], 64, 64)
    assert (np.minimum(x, y) >= 0).all() and (np.maximum(x, y) <= 64).all()


@each_light
def test_hard_shadows_come_near_ray_casting(light):
    """A map that is off by half a texel, or a bias that is too large, does not converge."""
    vertices, faces = scene()
    light = light(vertices)
    _, points, normals = shadow_mapping.visible_points(vertices, faces, camera(), 160, 128)
    facing = (normals * toward_light(points, light)).sum(1) > 0
    truth = ray_casting.ray_cast(points, vertices, faces, light)[facing]
    wrong = []
    for size in 64, 256, 1024:
        lit = shadow_mapping.hard_shadow(points, normals, vertices, faces, light, size, 1e-3)
        wrong.append(sum(ray_casting.error_shares(lit[facing], truth)))
    assert wrong[0] > 1.5 * wrong[1] and wrong[1] > 2 * wrong[2]
    assert wrong[2] < 0.005


def test_without_bias_a_surface_shadows_itself():
    """Acne is not shown; or the slope's bias does not cure it."""
    vertices, faces = scene()
    light = LIGHTS["point"](vertices)
    face_index, points, normals = shadow_mapping.visible_points(vertices, faces, camera(), 96, 80)
    ground = face_index[face_index >= 0] >= len(faces) - 2
    truth = ray_casting.ray_cast(points, vertices, faces, light)[ground]

    def wrong(constant, factor):
        lit = shadow_mapping.hard_shadow(points, normals, vertices, faces, light, 256, constant,
                                         factor)
        return ray_casting.error_shares(lit[ground], truth)

    assert wrong(0.0, 0.0)[0] > 0.25                    # nearly every other pixel that is lit
    assert wrong(1e-4, 1.0)[0] < 0.005
    assert wrong(0.5, 0.0)[1] > 5 * wrong(1e-4, 1.0)[1]  # a leak


def test_soft_shadows_come_near_256_point_lights():
    """PCSS is no better than one point light, or than one blur for all."""
    vertices, faces = scene(lambda: mesh.icosphere(80), lift=0.4)
    light, radius = LIGHTS["point"](vertices), 0.3
    face_index, points, normals = shadow_mapping.visible_points(vertices, faces, camera(), 32, 28)
    ground = face_index[face_index >= 0] >= len(faces) - 2
    points, normals = points[ground], normals[ground]
    offsets = ray_casting.disc_offsets(256)
    truth = ray_casting.area_light_truth(points, vertices, faces, light, radius, offsets)
    soft = shadow_mapping.soft_shadow(points, normals, vertices, faces, light, radius, 512, 2e-3,
                                      offsets[::2])
    hard = shadow_mapping.hard_shadow(points, normals, vertices, faces, light, 512, 2e-3)
    error, error_of_hard = (np.sqrt(np.mean((lit - truth)**2)) for lit in (soft, hard))
    assert error < 0.04 and error < error_of_hard / 3


def test_a_flat_blocker_has_the_border_of_its_disc():
    """PCSS measures the border on another plane, or by the diameter."""
    ground, faces = mesh.plane(2)
    edge = 2.0 * ground * [1, 0, 1] + [2.0, 1.0, 0.0]              # a half plane: x > 0, at y = 1
    vertices, faces = np.concatenate([ground, edge]), np.concatenate([faces, faces + 4])
    light = shadow_mapping.point_light([0.0, 4.0, 0.0], np.concatenate([ground, -edge, edge]))
    points = np.column_stack([np.linspace(-0.2, 0.2, 41), np.zeros((41, 2))])
    soft = shadow_mapping.soft_shadow(points, np.tile([0.0, 1.0, 0.0], (41, 1)), vertices, faces,
                                      light, 0.3, 1024, 1e-3, ray_casting.disc_offsets(400))
    # The disc of radius 0.3 is cut at 3 x from its middle: the light is 3 times as far from the
    # edge as the ground. The lit share is that of a circle's segment.
    cut = np.clip(-3 * points[:, 0] / 0.3, -1, 1)
    np.testing.assert_allclose(soft, 0.5 + (np.arcsin(cut) + cut * np.sqrt(1 - cut**2)) / np.pi,
                               atol=0.025)


def slab():
    """A slanted square without thickness."""
    vertices, faces = mesh.plane(2)
    return vertices @ np.array([[0.9, 0.1, 0.5], [0.0, 1.0, 0.0], [-0.5, 0.2, 0.9]]), faces


def on_the_ground(load, light, size):
    """A shadow on the ground, weighted: loss of the position -> loss and buffers, the light, and
    backward by its position.
    """
    vertices, faces = scene(load, lift=0.35)
    light = light(vertices)
    face_index, points, _ = shadow_mapping.visible_points(vertices, faces, camera(), 96, 80)
    points = points[face_index[face_index >= 0] >= len(faces) - 2]
    weight = np.sin(2 * points @ [1.0, 0.0, 0.4]) / len(points)
    how = size, 6, 1e-3

    def loss(position):
        lit, buffers = shadow_mapping.variance_shadow(
            points, vertices, faces, (position, *light[1:]), *how)
        return weight @ lit, buffers

    def backward():
        return shadow_mapping.variance_shadow_backward(weight, loss(light[0])[1], points, light,
                                                       *how[1:])

    return loss, light, backward


def gradient_error(load, size):
    """Backward less differences, relative. A single texel jumps: the steps are some texels long."""
    loss, light, backward = on_the_ground(load, LIGHTS["point"], size)
    slopes = np.zeros(3)
    for axis, step in np.ndindex(3, 4):
        h = np.eye(3)[axis] * (0.05 + 0.01 * step)
        slopes[axis] += (loss(light[0] + h)[0] - loss(light[0] - h)[0]) / (2 * h.sum()) / 4
    return np.linalg.norm(backward() - slopes) / np.linalg.norm(slopes)


@pytest.mark.parametrize(("load", "within"), [(slab, 0.05), (mesh.bunny, 0.15)],
                         ids=["slab", "bunny"])
def test_the_gradient_of_the_position_is_the_slope_of_the_shadow(load, within):
    """The border's motion is left out, or counted twice: the rest even has the wrong sign."""
    assert gradient_error(load, 320) < within


def test_at_a_round_rim_a_finer_map_has_a_better_gradient():
    """The error of a rim that moves too fast is not that of the texels, and stays."""
    error = [gradient_error(lambda: mesh.icosphere(1280), size) for size in (120, 480)]
    assert error[1] < 0.8 * error[0]


def test_the_place_of_parallel_light_has_no_gradient(monkeypatch):
    """The map does not move with the receivers: a shadow of the sun that follows its position."""
    _, _, backward = on_the_ground(mesh.bunny, LIGHTS["direction"], 320)
    whole, motion = backward(), shadow_mapping.map_motion
    monkeypatch.setattr(shadow_mapping, "map_motion", lambda *given: 0 * motion(*given))
    assert np.linalg.norm(whole) < 0.03 * np.linalg.norm(backward())


def test_the_gradient_is_exact_for_a_map_whose_borders_move_evenly():
    """A part of the way from the position to the shadow is missing, or has another sign."""
    vertices, faces = scene(slab, lift=0.35)
    light, size, radius = LIGHTS["point"](vertices), 48, 2
    face_index, points, _ = shadow_mapping.visible_points(vertices, faces, camera(), 12, 10)
    points = points[face_index[face_index >= 0] >= len(faces) - 2]
    _, buffers = shadow_mapping.variance_shadow(points, vertices, faces, light, size, radius, 1e-3)
    distance_map = buffers[0]
    motion = shadow_mapping.map_motion(distance_map, light[2])

    def looked_up(position):
        moments = shadow_mapping.moved_moments(distance_map, motion,
                                               -light[1] @ (position - light[0]))
        q = shadow_mapping.to_light(points, position, light[1])
        uv = np.stack(shadow_mapping.map_position(q, light[2], size, size), -1) / size
        blurred = shadow_mapping.box_blur(moments, radius)
        return -q[:, 2], *mipmapping.texture(blurred, uv, boundary="clamp").T, uv

    def forward(position):
        return shadow_mapping.chebyshev(*looked_up(position)[:3], 1e-3)

    def backward(grad_lit, position):
        return shadow_mapping.variance_shadow_backward(grad_lit, buffers, points, light, radius,
                                                       1e-3)

    def decisions(position):
        distance, mean, mean_square, uv = looked_up(position)
        return distance > mean, mean_square - mean**2 > 1e-3, np.floor(uv * size - 0.5)

    assert (forward(light[0]) < 0.5).any()
    gradcheck(forward, backward, (light[0],), decisions=decisions, name="variance_shadow")


@pytest.mark.parametrize("off", [[0.6, 0.4, -0.6], [0.5, -0.5, 0.4]])
def test_a_light_is_found_by_its_shadow(off):
    """The fit ends farther than 2 % of the scene's size from the light."""
    vertices, faces = scene(lift=0.35)
    from_above = camera((1.6, 2.8, 0.8))                 # the bunny does not hide its shadow
    face_index, points, _ = shadow_mapping.visible_points(vertices, faces, from_above, 64, 64)
    points = points[face_index[face_index >= 0] >= len(faces) - 2]
    target = ray_casting.ray_cast(points, vertices, faces, LIGHTS["point"](vertices))
    path = shadow_mapping.fit_position(target, points, vertices, faces, PLACE + off, 192, 100,
                                       0.08, 6, 1e-3)
    size = np.linalg.norm(np.ptp(vertices, axis=0))
    distance = np.linalg.norm(path - PLACE, axis=1) / size
    assert distance[0] > 0.15 and distance[-1] < 0.02


@pytest.mark.parametrize("off", [[0.5, -0.4, 0.3], [0.9, -0.9, -0.5]])
def test_the_fit_of_a_low_light_stays_where_a_cone_sees_the_scene(off):
    """A step too far, and the fit ends with point_light's refusal."""
    vertices, faces = scene(lift=0.35)
    place = np.array([-3.0, 2.2, 1.0])
    _, points, _ = shadow_mapping.visible_points(vertices, faces, camera(), 32, 28)
    target = ray_casting.ray_cast(points, vertices, faces,
                                  shadow_mapping.point_light(place, vertices))
    path = shadow_mapping.fit_position(target, points, vertices, faces, place + off, 64, 12, 0.5, 3,
                                       1e-3)
    for position in path:
        shadow_mapping.point_light(position, vertices)


def test_a_light_goes_its_whole_way_or_a_half_of_it():
    """A move that is fine is shortened; one into the scene is refused, or not taken at all."""
    vertices, _ = scene()
    light, move = LIGHTS["point"](vertices), np.array([0.3, 0.2, -0.1])
    np.testing.assert_allclose(shadow_mapping.moved_light(light, move, vertices)[0], PLACE + move)
    light = shadow_mapping.moved_light(light, -0.9 * PLACE, vertices)
    np.testing.assert_allclose(light[0], 0.55 * PLACE)
    light = shadow_mapping.moved_light(light, np.full(3, np.nan), vertices)
    np.testing.assert_allclose(light[0], 0.55 * PLACE)


@each_light
def test_broken_meshes_have_the_same_shadow(light):
    """Vertices of no face, repeated ones, faces without area, faces turned over, or twice."""
    vertices, faces = scene(lambda: mesh.icosphere(80), lift=0.2)
    light = light(vertices)

    def shadow(vertices, faces):
        _, *seen = shadow_mapping.visible_points(vertices, faces, camera(), 40, 32)
        return shadow_mapping.hard_shadow(*seen, vertices, faces, light, 128, 1e-3)

    expected = shadow(vertices, faces)
    assert 0.05 < (~expected).mean() < 0.5
    more = np.concatenate([vertices, vertices, [[0.0, 0.5, 0.0]]])
    turned = faces.copy()
    turned[::3] = turned[::3, ::-1]
    degenerate = np.concatenate([faces, [[0, 0, 1], [2, 2, 2]], faces[:5]])
    split = (faces + len(vertices) * (np.arange(len(faces)) % 2)[:, None])
    for broken in (more, faces), (vertices, turned), (vertices, degenerate), (more, split):
        np.testing.assert_array_equal(shadow(*broken), expected)


@each_light
def test_the_map_is_around_the_scene_and_filled_by_it(light):
    """Vertices lie outside, or a side of the map stays empty."""
    vertices, _ = scene()
    position, rotation, clip_from_light = light(vertices)
    q = shadow_mapping.to_light(vertices, position, rotation)
    clip = transforms.transform(transforms.to_homogeneous(q), clip_from_light)
    ndc = clip[:, :3] / clip[:, 3:]
    assert np.abs(ndc).max() < 1
    low, high = ndc[:, :2].min(0), ndc[:, :2].max(0)
    assert np.abs(low + high).max() < 0.15 and (high - low).max() > 1.8


@each_light
def test_a_scene_on_the_axis_of_the_light_has_a_map(light):
    """A map without width: division by 0."""
    vertices = PLACE * np.array([[0.2], [0.1], [-0.1]])
    light = light(vertices)
    assert np.isfinite(light[2]).all()
    assert np.isinf(shadow_mapping.depth_map(vertices, np.array([[0, 1, 2]]), light, 8)).all()


def test_what_cannot_be_done_is_one_sentence():
    """A picture of NaN, or a traceback from inside, in place of what to do."""
    vertices, faces = scene(lambda: mesh.icosphere(20))
    for light in LIGHTS.values():
        for broken in np.zeros((0, 3)), np.ones((4, 3)), np.where(vertices < 0, np.nan, vertices):
            with pytest.raises(ValueError, match="give it the vertices"):
                light(broken)
    for position in [0.3, 0.5, 0.2], (vertices.min(0) + vertices.max(0)) / 2, vertices[3]:
        with pytest.raises(ValueError, match="move it"):
            shadow_mapping.point_light(position, vertices)
    with pytest.raises(ValueError, match="expects a direction"):
        shadow_mapping.directional_light(np.zeros(3), vertices)
    vertices[2, 1] = np.nan
    with pytest.raises(ValueError, match="must be finite"):
        shadow_mapping.visible_points(vertices, faces, camera(), 8, 8)


def test_what_does_not_fit_a_shadow_is_one_sentence():
    """Lists, NaN, a face of no vertex, the sun as a lamp: wrong shadows, or an error from inside.
    """
    vertices, faces = scene(lambda: mesh.icosphere(20), lift=0.3)
    light, sun = (make(vertices) for make in LIGHTS.values())
    _, points, normals = shadow_mapping.visible_points(vertices, faces, camera(), 8, 8)
    lost, outside = np.full((1, 3), np.nan), faces + 1
    offsets = ray_casting.disc_offsets(4)

    def refused(match, function, *given):
        with pytest.raises(ValueError, match=match):
            function(*given)

    refused("three finite numbers", shadow_mapping.point_light, [np.nan, 3.0, 0.0], vertices)
    refused("three finite numbers", shadow_mapping.point_light, [3.0, 0.0], vertices)
    refused("give it the vertices", shadow_mapping.point_light, PLACE, vertices[:, :2])
    refused("names vertex", shadow_mapping.depth_map, vertices, outside, light, 8)
    refused("names vertex", ray_casting.ray_cast, points, vertices, outside, light)
    refused("finite points", ray_casting.ray_cast, lost, vertices, faces, light)
    refused("finite points", shadow_mapping.receivers, lost, lost, light, 8)
    refused("expects a point light", shadow_mapping.soft_shadow, points, normals, vertices, faces,
            sun, 0.1, 8, 0.01, offsets)
    refused("expects a point light", ray_casting.area_light_truth, points, vertices, faces, sun,
            0.1, offsets)
    refused("at least one place", ray_casting.disc_offsets, 0)
    refused("one number for each point", shadow_mapping.position_loss, np.ones((len(points), 1)),
            points, vertices, faces, light, 8, 1, 1e-3)
    refused("whole number of texels", shadow_mapping.variance_shadow, points, vertices, faces,
            light, 8, 2.5, 1e-3)
    np.testing.assert_array_equal(
        shadow_mapping.depth_map(vertices.tolist(), faces.tolist(), light, 8),
        shadow_mapping.depth_map(vertices, faces, light, 8))
    np.testing.assert_array_equal(
        ray_casting.ray_cast(points.tolist(), vertices.tolist(), faces.tolist(), light),
        ray_casting.ray_cast(points, vertices, faces, light))
    for make in LIGHTS.values():
        assert np.isfinite(make(vertices.tolist())[2]).all()


def test_the_examples_of_ray_casting_are_true():
    """An example that does not give what it shows."""
    assert doctest.testmod(ray_casting).failed == 0


@each_light
def test_light_straight_from_above_has_axes(light):
    """Up is along the look: NaN."""
    vertices, _ = scene(lambda: mesh.icosphere(20))
    middle = (vertices.min(0) + vertices.max(0)) / 2
    for rotation in (shadow_mapping.directional_light([0.0, -1.0, 0.0], vertices)[1],
                     shadow_mapping.point_light(middle + [0.0, 4.0, 0.0], vertices)[1]):
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
        np.testing.assert_allclose(rotation[2], [0, 1, 0], atol=1e-12)
