"""What the exercises of lab 2 must do."""
from fractions import Fraction

import numpy as np
from seen_on_rays import seen_on_rays

from labkit.checks import assert_close, assert_equal, assert_picture, exercise

TRIANGLE = np.array([[1.0, 1.0], [7.0, 2.0], [3.0, 6.0]])  # counter-clockwise
# The lower right half of any picture, in clip space.
HALF = np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [1.0, 1.0, 0.0, 1.0]])


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
    """Positive on the right, as with a and b swapped or y down. n_x and n_y are swapped. n is the
    edge itself: a dot product, along it, not across. p is not measured from a. Divided by the
    edge's length (a distance), halved to an area, or made positive.
    """
    points = np.array([[[2.0, 3.0], [1.0, 1.0], [4.0, 2.0]],
                       [[2.0, -1.0], [1.0, 1.0], [4.0, 2.0]],
                       [[7.0, 3.0], [1.0, 1.0], [4.0, 2.0]],    # on the line
                       [[2.0, -1.0], [4.0, 2.0], [1.0, 6.0]],   # an edge of length 5
                       [[2.0, 3.0], [-2.0, 5.0], [3.0, -7.0]],  # and one of length 13
                       [[5.0, 1.0], [0.0, 3.0], [2.0, 3.0]]])
    e = np.array([impl.edge_function(p, a, b) for p, a, b in points])
    assert_close(e, [5.0, -7.0, 0.0, 17.0, 38.0, -4.0])


@exercise("2.1")
def test_it_is_the_determinant_of_the_three_points(impl, rng):
    """A coefficient is wrong, which shows for few points only."""
    for p, a, b in rng.normal(size=(20, 3, 2)):
        expected = np.linalg.det([[*p, 1], [*a, 1], [*b, 1]])
        assert_close(impl.edge_function(p, a, b), expected, atol=1e-12)


@exercise("2.1")
def test_a_grid_of_points_and_two_edges(impl):
    """The code works for one point alone, or does not broadcast: x is p[0] instead of p[..., 0]."""
    a, b = np.array([[1.0, 1.0], [3.0, -2.0]]), np.array([[4.0, 2.0], [1.0, 2.0]])
    p = centres(4, 3)
    x, y = p[..., 0], p[..., 1]
    assert_close(impl.edge_function(p[:, :, None], a, b),
                 np.stack([3 * y - x - 2, 8 - 2 * y - 4 * x], -1))


@exercise("2.1", fine_print=True)
def test_swapping_the_ends_negates_every_bit(impl, rng):
    """n . (p - a) is always measured from a, so rounding differs when the ends are swapped. Measure
    from the same end in both directions, say from the one with the smaller x.
    """
    p, a, b = rng.normal(size=(3, 2000, 2)) * 10.0 ** rng.integers(-3, 6, (3, 2000, 1))
    assert_equal(impl.edge_function(p, b, a), -impl.edge_function(p, a, b))


@exercise("2.1", fine_print=True)
def test_an_edge_is_exactly_zero_at_both_ends(impl, rng):
    """A x + B y + C with a rounded C: a vertex on a pixel's centre falls between its faces."""
    a, b = rng.normal(size=(2, 2000, 2)) * 10.0 ** rng.integers(-3, 6, (2, 2000, 1))
    ends = [impl.edge_function(end, a, b) for end in (a, b)]
    assert_equal(np.array(ends), np.zeros((2, 2000)))


@exercise("2.2")
def test_left_and_lower_edges_own_their_samples(impl):
    """Right for left (n points out), upper for lower (y is up here), n_x and n_y swapped, or n as
    the edge's direction. Horizontal edges are forgotten, all count (n_x >= 0), or slanted ones too.
    `and` for `or`, or `if` on an array.
    """
    n_x = np.array([1.0, -1.0, 0.0,  0.0, 1.0,  1.0, -1.0, -1.0, 0.0, -1e-9, 1e-9, 3.0, -2.0,  0.0,
                    -4.0,  2.0])
    n_y = np.array([0.0,  0.0, 1.0, -1.0, 9.0, -9.0,  9.0, -9.0, 0.0,  1.0,  -1.0, 5.0,  7.0, -2.0,
                    -3.0, -6.0])
    owns = np.array([[1, 0, 1, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1],
                     [0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 0, 1, 1, 1, 0]], bool)
    assert_equal(np.array([impl.is_top_left(sign * n_x, sign * n_y) for sign in (1, -1)]), owns)


