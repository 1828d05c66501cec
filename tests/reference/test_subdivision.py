"""What lab 11 composes: S of whole meshes, several steps, limits, and what it refuses."""
import itertools
from pathlib import Path

import numpy as np
import pytest
import scipy.spatial

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import subdivision

PUBLISHED = Path(__file__).parent.parent / "golden" / "subdivision.npz"
WEIGHTS = subdivision.warren_weight, subdivision.loop_weight
each_weight = pytest.mark.parametrize("weight", WEIGHTS, ids=lambda weight: weight.__name__)

MOEBIUS = np.array([[k, (k + 1) % 10, (k + 2) % 10] for k in range(10)])
TETRAHEDRON = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]]
CUBE = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4],
                 [1, 5, 7, 3]])
CUBE_VERTICES = np.stack(np.meshgrid([-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], indexing="ij"),
                         -1).reshape(-1, 3)


def with_holes(vertices, faces, rng):
    """Without the faces at two far vertices: two holes, and two vertices of no face."""
    removed = [0, np.linalg.norm(vertices - vertices[0], axis=1).argmax()]
    return vertices, rng.permutation(faces[~np.isin(faces, removed).any(1)])


def triangle_meshes():
    rng = np.random.default_rng(0)
    return {
        "sphere": mesh.icosphere(80), "torus": mesh.torus(100), "sheet": mesh.plane(32),
        "sphere with holes": with_holes(*mesh.icosphere(180), rng),
        "torus with holes": with_holes(*mesh.torus(144), rng),
        "band with a twist": (rng.normal(size=(10, 3)), MOEBIUS),
        "cube and a sheet": together(mesh.cube(12), mesh.plane(8)),
        "irregular, open": irregular(60, rng),
    }


def irregular(count, rng):
    """Points in a square and their Delaunay triangles, those in the middle away."""
    points = rng.random((count, 2))
    faces = scipy.spatial.Delaunay(points).simplices.astype(np.int64)
    kept = np.linalg.norm(points[faces].mean(1) - 0.5, axis=1) > 0.2
    corners, origin = subdivision.split_fans(*subdivision.triangles(faces[kept]))
    return np.stack([*points[origin].T, rng.random(len(origin))], axis=1), corners.reshape(-1, 3)


def plate_with_two_holes():
    """5 x 3 squares, the second and the fourth of the middle row missing, as a thick plate."""
    squares = [(x, y) for y in range(3) for x in range(5) if (x, y) not in ((1, 1), (3, 1))]
    number, faces = {}, []
    for x, y in squares:
        ring = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
        faces += [[(*c, 1) for c in ring], [(*c, 0) for c in ring[::-1]]]
        for (dx, dy), a, b in zip([(0, -1), (1, 0), (0, 1), (-1, 0)], ring, ring[1:] + ring[:1],
                                  strict=True):
            if (x + dx, y + dy) not in squares:
                faces.append([(*a, 0), (*b, 0), (*b, 1), (*a, 1)])
    corners = [number.setdefault(corner, len(number)) for face in faces for corner in face]
    return np.array(list(number), float), np.array(corners), np.full(len(faces), 4)


def together(one, other):
    return (np.concatenate([one[0], other[0] + 5.0]),
            np.concatenate([one[1], other[1] + len(one[0])]))


def polygon_meshes():
    """Quads, and some of them joined or cut: vertices, corners, counts."""
    with np.load(PUBLISHED) as published:
        pyramid = tuple(published[f"pyramid/{key}"] for key in ("vertices", "corners", "counts"))
    rng = np.random.default_rng(1)
    faces = [[0, 1, 2, 3], [3, 2, 4, 5, 6], [2, 1, 7], [7, 8, 4, 2], [6, 5, 10]]
    house = np.concatenate(faces), np.array([len(face) for face in faces])
    return {"cube": (CUBE_VERTICES, CUBE.ravel(), np.full(6, 4)), "pyramid": pyramid,
            "house, open": (rng.normal(size=(12, 3)), *house),
            "two holes": plate_with_two_holes(),
            "triangles": (mesh.torus(36)[0], *subdivision.triangles(mesh.torus(36)[1])),
            "band with a twist": (rng.normal(size=(10, 3)), *subdivision.triangles(MOEBIUS))}


