"""How sure an albedo is, and whether the light turns with the camera."""
import numpy as np
import pytest

from course.given import mesh
from course.given.whose import Labs
from course.scenes import drawing, reconstruct, viewing
from reference import ambiguity, intrinsic_decomposition, multi_view_fit, reconstruction

LABS = Labs("reference")
SIDE = np.array([[0.6, 0.64, 0.48]])


def ball(stripes=0.0):
    """A Surface: a ball, and on it stripes of darker paint."""
    vertices, faces = mesh.icosphere(1280)
    vertices = 0.8 * vertices
    paint = 0.6 - stripes * (np.sin(9 * vertices[:, :1]) > 0)
    return multi_view_fit.Surface(vertices, faces, None, mesh.vertex_normals(vertices, faces),
                                  np.tile(paint, (1, 3)))


def targets_of(surface, turns, count=8):
    """Targets of a Surface in a lamp that stays, or turns with the camera."""
    cameras, pictures = viewing.cameras_around(LABS, count), []
    for camera in cameras:
        axes = camera[[0, 1, 3], :3] / np.linalg.norm(camera[[0, 1, 3], :3], axis=1, keepdims=True)
        light = reconstruction.distant_light(SIDE @ axes * [1, 1, 1] if turns else SIDE,
                                             np.full((1, 3), 0.7))
        light[0] += 0.3 / reconstruction.C0
        painted = reconstruct.Painted(surface.vertices, surface.faces, surface.albedo)
        pictures += list(reconstruct.photographs(LABS, painted, light, [camera], 48))
    capture = multi_view_fit.Capture(pictures, cameras, drawing.WHITE)
    return multi_view_fit.targets_of(capture, 1, 1)


@pytest.mark.parametrize("stripes", [0.0, 0.4])
def test_a_light_that_turns_with_the_camera_is_told_from_one_that_stays(stripes):
    """A turntable is taken for a light that stays; or stripes are taken for a light that turns."""
    surface = ball(stripes)
    for turns in (False, True):
        targets = targets_of(surface, turns)
        colours, _ = intrinsic_decomposition.seen_colours(surface, targets)
        found = ambiguity.turning(surface, targets, colours)
        assert (found > 0.1) == turns  # the limit of apps/reconstruct


def test_only_explanations_that_fit_as_well_make_the_albedo_unsure(monkeypatch):
    """Any lamp counts, or none does."""
    surface = ball()
    targets = targets_of(surface, False)
    look = intrinsic_decomposition.decompose(surface, targets, steps=200)
    doubts = []
    for limit in (1.0, ambiguity.AS_WELL, np.inf):
        monkeypatch.setattr(ambiguity, "AS_WELL", limit)
        doubts.append(ambiguity.doubt(surface, targets, look))
    assert doubts[0] <= doubts[1] < doubts[2] < 0.5


def test_change_is_of_the_albedo_and_not_of_its_factor(rng):
    """Twice the albedo in half the light counts as another explanation."""
    best = rng.uniform(0.2, 0.8, (50, 3))
    share = np.full(50, 1 / 50)
    assert ambiguity.change(2 * best, best, share) == pytest.approx(0, abs=1e-12)
    other = best.copy()
    other[:25] *= 1.2
    assert 0.05 < ambiguity.change(other, best, share) < 0.1
    assert ambiguity.change(0 * best, best, share) == pytest.approx(1)  # no factor makes it best
