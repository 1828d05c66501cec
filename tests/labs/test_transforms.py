"""What the exercises of lab 1 must do."""
import numpy as np
import pytest

from labkit.checks import assert_close, assert_refused, exercise

# A matrix of which no part is symmetric, and whose inverse is not its transpose.
MATRIX = np.array([[1.0, 2.0, 0.0, 3.0],
                   [0.0, 1.0, 4.0, -2.0],
                   [2.0, 0.0, 1.0, 5.0],
                   [0.0, 0.0, -1.0, 2.0]])


@exercise("1.2")
def test_the_matrix_acts_on_columns(impl):
    """The transposed matrix is applied: points @ matrix, not points @ matrix.T. Its translation
    (last column) or last row is left out, w is taken for 1, or it is multiplied element by element.
    Or it suits one point alone (matrix @ points).
    """
    points = np.array([[1.0, 2.0, 3.0, 1.0], [2.0, -1.0, 1.0, 0.0], [3.0, 1.0, -2.0, 2.0]])
    assert_close(impl.transform(points, MATRIX),
                 [[8.0, 12.0, 10.0, -1.0], [0.0, 3.0, 5.0, -1.0], [11.0, -11.0, 14.0, 6.0]])


@exercise("1.2")
def test_every_point_is_moved_by_itself(impl, rng):
    """Right for points (N, 4), but points of several leading axes are mixed up or raise an error:
    .T of points exchanges all their axes. Or all are treated as the first one is.
    """
    points, matrix = rng.normal(size=(2, 3, 4)), rng.normal(size=(4, 4))
    expected = [[matrix @ point for point in row] for row in points]
    assert_close(impl.transform(points, matrix), expected)


@exercise("1.3")
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


@exercise("1.3")
@pytest.mark.parametrize("shape", [(4,), (6, 4), (2, 3, 4)], ids=str)
def test_both_gradients_of_the_product_are_central_differences(impl, rng, shape, gradcheck):
    """Points of no leading axis, or of several, are not all counted in grad_matrix, or it is not
    summed over all of them. Or a gradient has another shape than its input.
    """
    gradcheck(lambda points, matrix: points @ matrix.T, impl.transform_backward,
              (rng.normal(size=shape), rng.normal(size=(4, 4))), name="transform")


@exercise("1.6")
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


@exercise("1.6")
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


@exercise("1.6")
def test_a_rotation_leaves_its_axis_and_all_lengths(impl, rng):
    """The axis was not brought to length 1, or a term of Rodrigues' formula is missing."""
    axis, angle, identity = rng.normal(size=3), rng.uniform(-3, 3), np.eye(4)
    matrix = impl.rotate(axis, angle)
    assert_close(matrix @ np.append(axis, 1), np.append(axis, 1))
    assert_close(matrix @ matrix.T, identity)
    assert_close(np.linalg.det(matrix), 1.0)


@exercise("1.6")
def test_rotations_are_those_by_quaternions(impl, rng):
    """Right for the coordinate axes, wrong between them: a product n_i n_j is misplaced."""
    for axis, angle in zip(rng.normal(size=(20, 3)), rng.uniform(-7, 7, 20), strict=True):
        w, q = np.cos(angle / 2), np.sin(angle / 2) * axis / np.linalg.norm(axis)
        expected = np.eye(4)  # each row of the identity, turned, is a column of the matrix
        crossed = np.cross(q, np.eye(3))
        expected[:3, :3] += 2 * (w * crossed + np.cross(q, crossed)).T
        assert_close(impl.rotate(axis, angle), expected)


@exercise("1.7")
def test_a_camera_on_the_z_axis_only_moves_the_world_back(impl):
    """The third axis points forward (the camera looks down +z). An axis is not normalised to length
    1. Left and right or up and down are mirrored: a cross product's order. The world is moved by
    +eye, by the target, or not at all.
    """
    matrix = impl.look_at(np.array([1.0, 2.0, 5.0]), np.array([1.0, 2.0, 1.0]),
                          np.array([0.0, 3.0, 0.0]))
    assert_close(matrix[:3], [[1.0, 0.0, 0.0, -1.0], [0.0, 1.0, 0.0, -2.0], [0.0, 0.0, 1.0, -5.0]])


@exercise("1.7")
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


@exercise("1.7")
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


@exercise("1.7")
def test_a_camera_neither_stretches_nor_mirrors(impl, rng):
    """right and up are not of length 1 (up is not perpendicular to the view), or x is mirrored."""
    eye, target, up = rng.normal(size=(3, 3))
    rotation = impl.look_at(eye, target, 7 * up)[:3, :3]
    assert_close(rotation @ rotation.T, np.eye(3))
    assert_close(np.linalg.det(rotation), 1.0)


