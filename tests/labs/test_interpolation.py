"""What the exercises of lab 5 must do."""
from pathlib import Path

import numpy as np
import pytest

from labkit.checks import assert_close, assert_equal, assert_picture, exercise

GOLDEN = Path(__file__).parents[1] / "golden" / "interpolate.npz"
each_golden = pytest.mark.parametrize(
    "scene", ["soup_64x64", "two_cubes_80x48", "cube_with_seams_64x64"])

# A picture of two rows and three columns, with four faces of six vertices:
#   row 1:  face 2, none, face 0
#   row 0:  face 0, face 2, face 1        vertex 5 and face 3, the last one, are not seen
FACES = np.array([[0, 1, 2], [2, 1, 3], [4, 2, 0], [5, 5, 5]])
FACE_INDEX = np.array([[0, 2, 1], [2, -1, 0]])
WEIGHTS = np.array([[[0.5, 0.3, 0.2], [0.7, 0.2, 0.1], [0.2, 0.5, 0.3]],
                    [[0.1, 0.6, 0.3], [7.0, 8.0, 9.0], [0.3, 0.6, 0.1]]])
ATTRIBUTES = np.array([[8.0, 1.0], [4.0, -2.0], [10.0, 3.0], [16.0, -1.0], [-8.0, 4.0],
                       [99.0, 97.0]])


def chosen_picture(rng, channels):
    """(attributes, faces, face_index, weights) of a picture 7 high and 5 wide, some of it empty,
    and the picture (7, 5, channels).

    The picture is drawn, and the weights are found for it, so nothing here says how to mix. Weights
    stand at empty pixels, too.
    """
    faces = 3 * rng.integers(0, 4, (13, 3)) + rng.permuted([[0, 1, 2]] * 13, axis=1)
    face_index = np.maximum(rng.integers(-4, 12, (7, 5)), -1)
    three = 4 * np.tile(np.eye(3), (4, 1)) + rng.uniform(-1, 1, (12, 3))  # no face's is singular
    more, picture = rng.normal(size=(3, channels)), rng.normal(size=(7, 5, 3))
    corners = three[faces[face_index]].swapaxes(2, 3)
    weights = np.linalg.solve(corners, picture[..., None])[..., 0]
    picture[face_index < 0] = 0.0
    return (three @ more, faces, face_index, weights), picture @ more


def golden(scene):
    """{name: array} of a scene in 64 bits, and the weights and derivatives of all three corners.

    given: what a report says of it.
    """
    arrays = np.load(GOLDEN)
    of = {key.split("/")[1]: arrays[key] for key in arrays if key.startswith(f"{scene}/")}
    of = {key: array.astype(int if array.dtype.kind == "i" else float) for key, array in of.items()}
    of["given"] = f"scene {scene} of tests/golden/interpolate.npz"
    of["weights"] = np.append(of["uv"], 1 - of["uv"].sum(-1, keepdims=True), -1)
    of["all_derivatives"] = np.append(of["derivatives"],
                                      -of["derivatives"].sum(2, keepdims=True), 2)
    return of


def by_uv(grad_weights):
    """The weights are u, v and 1 - u - v: the gradient by u and v."""
    return grad_weights[:, :, :2] - grad_weights[:, :, 2:]


# --- along a segment ---------------------------------------------------------------------------

@exercise("5.1")
def test_halfway_on_the_screen_is_a_quarter_of_the_way(impl):
    """t comes back as it is: the perspective is left out. w_0 and w_1 are exchanged. A factor w_0,
    t or 1 - t is left out of the numerator or the denominator, or the division. Or it is measured
    from the other end.
    """
    w_0 = np.array([2.0, 1.0, 3.0, 5.0, 2.0, 4.0])
    got = impl.fraction_in_space(np.array([0.0, 0.25, 0.5, 0.75, 0.9, 1.0]), w_0, 3 * w_0)
    assert_close(got, [0.0, 0.1, 0.25, 0.5, 0.75, 1.0])