MESHES, POLYGONS = triangle_meshes(), polygon_meshes()
each_mesh = pytest.mark.parametrize("vertices, faces", MESHES.values(), ids=MESHES)
each_polygon_mesh = pytest.mark.parametrize("vertices, corners, counts", POLYGONS.values(),
                                            ids=POLYGONS)


def valence_and_boundary(corners, counts, vertex_count):
    edges, _, is_boundary = subdivision.topology(corners, counts, vertex_count)
    at_boundary = np.isin(np.arange(vertex_count), edges[is_boundary])
    return subdivision.valences(edges, vertex_count), at_boundary


# --- both versions, and others' ------------------------------------------------------------------

@each_weight
@each_mesh
def test_loops_matrix_agrees_with_the_slow_version(vertices, faces, weight):
    """Two versions of one scheme that differ at a hole, an isolated vertex or an odd valence."""
    n, _ = valence_and_boundary(*subdivision.triangles(faces), len(vertices))
    slow = subdivision.loop_slow(vertices, faces, weight(np.maximum(n, 1)))
    fast, _ = subdivision.loop(vertices, faces, weight)
    np.testing.assert_allclose(fast, slow, rtol=0, atol=1e-12)


@each_polygon_mesh
def test_catmull_clarks_matrix_agrees_with_the_slow_version(vertices, corners, counts):
    """The same for polygons, and a second step, of quads only."""
    for _ in range(2):
        slow = subdivision.catmull_clark_slow(vertices, corners, counts)
        vertices, corners, counts = subdivision.catmull_clark(vertices, corners, counts)
        np.testing.assert_allclose(vertices, slow, rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", ["pyramid", "square"])
def test_two_steps_of_catmull_clark_are_the_published_ones(name):
    """Another boundary rule than OpenSubdiv's smooth corners, or other rules for triangles."""
    with np.load(PUBLISHED) as published:
        polygons = tuple(published[f"{name}/{key}"] for key in ("vertices", "corners", "counts"))
        for step in 1, 2:
            polygons = subdivision.catmull_clark(*polygons)
            assert farthest(polygons[0], published[f"{name}/step_{step}"]) < 1e-6


def test_a_cube_after_a_step_of_catmull_clark():
    """Points of a cube that many texts print: 5/9 at the corners, 3/4 on the edges, 1 on faces."""
    new, _, _ = subdivision.catmull_clark(*POLYGONS["cube"])
    np.testing.assert_allclose(new[:8], 5 / 9 * CUBE_VERTICES, rtol=1e-14)
    np.testing.assert_allclose(np.sort(np.abs(new[8:20]), 1), np.tile([0, 3 / 4, 3 / 4], (12, 1)))
    np.testing.assert_allclose(np.sort(np.abs(new[20:]), 1), np.tile([0, 0, 1.0], (6, 1)))


def test_with_loops_own_weights_the_published_cube_comes_out_and_with_warrens_it_does_not():
    """The weights' names are swapped, or there is no difference at valences 4 and 5."""
    with np.load(PUBLISHED) as published:
        vertices, faces, expected = (published[f"cube/{key}"]
                                     for key in ("vertices", "faces", "step_1"))
    warren, loop = (farthest(subdivision.loop(vertices, faces, weight)[0], expected)
                    for weight in WEIGHTS)
    assert loop < 1e-6 and 0.02 < warren < 0.03


def farthest(points, expected):
    """How far the farthest point of either set is from the other set."""
    assert points.shape == expected.shape
    distance = np.linalg.norm(points[:, None] - expected, axis=-1)
    return max(distance.min(0).max(), distance.min(1).max())


def test_the_two_weights_are_equal_at_valences_3_and_6_only():
    """Libraries are split between them; on regular meshes nobody sees it."""
    n = np.arange(3, 30)
    equal = np.isclose(subdivision.warren_weight(n), subdivision.loop_weight(n), rtol=1e-12)
    np.testing.assert_array_equal(n[equal], [3, 6])


@each_mesh
def test_loop_is_that_of_libigl(vertices, faces):
    """Another scheme than libigl's at a boundary or an odd valence; it must be installed for this.

    Faces must be wound alike for it, and vertices of no face are left out, as it forgets them.
    """
    igl = pytest.importorskip("igl")
    if faces is MOEBIUS:
        pytest.skip("a band that cannot be wound alike")
    used, faces = np.unique(faces, return_inverse=True)
    vertices, faces = vertices[used], faces.reshape(-1, 3)
    theirs = igl.loop(vertices, faces, 1)
    ours = subdivision.loop(vertices, faces)
    assert len(theirs[1]) == len(ours[1])
    np.testing.assert_allclose(theirs[0][:len(vertices)], ours[0][:len(vertices)], rtol=0,
                               atol=1e-12)
    assert farthest(ours[0], np.asarray(theirs[0])) < 1e-12


def test_two_handles_make_minus_two():
    """A handle counts once, or a hole in plain words is taken for a boundary."""
    _, corners, counts = POLYGONS["two holes"]
    assert not subdivision.topology(corners, counts, corners.max() + 1)[2].any()
    assert subdivision.euler_characteristic(corners, counts) == 2 - 2 * 2


# --- what a step keeps --------------------------------------------------------------------------

def every_matrix():
    for name, (vertices, faces) in MESHES.items():
        for weight in WEIGHTS:
            yield f"{name}, {weight.__name__}", vertices, subdivision.loop_matrix(
                faces, len(vertices), weight)
            yield f"{name}, limit", vertices, subdivision.loop_limit_matrix(
                faces, len(vertices), weight)
    for name, (vertices, corners, counts) in POLYGONS.items():
        yield f"{name}, Catmull-Clark", vertices, subdivision.catmull_clark_matrix(
            corners, counts, len(vertices))
        quads = subdivision.catmull_clark(vertices, corners, counts)
        yield f"{name}, limit of quads", quads[0], subdivision.catmull_clark_limit_matrix(
            *quads[1:], len(quads[0]))


MATRICES = list(every_matrix())
each_matrix = pytest.mark.parametrize("vertices, S", [case[1:] for case in MATRICES],
                                      ids=[case[0] for case in MATRICES])


@each_matrix
def test_rows_sum_to_one(vertices, S):
    """A mesh that moves when the origin does."""
    np.testing.assert_allclose(S.sum(1), 1, rtol=0, atol=1e-14)


@each_matrix
def test_a_flat_mesh_stays_flat(vertices, S):
    """A weight that is not affine."""
    normal, height = np.array([0.48, -0.6, 0.64]), 0.7
    flat = vertices - np.outer(vertices @ normal - height, normal)
    np.testing.assert_allclose(S @ flat @ normal, height, rtol=0, atol=1e-14)


@each_mesh
def test_loop_keeps_the_topology(vertices, faces):
    """A seam opens or closes: Euler's number, boundary edges doubled, faces times four."""
    _, _, before = subdivision.topology(*subdivision.triangles(faces), len(vertices))
    new, children = subdivision.loop(vertices, faces)
    _, _, after = subdivision.topology(*subdivision.triangles(children), len(new))
    assert len(children) == 4 * len(faces) and after.sum() == 2 * before.sum()
    assert (subdivision.euler_characteristic(*subdivision.triangles(children))
            == subdivision.euler_characteristic(*subdivision.triangles(faces)))


@each_polygon_mesh
def test_catmull_clark_keeps_the_topology(vertices, corners, counts):
    """The same for polygons: as many quads as corners."""
    _, _, before = subdivision.topology(corners, counts, len(vertices))
    new, *quads = subdivision.catmull_clark(vertices, corners, counts)
    _, _, after = subdivision.topology(*quads, len(new))
    assert len(quads[1]) == counts.sum() and after.sum() == 2 * before.sum()
    assert (subdivision.euler_characteristic(*quads)
            == subdivision.euler_characteristic(corners, counts))


@each_mesh
def test_after_loop_old_valences_stay_and_new_ones_are_regular(vertices, faces):
    """A new vertex of another valence than 6 inside and 4 on the boundary."""
    old, _ = valence_and_boundary(*subdivision.triangles(faces), len(vertices))
    new, children = subdivision.loop(vertices, faces)
    n, at_boundary = valence_and_boundary(*subdivision.triangles(children), len(new))
    np.testing.assert_array_equal(n[:len(old)], old)
    assert not subdivision.is_extraordinary(n, at_boundary, 6)[len(old):].any()


@each_polygon_mesh
def test_catmull_clark_makes_one_extraordinary_vertex_of_each_polygon_that_is_no_quad(
        vertices, corners, counts):
    """Old valences change, or the number grows after the first step, too."""
    old, old_boundary = valence_and_boundary(corners, counts, len(vertices))
    expected = subdivision.is_extraordinary(old, old_boundary, 4).sum() + (counts != 4).sum()
    for _ in range(3):
        count, n_before = len(vertices), old
        vertices, corners, counts = subdivision.catmull_clark(vertices, corners, counts)
        old, at_boundary = valence_and_boundary(corners, counts, len(vertices))
        np.testing.assert_array_equal(old[:count], n_before)
        assert subdivision.is_extraordinary(old, at_boundary, 4).sum() == expected


def octahedron(weight):
    """Two steps of Loop from the points +-x, +-y, +-z."""
    faces = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
                      [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    new = np.repeat(np.eye(3), 2, axis=0) * np.tile([[1.0], [-1.0]], (3, 1)), faces
    return subdivision.loop(*subdivision.loop(*new, weight), weight)[0]


@pytest.mark.parametrize("points", [
    *map(octahedron, WEIGHTS),
    subdivision.catmull_clark(*subdivision.catmull_clark(*POLYGONS["cube"]))[0]],
    ids=["octahedron, Warren", "octahedron, Loop", "cube, Catmull-Clark"])
def test_symmetric_solids_stay_symmetric(points):
    """A direction is preferred: the 48 symmetries of a cube."""
    for axes in itertools.permutations(range(3)):
        for signs in itertools.product([1, -1], repeat=3):
            assert farthest(points[:, axes] * signs, points) < 1e-14


@each_weight
def test_the_points_of_an_icosahedron_stay_on_two_spheres(weight):
    """One of its twelve vertices, or of its thirty edges, has other weights."""
    new, _ = subdivision.loop(*mesh.icosphere(20), weight)
    radius = np.linalg.norm(new, axis=1)
    assert np.ptp(radius[:12]) < 1e-14 and np.ptp(radius[12:]) < 1e-14


@each_mesh
def test_numbers_of_faces_and_their_winding_do_not_count(vertices, faces):
    """Faces wound against each other, or in another order, give another surface."""
    rng = np.random.default_rng(2)
    other = rng.permutation(faces)
    other[::2] = other[::2, ::-1]
    np.testing.assert_allclose(subdivision.loop(vertices, np.roll(other, 1, axis=1))[0],
                               subdivision.loop(vertices, faces)[0], rtol=0, atol=1e-14)


# --- boundaries and limits ------------------------------------------------------------------------

def rows_on_the_boundary(S, corners, counts, vertex_count):
    """The rows of S for vertices and edges on the boundary, and who is on it: (V,) bool."""
    edges, _, is_boundary = subdivision.topology(corners, counts, vertex_count)
    at_boundary = np.isin(np.arange(vertex_count), edges[is_boundary])
    rows = np.concatenate([at_boundary, is_boundary])
    return S[:len(rows)][rows], at_boundary


@each_mesh
def test_loops_boundary_depends_on_the_boundary_alone(vertices, faces):
    """A vertex inside pulls at the curve: two meshes along one curve come apart."""
    S = subdivision.loop_matrix(faces, len(vertices))
    rows, at_boundary = rows_on_the_boundary(S, *subdivision.triangles(faces), len(vertices))
    assert rows[:, ~at_boundary].nnz == 0
    assert set(rows.data) <= {1 / 8, 3 / 4, 1 / 2}


@each_polygon_mesh
def test_catmull_clarks_boundary_is_the_same_curve(vertices, corners, counts):
    """A face point pulls at the curve; or corners are held."""
    S = subdivision.catmull_clark_matrix(corners, counts, len(vertices))
    rows, at_boundary = rows_on_the_boundary(S, corners, counts, len(vertices))
    assert rows[:, ~at_boundary].nnz == 0
    assert set(rows.data) <= {1 / 8, 3 / 4, 1 / 2}


def test_a_boundary_is_a_cubic_spline():
    """Another curve: a square's boundary tends to the uniform cubic B-spline of its corners."""
    corners = np.array([[0.0, 0], [8, 0], [8, 8], [0, 8]])
    new = corners, np.arange(4), np.array([4])
    for _ in range(4):
        new = subdivision.catmull_clark(*new)
    limit = subdivision.catmull_clark_limit_matrix(*new[1:], len(new[0])) @ new[0]
    t = np.arange(16)[:, None] / 16
    basis = np.hstack([(1 - t)**3, 3 * t**3 - 6 * t**2 + 4, 1 + 3 * t + 3 * t**2 - 3 * t**3, t**3])
    spline = np.concatenate([basis @ np.roll(corners, -k, axis=0) / 6 for k in range(4)])
    edges, _, is_boundary = subdivision.topology(*new[1:], len(new[0]))
    assert farthest(limit[np.unique(edges[is_boundary])], spline) < 1e-12


@each_weight
@each_mesh
def test_a_step_does_not_change_loops_limit(vertices, faces, weight):
    """m of (6) is not that of u, or the boundary's limit is not that of its rule."""
    before = subdivision.loop_limit_matrix(faces, len(vertices), weight) @ vertices
    new, children = subdivision.loop(vertices, faces, weight)
    after = subdivision.loop_limit_matrix(children, len(new), weight) @ new
    np.testing.assert_allclose(after[:len(vertices)], before, rtol=0, atol=1e-14)


@each_polygon_mesh
def test_a_step_does_not_change_catmull_clarks_limit(vertices, corners, counts):
    """(10) is not the limit of (8) and (9)."""
    vertices, corners, counts = subdivision.catmull_clark(vertices, corners, counts)
    before = subdivision.catmull_clark_limit_matrix(corners, counts, len(vertices)) @ vertices
    new = subdivision.catmull_clark(vertices, corners, counts)
    after = subdivision.catmull_clark_limit_matrix(*new[1:], len(new[0])) @ new[0]
    np.testing.assert_allclose(after[:len(vertices)], before, rtol=0, atol=1e-14)


def test_six_steps_come_near_the_limit():
    """A fixed point that the steps do not go to."""
    vertices, faces = mesh.icosphere(20)
    limit = subdivision.loop_limit_matrix(faces, 12) @ vertices
    for _ in range(6):
        vertices, faces = subdivision.loop(vertices, faces)
    assert 0 < np.abs(vertices[:12] - limit).max() < 1e-3


# --- gradients ----------------------------------------------------------------------------------

@each_weight
def test_loop_has_a_gradient(weight):
    """S for its transpose, or the other weight's."""
    vertices, faces = MESHES["band with a twist"]
    gradcheck(lambda x: subdivision.loop(x, faces, weight)[0],
              lambda grad, x: subdivision.loop_backward(grad, x, faces, weight), (vertices,),
              name="loop")


def test_catmull_clark_has_a_gradient():
    """S for its transpose; colours, two to a vertex, ride along."""
    vertices, corners, counts = POLYGONS["house, open"]
    colours = np.random.default_rng(3).random((len(vertices), 2))
    gradcheck(lambda x: subdivision.catmull_clark(x, corners, counts)[0],
              lambda grad, x: subdivision.catmull_clark_backward(grad, x, corners, counts),
              (colours,), name="catmull_clark")


# --- broken input ---------------------------------------------------------------------------------

def test_duplicate_vertices_degenerate_faces_and_isolated_vertices_are_no_error():
    """A crash or nan where faces have no area; an isolated vertex moves."""
    vertices, faces = mesh.icosphere(80)
    vertices = np.concatenate([vertices, [[5.0, 6.0, 7.0]]])
    vertices[faces[0]] = vertices[faces[0, 0]]
    new, _ = subdivision.loop(vertices, faces)
    np.testing.assert_array_equal(new[42], [5, 6, 7])
    assert np.isfinite(new).all()
    new, _, _ = subdivision.catmull_clark(vertices, *subdivision.triangles(faces))
    np.testing.assert_array_equal(new[42], [5, 6, 7])
    assert np.isfinite(new).all()


BROKEN = {
    "three faces at an edge": ([[0, 1, 2], [1, 0, 3], [0, 1, 4]], "the edge between vertices 0 and "
                               "1 has 3 faces: at most two may meet at an edge"),
    "a face twice": ([*TETRAHEDRON, [1, 2, 0]], "the edge between vertices 0 and 1 has 3 faces"),
    "bow tie": ([[0, 1, 2], [0, 3, 4]], "at vertex 0 meet 2 fans of faces that share no edge"),
    "two cones tip to tip": ([[0, 1, 2], [0, 2, 3], [0, 3, 1], [0, 4, 5], [0, 5, 6], [0, 6, 4]],
                             "at vertex 0 meet 2 fans"),
    "a vertex twice": ([[0, 1, 2], [2, 3, 2]], "face 1 names vertex 2 twice"),
    "beyond the vertices": ([[0, 1, 2], [2, 1, 7]], "face 1 names vertex 7, but there are 7"),
    "below 0": ([[0, 1, 2], [2, 1, -1]], "face 1 names vertex -1"),
    "quads": ([[0, 1, 2, 3]], r"faces must be an array \(F, 3\) of integers, F >= 1; got \(1, 4\)"),
    "no faces": (np.zeros((0, 3), int), r"F >= 1; got \(0, 3\)"),
    "one face, no row": ([0, 1, 2], r"\(F, 3\) .* got \(3,\)"),
    "not whole": ([[0.0, 1.0, 2.0]], r"faces must be .* integers, F >= 1; got \(1, 3\) of float64"),
}


@pytest.mark.parametrize("faces, sentence", BROKEN.values(), ids=BROKEN)
def test_a_broken_mesh_is_refused_in_one_sentence(faces, sentence):
    """A traceback from within NumPy, or a wrong surface."""
    with pytest.raises(ValueError, match=sentence):
        subdivision.loop(np.zeros((7, 3)), faces)
    if "F >= 1" not in sentence and np.ndim(faces) == 2:
        with pytest.raises(ValueError, match=sentence):
            subdivision.catmull_clark(np.zeros((7, 3)), np.ravel(faces), np.full(len(faces), 3))


def test_counts_that_do_not_fit_are_refused():
    """A face of two corners; corners that belong to no face; floats; a limit of triangles."""
    vertices, corners = np.zeros((4, 3)), np.array([0, 1, 2, 3])
    for counts in [2, 2], [3], [4, 4]:
        with pytest.raises(ValueError, match="counts must be at least 3 for each face and add up"):
            subdivision.catmull_clark(vertices, corners, np.array(counts))
    with pytest.raises(ValueError, match=r"counts must be integers in a row, .* float64"):
        subdivision.catmull_clark(vertices, corners, np.array([4.0]))
    with pytest.raises(ValueError, match="counts must be at least 3"):
        subdivision.catmull_clark_limit_matrix(corners, np.array([3]), 4)
    with pytest.raises(ValueError, match="face 1 is no quad: the limit is known for quads only"):
        subdivision.catmull_clark_limit_matrix(np.array([0, 1, 2, 3, 2, 1, 4]), np.array([4, 3]), 5)


def test_lists_are_arrays_too():
    """A traceback, for a list has no shape."""
    vertices, faces = mesh.icosphere(20)
    new, children = subdivision.loop(vertices, faces)
    got = subdivision.loop(vertices.tolist(), faces.tolist())
    np.testing.assert_array_equal(got[0], new)
    np.testing.assert_array_equal(got[1], children)
    np.testing.assert_array_equal(subdivision.loop_backward(new.tolist(), vertices, faces.tolist()),
                                  subdivision.loop_backward(new, vertices, faces))
    polygons = [part.tolist() for part in POLYGONS["cube"]]
    np.testing.assert_array_equal(subdivision.catmull_clark(*polygons)[0],
                                  subdivision.catmull_clark(*POLYGONS["cube"])[0])
    for matrix in subdivision.catmull_clark_matrix, subdivision.catmull_clark_limit_matrix:
        np.testing.assert_array_equal(matrix(*polygons[1:], 8).toarray(),
                                      matrix(*POLYGONS["cube"][1:], 8).toarray())


@pytest.mark.parametrize("integer", "bBhHiIqQ")
def test_integers_of_any_type_give_the_same_mesh(integer):
    """Unsigned counts that cannot be summed, or weights of half precision."""
    vertices, corners, counts = POLYGONS["house, open"]
    expected = subdivision.catmull_clark(vertices, corners, counts)
    got = subdivision.catmull_clark(vertices, corners.astype(integer), counts.astype(integer))
    for one, other in zip(got, expected, strict=True):
        np.testing.assert_array_equal(one, other)
    faces = MOEBIUS.astype(integer)
    np.testing.assert_array_equal(subdivision.loop_matrix(faces, 10).toarray(),
                                  subdivision.loop_matrix(MOEBIUS, 10).toarray())


# --- meshes that need a cure ----------------------------------------------------------------------

def test_split_fans_parts_what_touches_in_a_point():
    """A fan that keeps its neighbour's vertex; faces or their order change; a new gap elsewhere."""
    cones = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [5, 0, 6], [7, 6, 0], [7, 0, 5]])
    corners, origin = subdivision.split_fans(*subdivision.triangles(cones))
    np.testing.assert_array_equal(origin[corners].reshape(-1, 3), cones)
    np.testing.assert_array_equal(np.bincount(origin), [2, 1, 1, 1, 0, 1, 1, 1])
    _, _, is_boundary = subdivision.topology(corners, np.full(6, 3), len(origin))
    assert is_boundary.sum() == 6


