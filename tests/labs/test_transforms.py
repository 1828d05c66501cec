"""What the exercises of lab 1 must do."""
import numpy as np
import pytest

from labkit.checks import assert_close, assert_refused, exercise

# A matrix of which no part is symmetric, and whose inverse is not its transpose.
MATRIX = np.array([[1.0, 2.0, 0.0, 3.0],
                   [0.0, 1.0, 4.0, -2.0],
                   [2.0, 0.0, 1.0, 5.0],
                   [0.0, 0.0, -1.0, 2.0]])


@exercise("1.1")
def test_the_matrix_acts_on_columns(impl):
    """The transposed matrix is applied: points @ matrix, not points @ matrix.T. Its translation
    (last column) or last row is left out, w is taken for 1, or it is multiplied element by element.
    Or it suits one point alone (matrix @ points).
    """
    points = np.array([[1.0, 2.0, 3.0, 1.0], [2.0, -1.0, 1.0, 0.0], [3.0, 1.0, -2.0, 2.0]])
    assert_close(impl.transform(points, MATRIX),
                 [[8.0, 12.0, 10.0, -1.0], [0.0, 3.0, 5.0, -1.0], [11.0, -11.0, 14.0, 6.0]])


@exercise("1.1")
def test_every_point_is_moved_by_itself(impl, rng):
    """Right for points (N, 4), but points of several leading axes are mixed up or raise an error:
    .T of points exchanges all their axes. Or all are treated as the first one is.
    """
    moved, matrix = rng.normal(size=(2, 3, 4)), rng.normal(size=(4, 4))
    points = brought_to(moved, matrix)
    assert_close(impl.transform(points, matrix), moved, atol=1e-9)


def brought_to(moved, matrix):
    """The points (..., 4) that a matrix takes to these: so nothing here says how it does."""
    return np.linalg.solve(matrix, moved[..., None])[..., 0]


@exercise("1.10")
def test_three_points_worked_out_on_paper(impl):
    """grad_points goes through the matrix as points do, or its inverse. grad_matrix is transposed
    (the outer product's order), averaged, of one point alone, or not summed over the points. Or
    both are exchanged.
    """
    points = np.array([[5.0, 6.0, 8.0, 1.0], [1.0, 2.0, 3.0, 1.0], [2.0, 0.0, 1.0, 3.0]])
    grad_output = np.array([[1.0, 10.0, 0.0, 0.0], [0.0, 0.0, 2.0, 1.0], [0.0, 1.0, 0.0, -1.0]])
    grad_points = [[1.0, 12.0, 40.0, -17.0], [4.0, 0.0, 1.0, 12.0], [0.0, 1.0, 5.0, -4.0]]
    grad_matrix = [[5.0, 6.0, 8.0, 1.0], [52.0, 60.0, 81.0, 13.0],
                   [2.0, 4.0, 6.0, 2.0], [-1.0, 2.0, 2.0, -2.0]]
    assert_close(impl.transform_backward(grad_output, points, MATRIX), (grad_points, grad_matrix))


@exercise("1.10")
@pytest.mark.parametrize("shape", [(4,), (6, 4), (2, 3, 4)], ids=str)
def test_both_gradients_say_what_a_change_does(impl, rng, shape):
    """Points of no leading axis, or of several, are not all counted in grad_matrix, or it is not
    summed over all of them. Or a gradient has another shape than its input.
    """
    (matrix, change), (grad, moved) = rng.normal(size=(2, 4, 4)), rng.normal(size=(2, *shape))
    points = brought_to(moved, change)  # matrix + change moves them farther by this
    grad_points, grad_matrix = impl.transform_backward(grad, points, matrix)
    assert_close((grad_matrix * change).sum(1), (grad * moved).reshape(-1, 4).sum(0), atol=1e-9)
    step = brought_to(moved, matrix)  # points + step move farther by the same
    assert_close((grad_points * step).sum(-1), (grad * moved).sum(-1), atol=1e-9)


@exercise("1.2")
@pytest.mark.parametrize("axis, start, end", [("z", "x", "y"), ("x", "y", "z"), ("y", "z", "x")])
def test_a_quarter_turn_takes_one_axis_to_the_next(impl, axis, start, end):
    """The turn is clockwise (a sign of the sine or of [n]x, or transposed), by degrees or half the
    angle. sin and cos are exchanged. n n^T is no outer product. A term is missing, or I has no cos.
    [3, 3] is not 1.
    """
    k, i, j = map("xyz".index, (axis, start, end))
    expected = np.diag([float(n in (k, 3)) for n in range(4)])
    expected[j, i], expected[i, j] = 1.0, -1.0
    assert_close(impl.rotate(np.eye(3)[k], np.pi / 2), expected)


