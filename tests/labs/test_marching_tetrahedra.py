"""What the exercises of lab 15 must do: the surface as a mesh."""
import itertools

import numpy as np
import pytest
from scipy.spatial import ConvexHull, Delaunay

from labkit.checks import assert_close, assert_equal, exercise

CORNERS = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
CASES = [case for case in itertools.product([False, True], repeat=4) if any(case) and not all(case)]
NAMES = ["".join("-+"[not within] for within in case) for case in CASES]  # the distances' signs
each_case = pytest.mark.parametrize("inside", CASES, ids=NAMES)


def middles(corners, pairs):
    """The middle of each pair (..., 2) of corners (4, 3)."""
    return corners[pairs].mean(-2)


def turned(rng):
    """A tetrahedron of any shape; vertex 3 sees 0, 1, 2 counter-clockwise."""
    while True:
        corners = rng.normal(size=(4, 3))
        if np.linalg.det(corners[1:] - corners[0]) > 0.3:
            return corners


def around(triangles):
    """The edges of triangles that have no counterpart, each as (from, to), two pairs of vertices.
    """
    edges = [(tuple(map(int, t[k])), tuple(map(int, t[(k + 1) % 3])))
             for t in triangles for k in range(3)]
    return sorted(edge for edge in edges if edge[::-1] not in edges)


@exercise("15.7")
def test_no_case_is_left_out(impl):
    """The number of triangles: 1 where one or three vertices are inside, 2 where two are. A case is
    left out, two inside give one triangle, or four corners come as they are and not as triangles.
    """
    for inside in CASES:
        got = impl.tetrahedron_triangles(np.array(inside))
        assert_equal(got.shape, (1 + (sum(inside) == 2), 3, 2), given=f"inside {inside}")


@exercise("15.7")
def test_each_corner_is_an_edge_that_is_crossed(impl):
    """A corner joins two vertices inside, or two outside, or an edge that is crossed has no corner.
    To mend an odd order, a vertex inside is exchanged with one outside, and not two of one side.
    Which comes first in a corner does not matter here.
    """
    for inside in CASES:
        triangles = impl.tetrahedron_triangles(np.array(inside)).reshape(-1, 2)
        crossed = [(a, b) for a, b in itertools.combinations(range(4), 2) if inside[a] != inside[b]]
        assert_equal(sorted({(int(min(pair)), int(max(pair))) for pair in triangles}), crossed,
                     given=f"inside {inside}")


def check_inside_first(impl, cases):
    for inside in cases:
        first, second = np.moveaxis(impl.tetrahedron_triangles(np.array(inside)), -1, 0)
        assert_equal((np.array(inside)[first].all(), np.array(inside)[second].any()),
                     (True, False), given=f"inside {inside}: are the first, and the second, "
                                           "vertices of all corners inside?")


@exercise("15.7")
def test_the_vertex_inside_comes_first(impl):
    """A corner is (outside, inside), or inside and outside are swapped: triangles lie around the
    vertices outside.
    """
    # Those inside have the smallest numbers.
    check_inside_first(impl, [case for case in CASES if sorted(case, reverse=True) == list(case)])


@exercise("15.7")
def test_the_vertex_inside_comes_first_whatever_its_number(impl):
    """A corner has its smaller vertex first: both are sorted by their numbers, or the vertices
    inside are taken to be the first ones, or their numbers belong to another order of the four.
    """
    check_inside_first(impl, CASES)


@exercise("15.7")
def test_one_vertex_inside_is_one_triangle(impl):
    """Vertex 0 is inside. The winding is clockwise seen from outside, so that all triangles face
    inward; is it the opposite of what is asked, or of 0, 1, 2?
    """
    triangles = impl.tetrahedron_triangles(np.array([True, False, False, False]))
    assert_equal(around(triangles), [((0, 1), (0, 2)), ((0, 2), (0, 3)), ((0, 3), (0, 1))])


