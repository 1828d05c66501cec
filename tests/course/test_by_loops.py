"""The way by loops alone is the pipeline's way."""
import numpy as np

from course.given.whose import Labs
from course.scenes import by_loops, viewing
from labkit.checks import assert_close
from reference import pipeline


def test_picture_and_gradient_are_the_pipeline__s(rng):
    """The scene leaves the pipeline's way: a background not filled, a gradient of w lost."""
    labs, size = Labs("reference"), by_loops.SIZE
    camera = viewing.clip_from_world(labs, by_loops.EYE)
    clip, colours = by_loops.parts(labs, camera, by_loops.moved(rng))
    colours = rng.random(colours.shape)
    picture, seen = by_loops.drawn(labs, clip, colours)
    mesh = pipeline.make_mesh(by_loops.POSITIONS, by_loops.FACES)
    expected, buffers = pipeline.draw(clip, mesh.faces, mesh.opposite, pipeline.Colours(colours),
                                      size, size, by_loops.GREY)
    assert len(np.unique(seen.face_index)) > 2
    assert_close(picture, expected)

    grad_picture = rng.normal(size=picture.shape)
    grad_colours, grad_clip = by_loops.drawn_backward(labs, grad_picture, seen, colours)
    material, expected = pipeline.draw_backward(grad_picture, buffers, mesh.faces,
                                                pipeline.Colours(colours))
    assert_close(grad_colours, material.colours, atol=1e-9)
    assert_close(grad_clip, expected, atol=1e-9)
