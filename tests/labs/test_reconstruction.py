"""What the exercises of lab 16 must do."""
import itertools

import numpy as np
import pytest

from course.given import mesh
from labkit.checks import assert_close, assert_equal, exercise

PI = np.pi
Y0, Y1, Y2, Y20, Y22 = (np.sqrt(k / PI) / 2 for k in (1, 3, 15, 5 / 4, 15 / 4))


def harmonics(n):
    """The nine polynomials, one direction (3,) at a time."""
    x, y, z = n
    return np.array([Y0, Y1 * y, Y1 * z, Y1 * x, Y2 * x * y, Y2 * y * z, Y20 * (3 * z * z - 1),
                     Y2 * x * z, Y22 * (x * x - y * y)])


# --- light and shading -------------------------------------------------------------------------

NORMALS = np.array([[2.0, 3.0, 5.0], [-1.0, 4.0, 6.0], [7.0, -2.0, 3.0], [4.0, 1.0, -2.0]])


@exercise("16.1")
def test_nine_numbers_stand_along_a_new_last_axis(impl):
    """The shape: numbers are stacked along the first axis, Y_0 is one number in place of one for
    each direction, or x, y and z are taken from the wrong axis.
    """
    assert_equal(impl.sh_basis(np.arange(24.0).reshape(2, 4, 3)).shape, (2, 4, 9))


@exercise("16.1")
def test_the_first_four_harmonics_on_paper(impl):
    """Y_0 is not C0. Y_1, Y_2, Y_3 are in the order x, y, z, which is to be y, z, x. They have a
    minus sign, as with the Condon-Shortley phase. The constants are left out or exchanged. Or n is
    normalised first.
    """
    got = impl.sh_basis(NORMALS.copy())[..., :4]
    expected = np.array([[1.0, 3, 5, 2], [1, 4, 6, -1], [1, -2, 3, 7], [1, 1, -2, 4]])
    assert_close(got, expected * [0.28209479177387814, *[0.4886025119029199] * 3])


@exercise("16.1")
def test_harmonics_of_products_on_paper(impl):
    """Y_4, Y_5 and Y_7: two of x y, y z and x z are exchanged, a sign is a minus, C2 is missing or
    another constant, or one of them is a sum.
    """
    expected = np.array([[6.0, 15, 10], [-4, 24, -6], [-14, -6, 21], [4, -2, -8]])
    assert_close(impl.sh_basis(NORMALS.copy())[..., [4, 5, 7]], 1.0925484305920792 * expected)


@exercise("16.1")
def test_harmonics_of_the_square_of_z_on_paper(impl):
    """Y_6: 3 z^2 - 1 has lost its - 1 or its 3, holds another axis, such as y, or a minus, or its
    constant is not C3.
    """
    got = impl.sh_basis(NORMALS.copy())[..., 6]
    assert_close(got, 0.31539156525252005 * np.array([74.0, 107, 26, 11]))


@exercise("16.1")
def test_harmonics_of_the_difference_of_squares_on_paper(impl):
    """Y_8: it is y^2 - x^2, with the wrong sign, or x^2 + y^2, or its constant is not C4, as where
    C2 stands for it.
    """
    got = impl.sh_basis(NORMALS.copy())[..., 8]
    assert_close(got, 0.5462742152960396 * np.array([-5.0, -15, 45, 15]))


@exercise("16.1")
def test_each_direction_of_any_array(impl, rng):
    """Right for a list of directions alone, and not for one or a grid. A length is divided out. Or
    x = 0 gives NaN.
    """
    normals = rng.normal(size=(2, 4, 3))
    normals[0, 1] = 0.0, 0.0, 1.0
    expected = np.array([[harmonics(n) for n in row] for row in normals])
    assert_close(impl.sh_basis(normals), expected)
    assert_close(impl.sh_basis(normals[1, 2]), expected[1, 2])


