"""What the exercises of lab 12 must do."""
import functools
import itertools

import numpy as np
import simplification_meshes as meshes

from course.given import mesh
from labkit.checks import assert_close, assert_equal, exercise

# --- a collapse ----------------------------------------------------------------------------------

@exercise("12.1")
def test_a_collapse_on_paper(impl):
    """Faces with both vertices are kept and name a twice. All faces with a or b go, or only faces
    with both stay. The new vertex is called b instead of a. Numbers above b are lowered. The order
    of faces or corners changes."""
    faces = np.array([[7, 2, 5], [5, 2, 9], [5, 1, 7], [3, 4, 6], [9, 8, 5], [2, 8, 9], [2, 7, 0],
                      [8, 1, 0]])
    expected = [[2, 1, 7], [3, 4, 6], [9, 8, 2], [2, 8, 9], [2, 7, 0], [8, 1, 0]]
    assert_equal(impl.collapse_faces(faces, 2, 5), expected)


@exercise("12.1")
def test_a_collapse_may_leave_nothing_or_everything(impl):
    """Where no face is left, there is an error. A pair without a common face loses a face."""
    assert_equal(impl.collapse_faces(np.array([[0, 1, 2]]), 2, 0), np.zeros((0, 3), int))
    assert_equal(impl.collapse_faces(np.array([[0, 1, 2], [3, 4, 5]]), 1, 4),
                 [[0, 1, 2], [3, 1, 5]])


@exercise("12.1")
def test_collapses_are_those_of_a_search(impl, rng):
    """Right for a few faces alone, or for a < b."""
    for a, b in rng.permuted(np.tile(np.arange(12), (5, 1)), axis=1)[:, :2].tolist():
        faces = rng.permuted(rng.permutation(12)[mesh.icosphere(20)[1]], axis=1)
        assert_equal(impl.collapse_faces(faces, a, b), np.array(collapsed(faces, (a, b))))


# --- quadrics ----------------------------------------------------------------------------------

@exercise("12.2")
def test_the_quadric_of_a_plane(impl):
    """p is scaled to a unit normal first. d is left out: the last row and column are 0. Only the
    diagonal is filled. The inner product, row times column, gives a number, not a matrix."""
    expected = [[1.0, 2.0, 3.0, 4.0], [2.0, 4.0, 6.0, 8.0],
                [3.0, 6.0, 9.0, 12.0], [4.0, 8.0, 12.0, 16.0]]
    assert_close(impl.plane_quadrics(np.array([1.0, 2.0, 3.0, 4.0])), expected)


@exercise("12.2")
def test_one_quadric_for_each_plane(impl, rng):
    """The matrices of all planes are summed into one. Leading axes are lost, or only one is
    understood. All axes are transposed (.T), not the last two. Planes are mixed with each other."""
    p = rng.normal(size=(3, 2, 4))
    expected = [[np.outer(plane, plane) for plane in row] for row in p]
    assert_close(impl.plane_quadrics(p), expected)


@exercise("12.3")
def test_an_error_on_paper(impl):
    """The 1 after x is missing, 0, or comes first. 2 b.x lacks its factor 2, or it or c is left
    out. It is the distance, not its square. Q v is squared, or not multiplied by v."""
    q = meshes.planes_of([2, -1, 3, -4])[0]
    assert_close(impl.quadric_error(q, np.array([3.0, 1.0, 2.0])), 49.0)
    assert_close(impl.quadric_error(q, np.array([1.0, 1.0, 1.0])), 0.0)


@exercise("12.3")
def test_the_error_is_the_double_sum(impl, rng):
    """The leading shapes of q and x do not broadcast. Q is taken for symmetric."""
    q, x = rng.normal(size=(2, 1, 4, 4)), rng.normal(size=(5, 3))
    expected = [[meshes.error(q[i, 0], x[j]) for j in range(5)] for i in range(2)]
    assert_close(impl.quadric_error(q, x), expected)


@exercise("12.5")
def test_boundary_planes_of_a_triangle(impl):
    """n points into the face, not away from it: the edge runs from low to high, not as its face
    does. n is not of length 1. d has the wrong sign. It is the plane of the face itself. Edges are
    not ascending."""
    vertices = np.array([[1.0, 2.0, 5.0], [5.0, 2.0, 5.0], [1.0, 5.0, 5.0]])
    expected = [[0.0, -1.0, 0.0, 2.0], [-1.0, 0.0, 0.0, 1.0], [0.6, 0.8, 0.0, -4.6]]
    for face in [0, 1, 2], [1, 0, 2]:
        edges, p = impl.boundary_planes(vertices, np.array([face]))
        assert_equal(edges, [[0, 1], [0, 2], [1, 2]])
        assert_close(p, expected)


