"""What the exercises of lab 9 must do."""
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from labkit.checks import assert_close, assert_equal, exercise, parts

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

def two(returned):
    """A loss and its gradient."""
    return parts(returned, "the loss", "its gradient")


PICTURE = np.array([[[2.0, 0.0, 6.0, 0.0], [8.0, 6.5, 6.0, 8.0], [5.0, 15.0, -0.5, 9.5]]])
DIFFERENCE = np.array([[[1.0, -2.0, 3.0, -5.0], [4.0, 6.0, -1.0, 2.0], [-4.0, 7.0, -3.0, 8.0]]])


@exercise("9.1")
def test_the_loss_is_the_mean_square_on_paper(impl):
    """It is the sum, or the mean is over pixels and the channels are summed, or a root is drawn.
    Differences are not squared, or only their size counts. The gradient comes first.
    """
    loss, _ = two(impl.squared_error(PICTURE, PICTURE - DIFFERENCE))
    assert_close(loss, 19.5)  # 234 / 12


@exercise("9.1")
def test_every_difference_pulls_by_twice_its_share(impl):
    """The factor 2 is missing. The sign is wrong. The difference is still squared, or only its sign
    is left. It is not divided by the number of values, or by that of pixels without the channels.
    """
    _, grad_picture = two(impl.squared_error(PICTURE, PICTURE - DIFFERENCE))
    assert_close(grad_picture, DIFFERENCE / 6)  # 2 / 12 values


@exercise("9.1")
def test_the_gradient_of_the_error_is_central_differences(impl, rng, gradcheck):
    """It is divided by another number than that of all values: pixels times channels."""
    def forward(picture, target):
        return np.mean([(picture[p] - target[p])**2 for p in np.ndindex(picture.shape)])

    gradcheck(forward, lambda grad, *given: grad * two(impl.squared_error(*given))[1],
              (rng.random((3, 5, 2)), rng.random((3, 5, 2))), differentiable=[0],
              name="squared_error")


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


# x, g, m, s; step, rate; b1, b2, epsilon
STEP = (np.array([5.0, -1.0, 2.0, 7.0]), np.array([2.0, -4.0, 10.0, -8.0]),
        np.array([4.0, 8.0, -2.0, 12.0]), np.array([5.0, 10.0, 15.0, 20.0]), 2, 0.5,
        (0.75, 0.6, 0.0))
NEW_MEAN = np.array([3.5, 5.0, 1.0, 7.0])         # m' = 3/4 m + 1/4 g
NEW_SQUARE = np.array([4.6, 12.4, 49.0, 37.6])    # s' = 0.6 s + 0.4 g^2


def three(returned):
    """x', m', s' of what was returned."""
    return parts(returned, "x", "mean", "square")


@exercise("9.4")
def test_the_new_mean_keeps_b1_of_the_old_one(impl):
    """Output 2 is m'. It is m^, already corrected, or the old m. b1 and 1 - b1 are exchanged, 1 -
    b1 is left out, or b1 and b2 are swapped. The constants that are given are not used. Outputs
    come in another order.
    """
    _, mean, _ = three(impl.adam_step(*STEP))
    assert_close(mean, NEW_MEAN)


@exercise("9.4")
def test_the_new_square_keeps_b2_of_the_old_one(impl):
    """Output 3 is s'. g is not squared, or m is. It is s^, already corrected, or the old s. b2 and
    1 - b2 are exchanged, 1 - b2 is left out, or b1 and b2 are swapped.
    """
    _, _, square = three(impl.adam_step(*STEP))
    assert_close(square, NEW_SQUARE)


@exercise("9.4")
def test_the_first_step_is_by_the_rate(impl):
    """Uphill: the minus is missing. The bias correction of m, of s or of both is missing: steps of
    0.1, 32 or 3.2 rates. Or it multiplies, or has b1 and b2 swapped. The root of s^, rate or x is
    missing. The old m or s makes the step. n is one too large, as n + 1.
    """
    x, zero = np.array([[1.0, 2.0, 3.0, 4.0]]), np.zeros((1, 4))
    x, _, _ = three(impl.adam_step(x, np.array([[1e-3, -7.0, 1e4, -0.3]]), zero, zero, 1, 0.5))
    assert_close(x, [[0.5, 2.5, 2.5, 4.5]], atol=1e-5)


