"""The reference on whole meshes: Laplacians, smoothing, flips, relaxation, and broken input."""
import numpy as np
import pytest
import scipy.spatial

from course.experiments import relaxation
from course.given import distances, mesh
from course.given.gradcheck import gradcheck
from reference import inverse_rendering, regularization


def cotangent_laplacian(vertices, faces):
    """L (V, V) and M (V,) of a mesh."""
    edges, face_edges = mesh.edges(faces)
    cotangents = regularization.cotangents(vertices[faces])
    weights = regularization.cotangent_weights(cotangents, face_edges, len(edges))
    areas = regularization.vertex_areas(vertices[faces], faces, len(vertices))
    return edges, weights, areas


def volume(vertices, faces):
    return regularization.enclosed_volume(vertices[faces])


def random_flips(vertices, faces, rng, count=200):
    """Some edges of a closed mesh flipped by chance, where that keeps it a manifold."""
    for _ in range(count):
        quads, quad_faces, _ = regularization.edge_quads(faces)
        one = rng.integers(len(quads))
        edges, _ = mesh.edges(faces)
        if (edges == np.sort(quads[one, 2:])).all(1).any():
            continue
        faces = faces.copy()
        faces[quad_faces[one]] = regularization.flip(quads[[one]])[0]
    return faces


def test_the_laplacians_of_the_bunny_are_symmetric_and_their_rows_sum_to_0():
    """An edge counts from one side only."""
    vertices, faces = mesh.bunny()
    edges, weights, _ = cotangent_laplacian(vertices, faces)
    for each in np.ones(len(edges)), weights:
        L = regularization.laplacian(edges, each, len(vertices))
        assert abs(L - L.T).max() <= 1e-12
        np.testing.assert_allclose(L.sum(1), 0, atol=1e-11)
        expected = np.zeros_like(vertices)
        for side in edges.T, edges.T[::-1]:
            flow = each[:, None] * (vertices[side[0]] - vertices[side[1]])
            np.add.at(expected, side[0], flow)
        np.testing.assert_allclose(L @ vertices, expected, atol=1e-10)


def test_the_cotangent_laplacian_is_the_gradient_of_the_area():
    """Another factor or sign: L x is the gradient of the bunny's area by its vertices."""
    vertices, faces = mesh.bunny()
    expected = np.zeros_like(vertices)
    normals = mesh.face_normals(vertices, faces)
    for k in range(3):
        opposite = vertices[faces[:, k - 1]] - vertices[faces[:, k - 2]]
        np.add.at(expected, faces[:, k], np.cross(normals, opposite) / 2)
    edges, weights, _ = cotangent_laplacian(vertices, faces)
    got = regularization.laplacian(edges, weights, len(vertices)) @ vertices
    np.testing.assert_allclose(got, expected, atol=1e-10)


def test_a_plane_keeps_its_linear_functions():
    """A force inside a triangulated plane, or one that is hidden by an average."""
    points = np.random.default_rng(7).uniform(-1, 1, (400, 2))
    triangulation = scipy.spatial.Delaunay(points)
    vertices = np.column_stack([points, points @ [0.5, -2.0] + 1])
    edges, weights, _ = cotangent_laplacian(vertices, triangulation.simplices.astype(int))
    inner = np.setdiff1d(np.arange(400), triangulation.convex_hull)
    force = regularization.laplacian(edges, weights, 400) @ vertices
    assert np.abs(force[inner]).max() <= 1e-10 * np.abs(weights).max()


def test_areas_are_shared_and_sum_to_the_surface():
    """A vertex has all of its faces' areas, or one of no face has some; or a wrong gradient."""
    given = np.array([[[0.0, 0, 0], [3, 0, 0], [0, 0, 2]], [[0, 1, 0], [0, 1, 6], [2, 1, 0]]])
    faces = np.array([[0, 3, 1], [5, 3, 0]])
    np.testing.assert_allclose(regularization.vertex_areas(given, faces, 7), [3, 1, 0, 3, 0, 2, 0])
    gradcheck(lambda t: regularization.vertex_areas(t, faces, 7),
              lambda grad_areas, t: regularization.vertex_areas_backward(grad_areas, t, faces),
              (given,), name="vertex_areas")
    flat = regularization.vertex_areas_backward(np.ones(7), np.zeros((2, 3, 3)), faces)
    np.testing.assert_array_equal(flat, 0)


