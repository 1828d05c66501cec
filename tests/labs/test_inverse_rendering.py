"""What the exercises of lab 9 must do."""
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.checks import assert_close, assert_equal, exercise
from course.given.gradcheck import gradcheck

# Two triangles at an edge, a tail, and a vertex that is alone; every valence from 0 to 4.
EDGES = np.array([[0, 1], [2, 0], [1, 2], [3, 1], [2, 3], [2, 4]])
NEIGHBOURS = [1, 2], [0, 2, 3], [0, 1, 3, 4], [1, 2], [2], []

UNITS = np.eye(4)
PRODUCTS = [["1", "i", "j", "k"], ["i", "-1", "k", "-j"], ["j", "-k", "-1", "i"],
            ["k", "j", "-i", "-1"]]  # of row times column


def unit(name):
    return (-1.0 if name[0] == "-" else 1.0) * UNITS["1ijk".index(name[-1])]


def as_complex(q):
    """Quaternions (..., 4) as matrices (..., 2, 2), whose products are theirs."""
    w, x, y, z = np.moveaxis(q, -1, 0)
    return np.stack([np.stack([w + 1j * x, y + 1j * z], -1),
                     np.stack([-y + 1j * z, w - 1j * x], -1)], -2)


def rotation(q):
    """The rotation by q = (w, x, y, z), SciPy's."""
    return Rotation.from_quat(np.roll(q, -1, -1))


def pixel_by_pixel(coverage, target):
    """1 - intersection over union; the union is what is not in neither."""
    pairs = list(zip(coverage.flat, target.flat, strict=True))
    either = len(pairs) - sum((1 - c) * (1 - t) for c, t in pairs)
    return 1 - sum(c * t for c, t in pairs) / either


def averaging(count):
    """d = (I - W) x, as a matrix."""
    matrix = np.zeros((count, count))
    for v, neighbours in enumerate(NEIGHBOURS):
        for n in neighbours:
            matrix[v, v] = 1.0
            matrix[v, n] -= 1 / len(neighbours)
    return matrix


# --- the squared error -------------------------------------------------------------------------

@exercise("9.2")
def test_every_difference_pulls_by_twice_its_share(impl):
    """The 2, the number of numbers, the sign or grad_loss is missing."""
    picture, target = np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[1.0, 5.0], [1.0, 4.0]])
    got = impl.squared_error_backward(6.0, picture, target)
    assert_close(got, np.array([[0.0, -9.0], [6.0, 0.0]]))


@exercise("9.2")
def test_the_gradient_of_the_error_is_central_differences(impl, rng):
    """Divided by the number of pixels, where there are channels."""
    def forward(picture, target):
        return np.mean([(picture[p] - target[p])**2 for p in np.ndindex(picture.shape)])

    gradcheck(forward, impl.squared_error_backward, (rng.random((3, 5, 2)), rng.random((3, 5, 2))),
              differentiable=[0], name="squared_error")


# --- Adam --------------------------------------------------------------------------------------

def adam_by_sums(x, gradients, rate, beta_1, beta_2, epsilon):
    """Adam's mean and square as weighted sums over all gradients so far: x after each step."""
    positions, n = [], 0
    for n in range(1, len(gradients) + 1):
        ages = np.arange(n - 1, -1, -1)
        first = np.tensordot(beta_1**ages, gradients[:n], 1) / (beta_1**ages).sum()
        second = np.tensordot(beta_2**ages, gradients[:n]**2, 1) / (beta_2**ages).sum()
        x = x - rate * first / (second**0.5 + epsilon)
        positions.append(x)
    return positions


@exercise("9.3")
def test_the_first_step_is_by_the_rate(impl):
    """Uphill; or the bias correction is missing, and the first step is by 0.1 or 3.2 rates."""
    x, grad_x, zero = np.array([[1.0, 2.0, 3.0]]), np.array([[1e-3, -7.0, 1e4]]), np.zeros((1, 3))
    x, mean, square = impl.adam_step(x, grad_x, zero, zero, 1, 0.5)
    assert_close(x, np.array([[0.5, 2.5, 2.5]]), atol=1e-5)
    assert_close(mean, 0.1 * grad_x)
    assert_close(square, 1e-3 * grad_x**2)


