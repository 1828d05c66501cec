"""What the exercises of lab 8 must do."""
import itertools

import edges_in_space
import numpy as np
import pytest
from edges_in_space import EDGES

from course.given import mesh
from labkit.checks import assert_close, assert_equal, exercise

TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
FOURTH = np.repeat(6 - TETRAHEDRON.sum(1)[:, None], 3, 1)  # the vertex across each of its edges


# --- topology ----------------------------------------------------------------------------------

@exercise("8.1")
def test_two_faces_see_each_other_across_their_edge(impl):
    """The corner across is the face's own corner k, or the vertex or the face there. Edge k starts
    at vertex k. An edge is known from a to b alone, or with its first or last face alone. A
    boundary is not -1."""
    faces = np.array([[0, 1, 2], [3, 2, 1], [4, 2, 3], [1, 5, 3]])  # all wound alike
    assert_equal(impl.opposite_corners(faces), [[3, -1, -1], [0, 10, 6], [5, -1, -1], [-1, 4, -1]])


@exercise("8.1")
def test_in_a_tetrahedron_every_edge_has_a_corner_across(impl):
    """An edge from a to b is not found from b to a, or a closed surface has a boundary."""
    assert_equal(impl.opposite_corners(TETRAHEDRON), edges_in_space.opposite_corners(TETRAHEDRON))


@exercise("8.1")
def test_the_winding_does_not_matter(impl):
    """The edge is looked up in reverse order only: neighbours that are wound the other way, and run
    along the edge in the same direction, are not found."""
    faces = np.array([[0, 1, 2], [0, 1, 3], [3, 1, 4]])  # the first one is turned over
    assert_equal(impl.opposite_corners(faces), [[-1, -1, 5], [8, -1, 2], [-1, -1, 3]])
    assert_equal(impl.opposite_corners(np.array([[5, 0, 7], [7, 5, 2]])),
                 [[-1, 5, -1], [-1, -1, 1]])


@exercise("8.1")
def test_a_single_face_has_three_boundary_edges(impl):
    """A boundary is not -1; or no faces at all are an error."""
    assert_equal(impl.opposite_corners(np.array([[4, 2, 9]])), np.full((1, 3), -1))
    assert_equal(impl.opposite_corners(np.zeros((0, 3), int)), np.zeros((0, 3), int))


@exercise("8.1")
def test_a_surface_with_holes_is_that_of_a_search(impl, rng):
    """Vertices must be numbered in some order, or a corner across belongs to another edge."""
    _, faces = mesh.icosphere(20)
    faces = rng.permutation(30)[:12][faces[rng.permutation(20)[:14]]]
    assert_equal(impl.opposite_corners(faces), edges_in_space.opposite_corners(faces))


@exercise("8.1", fine_print=True)
def test_of_three_faces_at_an_edge_the_first_two_count(impl):
    """The last two count, or the third one is given the first one's corner."""
    faces = np.array([[0, 1, 7], [1, 0, 3], [0, 1, 5]])
    assert_equal(impl.opposite_corners(faces)[:, 2], [5, 2, -1])


@exercise("8.1", fine_print=True)
def test_a_face_that_comes_twice_is_no_neighbour_of_itself(impl):
    """The second copy takes the place of the true neighbour, or gets -1: it has the same neighbour
    as the first. Or a face is across from itself.
    """
    faces = np.array([[0, 1, 2], [1, 2, 0], [1, 0, 3]])
    assert_equal(impl.opposite_corners(faces), [[-1, -1, 8], [-1, 8, -1], [-1, -1, 2]])


@exercise("8.1", fine_print=True)
def test_faces_that_name_a_vertex_twice_do_not_count(impl):
    """A face without area stands between two others."""
    faces = np.array([[0, 0, 1], [0, 1, 2], [1, 0, 3], [4, 1, 4], [5, 5, 5]])
    assert_equal(impl.opposite_corners(faces),
                 [[-1, -1, -1], [-1, -1, 8], [-1, -1, 5], [-1, -1, -1], [-1, -1, -1]])


@exercise("8.1", fine_print=True)
@pytest.mark.parametrize("vertex_count", [4, 9, 40])
def test_topology_is_that_of_a_search(impl, rng, vertex_count):
    """Meshes with many faces at an edge, repeated and degenerate faces, and loose ones."""
    faces = rng.integers(0, vertex_count, (40, 3))
    assert_equal(impl.opposite_corners(faces), edges_in_space.opposite_corners(faces))


@exercise("8.1", fine_print=True)
def test_large_meshes_and_large_numbers(impl):
    """Two edges get one key, as with low * 1000 + high; or every pair of faces is compared."""
    n = 10_000
    low = 3 * np.arange(n) + 1_000_000
    strip = np.concatenate([np.stack([low, low + 1, low + 2], 1),
                            np.stack([low + 2, low + 1, low + 3_000_000], 1)])
    expected = np.full((2 * n, 3), -1)
    expected[:n, 0], expected[n:, 2] = 3 * (n + np.arange(n)) + 2, 3 * np.arange(n)
    assert_equal(impl.opposite_corners(strip), expected)


@exercise("8.1", fine_print=True)
def test_small_integers_do_not_overflow(impl):
    """Keys of edges are computed in the faces' own 32 or 8 bits, and wrap around."""
    k = np.arange(60_000)
    strip = np.stack([k, k + 1, k + 2], 1)
    expected = np.stack([np.append(3 * k[1:] + 2, -1), np.full(len(k), -1),
                         np.append(-1, 3 * k[:-1])], 1)
    assert_equal(impl.opposite_corners(strip.astype(np.int32)), expected)
    expected[199] = -1, -1, 3 * 198
    assert_equal(impl.opposite_corners(strip[:200].astype(np.uint8)), expected[:200])


