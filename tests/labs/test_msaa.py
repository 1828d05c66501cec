"""What the exercises of lab 4 must do."""
import time

import numpy as np
import pytest

from course.checks import assert_close, assert_equal, assert_picture, exercise
from course.given.gradcheck import gradcheck

# Two rows of three pixels, four samples; the pixels in rows from the bottom, the samples across:
#   [4, 4, 4, 4]  [4, 6, 6, 4]  [-1, 9, -1, 9]
#   [-1, -1, -1, -1]  [6, 6, 6, 6]  [4, 0, 9, -1]
FACE_INDEX = np.array([[[4, 4, -1], [-1, 6, 4]],
                       [[4, 6,  9], [-1, 6, 0]],
                       [[4, 6, -1], [-1, 6, 9]],
                       [[4, 4,  9], [-1, 6, -1]]])
PAIRS = [(0, 4), (1, 4), (1, 6), (2, 9), (4, 6), (5, 0), (5, 4), (5, 9)]


def random_faces(rng, count, height, width, faces):
    """face_index (count, height, width) in which many pixels have samples on several faces."""
    face_index = np.repeat(rng.integers(-1, faces, (1, height, width)), count, 0)
    other = rng.integers(-1, faces, face_index.shape)
    return np.where(rng.random(face_index.shape) < 0.2, other, face_index)


# --- patterns ----------------------------------------------------------------------------------

@exercise("4.2")
def test_the_rotated_grid_on_paper(impl):
    """s for s + 1, no - 1 after the remainder, or x and y swapped."""
    assert_close(impl.lattice(4, 2), np.array([[1.0, 3.0], [3.0, 7.0], [5.0, 1.0], [7.0, 5.0]]) / 8)
    assert_close(impl.lattice(4, 3), np.array([[1.0, 5.0], [3.0, 1.0], [5.0, 7.0], [7.0, 3.0]]) / 8)


@exercise("4.2")
@pytest.mark.parametrize(("count", "step"), [(1, 1), (2, 2), (4, 2), (8, 2), (16, 4), (30, 12)])
def test_every_row_and_every_column_holds_one_sample(impl, count, step):
    """The remainder by S instead of S + 1: rows are empty or used twice."""
    pattern = impl.lattice(count, step)
    each = (np.arange(count) + 0.5) / count
    assert_close(pattern[:, 0], each)
    assert_close(np.sort(pattern[:, 1]), each)


@exercise("4.2")
def test_the_rotated_grid_is_a_square_turned(impl):
    """Another pattern with one sample on each row and column: a diagonal, or a zigzag."""
    p = impl.lattice(4, 2)
    sides = p[[2, 3, 1, 0]] - p[[0, 2, 3, 1]]
    assert_close(np.hypot(*sides.T), np.full(4, np.sqrt(5) / 4))
    assert_close(sides[0] @ sides[1], 0.0)


@exercise("4.3")
def test_a_sample_moves_to_the_centre_on_paper(impl):
    """Away from the centre, width and height swapped, or twice or half as far."""
    clip = np.array([[0.0, 0.0, 0.3, 1.0], [0.5, -1.0, 0.3, 2.0]])
    moved = impl.centre_sample(clip, np.array([0.25, 1.0]), 8, 4)
    assert_close(moved, np.array([[0.0625, -0.25, 0.3, 1.0], [0.625, -1.5, 0.3, 2.0]]))


@pytest.mark.parametrize("sign", [
    pytest.param(1, marks=exercise("4.3")),
    pytest.param(-1, marks=exercise("4.3", fine_print=True))], ids=["in front", "behind"])
def test_all_vertices_move_alike_on_screen(impl, rng, sign):
    """The step is added in clip space without w, or with |w|: far vertices move less."""
    clip = sign * rng.uniform([-2, -2, -1, 0.3], [2, 2, 1, 3], (50, 4))
    offset, width, height = np.array([0.9, 0.2]), 11, 7
    moved = impl.centre_sample(clip, offset, width, height)
    step = (moved[:, :2] / moved[:, 3:] - clip[:, :2] / clip[:, 3:]) * [width / 2, height / 2]
    assert_close(step, np.tile(0.5 - offset, (50, 1)), rtol=1e-7)
    assert_equal(moved[:, 2:], clip[:, 2:])


@exercise("4.3", fine_print=True)
def test_the_centre_itself_stays_to_the_bit(impl, rng):
    """Rounding: a division and a multiplication that do not cancel."""
    clip = rng.normal(size=(200, 4)) * 10.0 ** rng.integers(-5, 5, (200, 1))
    assert_equal(impl.centre_sample(clip, np.array([0.5, 0.5]), 511, 333), clip)


