"""What Loop's scheme composes: S of whole meshes, several steps, and limits."""
import numpy as np
import pytest
from subdivision_meshes import MOEBIUS, farthest, published
from triangle_meshes import MESHES, require_spline, require_symmetric, valence_and_boundary

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import loop_subdivision, subdivision

WEIGHTS = loop_subdivision.warren_weight, loop_subdivision.loop_weight
each_weight = pytest.mark.parametrize("weight", WEIGHTS, ids=lambda weight: weight.__name__)
each_mesh = pytest.mark.parametrize("vertices, faces", MESHES.values(), ids=MESHES)


# --- both versions, and others' ------------------------------------------------------------------

@each_weight
@each_mesh
def test_loops_matrix_agrees_with_the_slow_version(vertices, faces, weight):
    """Two versions of one scheme that differ at a hole, an isolated vertex or an odd valence."""
    n, _ = valence_and_boundary(*subdivision.triangles(faces), len(vertices))
    slow = loop_subdivision.loop_slow(vertices, faces, weight(np.maximum(n, 1)))
    fast, _ = loop_subdivision.loop(vertices, faces, weight)
    np.testing.assert_allclose(fast, slow, rtol=0, atol=1e-12)


def test_with_loops_own_weights_the_published_cube_comes_out_and_with_warrens_it_does_not():
    """The weights' names are swapped, or there is no difference at valences 4 and 5."""
    vertices, faces, expected = published("cube", "vertices", "faces", "step_1")
    warren, loop = (farthest(loop_subdivision.loop(vertices, faces, weight)[0], expected)
                    for weight in WEIGHTS)
    assert loop < 1e-6 and 0.02 < warren < 0.03


def test_the_two_weights_are_equal_at_valences_3_and_6_only():
    """Libraries are split between them. On regular meshes nobody sees it."""
    n = np.arange(3, 30)
    warren, loop = (weight(n) for weight in WEIGHTS)
    equal = np.isclose(warren, loop, rtol=1e-12)
    np.testing.assert_array_equal(n[equal], [3, 6])


@each_mesh
def test_loop_is_that_of_libigl(vertices, faces):
    """Another scheme than libigl's at a boundary or an odd valence. It must be installed.

    Faces must be wound alike for it, and vertices of no face are left out, as it forgets them.
    """
    igl = pytest.importorskip("igl")
    if faces is MOEBIUS:
        pytest.skip("a band that cannot be wound alike")
    used, faces = np.unique(faces, return_inverse=True)
    vertices, faces = vertices[used], faces.reshape(-1, 3)
    theirs = igl.loop(vertices, faces, 1)
    ours = loop_subdivision.loop(vertices, faces)
    assert len(theirs[1]) == len(ours[1])
    np.testing.assert_allclose(theirs[0][:len(vertices)], ours[0][:len(vertices)], rtol=0,
                               atol=1e-12)
    assert farthest(ours[0], np.asarray(theirs[0])) < 1e-12


# --- what a step keeps ---------------------------------------------------------------------------

@each_mesh
def test_loop_keeps_the_topology(vertices, faces):
    """A seam opens or closes: Euler's number, boundary edges doubled, faces times four."""
    _, _, before = subdivision.topology(*subdivision.triangles(faces), len(vertices))
    new, children = loop_subdivision.loop(vertices, faces)
    _, _, after = subdivision.topology(*subdivision.triangles(children), len(new))
    assert len(children) == 4 * len(faces) and after.sum() == 2 * before.sum()
    assert (subdivision.euler_characteristic(*subdivision.triangles(children))
            == subdivision.euler_characteristic(*subdivision.triangles(faces)))


