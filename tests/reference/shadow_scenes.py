"""What the whole shadows of lab 14 are tested with: a mesh over a ground, a camera, two lights."""
import numpy as np
import pytest

from course.given import mesh
from reference import lights, shadow_mapping, transforms


def scene(load=mesh.bunny, lift=0.0):
    """A mesh over a square ground: vertices and faces. The last two faces are the ground."""
    vertices, faces = load()
    vertices = 0.7 * mesh.normalize(vertices)
    vertices = vertices + [0, lift - vertices[:, 1].min(), 0]
    ground, ground_faces = mesh.plane(2)
    return (np.concatenate([vertices, 1.6 * ground]),
            np.concatenate([faces, ground_faces + len(vertices)]))


def camera(eye=(0.2, 2.4, 2.6)):
    view = transforms.look_at(np.array(eye), np.array([0.2, 0.1, -0.1]), np.array([0.0, 1.0, 0.0]))
    return transforms.perspective(np.radians(50), 1.0, 0.1, 20.0) @ view


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
