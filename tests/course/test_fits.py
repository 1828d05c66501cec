"""The fits of labs 9 and 10, a few steps of each: they go the right way, and measure right."""
import functools

import numpy as np
import pytest

from course.given import mesh
from course.given.whose import Labs
from course.scenes import (
    demo,
    fit_bunny,
    fit_cube,
    fit_outlines,
    fit_pose,
    fit_texture,
    fit_triangle,
    large_steps,
    reflections,
    viewing,
)

LABS = Labs("reference")


def off_the_template(x):
    """How far a triangle's corners are from those of the template, in pixels."""
    return np.linalg.norm(x - fit_triangle.TEMPLATE, axis=1).sum()


def test_the_pose_comes_to_a_hundredth_of_a_degree():
    """The goal of the pose: a search that ends in a wrong valley, or a descent that ends early."""
    rotations, goal = fit_pose.fit(LABS, 0)
    off = LABS.inverse_rendering.rotation_angle(rotations[-1], goal)
    assert len(rotations) == 481 and np.degrees(off) < 0.01


def test_the_template_has_the_area_of_its_triangle():
    """A template that no triangle can match."""
    area = LABS.rasterization.signed_area(fit_triangle.TEMPLATE)
    assert fit_triangle.template(LABS).sum() == pytest.approx(abs(area))


@pytest.mark.parametrize("vertices, faces", [
    (fit_cube.CORNERS, fit_cube.FACES), (fit_pose.BLOCK + 0.5, fit_pose.FACES)])
def test_cubes_are_whole_and_face_outwards(vertices, faces):
    """A missing side, or one turned inside out."""
    normal = mesh.face_normals(vertices, faces)
    outward = (normal * (vertices[faces].mean(1) - 0.5)).sum(1)
    np.testing.assert_allclose(outward, 0.5)
    a, b, c = vertices[faces].swapaxes(0, 1) - 0.5
    assert (np.cross(a, b) * c).sum() / 6 == pytest.approx(1.0)


def test_a_cube_is_at_distance_0_from_itself():
    """An error that no fit can bring down to 0."""
    assert fit_cube.error(fit_cube.CORNERS - 0.5) == 0
    assert fit_cube.error(1.2 * (fit_cube.CORNERS - 0.5)) == pytest.approx(0.1 * np.sqrt(3))


def test_the_cube_is_found_step_by_step_and_the_same_again():
    """A fit that diverges, or that cannot be reproduced."""
    errors, losses, found = fit_cube.fit(LABS, 8, seed=1, steps=40)
    assert errors.shape == (41,) and errors[-1] < 0.9 * errors[0]
    assert losses.shape == (40,) and losses[-10:].mean() < 0.8 * losses[:10].mean()
    assert errors[-1] == fit_cube.error(found.positions)
    assert found.colours.shape == (8, 3)
    np.testing.assert_array_equal(fit_cube.fit(LABS, 8, seed=1, steps=5)[0], errors[:6])


def test_random_poses_are_rotations_and_shifts(rng):
    """A pose that mirrors or shears what it moves."""
    pose = viewing.random_pose(LABS, rng, 0.25)
    np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-12)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1)
    assert 0 < np.abs(pose[:3, 3]).max() <= 0.25


def test_a_cube_has_24_symmetries():
    """A rotation listed twice, or one that leaves the cube askew."""
    matrices = np.array([LABS.inverse_rendering.quaternion_matrix(q)[:3, :3]
                         for q in fit_pose.symmetries()])
    assert len(np.unique(matrices.round(6) + 0.0, axis=0)) == 24
    np.testing.assert_allclose(np.abs(matrices).sum(2), 1)