@exercise("5.1")
def test_of_equal_w_nothing_is_corrected(impl):
    """A factor w too many."""
    t = np.linspace(0, 1, 7)
    assert_close(impl.fraction_in_space(t, 2.5, 2.5), t)


@exercise("5.1")
def test_a_point_of_the_segment_is_found_again(impl, rng):
    """The point at fraction q in space, projected to the screen, is not found at q. Or w is taken
    to be positive: abs or a guard against a small w spoils it where both are negative.
    """
    q = rng.uniform(0, 1, 30)
    x, w = rng.uniform(-3, 3, (2, 30)), rng.uniform(0.2, 5, (2, 30))
    s_0, s_1 = x / w  # a pinhole at the origin, its screen at w = 1
    s = (x[0] + q * (x[1] - x[0])) / (w[0] + q * (w[1] - w[0]))
    t = (s - s_0) / (s_1 - s_0)
    for sign in 1, -1:
        assert_close(impl.fraction_in_space(t, sign * w[0], sign * w[1]), q, rtol=1e-6, atol=1e-8)


@exercise("5.2")
def test_attributes_along_a_segment_on_paper(impl):
    """One division is missing: of a_0 and a_1 by their w, or of the sum by the interpolated 1/w.
    Or the attributes are linear on the screen, without perspective, or the ends are exchanged.
    """
    t, (a_0, a_1) = np.array([0.0, 0.25, 0.5, 0.75, 0.9]), np.array([[10.0, 30.0], [20.0, -10.0]])
    # 0, 1/10, 1/4, 1/2 and 3/4 of the way in space
    expected = [[10.0, 30.0], [11.0, 26.0], [12.5, 20.0], [15.0, 10.0], [17.5, 0.0]]
    assert_close(impl.attribute_on_segment(t, a_0, a_1, 2.0, 6.0), expected)


@exercise("5.2")
def test_equal_ends_stay_equal(impl, rng):
    """The sum of the weights is not 1: a colour that both ends have gets lighter between them."""
    a = rng.normal(size=4)
    got = impl.attribute_on_segment(rng.uniform(0, 1, 6), a, a, 0.3, 2.0)
    assert_close(got, np.tile(a, (6, 1)))


@exercise("5.2")
def test_an_attribute_is_what_stands_at_the_point_in_space(impl, rng):
    """The ends' w are swapped: the corrected attribute bends the wrong way."""
    q, x, w = rng.uniform(0, 1, 20), rng.uniform(-3, 3, 2), np.array([0.7, 4.1])
    a = rng.normal(size=(2, 3))
    s = (x[0] + q * (x[1] - x[0])) / (w[0] + q * (w[1] - w[0]))
    t = (s - x[0] / w[0]) / (x[1] / w[1] - x[0] / w[0])
    expected = a[0] + q[:, None] * (a[1] - a[0])
    assert_close(impl.attribute_on_segment(t, *a, *w), expected, rtol=1e-6, atol=1e-8)
    assert_close(impl.attribute_on_segment(t, *a, *-w), expected, rtol=1e-6, atol=1e-8)


# --- corrected barycentrics --------------------------------------------------------------------

@exercise("5.3")
def test_corrected_weights_on_paper(impl):
    """w multiplies instead of dividing, or is not used. The weights do not sum to 1, or e is
    divided by its sum before w divides it. The sum runs over several pixels: use axis=-1 and
    keepdims=True.
    """
    e = np.array([[0.5, 0.5, 0.0], [0.25, 0.25, 0.5], [2.0, 8.0, 25.0], [5.0, 6.0, 16.0]])
    w = np.array([[2.0, 6.0, 3.0], [2.0, 4.0, 8.0], [2.0, 4.0, 5.0], [5.0, 2.0, 4.0]])
    expected = np.array([[6, 2, 0], [4, 2, 2], [1, 2, 5], [1, 3, 4]]) / 8
    assert_close(impl.barycentric_from_screen(e, w), expected)