@exercise("1.2")
def test_a_turn_about_a_slanted_axis_on_paper(impl):
    """The axis is not brought to length 1 (normalised), cos I or a part of (1 - cos) n n^T is
    missing or has another factor, or an entry of [n]x is misplaced or has the wrong sign.
    """
    # n = (2, 3, 6) / 7, cos = 3/5, sin = 4/5:
    # 245 R = 147 I + 2 (2, 3, 6) (2, 3, 6)^T + 28 [(2, 3, 6)]x
    expected = np.eye(4)
    expected[:3, :3] = np.array([[155.0, -156.0, 108.0],
                                 [180.0, 165.0, -20.0],
                                 [-60.0, 92.0, 219.0]]) / 245
    assert_close(impl.rotate(np.array([2.0, 3.0, 6.0]), np.arctan2(4.0, 3.0)), expected)


@exercise("1.2")
def test_a_rotation_leaves_its_axis_and_all_lengths(impl, rng):
    """The axis was not brought to length 1, or a term of Rodrigues' formula is missing."""
    axis, angle, identity = rng.normal(size=3), rng.uniform(-3, 3), np.eye(4)
    matrix = impl.rotate(axis, angle)
    assert_close(matrix @ np.append(axis, 1), np.append(axis, 1))
    assert_close(matrix @ matrix.T, identity)
    assert_close(np.linalg.det(matrix), 1.0)


@exercise("1.2")
def test_rotations_are_those_by_quaternions(impl, rng):
    """Right for the coordinate axes, wrong between them: a product n_i n_j is misplaced."""
    for axis, angle in zip(rng.normal(size=(20, 3)), rng.uniform(-7, 7, 20), strict=True):
        w, q = np.cos(angle / 2), np.sin(angle / 2) * axis / np.linalg.norm(axis)
        expected = np.eye(4)  # each row of the identity, turned, is a column of the matrix
        crossed = np.cross(q, np.eye(3))
        expected[:3, :3] += 2 * (w * crossed + np.cross(q, crossed)).T
        assert_close(impl.rotate(axis, angle), expected)


@exercise("1.3")
def test_a_camera_on_the_z_axis_only_moves_the_world_back(impl):
    """The third axis points forward (the camera looks down +z). An axis is not normalised to length
    1. Left and right or up and down are mirrored: a cross product's order. The world is moved by
    +eye, by the target, or not at all.
    """
    matrix = impl.look_at(np.array([1.0, 2.0, 5.0]), np.array([1.0, 2.0, 1.0]),
                          np.array([0.0, 3.0, 0.0]))
    assert_close(matrix[:3], [[1.0, 0.0, 0.0, -1.0], [0.0, 1.0, 0.0, -2.0], [0.0, 0.0, 1.0, -5.0]])


@exercise("1.3")
def test_a_camera_that_looks_down_on_paper(impl):
    """The axes are columns, not rows (transposed). right is not of length 1, or up itself is above,
    which is not perpendicular to back. Or -eye is not rotated: translate comes first.
    """
    matrix = impl.look_at(np.array([3.0, 3.0, 7.0]), np.array([1.0, -1.0, 3.0]),
                          np.array([-1.0, 4.0, 1.0]))
    # right = (2, 1, -2) / 3, above = (-2, 2, -1) / 3, back = (1, 2, 2) / 3
    assert_close(matrix[:3], np.array([[2.0, 1.0, -2.0, 5.0], [-2.0, 2.0, -1.0, 7.0],
                                       [1.0, 2.0, 2.0, -23.0]]) / 3)
    assert_close(matrix[3], [0.0, 0.0, 0.0, 1.0])


@exercise("1.3")
def test_eye_target_and_up_arrive_where_they_should(impl, rng):
    """The rows of the rotation are columns, an axis points the wrong way, or up was not made
    perpendicular."""
    for eye, target, up in rng.normal(size=(20, 3, 3)):
        matrix = impl.look_at(eye, target, up)
        distance = np.linalg.norm(target - eye)
        assert_close(matrix @ np.append(eye, 1), [0.0, 0.0, 0.0, 1.0])
        assert_close(matrix @ np.append(target, 1), [0.0, 0.0, -distance, 1.0])
        x, y, _ = (matrix @ np.append(up, 0))[:3]
        assert_close(x, 0.0)
        assert y > 0, f"up points down on screen: its y in view space is {y}"


