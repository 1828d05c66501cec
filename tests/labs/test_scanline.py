"""What the exercises of lab 2's fast rasterizer must do."""
import numpy as np
import pytest

from labkit.checks import assert_close, assert_equal, exercise


def sides(planes, x, y):
    """e of planes (4, 3, F) at (x, y)."""
    n_x, n_y, from_x, from_y = planes
    return n_x * (x - from_x) + n_y * (y - from_y)


@exercise("2.11")
def test_the_planes_of_a_face_on_paper(impl):
    """Row k is the edge that starts at vertex k instead of the one opposite to it. n points out of
    the face, n_x and n_y are swapped, or n has another length. from is the wrong point.
    """
    x, y, w = np.array([[1.0, 7.0, 3.0], [1.0, 2.0, 6.0], [1.0, 1.0, 1.0]])[..., None]
    n_x, n_y, from_x, from_y = impl.half_planes(x, y, w)
    assert_close(np.hstack([n_x, n_y]), [[-4.0, -4.0], [5.0, -2.0], [-1.0, 6.0]])
    # At (0, 0), from whichever end of the edge.
    assert_close(sides((n_x, n_y, from_x, from_y), 0.0, 0.0), [[36.0], [-3.0], [-5.0]])


@exercise("2.11")
def test_the_normals_of_a_clockwise_face_point_into_it_too(impl):
    """The sign of A (the winding) is left out: the normals of clockwise faces point out of them,
    and they cover nothing. Or its size is left in.
    """
    x, y, w = np.array([[3.0, 7.0, 1.0], [6.0, 2.0, 1.0], [1.0, 1.0, 1.0]])[..., None]
    n_x, n_y, _, _ = impl.half_planes(x, y, w)
    assert_close(np.hstack([n_x, n_y]), [[-1.0, 6.0], [5.0, -2.0], [-4.0, -4.0]])


@exercise("2.11")
def test_a_corner_behind_the_camera_turns_its_edge_on_paper(impl):
    """The sign of w is left out: faces that cross the camera plane come out where they are not. Or
    it is that of another corner, or of all three multiplied. Or w itself is multiplied, or |w|.
    """
    x, y, w = np.array([[1.0, 7.0, 3.0], [1.0, 2.0, 6.0], [-2.0, 3.0, 4.0]])[..., None]
    n_x, n_y, _, _ = impl.half_planes(x, y, w)
    assert_close(np.hstack([n_x, n_y]), [[4.0, 4.0], [5.0, -2.0], [-1.0, 6.0]])


@exercise("2.11")
def test_the_planes_hold_what_the_inverse_of_m_says(impl, rng):
    """Right for one corner behind the camera, but not for two or three."""
    p = rng.uniform(-5, 5, 2)
    for _ in range(100):
        x, y = rng.uniform(-10, 10, (2, 3, 1))
        w = rng.uniform(0.5, 2, (3, 1)) * rng.choice([-1, 1], (3, 1))
        c = np.linalg.solve(np.concatenate([w * x, w * y, w], 1).T, [*p, 1])
        side = sides(np.array(impl.half_planes(x, y, w)), *p)[:, 0]
        assert_equal(side > 0, c > 0)


@exercise("2.11", fine_print=True)
def test_the_two_faces_at_an_edge_agree_in_every_bit(impl, rng):
    """The edge is measured from another end, or scaled, in one of the two faces."""
    x, y, w = rng.normal(size=(3, 4, 500)) * 10.0 ** rng.integers(-2, 3, (3, 4, 500))
    w[:, :250] = 1.0
    one = np.array(impl.half_planes(x[[0, 1, 2]], y[[0, 1, 2]], w[[0, 1, 2]]))[:, 0]
    other = np.array(impl.half_planes(x[[3, 2, 1]], y[[3, 2, 1]], w[[3, 2, 1]]))[:, 0]
    p = rng.normal(size=2)
    assert_equal(np.abs(sides(one, *p)), np.abs(sides(other, *p)))


