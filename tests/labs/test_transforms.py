"""What the exercises of lab 1 must do."""
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.checks import assert_close, exercise
from course.given.gradcheck import gradcheck


@exercise("1.2")
def test_the_matrix_acts_on_columns(impl):
    """points @ matrix instead of points @ matrix.T: the transposed matrix was applied."""
    matrix = np.array([[0.0, 1.0, 0.0, 0.0],
                       [0.0, 0.0, 2.0, 0.0],
                       [3.0, 0.0, 0.0, 0.0],
                       [0.0, 0.0, 0.0, 1.0]])
    assert_close(impl.transform(np.array([[10.0, 20.0, 30.0, 1.0]]), matrix),
                 np.array([[20.0, 60.0, 30.0, 1.0]]))


@exercise("1.2")
def test_every_point_is_moved_by_itself(impl, rng):
    """Points are mixed up where they have several leading axes."""
    points, matrix = rng.normal(size=(2, 3, 4)), rng.normal(size=(4, 4))
    expected = np.array([[matrix @ point for point in row] for row in points])
    assert_close(impl.transform(points, matrix), expected)


@exercise("1.3")
def test_one_point_worked_out_on_paper(impl):
    """The matrix and its transpose are mixed up, or the outer product's order."""
    matrix = np.diag([1.0, 2.0, 3.0, 4.0])
    matrix[0, 3] = 7.0  # output_0 = x + 7
    points, matrix_of = impl.transform_backward(np.array([[1.0, 10.0, 0.0, 0.0]]),
                                                np.array([[5.0, 6.0, 8.0, 1.0]]), matrix)
    assert_close(points, np.array([[1.0, 20.0, 0.0, 7.0]]))
    assert_close(matrix_of, np.array([[5.0, 6.0, 8.0, 1.0], [50.0, 60.0, 80.0, 10.0],
                                      [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]]))


@exercise("1.3")
@pytest.mark.parametrize("shape", [(4,), (6, 4), (2, 3, 4)], ids=str)
def test_both_gradients_of_the_product_are_central_differences(impl, rng, shape):
    """A gradient is transposed, averaged over the points, or taken of one point alone."""
    gradcheck(lambda points, matrix: points @ matrix.T, impl.transform_backward,
              (rng.normal(size=shape), rng.normal(size=(4, 4))), name="transform")


@exercise("1.6")
@pytest.mark.parametrize("axis, start, end", [("z", "x", "y"), ("x", "y", "z"), ("y", "z", "x")])
def test_a_quarter_turn_takes_one_axis_to_the_next(impl, axis, start, end):
    """The turn is clockwise (a sign of sin), or the angle was taken for degrees."""
    unit = dict(zip("xyz", np.eye(4)[:3], strict=True))
    matrix = impl.rotate(unit[axis][:3], np.pi / 2)
    assert_close(matrix @ unit[start], unit[end])


@exercise("1.6")
def test_a_rotation_leaves_its_axis_and_all_lengths(impl, rng):
    """The axis was not brought to length 1, or a term of Rodrigues' formula is missing."""
    axis, angle, identity = rng.normal(size=3), rng.uniform(-3, 3), np.eye(4)
    matrix = impl.rotate(axis, angle)
    assert_close(matrix @ matrix.T, identity)
    assert_close(matrix @ np.append(axis, 1), np.append(axis, 1))
    assert_close(np.linalg.det(matrix), 1.0)


@exercise("1.6")
def test_rotations_are_those_of_scipy(impl, rng):
    """Right for the coordinate axes, wrong between them: a product n_i n_j is misplaced."""
    for axis, angle in zip(rng.normal(size=(20, 3)), rng.uniform(-7, 7, 20), strict=True):
        expected = np.eye(4)
        expected[:3, :3] = Rotation.from_rotvec(axis / np.linalg.norm(axis) * angle).as_matrix()
        assert_close(impl.rotate(axis, angle), expected)


@exercise("1.7")
def test_a_camera_on_the_z_axis_only_moves_the_world_back(impl):
    """The camera looks down +z, or the world is moved by +eye."""
    matrix = impl.look_at(np.array([0.0, 0.0, 5.0]), np.zeros(3), np.array([0.0, 1.0, 0.0]))
    assert_close(matrix, np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0],
                                   [0.0, 0.0, 1.0, -5.0], [0.0, 0.0, 0.0, 1.0]]))