@exercise("16.1")
def test_harmonics_are_orthonormal_on_the_sphere(impl):
    """A constant is off: the integral of Y_j Y_k over all directions is 1 for j = k, else 0."""
    z, weights = np.polynomial.legendre.leggauss(4)  # exact, as are 8 even steps around z
    around = np.arange(8) * PI / 4
    points = np.array([[np.sqrt(1 - h * h) * np.cos(a), np.sqrt(1 - h * h) * np.sin(a), h]
                       for h in z for a in around])
    basis = impl.sh_basis(points)
    assert_close((basis * np.repeat(weights * PI / 4, 8)[:, None]).T @ basis, np.eye(9), atol=1e-9)


def slopes_at_2_3_5(impl, rows):
    """Where the gradient of one Y_k after the other is 10: (K, 3), and of the last one alone (3,).
    """
    n, grad_basis = np.array([2.0, 3.0, 5.0]), 10 * np.eye(9)[rows]
    return (impl.sh_basis_backward(grad_basis[-1], n),
            impl.sh_basis_backward(grad_basis, np.tile(n, (len(rows), 1))))


@exercise("16.2")
def test_slopes_of_the_first_four_harmonics_on_paper(impl):
    """Gradients of Y_1, Y_2, Y_3 go to x, y, z in place of y, z, x; C1 or grad_basis is missing; or
    the part along n is taken away, though n can move along itself.
    """
    one, each = slopes_at_2_3_5(impl, [0, 1, 2, 3])
    assert_close(each, 10 * np.array([[0, 0, 0], [0, Y1, 0], [0, 0, Y1], [Y1, 0, 0]]))
    assert_close(one, each[-1])


@exercise("16.2")
def test_slopes_of_products_on_paper(impl):
    """Y_4, Y_5 and Y_7: the product rule's other term is left out, two of the three products are
    exchanged, or the slope with respect to x is x itself.
    """
    one, each = slopes_at_2_3_5(impl, [4, 5, 7])
    assert_close(each, 10 * Y2 * np.array([[3.0, 2, 0], [0, 5, 3], [5, 0, 2]]))
    assert_close(one, each[-1])


@exercise("16.2")
def test_slopes_of_squares_on_paper(impl):
    """Y_6: z^2 has the slope 2 z, so 3 z^2 has 6 z; the 2 or the 3 is missing. Y_8: the minus sign
    of y^2 in x^2 - y^2 is missing, or a 2.
    """
    one, each = slopes_at_2_3_5(impl, [6, 8])
    assert_close(each, 10 * np.array([[0, 0, 30 * Y20], [4 * Y22, -6 * Y22, 0]]))
    assert_close(one, each[-1])


@exercise("16.2")
def test_gradients_of_harmonics_are_central_differences(impl, rng, gradcheck):
    """Directions are mixed, or taken for unit: the part along n is taken away, though n can move
    along itself.
    """
    gradcheck(lambda normals: np.array([[harmonics(n) for n in row] for row in normals]),
              impl.sh_basis_backward, (rng.normal(size=(3, 4, 3)),), name="sh_basis")


def lit_points():
    """grad_colour, albedo (4, 2), normals (4, 3), light (9, 2): what `shade_backward` takes.

    Only Y_0, Y_1, Y_2 and Y_3 have light: E is a + b y + c z + d x.
    """
    light = np.zeros((9, 2))
    light[:4] = np.array([[5, 2], [1, 0.5], [3, -1], [-2, 0.25]]) / [[Y0], [Y1], [Y1], [Y1]]
    normals = np.array([[1.0, 0, 0], [0.6, -0.8, 0], [0, 0.6, 0.8], [-0.8, 0, 0.6]])
    albedo = np.array([[0.5, 0.8], [0.25, 0.4], [0.125, 0.6], [0.375, 0.2]])
    return np.array([[10.0, 5], [-4, 20], [8, 3], [16, -30]]), albedo, normals, light


IRRADIANCE = np.array([[3.0, 2.25], [3.0, 1.75], [8.0, 1.5], [8.4, 1.2]])  # there, of eq. (1)