@exercise("1.3")
def test_a_camera_neither_stretches_nor_mirrors(impl, rng):
    """right and up are not of length 1 (up is not perpendicular to the view), or x is mirrored. Or
    it looks elsewhere, as the identity does, which neither stretches nor mirrors.
    """
    eye, target, up = rng.normal(size=(3, 3))
    rotation = impl.look_at(eye, target, 7 * up)[:3, :3]
    assert_close(rotation @ (target - eye), [0.0, 0.0, -np.linalg.norm(target - eye)])
    assert_close(rotation @ rotation.T, np.eye(3))
    assert_close(np.linalg.det(rotation), 1.0)


@exercise("1.3", fine_print=True)
@pytest.mark.parametrize(("target", "up"), [
    ((1.0, 2.0, 1.0), (0.0, 0.0, -3.0)), ((0.3, 1.3, 4.3), (0.1, 0.1, 0.1)),
    ((1.0, 2.0, 5.0), (0.0, 1.0, 0.0)), ((1.0, 2.0, 1.0), (0.0, 0.0, 0.0))],
    ids=["along up", "but for rounding", "the eye", "no up"])
def test_where_nothing_says_what_is_right_there_is_no_camera(impl, target, up):
    """A camera that looks straight down, with the usual up, is NaN. Or up x back is compared with 0
    itself, and rounding chooses what is right.
    """
    assert_refused(impl.look_at, np.array([1.0, 2.0, 5.0]), np.array(target), np.array(up))


@exercise("1.3", fine_print=True)
@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_a_small_angle_to_the_view_says_what_is_right(impl, size):
    """The length of up x back is compared with no other length, or too much is refused."""
    eye, up = size * np.array([0.0, 0.0, 1.0]), size * np.array([0.0, 1e-6, 1.0])
    matrix = impl.look_at(eye, np.zeros(3), up)
    assert_close(matrix[:3, :3], np.eye(3))


@exercise("1.4")
def test_a_shear_on_paper(impl):
    """Normals are moved as points are, by the matrix itself. It takes the inverse and the
    transpose, both: one of them is missing. Or it is not divided by the determinant, or its rows
    are normalised.
    """
    matrix = np.array([[2.0, 1.0, 0.0, 5.0],
                       [0.0, 1.0, 3.0, 6.0],
                       [0.0, 0.0, 1.0, 7.0],
                       [0.0, 0.0, 0.0, 1.0]])
    assert_close(impl.normal_matrix(matrix), [[0.5, 0.0, 0.0], [-0.5, 1.0, 0.0], [1.5, -3.0, 1.0]])


@exercise("1.4")
def test_normals_stay_perpendicular_to_tangents(impl, rng):
    """The whole matrix is inverted, with its translation and last row, which leak into the normals.
    Only its upper left 3 x 3 counts.
    """
    for _ in range(10):
        matrix = rng.normal(size=(4, 4))
        n, v = rng.normal(size=(2, 3))
        moved = impl.normal_matrix(matrix) @ n
        assert_close(moved @ (matrix[:3, :3] @ v), n @ v, rtol=1e-6, atol=1e-9)


@exercise("1.5")
def test_a_pinhole_shrinks_with_distance(impl):
    """Nothing divides by z alone: the last row is (0, 0, 0, 1) or (0, 0, 1, 1). Or its sign is
    wrong, (0, 0, -1, 0), or that of f. The matrix is transposed. f is missing in the third row, or
    in x and y.
    """
    points = np.array([[1.0, 3.0, 4.0, 1.0], [-2.0, 5.0, 8.0, 1.0]])
    x, y, z, w = impl.pinhole(2.0) @ points.T
    assert_close(np.stack([x / w, y / w, z / w], -1), [[0.5, 1.5, 2.0], [-0.5, 1.25, 2.0]])


@exercise("1.5")
def test_points_of_one_ray_meet_in_one_pixel(impl, rng):
    """x and y are divided by something else than z."""
    ray, f = np.append(rng.uniform(1, 2, 3), 0), rng.uniform(1, 2)
    matrix = impl.pinhole(f)
    near, far = matrix @ (2 * ray), matrix @ (9 * ray)
    assert_close(near[:2] / near[3], far[:2] / far[3])
    assert_close(near[:2] / near[3], f * ray[:2] / ray[2])


@exercise("1.6")
def test_half_of_the_angle_is_the_angle_of_half_the_height(impl):
    """tan(fov_y), the whole angle, for tan(fov_y / 2), or sin, or degrees. fov_y is taken as the
    horizontal angle, aspect divides, is missing or on t. near is left out. t is the whole height,
    or the order or a sign is wrong.
    """
    fov_y = 2 * np.arctan(3 / 4)
    assert_close(np.array(impl.frustum_sides(fov_y, 1.5, 4.0)), [-4.5, 4.5, -3.0, 3.0])