# --- silhouettes -------------------------------------------------------------------------------

SQUARE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])
HALVES, ACROSS = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[-1, 3, -1], [-1, -1, 1]])
BESIDE = np.vstack([SQUARE, [3.0, -2.0]])  # the last vertex, which -1 must not stand for
FOLDED = np.vstack([SQUARE[:3], [1.5, 0.2]])  # over the diagonal, to the side of vertex 1
FLAT, FOLD = np.array([[True, False, True], [True, True, False]]), np.ones((2, 3), bool)


@exercise("8.2")
def test_a_flat_surface_has_its_border_as_its_silhouette(impl):
    """The test is reversed, so that an edge between two sides counts as a fold. Or the border is no
    silhouette: where opposite is -1, NumPy takes the last vertex. Or edge k starts at vertex k."""
    assert_equal(impl.silhouette_edges(*BESIDE.T, np.ones(5), HALVES, ACROSS), FLAT)


@exercise("8.2")
def test_a_surface_seen_from_behind_is_no_fold(impl):
    """Right for counter-clockwise faces alone: the side of the vertex across is not compared with
    the side of the face's own vertex k."""
    got = [impl.silhouette_edges(*points.T[::-1], np.ones(4), HALVES, ACROSS)
           for points in (SQUARE, FOLDED)]
    assert_equal(np.array(got), [FLAT, FOLD])


@exercise("8.2")
def test_a_fold_is_a_silhouette_of_both_its_faces(impl):
    """Folds are not looked at, only the border. Or only faces without a common edge are thought to
    hide each other."""
    assert_equal(impl.silhouette_edges(*FOLDED.T, np.ones(4), HALVES, ACROSS), FOLD)


@exercise("8.2")
def test_each_edge_has_its_own_vertex_across(impl):
    """Edge k is taken for edge k + 1, which joins other vertices, or one vertex across stands for
    all three."""
    x, y = np.array([0.0, 4.0, 0.0, 3.0, -2.0, 1.0]), np.array([0.0, 0.0, 4.0, 3.0, 1.0, 1.0])
    faces = np.array([[0, 1, 2], [1, 2, 0], [2, 0, 1]])
    # Vertex 3 lies beyond edge (1, 2), 4 beyond (2, 0), and 5 inside of the face.
    opposite = np.array([[3, 4, 5], [4, 5, 3], [5, 3, 4]])
    expected = [[False, False, True], [False, True, False], [True, False, False]]
    assert_equal(impl.silhouette_edges(x, y, np.ones(6), faces, opposite), expected)


@exercise("8.2", fine_print=True)
def test_behind_the_camera_an_area_has_the_other_sign(impl):
    """w is ignored: a vertex behind the camera (w < 0) is mirrored on screen, one of the face
    itself or one across an edge."""
    for behind, turned in ([3], True), ([1], True), ([0], False), ([1, 3], False), ([0, 3], True):
        w = np.ones(4)
        w[behind] = -3.0  # one of the two triangles is turned over, or both are
        assert_equal(impl.silhouette_edges(*SQUARE.T, w, HALVES, ACROSS), FOLD if turned else FLAT)
        assert_equal(impl.silhouette_edges(*FOLDED.T, w, HALVES, ACROSS), FLAT if turned else FOLD)


@exercise("8.2")
def test_neither_size_nor_distance_matters(impl):
    """A threshold for areas or for w: what is small, or near the camera, is lost."""
    for size, w in (1e-6, np.ones(4)), (1e4, np.array([1e-9, 1.0, 1e-9, 5.0])):
        for turned in slice(None), slice(None, None, -1):
            for points, expected in (SQUARE, FLAT), (FOLDED, FOLD):
                x, y = size * points.T[turned]
                assert_equal(impl.silhouette_edges(x, y, w, HALVES, ACROSS), expected)


@exercise("8.2", fine_print=True)
def test_just_behind_the_camera_is_behind(impl):
    """A threshold for w: a vertex just behind the camera counts as in front of it."""
    w = np.array([1.0, 1.0, 1.0, -1e-9])
    assert_equal(impl.silhouette_edges(*SQUARE.T, w, HALVES, ACROSS), FOLD)


@exercise("8.2", fine_print=True)
def test_an_area_of_zero_counts_as_positive(impl):
    """A triangle without area, seen edge-on, counts as clockwise, by <= 0 for < 0, or is always a
    fold or never one, by the product of both areas. Or its sign depends on w."""
    x = np.array([0.0, 2.0, 0.0, 1.0, 0.0, 1.0, 0.0, 2.0])
    y = np.array([0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -1.0])  # 3 on edge (0, 1), 7 on line (5, 6)
    w = np.array([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, -1.0])
    faces = np.array([[0, 1, 2], [1, 0, 2], [2, 0, 1], [0, 2, 1],
                      [0, 1, 3],    # has no area itself
                      [4, 5, 6]])   # the vertex across is behind the camera
    opposite = np.array([[-1, -1, 3], [-1, -1, 3], [3, -1, -1], [-1, 3, -1],
                         [2, 2, 2], [7, -1, -1]])
    expected = [[True, True, True], [True, True, False], [True, True, True],
                [True, False, True], [False, False, True], [True, True, True]]
    assert_equal(impl.silhouette_edges(x, y, w, faces, opposite), expected)