def test_the_energy_of_lab_9_is_the_one_for_uniform_weights_and_squared_valences():
    """Two labs that mean different energies by one word. One vertex has no edge."""
    vertices, faces = with_an_isolated_vertex()
    edges, _ = mesh.edges(faces)
    around = edges, np.ones(len(edges)), np.bincount(edges.ravel(), minlength=len(vertices))**2
    np.testing.assert_allclose(regularization.laplacian_energy(vertices, *around),
                               inverse_rendering.laplacian_energy(vertices, edges), rtol=1e-12)
    got, *_ = regularization.laplacian_energy_backward(0.3, vertices, *around)
    expected = inverse_rendering.laplacian_energy_backward(0.3, vertices, edges)
    np.testing.assert_allclose(got, expected, atol=1e-12)


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


def test_both_faces_of_a_flipped_edge_stay_counter_clockwise():
    """One of the faces looks the other way, or the two come in another order."""
    got = regularization.flip(np.array([[5, 6, 7, 8], [0, 1, 2, 3]]))
    np.testing.assert_array_equal(got, [[[5, 8, 7], [6, 7, 8]], [[0, 3, 2], [1, 2, 3]]])


def test_a_flip_takes_an_edge_from_two_vertices_and_gives_it_to_two_others():
    """After less before; squares instead of sums; or 6 for all."""
    valence = np.array([[7, 7, 5, 5], [6, 6, 6, 6], [7, 6, 6, 5], [5, 5, 7, 7], [9, 6, 5, 6]])
    target = np.array([[6, 6, 6, 6], [6, 6, 4, 6], [6, 6, 6, 6], [6, 6, 6, 6], [6, 6, 6, 6]])
    got = regularization.valence_gain(valence, target)
    np.testing.assert_array_equal(got, [4, -4, 0, -4, 0])


def test_flips_in_the_plane_end_at_the_delaunay_triangulation():
    """Flips end too soon, or a flip breaks the mesh."""
    rng = np.random.default_rng(5)
    points = rng.uniform(0, 1, (200, 2))
    faces = scipy.spatial.Delaunay(points).simplices.astype(int)
    vertices = np.column_stack([points, 0 * points[:, 0]])
    goal = mesh.edges(faces)[0]
    for _ in range(300):  # flip edges by chance, as long as the two faces form a convex quad
        quads, quad_faces, _ = regularization.edge_quads(faces)
        one = quads[[rng.integers(len(quads))]]
        if regularization.can_flip(vertices, faces, one)[0]:
            where = (quads == one).all(1)
            faces = faces.copy()
            faces[quad_faces[where][0]] = regularization.flip(one)[0]
    assert not np.array_equal(mesh.edges(faces)[0], goal)
    flipped = regularization.flip_to_delaunay(vertices, faces)
    np.testing.assert_array_equal(mesh.edges(flipped)[0], goal)


def test_flips_bring_valences_to_6_and_keep_the_mesh_closed():
    """An edge of more than two faces, a face that looks inwards, or no better valences."""
    vertices, faces = mesh.icosphere(1280)
    shuffled = random_flips(vertices, faces, np.random.default_rng(2))
    flipped = regularization.flip_to_valence_6(vertices, shuffled)
    off = [np.abs(np.bincount(mesh.edges(f)[0].ravel()) - 6).sum() for f in (shuffled, flipped)]
    assert off[1] < 0.5 * off[0]
    assert len(mesh.boundary_edges(flipped)) == 0 and (mesh.edge_faces(flipped) >= 0).all()
    assert len(mesh.edges(flipped)[0]) == len(mesh.edges(faces)[0])


