"""Albedo and light told apart: equations (10) to (13), their gradients, and what they find."""
import numpy as np
import pytest
from found_objects import EVEN, NO_SUN, ball, photographed, surface_of

from course.given import mesh
from course.given.gradcheck import gradcheck
from course.scenes import reconstruct
from reference import intrinsic_decomposition as lab
from reference import multi_view_fit, reconstruction


def looks(rng, count):
    """An Appearance of count vertices, in light of all colours and a sun."""
    light = rng.uniform(-0.2, 0.2, (9, 3))
    light[0] = 3.0, 2.5, 2.0
    return lab.Appearance(rng.uniform(0.1, 0.9, (count, 3)), light,
                          np.array([[0.48, 0.6, 0.64], [0.9, 0.7, 0.5]]), 0.3, 1.2)


def received(rng, count):
    """What a Surface of count vertices Received."""
    normals = mesh.unit(rng.normal(size=(count, 3)))
    surface = multi_view_fit.Surface(rng.uniform(-0.5, 0.5, (count, 3)), None, None, normals, None)
    return lab.Received(surface, *rng.uniform(0, 1, (2, count)), rng.uniform(0, 0.3, (count, 3)))


# --- eq. (10) ----------------------------------------------------------------------------------


def seen_ball(count=6, size=48):
    """A ball of soft colours, as pictures show it: the Surface, its colours (V, 3), its Targets."""
    vertices, faces, colours = ball(0.8)
    capture = photographed(reconstruct.Painted(vertices, faces, colours), EVEN, count, size)
    surface = surface_of(vertices, faces, np.full(vertices.shape, 0.5))
    return surface, colours, multi_view_fit.targets_of(capture, 1, 1)


def test_the_colours_that_pictures_show_are_found():
    """Pixels of the outline, which are half background, bleach the surface."""
    surface, colours, targets = seen_ball(12)
    found, count = lab.seen_colours(surface, targets)
    assert np.abs(found - colours)[count > 1].max() < 0.02
    assert count.sum() == pytest.approx(sum(lab.inner(target.picture).sum() for target in targets))


def test_what_no_pixel_sees_takes_the_colours_around():
    """A hole in the pictures is black, or the system has no solution."""
    surface, _, targets = seen_ball(1)
    found, count = lab.seen_colours(surface, targets)
    assert (count == 0).sum() > 300
    seen = found[count > 0]
    assert (found.min(0) > seen.min(0) - 1e-6).all() and (found.max(0) < seen.max(0) + 1e-6).all()


def test_a_piece_that_no_pixel_sees_is_black():
    """The system has no solution, and all colours are nan."""
    surface, _, targets = seen_ball(2)
    far = surface.vertices + [50.0, 0.0, 0.0]
    faces = np.vstack([surface.faces, surface.faces + len(far)])
    found, _ = lab.seen_colours(surface_of(np.vstack([surface.vertices, far]), faces), targets)
    expected = np.vstack([lab.seen_colours(surface, targets)[0], 0 * far])
    np.testing.assert_allclose(found, expected, atol=1e-6)


def test_an_object_of_outlines_alone_is_refused():
    """All colours become nan."""
    surface, _, targets = seen_ball(2, 3)
    with pytest.raises(ValueError, match="no pixel lies inside the object"):
        lab.decompose(surface, targets)


# --- eq. (11) ----------------------------------------------------------------------------------


def test_the_light_on_paper():
    """The sun shines from behind, the shadow takes other light along, or what is hidden shines."""
    normals = np.array([[0.0, 0.0, 1.0], [0.0, 0.6, 0.8], [0.0, 0.0, -1.0]])
    light = np.zeros((9, 3))
    light[0] = np.array([1.0, 2.0, 3.0]) / reconstruction.C0
    sun = np.array([[0.0, 0.0, 1.0], [10.0, 20.0, 30.0]])
    x = lab.Appearance(np.full((3, 3), 0.5), light, sun, 0.0, 2.0)
    surface = multi_view_fit.Surface(np.zeros((3, 3)), None, None, normals, None)
    bounce = np.array([[0.0, 0, 0], [0, 0, 0], [0.1, 0.2, 0.3]])
    found = lab.shade_with_sun(x, lab.Received(surface, np.array([1.0, 0.5, 1.0]),
                                               np.array([1.0, 1.0, 0.4]), bounce))
    np.testing.assert_allclose(found, [[5.5, 11, 16.5], [2.5, 5, 7.5], [0.3, 0.6, 0.9]])


def test_at_sunrise_a_lamp_is_found():
    """x, y and z are exchanged, or the light becomes brighter."""
    towards = np.array([[0.48, 0.6, 0.64]])
    light = reconstruction.distant_light(towards, np.full((1, 3), 2.0))
    x = lab.add_sun(lab.Appearance(np.ones((1, 3)), light, NO_SUN, 0.0, 1.0))
    np.testing.assert_allclose(x.sun, [towards[0], [1, 1, 1]])
    np.testing.assert_allclose(x.light, light / 2, atol=1e-12)


# --- eq. (12) and (13) -------------------------------------------------------------------------


def test_grey_light_costs_nothing_and_coloured_light_its_variance():
    """A light is pulled down, not to grey."""
    light = np.tile(np.arange(9.0)[:, None], (1, 3))
    sun = np.array([[0.0, 0.0, 1.0], [4.0, 4.0, 4.0]])
    assert lab.neutral(light, sun) == 0
    light[3] += [1.0, 0.0, -1.0]
    assert lab.neutral(light, sun) == pytest.approx(2)