@exercise("1.7", fine_print=True)
@pytest.mark.parametrize(("target", "up"), [
    ((1.0, 2.0, 1.0), (0.0, 0.0, -3.0)), ((0.3, 1.3, 4.3), (0.1, 0.1, 0.1)),
    ((1.0, 2.0, 5.0), (0.0, 1.0, 0.0)), ((1.0, 2.0, 1.0), (0.0, 0.0, 0.0))],
    ids=["along up", "but for rounding", "the eye", "no up"])
def test_where_nothing_says_what_is_right_there_is_no_camera(impl, target, up):
    """A camera that looks straight down, with the usual up, is NaN. Or up x back is compared with 0
    itself, and rounding chooses what is right.
    """
    assert_refused(impl.look_at, np.array([1.0, 2.0, 5.0]), np.array(target), np.array(up))


@exercise("1.7", fine_print=True)
@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_a_small_angle_to_the_view_says_what_is_right(impl, size):
    """The length of up x back is compared with no other length, or too much is refused."""
    eye, up = size * np.array([0.0, 0.0, 1.0]), size * np.array([0.0, 1e-6, 1.0])
    matrix = impl.look_at(eye, np.zeros(3), up)
    assert_close(matrix[:3, :3], np.eye(3))


@exercise("1.8")
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


@exercise("1.8")
def test_normals_stay_perpendicular_to_tangents(impl, rng):
    """The whole matrix is inverted, with its translation and last row, which leak into the normals.
    Only its upper left 3 x 3 counts.
    """
    for _ in range(10):
        matrix = rng.normal(size=(4, 4))
        n, v = rng.normal(size=(2, 3))
        moved = impl.normal_matrix(matrix) @ n
        assert_close(moved @ (matrix[:3, :3] @ v), n @ v, rtol=1e-6, atol=1e-9)


@exercise("1.9")
def test_a_pinhole_shrinks_with_distance(impl):
    """Nothing divides by z alone: the last row is (0, 0, 0, 1) or (0, 0, 1, 1). Or its sign is
    wrong, (0, 0, -1, 0), or that of f. The matrix is transposed. f is missing in the third row, or
    in x and y.
    """
    points = np.array([[1.0, 3.0, 4.0, 1.0], [-2.0, 5.0, 8.0, 1.0]])
    x, y, z, w = impl.pinhole(2.0) @ points.T
    assert_close(np.stack([x / w, y / w, z / w], -1), [[0.5, 1.5, 2.0], [-0.5, 1.25, 2.0]])


@exercise("1.9")
def test_points_of_one_ray_meet_in_one_pixel(impl, rng):
    """x and y are divided by something else than z."""
    ray, f = np.append(rng.uniform(1, 2, 3), 0), rng.uniform(1, 2)
    matrix = impl.pinhole(f)
    near, far = matrix @ (2 * ray), matrix @ (9 * ray)
    assert_close(near[:2] / near[3], far[:2] / far[3])
    assert_close(near[:2] / near[3], f * ray[:2] / ray[2])


@exercise("1.10")
def test_half_of_the_angle_is_the_angle_of_half_the_height(impl):
    """tan(fov_y), the whole angle, for tan(fov_y / 2), or sin, or degrees. fov_y is taken as the
    horizontal angle, aspect divides, is missing or on t. near is left out. t is the whole height,
    or the order or a sign is wrong.
    """
    fov_y = 2 * np.arctan(3 / 4)
    assert_close(np.array(impl.frustum_sides(fov_y, 1.5, 4.0)), [-4.5, 4.5, -3.0, 3.0])


@exercise("1.10")
def test_the_top_is_seen_at_half_the_field_of_view(impl, rng):
    """Only right for 90 degrees: the lecture's tan(theta / 2) = H / f is for half the height H."""
    for fov_y, aspect, near in rng.uniform([0.1, 0.2, 0.01], [3.0, 3.0, 5.0], (10, 3)):
        l, r, b, t = impl.frustum_sides(fov_y, aspect, near)
        assert_close(np.arctan2(t, near), fov_y / 2)
        assert_close(np.array([r / t, l / r, b / t]), [aspect, -1.0, -1.0])


SIDES = -1.0, 4.0, -3.0, 5.0, 2.0, 12.0  # left, right, bottom, top, near, far


@exercise("1.11")
def test_w_is_the_distance_in_front_of_the_camera(impl):
    """w is z, as for a camera that looks down +z: the last row is (0, 0, 1, 0). Or w is 1, as in an
    orthographic matrix, or 1 is left in [3, 3]. Or the matrix is transposed (column-major), rows
    and columns swapped.
    """
    assert_close(impl.frustum(*SIDES)[3], [0.0, 0.0, -1.0, 0.0])


