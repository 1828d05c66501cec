"""What lab 16's search reads: folders of pictures."""
import json

import numpy as np
import pytest

from course import cli
from course.experiments import captures, demo, drawing
from course.given import image, mesh

LABS = demo.Labs("reference")


@pytest.fixture
def folder(tmp_path):
    """Two pictures, 24 x 16 pixels, of a ring at (1, 2, 3), and their cameras."""
    vertices, faces = mesh.torus(400, 0.5, 0.25)
    views = []
    for k, side in enumerate(([0.0, 0.0, 4.0], [4.0, 1.0, 0.0])):
        centre = np.array([1.0, 2.0, 3.0])
        view = LABS.transforms.look_at(centre + side, centre, np.array([0.0, 1.0, 0.0]))
        camera = LABS.transforms.perspective(np.radians(30), 1.5, 0.5, 10.0) @ view
        seen = drawing.seen_mask(LABS, vertices + centre, faces, camera, 24)[::1, :]
        picture = np.dstack([np.full((24, 24, 3), 0.5), seen])[4:20]
        image.write(tmp_path / f"{k}.png", picture)
        views.append({"picture": f"{k}.png", "world_from_camera": np.linalg.inv(view).tolist()})
    scene = {"fov_y": 30.0, "centre": [1, 2, 3], "radius": 0.8, "views": views}
    (tmp_path / "cameras.json").write_text(json.dumps(scene))
    return tmp_path


def changed(folder, **changes):
    scene = json.loads((folder / "cameras.json").read_text())
    (folder / "cameras.json").write_text(json.dumps({**scene, **changes}))
    return folder


def test_a_folder_on_paper(folder):
    """The ball's centre is not the grid's, or the aspect is turned over."""
    pictures, cameras, background, world_from_grid = captures.read(LABS, folder)
    assert [picture.shape for picture in pictures] == [(16, 24, 4)] * 2
    assert (background == 1).all()
    np.testing.assert_allclose(world_from_grid @ [0, 0.5, 0, 1], [1, 2.4, 3, 1])
    clip = cameras[0] @ [0.5, -1.0, 0.0, 1.0]  # 0.4 right, 0.8 down, 4 away
    high = 4 * np.tan(np.radians(15))
    np.testing.assert_allclose(clip[:2] / clip[3], [0.4 / (1.5 * high), -0.8 / high])
    assert abs(clip[2]) < clip[3]
    outside = pictures[0][..., 3] == 0
    np.testing.assert_allclose(pictures[0][outside][:, :3], 1)
    np.testing.assert_allclose(pictures[0][~outside][:, :3], image.to_linear(128 / 255))


def test_opaque_pictures_have_silhouettes_by_their_background(folder):
    """The background is taken for the object."""
    for k in 0, 1:
        picture = image.read(folder / f"{k}.png")
        image.write(folder / f"{k}.png", np.where(picture[..., 3:] > 0, picture[..., :3], 0.2))
    changed(folder, background=[51, 51, 51])
    pictures, _, background, _ = captures.read(LABS, folder)
    np.testing.assert_allclose(background, image.to_linear(0.2))
    grey = np.abs(pictures[0][..., :3] - background).max(2) > 0.01
    np.testing.assert_array_equal(pictures[0][..., 3] == 1, grey)


def test_large_pictures_are_made_smaller():
    """Pixels are dropped instead of averaged, or the shape changes."""
    picture = np.random.default_rng(0).uniform(size=(300, 512, 4))
    found = captures.smaller(picture)
    assert found.shape == (76, 128, 4)
    np.testing.assert_allclose(found.mean((0, 1)), picture.mean((0, 1)), atol=1e-3)


MATRIX = np.eye(4)
MATRIX[2, 3] = 5.0


def one_view(matrix):
    return [{"picture": "0.png", "world_from_camera": np.asarray(matrix).tolist()}] * 2


