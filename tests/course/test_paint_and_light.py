"""The captures that a path tracer made, and how a result is judged there."""
import numpy as np
import pytest

from course.given import image
from course.given.whose import Labs
from course.scenes import drawing, hull, paint_and_light, reconstruct

LABS = Labs("reference")


@pytest.mark.parametrize("name", paint_and_light.NAMES)
def test_a_capture_shows_its_object_from_all_sides(name):
    """Other cameras, or pictures that are upside down."""
    capture = paint_and_light.capture(LABS, name)
    assert len(capture.pictures) == 24
    found = LABS.multi_view_fit.surface(hull.start(LABS, capture, 24))
    truth = paint_and_light.unseen(name)
    for camera, coverage in zip(reconstruct.new_cameras(LABS), truth.coverage, strict=True):
        seen = drawing.seen_mask(LABS, found.vertices, found.faces, camera, len(coverage))
        assert image.intersection_over_union(seen > 0.5, coverage > 0.5) > 0.7  # it is shrunk


def test_albedo_is_judged_up_to_one_factor():
    """Each colour has a factor of its own, which hides a light of the wrong colour."""
    rng = np.random.default_rng(0)
    albedo, colours = rng.uniform(0.2, 0.6, (2, 8, 6, 6, 3))
    truth = paint_and_light.Unseen(albedo, colours, np.ones((8, 6, 6)))
    pictures = np.concatenate([colours, 0.5 * albedo], 3) + 1e-9
    assert paint_and_light.compared(pictures, truth)[0]["albedo"] > 100
    pictures[..., 3] *= 1.5
    numbers, _ = paint_and_light.compared(pictures, truth)
    assert numbers["albedo"] < 25 and numbers["views"] > 100


@pytest.mark.parametrize("name", ["duck", "rings"])
def test_paint_is_nearer_to_the_truth_once_it_is_told_from_light(name):
    """The light takes the paint's colour, or a shadow is taken for paint. The search is short."""
    stage = LABS.multi_view_fit.Stage(24, 2, 1, 60, 1.0)
    capture = paint_and_light.capture(LABS, name)
    x, surface = paint_and_light.found(LABS, capture, [stage])
    before, _ = paint_and_light.as_found(LABS, x, surface, name)
    look = LABS.intrinsic_decomposition.decompose(
        surface, LABS.multi_view_fit.targets_of(capture, 1, 1), steps=200)
    after, _ = paint_and_light.judged(LABS, surface, look, name)
    assert after["albedo"] > before["albedo"] + 2.5
    assert after["views"] > before["views"] + 2.5