@exercise("5.3")
def test_any_multiple_of_the_weights_gives_the_same(impl, rng):
    """e is taken to have the sum 1, or to be positive: abs, or a guard against a small sum as in
    np.maximum, spoils negative weights. Or the sum runs over several pixels.
    """
    w, b = rng.uniform(0.1, 1, (4, 5, 3)), rng.dirichlet(np.ones(3), (4, 5))
    for factor in 1.0, 1e-9, -7.0:
        got = [impl.barycentric_from_screen(factor * b * w, w),
               impl.barycentric_from_screen(b * w, factor * w)]
        assert_close(np.array(got), [b, b])


def matrix_and_edges(rng, count):
    """Corners x, y of either winding and w, one of them behind the camera now and then:
    M (count, 3, 3) with columns w (x, y, 1); samples (count, 3); edge functions e and w (count, 3).
    """
    x, y, px, py = rng.uniform(0, 8, (4, count, 3))
    w = rng.uniform(0.5, 3, (count, 3)) * rng.choice([1, 1, 1, -1], (count, 3))
    sample = np.stack([px[:, 0], py[:, 0], np.ones(count)], -1)
    m = np.stack([w * x, w * y, w], 1)
    e = np.stack([(y[:, i] - y[:, j]) * (sample[:, 0] - x[:, i])
                  + (x[:, j] - x[:, i]) * (sample[:, 1] - y[:, i])
                  for i, j in ((1, 2), (2, 0), (0, 1))], -1)
    return m, sample, e, w


@exercise("5.3")
def test_edge_functions_are_the_rows_of_the_inverse(impl, rng):
    """b is not M^-1 (x, y, 1) divided by its sum: the ray through the pixel meets another point."""
    m, sample, e, w = matrix_and_edges(rng, 60)
    got = impl.barycentric_from_screen(e, w)
    x, y, depth = (m @ got[..., None])[..., 0].T
    assert_close(np.stack([x / depth, y / depth, got.sum(-1)], -1), sample, rtol=1e-6, atol=1e-6)


# --- a picture's barycentrics -------------------------------------------------------------------

def one_face(w, width, height):
    """clip (3, 4) of a face with a corner at the centre of pixel 0, 0, and its legs 8 pixels long.

    At the centre of the pixel in row i and column j, e is 8 - j - i, j, i.
    """
    x, y = np.array([[0.5, 8.5, 0.5], [0.5, 0.5, 8.5]])
    return np.stack([2 * x / width - 1, 2 * y / height - 1, 0 * x, 1 + 0 * x], -1) * w[:, None]


def faces_in_sight(rng, signs=(1,)):
    """face_index (5, 7), clip, faces. Of the point that each pixel sees, b (5, 7, 3) and w (5, 7),
    and how far from its ray the three corners are, x and y times their w (5, 7, 2, 3).

    b is drawn, and so is the face, but for x and y of its last corner, which are found for b. Where
    no face is seen, b and w are 0. No corner is near the camera plane, nor a face thin.
    """
    b, w = rng.uniform(0.2, 1, (35, 3)), rng.uniform(0.5, 2, (35, 3)) * rng.choice(signs, (35, 3))
    b /= b.sum(1, keepdims=True)
    away = rng.uniform(1, 2, (35, 2, 3)) * rng.choice([-1, 1], (35, 2, 1))
    away[:, 1, 0] *= -1
    away[:, :, 2] = -(b[:, None] * away)[..., :2].sum(2) / b[:, 2:]
    row, column = np.indices((5, 7)).reshape(2, 35, 1)
    x, y = away[:, 0] + w * ((2 * column + 1) / 7 - 1), away[:, 1] + w * ((2 * row + 1) / 5 - 1)
    face_index, order = rng.permutation(35), rng.permutation(105)
    faces = order.argsort().reshape(35, 3)[face_index.argsort()]
    face_index[rng.random(35) < 0.3] = -1
    b[face_index < 0] = 0.0
    return (face_index.reshape(5, 7), np.stack([x, y, 0 * w, w], -1).reshape(-1, 4)[order], faces,
            b.reshape(5, 7, 3), (b * w).sum(1).reshape(5, 7), away.reshape(5, 7, 2, 3))


