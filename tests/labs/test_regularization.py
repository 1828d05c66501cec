"""What the exercises of lab 13 must do: quality, Laplacians, smoothing, large steps."""
import fractions
import itertools
import math

import numpy as np
import subdivision_meshes
from regularization_graphs import angle, dense, graph

from course.given import mesh
from labkit.checks import assert_close, assert_equal, exercise

RIGHT = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]])
OBTUSE = np.array([[0.0, 2.0, 0.0], [2.0, 2.0, 0.0], [-1.0, 2.0, 1.0]])
EQUILATERAL = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, np.sqrt(3)]])
RING = np.array([[k, (k + 1) % 8] for k in range(8)])  # edges of a closed polygon


def triangles(rng, *shape):
    """Random triangles in space; none is nearly flat."""
    triangles = rng.normal(size=(*shape, 3, 3))
    triangles[..., 2, :] += 2 * np.cross(triangles[..., 0, :], triangles[..., 1, :])
    return triangles


# --- quality -----------------------------------------------------------------------------------

@exercise("13.1")
def test_angles_on_paper(impl):
    """Degrees. Another corner's angle, or the one outside. An obtuse angle: arcsin gives an acute
    one, arctan a negative one. arctan2's arguments are exchanged, or it has the area, not twice
    that. It is the cosine.
    """
    small, large = np.arctan2(3, 4), np.arctan2(4, 3)
    given = np.stack([RIGHT, OBTUSE, EQUILATERAL])[:, None]
    expected = [[[np.pi / 2, small, large]],
                [[3 * np.pi / 4, np.arctan2(1, 3), np.arctan2(1, 2)]], [[np.pi / 3] * 3]]
    assert_close(impl.corner_angles(given), expected)


@exercise("13.1")
def test_an_obtuse_angle_is_more_than_a_right_one(impl):
    """One triangle without leading axes; arcsin, which cannot tell 60 degrees from 120."""
    triangle = np.array([[-3.0, 1.0, 0.0], [0.0, 0.0, 0.0], [5.0, 0.0, 0.0]])
    at_1 = np.pi - np.arctan2(1, 3)
    at_2 = np.arctan2(1, 8)
    assert_close(impl.corner_angles(triangle), [np.pi - at_1 - at_2, at_1, at_2])


@exercise("13.1")
def test_angles_are_those_of_the_law_of_cosines(impl, rng):
    """Wrong in space: only x and y are looked at."""
    given = triangles(rng, 5, 2)
    expected = [[[angle(t[k], t[k - 1], t[k - 2]) for k in range(3)] for t in row] for row in given]
    assert_close(impl.corner_angles(given), np.array(expected), atol=1e-9)


@exercise("13.1", fine_print=True)
def test_tiny_angles_keep_their_digits(impl):
    """arccos: near 0 it loses half of the digits, and 1e-9 comes out as 0."""
    triangle = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1e-9]])
    assert_close(impl.corner_angles(triangle)[..., 0], np.arctan(1e-9), rtol=1e-9, atol=0)


def exact_angles(triangle):
    """The three angles of a triangle (3, 3), by fractions up to the last root and arctangent."""
    corners, found = [[fractions.Fraction(x) for x in corner] for corner in triangle.tolist()], []
    for k in range(3):
        p, q = ([x - y for x, y in zip(corners[k - end], corners[k], strict=True)]
                for end in (2, 1))
        dot = sum(x * y for x, y in zip(p, q, strict=True))
        square = sum(x * x for x in p) * sum(x * x for x in q) - dot * dot  # of the cross product
        found.append(math.atan2(math.sqrt(square), dot))
    return found


@exercise("13.1", fine_print=True)
def test_needles_keep_the_digits_of_their_tip_however_they_lie(impl, rng):
    """The cross product of the two long sides: a needle that is turned loses half of the digits."""
    needle = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1e-9, 0.0]])
    turns, places = np.linalg.qr(rng.normal(size=(20, 3, 3)))[0], rng.normal(size=(20, 1, 3))
    given = np.array([np.roll(corners, k, 0) for k, corners in enumerate(needle @ turns + places)])
    tips = np.arange(20) % 3
    got = impl.corner_angles(given)
    expected = np.array([exact_angles(triangle) for triangle in given])
    assert_close(got[np.arange(20), tips], expected[np.arange(20), tips], rtol=1e-9, atol=0)
    assert_close(got, expected, rtol=0, atol=1e-14)


