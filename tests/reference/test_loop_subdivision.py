"""What Loop's scheme composes: S of whole meshes, several steps, and limits."""
import numpy as np
import pytest
from triangle_meshes import MESHES

from course.given.gradcheck import gradcheck
from reference import loop_subdivision

WEIGHTS = loop_subdivision.warren_weight, loop_subdivision.loop_weight
each_weight = pytest.mark.parametrize("weight", WEIGHTS, ids=lambda weight: weight.__name__)
each_mesh = pytest.mark.parametrize("vertices, faces", MESHES.values(), ids=MESHES)


def test_the_two_weights_are_equal_at_valences_3_and_6_only():
    """Libraries are split between them. On regular meshes nobody sees it."""
    n = np.arange(3, 30)
    warren, loop = (weight(n) for weight in WEIGHTS)
    equal = np.isclose(warren, loop, rtol=1e-12)
    np.testing.assert_array_equal(n[equal], [3, 6])


# --- boundaries and limits -----------------------------------------------------------------------

@each_weight
@each_mesh
def test_a_step_does_not_change_loops_limit(vertices, faces, weight):
    """m of (6) is not that of u, or the boundary's limit is not that of its rule. A mesh moves when
    the origin does.
    """
    limit = loop_subdivision.loop_limit_matrix(faces, len(vertices), weight)
    np.testing.assert_allclose(limit.sum(1), 1, rtol=0, atol=1e-14)
    new, children = loop_subdivision.loop(vertices, faces, weight)
    after = loop_subdivision.loop_limit_matrix(children, len(new), weight) @ new
    np.testing.assert_allclose(after[:len(vertices)], limit @ vertices, rtol=0, atol=1e-14)


# --- gradients -----------------------------------------------------------------------------------

@each_weight
def test_loop_has_a_gradient(weight):
    """S for its transpose, or the other weight's."""
    gradcheck(lambda *given: loop_subdivision.loop(*given)[0], loop_subdivision.loop_backward,
              (*MESHES["band with a twist"], weight), name="loop")
