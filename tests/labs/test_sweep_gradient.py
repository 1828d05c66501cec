"""What the exercises of lab 10's sweep must do."""
import numpy as np
import pytest

from labkit.checks import Mismatch, assert_close, assert_equal, exercise

ENDS = np.array([2.0, 0.25]), np.array([10.0, 4.25])
ROWS = np.array([0.5, 1.5, 3.5, 2.75])


def two(returned):
    """x_edge, share of what was returned. Mismatch: these are not two."""
    if not isinstance(returned, tuple) or len(returned) != 2:
        raise Mismatch(("wrong", "two outputs are expected: x_edge, and share"))
    return returned


@exercise("10.12")
def test_crossings_on_paper(impl):
    """a and b are exchanged. a_x is not added. The share is not divided by b_y - a_y. 1/2 is added
    to y, which is a row's centre already. x and y are exchanged: the edge crosses a column. The
    outputs come in the other order.
    """
    crossing, _ = two(impl.edge_crossing(*ENDS, ROWS))
    assert_close(crossing, [2.5, 4.5, 8.5, 7.0])


@exercise("10.12")
def test_shares_on_paper(impl):
    """The shares are exchanged: share_b comes first. They are stacked along the first axis, not the
    last one. There is one alone.
    """
    _, share = two(impl.edge_crossing(*ENDS, ROWS))
    assert_close(share, np.array([[15, 1], [11, 5], [3, 13], [6, 10]]) / 16)


@exercise("10.12")
def test_each_edge_has_its_own_row(impl, rng):
    """Edges that go down are taken for edges that go up. Or one edge alone is taken: x and y are
    along the last axis.
    """
    a, b = rng.uniform(-3, 9, (2, 4, 5, 2))
    t = rng.uniform(0, 1, (4, 5))
    crossing, share = two(impl.edge_crossing(a, b, (1 - t) * a[..., 1] + t * b[..., 1]))
    assert_close(crossing, (1 - t) * a[..., 0] + t * b[..., 0], atol=1e-9)
    assert_close(share, np.stack([1 - t, t], -1), atol=1e-9)


@exercise("10.12")
def test_a_share_is_how_far_the_crossing_moves_with_its_end(impl, rng):
    """A share belongs to the other end: it tells how far the crossing moves where its own end moves
    by 1 along x.
    """
    a, b, y = np.array([1.5, 2.0]), np.array([4.0, 7.0]), np.array(3.25)
    crossing, share = two(impl.edge_crossing(a, b, y))
    moved_a, _ = two(impl.edge_crossing(a + [1.0, 0.0], b, y))
    moved_b, _ = two(impl.edge_crossing(a, b + [1.0, 0.0], y))
    assert_close(np.array([moved_a, moved_b]) - crossing, np.asarray(share))


@exercise("10.13")
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


@exercise("10.13")
def test_only_a_change_that_lowers_the_loss_counts(impl):
    """max(0, ...) is left out: pixels that would raise the loss pull, too."""
    colour, beyond = np.array([[1.0], [0.0], [1.0]]), np.array([[0.0], [1.0], [0.0]])
    got = impl.edge_pulls(np.array([[-3.0], [2.0], [4.0]]), colour, beyond,
                          np.array([0.5, 0.125, 1.0]), np.array([[0.25, 0.5]] * 3), np.zeros(3))
    assert_close(got, [[0.0, 0.0], [0.0, 0.0], [-1.0, -2.0]])


@exercise("10.13")
def test_epsilon_is_added_to_the_way_of_each_end(impl):
    """eps has the sign of way already: here it is signed twice, or loses its sign. It is scaled by
    the share, taken away, or left out.
    """
    way, eps = np.array([0.5, -0.25]), np.array([0.25, -0.25])
    got = impl.edge_pulls(np.ones((2, 1)), np.array([[3.0], [2.0]]), np.zeros((2, 1)), way,
                          np.array([[0.5, 0.125]] * 2), eps)
    assert_close(got, [[-3 / 1.25, -3 / 4.25], [2 / 0.75, 2 / 2.25]])


@exercise("10.13")
def test_channels_are_added_before_the_loss_is_asked(impl):
    """max(0, ...) is taken of each channel, before their sum. Or it is their mean."""
    grad_colour = np.array([[-3.0, 1.0], [3.0, 1.0], [2.0, 7.0]])
    colour, beyond = np.array([[0.0, 1.0]] * 3), np.array([[1.0, 0.0]] * 3)
    got = impl.edge_pulls(grad_colour, colour, beyond, np.full(3, 0.75),
                          np.array([[0.5, 0.25]] * 3), np.zeros(3))
    assert_close(got, [[-4 / 1.5, -4 / 3], [0.0, 0.0], [-5 / 1.5, -5 / 3]])