@exercise("2.2")
def test_of_two_faces_at_an_edge_exactly_one_owns_it(impl, rng):
    """>= in place of >: both faces own a vertical edge, or neither owns a horizontal one."""
    n_x, n_y = rng.integers(-2, 3, (2, 200)).astype(float)
    edge = (n_x != 0) | (n_y != 0)
    one, other = impl.is_top_left(n_x, n_y), impl.is_top_left(-n_x, -n_y)
    assert_equal((one ^ other)[edge], np.ones(edge.sum(), bool))


POINTS = np.array([[3.0, 2.5], [4.5, 2.75], [3.75, 4.375], [-4.0, 2.5], [7.0, 9.0]])
WEIGHTS = np.array([[0.5, 0.25, 0.25], [0.25, 0.5, 0.25], [0.125, 0.25, 0.625], [1.5, -1.0, 0.5],
                    [-1.0, 0.5, 1.5]])  # the last two are of points outside


@exercise("2.3")
def test_weights_on_paper(impl):
    """The weights are exchanged or moved on: e_k is of the edge opposite to vertex k. They are not
    divided, or divided by A for 2A (so they sum to 2). Or they are made positive.
    """
    # TRIANGLE is (1, 1), (7, 2), (3, 6), with 2A = 28.
    assert_close(impl.screen_weights(POINTS, TRIANGLE), WEIGHTS)


@exercise("2.3")
def test_a_clockwise_triangle_has_the_same_weights(impl):
    """The area's sign is lost (its absolute value divides): a clockwise triangle gets negative
    weights. It is of either winding.
    """
    assert_close(impl.screen_weights(POINTS, TRIANGLE[::-1])[:, ::-1], WEIGHTS)


@exercise("2.3")
def test_weights_bring_back_the_point_inside_and_outside(impl, rng):
    """Right for points (N, 2) alone, or for large triangles: a tolerance is added to the area."""
    for size in 1.0, 1e-6:
        triangle, p = size * rng.normal(size=(3, 2)), size * rng.normal(size=(4, 6, 2))
        b = impl.screen_weights(p, triangle)
        assert_close(b @ triangle / size, p / size, rtol=1e-7, atol=1e-9)
        assert_close(b.sum(-1), np.ones((4, 6)), rtol=1e-7)


# --- one face -----------------------------------------------------------------------------------

def covered(impl, p, triangle):
    """The samples that a face at depth 0 covers."""
    return impl.cover(p, triangle, np.zeros(3))[0]


@exercise("2.4")
def test_samples_inside_are_covered(impl, rng):
    """Only two of the three edges are asked, or one of them is enough. Positive e are taken for
    outside, or only the sign of their product counts. The points are cut to whole numbers, as by a
    C function of (int x, int y), or moved by half a pixel: they are sampled where they are.
    """
    p = np.concatenate([rng.uniform(0, 8, (300, 2)), [[5.0, 11.0], [13.0, 3.0], [11.0, -2.0]]])
    assert_equal(covered(impl, p, TRIANGLE), exact_inside(p, TRIANGLE) & (np.arange(303) < 300))


@exercise("2.4")
def test_depth_is_mixed_by_the_weights_of_the_screen(impl):
    """Weights and corners do not match, or it is one corner's z. The weights are not divided by
    their sum, or divided by the area for twice the area.
    """
    _, depth = impl.cover(POINTS, TRIANGLE, np.array([-0.5, 0.25, 0.75]))
    assert_close(depth, WEIGHTS @ [-0.5, 0.25, 0.75])