@exercise("15.7")
def test_any_one_vertex_inside_is_one_triangle(impl):
    """Right for vertex 0, and wound the wrong way for others: an odd order of the four vertices
    mirrors space, see `is_odd`, and is taken for a turn.
    """
    for a, b, c, d in (1, 0, 3, 2), (2, 0, 1, 3), (3, 0, 2, 1):
        triangles = impl.tetrahedron_triangles(np.arange(4) == a)
        assert_equal(around(triangles), sorted([((a, b), (a, c)), ((a, c), (a, d)),
                                                ((a, d), (a, b))]))


@exercise("15.7")
def test_three_vertices_inside_are_one_triangle(impl):
    """Three inside are treated as one inside with the roles exchanged, and the triangle is not
    turned round: it faces inward. Or odd orders are taken for turns here.
    """
    for a, b, c, d in (0, 1, 2, 3), (1, 0, 3, 2), (2, 0, 1, 3), (3, 0, 2, 1):
        triangles = impl.tetrahedron_triangles(np.arange(4) != a)
        assert_equal(around(triangles), sorted([((c, a), (b, a)), ((d, a), (c, a)),
                                                ((b, a), (d, a))]))


@exercise("15.7", fine_print=True)
def test_nothing_or_all_inside_is_no_triangle(impl):
    """Without a surface there is an error, or a triangle where there is none."""
    for inside in np.zeros(4, bool), np.ones(4, bool):
        assert_close(impl.tetrahedron_triangles(inside), np.zeros((0, 3, 2)))


@exercise("15.7")
@each_case
def test_corners_lie_on_the_crossed_edges(impl, inside):
    """A pair of vertices on one side, the vertex outside first, or a corner is left out."""
    triangles = impl.tetrahedron_triangles(np.array(inside)).reshape(-1, 2)
    crossed = {(a, b) for a in range(4) for b in range(4) if inside[a] and not inside[b]}
    assert_equal(sorted(set(map(tuple, triangles.tolist()))), sorted(crossed))
    assert_equal(len(triangles), {3: 3, 4: 6}[len(crossed)])


@exercise("15.7")
@each_case
def test_the_border_goes_round_once_from_face_to_face(impl, inside):
    """With two inside, the four corners are not in their order around the quadrangle: two triangles
    cross each other as a bow tie. Or they are wound against each other: one of them is turned
    round.
    """
    border = around(impl.tetrahedron_triangles(np.array(inside)))
    assert_equal(len(border), sum(inside) * (4 - sum(inside)))
    assert_equal(sorted(start for start, _ in border), sorted(end for _, end in border))
    for start, end in border:  # within one face of the tetrahedron
        assert_equal(len({*start, *end}), 3)


@exercise("15.7")
@each_case
def test_the_front_faces_the_outside(impl, rng, inside):
    """A case is wound the wrong way: its triangles face inward, clockwise seen from outside. It may
    be an odd order that is taken for a turn, where two vertices are inside.
    """
    triangles = impl.tetrahedron_triangles(np.array(inside))
    for corners in CORNERS, turned(rng), turned(rng):
        for a, b, c in middles(corners, triangles):
            normal = np.cross(b - a, c - a)
            for vertex, within in zip(corners, inside, strict=True):
                assert_equal(bool(normal @ (vertex - a) < 0), within,
                             given=f"inside {inside}: is a vertex behind the triangle?")


def random_tetrahedra(rng, count=40):
    """Delaunay tetrahedra of random points, turned so that vertex 3 sees 0, 1, 2 ccw."""
    points = rng.uniform(-1, 1, (count, 3))
    points = np.concatenate([points, 3 * CORNERS[1:], -3 * CORNERS[1:]])
    tetrahedra = Delaunay(points).simplices.astype(int)
    over = np.linalg.det(points[tetrahedra[:, 1:]] - points[tetrahedra[:, :1]]) < 0
    tetrahedra[over] = tetrahedra[over][:, [1, 0, 2, 3]]
    return points, tetrahedra


def random_field(rng, points):
    """Distances of random sign; those of the six outermost points are outside."""
    distance = rng.normal(size=len(points))
    distance[-6:] = rng.uniform(0.1, 1, 6)
    return distance