@each_polygon_mesh
def test_split_fans_leaves_a_sound_mesh_as_it_is(vertices, corners, counts):
    """Edges are cut, or a vertex comes twice."""
    new, origin = subdivision.split_fans(corners, counts)
    np.testing.assert_array_equal(origin[new], corners)
    np.testing.assert_array_equal(np.sort(origin), np.unique(corners))


def test_split_fans_refuses_what_it_cannot_mend():
    """A face that names a vertex twice becomes another face."""
    with pytest.raises(ValueError, match="face 1 names vertex 2 twice"):
        subdivision.split_fans([0, 1, 2, 2, 3, 2], [3, 3])


def test_the_teapot_in_one_piece():
    """Copies of a vertex are made one, and a fan that touches another in a point gets its own."""
    vertices, faces = mesh.teapot()
    places, place = np.unique(vertices.round(5), axis=0, return_inverse=True)
    welded = place.ravel()[faces]
    with pytest.raises(ValueError, match=r"2 fans of faces .* `split_fans`"):
        subdivision.loop(places, welded)
    corners, origin = subdivision.split_fans(*subdivision.triangles(welded))
    _, _, is_boundary = subdivision.topology(corners, np.full(len(faces), 3), len(origin))
    assert (len(origin), is_boundary.sum()) == (530, 64)
    assert subdivision.euler_characteristic(corners, np.full(len(faces), 3)) == 2


def test_the_teapots_patches_are_open_and_the_bunny_is_closed():
    """Real meshes are refused, or change their topology."""
    for (vertices, faces), is_closed in (mesh.bunny(), True), (mesh.teapot(), False):
        _, _, is_boundary = subdivision.topology(*subdivision.triangles(faces), len(vertices))
        assert is_boundary.any() != is_closed
        for weight in WEIGHTS:
            new, children = subdivision.loop(vertices, faces, weight)
            assert np.isfinite(new).all() and len(children) == 4 * len(faces)