@exercise("2.4")
def test_near_and_far_cut_a_face(impl):
    """Depths beyond -1 or 1 are covered: they are not compared, or only one of the two is, or
    those of the corners are.
    """
    triangle, z = np.array([[-1.0, -1.0], [17.0, -1.0], [-1.0, 17.0]]), np.array([-2.25, 2.25, 0])
    seen, _ = impl.cover(centres(8, 2), triangle, z)
    depth = -2.25 + 0.25 * (np.arange(8) + 1.5) + 0.125 * (np.arange(2)[:, None] + 1.5)
    assert_picture(seen, np.abs(depth) <= 1)


@exercise("2.4")
def test_a_face_is_seen_from_behind_too(impl, rng):
    """Clockwise triangles cover nothing, because only positive e count as inside: the face is seen
    from both sides. Or its corners are turned round, but not their z: the depths keep the old
    order.
    """
    p, z = rng.uniform(0, 8, (300, 2)), np.array([0.125, 0.375, 0.875])
    seen, depth = impl.cover(p, TRIANGLE[::-1], z[::-1])
    plane = np.linalg.solve(np.column_stack([TRIANGLE, np.ones(3)]), z)
    inside = exact_inside(p, TRIANGLE)
    assert_equal(seen, inside)
    assert_close(depth[inside], (np.column_stack([p, np.ones(300)]) @ plane)[inside])


@exercise("2.4")
def test_a_square_on_the_sample_points_keeps_its_left_and_lower_side(impl):
    """Samples on an edge always count (e >= 0), never (e > 0), or for right edges: the normal has
    the wrong sign, or x and y swapped. The last, third edge is not tested, or one is enough. A
    top-left edge counts without e == 0, also far below a lower one. p is rounded.
    """
    for moved in np.zeros(2), np.array([0.0, 9.0]), np.array([9.0, 0.0]):
        p = centres(5, 5) + moved
        lower = covered(impl, p, np.array([[0.5, 1.5], [3.5, 1.5], [3.5, 4.5]]) + moved)
        assert_picture(lower, np.array([[0, 0, 0, 0, 0],
                                        [1, 1, 1, 0, 0],
                                        [0, 1, 1, 0, 0],
                                        [0, 0, 1, 0, 0],
                                        [0, 0, 0, 0, 0]], bool))
        upper = covered(impl, p, np.array([[0.5, 1.5], [3.5, 4.5], [0.5, 4.5]]) + moved)
        assert_picture(upper, np.array([[0, 0, 0, 0, 0],
                                        [0, 0, 0, 0, 0],
                                        [1, 0, 0, 0, 0],
                                        [1, 1, 0, 0, 0],
                                        [0, 0, 0, 0, 0]], bool))


@exercise("2.4")
def test_a_face_of_any_size_is_covered_alike(impl, rng):
    """An absolute tolerance decides what lies on an edge, or a small area counts as none. Or small
    clockwise faces are not turned.
    """
    p, small = rng.uniform(0, 8, (300, 2)), 2.0**-20  # exact, so that only a tolerance can tell
    for triangle in TRIANGLE, TRIANGLE[::-1]:
        assert_equal(covered(impl, small * p, small * triangle), exact_inside(p, TRIANGLE))


@exercise("2.4")
def test_a_list_a_block_and_no_samples_at_all(impl):
    """Right for p (N, 2) alone: x is p[0] or p[:, 0] instead of p[..., 0], or a loop goes over the
    first axis. Or no samples give an array of another shape.
    """
    p, z = centres(8, 7) + 0.1, np.array([-0.5, 0.25, 0.75])
    block, row, none = (impl.cover(some, TRIANGLE, z) for some in (p, p[2], p[:, :0]))
    assert_equal(block[0], exact_inside(p, TRIANGLE))
    assert_equal(row[0], block[0][2])
    assert_close(row[1], block[1][2])
    assert_equal(np.array([np.shape(part) for part in none]), [[7, 0], [7, 0]])