@pytest.mark.parametrize("changes, sentence", [
    ({"fov_y": "wide"}, "fov_y in cameras.json must be a finite number, and is wide"),
    ({"fov_y": 190}, "fov_y in cameras.json must be from 1 to 170, and is 190"),
    ({"radius": -1}, "radius in cameras.json must be from 1e-09 to 1e"),
    ({"centre": [1, 2]}, "centre in cameras.json must be 3 finite numbers"),
    ({"views": 7}, "cameras.json must be"),
    ({"views": []}, "at least 2 views are needed"),
    ({"views": [{}, {}]}, 'view 0 in cameras.json needs a "picture"'),
    ({"views": [{"picture": "0.png"}] * 2}, 'view 0 (0.png) in cameras.json needs a "world_from_'),
    ({"views": one_view(np.eye(3))}, "world_from_camera of 0.png in cameras.json must be 4 x 4"),
    ({"views": one_view(MATRIX.T)}, "must have 0, 0, 0, 1 as its last row"),
    ({"views": one_view(MATRIX * [2, 2, 2, 1])}, "must be a rotation and a shift"),
    ({"views": one_view(MATRIX * [-1, 1, 1, 1])}, "is mirrored"),
    ({"centre": [0, 0, 4.5], "views": one_view(MATRIX)}, "stands within the ball"),
    ({"centre": [0, 0, 9], "views": one_view(MATRIX)}, "does not see the object's centre"),
    ({"centre": [0, 3, 0], "views": one_view(MATRIX)}, "does not see the object's centre"),
    ({"fov_y": None}, "must be a finite number, and is missing"),
    ({"fov_y": True}, "must be a finite number, and is True"),
    ({"fov_y": 10**400}, "must be a finite number, and is 1000"),
    ({"background": [300, 0, 0]}, "three numbers from 0 to 255"),
    ({"views": [{"picture": "a\0.png", "world_from_camera": MATRIX.tolist()}] * 2},
     "no file can have such a name"),
    ({"views": [{"picture": "9.png", "world_from_camera": MATRIX.tolist()}] * 2}, "there is no"),
])
def test_what_is_wrong_with_cameras_is_told_in_one_sentence(folder, changes, sentence):
    """A traceback, or a search that cannot find anything."""
    with pytest.raises((ValueError, OSError)) as told:
        captures.read(LABS, changed(folder, **changes))
    assert sentence in str(told.value) and "\n" not in str(told.value)


@pytest.mark.parametrize("picture, sentence", [
    (np.ones((16, 24, 4)), "0.png shows no background"),
    (np.zeros((16, 24, 4)), "0.png shows no object"),
    (np.ones((16, 24, 3)), "0.png has no transparency: give the colour behind the object"),
    (np.eye(16)[..., None] * np.ones(4), "all pictures must have one size"),
])
def test_what_is_wrong_with_pictures_is_told_in_one_sentence(folder, picture, sentence):
    """A silhouette that is everything or nothing."""
    image.write(folder / "0.png", picture)
    with pytest.raises(ValueError, match=sentence):
        captures.read(LABS, folder)


def test_a_folder_without_cameras_and_a_broken_file(folder):
    """A traceback."""
    (folder / "cameras.json").write_text("{")
    with pytest.raises(ValueError, match=r"cameras.json is no JSON: "):
        captures.read(LABS, folder)
    (folder / "cameras.json").unlink()
    with pytest.raises(FileNotFoundError, match=r"there is no file .*cameras.json"):
        captures.read(LABS, folder)


def test_the_command_takes_a_folder(folder, capsys):
    """A folder's name is taken for a scene's, or a scene's for a folder's; or a traceback."""
    (folder / "cameras.json").write_text("{}")
    assert cli.main(["demo", "reconstruct", str(folder)]) == 2
    assert capsys.readouterr().err.startswith("course: cameras.json must be ")
    assert cli.main(["demo", "reconstruct", str(folder / "none")]) == 2
    assert "there is no file" in capsys.readouterr().err
    assert cli.main(["demo", "reconstruct", "bunny", "nonsense"]) == 2
    assert "there is no scene nonsense" in capsys.readouterr().err
