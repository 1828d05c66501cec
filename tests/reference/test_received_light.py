"""The light that a surface receives, of equation (11): from a lamp and from itself."""
import numpy as np
from found_objects import surface_of

from course.given import mesh
from reference import intrinsic_decomposition, multi_view_fit
from reference import received_light as lab


def two_plates(apart):
    """Two squares of side 2 that face each other, as one Surface."""
    points, faces = mesh.split_longest(*mesh.plane(2), 1500)
    return surface_of(np.concatenate([points, points + [0, apart, 0]]),
                      np.concatenate([faces, faces[:, ::-1] + len(points)]))


def test_a_near_lamp_falls_off_with_the_square_of_its_distance():
    """The falloff is another, the strength is not that of the middle, or a sun falls off."""
    up, points = np.array([0.0, 1.0, 0.0]), np.array([[0.0, 0, 0], [0, 1, 0], [2, 0, 0]])
    surface = multi_view_fit.Surface(points, None, None, np.tile(up, (3, 1)), None)
    lamp = np.array([0.0, 2.0, 0.0])
    away = np.linalg.norm(lamp - points, axis=1)
    expected = 4 / away**2 * (lamp - points)[:, 1] / away
    np.testing.assert_allclose(lab.facing(up, 0.5, surface), expected)
    np.testing.assert_allclose(lab.facing(up, 0.0, surface), 1)


def test_a_ball_over_a_plate_throws_its_shadow():
    """The shadow falls towards the lamp, a near lamp's is as small as the sun's, its edge is hard,
    or the plate shadows itself.
    """
    ball, ball_faces = mesh.icosphere(320)
    plate, plate_faces = mesh.split_longest(*mesh.plane(2), 4000)
    plate = 2 * plate
    surface = surface_of(np.concatenate([0.3 * ball + [0, 0.8, 0], plate]),
                         np.concatenate([ball_faces, plate_faces + len(ball)]))
    up = np.array([0.0, 1.0, 0.0])
    sun, lamp = (lab.lit_share(surface, up, near)[len(ball):] for near in (0.0, 0.5))
    away = np.linalg.norm(plate, axis=1)
    assert sun[away < 0.18].max() == 0 and sun[away > 0.42].min() == 1
    assert lamp[away < 0.34].max() == 0 and lamp[away > 0.72].min() == 1
    assert ((0.2 < sun) & (sun < 0.8)).any()
    slanted = lab.lit_share(surface, np.array([0.6, 0.8, 0.0]), 0.0)[len(ball):]
    away = np.linalg.norm((plate - [-0.6, 0, 0]) * [0.8, 1, 1], axis=1)  # an ellipse
    assert slanted[away < 0.16].max() == 0 and slanted[away > 0.45].min() == 1


def test_what_a_plate_hides_it_sends():
    """The share of a square that faces another, by hand: 0.2395 of all, in its middle, at its
    own side's distance; a ball hides nothing of itself.
    """
    surface = two_plates(2.0)
    colours = np.tile([1.0, 0.5, 0.0], (len(surface.vertices), 1))
    sky, bounce = lab.surroundings(surface, colours)
    middle = np.abs(surface.vertices[:, [0, 2]]).max(1) < 0.1
    a = 1 / np.sqrt(5)  # Siegel and Howell: from a point to a rectangle, four times a quarter
    hidden = 4 / (2 * np.pi) * 2 * a * np.arctan(a)
    np.testing.assert_allclose(1 - sky[middle], hidden, rtol=0.03)
    np.testing.assert_allclose(bounce[middle], hidden * colours[middle], rtol=0.03, atol=1e-9)
    ball = surface_of(*mesh.icosphere(1280))
    assert lab.surroundings(ball, np.ones((len(ball.vertices), 3)))[0].min() > 0.98


def test_light_goes_to_and_fro_between_plates():
    """Only the first bounce counts, or each of them counts alike."""
    surface = two_plates(0.5)
    light = np.zeros((9, 3))
    light[0] = 1.0
    x = intrinsic_decomposition.Appearance(np.full(surface.vertices.shape, 0.6), light,
                                           np.array([[0.0, 1, 0], [0, 0, 0]]), 0.0, 1.0)
    found = intrinsic_decomposition.shaded_colours(surface, x)
    sky, bounce = lab.surroundings(surface, found)
    np.testing.assert_allclose(found, 0.6 * (sky[:, None] * light[0] * 0.2821 + bounce), rtol=0.1)