def crossed_edges(distance, tetrahedra):
    """Sorted pairs (inside, outside)."""
    return sorted({(int(a), int(b)) for t in tetrahedra for a in t for b in t
                   if distance[a] < 0 <= distance[b]})


def directed_edges(faces):
    return [(int(f[k]), int(f[(k + 1) % 3])) for f in faces for k in range(3)]


@exercise("15.8")
def test_one_tetrahedron_on_paper(impl):
    """Another vertex is taken to be inside: the bits of a case are read in reverse, or < is >.
    Numbers are those within the tetrahedron, and not the grid's. A row of ends has the outside or
    the smaller end first. Rows are not sorted. Vertices lie in the middle, or near the wrong end.
    """
    points = np.array([[1.0, 10.0, 3.0], [9.0, 2.0, 3.0], [7.0, 7.0, 7.0], [1.0, 2.0, 3.0],
                       [1.0, 2.0, 11.0]])
    distance = np.array([3.0, -1.0, 9.0, 1.0, 7.0])  # 1/4, 1/2 and 1/8 of the edges from points[1]
    vertices, _, ends = impl.marching_tetrahedra(points, distance, np.array([[3, 1, 0, 4]]))
    assert_equal(ends, [[1, 0], [1, 3], [1, 4]])
    assert_close(vertices, [[7.0, 4.0, 3.0], [5.0, 2.0, 3.0], [8.0, 2.0, 4.0]])


@exercise("15.8")
def test_the_face_of_one_tetrahedron_on_paper(impl):
    """All faces are wound inward, clockwise seen from outside: their corners are in reverse order.
    Or faces do not name the rows of vertices.
    """
    points = np.array([[1.0, 2.0, 3.0], [9.0, 2.0, 3.0], [1.0, 10.0, 3.0], [1.0, 2.0, 11.0]])
    for inside, edges in (0, [(0, 1), (1, 2), (2, 0)]), (1, [(0, 2), (1, 0), (2, 1)]):
        distance = np.where(np.arange(4) == inside, -1.0, [1.0, 2.0, 3.0, 4.0])
        _, faces, _ = impl.marching_tetrahedra(points, distance, np.array([[0, 1, 2, 3]]))
        assert_equal(sorted(directed_edges(faces)), edges)


@exercise("15.8")
def test_each_case_of_one_tetrahedron_has_its_faces(impl):
    """A case is left out: the loop over range ends before case 14, where all are inside but one
    vertex, or begins after case 1, or those with two inside are missing. The surface has holes.
    """
    for inside in CASES:
        distance = np.where(inside, -1.0, 1.0) * [1.0, 2.0, 3.0, 4.0]
        _, faces, _ = impl.marching_tetrahedra(CORNERS.copy(), distance, np.arange(4)[None])
        assert_equal(len(faces), 1 + (sum(inside) == 2),
                     given=f"one tetrahedron, inside {inside}: how many faces?")


@exercise("15.8")
def test_two_triangles_of_one_tetrahedron_share_two_vertices(impl):
    """Vertices of the same edge are not merged: each triangle has its own three, and an edge's
    vertex comes more than once. Each is to come once, as from np.unique.
    """
    for inside in CASES:
        distance = np.where(inside, -1.0, 1.0) * [1.0, 2.0, 3.0, 4.0]
        vertices, _, ends = impl.marching_tetrahedra(CORNERS.copy(), distance, np.arange(4)[None])
        assert_equal((len(vertices), len(ends)), (3 + (sum(inside) == 2),) * 2,
                     given=f"one tetrahedron, inside {inside}: how many vertices, and ends?")


@exercise("15.8")
def test_two_tetrahedra_share_the_points_of_their_edges(impl):
    """Vertices are not merged: they come several times, each triangle or tetrahedron has its own
    vertices, and the mesh falls apart.
    """
    points = np.array([*CORNERS, [1.0, 1.0, 1.0]])
    tetrahedra = np.array([[0, 1, 2, 3], [4, 2, 1, 3]])
    distance = np.array([1.0, 2.0, 1.0, -2.0, 2.0])
    vertices, faces, ends = impl.marching_tetrahedra(points, distance, tetrahedra)
    assert_equal(ends, [[3, 0], [3, 1], [3, 2], [3, 4]])
    expected = points[3] + np.array([2 / 3, 0.5, 2 / 3, 0.5])[:, None] * (points[[0, 1, 2, 4]]
                                                                         - points[3])
    assert_close(vertices, expected)
    assert_equal(sorted(directed_edges(faces)), [(0, 2), (1, 0), (1, 2), (2, 1), (2, 3), (3, 1)])