# --- coverage and its error --------------------------------------------------------------------

@exercise("4.4")
def test_the_share_of_samples_on_paper(impl):
    """Face 0 counts as background, or the number of the face is averaged."""
    expected = np.array([[1.0, 1.0, 0.5], [0.0, 1.0, 0.75]])
    assert_picture(impl.coverage(FACE_INDEX), expected, atol=1e-12)


@exercise("4.4")
def test_shares_of_any_number_of_samples(impl, rng):
    """Divided by 4, whatever the number of samples, or averaged over another axis."""
    for count in (1, 3, 16):
        face_index = rng.integers(-3, 5, (count, 3, 4)).clip(-1)
        expected = [[sum(face_index[s, i, j] > -1 for s in range(count)) / count
                     for j in range(4)] for i in range(3)]
        assert_picture(impl.coverage(face_index), np.array(expected), atol=1e-12)


@exercise("4.5")
def test_the_order_of_an_exact_power(impl):
    """The sign, the reciprocal, or the ends swapped."""
    n = np.array([1.0, 2.0, 5.0, 10.0])
    assert_close(impl.observed_order(n, 7.0 * n ** -2), 2.0)
    assert_close(impl.observed_order(n, 0.001 * n ** -0.5), 0.5)
    assert_close(impl.observed_order(n, n ** 1.0), -1.0)


@exercise("4.5")
def test_the_order_is_that_of_the_best_line(impl, rng):
    """Only the first and last error count, or a line through the origin, or errors, not logs."""
    n = np.array([1.0, 2.0, 3.0, 8.0, 20.0, 21.0])
    error = 3.0 * n ** -1.5 * np.exp(rng.normal(size=6))
    slope, _ = np.polyfit(np.log(n), np.log(error), 1)
    assert_close(impl.observed_order(n, error), -slope)


@exercise("4.6")
def test_blocks_on_paper(impl):
    """Every n-th pixel, the sum, or blocks of one pixel repeated n times."""
    picture = np.array([[1.0, 2.0, 5.0, 6.0], [3.0, 4.0, 7.0, 8.0]])[..., None]
    assert_close(impl.box_resolve(picture, 2), np.array([[[2.5], [6.5]]]))


@exercise("4.6")
def test_blocks_of_any_size_and_channel(impl, rng):
    """Rows and columns are mixed up where the picture is no square, or channels are averaged."""
    for n, height, width in (1, 3, 4), (2, 5, 3), (3, 2, 4):
        picture = rng.random((n * height, n * width, 3))
        expected = np.array([[[picture[n * i:n * i + n, n * j:n * j + n, c].mean()
                               for c in range(3)] for j in range(width)] for i in range(height)])
        assert_picture(impl.box_resolve(picture, n), expected, atol=1e-12)


@exercise("4.7")
def test_the_gradient_of_blocks_on_paper(impl):
    """Not divided by n * n, or rows and columns of blocks mixed up."""
    grad = np.array([[[4.0], [8.0]]])
    expected = np.array([[1.0, 1.0, 2.0, 2.0]] * 2)[..., None]
    assert_close(impl.box_resolve_backward(grad, np.zeros((2, 4, 1)), 2), expected)


@exercise("4.7")
@pytest.mark.parametrize("n", [1, 2, 3])
def test_the_gradient_of_blocks_is_a_central_difference(impl, rng, n):
    """Divided by n, tiled instead of repeated, or one channel for all."""
    def forward(picture):
        blocks = [picture[i::n, j::n] for i in range(n) for j in range(n)]
        return sum(blocks) / n ** 2

    gradcheck(forward, lambda grad, picture: impl.box_resolve_backward(grad, picture, n),
              (rng.random((2 * n, 3 * n, 2)),), name="box_resolve")


# --- one shade for each face in a pixel --------------------------------------------------------

def assert_requests(got, face_index):
    """Each pair once, no other pair, and every sample's request is its own pixel and face."""
    pixel, face, request = got
    height, width = face_index.shape[1:]
    pairs = {(i * width + j, int(face_index[s, i, j])) for s, i, j in np.argwhere(face_index >= 0)}
    assert_equal(np.shape(pixel), (len(pairs),), given=face_index)
    assert_equal(np.shape(face), (len(pairs),), given=face_index)
    assert_equal(request < 0, face_index < 0, given=face_index)
    seen = face_index >= 0
    used = request[seen]
    assert_equal(np.sort(np.unique(used)), np.arange(len(pairs)), given=face_index)
    own = np.broadcast_to(np.arange(height * width).reshape(height, width), face_index.shape)
    assert_equal(pixel[used], own[seen], given=face_index)
    assert_equal(face[used], face_index[seen], given=face_index)
    assert_equal(request[~seen], np.full((~seen).sum(), -1), given=face_index)