@exercise("12.5")
def test_they_contain_their_edge_and_leave_their_face_behind(impl, rng):
    """Planes come in the order of the faces, not of the edges. Inner edges get a plane, too. The
    normal is that of another face."""
    vertices, faces = mesh.grid(18)
    vertices = vertices + 0.2 * rng.normal(size=vertices.shape)
    faces = rng.permuted(rng.permutation(faces)[3:], axis=1)
    edges, p = impl.boundary_planes(vertices, faces)
    expected = [*boundary_of(vertices, faces)]
    assert_equal(edges, np.array([(i, j) for i, j, _ in expected]))
    assert_close(p, np.array([plane for *_, plane in expected]))


def boundary_of(vertices, faces):
    """Yields i, j and the plane of each edge of one face, which looks away from it."""
    for i, j in meshes.edges_of(faces):
        at = [face for face in faces.tolist() if {i, j} <= {*face}]
        if len(at) == 1:
            third = vertices[sum(at[0]) - i - j]
            along = (vertices[j] - vertices[i]) / np.linalg.norm(vertices[j] - vertices[i])
            out = vertices[i] - third
            out = out - (out @ along) * along
            out /= np.linalg.norm(out)
            yield i, j, np.append(out, -out @ vertices[i])


@exercise("12.5", fine_print=True)
def test_no_boundary_and_no_area(impl):
    """A closed surface, which has no boundary, fails. A face without area gives nan."""
    edges, p = impl.boundary_planes(*mesh.icosphere(20))
    assert_close((edges, p), (np.zeros((0, 2)), np.zeros((0, 4))))
    line = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]])
    assert_close(impl.boundary_planes(line, np.array([[0, 1, 2]]))[1], np.zeros((3, 4)))


@exercise("12.4")
def test_a_closed_surface_face_by_face(impl, rng):
    """Each plane counts once, not as much as its face is large; or with twice the area, a third of
    it, or the mean of the faces at a vertex. += with repeated indices adds only one of them. A
    vertex gets another face's quadric (tile, not repeat). One of no face gets none."""
    vertices, faces = meshes.bumpy(20, rng, 0.2)
    vertices = np.concatenate([vertices, [[7.0, 8, 9]]])
    got = impl.surface_quadrics(vertices, faces)
    assert_close(got, meshes.quadrics_of(vertices, faces, area_of))


def area_of(a, b, c):
    return np.linalg.norm(np.cross(b - a, c - a)) / 2


@exercise("12.4")
def test_a_triangle_holds_its_boundary_on_paper(impl):
    """The boundary is left out, or counts once (no weight), with the edge's length, not its square,
    or without BOUNDARY_WEIGHT, which is 10. Its plane counts at one end of the edge alone, or at
    all three vertices."""
    x = np.array([[0.0, 0, 0], [4, 0, 0], [0, 3, 0]])
    face, sides = [0, 0, 1, 0], ([0, -1, 0, 0], [-1, 0, 0, 0], [0.6, 0.8, 0, -2.4])
    inner, below, left, above = (meshes.planes_of(p) for p in (face, *sides))
    expected = [6 * inner + 160 * below + 90 * left, 6 * inner + 160 * below + 250 * above,
                6 * inner + 90 * left + 250 * above]
    assert_close(impl.surface_quadrics(x, np.array([[0, 1, 2]])), np.concatenate(expected))


@exercise("12.4")
def test_an_open_sheet_face_by_face_and_edge_by_edge(impl, rng):
    """The weights are those of other edges, or the planes those of other faces."""
    vertices, faces = mesh.grid(18)
    vertices = vertices + 0.2 * rng.normal(size=vertices.shape)
    faces = rng.permuted(rng.permutation(faces)[3:], axis=1)
    expected = meshes.quadrics_of(vertices, faces, area_of)
    for i, j, plane in boundary_of(vertices, faces):
        length = np.linalg.norm(vertices[j] - vertices[i])
        expected[[i, j]] += 10 * length**2 * np.outer(plane, plane)
    assert_close(impl.surface_quadrics(vertices, faces), expected)


# --- the best place ----------------------------------------------------------------------------

@exercise("12.8")
def test_the_best_place_on_a_segment_on_paper(impl):
    """t has the wrong sign or a factor 2, or is not kept within 0 and 1. b of the quadric or A x_i
    is left out. The slope is that at b. It is divided by e.e, not e.A e. The place is t e, without
    a."""
    q = meshes.each_of([[1, 0, 0, -2]], [[0, 2, 0, -6], [1, 0, 0, -1]], [[1, 0, 0, -2]],
                       [[0, 0, 3, -9]], [[1, 1, 0, -7], [0, 0, 1, -1]])
    a = np.array([[0.0, 0.0, 1.0], [5.0, 0.0, 2.0], [3.0, 0.0, 0.0], [4.0, 5.0, -5.0],
                  [1.0, 1.0, 1.0]])
    b = np.array([[8.0, 4.0, 1.0], [5.0, 4.0, 6.0], [9.0, 9.0, 0.0], [8.0, 7.0, 1.0],
                  [6.0, 6.0, 1.0]])
    expected = [[2.0, 1.0, 1.0], [5.0, 3.0, 5.0], [3.0, 0.0, 0.0], [8.0, 7.0, 1.0], [3.5, 3.5, 1.0]]
    assert_close(impl.best_on_segment(q, a, b)[0], expected)