@exercise("15.8", fine_print=True)
def test_zero_is_outside_and_nothing_is_no_surface(impl):
    """A distance of 0 counts as inside, <= in place of <; or without a surface there is an
    error."""
    tetrahedra = np.array([[0, 1, 2, 3]])
    vertices, _, ends = impl.marching_tetrahedra(CORNERS, np.array([-1.0, 0, 0, 2]), tetrahedra)
    assert_equal(ends, [[0, 1], [0, 2], [0, 3]])
    assert_close(vertices, [[1.0, 0, 0], [0, 1, 0], [0, 0, 1 / 3]])
    for distance in np.array([0.0, 1.0, 2.0, 3.0]), np.full(4, -1.0):
        assert_close(impl.marching_tetrahedra(CORNERS, distance, tetrahedra),
                     (np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2))))


@exercise("15.8")
def test_vertices_are_the_crossed_edges_of_the_grid_each_once(impl, rng):
    """Vertices come more than once, in the order of tetrahedra, or in another order than that of
    their ends, or the ends are sorted by number and not inside first.
    """
    points, tetrahedra = random_tetrahedra(rng)
    distance = random_field(rng, points)
    vertices, _, ends = impl.marching_tetrahedra(points, distance, tetrahedra)
    expected = np.array(crossed_edges(distance, tetrahedra))
    assert_equal(ends, expected)
    s = distance[expected]
    share = s[:, :1] / (s[:, :1] - s[:, 1:])
    a, b = points[expected[:, 0]], points[expected[:, 1]]
    assert_close(vertices, a + share * (b - a))


@exercise("15.8")
def test_random_fields_give_closed_and_consistently_wound_surfaces(impl, rng):
    """A case is left out, so that there are holes, or is doubled, or wound against its neighbours.
    """
    for count in 12, 40, 90:
        points, tetrahedra = random_tetrahedra(rng, count)
        distance = random_field(rng, points)
        vertices, faces, _ = impl.marching_tetrahedra(points, distance, tetrahedra)
        edges = directed_edges(faces)
        assert_equal(len(set(edges)), len(edges))
        assert_equal(sorted(edges), sorted((b, a) for a, b in edges))
        assert_equal(sorted(set(np.ravel(faces).tolist())), list(range(len(vertices))))


@exercise("15.8")
def test_the_volume_within_is_the_volume_of_what_is_inside(impl, rng):
    """All faces are wound inward, or one tetrahedron's surface lies in another place."""
    points, tetrahedra = random_tetrahedra(rng, 25)
    distance = random_field(rng, points)
    expected = 0.0
    for t in tetrahedra:
        within = [points[k] for k in t if distance[k] < 0]
        cuts = [(points[a] * distance[b] - points[b] * distance[a]) / (distance[b] - distance[a])
                for a in t for b in t if distance[a] < 0 <= distance[b]]
        expected += ConvexHull(np.array(within + cuts)).volume if within else 0.0
    vertices, faces, _ = impl.marching_tetrahedra(points, distance, tetrahedra)
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    assert_close((a * np.cross(b, c)).sum() / 6, expected, rtol=1e-9)


@exercise("15.8", fine_print=True)
def test_many_points_do_not_get_mixed_up(impl):
    """Numbers of edges overflow, or collide, where the grid is large: 70,000 points."""
    points = np.arange(210_000.0).reshape(-1, 3) % 7
    tetrahedra = np.array([[69_999, 69_998, 3, 2], [1, 0, 69_997, 4]])
    distance = np.ones(70_000)
    distance[[69_999, 1]] = -1.0
    _, faces, ends = impl.marching_tetrahedra(points, distance, tetrahedra)
    assert_equal(ends, [[1, 0], [1, 4], [1, 69_997], [69_999, 2], [69_999, 3], [69_999, 69_998]])
    assert_equal(sorted(map(sorted, faces.tolist())), [[0, 1, 2], [3, 4, 5]])


