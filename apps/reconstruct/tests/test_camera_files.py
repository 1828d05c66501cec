"""Where pictures were taken, as transforms.json says it."""

import numpy as np
import pytest
import ring_captures as ring

from apps.reconstruct import camera_files, captures


@pytest.fixture
def folder(tmp_path):
    """Six pictures, 48 x 32 pixels, and no cameras."""
    return ring.photograph(tmp_path)


def test_a_camera_of_nerf_on_paper(folder):
    """The angle is taken from below to above, or as degrees. What stands for all hides a frame's
    own, or what says nothing is refused.
    """
    shot = camera_files.read(ring.nerf(folder, camera_angle_x=2 * np.arctan(0.5))).shots[2]
    assert shot.name == "2.png"
    np.testing.assert_allclose(shot[2:8], [48, 32, 48, 48, 24, 16])
    frames = [{**frame, "camera_angle_x": 2 * np.arctan(48 / (50 + k))}
              for k, frame in enumerate(ring.frames(ring.POSES, "{}.png"))]
    nothing = {"k1": 0.0, "k5": 0, "is_fisheye": False, "rolling_shutter": [0, 0, 0, 0], "scale": 2}
    scene = ring.nerf(folder, frames=frames, fl_x=40, fl_y=70, cx=20, cy=17, w=96, h=64, **nothing)
    shot = camera_files.read(scene).shots[2]
    np.testing.assert_allclose(shot[2:8], [96, 64, 52, 70, 20, 17])
    np.testing.assert_allclose(shot.world_from_camera, ring.POSES[2])


X, Y = 2 * np.arctan(32 / 80), 2 * np.arctan(24 / 96)


@pytest.mark.parametrize(("lens", "fx", "fy"), [
    ({"camera_angle_x": X, "camera_angle_y": Y}, 80, 96), ({"camera_angle_y": Y}, 96, 96),
    ({"fl_x": 80, "camera_angle_x": 1, "camera_angle_y": Y}, 80, 96), ({"fl_y": 96}, 96, 96)])
def test_nerfs_lens_has_two_focal_lengths(tmp_path, lens, fx, fy):
    """What is said of y is not read, or an angle of y is measured in the width."""
    ring.photograph(tmp_path, [ring.picture(k, 64, 48) for k in range(6)])
    shots = camera_files.read(ring.nerf(tmp_path, **{"camera_angle_x": None, **lens})).shots
    np.testing.assert_allclose(shots[0][2:8], [64, 48, fx, fy, 32, 24])


def test_pictures_of_another_size_scale_their_cameras(folder):
    """A camera for pictures of twice the size sees half of the object."""
    exact = captures.read(ring.LABS, ring.nerf(folder))
    scene = ring.nerf(folder, fl_x=2 * ring.F, cx=48, cy=32, w=96, h=64, camera_angle_x=None)
    scaled = captures.read(ring.LABS, scene)
    np.testing.assert_allclose(scaled.cameras, exact.cameras, atol=1e-9)
    assert scaled.assumed[0] == ("0.png (and 5 more) is not of the size that transforms.json says, "
                                 "but 48 x 32: its camera is scaled")


def test_a_picture_that_is_not_there_is_left_out(folder):
    """Who deletes a blurred picture must edit the file."""
    (ring.nerf(folder) / "2.png").unlink()
    photos = captures.read(ring.LABS, folder)
    assert photos.names == [name for name in ring.NAMES if name != "2.png"]
    assert " is not there, and is left out of " in photos.assumed[0]
    for k in (3, 4):
        (folder / f"{k}.png").unlink()
    assert " has 3: there is no " in ring.told(folder)


MATRIX = np.eye(4)
MATRIX[2, 3] = 5.0


@pytest.mark.parametrize(("changes", "sentence"), [
    ({"frames": {}}, 'transforms.json must be {"camera_angle_x": ..., "frames": [...]}'),
    ({"frames": [7] * 4}, 'frame 0 in transforms.json needs a "file_path"'),
    ({"frames": [{"file_path": "0"}]}, "transform_matrix of 0 in transforms.json must be 4 x 4 "),
    ({"frames": ring.frames([MATRIX] * 3)}, "at least 4 views are needed, 20 are better, and tra"),
    *(({"frames": ring.frames([matrix] * 4)}, f"transform_matrix of ./0 in transforms.json {wrong}")
      for matrix, wrong in (
          (np.eye(3), "must be 4 x 4 finite numbers"), (MATRIX * np.nan, "must be 4 x 4 finite"),
          (MATRIX.T, "must have 0, 0, 0, 1 as its last row: is it transposed?"),
          (MATRIX * [2, 2, 2, 1], "must be a rotation and a shift"),
          (MATRIX * [-1, 1, 1, 1], "is mirrored"))),
    ({"frames": ring.frames([MATRIX] * 4, "0.png")}, "0.png and 0.png have the same camera in tra"),
    ({"frames": ring.frames([MATRIX] * 4, "9.png")}, "has 0: there is no "),
    ({"camera_angle_x": None}, "needs a camera_angle_x in radians, or a fl_x in pixels"),
    *(({key: 1}, f"{key} in transforms.json is 1: such a lens is not read: apps/reconstruct")
      for key in camera_files.NOT_READ),
    ({"camera_angle_x": 40}, "camera_angle_x in transforms.json must be from 0.01 to 3.1, and is"),
    *(({"cx": wrong}, f"cx in transforms.json must be a finite number, and is {shown}")
      for wrong, shown in (("much", "much"), (True, "True"), (10**400, "..."))),
    ({"camera_model": "OPENCV_FISHEYE"}, "camera_model in transforms.json is OPENCV_FISHEYE: such"),
    ({"w": 48, "h": 40}, "0.png has 48 x 32 pixels, and transforms.json says 48 x 40, which is"),
    ({"frames": ring.frames(ring.POSES * np.array([1, -1, -1, 1]))},
     "does the camera look along its own -z (OpenCV's along +z), and")])
def test_what_is_wrong_with_transforms_json_is_told_in_one_sentence(folder, changes, sentence):
    """A traceback, or a search that cannot find anything."""
    assert sentence in ring.told(ring.nerf(folder, **changes))


def test_a_folder_without_cameras_is_told(tmp_path):
    """A traceback."""
    assert "there is no folder" in ring.told(tmp_path / "none")
    assert "there is no transforms.json in " in ring.told(tmp_path)
    (tmp_path / "transforms.json").write_text("{")
    assert "transforms.json is no JSON: " in ring.told(tmp_path)
