"""What the exercises of lab 12 must do."""
import itertools

import numpy as np
from simplification_meshes import (
    DOUBLE,
    LEAST_COSINE,
    LEAST_CURVATURE,
    LEAST_SHAPE,
    bumpy,
    edges_of,
    error,
    euler,
    gone,
    greedy,
    is_allowed,
    outer,
    place_and_cost,
    planes_of,
    quadrics_of,
    rows,
    shape,
)

from course.checks import assert_close, assert_equal, exercise
from course.given import mesh
from course.given.gradcheck import gradcheck

# --- quadrics ----------------------------------------------------------------------------------

@exercise("12.2")
def test_the_quadric_of_a_plane(impl):
    """Row times column instead of column times row: a number, not a matrix."""
    expected = np.array([[1.0, 2.0, 3.0, 4.0], [2.0, 4.0, 6.0, 8.0],
                         [3.0, 6.0, 9.0, 12.0], [4.0, 8.0, 12.0, 16.0]])
    assert_close(impl.plane_quadrics(np.array([1.0, 2.0, 3.0, 4.0])), expected)


@exercise("12.2")
def test_one_quadric_for_each_plane(impl, rng):
    """Planes are mixed with each other, or only one axis of them is understood."""
    p = rng.normal(size=(3, 2, 4))
    expected = np.array([[outer(p[i, j]) for j in range(2)] for i in range(3)])
    assert_close(impl.plane_quadrics(p), expected)


@exercise("12.3")
def test_quadrics_are_summed_over_the_faces_at_a_vertex(impl):
    """q[faces] += ... counts one face only; faces' quadrics are shared out, in thirds; or there is
    no row for a vertex of no face."""
    quadrics = np.array([1.0, 10.0, 100.0])[:, None, None] * np.arange(16.0).reshape(4, 4)
    got = impl.vertex_quadrics(quadrics, np.array([[0, 1, 2], [2, 1, 4], [1, 4, 6]]), 9)
    counts = np.array([1.0, 111.0, 11.0, 0.0, 110.0, 0.0, 100.0, 0.0, 0.0])
    assert_close(got, counts[:, None, None] * np.arange(16.0).reshape(4, 4))


@exercise("12.3")
def test_quadrics_of_a_mesh_face_by_face(impl, rng):
    """A corner of the faces is left out."""
    vertices, faces = bumpy(20, rng)
    each = np.array([quadrics_of(vertices, face[None])[face[0]] for face in faces])
    assert_close(impl.vertex_quadrics(each, faces, len(vertices)), quadrics_of(vertices, faces))


@exercise("12.4")
def test_an_error_on_paper(impl):
    """The 1 after x, y, z is missing; or the distance is not squared."""
    q = outer(np.array([0.6, 0.8, 0.0, -2.0]))
    assert_close(impl.quadric_error(q, np.array([5.0, 5.0, 9.0])), 25.0)
    assert_close(impl.quadric_error(q, np.array([2.0, 1.0, 9.0])), 0.0)


@exercise("12.4")
def test_the_error_is_the_double_sum(impl, rng):
    """Shapes that broadcast; a quadric that is not symmetric."""
    q, x = rng.normal(size=(2, 1, 4, 4)), rng.normal(size=(5, 3))
    expected = np.array([[error(q[i, 0], x[j]) for j in range(5)] for i in range(2)])
    assert_close(impl.quadric_error(q, x), expected)


@exercise("12.5")
def test_the_gradient_of_an_error_on_paper(impl):
    """2 Q v where Q is not symmetric, or the gradient of the 1 is returned, too."""
    q = np.arange(16.0).reshape(4, 4)
    grad_q, grad_x = impl.quadric_error_backward(np.array(2.0), q, np.array([1.0, 0.0, 2.0]))
    assert_close(grad_x, 2 * np.array([0 + 4 + 3 + 0 + 16 + 12, 4 + 12 + 7 + 1 + 18 + 13,
                                       8 + 20 + 11 + 2 + 20 + 14.0]))
    assert_close(grad_q, 2 * np.array([[1.0, 0, 2, 1], [0, 0, 0, 0], [2, 0, 4, 2], [1, 0, 2, 1]]))


