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


def buffers(rng, channels, trailing=()):
    """attributes, faces, face_index and weights of a picture 7 high and 5 wide, some of it empty.

    Weights stand at empty pixels, too. Faces repeat a vertex here and there.
    """
    faces = rng.integers(0, 11, (13, 3))
    face_index = np.maximum(rng.integers(-4, 12, (7, 5)), -1)
    weights = rng.normal(size=(7, 5, 3, *trailing))
    return rng.normal(size=(11, channels)), faces, face_index, weights


def mixed(attributes, faces, face_index, weights):
    """Eq. (5), from its definition. weights (H, W, 3) or, of derivatives, (H, W, 3, 2)."""
    output = np.zeros((*face_index.shape, attributes.shape[1], *weights.shape[3:]))
    for i, j in np.ndindex(face_index.shape):
        if face_index[i, j] >= 0:
            corners = attributes[faces[face_index[i, j]]]
            output[i, j] = np.tensordot(corners, weights[i, j], (0, 0))
    return output


def unmixed(grad_output, attributes, faces, face_index, weights):
    """The gradients of `mixed` by attributes and weights, as the definition says."""
    grad_attributes, grad_weights = np.zeros(attributes.shape), np.zeros(weights.shape)
    for i, j in np.ndindex(face_index.shape):
        for k in range(3 if face_index[i, j] >= 0 else 0):
            vertex = faces[face_index[i, j], k]
            grad_weights[i, j, k] = np.tensordot(attributes[vertex], grad_output[i, j], (0, 0))
            grad_attributes[vertex] += (grad_output[i, j] * weights[i, j, k]).reshape(
                attributes.shape[1], -1).sum(1)
    return grad_attributes, grad_weights


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

@exercise("5.2")
def test_halfway_on_the_screen_is_a_quarter_of_the_way(impl):
    """t comes back as it is: the perspective is left out. w_0 and w_1 are exchanged. A factor w_0,
    t or 1 - t is left out of the numerator or the denominator, or the division. Or it is measured
    from the other end.
    """
    w_0 = np.array([2.0, 1.0, 3.0, 5.0, 2.0, 4.0])
    got = impl.fraction_in_space(np.array([0.0, 0.25, 0.5, 0.75, 0.9, 1.0]), w_0, 3 * w_0)
    assert_close(got, [0.0, 0.1, 0.25, 0.5, 0.75, 1.0])


@exercise("5.2")
def test_of_equal_w_nothing_is_corrected(impl):
    """A factor w too many."""
    t = np.linspace(0, 1, 7)
    assert_close(impl.fraction_in_space(t, 2.5, 2.5), t)


@exercise("5.2")
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


def fraction(t, w_0, w_1):
    """Eq. (1), by way of 1/w."""
    return t / w_1 / ((1 - t) / w_0 + t / w_1)


@exercise("5.3")
def test_gradients_of_the_fraction_on_paper(impl):
    """The denominator is taken for constant: the quotient rule's second term, -u dv, is missing. Or
    it is not squared. w_1's gradient has the wrong sign, or is exchanged with w_0's. A factor, as
    w_1, 1 - t or grad_q, is left out.
    """
    # v = 4, 5, 5, 4, so grad_q / v^2 = 1, 2, 4, -2
    got = impl.fraction_in_space_backward(
        np.array([16.0, 50.0, 100.0, -32.0]), np.array([0.5, 0.25, 0.75, 0.5]),
        np.array([2.0, 2.0, 4.0, 5.0]), np.array([6.0, 6.0, 8.0, 3.0]))
    assert_close(got, ([12.0, 24.0, 128.0, -30.0], [1.5, 2.25, 6.0, -1.5],
                       [-0.5, -0.75, -3.0, 2.5]))


@exercise("5.3")
def test_both_w_grow_alike_and_nothing_happens(impl, rng):
    """w_0 dq/dw_0 + w_1 dq/dw_1 = 0, for eq. (1) holds the ratio of the two alone."""
    grad_q, t, w_0, w_1 = rng.normal(size=9), *rng.uniform(0.1, 0.9, (3, 9))
    _, grad_w_0, grad_w_1 = impl.fraction_in_space_backward(grad_q, t, w_0, w_1)
    assert_close(w_0 * grad_w_0, -w_1 * grad_w_1)


@exercise("5.3")
def test_gradients_of_the_fraction_are_central_differences(impl, rng, gradcheck):
    """The gradient of t is missing a w, or grad_q is not multiplied in."""
    inputs = rng.uniform(0.05, 0.95, (2, 4)), *rng.uniform(0.5, 4, (2, 2, 4))
    gradcheck(fraction, impl.fraction_in_space_backward, inputs, name="fraction_in_space")