@exercise("8.2")
def test_both_faces_at_an_edge_agree_on_the_silhouette(impl, rng):
    """The area across is measured from another edge; or the number of faces is taken for V."""
    points = rng.normal(size=(2, 50, 4))
    for x, y in points.transpose(1, 0, 2):
        got = impl.silhouette_edges(x, y, np.full(4, 2.0), TETRAHEDRON, FOURTH)
        edges = {}
        for f, k in itertools.product(range(4), range(3)):
            ends = tuple(sorted(TETRAHEDRON[f, list(EDGES[k])]))
            edges.setdefault(ends, []).append(bool(got[f, k]))
        # Of four points, the hull has three edges or four; one on it has the rest on one side.
        for (a, b), both in edges.items():
            c, d = {0, 1, 2, 3} - {a, b}
            sides = [(x[b] - x[a]) * (y[p] - y[a]) - (x[p] - x[a]) * (y[b] - y[a]) for p in (c, d)]
            assert_equal(both, [sides[0] * sides[1] > 0] * 2, given=f"x={x}, y={y}, edge {a} {b}")


@exercise("8.2")
def test_the_unit_of_w_does_not_matter(impl):
    """w < 1 is taken for behind the camera; only its sign counts."""
    x, y = np.array([0.0, 1.0, 0.0, 2.0]), np.array([0.0, 0.0, 1.0, 2.0])
    faces, opposite = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[3, -1, -1], [-1, -1, 0]])
    for w in [0.5, 2.0, 0.5, 2.0], [2.0, 0.5, 2.0, 2.0], [0.01, 0.01, 3.0, 5.0]:
        got = impl.silhouette_edges(x, y, np.array(w), faces, opposite)
        assert_equal(got, [[False, True, True], [True, True, False]])


@exercise("8.2")
def test_w_moves_no_point_on_screen(impl):
    """x and y are multiplied by w, or divided by it: they are on screen already."""
    x, y = np.array([1.0, 3.0, 2.0, 2.0]), np.array([5.0, 5.0, 6.0, 4.0])
    faces, opposite = np.array([[0, 1, 2], [1, 0, 3]]), np.array([[-1, -1, 3], [-1, -1, 2]])
    expected = [[True, True, False], [True, True, False]]  # flat at edge (0, 1)
    for w in [1.0, 1.0, 1.0, 2.0], [1.0, 1.0, 1.0, 0.5], [1.0, 1.0, 2.0, 2.0], [2.0, 2.0, 1.0, 1.0]:
        assert_equal(impl.silhouette_edges(x, y, np.array(w), faces, opposite), expected)


# --- the frame of a pair -------------------------------------------------------------------------

FRAME = np.array([27, 27, 27, 27]), np.array([28, 26, 37, 17])  # row 2, column 7 of a width of 10
COLUMN = np.array([2, 2]), np.array([3, 1])  # of a width of 1


@exercise("8.3")
def test_the_frame_of_four_neighbours(impl):
    """The other's centre is not at x = 1 where it lies to the left or below, or not the owner's at
    0. Half a pixel is missing: the centre is not the corner. Rows and columns are swapped. Or x and
    y do not change places for pixels above each other."""
    screen_x = np.array([[8.5, 6.5, 7.5, 7.5], [7.5, 7.5, 7.5, 7.5]])
    screen_y = np.array([[2.5, 2.5, 3.5, 1.5], [2.5, 2.5, 2.5, 2.5]])
    x, y = impl.pair_frame(screen_x, screen_y, *FRAME, 10)
    assert_close((x, y), ([[1.0] * 4, [0.0] * 4], np.zeros((2, 4))))


@exercise("8.3")
def test_y_is_across_the_pair_and_never_mirrored(impl):
    """y is multiplied by s, too, and changes its sign with x: a rotation, a turn by 90 degrees, in
    place of the mirror and the swap."""
    screen_x, screen_y = np.full((1, 4), 9.0), np.full((1, 4), 2.75)  # 1.5 right, 0.25 above
    got = impl.pair_frame(screen_x, screen_y, *FRAME, 10)
    assert_close(got, ([[1.5, -1.5, 0.25, -0.25]], [[0.25, 0.25, 1.5, 1.5]]))


@exercise("8.3")
def test_in_a_picture_of_one_column_neighbours_lie_above(impl):
    """A difference of 1 is taken for a neighbour in the row."""
    got = impl.pair_frame(np.full((1, 2), 0.75), np.full((1, 2), 4.0), *COLUMN, 1)
    assert_close(got, ([[1.5, -1.5]], [[0.25, 0.25]]))


@exercise("8.3")
def test_many_points_for_each_pair(impl, rng):
    """Three points are taken for granted, or each pair gets all pairs' points."""
    owner, dx, dy = np.array([4, 7, 12, 16, 10]), [1, -1, 0, 0, 1], [0, 0, 1, -1, 0]
    other = owner + np.array(dx) + 6 * np.array(dy)
    points = rng.normal(size=(2, 4, 5)) * 9
    x, y = impl.pair_frame(*points, owner, other, 6)
    for n in range(5):
        right, up = points[0, :, n] - owner[n] % 6 - 0.5, points[1, :, n] - owner[n] // 6 - 0.5
        along, across = (dx[n] * right, up) if dx[n] else (dy[n] * up, right)
        assert_close((x[:, n], y[:, n]), (along, across))


# --- the crossing ------------------------------------------------------------------------------

