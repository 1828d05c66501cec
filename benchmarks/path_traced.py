"""Make the captures of lab 16 in course/given/data/captures/: pictures by a path tracer.

    pip install mitsuba        in an environment of its own, with this course's requirements.txt
    python3 benchmarks/path_traced.py [duck] [bunny] [rings]

Three objects, with their cameras in transforms.json: a duck in the sun, the bunny in many colours,
with a grey sun and sky, and two rings in warm light. The tracer is Mitsuba 3 (Jakob et al.), which
knows cast shadows and light from surface to surface. Beside each capture lie 8 views that no search
sees, with their true albedo.
"""
import json
import shutil
import sys
from pathlib import Path
from typing import NamedTuple

import mitsuba
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT))
mitsuba.set_variant("scalar_rgb")

from course.given import image, mesh, places  # noqa: E402
from course.given.whose import Labs  # noqa: E402
from course.scenes import reconstruct, viewing  # noqa: E402

LABS = Labs("reference")
SIZE, SAMPLES, BOUNCES = 128, 128, 6
FOV, AWAY = 40, 3.0  # degrees; the cameras of viewing.cameras_around


class Lamps(NamedTuple):
    """A sun, which shines along a direction, and an even sky. Strengths are linear colours."""

    along: list
    sun: list
    sky: list


# --- the objects --------------------------------------------------------------------------------


def ellipsoid(points, centre, radii):
    """About the distance of points (P, 3) from an ellipsoid -> (P,)."""
    radii = np.array(radii)
    return (np.linalg.norm((points - centre) / radii, axis=1) - 1) * radii.min()


def union(a, b, width):
    """Two shapes as one, with a soft seam."""
    share = np.clip(0.5 + 0.5 * (b - a) / width, 0, 1)
    return b * (1 - share) + a * share - width * share * (1 - share)


BEAK = [0, 0.3, 0.64], [0.19, 0.08, 0.22]


def duck():
    """A bath duck: yellow, its beak orange, its eyes black."""
    points, tetrahedra = LABS.marching_tetrahedra.tetrahedral_grid(96)
    parts = [([0, -0.3, -0.1], [0.5, 0.4, 0.68], 1), ([0, -0.08, -0.72], [0.2, 0.14, 0.22], 0.15),
             ([0, 0.35, 0.3], [0.33, 0.33, 0.34], 0.12), ([0.46, -0.25, -0.15], [0.12, 0.22, 0.4],
             0.05), ([-0.46, -0.25, -0.15], [0.12, 0.22, 0.4], 0.05), (*BEAK, 0.04)]
    distance = np.full(len(points), 9.0)
    for centre, radii, seam in parts:
        distance = union(distance, ellipsoid(points, centre, radii), seam)
    vertices, faces, _ = LABS.marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)
    albedo = np.tile([0.80, 0.56, 0.04], (len(vertices), 1))
    albedo[ellipsoid(vertices, *BEAK) < 0.015] = 0.75, 0.22, 0.02
    eyes = np.abs(vertices) * [1, 0, 0] + vertices * [0, 1, 1]
    albedo[np.linalg.norm(eyes - [0.2, 0.42, 0.55], axis=1) < 0.09] = 0.03
    return reconstruct.Painted(vertices, faces, albedo)


def bunny():
    return reconstruct.unseen(LABS, "bunny")


def rings():
    """Two joined rings: striped in red and green, their front white."""
    vertices, faces, _ = reconstruct.unseen(LABS, "two rings")
    stripes = np.sin(9 * vertices[:, :1]) > 0
    albedo = np.where(stripes, [0.6, 0.1, 0.1], [0.12, 0.4, 0.15])
    albedo = np.where(vertices[:, 2:] > 0.08, [0.7, 0.66, 0.6], albedo)
    return reconstruct.Painted(vertices, faces, albedo)


# --- the pictures -------------------------------------------------------------------------------


def to_mitsuba(painted):
    """A Painted as a mesh of Mitsuba, matt, its albedo at the vertices."""
    matt = {"type": "diffuse", "reflectance": {"type": "mesh_attribute", "name": "vertex_color"}}
    properties = mitsuba.Properties()
    properties["bsdf"] = mitsuba.load_dict({"type": "twosided", "inside": matt})
    made = mitsuba.Mesh("object", len(painted.vertices), len(painted.faces),
                        has_vertex_normals=True, props=properties)
    parts = mitsuba.traverse(made)
    parts["vertex_positions"] = np.float32(painted.vertices).ravel()
    parts["faces"] = np.uint32(painted.faces).ravel()
    parts["vertex_normals"] = np.float32(mesh.vertex_normals(*painted[:2])).ravel()
    made.add_attribute("vertex_color", 3, np.float32(painted.albedo).ravel())
    parts.update()
    return made


