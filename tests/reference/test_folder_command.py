"""From a folder of pictures to a mesh and a report: the whole command, its options, and Ctrl-C."""
import subprocess
import sys

import numpy as np
import pytest
import ring_captures as ring
from found_objects import LABS, found_of

from course import cli
from course.experiments.folder import captures, checkpoints, command, fit_report, searches
from course.experiments.scenes import viewing
from course.given import image, places
from reference import multi_view_fit


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Nine pictures, 32 x 32, of a grey ball, and their cameras."""
    path, x = tmp_path_factory.mktemp("ball"), multi_view_fit.start(8)
    sides = viewing.directions(np.linspace(0, 1, 9, endpoint=False), np.linspace(0.3, 0.7, 9))
    clip_from_view = LABS.transforms.perspective(np.radians(40), 1.0, 0.5, 10.0)
    poses = []
    for k, side in enumerate(sides):
        view = LABS.transforms.look_at(3 * side, np.zeros(3), np.array([0.0, 1.0, 0.0]))
        found = found_of(x)
        (picture,) = fit_report.rendered(LABS, found.surface, found.colours[:, :3],
                                         [clip_from_view @ view], np.zeros(3), (32, 32))
        image.write(path / f"{k}.png", fit_report.clear(picture))
        poses.append(np.linalg.inv(view))
    return ring.ours(path, fov_y=40.0, radius=1.0, background=[255, 255, 255],
                     views=ring.views(poses))


@pytest.fixture(scope="module")
def photos(folder):
    return captures.read(LABS, folder, 32)


BAR = searches.bar("ball", 6)
STAGES = multi_view_fit.Stage(4, 2, 1, 3, 1.0), multi_view_fit.Stage(6, 1, 1, 3, 0.5)


def stop_after(monkeypatch, count):
    """searches.watched, stopped by Ctrl-C after so many steps."""
    watched = searches.watched

    def stopped(*given):
        for step, found in enumerate(watched(*given), 1):
            yield found
            if step == count:
                raise KeyboardInterrupt

    monkeypatch.setattr(searches, "watched", stopped)


@pytest.mark.parametrize("count", [2, 3, 4])
def test_a_search_goes_on_from_where_it_was_stopped(photos, tmp_path, monkeypatch, count):
    """Steps are lost or taken twice, or the next stage begins from a ball. Adam's averages are not
    kept, so later steps differ from those of a search in one go.
    """
    whole = command.search(LABS, photos, tmp_path / "whole.glb", STAGES, False, BAR)
    path = tmp_path / "part.glb"
    with monkeypatch.context() as patch:
        stop_after(patch, count)
        with pytest.raises(KeyboardInterrupt, match="--resume goes on"):
            command.search(LABS, photos, path, STAGES, False, BAR)
    assert path.exists()
    marked = checkpoints.identity_of(photos, STAGES)
    kept = checkpoints.read(tmp_path / "checkpoint.npz", marked, multi_view_fit.Scene)
    assert kept.losses == whole.losses[:count]
    found = command.search(LABS, photos, path, STAGES, True, BAR)
    assert len(found.losses) == BAR.tasks[0].completed == 6
    assert found.losses[:count] == kept.losses and found.seconds > kept.seconds > 0
    assert multi_view_fit.cells(found.x) == 6
    assert found.losses[count] == whole.losses[count]  # the same surface, seen by the same views


def test_another_search_is_not_gone_on_with(photos, tmp_path):
    """The mesh of one folder goes on with the pictures of another."""
    path, scene = tmp_path / "checkpoint.npz", multi_view_fit.Scene
    marked = checkpoints.identity_of(photos, STAGES)
    with pytest.raises(ValueError, match="nothing to go on from: there is no "):
        checkpoints.read(path, marked, scene)
    checkpoints.write(path, checkpoints.Kept(multi_view_fit.start(4), (0.5,), 1.0), marked)
    assert checkpoints.read(path, marked, scene).losses == (0.5,)
    brighter = photos._replace(pictures=[1.01 * picture for picture in photos.pictures])
    with pytest.raises(ValueError, match="had other pictures or cameras"):
        checkpoints.read(path, checkpoints.identity_of(brighter, STAGES), scene)
    with pytest.raises(ValueError, match="had --steps 6 --size 32: give these"):
        checkpoints.read(path, checkpoints.identity_of(photos, command.scaled(STAGES, 8)), scene)
    path.write_bytes(path.read_bytes()[:99])
    with pytest.raises(ValueError, match="is broken: start again"):
        checkpoints.read(path, marked, scene)


def test_steps_are_shared_out_among_the_stages():
    """A stage without a step, or another sum than was asked for."""
    stages = searches.fine_stages(LABS)
    for steps in (3, 4, 7, 30, 299, 300, 1000):
        found = [stage.steps for stage in command.scaled(stages, steps)]
        assert sum(found) == steps and min(found) >= 1
    assert command.scaled(stages, 300) == stages
    assert [stage.steps for stage in command.scaled(stages, 30)] == [10, 8, 12]


def test_every_eighth_picture_is_kept_out(photos, tmp_path, monkeypatch):
    """The report judges by views that the search saw."""
    given = []

    def fit(capture, stages, **_):
        given.append(capture)
        yield multi_view_fit.start(4), 0.5

    monkeypatch.setattr(multi_view_fit, "fit", fit)
    list(command.steps(LABS, photos, tmp_path / "x.glb", STAGES, checkpoints.Kept(), BAR))
    assert len(given[0].pictures) == len(given[0].cameras) == 8
    assert all(picture is not photos.pictures[7] for picture in given[0].pictures)
    assert not (given[0].cameras == photos.cameras[7]).all((1, 2)).any()


@pytest.mark.parametrize("option", ["--size 31", "--size 513", "--steps 2", "--steps many"])
def test_options_out_of_range_are_told_in_a_line(option, capsys):
    """A traceback from deep inside."""
    with pytest.raises(SystemExit):
        cli.main(["demo", "reconstruct", "FOLDER", *option.split()])
    assert "give a whole number from" in capsys.readouterr().err


@pytest.mark.parametrize("line", ["demo bunny --size 64", "demo --steps 9", "demo ring --resume"])
def test_the_options_are_only_for_a_folder(line, capsys):
    """An option is ignored, and nobody is told."""
    assert cli.main(line.split()) == 2
    assert "are only for: reconstruct FOLDER" in capsys.readouterr().err


COARSE = (8, 1, 1, 100, 1.0), (12, 1, 1, 80, 0.5), (16, 1, 2, 120, 0.3)
STOPPED = """
import os, signal, sys
from course import cli
from course.experiments.folder import searches
from course.given import places
from reference import multi_view_fit