@exercise("2.4", fine_print=True)
def test_a_flat_face_covers_nothing(impl):
    """A flat triangle owns the samples on it."""
    triangles = (np.array([[0.5, 0.5], [6.5, 6.5], [2.5, 2.5]]),
                 np.array([[0.5, 2.5], [6.5, 2.5], [2.5, 2.5]]))
    found = [covered(impl, centres(9, 9), triangle) for triangle in triangles]
    assert_picture(np.hstack(found), np.zeros((9, 18), bool))


@exercise("2.4", fine_print=True)
def test_a_shared_edge_is_covered_once(impl, rng):
    """Two faces compute the same edge with different rounding: samples are lost or drawn twice."""
    for _ in range(60):
        a, b = rng.uniform(0, 100, (2, 2))
        across = np.array([a[1] - b[1], b[0] - a[0]])
        left, right = a + across, b - across
        on_edge = a + (b - a) * rng.uniform(0.1, 0.9, (100, 1))
        count = covered(impl, on_edge, np.stack([a, b, left])).astype(int) \
            + covered(impl, on_edge, np.stack([b, a, right]))
        assert_equal(count, np.ones(100, int))


@exercise("2.4", fine_print=True)
def test_a_fan_covers_its_hub_once(impl, rng):
    """The hub of a fan is covered by no face or by several."""
    hub = np.array([4.5, 4.5])
    for _ in range(40):
        angles = rng.uniform(0, np.pi / 3, 3) + np.arange(3) * 2 * np.pi / 3
        rim = hub + 4 * np.stack([np.cos(angles), np.sin(angles)], -1)
        faces = [np.stack([hub, rim[k], rim[(k + 1) % 3]]) for k in range(3)]
        assert_equal(sum(int(covered(impl, hub[None], face)[0]) for face in faces), 1)


@exercise("2.4", fine_print=True)
def test_the_near_and_the_far_plane_are_part_of_the_picture(impl):
    """< in place of <= where the depth is compared with -1 and 1 (near and far plane). Or z is the
    sum l_k z_k, which rounding moves beyond them: eq. (4) is exact where all three z are equal.
    """
    triangle = np.array([[-1.95, -3.85], [31.85, -1.1], [-0.65, 31.35]])
    found = [impl.cover(centres(13, 11), triangle, np.full(3, z)) for z in (-1.0, 1.0)]
    assert_picture(np.hstack([seen for seen, _ in found]), np.ones((11, 26), bool))
    assert_close(np.array([depth for _, depth in found]),
                 np.stack([np.full((11, 13), -1.0), np.ones((11, 13))]))


@exercise("2.5")
def test_the_box_of_a_triangle_on_paper(impl):
    """x1 and y1 are the last pixel, not one past it (last column and row lost), or two past it. The
    centre's half pixel is forgotten or added. floor and ceil are exchanged. x and y are swapped, or
    the order is x0, x1, y0, y1.
    """
    triangle = np.array([[1.3, 3.2], [4.2, 2.8], [2.0, 7.2]])
    boxes = [impl.bounding_box(moved, 18, 19)
             for moved in (triangle, triangle + [5.4, 0.5], triangle + [0.4, 9.4])]
    assert_equal(np.array(boxes), [[1, 3, 4, 7], [7, 3, 10, 8], [2, 12, 5, 17]])


@exercise("2.5")
def test_the_box_is_wider_by_the_margin(impl):
    """MARGIN is missing, on one side only, taken away, or added twice."""
    low, high = 1.5 + 1 / 256, 4.5 - 1 / 256  # the box ends at the centres 1.5 and 4.5
    triangle = np.array([[low, high], [high, low], [3.0, 3.0]])
    uneven = np.array([[1.5, 1.5], [4.5, 4.5], [3.0, 3.0]]) + np.array([1, -1]) / 512
    wider = uneven + [[1 / 256, 0.0], [0.0, -1 / 256], [0.0, 0.0]]
    boxes = [impl.bounding_box(corners, 9, 9)
             for corners in (triangle + 1e-9, triangle - 1e-9, wider, uneven)]
    assert_equal(np.array(boxes), [[2, 2, 5, 5], [1, 1, 4, 4], [2, 1, 5, 4], [1, 1, 5, 5]])