@exercise("15.8", fine_print=True)
def test_ties_and_tiny_distances_give_closed_surfaces_too(impl, rng):
    """Points at one place are merged, flat faces are left out, or tiny distances count as 0."""
    points, tetrahedra = random_tetrahedra(rng)
    distance = rng.integers(-1, 2, len(points)) * 1e-12
    distance[-6:] = 1e-12
    vertices, faces, ends = impl.marching_tetrahedra(points, distance, tetrahedra)
    assert_equal(ends, np.array(crossed_edges(distance, tetrahedra)))
    edges = directed_edges(faces)
    assert_equal(len(set(edges)), len(edges))
    assert_equal(sorted(edges), sorted((b, a) for a, b in edges))
    assert_equal(sorted(set(np.ravel(faces).tolist())), list(range(len(vertices))))


# Four edges, crossed where P_A + t STEP is, t = s_a / (s_a - s_b).
P_A = np.array([[1.0, 2.0, -3.0], [4.0, -1.0, 2.0], [-2.0, 3.0, 5.0], [0.5, -4.0, 1.0]])
STEP = np.array([[2.0, 4.0, 1.0], [3.0, 5.0, -1.0], [-4.0, 2.0, 3.0], [7.0, 1.0, 10.0]])
S_A, S_B = np.array([-1.0, -6.0, -2.0, -2.0]), np.array([3.0, 2.0, 3.0, 8.0])
GRAD_P = np.array([[5.0, 4.0, 6.0], [8.0, 7.0, -5.0], [6.0, -7.0, -4.0], [10.0, 20.0, 21.0]])


@exercise("15.9")
def test_gradients_of_both_points_on_paper(impl):
    """grad_p_a and grad_p_b: the weights of both ends are swapped, the nearer end gets the smaller
    part, t has the wrong sign, or is divided by s_a + s_b, or an end gets all, or a half.
    """
    got = impl.zero_crossing_backward(GRAD_P, P_A, P_A + STEP, S_A, S_B)  # t = 1/4, 3/4, 2/5, 1/5
    assert_close(got[:2], (np.array([0.75, 0.25, 0.6, 0.8])[:, None] * GRAD_P,
                           np.array([0.25, 0.75, 0.4, 0.2])[:, None] * GRAD_P))


@exercise("15.9")
def test_gradients_of_both_distances_on_paper(impl):
    """grad_s_a and grad_s_b: both are swapped, opposite to each other, or 0. A sign is wrong, as
    where |s_a| stands for s_a. s_b - s_a is not squared. The denominator's derivative is missing.
    grad_p's three numbers are not summed along p_b - p_a.
    """
    got = impl.zero_crossing_backward(GRAD_P, P_A, P_A + STEP, S_A, S_B)
    # grad_p . (p_b - p_a) = 32, 64, -50, 300. By s_a it is that times -s_b / (s_b - s_a)^2, by s_b
    # times s_a / (s_b - s_a)^2.
    assert_close(got[2], [-32 * 3 / 16, -64 * 2 / 64, 50 * 3 / 25, -300 * 8 / 100])
    assert_close(got[3], [-32 * 1 / 16, -64 * 6 / 64, 50 * 2 / 25, -300 * 2 / 100])


@exercise("15.9")
def test_gradients_of_crossings_are_central_differences(impl, rng, gradcheck):
    """Edges are mixed, or one coordinate alone counts: x, y and z all move the crossing."""
    def forward(p_a, p_b, s_a, s_b):
        return np.stack([(a * t - b * s) / (t - s)
                         for a, b, s, t in zip(p_a, p_b, s_a, s_b, strict=True)])

    p_a, p_b = rng.normal(size=(2, 7, 3))
    s_a, s_b = -rng.uniform(0.3, 2, 7), rng.uniform(0.3, 2, 7)
    gradcheck(forward, impl.zero_crossing_backward, (p_a, p_b, s_a, s_b), name="zero_crossing")


