"""What the exercises of lab 2 must do."""
from fractions import Fraction

import numpy as np
import pytest

from course.checks import assert_close, assert_equal, assert_picture, exercise
from course.given.gradcheck import gradcheck

TRIANGLE = np.array([[1.0, 1.0], [7.0, 2.0], [3.0, 6.0]])  # counter-clockwise


def centres(width, height):
    """The sample points (height, width, 2) of a picture."""
    return np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), -1)


def exact_edge(p, a, b):
    """Eq. (1) without rounding."""
    (x, y), (x0, y0), (x1, y1) = ([Fraction(float(c)) for c in point] for point in (p, a, b))
    return (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)


def exact_inside(p, triangle):
    """The samples in a triangle of either winding, border included, without rounding."""
    e = [[exact_edge(q, triangle[i], triangle[j]) for i, j in ((0, 1), (1, 2), (2, 0))]
         for q in p.reshape(-1, 2)]
    inside = [min(row) >= 0 or max(row) <= 0 for row in e]
    return np.array(inside).reshape(p.shape[:-1])


def clip_triangles(rng, count, behind=True):
    """Random faces (count, 3) in clip space (3 count, 4), some with vertices behind the camera."""
    clip = rng.uniform([-2, -2, -1, -0.5 if behind else 0.5], [2, 2, 1, 2], (3 * count, 4))
    return clip, np.arange(3 * count).reshape(-1, 3)


# --- screen space ------------------------------------------------------------------------------

@exercise("2.1")
def test_an_edge_is_positive_on_its_left(impl):
    """a and b are swapped, x and y are swapped, or the screen's y points down."""
    a, b = np.array([1.0, 1.0]), np.array([4.0, 2.0])
    assert_close(impl.edge_function(np.array([2.0, 3.0]), a, b), 5.0)
    assert_close(impl.edge_function(np.array([2.0, -1.0]), a, b), -7.0)
    assert_close(impl.edge_function(np.array([7.0, 3.0]), a, b), 0.0)


@exercise("2.1")
def test_it_is_the_determinant_of_the_three_points(impl, rng):
    """A coefficient is wrong, or the value is halved to the area."""
    for p, a, b in rng.normal(size=(20, 3, 2)):
        expected = np.linalg.det([[*p, 1], [*a, 1], [*b, 1]])
        assert_close(impl.edge_function(p, a, b), expected, atol=1e-12)


@exercise("2.1")
def test_a_grid_of_points_and_one_edge(impl):
    """The code works for one point alone, or does not broadcast."""
    a, b = np.array([0.0, 0.0]), np.array([2.0, 1.0])
    p = centres(4, 3)
    assert_close(impl.edge_function(p, a, b), 2 * p[..., 1] - p[..., 0])


@exercise("2.1", fine_print=True)
def test_swapping_the_ends_negates_every_bit(impl, rng):
    """n . (p - a), whichever end a is: two faces round their common edge differently."""
    p, a, b = rng.normal(size=(3, 2000, 2)) * 10.0 ** rng.integers(-3, 6, (3, 2000, 1))
    assert_equal(impl.edge_function(p, b, a), -impl.edge_function(p, a, b))


@exercise("2.1", fine_print=True)
def test_an_edge_is_exactly_zero_at_both_ends(impl, rng):
    """A x + B y + C with a rounded C: a vertex on a pixel's centre falls between its faces."""
    a, b = rng.normal(size=(2, 2000, 2)) * 10.0 ** rng.integers(-3, 6, (2, 2000, 1))
    assert_equal(impl.edge_function(a, a, b), np.zeros(2000))
    assert_equal(impl.edge_function(b, a, b), np.zeros(2000))


@exercise("2.2")
def test_the_gradients_of_one_edge_on_paper(impl):
    """A sign, x for y, or the gradients in another order than p, a, b."""
    p, a, b = np.array([1.0, 4.0]), np.array([0.0, 0.0]), np.array([2.0, 1.0])
    grad_p, grad_a, grad_b = impl.edge_function_backward(np.array(10.0), p, a, b)
    assert_close(grad_p, np.array([-10.0, 20.0]))
    assert_close(grad_a, np.array([-30.0, -10.0]))
    assert_close(grad_b, np.array([40.0, -10.0]))


