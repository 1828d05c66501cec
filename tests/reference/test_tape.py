"""The tape beside what was joined by hand."""
import numpy as np
import pytest

from course.given import mesh
from reference import inverse_rendering, pipeline, tape, transforms

RNG = np.random.default_rng(0)
VERTICES, FACES = mesh.torus(300)
UV, IMAGE = RNG.random((len(VERTICES), 2)), RNG.random((8, 16, 2))


@pytest.mark.parametrize("material", [pipeline.Colours(UV), pipeline.Texture(UV, FACES, IMAGE)])
def test_the_tape_joins_labs_as_the_pipeline_does(material):
    """A way back is lost: a value stands where a Var should be. Or another picture is drawn."""
    camera = transforms.perspective(0.9, 1.3, 0.1, 9.0) @ transforms.look_at(
        np.array([0.4, 2.0, 2.5]), np.zeros(3), np.array([0.1, 1.0, 0.0]))
    scene = (pipeline.make_mesh(VERTICES, FACES), material,
             pipeline.View(camera, 26, 20, np.array([0.3, -0.2])))
    picture, buffers = pipeline.render(*scene)
    grad = RNG.normal(size=picture.shape)
    expected = pipeline.render_backward(grad, buffers, *scene)
    again, found = tape.render_and_back(*scene, grad)
    np.testing.assert_array_equal(again, picture)
    for got, wanted in zip((found[0], *found[1], found[2]),
                           (expected[0], *expected[1], expected[2]), strict=True):
        assert wanted is got is None or np.abs(got - wanted).max() < 1e-13 * np.abs(wanted).max()


def test_a_rotation_s_gradient_is_the_one_derived_by_hand():
    """It is no arithmetic of Vars alone: a number is taken out of q."""
    q, grad = RNG.normal(size=4), RNG.normal(size=(4, 4))
    var = tape.Var(tape.Tape([], []), q)
    R = tape.rotation(var)
    np.testing.assert_allclose(R.value, inverse_rendering.quaternion_matrix(q)[:3, :3])
    np.testing.assert_allclose(*tape.gradients(R, [var], grad[:3, :3]),
                               inverse_rendering.quaternion_matrix_backward(grad, q))