SOME = np.full((5, 8), -1)  # four pixels of a picture see the face
SOME[[2, 4, 1, 0], [5, 2, 2, 6]] = 0


@exercise("5.6")
def test_halfway_on_the_screen_is_not_halfway_on_the_face(impl):
    """Nothing is divided by w: these are the picture's weights, without perspective. Or it is
    multiplied by w, or divided by another corner's. It is not divided by the sum s, or by that of e
    alone, or s is over the samples.
    """
    # With w = 1, 2, 4, c is 8 - j - i, j / 2, i / 4.
    clip = one_face(np.array([1.0, 2.0, 4.0]), 8, 5)
    b = impl.barycentrics(SOME, clip, np.array([[0, 1, 2]]))
    assert_close(b[[2, 4, 1, 0], [5, 2, 2, 6]],
                 [[0.25, 0.625, 0.125], [0.5, 0.25, 0.25], [0.8, 0.16, 0.04], [0.4, 0.6, 0.0]])


@exercise("5.6")
def test_a_pixel_sees_the_point_of_its_face_on_its_ray(impl, rng):
    """Pixels, faces or corners are mixed up, or the weights do not sum to 1."""
    face_index, clip, faces, b, *_ = faces_in_sight(rng)
    got, seen = impl.barycentrics(face_index, clip, faces), face_index >= 0
    assert_close(got[seen], b[seen], rtol=1e-6, atol=1e-9)


@exercise("5.6")
def test_where_no_face_is_seen_all_weights_are_zero(impl, rng):
    """-1 is used as an index, which puts the last face there; or the picture has another shape."""
    face_index, clip, faces, *_ = faces_in_sight(rng)
    b = impl.barycentrics(face_index, clip, faces)
    assert_equal(b.shape, (5, 7, 3))
    assert_equal(b[face_index < 0], np.zeros(((face_index < 0).sum(), 3)))
    assert_equal(b[face_index >= 0].any(-1).all(), True, given="some weight where a face is seen")


@exercise("5.6", fine_print=True)
def test_weights_are_right_behind_the_camera(impl, rng):
    """|w| divides, or weights are made positive."""
    face_index, clip, faces, b, *_ = faces_in_sight(rng, (1, 1, -1))
    assert_close(impl.barycentrics(face_index, clip, faces), b, rtol=1e-6, atol=1e-9)


@exercise("5.6", fine_print=True)
def test_a_corner_near_infinity_leaves_the_weights_as_they_are(impl):
    """`edge_function` measures from a corner, and its rounding error is as large as the corner is
    far away. Measure from the sample, as the given `edge_functions_at` does.
    """
    clip = np.array([[-0.225, -0.7, 0, 1], [-1.1, 0.7, 0, 3e-10], [0.975, 2.775, 0, 3]])
    face_index = np.full((8, 8), -1)
    face_index[[6, 3, 3], [0, 1, 2]] = 0
    b = impl.barycentrics(face_index, clip, np.array([[0, 1, 2]]))
    assert_close(b[[6, 3, 3], [0, 1, 2]], [  # eq. (3) in Python's fractions, without rounding
        [0.355713199847303, 0.542690651189981, 0.101596148962716],
        [0.626775721038477, 0.332759362915981, 0.0404649160455425],
        [0.690934546722211, 0.235211760599422, 0.073853692678367]])


# --- the quotient rule --------------------------------------------------------------------------