@exercise("9.3")
def test_a_step_in_the_middle_on_paper(impl):
    """m^ and s^ come back for m' and s' (mean, square), or are not by this step's number."""
    given = np.array([5.0]), np.array([2.0]), np.array([4.0]), np.array([3.0])
    x, mean, square = impl.adam_step(*given, 2, 0.5, constants=(0.5, 0.75, 0.0))
    # m = 2 + 1, s = 2.25 + 1; corrected by 1 - 1/4 and by 1 - 9/16.
    assert_close(mean, np.array([3.0]))
    assert_close(square, np.array([3.25]))
    assert_close(x, 5 - 0.5 * 4 / np.sqrt(np.array([3.25 * 16 / 7])))


@exercise("9.3")
def test_epsilon_is_added_to_the_root(impl):
    """epsilon is under the root, or is added before the correction; or 0 is divided by 0."""
    x, grad_x, zero = np.array([1.0, 1.0]), np.array([3.0, 0.0]), np.zeros(2)
    x, _, _ = impl.adam_step(x, grad_x, zero, zero, 1, 0.5, (0.9, 0.999, 2.0))
    assert_close(x, np.array([0.7, 1.0]))


@exercise("9.3")
def test_many_steps_are_sums_over_all_gradients(impl, rng):
    """The two betas are swapped, or the defaults are others: 0.9, 0.999 and 1e-8."""
    gradients, x = rng.normal(size=(6, 2, 3)), rng.normal(size=(2, 3))
    for given, constants in ((), (0.9, 0.999, 1e-8)), (((0.8, 0.95, 1e-3),), (0.8, 0.95, 1e-3)):
        expected = adam_by_sums(x, gradients, 0.1, *constants)
        state = x, np.zeros((2, 3)), np.zeros((2, 3))
        for step, grad_x in enumerate(gradients, 1):
            state = impl.adam_step(state[0], grad_x, *state[1:], step, 0.1, *given)
            assert_close(state[0], expected[step - 1])


# --- rotations ---------------------------------------------------------------------------------

@exercise("9.4")
def test_a_product_on_paper(impl):
    """A term is left out, or its sign is wrong, or elements are multiplied one by one."""
    got = impl.quaternion_product(np.array([1.0, 2.0, 3.0, 4.0]), np.array([5.0, 6.0, 7.0, 8.0]))
    # 5 - 12 - 21 - 32; 6 + 10 + 24 - 28; 7 + 15 + 24 - 16; 8 + 20 + 14 - 18.
    assert_close(got, np.array([-60.0, 12.0, 30.0, 24.0]))


@exercise("9.4")
def test_the_table_of_products(impl):
    """A sign, or the order of the two: i j = k and j i = -k."""
    for row, p in zip(PRODUCTS, "1ijk", strict=True):
        for product, q in zip(row, "1ijk", strict=True):
            assert_close(impl.quaternion_product(unit(p), unit(q)), unit(product))


@exercise("9.4")
def test_products_are_those_of_matrices(impl, rng):
    """Right for units alone."""
    p, q = rng.normal(size=4), rng.normal(size=4)
    assert_close(as_complex(impl.quaternion_product(p, q)), as_complex(p) @ as_complex(q))


@exercise("9.4")
def test_products_of_many(impl, rng):
    """Right for one pair alone; or shapes do not broadcast."""
    p, q = rng.normal(size=(5, 1, 4)), rng.normal(size=(2, 1, 3, 4))
    got = impl.quaternion_product(p, q)
    assert_equal(got.shape, (2, 5, 3, 4))
    assert_close(as_complex(got), as_complex(p) @ as_complex(q))


