"""Albedo and light told apart: equations (10) to (13), their gradients, and what they find."""
import numpy as np
import pytest
from found_objects import NO_SUN

from course.experiments.scenes import demo, drawing, reconstruct, viewing
from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import intrinsic_decomposition as lab
from reference import multi_view_fit, reconstruction

LABS = demo.Labs("reference")


def surface_of(vertices, faces, albedo=None):
    """A Surface, as multi_view_fit makes them."""
    normals = mesh.vertex_normals(vertices, faces)
    albedo = np.full(vertices.shape, 0.5) if albedo is None else albedo
    return multi_view_fit.Surface(vertices, faces, None, normals, albedo)


def looks(rng, count):
    """An Appearance of count vertices, in light of all colours and a sun."""
    light = rng.uniform(-0.2, 0.2, (9, 3))
    light[0] = 3.0, 2.5, 2.0
    return lab.Appearance(rng.uniform(0.1, 0.9, (count, 3)), light,
                          np.array([[0.48, 0.6, 0.64], [0.9, 0.7, 0.5]]))


# --- eq. (10) ----------------------------------------------------------------------------------


def photographed(count=6, size=48):
    """A ball of soft colours, as pictures show it: the Surface, its colours (V, 3), its Targets."""
    vertices, faces = mesh.icosphere(1280)
    vertices = 0.8 * vertices
    colours = 0.5 + 0.3 * np.sin(4 * vertices[:, [1, 2, 0]])
    even = np.zeros((9, 3))
    even[0] = 1 / reconstruction.C0
    cameras = viewing.cameras_around(LABS, count)
    pictures = reconstruct.photographs(LABS, reconstruct.Painted(vertices, faces, colours), even,
                                       cameras, size)
    capture = multi_view_fit.Capture(pictures, cameras, drawing.WHITE)
    return (surface_of(vertices, faces), colours,
            multi_view_fit.targets_of(capture, 1, 1))


def test_the_colours_that_pictures_show_are_found():
    """Pixels of the outline, which are half background, bleach the surface."""
    surface, colours, targets = photographed(12)
    found, count = lab.seen_colours(surface, targets)
    assert np.abs(found - colours)[count > 1].max() < 0.02
    inner = [lab.inner(target.picture).sum() for target in targets]
    assert count.sum() == pytest.approx(sum(inner))


def test_what_no_pixel_sees_takes_the_colours_around():
    """A hole in the pictures is black, or the system has no solution."""
    surface, _, targets = photographed(1)
    found, count = lab.seen_colours(surface, targets)
    assert (count == 0).sum() > 300
    seen = found[count > 0]
    assert (found.min(0) > seen.min(0) - 1e-6).all() and (found.max(0) < seen.max(0) + 1e-6).all()


def test_a_piece_that_no_pixel_sees_is_black():
    """The system has no solution, and all colours are nan."""
    surface, _, targets = photographed(2)
    far = surface.vertices + [50.0, 0.0, 0.0]
    faces = np.vstack([surface.faces, surface.faces + len(far)])
    found, _ = lab.seen_colours(surface_of(np.vstack([surface.vertices, far]), faces), targets)
    expected = np.vstack([lab.seen_colours(surface, targets)[0], 0 * far])
    np.testing.assert_allclose(found, expected, atol=1e-6)


def test_an_object_of_outlines_alone_is_refused():
    """All colours become nan."""
    surface, _, targets = photographed(2, 3)
    with pytest.raises(ValueError, match="no pixel lies inside the object"):
        lab.decompose(surface, targets)


# --- eq. (11) ----------------------------------------------------------------------------------


