"""What the exercises of lab 15 must do: the surface as a mesh."""
import itertools

import numpy as np
import pytest
from scipy.spatial import ConvexHull, Delaunay

from course.checks import assert_close, assert_equal, exercise
from course.given.gradcheck import gradcheck

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


@exercise("15.10")
def test_one_vertex_inside_is_one_triangle(impl):
    """The winding, or the order within a pair; vertex 0 of the unit tetrahedron is inside."""
    triangles = impl.tetrahedron_triangles(np.array([True, False, False, False]))
    assert_equal(triangles.shape, (1, 3, 2))
    assert_equal(around(triangles), [((0, 1), (0, 2)), ((0, 2), (0, 3)), ((0, 3), (0, 1))])


@exercise("15.10", fine_print=True)
def test_nothing_or_all_inside_is_no_triangle(impl):
    """Shapes of empty arrays; or a surface where there is none."""
    for inside in np.zeros(4, bool), np.ones(4, bool):
        assert_equal(impl.tetrahedron_triangles(inside).shape, (0, 3, 2))


@exercise("15.10")
@each_case
def test_corners_lie_on_the_crossed_edges(impl, inside):
    """A pair of vertices on one side, the outside vertex first, or a corner is left out."""
    triangles = impl.tetrahedron_triangles(np.array(inside)).reshape(-1, 2)
    crossed = {(a, b) for a in range(4) for b in range(4) if inside[a] and not inside[b]}
    assert_equal(sorted(set(map(tuple, triangles.tolist()))), sorted(crossed))
    assert_equal(len(triangles), {3: 3, 4: 6}[len(crossed)])


@exercise("15.10")
@each_case
def test_the_border_goes_round_once_from_face_to_face(impl, inside):
    """Two triangles overlap, as a bow tie, or are wound against each other."""
    border = around(impl.tetrahedron_triangles(np.array(inside)))
    crossed = sum(inside) * (4 - sum(inside))
    assert_equal(len(border), crossed)
    assert_equal(sorted(start for start, _ in border), sorted(end for _, end in border))
    for start, end in border:  # within one face of the tetrahedron
        assert_equal(len({*start, *end}), 3)


@exercise("15.10")
@each_case
def test_the_front_faces_the_outside(impl, rng, inside):
    """A case is wound the wrong way: an odd permutation, or two or three vertices inside."""
    triangles = impl.tetrahedron_triangles(np.array(inside))
    for corners in CORNERS, turned(rng), turned(rng):
        for a, b, c in middles(corners, triangles):
            normal = np.cross(b - a, c - a)
            for vertex, within in zip(corners, inside, strict=True):
                assert_equal(bool(normal @ (vertex - a) < 0), within,
                             given=f"inside {inside}: is a vertex behind the triangle?")


@exercise("15.12")
def test_gradients_of_a_crossing_on_paper(impl):
    """The weights of both ends are swapped; or the distances' gradients have a sign or a factor."""
    p_a, p_b = np.array([[0.0, 0.0, 0.0]]), np.array([[0.0, 8.0, 0.0]])
    # p = 8 s_a / (s_a - s_b): at (-1, 3) it is 2, by s_a -8 * 3 / 16, by s_b -8 * 1 / 16.
    grad_p = np.array([[100.0, 2.0, 0.0]])
    got = impl.crossing_backward(grad_p, p_a, p_b, np.array([-1.0]), np.array([3.0]))
    assert_close(got[0], 0.75 * grad_p)
    assert_close(got[1], 0.25 * grad_p)
    assert_close(got[2], np.array([-3.0]))
    assert_close(got[3], np.array([-1.0]))


@exercise("15.12")
def test_gradients_of_crossings_are_central_differences(impl, rng):
    """Edges are mixed, or one coordinate alone counts."""
    def forward(p_a, p_b, s_a, s_b):
        return np.stack([(a * t - b * s) / (t - s)
                         for a, b, s, t in zip(p_a, p_b, s_a, s_b, strict=True)])

    p_a, p_b = rng.normal(size=(2, 7, 3))
    s_a, s_b = -rng.uniform(0.3, 2, 7), rng.uniform(0.3, 2, 7)
    gradcheck(forward, impl.crossing_backward, (p_a, p_b, s_a, s_b), name="crossing")


@exercise("15.12")
def test_gradients_where_the_surface_meets_a_point_of_the_grid(impl):
    """s_b = 0 is divided by; or the span is cut off where distances are small."""
    p_a, p_b, grad_p = np.array([[0.0, 0, 0]]), np.array([[0.0, 8.0, 0]]), np.array([[5.0, 2.0, 0]])
    for unit in 1.0, 1e-6:
        got = impl.crossing_backward(grad_p, p_a, p_b, np.array([-4.0 * unit]), np.array([0.0]))
        assert_close(got[0], 0 * grad_p)
        assert_close(got[1], grad_p)
        assert_close(got[2], np.array([0.0]))
        assert_close(got[3] * unit, np.array([-4.0]))


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


