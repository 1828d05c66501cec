"""The penalty of lab 16 that is no exercise: what counts as a bump."""
import numpy as np

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import reconstruction


def test_bumps_are_central_differences_where_normals_are_held():
    """A transposed Laplacian, or a mean for a sum."""
    vertices, faces = mesh.icosphere(80)
    normals, edges = mesh.vertex_normals(vertices, faces), mesh.edges(faces)[0]
    vertices = vertices + np.random.default_rng(0).normal(scale=0.1, size=vertices.shape)
    gradcheck(lambda vertices: np.array(reconstruction.bumps(vertices, normals, edges)),
              lambda grad, vertices: reconstruction.bumps_backward(grad, vertices, normals, edges),
              (vertices,), name="bumps")


def test_vertices_that_lie_unevenly_in_a_plane_are_no_bumps():
    """A penalty that pulls vertices about within the surface."""
    vertices, faces = mesh.grid(50)
    vertices[:, :2] += np.random.default_rng(0).uniform(-0.3, 0.3, (len(vertices), 2))
    normals = np.tile([0.0, 0.0, 1.0], (len(vertices), 1))
    assert reconstruction.bumps(vertices, normals, mesh.edges(faces)[0]) == 0