def test_the_sun_on_paper():
    """The sun shines from behind, or the shadow takes the other light along."""
    normals = np.array([[0.0, 0.0, 1.0], [0.0, 0.6, 0.8], [0.0, 0.0, -1.0]])
    light = np.zeros((9, 3))
    light[0] = np.array([1.0, 2.0, 3.0]) / reconstruction.C0
    sun = np.array([[0.0, 0.0, 1.0], [10.0, 20.0, 30.0]])
    x = lab.Appearance(np.full((3, 3), 0.5), light, sun)
    found = lab.shade_with_sun(x, normals, np.array([1.0, 0.5, 1.0]))
    np.testing.assert_allclose(found, [[5.5, 11, 16.5], [2.5, 5, 7.5], [0.5, 1, 1.5]])


def test_the_gradient_of_the_shading(rng):
    """A factor of the product rule is missing, or what faces away from the sun moves it."""
    x = looks(rng, 20)
    normals = rng.normal(size=(20, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    lit = rng.uniform(0, 1, 20)
    gradcheck(lambda *parts: lab.shade_with_sun(lab.Appearance(*parts), normals, lit),
              lambda grad, *parts: lab.shade_with_sun_backward(grad, lab.Appearance(*parts),
                                                               normals, lit),
              tuple(x), name="shade")


def test_a_ball_over_a_plate_throws_its_shadow():
    """The shadow falls towards the sun, or all is lit, or the plate shadows itself."""
    ball, ball_faces = mesh.icosphere(320)
    plate, plate_faces = mesh.split_longest(
        np.array([[-2.0, 0, -2], [2, 0, -2], [2, 0, 2], [-2, 0, 2]]),
        np.array([[0, 2, 1], [0, 3, 2]]), 4000)
    vertices = np.concatenate([0.3 * ball + [0, 0.8, 0], plate])
    surface = surface_of(vertices, np.concatenate([ball_faces, plate_faces + len(ball)]))
    towards = np.array([0.6, 0.8, 0.0])
    lit = lab.lit_share(surface, np.stack([towards, np.ones(3)]))[len(ball):]
    away = np.linalg.norm((plate - [-0.6, 0, 0]) * [0.8, 1, 1], axis=1)  # an ellipse
    assert lit[away < 0.25].max() == 0 and lit[away > 0.35].min() == 1


def test_at_sunrise_a_lamp_is_found():
    """x, y and z are exchanged, or the light becomes brighter."""
    towards = np.array([[0.48, 0.6, 0.64]])
    light = reconstruction.distant_light(towards, np.full((1, 3), 2.0))
    x = lab.add_sun(lab.Appearance(np.ones((1, 3)), light, NO_SUN))
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
    """One large step costs more than many small ones of the same sum, as squares do."""
    edges = np.stack([np.arange(100), np.arange(1, 101)], 1)
    step = np.where(np.arange(101) < 50, 0.1, 0.8)
    ramp = np.exp(np.linspace(np.log(0.2), np.log(0.9), 101)) - lab.DARK
    costs = [lab.patches(np.tile(part[:, None], (1, 3)), edges, 0.1, 1.0) for part in (step, ramp)]
    flat = lab.SMOOTH / 0.1
    assert costs[0] == pytest.approx(np.sqrt(3) * np.log(4.5) / 10 + 0.99 * flat, rel=0.01)
    assert costs[1] < 1.2 * costs[0]


def test_patches_hardly_depend_on_how_bright_the_paint_is():
    """All paint becomes dark, and the light bright, as that makes borders cheap."""
    albedo = np.array([[0.9, 0.6, 0.3], [0.5, 0.7, 0.9]])
    edges = np.array([[0, 1]])
    costs = [lab.patches(factor * albedo, edges, 1.0, 1.0) for factor in (1.0, 0.5)]
    assert costs[1] > 0.75 * costs[0]


def test_the_gradients_of_the_priors(rng):
    """The mean, the root or the logarithm is forgotten on the way back."""
    x = looks(rng, 30)
    edges = np.stack([np.arange(30), rng.permutation(30)], 1)
    gradcheck(lab.neutral, lab.neutral_backward, (x.light, x.sun), name="neutral")
    gradcheck(lab.patches, lab.patches_backward, (x.albedo, edges, 0.3, rng.random(30)),
              differentiable=[0], name="patches")


def test_patches_count_in_shade_as_little_as_colours_tell_there():
    """A label on the dark side is erased; or what is bright, or one dark letter, counts otherwise
    than its surroundings.
    """
    edges = np.stack([np.arange(99), np.arange(1, 100)], 1)
    light = np.where(np.arange(100) < 50, 0.9, 0.1)
    weight = lab.edge_weights(np.tile(light[:, None], (1, 3)), edges)
    assert np.all(weight[:40] == 1) and weight[60:] == pytest.approx(0.04)
    light[80] = 0.0
    assert lab.edge_weights(np.tile(light[:, None], (1, 3)), edges)[80] > 0.02


# --- what is found -----------------------------------------------------------------------------


def test_the_gradient_of_the_whole_loss(rng):
    """A part of the loss has no gradient, or another factor."""
    x, (vertices, faces) = looks(rng, 12), mesh.icosphere(20)
    normals, edges = mesh.vertex_normals(vertices, faces), reconstruction.closed_mesh_edges(faces)
    seen = lab.Observed(rng.uniform(0.1, 1, (12, 3)), rng.uniform(0, 0.2, 12), normals, edges, 0.7,
                        rng.random(len(edges)))
    lit, priors = rng.uniform(0, 1, 12), lab.Priors(0.3, 0.7)

    def gradient(grad_loss, *parts):
        _, grads = lab.loss_and_gradients(lab.Appearance(*parts), seen, lit, priors)
        return tuple(grad_loss * grad for grad in grads)

    gradcheck(lambda *parts: np.array(lab.loss_and_gradients(lab.Appearance(*parts), seen, lit,
                                                             priors)[0]),
              gradient, tuple(x), name="loss")


def test_the_mean_albedo_is_one_half_and_the_colours_stay(rng):
    """The factor is taken from the albedo and not given to the light, or only to part of it."""
    x, share = looks(rng, 40), np.full(40, 1 / 40)
    normals = np.tile([[0.6, 0.0, 0.8]], (40, 1))
    found = lab.allowed(x, share)
    assert found.albedo.mean() == pytest.approx(0.5)
    np.testing.assert_allclose(lab.shade_with_sun(found, normals, np.ones(40)),
                               lab.shade_with_sun(x, normals, np.ones(40)))


def test_a_yellow_thing_in_grey_light_is_yellow():
    """The light takes the paint's colour, as any light is allowed to."""
    vertices, faces = mesh.icosphere(1280)
    vertices = 0.8 * vertices
    yellow, towards = np.array([0.8, 0.6, 0.1]), np.array([[0.6, 0.64, 0.48]])
    light = reconstruction.distant_light(towards, np.full((1, 3), 0.7))
    light[0] += 0.3 / reconstruction.C0
    painted = reconstruct.Painted(vertices, faces, np.tile(yellow, (len(vertices), 1)))
    cameras = viewing.cameras_around(LABS, 8)
    capture = multi_view_fit.Capture(
        reconstruct.photographs(LABS, painted, light, cameras, 48), cameras, drawing.WHITE)
    targets = multi_view_fit.targets_of(capture, 1, 1)
    surface = surface_of(vertices, faces)
    x = lab.decompose(surface, targets, steps=600)
    hue, scaled = x.albedo / x.albedo[:, :1], x.albedo * yellow[0] / x.albedo[:, 0].mean()
    assert np.abs(hue - yellow / yellow[0]).max() < 0.02
    assert np.abs(scaled - yellow).mean() < 0.02
    assert np.ptp(x.light[0]) < 0.02 * x.light[0].mean()
    seen, _ = lab.seen_colours(surface, targets)
    assert np.abs(lab.shaded_colours(surface, x) - seen).mean() < 0.02