@exercise("2.5", fine_print=True)
def test_a_centre_on_its_border_is_in_the_box(impl):
    """> in place of >=: a centre on the border is out."""
    low, high = 1.5 + 1 / 256, 4.5 - 1 / 256
    box = impl.bounding_box(np.array([[low, high], [high, low], [3.0, 3.0]]), 9, 9)
    assert_equal(box, (1, 1, 5, 5))


@exercise("2.5")
def test_the_box_stays_in_the_picture(impl):
    """The box is not cut to the picture (clipped), or to width - 1, or with width and height
    swapped.
    """
    corners = np.array([[-3.0, 2.0], [99.0, 3.0], [5.0, 77.0]])
    assert_equal(impl.bounding_box(corners, 10, 20), (0, 2, 10, 20))
    assert_equal(impl.bounding_box(corners - [9.0, 8.0], 10, 20), (0, 0, 10, 20))


@exercise("2.5", fine_print=True)
def test_the_box_stays_in_the_picture_wherever_the_triangle_is(impl):
    """The box is cut only after it became integers, or -0.5 is cut to 0. Or what lies outside has a
    box in the picture, or one of negative numbers.
    """
    triangle = np.array([[-1e300, 2.0], [1e300, 3.0], [5.0, 1e300]])
    assert_equal(impl.bounding_box(triangle, 10, 20), (0, 2, 10, 20))
    for outside in ([-3.0, -0.5, -1.5], [-3.0, -2.5, -1.5], [12.0, 10.0, 11.0], [14.0, 12.5, 13.0]):
        x0, y0, x1, y1 = impl.bounding_box(np.stack([outside, [2.0, 3.0, 5.0]], -1), 10, 20)
        assert_equal((x1 <= x0 <= 10, 0 <= x1, y0, y1), (True, True, 2, 5))
        x0, y0, x1, y1 = impl.bounding_box(np.stack([[2.0, 3.0, 5.0], outside], -1), 20, 10)
        assert_equal((y1 <= y0 <= 10, 0 <= y1, x0, x1), (True, True, 2, 5))


@exercise("2.5")
def test_no_covered_sample_lies_outside_the_box(impl, rng):
    """The box is rounded to whole numbers before the comparison: a column or row is missing."""
    p = centres(12, 10)
    for triangle in rng.uniform(-4, 16, (12, 3, 2)):
        x0, y0, x1, y1 = impl.bounding_box(triangle, 12, 10)
        boxed = np.zeros((10, 12), bool)
        boxed[y0:y1, x0:x1] = True
        assert_picture(boxed & exact_inside(p, triangle), exact_inside(p, triangle))


# --- with perspective --------------------------------------------------------------------------

@exercise("2.7")
def test_clockwise_faces_are_culled(impl):
    """Clockwise faces, those that turn their back, are kept instead of counter-clockwise ones. A
    mask or indices are returned, not faces. Or faces or their corners change their order.
    """
    x, y, w = np.array([[0.0, 4.0, 1.0, 5.0], [0.0, 0.0, 3.0, 4.0], [1.0, 2.0, 3.0, 4.0]])
    faces = np.array([[3, 2, 0], [0, 2, 1], [2, 0, 1], [1, 0, 3], [3, 2, 1]])
    assert_equal(impl.cull_back_faces(x, y, w, faces), faces[[0, 2, 4]])


@exercise("2.7")
def test_vertices_behind_the_camera_turn_the_face_over(impl, rng):
    """w is ignored: the winding on screen alone decides. Only one corner's w is looked at, or it is
    right for one vertex behind the camera but not for three. Or such faces are left out.
    """
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


