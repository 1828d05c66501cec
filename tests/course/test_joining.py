"""The exercises that join the labs: blocked by what is missing, and never gone round."""
import re

import numpy as np

from labkit import exercises
from labkit.lab_text import skeleton
from reference import pipeline


def test_a_missing_lab_blocks_what_joins_it(tmp_path, run_module, pytestconfig):
    """The board says that `draw` is wrong, where an exercise of lab 8 is not written yet."""
    for topic in exercises.topics():
        text = exercises.read(exercises.reference(topic))
        text = skeleton(text) if topic == "antialiasing" else text
        (tmp_path / f"{topic}.py").write_bytes(text.encode("utf-8"))
    done = run_module(pytestconfig.rootpath, "course", "check", "pipeline", "--impl", tmp_path)
    assert dict(re.findall(r"^ +(9\.\d+) .*  (\S.*?) *$", done.stdout, re.MULTILINE)) == {
        "9.2": "blocked by 8.2", "9.3": "blocked by 8.11"}


MESH = pipeline.make_mesh(np.eye(3), np.array([[0, 1, 2]]))
SCENE = MESH, pipeline.Colours(np.eye(3)), pipeline.View(np.eye(4), 4, 3, np.zeros(3))


def test_buffers_and_gradients_have_names_whatever_was_returned(monkeypatch):
    """Plain tuples pass the checks of draw and its backward pass, and no fit runs on them."""
    expected, buffers = pipeline.render(*SCENE)
    gradients = pipeline.render_backward(expected, buffers, *SCENE)
    backward = pipeline.draw_backward

    def plain(*given):
        grad_material, grad_clip = backward(*given)
        return tuple(grad_material), grad_clip

    monkeypatch.setattr(pipeline, "draw", lambda *_: (expected, tuple(buffers)))
    monkeypatch.setattr(pipeline, "draw_backward", plain)
    picture, named = pipeline.render(*SCENE)
    got = pipeline.render_backward(picture, named, *SCENE)
    # Not equal: where numba is installed, kernels sum in another order.
    np.testing.assert_allclose(got.material.colours, gradients.material.colours, rtol=1e-12)
    assert got.clip_from_model.any()
