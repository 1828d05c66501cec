"""The reference's whole meshes of lab 15: closed, outward, and as near as the cells are small."""
import time

import numpy as np
import pytest
import scipy.sparse

from course.given import inputs, mesh
from course.given.gradcheck import gradcheck
from course.scenes import representations
from reference import implicit_surfaces, marching_tetrahedra, regularization, subdivision


def marched(shape, n):
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(n)
    distance = implicit_surfaces.signed_distance(points, shape)
    return marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)[:2]


def area(vertices, faces):
    return np.linalg.norm(mesh.area_vectors(vertices, faces), axis=-1).sum() / 2


def volume(vertices, faces):
    return regularization.enclosed_volume(vertices[faces])


def test_trilinear_weights_give_linear_functions_back():
    """The order of axes differs from the grid's points, or weights are swapped."""
    n, rng = 5, np.random.default_rng(5)
    points, _ = marching_tetrahedra.tetrahedral_grid(n)
    plane = points @ [1.0, 20.0, 300.0] + 4.0
    there = np.concatenate([rng.uniform(-1, 1, (200, 3)), points, [[1.0, 1.0, 1.0]]])
    weights = marching_tetrahedra.grid_weights(there, n)
    assert scipy.sparse.issparse(weights) and weights.shape == (len(there), (n + 1)**3)
    np.testing.assert_allclose(weights @ plane, there @ [1.0, 20.0, 300.0] + 4.0, atol=1e-10)
    np.testing.assert_allclose(weights.sum(1), 1)
    beyond = marching_tetrahedra.grid_weights(np.array([[1.01, 0, 0], [0, -2, 0]]), n)
    assert abs(beyond).sum() == 0


@pytest.mark.parametrize("nowhere", [np.inf, -np.inf, np.nan, 1e300])
def test_nothing_is_looked_up_nowhere(nowhere):
    """0 times infinity is NaN, and NaN as an index is an address outside of the grid."""
    points = np.zeros((3, 3))
    points[1, 2] = nowhere
    weights = marching_tetrahedra.grid_weights(points, 2)
    assert (weights.indices >= 0).all() and (weights.indices < 27).all()
    np.testing.assert_array_equal(weights @ np.ones(27), [1, 0, 1])


@pytest.mark.parametrize("n", [1, 2, 5])
def test_the_grid_fills_the_cube_with_tetrahedra_that_fit(n):
    """Some are turned over, overlap, or meet along crossing diagonals."""
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(n)
    assert points.shape == ((n + 1)**3, 3) and tetrahedra.shape == (6 * n**3, 4)
    a, b, c, d = points[tetrahedra.T]
    np.testing.assert_allclose(((b - a) * np.cross(c - a, d - a)).sum(-1) / 6, 8 / (6 * n**3))
    triangles = np.sort(tetrahedra[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3))
    triangles, count = np.unique(triangles, axis=0, return_counts=True)
    on_border = (np.abs(points[triangles].sum(1)) > 3 - 1e-9).any(-1)
    np.testing.assert_array_equal(count, np.where(on_border, 1, 2))


@pytest.mark.parametrize("seed", range(5))
def test_random_fields_give_closed_manifolds_wound_outward(seed):
    """A border, an edge of four faces, two fans at one vertex, or neighbours wound against each
    other: all topologies occur in a field of random signs."""
    n, rng = 9, np.random.default_rng(seed)
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(n)
    distance = rng.normal(size=len(points))
    if seed == 4:
        distance = rng.integers(-1, 2, len(points)).astype(float)  # exactly 0 at a third of them
    border = (np.abs(points) == 1).any(1)
    distance[border] = np.abs(distance[border])
    vertices, faces, _ = marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)
    inputs.require_mesh(vertices, faces)
    assert_closed_manifold(len(vertices), faces)
    # Each tetrahedron's part of the inside, cut into simplices by the same linear field.
    if seed < 4:
        np.testing.assert_allclose(volume(vertices, faces), inside_volume(points, distance, n),
                                   rtol=0.02)


def assert_closed_manifold(count, faces):
    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    along, against = (np.sort(a * count + b) for a, b in ((start, end), (end, start)))
    assert (np.diff(along) > 0).all()           # each directed edge once
    np.testing.assert_array_equal(along, against)
    _, fans = subdivision.split_fans(faces.ravel(), np.full(len(faces), 3))
    assert len(fans) == count == len(np.unique(faces))  # one around each vertex