@exercise("10.13")
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


@exercise("10.13")
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


@exercise("10.13", fine_print=True)
def test_an_end_without_a_share_gets_nothing(impl):
    """way / share with a share of 0 is a division by 0: NaN where the pixel lies on the crossing.
    """
    got = impl.edge_pulls(np.ones((2, 1)), np.ones((2, 1)), np.zeros((2, 1)), np.array([0.0, 0.5]),
                          np.array([[1.0, 0.0], [0.0, 0.5]]), np.array([0.5, 0.25]))
    assert_close(got, [[-2.0, 0.0], [0.0, -0.8]])


def line(width, first, last, colour=1.0):
    """A row: colour 1 from pixel first to last, which see the face: (W, 1), bool (W,)."""
    sees = (np.arange(width) >= first) & (np.arange(width) <= last)
    return sees[:, None] * colour, sees


def asking(width, pixel, gradient):
    grad_colour = np.zeros((width, 1))
    grad_colour[pixel, 0] = gradient
    return grad_colour


HALF = np.array([0.5, 0.5])


@exercise("10.14")
@pytest.mark.parametrize("side", [1, -1])
def test_a_pixel_on_the_edge_is_inside_and_pulls_it_in(impl, side):
    """At a distance of 0, eps is taken for negative, as neural_renderer's own code does, whichever
    side is outside. Or the pixel counts as outside.
    """
    colour, sees = line(9, 4, 4)
    got = impl.sweep_line(asking(9, 4, 1.0), colour, sees, 4.5, side, HALF, 0.01)
    assert_close(got, [side * 100.0, side * 100.0])


@exercise("10.14")
@pytest.mark.parametrize("side", [1, -1])
def test_a_centre_just_beyond_the_crossing_is_outside(impl, side):
    """inner is the pixel that the crossing lies in, or its centres are not at j + 1/2."""
    colour, sees = line(9, 1, 3) if side > 0 else line(9, 5, 7)
    got = impl.sweep_line(asking(9, 4, -1.0), colour, sees, 4.5 - side * 0.02, side, HALF, 0.0)
    assert_close(got, np.full(2, -side / (0.02 * 4 / 9)))


@exercise("10.14")
@pytest.mark.parametrize("crossing, side", [(9.7, 1), (0.3, -1), (-2.0, 1), (0.2, 1), (9.5, 1),
                                            (9.9, -1), (12.0, -1), (0.5, -1)])
def test_an_edge_at_the_border_of_the_picture_has_no_gradient(impl, rng, crossing, side):
    """Inner or outer outside of the picture: an index that goes round, or the last pixel twice."""
    colour, grad_colour = rng.random((10, 3)), rng.normal(size=(10, 3))
    got = impl.sweep_line(grad_colour, colour, np.ones(10, bool), crossing, side, HALF)
    assert_close(got, np.zeros(2))


@exercise("10.14")
@pytest.mark.parametrize("crossing, side", [(9.4, 1), (0.6, -1), (0.5, 1), (9.5, -1), (8.5, 1)])
def test_the_last_edge_before_the_border_has_one(impl, crossing, side):
    """A border that is one pixel too wide."""
    colour, sees = line(10, 3, 9) if side < 0 else line(10, 0, 6)
    sees[:] = True
    grad_colour = np.where(colour > 0, 1.0, -1.0)
    got = impl.sweep_line(grad_colour, colour, sees, crossing, side, HALF)
    assert_equal(bool((got != 0).all()), True)


@exercise("10.14")
@pytest.mark.parametrize("side", [1, -1])
def test_a_line_is_a_sum_over_its_pixels(impl, rng, side):
    """Pixel by pixel: one of the two sums is lost, or a pixel is counted in both. A change that
    raises the loss counts, or each channel alone. A hidden edge moves out, or other faces pull
    it in. Distances are in pixels, or not measured from the crossing. eps is on one side only.
    """
    for eps in 4 * [1e-3, 0.3]:
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
                expected += change / (way + eps * np.sign(way))
        got = impl.sweep_line(grad_colour, colour, sees, crossing, side, share, eps)
        assert_close(got, expected)
