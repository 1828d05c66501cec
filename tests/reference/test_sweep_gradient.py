"""The reference's gradients of whole outlines, by Kato's sweep."""
import numpy as np
import pytest
from loose_faces import some_corners

from course.checks import assert_close, assert_equal
from reference import arrays, neural_renderer, sweep_gradient

WIDTH, HEIGHT = 23, 17


OUTSIDE = [[0.8, 0.8, 1.0], [0.0, -0.5, 1.0], [0.2, -0.4, 1.0]]
INSIDE = [[0.8, 0.8, 1.0], [-0.5, -0.8, 1.0], [0.8, -0.8, 1.0]]


def sweep_of_one_pixel(sweep, corners, row_from_top, column, gradient):
    """A white triangle on black, 64 x 64; the loss asks one pixel alone."""
    corners, grad_colour = np.array([corners]), np.zeros((64, 64, 3))
    face_index, *_ = neural_renderer.rasterize(corners, 64, 64)
    colour = np.repeat((face_index >= 0)[..., None] * 1.0, 3, -1)
    grad_colour[63 - row_from_top, column] = gradient / 3
    return sweep(grad_colour, colour, face_index, corners)[0]


SWEEPS = pytest.mark.parametrize("sweep", [sweep_gradient.sweep_backward_loop,
                                           sweep_gradient.sweep_backward])


@SWEEPS
def test_a_pixel_outside_by_hand_and_as_in_the_original(sweep):
    """Row 25 from the top, column 35; the original's test allows 1e-2 of its own figures."""
    got = sweep_of_one_pixel(sweep, OUTSIDE, 25, 35, -1.0)
    # On screen (57.6, 57.6), (32, 16), (38.4, 19.2); the pixel's centre is (35.5, 38.5).
    # By x: on row y = 38.5 edge 0-1 is at u = 22.5 / 41.6 of its height. By y: on column x = 35.5
    # at v = 3.5 / 25.6 of its width, and no other edge has the pixel on its outer side.
    u, v = 22.5 / 41.6, 3.5 / 25.6
    x, y = (32 + 25.6 * u - 35.5) / 32, (38.5 - 16 - 41.6 * v) / 32
    expected = [[1 / (x / u + 1e-4), -1 / (y / v + 1e-4), 0],
                [1 / (x / (1 - u) + 1e-4), -1 / (y / (1 - v) + 1e-4), 0], [0, 0, 0]]
    np.testing.assert_allclose(got, expected, rtol=1e-9)
    original = [[1.6725862, -0.26021874, 0], [1.41986704, -1.64284933, 0], [0, 0, 0]]
    np.testing.assert_allclose(got, original, rtol=1e-4)


@SWEEPS
def test_a_pixel_inside_by_hand_and_as_in_the_original(sweep):
    """Row 40 from the top, column 50; all three edges could leave it behind."""
    got = sweep_of_one_pixel(sweep, INSIDE, 40, 50, 1.0)
    # On screen (57.6, 57.6), (16, 6.4), (57.6, 6.4); the pixel's centre is (50.5, 23.5).
    # By x: edge 0-1 at u of its height, and the upright edge 2-0. By y: edge 0-1 at v of its width,
    # and the flat edge 1-2.
    u, v = 17.1 / 51.2, 34.5 / 41.6
    left, right = (50.5 - 16 - 41.6 * u) / 32, 7.1 / 32
    above, below = (6.4 + 51.2 * v - 23.5) / 32, 17.1 / 32
    expected = [[1 / (right / u + 1e-4) - 1 / (left / u + 1e-4), 1 / (above / v + 1e-4), 0],
                [-1 / (left / (1 - u) + 1e-4),
                 1 / (above / (1 - v) + 1e-4) - 1 / (below / (1 - v) + 1e-4), 0],
                [1 / (right / (1 - u) + 1e-4), -1 / (below / v + 1e-4), 0]]
    np.testing.assert_allclose(got, expected, rtol=1e-9)
    original = [[0.98646867, 1.04628897, 0], [-1.03415668, -0.10403691, 0],
                [3.00094461, -1.55173182, 0]]
    np.testing.assert_allclose(got, original, rtol=1e-4)


