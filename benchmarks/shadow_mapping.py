"""How long lab 14 takes, and how wrong its shadows are: python3 benchmarks/shadow_mapping.py

The bunny on a square ground, 512 x 512 pixels. Times are milliseconds as benchmarks/measure.py has
them. Errors are % of the pixels that face the light, against exact ray casting, and root mean
squares against 256 point lights; fits start from places around the light. All of it goes to
out/benchmarks/shadow_mapping.json as well.
"""
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import mesh, ray_casting
from reference import (
    inverse_rendering,
    lights,
    shadow_mapping,
    soft_shadows,
    transforms,
    variance_shadows,
)

SIZE = 512
MAPS = 256, 512, 1024, 2048
PLACE = np.array([-2.6, 2.4, 1.4])
SETTINGS = variance_shadows.Settings(size=192, radius=6, least_variance=1e-3)
STARTS, STEPS = 8, 100


def main():
    facts, tables = measure.begin(), {}
    for table in times, errors, soft_errors, fits:
        tables[table.__name__] = rows = table()
        print(f"\n{table.__doc__}", end="")
        measure.show(rows)
    measure.save("shadow_mapping", facts, tables)


def scene(lift=0.0):
    """The bunny above a ground of 4 x 4; the last two faces are the ground."""
    vertices, faces = mesh.bunny()
    vertices = mesh.normalize(vertices)
    ground, ground_faces = mesh.plane(2)
    ground = 2 * ground + [0.4, vertices[:, 1].min() - lift, -0.2]
    return np.concatenate([vertices, ground]), np.concatenate([faces, ground_faces + len(vertices)])


def seen(vertices, faces, size, eye=(-0.7, 1.3, 3.3)):
    view_from_world = transforms.look_at(np.array(eye), np.array([0.2, -0.3, 0.0]),
                                         np.array([0.0, 1.0, 0.0]))
    clip_from_world = transforms.perspective(np.radians(48), 1.0, 0.1, 10.0) @ view_from_world
    return shadow_mapping.visible_points(vertices, faces, clip_from_world, size, size)


def times():
    """Milliseconds, by the rows and columns of the map; hard shadow and PCSS without the map"""
    vertices, faces = scene()
    light = lights.point_light(PLACE, vertices)
    _, points, normals = seen(vertices, faces, SIZE)
    offsets, rows = ray_casting.disc_offsets(32), []
    given = points, normals, light
    for size in MAPS:
        distance_map = shadow_mapping.depth_map(vertices, faces, light, size)
        settings = SETTINGS._replace(size=size)
        variance = points, vertices, faces, light, settings
        lit, buffers = variance_shadows.variance_shadow(*variance)
        rows.append({"map": size, "points": len(points), **measure.medians({
            "what is seen": lambda: seen(vertices, faces, SIZE),
            "map alone": lambda size=size: shadow_mapping.depth_map(vertices, faces, light, size),
            "hard shadow": lambda given=(*given, distance_map):
                shadow_mapping.hard_shadow(*given, 1e-3),
            "PCSS, 32 places": lambda given=(*given, distance_map):
                soft_shadows.soft_shadow(*given, 0.2, 0.02, offsets),
            "variance": lambda variance=variance: variance_shadows.variance_shadow(*variance),
            "its backward": lambda lit=lit, buffers=buffers, settings=settings:
                variance_shadows.variance_shadow_backward(lit, buffers, points, light, settings),
            "ray casting": lambda: ray_casting.ray_cast(points, vertices, faces, light),
        }, runs=5)})
    return rows


def errors():
    """% wrongly dark and wrongly lit: no bias, constant, slope-scaled (0.001 and factor 1)"""
    vertices, faces = scene()
    _, points, normals = seen(vertices, faces, SIZE)
    both = {"point": lights.point_light(PLACE, vertices),
            "direction": lights.directional_light(-PLACE, vertices)}
    rows = []
    for name, light in both.items():
        toward = light.position - points if name == "point" else light.rotation[2]
        facing = (normals * toward).sum(1) > 0
        truth = ray_casting.ray_cast(points, vertices, faces, light)[facing]
        for size in MAPS:
            row = {"light": name, "map": size}
            distance_map = shadow_mapping.depth_map(vertices, faces, light, size)
            for bias, given in {"none": (0.0, 0.0), "0.05": (0.05, 0.0),
                                "slope": (1e-3, 1.0)}.items():
                lit = shadow_mapping.hard_shadow(points, normals, light, distance_map,
                                                 *given)[facing]
                dark, leak = ray_casting.error_shares(lit, truth)
                row[f"bias {bias}"] = f"{100 * dark:.2f} + {100 * leak:.2f}"
            rows.append(row)
    return rows


def soft_errors():
    """Root mean square error against 256 point lights on a disc; PCF over 4 texels"""
    vertices, faces = scene()
    light = lights.point_light(PLACE, vertices)
    face_index, points, normals = seen(vertices, faces, 96)
    facing = (normals * (PLACE - points)).sum(1) > 0
    ground = (face_index[face_index >= 0] >= len(faces) - 2)[facing]
    points, normals = points[facing], normals[facing]
    on_map = shadow_mapping.receivers(points, normals, light, 1024)
    distance_map = shadow_mapping.depth_map(vertices, faces, light, 1024)
    offsets, rows = ray_casting.disc_offsets(64), []
    for radius in 0.1, 0.25, 0.5:
        truth = ray_casting.area_light_truth(points, vertices, faces, light, radius,
                                                ray_casting.disc_offsets(256))
        soft = {"hard": shadow_mapping.hard_shadow(points, normals, light, distance_map, 1e-3),
                "PCF": soft_shadows.percentage_closer(distance_map, *on_map, 0.02, offsets, 4.0),
                "PCSS": soft_shadows.soft_shadow(points, normals, light, distance_map, radius, 0.02,
                                                 offsets)}
        rows.append({"radius": radius} | {
            f"{name}{where}": round(float(np.sqrt(np.mean((lit - truth)[among] ** 2))), 3)
            for where, among in (("", slice(None)), (" ground", ground))
            for name, lit in soft.items()})
    return rows


def fits():
    """How far from its place a light is, in % of the scene's size, before and after a fit"""
    vertices, faces = scene(0.5)
    place, rng = np.array([-1.4, 3.4, 0.8]), np.random.default_rng(0)
    face_index, points, _ = seen(vertices, faces, 80, (0.6, 3.6, 2.2))
    points = points[face_index[face_index >= 0] >= len(faces) - 2]
    target = ray_casting.ray_cast(points, vertices, faces,
                                     lights.point_light(place, vertices))
    size, rows = np.linalg.norm(np.ptp(vertices, axis=0)), []
    for start in range(STARTS):
        off = rng.normal(size=3)
        guess, began = place + off / np.linalg.norm(off), time.perf_counter()
        path = variance_shadows.fit_position(target, points, vertices, faces, guess, SETTINGS,
                                             inverse_rendering.decay(0.08, 0.1, STEPS))
        distance = 100 * np.linalg.norm(path - place, axis=1) / size
        rows.append({"start": start, "before": round(distance[0], 2),
                     "after": round(distance[-1], 2),
                     "ms a step": round(1000 * (time.perf_counter() - began) / STEPS)})
    return rows


if __name__ == "__main__":
    main()
