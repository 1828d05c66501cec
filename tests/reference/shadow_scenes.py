"""What the whole shadows of lab 14 are tested with: a mesh over a ground, a camera, two lights."""
import numpy as np
import pytest
import screen_scenes

from course.given import mesh
from reference import lights, shadow_mapping


def scene(load=mesh.bunny, lift=0.0):
    """A mesh over a square ground: vertices and faces. The last two faces are the ground."""
    vertices, faces = load()
    vertices = 0.7 * mesh.normalize(vertices)
    vertices = vertices + [0, lift - vertices[:, 1].min(), 0]
    ground, ground_faces = mesh.plane(2)
    return (np.concatenate([vertices, 1.6 * ground]),
            np.concatenate([faces, ground_faces + len(vertices)]))


def camera(eye=(0.2, 2.4, 2.6)):
    return screen_scenes.camera(eye, (0.2, 0.1, -0.1), np.radians(50), far=20.0)


def on_the_ground(vertices, faces, width, height, camera):
    """visible_points of the last two faces alone: points and normals."""
    seen, points, normals = shadow_mapping.visible_points(vertices, faces, camera, width, height)
    ground = seen[seen >= 0] >= len(faces) - 2
    return points[ground], normals[ground]


def refused(match, function, *given):
    with pytest.raises(ValueError, match=match):
        function(*given)


def small_scene():
    """A ball over the ground: vertices, faces, and the points and normals of a small picture."""
    vertices, faces = scene(lambda: mesh.icosphere(20), lift=0.3)
    _, points, normals = shadow_mapping.visible_points(vertices, faces, camera(), 8, 8)
    return vertices, faces, points, normals


PLACE = np.array([-1.2, 3.2, 0.5])

LIGHTS = {"point": lambda vertices: lights.point_light(PLACE, vertices),
          "direction": lambda vertices: lights.directional_light(-PLACE, vertices)}

each_light = pytest.mark.parametrize("light", LIGHTS.values(), ids=LIGHTS)


def toward_light(points, light):
    """From points (N, 3) to a point light, or far along the direction that light comes from."""
    parallel = light.clip_from_light[3, 2] == 0
    return (np.broadcast_to(10 * light.rotation[2], points.shape) if parallel
            else light.position - points)