@exercise("12.8")
def test_in_a_plane_no_place_of_a_segment_is_best(impl):
    """Every place is called unique, or none. In the plane of the quadric the error is the same
    along the whole segment: e.A e is 0."""
    q = meshes.each_of([[1, 0, 0, -2]], [[1, 0, 0, -2]], [[0, 0, 3, -9]],
                       [[0, 0, 3, -9], [0, 1, 0, -5]], [[0, 1, 0, -5]], [[0, 1, 0, -5]])
    a = np.array([[3.0, 0.0, 4.0], [0.0, 0.0, 1.0], [4.0, 5.0, 1.0], [4.0, 2.0, 1.0],
                  [1.0, 2.0, 3.0], [7.0, 8.0, 9.0]])
    b = np.array([[3.0, 5.0, 9.0], [8.0, 4.0, 1.0], [9.0, 7.0, 1.0], [8.0, 7.0, 1.0],
                  [4.0, 9.0, 6.0], [1.0, 8.0, 3.0]])
    assert_equal(impl.best_on_segment(q, a, b)[1], [False, True, False, True, True, False])


@exercise("12.8")
def test_no_point_of_the_segment_is_better(impl, rng):
    """t has a wrong sign or a factor 2, for planes in general position. Only the diagonal of A
    counts."""
    p = rng.normal(size=(6, 5, 4))
    q = meshes.each_of(*p)
    a, b = rng.normal(size=(2, 6, 3))
    place, unique = impl.best_on_segment(q, a, b)
    assert_equal(unique, np.ones(6, bool))
    for k in range(6):
        at = [meshes.error(q[k], a[k] + t * (b[k] - a[k])) for t in (0, 0.5, 1)]   # a parabola
        t = (3 * at[0] - 4 * at[1] + at[2]) / (4 * (at[0] - 2 * at[1] + at[2]))
        assert_close(place[k], a[k] + np.clip(t, 0, 1) * (b[k] - a[k]), rtol=1e-7)


@exercise("12.8", fine_print=True)
def test_along_a_plane_no_place_is_best(impl):
    """e lies in the plane: 0 / 0 gives nan, or rounding decides. e.A e must be compared with
    LEAST_CURVATURE trace(A) e.e, and x be a where it is not greater."""
    edge = 1e3 * np.array([[0.0, 1.0, 0.0]])
    for factor, expected in (0.0, False), (0.95, False), (1.06, True):
        for scale in 1e-6, 1e6:
            q = scale * np.diag([0.3, factor * meshes.LEAST_CURVATURE, 0.7, 5.0])[None]
            place, unique = impl.best_on_segment(q, 2 - 0.5 * edge, 2 + edge)
            assert_equal(unique, [expected])
            if not expected:
                assert_close(place, 2 - 0.5 * edge)
    same = np.array([[1.0, 2.0, 3.0]])
    assert_close(impl.best_on_segment(meshes.planes_of([1, 0, 0, 0]), same, same), (same, [False]))


@exercise("12.6")
def test_a_corner_is_found(impl):
    """b has the wrong sign, or there is a factor 2. The right-hand side has the shape (N, 3), which
    solve takes for one matrix: it needs (N, 3, 1). That axis is left in the result. Only the
    diagonal of A counts, or b is multiplied by A."""
    q = np.concatenate([meshes.planes_of([1, 0, 0, -1], [0, 1, 0, -2], [0, 0.6, 0.8, -3.6]),
                        meshes.planes_of([2, 0, 0, 6], [0, 1, 0, 5], [0, 0, 3, 12])])
    assert_close(impl.best_anywhere(q), [[1.0, 2.0, 3.0], [-3.0, -5.0, -4.0]])


@exercise("12.6")
def test_at_the_best_place_the_gradient_is_zero(impl, rng):
    """Quadrics of several pairs are mixed with each other."""
    axes = np.linalg.qr(rng.normal(size=(7, 3, 3)))[0] * rng.uniform(0.3, 1.5, (7, 3, 1))
    planes = np.concatenate([axes, rng.normal(size=(7, 3, 1))], -1)
    q = meshes.each_of(*planes)
    x = impl.best_anywhere(q)
    gradient = np.array([[meshes.error(q[k], x[k] + d) - meshes.error(q[k], x[k] - d)
                          for d in 1e-3 * np.eye(3)] for k in range(7)])
    assert_equal(x.shape, (7, 3))
    assert_close(gradient, np.zeros((7, 3)), atol=1e-9)


