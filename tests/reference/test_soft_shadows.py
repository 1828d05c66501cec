"""Whole soft shadows of lab 14, against many point lights."""
import functools

import numpy as np
from shadow_scenes import LIGHTS, refused, small_scene

from course.given import mesh, ray_casting
from reference import lights, shadow_mapping, soft_shadows


def test_a_flat_blocker_has_the_border_of_its_disc():
    """PCSS measures the border on another plane, or by the diameter."""
    ground, faces = mesh.plane(2)
    edge = 2.0 * ground * [1, 0, 1] + [2.0, 1.0, 0.0]              # a half plane: x > 0, at y = 1
    vertices, faces = np.concatenate([ground, edge]), np.concatenate([faces, faces + 4])
    light = lights.point_light([0.0, 4.0, 0.0], np.concatenate([ground, -edge, edge]))
    points = np.column_stack([np.linspace(-0.2, 0.2, 41), np.zeros((41, 2))])
    distance_map = shadow_mapping.depth_map(vertices, faces, light, 1024)
    soft = soft_shadows.soft_shadow(points, np.tile([0.0, 1.0, 0.0], (41, 1)), light, distance_map,
                                    0.3, 1e-3, ray_casting.disc_offsets(400))
    # The disc of radius 0.3 is cut at 3 x from its middle: the light is 3 times as far from the
    # edge as the ground. The lit share is that of a circle's segment.
    cut = np.clip(-3 * points[:, 0] / 0.3, -1, 1)
    np.testing.assert_allclose(soft, 0.5 + (np.arcsin(cut) + cut * np.sqrt(1 - cut**2)) / np.pi,
                               atol=0.025)


def test_what_does_not_fit_a_soft_shadow_is_one_sentence():
    """The sun as a lamp, a disc without places, or a map without texels: NaN, or wrong shadows."""
    vertices, _, *seen = small_scene()
    light, sun = (make(vertices) for make in LIGHTS.values())
    distance_map, offsets = np.full((8, 8), 3.0), ray_casting.disc_offsets(4)
    shadow = functools.partial(soft_shadows.soft_shadow, *seen)
    refused("expects a point light", shadow, sun, distance_map, 0.1, 0.01, offsets)
    refused("radius 0 or more, got -0.1", shadow, light, distance_map, -0.1, 0.01, offsets)
    refused("at least one place", shadow, light, distance_map, 0.1, 0.01, offsets[:0])
    refused(r"at least one texel, got an array \(0, 0\)", shadow, light, np.zeros((0, 0)), 0.1,
            0.01, offsets)