@exercise("16.3")
def test_gradients_of_the_albedo_on_paper(impl):
    """grad_albedo: E is left out, the albedo is multiplied in, though the product's other factor is
    E alone, or the colours are summed.
    """
    given = lit_points()
    assert_close(impl.shade_backward(*given)[0], given[0] * IRRADIANCE)


@exercise("16.3")
def test_gradients_of_the_normals_on_paper(impl):
    """grad_normals: the albedo is left out, or E is multiplied in. One colour alone reaches the
    normals, or a mean of the colours and not their sum. sh_basis_backward is left out. The part
    along n is taken away, which is eq. (4)'s.
    """
    # grad_colour * albedo is (5, 4), (-1, 8), (1, 1.8), (6, -6). E falls by 2 with x, and so on.
    expected = [[5 * -2 + 4 * 0.25, 5 * 1 + 4 * 0.5, 5 * 3 - 4 * 1],
                [-1 * -2 + 8 * 0.25, -1 * 1 + 8 * 0.5, -1 * 3 - 8 * 1],
                [1 * -2 + 1.8 * 0.25, 1 * 1 + 1.8 * 0.5, 1 * 3 - 1.8 * 1],
                [6 * -2 - 6 * 0.25, 6 * 1 - 6 * 0.5, 6 * 3 + 6 * 1]]
    assert_close(impl.shade_backward(*lit_points())[1], expected)


@exercise("16.3")
def test_gradients_of_the_light_on_paper(impl):
    """grad_light: the albedo or the harmonics Y are left out. It is a mean over the vertices and
    not their sum, or one vertex alone counts. The colours are summed. The factors A_k are applied.
    """
    # The sums of (5, 4), (-1, 8), (1, 1.8), (6, -6), each times 1, y, z, x: the first colour's
    # are 11, 0.8 + 0.6, 0.8 + 3.6 and 5 - 0.6 - 4.8.
    expected = np.array([[11.0, 7.8], [1.4, -5.32], [4.4, -2.16], [-0.4, 13.6]])
    got = impl.shade_backward(*lit_points())[2]
    assert_equal(got.shape, (9, 2))
    assert_close(got[:4], expected * [[Y0], [Y1], [Y1], [Y1]])


@exercise("16.3")
def test_gradients_of_shading_are_central_differences(impl, rng, gradcheck):
    """A gradient's points or colours are mixed, or light beyond the first four numbers is left out.
    """
    def forward(albedo, normals, light):
        return albedo * (np.array([harmonics(n) for n in normals]) @ light)

    given = rng.uniform(0, 1, (5, 2)), rng.normal(size=(5, 3)), rng.normal(size=(9, 2))
    gradcheck(forward, impl.shade_backward, given, name="shade")


@exercise("16.4")
def test_gradients_of_one_face_on_paper(impl):
    """The part along n, which only makes m longer, is not taken away, is added, or has m for n. It
    is not divided by |m|, or twice. A corner gets no gradient, such as a, another's, or the wrong
    sign. A face uses one corner's gradient, or a mean, and not the sum of three.
    """
    # b - a = (1, -2, 0), c - a = (1, 0, -1), m = (2, 1, 2), |m| = 3 at all three corners. Their
    # gradients add up to (27, 0, 0), of which (15, -6, -12) is across n: g = (5, -2, -4).
    vertices = np.array([[3.0, 1.0, 4.0], [4.0, -1.0, 4.0], [4.0, 1.0, 3.0]])
    grad = np.array([[20.0, 3.0, -1.0], [4.0, -5.0, 3.0], [3.0, 2.0, -2.0]])
    expected = [[10.0, 5, 10], [-2, -1, -2], [-8, -4, -8]]  # (b - c) x g, ...
    assert_close(impl.vertex_normals_backward(grad, vertices, np.array([[0, 1, 2]])), expected)