@exercise("12.7")
def test_costs_of_four_pairs_on_paper(impl):
    """Costs and positions are exchanged. Q is one vertex's quadric alone, maybe for the cost only,
    or the mean of both, not their sum. The position is the middle, or the cost is that at an end or
    the middle, not at the best position."""
    vertices = np.array([[0.0, 7, 1], [9, 7, -8], [6, 7, -5], [3, 7, -2]])  # on a line
    q = meshes.each_of(*[[[1, 0, 0, -x]] for x in (0, 8, 6, 4)])
    q *= np.array([1, 3, 2, 2])[:, None, None]
    places = [[4.0, 7.0, -3.0], [6.0, 7.0, -5.0], [5.0, 7.0, -4.0], [6.4, 7.0, -5.4]]
    assert_close(impl.pair_costs(vertices, q, np.array([[0, 2], [0, 1], [2, 3], [1, 3]])),
                 (places, [24.0, 48.0, 4.0, 19.2]))


@exercise("12.7")
def test_at_a_corner_the_best_place_is_off_the_pair(impl):
    """The place is always on the segment: eq. (5) is never used, or only where A cannot be
    inverted."""
    x = np.array([[0.0, 0, 0], [5, 1, 1], [9, 9, 9]])
    q = meshes.each_of([[1, 0, 0, -1], [0, 1, 0, -2]], [[0, 0, 1, -3], [1, 0, 0, -3]],
                       [[0, 3, 0, -15], [0, 0, 2, 4]])
    assert_close(impl.pair_costs(x, q, np.array([[0, 1], [0, 2]])),
                 ([[2.0, 2.0, 3.0], [1.0, 4.7, -2.0]], [2.0, 8.1]))


@exercise("12.7")
def test_on_a_flat_part_an_end_or_the_middle_is_taken(impl):
    """Eq. (5) or (6) is used though next to nothing is curved: the place lies far away. Or it is
    always the first vertex, or the middle."""
    x = np.array([[0.0, 0, 0], [4, 0, 0]])
    plane, slope = meshes.planes_of([0, 0, 1, 0])[0], np.zeros((4, 4))
    slope[0, 3] = slope[3, 0] = -1e-4
    valley, between = 1e-8 * meshes.each_of([[1, 0, 0, -2]], [[1, 0, 0, -3]])
    for more, place in (0 * slope, 0), (slope, 4), (-slope, 0), (valley, 2), (between, 4):
        positions, _ = impl.pair_costs(x, np.array([plane, plane + more]), np.array([[0, 1]]))
        assert_close(positions, [[place, 0.0, 0.0]])


@exercise("12.7")
def test_each_pair_is_decided_by_itself(impl, rng):
    """One flat pair makes all of them go by (6) or (7), or an error ends it: A is singular. The
    threshold is not LEAST_CURVATURE times the greatest eigenvalue, so it has a unit."""
    x, best = rng.normal(size=(2, 8, 3))
    x[4:] *= [1, 1, 0]
    basis = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    q = np.zeros((8, 4, 4))
    for k, spread in enumerate(([1, 2, 3], [4e-6, 1, 2], [1e-7, 1e-7, 2], [3e-7, 0.01, 2])):
        A = basis @ np.diag(spread) @ basis.T
        q[k, :3, :3], q[k, :3, 3] = A, -A @ best[k]
        q[k, 3, :3], q[k, 3, 3] = q[k, :3, 3], 1 + best[k] @ A @ best[k]
    q[4] = meshes.planes_of([0, 0, 1, 0])[0]
    pairs = np.array([[1, 6], [0, 4], [4, 5], [2, 7], [3, 5], [0, 6]])
    expected = [meshes.place_and_cost(q[a] + q[b], x[a], x[b]) for a, b in pairs]
    for unit in 1, 1e-9:
        positions, costs = impl.pair_costs(x, unit * q, pairs)
        assert_close(positions, [place for place, _ in expected], rtol=1e-7, atol=1e-7)
        assert_close(costs / unit, [cost for _, cost in expected], rtol=1e-7, atol=1e-9)


# --- what is refused -----------------------------------------------------------------------------

def asked(impl, faces, pairs):
    """What satisfies_link_condition says of each of these pairs."""
    return np.array([impl.satisfies_link_condition(faces, a, b) for a, b in pairs])


def given(faces, pairs):
    """In words: the faces, and all the pairs that were asked about, where one call says little."""
    return f"faces={faces.tolist()}, for each of the pairs a, b in {[list(pair) for pair in pairs]}"


@exercise("12.9")
def test_the_edges_of_one_triangle_pass_and_a_pinched_ring_does_not(impl):
    """True and False are exchanged. Always True. Always False: a and b are left among the thirds,
    or no vertex is allowed to be shared. Only the faces at the edge are counted. Two must be
    shared, though an edge of one face has one third."""
    faces = np.concatenate([meshes.DOUBLE, [[5, 6, 7]]])
    pairs = [(5, 6), (7, 5), (1, 2), (6, 7), (3, 1), (2, 3), (6, 5), (2, 1)]
    expected = [True, True, False, True, False, False, True, False]
    assert_equal(asked(impl, faces, pairs), expected, given(faces, pairs))