@exercise("5.4")
def test_weights_change_by_the_quotient_rule_on_paper(impl):
    """The second term, - b ds, is missing (s as a constant), added instead of subtracted, without
    b, or ds is not the sum of dc. It is not divided by s, or by s^2, or multiplied by s.
    """
    b, s = np.array([[0.25, 0.5], [0.25, 0.125], [0.5, 0.375]]), np.array([4.0, 2.0])
    db = impl.normalize_derivative(np.array([[10.0, -3.0], [0.0, 4.0], [6.0, 7.0]]), b, s)
    assert_close(db, [[1.5, -3.5], [-1.0, 1.5], [-0.5, 2.0]])


@exercise("5.4")
def test_a_change_of_any_size_counts_alike(impl):
    """A finite difference in the place of eq. (4), which is linear in dc: a large step leaves the
    tangent, and a small one is lost in rounding.
    """
    b, s = np.array([0.25, 0.25, 0.5]), np.array(4.0)
    for size in 1e9, 1e-9:
        db = impl.normalize_derivative(size * np.array([10.0, 0.0, 6.0]), b, s)
        assert_close(db / size, [1.5, -1.0, -0.5])


@exercise("5.4")
@pytest.mark.parametrize("axis", [0, -1])
def test_the_change_is_that_of_b(impl, rng, axis):
    """The sum is taken over the samples, not over the three weights: axis says where these are. Or
    axis is ignored.
    """
    c, dc = rng.uniform(0.5, 2, (2, 3, 7)) if axis == 0 else rng.uniform(0.5, 2, (2, 5, 2, 3))
    s = c.sum(axis, keepdims=True)
    moved = c + 1e-20j * dc  # a complex step: its difference loses no digits
    expected = (moved / moved.sum(axis, keepdims=True)).imag / 1e-20
    assert_close(impl.normalize_derivative(dc, c / s, s[0] if axis == 0 else s, axis), expected)


QUOTIENT_GRADS = np.array([[8.0, 10.0, 20.0, 10.0], [0.0, 20.0, 10.0, -10.0],
                           [16.0, 30.0, -10.0, 20.0]])
QUOTIENTS = np.array([[0.125, 0.6, 0.1, 0.2], [0.25, 0.3, 0.6, 0.3], [0.625, 0.1, 0.3, 0.5]])
SUMS = np.array([8.0, 10.0, 20.0, 5.0])
# grad_b . b is 11, 15, 5 and 9
SUM_GRADS = np.array([[-3.0, -5.0, 15.0, 1.0], [-11.0, 5.0, 5.0, -19.0],
                      [5.0, 15.0, -15.0, 11.0]]) / SUMS


@exercise("5.5")
def test_the_gradient_of_a_quotient_on_paper(impl):
    """s is taken for constant: the quotient rule's second term is left out, or added instead of
    subtracted. In it b is left out or stands outside of the sum, the sum is a mean, or the axis is
    wrong. 1/s is left out, or squared.
    """
    assert_close(impl.normalize_backward(QUOTIENT_GRADS, QUOTIENTS, SUMS), SUM_GRADS)


@exercise("5.5")
def test_the_weights_may_lie_along_another_axis(impl):
    """The axis is ignored: the sum always runs over axis 0, over all numbers, or loses its axis,
    without keepdims=True.
    """
    got = impl.normalize_backward(QUOTIENT_GRADS.T, QUOTIENTS.T, SUMS[:, None], axis=-1)
    assert_close(got, SUM_GRADS.T)


def check_quotients(impl, gradcheck, n, axis, more):
    """The gradients of n / s, with s `more` than the sum of n."""
    def total(n):
        return n.sum(axis, keepdims=True) + more

    def backward(grad_b, n):
        return impl.normalize_backward(grad_b, n / total(n), total(n), axis)

    gradcheck(lambda n: n / total(n), backward, (n,), name="normalize")


