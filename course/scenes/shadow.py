"""The bunny's shadow on the ground, hard and soft, and a light that is found by one (lab 14)."""
import numpy as np

from ..given import image, mesh, plot, ray_casting
from .drawing import BRASS, SIZE, painted, save, size_in_words, unit_bunny
from .viewing import clip_from_world

GROUND = np.array([0.62, 0.66, 0.70])
PLACE, GUESS = np.array([[-1.4, 3.4, 0.8], [-0.7, 3.8, 0.1]])


def shadow(labs):
    """The bunny's shadow on the ground, hard and soft (lab 14)."""
    lab14, (vertices, faces) = labs.shadow_mapping, on_the_ground(*unit_bunny())
    light = labs.lights.point_light(np.array([-2.6, 2.4, 1.4]), vertices)
    camera = clip_from_world(labs, [-0.7, 1.3, 3.3], [0.1, -0.15, 0.0])
    yield size_in_words(vertices, faces), None

    face_index, points, normals = lab14.visible_points(vertices, faces, camera, SIZE, SIZE)
    yield "what the eye sees, as points in the world", None
    distance_map = lab14.depth_map(vertices, faces, light, 2 * SIZE)
    hard = lab14.hard_shadow(points, normals, light, distance_map, 2e-3, most=0.1)
    yield "hard shadow: the light's map, comparison", None
    soft = labs.soft_shadows.soft_shadow(points, normals, light, distance_map, 0.2, 1e-2,
                                         ray_casting.disc_offsets(32))
    yield "soft shadow of a disc, PCSS with 32 places", None

    seen = face_index >= 0
    facing = np.clip((mesh.unit(light.position - points) * normals).sum(1), 0, 1)
    colour = np.where(face_index[seen][:, None] < len(faces) - 2, BRASS, GROUND)
    for name, share in ("hard", hard), ("soft", soft):
        shades = image.to_srgb((0.12 + 0.88 * share * facing)[:, None] * colour)
        yield f"{name} shadow", save("shadow", name, painted(seen, shades))
    distance = lab14.depth_map(vertices, faces, light, SIZE)
    yield "the light's map", save("shadow", "map", plot.depth_colours(distance))


def light_from_shadow(labs):
    """A light finds its place by the shadow that the bunny should cast (lab 14)."""
    lab14, shape = labs.variance_shadows, on_the_ground(*unit_bunny(), lift=0.5)
    settings, rates = lab14.Settings(192, 6, 1e-3), labs.inverse_rendering.decay(0.08, 0.1, 100)
    _, *few = given_shadow(labs, *shape, SIZE // 4)
    path = lab14.fit_position(*few, *shape, GUESS, settings, rates)
    ground, target, points = given_shadow(labs, *shape, SIZE)
    for name, position in ("first", path[0]), ("found", path[-1]):
        off = 100 * np.linalg.norm(position - PLACE) / np.linalg.norm(np.ptp(shape[0], axis=0))
        light = labs.lights.point_light(position, shape[0])
        share, _ = lab14.variance_shadow(points, *shape, light, settings._replace(radius=1))
        red = np.where(target[:, None], 1.0, [1.0, 0.6, 0.5])  # where the shadow should be
        shades = image.to_srgb((0.12 + 0.88 * share)[:, None] * GROUND * red)
        yield (f"{name}: off by {off:.1f} % of the scene's size",
               save("light_from_shadow", name, painted(ground, shades)))
    yield "the light's place", None, ("off by less than 2 %", off < 2)


def given_shadow(labs, vertices, faces, size):
    """Where an eye sees the ground (size, size), which points of it are lit (N,), they (N, 3)."""
    camera = clip_from_world(labs, [0.6, 3.6, 2.2], [0.4, -0.8, -0.2], fov_y=44)
    face_index, points, _ = labs.shadow_mapping.visible_points(vertices, faces, camera, size, size)
    ground = face_index >= len(faces) - 2
    points = points[ground[face_index >= 0]]
    light = labs.lights.point_light(PLACE, vertices)
    return ground, ray_casting.ray_cast(points, vertices, faces, light), points


def on_the_ground(vertices, faces, lift=0.0):
    """A mesh, and two more faces below it."""
    ground, ground_faces = mesh.plane(2)
    ground = 2 * ground + [0.4, vertices[:, 1].min() - lift, -0.2]
    return (np.concatenate([vertices, ground]),
            np.concatenate([faces, ground_faces + len(vertices)]))
