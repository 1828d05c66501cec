"""What the exercises of lab 4 must do."""
import numpy as np
import pytest
from seen_on_rays import seen_on_rays

from labkit.checks import assert_close, assert_equal, assert_picture, exercise

# Two rows of three pixels, four samples; the pixels in rows from the bottom, the samples across:
#   [4, 4, 4, 4]  [4, 6, 6, 4]  [-1, 9, -1, 9]
#   [-1, -1, -1, -1]  [6, 6, 6, 6]  [4, 0, 9, -1]
FACE_INDEX = np.array([[[4, 4, -1], [-1, 6, 4]],
                       [[4, 6,  9], [-1, 6, 0]],
                       [[4, 6, -1], [-1, 6, 9]],
                       [[4, 4,  9], [-1, 6, -1]]])


def block_means(picture, n):
    """The mean of each n x n pixels, pixel by pixel of a block."""
    return sum(picture[i::n, j::n] for i, j in np.ndindex(n, n)) / n**2


def mean_shades(shade, request, background):
    """The mean over the samples of the shades that they ask for: the background comes last."""
    return np.concatenate([shade, background[None]])[request].sum(0) / len(request)


def random_faces(rng, count, height, width, faces):
    """face_index (count, height, width) in which many pixels have samples on several faces."""
    face_index = np.repeat(rng.integers(-1, faces, (1, height, width)), count, 0)
    other = rng.integers(-1, faces, face_index.shape)
    return np.where(rng.random(face_index.shape) < 0.2, other, face_index)


# --- patterns ----------------------------------------------------------------------------------

@exercise("4.3")
def test_the_rotated_grid_on_paper(impl):
    """k s, or k s + 1, for k (s + 1). No - 1 after the remainder. The remainder is that by S, not
    by S + 1. x and y are swapped. + 1/2 is left out (corners, not centres), or added after the
    division by S. Or no division by S.
    """
    assert_close(impl.lattice(4, 2), np.array([[1.0, 3.0], [3.0, 7.0], [5.0, 1.0], [7.0, 5.0]]) / 8)
    assert_close(impl.lattice(4, 3), np.array([[1.0, 5.0], [3.0, 1.0], [5.0, 7.0], [7.0, 3.0]]) / 8)


@exercise("4.3")
def test_each_sample_is_step_rows_above_the_one_before(impl, rng):
    """Right for a few patterns alone, or rows do not go on at the bottom after the top one."""
    for size in rng.choice([11, 13, 17, 19, 23, 29, 31, 37, 41, 43], 3).tolist():  # S + 1, a prime
        step = int(rng.integers(2, size - 1))
        rows = [0]
        while len(rows) < size:
            rows.append((rows[-1] + step) % size)
        expected = np.array([[k + 0.5, row - 0.5] for k, row in enumerate(rows[1:])]) / (size - 1)
        assert_close(impl.lattice(size - 1, step), expected)


@exercise("4.4")
def test_a_sample_moves_to_the_centre_on_paper(impl):
    """Away from the centre: the opposite sign. The half pixel is left out. x and y, or width and
    height, are swapped. y is moved the other way. Twice or half as far, or not divided by the size.
    w is left out, or divides.
    """
    clip = np.array([[0.0, 0.0, 0.3, 1.0], [0.5, -1.0, 0.7, 2.0], [-3.0, 2.0, 0.1, 4.0],
                     [1.5, 0.25, -0.2, 3.0]])
    moved = impl.centre_sample(clip, np.array([0.25, 0.9]), 8, 4)  # by w / 16 and -w / 5
    assert_close(moved, [[0.0625, -0.2, 0.3, 1.0], [0.625, -1.4, 0.7, 2.0],
                         [-2.75, 1.2, 0.1, 4.0], [1.6875, -0.35, -0.2, 3.0]])


@pytest.mark.parametrize("sign", [
    pytest.param(1, marks=exercise("4.4")),
    pytest.param(-1, marks=exercise("4.4", fine_print=True))], ids=["in front", "behind"])
def test_all_vertices_move_alike_on_screen(impl, rng, sign):
    """The step is added in clip space without w: far vertices move less. With |w|, a vertex behind
    the camera (w < 0) moves the wrong way. Or z or w changes.
    """
    clip = sign * rng.uniform([-2, -2, -1, 0.3], [2, 2, 1, 3], (50, 4))
    offset, width, height = np.array([0.9, 0.2]), 11, 7
    moved = impl.centre_sample(clip, offset, width, height)
    step = (moved[:, :2] / moved[:, 3:] - clip[:, :2] / clip[:, 3:]) * [width / 2, height / 2]
    assert_close(step, np.tile(0.5 - offset, (50, 1)), rtol=1e-7)
    assert_equal(moved[:, 2:], clip[:, 2:])