@exercise("5.5")
@pytest.mark.parametrize("axis", [0, -1])
def test_the_gradients_of_quotients_are_central_differences(impl, rng, axis, gradcheck):
    """Sums run over the samples instead of the three weights."""
    n = rng.uniform(0.5, 2, (3, 4) if axis == 0 else (4, 2, 3)) * rng.choice([-1, 1])
    check_quotients(impl, gradcheck, n, axis, more=0.0)


@exercise("5.5")
def test_the_weights_need_not_sum_to_1(impl, rng, gradcheck):
    """b_0 + b_1 + b_2 is taken for 1."""
    check_quotients(impl, gradcheck, rng.uniform(0.5, 2, (3, 4)), 0, more=0.3)


# --- one pixel, there and back -------------------------------------------------------------------

ONE = np.array([4, 2, 0]), np.array([0.7, 0.2, 0.1])  # the corners of pixel 0, 1 below, and b


@exercise("5.7")
def test_a_pixel_mixes_its_three_corners(impl):
    """The corners are averaged, or the weights stand in reverse order. The first three attributes
    are mixed, whatever the corners are.
    """
    assert_close(impl.interpolate_pixel(ATTRIBUTES, *ONE), [-2.8, 3.5])


@exercise("5.7")
def test_a_pixel_has_as_many_attributes_as_the_vertices(impl, rng):
    """One channel, or three. Or weights are divided by their sum: they are used as they are."""
    for channels in 1, 4:
        attributes, b = rng.normal(size=(7, channels)), rng.normal(size=3)
        expected = b[0] * attributes[5] + b[1] * attributes[1] + b[2] * attributes[3]
        assert_close(impl.interpolate_pixel(attributes, np.array([5, 1, 3]), b), expected)


@exercise("5.10")
def test_a_pixel_gives_to_its_three_corners(impl):
    """The weights are left out of grad_attributes, or grad of grad_b. Gradients stand at the first
    three vertices, or there are three of them alone.
    """
    got = impl.interpolate_pixel_backward(np.array([10.0, -30.0]), ATTRIBUTES, *ONE)
    grad_attributes = np.zeros((6, 2))
    grad_attributes[[4, 2, 0]] = [[7.0, -21.0], [2.0, -6.0], [1.0, -3.0]]
    assert_close(got, (grad_attributes, [-200.0, 10.0, 50.0]))


@exercise("5.10")
def test_a_corner_that_comes_twice_gets_both_shares(impl):
    """The second share overwrites the first, or `+=` with an array of indices adds once."""
    attributes = np.array([[3.0], [5.0]])
    grad_attributes, grad_b = impl.interpolate_pixel_backward(
        np.array([10.0]), attributes, np.array([1, 0, 1]), np.array([0.5, 0.3, 0.2]))
    assert_close(grad_attributes, [[3.0], [7.0]])
    assert_close(grad_b, [50.0, 30.0, 50.0])


@exercise("5.10")
def test_the_gradients_of_a_pixel_are_central_differences(impl, rng, gradcheck):
    """The sum over the channels is a mean, or of the first channel alone."""
    corners = np.array([2, 0, 4])

    def forward(attributes, b):
        return sum(b[k] * attributes[vertex] for k, vertex in enumerate(corners))

    def backward(grad, attributes, b):
        return impl.interpolate_pixel_backward(grad, attributes, corners, b)

    gradcheck(forward, backward, (rng.normal(size=(5, 3)), rng.normal(size=3)),
              name="interpolate_pixel")


# --- whole pictures ----------------------------------------------------------------------------

PICTURE = np.array([[[7.2, 0.5], [-2.8, 3.5], [8.8, -0.7]],
                    [[7.6, 2.5], [0.0, 0.0], [5.8, -0.6]]])
GRAD_OUTPUT = np.array([[[4.0, 6.0], [1.0, -3.0], [2.0, -4.0]],
                        [[8.0, 4.0], [99.0, 97.0], [-6.0, 1.0]]])
