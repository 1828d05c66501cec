"""What is given in lab 16: paint in light, and what counts as a bump."""
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


def test_paint_in_the_light_of_a_lamp_comes_near_the_cosine():
    """The nine numbers are those of a lamp seen, not of a surface that it lights; the albedo, or
    light below 0, is left out; or lamps do not add up.
    """
    rng = np.random.default_rng(0)
    normals, towards = mesh.unit(rng.normal(size=(200, 3))), mesh.unit(rng.normal(size=(2, 3)))
    albedo, strength = rng.uniform(0, 1, (200, 3)), rng.uniform(0, 1, (2, 3))
    light = reconstruction.distant_light(towards, strength)
    cosine = normals @ towards.T
    wanted = albedo * ((1 / 4 + cosine / 2 + 5 / 32 * (3 * cosine**2 - 1)) @ strength)
    np.testing.assert_allclose(reconstruction.shade(albedo, normals, light), wanted, atol=1e-9)


def test_no_other_scale_comes_nearer():
    """The mean of quotients, or the quotient of means."""
    found, truth = np.random.default_rng(0).uniform(0.1, 1, (2, 9, 2))
    expected = [np.linalg.lstsq(found[:, k:k + 1], truth[:, k], rcond=None)[0][0] for k in (0, 1)]
    np.testing.assert_allclose(reconstruction.best_scale(found, truth), expected)