@exercise("15.9")
def test_gradients_where_the_surface_meets_a_point_of_the_grid(impl):
    """s_b = 0 is divided by, or what is divided by is kept away from 0 where distances are small.
    """
    p_a, p_b, grad_p = np.array([[0.0, 0, 0]]), np.array([[0.0, 8.0, 0]]), np.array([[5.0, 2.0, 0]])
    for unit in 1.0, 1e-6:
        got = impl.zero_crossing_backward(grad_p, p_a, p_b, np.array([-4.0 * unit]),
                                          np.array([0.0]))
        assert_close(got[0], 0 * grad_p)
        assert_close(got[1], grad_p)
        assert_close(got[2], [0.0])
        assert_close(got[3] * unit, [-4.0])


# Points 0 and 2 are inside; the vertices lie at 1/4, 2/5 and 3/4 of the edges from there.
ENDS = np.array([[0, 1], [0, 3], [2, 1]])
FIELD = np.array([-2.0, 6.0, -18.0, 3.0])
PLACES = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 8.0], [0.0, 4.0, 4.0], [5.0, 10.0, 0.0]])
PULL = np.array([[4.0, 8.0, -2.0], [5.0, 0.0, 10.0], [-4.0, 12.0, 4.0]])


@exercise("15.10")
def test_points_of_the_grid_on_paper(impl):
    """grad_points: the shares of the ends are swapped, one end gets all, or a half. A point that is
    an end of several vertices keeps the last one's share: += with indices loses the others.
    """
    got = impl.marching_tetrahedra_backward(PULL, ENDS, PLACES, FIELD)[0]
    assert_close(got, [0.75 * PULL[0] + 0.6 * PULL[1], 0.25 * PULL[0] + 0.75 * PULL[2],
                       0.25 * PULL[2], 0.4 * PULL[1]])


@exercise("15.10")
def test_distances_of_the_grid_on_paper(impl):
    """grad_distance: a sign is wrong, so that the surface grows with the distances. Both ends are
    swapped. s_b - s_a is not squared. A point that is an end of several vertices keeps the last
    one's share. The two outputs are swapped.
    """
    got = impl.marching_tetrahedra_backward(PULL, ENDS, PLACES, FIELD)[1]
    # PULL . (p_b - p_a) is 0, 25, -48.
    assert_close(got, [-25 * 3 / 25, 48 * 18 / 24**2, 48 * 6 / 24**2, -25 * 2 / 25])


@exercise("15.10")
def test_a_point_without_a_crossed_edge_gets_nothing(impl, rng):
    """The outputs have as many rows as there are ends or vertices, and not points."""
    points, distance = rng.normal(size=(9, 3)), np.append(FIELD, rng.uniform(1, 2, 5))
    grad_points, grad_distance = impl.marching_tetrahedra_backward(PULL, ENDS, points, distance)
    assert_equal((np.shape(grad_points), np.shape(grad_distance)), ((9, 3), (9,)))
    assert_equal((np.count_nonzero(grad_points[4:]), np.count_nonzero(grad_distance[4:])), (0, 0))


@exercise("15.10")
def test_gradients_of_the_vertices_are_central_differences(impl, rng, gradcheck):
    """What moves one end is taken for fixed; or the shares of many vertices are mixed."""
    points, tetrahedra = random_tetrahedra(rng, 8)
    distance = rng.choice([-1, 1], len(points)) * rng.uniform(0.3, 1, len(points))
    ends = rng.permutation(crossed_edges(distance, tetrahedra))

    def forward(points, distance):
        return np.array([(points[a] * distance[b] - points[b] * distance[a])
                         / (distance[b] - distance[a]) for a, b in ends])

    def backward(grad_vertices, points, distance):
        return impl.marching_tetrahedra_backward(grad_vertices, ends, points, distance)

    gradcheck(forward, backward, (points, distance), name="marching_tetrahedra")