@exercise("12.5")
def test_the_gradient_of_an_error_is_its_derivative(impl, rng):
    """grad_error is left out, or summed over the points."""
    def forward(q, x):
        v = np.concatenate([x, np.ones((*x.shape[:-1], 1))], -1)
        return np.einsum("...i,...ij,...j", v, q, v)

    gradcheck(forward, impl.quadric_error_backward,
              (rng.normal(size=(3, 2, 4, 4)), rng.normal(size=(3, 2, 3))),
              seed=int(rng.integers(1 << 30)), name="quadric_error")


@exercise("12.6")
def test_boundary_planes_of_a_triangle(impl):
    """The plane of the face itself; or n points into the face; or it is not of length 1."""
    vertices = np.array([[0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [0.0, 3.0, 5.0]])
    expected = np.array([[0.0, -1.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.6, 0.8, 0.0, -2.4]])
    for face in [0, 1, 2], [1, 0, 2]:
        edges, p = impl.boundary_planes(vertices, np.array([face]))
        assert_equal(edges, np.array([[0, 1], [0, 2], [1, 2]]))
        assert_close(p, expected)


@exercise("12.6")
def test_they_contain_their_edge_and_leave_their_face_behind(impl, rng):
    """Planes in the order of the faces, not of the edges; the wrong face, or the wrong corner."""
    vertices, faces = mesh.grid(18)
    vertices = vertices + 0.2 * rng.normal(size=vertices.shape)
    faces = rng.permuted(rng.permutation(faces)[3:], axis=1)
    edges, p = impl.boundary_planes(vertices, faces)
    expected = np.array([pair for pair in edges_of(faces)
                         if sum({*pair.tolist()} <= {*face} for face in faces.tolist()) == 1])
    assert_equal(edges, expected)
    for (i, j), plane in zip(expected, p, strict=True):
        face = next(face for face in faces.tolist() if {i, j} <= {*face})
        third = vertices[sum(face) - i - j]
        along = (vertices[j] - vertices[i]) / np.linalg.norm(vertices[j] - vertices[i])
        out = vertices[i] - third
        out = out - (out @ along) * along
        out /= np.linalg.norm(out)
        assert_close(plane, np.append(out, -out @ vertices[i]))


@exercise("12.6", fine_print=True)
def test_no_boundary_and_no_area(impl):
    """A closed surface fails; or a face without area gives nan."""
    edges, p = impl.boundary_planes(*mesh.icosphere(20))
    assert_equal((np.shape(edges), np.shape(p)), ((0, 2), (0, 4)))
    line = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]])
    assert_close(impl.boundary_planes(line, np.array([[0, 1, 2]]))[1], np.zeros((3, 4)))


# --- the best place ----------------------------------------------------------------------------

@exercise("12.8")
def test_the_best_place_on_a_segment_on_paper(impl):
    """b of the quadric is left out; or the place is not clipped to the segment."""
    q = np.repeat(planes_of([1, 0, 0, -2]), 4, 0)
    a = np.array([[0.0, 0.0, 1.0], [3.0, 0.0, 0.0], [-5.0, 1.0, 0.0], [1.995, 0.0, 0.0]])
    b = np.array([[8.0, 4.0, 1.0], [9.0, 9.0, 0.0], [1.0, 7.0, 3.0], [2.015, 0.0, 0.0]])
    expected = np.array([[2.0, 1.0, 1.0], [3.0, 0.0, 0.0], [1.0, 7.0, 3.0], [2.0, 0.0, 0.0]])
    assert_close(impl.best_on_segment(q, a, b), (expected, np.ones(4, bool)))


