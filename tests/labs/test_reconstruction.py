"""What the exercises of lab 16 must do."""
import itertools

import numpy as np
import pytest

from course.checks import assert_close, assert_equal, exercise
from course.given import mesh
from course.given.gradcheck import gradcheck

PI = np.pi
Y0, Y1, Y2, Y20, Y22 = (np.sqrt(k / PI) / 2 for k in (1, 3, 15, 5 / 4, 15 / 4))
BANDS = np.array([1, 2 / 3, 2 / 3, 2 / 3, 1 / 4, 1 / 4, 1 / 4, 1 / 4, 1 / 4]) * PI


def harmonics(n):
    """The nine polynomials, one direction (3,) at a time."""
    x, y, z = n
    return np.array([Y0, Y1 * y, Y1 * z, Y1 * x, Y2 * x * y, Y2 * y * z, Y20 * (3 * z * z - 1),
                     Y2 * x * z, Y22 * (x * x - y * y)])


def directions(rng, *shape):
    n = rng.normal(size=(*shape, 3))
    return n / np.linalg.norm(n, axis=-1, keepdims=True)


# --- light and shading -------------------------------------------------------------------------

@exercise("16.1")
def test_harmonics_on_paper(impl):
    """The order of x, y, z; a constant; or 3 z^2 - 1 without its 1."""
    got = impl.sh_basis(np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]))
    expected = np.zeros((3, 9))
    expected[:, 0] = 0.28209479177387814
    expected[[0, 1, 2], [3, 1, 2]] = 0.4886025119029199
    expected[:, 6] = [-0.31539156525252005, -0.31539156525252005, 0.6307831305050401]
    expected[:, 8] = [0.5462742152960396, -0.5462742152960396, 0]
    assert_close(got, expected)
    got = impl.sh_basis(np.array([2.0, 3.0, 5.0]))[[4, 5, 7]]
    assert_close(got, 1.0925484305920792 * np.array([6.0, 15.0, 10.0]))


@exercise("16.1")
def test_each_direction_of_any_array(impl, rng):
    """One direction alone, or a list of them, is right; or a length is divided out."""
    normals = rng.normal(size=(2, 4, 3))
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


@exercise("16.2")
def test_gradients_of_harmonics_on_paper(impl):
    """x, y and z are swapped; 6 z is taken for 3 z; or the sign of y in x^2 - y^2."""
    n = np.array([2.0, 3.0, 5.0])
    for k, expected in enumerate(np.array([
            [0, 0, 0], [0, Y1, 0], [0, 0, Y1], [Y1, 0, 0], [3 * Y2, 2 * Y2, 0],
            [0, 5 * Y2, 3 * Y2], [0, 0, 30 * Y20], [5 * Y2, 0, 2 * Y2],
            [4 * Y22, -6 * Y22, 0]])):
        assert_close(impl.sh_basis_backward(10 * np.eye(9)[k], n), 10 * expected)


@exercise("16.2")
def test_gradients_of_harmonics_are_central_differences(impl, rng):
    """Directions are mixed, or taken for unit."""
    def forward(normals):
        return np.array([[harmonics(n) for n in row] for row in normals])

    gradcheck(forward, impl.sh_basis_backward, (rng.normal(size=(3, 4, 3)),), name="sh_basis")


@exercise("16.3")
def test_one_lamp_on_paper(impl):
    """A_k is left out, or that of another order; or strength is of one colour."""
    got = impl.distant_light(np.array([[0.0, 0.0, 1.0]]), np.array([[1.0, 10.0]]))
    expected = np.zeros((9, 1))
    expected[[0, 2, 6], 0] = PI * Y0, 2 / 3 * PI * Y1, PI / 4 * 2 * Y20
    assert_close(got, expected * [1.0, 10.0])


@exercise("16.3")
def test_lamps_add_up(impl, rng):
    """Lamps are averaged, or one's strength goes with another's direction."""
    towards, strength = directions(rng, 4), rng.uniform(0, 1, (4, 2))
    expected = sum(np.outer(BANDS * harmonics(n), s)
                   for n, s in zip(towards, strength, strict=True))
    assert_close(impl.distant_light(towards, strength), expected)


