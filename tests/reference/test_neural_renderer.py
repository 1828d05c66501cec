"""The reference's whole maps of lab 10: faces, weights, depth, and their gradients."""
import numpy as np
import pytest
from loose_faces import CAMERA, some_corners

from course.given import mesh
from course.given.gradcheck import gradcheck
from labkit.checks import assert_equal
from reference import interpolation, neural_renderer, pipeline, rasterization, scanline
from tests.labs.test_neural_renderer import SLANTED, random_triangles

WIDTH, HEIGHT = 23, 17


def teapot_clip():
    vertices, faces = mesh.teapot()
    return pipeline.to_clip(mesh.normalize(vertices), CAMERA), faces


def test_the_picture_is_that_of_lab_2():
    """Half a pixel off, rows upside down, or z of clip space for the distance."""
    clip, faces = teapot_clip()
    face_index, weight, depth = neural_renderer.rasterize(
        neural_renderer.corners_of(clip, faces), 64, 48)
    x, y, w = rasterization.screen_points(clip, 64, 48)
    front = rasterization.cull_back_faces(x, y, w, faces)
    expected, _ = scanline.rasterize(clip, front, 64, 48)
    seen = expected >= 0
    np.testing.assert_array_equal(face_index >= 0, seen)
    same = (faces[face_index[seen]] == front[expected[seen]]).all(1)
    assert same.mean() > 0.999  # two faces at equal depth
    b = interpolation.barycentrics(expected, clip, front)[seen][same]
    w_there = (b * clip[front[expected[seen][same]], 3]).sum(1)
    np.testing.assert_allclose(depth[seen][same], w_there, rtol=1e-9)
    right = weight[seen][same] * depth[seen][same][:, None]
    np.testing.assert_allclose(right / clip[front[expected[seen][same]], 3], b, atol=1e-9)


def fixed_faces(corners, *_):
    return neural_renderer.rasterize(corners, WIDTH, HEIGHT)[0]


def test_gradients_of_weights_and_depth_are_central_differences(rng):
    """A factor between ndc and pixels, width for height, or a face's pixels not summed up."""
    corners = some_corners(rng)

    def maps(corners):
        face_index, weight, depth = neural_renderer.rasterize(corners, WIDTH, HEIGHT)
        return weight, np.where(face_index >= 0, depth, 0)

    gradcheck(maps, lambda grad_weight, grad_depth, corners: (neural_renderer.rasterize_backward(
        grad_weight, grad_depth, fixed_faces(corners), corners),),
        (corners,), decisions=fixed_faces, name="maps")


def test_gradients_of_corners_are_central_differences(rng):
    """w without its part in x / w, or z. Or a vertex of several faces that keeps one of them."""
    clip, faces = rng.uniform(1, 2, (5, 4)), np.array([[0, 1, 2], [2, 1, 3], [3, 0, 2]])
    gradcheck(neural_renderer.corners_of, neural_renderer.corners_backward, (clip, faces),
              name="corners")


def test_a_vertex_in_the_camera_plane_is_not_seen_and_has_no_gradient(rng):
    """w = 0: 0 / 0 in the picture or on the way back."""
    clip = np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0],
                     [0.5, 2.0, 0.0, 0.0]])
    faces = np.array([[0, 1, 2], [2, 1, 3]])
    corners = neural_renderer.corners_of(clip, faces)
    face_index, weight, depth = neural_renderer.rasterize(corners, WIDTH, HEIGHT)
    assert face_index.max() == 0
    grad_corners = neural_renderer.rasterize_backward(rng.normal(size=weight.shape),
                                                      rng.normal(size=depth.shape), face_index,
                                                      corners)
    grad_clip = neural_renderer.corners_backward(grad_corners, clip, faces)
    assert np.isfinite(grad_clip).all() and grad_clip[:3].any()
    np.testing.assert_array_equal(grad_clip[3], 0)


@pytest.mark.parametrize("turn", [0, 1, 2])
def test_it_does_not_matter_with_which_corner_a_face_begins(impl, turn):
    """Only one corner's angle is looked at, or one z."""
    z = np.array([[1.0, 2.0, 3.0], [1.0, 2.0, -0.5], [1.0, 2.0, 0.0], [-1.0, -2.0, -3.0]])
    screen = np.repeat(np.roll(SLANTED, turn, 0)[None], 4, 0)
    assert_equal(impl.front_faces(screen, np.roll(z, turn, 1)), [True, False, False, False])


def test_many_faces_are_told_by_their_turn(impl, rng):
    """Clockwise faces are drawn instead, x and y are swapped, coordinates of different faces are
    mixed, or a small face is taken for one without area.
    """
    screen = random_triangles(rng, 9)
    screen[4:] *= 1e-3
    flipped = rng.random(9) < 0.5
    screen[flipped] = screen[flipped][:, ::-1]
    assert_equal(impl.front_faces(screen, np.ones((9, 3))), ~flipped)