@exercise("12.9")
def test_a_tetrahedrons_edges_share_the_thirds_of_both_faces(impl):
    """Only the first face at the edge is looked at: the third vertex of the second one is missing.
    No vertex may be shared, or only one."""
    faces, pairs = meshes.TETRAHEDRON, [(0, 1), (2, 1), (3, 0), (1, 3)]
    assert_equal(asked(impl, faces, pairs), np.full(4, True), given(faces, pairs))


@exercise("12.9")
def test_the_ring_of_a_double_pyramid_must_not_be_pinched(impl):
    """The two thirds are shared, but so is the ring's other vertex: more may not be shared."""
    for a, b in itertools.permutations((1, 2, 3), 2):
        assert_equal(impl.satisfies_link_condition(meshes.DOUBLE, a, b), False)
    for a, b in itertools.product((0, 4), (1, 2, 3)):
        assert_equal(impl.satisfies_link_condition(meshes.DOUBLE, a, b), True)
        assert_equal(impl.satisfies_link_condition(meshes.DOUBLE, b, a), True)


@exercise("12.9")
def test_a_thin_ring_must_not_lose_its_hole(impl, rng):
    """Around a tube of three edges: to collapse one would tear the tube."""
    faces = rng.permutation(18)[mesh.torus(36, tube=0.1)[1]]
    for a, b in meshes.edges_of(faces):
        thirds = {*faces[((faces == a) | (faces == b)).sum(1) == 2].ravel().tolist()} - {a, b}
        at = [{*faces[(faces == vertex).any(1)].ravel().tolist()} for vertex in (a, b)]
        assert_equal(impl.satisfies_link_condition(faces, int(a), int(b)),
                     (at[0] & at[1]) - {a, b} == thirds)


@exercise("12.9")
def test_three_faces_at_an_edge_have_three_thirds(impl):
    """The number of shared neighbours is compared with 2, not with the third vertices of the
    faces."""
    book = np.array([[0, 1, k] for k in (2, 3, 4)])
    assert_equal(impl.satisfies_link_condition(book, 0, 1), True)


def triangle(*corners):
    return np.array([corners], float)


def asked_flips(impl, before, afters):
    return np.array([impl.flips(before, after) for after in afters])


@exercise("12.11")
def test_a_face_that_turns_over_flips(impl):
    """True and False are exchanged. Always False. A face that only moves, grows, or turns in its
    own plane flips: corners or sides are compared, not normals."""
    before = triangle([0, 0, 0], [2, 0, 0], [0, 2, 0])
    afters = (7 * before + [1.0, 2.0, 3.0], triangle([0, 0, 0], [0, 2, 0], [-2, 0, 0]),
              triangle([0, 0, 0], [2, 0, 0], [0, -1, 0]), before[:, [1, 0, 2]])
    assert_equal(asked_flips(impl, before, afters), [False, False, True, True],
                 f"before={before.tolist()}, and four triangles after={np.stack(afters).tolist()}")


@exercise("12.11")
def test_more_than_45_degrees_flip_and_a_little_less_does_not(impl):
    """It is another angle: 90 degrees where only the sign of n . n' is asked, or 45 taken as
    radians. It is the sine instead of the cosine. n . n' is not divided by both lengths."""
    before = triangle([0, 0, 0], [2, 0, 0], [0, 2, 0])
    heights = [(1.0, 0.95), (0.95, 1.0), (1.0, 0.2), (0.3, 0.31), (0.0, 1.0), (-0.01, 1.0),
               (3.0, 2.9), (2.9, 3.0)]
    afters = [triangle([0, 0, 0], [2, 0, 0], [0, *height]) for height in heights]
    expected = [False, True, False, True, True, True, False, True]
    assert_equal(asked_flips(impl, before, afters), expected,
                 f"before={before.tolist()}, and after with the third corner at 0, y, z for each "
                 f"of the y, z in {heights}")


@exercise("12.11")
def test_the_angle_between_the_normals_decides(impl, rng):
    """A side is measured from the origin, which is right only where the first corner lies there. n
    is not divided by its length."""
    for _ in range(40):
        before = 3 + rng.normal(size=(1, 3, 3))
        after = before + 0.4 * rng.normal(size=(1, 3, 3))
        n, n1 = ([np.linalg.det([axis, b - a, c - a]) for axis in np.eye(3)]
                 for a, b, c in (before[0], after[0]))
        cosine = np.dot(n, n1) / np.linalg.norm(n) / np.linalg.norm(n1)
        thinner = meshes.shape(*after[0]) < meshes.LEAST_SHAPE * meshes.shape(*before[0])
        assert_equal(impl.flips(before, after), bool(cosine < meshes.LEAST_COSINE or thinner))