@exercise("2.2")
def test_the_gradients_of_edges_are_central_differences(impl, rng):
    """grad_e is ignored or summed up before it reaches the points."""
    def forward(p, a, b):
        return (a[..., 1] - b[..., 1]) * (p[..., 0] - a[..., 0]) \
            + (b[..., 0] - a[..., 0]) * (p[..., 1] - a[..., 1])

    gradcheck(forward, impl.edge_function_backward, tuple(rng.normal(size=(3, 2, 5, 2))),
              name="edge_function")


@exercise("2.4")
def test_inside_border_and_outside(impl):
    """Only two of the three edges are asked, the border does not count, or an edge's line does."""
    p = np.array([[3.0, 3.0], [1.0, 1.0], [4.0, 1.5], [6.0, 5.0], [0.0, 3.0], [4.0, 1.0],
                  [5.0, 11.0], [13.0, 3.0], [11.0, -2.0],  # on the edges' lines
                  [4.0, 1.5 - 1e-6]])
    inside = np.array([True, True, True, False, False, False, False, False, False, False])
    assert_equal(impl.is_inside(p, TRIANGLE), inside)


@exercise("2.4")
def test_inside_does_not_depend_on_the_winding(impl):
    """Clockwise triangles have no inside, because only positive values count."""
    p = centres(8, 8)
    assert_picture(impl.is_inside(p, TRIANGLE), exact_inside(p, TRIANGLE))
    assert_picture(impl.is_inside(p, TRIANGLE[::-1]), exact_inside(p, TRIANGLE))


@exercise("2.5")
def test_left_and_lower_edges_own_their_samples(impl):
    """Right for left, upper for lower (y is up here), or a horizontal edge is decided by n_x."""
    n_x = np.array([1.0, -1.0, 0.0,  0.0, 1.0,  1.0, -1.0, -1.0, 0.0, -1e-9])
    n_y = np.array([0.0,  0.0, 1.0, -1.0, 9.0, -9.0,  9.0, -9.0, 0.0,  1.0])
    owns = np.array([True, False, True, False, True, True, False, False, False, False])
    assert_equal(impl.is_top_left(n_x, n_y), owns)


@exercise("2.5")
def test_of_two_faces_at_an_edge_exactly_one_owns_it(impl, rng):
    """>= for >: both own a vertical edge, or neither owns a horizontal one."""
    n_x, n_y = rng.integers(-2, 3, (2, 200)).astype(float)
    edge = (n_x != 0) | (n_y != 0)
    one, other = impl.is_top_left(n_x, n_y), impl.is_top_left(-n_x, -n_y)
    assert_equal((one ^ other)[edge], np.ones(edge.sum(), bool))


@exercise("2.6")
def test_a_square_on_the_sample_points_keeps_its_left_and_lower_side(impl):
    """Samples on an edge count on every side, on none, or on its right: n_x and n_y are swapped."""
    for moved in np.zeros(2), np.array([0.0, 9.0]), np.array([9.0, 0.0]):
        p = centres(5, 4) + moved
        lower = impl.is_covered(p, np.array([[0.5, 0.5], [3.5, 0.5], [3.5, 3.5]]) + moved)
        assert_picture(lower, np.array([[1, 1, 1, 0, 0],
                                        [0, 1, 1, 0, 0],
                                        [0, 0, 1, 0, 0],
                                        [0, 0, 0, 0, 0]], bool))
        upper = impl.is_covered(p, np.array([[0.5, 0.5], [3.5, 3.5], [0.5, 3.5]]) + moved)
        assert_picture(upper, np.array([[0, 0, 0, 0, 0],
                                        [1, 0, 0, 0, 0],
                                        [1, 1, 0, 0, 0],
                                        [0, 0, 0, 0, 0]], bool))


