"""What the exercises of lab 10's sweep must do."""
import numpy as np
import pytest

from labkit.checks import assert_close, assert_equal, exercise


@exercise("10.6")
def test_two_pixels_pull_on_paper(impl):
    """The minus is left out: descent must take the edge to the pixel. The difference of the colours
    has the wrong sign, or grad_colour is left out. way loses its sign, as an absolute value. The
    share multiplies the way, or is left out.
    """
    colour, beyond = np.array([[1.0], [0.0]]), np.array([[0.0], [1.0]])
    grad_colour, way = np.array([[3.0], [-2.0]]), np.array([0.5, -0.25])  # they pull by 3 and 2
    got = impl.edge_pulls(grad_colour, colour, beyond, way, np.array([[0.25, 0.75]] * 2),
                          np.zeros(2))
    assert_close(got, [[-3 / 2, -3 / (2 / 3)], [2 / 1, 2 / (1 / 3)]])


@exercise("10.6")
def test_channels_are_added_before_the_loss_is_asked(impl):
    """max(0, ...) is taken of each channel, before their sum. Or it is their mean."""
    grad_colour = np.array([[-3.0, 1.0], [3.0, 1.0], [2.0, 7.0]])
    colour, beyond = np.array([[0.0, 1.0]] * 3), np.array([[1.0, 0.0]] * 3)
    got = impl.edge_pulls(grad_colour, colour, beyond, np.full(3, 0.75),
                          np.array([[0.5, 0.25]] * 3), np.zeros(3))
    assert_close(got, [[-4 / 1.5, -4 / 3], [0.0, 0.0], [-5 / 1.5, -5 / 3]])


@exercise("10.6")
def test_every_pixel_pulls_on_its_own_edge(impl, rng):
    """Pixels are mixed, or are added up: each has its own row. Or no pixel at all is an error."""
    for count in 0, 1, 7:
        colour, beyond, grad_colour = rng.normal(size=(3, count, 3))
        way, share = rng.choice([-1, 1], count) * rng.uniform(0.1, 1, count), rng.random((count, 2))
        expected = np.zeros((count, 2))
        for j in range(count):
            gain = max(0.0, (colour[j] - beyond[j]) @ grad_colour[j])
            expected[j] = -gain / (way[j] / share[j] + 0.02 * np.sign(way[j]))
        got = impl.edge_pulls(grad_colour, colour, beyond, way, share, 0.02 * np.sign(way))
        assert_close(got, expected)


@exercise("10.6")
def test_a_pixel_outside_pulls_as_in_the_original(impl):
    """eps is scaled or left out, or way is not divided by the share.

    The original's own example, outside: row 38 of 64 x 64, pixel 35, the edge at 45.846.
    """
    # Its edge runs from (57.6, 57.6) to (32, 16): at y = 38.5 it is 22.5 / 41.6 of the way up.
    up = 22.5 / 41.6
    way = np.array([2 / 64 * (35.5 - (32 + up * 25.6))])
    got = impl.edge_pulls(np.array([[-1.0]]), np.array([[0.0]]), np.array([[1.0]]), way,
                          np.array([[up, 1 - up]]), np.array([-1e-4]))
    assert_close(got, [[1.67258, 1.41987]], rtol=1e-5)


@exercise("10.6", fine_print=True)
def test_an_end_without_a_share_gets_nothing(impl):
    """way / share with a share of 0 is a division by 0: NaN where the pixel lies on the crossing.
    """
    got = impl.edge_pulls(np.ones((2, 1)), np.ones((2, 1)), np.zeros((2, 1)), np.array([0.0, 0.5]),
                          np.array([[1.0, 0.0], [0.0, 0.5]]), np.array([0.5, 0.25]))
    assert_close(got, [[-2.0, 0.0], [0.0, -0.8]])


def line(width, first, last):
    """A line that sees the face, and is 1, from pixel first to last: colour (1, W, 1), sees."""
    sees = (np.arange(width) >= first) & (np.arange(width) <= last)
    return sees[None, :, None] * 1.0, sees[None]


def asking(width, pixel, gradient):
    return gradient * (np.arange(width) == pixel)[None, :, None]


def edge(crossing, side, share=(0.5, 0.5)):
    return np.array([crossing]), np.array([side]), np.array([share])