@exercise("2.11")
def test_an_edge_is_exactly_zero_at_its_ends(impl, rng):
    """a x + (b y + c): a vertex on a pixel's centre is lost between the faces around it."""
    x, y = rng.normal(size=(2, 3, 200)) * 100
    planes = np.array(impl.half_planes(x, y, np.ones((3, 200))))
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        for end in (i, j):
            assert_equal(sides(planes[:, k], x[end], y[end]), np.zeros(200))


@exercise("2.11", fine_print=True)
def test_an_edge_is_measured_from_its_end_of_greater_w(impl):
    """Its end is that of smaller |w|, or of greater w instead of |w|, or always the first end, or
    that of smaller x, although |w| differs.
    """
    x, y, w = np.array([[0.0, 9.0, 4.0], [1.0, 2.0, 7.0], [1.0, -3.0, 2.0]])[..., None]
    _, _, from_x, from_y = impl.half_planes(x, y, w)
    assert_close(from_x, [[9.0], [4.0], [9.0]])
    assert_close(from_y, [[2.0], [7.0], [2.0]])
    w = np.array([[1.0], [1.0 + 1e-12], [1.0 + 2e-12]])  # not equal, if only just
    _, _, from_x, _ = impl.half_planes(x, y, w)
    assert_close(from_x, [[4.0], [4.0], [9.0]])


@exercise("2.11", fine_print=True)
def test_at_equal_w_the_left_end_decides(impl):
    """Each of the two faces at an edge takes its own end, or the right one."""
    x, y, w = np.array([[1.0, 7.0, 3.0], [1.0, 2.0, 6.0], [1.0, 1.0, -1.0]])[..., None]
    _, _, from_x, from_y = impl.half_planes(x, y, w)
    assert_close(np.hstack([from_x, from_y]), [[3.0, 6.0], [1.0, 1.0], [1.0, 1.0]])


@exercise("2.11", fine_print=True)
def test_at_equal_w_and_x_the_lower_end_decides(impl):
    """Each of the two faces at a vertical edge takes its own end: y does not decide, or the greater
    y does.
    """
    x, y, w = np.array([[3.0, 3.0, 5.0], [8.0, 1.0, 4.0], [1.0, -1.0, 1.0]])[..., None]
    for order in ([0, 1, 2], [1, 0, 2]):
        _, _, _, from_y = impl.half_planes(x[order], y[order], w[order])
        assert_close(from_y[2], [1.0])


@exercise("2.11", fine_print=True)
def test_which_edges_have_n_0(impl):
    """The sign of 0 was taken for 1, or a tolerance for 0."""
    flat, tiny, large = ([0, 4, 2], [0, 4, 2]), ([0, 1e-9, 0], [0, 0, 1e-9]), (
        [-9e13, 0, 9e13], [-9e13, 9e13, 0])
    x, y = np.array([flat, tiny, large], float).transpose(1, 2, 0)
    n_x, n_y, _, _ = impl.half_planes(x, y, np.ones((3, 3)))
    assert_equal((n_x == 0) & (n_y == 0), np.tile([True, False, False], (3, 1)))


@exercise("2.12")
def test_two_tilted_planes_on_paper(impl):
    """The slopes by x and y are swapped, one or both have the wrong sign (the normal's), or are
    taken along one edge alone. They are not divided by the determinant, or by A for 2A: twice as
    large.
    """
    x, y, z = np.array([[[1.0, 0.0], [7.0, 8.0], [3.0, 4.0]],
                        [[1.0, 0.0], [2.0, 4.0], [6.0, 8.0]],
                        [[0.4, 1.0], [0.8, 6.0], [-0.4, 5.0]]])
    slopes = impl.depth_slopes(x, y, z)
    assert_close(np.array(slopes), [[0.1, 0.5], [-0.2, 0.25]])