@each_mesh
def test_after_loop_old_valences_stay_and_new_ones_are_regular(vertices, faces):
    """A new vertex of another valence than 6 inside and 4 on the boundary."""
    old, _ = valence_and_boundary(*subdivision.triangles(faces), len(vertices))
    new, children = loop_subdivision.loop(vertices, faces)
    n, at_boundary = valence_and_boundary(*subdivision.triangles(children), len(new))
    np.testing.assert_array_equal(n[:len(old)], old)
    assert not subdivision.is_extraordinary(n, at_boundary, 6)[len(old):].any()


@each_weight
def test_an_octahedron_stays_symmetric(weight):
    """A direction is preferred, in two steps of Loop from the points +-x, +-y, +-z."""
    faces = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
                      [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    new = np.repeat(np.eye(3), 2, axis=0) * np.tile([[1.0], [-1.0]], (3, 1)), faces
    new = loop_subdivision.loop(*new, weight)
    require_symmetric(loop_subdivision.loop(*new, weight)[0])


@each_weight
def test_the_points_of_an_icosahedron_stay_on_two_spheres(weight):
    """One of its twelve vertices, or of its thirty edges, has other weights."""
    new, _ = loop_subdivision.loop(*mesh.icosphere(20), weight)
    radius = np.linalg.norm(new, axis=1)
    assert np.ptp(radius[:12]) < 1e-14 and np.ptp(radius[12:]) < 1e-14


@each_mesh
def test_numbers_of_faces_and_their_winding_do_not_count(vertices, faces):
    """Faces wound against each other, or in another order, give another surface."""
    rng = np.random.default_rng(2)
    other = rng.permutation(faces)
    other[::2] = other[::2, ::-1]
    np.testing.assert_allclose(loop_subdivision.loop(vertices, np.roll(other, 1, axis=1))[0],
                               loop_subdivision.loop(vertices, faces)[0], rtol=0, atol=1e-14)


def test_the_teapots_patches_are_open_and_the_bunny_is_closed():
    """Real meshes are refused, or change their topology."""
    for (vertices, faces), is_closed in (mesh.bunny(), True), (mesh.teapot(), False):
        _, _, is_boundary = subdivision.topology(*subdivision.triangles(faces), len(vertices))
        assert is_boundary.any() != is_closed
        for weight in WEIGHTS:
            new, children = loop_subdivision.loop(vertices, faces, weight)
            assert np.isfinite(new).all() and len(children) == 4 * len(faces)


# --- boundaries and limits -----------------------------------------------------------------------

@each_mesh
def test_loops_boundary_depends_on_the_boundary_alone(vertices, faces):
    """A vertex inside pulls at the curve: two meshes along one curve come apart."""
    S = loop_subdivision.loop_matrix(faces, len(vertices))
    require_spline(S, *subdivision.triangles(faces), len(vertices))


@each_weight
@each_mesh
def test_a_step_does_not_change_loops_limit(vertices, faces, weight):
    """m of (6) is not that of u, or the boundary's limit is not that of its rule."""
    before = loop_subdivision.loop_limit_matrix(faces, len(vertices), weight) @ vertices
    new, children = loop_subdivision.loop(vertices, faces, weight)
    after = loop_subdivision.loop_limit_matrix(children, len(new), weight) @ new
    np.testing.assert_allclose(after[:len(vertices)], before, rtol=0, atol=1e-14)


def test_six_steps_come_near_the_limit():
    """A fixed point that the steps do not go to."""
    vertices, faces = mesh.icosphere(20)
    limit = loop_subdivision.loop_limit_matrix(faces, 12) @ vertices
    for _ in range(6):
        vertices, faces = loop_subdivision.loop(vertices, faces)
    assert 0 < np.abs(vertices[:12] - limit).max() < 1e-3


# --- gradients -----------------------------------------------------------------------------------

@each_weight
def test_loop_has_a_gradient(weight):
    """S for its transpose, or the other weight's."""
    gradcheck(lambda *given: loop_subdivision.loop(*given)[0], loop_subdivision.loop_backward,
              (*MESHES["band with a twist"], weight), name="loop")