@exercise("16.4")
def test_gradients_of_two_faces_on_paper(impl):
    """A vertex in several faces counts once only: += with indices keeps the last face, which takes
    `scatter`. Or m is a sum of unit normals: faces are not weighted by their area.
    """
    # Both lie in the plane z = 0, with m = (0, 0, 8) and (0, 0, 20). So |m| is 8, 28, 28, 20, and
    # g is (1, 2) + (1, 2) + (1, 1) of one, (1, 2) + (1, 1) + (2, -1) of the other.
    vertices = np.array([[0.0, 0, 0], [4, 0, 0], [0, 2, 0], [6, 4, 0]])
    grad = np.array([[8.0, 16, 3], [28, 56, -5], [28, 28, 7], [40, -20, 2]])
    got = impl.vertex_normals_backward(grad, vertices, np.array([[0, 1, 2], [1, 3, 2]]))
    expected = np.zeros((4, 3))
    expected[:, 2] = 26.0, 4.0 - 6.0, 12.0 - 20.0, -16.0
    assert_close(got, expected)


@exercise("16.4", fine_print=True)
def test_a_vertex_of_no_face_stays_quiet(impl):
    """0 / 0; or what comes to it goes to others."""
    vertices = np.array([[0.0, 0, 0], [1.0, 0, 0], [5.0, 5.0, 5.0], [0.0, 1.0, 0], [0.0, 0, 1.0]])
    grad = np.zeros((5, 3))
    grad[2] = 1.0, 2.0, 3.0
    got = impl.vertex_normals_backward(grad, vertices, np.array([[0, 1, 3], [0, 4, 1]]))
    assert_close(got, np.zeros((5, 3)))


@exercise("16.4", fine_print=True)
def test_faces_that_cancel_hand_nothing_back(impl):
    """0 / 0 where two faces lie back to back."""
    vertices = np.array([[0.0, 0, 0], [2.0, 0, 0], [0.0, 2.0, 0], [0.0, 0.0, 2.0]])
    faces = np.array([[0, 1, 2], [0, 2, 1]])
    assert_close(impl.vertex_normals_backward(np.ones((4, 3)), vertices, faces), np.zeros((4, 3)))


@exercise("16.4", fine_print=True)
def test_faces_that_cancel_side_by_side_hand_nothing_back(impl):
    """Where m is 0, the gradient goes on to the faces, as if m had the length 1."""
    vertices = np.array([[0.0, 0, 0], [2.0, 0, 0], [0.0, 2.0, 0], [-2.0, 0, 0], [0.0, 2.0, 0]])
    faces = np.array([[0, 3, 4], [0, 1, 2]])  # m of vertex 0 is (0, 0, -4) + (0, 0, 4)
    grad = np.zeros((5, 3))
    grad[:2] = [8.0, 4.0, 7.0], [8.0, 0.0, 5.0]
    expected = np.zeros((5, 3))  # x of vertex 1's normal: raise it by 1, it falls by 1/2
    expected[:2, 2] = 4.0, -4.0
    assert_close(impl.vertex_normals_backward(grad, vertices, faces), expected)


@exercise("16.4")
def test_small_faces_turn_faster(impl):
    """Lengths that are taken for 0; a face of a tenth of the size turns ten times as fast."""
    vertices, faces = 0.1 * np.array([[0.0, 0, 0], [1.0, 0, 0], [0, 1.0, 0]]), np.array([[0, 1, 2]])
    got = impl.vertex_normals_backward(np.array([[3.0, 0, 0], [0, 0, 0], [0, 0, 0]]), vertices,
                                       faces)
    assert_close(got, [[0, 0, 30.0], [0, 0, -30.0], [0, 0, 0]])


@exercise("16.4")
def test_gradients_of_normals_are_central_differences(impl, rng, gradcheck):
    """Faces at a vertex are averaged by number, not by area, or their shares do not add up; or one
    corner alone moves a face.
    """
    vertices, faces = mesh.icosphere(20)
    vertices = vertices * [1.0, 1.5, 2.0] + rng.normal(scale=0.1, size=vertices.shape)
    for some, name in (faces, "vertex normals"), (faces[:7], "open mesh"):
        gradcheck(mesh.vertex_normals, impl.vertex_normals_backward, (vertices, some), name=name)