@exercise("9.4")
def test_a_later_step_is_corrected_by_its_number(impl):
    """The corrections are 1 - b^n: here n is left out, or multiplies b, or is one too small. Or g
    makes the step, not m^.
    """
    x, _, _ = three(impl.adam_step(*STEP))
    # m^ = m' / (1 - 9/16), s^ = s' / (1 - 0.36).
    assert_close(x, STEP[0] - 0.5 * (16 / 7 * NEW_MEAN) / np.sqrt(NEW_SQUARE / 0.64))


@exercise("9.4")
def test_epsilon_is_added_to_the_root(impl):
    """epsilon is under the root, is added before the correction of s, or is left out: then 0 is
    divided by 0.
    """
    x, grad_x, zero = np.ones(4), np.array([3.0, -1.0, 8.0, 0.0]), np.zeros(4)
    x, _, _ = three(impl.adam_step(x, grad_x, zero, zero, 1, 0.5, (0.9, 0.999, 2.0)))
    assert_close(x, [0.7, 7 / 6, 0.6, 1.0])  # by 0.5 g / (|g| + 2)


@exercise("9.4")
def test_many_steps_are_sums_over_all_gradients(impl, rng):
    """The defaults are others than 0.9, 0.999 and 1e-8. What a step returns is no good for the next
    one.
    """
    gradients, x = rng.normal(size=(6, 2, 3)), rng.normal(size=(2, 3))
    for given, constants in ((), (0.9, 0.999, 1e-8)), (((0.8, 0.95, 1e-3),), (0.8, 0.95, 1e-3)):
        expected = adam_by_sums(x, gradients, 0.1, *constants)
        state = x, np.zeros((2, 3)), np.zeros((2, 3))
        for step, grad_x in enumerate(gradients, 1):
            state = three(impl.adam_step(state[0], grad_x, *state[1:], step, 0.1, *given))
            assert_close(state[0], expected[step - 1])


# --- rotations ---------------------------------------------------------------------------------

@exercise("9.9")
def test_a_product_on_paper(impl):
    """The order of p and q is swapped, or the cross product has the other sign. The squares of i, j
    and k count as +1 in w. Elements are multiplied one by one. w is taken for the last number. A
    term is left out, or has the wrong sign.
    """
    got = impl.quaternion_product(np.array([1.0, 2.0, 3.0, 4.0]), np.array([5.0, 6.0, 7.0, 8.0]))
    # 5 - 12 - 21 - 32; 6 + 10 + 24 - 28; 7 + 15 + 24 - 16; 8 + 20 + 14 - 18.
    assert_close(got, [-60.0, 12.0, 30.0, 24.0])


@exercise("9.9")
def test_the_table_of_products(impl):
    """A sign is wrong: i i = -1, i j = k, j i = -k. Or the order of p and q is swapped."""
    for row, p in zip(PRODUCTS, "1ijk", strict=True):
        for product, q in zip(row, "1ijk", strict=True):
            assert_close(impl.quaternion_product(unit(p), unit(q)), unit(product))


@exercise("9.9")
def test_products_are_those_of_matrices(impl, rng):
    """It is right for 1, i, j and k alone. For others a term is missing or counts twice."""
    p, q = rng.normal(size=4), rng.normal(size=4)
    assert_close(as_complex(impl.quaternion_product(p, q)), as_complex(p) @ as_complex(q))


@exercise("9.9")
def test_products_of_many(impl, rng):
    """It takes one pair alone: the four numbers are those along the first axis, or shapes do not
    broadcast.
    """
    p, q = rng.normal(size=(5, 1, 4)), rng.normal(size=(2, 1, 3, 4))
    got = impl.quaternion_product(p, q)
    assert_equal(got.shape, (2, 5, 3, 4))
    assert_close(as_complex(got), as_complex(p) @ as_complex(q))


def in_homogeneous(matrix):
    """A matrix (3, 3), given as its rows, as one of (4, 4)."""
    whole = np.eye(4)
    whole[:3, :3] = matrix
    return whole