@exercise("2.12")
def test_a_clockwise_face_has_the_same_slopes(impl):
    """The determinant's sign is lost (its absolute value divides): clockwise faces slope the wrong
    way.
    """
    x, y, z = np.array([[[3.0, 4.0], [7.0, 8.0], [1.0, 0.0]],
                        [[6.0, 8.0], [2.0, 4.0], [1.0, 0.0]],
                        [[-0.4, 5.0], [0.8, 6.0], [0.4, 1.0]]])
    slopes = impl.depth_slopes(x, y, z)
    assert_close(np.array(slopes), [[0.1, 0.5], [-0.2, 0.25]])


@exercise("2.12")
def test_the_depth_plane_goes_through_its_corners(impl, rng):
    """Right for large faces, or for one face alone: a tolerance is added to the determinant."""
    for size in 1.0, 1e-9:
        x, y, z = rng.normal(size=(3, 3, 50)) * np.reshape([size, size, 1], (3, 1, 1))
        dz_dx, dz_dy = impl.depth_slopes(x, y, z)
        assert_close(z[0] + dz_dx * (x - x[0]) + dz_dy * (y - y[0]), z, rtol=1e-6, atol=1e-8)


@exercise("2.12", fine_print=True)
def test_a_face_without_area_stops_nothing(impl):
    """A solver that raises for one face of many."""
    x, y, z = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 2.0], [0.5, 0.9, 0.1]])[..., None] * [1.0, 0.0]
    dz_dx, dz_dy = impl.depth_slopes(x, y, z)
    assert_close(np.stack([dz_dx, dz_dy])[:, 0], [0.1, -0.2])


@exercise("2.12", fine_print=True)
def test_a_face_parallel_to_the_screen_is_exactly_flat(impl, rng):
    """Rounding tilts it: a face in the near plane itself gets holes."""
    x, y = rng.normal(size=(2, 3, 50))
    assert_equal(np.stack(impl.depth_slopes(x, y, np.full((3, 50), -1.0))), np.zeros((2, 50)))


# --- whole rows --------------------------------------------------------------------------------

def first_column_loop(a, x0, offset, first, last):
    """By trying first <= j < last. Where none of them will do, it is last."""
    edges = zip(a, x0, offset, strict=True)
    return np.array([next((j for j in range(first, last) if k * (j + 0.5 - s) + m >= 0), last)
                     for k, s, m in edges], float)


@exercise("2.14")
def test_the_first_column_on_paper(impl):
    """The half pixel of the centre is forgotten: the crossing is rounded (ceil, floor), or one
    column is added. > for >=: a centre on the edge is left out. offset or from_x has the wrong sign
    or is missing, or the slope does not divide.
    """
    slope  = np.array([ 2.0,  4.0,  0.5,   8.0,  1.0,  2.0])
    from_x = np.array([ 0.0,  1.0, -2.0,   3.5,  5.0,  3.0])
    offset = np.array([-3.0, -2.2, -1.725, 2.0, -0.5, -2.0])  # x = 1.5, 1.55, 1.45, 3.25, 5.5, 4
    assert_close(impl.first_column(slope, from_x, offset), [1.0, 2.0, 1.0, 3.0, 5.0, 4.0])


@exercise("2.14")
def test_the_first_column_may_lie_outside_the_picture(impl):
    """The column is cut (clipped), at 0 or at a width: there is no column below 0. Or it is rounded
    towards 0, not down.
    """
    slope  = np.array([ 2.0,   4.0,   0.5, 1.0,  2.0])
    from_x = np.array([ 0.0,   1.0,  -2.0, 5.0, -1.0])
    offset = np.array([-99.0, -26.4, -4.7, 7.5, 99.4])  # x = 49.5, 7.6, 7.4, -2.5, -50.7
    assert_close(impl.first_column(slope, from_x, offset), [49.0, 8.0, 7.0, -3.0, -51.0])