@exercise("5.4")
def test_attributes_along_a_segment_on_paper(impl):
    """One division is missing: of a_0 and a_1 by their w, or of the sum by the interpolated 1/w.
    Or the attributes are linear on the screen, without perspective, or the ends are exchanged.
    """
    t, (a_0, a_1) = np.array([0.0, 0.25, 0.5, 0.75, 0.9]), np.array([[10.0, 30.0], [20.0, -10.0]])
    # 0, 1/10, 1/4, 1/2 and 3/4 of the way in space
    expected = [[10.0, 30.0], [11.0, 26.0], [12.5, 20.0], [15.0, 10.0], [17.5, 0.0]]
    assert_close(impl.attribute_on_segment(t, a_0, a_1, 2.0, 6.0), expected)


@exercise("5.4")
def test_equal_ends_stay_equal(impl, rng):
    """The sum of the weights is not 1: a colour that both ends have gets lighter between them."""
    a = rng.normal(size=4)
    got = impl.attribute_on_segment(rng.uniform(0, 1, 6), a, a, 0.3, 2.0)
    assert_close(got, np.tile(a, (6, 1)))


@exercise("5.4")
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

@exercise("5.5")
def test_corrected_weights_on_paper(impl):
    """w multiplies instead of dividing, or is not used. The weights do not sum to 1, or e is
    divided by its sum before w divides it. The sum runs over several pixels: use axis=-1 and
    keepdims=True.
    """
    e = np.array([[0.5, 0.5, 0.0], [0.25, 0.25, 0.5], [2.0, 8.0, 25.0], [5.0, 6.0, 16.0]])
    w = np.array([[2.0, 6.0, 3.0], [2.0, 4.0, 8.0], [2.0, 4.0, 5.0], [5.0, 2.0, 4.0]])
    expected = np.array([[6, 2, 0], [4, 2, 2], [1, 2, 5], [1, 3, 4]]) / 8
    assert_close(impl.barycentric_from_screen(e, w), expected)


@exercise("5.5")
def test_any_multiple_of_the_weights_gives_the_same(impl, rng):
    """e is taken to have the sum 1, or to be positive: abs, or a guard against a small sum as in
    np.maximum, spoils negative weights. Or the sum runs over several pixels.
    """
    e, w = rng.uniform(0.1, 1, (2, 4, 5, 3))
    n = e / w
    expected = n / (n[..., :1] + n[..., 1:2] + n[..., 2:])
    assert_close(impl.barycentric_from_screen(e, w), expected)
    for factor in 1e-9, -7.0:
        got = [impl.barycentric_from_screen(factor * e, w),
               impl.barycentric_from_screen(e, factor * w)]
        assert_close(np.array(got), [expected, expected])


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


@exercise("5.5")
def test_edge_functions_are_the_rows_of_the_inverse(impl, rng):
    """b is not M^-1 (x, y, 1) divided by its sum: the ray through the pixel meets another point."""
    m, sample, e, w = matrix_and_edges(rng, 60)
    c = np.linalg.solve(m, sample[..., None])[..., 0]
    got = impl.barycentric_from_screen(e, w)
    assert_close(got, c / c.sum(-1, keepdims=True), rtol=1e-6, atol=1e-6)


QUOTIENT_GRADS = np.array([[8.0, 10.0, 20.0, 10.0], [0.0, 20.0, 10.0, -10.0],
                           [16.0, 30.0, -10.0, 20.0]])
QUOTIENTS = np.array([[0.125, 0.6, 0.1, 0.2], [0.25, 0.3, 0.6, 0.3], [0.625, 0.1, 0.3, 0.5]])
SUMS = np.array([8.0, 10.0, 20.0, 5.0])
# grad_b . b is 11, 15, 5 and 9
SUM_GRADS = np.array([[-3.0, -5.0, 15.0, 1.0], [-11.0, 5.0, 5.0, -19.0],
                      [5.0, 15.0, -15.0, 11.0]]) / SUMS


@exercise("5.6")
def test_the_gradient_of_a_quotient_on_paper(impl):
    """s is taken for constant: the quotient rule's second term is left out, or added instead of
    subtracted. In it b is left out or stands outside of the sum, the sum is a mean, or the axis is
    wrong. 1/s is left out, or squared.
    """
    assert_close(impl.normalize_backward(QUOTIENT_GRADS, QUOTIENTS, SUMS), SUM_GRADS)