@exercise("8.4")
def test_crossings_on_paper(impl):
    """The sign of the second term: + y0 for - y0. x0 is left out. The two ends are mixed up: x1
    goes with y0. The slope is upside down, dy / dx. x and y are swapped: the crossing with x = 0.
    It is clipped to the edge, or is the share of the way along it."""
    x0, y0 = np.array([1.0, 0.0, 3.0, 2.0, -2.0, 4.0]), np.array([-1.0, -1.0, 1.0, 4.0, -3.0, 2.0])
    x1, y1 = np.array([4.0, 1.0, 7.0, 5.0, 1.0, 6.0]), np.array([2.0, 3.0, -1.0, 1.0, -1.0, -6.0])
    expected = [2.0, 0.25, 5.0, 6.0, 2.5, 4.5]  # two of them beyond the ends
    assert_close(impl.crossing(x0, y0, x1, y1), expected)


@exercise("8.4")
def test_a_vertical_edge_crosses_at_its_x(impl):
    """A division by x1 - x0, which is 0; or an end on y = 0 is not the crossing."""
    x0, y0 = np.array([0.25, 1.0]), np.array([-4.0, 0.0])
    x1, y1 = np.array([0.25, 9.0]), np.array([2.0, 2.0])
    assert_close(impl.crossing(x0, y0, x1, y1), [0.25, 1.0])


@exercise("8.4")
def test_the_crossing_lies_on_the_line_and_on_the_axis(impl, rng):
    """The lecture's sign is lost in (x1 - x0) / (y1 - y0)."""
    x0, y0, x1, y1 = rng.normal(size=(4, 2, 30))
    c = impl.crossing(x0, y0, x1, y1)
    assert_close((x1 - x0) * (0 - y0) - (c - x0) * (y1 - y0), np.zeros((2, 30)), atol=1e-9)


def crossing_of_lines(x0, y0, x1, y1):
    return (x0 * y1 - x1 * y0) / (y1 - y0)


@exercise("8.4", fine_print=True)
def test_an_end_near_infinity_costs_no_digits(impl):
    """Always measured from end 0, even where that is the far end: x0 - y0 (x1 - x0) / (y1 - y0) is
    then a difference of huge numbers, and digits are lost."""
    near, far = [0.25, -1.0], [3e9, 4e9]
    for ends in near + far, far + near:
        got = impl.crossing(*np.array([ends]).T)
        assert_close(got, [0.25 + 2999999999.75 / 4000000001], rtol=1e-14)


@exercise("8.4", fine_print=True)
def test_the_nearer_end_is_found_on_either_side(impl):
    """y is compared instead of |y|: digits are lost where the far end lies below y = 0."""
    c = 0.3 - 0.1 * (3e12 - 0.3) / (1e12 - 0.1)
    for sign in 1, -1:
        near, far = [0.3, sign * 0.1], [3e12, sign * 1e12]
        for ends in near + far, far + near:
            assert_close(impl.crossing(*np.array([ends]).T), [c], rtol=1e-9, atol=1e-9)


@exercise("8.10")
def test_the_gradient_of_a_crossing_on_paper(impl):
    """grad_y0, grad_y1: the quotient rule is left out, as if the denominator y1 - y0 were constant.
    A sign is wrong, in grad_y0, or in grad_x1 and grad_y1, where r becomes -r for the other end.
    The two ends are swapped. grad_c is left out."""
    columns = np.array([[4.0, 0.5, -1.0, 0.5, 3.0],   # grad_c, x0, y0, x1, y1
                        [16.0, 1.0, -1.0, 5.0, 3.0],  # c = 2: a quarter of the way
                        [8.0, 2.0, 3.0, 4.0, -1.0],   # c = 3.5
                        [2.0, 2.0, 4.0, 5.0, 2.0],    # c = 8, beyond end 1
                        [50.0, 1.0, -2.0, -3.0, 3.0]]).T.copy()  # c = -0.6
    # A vertical edge, a quarter of it below: the upper end pulls by 1/4, the lower by 3/4.
    expected = np.array([[3.0, 0.0, 1.0, 0.0], [12.0, -12.0, 4.0, -4.0], [2.0, 1.0, 6.0, 3.0],
                         [-2.0, -3.0, 4.0, 6.0], [30.0, 24.0, 20.0, 16.0]]).T
    assert_close(np.stack(impl.crossing_backward(*columns)), expected)


@exercise("8.10")
def test_the_gradients_of_crossings_are_central_differences(impl, rng, gradcheck):
    """The edge's slope is taken as constant, or the sign of one of the four is wrong."""
    x0, x1 = rng.normal(size=(2, 3, 8))
    y0, length = rng.normal(size=(3, 8)), rng.uniform(0.5, 3, (3, 8)) * rng.choice([-1, 1], (3, 8))
    gradcheck(crossing_of_lines, impl.crossing_backward, (x0, y0, x1, y0 + length), name="crossing")


def assert_ends_are_alike(impl, rng, *epsilon):
    """With the ends exchanged, impl.crossing_backward returns their gradients exchanged."""
    grad_c, x0, y0, x1, y1 = rng.normal(size=(5, 12))
    one = impl.crossing_backward(grad_c, x0, y0, x1, y1, *epsilon)
    swapped = impl.crossing_backward(grad_c, x1, y1, x0, y0, *epsilon)
    assert_close(np.stack(swapped), np.stack([*one[2:], *one[:2]]))