# --- the losses --------------------------------------------------------------------------------

@exercise("16.5")
def test_the_loss_and_its_gradient_are_two_outputs(impl, rng):
    """The loss alone is returned, or the gradient alone, or the two are swapped."""
    loss, gradient = impl.picture_loss(*rng.uniform(0, 1, (2, 3, 5, 4)), 0.7)
    assert_equal((np.ndim(loss), *np.shape(gradient)), (0, 3, 5, 4))


@exercise("16.5")
def test_the_loss_number_by_number(impl, rng):
    """A sum, not a mean. The mean is over pixels, or over all four channels. The weight is at the
    colours, or missing. Right for pictures of 0 and 1 alone.
    """
    picture, target = rng.uniform(0, 1, (2, 4, 3, 4))
    d = (picture - target)**2
    expected = np.mean([d[i, j, k] for i in range(4) for j in range(3) for k in range(3)])
    expected += 0.7 * np.mean([d[i, j, 3] for i in range(4) for j in range(3)])
    assert_close(impl.picture_loss(picture, target, 0.7)[0], expected)


@exercise("16.5")
def test_the_gradient_of_the_loss_on_paper(impl):
    """The 2 of the square or the weight is missing. The weight is at the colours. The sign is that
    of target - picture. The colours' mean lacks its 1/3, for each pixel has three numbers. It is a
    mean over all four, or a sum.
    """
    difference = np.array([[[1.0, -2, 3, 4], [5, 6, -7, 8], [9, -1, 2, -3]],
                           [[-4, 5, 6, 7], [8, 9, -2, 1], [3, -5, 4, 6]]])
    target = np.linspace(-3, 2, 24).reshape(2, 3, 4)
    # 2 / (3 * 6) = 1 / 9 for the colours of 6 pixels, and 2 * 7 / 6 = 21 / 9 for coverage.
    got = impl.picture_loss(target + difference, target, 7.0)[1]
    assert_close(got, difference * [1, 1, 1, 21] / 9)


@exercise("16.5")
def test_several_pictures_have_one_mean(impl, rng):
    """The number of pixels is that of one picture, H W, though several pictures are given: the mean
    is over all pictures.
    """
    pictures, targets = rng.uniform(0, 1, (2, 4, 3, 2, 4))
    loss, grad_pictures = impl.picture_loss(pictures, targets, 0.7)
    alone = [impl.picture_loss(*pair, 0.7) for pair in zip(pictures, targets, strict=True)]
    assert_close(loss, np.mean([one for one, _ in alone]))
    assert_close(grad_pictures, np.array([grad for _, grad in alone]) / 4)


@exercise("16.5")
def test_the_gradient_of_the_loss_is_central_differences(impl, rng, gradcheck):
    """A channel or a pixel is left out."""
    def forward(picture, target, weight):
        d = (picture - target)**2
        return d[..., :3].sum() / 36 + weight * d[..., 3].sum() / 12

    gradcheck(forward, lambda grad_loss, *given: grad_loss * impl.picture_loss(*given)[1],
              (*rng.uniform(0, 1, (2, 4, 3, 4)), 0.7), differentiable=[0], name="picture_loss")


@exercise("16.6")
def test_the_level_on_paper(impl):
    """The ends' shares are swapped: the nearer end is to get more. Each end gets a half, or all, or
    one gets nothing. t has the wrong sign. An end of several vertices keeps the last one's share.
    Or t is differentiated, too.
    """
    ends = np.array([[1, 0], [1, 3], [4, 3], [2, 5]])
    distance = np.array([3.0, -1.0, -2.0, 4.0, -6.0, 0.5])  # t = 1/4, 1/5, 3/5, 4/5
    got = impl.level_backward(np.array([8.0, 10.0, 100.0, -5.0]), ends, distance)
    assert_close(got, [2.0, 6.0 + 8.0, -1.0, 2.0 + 60.0, 40.0, -4.0])