@exercise("2.7", fine_print=True)
def test_faces_without_area_are_culled(impl):
    """>= in place of >: faces without area are kept."""
    x, y, w = np.array([[0.0, 2.0, 4.0], [0.0, 2.0, 4.0], [1.0, 1.0, 1.0]])
    faces = np.array([[0, 1, 2], [0, 0, 1]])
    assert_equal(impl.cull_back_faces(x, y, w, faces), faces[:0])


@exercise("2.8")
def test_in_front_of_the_camera_it_is_the_same_face(impl, rng):
    """z is not that of the point with w = 1, but of a point on the face or of ndc. Clockwise faces
    are lost, or near and far are forgotten.
    """
    points, z, w = TRIANGLE / 4 - 1, np.array([-1.5, 0.5, 0.75]), np.array([0.5, 1.0, 2.0])
    p = rng.uniform(0, 8, (300, 2))
    depth = np.column_stack([p, np.ones(300)]) @ np.linalg.solve(
        np.column_stack([TRIANGLE, np.ones(3)]), z)
    corners = np.column_stack([points, z, np.ones(3)]) * w[:, None]
    for order in [0, 1, 2], [2, 1, 0]:
        covered, found = impl.cover_in_clip_space(p / 4 - 1, corners[order])
        assert_close(found, depth)
        assert_equal(covered, exact_inside(p, TRIANGLE) & (np.abs(depth) <= 1))


@exercise("2.8")
def test_a_sample_sees_what_lies_on_its_ray(impl, rng):
    """Something is divided by w, or by |w|: a corner behind the camera is mirrored, and one in the
    camera plane is nowhere.
    """
    p = rng.uniform(-1, 1, (4, 5, 2))
    for _ in range(30):
        corners = rng.normal(size=(3, 4)) * [1, 1, 0.2, 1]
        corners[0, 3] = rng.choice([0, corners[0, 3]])
        rays = np.append(p, np.ones((4, 5, 1)), -1)
        weights = np.linalg.solve(corners[:, [0, 1, 3]].T, rays[..., None])[..., 0]
        covered, depth = impl.cover_in_clip_space(p, corners)
        assert_close(depth, weights @ corners[:, 2], rtol=1e-6, atol=1e-6)
        assert_equal(covered, (weights >= 0).all(-1) & (np.abs(weights @ corners[:, 2]) <= 1))


# --- pictures ----------------------------------------------------------------------------------

@exercise("2.6")
def test_one_triangle_on_paper(impl):
    """Rows are upside down (row 0 is at the bottom). Rows and columns are swapped. Pixels are
    sampled at their corners, not at their centres. depth is not stored, or does not start as inf,
    or face_index as -1. Counter-clockwise faces are turned.
    """
    clip = np.array([[-1.0, -1.0, 0.25, 1.0], [1.0, -1.0, 0.25, 1.0], [-1.0, 1.0, 0.25, 1.0]])
    face_index, depth = impl.rasterize(clip, np.array([[0, 1, 2]]), 7, 2)
    # The hypotenuse is x / 7 + y / 2 = 1: x < 5.25 in row 0 (y = 0.5), x < 1.75 in row 1.
    seen = np.arange(7) < np.array([[5], [2]])
    assert_picture(face_index, np.where(seen, 0, -1))
    assert_close(depth[seen], np.full(7, 0.25))
    assert_close(depth[~seen], np.full(7, np.inf))


@exercise("2.6")
def test_the_nearer_face_is_seen_whatever_the_order(impl):
    """No z-buffer: the last face wins, or the first one. The greatest depth is kept: the depth test
    is the wrong way round. depth is not updated with face_index. Depths below 0 are left out.
    """
    clip = np.concatenate([HALF + [0, 0, z, 0] for z in (0.5, 1e-9 - 0.5, -0.5, 0.0)])
    faces = np.arange(12).reshape(4, 3)
    orders = [0, 1, 2, 3], [2, 0, 1, 3], [3, 1, 0, 2]
    found = [impl.rasterize(clip, faces[order], 4, 4) for order in orders]
    seen = np.arange(4) >= np.arange(4)[:, None]
    expected = [np.where(seen, order.index(2), -1) for order in orders]
    assert_picture(np.hstack([face_index for face_index, _ in found]), np.hstack(expected))
    assert_close(np.array([depth for _, depth in found]),
                 np.tile(np.where(seen, -0.5, np.inf), (3, 1, 1)))