@exercise("12.8")
def test_no_point_of_the_segment_is_better(impl, rng):
    """A wrong sign, or a factor 2, for planes in general position."""
    p = rng.normal(size=(6, 5, 4))
    q = np.array([sum(map(outer, planes)) for planes in p])
    a, b = rng.normal(size=(2, 6, 3))
    place, unique = impl.best_on_segment(q, a, b)
    assert_equal(unique, np.ones(6, bool))
    for k in range(6):
        at = [error(q[k], a[k] + t * (b[k] - a[k])) for t in (0, 0.5, 1)]   # a parabola
        t = (3 * at[0] - 4 * at[1] + at[2]) / (4 * (at[0] - 2 * at[1] + at[2]))
        assert_close(place[k], a[k] + np.clip(t, 0, 1) * (b[k] - a[k]), rtol=1e-7)


@exercise("12.8", fine_print=True)
def test_along_a_plane_no_place_is_best(impl):
    """e in the plane: 0/0, or rounding decides. LEAST_CURVATURE is compared with trace(A) e.e."""
    edge = 1e3 * np.array([[0.0, 1.0, 0.0]])
    for factor, expected in (0.0, False), (0.95, False), (1.06, True):
        for scale in 1e-6, 1e6:
            q = scale * np.diag([0.3, factor * LEAST_CURVATURE, 0.7, 5.0])[None]
            place, unique = impl.best_on_segment(q, 2 - 0.5 * edge, 2 + edge)
            assert_equal(unique, np.array([expected]))
            if not expected:
                assert_close(place, 2 - 0.5 * edge)
    same = np.array([[1.0, 2.0, 3.0]])
    got = impl.best_on_segment(planes_of([1, 0, 0, 0]), same, same)
    assert_close(got, (same, np.array([False])))


@exercise("12.10")
def test_a_corner_is_found(impl):
    """The sign of b, or its scale: three planes meet in one point."""
    q = np.concatenate([planes_of([1, 0, 0, -1], [0, 1, 0, -2], [0, 0.6, 0.8, -3.6]),
                        planes_of([2, 0, 0, 6], [0, 1, 0, 5], [0, 0, 3, 12])])
    assert_close(impl.best_anywhere(q), np.array([[1.0, 2.0, 3.0], [-3.0, -5.0, -4.0]]))


@exercise("12.10")
def test_at_the_best_place_the_gradient_is_zero(impl, rng):
    """Quadrics of several pairs are mixed."""
    axes = np.linalg.qr(rng.normal(size=(7, 3, 3)))[0] * rng.uniform(0.3, 1.5, (7, 3, 1))
    planes = np.concatenate([axes, rng.normal(size=(7, 3, 1))], -1)
    q = np.array([sum(map(outer, rows)) for rows in planes])
    x = impl.best_anywhere(q)
    gradient = np.array([[error(q[k], x[k] + d) - error(q[k], x[k] - d) for d in 1e-3 * np.eye(3)]
                         for k in range(7)])
    assert_equal(x.shape, (7, 3))
    assert_close(gradient, np.zeros((7, 3)), atol=1e-9)


@exercise("12.17")
def test_costs_of_two_pairs_on_paper(impl):
    """One vertex's quadric alone, their mean, or the cost at an end of the pair."""
    vertices = np.array([[0.0, 0.0, 0.0], [9.0, 9.0, 9.0], [6.0, 0.0, 0.0]])
    q = np.concatenate([planes_of([1, 0, 0, 0]), planes_of([0, 1, 0, 0], [0, 0, 1, 0]),
                        planes_of([1, 0, 0, -6], [1, 0, 0, -6])])
    positions, costs = impl.pair_costs(vertices, q, np.array([[0, 2], [0, 1]]))
    assert_close(positions, np.array([[4.0, 0.0, 0.0], [0.0, 0.0, 0.0]]))
    assert_close(costs, np.array([24.0, 0.0]))