@exercise("16.6")
def test_the_level_where_the_surface_meets_a_point_of_the_grid(impl):
    """A distance of 0 is divided by, or its end gets less than all."""
    got = impl.level_backward(np.array([10.0]), np.array([[1, 2]]), np.array([5.0, -1.0, 0.0, 3.0]))
    assert_close(got, [0.0, 0.0, 10.0, 0.0])


@exercise("16.6")
def test_the_level_where_the_vertex_is_held(impl, rng, gradcheck):
    """t is differentiated, too: it is to be held, as s of a vertex that goes along is always 0. Or
    |s| is taken for s.
    """
    ends = np.array([[a, b] for a, b in itertools.product(range(3), range(3, 8)) if (a + b) % 3])
    distance = np.concatenate([-rng.uniform(0.2, 2, 3), rng.uniform(0.2, 2, 6)])
    part = np.array([distance[a] / (distance[a] - distance[b]) for a, b in ends])

    def forward(distance):
        return np.array([(1 - t) * distance[a] + t * distance[b]
                         for t, (a, b) in zip(part, ends, strict=True)])
    gradcheck(forward, lambda grad_level, moved: impl.level_backward(grad_level, ends, distance),
              (distance,), name="level")


# --- regularizers ------------------------------------------------------------------------------

def changes(distance, edges):
    """Eq. (7), edge by edge: the cross-entropy of each end with the sign of the other one."""
    total = 0.0
    for a, b in edges:
        for s, other in (distance[a], distance[b]), (distance[b], distance[a]):
            if (s < 0) != (other < 0):
                inside = 1 / (1 + np.exp(s))
                total -= np.log(inside if other < 0 else 1 - inside)
    return total


def prices(impl, edges):
    """What each of edges (K, 1, 2) costs alone, and what it should."""
    distance = np.array([-1.0, 2.0, 5.0, -3.0, -2.5])
    return (np.array([impl.sign_changes(distance, edge)[0] for edge in edges]),
            np.log(1 + np.exp(np.abs(distance[edges[:, 0]]))).sum(1))


@exercise("16.7")
def test_one_sign_change_on_paper(impl):
    """Each end is compared with its own sign and not with the other's: log(1 + exp(-|s|)), a minus
    in the exponent. One of the two ends is left out. log, 1 + or an abs is missing. The gradient
    comes first, or alone.
    """
    assert_close(*prices(impl, np.array([[[0, 1]], [[3, 2]], [[4, 1]], [[0, 2]]])))


@exercise("16.7")
def test_pairs_may_begin_outside(impl):
    """Only edges whose first end is inside count: those given with the outside end first are left
    out. Pairs come in any order of their ends. Or their sign is wrong.
    """
    assert_close(*prices(impl, np.array([[[0, 1]], [[2, 3]], [[4, 1]], [[2, 0]]])))


@exercise("16.7")
def test_an_edge_that_is_not_crossed_costs_nothing(impl, rng):
    """All edges count, also those that are not crossed: both ends have the same sign."""
    distance = rng.uniform(0.5, 2, 6) * np.repeat([-1, 1], 3)
    price, grad_distance = impl.sign_changes(distance, np.array([[0, 2], [4, 3], [1, 0], [5, 4]]))
    assert_close(price, 0.0)
    assert_close(grad_distance, np.zeros(6))


@exercise("16.7")
def test_sign_changes_edge_by_edge(impl, rng):
    """It is a mean over the edges, or over the crossed ones, and not their sum; or each point
    counts once, though it is an end of several edges. Or an edge that comes twice counts otherwise.
    """
    distance, edges = rng.normal(size=12), rng.integers(12, size=(40, 2))
    assert_close(impl.sign_changes(distance, edges)[0], changes(distance, edges))