@exercise("16.3")
def test_it_comes_near_the_cosine_of_a_true_lamp(impl, rng):
    """The nine numbers are those of a lamp seen, not of a surface that it lights."""
    towards = directions(rng, 1)
    light = impl.distant_light(towards, np.ones((1, 1)))
    normals = directions(rng, 200)
    lit = np.array([harmonics(n) for n in normals]) @ light[:, 0]
    cosine = normals @ towards[0]
    assert_close(lit, 1 / 4 + cosine / 2 + 5 / 32 * (3 * cosine**2 - 1), atol=1e-9)
    assert_equal(bool(np.abs(lit - np.maximum(cosine, 0)).max() < 0.1), True)


@exercise("16.4")
def test_shading_on_paper(impl):
    """Albedo is left out, or added; or the light's colours are mixed."""
    light = np.zeros((9, 2))
    light[0], light[3] = [4 / Y0, 1 / Y0], [2 / Y1, 0.0]
    normals = np.array([[1.0, 0, 0], [-1.0, 0, 0], [0, 0.6, 0.8]])
    albedo = np.array([[0.5, 1.0], [0.25, 3.0], [1.0, 0.5]])
    assert_close(impl.shade(albedo, normals, light), np.array([[3.0, 1], [0.5, 3], [4.0, 0.5]]))


@exercise("16.4")
def test_shading_point_by_point(impl, rng):
    """Points are mixed; light below 0 is cut off, which eq. (1) does not; one colour is right."""
    albedo, normals, light = rng.uniform(0, 1, (6, 4)), directions(rng, 6), rng.normal(size=(9, 4))
    expected = [a * (harmonics(n) @ light) for a, n in zip(albedo, normals, strict=True)]
    assert_close(impl.shade(albedo, normals, light), np.array(expected))


@exercise("16.5")
def test_gradients_of_shading_on_paper(impl):
    """A factor is missing in one of the three, or the light's is a mean."""
    light = np.zeros((9, 1))
    light[0], light[1], light[8] = 4 / Y0, 2 / Y1, 1 / Y22
    albedo, normals = np.array([[0.5], [2.0]]), np.array([[0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
    got = impl.shade_backward(np.array([[10.0], [1.0]]), albedo, normals, light)
    assert_close(got[0], np.array([[53.2], [4.0]]))  # 4 + 1.6 + 0.36 - 0.64 = 5.32
    assert_close(got[1], np.array([[6.0, 2.0, 0.0], [0.0, 4.0, 0.0]]))
    assert_close(got[2][[0, 1, 3], 0], np.array([7 * Y0, 4 * Y1, 3 * Y1]))


@exercise("16.5")
def test_gradients_of_shading_are_central_differences(impl, rng):
    """A gradient's points or colours are mixed."""
    def forward(albedo, normals, light):
        return albedo * (np.array([harmonics(n) for n in normals]) @ light)

    given = rng.uniform(0, 1, (5, 2)), rng.normal(size=(5, 3)), rng.normal(size=(9, 2))
    gradcheck(forward, impl.shade_backward, given, name="shade")


def normals_of(vertices, faces):
    """Eq. (4), face by face."""
    m = np.zeros(vertices.shape)
    for a, b, c in faces:
        for corner in a, b, c:
            m[corner] += np.cross(vertices[b] - vertices[a], vertices[c] - vertices[a])
    length = np.linalg.norm(m, axis=1, keepdims=True)
    return m / np.where(length > 0, length, 1)


@exercise("16.6")
def test_gradients_of_normals_on_paper(impl):
    """The normal's length is free; a corner's share has the wrong sign; or |m| is left out."""
    vertices = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0], [9.0, 9.0, 9.0]])
    faces = np.array([[0, 1, 2]])
    for k in range(3):
        grad = np.zeros((4, 3))
        grad[k] = 8.0, 0.0, 5.0  # x of the normal: raise the corner at x = 4 by 1, it falls by 1/4
        got = impl.vertex_normals_backward(grad, vertices, faces)
        assert_close(got, np.array([[0, 0, 2.0], [0, 0, -2.0], [0, 0, 0], [0, 0, 0]]))


@exercise("16.6", fine_print=True)
def test_a_vertex_of_no_face_stays_quiet(impl):
    """0 / 0; or what comes to it goes to others."""
    vertices = np.array([[0.0, 0, 0], [1.0, 0, 0], [5.0, 5.0, 5.0], [0.0, 1.0, 0], [0.0, 0, 1.0]])
    grad = np.zeros((5, 3))
    grad[2] = 1.0, 2.0, 3.0
    got = impl.vertex_normals_backward(grad, vertices, np.array([[0, 1, 3], [0, 4, 1]]))
    assert_close(got, np.zeros((5, 3)))