@exercise("5.6")
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


@exercise("5.6")
@pytest.mark.parametrize("axis", [0, -1])
def test_the_gradients_of_quotients_are_central_differences(impl, rng, axis, gradcheck):
    """Sums run over the samples instead of the three weights."""
    n = rng.uniform(0.5, 2, (3, 4) if axis == 0 else (4, 2, 3)) * rng.choice([-1, 1])
    check_quotients(impl, gradcheck, n, axis, more=0.0)


@exercise("5.6", fine_print=True)
def test_the_weights_need_not_sum_to_1(impl, rng, gradcheck):
    """b_0 + b_1 + b_2 is taken for 1."""
    check_quotients(impl, gradcheck, rng.uniform(0.5, 2, (3, 4)), 0, more=0.3)


# --- pictures, pixel by pixel ------------------------------------------------------------------

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
    """-1 is used as an index, which draws the last face where no face is seen. A corner is left
    out, or overwrites the one before. Attributes are read at the number of the face, not at its
    vertices in faces. i and j, or the corners, are in another order.
    """
    got = impl.interpolate_loop(ATTRIBUTES, FACES, FACE_INDEX, WEIGHTS)
    assert_picture(got, PICTURE, atol=1e-12)


@exercise("5.8")
def test_an_empty_pixel_is_zero(impl):
    """-1 is taken for a face: NumPy counts it from the end, and draws the last one."""
    got = impl.interpolate_loop(ATTRIBUTES, FACES, np.full((2, 3), -1), WEIGHTS)
    assert_picture(got, np.zeros((2, 3, 2)))


@exercise("5.8")
@pytest.mark.parametrize("channels", [1, 4])
def test_any_number_of_attributes(impl, rng, channels):
    """Three channels only, or the weights are mixed with the channels. Or the weights are divided
    by their sum, or clipped: they are used as they are.
    """
    given = buffers(rng, channels)
    assert_picture(impl.interpolate_loop(*given), mixed(*given), atol=1e-12)


@exercise("5.9")
def test_the_gradients_of_six_pixels(impl):
    """A vertex that several pixels see keeps one gradient, or the mean: += with an array of indices
    adds only once. The weights, grad_output or the sum over the channels is left out. -1 is used as
    an index. A mean is subtracted, as if the weights had to sum to 1.
    """
    got = impl.interpolate_backward_loop(GRAD_OUTPUT, ATTRIBUTES, FACES, FACE_INDEX, WEIGHTS)
    assert_close(got, (GRAD_ATTRIBUTES, GRAD_WEIGHTS))


@exercise("5.9")
def test_an_empty_pixel_pulls_at_nothing(impl):
    """The gradient at the background flows to the last face, as -1 is used as an index."""
    got = impl.interpolate_backward_loop(GRAD_OUTPUT, ATTRIBUTES, FACES, np.full((2, 3), -1),
                                         WEIGHTS)
    assert_close(got, (np.zeros((6, 2)), np.zeros((2, 3, 3))))


@exercise("5.9")
@pytest.mark.parametrize("channels", [1, 4])
def test_every_channel_adds_to_the_weights(impl, rng, channels):
    """grad_barycentric is the mean of the channels, or of the first channel alone."""
    given = rng.normal(size=(7, 5, channels)), *buffers(rng, channels)
    assert_close(impl.interpolate_backward_loop(*given), unmixed(*given))


# --- whole pictures ----------------------------------------------------------------------------

@exercise("5.10")
def test_the_rows_of_six_pixels(impl):
    """start lacks its leading 0 or its last number, is not added up, or counts rows instead of
    three entries each. Entries come corner by corner instead of pixel by pixel. A pixel without a
    face has entries.
    """
    expected = ([0, 3, 6, 9, 12, 12, 15],
                [0, 1, 2,  4, 2, 0,  2, 1, 3,  4, 2, 0,  0, 1, 2],
                [0.5, 0.3, 0.2,  0.7, 0.2, 0.1,  0.2, 0.5, 0.3,  0.1, 0.6, 0.3,  0.3, 0.6, 0.1])
    assert_equal(impl.weight_rows(FACES, FACE_INDEX, WEIGHTS), expected)


@exercise("5.10")
def test_the_rows_of_an_empty_picture(impl):
    """start has one number for each pixel, not one more."""
    start, vertex, weight = impl.weight_rows(FACES, np.full((2, 3), -1), WEIGHTS)
    assert_equal(start, np.zeros(7, int))
    assert_equal((len(vertex), len(weight)), (0, 0))


