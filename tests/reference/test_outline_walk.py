"""The reference's whole pictures with outlines that are found by walking."""
import numpy as np
import pytest
from screen_scenes import camera, drawn

from course.given import mesh
from course.scenes.relaxation import split_in_four
from reference import antialiasing, outline_walk, outlines, pipeline

FAR = camera((0.0, 0.0, 4.0), fov_y=0.7)
LOW = camera((0.3, 0.25, 2.0), (0.0, 0.0, 0.0), near=0.01)  # over a floor that goes on behind it


@pytest.mark.parametrize("count, least", [(1_000, 0.5), (20_000, 0.9)])
def test_the_whole_derivative_of_a_ball_s_area_is_found(count, least):
    """A walk stops too early, and faces that are smaller than pixels lose the gradient."""
    vertices, faces = mesh.icosphere(count)
    seen, white = drawn(pipeline.to_clip(vertices, FAR), faces, 96, 96)
    exact = 2 * np.pi * (48 / np.tan(0.35) * 4 / (4**2 - 1))**2  # of a disc that grows

    def lost(pairs):
        _, grad_clip = antialiasing.blend_pairs_backward(np.ones_like(white), white, pairs, seen[2])
        return 1 - (grad_clip * (vertices @ FAR[:, :3].T)).sum() / exact

    assert abs(lost(outline_walk.walked_pairs(*seen))) < 0.015
    assert lost(outlines.blended_pairs(*seen)) > least  # else any rule would do
    pull = outline_walk.outline_pull_backward(np.ones_like(white), white,
                                              outline_walk.outline_pairs(*seen)[0], seen[2])
    assert (pull * (vertices @ FAR[:, :3].T)).sum() == pytest.approx(exact, rel=0.01)


def bumps():
    x, faces = mesh.icosphere(80)
    return pipeline.to_clip(x * (1 + 0.4 * np.sin(7 * x[:, :1])), FAR), faces


def test_nothing_of_a_bumpy_surface_lies_beyond_its_outline():
    """The walk ends at the first of many folds, as that of a fifth of the pairs does here."""
    x, faces = mesh.icosphere(2_000)
    clip = pipeline.to_clip(x + np.random.default_rng(0).uniform(-0.04, 0.04, x.shape), FAR)
    seen, _ = drawn(clip, faces, 32, 32)
    (fine, *_), _ = drawn(clip, faces, 32 * 33, 32 * 33)
    pairs, _ = outline_walk.both_pairs(*seen)
    row, column = np.divmod(pairs.owner, 32)
    dx, dy = antialiasing.pair_step(pairs.owner, pairs.other, 32)
    beyond = pairs.c + 0.06
    there = fine[(33 * (row + 0.5 + dy * beyond)).astype(int),
                 (33 * (column + 0.5 + dx * beyond)).astype(int)] >= 0
    is_rim = (seen[0].ravel()[pairs.other] < 0) & (beyond < 1)
    assert is_rim.sum() > 80 and there[is_rim].mean() < 0.02


def floor():
    x = np.array([[-3.0, 0, -3], [3, 0, -3], [3, 0, 6], [-3, 0, 6]])
    return pipeline.to_clip(x, LOW), np.array([[0, 2, 1], [0, 3, 2]])


@pytest.mark.parametrize("scene", [bumps, floor])
def test_smaller_faces_have_the_same_outlines(scene):
    """A fold, or a corner behind the camera, leads a walk astray."""
    clip, faces = scene()
    assert (scene is floor) == (clip[:, 3] < 0).any()
    expected = sorted_pairs(*drawn(clip, faces, 40, 30)[0])
    for _ in range(3):
        clip, faces = split_in_four(clip, faces)
    got = sorted_pairs(*drawn(clip, faces, 40, 30)[0])
    assert len(expected) > 20
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("strips", [1, 40])
def test_a_floor_that_goes_on_behind_the_camera_has_its_whole_derivative(strips):
    """A face has a corner behind the camera, and its edge counts for nothing or with the wrong
    sign, or a walk leaves it by another one.
    """
    eye = camera((0.0, 0.25, 2.0), (0.0, 0.25, 0.0), near=0.01)
    f, far, h = eye[0, 0], 5.0, 0.25
    half = far * 5 / 48 / f  # of its width: its far end is 10 pixels wide
    k, side = np.arange(strips), half * np.linspace(-1, 1, strips + 1)
    x = np.array([[along, 0.0, z] for z in (2 - far, 6.0) for along in side])
    faces = np.concatenate([np.stack([k, k + strips + 2, k + 1], 1),
                            np.stack([k, k + strips + 1, k + strips + 2], 1)])
    seen, white = drawn(pipeline.to_clip(x, eye), faces, 96, 96)
    _, grad_clip = antialiasing.blend_pairs_backward(
        np.ones_like(white), white, outline_walk.walked_pairs(*seen), seen[2])
    got = [(grad_clip * (way @ eye[:, :3].T)).sum() for way in (x * [1, 0, 0], *np.eye(3)[1:])]
    area = half / h  # on screen, less half h (f / far)^2: by width, height and place
    end = half * (f / far)**2
    np.testing.assert_allclose(got, np.array([area - end * h, area / h + end, -2 * end * h / far])
                               * 48**2, rtol=0.005)


def sorted_pairs(*seen):
    """owner, other and c (N, 3) of `outline_pairs`."""
    pairs, _ = outline_walk.outline_pairs(*seen)
    found = np.column_stack(pairs[:3])
    return found[np.lexsort((pairs.other, pairs.owner))]
