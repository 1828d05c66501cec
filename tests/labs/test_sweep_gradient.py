"""What the exercises of lab 10's sweep must do."""
import numpy as np
import pytest

from course.checks import assert_close, assert_equal, exercise


@exercise("10.12")
def test_an_edge_crosses_the_rows_between_its_ends(impl):
    """Rows counted at their lower border, or shares exchanged."""
    row, crossing, share = impl.edge_lines(np.array([2.0, 0.25]), np.array([10.0, 4.25]), 9)
    assert_equal(row, np.arange(4))
    assert_close(crossing, np.array([2.5, 4.5, 6.5, 8.5]))
    assert_close(share, np.array([[15, 1], [11, 5], [7, 9], [3, 13]]) / 16)


@exercise("10.12")
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


@exercise("10.12")
def test_a_row_counts_if_its_centre_is_between_the_ends(impl):
    """A centre just beyond an end is crossed, or one just before it is not."""
    for beyond, rows in ((1e-8, [1]), (-1e-8, [0, 1, 2])):
        low, high = np.array([4.0, 0.5 + beyond]), np.array([7.0, 2.5 - beyond])
        assert_equal(impl.edge_lines(low, high, 4)[0], np.array(rows))
        assert_equal(impl.edge_lines(high, low, 4)[0], np.array(rows))


@exercise("10.12", fine_print=True)
def test_a_row_counts_if_its_centre_is_at_an_end(impl):
    """An edge that ends on a centre does not count there."""
    row, crossing, share = impl.edge_lines(np.array([2.0, 0.5]), np.array([10.0, 4.5]), 9)
    assert_equal(row, np.arange(5))
    assert_close(crossing, np.array([2.0, 4.0, 6.0, 8.0, 10.0]))
    assert_close(share, np.array([[4, 0], [3, 1], [2, 2], [1, 3], [0, 4]]) / 4)


@exercise("10.12", fine_print=True)
def test_an_edge_along_a_row_crosses_none(impl):
    """0 / 0, or a whole row."""
    for y in 2.0, 2.5:
        row, crossing, share = impl.edge_lines(np.array([1.0, y]), np.array([6.0, y]), 5)
        assert_equal(row, np.zeros(0, int))
        assert_equal((np.shape(crossing), np.shape(share)), ((0,), (0, 2)))


NONE = np.zeros(2)


@exercise("10.13")
def test_two_pixels_pull_on_paper(impl):
    """The sign: descent must take the edge to the pixel; or the share multiplies the way."""
    colour, beyond = np.array([[1.0], [0.0]]), np.array([[0.0], [1.0]])
    grad_colour, way = np.array([[3.0], [-2.0]]), np.array([0.5, -0.25])  # they pull by 3 and 2
    got = impl.pull_on_edge(grad_colour, colour, beyond, way, np.array([0.25, 0.75]), NONE)
    assert_close(got, np.array([-3 / 2 + 2 / 1, -3 / (2 / 3) + 2 / (1 / 3)]))


@exercise("10.13")
def test_a_pixel_outside_pulls_as_in_the_original(impl):
    """The original's own example, outside: row 38 of 64 x 64, pixel 35, the edge at 45.846."""
    # Its edge runs from (57.6, 57.6) to (32, 16): at y = 38.5 it is 22.5 / 41.6 of the way up.
    up = 22.5 / 41.6
    way = np.array([2 / 64 * (35.5 - (32 + up * 25.6))])
    got = impl.pull_on_edge(np.array([[-1.0]]), np.array([[0.0]]), np.array([[1.0]]), way,
                            np.array([up, 1 - up]), np.array([-1e-4]))
    assert_close(got, np.array([1.67258, 1.41987]), rtol=1e-5)


@exercise("10.13")
def test_only_a_change_that_lowers_the_loss_counts(impl):
    """max(0, ...) is left out, or is taken of the sum over the pixels."""
    colour, beyond = np.array([[1.0], [0.0], [1.0]]), np.array([[0.0], [1.0], [0.0]])
    got = impl.pull_on_edge(np.array([[-3.0], [2.0], [4.0]]), colour, beyond,
                            np.array([0.5, 0.125, 1.0]), np.array([0.25, 0.5]), np.zeros(3))
    assert_close(got, np.array([-1.0, -2.0]))


@exercise("10.13")
def test_epsilon_is_added_to_the_way_of_each_end(impl):
    """eps is scaled by the share, or taken away."""
    way, eps, share = np.array([0.5, -0.25]), np.array([0.25, -0.5]), np.array([0.5, 0.125])
    got = impl.pull_on_edge(np.ones((2, 1)), np.array([[3.0], [2.0]]), np.zeros((2, 1)), way, share,
                            eps)
    assert_close(got, np.array([-3 / 1.25 + 2 / 1.0, -3 / 4.25 + 2 / 2.5]))


@exercise("10.13")
def test_channels_are_added_before_the_loss_is_asked(impl):
    """max(0, ...) of each channel, or their mean."""
    colour, beyond = np.array([[0.0, 1.0]]), np.array([[1.0, 0.0]])
    way, share = np.array([0.75]), np.array([0.5, 0.25])
    for grad_colour, pull in ([-3.0, 1.0], 4.0), ([3.0, 1.0], 0.0), ([2.0, 7.0], 5.0):
        got = impl.pull_on_edge(np.array([grad_colour]), colour, beyond, way, share, np.zeros(1))
        assert_close(got, np.array([-pull / 1.5, -pull / 3]))


@exercise("10.13")
def test_a_pull_is_a_sum_over_pixels(impl, rng):
    """A pixel is lost, or two pixels are mixed. Pixel by pixel."""
    for count in 0, 1, 7:
        colour, beyond, grad_colour = rng.normal(size=(3, count, 3))
        way, share = rng.choice([-1, 1], count) * rng.uniform(0.1, 1, count), rng.dirichlet([1, 1])
        expected = np.zeros(2)
        for j in range(count):
            gain = (colour[j] - beyond[j]) @ grad_colour[j]
            if gain > 0:
                expected -= gain / (way[j] / share + 0.02 * np.sign(way[j]))
        got = impl.pull_on_edge(grad_colour, colour, beyond, way, share, 0.02 * np.sign(way))
        assert_close(got, expected)


@exercise("10.13", fine_print=True)
def test_an_end_without_a_share_gets_nothing(impl):
    """0 / 0, where the pixel lies on the crossing."""
    got = impl.pull_on_edge(np.ones((2, 1)), np.ones((2, 1)), np.zeros((2, 1)),
                            np.array([0.0, 0.5]), np.array([1.0, 0.0]), np.array([0.5, 0.5]))
    assert_close(got, np.array([-3.0, 0.0]))
