"""The figures of pages 06b to 16b compute what the reference computes."""
import numpy as np
from reading import each, opened, settled

from reference import (
    antialiasing,
    cube_maps,
    intrinsic_decomposition,
    outline_walk,
    outlines,
    rasterization,
)


def test_the_mirror(call, agrees):
    """u runs the other way on a face, or the ray goes on behind the ball."""
    d, n = np.random.default_rng(6).normal(size=(2, 60, 2))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    face, uv = cube_maps.on_face(np.insert(d, 1, 0, axis=1))
    agrees("mirror", "onFace", np.column_stack([np.searchsorted([0, 1, 4, 5], face), uv[:, 0]]), d)
    ways = np.array(call("mirror", "reflected", d, n))
    np.testing.assert_allclose((ways * n).sum(1), -(d * n).sum(1))
    np.testing.assert_allclose(ways + d, 2 * (d - (d * n).sum(1, keepdims=True) * n), atol=1e-12)


def prism(count, radius, middle, pixel):
    """A ball of flatland, drawn out along y, far down, so that in the picture each side is one face
    -> vertices (2 N, 3), seen along its height, faces. Pixels are 1 wide, and x = 1 is at 0.
    """
    angle = 2 * np.pi * np.arange(count) / count
    x = (middle + radius * np.cos(angle) - 1) / pixel
    ring = np.column_stack([x, 0 * x, -radius * np.sin(angle) / 10])
    k, ahead = np.arange(count), np.roll(np.arange(count), -1)
    faces = np.concatenate([np.column_stack([k, ahead, ahead + count]),
                            np.column_stack([k, ahead + count, k + count])])
    return np.concatenate([ring - [0, 1e5, 0], ring + [0, 9, 0]]), faces


def found_by(rule, inside, count, pixel):
    """Which share of the ball's derivative by its size a rule of the reference finds at its right
    end, before black, if the last centre lies so many pixels before it."""
    width = 64
    vertices, faces = prism(count, 1.0, 0.0, pixel)
    moves = vertices[:, 0] + 1 / pixel
    x = vertices[:, 0] + width // 2 + inside - 0.5
    clip = np.column_stack([2 * x / width - 1, vertices[:, 1] / 8, vertices[:, 2], 0 * x + 1])
    face_index, depth = rasterization.rasterize(clip, faces, width, 8)
    pairs = rule(face_index, depth, clip, faces, antialiasing.opposite_corners(faces))
    white = (face_index >= 0)[..., None] * 1.0
    grad = np.ones_like(white) / 8
    right = grad * (np.arange(width) > width // 4)[:, None]
    grad_clip = antialiasing.blend_pairs_backward(right, white, pairs, clip)[1]
    return (grad_clip[:, 0] * 2 / width * moves).sum() * pixel


def test_thin_faces(call):
    """The owner's face is its neighbour, or a ball with few faces is taken for a round one."""
    rng = np.random.default_rng(8)
    scenes = [(inside, count, 2.4 / pixels) for inside, count, pixels in zip(
        rng.uniform(0.05, 0.95, 20), rng.choice([16, 32, 48, 96], 20), rng.choice([32, 64], 20),
        strict=True)]
    found = call("thin_faces", "sharesAt", *zip(*scenes, strict=True), False)
    for name, column in ((outlines.blended_pairs, 0), (outline_walk.walked_pairs, 2)):
        np.testing.assert_allclose([shares[column] for shares in found],
                                   each(found_by, [name] * 20, *zip(*scenes, strict=True)),
                                   atol=1e-6)
    assert {shares[0] for shares in found} == {0, 1}


def test_the_square_has_four_valleys_and_the_loss_of_its_picture(call):
    """A quarter is in the next one's colour, or the rim is forgotten."""
    colours = np.array([[0.7, 0.06, 0.05], [0.72, 0.36, 0.01], [0.01, 0.2, 0.5], [0.02, 0.3, 0.18],
                        [1, 1, 1]])
    places = np.random.default_rng(9).uniform(-1.5, 1.5, (200_000, 2))
    places = places[(places**2).sum(1) < 2]

    def picture(angle):
        angle = np.radians(angle)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        direction = np.degrees(np.arctan2(*(places @ turn).T[::-1])) % 360
        beyond = np.abs(places @ turn @ [[1, 1], [1, -1]]).max(1) > np.sqrt(2)
        return colours[np.where(beyond, 4, direction // 90).astype(int)]

    angles = np.arange(360)
    losses = np.array(call("quarter_turns", "lossOf", angles, 24))
    for angle in range(0, 360, 35):
        wanted = ((picture(angle) - picture(24))**2).sum(1).mean()
        assert abs(losses[angle] - wanted) < 0.005
    ends = np.array(call("quarter_turns", "downhill", angles))
    assert sorted(set(ends)) == [24, 114, 204, 294] and np.argmin(losses) == 24


def test_what_borders_sweep_is_the_gradient(call):
    """A border makes wrong what it makes right, or the light's height counts for nothing."""
    given, h = [5.3, 8.9], 1e-6
    lights = np.random.default_rng(14).uniform([0.5, 2.5], [11.5, 4.3], (60, 2))

    def losses(at):
        return np.array([one["loss"] for one in call("moving_border", "lossOf", at, [given] * 60)])

    differences = np.stack([(losses(lights + step) - losses(lights - step)) / (2 * h)
                            for step in h * np.eye(2)], -1)
    found = call("moving_border", "lossOf", lights, [given] * 60)
    np.testing.assert_allclose([one["gradient"] for one in found], differences, atol=1e-6)


def test_the_priors_and_the_picture_that_stays(agrees, page, address):
    """A slider changes the picture, or a prior is that of another channel."""
    rng = np.random.default_rng(16)
    lamps, albedo = rng.uniform(size=(20, 5, 3)), rng.uniform(size=(20, 9, 3))
    edges, none = np.column_stack([np.arange(8), np.arange(1, 9)]), np.zeros((2, 3))
    agrees("two_explanations", "neutral",
           [intrinsic_decomposition.neutral(each_lamp, none) for each_lamp in lamps], lamps)
    agrees("two_explanations", "patches",
           [intrinsic_decomposition.patches(paint, edges, 0.2, np.ones(8), 0.1)
            for paint in albedo], albedo, [edges] * 20, 0.2, 0.1)
    opened(page, address, "two_explanations")
    for one in page.locator("input").all():
        one.press("End")
    assert "picture changes by 0." in settled(page).inner_text(".verdict")