@exercise("1.11")
def test_x_and_y_on_paper(impl):
    """The 2 or near in 2 near / (r - l) is missing, or far stands there, or l, r, b, t or sum and
    difference are mixed up. The off-centre terms are missing, have the wrong sign, or stand in the
    last column, not the third.
    """
    assert_close(impl.frustum(*SIDES)[:2], [[0.8, 0.0, 0.6, 0.0], [0.0, 0.5, 0.25, 0.0]])


@exercise("1.11")
def test_depth_on_paper(impl):
    """alpha or beta has the wrong sign (far - near for near - far), or each stands in the other's
    place. near and far are swapped. The factor 2 of beta is missing (half of beta). Or depth runs
    from 0 to 1 as in Direct3D.
    """
    assert_close(impl.frustum(*SIDES)[2], [0.0, 0.0, -1.4, -4.8])


@exercise("1.11")
def test_the_corners_of_the_frustum_become_those_of_the_cube(impl, rng):
    """The matrix is right for one frustum, and wrong for others: a number stands there for l, r, b,
    t, near or far.
    """
    l, b, near = -rng.uniform(1, 2), -rng.uniform(1, 2), rng.uniform(0.5, 1)
    r, t, far = rng.uniform(3, 4), rng.uniform(3, 4), rng.uniform(5, 9)
    matrix = impl.frustum(l, r, b, t, near, far)
    for x, ndc_x in (l, -1), (r, 1):
        for y, ndc_y in (b, -1), (t, 1):
            for z, ndc_z in (-near, -1), (-far, 1):
                corner = matrix @ np.array([x * z / -near, y * z / -near, z, 1.0])
                assert_close(corner[:3] / corner[3], [ndc_x, ndc_y, ndc_z], atol=1e-9)


@exercise("1.12")
def test_w_stays_1(impl):
    """w depends on z: the last row is (0, 0, -1, 0), as in `frustum`. Or the matrix is transposed
    (column-major), rows and columns swapped.
    """
    assert_close(impl.orthographic(*SIDES)[3], [0.0, 0.0, 0.0, 1.0])


@exercise("1.12")
def test_the_sides_of_the_box_become_those_of_the_cube(impl):
    """The centre is not shifted to 0, or the wrong way (the translation's sign, or its column). 1
    for 2: ndc is 2 wide. r + l for r - l, or l, r, b, t mixed up.
    """
    assert_close(impl.orthographic(*SIDES)[:2], [[0.4, 0.0, 0.0, -0.6], [0.0, 0.25, 0.0, -0.25]])


@exercise("1.12")
def test_near_becomes_minus_1_and_far_1(impl):
    """z is not flipped: the camera looks down -z, and the box is z = -near..-far, not near..far. A
    sign of the third row, its shift missing, near and far swapped, or depth from 0 to 1.
    """
    assert_close(impl.orthographic(*SIDES)[2], [0.0, 0.0, -0.2, -1.4])


@exercise("1.12")
def test_the_corners_of_the_box_become_those_of_the_cube(impl, rng):
    """The matrix is right for one box, and wrong for others: a number stands there for l, r, b, t,
    near or far.
    """
    l, b, near = -rng.uniform(1, 2), -rng.uniform(1, 2), rng.uniform(0.5, 1)
    r, t, far = rng.uniform(3, 4), rng.uniform(3, 4), rng.uniform(5, 9)
    matrix = impl.orthographic(l, r, b, t, near, far)
    assert_close(matrix @ np.array([l, b, -near, 1.0]), [-1.0, -1.0, -1.0, 1.0])
    assert_close(matrix @ np.array([r, t, -far, 1.0]), [1.0, 1.0, 1.0, 1.0])


@exercise("1.13")
def test_the_divide_is_by_w(impl):
    """The division is by z or -z, not w, or by |w|: the sign of w is lost. z is not divided. w of
    the first point divides all, or w lost its last axis (clip[..., 3], not 3:). w is kept as a
    fourth number.
    """
    clip = np.array([[2.0, 4.0, -3.0, 2.0], [8.0, 2.0, 1.0, -4.0], [4.0, -2.0, 3.0, 8.0]])
    assert_close(impl.perspective_divide(clip), [[1.0, 2.0, -1.5], [-2.0, -0.5, -0.25],
                                                 [0.5, -0.25, 0.375]])