@exercise("16.6", fine_print=True)
def test_faces_that_cancel_hand_nothing_back(impl):
    """0 / 0 where two faces lie back to back."""
    vertices = np.array([[0.0, 0, 0], [2.0, 0, 0], [0.0, 2.0, 0], [0.0, 0.0, 2.0]])
    faces = np.array([[0, 1, 2], [0, 2, 1]])
    got = impl.vertex_normals_backward(np.ones((4, 3)), vertices, faces)
    assert_close(got, np.zeros((4, 3)))


@exercise("16.6", fine_print=True)
def test_faces_that_cancel_side_by_side_hand_nothing_back(impl):
    """Where m is 0, the gradient goes on to the faces, as if m had the length 1."""
    vertices = np.array([[0.0, 0, 0], [2.0, 0, 0], [0.0, 2.0, 0], [-2.0, 0, 0], [0.0, 2.0, 0]])
    faces = np.array([[0, 3, 4], [0, 1, 2]])  # m of vertex 0 is (0, 0, -4) + (0, 0, 4)
    grad = np.zeros((5, 3))
    grad[:2] = [8.0, 4.0, 7.0], [8.0, 0.0, 5.0]
    got = impl.vertex_normals_backward(grad, vertices, faces)
    expected = np.zeros((5, 3))  # x of vertex 1's normal: raise it by 1, it falls by 1/2
    expected[:2, 2] = 4.0, -4.0
    assert_close(got, expected)


@exercise("16.6")
def test_small_faces_turn_faster(impl):
    """Lengths that are taken for 0; a face of a tenth of the size turns ten times as fast."""
    vertices, faces = 0.1 * np.array([[0.0, 0, 0], [1.0, 0, 0], [0, 1.0, 0]]), np.array([[0, 1, 2]])
    got = impl.vertex_normals_backward(np.array([[3.0, 0, 0], [0, 0, 0], [0, 0, 0]]), vertices,
                                       faces)
    assert_close(got, np.array([[0, 0, 30.0], [0, 0, -30.0], [0, 0, 0]]))


@exercise("16.6")
def test_gradients_of_normals_are_central_differences(impl, rng):
    """Faces at a vertex are averaged by number, not by area; or only one corner moves them."""
    vertices, faces = mesh.icosphere(20)
    vertices = vertices * [1.0, 1.5, 2.0] + rng.normal(scale=0.1, size=vertices.shape)

    def forward(vertices):
        return normals_of(vertices, faces)

    def backward(grad_normals, vertices):
        return impl.vertex_normals_backward(grad_normals, vertices, faces)

    gradcheck(forward, backward, (vertices,), name="vertex normals")
    gradcheck(lambda vertices: normals_of(vertices, faces[:7]),
              lambda grad, vertices: impl.vertex_normals_backward(grad, vertices, faces[:7]),
              (vertices,), name="open mesh")


# --- the losses --------------------------------------------------------------------------------

@exercise("16.8")
def test_the_gradient_of_the_loss_on_paper(impl):
    """The 2, the sign, or what a mean divides by."""
    picture, target = np.zeros((2, 1, 4)), np.zeros((2, 1, 4))
    picture[1, 0], target[0, 0] = [3.0, 0, 0, 1], [0, 6.0, 0, 2]
    expected = np.array([[[0, -20.0, 0, -100]], [[10.0, 0, 0, 50]]])
    assert_close(impl.picture_loss_backward(10.0, picture, target, 5.0), expected)


@exercise("16.8")
def test_the_gradient_of_the_loss_is_central_differences(impl, rng):
    """A channel is left out."""
    picture, target = rng.uniform(0, 1, (2, 4, 3, 4))

    def forward(picture):
        d = (picture - target)**2
        return d[..., :3].sum() / 36 + 0.7 * d[..., 3].sum() / 12

    def backward(grad_loss, picture):
        return impl.picture_loss_backward(grad_loss, picture, target, 0.7)

    gradcheck(forward, backward, (picture,), name="picture_loss")


