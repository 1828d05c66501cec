"""Surfaces that pass through each other: the picture, and what moves where they meet."""
import numpy as np
import pytest

from course.given import mesh
from reference import outline_walk, pipeline
from reference.pipeline import Colours, View

SIZE = 48
ORTHOGRAPHIC = np.diag([1.0, 1.0, -0.2, 1.0])


def ball_in_wall(radius, count):
    """A white ball, whose middle is 0.3 behind a black wall: what is seen of it is a disc, and its
    border is where both meet. -> positions, faces, colours, which vertices are the ball's
    """
    ball, faces = mesh.icosphere(count)
    wall = np.array([[-3.0, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0]])
    positions = np.concatenate([radius * ball - [0.013, 0.027, 0.3], wall])
    faces = np.concatenate([faces, len(ball) + np.array([[0, 1, 2], [0, 2, 3]])])
    is_ball = np.arange(len(positions))[:, None] < len(ball)
    return positions, faces, is_ball * 1.0, is_ball


@pytest.mark.parametrize("count", [1_500, 40_000])
def test_a_ball_in_a_wall_is_a_disc_that_grows_with_it(count):
    """Nothing is blended where they meet: stairs, and no gradient. Or twice of it, as rows and
    columns both see a line that leans."""
    radius = 0.8
    positions, faces, colours, is_ball = ball_in_wall(radius, count)
    shape, view = pipeline.make_mesh(positions, faces), View(ORTHOGRAPHIC, SIZE, SIZE, np.zeros(1))
    picture, buffers = pipeline.render(shape, Colours(colours), view)
    seen = pipeline.visible(buffers.clip, faces, 8 * SIZE, 8 * SIZE).face_index < len(faces) - 2
    exact = seen.reshape(SIZE, 8, SIZE, 8).mean((1, 3))  # 64 samples a pixel
    is_border = (0 < exact) & (exact < 1)
    assert np.std((picture[..., 0] - exact)[is_border]) < 0.05
    assert np.std((buffers.colour[..., 0] - exact)[is_border]) > 0.2  # of hard pictures
    grads = pipeline.render_backward(np.ones_like(picture), buffers, shape, Colours(colours), view)
    grown = (grads.positions * is_ball * (positions + [0.013, 0.027, 0.3]) / radius).sum()
    assert grown == pytest.approx(2 * np.pi * radius * (SIZE / 2)**2, rel=0.015)
    # The wall moves back, and the disc grows with the square of what is left of the ball.
    back = -(grads.positions * ~is_ball).sum(0)[2]
    assert back == pytest.approx(2 * np.pi * 0.3 * (SIZE / 2)**2, rel=0.015)
    assert len(outline_walk.walked_pairs(buffers.face_index, buffers.depth, buffers.clip, faces,
                                         shape.opposite).c) == 0
