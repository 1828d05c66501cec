"""What lab 16's search is given: folders of pictures, in three formats."""
import numpy as np
import pytest
import ring_captures as ring

from course import cli
from course.experiments.folder import camera_files, captures, lenses
from course.given import image, mesh

BEND = 1.8, 0.0, 0.05, -0.08, 0.0, 0.0


@pytest.fixture
def folder(tmp_path):
    """Six pictures, 48 x 32 pixels, of a ring at (1, 2, 3), and their cameras, in cameras.json."""
    return ring.ours(ring.photograph(tmp_path), centre=[1, 2, 3], radius=0.8)


def test_a_folder_on_paper(folder):
    """The ball's centre is not the grid's, or the aspect is turned over."""
    photos = captures.read(ring.LABS, folder)
    assert photos.names == [f"{k}.png" for k in range(6)]
    assert [picture.shape for picture in photos.pictures] == [(32, 48, 4)] * 6
    assert (photos.background == 1).all() and photos.assumed == []
    np.testing.assert_allclose(photos.world_from_grid @ [0, 0.5, 0, 1], [1, 2.4, 3, 1])
    clip = photos.cameras[0] @ [0.5, -1.0, 0.0, 1.0]  # 0.4 right, 0.8 down, 4 away
    high = 4 * np.tan(np.radians(15))
    np.testing.assert_allclose(clip[:2] / clip[3], [0.4 / (1.5 * high), -0.8 / high])
    assert abs(clip[2]) < clip[3]
    outside = photos.pictures[0][..., 3] == 0
    np.testing.assert_allclose(photos.pictures[0][outside][:, :3], 1)
    np.testing.assert_allclose(photos.pictures[0][~outside][:, :3], image.to_linear(128 / 255),
                               atol=1e-6)


def test_three_formats_of_one_capture_give_the_same_cameras(tmp_path):
    """An axis, the quaternion's order or the inverse is another in one of them."""
    folders = [write(ring.photograph(tmp_path / write.__name__))
               for write in (ring.ours, ring.nerf, ring.colmap)]
    found = [captures.read(ring.LABS, folder) for folder in folders]
    for photos in found[1:]:
        assert photos.names == found[0].names
        np.testing.assert_allclose(photos.cameras, found[0].cameras, atol=1e-6)
        np.testing.assert_allclose(photos.world_from_grid, found[0].world_from_grid, atol=1e-6)
        np.testing.assert_array_equal(photos.pictures, found[0].pictures)


def test_a_camera_sees_the_object_where_its_picture_shows_it(tmp_path):
    """The silhouette is upside down or mirrored beside the camera, or the principal point is not
    where it is said to be.
    """
    pictures = [ring.picture(k, left=3.0, down=-2.0) for k in range(6)]
    ring.photograph(tmp_path, pictures)
    # The middle of the picture is 3 pixels right of the principal point, and 2 below it.
    ring.colmap(tmp_path, f"1 PINHOLE 48 32 {ring.F} {ring.F} {24 - 3} {16 - 2}")
    photos = captures.read(ring.LABS, tmp_path)
    clip = photos.cameras[1] @ np.linalg.inv(photos.world_from_grid) @ [1, 2, 3, 1]
    np.testing.assert_allclose(clip[:2] / clip[3], [2 * 21 / 48 - 1, 1 - 2 * 14 / 32], atol=1e-9)
    require_same_silhouettes(photos)


def test_pictures_of_two_sizes_come_out_as_one_with_the_same_rays(tmp_path):
    """A frame of background moves the picture, but not its camera, or stretches it."""
    sizes = [(48, 32), (48, 23), (48, 32), (40, 40), (96, 48), (45, 32)]
    ring.photograph(tmp_path, [ring.picture(k, *size) for k, size in enumerate(sizes)])
    photos = captures.read(ring.LABS, ring.ours(tmp_path, centre=[1, 2, 3], radius=0.8), 48)
    assert {picture.shape for picture in photos.pictures} == {(40, 48, 4)}
    # 40 x 40 pixels lie in the columns 4 to 44: 8 pixels are 0.4 of the half height 20.
    clip = photos.cameras[3] @ [0.0, 0.0, 0.0, 1.0]
    np.testing.assert_allclose(clip[:2], 0, atol=1e-9)
    tilted = np.linalg.inv(photos.world_from_grid) @ ring.POSES[3]
    right = photos.cameras[3] @ tilted @ [0.4 * np.tan(np.radians(15)), 0, -1, 1]
    np.testing.assert_allclose(right[:2] / right[3], [8 / 24, 0], atol=1e-9)
    right = photos.cameras[4] @ np.linalg.inv(photos.world_from_grid) @ ring.POSES[4] @ [
        np.tan(np.radians(15)), 0, -1, 1]  # 48 x 24 pixels: 12 right of the middle
    np.testing.assert_allclose(right[:2] / right[3], [12 / 24, 0], atol=1e-9)
    require_same_silhouettes(photos)