@exercise("10.7")
@pytest.mark.parametrize("side", [1, -1])
def test_a_pixel_outside_calls_the_edge(impl, side):
    """It asks to shine as the inner pixel does. way is in pixels, or not to the pixel's centre, or
    the sign is wrong. A pixel outside does not see the face, and counts nevertheless.
    """
    colour, sees = line(8, 2, 5)
    got = impl.sweep_lines(asking(8, 4 + 3 * side, -1.5), colour, sees,
                           *edge(4.5 + 1.75 * side, side, (0.25, 0.75)), 0.0)
    assert_close(got, [[-1.2 * side, -3.6 * side]])


@exercise("10.7")
@pytest.mark.parametrize("side", [1, -1])
def test_a_pixel_on_the_edge_is_inside_and_pulls_it_in(impl, side):
    """At a distance of 0, eps is taken for negative, as neural_renderer's own code does, whichever
    side is outside. Or the pixel counts as outside.
    """
    colour, sees = line(9, 4, 4)
    got = impl.sweep_lines(asking(9, 4, 1.0), colour, sees, *edge(4.5, side), 0.01)
    assert_close(got, [[side * 100.0, side * 100.0]])


@exercise("10.7")
@pytest.mark.parametrize("side", [1, -1])
def test_a_centre_just_beyond_the_crossing_is_outside(impl, side):
    """inner is the pixel that the crossing lies in, or its centres are not at j + 1/2."""
    colour, sees = line(9, 1, 3) if side > 0 else line(9, 5, 7)
    got = impl.sweep_lines(asking(9, 4, -1.0), colour, sees, *edge(4.5 - side * 0.02, side), 0.0)
    assert_close(got, np.full((1, 2), -side / (0.02 * 4 / 9)))


@exercise("10.7")
def test_a_hidden_edge_does_not_move_out(impl):
    """Another face hides the edge, and outside pixels call it. Or the face's own pixels, farther
    in, do not pull it in.
    """
    colour, sees = line(8, 1, 5)
    sees[0, 5] = False
    for pixel, gradient, expected in (7, -1.0, 0.0), (3, 1.0, -2 / 2.25):
        got = impl.sweep_lines(asking(8, pixel, gradient), colour, sees, *edge(5.75, 1), 0.0)
        assert_close(got, np.full((1, 2), -expected))


@exercise("10.7")
def test_an_edge_at_the_border_of_the_picture_has_no_gradient(impl, rng):
    """Inner or outer outside of the picture: an index that goes round, or the last pixel twice. Or
    a border that is one pixel too wide.
    """
    edges = [(9.7, 1), (0.3, -1), (-2.0, 1), (0.2, 1), (9.5, 1), (9.9, -1), (12.0, -1), (0.5, -1),
             (9.4, 1), (0.6, -1), (0.5, 1), (9.5, -1), (8.5, 1)]
    crossing, side = np.array([at for at, _ in edges]), np.array([side for _, side in edges])
    colour, grad_colour = rng.random((13, 10, 3)), rng.normal(size=(13, 10, 3))
    got = np.asarray(impl.sweep_lines(grad_colour, colour, np.ones((13, 10), bool), crossing, side,
                                      np.full((13, 2), 0.5)))
    assert_close(got[:8], np.zeros((8, 2)))
    assert_equal((got[8:] != 0).all(1), np.ones(5, bool))


@exercise("10.7")
def test_a_line_is_a_sum_over_its_pixels(impl, rng):
    """Pixel by pixel: one of the two sums is lost, or a pixel is counted in both. A change that
    raises the loss counts, or each channel alone. Lines are mixed. eps is on one side only.
    """
    for eps in 1e-3, 0.3:
        colour, grad_colour = rng.random((9, 11, 3)), rng.normal(size=(9, 11, 3))
        sees, crossing = rng.random((9, 11)) < 0.7, rng.uniform(2, 9, 9)
        side, share = rng.choice([-1, 1], 9), rng.dirichlet([1, 1], 9)
        expected = np.zeros((9, 2))
        for k, j in np.ndindex(9, 11):
            inner = int(max(c for c in range(11) if (c + 0.5 - crossing[k]) <= 0)
                        if side[k] > 0 else min(c for c in range(11) if c + 0.5 >= crossing[k]))
            out = (j + 0.5 - crossing[k]) * side[k] > 0
            change = (colour[k, inner if out else inner + side[k]] - colour[k, j]) @ (
                grad_colour[k, j])
            if change < 0 and (sees[k, inner] if out else sees[k, j]):
                way = (j + 0.5 - crossing[k]) * 2 / 11 / share[k]
                expected[k] += change / (way + eps * np.sign(way))
        got = impl.sweep_lines(grad_colour, colour, sees, crossing, side, share, eps)
        assert_close(got, expected)
