"""What tests of lab 11 subdivide: triangle meshes of all kinds, and what is on their boundary."""

import numpy as np
import pytest
import scipy.spatial
from subdivision_meshes import MOEBIUS, polygon_meshes

from course.given import mesh
from reference import subdivision


def triangle_meshes():
    rng = np.random.default_rng(0)
    return {
        "sphere": mesh.icosphere(80), "torus": mesh.torus(100), "sheet": mesh.plane(32),
        "sphere with holes": with_holes(*mesh.icosphere(180), rng),
        "torus with holes": with_holes(*mesh.torus(144), rng),
        "band with a twist": (rng.normal(size=(10, 3)), MOEBIUS),
        "cube and a sheet": together(mesh.cube(12), mesh.plane(8)),
        "irregular, open": irregular(60, rng)}


def with_holes(vertices, faces, rng):
    """Without the faces at two far vertices: two holes, and two vertices of no face."""
    removed = [0, np.linalg.norm(vertices - vertices[0], axis=1).argmax()]
    return vertices, rng.permutation(faces[~np.isin(faces, removed).any(1)])


def irregular(count, rng):
    """Points in a square and their Delaunay triangles, those in the middle away."""
    points = rng.random((count, 2))
    faces = scipy.spatial.Delaunay(points).simplices.astype(np.int64)
    kept = np.linalg.norm(points[faces].mean(1) - 0.5, axis=1) > 0.2
    corners, origin = subdivision.split_fans(*subdivision.triangles(faces[kept]))
    return np.stack([*points[origin].T, rng.random(len(origin))], axis=1), corners.reshape(-1, 3)


def together(one, other):
    return (np.concatenate([one[0], other[0] + 5.0]),
            np.concatenate([one[1], other[1] + len(one[0])]))


MESHES, POLYGONS = triangle_meshes(), polygon_meshes()
each_polygon_mesh = pytest.mark.parametrize("vertices, corners, counts", POLYGONS.values(),
                                            ids=POLYGONS)
