"""What is given in lab 16: the loss of pictures, and what counts as a bump."""
import numpy as np

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import reconstruction


def test_bumps_are_central_differences_where_normals_are_held():
    """A transposed Laplacian, or a mean for a sum."""
    vertices, faces = mesh.icosphere(80)
    normals, edges = mesh.vertex_normals(vertices, faces), mesh.edges(faces)[0]
    vertices = vertices + np.random.default_rng(0).normal(scale=0.1, size=vertices.shape)
    gradcheck(lambda *given: np.array(reconstruction.bumps(*given)), reconstruction.bumps_backward,
              (vertices, normals, edges), differentiable=[0], name="bumps")


def test_a_face_on_a_line_hands_no_gradient_back():
    """Its area is rounding, and its normal 0: the gradient is 1e17."""
    line, faces = np.array([[0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.3, 0.6, 0.9]]), np.arange(3)[None]
    assert np.cross(line[1] - line[0], line[2] - line[0]).any()
    assert not mesh.vertex_normals(line, faces).any()
    got = reconstruction.vertex_normals_backward(np.ones((3, 3)), line, faces)
    np.testing.assert_array_equal(got, 0)


def test_vertices_that_lie_unevenly_in_a_plane_are_no_bumps():
    """A penalty that pulls vertices about within the surface."""
    vertices, faces = mesh.grid(50)
    vertices[:, :2] += np.random.default_rng(0).uniform(-0.3, 0.3, (len(vertices), 2))
    normals = np.tile([0.0, 0.0, 1.0], (len(vertices), 1))
    assert reconstruction.bumps(vertices, normals, mesh.edges(faces)[0]) == 0


def test_the_loss_number_by_number():
    """A sum, not a mean. The mean is of all four channels, or the weight is of the colours. Right
    for pictures of 0 and 1 alone, or for square ones.
    """
    picture, target = np.random.default_rng(0).uniform(0, 1, (2, 4, 3, 4))
    d = (picture - target)**2
    expected = np.mean([d[i, j, k] for i in range(4) for j in range(3) for k in range(3)])
    expected += 0.7 * np.mean([d[i, j, 3] for i in range(4) for j in range(3)])
    np.testing.assert_allclose(reconstruction.picture_loss(picture, target, 0.7), expected)