def test_greedy_search_never_takes_a_worse_rotation(rng):
    """A proposal taken on its distance to another goal, or without comparison."""
    start, goal = np.array([1.0, 0, 0, 0]), np.array([0.6, 0.8, 0, 0])
    found = fit_pose.search(LABS, rng, start, goal, 30, fit_pose.symmetries())
    target = fit_pose.seen(LABS, goal, 16)[0]
    losses = [((fit_pose.seen(LABS, q, 16)[0] - target)**2).mean() for q in found]
    assert len(found) == 31 and (np.diff(losses) <= 0).all() and losses[-1] < losses[0] / 2


def test_the_globe_is_a_closed_sphere_with_its_texture_outside():
    """A hole at a pole, a seam that is torn, or a mirrored map."""
    vertices, faces, uv = fit_texture.globe(8)
    np.testing.assert_allclose(np.linalg.norm(vertices, axis=1), 1)
    assert len(faces) == 2 * 8 * 16 - 2 * 16
    outward = (mesh.face_normals(vertices, faces) * vertices[faces].mean(1)).sum(1)
    assert outward.min() > 0.9
    np.testing.assert_allclose(viewing.directions(*uv.T), vertices)
    assert np.ptp(uv[faces], axis=1).max() < 0.13


def test_a_view_shows_the_texture():
    """Colours that are darkened where a pixel is covered in part, or of another place."""
    grey = np.full((8, 16, 3), 0.25)
    for at, footprint, colour in fit_texture.views(LABS, grey, 2, size=16):
        assert at.shape == (len(colour), 2) and footprint.shape == (len(colour), 2, 2)
        np.testing.assert_allclose(colour, 0.25)


@pytest.mark.parametrize("filter_mode", ["linear", "linear-mipmap-linear"])
def test_a_texture_comes_nearer_with_every_few_views(filter_mode):
    """A gradient that is scattered to other texels."""
    truth = fit_texture.planet(16)
    views = fit_texture.views(LABS, truth, 6, size=16)
    psnr, texture = fit_texture.fit(LABS, truth, views, filter_mode, size=16)
    assert (np.diff(psnr) > 0).all() and psnr[-1] == fit_texture.psnr(texture, truth)


def test_psnr_weighs_texels_by_their_area():
    """20 dB for another error than 0.1, or poles that count as much as the equator."""
    truth, texture = np.zeros((4, 8, 3)), np.zeros((4, 8, 3))
    assert fit_texture.psnr(truth + 0.1, truth) == pytest.approx(20)
    texture[[0, 3]] = 1
    share = np.cos(3 * np.pi / 8) / (np.cos(3 * np.pi / 8) + np.cos(np.pi / 8))
    assert fit_texture.psnr(texture, truth) == pytest.approx(-10 * np.log10(share))


@pytest.mark.parametrize(("fit", "settings"), [
    (fit_bunny.fit, (0.02,)), (large_steps.fit, (3.0, (0.2, 0.2)))], ids=["penalty", "large steps"])
def test_the_ball_grows_towards_the_bunny_and_does_not_fold(fit, settings):
    """A silhouette loss whose gradient shrinks the ball instead; or the gradient is followed as it
    is, and the outline's vertices leave the others behind.
    """
    path, losses = fit(LABS, *settings, steps=6, size=32)
    assert path.shape[0] == 7 and losses[-3:].mean() < losses[:3].mean()
    assert fit_bunny.folded_edges(path[-1], fit_bunny.ball()[1]) < 0.002  # 0.016 if left alone


def test_a_silhouette_is_shared_with_itself():
    """An intersection over union above or below 1 for equal shapes; pairs of other cameras."""
    cameras = viewing.cameras_around(LABS, 2)
    small = fit_bunny.ball()
    large = small[0] * np.sqrt(2), small[1]
    np.testing.assert_array_equal(fit_bunny.shared_silhouettes(LABS, small, small, cameras, 64), 1)
    # Of discs, a little less than 1 / 2: in perspective the larger ball looks larger still.
    assert 0.4 < fit_bunny.shared_silhouettes(LABS, small, large, cameras, 64).max() < 0.52