@exercise("13.1", fine_print=True)
def test_every_angle_has_14_digits_after_the_point(impl, rng):
    """arccos in any triangle: of flat ones, too."""
    given = rng.normal(size=(30, 3, 3))
    given[:, 2] = given[:, 0] + np.geomspace(1e-12, 1, 30)[:, None] * given[:, 2]
    given[::2, 1] += given[::2, 2] - given[::2, 0]
    expected = [exact_angles(triangle) for triangle in given]
    assert_close(impl.corner_angles(given), expected, rtol=0, atol=1e-14)


@exercise("13.1", fine_print=True)
def test_angles_without_area(impl):
    """0/0 where two corners coincide; of three points on a line, the middle one has pi."""
    a, b, c = np.array([[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [3.0, 0.0, 1.0]])
    given = np.array([[a, b, c], [b, a, c], [a, a, b], [a, b, b], [a, a, a]])
    expected = np.zeros((5, 3))
    expected[0, 1] = expected[1, 0] = np.pi
    assert_close(impl.corner_angles(given), expected)


@exercise("13.2")
def test_radius_ratios_on_paper(impl):
    """The factor 2, the 4 of R, or R / r. `triangle_normals` is as long as twice the area. Half of
    the perimeter is taken for a + b + c. It is another measure, with squares.
    """
    # 3, 4, 5: r = 1 and R = 5/2. Half of an equilateral one, 1, sqrt 3, 2: r = (sqrt 3 - 1) / 2.
    # Half of a square, 2, 2, sqrt 8: r = 2 - sqrt 2 and R = sqrt 2.
    # 5, 12, 13: r = 2 and R = 13/2.
    half = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, np.sqrt(3)]])
    long = np.array([[2.0, 0.0, 0.0], [2.0, 5.0, 0.0], [2.0, 0.0, 12.0]])
    square = np.array([[1.0, 0.0, 1.0], [1.0, 2.0, 1.0], [1.0, 0.0, 3.0]])
    expected = [0.8, 1.0, np.sqrt(3) - 1, 2 * np.sqrt(2) - 2, 8 / 13]
    assert_close(impl.radius_ratio(np.stack([RIGHT, EQUILATERAL, half, square, long])), expected)
    assert_close(impl.radius_ratio(RIGHT[None, None]), [[0.8]])


@exercise("13.2")
def test_it_is_twice_the_ratio_of_the_radii(impl, rng):
    """Another measure that is also 1 for an equilateral triangle."""
    given, expected = triangles(rng, 20), []
    for a, b, c in given:
        # The centre a + s (b - a) + t (c - a) of the outer circle is as far from a as from b and c.
        u, v = b - a, c - a
        s, t = np.linalg.solve([[u @ u, u @ v], [u @ v, v @ v]], [u @ u / 2, v @ v / 2])
        outer = np.linalg.norm(s * u + t * v)
        # The centre of the inner circle is the mean of the corners, weighted by opposite sides.
        weights = [np.linalg.norm(b - c), np.linalg.norm(c - a), np.linalg.norm(a - b)]
        to_centre = np.average([a, b, c], axis=0, weights=weights) - a
        inner = np.linalg.norm(np.cross(u, to_centre)) / np.linalg.norm(u)
        expected.append(2 * inner / outer)
    assert_close(impl.radius_ratio(given), np.array(expected), rtol=1e-8)


@exercise("13.2")
def test_radius_ratio_has_no_unit(impl, rng):
    """An area that is not divided by one: large triangles seem better."""
    given = triangles(rng, 6)
    sizes = np.array([1e-6, 1e-3, 1.0, 10.0, 1e4, 1e8])[:, None, None]
    turned = np.roll(given * sizes, 1, axis=1)
    assert_close(impl.radius_ratio(turned), impl.radius_ratio(given))