@exercise("5.10")
def test_the_rows_make_the_matrix(impl, rng):
    """Pixels are numbered column by column, or entries are in another order than the corners."""
    _, faces, face_index, weights = buffers(rng, 1)
    start, vertex, weight = impl.weight_rows(faces, face_index, weights)
    for row, face in enumerate(face_index.ravel()):
        entries = slice(start[row], start[row + 1])
        expected = faces[face] if face >= 0 else np.zeros(0, int)
        assert_equal(vertex[entries], expected)
        expected = weights.reshape(-1, 3)[row] if face >= 0 else np.zeros(0)
        assert_close(weight[entries], expected)


@exercise("5.11")
def test_a_whole_picture_of_six_pixels(impl):
    """The pixels come out in another order, or the weights. -1 is used as an index, which draws the
    last face where no face is seen. Or face 0 is taken for none.
    """
    assert_picture(impl.interpolate(ATTRIBUTES, FACES, FACE_INDEX, WEIGHTS), PICTURE, atol=1e-12)


@exercise("5.11")
@pytest.mark.parametrize("channels", [1, 3, 6])
def test_a_whole_picture_is_that_of_the_definition(impl, rng, channels):
    """Three channels only, or the weights are divided by their sum, or the last face is drawn
    where no face is seen.
    """
    given = buffers(rng, channels)
    assert_picture(impl.interpolate(*given), mixed(*given), atol=1e-12)


@exercise("5.11")
def test_an_empty_picture(impl):
    """No pixel sees a face: an error, or another shape."""
    got = impl.interpolate(ATTRIBUTES, FACES, np.full((2, 3), -1), WEIGHTS)
    assert_close(got, np.zeros((2, 3, 2)))


@exercise("5.11")
@each_golden
def test_attributes_are_those_of_nvdiffrast(impl, scene):
    """uv of their own faces, many attributes, slivers: within what 32 bits allow."""
    of = golden(scene)
    got = impl.interpolate(of["attributes"], of["faces"], of["face_index"], of["weights"])
    assert_picture(got, of["output"], of["given"], atol=2e-6)


@exercise("5.12")
def test_the_gradients_of_a_whole_picture_of_six_pixels(impl):
    """grad[vertex] += ... adds only once for a vertex that several pixels see: np.add.at adds all.
    The weights are left out. The sum over the channels is a mean, or of one channel. -1 is used as
    an index, of the last face. The corners are in another order.
    """
    got = impl.interpolate_backward(GRAD_OUTPUT, ATTRIBUTES, FACES, FACE_INDEX, WEIGHTS)
    assert_close(got, (GRAD_ATTRIBUTES, GRAD_WEIGHTS))


@exercise("5.12")
@pytest.mark.parametrize("channels", [1, 3, 6])
def test_the_gradients_are_those_of_the_definition(impl, rng, channels):
    """The background's grad_output flows somewhere."""
    given = rng.normal(size=(7, 5, channels)), *buffers(rng, channels)
    assert_close(impl.interpolate_backward(*given), unmixed(*given))


@exercise("5.12")
def test_the_gradients_are_central_differences(impl, rng, gradcheck):
    """B for B^T, or the attributes of another corner."""
    gradcheck(mixed, impl.interpolate_backward, buffers(rng, 4), name="interpolate")


@exercise("5.12")
@each_golden
def test_gradients_are_those_of_nvdiffrast(impl, scene):
    """Sums over many pixels, by u and v of the weights u, v, 1 - u - v."""
    of = golden(scene)
    grad_attributes, grad_weights = impl.interpolate_backward(
        of["grad_output"], of["attributes"], of["faces"], of["face_index"], of["weights"])
    assert_close(grad_attributes, of["grad_attributes"], of["given"], rtol=0, atol=3e-5)
    assert_close(by_uv(grad_weights), of["grad_uv"], of["given"], rtol=0, atol=3e-6)


# --- footprints --------------------------------------------------------------------------------

# Two of four pixels see a face. Attributes have three channels.
SEEN = np.array([[1, -1], [-1, 2]])
COLOURS = np.append(ATTRIBUTES, [[2.0], [5.0], [-4.0], [8.0], [6.0], [95.0]], 1)
DERIVATIVES = np.full((2, 2, 3, 2), 7.0)
DERIVATIVES[0, 0] = [[-0.5, 0.3], [0.2, -0.7], [0.3, 0.4]]
DERIVATIVES[1, 1] = [[0.1, -0.4], [-0.6, 0.3], [0.5, 0.1]]


