"""The two lights of lab 14: their maps are around the scene."""
import numpy as np
from shadow_scenes import PLACE, each_light, scene

from course.given import mesh
from reference import lights, shadow_mapping, transforms


@each_light
def test_the_map_is_around_the_scene_and_filled_by_it(light):
    """Vertices lie outside, or a side of the map stays empty."""
    vertices, _ = scene()
    light = light(vertices)
    q = shadow_mapping.to_light(vertices, light.position, light.rotation)
    clip = transforms.transform(transforms.to_homogeneous(q), light.clip_from_light)
    ndc = clip[:, :3] / clip[:, 3:]
    assert np.abs(ndc).max() < 1
    low, high = ndc[:, :2].min(0), ndc[:, :2].max(0)
    assert np.abs(low + high).max() < 0.15 and (high - low).max() > 1.8


@each_light
def test_a_scene_on_the_axis_of_the_light_has_a_map(light):
    """A map without width: division by 0."""
    vertices = PLACE * np.array([[0.2], [0.1], [-0.1]])
    light = light(vertices)
    assert np.isfinite(light.clip_from_light).all()
    assert np.isinf(shadow_mapping.depth_map(vertices, np.array([[0, 1, 2]]), light, 8)).all()


@each_light
def test_light_straight_from_above_has_axes(light):
    """Up is along the look: NaN."""
    vertices, _ = scene(lambda: mesh.icosphere(20))
    middle = (vertices.min(0) + vertices.max(0)) / 2
    for rotation in (lights.directional_light([0.0, -1.0, 0.0], vertices).rotation,
                     lights.point_light(middle + [0.0, 4.0, 0.0], vertices).rotation):
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
        np.testing.assert_allclose(rotation[2], [0, 1, 0], atol=1e-12)
