"""What lab 16's search is given: a folder of pictures."""
import numpy as np
import pytest
import ring_captures as ring

from apps.reconstruct import camera_files, captures
from course.given import image, mesh


def test_a_folder_on_paper(folder):
    """The ball's centre is not the grid's, or the aspect is turned over."""
    photos = captures.read(ring.LABS, folder)
    assert photos.names == [f"{k}.png" for k in range(6)]
    assert [picture.shape for picture in photos.pictures] == [(32, 48, 4)] * 6
    grid_from_world = np.linalg.inv(photos.world_from_grid)
    clip = photos.cameras[0] @ grid_from_world @ [1.4, 1.2, 3, 1]  # 0.4 right, 0.8 down, 4 away
    high = 4 * np.tan(np.radians(15))
    np.testing.assert_allclose(clip[:2] / clip[3], [0.4 / (1.5 * high), -0.8 / high])
    assert abs(clip[2]) < clip[3]
    outside = photos.pictures[0][..., 3] == 0
    np.testing.assert_allclose(photos.pictures[0][outside][:, :3], 1)
    np.testing.assert_allclose(photos.pictures[0][~outside][:, :3], image.to_linear(128 / 255),
                               atol=1e-6)


def test_a_camera_sees_the_object_where_its_picture_shows_it(tmp_path):
    """The silhouette is upside down or mirrored beside the camera, or the principal point is not
    where it is said to be.
    """
    pictures = [ring.picture(k, left=3.0, down=-2.0) for k in range(6)]
    ring.photograph(tmp_path, pictures)
    # The middle of the picture is 3 pixels right of the principal point, and 2 below it.
    ring.nerf(tmp_path, cx=24 - 3, cy=16 - 2)
    photos = captures.read(ring.LABS, tmp_path)
    clip = photos.cameras[1] @ np.linalg.inv(photos.world_from_grid) @ [1, 2, 3, 1]
    np.testing.assert_allclose(clip[:2] / clip[3], [2 * 21 / 48 - 1, 1 - 2 * 14 / 32], atol=1e-9)
    require_same_silhouettes(photos)


def test_pictures_of_two_sizes_come_out_as_one_with_the_same_rays(tmp_path):
    """A frame of background moves the picture, but not its camera, or stretches it."""
    sizes = [(48, 32), (48, 23), (48, 32), (40, 40), (96, 48), (45, 32)]
    ring.photograph(tmp_path, [ring.picture(k, *size) for k, size in enumerate(sizes)])
    lenses = [{"fl_x": ring.F * height / 32} for _, height in sizes]
    frames = [frame | lens for frame, lens in zip(ring.frames(ring.POSES), lenses, strict=True)]
    photos = captures.read(ring.LABS, ring.nerf(tmp_path, frames=frames), 48)
    assert {picture.shape for picture in photos.pictures} == {(40, 48, 4)}
    # 40 x 40 pixels lie in the columns 4 to 44: 8 pixels are 0.4 of the half height 20.
    grid_from_world = np.linalg.inv(photos.world_from_grid)
    clip = photos.cameras[3] @ grid_from_world @ [1, 2, 3, 1]
    np.testing.assert_allclose(clip[:2], 0, atol=1e-9)
    right = photos.cameras[3] @ grid_from_world @ ring.POSES[3] @ [
        0.4 * np.tan(np.radians(15)), 0, -1, 1]
    np.testing.assert_allclose(right[:2] / right[3], [8 / 24, 0], atol=1e-9)
    right = photos.cameras[4] @ grid_from_world @ ring.POSES[4] @ [
        np.tan(np.radians(15)), 0, -1, 1]  # 48 x 24 pixels: 12 right of the middle
    np.testing.assert_allclose(right[:2] / right[3], [12 / 24, 0], atol=1e-9)
    require_same_silhouettes(photos)


def require_same_silhouettes(photos):
    """The ring, rendered by the cameras that were read, covers what its pictures cover."""
    grid_from_world = np.linalg.inv(photos.world_from_grid)
    vertices, faces = mesh.torus(400, 0.5, 0.25)
    for camera, picture in zip(photos.cameras, photos.pictures, strict=True):
        height, width, _ = picture.shape
        clip = ring.LABS.pipeline.to_clip(vertices + ring.CENTRE, camera @ grid_from_world)
        seen = ring.LABS.rasterization.rasterize(clip, faces, width, height)[0] >= 0
        assert ((picture[..., 3] > 0.5) != seen).sum() < 0.07 * seen.sum()


def test_a_camera_within_the_ball_is_told():
    """A camera gets planes that are both behind it."""
    shot = camera_files.Shot("a.png", None, 8, 8, 10.0, 10.0, 4.0, 4.0, np.eye(4))
    with pytest.raises(ValueError, match=r"the camera of a.png stands within the ball"):
        captures.camera(ring.LABS, shot, np.array([0.0, 0.0, -0.9]), 1.0)
