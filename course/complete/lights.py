"""Two lights for shadow maps: from a direction, as the sun's, and from a point.

A map is one picture, so each light looks at the whole scene and at little else. Light from a
direction has an orthographic camera. Light from a point has a perspective one, which sees a cone:
shadows outside are lost, and all is lit there. (Six maps, the sides of a cube, would lose nothing.)
"""
import numpy as np

from . import transforms
from .shadow_mapping import Light, to_light

WIDEST = np.radians(75)  # from a cone's axis to its side; beyond it, texels are wasted
NARROWEST = 1e-6         # of a map's width, where all vertices lie on the light's axis


def axes_of(toward):
    """rotation (3, 3) of a light that looks along toward (3,). Up is y, or z for one along y."""
    up = np.eye(3)[1 if np.hypot(toward[0], toward[2]) > 1e-3 * abs(toward[1]) else 2]
    return transforms.look_at(np.zeros(3), toward, up)[:3, :3]


def bounds(vertices):
    """The least and the greatest x, y and z of vertices (V, 3), each (3,)."""
    if not (vertices.shape[1:] == (3,) and len(vertices) and np.isfinite(vertices).all()
            and np.ptp(vertices, axis=0).any()):
        raise ValueError("a light expects vertices (V, 3), finite and not all in one place, got "
                         f"{vertices.shape}; give it the vertices of the scene")
    return vertices.min(0), vertices.max(0)


def directional_light(direction, vertices):
    """Light that falls along direction (3,), its map around all vertices (V, 3) -> Light.

    ValueError for a direction of length 0, or vertices that are not finite or all in one place.
    """
    direction, vertices = np.asarray(direction, float), np.asarray(vertices, float)
    if direction.shape != (3,) or not 0 < np.linalg.norm(direction) < np.inf:
        raise ValueError("directional_light expects a direction of three numbers and some length, "
                         f"got {direction}; give the direction in which the light falls")
    bounds(vertices)
    rotation = axes_of(direction)
    low, high = bounds(to_light(vertices, np.zeros(3), rotation))
    far = np.linalg.norm(high - low)
    side = max(0.51 * (high - low)[:2].max(), NARROWEST * far)
    position = np.append((low + high)[:2] / 2, high[2] + far) @ rotation
    clip_from_light = transforms.orthographic(-side, side, -side, side, far / 2, 2.5 * far)
    return Light(position, rotation, clip_from_light)


def in_a_cone(vertices, position, toward):
    """rotation (3, 3) of a light that looks along toward (3,), and q (V, 3), all before it."""
    if not np.linalg.norm(toward) > 0:
        raise ValueError("point_light stands in the middle of the scene, and a cone sees only one "
                         "side; move it out of the scene")
    rotation = axes_of(toward)
    q = to_light(vertices, position, rotation)
    if not (np.hypot(q[:, 0], q[:, 1]) < -np.tan(WIDEST) * q[:, 2]).all():
        raise ValueError("point_light expects all vertices within a cone of "
                         f"{np.degrees(WIDEST):.0f} degrees around its axis, and some are outside; "
                         "move it away from the scene")
    return rotation, q


def point_light(position, vertices):
    """Light from position (3,), its map a cone around all vertices (V, 3) -> Light.

    ValueError for a position inside the scene, or so near that no cone holds all of it.
    """
    position, vertices = np.asarray(position, float), np.asarray(vertices, float)
    if position.shape != (3,) or not np.isfinite(position).all():
        raise ValueError(f"point_light expects a position of three finite numbers, got {position}; "
                         "give the light's place in the world")
    rotation, q = in_a_cone(vertices, position, sum(bounds(vertices)) / 2 - position)
    # Look at the middle of what is seen from here, so that no side of the map stays empty.
    angle = np.arctan(q[:, :2] / -q[:, 2:])
    middle = np.append(np.tan((angle.min(0) + angle.max(0)) / 2), -1.0)
    rotation, q = in_a_cone(vertices, position, middle @ rotation)
    slope = max(1.02 * (np.abs(q[:, :2]) / -q[:, 2:]).max(), NARROWEST)
    near, far = 0.9 * -q[:, 2].max(), 1.1 * -q[:, 2].min()
    clip_from_light = transforms.perspective(2 * np.arctan(slope), 1.0, near, far)
    return Light(position, rotation, clip_from_light)