@exercise("2.6")
def test_pixels_are_sampled_where_the_points_say(impl, rng):
    """The points are cut to whole numbers, as homework 2 of GAMES101 does with (int x, int y)."""
    p = rng.uniform(0, 8, (300, 2))
    assert_equal(impl.is_covered(p, TRIANGLE), exact_inside(p, TRIANGLE))
    small = 2.0**-20  # exact, so that only an absolute tolerance can tell the difference
    assert_equal(impl.is_covered(small * p, small * TRIANGLE), exact_inside(p, TRIANGLE))


@exercise("2.6")
def test_clockwise_and_flat_triangles_cover_nothing(impl):
    """The sign of the area is not asked, or a flat triangle owns the samples on it."""
    p = centres(9, 9)
    nothing = np.zeros((9, 9), bool)
    assert_picture(impl.is_covered(p, TRIANGLE[::-1]), nothing)
    assert_picture(impl.is_covered(p, np.array([[0.5, 0.5], [6.5, 6.5], [2.5, 2.5]])), nothing)
    assert_picture(impl.is_covered(p, np.array([[0.5, 2.5], [6.5, 2.5], [2.5, 2.5]])), nothing)


@exercise("2.6", fine_print=True)
def test_a_shared_edge_is_covered_once(impl, rng):
    """Two faces compute the same edge with different rounding: samples are lost or drawn twice."""
    for _ in range(60):
        a, b = rng.uniform(0, 100, (2, 2))
        across = np.array([a[1] - b[1], b[0] - a[0]])
        left, right = a + across, b - across
        on_edge = a + (b - a) * rng.uniform(0.1, 0.9, (100, 1))
        count = impl.is_covered(on_edge, np.stack([a, b, left])).astype(int) \
            + impl.is_covered(on_edge, np.stack([b, a, right]))
        assert_equal(count, np.ones(100, int))


@exercise("2.6", fine_print=True)
def test_a_fan_covers_its_hub_once(impl, rng):
    """The hub of a fan is covered by no face or by several."""
    hub = np.array([4.5, 4.5])
    for _ in range(40):
        angles = rng.uniform(0, np.pi / 3, 3) + np.arange(3) * 2 * np.pi / 3
        rim = hub + 4 * np.stack([np.cos(angles), np.sin(angles)], -1)
        faces = [np.stack([hub, rim[k], rim[(k + 1) % 3]]) for k in range(3)]
        assert_equal(sum(int(impl.is_covered(hub[None], face)[0]) for face in faces), 1)


@exercise("2.7")
def test_weights_on_paper(impl):
    """e_0 and e_1 are the first two edges of the list, not those opposite to vertices 0 and 1."""
    triangle = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    p = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 2.0], [2.0, 0.0]])
    expected = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0],
                         [0.25, 0.25, 0.5], [0.5, 0.5, 0.0]])
    assert_close(impl.barycentric_coordinates(p, triangle), expected)


@exercise("2.7")
def test_weights_bring_back_the_point_inside_and_outside(impl, rng):
    """The weights are divided by the wrong area, or made positive."""
    for size in 1.0, 1e-6:
        triangle, p = size * rng.normal(size=(3, 2)), size * rng.normal(size=(4, 6, 2))
        b = impl.barycentric_coordinates(p, triangle)
        assert_close(b @ triangle / size, p / size, rtol=1e-7, atol=1e-9)
        assert_close(b.sum(-1), np.ones((4, 6)), rtol=1e-7)


@exercise("2.8")
def test_the_box_of_a_triangle_on_paper(impl):
    """The end is not one past the last pixel, or x and y are swapped."""
    triangle = np.array([[1.5, 2.5], [4.2, 3.0], [2.0, 6.9]])
    assert_equal(impl.bounding_box(triangle, 8, 9), (1, 2, 4, 7))
    triangle = np.array([[0.5, -9.0], [3.0, 1.2], [2.5, 1.0]])
    assert_equal(impl.bounding_box(triangle, 8, 8), (0, 0, 3, 1))
    assert_equal(impl.bounding_box(triangle + [0.0, 12.0], 8, 9), (0, 3, 3, 9))