@exercise("4.4", fine_print=True)
def test_the_centre_itself_stays_to_the_bit(impl, rng):
    """Rounding: a division and a multiplication, as by w or by the width, that do not cancel."""
    clip = rng.normal(size=(200, 4)) * 10.0 ** rng.integers(-5, 5, (200, 1))
    assert_equal(impl.centre_sample(clip, np.array([0.5, 0.5]), 511, 333), clip)


# --- coverage and its error --------------------------------------------------------------------

@exercise("4.5")
def test_an_edge_between_two_samples_of_a_pixel(impl):
    """All samples are at the pixel's centre, or on the other side of it: moved the wrong way. The
    samples come last or in another order. x and y, or width and height, are swapped.
    """
    clip = np.array([[-1, -9, 0, 1.0], [0.4, -9, 0, 1], [0.4, 9, 0, 1], [-1, 9, 0, 1]])
    pattern = np.array([[0.7, 0.5], [0.9, 0.1], [0.1, 0.1]])  # of 2 x 3 pixels, x < 1.4 is covered
    face_index, _ = impl.rasterize_samples(clip, np.array([[0, 1, 2], [0, 2, 3]]), 2, 3, pattern)
    assert_equal(face_index.shape, (3, 3, 2))
    covered = np.array([[True, False], [True, False], [True, True]])
    assert_equal(face_index >= 0, covered[:, None].repeat(3, 1))


def crossing_faces(rng):
    """Random faces, w not 1, in 9 x 7 pixels of three samples: what rasterize_samples is given, and
    what it returns.
    """
    w = rng.uniform(1, 3, (12, 1))
    clip = w * np.hstack([rng.uniform(-1.3, 1.3, (12, 2)), rng.uniform(-0.9, 0.9, (12, 1)),
                          np.ones((12, 1))])
    faces, pattern = np.arange(12).reshape(4, 3), rng.uniform(size=(3, 2))
    corner = np.stack(np.meshgrid(np.arange(9), np.arange(7)), -1).reshape(-1, 2)
    seen = [seen_on_rays(corner + offset, clip, faces, 9, 7) for offset in pattern]
    face_index, depth = (np.reshape(part, (3, 7, 9)) for part in zip(*seen, strict=True))
    return (clip, faces, 9, 7, pattern), face_index, depth


@exercise("4.5")
def test_every_sample_sees_the_face_that_is_nearest_there(impl, rng):
    """A pixel's samples share a face, or the one that its centre sees. One step in clip space is
    not the same for all vertices, as w is not 1.
    """
    given, face_index, _ = crossing_faces(rng)
    assert_equal(impl.rasterize_samples(*given)[0], face_index)


@exercise("4.5")
def test_every_sample_has_a_depth_of_its_own(impl, rng):
    """A pixel's samples share a depth, that of its centre. Or it is 0 where no face is seen."""
    given, _, depth = crossing_faces(rng)
    assert_close(impl.rasterize_samples(*given)[1], depth)


@exercise("4.6")
def test_the_order_of_an_exact_power(impl):
    """The sign of the slope is kept. The reciprocal: the slope of log n over log error. No
    logarithm of n or of the error. A line through the origin: the means are not taken away. Or its
    intercept, not its slope.
    """
    n = np.array([1.0, 2.0, 5.0, 10.0])
    assert_close(impl.observed_order(n, 7.0 * n ** -2), 2.0)
    assert_close(impl.observed_order(n, 0.001 * n ** -0.5), 0.5)
    assert_close(impl.observed_order(n, n ** 1.0), -1.0)


@exercise("4.6")
def test_the_order_is_that_of_the_best_line(impl, rng):
    """Only the first and the last error count, or the mean of slopes, not the line of least
    squares through all points.
    """
    n = np.array([1.0, 2.0, 3.0, 8.0, 20.0, 21.0])
    error = 3.0 * n ** -1.5 * np.exp(rng.normal(size=6))
    slope, _ = np.polyfit(np.log(n), np.log(error), 1)
    assert_close(impl.observed_order(n, error), -slope)