@exercise("2.14")
def test_the_first_column_is_that_of_a_search(impl, rng):
    """Right for whole numbers alone."""
    slope, (x0, offset) = rng.uniform(0.1, 9, 200), rng.uniform(-20, 20, (2, 200))
    column = impl.first_column(slope, x0, offset)
    assert_close(column, first_column_loop(slope, x0, offset, -250, 250))


@exercise("2.14", fine_print=True)
def test_the_sum_decides_and_not_the_quotient(impl, rng):
    """The quotient -offset / slope alone decides: one column off where the edge passes through a
    centre, because it is rounded differently. The sum has the last word.
    """
    a, x0 = 10.0 ** rng.uniform(-30, 6, 3000), rng.uniform(-5, 5, 3000)
    offset = -a * (rng.integers(-3, 20, 3000) + 0.5 - x0)
    offset *= 1 + rng.choice([0, 1, -1, 2, -2], 3000) * 2.0 ** -52
    assert_close(impl.first_column(a, x0, offset), first_column_loop(a, x0, offset, -8, 24))


@exercise("2.14", fine_print=True)
def test_any_slope_and_any_offset(impl, rng):
    """Steep or nearly horizontal edges overflow, as where columns become integers."""
    a, x0 = 10.0 ** rng.uniform(-30, 30, 2000), rng.normal(size=2000) * 100
    offset = rng.normal(size=2000) * 10.0 ** rng.uniform(-9, 9, 2000)
    column = np.clip(impl.first_column(a, x0, offset), -20, 20)  # some lie 1e39 columns away
    assert_close(column, first_column_loop(a, x0, offset, -20, 20))


@exercise("2.14", fine_print=True)
def test_a_column_may_be_infinite(impl):
    """nan, or any number, where -offset / slope is too large for a float."""
    offset = np.array([-1e10, 1e10, -3.0, 3.0])
    with np.errstate(over="ignore"):
        column = impl.first_column(np.full(4, 1e-300), np.array([0.0, 0.0, 5.0, -5.0]), offset)
    assert_equal(column < -1e299, [False, True, False, True])
    assert_equal(column > 1e299, [True, False, True, False])


def covered_loop(planes, y, left, right):
    """The columns left <= j < right of a row that lie on the right side of all planes (4, P)."""
    def covers(a, b, x0, y0, x):
        e = a * (x - x0) + b * (y - y0)
        return e > 0 or (e == 0 and (a > 0 or (a == 0 and b > 0)))

    return [j for j in range(left, right) if all(covers(*plane, j + 0.5) for plane in planes.T)]


# Face 0 is 1 + 0.4 (y - 1) <= x <= 9.25 - y, x <= 6 y - 5. Face 1 is face 0 mirrored at x = 4.
MIRRORED = (np.array([[-4.0, 4.0], [5.0, -5.0], [-1.0, 1.0]]),    # n_x
            np.array([[-4.0, -4.0], [-2.0, -2.0], [6.0, 6.0]]),   # n_y
            np.array([[3.25, 4.75], [1.0, 7.0], [1.0, 7.0]]),     # from_x
            np.array([[6.0, 6.0], [1.0, 1.0], [1.0, 1.0]]))       # from_y
# On these rows face 0 is from 1.2 to 4, 1.6 to 6.75, 2.4 to 4.75. Face 1 is from 4 to 6.8, 1.25 to
# 6.4, 3.25 to 5.6.
FACE, Y = np.array([0, 1, 0, 1, 0, 1]), np.array([1.5, 1.5, 2.5, 2.5, 4.5, 4.5])


@exercise("2.15")
def test_the_intervals_of_two_triangles_on_paper(impl):
    """start and end are swapped. They make the union: leftmost opening, rightmost closing edge (min
    for max). The last edge alone decides. Closing edges need -e: both slope and offset (n_y) change
    their sign. end is the last column, not one past it.
    """
    start_end = impl.row_interval(MIRRORED, FACE, Y, np.array([0.0, 1.0]), np.array([8.0, 9.0]))
    assert_close(np.array(start_end), [[1.0, 4.0, 2.0, 1.0, 2.0, 3.0],
                                       [4.0, 7.0, 7.0, 6.0, 5.0, 6.0]])