def traced(shape, lamps, eye):
    """What a camera at eye sees: colours (H, W, 3) before black, coverage (H, W, 1), albedo."""
    place = mitsuba.ScalarTransform4f().look_at(origin=list(eye), target=[0, 0, 0], up=[0, 1, 0])
    film = {"type": "hdrfilm", "width": SIZE, "height": SIZE, "pixel_format": "rgba",
            "rfilter": {"type": "box"}}
    camera = mitsuba.load_dict({
        "type": "perspective", "fov": FOV, "fov_axis": "y", "to_world": place, "film": film,
        "sampler": {"type": "multijitter", "sample_count": SAMPLES}})
    path = {"type": "path", "max_depth": BOUNCES, "hide_emitters": True}
    scene = mitsuba.load_dict({
        "type": "scene", "object": shape,
        "sun": {"type": "directional", "direction": lamps.along,
                "irradiance": {"type": "rgb", "value": lamps.sun}},
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": lamps.sky}},
        "integrator": {"type": "aov", "aovs": "albedo:albedo", "path": path}})
    found = np.array(mitsuba.render(scene, sensor=camera), float)[::-1]
    return found[..., :3], np.clip(found[..., 3:4], 0, 1), found[..., 4:7]


def as_file(colour, coverage):
    """Colours before black -> what a PNG holds: sRGB colours not yet multiplied, and alpha."""
    whole = colour / np.maximum(coverage, 1e-6)
    return np.concatenate([image.to_srgb(np.clip(whole, 0, 1)) * (coverage > 0), coverage], 2)


def sides(count, longitude=0.0):
    """Where the cameras of `viewing.cameras_around` stand (count, 3)."""
    rows = viewing.cameras_around(LABS, count, longitude)[:, [0, 1, 3]]
    return np.linalg.solve(rows[..., :3], -rows[..., 3:])[..., 0]


def world_from_camera(eye):
    return np.linalg.inv(LABS.transforms.look_at(eye, np.zeros(3), viewing.UP))


# --- the files ----------------------------------------------------------------------------------


def write_cameras(folder, names, poses):
    frames = [{"file_path": f"images/{Path(name).stem}", "transform_matrix": pose.round(9).tolist()}
              for name, pose in zip(names, poses, strict=True)]
    scene = {"camera_angle_x": np.radians(FOV), "frames": frames}
    places.write_whole(folder / "transforms.json", (json.dumps(scene, indent=1) + "\n").encode())


def write_truth(folder, shape, lamps):
    """8 views that no search sees, in a row, and below them their albedo."""
    views = [traced(shape, lamps, eye) for eye in sides(8, 1.1)]
    seen = [as_file(colour, coverage) for colour, coverage, _ in views]
    albedo = [as_file(albedo, coverage) for _, coverage, albedo in views]
    image.write(folder / "unseen.png", np.vstack([np.hstack(albedo), np.hstack(seen)]))


CAPTURES = {
    "duck": (duck, Lamps([-0.5, -0.75, -0.45], [2.4, 2.2, 1.95], [0.36, 0.4, 0.48])),
    "bunny": (bunny, Lamps([0.4, -0.8, -0.5], [1.5, 1.5, 1.5], [0.5, 0.5, 0.5])),
    "rings": (rings, Lamps([-0.6, -0.5, 0.6], [2.2, 2.1, 1.9], [0.5, 0.48, 0.45]))}


def main():
    for name in sys.argv[1:] or CAPTURES:
        painted, lamps = CAPTURES[name]
        folder = places.DATA / "captures" / name
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "images").mkdir(parents=True)
        shape, eyes = to_mitsuba(painted()), sides(24)
        names = [f"{k:02}.png" for k in range(len(eyes))]
        brightest = 0
        for file, eye in zip(names, eyes, strict=True):
            colour, coverage, _ = traced(shape, lamps, eye)
            brightest = max(brightest, colour.max())
            image.write(folder / "images" / file, as_file(colour, coverage))
        write_cameras(folder, names, [world_from_camera(eye) for eye in eyes])
        write_truth(folder, shape, lamps)
        print(f"{name}: the brightest colour is {brightest:.2f} of 1")


if __name__ == "__main__":
    main()
