"""The reference's whole shapes, rays and volumes of lab 15."""
import numpy as np
import pytest
from screen_scenes import camera

from course.given.gradcheck import gradcheck
from course.given.whose import Labs
from course.scenes import fit_volume, representations, viewing
from reference import implicit_surfaces, transforms
from tests.labs.test_implicit_surfaces import distance_to_box, distance_to_ring

BALL, BOX = ("sphere", 0.7), ("box", np.array([0.3, 0.5, 0.6]))
SHAPES = {
    "sphere": BALL, "box": BOX, "torus": ("torus", 0.6, 0.25),
    "moved": ("moved", np.array([0.2, -0.1, 0.3]), BOX),
    "union": ("union", BOX, ("sphere", 0.5)),
    "intersection": ("intersection", BOX, ("sphere", 0.5)),
    "complement": ("intersection", BALL, ("complement", BOX)),
    "smooth union": ("smooth union", 0.3, ("torus", 0.6, 0.2), BOX),
    "wheel": representations.WHEEL}
RIPPLED = ("rippled", 0.1, 8.0, BALL)
CAMERA = camera([1.0, 2.2, 1.4], fov_y=np.radians(40), aspect=1.5)


# --- shapes ------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [*SHAPES.values(), RIPPLED], ids=[*SHAPES, "rippled"])
def test_gradients_of_shapes_are_central_differences(shape):
    """A part's gradient goes to another part, or is lost, in a shape of shapes."""
    points = np.random.default_rng(1).uniform(-1, 1, (30, 3))

    def decisions(points, shape):  # which part is nearest, which side of a box
        gradient = implicit_surfaces.signed_distance_backward(np.ones(len(points)), points, shape)
        return np.abs(gradient) > 1e-12

    gradcheck(implicit_surfaces.signed_distance, implicit_surfaces.signed_distance_backward,
              (points, shape), differentiable=[0], decisions=decisions, name="signed_distance")


def test_boxes_and_rings_are_as_far_as_their_nearest_point():
    """A region is wrong: sides, edges and corners of the box; the hole, and below the plane."""
    points, half = np.random.default_rng(2).uniform(-2, 2, (400, 3)), np.array([1.0, 0.7, 1.3])
    np.testing.assert_allclose(implicit_surfaces.box(points, half),
                               [distance_to_box(point, half) for point in points])
    np.testing.assert_allclose(implicit_surfaces.torus(points, 1.1, 0.3),
                               distance_to_ring(points, 1.1, 0.3))


def test_a_smooth_union_is_a_mix_of_both():
    """It swells far from the seam, or is a groove there; its shares are swapped."""
    a, b = np.random.default_rng(3).normal(size=(2, 50))
    for k in 0.3, 1.0, 3.0:
        h = np.clip(0.5 + 0.5 * (b - a) / k, 0, 1)
        np.testing.assert_allclose(implicit_surfaces.smooth_union(a, b, k),
                                   b + h * (a - b) - k * h * (1 - h))


def test_what_is_no_shape_is_told_in_one_sentence():
    """A misspelt shape ends in an error about unpacking."""
    points = np.zeros((2, 3))
    for shape in ("cone", 1.0), ("sphere",), 3.0, ("union", BALL):
        with pytest.raises(ValueError, match="there is no shape"):
            implicit_surfaces.signed_distance(points, shape)
        with pytest.raises(ValueError, match="there is no shape"):
            implicit_surfaces.signed_distance_backward(np.ones(2), points, shape)


# --- rays --------------------------------------------------------------------------------------


def test_rays_go_through_the_centres_of_pixels():
    """Rows from above, half a pixel off, or width and height swapped."""
    origins, directions = implicit_surfaces.camera_rays(CAMERA, 9, 6)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1)
    for t, depth in (0.0, -1.0), (1.7, None):
        screen = transforms.project(origins + t * directions, CAMERA, 9, 6)
        row, column = np.indices((6, 9)).reshape(2, -1)
        np.testing.assert_allclose(screen[:, 0], column + 0.5, atol=1e-9)
        np.testing.assert_allclose(screen[:, 1], row + 0.5, atol=1e-9)
        if depth is not None:
            np.testing.assert_allclose(screen[:, 2], depth, atol=1e-9)


def test_a_volume_of_a_wall_is_a_wall():
    """The Laplace density has another integral than the distance promises: 1/2 at the surface."""
    distance = np.linspace(-1, 1, 20_001)
    density = implicit_surfaces.density_of(distance, 0.05)
    assert (np.diff(density) <= 0).all() and density.max() <= 1 / 0.05
    np.testing.assert_allclose(density[10_000], 0.5 / 0.05)
    outside = density[10_000:].sum() * 1e-4
    np.testing.assert_allclose(outside, 0.5, atol=2e-3)  # the optical depth down to the surface


def test_colours_converge_as_the_samples_get_denser():
    """Quadrature is of another order, or not of the integral: fog between two ends."""
    errors = []
    for count in 16, 32, 64:
        points, spacing = implicit_surfaces.ray_samples(
            np.array([[0.0, 0, 0]]), np.array([[0.0, 0, 1]]), 1.0, 3.0, count)
        z = points[..., 2]
        got = implicit_surfaces.volume_render(z, z[..., None], spacing, np.array([5.0]))[0, 0]
        t = np.linspace(1, 3, 200_001)
        light = np.exp(-(t**2 - 1) / 2)
        truth = np.trapezoid(light * t * t, t) + 5 * light[-1]
        errors.append(abs(got - truth))
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (1.9 < order).all() and (order < 2.1).all()


def test_a_density_grid_is_found_from_pictures():
    """A gradient of the volume, or of its look-ups, leads elsewhere than to what was seen."""
    labs, size = Labs("reference"), 12
    given = fit_volume.saturn_rays(labs, viewing.cameras_around(labs, 16, longitude=0.2), size)
    volumes, losses = zip(*fit_volume.fit(labs, given, 12, 100, batch=300), strict=True)
    new = fit_volume.saturn_rays(labs, viewing.cameras_around(labs, 3, longitude=0.7), size)
    picture = fit_volume.seen(labs, new, volumes[-1])
    assert np.mean(losses[-10:]) < losses[0] / 15
    assert -10 * np.log10(np.mean((picture - new.colours)**2)) > 20