@exercise("12.17")
def test_costs_are_those_of_pair_by_pair(impl, rng):
    """Pairs are mixed, or numbered as vertices are."""
    vertices, faces = bumpy(20, rng, 0.3)
    pairs, q = rng.permutation(edges_of(faces)), quadrics_of(vertices, faces)
    expected = [place_and_cost(q[a] + q[b], vertices[a], vertices[b]) for a, b in pairs]
    positions, costs = impl.pair_costs(vertices, q, pairs)
    assert_close(positions, np.array([place for place, _ in expected]), rtol=1e-7, atol=1e-9)
    assert_close(costs, np.array([cost for _, cost in expected]), rtol=1e-7, atol=1e-9)


# --- collapses ---------------------------------------------------------------------------------

@exercise("12.11")
def test_a_collapse_on_paper(impl):
    """Faces of both stay, a is renamed instead of b, or the corners turn."""
    faces = np.array([[7, 2, 5], [5, 2, 9], [5, 1, 7], [3, 4, 6], [9, 8, 5], [2, 8, 9], [2, 7, 0]])
    expected = np.array([[2, 1, 7], [3, 4, 6], [9, 8, 2], [2, 8, 9], [2, 7, 0]])
    assert_equal(impl.collapse_faces(faces, 2, 5), expected)


@exercise("12.11")
def test_a_collapse_may_leave_nothing_or_everything(impl):
    """Shapes of no faces; a pair without a common face loses none."""
    assert_equal(impl.collapse_faces(np.array([[0, 1, 2]]), 2, 0), np.zeros((0, 3), int))
    assert_equal(impl.collapse_faces(np.array([[0, 1, 2], [3, 4, 5]]), 1, 4),
                 np.array([[0, 1, 2], [3, 1, 5]]))


@exercise("12.12")
def test_the_ring_of_a_double_pyramid_must_not_be_pinched(impl):
    """The two thirds are shared, but so is the ring's other vertex."""
    for a, b in itertools.permutations((1, 2, 3), 2):
        assert_equal(impl.satisfies_link_condition(DOUBLE, a, b), False)
    for a, b in itertools.product((0, 4), (1, 2, 3)):
        assert_equal(impl.satisfies_link_condition(DOUBLE, a, b), True)
        assert_equal(impl.satisfies_link_condition(DOUBLE, b, a), True)


@exercise("12.12")
def test_every_edge_of_a_sphere_satisfies_it(impl):
    """Not more than two neighbours are shared, but the numbers of the vertices count."""
    _, faces = mesh.icosphere(20)
    for a, b in edges_of(faces):
        near = faces[(faces == a).any(1) | (faces == b).any(1)]
        assert_equal(impl.satisfies_link_condition(near + 5, a + 5, b + 5), True)


@exercise("12.12")
def test_a_thin_ring_must_not_lose_its_hole(impl):
    """Around a tube of three edges: to collapse one would tear the tube."""
    _, faces = mesh.torus(36, tube=0.1)
    for a, b in edges_of(faces):
        thirds = {*faces[((faces == a) | (faces == b)).sum(1) == 2].ravel().tolist()} - {a, b}
        at = [{*faces[(faces == vertex).any(1)].ravel().tolist()} for vertex in (a, b)]
        assert_equal(impl.satisfies_link_condition(faces, int(a), int(b)),
                     (at[0] & at[1]) - {a, b} == thirds)


@exercise("12.12")
def test_three_faces_at_an_edge_have_three_thirds(impl):
    """The number of shared neighbours is compared with 2."""
    book = np.array([[0, 1, k] for k in (2, 3, 4)])
    assert_equal(impl.satisfies_link_condition(book, 0, 1), True)


def triangle(*corners):
    return np.array([corners], float)


@exercise("12.14")
def test_a_face_that_turns_over_flips(impl):
    """One that turns in its own plane, moves or grows does not."""
    before = triangle([0, 0, 0], [2, 0, 0], [0, 2, 0])
    assert_equal(impl.flips(before, 7 * before + [1.0, 2.0, 3.0]), False)
    assert_equal(impl.flips(before, triangle([0, 0, 0], [0, 2, 0], [-2, 0, 0])), False)
    assert_equal(impl.flips(before, triangle([0, 0, 0], [2, 0, 0], [0, -1, 0])), True)