@exercise("1.13")
def test_every_point_is_divided_by_its_own_w(impl, rng):
    """Right for points (N, 4), but not for one point alone, or for several leading axes: w of
    another point divides.
    """
    for shape in (4,), (2, 3, 4), (3, 3, 4):
        clip = rng.normal(size=shape)
        expected = np.array([[p[k] / p[3] for k in range(3)] for p in clip.reshape(-1, 4)])
        assert_close(impl.perspective_divide(clip), expected.reshape(*shape[:-1], 3))


GRAD_NDC = np.array([[1.0, 10.0, 100.0], [2.0, 3.0, -8.0]])
CLIP = np.array([[2.0, 4.0, 6.0, 2.0], [1.0, 2.0, 4.0, -4.0]])


@exercise("1.14")
def test_the_gradients_by_x_y_and_z_on_paper(impl):
    """The gradients of x, y and z are grad_ndc divided by w: once, not by w^2, by z, or not at all,
    and not multiplied by w. Or grad_clip has no place for w, or w stands first.
    """
    grad = impl.perspective_divide_backward(GRAD_NDC, CLIP)
    assert_close(grad[..., :3], [[0.5, 5.0, 50.0], [-0.5, -0.75, 2.0]])


@exercise("1.14")
def test_the_gradient_by_w_on_paper(impl):
    """The gradient of w is 0 (w as a constant), or has the wrong sign. x, y or z is missing: all
    three add to it. It is divided by w once or three times, not by w squared.
    """
    grad = impl.perspective_divide_backward(GRAD_NDC, CLIP)
    # -(1 * 2 + 10 * 4 + 100 * 6) / 2^2  and  -(2 * 1 + 3 * 2 - 8 * 4) / 4^2
    assert_close(grad[..., 3], [-160.5, 1.5])


@exercise("1.14")
@pytest.mark.parametrize("shape", [(4,), (5, 4), (2, 3, 4)], ids=str)
def test_the_gradient_of_the_divide_is_central_differences(impl, rng, shape, gradcheck):
    """Right for points (N, 4), but not for one point alone, or for several leading axes: w's
    gradient is summed over the points, too.
    """
    clip = rng.normal(size=shape)
    clip[..., 3] = rng.choice([-1, 1], shape[:-1]) * rng.uniform(0.5, 2, shape[:-1])
    gradcheck(lambda clip: clip[..., :3] / clip[..., 3:], impl.perspective_divide_backward, (clip,),
              name="perspective_divide")


@exercise("1.15")
def test_the_viewport_on_paper(impl):
    """y is flipped (row 0 is at the bottom). It is half a pixel or one pixel off (width - 1). ndc
    is taken as from 0 to 1. The shift is missing. Width and height are swapped, z is changed, or //
    rounds.
    """
    assert_close(impl.viewport(641, 478), [[320.5, 0.0, 0.0, 320.5],
                                           [0.0, 239.0, 0.0, 239.0],
                                           [0.0, 0.0, 1.0, 0.0],
                                           [0.0, 0.0, 0.0, 1.0]])


@exercise("1.15")
def test_the_corners_of_ndc_become_those_of_the_picture(impl, rng):
    """The matrix is right for one size of the picture, and wrong for others."""
    width, height = rng.integers([100, 1000], [900, 9000]).tolist()
    matrix = impl.viewport(width, height)
    assert_close(matrix @ np.array([-1.0, -1.0, 0.5, 1.0]), [0.0, 0.0, 0.5, 1.0])
    assert_close(matrix @ np.array([1.0, 1.0, -0.5, 1.0]), [width, height, -0.5, 1.0])
    assert_close(matrix @ np.array([-1.0, 1.0, 0.0, 1.0]), [0.0, height, 0.0, 1.0])


@exercise("1.17")
def test_a_step_in_ndc_is_half_a_picture(impl):
    """The gradient is divided by the scale, not multiplied. The constant offset is added, as in
    to_screen itself. The scale is the whole width and height, not half of it, or they are swapped.
    y is flipped, or z is not kept.
    """
    grad = impl.to_screen_backward(np.array([[1.0, 2.0, 3.0], [-4.0, 6.0, 5.0]]), 641, 479)
    assert_close(grad, [[320.5, 479.0, 3.0], [-1282.0, 1437.0, 5.0]])


@exercise("1.17")
def test_the_gradient_of_the_viewport_is_central_differences(impl, rng, gradcheck):
    """The constant part of the viewport leaks into the gradient."""
    width, height = rng.integers([100, 1000], [900, 9000]).tolist()
    gradcheck(lambda ndc: (ndc + np.array([1.0, 1.0, 0.0])) * [width / 2, height / 2, 1.0],
              lambda grad, ndc: impl.to_screen_backward(grad, width, height),
              (rng.normal(size=(3, 4, 3)),), name="to_screen")