@exercise("13.2", fine_print=True)
def test_radius_ratio_without_area(impl):
    """NaN, where two or three corners coincide."""
    a, b, c = np.array([[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [3.0, 0.0, 1.0]])
    given = np.array([[a, b, c], [a, a, b], [a, b, b], [b, a, b], [a, a, a]])
    assert_close(impl.radius_ratio(given), np.zeros(5))


# --- Laplacians --------------------------------------------------------------------------------

@exercise("13.3")
def test_cotangents_on_paper(impl):
    """Of another corner. Divided by the area, not by twice the area, or by both lengths: that is
    the cosine. Upside down, it is the tangent. An obtuse angle has a negative cotangent. Sides that
    go round have the other sign. Only x and y count.
    """
    acute = np.array([[0.0, 0.0, 2.0], [4.0, 0.0, 2.0], [1.0, 2.0, 2.0]])
    expected = [[0.5, 1.5, 0.125], [-1.0, 3.0, 2.0], [0.0, 4 / 3, 3 / 4], [1 / np.sqrt(3)] * 3]
    assert_close(impl.cotangents(np.stack([acute, OBTUSE, RIGHT, EQUILATERAL])), expected)


@exercise("13.3")
def test_cotangents_of_obtuse_angles_are_negative(impl, rng):
    """The sign is lost, or only x and y are looked at. One triangle has no leading axes."""
    obtuse = np.array([[-1.0, 0.0, 1.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    assert_close(impl.cotangents(obtuse)[1], -1.0)
    given = triangles(rng, 4, 3)
    expected = [[[1 / np.tan(angle(t[k], t[k - 1], t[k - 2])) for k in range(3)] for t in row]
                for row in given]
    assert_close(impl.cotangents(given), np.array(expected), rtol=1e-7, atol=1e-9)


@exercise("13.3", fine_print=True)
def test_cotangents_without_area(impl):
    """NaN or infinity, where corners coincide: it is divided by an area of 0."""
    a, b = np.array([[0.0, 1.0, 1.0], [2.0, 0.0, 1.0]])
    given = np.array([[a, a, b], [a, b, b], [b, a, b], [a, a, a]])
    assert_close(impl.cotangents(given), np.zeros((4, 3)))


@exercise("13.3", fine_print=True)
def test_a_triangle_is_flat_up_to_the_limit_and_not_beyond(impl):
    """NO_AREA is compared with something that has a unit; or with another side than the longest."""
    given, expected = [], []
    for size, turn in itertools.product((1e-5, 1.0, 1e4), range(3)):
        for height, flat in (0.95e-12, True), (0.03e-12, True), (0.0, True), (1.05e-12, False):
            triangle = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.25, 0.0, height]])
            given.append(size * np.roll(triangle, turn, 0))
            steep = np.zeros(3) if flat else np.array([0.25, 0.75, -0.1875]) / height
            expected.append(np.roll(steep, turn))
    assert_close(impl.cotangents(np.array(given)), np.array(expected), rtol=1e-3)


@exercise("13.6")
def test_gradients_of_cotangents_on_paper(impl):
    """The area is held fixed. Its part has the wrong sign, or a normal not of length 1, or only one
    cotangent. The corner itself, where both sides start, gets nothing. p and q, or corners, are
    exchanged. grad_cotangents is left out.
    """
    triangle = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    by_1 = np.array([[0.0, 1.25, 0.0], [0.5, -0.25, 0.0], [-0.5, -1.0, 0.0]])
    # The right angle closes by dy_1 / 4 and dx_2 / 2, and its cotangent grows by as much.
    by_0 = np.array([[-0.5, -0.25, 0.0], [0.0, 0.25, 0.0], [0.5, 0.0, 0.0]])
    got = impl.cotangents_backward(np.array([[0.0, 1.0, 0.0], [2.0, 0.0, 0.0]]),
                                   np.stack([triangle, triangle]))
    assert_close(got, np.stack([by_1, 2 * by_0]))
    assert_close(impl.cotangents_backward(np.array([1.0, 0.0, 0.0]), triangle), by_0)


@exercise("13.6")
def test_gradients_of_cotangents_are_central_differences(impl, rng, gradcheck):
    """A term is missing: that of the area, or that of one of the two sides at a corner."""
    def forward(triangles):
        p, q = np.roll(triangles, -1, -2) - triangles, np.roll(triangles, -2, -2) - triangles
        return (p * q).sum(-1) / np.linalg.norm(np.cross(p, q), axis=-1)

    gradcheck(forward, impl.cotangents_backward, (triangles(rng, 4, 2),), name="cotangents")


@exercise("13.6", fine_print=True)
def test_flat_triangles_have_no_gradient(impl, rng):
    """NaN, or a huge gradient, where the cotangents are set to 0."""
    a, b, c = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.5, 0.95e-12, 1.0]])
    given = np.array([[a, b, c], [a, a, b], [a, a, a]])
    assert_close(impl.cotangents_backward(rng.normal(size=(3, 3)), given), np.zeros((3, 3, 3)))
    sizes, upstream = np.array([1e-5, 1.0, 1e4]), np.tile([1.0, 0.0, 0.0], (3, 1))
    for turn in range(3):
        higher = np.roll([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1.05e-12, 0.0]], turn, 0)
        got = impl.cotangents_backward(np.roll(upstream, turn, 1), sizes[:, None, None] * higher)
        assert_close(got[:, (2 + turn) % 3, 1], -0.5 / 1.05e-12**2 / sizes, rtol=1e-2)
        lower = higher * [1.0, 0.9, 1.0]
        got = impl.cotangents_backward(np.roll(upstream, turn, 1), sizes[:, None, None] * lower)
        assert_close(got, np.zeros((3, 3, 3)))