@exercise("2.8")
def test_the_box_is_a_sixteenth_of_a_pixel_wider(impl):
    """The margin is missing, on one side only, or taken away; or a centre on the border is out."""
    low, high = 1.5 + 1 / 16, 4.5 - 1 / 16  # the box ends at the centres 1.5 and 4.5
    for shift, first, end in ((0.0, 1, 5), (1e-9, 2, 5), (-1e-9, 1, 4)):
        triangle = np.array([[low, high], [high, low], [3.0, 3.0]]) + shift
        assert_equal(impl.bounding_box(triangle, 9, 9), (first, first, end, end))


@exercise("2.8")
def test_the_box_stays_in_the_picture(impl):
    """The box is not clipped, is clipped after it became integers, or -0.5 is cut to 0."""
    x0, y0, x1, y1 = impl.bounding_box(np.array([[-3.0, 2.0], [99.0, 3.0], [5.0, 77.0]]), 10, 20)
    assert_equal((x0, y0, x1, y1), (0, 2, 10, 20))
    triangle = np.array([[-1e300, 2.0], [1e300, 3.0], [5.0, 1e300]])
    assert_equal(impl.bounding_box(triangle, 10, 20), (0, 2, 10, 20))
    for outside in ([-3.0, -0.5, -1.5], [-3.0, -2.5, -1.5], [12.0, 10.0, 11.0], [14.0, 12.5, 13.0]):
        x0, y0, x1, y1 = impl.bounding_box(np.stack([outside, [2.0, 3.0, 5.0]], -1), 10, 20)
        assert_equal((x1 <= x0 <= 10, 0 <= x1, y0, y1), (True, True, 2, 5))
        x0, y0, x1, y1 = impl.bounding_box(np.stack([[2.0, 3.0, 5.0], outside], -1), 20, 10)
        assert_equal((y1 <= y0 <= 10, 0 <= y1, x0, x1), (True, True, 2, 5))


@exercise("2.8")
def test_no_covered_sample_lies_outside_the_box(impl, rng):
    """The box is cut to whole numbers before the comparison: the last column or row is missing."""
    p = centres(12, 10)
    for triangle in rng.uniform(-4, 16, (12, 3, 2)):
        x0, y0, x1, y1 = impl.bounding_box(triangle, 12, 10)
        boxed = np.zeros((10, 12), bool)
        boxed[y0:y1, x0:x1] = True
        assert_picture(boxed & exact_inside(p, triangle), exact_inside(p, triangle))


# --- with perspective --------------------------------------------------------------------------

@exercise("2.10")
def test_clockwise_faces_are_culled(impl):
    """Clockwise faces are kept instead of counter-clockwise ones, or the order changes."""
    x, y, w = np.array([[0.0, 4.0, 1.0], [0.0, 0.0, 3.0], [1.0, 2.0, 3.0]])
    faces = np.array([[0, 1, 2], [0, 2, 1], [2, 0, 1], [1, 0, 2]])
    assert_equal(impl.cull_back_faces(x, y, w, faces), faces[[0, 2]])


@exercise("2.10")
def test_vertices_behind_the_camera_turn_the_face_over(impl, rng):
    """The winding on screen alone, or right for one vertex behind the camera but not for three."""
    clip, faces = clip_triangles(rng, 80)
    face, corner = np.divmod(np.arange(240), 3)
    behind = (face >> corner) & 1  # all eight cases in turn
    clip[:, 3] = rng.uniform(0.5, 2, 240) * (1 - 2 * behind)
    clip *= 10.0 ** rng.integers(-3, 3, (240, 1))  # which moves nothing on screen
    # (x, y, w) are the corners as the camera sees them: its distance to the face has this sign.
    facing = np.linalg.det(clip[faces][..., [0, 1, 3]]) > 0
    x, y, _, w = clip.T
    for size in 1.0, 1e-9:
        kept = impl.cull_back_faces(size * x / w, size * y / w, w, faces)
        assert_equal(kept, faces[facing], given=f"corners scaled by {size}")


