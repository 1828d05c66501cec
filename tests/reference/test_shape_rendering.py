"""The reference's pictures of one object as distance, as volume and as mesh (lab 15)."""
import numpy as np
import pytest
from screen_scenes import camera

from course.scenes import representations
from reference import pipeline, shape_rendering, transforms

LIGHTING = shape_rendering.Lighting(np.array([-0.5, 0.8, 0.6]), np.array([0.8, 0.6, 0.4]))


def test_three_representations_are_one_object():
    """A picture is mirrored, shifted by half a pixel, or of another object."""
    from_above = camera([1.0, 2.2, 1.4], fov_y=np.radians(40), aspect=1.5)
    scene = representations.WHEEL, pipeline.View(from_above, 60, 40, np.full(3, 0.9)), LIGHTING
    traced, evaluations = shape_rendering.render_distance(*scene)
    meshed = shape_rendering.render_mesh(*scene, n=48)
    foggy = shape_rendering.render_volume(*scene, 1.5, 4.0, beta=0.004, count=160)
    assert traced.shape == meshed.shape == foggy.shape == (40, 60, 3)
    assert evaluations.min() >= 1
    # The mesh's outlines are blended, those of the rays are not.
    for other, mean, limit in (meshed, 0.016, 0.05), (foggy, 0.03, 0.05):
        difference = np.abs(traced - other).max(-1)
        assert difference.mean() < mean
        assert np.median(difference[evaluations > 8]) < limit
    assert np.abs(traced - traced[:, ::-1]).mean() > 0.03  # so that a mirrored one would be told
    assert np.abs(traced - traced[::-1]).mean() > 0.03


@pytest.mark.parametrize("sides", [(0, 0), (0, 4), (5, 0)])
def test_a_picture_may_be_without_pixels(sides):
    """Division by no pixels at all."""
    view = pipeline.View(transforms.perspective(1.0, 1.0, 0.1, 10.0), *sides, np.zeros(3))
    scene = representations.WHEEL, view, LIGHTING
    shape = (*sides[::-1], 3)
    assert shape_rendering.render_distance(*scene)[0].shape == shape
    assert shape_rendering.render_volume(*scene, 1.5, 4.0).shape == shape
    assert shape_rendering.render_mesh(*scene, n=8).shape == shape