@exercise("16.9")
def test_the_level_on_paper(impl):
    """The nearer end gets less; a sign; or an end of several vertices gets the last one's share."""
    ends, distance = np.array([[1, 0], [1, 3], [4, 3]]), np.array([3.0, -1.0, 7.0, 0.0, -2.0])
    got = impl.level_backward(np.array([8.0, 10.0, 100.0]), ends, distance)
    assert_close(got, np.array([2.0, 6.0, 0.0, 110.0, 0.0]))


@exercise("16.9")
def test_the_level_where_the_vertex_is_held(impl, rng):
    """It is the gradient of a point that goes along, which is 0; or s is taken by its size."""
    ends = np.array([[a, b] for a, b in itertools.product(range(3), range(3, 8)) if (a + b) % 3])
    distance = np.concatenate([-rng.uniform(0.2, 2, 3), rng.uniform(0.2, 2, 6)])
    part = np.array([distance[a] / (distance[a] - distance[b]) for a, b in ends])

    def forward(distance):
        return np.array([(1 - t) * distance[a] + t * distance[b]
                         for t, (a, b) in zip(part, ends, strict=True)])

    def backward(grad_level, moved):
        return impl.level_backward(grad_level, ends, distance)

    gradcheck(forward, backward, (distance,), name="level")


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


@exercise("16.10")
def test_sign_changes_on_paper(impl):
    """Edges count that are not crossed; one end of the two is left out; or it is a mean."""
    distance = np.array([-1.0, 1.0, 2.0, -3.0])
    edges = np.array([[0, 1], [1, 2], [3, 0]])
    assert_close(impl.sign_changes(distance, edges), 2 * np.log(1 + np.e))
    edges = np.array([[0, 1], [1, 2], [2, 3]])
    expected = np.log((1 + np.e)**2 * (1 + np.e**2) * (1 + np.e**3))
    assert_close(impl.sign_changes(distance, edges), expected)
    assert_close(impl.sign_changes(distance, edges[1:2]), 0.0)


@exercise("16.10", fine_print=True)
def test_zero_has_the_sign_plus(impl):
    """np.sign(0) = 0 is a sign of its own."""
    distance = np.array([0.0, -0.0, 1.0, -1.0])
    assert_close(impl.sign_changes(distance, np.array([[0, 1], [0, 2]])), 0.0)
    expected = np.log(2) + np.log(1 + np.e)
    assert_close(impl.sign_changes(distance, np.array([[3, 0]])), expected)
    assert_close(impl.sign_changes(distance, np.array([[1, 3]])), expected)


@exercise("16.10")
def test_sign_changes_edge_by_edge(impl, rng):
    """The other end's sign is mistaken for one's own."""
    distance, edges = rng.normal(size=12), rng.integers(12, size=(40, 2))
    assert_close(impl.sign_changes(distance, edges), changes(distance, edges))


@exercise("16.10", fine_print=True)
def test_large_distances_do_not_overflow(impl):
    """exp(1000) = inf."""
    assert_close(impl.sign_changes(np.array([-1000.0, 2000.0]), np.array([[1, 0]])), 3000.0)


@exercise("16.11")
def test_gradients_of_sign_changes_on_paper(impl):
    """A sign: the inside end must be pulled out, the outside end in; or an edge counts twice."""
    distance = np.array([-np.log(4.0), np.log(3.0), -np.log(2.0), 5.0])
    edges = np.array([[0, 1], [1, 2], [0, 2]])
    got = impl.sign_changes_backward(60.0, distance, edges)
    assert_close(got, np.array([-48.0, 90.0, -40.0, 0.0]))


@exercise("16.11", fine_print=True)
def test_at_zero_and_far_away(impl):
    """A distance of 0 has no slope; or exp overflows."""
    distance, edges = np.array([0.0, -1000.0, 1000.0]), np.array([[0, 1], [2, 1], [0, 2]])
    got = impl.sign_changes_backward(2.0, distance, edges)
    assert_close(got, np.array([1.0, -4.0, 2.0]))


@exercise("16.11")
def test_gradients_of_sign_changes_are_central_differences(impl, rng):
    """Ends of several edges get one edge's share."""
    distance, edges = rng.normal(size=12), rng.integers(12, size=(40, 2))

    def backward(grad_changes, distance):
        return impl.sign_changes_backward(grad_changes, distance, edges)

    gradcheck(lambda distance: changes(distance, edges), backward, (distance,),
              decisions=lambda distance: distance < 0, name="sign_changes")