@exercise("1.6")
def test_the_top_is_seen_at_half_the_field_of_view(impl, rng):
    """Only right for 90 degrees: the lecture's tan(theta / 2) = H / f is for half the height H."""
    for fov_y, aspect, near in rng.uniform([0.1, 0.2, 0.01], [3.0, 3.0, 5.0], (10, 3)):
        l, r, b, t = impl.frustum_sides(fov_y, aspect, near)
        assert_close(np.arctan2(t, near), fov_y / 2)
        assert_close(np.array([r / t, l / r, b / t]), [aspect, -1.0, -1.0])


CAMERA = 2 * np.arctan(3 / 4), 1.5, 2.0, 12.0  # fov_y, aspect, near, far


@exercise("1.7")
def test_w_is_the_distance_in_front_of_the_camera(impl):
    """w is z, as for a camera that looks down +z: the last row is (0, 0, 1, 0). Or w is 1, as in an
    orthographic matrix, or 1 is left in [3, 3]. Or the matrix is transposed (column-major), rows
    and columns swapped.
    """
    assert_close(impl.perspective(*CAMERA)[3], [0.0, 0.0, -1.0, 0.0])


@exercise("1.7")
def test_x_and_y_on_paper(impl):
    """The tangent is of the whole angle, or is not divided by. The aspect divides y in place of x,
    multiplies x, or is missing. Scales are near / t and near / r with the whole width and height,
    or have near left over, or a 2.
    """
    assert_close(impl.perspective(*CAMERA)[:2], [[8 / 9, 0.0, 0.0, 0.0], [0.0, 4 / 3, 0.0, 0.0]])


@exercise("1.7")
def test_depth_on_paper(impl):
    """alpha or beta has the wrong sign (far - near for near - far), or each stands in the other's
    place. near and far are swapped. The factor 2 of beta is missing (half of beta). Or depth runs
    from 0 to 1 as in Direct3D.
    """
    assert_close(impl.perspective(*CAMERA)[2], [0.0, 0.0, -1.4, -4.8])


@exercise("1.7")
def test_the_corners_of_what_is_seen_become_those_of_the_cube(impl, rng):
    """The matrix is right for one camera, and wrong for others: a number stands there for an angle,
    an aspect, near or far.
    """
    slope, aspect, near, far = rng.uniform([0.2, 0.5, 0.5, 5], [3, 3, 1, 9])
    matrix = impl.perspective(2 * np.arctan(slope), aspect, near, far)
    for x in -1, 1:
        for y in -1, 1:
            for distance, z in (near, -1), (far, 1):
                up = distance * slope
                corner = matrix @ np.array([x * aspect * up, y * up, -distance, 1.0])
                assert_close(corner, distance * np.array([x, y, z, 1.0]), atol=1e-9)


SIDES = -1.0, 4.0, -3.0, 5.0, 2.0, 12.0  # left, right, bottom, top, near, far


@exercise("1.8")
def test_w_stays_1(impl):
    """w depends on z: the last row is (0, 0, -1, 0), as in `frustum`. Or the matrix is transposed
    (column-major), rows and columns swapped.
    """
    assert_close(impl.orthographic(*SIDES)[3], [0.0, 0.0, 0.0, 1.0])


@exercise("1.8")
def test_the_sides_of_the_box_become_those_of_the_cube(impl):
    """The centre is not shifted to 0, or the wrong way (the translation's sign, or its column). 1
    in place of 2: ndc is 2 wide. r + l in place of r - l, or l, r, b, t mixed up.
    """
    assert_close(impl.orthographic(*SIDES)[:2], [[0.4, 0.0, 0.0, -0.6], [0.0, 0.25, 0.0, -0.25]])


@exercise("1.8")
def test_near_becomes_minus_1_and_far_1(impl):
    """z is not flipped: the camera looks down -z, and the box is z = -near..-far, not near..far. A
    sign of the third row, its shift missing, near and far swapped, or depth from 0 to 1.
    """
    assert_close(impl.orthographic(*SIDES)[2], [0.0, 0.0, -0.2, -1.4])


@exercise("1.8")
def test_the_corners_of_the_box_become_those_of_the_cube(impl, rng):
    """The matrix is right for one box, and wrong for others: a number stands there for l, r, b, t,
    near or far.
    """
    l, b, near = -rng.uniform(1, 2), -rng.uniform(1, 2), rng.uniform(0.5, 1)
    r, t, far = rng.uniform(3, 4), rng.uniform(3, 4), rng.uniform(5, 9)
    matrix = impl.orthographic(l, r, b, t, near, far)
    assert_close(matrix @ np.array([l, b, -near, 1.0]), [-1.0, -1.0, -1.0, 1.0])
    assert_close(matrix @ np.array([r, t, -far, 1.0]), [1.0, 1.0, 1.0, 1.0])