def test_random_cameras_look_at_the_origin():
    """Cameras all on one side, or that look elsewhere."""
    cameras = viewing.random_cameras(LABS, 40)
    origin = cameras @ [0.0, 0.0, 0.0, 1.0]
    np.testing.assert_allclose(origin[:, [0, 1, 3]], [[0, 0, 3]] * 40, atol=1e-12)
    towards = cameras[:, 3, :3]  # w grows along the view
    np.testing.assert_allclose(np.linalg.norm(towards, axis=1), 1)
    assert np.abs(towards.mean(0)).max() < 0.3


def test_a_missed_goal_is_told_and_makes_the_status_1(monkeypatch, capsys):
    """A demo that misses what it promises, and says nothing."""
    def scene(labs):
        """Two goals."""
        yield "near", None, ("0.1", True)
        yield "far", None, ("0.2", met)
        yield "nothing", None

    monkeypatch.setattr(demo, "SCENES", ("scene",))
    monkeypatch.setattr(demo, "scene", lambda _: scene)
    for met, status in (True, 0), (False, 1):
        assert demo.run([]) == status
        printed = capsys.readouterr().out
        assert "0.1" in printed and ("0.2 MISSED" in printed) == (not met)
        assert "0.1 MISSED" not in printed


def test_folds_are_counted():
    """A fold that is missed, or an edge of a flat plane that counts."""
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [-0.2, -0.2, 0.01]])
    faces = np.array([[0, 1, 2], [2, 1, 3], [0, 2, 3], [0, 3, 1]])
    assert fit_bunny.folded_edges(*fit_bunny.ball()) == 0
    assert fit_bunny.folded_edges(vertices, faces) > 0.3


# --- lab 10 -------------------------------------------------------------------------------------

@pytest.mark.parametrize("name, setting", [("sweep", {"eps": 1e-2}), ("soft", {}), ("blend", {})])
def test_each_gradient_brings_the_triangle_nearer(name, setting):
    """A gradient of the wrong sign, or by ndc where pixels are expected."""
    outline = functools.partial(fit_outlines.OUTLINES[name], **setting)
    x = fit_outlines.triangle(LABS, outline, steps=40)
    assert x.shape == (41, 3, 2) and off_the_template(x[-1]) < off_the_template(x[0]) - 5


@pytest.mark.parametrize("name", fit_outlines.OUTLINES)
def test_each_gradient_brings_the_ball_nearer_to_the_teapot(name):
    """A silhouette that is mirrored, or a camera that looks elsewhere."""
    path, faces = fit_outlines.teapot(LABS, fit_outlines.OUTLINES[name], steps=20, size=32)
    before, after = (fit_outlines.teapot_iou(LABS, path[step], faces, 64) for step in (0, -1))
    assert after > before + 0.1


def test_the_blend_of_lab_10_is_that_of_lab_9():
    """Two fits that go by one name and are not one."""
    x, *_ = fit_triangle.fit(LABS, fit_triangle.template(LABS), True, steps=4)
    y = fit_outlines.triangle(LABS, fit_outlines.blend_outline, steps=4)
    assert x.shape == y.shape and np.abs(x[1] - y[1]).max() < 1e-6


def test_the_footprints_of_a_picture_are_steps_to_neighbouring_pixels():
    """The change of a reflection is that of another place, or its sign is flipped."""
    eye = np.array([0.3, 0.6, 2.7])
    camera = viewing.clip_from_world(LABS, eye)
    seen, directions, change = reflections.view(LABS, camera, eye, 384)
    step = directions[:, 2:] - directions[:, :-2]
    off = np.linalg.norm(step - 2 * change[:, 1:-1, :, 0], axis=-1)
    whole = seen[:, 2:] & seen[:, 1:-1] & seen[:, :-2]
    assert whole.sum() > 5000
    assert np.median(off[whole] / np.linalg.norm(step[whole], axis=-1)) < 0.02
