"""From a folder of pictures to a mesh: the whole command, and how good it says the mesh is."""
import numpy as np
import pytest
import ring_captures as ring
import trimesh
from PIL import Image

from apps.reconstruct import captures, command, views
from course import commands
from course.given import image
from course.given.whose import Labs
from course.scenes import photographs, reconstruct, viewing
from labkit import places
from reference import multi_view_fit, reconstruction

LABS = Labs("reference")
EVEN = np.eye(9)[:, :1] * np.ones(3) / reconstruction.C0


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Nine pictures, 32 x 32, of a ball in many colours, and their cameras."""
    path, x = tmp_path_factory.mktemp("a") / "a ball", multi_view_fit.start(8)
    path.mkdir()
    ball = multi_view_fit.surface(x)
    sides = viewing.directions(np.linspace(0, 1, 9, endpoint=False), np.linspace(0.3, 0.7, 9))
    colours = photographs.Painted(ball.vertices, ball.faces, 0.5 + 0.4 * np.sin(9 * ball.vertices))
    seen = photographs.photographs(LABS, colours, EVEN, viewing.cameras_at(LABS, sides), 32)
    for k, picture in enumerate(seen):
        alpha = picture[..., 3:]
        plain = (picture[..., :3] - 1 + alpha) / np.maximum(alpha, 1e-6)
        image.write(path / f"{k}.png", np.dstack([image.to_srgb(np.clip(plain, 0, 1)), alpha]))
    poses = [np.linalg.inv(LABS.transforms.look_at(3 * side, np.zeros(3), viewing.UP))
             for side in sides]
    return ring.nerf(path, camera_angle_x=np.radians(40), frames=ring.frames(poses))


def few_stages(labs, _):
    stage = labs.multi_view_fit.Stage
    return stage(8, 1, 1, 20, 1.0), stage(12, 1, 1, 20, 0.5)


def test_the_command_makes_a_mesh_and_says_how_good_it_is(folder, tmp_path, monkeypatch, capsys):
    """A step is left out, or the mesh of another folder is written over."""
    monkeypatch.setattr(reconstruct, "fine_stages", few_stages)
    monkeypatch.setattr(places, "OUT", str(tmp_path))
    assert commands.main(["reconstruct", str(folder), "--size", "32"]) == 0
    printed = capsys.readouterr().out
    assert "pieces 1, genus 0; " in printed and " dB on the object in 1 new views" in printed
    assert "7.png: " in printed
    made = tmp_path / "reconstruct" / "a_ball"
    assert {path.name for path in made.iterdir()} == {"a_ball.glb", "a_ball_views.png"}
    (found,) = trimesh.load(made / "a_ball.glb", process=False).geometry.values()
    assert np.abs(np.linalg.norm(found.vertices, axis=1) - 0.8).max() < 0.15
    assert Image.open(made / "a_ball_views.png").size[0] == 3 * 192


def test_every_eighth_picture_is_kept_out(folder, monkeypatch):
    """The mesh is judged by views that the search saw."""
    given = []

    def searched(labs, capture):
        given.append(capture)
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "searched", searched)
    with pytest.raises(KeyboardInterrupt):
        command.run(folder, 32)
    photos = captures.read(LABS, folder, 32)
    assert len(given[0].pictures) == len(given[0].cameras) == 8
    assert not (given[0].cameras == photos.cameras[7]).all((1, 2)).any()
    assert not any((picture == photos.pictures[7]).all() for picture in given[0].pictures)


@pytest.mark.parametrize(("loss", "outwards"), [(np.nan, 0), (0.1, 9)])
def test_a_search_that_came_to_nothing_says_so(folder, monkeypatch, loss, outwards):
    """An empty mesh, or nan, is written."""
    def fit(*_, begin):
        yield begin, 0.1
        yield begin._replace(distance=begin.distance + outwards), loss

    monkeypatch.setattr(multi_view_fit, "fit", fit)
    with pytest.raises(ValueError, match="came to nothing at step 2: are the cameras right"):
        command.run(folder, 32)


def test_the_numbers_are_right(tmp_path):
    """It flatters: the background counts. Or the worst views come last, or are left out."""
    rng = np.random.default_rng(0)
    pictures, renderings = rng.uniform(size=(2, 10, 6, 6, 4))
    pictures[:, :3, :, 3] = 0
    renderings = pictures + 0.05 * np.arange(1, 11)[:, None, None, None] * (renderings - pictures)
    seen = [views.View(f"{k}.png", *each)
            for k, each in enumerate(zip(pictures, renderings, strict=True))]
    squares = ((pictures - renderings)[..., :3]**2)[:, 3:].mean((1, 2, 3))
    assert views.psnr(seen) == pytest.approx(-10 * np.log10(squares.mean()))
    both, either = (op(pictures[4, ..., 3] >= 0.5, renderings[4, ..., 3] >= 0.5).sum()
                    for op in (np.logical_and, np.logical_or))
    assert views.iou(seen[4]) == pytest.approx(both / either)
    lines = views.write_sheet(seen, tmp_path / "sheet.png")
    assert len(lines) == views.SHOWN and lines[0].startswith("  9.png: ")
    assert [float(line.split()[1]) for line in lines] == [
        round(-10 * np.log10(each), 1) for each in np.sort(squares)[:1:-1]]
    sheet = image.read(tmp_path / "sheet.png")
    np.testing.assert_allclose(sheet[7 * 192:8 * 192:32, :192:32, :3], pictures[9, ..., :3],
                               atol=0.004)


def test_what_the_user_can_mend_is_told_in_a_line(tmp_path, capsys):
    """A traceback from deep inside."""
    (tmp_path / "transforms.json").write_text("{}")
    assert commands.main(["reconstruct", str(tmp_path)]) == 2
    assert capsys.readouterr().err.startswith("course: transforms.json must be ")
    for size in "31", "513", "many":
        with pytest.raises(SystemExit):
            commands.main(["reconstruct", "FOLDER", "--size", size])
        assert "give a whole number from 32 to 512" in capsys.readouterr().err
