"""From a folder of pictures to a mesh and a report: the whole command, its options, and Ctrl-C."""
import json
import os
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from found_objects import found_of

from course import cli
from course.experiments.folder import captures, checkpoints, command, fit_report, searches
from course.experiments.scenes import demo, drawing
from course.given import image, places
from reference import multi_view_fit

LABS = demo.Labs("reference")


@pytest.fixture
def folder(tmp_path):
    """Nine pictures, 32 x 32, of a grey ball, and their cameras."""
    x = multi_view_fit.start(8)
    sides = drawing.directions(np.linspace(0, 1, 9, endpoint=False), np.linspace(0.3, 0.7, 9))
    clip_from_view = LABS.transforms.perspective(np.radians(40), 1.0, 0.5, 10.0)
    views = []
    for k, side in enumerate(sides):
        view = LABS.transforms.look_at(3 * side, np.zeros(3), np.array([0.0, 1.0, 0.0]))
        (picture,) = fit_report.rendered(LABS, found_of(x), [clip_from_view @ view], np.zeros(3),
                                         (32, 32))
        image.write(tmp_path / f"{k}.png", fit_report.clear(picture))
        views.append({"picture": f"{k}.png", "world_from_camera": np.linalg.inv(view).tolist()})
    scene = {"fov_y": 40.0, "radius": 1.0, "background": [255, 255, 255], "views": views}
    (tmp_path / "cameras.json").write_text(json.dumps(scene))
    return tmp_path


@pytest.fixture
def photos(folder):
    return captures.read(LABS, folder, 32)


STAGES = (4, 2, 1, 3, 1.0), (6, 1, 1, 3, 0.5)


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
    whole = command.search(LABS, photos, tmp_path / "whole.glb", STAGES, False)
    path = tmp_path / "part.glb"
    with monkeypatch.context() as patch:
        stop_after(patch, count)
        with pytest.raises(KeyboardInterrupt, match="--resume goes on"):
            command.search(LABS, photos, path, STAGES, False)
    assert path.exists()
    marked = checkpoints.identity_of(photos, STAGES)
    kept = checkpoints.read(tmp_path / "checkpoint.npz", marked, multi_view_fit.Scene)
    assert kept.losses == whole.losses[:count]
    found = command.search(LABS, photos, path, STAGES, True)
    assert len(found.losses) == 6 and found.losses[:count] == kept.losses
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
    for steps in (3, 4, 7, 30, 299, 300, 1000):
        found = command.scaled(searches.FINE_STAGES, steps)
        assert sum(stage[3] for stage in found) == steps and min(s[3] for s in found) >= 1
    assert command.scaled(searches.FINE_STAGES, 300) == searches.FINE_STAGES
    assert [stage[3] for stage in command.scaled(searches.FINE_STAGES, 30)] == [10, 8, 12]


def test_every_eighth_picture_is_kept_out(photos, tmp_path, monkeypatch):
    """The report judges by views that the search saw."""
    given = []

    def fit(capture, stages, **_):
        given.append(capture)
        yield multi_view_fit.start(4), 0.5

    monkeypatch.setattr(multi_view_fit, "fit", fit)
    list(command.steps(LABS, photos, tmp_path / "x.glb", STAGES, checkpoints.Kept()))
    assert len(given[0].pictures) == len(given[0].cameras) == 8
    assert all(picture is not photos.pictures[7] for picture in given[0].pictures)
    assert not (given[0].cameras == photos.cameras[7]).all((1, 2)).any()


@pytest.mark.parametrize("line", [
    "demo reconstruct FOLDER --size 31", "demo reconstruct FOLDER --size 513",
    "demo reconstruct FOLDER --steps 2", "demo reconstruct FOLDER --steps many"])
def test_options_out_of_range_are_told_in_a_line(line, capsys):
    """A traceback from deep inside."""
    with pytest.raises(SystemExit):
        cli.main(line.split())
    assert "give a whole number from" in capsys.readouterr().err


@pytest.mark.parametrize("line", ["demo bunny --size 64", "demo --steps 9", "demo ring --resume"])
def test_the_options_are_only_for_a_folder(line, capsys):
    """An option is ignored, and nobody is told."""
    assert cli.main(line.split()) == 2
    assert "are only for: reconstruct FOLDER" in capsys.readouterr().err


def test_ctrl_c_and_resume_in_a_process_of_its_own(folder):
    """Ctrl-C loses the work, or --resume does not come to its end."""
    made = places.out("demo", "reconstruct", folder.name, "x").parent
    command = [sys.executable, "-m", "course", "demo", "reconstruct", str(folder), "--steps", "40",
               "--size", "32"]
    first = subprocess.Popen(
        command, cwd=places.ROOT, stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    try:
        until = time.monotonic() + 60
        while not (made / "state.png").exists() and time.monotonic() < until:
            time.sleep(0.05)
        os.kill(first.pid, signal.SIGINT)
        _, told = first.communicate(timeout=60)
        assert first.returncode == 130 and "the same command with --resume goes on" in told
        assert (made / f"{folder.name}.glb").read_bytes()[:4] == b"glTF"
        assert (made / "checkpoint.npz").exists() and not (made / "report.html").exists()
        second = subprocess.run([*command, "--resume"], cwd=places.ROOT, capture_output=True,
                                text=True, timeout=200)
        assert second.returncode == 0 and "report.html" in second.stdout, second.stderr
        names = {path.name.replace(folder.name, "NAME") for path in made.iterdir()}
        assert names == {"NAME.glb", "NAME.obj", "NAME.mtl", "NAME.png", "report.html",
                         "turntable.png", "state.png"}
        assert "<td>40</td>" in (made / "report.html").read_text()
    finally:
        first.kill()
        shutil.rmtree(made)