@exercise("8.10")
def test_the_two_ends_are_alike(impl, rng):
    """One end's gradient is another formula: exchanging the ends must exchange the gradients."""
    assert_ends_are_alike(impl, rng)


@exercise("8.10", fine_print=True)
def test_epsilon_makes_the_edge_longer(impl):
    """It is added to a negative length, or is ignored, or left out of c or of one of the four
    gradients."""
    for sign in 1.0, -1.0:  # with y upside down, the same edge: y's gradients change their sign
        arguments = np.repeat([[8.0], [1.0], [-sign], [4.0], [3 * sign]], 2, 1)
        expected = np.repeat([[3.0], [sign * -3.125], [1.0], [sign * 0.125]], 2, 1)
        assert_close(impl.crossing_backward(*arguments, epsilon=4.0), tuple(expected))


@exercise("8.10", fine_print=True)
def test_with_epsilon_the_two_ends_are_still_alike(impl, rng):
    """The sign of one end decides: edges with both ends on one side of y = 0 become shorter."""
    assert_ends_are_alike(impl, rng, 0.25)


@exercise("8.10")
def test_without_an_epsilon_there_is_none(impl):
    """Its default is not 0: the gradient is near, and never right."""
    got = impl.crossing_backward(1.0, 0.0, -0.001, 0.0, 0.001)
    assert_close(got, (0.5, 0.0, 0.5, 0.0))


def column(*points):
    """Points (x, y) of a face's corners -> x, y, each (3, 1)."""
    return np.array(points).T[..., None]


def assert_crossed(impl, corners, edge, c, w=None, **tolerance):
    """impl.last_crossing of faces with corners x, y (3, F) is at these edges and places."""
    x, y = corners
    found_edge, found_c = impl.last_crossing(x, y, np.ones(x.shape) if w is None else w)
    assert_equal(found_edge, edge)
    assert_close(found_c, c, **tolerance)


@exercise("8.5")
def test_the_line_leaves_a_face_by_its_farthest_edge(impl):
    """The least c counts, of the edge by which the line enters, or the first edge that crosses.
    Edges that do not cross y = 0 count, or only those with 0 <= c <= 1. Edge k is numbered from
    corner k to k + 1; it lies opposite to corner k."""
    x, y = column((-2.0, -1.0), (4.0, -1.0), (1.0, 2.0))  # edges 0 and 1 cross, at 3 and -1
    x, y = (np.hstack([np.roll(corner, turn, 0) for turn in range(3)]) for corner in (x, y))
    fourth = column((0.0, -2.0), (6.0, 1.0), (-3.0, 1.0))  # edges 1 and 2 cross, at -2 and 4
    x, y = np.hstack([x * np.array([1.0, 2.0, 3.0]), fourth[0]]), np.hstack([y, fourth[1]])
    assert_crossed(impl, (x, y), [0, 1, 2, 2], [3.0, 6.0, 9.0, 4.0])


@exercise("8.5")
def test_a_vertex_on_the_line_counts_as_above(impl):
    """> in place of >=: an edge that only touches the line crosses it, or one that ends there does
    not."""
    only_two = column((0.25, 0.0), (-1.0, -2.0), (-1.0, 2.0))  # edges 0 (at -1) and 2 (at 0.25)
    assert_crossed(impl, only_two, [2], [0.25])
    for first, second, last in (0.5, 2.0, 1), (2.0, 0.5, 2):  # a little below: edges 1 and 2 cross
        below = column((0.25, -1e-9), (-1.0, first), (-1.0, second))
        assert_crossed(impl, below, [last], [0.25], atol=1e-6)
    along = column((2.0, 0.0), (0.5, 0.0), (1.0, -1.0))  # edges 0 and 1 end on it, 2 lies on it
    assert_crossed(impl, along, [1], [2.0])


@exercise("8.5", fine_print=True)
def test_of_equal_crossings_the_first_edge_is_taken(impl):
    """>= in place of >: two edges meet in a vertex on the line."""
    meeting = column((1.0, 0.0), (0.0, -1.0), (2.0, -1.0))  # edges 1 and 2 meet at 1
    assert_crossed(impl, meeting, [1], [1.0])


@exercise("8.5", fine_print=True)
def test_edges_along_the_line_are_not_divided_by(impl):
    """A division by zero, which gives NaN, or takes -0 for less than 0."""
    corners = np.stack([column((0.0, 1.0), (1.0, 1.0), (0.5, 1.0)),
                        column((0.0, 0.0), (1.0, 0.0), (0.5, -1.0)),
                        column((0.25, -0.0), (-1.0, 0.5), (-1.0, 2.0)),  # no end below 0, nor is -0
                        column((0.0, 0.0), (1.0, 0.0), (2.0, 0.0))], 2)[..., 0]
    assert_crossed(impl, corners, np.zeros(4, int), [-np.inf, 1.0, -np.inf, -np.inf])


@exercise("8.5", fine_print=True)
def test_an_edge_that_crosses_at_infinity_does_not_count(impl):
    """w is ignored. Or >= 0 stands for > 0: the two ends have the same y, one of them behind the
    camera."""
    w = np.array([[1.0], [-1.0], [1.0]])  # edge 2 crosses at infinity, edge 0 at 0
    assert_crossed(impl, column((0.0, -1.0), (2.0, -1.0), (1.0, -0.5)), [0], [0.0], w)


def assert_searched(impl, corners, **tolerance):
    """corners (3, 3, F): of each corner w (x, y, 1)."""
    x, y, w = corners.swapaxes(0, 1)
    edge, c = zip(*map(edges_in_space.last_crossing, np.moveaxis(corners, -1, 0)), strict=True)
    assert_crossed(impl, (x / w, y / w), edge, np.array(c), w, **tolerance)