TWO = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [1.0, 2.0, 0.0], [1.0, -4.0, 0.0]])
TWO_FACES = np.array([[0, 1, 2], [1, 0, 3]])  # cotangents 1/2, 3/2, 1/8 and 3/4, 1/4, 13/16


@exercise("13.4")
def test_an_edge_of_two_faces_has_half_of_both_cotangents(impl):
    """The half is missing, or the mean is that of all angles. One of the two faces is forgotten, as
    by += with repeated indices. The cotangent is that of another corner: it lies opposite.
    """
    edges, weights, _ = impl.cotangent_laplacian(TWO, TWO_FACES)
    assert_equal(edges[0], [0, 1])
    assert_close(weights[0], (1 / 8 + 13 / 16) / 2)


@exercise("13.4")
def test_an_edge_of_one_face_has_half_of_one_cotangent(impl, rng):
    """It is divided by the number of faces. Edges are in another order than `mesh.edges` has them.
    """
    given = TWO @ np.linalg.qr(rng.normal(size=(3, 3)))[0] * 3 + rng.normal(size=3)
    edges, weights, _ = impl.cotangent_laplacian(given, TWO_FACES)
    assert_equal(edges, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3]])
    assert_close(weights[1:], [3 / 4, 3 / 8, 1 / 4, 1 / 8])


@exercise("13.4")
def test_a_mass_is_a_third_of_the_area_around(impl, rng):
    """The area is that of the last face, or of twice the size, or a half of it. The thirds of a
    vertex's faces are averaged. It is a valence.
    """
    given = TWO @ np.linalg.qr(rng.normal(size=(3, 3)))[0] * 3 + rng.normal(size=3)
    *_, areas = impl.cotangent_laplacian(given, TWO_FACES)
    assert_close(areas, 9 * np.array([4.0, 4.0, 4 / 3, 8 / 3]))


@exercise("13.4")
def test_obtuse_angles_count_as_they_are(impl):
    """A negative cotangent is set to 0, or made positive: a weight may be negative."""
    flat = TWO * [1, 0.25, 1]
    _, weights, _ = impl.cotangent_laplacian(flat, TWO_FACES)
    cotangent_2, cotangent_3 = (-3 + 0.25) / 2, (-3 + 1.0) / 4
    assert_close(weights[0], (cotangent_2 + cotangent_3) / 2)


def slow_laplacian(vertices, faces):
    """The weights of the edges, sorted, and the areas, face by face."""
    weights, areas = {}, np.zeros(len(vertices))
    for face in faces.tolist():
        for k in range(3):
            corners = vertices[[face[k], face[k - 1], face[k - 2]]]
            edge = tuple(sorted((face[k - 1], face[k - 2])))
            weights[edge] = weights.get(edge, 0) + 0.5 / np.tan(angle(*corners))
            areas[face[k]] += np.linalg.norm(np.cross(*(corners[1:] - corners[0]))) / 6
    return np.array(sorted(weights)), np.array([weights[edge] for edge in sorted(weights)]), areas


@exercise("13.4")
def test_a_whole_mesh_has_the_weights_and_areas_of_its_faces(impl, rng):
    """A vertex of many faces keeps one of its thirds; it is right for two faces alone."""
    for vertices, faces in mesh.icosphere(80), mesh.grid(18):
        given = vertices + 0.1 * rng.normal(size=vertices.shape)
        assert_close(impl.cotangent_laplacian(given, faces), slow_laplacian(given, faces),
                     rtol=1e-7, atol=1e-9)