REQUESTS = pytest.mark.parametrize("name", [
    pytest.param("shading_requests_loop", marks=exercise("4.8")),
    pytest.param("shading_requests", marks=exercise("4.9"))])


@REQUESTS
def test_the_pairs_on_paper(impl, name):
    """Pixels are row * H + column, face 0 or pixel 0 is forgotten, or the background is a pair."""
    pixel, face, _ = getattr(impl, name)(FACE_INDEX)
    assert_equal(sorted(zip(pixel.tolist(), face.tolist(), strict=True)),
                 PAIRS)


@REQUESTS
def test_every_sample_finds_its_own_pair(impl, name):
    """A pair is asked for twice, as its samples are not neighbours, or request is of another."""
    assert_requests(getattr(impl, name)(FACE_INDEX), FACE_INDEX)


@REQUESTS
@pytest.mark.parametrize("count", [1, 2, 4, 16])
def test_the_pairs_of_random_pictures(impl, rng, name, count):
    """One face in two pixels, or two faces in one, are taken for one pair."""
    for faces in (1, 2, 50):
        face_index = random_faces(rng, count, 4, 5, faces)
        assert_requests(getattr(impl, name)(face_index), face_index)


@REQUESTS
def test_no_faces_no_shades(impl, name):
    """A picture that shows no face ends in an error, or asks for the background's shade."""
    pixel, face, request = getattr(impl, name)(np.full((4, 2, 3), -1))
    assert_equal((len(pixel), len(face)), (0, 0))
    assert_equal(request, np.full((4, 2, 3), -1))


@exercise("4.9")
def test_a_large_picture_of_many_faces(impl, rng):
    """Numbers of pixel and face collide, as they are packed into one too tightly."""
    face_index = random_faces(rng, 4, 120, 90, 2)
    face_index = np.where(face_index >= 0, face_index + 3_000_000, -1)
    assert_requests(impl.shading_requests(face_index), face_index)


@exercise("4.9")
def test_it_takes_less_time_than_to_visit_all_samples(impl, rng):
    """A loop over pixels or samples in Python, or a call of the loop beside it."""
    face_index = np.full((4, 700, 700), -1)
    face_index[:, 100:160, 100:160] = random_faces(rng, 4, 60, 60, 50)
    start = time.perf_counter()
    for s, i, j in np.ndindex(face_index.shape):
        face_index[s, i, j]
    visited = time.perf_counter() - start

    def seconds():
        start = time.perf_counter()
        impl.shading_requests(face_index)
        return time.perf_counter() - start

    least = min(seconds() for _ in range(3))
    assert least < visited / 2, f"{least:.2f} s; a visit of all samples takes {visited:.2f} s"


REQUEST = np.array([[[0, 0, -1], [2, -1, 1]], [[1, 0, -1], [2, 2, 1]], [[1, 0, -1], [2, -1, 0]],
                    [[1, 0, -1], [0, 2, -1]]])


@exercise("4.10")
def test_the_mean_of_a_pixel_on_paper(impl):
    """The background is left out of the mean, or a face counts once for all its samples."""
    shade, background = np.array([[1.0, 0.0], [5.0, 8.0], [9.0, 4.0]]), np.array([3.0, 2.0])
    expected = np.array([[[4.0, 6.0], [1.0, 0.0], [3.0, 2.0]],
                         [[7.0, 3.0], [6.0, 3.0], [3.5, 4.5]]])
    assert_picture(impl.resolve(shade, REQUEST, background), expected, atol=1e-12)


@exercise("4.10")
@pytest.mark.parametrize("count", [1, 3, 8])
def test_the_mean_of_any_number_of_samples(impl, rng, count):
    """Divided by 4, or only two different samples are mixed."""
    shade, background = rng.random((6, 3)), rng.random(3)
    request = rng.integers(-1, 6, (count, 5, 4))
    expected = np.array([[np.mean([background if r < 0 else shade[r] for r in request[:, i, j]], 0)
                          for j in range(4)] for i in range(5)])
    assert_picture(impl.resolve(shade, request, background), expected, atol=1e-12)


@exercise("4.10", fine_print=True)
def test_colours_that_differ_little_are_mixed(impl):
    """Nearly equal is taken for equal: a smooth picture gets steps."""
    request = np.array([0, 1, 1, 1]).reshape(4, 1, 1)
    got = impl.resolve(np.array([[0.5], [0.5 + 4e-9]]), request, np.zeros(1))
    assert_close(got - 0.5, np.array([[[3e-9]]]), rtol=1e-6)