@exercise("2.15")
def test_a_face_s_box_cuts_its_rows(impl):
    """left or right (the box) is left out, or is that of another face, or cuts the wrong end. right
    is in the interval, or right - 1 is not.
    """
    start_end = impl.row_interval(MIRRORED, FACE, Y, np.array([2.0, 3.0]), np.array([5.0, 6.0]))
    assert_close(np.array(start_end), [[2.0, 4.0, 2.0, 3.0, 2.0, 3.0],
                                       [4.0, 6.0, 5.0, 6.0, 5.0, 6.0]])


@exercise("2.15")
def test_a_row_of_pixels_is_half_open(impl):
    """Closed intervals: the sample at x = 3.5 lies on a right edge and belongs to the neighbour."""
    planes = np.array([[1.0, -1.0, 1.0], [0.0, 0.0, 0.0], [1.5, 3.5, 0.5], [0.0] * 3])[..., None]
    start, end = impl.row_interval(tuple(planes), np.zeros(1, int), np.array([0.5]),
                                   np.array([0.0]), np.array([8.0]))
    assert_close(np.stack([start, end]), [[1.0], [3.0]])


@pytest.mark.parametrize("n_x", [
    pytest.param([-3, -2, -1, 1, 2, 3], marks=exercise("2.15"), id="slanted"),
    pytest.param([-3, -2, -1, 0, 1, 2, 3], marks=exercise("2.15", fine_print=True), id="any")])
def test_intervals_hold_what_the_planes_say(impl, rng, n_x):
    """Planes or a box of another face or another row are used, or a horizontal edge on its own row.
    """
    planes = rng.integers(-3, 4, (4, 3, 60)).astype(float)
    planes[0] = rng.choice(n_x, (3, 60))
    planes[2:] += 0.5  # so that many samples lie exactly on an edge
    face, y = rng.integers(0, 60, 400), rng.integers(-2, 3, 400) + 0.5
    left, right = rng.integers(0, 4, 60), rng.integers(4, 10, 60)
    start, end = impl.row_interval(tuple(planes), face, y, left, right)
    for n, f in enumerate(face):
        got = [j for j in range(-5, 15) if start[n] <= j < end[n]]
        expected = covered_loop(planes[..., f], y[n], left[f], right[f])
        assert_equal(np.array(got, int), np.array(expected, int),
                     given=f"a, b, x0, y0 {planes[..., f].tolist()}, y {y[n]}, "
                           f"left {left[f]}, right {right[f]}")


@exercise("2.15", fine_print=True)
def test_horizontal_edges_take_all_or_nothing(impl):
    """Horizontal edges (n_x = 0) are skipped, so rows above or below the face are covered. A slope
    of 0 becomes NaN (0 / 0), TINY gets a sign, or e = 0 is decided by TINY times the column. n_x >
    0, not is_top_left, tells what opens.
    """
    # y = 1.5 is the lower edge of face 0 and the upper edge of face 1; the others are far away.
    n_y = np.array([[1.0, -1.0], [0.0, 0.0], [0.0, 0.0]])
    n_x = np.array([[0.0, 0.0], [1.0, 1.0], [-1.0, -1.0]])
    from_x, from_y = np.array([[3.0, 3.0], [-9.0, -9.0], [99.0, 99.0]]), np.full((3, 2), 1.5)
    face, y = np.array([0, 0, 0, 1, 1, 1]), np.array([0.5, 1.5, 2.5, 0.5, 1.5, 2.5])
    start, end = impl.row_interval((n_x, n_y, from_x, from_y), face, y, np.array([0.0, 2.0]),
                                   np.array([8.0, 7.0]))
    assert_close(np.maximum(end - start, 0), [0.0, 8.0, 8.0, 5.0, 0.0, 0.0])