@exercise("8.5", fine_print=True)
def test_edges_to_behind_the_camera_cross_where_they_are_in_front(impl, rng):
    """w is ignored: an end behind the camera is mirrored, so the part of the edge on screen lies
    elsewhere. Or crossings behind the camera count."""
    assert_searched(impl, rng.normal(size=(3, 3, 200)), rtol=1e-6, atol=1e-6)


@exercise("8.5")
def test_last_crossings_are_those_of_a_search(impl, rng):
    """Columns are mixed up, or only crossings within the pair are looked at."""
    x, y = 3 * rng.normal(size=(2, 3, 60))
    y[:, ::3] = np.round(y[:, ::3]) + 0.5  # some edges along the line, none on it
    y[2] = -np.sign(y[0]) * np.abs(y[2])   # and each face is crossed
    assert_searched(impl, np.stack([x, y, np.ones((3, 60))], 1))


# --- the blend ---------------------------------------------------------------------------------

def colours():
    """(2, 3, 2), new for each call: a function that writes into it spoils no other check."""
    return np.array([[[0.0, 8.0], [1.0, 0.0], [4.0, 2.0]], [[2.0, 2.0], [6.0, 4.0], [0.0, 0.0]]])


def pairs_at(impl, owner, other, c):
    """Pairs of which the blend has all that it needs."""
    ends, rest = np.zeros((2, len(owner)), int), np.zeros((2, len(owner)))
    return impl.Pairs(np.array(owner, int), np.array(other, int), np.array(c, float), ends, rest,
                      rest, *ends)


def assert_changes(impl, pairs, changes, **tolerance):
    """impl.blend_pairs of owner, other, c gives these pixels new colours, and no others."""
    expected = colours()
    for pixel, colour in changes.items():
        expected[pixel] = colour
    assert_close(impl.blend_pairs(colours(), pairs_at(impl, *pairs)), expected, **tolerance)


@exercise("8.9")
def test_the_owner_moves_towards_the_other(impl):
    """c is taken for alpha, or c - 1/2 or 1 - c: it is 1/2 - c. The owner moves away from the
    other, or the wrong one of the two moves, or both do. The change replaces the colour, to which
    it must be added."""
    # 1/4 of the way from (0, 8) to (1, 0), and half of the way from (4, 2) to (0, 0)
    assert_changes(impl, ([0, 2], [1, 5], [0.25, 0.0]), {(0, 0): (0.25, 6.0), (0, 2): (2.0, 1.0)})


@exercise("8.9")
def test_where_alpha_is_negative_the_other_moves_towards_the_owner(impl):
    """Only the owner moves. The other moves away from the owner: the sign of alpha is lost."""
    # half of the way from (0, 0) to (6, 4), and 1/4 of the way from (1, 0) to (0, 8)
    assert_changes(impl, ([4, 0], [5, 1], [1.0, 0.75]), {(1, 2): (3.0, 2.0), (0, 1): (0.75, 2.0)})


@exercise("8.9")
def test_pairs_may_point_to_any_side(impl):
    """The owner is taken for the left or lower pixel."""
    # half of the way from (4, 2) to (1, 0), and 1/4 of the way from (0, 8) to (2, 2)
    changes = {(0, 2): (2.5, 1.0), (0, 0): (0.5, 6.5)}
    assert_changes(impl, ([2, 3], [1, 0], [0.0, 0.75]), changes)


@exercise("8.9")
def test_changes_of_one_pixel_add_up(impl):
    """A pixel in several pairs keeps one change alone, as += does, where np.add.at adds them all.
    Or a pair reads what another one has written."""
    pairs = [4, 4, 4, 1], [1, 3, 5, 4], [0.0, 0.25, 0.375, 0.625]
    assert_changes(impl, pairs, {(1, 1): (6 + 0.5 * -5 + 0.25 * -4 + 0.125 * -6 - 0.125 * 5,
                                          4 + 0.5 * -4 + 0.25 * -2 + 0.125 * -4 - 0.125 * 4)})


@exercise("8.9")
def test_without_weight_or_pairs_nothing_changes(impl):
    """An error without pairs, or alpha = 0 is taken for 1/2."""
    assert_changes(impl, ([], [], []), {})
    assert_changes(impl, ([1], [4], [0.5]), {})


@exercise("8.9")
def test_the_sign_of_the_smallest_weight_decides(impl):
    """A threshold: a weight of little less than 0 changes the owner."""
    alpha = 2.0**-27  # c has it to the last bit
    assert_changes(impl, ([0], [1], [0.5 + alpha]), {(0, 1): (1 - alpha, 8 * alpha)}, rtol=0)


def many_pairs(rng, count=40, height=4, width=5):
    """owner, other, c (N,) of neighbours, each pixel in several pairs."""
    owner = rng.integers(0, height * width, count)
    step = rng.choice([1, -1, width, -width], count)
    return owner, (owner + step) % (height * width), rng.uniform(0, 1, count)


def blended(colour, owner, other, c):
    """Eqs. (4) and (5), pair by pair."""
    output = colour.copy().reshape(-1, colour.shape[2])
    before = output.copy()
    for p, q, crossed in zip(owner, other, c, strict=True):
        target = p if crossed < 0.5 else q
        output[target] += (0.5 - min(max(crossed, 0), 1)) * (before[q] - before[p])
    return output.reshape(colour.shape)