def test_a_lens_is_undone_in_pictures_and_masks(tmp_path):
    """A lens never comes to its picture, the mask stays bent, or mask_path is not read."""
    shot = camera_files.Shot("", None, 96, 64, 2 * ring.F, 2 * ring.F, 48, 32, np.eye(4), BEND)
    column, row = np.mgrid[:96, :64] + 0.5
    x, y = lenses.unbent(shot, np.array([column - 48, row - 32]) / shot.fx) * shot.fx
    frames = ring.frames(ring.POSES)
    for k, frame in enumerate(frames):
        seen = ring.picture(k, 192, 128)[127 - (2 * y + 64).astype(int), (2 * x + 96).astype(int)]
        image.write(tmp_path / f"{k}.png", np.random.default_rng(k).uniform(size=(64, 96, 3)))
        image.write(tmp_path / f"outline {k}.png", seen[..., 3].T[::-1])
        frame["mask_path"] = f"outline {k}.png"
    ring.nerf(tmp_path, frames=frames, **dict(zip(camera_files.BEND, BEND, strict=True)))
    photos = captures.read(ring.LABS, tmp_path, 48)
    require_same_silhouettes(photos)
    (tmp_path / "outline 3.png").unlink()
    assert "3.png has no mask outline 3.png: put it into " in ring.told(tmp_path)


def require_same_silhouettes(photos):
    """The ring, rendered by the cameras that were read, covers what its pictures cover."""
    grid_from_world = np.linalg.inv(photos.world_from_grid)
    vertices, faces = mesh.torus(400, 0.5, 0.25)
    for camera, picture in zip(photos.cameras, photos.pictures, strict=True):
        height, width, _ = picture.shape
        clip = ring.LABS.pipeline.to_clip(vertices + ring.CENTRE, camera @ grid_from_world)
        seen = ring.LABS.scanline.rasterize(clip, faces, width, height)[0] >= 0
        assert ((picture[..., 3] > 0.5) != seen).sum() < 0.07 * seen.sum()


def test_a_ball_behind_a_camera_is_told():
    """A camera gets planes that are both behind it."""
    shot = camera_files.Shot("a.png", None, 8, 8, 10.0, 10.0, 4.0, 4.0, np.eye(4))
    with pytest.raises(ValueError, match=r"the camera of a.png has the ball .* behind it"):
        captures.camera(ring.LABS, shot, np.array([0.0, 0.0, 3.0]), 1.0)


def test_the_longer_side_is_chosen(folder):
    """`longest` is the shorter one's, or nobody's."""
    photos = captures.read(ring.LABS, folder, longest=24)
    assert {picture.shape for picture in photos.pictures} == {(16, 24, 4)}


def test_a_search_reads_its_capture_from_photos(folder):
    """Photos that lab 16's `fit` cannot take: of other sizes, or cameras of another space."""
    photos = captures.read(ring.LABS, folder)
    lab = ring.LABS.multi_view_fit
    capture = captures.capture_of(ring.LABS, photos)
    losses = [loss for _, loss in lab.fit(capture, [lab.Stage(8, 2, 1, 12, 1.0)])]
    assert losses[-1] < 0.75 * losses[0]


@pytest.mark.parametrize(("changes", "sentence"), [
    ({"radius": 4.1}, "the camera of 0.png stands within the ball"),
    ({"centre": [1, 2, 30]}, "most pictures do not show the object in the ball that cameras.json")])
def test_a_ball_that_is_elsewhere_is_told_in_one_sentence(folder, changes, sentence):
    """A traceback, or a search that cannot find anything."""
    given = {"centre": [1, 2, 3], "radius": 0.8, **changes}
    assert sentence in ring.told(ring.ours(folder, **given))


def test_the_command_takes_a_folder(folder, capsys):
    """A folder's name is taken for a scene's, or a scene's for a folder's. Or a traceback."""
    (folder / "cameras.json").write_text("{}")
    assert cli.main(["demo", "reconstruct", str(folder)]) == 2
    assert capsys.readouterr().err.startswith("course: cameras.json must be ")
    assert cli.main(["demo", "reconstruct", str(folder / "none")]) == 2
    assert "there is no folder" in capsys.readouterr().err
    assert cli.main(["demo", "reconstruct", "bunny", "nonsense"]) == 2
    assert "there is no scene nonsense" in capsys.readouterr().err
