"""Surfaces that pass through each other: the picture, and what moves where they meet."""
import numpy as np
import pytest
from screen_scenes import camera, drawn

from course.given import mesh
from reference import intersections, outline_walk, pipeline
from reference.pipeline import Colours, View

SIZE = 48
VIEW = View(camera((0.4, 0.3, 3.0)), SIZE, SIZE, np.array([0.1]))
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


def two_balls():
    """Two coloured balls that pass through each other, of faces that are smaller than pixels."""
    ball, faces = mesh.icosphere(5_000)
    positions = np.concatenate([0.6 * ball + [0.3, 0.1, 0.3], 0.8 * ball - [0.2, 0.1, 0.1]])
    colours = np.random.default_rng(0).uniform(size=(len(positions), 1))
    return pipeline.make_mesh(positions, np.concatenate([faces, faces + len(ball)])), colours


def test_the_gradient_where_fine_balls_meet_is_that_of_the_picture():
    """One of the four faces is left out, a sign is wrong, or the slope of a face is."""
    shape, colours = two_balls()
    _, buffers = pipeline.render(shape, Colours(colours), VIEW)
    met = intersections.meetings(buffers.pairs, buffers.clip)
    assert len(met.c) > 12
    rng, off = np.random.default_rng(1), []
    weight = np.zeros((SIZE * SIZE, 1))  # of pixels that blend where the balls meet
    weight[met.owner], weight[met.other] = rng.normal(size=(2, len(met.c), 1))
    weight = weight.reshape(SIZE, SIZE, 1)
    grads = pipeline.render_backward(weight, buffers, shape, Colours(colours), VIEW)
    for _ in range(9):
        way = 1e-7 * rng.normal(size=shape.positions.shape)
        ahead, behind = (pipeline.render(shape._replace(positions=x), Colours(colours), VIEW)[0]
                         for x in (shape.positions + way, shape.positions - way))
        off.append(((ahead - behind) * weight).sum() / 2 / (grads.positions * way).sum() - 1)
    assert np.abs(off).max() < 1e-5


def test_the_new_edges_lie_where_both_faces_are_equally_deep():
    """c is right, but the line leans to the other side, or by another amount."""
    one = np.array([[-9.0, -9, 0, 1], [9, -8, 0, 1], [0, 9, 0, 1]])
    faces, steep = np.arange(6).reshape(2, 3), 0
    for turn in np.arange(12) * np.pi / 6 + 0.1:
        slope = 0.02 * np.array([np.cos(turn), np.sin(turn)])
        two = one[::-1] * 1.0
        two[:, 2] = two[:, :2] @ slope + 0.005
        clip = np.concatenate([one, two])
        seen, _ = drawn(clip, faces, 12, 10)
        pairs = intersections.all_pairs(*seen)
        ends = intersections.points(pairs, (10, 12), clip, faces)[pairs.ends]
        np.testing.assert_allclose(ends[..., :2] @ slope, -0.005, rtol=0, atol=1e-12)
        steep += len(pairs.c)
    assert steep > 100