# --- the step ----------------------------------------------------------------------------------

def grid_laplacian(m):
    """(m^3, m^3), from the neighbours of each point."""
    at = list(itertools.product(range(m), repeat=3))
    matrix = np.zeros((m**3, m**3))
    for i, p in enumerate(at):
        for j, q in enumerate(at):
            if sum(abs(a - b) for a, b in zip(p, q, strict=True)) == 1:
                matrix[i, i] += 1
                matrix[i, j] -= 1
    return matrix


@exercise("16.12")
def test_spreading_on_paper(impl):
    """Sums do not stay; the grid wraps around; or the amount is of the wrong power."""
    x = np.array([[105.0], [0], [0], [0], [0], [0], [0], [0]])
    expected = np.array([[36.0, 13, 13, 8, 13, 8, 8, 6]]).T
    assert_close(impl.spread(x, 1.0), expected)
    assert_close(impl.spread(np.full(27, 4.0), 3.0), np.full(27, 4.0))


@exercise("16.12")
@pytest.mark.parametrize("m", [2, 3, 5])
def test_spreading_solves_its_equation(impl, rng, m):
    """The border's points count as if they had six neighbours; or sine and cosine."""
    x = rng.normal(size=(m**3, 2))
    for amount in 0.0, 0.3, 7.0:
        y = impl.spread(x, amount)
        assert_equal(y.shape, x.shape)
        assert_close(y + amount * grid_laplacian(m) @ y, x, atol=1e-9)


@exercise("16.12")
def test_numbers_without_channels_and_many_channels(impl, rng):
    """(G,) comes back as (G, 1); or channels are mixed with an axis of the grid."""
    x = rng.normal(size=(27, 3))
    together = impl.spread(x, 0.7)
    for k in range(3):
        assert_close(impl.spread(x[:, k].copy(), 0.7), together[:, k])


@exercise("16.12")
def test_a_large_grid_takes_no_minutes(impl):
    """A dense matrix of 35,937^2 numbers."""
    x = np.zeros(33**3)
    x[33**3 // 2] = 1.0
    y = impl.spread(x, 1.0)
    assert_close(y.sum(), 1.0)
    middle = y.reshape(33, 33, 33)[16, 16, 14:19]
    assert_close(middle, middle[::-1])


# --- what is found -----------------------------------------------------------------------------

@exercise("16.13")
def test_genus_on_paper(impl):
    """V - E + F is taken for the genus; or a sign."""
    tetrahedron = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    assert_equal(impl.genus(tetrahedron), (1, 0))


@exercise("16.13")
def test_genus_of_a_ring(impl):
    """V - E + F is not halved; a ball is right all the same."""
    assert_equal(impl.genus(mesh.torus(100)[1]), (1, 1))


@exercise("16.13")
def test_genus_of_several_pieces(impl):
    """Each piece adds 2 to V - E + F; or vertices of no face count."""
    ball, ring = mesh.icosphere(20)[1], mesh.torus(36)[1]
    far = 5 + ball.max()
    assert_equal(impl.genus(np.concatenate([ring + 3, ring + 100])), (2, 2))
    assert_equal(impl.genus(np.concatenate([ball, ring + far])), (2, 1))
    assert_equal(impl.genus(np.concatenate([ball, ball + 20, ball + 40])), (3, 0))


@exercise("16.13")
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


@exercise("16.14")
def test_the_scale_on_paper(impl):
    """One factor for all colours; or the factor of the truth."""
    found = np.array([[1.0, 2.0, 1.0], [1.0, 0.0, 2.0]])
    truth = np.array([[3.0, 1.0, -1.0], [5.0, 7.0, 3.0]])
    assert_close(impl.best_scale(found, truth), np.array([4.0, 0.5, 1.0]))


@exercise("16.14")
def test_no_other_scale_comes_nearer(impl, rng):
    """The mean of quotients, or the quotient of means."""
    found, truth = rng.uniform(0.1, 1, (2, 9, 2))
    scale = impl.best_scale(found, truth)
    expected = [np.linalg.lstsq(found[:, k:k + 1], truth[:, k], rcond=None)[0][0] for k in (0, 1)]
    assert_close(scale, np.array(expected))