@exercise("8.9")
def test_a_blend_is_the_sum_over_its_pairs(impl, rng):
    """Pictures that are not square, or of one channel."""
    for channels in 1, 3:
        pairs = many_pairs(rng)
        colour = rng.normal(size=(4, 5, channels))
        assert_close(impl.blend_pairs(colour, pairs_at(impl, *pairs)), blended(colour, *pairs))


@exercise("8.9", fine_print=True)
def test_a_pixel_gives_away_at_most_half_of_its_colour(impl):
    """c is not clipped: outside of [0, 1] it counts as 0 or 1."""
    changes = {(0, 0): (0.5, 4.0), (1, 2): (3.0, 2.0)}
    assert_changes(impl, ([0, 4], [1, 5], [-0.06, 1.05]), changes)


@exercise("8.9", fine_print=True)
def test_colours_of_integers_are_blended_like_others(impl):
    """The output takes the colours' type, and what is added is cut to whole numbers."""
    output = impl.blend_pairs(np.array([[[0], [1]]]), pairs_at(impl, [0], [1], [0.25]))
    assert_close(output, [[[0.25], [1.0]]])


def colours_backward(impl, grad_output, colour, owner, other, c):
    """grad_colour of impl.blend_pairs_backward, for pairs without edges."""
    count = len(owner)
    pairs = pairs_at(impl, owner, other, c)._replace(y=np.repeat([[-1.0], [1.0]], count, 1))
    return impl.blend_pairs_backward(grad_output, colour, pairs, np.ones((3, 4)))[0]


@exercise("8.11")
def test_the_gradients_of_colours_on_paper(impl):
    """grad_colour: the share of the other pixel is left out, a sign is wrong, or the pixel's own
    gradient is lost. The owner's gradient is always used, even where alpha < 0 and the other pixel
    changes, or that of the pixel that stays."""
    colour = np.array([[[0.0, 8.0], [1.0, 0.0], [4.0, 2.0], [2.0, 3.0]],
                       [[2.0, 2.0], [6.0, 4.0], [0.0, 1.0], [5.0, 3.0]]])
    grad_output = np.array([[[1.0, 2.0], [100.0, 200.0], [8.0, 4.0], [3.0, 5.0]],
                            [[40.0, 20.0], [12.0, 16.0], [5.0, 9.0], [16.0, 24.0]]])
    c = 0.25, 1.0, 0.75, 0.375  # 0, 2, 5 and 7 change
    expected = [[[0.75, 1.5], [100.25, 200.5], [4.0, 2.0], [7.0, 7.0]],
                [[43.0, 24.0], [9.0, 12.0], [7.0, 12.0], [14.0, 21.0]]]
    got = colours_backward(impl, grad_output, colour, [0, 3, 4, 7], [1, 2, 5, 6], c)
    assert_close(got, expected)


@exercise("8.11")
def test_a_pixel_in_several_pairs_gets_the_gradients_of_all(impl, rng, gradcheck):
    """A pixel in several pairs gets the gradient of one of them, as += does, where np.add.at adds
    them all. A pair reads what another one has changed."""
    pairs = many_pairs(rng)
    gradcheck(lambda colour: blended(colour, *pairs),
              lambda grad, colour: colours_backward(impl, grad, colour, *pairs),
              (rng.normal(size=(4, 5, 3)),), name="blend_pairs")


EDGE = (0.0, -1.0), (1.0, 3.0)       # x, y of both ends in a pair's frame: c = 0.25
BY_ENDS = (0.75, -0.1875), (0.25, -0.0625)  # dc/dx, dc/dy of each
FOUR = np.array([0, 1, 3, 2]), np.array([1, 3, 2, 0])  # right, up, left and down in 2 x 2 pixels


def ends_backward(impl, colour, grad_output, n, edge=EDGE, **options):
    """grad_x, grad_y on screen of each end of an edge (2, 2), which pair n of FOUR blends."""
    (x0, y0), (x1, y1) = edge
    c = np.array([(x0 * y1 - x1 * y0) / (y1 - y0)])
    x, y, ends = np.array([[x0], [x1]]), np.array([[y0], [y1]]), np.array([[2], [0]])
    pairs = impl.Pairs(*(pixel[n:n + 1] for pixel in FOUR), c, ends, x, y, *np.zeros((2, 1), int))
    owner_x, owner_y = FOUR[0][n] % 2 + 0.5, FOUR[0][n] // 2 + 0.5
    dx, dy = ((1, 0), (0, 1), (-1, 0), (0, -1))[n]
    clip = np.ones((3, 4))  # in 2 x 2 pixels and with w = 1, clip space is the screen, moved by 1
    clip[[2, 0], 0] = owner_x + (dx * x + abs(dy) * y)[:, 0] - 1
    clip[[2, 0], 1] = owner_y + (dy * x + abs(dx) * y)[:, 0] - 1
    _, grad_clip = impl.blend_pairs_backward(np.array(grad_output, float).reshape(2, 2, -1),
                                             np.array(colour, float).reshape(2, 2, -1), pairs,
                                             clip, **options)
    assert_close(grad_clip[1], np.zeros(4))
    return grad_clip[[2, 0], :2]