@pytest.mark.parametrize("eps", [0.0, 1e-4, 0.1])
def test_the_sweep_of_whole_meshes_is_that_of_the_loop(rng, eps):
    """A line, an end or a chunk that is lost; the sign of columns; width for height."""
    corners = some_corners(rng)
    face_index, *_ = neural_renderer.rasterize(corners, WIDTH, HEIGHT)
    colour, grad_colour = rng.random((HEIGHT, WIDTH, 2)), rng.normal(size=(HEIGHT, WIDTH, 2))
    scene = grad_colour, colour, face_index, corners, eps
    got = sweep_gradient.sweep_backward(*scene)
    expected = sweep_gradient.sweep_backward_loop(*scene)
    np.testing.assert_allclose(got, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_the_sweep_of_many_chunks_is_that_of_the_loop(rng, monkeypatch):
    """A chunk of lines that begins anew."""
    monkeypatch.setattr(arrays, "CHUNK", 64)
    test_the_sweep_of_whole_meshes_is_that_of_the_loop(rng, 1e-4)


def test_an_edge_crosses_the_rows_between_its_ends(impl):
    """Rows counted at their lower border, or shares exchanged."""
    row, crossing, share = impl.edge_lines(np.array([2.0, 0.25]), np.array([10.0, 4.25]), 9)
    assert_equal(row, np.arange(4))
    assert_close(crossing, np.array([2.5, 4.5, 6.5, 8.5]))
    assert_close(share, np.array([[15, 1], [11, 5], [7, 9], [3, 13]]) / 16)


@pytest.mark.parametrize("height", [3, 8])
def test_lines_are_those_of_a_search(impl, rng, height):
    """An edge that goes down, or rows outside of the picture."""
    for a, b in rng.uniform(-3, 9, (12, 2, 2)):
        rows = [i for i in range(height) if (i + 0.5 - a[1]) * (i + 0.5 - b[1]) < 0]
        row, crossing, share = impl.edge_lines(a, b, height)
        assert_equal(row, np.array(rows, int))
        t = (np.array(rows) + 0.5 - a[1]) / (b[1] - a[1])
        assert_close(crossing, (1 - t) * a[0] + t * b[0])
        assert_close(share, np.stack([1 - t, t], -1))


def test_a_row_counts_if_its_centre_is_between_the_ends(impl):
    """A centre just beyond an end is crossed, or one just before it is not."""
    for beyond, rows in ((1e-8, [1]), (-1e-8, [0, 1, 2])):
        low, high = np.array([4.0, 0.5 + beyond]), np.array([7.0, 2.5 - beyond])
        assert_equal(impl.edge_lines(low, high, 4)[0], np.array(rows))
        assert_equal(impl.edge_lines(high, low, 4)[0], np.array(rows))


def test_a_row_counts_if_its_centre_is_at_an_end(impl):
    """An edge that ends on a centre does not count there."""
    row, crossing, share = impl.edge_lines(np.array([2.0, 0.5]), np.array([10.0, 4.5]), 9)
    assert_equal(row, np.arange(5))
    assert_close(crossing, np.array([2.0, 4.0, 6.0, 8.0, 10.0]))
    assert_close(share, np.array([[4, 0], [3, 1], [2, 2], [1, 3], [0, 4]]) / 4)


def test_an_edge_along_a_row_crosses_none(impl):
    """0 / 0, or a whole row."""
    for y in 2.0, 2.5:
        row, crossing, share = impl.edge_lines(np.array([1.0, y]), np.array([6.0, y]), 5)
        assert_equal(row, np.zeros(0, int))
        assert_equal((np.shape(crossing), np.shape(share)), ((0,), (0, 2)))


def line(width, first, last, colour=1.0):
    """A row: colour 1 from pixel first to last, which see the face; (W, 1), bool (W,)."""
    sees = (np.arange(width) >= first) & (np.arange(width) <= last)
    return sees[:, None] * colour, sees


def asking(width, pixel, gradient):
    grad_colour = np.zeros((width, 1))
    grad_colour[pixel, 0] = gradient
    return grad_colour


HALF = np.array([0.5, 0.5])


def test_a_pixel_outside_pulls_the_edge_out(impl):
    """The original's own example, outside: row 38 of 64 x 64, pixel 35, the edge at 45.846."""
    # Its edge runs from (57.6, 57.6) to (32, 16): at y = 38.5 it is 22.5 / 41.6 of the way up.
    colour, sees = line(64, 46, 47)
    up = 22.5 / 41.6
    crossing, share = 32 + up * 25.6, np.array([up, 1 - up])
    got = impl.sweep_line(asking(64, 35, -1.0), colour, sees, crossing, -1, share)
    assert_close(got, np.array([1.67258, 1.41987]), rtol=1e-5)


def test_a_pixel_inside_pulls_the_edge_in(impl):
    """The original's own example, inside: row 23 of 64 x 64, pixel 50, edges at 29.894, 57.6."""
    # From (57.6, 57.6) to (16, 6.4), and from (57.6, 6.4) to (57.6, 57.6); 17.1 / 51.2 of the way.
    colour, sees = line(64, 30, 57)
    grad_colour, up = asking(64, 50, 1.0), 17.1 / 51.2
    left = impl.sweep_line(grad_colour, colour, sees, 16 + up * 41.6, -1, np.array([up, 1 - up]))
    assert_close(left, np.array([-0.51863, -1.03417]), rtol=1e-5)
    right = impl.sweep_line(grad_colour, colour, sees, 57.6, 1, np.array([1 - up, up]))
    assert_close(right, np.array([3.00086, 1.50506]), rtol=1e-5)
    assert_close(right, 1 / (7.1 / 32 / np.array([1 - up, up]) + 1e-4))


def test_only_a_change_that_lowers_the_loss_counts(impl):
    """The sign of the loss's gradient makes no difference."""
    colour, sees = line(9, 2, 5)
    for pixel, gradient in (7, 1.0), (4, -1.0), (0, 1.0):
        got = impl.sweep_line(asking(9, pixel, gradient), colour, sees, 6.2, 1, HALF)
        assert_close(got, np.zeros(2))


def test_distances_are_measured_from_the_crossing(impl):
    """From the inner or outer pixel, a pixel's border, or in pixels instead of ndc."""
    colour, sees = line(8, 0, 3)
    grad_colour = asking(8, [2, 6], [1.0, -1.0])
    # d = (2.5 - 4.1) / 2 and (6.5 - 4.1) / 2, with 2 / 8 ndc to a pixel and share 1/2
    got = impl.sweep_line(grad_colour, colour, sees, 4.1, 1, HALF, 0.0)
    assert_close(got, np.full(2, 1 / 0.8 - 1 / 1.2))


def test_epsilon_makes_the_way_longer(impl):
    """eps is taken away on one side, or is in pixels, or scaled by the share."""
    colour, sees = line(8, 0, 3)
    out = impl.sweep_line(asking(8, 6, -1.0), colour, sees, 4.1, 1, HALF, 0.3)
    assert_close(out, np.full(2, -1 / 1.5))
    within = impl.sweep_line(asking(8, 2, 1.0), colour, sees, 4.1, 1, HALF, 0.3)
    assert_close(within, np.full(2, 1 / 1.1))
    left = impl.sweep_line(asking(8, 1, -1.0), colour[::-1], sees[::-1], 3.9, -1, HALF, 0.3)
    assert_close(left, np.full(2, 1 / 1.5))


@pytest.mark.parametrize("side", [1, -1])
def test_a_pixel_on_the_edge_is_inside_and_pulls_it_in(impl, side):
    """The original's sign: its eps is negative at distance 0, whichever side is outside."""
    colour, sees = line(9, 4, 4)
    got = impl.sweep_line(asking(9, 4, 1.0), colour, sees, 4.5, side, np.array([1.0, 0.0]), 0.01)
    assert_close(got, np.array([side * 100.0, 0.0]))


@pytest.mark.parametrize("side", [1, -1])
def test_a_centre_just_beyond_the_crossing_is_outside(impl, side):
    """inner is the pixel that the crossing lies in, or its centres are not at j + 1/2."""
    colour, sees = line(9, 1, 3) if side > 0 else line(9, 5, 7)
    got = impl.sweep_line(asking(9, 4, -1.0), colour, sees, 4.5 - side * 0.02, side, HALF, 0.0)
    assert_close(got, np.full(2, -side / (0.02 * 4 / 9)))


def test_a_hidden_edge_does_not_move_out(impl):
    """The inner pixel's face is not asked for."""
    colour, sees = line(9, 2, 4)
    got = impl.sweep_line(asking(9, 8, -1.0), colour, sees, 6.2, 1, HALF, 0.0)  # inner is 5
    assert_close(got, np.zeros(2))
    got = impl.sweep_line(asking(9, 3, 1.0), colour, sees, 6.2, 1, HALF, 0.0)   # but it moves in
    assert_close(got, np.full(2, 9 / 4 / 2.7))


def test_on_the_way_in_only_the_face_itself_counts(impl):
    """Pixels of other faces behind the edge pull, too; on the way out all pixels do."""
    colour, sees = line(9, 4, 5)
    other = sees | (np.arange(9) == 1)
    colour[1] = colour[8] = 1.0
    got = impl.sweep_line(asking(9, 1, 1.0), colour, sees, 6.0, 1, HALF, 0.0)
    assert_close(got, np.zeros(2))
    got = impl.sweep_line(asking(9, 1, 1.0), colour, other, 6.0, 1, HALF, 0.0)
    assert_close(got, np.full(2, 1 / (4.5 * 4 / 9)))
    colour = 0.5 * colour + asking(9, 8, 2.0)
    got = impl.sweep_line(asking(9, 8, 1.0), colour, sees, 6.0, 1, HALF, 0.0)
    assert_close(got, np.full(2, -2 / (2.5 * 4 / 9)))


@pytest.mark.parametrize("crossing, side", [(9.7, 1), (0.3, -1), (-2.0, 1), (0.2, 1), (9.5, 1),
                                            (9.9, -1), (12.0, -1), (0.5, -1)])
def test_an_edge_at_the_border_of_the_picture_has_no_gradient(impl, rng, crossing, side):
    """Inner or outer outside of the picture: an index that goes round, or the last pixel twice."""
    colour, grad_colour = rng.random((10, 3)), rng.normal(size=(10, 3))
    got = impl.sweep_line(grad_colour, colour, np.ones(10, bool), crossing, side, HALF)
    assert_close(got, np.zeros(2))


@pytest.mark.parametrize("crossing, side", [(9.4, 1), (0.6, -1), (0.5, 1), (9.5, -1), (8.5, 1)])
def test_the_last_edge_before_the_border_has_one(impl, crossing, side):
    """A border that is one pixel too wide."""
    colour, sees = line(10, 3, 9) if side < 0 else line(10, 0, 6)
    sees[:] = True
    grad_colour = np.where(colour > 0, 1.0, -1.0)
    got = impl.sweep_line(grad_colour, colour, sees, crossing, side, HALF)
    assert_equal(bool((got != 0).all()), True)


def test_channels_are_added_before_the_loss_is_asked(impl):
    """max(0, ...) of each channel, or their mean."""
    colour = np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 1.0]])
    sees, grad_colour = np.arange(4) < 2, np.zeros((4, 2))
    grad_colour[3] = -3.0, 1.0
    got = impl.sweep_line(grad_colour, colour, sees, 2.0, 1, HALF, 0.0)
    assert_close(got, np.full(2, -4 / 1.5))
    grad_colour[3] = 3.0, 1.0
    assert_close(impl.sweep_line(grad_colour, colour, sees, 2.0, 1, HALF, 0.0), np.zeros(2))


@pytest.mark.parametrize("side", [1, -1])
def test_a_line_is_a_sum_over_its_pixels(impl, rng, side):
    """One of the two sums is lost, or a pixel is counted in both. Pixel by pixel."""
    for _ in range(5):
        colour, grad_colour = rng.random((11, 3)), rng.normal(size=(11, 3))
        sees, crossing, share = rng.random(11) < 0.7, rng.uniform(2, 9), rng.dirichlet([1, 1])
        inner = max(j for j in range(11) if j + 0.5 <= crossing) if side > 0 else min(
            j for j in range(11) if j + 0.5 >= crossing)
        expected = np.zeros(2)
        for j in range(11):
            out = (j + 0.5 - crossing) * side > 0
            change = (colour[inner if out else inner + side] - colour[j]) @ grad_colour[j]
            if change < 0 and (sees[inner] if out else sees[j]):
                way = (j + 0.5 - crossing) * 2 / 11 / share
                expected += change / (way + 1e-3 * np.sign(way))
        got = impl.sweep_line(grad_colour, colour, sees, crossing, side, share, 1e-3)
        assert_close(got, expected)