GRAD_ATTRIBUTES = np.array([[2.7, 4.2], [-1.4, 0.4], [5.6, 2.3], [0.6, -1.2], [1.5, -1.7],
                            [0.0, 0.0]])
GRAD_WEIGHTS = np.array([[[38.0, 4.0, 58.0], [-20.0, 1.0, 5.0], [8.0, 16.0, 36.0]],
                         [[-48.0, 92.0, 68.0], [0.0, 0.0, 0.0], [-47.0, -26.0, -57.0]]])


@exercise("5.8")
def test_a_picture_of_six_pixels(impl):
    """A corner is left out, or the corners, or i and j, are in another order. Attributes are read
    at the number of the face, not at its vertices in faces. Face 0 is taken for none.
    """
    got = impl.interpolate(ATTRIBUTES, FACES, FACE_INDEX, WEIGHTS)
    seen = FACE_INDEX >= 0
    assert_close(got[seen], PICTURE[seen])


@exercise("5.8")
def test_an_empty_pixel_is_zero(impl):
    """-1 is taken for a face: NumPy counts it from the end, and draws the last one. Or where no
    pixel sees a face: an error, or another shape.
    """
    assert_picture(impl.interpolate(ATTRIBUTES, FACES, FACE_INDEX, WEIGHTS), PICTURE, atol=1e-12)
    got = impl.interpolate(ATTRIBUTES, FACES, np.full((2, 3), -1), WEIGHTS)
    assert_picture(got, np.zeros((2, 3, 2)))


@exercise("5.8")
@pytest.mark.parametrize("channels", [1, 3, 6])
def test_any_number_of_attributes(impl, rng, channels):
    """Three channels only, or the weights are mixed with the channels. Or the weights are divided
    by their sum, or clipped: they are used as they are.
    """
    given, picture = chosen_picture(rng, channels)
    assert_picture(impl.interpolate(*given), picture, atol=1e-12)


@exercise("5.8")
@each_golden
def test_attributes_are_those_of_nvdiffrast(impl, scene):
    """uv of their own faces, many attributes, slivers: within what 32 bits allow."""
    of = golden(scene)
    got = impl.interpolate(of["attributes"], of["faces"], of["face_index"], of["weights"])
    assert_picture(got, of["output"], of["given"], atol=2e-6)


@exercise("5.11")
def test_the_weights__gradients_of_six_pixels(impl):
    """grad_output, or the sum over the channels, is left out, or the corners are in another order.
    A mean is subtracted, as if the weights had to sum to 1. -1 is used as an index.
    """
    got = impl.interpolate_backward(GRAD_OUTPUT, ATTRIBUTES, FACES, FACE_INDEX, WEIGHTS)
    assert_close(got[1], GRAD_WEIGHTS)


@exercise("5.11")
def test_the_attributes__gradients_of_six_pixels(impl):
    """A vertex that several pixels see keeps one gradient, or the mean: grad[vertex] += ... adds
    only once. The weights are left out. -1 is used as an index, of the last face.
    """
    got = impl.interpolate_backward(GRAD_OUTPUT, ATTRIBUTES, FACES, FACE_INDEX, WEIGHTS)
    assert_close(got[0], GRAD_ATTRIBUTES)


@exercise("5.11")
def test_an_empty_pixel_pulls_at_nothing(impl):
    """The gradient at the background flows to the last face, as -1 is used as an index."""
    got = impl.interpolate_backward(GRAD_OUTPUT, ATTRIBUTES, FACES, np.full((2, 3), -1), WEIGHTS)
    assert_close(got, (np.zeros((6, 2)), np.zeros((2, 3, 3))))


