"""What tests of lab 11 subdivide: meshes of triangles, and of polygons."""
import numpy as np
import pytest
from subdivision_meshes import CUBE, CUBE_VERTICES, MOEBIUS, flat, published
from subdivision_meshes import POLYGONS as FACES

from course.given import mesh

BAND = np.random.default_rng(0).normal(size=(10, 3))
SHEET, SHEET_FACES = mesh.plane(32)
MESHES = {"torus": mesh.torus(100), "band with a twist": (BAND, MOEBIUS),
          "sheet and a lone vertex": (np.vstack([SHEET, [5.0, 6.0, 7.0]]), SHEET_FACES)}
POLYGONS = {  # name -> vertices, corners, counts
    "cube": (CUBE_VERTICES, *flat(CUBE)),
    "pyramid": (*published("pyramid", "vertices", "corners", "counts"),),
    "house, open": (np.random.default_rng(1).normal(size=(12, 3)), *flat(FACES["house, open"][1])),
    "triangles": (mesh.torus(36)[0], *flat(mesh.torus(36)[1])),
    "band with a twist": (BAND, *flat(MOEBIUS))}
each_polygon_mesh = pytest.mark.parametrize("vertices, corners, counts", POLYGONS.values(),
                                            ids=POLYGONS)