@exercise("9.5")
def test_quarter_rotations_on_paper(impl):
    """It rotates the other way, by half or twice the angle, or right for length 1 alone; or the
    scalar is taken for the last.
    """
    about_x = impl.quaternion_matrix(np.array([1.0, 1.0, 0.0, 0.0]))
    about_y = impl.quaternion_matrix(np.array([1.0, 0.0, 1.0, 0.0]))
    about_z = impl.quaternion_matrix(np.array([1.0, 0.0, 0.0, 1.0]))
    point = np.array([2.0, 3.0, 5.0, 1.0])
    assert_close(about_x @ point, np.array([2.0, -5.0, 3.0, 1.0]))
    assert_close(about_y @ point, np.array([5.0, 3.0, -2.0, 1.0]))
    assert_close(about_z @ point, np.array([-3.0, 2.0, 5.0, 1.0]))


@exercise("9.5")
@pytest.mark.parametrize("length", [1.0, 0.01, 300.0, -1.0])
def test_rotations_are_scipys_for_any_length(impl, rng, length):
    """q is taken to have length 1; or the matrix is scaled, too."""
    q = rng.normal(size=4)
    expected = np.eye(4)
    expected[:3, :3] = rotation(q).as_matrix()
    assert_close(impl.quaternion_matrix(length * q / np.linalg.norm(q)), expected)


@exercise("9.5")
@pytest.mark.parametrize("w", [3.0, -1.0])
def test_no_rotation_is_the_identity(impl, w):
    """By way of an axis, which a rotation by 0 has not: NaN."""
    assert_close(impl.quaternion_matrix(np.array([w, 0.0, 0.0, 0.0])), np.eye(4))


@exercise("9.6")
def test_an_elements_gradient_on_paper(impl):
    """The length's share is left out: (0, 0, 0, 4) / 5; or a sign."""
    grad_matrix = np.zeros((4, 4))
    grad_matrix[0, 1] = -5.0  # by 2 (x y - w z) / |q|^2, the only element that is not 0
    got = impl.quaternion_matrix_backward(grad_matrix, np.array([2.0, 0.0, 0.0, 1.0]))
    assert_close(got, np.array([-1.2, 0.0, 0.0, 2.4]))
    # At (w, 0, 0, 0) the length has no share: dR = 2 / w [dx, dy, dz]x.
    grad_matrix[2, 0] = 3.0
    for w in 1.0, -2.0:
        got = impl.quaternion_matrix_backward(grad_matrix, np.array([w, 0.0, 0.0, 0.0]))
        assert_close(got, np.array([0.0, 0.0, -6.0, 10.0]) / w)


@exercise("9.6")
@pytest.mark.parametrize("length", [1.0, 0.1, 7.0])
def test_the_gradient_of_a_rotation_is_central_differences(impl, rng, length):
    """grad_matrix is transposed; or right for length 1 alone."""
    def forward(q):
        matrix = np.eye(4)
        matrix[:3, :3] = rotation(q).as_matrix()
        return matrix

    q = rng.normal(size=4)
    gradcheck(forward, impl.quaternion_matrix_backward, (length * q / np.linalg.norm(q),),
              name="quaternion_matrix")


@exercise("9.6")
def test_a_longer_q_is_the_same_rotation(impl, rng):
    """The gradient has a share along q; or the constant row and column have one."""
    q, grad_matrix = rng.normal(size=4), rng.normal(size=(4, 4))
    got = impl.quaternion_matrix_backward(grad_matrix, q)
    assert_close(got @ q, 0.0)
    constant = grad_matrix.copy()
    constant[3], constant[:, 3] = 9.0, -9.0
    assert_close(impl.quaternion_matrix_backward(constant, q), got)


@exercise("9.7")
def test_angles_on_paper(impl):
    """Half of the angle; or q and -q are two rotations."""
    still, half = np.array([1.0, 0.0, 0.0, 0.0]), np.array([0.0, 0.0, 0.0, 1.0])
    third = np.array([0.5, 0.5, 0.5, 0.5])  # by 120 degrees about the diagonal
    for p, q, degrees in ((still, half, 180.0), (still, third, 120.0), (third, -still, 120.0),
                          (third, third, 0.0), (third, -third, 0.0), (half, third, 120.0)):
        assert_close(impl.rotation_angle(p, q), np.radians(degrees))