@exercise("5.11")
@pytest.mark.parametrize("channels", [1, 3, 6])
def test_every_channel_adds_to_the_weights(impl, rng, channels):
    """grad_barycentric is the mean of the channels, or of the first channel alone."""
    given, picture = chosen_picture(rng, channels)
    grad = rng.normal(size=picture.shape)
    grad_weights = impl.interpolate_backward(grad, *given)[1]
    # A picture is linear in its weights, so the product with them is that of both pictures.
    assert_close((grad_weights * given[3]).sum(2), (grad * picture).sum(2))


@exercise("5.11")
def test_every_pixel_adds_to_its_vertices(impl, rng):
    """A vertex keeps the gradient of one pixel alone, or the weights are left out."""
    (attributes, *where), picture = chosen_picture(rng, 4)
    grad = rng.normal(size=picture.shape)
    got = impl.interpolate_backward(grad, rng.normal(size=attributes.shape), *where)[0]
    # It is linear in the attributes, too, and each channel with each other one tells.
    assert_close(got.T @ attributes, np.einsum("ijc,ijd->cd", grad, picture))


@exercise("5.11")
@each_golden
def test_gradients_are_those_of_nvdiffrast(impl, scene):
    """Sums over many pixels, by u and v of the weights u, v, 1 - u - v."""
    of = golden(scene)
    grad_attributes, grad_weights = impl.interpolate_backward(
        of["grad_output"], of["attributes"], of["faces"], of["face_index"], of["weights"])
    assert_close(grad_attributes, of["grad_attributes"], of["given"], rtol=0, atol=3e-5)
    assert_close(by_uv(grad_weights), of["grad_uv"], of["given"], rtol=0, atol=3e-6)


# --- footprints --------------------------------------------------------------------------------

@exercise("5.9")
def test_the_weights_change_by_the_quotient_rule(impl):
    """s is taken for constant, or de is not divided by w, or by the wrong one. x and y are
    exchanged, one of them has the wrong sign, or they are not the last axis.
    """
    # With w = 1, 2, 4, c is 8 - j - i, j / 2, i / 4, and s = 4 where i = 2 and j = 5.
    clip = one_face(np.array([1.0, 2.0, 4.0]), 8, 5)
    db = impl.barycentrics_derivatives(SOME, clip, np.array([[0, 1, 2]]))
    assert_close(db[2, 5], np.array([[-56.0, -52.0], [52.0, 30.0], [4.0, 22.0]]) / 256)


@exercise("5.9")
def test_the_changes_of_the_weights_sum_to_zero(impl, rng):
    """The sum of the weights is 1, everywhere. Or the term of s has the wrong sign, or no b."""
    face_index, clip, faces, *_ = faces_in_sight(rng)
    db = impl.barycentrics_derivatives(face_index, clip, faces)
    assert_equal(db.shape, (5, 7, 3, 2))
    assert_equal(db[face_index < 0], np.zeros(((face_index < 0).sum(), 3, 2)))
    assert_close(db.sum(2), np.zeros((5, 7, 2)))
    assert (np.abs(db[face_index >= 0]).max((1, 2)) > 1e-3).all(), "all are 0"


@exercise("5.9")
def test_a_pixel_to_the_side_sees_the_next_point_of_the_face(impl, rng):
    """Right only without perspective, or for one face. The steps are not of a pixel, as for a
    derivative by ndc.
    """
    check_steps(impl, *faces_in_sight(rng))


@exercise("5.9", fine_print=True)
def test_the_derivatives_are_right_behind_the_camera(impl, rng):
    """|w| divides."""
    check_steps(impl, *faces_in_sight(rng, (1, 1, -1)))


def check_steps(impl, face_index, clip, faces, _, w, away):
    """A step of a pixel takes the point of the face as far to the side as the ray goes: so many of
    ndc, times its w.
    """
    db = impl.barycentrics_derivatives(face_index, clip, faces)
    assert_close(away @ db, w[..., None, None] * np.diag([2 / 7, 2 / 5]), rtol=1e-6, atol=1e-9)