def test_patches_cost_their_borders_and_not_their_number_of_steps():
    """One large step costs more than many small ones of the same sum, as squares do; or while the
    paint is sought, as much.
    """
    edges = np.stack([np.arange(100), np.arange(1, 101)], 1)
    step = np.where(np.arange(101) < 50, 0.1, 0.8)
    ramp = np.exp(np.linspace(np.log(0.2), np.log(0.9), 101)) - lab.DARK
    paint = [np.tile(part[:, None], (1, 3)) for part in (step, ramp)]
    costs = [lab.patches(part, edges, 0.1, 1.0, 1e6) for part in paint]
    flat = lab.SMOOTH / 0.1
    assert costs[0] == pytest.approx(np.sqrt(3) * np.log(4.5) / 10 + 0.99 * flat, rel=0.01)
    assert costs[1] < 1.2 * costs[0]
    still = lab.patches(np.full((101, 3), 0.5), edges, 0.1, 1.0, 0.1)
    costs = [lab.patches(part, edges, 0.1, 1.0, 0.1) - still for part in paint]
    assert costs[1] > 2 * costs[0]


def test_patches_hardly_depend_on_how_bright_the_paint_is():
    """All paint becomes dark, and the light bright, as that makes borders cheap."""
    albedo = np.array([[0.9, 0.6, 0.3], [0.5, 0.7, 0.9]])
    edges = np.array([[0, 1]])
    costs = [lab.patches(factor * albedo, edges, 1.0, 1.0, 0.1) for factor in (1.0, 0.5)]
    assert costs[1] > 0.75 * costs[0]


def test_in_shade_colours_tell_little_and_in_bright_light_they_are_not_believed():
    """A label on the dark side is erased; or what is bright, or one dark letter, counts otherwise
    than its surroundings.
    """
    edges = np.stack([np.arange(149), np.arange(1, 150)], 1)
    light = np.repeat([0.5, 0.1, 1.5], 50)
    light[80] = 0.0
    error_weight, prior_weight = lab.brightness_weights(np.tile(light[:, None], (1, 3)), edges)
    np.testing.assert_allclose(prior_weight[[20, 60, 130]], [1, 0.04, 1])
    np.testing.assert_allclose(error_weight[[20, 60, 130]], [1, 2 / 1.04, 0.2])
    assert prior_weight[80] > 0.02


# --- what is found -----------------------------------------------------------------------------


def test_the_gradient_of_the_whole_loss(rng):
    """A part of the loss has no gradient, or another factor."""
    x, (_, faces) = looks(rng, 12), mesh.icosphere(20)
    edges = reconstruction.closed_mesh_edges(faces)
    seen = lab.Observed(rng.uniform(0.1, 1, (12, 3)), rng.uniform(0, 0.2, 12), received(rng, 12),
                        edges, 0.7, rng.random(len(edges)))
    priors = lab.Priors(0.3, 0.7, 0.4)

    def loss(*parts):
        return lab.loss_and_gradients(lab.Appearance(*parts, 1.2), seen, priors)

    gradcheck(lambda *parts: np.array(loss(*parts)[0]),
              lambda grad_loss, *parts: tuple(grad_loss * grad for grad in loss(*parts)[1][:4]),
              (*x[:3], np.array(x.near)), name="loss")


def test_the_mean_albedo_is_one_half_and_the_colours_stay(rng):
    """The factor is taken from the albedo and not given to the light, or only to part of it."""
    x, share = looks(rng, 40), np.full(40, 1 / 40)
    around = received(rng, 40)
    around = around._replace(bounce=0 * around.bounce)
    found = lab.allowed(x, share)
    assert found.albedo.mean() == pytest.approx(0.5)
    np.testing.assert_allclose(lab.shade_with_sun(found, around), lab.shade_with_sun(x, around))


def test_an_albedo_of_at_most_one_shows_the_same_colours(rng):
    """Light from the surface itself stays as it was while the albedo is scaled."""
    x, around = looks(rng, 2000), received(rng, 2000)
    x = x._replace(albedo=2 * x.albedo)
    found = lab.rescaled(x, 1.0)
    kept = found.albedo.max(1) < 1
    assert kept.mean() > 0.99
    np.testing.assert_allclose(lab.shade_with_sun(found, around)[kept],
                               lab.shade_with_sun(x, around)[kept])


def test_a_yellow_thing_in_grey_light_is_yellow():
    """The light takes the paint's colour, as any light is allowed to."""
    vertices, faces, _ = ball(0.8)
    yellow, towards = np.array([0.8, 0.6, 0.1]), np.array([[0.6, 0.64, 0.48]])
    light = reconstruction.distant_light(towards, np.full((1, 3), 0.7))
    light[0] += 0.3 / reconstruction.C0
    painted = reconstruct.Painted(vertices, faces, np.tile(yellow, (len(vertices), 1)))
    targets = multi_view_fit.targets_of(photographed(painted, light, 8, 48), 1, 1)
    surface = surface_of(vertices, faces)
    x = lab.decompose(surface, targets, steps=600)
    hue, scaled = x.albedo / x.albedo[:, :1], x.albedo * yellow[0] / x.albedo[:, 0].mean()
    assert np.abs(hue - yellow / yellow[0]).max() < 0.02
    assert np.abs(scaled - yellow).mean() < 0.02
    assert np.ptp(x.light[0]) < 0.02 * x.light[0].mean()
    seen, _ = lab.seen_colours(surface, targets)
    assert np.abs(lab.shaded_colours(surface, x) - seen).mean() < 0.02