@exercise("9.7")
def test_angles_are_scipys(impl, rng):
    """Right from or to no rotation alone; or shapes do not broadcast."""
    p, q = rng.normal(size=(5, 1, 4)), rng.normal(size=(3, 4))
    p, q = (x / np.linalg.norm(x, axis=-1, keepdims=True) for x in (p, q))
    expected = [[(rotation(a[0]) * rotation(b).inv()).magnitude() for b in q] for a in p]
    assert_close(impl.rotation_angle(p, q), np.array(expected))


@exercise("9.7", fine_print=True)
@pytest.mark.parametrize("angle", [0.05, 0.01, 0.003, 1e-5, 1e-9])
def test_small_angles_keep_their_digits(impl, rng, angle):
    """An arccos, near 1: all angles under 1e-8 come out as 0; or a first term is taken for all."""
    axis = rng.normal(size=3)
    small = np.append(np.cos(angle / 2), np.sin(angle / 2) * axis / np.linalg.norm(axis))
    assert_close(impl.rotation_angle(np.array([1.0, 0.0, 0.0, 0.0]), small), angle, atol=1e-15)
    assert_close(impl.rotation_angle(-small, np.array([1.0, 0.0, 0.0, 0.0])), angle, atol=1e-15)


# --- silhouettes -------------------------------------------------------------------------------

@exercise("9.7", fine_print=True)
@pytest.mark.parametrize("short", [1e-3, 1e-6])
def test_angles_near_pi_keep_their_digits(impl, rng, short):
    """An arcsin, near 1: the slope of it is infinite there."""
    axis = rng.normal(size=3)
    large = np.append(np.sin(short / 2), np.cos(short / 2) * axis / np.linalg.norm(axis))
    still = np.array([1.0, 0.0, 0.0, 0.0])
    assert_close(np.pi - impl.rotation_angle(still, large), short, atol=1e-14)


@exercise("9.8")
def test_silhouettes_on_paper(impl):
    """It is the overlap and not the loss; or the union counts the overlap twice."""
    coverage, target = np.array([[1.0, 1.0, 1.0, 0.0]]), np.array([[0.0, 1.0, 1.0, 1.0]])
    assert_close(impl.silhouette_loss(coverage, np.array([[0.0, 0.0, 1.0, 0.0]])), 2 / 3)
    assert_close(impl.silhouette_loss(coverage, target), 0.5)


@exercise("9.8")
def test_the_loss_is_0_for_the_same_and_1_for_apart(impl):
    """The loss does not know its ends; or pixels that neither covers count."""
    here, there = np.zeros((4, 6)), np.zeros((4, 6))
    here[1:3, 0:2], there[1:3, 3:6] = 1.0, 1.0
    assert_close(impl.silhouette_loss(here, here), 0.0)
    assert_close(impl.silhouette_loss(here, there), 1.0)


@exercise("9.8")
def test_pixels_covered_in_part_count_in_part(impl, rng):
    """Coverage is rounded; or max and min take the place of sum and product."""
    half = np.full((2, 3), 0.5)
    assert_close(impl.silhouette_loss(half, half), 2 / 3)
    coverage, target = rng.random((3, 5)), rng.random((3, 5))
    assert_close(impl.silhouette_loss(coverage, target), pixel_by_pixel(coverage, target))


@exercise("9.8")
def test_sums_are_over_all_pixels_at_once(impl, rng):
    """A mean of the losses of rows, channels or views."""
    share = np.array([0.1, 1.0])[:, None, None] * [[0.3], [1.0], [0.6]] * [1.0, 0.2, 0.5, 0.9]
    coverage, target = share * rng.random((2, 3, 4)), rng.random((2, 3, 4))
    assert_close(impl.silhouette_loss(coverage, target), pixel_by_pixel(coverage, target))


@exercise("9.9")
def test_silhouette_gradients_on_paper(impl):
    """The union is held fixed: pixels outside of the target then have no gradient."""
    coverage, target = np.array([[1.0, 1.0, 0.5, 0.0]]), np.array([[0.0, 1.0, 1.0, 0.0]])
    # A = 1.5, U = 3: inside -1 / 3, outside A / U^2 = 1 / 6.
    expected = np.array([[1 / 6, -1 / 3, -1 / 3, 1 / 6]])
    assert_close(impl.silhouette_loss_backward(1.0, coverage, target), expected)
    assert_close(impl.silhouette_loss_backward(-12.0, coverage, target), -12 * expected)


