"""Makes bunny.glb, and a picture of it, from what lab 16 found. Run this first:

    python3 -m course reconstruct course/given/data/captures/bunny

Lab 12 leaves 10,000 of its faces. A vertex takes the paint of the nearest one that was found.
"""
import sys
from pathlib import Path

import numpy as np
import trimesh
from scipy.spatial import KDTree

sys.path.insert(0, str(Path(__file__).parents[2]))

from course.given import image, mesh
from course.given.places import ROOT
from course.given.whose import Labs
from course.scenes import drawing, portrait, viewing
from reference import collapse_heap, rasterization, scanline

FOUND = ROOT / "out" / "reconstruct" / "bunny" / "bunny.glb"
MADE = Path(__file__).with_suffix(".glb")


def main():
    found = trimesh.load_scene(FOUND).to_geometry()
    paint = image.to_linear(found.visual.to_color().vertex_colors[:, :3] / 255)
    whole = trimesh.Trimesh(found.vertices, found.faces, process=False)
    whole.merge_vertices(merge_tex=True, merge_norm=True)
    vertices, faces, _ = collapse_heap.simplify(np.array(whole.vertices),
                                                np.array(whole.faces), 10_000)
    albedo = paint[KDTree(found.vertices).query(vertices)[1]]
    vertices = mesh.normalize(vertices)
    normals = mesh.vertex_normals(vertices, faces)
    MADE.write_bytes(glb(vertices, faces, normals, albedo))

    clip = viewing.clip_positions(Labs("reference"), vertices, portrait.BUNNY_EYE)
    face_index, _ = scanline.rasterize(clip, faces, drawing.SIZE, drawing.SIZE)
    seen = face_index >= 0
    weights = rasterization.barycentrics(face_index, clip, faces)[seen][..., None]
    corners = faces[face_index[seen]]
    light = drawing.lit(weights[..., 0], normals[corners]) / drawing.BRASS
    colours = image.to_srgb(light * (weights * albedo[corners]).sum(1))
    image.write(MADE.with_suffix(".png"), drawing.painted(seen, colours))


def glb(vertices, faces, normals, albedo):
    """A binary glTF 2.0 file's bytes: one mesh, y up, linear vertex colours, a dull material."""
    dull = trimesh.visual.TextureVisuals(material=trimesh.visual.material.PBRMaterial(
        metallicFactor=0.0, roughnessFactor=1.0))
    painted = trimesh.Trimesh(vertices, faces, vertex_normals=normals, visual=dull, process=False)
    painted.visual.vertex_attributes["color"] = np.rint(255 * np.pad(
        np.clip(albedo, 0, 1), ((0, 0), (0, 1)), constant_values=1)).astype(np.uint8)
    return painted.export(file_type="glb", include_normals=True)


if __name__ == "__main__":
    main()