@exercise("4.1")
def test_blocks_on_paper(impl):
    """The sum, or the sum over n, not n^2. Every n-th pixel, or the largest. The last row or column
    of a block is left out. Pixels far apart instead of n x n neighbours (a wrong reshape). Height
    and width are exchanged.
    """
    picture = np.array([[1.0, 2.0, 5.0, 6.0],
                        [3.0, 5.0, 7.0, 9.0],
                        [9.0, 3.0, 1.0, 0.0],
                        [4.0, 8.0, 2.0, 6.0],
                        [0.0, 4.0, 2.0, 7.0],
                        [8.0, 1.0, 9.0, 3.0]])[..., None]
    expected = np.array([[11.0, 27.0], [24.0, 9.0], [13.0, 21.0]])[..., None] / 4
    assert_close(impl.box_resolve(picture, 2), expected)


@exercise("4.1")
def test_blocks_of_any_size_and_channel(impl, rng):
    """n is taken for 2, or the mean divided by 4, whatever n is. Rows and columns are mixed up
    where the picture is not square. Or channels are averaged.
    """
    for n, height, width in (1, 3, 4), (2, 5, 3), (3, 2, 4):
        picture = rng.random((n * height, n * width, 3))
        assert_picture(impl.box_resolve(picture, n), block_means(picture, n), atol=1e-12)


@exercise("4.2")
@pytest.mark.parametrize("n", [1, 2, 3])
def test_the_gradient_of_blocks_is_a_central_difference(impl, rng, n, gradcheck):
    """Divided by n, tiled instead of repeated, or one channel for all."""
    gradcheck(block_means, impl.box_resolve_backward, (rng.random((2 * n, 3 * n, 2)), n),
              name="box_resolve")


# --- one shade for each face in a pixel --------------------------------------------------------

def assert_requests(got, face_index):
    """Each pair once, no other pair, and every sample's request is its own pixel and face."""
    pixel, face, request = got
    seen = face_index >= 0
    _, row, column = np.nonzero(seen)
    own_pixel, own_face = row * face_index.shape[2] + column, face_index[seen]
    count = len(np.unique([own_pixel, own_face], axis=1).T)
    assert_equal((np.shape(pixel), np.shape(face)), ((count,), (count,)), given=face_index)
    assert_equal(request < 0, ~seen, given=face_index)
    used = request[seen]
    assert_equal(np.unique(used), np.arange(count), given=face_index)
    assert_equal((pixel[used], face[used], request[~seen]),
                 (own_pixel, own_face, np.full((~seen).sum(), -1)), given=face_index)


def pairs_of(impl, face_index):
    """The pairs (pixel, face) that are asked for, in order."""
    pixel, face, _ = impl.shading_requests(face_index)
    return sorted(zip(pixel.tolist(), face.tolist(), strict=True))


@exercise("4.7")
def test_pixels_are_numbered_row_by_row(impl):
    """pixel is row * H + column, or column by column, or it counts from 1. It is row * W + column.
    Or pixel and face are swapped.
    """
    face_index = np.array([[[8, 7, 6, 9], [5, 4, 3, 2]]])
    assert_equal(pairs_of(impl, face_index), [
        (0, 8), (1, 7), (2, 6), (3, 9), (4, 5), (5, 4), (6, 3), (7, 2)])


@exercise("4.7")
def test_samples_of_a_pixel_that_see_the_same_face_share_a_pair(impl):
    """Every sample makes a request of its own: a pair comes more than once. Or only neighbouring
    samples share one, so a face that comes back is asked for twice. Only one face of a mixed pixel
    is asked for.
    """
    face_index = np.array([4, 6, 6, 4, 9, 6]).reshape(6, 1, 1)
    assert_equal(pairs_of(impl, face_index), [(0, 4), (0, 6), (0, 9)])


@exercise("4.7")
def test_a_face_in_two_pixels_is_two_pairs(impl):
    """A face is shaded once in the whole picture, not once in each pixel that shows it."""
    face_index = np.array([[[4, 4, 7]], [[4, 7, 4]]])
    assert_equal(pairs_of(impl, face_index), [(0, 4), (1, 4), (1, 7), (2, 4), (2, 7)])


@exercise("4.7")
def test_the_background_is_no_pair(impl):
    """The background, -1, becomes a request, as if it were a face. Or a pixel with some background
    is left out.
    """
    assert_equal(pairs_of(impl, np.array([[[4, -1, -1]], [[-1, -1, 7]]])), [(0, 4), (2, 7)])


@exercise("4.7")
def test_face_0_is_a_face(impl):
    """Face 0 is taken for no face: > 0 for >= 0, or its number is tested as true or false."""
    face_index = np.array([[[2, 0, 0]], [[0, 0, 5]]])
    assert_equal(pairs_of(impl, face_index), [(0, 0), (0, 2), (1, 0), (2, 0), (2, 5)])