@exercise("5.13")
def test_the_footprints_of_two_pixels(impl):
    """dA/dx and dA/dy are exchanged, or both are by x, or one has the wrong sign. x and y are not
    the last axis but stand before the channels (J is transposed), or a reshape mixes them. Corner 2
    is left out. -1 is used as an index.
    """
    expected = np.zeros((2, 2, 3, 2))
    expected[0, 0] = [[0.6, 6.6], [-2.2, 1.9], [5.4, -1.5]]
    expected[1, 1] = [[-2.8, 7.0], [-0.9, -0.6], [4.0, -3.4]]
    assert_close(impl.interpolate_derivatives(COLOURS, FACES, SEEN, DERIVATIVES), expected)


@exercise("5.13")
@pytest.mark.parametrize("channels", [1, 2, 5])
def test_derivatives_are_mixed_as_the_weights_are(impl, rng, channels):
    """Attributes and directions are taken for each other where both are two."""
    given = buffers(rng, channels, trailing=(2,))
    assert_close(impl.interpolate_derivatives(*given), mixed(*given))


@exercise("5.13")
@each_golden
def test_derivatives_are_those_of_nvdiffrast(impl, scene):
    """dA/dx, dA/dy of some of the attributes."""
    of = golden(scene)
    got = impl.interpolate_derivatives(of["attributes"][:, of["chosen"]], of["faces"],
                                       of["face_index"], of["all_derivatives"])
    assert_close(got, of["output_derivatives"], of["given"], rtol=0, atol=2e-6)


@exercise("5.14")
def test_the_gradients_of_two_footprints(impl):
    """grad_attributes has only the part of x, that of y is left out: it is the sum of both, no
    mean. x and y are exchanged in one of the gradients, or only x is used, or they are not its last
    axis. -1 is used as an index.
    """
    grad_output = np.full((2, 2, 3, 2), 9.0)
    grad_output[0, 0] = [[2.0, 4.0], [8.0, -1.0], [3.0, 6.0]]
    grad_output[1, 1] = [[1.0, -2.0], [-3.0, 6.0], [4.0, 2.0]]
    grad_attributes = [[0.3, -0.9, 2.2], [-2.4, 2.3, -3.6], [-1.0, -0.7, -1.5],
                       [2.2, 2.0, 3.3], [0.9, -2.7, -0.4], [0.0, 0.0, 0.0]]
    grad_derivatives = np.zeros((2, 2, 3, 2))
    grad_derivatives[0, 0] = [[32.0, 13.0], [7.0, 48.0], [48.0, 113.0]]
    grad_derivatives[1, 1] = [[4.0, 52.0], [-15.0, -10.0], [13.0, -6.0]]
    got = impl.interpolate_derivatives_backward(grad_output, COLOURS, FACES, SEEN, DERIVATIVES)
    assert_close(got, (grad_attributes, grad_derivatives))


@exercise("5.14")
@pytest.mark.parametrize("channels", [1, 2, 5])
def test_the_gradients_of_footprints_are_those_of_the_definition(impl, rng, channels):
    """Attributes and directions are taken for each other, or the background pulls."""
    given = rng.normal(size=(7, 5, channels, 2)), *buffers(rng, channels, trailing=(2,))
    assert_close(impl.interpolate_derivatives_backward(*given), unmixed(*given))


@exercise("5.14")
def test_the_gradients_of_footprints_are_central_differences(impl, rng, gradcheck):
    """A mean for a sum, or a sign."""
    gradcheck(mixed, impl.interpolate_derivatives_backward, buffers(rng, 3, trailing=(2,)),
              name="interpolate_derivatives")


@exercise("5.14")
@each_golden
def test_gradients_of_derivatives_are_those_of_nvdiffrast(impl, scene):
    """What nvdiffrast adds where the derivatives have a gradient, too."""
    of = golden(scene)
    chosen = of["chosen"]
    grad_attributes, grad_derivatives = impl.interpolate_derivatives_backward(
        of["grad_output_derivatives"], of["attributes"][:, chosen], of["faces"], of["face_index"],
        of["all_derivatives"])
    added = of["grad_attributes_both"] - of["grad_attributes"]
    assert_close(grad_attributes, added[:, chosen], of["given"], rtol=0, atol=3e-5)
    assert_close(by_uv(grad_derivatives), of["grad_derivatives"], of["given"], rtol=0, atol=3e-6)