@exercise("13.4", fine_print=True)
def test_edges_of_three_faces_and_vertices_of_none(impl, rng):
    """Two faces are expected at each edge; the areas end at the last vertex that has a face."""
    vertices = rng.normal(size=(7, 3))
    faces = np.array([[0, 1, 2], [1, 0, 3], [0, 1, 5]])
    assert_close(impl.cotangent_laplacian(vertices, faces), slow_laplacian(vertices, faces),
                 rtol=1e-7, atol=1e-9)


@exercise("13.4", fine_print=True)
def test_a_face_without_area_counts_for_nothing(impl):
    """NaN or infinity, in the weights of a whole mesh."""
    _, weights, areas = impl.cotangent_laplacian(np.vstack([TWO, TWO[1]]),
                                                 np.vstack([TWO_FACES, [1, 4, 2]]))
    assert_close(weights, [15 / 32, 3 / 4, 3 / 8, 1 / 4, 1 / 8, 0.0, 0.0])
    assert_close(areas, [4.0, 4.0, 4 / 3, 8 / 3, 0.0])


def matrix(entries, vertex_count):
    return subdivision_meshes.dense(entries, (vertex_count, vertex_count))


CORNER = np.array([[0, 2], [2, 3], [0, 3]]), np.array([5.0, 0.5, 2.0])  # edges, weights
CORNER_MATRIX = np.array([[ 7.0, 0.0, -5.0, -2.0, 0.0],
                          [ 0.0, 0.0,  0.0,  0.0, 0.0],
                          [-5.0, 0.0,  5.5, -0.5, 0.0],
                          [-2.0, 0.0, -0.5,  2.5, 0.0],
                          [ 0.0, 0.0,  0.0,  0.0, 0.0]])


def apart(full):
    """A matrix beside its diagonal, with zeros on it, and the diagonal."""
    return full - np.diag(np.diag(full)), np.diag(full).copy()


@exercise("13.5")
def test_each_edge_stands_in_the_rows_of_both_ends(impl):
    """An edge is entered in one direction only, from i to j: the entry from j to i is missing, and
    L is not symmetric.
    """
    beside, _ = apart(matrix(impl.laplacian_entries(*CORNER, 5), 5))
    assert_equal(beside != 0, apart(CORNER_MATRIX)[0] != 0)


@exercise("13.5")
def test_beside_the_diagonal_are_the_negative_weights(impl):
    """The sign: the weights are negative here, and it is not -L. Rows are divided by their sums, as
    in M^-1 L, which gives the mean of the neighbours. The weights are left out or halved.
    """
    beside, _ = apart(matrix(impl.laplacian_entries(*CORNER, 5), 5))
    assert_close(beside, apart(CORNER_MATRIX)[0])


@exercise("13.5")
def test_the_diagonal_is_the_sum_of_the_weights_at_each_vertex(impl):
    """The diagonal is left out or negative. It is 1, or the valence, the number of edges. An edge
    counts at one end only, or twice. += adds once to a repeated index, np.add.at each time.
    """
    _, diagonal = apart(matrix(impl.laplacian_entries(*CORNER, 5), 5))
    assert_close(diagonal, np.diag(CORNER_MATRIX))


@exercise("13.5")
def test_its_rows_sum_to_zero(impl, rng):
    """An edge is lost or entered twice; the number of vertices is taken from the edges."""
    edges, _ = graph(rng, 6)
    weights = rng.permutation(len(edges)) / 4 + 0.5
    got = matrix(impl.laplacian_entries(edges, weights, 6), 6)
    assert_close(got, dense(edges, weights, 6))
    assert_close(got - got.T, np.zeros((6, 6)))
    assert_close(got.sum(1), np.zeros(6))


@exercise("13.7")
def test_gradients_of_the_energy_on_paper(impl):
    """L is applied once and not twice, or grad_x is not divided by the mass. The 2 of the square or
    grad_energy is missing. grad_weights is that of one end. grad_mass has the wrong sign, no
    square, or m in place of m^2.
    """
    x, edges = np.array([[1.0], [2.0], [6.0]]), np.array([[0, 1], [1, 2]])
    weights, mass = np.array([2.0, 3.0]), np.array([1.0, 2.0, 4.0])
    got = impl.laplacian_energy_backward(0.25, x, edges, weights, mass)
    # L x = (-2, -10, 12), so z = (-2, -5, 3), and L z = (6, -30, 24).
    assert_close(got, ([[3.0], [-15.0], [12.0]], [-1.5, 16.0], [-1.0, -6.25, -2.25]))