def inside_volume(points, distance, n, steps=6):
    """The part of the cube where the field, linear in each tetrahedron, is negative: by samples."""
    samples = (np.arange(steps * n) + 0.5) / (steps * n) * 2 - 1
    at = np.stack(np.meshgrid(samples, samples, samples, indexing="ij"), -1).reshape(-1, 3)
    place = (at + 1) * n / 2
    low = np.floor(place).astype(int)
    part = place - low
    order = np.argsort(-part, axis=1)           # the way along which the cube's corners are visited
    s = distance.reshape(n + 1, n + 1, n + 1)
    corner, value = low.copy(), s[tuple(low.T)]
    for k in range(3):
        axis, last = order[:, k], s[tuple(corner.T)]
        corner[np.arange(len(corner)), axis] += 1
        value = value + part[np.arange(len(corner)), axis] * (s[tuple(corner.T)] - last)
    return (value < 0).mean() * 8


@pytest.mark.parametrize(("shape", "true_area", "true_volume"), [
    (("sphere", 0.8), 4 * np.pi * 0.64, 4 / 3 * np.pi * 0.512),
    (("torus", 0.6, 0.25), 4 * np.pi**2 * 0.15, 2 * np.pi**2 * 0.6 * 0.0625),
], ids=["sphere", "torus"])
def test_area_and_volume_converge_with_the_square_of_the_cell(shape, true_area, true_volume):
    """Vertices are not on the surface to second order, as with the middles of edges."""
    meshes = [marched(shape, n) for n in (12, 24, 48)]
    for measure, truth in (area, true_area), (volume, true_volume):
        errors = np.array([abs(measure(*m) / truth - 1) for m in meshes])
        order = np.log2(errors[:-1] / errors[1:])
        assert (1.8 < order).all() and (order < 2.2).all() and errors[-1] < 5e-3


def test_the_wheel_has_five_holes():
    """A spoke or the bore is lost: V - E + F = 2 - 2 genus."""
    vertices, faces = marched(representations.WHEEL, 48)
    assert_closed_manifold(len(vertices), faces)
    assert len(vertices) - len(mesh.edges(faces)[0]) + len(faces) == 2 - 2 * 5


def test_gradients_of_whole_meshes_are_central_differences():
    """A grid point that many edges share gets the gradient of one, or ends are swapped."""
    n, rng = 2, np.random.default_rng(6)
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(n)
    points = points + rng.uniform(-0.1, 0.1, points.shape)
    distance = rng.choice([-1, 1], len(points)) * rng.uniform(0.3, 1, len(points))
    _, _, ends = marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)

    def forward(points, distance):
        return marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)[0]

    def backward(grad_vertices, points, distance):
        return marching_tetrahedra.marching_tetrahedra_backward(grad_vertices, ends, points,
                                                                distance)

    gradcheck(forward, backward, (points, distance), decisions=lambda p, s: s < 0, name="marching")


def test_64_cubed_cells_take_half_a_second_at_most():
    """All tetrahedra are worked on, and not only those that the surface crosses."""
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(64)
    distance = implicit_surfaces.signed_distance(points, ("torus", 0.6, 0.25))
    seconds = []
    for _ in range(3):
        start = time.process_time()
        vertices, _, ends = marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)
        marching_tetrahedra.marching_tetrahedra_backward(vertices, ends, points, distance)
        seconds.append(time.process_time() - start)
    assert min(seconds) <= 0.5


def test_a_ball_opens_to_a_ring():
    """The gradient of distances does not change the topology, or leads elsewhere."""
    goal, n = ("torus", 0.55, 0.25), 14
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(n)
    distance, euler = implicit_surfaces.signed_distance(points, ("sphere", 0.85)), []
    for _ in range(150):
        vertices, faces, ends = marching_tetrahedra.marching_tetrahedra(points, distance,
                                                                        tetrahedra)
        off = implicit_surfaces.signed_distance(vertices, goal)
        euler.append(len(vertices) - len(mesh.edges(faces)[0]) + len(faces))
        a, b, c = vertices[faces.T]
        push = np.zeros(vertices.shape)
        for corner in faces.T:
            np.add.at(push, corner, np.cross(b - a, c - a) / 6)
        _, grad_distance = marching_tetrahedra.marching_tetrahedra_backward(
            off[:, None] * push, ends, points, distance)
        distance = distance - 3 * (n / 2)**2 * grad_distance
    assert (euler[0], euler[-1]) == (2, 0)
    assert np.abs(off).mean() < 0.1 * 2 / n


def test_a_crossing_on_paper():
    """The nearer end is the one of less distance, the signs or the two weights are swapped, a guard
    is added to s_b - s_a, or small distances are cut off.
    """
    p_a, p_b = np.array([[1.0, 2.0, 3.0]] * 3), np.array([[5.0, -2.0, 3.0]] * 3)
    s_a, s_b = np.array([-1.0, -3.0, -2.0]), np.array([3.0, 1.0, 0.0])
    for unit in 1e-9, 1e-3, 1.0, 1e6:
        got = marching_tetrahedra.zero_crossing(p_a, p_b, unit * s_a, unit * s_b)
        np.testing.assert_allclose(got, [[2.0, 1.0, 3.0], [4.0, -1.0, 3.0], [5.0, -2.0, 3.0]])
