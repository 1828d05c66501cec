"""The reference on whole meshes: Laplacians, energies, smoothing, and large steps."""
import numpy as np

from course.given import mesh
from course.given.gradcheck import gradcheck
from labkit.checks import assert_close, assert_equal
from reference import regularization


def volume(vertices, faces):
    return regularization.enclosed_volume(vertices[faces])


def test_the_cotangent_laplacian_is_the_gradient_of_the_area():
    """Another factor or sign: L x is the gradient of the bunny's area by its vertices."""
    vertices, faces = mesh.bunny()
    expected = np.zeros_like(vertices)
    normals = mesh.face_normals(vertices, faces)
    for k in range(3):
        opposite = vertices[faces[:, k - 1]] - vertices[faces[:, k - 2]]
        np.add.at(expected, faces[:, k], np.cross(normals, opposite) / 2)
    edges, weights, _ = regularization.cotangent_laplacian(vertices, faces)
    got = regularization.laplacian(edges, weights, len(vertices)) @ vertices
    np.testing.assert_allclose(got, expected, atol=1e-10)


def test_an_energy_of_integers_is_that_of_floats():
    """A share of a mass does not fit into an array of integers, and -1 not into a byte."""
    x, edges, mass = np.array([[1], [2], [4]]), np.array([[0, 1], [1, 2]]), np.array([1, 0, 4])
    given = x, edges, np.ones(2, np.uint8), mass
    assert regularization.laplacian_energy(*given) == 2.0  # L x is -1, -1, 2
    assert_equal(regularization.laplacian_energy_backward(1, *given),
                 regularization.laplacian_energy_backward(
                     1.0, x.astype(float), edges, np.ones(2), mass.astype(float)))


def test_the_bending_energy_has_a_gradient():
    """Its weights and its areas depend on the vertices, too."""
    vertices, faces = mesh.icosphere(20)
    vertices = vertices * np.random.default_rng(1).uniform(0.8, 1.2, (12, 1))
    gradcheck(regularization.bending_energy, regularization.bending_energy_backward,
              (vertices, faces), differentiable=[0], name="bending_energy")


def test_spheres_bend_by_16_pi_and_everything_else_by_more():
    """Another factor, or an energy that depends on the size or on the number of faces."""
    vertices, faces = mesh.icosphere(5120)
    for size in 0.01, 1.0, 30.0:
        sphere = regularization.bending_energy(size * vertices, faces)
        np.testing.assert_allclose(sphere, 16 * np.pi, rtol=0.002)
    egg = regularization.bending_energy(vertices * [1.0, 1.0, 2.0], faces)
    assert egg > 1.2 * sphere


def test_smoothing_shrinks_and_taubins_does_not():
    """The answer to shrinkage shrinks as well, or it does not smooth."""
    vertices, faces = mesh.bunny()
    vertices = mesh.normalize(vertices)
    rough = vertices + np.random.default_rng(0).normal(0, 0.01, vertices.shape)
    edges, _ = mesh.edges(faces)
    around = edges, np.ones(len(edges)), np.bincount(edges.ravel())
    explicit = rough
    for _ in range(20):
        explicit = regularization.smooth_explicit(explicit, *around, 0.5)
    taubin = regularization.smooth_taubin(rough, *around, 0.5, 0.53, 20)
    restored = regularization.restore_volume(explicit, faces, volume(rough, faces))
    assert volume(explicit, faces) < 0.97 * volume(rough, faces)
    assert abs(volume(taubin, faces) / volume(rough, faces) - 1) < 0.01
    np.testing.assert_allclose(volume(restored, faces), volume(rough, faces), rtol=1e-12)
    roughness = [regularization.laplacian_energy(x, *around) for x in (rough, taubin)]
    assert roughness[1] < 0.2 * roughness[0]


def test_without_vertices_there_is_nothing_to_smooth_and_no_step_to_make():
    """An error from deep inside: of a matrix without rows, or of the largest of no squares."""
    x, edges, weights = np.zeros((0, 3)), np.zeros((0, 2), int), np.zeros(0)
    for got in (regularization.smooth_explicit(x, edges, weights, np.zeros(0), 1.0),
                regularization.smooth_implicit(x, edges, weights, np.zeros(0), 1.0),
                regularization.precondition(x, edges, weights, 3.0),
                *regularization.large_step(x, x, x, x, 1, 0.1, (edges, weights, 3.0))):
        assert got.shape == (0, 3)


def test_waves_decay_by_their_frequency_and_without_mass_a_vertex_stays():
    """The sign, the step, the weights or the mass; Taubin's second step is taken forwards."""
    edges, angle = np.array([[k, (k + 1) % 8] for k in range(8)]), np.arange(8) * np.pi / 4
    waves = np.cos(np.arange(5)[:, None, None] * angle[:, None])
    mu = (2 - 2 * np.cos(np.arange(5) * np.pi / 4)) * 1.5 / 3.0
    around = edges, np.full(8, 1.5), np.full(8, 3.0)
    smooth = regularization.smooth_explicit(waves.sum(0), *around, 0.4)
    assert_close(smooth, ((1 - 0.4 * mu)[:, None, None] * waves).sum(0))
    taubin = regularization.smooth_taubin(waves.sum(0), *around, 0.5, 0.6, 3)
    factor = ((1 - 0.5 * mu) * (1 + 0.6 * mu))**3
    assert_close(taubin, (factor[:, None, None] * waves).sum(0))
    x, edges = np.array([[0.0], [4.0], [10.0]]), np.array([[0, 1], [1, 2]])
    got = regularization.smooth_explicit(x, edges, np.ones(2), np.array([2.0, 0.0, 0.5]), 0.25)
    assert_close(got, [[0.5], [4.0], [7.0]])
