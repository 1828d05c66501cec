"""Makes bunny.npz, the mesh and the paint that lab 16 found. Run this first:

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
from labkit.places import ROOT
from reference import collapse_heap

FOUND = ROOT / "out" / "reconstruct" / "bunny" / "bunny.glb"


def main():
    found = trimesh.load_scene(FOUND).to_geometry()
    paint = image.to_linear(found.visual.to_color().vertex_colors[:, :3] / 255)
    whole = trimesh.Trimesh(found.vertices, found.faces, process=False)
    whole.merge_vertices(merge_tex=True, merge_norm=True)
    vertices, faces, _ = collapse_heap.simplify(np.array(whole.vertices),
                                                np.array(whole.faces), 10_000)
    albedo = paint[KDTree(found.vertices).query(vertices)[1]]
    np.savez_compressed(Path(__file__).with_suffix(".npz"), faces=faces.astype(np.int32),
                        vertices=mesh.normalize(vertices).astype(np.float32),
                        albedo=np.rint(255 * np.clip(albedo, 0, 1)).astype(np.uint8))


if __name__ == "__main__":
    main()