@exercise("4.7")
def test_the_largest_face_is_not_face_0_of_the_next_pixel(impl):
    """The key of a pair is not unique: in pixel * F + face, with the largest face for F, not one
    more, the largest face and face 0 of the next pixel collide. Or pixel + face.
    """
    face_index = np.array([[[5, 0, 4], [0, 1, 5]], [[0, 5, 1], [5, 1, 5]]])
    assert_equal(pairs_of(impl, face_index), [
        (0, 0), (0, 5), (1, 0), (1, 5), (2, 1), (2, 4), (3, 0), (3, 5), (4, 1), (5, 5)])


@exercise("4.7")
def test_every_sample_finds_its_own_pair(impl):
    """request is in another order, as (H, W, S) with a reshape that moves no axes. It has the
    number of another pair, or of the pixel. Numbers start anew in each pixel, or among mixed ones.
    The background's is not -1.
    """
    assert_requests(impl.shading_requests(FACE_INDEX), FACE_INDEX)


@exercise("4.7")
@pytest.mark.parametrize("count", [1, 2, 4, 16])
def test_the_pairs_of_random_pictures(impl, rng, count):
    """One face in two pixels, or two faces in one, are taken for one pair."""
    for faces in (1, 2, 50):
        face_index = random_faces(rng, count, 4, 5, faces)
        face_index += face_index >= 0  # face 0 has a claim of its own
        assert_requests(impl.shading_requests(face_index), face_index)


@exercise("4.7")
def test_no_faces_no_shades(impl):
    """A picture that shows no face ends in an error. Or the background's shade is asked for."""
    pixel, face, request = impl.shading_requests(np.full((4, 2, 3), -1))
    found = len(pixel), len(face), request.shape, bool((request == -1).all())
    assert_equal(found, (0, 0, (4, 2, 3), True))


@exercise("4.7", fine_print=True)
def test_a_large_picture_of_many_faces(impl, rng):
    """Numbers of pixel and face collide, as they are packed into one too tightly."""
    face_index = random_faces(rng, 4, 120, 90, 2)
    face_index = np.where(face_index >= 0, face_index + 3_000_000, -1)
    assert_requests(impl.shading_requests(face_index), face_index)


REQUEST = np.array([[[0, 0, -1], [2, -1, 1]], [[1, 0, -1], [2, 2, 1]], [[1, 0, -1], [2, -1, 0]],
                    [[1, 0, -1], [0, 2, -1]]])


@exercise("4.8")
def test_the_mean_of_a_pixel_on_paper(impl):
    """The background is left out of the mean, is black, or gets the last shade (-1 as an index).
    Rows are shifted by one. A face counts once for all its samples. One sample decides. The sum is
    not divided by S, or goes over another axis.
    """
    shade, background = np.array([[1.0, 0.0], [5.0, 8.0], [9.0, 4.0]]), np.array([3.0, 2.0])
    expected = [[[4.0, 6.0], [1.0, 0.0], [3.0, 2.0]], [[7.0, 3.0], [6.0, 3.0], [3.5, 4.5]]]
    assert_picture(impl.resolve(shade, REQUEST, background), expected, atol=1e-12)


@exercise("4.8")
@pytest.mark.parametrize("count", [1, 3, 8])
def test_the_mean_of_any_number_of_samples(impl, rng, count):
    """Divided by 4, whatever the number of samples. Or only two different samples are mixed."""
    shade, background = rng.random((6, 3)), rng.random(3)
    request = rng.integers(-1, 6, (count, 5, 4))
    expected = mean_shades(shade, request, background)
    assert_picture(impl.resolve(shade, request, background), expected, atol=1e-12)


@exercise("4.8", fine_print=True)
def test_colours_that_differ_little_are_mixed(impl):
    """Nearly equal is taken for equal: a smooth picture gets steps."""
    request = np.array([0, 1, 1, 1]).reshape(4, 1, 1)
    got = impl.resolve(np.array([[0.5], [0.5 + 4e-9]]), request, np.zeros(1))
    assert_close(got - 0.5, [[[3e-9]]], rtol=1e-6)


@exercise("4.8", fine_print=True)
def test_no_shades_leave_the_background(impl):
    """A picture without faces ends in an error."""
    background = np.array([0.2, 0.4, 0.6])
    got = impl.resolve(np.zeros((0, 3)), np.full((4, 2, 3), -1), background)
    assert_picture(got, np.tile(background, (2, 3, 1)))