@exercise("2.6")
def test_depth_is_linear_on_the_screen(impl):
    """z is not divided by w, or only after it was interpolated, or with perspective-correct
    weights: z/w of the corners is linear on the screen. Or weights and corners do not match, or
    it is one corner's z.
    """
    clip = np.array([[-1.0, -1.0, -1.0, 1.0], [3.0, -3.0, 2.4, 3.0], [-1.0, 3.0, -1.0, 1.0]])
    _, depth = impl.rasterize(clip, np.array([[0, 1, 2]]), 8, 8)
    x = np.arange(8) + 0.5
    assert_close(depth[0, :7], -1 + 1.8 * x[:7] / 8)  # from z/w = -1 at x = 0 to 0.8 at x = 8


@exercise("2.6", fine_print=True)
def test_of_equally_deep_faces_the_first_is_seen(impl):
    """The depth test is <= instead of <: of equally deep faces, the last one wins."""
    clip, faces = np.concatenate([HALF] * 3), np.arange(9).reshape(3, 3)
    face_index, _ = impl.rasterize(clip, faces, 4, 4)
    assert_picture(face_index, np.where(face_index >= 0, 0, -1))


@exercise("2.6")
def test_a_face_smaller_than_a_pixel_is_seen_where_it_lies(impl):
    """Rows and columns of the box are swapped, or a small area counts as none."""
    x, y = np.array([5.2, 5.9, 5.3]) / 3 - 1, np.array([0.2, 0.4, 0.9]) / 2 - 1
    clip = np.stack([x, y, np.zeros(3), np.ones(3)], -1)
    found = [impl.rasterize(clip, np.array([face]), 6, 4)[0] for face in ([0, 1, 2], [0, 2, 1])]
    assert_picture(np.vstack(found), np.array([[-1, -1, -1, -1, -1, 0], *[[-1] * 6] * 3] * 2))


@exercise("2.6")
def test_each_sample_of_a_square_on_pixel_centres_has_one_face(impl):
    """Samples on an edge are left out, or go to the face on the other side: the box loses its last
    column or row, or a corner's order changes.
    """
    x, y = np.array([0.5, 3.5, 3.5, 0.5]), np.array([0.5, 0.5, 3.5, 3.5])
    clip = np.stack([x / 2 - 1, y / 2 - 1, np.zeros(4), np.ones(4)], -1)
    found = [impl.rasterize(clip, np.array(faces), 4, 4)[0]
             for faces in ([[0, 1, 2], [0, 2, 3]], [[0, 2, 3], [0, 1, 2]])]
    assert_picture(np.hstack(found), [[ 0,  0,  0, -1,  1,  1,  1, -1],
                                      [ 1,  0,  0, -1,  0,  1,  1, -1],
                                      [ 1,  1,  0, -1,  0,  0,  1, -1],
                                      [-1, -1, -1, -1, -1, -1, -1, -1]])


@exercise("2.6")
def test_faces_out_of_the_picture_draw_nothing(impl):
    """A box without pixels ends with an error, or a negative one counts from the other end."""
    places = [3.0, 0.0], [-3.0, 0.0], [0.0, 3.0], [0.0, -3.0], [0.0, 0.0]
    clip = np.concatenate([HALF + [*place, 0, 0] for place in places])
    face_index, _ = impl.rasterize(clip, np.arange(15).reshape(5, 3), 4, 4)
    seen = np.arange(4) >= np.arange(4)[:, None]
    assert_picture(face_index, np.where(seen, 4, -1))