@exercise("13.7")
def test_gradients_of_the_energy_are_central_differences(impl, rng, gradcheck):
    """The gradient by the weights or by the mass; or channels are mixed up."""
    edges, weights = graph(rng)
    def backward(grad_energy, x, weights, mass):
        return impl.laplacian_energy_backward(float(grad_energy), x, edges, weights, mass)

    gradcheck(lambda x, weights, mass: ((dense(edges, weights, 7) @ x)**2 / mass[:, None]).sum(),
              backward, (rng.normal(size=(7, 2)), weights, rng.uniform(0.5, 2.0, 7)),
              name="laplacian_energy")


@exercise("13.7", fine_print=True)
def test_what_has_no_mass_has_no_part_in_the_gradient(impl):
    """0/0 where the mass is 0; or its neighbours' part is lost as well."""
    x, edges = np.array([[1.0], [2.0], [4.0]]), np.array([[0, 1], [1, 2]])
    got = impl.laplacian_energy_backward(1.0, x, edges, np.ones(2), np.array([0.0, 0.5, 0.0]))
    assert_close(got, ([[4.0], [-8.0], [4.0]], [-4.0, 8.0], [0.0, -4.0, 0.0]))


# --- smoothing ---------------------------------------------------------------------------------

@exercise("13.8")
def test_implicit_smoothing_on_paper(impl):
    """The mass is left out on the left, on the right, or on both sides. It multiplies L, or divides
    its columns, not its rows. The sign of L is wrong, or the step is left out. No system is solved:
    it is an explicit step, or a product. `spsolve` gives (V,) for one channel.
    """
    x, mass = np.array([[1.0], [7.0], [8.0], [2.0], [9.0]]), np.array([1.0, 2.0, 4.0, 12.0, 5.0])
    # Two pairs: their mass-weighted means stay, 5 and 7/2. Differences fall to a 4th and a 3rd.
    expected = [[4.0], [5.5], [5.0], [3.0], [9.0]]
    got = impl.smooth_implicit(x, np.array([[0, 1], [2, 3]]), np.array([1.0, 3.0]), mass, 2.0)
    assert_close(got, expected)


@exercise("13.8")
def test_implicit_smoothing_solves_the_system(impl, rng):
    """One channel, or several: `spsolve` returns (V,) for one. The mass is left out on one side."""
    edges, weights = graph(rng)
    mass = rng.uniform(0.1, 0.9, 7)
    system = np.diag(mass) + 0.7 * dense(edges, weights, 7)
    for channels in 1, 2, 3:
        x = rng.normal(size=(7, channels))
        expected = np.linalg.solve(system, mass[:, None] * x)
        assert_close(impl.smooth_implicit(x, edges, weights, mass, 0.7), expected)


@exercise("13.8", fine_print=True)
def test_what_has_no_mass_follows_its_edges_and_stays_without_one(impl, rng):
    """A system without an inverse. A mass of 0 is replaced, or its vertex is held, though it has
    edges.
    """
    edges, weights = graph(rng)
    x, mass = rng.normal(size=(7, 2)), rng.uniform(0.1, 0.9, 7)
    mass[[2, 6]] = 0.0
    system = np.diag(mass[:6]) + 14 * dense(edges, weights / 20, 7)[:6, :6]
    expected = np.append(np.linalg.solve(system, mass[:6, None] * x[:6]), x[6:], 0)
    assert_close(impl.smooth_implicit(x, edges, weights / 20, mass, 14.0), expected)


@exercise("13.8")
def test_a_huge_step_goes_to_the_centre_of_mass_and_no_farther(impl, rng):
    """The explicit step: beyond a small s it explodes."""
    x, mass = rng.normal(size=(8, 3)), rng.uniform(1, 2, 8)
    centre = np.average(x, axis=0, weights=mass)
    got = impl.smooth_implicit(x, RING, np.ones(8), mass, 1e9)
    assert_close(got, np.tile(centre, (8, 1)), rtol=1e-5, atol=1e-5)


# --- the volume --------------------------------------------------------------------------------

def slow_volume(vertices, faces):
    return sum(np.linalg.det(vertices[face]) for face in faces) / 6