@exercise("9.9")
def test_the_gradient_of_silhouettes_is_central_differences(impl, rng):
    """Right where every pixel is covered, or none is, and wrong between."""
    def forward(coverage, target):
        neither = ((1 - coverage) * (1 - target)).sum()
        return 1 - (coverage * target).sum() / (coverage.size - neither)

    shape = 2, 3, 4  # unequal slices: no mean over rows or channels is the same
    coverage = rng.random(shape) * np.array([0.1, 1.0])[:, None, None]
    target = np.where(rng.random(shape) < 0.5, rng.random(shape), 1)
    gradcheck(forward, impl.silhouette_loss_backward, (coverage, target), differentiable=[0],
              name="silhouette_loss")


# --- the regularizer ---------------------------------------------------------------------------

@exercise("9.10")
def test_a_path_on_paper(impl):
    """The sign; the neighbours' sum for their mean; or each edge counts for one end alone. C is
    taken for 3; or += counts a vertex that is named twice only once (see np.add.at).
    """
    got = impl.uniform_laplacian(np.array([[1.0], [4.0], [9.0]]), np.array([[1, 0], [1, 2]]))
    assert_close(got, np.array([[-3.0], [-1.0], [5.0]]))


@exercise("9.10")
@pytest.mark.parametrize("channels", [1, 2, 5])
def test_each_vertex_and_the_mean_of_its_neighbours(impl, rng, channels):
    """A mean over all vertices' largest valence; a vertex of no edge; C is taken for 3."""
    positions = rng.normal(size=(6, channels))
    expected = np.zeros((6, channels))
    for v, neighbours in enumerate(NEIGHBOURS):
        if neighbours:
            expected[v] = positions[v] - sum(positions[n] for n in neighbours) / len(neighbours)
    assert_close(impl.uniform_laplacian(positions, EDGES), expected)


@exercise("9.10")
def test_where_the_mesh_lies_makes_no_difference(impl, rng):
    """A vertex's own share is too large or too small by its valence."""
    positions = rng.normal(size=(6, 3))
    moved = positions + np.array([10.0, -20.0, 30.0])
    moved[5] = positions[5]
    expected = averaging(6) @ positions
    assert_close(impl.uniform_laplacian(moved, EDGES), expected, atol=1e-11)


@exercise("9.11")
def test_a_path_backward_on_paper(impl):
    """The forward again: the share is divided by the other end's valence."""
    path = np.array([[0, 1], [1, 2]])
    for grad, expected in (([8, 4, 0], [6, -4, -2]), ([8, 0, 0], [8, -8, 0]),
                           ([0, 8, 0], [-4, 8, -4])):
        grad = np.array(grad, float)[:, None]
        got = impl.uniform_laplacian_backward(grad, np.zeros((3, 1)), path)
        assert_close(got, np.array(expected, float)[:, None])


@exercise("9.11")
@pytest.mark.parametrize("channels", [1, 2, 5])
def test_it_is_the_transposed_matrix(impl, rng, channels):
    """A vertex of no edge gets a gradient; or C is taken for 3; or += counts a vertex that is named
    twice only once (see np.add.at).
    """
    grad = rng.normal(size=(6, channels))
    got = impl.uniform_laplacian_backward(grad, rng.normal(size=(6, channels)), EDGES)
    assert_close(got, averaging(6).T @ grad)


@exercise("9.11")
def test_the_gradient_of_the_laplacian_is_central_differences(impl, rng):
    """Right for a regular mesh alone, whose matrix is symmetric."""
    matrix = averaging(6)
    gradcheck(lambda x, edges: matrix @ x, impl.uniform_laplacian_backward,
              (rng.normal(size=(6, 3)), EDGES), differentiable=[0], name="uniform_laplacian")