def test_a_face_without_area_is_flipped_away():
    """Its normal is 0, and never like the others: it stays for ever."""
    vertices = np.array([[0.0, 0, 0], [4, 0, 0], [2, 0, 0], [1, -3, 0], [0, 5, 0], [4, 5, 0]])
    faces = np.array([[0, 1, 2], [1, 0, 3], [0, 2, 4], [2, 1, 5], [2, 5, 4]])
    flipped = regularization.flip_to_delaunay(vertices, faces)
    assert {frozenset(face) for face in flipped[:2].tolist()} == {frozenset({0, 2, 3}),
                                                                  frozenset({1, 2, 3})}
    assert (mesh.face_normals(vertices, flipped) == [0, 0, 1]).all()


def test_a_bad_real_mesh_becomes_round_and_stays_where_it_is():
    """The teapot's triangles have a mean least angle of 23 degrees. At least 40 are asked for, and
    that neither surface is 0.5 % of the diagonal away from the other one, at any of its samples.
    """
    vertices, faces = relaxation.split_in_four(*relaxation.closed_seams(*mesh.teapot()))
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    moved, flipped = regularization.relax(vertices, faces, 0.004 * diagonal)
    before, after = (regularization.corner_angles(x[f]).min(1) for x, f in
                     ((vertices, faces), (moved, flipped)))
    assert np.degrees(before.mean()) < 23 and np.degrees(after.mean()) >= 40
    assert len(mesh.boundary_edges(flipped)) == len(mesh.boundary_edges(faces))
    b = np.random.default_rng(0).dirichlet([1, 1, 1], (2, len(faces)))[..., None]
    for k, (x, f, to_x, to_f) in enumerate(((vertices, faces, moved, flipped),
                                            (moved, flipped, vertices, faces))):
        points = np.concatenate([(b[k] * x[f]).sum(1), x])
        found = distances.closest_points(points, to_x, to_f)
        assert np.linalg.norm(found - points, axis=1).max() < 0.005 * diagonal


def test_a_gradient_is_spread_and_keeps_its_sum():
    """L itself is applied, not the inverse; or the I is left out."""
    x, edges = np.array([[0.0], [3.0]]), np.array([[0, 1]])
    got = regularization.precondition(x, edges, np.ones(1), 1.0)
    np.testing.assert_allclose(got, [[1.0], [2.0]])


def test_all_elements_go_the_way_of_the_gradient():
    """Each element has its own root, as in Adam; 0/0 without a gradient."""
    x, grad_x, zero = np.zeros(2), np.array([4.0, -100.0]), np.zeros(2)
    x, mean, square = regularization.uniform_adam_step(x, grad_x, zero, zero, 1, 0.25)
    np.testing.assert_allclose(x, [-0.01, 0.25])
    np.testing.assert_allclose([mean, square], [[0.4, -10.0], [0.016, 10.0]])
    still, *_ = regularization.uniform_adam_step(x, zero, zero, zero, 1, 0.25)
    np.testing.assert_array_equal(still, x)
    one = np.array([2.0]), np.array([0.3]), np.array([0.1]), np.array([0.2]), 5, 0.1
    for got, expected in zip(regularization.uniform_adam_step(*one),
                             inverse_rendering.adam_step(*one), strict=True):
        np.testing.assert_allclose(got, expected, rtol=1e-15)


def test_a_large_step_moves_the_neighbourhood_and_not_a_spike():
    """The plain step tears one vertex out of the surface."""
    vertices, faces = mesh.icosphere(320)
    edges, _ = mesh.edges(faces)
    grad, zero = np.zeros_like(vertices), np.zeros_like(vertices)
    grad[0] = -vertices[0]
    moved, *_ = regularization.large_step(vertices, grad, zero, zero, 1, 0.1, edges,
                                          np.ones(len(edges)), 5.0)
    move = np.linalg.norm(moved - vertices, axis=1)
    neighbours = edges[(edges == 0).any(1)].sum(1)
    assert move.argmax() == 0 and (move[neighbours] > 0.5 * move[0]).all()


# Broken input: a right answer, or one sentence

BOX, BOX_FACES = mesh.cube(48)
BOX = BOX + np.random.default_rng(4).normal(0, 0.02, BOX.shape)


def without_a_face():
    return BOX, BOX_FACES[1:]


