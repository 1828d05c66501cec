"""The tape beside what was joined by hand."""
import numpy as np
import pytest

from course.given import mesh
from course.given.whose import Labs
from course.scenes import taped
from reference import inverse_rendering, pipeline, tape, transforms

RNG = np.random.default_rng(0)
VERTICES, FACES = mesh.torus(300)
MATERIALS = (pipeline.Colours(RNG.random((len(VERTICES), 2))),
             pipeline.Texture(RNG.random((len(VERTICES), 2)), FACES, RNG.random((8, 16, 2))))


@pytest.mark.parametrize("material", MATERIALS, ids=["colours", "texture"])
def test_the_tape_joins_labs_as_the_pipeline_does(material):
    """A way back is lost: a value stands where a Var should be. Or another picture is drawn."""
    camera = transforms.perspective(0.9, 1.3, 0.1, 9.0) @ transforms.translate(
        np.array([0.2, -0.1, -3.0])) @ transforms.rotate(np.array([1.0, 0.3, 0.0]), 0.7)
    scene = (pipeline.make_mesh(VERTICES, FACES), material,
             pipeline.View(camera, 26, 20, np.array([0.3, -0.2])))
    picture, buffers = pipeline.render(*scene)
    grad = RNG.normal(size=picture.shape)
    expected = pipeline.render_backward(grad, buffers, *scene)
    again, found = tape.render_and_back(*scene, grad)
    np.testing.assert_array_equal(again, picture)
    pairs = [*zip(found.material, expected.material, strict=True),
             (found.positions, expected.positions), (found.clip_from_model, expected.clip_from_model)]
    for got, wanted in pairs:
        assert wanted is got is None or np.abs(got - wanted).max() < 1e-13 * np.abs(wanted).max()


def test_a_rotation_s_gradient_is_the_one_derived_by_hand():
    """It is no arithmetic of Vars alone: a number is taken out of q."""
    q, grad = RNG.normal(size=4), RNG.normal(size=(4, 4))
    var = tape.Var(tape.Tape([], []), q)
    R = tape.rotation(var)
    np.testing.assert_allclose(R.value, inverse_rendering.quaternion_matrix(q)[:3, :3])
    np.testing.assert_allclose(tape.gradients(R, [var], grad[:3, :3])[0],
                               inverse_rendering.quaternion_matrix_backward(grad, q))


def test_pose_zoom_and_light_are_found():
    """A number of the scene has a wrong gradient, or none."""
    labs = Labs("reference")
    goal, start = taped.example(labs, 5)
    *_, (found, _) = taped.fit(labs, goal, start, taped.STAGES[:1])
    assert taped.degrees_off(labs, found, goal) < 4 and abs(found.light - goal.light).max() < 0.03