@exercise("2.10")
def test_faces_without_area_are_culled(impl):
    """>= for >."""
    x, y, w = np.array([[0.0, 2.0, 4.0], [0.0, 2.0, 4.0], [1.0, 1.0, 1.0]])
    faces = np.array([[0, 1, 2], [0, 0, 1]])
    assert_equal(impl.cull_back_faces(x, y, w, faces), faces[:0])


# --- pictures ----------------------------------------------------------------------------------

@exercise("2.13")
def test_one_triangle_on_paper(impl):
    """Rows are upside down, columns and rows are swapped, or pixels are tested at their corners."""
    clip = np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [-1.0, 1.0, 0.0, 1.0]])
    face_index, depth = impl.rasterize_loop(clip, np.array([[0, 1, 2]]), 7, 2)
    # The hypotenuse is x / 7 + y / 2 = 1: x < 5.25 in row 0 (y = 0.5), x < 1.75 in row 1.
    seen = np.arange(7) < np.array([[5], [2]])
    assert_picture(face_index, np.where(seen, 0, -1))
    assert_close(depth, np.where(seen, 0.0, np.inf))


@exercise("2.13")
def test_the_nearer_face_is_seen_whatever_the_order(impl):
    """No z-buffer (the last face wins), or the greater depth counts as nearer."""
    triangle = np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [1.0, 1.0, 0.0, 1.0]])
    clip = np.concatenate([triangle + [0, 0, z, 0] for z in (0.5, 1e-9 - 0.5, -0.5, 0.0)])
    faces = np.arange(12).reshape(4, 3)
    for order in ([0, 1, 2, 3], [2, 0, 1, 3], [3, 1, 0, 2]):
        face_index, depth = impl.rasterize_loop(clip, faces[order], 4, 4)
        seen = face_index >= 0
        assert_picture(face_index, np.where(seen, order.index(2), -1))
        assert_close(depth[seen], np.full(seen.sum(), -0.5))


@exercise("2.13", fine_print=True)
def test_of_equally_deep_faces_the_first_is_seen(impl):
    """<= for < in the depth test."""
    triangle = np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [1.0, 1.0, 0.0, 1.0]])
    clip, faces = np.concatenate([triangle] * 3), np.arange(9).reshape(3, 3)
    face_index, _ = impl.rasterize_loop(clip, faces, 4, 4)
    assert_picture(face_index, np.where(face_index >= 0, 0, -1))


@exercise("2.13")
def test_a_face_is_seen_from_behind_too(impl):
    """Clockwise faces cover nothing."""
    clip = np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.2, 1.0], [-1.0, 1.0, 0.4, 1.0]])
    front = impl.rasterize_loop(clip, np.array([[0, 1, 2]]), 5, 4)
    back = impl.rasterize_loop(clip, np.array([[0, 2, 1]]), 5, 4)
    seen = np.add.outer(np.arange(4) / 4, np.arange(5) / 5) < 0.78
    assert_picture(back[0], np.where(seen, 0, -1))
    assert_picture(front[0], back[0])
    assert_close(back[1], front[1])


@exercise("2.13")
def test_a_face_smaller_than_a_pixel_is_seen_where_it_lies(impl):
    """Rows and columns of the box are swapped, or a small area counts as none."""
    x, y = np.array([5.2, 5.9, 5.3]) / 3 - 1, np.array([0.2, 0.4, 0.9]) / 2 - 1
    clip = np.stack([x, y, np.zeros(3), np.ones(3)], -1)
    for faces in ([[0, 1, 2]], [[0, 2, 1]]):
        face_index, _ = impl.rasterize_loop(clip, np.array(faces), 6, 4)
        assert_picture(face_index, np.array([[-1, -1, -1, -1, -1, 0], *[[-1] * 6] * 3]))