def with_an_isolated_vertex():
    return np.concatenate([BOX, [[5.0, 5.0, 5.0]]]), BOX_FACES


def with_a_third_face_at_an_edge():
    a, b, _ = BOX_FACES[0]
    return np.concatenate([BOX, [[3.0, 3.0, 3.0]]]), np.vstack([BOX_FACES, [a, b, len(BOX)]])


def with_a_face_twice():
    return BOX, np.vstack([BOX_FACES, BOX_FACES[:1]])


def with_a_vertex_twice():
    faces = BOX_FACES.copy()
    faces[0, 0] = len(BOX)
    return np.concatenate([BOX, BOX[BOX_FACES[:1, 0]]]), faces


def with_a_face_turned_round():
    faces = BOX_FACES.copy()
    faces[0] = faces[0, ::-1]
    return BOX, faces


def with_a_face_without_area():
    vertices = BOX.copy()
    a, b, c = BOX_FACES[0]
    vertices[a] = (vertices[b] + vertices[c]) / 2
    return vertices, BOX_FACES


@pytest.mark.parametrize("broken", [without_a_face, with_an_isolated_vertex, with_a_face_twice,
                                    with_a_third_face_at_an_edge, with_a_vertex_twice,
                                    with_a_face_turned_round, with_a_face_without_area])
def test_a_broken_mesh_is_smoothed_and_relaxed(broken):
    """NaN, an error, or vertices beside the broken place that slide into it."""
    vertices, faces = broken()
    edges, weights, areas = cotangent_laplacian(vertices, faces)
    for smooth in regularization.smooth_explicit, regularization.smooth_implicit:
        assert np.isfinite(smooth(vertices, edges, weights, areas, 1e-3)).all()
    moved, flipped = regularization.relax(vertices, faces, 1.0)
    assert np.isfinite(moved).all() and flipped.shape == faces.shape
    *_, held = regularization.edge_quads(faces)
    np.testing.assert_array_equal(moved[held], vertices[held])
    assert set(map(tuple, held)) <= set(map(tuple, regularization.edge_quads(flipped)[2]))
    unused = np.setdiff1d(np.arange(len(vertices)), faces)
    np.testing.assert_array_equal(moved[unused], vertices[unused])


def test_a_mesh_that_is_all_border_stays():
    """An error where no vertex is free."""
    vertices, faces = np.eye(3), np.array([[0, 1, 2]])
    moved, flipped = regularization.relax(vertices, faces, 1.0)
    np.testing.assert_array_equal(moved, vertices)
    np.testing.assert_array_equal(flipped, faces)


@pytest.mark.parametrize("vertices, faces, sentence", [
    (np.eye(3), np.array([[0, 1, 1]]), "face 0 names a vertex twice"),
    (np.eye(3), np.array([[0, 1, 3]]), "face 0 names vertex 3, but there are 3 vertices"),
    (np.full((3, 3), np.nan), np.array([[0, 1, 2]]), "vertices must be finite"),
    (np.eye(3), np.zeros((0, 3), int), "at least one face"),
])
def test_what_is_no_mesh_is_refused_in_a_sentence(vertices, faces, sentence):
    """An index error from deep inside."""
    with pytest.raises(ValueError, match=sentence):
        regularization.relax(vertices, faces, 1.0)


@pytest.mark.parametrize("asked", [(np.nan,), (-1.0,), (None,), (1.0, -3), (1.0, 2.5)])
def test_a_tolerance_or_steps_that_make_no_sense_are_refused(asked):
    """Nothing happens, or everything slides."""
    with pytest.raises(ValueError, match="tolerance >= 0 and a whole number steps >= 0, got"):
        regularization.relax(BOX, BOX_FACES, *asked)


def test_lists_and_other_kinds_of_integers_are_meshes_too():
    """An error from deep inside."""
    expected = regularization.relax(BOX, BOX_FACES, 1.0)
    for other in BOX_FACES.tolist(), BOX_FACES.astype(np.uint64), BOX_FACES.astype(np.int8):
        got = regularization.relax(BOX.tolist(), other, 1.0)
        assert all(np.array_equal(*each) for each in zip(got, expected, strict=True))