@exercise("1.9")
def test_x_and_y_are_in_pixels(impl):
    """y is flipped (row 0 is at the bottom). It is half a pixel or one pixel off (width - 1). ndc
    is taken as from 0 to 1, or the + 1 left out. Width and height are swapped, or // rounds.
    """
    ndc = np.array([[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [0.5, 0.0]])
    clip = np.column_stack([ndc, np.zeros(4), np.ones(4)])
    assert_close(impl.to_screen(clip, 641, 478)[:, :2], [[0.0, 0.0], [641.0, 0.0], [0.0, 478.0],
                                                         [480.75, 239.0]])


PLACES = np.array([[2.0, 4.0, -3.0, 2.0], [8.0, 2.0, 1.0, -4.0], [4.0, -2.0, 3.0, 8.0]])


@exercise("1.9")
def test_places_are_divided_by_w(impl):
    """Nothing is divided by w, or w's sign is lost, or pixels are divided: the divide comes first.
    """
    assert_close(impl.to_screen(PLACES, 10, 20)[:, :2], [[10.0, 30.0], [-5.0, 5.0], [7.5, 7.5]])


@exercise("1.9")
def test_the_depth_is_z_over_w(impl):
    """z is not divided by w, or is stretched to a range as x and y are. Or the output has no z."""
    assert_close(impl.to_screen(PLACES, 10, 20)[..., 2], [-1.5, -0.25, 0.375])


@exercise("1.9")
@pytest.mark.parametrize("shape", [(4,), (2, 3, 4), (3, 3, 4)], ids=str)
def test_every_point_has_its_own_w(impl, rng, shape):
    """Right for points (N, 4), but not for one point alone, or for several leading axes."""
    clip = rng.normal(size=shape)
    screen = impl.to_screen(clip, 8, 5)
    ndc = (screen - [4, 2.5, 0]) / [4, 2.5, 1]
    assert_close(ndc * clip[..., 3:], clip[..., :3])


GRAD_SCREEN = np.array([[1.0, 10.0, 100.0], [2.0, 3.0, -8.0]])
CLIP = np.array([[2.0, 4.0, 6.0, 2.0], [1.0, 2.0, 4.0, -4.0]])


@exercise("1.11")
def test_the_gradients_by_x_y_and_z_on_paper(impl):
    """They are divided by w once, not by w^2, by z, or not at all, and not multiplied by w. The
    viewport's scale is forgotten, divides, is the whole width and height, or is that of z, too.
    Width and height are swapped. Or grad_clip has no place for w, or w stands first.
    """
    grad = impl.to_screen_backward(GRAD_SCREEN, CLIP, 6, 20)
    assert_close(grad[..., :3], [[1.5, 50.0, 50.0], [-1.5, -7.5, 2.0]])


@exercise("1.11")
def test_the_gradient_by_w_on_paper(impl):
    """The gradient of w is 0 (w as a constant), or has the wrong sign. x, y or z is missing: all
    three add to it. It is divided by w once or three times, not by w squared.
    """
    grad = impl.to_screen_backward(GRAD_SCREEN, CLIP, 6, 20)
    # -(3 * 2 + 100 * 4 + 100 * 6) / 2^2  and  -(6 * 1 + 30 * 2 - 8 * 4) / 4^2
    assert_close(grad[..., 3], [-251.5, -2.125])


@exercise("1.11")
@pytest.mark.parametrize("shape", [(4,), (5, 4), (2, 3, 4)], ids=str)
def test_a_step_along_the_ray_changes_nothing_and_one_across_moves_the_pixel(impl, rng, shape):
    """Right for points (N, 4), but not for one point alone, or for several leading axes: w's
    gradient is summed over the points, too. Or to_screen's constant offset leaks in.
    """
    clip, grad_screen = rng.normal(size=shape), rng.normal(size=(*shape[:-1], 3))
    clip[..., 3] = rng.choice([-1, 1], shape[:-1]) * rng.uniform(0.5, 2, shape[:-1])
    grad = impl.to_screen_backward(grad_screen, clip, 9, 4)
    across = clip[..., 3:] / [4.5, 2.0, 1.0]  # so far in x, y or z is 1 on the screen
    assert_close(grad[..., :3] * across, grad_screen)
    assert_close((grad * clip).sum(-1), np.zeros(shape[:-1]))