@exercise("1.7")
def test_eye_target_and_up_arrive_where_they_should(impl, rng):
    """The rows of the rotation are columns, an axis points the wrong way, or up was not made
    perpendicular."""
    for eye, target, up in rng.normal(size=(20, 3, 3)):
        matrix = impl.look_at(eye, target, up)
        distance = np.linalg.norm(target - eye)
        assert_close(matrix @ np.append(eye, 1), np.array([0.0, 0.0, 0.0, 1.0]))
        assert_close(matrix @ np.append(target, 1), np.array([0.0, 0.0, -distance, 1.0]))
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


@exercise("1.8")
def test_a_normal_of_a_squeezed_surface_on_paper(impl):
    """The matrix itself was returned: the normal of the plane x + y = 0, squeezed in x, tilts."""
    normals = impl.normal_matrix(np.diag([0.5, 1.0, 1.0, 1.0]))
    assert_close(normals @ np.array([1.0, 1.0, 0.0]), np.array([2.0, 1.0, 0.0]))


@exercise("1.8")
def test_normals_stay_perpendicular_to_tangents(impl, rng):
    """The inverse without the transpose, or a translation that leaks into the normals."""
    for _ in range(10):
        matrix = rng.normal(size=(4, 4))
        n, v = rng.normal(size=(2, 3))
        moved = impl.normal_matrix(matrix) @ n
        assert_close(moved @ (matrix[:3, :3] @ v), n @ v, rtol=1e-6, atol=1e-9)


@exercise("1.9")
def test_a_pinhole_shrinks_with_distance(impl):
    """The last row is (0, 0, 0, 1): nothing divides by z."""
    matrix = impl.pinhole(2.0)
    for z in 4.0, 7.0:
        x, y, depth, w = matrix @ np.array([1.0, 3.0, z, 1.0])
        assert_close(np.array([x / w, y / w, depth / w]), np.array([2 / z, 6 / z, 2.0]))


@exercise("1.9")
def test_points_of_one_ray_meet_in_one_pixel(impl, rng):
    """x and y are divided by something else than z."""
    ray = np.append(rng.uniform(1, 2, 3), 0)
    matrix = impl.pinhole(1.5)
    near, far = matrix @ (2 * ray), matrix @ (9 * ray)
    assert_close(near[:2] / near[3], far[:2] / far[3])
    assert_close(near[:2] / near[3], 1.5 * ray[:2] / ray[2])


@exercise("1.10")
def test_half_of_the_angle_is_the_angle_of_half_the_height(impl):
    """tan(fov_y) instead of tan(fov_y / 2), degrees for radians, or the aspect applied to t."""
    l, r, b, t = impl.frustum_sides(np.pi / 2, 2.0, 0.5)
    assert_close(np.array([l, r, b, t]), np.array([-1.0, 1.0, -0.5, 0.5]))


@exercise("1.10")
def test_the_top_is_seen_at_half_the_field_of_view(impl, rng):
    """Only right for 90 degrees: the lecture's tan(theta / 2) = H / f is for half the height H."""
    for fov_y, aspect, near in rng.uniform([0.1, 0.2, 0.01], [3.0, 3.0, 5.0], (10, 3)):
        l, r, b, t = impl.frustum_sides(fov_y, aspect, near)
        assert_close(np.arctan2(t, near), fov_y / 2)
        assert_close(np.array([r / t, l / r, b / t]), np.array([aspect, -1.0, -1.0]))


@exercise("1.11")
def test_the_corners_of_the_frustum_become_those_of_the_cube(impl, rng):
    """A sign of alpha or beta, near and far swapped, or 2 forgotten in 2 near / (r - l)."""
    l, b, near = -rng.uniform(1, 2), -rng.uniform(1, 2), rng.uniform(0.5, 1)
    r, t, far = rng.uniform(3, 4), rng.uniform(3, 4), rng.uniform(5, 9)
    matrix = impl.frustum(l, r, b, t, near, far)
    for x, ndc_x in (l, -1), (r, 1):
        for y, ndc_y in (b, -1), (t, 1):
            for z, ndc_z in (-near, -1), (-far, 1):
                corner = matrix @ np.array([x * z / -near, y * z / -near, z, 1.0])
                assert_close(corner[:3] / corner[3], np.array([ndc_x, ndc_y, ndc_z]), atol=1e-9)