@exercise("2.6")
def test_a_heap_of_faces_is_seen_ray_by_ray(impl, rng):
    """Whatever goes wrong only where several faces meet, cross, or reach out of the picture: each
    pixel sees the nearest face on its ray.
    """
    clip, faces = clip_triangles(rng, 12, behind=False)
    face_index, depth = impl.rasterize(clip, faces, 9, 7)
    expected = seen_on_rays(centres(9, 7).reshape(-1, 2), clip, faces, 9, 7)
    assert_close(depth, expected[1].reshape(7, 9), atol=1e-9)
    assert_picture(face_index, expected[0].reshape(7, 9))


@exercise("2.6")
def test_a_face_reaches_the_ends_of_a_wide_and_of_a_high_picture(impl):
    """Width and height are swapped on the way to the bounding box, or pixels beyond are drawn."""
    clip = np.array([[-3.0, -3.0, 0.0, 1.0], [9.0, -3.0, 0.0, 1.0], [-3.0, 9.0, 0.0, 1.0]])
    for corners, width, height in ((clip, 3, 9), (clip, 9, 3), (clip / 99, 3, 9)):
        corners = corners + [[0, 0, 0.1, 0]] * corners[:, :1]  # the depth is a tenth of ndc x
        face_index, depth = impl.rasterize(corners, np.array([[0, 1, 2]]), width, height)
        assert_picture(face_index, np.zeros((height, width), int))
        ndc_x = (np.arange(width) + 0.5) * 2 / width - 1
        assert_close(10 * depth, np.tile(ndc_x, (height, 1)), atol=1e-8)


@exercise("2.6")
def test_near_and_far_cut_a_face_in_its_middle(impl):
    """Depths beyond -1 or 1 are drawn, where the face crosses the near or the far plane: they are
    not compared, or only those of its corners.
    """
    clip = np.array([[-1.0, -1, -2, 1], [1, -1, 2, 1], [1, 1, 2, 1], [-1, 1, -2, 1]])  # z = 2 x
    face_index, _ = impl.rasterize(clip, np.array([[0, 1, 2], [0, 2, 3]]), 8, 2)
    assert_picture(face_index >= 0, np.tile(np.abs(np.arange(8) - 3.5) < 2, (2, 1)))


@exercise("2.6")
def test_clip_space_has_no_unit(impl):
    """A small w is taken for 0: faces far smaller than one are lost, although nothing changed."""
    clip = 1e-13 * np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [-1.0, 1.0, 0.0, 1.0]])
    face_index, _ = impl.rasterize(clip, np.array([[0, 1, 2]]), 4, 3)
    seen = np.array([[1, 1, 1, 0], [1, 1, 0, 0], [1, 0, 0, 0]], bool)
    assert_picture(face_index, np.where(seen, 0, -1))


# --- the way back -------------------------------------------------------------------------------

@exercise("2.9")
def test_the_gradients_of_two_edges_on_paper(impl):
    """A sign, x and y exchanged, a side that is not turned, or another order than p, a, b. n taken
    for a constant in grad_a or grad_b: the normal depends on both ends. grad_e is ignored.
    """
    p = np.array([[1.0, 4.0], [2.0, -1.0]])
    a, b = np.array([[3.0, 1.0], [-1.0, 3.0]]), np.array([[5.0, 2.0], [4.0, 1.0]])
    gradients = impl.edge_function_backward(np.array([10.0, -2.0]), p, a, b)
    assert_close(np.stack(gradients), [[[-10.0, 20.0], [-4.0, -10.0]],
                                       [[-20.0, -40.0], [-4.0, 4.0]],
                                       [[30.0, 20.0], [8.0, 6.0]]])


@exercise("2.9")
def test_the_gradients_of_edges_are_central_differences(impl, rng, gradcheck):
    """grad_e is ignored or summed up before it reaches the points."""
    def forward(p, a, b):
        return (a[..., 1] - b[..., 1]) * (p[..., 0] - a[..., 0]) \
            + (b[..., 0] - a[..., 0]) * (p[..., 1] - a[..., 1])

    gradcheck(forward, impl.edge_function_backward, tuple(rng.normal(size=(3, 2, 5, 2))),
              name="edge_function")
