"""The vertices of a found mesh, moved to meet pictures: the gradients, the step, and the result."""
import numpy as np
import pytest
from found_objects import EVEN, ball, photographed, require_follows

from course.scenes import reconstruct
from reference import multi_view_fit, reconstruction, regularization, vertex_fit


def capture(count=12, size=32):
    """Pictures of a ball."""
    return photographed(reconstruct.Painted(*ball(0.7)), EVEN, count, size)


@pytest.mark.parametrize("which, h", [("vertices", 1e-8), ("colours", 1e-2)])
def test_gradients_follow_the_loss(which, h):
    """A way back is missing: through outlines, or through colours that move along."""
    vertices, faces, colours = ball(0.7)
    x = vertex_fit.Skin(1.03 * vertices, colours[::-1])
    views = multi_view_fit.targets_of(capture(2), 1, 2)
    direction = np.random.default_rng(1).normal(size=colours.shape)
    require_follows(lambda x: vertex_fit.loss_and_gradients(x, faces, views, 0.0),
                    x, which, direction, h)


def test_the_step_is_lab_13s_large_step():
    """One factorization for all steps, and another result. (A first step knows no constants.)"""
    vertices, faces, _ = ball(0.7)
    edges, nothing = reconstruction.closed_mesh_edges(faces), np.zeros(vertices.shape)
    gradient = np.random.default_rng(2).normal(size=vertices.shape)
    state = vertices, gradient, nothing, nothing, 1, 0.1
    found, *_ = vertex_fit.large_steps(edges, len(vertices))(*state)
    spread = edges, np.ones(len(edges)), 1.0
    np.testing.assert_allclose(found, regularization.large_step(*state, spread)[0], atol=1e-12)


def test_an_uneven_ball_becomes_the_ball_in_the_pictures():
    """Vertices that go astray, or stay. Measured: 0.0153 -> 0.0054, a twelfth of a pixel."""
    vertices, faces, _ = ball(0.7)
    uneven = (1.02 + 0.05 * np.sin(9 * vertices).prod(1, keepdims=True)) * vertices
    surface = multi_view_fit.Surface(uneven, faces, None, None, None)

    def off(vertices):
        return np.abs(np.linalg.norm(vertices, axis=1) - 0.7).mean()

    *_, (found, _) = vertex_fit.fit_vertices(surface, capture(), steps=40)
    assert off(found.vertices) < off(uneven) / 2.5
    assert (found.normals * found.vertices).sum(1).min() > 0