@exercise("13.9")
def test_a_regular_body_keeps_its_shape_and_its_centre(impl, rng):
    """Only some vertices move, or they move towards the centre. The gradient is not summed up over
    a vertex's faces. It is scaled, so it is right for bodies around the origin alone.
    """
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    vertices = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    turn, place = np.linalg.qr(rng.normal(size=(3, 3)))[0], rng.normal(size=3)
    turn *= np.linalg.det(turn)
    got = impl.restore_volume(vertices @ turn + place, faces, 9.0)
    assert_close(got, 1.5 * vertices @ turn + place)


@exercise("13.9")
def test_the_volume_is_the_wanted_one(impl, rng):
    """One step alone, or a step that is too long: |gradient| is not squared, or a third is missing.
    The missing volume is that of the first step in all of them.
    """
    for wanted in 1.0, 3.0, 6.0:
        vertices, faces = mesh.icosphere(20)
        vertices = vertices * rng.uniform(0.8, 1.1, (12, 1)) + rng.normal(size=3)
        got = impl.restore_volume(vertices, faces, wanted)
        assert_close(slow_volume(got, faces), wanted, rtol=1e-9)


@exercise("13.9")
def test_each_step_goes_along_the_gradient(impl, rng):
    """Along the normals, or from the centre: the gradient is that of the volume, at each step anew.
    """
    vertices, faces = mesh.icosphere(20)
    vertices = vertices * rng.uniform(0.5, 1.2, (12, 1)) * [1, 1, 1.5]
    expected = vertices.copy()
    for _ in range(5):
        gradient = np.zeros((12, 3))
        for where in np.ndindex(12, 3):
            ahead, behind = expected.copy(), expected.copy()
            ahead[where] += 0.5
            behind[where] -= 0.5  # it is linear in each number alone
            gradient[where] = slow_volume(ahead, faces) - slow_volume(behind, faces)
        missing = 4.0 - slow_volume(expected, faces)
        expected = expected + missing / (gradient**2).sum() * gradient
    assert_close(impl.restore_volume(vertices, faces, 4.0), expected, rtol=1e-8)


# --- large steps -------------------------------------------------------------------------------

@exercise("13.13")
def test_a_large_step_on_paper(impl):
    """The step is made in x, not in u. x is taken for u, or u is returned. The gradient is not
    spread: grad_x is taken for grad_u. Or it is spread twice, or multiplied by (I + lambda L) and
    not by its inverse. lambda is left out.
    """
    x, grad_x, zero = np.array([[1.0], [4.0]]), np.array([[0.0], [3.0]]), np.zeros((2, 1))
    got = impl.large_step(x, grad_x, zero, zero, 1, 2.0, (np.array([[0, 1]]), np.array([2.0]), 0.5))
    # u = (-2, 7) and grad_u = (1, 2), so u becomes (-3, 5).
    mean, square = np.array([[0.1], [0.2]]), np.array([[0.001], [0.004]])
    assert_close(got, (np.array([[-1.0], [7.0]]) / 3, mean, square), rtol=1e-7)


@exercise("13.13")
def test_a_large_step_is_a_step_in_u(impl, rng):
    """mean and square are those of the gradients by x, or old ones. The number of the step, the
    rate or the weights are left out.
    """
    edges, weights = graph(rng)
    x, grad_x, mean = rng.normal(size=(3, 7, 3))
    square = rng.uniform(0.1, 2.0, (7, 3))
    system = np.eye(7) + 3.0 * dense(edges, weights, 7)
    grad_u = np.linalg.solve(system, grad_x)
    m, s = 0.9 * mean + 0.1 * grad_u, 0.999 * square + 0.001 * grad_u**2
    root = np.sqrt(s.max() / (1 - 0.999**5))
    u = system @ x - 0.2 * m / (1 - 0.9**5) / (root + 1e-8)
    got = impl.large_step(x, grad_x, mean, square, 5, 0.2, (edges, weights, 3.0))
    assert_close(got, (np.linalg.solve(system, u), m, s), rtol=1e-8)


@exercise("13.13")
def test_a_large_step_keeps_what_has_no_gradient(impl, rng):
    """x itself is smoothed: without a gradient it must stay."""
    edges, weights = graph(rng)
    x, zero = rng.normal(size=(7, 2)), np.zeros((7, 2))
    got = impl.large_step(x, zero, zero, zero, 1, 1.0, (edges, weights, 9.0))
    assert_close(got, (x, zero, zero))