def fit(*given, after, whole=multi_view_fit.fit):
    for step, found in enumerate(whole(*given, after=after)):
        if step == 25:
            os.kill(os.getpid(), signal.SIGINT)
        yield found

signal.signal(signal.SIGINT, signal.default_int_handler)
multi_view_fit.fit, places.OUT = fit, {out!r}
searches.fine_stages = lambda *_: [multi_view_fit.Stage(*stage) for stage in {stages}]
sys.exit(cli.main(sys.argv[1:]))
"""


def test_ctrl_c_and_resume_of_the_whole_command(folder, tmp_path, monkeypatch, capsys):
    """Ctrl-C loses the work, or --resume does not come to its end."""
    command = ["demo", "reconstruct", str(folder), "--steps", "40", "--size", "32"]
    stopped = STOPPED.format(stages=COARSE, out=str(tmp_path))
    first = subprocess.run([sys.executable, "-c", stopped, *command], cwd=places.ROOT,
                           stderr=subprocess.PIPE, text=True, timeout=200)
    assert first.returncode == 130, first.stderr
    assert "the same command with --resume goes on" in first.stderr
    made = tmp_path / "demo" / "reconstruct" / folder.name
    assert {path.name.replace(folder.name, "NAME") for path in made.iterdir()} == {
        "NAME.glb", "NAME.obj", "checkpoint.npz", "state.png"}
    assert (made / f"{folder.name}.glb").read_bytes()[:4] == b"glTF"

    stages = [LABS.multi_view_fit.Stage(*stage) for stage in COARSE]
    monkeypatch.setattr(searches, "fine_stages", lambda *_: stages)
    monkeypatch.setattr(places, "OUT", str(tmp_path))
    assert cli.main([*command, "--resume"]) == 0
    assert "report.html" in capsys.readouterr().out
    assert {path.name.replace(folder.name, "NAME") for path in made.iterdir()} == {
        "NAME.glb", "NAME.obj", "NAME.mtl", "NAME.png", "report.html", "turntable.png",
        "state.png"}
    assert "<td>40</td>" in (made / "report.html").read_text()