@exercise("12.11")
def test_a_triangle_must_not_become_a_sliver(impl):
    """The area is compared, not the shape, or the new shape with LEAST_SHAPE itself, not times the
    old one: a sliver may stay one. The longest edge is taken for one of the others."""
    right = triangle([0, 0, 0], [2, 0, 0], [0, 2, 0])               # of shape 1 / 2
    for x in 0.0, 1.0, 2.0:                                         # of shape height
        for height, expected in (0.475, True), (0.525, False):
            height *= meshes.LEAST_SHAPE
            thin = triangle([0, 0, 0], [2, 0, 0], [x, 2 * height, 0])
            for turn in range(3):
                assert_equal(impl.flips(right, np.roll(thin, turn, axis=1)), expected)
            assert_equal(impl.flips(thin, 0.001 * thin), False)
            assert_equal(impl.flips(thin, right), False)
    assert_equal(impl.flips(right, 1e-4 * right), False)


@exercise("12.11")
def test_one_of_many_is_enough(impl, rng):
    """All triangles must flip, instead of any: all for any. Or only the first or the last one is
    looked at."""
    before = rng.normal(size=(5, 3, 3))
    assert_equal(impl.flips(before, before), False)
    for k in range(5):
        after = before.copy()
        after[k] = after[k, [1, 0, 2]]
        assert_equal(impl.flips(before, after), True)


@exercise("12.11", fine_print=True)
def test_one_without_area_never_flips(impl, rng):
    """A face that had no area keeps its neighbours from ever moving."""
    before = rng.normal(size=(5, 3, 3))
    before[2] = [[0.0, 0, 0], [1, 1, 1], [1, 1, 1]]
    after = before.copy()
    after[2, 2] = 5.0, 6.0, 9.0
    assert_equal(impl.flips(before, after), False)
    assert_equal(impl.flips(np.zeros((0, 3, 3)), np.zeros((0, 3, 3))), False)


def assert_refused(impl, vertices, faces, pairs, places, expected):
    """expected: the reasons, each a number from 0 to 3."""
    got = [impl.why_refused(vertices, faces, a, b, place)
           for (a, b), place in zip(pairs, places, strict=True)]
    assert_equal(np.array(got), np.array(expected), given(faces, pairs))


PYRAMID = np.array([[0.0, 0, 3], [1, 0, 0], [-1, 2, 0], [-1, -2, 0], [0, 0, -2]])  # of DOUBLE


@exercise("12.10")
def test_a_collapse_in_a_fine_ball_is_allowed(impl):
    """It is refused, or the answer is True, or the reason of the last test that was asked."""
    vertices, faces = mesh.icosphere(320)
    pairs = meshes.edges_of(faces)[::17].tolist()
    places = [vertices[pair].mean(0) for pair in pairs]
    assert_refused(impl, vertices, faces, pairs, places, np.zeros(len(pairs), int))


@exercise("12.10")
def test_the_ring_of_a_double_pyramid_is_refused_by_the_link_condition(impl):
    """Eq. (8) is not asked, or the wrong way round, or its reason is another number than LINK."""
    pairs = [(1, 2), (2, 3), (3, 1)]
    assert_refused(impl, PYRAMID, meshes.DOUBLE, pairs, PYRAMID[[1, 2, 3]], [1, 1, 1])


@exercise("12.10")
def test_the_edges_of_a_tetrahedron_leave_twins(impl):
    """Twins are not looked for, or among the faces before the collapse."""
    faces, pairs = meshes.TETRAHEDRON, [(0, 1), (2, 1), (2, 0)]
    for count in 4, 3:  # of three vertices: a triangle, closed by `outside`
        assert_refused(impl, PYRAMID[:count], faces, pairs, PYRAMID[[0, 2, 2]], [2, 2, 2])


@exercise("12.10")
def test_a_place_on_the_other_side_of_a_ball_flips_its_faces(impl):
    """Flips are not looked for. The corners do not move to the position, or only those of a do:
    b's faces stand still. The faces that vanish are asked, too."""
    vertices, faces = mesh.icosphere(320)
    pairs = meshes.edges_of(faces)[::29].tolist()
    places = [-9 * vertices[a] for a, _ in pairs]
    assert_refused(impl, vertices, faces, pairs, places, np.full(len(pairs), 3))


@exercise("12.10")
def test_a_face_must_not_become_a_sliver(impl):
    """The corners after the collapse are taken for those before it: a sliver may become a face."""
    vertices, faces = mesh.grid(32)
    a, b = 7, 12
    sides = [vertices[face[face != a]] for face in faces if a in face and b not in face]
    places = [0.999 * side.mean(0) + 0.001 * vertices[a] for side in sides]
    assert_refused(impl, vertices, faces, [(a, b)] * len(places), places, [3] * len(places))


@exercise("12.10")
def test_the_first_reason_counts(impl):
    """Flips or twins are asked before the link condition."""
    faces = np.concatenate([meshes.DOUBLE, [[5, 7, 6], [5, 6, 8], [6, 7, 8], [5, 8, 7]]])
    vertices = np.concatenate([PYRAMID, PYRAMID[:4] + 9])
    assert_refused(impl, vertices, faces, [(1, 2), (5, 6), (0, 1)], -9 * vertices[[1, 5, 0]],
                   [1, 2, 3])