@exercise("12.14")
def test_more_than_45_degrees_flip_and_a_little_less_does_not(impl):
    """Another angle, or its sine."""
    before = triangle([0, 0, 0], [2, 0, 0], [0, 2, 0])
    for height, expected in ((1.0, 0.95), False), ((1.0, 0.2), False), ((0.95, 1.0), True), \
                            ((0.0, 1.0), True), ((-0.01, 1.0), True), ((0.0, 0.0), True):
        after = triangle([0, 0, 0], [2, 0, 0], [0, *height])
        assert_equal(impl.flips(before, after), expected)


@exercise("12.14")
def test_the_angle_between_the_normals_decides(impl, rng):
    """A side is measured from the origin: right only where the first corner lies there."""
    for _ in range(40):
        before = 3 + rng.normal(size=(1, 3, 3))
        after = before + 0.4 * rng.normal(size=(1, 3, 3))
        n, n1 = ([np.linalg.det([axis, b - a, c - a]) for axis in np.eye(3)]
                 for a, b, c in (before[0], after[0]))
        cosine = np.dot(n, n1) / np.linalg.norm(n) / np.linalg.norm(n1)
        thinner = shape(*after[0]) < LEAST_SHAPE * shape(*before[0])
        assert_equal(impl.flips(before, after), bool(cosine < LEAST_COSINE or thinner))


@exercise("12.14")
def test_a_triangle_must_not_become_a_sliver(impl):
    """The area is compared, not the shape; or with a number that has a unit; or the longest edge is
    taken for one of the others. A sliver may stay one."""
    right = triangle([0, 0, 0], [2, 0, 0], [0, 2, 0])               # of shape 1 / 2
    for x in 0.0, 1.0, 2.0:                                         # of shape height
        for height, expected in (0.475 * LEAST_SHAPE, True), (0.525 * LEAST_SHAPE, False):
            thin = triangle([0, 0, 0], [2, 0, 0], [x, 2 * height, 0])
            for turn in range(3):
                assert_equal(impl.flips(right, np.roll(thin, turn, axis=1)), expected)
            assert_equal(impl.flips(thin, 0.001 * thin), False)
            assert_equal(impl.flips(thin, right), False)
    assert_equal(impl.flips(right, 1e-4 * right), False)


@exercise("12.14")
def test_the_size_of_a_triangle_does_not_matter(impl):
    """A number that has a unit decides."""
    before = triangle([0, 0, 0], [2, 0, 0], [0, 2, 0])
    for size in 1e-6, 1e6:
        for height, expected in (1.05, False), (0.95, True), (-0.01, True):
            after = triangle([0, 0, 0], [2, 0, 0], [0, height, 1])
            assert_equal(impl.flips(size * before, size * after), expected)


@exercise("12.14")
def test_one_of_many_is_enough(impl, rng):
    """all for any."""
    before = rng.normal(size=(5, 3, 3))
    assert_equal(impl.flips(before, before), False)
    for k in range(5):
        after = before.copy()
        after[k] = after[k, [1, 0, 2]]
        assert_equal(impl.flips(before, after), True)


@exercise("12.14", fine_print=True)
def test_one_without_area_never_flips(impl, rng):
    """A face that had no area keeps its neighbours from ever moving."""
    before = rng.normal(size=(5, 3, 3))
    before[2] = [[0.0, 0, 0], [1, 1, 1], [1, 1, 1]]
    after = before.copy()
    after[2, 2] = 5.0, 6.0, 9.0
    assert_equal(impl.flips(before, after), False)
    assert_equal(impl.flips(np.zeros((0, 3, 3)), np.zeros((0, 3, 3))), False)


# --- the algorithm -----------------------------------------------------------------------------


def loop(impl, vertices, faces, face_count):
    return impl.simplify_loop(vertices, faces, quadrics_of(vertices, faces), face_count)


@exercise("12.15")
def test_nothing_to_do(impl, rng):
    """One collapse too many, where there are just as many faces as asked for."""
    vertices, faces = bumpy(20, rng)
    for face_count in 20, 21:
        assert_equal(loop(impl, vertices, faces, face_count), (vertices, faces))


