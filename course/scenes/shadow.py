"""The bunny's shadow on the ground, hard and soft (lab 14)."""
import numpy as np

from ..given import image, mesh, plot, ray_casting
from .drawing import BRASS, SIZE, painted, save, size_in_words, unit_bunny
from .viewing import clip_from_world

GROUND = np.array([0.62, 0.66, 0.70])


def shadow(labs):
    """The bunny's shadow on the ground, hard and soft (lab 14)."""
    lab14, (vertices, faces) = labs.shadow_mapping, on_the_ground(*unit_bunny())
    light = labs.lights.point_light(np.array([-2.6, 2.4, 1.4]), vertices)
    camera = clip_from_world(labs, [-0.7, 1.3, 3.3], [0.1, -0.15, 0.0])
    yield size_in_words(vertices, faces), None

    face_index, points, normals = lab14.visible_points(vertices, faces, camera, SIZE, SIZE)
    yield "what the eye sees, as points in the world", None
    distance_map = lab14.depth_map(vertices, faces, light, 2 * SIZE)
    hard = lab14.hard_shadow(points, normals, light, distance_map, 2e-3)
    yield "hard shadow: the light's map, comparison", None
    soft = labs.soft_shadows.soft_shadow(points, normals, light, distance_map, 0.2, 1e-2,
                                         ray_casting.disc_offsets(32))
    yield "soft shadow of a disc, PCSS with 32 places", None

    seen = face_index >= 0
    facing = np.clip(cosine(light.position - points, normals), 0, 1)
    colour = np.where(face_index[seen][:, None] < len(faces) - 2, BRASS, GROUND)
    for name, share in ("hard", hard), ("soft", soft):
        shades = image.to_srgb((0.12 + 0.88 * share * facing)[:, None] * colour)
        yield f"{name} shadow", save("shadow", name, painted(seen, shades))
    distance = lab14.depth_map(vertices, faces, light, SIZE)
    yield "the light's map", save("shadow", "map", plot.depth_colours(distance))


def cosine(toward, normals):
    """The cosines of the angles between vectors (N, 3) and unit normals (N, 3)."""
    return (toward / np.linalg.norm(toward, axis=1, keepdims=True) * normals).sum(1)


def on_the_ground(vertices, faces):
    """A mesh, and two more faces below it."""
    ground, ground_faces = mesh.plane(2)
    ground = 2 * ground + [0.4, vertices[:, 1].min(), -0.2]
    return (np.concatenate([vertices, ground]),
            np.concatenate([faces, ground_faces + len(vertices)]))