@exercise("16.7")
def test_gradients_of_sign_changes_on_paper(impl):
    """The sign is missing or wrong: an inside end is to be pulled out, an outside end in. The slope
    is that of log(1 + exp(-|s|)), exp(-|s|) in the numerator, or is 1. A point of several edges
    counts once. Edges that are not crossed count, or one end alone. The last point, which is in no
    edge, is missing.
    """
    distance = np.log([1 / 4, 3, 1 / 2, 5, 9, 7, 11])
    edges = np.array([[0, 1], [1, 2], [0, 2], [3, 1], [0, 4], [0, 3], [5, 2]])
    got = impl.sign_changes(distance, edges)[1]
    assert_close(60 * got, [-3 * 48.0, 2 * 45.0, 2 * -40.0, 50.0, 54.0, 52.5, 0.0])


@exercise("16.7")
def test_gradients_of_sign_changes_are_central_differences(impl, rng, gradcheck):
    """Ends of several edges get one edge's share."""
    gradcheck(changes, lambda grad_price, *given: grad_price * impl.sign_changes(*given)[1],
              (rng.normal(size=12), rng.integers(12, size=(40, 2))),
              decisions=lambda distance, edges: distance < 0, name="sign_changes")


@exercise("16.7", fine_print=True)
def test_zero_has_the_sign_plus(impl):
    """A distance of 0 has a sign of its own, as with np.sign, or counts as inside; or no slope."""
    distance = np.array([0.0, -0.0, 1.0, -1.0])
    assert_close(impl.sign_changes(distance, np.array([[0, 1], [0, 2]]))[0], 0.0)
    for edge in [3, 0], [1, 3]:
        price, grad_distance = impl.sign_changes(distance, np.array([edge]))
        assert_close(price, np.log(2) + np.log(1 + np.e))
        assert_close(grad_distance[sum(edge) - 3], 0.5)


@exercise("16.7", fine_print=True)
def test_large_distances_do_not_overflow(impl):
    """exp(1000) overflows and is inf; np.logaddexp does not."""
    price, grad_distance = impl.sign_changes(np.array([-1000.0, 2000.0]), np.array([[1, 0]]))
    assert_close(price, 3000.0)
    assert_close(grad_distance, [-1.0, 1.0])


# --- the step ----------------------------------------------------------------------------------

def grid_laplacian(m):
    """(m^3, m^3), from the neighbours of each point."""
    at = np.indices((m, m, m)).reshape(3, -1)
    beside = (np.abs(at[:, :, None] - at[:, None]).sum(0) == 1).astype(float)
    return np.diag(beside.sum(0)) - beside


@exercise("16.8")
def test_spreading_on_paper(impl):
    """It multiplies by I + amount * Laplacian, or takes one explicit step, x - amount Laplacian(x),
    and does not solve eq. (8). The cosine has 2 pi k / m, as where the grid wraps around. The axes
    come one after another, a product. norm, a factor 2 or a sign is another.
    """
    # Undo x = y + 2 Laplacian(y). Point 1 = (0, 0, 1) has four neighbours, so has 21 = (2, 1, 0).
    x, y = np.zeros((27, 2)), np.zeros((27, 2))
    y[1], y[21] = [4.0, 5.0], [-3.0, 7.0]
    x[1], x[21] = 9 * y[1], 9 * y[21]
    x[[0, 2, 4, 10]], x[[12, 18, 22, 24]] = -2 * y[1], -2 * y[21]
    assert_close(impl.spread(x, 2.0), y)
    assert_close(impl.spread(np.full(27, 4.0), 3.0), np.full(27, 4.0))


@exercise("16.8")
@pytest.mark.parametrize("m", [2, 3, 5])
def test_spreading_solves_its_equation(impl, rng, m):
    """The border's points count as if they had six neighbours, the cosine transform goes over the
    colours, too, which it mixes, or its norm or kind is another.
    """
    x = rng.normal(size=(m**3, 2))
    for amount in 0.0, 0.3, 7.0:
        y = impl.spread(x, amount)
        assert_equal(y.shape, x.shape)
        assert_close(y + amount * grid_laplacian(m) @ y, x, atol=1e-9)