@exercise("1.11")
def test_w_is_the_distance_in_front_of_the_camera(impl):
    """The last row is (0, 0, 1, 0) of a camera that looks down +z."""
    matrix = impl.frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 3.0)
    assert_close(matrix[3], np.array([0.0, 0.0, -1.0, 0.0]))


@exercise("1.12")
def test_the_corners_of_the_box_become_those_of_the_cube(impl, rng):
    """The sign of the translation, or z runs the wrong way."""
    l, r, b, t, near, far = -1.0, 3.0, -2.0, 0.5, 0.7, 4.0
    matrix = impl.orthographic(l, r, b, t, near, far)
    assert_close(matrix @ np.array([l, b, -near, 1.0]), np.array([-1.0, -1.0, -1.0, 1.0]))
    assert_close(matrix @ np.array([r, t, -far, 1.0]), np.array([1.0, 1.0, 1.0, 1.0]))
    assert_close(matrix[3], np.array([0.0, 0.0, 0.0, 1.0]))


@exercise("1.13")
def test_the_divide_is_by_w(impl, rng):
    """z is not divided, or the division is by z."""
    ndc = impl.perspective_divide(np.array([2.0, 4.0, -2.0, 2.0]))
    assert_close(ndc, np.array([1.0, 2.0, -1.0]))
    clip = rng.normal(size=(2, 3, 4))
    expected = np.array([[[p[0] / p[3], p[1] / p[3], p[2] / p[3]] for p in row] for row in clip])
    assert_close(impl.perspective_divide(clip), expected)


@exercise("1.14")
def test_the_gradient_by_w_on_paper(impl):
    """The term of w is missing: without it, depth has no influence on the picture."""
    grad = impl.perspective_divide_backward(np.array([1.0, 10.0, 100.0]),
                                            np.array([2.0, 4.0, 6.0, 2.0]))
    # ndc = (1, 2, 3); by w: -(1 * 1 + 10 * 2 + 100 * 3) / 2
    assert_close(grad, np.array([0.5, 5.0, 50.0, -160.5]))


@exercise("1.14")
@pytest.mark.parametrize("shape", [(4,), (5, 4), (2, 3, 4)], ids=str)
def test_the_gradient_of_the_divide_is_central_differences(impl, rng, shape):
    """A sign, or 1/w for 1/w^2, in the gradient by w."""
    clip = rng.normal(size=shape)
    clip[..., 3] = rng.choice([-1, 1], shape[:-1]) * rng.uniform(0.5, 2, shape[:-1])
    gradcheck(lambda clip: clip[..., :3] / clip[..., 3:], impl.perspective_divide_backward, (clip,),
              name="perspective_divide")


@exercise("1.15")
def test_the_corners_of_ndc_become_those_of_the_picture(impl):
    """y is flipped (row 0 is at the bottom here), width and height swapped, or half a pixel off."""
    matrix = impl.viewport(641, 479)
    assert_close(matrix @ np.array([-1.0, -1.0, 0.5, 1.0]), np.array([0.0, 0.0, 0.5, 1.0]))
    assert_close(matrix @ np.array([1.0, 1.0, -0.5, 1.0]), np.array([641.0, 479.0, -0.5, 1.0]))
    assert_close(matrix @ np.array([-1.0, 1.0, 0.0, 1.0]), np.array([0.0, 479.0, 0.0, 1.0]))


@exercise("1.17")
def test_a_step_in_ndc_is_half_a_picture(impl):
    """The gradient was divided by the scale instead of multiplied."""
    assert_close(impl.to_screen_backward(np.array([[1.0, 2.0, 3.0]]), 641, 479),
                 np.array([[320.5, 479.0, 3.0]]))


@exercise("1.17")
def test_the_gradient_of_the_viewport_is_central_differences(impl, rng):
    """The constant part of the viewport leaks into the gradient."""
    gradcheck(lambda ndc: (ndc + np.array([1.0, 1.0, 0.0])) * np.array([320.0, 240.0, 1.0]),
              lambda grad, ndc: impl.to_screen_backward(grad, 640, 480),
              (rng.normal(size=(3, 4, 3)),), name="to_screen")
