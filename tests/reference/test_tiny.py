"""The whole idea on one page draws and differentiates as the pipeline does, without its walk."""
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib import image

from reference import antialiasing, outlines, pipeline, tiny

CAMERA = np.array([[3, 0, 0.2, 0.1], [0, 2.5, 0, -0.1], [0, 0, -1, 3], [0, 0, -1, 4.0]])


def lumps(steps=2):
    """A mesh that hides parts of itself, with two colours a vertex."""
    x, faces = tiny.ball(steps)
    rng = np.random.default_rng(1)
    return x * rng.uniform(0.5, 1.3, (len(x), 1)), rng.uniform(size=(len(x), 2)), faces


@pytest.mark.parametrize("size", [9, 40])
def test_pictures_and_gradients_are_the_pipelines(size):
    """One page of code that draws nearly the same, with nearly the gradient of a neighbour."""
    positions, colours, faces = lumps()
    scene = (pipeline.make_mesh(positions, faces), pipeline.Colours(colours),
             pipeline.View(CAMERA, size, size, np.zeros(2)))
    _, buffers = pipeline.render(*scene)
    seen = buffers.face_index, buffers.depth, buffers.clip, faces, scene[0].opposite
    pairs = outlines.blended_pairs(*seen)  # the page does not walk on
    picture, kept = tiny.render(positions, colours, faces, CAMERA, size)
    expected = antialiasing.blend_pairs(buffers.colour, pairs)
    np.testing.assert_allclose(picture, expected, rtol=0, atol=1e-14)
    assert sum(len(first) for first, *_ in kept[-1]) == len(pairs.c) > size

    upstream = np.random.default_rng(2).normal(size=picture.shape)
    gradients = pipeline.render_backward(upstream, buffers._replace(pairs=pairs), *scene)
    found = tiny.render_backward(upstream, kept, colours, CAMERA)
    # 6e-16 of the greatest is measured, 2e-14 at 48 x 48 pixels on another mesh.
    for gradient, other in zip(found, (gradients.positions, gradients.material.colours),
                               strict=True):
        np.testing.assert_allclose(gradient, other, rtol=0, atol=1e-13 * np.abs(other).max())


def test_a_face_that_is_seen_edge_on_ends_at_an_outline():
    """A cube seen straight on, without perspective, has no outline, and no gradient."""
    corners = np.array([*np.ndindex(2, 2, 2)]) - 0.5
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                      [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    camera, white = np.diag([1, 1, -0.5, 1]), np.ones((8, 1))
    picture, kept = tiny.render(corners, white, faces, camera, 10)  # 2.5 pixels to each side
    np.testing.assert_array_equal(picture[5, :, 0], [0, 0, 0.5, 1, 1, 1, 1, 0.5, 0, 0])
    grad_positions, _ = tiny.render_backward(np.ones(picture.shape), kept, white, camera)
    assert np.abs(grad_positions).max() > 1


def test_it_runs_as_its_first_lines_say(tmp_path, monkeypatch, capsys):
    """The derivative is another one than the difference, the descent climbs, nothing is drawn."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(tiny.descend, "__defaults__", (60,))
    tiny.main(64)
    derivative, losses = capsys.readouterr().out.splitlines()
    backward, difference = (float(part.split()[-1]) for part in derivative.split(",")[1:])
    assert backward == pytest.approx(difference, rel=1e-6) and backward > 1e-3
    before, after = map(float, losses.split()[-2:])
    assert after < 0.3 * before
    ball, found, star = np.split(image.imread("tiny.ppm") / 255, 3, axis=1)
    assert np.abs(found - star).mean() < 0.3 * np.abs(ball - star).mean()
    assert star[50, 128].any() and not star[-50, 128].any()  # it stands on two of its tips


def test_it_is_a_page_that_needs_numpy_alone():
    """It grows, or leans on what a reader would have to open as well."""
    text = Path(tiny.__file__).read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 230
    assert re.findall(r"^ *(?:import|from) .*", text, re.M) == ["import numpy as np"]