@exercise("15.13")
def test_one_tetrahedron_on_paper(impl):
    """The vertices' places, their order, or the numbers of the corners."""
    distance = np.array([-1.0, 1.0, 3.0, 1.0])
    vertices, faces, ends = impl.marching_tetrahedra(CORNERS, distance, np.array([[0, 1, 2, 3]]))
    assert_close(vertices, np.array([[0.5, 0, 0], [0, 0.25, 0], [0, 0, 0.5]]))
    assert_equal(ends, np.array([[0, 1], [0, 2], [0, 3]]))
    assert_equal(sorted(directed_edges(faces)), [(0, 1), (1, 2), (2, 0)])


@exercise("15.13")
def test_two_tetrahedra_share_the_points_of_their_edges(impl):
    """Each has vertices of its own: the mesh falls apart into triangles."""
    points = np.array([*CORNERS, [1.0, 1.0, 1.0]])
    tetrahedra = np.array([[0, 1, 2, 3], [4, 2, 1, 3]])
    distance = np.array([1.0, 2.0, 1.0, -2.0, 2.0])
    vertices, faces, ends = impl.marching_tetrahedra(points, distance, tetrahedra)
    assert_equal(ends, np.array([[3, 0], [3, 1], [3, 2], [3, 4]]))
    expected = points[3] + np.array([2 / 3, 0.5, 2 / 3, 0.5])[:, None] * (points[[0, 1, 2, 4]]
                                                                         - points[3])
    assert_close(vertices, expected)
    assert_equal(sorted(directed_edges(faces)), [(0, 2), (1, 0), (1, 2), (2, 1), (2, 3), (3, 1)])


@exercise("15.13", fine_print=True)
def test_zero_is_outside_and_nothing_is_no_surface(impl):
    """<= for <; or an empty mesh is an error, or its shapes are others."""
    tetrahedra = np.array([[0, 1, 2, 3]])
    vertices, faces, ends = impl.marching_tetrahedra(CORNERS, np.array([-1.0, 0, 0, 2]), tetrahedra)
    assert_equal(ends, np.array([[0, 1], [0, 2], [0, 3]]))
    assert_close(vertices, np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1 / 3]]))
    for distance in np.array([0.0, 1.0, 2.0, 3.0]), np.full(4, -1.0):
        vertices, faces, ends = impl.marching_tetrahedra(CORNERS, distance, tetrahedra)
        assert_equal((vertices.shape, faces.shape, ends.shape), ((0, 3), (0, 3), (0, 2)))


@exercise("15.13")
def test_vertices_are_the_crossed_edges_of_the_grid_each_once(impl, rng):
    """Twice, or in the order of tetrahedra; or the ends are sorted by their numbers."""
    points, tetrahedra = random_tetrahedra(rng)
    distance = random_field(rng, points)
    vertices, _, ends = impl.marching_tetrahedra(points, distance, tetrahedra)
    expected = np.array(crossed_edges(distance, tetrahedra))
    assert_equal(ends, expected)
    s = distance[expected]
    share = s[:, :1] / (s[:, :1] - s[:, 1:])
    a, b = points[expected[:, 0]], points[expected[:, 1]]
    assert_close(vertices, a + share * (b - a))


@exercise("15.13")
def test_random_fields_give_closed_and_consistently_wound_surfaces(impl, rng):
    """A case is left out, doubled, or wound against its neighbours."""
    for count in 12, 40, 90:
        points, tetrahedra = random_tetrahedra(rng, count)
        distance = random_field(rng, points)
        vertices, faces, _ = impl.marching_tetrahedra(points, distance, tetrahedra)
        edges = directed_edges(faces)
        assert_equal(len(set(edges)), len(edges))
        assert_equal(sorted(edges), sorted((b, a) for a, b in edges))
        assert_equal(sorted(set(np.ravel(faces).tolist())), list(range(len(vertices))))


@exercise("15.13")
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


@exercise("15.13", fine_print=True)
def test_many_points_do_not_get_mixed_up(impl):
    """Numbers of edges overflow, or collide, where the grid is large: 70,000 points."""
    points = np.arange(210_000.0).reshape(-1, 3) % 7
    tetrahedra = np.array([[69_999, 69_998, 3, 2], [1, 0, 69_997, 4]])
    distance = np.ones(70_000)
    distance[[69_999, 1]] = -1.0
    _, faces, ends = impl.marching_tetrahedra(points, distance, tetrahedra)
    assert_equal(ends, np.array([[1, 0], [1, 4], [1, 69_997], [69_999, 2], [69_999, 3],
                                 [69_999, 69_998]]))
    assert_equal(sorted(map(sorted, faces.tolist())), [[0, 1, 2], [3, 4, 5]])


@exercise("15.13", fine_print=True)
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
