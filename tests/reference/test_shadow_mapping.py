"""Whole hard shadows of lab 14, against ray casting."""
import numpy as np
import pytest
import shadow_scenes
from shadow_scenes import LIGHTS, PLACE, camera, each_light, refused, scene, small_scene

from course.given import mesh, ray_casting
from reference import lights, shadow_mapping, soft_shadows


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
    rays = zip(points, shadow_scenes.toward_light(points, light), strict=True)
    expected = [not blocked(*ray, *vertices[faces.T]) for ray in rays]
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
    """More places to an area in the middle than at the rim, or they lean to one side."""
    offsets = ray_casting.disc_offsets(400)
    np.testing.assert_allclose(np.sort(np.hypot(*offsets.T)), np.sqrt((np.arange(400) + 0.5) / 400))
    np.testing.assert_allclose(offsets.mean(0), 0, atol=0.005)
    apart = np.linalg.norm(offsets[:, None] - offsets, axis=-1) + 9 * np.eye(400)
    assert apart.min() > 1.4 / np.sqrt(400)              # a grid would have sqrt(pi / 400)


@each_light
def test_hard_shadows_come_near_ray_casting(light):
    """A map that is off by half a texel, or a bias that is too large, does not converge."""
    vertices, faces = scene()
    light = light(vertices)
    _, points, normals = shadow_mapping.visible_points(vertices, faces, camera(), 160, 128)
    facing = (normals * shadow_scenes.toward_light(points, light)).sum(1) > 0
    truth = ray_casting.ray_cast(points, vertices, faces, light)[facing]
    wrong = []
    for size in 64, 256, 1024:
        distance_map = shadow_mapping.depth_map(vertices, faces, light, size)
        lit = shadow_mapping.hard_shadow(points, normals, light, distance_map, 1e-3)
        wrong.append(sum(ray_casting.error_shares(lit[facing], truth)))
    assert wrong[0] > 1.5 * wrong[1] and wrong[1] > 2 * wrong[2]
    assert wrong[2] < 0.005


@each_light
def test_broken_meshes_have_the_same_shadow(light):
    """Vertices of no face, repeated ones, faces without area, faces turned over, or twice."""
    vertices, faces = scene(lambda: mesh.icosphere(80), lift=0.2)
    light = light(vertices)

    def shadow(vertices, faces):
        _, *seen = shadow_mapping.visible_points(vertices, faces, camera(), 40, 32)
        distance_map = shadow_mapping.depth_map(vertices, faces, light, 128)
        return shadow_mapping.hard_shadow(*seen, light, distance_map, 1e-3)

    expected = shadow(vertices, faces)
    assert 0.05 < (~expected).mean() < 0.5
    more = np.concatenate([vertices, vertices, [[0.0, 0.5, 0.0]]])
    turned = faces.copy()
    turned[::3] = turned[::3, ::-1]
    degenerate = np.concatenate([faces, [[0, 0, 1], [2, 2, 2]], faces[:5]])
    split = (faces + len(vertices) * (np.arange(len(faces)) % 2)[:, None])
    for broken in (more, faces), (vertices, turned), (vertices, degenerate), (more, split):
        np.testing.assert_array_equal(shadow(*broken), expected)


def test_what_cannot_be_done_is_one_sentence():
    """A picture of NaN, or a traceback from inside, in place of what to do."""
    vertices, faces = scene(lambda: mesh.icosphere(20))
    for light in LIGHTS.values():
        for broken in np.zeros((0, 3)), np.ones((4, 3)), np.where(vertices < 0, np.nan, vertices):
            refused("give it the vertices", light, broken)
    for position in [0.3, 0.5, 0.2], (vertices.min(0) + vertices.max(0)) / 2, vertices[3]:
        refused("move it", lights.point_light, position, vertices)
    refused("expects a direction", lights.directional_light, np.zeros(3), vertices)
    vertices[2, 1] = np.nan
    refused("must be finite", shadow_mapping.visible_points, vertices, faces, camera(), 8, 8)


def test_what_does_not_fit_a_shadow_is_one_sentence():
    """Lists, NaN, a face of no vertex, the sun as a lamp: wrong shadows, or an error from inside.
    """
    vertices, faces, points, normals = small_scene()
    light, sun = (make(vertices) for make in LIGHTS.values())
    lost, outside, distance_map = np.full((1, 3), np.nan), faces + 1, np.full((8, 8), 3.0)
    offsets = ray_casting.disc_offsets(4)
    refused("three finite numbers", lights.point_light, [np.nan, 3.0, 0.0], vertices)
    refused("three finite numbers", lights.point_light, [3.0, 0.0], vertices)
    refused("give it the vertices", lights.point_light, PLACE, vertices[:, :2])
    refused("names vertex", shadow_mapping.depth_map, vertices, outside, light, 8)
    refused("names vertex", ray_casting.ray_cast, points, vertices, outside, light)
    refused("finite points", ray_casting.ray_cast, lost, vertices, faces, light)
    refused("finite points", soft_shadows.receivers, lost, lost, light, 8)
    refused("finite points", shadow_mapping.hard_shadow, lost, lost, light, distance_map, 1e-3)
    refused("before the light", soft_shadows.receivers, points + 2 * PLACE, normals, light, 8)
    refused("before the light", soft_shadows.receivers, PLACE[None], normals[:1], light, 8)
    refused("one normal for each point", soft_shadows.receivers, points, normals[:3], light, 8)
    refused("at least one cell", ray_casting.ray_cast, points, vertices, faces, light, 0)
    refused("expects a point light", ray_casting.area_light_truth, points, vertices, faces, sun,
            0.1, offsets)
    refused("at least one place", ray_casting.disc_offsets, 0)
    for read in (lambda shape, points: shadow_mapping.depth_map(*shape, light, 8),
                 lambda shape, points: ray_casting.ray_cast(points, *shape, light)):
        np.testing.assert_array_equal(read((vertices.tolist(), faces.tolist()), points.tolist()),
                                      read((vertices, faces), points))
    for make in LIGHTS.values():
        assert np.isfinite(make(vertices.tolist()).clip_from_light).all()


@pytest.mark.parametrize("size", [0, -1, 2.5])
def test_a_map_without_texels_is_one_sentence(size):
    """A division by zero, a shape that NumPy refuses, or a map of -1 texels."""
    vertices, faces, points, normals = small_scene()
    light = LIGHTS["point"](vertices)
    refused(f"depth_map expects a whole number .* 1, got {size}", shadow_mapping.depth_map,
            vertices, faces, light, size)
    refused(f"receivers expects a whole number .* 1, got {size}", soft_shadows.receivers,
            points, normals, light, size)


@pytest.mark.parametrize("shape", [(0, 0), (8, 0), (4, 8), (8,)])
def test_a_shadow_wants_a_square_map(shape):
    """A map of another shape is read as if it were square, or a division by zero."""
    vertices, _, points, normals = small_scene()
    refused("square map of at least one texel", shadow_mapping.hard_shadow, points, normals,
            LIGHTS["point"](vertices), np.zeros(shape), 1e-3)


def test_a_picture_may_have_no_pixels_but_not_less():
    """A picture of -1 rows: a sentence of NumPy's."""
    vertices, faces = scene(lambda: mesh.icosphere(20))
    face_index, points, normals = shadow_mapping.visible_points(vertices, faces, camera(), 5, 0)
    assert (face_index.shape, points.shape, normals.shape) == ((0, 5), (0, 3), (0, 3))
    for width, height in (-1, 4), (4, 2.5):
        refused("visible_points expects a whole number", shadow_mapping.visible_points, vertices,
                faces, camera(), width, height)