@exercise("12.10")
def test_a_face_to_outside_has_no_place(impl, rng):
    """The vertex V is looked up and not found, or the last vertex is taken for it. Faces to outside
    are left out of the link condition, too: a strip loses its middle."""
    vertices, faces = mesh.grid(18)
    vertices = vertices + 0.05 * rng.normal(size=vertices.shape)
    per_edge = [(pair, [face for face in faces.tolist() if {*pair} <= {*face}])
                for pair in meshes.edges_of(faces).tolist()]
    rim = [[*pair, len(vertices)] for pair, at in per_edge if len(at) == 1]
    assert_as_searched(impl, vertices, np.concatenate([faces, rim]),
                       [pair for pair, _ in per_edge], rng)


def assert_as_searched(impl, vertices, faces, pairs, rng):
    """Of places near the pairs, as `reason_of` finds."""
    for spread in 0.02, 0.3, 1.0:
        places = [vertices[a] + spread * rng.normal(size=3) for a, _ in pairs]
        expected = [meshes.reason_of(vertices, faces.tolist(), a, b, place)
                    for (a, b), place in zip(pairs, places, strict=True)]
        assert_refused(impl, vertices, faces, pairs, places, expected)


@exercise("12.10")
def test_reasons_are_those_of_a_search(impl, rng):
    """Before the collapse, b's faces are looked at as if b stood at a. Corners of one face before
    are compared with those of another after. Only the first face is asked."""
    for vertices, faces in mesh.icosphere(20), mesh.torus(36, tube=0.2):
        vertices = vertices + 0.05 * rng.normal(size=vertices.shape)
        assert_as_searched(impl, vertices, faces, meshes.edges_of(faces).tolist(), rng)


@exercise("12.10", fine_print=True)
def test_a_pair_that_is_no_edge_joins_two_sheets(impl):
    """The link condition is asked of it: it shares no third vertex. Or its faces to outside, which
    close both sheets, are twins."""
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    faces = np.array([[0, 1, 2], [3, 4, 5], [0, 1, 6], [1, 2, 6], [0, 2, 6], [3, 4, 6], [4, 5, 6],
                      [3, 5, 6]])
    assert_refused(impl, vertices, faces, [(1, 3)], vertices[[1]], [0])
    joined = np.where(faces == 3, 1, faces)
    assert_refused(impl, vertices, joined, [(2, 5)], vertices[[2]], [0])


# --- the algorithm -----------------------------------------------------------------------------


def loop(impl, vertices, faces, face_count):
    return impl.simplify_loop(vertices, faces, meshes.quadrics_of(vertices, faces), face_count)


@exercise("12.12")
def test_nothing_to_do(impl, rng):
    """One collapse too many, where there are just as many faces as asked for: >= instead of >."""
    meshes.check_nothing_to_do(functools.partial(loop, impl), rng)


@exercise("12.12")
def test_it_stops_at_the_first_count_that_is_low_enough(impl, rng):
    """One collapse too few: it stops above face_count. One too many. Several edges are collapsed in
    one round, before the faces are counted again. Or none is: why_refused is 0 for an edge that may
    be collapsed, and is asked the wrong way round."""
    meshes.check_where_it_stops(functools.partial(loop, impl), rng)


@exercise("12.12")
def test_one_collapse(impl, rng):
    """The vertex that is left does not move to the pair's best position: it stays where it was,
    goes to the middle, or to another pair's position."""
    meshes.check_one_collapse(functools.partial(loop, impl), rng)


def refused_and_next(rng):
    """A ball whose cheapest edge 0 is refused. -> vertices, faces, quadrics, edges 0 and 1.

    Each vertex has an error that is the same everywhere, and an edge costs the sum of its two. But
    edge 0 would like to be on the other side of the ball, at no cost. Edge 1 is the next cheapest.
    """
    vertices, faces = meshes.bumpy(180, rng, 0.01)
    errors = 100 + rng.uniform(size=len(vertices))
    allowed = allowed_edges(vertices, faces)
    bad = next(allowed)
    good = next(pair for pair in allowed if not near(faces, bad, pair))
    errors[list(good)] = 8, 11
    q = constant(errors)
    q[list(bad)] = meshes.corner_at(-9 * vertices[bad[0]])
    return vertices, faces, q, bad, good


def constant(errors):
    """Quadrics (V, 4, 4) whose error is the same everywhere."""
    q = np.zeros((len(errors), 4, 4))
    q[:, 3, 3] = errors
    return q


def allowed_edges(vertices, faces):
    """Yields the edges a b that may be collapsed into the place of a."""
    for a, b in meshes.edges_of(faces).tolist():
        if meshes.is_allowed(vertices, faces.tolist(), a, b, vertices[a]):
            yield a, b


def near(faces, *pairs):
    """Is there an edge between the two pairs, or do they share a vertex?"""
    return any({i, j} <= {*face} for face in faces.tolist() for i in pairs[0] for j in pairs[1])