@exercise("8.11")
def test_the_gradients_of_an_edge_s_ends_on_paper(impl):
    """dc/dalpha = -1 is left out. The difference of the colours has the wrong sign, or the channels
    are not summed. The ends are swapped. The quotient rule is left out of dc/dy."""
    colour, grad_output = [(1, 2), (3, 7), (0, 0), (0, 0)], [(8, 4), (100, 200), (0, 0), (0, 0)]
    got = ends_backward(impl, colour, grad_output, 0)  # grad_alpha = 8 (3 - 1) + 4 (7 - 2)
    assert_close(got, -36 * np.array(BY_ENDS))


@exercise("8.11")
def test_where_alpha_is_negative_the_other_pixel_pulls(impl):
    """The owner's gradient is taken everywhere, or the sign of alpha changes that of its
    gradient. Or there is a threshold for alpha."""
    grads = [ends_backward(impl, [1, 3, 0, 0], [8, 100, 0, 0], 0, ((x, -1.0), (x, 3.0)))
             for x in (0.75, 0.5 - 1e-9, 0.5 + 1e-9)]
    assert_close(np.array(grads)[..., 0], [[-150, -50], [-12, -4], [-150, -50]])


@exercise("8.11")
def test_a_clamped_crossing_has_no_gradient(impl):
    """alpha is one half, wherever the edge is, where c is not between 0 and 1."""
    grads = [ends_backward(impl, [1, 3, 0, 0], [8, 100, 0, 0], 0, ((x, -1.0), (x, 3.0)))
             for x in (-0.05, 0.0, 1.0, 1.05)]
    assert_close(np.array(grads), np.zeros((4, 2, 2)))


@exercise("8.11")
def test_gradients_turn_back_with_the_frame(impl):
    """The sign is lost where the other pixel lies to the left or below, or for pixels above each
    other it goes to the wrong one of x and y. Or x and y are not swapped back."""
    (a, b), (c, d) = -5 * np.array(BY_ENDS)  # in the frame
    for n, expected in enumerate(([(a, b), (c, d)], [(b, a), (d, c)],
                                  [(-a, b), (-c, d)], [(b, -a), (d, -c)])):
        colour, grad_output = np.zeros(4), np.zeros(4)
        colour[FOUR[1][n]], grad_output[FOUR[0][n]] = 1, 5
        assert_close(ends_backward(impl, colour, grad_output, n), expected, given=f"pair {n}")


@exercise("8.11")
def test_all_gradients_are_central_differences(impl, rng, gradcheck):
    """Width and height are swapped, or an edge's ends. A vertex keeps the gradient of one of its
    edges. w has none."""
    owner = np.array([7, 12, 17, 8, 7, 11, 2, 7])  # of a picture of 4 x 5
    other = np.array([8, 13, 18, 7, 12, 6, 7, 6])
    ends = np.array([[0, 0, 4, 4, 2, 6, 3, 1], [4, 4, 8, 0, 6, 2, 7, 5]])
    around = np.array([[2.8, 0.4], [2.3, 0.9], [1.8, 1.9], [2.9, 1.2], [2.9, 3.1], [2.1, 2.2],
                       [3.4, 1.8], [2.1, 1.1], [2.3, 4.2]])
    clip = np.column_stack([2 * around / [5, 4] - 1, np.zeros(9), np.ones(9)])
    clip *= rng.uniform(0.5, 2, (9, 1))

    def edges(clip):
        points = ((clip[:, :2] / clip[:, 3:] + 1) * [2.5, 2])[ends]
        right, up = (np.moveaxis(points, -1, 0) - np.stack([owner % 5, owner // 5])[:, None] - 0.5)
        dx, dy = other % 5 - owner % 5, other // 5 - owner // 5
        x, y = dx * right + dy * up, np.where(dx == 0, right, up)
        return x, y, crossing_of_lines(x[0], y[0], x[1], y[1])

    def backward(grad, colour, clip):
        x, y, c = edges(clip)
        pairs = impl.Pairs(owner, other, c, ends, x, y, *np.zeros((2, 8), int))
        return impl.blend_pairs_backward(grad, colour, pairs, clip)

    gradcheck(lambda colour, clip: blended(colour, owner, other, edges(clip)[2]), backward,
              (rng.normal(size=(4, 5, 2)), clip), name="blend_pairs",
              decisions=lambda colour, clip: edges(clip)[2] < 0.5)


@exercise("8.11", fine_print=True)
def test_at_zero_the_owner__s_side_counts(impl):
    """> in place of >=: at alpha = 0, the kink, the other pixel's side is taken and not the
    owner's."""
    got = ends_backward(impl, [1, 3, 0, 0], [8, 100, 0, 0], 0, ((0.5, -1.0), (0.5, 3.0)))
    assert_close(got[:, 0], [-12, -4])


@exercise("8.11", fine_print=True)
def test_a_pixel_gives_away_at_most_half_of_its_gradient(impl):
    """c is not clipped in the weights of the colours: outside of [0, 1] it counts as 0 or 1."""
    grad_output = np.arange(12.0).reshape(2, 3, 2)
    grads = [colours_backward(impl, grad_output, colours(), [0, 4], [1, 5], c)
             for c in ((-0.06, 1.05), (0.0, 1.0))]
    assert_close(grads[0], grads[1])


@exercise("8.11", fine_print=True)
def test_epsilon_reaches_the_crossing(impl):
    """It is ignored: c = (x0 y1 - x1 y0) r, r = 1 / (h + epsilon), keeps r finite."""
    got = ends_backward(impl, [0, 1, 0, 0], [8, 0, 0, 0], 0, ((0.25, -1.0), (0.25, 3.0)),
                        epsilon=4.0)
    assert_close(got, [[-3.0, 0.125], [-1.0, -0.125]])