@exercise("2.13", fine_print=True)
@pytest.mark.parametrize("z", [-1.0, 1.0])
def test_the_near_and_the_far_plane_are_part_of_the_picture(impl, z):
    """< for <= where the depth is compared with the planes."""
    clip = np.array([[-1.0, -1.0, z, 1.0], [3.0, -1.0, z, 1.0], [-1.0, 3.0, z, 1.0]])
    face_index, depth = impl.rasterize_loop(clip, np.array([[0, 1, 2]]), 4, 4)
    assert_picture(face_index, np.zeros((4, 4), int))
    assert_close(depth, np.full((4, 4), z))


@exercise("2.13")
def test_depth_is_linear_on_the_screen(impl):
    """z is interpolated and then divided by w: both must be done, or z/w be taken as linear."""
    clip = np.array([[-1.0, -1.0, -1.0, 1.0], [3.0, -3.0, 2.4, 3.0], [-1.0, 3.0, -1.0, 1.0]])
    _, depth = impl.rasterize_loop(clip, np.array([[0, 1, 2]]), 8, 8)
    x = np.arange(8) + 0.5
    assert_close(depth[0, :7], -1 + 1.8 * x[:7] / 8)  # from z/w = -1 at x = 0 to 0.8 at x = 8


@exercise("2.13")
def test_each_sample_of_a_square_on_pixel_centres_has_one_face(impl):
    """Samples on an edge are left out, or go to the face on the other side."""
    x, y = np.array([0.5, 3.5, 3.5, 0.5]), np.array([0.5, 0.5, 3.5, 3.5])
    clip = np.stack([x / 2 - 1, y / 2 - 1, np.zeros(4), np.ones(4)], -1)
    face_index, _ = impl.rasterize_loop(clip, np.array([[0, 1, 2], [0, 2, 3]]), 4, 4)
    assert_picture(face_index, np.array([[ 0,  0,  0, -1],
                                         [ 1,  0,  0, -1],
                                         [ 1,  1,  0, -1],
                                         [-1, -1, -1, -1]]))


@exercise("2.13")
def test_depth_is_that_of_the_plane_through_the_corners(impl, rng):
    """z is mixed by weights of the screen and divided by w a second time, or not at all."""
    clip = np.append(rng.uniform(-1, 1, (3, 3)), rng.uniform(0.8, 1.2, (3, 1)), 1)
    clip[:, :2] *= 3
    clip[:, 2] /= 3
    _, depth = impl.rasterize_loop(clip, np.array([[0, 1, 2]]), 6, 6)
    x, y = (clip[:, 0] / clip[:, 3] + 1) * 3, (clip[:, 1] / clip[:, 3] + 1) * 3
    z = clip[:, 2] / clip[:, 3]
    plane = np.linalg.solve(np.stack([x, y, np.ones(3)], -1), z)
    expected = np.append(centres(6, 6), np.ones((6, 6, 1)), -1) @ plane
    seen = np.isfinite(depth)
    assert_close(depth[seen], expected[seen], rtol=1e-9, atol=1e-9)


@exercise("2.13")
def test_a_face_reaches_the_ends_of_a_wide_and_of_a_high_picture(impl):
    """Width and height are swapped on the way to the bounding box, or pixels beyond are drawn."""
    clip = np.array([[-3.0, -3.0, 0.0, 1.0], [9.0, -3.0, 0.0, 1.0], [-3.0, 9.0, 0.0, 1.0]])
    for corners, width, height in ((clip, 3, 9), (clip, 9, 3), (clip / 99, 3, 9)):
        corners = corners + [[0, 0, 0.1, 0]] * corners[:, :1]  # the depth is a tenth of ndc x
        face_index, depth = impl.rasterize_loop(corners, np.array([[0, 1, 2]]), width, height)
        assert_picture(face_index, np.zeros((height, width), int))
        expected = 0.1 * ((np.arange(width) + 0.5) * 2 / width - 1)
        assert_close(depth, np.tile(expected, (height, 1)), atol=1e-9)