@exercise("12.15")
def test_one_collapse(impl, rng):
    """The upper vertex stays, or the lower one stays where it was; or it is another pair."""
    vertices, faces = bumpy(20, rng, 0.2)
    [(expected, left)] = greedy(vertices, faces, [19])
    got, got_left = loop(impl, vertices, faces, 19)
    assert_equal(rows(got_left), rows(left))
    assert_close(got, expected, atol=1e-9)


@exercise("12.15")
def test_all_collapses_are_those_of_the_slow_loop(impl, rng):
    """Quadrics are not summed, costs are out of date, pairs of the upper vertex are lost, refused
    pairs never come back. The first collapse that differs is shown."""
    for noise in 0.05, 0.3:
        vertices, faces = bumpy(45, rng, noise)
        face_counts = range(len(faces), 3, -2)
        slow = dict(zip(face_counts, greedy(vertices, faces, face_counts), strict=True))
        fast = {n: loop(impl, vertices, faces, n) for n in (60, 34, 16, 4)}
        if any(not np.array_equal(rows(got[1]), rows(slow[n][1])) for n, got in fast.items()):
            fast = {}
            for face_count in face_counts:
                fast[face_count] = loop(impl, vertices, faces, face_count)
                got, expected = fast[face_count][1], slow[face_count][1]
                before = slow[min(face_count + 2, len(faces))][1]
                assert_equal(gone(before, got), gone(before, expected))
                assert_equal(rows(got), rows(expected))
        for face_count, (got, left) in fast.items():
            used = np.unique(left)
            assert_close(got[used], slow[face_count][0][used], rtol=1e-6, atol=1e-6)


@exercise("12.15", fine_print=True)
def test_of_equal_costs_the_first_pair_counts(impl, rng):
    """The last one, or any one. Here errors are small whole numbers, the same everywhere, so that
    vertices stay in their places, too."""
    vertices, faces = bumpy(80, rng, 0.02)
    error_of = rng.integers(0, 2, len(vertices))
    q = np.zeros((len(vertices), 4, 4))
    q[:, 3, 3] = error_of
    got, left = impl.simplify_loop(vertices, faces, q, 40)
    expected = faces.tolist()
    while len(expected) > 40:
        pairs = sorted(edges_of(np.array(expected)).tolist(), key=lambda pair: error_of[pair].sum())
        a, b = next((a, b) for a, b in pairs
                    if is_allowed(vertices, expected, a, b, vertices[a]))
        expected = [[a if v == b else v for v in face] for face in expected
                    if not {a, b} <= {*face}]
        error_of[a] += error_of[b]
    assert_equal(rows(left), rows(expected))
    assert_equal(got, vertices)


@exercise("12.15")
def test_a_surface_stays_closed_and_keeps_its_holes(impl, rng):
    """A torus becomes a sphere, an edge gets four faces or one, or a face comes twice."""
    for vertices, faces in mesh.torus(100), mesh.torus(36):
        vertices = vertices + 0.01 * rng.normal(size=vertices.shape)
        left = loop(impl, vertices, faces, 0)[1]
        assert_equal("none left" if len(left) == 0 else "some left", "some left")
        assert_equal("as many faces as before" if len(left) == len(faces) else "fewer", "fewer")
        assert_equal(euler(left), 0)
        faces_at_edge = np.bincount(mesh.edges(left)[1].ravel())
        assert_equal(faces_at_edge, np.full(len(faces_at_edge), 2))
        assert_equal(len({frozenset(face) for face in left.tolist()}), len(left))


@exercise("12.15")
def test_it_ends_with_a_tetrahedron(impl, rng):
    """The target cannot be reached: an endless loop, or nothing is left."""
    vertices, faces = bumpy(20, rng)
    left = loop(impl, vertices, faces, 0)[1]
    assert_equal((len(left), len(np.unique(left))), (4, 4))