@exercise("4.8", fine_print=True)
@pytest.mark.parametrize("count", [4, 5, 7, 16])
def test_a_common_colour_comes_out_to_the_bit(impl, rng, count):
    """The sum is rounded and then divided by S: two faces of one colour show a seam in the last
    bit. Equal colours must come out exactly.
    """
    colours = rng.random((40, 3))
    request = np.arange(40) + 40 * rng.integers(0, 3, (count, 1, 40))  # 3 of one colour
    got = impl.resolve(np.tile(colours, (3, 1)), request, np.ones(3))
    assert_equal(got, colours[None])
    got = impl.resolve(np.zeros((1, 3)), np.full((count, 1, 1), -1), colours[0])
    assert_equal(got, colours[None, :1])


@exercise("4.10")
def test_the_gradient_of_shades_on_paper(impl):
    """Each sample, or one alone, brings the whole gradient. Repeated requests add only once, as by
    += on an index, or become a mean. The background's part is missing, in mixed pixels, or goes to
    the last shade. Rows are shifted by one, as request + 1 puts the background first.
    """
    red = np.array([[4.0, 8.0, 12.0], [20.0, 28.0, 36.0]])
    blue = np.array([[40.0, 4.0, 24.0], [8.0, 60.0, 16.0]])
    got = impl.resolve_backward(np.stack([red, blue], -1), np.zeros((3, 2)), REQUEST, np.zeros(2))
    assert_close(got, ([[1 + 8 + 5 + 9.0, 10 + 4 + 2 + 4.0],
                        [3 + 18.0, 30 + 8.0],
                        [15 + 14.0, 6 + 30.0]],
                       [12 + 14 + 9.0, 24 + 30 + 4.0]))


@exercise("4.10")
def test_a_shade_that_nobody_uses_has_no_gradient(impl):
    """The last shade gets the background's gradient, as -1 is used as an index. Or the last shades
    are missing where no sample uses them.
    """
    grad = np.ones((2, 3, 2))
    request = np.where(REQUEST == 2, -1, REQUEST)
    got = impl.resolve_backward(grad, np.zeros((5, 2)), request, np.zeros(2))
    assert_close(got, (np.repeat([[1.75], [1.25], [0.0], [0.0], [0.0]], 2, 1), [3.0, 3.0]))


@exercise("4.10", fine_print=True)
def test_without_shades_the_background_has_all_of_the_gradient(impl):
    """A picture without faces ends in an error."""
    got = impl.resolve_backward(np.ones((2, 3, 2)), np.zeros((0, 2)), np.full((4, 2, 3), -1),
                                np.zeros(2))
    assert_close(got, (np.zeros((0, 2)), [6.0, 6.0]))


def random_requests(rng):
    """Shades, requests and a background. Some samples see the background, some a shade."""
    request = rng.integers(-1, 5, (3, 3, 4))
    request[0, 0, :2] = -1, 0  # whatever the seed
    return rng.random((5, 3)), request, rng.random(3)


@exercise("4.10")
def test_the_gradient_of_shades_is_a_central_difference(impl, rng, gradcheck):
    """One channel for all. The two gradients are swapped. Or grad_picture is summed up before."""
    shade, *given = random_requests(rng)
    gradcheck(lambda shade: mean_shades(shade, *given),
              lambda grad, shade: impl.resolve_backward(grad, shade, *given)[0], (shade,),
              name="resolve")


@exercise("4.10")
def test_the_gradient_of_the_background_is_a_central_difference(impl, rng, gradcheck):
    """The background has none. Or only pixels that see nothing else bring it theirs."""
    *given, background = random_requests(rng)
    gradcheck(lambda background: mean_shades(*given, background),
              lambda grad, background: impl.resolve_backward(grad, *given, background)[1],
              (background,), name="resolve")


@exercise("4.9")
def test_the_cost_on_paper(impl):
    """Samples count only where a face is seen, or pixels are counted. Bytes are those of the shades
    or of one sample. Faces are counted in the whole picture. Face 0 is taken for no face (> 0 for
    >= 0), or the background, -1, is shaded as if it were one. Samples are not sorted, so that a
    face that comes back is counted twice. The outputs are in another order.
    """
    assert_equal(impl.cost(FACE_INDEX, 8), (24, 8, 192))


@exercise("4.9")
def test_equal_samples_share_a_shade_wherever_they_stand(impl, rng):
    """Only neighbouring samples are compared, or the faces of the whole picture are counted."""
    for count in (1, 4, 16):
        face_index = random_faces(rng, count, 6, 7, 4)
        shades = sum(len(set(pixel.tolist()) - {-1}) for pixel in face_index.reshape(count, -1).T)
        assert_equal(impl.cost(face_index, 3), (42 * count, shades, 126 * count))