@exercise("2.13")
def test_near_and_far_cut_a_face_in_its_middle(impl):
    """Depths beyond -1 or 1 are drawn where the face crosses a plane."""
    clip = np.array([[-1.0, -1, -2, 1], [1, -1, 2, 1], [1, 1, 2, 1], [-1, 1, -2, 1]])  # z = 2 x
    face_index, _ = impl.rasterize_loop(clip, np.array([[0, 1, 2], [0, 2, 3]]), 8, 2)
    assert_picture(face_index >= 0, np.tile(np.abs(np.arange(8) - 3.5) < 2, (2, 1)))


@exercise("2.13")
def test_clip_space_has_no_unit(impl):
    """A small w is taken for 0: faces far smaller than one are lost, although nothing changed."""
    clip = 1e-13 * np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [-1.0, 1.0, 0.0, 1.0]])
    face_index, _ = impl.rasterize_loop(clip, np.array([[0, 1, 2]]), 4, 3)
    seen = np.array([[1, 1, 1, 0], [1, 1, 0, 0], [1, 0, 0, 0]], bool)
    assert_picture(face_index, np.where(seen, 0, -1))


# --- where on the face -------------------------------------------------------------------------

def ray_weights(x, y, w, px, py):
    """b of the sample (px, py) on the face with corners x, y, w (3,): M c = (px, py, 1), solved."""
    c = np.linalg.solve(np.stack([x, y, np.ones(3)]) * w, [px, py, 1])
    return c / c.sum()


@exercise("2.16")
def test_halfway_on_the_screen_is_not_halfway_on_the_face(impl):
    """The weights are linear on the screen: perspective is forgotten."""
    # An edge from w = 1 at x = 0 to w = 3 at x = 8: its middle on screen has weights 3/4 and 1/4.
    x, y, w = np.array([[0.0, 8.0, 0.0], [0.0, 0.0, 8.0], [1.0, 3.0, 1.0]])[..., None]
    b = impl.barycentric_on_face(np.array([4.0]), np.array([0.0]), x, y, w)
    assert_close(b, np.array([[0.75], [0.25], [0.0]]))


@exercise("2.16")
def test_weights_are_those_of_the_ray_through_the_pixel(impl, rng):
    """Multiplied by w instead of divided, or the sum is taken over samples instead of vertices."""
    size = 10.0 ** rng.integers(-5, 2, 40)
    x, y = size * rng.uniform(0, 8, (2, 3, 40))
    w = rng.uniform(0.5, 2, (3, 40)) * rng.choice([1, 1, -1], (3, 40))
    px, py = size * rng.uniform(0, 8, (2, 40))
    expected = [ray_weights(x[:, n], y[:, n], w[:, n], px[n], py[n]) for n in range(40)]
    b = impl.barycentric_on_face(px, py, x, y, w)
    assert_close(b, np.transpose(expected), rtol=1e-6, atol=1e-9)


@exercise("2.17")
def test_weights_change_by_the_quotient_rule_on_paper(impl):
    """The second term, - b ds, is missing, or the whole is not divided by s."""
    b, s = np.array([[0.25], [0.25], [0.5]]), np.array([4.0])
    db = impl.normalize_derivative(np.array([[4.0], [0.0], [12.0]]), b, s)
    assert_close(db, np.array([[0.0], [-1.0], [1.0]]))


@exercise("2.17")
@pytest.mark.parametrize("axis", [0, -1])
def test_the_change_is_that_of_b(impl, rng, axis):
    """The sum is taken over the samples, not over the three weights."""
    c, dc = rng.uniform(0.5, 2, (2, 3, 7)) if axis == 0 else rng.uniform(0.5, 2, (2, 5, 2, 3))
    s = c.sum(axis, keepdims=True)
    moved = c + 1e-20j * dc  # a complex step: its difference loses no digits
    expected = (moved / moved.sum(axis, keepdims=True)).imag / 1e-20
    assert_close(impl.normalize_derivative(dc, c / s, s[0] if axis == 0 else s, axis), expected)
