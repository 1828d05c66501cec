"""What the exercises of lab 10's sweep must do."""
import numpy as np

from course.checks import assert_close, exercise


@exercise("10.12")
def test_crossings_on_paper(impl):
    """The shares are exchanged, or x and y."""
    crossing, share = impl.edge_crossing(np.array([2.0, 0.25]), np.array([10.0, 4.25]),
                                         np.array([0.5, 1.5, 3.5]))
    assert_close(crossing, np.array([2.5, 4.5, 8.5]))
    assert_close(share, np.array([[15, 1], [11, 5], [3, 13]]) / 16)


@exercise("10.12")
def test_each_edge_has_its_own_row(impl, rng):
    """Many edges at once, up and down; ends that are exchanged for half of them."""
    a, b = rng.uniform(-3, 9, (2, 4, 5, 2))
    t = rng.uniform(0, 1, (4, 5))
    crossing, share = impl.edge_crossing(a, b, (1 - t) * a[..., 1] + t * b[..., 1])
    assert_close(crossing, (1 - t) * a[..., 0] + t * b[..., 0], atol=1e-9)
    assert_close(share, np.stack([1 - t, t], -1), atol=1e-9)


@exercise("10.12")
def test_a_share_is_how_far_the_crossing_moves_with_its_end(impl, rng):
    """A share that belongs to the other end: an end moves by 1 along x."""
    a, b, y = np.array([1.5, 2.0]), np.array([4.0, 7.0]), np.array(3.25)
    crossing, share = impl.edge_crossing(a, b, y)
    moved_a, _ = impl.edge_crossing(a + [1.0, 0.0], b, y)
    moved_b, _ = impl.edge_crossing(a, b + [1.0, 0.0], y)
    assert_close(np.array([moved_a, moved_b]) - crossing, np.asarray(share))


@exercise("10.13")
def test_two_pixels_pull_on_paper(impl):
    """The sign: descent must take the edge to the pixel; or the share multiplies the way."""
    colour, beyond = np.array([[1.0], [0.0]]), np.array([[0.0], [1.0]])
    grad_colour, way = np.array([[3.0], [-2.0]]), np.array([0.5, -0.25])  # they pull by 3 and 2
    got = impl.edge_pulls(grad_colour, colour, beyond, way, np.array([[0.25, 0.75]] * 2),
                          np.zeros(2))
    assert_close(got, np.array([[-3 / 2, -3 / (2 / 3)], [2 / 1, 2 / (1 / 3)]]))


@exercise("10.13")
def test_a_pixel_outside_pulls_as_in_the_original(impl):
    """The original's own example, outside: row 38 of 64 x 64, pixel 35, the edge at 45.846."""
    # Its edge runs from (57.6, 57.6) to (32, 16): at y = 38.5 it is 22.5 / 41.6 of the way up.
    up = 22.5 / 41.6
    way = np.array([2 / 64 * (35.5 - (32 + up * 25.6))])
    got = impl.edge_pulls(np.array([[-1.0]]), np.array([[0.0]]), np.array([[1.0]]), way,
                          np.array([[up, 1 - up]]), np.array([-1e-4]))
    assert_close(got, np.array([[1.67258, 1.41987]]), rtol=1e-5)


@exercise("10.13")
def test_only_a_change_that_lowers_the_loss_counts(impl):
    """max(0, ...) is left out."""
    colour, beyond = np.array([[1.0], [0.0], [1.0]]), np.array([[0.0], [1.0], [0.0]])
    got = impl.edge_pulls(np.array([[-3.0], [2.0], [4.0]]), colour, beyond,
                          np.array([0.5, 0.125, 1.0]), np.array([[0.25, 0.5]] * 3), np.zeros(3))
    assert_close(got, np.array([[0.0, 0.0], [0.0, 0.0], [-1.0, -2.0]]))


@exercise("10.13")
def test_epsilon_is_added_to_the_way_of_each_end(impl):
    """eps is scaled by the share, or taken away."""
    way, eps = np.array([0.5, -0.25]), np.array([0.25, -0.5])
    got = impl.edge_pulls(np.ones((2, 1)), np.array([[3.0], [2.0]]), np.zeros((2, 1)), way,
                          np.array([[0.5, 0.125]] * 2), eps)
    assert_close(got, np.array([[-3 / 1.25, -3 / 4.25], [2 / 1.0, 2 / 2.5]]))


@exercise("10.13")
def test_channels_are_added_before_the_loss_is_asked(impl):
    """max(0, ...) of each channel, or their mean."""
    grad_colour = np.array([[-3.0, 1.0], [3.0, 1.0], [2.0, 7.0]])
    colour, beyond = np.array([[0.0, 1.0]] * 3), np.array([[1.0, 0.0]] * 3)
    got = impl.edge_pulls(grad_colour, colour, beyond, np.full(3, 0.75),
                          np.array([[0.5, 0.25]] * 3), np.zeros(3))
    assert_close(got, np.array([[-4 / 1.5, -4 / 3], [0.0, 0.0], [-5 / 1.5, -5 / 3]]))


@exercise("10.13")
def test_every_pixel_pulls_on_its_own_edge(impl, rng):
    """Two pixels are mixed, or they are added up. Pixel by pixel."""
    for count in 0, 1, 7:
        colour, beyond, grad_colour = rng.normal(size=(3, count, 3))
        way, share = rng.choice([-1, 1], count) * rng.uniform(0.1, 1, count), rng.random((count, 2))
        expected = np.zeros((count, 2))
        for j in range(count):
            gain = max(0.0, (colour[j] - beyond[j]) @ grad_colour[j])
            expected[j] = -gain / (way[j] / share[j] + 0.02 * np.sign(way[j]))
        got = impl.edge_pulls(grad_colour, colour, beyond, way, share, 0.02 * np.sign(way))
        assert_close(got, expected)


@exercise("10.13", fine_print=True)
def test_an_end_without_a_share_gets_nothing(impl):
    """0 / 0, where the pixel lies on the crossing."""
    got = impl.edge_pulls(np.ones((2, 1)), np.ones((2, 1)), np.zeros((2, 1)), np.array([0.0, 0.5]),
                          np.array([[1.0, 0.0], [0.0, 0.5]]), np.array([0.5, 0.25]))
    assert_close(got, np.array([[-2.0, 0.0], [0.0, -0.8]]))