@exercise("16.8")
def test_numbers_without_channels_and_many_channels(impl, rng):
    """(G,) comes back as (G, 1), or colours are mixed with each other or an axis of the grid."""
    x = rng.normal(size=(27, 3))
    together = impl.spread(x, 0.7)
    for k in range(3):
        assert_close(impl.spread(x[:, k].copy(), 0.7), together[:, k])


@exercise("16.8")
def test_a_large_grid_takes_no_minutes(impl):
    """A dense matrix of 35,937^2 numbers."""
    x = np.zeros(33**3)
    x[33**3 // 2] = 1.0
    y = impl.spread(x, 1.0)
    assert_close(y.sum(), 1.0)
    middle = y.reshape(33, 33, 33)[16, 16, 14:19]
    assert_close(middle, middle[::-1])


# --- what is found -----------------------------------------------------------------------------

@exercise("16.10")
def test_genus_on_paper(impl):
    """A ball: V - E + F, which is 2, or its half is taken for the genus and not taken from the
    pieces. Each edge counts twice, once for either face. The two outputs are in the wrong order.
    """
    tetrahedron = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    assert_equal(impl.genus(tetrahedron), (1, 0))


@exercise("16.10")
def test_genus_of_a_ring(impl):
    """V - E + F is not halved: twice the genus comes; or its sign is wrong. A ball is right all the
    same.
    """
    assert_equal(impl.genus(mesh.torus(100)[1]), (1, 1))


@exercise("16.10")
def test_numbers_that_no_face_names_are_no_vertices(impl):
    """V is the greatest number of a vertex: numbers that no face names, unused ones, count too."""
    assert_equal(impl.genus(3 + mesh.torus(36)[1]), (1, 1))
    assert_equal(impl.genus(5 * mesh.icosphere(20)[1]), (1, 0))


@exercise("16.10")
def test_genus_of_several_pieces(impl):
    """Each piece adds 2 to V - E + F, and is taken for a hole; or one piece is taken for granted.
    """
    ball, ring = mesh.icosphere(20)[1], mesh.torus(36)[1]
    far = 5 + ball.max()
    assert_equal(impl.genus(np.concatenate([ring + 3, ring + 100])), (2, 2))
    assert_equal(impl.genus(np.concatenate([ball, ring + far])), (2, 1))
    assert_equal(impl.genus(np.concatenate([ball, ball + 20, ball + 40])), (3, 0))


@exercise("16.10")
def test_genus_of_any_pieces(impl, rng):
    """Right for a few surfaces alone, or vertices must be numbered in some order."""
    for balls, rings in rng.integers([0, 1], 5, (6, 2)).tolist():
        pieces = [mesh.icosphere(20)[1]] * balls + [mesh.torus(36)[1]] * rings
        apart = np.concatenate([piece + 20 * k for k, piece in enumerate(pieces)])
        faces = rng.permutation(rng.permutation(400)[apart])
        assert_equal(impl.genus(faces), (balls + rings, rings))


@exercise("16.10")
def test_genus_of_two_holes(impl):
    """Right up to one hole."""
    cubes = {(i, j) for i in range(5) for j in range(3)} - {(1, 1), (3, 1)}
    assert_equal(impl.genus(block(cubes)), (1, 2))


def block(cubes):
    """The closed surface of unit cubes (i, j, 0), as triangles."""
    number, faces = {}, []
    for i, j in cubes:
        for axis, side in itertools.product(range(3), (0, 1)):
            beside = np.array([i, j, 0]) + (2 * side - 1) * np.eye(3, dtype=int)[axis]
            if beside[2] == 0 and tuple(beside[:2]) in cubes:
                continue
            u, v = (np.eye(3, dtype=int)[(axis + k) % 3] for k in (1, 2))
            low = np.array([i, j, 0]) + side * np.eye(3, dtype=int)[axis]
            square = [tuple(low + p * u + q * v) for p, q in ((0, 0), (1, 0), (1, 1), (0, 1))]
            a, b, c, d = (number.setdefault(corner, len(number)) for corner in square)
            faces += [[a, b, c], [a, c, d]] if side else [[a, c, b], [a, d, c]]
    return np.array(faces)