def collapsed(faces, *pairs):
    """The faces after these collapses, one after the other, as lists."""
    faces = faces.tolist()
    for a, b in pairs:
        faces = [[a if v == b else v for v in face] for face in faces if not {a, b} <= {*face}]
    return faces


@exercise("12.12")
def test_a_refused_edge_is_not_collapsed(impl, rng):
    """The cheapest edge is collapsed without asking why_refused, or though it is refused. 0 means
    that it may be collapsed."""
    vertices, faces, q, bad, _ = refused_and_next(rng)
    left = impl.simplify_loop(vertices, faces, q, 178)[1]
    ball = f"a ball of 180 faces, down to 178; its cheapest edge {list(bad)} is refused, for a flip"
    assert_equal(f"of this edge are left: {np.intersect1d(left, bad).tolist()}",
                 f"of this edge are left: {list(bad)}", ball)


@exercise("12.12")
def test_after_a_refused_edge_the_next_cheapest_is_tried(impl, rng):
    """It gives up when the cheapest edge is refused. The next cheapest one must be tried, and so
    on."""
    vertices, faces, q, bad, good = refused_and_next(rng)
    left = impl.simplify_loop(vertices, faces, q, 178)[1]
    ball = (f"a ball of 180 faces, down to 178; its cheapest edge {list(bad)} is refused, the next "
            f"is {list(good)}")
    meshes.assert_left(left, faces, collapsed(faces, good), ball)


def check_collapses(impl, vertices, faces, rng, cheap, pairs, done):
    """The loop must collapse two pairs, if the vertices of cheap, {vertex: error}, cost least."""
    errors = 100 + rng.uniform(size=len(vertices))
    errors[[*cheap]] = [*cheap.values()]
    left = impl.simplify_loop(vertices, faces, constant(errors), 176)[1]
    numbers = ", ".join(f"{error} at vertex {vertex}" for vertex, error in cheap.items())
    ball = (f"a ball of 180 faces, down to 176. An edge costs the sum of two numbers: {numbers}, "
            f"and 100 or more elsewhere. First {[*pairs[0]]} is collapsed{done}")
    meshes.assert_left(left, faces, collapsed(faces, *pairs), ball)


@exercise("12.12")
def test_edges_and_costs_are_renewed_after_each_collapse(impl, rng):
    """Edges and costs are computed once, before the loop, and never again: they are out of date
    after a collapse. The upper vertex's edges are lost; the lower one gets them."""
    vertices, faces = meshes.bumpy(180, rng, 0.01)
    a, b, x = next((a, b, x) for a, b in allowed_edges(vertices, faces)
                   for x in range(a + 1, len(vertices))
                   if near(faces, [b], [x]) and not near(faces, [a], [x])
                   and meshes.is_allowed(vertices, collapsed(faces, (a, b)), a, x, vertices[a]))
    check_collapses(impl, vertices, faces, rng, {a: 1, b: 2, x: 3}, [(a, b), (a, x)],
                    f". Then {[a, x]} is an edge, the cheapest one")


@exercise("12.12")
def test_the_lower_vertex_gets_the_sum_of_both_quadrics(impl, rng):
    """Quadrics are not summed: the lower vertex keeps its own, or gets that of the upper one, or
    their mean."""
    vertices, faces = meshes.bumpy(180, rng, 0.01)
    a, b, c, d, y = next(
        (a, b, c, d, y) for a, b in allowed_edges(vertices, faces)
        for c, d in allowed_edges(vertices, faces)
        for y in {v for face in faces.tolist() if {a, b} <= {*face} for v in face} - {a, b}
        if not near(faces, [a, b, y], [c, d])
        and meshes.is_allowed(vertices, collapsed(faces, (a, b)), c, d, vertices[c]))
    for own, other in (1, 10), (10, 1):
        check_collapses(impl, vertices, faces, rng, {a: own, b: other, c: 8, d: 11, y: 12},
                        [(a, b), (c, d)], f", and {a} has {own + other}")


@exercise("12.12")
def test_all_collapses_are_those_of_the_slow_loop(impl, rng):
    """Costs are out of date, quadrics are not summed, or a refused edge ends the loop, somewhere on
    the way. The first collapse that differs is shown."""
    meshes.check_all_collapses(functools.partial(loop, impl), rng)


@exercise("12.12")
def test_a_surface_stays_closed_and_keeps_its_holes(impl, rng):
    """why_refused is not asked: a torus becomes a sphere, an edge gets four faces or one, or a face
    comes twice."""
    meshes.check_it_stays_closed(functools.partial(loop, impl), rng)


@exercise("12.12")
def test_it_ends_with_a_tetrahedron(impl, rng):
    """The number of faces cannot be reached, since all edges are refused: an endless loop, or
    nothing is left."""
    meshes.check_a_tetrahedron_is_left(functools.partial(loop, impl), rng)