@exercise("9.8")
def test_a_rotation_on_paper(impl):
    """It rotates the other way: the matrix is transposed. It is q v without q*. w is taken for the
    last number. The identity, K K (K * K is another), w or a factor 2 is missing. The last row and
    column are missing: it is not (4, 4).
    """
    got = impl.quaternion_matrix(np.array([2.0, 4.0, 5.0, 6.0]) / 9)  # of length 1
    rows = np.array([[-41.0, 16.0, 68.0], [64.0, -23.0, 44.0], [28.0, 76.0, -1.0]]) / 81
    assert_close(got, in_homogeneous(rows))


@exercise("9.8")
def test_a_q_of_another_length_is_the_same_rotation(impl):
    """q is not divided by its length. Or K and K K, or q v q*, are divided by |q|, not by |q|^2."""
    got = impl.quaternion_matrix(np.array([1.0, 2.0, 3.0, 4.0]))  # |q|^2 = 30
    rows = np.array([[-20.0, 4.0, 22.0], [20.0, -10.0, 20.0], [10.0, 28.0, 4.0]]) / 30
    assert_close(got, in_homogeneous(rows))


@exercise("9.8")
@pytest.mark.parametrize("axis, rows", [
    ("x", [[1, 0, 0], [0, 0, -1], [0, 1, 0]]), ("y", [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    ("z", [[0, -1, 0], [1, 0, 0], [0, 0, 1]])], ids=["x", "y", "z"])
def test_a_quarter_turn_about_an_axis(impl, axis, rows):
    """It rotates the other way, or by half or twice the angle. Two axes are exchanged."""
    q = UNITS[0] + UNITS["wxyz".index(axis)]
    assert_close(impl.quaternion_matrix(q), in_homogeneous(rows))


@exercise("9.8")
@pytest.mark.parametrize("length", [1.0, 0.01, 300.0, -1.0])
def test_rotations_are_those_of_scipy_for_any_length(impl, rng, length):
    """q is taken to have length 1, or the matrix is scaled, too."""
    q = rng.normal(size=4)
    got = impl.quaternion_matrix(length * q / np.linalg.norm(q))
    assert_close(got, in_homogeneous(rotation(q).as_matrix()))


@exercise("9.8")
@pytest.mark.parametrize("w", [3.0, -1.0])
def test_no_rotation_is_the_identity(impl, w):
    """The axis is divided by its length, which is 0 here: NaN."""
    assert_close(impl.quaternion_matrix(np.array([w, 0.0, 0.0, 0.0])), np.eye(4))


@exercise("9.10")
def test_an_element__s_gradient_on_paper(impl):
    """|q|^2 is taken for a constant, or the division by the length is left out. grad_matrix is
    transposed. K K is derived like K times a constant. The gradient by w, or by x, y, z, is missing
    or has the wrong sign.
    """
    grad_matrix = np.zeros((4, 4))
    grad_matrix[0, 1] = 225.0  # by 2 (x y - w z) / |q|^2, which is 4 / 30 at this q
    got = impl.quaternion_matrix_backward(grad_matrix, np.array([1.0, 2.0, 3.0, 4.0]))
    # 225 * 2 (-z, y, x, -w) / 30 = (-60, 45, 30, -15), and the length's share: -2 q.
    assert_close(got, [-62.0, 41.0, 24.0, -23.0])


@exercise("9.10")
@pytest.mark.parametrize("w", [1.0, -2.0])
def test_without_rotation_the_length_has_no_share(impl, w):
    """A factor w is missing or is one too many. x, y or z gets the gradient of another one."""
    grad_matrix = np.zeros((4, 4))
    grad_matrix[0, 1], grad_matrix[2, 0], grad_matrix[2, 1] = -5.0, 3.0, 7.0
    got = impl.quaternion_matrix_backward(grad_matrix, np.array([w, 0.0, 0.0, 0.0]))
    # dR = 2 / w times the cross matrix of (dx, dy, dz).
    assert_close(got, np.array([0.0, 14.0, -6.0, 10.0]) / w)


@exercise("9.10")
@pytest.mark.parametrize("length", [1.0, 0.1, 7.0])
def test_the_gradient_of_a_rotation_is_central_differences(impl, rng, length, gradcheck):
    """It is right for length 1 alone: for others, a factor |q| or |q|^2 is missing."""
    def forward(q):
        matrix = np.eye(4)
        matrix[:3, :3] = rotation(q).as_matrix()
        return matrix

    q = rng.normal(size=4)
    gradcheck(forward, impl.quaternion_matrix_backward, (length * q / np.linalg.norm(q),),
              name="quaternion_matrix")


@exercise("9.10")
def test_a_longer_q_is_the_same_rotation(impl, rng):
    """The gradient has a share along q. Or the last row and column, which are constant, have a
    share in it.
    """
    q, grad_matrix = rng.normal(size=4), rng.normal(size=(4, 4))
    got = impl.quaternion_matrix_backward(grad_matrix, q)
    assert_close(got @ q, 0.0)
    constant = grad_matrix.copy()
    constant[3], constant[:, 3] = 9.0, -9.0
    assert_close(impl.quaternion_matrix_backward(constant, q), got)


@exercise("9.11")
def test_angles_on_paper(impl):
    """Half of the angle, or degrees. q and -q are taken for two rotations: the absolute value of
    p . q is missing. It is the angle of p q, without the conjugate. The arccos of a number above 1
    is NaN. Only one pair is taken.
    """
    still, half = np.array([1.0, 0.0, 0.0, 0.0]), np.array([0.0, 0.0, 0.0, 1.0])
    third = np.array([0.5, 0.5, 0.5, 0.5])  # by 120 degrees about the diagonal
    sixth = np.array([np.sqrt(0.75), 0.5, 0.0, 0.0])  # by 60 degrees about x
    p = np.array([still, still, third, third, third, half, sixth])
    q = np.array([half, third, -still, third, -third, third, -still])
    degrees = np.array([180.0, 120.0, 120.0, 0.0, 0.0, 120.0, 60.0])
    assert_close(impl.rotation_angle(p, q), np.radians(degrees))


@exercise("9.11")
def test_angles_are_those_of_scipy(impl, rng):
    """Only w is looked at, or only rotations from p or q to none. Or shapes do not broadcast."""
    p, q = rng.normal(size=(5, 1, 4)), rng.normal(size=(3, 4))
    p, q = (x / np.linalg.norm(x, axis=-1, keepdims=True) for x in (p, q))
    expected = [[(rotation(a[0]) * rotation(b).inv()).magnitude() for b in q] for a in p]
    assert_close(impl.rotation_angle(p, q), np.array(expected))


@exercise("9.11", fine_print=True)
@pytest.mark.parametrize("angle", [0.05, 0.01, 0.003, 1e-5, 1e-9])
def test_small_angles_keep_their_digits(impl, rng, angle):
    """An arccos loses the digits near 1: all angles under 1e-8 come out as 0. Or a series is broken
    off too early.
    """
    axis = rng.normal(size=3)
    small = np.append(np.cos(angle / 2), np.sin(angle / 2) * axis / np.linalg.norm(axis))
    assert_close(impl.rotation_angle(np.array([1.0, 0.0, 0.0, 0.0]), small), angle, atol=1e-15)
    assert_close(impl.rotation_angle(-small, np.array([1.0, 0.0, 0.0, 0.0])), angle, atol=1e-15)


# --- silhouettes -------------------------------------------------------------------------------

@exercise("9.11", fine_print=True)
@pytest.mark.parametrize("short", [1e-3, 1e-6])
def test_angles_near_pi_keep_their_digits(impl, rng, short):
    """An arcsin loses the digits near 1, where its slope is infinite."""
    axis = rng.normal(size=3)
    large = np.append(np.sin(short / 2), np.cos(short / 2) * axis / np.linalg.norm(axis))
    still = np.array([1.0, 0.0, 0.0, 0.0])
    assert_close(np.pi - impl.rotation_angle(still, large), short, atol=1e-14)


COVERAGE = np.array([[1.0, 1.0, 0.5], [0.0, 0.5, 0.0]])
TARGET = np.array([[0.5, 1.0, 1.0], [0.0, 0.0, 1.0]])


def loss_of(impl, coverage, target):
    """The first of the two outputs."""
    return two(impl.silhouette_loss(coverage, target))[0]


@exercise("9.5")
def test_silhouettes_on_paper(impl):
    """It is the overlap, not 1 minus it. The union is c + t and counts the overlap twice, or not at
    all, or has a number added. It is the Dice loss, or a mean of the ratios of pixels or rows, not
    the ratio of the sums. c and t are rounded to 0 or 1.
    """
    assert_close(loss_of(impl, COVERAGE, TARGET), 5 / 9)  # 1 - 2 / 4.5


@exercise("9.5")
def test_the_loss_is_0_for_the_same_and_1_for_apart(impl):
    """Pixels that neither covers count. Or what is not 0 or 1 is the loss of silhouettes that are
    the same, or apart.
    """
    here, there = np.zeros((4, 6)), np.zeros((4, 6))
    here[1:3, 0:2], there[1:3, 3:6] = 1.0, 1.0
    assert_close(loss_of(impl, here, here), 0.0)
    assert_close(loss_of(impl, here, there), 1.0)


@exercise("9.5")
def test_pixels_covered_in_part_count_in_part(impl, rng):
    """The minimum and the maximum of c and t take the place of the product c t and of c + t - c t.
    Or coverage is rounded to 0 and 1.
    """
    half = np.full((2, 3), 0.5)
    assert_close(loss_of(impl, half, half), 2 / 3)
    coverage, target = rng.random((3, 5)), rng.random((3, 5))
    assert_close(loss_of(impl, coverage, target), pixel_by_pixel(coverage, target))


@exercise("9.5")
def test_sums_are_over_all_pixels_at_once(impl, rng):
    """It is the mean of the losses of rows, channels or views, not one ratio of sums."""
    share = np.array([0.1, 1.0])[:, None, None] * [[0.3], [1.0], [0.6]] * [1.0, 0.2, 0.5, 0.9]
    coverage, target = share * rng.random((2, 3, 4)), rng.random((2, 3, 4))
    assert_close(loss_of(impl, coverage, target), pixel_by_pixel(coverage, target))


@exercise("9.5")
def test_silhouette_gradients_on_paper(impl):
    """The sign is the overlap's, or one in the quotient rule is wrong. U or A is taken for a
    constant, or is each pixel's. The union's derivative is 1 - t, not 1: c t is in it. It is
    divided by U, not by U^2. coverage and target are exchanged.
    """
    _, grad_coverage = two(impl.silhouette_loss(COVERAGE, TARGET))
    # A = 2, U = 4.5: (A (1 - t) - U t) / U^2 = (8 - 26 t) / 81.
    assert_close(-81 * grad_coverage, [[5.0, 18.0, 18.0], [-8.0, -8.0, 18.0]])


@exercise("9.5")
def test_the_gradient_of_silhouettes_is_central_differences(impl, rng, gradcheck):
    """It is right where each pixel is covered or not, and wrong between. Or rows or channels have
    ratios of their own.
    """
    shape = 2, 3, 4  # unequal slices: no mean over rows or channels is the same
    coverage = rng.random(shape) * np.array([0.1, 1.0])[:, None, None]
    target = np.where(rng.random(shape) < 0.5, rng.random(shape), 1)
    gradcheck(pixel_by_pixel, lambda grad, *given: grad * two(impl.silhouette_loss(*given))[1],
              (coverage, target), differentiable=[0], name="silhouette_loss")


@exercise("9.5", fine_print=True)
def test_two_empty_silhouettes_are_the_same(impl):
    """0 / 0: one view in which nothing is seen, and nothing should be, makes a fit's loss NaN, or
    ends the fit.
    """
    got = two(impl.silhouette_loss(np.zeros((2, 3)), np.zeros((2, 3))))
    assert_close(got, (0.0, np.zeros((2, 3))))


# --- the regularizer ---------------------------------------------------------------------------

PAIRS = np.array([[0, 1], [2, 1], [2, 0], [3, 2], [1, 3]])  # of valence 2, 3, 3, 2
RHOMBUS = np.array([[6.0, 0.0], [0.0, 12.0], [3.0, 9.0], [12.0, 3.0]])


@exercise("9.6")
def test_four_vertices_on_paper(impl):
    """The sign is wrong. The neighbours are summed, not averaged, or divided by another's valence.
    Edges count for one of their ends alone, in one direction. += counts a vertex that is named
    twice only once (see np.add.at). x is left out, or its own neighbour.
    """
    expected = [[4.5, -10.5], [-7.0, 8.0], [-3.0, 4.0], [10.5, -7.5]]
    assert_close(impl.uniform_laplacian(RHOMBUS, PAIRS), expected)


@exercise("9.6")
def test_a_vertex_without_edges_has_0(impl):
    """It keeps its position, as it is subtracted from no mean; or 0 is divided by 0."""
    positions = np.array([[3.0, 1.0], [7.0, 5.0], [1.0, 4.0], [2.0, 6.0]])
    expected = [[2.0, -3.0], [0.0, 0.0], [-2.0, 3.0], [0.0, 0.0]]
    assert_close(impl.uniform_laplacian(positions, np.array([[2, 0]])), expected)


@exercise("9.6")
@pytest.mark.parametrize("channels", [1, 2, 5])
def test_each_vertex_and_the_mean_of_its_neighbours(impl, rng, channels):
    """All are divided by one valence. The last row is left out where its vertex is in no edge. C is
    taken for 3.
    """
    positions = rng.normal(size=(6, channels))
    assert_close(impl.uniform_laplacian(positions, EDGES), averaging(6) @ positions)


@exercise("9.6")
def test_where_the_mesh_lies_makes_no_difference(impl, rng):
    """A vertex's own share is not 1: its weights and those of its neighbours do not cancel."""
    positions = rng.normal(size=(6, 3))
    moved = positions + np.array([10.0, -20.0, 30.0])
    moved[5] = positions[5]
    assert_close(impl.uniform_laplacian(moved, EDGES), averaging(6) @ positions, atol=1e-11)


@exercise("9.7")
def test_four_vertices_backward_on_paper(impl):
    """It is the forward again, divided by the receiver's valence; the matrix must be transposed.
    Neighbours get the whole gradient. += counts a vertex that is named twice only once (see
    np.add.at). Its own gradient is left out, or a sign is wrong. Edges count for one end alone.
    """
    got = impl.uniform_laplacian_backward(RHOMBUS, np.zeros((4, 2)), PAIRS)
    # Each gives a half, or a third, of its gradient to its neighbours.
    assert_close(got, [[5.0, -7.0], [-10.0, 7.5], [-6.0, 3.5], [11.0, -4.0]])


@exercise("9.7")
def test_a_vertex_without_edges_gets_0(impl):
    """It keeps its gradient, where d is 0 whatever its position; or 0 is divided by 0."""
    grad = np.array([[3.0, 1.0], [7.0, 5.0], [1.0, 4.0], [2.0, 6.0]])
    got = impl.uniform_laplacian_backward(grad, np.zeros((4, 2)), np.array([[2, 0]]))
    assert_close(got, [[2.0, -3.0], [0.0, 0.0], [-2.0, 3.0], [0.0, 0.0]])


@exercise("9.7")
@pytest.mark.parametrize("channels", [1, 2, 5])
def test_it_is_the_transposed_matrix(impl, rng, channels):
    """It is right for a mesh whose vertices have one valence alone. The last row is left out where
    its vertex is in no edge. C is taken for 3.
    """
    grad = rng.normal(size=(6, channels))
    got = impl.uniform_laplacian_backward(grad, rng.normal(size=(6, channels)), EDGES)
    assert_close(got, averaging(6).T @ grad)


@exercise("9.7")
def test_the_gradient_of_the_laplacian_is_central_differences(impl, rng, gradcheck):
    """It is right for a regular mesh alone, whose matrix is symmetric."""
    matrix = averaging(6)
    gradcheck(lambda x, edges: matrix @ x, impl.uniform_laplacian_backward,
              (rng.normal(size=(6, 3)), EDGES), differentiable=[0], name="uniform_laplacian")