@exercise("4.10", fine_print=True)
def test_no_shades_leave_the_background(impl):
    """A picture without faces ends in an error."""
    background = np.array([0.2, 0.4, 0.6])
    got = impl.resolve(np.zeros((0, 3)), np.full((4, 2, 3), -1), background)
    assert_picture(got, np.tile(background, (2, 3, 1)))


@exercise("4.10", fine_print=True)
@pytest.mark.parametrize("count", [4, 5, 7, 16])
def test_a_common_colour_comes_out_to_the_bit(impl, rng, count):
    """The sum is rounded and then divided: two faces of one colour show a seam in the last bit."""
    colours = rng.random((40, 3))
    request = 40 * rng.integers(0, 3, (count, 1, 40)) + np.arange(40)  # 3 requests of one colour
    got = impl.resolve(np.tile(colours, (3, 1)), request, np.ones(3))
    assert_equal(got, colours[None])
    got = impl.resolve(np.zeros((1, 3)), np.full((count, 1, 1), -1), colours[0])
    assert_equal(got, colours[None, :1])


@exercise("4.11")
def test_the_gradient_of_shades_on_paper(impl):
    """Each sample brings the whole gradient, or a shade gets only that of its last sample."""
    grad = np.array([[[4.0], [8.0], [16.0]], [[32.0], [64.0], [128.0]]])
    grad_shade, grad_background = impl.resolve_backward(grad, np.zeros((3, 1)), REQUEST,
                                                        np.zeros(1))
    assert_close(grad_shade, np.array([[1 + 8 + 8 + 32.0], [3 + 64.0], [24 + 32.0]]))
    assert_close(grad_background, np.array([16 + 32 + 32.0]))


@exercise("4.11")
def test_a_shade_that_nobody_uses_has_no_gradient(impl):
    """The last shades are missing where no sample uses them, or get the background's gradient."""
    grad = np.ones((2, 3, 2))
    request = np.where(REQUEST == 2, -1, REQUEST)
    grad_shade, grad_background = impl.resolve_backward(grad, np.zeros((5, 2)), request,
                                                        np.zeros(2))
    assert_close(grad_shade, np.repeat([[1.75], [1.25], [0.0], [0.0], [0.0]], 2, 1))
    assert_close(grad_background, np.array([3.0, 3.0]))


@exercise("4.11", fine_print=True)
def test_without_shades_the_background_has_all_of_the_gradient(impl):
    """A picture without faces ends in an error."""
    got = impl.resolve_backward(np.ones((2, 3, 2)), np.zeros((0, 2)), np.full((4, 2, 3), -1),
                                np.zeros(2))
    assert_close(got, (np.zeros((0, 2)), np.array([6.0, 6.0])))


@exercise("4.11")
@pytest.mark.parametrize("count", [1, 3, 4])
def test_the_gradient_of_shades_is_a_central_difference(impl, rng, count):
    """One channel for all, the two gradients swapped, or grad_picture summed up before."""
    request = rng.integers(-1, 5, (count, 3, 4))
    request[0, 0, :2] = -1, 0  # whatever the seed: some see the background, some a shade

    def forward(shade, background):
        colour = np.concatenate([shade, background[None]])
        return sum(colour[request[s]] for s in range(count)) / count

    def backward(grad, shade, background):
        return impl.resolve_backward(grad, shade, request, background)

    gradcheck(forward, backward, (rng.random((5, 3)), rng.random(3)), name="resolve")


@exercise("4.12")
def test_the_cost_on_paper(impl):
    """Face 0 is free, the background is shaded, or samples count only where a face is seen."""
    assert_equal(impl.cost(FACE_INDEX, 8), (24, 8, 192))


@exercise("4.12")
def test_equal_samples_share_a_shade_wherever_they_stand(impl, rng):
    """Only neighbouring samples are compared, or the faces of the whole picture are counted."""
    for count in (1, 4, 16):
        face_index = random_faces(rng, count, 6, 7, 4)
        shades = sum(len(set(pixel.tolist()) - {-1}) for pixel in face_index.reshape(count, -1).T)
        assert_equal(impl.cost(face_index, 3), (42 * count, shades, 126 * count))


@exercise("4.12")
def test_nothing_seen_costs_samples_but_no_shades(impl):
    """The background counts as one shade in each pixel."""
    assert_equal(impl.cost(np.full((4, 2, 2), -1), 1), (16, 0, 16))
